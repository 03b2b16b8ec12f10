"""A moving point as its file states it."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from planmethod.moving.formula import Formula
from planmethod.problem.head import KindProblem
from planmethod.problem.model import Scales
from planmethod.record import dataclass


class Law(Enum):
    """How the motion of a point is stated (способ задания движения)."""

    COORDINATES = "coordinates"
    POLAR = "polar"
    NATURAL = "natural"
    ROLLING = "rolling"


FORMULAS: Mapping[Law, tuple[str, ...]] = {
    Law.COORDINATES: ("x", "y"),
    Law.POLAR: ("r", "phi"),
    Law.NATURAL: ("s",),
    Law.ROLLING: ("phi",),
}
"""Keys of the formulas that state a motion."""


@dataclass(frozen=True, slots=True)
class Wheel:
    """Wheel that rolls without slipping and carries the point (катящееся колесо).

    Attributes
    ----------
    radius : float, m
    r : float, m
        Distance of the point from the centre.
    angle : float, degrees
        From the x axis to the point, seen from the centre, where phi is 0.
    track : float, m
        Radius of the fixed circle about the origin that it rolls on from outside; negative: within;
        0: it rolls on the x axis. Where phi is 0 the wheel stands above the origin, within a circle
        below it.
    arm : float, m
        Of the carrier that turns about the origin and has the wheel's centre at its end, of a
        satellite that a train turns in a way of its own (law ``theta``); 0: the wheel rolls.
    """

    radius: float
    r: float
    angle: float
    track: float
    arm: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class PointProblem(KindProblem):
    """A moving point (движущаяся точка).

    Attributes
    ----------
    law : Law
    formulas : mapping of str to Formula
        By the keys of `FORMULAS`; metres, radians, seconds.
    radius : float or None, m
        Of the circle along which a natural motion runs, counter-clockwise from (radius, 0) about
        the origin; None along the x axis.
    wheel : Wheel or None
        What carries the point; phi is then how far it has turned, counter-clockwise.
    times : tuple of float, s
    blur : tuple of float
        Relative errors of the times in float64; 0 where that has them as the file says.
    show : (float, float) or None, s
        The interval that is drawn.
    """

    law: Law
    formulas: Mapping[str, Formula]
    radius: float | None
    wheel: Wheel | None
    times: tuple[float, ...]
    blur: tuple[float, ...]
    show: tuple[float, float] | None
    scales: Scales
