"""Packing of a sheet's blocks (компоновка листа): rows within columns within rows.

Blocks keep the order in which they are read: from left to right and from the top down. The sheet is
cut again and again by a straight line, across or along, between two neighbours of the sequence (a
guillotine cutting); a group is cut as a whole first, and then within itself. The cutting of the
least cost that fits is chosen, the first of equals. The cost is the sum of three parts:

1. uneven white: over the blocks, the squares of the white that a block has in its box, as parts of
   the paper's width and height; texts that stay together count as one block;
2. `BACK` for every paper's height that the eye goes back up from a group to the next one;
3. `VOID` times the part of the paper that the largest empty rectangle takes.

In the chosen cutting blocks get larger layouts as long as it fits: pictures at larger scales.
Blocks are aligned on a grid (`planmethod.render.layout.grid`): within their boxes they are moved to
as few left edges and upper lines as possible. Neighbouring texts stay together: with one left edge
under one another, with one upper edge side by side. The last block is on the title block in the
lower right corner, aligned to its left edge if it is not wider, or to the left of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import inf
from typing import NamedTuple, TypeAlias

from planmethod.render.ink.drawing import Bounds
from planmethod.render.ink.extent import overlap
from planmethod.render.layout.block import Block
from planmethod.render.layout.cuttings import (
    CLEAR,
    GAP,
    Group,
    LayoutItem,
    Leaf,
    Node,
    Unit,
    box_of,
    corners_of,
    cuttings,
    grow,
    node_fits,
    units_of,
)
from planmethod.render.layout.grid import on_grid

EDGE = 5.0
"""Least white between a block and the frame, mm."""

BACK = 0.15
"""Cost of going back up by the height of the paper in reading."""

VOID = 4.0
"""Cost of an empty rectangle as large as the paper."""

_MAX_MEASURED = 40  # cheapest cuttings by the first two parts: their empty rectangles are measured


def pack(
    root: Group, inner: Bounds, stamp: Bounds, reserved: Sequence[Bounds] = ()
) -> list[Placed] | None:
    """Return the blocks with their upper left corners, mm, or None when they do not fit a sheet.

    Parameters
    ----------
    root : Group
        The blocks in reading order; the last one is placed above the title block or left of it.
    inner, stamp : Bounds, mm
        Inside of the frame, and the title block in its lower right corner.
    reserved : sequence of Bounds, mm
        Boxes inside the frame that must stay free, such as graph 26. A block that would cover one
        is moved aside within its area; if it cannot be, all blocks keep clear of the strip along
        the frame that contains the box.
    """
    if stamp[0] <= inner[0]:  # as wide as the sheet: no space is left beside it
        inner = (inner[0], stamp[3] - EDGE + GAP / 2, *inner[2:])
        stamp = (inner[2], stamp[3], inner[2], stamp[3])
    for free in (inner, *_exclude_reserved(inner, stamp, reserved)):
        placed = _pack_into(root, free, stamp, reserved)
        if placed is not None:
            return placed
    return None


def _pack_into(
    root: Group, inner: Bounds, stamp: Bounds, reserved: Sequence[Bounds]
) -> list[Placed] | None:
    """Return the cheapest cutting of a group, if one fits."""
    *_, last = root.parts()
    # Groups before the last block have the same cuttings for all its places.
    settled: dict[int, list[Node]] = {id(one): [] for one in root.members[:-1]}
    found = [
        option
        for end in last.alternatives
        for corner in _last_corners(end, inner, stamp)
        for option in _options(root, inner, stamp, reserved, end, corner, settled)
    ]
    if not found:
        return None
    found.sort(key=lambda option: option.cost)

    best, least = found[0], inf
    for option in found[:_MAX_MEASURED]:
        if option.cost >= least:  # and so are all that follow
            break
        boxes = [box_of(unit) for unit in option.units[:-1]]
        void = VOID * largest_empty_fraction([*boxes, option.last, stamp, *reserved], inner)
        if option.cost + void < least:
            best, least = option, option.cost + void
    ways = [some if one.grows else () for one, some in zip(root.parts(), best.leaves, strict=True)]
    larger = _units(grow(best.node, ways, _inner_size(inner)), inner, best.last, reserved)
    *units, end = larger or best.units
    if not units:
        best = best._replace(last=_centre_single(best.last, inner, stamp, reserved))
    units = on_grid(units, complex(best.last[0], best.last[3]), [*reserved, best.last])
    put = {leaf.number: (leaf.block, at) for unit in units for leaf, at in corners_of(unit)}
    (leaf, _), *_ = corners_of(end)
    put[leaf.number] = (leaf.block, complex(best.last[0], best.last[3]))
    return [put[number] for number in sorted(put)]


def _centre_single(box: Bounds, inner: Bounds, stamp: Bounds, reserved: Sequence[Bounds]) -> Bounds:
    """Return the box of the only block of a sheet, centred beside or above the title block.

    It stays below the boxes that must stay free, or beside them.
    """
    if box[1] < stamp[3]:
        return box
    middle = (inner[0] + inner[2]) / 2
    left = max([inner[0], *(other[2] for other in reserved if other[2] < middle)])
    right = min([inner[2], *(other[0] for other in reserved if other[0] > middle)])
    below = (inner[0], inner[2], min([inner[3], *(other[1] for other in reserved)]))
    for start, end, high in (below, (left, right, inner[3])):
        across = (start + end - box[0] - box[2]) / 2
        up = max(0.0, (max(stamp[3], box[1]) + high - box[1] - box[3]) / 2)
        moved = (box[0] + across, box[1] + up, box[2] + across, box[3] + up)
        clear = not any(overlap(moved, other, CLEAR) for other in reserved)
        if clear and moved[0] >= start and moved[3] <= high:
            return moved
    return box


def _last_corners(last: Block, inner: Bounds, stamp: Bounds) -> list[complex]:
    """Return places of the last block: above the title block, or a wide one left of it."""
    wide, high = last.width, last.height
    left = stamp[0] if wide <= inner[2] - EDGE - stamp[0] else inner[2] - EDGE - wide
    above = complex(left, stamp[3] + GAP / 2 + high)
    beside = complex(stamp[0] - GAP / 2 - wide, inner[1] + EDGE + high)
    # A high block beside the title block would leave white above the title block.
    low = high - (stamp[3] - stamp[1]) < (more := wide - (stamp[2] - stamp[0]))
    return [above, beside] if low and more > 0.0 and beside.real >= inner[0] + EDGE else [above]


Placed: TypeAlias = tuple[Block, complex]
"""A block in its chosen layout, and its upper left corner."""


class _Option(NamedTuple):
    """A cutting that fits: its cost without empty rectangles, its units, the last block's box.

    ``leaves`` are the layouts of all its blocks.
    """

    cost: float
    units: list[Unit]
    last: Bounds
    node: Node
    leaves: Sequence[Sequence[Leaf]]


def _options(
    root: Group,
    inner: Bounds,
    stamp: Bounds,
    reserved: Sequence[Bounds],
    end: Block,
    corner: complex,
    cached: dict[int, list[Node]],
) -> Iterator[_Option]:
    """Yield the cuttings that fit with the last block in a given layout and place."""
    parts = tuple(root.parts())
    room = _inner_size(inner)
    leaves = [
        [Leaf(k, way, way.width, way.height, part.text) for way in part.alternatives]
        for k, part in enumerate(parts)
    ]
    box = (inner[0] + EDGE, inner[1] + EDGE, inner[2] - EDGE, inner[3] - EDGE)
    opposite = corner + complex(end.width, -end.height)
    last = (corner.real, opposite.imag, opposite.real, corner.imag)
    # The last block and the title block are one leaf.
    wide = max(box[2] - corner.real, min(stamp[2] - stamp[0] - EDGE, room[0]))
    high = max(corner.imag, stamp[3]) - box[1]
    leaves[-1] = [Leaf(len(parts) - 1, end, wide, high, text=False)]
    turns = _turns(root)
    for asked in (root, *_join_last(root)):
        for node in cuttings(asked, iter(leaves), room, exhaustive=True, cached=cached):
            units = _units(node, inner, last, reserved)
            if units:
                cost = _unevenness(units, room) + BACK * _eye_return(units, turns, room)
                yield _Option(cost, units, last, node, leaves)


def _units(node: Node, inner: Bounds, last: Bounds, reserved: Sequence[Bounds]) -> list[Unit]:
    """Return the area of each unit of a cutting, clear of boxes; empty if impossible."""
    box = (inner[0] + EDGE, inner[1] + EDGE, inner[2] - EDGE, inner[3] - EDGE)
    units = list(units_of(node, box, anchored=True))
    if reserved:
        moved = [_clear(unit, reserved) for unit in units[:-1]]
        if None in moved or any(overlap(last, other, CLEAR) for other in reserved):
            return []
        units = [*(unit for unit in moved if unit is not None), units[-1]]
    return units


def _inner_size(inner: Bounds) -> tuple[float, float]:
    return (inner[2] - inner[0] - 2 * EDGE, inner[3] - inner[1] - 2 * EDGE)


def _join_last(root: Group) -> Iterator[Group]:
    """Yield the sheet whose last block is among the blocks of the group before it.

    For example, the results under the texts of a plan, to the right of the plan.
    """
    *before, group, last = (None, *root.members)
    if not isinstance(group, Group) or last is None:
        return
    if {root.arrange, group.arrange} == {"free"}:
        views = [one for one in group.members if not (isinstance(one, LayoutItem) and one.text)]
        texts = tuple(one for one in group.members if isinstance(one, LayoutItem) and one.text)
        if group.members == (*views, *texts):
            joined = Group((*views, *([Group(texts)] if texts else []), last))
            yield Group((*root.members[: len(before) - 1], joined))


# Cost ---------------------------------------------------------------------------------------------


def _unevenness(units: Sequence[Unit], space: tuple[float, float]) -> float:
    """Return the unevenness of white: the squares of each unit's spare width and height."""
    total = 0.0
    for node, (left, low, right, high) in units:
        total += ((right - left - node.width) / space[0]) ** 2
        total += ((high - low - node.height) / space[1]) ** 2
    return total


