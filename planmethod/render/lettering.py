"""Lettering behind one interface: widths and outlines of the letters, whatever their source.

`Lettering` is all that the rest of the renderer knows of letters, and it asks `in_use` for the one
that a sheet is set in; `using` sets another. The output formats need outlines too: they know
`OutlineLettering`, which a `Drawing` brings along.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple, Protocol

FONTS = Path(__file__).parent / "fonts"


class Lettering(Protocol):
    """What drawing needs of a lettering (шрифт); heights are cap heights h in mm."""

    name: str

    def __hash__(self) -> int:
        """Letterings are told apart: what was set once is kept by lettering."""
        ...

    def width(self, text: str, height: float) -> float:
        """Return the advance of a run of letters, mm."""
        ...

    def ascent(self, text: str, height: float) -> float:
        """Return how far the ink of this run rises above the base line, mm."""
        ...

    def descent(self, text: str, height: float) -> float:
        """Return how far the ink of this run goes below the base line, mm (positive)."""
        ...


class Glyph(NamedTuple):
    """One letter in font units, y up, origin on the base line.

    ``outline`` is an SVG path of M, L, Q and Z with absolute coordinates, filled by the non-zero
    rule; it is empty for a blank, and the bounds are then all zero.
    """

    advance: int
    xmin: int
    ymin: int
    xmax: int
    ymax: int
    outline: str


@dataclass(eq=False)
class OutlineLettering:
    """Lettering read from the data files that ``scripts/make_font.py`` makes.

    Letters stand side by side by their advances: no kerning, so every output format places them
    alike. The data are read when the first letter is asked for.
    """

    name: str = "PlanmethodSans"

    @property
    def font_file(self) -> Path:
        """The font (TrueType) with the same outlines, for formats that embed one."""
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
    def _runs(self) -> dict[str, tuple[int, int, int, int]]:
        return {}

    @cached_property
    def _glyphs(self) -> dict[str, Glyph]:
        return {}

    def em(self, height: float) -> float:
        """Return the font size whose capitals are ``height`` high, in the unit of ``height``."""
        return height * self.units_per_em / self.cap_height

    def outline(self, char: str) -> Glyph:
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
        """Return each letter of a run and where its origin stands, font units."""
        placed, pen = [], 0
        for char in text:
            placed.append((char, pen))
            pen += self.outline(char).advance
        return placed

    def width(self, text: str, height: float) -> float:
        """Return the advance of a run of letters, mm."""
        return sum(self.outline(char).advance for char in text) * height / self.cap_height

    def ink(self, text: str, height: float) -> tuple[float, float, float, float]:
        """Return the bounds of the ink of a run that starts at the origin.

        Returns
        -------
        tuple of float
            xmin, ymin, xmax, ymax, mm; all zero when the run has no ink.
        """
        unit = height / self.cap_height
        left, low, right, high = self._units(text)
        return (left * unit, low * unit, right * unit, high * unit)

    def _units(self, text: str) -> tuple[int, int, int, int]:
        """Return the ink bounds in font units; runs recur, so they are kept."""
        found = self._runs.get(text)
        if found is not None:
            return found
        boxes = []
        for char, pen in self.places(text):
            glyph = self.outline(char)
            if glyph.outline:
                boxes.append((pen + glyph.xmin, glyph.ymin, pen + glyph.xmax, glyph.ymax))
        if boxes:
            left, low, right, high = zip(*boxes, strict=True)
            bounds = (min(left), min(low), max(right), max(high))
        else:
            bounds = (0, 0, 0, 0)
        self._runs[text] = bounds
        return bounds

    def ascent(self, text: str, height: float) -> float:
        """Return how far the ink of this run rises above the base line, mm."""
        return max(0.0, self.ink(text, height)[3])

    def descent(self, text: str, height: float) -> float:
        """Return how far the ink of this run goes below the base line, mm (positive)."""
        return max(0.0, -self.ink(text, height)[1])


_DEFAULT = OutlineLettering()
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


def missing(text: str) -> set[str]:
    """Return the letters of ``text`` that the lettering in use has not."""
    return in_use().missing(text)
