"""Sheet of the structural analysis (структурный анализ механизма).

On the left the structural scheme, beside it the scheme without redundant constraints with the
symbols of its pairs, and below them the driver and the groups taken apart, in the order
of formation; on the right, above the title block, the tables of pairs and links and the formulas.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from math import ceil

from msgspec import Struct
from msgspec.structs import replace

from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES, translate
from planmethod.mechanism.structure import Structure
from planmethod.note.document import Formula, Table
from planmethod.note.narrate.structure import (
    aligned_sums,
    driver_caption,
    group_caption,
    link_table,
    mobility_formulas,
    order_formulas,
    pair_table,
)
from planmethod.note.wording import Language, get_language
from planmethod.paper import DEFAULT_SERIES, STAMP_WIDTH, paper_format
from planmethod.problem.model import Problem
from planmethod.render.ink.drawing import Drawing, Item
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Line, Row, Spacer, paragraph
from planmethod.render.layout.pack import Placed
from planmethod.render.layout.text_blocks import TableColumn, TableForm, blocks_of, table_block
from planmethod.render.pictures.structural import (
    Mobile,
    SchemeArea,
    driver_picture,
    group_picture,
    mechanism_picture,
)
from planmethod.render.sheets.composer import (
    NoFitAdvice,
    PageLayout,
    SheetLayout,
    Sizes,
    TrialPaper,
    ViewBlock,
    compose,
)
from planmethod.solved.aligned.schemes import SelfAligning, self_aligning

EDGE = 6.0
"""Least white between the blocks and the frame, mm."""

GAP = 7.0
"""Least white between two blocks, mm."""

CAPTION_GAP = 4.0
"""White between a picture and its caption, mm."""

MAX_GAP = 16.0
"""Largest white between two blocks of the right column, mm: rows and letters grow first."""

GOOD_FRACTION, MIN_FRACTION = 0.36, 0.25
"""Preferred and least part of the left column's height for the scheme."""


COLUMN = STAMP_WIDTH - 2 * EDGE
"""Width of tables and formulas above the title block, mm."""


class Pictures(Struct, frozen=True):
    """Sizes of a sheet and of its pictures, mm (размеры надписей и видов).

    ``cell`` is the least width of a group's cell, ``step`` the greatest length of a grid unit of
    the pictures; ``views`` are the heights of a group's picture and ``rows`` those of table rows to
    try, largest first.
    """

    sizes: Sizes
    cell: float
    step: float
    views: tuple[float, ...]
    rows: tuple[float, ...]


PICTURES: Mapping[str, Pictures] = {
    "A3": Pictures(
        Sizes(3.5, 5.0, 3.5, COLUMN), 60.0, 42.0, (80.0, 70.0, 62.0, 54.0, 46.0, 40.0),
        (8.0, 7.0, 6.0),
    ),
    "A2": Pictures(
        Sizes(5.0, 5.0, 3.5, COLUMN), 82.0, 55.0, (95.0, 85.0, 75.0, 65.0, 56.0, 48.0),
        (8.0, 7.0, 6.0),
    ),
    "A1": Pictures(
        Sizes(5.0, 7.0, 5.0, 250.0), 110.0, 70.0, (130.0, 115.0, 100.0, 85.0, 70.0, 56.0),
        (10.0, 9.0, 8.0),
    ),
}  # fmt: skip


def structure_sheet(
    problem: Problem,
    structure: Structure,
    aligned: SelfAligning | None = None,
    *,
    paper: str | None = None,
    fields: Mapping[str, str] | None = None,
) -> Drawing:
    """Draw the structural analysis of a mechanism on a sheet (лист структурного анализа).

    Parameters
    ----------
    problem : Problem
        Problem with mechanism and title block; coordinates and lengths are not used.
    structure : Structure
        Result of `planmethod.mechanism.structure.analyse` for the mechanism.
    aligned : SelfAligning, optional
        Its schemes without redundant constraints. Default: computed.
    paper : str, optional
        Format. Default: the file's, or A3, or the smallest larger one that everything fits.
    fields : mapping, optional
        Texts of the title block that outrank the file's.

    Raises
    ------
    LayoutError
        When the sheet fits no format, or not the requested one.
    """
    if paper:
        problem = replace(problem, sheet=replace(problem.sheet, paper=paper_format(paper).name))
    language = get_language(problem.sheet.lang or LANGUAGES[0])
    misfit = NoFitAdvice(
        lambda paper, advice: LayoutError(
            "{}: the structural analysis of {} links and {} groups does not fit {}. {}",
            problem.name,
            structure.moving_links,
            len(structure.groups),
            paper,
            advice,
        ),
        translate("Draw parts of the mechanism separately."),
    )
    aligned = aligned or self_aligning(problem, structure)
    strategy = _Structural(problem, structure, aligned, language)
    (sheet,) = compose(problem, strategy, misfit, fields=fields)
    return sheet


