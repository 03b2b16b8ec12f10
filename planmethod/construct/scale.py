"""Scales of plans: the value of one millimetre, and the choice of a scale."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from functools import cache

from msgspec import Struct

SERIES: tuple[float, ...] = (1.0, 2.0, 2.5, 4.0, 5.0)
"""Mantissas of GOST 2.302, in which training drawings take their scales."""


class Scale(Struct, frozen=True):
    """Value that one millimetre of a plan represents (масштабный коэффициент).

    Attributes
    ----------
    symbol : str
        ``mu_l``, ``mu_v``, ``mu_a``.
    per_mm : float
        Units per millimetre.
    unit : str
        ``m``, ``m/s``, ``m/s²``.
    """

    symbol: str
    per_mm: float
    unit: str


def series_near(value: float, *, up: bool, series: Sequence[float] = SERIES) -> float:
    """Return the member of the series times a power of ten next to ``value``.

    Parameters
    ----------
    value : float
        Positive.
    up : bool
        The smallest member not below ``value`` when true, else the largest not above it.
    """
    members, slack = _members(math.floor(math.log10(value)), tuple(series)), 1e-9 * value
    if up:
        return members[bisect_left(members, value - slack)]
    return members[bisect_right(members, value + slack) - 1]


def next_scale(per_mm: float, *, finer: bool, mm_per_unit: bool = False) -> float:
    """Return the next scale of the series, units per millimetre.

    Parameters
    ----------
    per_mm : float
    finer : bool
        The one at which everything is drawn larger, else smaller.
    mm_per_unit : bool
        Round numbers are those in mm per unit.
    """
    if mm_per_unit:
        return 1.0 / series_near(1.01 ** (1 if finer else -1) / per_mm, up=finer)
    return series_near(per_mm * 1.01 ** (-1 if finer else 1), up=not finer)


@cache
def _members(power: int, series: tuple[float, ...]) -> list[float]:
    """Return a series times a power of ten, the one below and the one above."""
    return [float(f"{m}e{p}") for p in (power - 1, power, power + 1) for m in series]


def choose_scale(
    extent: tuple[float, float], box: tuple[float, float], *, mm_per_unit: bool = False
) -> float:
    """Return units per millimetre so that an extent fills a box as far as the series lets it.

    Parameters
    ----------
    extent : (float, float)
        Width and height of the drawing, in its unit.
    box : (float, float), mm
    mm_per_unit : bool
        Take the round number in mm per unit instead of unit per mm.

    Notes
    -----
    Nothing to draw (zero extent) gives 1.
    """
    needed = max(extent[0] / box[0], extent[1] / box[1])
    if not (math.isfinite(needed) and needed > 0):
        return 1.0
    if mm_per_unit:
        return 1.0 / series_near(1.0 / needed, up=False)
    return series_near(needed, up=True)


def rounded(value: float) -> float:
    """Return a scale without the last bits, so that a round one is round.

    Examples
    --------
    >>> rounded(0.1 + 0.2)
    0.3
    """
    return float(f"{value:.12g}")


MIN_AXIS = 160.0
"""Least length of the axis of angles of a diagram, mm."""


def angle_scale(angle_range: float, *, mm_per_unit: bool = False) -> float:
    """Return the scale of an axis of angles, degrees per millimetre (масштаб углов).

    It is the scale of the series at which the axis has at least the minimum length and less than
    twice that.

    Examples
    --------
    >>> angle_scale(360.0), angle_scale(720.0), angle_scale(90.0)
    (2.0, 4.0, 0.5)
    """
    if mm_per_unit:
        return 1.0 / series_near(MIN_AXIS / angle_range, up=True)
    return series_near(angle_range / MIN_AXIS, up=False)
