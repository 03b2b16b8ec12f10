"""Command ``animate``: the mechanism moving, a GIF or an SVG for slides."""

from __future__ import annotations

from pathlib import Path

import click

from planmethod.commands.output import LocalizedCommand
from planmethod.commands.problems import (
    LoadedProblem,
    finish,
    for_each_problem,
    guarded,
    language_of,
)
from planmethod.options import (
    BadParameter,
    NumberRange,
    basename,
    out_option,
    problem_lang_option,
    problem_options,
    warn,
    warn_each,
)

FORMATS = ("gif", "svg")


def _formats(ctx: click.Context, param: click.Parameter, value: str) -> tuple[str, ...]:
    names = tuple(dict.fromkeys(n.strip().lower() for n in value.split(",") if n.strip()))
    for name in names:
        if name not in FORMATS:
            raise BadParameter("{!r} is not one of {}", name, ", ".join(FORMATS))
    if not names:
        raise BadParameter("no format given; choose from {}", ", ".join(FORMATS))
    return names


@click.command(cls=LocalizedCommand)
@problem_options
@click.option("--plans", is_flag=True, help="The velocity plan beside the scheme.")
@click.option(
    "--frames", type=click.IntRange(8, 360), default=60, show_default=True, help="Per turn."
)
@click.option("--seconds", type=NumberRange(1, 60), default=6, show_default=True, help="Per turn.")
@click.option(
    "--dpi",
    type=click.IntRange(30, 300),
    default=110,
    show_default=True,
    help="Resolution of a GIF.",
)
@click.option(
    "--format", "formats", callback=_formats, default="gif,svg", show_default=True, help="gif,svg."
)
@out_option
@problem_lang_option
@guarded
def animate(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    plans: bool,
    frames: int,
    seconds: float,
    dpi: int,
    formats: tuple[str, ...],
    out: Path,
    lang: str | None,
) -> None:
    """Write the mechanism as it moves, for slides: a GIF, and an SVG that plays by itself."""
    from planmethod.render.backends.output import write
    from planmethod.render.live.animation import make_animation

    def draw(item: LoadedProblem) -> None:
        problem = item.linkage
        film = make_animation(problem, language_of(problem, lang), frames=frames, plans=plans)
        warn_each(problem, item.kind.accuracy_warnings(problem))
        if film.skipped:
            warn(problem, film.skipped)
        made = {}
        for fmt in formats:
            path = out / f"{basename(problem)}-animated.{fmt}"
            if fmt == "gif":
                from planmethod.render.live.animation import gif

                made[path] = gif(film, seconds, dpi)
            else:
                made[path] = film.svg(seconds)
        for path, data in made.items():
            write(path, data, output_root=out)
            click.echo(str(path))

    finish(for_each_problem(problems, variant, all_variants, draw, kinds=False))
