"""Labels that are placed only if there is space beside their points or segments."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from planmethod.render.ink.drawing import Bounds, Item
from planmethod.render.labels.candidates import near_candidates
from planmethod.render.labels.model import Label, Placed
from planmethod.render.labels.paper import CROSSED, ROUND_AREAS, Paper

NEAR = 8.0
"""Largest distance of an optional label's middle from its point or segment, mm."""

SIDE_GAP = 1.0
"""Extra white on either side of a label, so that it is not read together with another."""


def spare_labels(
    labels: Sequence[Label], obstacles: Iterable[Item], bounds: Bounds
) -> list[Placed]:
    """Place the labels that have a free place, one after another; the others are left out.

    Parameters
    ----------
    labels : sequence of Label
    obstacles : iterable of Item
        As of `place_labels`.
    bounds : Bounds, mm
        All labels stay inside.
    """
    if not labels:
        return []
    paper = Paper(obstacles, bounds)
    sets = [near_candidates(label) for label in labels]
    free = [every.chosen(rows) for every, rows in zip(sets, paper.free(sets), strict=True)]
    white = np.array([-SIDE_GAP, 0, SIDE_GAP, 0]) + ROUND_AREAS * np.array([-1, -1, 1, 1])
    taken = np.empty((0, 4))
    found = []
    for label, places, costs in zip(labels, free, paper.costs(free, free=True), strict=True):
        x0, y0, x1, y1 = (places.boxes[:, k, None] for k in range(4))
        apart = (x1 < taken[:, 0]) | (x0 > taken[:, 2]) | (y1 < taken[:, 1]) | (y0 > taken[:, 3])
        costs = np.where(apart.all(axis=1), costs, np.inf)
        k = int(np.argmin(np.round(costs, 9))) if len(costs) else -1
        if k < 0 or costs[k] >= CROSSED or places.led[k]:
            continue
        box = places.boxes[k]
        middle = (complex(*box[:2]) + complex(*box[2:])) / 2
        if _off(middle, *(label.segment or (label.anchor, label.anchor))) < NEAR:
            at = complex(box[0], box[1] + label.inscription.descent)
            found.append(Placed(label, at, None, free=True, ground=False))
            taken = np.concatenate([taken, [box + white]])
    return found


def _off(place: complex, start: complex, end: complex) -> float:
    """Return how far a place is from a segment, mm."""
    way = end - start
    share = ((place - start) * way.conjugate()).real / max(abs(way) ** 2, 1e-12)
    return abs(place - start - way * min(1.0, max(0.0, share)))
