"""Marks of a scheme: arrows, axes, breaks, dimensions, hatching, and their sizes."""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import asin, ceil, degrees, pi, radians, sin, tau
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from planmethod.render.ink.drawing import (
    Arc,
    Disc,
    Fill,
    Ink,
    Item,
    Pen,
    Stroke,
    dash_spans,
)
from planmethod.render.ink.pens import ARROW, PENS, pens_in_use
from planmethod.render.ink.typeset import arc_points

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry


class SymbolSizes(Struct, frozen=True):
    """Sizes of the symbols, mm, before ``factor``."""

    joint: float = 3.0  # diameter of a revolute pair
    centre: float = 1.2  # radius of a centre of mass
    ring: float = 1.3  # from the joint to the ring of a joint of three links
    support_height: float = 9.0  # from the pivot to its base line
    support_width: float = 9.0  # between the feet of the support
    base: float = 14.0  # length of the base line
    hatch_step: float = 2.2
    hatch_stroke: float = 3.0
    slider_length: float = 14.0
    slider_width: float = 8.0
    corner: float = 5.0  # leg of the mark of a rigid joint
    teeth: float = 6.0  # cross-bar of a wheel seen from the side
    mesh: float = 2.0  # between the cross-bars of two wheels in mesh
    bearing: float = 7.0  # length of a plate of a shaft's bearing
    shaft: float = 3.2  # between the two plates of a bearing


SIZES = SymbolSizes()


def unit(direction: complex) -> complex:
    """Return the direction with length 1; +x for a vector too short to have one."""
    length = abs(direction)
    return direction / length if length > 1e-12 else 1 + 0j


def angle_of(direction: complex) -> float:
    """Return the angle of a direction, degrees from +x, counter-clockwise (-180..180]."""
    return degrees(cmath.phase(direction))


FORCE, PLAN_FORCE = "force", "plan-force"
"""First words of the tags of the arrows of forces; the second is the letter. Those of plans are to
scale."""

_SWALLOWED = 1.5  # widths of a line that its head has at least


def arrowhead(
    tip: complex,
    direction: complex,
    *,
    length: float | None = None,
    pen: Pen = Pen.THIN,
    tag: str = "",
) -> list[Item]:
    """Return a swept arrowhead with its tip at ``tip``, pointing along ``direction`` (стрелка).

    There is one shape: width and notch follow the length as `ARROW` has them. The default length is
    that of a dimension, an axis or a sense; ``pen`` is that of its line.
    """
    along = unit(direction) * (pens_in_use().mark if length is None else length)
    side = along * 1j * ARROW.width / 2
    notch = tip - along * (1.0 - ARROW.notch)
    return [Fill((tip, tip - along + side, notch, tip - along - side), Ink.BLACK, tag, pen)]


def vector_arrow(
    tail: complex,
    head: complex,
    *,
    pen: Pen = Pen.RESULTANT,
    tag: str = "",
) -> list[Item]:
    """Return a vector of a plan: a line that ends in an arrowhead (вектор).

    The head is in proportion to the pen, and at most a third of the vector. The line stops inside
    it, so that its square end does not blunt the tip. A vector below 0.3 mm is not drawn.
    """
    span, pens = abs(head - tail), pens_in_use()
    if span < 0.3:
        return []
    size = pens.head(pen, span)
    stop = head - unit(head - tail) * size * (1.0 - ARROW.notch / 2)
    # A thick line would swallow a small head.
    shaft = pen if size * ARROW.width > _SWALLOWED * pens.width(pen) else Pen.THIN
    return [
        Stroke((tail, stop), shaft, tag=tag),
        *arrowhead(head, head - tail, length=size, pen=pen, tag=tag),
    ]


def straight_arrow(start: complex, end: complex, *, tag: str = "") -> list[Item]:
    """Return the thin arrow of a sense of motion (стрелка движения)."""
    size = min(pens_in_use().mark, abs(end - start) / 2)
    stop = end - unit(end - start) * size * (1.0 - ARROW.notch / 2)
    return [
        Stroke((start, stop), Pen.THIN, tag=tag),
        *arrowhead(end, end - start, length=size, tag=tag),
    ]


