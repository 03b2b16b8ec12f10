"""Command ``teeth``: the choice of teeth for a ratio (подбор чисел зубьев)."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from msgspec import Struct

from planmethod.commands.command import command
from planmethod.commands.output import reject_unknown, write_new
from planmethod.commands.problems import finish
from planmethod.errors import ExitCode
from planmethod.options import (
    BadParameter,
    PathType,
    UsageError,
    force_option,
    json_option,
    lang_option,
    option,
)

if TYPE_CHECKING:
    from fractions import Fraction

MODULES = (1, 10_000)
"""Least and largest module, hundredths of a millimetre."""


def read_fraction(value: str) -> Fraction:
    """Return a number as a fraction: ``6.5``, ``13/2``."""
    from fractions import Fraction

    from planmethod.problem.formula import read_decimal

    top, _, bottom = value.replace(",", ".").replace("−", "-").partition("/")
    one, other = read_decimal(top), read_decimal(bottom or "1")
    if one is None or not other:
        raise BadParameter("{!r} is not a number: 6.5 or 13/2 is expected", value)
    number = Fraction(one) / Fraction(other)
    if number.denominator > 10**6 or abs(number) > 10**6:
        raise BadParameter("{!r} has too many digits: at most six are expected", value)
    return number


def read_modules(value: str) -> tuple[Fraction, Fraction]:
    """Return the modules of the rows: ``2``, or ``2,2.5``."""
    found = [read_fraction(part) for part in value.split(",")]
    if len(found) > 2 or not all(MODULES[0] <= 100 * m <= MODULES[1] for m in found):
        raise BadParameter("{!r}: one or two modules in mm are expected, 2 or 2,2.5", value)
    if any((m * 1000).denominator != 1 for m in found):
        raise BadParameter("{!r}: a module has at most three decimals", value)
    return found[0], found[-1]


def _teeth_option(flag: str, default: int, help_text: str) -> Any:
    """Declare a number of teeth."""
    return option(
        flag, type=click.IntRange(6, 400), default=default, show_default=True, help=help_text
    )


class TeethOptions(Struct, frozen=True, kw_only=True):
    """Options of ``teeth``."""

    scheme: str = option(
        "--scheme",
        default="ring",
        show_default=True,
        help="ring, external-internal, two-external, two-internal, pair or two-stage.",
    )
    ratio: Fraction = option(
        "--U",
        "--u",
        required=True,
        read=read_fraction,
        help="Ratio, with its sign: 6.5 or 13/2.",
    )
    satellites: int = option(
        "--satellites",
        "-k",
        type=click.IntRange(1, 24),
        default=3,
        show_default=True,
        help="Number of planets.",
    )
    z_min: int = _teeth_option("--z-min", 17, "Minimum number of teeth.")
    z_max: int = _teeth_option("--z-max", 120, "Maximum number of teeth of external gears.")
    ring_max: int = _teeth_option("--ring-max", 250, "Maximum number of teeth of internal gears.")
    tolerance: Fraction = option(
        "--within",
        default="0.02",
        show_default=True,
        read=read_fraction,
        help="Allowed deviation as a fraction of U, both ways; 0 for U itself.",
    )
    modules: tuple[Fraction, Fraction] | None = option(
        "--modules",
        read=read_modules,
        help="Module in mm, or the modules of the two rows: 2,2.5. Default: equal modules.",
    )
    count: int = option(
        "--count",
        type=click.IntRange(0),
        default=20,
        show_default=True,
        help="Number of sets to list; 0 for all.",
    )
    as_json: bool = json_option("Print one JSON object.")
    write: tuple[Path, int] | None = option(
        "--write",
        nargs=2,
        type=(PathType(dir_okay=False), click.IntRange(1)),
        metavar="FILE N",
        help="Write the problem file of set N.",
    )
    force: bool = force_option()
    lang: str = lang_option()


@command(TeethOptions, findings="No set of teeth within the bounds gives the ratio.")
def teeth(options: TeethOptions) -> None:
    """Find all sets of tooth numbers for a ratio (подбор чисел зубьев).

    Every combination within the bounds is checked for coaxiality, assembly, neighbourhood and
    interference of standard teeth. The smallest sets come first, equal ones by distance from U.
    U means U_1_H for ring and external-internal, U_H_1 for two-external and two-internal,
    U_1_2 for pair, U_1_3 for two-stage. Exit code 1 if no set fits. More: docs/how-to/gears.md.
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

    reject_unknown("no scheme {!r}", options.scheme, [one.name for one in SCHEMES])
    if options.ratio == 0 or not 0 <= options.tolerance < 1:
        raise UsageError("--U must not be 0, and --within must be from 0 to below 1")
    if options.z_min > options.z_max:
        raise UsageError("--z-min {} is more than --z-max {}", options.z_min, options.z_max)
    (plan,) = (one for one in SCHEMES if one.name == options.scheme)
    modules = options.modules
    if plan.single and modules is not None and modules[0] != modules[1]:
        raise UsageError("the scheme {} has one row of teeth: give one module", options.scheme)
    wanted = TeethSpecification(
        plan, options.ratio, options.tolerance, options.satellites,
        options.z_min, options.z_max, options.ring_max, modules,
    )  # fmt: skip
    path, number = options.write or (None, 0)
    chosen = choose(wanted, first=max(options.count, number) if options.count else None)
    if number > chosen.match_count:
        raise UsageError("set {} does not exist: {} were found", number, chosen.match_count)
    if options.as_json:
        click.echo(json.dumps(selection_record(chosen), ensure_ascii=False, indent=1))
    else:
        language = get_language(options.lang)
        click.echo(plain_document(Document.of(selection_document(chosen, language)), language))
    if path is not None:
        write_new(path, problem_text(chosen, number, options.lang), force=options.force)
    finish(ExitCode.DONE if chosen.match_count else ExitCode.FINDINGS)
