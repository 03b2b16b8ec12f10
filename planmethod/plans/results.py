"""What a solved problem is asked for, and the steps that give it (искомые величины)."""

from __future__ import annotations

import copy
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from enum import Enum
from typing import Any

import numpy as np

from planmethod.construct.program import Program
from planmethod.construct.steps import Name, PointName
from planmethod.errors import PlanMethodError
from planmethod.plans.build import Construction
from planmethod.plans.draft import Draft


class ResultKind(Enum):
    """Kind of a result (вид величины)."""

    PLACE = "place"
    VELOCITY = "velocity"
    ACCELERATION = "acceleration"
    DIRECTION = "direction"
    UNIT = "unit"  # the direction as a unit vector
    OMEGA = "omega"
    EPSILON = "epsilon"
    SLIDING = "sliding"  # signed, along the slide line


UNIT = {
    ResultKind.PLACE: "m",
    ResultKind.VELOCITY: "m/s",
    ResultKind.ACCELERATION: "m/s²",
    ResultKind.DIRECTION: "deg",
    ResultKind.UNIT: "1",
    ResultKind.OMEGA: "1/s",
    ResultKind.EPSILON: "1/s²",
    ResultKind.SLIDING: "m/s",
}


@dataclass(frozen=True, slots=True)
class Result:
    """One quantity of a solved problem and the step that makes it (искомая величина).

    Attributes
    ----------
    label : str
        ``B`` (a place), ``v_B``, ``a_B``, ``phi_2``, ``omega_2``, ``epsilon_2``, ``v_B3/2``; and
        ``u_2``, the direction ``phi_2`` as a unit vector.
    kind : ResultKind
    name : Name
        A point, a number, or for a direction the line of the link's own axis.
    of : str
        Point or link.
    """

    label: str
    kind: ResultKind
    name: Name
    of: str


class UnknownResultError(PlanMethodError, ValueError):
    """A quantity is asked for that the problem does not have."""


@dataclass(frozen=True, slots=True)
class Results:
    """All results of a construction, and the program that makes them.

    Attributes
    ----------
    program : Program
        The construction's, and the own axes of links that it has no line for.
    numbers : dict
        Known numbers of the program.
    all : tuple of Result
        Points in the order of the plans: place, velocity, acceleration; then links.
    """

    program: Program
    numbers: dict[str, float]
    all: tuple[Result, ...]

    def choose(self, labels: Iterable[str] | None) -> tuple[Result, ...]:
        """Return the results of some labels, in the order asked; for None all but unit vectors.

        ``positions``, ``velocities``, ``accelerations`` and ``units`` stand for what they say.

        Raises
        ------
        UnknownResultError
        """
        if labels is None:
            return tuple(result for result in self.all if result.kind is not ResultKind.UNIT)
        chosen: dict[str, Result] = {}
        for label in labels:
            chosen.update((result.label, result) for result in self._named(label))
        return tuple(chosen.values())

    def _named(self, label: str) -> Sequence[Result]:
        if label in WHOLE:
            return [result for result in self.all if result.kind in WHOLE[label]]
        found = [result for result in self.all if result.label == label]
        if not found:
            known = [result.label for result in self.all] + list(WHOLE)
            near = get_close_matches(label, known, 1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise UnknownResultError(f"no result {label!r}{hint} Known: {', '.join(known)}.")
        return found


NUMBERS = frozenset({ResultKind.OMEGA, ResultKind.EPSILON, ResultKind.SLIDING})
"""Kinds of results that are one number, not a vector."""


def natural_size(kind: ResultKind, largest: Mapping[ResultKind, Any]) -> Any:
    """Return what a result of a kind is small against, the largest of each kind being given.

    Accelerations may all be zero while links turn: omega squared, and omega times the largest
    velocity, are what they are made of. Numbers or arrays alike.
    """
    turning = largest[ResultKind.OMEGA]
    if kind is ResultKind.EPSILON:
        return np.maximum(largest[kind], turning**2)
    if kind is ResultKind.ACCELERATION:
        return np.maximum(largest[kind], turning * largest[ResultKind.VELOCITY])
    return largest[kind]


NOTHING = "0"
"""Name of the number zero, which nothing in a problem can be called."""

WHOLE = {
    "positions": (ResultKind.PLACE, ResultKind.DIRECTION),
    "velocities": (ResultKind.VELOCITY, ResultKind.OMEGA, ResultKind.SLIDING),
    "accelerations": (ResultKind.ACCELERATION, ResultKind.EPSILON),
    "units": (ResultKind.UNIT,),
}
"""Whole groups of results that can be asked for at once."""


def results_of(construction: Construction) -> Results:
    """Return every result of a construction."""
    draft = _beside(construction.draft)
    kin = construction.kinematics
    still = draft.known(NOTHING, 0.0)  # of links that never turn, or turn evenly
    found: list[Result] = []
    for name, (link, place) in kin.velocity.named.items():
        found += [
            Result(name, ResultKind.PLACE, PointName(place), name),
            Result(f"v_{name}", ResultKind.VELOCITY, kin.velocity.point[link, place], name),
            Result(f"a_{name}", ResultKind.ACCELERATION, kin.acceleration.point[link, place], name),
        ]
    for link in draft.problem.mechanism.links:
        axis = draft.axis(link)
        found.append(Result(f"phi_{link}", ResultKind.DIRECTION, axis, link))
        found.append(Result(f"u_{link}", ResultKind.UNIT, axis, link))
        omega, epsilon = kin.omega.get(link, still), kin.epsilon.get(link, still)
        found.append(Result(f"omega_{link}", ResultKind.OMEGA, omega, link))
        found.append(Result(f"epsilon_{link}", ResultKind.EPSILON, epsilon, link))
    for sliding in kin.relatives.values():
        found.append(Result(sliding.speed, ResultKind.SLIDING, sliding.speed, sliding.point))
    return Results(draft.b.program(), draft.numbers, tuple(found))


def _beside(draft: Draft) -> Draft:
    """Return a draft that goes on where a construction ended, and leaves that as it is."""
    beside = copy.copy(draft)
    beside.b = draft.b.copy()
    beside.numbers = dict(draft.numbers)
    beside.axes = dict(draft.axes)
    return beside
