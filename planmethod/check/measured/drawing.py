"""Elements and layers of a drawing: straight lines, inscriptions, marks; mm, y up."""

# Cyrillic letters: names of layers and colours, as drawings of students have them

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import pairwise
from pathlib import Path

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.check.submissions.cells import TEXT_LIMIT, SubmissionError
from planmethod.plans.model import PlanKind
from planmethod.problem.names import fold
from planmethod.render.backends.canvas import COMPONENTS, FIGURES, RELATIVE, VECTORS

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
    unit_mm : float
        Its stated unit, mm.
    points : list of (complex, str, int)
        Points and small circles with their layers and colours.
    """

    path: Path
    unit_mm: float = 1.0
    lines: list[DrawnLine] = field(default_factory=list)
    inscriptions: list[DrawnLetters] = field(default_factory=list)
    points: list[tuple[complex, str, int]] = field(default_factory=list)

    def enlarged(self, factor: float) -> MeasuredDrawing:
        """Return the drawing in another unit."""
        return MeasuredDrawing(
            self.path,
            self.unit_mm * factor,
            [replace(one, start=one.start * factor, end=one.end * factor) for one in self.lines],
            [
                DrawnLetters(one.text, one.at * factor, one.wide * factor, one.high * factor)
                for one in self.inscriptions
            ],
            [(at * factor, layer, colour) for at, layer, colour in self.points],
        )

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
        if len(self.inscriptions) >= TEXTS_LIMIT:
            raise SubmissionError(
                "{}: over {} inscriptions. Keep the plans.", self.path, TEXTS_LIMIT
            )
        self.inscriptions.append(DrawnLetters(told, at, wide, high))

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


PLANS = "plans"
"""Value for a layer with both plans; the letter of the pole distinguishes them."""

COLOURS = {
    "red": 1, "yellow": 2, "green": 3, "cyan": 4, "blue": 5, "magenta": 6, "white": 7,
    "красный": 1, "жёлтый": 2, "зелёный": 3, "голубой": 4, "синий": 5, "пурпурный": 6, "белый": 7,
}  # fmt: skip
"""Numbers of colours in AutoCAD's index by their names; ``color 30`` names any."""

_WORDS = {
    PlanKind.VELOCITY.value: (
        "velocity", "velocities", "velocity plan", "скорость", "скорости", "план скоростей",
    ),
    PlanKind.ACCELERATION.value: (
        "acceleration", "accelerations", "acceleration plan",
        "ускорение", "ускорения", "план ускорений",
    ),
    PLANS: ("plans", "планы", VECTORS, RELATIVE, COMPONENTS, FIGURES),
}  # fmt: skip
"""Names of layers that are recognised by default."""


def _key(text: str) -> str:
    return fold(" ".join(text.replace("_", " ").replace("-", " ").casefold().split()))


_OF_NAME = {_key(word): plan for plan, words in _WORDS.items() for word in words}


_OF_COLOUR = {_key(word): number for word, number in COLOURS.items()}
_COLOUR = tuple(map(_key, ("color", "colour", "цвет")))


def read_layers(options: Iterable[str]) -> dict[str, str]:
    """Return the plan of each layer and colour: ``PLAN_V=velocity``, ``red=velocity``.

    Raises
    ------
    WorksError
        Something is no such pair.
    """
    found: dict[str, str] = {}
    for one in options:
        name, equal, plan = one.partition("=")
        kind = _OF_NAME.get(_key(plan), "") if equal else ""
        if not name.strip() or not kind:
            raise SubmissionError(
                "--layer {}: write NAME=velocity, NAME=acceleration or NAME=plans.", one[:60]
            )
        found[_key(name)] = kind
    return found


def plan_of_layer(layers: Mapping[str, str], layer: str, colour: int) -> str:
    """Return which plan a line of a layer and colour belongs to; empty where it is of none."""
    if plan := layers.get(_key(layer)):
        return plan
    for name, plan in layers.items():
        word, _, number = name.rpartition(" ")
        numbered = word in _COLOUR and number == str(colour)
        if colour and (numbered or _OF_COLOUR.get(name) == colour):
            return plan
    return "" if layers else _OF_NAME.get(_key(layer), "")
