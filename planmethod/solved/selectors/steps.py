"""Steps that answer the selectors of ``[published]``: they continue the program."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from functools import cached_property

from msgspec import Struct

from planmethod.construct.steps import LayOffLength, NumberName, PointName, Step
from planmethod.mechanism.model import FRAME
from planmethod.plans.build import ZERO, TransferSteps
from planmethod.plans.draft import Draft
from planmethod.plans.model import FACTS, MOTION, RATES, PlanKind, Segments
from planmethod.plans.motion.legs import MotionBoard
from planmethod.problem.answers import ANALOGUES, POLE, TRANSFERS, Selector
from planmethod.solved.solution import Solution

PLANS: Mapping[str, PlanKind] = {
    "length": PlanKind.POSITION,
    **{f"segment {kind.value}": kind for kind in RATES},
}
"""Quantities in millimetres of a plan, and of which."""

COMPONENTS: Mapping[str, PlanKind] = {
    f"{'' if kind is PlanKind.POSITION else FACTS[kind].letter}{axis}": kind
    for kind in MOTION
    for axis in "xy"
}

MAGNITUDES: Mapping[str, PlanKind] = {
    **{FACTS[kind].letter: kind for kind in RATES},
    "vs": PlanKind.VELOCITY,
}


class NoValue(Enum):
    """Reason why a quantity has no value."""

    NO_QUANTITY = "no what"  # the file does not specify the quantity
    NO_POSITION = "no position"  # the driver is never there
    NO_SCALE = "no scale"  # millimetres of a plan whose scale the source does not give
    NO_POINT = "no point"  # a name that the plans do not have
    NO_LINK = "no link"  # turning of a point about one that no link joins it to
    NO_ARM = "no arm"  # a force in the axis of the crank cannot balance it
    NO_CRANK = "no crank"  # transfer functions are by the angle of a crank that turns
    NO_SLIDING = "no sliding"  # the points are not a prismatic pair's
    ZERO_DIVISOR = "zero divisor"
    NO_FORCES = "no forces"  # the file has neither masses nor loads
    NO_JOINT = "no joint"  # the links do not touch each other
    NO_DIRECTION = "no direction"  # a zero force has no angle and no arm
    NO_MACHINE = "no machine"  # the file has no [machine]
    AT_REST = "stands"  # the lever of a driving link that does not move


class NoValueError(Exception):
    """A selector requests a value that the solution does not have."""

    def __init__(self, reason: NoValue) -> None:
        super().__init__(reason.value)
        self.reason = reason


class Selected(Struct, frozen=True):
    """Number that answers a selector, or a quotient of two.

    Attributes
    ----------
    name : NumberName
    plan : PlanKind or None
        Plan in whose millimetres it is a length; None of a quantity.
    signed : bool
        The sign belongs to it.
    """

    name: NumberName
    plan: PlanKind | None = None
    signed: bool = False


class SelectorSteps:
    """Steps that a selector needs beyond those of the program (что спрашивается).

    Parameters
    ----------
    solution : Solution
    draft : Draft
        Construction that is continued.
    """

    def __init__(self, solution: Solution, draft: Draft) -> None:
        self.solution, self.draft, self.kinematics = (
            solution,
            draft,
            solution.construction.kinematics,
        )
        self.b = draft.b
        self._done = len(self.b.steps)
        self._segments = {
            motion.kind: motion.segments.on(draft.b)
            for motion in (self.kinematics.velocity, self.kinematics.acceleration)
        }

    @property
    def steps(self) -> list[Step]:
        """The further steps."""
        return self.b.steps[self._done :]

    def segments(self, plan: PlanKind) -> Segments:
        """Return the segments of the velocity or the acceleration plan."""
        return self._segments[plan]

    def motion(self, plan: PlanKind) -> MotionBoard:
        """Return the points of the velocity or the acceleration plan."""
        return (
            self.kinematics.acceleration
            if plan is PlanKind.ACCELERATION
            else self.kinematics.velocity
        )

    @property
    def free_name(self) -> str:
        """A name that no step has."""
        return f"asked{len(self.b.steps)}"

    def compute(self, *powers: tuple[NumberName, int]) -> NumberName:
        """Return a further product of powers."""
        return self.b.compute(self.free_name, *powers)

    def select(self, selector: Selector) -> Selected:
        """Return the number that a selector of the motion requests.

        Raises
        ------
        NoValueError
            When the solution has no such quantity.
        """
        kind, names = selector.kind, selector.names
        if kind in COMPONENTS:
            return self._component(COMPONENTS[kind], names[0], kind[-1])
        if kind in MAGNITUDES:
            plan = MAGNITUDES[kind]
            about = names[1] if len(names) > 1 else POLE
            return Selected(self._value(plan, about, names[0]))
        if kind in PLANS:
            return self._length(PLANS[kind], *names)
        if kind in ("an", "at"):
            link, arm = self.arm(*names)
            rates, power = (
                (self.kinematics.omega, 2) if kind == "an" else (self.kinematics.epsilon, 1)
            )
            return Selected(
                self.compute((rates[link], power), *arm) if link in rates else self.zero
            )
        if kind in ("ak", "ar"):
            return Selected(self.relative(kind, *names))
        if kind in TRANSFERS:
            return self._transfer(kind, names)
        if kind in ANALOGUES:
            raise NoValueError(NoValue.NO_QUANTITY)  # no plan has them
        (link,) = names
        if link not in self.solution.links:
            raise NoValueError(NoValue.NO_LINK)
        rates = self.kinematics.omega if kind == "omega" else self.kinematics.epsilon
        return Selected(rates.get(link, self.zero), signed=True)

    @cached_property
    def _transfers(self) -> TransferSteps:
        drive = self.solution.problem.drive
        if not drive.revolves or drive.rate == 0.0:
            raise NoValueError(NoValue.NO_CRANK)
        return TransferSteps(self.kinematics, self.draft, by_values=True)

    def _transfer(self, kind: str, names: tuple[str, ...]) -> Selected:
        """Return a transfer function; u of other links than the crank is ω over ω."""
        steps, plan = (
            self._transfers,
            PlanKind.VELOCITY if kind in "v_q u" else PlanKind.ACCELERATION,
        )
        if kind in ("v_q", "a_q"):
            if names[0] not in self.kinematics.velocity.named:
                raise NoValueError(NoValue.NO_POINT)
            return Selected(steps.of_point(names[0], plan))
        if not set(names) <= set(self.solution.links):
            raise NoValueError(NoValue.NO_LINK)
        crank = self.solution.problem.drive.link
        first, *others = names
        found = steps.of_link(first, plan)
        if others in ([], [crank]):
            return Selected(found, signed=True)
        if others[0] not in self.kinematics.omega:
            raise NoValueError(NoValue.ZERO_DIVISOR)
        below = steps.of_link(others[0], plan)
        return Selected(self.compute((found, 1), (below, -1)), signed=True)

    @property
    def zero(self) -> NumberName:
        """The number zero."""
        return self.draft.known(ZERO, 0.0)

    def _component(self, plan: PlanKind, name: str, axis: str) -> Selected:
        pole, head = self.point(plan, POLE), self.point(plan, name)
        angle = self.draft.known(f"angle_{axis}", 0.0 if axis == "x" else 90.0)
        line = self.b.at_angle(pole, None, angle)
        length = self.b.measure_along(self.free_name, pole, head, line)
        return Selected(self.compute((self._scale(plan), 1), (length, 1)), signed=True)

    def _scale(self, plan: PlanKind) -> NumberName:
        return self.draft.mu_l if plan is PlanKind.POSITION else self._segments[plan].scale

    def _value(self, plan: PlanKind, tail: str, head: str) -> NumberName:
        one, two = self.point(plan, tail), self.point(plan, head)
        if one == two:
            return self.zero
        return self._segments[plan].value(one, two, self.free_name)

    def _length(self, plan: PlanKind, tail: str, head: str) -> Selected:
        one, two = self.point(plan, tail), self.point(plan, head)
        if one == two:
            return Selected(self.zero, plan)
        if plan is not PlanKind.POSITION:
            return Selected(self._segments[plan].length(one, two), plan)
        return Selected(self.drawn(one, two), plan)

    def drawn(self, one: PointName, two: PointName) -> NumberName:
        """Return a distance on the position plan as it was laid off, or is read; mm."""
        for step in self.b.steps:
            if isinstance(step, LayOffLength) and (step.origin, step.out) == (one, two):
                return step.length
        return self.draft.measured(one, two)

    def arm(self, point: str, about: str) -> tuple[str, tuple[tuple[NumberName, int], ...]]:
        """Return the link that joins two points, and the factors of their distance, m.

        As on paper: a given length is taken as given, another one is read off the drawing.
        """
        heads, tails = self._places(point), self._places(about)
        link = next((k for k in heads if k in tails and k != FRAME), None)
        if link is None:
            raise NoValueError(NoValue.NO_LINK)
        head, tail = heads[link], tails[link]
        if {head, tail} <= set(self.solution.problem.bodies[link].points):
            return link, ((self.draft.length(link, head, tail), 1),)
        drawn = self.drawn(PointName(tail), PointName(head))
        return link, ((drawn, 1), (self.draft.mu_l, 1))

    def point(self, plan: PlanKind, name: str) -> PointName:
        """Return the plan point of a point's name; the pole of the position plan is the origin."""
        motion = self.motion(plan)
        if name == POLE:
            return motion.pole  # the velocity plan's lies at 0 on the paper, as the origin does
        if name not in self.kinematics.velocity.named:
            raise NoValueError(NoValue.NO_POINT)
        link, place = self.kinematics.velocity.named[name]
        return PointName(place) if plan is PlanKind.POSITION else motion.point[link, place]

    def _places(self, name: str) -> dict[str, str]:
        """Return where a name is on each link that has it: link to place of the drawing."""
        motion = self.kinematics.velocity
        return {link: place for link, place in motion.point if motion.label(link, place) == name}

    def relative(self, letter: str, one: str, two: str) -> NumberName:
        """Return a number of the sliding of two coincident points: ``v``, ``ak`` or ``ar``."""
        label = self.kinematics.velocity.label
        for relative in self.kinematics.relatives.values():
            place = relative.point
            if {one, two} == {label(relative.of, place), label(relative.to, place)}:
                size = self.solution.legend[relative.label(letter)].size
                assert size is not None
                return size
        raise NoValueError(NoValue.NO_SLIDING)
