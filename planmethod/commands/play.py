"""Command ``play``: the construction of a position, drawn stroke by stroke on a page."""

from __future__ import annotations

from pathlib import Path

import click
from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import json_text, show, write_text
from planmethod.commands.problems import LoadedProblem, finish, for_each_problem, language_of
from planmethod.options import (
    DraftingOptions,
    PlanRequest,
    Positions,
    ProblemChoice,
    basename,
    open_option,
    option,
    out_option,
    position_option,
    positions_option,
    problem_lang_option,
)


class PlayOptions(Struct, frozen=True, kw_only=True):
    """Options of ``play``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    phi: Positions | None = positions_option()
    drafting: DraftingOptions = field(default_factory=DraftingOptions)
    position: int | None = position_option(
        "Number of the position, from 0. Default: the calculated position of the project, or 0."
    )
    frames: bool = option(
        "--frames",
        is_flag=True,
        help="Also write an SVG picture of each step, and all steps as JSON.",
    )
    out: Path = out_option()
    lang: str | None = problem_lang_option()
    shown: bool = open_option()


@command(PlayOptions)
def play(options: PlayOptions) -> None:
    """Write an HTML page that draws the construction stroke by stroke, each with its sentence."""
    from planmethod.note.wording import get_language
    from planmethod.render.play.page import play_page

    request = PlanRequest(phi=options.phi, drafting=options.drafting, position=options.position)
    written: list[Path] = []

    def write(item: LoadedProblem) -> None:
        kind, problem = item.kind, item.problem
        language = get_language(language_of(problem, options.lang))
        kind.reject_options(problem, request)
        played = kind.playback(problem, language, request)
        page = options.out / f"{basename(problem)}-play.html"
        write_text(play_page(problem, played, language), str(page), folder=options.out)
        if options.frames:
            from planmethod.render.backends.output import write as save
            from planmethod.render.play.frames import frames, playback_record

            stem = options.out / f"{basename(problem)}-play"
            pictures = list(frames(played))
            for number, picture in enumerate(pictures, 1):
                file = Path(f"{stem}-{number:03d}.svg")
                save(file, picture.encode(), output_root=options.out)
            click.echo(f"{stem}-001.svg … {stem}-{len(pictures):03d}.svg")
            record = json_text(playback_record(played)) + "\n"
            write_text(record, f"{stem}.json", folder=options.out)
        written.append(page)

    code = for_each_problem(options.choice, write)
    if options.shown and written:
        show(written[0])
    finish(code)
