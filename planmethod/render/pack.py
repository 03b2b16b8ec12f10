"""Packing of a sheet's blocks (компоновка листа): rows within columns within rows.

Blocks keep the order in which they are read: from left to right and from the top down. The sheet is
cut again and again by a straight line, across or along, between two neighbours of the sequence
(a guillotine cutting); of all cuttings that fit, the one that spreads the white most evenly is
taken. The last block stands on the title block in the lower right corner.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from planmethod.render.block import Block
from planmethod.render.drawing import Bounds

GAP = 9.0
"""Least white between two blocks, mm."""

EDGE = 5.0
"""Least white between a block and the frame, mm."""

_OPTIONS = 7  # cuttings kept for one run of blocks: widths from the narrowest to the widest


@dataclass(frozen=True, slots=True)
class _Leaf:
    number: int
    width: float
    height: float


@dataclass(frozen=True, slots=True)
class _Cut:
    """Two parts side by side (``across`` false) or one above the other."""

    first: _Node
    second: _Node
    across: bool
    width: float
    height: float


_Node: TypeAlias = "_Leaf | _Cut"


def pack(blocks: Sequence[Block], inner: Bounds, stamp: Bounds) -> list[complex] | None:
    """Return where the upper left corners of blocks go, mm, or None when they do not fit a sheet.

    Parameters
    ----------
    blocks : sequence of Block
        In reading order; the last one stands directly above the title block.
    inner, stamp : Bounds, mm
        Inside of the frame, and the title block in its lower right corner.
    """
    room = (inner[2] - inner[0] - 2 * EDGE, inner[3] - inner[1] - 2 * EDGE)
    sizes = [(block.width, block.height) for block in blocks]
    last_width, last_height = sizes[-1]
    # The last block and the title block under it are one leaf.
    sizes[-1] = (
        max(last_width, min(stamp[2] - stamp[0] - EDGE, room[0])),
        last_height + (stamp[3] - stamp[1]) - EDGE + GAP / 2,
    )
    fitting = [node for node in _cuttings(sizes, room) if _fits(node, room)]
    if not fitting:
        return None
    box = (inner[0] + EDGE, inner[1] + EDGE, inner[2] - EDGE, inner[3] - EDGE)
    boxes = min((_boxes(node, box) for node in fitting), key=lambda b: _unevenness(b, sizes, room))
    corners: list[complex] = []
    for number, block in enumerate(blocks):
        left, low, right, high = boxes[number]
        if number == len(blocks) - 1:
            corners.append(complex(right - block.width, stamp[3] + GAP / 2 + block.height))
        else:
            middle = complex(left + right, low + high) / 2
            corners.append(middle + complex(-block.width, block.height) / 2)
    return corners


def _fits(node: _Node, room: tuple[float, float]) -> bool:
    return node.width <= room[0] + 1e-6 and node.height <= room[1] + 1e-6


def _cuttings(sizes: Sequence[tuple[float, float]], room: tuple[float, float]) -> list[_Node]:
    """Return cuttings of the whole sequence, none narrower and lower than another."""
    count = len(sizes)
    kept: dict[tuple[int, int], list[_Node]] = {
        (k, k + 1): [_Leaf(k, *sizes[k])] for k in range(count)
    }
    for length in range(2, count + 1):
        for start in range(count - length + 1):
            end = start + length
            found: list[_Node] = []
            for middle in range(start + 1, end):
                for one in kept[start, middle]:
                    for two in kept[middle, end]:
                        found += [cut for cut in _joined(one, two) if _fits(cut, room)]
            kept[start, end] = _pareto(found)
    return kept[0, count]


def _joined(one: _Node, two: _Node) -> tuple[_Cut, _Cut]:
    wide = one.width + GAP + two.width
    tall = one.height + GAP + two.height
    return (
        _Cut(one, two, False, wide, max(one.height, two.height)),
        _Cut(one, two, True, max(one.width, two.width), tall),
    )


def _pareto(nodes: list[_Node]) -> list[_Node]:
    """Return the nodes that no other beats in both sizes, thinned to a few."""
    nodes.sort(key=lambda node: (node.width, node.height))
    best: list[_Node] = []
    for node in nodes:
        if not best or node.height < best[-1].height - 1e-9:
            best.append(node)
    if len(best) <= _OPTIONS:
        return best
    step = (len(best) - 1) / (_OPTIONS - 1)
    return [best[round(k * step)] for k in range(_OPTIONS)]


def _boxes(node: _Node, box: Bounds) -> dict[int, Bounds]:
    """Return the room that each leaf gets when the spare white is shared at every cut."""
    if isinstance(node, _Leaf):
        return {node.number: box}
    left, low, right, high = box
    if node.across:
        spare = high - low - node.height
        cut = high - node.first.height - spare * _share(node, across=True) - GAP / 2
        parts = ((left, cut + GAP / 2, right, high), (left, low, right, cut - GAP / 2))
    else:
        spare = right - left - node.width
        cut = left + node.first.width + spare * _share(node, across=False) + GAP / 2
        parts = ((left, low, cut - GAP / 2, high), (cut + GAP / 2, low, right, high))
    return {**_boxes(node.first, parts[0]), **_boxes(node.second, parts[1])}


def _share(node: _Cut, *, across: bool) -> float:
    """Return the first part's share of spare white: by the number of blocks in that direction."""
    one, two = _steps(node.first, across=across), _steps(node.second, across=across)
    return one / (one + two)


def _steps(node: _Node, *, across: bool) -> int:
    if isinstance(node, _Leaf):
        return 1
    one, two = _steps(node.first, across=across), _steps(node.second, across=across)
    return one + two if node.across is across else max(one, two)


def _unevenness(
    boxes: dict[int, Bounds], sizes: Sequence[tuple[float, float]], room: tuple[float, float]
) -> float:
    """Return how unevenly white is spread: squares of what each block leaves of its box."""
    total = 0.0
    for number, (left, low, right, high) in boxes.items():
        width, height = sizes[number]
        total += ((right - left - width) / room[0]) ** 2 + ((high - low - height) / room[1]) ** 2
    return total
