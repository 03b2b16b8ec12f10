"""Loads on the links as the force plans take them, and the shifted force of inertia (нагрузки)."""

from __future__ import annotations

from enum import Enum

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.construct.arithmetic import Number
from planmethod.construct.steps import NumberName, PointName
from planmethod.problem.model import Problem

DOWN = -90.0
"""Direction of the weights, degrees."""

Complexes = npt.NDArray[np.complex128]
Reals = npt.NDArray[np.float64]


class LoadKind(Enum):
    """Kind of a load (вид нагрузки)."""

    WEIGHT = "weight"
    INERTIA = "inertia"
    INERTIA_COUPLE = "inertia couple"
    EXTERNAL = "external"
    FRICTION = "friction"


class Applied(Struct, frozen=True):
    """One force or couple on a link in every position (приложенная нагрузка).

    Attributes
    ----------
    name : str
        Letter in rich text: ``G_{2}``, ``Φ_{2}``, ``M_{Φ2}``, or that of the external load.
    link : str
    point : str or None
        Name of the point where the force acts; None for a couple.
    force : ndarray of shape (n,), N
        Complex; zero for a couple.
    couple : ndarray of shape (n,), N·m
        Counter-clockwise positive; zero for a force.
    kind : LoadKind
    steady : complex or None
        The force or couple where it is the same in every position.
    numbers : tuple of ndarray of shape (n,), optional
        Its known numbers in every position, for loads of many variants.
    """

    name: str
    link: str
    point: str | None
    force: Complexes
    couple: Reals
    kind: LoadKind
    steady: complex | None = None
    numbers: tuple[Reals, ...] | None = None


def numbers_of(one: Applied) -> tuple[Number, ...]:
    """Return the known numbers of a load: its couple, N·m, or its direction, degrees, and size, N.

    Numbers of a load that is the same in every position, else arrays of shape (n,).
    """
    if one.numbers is not None:
        return one.numbers
    if one.point is None:
        return (one.couple if one.steady is None else one.steady.real,)
    force = one.force if one.steady is None else one.steady
    turned = DOWN if one.kind is LoadKind.WEIGHT else np.degrees(np.angle(force))
    return turned, np.abs(force)


class Shift(Struct, frozen=True):
    """Inertia force moved off the centre of mass (смещённая сила инерции).

    Attributes
    ----------
    letter : str
        Of the point T where the force acts, in rich text: ``T_{2}``; not the name of any point.
    moment : Applied
        The couple M_Φ that the force includes.
    couple : NumberName
        Its size, N·m.
    centre, at : PointName
        Centre of mass and T on the position plan.
    length : NumberName
        h, mm of the position plan: positive to the left of the acceleration.
    """

    letter: str
    moment: Applied
    couple: NumberName
    centre: PointName
    at: PointName
    length: NumberName

    @property
    def link(self) -> str:
        """The link that the force acts on."""
        return self.moment.link


def free_letter(letter: str, link: str, problem: Problem) -> str:
    """Return the letter of a point of a link, ``T_{2}``; primed where a point has that name."""
    taken = {point for body in problem.bodies.values() for point in body.points}
    index = link
    while f"{letter}{index}" in taken:
        index += "'"
    return f"{letter}_{{{index}}}"
