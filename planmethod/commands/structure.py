"""Command ``structure``: mobility, redundant constraints, Assur groups."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from planmethod.commands.output import LocalizedCommand, json_text, write_drawings
from planmethod.commands.problems import (
    LoadedProblem,
    basename,
    finish,
    for_each_problem,
    guarded,
    language_of,
    message_name,
)
from planmethod.commands.sheet_options import PaperRequest, sheet_options
from planmethod.options import (
    UsageError,
    dxf_text_option,
    format_option,
    out_option,
    problem_options,
)

if TYPE_CHECKING:
    from planmethod.kind import ProblemKind
    from planmethod.problem.records import KindProblem


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
    from planmethod.solved.aligned.schemes import self_aligning
    from planmethod.solved.assembly_modes import structure_of

    drawn = not as_json and not no_drawing
    settled = request.resolve() if drawn else None

    def show(item: LoadedProblem) -> None:
        if item.kind is not None:
            show_other(item.kind, item.problem)
            return
        problem = item.linkage
        found = structure_of(problem)
        aligned = self_aligning(problem, found)
        if as_json:
            from planmethod.note.records.solution import structure_in_full

            head = {"schema": 1, "problem": problem.name}
            whole = {**head, "structure": structure_in_full(found, problem.mechanism, aligned)}
            click.echo(json_text(whole))
            return
        from planmethod.note.narrate.structure import structure_document

        if settled is not None:
            problem = settled.over(problem)
        language = get_language(language_of(problem, request.lang))
        notation = problem.sheet.notation
        written = structure_document(problem.mechanism, found, language, notation, aligned)
        click.echo(plain_document(written, language))
        if settled is not None:
            from planmethod.render.sheets.structure import structure_sheet

            drawing = structure_sheet(problem, found, aligned, fields=request.fields)
            write_drawings(
                [drawing],
                out,
                f"{basename(problem)}-structure",
                formats,
                author=settled.author(problem),
                dxf_text=dxf_text,
            )

    def show_other(kind: ProblemKind[Any], problem: KindProblem) -> None:
        language = get_language(language_of(problem, request.lang))
        record = kind.structure_record(problem) if as_json else None
        written = None if as_json else kind.structure_document(problem, language)
        if record is not None:
            click.echo(json_text(record))
        elif written is not None:
            click.echo(plain_document(written, language))
        else:
            raise UsageError("{} is not a mechanism, it has no structure", message_name(problem))

    finish(for_each_problem(problems, variant, all_variants, show, drawn=False))
