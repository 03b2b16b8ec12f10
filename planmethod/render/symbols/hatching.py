"""Hatching (штриховка): hatched areas, and items that clip it.

Hatch strokes of the frame have the tag `GROUND`: they are clipped around links.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Sequence
from math import ceil, radians
from typing import TYPE_CHECKING

from msgspec.structs import replace

from planmethod.render.ink.drawing import Arc, Disc, Fill, Item, Pen, Stroke
from planmethod.render.ink.extent import arc_points
from planmethod.render.ink.style import PENS
from planmethod.render.symbols.sizes import SIZES

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

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

    taken = []
    for item in items:
        match item:
            case Stroke(points=path, pen=pen, closed=closed) if len(path) > 1:
                ends = [(p.real, p.imag) for p in ((*path, path[0]) if closed else path)]
                taken.append(LineString(ends).buffer(PENS[pen].width / 2 + WHITE, quad_segs=4))
            case Arc(pen=pen):
                ends = [(p.real, p.imag) for p in arc_points(item)]
                taken.append(LineString(ends).buffer(PENS[pen].width / 2 + WHITE, quad_segs=4))
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
