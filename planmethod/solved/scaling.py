"""Choice of the plans' scales: each plan fills its view, the same scale for all positions."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

import numpy as np

from planmethod.construct.scale import Scale, choose_scale, series_near
from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.paper import FORMATS
from planmethod.plans.build import Construction
from planmethod.plans.model import FACTS, MOTION, PlanKind
from planmethod.problem.model import Convention, Problem, Scales
from planmethod.record import dataclass
from planmethod.solved.reading import Reading, Reals

Box = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Views:
    """Room that the drawn mechanism and the plans shall fill, mm (поля видов).

    It goes with a paper format: the sheet's layout keeps just this room, and the numbers of `solve`
    and the drawing of `sheet` therefore have the same scales.

    Attributes
    ----------
    paper : str
    position, velocity, acceleration : Box, mm
        Of many positions the room of all plans of a kind on a sheet, in rows.
    many : bool
        There are several positions.
    kept : frozenset of PlanKind
        Kinds whose box is that of each single plan and is kept to exactly: a composition gave it.
    """

    paper: str
    position: Box
    velocity: Box
    acceleration: Box
    many: bool = False
    kept: frozenset[PlanKind] = frozenset()

    def box(self, kind: PlanKind) -> Box:
        """Return the room of a kind, mm."""
        box: Box = getattr(self, kind.value)
        return box

    def in_rows(self, kind: PlanKind) -> bool:
        """Tell whether the room of a kind is that of many plans."""
        return self.many and kind is not PlanKind.POSITION and kind not in self.kept

    def plan_box(self, kind: PlanKind, count: int) -> Box:
        """Return what one plan of so many positions has for itself, mm."""
        width, height = self.box(kind)
        if not self.in_rows(kind):
            return width, height
        rows = min(-(-count // per_row(count)), ROWS)
        return width / min(count, per_row(count)) - BESIDE, height / rows - UNDER

    @classmethod
    def alone(cls, box: Box) -> Views:
        """Return the room of a scheme that is drawn without a sheet around it."""
        return cls("", box, box, box, kept=frozenset(MOTION))

    @classmethod
    def for_paper(cls, paper: str, positions: int) -> Views:
        """Return the room on a format for one position, for a few or for many.

        An elongated format has that of the basic one that is as high as it lies.
        """
        one = positions == 1
        table = ONE_POSITION if one else FEW_POSITIONS if positions <= FEW else MANY_POSITIONS
        return cls(paper, *table[AS_HIGH.get(paper, paper)], many=not one)

    @classmethod
    def for_problem(cls, problem: Problem, positions: int) -> Views:
        """Return the room on the file's format, or on that which a sheet is tried on first.

        Three-link mechanisms take a format less than others, so that plans are large enough to
        measure and their formulas stand beside them.
        """
        small = len(problem.mechanism.links) <= 3
        paper = ("A3" if small else "A2") if positions == 1 else ("A2" if small else "A1")
        if positions > FEW:
            paper = "A1"
        return cls.for_paper(problem.sheet.paper or paper, positions)


AS_HIGH = {fmt.name: fmt.like for fmt in FORMATS.values() if fmt.like != fmt.name}
"""Basic format whose room an elongated or a standing one has."""

FEW = 5
"""Most positions of a homework: each with plans of useful size, all of a kind in one row."""

ONE_POSITION: dict[str, tuple[Box, Box, Box]] = {
    "A4": ((80.0, 50.0), (60.0, 50.0), (60.0, 55.0)),
    "A3": ((150.0, 90.0), (120.0, 95.0), (125.0, 115.0)),
    "A2": ((235.0, 150.0), (190.0, 160.0), (200.0, 195.0)),
    "A1": ((320.0, 220.0), (260.0, 230.0), (290.0, 300.0)),
    "A0": ((380.0, 300.0), (360.0, 320.0), (400.0, 420.0)),
}
FEW_POSITIONS: dict[str, tuple[Box, Box, Box]] = {
    "A4": ((80.0, 50.0), (160.0, 50.0), (160.0, 50.0)),
    "A3": ((110.0, 90.0), (230.0, 70.0), (230.0, 75.0)),
    "A2": ((190.0, 130.0), (330.0, 110.0), (330.0, 115.0)),
    "A1": ((290.0, 230.0), (500.0, 165.0), (500.0, 175.0)),
    "A0": ((320.0, 260.0), (720.0, 240.0), (720.0, 250.0)),
}
MANY_POSITIONS: dict[str, tuple[Box, Box, Box]] = {
    "A4": ((80.0, 50.0), (160.0, 60.0), (160.0, 60.0)),
    "A3": ((100.0, 80.0), (240.0, 90.0), (240.0, 90.0)),
    "A2": ((150.0, 120.0), (340.0, 110.0), (340.0, 110.0)),
    "A1": ((310.0, 250.0), (490.0, 165.0), (490.0, 175.0)),
    "A0": ((320.0, 260.0), (730.0, 240.0), (730.0, 250.0)),
}

STRETCH = 1.35
"""So many times wider or higher than its box a single view may be, if it takes no more paper."""

COARSER = 2.5
"""So many times smaller than its own room a view may be, so that all views have room together."""

ROWS = 2
"""Rows of plans of one kind on a sheet."""

BESIDE, UNDER = 20.0, 22.0
"""Room that the letters of a plan take beside it, and with its caption under it, mm."""

LETTERS = {"A4": 2.5, "A3": 3.5, "A2": 3.5, "A1": 5.0, "A0": 5.0}
"""Height of the texts on a format, mm."""

EQUATION, LINES, STATEMENT = 1300.0, 1050.0, 42000.0
"""Paper that a vector equation, the calculation of a vector, and statement, table and title block
take with letters of 3.5 mm, mm²."""

FILLED = 0.46
"""Part of the paper beside the texts that views take with their letters."""

FAR = 1.4
"""A plan that would be so many times larger than its share of the room has a scale of its own."""

NEAR, SMALL = 0.4, 0.7
"""A plan that takes less than that part of its share is drawn at a finer scale of its own, so that
it takes so much of it at most."""

FEW_FAR = 0.2
"""Part of the plans of a kind that may have scales of their own."""

OUTLIER = 5.0
"""A plan that many times larger than the middle one does not set the scale of all: it stands near a
dead position and is drawn at a scale of its own."""


def per_row(count: int) -> int:
    """Return how many of so many plans stand in a row."""
    return count if count <= FEW else 6


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


def sizes(construction: Construction, si: Reading, kind: PlanKind) -> tuple[Reals, Reals]:
    """Return width and height of what is drawn in every position, in its unit, shape (n,).

    Of the mechanism it is that of all positions laid over each other.
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
        return np.array([np.ptp(points.real)]), np.array([np.ptp(points.imag)])
    ends = _plan_ends(construction, kind)
    return _spread(si, ends) if ends else (np.zeros(si.count), np.zeros(si.count))


