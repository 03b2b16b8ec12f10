"""Command ``live``: a mechanism and its plans, or a gear train, moving: one HTML file."""

from __future__ import annotations

from pathlib import Path

from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import show, write_text
from planmethod.commands.problems import LoadedProblem, finish, for_each_problem, language_of
from planmethod.commands.sheet_options import colour_option, coloured
from planmethod.options import (
    PlanRequest,
    ProblemChoice,
    basename,
    open_option,
    option,
    out_option,
    problem_lang_option,
    warn_each,
)


class LiveOptions(Struct, frozen=True, kw_only=True):
    """Options of ``live``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    colour: bool | None = colour_option()
    construction: bool = option(
        "--construction",
        is_flag=True,
        help="Also write the page of the construction, and link both pages.",
    )
    out: Path = out_option()
    lang: str | None = problem_lang_option()
    shown: bool = open_option()


@command(LiveOptions)
def live(options: LiveOptions) -> None:
    """Write an HTML page with a moving mechanism and its plans, or a moving gear train."""
    from planmethod.note.wording import get_language

    written: list[Path] = []

    def write(item: LoadedProblem) -> None:
        page = options.out / f"{basename(item.problem)}-live.html"
        words = language_of(item.problem, options.lang)
        problem = coloured(item.problem, options.colour)
        text = item.kind.live_page(problem, words)
        if options.construction:
            from planmethod.render.live.document import with_link
            from planmethod.render.play.page import play_page

            language = get_language(words)
            beside = options.out / f"{basename(item.problem)}-play.html"
            played = item.kind.playback(problem, language, PlanRequest())
            whole = with_link(
                play_page(problem, played, language), page.name, language.play.to_motion
            )
            write_text(whole, str(beside), folder=options.out)
            text = with_link(text, beside.name, language.play.title)
        write_text(text, str(page), folder=options.out)
        warn_each(item.problem, item.kind.accuracy_warnings(item.problem))
        written.append(page)

    code = for_each_problem(options.choice, write)
    if options.shown and written:
        show(written[0])
    finish(code)
