"""Pictures of the sheets as figures of a note, lettered so that they are legible (рисунки)."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any, TypeAlias

from msgspec import Struct

from planmethod.note.document import Figure
from planmethod.note.formula import Rich
from planmethod.note.wording import Language
from planmethod.render.backends.view import DrawingView
from planmethod.render.ink.drawing import Drawing
from planmethod.render.layout.block import Block, Column
from planmethod.render.sheets.blocks import BLOCKS
from planmethod.render.sheets.composer import Sizes, Viewed
from planmethod.render.sheets.model import Entry, Extras, Manner
from planmethod.solved.solution import Solution

Made: TypeAlias = Callable[[float], Block]
"""Makes a picture with letters of a height, mm."""

WIDTH, HEIGHT = 165.0, 200.0
"""Room of a figure in a note, mm."""

LETTER = 3.2
"""Height of the letters of a figure in a note, mm."""

_ON_SHEETS = 5.0  # letters of the first try, mm
_MARGIN = 2.0  # white around the ink, mm
_ROUNDS = 3


class ShrunkView(Struct, frozen=True):
    """A drawing that is shrunk to the width of a page (уменьшенный вид)."""

    view: DrawingView
    factor: float

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, mm."""
        width, height = self.view.size
        return width * self.factor, height * self.factor

    def svg(self) -> str:
        """Return an SVG element."""
        width, height = self.size
        head, end, rest = self.view.svg().partition(">")
        head = re.sub(r'\bwidth="[^"]*"', f'width="{width:.2f}mm"', head, count=1)
        head = re.sub(r'\bheight="[^"]*"', f'height="{height:.2f}mm"', head, count=1)
        return head + end + rest

    def draw(self, canvas: Any) -> None:
        """Draw on a canvas of reportlab whose unit is the millimetre, the lower left at zero."""
        canvas.scale(self.factor, self.factor)
        self.view.draw(canvas)

    def png(self, dpi: float) -> bytes:
        """Return a PNG file with so many dots to the inch."""
        return self.view.png(dpi * self.factor)


def figure(
    made: Made,
    caption: Rich,
    key: str,
    *,
    room: tuple[float, float] = (WIDTH, HEIGHT),
) -> Figure:
    """Return a picture of the sheets as a figure with a number.

    Parameters
    ----------
    made : callable
        Makes the picture with letters of a height, mm; they are the larger the more it is shrunk.
    caption : Rich
    key : str
        By which texts refer to it.
    room : tuple of float, mm
        Greatest width and height.
    """
    letter, factor, block = _ON_SHEETS, 1.0, made(_ON_SHEETS)
    for _ in range(_ROUNDS):
        wide, high = block.width + 2 * _MARGIN, block.height + 2 * _MARGIN
        factor = min(1.0, room[0] / wide, room[1] / high)
        wanted = round(max(3.5, LETTER / factor), 1)
        if abs(wanted - letter) < 0.3:
            break
        letter, block = wanted, made(wanted)
    wide, high = block.width + 2 * _MARGIN, block.height + 2 * _MARGIN
    factor = min(1.0, room[0] / wide, room[1] / high)
    drawing = Drawing(wide, high, caption)
    drawing.extend(block.place(complex(_MARGIN, high - _MARGIN)))
    return Figure(ShrunkView(DrawingView(drawing), factor), caption, numbered=True, key=key)


def bare(view: Block) -> Block:
    """Return a view of a sheet without its name and scale: in a note the caption has them."""
    column = view.block if isinstance(view, Viewed) else view
    return column.blocks[-1] if isinstance(column, Column) else column


def of_sheet(kind: str, solution: Solution, words: Language, *, column: float) -> Made:
    """Return what makes a block of the sheets by its kind, without its name, mm.

    ``column`` is the width of the texts of the sheet, which diagrams are measured by.
    """

    def made(letter: float) -> Block:
        entry, sizes = Entry(kind, letter=letter), Sizes(letter, letter, letter, column)
        indices = tuple(range(len(solution.positions)))
        return bare(
            BLOCKS[kind].make(solution, indices, Manner(entry, sizes, column, Extras(words)))
        )

    return made
