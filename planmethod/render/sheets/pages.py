"""Pages: blocks put on sheets, and what the title blocks of the sheets say."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

from planmethod.problem.model import Problem
from planmethod.render.block import Block
from planmethod.render.drawing import Bounds, Item, View
from planmethod.render.pack import pack
from planmethod.render.sheets.views import Viewed


def stamp_fields(
    problem: Problem, sheet: int, sheets: int, extra: Mapping[str, str]
) -> dict[str, str]:
    """Return the texts of the title block: the defaults, the problem's, then the asked ones.

    The number of the sheet stays empty on a single one, as the standard has it; of several sheets
    the computed numbers outrank the file's.
    """
    numbers = {"sheet": str(sheet), "sheets": str(sheets)}
    fields = {"title": problem.title, "sheets": "1", **problem.stamp}
    fields.update(numbers if sheets > 1 else {})
    fields.update(extra)
    return {key: value for key, value in fields.items() if value}


@dataclass(frozen=True, slots=True)
class Page:
    """What is inside the frame of one sheet."""

    items: list[Item]
    views: list[View]


def divided(blocks: Sequence[Block], count: int, inner: Bounds, stamp: Bounds) -> list[Page] | None:
    """Return blocks put on so many sheets in reading order, the sheets as evenly full as can be."""
    areas = [block.width * block.height for block in blocks]

    def fullest(cuts: tuple[int, ...]) -> float:
        edges = (0, *cuts, len(blocks))
        return max(sum(areas[i:j]) for i, j in pairwise(edges))

    for cuts in sorted(combinations(range(1, len(blocks)), count - 1), key=fullest):
        parts = [blocks[i:j] for i, j in pairwise((0, *cuts, len(blocks)))]
        packed = [pack(part, inner, stamp) for part in parts]
        if None not in packed:
            return [_page(part, at) for part, at in zip(parts, packed, strict=True) if at]
    return None


def _page(blocks: Sequence[Block], corners: Sequence[complex]) -> Page:
    page = Page([], [])
    for block, corner in zip(blocks, corners, strict=True):
        items = block.place(corner)
        page.items.extend(items)
        if isinstance(block, Viewed):
            page.views.append(block.view(items, corner))
    return page
