"""Polar diagram of a reaction: its vectors from one pole, their ends joined (годограф реакции)."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from planmethod.construct.scale import Scale, choose_scale
from planmethod.plans.forces.board import SCALE
from planmethod.problem.model import Convention
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.labels.spots import shared_spots, spot_labels
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import arrowhead
from planmethod.solved.cycle import Cycle
from planmethod.solved.forces.reading import FAINT_SHARE
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.reading import Complexes, remembered

HODOGRAPH = "hodograph"
"""Tag of the curve; of the pole it is `POLE`."""

POLE = "hodograph pole"

MOST_NUMBERS = 24
"""Positions that have their numbers: of more every second one, or third."""

_BEYOND = 7.0  # mm: the axes go on beyond the curve
_HEAD = 3.5
_DASHED = 10.0  # mm: a shorter line shows no dashes
_LEAST = 0.6  # mm: a shorter vector has no ray


def hodograph_scale(cycle: Cycle, number: int, side: float) -> Scale:
    """Return the scale at which a hodograph fills a square of ``side`` mm."""
    places = np.concatenate([[0j], *(piece.values for piece in cycle.force(number))])
    size = (float(np.ptp(places.real)), float(np.ptp(places.imag)))
    inverse = cycle.solution.problem.scales.convention is Convention.MM_PER_UNIT
    return Scale(SCALE, choose_scale(size, (side, side), mm_per_unit=inverse), "N")


def polar_groups(cycle: Cycle) -> list[list[int]]:
    """Return the numbers of the reactions that have a polar diagram.

    They are something, and may turn as they like, unlike those across a guide. Reactions that are
    the same but for their sign, as those at the ends of a massless link, share one.
    """
    reactions = statics_of(cycle.solution).board.reactions
    groups: list[list[int]] = []
    for k, reaction in enumerate(reactions):
        if reaction.couple is not None or cycle.is_nothing(k):
            continue
        for group in groups:
            if opposite(cycle, group[0], k) is not None:
                group.append(k)
                break
        else:
            groups.append([k])
    return groups


def opposite(cycle: Cycle, one: int, two: int) -> bool | None:
    """Tell whether two reactions are opposite (True) or equal (False) all over; None if neither."""
    a, b = cycle.joints[one].force, cycle.joints[two].force
    least = FAINT_SHARE * cycle.peak(one).size
    if float(np.max(np.abs(a + b))) <= least:
        return True
    return False if float(np.max(np.abs(a - b))) <= least else None


@remembered
def hodograph_picture(cycle: Cycle, number: int, per_mm: float, letter_height: float) -> Picture:
    """Return the polar diagram of a reaction, its pole at the origin, mm."""
    joint = cycle.joints[number]
    parts = [piece.values / per_mm for piece in cycle.force(number)]
    ends: Complexes = joint.force / per_mm
    items = _axes(np.concatenate([[0j], ends, *parts]))
    for part in (part for part in parts if len(part) > 1):
        items.append(Stroke(tuple(map(complex, part)), Pen.MAIN, tag=f"{HODOGRAPH} {number}"))
    for before, after in pairwise(parts):
        if abs(after[0] - before[-1]) > _LEAST:
            jump = (complex(before[-1]), complex(after[0]))
            pen = Pen.HIDDEN if abs(jump[1] - jump[0]) > _DASHED else Pen.THIN
            items.append(Stroke(jump, pen, tag=f"{HODOGRAPH} {number}"))
    for end in map(complex, ends):
        if abs(end) > _LEAST:
            items.append(Stroke((0j, end), Pen.THIN, tag="hodograph vector"))
            items.append(Disc(end, 0.9, Ink.BLACK, tag="hodograph vector"))
    items.append(Disc(0j, 0.8, Ink.BLACK, tag=POLE))
    letters = _axis_letters(items, letter_height, number)
    return lettered(items, [*letters, *_numbers(ends, max(2.5, 0.7 * letter_height), number)])


def _axes(places: Complexes) -> list[Item]:
    """Return the axes through the pole."""
    left, right = float(places.real.min()) - _BEYOND, float(places.real.max()) + _BEYOND
    low, high = float(places.imag.min()) - _BEYOND, float(places.imag.max()) + _BEYOND
    items: list[Item] = []
    for start, end in ((complex(left, 0), complex(right, 0)), (complex(0, low), complex(0, high))):
        along = (end - start) / abs(end - start)
        items.append(Stroke((start, end - along * _HEAD / 2), Pen.THIN, tag="hodograph axis"))
        items += arrowhead(end, along, length=_HEAD, tag="hodograph axis")
    return items


def _axis_letters(items: list[Item], height: float, number: int) -> list[Label]:
    ends = [item.points[1] for item in items if isinstance(item, Stroke)][:2]
    return [
        Label(
            typeset(letter, height),
            end,
            prefer=way,
            gap=2.0,
            priority=2,
            name=f"hodograph {number}: axis {letter}",
        )
        for letter, end, way in zip("xy", ends, (-1j, 1 + 0j), strict=True)
    ]


def _numbers(ends: Complexes, height: float, number: int) -> list[Label]:
    """Return the numbers of the positions at the ends; ends that coincide share one inscription."""
    every = -(-len(ends) // MOST_NUMBERS)
    numbered = ((complex(end), [str(k)]) for k, end in enumerate(ends) if k % every == 0)
    spots = shared_spots(numbered, near=0.5)
    return spot_labels(spots, height, f"hodograph {number}: position", gap=1.2, manner=BUSY)
