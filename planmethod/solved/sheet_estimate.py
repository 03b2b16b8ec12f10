"""Space on a sheet (поле листа): its blocks at estimated sizes, packed as on paper.

So scales and formats are chosen without typesetting: `solve` and the sheet use the same
millimetres. The sizes of texts are those of the shipped compositions, by their contents.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from math import inf
from typing import TypeAlias

from msgspec import Struct

from planmethod.paper import STAMP_HEIGHT, STAMP_WIDTH, Format
from planmethod.plans.build import Construction
from planmethod.plans.model import RATES

Box: TypeAlias = tuple[float, float]
BlockSizes: TypeAlias = frozenset[Box]
"""Sizes of a block that can be laid out in several ways."""

Blocks: TypeAlias = "Box | BlockSizes | Sequence[Blocks]"
"""A block, or a group of blocks in reading order."""

FEW = 5
"""Most positions of a homework: each with plans of useful size, all of a kind in one row."""

EDGE, GAP = 5.0, 9.0
"""White between blocks and the frame, and between two blocks, mm."""

CORNER = 14.0
"""Height of graph 26, which is in the upper left corner, mm."""

LETTERS = {"A4": (2.5, 2.5), "A3": (3.5, 2.5), "A2": (3.5, 3.0), "A1": (4.2, 3.5), "A0": (5.0, 3.5)}
"""Heights of the texts and of the calculation that a format must have space for, mm."""

_OPTIONS = 8  # maximum number of shapes per run of blocks


class Texts(Struct, frozen=True):
    """Contents of a sheet's texts: numbers of vector equations and of vectors of both plans."""

    equations: tuple[int, int]
    vectors: tuple[int, int]

    @classmethod
    def of(cls, construction: Construction) -> Texts:
        """Return the facts of a construction."""
        plans = [construction.plan(k) for k in RATES]
        one, two = ((len(plan.equations), len(plan.vectors)) for plan in plans)
        return cls((one[0], two[0]), (one[1], two[1]))

    def blocks(self, paper: Format, positions: int) -> Sequence[Blocks]:
        """Return the sizes of "Дано", equations, calculations and table, mm.

        Measured on sheets: an equation is 13 letters wide and 4.3 high, of the calculation every
        vector has nearly two lines.
        """
        return _blocks(self, paper, positions)


@lru_cache(maxsize=128)  # called for every tried scale
def _blocks(texts: Texts, paper: Format, positions: int) -> Sequence[Blocks]:
    letter, small = LETTERS[paper.like or paper.name]
    equations = [(13.2 * letter, 4.3 * letter * (count + 0.3)) for count in texts.equations]
    lines = (4.3 * texts.vectors[0], 3.6 * texts.vectors[1])
    statement, calculations = (
        (50.0 * letter, 7.0 * letter),
        [(41.0 * small, small * n) for n in lines],
    )
    number = sum(texts.vectors)
    height = 55.0 if positions == 1 else 26.0 + 7.5 * min(positions, 12)
    column = 12.2 if positions <= FEW else 14.0
    table = (min(40.0 + column * number, 0.58 * (paper.inner[2] - paper.inner[0])), height)
    if positions == 1:  # enlarged views take the space that other shapes would leave
        return [statement, *equations, *calculations, table]
    narrower = (0.7 * statement[0], statement[1] / 0.7)
    ways = [frozenset({(w, h), (2 * w + 2 * small, h / 2 + small)}) for w, h in calculations]
    return [frozenset({statement, narrower}), *equations, *ways, table]


def fits_format(
    paper: Format,
    texts: Sequence[Blocks],
    views: Sequence[BlockSizes],
    positions: int,
    over: float = 1.0,
) -> bool:
    """Return whether texts and views fit on a format, mm, whose height is multiplied by ``over``.

    ``views`` are the scheme, the velocity and the acceleration plans. They are grouped as in the
    shipped compositions for one, for a few and for many positions.
    """
    left, low, right, high = paper.inner
    room = (right - left - 2 * EDGE, over * (high - low - 2 * EDGE))
    statement, one, two, reckoned, reckoned_too, table = texts
    assert isinstance(table, tuple)
    wide, tall = table
    schemes, velocity, acceleration = views
    scheme = frozenset((width, height + CORNER) for width, height in schemes)
    lasts = [(max(wide, STAMP_WIDTH - EDGE), tall + STAMP_HEIGHT)]
    if wide > STAMP_WIDTH:
        lasts.append((wide + STAMP_WIDTH, max(tall, STAMP_HEIGHT - EDGE)))
    last_shapes = [_best([last], room) for last in lasts]
    if positions == 1:
        groups = [
            shapes([scheme, statement], room),
            shapes([velocity, [one, reckoned]], room),
            shapes([acceleration, [two, reckoned_too]], room),
        ]
        return any(_groups_fit(groups, last, room) for last in last_shapes)
    first = shapes([scheme, statement, [one, two]], room)
    plans = [shapes(velocity, room), shapes(acceleration, room)]
    if positions > FEW:
        return any(_groups_fit([first, *plans], last, room) for last in last_shapes)
    plans.append(shapes([reckoned, reckoned_too], room))
    return any(_groups_fit([first], _in_order((*plans, last), room), room) for last in last_shapes)


def _groups_fit(groups: list[tuple[Box, ...]], last: tuple[Box, ...], area: Box) -> bool:
    """Return whether groups and a last one fit; their areas are compared first."""
    whole = (*groups, last)
    if not all(whole):
        return False
    least = sum(min(width * height for width, height in group) for group in whole)
    return least <= area[0] * area[1] * (1 + 1e-9) and bool(_in_order(whole, area))


def shapes(blocks: Blocks, area: Box) -> tuple[Box, ...]:
    """Return the possible sizes of packed blocks within an area, none worse in both directions."""
    if isinstance(blocks, tuple):
        blocks = frozenset({blocks})
    if isinstance(blocks, frozenset):
        return _best(list(blocks), area)
    return _in_order(tuple(shapes(block, area) for block in blocks), area)


@lru_cache(maxsize=1024)  # most blocks of a new trial are unchanged
def _in_order(blocks: tuple[tuple[Box, ...], ...], area: Box) -> tuple[Box, ...]:
    """Return the sizes of blocks in reading order, of each of which several sizes are known."""
    kept = {(k, k + 1): block for k, block in enumerate(blocks)}
    for length in range(2, len(blocks) + 1):
        for start in range(len(blocks) - length + 1):
            end = start + length
            found: list[Box] = []
            for middle in range(start + 1, end):
                for a, b in kept[start, middle]:
                    for c, d in kept[middle, end]:
                        found.append((a + GAP + c, b if b > d else d))
                        found.append((a if a > c else c, b + GAP + d))
            kept[start, end] = _best(found, area)
    return kept[0, len(blocks)]


def _best(boxes: list[Box], area: Box) -> tuple[Box, ...]:
    wide, least = area[0], inf
    if len(boxes) == 1:
        ((width, height),) = boxes
        return tuple(boxes) if width <= wide and height <= area[1] else ()
    best: list[Box] = []
    for box in sorted(box for box in boxes if box[1] <= area[1] and box[0] <= wide):
        if box[1] < least:
            best.append(box)
            least = box[1]
    if len(best) <= _OPTIONS:
        return tuple(best)
    return tuple(best[round(k * (len(best) - 1) / (_OPTIONS - 1))] for k in range(_OPTIONS))