def extent(construction: Construction, si: Reading, kind: PlanKind) -> Box:
    """Return the size of what is drawn, in its own unit: of plans the largest, without outliers."""
    width, height = sizes(construction, si, kind)
    size = np.maximum(width, height)
    usual = size <= OUTLIER * _median(size)
    return float(np.max(width[usual])), float(np.max(height[usual]))


def _median(sizes: Reals) -> float:
    """Return the median of (N,) sizes; numpy's own would import its masked arrays."""
    ordered = np.sort(sizes)
    return float(ordered[(len(ordered) - 1) // 2] + ordered[len(ordered) // 2]) / 2


def choose_scales(construction: Construction, si: Reading, views: Views) -> dict[PlanKind, Scale]:
    """Return the scale of each plan: as the file gives it, else to fill the room of the views.

    First each view fills its own room; then the scales become finer as long as all views together
    have the room of all. What one does not need another takes.

    Parameters
    ----------
    si : Reading
        Exact, at unit scales.
    """
    asked = construction.draft.problem.scales
    given = {kind: getattr(asked, FACTS[kind].scale) for kind in MOTION}
    drawn = {kind: _Drawn(construction, si, views, kind) for kind in MOTION}
    chosen = {kind: given[kind] or drawn[kind].alone() for kind in MOTION}
    free = [k for k in MOTION if given[k] is None and k not in views.kept and any(drawn[k].size)]
    rooms = {rows: _room(drawn, rows=rows) for rows in (False, True)}

    def over(rows: bool) -> bool:
        taken = sum(drawn[k].taken(chosen[k]) for k in MOTION if drawn[k].rows == rows)
        return taken > rooms[rows]

    for rows in (False, True):
        some = [kind for kind in free if drawn[kind].rows == rows]
        least = {kind: COARSER * chosen[kind] for kind in some}
        while over(rows):
            bears = [k for k in some if _next(chosen[k], asked, finer=False) <= least[k]]
            if not bears:
                break
            large = max(bears, key=lambda kind: drawn[kind].share(chosen[kind]))
            chosen[large] = _next(chosen[large], asked, finer=False)
        while some:
            small = min(some, key=lambda kind: drawn[kind].share(chosen[kind]))
            before, chosen[small] = chosen[small], _next(chosen[small], asked, finer=True)
            if over(rows) or not drawn[small].stretches(chosen[small]):
                chosen[small] = before
                some.remove(small)
    return {kind: Scale(FACTS[kind].scale, chosen[kind], FACTS[kind].unit) for kind in MOTION}


def _room(drawn: Mapping[PlanKind, _Drawn], *, rows: bool) -> float:
    """Return the room of all views: the height of rows of plans, mm, else an area, mm².

    On a sheet of one position it is what the texts leave: vector equations and the calculation,
    whose lines are nearly as many as the vectors twice.
    """
    one = drawn[PlanKind.POSITION]
    if rows or one.views.many or one.views.kept:
        return sum(each.room() for each in drawn.values() if each.rows == rows)
    paper = FORMATS[one.views.paper]
    left, low, right, high = paper.inner
    letters = (LETTERS[AS_HIGH.get(paper.name, paper.name)] / 3.5) ** 2
    plans = [one.construction.plan(kind) for kind in MOTION if kind is not PlanKind.POSITION]
    equations = sum(len(plan.equations) for plan in plans)
    vectors = sum(len(plan.vectors) for plan in plans)
    texts = letters * (equations * EQUATION + STATEMENT) + min(letters, 1.0) * vectors * LINES
    return FILLED * ((right - left) * (high - low) - texts)


@dataclass(frozen=True)
class _Drawn:
    """What is drawn of a kind, in SI, and the room that it has."""

    construction: Construction
    si: Reading
    views: Views
    kind: PlanKind

    @cached_property
    def sizes(self) -> tuple[Reals, Reals]:
        """Width and height in every position, shape (n,)."""
        return sizes(self.construction, self.si, self.kind)

    @cached_property
    def size(self) -> Box:
        """Width and height of the largest that is not an outlier."""
        return extent(self.construction, self.si, self.kind)

    @property
    def box(self) -> Box:
        """Room of the kind, mm."""
        return self.views.box(self.kind)

    @property
    def rows(self) -> bool:
        """Whether it is many plans in rows."""
        return self.views.in_rows(self.kind)

    def alone(self) -> float:
        """Return the finest scale of the series at which it has the room of its own."""
        asked = self.construction.draft.problem.scales
        per_mm = _fitting(asked, self.box, self.size)
        while self.rows and not (self.stretches(per_mm) and self.taken(per_mm) <= self.room()):
            per_mm = _next(per_mm, asked, finer=False)
        return per_mm

    def share(self, per_mm: float) -> float:
        """Return how much of its room it takes at a scale."""
        return self.taken(per_mm) / self.room()

    def room(self) -> float:
        """Return the room that it has: the height of plans in rows, mm, else the area, mm²."""
        width, height = self.box
        return height if self.rows else (width + BESIDE) * (height + UNDER)

    def taken(self, per_mm: float) -> float:
        """Return what it takes of the room at a scale."""
        if not self.rows:
            return (self.size[0] / per_mm + BESIDE) * (self.size[1] / per_mm + UNDER)
        _, high = self._on_paper(per_mm)
        step = per_row(self.si.count)
        lines = [float(high[k : k + step].max()) for k in range(0, self.si.count, step)]
        return max(sum(lines[k : k + ROWS]) for k in range(0, len(lines), ROWS))

    def stretches(self, per_mm: float) -> bool:
        """Tell whether it is not too wide, nor a single view too high, at a scale."""
        if not self.rows:
            times = max(self.size[0] / self.box[0], self.size[1] / self.box[1]) / per_mm
            return times <= STRETCH
        wide, _ = self._on_paper(per_mm)
        step = per_row(self.si.count)
        return all(wide[k : k + step].sum() <= self.box[0] for k in range(0, self.si.count, step))

    def _on_paper(self, per_mm: float) -> tuple[Reals, Reals]:
        """Return the width and height of every plan with its letters, mm, shape (n,)."""
        own, count = self.views.plan_box(self.kind, self.si.count), self.si.count
        width, height = self.sizes
        over = np.maximum(width / own[0], height / own[1]) / per_mm
        far = over > _far(count)
        if far.mean() > FEW_FAR:
            return np.full(count, np.inf), np.full(count, np.inf)
        near = (over < NEAR) & (over > 0)
        wide = np.select([far, near], [own[0], SMALL * own[0]], width / per_mm)
        high = np.select([far, near], [own[1], SMALL * own[1]], height / per_mm)
        return wide + BESIDE, high + UNDER


def _far(count: int) -> float:
    """Return how many times larger than its share of the room one of so many plans may be."""
    return FAR if count > FEW else OUTLIER / 2


def _next(per_mm: float, asked: Scales, *, finer: bool) -> float:
    """Return the next scale of the series, units per mm."""
    if asked.convention is Convention.MM_PER_UNIT:
        return 1.0 / series_near(1.01 ** (1 if finer else -1) / per_mm, up=finer)
    return series_near(per_mm * 1.01 ** (-1 if finer else 1), up=not finer)


def _fitting(asked: Scales, box: Box, size: Box) -> float:
    return choose_scale(size, box, mm_per_unit=asked.convention is Convention.MM_PER_UNIT)


def own_scale(
    construction: Construction, si: Reading, views: Views, common: Scale, kind: PlanKind, index: int
) -> Scale:
    """Return the scale at which a plan is drawn in one position.

    It is the common one, but for a plan that would leave its view by far (near a dead position),
    or would be too small to be read where the file gives no scale.
    """
    size, box = plan_extent(construction, si, kind, index), views.plan_box(kind, si.count)
    over = max(size[0] / box[0], size[1] / box[1]) / common.per_mm
    asked = construction.draft.problem.scales
    given = getattr(asked, common.symbol) is not None
    if si.count > 1 and given is False and 0.0 < over < NEAR:
        box = (SMALL * box[0], SMALL * box[1])
    elif over <= _far(si.count) or (given and si.count == 1):
        return common
    return Scale(common.symbol, _fitting(asked, box, size), common.unit)
