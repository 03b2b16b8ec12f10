"""Numbers in float64 that carry a bound of what rounding has done to them.

What they are for: zero is told from what only rounding left. A point at rest has a velocity of
1e-16, and a straight line curvature of as much.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.float64]

ROUNDOFF = 2.0**-53
ELEMENTARY = 8 * ROUNDOFF
"""Bound of the relative error of NumPy's functions."""


class Bounded:
    """Values and how far each may be off, to first order (число с границей погрешности).

    Attributes
    ----------
    value, radius : array of float
        Shapes broadcast against each other.
    """

    __slots__ = ("radius", "value")
    __array_ufunc__ = None

    def __init__(self, value: Any, radius: Any = 0.0) -> None:
        self.value: Any = np.asarray(value, dtype=np.float64)
        self.radius: Any = np.asarray(radius, dtype=np.float64)

    def __neg__(self) -> Bounded:
        return Bounded(-self.value, self.radius)

    def __add__(self, other: Any) -> Bounded:
        other = bounded(other)
        value = self.value + other.value
        return Bounded(value, self.radius + other.radius + ROUNDOFF * np.abs(value))

    __radd__ = __add__

    def __sub__(self, other: Any) -> Bounded:
        return self + -bounded(other)

    def __rsub__(self, other: Any) -> Bounded:
        return bounded(other) + -self

    def __mul__(self, other: Any) -> Bounded:
        other = bounded(other)
        value = self.value * other.value
        spread = np.abs(self.value) * other.radius + np.abs(other.value) * self.radius
        return Bounded(value, spread + ROUNDOFF * np.abs(value))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Bounded:
        """Divide; by what may be zero: NaN."""
        other = bounded(other)
        by = np.where(np.abs(other.value) <= other.radius, np.nan, other.value)
        value = self.value / by
        spread = (self.radius + np.abs(value) * other.radius) / np.abs(by)
        return Bounded(value, spread + ROUNDOFF * np.abs(value))

    def __rtruediv__(self, other: Any) -> Bounded:
        quotient: Bounded = bounded(other) / self
        return quotient

    def __abs__(self) -> Bounded:
        return Bounded(np.abs(self.value), self.radius)

    def settled(self) -> Bounded:
        """Return the values with exact zeros for what cannot be told from zero.

        What is infinite, or may be off by any amount, is NaN.
        """
        value = np.where(np.isfinite(self.value + self.radius), self.value, np.nan)
        nothing = np.abs(value) <= self.radius
        return Bounded(np.where(nothing, 0.0, value), np.where(nothing, 0.0, self.radius))


def bounded(value: Any) -> Bounded:
    """Return a number as it is, or given data as exact."""
    return value if isinstance(value, Bounded) else Bounded(value)


def length(x: Bounded, y: Bounded) -> Bounded:
    """Return the length of a vector; zero exactly where both components are."""
    value = np.hypot(x.value, y.value)
    size = np.where(value == 0.0, 1.0, value)
    spread = (np.abs(x.value) * x.radius + np.abs(y.value) * y.radius) / size
    return Bounded(value, spread + ELEMENTARY * value)
