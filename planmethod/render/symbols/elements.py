"""Elements of a mechanism as symbols: frame, links, pairs, wheels, cams."""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import cos, pi, radians, sin, tau

from planmethod.render.ink.drawing import Arc, Disc, Fill, Ink, Item, Pen, Stroke
from planmethod.render.ink.pens import pens_in_use
from planmethod.render.symbols.marks import (
    GROUND,
    SIZES,
    axis_line,
    centre_lines,
    hatch,
    pitch_circle,
    unit,
)

SLIDER = "slider"
"""Tag of the outline of a slider."""


def revolute(
    at: complex, *, count: int = 1, factor: float = 1.0, pen: Pen = Pen.MAIN
) -> list[Item]:
    """Return a revolute pair: a circle, white inside (вращательная пара).

    ``count`` is the number of pairs there, one less than the number of links: a joint of three
    links (двойной шарнир) has one thin ring about it, and one more for each further link.
    """
    radius = SIZES.joint / 2 * factor
    rings = [radius + SIZES.ring * factor * k for k in range(count - 1, 0, -1)]
    items: list[Item] = []
    for ring in rings:
        items += [Disc(at, ring), Arc(at, ring, pen=Pen.THIN)]
    return [*items, Disc(at, radius), Arc(at, radius, pen=pen)]


def revolute_on(
    at: complex,
    direction: complex,
    second: complex | None = None,
    *,
    factor: float = 1.0,
    pen: Pen = Pen.MAIN,
    tag: str = "",
) -> list[Item]:
    """Return a revolute pair on the middle of a link that goes on through it (шарнир на звене).

    The link is drawn over the joint in one piece, and half of the circle shows beside it, as wide
    as that of a whole joint; the other link ends at it.

    Parameters
    ----------
    at : complex, mm
        The centre, on the link's line.
    direction : complex
        Direction of the link; the circle shows from here counter-clockwise.
    second : complex, optional
        Direction of the link's other part, if it is bent there. Default: straight on.
    tag : str
        Tag of the piece of the link that is drawn again.
    """
    turn = unit(direction)
    end = -turn if second is None else unit(second)
    radius = (SIZES.joint * factor + pens_in_use().width(pen)) / 2
    start = cmath.phase(turn)
    sweep = cmath.phase(end / turn) % tau
    around = [at + cmath.rect(radius, start + sweep * k / 16) for k in range(17)]
    bent = (at,) if abs(turn + end) > 1e-6 else ()
    piece = Stroke((at + turn * radius, *bent, at + end * radius), pen, tag=tag)
    return [
        Fill((*around, *bent), Ink.WHITE),
        Arc(at, radius, start, start + sweep, pen),
        piece,
    ]


def mobile_revolute(at: complex, name: str, *, opening: complex = 1 + 0j) -> list[Item]:
    """Return a turning pair with more freedoms, seen along the hinge's axis.

    ``2c``: a point in the circle, the axis along which it also slides (цилиндрическая пара);
    ``3s``: the ball in a cup that is open to one side (сферическая пара); any other is a hinge.
    """
    radius = SIZES.joint / 2
    if name == "2c":
        return [Disc(at, 1.25 * radius), Arc(at, 1.25 * radius), Disc(at, 0.4, Ink.BLACK)]
    if name == "3s":
        cup = 1.75 * radius
        free = cmath.phase(unit(opening))
        start, end = free + radians(55), free + radians(305)
        return [*revolute(at), Arc(at, cup, start, end)]
    return revolute(at)


