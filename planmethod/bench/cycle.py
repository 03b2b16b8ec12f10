"""The turn of a crank: errors of graphical calculus and of flywheels by construction; costs."""

from __future__ import annotations

from functools import partial

import numpy as np
from msgspec import Struct

from planmethod.bench.speed import clock
from planmethod.construct.ruler import RulerArithmetic
from planmethod.problem.cycle_records import Differentiation
from planmethod.problem.machine_records import Quadrature
from planmethod.problem.model import Problem
from planmethod.solved.machine.flywheel import Flywheel
from planmethod.solved.machine.runup import RunUp
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import CrankCycle
from planmethod.solved.turn.diagrams import Deviation, Diagrams, deviations

COUNTS = (12, 24, 36, 72, 144)
"""Positions of a turn."""

SWEPT = (12, 360, 36_000)
"""Positions of a turn that are timed."""

RULERS = (0.1, 0.5, 1.0)
"""Ruler steps for reading the path, mm."""


class Calculus(Struct, frozen=True):
    """Errors of graphical calculus with a number of positions, mm of the diagrams.

    ``v`` and ``a`` by chords, ``s`` integrated from exact velocities by middle ordinates;
    ``ruler_effect``: by how much a ruler moves v and a, at the most, for each of `RULERS`.
    """

    count: int
    v: Deviation
    a: Deviation
    s: Deviation
    ruler_effect: tuple[tuple[float, float], ...]


def turn_for(problem: Problem) -> CrankCycle | None:
    """Return the cycle of a problem; None without a fully rotating crank."""
    if not problem.drive.goes_round:
        return None
    turn = CrankCycle(Solution(problem))
    return None if turn.range is not None else turn


def calculus(turn: CrankCycle, count: int) -> Calculus:
    """Measure the errors of graphical differentiation and integration for a number of positions."""
    diagrams, way = Diagrams(turn, count), Differentiation.CHORDS
    found = deviations(diagrams, [way])
    s = Deviation.of(diagrams.integrated(), diagrams.exact(diagrams.fractions)[0])
    _, v, a = diagrams.drawn(way)
    moved = []
    for ruler in RULERS:
        _, read_v, read_a = diagrams.drawn(way, RulerArithmetic(ruler=ruler))
        moved.append((float(np.nanmax(np.abs(read_v - v))), float(np.nanmax(np.abs(read_a - a)))))
    return Calculus(count, found[way, "v"], found[way, "a"], s, tuple(moved))


def ruler_limit_count(rows: list[Calculus], which: int) -> int | None:
    """Return the smallest count at which the ruler affects v more than the construction errs."""
    return next((row.count for row in rows if row.ruler_effect[which][0] > row.v.maximum), None)


def _diagrams(turn: CrankCycle, count: int) -> None:
    Diagrams(turn, count).drawn(Differentiation.CHORDS)


def costs(problem: Problem) -> list[tuple[str, int, float]]:
    """Return times of a cycle, s: its characteristics, diagrams, exact positions."""
    turn = CrankCycle(Solution(problem))
    facts = clock(lambda: CrankCycle(Solution(problem)).pressure, min_runs=3).median
    found = [("range, extremes, pressure angle", 1, facts)]
    for count in (COUNTS[0], COUNTS[-1]):
        found.append(("diagrams by chords", count, clock(partial(_diagrams, turn, count)).median))
    for count in SWEPT:
        at = turn.at(np.arange(count) / count)
        found.append(("exact positions", count, clock(partial(turn.read, at)).median))
    return found


METHODS = tuple((way, method) for method in ("wittenbauer", "mertsalov") for way in Quadrature)
"""Methods: how the work is integrated, and which tangents are drawn."""


class Constructed(Struct, frozen=True):
    """J_f by construction without drafting errors, minus the exact one, %.

    ``off`` has a number for each of `METHODS`; ``count`` is None for the whole curves.
    """

    count: int | None
    off: tuple[float, ...]


def constructed(wheel: Flywheel) -> list[Constructed]:
    """Measure the constructions by numbers of positions, and on the whole curves."""
    delta, exact = wheel.machine.delta, wheel.exact.inertia
    slopes = {"wittenbauer": (1.0 + delta, 1.0 - delta), "mertsalov": (1.0, 1.0)}

    def off(value: float) -> float:
        return 100.0 * (value / exact - 1.0)

    found = [
        Constructed(
            count,
            tuple(
                off(wheel.by_points(count, way, slopes[method]).tangents.inertia)
                for way, method in METHODS
            ),
        )
        for count in COUNTS
    ]
    whole = tuple(
        off(wheel.tangents(*slopes[method], wheel.middle_speed).inertia) for _, method in METHODS
    )
    return [*found, Constructed(None, whole)]


def flywheel_costs(problem: Problem) -> list[tuple[str, float]]:
    """Return seconds, warm: the exact flywheel from the problem on, its check, a run-up."""
    found = [
        ("exact J_f, from the problem", clock(lambda: Flywheel(problem).exact).median),
        ("check by the equation of motion", clock(lambda: Flywheel(problem).integrated).median),
    ]
    if problem.machine is not None and problem.machine.motor is not None:
        found.append(
            ("run-up and steady motion", clock(lambda: RunUp(Flywheel(problem)).run_up).median)
        )
    return found
