"""A construction as it is played (воспроизведение построения): sheets, sections, steps, strokes.

It is plain data: what a page shows one after another, and what frames and prints are made of.
Places are paper millimetres of a sheet of paper, x right, y up. A step holds what the pencil does
in it, `Mark`; a board has the finished drawing, with the step at which each of its items appears.
"""

from __future__ import annotations

from cmath import isfinite
from collections.abc import Iterable, Iterator, Sequence
from enum import Enum
from math import cos, radians, sin
from typing import TypeAlias

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.note.document import Equation
from planmethod.note.formula import Rich
from planmethod.render.ink.drawing import HEIGHTS, Bounds, Item
from planmethod.render.ink.typeset import ink_bounds

Place: TypeAlias = tuple[float, float]
"""x and y, mm."""


class Role(Enum):
    """Role of a stroke (роль линии)."""

    DATUM = "given"  # there before the step
    AID = "aid"  # shown in its step only: what the compasses span, the line that gives a direction
    CONSTRUCTION = "construction"  # a thin line that stays
    RESULT = "result"  # a found point or segment


class Segment(Struct, frozen=True, tag="segment"):
    """A stroke between two points (отрезок), mm."""

    start: Place
    end: Place
    role: Role
    board: str


class ArcMark(Struct, frozen=True, tag="arc"):
    """A stroke of the compasses (дуга), mm; angles are counter-clockwise from +x, degrees."""

    centre: Place
    radius: float
    start: float
    end: float
    role: Role
    board: str


class Dot(Struct, frozen=True, tag="dot"):
    """A found or given point (точка), mm."""

    at: Place
    role: Role
    board: str
    name: str = ""


Mark: TypeAlias = Segment | ArcMark | Dot


class Measured(Struct, frozen=True):
    """A segment that is read in a step, and what it is worth (снятый отрезок).

    Attributes
    ----------
    segment : Rich
    length : float, mm
    symbol : Rich
        Quantity that it shows; empty if it only serves the construction.
    value : float or None
        In ``unit``; length times the scale.
    """

    segment: Rich
    length: float
    symbol: Rich = ""
    value: float | None = None
    unit: Rich = ""


class PlayedStep(Struct, frozen=True):
    """A step as it is played (шаг): its sentences and strokes.

    Attributes
    ----------
    lines : tuple of Rich
        Its sentences and formulas.
    names : tuple of str
        Names that the steps of the program make which it shows; empty for words alone.
    marks : tuple of Mark
    measured : tuple of Measured
    """

    lines: tuple[Rich, ...]
    names: tuple[str, ...] = ()
    marks: tuple[Mark, ...] = ()
    measured: tuple[Measured, ...] = ()


class PlayedEquation(Struct, frozen=True):
    """A vector equation beside a plan: ``drawn`` has the step of each term, from the left.

    Steps are counted through the whole playback; -1 if no step draws the term.
    """

    equation: Equation
    drawn: tuple[int, ...]


class Board(Struct, frozen=True):
    """A sheet of paper on which a part is drawn (поле построения).

    Attributes
    ----------
    id : str
    title : Rich
    scale : Rich
        Inscription of its scale.
    box : Bounds
        Extent of everything that is drawn on it, mm.
    items : tuple of Item
        Lines and letters of the finished drawing, in the order in which they cover one another.
    appears : tuple of int
        Number of the step with which each of them is complete.
    """

    id: str
    title: Rich
    scale: Rich = ""
    box: Bounds = (-1.0, -1.0, 1.0, 1.0)
    items: tuple[Item, ...] = ()
    appears: tuple[int, ...] = ()


class PlayedSection(Struct, frozen=True):
    """A section: the steps of one group on one board (раздел).

    ``source`` is the board that is seen beside it: directions or arms are taken from it.
    """

    title: Rich
    board: str
    steps: tuple[PlayedStep, ...]
    equations: tuple[PlayedEquation, ...] = ()
    source: str = ""


class Playback(Struct, frozen=True):
    """A construction as it is played (воспроизведение)."""

    title: str
    boards: tuple[Board, ...]
    sections: tuple[PlayedSection, ...] = field(default_factory=tuple)

    def steps(self) -> Iterator[tuple[PlayedSection, PlayedStep]]:
        """Yield the steps in order, each with its section."""
        for section in self.sections:
            for step in section.steps:
                yield section, step

    @classmethod
    def of(cls, title: str, boards: Iterable[Board], sections: Iterable[PlayedSection]) -> Playback:
        """Return a playback whose boards have the extent of their drawings."""
        whole = cls(title, (), tuple(sections))
        steps = [step for _, step in whole.steps()]
        return replace(whole, boards=tuple(fit_board(board, steps) for board in boards))


def xy(place: complex) -> Place:
    """Return a place as its coordinates."""
    return place.real, place.imag


def fit_board(board: Board, steps: Iterable[PlayedStep]) -> Board:
    """Return a board as large as everything that is drawn on it."""
    x, y = list[float](), list[float]()
    if board.items:
        left, low, right, high = ink_bounds(board.items)
        x += (left, right)
        y += (low, high)
    for step in steps:
        for mark in step.marks:
            if mark.board == board.id and mark.role is not Role.AID:
                x += (at[0] for at in _ends(mark))
                y += (at[1] for at in _ends(mark))
    if not x:
        return board
    across, up = (max(0.0, LEAST - (max(side) - min(side))) / 2 + MARGIN for side in (x, y))
    box = min(x) - across, min(y) - up, max(x) + across, max(y) + up
    return replace(board, box=box)


def letter_height(places: Iterable[complex]) -> float:
    """Return the height of the letters of a board, mm: large plans are seen from the same distance.

    Parameters
    ----------
    places : iterable of complex, mm
        What is drawn on the board.

    Examples
    --------
    >>> letter_height([0j, 100 + 50j]), letter_height([0j, 400j]), letter_height([])
    (5.0, 10.0, 5.0)
    """
    here = [place for place in places if isfinite(place)]
    size = max((max(side) - min(side) for side in _sides(here)), default=0.0)
    fitting = (height for height in HEIGHTS if height >= SMALLEST and size <= LETTERS * height)
    return next(fitting, HEIGHTS[HEIGHTS.index(SMALLEST) + 3])


def _sides(places: Sequence[complex]) -> list[list[float]]:
    return [[p.real for p in places], [p.imag for p in places]] if places else []


SMALLEST, LETTERS = 5.0, 45.0
"""Least height of the letters of a board, mm, and how many of them go into its longest side."""

MARGIN = 6.0
"""Paper around the drawing of a board, mm."""

LEAST = 80.0
"""Least size of a board without its margin, mm: a small plan is not shown much enlarged."""


def _ends(mark: Mark) -> tuple[Place, ...]:
    match mark:
        case Segment(start=start, end=end):
            return start, end
        case Dot(at=at):
            return (at,)
        case ArcMark():
            return tuple(
                (
                    mark.centre[0] + mark.radius * cos(radians(turn)),
                    mark.centre[1] + mark.radius * sin(radians(turn)),
                )
                for turn in (mark.start, (mark.start + mark.end) / 2, mark.end)
            )
