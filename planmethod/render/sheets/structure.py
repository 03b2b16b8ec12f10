"""Sheet of the structural analysis (структурный анализ механизма).

On the left the structural scheme and below it the driver and the groups taken apart, in the order
of formation; on the right, above the title block, the tables of pairs and links and the formulas.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from math import ceil

from msgspec import Struct

from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES, say
from planmethod.mechanism.structure import Structure
from planmethod.note.document import Formula, Table
from planmethod.note.narrate.structure import (
    driver_caption,
    group_caption,
    link_table,
    mobility_formulas,
    order_formulas,
    pair_table,
)
from planmethod.note.wording import Language, language
from planmethod.problem.model import Problem
from planmethod.render.frame.clearance import is_clear
from planmethod.render.frame.frame import STAMP_WIDTH, paper_format, sheet_frame
from planmethod.render.frame.furniture import Furniture, Room
from planmethod.render.frame.titleblock import merged
from planmethod.render.ink.drawing import Drawing, Item, View
from planmethod.render.ink.lettering import lettering, using
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, Row, Spacer, paragraph
from planmethod.render.layout.nodes import blocks_of
from planmethod.render.layout.tables import TableColumn, table_block
from planmethod.render.pictures.structural import driver_picture, group_picture, mechanism_picture

PAPERS = ("A3", "A2", "A1")
"""Formats tried in turn when none is asked for."""

EDGE = 6.0
"""Least white between the blocks and the frame, mm."""

GAP = 7.0
"""Least white between two blocks, mm."""

CAPTION_GAP = 4.0
"""White between a picture and its caption, mm."""

MOST_GAP = 16.0
"""Most white between two blocks of the right column, mm: rather larger rows and letters."""

GOOD_SHARE, LEAST_SHARE = 0.36, 0.25
"""Part of the left column's height that the scheme should have, and must have."""


COLUMN = STAMP_WIDTH - 2 * EDGE
"""Width of tables and formulas that stand over the title block, mm."""


class Manner(Struct, frozen=True):
    """Sizes of a sheet, mm (размеры надписей и видов).

    ``column`` is the width of tables and formulas, ``cell`` the least width of a group's cell,
    ``step`` the greatest length of a grid unit of the pictures; ``views`` are the heights of a
    group's picture and ``rows`` those of table rows to try, largest first.
    """

    letter: float
    title: float
    text: float
    column: float
    cell: float
    step: float
    views: tuple[float, ...]
    rows: tuple[float, ...]


MANNERS: Mapping[str, Manner] = {
    "A3": Manner(
        3.5, 5.0, 3.5, COLUMN, 60.0, 42.0, (80.0, 70.0, 62.0, 54.0, 46.0, 40.0), (8.0, 7.0, 6.0)
    ),
    "A2": Manner(
        5.0, 5.0, 3.5, COLUMN, 82.0, 55.0, (95.0, 85.0, 75.0, 65.0, 56.0, 48.0), (8.0, 7.0, 6.0)
    ),
    "A1": Manner(
        5.0, 7.0, 5.0, 250.0, 110.0, 70.0, (130.0, 115.0, 100.0, 85.0, 70.0, 56.0), (10.0, 9.0, 8.0)
    ),
}


def structure_sheet(
    problem: Problem,
    structure: Structure,
    *,
    paper: str | None = None,
    fields: Mapping[str, str] | None = None,
) -> Drawing:
    """Draw the structural analysis of a mechanism on a sheet (лист структурного анализа).

    Parameters
    ----------
    problem : Problem
        Its mechanism and its title block; coordinates and lengths are not looked at.
    structure : Structure
        What `planmethod.mechanism.structure.analyse` says of the mechanism.
    paper : str, optional
        Format; the file's when absent, or A3, or the smallest larger one that everything fits.
    fields : mapping, optional
        Texts of the title block that outrank the file's.

    Raises
    ------
    LayoutError
        When everything fits no format, or not the asked one.
    """
    words = language(problem.sheet.lang or LANGUAGES[0])
    texts = merged(problem.stamp, {"title": words.structure.title}, fields or {})
    paper = paper or problem.sheet.paper
    furniture = Furniture.of(problem.sheet)
    names = (paper_format(paper).name,) if paper else PAPERS
    with using(lettering(problem.sheet.lettering or "B")):
        for name in names:
            fmt = paper_format(name)
            items = sheet_frame(fmt, texts, furniture).items
            manner = MANNERS.get(fmt.like, MANNERS["A1"])
            placed = _compose(problem, structure, manner, furniture.room(fmt), words)
            if placed is not None:
                shown, views = placed
                return Drawing(fmt.width, fmt.height, texts["title"], [*items, *shown], views)
    larger = PAPERS[PAPERS.index(names[-1]) + 1 :] if names[-1] in PAPERS else PAPERS
    advice = (
        say("Take --paper {}.", larger[0])
        if larger
        else "Draw parts of the mechanism on their own."
    )
    raise LayoutError(
        "{}: the structural analysis of {} links and {} groups does not fit {}. {}",
        problem.name,
        structure.moving_links,
        len(structure.groups),
        names[-1],
        advice,
    )


