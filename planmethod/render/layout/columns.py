"""Columns of a sheet (столбцы листа): blocks in reading order, with common left edges.

Groups are stacked in columns from the left; the last block is above the title block or beside it,
and columns over it are shorter. Each column is as narrow as its height permits. The division is
taken whose white is least uneven and leaves the smallest hole; what white remains is under the
columns and, evenly, between them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from heapq import nsmallest
from itertools import count, pairwise
from operator import itemgetter
from typing import NamedTuple

from planmethod.render.ink.drawing import Bounds
from planmethod.render.layout.block import DrawingArea
from planmethod.render.layout.cuttings import (
    Leaf,
    Node,
    Unit,
    boxes_of,
    cuttings,
    largest_empty_fraction,
    number_of,
)
from planmethod.render.layout.groups import EDGE, GAP, Group, LayoutItem

MOST = 6
"""Largest number of columns."""

LOOSE = 9.0
"""White that may be added to the gap between groups of a column, mm."""

VOID = 6.0
"""Cost of an empty rectangle as large as the field."""

BROKEN = 0.04
"""Cost of a column that goes on with a view of a group; with a text of a view none does."""

ROOT = 0
"""Number of the group of the whole sheet."""

_STACKS = 16  # stacks kept for a run of groups: from the narrowest to the widest
_MEASURED = 24  # divisions with the least uneven white: their holes are measured


class Stack(NamedTuple):
    """Parts of the sheet one under another, each in one of its shapes; sizes in mm."""

    width: float
    height: float
    nodes: tuple[Node, ...]


class Division(NamedTuple):
    """Columns of a sheet: their stacks, left edges and heights from the top to the floor, mm."""

    cost: float
    stacks: tuple[Stack, ...]
    lefts: tuple[float, ...]
    heights: tuple[float, ...]


class ColumnSheet(NamedTuple):
    """The best division with its parts placed."""

    cost: float
    units: list[Unit]


class Member(NamedTuple):
    """A part that is never divided, by the numbers of its blocks, and the group that it is of."""

    member: LayoutItem | Group
    blocks: slice
    group: int
    is_free: bool

    @property
    def is_text(self) -> bool:
        """True if all its blocks are texts."""
        one = self.member
        return all(part.text for part in (one.parts() if isinstance(one, Group) else (one,)))


class Columns:
    """Divisions of the blocks before the last one into columns.

    Parameters
    ----------
    root : Group
        Blocks in reading order.
    leaves : sequence of sequence of Leaf
        The layouts of each.
    area : DrawingArea
        No reserved box is within its inside.
    """

    def __init__(self, root: Group, leaves: Sequence[Sequence[Leaf]], area: DrawingArea) -> None:
        self.area, self.leaves = area, leaves
        left, low, right, high = area.inner
        self.box = (left + EDGE, low + EDGE, right - EDGE, high - EDGE)
        *self.members, _ = _members(root, count())
        self.groups = {k: one.group for one in self.members for k in range(len(leaves))[one.blocks]}
        self.stacks = self._stacked()

    def _stacked(self) -> dict[tuple[int, int], list[Stack]]:
        """Return the stacks of each run of members that fit the sheet, by its ends."""
        space, every = (self.box[2] - self.box[0], self.box[3] - self.box[1]), self.members
        shapes = {
            (start, end): self._shapes(every[start:end], space)
            for start in range(len(every))
            for end in range(start + 1, len(every) + 1)
            if end == start + 1 or _is_joined(every[start:end])
        }
        found: dict[tuple[int, int], list[Stack]] = {}
        for start in range(len(every)):
            found[start, start] = [Stack(0.0, -GAP, ())]
            for end in range(start + 1, len(every) + 1):
                stacks = [
                    Stack(max(w, node.width), h + GAP + node.height, (*nodes, node))
                    for middle in range(start, end)
                    for node in shapes.get((middle, end), ())
                    for w, h, nodes in found[start, middle]
                ]
                found[start, end] = _lowest([one for one in stacks if one.height <= space[1]])
        return found

    def _shapes(self, members: Sequence[Member], space: tuple[float, float]) -> list[Node]:
        """Return the shapes of members of one group, joined if there are several."""
        first, last = members[0], members[-1]
        leaves = self.leaves[first.blocks.start : last.blocks.stop]
        if first is last and isinstance(first.member, LayoutItem):
            return list(leaves[0])
        one = first.member if first is last else Group(tuple(one.member for one in members))
        assert isinstance(one, Group)
        return cuttings(one, iter(leaves), space)

    def sheet(self, last: Bounds) -> ColumnSheet | None:
        """Return the best division beside and above the last block in its box, if one fits.

        If none does, the first members are beside each other at the top, above the columns.
        """
        best: ColumnSheet | None = None
        for first in range(len(self.members)):
            above = self._row(first)
            if above is None:
                break
            if any(_is_near(box, fixed) for _, box in above for fixed in (last, self.area.stamp)):
                continue
            top = min((box[1] - 2.0 * GAP for _, box in above), default=self.box[3])
            found = self._divisions(last, first, top)
            for division in nsmallest(_MEASURED, found, key=itemgetter(0)):
                if best is not None and division.cost >= best.cost:  # and so are all that follow
                    break
                placed = self._placed(division, last, above, top)
                best = placed if best is None or placed.cost < best.cost else best
            if best is not None and first == 0:
                break
        return best

    def _row(self, count: int) -> list[Unit] | None:
        """Return the first members beside each other, as low as the width permits, or None."""
        left, _, right, top = self.box
        stacks = [self.stacks[k, k + 1] for k in range(count)]
        for high in sorted({one.height for some in stacks for one in some}):
            chosen = [one for some in stacks if (one := _narrowest(some, high)) is not None]
            spare = right - left - sum(one.width + GAP for one in chosen) + GAP
            if len(chosen) == count and spare >= 0.0:
                groups = [one.group for one in self.members[:count]]
                is_end = [*(one != two for one, two in pairwise(groups)), True]
                lefts = _edges(left, [one.width for one in chosen], spare, is_end)
                return [
                    (one.nodes[0], (at, top - one.height, at + one.width, top))
                    for one, at in zip(chosen, lefts, strict=True)
                ]
        return None if count else []

    def _divisions(self, last: Bounds, first: int, top: float) -> Iterator[Division]:
        """Yield the divisions that fit: some columns left of the last block, others over it.

        They begin with a member, ``first``, at the ``top``, mm.
        """
        left, low, right, _ = self.box
        stamp = self.area.stamp
        limit = min(last[0], stamp[0]) - GAP
        over = top - max(last[3], stamp[3]) - GAP
        ends = len(self.members)
        chosen: list[Stack] = []

        def grown(start: int, left_count: int, used: float, cost: float) -> Iterator[Division]:
            """Yield the divisions that go on from a member, with a width that is used."""
            if start == ends:
                yield from self._spread(chosen, left_count, limit, (top - low, over), last[0], cost)
                return
            for is_beside in (True, False):
                if len(chosen) == MOST or (is_beside and left_count < len(chosen)):
                    continue
                edge = limit if is_beside else right
                for end in range(start + 1, ends + 1):
                    options = self.stacks[start, end]
                    stack = _narrowest(options, top - low if is_beside else over)
                    if stack is None:
                        break
                    if left + used + stack.width > edge + 1e-6:
                        continue
                    is_broken = end < ends and self._is_continued(end)
                    if is_broken and self._parts_text(end):
                        continue
                    chosen.append(stack)
                    more = cost + BROKEN * is_broken
                    yield from grown(end, left_count + is_beside, used + stack.width + GAP, more)
                    chosen.pop()

        yield from grown(first, 0, 0.0, 0.0)

    def _is_continued(self, start: int) -> bool:
        """Return whether a column that begins with a member goes on with a group."""
        before, after = self.members[start - 1 : start + 1]
        return before.group == after.group

    def _ends_group(self, one: Stack, two: Stack) -> bool:
        """Return whether a column begins with another group than the one before it ends with."""
        return self.groups[number_of(one.nodes[-1])] != self.groups[number_of(two.nodes[0])]

    def _parts_text(self, start: int) -> bool:
        """Return whether a column parts a text from its view, or from the plan that it leads to."""
        before, after = self.members[start - 1 : start + 1]
        return after.is_text or (before.is_text and before.group != ROOT)

    def _spread(
        self,
        stacks: Sequence[Stack],
        left_count: int,
        limit: float,
        heights: tuple[float, float],
        edge: float,
        cost: float,
    ) -> Iterator[Division]:
        """Yield a division with the spare width divided evenly, if its columns fit.

        Columns over the last block begin at its left edge if they can, and at that of the sheet if
        none is beside them.
        """
        left, low, right, high = self.box
        wide = [stack.width for stack in stacks]
        begin = left + sum(wide[:left_count]) + GAP * left_count
        if left_count < len(stacks):
            taken = sum(wide[left_count:]) + GAP * (len(stacks) - left_count - 1)
            begin = max(begin, min(edge, right - taken)) if left_count else left
            spares = min(limit, begin - GAP) - left, right - begin - taken
        else:
            spares = limit - left, 0.0
        first = sum(wide[:left_count]) + GAP * (left_count - 1) if left_count else spares[0]
        spares = spares[0] - first, spares[1]
        if min(spares) < -1e-6:
            return
        is_end = [*(self._ends_group(one, two) for one, two in pairwise(stacks)), True]
        lefts = (
            *_edges(left, wide[:left_count], spares[0], is_end[:left_count]),
            *_edges(begin, wide[left_count:], spares[1], is_end[left_count:]),
        )
        spaces = tuple(heights[k >= left_count] for k in range(len(stacks)))
        for stack, space in zip(stacks, spaces, strict=True):
            cost += ((space - stack.height) / (high - low)) ** 2 * stack.width / (right - left)
        cost += sum((spare / (right - left)) ** 2 for spare in spares)
        yield Division(cost, tuple(stacks), lefts, spaces)

    def _placed(
        self, division: Division, last: Bounds, above: Sequence[Unit], top: float
    ) -> ColumnSheet:
        """Return a division with its parts placed: white under the columns, or between groups."""
        tries: list[tuple[float, list[Unit]]] = []
        for most in (LOOSE, 4 * LOOSE):
            units = list(above)
            for stack, left, high in zip(*division[1:], strict=True):
                groups = [self.groups[number_of(node)] for node in stack.nodes]
                ends = [one != two for one, two in pairwise(groups)]
                loose = min(most, (high - stack.height) / (1 + sum(ends)))
                line = top
                for node, is_end in zip(stack.nodes, (*ends, False), strict=True):
                    low = line - node.height
                    units.append((node, (left, low, left + node.width, line)))
                    line = low - GAP - (loose if is_end else 0.0)
            boxes = [*boxes_of(units), last, self.area.stamp]
            hole = largest_empty_fraction(boxes, self.area.inner)
            tries.append((hole, units))
        hole, units = min(tries, key=itemgetter(0))
        return ColumnSheet(division.cost + VOID * hole, units)


def _members(root: Group, numbers: Iterator[int], first: int = 0) -> Iterator[Member]:
    """Yield the members of a group and of those in it; one in a row is not divided.

    ``first`` is the number of the first block.
    """
    group = next(numbers)
    for one in root.members:
        size = sum(1 for _ in one.parts()) if isinstance(one, Group) else 1
        if isinstance(one, Group) and one.arrange != "row":
            yield from _members(one, numbers, first)
        else:
            yield Member(one, slice(first, first + size), group, root.arrange == "free")
        first += size


def _is_near(one: Bounds, fixed: Bounds) -> bool:
    """Return whether a box would cover one at the right lower corner, or its margin."""
    return one[2] > fixed[0] - GAP and one[1] < fixed[3] + GAP


def _is_joined(members: Sequence[Member]) -> bool:
    """Return whether members may be side by side: all are of one group, freely arranged."""
    return members[0].is_free and len({one.group for one in members}) == 1


def _lowest(stacks: list[Stack]) -> list[Stack]:
    """Return the stacks that no other beats in both dimensions, thinned to a few."""
    best: list[Stack] = []
    for stack in sorted(stacks, key=itemgetter(0, 1)):
        if not best or stack.height < best[-1].height - 1e-9:
            best.append(stack)
    if len(best) <= _STACKS:
        return best
    step = (len(best) - 1) / (_STACKS - 1)
    return [best[round(k * step)] for k in range(_STACKS)]


def _narrowest(stacks: Sequence[Stack], height: float) -> Stack | None:
    """Return the narrowest stack that is not higher; they are sorted by width."""
    return next((one for one in stacks if one.height <= height + 1e-6), None)


def _edges(
    start: float, widths: Sequence[float], spare: float, is_end: Sequence[bool]
) -> list[float]:
    """Return the left edges of columns, the spare width divided evenly to the right of groups.

    ``is_end`` is True for each column whose next one begins with another group.
    """
    white = spare / max(1, sum(is_end))
    edges = []
    for width, ends in zip(widths, is_end, strict=True):
        edges.append(start)
        start += width + GAP + (white if ends else 0.0)
    return edges
