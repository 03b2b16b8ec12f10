"""Enlargement of a lever relative to the velocity plan (масштаб рычага).

With few loads the lever is the turned plan itself. With too many loads for their letters it is
drawn at its own scale, as one would on paper. The same holds in a project: its velocity plans are
as small as those of all positions must be, but its lever has a place of its own.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from planmethod.construct.scale import choose_scale
from planmethod.construct.steps import PointName
from planmethod.plans.forces.lever import Lever
from planmethod.solved.reading import Reading, Reals
from planmethod.solved.sheet_estimate import Box

TIMES = (2.0, 2.5, 4.0, 5.0, 10.0)
"""Enlargements of a lever: those of GOST 2.302 as far as they are needed."""

FULL = 10.0
"""Maximum number of loads per square decimetre of the lever and its surroundings, for letters."""

FEW = 15
"""Number of loads that never overfill a lever: their arrows find other lines."""

PLACE: Box = (150.0, 120.0)
"""Width and height that the lever of a project may fill, mm, beside arrows and letters."""

_LETTER_MARGIN = 30.0  # mm around the lever for the letters
_LARGEST = 400.0  # mm that a lever drawn larger may be across


def lever_times(lever: Lever, paper: Reading, fills: Reals) -> Reals:
    """Return how many times larger than the plan the lever is drawn in each position, shape (n,).

    ``paper`` is the exact reading of the force plans, mm; ``fills`` are the times that it is larger
    anyway (`filling`), or one.
    """
    if len(lever.loads) <= FEW:
        return fills
    acting = np.zeros(paper.count)
    hung = [lever.pole]
    for load in lever.loads:
        one = load.load.applied
        acting += np.asarray(one.couple if load.at is None else one.force) != 0
        if load.at is not None:
            hung.append(load.at)
    width, height = _size(paper, hung)
    for times in TIMES:
        room = (fills * width + 2 * _LETTER_MARGIN) * (fills * height + 2 * _LETTER_MARGIN) / 1e4
        full = (acting > FEW) & (acting > FULL * room) & (times > fills)
        fills = np.where(full & (times * np.maximum(width, height) <= _LARGEST), times, fills)
    return fills


def filling(
    paper: Reading, plan: Sequence[PointName], per_mm: Sequence[float], *, mm_per_unit: bool
) -> Reals:
    """Return how many times larger than the plan a lever fills its place, shape (n,).

    ``plan`` are the points of the velocity plan, ``per_mm`` is its scale in every position. The
    lever has a scale of the series; one where the plan fills the place, or nothing moves.
    """
    found = []
    for width, height, own in zip(*_size(paper, plan), per_mm, strict=True):
        size = own * float(height), own * float(width)  # it is turned
        finer = choose_scale(size, PLACE, mm_per_unit=mm_per_unit) if any(size) else own
        found.append(max(own / finer, 1.0))
    return np.array(found)


def _size(paper: Reading, points: Sequence[PointName]) -> tuple[Reals, Reals]:
    """Return width and height of the box around points, mm."""
    at = np.asarray([np.broadcast_to(paper.point(one), paper.count) for one in points])
    return np.ptp(at.real, axis=0), np.ptp(at.imag, axis=0)
