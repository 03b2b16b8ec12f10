"""Springs and dampers as symbols of kinematic schemes (пружины по ГОСТ 2.770, демпфер).

Each straight symbol goes from one end to the other; ``middle`` is the part of the way where its
coils or its cylinder are, which become shorter with it.
"""

from __future__ import annotations

import cmath
from math import pi, tau

from planmethod.render.ink.drawing import Item, Pen, Stroke
from planmethod.render.symbols.marks import unit

WIDTH = 5.0
"""Width of the coils of a spring and of the cylinder of a damper, mm."""

_COILS = 20.0  # greatest length of the coils, mm
_TEETH = 8  # strokes of the zigzag
_CYLINDER = 10.0  # greatest length of the cylinder, mm
_PART = 0.6  # greatest part of the distance of the ends that coils or cylinder have
_SPIRAL = (3.0, 6.5)  # least and greatest radius of a torsion spring, mm
_TURNS = 2
_STEPS = 24  # of a turn of the spiral


def spring(
    start: complex, end: complex, *, factor: float = 1.0, tag: str = "", middle: float = 0.5
) -> list[Item]:
    """Return a compression or extension spring between two points: a zigzag (пружина)."""
    way, length = unit(end - start), abs(end - start)
    coils = min(_COILS * factor, _PART * length)
    first, step = start + way * (length * middle - coils / 2), way * coils / _TEETH
    half = 1j * way * WIDTH * factor / 2
    teeth = (first + step * (k + 0.5) + (half if k % 2 else -half) for k in range(_TEETH))
    return [Stroke((start, first, *teeth, first + way * coils, end), Pen.THIN, tag=tag)]


def damper(
    start: complex, end: complex, *, factor: float = 1.0, tag: str = "", middle: float = 0.5
) -> list[Item]:
    """Return a damper between two points: a piston in an open cylinder (демпфер)."""
    way, length = unit(end - start), abs(end - start)
    body = min(_CYLINDER * factor, _PART * length)
    half, at = 1j * way * WIDTH * factor / 2, start + way * length * middle
    back, front = at + way * body / 2, at - way * body / 2
    cylinder = (front + half, back + half, back - half, front - half)
    piston = (at + 0.8 * half, at - 0.8 * half)
    lines = ((start, at), piston, cylinder, (back, end))
    return [Stroke(points, Pen.THIN, tag=tag) for points in lines]


def spring_and_damper(
    start: complex, end: complex, *, factor: float = 1.0, tag: str = "", middle: float = 0.5
) -> list[Item]:
    """Return a spring and a damper side by side between two points."""
    way, length = unit(end - start), abs(end - start)
    reach = min(_COILS * factor, _PART * length) / 2 + min(3.0 * factor, 0.1 * length)
    aside, at = 0.7j * way * WIDTH * factor, start + way * length * middle
    low, high = at - way * reach, at + way * reach
    return [
        *spring(low + aside, high + aside, factor=factor, tag=tag),
        *damper(low - aside, high - aside, factor=factor, tag=tag),
        *(Stroke((bar + aside, bar - aside), Pen.THIN, tag=tag) for bar in (low, high)),
        Stroke((start, low), Pen.THIN, tag=tag),
        Stroke((high, end), Pen.THIN, tag=tag),
    ]


def torsion_spring(
    at: complex, first: complex, second: complex, *, factor: float = 1.0, tag: str = ""
) -> list[Item]:
    """Return a torsion spring about a joint: a spiral between two links (пружина кручения).

    Parameters
    ----------
    first, second : complex
        Directions of the links from the joint: at them the spiral ends.
    """
    inner, outer = (radius * factor for radius in _SPIRAL)
    start = cmath.phase(first)
    sweep = tau * _TURNS + cmath.phase(second / first) % tau
    count = round(_STEPS * sweep / tau)
    points = tuple(
        at + cmath.rect(inner + (outer - inner) * k / count, start + sweep * k / count)
        for k in range(count + 1)
    )
    return [Stroke(points, Pen.THIN, tag=tag, smooth=True)]


def torsion_damper(at: complex, *, factor: float = 1.0, tag: str = "") -> list[Item]:
    """Return a torsion damper about a joint: two arcs that face each other."""
    inner, outer = (radius * factor for radius in _SPIRAL)
    arcs = []
    for radius, middle in ((inner + 1.0 * factor, 0.0), (outer, pi)):
        turns = (middle + pi * (k / _STEPS - 0.5) for k in range(_STEPS + 1))
        points = tuple(at + cmath.rect(radius, turn) for turn in turns)
        arcs.append(Stroke(points, Pen.THIN, tag=tag, smooth=True))
    return [*arcs]
