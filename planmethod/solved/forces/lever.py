"""The Zhukovsky lever of one position as it is drawn and measured (рычаг Жуковского в масштабе).

The velocity plan is turned by +90 degrees. A couple on a link is drawn there as its pair of forces
in the link's points: its arm is a segment of the plan over the length of the link, and its sense is
reversed if the link rotates counter-clockwise, because the segment then points against the link.
"""

from __future__ import annotations

from math import copysign, isfinite
from typing import TypeAlias

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.steps import NumberName, PointName
from planmethod.plans.forces.board import GivenLoad
from planmethod.plans.forces.dyads import Driving
from planmethod.plans.model import PlanKind
from planmethod.plans.motion.board import MotionBoard, letter
from planmethod.solved.forces.reading import ForceReading

_Own: TypeAlias = tuple[
    float,
    tuple[complex, complex] | None,
    tuple[PointName, PointName] | None,
    tuple[str, str] | None,
    float,
]


class LeverForce(Struct, frozen=True):
    """Force on the lever: letter, where it hangs (mm from the pole), N, and its arm, mm.

    The arm is the measured one, positive where the force turns counter-clockwise; ``size`` is the
    force as read by hand, N. ``point`` is the point of the mechanism where it acts. The arm is
    measured from the place ``about``, which for a pair of forces is the place of the other.
    """

    symbol: str
    at: complex
    force: complex
    arm: float
    size: float
    point: str
    about: complex = 0j


class LeverSegment(Struct, frozen=True):
    """A segment of the lever that represents a link.

    ``segment`` is the segment of the plan, mm, that represents the link, ``ends`` are its points,
    ``joints`` those of the link, ``joint_distance`` is their distance as read by hand, m.
    ``ratio`` is the link's |omega| as read by hand over the plan's scale, mm/m.
    """

    symbol: str
    link: str
    ratio: float
    segment: tuple[complex, complex] | None
    ends: tuple[PointName, PointName] | None
    joints: tuple[str, str] | None
    joint_distance: float


class LeverCouple(LeverSegment, frozen=True):
    """Couple on the lever: its letter, its link, and its moment about the pole, N·mm.

    ``moment`` is that on the link as read by hand, N·m.
    """

    moment: float
    lever_moment: float


class LeverShift(LeverSegment, frozen=True):
    """Shift h of a force of inertia on the lever: from the centre of mass s to the point t, mm.

    ``letters`` are those of s and t, in rich text; ``line`` is where they are. ``shift`` is h as
    read by hand, m.
    """

    letters: tuple[str, str]
    line: tuple[complex, complex]
    shift: float


