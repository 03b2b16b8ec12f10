"""A student's hand: it draws, reads a ruler, calculates, and writes down (рука студента).

Nothing here comes from the product. Each quantity has its own errors, which follow from the seed
and its name only: the same hand draws the same plan with a mistake and without it.
"""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

Data = Mapping[str, Any]
"""A problem file as it is read, with the numbers of a variant."""

EVERYWHERE = "*"
"""Place of a habit that a student has wherever it can occur, such as a forgotten scale."""


class ImpossibleError(Exception):
    """A plan that cannot be drawn, or a quotient by zero."""


@dataclass(frozen=True, slots=True)
class Hand:
    """How a student draws and calculates.

    Attributes
    ----------
    seed : str
        What all errors of the hand follow from.
    ruler : float, mm
        Step of reading; 0 for exact readings.
    point, eye : float, mm
        Standard deviations of a drawn point and of a reading before it is rounded.
    angle : float, degree
        Standard deviation of a direction carried from the scheme to a plan.
    digits : int
        Significant digits of every calculated number.
    pi : float
    writes_mm : bool
        Whether the lengths of segments are written beside the values.
    from_omega : bool
        Whether a normal acceleration is ω²l and the velocity of a rocker's point ωl; else v²/l,
        and the similarity of plans.
    writes_zero : bool
        Whether 0 is written for what is left out; else nothing.
    """

    seed: str
    ruler: float = 0.5
    point: float = 0.15
    eye: float = 0.12
    angle: float = 0.15
    digits: int = 4
    pi: float = math.pi
    writes_mm: bool = False
    from_omega: bool = False
    writes_zero: bool = False

    def error(self, name: str, size: float) -> float:
        """Return the error of a named operation."""
        return random.Random(f"{self.seed}|{name}").gauss(0.0, size) if size else 0.0

    def put(self, name: str, point: complex) -> complex:
        """Return a point as it comes out on paper."""
        return point + complex(
            self.error(f"{name} x", self.point), self.error(f"{name} y", self.point)
        )

    def carry(self, name: str, direction: complex) -> complex:
        """Return the unit vector of a direction carried to a plan."""
        size = abs(direction)
        if size < 1e-9:
            raise ImpossibleError(name)
        turn = math.radians(self.error(f"{name} angle", self.angle))
        return direction / size * complex(math.cos(turn), math.sin(turn))

    def read(self, name: str, length: float) -> float:
        """Return a length as the ruler shows it."""
        seen = abs(length) + self.error(f"{name} read", self.eye)
        return abs(round(seen / self.ruler) * self.ruler) if self.ruler else abs(length)

    def calculate(self, value: float) -> float:
        """Return a number as the calculator's display is copied."""
        return rounded(value, self.digits)


def rounded(value: float, digits: int) -> float:
    """Return a number with so many significant digits."""
    if not math.isfinite(value):
        raise ImpossibleError("no number")
    if value == 0.0:
        return 0.0
    return round(value, digits - 1 - math.floor(math.log10(abs(value))))


@dataclass(slots=True)
class Answer:
    """What is written for one quantity.

    Attributes
    ----------
    value : float
        With its sign, counter-clockwise and along the axes positive.
    mm : float or None, mm
    turns : bool
        Whether the sign is a sense of rotation, written as a word.
    """

    value: float
    mm: float | None = None
    turns: bool = False


@dataclass(slots=True)
class Student:
    """A student at work: data, a hand, habits, and what is written (студент).

    Attributes
    ----------
    habits : frozenset of (str, str)
        Names of bad habits with the quantities in which the student has them.
    said : dict of str to Answer
        Answers by the names of the form.
    met : list of (str, str)
        Occasions for all habits on the way.
    struck : list of str
        Quantities in which a habit was followed.
    """

    data: Data
    hand: Hand
    habits: frozenset[tuple[str, str]] = frozenset()
    said: dict[str, Answer] = field(default_factory=dict)
    met: list[tuple[str, str]] = field(default_factory=list)
    struck: list[str] = field(default_factory=list)

    def slips(self, habit: str, key: str, *others: str, everywhere: bool = False) -> bool:
        """Return whether the student follows a bad habit here."""
        place = EVERYWHERE if everywhere else key
        if (habit, place) not in self.met:
            self.met.append((habit, place))
        if (habit, place) not in self.habits:
            return False
        self.struck += [key, *others]
        return True

    def say(self, key: str, value: float, mm: float | None = None, *, turns: bool = False) -> float:
        """Write an answer, and return the value that the student goes on with."""
        value = self.hand.calculate(value)
        told = mm if mm is not None and self.hand.writes_mm and mm < 1000 else None
        self.said[key] = Answer(value, told, turns)
        return value

    def leave_out(self, key: str) -> None:
        """Write what a student writes for what is left out: 0, or nothing."""
        if self.hand.writes_zero:
            self.said[key] = Answer(0.0)

    def copy_out(self) -> None:
        """Copy the answers to the form, with the slips that do not touch the calculation."""
        keys = list(self.said)
        for key in keys:
            answer = self.said[key]
            if answer.value == 0.0:
                continue
            if self.slips("decimal point moved", key):
                answer.value *= 10.0 if len(key) % 2 else 0.1
            swapped = _digits_swapped(answer.value)
            if swapped is not None and self.slips("two digits swapped", key):
                answer.value = swapped
        for first, second in _of_one_kind(keys):
            if self.slips("two values swapped", first, second):
                self.said[first], self.said[second] = self.said[second], self.said[first]


def _digits_swapped(value: float) -> float | None:
    """Return a value with its first two digits swapped; None where this changes little."""
    text = f"{value:.6g}"
    places = [n for n, c in enumerate(text) if c.isdigit() and text[:n].strip("-0.") + c != "0"]
    if "e" in text or len(places) < 2:
        return None
    one, two = places[:2]
    if abs(int(text[one]) - int(text[two])) < 2 or text[two] == "0":
        return None
    letters = list(text)
    letters[one], letters[two] = letters[two], letters[one]
    return float("".join(letters))


def _of_one_kind(keys: list[str]) -> list[tuple[str, str]]:
    """Return neighbours of one kind, which a student may confuse on the form."""
    kinds: dict[str, list[str]] = {}
    for key in keys:
        kinds.setdefault(key.replace("_", " ").split()[0], []).append(key)
    return [pair for group in kinds.values() for pair in pairwise(group)]
