"""Roots and greatest values of functions of one variable, to the last digits (корни)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from planmethod.solved.reading import Reals

Function = Callable[[Reals], Reals]
"""From places, ndarray of shape (n,), to values of the same shape; NaN: there is none."""

_PARTS = 32
_ROUNDS = 11  # a quarter of a degree over 32^11 is less than the spacing of binary fractions
_TOP_ROUNDS = 6  # near its top a smooth function is flat: more rounds would follow its rounding
_VERTEX = 1 / 6  # share of the first bracket to both sides of a top where a parabola is laid


def crossings(values: Reals) -> list[int]:
    """Return the indices k between which and k + 1 a row of values changes its sign.

    A zero counts with the value before it; a gap (NaN) is not a change.
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
    """Return the place where a function changes its sign between two places of different signs.

    NaN counts with the sign at ``low``: the change is at the edge of the function's domain.
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


def top(
    function: Function, low: float, high: float, *, samples: int = _PARTS
) -> tuple[float, float]:
    """Return the place and the size of the greatest value between two places.

    The interval is first divided into ``samples`` parts: enough that one of them holds the
    greatest.
    """

    def one(places: Reals) -> Reals:
        return function(places.ravel()).reshape(places.shape)

    at, size = tops(one, np.array([low]), np.array([high]), samples=samples)
    return float(at[0]), float(size[0])


def tops(
    function: Function, low: Reals, high: Reals, *, samples: int = _PARTS
) -> tuple[Reals, Reals]:
    """Return the same for several pairs of places, which are processed together.

    Parameters
    ----------
    function : callable
        From places, ndarray of shape (m, k), a row for each pair, to values of that shape.
    low, high : ndarray of shape (m,)

    Returns
    -------
    places, sizes : ndarray of shape (m,)
    """
    row, vertex = np.arange(len(low)), _VERTEX * 2 * (high - low) / samples
    for parts in (samples, *[_PARTS] * (_TOP_ROUNDS - 1)):
        places = np.linspace(low, high, parts + 1, axis=-1)
        values = np.nan_to_num(function(places), nan=-np.inf)
        k = np.argmax(values, axis=-1)
        at, size = places[row, k], values[row, k]
        low, high = places[row, np.maximum(k - 1, 0)], places[row, np.minimum(k + 1, parts)]
    # Within rounding of its value the place of a smooth top is found from its surroundings.
    before, here, after = function(np.stack([at - vertex, at, at + vertex], axis=-1)).T
    with np.errstate(divide="ignore", invalid="ignore"):
        bend = before - 2 * here + after
        off = np.where(bend < 0, vertex * (before - after) / (2 * bend), 0.0)
    inside = np.isfinite(off) & (np.abs(off) < vertex)
    moved = at + np.where(inside, off, 0.0)
    there = function(moved[:, np.newaxis])[:, 0]
    taken = inside & (there >= size - 1e-12)
    return np.where(taken, moved, at), np.where(taken, np.maximum(there, size), size)
