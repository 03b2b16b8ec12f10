"""Frame of a sheet (GOST 2.301, 2.104): forms of the title block, drawing area, numbers."""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from math import radians
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

from msgspec import Struct
from msgspec.structs import replace

from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES, translate
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
from planmethod.problem.names import nearest_name_hint
from planmethod.problem.records import TITLE_BLOCK, SheetSettings
from planmethod.render.ink.drawing import HEIGHTS, Bounds, Drawing, Item, Pen, Stroke, Text, shifted
from planmethod.render.ink.lettering import in_use, lettering, using
from planmethod.render.ink.typeset import smaller_heights, typeset
from planmethod.render.layout.block import CUT, Align, DrawingArea, fit_text


class FormCell(NamedTuple):
    """Cell of a form: box, greatest letter height, side that the text is set to."""

    box: Bounds
    height: float
    align: Align = "centre"


Caption: TypeAlias = tuple[str, Bounds, Align]


class Form(Struct, frozen=True):
    """Form of the title block (форма основной надписи), mm from its lower left corner.

    Attributes
    ----------
    thick_lines, thin_lines : tuple of Bounds
        Lines, from (x0, y0) to (x1, y1); the outline is drawn besides. Thick ones part the graphs,
        thin ones the rows and the three small cells of "Лит.".
    captions : tuple of (str, Bounds, Align)
        By their names in ``captions`` of a language's ``frame``.
    cells : mapping of str to FormCell
        Where the fields go; a form leaves out fields that it has no graph for.
    organisation : FormCell, optional
        Graph 9, which several fields share.
    letters : tuple of Bounds
        The small cells of graph 4, from the left.
    """

    name: str
    width: float
    height: float
    thick_lines: tuple[Bounds, ...]
    thin_lines: tuple[Bounds, ...]
    captions: tuple[Caption, ...]
    cells: Mapping[str, FormCell]
    organisation: FormCell | None = None
    letters: tuple[Bounds, ...] = ()

    @property
    def dividers(self) -> tuple[Bounds, ...]:
        """Thin lines between the small cells of graph 4."""
        return tuple((x1, y0, x1, y1) for _, y0, x1, y1 in self.letters[:-1])


# The left part, alike in all forms: columns of the table of changes and of the signatures.
_COLUMNS = (
    ("change", 0, 7),
    ("changed", 7, 17),
    ("document", 17, 40),
    ("signature", 40, 55),
    ("date", 55, 65),
)


def _header(y: float) -> tuple[Caption, ...]:
    """Return the captions of the columns in the row that begins at ``y``."""
    return tuple((caption, (x0, y, x1, y + 5), "centre") for caption, x0, x1 in _COLUMNS)


def _signature_cells(rows: Sequence[str]) -> Iterator[tuple[str, FormCell]]:
    """Yield the cells of surnames and dates; the roles of ``rows`` go from the bottom up."""
    for y, role in zip(range(0, 5 * len(rows), 5), rows, strict=True):
        yield role, FormCell((17, y, 40, y + 5), 2.5, "left")
        yield f"{role}_date", FormCell((55, y, 65, y + 5), 2.5)
        if role == "extra":
            yield "extra_role", FormCell((0, y, 17, y + 5), 2.5, "left")


def _roles(rows: Sequence[str]) -> Iterator[Caption]:
    """Yield the captions of the rows of signatures; the free row has none."""
    for y, role in zip(range(0, 5 * len(rows), 5), rows, strict=True):
        if role != "extra":
            yield role, (0, y, 17, y + 5), "left"


def _rows(*levels: float) -> tuple[Bounds, ...]:
    """Return lines across the left part."""
    return tuple((0, y, 65, y) for y in levels)


def _uprights(header: float, height: float) -> tuple[Bounds, ...]:
    """Return the lines between the columns of the left part; the first begins at the header."""
    return tuple((x, 0 if k else header, x, height) for k, (_, _, x) in enumerate(_COLUMNS))


def _small_cells(y0: float, y1: float) -> tuple[Bounds, ...]:
    """Return the three cells of graph 4."""
    return tuple((x, y0, x + 5, y1) for x in (135.0, 140.0, 145.0))


_SIGNATURES_1 = ("approver", "norm_control", "extra", "t_control", "checker", "author")
_LETTERS_1, _LETTERS_2 = _small_cells(20, 35), _small_cells(15, 20)

