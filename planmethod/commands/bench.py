"""Command ``bench``: speed beside error of one's own problems."""

from __future__ import annotations

from importlib import import_module

import click
from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.problems import LoadedProblem, Loading, finish, for_each_problem
from planmethod.languages import translate
from planmethod.options import ProblemChoice, UsageError, option

SECTIONS = ("speed", "forces", "drafting", "cycle", "machine", "checking")


class BenchOptions(Struct, frozen=True, kw_only=True):
    """Options of ``bench``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    only: tuple[str, ...] = option(
        "--only",
        type=click.Choice(SECTIONS),
        multiple=True,
        help="Only these sections of the report.",
    )
    works: int = option(
        "--works",
        type=click.IntRange(1, 10_000),
        default=20,
        show_default=True,
        help="Number of simulated submissions without mistakes for each PROBLEM; a tenth "
        "of it with each mistake.",
    )
    seed: int | None = option(
        "--seed",
        type=click.IntRange(0),
        help="With checking, in a checkout of the repository: also check the simulated students "
        "of benchmarks/checking, with this seed.",
    )


def _students(seed: int, works: int) -> list[str]:
    """Return the tables of the repository's own students, which the package does not contain."""
    try:
        checking = import_module("benchmarks.checking")
    except ModuleNotFoundError:
        raise UsageError(
            "--seed needs benchmarks/checking: run bench in a checkout of the repository"
        ) from None
    return checking.section(seed, works)  # type: ignore[no-any-return]


@command(BenchOptions)
def bench(options: BenchOptions) -> None:
    """Measure speed and accuracy on problems, and print tables in Markdown.

    The sections compare sweeps, single positions and ruler readings with 50-digit results;
    expected drafting errors with those of random sheets; graphical differentiation and
    integration, by the number of positions; flywheels by construction with exact ones; and check
    submissions drawn at random. Each PROBLEM takes some seconds.
    """
    wanted = [name for name in SECTIONS if name in (options.only or SECTIONS)]
    if set(wanted) & {"speed", "forces"}:
        try:
            import mpmath  # noqa: F401  the judge
        except ImportError:
            raise UsageError(
                "bench needs mpmath: pip install mpmath; --only drafting, "
                "cycle, machine and checking do not"
            ) from None
    items: list[LoadedProblem] = []
    loading = Loading(kinds=wanted == ["checking"])  # trains and points are checked, too
    finish(for_each_problem(options.choice, items.append, loading=loading))
    from planmethod.bench import report

    for name in wanted:
        click.echo(translate("measuring: {}", name), err=True)
        if name == "checking":
            found = [(one.kind, one.problem) for one in items]
            section = report.checking_section(found, options.works)
            if options.seed is not None:
                section += ["", *_students(options.seed, options.works)]
        else:
            section = report.SECTIONS[name]([one.linkage for one in items])
        if section:
            click.echo("\n".join([*section, ""]))
