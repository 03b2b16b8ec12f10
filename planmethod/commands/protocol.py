"""Command ``protocol``: description of the construction, step by step."""

from __future__ import annotations

from pathlib import Path

import click

from planmethod.commands.output import LocalizedCommand, write_text
from planmethod.commands.problems import (
    LoadedProblem,
    finish,
    for_each_problem,
    guarded,
    language_of,
)
from planmethod.options import (
    PathType,
    Positions,
    basename,
    drawn_by,
    problem_lang_option,
    problem_options,
    reading_options,
)


@click.command(cls=LocalizedCommand)
@problem_options
@reading_options
@click.option(
    "-o",
    "--out",
    type=PathType(file_okay=False),
    help="Folder for a text file. Default: the terminal.",
)
@click.option(
    "--position",
    type=click.IntRange(min=0),
    metavar="NUMBER",
    help="Number of the position, from 0; else the calculated one of a project, or 0.",
)
@click.option(
    "--format",
    "form",
    type=click.Choice(["text", "md"]),
    default="text",
    show_default=True,
    help="Plain text, or Markdown with formulas in LaTeX.",
)
@problem_lang_option
@guarded
def protocol(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    phi: Positions | None,
    ruler: float | None,
    profile: str | None,
    out: Path | None,
    position: int | None,
    form: str,
    lang: str | None,
) -> None:
    """Describe the construction step by step, as the explanatory note does."""
    from planmethod.kind import PlanRequest
    from planmethod.note.wording import get_language

    if form == "md":
        from planmethod.note.writers.markdown import markdown_document as write
    else:
        from planmethod.note.writers.terminal import plain_document as write

    request = PlanRequest(profile=drawn_by(profile, ruler), phi=phi, position=position)

    def write_protocol(item: LoadedProblem) -> None:
        kind, problem = item.kind, item.problem
        language = get_language(language_of(problem, lang))
        kind.reject_options(problem, request.of_linkages())
        document = kind.protocol_document(problem, language, request)
        suffix = "txt" if form == "text" else form
        text = write(document, language) + "\n"
        write_text(
            text, None if out is None else str(out / f"{basename(problem)}-protocol.{suffix}")
        )

    finish(for_each_problem(problems, variant, all_variants, write_protocol))