def mobile_slider(
    at: complex, name: str, *, angle: float = 0.0, factor: float = 1.0, ground: bool = False
) -> list[Item]:
    """Return a sliding pair with more freedoms.

    ``2c``: the round sleeve on a round rod, about whose line it also turns (цилиндрическая пара);
    ``3pl``: a plate between two planes, which are seen edge-on (плоскостная пара); any other is a
    slider. ``ground``: it is on the frame, whose line is the second plane.
    """
    turn = cmath.exp(1j * radians(angle))
    half, tall = SIZES.slider_length / 2 * factor, SIZES.slider_width / 2 * factor
    items = slider(at, angle=angle, factor=factor)
    if name == "2c":
        bulge = 0.35 * tall
        for end in (-1, 1):  # the near half of either end's rim shows that it is round
            ring = [
                at + turn * complex(end * (half - 2.2) + bulge * cmath.cos(t).real,
                                    tall * cmath.sin(t).real)
                for t in [pi * (k / 12 - 0.5) for k in range(13)]
            ]  # fmt: skip
            items.append(Stroke(tuple(ring), Pen.THIN, smooth=True))
    elif name == "3pl":
        for side in (1,) if ground else (-1, 1):
            edge = side * (tall + 1.4)
            ends = (complex(-half - 2.0, edge), complex(half + 2.0, edge))
            items.append(Stroke(tuple(at + turn * end for end in ends)))
    return items


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
    return [Fill(corners, Ink.WHITE), Stroke(corners, pen, closed=True, tag=SLIDER)]


def offset_slider(middle: complex, pin: complex) -> list[Item]:
    """Return a slider whose pin is off its horizontal axis (ползун с внеосным шарниром).

    ``middle`` is the middle of the slider on its axis, ``pin`` the joint, mm; the arm between them
    is rigid with the slider.
    """
    return [*slider(middle), Stroke((middle, pin)), *revolute(pin)]


def sliding_block_size(*, inside: bool = False) -> tuple[float, float]:
    """Return length and width of a stone before ``factor``, mm; ``inside`` of another slider."""
    share = (0.5, 0.6) if inside else (0.85, 0.75)
    return share[0] * SIZES.slider_length, share[1] * SIZES.slider_width


