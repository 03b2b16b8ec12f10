"""Links (звенья): bars, rigid corners, stiff triangles, cranks and rockers."""

from __future__ import annotations

import cmath
from math import pi, radians, sin

from planmethod.render.ink.drawing import Arc, Disc, Fill, Item, Pen, Stroke
from planmethod.render.symbols.grounds import fixed_pivot
from planmethod.render.symbols.hatching import hatch
from planmethod.render.symbols.pairs import revolute
from planmethod.render.symbols.sizes import SIZES, unit


def link(*points: complex, pen: Pen = Pen.MAIN, tag: str = "") -> list[Item]:
    """Return a link as a line through points (звено)."""
    return [Stroke(points, pen, tag=tag)]


def rigid_corner(
    vertex: complex, first: complex, second: complex, *, factor: float = 1.0
) -> list[Item]:
    """Return the mark of a rigid joint: a filled triangle in the angle (жёсткое соединение).

    ``first`` and ``second`` are points of the two arms; arms in one line need no mark.
    """
    one, two = unit(first - vertex), unit(second - vertex)
    if abs((one.conjugate() * two).imag) < sin(radians(4)):
        return []
    size = min(SIZES.corner * factor, abs(first - vertex) / 2, abs(second - vertex) / 2)
    return [Fill((vertex, vertex + one * size, vertex + two * size))]


def mass_centre(at: complex, *, factor: float = 1.0) -> list[Item]:
    """Return a centre of mass: a small circle with two quarters filled (центр масс)."""
    radius = SIZES.centre * factor
    quarters: list[Item] = [
        Fill((at, *(at + cmath.rect(radius, start + pi * k / 12) for k in range(7))))
        for start in (0.0, pi)
    ]
    return [Disc(at, radius), *quarters, Arc(at, radius, pen=Pen.THIN)]


def rigid_polygon(
    *corners: complex,
    hatched: bool = False,
    marked: bool = False,
    factor: float = 1.0,
    pen: Pen = Pen.MAIN,
    tag: str = "",
) -> list[Item]:
    """Return a link with three or more points: its outline, rigid (трёхпарное звено).

    The corners carry joints, so the rigidity is shown by the closed outline, by thin hatching if
    ``hatched``, or by the marks of rigid corners if ``marked``.
    """
    items: list[Item] = []
    if hatched:
        items += hatch(corners, step=2 * SIZES.hatch_step * factor)
    if marked:
        around = zip((corners[-1], *corners[:-1]), corners, (*corners[1:], corners[0]), strict=True)
        for before, vertex, after in around:
            items += rigid_corner(vertex, before, after, factor=factor)
    return [*items, Stroke(corners, pen, closed=True, tag=tag)]


def crank(pivot: complex, pin: complex, *, path: bool = False, tag: str = "") -> list[Item]:
    """Return a crank: a link that rotates fully about a pivot of the frame (кривошип).

    ``path`` adds the circle of its pin, a thin line.
    """
    circle = [Arc(pivot, abs(pin - pivot), pen=Pen.THIN, tag="path")] if path else []
    return [*circle, *link(pivot, pin, tag=tag), *fixed_pivot(pivot), *revolute(pin)]


def rocker(
    pivot: complex, pin: complex, *, swing: tuple[float, float] = (0.0, 0.0), tag: str = ""
) -> list[Item]:
    """Return a rocker: a link that swings about a pivot of the frame (коромысло).

    ``swing`` is its range clockwise and counter-clockwise of the shown position, degrees: the arc
    of its pin is a thin line, the dead positions are dash-dot lines with two dots.
    """
    items: list[Item] = []
    if any(swing):
        radius, angle = abs(pin - pivot), cmath.phase(pin - pivot)
        ends = (angle - radians(swing[0]), angle + radians(swing[1]))
        items.append(Arc(pivot, radius, *ends, pen=Pen.THIN, tag="path"))
        for end in ends:
            way = cmath.rect(1.0, end)
            dead = (pivot + way * SIZES.joint / 2, pivot + way * radius)
            items.append(Stroke(dead, Pen.PHANTOM, tag="dead"))
    return [*items, *link(pivot, pin, tag=tag), *fixed_pivot(pivot), *revolute(pin)]
