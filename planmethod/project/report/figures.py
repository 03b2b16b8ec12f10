"""Pictures of the sheets as figures of a note, lettered so that they are legible (рисунки)."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cached_property
from typing import Any, TypeAlias

from msgspec import Struct

from planmethod.note.document import Figure
from planmethod.note.formula import Rich
from planmethod.note.plaintext import plain_text
from planmethod.note.wording import Language
from planmethod.render.backends.view import DrawingView
from planmethod.render.ink.drawing import Drawing
from planmethod.render.layout.block import Block, Column, Row
from planmethod.render.sheets.blocks import maker_of
from planmethod.render.sheets.composer import Sizes, ViewBlock
from planmethod.render.sheets.model import BlockOptions, BlockSpec, BlockStyle
from planmethod.solved.solution import Solution

PictureDrawer: TypeAlias = Callable[[float], Block]
"""Makes a picture with letters of a height, mm."""

WIDTH = 165.0
"""Greatest width of a figure in a note, mm."""

LETTER, ON_SHEETS = 3.2, 3.5
"""Heights of the letters of a figure as it is shown, and as it is drawn at first, mm."""

WISHED, MOST = 120.0, 1.35
"""Target size of a small picture, mm, and its maximum enlargement factor."""

MARGIN = 2.0
"""White around the ink, mm."""

SHRINK_TOLERANCE = 0.05
"""Relative reduction of a picture above which its letters are drawn larger."""


class FittedView(Struct, frozen=True, dict=True):
    """A picture of the sheets fitted to an area, made when a writer needs it (вид по ширине).

    Attributes
    ----------
    drawer : callable
        Makes the picture with letters of a height, mm.
    name : Rich
    area : tuple of float, mm
        Greatest width and height.
    grows : bool
        A small picture is enlarged.
    """

    drawer: PictureDrawer
    name: Rich
    area: tuple[float, float]
    grows: bool = True

    @cached_property
    def scaled_view(self) -> tuple[DrawingView, float]:
        """The picture, and the ratio of its displayed to its drawn size."""
        block = self.drawer(ON_SHEETS)
        factor = self._factor(block)
        if abs(factor - 1.0) > SHRINK_TOLERANCE:
            block = self.drawer(round(LETTER / factor, 1))
            factor = self._factor(block)
        drawing = Drawing(*_padded_size(block), plain_text(self.name))
        drawing.extend(block.place(complex(MARGIN, drawing.height - MARGIN)))
        return DrawingView(drawing), factor

    def _factor(self, block: Block) -> float:
        wide, high = _padded_size(block)
        most = min(self.area[0] / wide, self.area[1] / high)
        return min(most, max(1.0, min(WISHED / max(wide, high), MOST)) if self.grows else 1.0)

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, mm."""
        view, factor = self.scaled_view
        width, height = view.size
        return width * factor, height * factor

    def svg(self) -> str:
        """Return an SVG element."""
        width, height = self.size
        head, end, rest = self.scaled_view[0].svg().partition(">")
        head = re.sub(r'\bwidth="[^"]*"', f'width="{width:.2f}mm"', head, count=1)
        head = re.sub(r'\bheight="[^"]*"', f'height="{height:.2f}mm"', head, count=1)
        return head + end + rest

    def draw(self, canvas: Any) -> None:
        """Draw on a canvas of reportlab whose unit is the millimetre, the lower left at zero."""
        view, factor = self.scaled_view
        canvas.scale(factor, factor)
        view.draw(canvas)

    def png(self, dpi: float) -> bytes:
        """Return a PNG file with a resolution in dots per inch."""
        view, factor = self.scaled_view
        return view.png(dpi * factor)


def _padded_size(block: Block) -> tuple[float, float]:
    """Return width and height of a picture with its margin, mm."""
    return block.width + 2 * MARGIN, block.height + 2 * MARGIN


def figure(
    drawer: PictureDrawer, caption: Rich, key: str, *, height: float = 120.0, grows: bool = True
) -> Figure:
    """Return a picture of the sheets as a figure with a number.

    Parameters
    ----------
    drawer : callable
        Makes the picture with letters of a height, mm; they are the larger the more it is shrunk.
    caption : Rich
    key : str
        By which texts refer to it.
    height : float, mm
        Greatest height.
    grows : bool
        A small picture is enlarged.
    """
    view = FittedView(drawer, caption, (WIDTH, height), grows)
    return Figure(view, caption, numbered=True, key=key)


def without_heading(view: Block) -> Block:
    """Return a view of a sheet without its name and scale: in a note the caption has them."""
    column = view.block if isinstance(view, ViewBlock) else view
    if isinstance(column, Row) and len(column.blocks) == 1:
        return without_heading(column.blocks[0])
    return column.blocks[-1] if isinstance(column, Column) else column


def of_sheet(kind: str, solution: Solution, language: Language, *, column: float) -> PictureDrawer:
    """Return the function that makes a block of the sheets by its kind, without its name, mm.

    ``column`` is the width of the texts of the sheet, which diagrams are measured by.
    """

    def draw(letter: float) -> Block:
        entry, sizes = BlockSpec(kind, letter=letter), Sizes(letter, letter, letter, column)
        indices = tuple(range(len(solution.positions)))
        return without_heading(
            maker_of(kind)(
                solution, indices, BlockStyle(entry, sizes, column, BlockOptions(language))
            )
        )

    return draw
