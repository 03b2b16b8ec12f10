"""Laws of motion of a follower, in units of their phase (законы движения толкателя)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from enum import Enum
from functools import cached_property
from itertools import pairwise
from math import pi
from typing import NamedTuple, TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

Reals: TypeAlias = NDArray[np.float64]


class CamLawName(Enum):
    """Names of the laws in files (закон движения)."""

    CONSTANT = "constant-acceleration"
    COSINE = "cosine"
    HARMONIC = "harmonic"
    SINE = "sine"
    CYCLOID = "cycloid"
    MODIFIED_SINE = "modified-sine"
    TRAPEZOIDAL = "trapezoidal"
    MODIFIED = "modified-trapezoidal"
    LINEAR = "linear"
    CUBIC = "3-4-5"
    QUARTIC = "4-5-6-7"
    TABLE = "table"
    PIECEWISE = "piecewise-linear"
    LIFT = "lift"


class Bit(NamedTuple):
    """Second derivative on a part: a polynomial from its start, or ``size·sin(rate·x + phase)``."""

    start: float
    end: float
    powers: tuple[float, ...] = ()
    size: float = 0.0
    rate: float = 1.0
    phase: float = 0.0

    def derivatives(self, x: Reals) -> list[Reals]:
        """Return twofold and single integral without constants, and the derivative itself."""
        found = [np.zeros_like(x) for _ in range(3)]
        for k, factor in enumerate(self.powers):
            found[2] += factor * x**k
            found[1] += factor * x ** (k + 1) / (k + 1)
            found[0] += factor * x ** (k + 2) / ((k + 1) * (k + 2))
        if self.size:
            turn = self.rate * x + self.phase
            found[2] += self.size * np.sin(turn)
            found[1] -= self.size / self.rate * np.cos(turn)
            found[0] -= self.size / self.rate**2 * np.sin(turn)
        return found


class UnitLaw(Struct, frozen=True, dict=True):
    """A law in units of its phase: value, first and second derivative (безразмерный закон).

    Attributes
    ----------
    name : CamLawName
    bits : tuple of Bit
        From 0 to 1, without gaps; of any size: the law is scaled to 1 at the end.
    start : float
        First derivative at the start, in the size of the bits.
    balance : float
        Factor of the decelerations of a table, for the law to end at rest.
    parameters : tuple of (str, object)
        Numbers of the file that make it this law: ``("ratio", 2.0)``, ``("values", (0.0, 1.0))``.
    """

    name: CamLawName
    bits: tuple[Bit, ...]
    start: float = 0.0
    balance: float = 1.0
    parameters: tuple[tuple[str, object], ...] = ()

    @cached_property
    def _constants(self) -> list[tuple[float, float]]:
        """Value and derivative at the start of each bit less those of its own integrals."""
        found, value, slope = [], 0.0, self.start
        for bit in self.bits:
            (s0, s1), (v0, v1), _ = bit.derivatives(np.array([0.0, bit.end - bit.start]))
            found.append((value - s0, slope - v0))
            value += s1 - s0 + (slope - v0) * (bit.end - bit.start)
            slope += v1 - v0
        found.append((value, slope))
        return found

    def on(self, k: int, u: Reals) -> Reals:
        """Return value and derivatives by bit ``k``, shape (3, n), within it or extrapolated."""
        bit, (value, slope) = self.bits[k], self._constants[k]
        s, v, a = bit.derivatives(np.asarray(u - bit.start, float))
        size = self._constants[-1][0]
        return np.array([s + value + slope * (u - bit.start), v + slope, a]) / size

    def terms(self, k: int) -> tuple[list[float], float, float, float]:
        """Return the law on bit ``k``, counted from its start: powers of it, and a sine.

        The sine is given by size, rate and phase: ``size·sin(rate·x + phase)``.
        """
        bit, (value, slope), whole = self.bits[k], self._constants[k], self._constants[-1][0]
        powers = [value, slope]
        powers += [f / ((k + 1) * (k + 2)) for k, f in enumerate(bit.powers)]
        wave = -bit.size / bit.rate**2
        return [factor / whole for factor in powers], wave / whole, bit.rate, bit.phase

    @cached_property
    def ends(self) -> Reals:
        """Derivatives at both ends of each bit, shape (bits, 2, 3)."""
        return np.array([self.on(k, np.array(bit[:2])).T for k, bit in enumerate(self.bits)])


def _evenly_spaced(values: Sequence[float]) -> list[tuple[float, float]]:
    return [(k / (len(values) - 1), value) for k, value in enumerate(values)]


def _straight(points: Iterable[tuple[float, float]]) -> tuple[Bit, ...]:
    """Return the bits of a broken line; two points of one abscissa are a jump."""
    return tuple(
        Bit(x, end, (y, (high - y) / (end - x)))
        for (x, y), (end, high) in pairwise(points)
        if end > x
    )


def _crossed(points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return a broken line with points where it crosses zero."""
    found = [points[0]]
    for (x, y), (end, high) in pairwise(points):
        if y * high < 0:
            found.append((x + (end - x) * y / (y - high), 0.0))
        found.append((end, high))
    return found


def balanced(points: Sequence[tuple[float, float]]) -> tuple[list[tuple[float, float]], float]:
    """Return a broken line whose negative part has the area of the positive, and the factor."""
    crossed = _crossed(points)
    areas = [(x1 - x0) * (y0 + y1) / 2 for (x0, y0), (x1, y1) in pairwise(crossed)]
    up, down = sum(a for a in areas if a > 0), -sum(a for a in areas if a < 0)
    factor = up / down
    return [(x, y if y >= 0 else factor * y) for x, y in crossed], factor


