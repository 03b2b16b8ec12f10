"""Numbers that carry their derivatives by many small causes: first-order propagation of errors.

A cause is a change of one datum (condition numbers) or one stroke of a pencil (drafting error).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.construct.arithmetic import Exact, Number, unit_vectors

Slope = npt.NDArray[Any] | None


class Dual:
    """A value in every position, and its slope by every cause (дуальное число).

    Attributes
    ----------
    value : ndarray of shape (n,) or ()
    slope : ndarray of shape (m, n) or (m, 1), or None when no cause changes it
    """

    __slots__ = ("slope", "value")
    __array_ufunc__ = None

    def __init__(self, value: Number, slope: Slope = None) -> None:
        self.value, self.slope = value, slope

    def __add__(self, other: Number) -> Dual:
        other = as_dual(other)
        return Dual(self.value + other.value, _sum(self.slope, other.slope))

    __radd__ = __add__

    def __neg__(self) -> Dual:
        return Dual(-self.value, _times(self.slope, -1.0))

    def __sub__(self, other: Number) -> Dual:
        return self + -as_dual(other)

    def __rsub__(self, other: Number) -> Dual:
        return as_dual(other) + -self

    def __mul__(self, other: Number) -> Dual:
        other = as_dual(other)
        slope = _sum(_times(self.slope, other.value), _times(other.slope, self.value))
        return Dual(self.value * other.value, slope)

    __rmul__ = __mul__

    def __truediv__(self, other: Number) -> Dual:
        other = as_dual(other)
        value = self.value / other.value
        top = _sum(self.slope, _times(other.slope, -value))
        return Dual(value, _times(top, 1.0 / other.value))

    def __rtruediv__(self, other: Number) -> Dual:
        return as_dual(other) / self

    def __abs__(self) -> Dual:
        size = np.abs(self.value)
        unit = np.conjugate(self.value) / np.where(size == 0, 1.0, size)
        if self.slope is None:
            return Dual(size)
        # |x| has no slope at 0: what it can change by at most is the slope's own size.
        return Dual(size, np.where(size == 0, np.abs(self.slope), (self.slope * unit).real))

    def conjugate(self) -> Dual:
        """Return the complex conjugate."""
        slope = None if self.slope is None else np.conjugate(self.slope)
        return Dual(np.conjugate(self.value), slope)

    @property
    def real(self) -> Dual:
        """Real part."""
        return Dual(np.real(self.value), None if self.slope is None else np.real(self.slope))

    @property
    def imag(self) -> Dual:
        """Imaginary part."""
        return Dual(np.imag(self.value), None if self.slope is None else np.imag(self.slope))


def as_dual(value: Number) -> Dual:
    """Return a number as a dual one: a constant unless it is one already."""
    return value if isinstance(value, Dual) else Dual(value)


def angle(value: Number, least: float) -> Number:
    """Return the angle of a complex number, radians, with its slope if it is a dual one.

    What is not longer than ``least`` has no direction: its angle is NaN.
    """
    dual = as_dual(value)
    solid = np.where(np.abs(dual.value) > least, dual.value, np.nan)
    turn = np.angle(solid)
    if dual is not value:
        return turn
    with np.errstate(invalid="ignore"):
        return Dual(turn, None if dual.slope is None else (dual.slope / solid).imag)


def _sum(one: Slope, two: Slope) -> Slope:
    if one is None or two is None:
        return two if one is None else one
    return one + two


def _times(slope: Slope, factor: Number) -> Slope:
    return None if slope is None else slope * factor


class Duals(Exact):
    """Dual numbers over float64 arrays."""

    def lift(self, value: Number) -> Number:
        """Turn given data into a dual number."""
        return value if isinstance(value, Dual) else Dual(np.asarray(value))

    def root(self, value: Number) -> Number:
        """Return the square root, 0 of what is negative."""
        value = as_dual(value)
        root = np.sqrt(np.maximum(value.value, 0.0))
        return Dual(root, _times(value.slope, 0.5 / np.where(root == 0, np.nan, root)))

    def _each(self, ok: Number, value: Number, other: Number) -> Dual:
        value, other = as_dual(value), as_dual(other)
        slope: Slope = None
        if value.slope is not None or other.slope is not None:
            one = 0.0 if value.slope is None else value.slope
            slope = np.where(ok, one, 0.0 if other.slope is None else other.slope)
        return Dual(np.where(ok, value.value, other.value), slope)

    def guard(self, margin: Number, limit: float, value: Number) -> Number:
        """Return the value where the margin exceeds the limit, NaN elsewhere."""
        value, ok = as_dual(value), as_dual(margin).value > limit
        return Dual(np.where(ok, value.value, np.nan * value.value), value.slope)

    def nonzero(self, value: Number) -> Number:
        """Return the value with NaN in place of zero."""
        value = as_dual(value)
        return Dual(np.where(value.value == 0, np.nan, value.value), value.slope)

    def solid(self, length: Number) -> Number:
        """Return 1.0 where a length is not zero, else 0.0."""
        return Dual(np.where(np.abs(as_dual(length).value) > 0, 1.0, 0.0))

    def unless_zero(self, size: Number, value: Number, other: Number) -> Number:
        """Return ``other`` where ``size`` is zero, else ``value``."""
        return self._each(as_dual(size).value == 0, other, value)

    def ordered(self, one: Number, two: Number) -> tuple[Number, Number]:
        """Return the smaller and the larger of two real numbers."""
        less = as_dual(one).value < as_dual(two).value
        return self._each(less, one, two), self._each(less, two, one)

    def direction(self, degrees: Number) -> Number:
        """Return the unit complex number at an angle."""
        degrees = as_dual(degrees)
        u = unit_vectors(degrees.value)
        return Dual(u, _times(degrees.slope, 1j * np.pi / 180 * u))
