"""Roots and best values of functions of one variable (поиск), in an interval that holds one."""

from __future__ import annotations

from collections.abc import Callable
from math import inf, isnan, sqrt

_STEPS = 200
"""Halvings of an interval at most: more than a float64 has digits."""

_GRID = 400
"""Places that are looked at before the best of them is refined."""


def root(function: Callable[[float], float], low: float, high: float) -> float:
    """Return where a function is zero that changes its sign once (деление пополам)."""
    rises = function(high) > 0.0
    for _ in range(_STEPS):
        middle = (low + high) / 2
        if middle in (low, high):
            break
        if (function(middle) > 0.0) == rises:
            high = middle
        else:
            low = middle
    return (low + high) / 2


def best(function: Callable[[float], float], low: float, high: float) -> float:
    """Return where a function is least within an open interval (золотое сечение).

    What is not a number there counts as infinite.
    """

    def value(x: float) -> float:
        y = function(x)
        return inf if isnan(y) else y

    step = (high - low) / _GRID
    places = [low + (k + 0.5) * step for k in range(_GRID)]
    middle = min(places, key=value)
    left, right, share = max(low, middle - step), min(high, middle + step), (sqrt(5.0) - 1.0) / 2
    for _ in range(80):
        one, two = right - share * (right - left), left + share * (right - left)
        if value(one) < value(two):
            right = two
        else:
            left = one
    return (left + right) / 2
