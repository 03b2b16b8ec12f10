"""Frame of a sheet (рамка: GOST 2.301, 2.104): its edge, title block, additional graphs, columns.

The sizes of paper are in `planmethod.paper`, the forms in `planmethod.render.frame.forms`, the
choice of form and graphs in `planmethod.render.frame.furniture`.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Iterator, Mapping
from math import radians
from types import MappingProxyType
from typing import NamedTuple

from msgspec.structs import replace

from planmethod.note.wording import MessageTable, get_language
from planmethod.paper import (
    FORMATS,
    FRAME_LEFT,
    FRAME_OTHER,
    STAMP_HEIGHT,
    STAMP_WIDTH,
    Format,
    paper_format,
)
from planmethod.render.frame.forms import FormCell
from planmethod.render.frame.furniture import Furniture
from planmethod.render.frame.titleblock import (
    STAMP,
    check_fields,
    filled,
    rectangle,
    title_block,
)
from planmethod.render.ink.drawing import Bounds, Item, Pen, Stroke, Text, shifted
from planmethod.render.ink.typeset import typeset

__all__ = [
    "FORMATS",
    "FRAME_LEFT",
    "FRAME_OTHER",
    "MARGIN_NOTE",
    "STAMP",
    "STAMP_HEIGHT",
    "STAMP_WIDTH",
    "Format",
    "Frame",
    "paper_format",
    "sheet_frame",
    "title_block",
]

MARGIN_NOTE = "margin"
"""Tag of texts that belong outside the frame."""


class Frame(NamedTuple):
    """Frame of a sheet: its items, and the area that it leaves, mm, see `DrawingArea`."""

    items: list[Item]
    inner: Bounds
    stamp: Bounds
    reserved: tuple[Bounds, ...]


def sheet_frame(
    paper: Format | str,
    fields: Mapping[str, str] = MappingProxyType({}),
    furniture: Furniture = Furniture(),  # noqa: B008 - it is frozen
    *,
    sheet: int = 1,
) -> Frame:
    """Return the sheet's edge, frame, title block and additional graphs (оформление листа).

    Parameters
    ----------
    paper : Format or str
    fields : mapping
        Texts by the keys of `planmethod.problem.common.TITLE_BLOCK`.
    furniture : Furniture
        Which form and which additional graphs.
    sheet : int
        Number of the sheet within the furniture's set, counted from 1.

    Raises
    ------
    LayoutError
        If a field is unknown.
    """
    paper = paper_format(paper) if isinstance(paper, str) else paper
    check_fields(fields)
    if not {"sheet", "sheets"} & fields.keys():
        fields = {**fields, "sheets": "1"}  # GOST 2.104: a single sheet is counted, not numbered
    texts = get_language(furniture.lang).frame
    room = furniture.drawing_area(paper, sheet)
    edge = rectangle((0.0, 0.0, paper.width, paper.height), Pen.THIN, "edge")
    items: list[Item] = [edge, rectangle(room.inner, Pen.FRAME, "frame")]
    corner = complex(room.stamp[0], room.stamp[1])
    items += shifted(title_block(fields, furniture.form_of(sheet), lang=furniture.lang), corner)
    turn = 90.0 if paper.is_portrait and paper.size != "A4" else 180.0
    for number, box in furniture.graphs(paper, sheet).items():
        items.append(rectangle(box, Pen.FRAME, STAMP))
        if number == "26" and fields.get("designation"):
            items += _fill_rotated(str(fields["designation"]), FormCell(box, 7.0), turn, STAMP)
    if furniture.side_columns:
        items += _side_columns(paper, fields, texts, first=furniture.is_first(sheet))
    items += _under_the_frame(paper, texts)
    return Frame(items, room.inner, room.stamp, room.reserved)


# In the binding margin -------------------------------------------------------------------------

_CAPTION_COLUMN, _VALUE_COLUMN = (8.0, 13.0), (13.0, 20.0)

# GOST 2.104, graphs 19 to 23 from the bottom up, 24 and 25 from the top down: caption, which is the
# field beside it too, and length of the cell.
_FROM_BELOW = (
    ("inventory", 25.0),
    ("signed", 35.0),
    ("inventory_instead", 25.0),
    ("inventory_copy", 25.0),
    ("signed", 35.0),
)
_FROM_ABOVE = (("first_use", 60.0), ("reference", 60.0))


def _side_columns(
    paper: Format, fields: Mapping[str, str], texts: MessageTable, *, first: bool
) -> Iterator[Item]:
    """Yield the cells in the binding margin; their texts read from the bottom up."""
    _, low, _, high = paper.inner
    cells: list[tuple[str, float, float]] = []
    for key, length in _FROM_BELOW:
        cells.append((key, low, low + length))
        low += length
    for key, length in _FROM_ABOVE if first else ():
        cells.append((key, high - length, high))
        high -= length
    for key, bottom, top in cells:
        for (x0, x1), text, size in (
            (_CAPTION_COLUMN, texts["captions"][key], 2.5),
            (_VALUE_COLUMN, str(fields.get(key, "")), 3.5),
        ):
            box = (x0, bottom, x1, top)
            yield rectangle(box, Pen.FRAME, STAMP)
            if text:
                yield from _fill_rotated(text, FormCell(box, size), 90.0, f"{STAMP} {MARGIN_NOTE}")


def _fill_rotated(text: str, cell: FormCell, angle: float, tag: str) -> list[Item]:
    """Put a text into its cell turned by a multiple of 90 degrees, counter-clockwise."""
    x0, y0, x1, y1 = cell.box
    middle = complex(x0 + x1, y0 + y1) / 2
    wide, tall = (x1 - x0, y1 - y0) if angle % 180.0 == 0.0 else (y1 - y0, x1 - x0)
    flat = (
        middle.real - wide / 2,
        middle.imag - tall / 2,
        middle.real + wide / 2,
        middle.imag + tall / 2,
    )
    return list(_rotate(filled(text, cell._replace(box=flat), tag), middle, angle, cell.box))


def _rotate(items: Iterable[Item], about: complex, angle: float, box: Bounds) -> Iterator[Item]:
    """Yield the letters and overbars of a text turned about a point, in their new cell."""
    turn = cmath.exp(1j * radians(angle))
    for item in items:
        if isinstance(item, Text):
            at = about + turn * (item.at - about)
            yield replace(item, at=at, angle=item.angle + angle, box=box)
        elif isinstance(item, Stroke):
            yield replace(item, points=tuple(about + turn * (p - about) for p in item.points))


def _under_the_frame(paper: Format, texts: MessageTable) -> list[Item]:
    """Return the notes below the title block: copyist and format (графы 31, 32)."""
    right = paper.width - FRAME_OTHER
    base = (FRAME_OTHER - 2.5) / 2
    copied = typeset(texts.copied, 2.5)
    name = typeset(texts.format.format(paper=paper.written(texts.paper)), 2.5)
    items = copied.at(complex(right - STAMP_WIDTH + 75.0, base), tag=MARGIN_NOTE)
    return items + name.at(complex(right - 35.0, base), tag=MARGIN_NOTE)
