"""Pages: the blocks of a composition put on sheets of a paper."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from itertools import combinations, groupby, pairwise
from math import inf
from typing import TypeAlias

from msgspec import Struct
from msgspec.structs import replace

from planmethod.paper import paper_format
from planmethod.render.layout.block import Alternatives, Block, Column, DrawingArea, Row
from planmethod.render.layout.groups import EDGE, GAP, Arrange, Group, LayoutItem, Placed
from planmethod.render.layout.pack import step_of_titles
from planmethod.render.sheets.blocks import BLOCKS, maker_of
from planmethod.render.sheets.composer import (
    PageLayout,
    TrialPaper,
    ViewBlock,
    claimed_area,
    free_area,
    pack_group,
)
from planmethod.render.sheets.model import BlockOptions, BlockSpec, BlockStyle, Composition
from planmethod.solved.legibility import FEW
from planmethod.solved.solution import Solution

Parts: TypeAlias = "list[list[Placed]]"
"""Blocks and their corners, by pages."""

MAX_EXTRA = 4
"""Largest number of sheets for one sheet of a composition on a requested format."""

CONTINUABLE = ("calculation",)
"""Kinds of blocks that may move to a continuation sheet.

With many positions they are then only in the protocol: these sheets are full of plans.
"""

CONTINUED = "A4"
"""Format of that sheet if none is requested."""

DISSOLVED = (3,)
"""Level of ungrouping at which no blocks stay together."""

MAX_DIVISIONS = 60
"""Largest number of divisions of blocks among pages that are tried."""


class BuiltBlock(Struct, frozen=True):
    """A finished block, and its entry of the file."""

    entry: BlockSpec
    block: Block

    @property
    def is_text(self) -> bool:
        """True if it is not a view."""
        one = self.block.blocks[0] if isinstance(self.block, Alternatives) else self.block
        return not isinstance(one, ViewBlock)


class PageTrial(Struct, frozen=True):
    """Trial of a composition on a paper; ``fraction`` is that of the composition's sizes.

    ``keeps_groups``: groups are not dissolved, and all blocks are on the single page.
    """

    composition: Composition
    paper: TrialPaper
    options: BlockOptions
    fraction: float = 1.0
    keeps_groups: bool = False

    def pages(
        self, solution: Solution, position_indices: Sequence[int], first: int = 1
    ) -> list[PageLayout] | None:
        """Return the sheets that show some positions, or None when one of them does not fit.

        ``first`` is the number of the first sheet.
        """
        pages: list[PageLayout] = []
        for number in self.composition.sheets:
            at = first + len(pages)
            found = None
            for trial in self._on_own_formats(number):
                with trial.paper.using_pens():
                    stock = _BlockCache(solution, position_indices, {})
                    found = trial._sheet(number, stock, at)
                if found is not None:
                    break
            if found is None:
                return None
            pages += found
        return pages

    def _on_own_formats(self, number: int) -> Iterator[PageTrial]:
        """Yield the trials of a sheet on its own formats, if it has some and none is required."""
        paper, names = self.paper, self.composition.sheet_spec(number).formats
        for name in () if paper.is_required else names:
            yield replace(self, paper=replace(paper, format=paper_format(name)))
        if paper.is_required or not names:
            yield self

    def _sheet(self, number: int, stock: _BlockCache, first: int) -> list[PageLayout] | None:
        """Return a sheet of a composition: a page, perhaps several, or None when it does not fit.

        For the order of trials see `_tries`.
        """
        composition, paper, solution = self.composition, self.paper, stock.solution
        entries = spread([entry for entry in composition.blocks if entry.sheet == number], solution)
        sizes = composition.sizes_for(paper.name, self.fraction)
        alone = len(solution.positions) == 1
        for count, level, dropped, taken_apart in _tries(
            composition.levels,
            droppable=not self.keeps_groups and any(entry.droppable for entry in entries),
            max_pages=MAX_EXTRA
            if paper.is_required
            and (alone or solution.problem.scales.decided)
            and not self.keeps_groups
            else 1,
        ):
            if self.keeps_groups and taken_apart == DISSOLVED:
                continue
            rooms = [paper.drawing_area(first + k) for k in range(count)]
            inside = rooms[0].inner[2] - rooms[0].inner[0]
            manners = [
                BlockStyle(entry, sizes, inside, self.options, level)
                for entry in entries
                if not (dropped and entry.droppable)
            ]
            made = stock.build(manners, sum(map(free_area, rooms)))
            if made is None:
                continue
            arranged = composition.arranged
            parts, apart = _divide(made, rooms, arranged, taken_apart)
            if parts and count == 1:
                parts = _with_larger_texts(parts, manners, stock, rooms, arranged, apart)
            if parts:
                spec, tried = composition.sheet_spec(number), (dropped, level, apart)
                title, name = spec.title, paper.name if spec.formats else ""
                pages = [PageLayout(part, title, tried, name) for part in parts]
                going = dropped and len(solution.positions) <= FEW
                left_out = [entry for entry in entries if going and entry.kind in CONTINUABLE]
                return pages + self._continue_texts(left_out, stock, title)
        return None

    def _continue_texts(
        self, entries: Sequence[BlockSpec], stock: _BlockCache, title: str
    ) -> list[PageLayout]:
        """Return continuation sheets for left-out texts: one for all, otherwise one for each."""
        composition, paper = self.composition, self.paper
        name = paper.name if paper.is_required else CONTINUED
        around, sizes = paper.continued(name), composition.sizes_for(name)
        left, _, right, high = around.inner
        room = (right - left - 2 * EDGE, high - around.stamp[3] - 2 * EDGE)
        tries: list[tuple[int, list[Block]]] = []
        for level in range(composition.levels) if entries else ():
            manners = [
                BlockStyle(entry, sizes, right - left, self.options, level) for entry in entries
            ]
            blocks = [one.block for one in stock.build(manners, inf) or ()]
            tries += [(level, [Column(blocks, gap=GAP)]), (level, [Row(blocks, gap=GAP)])]
            tries.append((level + composition.levels, blocks))
        for level, texts in sorted(tries, key=lambda one: one[0]):
            if all(one.width <= room[0] and one.height <= room[1] for one in texts):
                tried = (False, level, 0)
                corner = complex(left + EDGE, high - EDGE)
                return [
                    PageLayout([(one, corner)], title, tried, name, is_continuation=True)
                    for one in texts
                ]
        return []


def _with_larger_texts(
    parts: Parts,
    manners: list[BlockStyle],
    stock: _BlockCache,
    drawing_areas: Sequence[DrawingArea],
    arranged: Mapping[tuple[str, ...], Arrange],
    ungrouping: int,
) -> Parts:
    """Return a page with the texts of each kind in larger letters, if they fit.

    All letters of a sheet shrink alike until everything fits; the remaining space goes to the texts
    with the smallest letters, so that none are twice as high as others. Texts of the forces, which
    are many and short, have one height; of two calculations one may be enlarged alone, where it
    stays beside its plan. With many positions the table, which has the results, is enlarged before
    the calculations.
    """
    scalable = {k: _family(m.entry) for k, m in enumerate(manners) if m.entry.heights}
    waiting = [[k for k, own in scalable.items() if own == kind] for kind in {*scalable.values()}]
    alone: list[list[int]] = []
    many = len(stock.position_indices) > FEW

    def turn(some: list[int]) -> tuple[float, bool, list[int]]:
        own = manners[some[0]]
        return own.text(0.0), many and own.entry.kind in CONTINUABLE, some

    while waiting or alone:
        own = min(waiting or alone, key=turn)
        least = min(manners[k].text(0.0) for k in scalable)
        larger = list(manners)
        for k in own:
            larger[k] = manners[k].larger(below=2.0 * least)
        made = (
            stock.build(larger, sum(map(free_area, drawing_areas))) if larger != manners else None
        )
        levels = range(ungrouping + 1)
        found, level = _divide(made, drawing_areas, arranged, levels) if made else ([], 0)
        if found and _step_of_titles(made, found) <= _step_of_titles(made, parts) + 1e-6:
            parts, manners, ungrouping = found, larger, level
        else:
            (waiting or alone).remove(own)
            if len(own) > 1 and larger != manners and manners[own[0]].entry.kind in CONTINUABLE:
                alone += [[k] for k in own]
    return parts


def _step_of_titles(built: Sequence[BuiltBlock] | None, parts: Parts) -> float:
    """Return the largest step between titles of the first row on a page, mm."""
    texts = iter([one.is_text for one in built or ()])
    return max(step_of_titles([one for one in page if not next(texts)]) for page in parts)


def _family(entry: BlockSpec) -> str:
    """Return the family of texts of one height: the forces, otherwise the kind of the block."""
    kind = BLOCKS[entry.kind].makers
    return kind.__name__ if kind is BLOCKS["loads"].makers else entry.kind


def spread(entries: Sequence[BlockSpec], solution: Solution) -> list[BlockSpec]:
    """Return entries, with those of force plans repeated for each plan.

    Consecutive entries of this kind form a group of their own for every plan: for those of the
    structural groups, the last one first, and for those of the drivers.
    """
    found: list[BlockSpec] = []
    for each, run in groupby(entries, lambda entry: BLOCKS[entry.kind].each):
        own = list(run)
        if not each:
            found += own
            continue
        for k in range(len(solution.structure.groups) + len(solution.problem.drive.links)):
            found += [replace(e, number=k, group=(*e.group, f"plan-{k + 1}")) for e in own]
    return found


class _BlockCache(Struct, frozen=True):
    """Cache of the blocks of a sheet: repeated trials do not make them again."""

    solution: Solution
    position_indices: Sequence[int]
    blocks: dict[tuple[int, int, float], Block]

    def build(self, manners: Sequence[BlockStyle], area: float) -> list[BuiltBlock] | None:
        """Return the blocks of a sheet, or None when they claim more than ``area``, mm².

        The scheme, whose letters take longest to place, is made last.
        """
        found: dict[int, Block] = {}
        for k in sorted(range(len(manners)), key=lambda k: manners[k].entry.kind == "scheme"):
            found[k] = self._block(manners[k])
            area -= claimed_area(found[k])
            if area < 0.0:
                return None
        made = (BuiltBlock(style.entry, found[k]) for k, style in enumerate(manners))
        return [one for one in made if one.block.height]

    def _block(self, style: BlockStyle) -> Block:
        entry = style.entry
        level = min(style.level, max(0, len(entry.heights) - 1))
        key = (id(entry), level, style.inside)
        if key not in self.blocks:
            make = maker_of(entry.kind)
            self.blocks[key] = make(self.solution, self.position_indices, style)
        return self.blocks[key]


def _tries(
    levels: int, *, droppable: bool, max_pages: int
) -> Iterator[tuple[int, int, bool, tuple[int, ...]]]:
    """Yield the trials in turn.

    A trial is the number of pages; the number of skipped letter heights; whether droppable blocks
    are left out; and the levels of ungrouping: none, then without continuable blocks, then into the
    innermost groups in any arrangement, then completely. Letters shrink before groups are
    dissolved, and groups are dissolved before blocks are left out.
    """
    for count in range(1, max_pages + 1):
        if count < MAX_EXTRA:
            for apart in ((0,), (1, 2), DISSOLVED):
                yield from ((count, level, False, apart) for level in range(levels))
        if droppable and count != 2:
            yield from ((count, level, True, (0, 1, 2, 3)) for level in range(levels))


def _divide(
    blocks: Sequence[BuiltBlock],
    drawing_areas: Sequence[DrawingArea],
    arranged: Mapping[tuple[str, ...], Arrange],
    ungroupings: Sequence[int],
) -> tuple[Parts, int]:
    """Return blocks on pages in reading order with their corners, and the level of ungrouping.

    The pages are empty if the blocks do not fit. Page breaks are preferably between groups, and
    pages are as evenly full as possible.
    """
    areas = [one.block.width * one.block.height for one in blocks]

    def division_cost(cuts: tuple[int, ...]) -> tuple[int, float]:
        edges = (0, *cuts, len(blocks))
        broken = sum(blocks[k - 1].entry.group == blocks[k].entry.group != () for k in cuts)
        return broken, max(sum(areas[i:j]) for i, j in pairwise(edges))

    @cache
    def page(area: DrawingArea, i: int, j: int, ungrouping: int) -> list[Placed] | None:
        whole = grouped(blocks[i:j] if ungrouping != 1 else _loosened(blocks[i:j]), arranged)
        if ungrouping and whole.arrange == "columns":  # which break groups themselves
            whole = replace(whole, arrange="free")
        group = (whole, whole, whole.inner(), whole.flat())[ungrouping]
        return pack_group(group, area)

    for ungrouping in ungroupings:
        every = combinations(range(1, len(blocks)), len(drawing_areas) - 1)
        for cuts in sorted(every, key=division_cost)[:MAX_DIVISIONS]:
            pages: Parts = []
            for area, (i, j) in zip(drawing_areas, pairwise((0, *cuts, len(blocks))), strict=True):
                placed = page(area, i, j, ungrouping)
                if placed is None:
                    break
                pages.append(placed)
            else:
                return pages, ungrouping
    return [], 0


def _loosened(blocks: Sequence[BuiltBlock]) -> list[BuiltBlock]:
    """Return blocks, with continuable ones taken out of their groups."""
    return [
        BuiltBlock(replace(m.entry, group=()), m.block) if m.entry.kind in CONTINUABLE else m
        for m in blocks
    ]


def grouped(
    blocks: Sequence[BuiltBlock],
    arranged: Mapping[tuple[str, ...], Arrange],
    path: tuple[str, ...] = (),
) -> Group:
    """Return blocks as the tree of their groups."""
    depth = len(path)
    members: list[LayoutItem | Group] = []
    for name, run in groupby(blocks, lambda one: one.entry.group[depth : depth + 1]):
        if name:
            members.append(grouped(list(run), arranged, path + name))
        else:
            members += [LayoutItem(one.block, one.is_text) for one in run]
    return Group(tuple(members), arranged.get(path, "free"))
