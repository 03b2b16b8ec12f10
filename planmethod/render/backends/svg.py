"""SVG: one millimetre is one user unit, letters are strokes, so no font is needed to view it.

Only features that every viewer draws alike are used: presentation attributes (no style sheet),
``xlink:href`` (some programs drop a plain ``href``), generated dashes. Each inscription is repeated
as text under everything, white on the white paper: it can be found, marked, copied, printed and
read aloud where the letters are; its font is invisible.
"""

from __future__ import annotations

import re
from cmath import exp
from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import pi, radians, tau
from types import SimpleNamespace
from typing import Any
from xml.etree.ElementTree import Element
from zlib import crc32

from svgwrite import Drawing as SvgDocument
from svgwrite.params import Parameter

from planmethod.render.backends.canvas import Canvas, Options, draw
from planmethod.render.ink.drawing import (
    Arc,
    Disc,
    Drawing,
    Fill,
    Ink,
    Item,
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
from planmethod.render.ink.typeset import PART_OF

_INKS = {Ink.BLACK: "#000000", Ink.WHITE: "#ffffff"}
_LINES = {
    "fill": "none",
    "stroke": _INKS[Ink.BLACK],
    "stroke-linecap": "round",
    "stroke-linejoin": "round",
}
"""Default attributes of the groups of pens."""
_HEADING, _LETTERS = 5.0, 8  # mm, and letters: an inscription larger and longer is a heading
# XML 1.0 cannot hold these, not even as references. All others, negated, take ten times as long
# to compile.
_NOT_XML = r"[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]"


class _Letters:
    """Placeholder in a group for letters, which are most elements of a sheet and written as text.

    As elements they take four times as long as the lines of a sheet (ADR 0054).
    """

    TEXT = "<letters/>"

    def get_xml(self) -> Element:
        """Return the element that is replaced."""
        return Element("letters")


def _clean(text: str) -> str:
    return re.sub(_NOT_XML, "�", text)


def _escaped(text: str) -> str:
    text = _clean(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return text.replace('"', "&quot;")


def _number(value: float, places: int = 3) -> str:
    """Write a number plainly: no exponent, no zeros at its ends, no minus zero."""
    text = f"{value:.{places}f}".rstrip("0").rstrip(".")
    sign, digits = ("-", text[1:]) if text[0] == "-" else ("", text)
    return "0" if digits == "0" else sign + digits.removeprefix("0")


def _hex(colour: tuple[int, int, int]) -> str:
    return "#" + bytes(colour).hex()


class SvgCanvas(Canvas):
    """Canvas that writes SVG 1.1."""

    def __init__(self, _options: Options) -> None:
        self._height = 0.0
        self._letters: set[tuple[str, str]] = set()  # names of letterings, and letters
        self._runs: dict[str, tuple[str, str]] = {}
        self._times: dict[str, int] = {}
        self._placed: list[list[tuple[str, str, str, str]]] = []
        self._texts: list[str] = []
        self._keys: dict[str, str] = {}
        self._sheet: Any = None
        self._drawn: Any = None
        self._group: Any = None
        self._group_key = ""
        self._words: Any = None
        self._written: list[Text] = []
        self._headings: list[str] = []
        self._lettering: OutlineLettering
        self._pens: PenSet

    def open(self, drawing: Drawing) -> None:
        """Begin a sheet on white paper, so that dark viewers show it too."""
        w, h = _number(drawing.width), _number(drawing.height)
        self._height = drawing.height
        self._lettering = drawing.lettering
        self._pens = drawing.pens
        white = _INKS[Ink.WHITE]
        unchecked = SimpleNamespace(_parameter=Parameter(False))
        self._sheet = SvgDocument(
            size=(f"{w}mm", f"{h}mm"), viewBox=f"0 0 {w} {h}", factory=unchecked
        )
        # The mouse marks the text, not the letters over it.
        self._sheet["pointer-events"] = "none"
        self._title = _clean(drawing.title)
        self._sheet.add(self._sheet.rect((0, 0), (w, h), class_="paper", fill=white, stroke="none"))
        self._words = self._sheet.add(
            self._sheet.g(class_="words", fill=white, pointer_events="all", font_size="5")
        )
        self._words.add(_Letters())
        self._drawn = self._sheet.add(self._sheet.g(**_LINES))

    def _xy(self, point: complex) -> str:
        return f"{_number(point.real)} {_number(self._height - point.imag)}"

    def _path_data(self, points: Sequence[complex]) -> str:
        """Return the path data of a polyline: its start, and its steps in thousandths of mm."""
        places = [(round(p.real, 3), round(self._height - p.imag, 3)) for p in points]
        steps = (f"{_number(c - a)} {_number(d - b)}" for (a, b), (c, d) in pairwise(places))
        return f"M{self._xy(points[0])}l{' '.join(steps)}".replace(" -", "-")

    def _in_group(self, key: str, **attributes: str) -> Any:
        """Return the group of the items drawn now; items in a row of one kind share it."""
        if key != self._group_key:
            self._group = self._drawn.add(self._sheet.g(class_=key, **attributes))
            self._group_key = key
        return self._group

    def _pen_group(self, pen: Pen) -> Any:
        if pen is Pen.LETTER and not self._pens.is_coloured:
            pen = Pen.THIN  # they look alike, and one group is shorter
        style = PENS[pen]
        own = {"stroke_width": _number(self._pens.width(pen))}
        if (colour := _hex(self._pens.colour(pen))) != _INKS[Ink.BLACK]:
            own["stroke"] = colour
        if style.cap != _LINES["stroke-linecap"]:
            own["stroke_linecap"] = style.cap
        return self._in_group(f"pen-{pen.value}", **own)

    @staticmethod
    def _add(group: Any, element: Any, tag: str) -> None:
        if tag and not tag.startswith(PART_OF):
            element["data-tag"] = _clean(tag)
        group.add(element)

    def stroke(self, item: Stroke) -> None:
        """Draw a polyline, or its dashes, as one path."""
        data = "".join(map(self._path_data, stroke_lines(item)))
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
            element = self._sheet.path(f"{self._path_data(item.points)}Z")
        colour = _hex(area_colour(item, self._pens))
        key = f"ink-{item.ink.value}"
        if colour not in _INKS.values():
            assert isinstance(item, Fill)
            key += f" of-{item.pen.value}"
        group = self._in_group(key, fill=colour, stroke="none")
        self._add(group, element, item.tag)

    def text(self, item: Text) -> None:
        """Place the strokes of a run, and under everything its text."""
        lettering = lettering_of(item.lettering, self._lettering)
        line = _number(lettering.line * lettering.cap_height)
        group = self._in_group(f"text {item.lettering}".rstrip(), stroke_width=line)
        if not group.elements:
            group.add(_Letters())
            self._placed.append([])
        x, y = _number(item.at.real, 2), _number(self._height - item.at.imag, 2)
        tag = "" if item.tag.startswith(PART_OF) else item.tag
        self._placed[-1].append(
            (self._run(item), x, y, f' data-tag="{_escaped(tag)}"' if tag else "")
        )
        if not item.label or (self._written and item.label != self._written[-1].label):
            self._write()
        self._written.append(item)

    def _run(self, item: Text) -> str:
        """Return the name of a run of letters, which is composed once for all its places."""
        # Rounded to visible digits: 5 mm and 5.0, 0° and -0.0 are the same, however they were
        # computed.
        height, angle = round(item.height, 6) + 0.0, round(item.angle, 6) + 0.0
        key = f"{item.text} {height} {angle} {item.lettering}".rstrip()
        name = f"t{crc32(key.encode(errors='replace')):x}"
        while self._keys.setdefault(name, key) != key:
            name += "x"
        if name not in self._runs:
            lettering = lettering_of(item.lettering, self._lettering)
            unit = _number(height / lettering.cap_height, 8)
            turn = f"rotate({_number(-angle, 4)})" if angle else ""
            placed = [(char, pen) for char, pen in lettering.places(item.text)
                      if lettering.glyph(char).strokes]  # fmt: skip
            self._letters.update((item.lettering, char) for char, _ in placed)
            uses = [
                "<use"
                + (f' x="{pen}"' if pen else "")
                + f' xlink:href="#{self._glyph_id(item.lettering, char)}"/>'
                for char, pen in placed
            ]
            self._runs[name] = f"{turn}scale({unit}-{unit})", "".join(uses)
        self._times[name] = self._times.get(name, 0) + 1
        return name

    def _run_element(self, placed: tuple[str, str, str, str], *, is_defined: bool) -> str:
        """Return the element of a placed run; if ``is_defined``, it refers to the definitions."""
        name, x, y, tag = placed
        if is_defined:
            return f'<use{tag} x="{x}" xlink:href="#{name}" y="{y}"/>'
        turn, uses = self._runs[name]
        return f'<g{tag} transform="translate({x} {y}){turn}">{uses}</g>' if uses else ""

    def _with_letters(self, text: str, letters: Iterable[str]) -> str:
        """Return svgwrite's text with the placeholders replaced by letters."""
        first, *rest = text.replace(" />", "/>").split(_Letters.TEXT)
        return first + "".join(map(str.__add__, letters, rest))

    def _define_runs(self, names: Iterable[str]) -> str:
        run = '<g id="{}" transform="{}">{}</g>'
        return "".join(run.format(name, *self._runs[name]) for name in names)

    def _write(self) -> None:
        """Write the runs of an inscription as one text, as long as they are."""
        if not self._written:
            return
        first, letters = self._written[0], _clean("".join(run.text for run in self._written))
        along = exp(-1j * radians(first.angle))
        length = max(
            ((run.at - first.at) * along).real
            + lettering_of(run.lettering, self._lettering).width(run.text, run.height)
            for run in self._written
        )
        x, y = _number(first.at.real, 1), _number(self._height - first.at.imag, 1)
        size, phrase = _number(self._lettering.em(first.height), 1), "<text"
        if size != self._words["font-size"]:
            phrase += f' font-size="{size}"'
        if len(letters) > 1:
            phrase += f' textLength="{_number(length, 1)}"'
        if first.angle:
            phrase += f' transform="rotate({_number(-first.angle, 4)} {x} {y})"'
        elif first.height >= _HEADING and len(letters) > _LETTERS and not first.tag:
            self._headings.append(letters)
        self._texts.append(f'{phrase} x="{x}" y="{y}">{_escaped(letters)}</text>')
        self._written.clear()

    def close(self) -> bytes:
        """Return the file, with the letters and runs that occur."""
        self._write()
        for part in self._glyphs():
            self._sheet.defs.add(part)
        self._sheet.set_desc(title=self._title, desc="; ".join(self._headings) or None)
        kept = {name for name, times in self._times.items() if times > 1}
        runs = (
            "".join(self._run_element(run, is_defined=run[0] in kept) for run in group)
            for group in self._placed
        )
        text = self._with_letters(str(self._sheet.tostring()), ("".join(self._texts), *runs))
        defined = self._define_runs(name for name in self._runs if name in kept)
        text = text.replace("</defs>", f"{defined}</defs>", 1)
        return b'<?xml version="1.0" encoding="UTF-8"?>\n' + text.encode("utf-8") + b"\n"

    def parts(self, items: Iterable[Item]) -> str:
        """Return items as elements, for a picture that is put together elsewhere, y down.

        The sheet is open; the letters that they use are in its `letters`.
        """
        self._drawn, self._group_key, self._placed = self._sheet.g(**_LINES), "", []
        draw(items, self)
        runs = (
            "".join(self._run_element(run, is_defined=True) for run in group)
            for group in self._placed
        )
        return self._with_letters(str(self._drawn.tostring()), runs)

    def letters(self) -> str:
        """Return the letters and runs that occur, as elements."""
        glyphs = "".join(str(part.tostring()) for part in self._glyphs())
        return glyphs + self._define_runs(self._runs)

    def _glyphs(self) -> list[Any]:
        shapes = {
            self._glyph_id(name, char): lettering_of(name, self._lettering).glyph(char).strokes
            for name, char in self._letters
        }
        return [self._sheet.path(shapes[name], id=name) for name in sorted(shapes)]

    def _glyph_id(self, name: str, char: str) -> str:
        missing = lettering_of(name, self._lettering).missing(char)
        own = f"-{name}" if name else ""
        return f"none{own}" if missing else f"u{ord(char):x}{own}"
