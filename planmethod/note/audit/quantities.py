"""Quantities of the motion by the short grammar of ``[published]``: exact, and by hand.

Both are the same formulas over two readings of one program: the exact one at unit scales, and the
draughtsman's, where every length is read with the ruler and carried on along his chain.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import Enum

from planmethod.construct.evaluate import Trace
from planmethod.construct.steps import NumberName, PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.model import PlanKind
from planmethod.plans.motion.board import Motion
from planmethod.plans.motion.leads import Relative
from planmethod.problem.selector import FORCES, POLE, Selector
from planmethod.solved.solution import Solution

PLANS: Mapping[str, PlanKind] = {
    "length": PlanKind.POSITION,
    "segment velocity": PlanKind.VELOCITY,
    "segment acceleration": PlanKind.ACCELERATION,
}
"""Quantities in millimetres of a plan, and of which."""

COMPONENTS: Mapping[str, PlanKind] = {
    "x": PlanKind.POSITION,
    "y": PlanKind.POSITION,
    "vx": PlanKind.VELOCITY,
    "vy": PlanKind.VELOCITY,
    "ax": PlanKind.ACCELERATION,
    "ay": PlanKind.ACCELERATION,
}

MAGNITUDES: Mapping[str, PlanKind] = {
    "v": PlanKind.VELOCITY,
    "vs": PlanKind.VELOCITY,
    "a": PlanKind.ACCELERATION,
}


class Why(Enum):
    """Why a quantity has no value."""

    NO_WHAT = "no what"  # the file does not say which quantity it is
    NO_POSITION = "no position"  # the driver is never there
    NO_SCALE = "no scale"  # millimetres of a plan whose scale the source does not tell
    NO_POINT = "no point"  # a name that the plans do not have
    NO_LINK = "no link"  # turning of a point about one that no link joins it to
    NO_ARM = "no arm"  # a force in the axis of the crank cannot balance it
    NO_SLIDING = "no sliding"  # the points are not a prismatic pair's
    ZERO_DIVISOR = "zero divisor"
    NO_FORCES = "no forces"  # the file has neither masses nor loads
    NO_JOINT = "no joint"  # the links do not touch each other
    NO_DIRECTION = "no direction"  # a force that is nothing has no angle and no arm
    STANDS = "stands"  # the lever of a driving link that does not move


def is_angle(selector: Selector) -> bool:
    """Whether a quantity is taken with a protractor."""
    return selector.kind == "phi" or selector.kind.startswith("angle ")


class UnansweredError(Exception):
    """A selector asks for what the solution does not have."""

    def __init__(self, why: Why) -> None:
        super().__init__(why.value)
        self.why = why


@dataclass(frozen=True, slots=True)
class Reading:
    """A trace in one position, and how a length on it becomes a quantity.

    Attributes
    ----------
    ruled : callable
        What a reader makes of a length on the plan: itself, or rounded to the ruler step.
    per_mm : mapping of PlanKind to float
        Unit of the quantity per unit of the trace.
    """

    solution: Solution
    index: int
    trace: Trace
    ruled: Callable[[float], float]
    per_mm: Mapping[PlanKind, float]

    def point(self, name: PointName) -> complex:
        """Return a point of the construction as the trace has it."""
        return complex(self.solution.complexes(self.trace, name)[self.index])

    def number(self, name: NumberName | None) -> float:
        """Return a number of the construction; one that is zero by nature has no name."""
        return 0.0 if name is None else float(self.solution.reals(self.trace, name)[self.index])

    def measure(self, kind: PlanKind, length: float) -> float:
        """Return the quantity that a length of a plan stands for."""
        return float(self.ruled(length)) * self.per_mm[kind]

    def between(self, kind: PlanKind, tail: PointName, head: PointName) -> float:
        """Return the quantity that a segment of a plan stands for.

        A segment that was laid off has the length it was computed to: nobody reads it again.
        """
        length = abs(self.point(head) - self.point(tail))
        if (tail, head) in self.solution.laid_off:
            return length * self.per_mm[kind]
        return self.measure(kind, length)


class MotionQuantities:
    """Values of selectors of the motion in one position of a solution.

    Parameters
    ----------
    solution : Solution
    position : int
        From 0.
    """

    def __init__(self, solution: Solution, position: int = 0) -> None:
        self.solution = solution
        self.position = position
        self.kin = solution.construction.kinematics

    @property
    def si(self) -> Reading:
        """Exact plans in SI units."""
        unit = dict.fromkeys(PlanKind, 1.0)
        return Reading(self.solution, self.position, self.solution.si, float, unit)

    def exact(self, selector: Selector) -> float:
        """Return the exact value in SI units (degrees, millimetres of a plan).

        Raises
        ------
        UnansweredError
            When the solution has no such quantity.
        """
        return self._quotient(selector, self.si)

    def read(self, selector: Selector) -> float | None:
        """Return the value that follows from the segments read with the ruler.

        None for an angle, which is taken with a protractor and not with the ruler.
        """
        if any(part is not None and is_angle(part) for part in (selector, selector.over)):
            return None
        solution = self.solution
        scales = {kind: scale.per_mm for kind, scale in solution.scales.items()}
        hand = Reading(solution, self.position, solution.by_hand, solution.hand.ruled, scales)
        return self._quotient(selector, hand)

    def lever(self, selector: Selector) -> tuple[PlanKind, float] | None:
        """Return the plan that an angle or a rate is read off, and what a metre of it is worth.

        An omega or epsilon is a segment over the arm on which it was read; an angle shows best
        at the far end of its link. None for other quantities, and for a rate that is not read off.
        """
        if selector.over is not None or selector.kind in FORCES:
            return None
        kind, name = selector.kind, selector.names[0]
        if kind == "phi":
            reach = self._reach(name)
            return (PlanKind.POSITION, math.degrees(1.0 / reach)) if reach else None
        rates = {"omega": self.kin.omega, "epsilon": self.kin.epsilon}.get(kind, {})
        plan = PlanKind.VELOCITY if kind == "omega" else PlanKind.ACCELERATION
        for (of, link), turning in self.kin.turnings.items():
            # Links of a prismatic pair turn alike: the rate was read on one of them.
            if of is plan and name in rates and rates[link] == rates[name]:
                return plan, 1.0 / abs(self._place(turning.place) - self._place(turning.joint))
        return None

    def _place(self, point: str) -> complex:
        at = self.solution.complexes(self.solution.si, PointName(point))
        return complex(at[self.position])

    def _reach(self, link: str) -> float:
        """Return the greatest distance between the places of a link, m."""
        places = [self._place(place) for place in self.kin.velocity.moving.get(link, ())]
        return max((abs(p - q) for p in places for q in places), default=0.0)

    # One reading -----------------------------------------------------------------------------

    def _quotient(self, selector: Selector, reading: Reading) -> float:
        value = self._value(selector, reading)
        if selector.over is None:
            return value
        divisor = self._value(selector.over, reading)
        if divisor == 0:
            raise UnansweredError(Why.ZERO_DIVISOR)
        return value / divisor

    def _value(self, selector: Selector, reading: Reading) -> float:
        kind, names = selector.kind, selector.names
        if kind in COMPONENTS:
            plan = COMPONENTS[kind]
            head, pole = (self.plan_point(plan, name) for name in (names[0], POLE))
            at = reading.point(head) - reading.point(pole)
            return reading.measure(plan, at.real if kind.endswith("x") else at.imag)
        if kind in MAGNITUDES:
            plan = MAGNITUDES[kind]
            about = names[1] if len(names) > 1 else POLE
            tail, head = (self.plan_point(plan, name) for name in (about, names[0]))
            return reading.between(plan, tail, head)
        if kind in PLANS:
            plan = PLANS[kind]
            tail, head = (self.plan_point(plan, name) for name in names)
            return reading.between(plan, tail, head) / self.solution.scales[plan].per_mm
        if kind in ("an", "at"):
            link, arm = self.arm(reading, *names)
            if kind == "an":
                return float(reading.number(self.kin.omega.get(link)) ** 2 * arm)
            return abs(reading.number(self.kin.epsilon.get(link))) * arm
        if kind in ("ak", "ar"):
            relative = self._relative(*names)
            ends = (relative.a_start, relative.a_turned, relative.a_head)
            tail_, head_ = ends[:2] if kind == "ak" else ends[1:]
            assert tail_ is not None and head_ is not None
            return reading.between(PlanKind.ACCELERATION, tail_, head_)
        (link,) = names
        if link not in self.solution.links:
            raise UnansweredError(Why.NO_LINK)
        if kind == "phi":
            return float(self.solution.links[link].phi_deg[self.position])
        rates = self.kin.omega if kind == "omega" else self.kin.epsilon
        return reading.number(rates.get(link))

    # Names -----------------------------------------------------------------------------------

    def _motion(self, plan: PlanKind) -> Motion:
        return self.kin.velocity if plan is PlanKind.VELOCITY else self.kin.acceleration

    def plan_point(self, plan: PlanKind, name: str) -> PointName:
        """Return the plan point of a point's name; the pole of the position plan is the origin."""
        motion = self._motion(plan)
        if name == POLE and plan is not PlanKind.POSITION:
            return motion.pole
        if name == POLE:
            return self.kin.velocity.pole  # lies at 0 on the paper, as the origin does
        if name not in self.kin.velocity.named:
            raise UnansweredError(Why.NO_POINT)
        link, place = self.kin.velocity.named[name]
        return PointName(place) if plan is PlanKind.POSITION else motion.point[link, place]

    def _places(self, name: str) -> dict[str, str]:
        """Return where a name is on each link that has it: link to place of the drawing."""
        motion = self.kin.velocity
        return {link: place for link, place in motion.point if motion.label(link, place) == name}

    def arm(self, reading: Reading, point: str, about: str) -> tuple[str, float]:
        """Return the link that joins two points, and their distance, m.

        As on paper: a given length is taken as given, another one is read off the drawing.
        """
        heads, tails = self._places(point), self._places(about)
        link = next((k for k in heads if k in tails and k != FRAME), None)
        if link is None:
            raise UnansweredError(Why.NO_LINK)
        head, tail = heads[link], tails[link]
        body = self.solution.problem.bodies[link].points
        if head in body and tail in body:
            return link, abs(body[head] - body[tail])
        return link, reading.between(PlanKind.POSITION, PointName(tail), PointName(head))

    def _relative(self, one: str, other: str) -> Relative:
        label = self.kin.velocity.label
        for relative in self.kin.relatives.values():
            place = relative.point
            if {one, other} == {label(relative.of, place), label(relative.to, place)}:
                return relative
        raise UnansweredError(Why.NO_SLIDING)
