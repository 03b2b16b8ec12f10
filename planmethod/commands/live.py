"""Command ``live``: the mechanism and its plans moving, one HTML file."""

from __future__ import annotations

from pathlib import Path

import click

from planmethod.commands.helptext import Spoken
from planmethod.commands.output import put, show
from planmethod.commands.problems import Todo, each, finish, guarded, stem
from planmethod.options import lang_option, open_option, out_option, problem_options


@click.command(cls=Spoken)
@problem_options
@out_option
@lang_option
@open_option
@guarded
def live(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    out: Path,
    lang: str,
    shown: bool,
) -> None:
    """Write a page where the mechanism and its plans move: one HTML file for any browser."""
    from planmethod.render.live.page import live_page

    written: list[Path] = []

    def write(todo: Todo) -> None:
        problem = todo.linkage
        page = out / f"{stem(problem)}-live.html"
        put(live_page(problem, lang), str(page))
        written.append(page)

    code = each(problems, variant, all_variants, write, kinds=False)
    if shown and written:
        show(written[0])
    finish(code)
