"""A cam as its file states it (кулачковый механизм), and how its follower moves."""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum
from functools import cached_property
from math import pi
from typing import NamedTuple

import numpy as np

from planmethod.cams.laws import Reals, UnitLaw
from planmethod.problem.common import KindProblem

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
