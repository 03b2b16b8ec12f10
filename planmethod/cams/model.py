"""A cam as its file states it (кулачковый механизм): laws of motion, contact geometry."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from enum import Enum
from functools import cached_property
from itertools import pairwise
from math import pi
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from planmethod.problem.records import KindProblem

Reals: TypeAlias = NDArray[np.float64]


class CamLawName(Enum):
    """Names of the laws in files (закон движения)."""

    CONSTANT = "constant-acceleration"
    COSINE = "cosine"
    SINE = "sine"
    TRAPEZOIDAL = "trapezoidal"
    MODIFIED = "modified-trapezoidal"
    LINEAR = "linear"
    CUBIC = "3-4-5"
    QUARTIC = "4-5-6-7"
    TABLE = "table"
    PIECEWISE = "piecewise-linear"


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
        Second derivatives at equal parts of the phase, straight between, in any size.
    """
    match name:
        case CamLawName.CONSTANT:
            turn = 1 / (1 + ratio)
            rates = (Bit(0, turn, (ratio,)), Bit(turn, 1, (-1.0,)))
            return UnitLaw(name, rates, parameters=(("ratio", ratio),))
        case CamLawName.COSINE:
            return UnitLaw(name, (Bit(0, 1, size=1.0, rate=pi, phase=pi / 2),))
        case CamLawName.SINE:
            return UnitLaw(name, (Bit(0, 1, size=1.0, rate=2 * pi),))
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


TURN = 2 * pi


class Follower(Enum):
    """Motion of the follower (вид толкателя)."""

    TRANSLATING = "translating"
    OSCILLATING = "oscillating"


class Contact(Enum):
    """Contact of the follower with the cam (вид контакта)."""

    ROLLER = "roller"
    POINTED = "pointed"
    FLAT = "flat"


class Closure(Enum):
    """Closure of the follower and the cam (замыкание): a spring, or a groove."""

    FORCE = "force"
    FORM = "form"


class ArmSense(Enum):
    """Sense of an oscillating follower's rise, with or against the cam (направление поворота)."""

    OPPOSITE = "opposite"
    SAME = "same"


class CamPhase(Enum):
    """Parts of a turn (фаза)."""

    RISE = "rise"
    UPPER = "upper_dwell"
    RETURN = "return"
    LOWER = "lower_dwell"


class Stretch(NamedTuple):
    """Part of the turn on which everything is smooth: its ends, rad; its phase and bit."""

    start: float
    end: float
    phase: CamPhase
    bit: int


class Jump(NamedTuple):
    """A jump of the analogue of the velocity (order 1) or of the acceleration (2).

    ``before`` and ``after`` are s, v_q, a_q on both sides of it, m.
    """

    phi: float
    order: int
    before: Reals
    after: Reals


