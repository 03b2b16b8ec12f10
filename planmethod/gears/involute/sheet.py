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
    given,
    given_text,
    quality,
    shifts,
    table,
)
from planmethod.languages import LANGUAGES, say
from planmethod.note.numbers import Notation
from planmethod.note.wording import Language, language
from planmethod.paper import STAMP_WIDTH
from planmethod.render.frame.furniture import Furniture, Room
from planmethod.render.ink.drawing import Drawing
from planmethod.render.layout.block import Block, Column, Picture, heading, paragraph
from planmethod.render.layout.cuttings import GAP, Group, Packed
from planmethod.render.layout.pack import EDGE
from planmethod.render.layout.tables import TableColumn, table_block
from planmethod.render.sheets.composer import Blank, Misfit, Packing, Sizes, Viewed, compose

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
    words = language(problem.sheet.lang or LANGUAGES[0])
    furniture = Furniture.of(problem.sheet, before=before, total=total)
    misfit = Misfit(
        lambda paper, advice: LayoutError(
            "{}: the meshing, its contour, its diagram and its tables do not fit {}. {}",
            problem.name,
            paper,
            advice,
        ),
        say("Take another --paper."),
    )
    strategy = _Meshing(SolvedMeshing(problem), words)
    title = problem.title or words.meshing.sheet
    return compose(problem, strategy, misfit, fields=fields, furniture=furniture, title=title)


class _Meshing(Struct, frozen=True):
    """Search for the layout of the sheet of a mesh, with ever smaller letters and views."""

    solved: SolvedMeshing
    words: Language

    formats = ("A1",)

    def proposals(self, papers: Sequence[Blank]) -> Iterator[Packing]:
        """Yield the blocks at sizes at which the tables fit."""
        contour = Contour.of(self.solved)
        for paper, (sizes, checks, share) in product(papers, TRIES):
            parts = self._parts(contour, paper.room(), sizes, checks, share)
            if parts is not None:
                yield Packing(paper, (Group(parts),))

    def _parts(
        self, contour: Contour, room: Room, sizes: Sizes, checks: float, share: float
    ) -> tuple[Packed, ...] | None:
        """Return the blocks in reading order; None where the tables are too high."""
        solved, words, say = self.solved, self.words, self.words.meshing
        wide, tall = room.inner[2] - room.inner[0], room.inner[3] - room.inner[1]
        free = wide - STAMP_WIDTH - 2 * EDGE - 2 * GAP
        high = tall - 2 * EDGE - sizes.title - 8.0
        told = Column(
            [*_checks(solved, words, sizes.title, checks), *_tables(solved, words, sizes)], gap=4.0
        )
        if told.height + room.stamp[3] + GAP > room.inner[3]:
            return None
        view = view_for(solved, share * 0.6 * free, share * high)
        mesh = meshing_picture(view, words, sizes.letter, *mesh_dimensions(view, sizes.letter))
        width = share * (free - mesh.width)
        plane = contour_picture(contour, words, width, share * 0.36 * high, sizes.letter)
        low = share * 0.24 * high
        sliding = sliding_picture(solved, words, width, low, sizes.letter)
        pinion = solved.cuttings[0]
        assert pinion is not None  # only wheel 2 may be a ring
        cutting = cutting_view(pinion, width, share * 0.36 * high)
        cut = cutting_picture(cutting, words, sizes.letter)
        scale = _scale(sliding_scale(solved, width), words.say)
        per_mm = words.say.given(sliding_per_mm(solved, low))
        upright = say.sliding_scale.format(scale=per_mm)
        title = say.meshing.format(scale=_scale(view.scale, words.say))
        blocks: list[Block] = [
            Viewed(_titled(title, mesh, sizes), "meshing", None),
            _titled(say.cut.format(scale=_scale(cutting.scale, words.say)), cut, sizes),
            _titled(say.contour, plane, sizes),
            _titled(say.sliding.format(scale=scale), sliding, sizes, upright),
            told,
        ]
        return tuple(map(Packed, blocks))


def _titled(title: str, picture: Picture, sizes: Sizes, scale: str = "") -> Block:
    width = max(picture.width, 60.0)
    lines: list[Block] = [heading(title, sizes.title, width=width)]
    if scale:
        below = paragraph(scale, sizes.letter, width, align="centre")
        lines = [Column([*lines, below], gap=2.5, align="centre")]
    return Column([*lines, picture], gap=5.0, align="centre")


def _scale(value: float, say: Notation) -> str:
    """Return a scale as GOST 2.302 writes it: ``4:1``, ``1:2,5``."""
    return f"{say.short(value)}:1" if value >= 1 else f"1:{say.short(1 / value)}"


# Texts and tables -------------------------------------------------------------------------------


def _checks(solved: SolvedMeshing, words: Language, title: float, text: float) -> Iterator[Block]:
    """Yield the given data and the verdicts of the limits, in letters of a height, mm."""
    say = words.meshing
    yield paragraph(given_text(given(solved, words), words), text, TEXT_WIDTH)
    yield heading(say.checked, title, width=TEXT_WIDTH)
    section = (say.helical,) if solved.problem.beta else ()
    for line in (*section, *quality(solved, words), shifts(solved, words)):
        yield paragraph(line, text, TEXT_WIDTH)


def _tables(solved: SolvedMeshing, words: Language, sizes: Sizes) -> Iterator[Block]:
    """Yield the tables of the pair and of the wheels."""
    pair, wheels, contact = solved.told()
    say = words.meshing
    heads: tuple[str, ...] = say["columns"]
    for told, head in (([*pair, *contact], (*heads[:2], say.pair)), (wheels, heads)):
        shown = table([one for one in told if one.quantity.in_table], words, head)
        columns = [TableColumn(*column) for column in shown.columns()]
        yield table_block(
            columns, sizes.text, width=sizes.column, units="none", row_height=sizes.row
        )
