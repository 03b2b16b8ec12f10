"""How many inscriptions stand in one part of a picture (плотность надписей)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

SIDE = 50.0
"""Side of the square in which inscriptions are counted, mm: what one looks at at once."""

CROWD = 14
"""Most inscriptions of a scheme in such a square: each has a finger's breadth, 13 mm, of it."""


def densest(places: Sequence[complex]) -> tuple[int, complex]:
    """Return the most places in one square of `SIDE`, and the middle of that square, mm.

    The square is looked for with a place in its middle, so that the count is one of a place and
    those about it.
    """
    if not places:
        return 0, 0j
    at = np.asarray(places, dtype=complex)
    apart = at[:, None] - at[None, :]
    near = (np.abs(apart.real) <= SIDE / 2) & (np.abs(apart.imag) <= SIDE / 2)
    counts = near.sum(axis=1)
    k = int(np.argmax(counts))
    return int(counts[k]), complex(at[k])
