"""Room that items take on the paper."""

from __future__ import annotations

from collections.abc import Iterable

from planmethod.render.drawing import Arc, Bounds, Disc, Fill, Item, Stroke, Text
from planmethod.render.symbols import arc_points
from planmethod.render.typeset import text_corners


def ink_bounds(items: Iterable[Item]) -> Bounds:
    """Return the box around items, mm; a point at the origin when there are none."""
    points: list[complex] = []
    for item in items:
        match item:
            case Stroke(points=path) | Fill(points=path):
                points += path
            case Arc():
                points += arc_points(item)
            case Disc(centre=centre, radius=radius):
                points += [centre - radius * (1 + 1j), centre + radius * (1 + 1j)]
            case Text():
                points += text_corners(item)
    if not points:
        return 0.0, 0.0, 0.0, 0.0
    xs, ys = [p.real for p in points], [p.imag for p in points]
    return min(xs), min(ys), max(xs), max(ys)
