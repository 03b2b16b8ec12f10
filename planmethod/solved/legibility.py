"""Legibility of a sheet before it is drawn: density of labels, enlarged clusters, space.

Labels that do not overlap can still be too many to read. So the letters of points are counted in
squares of `SIDE` before any is placed, since the points are known. A scheme with more than
`MAX_LABELS` omits letters step by step (`Thinned` in `planmethod.render.pictures.seriesview`).

The space of a sheet is estimated by the sizes of its blocks, divided as
`planmethod.render.layout.pack` divides them. The estimate is adjusted to the shipped compositions:
other blocks or letters need other numbers.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import combinations
from math import inf
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.steps import Measure, MeasureAlong, NumberName, PointName, Similar
from planmethod.mechanism.model import FRAME
from planmethod.paper import STAMP_HEIGHT, STAMP_WIDTH, Format
from planmethod.plans.build import Construction
from planmethod.plans.model import RATES, PlanKind
from planmethod.solved.reading import Complexes, Reading, Reals

SIDE = 50.0
"""Side of the square in which labels are counted, mm: the area seen at a glance."""

MAX_LABELS = 14
"""Most inscriptions of a scheme in such a square: each has a finger's breadth, 13 mm, of it."""

MERGE_DISTANCE = 0.5
"""Points nearer than this are one on the paper and share a label, mm."""

DOZEN = 12
"""Positions on a sheet of many."""


def densest(places: Sequence[complex] | Complexes) -> tuple[int, complex]:
    """Return the most places in one square of `SIDE`, and the middle of that square, mm.

    Only squares with a place in their middle are considered, so that the count includes that place
    and those around it.
    """
    if not len(places):
        return 0, 0j
    at = np.asarray(places, dtype=complex)
    apart = at[:, None] - at[None, :]
    near = (np.abs(apart.real) <= SIDE / 2) & (np.abs(apart.imag) <= SIDE / 2)
    counts = near.sum(axis=1)
    k = int(np.argmax(counts))
    return int(counts[k]), complex(at[k])


def is_too_dense(construction: Construction, si: Reading, per_mm: float, more: int = 0) -> bool:
    """Return whether a scheme of many positions has too many point letters for its area.

    Letters of links and axes are placed beside them, so the limit of letters is already too many
    for points alone. Centres of mass do not count: their letters are the first to be left out.

    Parameters
    ----------
    si : Reading
        Exact, at unit scales.
    per_mm : float
        Scale of the scheme, m/mm.
    more : int
        Number of additional letters among them, of extreme positions.
    """
    return any(
        densest(places)[0] + more >= MAX_LABELS for places in _lettered(construction, si, per_mm)
    )


def _lettered(construction: Construction, si: Reading, per_mm: float) -> Iterator[Complexes]:
    """Yield the places of the points on one sheet after another, coincident ones once, mm."""
    problem, placed = construction.draft.problem, construction.draft.points()
    fixed = placed & set(problem.bodies[FRAME].points)
    still = [complex(si.point(PointName(point))[0]) for point in sorted(fixed)]
    for start in range(0, si.count, DOZEN):
        own = slice(start, start + DOZEN)
        places = [place / per_mm for place in still]
        for point in sorted(placed - fixed - problem.centres):
            steps = np.round(si.point(PointName(point))[own] / (MERGE_DISTANCE * per_mm))
            places += [MERGE_DISTANCE * step for step in dict.fromkeys(steps.tolist())]
        yield np.asarray(places)


SHORT = 5.0
"""Shorter segments are enlarged, mm: half a division of the ruler is more than a tenth of them."""

RATIOS = (2.0, 2.5, 4.0, 5.0, 10.0, 20.0, 40.0, 50.0, 100.0)
"""Enlargements of GOST 2.302."""

NEGLIGIBLE_LENGTH = 0.25
"""Length below which a segment is negligible on a hand-drawn plan, mm: about the error of a line,
and half a division of the ruler."""

_MIN_SHOWN_LENGTH = 10.0  # mm that the shortest segment of a knot has on its view

WIDEST, _WIDEST_JOINED = 60.0, 110.0
"""Millimetres that such a view may be across; the second, if two circles would overlap."""

ROUND, _SMALLEST = 5.0, 2.5
"""White around the segments of a view, and the least radius of the circle on the plan, mm."""


