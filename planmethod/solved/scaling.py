"""Choice of the plans' scales: each plan fills its view, the same scale for all positions.

Paper and scales are one decision. A table by format gives the initial size of scheme and plans.
While the estimate (`planmethod.solved.legibility`) finds no space, scales become coarser; then they
become finer as long as it does. The first format is used on which everything fits and no view is
much smaller than intended. Nothing is drawn for this, and `solve` and the sheets use the same
result. A solution in other positions than the file's does not keep scales that are too fine for it.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from itertools import product
from math import inf
from operator import itemgetter

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from planmethod.construct.scale import Scale, choose_scale, next_scale
from planmethod.paper import DEFAULT_SERIES, paper_format
from planmethod.plans.model import FACTS, MOTION, RATES, PlanKind
from planmethod.problem.model import Problem, Scales
from planmethod.solved.extents import OUTLIER, Extents, typical
from planmethod.solved.legibility import (
    AROUND,
    DOZEN,
    FEW,
    NAMED,
    RATIOS,
    SHORT,
    Box,
    SizeAlternatives,
    detail_sizes,
    enlargement_of,
    is_too_dense,
    space_of,
)
from planmethod.solved.reading import Reading, Reals, memoized
from planmethod.solved.view_space import (
    ALL,
    AS_HIGH,
    BESIDE,
    BETWEEN,
    NAME,
    ROWS,
    SCALE_CAPTION,
    STROKE,
    UNDER,
    Views,
    per_row,
    row_width,
)

STRETCH = 1.35
"""Factor by which a single view may be wider or higher than its box, if it takes no more paper."""

COARSER = 2.5
"""Factor by which a view may be smaller than its own space, so that all views fit together."""

RULING = 1 / 3
"""Largest part of the field for the plan that rules a sheet of one position."""

FAINT = 10.0
"""Shorter vectors are hard to see beside others, mm."""

SCHEME = {"A4": 70.0, "A3": 110.0, "A2": 150.0, "A1": 200.0, "A0": 250.0}
"""Intended width of the scheme on a format, mm."""

CLOSE = 1.03
"""Ratio of the estimate to the height of the paper above which a scale of many positions is made
coarser: rows of many plans take less, because letters of one fit into gaps of the other."""

SPARE = 1.0
"""Ratio of the estimate to the height of the paper allowed at a finer scale of many positions."""

HALF_SPARE = 0.95
"""The same ratio for half a dozen positions: fewer plans fill their rows less well."""

SINGLE = 0.98
"""Factor of these ratios for one position: the texts beside a plan are as high as estimated only
within some lines, and are parted from it where they do not fit."""

TWICE = 2.01
"""Ratio up to which scales of one position become coarser so that its calculation has letters of
3.5 mm."""

MAX_SCHEME_FRACTION = 1.0
"""The same ratio for a scheme whose letters would otherwise be thinned out."""

MANY_SCHEME_WIDTH = 1.5
"""Factor by which the scheme of many positions should be wider, for clarity."""

PLAN = 60.0
"""Intended larger side of a plan, mm."""

FULL, AROUND_PLAN = 25.0, 20.0
"""Limit of vectors per square decimetre of the plan of one position, and the margin counted around
it, mm: above it most vectors have no name, and the plan should be larger."""

READ = 25.0
"""Intended median length of the vectors of a plan, mm: results are measured on them."""

STEP = 0.55
"""Sufficient fraction of these sizes: the scales of the series are as far apart."""

LESS = 0.8
"""Fraction of a composition's sizes that is tried if all of them do not fit."""

DEAD = 40.0
"""Ratio of a plan to the median one above which it is nearly in a dead position: at a common scale
all others would be negligible, enlarged or not."""

TINY, OF_FEW = 25.0, 18.0
"""Larger side of one of many plans, and of few, below which it has its own scale, mm."""

READABLE = 1.8
"""Side of the box that such a plan then fills, in these sizes."""

MIN_PLAN = 9.0
"""Minimum larger side of the median of many plans that must not be sacrificed for space, mm."""

LEGIBLE = 15.0
"""Least median length of the vectors of many plans, mm: else there are fewer on a sheet."""

