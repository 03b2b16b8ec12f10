"""Polar diagrams: vectors from one pole, their ends joined by a curve (годограф)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.labels.merged_labels import label_merged_letters, merge_letters
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import arrowhead
from planmethod.solved.reading import Complexes

HODOGRAPH = "hodograph"
"""Tag of the curve; of the pole it is `POLE`."""

POLE = "hodograph pole"

MAX_NUMBERS = 24
"""Largest number of numbered positions: with more, every second or third has a number."""

_EXTENSION = 7.0  # mm: extension of the axes beyond the curve
_HEAD = 3.5
_DASHED = 10.0  # mm: a shorter line shows no dashes
_MIN_VECTOR = 0.6  # mm: a shorter vector has no ray


def polar_picture(
    parts: Sequence[Complexes], ends: Complexes, letter_height: float, name: str, pole: str = ""
) -> Picture:
    """Return a polar diagram, its pole at the origin.

    Parameters
    ----------
    parts : sequence of ndarray
        Unbroken parts of the curve, mm.
    ends : ndarray of shape (n,), mm
        Ends of the vectors in the positions.
    name : str
        Name of its labels after "hodograph".
    pole : str
        Letter of the pole.
    """
    items = _axes(np.concatenate([[0j], ends, *parts]))
    for part in (part for part in parts if len(part) > 1):
        items.append(Stroke(tuple(map(complex, part)), Pen.MAIN, tag=f"{HODOGRAPH} {name}"))
    for before, after in pairwise(parts):
        if abs(after[0] - before[-1]) > _MIN_VECTOR:
            jump = (complex(before[-1]), complex(after[0]))
            pen = Pen.HIDDEN if abs(jump[1] - jump[0]) > _DASHED else Pen.THIN
            items.append(Stroke(jump, pen, tag=f"{HODOGRAPH} {name}"))
    for end in map(complex, ends):
        if abs(end) > _MIN_VECTOR:
            items.append(Stroke((0j, end), Pen.THIN, tag="hodograph vector"))
            items.append(Disc(end, 0.9, Ink.BLACK, tag="hodograph vector"))
    items.append(Disc(0j, 0.8, Ink.BLACK, tag=POLE))
    letters = _axis_letters(items, letter_height, name)
    if pole:
        letters.append(
            Label(typeset(pole, letter_height), 0j, gap=1.5, name=f"hodograph {name}: pole")
        )
    return lettered(items, [*letters, *_numbers(ends, max(2.5, 0.7 * letter_height), name)])


def _axes(places: Complexes) -> list[Item]:
    """Return the axes through the pole."""
    left, right = float(places.real.min()) - _EXTENSION, float(places.real.max()) + _EXTENSION
    low, high = float(places.imag.min()) - _EXTENSION, float(places.imag.max()) + _EXTENSION
    items: list[Item] = []
    for start, end in ((complex(left, 0), complex(right, 0)), (complex(0, low), complex(0, high))):
        along = (end - start) / abs(end - start)
        items.append(Stroke((start, end - along * _HEAD / 2), Pen.THIN, tag="hodograph axis"))
        items += arrowhead(end, along, length=_HEAD, tag="hodograph axis")
    return items


def _axis_letters(items: list[Item], height: float, name: str) -> list[Label]:
    ends = [item.points[1] for item in items if isinstance(item, Stroke)][:2]
    return [
        Label(
            typeset(letter, height),
            end,
            prefer=way,
            gap=2.0,
            priority=2,
            name=f"hodograph {name}: axis {letter}",
        )
        for letter, end, way in zip("xy", ends, (-1j, 1 + 0j), strict=True)
    ]


def _numbers(ends: Complexes, height: float, name: str) -> list[Label]:
    """Return the numbers of the positions at the ends; ends that coincide share one inscription."""
    every = -(-len(ends) // MAX_NUMBERS)
    numbered = ((complex(end), [str(k)]) for k, end in enumerate(ends) if k % every == 0)
    spots = merge_letters(numbered, near=0.5)
    return label_merged_letters(spots, height, f"hodograph {name}: position", gap=1.2, style=BUSY)
