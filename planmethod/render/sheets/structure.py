"""Sheet of the structural analysis (структурный анализ механизма).

On the left the structural scheme, beside it the scheme without redundant constraints with the
symbols of its pairs, and below them the driver and the groups taken apart, in the order
of formation, then the groups of the self-aligning mechanism; on the right, above the title block,
the tables of pairs and links and the formulas.
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
    aligned_caption,
    aligned_sums,
    driver_caption,
    group_caption,
    link_table,
    mobility_formulas,
    order_formulas,
    pair_table,
)
from planmethod.note.wording import Language, get_language
from planmethod.paper import DEFAULT_SERIES, STAMP_WIDTH, Format, paper_format
from planmethod.problem.model import Problem
from planmethod.render.ink.drawing import Drawing, Item
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import (
    Block,
    Column,
    Line,
    Row,
    Spacer,
    make_alternatives,
    paragraph,
)
from planmethod.render.layout.groups import Placed
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
from planmethod.render.sheets.model import BlockStyle
from planmethod.solved.aligned.schemes import SelfAligning, self_aligning
from planmethod.solved.reading import memoized
from planmethod.solved.solution import Solution

EDGE = 6.0
"""Least white between the blocks and the frame, mm."""

GAP = 7.0
"""Least white between two blocks, mm."""

CAPTION_GAP = 4.0
"""White between a picture and its caption, mm."""

MAX_GAP = 16.0
"""Largest white between two blocks of the right column, mm: rows and letters grow first."""

GOOD_FRACTION, MIN_FRACTION = 0.36, 0.25
"""Preferred and least part of the left column's height for the scheme; the least one is usual above
two rows of groups."""


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


def pictures_for(paper: Format) -> Pictures:
    """Return the sizes for a format."""
    return PICTURES.get(paper.like, PICTURES["A1"])


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
    strategy = _Structural(Analysed(problem, structure, aligned, language))
    (sheet,) = compose(problem, strategy, misfit, fields=fields)
    return sheet


class _Structural(Struct, frozen=True):
    """Search strategy for the structural sheet, by sizes of tables and pictures."""

    analysed: Analysed

    formats = DEFAULT_SERIES

    def proposals(self, papers: Sequence[TrialPaper]) -> Iterator[_Columns]:
        """Yield two columns for each paper."""
        for paper in papers:
            yield _Columns(paper, self.analysed, pictures_for(paper.format))


class _Columns(Struct, frozen=True):
    """Pictures on the left, tables and formulas on the right (`Proposal`)."""

    paper: TrialPaper
    analysed: Analysed
    pictures: Pictures

    def arrange(self) -> SheetLayout | None:
        """Return the sheet, or None when the columns do not fit.

        A column that would cover a graph in an upper corner begins below it.
        """
        analysed, pictures = self.analysed, self.pictures
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

        told = place_clear(lambda top: _build_texts(analysed, pictures, top - low), right)
        if told is None:
            return None
        width = right - EDGE - GAP - left

        def scheme(top: float) -> Block | None:
            height = top - inner[1] - EDGE
            block = _build_pictures(analysed, pictures, width, height)
            return block and ViewBlock(block, "structure", None)

        shown = place_clear(scheme, left)
        return shown and SheetLayout([PageLayout([shown, told], analysed.language.structure.title)])


# The right column: tables and formulas ---------------------------------------------------------


def _build_texts(analysed: Analysed, pictures: Pictures, height: float) -> Block | None:
    """Return tables and formulas, in rows as high as the space permits."""
    for row in pictures.rows:
        blocks = [
            *analysed.tables(pictures.sizes, row),
            analysed.formulas(pictures.sizes, 0.55 * row),
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


def _build_pictures(
    analysed: Analysed, pictures: Pictures, width: float, height: float
) -> Block | None:
    """Return the schemes and the grids of groups, which fill the column together."""
    for tall in pictures.views:
        below = analysed.group_rows(width, tall, pictures)
        heads = analysed.scheme_names(width, pictures.sizes)
        room = height - heads.height - sum(one.height + GAP for one in below) - GAP
        least = tall == pictures.views[-1] or analysed.mobile is not None
        share = MIN_FRACTION if least else GOOD_FRACTION
        if room < share * height or any(one.width > width for one in below):
            continue
        schemes = analysed.scheme_row(width, room, pictures)
        if schemes is not None:
            spare = (room - schemes.height) / (2 + len(below))
            gaps: list[Block] = [Spacer(width, GAP + spare) for _ in below]
            parts: list[Block] = [heads, Spacer(width, GAP + spare), schemes]
            parts += [one for couple in zip(gaps, below, strict=True) for one in couple]
            return Column(parts, gap=0.0, align="centre")
    return None


class Analysed(Struct, frozen=True):
    """Structural analysis of a mechanism, and the blocks that show it (структурный анализ)."""

    problem: Problem
    structure: Structure
    aligned: SelfAligning
    language: Language

    @property
    def mobile(self) -> Mobile | None:
        """Classes of the pairs in the drawn scheme without redundant constraints, if any."""
        aligned = self.aligned
        if not aligned.schemes or not self.structure.groups or self.problem.mechanism.higher:
            return None
        return Mobile.of(aligned, self.language.structure["pair_classes"])

    def scheme_names(self, width: float, sizes: Sizes) -> Block:
        """Return the names of the schemes beside each other."""
        texts, higher = self.language.structure, self.problem.mechanism.higher
        names = [texts.replacing_scheme if higher else texts.scheme]
        names += [texts.aligned_scheme] if self.mobile else []
        wide = _cell_width(width, len(names))
        heads = [paragraph(name, sizes.title, wide, align="centre") for name in names]
        return Row([_Centred(one, wide, one.height) for one in heads], gap=GAP)

    def scheme_row(self, width: float, height: float, pictures: Pictures) -> Block | None:
        """Return the scheme and that without redundant constraints, or None without room."""
        schemes = [None, self.mobile] if self.mobile else [None]
        wide = _cell_width(width, len(schemes))
        area = SchemeArea(wide, max(height, 1.0), pictures.sizes.letter, pictures.step)
        drawn = [
            mechanism_picture(
                self.problem.mechanism,
                self.structure,
                area,
                senses=self.problem.drive.senses,
                mobile=one,
            )
            for one in schemes
        ]
        highest = max(scheme.height for scheme in drawn)
        if highest > height or any(one.width > wide for one in drawn):
            return None
        return Row([_Centred(one, wide, highest) for one in drawn], gap=GAP)

    def group_rows(self, width: float, height: float, pictures: Pictures) -> list[Block]:
        """Return heading and grid of drivers and groups, then of the self-aligning groups.

        A picture is at most ``height`` mm high; a grid wider than ``width`` does not fit.
        """
        mechanism, language, sizes = self.problem.mechanism, self.language, pictures.sizes
        groups, texts = self.structure.groups, language.structure
        most = max(1, int((width + GAP) / (pictures.cell + GAP)))
        count = len(mechanism.drivers) + len(groups)
        across = ceil(count / ceil(count / most))
        own = SchemeArea(_cell_width(width, across), height, sizes.letter, pictures.step)
        shown: list[Block] = [
            driver_picture(mechanism, driver, own, sense=sense)
            for driver, sense in self.problem.drive.senses.items()
        ]
        shown += [group_picture(mechanism, group, own) for group in groups]
        told = [driver_caption(mechanism, driver, language) for driver in mechanism.drivers]
        told += [group_caption(group, language) for group in groups]
        rows = [_title(texts.parts, sizes), _grid(shown, told, across, own.width, sizes)]
        if self.mobile:
            freed = self.aligned.groups
            shown = [
                group_picture(mechanism, one.group, own, mobile=self.mobile.of_group(one))
                for one in freed
            ]
            told = [aligned_caption(one, language) for one in freed]
            across = min(across, len(freed))
            rows.append(_title(texts.aligned_parts, sizes))
            rows.append(_grid(shown, told, across, own.width, sizes))
        return rows

    def tables(self, sizes: Sizes, row: float) -> list[Block]:
        """Return the tables of pairs and links, with rows of a height, mm."""
        mechanism, language = self.problem.mechanism, self.language
        pairs = pair_table(mechanism, language, self.aligned)
        return [
            _table(pairs, language.structure.pairs, sizes, row),
            _table(link_table(mechanism, language), language.structure.links, sizes, row),
        ]

    def formulas(self, sizes: Sizes, gap: float) -> Block:
        """Return the formulas, ``gap`` mm apart."""
        mechanism, structure, language = self.problem.mechanism, self.structure, self.language
        notation = self.problem.sheet.notation
        lines = [
            *mobility_formulas(mechanism, structure, language, notation),
            *order_formulas(mechanism, structure, language),
            *aligned_sums(structure, self.aligned, language, notation),
        ]
        return _formulas(lines, sizes, gap, language.structure.formulas)


def _cell_width(width: float, count: int) -> float:
    """Return the width of each of some blocks side by side."""
    return (width - GAP * (count - 1)) / count


# Blocks of a layout ----------------------------------------------------------------------------

LETTERS_TO_ROW = 2.0
"""Height of a row of tables, in heights of its letters."""


@memoized
def analysed_of(solution: Solution) -> Analysed:
    """Return the structural analysis of a solved mechanism."""
    problem, structure = solution.problem, solution.structure
    language = get_language(problem.sheet.lang or LANGUAGES[0])
    return Analysed(problem, structure, self_aligning(problem, structure), language)


def _pictures_of(style: BlockStyle) -> Pictures:
    """Return the sizes of pictures on a sheet, with the letters of a block."""
    wide = next(
        (name for name in PICTURES if style.inside <= paper_format(name).width), [*PICTURES][-1]
    )
    sizes = replace(
        style.sizes, letter=style.letter, title=style.title, text=style.text(style.sizes.text)
    )
    return replace(PICTURES[wide], sizes=replace(sizes, column=style.width(sizes.column)))


def _beside_texts(style: BlockStyle) -> float:
    """Return the width of pictures that are beside a column of texts, mm."""
    return max(0.5 * style.inside, style.inside - style.sizes.column - 3 * GAP)


def _heights(pictures: Pictures) -> Sequence[float]:
    """Return the heights of pictures to try in a layout, mm: none that looks lost on the paper."""
    return pictures.views[: len(pictures.views) // 2][::-1]


def scheme_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the structural scheme and that without redundant constraints, in several sizes."""
    analysed, pictures = analysed_of(solution.origin), _pictures_of(style)
    width = style.width(_beside_texts(style))
    names = analysed.scheme_names(width, pictures.sizes)
    rows = (analysed.scheme_row(width, tall, pictures) for tall in _heights(pictures))
    ways: list[Block] = [Column([names, row], gap=GAP) for row in rows if row is not None]
    ways = ways or [Spacer(2 * style.inside, GAP)]  # which has no room on this paper
    return make_alternatives((ViewBlock(way, "structure", None) for way in ways), grows=True)