def _turns(root: Group) -> list[int]:
    """Return for every block the number of its member of the whole sheet."""
    return [
        turn
        for turn, member in enumerate(root.members)
        for _ in (member.parts() if isinstance(member, Group) else (member,))
    ]


def _eye_return(units: Sequence[Unit], turns: Sequence[int], space: tuple[float, float]) -> float:
    """Return the upward way of the eye between members of the sheet, in paper heights."""
    spans: dict[int, tuple[float, float]] = {}
    for node, (_, low, _, high) in units:
        turn = turns[_first(node)]
        before = spans.get(turn, (low, high))
        spans[turn] = (min(low, before[0]), max(high, before[1]))
    middles = [(low + high) / 2 for _, (low, high) in sorted(spans.items())]
    return sum(max(0.0, after - before) for before, after in pairwise(middles)) / space[1]


def _first(node: Node) -> int:
    return node.number if isinstance(node, Leaf) else _first(node.first)


def largest_empty_fraction(boxes: Sequence[Bounds], inner: Bounds) -> float:
    """Return the area of the largest rectangle without boxes as a part of the inside of the frame.

    Its sides are on the sides of boxes: only these are tried.
    """
    left, low, right, high = inner
    most = 0.0
    floors = sorted({low, *(box[3] for box in boxes)})
    ceilings = sorted({high, *(box[1] for box in boxes)})
    for floor in floors:
        for ceiling in ceilings:
            if (ceiling - floor) * (right - left) <= most:
                continue
            walls = sorted((b[0], b[2]) for b in boxes if b[1] < ceiling and b[3] > floor)
            edge, widest = left, 0.0
            for wall in [*walls, (right, right)]:
                widest = max(widest, wall[0] - edge)
                edge = max(edge, wall[1])
            most = max(most, widest * (ceiling - floor))
    return most / ((right - left) * (high - low))