SMALL, SHOWN = 15.0, 28.0
"""A plan of several positions whose larger side is less than the first is shown enlarged beside
itself, so that it is the second at least, mm."""

LETTERED, TITLED = 8.0, 18.0
"""Space of the letters around a detail view, and of these and its name above it, mm."""

_CROWD, _CROWDED = 4, 6.0
"""Short segments in one place of a plan of few positions that are shown enlarged beside it, and
their distance from that place, mm."""

AROUND, NAMED = 26.0, 20.0
"""Space that such a view takes beside its plan, and above it, mm."""


class DetailView(Struct, frozen=True):
    """Short segments in one place of a plan (узел, выносной элемент).

    Attributes
    ----------
    number : int
        From 0, over all plans of a sheet.
    centre : complex, mm
        Its middle, from the pole of the plan.
    times : float
        How many times larger than the plan it is drawn.
    ends : tuple of pairs of PointName
        The segments that are measured there, as the plan has them.
    initials : frozenset of str
        First letters of the points of the mechanism, which name no view.
    """

    number: int
    centre: complex
    times: float
    ends: tuple[tuple[PointName, PointName], ...]
    initials: frozenset[str] = frozenset()

    def centred(self, at: Mapping[PointName, complex]) -> DetailView:
        """Return the view about the middle of its segments in other places, mm.

        On a plan drawn with a ruler they may be millimetres from where the exact plan has them.
        """
        return replace(self, centre=_middle_of([at[end] for pair in self.ends for end in pair])[0])


def min_enlarged(ruler: float) -> float:
    """Return the shortest segment that is enlarged, mm, by the step of the ruler."""
    return max(min(NEGLIGIBLE_LENGTH, ruler / 2), SHORT / RATIOS[-1])


def ratio_for(length: float) -> float:
    """Return the enlargement at which a segment is long enough to be read.

    Examples
    --------
    >>> ratio_for(0.9), ratio_for(4.5)
    (20.0, 2.5)
    """
    return next((ratio for ratio in RATIOS if length * ratio >= _MIN_SHOWN_LENGTH), RATIOS[-1])


def enlargement_of(size: Reals) -> Reals:
    """Return the enlargement of plans of several positions that are shown again beside themselves.

    It is 1 if a plan is large enough or negligible. Sizes are larger sides, mm, shape (n,).

    Examples
    --------
    >>> times_beside(np.array([0.0, 7.0, 60.0]))
    array([1., 4., 1.])
    """
    wanted = np.searchsorted(RATIOS, SHOWN / np.maximum(size, 1e-9))
    fitting = np.array(RATIOS)[np.minimum(wanted, len(RATIOS) - 1)]
    return np.where((size < SMALL) & (size > SHORT / RATIOS[-1]), fitting, 1.0)


def small_plans(
    construction: Construction, paper: Reading, minimum: float
) -> dict[PlanKind, dict[int, DetailView]]:
    """Return the enlarged views beside plans of several positions, by kind and position.

    The view of a small plan has all segments, about their middle; of another one of few positions,
    a crowd of short ones, not shorter than ``minimum``, mm.
    """
    found: dict[PlanKind, dict[int, DetailView]] = {kind: {} for kind in RATES}
    for kind in RATES:
        pairs = tuple((v.tail, v.head) for v in construction.plan(kind).vectors)
        if not pairs:
            continue
        at = np.stack([paper.point(end) for end in sorted({e for pair in pairs for e in pair})])
        size = np.maximum(np.ptp(at.real, axis=0), np.ptp(at.imag, axis=0))
        middle = (at.real.max(0) + at.real.min(0) + 1j * (at.imag.max(0) + at.imag.min(0))) / 2
        times = enlargement_of(size)
        views = {
            k: DetailView(0, complex(middle[k]), float(times[k]), pairs)
            for k in np.flatnonzero(times > 1.0).tolist()
        }
        for k in range(paper.count) if paper.count <= FEW else ():
            crowd = None if k in views else _crowd_of(construction, paper, kind, k, minimum)
            views |= {} if crowd is None else {k: crowd}
        first = sum(map(len, found.values()))
        initials = _initials(construction)
        found[kind] = {
            k: replace(view, number=first + number, initials=initials)
            for number, (k, view) in enumerate(sorted(views.items()))
        }
    return found


