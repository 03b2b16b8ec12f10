"""Room that items take on the paper, and pictures with their letters put around them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from planmethod.render.ink.drawing import Arc, Bounds, Disc, Fill, Item, Stroke, Text
from planmethod.render.ink.typeset import text_corners
from planmethod.render.labels import Label, place_labels
from planmethod.render.layout.block import Picture
from planmethod.render.symbols import arc_points


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


ROOMS = (26.0, 60.0)
"""Room around a picture for its letters, mm: more where they find no free place in less."""


def lettered(
    items: Sequence[Item], labels: Sequence[Label], *, clear: Sequence[Item] = ()
) -> Picture:
    """Return a picture of items with their labels in free places around them.

    ``clear`` is what the labels keep clear of though it is not drawn, as long as there is room.
    """
    left, low, right, high = ink_bounds(items)
    for hidden in (clear, ()) if clear else ((),):
        for room in ROOMS:
            bounds = (left - room, low - room, right + room, high + room)
            placed = place_labels(labels, [*items, *hidden], bounds)
            if all(label.free for label in placed):
                break
        else:
            continue
        break
    whole = [*items, *(item for label in placed for item in label.items())]
    return Picture(tuple(whole), ink_bounds(whole))
