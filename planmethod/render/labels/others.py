"""The labels that have their places, and what they make of the places of another one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from planmethod.render.labels.candidates import Candidates, Floats, around, crossing, inside
from planmethod.render.labels.model import APART, Label
from planmethod.render.labels.paper import FORBIDDEN

LEADERS_CROSS = 300.0
"""Cost of two leader lines that cross."""

_OFF_LEADERS = 0.5  # white between a label and another one's leader line, mm


class Others:
    """Boxes and leader lines of the labels that are placed, by number."""

    def __init__(self, labels: Sequence[Label]) -> None:
        self._beside = np.asarray([label.manner.beside for label in labels])
        self._widest = float(self._beside.max())
        self._boxes = np.full((len(labels), 4), np.nan)
        self._leaders = np.full((len(labels), 2, 2), np.nan)
        self._there: dict[int, None] = {}

    def put(self, k: int, candidates: Candidates, row: int) -> None:
        """Note the place that a label takes."""
        self._boxes[k] = candidates.boxes[row]
        self._leaders[k] = candidates.leaders[row]
        self._there[k] = None

    def lift(self, k: int) -> None:
        """Forget the place of a label."""
        self._there.pop(k, None)

    def but(self, k: int) -> list[int]:
        """Return the numbers of the labels that are there, but for one."""
        return [other for other in self._there if other != k]

    def costs(self, k: int, candidates: Candidates, rows: NDArray[np.intp]) -> Floats:
        """Return what all labels but ``k`` cost some places, shape (n,)."""
        there = self.but(k)
        if not there:
            return np.zeros(len(rows))
        return np.asarray(self.each(candidates, rows, there).sum(axis=1))

    def each(self, candidates: Candidates, rows: NDArray[np.intp], there: list[int]) -> Floats:
        """Return what each label costs each place, shape (n, len(there))."""
        boxes, own = candidates.boxes[rows], candidates.leaders[rows]
        costs = np.zeros((len(rows), len(there)))
        others = np.asarray(there)
        # Only labels near one of the places can meet it.
        x0, y0, x1, y1 = around(boxes, own).T
        a0, b0, a1, b1 = around(self._boxes[others], self._leaders[others]).T
        near = np.flatnonzero(
            (a0 < x1.max() + self._widest)
            & (a1 > x0.min() - self._widest)
            & (b0 < y1.max() + self._widest)
            & (b1 > y0.min() - self._widest)
        )
        if not len(near):
            return costs
        a, b = boxes[:, None, :], self._boxes[others[near]][None, :, :]
        wide = np.minimum(a[..., 2], b[..., 2]) - np.maximum(a[..., 0], b[..., 0])
        wide += np.maximum(self._beside[others[near]], candidates.label.manner.beside)
        tall = np.minimum(a[..., 3], b[..., 3]) - np.maximum(a[..., 1], b[..., 1]) + APART
        found = np.where((wide > 0) & (tall > 0), FORBIDDEN + wide * tall, 0.0)
        white = np.array([-1, -1, 1, 1]) * _OFF_LEADERS
        theirs = self._leaders[others[near]]
        led = np.flatnonzero(~np.isnan(theirs[:, 0, 0]))
        if len(led):
            found[:, led] += FORBIDDEN * (inside(theirs[led][None], a + white) >= 0)
        mine = np.flatnonzero(~np.isnan(own[:, 0, 0]))
        if len(mine):
            lines = own[mine][:, None]
            found[mine] += FORBIDDEN * (inside(lines, b + white) >= 0)
            if len(led):
                found[np.ix_(mine, led)] += LEADERS_CROSS * crossing(lines, theirs[led][None])
        costs[:, near] = found
        return costs
