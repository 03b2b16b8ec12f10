"""Skeletons of letters: the way of the pen's middle in every type of GOST 2.304 (остов буквы).

`shapes` holds type B; type A follows from it. All lengths are in line thicknesses d, the origin is
on the base line at the left end of the letter's room, y up.
"""

from __future__ import annotations

import re
from cmath import exp, phase
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from math import ceil, radians, tan, tau
from typing import TypeAlias

from planmethod.render.ink.lettering import TYPES, Proportions
from scripts import shapes

Strokes: TypeAlias = tuple[tuple[complex, ...], ...]
"""Polylines; a closed one ends where it begins."""


_B = TYPES["B"]
_RAISED = 0.6  # size of raised and lowered signs
_DOT = 0.2  # a dot is a small circle of the pen, so that it is seen: 1.4 d wide with its line
_STEP = radians(7.5)  # of the polyline that approximates a rounded corner
_CLASS_WIDTH = 4.0  # from this width on, a letter of type A is one d wider than one of type B


@dataclass(frozen=True, slots=True)
class Skeleton:
    """One letter: its strokes, and the room it takes along the line, d."""

    strokes: Strokes
    advance: float


def letters() -> list[str]:
    """Return all letters that there are, in the order of their codes."""
    tables = (
        shapes.CAPITALS,
        shapes.SMALL,
        shapes.SIGNS,
        shapes.MARKED,
        shapes.ALIKE,
        shapes.RAISED,
        shapes.LOWERED,
        shapes.BLANKS,
        shapes.COMBINING,
    )
    return sorted({char for table in tables for char in table})


@lru_cache(maxsize=1024)
def skeleton(char: str, kind: str) -> Skeleton:
    """Return the upright letter ``char`` in the type ``kind``.

    Raises
    ------
    KeyError
        If there is no such letter.
    """
    measures = TYPES[kind]
    if char in shapes.BLANKS:
        return Skeleton((), shapes.BLANKS[char])
    if char in shapes.COMBINING:
        mark = _mark(shapes.COMBINING[char], measures, measures.small)
        return Skeleton(_moved(mark, complex(-3.5, 0)), 0.0)
    found = _found(char)
    if found is None:
        raise KeyError(char)
    strokes, spread, mark = found
    if mark:
        strokes += _over(strokes, mark)
    mapped = _mapped(strokes, spread(strokes, measures))
    left = min(point.real for line in mapped for point in line)
    right = max(point.real for line in mapped for point in line)
    side = measures.gap / 2 + 0.5
    return Skeleton(_moved(mapped, complex(side - left, 0.5)), right - left + 2 * side)


def missing_box(kind: str) -> Skeleton:
    """Return the box drawn in place of a missing letter."""
    measures = TYPES[kind]
    top = measures.cap - 0.5
    box = (1.5 + 0.5j, 5.5 + 0.5j, 5.5 + 1j * top, 1.5 + 1j * top, 1.5 + 0.5j)
    return Skeleton((box,), 7.0)


# From type B to the requested type --------------------------------------------------------------

_Map: TypeAlias = Callable[[complex], complex]
_Spread: TypeAlias = Callable[[Strokes, Proportions], _Map]


def _wider(strokes: Strokes, measures: Proportions) -> float:
    """Return how much wider a letter is, in d: one d wider in type A than in type B."""
    if measures.cap == _B.cap:
        return 1.0
    xs = [point.real for line in strokes for point in line]
    return 1.0 + 1.0 / max(_CLASS_WIDTH, max(xs) - min(xs))


def _of_capitals(strokes: Strokes, measures: Proportions) -> _Map:
    wide = _wider(strokes, measures)
    tall = (measures.cap - 1) / (_B.cap - 1)
    return lambda point: complex(point.real * wide, point.imag * tall)


def _of_small(strokes: Strokes, measures: Proportions) -> _Map:
    wide = _wider(strokes, measures)
    small = (measures.small - 1) / (_B.small - 1)
    above = (measures.cap - measures.small) / (_B.cap - _B.small)
    below = measures.tail / _B.tail

    def place(point: complex) -> complex:
        y, top = point.imag, _B.small - 1
        tall = y * below if y < 0 else min(y, top) * small + max(0.0, y - top) * above
        return complex(point.real * wide, tall)

    return place


def _of_signs(strokes: Strokes, measures: Proportions) -> _Map:
    size = (measures.cap - 1) / (_B.cap - 1)
    return lambda point: point * size