def turn_arrow(
    centre: complex,
    radius: float,
    sense: int,
    *,
    middle: float = 45.0,
    sweep: float = 110.0,
    pen: Pen = Pen.THIN,
    length: float | None = None,
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
    size = min(pens_in_use().mark if length is None else length, radius)
    chord = 2 * asin(min(1.0, size / (2 * radius)))
    back_angle = tip_angle - chord * (1 if sense > 0 else -1)
    back = centre + cmath.rect(radius, back_angle)
    stop_angle = tip_angle - 0.8 * chord * (1 if sense > 0 else -1)
    tail_angle = aim - half * (1 if sense > 0 else -1)
    start, end = (tail_angle, stop_angle) if sense > 0 else (stop_angle, tail_angle)
    shaft = Arc(centre, radius, start, end, pen, tag)
    return [shaft, *arrowhead(tip, tip - back, length=size, pen=pen, tag=tag)]


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
    return straight_arrow(start, end)


SMALL_CIRCLE = 12.0
"""Diameter below which centre lines are solid (GOST 2.303), mm."""

_EXTENSIONS = (3.0, 2.5, 3.5, 2.0, 4.0, 4.5, 5.0)
"""Extensions of centre lines beyond their circle, mm, the best first: 2 to 5 [mem]."""

_SURE = 1.0  # mm: least distance of a crossing from the ends of its stroke


def axis_line(start: complex, end: complex, *through: complex, tag: str = "") -> list[Item]:
    """Return a dash-dot line that others cross at ``through`` in a stroke (осевая линия).

    Where the pattern has a gap in one of these places, the line is drawn in parts that begin and
    end there. A line too short for two strokes is solid and thin.
    """
    length = abs(end - start)
    if not _shows(length):
        return [Stroke((start, end), Pen.THIN, tag=tag)]
    if all(_in_a_stroke(length, abs(place - start)) for place in through):
        return [Stroke((start, end), Pen.AXIS, tag=tag)]
    stops = sorted((start, *through, end), key=lambda place: abs(place - start))
    return [
        Stroke(pair, Pen.AXIS if _shows(abs(pair[1] - pair[0])) else Pen.THIN, tag=tag)
        for pair in pairwise(stops)
        if abs(pair[1] - pair[0]) > 1e-6
    ]


def _shows(length: float) -> bool:
    """Return whether a dash-dot line is long enough to look like one."""
    dashes = PENS[Pen.AXIS].dashes
    assert dashes is not None
    return len(dash_spans(length, dashes)) > 1


def _in_a_stroke(length: float, place: float) -> bool:
    dashes = PENS[Pen.AXIS].dashes
    assert dashes is not None
    return any(
        a + _SURE <= place <= b - _SURE
        for a, b in dash_spans(length, dashes)
        if b - a > dashes.dot + 1e-9
    )


def centre_lines(
    centre: complex, radius: float, *, directions: tuple[complex, ...] = (1 + 0j, 1j), tag: str = ""
) -> list[Item]:
    """Return the lines that cross in the centre of a circle (центровые линии).

    They extend 2 to 5 mm beyond it, so that they cross by strokes; those of a circle below 12 mm
    are solid, and so are those of a circle too small for two dash-dot halves.
    """
    items: list[Item] = []
    over = next((x for x in _EXTENSIONS if _in_a_stroke(2 * (radius + x), radius + x)), None)
    if over is None:
        over = next((x for x in _EXTENSIONS if _shows(radius + x)), None)
    is_small = 2 * radius < SMALL_CIRCLE or over is None
    for direction in directions:
        reach = unit(direction) * (radius + (_EXTENSIONS[0] if over is None else over))
        if is_small:
            items.append(Stroke((centre - reach, centre + reach), Pen.THIN, tag=tag))
        else:
            items += axis_line(centre - reach, centre + reach, centre, tag=tag)
    return items


def pitch_circle(
    centre: complex, radius: float, *, touch: complex | None = None, tag: str = ""
) -> list[Item]:
    """Return a dash-dot circle, with a stroke in its middle where it is touched (окружность).

    ``touch`` is the point where another circle or line meets it, mm.
    """
    if 2 * radius < SMALL_CIRCLE:
        return [Arc(centre, radius, pen=Pen.THIN, tag=tag)]
    dashes = PENS[Pen.AXIS].dashes
    assert dashes is not None
    start = 0.0 if touch is None else cmath.phase(touch - centre)
    stroke = dash_spans(tau * radius, dashes, closed=True)[0]
    start -= (stroke[1] - stroke[0]) / 2 / radius
    return [Arc(centre, radius, start, start + tau, Pen.AXIS, tag)]


def wavy_line(start: complex, end: complex, *, wave: float = 6.0, tag: str = "") -> list[Item]:
    """Return a line of break drawn by hand (волнистая линия); ``wave`` is its length, mm.

    The waves differ to imitate a hand, always in the same way.
    """
    length, along = abs(end - start), unit(end - start)
    count = max(1, round(length / wave))
    steps = 12 * count
    points = []
    for k in range(steps + 1):
        t = k / steps
        height = 0.14 * wave * sin(tau * count * t) * (1.0 + 0.35 * sin(5.1 * count * t + 1.0))
        points.append(
            start + along * (length * t + 1j * height * sin(pi * min(1, 8 * t, 8 - 8 * t) / 2))
        )
    return [Stroke(tuple(points), Pen.BREAK, tag=tag)]


def kinked_line(start: complex, end: complex, *, kink: float = 5.0, tag: str = "") -> list[Item]:
    """Return a long line of break, straight with kinks (сплошная тонкая с изломами).

    ``kink`` is the height of a kink, mm; there is one for each 60 mm.
    """
    length, along = abs(end - start), unit(end - start)
    count = max(1, ceil(length / 60.0 - 1e-9))
    points = [start]
    for k in range(count):
        middle = start + along * length * (k + 0.5) / count
        shape = (-kink * 0.35, -kink * 0.15 + 0.5j * kink, kink * 0.15 - 0.5j * kink, kink * 0.35)
        points += [middle + along * z for z in shape]
    return [Stroke((*points, end), Pen.BREAK, tag=tag)]


DIMENSION = "dimension"
"""First word of the tags of a dimension's lines and heads; its letters follow, so that each of a
picture has a tag of its own. The name of its inscription ends with that tag. In a DXF they are one
DIMENSION."""


def dimension_tag(symbol: str) -> str:
    """Return the tag of a dimension by its letters."""
    return f"{DIMENSION} {symbol}"


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
    is_wide = abs(end - start) >= 3 * pens_in_use().mark
    items: list[Item] = [
        Stroke((place + away * gap, place + out + away * _EXTENSION), Pen.THIN, tag=tag)
        for place in (start, end)
    ]
    tail = 0.0 if is_wide else _TAIL
    one, two = start + out, end + out
    items.append(Stroke((one - along * tail, two + along * tail), Pen.THIN, tag=tag))
    outward = -along if is_wide else along
    return [*items, *arrowhead(one, outward, tag=tag), *arrowhead(two, -outward, tag=tag)]


def angle_dimension(
    centre: complex, radius: float, low: float, high: float, *, tag: str = ""
) -> list[Item]:
    """Return the dimension of an angle: an arc with arrowheads, from ``low`` to ``high`` radians.

    The sides of the angle are already drawn. An arc too short for arrowheads has none.
    """
    items: list[Item] = [Arc(centre, radius, low, high, Pen.THIN, tag)]
    head = pens_in_use().mark
    if (high - low) * radius >= 3 * head:
        lean = head / radius / 2  # a head lies along the chord of its own length
        for turn, sense in ((low, -1), (high, 1)):
            tip, way = centre + cmath.rect(radius, turn), cmath.rect(1.0, turn - sense * lean)
            items += arrowhead(tip, way * 1j * sense, tag=tag)
    return items


def radius_dimension(centre: complex, radius: float, out: complex, *, tag: str = "") -> list[Item]:
    """Return the dimension of a radius: a line from the centre with an arrowhead at the circle.

    Its direction is ``out``. The head at a small circle is small, for it to lie inside.
    """
    along = unit(out)
    tip, head = centre + along * radius, min(pens_in_use().mark, 0.6 * radius)
    line = Stroke((centre, tip - along * head / 2), Pen.THIN, tag=tag)
    return [line, *arrowhead(tip, along, length=head, tag=tag)]


GROUND = "ground"
"""Tag of the hatching of the frame."""

WHITE = 0.8
"""White between a hatch stroke and the item that clips it, mm."""

_MIN_STROKE = 1.2  # mm: shorter remainders of a hatch stroke are not drawn


def hatch(
    outline: Sequence[complex],
    *,
    step: float = SIZES.hatch_step,
    obstacles: Iterable[Item] = (),
) -> list[Item]:
    """Return thin hatching at 45° clipped by a polygon (штриховка).

    ``step`` is the distance between the lines, mm. They lie on one lattice for the whole sheet, so
    that areas side by side hatch alike. ``obstacles`` are items that clip the hatching: joints,
    letters' grounds, links.
    """
    from shapely import MultiLineString, Polygon

    turn = cmath.exp(1j * radians(45.0))
    area = Polygon([(p.real, p.imag) for p in outline])
    turned = [point / turn for point in outline]
    low, high = min(p.imag for p in turned), max(p.imag for p in turned)
    left, right = min(p.real for p in turned) - 1, max(p.real for p in turned) + 1
    levels = [k * step for k in range(ceil(low / step), ceil(high / step))]
    ends = [((left + 1j * y) * turn, (right + 1j * y) * turn) for y in levels]
    lines = MultiLineString([[(a.real, a.imag), (b.real, b.imag)] for a, b in ends])
    paths = _paths(lines.intersection(area), 1e-6)
    strokes: list[Item] = [Stroke(path, Pen.HATCH) for path in paths]
    taken = occupied_area(obstacles)
    return strokes if taken is None else clipped(strokes, taken)


def occupied_area(items: Iterable[Item]) -> BaseGeometry | None:
    """Return the area of items with `WHITE` around, or None if empty.

    Lines have the width of their pens; a circle around its own white includes its inside. Letters
    are ignored.
    """
    from shapely import LineString, Point, Polygon, union_all

    taken, pens = [], pens_in_use()
    for item in items:
        match item:
            case Stroke(points=path, pen=pen, closed=closed) if len(path) > 1:
                ends = [(p.real, p.imag) for p in ((*path, path[0]) if closed else path)]
                taken.append(LineString(ends).buffer(pens.width(pen) / 2 + WHITE, quad_segs=4))
            case Arc(pen=pen):
                ends = [(p.real, p.imag) for p in arc_points(item)]
                taken.append(LineString(ends).buffer(pens.width(pen) / 2 + WHITE, quad_segs=4))
            case Fill(points=path) if len(path) > 2:
                taken.append(Polygon([(p.real, p.imag) for p in path]).buffer(WHITE, quad_segs=4))
            case Disc(centre=centre, radius=radius):
                taken.append(Point(centre.real, centre.imag).buffer(radius + WHITE, quad_segs=8))
    return union_all(taken) if taken else None


def clipped(items: Iterable[Item], occupied: BaseGeometry) -> list[Item]:
    """Return the items, their hatch strokes clipped by an area.

    A stroke may become several pieces; pieces below 1.2 mm are not drawn.
    """
    from shapely import LineString, prepare

    prepare(occupied)
    kept: list[Item] = []
    for item in items:
        if not isinstance(item, Stroke) or item.pen is not Pen.HATCH:
            kept.append(item)
            continue
        line = LineString([(p.real, p.imag) for p in item.points])
        if not occupied.intersects(line):
            kept.append(item)
            continue
        kept += [
            replace(item, points=path) for path in _paths(line.difference(occupied), _MIN_STROKE)
        ]
    return kept


def before_links(items: Sequence[Item]) -> list[Item]:
    """Return the items of a scheme, the hatching of its frame clipped around its links.

    Links are the main lines tagged ``link ...``; the frame's hatching is tagged `GROUND`.
    """
    grounds = [item for item in items if isinstance(item, Stroke) and item.tag == GROUND]
    links = [
        item
        for item in items
        if isinstance(item, Stroke) and item.pen is Pen.MAIN and item.tag.startswith("link ")
    ]
    taken = occupied_area(links) if grounds else None
    if taken is None:
        return list(items)
    kept: list[Item] = []
    for item in items:
        is_ground = isinstance(item, Stroke) and item.tag == GROUND
        kept += clipped([item], taken) if is_ground else [item]
    return kept


def _paths(shape: BaseGeometry, min_length: float) -> list[tuple[complex, ...]]:
    from shapely import LineString

    parts = [part for part in getattr(shape, "geoms", [shape]) if isinstance(part, LineString)]
    return [
        tuple(complex(*point) for point in part.coords)
        for part in parts
        if part.length > min_length
    ]
