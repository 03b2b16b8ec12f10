"""Command ``teeth``: the choice of teeth for a ratio (подбор чисел зубьев)."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

import click

from planmethod.commands.output import LocalizedCommand, reject_unknown, write_new
from planmethod.commands.problems import finish, guarded
from planmethod.errors import ExitCode
from planmethod.options import BadParameter, PathType, UsageError, lang_option

if TYPE_CHECKING:
    from fractions import Fraction

MODULES = (1, 10_000)
"""Least and largest module, hundredths of a millimetre."""


def read_fraction(ctx: click.Context, param: click.Parameter, value: str | None) -> Fraction | None:
    """Return a number as a fraction: ``6.5``, ``13/2``."""
    from fractions import Fraction

    from planmethod.problem.formula import read_decimal

    if value is None:
        return None
    top, _, bottom = value.replace(",", ".").replace("−", "-").partition("/")
    one, other = read_decimal(top), read_decimal(bottom or "1")
    if one is None or not other:
        raise BadParameter("{!r} is not a number: 6.5 or 13/2 is expected", value)
    number = Fraction(one) / Fraction(other)
    if number.denominator > 10**6 or abs(number) > 10**6:
        raise BadParameter("{!r} has too many digits: at most six are expected", value)
    return number


def read_modules(
    ctx: click.Context, param: click.Parameter, value: str | None
) -> tuple[Fraction, Fraction] | None:
    """Return the modules of the rows: ``2``, or ``2,2.5``."""
    if value is None:
        return None
    read = (read_fraction(ctx, param, part) for part in value.split(","))
    found = [number for number in read if number is not None]
    if len(found) > 2 or not all(MODULES[0] <= 100 * m <= MODULES[1] for m in found):
        raise BadParameter("{!r}: one or two modules in mm are expected, 2 or 2,2.5", value)
    if any((m * 1000).denominator != 1 for m in found):
        raise BadParameter("{!r}: a module has at most three decimals", value)
    return found[0], found[-1]


@click.command(cls=LocalizedCommand)
@click.option(
    "--scheme",
    default="ring",
    show_default=True,
    help="ring, external-internal, two-external, two-internal, pair or two-stage.",
)
@click.option(
    "--U",
    "--u",
    "ratio",
    required=True,
    callback=read_fraction,
    help="Ratio, with its sign: 6.5 or 13/2.",
)
@click.option(
    "--satellites",
    "-k",
    type=click.IntRange(1, 24),
    default=3,
    show_default=True,
    help="Number of satellites.",
)
@click.option("--z-min", type=click.IntRange(6, 400), default=17, show_default=True)
@click.option("--z-max", type=click.IntRange(6, 400), default=120, show_default=True)
@click.option(
    "--ring-max",
    type=click.IntRange(6, 400),
    default=250,
    show_default=True,
    help="Largest number of teeth of wheels with internal teeth.",
)
@click.option(
    "--within",
    default="0.02",
    show_default=True,
    callback=read_fraction,
    help="Allowed share of U, both ways; 0 for U itself.",
)
@click.option(
    "--modules",
    callback=read_modules,
    help="Module in mm, or those of the two rows: 2,2.5. Default: the same for both.",
)
@click.option(
    "--count",
    type=click.IntRange(0),
    default=20,
    show_default=True,
    help="How many sets are listed; 0 for all.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
@click.option(
    "--write",
    nargs=2,
    type=(PathType(dir_okay=False), click.IntRange(1)),
    metavar="FILE N",
    help="Write the problem file of set N.",
)
@click.option("--force", is_flag=True, help="Write over an existing file.")
@lang_option
@guarded
def teeth(
    scheme: str,
    ratio: Fraction,
    satellites: int,
    z_min: int,
    z_max: int,
    ring_max: int,
    within: Fraction,
    modules: tuple[Fraction, Fraction] | None,
    count: int,
    as_json: bool,
    write: tuple[Path, int] | None,
    force: bool,
    lang: str,
) -> None:
    """Find all sets of teeth for a ratio (подбор чисел зубьев).

    Every combination within the bounds is checked for coaxiality, assembly, neighbourhood and
    interference of standard teeth; the smallest sets come first, equal ones by distance from U.
    U means U_1_H for ring and external-internal, U_H_1 for two-external and two-internal,
    U_1_2 for pair, U_1_3 for two-stage. Exit code 1 if no set fits. More: docs/gears.md.
    """
    from planmethod.gears.teeth import SCHEMES, TeethSpecification
    from planmethod.gears.teeth_selection import (
        choose,
        problem_text,
        selection_document,
        selection_record,
    )
    from planmethod.note.document import Document
    from planmethod.note.wording import get_language
    from planmethod.note.writers.terminal import plain_document

    reject_unknown("no scheme {!r}", scheme, [one.name for one in SCHEMES])
    if ratio == 0 or not 0 <= within < 1:
        raise UsageError("--U is not 0, and --within is at least 0 and below 1")
    if z_min > z_max:
        raise UsageError("--z-min {} is more than --z-max {}", z_min, z_max)
    (plan,) = (one for one in SCHEMES if one.name == scheme)
    if plan.single and modules is not None and modules[0] != modules[1]:
        raise UsageError("the scheme {} has one row of teeth: give one module", scheme)
    wanted = TeethSpecification(plan, ratio, within, satellites, z_min, z_max, ring_max, modules)
    number = 0 if write is None else write[1]
    chosen = choose(wanted, first=max(count, number) if count else None)
    if write is not None and number > chosen.match_count:
        raise UsageError("set {} does not exist: {} were found", number, chosen.match_count)
    if as_json:
        click.echo(json.dumps(selection_record(chosen), ensure_ascii=False, indent=1))
    else:
        language = get_language(lang)
        click.echo(plain_document(Document.of(selection_document(chosen, language)), language))
    if write is not None:
        write_new(write[0], problem_text(chosen, number, lang), force=force)
    finish(ExitCode.DONE if chosen.match_count else ExitCode.FINDINGS)
