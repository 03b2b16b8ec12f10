"""Sheet of an involute meshing (лист «Эвольвентное зацепление»), form 1."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from msgspec import Struct

from planmethod.errors import LayoutError
from planmethod.gears.involute.diagrams import (
    Contour,
    contour_picture,
    sliding_picture,
    sliding_scale,
)
from planmethod.gears.involute.meshpicture import meshing_picture, view_for
from planmethod.gears.involute.quantities import Solved
from planmethod.gears.involute.sizes import MeshingProblem
from planmethod.gears.involute.text import quality, shifts, table
from planmethod.languages import LANGUAGES
from planmethod.note.numbers import Notation
from planmethod.note.wording import Language, language
from planmethod.paper import Format, paper_format
from planmethod.render.frame.frame import STAMP_WIDTH, sheet_frame
from planmethod.render.frame.furniture import Furniture, Room
from planmethod.render.frame.titleblock import merged
from planmethod.render.ink.drawing import Drawing, Item, View
from planmethod.render.ink.lettering import lettering, using
from planmethod.render.layout.block import Block, Column, Picture, heading, paragraph
from planmethod.render.layout.cuttings import GAP, Group, Part
from planmethod.render.layout.pack import EDGE, pack
from planmethod.render.layout.tables import TableColumn, table_block

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile

PAPER = "A1"
"""Format where none is asked for."""

TEXT_WIDTH = STAMP_WIDTH - 10.0
"""Width of the tables, which stand over the title block, mm."""


class Manner(Struct, frozen=True):
    """Heights of letters on views, of titles, tables, checks; of rows; part of the paper for views.

    All but the last in mm.
    """

    letter: float
    title: float
    text: float
    told: float
    row: float
    share: float


MANNERS = (
    Manner(5.0, 7.0, 3.5, 5.0, 10.0, 1.0),
    Manner(5.0, 7.0, 3.5, 3.5, 9.0, 1.0),
    Manner(5.0, 5.0, 3.5, 3.5, 8.0, 0.95),
    Manner(3.5, 5.0, 3.5, 3.5, 6.0, 0.9),
    Manner(3.5, 5.0, 2.5, 2.5, 5.0, 0.9),
    Manner(3.5, 5.0, 2.5, 2.5, 4.5, 0.75),
)
"""Tried in turn until everything has room."""


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
        When all this has no room on the paper that is asked for.
    """
    words = language(problem.sheet.lang or LANGUAGES[0])
    furniture = Furniture.of(problem.sheet, before=before, total=total)
    fmt = paper_format(problem.sheet.paper or PAPER)
    default = {"title": problem.title or words.meshing.sheet, "sheets": "1"}
    texts = merged(default, problem.stamp, furniture.numbers(1, 1), fields)
    solved = Solved(problem)
    contour = Contour.of(solved)
    with using(lettering(problem.sheet.lettering or "B")):
        room = furniture.room(fmt)
        for manner in MANNERS:
            placed = _composed(solved, contour, manner, fmt, room, words)
            if placed is not None:
                drawing = Drawing(fmt.width, fmt.height, texts["title"])
                drawing.extend(sheet_frame(fmt, texts, furniture).items)
                drawing.extend(placed[0])
                drawing.views.append(placed[1])
                return [drawing]
    raise LayoutError(
        "{}: the meshing, its contour, its diagram and its tables do not fit {}. Take --paper {}.",
        problem.name,
        fmt.name,
        PAPER if fmt.width < paper_format(PAPER).width else "A0",
    )


def _composed(
    solved: Solved, contour: Contour, manner: Manner, fmt: Format, room: Room, words: Language
) -> tuple[list[Item], View] | None:
    """Return the items inside the frame and the view of the meshing, or None without room."""
    wide, tall = room.inner[2] - room.inner[0], room.inner[3] - room.inner[1]
    say = words.meshing
    free = wide - STAMP_WIDTH - 2 * EDGE - 2 * GAP
    high = tall - 2 * EDGE - manner.title - 8.0
    told = Column([*_checks(solved, words, manner), *_tables(solved, words, manner)], gap=4.0)
    if told.height + room.stamp[3] + GAP > room.inner[3]:
        return None
    view = view_for(solved, manner.share * 0.6 * free, manner.share * high)
    mesh = meshing_picture(view, words, manner.letter)
    width = manner.share * (free - mesh.width)
    plane = contour_picture(contour, words, width, manner.share * 0.55 * high, manner.letter)
    sliding = sliding_picture(solved, words, width, manner.share * 0.3 * high, manner.letter)
    scale = _scale(sliding_scale(solved, width), words.say)
    blocks: list[Block] = [
        _titled(say.meshing.format(scale=_scale(view.scale, words.say)), mesh, manner),
        _titled(say.contour, plane, manner),
        _titled(say.sliding.format(scale=scale), sliding, manner),
        told,
    ]
    placed = pack(Group(tuple(map(Part, blocks))), room.inner, room.stamp, room.taken)
    if placed is None:
        return None
    items = [item for block, at in placed for item in block.place(at)]
    first, at = placed[0]
    box = (at.real, at.imag - first.height, at.real + first.width, at.imag)
    return items, View("meshing", box)


def _titled(title: str, picture: Picture, manner: Manner) -> Block:
    width = max(picture.width, 60.0)
    return Column([heading(title, manner.title, width=width), picture], gap=5.0, align="centre")


def _scale(value: float, say: Notation) -> str:
    """Return a scale as GOST 2.302 writes it: ``4:1``, ``1:2,5``."""
    return f"{say.short(value)}:1" if value >= 1 else f"1:{say.short(1 / value)}"


# Texts and tables -------------------------------------------------------------------------------


def _checks(solved: Solved, words: Language, manner: Manner) -> Iterator[Block]:
    """Yield what is given and what the limits say."""
    say = words.meshing
    yield heading(say.checked, manner.title, width=TEXT_WIDTH)
    for text in (*quality(solved, words), shifts(solved, words)):
        yield paragraph(text, manner.told, TEXT_WIDTH)


def _tables(solved: Solved, words: Language, manner: Manner) -> Iterator[Block]:
    """Yield the tables of the pair and of the wheels."""
    pair, wheels, contact = solved.told()
    say = words.meshing
    for told, head in (
        ([*pair, *contact], (*say["columns"][:2], say.pair)),
        (wheels, say["columns"]),
    ):
        shown = table([one for one in told if one.quantity.in_table], words, head)
        columns = [TableColumn(*column) for column in shown.columns()]
        yield table_block(
            columns, manner.text, width=TEXT_WIDTH, units="none", row_height=manner.row
        )
