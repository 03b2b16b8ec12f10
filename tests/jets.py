"""Programs read in jets: an independent check of motion and of the referee.

The position program alone, read in jets, gives velocities and accelerations independent of the
velocity and acceleration plans.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from doors import (
    DIGITS,
    ArithmeticNumber as Number,
    Exact,
    Jet,
    Precise,
    Program,
    Trace,
    evaluate_evaluate as evaluate,
)


def adjudicate(program: Program, data: Mapping[str, Number], *, digits: int = DIGITS) -> Trace:
    """Return a program read in one position by the referee."""
    return evaluate(program, data, Precise(digits))


def _jet(value: Number) -> Jet:
    return value if isinstance(value, Jet) else Jet(value)


class Jets(Exact):
    """Jets over another arithmetic, `Float64` or `Precise`."""

    __slots__ = ("base",)

    def __init__(self, base: Any) -> None:
        self.base = base

    def lift(self, value: Number) -> Number:
        """Turn given data into a jet; a constant unless it is one already."""
        parts: Any = value.parts() if isinstance(value, Jet) else (value, 0.0, 0.0)
        return Jet(*(self.base.lift(part) for part in parts))

    def root(self, value: Number) -> Number:
        """Return the square root, 0 for a negative number."""
        f, f1, f2 = _jet(value).parts()
        s = self.base.root(f)
        s1 = f1 / (2 * self.base.nonzero(s))
        return Jet(s, s1, (f2 / 2 - s1 * s1) / self.base.nonzero(s))

    def _each(self, ok: Number, value: Number, other: Number) -> Jet:
        pairs = zip(_jet(value).parts(), _jet(other).parts(), strict=True)
        if isinstance(self.base, Precise):
            return Jet(*(one if ok else two for one, two in pairs))
        return Jet(*(np.where(ok, one, two) for one, two in pairs))

    def guard(self, margin: Number, limit: float, value: Number) -> Number:
        """Return the value where the margin exceeds the limit, NaN elsewhere."""
        base = self.base
        return Jet(*(base.guard(_jet(margin).value, limit, part) for part in _jet(value).parts()))

    def nonzero(self, value: Number) -> Number:
        """Return the value with NaN in place of zero."""
        jet = _jet(value)
        return Jet(self.base.nonzero(jet.value), jet.rate, jet.acceleration)

    def direction_margin(self, length: Number) -> Number:
        """Return 1 where a length is not zero, else 0."""
        return Jet(self.base.direction_margin(_jet(length).value))

    def unless_zero(self, size: Number, value: Number, other: Number) -> Number:
        """Return ``other`` where ``size`` and its rates are zero, else ``value``."""
        return self._each(_jet(size).value == 0, other, value)

    def ordered(self, one: Number, two: Number) -> tuple[Number, Number]:
        """Return the smaller and the larger of two real numbers."""
        less = _jet(one).value < _jet(two).value
        return self._each(less, one, two), self._each(less, two, one)

    def direction(self, degrees: Number) -> Number:
        """Return the unit complex number at an angle in degrees."""
        angle, rate, acceleration = _jet(degrees).parts()
        u = self.base.direction(angle)
        right = self._radian()
        omega, epsilon = rate * right, acceleration * right
        return Jet(u, u * (1j * omega), u * (1j * epsilon - omega * omega))

    def angle(self, vector: Number) -> Number:
        """Return the angle of a vector, degrees."""
        z, z1, z2 = _jet(vector).parts()
        rate = z1 / self.base.nonzero(z)
        parts = (rate, z2 / self.base.nonzero(z) - rate * rate)
        return Jet(self.base.angle(z), *((part + 0 * 1j).imag / self._radian() for part in parts))

    def _radian(self) -> Number:
        context = getattr(self.base, "context", None)
        return math.pi / 180 if context is None else context.pi / 180
