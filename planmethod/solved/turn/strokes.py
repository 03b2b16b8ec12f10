"""Working stroke of the output (рабочий и холостой ход): by the loads, the longer, or as given.

The file's loads decide, without weights and inertia: a machine is driven against them, so the
working stroke is the one in which they resist most; driving loads, as those of an engine, do their
work in it.
"""

from __future__ import annotations

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.problem.cycle_records import StrokeSense
from planmethod.problem.load_records import Over, SizeTable
from planmethod.problem.model import Problem
from planmethod.solved.forces.loads import external, only_in_positions
from planmethod.solved.reading import Flags, Reals
from planmethod.solved.solution import Solution

SAMPLES = 720
"""Number of positions of a turn over which the work of a stroke is summed."""

EQUAL_WORK_FRACTION = 1e-3
"""Fraction of the larger work below which the difference of the strokes is ignored."""

COUNTS = 0.05
"""Fraction of the working stroke's work from which a load is named as deciding."""

LONGER, TOLD = "longer stroke", "[cycle] working"
"""Criteria of the working stroke if no load decides."""

SENSES = {
    StrokeSense.UP: 1j,
    StrokeSense.DOWN: -1j,
    StrokeSense.LEFT: -1 + 0j,
    StrokeSense.RIGHT: 1 + 0j,
}
"""Unit vector of each sense of a point's motion."""


class Strokes(Struct, frozen=True):
    """Both strokes of an output (рабочий и холостой ход).

    Attributes
    ----------
    working_deg, idle_deg : float, degrees
        Of the crank.
    K_v : float or None
        Ratio of the longer stroke to the shorter, 1 or more; None where the output comes to an end
        of its stroke more than once.
    by : str
        Criterion of the working stroke: ``load P``, ``longer stroke`` or ``[cycle] working``.
    start_deg : float, degrees
        Driver position where the working stroke starts.
    """

    working_deg: float
    idle_deg: float
    K_v: float | None
    by: str
    start_deg: float


def powers(solution: Solution, start: float, positions: Reals) -> dict[str, Reals]:
    """Return the power of the loads on driven links, W, shape (n,), by name.

    Parameters
    ----------
    start : float, degrees
        Position 0 of the cycle, before it is determined.
    positions : ndarray of shape (n,)
    """
    problem = solution.problem
    dynamics = problem.dynamics
    if dynamics is None or not problem.drive.rate:
        return {}
    counted = replace(problem, numbered=problem.numbered or (start,))
    moved = Solution(counted, positions=positions.tolist(), construction=solution.construction)
    found: dict[str, Reals] = {}
    for link in problem.mechanism.links:
        if link == problem.drive.link:
            continue
        for one in external(moved, dynamics, link):
            power = one.couple * moved.links[link].omega
            if one.point is not None:
                velocity = moved.points[one.point].velocity
                power = power + (one.force * velocity.conjugate()).real
            found[one.name] = np.nan_to_num(power)
    return found


def sample_positions(problem: Problem, start: float, turns: int) -> Reals:
    """Return the equally spaced positions of the sum of work; none where it is not known.

    Loads that are known in the positions of the file only are summed over the numbered ones.
    """
    dynamics = problem.dynamics
    if dynamics is None or not dynamics.loads:
        return np.zeros(0)
    if only_in_positions(dynamics):
        own = problem.numbered if problem.numbered == problem.drive.positions else ()
        return np.asarray(own, dtype=float)
    return start + 360.0 * turns * (np.arange(SAMPLES * turns) + 0.5) / (SAMPLES * turns)


def over_strokes(problem: Problem) -> bool:
    """Return whether a load is given over the strokes of the cycle, as an indicator diagram."""
    loads = () if problem.dynamics is None else problem.dynamics.loads
    sizes = (load.size for load in loads)
    return any(isinstance(size, SizeTable) and size.over is Over.STROKES for size in sizes)


def by_loads(load_powers: dict[str, Reals], first: Flags) -> tuple[bool, str] | None:
    """Return whether the first stroke works, and the deciding loads; None if none decides.

    Parameters
    ----------
    load_powers : dict of str to ndarray of shape (n,)
        Power of every load in even positions.
    first : ndarray of bool, shape (n,)
        Which of them are of the first stroke.
    """
    works = {name: np.array([power[first].sum(), power[~first].sum()])
             for name, power in load_powers.items()}  # fmt: skip
    both = sum(works.values(), np.zeros(2))
    if abs(both[0] - both[1]) <= EQUAL_WORK_FRACTION * float(np.max(np.abs(both))):
        return None
    sign = -1.0 if both.sum() < 0.0 else 1.0
    stroke = int(np.argmax(sign * both))
    least = COUNTS * abs(both[stroke])
    names = [name for name, work in works.items() if sign * work[stroke] > least]
    return stroke == 0, f"load{'s' if len(names) > 1 else ''} {', '.join(names)}"
