"""Lettering (шрифт): widths, strokes and proportions of the letters (GOST 2.304).

It is not passed from function to function: a context has a lettering (`in_use`, `using`), as it has
the context of decimal numbers, and a drawing records the one that it was set in.
"""

# Cyrillic letters: letters that the lettering is measured by

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache, cached_property, lru_cache
from itertools import accumulate
from math import radians, tan
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

from msgspec import Struct

from planmethod.errors import LayoutError


class Proportions(Struct, frozen=True):
    """Measures of a type of lettering, in line thicknesses d.

    Attributes
    ----------
    cap : int
        Height h of capitals; d is h/cap.
    small : int
        Height c of small letters.
    tail : int
        Depth of the tails of small letters below the base line.
    gap : int
        Gap a between letters.
    line_step : int
        Least step b of base lines.
    word_gap : int
        Least gap e between words.
    """

    cap: int
    small: int
    tail: int
    gap: int = 2
    line_step: int = 17
    word_gap: int = 6


TYPES: Mapping[str, Proportions] = MappingProxyType(
    {
        "A": Proportions(cap=14, small=10, tail=4, line_step=22),
        "B": Proportions(cap=10, small=7, tail=3),
    }
)
"""Types of lettering by the Latin letter of their name (типы А и Б)."""

SLANT = tan(radians(15.0))
"""Lean of slanted letters to the right per unit of height: about 75° to the base line."""


FONTS = Path(__file__).parent / "fonts"

_NUMBER = r"-?\d+"


class Style(Struct, frozen=True):
    """One of the four letterings of GOST 2.304: type A or B, upright or slanted by about 75°."""

    kind: str
    slanted: bool

    @property
    def proportions(self) -> Proportions:
        """Measures of its letters."""
        return TYPES[self.kind]

    @property
    def lean(self) -> float:
        """Lean of its letters to the right per unit of height."""
        return SLANT if self.slanted else 0.0

    @property
    def narrow(self) -> str:
        """Narrower lettering of the same slope (узкий шрифт), a key of `STYLES`; empty if none."""
        return "" if self.kind == "A" else "A" if self.slanted else "A-upright"

    @property
    def name(self) -> str:
        """Name of the font's files."""
        return f"PlanmethodGOST-{self.kind}{'-Slanted' if self.slanted else ''}"


STYLES: Mapping[str, Style] = MappingProxyType(
    {
        "B": Style("B", slanted=True),
        "B-upright": Style("B", slanted=False),
        "A": Style("A", slanted=True),
        "A-upright": Style("A", slanted=False),
    }
)
"""Letterings by the name that a user gives: slanted by default."""


class Glyph(NamedTuple):
    """One letter in font units, y up, origin on the base line.

    ``strokes`` is the path of the pen's middle, an SVG path of M and l; it is empty for a blank,
    and the bounds, those of the ink, are then all zero.
    """

    advance: int
    xmin: int
    ymin: int
    xmax: int
    ymax: int
    strokes: str


