"""Roots and greatest values of functions of one variable, to the last digits (корни)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from planmethod.solved.reading import Reals

Function = Callable[[Reals], Reals]
"""From places, ndarray of shape (n,), to values of the same shape; NaN: there is none."""

_PARTS = 32
_ROUNDS = 11  # a quarter of a degree over 32^11 is less than a binary fraction can tell
_TOP_ROUNDS = 6  # near its top a smooth function is flat: more rounds would follow its rounding
_VERTEX = 1 / 6  # share of the first bracket to both sides of a top where a parabola is laid


def crossings(values: Reals) -> list[int]:
    """Return the indices k between which and k + 1 a row of values changes its sign.

    A zero counts with what is before it; a gap (NaN) is no change.
    """
    found, last = [], 0.0
    for k, value in enumerate(values):
        if np.isnan(value):
            last = 0.0
        elif value != 0.0:
            if last * value < 0.0:
                found.append(k - 1)
            last = np.sign(value)
    return found


def root(function: Function, low: float, high: float) -> float:
    """Return where a function changes its sign between two places with different ones.

    What is no number counts with the sign at ``low``: the change is where the function still is.
    """
    sign = np.sign(function(np.array([high]))[0])
    if not sign:
        return high
    for _ in range(_ROUNDS):
        places = np.linspace(low, high, _PARTS + 1)
        there = np.flatnonzero(np.sign(function(places)) == sign)
        k = max(int(there[0]), 1) if there.size else _PARTS
        low, high = float(places[k - 1]), float(places[k])
        if abs(high - low) <= 4 * np.spacing(abs(high)):
            break
    ends = np.array([low, high])
    one, two = np.abs(function(ends))
    return low if one <= two else high


def top(function: Function, low: float, high: float, *, looks: int = _PARTS) -> tuple[float, float]:
    """Return the place and the size of the greatest value between two places.

    ``looks`` parts of the way are looked at first: so many that one of them holds the greatest.
    """
    vertex = _VERTEX * 2 * (high - low) / looks
    for parts in (looks, *[_PARTS] * (_TOP_ROUNDS - 1)):
        places = np.linspace(low, high, parts + 1)
        values = np.nan_to_num(function(places), nan=-np.inf)
        k = int(np.argmax(values))
        best = float(places[k]), float(values[k])
        low, high = float(places[max(k - 1, 0)]), float(places[min(k + 1, parts)])
    # Within rounding of its value the place of a smooth top is told by what is around it.
    at, size = best
    before, here, after = function(np.array([at - vertex, at, at + vertex]))
    bend = before - 2 * here + after
    off = vertex * (before - after) / (2 * bend) if bend < 0 else 0.0
    if np.isfinite(off) and abs(off) < vertex:
        moved = float(function(np.array([at + off]))[0])
        if moved >= size - 1e-12:
            return float(at + off), max(moved, size)
    return best
