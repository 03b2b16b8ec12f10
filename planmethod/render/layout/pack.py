"""Packing of a sheet's blocks (компоновка листа): cuttings by straight lines, columns, rows.

For each run of blocks in reading order the cuttings are kept that no other beats in both width and
height. The cheapest one that fits the sheet is used. Its cost is the sum of three parts: squares of
the white around each block, the way of the eye back up between groups, and the largest empty
rectangle. Then blocks whose larger layouts have larger scales grow, and all are moved inside their
areas to as few left and upper edges as possible (`on_grid`). The last block is placed at the title
block. White space therefore gathers at the right and below. A sheet in columns is divided by
`planmethod.render.layout.columns`, and cut as above only if that leaves a large hole.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from itertools import pairwise
from math import inf
from operator import itemgetter
from typing import NamedTuple

from msgspec.structs import replace

from planmethod.render.ink.drawing import Bounds
from planmethod.render.ink.typeset import overlap
from planmethod.render.layout.block import Block, Column, DrawingArea
from planmethod.render.layout.columns import Columns
from planmethod.render.layout.cuttings import (
    Leaf,
    Node,
    Unit,
    box_at,
    box_of,
    boxes_of,
    corners_of,
    cuttings,
    grow,
    largest_empty_fraction,
    node_fits,
    number_of,
    units_of,
)
from planmethod.render.layout.groups import CLEAR, EDGE, GAP, Group, LayoutItem, Placed
from planmethod.render.layout.text_blocks import TablePart

DROP = 25.0
"""Largest white above a unit that is moved down to the line of its row, mm."""


def on_grid(
    units: Sequence[Unit],
    last: float,
    top: float,
    reserved: Sequence[Bounds],
    *,
    rise: float = 1.0,
) -> list[Unit]:
    """Return units moved within their areas to columns and rows of a grid.

    Units begin at the left edges of their areas, or further right at an edge that several can
    share. They are moved up to the units above them, so that white is under all; those of a row
    have one upper line, that of the lowest of them.

    Parameters
    ----------
    units : sequence of Unit
    last : float, mm
        Left edge of the last block, which is fixed: those that can share it do.
    top : float, mm
        Upper limit of the sheet's blocks.
    reserved : sequence of Bounds, mm
        Boxes that must stay free, above units.
    rise : float
        Part of the way to the units above that units go up from the tops of their areas.
    """
    lefts = _lines([_left_range(unit, reserved) for unit in units], last)
    boxes = [
        (left, box[1], left + node.width, box[1] + node.height)
        for (node, box), left in zip(units, lefts, strict=True)
    ]
    walls = [(x0 - CLEAR, y0 - CLEAR, x1 + CLEAR, y1) for x0, y0, x1, y1 in reserved]
    waiting = sorted(range(len(units)), key=lambda k: -units[k][1][3])
    while waiting:
        roofs: dict[int, float] = {}
        for k in waiting:
            left, low, right, _ = boxes[k]
            above = [j for j in waiting if j != k and _is_under(units[k][1], units[j][1])]
            if not above:
                over = [
                    wall[1]
                    for wall in walls
                    if wall[0] < right and left < wall[2] and wall[3] > low
                ]
                free = min([top, *over])
                roofs[k] = free + (1.0 - rise) * min(0.0, units[k][1][3] - free)
        highest = max(roofs.values())
        row = [k for k, roof in roofs.items() if roof >= highest - DROP]
        line = min(roofs[k] for k in row)
        for k in row:
            left, low, right, least = boxes[k]
            own = line if line >= least - 1e-6 else roofs[k]
            boxes[k] = (left, own - units[k][0].height, right, own)
            side = GAP - 1e-6  # areas of neighbours are GAP apart
            walls.append((left - side, boxes[k][1] - GAP, right + side, own))
        waiting = [k for k in waiting if k not in row]
    return [(node, box) for (node, _), box in zip(units, boxes, strict=True)]


def _left_range(unit: Unit, reserved: Sequence[Bounds]) -> tuple[float, float]:
    """Return the range of a unit's left edge: beside a box under which its area is too low."""
    node, (left, low, right, _) = unit
    end = right - node.width
    for box in reserved:
        is_over = box[0] < left + node.width + CLEAR and left < box[2] + CLEAR
        if is_over and box[1] - CLEAR < low + node.height and box[2] + CLEAR <= end:
            left = box[2] + CLEAR
    return left, end


