"""Efficiency of a whole cycle of a machine with friction (КПД за цикл)."""

from __future__ import annotations

from math import inf

import numpy as np
from msgspec import Struct

from planmethod.solved.forces.friction import ZERO_POWER_FRACTION, friction_of
from planmethod.solved.forces.loads import only_in_positions
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.many.positions import impossible_steps
from planmethod.solved.reading import memoized
from planmethod.solved.solution import Solution

COUNT = 360
"""Positions of a turn."""


class CycleEfficiency(Struct, frozen=True):
    """Efficiency of a whole cycle (КПД за цикл), or why it has none.

    Attributes
    ----------
    value : float or None
    ideal, real : float, J
        Work of the driver without friction and with it.
    locked : tuple of float, degrees
        First and last position of a part of the cycle that is jammed; empty of none.
    """

    value: float | None
    ideal: float = 0.0
    real: float = 0.0
    locked: tuple[float, ...] = ()


@memoized
def cycle_efficiency(solution: Solution, count: int = COUNT) -> CycleEfficiency | None:
    """Return the efficiency of the cycle of a crank; None where it cannot be moved through one.

    Parameters
    ----------
    count : int
        Positions of a turn.
    """
    problem = solution.problem
    assert problem.dynamics is not None
    if (
        not problem.drive.goes_round
        or problem.drive.actuator
        or only_in_positions(problem.dynamics)
    ):
        return None
    turned = 360.0 * solution.turns
    whole = count * solution.turns
    grid = float(solution.positions[0]) + turned * (np.arange(whole) + 0.5) / whole
    moved = solution.with_positions(grid.tolist())
    if (impossible_steps(moved) >= 0).any() or not statics_of(moved).closes.all():
        return None
    found = friction_of(moved)
    step = float(np.radians(turned)) / len(grid) / abs(problem.drive.rate)
    ideal = float(found.without.power.sum() * step)
    if found.jammed.any():
        at = grid[found.jammed]
        return CycleEfficiency(None, ideal, inf, (float(at[0]), float(at[-1])))
    real = float(found.converged.power.sum() * step)
    if abs(ideal) <= ZERO_POWER_FRACTION * float(found.scale.sum() * step):
        return CycleEfficiency(None, ideal, real)
    return CycleEfficiency(ideal / real if ideal > 0 else real / ideal, ideal, real)
