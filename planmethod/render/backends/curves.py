"""Circles as cubic curves, for formats that have no arcs of their own."""

from __future__ import annotations

from cmath import exp
from itertools import pairwise
from math import ceil, tan, tau
from typing import TypeAlias

Curve: TypeAlias = tuple[complex, complex, complex, complex]
"""Start, two control points, end."""


def arc_curves(
    centre: complex,
    radius: float,
    start: float = 0.0,
    turn: float = tau,
    *,
    tolerance: float = 1e-3,
) -> list[Curve]:
    """Return cubic curves along an arc, at most ``tolerance`` mm from it.

    Parameters
    ----------
    centre, radius
        The circle, mm.
    start, turn
        Where the arc starts and how far it goes counter-clockwise, radians.
    tolerance
        Largest distance allowed, mm. The curve of a quarter circle leaves the circle by 2.7e-4 of
        the radius; this falls with the sixth power of the angle.
    """
    finer = max(1.0, (2.8e-4 * radius / tolerance) ** (1.0 / 6.0))
    count = max(1, ceil(turn / (tau / 4.0) * finer - 1e-9))
    step = turn / count
    pull = 4.0 / 3.0 * tan(step / 4.0) * 1j
    ends = [radius * exp(1j * (start + k * step)) for k in range(count + 1)]
    return [
        (centre + a, centre + a + pull * a, centre + b - pull * b, centre + b)
        for a, b in pairwise(ends)
    ]
