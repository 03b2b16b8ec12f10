"""Force plans as drawn by hand: the ruler's readings and their errors.

The errors of position and acceleration plans propagate to the force plans: it is one program.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property, partial

import numpy as np

from planmethod.construct.arithmetic import Number
from planmethod.construct.dual import angle
from planmethod.construct.evaluate import Trace
from planmethod.construct.program import Program
from planmethod.construct.steps import AtAngle, NumberName, Parallel, Perpendicular, PointName
from planmethod.plans.forces.board import Force, Reaction
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.errors.spread import (
    RADIAN,
    Drafted,
    DrawnKind,
    DrawnQuantity,
    Errors,
    number,
)
from planmethod.solved.forces.statics import JointForce, Statics, statics_of
from planmethod.solved.quantities import transfers_of
from planmethod.solved.reading import Flags, Reals

BALANCE, LEVER, DIFFERENCE = "balance", "lever", "difference"
"""Labels: balance of the driver by the force plans and by the lever, lever minus plans."""

ZERO_LENGTH_MM = 1e-9
"""Length of a force on its plan below which it is rounding and has no direction."""


def size_label(joint: JointForce | Reaction) -> str:
    """Return the label of the size of a reaction, N: ``F_2_1``, on link 2 from link 1."""
    return f"F_{joint.on}_{joint.by}"


def angle_label(joint: JointForce | Reaction) -> str:
    """Return the label of the direction of a reaction, degrees."""
    return f"angle_{size_label(joint)}"


def moment_label(joint: JointForce | Reaction) -> str:
    """Return the label of the moment in a prismatic pair, N·m."""
    return f"M_{joint.on}_{joint.by}"


class DrawnForces(Errors):
    """Force plans of a draughtsman (планы сил на бумаге).

    Labels: ``F_2_1`` (N), ``angle_F_2_1`` (degrees), ``M_5_0`` (N·m), ``balance``, ``lever`` and
    ``difference`` (N·m or N).

    Parameters
    ----------
    statics : Statics
        Its solution names the hand and its profile.
    """

    def __init__(self, statics: Statics) -> None:
        self.statics, self.solution = statics, statics.solution
        # The poles and the first points of the plans may be placed anywhere.
        board, plans = statics.board, self.solution.construction.plans
        free = {plan.pole for plan in plans} | {*board.starts, *board.loose}
        super().__init__(
            Drafted(
                statics.program,
                partial(statics.data, statics.per_mm),
                len(self.solution.positions),
                self.solution.profile,
                frozenset(map(str, free)),
                tuple(_items(statics)),
                tuple(sorted(_ends(statics))),
                _enlarged(statics),
            )
        )

    def __reduce__(self) -> tuple[object, ...]:
        """Return what another process finds the same by."""
        return DrawnForces, (self.statics,)

    def _of_sheets(self, index: int) -> dict[str, float]:
        """Return the sigmas from random sheets of one position: those of its own mechanism."""
        solution, own = self.solution.variant_at(index)
        if solution is self.solution:
            return super()._of_sheets(index)
        return drawn_forces(statics_of(solution))._of_sheets(own)

    @cached_property
    def _ruler_values(self) -> dict[str, Reals]:
        shape = self.solution.positions.shape
        read = self.read_quantities(self.statics.ruler_reading.trace)
        return {
            label: np.broadcast_to(np.asarray(value, dtype=float), shape)
            for label, value in read.items()
        }

    def read(self, label: str) -> Reals:
        """Return a quantity as the ruler gives it, shape (n,)."""
        return self._ruler_values[label]

    @property
    def discrepancy_sigma(self) -> Reals | None:
        """Expected size of lever minus force plans: one sigma, N·m or N; shape (n,).

        None where the driver stands.
        """
        return self.spreads[DIFFERENCE].sigma if DIFFERENCE in self.items else None


def drawn_forces(statics: Statics) -> DrawnForces:
    """Return the drawn force plans, computed at the first call."""
    return statics.compute_once(DrawnForces)


def all_errors(statics: Statics) -> Errors:
    """Return the errors of force plans and kinematics together: they have strokes in common."""
    solution, drawn = statics.solution, drawn_forces(statics).drawing
    transfers, steps = transfers_of(solution), statics.board.draft.b.program().steps
    made, known = {step.out for step in steps}, {}
    if transfers is not None:
        known = transfers.draft.numbers
        steps += tuple(step for step in transfers.added if step.out not in made)
    return Errors(
        Drafted(
            Program(steps),
            lambda chosen: {**known, **drawn.data(chosen)},
            drawn.count,
            drawn.profile,
            drawn.free,
            (*drafting_of(solution).drawing.items, *drawn.items),
            enlargements=drawn.enlargements,
        )
    )


def _ends(statics: Statics) -> dict[PointName, Reals]:
    """Return the drawn points of the force plans, and their enlargement relative to the scale.

    A load is drawn on the plan of its link.
    """
    found: dict[PointName, Reals] = {}
    for plan, share in zip(statics.board.plans, statics.enlargements, strict=True):
        for edge in (*plan.polygon, *plan.wholes, *plan.inner):
            found.setdefault(edge.tail, share)
            found.setdefault(edge.head, share)
    return found


def _enlarged(statics: Statics) -> dict[str, Number]:
    """Return the enlargement of each step relative to its scale: whole plans, and detail views."""
    found: dict[str, Number] = {str(end): share for end, share in _ends(statics).items()}
    for plan, share in zip(statics.board.plans, statics.enlargements, strict=True):
        for given in statics.board.given:
            if given.force is not None and given.applied.link in plan.links:
                found.setdefault(given.force.head, share)
        thrust = statics.thrust
        if thrust is not None and {link for link, _ in thrust.pushes} & {*plan.links}:
            found.setdefault(thrust.force.head, share)
    for step in statics.program.steps:
        if isinstance(step, Parallel | Perpendicular | AtAngle) and step.through in found:
            found[step.out] = found[step.through]
    return {**found, **statics.ruler_arithmetic.enlargements}


def _items(statics: Statics) -> Iterator[DrawnQuantity]:
    """Yield every quantity that the force plans and the lever give."""
    for reaction in statics.board.reactions:
        force, absent = reaction.force, partial(_absent, statics, reaction.force)
        ends = (force.tail, force.head)
        size, way = statics.board.segments.known(force.ends), angle_label(reaction)
        label = size_label(reaction)
        yield DrawnQuantity(label, (size,), number(size), DrawnKind.LENGTH, absent, direction=way)
        yield DrawnQuantity(way, ends, _direction(force), DrawnKind.DIRECTION, absent)
        if reaction.couple is not None:
            yield _number(moment_label(reaction), reaction.couple)
    hung = statics.lever_plan
    yield _number(BALANCE, statics.driving.balance)
    if hung is not None:
        yield _number(LEVER, hung.balance)
        yield _number(DIFFERENCE, hung.difference)


def _number(label: str, name: NumberName) -> DrawnQuantity:
    return DrawnQuantity(label, (name,), number(name))


def _direction(force: Force) -> Callable[[Trace], Number]:
    def read_angle(trace: Trace) -> Number:
        value = trace.value
        return angle(value[force.head] - value[force.tail], ZERO_LENGTH_MM) * RADIAN

    return read_angle


def _absent(statics: Statics, force: Force) -> Flags:
    """Return where the plan of a reaction has no force at all, so that it is not drawn."""
    ends = {force.tail, force.head}
    plan = next(
        plan
        for plan in statics.board.plans
        if any({edge.tail, edge.head} == ends for edge in (*plan.polygon, *plan.reactions))
    )
    found = np.ones(statics.solution.positions.shape, dtype=bool)
    for edge in plan.polygon:
        tail, head = (statics.si.point(e) for e in (edge.tail, edge.head))
        found &= head == tail
    return found
