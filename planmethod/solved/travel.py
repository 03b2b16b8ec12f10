"""The way of the driver between its asked positions (ход начального звена)."""

from __future__ import annotations

from functools import cached_property
from math import ceil

import numpy as np
from msgspec import Struct

from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution

TURN = 360.0

_SAME = 1e-6  # degrees within which positions are one
_PARTS = 12  # parts of a step of a driving slider
_MOST = 720  # points of a line


class Travel(Struct, frozen=True, dict=True):
    """Driver positions that a smooth line goes through (ход начального звена).

    A full turn asked in even steps is closed; other positions are joined from the first to the
    last. What is asked of several turns goes over one again.

    Attributes
    ----------
    step : float, degrees
        Greatest step of a crank between points of the line.
    least : int
        Steps of the line at the least.
    turns : int
        Of a crank after which all is as before: two of loads over 720 degrees.
    """

    solution: Solution
    step: float = 3.0
    least: int = 1
    turns: int = 1

    @property
    def _turn(self) -> float:
        return self.solution.problem.drive.coordinate.turn * self.turns

    @property
    def falling(self) -> bool:
        """Whether positions fall in the order of their numbers."""
        asked = self.solution.positions
        return len(asked) > 1 and bool(asked[1] < asked[0])

    @cached_property
    def asked(self) -> Reals:
        """The asked positions in order, each once."""
        # Not np.unique: with it numpy.ma is imported.
        asked = np.asarray(sorted(set(self.solution.positions.tolist())))
        if len(asked) < 2 or np.ptp(asked) <= self._turn + _SAME:
            return asked
        return np.unique(asked[0] + np.round((asked - asked[0]) % self._turn, 9) % self._turn)

    @cached_property
    def drawn(self) -> Reals:
        """The asked positions in order; of a closed course that of number 0 at both ends."""
        drawn = self.asked
        if not self.closed:
            return drawn
        if self.falling:
            return np.insert(drawn, 0, drawn[-1] - self._turn)
        return np.append(drawn, drawn[0] + self._turn)

    @cached_property
    def positions(self) -> Reals:
        """Driver positions, the asked ones among them, in order, ndarray of shape (n,)."""
        drawn = self.drawn
        if len(drawn) < 2:
            return drawn
        gaps = np.diff(drawn)
        if self.solution.problem.drive.goes_round:
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
        drawn = self.asked
        gaps = np.diff(np.append(drawn, drawn[:1] + self._turn))
        return len(drawn) > 2 and bool(np.ptp(gaps) < 1e-6)
