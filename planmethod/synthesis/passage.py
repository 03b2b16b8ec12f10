"""How a four-bar goes through three positions (проход): branch, order, transmission angle."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from planmethod.record import dataclass

Reals = npt.NDArray[np.float64]

_PLACES = 721
"""Places of the driver on the way that are looked at."""


@dataclass(frozen=True, slots=True)
class Passage:
    """What a four-bar makes of three positions (проход через положения).

    Attributes
    ----------
    swapped : bool
        The second of the links on the frame drives.
    positions : tuple of float, degrees
        Of the driver, one after another in one sense where ``order`` holds.
    side : int
        +1: the joint of coupler and output is to the left of the line from the driver's end to the
        output's pivot, in the first position.
    branch : bool
        It goes through all three without being taken apart.
    order : bool
        It goes through them one after another: 1, 2, 3.
    transmission : float, degrees
        Least angle between coupler and output on the way; NaN where the way is interrupted.
    """

    swapped: bool
    positions: tuple[float, ...]
    side: int
    branch: bool
    order: bool
    transmission: float


def passage(a: complex, d: complex, b: Sequence[complex], c: Sequence[complex]) -> Passage:
    """Return how the four-bar A B C D goes, driven by the link that does it better.

    Parameters
    ----------
    a, d : complex, m
        Pivots.
    b, c : sequence of complex, m
        The ends of the links on the frame in the three positions.
    """
    tried = (_driven(a, d, b, c, swapped=False), _driven(d, a, c, b, swapped=True))
    return max(
        tried,
        key=lambda way: (way.branch, way.order, np.nan_to_num(way.transmission), not way.swapped),
    )


def _driven(
    a: complex, d: complex, b: Sequence[complex], c: Sequence[complex], *, swapped: bool
) -> Passage:
    turns = [float(np.degrees(np.angle(p - a))) for p in b]
    sides = [1 if (np.conj(d - p) * (q - p)).imag > 0 else -1 for p, q in zip(b, c, strict=True)]
    found = []
    for way in (1.0, -1.0):
        steps = [(after - turns[0]) * way % 360.0 for after in turns]
        order = steps[1] < steps[2]
        reach = max(steps)
        worst = _least(a, d, b, c, turns[0], way * reach, sides[0])
        one_side = len(set(sides)) == 1 and bool(np.isfinite(worst))
        positions = tuple(turns[0] + way * step for step in steps)
        found.append(Passage(swapped, positions, sides[0], one_side, order, worst))
    return max(found, key=lambda p: (p.branch, p.order, np.nan_to_num(p.transmission)))


def _least(a: complex, d: complex, b: Sequence[complex], c: Sequence[complex],
           start: float, turn: float, side: int) -> float:  # fmt: skip
    """Return the least transmission angle on the way; NaN where the arcs do not meet."""
    angles = np.radians(start + turn * np.linspace(0.0, 1.0, _PLACES))
    ends = a + abs(b[0] - a) * np.exp(1j * angles)
    coupler, output = abs(c[0] - b[0]), abs(c[0] - d)
    cosine = (coupler**2 + output**2 - np.abs(d - ends) ** 2) / (2.0 * coupler * output)
    cosine = np.where(np.abs(np.abs(cosine) - 1.0) < 1e-12, np.sign(cosine), cosine)
    with np.errstate(invalid="ignore"):
        between = np.degrees(np.arccos(cosine))
    return float(np.min(np.minimum(between, 180.0 - between)))
