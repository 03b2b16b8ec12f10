"""Choice of the plans' scales: each plan fills its view, the same scale for all positions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from planmethod.construct.scale import Scale, choose_scale
from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.paper import FORMATS
from planmethod.plans.build import Construction
from planmethod.plans.model import FACTS, MOTION, PlanKind
from planmethod.problem.model import Convention, Problem, Scales
from planmethod.solved.reading import Reading, Reals

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

    def box(self, kind: PlanKind) -> Box:
        """Return the box of a plan, mm."""
        box: Box = getattr(self, kind.value)
        return box

    @classmethod
    def for_paper(cls, paper: str, positions: int) -> Views:
        """Return the boxes of a format for one position or for many.

        An elongated format has the boxes of the basic one that is as high as it lies.
        """
        table = ONE_POSITION if positions == 1 else MANY_POSITIONS
        return cls(paper, *table[AS_HIGH.get(paper, paper)])

    @classmethod
    def for_problem(cls, problem: Problem, positions: int) -> Views:
        """Return the boxes of the file's format, or of that which a sheet is tried on first.

        With the scales of the file a three-link mechanism may do with A3; chosen scales take A2, so
        that plans are large enough to measure and their formulas stand beside them.
        """
        if problem.sheet.paper:
            return cls.for_paper(problem.sheet.paper, positions)
        if positions > 1:
            return cls.for_paper("A1", positions)
        scales = problem.scales
        given = None not in (scales.mu_l, scales.mu_v, scales.mu_a)
        small = given and len(problem.mechanism.links) <= 3
        return cls.for_paper("A3" if small else "A2", 1)


AS_HIGH = {fmt.name: fmt.like for fmt in FORMATS.values() if fmt.like != fmt.name}
"""Basic format whose boxes an elongated or a standing one has."""

ONE_POSITION: dict[str, tuple[Box, Box, Box]] = {
    "A4": ((80.0, 50.0), (60.0, 50.0), (60.0, 55.0)),
    "A3": ((150.0, 90.0), (120.0, 95.0), (125.0, 115.0)),
    "A2": ((235.0, 150.0), (190.0, 160.0), (200.0, 195.0)),
    "A1": ((320.0, 220.0), (260.0, 230.0), (290.0, 300.0)),
    "A0": ((380.0, 300.0), (360.0, 320.0), (400.0, 420.0)),
}
MANY_POSITIONS: dict[str, tuple[Box, Box, Box]] = {
    "A4": ((80.0, 50.0), (50.0, 45.0), (50.0, 45.0)),
    "A3": ((100.0, 80.0), (40.0, 40.0), (40.0, 40.0)),
    "A2": ((150.0, 120.0), (60.0, 55.0), (60.0, 60.0)),
    "A1": ((300.0, 190.0), (80.0, 75.0), (85.0, 85.0)),
    "A0": ((320.0, 260.0), (120.0, 110.0), (125.0, 125.0)),
}


OUTLIER = 5.0
"""A plan that many times larger than the middle one does not set the scale of all: it stands near a
dead position and is drawn at a scale of its own."""


def _spread(si: Reading, names: list[PointName]) -> tuple[Reals, Reals]:
    """Return the width and height of points in every position, in their unit, shape (n,)."""
    points = np.stack([si.point(name) for name in names])
    return np.ptp(points.real, axis=0), np.ptp(points.imag, axis=0)


def _plan_ends(construction: Construction, kind: PlanKind) -> list[PointName]:
    plan = construction.plan(kind)
    return sorted({end for vector in plan.vectors for end in (vector.tail, vector.head)})


def plan_extent(construction: Construction, si: Reading, kind: PlanKind, index: int) -> Box:
    """Return the size of a velocity or acceleration plan in one position, in its own unit."""
    ends = _plan_ends(construction, kind)
    if not ends:
        return 0.0, 0.0
    width, height = _spread(si, ends)
    return float(width[index]), float(height[index])


def extent(construction: Construction, si: Reading, kind: PlanKind) -> Box:
    """Return the size that sets a plan's scale, in its own unit (m, m/s, m/s²).

    The mechanism in all positions laid over each other; the largest of the velocity or
    acceleration plans that are not outliers.
    """
    if kind is PlanKind.POSITION:
        draft = construction.draft
        names = [PointName(point) for point in draft.points()]
        names += [
            PointName(f"{slide.label}:0")
            for slide in draft.problem.slides.values()
            if slide.host == FRAME and slide.through is None
        ]
        points = np.stack([si.point(name) for name in sorted(names)])
        return float(np.ptp(points.real)), float(np.ptp(points.imag))
    ends = _plan_ends(construction, kind)
    if not ends:
        return 0.0, 0.0
    width, height = _spread(si, ends)
    size = np.maximum(width, height)
    usual = size <= OUTLIER * np.median(size)
    return float(np.max(width[usual])), float(np.max(height[usual]))


def choose_scales(construction: Construction, si: Reading, views: Views) -> dict[PlanKind, Scale]:
    """Return the scale of each plan: as the file gives it, else to fill its view.

    Parameters
    ----------
    si : Reading
        Exact, at unit scales.
    """
    asked = construction.draft.problem.scales
    result: dict[PlanKind, Scale] = {}
    for kind in MOTION:
        symbol = FACTS[kind].scale
        per_mm = getattr(asked, symbol)
        if per_mm is None:
            per_mm = _fitting(asked, views.box(kind), extent(construction, si, kind))
        result[kind] = Scale(symbol, per_mm, FACTS[kind].unit)
    return result


def _fitting(asked: Scales, box: Box, size: Box) -> float:
    return choose_scale(size, box, mm_per_unit=asked.convention is Convention.MM_PER_UNIT)


def own_scale(
    construction: Construction, si: Reading, views: Views, common: Scale, kind: PlanKind, index: int
) -> Scale:
    """Return the scale at which a plan is drawn in one position.

    It is the common one, but for a plan that would leave its view by far (near a dead position).
    """
    size, box = plan_extent(construction, si, kind, index), views.box(kind)
    over = max(size[0] / box[0], size[1] / box[1]) / common.per_mm
    asked = construction.draft.problem.scales
    given = getattr(asked, common.symbol)
    if over <= OUTLIER / 2 or (given is not None and si.count == 1):
        return common
    return Scale(common.symbol, _fitting(asked, box, size), common.unit)
