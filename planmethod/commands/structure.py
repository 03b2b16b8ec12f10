"""Command ``structure``: mobility, redundant constraints, Assur groups."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import click
from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import json_text, write_drawings
from planmethod.commands.problems import (
    LoadedProblem,
    Loading,
    finish,
    for_each_problem,
    language_of,
)
from planmethod.commands.sheet_options import PaperRequest
from planmethod.options import (
    FileOptions,
    ProblemChoice,
    basename,
    dxf_text_option,
    format_option,
    json_option,
    option,
    out_option,
)


class StructureOptions(Struct, frozen=True, kw_only=True):
    """Options of ``structure``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    out: Path = out_option()
    as_json: bool = json_option("Print the analysis as one JSON object.")
    formats: tuple[str, ...] = format_option("svg")
    dxf_text: Literal["text", "strokes"] = dxf_text_option()
    no_drawing: bool = option("--no-drawing", is_flag=True, help="Print the text only.")
    paper: PaperRequest = field(default_factory=PaperRequest)


@command(StructureOptions)
def structure(options: StructureOptions) -> None:
    """Analyse the structure: mobility, redundant constraints, Assur groups; text and drawing."""
    from planmethod.note.wording import get_language
    from planmethod.note.writers.terminal import plain_document

    drawn = not options.as_json and not options.no_drawing
    settled = options.paper.resolve() if drawn else None

    def show(item: LoadedProblem) -> None:
        kind, problem = item.kind, item.problem
        if options.as_json:
            click.echo(json_text(kind.structure_record(problem)))
            return
        if settled is not None and kind.has("structure_drawings"):
            problem = settled.over(problem)
        language = get_language(language_of(problem, options.paper.lang))
        click.echo(plain_document(kind.structure_document(problem, language), language))
        if settled is not None:
            write_drawings(
                kind.structure_drawings(problem, settled.fields),
                options.out,
                f"{basename(problem)}-structure",
                options.formats,
                author=settled.author(problem),
                file_options=FileOptions(dxf_text=options.dxf_text),
            )

    finish(for_each_problem(options.choice, show, loading=Loading(drawn=False)))
