"""How much larger than the velocity plan a lever is drawn (масштаб рычага).

Of few loads the lever is the turned plan itself. Where so many hang on it that none of their
letters has a place, it is drawn at a scale of its own, as one would on paper.
"""

from __future__ import annotations

import numpy as np

from planmethod.plans.forces.lever import Lever
from planmethod.solved.reading import Reading, Reals

TIMES = (2.0, 2.5, 4.0, 5.0, 10.0)
"""How many times larger a lever may be drawn: those of GOST 2.302 as far as they are needed."""

FULL = 10.0
"""Loads per square decimetre of the lever and the room around it: more have no letters nearby."""

FEW = 15
"""Loads on a lever that is never full: the arrows of so many find other lines."""

_ROOM = 30.0  # mm around the lever for the letters
_LARGEST = 400.0  # mm that a lever drawn larger may be across


def lever_times(lever: Lever, paper: Reading) -> Reals:
    """Return how many times larger than the plan the lever is drawn in each position, shape (n,).

    ``paper`` is the exact reading of the force plans, mm.
    """
    found = np.ones(paper.count)
    if len(lever.loads) <= FEW:
        return found
    acting = np.zeros(paper.count)
    places = [np.broadcast_to(paper.point(lever.pole), acting.shape)]
    for load in lever.loads:
        one = load.given.applied
        acting += np.asarray(one.couple if load.at is None else one.force) != 0
        if load.at is not None:
            places.append(np.broadcast_to(paper.point(load.at), acting.shape))
    at = np.asarray(places)
    width, height = np.ptp(at.real, axis=0), np.ptp(at.imag, axis=0)
    for times in TIMES:
        room = (found * width + 2 * _ROOM) * (found * height + 2 * _ROOM) / 1e4
        full = (acting > FEW) & (acting > FULL * room)
        found = np.where(full & (times * np.maximum(width, height) <= _LARGEST), times, found)
    return found
