"""Force plans of one position, read at the scales of their drawings (планы сил в масштабе)."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cached_property

from msgspec.structs import replace

from planmethod.construct.scale import Scale
from planmethod.construct.steps import NumberName, PointName
from planmethod.errors import Fault, ProblemError
from planmethod.plans.forces.board import Force, GivenLoad
from planmethod.plans.forces.polygons import (
    Component,
    CoupleOn,
    Edge,
    ForcePlan,
)
from planmethod.plans.segments import Ends
from planmethod.problem.model import BalancingQuantity, Problem
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.reading import Memoizing, Reading, memoized
from planmethod.solved.solution import Solution

NEGLIGIBLE_FRACTION = 1e-7
"""Share of the largest force of a position below which a force is none."""


class ForceReading(Memoizing):
    """The forces of a solution in one position, as drawn and as read by hand.

    Parameters
    ----------
    solution : Solution
    index : int
        Which position.

    Raises
    ------
    ProblemError
        The problem file gives neither masses nor loads.
    """

    def __init__(self, solution: Solution, index: int) -> None:
        super().__init__()
        require_dynamics(solution.problem)
        self.solution, self.index = solution, index
        self.statics = statics_of(solution)
        self.plans: tuple[ForcePlan, ...] = tuple(self.statics.board.plans)

    @property
    def scale(self) -> Scale:
        """Scale of the force plans that have none of their own, N per mm."""
        return self.statics.scale

    def enlargement(self, number: int) -> float:
        """Return the enlargement of one of the plans relative to `scale`."""
        return float(self.statics.enlargements[number][self.index])

    def plan_scale(self, number: int) -> Scale:
        """Return the scale of one of the plans, N per mm."""
        return self.statics.plan_scale(number, self.index)

    def corner(self, number: int, point: PointName) -> complex:
        """Return a point of one of the plans as drawn by hand, mm; else the exact one."""
        drawn = self._column(self.statics.ruler_reading, point)
        return (drawn if math.isfinite(abs(drawn)) else self.end(point)) * self.enlargement(number)

    def drawn(self, number: int, edge: Edge) -> complex:
        """Return a force as its segment on one of the plans, mm."""
        return self.corner(number, edge.head) - self.corner(number, edge.tail)

    def _column(self, reading: Reading, name: PointName) -> complex:
        return complex(reading.point(name)[self.index])

    # Places, forces, couples -----------------------------------------------------------------

    def place(self, point: PointName) -> complex:
        """Return a place of the position plan, mm; those of shifted forces are among them."""
        return self._column(self._of_plan(point) or self.statics.paper, point)

    def _of_plan(self, point: PointName) -> Reading | None:
        """Return the position plan if it has a point."""
        return self.solution.paper if point in self.solution.paper.value else None

    def end(self, point: PointName) -> complex:
        """Return an end of a force plan, or a point of the lever, mm."""
        return self._column(self.statics.paper, point)

    def force(self, edge: Edge) -> complex:
        """Return a force, N."""
        return self.of_force(Force(edge.at, edge.tail, edge.head))

    def drawn_direction(self, force: Edge | Force) -> complex:
        """Return a force along its line as drawn by hand, mm; else along the exact one.

        A shifted force of inertia is drawn across its exact shift.
        """
        drawn = self.drawn_segment(*force.ends)
        shifted = any(shift.at == force.at for shift in self.statics.board.shifts.values())
        if drawn and math.isfinite(abs(drawn)) and not shifted:
            return drawn
        return self.of_force(Force(force.at, *force.ends))

    def of_force(self, force: Force) -> complex:
        """Return a force of the board, N."""
        si = self.statics.si
        return self._column(si, force.head) - self._column(si, force.tail)

    def drawn_segment(self, tail: PointName, head: PointName) -> complex:
        """Return a segment of a force plan, or of the lever, as drawn by hand, mm."""
        hand = self.statics.ruler_reading
        return self._column(hand, head) - self._column(hand, tail)

    def length(self, edge: Edge, number: int) -> float:
        """Return the length of a force on one of the plans, mm: laid off, or read."""
        length = abs(self.read_number(self.statics.board.segments.drawn(edge.ends)))
        return length * self.enlargement(number)

    def read(self, edge: Edge) -> float:
        """Return the size of a force as read by hand, N."""
        return self.read_size(edge.ends)

    def read_size(self, ends: Ends) -> float:
        """Return the size of the force that a segment shows, as read by hand, N."""
        return abs(self.read_number(self.statics.board.segments.known(ends)))

    def number(self, name: NumberName) -> float:
        """Return a moment, N·m, or another computed number."""
        return float(self.statics.si.number(name)[self.index])

    def read_number(self, name: NumberName) -> float:
        """Return a moment as computed by hand, N·m."""
        return float(self.statics.ruler_reading.number(name)[self.index])

    def read_product(self, powers: Iterable[tuple[NumberName, int]]) -> float:
        """Return a product of powers as computed by hand."""
        return math.prod(self.read_number(name) ** power for name, power in powers)

    def read_load(self, load: GivenLoad) -> float:
        """Return a given force as read by hand, N, or a couple as computed by hand, N·m."""
        if load.force is not None:
            return self.read_size(load.force.ends)
        assert load.couple is not None
        return self.read_number(load.couple)

    def arm(self, edge: Edge, about: PointName) -> float:
        """Return the arm of a force about a point as measured by hand, mm.

        Positive where the force turns counter-clockwise; 0 of a force through the point.
        """
        board = self.statics.board
        arm = board.arms.get((about, edge.at, board.segments.known(edge.ends)))
        return 0.0 if arm is None else self.read_number(arm)

    def turns(self, edge: Edge, about: PointName) -> bool:
        """Return whether a force turns its link counter-clockwise about a point."""
        lever = self.place(edge.at) - self.place(about)
        return (lever.conjugate() * self.drawn_segment(*edge.ends)).imag > 0

    @property
    def balancing(self) -> BalancingQuantity:
        """Balancing force or moment of the driving link."""
        return self.solution.problem.drive.balancing

    @property
    def balancing_symbol(self) -> str:
        """Letter of the driving link's balancing force or moment."""
        return self.balancing.symbol

    # Visible parts ---------------------------------------------------------------------------

    @cached_property
    def peak(self) -> float:
        """The largest force of the position, N."""
        edges = [edge for plan in self.plans for edge in (*plan.polygon, *plan.wholes)]
        return max((abs(self.force(edge)) for edge in edges), default=0.0)

    @cached_property
    def peak_moment(self) -> float:
        """The largest moment that counts beside the forces, N·m."""
        moments = [abs(self.number(one.moment)) for plan in self.plans for one in plan.couples]
        lengths = [length for _, _, length in self.solution.problem.lengths]
        return max([*moments, self.peak * max(lengths, default=0.0)])

    def is_negligible(self, edge: Edge) -> bool:
        """Return whether a force is negligible beside the others."""
        return abs(self.force(edge)) <= NEGLIGIBLE_FRACTION * self.peak

    def is_no_couple(self, couple: CoupleOn) -> bool:
        """Return whether a couple is negligible beside the others."""
        return abs(self.number(couple.moment)) <= NEGLIGIBLE_FRACTION * self.peak_moment

    def shown(self, plan: ForcePlan) -> list[Edge]:
        """Return the sides of a plan that are not negligible.

        If one component of a reaction is negligible, the other is shown as the whole reaction.
        """
        sides = [edge for edge in plan.polygon if not self.is_negligible(edge)]
        parts = [(edge.on, edge.at) for edge in sides if edge.component is not Component.TOTAL]
        return [
            replace(edge, component=Component.TOTAL)
            if parts.count((edge.on, edge.at)) == 1
            else edge
            for edge in sides
        ]

    def wholes(self, plan: ForcePlan) -> list[Edge]:
        """Return the reactions that are something and have two components."""
        parts = [(e.on, e.at) for e in self.shown(plan) if e.component is not Component.TOTAL]
        return [edge for edge in plan.wholes if (edge.on, edge.at) in parts]

    def inner(self, plan: ForcePlan) -> list[Edge]:
        """Return the reactions in the inner joints that are something."""
        return [edge for edge in plan.inner if not self.is_negligible(edge)]

    def couples(self, plan: ForcePlan) -> list[CoupleOn]:
        """Return the couples that are something."""
        return [couple for couple in plan.couples if not self.is_no_couple(couple)]


def require_dynamics(problem: Problem) -> None:
    """Reject a problem without masses and loads.

    Raises
    ------
    ProblemError
    """
    if problem.dynamics is None:
        hint = "Give the masses in [dynamics] and the loads in [[loads]]."
        fault = Fault("dynamics", "missing, so forces cannot be analysed", hint)
        raise ProblemError(problem.name, [fault])


@memoized
def force_reading(solution: Solution, index: int) -> ForceReading:
    """Return the forces of a position; cached, since several views of a sheet show them."""
    return ForceReading(solution, index)
