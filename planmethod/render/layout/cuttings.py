"""Cuttings of a sheet by straight lines (раскрой листа), and the areas that blocks get by them.

For each run of blocks in reading order the cuttings are kept that no other beats in both width and
height.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from operator import itemgetter
from typing import TypeAlias

from msgspec import Struct
from msgspec.structs import replace

from planmethod.render.ink.drawing import Bounds
from planmethod.render.layout.block import Block
from planmethod.render.layout.groups import GAP, Group, LayoutItem

_OPTIONS = 12  # cuttings kept for one run of blocks: widths from the narrowest to the widest


class Leaf(Struct, frozen=True):
    """A block by its number, in one of its layouts, and its size, mm."""

    number: int
    block: Block
    width: float
    height: float
    text: bool
    group: bool = False


class GuillotineCut(Struct, frozen=True):
    """Two parts side by side (``is_stacked`` false) or one above the other.

    ``text``: all its blocks are texts, which stay together; ``group``: it is a whole group.
    """

    first: Node
    second: Node
    is_stacked: bool
    width: float
    height: float
    text: bool
    group: bool = False


Node: TypeAlias = "Leaf | GuillotineCut"
Unit: TypeAlias = tuple[Node, Bounds]
"""A block, or texts that stay together, and its area."""


_Size: TypeAlias = "tuple[float, float, Node, Node, bool]"
"""Width and height of a cut, its parts, and whether one is above the other."""


def node_fits(node: Node, space: tuple[float, float]) -> bool:
    """Return whether a part of the sheet fits an area of a width and height, mm."""
    return node.width <= space[0] + 1e-6 and node.height <= space[1] + 1e-6


# Cuttings -----------------------------------------------------------------------------------------


def cuttings(
    group: Group,
    leaves: Iterator[Sequence[Leaf]],
    space: tuple[float, float],
    *,
    exhaustive: bool = False,
    cached: dict[int, list[Node]] | None = None,
) -> list[Node]:
    """Return cuttings of a group, none narrower and lower than another.

    For the ``exhaustive`` sheet all cuttings that fit are returned, to be compared by their white.
    ``cached`` caches the cuttings of groups, by their identity, for further sheets of the same
    area; it must have an empty entry for each group to be cached.
    """
    options: list[list[Node]] = []
    for member in group.members:
        if isinstance(member, LayoutItem):
            options.append(list(next(leaves)))
        elif cached is not None and cached.get(id(member)):
            options.append(cached[id(member)])
            _ = [next(leaves) for _ in member.parts()]
        else:
            made: list[Node] = [
                replace(node, group=True) for node in cuttings(member, leaves, space)
            ]
            if cached is not None and id(member) in cached:
                cached[id(member)] = made
            options.append(made)
    ways = {"row": (False,), "column": (True,)}.get(group.arrange, (False, True))
    count = len(options)
    kept: dict[tuple[int, int], list[Node]] = {(k, k + 1): options[k] for k in range(count)}
    for length in range(2, count + 1):
        for start in range(count - length + 1):
            end = start + length
            found = [
                size
                for middle in range(start + 1, end)
                for size in _sizes(kept[start, middle], kept[middle, end], ways, space)
            ]
            chosen = found if exhaustive and length == count else _pareto(found)
            kept[start, end] = [_joined(*size) for size in chosen]
    return [node for node in kept[0, count] if node_fits(node, space)]


def _sizes(
    ones: Sequence[Node],
    twos: Sequence[Node],
    directions: Sequence[bool],
    space: tuple[float, float],
) -> Iterator[_Size]:
    """Yield the sizes of all cuts of two parts that fit: most of them are discarded."""
    wide, tall = space[0] + 1e-6, space[1] + 1e-6
    twos_sizes = [(two, two.width, two.height) for two in twos]
    for one in ones:
        width, height = one.width, one.height
        for two, second_width, second_height in twos_sizes:
            for across in directions:
                if across:
                    w = width if width >= second_width else second_width
                    h = height + GAP + second_height
                else:
                    w = width + GAP + second_width
                    h = height if height >= second_height else second_height
                if w <= wide and h <= tall:
                    yield w, h, one, two, across


def _joined(width: float, height: float, one: Node, two: Node, is_stacked: bool) -> GuillotineCut:
    return GuillotineCut(one, two, is_stacked, width, height, one.text and two.text)


def _pareto(sizes: list[_Size]) -> list[_Size]:
    """Return the sizes that no other beats in both dimensions, thinned to a few."""
    sizes.sort(key=itemgetter(0, 1))
    best: list[_Size] = []
    for size in sizes:
        if not best or size[1] < best[-1][1] - 1e-9:
            best.append(size)
    if len(best) <= _OPTIONS:
        return best
    step = (len(best) - 1) / (_OPTIONS - 1)
    return [best[round(k * step)] for k in range(_OPTIONS)]


# Larger layouts -----------------------------------------------------------------------------------


def grow(node: Node, alternatives: Sequence[Sequence[Leaf]], space: tuple[float, float]) -> Node:
    """Return a cutting whose blocks have larger layouts, as far as all of it fits the area.

    A larger layout is wider or higher and nowhere smaller: a picture at a larger scale. Blocks grow
    in turn, a layout each. ``alternatives`` are the layouts of every block by its number, empty for
    blocks that do not grow.
    """
    standing = {leaf.number: leaf for leaf in _leaves(node)}
    refused: list[Leaf] = []
    turns = list(standing)
    while turns:
        for number in tuple(turns):
            now = standing[number]
            larger = [
                way for way in alternatives[number] if _is_larger(way, now) and way not in refused
            ]
            if not larger:
                turns.remove(number)
                continue
            way = min(larger, key=lambda way: way.width * way.height)
            tried = _replace_leaf(node, replace(way, group=now.group))
            if node_fits(tried, space):
                node, standing[number] = tried, way
            else:
                refused.append(way)  # it will not fit when others have grown either
    return node


def _is_larger(one: Leaf, two: Leaf) -> bool:
    wider, higher = one.width - two.width, one.height - two.height
    return min(wider, higher) >= 0.0 and max(wider, higher) > 0.0


def _leaves(node: Node) -> Iterator[Leaf]:
    if isinstance(node, Leaf):
        yield node
    else:
        yield from _leaves(node.first)
        yield from _leaves(node.second)


def _replace_leaf(node: Node, leaf: Leaf) -> Node:
    """Return a cutting with a block in another layout."""
    if isinstance(node, Leaf):
        return leaf if node.number == leaf.number else node
    one, two = _replace_leaf(node.first, leaf), _replace_leaf(node.second, leaf)
    both = ((one.width, two.width), (one.height, two.height))
    wide, high = (max, sum) if node.is_stacked else (sum, max)
    gap = complex(0.0, GAP) if node.is_stacked else complex(GAP, 0.0)
    return replace(
        node, first=one, second=two, width=wide(both[0]) + gap.real, height=high(both[1]) + gap.imag
    )


# Room ---------------------------------------------------------------------------------------------


def units_of(
    node: Node, box: Bounds, *, anchored: bool, groups_joined: bool = False
) -> Iterator[Unit]:
    """Yield the area that each unit gets when the spare white is divided at every cut.

    The ``anchored`` part ends in the lower right corner of the sheet; other groups are contracted
    within their areas. ``groups_joined``: white is right of the blocks, which are of one group.
    """
    if isinstance(node, Leaf) or node.text or (node.group and not anchored):
        yield node, box
        return
    left, low, right, high = box
    groups_joined = groups_joined or node.group
    if node.is_stacked:
        spare = high - low - node.height
        cut = high - node.first.height - spare * _white_fraction(node, is_stacked=True) - GAP / 2
        first, second = (left, cut + GAP / 2, right, high), (left, low, right, cut - GAP / 2)
    else:
        spare = right - left - node.width
        share = 0.0 if groups_joined else _white_fraction(node, is_stacked=False)
        cut = left + node.first.width + spare * share + GAP / 2
        first, second = (left, low, cut - GAP / 2, high), (cut + GAP / 2, low, right, high)
    yield from units_of(node.first, first, anchored=False, groups_joined=groups_joined)
    yield from units_of(node.second, second, anchored=anchored, groups_joined=groups_joined)


def _white_fraction(node: GuillotineCut, *, is_stacked: bool) -> float:
    """Return the first part's share of spare white: by the number of blocks in that direction."""
    one, two = _steps(node.first, is_stacked=is_stacked), _steps(node.second, is_stacked=is_stacked)
    return one / (one + two)


