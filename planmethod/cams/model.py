"""A cam as its file states it (кулачковый механизм): motions of the follower, geometry."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from enum import Enum
from functools import cached_property
from itertools import pairwise
from math import pi
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from planmethod.cams.laws import Reals, UnitLaw
from planmethod.problem.records import KindProblem

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
    """Parts of a turn (фаза): any dwell above the lowest position is an upper one."""

    RISE = "rise"
    UPPER = "upper_dwell"
    RETURN = "return"
    LOWER = "lower_dwell"


MOVING = (CamPhase.RISE, CamPhase.RETURN)


class CamMotion(Struct, frozen=True):
    """A motion or a dwell of the follower (движение, выстой).

    Attributes
    ----------
    start, length : float, rad
        Of the cam's angle, from the beginning of the turn.
    before, after : float, m
        Displacements of the follower at its ends, from the lowest position.
    law : UnitLaw or None
        None of a dwell.
    """

    phase: CamPhase
    start: float
    length: float
    before: float
    after: float
    law: UnitLaw | None = None

    @property
    def end(self) -> float:
        """Angle of the cam at its end, rad."""
        return self.start + self.length

    @property
    def size(self) -> float:
        """Stroke, m; 0 of a dwell."""
        return abs(self.after - self.before)


class MotionOrder(NamedTuple):
    """A motion as a file orders it: angle, rad; change of the displacement, m; its law."""

    length: float
    change: float
    law: UnitLaw | None = None


def motions_of(orders: Sequence[MotionOrder]) -> tuple[CamMotion, ...]:
    """Return the motions of a turn one after another; those of no angle are left out.

    Displacements count from the lowest one of the turn. Two that differ by a rounding are equal.
    """
    sums = np.concatenate([[0.0], np.cumsum([order.change for order in orders])])
    near = 1e-9 * float(np.ptp(sums))
    levels: list[float] = []
    for height in sums - np.min(sums):
        equal = [one for one in (0.0, *levels) if abs(one - height) <= near]
        levels.append(equal[0] if equal else float(height))
    found: list[CamMotion] = []
    start = 0.0
    for order, (before, after) in zip(orders, pairwise(levels), strict=True):
        if order.length <= 0.0:
            continue
        if order.law is None:
            phase = CamPhase.UPPER if before else CamPhase.LOWER
        else:
            phase = CamPhase.RISE if after > before else CamPhase.RETURN
        found.append(CamMotion(phase, start, order.length, before, after, order.law))
        start += order.length
    return tuple(found)


class Stretch(NamedTuple):
    """Part of the turn on which everything is smooth: its ends, rad; its motion, a bit of it."""

    start: float
    end: float
    motion: CamMotion
    bit: int

    @property
    def phase(self) -> CamPhase:
        """Whether it belongs to a rise, a return, or a dwell."""
        return self.motion.phase


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
    arm : float, m
        From the pivot to the roller; 0 of a translating follower.
    motions : tuple of CamMotion
        Rises, returns and dwells, a turn in all. Displacements of an oscillating follower are
        arcs of its roller, arm times angle.
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
    phase : float or None, rad
        Of a cam on a shaft with others: the shaft's angle at which its turn begins.
    """

    follower: Follower
    contact: Contact
    closure: Closure
    sense: ArmSense
    arm: float
    motions: tuple[CamMotion, ...]
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
    phase: float | None = None

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
    def stroke(self) -> float:
        """Highest displacement of the follower, m."""
        return max(one.after for one in self.motions)

    @property
    def moving(self) -> tuple[CamMotion, ...]:
        """The rises and returns."""
        return tuple(one for one in self.motions if one.phase in MOVING)

    @property
    def laws(self) -> tuple[UnitLaw, ...]:
        """The laws of the rises and returns."""
        return tuple(one.law for one in self.motions if one.law is not None)

    @cached_property
    def has_one_lift(self) -> bool:
        """True if a turn is a rise, an upper dwell, a return, a lower dwell, each at most once."""
        order = [list(CamPhase).index(one.phase) for one in self.motions]
        return order == sorted(set(order)) and len(self.moving) == len(MOVING)

    @property
    def last_dwell(self) -> CamMotion | None:
        """The lower dwell that ends a turn."""
        last = self.motions[-1]
        return last if last.phase is CamPhase.LOWER else None

    def length(self, phase: CamPhase) -> float:
        """Return the angle of all motions or dwells of a phase, rad."""
        return sum(one.length for one in self.motions if one.phase is phase)

    @cached_property
    def stretches(self) -> tuple[Stretch, ...]:
        """The smooth parts of the turn in their order."""
        return tuple(self._stretches())

    def _stretches(self) -> Iterator[Stretch]:
        for one in self.motions:
            if one.law is None:
                yield Stretch(one.start, one.end, one, 0)
                continue
            for k, bit in enumerate(one.law.bits):
                start, end = (one.start + part * one.length for part in (bit.start, bit.end))
                yield Stretch(start, end, one, k)

    def limit(self, phase: CamPhase) -> float | None:
        """Return the allowed pressure angle of rise or return, rad; None: any."""
        return {CamPhase.RISE: self.allowed[0], CamPhase.RETURN: self.allowed[1]}.get(phase)

    def on(self, stretch: Stretch, phi: Reals) -> Reals:
        """Return s, v_q, a_q on a smooth part, m, shape (3, ...): its ends from within."""
        one = stretch.motion
        if one.law is None:
            return np.array([np.full_like(phi, one.before), *np.zeros((2, *np.shape(phi)))])
        change = one.after - one.before
        s, v, a = one.law.on(stretch.bit, (phi - one.start) / one.length)
        s, v, a = one.before + change * s, change * v, change * a
        return np.array([s, v / one.length, a / one.length**2])

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
                size = self.stroke / min(one.length for one in self.moving) ** order
                if abs(after[order] - before[order]) > 1e-9 * size:
                    found.append(Jump(stretch.start, order, before, after))
                    break
        return tuple(found)

    def angles(self) -> Reals:
        """Return the cam's own angles in the positions, rad: on a shaft they are the shaft's."""
        turned = TURN * np.arange(self.count) / self.count
        return turned if self.phase is None else (turned - self.phase) % TURN


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