FORM_1 = Form(
    name="1",
    width=STAMP_WIDTH,
    height=STAMP_HEIGHT,
    thick_lines=(
        *_uprights(30, 55),
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
    ),
    thin_lines=_rows(5, 10, 15, 20, 25, 40, 45, 50),
    captions=(
        *_header(30),
        *_roles(_SIGNATURES_1),
        ("letter", (135, 35, 150, 40), "centre"),
        ("mass", (150, 35, 167, 40), "centre"),
        ("scale", (167, 35, 185, 40), "centre"),
        ("sheet", (135, 15, 146, 20), "left"),
        ("sheets", (155, 15, 171, 20), "left"),
    ),
    cells=MappingProxyType(
        {
            "designation": FormCell((65, 40, 185, 55), 7.0),
            "title": FormCell((65, 15, 135, 40), 5.0),
            "material": FormCell((65, 0, 135, 15), 3.5),
            "mass": FormCell((150, 20, 167, 35), 3.5),
            "scale": FormCell((167, 20, 185, 35), 3.5),
            "sheet": FormCell((146, 15, 155, 20), 2.5),
            "sheets": FormCell((171, 15, 185, 20), 2.5),
            **dict(_signature_cells(_SIGNATURES_1)),
        }
    ),
    organisation=FormCell((135, 0, 185, 15), 3.5),
    letters=_LETTERS_1,
)
"""Form 1: every sheet of a drawing (185x55 mm)."""

_SIGNATURES_2 = tuple(role for role in _SIGNATURES_1 if role != "t_control")

FORM_2 = Form(
    name="2",
    width=185.0,
    height=40.0,
    thick_lines=(
        *_uprights(25, 40),
        (0, 25, 185, 25),
        (0, 30, 65, 30),
        (135, 0, 135, 25),
        (135, 20, 185, 20),
        (135, 15, 185, 15),
        (150, 15, 150, 25),
        (165, 15, 165, 25),
    ),
    thin_lines=_rows(5, 10, 15, 20, 35),
    captions=(
        *_header(25),
        *_roles(_SIGNATURES_2),
        ("letter", (135, 20, 150, 25), "centre"),
        ("sheet", (150, 20, 165, 25), "centre"),
        ("sheets", (165, 20, 185, 25), "centre"),
    ),
    cells=MappingProxyType(
        {
            "designation": FormCell((65, 25, 185, 40), 7.0),
            "title": FormCell((65, 0, 135, 25), 5.0),
            "sheet": FormCell((150, 15, 165, 20), 2.5),
            "sheets": FormCell((165, 15, 185, 20), 2.5),
            **dict(_signature_cells(_SIGNATURES_2)),
        }
    ),
    organisation=FormCell((135, 0, 185, 15), 3.5),
    letters=_LETTERS_2,
)
"""Form 2: first sheet of a text document (185x40 mm)."""

FORM_2A = Form(
    name="2a",
    width=185.0,
    height=15.0,
    thick_lines=(
        *_uprights(0, 15),
        (175, 0, 175, 15),
        (0, 5, 65, 5),
        (175, 8, 185, 8),
    ),
    thin_lines=_rows(10),
    captions=(*_header(0), ("sheet", (175, 8, 185, 15), "centre")),
    cells=MappingProxyType(
        {
            "designation": FormCell((65, 0, 175, 15), 7.0),
            "sheet": FormCell((175, 0, 185, 8), 3.5),
        }
    ),
)
"""Form 2a: later sheets of a text document, and of a drawing where that is wished (185x15 mm)."""


STAMP = "stamp"
"""Tag of the lines and texts of the title block."""

ALIASES: Mapping[str, str] = MappingProxyType({"subject": "material", "date": "author_date"})
"""Fields with a second name, by their meaning instead of their graph."""

SHARED = ("organisation", "department", "group")
"""Fields that share graph 9, from the top."""


def merged(*layers: Mapping[str, str]) -> dict[str, str]:
    """Return the fields of several layers, the later ones over the earlier.

    A field has one place under either name: ``date`` of a layer outranks ``author_date`` of the
    layers below. An empty text clears the field.
    """
    fields: dict[str, str] = {}
    for layer in layers:
        fields |= {ALIASES[key]: text for key, text in layer.items() if key in ALIASES}
        fields |= {key: text for key, text in layer.items() if key not in ALIASES}
    return {key: text for key, text in fields.items() if text}