def _crowd_of(
    construction: Construction, paper: Reading, kind: PlanKind, index: int, minimum: float
) -> DetailView | None:
    """Return the view of the place of a plan with the most short segments, if they are many."""
    at, every = _segments(construction, paper, kind, index)
    ends = [(t, h) for t, h in every if minimum <= abs(at[h] - at[t]) < SHORT]
    middles = np.array([at[tail] + at[head] for tail, head in ends]) / 2
    near = np.abs(middles[:, None] - middles[None, :]) <= _CROWDED
    if near.sum(axis=1).max(initial=0) < _CROWD:
        return None
    own = tuple(ends[k] for k in np.flatnonzero(near[int(near.sum(axis=1).argmax())]))
    centre, across = _middle_of([at[end] for pair in own for end in pair])
    times = max((times for times in RATIOS if times * across <= WIDEST), default=RATIOS[0])
    return DetailView(0, centre, times, own)


def _segments(
    construction: Construction, paper: Reading, kind: PlanKind, index: int
) -> tuple[dict[PointName, complex], list[tuple[PointName, PointName]]]:
    """Return the places of the ends of a plan's vectors, mm, and these ends, each pair once."""
    vectors = construction.plan(kind).vectors
    at = {end: complex(paper.point(end)[index]) for v in vectors for end in (v.tail, v.head)}
    return at, list({frozenset((v.tail, v.head)): (v.tail, v.head) for v in vectors}.values())


def _middle_of(places: Sequence[complex]) -> tuple[complex, float]:
    """Return the middle of places and how far they are across about it, mm."""
    at = np.asarray(places)
    low, high = (complex(f(at.real), f(at.imag)) for f in (np.min, np.max))
    centre = (low + high) / 2
    return centre, 2 * float(np.max(np.abs(at - centre)))


def find_detail_views(
    construction: Construction, paper: Reading, kind: PlanKind, minimum: float, first: int
) -> tuple[DetailView, ...]:
    """Return the detail views of a plan in the first position; ``first`` is the first number.

    Segments shorter than ``minimum``, mm, are in none.
    """
    at, ends = _segments(construction, paper, kind, 0)
    initials = _initials(construction)
    found = sorted(_join(at, ends, minimum), key=lambda view: (-view.times, view.ends))
    return tuple(replace(v, number=first + k, initials=initials) for k, v in enumerate(found))


def _join(
    at: Mapping[PointName, complex],
    ends: Iterable[tuple[PointName, PointName]],
    minimum: float,
) -> list[DetailView]:
    """Return the detail views of segments between places, mm, as few as are legible."""
    joined = [
        one
        for tail, head in ends
        if minimum <= abs(at[head] - at[tail]) < SHORT
        and (one := _view_of(((tail, head),), at, WIDEST)) is not None
    ]
    # One view for all that it can hold legibly, and a larger one before two circles overlap.
    for widest in (WIDEST, _WIDEST_JOINED):
        while found := [
            (abs(one.centre - two.centre), one, two, whole)
            for one, two in combinations(joined, 2)
            if widest == WIDEST or _overlap(one, two, at)
            if (whole := _view_of(one.ends + two.ends, at, widest)) is not None
        ]:
            _, one, two, whole = min(found, key=lambda pair: pair[0])
            joined = [view for view in joined if view not in (one, two)] + [whole]
    return joined


def detail_sizes(
    construction: Construction, si: Reading, kind: PlanKind, per_mm: float
) -> list[Box]:
    """Return the sizes of the detail views of a plan in the first position at a scale, mm.

    ``si`` is exact, at unit scales. Each size includes letters and the name.
    """
    at, ends = _segments(construction, si, kind, 0)
    places = {end: place / per_mm for end, place in at.items()}
    found: list[Box] = []
    for view in _join(places, ends, NEGLIGIBLE_LENGTH):
        _, wide = _middle_of([places[end] for pair in view.ends for end in pair])
        across = view.times * wide + 2 * ROUND
        found.append((across + LETTERED, across + TITLED))
    return found


