"""Boxes of the pictures of a page (поля картин)."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

BOX = (105.0, 80.0)
"""Size of a view's picture, mm: on a telephone its letters of 5 mm are legible."""

MIN_WIDTH = 0.6 * BOX[0]
"""Least width of a view for its picture, mm, so that letters are not too large."""

SHAPE = 1.3
"""Ratio of width to height of all views, so that they form rows."""


def box_around(places: npt.NDArray[Any], margin: float) -> tuple[float, float, float, float]:
    """Return left, top (y down), width and height of a box around places, mm."""
    if not places.size:
        places = np.zeros(1, complex)
    low = complex(places.real.min(), places.imag.min())
    high = complex(places.real.max(), places.imag.max())
    middle, size = (low + high) / 2, high - low
    width = 2 * margin + max(size.real, SHAPE * (size.imag + 2 * margin) - 2 * margin, MIN_WIDTH)
    height = width / SHAPE
    return middle.real - width / 2, -middle.imag - height / 2, width, height


def scale_of(places: npt.NDArray[Any]) -> float:
    """Return the value of a millimetre at which places fill a picture; 1 if all are one."""
    if not places.size:
        return 1.0
    wide, high = np.ptp(places.real), np.ptp(places.imag)
    return float(max(wide / BOX[0], high / BOX[1])) or 1.0
