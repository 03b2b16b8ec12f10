"""Grid of a sheet (сетка листа): blocks on few left edges, their headings on few common lines.

Every block has a box of its own in which it may be moved. A line on which as many boxes as can be
let their blocks stand is a line of the grid; so there are as few lines as the boxes allow.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from planmethod.render.ink.drawing import Bounds
from planmethod.render.ink.extent import overlap
from planmethod.render.layout.cuttings import CLEAR, Unit, box_of

Play: TypeAlias = tuple[float, float, float]
"""Where an edge may be, from and to, and where it would be in the middle of its box, mm."""


def on_grid(units: Sequence[Unit], last: complex, kept: Sequence[Bounds]) -> list[Unit]:
    """Return units moved within their boxes to common left edges and common upper lines.

    Parameters
    ----------
    units : sequence of Unit
    last : complex, mm
        Upper left corner of the last block, which stands fast: its lines are lines of the grid.
    kept : sequence of Bounds, mm
        What must stay free: a unit that would come too near keeps its place.
    """
    across, along = [], []
    for node, (left, low, right, high) in units:
        box = box_of((node, (left, low, right, high)))
        across.append((left, right - node.width, box[0]))
        along.append((low + node.height, high, box[3]))
    lefts, tops = _lines(across, last.real), _lines(along, last.imag)
    found: list[Unit] = []
    for unit, left, top in zip(units, lefts, tops, strict=True):
        node, _ = unit
        moved = (left, top - node.height, left + node.width, top)
        clear = not any(overlap(moved, other, CLEAR) for other in kept)
        found.append((node, moved) if clear else unit)
    return found


def _lines(plays: Sequence[Play], fixed: float) -> list[float]:
    """Return for each edge its line: the fewest lines that all edges can stand on.

    The edges that can stand on the fixed one do; of the rest those that end first share a line
    with all that begin before it ends. A line is as near to the middles of its boxes as can be.
    """
    found = [fixed] * len(plays)
    rest = [k for k, (low, high, _) in enumerate(plays) if not low <= fixed <= high]
    while rest:
        end = min(plays[k][1] for k in rest)
        own = [k for k in rest if plays[k][0] <= end + 1e-9]
        low, high = max(plays[k][0] for k in own), end
        middle = sum(plays[k][2] for k in own) / len(own)
        for k in own:
            found[k] = min(max(middle, low), high)
        rest = [k for k in rest if k not in own]
    return found