def _is_under(one: Bounds, two: Bounds) -> bool:
    """Return whether an area is under another."""
    return one[0] < two[2] and two[0] < one[2] and one[3] <= two[1] + 1e-6


def _lines(plays: Sequence[tuple[float, float]], fixed: float) -> list[float]:
    """Return for each edge, which has a range, its line, with the fewest lines that reach all.

    Edges that can be on the fixed line are; of the rest, the edge whose range ends first shares a
    line with all whose range begins before that end. A line is as far left as these allow.
    """
    found = [fixed] * len(plays)
    rest = [k for k, (low, high) in enumerate(plays) if not low <= fixed <= high]
    while rest:
        end = min(plays[k][1] for k in rest)
        own = [k for k in rest if plays[k][0] <= end + 1e-9]
        for k in own:
            found[k] = max(plays[j][0] for j in own)
        rest = [k for k in rest if k not in own]
    return found


BACK = 0.15
"""Cost of going back up by the height of the paper in reading."""

VOID = 5.0
"""Cost of an empty rectangle as large as the paper."""

HOLE = 0.08
"""Part of the field of an empty rectangle above which white is not gathered under the blocks."""

LARGE = 0.1
"""Part of the field of an empty rectangle above which blocks in columns are also tried freely."""

STEP = 1.9
"""Cost of a step by the height of the paper between the titles of the first row of views."""

RAGGED = 0.04
"""Cost of a left edge that blocks have."""

_MAX_MEASURED = 40  # cheapest cuttings by the first two parts: their white and titles are measured


def pack(root: Group, area: DrawingArea) -> list[Placed] | None:
    """Return the blocks with their upper left corners, mm, or None when they do not fit a sheet.

    Parameters
    ----------
    root : Group
        The blocks in reading order; the last one is placed above the title block or left of it.
    area : DrawingArea
        Blocks are below a reserved box, so that their titles are on one line. If the space is
        too small for this, a block that would cover it is moved aside within its own area, or all
        are beside it.
    """
    inner, stamp = area.inner, area.stamp
    if stamp[0] <= inner[0]:  # as wide as the sheet: no space is left beside it
        inner = (inner[0], stamp[3] - EDGE + GAP / 2, *inner[2:])
        stamp = (inner[2], stamp[3], inner[2], stamp[3])
    clear = _exclude_reserved(inner, stamp, area.reserved)
    if root.arrange == "columns":
        found = (_in_columns(root, DrawingArea(free, stamp)) for free in clear or [inner])
        placed = next((one for one in found if one is not None), None)
        for other in (replace(root, arrange="free"), root.inner()):
            if placed is None or largest_hole(placed, area) <= LARGE:
                break
            tried = pack(other, area) or placed
            placed = min((placed, tried), key=partial(largest_hole, area=area))
        return placed
    below, *beside = (*clear, inner)
    for free in dict.fromkeys((below, inner, *beside)):
        placed = _pack_into(root, DrawingArea(free, stamp, area.reserved))
        if placed is not None:
            return placed
    return None


def largest_hole(placed: Sequence[Placed], area: DrawingArea) -> float:
    """Return the part of the field of the largest rectangle without blocks."""
    boxes = [box_at(block, corner) for block, corner in placed]
    return largest_empty_fraction([*boxes, area.stamp, *area.reserved], area.inner)


