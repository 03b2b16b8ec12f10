"""The path of the driver between its requested positions (ход начального звена)."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from math import ceil, isfinite, lcm

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.solved.reading import Complexes, Reals
from planmethod.solved.solution import Solution

TURN = 360.0

_SAME = 1e-6  # degrees within which positions are one
_PARTS = 12  # parts of a step of a driving slider
_MAX_POINTS = 720  # points of a line

_SAG = 1.5e-3  # of the largest value: a corner of a curve that goes further out is seen
_HALVINGS = 6
_ADDED = 400  # positions more, at the most


class DriverPath(Struct, frozen=True, dict=True):
    """Driver positions along a smooth curve (ход начального звена).

    A full turn in equal steps is closed; other positions are joined from the first to the last.
    Positions over several turns are mapped to one.

    Attributes
    ----------
    step : float, degrees
        Greatest step of a crank between points of the line.
    min_steps : int
        Minimum number of steps of the curve.
    turns : int
        Turns of a crank after which everything repeats: two for loads over 720 degrees; more if the
        links are then not where they were.
    """

    solution: Solution
    step: float = 3.0
    min_steps: int = 1
    turns: int = 1

    @property
    def _turn(self) -> float:
        again = self.solution.closes_after
        turns = lcm(self.turns, round(again)) if isfinite(again) else self.turns
        return self.solution.problem.drive.coordinate.turn * turns

    @property
    def falling(self) -> bool:
        """True if positions fall in the order of their numbers."""
        asked = self.solution.positions
        return len(asked) > 1 and bool(asked[1] < asked[0])

    @cached_property
    def distinct_positions(self) -> Reals:
        """Distinct requested positions in order."""
        # Not np.unique: with it numpy.ma is imported.
        asked = np.asarray(sorted(set(self.solution.positions.tolist())))
        if len(asked) < 2 or np.ptp(asked) <= self._turn + _SAME:
            return asked
        return np.unique(asked[0] + np.round((asked - asked[0]) % self._turn, 9) % self._turn)

    @cached_property
    def drawn(self) -> Reals:
        """Distinct requested positions in order; in a closed path number 0 is at both ends."""
        drawn = self.distinct_positions
        if not self.closed:
            return drawn
        if self.falling:
            return np.insert(drawn, 0, drawn[-1] - self._turn)
        return np.append(drawn, drawn[0] + self._turn)

    @cached_property
    def positions(self) -> Reals:
        """Driver positions, including the requested ones, in order, ndarray of shape (n,)."""
        drawn = self.drawn
        if len(drawn) < 2:
            return drawn
        gaps = np.diff(drawn)
        if self.solution.problem.drive.goes_round:
            whole = float(gaps.sum())
            step = max(min(self.step, whole / self.min_steps), whole / _MAX_POINTS)
            counts = [max(1, ceil(gap / step - 1e-9)) for gap in gaps]
        else:
            parts = max(_PARTS, ceil(self.min_steps / len(gaps)))
            counts = [max(1, min(parts, _MAX_POINTS // len(gaps)))] * len(gaps)
        lines = [
            start + gap * np.arange(count) / count
            for start, gap, count in zip(drawn[:-1], gaps, counts, strict=True)
        ]
        return np.concatenate([*lines, drawn[-1:]])

    @cached_property
    def closed(self) -> bool:
        """True if the requested positions go all round."""
        drawn = self.distinct_positions
        gaps = np.diff(np.append(drawn, drawn[:1] + self._turn))
        return len(drawn) > 2 and bool(np.ptp(gaps) < 1e-6)


def without_corners(
    positions: Reals,
    rows: Complexes,
    read: Callable[[Reals], Complexes],
    jumps: npt.NDArray[np.bool_] | None = None,
) -> tuple[Reals, Complexes, npt.NDArray[np.bool_]]:
    """Return a curve with positions between those where its chords would show corners.

    Parameters
    ----------
    positions : ndarray of shape (m,)
        Driver positions, in order.
    rows : ndarray of shape (k, m)
        Ends of vectors there, NaN where there are none; each row is a curve.
    read : callable
        Returns the rows of other positions; of one curve its values.
    jumps : ndarray of shape (m - 1,)
        Intervals of positions in which some value jumps: they are not smoothed.
    """
    jumps = np.zeros(len(positions) - 1, dtype=bool) if jumps is None else jumps
    largest = np.nanmax(np.abs(rows), axis=1, initial=0.0)
    least = _SAG * np.where(largest > 0.0, largest, np.inf)[:, np.newaxis]
    most = len(positions) + _ADDED
    for _ in range(_HALVINGS):
        corners = (_sags(rows) > least).any(axis=0) & ~jumps[1:] & ~jumps[:-1]
        halved = np.zeros(len(jumps), dtype=bool)
        halved[1:] |= corners
        halved[:-1] |= corners
        where = np.flatnonzero(halved)
        if not where.size or len(positions) + where.size > most:
            break
        between = (positions[where] + positions[where + 1]) / 2
        rows = np.insert(rows, where + 1, np.atleast_2d(read(between)), axis=1)
        positions = np.insert(positions, where + 1, between)
        jumps = np.insert(jumps, where + 1, False)
    return positions, rows, jumps


def _sags(rows: Complexes) -> Reals:
    """Return how far every inner point of curves is from the line of its neighbours."""
    before, chord = rows[:, :-2], rows[:, 2:] - rows[:, :-2]
    length = np.maximum(np.abs(chord), 1e-300)
    across = np.abs(((rows[:, 1:-1] - before) * chord.conj()).imag) / length
    return np.asarray(np.nan_to_num(across), dtype=float)
