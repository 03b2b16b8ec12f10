"""Sizes of the symbols, and helpers for their directions."""

from __future__ import annotations

import cmath
from math import degrees

from msgspec import Struct


class SymbolSizes(Struct, frozen=True):
    """Sizes of the symbols, mm, before ``factor``."""

    joint: float = 3.0  # diameter of a revolute pair
    centre: float = 1.2  # radius of a centre of mass
    ring: float = 1.3  # from the joint to the ring of a joint of three links
    support_height: float = 9.0  # from the pivot to its base line
    support_width: float = 9.0  # between the feet of the support
    base: float = 14.0  # length of the base line
    hatch_step: float = 2.2
    hatch_stroke: float = 3.0
    slider_length: float = 14.0
    slider_width: float = 8.0
    corner: float = 5.0  # leg of the mark of a rigid joint
    teeth: float = 6.0  # cross-bar of a wheel seen from the side
    mesh: float = 2.0  # between the cross-bars of two wheels in mesh
    bearing: float = 7.0  # length of a plate of a shaft's bearing
    shaft: float = 3.2  # between the two plates of a bearing


SIZES = SymbolSizes()


def unit(direction: complex) -> complex:
    """Return the direction with length 1; +x for a vector too short to have one."""
    length = abs(direction)
    return direction / length if length > 1e-12 else 1 + 0j


def angle_of(direction: complex) -> float:
    """Return the angle of a direction, degrees from +x, counter-clockwise (-180..180]."""
    return degrees(cmath.phase(direction))
