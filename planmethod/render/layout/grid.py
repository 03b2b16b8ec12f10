"""Grid of a sheet (сетка листа): blocks on few left edges, their headings on few common lines.

Every block may be moved within its own box. A line of the grid aligns the blocks of as many boxes
as possible, so there are as few lines as the boxes allow.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from planmethod.render.ink.drawing import Bounds
from planmethod.render.ink.extent import overlap
from planmethod.render.layout.cuttings import CLEAR, Unit, box_of

Play: TypeAlias = tuple[float, float, float]
"""Range of an edge, from and to, and its coordinate in the middle of its box, mm."""


def on_grid(units: Sequence[Unit], last: complex, reserved: Sequence[Bounds]) -> list[Unit]:
    """Return units moved within their boxes to common left edges and common upper lines.

    Parameters
    ----------
    units : sequence of Unit
    last : complex, mm
        Upper left corner of the last block, which is fixed: its lines are lines of the grid.
    reserved : sequence of Bounds, mm
        Boxes that must stay free: a unit that would come too near keeps its place.
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
        clear = not any(overlap(moved, other, CLEAR) for other in reserved)
        found.append((node, moved) if clear else unit)
    return found


def _lines(plays: Sequence[Play], fixed: float) -> list[float]:
    """Return for each edge its line, with the fewest lines that reach all edges.

    Edges that can be on the fixed line are; of the rest, the edge whose range ends first shares a
    line with all whose range begins before that end. A line is as near to the middles of its boxes
    as possible.
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
