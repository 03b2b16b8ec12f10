"""Diagrams over the positions of a mechanism, and polar diagrams (годограф)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from enum import Enum
from itertools import pairwise
from math import ceil, floor

import numpy as np
from msgspec import Struct

from planmethod.construct.scale import series_near
from planmethod.note.numbers import Notation, trimmed
from planmethod.render.ink.drawing import Arc, Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.labels.label_column import label_merged_letters, merge_letters
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import straight_arrow
from planmethod.solved.reading import Complexes

AXIS = "diagram axis"
CURVE = "diagram curve"
"""Tags of the axes, and of the curves (with the curve's letter)."""

_EXTENSION = 8.0  # mm: extension of an axis beyond the curves
_TICK = 1.2  # mm: half of a tick
_NUMBER_SPACING = 11.0  # mm: between the numbers of the axis of ordinates
_RAY_NUMBER_SPACING = 18.0  # mm: the same if rays end on it
_AXIS_CLEARANCE = 25.0  # mm: nearer to the axis of ordinates curves avoid their letters
_NUMBERS_CLEARANCE = 8.0  # mm: a curve below this has its letter above it
_DASHED = 20.0  # mm: shorter parts of a curve show no dashes
_DOT = 0.7  # mm: a position that is a part of a curve alone
_MARK = 1.3  # mm: half of a mark


class Mark(Enum):
    """Sign of a separately found point (метка точки)."""

    RING = "ring"
    CROSS = "cross"


class Curve(Struct, frozen=True):
    """Curve of a diagram: its letter (rich text), unbroken parts, mm, and its pen."""

    symbol: str
    parts: tuple[tuple[complex, ...], ...]
    pen: Pen = Pen.MAIN


class Ordinates(Struct, frozen=True):
    """Axis of ordinates: its name at the arrow, its scale, units per mm, and its notation."""

    name: str
    per_mm: float
    notation: Notation


class Abscissae(Struct, frozen=True):
    """Axis of abscissae: its name at the arrow, the drawn positions (mm) and their numbers.

    It extends ``extension`` the curves, mm.
    """

    name: str
    at: tuple[float, ...]
    numbers: tuple[str, ...]
    extension: float = _EXTENSION


class Diagram(Struct, frozen=True):
    """Curves over their axes (диаграмма).

    Attributes
    ----------
    marks : iterable of (Mark, complex)
        Separately found points.
    construction : sequence of Item
        Lines of the construction of the diagram.
    labels : sequence of Label
        Letters of a pole and its rays, which take the left of the axis of ordinates: its numbers
        are then fewer, in free places.
    """

    x_axis: Abscissae
    y_axis: Ordinates
    curves: Sequence[Curve]
    marks: Iterable[tuple[Mark, complex]] = ()
    construction: Sequence[Item] = ()
    labels: Sequence[Label] = ()


def mark_items(mark: Mark, at: complex) -> list[Item]:
    """Return the sign of a found point."""
    if mark is Mark.RING:
        return [Arc(at, _MARK, pen=Pen.THIN, tag=f"mark {mark.value}")]
    reach = _MARK * (1 + 1j) * 0.9
    tag = f"mark {mark.value}"
    return [
        Stroke((at - reach, at + reach), Pen.THIN, tag=tag),
        Stroke((at - reach.conjugate(), at + reach.conjugate()), Pen.THIN, tag=tag),
    ]


def diagram_picture(diagram: Diagram, *, letter_height: float, name: str) -> Picture:
    """Return a diagram, the crossing of its axes at the origin.

    Parameters
    ----------
    letter_height : float, mm
        Height of the letters; the numbers are a size smaller, 2.5 mm at least.
    name : str
        Prefix of the names of the diagram's labels, for the lint.
    """
    x_axis, y_axis, curves = diagram.x_axis, diagram.y_axis, diagram.curves
    labels = diagram.labels
    places = [place for curve in curves for part in curve.parts for place in part]
    heights = [0.0, *(place.imag for place in places)]
    low, high = min(heights), max(heights)
    far = max([*x_axis.at, *(place.real for place in places)])
    size = max(2.5, 0.7 * letter_height)
    items = [*_axes(x_axis, y_axis, (low, high, far), letter_height), *diagram.construction]
    ordinates = _ordinates(
        y_axis, low, high, spacing=_RAY_NUMBER_SPACING if labels else _NUMBER_SPACING
    )
    for y, number in ordinates:
        items.append(Stroke((complex(-_TICK, y), complex(_TICK, y)), Pen.THIN, tag=AXIS))
        if not labels:
            text = typeset(number, size)
            items += text.at(complex(-_TICK - 1.2 - text.width, y - size / 2))
    for x in x_axis.at:
        items.append(Stroke((complex(x, -_TICK), complex(x, _TICK)), Pen.THIN, tag=AXIS))
    for curve in curves:
        items += _curve_items(curve)
    for mark, at in diagram.marks:
        items += mark_items(mark, at)
    every = _every(x_axis.at, 2.0 * size)
    numbers = [
        Label(
            typeset(number, size),
            complex(x, 0.0),
            prefer=-1j if _height(curves, x) >= 0 else 1j,
            gap=1.6,
            name=f"{name}: position {k}",
        )
        for k, (x, number) in enumerate(zip(x_axis.at, x_axis.numbers, strict=True))
        if number and k % every == 0
    ]
    values = [
        Label(typeset(number, size), 1j * y, prefer=1 + 0j, gap=1.6, name=f"{name}: value {number}",
              style=BUSY)
        for y, number in (ordinates if labels else ())
    ]  # fmt: skip
    return lettered(items, [*numbers, *values, *labels, *_letters(curves, letter_height, name)])


def _every(at: Sequence[float], min_gap: float) -> int:
    """Return the step of numbered positions with gaps of at least ``min_gap`` mm."""
    gaps = [abs(end - start) for start, end in pairwise(sorted(at)) if end != start]
    return max(1, ceil(min_gap / min(gaps, default=min_gap) - 1e-9))


def _axes(
    x_axis: Abscissae, y_axis: Ordinates, reach: tuple[float, float, float], height: float
) -> list[Item]:
    """Return both axes with arrows and names, extended beyond the curves.

    ``reach`` is the lowest and the highest ordinate and the farthest abscissa, mm.
    """
    low, high, far = reach
    # If all curves are below the axis of abscissae, the upper arrow keeps clear of its numbers.
    right, top = far + x_axis.extension, max(high + _EXTENSION, 3.0 * height)
    items: list[Item] = [
        *straight_arrow(0j, complex(right), tag=AXIS),
        *straight_arrow(1j * low, 1j * top, tag=AXIS),
    ]
    name = typeset(x_axis.name, height)
    items += name.at(complex(right - name.width, name.descent + 2.5))
    return [*items, *typeset(y_axis.name, height).at(complex(2.5, top - height))]


def _ordinates(
    y_axis: Ordinates, low: float, high: float, *, spacing: float
) -> list[tuple[float, str]]:
    """Return heights of round numbers on the axis of ordinates, without zero."""
    step = series_near(spacing * y_axis.per_mm, up=True)
    first, last = low * y_axis.per_mm / step, high * y_axis.per_mm / step
    return [
        (k * step / y_axis.per_mm, y_axis.notation.number(trimmed(k * step, 4)))
        for k in range(ceil(first - 1e-9), floor(last + 1e-9) + 1)
        if k
    ]


def _curve_items(curve: Curve) -> list[Item]:
    """Return the parts of a curve; thin vertical lines where it jumps."""
    tag = f"{CURVE} {curve.symbol}"
    items: list[Item] = []
    for part in curve.parts:
        length = sum(abs(end - start) for start, end in pairwise(part))
        if length < _DOT:
            items.append(Disc(part[0], _DOT, Ink.BLACK, tag))
        else:
            # A part too short for dashes is drawn solid.
            pen = curve.pen if length > _DASHED or curve.pen is Pen.MAIN else Pen.THIN
            items.append(Stroke(part, pen, tag=tag))
    for before, after in zip(curve.parts, curve.parts[1:], strict=False):
        if abs(after[0].real - before[-1].real) < 0.1 < abs(after[0] - before[-1]):
            items.append(Stroke((before[-1], after[0]), Pen.THIN, tag=tag))
    return items


def _height(curves: Sequence[Curve], x: float) -> float:
    """Return the sum of the curves' heights near an abscissa."""
    total = 0.0
    for curve in curves:
        places = [place for part in curve.parts for place in part]
        if places:
            total += min(places, key=lambda place: abs(place.real - x)).imag
    return total


def _letters(curves: Sequence[Curve], height: float, name: str) -> list[Label]:
    """Return the letters of the curves, each where its curve is furthest from the others."""
    labels = []
    for k, curve in enumerate(curves):
        places = np.array([place for part in curve.parts for place in part])
        if not len(places) or not curve.symbol:
            continue
        others = np.array(
            [place for other in curves if other is not curve for p in other.parts for place in p],
            dtype=complex,
        )
        off = others - places[:, None]
        gaps = np.where(np.abs(off.real) < 6.0, np.abs(off.imag), np.inf).min(1, initial=np.inf)
        near_axis = np.maximum(
            0.0, _AXIS_CLEARANCE - places.real
        )  # the axis has its own name there
        alone = np.where(gaps < np.inf, gaps, 99.0) + 0.2 * np.abs(places.imag) - near_axis
        at = complex(places[np.argmax(alone)])
        beside = others[np.abs(others.real - at.real) < 6.0].imag
        above, below = np.sum(beside < at.imag), np.sum(beside >= at.imag)
        # The numbers of the positions are along the axis.
        up = (
            above >= below if len(others) else at.imag >= 0
        ) or 0.0 <= at.imag < _NUMBERS_CLEARANCE
        labels.append(
            Label(
                typeset(curve.symbol, height),
                at,
                prefer=1j if up else -1j,
                gap=1.5,
                priority=1,
                name=f"{name}: curve {k}",
                style=BUSY,
            )
        )
    return labels


HODOGRAPH = "hodograph"
"""Tag of the curve; of the pole it is `POLE`."""

POLE = "hodograph pole"

MAX_NUMBERS = 24
"""Largest number of numbered positions: with more, every second or third has a number."""

_POLAR_EXTENSION = 7.0  # mm: extension of the axes beyond the curve
_POLAR_DASHED = 10.0  # mm: a shorter line shows no dashes
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
    items = _polar_axes(np.concatenate([[0j], ends, *parts]))
    for part in (part for part in parts if len(part) > 1):
        items.append(Stroke(tuple(map(complex, part)), Pen.MAIN, tag=f"{HODOGRAPH} {name}"))
    for before, after in pairwise(parts):
        if abs(after[0] - before[-1]) > _MIN_VECTOR:
            jump = (complex(before[-1]), complex(after[0]))
            pen = Pen.HIDDEN if abs(jump[1] - jump[0]) > _POLAR_DASHED else Pen.THIN
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


def _polar_axes(places: Complexes) -> list[Item]:
    """Return the axes through the pole."""
    left, right = (
        float(places.real.min()) - _POLAR_EXTENSION,
        float(places.real.max()) + _POLAR_EXTENSION,
    )
    low, high = (
        float(places.imag.min()) - _POLAR_EXTENSION,
        float(places.imag.max()) + _POLAR_EXTENSION,
    )
    items: list[Item] = []
    for start, end in ((complex(left, 0), complex(right, 0)), (complex(0, low), complex(0, high))):
        items += straight_arrow(start, end, tag="hodograph axis")
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
