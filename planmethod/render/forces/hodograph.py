"""Polar diagram of a reaction: its vectors from one pole, their ends joined (годограф реакции)."""

from __future__ import annotations

import numpy as np

from planmethod.construct.scale import Scale, choose_scale
from planmethod.plans.forces.board import SCALE
from planmethod.problem.model import Convention
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.polar import polar_picture
from planmethod.solved.cycle import Cycle
from planmethod.solved.forces.reading import NEGLIGIBLE_FRACTION
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.reading import Complexes, memoized


def hodograph_scale(cycle: Cycle, number: int, side: float) -> Scale:
    """Return the scale at which a hodograph fills a square of ``side`` mm."""
    places = np.concatenate([[0j], *(piece.values for piece in cycle.force(number))])
    size = (float(np.ptp(places.real)), float(np.ptp(places.imag)))
    inverse = cycle.solution.problem.scales.convention is Convention.MM_PER_UNIT
    return Scale(SCALE, choose_scale(size, (side, side), mm_per_unit=inverse), "N")


def polar_groups(cycle: Cycle) -> list[list[int]]:
    """Return the numbers of the reactions that have a polar diagram.

    They are not zero, and their direction is free, unlike that of reactions across a guide.
    Reactions that are the same but for their sign, as those at the ends of a massless link, share
    one.
    """
    reactions = statics_of(cycle.solution).board.reactions
    groups: list[list[int]] = []
    for k, reaction in enumerate(reactions):
        if reaction.couple is not None or cycle.is_negligible(k):
            continue
        for group in groups:
            if opposite(cycle, group[0], k) is not None:
                group.append(k)
                break
        else:
            groups.append([k])
    return groups


def opposite(cycle: Cycle, one: int, two: int) -> bool | None:
    """Return whether two reactions are always opposite (True) or equal (False); None if neither."""
    a, b = cycle.joints[one].force, cycle.joints[two].force
    least = NEGLIGIBLE_FRACTION * cycle.peak(one).size
    if float(np.max(np.abs(a + b))) <= least:
        return True
    return False if float(np.max(np.abs(a - b))) <= least else None


@memoized
def hodograph_picture(cycle: Cycle, number: int, per_mm: float, letter_height: float) -> Picture:
    """Return the polar diagram of a reaction, its pole at the origin, mm."""
    parts = [piece.values / per_mm for piece in cycle.force(number)]
    ends: Complexes = cycle.joints[number].force / per_mm
    return polar_picture(parts, ends, letter_height, str(number))