def _in_columns(root: Group, area: DrawingArea) -> list[Placed] | None:
    """Return the best division of a group into columns, if one fits."""
    leaves = _leaves(root)
    *_, last = leaves
    columns = Columns(root, leaves, area)
    found = [
        (sheet, end, corner)
        for end in last
        for corner in _last_corners(end.block, area.inner, area.stamp)
        if corner.real >= area.inner[0] + EDGE - 1e-6 and corner.imag <= area.inner[3] - EDGE + 1e-6
        if (sheet := columns.sheet(box_at(end.block, corner))) is not None
    ]
    if not found:
        return None
    sheet, end, corner = min(found, key=lambda one: one[0].cost)
    put = {leaf.number: (leaf.block, at) for unit in sheet.units for leaf, at in corners_of(unit)}
    return [*(put[number] for number in sorted(put)), (end.block, corner)]


def _leaves(root: Group) -> list[list[Leaf]]:
    """Return the layouts of every block in reading order."""
    return [
        [Leaf(k, way, way.width, way.height, part.text) for way in part.alternatives]
        for k, part in enumerate(root.parts())
    ]


def _pack_into(root: Group, area: DrawingArea) -> list[Placed] | None:
    """Return the cheapest cutting of a group, if one fits."""
    inner, stamp = area.inner, area.stamp
    *_, last = root.parts()
    # Groups before the last block have the same cuttings for all its places.
    settled: dict[int, list[Node]] = {id(one): [] for one in root.members[:-1]}
    found = [
        option
        for end in last.alternatives
        for corner in _last_corners(end, inner, stamp)
        for option in _options(root, area, end, corner, settled)
    ]
    if not found:
        return None
    if stamp[0] >= inner[2]:  # white is at the right
        found = [one for one in found if one.last[0] <= inner[0] + EDGE + 1e-6] or found
    found.sort(key=lambda option: option.cost)

    best, least = found[0], inf
    for option in found[:_MAX_MEASURED]:
        if option.cost >= least:  # and so are all that follow
            break
        units, hole = _with_little_void(option.units[:-1], option.last, area)
        cost = option.cost + VOID * hole + STEP * _step_of_units(units) / (inner[3] - inner[1])
        cost += RAGGED * len({round(at.real) for unit in units for _, at in corners_of(unit)})
        if cost < least:
            best, least = option, cost
    ways = [some if one.grows else () for one, some in zip(root.parts(), best.leaves, strict=True)]
    larger = _units(grow(best.node, ways, _inner_size(inner)), best.last, area)
    *units, end = larger or best.units
    if not units:
        best = best._replace(last=_centre_single(best.last, area))
    units, _ = _with_little_void(units, best.last, area)
    put = {leaf.number: (leaf.block, at) for unit in units for leaf, at in corners_of(unit)}
    (leaf, _), *_ = corners_of(end)
    line = best.last[3]
    if stamp[0] >= inner[2] and not _is_table(leaf.block):
        line = _raised_line(units, best.last)
    put[leaf.number] = (leaf.block, complex(best.last[0], line))
    return [put[number] for number in sorted(put)]


def _raised_line(units: Sequence[Unit], last: Bounds) -> float:
    """Return the upper line of the last block above a title block as wide as the sheet, mm.

    White is half above and half under it, or all under it in a column of its own.
    """
    boxes = boxes_of(units)
    roofs = [low - GAP for left, low, right, _ in boxes if left < last[2] and last[0] < right]
    if roofs:
        return (last[3] + max(last[3], min(roofs))) / 2
    return max((last[3], *(box[3] for box in boxes)))


def _with_little_void(
    units: Sequence[Unit], last: Bounds, area: DrawingArea
) -> tuple[list[Unit], float]:
    """Return units on the grid, and the part of the field of the largest empty rectangle.

    White is under all blocks, unless this leaves too large a rectangle: then some of it, or all, is
    under each row. White within the box of a group counts, too.
    """
    top = area.inner[3] - EDGE
    found: list[tuple[list[Unit], float]] = []
    for rise in (1.0, 0.5, 0.0):
        placed = on_grid(units, last[0], top, area.reserved, rise=rise)
        boxes = [*boxes_of(placed), last, area.stamp, *area.reserved]
        found.append((placed, largest_empty_fraction(boxes, area.inner)))
        if found[0][1] <= HOLE:
            break
    return min(found, key=itemgetter(1))