def title_block(
    fields: Mapping[str, str] = MappingProxyType({}),
    form: Form = FORM_1,
    *,
    lang: str = LANGUAGES[0],
) -> list[Item]:
    """Return the title block, its lower left corner at the origin.

    A text that does not fit its cell shrinks to the next letter height, then is wrapped, then
    shrinks further, but for graph 1, which is wrapped first to have one height on all sheets;
    it never leaves the cell. Fields that the form has no graph for are not shown.

    Raises
    ------
    LayoutError
        If a field is unknown.
    """
    check_fields(fields)
    captions = get_language(lang).frame["captions"]
    values = merged({key: str(value).strip() for key, value in fields.items()})
    letters = values.get("letter", "").replace(" ", "")
    divided = len(letters) <= len(form.letters)
    items: list[Item] = []
    for lines, pen in (
        ((*form.thin_lines, *(form.dividers if divided else ())), Pen.LETTER),
        (form.thick_lines, Pen.FRAME),
    ):
        items += [
            Stroke((complex(x0, y0), complex(x1, y1)), pen, tag=STAMP) for x0, y0, x1, y1 in lines
        ]
    items.append(rectangle((0.0, 0.0, form.width, form.height), Pen.FRAME, STAMP))
    for caption, box, align in form.captions:
        items += filled(captions[caption], FormCell(box, 2.5, align))
    for key, cell in form.cells.items():
        if key in values:
            items += filled(values[key], cell, f"{STAMP} {key}", shrink_first=key != "title")
    whole = "\n".join(values[key] for key in SHARED if key in values)
    if whole and form.organisation is not None:
        items += filled(whole, form.organisation, f"{STAMP} organisation")
    items += _letters(letters, form.letters, divided=divided)
    return items


def _letters(letters: str, boxes: tuple[Bounds, ...], *, divided: bool) -> Iterable[Item]:
    """Yield graph 4: a letter in each small cell, or all of them in one where there are more."""
    if not boxes or not letters:
        return
    if not divided:
        yield from filled(letters, FormCell((*boxes[0][:2], *boxes[-1][2:]), 3.5))
        return
    for letter, box in zip(letters, boxes, strict=False):
        yield from filled(letter, FormCell(box, 3.5))


def check_fields(fields: Iterable[str]) -> None:
    """Refuse a field that is unknown, and name the nearest one.

    Raises
    ------
    LayoutError
    """
    for key in fields:
        if key not in TITLE_BLOCK:
            hint = nearest_name_hint(
                key, TITLE_BLOCK, translate("Known: {}.", ", ".join(TITLE_BLOCK))
            )
            raise LayoutError("Unknown field {!r} of the title block. {}", key, hint)


def filled(text: str, cell: FormCell, tag: str = STAMP, *, shrink_first: bool = True) -> list[Item]:
    """Put a text into its cell; in narrow cells less white is left at the sides.

    A text that would be smaller, or wrapped, in the lettering in use is set in the narrow one, if
    that is larger in one line.
    """
    wide = cell.box[2] - cell.box[0]
    pad = 0.45 if wide <= 7 else 0.45 if wide <= 10 else 0.6 if wide <= 25 else 1.5
    # 2.5 mm is the smallest for drawings; 1.8, the smallest of all, is better than a cut surname.
    heights = smaller_heights(cell.height)
    fit = partial(fit_text, text, cell.box, align=cell.align, pad=pad, tag=tag)
    usual = fit((*heights, HEIGHTS[0]), shrink_first=shrink_first)
    narrow, reached = in_use().style.narrow, _height_in_line(usual)
    for height in heights if shrink_first and narrow else ():
        if height > reached:
            with using(lettering(narrow)):
                tried = fit((height,))
            if _height_in_line(tried) == height:
                return [replace(one, lettering=narrow) if isinstance(one, Text) else one
                        for one in tried]  # fmt: skip
    return usual


def _height_in_line(items: Sequence[Item]) -> float:
    """Return the height of the letters of a text in one line; 0 if it has more, or is cut."""
    runs = [one for one in items if isinstance(one, Text)]
    lines = {run.label for run in runs}
    if len(lines) != 1 or any(run.tag.endswith(CUT) for run in runs):
        return 0.0
    return max(run.height for run in runs)


