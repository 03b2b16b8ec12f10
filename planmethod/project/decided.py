"""What a mechanism decides of a project (выбор по механизму): loaded positions, force scale."""

from __future__ import annotations

import numpy as np

from planmethod.construct.scale import choose_scale
from planmethod.mechanism.model import FRAME
from planmethod.solved.forces.loads import external
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.reading import Flags
from planmethod.solved.room import Box
from planmethod.solved.solution import Solution

FORCES_BOX: Box = (170.0, 130.0)
"""What the largest force plan of a project fills at the scale of all of them, mm."""


def loaded_positions(solution: Solution) -> tuple[int, ...]:
    """Return the positions in which a load acts; all of them where none does anywhere."""
    count, dynamics = len(solution.positions), solution.problem.dynamics
    acts: Flags = np.zeros(count, dtype=bool)
    if dynamics is not None:
        for link in (FRAME, *solution.problem.mechanism.links):
            for one in external(solution, dynamics, link):
                acts |= np.broadcast_to(one.force if one.point else one.couple, acts.shape) != 0.0
    return tuple(np.flatnonzero(acts).tolist()) if acts.any() else tuple(range(count))


def force_scale(solution: Solution) -> float:
    """Return one scale for all force plans of a position, N per mm."""
    statics, asked = statics_of(solution), solution.problem.scales
    if asked.mu_F is not None:
        return asked.mu_F
    whole = np.max([statics.extent(plan) for plan in statics.board.plans], axis=0)
    box = float(whole[0]), float(whole[1])
    return choose_scale(box, FORCES_BOX, mm_per_unit=asked.in_mm_per_unit)
