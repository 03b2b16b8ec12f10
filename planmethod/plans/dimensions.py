"""Given numbers of a construction: their kinds and letters (размеры)."""

from __future__ import annotations

from enum import Enum

from msgspec import Struct


class DimensionKind(Enum):
    """Kind of a given number (вид размера); the value is the beginning of its name."""

    LENGTH = "l_"  # distance of two points
    ALONG = "x_"  # from a point along a line
    ACROSS = "y_"  # and across it
    OFFSET = "e_"  # of a point from a guide
    ANGLE = "angle_"  # of a link or of a guide, degrees
    TRAVEL = "s"  # of the driving slider


class Dimension(Struct, frozen=True):
    """Given number of a construction, in metres or in millimetres of the drawing (размер).

    Attributes
    ----------
    kind : DimensionKind
    of : tuple of str
        Points that it places or lies between; the link or guide that an angle turns.
    letters : str
        What its length on the drawing is called.
    """

    kind: DimensionKind
    of: tuple[str, ...]
    letters: str