HALF_DOZEN = 6
"""Positions on a sheet if a dozen are unreadable."""

MAX_DRAWN = 120
"""Maximum number of positions drawn in one call: ten sheets of a dozen."""


def choose_views(extents: Extents, problem: Problem) -> Views:
    """Return the space on the file's format, else on the smallest that is large enough.

    That is one where the scheme has `SCHEME` or three quarters of it in height, and each plan
    `PLAN`, at scales at which everything fits. A sheet is tried on it first, and `solve` speaks of
    its scales.

    Parameters
    ----------
    problem : Problem
        Its paper and its scales.
    """
    paper, count = problem.sheet.paper, extents.si.count
    if paper:
        return Views.for_paper(paper, count)
    for name in DEFAULT_SERIES[:-1] if count <= FEW else ():
        views = Views.for_paper(name, count)
        chosen = _chosen(extents, views, problem.scales)
        if chosen.is_large() and (
            chosen.fits_paper() if chosen.views_fit is None else chosen.views_fit
        ):
            return views
    return Views.for_paper(DEFAULT_SERIES[-1], count)


def decide(extents: Extents, problem: Problem, *, other_positions: bool) -> tuple[Views, Scales]:
    """Return the space and the given scales for all outputs of some positions.

    The file's scales hold for its own positions. For others a plan's scale may be too fine for the
    largest paper: then the file's scales of plans are ignored.
    """
    given, count = problem.scales, extents.si.count
    views = choose_views(extents, problem)
    if other_positions and given != given.freed and count <= MAX_DRAWN:
        over = CLOSE if count > FEW else 1.0
        if not _chosen(extents, views, given).fits_paper(over):
            problem = replace(problem, scales=given.freed)
            views = choose_views(extents, problem)
    return views, problem.scales


def choose_scales(extents: Extents, views: Views, scales: Scales) -> dict[PlanKind, Scale]:
    """Return the scale of each plan: the given one, else one that fills the views.

    First each view fills its own space; then the scales become finer as long as all views fit on
    the paper. Space that one does not need another takes.
    """
    chosen = _chosen(extents, views, scales).per_mm
    return {kind: Scale(FACTS[kind].scale, chosen[kind], FACTS[kind].unit) for kind in MOTION}


@memoized
def _chosen(extents: Extents, views: Views, scales: Scales) -> _Chosen:
    """Return the scales that fill the views."""
    return _Chosen.of(extents, views, scales)


