"""A moving point as its file states it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from planmethod.moving.formula import Formula
from planmethod.problem.model import Published, SheetSettings


class Law(Enum):
    """How the motion of a point is stated (способ задания движения)."""

    COORDINATES = "coordinates"
    POLAR = "polar"
    NATURAL = "natural"


FORMULAS: Mapping[Law, tuple[str, ...]] = {
    Law.COORDINATES: ("x", "y"),
    Law.POLAR: ("r", "phi"),
    Law.NATURAL: ("s",),
}
"""Keys of the formulas that state a motion."""


@dataclass(frozen=True, slots=True)
class PointProblem:
    """A moving point (движущаяся точка).

    Attributes
    ----------
    law : Law
    formulas : mapping of str to Formula
        By the keys of `FORMULAS`; metres, radians, seconds.
    radius : float or None, m
        Of the circle along which a natural motion runs, counter-clockwise from (radius, 0) about
        the origin; None along the x axis.
    times : tuple of float, s
    blur : tuple of float
        Relative errors of the times in float64; 0 where that has them as the file says.
    """

    name: str
    title: str
    source: str
    law: Law
    formulas: Mapping[str, Formula]
    radius: float | None
    times: tuple[float, ...]
    blur: tuple[float, ...]
    stamp: Mapping[str, str]
    sheet: SheetSettings
    published: tuple[Published, ...]
    variants: tuple[str, ...] = ()
    variant: str | None = None