class CamProblem(KindProblem, frozen=True, kw_only=True, dict=True):
    """A cam and its follower (кулачковый механизм).

    Attributes
    ----------
    stroke : float, m
        Of an oscillating follower the arc of its roller, arm times swing.
    arm : float, m
        From the pivot to the roller; 0 of a translating follower.
    phases : (float, float, float, float), rad
        Rise, upper dwell, return, lower dwell: a turn in all.
    laws : (UnitLaw, UnitLaw)
        Of rise and return.
    allowed : (float, float or None), rad
        Pressure angle of rise and return; None: any.
    offset, r_min, roller, centre : float or None, m
        None: chosen.
    min_radius : float, m
        Minimum allowed radius of curvature under a flat-faced follower.
    count : int
        Positions of a turn.
    n : float or None, rev/min
        Of the cam, counter-clockwise positive.
    mass, load, margin : float
        Of the follower, kg; force on it against the rise, N; margin of
        the spring force over the required one.
    """

    follower: Follower
    contact: Contact
    closure: Closure
    sense: ArmSense
    stroke: float
    arm: float
    phases: tuple[float, float, float, float]
    laws: tuple[UnitLaw, UnitLaw]
    allowed: tuple[float, float | None]
    offset: float | None
    r_min: float | None
    roller: float | None
    centre: float | None
    min_radius: float
    count: int
    parts: int
    n: float | None
    mass: float
    load: float
    margin: float

    @property
    def oscillates(self) -> bool:
        """True if the follower swings about a pivot."""
        return self.follower is Follower.OSCILLATING

    @property
    def mirror(self) -> int:
        """-1 of a clockwise cam, which is the mirror image, else 1."""
        return -1 if (self.n or 0.0) < 0 else 1

    @property
    def has_forces(self) -> bool:
        """True if the file gives the sources of the forces on the follower."""
        return bool(self.mass and self.n)

    @cached_property
    def starts(self) -> dict[CamPhase, float]:
        """Starts of the phases, rad from the start of the rise."""
        sums = np.concatenate([[0.0], np.cumsum(self.phases)])
        return {phase: float(at) for phase, at in zip(CamPhase, sums, strict=False)}

    def length(self, phase: CamPhase) -> float:
        """Return the length of a phase, rad."""
        return self.phases[list(CamPhase).index(phase)]

    @cached_property
    def stretches(self) -> tuple[Stretch, ...]:
        """The smooth parts of the turn in their order."""
        return tuple(self._stretches())

    def _stretches(self) -> Iterator[Stretch]:
        for phase in CamPhase:
            start, length = self.starts[phase], self.length(phase)
            law = self.law(phase)
            if length <= 0:
                continue
            if law is None:
                yield Stretch(start, start + length, phase, 0)
                continue
            for k, bit in enumerate(law.bits):
                yield Stretch(start + bit.start * length, start + bit.end * length, phase, k)

    def law(self, phase: CamPhase) -> UnitLaw | None:
        """Return the law of a phase; None of a dwell."""
        return {CamPhase.RISE: self.laws[0], CamPhase.RETURN: self.laws[1]}.get(phase)

    def limit(self, phase: CamPhase) -> float | None:
        """Return the allowed pressure angle of rise or return, rad; None: any."""
        return {CamPhase.RISE: self.allowed[0], CamPhase.RETURN: self.allowed[1]}.get(phase)

    def on(self, stretch: Stretch, phi: Reals) -> Reals:
        """Return s, v_q, a_q on a smooth part, m, shape (3, ...): its ends from within."""
        law, length = self.law(stretch.phase), self.length(stretch.phase)
        if law is None:
            return np.array(
                [
                    np.full_like(phi, self.stroke if stretch.phase is CamPhase.UPPER else 0.0),
                    *np.zeros((2, *np.shape(phi))),
                ]
            )
        u = (phi - self.starts[stretch.phase]) / length
        s, v, a = self.stroke * law.on(stretch.bit, u)
        if stretch.phase is CamPhase.RETURN:
            s, v, a = self.stroke - s, -v, -a
        return np.array([s, v / length, a / length**2])

    def at(self, phi: Reals) -> Reals:
        """Return s, v_q, a_q at angles of a turn, m, shape (3, n); after a jump."""
        turned = np.ravel(phi) % TURN
        starts = np.array([one.start for one in self.stretches])
        which = np.searchsorted(starts, turned + 1e-12 * TURN, side="right") - 1
        found = np.empty((3, len(turned)))
        for k in np.unique(which):
            found[:, which == k] = self.on(self.stretches[k], turned[which == k])
        return found

    @cached_property
    def jumps(self) -> tuple[Jump, ...]:
        """Jumps of v_q (жёсткий удар), else of a_q (мягкий удар)."""
        found = []
        for k, stretch in enumerate(self.stretches):
            last = self.stretches[k - 1]
            before = self.on(last, np.array(last.end))
            after = self.on(stretch, np.array(stretch.start))
            for order in (1, 2):
                size = self.stroke / min(self.phases[0], self.phases[2]) ** order
                if abs(after[order] - before[order]) > 1e-9 * size:
                    found.append(Jump(stretch.start, order, before, after))
                    break
        return tuple(found)

    def angles(self) -> Reals:
        """Return the angles of the positions, rad."""
        return TURN * np.arange(self.count) / self.count


Complexes: TypeAlias = NDArray[np.complexfloating[Any, Any]]


class CamPoints(NamedTuple):
    """Points and angles for angles of the cam; all arrays have their shape.

    ``roller``: its centre (the pointed edge, the point of the flat face) in the resting frame;
    ``theoretical``, ``actual``, ``outer``: profiles in the frame of the cam, the last is the other
    side of a groove; ``pressure`` rad; ``curvature`` of the pitch curve, 1/m; ``normal``
    the outward unit normal in the resting frame.
    """

    roller: Complexes
    theoretical: Complexes
    actual: Complexes
    outer: Complexes
    pressure: Reals
    curvature: Reals
    normal: Complexes


