"""Forces of a solved problem: reactions, balancing moment, Zhukovsky lever (кинетостатика).

The force plans go on from the program of the kinematics, so that arms and accelerations are those
of the drawings, whoever reads them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from planmethod.construct.arithmetic import Arithmetic, Float64
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.program import Program
from planmethod.construct.steps import Name, NumberName
from planmethod.errors import AssemblyError
from planmethod.plans.forceplan import SCALE, Board, Force, Reaction
from planmethod.plans.impossible import failing
from planmethod.plans.kinetostatics import drive_forces, group_forces
from planmethod.plans.lever import Lever, hang
from planmethod.plans.loads import applied
from planmethod.plans.solution import UNIT_SCALES, Complexes, Reals, Solution


@dataclass(frozen=True, slots=True)
class JointForce:
    """Reaction in a joint in every position (реакция), N and N·m, ndarrays of shape (n,).

    ``moment`` is about ``at`` (m, in the file's coordinates), counter-clockwise positive; zero in a
    revolute pair.
    """

    joint: str
    on: str
    by: str
    at: Complexes
    force: Complexes
    moment: Reals


class Statics:
    """Force analysis of a solution (силовой расчёт).

    Parameters
    ----------
    solution : Solution
        Of a problem with ``[dynamics]``; every group must be a dyad.
    """

    def __init__(self, solution: Solution) -> None:
        self.solution = solution
        self.board = Board.of(solution)
        self.board.load(solution, applied(solution))
        for group in reversed(solution.structure.groups):
            group_forces(self.board, group)
        self.driving = drive_forces(self.board)
        self.hung: Lever | None = hang(self.board)
        self.program: Program = self.board.draft.b.program().needed_for(self._asked())

    def _asked(self) -> list[Name]:
        asked: list[Name] = []
        for reaction in self.board.reactions:
            asked += [reaction.force.at, reaction.force.tail, reaction.force.head]
            asked += [reaction.couple] if reaction.couple is not None else []
        if self.driving.moment is not None:
            asked.append(self.driving.moment)
        if self.driving.force is not None:
            asked += [self.driving.force.tail, self.driving.force.head]
        return asked + ([self.hung.balance] if self.hung is not None else [])

    def read(self, arithmetic: Arithmetic, scales: dict[str, float]) -> Trace:
        """Read the force plans in an arithmetic, at scales of all plans (units per mm)."""
        data = {**self.solution.data(scales), **self.board.data}
        return evaluate(self.program, data, arithmetic)

    @cached_property
    def si(self) -> Trace:
        """Exact reading: what is a millimetre of a force plan is here a newton.

        Raises
        ------
        AssemblyError
            Where a force plan does not close.
        """
        self.solution.si  # noqa: B018 - an impossible position must be told first
        trace = self.read(Float64(), {**UNIT_SCALES, SCALE: 1.0})
        first = failing(self.program, trace, len(self.solution.positions))
        bad = np.flatnonzero(first >= 0)
        if bad.size:
            index = int(bad[0])
            unit = "phi" if self.solution.problem.drive.is_crank else "s"
            raise AssemblyError(
                f"Cannot close the force plan at position {index + 1} "
                f"({unit} = {self.solution.positions[index] + 0.0:.12g}): the "
                "mechanism stands in a dead position, where no forces balance the loads. Ask another."
            )
        return trace

    def _vector(self, force: Force) -> Complexes:
        return self.solution.complexes(self.si, force.head) - self.solution.complexes(
            self.si, force.tail
        )

    def _number(self, name: NumberName | None) -> Reals:
        if name is None:
            return np.zeros(self.solution.positions.shape)
        return self.solution.reals(self.si, name)

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
    def balance(self) -> Reals:
        """Balancing moment on the crank, N·m, or force along the guide of a driving slider, N."""
        if self.driving.force is None:
            return self._number(self.driving.moment)
        slide = self.solution.problem.slides[self.solution.problem.drive.link]
        axis = self.board.draft.direction(slide)
        along = self.solution._complex_column(self.si.value[axis][1])
        return np.asarray((self._vector(self.driving.force) * np.conj(along)).real / np.abs(along))

    @cached_property
    def lever(self) -> Reals | None:
        """The same by the Zhukovsky lever; None where the driver stands."""
        return None if self.hung is None else self._number(self.hung.balance)
