"""Scheme symbols (условные обозначения кинематических схем, GOST 2.770) as display-list items.

Places are mm of paper, directions are complex numbers of any length (or degrees where a parameter
is called an angle). ``factor`` scales a symbol for a small sheet. Where symbols and links overlap
the order matters: sliders first, links over them, joints last, whose white insides cover the lines.
"""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from dataclasses import dataclass
from math import asin, ceil, degrees, pi, radians, sin

from planmethod.render.drawing import Arc, Disc, Fill, Ink, Item, Pen, Stroke
from planmethod.render.style import ARROW, PENS, sweep


@dataclass(frozen=True, slots=True)
class Sizes:
    """Sizes of the symbols, mm, before ``factor``."""

    joint: float = 3.0  # diameter of a revolute pair
    support_height: float = 9.0  # from the pivot to its base line
    support_width: float = 9.0  # between the feet of the support
    base: float = 14.0  # length of the base line
    hatch_step: float = 2.2
    hatch_stroke: float = 3.0
    slider_length: float = 14.0
    slider_width: float = 8.0
    corner: float = 5.0  # leg of the mark of a rigid joint


SIZES = Sizes()


def unit(direction: complex) -> complex:
    """Return the direction with length 1; +x for a vector too short to have one."""
    length = abs(direction)
    return direction / length if length > 1e-12 else 1 + 0j


def link(*points: complex, pen: Pen = Pen.MAIN, tag: str = "") -> list[Item]:
    """Return a link as a line through points (звено)."""
    return [Stroke(points, pen, tag=tag)]


def revolute(at: complex, *, factor: float = 1.0, pen: Pen = Pen.MAIN) -> list[Item]:
    """Return a revolute pair: a circle, white inside (вращательная пара)."""
    radius = SIZES.joint / 2 * factor
    return [Disc(at, radius), Arc(at, radius, pen=pen)]


def ground_line(
    start: complex, end: complex, *, side: int = -1, factor: float = 1.0, pen: Pen = Pen.MAIN
) -> list[Item]:
    """Return a line of the frame with hatching along it (неподвижное звено).

    Parameters
    ----------
    start, end : complex, mm
    side : int
        +1: hatching on the left of the way from ``start`` to ``end``; -1: on the right.

    Notes
    -----
    The strokes are at 45° to the line and lean to the right of the paper wherever they can, stand
    a fixed step apart and are clipped at the ends of the line; both ends look alike::

        ___________________
         / / / / / / / / /
    """
    items: list[Item] = [Stroke((start, end), pen)]
    length = abs(end - start)
    along = unit(end - start)
    across = along * (1j if side > 0 else -1j)
    if _leaning(across + along) > _leaning(across - along) + 1e-9:
        start, along = end, -along
    step = SIZES.hatch_step * factor
    depth = SIZES.hatch_stroke * factor * sin(pi / 4)
    # A stroke goes from s on the line back to s - depth; s may lie beyond the end by as much.
    count = max(1, int((length - depth) / step + 1e-9) + 1)
    first = (length + depth - (count - 1) * step) / 2
    for k in range(count):
        s = first + k * step
        top, bottom = min(s, length), max(s - depth, 0.0)
        ends = (start + along * t + across * (s - t) for t in (top, bottom))
        items.append(Stroke(tuple(ends), Pen.HATCH))
    return items


def _leaning(direction: complex) -> float:
    """Return how near a direction, either way, is to 45° to the right."""
    return abs((unit(direction) * (1 - 1j)).real)


def fixed_pivot(
    at: complex, *, direction: complex = -1j, factor: float = 1.0, pen: Pen = Pen.MAIN
) -> list[Item]:
    """Return a pivot on the frame: joint, support, hatched base (шарнирно-неподвижная опора).

    ``direction`` points from the pivot to the base line, down by default.
    """
    down = unit(direction)
    along = down * 1j
    foot = at + down * SIZES.support_height * factor
    half = SIZES.support_width / 2 * factor
    base = SIZES.base / 2 * factor
    items: list[Item] = [Stroke((foot - along * half, at, foot + along * half), pen)]
    items += ground_line(foot - along * base, foot + along * base, factor=factor, pen=pen)
    return items + revolute(at, factor=factor, pen=pen)