class CamGeometry(Struct, frozen=True):
    """A cam with known sizes.

    Attributes
    ----------
    r_min, e, centre, roller : float, m
        Minimum radius of the pitch curve (for a flat face: its minimum distance from the axis),
        offset, distance of the pivot (0: none), radius of the roller (0: none).
    """

    problem: CamProblem
    r_min: float
    e: float = 0.0
    centre: float = 0.0
    roller: float = 0.0

    @property
    def s0(self) -> float:
        """Height of the roller above the axis at rest, m."""
        return float(np.sqrt(self.r_min**2 - self.e**2))

    @property
    def delta0(self) -> float:
        """Angle between the arm at rest, or the flat face, and the line of centres, rad."""
        if self.problem.contact is Contact.FLAT:
            return float(np.arcsin(self.r_min / self.centre))
        arm, a = self.problem.arm, self.centre
        return float(np.arccos((a * a + arm * arm - self.r_min**2) / (2 * a * arm)))

    @property
    def side(self) -> int:
        """1 where the arm rises against the cam's turning, its pivot on the right; else -1."""
        return 1 if self.problem.sense.value == "opposite" else -1

    @property
    def pivot(self) -> complex:
        """Pivot of an oscillating follower in the resting frame, m."""
        return complex(self.side * self.centre)

    def points(self, phi: Reals, motion: Reals) -> CamPoints:
        """Return the points for angles of the cam.

        Parameters
        ----------
        phi : array of float, rad
        motion : array of float, shape (3, ...)
            s, v_q, a_q there, m.
        """
        flat = self.problem.contact is Contact.FLAT
        if self.problem.oscillates:
            made = self._plate if flat else self._arm
        else:
            made = self._level if flat else self._line
        roller, normal, pressure, curvature = made(motion)
        turn = np.exp(-1j * phi)
        shift = 0.0 if flat else self.roller * normal
        actual, outer = (roller - shift) * turn, (roller + shift) * turn
        return CamPoints(roller, roller * turn, actual, outer, pressure, curvature, normal)

    def _traced(
        self, b: Complexes, b1: Complexes, b2: Complexes, direction: Complexes
    ) -> tuple[Complexes, Complexes, Reals, Reals]:
        """Return centre, normal, pressure angle and curvature of a centre and its derivatives."""
        w = b1 - 1j * b  # seen from the cam
        w1 = b2 - 1j * b1
        size = np.abs(w)
        q = w / direction
        pressure = np.arctan2(q.real, -q.imag)
        curvature = (size**2 - np.imag(np.conj(w) * w1)) / size**3
        return b, 1j * w / size, pressure, curvature

    def _line(self, motion: Reals) -> tuple[Complexes, Complexes, Reals, Reals]:
        s, v, a = motion
        return self._traced(self.e + 1j * (self.s0 + s), 1j * v, 1j * a, 1j * np.ones_like(s))

    def _arm(self, motion: Reals) -> tuple[Complexes, Complexes, Reals, Reals]:
        arm, side = self.problem.arm, self.side
        s, v, a = motion / arm
        out = -side * np.exp(-1j * side * (self.delta0 + s))  # from the pivot to the roller
        b1 = -1j * side * v * arm * out
        b2 = (-1j * side * a - v * v) * arm * out
        return self._traced(self.pivot + arm * out, b1, b2, -1j * side * out)

    def _level(self, motion: Reals) -> tuple[Complexes, Complexes, Reals, Reals]:
        s, v, a = motion
        with np.errstate(divide="ignore"):
            curvature = 1 / (self.r_min + s + a)
        return v + 1j * (self.r_min + s), np.full(np.shape(s), 1j), 0 * s, curvature

    def _plate(self, motion: Reals) -> tuple[Complexes, Complexes, Reals, Reals]:
        side, centre = self.side, self.centre
        s, v, a = motion / self.problem.arm
        delta, ahead = self.delta0 + s, 1 + side * v
        out = -side * np.exp(-1j * side * delta)
        reach = centre * np.cos(delta) / ahead
        bend = np.sin(delta) * (1 + 2 * side * v) / ahead**2 + np.cos(delta) * a / ahead**3
        with np.errstate(divide="ignore"):
            curvature = 1 / (centre * bend)
        return self.pivot + reach * out, -1j * side * out, 0 * s, curvature

    def at(self, phi: Reals) -> CamPoints:
        """Return the same at angles of a turn; after a jump."""
        return self.points(phi, self.problem.at(phi))
