"""Unused paper (незаполненное поле): the largest rectangle without ink, the share with ink."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import ceil, floor

from planmethod.render.ink.drawing import Arc, Bounds, Disc, Fill, Item, Stroke, Text
from planmethod.render.ink.extent import arc_points
from planmethod.render.ink.typeset import text_corners

CELL = 5.0
"""Side of the squares that the paper is divided into, mm."""

FRAME = ("edge", "frame")
"""Tags of the lines around the field, which do not count as ink on it."""


def largest_empty(items: Iterable[Item], inner: Bounds) -> Bounds:
    """Return the largest rectangle within the frame that no ink touches, mm.

    The paper is divided into squares of `CELL`; a square with ink is taken as a whole, so the
    rectangle is exact to one square at each side.
    """
    x0, y0, x1, y1 = inner
    taken = _find_inked_squares(items, inner)
    left, low, right, high = _largest(taken, len(taken[0]))
    return (
        x0 + left * CELL,
        y0 + low * CELL,
        min(x0 + right * CELL, x1),
        min(y0 + high * CELL, y1),
    )


def inked_percentage(items: Iterable[Item], inner: Bounds) -> float:
    """Return the share of the squares of `CELL` within the frame that ink touches, %."""
    taken = _find_inked_squares(items, inner)
    return 100.0 * sum(map(sum, taken)) / (len(taken) * len(taken[0]))


def _find_inked_squares(items: Iterable[Item], inner: Bounds) -> list[list[bool]]:
    """Return the squares that ink touches as rows of flags from below."""
    x0, y0, x1, y1 = inner
    columns, rows = ceil((x1 - x0) / CELL), ceil((y1 - y0) / CELL)
    taken = [[False] * columns for _ in range(rows)]
    for item in items:
        for point in ink_points(item) if item.tag not in FRAME else ():
            k, j = floor((point.real - x0) / CELL), floor((point.imag - y0) / CELL)
            if 0 <= k < columns and 0 <= j < rows:
                taken[j][k] = True
    return taken


def area_percentage(box: Bounds, inner: Bounds) -> float:
    """Return the share of the field within the frame that a rectangle takes, %."""
    left, low, right, high = box
    return 100.0 * (right - left) * (high - low) / ((inner[2] - inner[0]) * (inner[3] - inner[1]))


def ink_points(item: Item) -> list[complex]:
    """Return points of an item's ink, close enough that no square of `CELL` is missed."""
    match item:
        case Stroke(points=path, closed=closed):
            return _sample_path([*path, path[0]] if closed and path else path)
        case Arc():
            return _sample_path(arc_points(item))
        case Fill(points=path):
            return _sample_path([*path, *path[:1]])
        case Disc(centre=centre, radius=radius):
            return [centre, *(centre + radius * way for way in (1, 1j, -1, -1j))]
        case Text():
            first, second, third, fourth = text_corners(item)
            return _sample_path([first, second, third, fourth, first])


def _sample_path(path: Sequence[complex]) -> list[complex]:
    points = list(path[:1])
    for start, end in pairwise(path):
        count = max(1, ceil(abs(end - start) / (0.4 * CELL)))
        points += [start + (end - start) * k / count for k in range(1, count + 1)]
    return points


def _largest(occupied: Sequence[Sequence[bool]], columns: int) -> tuple[int, int, int, int]:
    """Return the largest free rectangle in squares: under a skyline that grows row by row."""
    best, most = (0, 0, 0, 0), 0
    free = [0] * (columns + 1)  # how many free squares end in this row; the last is a wall
    for row, line in enumerate(occupied):
        starts: list[tuple[int, int]] = []  # column and height, rising
        for k in range(columns + 1):
            free[k] = 0 if k == columns or line[k] else free[k] + 1
            start = k
            while starts and starts[-1][1] >= free[k]:
                start, height = starts.pop()
                if height * (k - start) > most:
                    most = height * (k - start)
                    best = (start, row + 1 - height, k, row + 1)
            starts.append((start, free[k]))
    return best