def rectangle(box: Bounds, pen: Pen, tag: str) -> Stroke:
    """Return the outline of a box."""
    x0, y0, x1, y1 = box
    corners = (complex(x0, y0), complex(x1, y0), complex(x1, y1), complex(x0, y1))
    return Stroke(corners, pen, closed=True, tag=tag)


FORMS: Mapping[str, tuple[Form, Form]] = MappingProxyType(
    {
        "1": (FORM_1, FORM_1),
        "1+2a": (FORM_1, FORM_2A),
        "2": (FORM_2, FORM_2A),
        "2a": (FORM_2A, FORM_2A),
    }
)
"""Forms of the first and of the later sheets, by the name of the pair in files and options."""

Graphs: TypeAlias = Mapping[str, Bounds]
"""Cells of additional graphs by number, mm on the sheet."""

_GRAPHS_27_29_WIDTH = 67.0  # mm: graphs 27 to 29 beside graph 26
_GRAPHS_HEIGHT = {"1": 8.0, "2": 22.0}  # mm: graph 30, or 27 to 30, above the title block


class Furniture(Struct, frozen=True):
    """Furniture around the drawings of a set of sheets (оформление комплекта листов).

    Attributes
    ----------
    form : str
        A key of `FORMS`.
    graph_26 : bool, optional
        The designation again, upside down in the upper corner. Default: on sheets of form 1.
    graphs_27_30 : bool
        Cells for the marks of a customer, beside graph 26 and above the title block.
    side_columns : bool
        Graphs 19 to 23 (and 24, 25 on the first sheet) in the binding margin.
    before : int
        Sheets of the set before the first of these.
    total : int, optional
        Sheets of the whole set. Default: those before plus these.
    lang : str
        Language of the captions.
    """

    form: str = "1"
    graph_26: bool | None = None
    graphs_27_30: bool = False
    side_columns: bool = False
    before: int = 0
    total: int | None = None
    lang: str = LANGUAGES[0]

    def __post_init__(self) -> None:
        """Refuse an unknown form."""
        if self.form not in FORMS:
            raise LayoutError(
                "Unknown form {!r} of the title block. Choose one of: {}.",
                self.form,
                ", ".join(FORMS),
            )

    @classmethod
    def of(cls, settings: SheetSettings, *, before: int = 0, total: int | None = None) -> Furniture:
        """Return the furniture that settings select, with defaults for the rest."""
        return cls(
            settings.form or "1",
            settings.graph_26,
            bool(settings.graphs_27_30),
            bool(settings.side_columns),
            before,
            total,
            settings.lang or LANGUAGES[0],
        )

    def is_first(self, sheet: int) -> bool:
        """Return whether one of these sheets, counted from 1, is the first of the set."""
        return self.before + sheet == 1

    def form_of(self, sheet: int) -> Form:
        """Return the form of one of these sheets, counted from 1."""
        first, later = FORMS[self.form]
        return first if self.is_first(sheet) else later

    def graphs(self, paper: Format, sheet: int = 1) -> Graphs:
        """Return the cells of graphs 26 to 30 that a sheet has."""
        form = self.form_of(sheet)
        shown = form is FORM_1 if self.graph_26 is None else self.graph_26
        found = {"26": upper_corner(paper, 0.0, 70.0)} if shown else {}
        if self.graphs_27_30:
            found |= _for_the_customer(paper, form, 70.0 if shown else 0.0)
        return MappingProxyType(found)

    def drawing_area(self, paper: Format, sheet: int = 1) -> DrawingArea:
        """Return the area that a sheet, counted from 1, has within its furniture."""
        form, inner = self.form_of(sheet), paper.inner
        above = _GRAPHS_HEIGHT.get(form.name, 0.0) if self.graphs_27_30 else 0.0
        stamp = (inner[2] - form.width, inner[1], inner[2], inner[1] + form.height + above)
        graphs = self.graphs(paper, sheet).values()
        return DrawingArea(inner, stamp, tuple(box for box in graphs if not _is_inside(box, stamp)))

    def numbers(self, sheet: int, sheets: int) -> dict[str, str]:
        """Return graphs 7 and 8 of one of ``sheets`` sheets.

        A single sheet has no number, and only the first one gives the total (GOST 2.104).
        """
        whole = self.total or self.before + sheets
        if whole == 1:
            return {}
        count = str(whole) if self.is_first(sheet) else ""
        return {"sheet": str(self.before + sheet), "sheets": count}


