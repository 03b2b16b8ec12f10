"""Steps that find an instant centre, and velocities by it (мгновенный центр скоростей на чертеже).

A centre is drawn as `planmethod.solved.centres` finds it: where two of Kennedy's lines meet, or, if
no two lines give it, where the lines across the velocities of two points meet.
"""

from __future__ import annotations

from itertools import combinations
from typing import Protocol

from planmethod.construct.program import Builder
from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.draft import Draft
from planmethod.plans.model import PlanKind
from planmethod.plans.motion.legs import Kinematics
from planmethod.problem.quantities import POLE, QuantityKey, QuantityKind
from planmethod.solved.centres import Centre, Centres, find_centres
from planmethod.solved.solution import Solution

NEAR = 1e-9
"""Part of the greatest distance of a centre below which two centres are one."""

SQUARE = 1e-3
"""Least sine of the angle of the velocities of two points that give a centre."""


class NoCentreError(Exception):
    """A centre is not a point of the drawing: it is at infinity, or the links do not move."""


class ContinuedPlans(Protocol):
    """Plans of a position that are continued: `planmethod.solved.quantity_steps.QuantitySteps`."""

    solution: Solution
    position: int
    kinematics: Kinematics
    draft: Draft
    b: Builder

    @property
    def zero(self) -> NumberName:
        """The number zero."""

    @property
    def free_name(self) -> str:
        """A name that no step has."""

    def point(self, plan: PlanKind, name: str) -> PointName:
        """Return the plan point of a point's name, or the pole."""

    def drawn(self, one: PointName, two: PointName) -> NumberName:
        """Return a distance on the position plan as it was laid off, or is read; mm."""

    def compute(self, *powers: tuple[NumberName, int]) -> NumberName:
        """Return a further product of powers."""


