"""Single resultant of the inertia forces of a link (равнодействующая сил инерции).

Φ at the centre of mass and the couple M_Φ are together the force Φ alone on a line shifted by
h = M_Φ/Φ, to the side where it turns as M_Φ does. That is drawn where there is a force in every
position, and where its line stays on the paper.
"""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum

import numpy as np
from msgspec import Struct

from planmethod.plans.forces.loads import Applied, LoadKind
from planmethod.problem.model import Problem
from planmethod.solved.solution import Solution

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