def _compose(
    problem: Problem, structure: Structure, manner: Manner, room: Room, words: Language
) -> tuple[list[Item], list[View]] | None:
    """Return the items inside the frame and the view, or None when they do not fit.

    A column that would lie on a graph in an upper corner begins below it.
    """
    inner, low = room.inner, room.stamp[3] + EDGE
    left, right = inner[0] + EDGE, inner[2] - EDGE - manner.column
    tops = (inner[3] - EDGE, *(box[1] - EDGE for box in room.taken))

    def begun(make: Callable[[float], Block | None], x: float) -> tuple[Block, float] | None:
        for top in tops:
            block = make(top)
            if block is None:
                return None
            if is_clear(block.place(complex(x, top)), room):
                return block, top
        return None

    told = begun(
        lambda top: _told(problem, structure, manner, manner.column, top - low, words), right
    )
    if told is None:
        return None
    width = right - EDGE - GAP - left
    shown = begun(
        lambda top: _shown(problem, structure, manner, width, top - inner[1] - EDGE, words), left
    )
    if shown is None:
        return None
    pictures, top = shown
    box = (left, top - pictures.height, left + pictures.width, top)
    placed = [*pictures.place(complex(left, top)), *told[0].place(complex(right, told[1]))]
    return placed, [View("structure", box)]


# The right column: tables and formulas ---------------------------------------------------------


def _told(
    problem: Problem,
    structure: Structure,
    manner: Manner,
    width: float,
    height: float,
    words: Language,
) -> Block | None:
    """Return tables and formulas, in rows as high as the room allows."""
    mechanism, said = problem.mechanism, words.structure
    for row in manner.rows:
        lines = [
            *mobility_formulas(mechanism, structure, words),
            *order_formulas(mechanism, structure, words),
        ]
        blocks = [
            _table(pair_table(mechanism, words), said.pairs, manner, width, row),
            _table(link_table(mechanism, words), said.links, manner, width, row),
            _formulas(lines, manner, width, 0.55 * row, said.formulas),
        ]
        spare = height - sum(block.height for block in blocks)
        if spare >= GAP * (len(blocks) - 1):
            return Column(blocks, gap=min(MOST_GAP, spare / len(blocks)))
    return None


def _table(made: Table, title: str, manner: Manner, width: float, row: float) -> Block:
    cells = zip(made.head, *made.rows, strict=True)
    columns = [TableColumn(head, tuple(values)) for head, *values in cells]
    table = table_block(columns, manner.text, width=width, units="none", row_height=row)
    return Column([_title(title, manner), table], gap=3.0)


def _title(text: str, manner: Manner) -> Block:
    return Line(typeset(text, manner.title))


def _formulas(lines: Iterable[str], manner: Manner, width: float, gap: float, title: str) -> Block:
    made = blocks_of(map(Formula, lines), manner.text, width=width)
    return Column([_title(title, manner), *made], gap=gap)


# The left column: scheme and groups ------------------------------------------------------------


def _shown(
    problem: Problem,
    structure: Structure,
    manner: Manner,
    width: float,
    height: float,
    words: Language,
) -> Block | None:
    """Return the scheme and the grid of groups, which fill the column together."""
    mechanism = problem.mechanism
    sense = -1 if problem.drive.rate < 0 else 1
    head = _title(words.structure.scheme, manner)
    below = _title(words.structure.parts, manner)
    count = 1 + len(structure.groups)
    most = max(1, int((width + GAP) / (manner.cell + GAP)))
    rows = ceil(count / min(most, count))
    across = ceil(count / rows)
    cell = (width - GAP * (across - 1)) / across
    for tall in manner.views:
        pictures: list[Block] = [
            driver_picture(
                mechanism, width=cell, height=tall, letter_height=manner.letter, sense=sense
            )
        ]
        pictures += [
            group_picture(
                mechanism,
                group,
                width=cell,
                height=tall,
                letter_height=manner.letter,
                largest=manner.step,
            )
            for group in structure.groups
        ]
        told: list[Block] = [_caption(driver_caption(mechanism, words), manner, cell)]
        told += [_caption(group_caption(group, words), manner, cell) for group in structure.groups]
        grid = _grid(pictures, told, across, cell)
        room = height - head.height - below.height - grid.height - 3 * GAP
        share = LEAST_SHARE if tall == manner.views[-1] else GOOD_SHARE
        scheme = mechanism_picture(
            mechanism,
            structure,
            width=width,
            height=max(room, 1.0),
            letter_height=manner.letter,
            largest=manner.step,
            sense=sense,
        )
        fits = scheme.height <= room and all(p.width <= cell for p in pictures)
        if fits and scheme.width <= width and room >= share * height:
            spare = (room - scheme.height) / 4
            parts = [
                head,
                Spacer(width, GAP + spare),
                scheme,
                Spacer(width, GAP + spare),
                below,
                Spacer(width, GAP + spare),
                grid,
            ]
            return Column(parts, gap=0.0, align="centre")
    return None


def _grid(pictures: Sequence[Block], told: Sequence[Block], across: int, cell: float) -> Block:
    """Return cells in rows: pictures stand on one line, captions begin on one line."""
    rows: list[Block] = []
    for first in range(0, len(pictures), across):
        views, texts = pictures[first : first + across], told[first : first + across]
        high = max(view.height for view in views)
        pairs = zip(views, texts, strict=True)
        rows.append(Row([_Cell(view, text, cell, high) for view, text in pairs], gap=GAP))
    return Column(rows, gap=GAP + 2.0, align="centre")


class _Cell(Struct, frozen=True):
    """Picture over its caption in a room of a given width and height; both are centred."""

    view: Block
    text: Block
    width: float
    room: float

    @property
    def height(self) -> float:
        return self.room + CAPTION_GAP + self.text.height

    def place(self, corner: complex) -> list[Item]:
        """Return picture and caption; the picture stands in the middle of its room."""
        drop = (self.room - self.view.height) / 2
        at = corner + (self.width - self.view.width) / 2 - 1j * drop
        under = corner + (self.width - self.text.width) / 2 - 1j * (self.room + CAPTION_GAP)
        return [*self.view.place(at), *self.text.place(under)]


def _caption(lines: Iterable[str], manner: Manner, width: float) -> Block:
    parts = [paragraph(line, manner.text, width, align="centre") for line in lines]
    return Column(parts, gap=2.4, align="centre")
