"""Maxima of functions on an interval, and points of many half-planes nearest to the origin."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from planmethod.cams.laws import Reals

SAMPLES, FINER, ROUNDS = 257, 17, 12

RealFunction = Callable[[Reals], Reals]


def peak(of: RealFunction, start: float, end: float) -> tuple[float, float]:
    """Return the argument and the value of a smooth function's maximum on an interval.

    Every peak of the samples is refined, so that the greater of two nearly equal ones is found.
    """
    x = np.linspace(start, end, SAMPLES)
    with np.errstate(all="ignore"):
        y = np.nan_to_num(of(x), nan=-np.inf)
        padded = np.concatenate([[-np.inf], y, [-np.inf]])
        tops = np.flatnonzero((y >= padded[:-2]) & (y >= padded[2:]))
        tops = tops[np.argsort(-y[tops])][:8]
        low, high = x[np.maximum(tops - 1, 0)], x[np.minimum(tops + 1, SAMPLES - 1)]
        rows = np.arange(len(tops))
        best, value = x[tops], y[tops]
        for _ in range(ROUNDS):
            fine = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, FINER)
            found = np.nan_to_num(of(fine), nan=-np.inf)
            at = np.argmax(found, axis=1)
            better = found[rows, at] > value
            best = np.where(better, fine[rows, at], best)
            value = np.maximum(value, found[rows, at])
            low, high = fine[rows, np.maximum(at - 1, 0)], fine[rows, np.minimum(at + 1, FINER - 1)]
    k = int(np.argmax(value))
    return float(best[k]), float(value[k])


def nearest_to_origin(normals: Reals, bounds: Reals) -> Reals | None:
    """Return the point nearest to the origin with ``normals @ z <= bounds``, or None.

    The few binding ones are found one by one, the most violated first: a law of a hundred parts has
    thousands of them, and millions of corners.

    Parameters
    ----------
    normals : array of float, shape (n, 2)
    bounds : array of float, shape (n,)
    """
    length = np.hypot(*normals.T)
    unit, off = normals / length[:, None], bounds / length
    slack = 1e-12 * np.max(np.abs(off))
    point: Reals | None = np.zeros(2)
    binding: list[int] = []
    while point is not None:
        broken = unit @ point - off
        k = int(np.argmax(broken))
        if broken[k] <= slack:
            return point
        binding.append(k)
        point = _nearest_corner(unit[binding], off[binding], slack)
    return None


def _nearest_corner(unit: Reals, off: Reals, tolerance: float) -> Reals | None:
    """Return the nearest foot or corner of a few lines that keeps to all of them, or None."""
    i, j = np.triu_indices(len(unit), 1)
    det = unit[i, 0] * unit[j, 1] - unit[i, 1] * unit[j, 0]
    with np.errstate(all="ignore"):
        corners = np.array(
            [
                (off[i] * unit[j, 1] - off[j] * unit[i, 1]) / det,
                (unit[i, 0] * off[j] - unit[j, 0] * off[i]) / det,
            ]
        ).T
    tried = np.concatenate([unit * off[:, None], corners])
    tried = tried[np.all(np.isfinite(tried), axis=1)]
    kept = tried[np.all(tried @ unit.T <= off + tolerance, axis=1)]
    return np.asarray(kept[np.argmin(np.hypot(*kept.T))]) if len(kept) else None


def first_nonpositive(
    rough: Callable[[float], float], exact: Callable[[float], float], candidates: Reals
) -> float | None:
    """Return the first number at which a function is not positive; None if it is positive.

    Parameters
    ----------
    rough, exact : callable
        The function from below, and as it is: where the rough one is positive, so is the other.
    candidates : array of float
        Numbers in order, the steps of the search.
    """
    for k, x in enumerate(candidates):
        if rough(float(x)) > 0 or exact(float(x)) > 0:
            continue
        if not k:
            return float(x)
        low, high = float(candidates[k - 1]), float(x)
        above, below = exact(low), exact(high)
        for _ in range(100):  # regula falsi; an end that stays weighs half
            middle = high - below * (high - low) / (below - above)
            if not low < middle < high:
                break
            value = exact(middle)
            if value <= 0:
                high, below, above = middle, value, above / 2
            else:
                low, above, below = middle, value, below / 2
        return high
    return None


def minimize(
    of: Callable[[float], float], start: float, end: float, *, samples: int = 121
) -> float:
    """Return the minimizer of a function of one number, by finer and finer grids."""
    for _ in range(14):
        x = np.linspace(start, end, samples)
        k = int(np.argmin([of(float(one)) for one in x]))
        start, end, samples = x[max(k - 1, 0)], x[min(k + 1, samples - 1)], 9
    return float((start + end) / 2)