class CentreSteps:
    """Steps of the centres of one position (построение мгновенных центров).

    Parameters
    ----------
    steps : ContinuedPlans
    """

    def __init__(self, steps: ContinuedPlans) -> None:
        self.steps, self.b, self.draft = steps, steps.b, steps.draft
        self.solution, self.position = steps.solution, steps.position
        self._centres: Centres | None = None

    @property
    def centres(self) -> Centres:
        """The centres as they are."""
        if self._centres is None:
            self._centres = find_centres(self.solution, self.position)
        return self._centres

    def point(self, first: str, second: str) -> PointName:
        """Return the centre of two links.

        Raises
        ------
        NoCentreError
        """
        centre = self._of(first, second)
        if centre.is_infinite or centre.at != centre.at:
            raise NoCentreError
        if centre.point or centre.pole:
            return PointName(centre.point or centre.pole)
        name = f"centre {' '.join(centre.links)}"
        if self.b.has(name):
            return PointName(name)
        lines = [self._line(centre, by) for by in centre.by] or self._across_velocities(centre)
        return self.b.intersect_lines(name, *lines)

    def drawn(self, links: tuple[str, str], point: str) -> NumberName:
        """Return the distance of a point from a centre, mm of the drawing.

        Raises
        ------
        NoCentreError
        """
        there = self.steps.point(PlanKind.POSITION, point)
        return self._distance(self.point(*links), there)

    def number(self, key: QuantityKey) -> NumberName:
        """Return a quantity of centres: m, m/s or 1/s.

        Raises
        ------
        NoCentreError
        """
        match key.kind:
            case QuantityKind.CENTRE_DISTANCE:
                one, two, point = key.names
                return self._metres(self.drawn((one, two), point))
            case QuantityKind.CENTRE_OMEGA:
                return self._omega(key.names[0])
            case _:
                return self._velocity(key.names[0])

    # Drawing ---------------------------------------------------------------------------------

    def _of(self, first: str, second: str) -> Centre:
        if first == second or not {first, second} <= {*self.centres.links}:
            raise NoCentreError
        return self.centres.of(first, second)

    def _line(self, centre: Centre, by: str) -> LineName:
        """Return the line of two links' centres with a third one."""
        one, two = (self._of(link, by) for link in centre.links)
        if one.is_infinite:
            one, two = two, one
        start = self.point(*one.links)
        return self._towards(start, two) if two.is_infinite else self._join(start, two)

    def _join(self, start: PointName, centre: Centre) -> LineName:
        return self.b.join(start, self.point(*centre.links))

    def _towards(self, start: PointName, centre: Centre) -> LineName:
        """Return the line from a point towards a centre at infinity."""
        for slide in self.solution.problem.slides.values():
            if centre.slide and {slide.slider, slide.host} == {*centre.links}:
                return self.b.perpendicular(start, self.draft.direction(slide))
        if not centre.by:
            raise NoCentreError
        return self.b.parallel(start, self._line(centre, centre.by[0]))

    def _across_velocities(self, centre: Centre) -> list[LineName]:
        """Return the lines across the velocities of two points of a link, through them."""
        if centre.links[0] != FRAME:
            raise NoCentreError
        link, moving = centre.links[1], dict[str, complex]()
        for point in self.solution.problem.bodies[link].points:
            if point in self.solution.points:
                speed = complex(self.solution.points[point].velocity[self.position])
                if speed:
                    moving[point] = speed / abs(speed)
        pairs = combinations(moving, 2)
        best = max(pairs, key=lambda pair: self._sine(moving, *pair), default=())
        if not best or self._sine(moving, *best) < SQUARE:
            raise NoCentreError
        pole = self.steps.point(PlanKind.VELOCITY, POLE)
        heads = [self.steps.point(PlanKind.VELOCITY, point) for point in best]
        return [
            self.b.perpendicular(PointName(point), self.b.join(pole, head))
            for point, head in zip(best, heads, strict=True)
        ]

    @staticmethod
    def _sine(moving: dict[str, complex], one: str, two: str) -> float:
        return abs((moving[one] * moving[two].conjugate()).imag)

    # Distances and rates ---------------------------------------------------------------------

    def _distance(self, one: PointName, two: PointName) -> NumberName:
        if one == two:
            return self.steps.zero
        name = f"distance {' '.join(sorted((one, two)))}"
        if self.b.has(name):
            return NumberName(name)
        if not any(self.b.has(f"{at}") and str(at).startswith("centre ") for at in (one, two)):
            return self.steps.drawn(one, two)
        return self.b.measure(name, one, two)

    def _metres(self, drawn: NumberName) -> NumberName:
        return self.steps.compute((drawn, 1), (self.draft.mu_l, 1))

    def _omega(self, link: str) -> NumberName:
        """Return the angular velocity of a link by its centres with the frame and the driver."""
        drive, kinematics = self.solution.problem.drive, self.steps.kinematics
        motion = self.centres.motions.get(link)
        if motion is None or drive.other_drives or drive.link not in self.centres.links:
            raise NoCentreError
        own, driver = self._of(FRAME, link), self._of(FRAME, drive.link)
        if link == drive.link and link in kinematics.omega:
            return kinematics.omega[link]
        if own.is_infinite or own.at != own.at:
            return self.steps.zero
        between = self._of(drive.link, link)
        if between.is_infinite and drive.link in kinematics.omega:
            return kinematics.omega[drive.link]  # both turn alike
        arm = self._centre_distance(own, between)
        sign = 1.0 if motion.omega >= 0 else -1.0
        name = self.steps.free_name
        if driver.is_infinite:
            speed, mu = self._driver_speed(), ((self.draft.mu_l, -1),)
            whole = self.b.compute(name, (speed, 1), (arm, -1), *mu, size=True)
        else:
            radius, rate = self._centre_distance(driver, between), kinematics.omega[drive.link]
            whole = self.b.compute(name, (rate, 1), (radius, 1), (arm, -1), size=True)
        return whole if sign > 0 else self.b.compute(self.steps.free_name, (whole, 1), factor=sign)

    def _driver_speed(self) -> NumberName:
        """Return the velocity of a driving slider, m/s."""
        if not self.b.has("v"):
            raise NoCentreError
        return NumberName("v")

    def _centre_distance(self, one: Centre, two: Centre) -> NumberName:
        """Return the distance of two centres on the drawing, mm."""
        size = max(abs(centre.at) for centre in (one, two))
        if not abs(one.at - two.at) > NEAR * size:
            raise NoCentreError
        return self._distance(self.point(*one.links), self.point(*two.links))

    def _velocity(self, point: str) -> NumberName:
        """Return the speed of a point by the centre of its link."""
        steps = self.steps
        if point not in steps.kinematics.velocity.named:
            raise NoCentreError
        link, _ = steps.kinematics.velocity.named[point]
        if link == FRAME:
            return steps.zero
        own = self._of(FRAME, link)
        if not own.is_infinite:
            arm = self.drawn((FRAME, link), point)
            powers = ((self._omega(link), 1), (arm, 1), (self.draft.mu_l, 1))
            return self.b.compute(steps.free_name, *powers, size=True)
        drive = self.solution.problem.drive
        if link == drive.link:
            return self._driver_speed()
        between, driver = self._of(drive.link, link), self._of(FRAME, drive.link)
        if driver.is_infinite:
            raise NoCentreError
        radius = self._centre_distance(driver, between)
        powers = ((steps.kinematics.omega[drive.link], 1), (radius, 1), (self.draft.mu_l, 1))
        return self.b.compute(steps.free_name, *powers, size=True)
