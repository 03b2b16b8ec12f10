"""The frame (стойка): hatched lines, supports of pivots, guides, bearings of shafts."""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import pi, radians, sin

from planmethod.render.ink.drawing import Item, Pen, Stroke
from planmethod.render.symbols.hatching import GROUND
from planmethod.render.symbols.pairs import revolute
from planmethod.render.symbols.sizes import SIZES, unit


def ground_line(
    start: complex, end: complex, *, side: int = -1, factor: float = 1.0, pen: Pen = Pen.MAIN
) -> list[Item]:
    """Return a line of the frame with hatching along it (неподвижное звено).

    Parameters
    ----------
    start, end : complex, mm
    side : int
        +1: hatching on the left of the way from ``start`` to ``end``; -1: on the right.

    Notes ----- The strokes are at 45° to the line and lean to the right of the paper if possible,
    have a fixed step and are clipped at the ends of the line; both ends look alike::

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
        Extent of the line from the pin against and along the direction (not scaled).
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
    sides: Sequence[int] = (1, -1),
    factor: float = 1.0,
    pen: Pen = Pen.MAIN,
) -> list[Item]:
    """Return short hatched plates beside a bar or slider (направляющая).

    ``sides``: +1 a plate on the left of the direction, -1 on the right; on both by default.
    """
    half = length / 2 * factor
    items: list[Item] = []
    for side in sides:
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


def bearing(at: complex) -> list[Item]:
    """Return the bearing of a level shaft in the frame (подшипник вала); the shaft is a `link`."""
    return guide_plates(at, length=SIZES.bearing, width=SIZES.shaft)
