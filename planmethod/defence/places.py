"""Places on drawn sheets: a view, an inscription in it (места на листах)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from msgspec import Struct

from planmethod.defence.model import Place
from planmethod.note.formula import Rich
from planmethod.project.parts import PartName
from planmethod.render.ink.drawing import Bounds, Drawing, Text, View

ZONE = (210.0, 297.0)
"""Width and height of a zone, mm: the sides of A4 (GOST 2.104)."""

LETTERS = "ABCDEFGH"
"""Letters of the rows of zones from below."""

EDGE = 1.0
"""Distance from a view's box up to which its inscriptions may reach, mm."""

PLACED = re.compile(r"\A([^@]+)@-?[\d.]+,-?[\d.]+")
"""Label of an inscription that is named by its own text."""


def zone_of(width: float, at: complex) -> str:
    """Return the zone of a place on a sheet: ``3B``.

    Zones are counted from the right and lettered from below.
    """
    return f"{int((width - at.real) // ZONE[0]) + 1}{LETTERS[int(at.imag // ZONE[1])]}"


class NumberedSheet(Struct, frozen=True):
    """A sheet of a set (лист): its number, the part of the work that it belongs to."""

    number: int
    part: PartName | None
    drawing: Drawing


class Sheets:
    """Sheets of a work, in which places are looked up.

    Parameters
    ----------
    sheets : sequence of NumberedSheet
    """

    def __init__(self, sheets: Sequence[NumberedSheet]) -> None:
        self.sheets = tuple(sheets)

    def find(self, part: PartName | None, kind: str, mark: str = "") -> Place | None:
        """Return a view of a kind on the sheets of a part, and an inscription in it.

        Parameters
        ----------
        kind : str
            As in `View`; empty: of any kind.
        mark : str
            Regular expression of the whole name of the inscription; the first view that has one is
            taken. Empty: the first view, and its middle.
        """
        for sheet in self.sheets:
            if sheet.part is not part:
                continue
            for view in sheet.drawing.views:
                if kind not in ("", view.kind):
                    continue
                if not mark:
                    return self.place_of(sheet, view)
                for item in texts_in(sheet.drawing, view.box):
                    if re.fullmatch(mark, item.label):
                        return self.place_of(sheet, view, item.at, item.label)
        return None

    def find_lettered(self, part: PartName | None, kind: str, symbol: Rich) -> Place | None:
        """Return the inscription of a symbol in a view of a kind, which may stand with others."""
        wanted = letters_of(symbol)
        for sheet in self.sheets:
            for view in sheet.drawing.views if sheet.part is part else ():
                lines: dict[str, list[Text]] = {}
                for item in texts_in(sheet.drawing, view.box) if view.kind == kind else ():
                    lines.setdefault(item.label, []).append(item)
                for label, runs in lines.items():
                    line = "".join(run.text for run in runs)
                    if wanted in re.split(r"[\s=,]+", line):
                        return self.place_of(sheet, view, runs[0].at, label)
        return None

    def find_text(self, part: PartName | None, mark: str) -> Place | None:
        """Return an inscription of a part's sheets outside or inside of views."""
        for sheet in self.sheets:
            drawing = sheet.drawing
            for item in drawing.items if sheet.part is part else ():
                if isinstance(item, Text) and re.fullmatch(mark, item.label):
                    zone, name = zone_of(drawing.width, item.at), ""
                    if (found := PLACED.fullmatch(item.label)) is not None:
                        name = found[1]
                    return Place(sheet.number, drawing.title, name, zone, item.at, item.label)
        return None

    def middle_of(self, sheet: NumberedSheet) -> Place:
        """Return a sheet as a place: its middle."""
        drawing = sheet.drawing
        at = complex(drawing.width / 2, drawing.height / 2)
        return Place(sheet.number, drawing.title, "", zone_of(drawing.width, at), at)

    def place_of(
        self, sheet: NumberedSheet, view: View, at: complex | None = None, mark: str = ""
    ) -> Place:
        """Return a place in a view of a sheet. Default: its middle."""
        drawing = sheet.drawing
        if at is None:
            x0, y0, x1, y1 = view.box
            at = complex((x0 + x1) / 2, (y0 + y1) / 2)
        name = view_name(drawing, view)
        return Place(sheet.number, drawing.title, name, zone_of(drawing.width, at), at, mark)


def letters_of(symbol: Rich) -> str:
    """Return the letters of a symbol as runs of an inscription have them: ``F10``."""
    return re.sub(r"[_^{}]", "", symbol)


def texts_in(drawing: Drawing, box: Bounds) -> Iterator[Text]:
    """Yield the inscriptions in a box of a sheet."""
    x0, y0, x1, y1 = box
    for item in drawing.items:
        if not isinstance(item, Text):
            continue
        if x0 - EDGE <= item.at.real <= x1 + EDGE and y0 - EDGE <= item.at.imag <= y1 + EDGE:
            yield item


def view_name(drawing: Drawing, view: View) -> str:
    """Return the name above a view (GOST 2.316), of one line or of several; empty if it has none.

    Its lines are the highest inscriptions of the view that begin at one edge in one height.
    """
    lines: dict[str, Text] = {}
    for item in texts_in(drawing, view.box):
        if PLACED.fullmatch(item.label) and not item.angle:
            lines.setdefault(item.label, item)
    if not lines:
        return ""
    ordered = sorted(lines.values(), key=lambda item: -item.at.imag)
    first = ordered[0]
    found = [first]
    for item in ordered[1:]:
        step = found[-1].at.imag - item.at.imag
        is_next = abs(item.height - first.height) < 0.01 and 0 < step <= 2.0 * first.height
        if is_next and abs(item.at.real - first.at.real) < 0.5:
            found.append(item)
    return " ".join(item.label.rpartition("@")[0] for item in found)
