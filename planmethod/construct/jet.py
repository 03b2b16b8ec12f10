"""Numbers that carry their first and second derivative in time: a second opinion on motion.

The position program alone, read in jets, gives velocities and accelerations that owe nothing to
the velocity and acceleration plans.
"""

from __future__ import annotations

import math
from typing import Any, Protocol

from planmethod.construct.arithmetic import Arithmetic, Exact, Number


class Selecting(Arithmetic, Protocol):
    """An arithmetic that can choose between two numbers."""

    def select(self, ok: Number, value: Number, other: Number) -> Number:
        """Return ``value`` where ``ok``, else ``other``."""
        ...


class Jet:
    """A quantity with its rate and the rate of that (значение, скорость, ускорение).

    The three parts are numbers of any type that the evaluator can read in.
    """

    __slots__ = ("acceleration", "rate", "value")
    __array_ufunc__ = None  # so that an array on the left leaves the operation to the jet

    def __init__(self, value: Number, rate: Number = 0.0, acceleration: Number = 0.0) -> None:
        self.value, self.rate, self.acceleration = value, rate, acceleration

    def _parts(self) -> tuple[Number, Number, Number]:
        return self.value, self.rate, self.acceleration

    def __add__(self, other: Number) -> Jet:
        f, f1, f2 = self._parts()
        g, g1, g2 = _jet(other)._parts()
        return Jet(f + g, f1 + g1, f2 + g2)

    __radd__ = __add__

    def __neg__(self) -> Jet:
        return Jet(-self.value, -self.rate, -self.acceleration)

    def __sub__(self, other: Number) -> Jet:
        return self + -_jet(other)

    def __rsub__(self, other: Number) -> Jet:
        return _jet(other) + -self

    def __mul__(self, other: Number) -> Jet:
        f, f1, f2 = self._parts()
        g, g1, g2 = _jet(other)._parts()
        return Jet(f * g, f1 * g + f * g1, f2 * g + 2 * f1 * g1 + f * g2)

    __rmul__ = __mul__

    def __truediv__(self, other: Number) -> Jet:
        f, f1, f2 = self._parts()
        g, g1, g2 = _jet(other)._parts()
        h = f / g
        h1 = (f1 - h * g1) / g
        return Jet(h, h1, (f2 - 2 * h1 * g1 - h * g2) / g)

    def __rtruediv__(self, other: Number) -> Jet:
        return _jet(other) / self

    def __abs__(self) -> Jet:
        f, f1, f2 = self._parts()
        r = abs(f)
        bar = (f + 0 * 1j).conjugate()
        r1 = (bar * f1).real / r
        return Jet(r, r1, (abs(f1) ** 2 + (bar * f2).real - r1 * r1) / r)

    def conjugate(self) -> Jet:
        """Return the complex conjugate."""
        return Jet(*((part + 0 * 1j).conjugate() for part in self._parts()))

    @property
    def real(self) -> Jet:
        """Real part."""
        return Jet(*((part + 0 * 1j).real for part in self._parts()))

    @property
    def imag(self) -> Jet:
        """Imaginary part."""
        return Jet(*((part + 0 * 1j).imag for part in self._parts()))


def _jet(value: Number) -> Jet:
    return value if isinstance(value, Jet) else Jet(value)


class Jets(Exact):
    """Jets over another arithmetic.

    Parameters
    ----------
    base : Selecting
        Arithmetic of the parts: `Float64` or `Precise`.
    """

    __slots__ = ("base",)

    def __init__(self, base: Selecting) -> None:
        self.base = base

    def lift(self, value: Number) -> Number:
        """Turn given data into a jet; a constant unless it is one already."""
        parts: Any = value._parts() if isinstance(value, Jet) else (value, 0.0, 0.0)
        return Jet(*(self.base.lift(part) for part in parts))

    def root(self, value: Number) -> Number:
        """Return the square root, 0 of what is negative."""
        f, f1, f2 = _jet(value)._parts()
        s = self.base.root(f)
        s1 = f1 / (2 * self.base.nonzero(s))
        return Jet(s, s1, (f2 / 2 - s1 * s1) / self.base.nonzero(s))

    def _each(self, ok: Number, value: Number, other: Number) -> Jet:
        pairs = zip(_jet(value)._parts(), _jet(other)._parts(), strict=True)
        return Jet(*(self.base.select(ok, one, two) for one, two in pairs))

    def guard(self, margin: Number, limit: float, value: Number) -> Number:
        """Return the value where the margin exceeds the limit, NaN elsewhere."""
        base = self.base
        return Jet(*(base.guard(_jet(margin).value, limit, part) for part in _jet(value)._parts()))

    def nonzero(self, value: Number) -> Number:
        """Return the value with NaN in place of zero."""
        jet = _jet(value)
        return Jet(self.base.nonzero(jet.value), jet.rate, jet.acceleration)

    def solid(self, length: Number) -> Number:
        """Return 1 where a length is not zero, else 0."""
        return Jet(self.base.solid(_jet(length).value))

    def unless_zero(self, size: Number, value: Number, other: Number) -> Number:
        """Return ``other`` where ``size`` and its rates are zero, else ``value``."""
        return self._each(_jet(size).value == 0, other, value)

    def ordered(self, one: Number, two: Number) -> tuple[Number, Number]:
        """Return the smaller and the larger of two real numbers."""
        less = _jet(one).value < _jet(two).value
        return self._each(less, one, two), self._each(less, two, one)

    def direction(self, degrees: Number) -> Number:
        """Return the unit complex number at an angle in degrees."""
        angle, rate, acceleration = _jet(degrees)._parts()
        u = self.base.direction(angle)
        right = self._radian()
        omega, epsilon = rate * right, acceleration * right
        return Jet(u, u * (1j * omega), u * (1j * epsilon - omega * omega))

    def _radian(self) -> Number:
        context = getattr(self.base, "context", None)
        return math.pi / 180 if context is None else context.pi / 180
