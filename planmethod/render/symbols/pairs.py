"""Lower pairs (низшие кинематические пары): revolutes, sliders, stones."""

from __future__ import annotations

import cmath
from math import pi, radians

from planmethod.render.ink.drawing import Arc, Disc, Fill, Ink, Item, Pen, Stroke
from planmethod.render.ink.style import PENS
from planmethod.render.symbols.sizes import SIZES, unit

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
    *,
    side: int = -1,
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
        Direction of the link.
    side : int
        Side of the half-circle: +1 left of the direction, -1 right.
    tag : str
        Tag of the piece of the link that is drawn again.
    """
    turn = unit(direction)
    radius = (SIZES.joint * factor + PENS[pen].width) / 2
    start = cmath.phase(turn * (1 if side > 0 else -1))
    around = [at + cmath.rect(radius, start + pi * k / 16) for k in range(17)]
    piece = Stroke((at - turn * radius, at + turn * radius), pen, tag=tag)
    return [Fill(tuple(around), Ink.WHITE), Arc(at, radius, start, start + pi, pen), piece]


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
