"""SVG: one millimetre is one user unit, letters are outlines, so no font is needed to view it.

What every viewer draws alike is used and nothing else: presentation attributes (no style sheet),
``xlink:href`` (some programs drop a plain ``href``), generated dashes.
"""

from __future__ import annotations

import re
import sys
from cmath import exp
from collections.abc import Callable, Iterable
from importlib import import_module
from math import pi, tau
from types import ModuleType
from typing import Any

from planmethod.render.backends.canvas import Canvas, Options, draw
from planmethod.render.ink.drawing import Arc, Disc, Fill, Ink, Item, Pen, Stroke, Text
from planmethod.render.ink.lettering import OutlineLettering
from planmethod.render.ink.style import PENS, arc_spans, closes, stroke_lines

_SPARED = {
    "urllib.request": ("urlopen",),
    "svgwrite.data.svgparser": (
        "is_valid_animation_timing", "is_valid_pathdata", "is_valid_transferlist",
    ),
}  # fmt: skip
"""What svgwrite imports to open addresses and to check values: half of its time."""


def _later(module: str, name: str) -> Callable[..., Any]:
    """Return a function that is imported when it is first called."""
    return lambda *args, **given: getattr(import_module(module), name)(*args, **given)


def _svgwrite() -> Any:
    """Import svgwrite, and what it spares here only when it is called."""
    absent = [module for module in _SPARED if module not in sys.modules]
    for module in absent:
        sys.modules[module] = ModuleType(module)
        vars(sys.modules[module]).update({n: _later(module, n) for n in _SPARED[module]})
    try:
        return import_module("svgwrite")
    finally:
        for module in absent:
            del sys.modules[module]


svgwrite = _svgwrite()

_INKS = {Ink.BLACK: "#000000", Ink.WHITE: "#ffffff"}
# XML 1.0 cannot hold these, not even as references.
_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def _clean(text: str) -> str:
    return _NOT_XML.sub("�", text)


def _number(value: float, places: int = 3) -> str:
    """Write a number plainly: no exponent, no trailing zeros, no minus zero."""
    text = f"{value:.{places}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


