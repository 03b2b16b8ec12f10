"""Construction of the extreme positions on the scheme (построение крайних положений)."""

from __future__ import annotations

from math import radians

import numpy as np

from planmethod.note.narrate.turn import radius_names
from planmethod.render.ink.drawing import Arc, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.solved.turn.construction import PRIMES, Construction, Locus

EXTREME = "extreme position"
"""Tag of its lines."""

_NOTCH = 7.0  # mm of an arc to both sides of what it cuts
_RIGHT = 2.5  # mm: sides of the sign of a right angle


def construction_items(made: Construction, height: float) -> tuple[list[Item], list[Label]]:
    """Return thin lines and the names of the radii, mm of the scheme.

    Radii and tangents themselves are the links in these positions, which are drawn.
    """
    items: list[Item] = []
    labels: list[Label] = []
    pivot = made.place(made.pivot)
    crank, total, less = radius_names(made)
    for k, prime in enumerate(PRIMES):
        pin, end = made.place(f"{made.pin}{prime}"), made.place(f"{made.end}{prime}")
        if made.locus is Locus.TANGENTS:
            centre = made.place(made.centre)
            along, inward = ((p - pin) / abs(p - pin) for p in (centre, pivot))
            corner = (along * _RIGHT, (along + inward) * _RIGHT, inward * _RIGHT)
            items.append(Stroke(tuple(pin + one for one in corner), Pen.THIN, tag=EXTREME))
            name, ends = crank, (pivot, pin)
        else:
            radius, turn = abs(end - pivot), float(np.angle(end - pivot))
            half = min(_NOTCH / radius, radians(30.0))
            items.append(Arc(pivot, radius, turn - half, turn + half, Pen.THIN, EXTREME))
            name = total if made.far[k] else less
            ends = (pivot + 0.25 * (end - pivot), end)
        if k and made.locus is Locus.TANGENTS:
            continue  # both radii are the crank's
        labels.append(
            Label(typeset(name, height), sum(ends) / 2, along=ends, gap=0.8,
                  prefer=1j * (ends[1] - ends[0]), name=f"{EXTREME} {k}", manner=BUSY)
        )  # fmt: skip
    return items, labels
