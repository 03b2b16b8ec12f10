"""Labels already placed, and their costs for the places of another label."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from planmethod.render.labels.candidates import Candidates, Floats, crossing, inside
from planmethod.render.labels.model import VERTICAL_GAP, Label
from planmethod.render.labels.paper import FORBIDDEN

LEADERS_CROSS = 300.0
"""Cost of two leader lines that cross."""

Numbers: TypeAlias = NDArray[np.intp]

_OFF_LEADERS = 0.5  # white between a label and another one's leader line, mm


class OverlapCosts(Struct):
    """Costs of one label's places from the others: shape (n, labels), and the others' stamps."""

    candidates: Candidates
    costs: Floats
    stamps: Numbers

    @classmethod
    def of(cls, candidates: Candidates, labels: int) -> OverlapCosts:
        """Return empty costs for a number of labels, none of them computed yet."""
        return cls(candidates, np.zeros((len(candidates.boxes), labels)), np.full(labels, -1))


class PlacedLabels:
    """Boxes and leader lines of the labels that are placed, by number."""

    def __init__(self, labels: Sequence[Label]) -> None:
        self._beside = np.asarray([label.style.side_gap for label in labels])
        self._widest = float(self._beside.max())
        self._boxes = np.full((len(labels), 4), np.nan)
        self._leaders = np.full((len(labels), 2, 2), np.nan)
        self._around = np.full((len(labels), 4), np.nan)
        self._there: dict[int, None] = {}
        self._stamps = np.full(len(labels), -1)
        self.changes = 0
        """Number of times that a label was placed or removed."""

    def add(self, k: int, candidates: Candidates, row: int, stamp: int) -> None:
        """Record the place of a label; its ``stamp`` is unique."""
        self._boxes[k] = candidates.boxes[row]
        self._leaders[k] = candidates.leaders[row]
        self._around[k] = candidates.around[row]
        self._there[k] = None
        self._stamps[k] = stamp
        self.changes += 1

    def remove(self, k: int) -> None:
        """Forget the place of a label."""
        self._there.pop(k, None)
        self.changes += 1

    def all_except(self, k: int) -> Numbers:
        """Return the numbers of the labels that are there, but for one."""
        return np.array([other for other in self._there if other != k], dtype=np.intp)

    def costs(self, k: int, candidates: Candidates, rows: Numbers) -> Floats:
        """Return the costs of some places from all labels but ``k``, shape (n,)."""
        there = self.all_except(k)
        return np.asarray(self.pair_costs(candidates, rows, there).sum(axis=1))

    def overlap_costs(self, choice: OverlapCosts, rows: Numbers, there: Numbers) -> Floats:
        """Return `pair_costs` of some places, cached for labels that have not moved."""
        old = choice.stamps[there] != self._stamps[there]
        away = np.zeros(0, dtype=np.intp)
        if len(rows) == 1 and old.any():  # for a single place only labels near it are checked
            around, white = choice.candidates.around[rows[0]], self._widest
            theirs = self._around[there]
            meets = (theirs[:, 2:] > around[:2] - white) & (theirs[:, :2] < around[2:] + white)
            near = meets[:, 0] & meets[:, 1]
            away, old = np.flatnonzero(old & ~near), old & near
        moved = there[old]
        if len(moved):
            every = np.arange(len(choice.costs))
            choice.costs[:, moved] = self.pair_costs(choice.candidates, every, moved)
            choice.stamps[moved] = self._stamps[moved]
        found = choice.costs[rows[:, None], there]
        found[:, away] = 0.0
        return np.asarray(found)

    def pair_costs(self, candidates: Candidates, rows: Numbers, numbers: Numbers) -> Floats:
        """Return the cost of each place from each of some labels, shape (n, len(others))."""
        costs = np.zeros((len(rows), len(numbers)))
        if not len(rows) or not len(numbers):
            return costs
        # Only a label near a place can overlap it.
        theirs, white = self._around[numbers], self._widest
        low, high = candidates.corners
        near = (theirs[:, 2:] > low - white) & (theirs[:, :2] < high + white)
        (close,) = np.nonzero(near[:, 0] & near[:, 1])
        if not len(close):
            return costs
        mine, theirs = candidates.around[rows], theirs[close]
        (row, other) = np.nonzero(
            (mine[:, None, 0] - white < theirs[:, 2])
            & (mine[:, None, 2] + white > theirs[:, 0])
            & (mine[:, None, 1] - white < theirs[:, 3])
            & (mine[:, None, 3] + white > theirs[:, 1])
        )
        other = close[other]
        if not len(row):
            return costs
        at, of = rows[row], numbers[other]
        a, b = candidates.boxes[at], self._boxes[of]
        size = np.minimum(a[:, 2:], b[:, 2:]) - np.maximum(a[:, :2], b[:, :2])
        wide = size[:, 0] + np.maximum(self._beside[of], candidates.label.style.side_gap)
        tall = size[:, 1] + VERTICAL_GAP
        found = np.where((wide > 0) & (tall > 0), FORBIDDEN + wide * tall, 0.0)
        own, led = candidates.leaders[at], self._leaders[of]
        has, have = ~np.isnan(own[:, 0, 0]), ~np.isnan(led[:, 0, 0])
        if has.any() or have.any():
            lines, boxes = np.concatenate([led[have], own[has]]), np.concatenate([a[have], b[has]])
            hit = inside(lines, boxes + np.array([-1, -1, 1, 1]) * _OFF_LEADERS) >= 0
            theirs_hit, both = np.count_nonzero(have), has & have
            found[have] += FORBIDDEN * hit[:theirs_hit]
            found[has] += FORBIDDEN * hit[theirs_hit:]
            pairs = np.flatnonzero(both)
            if len(pairs):
                found[pairs] += LEADERS_CROSS * crossing(own, led, pairs, pairs)
        costs[row, other] = found
        return costs
