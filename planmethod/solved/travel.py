"""The way of the driver between its asked positions (ход начального звена)."""

from __future__ import annotations

from functools import cached_property
from math import ceil

import numpy as np
from msgspec import Struct

from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution

TURN = 360.0

_PARTS = 12  # parts of a step of a driving slider
_MOST = 720  # points of a line


class Travel(Struct, frozen=True, dict=True):
    """Driver positions that a smooth line goes through (ход начального звена).

    A full turn asked in even steps is closed; other positions are joined from the first to the
    last.

    Attributes
    ----------
    step : float, degrees
        Greatest step of a crank between points of the line.
    least : int
        Steps of the line at the least.
    """

    solution: Solution
    step: float = 3.0
    least: int = 1

    @cached_property
    def drawn(self) -> Reals:
        """The asked positions in order, each once, and of a closed course the first one again."""
        drawn = np.unique(self.solution.positions)
        return np.append(drawn, drawn[0] + TURN) if self.closed else drawn

    @cached_property
    def positions(self) -> Reals:
        """Driver positions, the asked ones among them, in order, ndarray of shape (n,)."""
        drawn = self.drawn
        if len(drawn) < 2:
            return drawn
        gaps = np.diff(drawn)
        if self.solution.problem.drive.is_crank:
            whole = float(gaps.sum())
            step = max(min(self.step, whole / self.least), whole / _MOST)
            counts = [max(1, ceil(gap / step - 1e-9)) for gap in gaps]
        else:
            parts = max(_PARTS, ceil(self.least / len(gaps)))
            counts = [max(1, min(parts, _MOST // len(gaps)))] * len(gaps)
        lines = [
            start + gap * np.arange(count) / count
            for start, gap, count in zip(drawn[:-1], gaps, counts, strict=True)
        ]
        return np.concatenate([*lines, drawn[-1:]])

    @cached_property
    def closed(self) -> bool:
        """Whether the asked positions go all round."""
        drawn = np.unique(self.solution.positions)
        gaps = np.diff(np.append(drawn, drawn[:1] + self.solution.problem.drive.coordinate.turn))
        return len(drawn) > 2 and bool(np.ptp(gaps) < 1e-6)
