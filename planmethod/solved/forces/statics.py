"""Forces of a solved problem: reactions, balancing moment, Zhukovsky lever (кинетостатика).

The force plans go on from the program of the kinematics, so that arms and accelerations are those
of the drawings, whoever reads them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property
from types import MappingProxyType

import numpy as np
import numpy.typing as npt
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.arithmetic import Arithmetic, Float64, Number
from planmethod.construct.evaluate import evaluate
from planmethod.construct.hand import Hand
from planmethod.construct.program import Program
from planmethod.construct.scale import Scale, choose_scale
from planmethod.construct.steps import Name, NumberName
from planmethod.mechanism.model import FRAME
from planmethod.plans.draft import Draft
from planmethod.plans.forces.board import SCALE, Force, ForceBoard, Reaction
from planmethod.plans.forces.dyads import Driving, drive_forces, group_forces
from planmethod.plans.forces.lever import Lever, plan_lever
from planmethod.plans.forces.loads import Applied
from planmethod.plans.forces.polygons import ForcePlan
from planmethod.plans.model import FACTS, PlanKind
from planmethod.problem.load_records import BearingTable
from planmethod.problem.model import Convention
from planmethod.solved.failures import PositionError
from planmethod.solved.forces.contact import JointForce, SlideReaction, contacts
from planmethod.solved.forces.loads import applied
from planmethod.solved.forces.resultants import UnshiftedInertia, shifted_inertia
from planmethod.solved.impossible import explain, failing
from planmethod.solved.reading import Complexes, Reading, Reals, Remembering
from planmethod.solved.room import Box
from planmethod.solved.solution import EVERY, UNIT_SCALES, Solution, at_positions

UNIT = FACTS[PlanKind.FORCE].unit
COMMON_BOX: Box = (100.0, 100.0)
"""What the largest of all force plans fills at the scale that they have in common, mm."""

PLAN_BOX: Box = (200.0, 150.0)
"""What each force plan of a group fills at the scale of its own at which it is drawn, mm."""

LAST_BOX: Box = (140.0, 100.0)
"""What that of the driving link fills, which closes with one force, mm."""

FAINT = 1e-6
"""A plan that is so small a part of what it is in its largest position is nothing."""


class Planned(Struct, frozen=True):
    """Force plans of a problem as steps that go on from its kinematics (планы сил).

    ``lever`` is None where the driver stands.
    """

    board: ForceBoard
    driving: Driving
    lever: Lever | None


def plan_forces(
    solution: Solution,
    draft: Draft,
    loads: Iterable[Applied],
    single: Mapping[str, Applied] = MappingProxyType({}),
    *,
    hung: bool = True,
) -> Planned:
    """Plan the forces of a solution on a draft of its construction, from the last group on.

    Parameters
    ----------
    draft : Draft
        Construction that is continued.
    loads : iterable of Applied
        What acts on the links beside the reactions.
    single : mapping of str to Applied
        Couples that the force of inertia of their link stands for as well, by link.
    hung : bool
        The loads hang on the lever, too: not those of friction, which act on both links of a pair.
    """
    start = len(draft.b.steps)
    board = ForceBoard(draft, solution.construction.kinematics, solution.problem.dynamics)
    board.load(loads, single)
    for group in reversed(solution.structure.groups):
        group_forces(board, group)
    driving = drive_forces(board)
    lever = plan_lever(board, driving) if hung else None
    draft.note_plan(PlanKind.FORCE, start)
    return Planned(board, driving, lever)


class Statics(Remembering):
    """Force analysis of a solution (силовой расчёт).

    Parameters
    ----------
    solution : Solution
        Of a problem with ``[dynamics]``; every group must be a dyad.
    rubbing : sequence of Applied
        Forces and couples of friction, which act beside the other loads; then there is no lever.

    Attributes
    ----------
    kept : tuple of UnshiftedInertia
        Links that keep the couple of inertia although the file asks for the single resultant.
    """

    def __init__(self, solution: Solution, rubbing: Sequence[Applied] = ()) -> None:
        super().__init__()
        self.solution = solution
        loads = (*applied(solution), *rubbing)
        single: Mapping[str, Applied] = {}
        self.unshifted: tuple[UnshiftedInertia, ...] = ()
        if solution.problem.dynamics is not None and solution.problem.dynamics.resultant:
            single, self.unshifted = shifted_inertia(solution, loads)
        draft = solution.construction.draft.copy()
        planned = plan_forces(solution, draft, loads, single, hung=not rubbing)
        self.board, self.driving, self.lever_plan = planned.board, planned.driving, planned.lever
        self.program: Program = self.board.draft.b.program().needed_for(self._asked())

    def _asked(self) -> list[Name]:
        asked: list[Name] = []
        for shift in self.board.shifts.values():
            asked += [shift.at, shift.length, shift.couple]
        for reaction in self.board.reactions:
            asked += [reaction.force.at, reaction.force.tail, reaction.force.head]
            asked += [reaction.couple] if reaction.couple is not None else []
        asked.append(self.driving.balance)
        asked += [self.driving.moment] if self.driving.moment is not None else []
        asked += [*self.board.segments.values.values(), *self.board.segments.lengths.values()]
        asked += self.board.arms.values()
        asked.append(self.board.scale)
        return asked + (
            [self.lever_plan.balance, self.lever_plan.difference] if self.lever_plan else []
        )

    def read(self, arithmetic: Arithmetic, scales: Mapping[str, Number]) -> Reading:
        """Read the force plans in an arithmetic, at scales of all plans (units per mm)."""
        trace = evaluate(self.program, self.data(scales, EVERY), arithmetic)
        return Reading(trace, len(self.solution.positions))

    def data(
        self, scales: Mapping[str, Number], chosen: npt.NDArray[np.intp] | slice
    ) -> dict[str, Number]:
        """Return the data of the program at given scales, for some positions."""
        return {**self.solution.data(scales, chosen), **at_positions(self.board.data, chosen)}

    @cached_property
    def si(self) -> Reading:
        """Exact reading: what is a millimetre of a force plan is here a newton.

        Raises
        ------
        PositionError
            Where a force plan does not close.
        """
        if not self.closes.all():
            draft, at = self.board.draft, self.solution.positions
            raise PositionError(explain(draft, self.program, self._si, at))
        return self._si

    @cached_property
    def _si(self) -> Reading:
        self.solution.si  # noqa: B018 - an impossible position must be told first
        return self.read(Float64(), {**UNIT_SCALES, SCALE: 1.0})

    @cached_property
    def failing(self) -> npt.NDArray[np.int64]:
        """Number of the first step that fails in each position, or -1; shape (n,)."""
        return failing(self.program, self._si.trace, len(self.solution.positions))

    @property
    def closes(self) -> npt.NDArray[np.bool_]:
        """Whether the force plans close, shape (n,)."""
        return np.asarray(self.failing < 0)

    def _vector(self, force: Force) -> Complexes:
        return self.si.vector(*force.ends)

    def _number(self, name: NumberName | None) -> Reals:
        if name is None:
            return np.zeros(self.solution.positions.shape)
        return self.si.number(name)

    @cached_property
    def reactions(self) -> list[JointForce]:
        """Reactions in all joints, each once: what ``by`` does to ``on``."""
        return [self._joint(reaction) for reaction in self.board.reactions]

    def _joint(self, reaction: Reaction) -> JointForce:
        return JointForce(
            reaction.joint,
            reaction.on,
            reaction.by,
            self.solution.place(reaction.force.at),
            self._vector(reaction.force),
            self._number(reaction.couple),
        )

    @cached_property
    def contacts(self) -> Mapping[int, SlideReaction]:
        """The reactions of the guides, by their numbers: where they act."""
        return contacts(self.solution, self.reactions, self.largest_forces)

    @cached_property
    def balance(self) -> Reals:
        """What balances the driver: moment on a crank, N·m; force at its point, on a slider, N."""
        return self._number(self.driving.balance)

    @cached_property
    def moment(self) -> Reals | None:
        """Balancing moment on the crank, N·m, whatever balances it; None of a driving slider."""
        return None if self.driving.moment is None else self._number(self.driving.moment)

    @cached_property
    def lever(self) -> Reals | None:
        """The same by the Zhukovsky lever; None where the driver stands."""
        return None if self.lever_plan is None else self._number(self.lever_plan.balance)

    @cached_property
    def largest_forces(self) -> Reals:
        """Size of the largest force of each position, load or reaction, N."""
        forces = [joint.force for joint in self.reactions]
        forces += [given.applied.force for given in self.board.given]
        none = np.zeros(self.solution.positions.shape)
        return np.asarray(np.max([none, *(np.abs(f) + none for f in forces)], axis=0), dtype=float)

    def largest(self, index: int) -> float:
        """Return the size of the largest force of a position, load or reaction, N."""
        return float(self.largest_forces[index])

    # Drawn -----------------------------------------------------------------------------------

    @cached_property
    def scale(self) -> Scale:
        """Scale of the force plans (масштаб сил): the file's, or one of the series for all."""
        scales = self.solution.problem.scales
        if scales.mu_F is not None:
            return Scale(SCALE, scales.mu_F, UNIT)
        if PlanKind.FORCE in self.solution.scales:
            return self.solution.scales[PlanKind.FORCE]
        extents = [self.extent(plan) for plan in self.board.plans]
        whole = (max(e[0] for e in extents), max(e[1] for e in extents))
        inverse = scales.convention is Convention.MM_PER_UNIT
        return Scale(SCALE, choose_scale(whole, COMMON_BOX, mm_per_unit=inverse), UNIT)

    def extent(self, plan: ForcePlan) -> Box:
        """Return width and height of a plan in the position where it is the widest, N."""
        width, height = self._extents(plan)
        return float(width.max()), float(height.max())

    def _extents(self, plan: ForcePlan) -> tuple[Reals, Reals]:
        """Return width and height of a plan in every position, N, shape (n,)."""
        ends = {end for edge in plan.polygon for end in (edge.tail, edge.head)}
        places = np.asarray([self.si.point(end) for end in sorted(ends)])
        return np.ptp(places.real, axis=0), np.ptp(places.imag, axis=0)

    @cached_property
    def own_scales(self) -> list[Reals]:
        """Scale of each plan, by positions, N per mm, shape (n,): one that the file gives is all's.

        Plans that are nothing have the common one.
        """
        found = [np.full(len(self.solution.positions), self.scale.per_mm) for _ in self.board.plans]
        scales = self.solution.problem.scales
        if scales.mu_F is not None:
            return found
        inverse = scales.convention is Convention.MM_PER_UNIT
        for plan, own in zip(self.board.plans, found, strict=True):
            extents = self._extents(plan)
            size = np.maximum(*extents)
            for index in np.flatnonzero(size > FAINT * np.max(size, initial=0.0)):
                box = float(extents[0][index]), float(extents[1][index])
                room = LAST_BOX if plan is self.board.plans[-1] else PLAN_BOX
                own[index] = choose_scale(box, room, mm_per_unit=inverse)
        return found

    @cached_property
    def shares(self) -> list[Reals]:
        """How many times larger than by `scale` each plan is drawn, by positions, shape (n,)."""
        return [self.scale.per_mm / own for own in self.own_scales]

    def own_scale(self, number: int, index: int) -> Scale:
        """Return the scale at which one of the plans is drawn in a position."""
        return Scale(SCALE, float(self.own_scales[number][index]), UNIT)

    @cached_property
    def hand(self) -> Hand:
        """Hand that reads each force on the plan that finds it first, at the scale of that."""
        segments, own = self.board.segments, self.solution.hand
        enlarged: dict[str, Number] = {}
        for plan, share in zip(self.board.plans, self.shares, strict=True):
            for edge in plan.reactions:
                enlarged.setdefault(segments.drawn(edge.ends), share)
        return replace(own, enlarged={**own.enlarged, **enlarged})

    @property
    def per_mm(self) -> dict[str, Number]:
        """Unit per millimetre of all plans, by the name that the program has for it."""
        return {**self.solution.per_mm, SCALE: self.scale.per_mm}

    @cached_property
    def paper(self) -> Reading:
        """Exact reading at the scales of the drawings: millimetres of the plans."""
        return self.read(Float64(), self.per_mm)

    @cached_property
    def by_hand(self) -> Reading:
        """Reading of a draughtsman who measures with a ruler, along his own chain."""
        return self.read(self.hand, self.per_mm)


def statics_of(solution: Solution) -> Statics:
    """Return the force analysis of a solution, made when it is first asked for."""
    return solution.once(Statics)


def bearings_of(statics: Statics, joint: JointForce) -> BearingTable | None:
    """Return the two bearings that share the reaction of a shaft; None where the file has none."""
    dynamics = statics.solution.problem.dynamics
    if dynamics is None or FRAME not in (joint.on, joint.by):
        return None
    slides = joint.joint in {slide.pin for slide in statics.solution.problem.slides.values()}
    return None if slides else dynamics.bearings.get(joint.joint)
