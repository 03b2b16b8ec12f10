"""Density of labels in one part of a picture (плотность надписей)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.build import Construction
from planmethod.solved.reading import Complexes, Reading

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