def _view_of(
    ends: tuple[tuple[PointName, PointName], ...], at: Mapping[PointName, complex], widest: float
) -> DetailView | None:
    """Return the view of some segments, or None if it is wider than ``widest``, mm, or too small.

    Its ratio is the largest at which all fit, and none is longer than is necessary.
    """
    centre, across = _middle_of([at[end] for pair in ends for end in pair])
    shortest = min(abs(at[head] - at[tail]) for tail, head in ends)
    fitting = [times for times in RATIOS if times * across <= widest]
    times = min(ratio_for(shortest), max(fitting, default=0.0))
    return DetailView(0, centre, times, ends) if shortest * times >= SHORT else None


def circle_radius(detail_view: DetailView, at: Mapping[PointName, complex]) -> float:
    """Return the radius of the circle around a knot on its plan, mm, by the places of points."""
    ends = (abs(at[end] - detail_view.centre) for pair in detail_view.ends for end in pair)
    return max(max(ends) + ROUND / detail_view.times, _SMALLEST)


def _overlap(one: DetailView, two: DetailView, at: Mapping[PointName, complex]) -> bool:
    return abs(one.centre - two.centre) < circle_radius(one, at) + circle_radius(two, at)


def _initials(construction: Construction) -> frozenset[str]:
    return frozenset(point[:1] for point in construction.draft.points())


def short_readings(construction: Construction, paper: Reading) -> Reals:
    """Return how many segments that the ruler reads are short in each position, shape (n,)."""
    kinematics = construction.kinematics
    found = np.zeros(paper.count)
    for motion in (kinematics.velocity, kinematics.acceleration):
        for name in set(motion.segments.lengths.values()):
            if isinstance(construction.step(name), Measure | MeasureAlong):
                length = np.abs(paper.number(name))
                found += length < SHORT
    return found


def lengths_on(
    construction: Construction, kind: PlanKind, detail_view: DetailView
) -> Iterator[NumberName]:
    """Yield the lengths that are read or laid off on a detail view."""
    lengths = construction.kinematics.motion(kind).segments.lengths
    for tail, head in detail_view.ends:
        for pair in ((tail, head), (head, tail)):
            name = lengths.get(pair)
            if name is not None:
                yield name


def is_read(construction: Construction, name: NumberName) -> bool:
    """Return whether a ruler reads a length: others are computed and laid off."""
    return isinstance(construction.step(name), Measure | MeasureAlong)


Box: TypeAlias = tuple[float, float]
SizeAlternatives: TypeAlias = frozenset[Box]
"""Sizes of a block that can be laid out in several ways."""

Blocks: TypeAlias = "Box | SizeAlternatives | Sequence[Blocks]"
"""A block, or a group of blocks in reading order."""

FEW = 5
"""Most positions of a homework: each with plans of useful size, all of a kind in one row."""

EDGE, GAP = 5.0, 9.0
"""White between blocks and the frame, and between two blocks, mm."""

CORNER = 14.0
"""Height of graph 26, which is in the upper left corner, mm."""

LETTERS = {"A4": (2.5, 2.5), "A3": (3.5, 2.5), "A2": (3.5, 3.0), "A1": (3.5, 3.5), "A0": (3.5, 3.5)}
"""Heights of the texts and of the calculation that a format must have space for, mm."""

MOST_PARTS = 4
"""Largest number of parts of a table."""

SMALL_TABLE = 2.5
"""Least height of the letters of a table; that of many positions is estimated midway to it, mm."""

_OPTIONS = 8  # maximum number of shapes per run of blocks


class Texts(Struct, frozen=True):
    """Contents of a sheet's texts: numbers in the velocity and in the acceleration plan.

    ``equations``: of vector equations; ``vectors``: of vectors; ``similar``: of points that are
    found by similarity.
    """

    equations: tuple[int, int]
    vectors: tuple[int, int]
    similar: tuple[int, int]

    @classmethod
    def of(cls, construction: Construction) -> Texts:
        """Return the facts of a construction."""
        plans = [construction.plan(k) for k in RATES]
        one, two = ((len(plan.equations), len(plan.vectors)) for plan in plans)
        kinds = [
            section.kind
            for section in construction.sections
            for step in section.steps
            if isinstance(step, Similar)
        ]
        similar = kinds.count(PlanKind.VELOCITY), kinds.count(PlanKind.ACCELERATION)
        return cls((one[0], two[0]), (one[1], two[1]), similar)

    def blocks(
        self, paper: Format, positions: int, *, is_legible: bool = False
    ) -> Sequence[Blocks]:
        """Return the sizes of "Дано", equations, calculations and table, mm.

        Measured on the sheets of a hundred random mechanisms, in heights of letters: an equation is
        13 wide and 4.3 high; a calculation has 2.9 for a vector and 8.4 for a point that is found
        by similarity, within 4; "Дано" of 50 has 6.6, and 2.4 for an equation, within 3.
        """
        return _blocks(self, paper, positions, is_legible)