class _Structural(Struct, frozen=True):
    """Search strategy for the structural sheet, by sizes of tables and pictures."""

    problem: Problem
    structure: Structure
    aligned: SelfAligning
    language: Language

    formats = DEFAULT_SERIES

    def proposals(self, papers: Sequence[TrialPaper]) -> Iterator[_Columns]:
        """Yield two columns for each paper."""
        for paper in papers:
            pictures = PICTURES.get(paper.format.like, PICTURES["A1"])
            yield _Columns(
                paper, self.problem, self.structure, self.aligned, pictures, self.language
            )


class _Columns(Struct, frozen=True):
    """Pictures on the left, tables and formulas on the right (`Proposal`)."""

    paper: TrialPaper
    problem: Problem
    structure: Structure
    aligned: SelfAligning
    pictures: Pictures
    language: Language

    def arrange(self) -> SheetLayout | None:
        """Return the sheet, or None when the columns do not fit.

        A column that would cover a graph in an upper corner begins below it.
        """
        problem, structure = self.problem, self.structure
        pictures, language = self.pictures, self.language
        room, column = self.paper.drawing_area(), pictures.sizes.column
        inner, low = room.inner, room.stamp[3] + EDGE
        left, right = inner[0] + EDGE, inner[2] - EDGE - column
        tops = (inner[3] - EDGE, *(box[1] - EDGE for box in room.reserved))

        def place_clear(build: Callable[[float], Block | None], x: float) -> Placed | None:
            for top in tops:
                block, corner = build(top), complex(x, top)
                if block is None:
                    return None
                if room.is_clear(block.place(corner)):
                    return block, corner
            return None

        aligned = self.aligned
        told = place_clear(
            lambda top: _build_texts(problem, structure, aligned, pictures, top - low, language),
            right,
        )
        if told is None:
            return None
        width = right - EDGE - GAP - left

        def scheme(top: float) -> Block | None:
            height = top - inner[1] - EDGE
            block = _build_pictures(self, width, height)
            return block and ViewBlock(block, "structure", None)

        shown = place_clear(scheme, left)
        return shown and SheetLayout([PageLayout([shown, told], language.structure.title)])


# The right column: tables and formulas ---------------------------------------------------------


def _build_texts(
    problem: Problem,
    structure: Structure,
    aligned: SelfAligning,
    pictures: Pictures,
    height: float,
    language: Language,
) -> Block | None:
    """Return tables and formulas, in rows as high as the space permits."""
    mechanism, texts = problem.mechanism, language.structure
    sizes = pictures.sizes
    for row in pictures.rows:
        lines = [
            *mobility_formulas(mechanism, structure, language, problem.sheet.notation),
            *order_formulas(mechanism, structure, language),
            *aligned_sums(structure, aligned, language, problem.sheet.notation),
        ]
        blocks = [
            _table(pair_table(mechanism, language, aligned), texts.pairs, sizes, row),
            _table(link_table(mechanism, language), texts.links, sizes, row),
            _formulas(lines, sizes, 0.55 * row, texts.formulas),
        ]
        spare = height - sum(block.height for block in blocks)
        if spare >= GAP * (len(blocks) - 1):
            return Column(blocks, gap=min(MAX_GAP, spare / len(blocks)))
    return None


def _table(source: Table, title: str, sizes: Sizes, row: float) -> Block:
    columns = [TableColumn(*column) for column in source.columns()]
    table = table_block(
        columns, TableForm(sizes.text, units="none", row_height=row), width=sizes.column
    )
    return Column([_title(title, sizes), table], gap=3.0)


def _title(text: str, sizes: Sizes) -> Block:
    return Line(typeset(text, sizes.title))


def _formulas(lines: Iterable[str], sizes: Sizes, gap: float, title: str) -> Block:
    made = blocks_of(map(Formula, lines), sizes.text, width=sizes.column)
    return Column([_title(title, sizes), *made], gap=gap)


# The left column: scheme and groups ------------------------------------------------------------