def _found(char: str) -> tuple[Strokes, _Spread, Strokes] | None:
    """Return strokes of type B, how they are spread in other types, and the mark above."""
    for table, low in ((shapes.RAISED, 4.2), (shapes.LOWERED, -1.8)):
        if char in table:
            whole = _found(table[char])
            assert whole is not None
            raised = _moved(_mapped(whole[0], lambda point: point * _RAISED), 1j * low)
            return raised, _of_signs, ()
    if char in shapes.MARKED:
        letter, _, mark = shapes.MARKED[char].partition(" ")
        whole = _found(letter)
        assert whole is not None
        return whole[0], whole[1], parsed(shapes.MARKS[mark])
    char = shapes.ALIKE.get(char, char)
    for shape_table, spread in (
        (shapes.CAPITALS, _of_capitals),
        (shapes.SMALL, _of_small),
        (shapes.SIGNS, _of_signs),
    ):
        if char in shape_table:
            return parsed(shape_table[char]), spread, ()
    return None


def _over(strokes: Strokes, mark: Strokes) -> Strokes:
    """Return a mark above the middle of a letter; the dots of Ё leave one d of white more."""
    xs = [point.real for line in strokes for point in line]
    top = max(point.imag for line in strokes for point in line)
    base = _B.cap - 1 if top > _B.small - 1 else _B.small
    return _moved(mark, complex((min(xs) + max(xs)) / 2, base))


def _mark(name: str, measures: Proportions, height: float) -> Strokes:
    size = (measures.cap - 1) / (_B.cap - 1)
    mark = parsed(shapes.MARKS[name])
    return _mapped(mark, lambda point: complex(point.real * size, point.imag + height))


def _mapped(strokes: Strokes, place: _Map) -> Strokes:
    return tuple(tuple(place(point) for point in line) for line in strokes)


def _moved(strokes: Strokes, by: complex) -> Strokes:
    return _mapped(strokes, lambda point: point + by)


# The notation of the shapes ---------------------------------------------------------------------

_POINT = r"(-?[\d.]+),(-?[\d.]+)(?:~([\d.]+))?$"


@lru_cache(maxsize=1024)
def parsed(shape: str) -> Strokes:
    """Return the strokes of a shape in the notation of `shapes`, rounded corners as polylines."""
    strokes = []
    for part in shape.split("|"):
        words = part.split()
        closed = words[-1] == "@"
        points, radii = [], []
        for word in words[:-1] if closed else words:
            match = re.match(_POINT, word)
            if match is None:
                raise ValueError(f"{word!r} in the shape {shape!r} is no point: x,y or x,y~radius")
            points.append(complex(float(match[1]), float(match[2])))
            radii.append(float(match[3] or 0.0))
        strokes.append(_rounded(points, radii, closed=closed))
    return tuple(strokes)


def _rounded(points: list[complex], radii: list[float], *, closed: bool) -> tuple[complex, ...]:
    """Return a polyline whose corners are rounded as far as its sides are long enough."""
    if len(points) == 1:
        return tuple(points[0] + _DOT * exp(1j * tau * k / 8) for k in range(9))
    if closed:
        # Begin in the middle of a side, so that every corner is inside the line.
        start = (points[-1] + points[0]) / 2
        points, radii = [start, *points, start], [0.0, *radii, 0.0]
    sides = [b - a for a, b in pairwise(points)]
    turns = [0.0, *(phase(after / before) for before, after in pairwise(sides)), 0.0]
    cuts = [r * tan(abs(turn) / 2) for r, turn in zip(radii, turns, strict=True)]
    for k, side in enumerate(sides):
        asked = cuts[k] + cuts[k + 1]
        if asked > abs(side):
            cuts[k], cuts[k + 1] = (cut * abs(side) / asked for cut in (cuts[k], cuts[k + 1]))
    line = [points[0]]
    for k in range(1, len(points) - 1):
        corner, turn, cut = points[k], turns[k], cuts[k]
        if cut < 1e-9:
            line.append(corner)
            continue
        before = sides[k - 1] / abs(sides[k - 1])
        radius = cut / tan(abs(turn) / 2)
        middle = corner - before * cut + before * 1j * radius * (1 if turn > 0 else -1)
        spoke = corner - before * cut - middle
        count = max(1, ceil(abs(turn) / _STEP))
        line += [middle + spoke * exp(1j * turn * i / count) for i in range(count + 1)]
    line.append(points[-1])
    return tuple(point for k, point in enumerate(line) if k == 0 or abs(point - line[k - 1]) > 1e-9)
