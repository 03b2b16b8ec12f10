"""Transfer functions of a solution: exact, as the ruler gives them, how far off (аналоги)."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from planmethod.construct.arithmetic import Float64
from planmethod.construct.program import Program
from planmethod.construct.steps import NumberName, Step
from planmethod.plans.draft import Draft
from planmethod.plans.legend import TRANSFERS, Quantity, QuantityKind
from planmethod.plans.transfers import TransferSteps, transfer_quantities
from planmethod.solved.errors.drawing import Drafted, DrawnKind, DrawnQuantity, number
from planmethod.solved.errors.spread import Errors
from planmethod.solved.reading import Reading, Reals
from planmethod.solved.solution import Solution


class Transfers(Errors):
    """Transfer functions through segments of the plans (передаточные функции по планам).

    Labels: ``v_q_B``, ``a_q_B`` (m), ``u_21``, ``epsilon_q_2``.

    Parameters
    ----------
    solution : Solution
        With a crank that turns; others have no such plans.

    Attributes
    ----------
    quantities : tuple of Quantity
        Of points and links, velocities before accelerations; what is nothing by nature is left out.
    """

    def __init__(self, solution: Solution) -> None:
        self.solution, construction = solution, solution.construction
        self.draft: Draft = construction.draft.copy()
        kin = construction.kinematics
        found = list(transfer_quantities(kin, self.draft))
        turning = {
            QuantityKind.RATIO: {f"u_{link}" for link in kin.omega},
            QuantityKind.RATIO_2: {f"epsilon_q_{link}" for link in (*kin.omega, *kin.epsilon)},
        }
        self.quantities = tuple(q for q in found if str(q.name) in turning.get(q.kind, {q.name}))
        program = self.draft.b.program()
        self.added: tuple[Step, ...] = program.steps[len(construction.program.steps) :]
        super().__init__(
            Drafted(
                Program(program.steps),
                self._data,
                len(solution.positions),
                solution.profile,
                frozenset(str(plan.pole) for plan in construction.plans),
                tuple(self._items()),
                (),
                solution.hand.enlarged,
            )
        )

    def _data(self, chosen: Any) -> dict[str, Any]:
        return {**self.draft.numbers, **self.solution.data(self.solution.per_mm, chosen)}

    def _items(self) -> list[DrawnQuantity]:
        return [
            DrawnQuantity(
                q.label,
                (NumberName(q.name),),
                number(NumberName(q.name), size=q.kind.is_size),
                DrawnKind.LENGTH if q.kind.is_size else DrawnKind.NUMBER,
            )
            for q in self.quantities
        ]

    @cached_property
    def steps(self) -> TransferSteps:
        """What the formulas consist of; its draft is one of its own."""
        return TransferSteps(self.solution.construction.kinematics, self.draft.copy())

    @cached_property
    def si(self) -> Reading:
        """Exact reading, SI."""
        return self.solution.si.go_on(self.added, self.draft.numbers, Float64())

    @cached_property
    def paper(self) -> Reading:
        """Exact reading in millimetres of the plans."""
        return self.solution.paper.go_on(self.added, self.draft.numbers, Float64())

    @cached_property
    def by_hand(self) -> Reading:
        """Reading of the draughtsman with his ruler."""
        return self.solution.by_hand.go_on(self.added, self.draft.numbers, self.solution.hand)

    def exact(self, quantity: Quantity) -> Reals:
        """Return a transfer function, m and radians of a radian of the crank, shape (n,)."""
        return self.si.number(quantity.name)

    def read_off(self, quantity: Quantity) -> Reals:
        """Return it as the hand finds it, shape (n,)."""
        return self.by_hand.number(quantity.name)

    def some(self, *kinds: QuantityKind) -> list[Quantity]:
        """Return those of some kinds."""
        return [q for q in self.quantities if q.kind in (kinds or TRANSFERS)]


def transfers_of(solution: Solution) -> Transfers | None:
    """Return the transfer functions of a solution, once; None without a crank that turns."""
    drive = solution.problem.drive
    if not drive.is_crank or drive.rate == 0.0 or np.isnan(drive.rate):
        return None
    return solution.once(Transfers)
