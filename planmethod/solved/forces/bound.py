"""Accuracy of a solution's forces: their conditioning, position by position."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.construct.arithmetic import Number
from planmethod.construct.dual import UNIT_ROUNDOFF, reach
from planmethod.construct.program import Program
from planmethod.construct.steps import Compute, Measure, MeasureAlong, MeasureArm, Name, NumberName
from planmethod.mechanism.model import FRAME
from planmethod.plans.forces.board import SCALE, ForceBoard
from planmethod.plans.forces.dyads import Driving
from planmethod.plans.forces.lever import Lever
from planmethod.plans.forces.polygons import DOWN
from planmethod.problem.model import Problem
from planmethod.solved.quantities import CLEARED, MULTIPLE, SAFE, SCALES, blocks, extent, min_gap
from planmethod.solved.reading import Flags, Reading, Reals
from planmethod.solved.solution import FEW_ROWS, Solution

Places = npt.NDArray[np.intp]


class ForceConditioning(Struct, frozen=True):
    """Force plans of a solution as input to the conditioning (силы, о точности которых судят).

    Attributes
    ----------
    exact : Reading
        Of the whole program at unit scales, NaN where a plan does not close.
    closes : Flags
        Where all of them close, shape (n,).
    data : callable
        Returns the data of the program at unit scales, in some positions.
    """

    solution: Solution
    board: ForceBoard
    driving: Driving
    lever: Lever | None
    program: Program
    exact: Reading
    closes: Flags
    data: Callable[[Places], dict[str, Number]]

    @property
    def margin(self) -> Reals:
        """Least margin of the steps, shape (n,)."""
        shape = self.solution.positions.shape
        told = self.exact.trace.margin.values()
        margins = [np.broadcast_to(np.asarray(one, dtype=float), shape) for one in told]
        return np.asarray(np.min([np.ones(shape), *margins], axis=0))

    def bound(self) -> Reals:
        """Return a bound of the relative error of the worst force, ndarray of shape (n,).

        As `planmethod.solved.conditioning.error_bound`, of the reactions, their moments and
        what balances the driver. Forces are small against the largest force of the position, load
        or reaction; moments against the largest of their kind, and against that force at the
        driver's arm, those of guides at the longest one of a link. Infinite where a plan does not
        close.
        """
        bound = np.full(self.closes.shape, CLEARED)
        bound[~self.closes] = np.inf
        b, pole = self.board.draft.b.copy(), self.board.pole
        pushed = [given.force.ends for given in self.board.given if given.force is not None]
        pulled = [reaction.force.ends for reaction in self.board.reactions]
        loads, forces = (
            [b.carry(f"{what} {k}", pole, *ends) for k, ends in enumerate(each)]
            for what, each in (("load", pushed), ("force", pulled))
        )
        couples = [r.couple for r in self.board.reactions if r.couple is not None]
        program = b.program().needed_for([*loads, *forces, *couples, *self._balances])
        suspects = self._suspects()
        for chosen in blocks(suspects[self.closes[suspects]]):
            found = self._worst(program, loads, forces, couples, chosen)
            bound[chosen] = MULTIPLE * UNIT_ROUNDOFF * found
        return bound

    @property
    def _balances(self) -> list[NumberName]:
        """Balance of the driver, by the plans and by the lever."""
        hung = [] if self.lever is None else [self.lever.balance]
        moment = [] if self.driving.moment is None else [self.driving.moment]
        return list(dict.fromkeys([self.driving.balance, *moment, *hung]))

    def _suspects(self) -> Places:
        """Return the positions that a quick check does not clear.

        Besides short lines, those in which a force follows from a moment over a short arm.
        """
        count = len(self.closes)
        if self.solution.max_positions <= FEW_ROWS:
            return np.arange(count)
        least = np.minimum(self.margin, min_gap(self.solution, self.program, self.exact.value))
        ends = extent(self.solution) or 1.0
        for arm in _divisors(self.program):
            least = np.minimum(least, np.abs(self.exact.number(arm)) / ends)
        return np.flatnonzero(~(least > SAFE))

    def _worst(
        self,
        program: Program,
        loads: Sequence[Name],
        forces: Sequence[Name],
        couples: Sequence[Name],
        chosen: Places,
    ) -> Reals:
        """Return the largest reach of a force, relative to the size it is compared with."""
        solution, shape, data = self.solution, chosen.shape, self.data(chosen)
        told = self.board.data.items()
        down = {name for name, value in told if np.all(np.asarray(value) == DOWN)}
        exact = {*SCALES, SCALE, *down, *solution.construction.draft.branches}
        spans = reach(program, data, exact)
        sizes = reach(program, data, data)  # nothing carries rounding: the sizes themselves
        turns, moment = solution.problem.balancer.turns, self.driving.moment
        moments = [name for name in self._balances if turns or name == moment]
        thrusts = [name for name in self._balances if name not in moments]
        stands = ~np.broadcast_to(solution.driven[1] != 0, self.closes.shape)[chosen]
        largest = np.max([np.zeros(shape), *(_rows(sizes, [*forces, *thrusts, *loads], shape))], 0)
        longest, arm = (_of_parts(solution, one)[chosen] for one in (_longest, _arm))
        worst = np.ones(shape)
        for names, times in (([*forces, *thrusts], 1.0), (couples, longest), (moments, arm)):
            names = list(names)
            small = np.max([times * largest, *_rows(sizes, names, shape)], 0)
            for name, span in zip(names, _rows(spans, names, shape), strict=True):
                # There is no lever if the driver is at rest.
                hung = self.lever is not None and name == self.lever.balance
                there = (small > 0) & ~(stands & hung)
                span = np.where(np.isnan(span), np.inf, span)
                worst[there] = np.maximum(worst[there], span[there] / small[there])
        return worst


def _rows(of: dict[Name, Reals], names: Iterable[Name], shape: tuple[int, ...]) -> list[Reals]:
    return [np.broadcast_to(of[name], shape) for name in names]


def _divisors(program: Program) -> Iterator[NumberName]:
    """Yield the measured numbers that something is divided by."""
    measured = {
        step.out for step in program.steps if isinstance(step, Measure | MeasureAlong | MeasureArm)
    }
    for step in program.steps:
        for name, power in step.powers if isinstance(step, Compute) else ():
            if power < 0 and name in measured:
                yield name


def _of_parts(solution: Solution, length: Callable[[Problem], float]) -> Reals:
    """Return a length of the mechanism that each position is of, ndarray of shape (n,)."""
    found = np.empty(solution.positions.shape)
    for one, rows in solution.parts:
        found[rows] = length(one.problem)
    return found


def _arm(problem: Problem) -> float:
    """Return the longest arm on the driving crank, m."""
    drive = problem.drive
    points = problem.bodies[drive.link].points
    if drive.pivot is None:
        return _longest(problem)
    return max(abs(place - points[drive.pivot]) for place in points.values())


def _longest(problem: Problem) -> float:
    """Return the longest distance of two points of a moving link, m."""
    spans = [
        abs(one - other)
        for link, body in problem.bodies.items()
        if link != FRAME
        for one in body.points.values()
        for other in body.points.values()
    ]
    return max(spans, default=0.0)
