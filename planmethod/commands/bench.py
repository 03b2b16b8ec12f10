"""Command ``bench``: speed beside error, and the document of both."""

from __future__ import annotations

from pathlib import Path

import click

from planmethod.commands.problems import guarded


@click.command()
@click.argument("problems", nargs=-1, metavar="[PROBLEM]...", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    default=Path("docs"),
    show_default=True,
    help="Folder for speed-and-error.md and its figure.",
)
@click.option("--quick", is_flag=True, help="Smaller sizes, fewer runs: a look.")
@click.option(
    "--random",
    "count",
    type=click.IntRange(min=0, max=1_000_000),
    default=None,
    help="Random mechanisms before the referee; 10000, or 200 with --quick.",
)
@click.option(
    "--only",
    type=click.Choice(["speed", "forces", "hard", "random", "drafting"]),
    multiple=True,
    help="Print these sections instead of writing the document.",
)
@guarded
def bench(
    problems: tuple[Path, ...], out: Path, quick: bool, count: int | None, only: tuple[str, ...]
) -> None:
    """Measure speed and error and write docs/speed-and-error.md.

    The drafting errors are compared for each PROBLEM given. Everything together takes some
    minutes; the peers run when they are installed (pip install planmethod[bench]).
    """
    try:
        import mpmath  # noqa: F401  the judge of everything here
    except ImportError:
        raise click.UsageError(
            "the benchmark needs mpmath: pip install 'planmethod[bench]'"
        ) from None
    from planmethod.bench.whole import SECTIONS, make
    from planmethod.problem import load

    loaded = [load(path) for path in problems]
    wanted = only or SECTIONS
    if count is None:
        count = 200 if quick else 10_000

    def say(what: str) -> None:
        click.echo(f"measuring: {what}", err=True)

    text, figure = make(loaded, wanted, say, quick=quick, count=count)
    if only:
        click.echo(text, nl=False)
        return
    from planmethod.bench.report import NAME
    from planmethod.render.backends.output import write

    for name, data in ((f"{NAME}.md", text.encode()), (f"{NAME}.png", figure)):
        write(out / name, data)
        click.echo(str(out / name))
