"""Formats, frame and title block (форматы, рамка, основная надпись: GOST 2.301, 2.104 form 1).

The title block is data: one table of lines, one of captions, one of the fields and their cells, all
in mm from its own lower left corner.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from types import MappingProxyType
from typing import NamedTuple

from planmethod.errors import LayoutError
from planmethod.render.block import Align, fit
from planmethod.render.drawing import Bounds, Item, Pen, Stroke, shifted
from planmethod.render.style import HEIGHTS
from planmethod.render.typeset import escape, smaller_heights, typeset

FRAME_LEFT = 20.0
"""From the left edge of the sheet to the frame, mm (room for binding)."""
FRAME_OTHER = 5.0
"""From the other edges to the frame, mm."""
STAMP_WIDTH, STAMP_HEIGHT = 185.0, 55.0

STAMP = "stamp"
"""Tag of the lines and texts of the title block."""

MARGIN_NOTE = "margin"
"""Tag of texts that belong outside the frame."""


@dataclass(frozen=True, slots=True)
class Format:
    """Paper format (формат), mm; ``name`` in Latin letters, as on the command line."""

    name: str
    width: float
    height: float

    @property
    def inner(self) -> Bounds:
        """Inside of the frame, mm."""
        right, top = self.width - FRAME_OTHER, self.height - FRAME_OTHER
        return (FRAME_LEFT, FRAME_OTHER, right, top)

    @property
    def stamp(self) -> Bounds:
        """Title block, mm: the lower right corner inside the frame."""
        right = self.width - FRAME_OTHER
        return (right - STAMP_WIDTH, FRAME_OTHER, right, FRAME_OTHER + STAMP_HEIGHT)


FORMATS: Mapping[str, Format] = MappingProxyType(
    {
        fmt.name: fmt
        for fmt in (
            Format("A4", 210, 297),  # GOST 2.301: A4 stands, the others may lie
            Format("A3", 420, 297),
            Format("A2", 594, 420),
            Format("A1", 841, 594),
            Format("A0", 1189, 841),
            Format("A4x3", 630, 297),
            Format("A4x4", 841, 297),
            Format("A3x3", 891, 420),
            Format("A2x3", 1261, 594),
            Format("A1x3", 1783, 841),
        )
    }
)


class Cell(NamedTuple):
    """Cell of the title block: box, greatest letter height, side it is set to."""

    box: Bounds
    height: float
    align: Align = "centre"


# Lines of form 1: x0, y0, x1, y1. Thick ones outline the cells of other people's hands; rows of the
# left part and the three small cells of "Лит." are thin.
_THICK: tuple[Bounds, ...] = (
    (0, 0, 185, 0),
    (185, 0, 185, 55),
    (0, 55, 185, 55),
    (0, 0, 0, 55),
    (7, 30, 7, 55),
    (17, 0, 17, 55),
    (40, 0, 40, 55),
    (55, 0, 55, 55),
    (65, 0, 65, 55),
    (0, 30, 65, 30),
    (0, 35, 65, 35),
    (65, 40, 185, 40),
    (65, 15, 185, 15),
    (135, 0, 135, 40),
    (135, 35, 185, 35),
    (135, 20, 185, 20),
    (150, 20, 150, 40),
    (167, 20, 167, 40),
    (155, 15, 155, 20),
)
_THIN: tuple[Bounds, ...] = (
    *((0, y, 65, y) for y in (5, 10, 15, 20, 25, 40, 45, 50)),
    (140, 20, 140, 35),  # the last two divide "Лит."
    (145, 20, 145, 35),
)

_CAPTIONS: tuple[tuple[str, Bounds, Align], ...] = (
    ("Изм.", (0, 30, 7, 35), "centre"),
    ("Лист", (7, 30, 17, 35), "centre"),
    ("№ докум.", (17, 30, 40, 35), "centre"),
    ("Подп.", (40, 30, 55, 35), "centre"),
    ("Дата", (55, 30, 65, 35), "centre"),
    ("Разраб.", (0, 25, 17, 30), "left"),
    ("Пров.", (0, 20, 17, 25), "left"),
    ("Т.контр.", (0, 15, 17, 20), "left"),
    ("Н.контр.", (0, 5, 17, 10), "left"),
    ("Утв.", (0, 0, 17, 5), "left"),
    ("Лит.", (135, 35, 150, 40), "centre"),
    ("Масса", (150, 35, 167, 40), "centre"),
    ("Масштаб", (167, 35, 185, 40), "centre"),
    ("Лист", (135, 15, 146, 20), "left"),
    ("Листов", (155, 15, 171, 20), "left"),
)

_HANDS = {
    "author": 25,
    "checker": 20,
    "t_control": 15,
    "extra": 10,
    "norm_control": 5,
    "approver": 0,
}


def _hands() -> Iterator[tuple[str, Cell]]:
    """Yield the cells of surnames and dates of the left part."""
    for role, y in _HANDS.items():
        yield role, Cell((17, y, 40, y + 5), 2.5, "left")
        yield f"{role}_date", Cell((55, y, 65, y + 5), 2.5)


_CELLS: Mapping[str, Cell] = MappingProxyType(
    {
        "designation": Cell((65, 40, 185, 55), 7.0),
        "title": Cell((65, 15, 135, 40), 5.0),
        "material": Cell((65, 0, 135, 15), 3.5),
        "mass": Cell((150, 20, 167, 35), 3.5),
        "scale": Cell((167, 20, 185, 35), 3.5),
        "sheet": Cell((146, 15, 155, 20), 2.5),
        "sheets": Cell((171, 15, 185, 20), 2.5),
        "extra_role": Cell((0, 10, 17, 15), 2.5, "left"),
        **dict(_hands()),
    }
)
_ORGANISATION = Cell((135, 0, 185, 15), 3.5)
_LETTERS = ((135.0, 20.0, 140.0, 35.0), (140.0, 20.0, 145.0, 35.0), (145.0, 20.0, 150.0, 35.0))

STAMP_FIELDS: Mapping[str, str] = MappingProxyType(
    {
        "designation": "Обозначение (графа 2): ТММ.КП.12.03.00.000",
        "title": "Наименование (графа 1): what the sheet shows",
        "material": "Материал (графа 3): the subject in coursework",
        "subject": "the same place as material: the discipline or theme",
        "organisation": "Организация (графа 9), first line",
        "department": "Кафедра: second line of graph 9",
        "group": "Группа: third line of graph 9",
        "author": "Разраб.: surname",
        "checker": "Пров.: surname",
        "t_control": "Т.контр.: surname",
        "norm_control": "Н.контр.: surname",
        "approver": "Утв.: surname",
        "extra": "surname in the free row",
        "extra_role": "what the free row is for: Конс.",
        "date": "date beside the surname of the author",
        "author_date": "the same place as date",
        "checker_date": "date",
        "t_control_date": "date",
        "norm_control_date": "date",
        "approver_date": "date",
        "extra_date": "date",
        "letter": "Литера (графа 4), up to three letters: У",
        "mass": "Масса (графа 5)",
        "scale": "Масштаб (графа 6): 1:2",
        "sheet": "Лист (графа 7): number of the sheet",
        "sheets": "Листов (графа 8): how many sheets",
    }
)
"""Fields of the title block and what they are; all of them are optional."""


def paper_format(name: str) -> Format:
    """Return the format called ``name``: ``A3``, also with Cyrillic ``А`` or ``х`` and any case.

    Raises
    ------
    LayoutError
        If there is no such format.
    """
    latin = name.strip().translate(str.maketrans("АаaХхX×*", "AAAxxxxx"))
    fmt = FORMATS.get(latin)
    if fmt is None:
        raise LayoutError(f"Unknown paper format {name!r}. Choose one of: {', '.join(FORMATS)}.")
    return fmt


def sheet_frame(
    fmt: Format | str,
    fields: Mapping[str, str] = MappingProxyType({}),
    *,
    graph_26: bool = False,
) -> tuple[list[Item], Bounds, Bounds]:
    """Return the sheet's edge, frame and title block (рамка и основная надпись).

    Parameters
    ----------
    fmt : Format or str
    fields : mapping
        Texts of the title block by the keys of `STAMP_FIELDS`.
    graph_26 : bool
        Also draw the additional cell with the designation upside down, 70x14 mm in the upper left
        corner (see `graph_26_bounds`).

    Returns
    -------
    items : list of Item
    inner : Bounds, mm
        Inside of the frame.
    stamp : Bounds, mm
        The title block, which takes room of the inside.

    Raises
    ------
    LayoutError
        If a field is unknown.
    """
    paper = paper_format(fmt) if isinstance(fmt, str) else fmt
    inner, stamp = paper.inner, paper.stamp
    edge = _rectangle((0.0, 0.0, paper.width, paper.height), Pen.THIN, "edge")
    items: list[Item] = [edge, _rectangle(inner, Pen.FRAME, "frame")]
    items += shifted(title_block(fields), complex(stamp[0], stamp[1]))
    if graph_26:
        items += _graph_26(paper, fields.get("designation", ""))
    items += _under_the_frame(paper)
    return items, inner, stamp


def title_block(fields: Mapping[str, str] = MappingProxyType({})) -> list[Item]:
    """Return form 1 of GOST 2.104, 185x55 mm, its lower left corner at the origin.

    A text that does not fit its cell shrinks to the next letter height, then is wrapped, then
    shrinks further; it never leaves the cell.
    """
    _check(fields)
    items: list[Item] = []
    letters = str(fields.get("letter", "")).replace(" ", "")
    thin = _THIN if len(letters) <= len(_LETTERS) else _THIN[:-2]
    for lines, pen in ((thin, Pen.THIN), (_THICK, Pen.FRAME)):
        items += [
            Stroke((complex(x0, y0), complex(x1, y1)), pen, tag=STAMP) for x0, y0, x1, y1 in lines
        ]
    for caption, box, align in _CAPTIONS:
        items += _filled(caption, Cell(box, 2.5, align))
    values = {key: str(value).strip() for key, value in fields.items()}
    for alias, key in (("subject", "material"), ("date", "author_date")):
        values[key] = values.get(key, "") or values.get(alias, "")
    for key, cell in _CELLS.items():
        if values.get(key):
            items += _filled(values[key], cell)
    place = (values.get(key, "") for key in ("organisation", "department", "group"))
    whole = "\n".join(line for line in place if line)
    if whole:
        items += _filled(whole, _ORGANISATION)
    if len(letters) > len(_LETTERS):
        box = (_LETTERS[0][0], _LETTERS[0][1], _LETTERS[-1][2], _LETTERS[-1][3])
        items += _filled(letters, Cell(box, 3.5))
    else:
        for letter, box in zip(letters, _LETTERS, strict=False):
            items += _filled(letter, Cell(box, 3.5))
    return items


def graph_26_bounds(fmt: Format) -> Bounds:
    """Return the cell of graph 26, mm: upper left corner inside the frame."""
    left, _, _, top = fmt.inner
    return (left, top - 14.0, left + 70.0, top)


def _check(fields: Mapping[str, str]) -> None:
    for key in fields:
        if key not in STAMP_FIELDS:
            near = get_close_matches(key, STAMP_FIELDS, n=1)
            hint = f"Did you mean {near[0]}?" if near else f"Known: {', '.join(STAMP_FIELDS)}."
            raise LayoutError(f"Unknown field {key!r} of the title block. {hint}")


def _filled(text: str, cell: Cell) -> list[Item]:
    """Put a text into its cell; in narrow cells less white is left at the sides."""
    wide = cell.box[2] - cell.box[0]
    pad = 0.45 if wide <= 10 else 0.6 if wide <= 25 else 1.5
    # 2.5 mm is the smallest for drawings; 1.8, the smallest of all, is better than a cut surname.
    heights = (*smaller_heights(cell.height), HEIGHTS[0])
    return fit(text, cell.box, heights, align=cell.align, pad=pad, tag=STAMP)


def _graph_26(fmt: Format, designation: str) -> list[Item]:
    box = graph_26_bounds(fmt)
    items: list[Item] = [_rectangle(box, Pen.FRAME, STAMP)]
    for height in smaller_heights(7.0):
        line = typeset(escape(designation), height)
        if line.width <= 67.0:
            break
    centre = complex((box[0] + box[2]) / 2, (box[1] + box[3]) / 2 + height / 2)
    if designation:
        items += line.at(centre, anchor="centre", angle=180.0, box=box, tag=STAMP)
    return items


def _under_the_frame(fmt: Format) -> list[Item]:
    """Return the notes below the title block: who copied, which format."""
    right = fmt.width - FRAME_OTHER
    base = (FRAME_OTHER - 2.5) / 2
    cyrillic = fmt.name.replace("A", "А").replace("x", "х")
    copied = typeset("Копировал", 2.5)
    name = typeset(f"Формат {cyrillic}", 2.5)
    items = copied.at(complex(right - STAMP_WIDTH + 75.0, base), tag=MARGIN_NOTE)
    return items + name.at(complex(right - 35.0, base), tag=MARGIN_NOTE)


def _rectangle(box: Bounds, pen: Pen, tag: str) -> Stroke:
    x0, y0, x1, y1 = box
    corners = (complex(x0, y0), complex(x1, y0), complex(x1, y1), complex(x0, y1))
    return Stroke(corners, pen, closed=True, tag=tag)
