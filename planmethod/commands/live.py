"""Command ``live``: a mechanism and its plans, or a gear train, moving: one HTML file."""

from __future__ import annotations

from pathlib import Path

import click

from planmethod.commands.helptext import Spoken
from planmethod.commands.output import put, show
from planmethod.commands.problems import (
    Todo,
    each,
    finish,
    guarded,
    language_of,
    stem,
    tell_doubts,
)
from planmethod.options import open_option, out_option, problem_lang_option, problem_options


@click.command(cls=Spoken)
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
    from planmethod.render.live.page import live_page

    written: list[Path] = []

    def write(todo: Todo) -> None:
        page = out / f"{stem(todo.problem)}-live.html"
        words = language_of(todo.problem, lang)
        if todo.kind is None:
            put(live_page(todo.linkage, words), str(page), within=out)
            tell_doubts(todo.linkage)
        else:
            put(todo.kind.live_page(todo.problem, words), str(page), within=out)
        written.append(page)

    code = each(problems, variant, all_variants, write)
    if shown and written:
        show(written[0])
    finish(code)
