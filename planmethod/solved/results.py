"""What a solved problem is asked for, and the steps that give it (искомые величины)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from enum import Enum
from typing import TYPE_CHECKING, Any

import numpy as np

from planmethod.construct.program import Program
from planmethod.construct.steps import Name, NumberName, PointName
from planmethod.errors import PlanMethodError
from planmethod.plans.build import Construction
from planmethod.plans.draft import Draft

if TYPE_CHECKING:
    from planmethod.solved.solution import Solution


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
    REACTION = "reaction"
    MOMENT = "moment"  # of a reaction, or on the crank
    THRUST = "thrust"  # on the driving slider, along its guide


UNIT = {
    ResultKind.PLACE: "m",
    ResultKind.VELOCITY: "m/s",
    ResultKind.ACCELERATION: "m/s²",
    ResultKind.DIRECTION: "deg",
    ResultKind.UNIT: "1",
    ResultKind.OMEGA: "1/s",
    ResultKind.EPSILON: "1/s²",
    ResultKind.SLIDING: "m/s",
    ResultKind.REACTION: "N",
    ResultKind.MOMENT: "N·m",
    ResultKind.THRUST: "N",
}


@dataclass(frozen=True, slots=True)
class Result:
    """One quantity of a solved problem and the step that makes it (искомая величина).

    Attributes
    ----------
    label : str
        ``B`` (a place), ``v_B``, ``a_B``, ``phi_2``, ``omega_2``, ``epsilon_2``, ``v_B3/2``; and
        ``u_2``, the direction ``phi_2`` as a unit vector. Of forces ``F_B_2/1`` (on link 2 from
        link 1), ``M_B_2/1`` (its moment), ``M_dr`` or ``F_dr``, ``M_lever`` or ``F_lever``.
    kind : ResultKind
    name : Name
        A point, a number, or for a direction the line of the link's own axis.
    of : str
        Point or link; of a force the beginning of its rows: ``F.B.2-1``.
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
    numbers : mapping
        Known numbers of the program; of forces also where their plans begin.
    all : tuple of Result
        Points in the order of the plans: place, velocity, acceleration; then links; then forces.
    draft : Draft
        From which the program comes.
    changing : tuple of (str, tuple of NumberName)
        Loads that differ from position to position, by name, and what is known of each.
    """

    program: Program
    numbers: Mapping[str, complex | float]
    all: tuple[Result, ...]
    draft: Draft
    changing: tuple[tuple[str, tuple[NumberName, ...]], ...] = ()

    def choose(self, labels: Iterable[str] | None) -> tuple[Result, ...]:
        """Return the results of some labels, in the order asked; for None all but unit vectors.

        ``positions``, ``velocities``, ``accelerations``, ``forces`` and ``units`` stand for what
        they say.

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

    def find(self, label: str) -> Sequence[Result]:
        """Return the results that a label stands for; none if there are no such."""
        if label in WHOLE:
            return [result for result in self.all if result.kind in WHOLE[label]]
        return [result for result in self.all if result.label == label]

    def _named(self, label: str) -> Sequence[Result]:
        found = self.find(label)
        if not found:
            known = [result.label for result in self.all]
            known += [word for word in WHOLE if self.find(word)]
            # Of a reaction the one that acts back is meant, before any other that is spelt alike.
            turned = re.sub(r"^([FM]_.+_)(.+)/(.+)$", r"\1\3/\2", label)
            near = [turned] if turned in known else get_close_matches(label, known, 1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise UnknownResultError(f"no result {label!r}{hint} Known: {', '.join(known)}.")
        return found


FORCES = frozenset({ResultKind.REACTION, ResultKind.MOMENT, ResultKind.THRUST})
"""Kinds of results of the force analysis."""

NUMBERS = frozenset(
    {
        ResultKind.OMEGA,
        ResultKind.EPSILON,
        ResultKind.SLIDING,
        ResultKind.MOMENT,
        ResultKind.THRUST,
    }
)
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
    "forces": tuple(FORCES),
    "units": (ResultKind.UNIT,),
}
"""Whole groups of results that can be asked for at once."""


def results_of(construction: Construction) -> Results:
    """Return every result of a construction."""
    draft = construction.draft.copy()
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
    return Results(draft.b.program(), draft.numbers, tuple(found), draft)


def results_for(
    solution: Solution, asked: Iterable[str] | None, *, forces: bool = False
) -> Results:
    """Return the results among which the asked ones are: forces are planned only where needed.

    Parameters
    ----------
    asked : iterable of str, optional
        Labels; everything of the motion when absent.
    forces : bool
        Where nothing is asked by name: everything of the forces, too.

    Raises
    ------
    UnknownResultError
        A force is asked of a problem without masses and loads.
    """
    results = results_of(solution.construction)
    other = () if asked is None else [label for label in asked if not results.find(label)]
    if not (other or (forces and asked is None)):
        return results
    if solution.problem.dynamics is not None:
        from planmethod.solved.forces.results import with_forces

        return with_forces(solution, results)
    for label in other:
        if label == "forces" or label.startswith(("F_", "M_")):
            raise UnknownResultError(
                f"no result {label!r}: the problem has no loads. Give the masses in [dynamics] and "
                "the loads in [[loads]]."
            )
    return results
