"""Multiprecision reading: a program read in mpmath, to any number of digits (арбитр)."""

from __future__ import annotations

from typing import Any

from planmethod.construct.arithmetic import Exact, Number

DIGITS = 50
"""Default number of decimal digits of the high-precision check."""


class Precise(Exact):
    """Numbers of mpmath, one position at a time.

    It has its own context, so that a precision set elsewhere does not change its results.

    Parameters
    ----------
    digits : int
        Decimal digits carried.
    """

    __slots__ = ("_right", "context", "digits")

    def __init__(self, digits: int = DIGITS) -> None:
        from mpmath import MPContext

        self.digits = digits
        self.context: Any = MPContext()
        self.context.dps = digits
        self._right = self.context.pi / 180

    def lift(self, value: Number) -> Number:
        """Turn given data, binary fractions taken as they are, into a number of the context."""
        return self.context.convert(value.item() if hasattr(value, "item") else value)

    def root(self, value: Number) -> Number:
        """Return the square root, 0 of a negative number."""
        return self.context.sqrt(value) if value > 0 else self.context.zero

    def guard(self, margin: Number, limit: float, value: Number) -> Number:
        """Return the value if ``margin > limit``, else NaN."""
        return value if margin > limit else value * self.context.nan

    def nonzero(self, value: Number) -> Number:
        """Return the value, NaN in place of zero."""
        return self.context.nan if value == 0 else value

    def direction_margin(self, length: Number) -> Number:
        """Return 1 if a length is not zero, else 0."""
        return self.context.one if length != 0 else self.context.zero

    def unless_zero(self, size: Number, value: Number, fallback: Number) -> Number:
        """Return ``fallback`` if ``size`` is zero, else ``value``."""
        return fallback if size == 0 else value

    def ordered(self, one: Number, two: Number) -> tuple[Number, Number]:
        """Return the smaller and the larger of two real numbers."""
        return (one, two) if one < two else (two, one)

    def direction(self, degrees: Number) -> Number:
        """Return the unit complex number at an angle; exact at quadrants."""
        quadrant = int(self.context.nint(degrees / 90))
        cosine, sine = self.context.cos_sin((degrees - 90 * quadrant) * self._right)
        return self.context.mpc(cosine, sine) * (1, 1j, -1, -1j)[quadrant % 4]
