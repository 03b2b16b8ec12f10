"""Decisions from the mechanism (выбор по механизму): loaded positions, force scale."""

from __future__ import annotations

import numpy as np

from planmethod.construct.scale import choose_scale
from planmethod.mechanism.model import FRAME
from planmethod.problem.load_records import SizeTable
from planmethod.solved.forces.loads import external
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.reading import Flags
from planmethod.solved.representative_position import clearest_position, is_clear
from planmethod.solved.sheet_estimate import Box
from planmethod.solved.solution import Solution

FORCES_BOX: Box = (170.0, 130.0)
"""Box of the largest force plan of a project at the common scale, mm."""


CONSIDERABLE, SLIGHT = 1.0 / 3.0, 0.05
"""Shares of its largest size from which a load is considerable, and acts at all, in a position."""


def calculated_position(solution: Solution) -> int:
    """Return the default calculated position (расчётное положение).

    The clearest of those in which a load is considerable; if none of them is clear, a clear one in
    which a load acts.
    """
    chosen = [clearest_position(solution, loaded_positions(solution, share))
              for share in (CONSIDERABLE, SLIGHT)]  # fmt: skip
    return next((number for number in chosen if is_clear(solution)[number]), chosen[0])


def loaded_positions(solution: Solution, fraction: float = CONSIDERABLE) -> tuple[int, ...]:
    """Return the positions in which a varying load is considerable; all where none varies.

    A load is considerable from a ``fraction`` of its largest size on: in other positions weights
    and inertia would hide it.
    """
    count, dynamics = len(solution.positions), solution.problem.dynamics
    acts: Flags = np.zeros(count, dtype=bool)
    if dynamics is not None:
        tables = {load.name: load.size.values for load in dynamics.loads
                  if isinstance(load.size, SizeTable)}  # fmt: skip
        for link in (FRAME, *solution.problem.mechanism.links):
            for one in external(solution, dynamics, link):
                size = np.abs(np.broadcast_to(one.force if one.point else one.couple, acts.shape))
                largest = max(float(size.max()), *map(abs, tables.get(one.name, ())), 1e-300)
                large = size >= fraction * largest
                acts |= large & (not large.all())  # one that is there always says nothing
    return tuple(np.flatnonzero(acts).tolist()) if acts.any() else tuple(range(count))


def force_scale(solution: Solution) -> float:
    """Return one scale for all force plans of a position, N per mm."""
    statics, asked = statics_of(solution), solution.problem.scales
    if asked.mu_F is not None:
        return asked.mu_F
    whole = np.max([statics.extent(plan) for plan in statics.board.plans], axis=0)
    box = float(whole[0]), float(whole[1])
    return choose_scale(box, FORCES_BOX, mm_per_unit=asked.in_mm_per_unit)
