"""Given and inertia forces on the links in every position, and their single resultants."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from enum import Enum
from typing import assert_never

import numpy as np
from msgspec import Struct

from planmethod.construct.arithmetic import Number
from planmethod.plans.forces.polygons import Applied, LoadKind
from planmethod.problem.model import Problem
from planmethod.problem.records import Couple, Dynamics, Load, Mass
from planmethod.solved.forces.laws import GivenLoads, MotionValues, is_at_rest, is_zero
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution


def applied(solution: MotionValues) -> tuple[Applied, ...]:
    """Return the loads on the links, without the reactions, link by link.

    A link has its weight, the main vector of its inertia forces Φ = -m·a_S (главный вектор сил
    инерции), their main moment M_Φ = -J·ε (главный момент), then its external loads in file order.
    Loads that are zero by nature are left out: inertia of what cannot accelerate, loads of size
    zero.

    Raises
    ------
    ProblemError
        A load is known only in the file's positions, and others are requested.
    """
    dynamics = solution.problem.dynamics
    if dynamics is None:
        return ()
    found: list[Applied] = []
    for link in solution.problem.mechanism.links:
        mass = dynamics.masses.get(link)
        if mass is not None:
            found += _of_mass(solution, dynamics.gravity, link, mass)
        found += external(solution, dynamics, link)
    return tuple(found)


def changing(solution: MotionValues) -> dict[str, Applied]:
    """Return the external loads that differ from position to position, by name.

    Raises
    ------
    ProblemError
        As of `applied`.
    """
    dynamics = solution.problem.dynamics
    assert dynamics is not None, "changing loads need [dynamics]"
    links = solution.problem.mechanism.links
    found = (one for link in links for one in external(solution, dynamics, link))
    return {one.name: one for one in found if one.steady is None}


def _force(
    solution: MotionValues, name: str, link: str, point: str, force: Number, kind: LoadKind
) -> Applied:
    shape = solution.positions.shape
    whole = np.array(np.broadcast_to(force, shape), dtype=complex)
    return Applied(name, link, point, whole, np.zeros(shape), kind, _steady(force))


def _couple(
    solution: MotionValues, name: str, link: str, couple: Number, kind: LoadKind
) -> Applied:
    shape = solution.positions.shape
    whole = np.array(np.broadcast_to(couple, shape), dtype=float)
    return Applied(name, link, None, np.zeros(shape, dtype=complex), whole, kind, _steady(couple))


def _steady(value: Number) -> complex | None:
    return complex(value) if np.ndim(value) == 0 else None


# Weight and inertia ------------------------------------------------------------------------------


def _of_mass(solution: MotionValues, gravity: float, link: str, mass: Mass) -> Iterator[Applied]:
    centre = mass.centre
    if mass.mass and gravity and centre is not None:
        weight = complex(0.0, -mass.mass * gravity)
        yield _force(solution, f"G_{{{link}}}", link, centre, weight, LoadKind.WEIGHT)
    if mass.mass and centre is not None and _may_accelerate(solution, link, centre):
        inertia = -mass.mass * solution.points[centre].acceleration
        yield _force(solution, f"Φ_{{{link}}}", link, centre, inertia, LoadKind.INERTIA)
    if mass.inertia and _may_turn_unevenly(solution, link):
        couple = -mass.inertia * solution.links[link].epsilon
        yield _couple(solution, f"M_{{Φ{link}}}", link, couple, LoadKind.INERTIA_COUPLE)


def _may_accelerate(solution: MotionValues, link: str, point: str) -> bool:
    drive, plan = solution.problem.drive, solution.construction.kinematics.acceleration
    even = link == drive.link and not drive.is_crank and not drive.accelerates
    return not even and not is_at_rest(solution) and plan.point[link, point] != plan.pole


def _may_turn_unevenly(solution: MotionValues, link: str) -> bool:
    return not is_at_rest(solution) and link in solution.construction.kinematics.epsilon


# External loads ----------------------------------------------------------------------------------


def external(solution: MotionValues, dynamics: Dynamics, link: str) -> Iterator[Applied]:
    """Yield the external loads of a link, in file order; none that is zero by nature."""
    given = GivenLoads(solution)
    for load in dynamics.loads:
        if load.link != link or is_zero(solution, load):
            continue
        match load:
            case Load():
                force = given.value(load)
                yield _force(solution, load.name, link, load.at, force, LoadKind.EXTERNAL)
            case Couple():
                yield _couple(solution, load.name, link, given.value(load), LoadKind.EXTERNAL)
            case _:
                assert_never(load)


def power(motion: MotionValues, one: Applied) -> Reals:
    """Return the power of a load, W, ndarray of shape (n,)."""
    if one.point is None:
        return one.couple * motion.links[one.link].omega
    velocity = motion.points[one.point].velocity
    return np.asarray((one.force * velocity.conjugate()).real, dtype=float)


# The single resultant of inertia -----------------------------------------------------------------

FAINT = 0.02
"""Fraction of the largest acceleration below which a length is too short to divide by."""

_ZERO_SHIFT_FRACTION = 1e-9
"""Share of the longest shift below which a shift is rounding: the link turns evenly."""


class Hindrance(Enum):
    """Reason why a link keeps the force and the couple."""

    NO_FORCE = "no force"  # no mass, or the centre of mass is fixed
    FAINT = "faint"  # in some position its acceleration is too small on the plan
    TOO_LONG = "far"


class UnshiftedInertia(Struct, frozen=True):
    """Link whose inertia stays a force and a couple, or a couple alone.

    ``moment`` is the couple; ``reach`` is the longest shift M_Φ/Φ of all positions, m; zero where
    there is no force.
    """

    moment: Applied
    hindrance: Hindrance
    reach: float = 0.0

    @property
    def link(self) -> str:
        """The link that the couple acts on."""
        return self.moment.link


def shifted_inertia(
    solution: Solution, loads: Iterable[Applied]
) -> tuple[dict[str, Applied], tuple[UnshiftedInertia, ...]]:
    """Return the links whose inertia force is shifted, the same in all positions.

    Returns
    -------
    dict of str to Applied
        The couples that vanish, by link.
    tuple of UnshiftedInertia
        The other links that have such a couple.
    """
    found = list(loads)
    forces = {one.link: one for one in found if one.kind is LoadKind.INERTIA}
    shifted: dict[str, Applied] = {}
    kept: list[UnshiftedInertia] = []
    for one in found:
        if one.kind is not LoadKind.INERTIA_COUPLE:
            continue
        if one.link not in forces:
            kept.append(UnshiftedInertia(one, Hindrance.NO_FORCE))
            continue
        reach = _reach(forces[one.link], one)
        why = _hindrance(solution, forces[one.link], reach)
        if why is not None:
            kept.append(UnshiftedInertia(one, why, reach))
        elif reach > _ZERO_SHIFT_FRACTION * farthest(solution.problem):
            shifted[one.link] = one
    return shifted, tuple(kept)


def _reach(force: Applied, couple: Applied) -> float:
    """Return the longest shift, m; infinite where there is a couple and no force."""
    size, moment = np.abs(force.force), np.abs(couple.couple)
    with np.errstate(divide="ignore", invalid="ignore"):
        return float(np.max(np.where(moment == 0, 0.0, moment / size), initial=0.0))


def _hindrance(solution: Solution, force: Applied, reach: float) -> Hindrance | None:
    assert force.point is not None
    accelerations = np.abs(solution.points[force.point].acceleration)
    largest = np.max([np.abs(point.acceleration) for point in solution.points.values()], axis=0)
    unread = solution.ruler_arithmetic.ruled(accelerations / solution.per_mm["mu_a"]) == 0
    if np.any((accelerations <= FAINT * largest) | unread):
        return Hindrance.FAINT
    return Hindrance.TOO_LONG if reach > farthest(solution.problem) else None


def farthest(problem: Problem) -> float:
    """Return the longest shift that is drawn, m: farther the line would leave the drawing.

    It is the largest distance of two points of a link or of the frame.
    """
    spans = [
        abs(one - other)
        for body in problem.bodies.values()
        for one in body.points.values()
        for other in body.points.values()
    ]
    return max(spans, default=0.0)