def sliding_block(
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
    length, width = sliding_block_size(inside=inside)
    turn = cmath.exp(1j * radians(angle)) * length / 2 * factor
    items = slider(at, angle=angle, length=length, width=width, factor=factor, pen=pen)
    items.append(Stroke((at - turn, at + turn), pen))
    return items + revolute(at, factor=factor, pen=pen) if pin else items


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
    The strokes are at 45° to the line and lean to the right of the paper if possible, have a fixed
    step and are clipped at the ends of the line; both ends look alike::

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
    # A stroke goes from s on the line back to s - depth; s may exceed the end by as much.
    count = max(1, int((length - depth) / step + 1e-9) + 1)
    first = (length + depth - (count - 1) * step) / 2
    for k in range(count):
        s = first + k * step
        top, bottom = min(s, length), max(s - depth, 0.0)
        ends = (start + along * t + across * (s - t) for t in (top, bottom))
        items.append(Stroke(tuple(ends), Pen.HATCH, tag=GROUND))
    return items


def _leaning(direction: complex) -> float:
    """Return a measure of how close a direction, either way, is to 45° to the right."""
    return abs((unit(direction) * (1 - 1j)).real)


def fixed_pivot(
    at: complex, *, direction: complex = -1j, factor: float = 1.0, pen: Pen = Pen.MAIN
) -> list[Item]:
    """Return a pivot on the frame: joint, support, hatched base (шарнирно-неподвижная опора).

    ``direction`` points from the pivot to the base line, down by default.
    """
    return fixed_pivots([at], direction=direction, factor=factor, pen=pen)


def fixed_pivots(
    places: Sequence[complex],
    *,
    direction: complex = -1j,
    joints: bool = True,
    factor: float = 1.0,
    pen: Pen = Pen.MAIN,
) -> list[Item]:
    """Return pivots side by side on one hatched base (опоры на общем основании).

    The base is as far below the lowest pivot as below a single one; the feet of two supports do not
    touch, so supports close to each other are narrower. With ``joints=False`` the caller draws the
    circles over the links.
    """
    down = unit(direction)
    along = down * 1j
    half = support_half_width(places, direction=down, factor=factor)
    level = max((p * down.conjugate()).real for p in places) + SIZES.support_height * factor
    items: list[Item] = []
    feet = [p + down * (level - (p * down.conjugate()).real) for p in places]
    for place, foot in zip(places, feet, strict=True):
        items.append(Stroke((foot - along * half, place, foot + along * half), pen))
    ways = [(foot * along.conjugate()).real for foot in feet]
    first, last = feet[ways.index(min(ways))], feet[ways.index(max(ways))]
    base = SIZES.base / 2 * factor
    items += ground_line(first - along * base, last + along * base, factor=factor, pen=pen)
    for place in places if joints else ():
        items += revolute(place, factor=factor, pen=pen)
    return items


def support_half_width(
    places: Iterable[complex], *, direction: complex = -1j, factor: float = 1.0
) -> float:
    """Return half the width of the supports of pivots on one base, mm.

    It is that of a single support if there is space, or leaves 1 mm between two feet.
    """
    along = unit(direction) * 1j
    ways = sorted((p * along.conjugate()).real for p in places)
    apart = [b - a for a, b in pairwise(ways)]
    half = SIZES.support_width / 2 * factor
    return max(0.0, min([half, *((gap - factor) / 2 for gap in apart)]))


def guide_line(
    at: complex,
    *,
    angle: float = 0.0,
    before: float = 20.0,
    after: float = 20.0,
    side: int = -1,
    factor: float = 1.0,
) -> list[Item]:
    """Return a fixed guide beside a slider: a line hatched on its far side (направляющая).

    Parameters
    ----------
    at : complex, mm
        Pin of the slider.
    angle : float, degrees
        Direction of the guide.
    before, after : float, mm
        Extent of the line from the pin against and along the direction (not scaled).
    side : int
        Side of the pin on which the line lies, half a slider's width from it: +1 left of the
        direction, -1 right.
    """
    turn = cmath.exp(1j * radians(angle))
    foot = at + turn * (1j if side > 0 else -1j) * (SIZES.slider_width / 2) * factor
    return ground_line(foot - turn * before, foot + turn * after, side=side, factor=factor)


def guide_plates(
    at: complex,
    *,
    angle: float = 0.0,
    length: float = SIZES.base,
    width: float = SIZES.slider_width,
    sides: Sequence[int] = (1, -1),
    factor: float = 1.0,
    pen: Pen = Pen.MAIN,
) -> list[Item]:
    """Return short hatched plates beside a bar or slider (направляющая).

    ``sides``: +1 a plate on the left of the direction, -1 on the right; on both by default.
    """
    turn, half = cmath.exp(1j * radians(angle)), length / 2 * factor
    items: list[Item] = []
    for side in sides:
        foot = at + turn * (1j if side > 0 else -1j) * (width / 2) * factor
        items += ground_line(
            foot - turn * half, foot + turn * half, side=side, factor=factor, pen=pen
        )
    return items


def bearing(at: complex) -> list[Item]:
    """Return the bearing of a level shaft in the frame (подшипник вала); the shaft is a `link`."""
    return guide_plates(at, length=SIZES.bearing, width=SIZES.shaft)


def link(*points: complex, pen: Pen = Pen.MAIN, tag: str = "") -> list[Item]:
    """Return a link as a line through points (звено)."""
    return [Stroke(points, pen, tag=tag)]


def rigid_corner(
    vertex: complex, first: complex, second: complex, *, factor: float = 1.0, radius: float = 0.0
) -> list[Item]:
    """Return the mark of a rigid joint: a filled triangle in the angle (жёсткое соединение).

    ``first`` and ``second`` are points of the two arms; arms in one line need no mark. Beyond a
    joint of ``radius`` mm in the vertex the mark is as deep as it needs to be seen, or absent if
    that is too long for an obtuse angle or for the arms.
    """
    one, two = unit(first - vertex), unit(second - vertex)
    if abs((one.conjugate() * two).imag) < sin(radians(4)):
        return []
    size = SIZES.corner * factor
    room = min(abs(first - vertex), abs(second - vertex)) / 2
    if radius:
        least = (radius + 1.5 * factor) / (abs(one + two) / 2)
        room = min(2 * size, 1.6 * room)
        if least > room:
            return []
        size = max(size, least)
    size = min(size, room)
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


PITCH_POINT = 0.8
"""Radius of the dot of a pitch point, mm."""

RACK = 5.0
"""Height of a rack, mm."""


# From the front -----------------------------------------------------------------------------------


def wheel_front(centre: complex, radius: float, *, touch: complex | None = None) -> list[Item]:
    """Return a wheel from the front: pitch circle and centre lines (колесо, вид спереди).

    ``radius`` is that of the pitch circle, ``touch`` the pitch point, mm. The joint or support in
    the centre is drawn after it.
    """
    return [*pitch_circle(centre, radius, touch=touch), *centre_lines(centre, radius)]


def mesh_front(
    first: complex, radius: float, second: complex, *, internal: bool = False
) -> list[Item]:
    """Return two wheels in mesh from the front (зубчатое зацепление, вид спереди).

    Parameters
    ----------
    first, second : complex, mm
        The centres; for ``internal`` the second is that of the ring (колесо с внутренними зубьями).
    radius : float, mm
        Pitch radius of the first; that of the second follows, since the circles touch.

    Notes
    -----
    One line goes through both centres. A ring has its rim outside the pitch circle, a main line; a
    dot marks the pitch point.
    """
    apart = abs(second - first)
    way = unit(second - first)
    point = first - way * radius if internal else first + way * radius
    other = apart + radius if internal else apart - radius
    rim = other + SIZES.slider_width / 2 if internal else other
    items = [
        *pitch_circle(first, radius, touch=point),
        *pitch_circle(second, other, touch=point),
        *centre_lines(first, radius, directions=(way * 1j,)),
        *centre_lines(second, rim, directions=(way * 1j,)),
    ]
    ends = [second - way * (rim + 3.0), second + way * (rim + 3.0)]
    if internal:
        items.append(Arc(second, rim))
    else:
        ends[0] = first - way * (radius + 3.0)
    items += axis_line(*ends, first, second)
    return [*items, Disc(point, PITCH_POINT, Ink.BLACK)]


def rack_front(start: complex, end: complex) -> list[Item]:
    """Return a rack: its pitch line, dash-dot, and the outline of its back (рейка).

    Its body is on the right of the way from ``start`` to ``end``; a wheel touches the pitch line.
    """
    down = unit(end - start) * -1j * RACK
    teeth, back = down * 0.3, down
    body = (start + teeth, start + back, end + back, end + teeth)
    over = unit(end - start) * 3.0
    return [
        Stroke(body, closed=True),
        *axis_line(start - over, end + over, (start + end) / 2),
    ]


# From the side ------------------------------------------------------------------------------------


def wheel_profile(
    centre: complex,
    radius: float,
    *,
    sides: tuple[int, ...] = (1, -1),
    loose: bool = False,
    bore: float = 0.0,
    tag: str = "",
) -> list[Item]:
    """Return a wheel from the side: its disc and a cross-bar at the teeth (колесо, вид сбоку).

    Parameters
    ----------
    centre : complex, mm
        On the axis.
    radius : float, mm
        Pitch radius; the cross-bar stands half a mesh inside it.
    sides : tuple of int
        Which halves are drawn: +1 above the axis, -1 below it.
    loose : bool
        The wheel rotates on its shaft: a hub of two cross-bars with the shaft between them (колесо
        на подшипнике). Otherwise it is fixed to the shaft.
    bore : float, mm
        Half the width of the hollow shaft that its disc begins on.
    """
    tooth = SIZES.teeth / 2
    rim = radius - SIZES.mesh / 2
    root = SIZES.mesh / 2 if loose else bore
    items: list[Item] = []
    for way in sides:
        top, low = centre + 1j * way * rim, centre + 1j * way * root
        items.append(Stroke((low, top), tag=tag))
        items.append(Stroke((top - tooth, top + tooth), tag=tag))
        if loose:
            items.append(Stroke((low - tooth, low + tooth), tag=tag))
    return items


def ring_profile(
    centre: complex, radius: float, *, support: float = 6.0, side: int = 1
) -> list[Item]:
    """Return the upper half of a fixed wheel with inner teeth, from the side (неподвижное колесо).

    Its cross-bar stands half a mesh outside the pitch radius; from there a stem of ``support`` mm
    goes to the hatched frame. ``side`` -1: the lower half.
    """
    tooth, base = SIZES.teeth / 2, SIZES.base / 2
    top = centre + 1j * side * (radius + SIZES.mesh / 2)
    foot = top + 1j * side * support
    return [
        Stroke((top - tooth, top + tooth)),
        Stroke((top, foot)),
        *ground_line(foot - base, foot + base, side=side),
    ]


def bell_profile(
    centre: complex,
    radius: float,
    *,
    web: float,
    side: int = 1,
    bore: float = 0.0,
    tag: str = "",
) -> list[Item]:
    """Return the upper half of a wheel with inner teeth that turns (колесо с внутренними зубьями).

    Its rim stands half a mesh outside the pitch radius and goes ``web`` mm beside the mesh
    (negative: to the left) to the web, which comes down to the axis, or to a hollow shaft of half
    the width ``bore``. ``side`` -1: the lower half.
    """
    tooth = SIZES.teeth / 2 * (-1 if web > 0 else 1)
    out, beside = 1j * side * (radius + SIZES.mesh / 2), centre + web
    return [Stroke((centre + out + tooth, beside + out, beside + 1j * side * bore), tag=tag)]


def carrier_profile(pin: complex, centre: complex, *, reach: float, tag: str = "") -> list[Item]:
    """Return a carrier from the side: the planet's pin and an arm down to the axis (водило).

    ``pin`` is the middle of the planet, ``centre`` the point of the main axis below it; the arm
    stands ``reach`` mm beside the planet (negative: on its left). The shaft continues from the foot
    of the arm as a `link` of the caller.
    """
    along = unit(pin - centre) * (-1j if ((pin - centre) / 1j).real >= 0 else 1j)
    short = along * (SIZES.teeth / 2 + 1.5) * (1 if reach > 0 else -1)
    return [Stroke((pin - short, pin + along * reach, centre + along * reach), tag=tag)]


ROLLER = 3.2
"""Radius of a roller, mm."""


RISE = 1.6
"""Angle of the rise of a cam on either side of its nose, radians."""


def cam_radius(angle: float, *, base: float, lift: float) -> float:
    """Return the radius of a cam's outline at an angle from its nose, mm.

    ``base`` is the least radius and ``lift`` the rise above it, mm, by the cosine law.
    """
    off = abs((angle + pi) % tau - pi)
    return base + (lift * (1 + cos(pi * off / RISE)) / 2 if off < RISE else 0.0)


def cam(
    centre: complex, *, base: float = 8.0, lift: float = 6.0, nose: float = 1.0, tag: str = ""
) -> list[Item]:
    """Return a disc cam: its outline (кулачок); ``nose`` is its direction, radians."""
    angles = [tau * k / 120 for k in range(120)]
    outline = tuple(
        centre + cmath.rect(cam_radius(a - nose, base=base, lift=lift), a) for a in angles
    )
    return [Stroke(outline, closed=True, tag=tag)]


def roller(at: complex) -> list[Item]:
    """Return a roller on its pin, white inside (ролик)."""
    return [Disc(at, ROLLER), Arc(at, ROLLER), *revolute(at, factor=0.7, pen=Pen.THIN)]


def rest_on_cam(
    centre: complex, direction: complex, *, base: float, lift: float, nose: float
) -> complex:
    """Return the centre of a roller that rests on a cam, descending along ``direction``, mm.

    The follower's line goes through the cam's centre; the roller touches the outline without
    running into it.
    """
    up = direction / abs(direction)
    points = [
        cmath.rect(cam_radius(a - nose, base=base, lift=lift), a) / up
        for a in (tau * k / 720 for k in range(720))
    ]
    touching: list[float] = [
        p.real + (ROLLER**2 - p.imag**2) ** 0.5
        for p in points
        if abs(p.imag) < ROLLER and p.real > 0
    ]
    return centre + up * max(touching)
