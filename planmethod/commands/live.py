"""Command ``live``: a mechanism and its plans, or a gear train, moving: one HTML file."""

from __future__ import annotations

from pathlib import Path

import click

from planmethod.commands.output import LocalizedCommand, show, write_text
from planmethod.commands.problems import (
    LoadedProblem,
    finish,
    for_each_problem,
    guarded,
    language_of,
)
from planmethod.options import (
    basename,
    open_option,
    out_option,
    problem_lang_option,
    problem_options,
    warn_each,
)


@click.command(cls=LocalizedCommand)
@problem_options
@out_option
@problem_lang_option
@open_option
@guarded
def live(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    out: Path,
    lang: str | None,
    shown: bool,
) -> None:
    """Write a page where a mechanism and its plans, or a gear train, move, for any browser."""
    written: list[Path] = []

    def write(item: LoadedProblem) -> None:
        page = out / f"{basename(item.problem)}-live.html"
        words = language_of(item.problem, lang)
        write_text(item.kind.live_page(item.problem, words), str(page), folder=out)
        warn_each(item.problem, item.kind.accuracy_warnings(item.problem))
        written.append(page)

    code = for_each_problem(problems, variant, all_variants, write)
    if shown and written:
        show(written[0])
    finish(code)
