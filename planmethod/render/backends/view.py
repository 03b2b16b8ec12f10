"""A drawing, or a part of it, as a figure of a document (вид чертежа)."""

from __future__ import annotations

from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from planmethod.render.backends import render
from planmethod.render.backends.canvas import Options, draw_sheet
from planmethod.render.ink.drawing import Bounds, Drawing, shifted
from planmethod.render.ink.typeset import ink_bounds, overlap


class DrawingView(Struct, frozen=True):
    """A drawing of a sheet, whole or the part in a box (вид чертежа).

    Attributes
    ----------
    drawing : Drawing
    box : Bounds, mm, optional
        The shown part of the sheet. Items that are partly outside are cut there.
    """

    drawing: Drawing
    box: Bounds | None = None

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, mm."""
        if self.box is None:
            return self.drawing.width, self.drawing.height
        left, low, right, high = self.box
        return right - left, high - low

    def crop(self) -> Drawing:
        """Return the shown part as a drawing of its own."""
        if self.box is None:
            return self.drawing
        width, height = self.size
        within = [item for item in self.drawing.items if overlap(ink_bounds([item]), self.box)]
        moved = shifted(within, -complex(*self.box[:2]))
        return replace(self.drawing, width=width, height=height, items=list(moved), views=[])

    def svg(self) -> str:
        """Return an SVG element."""
        text = render(self.crop(), "svg").decode("utf-8")
        return text[text.index("<svg") :].rstrip()

    def draw(self, canvas: Any) -> None:
        """Draw on a canvas of reportlab whose unit is the millimetre, the lower left at zero."""
        # The library of PDF is imported where a PDF is written.
        from planmethod.render.backends.pdf import PageCanvas

        path = canvas.beginPath()
        path.rect(0.0, 0.0, *self.size)
        canvas.clipPath(path, stroke=0, fill=0)
        draw_sheet(self.crop(), PageCanvas(canvas))

    def png(self, dpi: float) -> bytes:
        """Return a PNG file with ``dpi`` dots to the inch."""
        return render(self.crop(), "png", options=Options(dpi=dpi, packed=False))
