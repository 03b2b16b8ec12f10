"""The turn of a crank: errors of graphical calculus by the number of positions, and its cost."""

from __future__ import annotations

from functools import partial

import numpy as np

from planmethod.bench.clock import clock
from planmethod.construct.hand import Hand
from planmethod.problem.model import Differentiation, Problem
from planmethod.record import dataclass
from planmethod.solved.solution import Solution
from planmethod.solved.turn.diagrams import Deviation, Diagrams, deviations
from planmethod.solved.turn.turn import Turn

COUNTS = (12, 24, 36, 72, 144)
"""Positions of a turn."""

SWEPT = (12, 360, 36_000)
"""Positions of a turn that are timed."""

RULERS = (0.1, 0.5, 1.0)
"""Steps of a ruler that the path is taken off with, mm."""


@dataclass(frozen=True, slots=True)
class Calculus:
    """Errors of graphical calculus with so many positions, mm of the diagrams.

    ``v`` and ``a`` by chords, ``s`` integrated from exact velocities by middle ordinates;
    ``moved``: by how much a ruler moves v and a, at the most, for each of `RULERS`.
    """

    count: int
    v: Deviation
    a: Deviation
    s: Deviation
    moved: tuple[tuple[float, float], ...]


def turn_for(problem: Problem) -> Turn | None:
    """Return the turn of a problem; None where the crank does not turn fully, or nothing turns."""
    if not problem.drive.is_crank:
        return None
    turn = Turn(Solution(problem))
    return None if turn.range is not None else turn


def calculus(turn: Turn, count: int) -> Calculus:
    """Measure what graphical differentiation and integration err with so many positions."""
    diagrams, way = Diagrams(turn, count), Differentiation.CHORDS
    found = deviations(diagrams, [way])
    s = Deviation.of(diagrams.integrated(), diagrams.exact(diagrams.shares)[0])
    _, v, a = diagrams.drawn(way)
    moved = []
    for ruler in RULERS:
        _, read_v, read_a = diagrams.drawn(way, Hand(ruler=ruler))
        moved.append((float(np.nanmax(np.abs(read_v - v))), float(np.nanmax(np.abs(read_a - a)))))
    return Calculus(count, found[way, "v"], found[way, "a"], s, tuple(moved))


def takes_over(rows: list[Calculus], which: int) -> int | None:
    """Return the least count at which a ruler moves v more than the construction errs."""
    return next((row.count for row in rows if row.moved[which][0] > row.v.most), None)


def _diagrams(turn: Turn, count: int) -> None:
    Diagrams(turn, count).drawn(Differentiation.CHORDS)


def costs(problem: Problem) -> list[tuple[str, int, float]]:
    """Return seconds of a cycle: what is told of a turn, diagrams, exact positions."""
    turn = Turn(Solution(problem))
    facts = clock(lambda: Turn(Solution(problem)).pressure, least=3).median
    found = [("range, extremes, pressure angle", 1, facts)]
    for count in (COUNTS[0], COUNTS[-1]):
        found.append(("diagrams by chords", count, clock(partial(_diagrams, turn, count)).median))
    for count in SWEPT:
        at = turn.at(np.arange(count) / count)
        found.append(("exact positions", count, clock(partial(turn.read, at)).median))
    return found