def slider(
    at: complex,
    *,
    angle: float = 0.0,
    length: float = SIZES.slider_length,
    width: float = SIZES.slider_width,
    factor: float = 1.0,
    pen: Pen = Pen.MAIN,
) -> list[Item]:
    """Return a slider: a rectangle turned along its guide, white inside (ползун).

    ``angle`` is the direction of the guide, degrees; ``length`` is along it, mm.
    """
    turn = cmath.exp(1j * radians(angle))
    half, tall = length / 2 * factor, width / 2 * factor
    corners = tuple(
        at + turn * corner
        for corner in (-half - 1j * tall, half - 1j * tall, half + 1j * tall, -half + 1j * tall)
    )
    return [Fill(corners, Ink.WHITE), Stroke(corners, pen, closed=True)]


def stone(
    at: complex,
    *,
    angle: float = 0.0,
    pin: bool = True,
    inside: bool = False,
    factor: float = 1.0,
    pen: Pen = Pen.MAIN,
) -> list[Item]:
    """Return a slider on a moving guide, its guide's line through it and its pin (камень кулисы).

    Smaller than a slider of the frame, and small enough to lie on one with ``inside``. ``angle`` is
    the direction of the guide, degrees. Links that end at the pin are drawn after the stone, so
    give ``pin=False`` and a `revolute` last.
    """
    share = (0.5, 0.6) if inside else (0.85, 0.75)
    length, width = share[0] * SIZES.slider_length, share[1] * SIZES.slider_width
    turn = cmath.exp(1j * radians(angle)) * length / 2 * factor
    items = slider(at, angle=angle, length=length, width=width, factor=factor, pen=pen)
    items.append(Stroke((at - turn, at + turn), pen))
    return items + revolute(at, factor=factor, pen=pen) if pin else items


def guide_line(
    at: complex,
    *,
    angle: float = 0.0,
    before: float = 20.0,
    after: float = 20.0,
    side: int = -1,
    offset: float = SIZES.slider_width / 2,
    factor: float = 1.0,
    pen: Pen = Pen.MAIN,
) -> list[Item]:
    """Return a fixed guide beside a slider: a line hatched on its far side (направляющая).

    Parameters
    ----------
    at : complex, mm
        Pin of the slider.
    angle : float, degrees
        Direction of the guide.
    before, after : float, mm
        How far the line goes from the pin against and along the direction (not scaled).
    side : int
        Side of the pin on which the line lies: +1 left of the direction, -1 right.
    offset : float, mm
        From the pin to the line; half a slider's width by default.
    """
    turn = cmath.exp(1j * radians(angle))
    foot = at + turn * (1j if side > 0 else -1j) * offset * factor
    ends = (foot - turn * before, foot + turn * after)
    return ground_line(*ends, side=side, factor=factor, pen=pen)


def guide_plates(
    at: complex,
    *,
    angle: float = 0.0,
    length: float = SIZES.base,
    width: float = SIZES.slider_width,
    factor: float = 1.0,
    pen: Pen = Pen.MAIN,
) -> list[Item]:
    """Return two short hatched plates, one on either side of a bar or slider (направляющая)."""
    half = length / 2 * factor
    items: list[Item] = []
    for side in (1, -1):
        items += guide_line(
            at,
            angle=angle,
            before=half,
            after=half,
            side=side,
            offset=width / 2,
            factor=factor,
            pen=pen,
        )
    return items


def rigid_corner(
    vertex: complex, first: complex, second: complex, *, factor: float = 1.0
) -> list[Item]:
    """Return the mark of a rigid joint: a filled triangle in the angle (жёсткое соединение).

    ``first`` and ``second`` are points of the two arms; nothing is drawn where the arms are in
    one line, for then nothing is to be told apart.
    """
    one, two = unit(first - vertex), unit(second - vertex)
    if abs((one.conjugate() * two).imag) < sin(radians(4)):
        return []
    size = min(SIZES.corner * factor, abs(first - vertex) / 2, abs(second - vertex) / 2)
    return [Fill((vertex, vertex + one * size, vertex + two * size))]


def stiff_triangle(
    *corners: complex, hatched: bool = False, factor: float = 1.0, pen: Pen = Pen.MAIN
) -> list[Item]:
    """Return a link with three or more points: its outline, rigid (трёхпарное звено).

    The corners carry joints, so the stiffness is shown by the closed outline, or by thin hatching
    when ``hatched``. White inside, so that what is behind does not show through as a link.
    """
    items: list[Item] = []
    if hatched:
        items += hatch(corners, step=2 * SIZES.hatch_step * factor)
    return [*items, Stroke(corners, pen, closed=True)]