def _build_pictures(columns: _Columns, width: float, height: float) -> Block | None:
    """Return the schemes and the grid of groups, which fill the column together."""
    problem, structure, aligned = columns.problem, columns.structure, columns.aligned
    pictures, language = columns.pictures, columns.language
    mechanism, sizes = problem.mechanism, pictures.sizes
    sense = -1 if problem.drive.rate < 0 else 1
    mobile = Mobile(aligned, language.structure["pair_classes"])
    both = bool(aligned.schemes and structure.groups) and not mechanism.higher
    schemes = [None, mobile] if both else [None]
    wide = (width - GAP * (len(schemes) - 1)) / len(schemes)
    first = language.structure.replacing_scheme if mechanism.higher else language.structure.scheme
    names = [first, language.structure.aligned_scheme][: len(schemes)]
    heads = [paragraph(name, sizes.title, wide, align="centre") for name in names]
    head = Row([_Centred(one, wide, one.height) for one in heads], gap=GAP)
    below = _title(language.structure.parts, sizes)
    count = 1 + len(structure.groups)
    most = max(1, int((width + GAP) / (pictures.cell + GAP)))
    rows = ceil(count / min(most, count))
    across = ceil(count / rows)
    cell = (width - GAP * (across - 1)) / across
    for tall in pictures.views:
        own = SchemeArea(cell, tall, sizes.letter, pictures.step)
        shown: list[Block] = [driver_picture(mechanism, own, sense=sense)]
        shown += [group_picture(mechanism, group, own) for group in structure.groups]
        told: list[Block] = [_caption(driver_caption(mechanism, language), sizes, cell)]
        told += [
            _caption(group_caption(group, language), sizes, cell) for group in structure.groups
        ]
        grid = _grid(shown, told, across, cell)
        room = height - head.height - below.height - grid.height - 3 * GAP
        share = MIN_FRACTION if tall == pictures.views[-1] else GOOD_FRACTION
        area = SchemeArea(wide, max(room, 1.0), sizes.letter, pictures.step)
        drawn = [
            mechanism_picture(mechanism, structure, area, sense=sense, mobile=one)
            for one in schemes
        ]
        highest = max(scheme.height for scheme in drawn)
        fits = highest <= room and all(p.width <= cell for p in shown)
        if fits and all(one.width <= wide for one in drawn) and room >= share * height:
            spare = (room - highest) / 4
            centred = [_Centred(one, wide, highest) for one in drawn]
            parts: list[Block] = [
                head,
                Spacer(width, GAP + spare),
                Row(centred, gap=GAP),
                Spacer(width, GAP + spare),
                below,
                Spacer(width, GAP + spare),
                grid,
            ]
            return Column(parts, gap=0.0, align="centre")
    return None


class _Centred(Struct, frozen=True):
    """Block centred in an area of a given width and height."""

    block: Block
    width: float
    height: float

    def place(self, corner: complex) -> list[Item]:
        """Return the items of the block."""
        across, down = self.width - self.block.width, self.height - self.block.height
        return self.block.place(corner + across / 2 - 1j * down / 2)


def _grid(pictures: Sequence[Block], captions: Sequence[Block], per_row: int, cell: float) -> Block:
    """Return cells in rows: pictures end on one line, captions begin on one line."""
    rows: list[Block] = []
    for first in range(0, len(pictures), per_row):
        views, texts = pictures[first : first + per_row], captions[first : first + per_row]
        high = max(view.height for view in views)
        pairs = zip(views, texts, strict=True)
        rows.append(Row([_Cell(view, text, cell, high) for view, text in pairs], gap=GAP))
    return Column(rows, gap=GAP + 2.0, align="centre")


class _Cell(Struct, frozen=True):
    """Picture over its caption in an area of a given width and height; both are centred."""

    view: Block
    text: Block
    width: float
    view_height: float

    @property
    def height(self) -> float:
        return self.view_height + CAPTION_GAP + self.text.height

    def place(self, corner: complex) -> list[Item]:
        """Return picture and caption; the picture is centred in its area."""
        drop = (self.view_height - self.view.height) / 2
        at = corner + (self.width - self.view.width) / 2 - 1j * drop
        under = corner + (self.width - self.text.width) / 2 - 1j * (self.view_height + CAPTION_GAP)
        return [*self.view.place(at), *self.text.place(under)]


def _caption(lines: Iterable[str], sizes: Sizes, width: float) -> Block:
    parts = [paragraph(line, sizes.text, width, align="centre") for line in lines]
    return Column(parts, gap=2.4, align="centre")