# Boxes that must stay free ------------------------------------------------------------------------


def _clear(unit: Unit, reserved: Sequence[Bounds]) -> Unit | None:
    """Return a unit with the part of its area that is clear of boxes, or None.

    It is moved as little as possible.
    """
    start = _middle(unit)
    for other in reserved:
        if not overlap(box_of(unit), other, CLEAR):
            continue
        node, box = unit
        rooms = (
            (part, (part[2] - part[0], part[3] - part[1])) for part in _split_around(box, other)
        )
        others = [(node, part) for part, room in rooms if node_fits(node, room)]
        if not others:
            return None
        unit = min(others, key=lambda moved: abs(_middle(moved) - start))
    return None if any(overlap(box_of(unit), other, CLEAR) for other in reserved) else unit


def _middle(unit: Unit) -> complex:
    left, low, right, high = unit[1]
    return complex(left + right, low + high) / 2


def _split_around(box: Bounds, reserved: Bounds) -> tuple[Bounds, ...]:
    """Return the parts of a box below, right of, left of and above a taken one."""
    left, low, right, high = box
    return (
        (left, low, right, min(high, reserved[1] - CLEAR)),
        (max(left, reserved[2] + CLEAR), low, right, high),
        (left, low, min(right, reserved[0] - CLEAR), high),
        (left, max(low, reserved[3] + CLEAR), right, high),
    )


def _exclude_reserved(inner: Bounds, stamp: Bounds, reserved: Sequence[Bounds]) -> list[Bounds]:
    """Return parts of the inside below or right of taken boxes, with the title block."""
    rooms = [inner] if reserved else []
    for box in reserved:
        rooms = [
            part
            for left, low, right, high in rooms
            for part in (
                # A block keeps EDGE from the sides of its area, and CLEAR is enough here.
                (left, low, right, min(high, box[1] + EDGE - CLEAR)),
                (max(left, box[2] - EDGE + CLEAR), low, right, high),
            )
        ]
    return [room for room in rooms if room[0] <= stamp[0] and room[3] >= stamp[3]]
