"""Cells of a specimen sheet (клетки листа образцов): a picture, its name, its source."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from msgspec import Struct

from planmethod.note.wording import MessageTable
from planmethod.render.ink.drawing import Bounds, Item, Pen, Stroke
from planmethod.render.ink.typeset import line_step, typeset
from planmethod.render.labels import Label
from planmethod.render.layout.block import paragraph
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import before_links

NUMBER, NAME, CLAUSE = 2.5, 3.5, 2.5
"""Heights of the letters of a cell, mm."""

EDGE = 3.0
"""White between the lines of a cell and its contents, mm."""


class Clause(NamedTuple):
    """Clause of a GOST; only numbers that were seen in it are given (пункт стандарта).

    ``paragraph`` is a, b, c for the first ones.
    """

    number: str
    item: str = ""
    paragraph: str = ""

    def describe(self, texts: MessageTable) -> str:
        """Return the standard and its clause in a language."""
        if not self.item:
            return texts.standard.format(number=self.number)
        item = self.item
        if self.paragraph:
            item += f", {texts.clause_letters['abc'.index(self.paragraph)]}"
        return texts.clause.format(number=self.number, item=item)


class SymbolCell(Struct, frozen=True):
    """One symbol with its letters (клетка).

    Attributes
    ----------
    name : str
        Key of its name in ``cells`` of a language's ``specimens``.
    clause : Clause or None
        The clause of the standard that it illustrates; None for practice of the course.
    items : tuple of Item
        The symbol in its own coordinates, mm, as drawn on a scheme.
    labels : tuple of Label
        Its letters, placed around it.
    size : str
        Size in its name, mm.
    """

    name: str
    clause: Clause | None
    items: tuple[Item, ...]
    labels: tuple[Label, ...] = ()
    size: str = ""


def letter(text: str, at: complex, prefer: complex = 1 + 1j, *, gap: float = 3.0) -> Label:
    """Return the letter of a point or the number of a link, 3.5 mm."""
    return Label(typeset(text, NAME), at, prefer=prefer, gap=gap)


def scheme(*parts: list[Item]) -> tuple[Item, ...]:
    """Return parts in order; hatching gives way to links."""
    return tuple(before_links([item for part in parts for item in part]))


def drawn_cell(cell: SymbolCell, number: int, box: Bounds, texts: MessageTable) -> list[Item]:
    """Return a cell in its box: number, picture in the middle, name and clause below it."""
    left, low, right, high = box
    middle, inner = (left + right) / 2, right - left - 2 * EDGE
    # Base lines are those of the grid, regardless of descenders.
    base = low + EDGE + 0.3 * CLAUSE
    name = texts["cells"][cell.name].format(size=cell.size)
    clause = texts.course if cell.clause is None else cell.clause.describe(texts)
    items = list(typeset(clause, CLAUSE).at(complex(middle, base), anchor="centre"))
    base += CLAUSE + 2.5
    for line in reversed(paragraph(name, NAME, inner).inscriptions):
        items += line.at(complex(middle, base), anchor="centre")
        base += line_step(NAME)
    picture = lettered(cell.items, cell.labels)
    room = (base - line_step(NAME) + NAME + EDGE, high - EDGE)
    corner = complex(middle - picture.width / 2, (sum(room) + picture.height) / 2)
    items += picture.place(corner)
    mark = typeset(str(number), NUMBER)
    return items + mark.at(complex(left + 1.5, high - 1.5 - NUMBER))


def drawn_grid(
    cells: Sequence[SymbolCell],
    corner: complex,
    texts: MessageTable,
    *,
    columns: int,
    width: float,
    height: float,
) -> list[Item]:
    """Return cells in rows from an upper left corner, with the lines between them, mm."""
    items: list[Item] = []
    sides: dict[tuple[complex, complex], None] = {}
    for k, cell in enumerate(cells):
        row, column = divmod(k, columns)
        left, high = corner.real + column * width, corner.imag - row * height
        box = (left, high - height, left + width, high)
        items += drawn_cell(cell, k + 1, box, texts)
        sides |= dict.fromkeys(_sides(box))
    return [*(Stroke(side, Pen.THIN, tag="grid") for side in sides), *items]


def _sides(box: Bounds) -> Iterable[tuple[complex, complex]]:
    x0, y0, x1, y1 = (round(value, 6) for value in box)
    yield complex(x0, y0), complex(x1, y0)
    yield complex(x0, y1), complex(x1, y1)
    yield complex(x0, y0), complex(x0, y1)
    yield complex(x1, y0), complex(x1, y1)
