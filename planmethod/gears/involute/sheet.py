"""Sheet of an involute meshing (лист «Эвольвентное зацепление»), form 1."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import TYPE_CHECKING

from msgspec import Struct

from planmethod.errors import LayoutError
from planmethod.gears.involute.cuttingpicture import cutting_picture, cutting_view
from planmethod.gears.involute.diagrams import (
    Contour,
    contour_picture,
    sliding_per_mm,
    sliding_picture,
    sliding_scale,
)
from planmethod.gears.involute.meshdimensions import mesh_dimensions
from planmethod.gears.involute.meshpicture import meshing_picture, view_for
from planmethod.gears.involute.quantities import SolvedMeshing
from planmethod.gears.involute.sizes import MeshingProblem
from planmethod.gears.involute.text import (
    given_facts,
    given_text,
    quality,
    shifts,
    table,
)
from planmethod.languages import LANGUAGES, translate
from planmethod.note.numbers import Notation
from planmethod.note.wording import Language, get_language
from planmethod.paper import STAMP_WIDTH
from planmethod.render.frame.furniture import DrawingArea, Furniture
from planmethod.render.ink.drawing import Drawing
from planmethod.render.layout.block import Block, Column, Picture, heading, paragraph
from planmethod.render.layout.cuttings import GAP, Group, LayoutItem
from planmethod.render.layout.pack import EDGE
from planmethod.render.layout.tables import TableColumn, table_block
from planmethod.render.sheets.composer import (
    NoFitAdvice,
    Packing,
    Sizes,
    TrialPaper,
    ViewBlock,
    compose,
)

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile

TEXT_WIDTH = STAMP_WIDTH - EDGE
"""Width of the tables, which are placed over the title block, mm."""


TRIES = (
    (Sizes(5.0, 7.0, 3.5, TEXT_WIDTH, 10.0), 5.0, 1.0),
    (Sizes(5.0, 7.0, 3.5, TEXT_WIDTH, 9.0), 3.5, 1.0),
    (Sizes(5.0, 5.0, 3.5, TEXT_WIDTH, 8.0), 3.5, 0.95),
    (Sizes(3.5, 5.0, 3.5, TEXT_WIDTH, 6.0), 3.5, 0.9),
    (Sizes(3.5, 5.0, 2.5, TEXT_WIDTH, 5.0), 2.5, 0.9),
    (Sizes(3.5, 5.0, 2.5, TEXT_WIDTH, 4.5), 2.5, 0.75),
)
"""Sizes, height of the letters of the checks, mm, and part of the paper for the views.

