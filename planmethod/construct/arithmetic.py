"""Number types a program can be read in, and time derivatives; the only module that says Any.

Angles are given in degrees, in which the quadrants are exact. The cosine of pi/2 in float64 is not
zero: a guide at that angle would lean, and a slider on it would have a velocity across the guide.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, Protocol, TypeAlias

import numpy as np

Number: TypeAlias = (
    Any  # complex-like, one entry per position: + - * / abs .conjugate() .real .imag
)


class Arithmetic(Protocol):
    """Operations that the evaluator needs beyond operators; one object per number type.

    The second half is where a pencil and a ruler come in: an exact reading returns its argument
    (`Exact`), a draughtsman returns the drawn value. ``out`` is the name of the step, so that the
    error of each stroke can be identified.
    """

    def lift(self, value: Number) -> Number:
        """Turn given data into this number type."""
        ...

    def root(self, value: Number) -> Number:
        """Return the square root, 0 of a negative number."""
        ...

    def guard(self, margin: Number, limit: float, value: Number) -> Number:
        """Return the value where ``margin > limit``, NaN elsewhere."""
        ...

    def nonzero(self, value: Number) -> Number:
        """Return the value with NaN in place of zero: a divisor."""
        ...

    def direction_margin(self, length: Number) -> Number:
        """Return 1 if a length is not zero, else 0: the margin of a step that needs a direction."""
        ...

    def unless_zero(self, size: Number, value: Number, fallback: Number) -> Number:
        """Return ``fallback`` where ``size`` is zero, else ``value``."""
        ...

    def ordered(self, one: Number, two: Number) -> tuple[Number, Number]:
        """Return the smaller and the larger of two real numbers."""
        ...

    def direction(self, degrees: Number) -> Number:
        """Return the unit complex number at an angle; exact at multiples of 90 degrees."""
        ...

    def angle(self, vector: Number) -> Number:
        """Return the angle of a vector, degrees in (-180, 180]; 180 on either side of the cut."""
        ...

    def given_point(self, out: str, point: Number) -> Number:
        """Return a given point as plotted."""
        ...

    def line_through(self, out: str, tail: Number, vector: Number) -> tuple[Number, Number]:
        """Return the line (a point, its direction) drawn through two points ``vector`` apart."""
        ...

    def drawn(self, out: str, through: Number, direction: Number) -> tuple[Number, Number]:
        """Return a line drawn through a point in a direction."""
        ...

    def arc(self, out: str, centre: Number, radius: Number) -> tuple[Number, Number]:
        """Return centre and radius of an arc as the compass draws it."""
        ...

    def pricked(self, out: str, point: Number) -> Number:
        """Return an intersection of two lines as marked."""
        ...

    def laid_off_length(self, out: str, length: Number) -> Number:
        """Return a length as laid off; its imaginary part is the deviation beside the line."""
        ...

    def read(self, out: str, length: Number) -> Number:
        """Return a length as read on the drawing, mm."""
        ...

    def read_angle(self, out: str, degrees: Number) -> Number:
        """Return an angle as read with the protractor, degrees."""
        ...

    def length_ratio(self, length: Number, vector: Number) -> Number:
        """Return |length| over the length of a drawn vector; 1 for a vector of no length."""
        ...


class Exact:
    """The half of an arithmetic without a pencil: every stroke is exact."""

    __slots__ = ()

    def given_point(self, out: str, point: Number) -> Number:
        """Return the point."""
        return point

    def line_through(self, out: str, tail: Number, vector: Number) -> tuple[Number, Number]:
        """Return the line."""
        return tail, vector

    def drawn(self, out: str, through: Number, direction: Number) -> tuple[Number, Number]:
        """Return the line."""
        return through, direction

    def arc(self, out: str, centre: Number, radius: Number) -> tuple[Number, Number]:
        """Return centre and radius."""
        return centre, radius

    def pricked(self, out: str, point: Number) -> Number:
        """Return the point."""
        return point

    def laid_off_length(self, out: str, length: Number) -> Number:
        """Return the length."""
        return length

    def read(self, out: str, length: Number) -> Number:
        """Return the length."""
        return length

    def read_angle(self, out: str, degrees: Number) -> Number:
        """Return the angle."""
        return degrees

    def length_ratio(self: Arithmetic, length: Number, vector: Number) -> Number:
        """Return |length| over the length of a drawn vector; 1 for a vector of no length."""
        drawn = abs(vector)
        return self.unless_zero(drawn, abs(length) / self.nonzero(drawn), 1.0)


def unit_vectors(degrees: Any) -> Any:
    """Return exp(i·degrees) as complex128.

    The angle is first reduced to the nearest quadrant in degrees, where the reduction is exact, so
    0, 90, 180... give exactly 1, i, -1... and a million turns cost no accuracy.

    Parameters
    ----------
    degrees : float or ndarray of shape (n,), degrees
    """
    angle = np.asarray(degrees, dtype=float)
    turn = np.fmod(angle, 360.0)
    quadrant = np.rint(turn / 90.0)
    rest = np.deg2rad(turn - 90.0 * quadrant)
    cosine, sine = np.cos(rest), np.sin(rest)
    turns = np.array([1, 1j, -1, -1j])
    return turns[quadrant.astype(int) % 4] * (cosine + 1j * sine)


class Float64(Exact):
    """complex128 arrays, one entry per position: the exact plan."""

    __slots__ = ()

    def lift(self, value: Number) -> Number:
        """Turn given data into an array."""
        return np.asarray(value)

    def root(self, value: Number) -> Number:
        """Return the square root, 0 of a negative number."""
        return np.sqrt(np.maximum(value, 0.0))

    def guard(self, margin: Number, limit: float, value: Number) -> Number:
        """Return the value where ``margin > limit``, NaN elsewhere."""
        return np.where(margin > limit, value, np.nan * value)

    def nonzero(self, value: Number) -> Number:
        """Return the value with NaN in place of zero."""
        return np.where(value == 0, np.nan, value)

    def direction_margin(self, length: Number) -> Number:
        """Return 1.0 where a length is not zero, else 0.0."""
        return np.where(abs(length) > 0, 1.0, 0.0)

    def unless_zero(self, size: Number, value: Number, fallback: Number) -> Number:
        """Return ``fallback`` where ``size`` is zero, else ``value``."""
        return np.where(size == 0, fallback, value)

    def ordered(self, one: Number, two: Number) -> tuple[Number, Number]:
        """Return the smaller and the larger of two real numbers."""
        return np.minimum(one, two), np.maximum(one, two)

    def direction(self, degrees: Number) -> Number:
        """Return the unit complex number at an angle."""
        return unit_vectors(degrees)

    def angle(self, vector: Number) -> Number:
        """Return the angle of a vector, degrees in (-180, 180]."""
        degrees = np.degrees(np.angle(vector))
        return np.where(degrees <= -180.0, 180.0, degrees)


class PiecewiseArithmetic(Protocol):
    """Operations for piecewise functions: conditions, tables, angles counted from a start.

    A condition is a value of its own, which `select`, `both` and `either` take.
    """

    def above(self, first: Number, second: Number) -> Number:
        """Return whether ``first > second``; not where either is NaN."""
        ...

    def reaches(self, first: Number, second: Number) -> Number:
        """Return whether ``first >= second``, neither of which is NaN."""
        ...

    def both(self, first: Number, second: Number) -> Number:
        """Return whether two conditions hold."""
        ...

    def either(self, first: Number, second: Number) -> Number:
        """Return whether one of two conditions holds."""
        ...

    def select(self, condition: Number, value: Number, fallback: Number) -> Number:
        """Return the value where a condition holds, else ``fallback``."""
        ...

    def larger(self, first: Number, second: Number) -> Number:
        """Return the larger of two real numbers."""
        ...

    def clipped(self, value: Number, low: float, high: float) -> Number:
        """Return a real number moved into a range."""
        ...

    def modulo(self, value: Number, turn: float) -> Number:
        """Return what remains of a real number above a multiple of ``turn``, in [0, turn)."""
        ...

    def angle(self, vector: Number) -> Number:
        """Return the angle of a vector, radians in [-π, π]."""
        ...

    def passed(self, marks: Sequence[float], value: Number) -> Number:
        """Return how many of some rising marks a number has reached."""
        ...

    def interpolated(self, at: Sequence[float], values: Sequence[float], value: Number) -> Number:
        """Read a table straight between its rows; beyond its ends it keeps their values."""
        ...

    def stepped(self, at: Sequence[float], values: Sequence[float], value: Number) -> Number:
        """Read a table each row of which holds until the next one."""
        ...

    def listed(
        self,
        at: Sequence[float],
        values: Sequence[float],
        value: Number,
        tolerance: float,
        reject: Callable[[float], Exception],
    ) -> Number:
        """Read a table that is known at its rows alone.

        Raises
        ------
        Exception
            What ``reject`` makes of the first number that is at no row; without errors, NaN.
        """
        ...


class PiecewiseArrays:
    """Piecewise arithmetic of arrays."""

    __slots__ = ()

    def above(self, first: Number, second: Number) -> Number:
        """Return whether ``first > second``."""
        return first > second

    def reaches(self, first: Number, second: Number) -> Number:
        """Return whether ``first >= second``."""
        return first >= second

    def both(self, first: Number, second: Number) -> Number:
        """Return whether two conditions hold."""
        return first & second

    def either(self, first: Number, second: Number) -> Number:
        """Return whether one of two conditions holds."""
        return first | second

    def select(self, condition: Number, value: Number, fallback: Number) -> Number:
        """Return the value where a condition holds, else ``fallback``."""
        return np.where(condition, value, fallback)

    def larger(self, first: Number, second: Number) -> Number:
        """Return the larger of two real numbers."""
        return np.maximum(first, second)

    def clipped(self, value: Number, low: float, high: float) -> Number:
        """Return a real number moved into a range."""
        return np.clip(value, low, high)

    def modulo(self, value: Number, turn: float) -> Number:
        """Return what remains of a real number above a multiple of ``turn``."""
        return np.mod(value, turn)

    def angle(self, vector: Number) -> Number:
        """Return the angle of a vector, radians."""
        return np.angle(vector)

    def passed(self, marks: Sequence[float], value: Number) -> Number:
        """Return how many of some rising marks a number has reached."""
        return np.searchsorted(marks, value, side="right")

    def interpolated(self, at: Sequence[float], values: Sequence[float], value: Number) -> Number:
        """Read a table straight between its rows."""
        return np.asarray(np.interp(value, at, values), dtype=float)

    def stepped(self, at: Sequence[float], values: Sequence[float], value: Number) -> Number:
        """Read a table each row of which holds until the next one."""
        row = np.searchsorted(at, value, side="right") - 1
        return np.asarray(np.asarray(values)[np.maximum(row, 0)], dtype=float)

    def listed(
        self,
        at: Sequence[float],
        values: Sequence[float],
        value: Number,
        tolerance: float,
        reject: Callable[[float], Exception],
    ) -> Number:
        """Read a table that is known at its rows alone."""
        own, known = np.asarray(at), np.asarray(values)
        if np.array_equal(own, value):
            return known
        order = np.argsort(own, kind="stable")
        rank = np.minimum(np.searchsorted(own[order], value - tolerance), len(own) - 1)
        strange = np.flatnonzero(~(np.abs(own[order[rank]] - value) <= tolerance))
        if strange.size:
            raise reject(float(value[strange[0]]))
        return known[order[rank]]


ARRAYS = PiecewiseArrays()


class Single(Exact):
    """One position in Python's own numbers: three times as fast as an array of one.

    Operations that give infinity or NaN in arrays raise here where Python does: ZeroDivisionError,
    OverflowError.
    """

    __slots__ = ()

    def lift(self, value: Number) -> Number:
        """Turn given data, or an array of one, into a number."""
        if isinstance(value, np.ndarray | np.generic):
            (value,) = np.reshape(value, -1).tolist()
        return value

    def root(self, value: Number) -> Number:
        """Return the square root, 0 of a negative number."""
        return math.sqrt(value) if value > 0 else value * 0.0

    def guard(self, margin: Number, limit: float, value: Number) -> Number:
        """Return the value where ``margin > limit``, else NaN."""
        return value if margin > limit else math.nan * value

    def nonzero(self, value: Number) -> Number:
        """Return the value with NaN in place of zero."""
        return value if value else math.nan

    def direction_margin(self, length: Number) -> Number:
        """Return 1.0 where a length is not zero, else 0.0."""
        return 1.0 if abs(length) > 0 else 0.0

    def unless_zero(self, size: Number, value: Number, fallback: Number) -> Number:
        """Return ``fallback`` where ``size`` is zero, else ``value``."""
        return fallback if size == 0 else value

    def ordered(self, one: Number, two: Number) -> tuple[Number, Number]:
        """Return the smaller and the larger of two real numbers."""
        return (one, two) if one <= two else (two, one)

    def direction(self, degrees: Number) -> Number:
        """Return the unit complex number at an angle."""
        return complex(unit_vectors(degrees))

    def angle(self, vector: Number) -> Number:
        """Return the angle of a vector, degrees in (-180, 180]."""
        degrees = math.degrees(math.atan2(vector.imag, vector.real))
        return 180.0 if degrees <= -180.0 else degrees


class Jet:
    """A quantity with its rate and the rate of that (значение, скорость, ускорение).

    The three parts are numbers of any type that the evaluator can read in.
    """

    __slots__ = ("acceleration", "rate", "value")
    __array_ufunc__ = None  # so that an array on the left leaves the operation to the jet

    def __init__(self, value: Number, rate: Number = 0.0, acceleration: Number = 0.0) -> None:
        self.value, self.rate, self.acceleration = value, rate, acceleration

    def parts(self) -> tuple[Number, Number, Number]:
        """Return value, rate and acceleration."""
        return self.value, self.rate, self.acceleration

    def __add__(self, other: Number) -> Jet:
        f, f1, f2 = self.parts()
        g, g1, g2 = _jet(other).parts()
        return Jet(f + g, f1 + g1, f2 + g2)

    __radd__ = __add__

    def __neg__(self) -> Jet:
        return Jet(-self.value, -self.rate, -self.acceleration)

    def __sub__(self, other: Number) -> Jet:
        return self + -_jet(other)

    def __rsub__(self, other: Number) -> Jet:
        return _jet(other) + -self

    def __mul__(self, other: Number) -> Jet:
        f, f1, f2 = self.parts()
        g, g1, g2 = _jet(other).parts()
        return Jet(f * g, f1 * g + f * g1, f2 * g + 2 * f1 * g1 + f * g2)

    __rmul__ = __mul__

    def __truediv__(self, other: Number) -> Jet:
        f, f1, f2 = self.parts()
        g, g1, g2 = _jet(other).parts()
        h = f / g
        h1 = (f1 - h * g1) / g
        return Jet(h, h1, (f2 - 2 * h1 * g1 - h * g2) / g)

    def __rtruediv__(self, other: Number) -> Jet:
        return _jet(other) / self

    def __abs__(self) -> Jet:
        f, f1, f2 = self.parts()
        r = abs(f)
        bar = (f + 0 * 1j).conjugate()
        r1 = (bar * f1).real / r
        return Jet(r, r1, (abs(f1) ** 2 + (bar * f2).real - r1 * r1) / r)

    def conjugate(self) -> Jet:
        """Return the complex conjugate."""
        return Jet(*((part + 0 * 1j).conjugate() for part in self.parts()))

    @property
    def real(self) -> Jet:
        """Real part."""
        return Jet(*((part + 0 * 1j).real for part in self.parts()))

    @property
    def imag(self) -> Jet:
        """Imaginary part."""
        return Jet(*((part + 0 * 1j).imag for part in self.parts()))


def _jet(value: Number) -> Jet:
    return value if isinstance(value, Jet) else Jet(value)