class OutlineLettering(Struct, eq=False, dict=True):
    """Lettering read from the data files that ``scripts/make_font.py`` makes.

    Letters follow each other by their advances, some pairs closer: `places` returns their places,
    so that every output format places them alike. The data are read with the first letter.
    """

    style: Style = STYLES["B"]

    @property
    def name(self) -> str:
        """Name of the font."""
        return self.style.name

    @property
    def font_file(self) -> Path:
        """The font (TrueType) with the same letters, for formats that embed one."""
        return FONTS / f"{self.name}.ttf"

    @cached_property
    def _data(self) -> dict[str, Any]:
        path = FONTS / f"{self.name}.json"
        data: dict[str, Any] = json.loads(path.read_text(encoding="ascii"))
        return data

    @cached_property
    def cap_height(self) -> int:
        """Height of a capital letter in font units: what the height h of GOST 2.304 measures."""
        return int(self._data["cap_height"])

    @cached_property
    def units_per_em(self) -> int:
        """Font units in the size by which other programs call a font."""
        return int(self._data["units_per_em"])

    @cached_property
    def _glyphs(self) -> dict[str, Glyph]:
        return {}

    @property
    def line(self) -> float:
        """Thickness d of a letter's lines, in parts of h."""
        return 1.0 / self.style.proportions.cap

    @property
    def line_step(self) -> float:
        """Step of base lines of consecutive lines, in parts of h."""
        return self.style.proportions.line_step / self.style.proportions.cap

    def em(self, height: float) -> float:
        """Return the font size whose capitals are ``height`` high, in the unit of ``height``."""
        return height * self.units_per_em / self.cap_height

    def glyph(self, char: str) -> Glyph:
        """Return the letter ``char``, or a box when the lettering has no such letter."""
        glyph = self._glyphs.get(char)
        if glyph is None:
            table = self._data["glyphs"]
            glyph = Glyph(*table.get(f"{ord(char):x}", table[""]))
            self._glyphs[char] = glyph
        return glyph

    def missing(self, text: str) -> set[str]:
        """Return the letters of ``text`` that would come out as a box."""
        table = self._data["glyphs"]
        return {char for char in text if f"{ord(char):x}" not in table}

    def places(self, text: str) -> list[tuple[str, int]]:
        """Return each letter of a run and the place of its origin, font units."""
        placed: list[tuple[str, int]] = []
        pen, before, closer, kern = 0, "", self._data["closer"], self._data["kern"]
        for char in text:
            if char in closer.get(before, ""):
                pen += kern
            placed.append((char, pen))
            pen += self.glyph(char).advance
            before = char
        return placed

    def pieces(self, text: str) -> tuple[tuple[int, str], ...]:
        """Return the parts of a run inside which letters follow one another by their advances.

        Returns
        -------
        tuple of (int, str)
            Start of a part, font units, and its letters.
        """
        return _pieces(self, text)

    def width(self, text: str, height: float) -> float:
        """Return the advance of a run of letters, mm."""
        return _measured(self, text)[0] * height / self.cap_height

    def ink(self, text: str, height: float) -> tuple[float, float, float, float]:
        """Return the bounds of the ink of a run that starts at the origin.

        Returns
        -------
        tuple of float
            xmin, ymin, xmax, ymax, mm; all zero when the run has no ink.
        """
        unit = height / self.cap_height
        _, left, low, right, high = _measured(self, text)
        return (left * unit, low * unit, right * unit, high * unit)

    def strokes(self, char: str) -> tuple[tuple[complex, ...], ...]:
        """Return the path of the pen's middle for a letter, in parts of h."""
        lines = []
        for line in self.glyph(char).strokes.split("M")[1:]:
            numbers = [int(number) / self.cap_height for number in re.findall(_NUMBER, line)]
            lines.append(tuple(accumulate(map(complex, numbers[::2], numbers[1::2]))))
        return tuple(lines)

    @property
    def side(self) -> float:
        """White that a letter has at each side, in parts of h: half the gap between letters."""
        return self.style.proportions.gap / 2 * self.line

    def leaning(self, y: float, height: float) -> float:
        """Return how far to the right slanted letters lean at a height above the base line, mm."""
        return self.style.lean * (y - height * self.style.proportions.small / 2 * self.line)

    def ascent(self, text: str, height: float) -> float:
        """Return how far the ink of this run rises above the base line, mm."""
        return max(0.0, self.ink(text, height)[3])

    def descent(self, text: str, height: float) -> float:
        """Return how far the ink of this run goes below the base line, mm (positive)."""
        return max(0.0, -self.ink(text, height)[1])


# Runs recur, on one sheet and on those of many variants: the latest are cached.


@lru_cache(maxsize=8192)
def _pieces(lettering: OutlineLettering, text: str) -> tuple[tuple[int, str], ...]:
    parts: list[tuple[int, str]] = []
    end = None
    for char, pen in lettering.places(text):
        if pen == end:
            start, letters = parts.pop()
            parts.append((start, letters + char))
        else:
            parts.append((pen, char))
        end = pen + lettering.glyph(char).advance
    return tuple(parts)


@lru_cache(maxsize=8192)
def _measured(lettering: OutlineLettering, text: str) -> tuple[int, int, int, int, int]:
    """Return advance and ink bounds of a run in font units."""
    glyphs = [(lettering.glyph(char), pen) for char, pen in lettering.places(text)]
    boxes = [
        (pen + glyph.xmin, glyph.ymin, pen + glyph.xmax, glyph.ymax)
        for glyph, pen in glyphs
        if glyph.strokes
    ]
    end = glyphs[-1][1] + glyphs[-1][0].advance if glyphs else 0
    left, low, right, high = zip(*boxes or [(0, 0, 0, 0)], strict=True)
    return (end, min(left), min(low), max(right), max(high))


@cache
def lettering(name: str) -> OutlineLettering:
    """Return the lettering of a name in `STYLES`.

    Raises
    ------
    LayoutError
        If there is no such lettering.
    """
    latin = name.strip().replace("А", "A").replace("Б", "B").replace("В", "B")
    style = STYLES.get(latin)
    if style is None:
        raise LayoutError("Unknown lettering {!r}. Choose one of: {}.", name, ", ".join(STYLES))
    return OutlineLettering(style)


def lettering_of(name: str, usual: OutlineLettering) -> OutlineLettering:
    """Return the lettering of a text: the one that it names, or the usual one of its sheet."""
    return lettering(name) if name else usual


_DEFAULT = lettering("B")
_IN_USE: ContextVar[OutlineLettering | None] = ContextVar("lettering", default=None)


def in_use() -> OutlineLettering:
    """Return the lettering that texts are set in."""
    return _IN_USE.get() or _DEFAULT


@contextmanager
def using(lettering: OutlineLettering) -> Iterator[OutlineLettering]:
    """Set texts in another lettering inside the ``with`` block."""
    token = _IN_USE.set(lettering)
    try:
        yield lettering
    finally:
        _IN_USE.reset(token)
