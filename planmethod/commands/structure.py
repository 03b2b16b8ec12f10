"""Command ``structure``: mobility, redundant constraints, Assur groups."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from planmethod.commands.asked import PaperRequest, sheet_options
from planmethod.commands.helptext import Spoken
from planmethod.commands.output import json_text, write_drawings
from planmethod.commands.problems import Todo, called, each, finish, guarded, language_of, stem
from planmethod.options import (
    UsageError,
    dxf_text_option,
    format_option,
    out_option,
    problem_options,
)

if TYPE_CHECKING:
    from planmethod.kind import ProblemKind
    from planmethod.problem.head import KindProblem


@click.command(cls=Spoken)
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
    asked: PaperRequest,
) -> None:
    """Analyse the structure: mobility, redundant constraints, Assur groups; text and drawing."""
    from planmethod.note.wording import language
    from planmethod.note.writers.plain import plain_document
    from planmethod.solved.aligned.schemes import self_aligning
    from planmethod.solved.analysed import structure_of

    drawn = not as_json and not no_drawing
    settled = asked.settle() if drawn else None

    def show(todo: Todo) -> None:
        if todo.kind is not None:
            show_other(todo.kind, todo.problem)
            return
        problem = todo.linkage
        found = structure_of(problem)
        aligned = self_aligning(problem, found)
        if as_json:
            from planmethod.note.records.aligned import structure_in_full

            head = {"schema": 1, "problem": problem.name}
            whole = {**head, "structure": structure_in_full(found, problem.mechanism, aligned)}
            click.echo(json_text(whole))
            return
        from planmethod.note.narrate.structure import structure_document

        if settled is not None:
            problem = settled.over(problem)
        words = language(language_of(problem, asked.lang))
        notation = problem.sheet.notation
        written = structure_document(problem.mechanism, found, words, notation, aligned)
        click.echo(plain_document(written, words))
        if settled is not None:
            from planmethod.render.sheets.structure import structure_sheet

            drawing = structure_sheet(problem, found, aligned, fields=asked.fields)
            write_drawings(
                [drawing],
                out,
                f"{stem(problem)}-structure",
                formats,
                author=settled.author(problem),
                dxf_text=dxf_text,
            )

    def show_other(kind: ProblemKind[Any], problem: KindProblem) -> None:
        words = language(language_of(problem, asked.lang))
        record = kind.structure_record(problem) if as_json else None
        written = None if as_json else kind.structure_document(problem, words)
        if record is not None:
            click.echo(json_text(record))
        elif written is not None:
            click.echo(plain_document(written, words))
        else:
            raise UsageError("{} is not a mechanism, it has no structure", called(problem))

    finish(each(problems, variant, all_variants, show, drawn=False))
