"""Choice of the plans' scales: each plan fills its view, the same scale for all positions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from planmethod.construct.scale import Scale, choose_scale
from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Convention, Problem

if TYPE_CHECKING:
    from planmethod.plans.solution import Solution

Box = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Views:
    """Boxes that the drawn mechanism and the plans shall fill, mm (поля видов).

    They go with a paper format: the sheet's layout keeps room for exactly these boxes, and the
    numbers of `solve` and the drawing of `sheet` therefore have the same scales.
    """

    paper: str
    position: Box
    velocity: Box
    acceleration: Box

    @classmethod
    def for_paper(cls, paper: str, positions: int) -> Views:
        """Return the boxes of a format for one position or for many."""
        table = ONE_POSITION if positions == 1 else MANY_POSITIONS
        return cls(paper, *table[paper])

    @classmethod
    def for_problem(cls, problem: Problem, positions: int) -> Views:
        """Return the boxes of the smallest format that suits a mechanism."""
        if positions > 1:
            return cls.for_paper("A1", positions)
        return cls.for_paper("A3" if len(problem.mechanism.links) <= 3 else "A2", 1)


ONE_POSITION: dict[str, tuple[Box, Box, Box]] = {
    "A4": ((90.0, 60.0), (70.0, 60.0), (80.0, 70.0)),
    "A3": ((150.0, 90.0), (120.0, 95.0), (125.0, 115.0)),
    "A2": ((235.0, 150.0), (190.0, 160.0), (200.0, 195.0)),
    "A1": ((320.0, 220.0), (260.0, 230.0), (290.0, 300.0)),
    "A0": ((380.0, 300.0), (360.0, 320.0), (400.0, 420.0)),
}
MANY_POSITIONS: dict[str, tuple[Box, Box, Box]] = {
    "A3": ((100.0, 80.0), (40.0, 40.0), (40.0, 40.0)),
    "A2": ((150.0, 120.0), (60.0, 55.0), (60.0, 60.0)),
    "A1": ((300.0, 190.0), (80.0, 75.0), (85.0, 85.0)),
    "A0": ((320.0, 260.0), (120.0, 110.0), (125.0, 125.0)),
}


def _extent(
    columns: list[np.ndarray[tuple[int], np.dtype[np.complex128]]], *, overlay: bool
) -> Box:
    """Return width and height of points: of all positions laid over each other, or the largest."""
    points = np.stack(columns)
    axis = None if overlay else 0
    width = np.ptp(points.real, axis=axis)
    height = np.ptp(points.imag, axis=axis)
    return float(np.max(width)), float(np.max(height))


def extent(solution: Solution, kind: PlanKind) -> Box:
    """Return the size of a plan in its own unit (m, m/s, m/s²)."""
    draft = solution.construction.draft
    if kind is PlanKind.POSITION:
        names = [PointName(point) for point in draft.points()]
        names += [
            PointName(f"{slide.label}:0")
            for slide in solution.problem.slides.values()
            if slide.host == FRAME and slide.through is None
        ]
        columns = [solution.complexes(solution.si, name) for name in names]
        return _extent(columns, overlay=True)
    plan = solution.construction.plan(kind)
    ends = {end for vector in plan.vectors for end in (vector.tail, vector.head)}
    if not ends:
        return 0.0, 0.0
    return _extent([solution.complexes(solution.si, end) for end in sorted(ends)], overlay=False)


def choose_scales(solution: Solution) -> dict[PlanKind, Scale]:
    """Return the scale of each plan: as the file gives it, else to fill its view."""
    asked, views = solution.problem.scales, solution.views
    other_way = asked.convention is Convention.MM_PER_UNIT
    result: dict[PlanKind, Scale] = {}
    for kind, given, box, symbol, unit in (
        (PlanKind.POSITION, asked.mu_l, views.position, "mu_l", "m"),
        (PlanKind.VELOCITY, asked.mu_v, views.velocity, "mu_v", "m/s"),
        (PlanKind.ACCELERATION, asked.mu_a, views.acceleration, "mu_a", "m/s²"),
    ):
        per_mm = given
        if per_mm is None:
            per_mm = choose_scale(extent(solution, kind), box, mm_per_unit=other_way)
        result[kind] = Scale(symbol, per_mm, unit)
    return result
