"""Clusters of short segments of a plan, shown enlarged in detail views (выносные элементы).

A segment shorter than `SHORT` is read on an enlarged view, where the ruler's step is finer by the
ratio. A segment shorter than the error of the plan's lines is negligible, also if enlarged.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.steps import Measure, MeasureAlong, NumberName, PointName
from planmethod.plans.build import Construction
from planmethod.plans.model import RATES, PlanKind
from planmethod.solved.reading import Reading, Reals

SHORT = 5.0
"""Shorter segments are enlarged, mm: half a division of the ruler is more than a tenth of them."""

RATIOS = (2.0, 2.5, 4.0, 5.0, 10.0, 20.0, 40.0, 50.0, 100.0)
"""Enlargements of GOST 2.302."""

NEGLIGIBLE_LENGTH = 0.25
"""Length below which a segment is negligible on a hand-drawn plan, mm: about the error of a line,
and half a division of the ruler."""

_MIN_SHOWN_LENGTH = 10.0  # mm that the shortest segment of a knot has on its view

WIDEST = 60.0
"""Millimetres that such a view may be across."""


SMALL, SHOWN = 15.0, 28.0
"""A plan of several positions whose larger side is less than the first is shown enlarged beside
itself, so that it is the second at least, mm."""

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
    construction: Construction, paper: Reading
) -> dict[PlanKind, dict[int, DetailView]]:
    """Return the plans of several positions that are shown enlarged beside themselves.

    By kind and position: all of their segments, about their middle.
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
        for k in np.flatnonzero(times > 1.0).tolist():
            number = sum(map(len, found.values()))
            initials = _initials(construction)
            found[kind][k] = DetailView(
                number, complex(middle[k]), float(times[k]), pairs, initials
            )
    return found


def find_detail_views(
    construction: Construction, paper: Reading, kind: PlanKind, minimum: float, first: int
) -> tuple[DetailView, ...]:
    """Return the detail views of a plan in the first position; ``first`` is the first number.

    Segments shorter than ``minimum``, mm, are in none.
    """
    at = {
        end: complex(paper.point(end)[0])
        for vector in construction.plan(kind).vectors
        for end in (vector.tail, vector.head)
    }
    ends = {frozenset((v.tail, v.head)): (v.tail, v.head) for v in construction.plan(kind).vectors}
    short = sorted(
        (abs(at[head] - at[tail]), tail, head)
        for tail, head in ends.values()
        if minimum <= abs(at[head] - at[tail]) < SHORT
    )
    found: list[DetailView] = []
    initials = _initials(construction)
    for length, tail, head in short:
        middle = (at[tail] + at[head]) / 2
        for k, detail_view in enumerate(found):
            reach = max(abs(at[end] - detail_view.centre) for end in (tail, head))
            if reach * detail_view.times <= WIDEST / 2:
                found[k] = replace(detail_view, ends=(*detail_view.ends, (tail, head)))
                break
        else:
            number, pair = first + len(found), (tail, head)
            found.append(DetailView(number, middle, ratio_for(length), (pair,), initials))
    return tuple(found)


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


def measured(
    construction: Construction, kind: PlanKind, detail_view: DetailView
) -> Iterator[NumberName]:
    """Yield the lengths that the ruler reads on a detail view."""
    kinematics = construction.kinematics
    motion = kinematics.velocity if kind is PlanKind.VELOCITY else kinematics.acceleration
    lengths = motion.segments.lengths
    for tail, head in detail_view.ends:
        for pair in ((tail, head), (head, tail)):
            name = lengths.get(pair)
            if name is not None and isinstance(construction.step(name), Measure | MeasureAlong):
                yield name
