"""Command ``python -m benchmarks``: measure, and write benchmarks/reports/speed-and-error.md."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

import click

from benchmarks import report
from benchmarks.peers import missing
from benchmarks.whole import SECTIONS, make
from planmethod.commands.command import guarded
from planmethod.problem import load
from planmethod.render.backends.output import write


@click.command()
@click.argument("problems", nargs=-1, metavar="[PROBLEM]...", type=click.Path(path_type=Path))
@click.option(
    "-o",
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    default=Path("benchmarks/reports"),
    show_default=True,
    help="Folder for speed-and-error.md and its figure.",
)
@click.option("--quick", is_flag=True, help="Smaller sizes, fewer runs: a look.")
@click.option(
    "--random",
    "count",
    type=click.IntRange(min=0, max=1_000_000),
    default=None,
    help="Random mechanisms before the referee; 5000, or 200 with --quick.",
)
@click.option(
    "--only",
    type=click.Choice(SECTIONS),
    multiple=True,
    help="Print these sections instead of writing the document.",
)
@guarded
def main(
    problems: tuple[Path, ...], out: Path, quick: bool, count: int | None, only: tuple[str, ...]
) -> None:
    """Measure speed and error and write benchmarks/reports/speed-and-error.md.

    The drafting errors are compared for each PROBLEM given. Everything together takes some
    minutes; the peers run when they are installed (pip install -e '.[bench]').
    """
    if find_spec("mpmath") is None:
        raise click.UsageError("mpmath, the judge, is missing: pip install -e '.[bench]'")
    if missing() and not (only or quick):
        lost = " ".join(missing())
        raise click.UsageError(f"{lost} Install them with make bench, or look with --quick.")
    loaded = [load(path) for path in problems]
    if count is None:
        count = 200 if quick else 5_000

    def say(what: str) -> None:
        click.echo(f"measuring: {what}", err=True)

    text, figure = make(loaded, only or SECTIONS, say, quick=quick, count=count)
    if only:
        click.echo(text, nl=False)
        return
    for name, data in ((f"{report.NAME}.md", text.encode()), (f"{report.NAME}.png", figure)):
        write(out / name, data)
        click.echo(str(out / name))


if __name__ == "__main__":  # worker processes import this module
    main()
