"""Digits of the numbers in the formulas of a sheet: a number is printed alike wherever it is."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from math import prod

import numpy as np
from msgspec import Struct

from planmethod.construct.steps import (
    Compute,
    GivenNumber,
    Measure,
    MeasureAlong,
    Name,
    NumberName,
    Step,
)
from planmethod.note.numbers import decimals_of, half_up, significant, trimmed
from planmethod.plans.model import FACTS, MOTION, PlanKind
from planmethod.solved.reading import Reals, memoized
from planmethod.solved.solution import Solution

LEAST_DIGITS, MOST_DIGITS = 3, 4
"""Significant digits of a result of measured lengths; one more where the first digit is 1."""

_SCALES = {FACTS[kind].scale for kind in MOTION}

_OF_LINKS = FACTS[PlanKind.POSITION].scale

_LARGEST_DIFFERENCE = 0.05
"""Part of a value: numbers that differ more were not rounded, and are printed as they are."""


RULED = (Measure, MeasureAlong)
"""Steps whose values are read with a ruler."""


class PrintedNumber(Struct, frozen=True):
    """A magnitude as a sheet prints it, with a decimal point.

    ``digits`` is the number of its significant digits, ``is_measured`` whether it has the error of
    a pencil or of a ruler.
    """

    text: str
    digits: int = MOST_DIGITS
    is_measured: bool = False

    @property
    def value(self) -> float:
        """The number that is printed."""
        return float(self.text)


class PrintedNumbers:
    """Numbers of one position as they are printed (цифры расчёта).

    Given numbers have four digits, a length that a ruler measures one decimal, a length that is
    computed 0.1 mm, as a pencil sets it off, and finer on an enlarged view. A result is computed
    from the numbers printed in its formula, and has the digits of its measured lengths; so the
    printed arithmetic holds.
    """

    def __init__(self, solution: Solution, steps: Mapping[Name, Step], index: int) -> None:
        self._reading, self._steps, self._index = solution.ruler_reading, steps, index
        self._enlarged_on = solution.enlarged_on(index)
        self.of = cache(self._printed)

    def _number(self, name: NumberName) -> float:
        return abs(float(self._reading.number(name)[self._index]))

    def _printed(self, name: NumberName) -> PrintedNumber:
        value, step = self._number(name), self._steps.get(name)
        is_length = name[0] in "(|"
        if isinstance(step, Compute) and 0.0 < value < math.inf:
            return self._computed(step, value, is_length=is_length)
        if is_length and not isinstance(step, GivenNumber):
            text = f"{value:.1f}"
            text = text if math.isclose(float(text), value, rel_tol=1e-6) else significant(value, 3)
            return PrintedNumber(text, _digits(text), is_measured=True)
        text = trimmed(value)
        return PrintedNumber(text if _digits(text) <= MOST_DIGITS else significant(value))

    def _computed(self, step: Compute, value: float, *, is_length: bool) -> PrintedNumber:
        scales = [(name, power) for name, power in step.powers if name in _SCALES]
        others = [(self.of(name), power) for name, power in step.powers if name not in _SCALES]
        made = abs(step.factor) * prod(self._number(name) ** power for name, power in scales)
        made *= prod(one.value**power for one, power in others)
        if not abs(made - value) <= _LARGEST_DIFFERENCE * value:
            return PrintedNumber(significant(value))
        if not any(one.is_measured for one, _ in others):
            if is_length and (_OF_LINKS, -1) not in step.powers:  # a vector to be laid off
                return self._length(step.out, made)
            return PrintedNumber(trimmed(made, MOST_DIGITS))
        if is_length:
            return self._length(step.out, made)
        digits = min(one.digits for one, _ in others)
        if len(step.powers) > 2 or not scales:  # else a length times a scale has its digits
            digits = max(LEAST_DIGITS, digits) + (significant(made, 1).strip("0.")[:1] == "1")
        whole = len(f"{made:.0f}")  # no zeros in place of the last figures before the point
        digits = min(max(2, whole, digits), MOST_DIGITS)
        return PrintedNumber(significant(made, digits), digits, is_measured=True)

    def _length(self, name: NumberName, mm: float) -> PrintedNumber:
        view = self._enlarged_on.get(name)
        decimals = 1 if view is None else 1 + math.ceil(math.log10(view.times))
        in_decimals = mm >= 1.0 or view is not None
        text = f"{half_up(mm, decimals):.{decimals}f}" if in_decimals else significant(mm, 2)
        return PrintedNumber(text, _digits(text), is_measured=True)


def _digits(text: str) -> int:
    return max(1, len(text.partition("e")[0].replace(".", "").lstrip("0")))


@memoized
def ruler_steps(solution: Solution, name: NumberName) -> Reals:
    """Return what a division of the ruler is of a result in each position (цена деления).

    Parameters
    ----------
    solution : Solution
    name : str
        A number of the construction.

    Returns
    -------
    ndarray of shape (n,)
        In the unit of the number, at the scale of the plan or view on which its segments are read;
        that of the segment that has the largest part in it. 0 where the number is 0, or none is
        read.
    """
    step, count = solution.construction.step(name), len(solution.positions)
    if isinstance(step, RULED):
        times = solution.ruler_arithmetic.enlargements.get(name, 1.0)
        return np.asarray(solution.profile.ruler / np.broadcast_to(times, count), dtype=float)
    if not isinstance(step, Compute):
        return np.zeros(count)

    def size(of: NumberName) -> Reals:
        return np.abs(np.broadcast_to(solution.ruler_reading.number(of), count))

    with np.errstate(divide="ignore", invalid="ignore"):
        parts = [abs(power) * ruler_steps(solution, one) / size(one) for one, power in step.powers]
        found = size(name) * np.max(parts, axis=0)
    return np.where(np.isfinite(found), found, 0.0)


def decimals_of_step(step: float) -> int:
    """Return the decimals of numbers that a ruler reads in steps.

    They are those that its steps have, or else its place.

    >>> [decimals_of_step(step) for step in (0.01, 0.025, 0.125, 0.217, 25.0, 137.0)]
    [2, 3, 3, 1, 0, 0]
    """
    text = trimmed(step, 3)
    if math.isclose(float(text), step, rel_tol=1e-9):
        return decimals_of(text)
    return max(0, -math.floor(math.log10(step)))
