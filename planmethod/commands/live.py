"""Command ``live``: a mechanism and its plans, or a gear train, moving: one HTML file."""

from __future__ import annotations

from pathlib import Path

from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import show, write_text
from planmethod.commands.problems import LoadedProblem, finish, for_each_problem, language_of
from planmethod.commands.sheet_options import colour_option, coloured
from planmethod.options import (
    ProblemChoice,
    basename,
    open_option,
    out_option,
    problem_lang_option,
    warn_each,
)


class LiveOptions(Struct, frozen=True, kw_only=True):
    """Options of ``live``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    colour: bool | None = colour_option()
    out: Path = out_option()
    lang: str | None = problem_lang_option()
    shown: bool = open_option()


@command(LiveOptions)
def live(options: LiveOptions) -> None:
    """Write an HTML page with a moving mechanism and its plans, or a moving gear train."""
    written: list[Path] = []

    def write(item: LoadedProblem) -> None:
        page = options.out / f"{basename(item.problem)}-live.html"
        words = language_of(item.problem, options.lang)
        problem = coloured(item.problem, options.colour)
        write_text(item.kind.live_page(problem, words), str(page), folder=options.out)
        warn_each(item.problem, item.kind.accuracy_warnings(item.problem))
        written.append(page)

    code = for_each_problem(options.choice, write)
    if options.shown and written:
        show(written[0])
    finish(code)
