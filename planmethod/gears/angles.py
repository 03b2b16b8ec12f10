"""Involutes of angles, and the angle at which shifted wheels mesh (инволюта, угол зацепления)."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Reals = npt.NDArray[np.float64]
Both: TypeAlias = tuple[Reals | float, Reals | float]
"""A value for each of two wheels."""

_ROUNDS = 40


def involute(angle: Reals | float) -> Reals:
    """Return inv α = tan α − α (инволюта угла)."""
    return np.asarray(np.tan(angle) - angle)


def angle_of_involute(value: Reals | float) -> Reals:
    """Return the angle of an involute function by Newton's method, rad; NaN of a negative value.

    From above the iteration comes down to the root of the convex function without passing it.
    """
    value = np.where(np.asarray(value) >= 0, value, np.nan)
    angle = np.minimum(np.cbrt(3 * value), np.arctan(value + pi / 2))
    for _ in range(_ROUNDS):
        steep = np.tan(angle) ** 2
        step = np.where(steep > 0, (involute(angle) - value) / np.where(steep > 0, steep, 1.0), 0.0)
        angle = angle - step
        if not np.any(np.abs(step) > 1e-16):
            break
    return np.asarray(angle)


def spread(teeth: int | float, shifts: float, alpha: float) -> float:
    """Return a_w/a = cos α/cos α_w of wheels cut with shifts, without backlash (GOST 16532).

    Parameters
    ----------
    teeth : float
        z₁ + z₂; z₂ − z₁ for an internal pair.
    shifts : float
        x₁ + x₂; x₂ − x₁ for an internal pair. The result is NaN where no pair can be that close.
    alpha : float, rad
        Angle of the rack.
    """
    working = angle_of_involute(involute(alpha) + 2 * shifts * np.tan(alpha) / teeth)
    return float(np.cos(alpha) / np.cos(working))


def tips_apart(z: Both, tip: Both, lag: Both, a_w: Reals | float, inv_w: Reals | float) -> Reals:
    """Return the angle that is left between the tips of an internal pair outside the mesh, rad.

    z₁(inv α_a1 + δ₁) − z₂(inv α_a2 + δ₂) + (z₂ − z₁) inv α_w over z₁, as a turn of wheel 1, δ
    being the angles at the centres to where the tip circles cross; not negative where the tips
    do not meet.

    Parameters
    ----------
    z, tip, lag : pair of arrays
        Teeth, tip radii and involutes of the profile angles at the tips, of wheel and ring; all
        positive, radii in one unit with ``a_w``.
    """
    (one, two), (z_1, z_2) = tip, z

    def angle(cosine: Reals | float) -> Reals:
        return np.asarray(np.arccos(np.clip(cosine, -1.0, 1.0)))

    delta = angle((two**2 - one**2 - a_w**2) / (2 * one * a_w))
    other = angle((a_w**2 + two**2 - one**2) / (2 * two * a_w))
    own, ring = z_1 * (lag[0] + delta), z_2 * (lag[1] + other)
    return np.asarray((own - ring + (z_2 - z_1) * inv_w) / z_1)


def ring_margins(
    teeth: Sequence[float], shifts: Sequence[float], alpha: float
) -> tuple[float, float]:
    """Return the clearance of the tips of a ring from interference with a wheel in it.

    Parameters
    ----------
    teeth, shifts : of the wheel and of the ring
        Teeth of full height, with the tips of GOST 19274.
    alpha : float, rad
        Angle of the rack.

    Returns
    -------
    reach : float, modules
        √(r_a² − r_b²) − a_w·sin α_w of the ring: how far short of the point where the line of
        action touches the base circle of the wheel its tips come to rest; negative beyond it.
    tips : float, rad
        As `tips_apart`. Both are -inf where there is no such pair.
    """
    (z_1, z_2), (x_1, x_2) = teeth, shifts
    apart = (z_2 - z_1) / 2 * spread(z_2 - z_1, x_2 - x_1, alpha)
    short = x_2 - x_1 - (apart - (z_2 - z_1) / 2)
    wheel, ring = z_1 / 2 + 1 + x_1 + short, z_2 / 2 - 1 + x_2 - short
    base = (z_1 / 2 * np.cos(alpha), z_2 / 2 * np.cos(alpha))
    if not (wheel >= base[0] and ring >= base[1]):
        return -np.inf, -np.inf
    working = float(np.arccos((base[1] - base[0]) / apart))
    lag = (involute(np.arccos(base[0] / wheel)), involute(np.arccos(base[1] / ring)))
    tips = tips_apart((z_1, z_2), (wheel, ring), lag, apart, involute(working))
    return float(np.sqrt(ring**2 - base[1] ** 2) - apart * np.sin(working)), float(tips)