def groups_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the driver and the groups, then the self-aligning groups, in several sizes."""
    analysed, pictures = analysed_of(solution.origin), _pictures_of(style)
    width = style.width(_beside_texts(style))
    ways = [
        Column(analysed.group_rows(width, tall, pictures), gap=GAP, align="centre")
        for tall in _heights(pictures)
    ]
    return make_alternatives((ViewBlock(way, "structure", None) for way in ways), grows=True)


def tables_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the tables of pairs and links."""
    analysed, sizes = analysed_of(solution.origin), _pictures_of(style).sizes
    return Column(analysed.tables(sizes, LETTERS_TO_ROW * sizes.text), gap=GAP)


def formulas_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the structural formulas."""
    analysed, sizes = analysed_of(solution.origin), _pictures_of(style).sizes
    return analysed.formulas(sizes, sizes.text)


class _Centred(Struct, frozen=True):
    """Block centred in an area of a given width and height."""

    block: Block
    width: float
    height: float

    def place(self, corner: complex) -> list[Item]:
        """Return the items of the block."""
        across, down = self.width - self.block.width, self.height - self.block.height
        return self.block.place(corner + across / 2 - 1j * down / 2)


def _grid(
    pictures: Sequence[Block],
    captions: Sequence[Sequence[str]],
    per_row: int,
    cell: float,
    sizes: Sizes,
) -> Block:
    """Return cells in rows: pictures end on one line, captions begin on one line."""
    told = [_caption(lines, sizes, cell) for lines in captions]
    cell = max(cell, *(one.width for one in (*pictures, *told)))
    rows: list[Block] = []
    for first in range(0, len(pictures), per_row):
        views, texts = pictures[first : first + per_row], told[first : first + per_row]
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
