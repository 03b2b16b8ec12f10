"""A number from a drawing beside the exact one: its error, digits, and how it is written."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from math import inf, isfinite
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from planmethod.note.formula import Rich
from planmethod.note.numbers import (
    ZERO_TOLERANCE,
    Notation,
    decimals_of,
    format_column,
    is_noise,
    significant,
    to_decimals,
)

if TYPE_CHECKING:
    from planmethod.solved.errors.spread import Spread
    from planmethod.solved.reading import Reals


TWO_DIGITS = 2.95
"""Leading digits of an error up to which it has two significant digits, beyond them one."""


def _place(sigma: float) -> int:
    """Return the power of ten of the last digit that an error is written with."""
    power = math.floor(math.log10(sigma))
    return power - 1 if sigma / 10.0**power < TWO_DIGITS else power


def _needs_no_exponent(sigma: float) -> bool:
    """Return whether an error is written without a power of ten."""
    return math.isfinite(sigma) and 1e-6 <= sigma < 1e6


def sigma_text(sigma: float, *, zero_limit: float = ZERO_TOLERANCE) -> str:
    """Return an error with a decimal point: two digits when it begins with 1 or 2, else one.

    >>> [sigma_text(s) for s in (0.0881, 0.1416, 17.73, 430.0, 0.0)]
    ['0.09', '0.14', '18', '400', '0']
    """
    if sigma == 0.0 or not _needs_no_exponent(sigma):
        return significant(sigma, 2, zero_limit=zero_limit)
    place = _place(sigma)
    return f"{round(sigma, -place):.{max(0, -place)}f}"


def rounded_to(value: float, sigma: float, *, zero_limit: float = ZERO_TOLERANCE) -> str:
    """Return a value up to the last digit of its error; to four digits when it has none.

    >>> rounded_to(3.9251, 0.0881), rounded_to(1234.5, 56.0)
    ('3.93', '1230')
    """
    if sigma == 0.0 or not _needs_no_exponent(sigma):
        return significant(value, zero_limit=zero_limit)
    place = _place(sigma)
    return f"{round(value, -place) + 0.0:.{max(0, -place)}f}"


def as_long(text: str, value: float, sigma: float) -> str:
    """Return the text of an exact value with no fewer decimals than its error has."""
    longer = rounded_to(value, sigma) if value and sigma else text
    return longer if len(longer.partition(".")[2]) > len(text.partition(".")[2]) else text


DASH = "—"
"""Placeholder for a missing number."""

MAX_PERCENT = 100.0
"""Error in per cent from which a reading is meaningless: the segment is too short."""

DRAWN = "*"
"""Mark of a sigma that was found by random draws, first order failing there."""


def sense_of(value: float) -> int:
    """Return 1 counterclockwise, -1 clockwise, 0 for zero (направление)."""
    return (value > 0) - (value < 0)


def percent_text(percent: float | None, decimals: int = 1, limit: float = inf) -> str:
    """Return per cent as plain text; a dash for None, and for `limit` or more.

    >>> percent_text(-0.04), percent_text(None), percent_text(-1.255, 2), percent_text(240.0)
    ('0.0', '—', '-1.25', '240.0')
    """
    if percent is None or not abs(percent) < limit:
        return DASH
    return f"{round(percent, decimals) + 0.0:.{decimals}f}"


class ComparedNumber(Struct, frozen=True):
    """A number beside the reference that it is compared with (сравниваемое число).

    Usually a reading from a drawing beside the exact value; also a result of the lever beside that
    of the force plans, or a printed value. Both are in one unit.

    Attributes
    ----------
    exact, read : float
    sigma : float
        One sigma of ``read``; 0 for a given value, which was not drawn.
    mark : str
        The mark of a sigma that was found by random draws.
    zero_limit : float
        The size up to which ``exact`` counts as zero, without an error in per cent.
    """

    exact: float
    read: float
    sigma: float = 0.0
    mark: str = ""
    zero_limit: float = 0.0

    @property
    def off(self) -> float:
        """Δ: error of the reading, read minus exact."""
        return self.read - self.exact

    @property
    def percent(self) -> float | None:
        """Δ in per cent of the exact value, with the sign that the two numbers give.

        It is negative for a reading that is too small, clockwise as well as counterclockwise. None
        where the exact value is zero, or one of the two is not finite.
        """
        if not abs(self.exact) > self.zero_limit:
            return None
        percent = 100.0 * self.off / self.exact
        return percent if isfinite(percent) else None

    @property
    def size_off(self) -> float:
        """Δ between magnitudes that have their senses beside them, positive along the exact one."""
        return -self.off if self.exact < 0 else self.off

    @property
    def percent_size(self) -> float:
        """Magnitude of Δ, per cent of the exact value; 0 where it is undefined."""
        return abs(self.percent or 0.0)

    def percent_of(self, reference: float) -> float:
        """Return the magnitude of Δ, per cent of another value than the exact one."""
        return 100.0 * abs(self.off) / reference

    @property
    def expected(self) -> float | None:
        """Sigma in per cent of the exact value; None where that is zero."""
        return 100.0 * self.sigma / abs(self.exact) if self.exact else None

    @property
    def sigmas(self) -> float:
        """The size of Δ, in sigmas."""
        return abs(self.off) / self.sigma if self.sigma else 0.0

    def unless_lost(self) -> ComparedNumber:
        """Return the same, without an error in per cent where the exact value is lost in sigma."""
        return replace(self, zero_limit=self.sigma)

    # Plain text -------------------------------------------------------------------------------

    @property
    def exact_text(self) -> str:
        """The exact value, four digits."""
        return significant(self.exact)

    @property
    def read_text(self) -> str:
        """The reading, as many digits as the exact value has: for tables that have Δ as well."""
        return significant(self.read)

    @property
    def rounded_text(self) -> str:
        """The reading up to the last digit of its error; a dash where nothing can be read."""
        return rounded_to(self.read, self.sigma) if isfinite(self.read) else DASH

    def text_beside(self, exact: str, *, signed: bool = True) -> str:
        """Return the reading with the decimals of the exact value's text, unless that is zero.

        Zeros at its end are not finer than the error. ``signed``: with its sign before it.
        """
        value = self.read if signed else abs(self.read)
        if exact == "0" or "e" in exact:
            text = rounded_to(value, self.sigma)
        else:
            text = to_decimals(value, decimals_of(exact))
        while text.endswith("0") and decimals_of(text) > decimals_of(sigma_text(self.sigma)):
            text = text[:-1].removesuffix(".")
        return text

    @property
    def size_text(self) -> str:
        """The same without its sign, where a sense beside it has that."""
        return self.rounded_text.removeprefix("-")

    @property
    def sigma_text(self) -> str:
        """Sigma with its mark; a dash where it is not finite."""
        return sigma_text(self.sigma) + self.mark if isfinite(self.sigma) else DASH

    @property
    def texts(self) -> tuple[str, str, str]:
        """Exact value, reading and sigma: a row of a table without Δ."""
        return self.exact_text, self.rounded_text, self.sigma_text

    @property
    def off_text(self) -> str:
        """Δ in the unit of the number, two digits."""
        return significant(self.off, 2)

    def part_text(self, part: float, decimals: int) -> str:
        """Return Δ or a part of it in per cent of the exact value, with its sign before it."""
        return f"{100.0 * part / self.exact:+.{decimals}f}"

    def percent_text(self, decimals: int = 1, limit: float = inf) -> str:
        """Return Δ in per cent; a dash where it is undefined, and from `limit` on."""
        return percent_text(self.percent, decimals, limit)


def no_spread() -> None:
    """Return the spread of given values, which are laid off and not read: none."""


class Series(Struct, frozen=True, eq=False, dict=True):
    """A quantity over positions (ряд значений); readings and errors are computed on demand.

    Attributes
    ----------
    symbol : Rich
    unit : str
        As in `Notation.units`; empty of a ratio.
    exact : array of float, shape (n,)
    reads : callable
        Returns the values read off the drawing, shape (n,).
    errors : callable
        Returns their drafting errors; None for given values, which have none.
    turns : bool
        Its sign is a sense of turning, shown beside its magnitude; else it is before the number.
    peak : float
        The largest magnitude among those shown with it; rounding noise beside it is zero.
    label : str
        Its name among the quantities of the drawing.
    """

    symbol: Rich
    unit: str
    exact: Reals
    reads: Callable[[], Reals]
    errors: Callable[[], Spread | None] = no_spread
    turns: bool = False
    peak: float = 0.0
    label: str = ""

    @cached_property
    def read(self) -> Reals:
        """Values read off the drawing."""
        return self.reads()

    @cached_property
    def spread(self) -> Spread | None:
        """Their drafting errors; None for given values."""
        return self.errors()

    @property
    def sigma(self) -> Reals | Sequence[float]:
        """One sigma in every position; zeros for given values."""
        return [0.0] * len(self.exact) if self.spread is None else self.spread.sigma

    @property
    def off(self) -> Reals:
        """Δ: errors of the readings, read minus exact."""
        return self.reads() - self.exact

    def head(self, notation: Notation) -> Rich:
        """Return the symbol with the unit."""
        symbol = notation.symbol(self.symbol)
        return f"{symbol}, {notation.in_head(self.unit)}" if self.unit else symbol

    # One position -----------------------------------------------------------------------------

    def error(self, index: int) -> tuple[float, str]:
        """Return one sigma in a position and its mark."""
        if self.spread is None:
            return 0.0, ""
        return float(self.spread.sigma[index]), DRAWN if self.spread.drawn[index] else ""

    def __getitem__(self, index: int) -> ComparedNumber:
        """Return the quantity in a position, compared."""
        sigma, mark = self.error(index)
        return replace(self.measured(index), sigma=sigma, mark=mark)

    def measured(self, index: int) -> ComparedNumber:
        """Return the quantity in a position, compared without its sigma; rounding counts as 0."""
        exact, read = (self.displayed(some, [index])[0] for some in (self.exact, self.read))
        return ComparedNumber(exact, read)

    # Columns ----------------------------------------------------------------------------------

    @property
    def furthest(self) -> int | None:
        """The position where Δ is the largest; None where nothing can be read."""
        sizes = [abs(off) for off in self.off.tolist()]
        known = (k for k, size in enumerate(sizes) if isfinite(size))
        return max(known, key=sizes.__getitem__, default=None)

    def displayed(self, values: Reals, indices: Iterable[int]) -> list[float]:
        """Return values as a table has them: rounding noise beside the largest is 0."""
        some = (float(values[i]) for i in indices)
        return [0.0 if is_noise(value, self.peak) else value for value in some]

    def texts(self, values: Sequence[float]) -> list[str]:
        """Return plain numbers with common decimals; sizes where a sense is beside them."""
        return format_column([abs(value) if self.turns else value for value in values])

    def sense(self, value: float) -> int | None:
        """Return the sense to write beside a value; None where there is none."""
        return sense_of(value) if self.turns else None


def measured_series(
    symbol: Rich,
    unit: str,
    exact: Sequence[float] | Reals,
    read: Sequence[float] | Reals,
    sigma: Sequence[float] | Reals,
) -> Series:
    """Return a series of numbers that were read and whose drafting errors are known."""
    import numpy as np

    from planmethod.solved.errors.spread import Spread

    values, found, errors = (np.asarray(column, dtype=float) for column in (exact, read, sigma))
    spread = Spread(errors, np.zeros(len(errors), dtype=bool))
    return Series(symbol, unit, values, lambda: found, lambda: spread)
