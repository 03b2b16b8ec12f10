"""Command ``variants``: variants of a task chosen by the program (подбор вариантов)."""

from __future__ import annotations

from pathlib import Path

import click
from msgspec import Struct

from planmethod.commands.command import command
from planmethod.commands.output import bar
from planmethod.commands.problems import finish
from planmethod.errors import ExitCode
from planmethod.languages import translate
from planmethod.options import (
    NumberRange,
    PathType,
    UsageError,
    argument,
    lang_option,
    option,
    settings_option,
)

MAX_VARIANTS = 200
LONG = 3
"""Number of variants from which a bar is shown."""


class VariantsOptions(Struct, frozen=True, kw_only=True):
    """Options of ``variants``."""

    problem: Path = argument(type=PathType(dir_okay=False), metavar="FILE")
    count: int = option(
        "--count",
        type=click.IntRange(1, MAX_VARIANTS),
        default=30,
        show_default=True,
        help="Number of variants.",
    )
    seed: int = option(
        "--seed",
        type=click.IntRange(0),
        default=1,
        show_default=True,
        help="Seed: the same seed gives the same variants.",
    )
    vary: str = option(
        "--vary",
        default="",
        metavar="KEY,…",
        help="Numbers to vary: links.1.OA,driver.phi=0..90. Default: the usual numbers.",
    )
    spread: float = option(
        "--spread",
        type=NumberRange(0.02, 0.9),
        default=0.3,
        show_default=True,
        help="Largest relative deviation from the file's value, for numbers without a range.",
    )
    tries: int | None = option(
        "--tries",
        type=click.IntRange(1, 1_000_000),
        help="Maximum number of candidates. Default: 300 for each variant.",
    )
    settings_file: Path | None = settings_option("TOML file with the department's tolerances.")
    out: Path | None = option(
        "-o",
        "--out",
        type=PathType(dir_okay=False),
        metavar="FILE",
        help="Write a table *.csv, or the problem file with its variants, *.toml. "
        "Default: print the table.",
    )
    lang: str = lang_option()


@command(VariantsOptions, findings="Fewer variants than requested were found.")
def variants(options: VariantsOptions) -> None:
    """Find equivalent variants of a task (подбор вариантов).

    Lengths of links, position and speed of the driving link, loads, teeth and numbers in formulas
    get round values. Each variant assembles with a margin, and its segments are long enough to
    measure. A copied variant loses most of the points. Each variant can show the mistakes that the
    task shows. Rejected candidates are reported. Exit code 1 if fewer variants are found. More:
    docs/how-to/variants.md.
    """
    from planmethod.check.marks import DEFAULT, load_settings
    from planmethod.note.document import Document
    from planmethod.note.wording import get_language
    from planmethod.note.writers.terminal import plain_document
    from planmethod.render.backends.output import write
    from planmethod.varying.choice import VariantSearch, choose, report_choice
    from planmethod.varying.parameters import csv_of

    problem, out, lang = options.problem, options.out, options.lang
    if out is not None and out.suffix.lower() not in (".csv", ".toml"):
        raise UsageError("{}: a table *.csv or a problem file *.toml is written", out)
    if out is not None and out.exists() and out.samefile(problem):
        raise UsageError("{} is the problem file itself; name another one", out)
    judged = DEFAULT if options.settings_file is None else load_settings(options.settings_file)
    with bar(options.count, long=options.count >= LONG) as done:
        search = VariantSearch(
            count=options.count, seed=options.seed, vary=options.vary, spread=options.spread,
            tries=options.tries,
        )  # fmt: skip
        source, choice = choose(problem, search, settings=judged, done=done)
    found = {one.name: one.overrides for one in choice.variants}
    language = get_language(lang)
    if out is None or out.suffix.lower() == ".csv":
        text = csv_of(found, lang)
    else:
        text = source.with_variants(found)
    if out is None:
        click.echo(text, nl=False)
    else:
        write(out, text.encode())
        click.echo(str(out))
    click.echo(
        plain_document(Document.of(report_choice(choice, language)), language), err=out is None
    )
    if out is not None and out.suffix.lower() == ".csv":
        click.echo(translate('The file names it at its head: variants = "{}"', out.name))
    finish(ExitCode.DONE if len(found) == options.count else ExitCode.FINDINGS)
