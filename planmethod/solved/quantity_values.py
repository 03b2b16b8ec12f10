"""Values of named quantities of a solved problem: exact, and by hand."""

from __future__ import annotations

import math
from functools import cached_property

from planmethod.construct.arithmetic import Float64
from planmethod.construct.steps import PointName
from planmethod.plans.build import plan_of
from planmethod.plans.forces.board import SCALE
from planmethod.plans.model import PlanKind
from planmethod.problem.quantities import TURNINGS, QuantityKey, QuantityKind, Sign
from planmethod.solved.forces.statics import Statics, statics_of
from planmethod.solved.quantities import analogues
from planmethod.solved.quantity_steps import NoValue, NoValueError, QuantitySteps, combined
from planmethod.solved.reading import Reading
from planmethod.solved.solution import Solution


class QuantityValues:
    """Values of quantities in one position of a solution.

    Parameters
    ----------
    solution : Solution
    position : int
        From 0.
    mu_f : float or None, N/mm
        Scale of the source's force plans; the program's own if the source gives none.
    """

    def __init__(self, solution: Solution, position: int = 0, mu_f: float | None = None) -> None:
        self.solution, self.position, self._mu_f = solution, position, mu_f
        self.kinematics = solution.construction.kinematics

    @cached_property
    def statics(self) -> Statics:
        """The force plans.

        Raises
        ------
        NoValueError
            When the file has neither masses nor loads.
        """
        if self.solution.problem.dynamics is None:
            raise NoValueError(NoValue.NO_FORCES)
        return statics_of(self.solution)

    def exact(self, key: QuantityKey) -> float:
        """Return the exact value: SI, degrees (of a force from 0 to 360), millimetres of a plan.

        Sizes, but for components, rates, ratios and the balancing moment or force.

        Raises
        ------
        NoValueError
            When the solution has no such quantity.
        """
        return self._quotient(key, by_ruler=False)

    def read(self, key: QuantityKey) -> float | None:
        """Return the value computed from the readings of the ruler and the protractor.

        None for analogues, which no plan has.
        """
        if any(part.is_analogue for part in (key, key.over) if part):
            return None
        return self._quotient(key, by_ruler=True)

    def _quotient(self, key: QuantityKey, *, by_ruler: bool) -> float:
        value = self._value(key, by_ruler=by_ruler)
        if key.over is None:
            return value
        divisor = self._value(key.over, by_ruler=by_ruler)
        if divisor == 0:
            raise NoValueError(NoValue.ZERO_DIVISOR)
        return value / divisor

    def _steps(self, key: QuantityKey) -> QuantitySteps:
        statics = self.statics if key.kind.is_force else None
        return QuantitySteps(self.solution, self.position, statics)

    def _value(self, key: QuantityKey, *, by_ruler: bool) -> float:
        solution, kind = self.solution, key.kind
        if key.is_analogue:
            return self._analogue(key)
        steps = self._steps(key)
        number = steps.number(key)
        reading, hand = steps.exact, Float64()
        if by_ruler:
            reading = self._drawn if kind.is_force else solution.ruler_reading
            hand = solution.ruler_arithmetic
        found = reading.extend(steps.steps, steps.draft.numbers, hand)
        value = float(found.number(number)[self.position])
        if kind.is_length_on_paper and not by_ruler:
            value /= solution.plan_scale(plan_of(kind), self.position).per_mm
        if key.is_angle:
            return value % 360.0 if kind.is_force else value
        return value if key.sign in (Sign.TURN, Sign.STRICT) else abs(value)

    @cached_property
    def _drawn(self) -> Reading:
        """Plans read by hand, with the forces at the source's scale."""
        statics, drawn = self.statics, self.statics.ruler_reading
        if self.mu_f != statics.scale.per_mm:  # all plans at that one
            scales = {**statics.per_mm, SCALE: self.mu_f}
            drawn = statics.read(self.solution.ruler_arithmetic, scales)
        return combined(self.solution.ruler_reading, drawn)

    @property
    def mu_f(self) -> float:
        """Scale of the force plans, N/mm."""
        return self.statics.scale.per_mm if self._mu_f is None else self._mu_f

    def _analogue(self, key: QuantityKey) -> float:
        points, links = analogues(self.solution)
        (name,), second = key.names, key.kind.order == 2
        if not key.axis:
            if name not in links:
                raise NoValueError(NoValue.NO_LINK)
            return float(links[name][second][self.position])
        if name not in points:
            raise NoValueError(NoValue.NO_POINT)
        rate = points[name].acceleration if second else points[name].velocity
        return float((rate.real if key.axis == "x" else rate.imag)[self.position])

    def rotation_per_mm(self, key: QuantityKey) -> float | None:
        """Return how far a force turns when its end on the plan moves by one mm, degrees.

        None if the source gives no scale of its plans.
        """
        if self._mu_f is None:
            return None
        return math.degrees(self._mu_f / abs(self._steps(key).force(key)))

    def lever(self, key: QuantityKey) -> tuple[PlanKind, float] | None:
        """Return the plan on which an angle or a rate is read, and the value of a metre of it.

        An omega or epsilon is a segment over the arm on which it was read; an angle shows best
        at the far end of its link. None for other quantities, and for a rate that is not read off.
        """
        if key.over is not None:
            return None
        kind, name = key.kind, key.names[0]
        if kind is QuantityKind.DIRECTION:
            reach = self._reach(name)
            return (PlanKind.POSITION, math.degrees(1.0 / reach)) if reach else None
        if kind not in TURNINGS:
            return None
        plan = plan_of(kind)
        rates = self.kinematics.rates(plan)
        for (of, link), turning in self.kinematics.turnings.items():
            # Links of a prismatic pair rotate together: the rate was read on one of them.
            if of is plan and name in rates and rates[link] == rates[name]:
                return of, 1.0 / abs(self._place(turning.place) - self._place(turning.joint))
        return None

    def _place(self, point: str) -> complex:
        at = self.solution.si.point(PointName(point))
        return complex(at[self.position])

    def _reach(self, link: str) -> float:
        """Return the greatest distance between the places of a link, m."""
        places = [self._place(place) for place in self.kinematics.velocity.moving.get(link, ())]
        return max((abs(p - q) for p in places for q in places), default=0.0)
