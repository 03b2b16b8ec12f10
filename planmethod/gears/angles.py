"""Involutes of angles, and the angle at which shifted wheels mesh (инволюта, угол зацепления)."""

from __future__ import annotations

from math import pi

import numpy as np
import numpy.typing as npt

Reals = npt.NDArray[np.float64]

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
        z₁ + z₂; of an internal pair z₂ − z₁.
    shifts : float
        x₁ + x₂; of an internal pair x₂ − x₁. NaN comes out where no pair is so close.
    alpha : float, rad
        Angle of the rack.
    """
    working = angle_of_involute(involute(alpha) + 2 * shifts * np.tan(alpha) / teeth)
    return float(np.cos(alpha) / np.cos(working))
