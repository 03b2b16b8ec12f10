"""Errors of drawn position, velocity and acceleration plans (погрешности построения)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property, partial

import numpy as np
import numpy.typing as npt
from msgspec.structs import replace

from planmethod.arguments import of_type
from planmethod.construct.arithmetic import Number
from planmethod.construct.evaluate import Trace
from planmethod.construct.steps import NumberName, PointName
from planmethod.plans.build import plan_of
from planmethod.plans.model import FACTS, PlanKind
from planmethod.problem.quantities import QuantityKind
from planmethod.solved.errors.spread import DRAWS, Drafted, DrawnKind, DrawnQuantity, Errors, number
from planmethod.solved.quantities import transfers_of
from planmethod.solved.reading import Flags
from planmethod.solved.solution import Solution, at_positions


class Drafting(Errors):
    """Drafting errors of the plans of a solution.

    Labels: ``velocity.p-b`` (mm of the plan), ``x_B``, ``v_B``, ``a_B``, ``omega_2``,
    ``epsilon_2``, ``v_B3/2``, ``ak_B3/2``, ``ar_B3/2`` (SI); transfer functions, ``v_q_B``,
    ``u_21``, ``a_q_B``, ``epsilon_q_2``.

    Parameters
    ----------
    solution : Solution
        Drawn by the hand of its profile.
    draws, seed : int
        Of the random sheets.
    """

    def __init__(self, solution: Solution, *, draws: int = DRAWS, seed: int = 1) -> None:
        self.solution = solution
        self._transfers = transfers_of(solution)
        whole = solution.construction if self._transfers is None else self._transfers
        drawing = Drafted(
            whole.program,
            self._data,
            len(solution.positions),
            solution.profile,
            frozenset(str(plan.pole) for plan in solution.construction.plans),
            tuple(self._items()),
            _plan_points(solution),
            solution.ruler_arithmetic.enlargements,
        )
        super().__init__(drawing, draws=draws, seed=seed)

    def __reduce__(self) -> tuple[object, ...]:
        """Return what another process finds the same by."""
        return partial(Drafting, draws=self.draws, seed=self.seed), (self.solution,)

    def _data(self, chosen: npt.NDArray[np.intp]) -> dict[str, Number]:
        known = {} if self._transfers is None else at_positions(self._transfers.numbers, chosen)
        return {**known, **self.solution.data(self.solution.per_mm, chosen)}

    def _items(self) -> Iterator[DrawnQuantity]:
        """Yield every quantity that the drawing gives."""
        construction = self.solution.construction
        for segment in construction.segments:
            size = number(segment.drawn, size=True)
            item = DrawnQuantity(segment.label, (segment.drawn,), size, DrawnKind.LENGTH)
            yield self._known_absent(item, segment.kind)
        origin = construction.draft.origin
        more = () if self._transfers is None else self._transfers.quantities
        for quantity in (*construction.legend, *more):
            if quantity.kind is QuantityKind.PLACE:
                place = PointName(quantity.name)
                for axis, part in (("x", "real"), ("y", "imag")):
                    take = _coordinate(place, part, getattr(origin, part))
                    yield DrawnQuantity(quantity.kind.label(quantity.of, axis), (place,), take)
            elif quantity.size is not None:
                sized = quantity.kind.is_size
                kind = DrawnKind.LENGTH if sized else DrawnKind.NUMBER
                take = number(quantity.size, size=sized)
                item = DrawnQuantity(quantity.label, (quantity.size,), take, kind)
                yield self._known_absent(item, plan_of(quantity.kind))

    def _known_absent(self, item: DrawnQuantity, kind: PlanKind) -> DrawnQuantity:
        """Return an item that knows where its plan is not drawn because it has no vector."""
        if kind is PlanKind.POSITION:
            return item
        return replace(item, absent=lambda: self._absent[kind])

    def _of_sheets(self, index: int) -> dict[str, float]:
        """Return the sigmas from random sheets of one position: those of its own mechanism."""
        solution, own = self.solution.variant_at(index)
        if solution is self.solution:
            return super()._of_sheets(index)
        return drafting_of(solution)._of_sheets(own)

    @cached_property
    def _absent(self) -> dict[PlanKind, Flags]:
        """Positions in which a plan has no vector."""
        solution, still = self.solution, np.zeros(self.solution.positions.shape)
        found = {}
        for plan in solution.construction.plans:
            ends = [(solution.paper.point(end) for end in (v.tail, v.head)) for v in plan.vectors]
            longest = np.max([still, *(np.abs(head - tail) for tail, head in ends)], axis=0)
            found[plan.kind] = np.asarray(longest == 0)
        return found


def drafting_of(solution: Solution) -> Drafting:
    """Return the errors of the hand's drawing, computed at the first call."""
    return of_type("solution", solution, Solution, "planmethod.solve()").compute_once(Drafting)


def _plan_points(solution: Solution) -> tuple[PointName, ...]:
    ends = {
        end
        for plan in solution.construction.plans
        for vector in plan.vectors
        for end in (vector.tail, vector.head)
    }
    return tuple(sorted(ends | {PointName(p) for p in solution.construction.draft.points()}))


def _coordinate(place: PointName, part: str, origin: float) -> Callable[[Trace], Number]:
    mu = NumberName(FACTS[PlanKind.POSITION].scale)
    return lambda trace: getattr(trace.value[place], part) * trace.value[mu] + origin
