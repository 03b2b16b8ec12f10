"""Command ``animate``: the mechanism moving, a GIF or an SVG for slides."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import click
from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.problems import (
    LoadedProblem,
    Loading,
    finish,
    for_each_problem,
    language_of,
)
from planmethod.commands.sheet_options import colour_option, coloured
from planmethod.options import (
    NO_FORMAT,
    NumberRange,
    ProblemChoice,
    basename,
    option,
    out_option,
    problem_lang_option,
    read_names,
    warn,
    warn_each,
)

FORMATS = ("gif", "svg")


class AnimateOptions(Struct, frozen=True, kw_only=True):
    """Options of ``animate``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    plans: bool = option("--plans", is_flag=True, help="Show the velocity plan beside the scheme.")
    frames: int = option(
        "--frames",
        type=click.IntRange(8, 360),
        default=60,
        show_default=True,
        help="Frames per turn.",
    )
    seconds: float = option(
        "--seconds", type=NumberRange(1, 60), default=6, show_default=True, help="Seconds per turn."
    )
    dpi: int = option(
        "--dpi",
        type=click.IntRange(30, 300),
        default=110,
        show_default=True,
        help="GIF resolution, dots per inch.",
    )
    formats: tuple[str, ...] = option(
        "--format",
        read=partial(read_names, known=FORMATS, empty_message=NO_FORMAT),
        default="gif,svg",
        show_default=True,
        help="gif,svg.",
    )
    colour: bool | None = colour_option()
    out: Path = out_option()
    lang: str | None = problem_lang_option()


@command(AnimateOptions)
def animate(options: AnimateOptions) -> None:
    """Write an animation of the mechanism for slides: GIF and self-playing SVG."""
    from planmethod.render.backends.output import write
    from planmethod.render.live.animation import make_animation

    def draw(item: LoadedProblem) -> None:
        problem = coloured(item.linkage, options.colour)
        lang = language_of(problem, options.lang)
        film = make_animation(problem, lang, frames=options.frames, plans=options.plans)
        warn_each(problem, item.kind.accuracy_warnings(problem))
        if film.skipped:
            warn(problem, film.skipped)
        made = {}
        for fmt in options.formats:
            path = options.out / f"{basename(problem)}-animated.{fmt}"
            if fmt == "gif":
                from planmethod.render.live.animation import gif

                made[path] = gif(film, options.seconds, options.dpi)
            else:
                made[path] = film.svg(options.seconds)
        for path, data in made.items():
            write(path, data, output_root=options.out)
            click.echo(str(path))

    finish(for_each_problem(options.choice, draw, loading=Loading(kinds=False)))
