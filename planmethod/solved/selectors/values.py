"""Quantities of a solved problem by the short grammar of ``[published]``: exact, and by hand.

The requested values are steps that continue the program, and they are read like it: exactly at unit
scales, and by the draughtsman, who reads every length with the ruler and continues with the
reading.
"""

from __future__ import annotations

import math
from functools import cached_property

from planmethod.construct.arithmetic import Float64
from planmethod.construct.steps import PointName
from planmethod.plans.legend import PLAN_OF
from planmethod.plans.model import PlanKind
from planmethod.problem.selector import ANALOGUES, FORCES, Selector
from planmethod.solved.analogues import analogues
from planmethod.solved.selectors.forces import ForceValues
from planmethod.solved.selectors.steps import NoValue, NoValueError, SelectorSteps
from planmethod.solved.solution import Solution


def is_angle(selector: Selector) -> bool:
    """Return whether a quantity is measured with a protractor."""
    return selector.kind == "phi" or selector.kind.startswith("angle ")


class SelectorValues:
    """Values of selectors in one position of a solution.

    Parameters
    ----------
    solution : Solution
    position : int
        From 0.
    mu_f : float or None, N/mm
        Scale of the source's force plans; the program's own if the source gives none.
    """

    def __init__(self, solution: Solution, position: int = 0, mu_f: float | None = None) -> None:
        self.solution, self.position, self.mu_f = solution, position, mu_f
        self.kinematics = solution.construction.kinematics

    @cached_property
    def forces(self) -> ForceValues:
        """Quantities of the force analysis.

        Raises
        ------
        NoValueError
            When the file has neither masses nor loads.
        """
        return ForceValues(self.solution, self.position, self.mu_f)

    def exact(self, selector: Selector) -> float:
        """Return the exact value in SI units (degrees, millimetres of a plan).

        Raises
        ------
        NoValueError
            When the solution has no such quantity.
        """
        return self._quotient(selector, by_ruler=False)

    def read(self, selector: Selector) -> float | None:
        """Return the value that follows from the segments read with the ruler.

        None for an angle, which is taken with a protractor and not with the ruler, and for
        analogues, which no plan has.
        """
        for part in filter(None, (selector, selector.over)):
            if is_angle(part) or part.kind in ANALOGUES:
                return None
        return self._quotient(selector, by_ruler=True)

    def _quotient(self, selector: Selector, *, by_ruler: bool) -> float:
        value = self._value(selector, by_ruler=by_ruler)
        if selector.over is None:
            return value
        divisor = self._value(selector.over, by_ruler=by_ruler)
        if divisor == 0:
            raise NoValueError(NoValue.ZERO_DIVISOR)
        return value / divisor

    def _value(self, selector: Selector, *, by_ruler: bool) -> float:
        if selector.kind in FORCES:
            return self.forces.value(selector, by_ruler=by_ruler)
        solution = self.solution
        if selector.kind == "phi":
            if selector.names[0] not in solution.links:
                raise NoValueError(NoValue.NO_LINK)
            return float(solution.links[selector.names[0]].phi_deg[self.position])
        if selector.kind in ANALOGUES:
            return self._analogue(selector.kind[:-1], selector.kind[-1] == "2", *selector.names)
        selecting = SelectorSteps(solution, solution.construction.draft.copy())
        answer = selecting.select(selector)
        reading, hand = solution.si, Float64()
        if by_ruler:
            reading, hand = solution.ruler_reading, solution.ruler_arithmetic
        found = reading.extend(selecting.steps, selecting.draft.numbers, hand)
        value = float(found.number(answer.name)[self.position])
        if answer.plan is not None and not by_ruler:
            value /= solution.plan_scale(answer.plan, self.position).per_mm
        return value if answer.signed else abs(value)

    def _analogue(self, quantity: str, second: bool, name: str) -> float:
        points, links = analogues(self.solution)
        if quantity == "phi":
            if name not in links:
                raise NoValueError(NoValue.NO_LINK)
            return float(links[name][second][self.position])
        if name not in points:
            raise NoValueError(NoValue.NO_POINT)
        rate = points[name].acceleration if second else points[name].velocity
        return float((rate.real if quantity == "x" else rate.imag)[self.position])

    def lever(self, selector: Selector) -> tuple[PlanKind, float] | None:
        """Return the plan on which an angle or a rate is read, and the value of a metre of it.

        An omega or epsilon is a segment over the arm on which it was read; an angle shows best
        at the far end of its link. None for other quantities, and for a rate that is not read off.
        """
        if selector.over is not None or selector.kind in FORCES:
            return None
        kind, name = selector.kind, selector.names[0]
        if kind == "phi":
            reach = self._reach(name)
            return (PlanKind.POSITION, math.degrees(1.0 / reach)) if reach else None
        rates = {"omega": self.kinematics.omega, "epsilon": self.kinematics.epsilon}.get(kind, {})
        for (of, link), turning in self.kinematics.turnings.items():
            # Links of a prismatic pair rotate together: the rate was read on one of them.
            if of is PLAN_OF.get(kind) and name in rates and rates[link] == rates[name]:
                return of, 1.0 / abs(self._place(turning.place) - self._place(turning.joint))
        return None

    def _place(self, point: str) -> complex:
        at = self.solution.si.point(PointName(point))
        return complex(at[self.position])

    def _reach(self, link: str) -> float:
        """Return the greatest distance between the places of a link, m."""
        places = [self._place(place) for place in self.kinematics.velocity.moving.get(link, ())]
        return max((abs(p - q) for p in places for q in places), default=0.0)