def _ramped(ramp: float, *, sine: bool) -> tuple[Bit, ...]:
    """Return trapezoids with straight or quarter-sine sides of ``ramp`` of the phase."""
    if not sine:
        points = [(0, 0), (ramp, 1), (0.5 - ramp, 1), (0.5 + ramp, -1), (1 - ramp, -1), (1, 0)]
        return _straight([(float(x), float(y)) for x, y in points])
    rate = pi / 2 / ramp
    told = [
        Bit(0.0, ramp, size=1.0, rate=rate),
        Bit(ramp, 0.5 - ramp, (1.0,)),
        Bit(0.5 - ramp, 0.5 + ramp, size=1.0, rate=rate, phase=pi / 2),
        Bit(0.5 + ramp, 1 - ramp, (-1.0,)),
        Bit(1 - ramp, 1.0, size=-1.0, rate=rate, phase=pi / 2),
    ]
    return tuple(bit for bit in told if bit.end > bit.start + 1e-12)


MODIFIED_SINE = (
    Bit(0.0, 0.125, size=1.0, rate=4 * pi),
    Bit(0.125, 0.875, size=1.0, rate=4 * pi / 3, phase=pi / 2),
    Bit(0.875, 1.0, size=-1.0, rate=4 * pi, phase=pi / 2),
)
"""Second derivative of the modified sine: quarter waves at the ends, a slow half wave between."""


def spline_moments(values: Sequence[float] | Reals) -> Reals:
    """Return the second derivatives of a cubic spline at its points, at rest at both ends.

    The points are at equal parts of [0, 1]. The spline's second derivative is continuous and
    straight between them. Source: de Boor, A Practical Guide to Splines, complete spline.
    """
    y = np.asarray(values, float)
    parts = len(y) - 1
    steps = np.concatenate([[0.0], np.diff(y), [0.0]])
    equations = 4.0 * np.eye(parts + 1) + np.eye(parts + 1, k=1) + np.eye(parts + 1, k=-1)
    equations[0, 0] = equations[-1, -1] = 2.0
    return np.asarray(np.linalg.solve(equations, 6.0 * parts**2 * np.diff(steps)))


def law_of(
    name: CamLawName,
    *,
    ratio: float = 1.0,
    ramp: float = 0.125,
    blend: float = 0.0,
    points: Sequence[tuple[float, float]] = (),
    values: Sequence[float] = (),
) -> UnitLaw:
    """Return a law.

    Parameters
    ----------
    ratio : float
        Acceleration over deceleration, of a constant acceleration.
    ramp : float
        Part of the phase in which the acceleration of a trapezoid grows, at most a quarter.
    blend : float
        Part of the phase at either end in which a linear law is run up and down, below a half.
    points : sequence of (float, float)
        Broken line of the second derivative, in any size.
    values : sequence of float
        Second derivatives at equal parts of the phase, straight between, in any size; of a law
        by lifts these, risen or fallen: a cubic spline through them.
    """
    match name:
        case CamLawName.CONSTANT:
            turn = 1 / (1 + ratio)
            rates = (Bit(0, turn, (ratio,)), Bit(turn, 1, (-1.0,)))
            return UnitLaw(name, rates, parameters=(("ratio", ratio),))
        case CamLawName.COSINE | CamLawName.HARMONIC:
            return UnitLaw(name, (Bit(0, 1, size=1.0, rate=pi, phase=pi / 2),))
        case CamLawName.SINE | CamLawName.CYCLOID:
            return UnitLaw(name, (Bit(0, 1, size=1.0, rate=2 * pi),))
        case CamLawName.MODIFIED_SINE:
            return UnitLaw(name, MODIFIED_SINE)
        case CamLawName.TRAPEZOIDAL | CamLawName.MODIFIED:
            trapezoids = _ramped(ramp, sine=name is CamLawName.MODIFIED)
            return UnitLaw(name, trapezoids, parameters=(("ramp", ramp),))
        case CamLawName.LINEAR:
            if not blend:
                return UnitLaw(name, (Bit(0, 1, (0.0,)),), start=1.0)
            bits = (
                Bit(0, blend, (1.0,)),
                Bit(blend, 1 - blend, (0.0,)),
                Bit(1 - blend, 1, (-1.0,)),
            )
            return UnitLaw(name, bits, parameters=(("blend", blend),))
        case CamLawName.CUBIC:
            return UnitLaw(name, (Bit(0, 1, (0.0, 60.0, -180.0, 120.0)),))
        case CamLawName.QUARTIC:
            return UnitLaw(name, (Bit(0, 1, (0.0, 0.0, 420.0, -1680.0, 2100.0, -840.0)),))
        case CamLawName.TABLE | CamLawName.PIECEWISE:
            is_even = name is CamLawName.TABLE
            line, factor = balanced(_evenly_spaced(values) if is_even else points)
            told = ("values", tuple(values)) if is_even else ("points", tuple(points))
            return UnitLaw(name, _straight(line), balance=factor, parameters=(told,))
        case CamLawName.LIFT:
            first, last = values[0], values[-1]
            lifts = [(value - first) / (last - first) for value in values]
            bends = _evenly_spaced([*map(float, spline_moments(lifts))])
            return UnitLaw(name, _straight(bends), parameters=(("values", tuple(values)),))