class _Chosen(Struct, frozen=True):
    """Scales at which the views fill a paper, units per mm by kind.

    ``views_fit`` is whether few views fit on it, None where that was not tried. ``is_legible``: it
    has space for a calculation in letters as high as the other texts.
    """

    drawn: Mapping[PlanKind, _Drawn]
    views: Views
    per_mm: dict[PlanKind, float]
    free: tuple[PlanKind, ...]
    views_fit: bool | None = None
    is_legible: bool = False

    @classmethod
    def of(cls, extents: Extents, views: Views, scales: Scales) -> _Chosen:
        """Choose the scales that are free.

        If a dozen positions are unreadable on one sheet, the scales are those of half a dozen.
        """
        found = cls._on_sheets(extents, views, scales, DOZEN)
        if extents.si.count == 1 and found.views_fit:
            legible = cls._on_sheets(extents, views, scales, DOZEN, is_legible=True)
            return legible if legible.views_fit and legible._is_hardly_coarser(found) else found
        if not extents.si.count > HALF_DOZEN or found.is_readable():
            return found
        finer = cls._on_sheets(extents, views, scales, HALF_DOZEN)
        return finer if finer.views_fit and finer._is_finer(found) else found

    @classmethod
    def _on_sheets(
        cls,
        extents: Extents,
        views: Views,
        scales: Scales,
        per_sheet: int,
        *,
        is_legible: bool = False,
    ) -> _Chosen:
        """Choose the scales for some positions on a sheet."""
        drawn = {kind: _Drawn(extents, views, scales, kind, per_sheet) for kind in MOTION}
        given = {kind: getattr(scales, FACTS[kind].scale) for kind in MOTION}
        free = [
            kind
            for kind in MOTION
            if given[kind] is None and any(drawn[kind].size) and not drawn[kind].has_plan_scales
        ]
        per_mm = {kind: given[kind] or drawn[kind].finest_scale for kind in MOTION}
        chosen = tuple(kind for kind in free if kind not in views.fixed)
        own = cls(drawn, views, per_mm, chosen, is_legible=is_legible)
        return own._filled(scales) if views.paper else own

    def _filled(self, scales: Scales) -> _Chosen:
        """Return coarser scales until all views fit, then finer ones as long as they fit."""
        found, free = replace(self, per_mm=dict(self.per_mm)), list(self.free)
        now, least = found.per_mm, {kind: COARSER * self.per_mm[kind] for kind in free}

        def large(kind: PlanKind) -> float:
            return self._large(kind, now[kind])

        many = self.drawn[PlanKind.POSITION].si.count > FEW
        close, spare = (CLOSE, SPARE) if many else (1.0, 1.0)
        if self.drawn[PlanKind.POSITION].per_sheet < DOZEN:
            close, spare = 1.0, HALF_SPARE
        while free and not found.fits_paper(close):
            bears = [k for k in free if _next(now[k], scales, finer=False) <= least[k]]
            if not bears:
                # The sheet continues with texts, has fewer positions, or takes a larger paper.
                return replace(self, views_fit=False)
            coarser = {kind: _next(now[kind], scales, finer=False) for kind in bears}
            largest = max(bears, key=lambda kind: self._large(kind, coarser[kind]))
            now[largest] = coarser[largest]
        while free:
            small = min(free, key=large)
            before = dict(now)
            now[small] = _next(now[small], scales, finer=True)
            if not (self.drawn[small].stretches(now[small]) and found.fits_paper(spare)):
                if many and found._takes_space(small, before, scales, spare):
                    continue
                now.update(before)
                free.remove(small)
        if many:
            found = found._with_legible_scheme(scales)
        elif self.drawn[PlanKind.POSITION].si.count == 1:
            found = found._ruled(scales)
        return replace(found, views_fit=True if self.free else None)

    def _takes_space(
        self, small: PlanKind, before: Mapping[PlanKind, float], scales: Scales, over: float
    ) -> bool:
        """Make a larger view coarser so that the smallest, already finer, fits.

        Returns False, with all scales changed back but the finer one, if no view can be: both
        must remain larger than the smallest was, and the scheme sufficient.
        """
        least, now = self._large(small, before[small]), self.per_mm
        if not self.drawn[small].stretches(now[small]):
            return False
        givers = [kind for kind in self.free if kind is not small]
        for giver in sorted(givers, key=lambda kind: self._large(kind, now[kind]), reverse=True):
            now[giver] = _next(before[giver], scales, finer=False)
            wide = STEP / MANY_SCHEME_WIDTH if giver is PlanKind.POSITION else 0.0
            if self._large(giver, now[giver]) > max(least, wide) and self.fits_paper(over):
                return True
            now[giver] = before[giver]
        return False

    def is_readable(self) -> bool:
        """Return whether the views fit, and half of the vectors of each plan are long enough."""
        rates = [self.drawn[kind] for kind in RATES if kind in self.free]
        return self.views_fit is not False and all(
            LEGIBLE * self.per_mm[one.kind] <= one.vector for one in rates if one.vector
        )

    def _is_finer(self, second: _Chosen) -> bool:
        """Return whether the scales of the plans are finer than others, and none is coarser."""
        ours, theirs = ([one.per_mm[kind] for kind in RATES] for one in (self, second))
        return ours != theirs and all(a <= b for a, b in zip(ours, theirs, strict=True))

    def _is_hardly_coarser(self, second: _Chosen) -> bool:
        """Return whether views are large, and at least half as large as at other scales."""
        pairs = [(self.per_mm[kind], second.per_mm[kind]) for kind in self.free]
        return self.is_large() and all(one <= TWICE * other for one, other in pairs)

    def _ruled(self, scales: Scales) -> _Chosen:
        """Return scales at which one plan of the only position rules the sheet, if they fit.

        It becomes finer, up to `RULING` of the field, and others coarser for it, as long as these
        have their intended sizes and no more vectors are `FAINT`.
        """
        left, low, right, high = paper_format(self.views.paper).inner
        least = max(self.drawn[kind].used(self.per_mm[kind]) for kind in RATES)
        most = RULING * (right - left) * (high - low)
        found: list[tuple[float, float, _Chosen]] = []
        for ruler in [kind for kind in RATES if kind in self.free]:
            others = [kind for kind in self.free if kind is not ruler]
            for times, *coarser in product((1, 2), *(range(3) for _ in others)):
                tried = self._step_scale(ruler, times, scales, finer=True)
                for kind, steps in zip(others, coarser, strict=True):
                    tried = tried._step_scale(kind, steps, scales, finer=False)
                used = {kind: self.drawn[kind].used(tried.per_mm[kind]) for kind in MOTION}
                is_large = all(
                    not steps or self._large(kind, tried.per_mm[kind]) >= 1.0
                    for kind, steps in zip(others, coarser, strict=True)
                )
                if is_large and least < used[ruler] <= most:
                    found.append((used[ruler], sum(used.values()), tried))
        faint = self._count_faint()
        for _, _, tried in sorted(found, key=itemgetter(0, 1), reverse=True):
            if tried._count_faint() <= faint and tried.fits_paper():
                return tried
        return self

    def _step_scale(self, kind: PlanKind, steps: int, scales: Scales, *, finer: bool) -> _Chosen:
        """Return the scales, one of them some members of the series finer or coarser."""
        per_mm = dict(self.per_mm)
        for _ in range(steps):
            per_mm[kind] = _next(per_mm[kind], scales, finer=finer)
        return replace(self, per_mm=per_mm)

    def _count_faint(self) -> int:
        """Return the number of vectors of the plans that are shorter than `FAINT`."""
        one = self.drawn[PlanKind.POSITION].extents
        return sum(
            int((np.abs(one.si.vector(vector.tail, vector.head)) < FAINT * self.per_mm[kind]).sum())
            for kind in RATES
            for vector in one.construction.plan(kind).vectors
        )

    def _with_legible_scheme(self, scales: Scales) -> _Chosen:
        """Return a scheme of many positions finer while its letters are too many for its area.

        It takes the spare space; the texts get smaller letters for it.
        """
        kind, found = PlanKind.POSITION, self
        one = self.drawn[kind]
        while kind in self.free and one.is_too_dense(found.per_mm[kind]):
            finer = _next(found.per_mm[kind], scales, finer=True)
            larger = replace(found, per_mm={**found.per_mm, kind: finer})
            if not (one.stretches(finer) and larger.fits_paper(MAX_SCHEME_FRACTION)):
                break
            found = larger
        return found

    def fits_paper(self, over: float = 1.0) -> bool:
        """Return whether the views, with their texts, fit on the paper."""
        one = self.drawn[PlanKind.POSITION]
        paper = paper_format(self.views.paper)
        over *= SINGLE if one.si.count == 1 else 1.0
        sheets = one.sheets if one.si.count <= DOZEN else one.sheets[:1]
        return all(
            space_of(
                one.extents.texts, paper, len(own), over, is_legible=self.is_legible
            ).has_space_for(
                self.drawn[kind].size_alternatives(self.per_mm[kind], number) for kind in MOTION
            )
            for number, own in enumerate(sheets)
        )

    def is_large(self) -> bool:
        """Return whether scheme and plans have their intended sizes on the paper.

        Plans whose scale is given by the file are not checked.
        """
        return all(
            self._large(kind, self.per_mm[kind]) >= STEP and not self._is_full(kind)
            for kind in self.free
        )

    def _is_full(self, kind: PlanKind) -> bool:
        """Return whether the plan of one position has no space for the names of its vectors."""
        one = self.drawn[kind]
        if one.si.count > 1 or kind is PlanKind.POSITION:
            return False
        vectors = one.extents.construction.plan(kind).vectors
        count = len({frozenset((vector.tail, vector.head)) for vector in vectors})
        wide, high = (side / self.per_mm[kind] + 2 * AROUND_PLAN for side in one.size)
        return count > FULL * wide * high / 1e4

    def _large(self, kind: PlanKind, per_mm: float) -> float:
        """Return the ratio of a view's size at a scale to its intended size.

        That of a plan is also the ratio of its vectors, if it is less.
        """
        drawn = self.drawn[kind]
        if kind is not PlanKind.POSITION:
            read = drawn.vector / (READ * per_mm)
            return min(max(drawn.size) / (PLAN * per_mm), read)
        scheme = SCHEME[AS_HIGH.get(self.views.paper, self.views.paper)]
        if drawn.si.count > FEW:
            scheme *= MANY_SCHEME_WIDTH
        return max(drawn.size) / (scheme * per_mm)