@lru_cache(maxsize=128)  # called for every tried scale
def _blocks(texts: Texts, paper: Format, positions: int, is_legible: bool) -> Sequence[Blocks]:
    letter, small = LETTERS[paper.like or paper.name]
    small = letter if is_legible else small
    equations = [(13.2 * letter, 4.3 * letter * (count + 0.3)) for count in texts.equations]
    lines = [2.9 * n + 8.4 * k for n, k in zip(texts.vectors, texts.similar, strict=True)]
    statement, calculations = (
        (50.0 * letter, (6.6 + 2.4 * texts.equations[0]) * letter),
        [(41.0 * small, small * n) for n in lines],
    )
    table = _table_ways(texts, paper, positions)
    ways = [frozenset({(w, h), (2 * w + 2 * small, h / 2 + small)}) for w, h in calculations]
    if positions == 1:  # enlarged views take the space that a narrower statement would leave
        return [statement, *equations, *ways, table]
    narrower = (0.7 * statement[0], statement[1] / 0.7)
    return [frozenset({statement, narrower}), *equations, *ways, table]


def _table_ways(texts: Texts, paper: Format, positions: int) -> SizeAlternatives:
    """Return the sizes of the table: that of many positions is also in parts under one another.

    Measured on the sheets of sixty random mechanisms, in heights of letters: 7.7 wide for a vector,
    and 8 for the columns that a part repeats; the names and units above the rows are two of these.
    """
    number = sum(texts.vectors)
    if positions <= FEW:
        height = 55.0 if positions == 1 else 26.0 + 7.5 * positions
        inside = paper.inner[2] - paper.inner[0]
        return frozenset({(min(40.0 + 12.2 * number, 0.58 * inside), height)})
    letter = (LETTERS[paper.like or paper.name][0] + SMALL_TABLE) / 2
    whole, part = 7.7 * letter * number, 2.0 * letter * (min(positions, DOZEN) + 2) + 5.0
    return frozenset(
        (whole / parts + 8.0 * letter * (parts > 1), part * parts + 4.0 * letter)
        for parts in range(1, MOST_PARTS + 1)
    )


class SheetSpace(Struct, frozen=True):
    """Space of a format, and the possible sizes of the texts on it, mm (место на листе).

    Attributes
    ----------
    area : Box
    positions : int
    text_blocks : tuple of tuples of sizes
        Texts that are grouped with the scheme, the velocity and the acceleration plan.
    calculation : sizes
        Calculation of several positions.
    last : sizes
        Table and title block.
    """

    area: Box
    positions: int
    text_blocks: tuple[tuple[tuple[Box, ...], ...], ...]
    calculation: tuple[Box, ...]
    last: tuple[Box, ...]

    def has_space_for(self, views: Iterable[SizeAlternatives]) -> bool:
        """Return whether views fit with the texts, grouped as in the shipped compositions.

        ``views`` are the scheme, the velocity and the acceleration plans.
        """
        area = self.area
        scheme, *plans = views
        raised = frozenset((width, height + CORNER) for width, height in scheme)
        groups = [
            _in_order((shapes(view, area), *others), area)
            for view, others in zip((raised, *plans), self.text_blocks, strict=True)
        ]
        if self.positions == 1 or self.positions > FEW:
            return _groups_fit(groups, self.last, area)
        first, *rates = groups
        return _groups_fit([first], _in_order((*rates, self.calculation, self.last), area), area)