def _steps(node: Node, *, is_stacked: bool) -> int:
    if isinstance(node, Leaf) or node.text:
        return 1
    one, two = _steps(node.first, is_stacked=is_stacked), _steps(node.second, is_stacked=is_stacked)
    return one + two if node.is_stacked is is_stacked else max(one, two)


def box_of(unit: Unit) -> Bounds:
    """Return the box of a unit's blocks, centred in their area."""
    node, (left, low, right, high) = unit
    return box_at(node, complex(left + right - node.width, low + high + node.height) / 2)


def box_at(block: Block | Node, corner: complex) -> Bounds:
    """Return the box of a block whose upper left corner is at a place, mm."""
    return (corner.real, corner.imag - block.height, corner.real + block.width, corner.imag)


def boxes_of(units: Iterable[Unit]) -> list[Bounds]:
    """Return the boxes of all blocks of units."""
    return [box_at(leaf, at) for unit in units for leaf, at in corners_of(unit)]


def corners_of(unit: Unit) -> Iterator[tuple[Leaf, complex]]:
    """Yield a unit's blocks with their upper left corners, the unit centred in its box."""
    left, _, _, high = box_of(unit)
    yield from _leaf_corners(unit[0], complex(left, high))


def number_of(node: Node) -> int:
    """Return the number of the first block of a part."""
    return node.number if isinstance(node, Leaf) else number_of(node.first)


def _leaf_corners(node: Node, corner: complex) -> Iterator[tuple[Leaf, complex]]:
    if isinstance(node, Leaf):
        yield node, corner
        return
    yield from _leaf_corners(node.first, corner)
    step = -1j * (node.first.height + GAP) if node.is_stacked else node.first.width + GAP
    yield from _leaf_corners(node.second, corner + step)


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