class _Drawn(Struct, frozen=True, dict=True):
    """A drawing of one kind, in SI, and its available space."""

    extents: Extents
    views: Views
    scales: Scales
    kind: PlanKind
    per_sheet: int

    @property
    def si(self) -> Reading:
        """Exact reading at unit scales."""
        return self.extents.si

    @cached_property
    def sizes(self) -> tuple[Reals, Reals]:
        """Width and height in every position, shape (n,)."""
        return self.extents.sizes[self.kind]

    @cached_property
    def size(self) -> Box:
        """Width and height of the largest that is not an outlier."""
        return self.extents.largest[self.kind]

    @cached_property
    def vector(self) -> float:
        """Median length of its vectors in the typical position."""
        return typical(self.extents.vectors[self.kind])

    @property
    def largest(self) -> Box:
        """Width and height of the largest at the common scale, outliers too."""
        common = np.isnan(self.plan_scales) if self.kind is not PlanKind.POSITION else True
        width, height = (np.where(common, size, 0.0) for size in self.sizes)
        return float(width.max()), float(height.max())

    @cached_property
    def box(self) -> Box:
        """Space of the kind, mm."""
        return self.views.box(self.kind)

    @cached_property
    def rows(self) -> bool:
        """True if it consists of many plans in rows."""
        return self.views.in_rows(self.kind)

    @cached_property
    def in_row(self) -> int:
        """Number of plans in a row: those of half a dozen positions are in two rows, too."""
        count = self.si.count
        return per_row(count) if count <= self.per_sheet else self.per_sheet // ROWS

    @cached_property
    def finest_scale(self) -> float:
        """The finest scale of the series at which it fits its own space."""
        wide, high = self.box
        stretched = self.box if self.rows else (COARSER * wide, COARSER * high)
        usual = _fitting(self.scales, self.box, self.size)
        found = per_mm = max(usual, _fitting(self.scales, stretched, self.largest))
        worst = inf
        middle = typical(np.maximum(*self.sizes))
        while self.rows and (per_mm == found or MIN_PLAN * per_mm <= middle):
            crowded = max(self.fill_ratio(per_mm), self.on_paper(per_mm)[0] / self.box[0])
            if crowded < worst:  # smaller plans take more space, because they are shown enlarged
                found, worst = per_mm, crowded
            if crowded <= 1.0 or self.has_plan_scales:
                break
            per_mm = _next(per_mm, self.scales, finer=False)
        return found

    def fill_ratio(self, per_mm: float) -> float:
        """Return the fraction of its space that it takes at a scale."""
        return self.used(per_mm) / self.available()

    def available(self) -> float:
        """Return its available space: the height of plans in rows, mm, else the area, mm²."""
        width, height = self.box
        return height if self.rows else (width + BESIDE) * (height + UNDER)

    def used(self, per_mm: float) -> float:
        """Return the space that it takes at a scale, in the unit of the available space."""
        if not self.rows:
            return (self.size[0] / per_mm + BESIDE) * (self.size[1] / per_mm + UNDER)
        _, high = self._on_paper(per_mm)
        return max(sum(_row_heights(high[own], self.in_row)) for own in self.drawn_on_sheets)

    def is_too_dense(self, per_mm: float) -> bool:
        """Return whether a scheme has more letters at a scale than fit its area."""
        return is_too_dense(self.extents.construction, self.si, per_mm)

    def stretches(self, per_mm: float, times: float = STRETCH) -> bool:
        """Return whether it is neither too wide nor, as a single view, too high, at a scale."""
        if self.rows:
            return self.on_paper(per_mm)[0] <= times * self.box[0]
        return max(self.size[0] / self.box[0], self.size[1] / self.box[1]) <= times * per_mm

    def on_paper(self, per_mm: float) -> Box:
        """Return the size of the view with its letters and its name at a scale, mm."""
        if self.rows:
            name = NAME[AS_HIGH.get(self.views.paper, self.views.paper)]
            wide, _ = self._on_paper(per_mm)
            drawn = self.drawn_on_sheets
            across = max(row_width(wide[own], min(self.in_row, len(own))) for own in drawn)
            return across, self.used(per_mm) + BETWEEN + name - BESIDE
        return self._single_on_paper(self.size, per_mm)

    def _single_on_paper(self, size: Box, per_mm: float) -> Box:
        """Return the size of a single view with its letters and its name at a scale, mm."""
        name = NAME[AS_HIGH.get(self.views.paper, self.views.paper)]
        scheme = self.kind is PlanKind.POSITION
        several = ALL if self.si.count > 1 and scheme else 0.0
        stroke = STROKE if self.si.count > FEW and scheme else 0.0
        width, height = size[0] / per_mm, size[1] / per_mm
        return width + BESIDE + several, height + name + several + stroke

    def size_alternatives(self, per_mm: float, number: int) -> SizeAlternatives:
        """Return the possible sizes of the view on a sheet, by its number from 0, at a scale, mm.

        Plans are in rows of some lengths.
        """
        if self.kind is PlanKind.POSITION and len(self.sheets) > 1 and self.si.count <= DOZEN:
            return frozenset({self._single_on_paper(self.scheme_sizes[number], per_mm)})
        if self.si.count == 1 and self.kind is not PlanKind.POSITION:
            return self._with_details(per_mm)
        if not self.rows or self.si.count > DOZEN:
            return frozenset({self.on_paper(per_mm)})
        own = self.drawn_on_sheets[number]
        wide, high = (size[own] for size in self._on_paper(per_mm))
        name = NAME[AS_HIGH.get(self.views.paper, self.views.paper)]
        return frozenset(
            (row_width(wide, step), sum(_row_heights(high, step)) + BETWEEN + name - BESIDE)
            for step in range(1 if len(own) <= FEW else 3, per_row(len(own)) + 1)
        )

    def _with_details(self, per_mm: float) -> SizeAlternatives:
        """Return the possible sizes of the plan of one position, detail views beside or under it.

        Each column or row of them is as wide and as high as the largest.
        """
        if per_mm not in self._alternatives_by_scale:
            wide, high = self.on_paper(per_mm)
            found = {(wide, high)}
            details = detail_sizes(self.extents.construction, self.si, self.kind, per_mm)
            if details:
                one, other = (max(sides) for sides in zip(*details, strict=True))
                found = set()
                for step in range(1, len(details) + 1):
                    across, along = step * one, -(-len(details) // step) * other
                    found.add((wide + across, max(high, along)))
                    found.add((max(wide, across), high + along))
            self._alternatives_by_scale[per_mm] = frozenset(found)
        return self._alternatives_by_scale[per_mm]

    @cached_property
    def _alternatives_by_scale(self) -> dict[float, SizeAlternatives]:
        return {}

    @cached_property
    def sheets(self) -> list[range]:
        """Positions of each sheet."""
        count, step = self.si.count, self.per_sheet
        return [range(k, min(k + step, count)) for k in range(0, count, step)]

    @cached_property
    def scheme_sizes(self) -> list[Box]:
        """Width and height of the scheme of each sheet."""
        return [self.extents.scheme_in(own) for own in self.sheets]

    @cached_property
    def drawn_on_sheets(self) -> list[list[int]]:
        """Positions of each sheet whose plans are drawn: of many, not those near a dead one.

        Of few all count, because the paper is chosen for them, too.
        """
        drawable, asked = self.extents.drawable, self.extents.construction.draft.problem.calculated
        every = self.si.count <= FEW
        found = [[k for k in own if every or drawable[k] or k == asked] for own in self.sheets]
        return [drawn or list(own) for drawn, own in zip(found, self.sheets, strict=True)]

    @cached_property
    def _size_by_scale(self) -> dict[float, tuple[Reals, Reals]]:
        return {}

    def _on_paper(self, per_mm: float) -> tuple[Reals, Reals]:
        """Return the width and height of every plan with its letters, mm, shape (n,)."""
        if per_mm not in self._size_by_scale:
            self._size_by_scale[per_mm] = self._lettered(per_mm)
        return self._size_by_scale[per_mm]

    def _lettered(self, per_mm: float) -> tuple[Reals, Reals]:
        each = self.each(per_mm)
        width, height = (size / each for size in self.sizes)
        times = enlargement_of(np.maximum(width, height))
        beside = times > 1.0
        said = np.where(each == per_mm, 0.0, SCALE_CAPTION)
        high = np.where(beside, times * height + NAMED, height)
        return width + np.where(beside, times * width + AROUND, 0.0) + BESIDE, high + UNDER + said

    @property
    def has_plan_scales(self) -> bool:
        """True if the file requests own scales for all plans of several positions."""
        several = self.si.count > 1 and self.kind is not PlanKind.POSITION
        return several and self.scales.own and not self.has_file_scale

    @cached_property
    def plan_scales(self) -> Reals:
        """Scales of plans that have their own, shape (n,); NaN where the common one holds.

        These are requested by the file, or belong to a plan so near a dead position that all others
        would be negligible beside it.
        """
        width, height = self.sizes
        size, own = np.maximum(width, height), np.full(self.si.count, np.nan)
        if self.kind is not PlanKind.POSITION:
            box = self.views.plan_box(self.kind, self.si.count, self.in_row)
            alone = (size > 0.0) if self.has_plan_scales else self._is_disproportionate(size)
            for k in np.flatnonzero(alone):
                own[k] = _fitting(self.scales, box, (float(width[k]), float(height[k])))
        return own

    def _is_disproportionate(self, size: Reals) -> NDArray[np.bool_]:
        """Return flags of the plans that are unreadable, or make others so, at a common scale."""
        middle = typical(size)
        if self.has_file_scale:
            return size > DEAD * middle
        return (size > 0.0) & ((size > OUTLIER * middle) | (size * OUTLIER < middle))

    def each(self, per_mm: float) -> Reals:
        """Return the scale of the plan in every position, shape (n,)."""
        own = self.own_scales(per_mm)
        return np.where(np.isnan(own), per_mm, own)

    def own_scales(self, per_mm: float) -> Reals:
        """Return the scales of plans that have their own, shape (n,); NaN where ``per_mm`` holds.

        Besides `plan_scales` these are of plans that would be small, if the file gives no scale.
        """
        width, height = self.sizes
        own, size = self.plan_scales.copy(), np.maximum(width, height) / per_mm
        if self.kind is not PlanKind.POSITION and not self.has_file_scale:
            least = TINY if self.si.count > FEW else OF_FEW
            small = np.isnan(own) & (size < least) & (size > SHORT / RATIOS[-1])
            box = READABLE * least, READABLE * least
            for k in np.flatnonzero(small) if self.si.count > 1 else ():
                own[k] = _fitting(self.scales, box, (float(width[k]), float(height[k])))
        return own

    @property
    def has_file_scale(self) -> bool:
        """True if the file gives the scale."""
        return getattr(self.scales, FACTS[self.kind].scale) is not None


def _row_heights(high: Reals, step: int) -> list[float]:
    """Return the heights of rows of ``step`` plans, mm."""
    return [float(high[k : k + step].max()) for k in range(0, len(high), step)]


def _next(per_mm: float, scales: Scales, *, finer: bool) -> float:
    return next_scale(per_mm, finer=finer, mm_per_unit=scales.in_mm_per_unit)


def _fitting(scales: Scales, box: Box, size: Box) -> float:
    return choose_scale(size, box, mm_per_unit=scales.in_mm_per_unit)


def per_plan_scales(extents: Extents, views: Views, scales: Scales, kind: PlanKind) -> Reals:
    """Return scales of plans that have their own, shape (n,); NaN where the common one holds."""
    chosen = _chosen(extents, views, scales)
    return chosen.drawn[kind].own_scales(chosen.per_mm[kind])