@lru_cache(maxsize=128)  # the same for every tried scale
def space_of(
    texts: Texts, paper: Format, positions: int, over: float = 1.0, *, is_legible: bool = False
) -> SheetSpace:
    """Return the space of a format, whose height is multiplied by ``over``.

    ``is_legible``: the calculation has letters as high as the other texts.
    """
    left, low, right, high = paper.inner
    area = (right - left - 2 * EDGE, over * (high - low - 2 * EDGE))
    statement, one, two, reckoned, reckoned_too, table = texts.blocks(
        paper, positions, is_legible=is_legible
    )
    assert isinstance(table, frozenset)
    lasts: list[Box] = []
    for wide, tall in sorted(table):
        lasts.append((max(wide, STAMP_WIDTH - EDGE), tall + STAMP_HEIGHT))
        if wide > STAMP_WIDTH:
            lasts.append((wide + STAMP_WIDTH, max(tall, STAMP_HEIGHT - EDGE)))
    beside: tuple[tuple[Blocks, ...], ...] = ((statement, [one, two]), (), ())
    if positions == 1:
        beside = (statement,), ([one, reckoned],), ([two, reckoned_too],)
    return SheetSpace(
        area,
        positions,
        tuple(tuple(shapes(block, area) for block in own) for own in beside),
        shapes([reckoned, reckoned_too], area),
        _best(lasts, area),
    )


def _groups_fit(groups: list[tuple[Box, ...]], last: tuple[Box, ...], area: Box) -> bool:
    """Return whether groups and a last one fit; their areas are compared first."""
    whole = (*groups, last)
    if not all(whole):
        return False
    # Each takes the white to its right and above with it, and so does the area.
    least = sum(min((width + GAP) * (height + GAP) for width, height in group) for group in whole)
    room = (area[0] + GAP) * (area[1] + GAP) * (1 + 1e-9)
    return least <= room and _fit_in_order(whole, area)


def _fit_in_order(blocks: tuple[tuple[Box, ...], ...], area: Box) -> bool:
    """Return whether blocks in reading order fit in some way: the first one is enough.

    They are cut in the middle first, where the parts have the fewest sizes.
    """
    count = len(blocks)
    cuts = sorted(range(1, count), key=lambda cut: abs(2 * cut - count))
    return any(
        _are_beside(_in_order(blocks[:cut], area), _in_order(blocks[cut:], area), area)
        for cut in cuts
    )


def _are_beside(first: tuple[Box, ...], second: tuple[Box, ...], area: Box) -> bool:
    """Return whether two blocks fit in an area, one beside the other or under it."""
    wide, tall = area
    return any(
        (a + GAP + c <= wide and b <= tall and d <= tall)
        or (b + GAP + d <= tall and a <= wide and c <= wide)
        for a, b in first
        for c, d in second
    )


def shapes(blocks: Blocks, area: Box) -> tuple[Box, ...]:
    """Return the possible sizes of packed blocks within an area, none worse in both directions."""
    if isinstance(blocks, tuple):
        blocks = frozenset({blocks})
    if isinstance(blocks, frozenset):
        return _best(list(blocks), area)
    return _in_order(tuple(shapes(block, area) for block in blocks), area)


@lru_cache(maxsize=4096)  # most blocks of a new trial are unchanged
def _in_order(blocks: tuple[tuple[Box, ...], ...], area: Box) -> tuple[Box, ...]:
    """Return the sizes of blocks in reading order, of each of which several sizes are known."""
    if len(blocks) == 1:
        return blocks[0]
    wide, tall = area
    found: list[Box] = []
    for middle in range(1, len(blocks)):
        after = _in_order(blocks[middle:], area)
        for a, b in _in_order(blocks[:middle], area):
            for c, d in after:
                if a + GAP + c <= wide:
                    found.append((a + GAP + c, b if b > d else d))
                if b + GAP + d <= tall:
                    found.append((a if a > c else c, b + GAP + d))
    return _best(found, area)


def _best(boxes: list[Box], area: Box) -> tuple[Box, ...]:
    wide, least = area[0], inf
    if len(boxes) == 1:
        ((width, height),) = boxes
        return tuple(boxes) if width <= wide and height <= area[1] else ()
    best: list[Box] = []
    for box in sorted(box for box in boxes if box[1] <= area[1] and box[0] <= wide):
        if box[1] < least:
            best.append(box)
            least = box[1]
    if len(best) <= _OPTIONS:
        return tuple(best)
    return tuple(best[round(k * (len(best) - 1) / (_OPTIONS - 1))] for k in range(_OPTIONS))
