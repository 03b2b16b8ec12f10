"""Elements read from a drawing: straight lines, inscriptions, marks; in mm, y up (чертёж)."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path

from msgspec import Struct, field

from planmethod.check.submissions.cells import TEXT_LIMIT
from planmethod.check.submissions.faults import SubmissionError

LINES_LIMIT = 20_000
TEXTS_LIMIT = 20_000

PROFILE_BY_SUFFIX = {".dxf": "cad", ".svg": "board"}
"""Drafting profile by file suffix: planmethod's own sheets are read with a ruler."""

STRAIGHT = 1e-4
"""Maximum bend of a polyline that counts as straight, radians."""

REACH_LIMIT = 1e6
"""Nothing on a sheet is further away than a kilometre, mm."""


def is_drawing(path: Path) -> bool:
    """Return whether a file is a drawing, by its ending."""
    return path.suffix.lower() in PROFILE_BY_SUFFIX


class DrawnLine(Struct, frozen=True):
    """A straight line of a drawing (отрезок).

    Attributes
    ----------
    start, end : complex
        mm.
    layer : str
    colour : int
        Number of the colour in AutoCAD's index; 0 where the drawing has none.
    """

    start: complex
    end: complex
    layer: str
    colour: int = 0

    @property
    def length(self) -> float:
        """Length, mm."""
        return abs(self.end - self.start)


class DrawnLetters(Struct, frozen=True):
    """Letters of a drawing, and the room that they take (надпись).

    Attributes
    ----------
    text : str
    at : complex
        Middle, mm.
    wide, high : float
        mm.
    """

    text: str
    at: complex
    wide: float
    high: float

    def distance_to(self, place: complex) -> float:
        """Return the distance of a place from the box of the letters, mm."""
        off = place - self.at
        return abs(
            complex(
                max(0.0, abs(off.real) - self.wide / 2), max(0.0, abs(off.imag) - self.high / 2)
            )
        )


class MeasuredDrawing(Struct):
    """A drawing while it is read.

    Attributes
    ----------
    points : list of (complex, str, int)
        Points and small circles with their layers and colours.
    """

    path: Path
    lines: list[DrawnLine] = field(default_factory=list)
    texts: list[DrawnLetters] = field(default_factory=list)
    points: list[tuple[complex, str, int]] = field(default_factory=list)

    def line(self, corners: Iterable[complex], layer: str, colour: int) -> None:
        """Add the straight lines between corners; those of zero length are ignored.

        Raises
        ------
        WorksError
            There are too many.
        """
        whole: list[complex] = []
        for corner in corners:
            if whole and not (corner != whole[-1] and _is_on_sheet(corner, whole[-1])):
                continue
            if len(whole) > 1 and _goes_on(whole[-2], whole[-1], corner):
                whole.pop()
            whole.append(corner)
        for start, end in pairwise(whole):
            if len(self.lines) >= LINES_LIMIT:
                raise SubmissionError("{}: over {} lines. Keep the plans.", self.path, LINES_LIMIT)
            self.lines.append(DrawnLine(start, end, layer, colour))

    def text(self, text: str, at: complex, wide: float, high: float) -> None:
        """Add an inscription; blank ones are ignored.

        Raises
        ------
        WorksError
            There are too many.
        """
        told = " ".join(text[: 4 * TEXT_LIMIT].split())
        if not told or not _is_on_sheet(at):
            return
        if len(self.texts) >= TEXTS_LIMIT:
            raise SubmissionError(
                "{}: over {} inscriptions. Keep the plans.", self.path, TEXTS_LIMIT
            )
        self.texts.append(DrawnLetters(told, at, wide, high))

    def point(self, at: complex, layer: str, colour: int) -> None:
        """Take a point, or the middle of a small circle."""
        if _is_on_sheet(at) and len(self.points) < LINES_LIMIT:
            self.points.append((at, layer, colour))


def _goes_on(one: complex, two: complex, three: complex) -> bool:
    """Return whether a line goes straight on."""
    way = (three - two) / (two - one)
    return way.real > 0 and abs(way.imag) < STRAIGHT * way.real


def _is_on_sheet(*places: complex) -> bool:
    """Return whether places are numbers, and on a sheet."""
    return all(abs(place) < REACH_LIMIT for place in places)  # False for NaN
