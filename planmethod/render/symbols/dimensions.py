"""Dimensions (размеры) by GOST 2.307: lengths along a line and angles."""

from __future__ import annotations

import cmath

from planmethod.render.ink.drawing import Arc, Item, Pen, Stroke
from planmethod.render.symbols.arrows import arrowhead
from planmethod.render.symbols.sizes import unit

_HEAD = 2.5  # length of an arrowhead, mm
_EXTENSION = 1.5  # of the extension lines beyond the dimension line, mm
_TAIL = 5.0  # of a dimension line whose arrowheads are outside, mm


def dimension(
    start: complex, end: complex, out: complex, *, gap: float = 0.0, tag: str = ""
) -> list[Item]:
    """Return a linear dimension: extension lines, the dimension line and its arrowheads.

    ``out`` is the vector from the dimensioned places to the dimension line, mm; the extension lines
    begin ``gap`` mm from the places.
    """
    along, away = unit(end - start), unit(out)
    is_wide = abs(end - start) >= 3 * _HEAD
    items: list[Item] = [
        Stroke((place + away * gap, place + out + away * _EXTENSION), Pen.THIN, tag=tag)
        for place in (start, end)
    ]
    tail = 0.0 if is_wide else _TAIL
    one, two = start + out, end + out
    items.append(Stroke((one - along * tail, two + along * tail), Pen.THIN, tag=tag))
    outward = -along if is_wide else along
    items += arrowhead(one, outward, length=_HEAD, tag=tag)
    return items + arrowhead(two, -outward, length=_HEAD, tag=tag)


def angle_dimension(
    centre: complex, radius: float, low: float, high: float, *, tag: str = ""
) -> list[Item]:
    """Return the dimension of an angle: an arc with arrowheads, from ``low`` to ``high`` radians.

    The sides of the angle are already drawn. An arc too short for arrowheads has none.
    """
    items: list[Item] = [Arc(centre, radius, low, high, Pen.THIN, tag)]
    if (high - low) * radius >= 3 * _HEAD:
        lean = _HEAD / radius / 2  # a head lies along the chord of its own length
        for turn, sense in ((low, -1), (high, 1)):
            tip, way = centre + cmath.rect(radius, turn), cmath.rect(1.0, turn - sense * lean)
            items += arrowhead(tip, way * 1j * sense, length=_HEAD, tag=tag)
    return items
