"""Number types a program can be read in; the only module that says Any."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

import numpy as np

Number: TypeAlias = (
    Any  # complex-like, one entry per position: + - * / abs .conjugate() .real .imag
)


class Arithmetic(Protocol):
    """What the evaluator needs beyond operators; one object per number type."""

    def lift(self, value: Number) -> Number:
        """Turn given data into this number type."""
        ...

    def root(self, value: Number) -> Number:
        """Return the square root, 0 of what is negative."""
        ...

    def where(self, ok: Number, value: Number) -> Number:
        """Return the value where ``ok``, NaN elsewhere."""
        ...

    def nonzero(self, value: Number) -> Number:
        """Return the value with NaN in place of zero: a divisor."""
        ...

    def pick(self, ok: Number, value: Number, other: Number) -> Number:
        """Return ``value`` where ``ok``, else ``other``."""
        ...

    def direction(self, degrees: Number) -> Number:
        """Return the unit complex number at an angle; exact at multiples of 90 degrees."""
        ...

    def ruled(self, length: Number) -> Number:
        """Return a length as it is read on the drawing, mm."""
        ...

    def reread(self, length: Number) -> Number:
        """Return the read length over the true one; 1 for an exact reading."""
        ...


def unit_vectors(degrees: Any) -> Any:
    """Return exp(i·degrees) as complex128.

    The angle is first reduced to the nearest quadrant in degrees, where the reduction is exact, so
    0, 90, 180... give exactly 1, i, -1... and a million turns cost no accuracy.

    Parameters
    ----------
    degrees : float or ndarray of shape (n,), degrees
    """
    angle = np.asarray(degrees, dtype=float)
    turn = np.remainder(angle, 360.0)
    quadrant = np.rint(turn / 90.0)
    rest = np.deg2rad(turn - 90.0 * quadrant)
    cosine, sine = np.cos(rest), np.sin(rest)
    turns = np.array([1, 1j, -1, -1j, 1])
    return turns[quadrant.astype(int)] * (cosine + 1j * sine)


@dataclass(frozen=True, slots=True)
class Float64:
    """complex128 arrays, one entry per position: the exact plan."""

    def lift(self, value: Number) -> Number:
        """Turn given data into an array."""
        return np.asarray(value)

    def root(self, value: Number) -> Number:
        """Return the square root, 0 of what is negative."""
        return np.sqrt(np.maximum(value, 0.0))

    def where(self, ok: Number, value: Number) -> Number:
        """Return the value where ``ok``, NaN elsewhere."""
        return np.where(ok, value, complex("nan+nanj"))

    def nonzero(self, value: Number) -> Number:
        """Return the value with NaN in place of zero."""
        return np.where(value == 0, np.nan, value)

    def pick(self, ok: Number, value: Number, other: Number) -> Number:
        """Return ``value`` where ``ok``, else ``other``."""
        return np.where(ok, value, other)

    def direction(self, degrees: Number) -> Number:
        """Return the unit complex number at an angle."""
        return unit_vectors(degrees)

    def ruled(self, length: Number) -> Number:
        """Return the exact length."""
        return length

    def reread(self, length: Number) -> Number:
        """Return 1: what is read is exact."""
        return 1.0


@dataclass(frozen=True, slots=True)
class Hand(Float64):
    """Draughtsman who draws exactly and reads with a ruler (чертёжник с линейкой).

    Every length read on the drawing is rounded to the nearest ``ruler`` step, ties away from zero
    as a person reads; what is computed from it goes on along the chain of the construction.

    Attributes
    ----------
    ruler : float, mm
        Step of the ruler (цена деления).
    """

    ruler: float = 0.5

    def __post_init__(self) -> None:
        if not (math.isfinite(self.ruler) and self.ruler > 0):
            raise ValueError(f"ruler step must be positive, got {self.ruler}")

    def ruled(self, length: Number) -> Number:
        """Return the length rounded to the ruler step, keeping its sign."""
        return np.sign(length) * np.floor(np.abs(length) / self.ruler + 0.5) * self.ruler

    def reread(self, length: Number) -> Number:
        """Return the read length over the true one; 1 of a length that is zero."""
        return np.where(length == 0, 1.0, self.ruled(length) / np.where(length == 0, 1.0, length))