def _centre_single(box: Bounds, area: DrawingArea) -> Bounds:
    """Return the box of the only block of a sheet, centred beside or above the title block.

    It stays below the boxes that must stay free, or beside them.
    """
    inner, stamp, reserved = area.inner, area.stamp, area.reserved
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
    """Return places of the last block: above the title block, or a wide one left of it.

    A table above the title block ends at its edge. Above one as wide as the sheet other blocks
    begin at the left edge, or leave space for others there.
    """
    wide, high = last.width, last.height
    right = inner[2] if _is_table(last) else inner[2] - EDGE
    left = min(stamp[0], right - wide)
    above = complex(left, stamp[3] + GAP / 2 + high)
    if stamp[0] >= inner[2] and not _is_table(last) and wide <= right - inner[0] - EDGE:
        return [complex(inner[0] + EDGE, above.imag), above]
    beside = complex(stamp[0] - GAP / 2 - wide, inner[1] + EDGE + high)
    # A high block beside the title block would leave white above the title block.
    low = high - (stamp[3] - stamp[1]) < max(GAP, wide - (stamp[2] - stamp[0]))
    return [above, beside] if low and beside.real >= inner[0] + EDGE else [above]


def _is_table(block: Block) -> bool:
    """Return whether the lines of a table are the sides of a block."""
    if isinstance(block, Column):
        return any(_is_table(one) and one.width >= block.width for one in block.blocks)
    return isinstance(block, TablePart)


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
    root: Group, area: DrawingArea, end: Block, corner: complex, cached: dict[int, list[Node]]
) -> Iterator[_Option]:
    """Yield the cuttings that fit with the last block in a given layout and place."""
    inner, stamp = area.inner, area.stamp
    parts = tuple(root.parts())
    room = _inner_size(inner)
    leaves = _leaves(root)
    box = (inner[0] + EDGE, inner[1] + EDGE, inner[2] - EDGE, inner[3] - EDGE)
    last = box_at(end, corner)
    # The last block and the title block are one leaf.
    wide = max(box[2] - corner.real, min(stamp[2] - stamp[0] - EDGE, room[0]))
    high = max(corner.imag, stamp[3]) - box[1]
    leaves[-1] = [Leaf(len(parts) - 1, end, wide, high, text=False)]
    turns = _turns(root)
    for asked in (root, *_join_last(root)):
        for node in cuttings(asked, iter(leaves), room, exhaustive=True, cached=cached):
            units = _units(node, last, area)
            if units:
                cost = _unevenness(units, room) + BACK * _eye_return(units, turns, room)
                yield _Option(cost, units, last, node, leaves)


def _units(node: Node, last: Bounds, area: DrawingArea) -> list[Unit]:
    """Return the area of each unit of a cutting, clear of boxes; empty if impossible.

    ``last`` is the box of the last block.
    """
    inner, reserved = area.inner, area.reserved
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
        turn = turns[number_of(node)]
        before = spans.get(turn, (low, high))
        spans[turn] = (min(low, before[0]), max(high, before[1]))
    middles = [(low + high) / 2 for _, (low, high) in sorted(spans.items())]
    return sum(max(0.0, after - before) for before, after in pairwise(middles)) / space[1]


def _step_of_units(units: Sequence[Unit]) -> float:
    """Return `step_of_titles` of the views of units, mm."""
    return step_of_titles(
        (leaf.block, at) for unit in units for leaf, at in corners_of(unit) if not leaf.text
    )


def step_of_titles(views: Iterable[Placed]) -> float:
    """Return the difference of the upper lines of the views that have no view above them, mm."""
    boxes = [box_at(view, corner) for view, corner in views]
    tops = [
        top
        for left, _, right, top in boxes
        if not any(x0 < right and left < x1 and over > top for x0, _, x1, over in boxes)
    ]
    return max(tops, default=0.0) - min(tops, default=0.0)


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
