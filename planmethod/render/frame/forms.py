"""Forms of the title block as data (формы основной надписи: GOST 2.104).

Each form is tables of lines, captions and cells, mm from its own lower left corner. Form 1 is that
of drawings, form 2 that of the first sheet of a text document, form 2a that of the later sheets.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

from msgspec import Struct

from planmethod.paper import STAMP_HEIGHT, STAMP_WIDTH
from planmethod.render.ink.drawing import Bounds
from planmethod.render.layout.block import Align


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
