"""Blocks of the instant centres: the scheme with Kennedy's lines, tables (мгновенные центры)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isnan

from planmethod.note.document import Paragraph, Table
from planmethod.note.tables.centres import centre_symbol, centres_nodes
from planmethod.plans.model import PlanKind
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.layout.block import Block, Column, heading, paragraph
from planmethod.render.layout.text_blocks import TableColumn, TableForm, table_block
from planmethod.render.pictures.planview import PictureStyle
from planmethod.render.pictures.schemeview import scheme_picture
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.results import table_width
from planmethod.render.sheets.views import shown_position, with_scale
from planmethod.solved.centres import Centre, Centres, find_centres
from planmethod.solved.solution import Solution

CENTRE, LINE = "instant centre", "line of centres"
"""Tags of the points and of Kennedy's lines."""

AROUND = 0.35
"""Part of the size of the scheme by which its box is enlarged: centres beyond are not drawn."""

_DOT = 0.8  # mm: radius of a centre
_OVERSHOOT = 5.0  # mm: a line goes on beyond its last centre


def scheme_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the scheme of one position with all centres near it and the lines that give them."""
    index, kind = shown_position(solution, position_indices, style), PlanKind.POSITION
    layer = _Layer(solution, index)
    added = tuple(layer.lines()), tuple(layer.letters(style.letter))
    picture = scheme_picture(
        solution, index, PictureStyle(style.letter), added=((*added[0], *layer.dots()), added[1])
    )
    block = with_scale(solution, kind, picture, style, (index,))
    return ViewBlock(block, kind.value, solution.scales[kind])


def table_blocks(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the method, the table of the centres and that of velocities, of one position."""
    index, height = shown_position(solution, position_indices, style), style.text(3.5)
    width, blocks = style.width(style.sizes.column), list[Block]()
    said = style.language.sheets["centres"]
    title = style.entry.title or said["title"].format()
    if len(solution.positions) > 1:
        title = style.language.sheets.of_position.format(title=title, number=index)
    blocks.append(heading(title, height, width=width))
    for node in centres_nodes(solution, index, style.language):
        match node:
            case Paragraph(text):
                blocks.append(paragraph(text, height, width))
            case Table():
                columns = [TableColumn(head, cells) for head, cells in node.columns()]
                form = TableForm(height, leading=2)
                blocks.append(table_block(columns, form, max_width=table_width(style)))
            case _:
                raise TypeError(node)
    return Column(blocks, gap=3.0)


class _Layer:
    """Centres and lines on a scheme, mm: those within its enlarged box."""

    def __init__(self, solution: Solution, index: int) -> None:
        self.solution = solution
        self.centres: Centres = find_centres(solution, index)
        self.per_mm = solution.scales[PlanKind.POSITION].per_mm
        drawn = [one.place[index] / self.per_mm for one in solution.points.values()]
        x, y = [z.real for z in drawn], [z.imag for z in drawn]
        grown = AROUND * max(max(x) - min(x), max(y) - min(y))
        self.box = min(x) - grown, min(y) - grown, max(x) + grown, max(y) + grown

    def place(self, centre: Centre) -> complex | None:
        """Return the place of a centre on the paper, or None of one that is not drawn."""
        if isnan(centre.at.real):
            return None
        at = centre.at / self.per_mm
        left, low, right, high = self.box
        return at if left <= at.real <= right and low <= at.imag <= high else None

    def dots(self) -> Iterator[Item]:
        """Yield the centres that are not joints."""
        for centre in self.centres.centres.values():
            at = self.place(centre)
            if at is not None and not centre.point:
                yield Disc(at, _DOT, Ink.BLACK, tag=CENTRE)

    def letters(self, height: float) -> Iterator[Label]:
        """Yield their letters; centres in one point have one list of them."""
        named = list[tuple[complex, list[str]]]()
        for centre in self.centres.centres.values():
            at = self.place(centre)
            if at is None or centre.point:
                continue
            symbol = centre_symbol(self.solution, *centre.links)
            near = next((names for place, names in named if abs(place - at) < _DOT), None)
            if near is None:
                named.append((at, [symbol]))
            else:
                near.append(symbol)
        for at, symbols in named:
            text = ", ".join(symbols)
            yield Label(typeset(text, height), at, gap=1.5, name=f"{CENTRE} {text}", style=BUSY)

    def lines(self) -> Iterator[Item]:
        """Yield the lines on which centres are found, each once."""
        told: set[frozenset[str]] = set()
        for centre in self.centres.centres.values():
            for by in centre.by:
                three = frozenset((*centre.links, by))
                if three in told:
                    continue
                told.add(three)
                ends = [self.centres.of(link, by) for link in centre.links]
                line = self._clipped([centre, *ends])
                if line is not None:
                    yield Stroke(line, Pen.THIN, tag=LINE)

    def _clipped(self, three: Sequence[Centre]) -> tuple[complex, complex] | None:
        """Return the part of a line through centres that is within the box."""
        places = [one.at / self.per_mm for one in three if not isnan(one.at.real)]
        if not places:  # the line at infinity
            return None
        far = [one.towards for one in three if one.is_infinite]
        start = places[0]
        last = max(places, key=lambda one: abs(one - start))
        way = far[0] if far else (last - start) / (abs(last - start) or 1.0)
        if not way:
            return None
        along = [((one - start) * way.conjugate()).real for one in places]
        low, high = min(along) - _OVERSHOOT, max(along) + _OVERSHOOT
        if far:
            low, high = -1e6, 1e6
        left, bottom, right, top = self.box
        for origin, step, ends in (
            (start.real, way.real, (left, right)), (start.imag, way.imag, (bottom, top)),
        ):  # fmt: skip
            if abs(step) < 1e-12:
                if not ends[0] <= origin <= ends[1]:
                    return None
                continue
            first, second = sorted((end - origin) / step for end in ends)
            low, high = max(low, first), min(high, second)
        return (start + low * way, start + high * way) if high > low else None
