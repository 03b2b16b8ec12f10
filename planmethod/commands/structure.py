"""Command ``structure``: mobility, redundant constraints, Assur groups."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import click

from planmethod.commands.output import LocalizedCommand, json_text, write_drawings
from planmethod.commands.problems import (
    LoadedProblem,
    finish,
    for_each_problem,
    guarded,
    language_of,
)
from planmethod.commands.sheet_options import PaperRequest, sheet_options
from planmethod.options import basename, dxf_text_option, format_option, out_option, problem_options


@click.command(cls=LocalizedCommand)
@problem_options
@out_option
@click.option("--json", "as_json", is_flag=True, help="Print the analysis as one JSON object.")
@format_option("svg")
@dxf_text_option
@click.option("--no-drawing", is_flag=True, help="Text only.")
@sheet_options
@guarded
def structure(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    out: Path,
    as_json: bool,
    formats: tuple[str, ...],
    dxf_text: Literal["text", "strokes"],
    no_drawing: bool,
    request: PaperRequest,
) -> None:
    """Analyse the structure: mobility, redundant constraints, Assur groups; text and drawing."""
    from planmethod.note.wording import get_language
    from planmethod.note.writers.terminal import plain_document

    drawn = not as_json and not no_drawing
    settled = request.resolve() if drawn else None

    def show(item: LoadedProblem) -> None:
        kind, problem = item.kind, item.problem
        if as_json:
            click.echo(json_text(kind.structure_record(problem)))
            return
        if settled is not None and kind.has("structure_drawings"):
            problem = settled.over(problem)
        language = get_language(language_of(problem, request.lang))
        click.echo(plain_document(kind.structure_document(problem, language), language))
        if settled is not None:
            write_drawings(
                kind.structure_drawings(problem, request.fields),
                out,
                f"{basename(problem)}-structure",
                formats,
                author=settled.author(problem),
                dxf_text=dxf_text,
            )

    finish(for_each_problem(problems, variant, all_variants, show, drawn=False))