def upper_corner(
    paper: Format, start: float, end: float, low: float = 0.0, high: float = 14.0
) -> Bounds:
    """Return a cell of the row of graph 26: from ``start`` to ``end`` mm along it.

    The row goes from the upper left corner to the right; on a portrait sheet larger than A4, from
    the upper right corner down. ``low`` and ``high`` are across it, from the edge that is further
    from the frame.
    """
    left, _, right, top = paper.inner
    if paper.is_portrait and paper.size != "A4":
        return (right - 14.0 + low, top - end, right - 14.0 + high, top - start)
    return (left + start, top - 14.0 + low, left + end, top - 14.0 + high)


def _for_the_customer(paper: Format, form: Form, start: float) -> dict[str, Bounds]:
    """Return graphs 27 to 30; forms without a place for them have none."""
    if form.name not in _GRAPHS_HEIGHT:
        return {}
    right, top = paper.width - FRAME_OTHER, FRAME_OTHER + form.height
    whole = {"30": (right - 120.0, top, right, top + 8.0)}
    if form is FORM_2:
        y0, y1 = top + 8.0, top + 22.0
        return whole | {
            "27": (right - 120.0, y0, right - 106.0, y1),
            "28": (right - 106.0, y0, right - 53.0, y1),
            "29": (right - 53.0, y0, right, y1),
        }
    end = start + _GRAPHS_27_29_WIDTH
    return whole | {
        "27": upper_corner(paper, start, start + 14.0),
        "28": upper_corner(paper, start + 14.0, end, low=7.0),
        "29": upper_corner(paper, start + 14.0, end, high=7.0),
    }


def _is_inside(box: Bounds, outer: Bounds) -> bool:
    return outer[0] <= box[0] and outer[1] <= box[1] and box[2] <= outer[2] and box[3] <= outer[3]


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
        Texts by the keys of `planmethod.problem.records.TITLE_BLOCK`.
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
    edge = rectangle((0.0, 0.0, paper.width, paper.height), Pen.LETTER, "edge")
    items: list[Item] = [edge, rectangle(room.inner, Pen.FRAME, "frame")]
    corner = complex(room.stamp[0], room.stamp[1])
    items += shifted(title_block(fields, furniture.form_of(sheet), lang=furniture.lang), corner)
    turn = 90.0 if paper.is_portrait and paper.size != "A4" else 180.0
    for number, box in furniture.graphs(paper, sheet).items():
        items.append(rectangle(box, Pen.FRAME, STAMP))
        if number == "26" and fields.get("designation"):
            items += _fill_rotated(
                str(fields["designation"]), FormCell(box, 7.0), turn, f"{STAMP} designation"
            )
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


GRAPHS = ("sheet", "sheets")
"""Fields of graphs 7 and 8."""


def numbered(drawing: Drawing, furniture: Furniture, sheet: int) -> Drawing:
    """Return a sheet with its number, and on the first one the number of sheets.

    Parameters
    ----------
    furniture : Furniture
        It has the numbers of preceding and of all sheets; its form must be that of the drawn sheet.
    sheet : int
        Number of the sheet among these, counted from 1.
    """
    form = FORM_2A if drawing.is_continuation else furniture.form_of(sheet)
    by = complex(drawing.width - FRAME_OTHER - form.width, FRAME_OTHER)
    # A single sheet is counted, not numbered (GOST 2.104).
    texts = furniture.numbers(sheet, sheet) or {"sheets": "1"}
    items: list[Item] = []
    boxes = []
    with using(drawing.lettering):
        for key in GRAPHS:
            if key not in form.cells:
                continue
            cell = form.cells[key]
            x0, y0, x1, y1 = cell.box
            boxes.append((x0 + by.real, y0 + by.imag, x1 + by.real, y1 + by.imag))
            if key in texts:
                items += shifted(filled(texts[key], cell, f"{STAMP} {key}"), by)
    kept = [one for one in drawing.items if not _is_in_cell(one, boxes)]
    return replace(drawing, items=[*kept, *items])


def _is_in_cell(item: Item, boxes: list[tuple[float, float, float, float]]) -> bool:
    return isinstance(item, Text) and item.tag.startswith(STAMP) and item.box in boxes
