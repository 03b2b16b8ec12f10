"""A number from a drawing beside the exact one: its error, and how the error is written.

Every table and sentence that sets one number beside another is made of this (сравнение).
"""

from __future__ import annotations

from math import inf, isfinite
from typing import TYPE_CHECKING

from msgspec import Struct

from planmethod.note.numbers import significant
from planmethod.note.rounding import rounded_to, sigma_text

if TYPE_CHECKING:
    from planmethod.solved.errors.spread import Errors

DASH = "—"
"""Placeholder for a missing number."""

MAX_PERCENT = 100.0
"""Error in per cent from which a reading is meaningless: the segment is too short."""


DRAWN = "*"
"""Mark of a sigma that was found by random draws, first order failing there."""


def marked(errors: Errors, label: str, index: int) -> tuple[float, str]:
    """Return a quantity's sigma in one position and its mark, `MIN_DRAWN_SIGMA` or nothing.

    A quantity that the drawing does not give, as the ω of a translating link, has no error.
    """
    spread = errors.spreads.get(label)
    if spread is None:
        return 0.0, ""
    return float(spread.sigma[index]), DRAWN if spread.drawn[index] else ""


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

    @property
    def expected(self) -> float | None:
        """Sigma in per cent of the exact value; None where that is zero."""
        return 100.0 * self.sigma / abs(self.exact) if self.exact else None

    @property
    def sigmas(self) -> float:
        """The size of Δ, in sigmas."""
        return abs(self.off) / self.sigma if self.sigma else 0.0

    # Plain text -------------------------------------------------------------------------------

    @property
    def read_text(self) -> str:
        """The reading up to the last digit of its error; a dash where nothing can be read."""
        return rounded_to(self.read, self.sigma) if isfinite(self.read) else DASH

    @property
    def sigma_text(self) -> str:
        """Sigma with its mark; a dash where it is not finite."""
        return sigma_text(self.sigma) + self.mark if isfinite(self.sigma) else DASH

    @property
    def off_text(self) -> str:
        """Δ in the unit of the number, two digits."""
        return significant(self.off, 2)

    def percent_text(self, decimals: int = 1, limit: float = inf) -> str:
        """Return Δ in per cent; a dash where it is undefined, and from `limit` on."""
        return percent_text(self.percent, decimals, limit)
