"""The Zhukovsky lever of one position as it is drawn and measured (рычаг Жуковского в масштабе).

The velocity plan is turned by +90 degrees. A couple on a link stands there for its pair of forces
in the link's points: its arm is a segment of the plan over the length of the link, and it turns the
other way where the link goes counter-clockwise, for the segment then lies against the link.
"""

from __future__ import annotations

from dataclasses import dataclass

from planmethod.construct.steps import NumberName, PointName
from planmethod.plans.forceplan import Given
from planmethod.plans.forcereading import ForceReading
from planmethod.plans.model import PlanKind
from planmethod.plans.motion import letter
from planmethod.plans.scaling import own_scale


@dataclass(frozen=True, slots=True)
class HungForce:
    """Force on the lever: letter, where it hangs (mm from the pole), N, and its arm, mm.

    The arm is as the hand measures it, positive where the force turns counter-clockwise.
    """

    symbol: str
    at: complex
    force: complex
    arm: float


@dataclass(frozen=True, slots=True)
class OnLink:
    """Something on a link as the lever has the link.

    ``segment`` is the segment of the plan, mm, that stands for the link; ``joints`` are the
    points of the link at its ends. ``ratio`` is the link's |omega| over the plan's scale, mm/m.
    """

    symbol: str
    link: str
    ratio: float
    segment: tuple[complex, complex] | None
    joints: tuple[str, str] | None


@dataclass(frozen=True, slots=True)
class HungCouple(OnLink):
    """Couple on the lever: its letter, its link, and its moment about the pole, N·mm."""

    moment: float
    lever_moment: float


@dataclass(frozen=True, slots=True)
class HungShift(OnLink):
    """Shift h of a force of inertia on the lever: from the centre of mass s to the point t, mm.

    ``letters`` are those of s and t, in rich text.
    """

    letters: tuple[str, str]
    ends: tuple[complex, complex]


class LeverReading:
    """The lever of one position.

    Attributes
    ----------
    forces : list of HungForce
        Those that do work; last the balancing one of a driving slider.
    couples : list of HungCouple
        Those that do work; last the balancing one of a crank, as the hand finds it on the lever.
    shifts : list of HungShift
        Of the forces of inertia that are moved off the centre of mass.
    """

    def __init__(self, reading: ForceReading) -> None:
        solution, index = reading.solution, reading.index
        assert reading.statics.hung is not None
        self.reading = reading
        common = solution.scales[PlanKind.VELOCITY].per_mm
        self.per_mm = own_scale(solution, PlanKind.VELOCITY, index).per_mm
        self._share = common / self.per_mm
        self.forces: list[HungForce] = []
        self.couples: list[HungCouple] = []
        self.shifts: list[HungShift] = []
        for given, at in reading.statics.hung.hung:
            one = given.applied
            if at is None:
                assert given.couple is not None
                moment = reading.number(given.couple)
                if abs(moment) > 1e-9 * reading.peak_moment:
                    self.couples.append(self._couple(one.name, one.link, moment))
                continue
            force, place = complex(one.force[index]), reading.end(at) * self._share
            if abs(force) > 1e-9 * reading.peak:
                self.forces.append(self._force(one.name, place, force))
                self._shift(given, place)
        self._balance(reading.statics.hung.balance)

    def _balance(self, balance: NumberName) -> None:
        reading, drive = self.reading, self.reading.solution.problem.drive
        driving = reading.statics.driving
        if driving.force is None:
            moment = reading.read_number(balance)
            if moment:
                self.couples.append(self._couple(reading.balancing_symbol, drive.link, moment))
            return
        motion = reading.solution.construction.kinematics.velocity
        pin = reading.solution.problem.slides[drive.link].pin
        force = reading.of_force(driving.force)
        if force:
            place = self.place(motion.point[drive.link, pin])
            self.forces.append(self._force(reading.balancing_symbol, place, force))

    def _force(self, symbol: str, place: complex, force: complex) -> HungForce:
        arm = (place.conjugate() * force).imag / abs(force)
        return HungForce(symbol, place, force, float(self.reading.solution.hand.ruled(arm)))

    def place(self, point: PointName) -> complex:
        """Return a point of the velocity plan on the lever, mm from the pole."""
        solution = self.reading.solution
        at = complex(solution.complexes(solution.paper, point)[self.reading.index])
        return 1j * at * self._share

    def _couple(self, symbol: str, link: str, moment: float) -> HungCouple:
        omega = float(self.reading.solution.links[link].omega[self.reading.index])
        own = self._on(link)
        return HungCouple(symbol, link, *own, moment, -moment * omega / self.per_mm)

    def _shift(self, given: Given, place: complex) -> None:
        """Note the shift of a force that hangs beside its centre of mass."""
        link = given.applied.link
        shift = self.reading.statics.board.shifts.get(link)
        if shift is None or given.force is None or given.force.at != shift.at:
            return
        assert given.applied.point is not None
        motion = self.reading.solution.construction.kinematics.velocity
        centre = self.place(motion.point[motion.named[given.applied.point]])
        letters = letter(given.applied.point), f"t{shift.letter[1:]}"
        own = self._on(link)
        self.shifts.append(HungShift(f"h_{{{link}}}", link, *own, letters, (centre, place)))

    def _on(
        self, link: str
    ) -> tuple[float, tuple[complex, complex] | None, tuple[str, str] | None]:
        """Return the ratio of a link, its segment on the plan and the joints at its ends."""
        solution = self.reading.solution
        kin = solution.construction.kinematics
        omega = float(solution.links[link].omega[self.reading.index])
        ratio = abs(omega) / self.per_mm
        segment, joints = None, None
        for (kind, other), turning in kin.turnings.items():
            if kind is PlanKind.VELOCITY and kin.omega.get(other) == kin.omega.get(link):
                segment = (self.place(turning.start), self.place(turning.head))
                joints = (str(turning.joint), str(turning.place))
        if segment is None and link == solution.problem.drive.link:
            segment, joints = self._crank()
        return ratio, segment, joints

    def _crank(self) -> tuple[tuple[complex, complex], tuple[str, str]]:
        """Return the pole and the point of the crank's end, and the crank's points."""
        solution = self.reading.solution
        drive, motion = solution.problem.drive, solution.construction.kinematics.velocity
        assert drive.pivot is not None
        own = solution.problem.bodies[drive.link].points
        pin = next(point for point in own if point != drive.pivot)
        end = self.place(motion.point[drive.link, pin])
        return (0j, end), (drive.pivot, pin)