class SvgCanvas(Canvas):
    """Canvas that writes SVG 1.1."""

    def __init__(self, _options: Options) -> None:
        self._height = 0.0
        self._letters: set[str] = set()
        self._group: Any = None
        self._group_key = ""
        self._sheet: Any = None
        self._lettering: OutlineLettering

    def open(self, width: float, height: float, title: str, lettering: OutlineLettering) -> None:
        """Begin a sheet on white paper, so that dark viewers show it too."""
        w, h = _number(width), _number(height)
        self._height = height
        self._lettering = lettering
        self._sheet = svgwrite.Drawing(
            size=(f"{w}mm", f"{h}mm"), viewBox=f"0 0 {w} {h}", debug=False
        )
        self._sheet.set_desc(title=_clean(title))
        self._sheet.add(
            self._sheet.rect((0, 0), (w, h), class_="paper", fill=_INKS[Ink.WHITE], stroke="none")
        )

    def _xy(self, point: complex) -> str:
        return f"{_number(point.real)} {_number(self._height - point.imag)}"

    def _in_group(self, key: str, **attributes: str) -> Any:
        """Return the group of the items drawn now; items in a row of one kind share it."""
        if key != self._group_key:
            self._group = self._sheet.add(self._sheet.g(class_=key, **attributes))
            self._group_key = key
        return self._group

    def _pen_group(self, pen: Pen) -> Any:
        style = PENS[pen]
        level = f"{round(255 * style.grey):02x}"
        return self._in_group(
            f"pen-{pen.value}",
            fill="none",
            stroke=f"#{level * 3}",
            stroke_width=_number(style.width),
            stroke_linecap=style.cap,
            stroke_linejoin="round",
        )

    @staticmethod
    def _add(group: Any, element: Any, tag: str) -> None:
        if tag:
            element["data-tag"] = _clean(tag)
        group.add(element)

    def stroke(self, item: Stroke) -> None:
        """Draw a polyline, or its dashes, as one path."""
        data = "".join(
            "M" + "L".join(self._xy(point) for point in line) for line in stroke_lines(item)
        )
        if data:
            path = self._sheet.path(data + ("Z" if closes(item) else ""))
            self._add(self._pen_group(item.pen), path, item.tag)

    def arc(self, item: Arc) -> None:
        """Draw a circle, or an arc or its dashes as one path."""
        spans = arc_spans(item)
        if not spans:
            return
        if len(spans) == 1 and spans[0][1] >= tau:
            centre = (_number(item.centre.real), _number(self._height - item.centre.imag))
            element = self._sheet.circle(centre, _number(item.radius))
        else:
            element = self._sheet.path("".join(self._span(item, *span) for span in spans))
        self._add(self._pen_group(item.pen), element, item.tag)

    def _span(self, item: Arc, start: float, turn: float) -> str:
        # Flag 0: counter-clockwise on paper, since y of the file looks down.
        a = item.centre + item.radius * exp(1j * start)
        b = item.centre + item.radius * exp(1j * (start + turn))
        r = _number(item.radius)
        return f"M{self._xy(a)}A{r} {r} 0 {int(turn > pi)} 0 {self._xy(b)}"

    def fill(self, item: Fill | Disc) -> None:
        """Fill a polygon or a circle."""
        if isinstance(item, Disc):
            centre = (_number(item.centre.real), _number(self._height - item.centre.imag))
            element = self._sheet.circle(centre, _number(item.radius))
        else:
            data = "L".join(self._xy(point) for point in item.points)
            element = self._sheet.path(f"M{data}Z")
        group = self._in_group(f"ink-{item.ink.value}", fill=_INKS[item.ink], stroke="none")
        self._add(group, element, item.tag)

    def text(self, item: Text) -> None:
        """Place the outlines of a run; the run itself stays readable as its label."""
        unit = _number(item.height / self._lettering.cap_height, 9)
        turn = f" rotate({_number(-item.angle, 4)})" if item.angle else ""
        name = _clean(item.text)
        run = self._sheet.g(transform=f"translate({self._xy(item.at)}){turn} scale({unit} -{unit})")
        run["role"] = "img"
        run["aria-label"] = name
        for char, pen in self._lettering.places(item.text):
            if self._lettering.outline(char).outline:
                self._letters.add(char)
                run.add(self._sheet.use(f"#{self._glyph_id(char)}", x=str(pen)))
        self._add(self._in_group("text", fill=_INKS[Ink.BLACK], stroke="none"), run, item.tag)

    def close(self) -> bytes:
        """Return the file, with the outlines of the letters that occur."""
        outlines = {
            self._glyph_id(char): self._lettering.outline(char).outline for char in self._letters
        }
        for name in sorted(outlines):
            self._sheet.defs.add(self._sheet.path(outlines[name], id=name))
        text: str = self._sheet.tostring()
        return b'<?xml version="1.0" encoding="UTF-8"?>\n' + text.encode("utf-8") + b"\n"

    def parts(self, items: Iterable[Item]) -> str:
        """Return items as elements, for a picture that is put together elsewhere, y down.

        The sheet is open; the letters that they use are in its `letters`.
        """
        before, self._group_key = len(self._sheet.elements), ""
        draw(items, self)
        return "".join(str(one.tostring()) for one in self._sheet.elements[before:])

    def letters(self) -> str:
        """Return the outlines of the letters that occur, as elements."""
        return "".join(
            str(self._sheet.path(self._lettering.outline(char).outline, id=name).tostring())
            for name, char in sorted((self._glyph_id(char), char) for char in self._letters)
        )

    def _glyph_id(self, char: str) -> str:
        return "letter-none" if self._lettering.missing(char) else f"letter-{ord(char):x}"
