"""Extent of items on the paper (габариты)."""

from __future__ import annotations

import cmath
from collections.abc import Iterable
from math import ceil

from planmethod.render.ink.drawing import Arc, Bounds, Disc, Fill, Item, Stroke, Text
from planmethod.render.ink.style import sweep
from planmethod.render.ink.typeset import text_corners


def arc_points(arc: Arc, *, step: float = 0.25) -> list[complex]:
    """Return points along an arc, ``step`` radians apart at most."""
    turn = sweep(arc)
    count = max(2, ceil(turn / step))
    angles = (arc.start + turn * k / count for k in range(count + 1))
    return [arc.centre + cmath.rect(arc.radius, angle) for angle in angles]


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


def overlap(one: Bounds, two: Bounds, gap: float = 0.0) -> bool:
    """Return whether two boxes are nearer than ``gap`` mm, or overlap."""
    across = one[0] < two[2] + gap - 1e-6 and two[0] < one[2] + gap - 1e-6
    return across and one[1] < two[3] + gap - 1e-6 and two[1] < one[3] + gap - 1e-6
