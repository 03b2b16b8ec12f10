"""How far drawn position, velocity and acceleration plans may be off (погрешности построения)."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cached_property, partial

import numpy as np

from planmethod.construct.arithmetic import Number
from planmethod.construct.steps import PointName
from planmethod.plans.build import measured_segments
from planmethod.plans.model import PlanKind
from planmethod.solved.errors.drawing import (
    Drafted,
    Flags,
    Item,
    ItemKind,
    Reading,
    number,
    segment,
)
from planmethod.solved.errors.spread import DRAWS, Errors
from planmethod.solved.solution import Solution, plain

PLAN_OF = {
    **dict.fromkeys(("velocity", "v", "omega"), PlanKind.VELOCITY),
    **dict.fromkeys(("acceleration", "a", "epsilon", "ak", "ar"), PlanKind.ACCELERATION),
}
"""Plan that a quantity is taken from, by the beginning of its label."""


class Drafting(Errors):
    """Drafting errors of the plans of a solution.

    Labels: ``velocity.p-b`` (mm of the plan), ``x_B``, ``v_B``, ``a_B``, ``omega_2``,
    ``epsilon_2``, ``v_B3/2``, ``ak_B3/2``, ``ar_B3/2`` (SI).

    Parameters
    ----------
    solution : Solution
        Drawn by the hand of its profile.
    draws, seed : int
        Of the random sheets.
    """

    def __init__(self, solution: Solution, *, draws: int = DRAWS, seed: int = 1) -> None:
        self.solution = solution
        drawing = Drafted(
            solution.construction.program,
            partial(solution.data, solution.per_mm),
            len(solution.positions),
            solution.profile,
            frozenset(str(plan.pole) for plan in solution.construction.plans),
            tuple(map(self._known_absent, _items(solution))),
            _plan_points(solution),
        )
        super().__init__(drawing, draws=draws, seed=seed)

    def _known_absent(self, item: Item) -> Item:
        """Return an item that knows where its plan is drawn by nobody, having no vector."""
        kind = PLAN_OF.get(item.label.split(".")[0].split("_")[0])
        return item if kind is None else replace(item, absent=lambda: self._absent[kind])

    @cached_property
    def _absent(self) -> dict[PlanKind, Flags]:
        """Positions in which a plan has no vector."""
        solution, still = self.solution, np.zeros(self.solution.positions.shape)
        found = {}
        for plan in solution.construction.plans:
            ends = [
                (solution.complexes(solution.paper, end) for end in (v.tail, v.head))
                for v in plan.vectors
            ]
            longest = np.max([still, *(np.abs(head - tail) for tail, head in ends)], axis=0)
            found[plan.kind] = np.asarray(longest == 0)
        return found


def _plan_points(solution: Solution) -> tuple[PointName, ...]:
    ends = {
        end
        for plan in solution.construction.plans
        for vector in plan.vectors
        for end in (vector.tail, vector.head)
    }
    return tuple(sorted(ends | {PointName(p) for p in solution.construction.draft.points()}))


def _items(solution: Solution) -> Iterable[Item]:
    """Yield every quantity that the drawing gives."""
    construction = solution.construction
    mu = {kind: scale.per_mm for kind, scale in solution.scales.items()}
    for kind in PlanKind:
        for name, tail, head in _segment_ends(solution, kind):
            yield Item(f"{kind.value}.{name}", (tail, head), segment(tail, head), ItemKind.LENGTH)
    kin = construction.kinematics
    for name, at in kin.velocity.named.items():
        place = PointName(at[1])
        origin, mu_l = construction.draft.origin, mu[PlanKind.POSITION]
        for axis, part in (("x", "real"), ("y", "imag")):
            take = _coordinate(place, mu_l, part, getattr(origin, part))
            yield Item(f"{axis}_{name}", (place,), take)
        for letter, motion in (("v", kin.velocity), ("a", kin.acceleration)):
            ends = (motion.pole, motion.point[at])
            yield Item(f"{letter}_{name}", ends, _length(*ends, mu[motion.kind]), ItemKind.LENGTH)
    for table in (kin.omega, kin.epsilon):
        word = "omega" if table is kin.omega else "epsilon"
        for link, name in table.items():
            yield Item(f"{word}_{link}", (name,), number(name))
    for r in kin.relatives.values():
        assert r.a_start is not None and r.a_turned is not None and r.a_head is not None
        told = str(r.speed).removeprefix("v_")
        for letter, kind, tail, head in (
            ("v", PlanKind.VELOCITY, r.start, r.head),
            ("ak", PlanKind.ACCELERATION, r.a_start, r.a_turned),
            ("ar", PlanKind.ACCELERATION, r.a_turned, r.a_head),
        ):
            yield Item(
                f"{letter}_{told}", (tail, head), _length(tail, head, mu[kind]), ItemKind.LENGTH
            )


def _segment_ends(solution: Solution, kind: PlanKind) -> list[tuple[str, PointName, PointName]]:
    """Return the segments of a plan by name, as `Solution.segments` has them."""
    if kind is PlanKind.POSITION:
        pairs = measured_segments(solution.problem, solution.construction.draft)
        return [(f"{p}-{q}", PointName(p), PointName(q)) for p, q in pairs]
    plan = solution.construction.plan(kind)
    return [(f"{plain(plan, v.tail)}-{plain(plan, v.head)}", v.tail, v.head) for v in plan.vectors]


def _length(tail: PointName, head: PointName, mu: float) -> Callable[[Reading], Number]:
    if tail == head:
        return lambda reading: np.zeros(1)
    return lambda reading: reading.known(tail, head) * mu


def _coordinate(
    place: PointName, mu: float, part: str, origin: float
) -> Callable[[Reading], Number]:
    return lambda reading: getattr(reading.trace.value[place], part) * mu + origin
