"""PDF: exact page, millimetres in the content stream, text that can be searched and copied."""

from __future__ import annotations

from cmath import exp
from functools import cache
from io import BytesIO
from math import radians, tau
from typing import Any

from reportlab import rl_config
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.ttfonts import TTFont
from reportlab.pdfgen.canvas import FILL_NON_ZERO, Canvas as Pages

from planmethod.render.backends.canvas import Canvas, Options, arc_curves
from planmethod.render.ink.drawing import (
    Arc,
    Disc,
    Drawing,
    Fill,
    Pen,
    Stroke,
    Text,
    arc_spans,
    area_colour,
    closes,
    stroke_lines,
)
from planmethod.render.ink.lettering import OutlineLettering, lettering_of
from planmethod.render.ink.pens import PENS, PenSet

rl_config.useA85 = 0  # bytes as they are: a fifth smaller than as text, and quicker

_MM = 72.0 / 25.4
_CAPS = {"butt": 0, "round": 1}
_BLACK = (0, 0, 0)


@cache
def registered(lettering: OutlineLettering) -> str:
    """Return the name of a lettering, registered on first use."""
    pdfmetrics.registerFont(TTFont(lettering.name, str(lettering.font_file)))
    return lettering.name


def _shade(colour: tuple[int, int, int]) -> tuple[float, tuple[float, float, float] | None]:
    """Return a colour as a grey, or with the parts of its red, green and blue where it is none."""
    red, green, blue = (part / 255 for part in colour)
    return red, None if red == green == blue else (red, green, blue)


class PdfCanvas(Canvas):
    """Canvas that writes PDF with the lettering embedded as a subset."""

    def __init__(self, options: Options) -> None:
        self._author = options.author
        self._file = BytesIO()
        self._pdf: Any = None
        self._font = ""
        self._lettering: OutlineLettering
        self._pen: Pen | None = None
        self._pens: PenSet
        self._ink: tuple[int, int, int] | None = None

    def open(self, drawing: Drawing) -> None:
        """Begin a page whose unit is the millimetre; the first one begins the file."""
        size = (drawing.width * _MM, drawing.height * _MM)
        if self._pdf is None:
            self._start_file(size, drawing.title, registered(drawing.lettering))
        else:
            self._pdf.showPage()
            self._pdf.setPageSize(size)
            self._pen = self._ink = None  # every page starts without state
        self._pdf.scale(_MM, _MM)
        self._set_manner(drawing)

    def _set_manner(self, drawing: Drawing) -> None:
        """Take lettering and pens."""
        self._font, self._lettering = registered(drawing.lettering), drawing.lettering
        self._pens = drawing.pens
        self._pdf.setLineJoin(1)

    def _start_file(self, size: tuple[float, float], title: str, font: str) -> None:
        """Begin the file with the size of its first page, points."""
        self._pdf = Pages(
            self._file,
            pagesize=size,
            pageCompression=1,
            # The same drawing gives the same bytes: no clock in the file.
            invariant=1,
            # Otherwise an unused Helvetica stays in the file, not embedded.
            initialFontName=font,
        )
        self._pdf.setTitle(title)
        self._pdf.setAuthor(self._author)
        self._pdf.setCreator("planmethod")
        self._pdf.setSubject("")

    def _set_pen(self, pen: Pen) -> None:
        if pen is self._pen:
            return
        self._pdf.setLineWidth(self._pens.width(pen))
        self._pdf.setLineCap(_CAPS[PENS[pen].cap])
        grey, rgb = _shade(self._pens.colour(pen))
        self._pdf.setStrokeGray(grey) if rgb is None else self._pdf.setStrokeColorRGB(*rgb)
        self._pen = pen

    def _set_ink(self, colour: tuple[int, int, int]) -> None:
        if colour == self._ink:
            return
        grey, rgb = _shade(colour)
        self._pdf.setFillGray(grey) if rgb is None else self._pdf.setFillColorRGB(*rgb)
        self._ink = colour

    def stroke(self, item: Stroke) -> None:
        """Draw a polyline, or its dashes, as one path."""
        lines = stroke_lines(item)
        if not lines:
            return
        self._set_pen(item.pen)
        path = self._pdf.beginPath()
        for line in lines:
            _trace(path, line)
        if closes(item):
            path.close()
        self._pdf.drawPath(path, stroke=1, fill=0)

    def arc(self, item: Arc) -> None:
        """Draw an arc, or its dashes, as one path."""
        spans = arc_spans(item)
        if not spans:
            return
        self._set_pen(item.pen)
        path = self._pdf.beginPath()
        for start, turn in spans:
            first = item.centre + item.radius * exp(1j * start)
            path.moveTo(first.real, first.imag)
            _bend(path, item.centre, item.radius, start, turn)
            if turn >= tau:
                path.close()
        self._pdf.drawPath(path, stroke=1, fill=0)

    def fill(self, item: Fill | Disc) -> None:
        """Fill a polygon or a circle."""
        self._set_ink(area_colour(item, self._pens))
        path = self._pdf.beginPath()
        if isinstance(item, Disc):
            path.moveTo(item.centre.real + item.radius, item.centre.imag)
            _bend(path, item.centre, item.radius, 0.0, tau)
        else:
            _trace(path, item.points)
        path.close()
        self._pdf.drawPath(path, stroke=0, fill=1, fillMode=FILL_NON_ZERO)

    def text(self, item: Text) -> None:
        """Draw a run of letters as text."""
        self._set_ink(_BLACK)
        run = self._pdf.beginText()
        lettering = lettering_of(item.lettering, self._lettering)
        font = registered(lettering) if item.lettering else self._font
        run.setFont(font, lettering.em(item.height))
        along = exp(1j * radians(item.angle))
        unit = item.height / lettering.cap_height
        for start, piece in lettering.pieces(item.text):
            at = item.at + along * start * unit
            run.setTextTransform(along.real, along.imag, -along.imag, along.real, at.real, at.imag)
            run.textOut(piece)
        self._pdf.drawText(run)

    def close(self) -> bytes:
        """End the last page and return the file."""
        self._pdf.showPage()
        self._pdf.save()
        return self._file.getvalue()


class PageCanvas(PdfCanvas):
    """Canvas that draws on an existing page of reportlab (на готовой странице)."""

    def __init__(self, page: Any) -> None:
        super().__init__(Options())
        self._pdf = page

    def open(self, drawing: Drawing) -> None:
        """Take lettering and pens."""
        self._set_manner(drawing)


def _trace(path: Any, points: tuple[complex, ...]) -> None:
    path.moveTo(points[0].real, points[0].imag)
    for point in points[1:]:
        path.lineTo(point.real, point.imag)


def _bend(path: Any, centre: complex, radius: float, start: float, turn: float) -> None:
    for _, c1, c2, end in arc_curves(centre, radius, start, turn):
        path.curveTo(c1.real, c1.imag, c2.real, c2.imag, end.real, end.imag)