def hatch(
    outline: Sequence[complex], *, step: float = SIZES.hatch_step, angle: float = 45.0
) -> list[Item]:
    """Return thin hatching clipped by a polygon (штриховка).

    ``step`` is the distance between the lines, mm; ``angle`` their direction, degrees. The lines
    lie on one lattice for the whole sheet, so that areas side by side hatch alike.
    """
    from shapely import LineString, MultiLineString, Polygon

    turn = cmath.exp(1j * radians(angle))
    area = Polygon([(p.real, p.imag) for p in outline])
    turned = [point / turn for point in outline]
    low, high = min(p.imag for p in turned), max(p.imag for p in turned)
    left, right = min(p.real for p in turned) - 1, max(p.real for p in turned) + 1
    levels = [k * step for k in range(ceil(low / step), ceil(high / step))]
    ends = [((left + 1j * y) * turn, (right + 1j * y) * turn) for y in levels]
    lines = MultiLineString([[(a.real, a.imag), (b.real, b.imag)] for a, b in ends])
    inside = lines.intersection(area)
    parts = [part for part in getattr(inside, "geoms", [inside]) if isinstance(part, LineString)]
    found = [
        tuple(complex(*point) for point in part.coords) for part in parts if part.length > 1e-6
    ]
    return [Stroke(points, Pen.HATCH) for points in found]


def arrowhead(
    tip: complex,
    direction: complex,
    *,
    length: float = ARROW.length,
    width: float = ARROW.width,
    ink: Ink = Ink.BLACK,
    tag: str = "",
) -> list[Item]:
    """Return a swept arrowhead with its tip at ``tip``, pointing along ``direction`` (стрелка)."""
    along = unit(direction)
    notch = ARROW.notch / ARROW.length * length
    back = tip - along * length
    side = along * 1j * width / 2
    return [Fill((tip, back + side, tip - along * (length - notch), back - side), ink, tag)]


def vector_arrow(
    tail: complex,
    head: complex,
    *,
    pen: Pen = Pen.MAIN,
    length: float = ARROW.length,
    width: float | None = None,
    tag: str = "",
) -> list[Item]:
    """Return a vector of a plan: a line that ends in an arrowhead (вектор).

    The line stops inside the head, so that its square end does not blunt the tip. A vector
    shorter than two heads gets a smaller head; nothing is drawn below 0.3 mm. By default the head
    is as wide as `ARROW` says, but two and a half pens at least, to stand out from a thick line.
    """
    span = abs(head - tail)
    if span < 0.3:
        return []
    shrink = min(1.0, span / (2 * length))
    wide = width if width is not None else max(ARROW.width, 2.5 * PENS[pen].width)
    along = unit(head - tail)
    size = length * shrink
    stop = head - along * (size - ARROW.notch / ARROW.length * size * 0.5)
    tip = arrowhead(head, along, length=size, width=wide * shrink, tag=tag)
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
    length: float = 3.5,
    width: float = 1.3,
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
        Where on the circle the middle of the arrow is.
    sweep : float, degrees
        How much of the circle it takes.
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
    head = arrowhead(tip, tip - back, length=size, width=width * size / length, tag=tag)
    return [shaft, *head]


def turn_sign(centre: complex, size: float, sense: int, *, tag: str = "") -> list[Item]:
    """Return the small sign of a sense of rotation for a table (знак направления вращения).

    ``size`` is the diameter, mm; +1 counter-clockwise, -1 clockwise. Most of a circle,
    open on the right, with a head in the opening.
    """
    return turn_arrow(
        centre,
        size / 2,
        sense,
        middle=180.0,
        sweep=290.0,
        length=0.6 * size,
        width=0.46 * size,
        tag=tag,
    )


def angle_of(direction: complex) -> float:
    """Return the angle of a direction, degrees from +x, counter-clockwise (-180..180]."""
    return degrees(cmath.phase(direction))


def arc_points(arc: Arc, *, step: float = 0.25) -> list[complex]:
    """Return points along an arc, ``step`` radians apart at most."""
    turn = sweep(arc)
    count = max(2, ceil(turn / step))
    angles = (arc.start + turn * k / count for k in range(count + 1))
    return [arc.centre + cmath.rect(arc.radius, angle) for angle in angles]