class LeverReading:
    """The lever of one position.

    Parameters
    ----------
    reading : ForceReading

    Attributes
    ----------
    times : float
        How many times larger than the velocity plan it is drawn.
    scale : Scale
        That of its segments.
    forces : list of LeverForce
        Forces that do work; last the balancing one of a driving slider.
    couples : list of LeverCouple
        Couples that do work; last the balancing one of a crank, as found by hand on the lever.
    shifts : list of LeverShift
        Of the forces of inertia that are moved off the centre of mass.
    """

    def __init__(self, reading: ForceReading) -> None:
        solution, index = reading.solution, reading.index
        assert reading.statics.lever_plan is not None
        self.reading = reading
        self.times = float(reading.statics.lever_times[index])
        own = solution.plan_scale(PlanKind.VELOCITY, index)
        self.scale = replace(own, per_mm=own.per_mm / self.times)
        self.per_mm = self.scale.per_mm
        self.forces: list[LeverForce] = []
        self.couples: list[LeverCouple] = []
        self.shifts: list[LeverShift] = []
        pole = reading.statics.lever_plan.pole
        for hung in reading.statics.lever_plan.loads:
            given, at, one = hung.load, hung.at, hung.load.applied
            if at is None or hung.arm is None:
                assert given.couple is not None
                if abs(reading.number(given.couple)) > 1e-9 * reading.peak_moment:
                    moment = reading.read_number(given.couple)
                    self.couples.append(self._couple(one.name, one.link, moment))
                continue
            force, place = complex(one.force[index]), self._hung(at, pole)
            if abs(force) > 1e-9 * reading.peak:
                assert given.force is not None and one.point is not None
                way = reading.drawn_direction(given.force)
                force = way * (abs(force) / abs(way))
                size, arm = reading.read_load(given), reading.read_number(hung.arm) * self.times
                self.forces.append(LeverForce(one.name, place, force, arm, size, one.point))
                self._shift(given, place)
        self._balance(reading.statics.lever_plan.balance)

    def _balance(self, balance: NumberName) -> None:
        reading, drive = self.reading, self.reading.solution.problem.drive
        pushing = reading.statics.driving.force
        if reading.statics.driving.between is not None:
            self._push(reading.statics.driving)
            return
        if pushing is None:
            if self.forces or self.couples:  # where they cancel, too
                moment = reading.read_number(balance)
                self.couples.append(self._couple(reading.balancing_symbol, drive.link, moment))
            return
        motion = reading.solution.construction.kinematics.velocity
        pin = str(pushing.at)
        force = reading.of_force(pushing)
        if force:
            place = self.place(motion.point[drive.link, pin])
            # Its arm is the driver's own velocity, laid off and not measured, if it is along that.
            arm, size = _moment_arm(place, force), abs(reading.read_number(balance))
            measured = reading.statics.lever_plan.arm if reading.statics.lever_plan else None
            if measured is not None:
                arm = copysign(reading.read_number(measured) * self.times, arm)
            self.forces.append(LeverForce(reading.balancing_symbol, place, force, arm, size, pin))

    def _push(self, driving: Driving) -> None:
        """Apply the force of an actuator at both its ends: the second has the arm of the pair."""
        reading, hung = self.reading, self.reading.statics.lever_plan
        assert driving.between is not None and driving.force is not None
        assert hung is not None and hung.arm is not None
        force, motion = reading.of_force(driving.force), self._motion
        if not force or not (self.forces or self.couples):
            return
        size = abs(reading.read_number(hung.balance))
        arm = reading.read_number(hung.arm) * self.times
        arm = -arm if reading.number(driving.balance) < 0 else arm
        one, two = (self.place(motion.point[motion.named[end]]) for end in driving.between)
        symbol, (first, second) = reading.balancing_symbol, driving.between
        self.forces.append(LeverForce(symbol, one, -force, 0.0, size, first))
        self.forces.append(LeverForce(symbol, two, force, arm, size, second, one))

    @property
    def _motion(self) -> MotionBoard:
        return self.reading.solution.construction.kinematics.velocity

    def place(self, point: PointName) -> complex:
        """Return a point of the velocity plan on the lever as drawn by hand, mm from the pole."""
        solution, index = self.reading.solution, self.reading.index
        drawn, exact = (r.point(point)[index] for r in (solution.ruler_reading, solution.paper))
        return 1j * self.times * complex(drawn if isfinite(abs(drawn)) else exact)

    def _hung(self, at: PointName, pole: PointName) -> complex:
        """Return the place of a force as drawn by hand, mm from the pole; else the exact place."""
        drawn = self.reading.drawn_segment(pole, at)
        return self.times * (drawn if isfinite(abs(drawn)) else self.reading.end(at))

    def _couple(self, symbol: str, link: str, moment: float) -> LeverCouple:
        turned = -moment * self._omega(link) / self.per_mm
        return LeverCouple(symbol, link, *self._on(link), moment, turned)

    def _shift(self, load: GivenLoad, place: complex) -> None:
        """Note the shift of a force that acts beside its centre of mass."""
        link = load.applied.link
        shift = self.reading.statics.board.shifts.get(link)
        if shift is None or load.force is None or load.force.at != shift.at:
            return
        assert load.applied.point is not None
        motion = self.reading.solution.construction.kinematics.velocity
        centre = self.place(motion.point[motion.named[load.applied.point]])
        letters = letter(load.applied.point), f"t{shift.letter[1:]}"
        mu_l = self.reading.solution.scales[PlanKind.POSITION].per_mm
        length, line = abs(self.reading.read_number(shift.length)) * mu_l, (centre, place)
        self.shifts.append(
            LeverShift(f"h_{{{link}}}", link, *self._on(link), letters, line, length)
        )

    def _omega(self, link: str) -> float:
        """Return the angular velocity of a link as read by hand, 1/s."""
        solution = self.reading.solution
        name = solution.construction.kinematics.omega[link]
        return float(solution.ruler_reading.number(name)[self.reading.index])

    def _on(self, link: str) -> _Own:
        """Return the ratio of a link, its segment on the plan, its ends and their joints."""
        solution = self.reading.solution
        kinematics = solution.construction.kinematics
        ends, joints, length = None, None, 0.0
        for (kind, other), turning in kinematics.turnings.items():
            if kind is PlanKind.VELOCITY and kinematics.omega.get(other) == kinematics.omega.get(
                link
            ):
                ends = (turning.start, turning.head)
                joints = (str(turning.joint), str(turning.place))
                length = self.reading.read_product(turning.arm)
        if ends is None and link == solution.problem.drive.link:
            ends, joints = self._crank()
            own = solution.problem.bodies[link].points
            length = abs(own[joints[1]] - own[joints[0]])
        segment = None if ends is None else (self.place(ends[0]), self.place(ends[1]))
        return abs(self._omega(link)) / self.per_mm, segment, ends, joints, length

    def _crank(self) -> tuple[tuple[PointName, PointName], tuple[str, str]]:
        """Return the pole and the point of the crank's end, and the crank's points."""
        solution = self.reading.solution
        drive, motion = solution.problem.drive, solution.construction.kinematics.velocity
        assert drive.pivot is not None
        own = solution.problem.bodies[drive.link].points
        pin = next(point for point in own if point != drive.pivot)
        return (motion.pole, motion.point[drive.link, pin]), (drive.pivot, pin)


def _moment_arm(place: complex, force: complex) -> float:
    """Return the arm of a force at a place about the origin, positive counter-clockwise."""
    return (place.conjugate() * force).imag / abs(force) if abs(force) else 0.0
