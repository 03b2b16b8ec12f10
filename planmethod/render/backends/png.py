"""PNG preview: the same strokes painted by matplotlib's Agg, without pyplot."""

from __future__ import annotations

from cmath import exp
from functools import cache
from io import BytesIO
from itertools import chain
from math import tau
from typing import Any, TypeAlias

import numpy as np
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.path import Path
from matplotlib.transforms import Affine2D
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from planmethod.errors import OutputError
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

Parts: TypeAlias = tuple[float, float, float]
"""Parts of red, green and blue, from 0 to 1."""

_LARGEST = 16_384  # pixels a side: an A0 sheet at 350 dots to the inch, about a gigabyte at work


class PngCanvas(Canvas):
    """Canvas that paints pixels."""

    def __init__(self, options: Options) -> None:
        self._dpi, self._packed = options.dpi, options.packed
        self._author = options.author
        self._title = ""
        self._agg: Any = None
        self._to_pixels: Any = None
        self._lettering: OutlineLettering
        self._pens: PenSet

    def open(self, drawing: Drawing) -> None:
        """Begin a sheet of white pixels."""
        width, height = drawing.width, drawing.height
        per_mm = self._dpi / 25.4
        columns, rows = round(width * per_mm), round(height * per_mm)
        if not (1 <= columns <= _LARGEST and 1 <= rows <= _LARGEST):
            raise OutputError(
                "A sheet of {:g} x {:g} mm at {:g} dpi makes {} x {} pixels; 1 to {} a side "
                "are possible. Choose another resolution.",
                width,
                height,
                self._dpi,
                columns,
                rows,
                _LARGEST,
            )
        self._title = drawing.title
        self._lettering = drawing.lettering
        renderer: Any = RendererAgg  # it has no types
        self._agg = renderer(columns, rows, self._dpi)
        # The nearest whole number of pixels covers the sheet exactly: no half-painted edge.
        self._to_pixels = Affine2D().scale(columns / width, rows / height)
        self._pens = drawing.pens
        self._paint(_polygon((0, width, width + height * 1j, height * 1j)), (255, 255, 255))

    def _paint(self, path: Path, colour: tuple[int, int, int]) -> None:
        self._agg.draw_path(self._gc(0.0), path, self._to_pixels, _parts(colour))

    def _ink_pen(self, pen: Pen, path: Path) -> None:
        gc = self._gc(self._pens.width(pen), PENS[pen].cap, _parts(self._pens.colour(pen)))
        gc.set_snap(None)  # upright lines snap to whole pixels
        self._agg.draw_path(gc, path, self._to_pixels)

    def _gc(self, width: float, cap: str = "round", colour: Parts = (0.0, 0.0, 0.0)) -> Any:
        """Return Agg's graphics context for lines; ``width`` is mm."""
        gc = self._agg.new_gc()
        gc.set_linewidth(width * 72.0 / 25.4)  # points
        gc.set_capstyle(cap)
        gc.set_joinstyle("round")
        gc.set_foreground(colour, isRGBA=False)
        gc.set_snap(False)  # snapped to pixels, thin strokes of letters would vanish
        return gc

    def stroke(self, item: Stroke) -> None:
        """Draw a polyline, or its dashes."""
        if closes(item):
            self._ink_pen(item.pen, _polygon(item.points))
            return
        for line in stroke_lines(item):
            self._ink_pen(item.pen, Path([(p.real, p.imag) for p in line]))

    def arc(self, item: Arc) -> None:
        """Draw an arc, or its dashes."""
        for start, turn in arc_spans(item):
            self._ink_pen(item.pen, _bent(item.centre, item.radius, start, turn))

    def fill(self, item: Fill | Disc) -> None:
        """Fill a polygon or a circle."""
        path = (
            _bent(item.centre, item.radius, 0.0, tau)
            if isinstance(item, Disc)
            else _polygon(item.points)
        )
        self._paint(path, area_colour(item, self._pens))

    def text(self, item: Text) -> None:
        """Draw the strokes of a run."""
        lettering = lettering_of(item.lettering, self._lettering)
        unit = 1.0 / lettering.cap_height
        for char, pen in lettering.places(item.text):
            path = _letter(lettering, char)
            if path is not None:
                place = Affine2D().translate(pen * unit, 0).scale(item.height)
                place.rotate_deg(item.angle).translate(item.at.real, item.at.imag)
                self._ink_letter(item, path, place)

    def _ink_letter(self, item: Text, path: Path, place: Affine2D) -> None:
        gc = self._gc(self._thickness(item))
        self._agg.draw_path(gc, path, place + self._to_pixels)

    def _thickness(self, item: Text) -> float:
        """Return the thickness of the lines of letters, mm."""
        return item.height * lettering_of(item.lettering, self._lettering).line

    def close(self) -> bytes:
        """Return the file."""
        properties = PngInfo()
        for key, text in (
            ("Title", self._title),
            ("Author", self._author),
            ("Software", "planmethod"),
        ):
            properties.add_text(key, text)
        pixels = np.asarray(self._agg.buffer_rgba())
        # Black on white: one channel of the four is enough.
        used = np.ascontiguousarray(pixels[..., :3] if self._pens.is_coloured else pixels[..., 0])
        file = BytesIO()
        dots = (self._dpi, self._dpi)
        Image.fromarray(used).save(file, "png", dpi=dots, pnginfo=properties, optimize=self._packed)
        return file.getvalue()


def _parts(colour: tuple[int, int, int]) -> Parts:
    red, green, blue = (part / 255 for part in colour)
    return red, green, blue


def _polygon(points: tuple[complex, ...]) -> Path:
    vertices = [(point.real, point.imag) for point in points]
    return Path([*vertices, vertices[0]], closed=True)


def _bent(centre: complex, radius: float, start: float, turn: float) -> Path:
    first = centre + radius * exp(1j * start)
    curves = arc_curves(centre, radius, start, turn)
    points = [first, *chain.from_iterable(curve[1:] for curve in curves)]
    codes: list[Any] = [Path.MOVETO] + [Path.CURVE4] * (len(points) - 1)
    if turn >= tau:
        points.append(first)
        codes.append(Path.CLOSEPOLY)
    return Path([(point.real, point.imag) for point in points], codes)


@cache
def _letter(lettering: OutlineLettering, char: str) -> Path | None:
    """Return the strokes of a letter, in parts of h, or None for a blank."""
    lines = [[(p.real, p.imag) for p in line] for line in lettering.strokes(char)]
    return Path.make_compound_path(*map(Path, lines)) if lines else None
