"""Numbers as they are written on a sheet, a terminal, in a record: digits, decimal sign, units."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import SupportsFloat

from msgspec import Struct

MINUS = "−"


ZERO_TOLERANCE = 1e-12
"""Default size below which a number is a rounded zero."""


def significant(value: float, digits: int = 4, *, zero_limit: float = ZERO_TOLERANCE) -> str:
    """Return a number with a decimal point and ``digits`` significant digits, without an exponent.

    Very large and very small numbers, which would need a row of zeros, keep an ``e``. A value
    smaller than ``zero_limit`` is 0.
    """
    if not math.isfinite(value):
        return "—"
    if abs(value) < zero_limit or value == 0.0:
        return "0"
    power = math.floor(math.log10(abs(value)))
    rounded = half_up(value, digits - 1 - power)
    if rounded != 0:
        power = math.floor(math.log10(abs(rounded)))
    if not -4 <= power <= 6:
        return f"{value:.{digits - 1}e}"
    return f"{rounded:.{max(0, digits - 1 - power)}f}"


def half_up(value: float, decimals: int) -> float:
    """Return a value rounded to a number of decimals, a half away from zero.

    A value that is a half but for binary rounding counts as a half: 147.15 gives 147.2.
    """
    return round(value * (1.0 + _HALF), decimals)


_HALF = 4e-15
"""Share of a value by which it may be short of a half."""


def trimmed(value: float, digits: int | None = None, *, zero_limit: float = ZERO_TOLERANCE) -> str:
    """Return a given number as the problem writes it: no more digits than it has.

    Default for ``digits``: all that it has, to eight; for a number that has more, four, zeros
    among them, and at least two decimals, as angles have. One in a hundred numbers of sixteen
    digits is one of ten within its rounding, one in ten thousand one of eight.
    """
    text = significant(value, digits or 6, zero_limit=zero_limit)
    if digits is None and math.isfinite(value):
        longer = (significant(value, n, zero_limit=zero_limit) for n in range(6, 9))
        text = next((t for t in longer if abs(float(t) - value) <= 1e-12 * abs(value)), "")
        if not text:
            return (
                significant(value, zero_limit=zero_limit)
                if abs(value) < 100.0
                else f"{half_up(value, 2):.2f}"
            )
    mantissa, e, power = text.partition("e")
    return f"{mantissa.rstrip('0').rstrip('.') if '.' in mantissa else mantissa}{e}{power}"


def rich_number(text: str, decimal: str) -> str:
    """Return a plain number as rich text: decimal sign, minus sign, power of ten, dash of NaN."""
    if text.endswith(("nan", "inf")):
        return "—"
    mantissa, e, power = text.partition("e")
    if not mantissa.strip("-0."):
        mantissa = mantissa.lstrip("-")  # no sign before zero
    mantissa = mantissa.replace(".", decimal).replace("-", MINUS)
    if not e:
        return mantissa
    mark = power.lstrip("+-0123456789")
    exponent = str(int(power.removesuffix(mark))).replace("-", MINUS)
    return f"{mantissa}·10^{{{exponent}}}{mark}"


def raised(unit: str) -> str:
    """Return a unit of plain text as rich text: ``m/s²`` gives ``m/s^{2}``."""
    return re.sub(_POWER, lambda power: f"^{{{power[0].translate(_LEVEL)}}}", unit)


_POWER, _LEVEL = "[⁻¹²]+", str.maketrans("⁻¹²", f"{MINUS}12")


class Notation(Struct, frozen=True, eq=False):
    """How a language writes numbers, units and symbols, as rich text (запись чисел).

    Attributes
    ----------
    decimal : str
        Decimal sign.
    units : mapping
        Letters of the units, by those of SI: ``N``, ``N·m``, ``mm``.
    symbols : mapping
        Letters of quantities that the plans name by their role: the balancing moment.
    degrees : str
        Degrees in the head of a table, where the bare sign is unusual.
    """

    decimal: str
    units: Mapping[str, str]
    symbols: Mapping[str, str]
    degrees: str

    def in_head(self, unit: str) -> str:
        """Return a unit as the head of a table has it."""
        return self.degrees if unit == "deg" else self.units[unit]

    def number(self, text: str) -> str:
        """Return a plain number."""
        return rich_number(text, self.decimal)

    def numbers(self, *texts: str) -> list[str]:
        """Return plain numbers, cells of a row."""
        return [self.number(text) for text in texts]

    def symbol(self, name: str) -> str:
        """Return the letters of a quantity of the plans: its own, or those of its role.

        An index follows those of the role: ``friction force of 30``.
        """
        role, of, index = name.partition(" of ")
        if of and role in self.symbols:
            return f"{self.symbols[role].removesuffix('}')}{index}}}"
        return self.symbols.get(name, name)

    def as_input(self, value: float, *, zero_limit: float = ZERO_TOLERANCE) -> str:
        """Return a given number, as the problem writes it; one below ``zero_limit`` is 0."""
        return self.number(trimmed(value, zero_limit=zero_limit))

    def crank_angle(self, degrees: float) -> str:
        """Return an angle of a crank within a turn, with at most two decimals, as everywhere."""
        return self.as_input(round(degrees % 360.0, 2) % 360.0)

    def computed(self, value: float) -> str:
        """Return a computed number, four digits of it."""
        return self.number(significant(value))

    def short(self, value: float, digits: int = 5) -> str:
        """Return a number for use in a formula, with at most ``digits`` digits."""
        return self.number(trimmed(value, digits))

    def measured(self, value: float) -> str:
        """Return a length that a ruler has measured, mm; of a finer ruler with more digits.

        A length not measured with a ruler, but laid off, has four digits as any computed number.
        """
        for decimals in (1, 2):
            text = f"{value:.{decimals}f}"
            if abs(float(text) - value) <= 1e-6 * abs(value):
                return self.number(text)
        return self.computed(value)


def in_heads(
    columns: Iterable[tuple[str, str, Sequence[str]]], notation: Notation
) -> Iterator[tuple[str, str, Sequence[str]]]:
    """Yield columns of head, unit of SI or none, and cells, their units as heads of tables have."""
    for head, unit, cells in columns:
        yield head, notation.in_head(unit) if unit else "", cells


def with_unit(number: str, unit: str) -> str:
    """Return a written number with its unit: ``20°``, ``0.1 m``."""
    return f"{number}{unit}" if unit == "°" else f"{number} {unit}"


def record_float(value: SupportsFloat) -> float:
    """Return a float for a record, without a negative zero."""
    return float(value) + 0.0


def finite_or_none(value: SupportsFloat) -> float | None:
    """Return a float for a record; None (null) for a value that a drawing cannot give."""
    return record_float(value) if math.isfinite(value) else None


def is_negligible(value: float, peak: float) -> bool:
    """Return whether a value is negligible beside the largest of its kind: no plan shows it."""
    return abs(value) <= 1e-5 * abs(peak)


def is_noise(value: float, peak: float) -> bool:
    """Return whether a value of a table is a rounded zero beside the largest of its kind.

    A small value is a result as well: near a dead position others are a million times larger.
    """
    return abs(value) <= 1e-9 * abs(peak)


def format_column(values: Sequence[float], digits: int = 4) -> list[str]:
    """Return the numbers of one column with a common number of decimals.

    The largest has ``digits`` significant digits; zeros are a plain 0. Where that would leave
    small values without significant digits, each number keeps its own decimals.
    """
    sizes = sorted(abs(value) for value in values if value and math.isfinite(value))
    largest = sizes[-1] if sizes else 0.0
    model = significant(largest, digits)
    if "e" in model or len(sizes) < 2 or largest > 30 * sizes[len(sizes) // 2]:
        return [significant(value, digits) for value in values]
    decimals = len(model.partition(".")[2])
    return [to_decimals(value, decimals, digits) if value else "0" for value in values]


def decimals_of(text: str) -> int:
    """Return the number of digits behind the decimal point."""
    return len(text.partition(".")[2])


def to_decimals(value: float, decimals: int, digits: int = 4) -> str:
    """Return a number with a number of decimals; for none, with at most ``digits`` digits.

    >>> to_decimals(147.15, 1), to_decimals(85.2, 0), to_decimals(233333.3, 0)
    ('147.2', '85', '233300')
    """
    whole = not decimals and math.isfinite(value)
    shown = float(significant(value, digits)) if whole else value
    return f"{half_up(shown, decimals) + 0.0:.{decimals}f}"


def signed_sum(terms: Sequence[tuple[float, str]]) -> str:
    """Return terms with their signs; a positive one first, if there is any."""
    ordered = sorted(terms, key=lambda term: term[0] < 0)
    text = ""
    for value, term in ordered:
        sign = MINUS if value < 0 else "+"
        text += f" {sign} {term}" if text else (f"{MINUS}{term}" if value < 0 else term)
    return text
