"""The labels that have their places, and what they make of the places of another one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from planmethod.render.labels.candidates import Candidates, Floats, crossing, inside
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
        self._around = np.full((len(labels), 4), np.nan)
        self._there: dict[int, None] = {}

    def put(self, k: int, candidates: Candidates, row: int) -> None:
        """Note the place that a label takes."""
        self._boxes[k] = candidates.boxes[row]
        self._leaders[k] = candidates.leaders[row]
        self._around[k] = candidates.around[row]
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
        costs = np.zeros((len(rows), len(there)))
        others = np.asarray(there)
        # Only a label near a place can meet it.
        mine, theirs, white = candidates.around[rows], self._around[others], self._widest
        (row, other) = np.nonzero(
            (mine[:, None, 0] - white < theirs[:, 2])
            & (mine[:, None, 2] + white > theirs[:, 0])
            & (mine[:, None, 1] - white < theirs[:, 3])
            & (mine[:, None, 3] + white > theirs[:, 1])
        )
        if not len(row):
            return costs
        at, of = rows[row], others[other]
        a, b = candidates.boxes[at], self._boxes[of]
        size = np.minimum(a[:, 2:], b[:, 2:]) - np.maximum(a[:, :2], b[:, :2])
        wide = size[:, 0] + np.maximum(self._beside[of], candidates.label.manner.beside)
        tall = size[:, 1] + APART
        found = np.where((wide > 0) & (tall > 0), FORBIDDEN + wide * tall, 0.0)
        own, led = candidates.leaders[at], self._leaders[of]
        lines = np.concatenate([led, own])
        is_led = ~np.isnan(lines[:, 0, 0])
        if is_led.any():
            grown = np.concatenate([a, b]) + np.array([-1, -1, 1, 1]) * _OFF_LEADERS
            hit = np.zeros(len(lines))
            hit[is_led] = inside(lines[is_led], grown[is_led]) >= 0
            found += FORBIDDEN * hit[: len(row)]
            found += FORBIDDEN * hit[len(row) :]
            found += LEADERS_CROSS * crossing(own, led)
        costs[row, other] = found
        return costs
