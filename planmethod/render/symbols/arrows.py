"""Arrows (стрелки) of one shape for all lengths: vectors, senses of rotation, drives."""

from __future__ import annotations

import cmath
from math import asin, radians

from planmethod.render.ink.drawing import Arc, Fill, Ink, Item, Pen, Stroke
from planmethod.render.ink.style import ARROW
from planmethod.render.symbols.sizes import unit

SMALL = 3.5
"""Length of the arrowhead of a sense of motion on a scheme, mm."""

FORCE, PLAN_FORCE = "force", "plan-force"
"""First words of the tags of the arrows of forces; the second is the letter. Those of plans are to
scale."""


def arrowhead(
    tip: complex, direction: complex, *, length: float = ARROW.length, tag: str = ""
) -> list[Item]:
    """Return a swept arrowhead with its tip at ``tip``, pointing along ``direction`` (стрелка).

    There is one shape: width and notch follow the length as `ARROW` has them.
    """
    along = unit(direction)
    size = length / ARROW.length
    back = tip - along * length
    side = along * 1j * ARROW.width * size / 2
    notch = tip - along * (ARROW.length - ARROW.notch) * size
    return [Fill((tip, back + side, notch, back - side), Ink.BLACK, tag)]


def vector_arrow(
    tail: complex,
    head: complex,
    *,
    pen: Pen = Pen.MAIN,
    length: float = ARROW.length,
    tag: str = "",
) -> list[Item]:
    """Return a vector of a plan: a line that ends in an arrowhead (вектор).

    The line stops inside the head, so that its square end does not blunt the tip. A vector shorter
    than two heads gets a smaller head; one below 0.3 mm is not drawn.
    """
    span = abs(head - tail)
    if span < 0.3:
        return []
    shrink = min(1.0, span / (2 * length))
    along = unit(head - tail)
    size = length * shrink
    stop = head - along * (size - ARROW.notch / ARROW.length * size * 0.5)
    tip = arrowhead(head, along, length=size, tag=tag)
    # A thick line would swallow a small head.
    shaft = pen if shrink > 0.8 else Pen.THIN
    return [Stroke((tail, stop), shaft, tag=tag), *tip]


def turn_arrow(
    centre: complex,
    radius: float,
    sense: int,
    *,
    middle: float = 45.0,
    sweep: float = 110.0,
    pen: Pen = Pen.THIN,
    length: float = SMALL,
    tag: str = "",
) -> list[Item]:
    """Return a circular arrow of ω or ε about a point (круговая стрелка).

    Parameters
    ----------
    centre : complex, mm
    radius : float, mm
    sense : int
        +1 counter-clockwise, -1 clockwise; 0 draws nothing.
    middle : float, degrees
        Angle of the middle of the arrow on the circle.
    sweep : float, degrees
        Angle that it covers.
    """
    if sense == 0:
        return []
    half = radians(sweep) / 2
    aim = radians(middle)
    tip_angle = aim + half * (1 if sense > 0 else -1)
    tip = centre + cmath.rect(radius, tip_angle)
    # The head is straight: laid along the chord of its own length it stays on the circle.
    size = min(length, radius)
    chord = 2 * asin(min(1.0, size / (2 * radius)))
    back_angle = tip_angle - chord * (1 if sense > 0 else -1)
    back = centre + cmath.rect(radius, back_angle)
    stop_angle = tip_angle - 0.8 * chord * (1 if sense > 0 else -1)
    tail_angle = aim - half * (1 if sense > 0 else -1)
    start, end = (tail_angle, stop_angle) if sense > 0 else (stop_angle, tail_angle)
    shaft = Arc(centre, radius, start, end, pen, tag)
    return [shaft, *arrowhead(tip, tip - back, length=size, tag=tag)]


def turn_sign(centre: complex, size: float, sense: int, *, tag: str = "") -> list[Item]:
    """Return the small sign of a sense of rotation for a table (знак направления вращения).

    ``size`` is the diameter, mm; +1 counter-clockwise, -1 clockwise. Most of a circle that ends on
    top with a head: open on the left or on the right, so that the two are distinct from afar.
    """
    middle = 315.0 if sense > 0 else 225.0
    return turn_arrow(
        centre, size / 2, sense, middle=middle, sweep=280.0, length=0.6 * size, tag=tag
    )


def drive_arrow(start: complex, end: complex) -> list[Item]:
    """Return the straight arrow of a driving slider, beside it (ведущее звено, стрелка хода).

    The circular one of a crank is a `turn_arrow`.
    """
    return vector_arrow(start, end, pen=Pen.THIN, length=SMALL)