Tried in turn until everything fits.
"""


def drawings(
    problem: MeshingProblem,
    *,
    fields: Mapping[str, str],
    profile: Profile,
    before: int = 0,
    total: int | None = None,
) -> list[Drawing]:
    """Draw the pair in mesh, its blocking contour, specific sliding and the table of sizes.

    Raises
    ------
    LayoutError
        All this does not fit the requested paper.
    """
    language = get_language(problem.sheet.lang or LANGUAGES[0])
    furniture = Furniture.of(problem.sheet, before=before, total=total)
    misfit = NoFitAdvice(
        lambda paper, advice: LayoutError(
            "{}: the meshing, its contour, its diagram and its tables do not fit {}. {}",
            problem.name,
            paper,
            advice,
        ),
        translate("Take another --paper."),
    )
    strategy = _Meshing(SolvedMeshing(problem), language)
    title = problem.title or language.meshing.sheet
    return compose(problem, strategy, misfit, fields=fields, furniture=furniture, title=title)


class _Meshing(Struct, frozen=True):
    """Search for the layout of the sheet of a mesh, with ever smaller letters and views."""

    solved: SolvedMeshing
    language: Language

    formats = ("A1",)

    def proposals(self, papers: Sequence[TrialPaper]) -> Iterator[Packing]:
        """Yield the blocks at sizes at which the tables fit."""
        contour = Contour.of(self.solved)
        for paper, (sizes, checks, share) in product(papers, TRIES):
            parts = self._parts(contour, paper.drawing_area(), sizes, checks, share)
            if parts is not None:
                yield Packing(paper, (Group(parts),))

    def _parts(
        self, contour: Contour, area: DrawingArea, sizes: Sizes, checks: float, view_ratio: float
    ) -> tuple[LayoutItem, ...] | None:
        """Return the blocks in reading order; None where the tables are too high."""
        solved, language, texts = self.solved, self.language, self.language.meshing
        wide, tall = area.inner[2] - area.inner[0], area.inner[3] - area.inner[1]
        free = wide - STAMP_WIDTH - 2 * EDGE - 2 * GAP
        high = tall - 2 * EDGE - sizes.title - 8.0
        told = Column(
            [*_checks(solved, language, sizes.title, checks), *_tables(solved, language, sizes)],
            gap=4.0,
        )
        if told.height + area.stamp[3] + GAP > area.inner[3]:
            return None
        view = view_for(solved, view_ratio * 0.6 * free, view_ratio * high)
        mesh = meshing_picture(view, language, sizes.letter, *mesh_dimensions(view, sizes.letter))
        width = view_ratio * (free - mesh.width)
        plane = contour_picture(contour, language, width, view_ratio * 0.36 * high, sizes.letter)
        low = view_ratio * 0.24 * high
        sliding = sliding_picture(solved, language, width, low, sizes.letter)
        pinion = solved.cuttings[0]
        assert pinion is not None  # only wheel 2 may be a ring
        cutting = cutting_view(pinion, width, view_ratio * 0.36 * high)
        cut = cutting_picture(cutting, language, sizes.letter)
        scale = _scale(sliding_scale(solved, width), language.notation)
        per_mm = language.notation.as_input(sliding_per_mm(solved, low))
        upright = texts.sliding_scale.format(scale=per_mm)
        title = texts.meshing.format(scale=_scale(view.scale, language.notation))
        blocks: list[Block] = [
            ViewBlock(_titled(title, mesh, sizes), "meshing", None),
            _titled(texts.cut.format(scale=_scale(cutting.scale, language.notation)), cut, sizes),
            _titled(texts.contour, plane, sizes),
            _titled(texts.sliding.format(scale=scale), sliding, sizes, upright),
            told,
        ]
        return tuple(map(LayoutItem, blocks))


def _titled(title: str, picture: Picture, sizes: Sizes, scale: str = "") -> Block:
    width = max(picture.width, 60.0)
    lines: list[Block] = [heading(title, sizes.title, width=width)]
    if scale:
        below = paragraph(scale, sizes.letter, width, align="centre")
        lines = [Column([*lines, below], gap=2.5, align="centre")]
    return Column([*lines, picture], gap=5.0, align="centre")


def _scale(value: float, notation: Notation) -> str:
    """Return a scale as GOST 2.302 writes it: ``4:1``, ``1:2,5``."""
    return f"{notation.short(value)}:1" if value >= 1 else f"1:{notation.short(1 / value)}"


# Texts and tables -------------------------------------------------------------------------------


def _checks(
    solved: SolvedMeshing, language: Language, title: float, text: float
) -> Iterator[Block]:
    """Yield the given data and the verdicts of the limits, in letters of a height, mm."""
    texts = language.meshing
    yield paragraph(given_text(given_facts(solved, language), language), text, TEXT_WIDTH)
    yield heading(texts.checked, title, width=TEXT_WIDTH)
    section = (texts.helical,) if solved.problem.beta else ()
    for line in (*section, *quality(solved, language), shifts(solved, language)):
        yield paragraph(line, text, TEXT_WIDTH)


def _tables(solved: SolvedMeshing, language: Language, sizes: Sizes) -> Iterator[Block]:
    """Yield the tables of the pair and of the wheels."""
    pair, wheels, contact = solved.sized_quantities()
    texts = language.meshing
    heads: tuple[str, ...] = texts["columns"]
    for told, head in (([*pair, *contact], (*heads[:2], texts.pair)), (wheels, heads)):
        shown = table([one for one in told if one.quantity.in_table], language, head)
        columns = [TableColumn(*column) for column in shown.columns()]
        yield table_block(
            columns, sizes.text, width=sizes.column, units="none", row_height=sizes.row
        )
