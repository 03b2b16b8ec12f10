"""Transfer functions of a solution: exact, as the ruler gives them, how far off (аналоги)."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from planmethod.construct.arithmetic import Float64
from planmethod.construct.steps import Step
from planmethod.plans.build import Construction
from planmethod.plans.draft import Draft
from planmethod.plans.legend import TRANSFERS, Quantity, QuantityKind
from planmethod.plans.transfers import TransferSteps, transfer_quantities
from planmethod.solved.reading import Reading, Reals
from planmethod.solved.solution import Solution


class Transfers:
    """Transfer functions through segments of the plans (передаточные функции по планам).

    Their drafting errors are listed with those of the plans, by label.

    Parameters
    ----------
    solution : Solution
        With a crank that turns; others have no such plans.

    Attributes
    ----------
    quantities : tuple of Quantity
        Quantities of points and links, velocities before accelerations; those that are zero by
        nature are left out.
    program : Program
        Program of the construction with their steps.
    added : tuple of Step
        These.
    numbers : mapping of str to Number
        Data of the construction and of these steps.
    """

    def __init__(self, solution: Solution) -> None:
        self.solution, construction = solution, solution.construction
        kinematics = construction.kinematics
        self.draft, found = _planned(construction)
        self.numbers = solution.numbers_of(lambda made: _planned(made)[0].numbers)
        turning = {
            QuantityKind.RATIO: {f"u_{link}" for link in kinematics.omega},
            QuantityKind.RATIO_2: {
                f"epsilon_q_{link}" for link in (*kinematics.omega, *kinematics.epsilon)
            },
        }
        self.quantities = tuple(q for q in found if str(q.name) in turning.get(q.kind, {q.name}))
        self.program = self.draft.b.program()
        self.added: tuple[Step, ...] = self.program.steps[len(construction.program.steps) :]

    @cached_property
    def steps(self) -> TransferSteps:
        """Steps of the formulas, on a separate draft."""
        return TransferSteps(self.solution.construction.kinematics, self.draft.copy())

    @cached_property
    def si(self) -> Reading:
        """Exact reading, SI."""
        return self.solution.si.extend(self.added, self.numbers, Float64())

    @cached_property
    def paper(self) -> Reading:
        """Exact reading in millimetres of the plans."""
        return self.solution.paper.extend(self.added, self.numbers, Float64())

    @cached_property
    def ruler_reading(self) -> Reading:
        """Reading with the draughtsman's ruler."""
        return self.solution.ruler_reading.extend(
            self.added, self.numbers, self.solution.ruler_arithmetic
        )

    def exact(self, quantity: Quantity) -> Reals:
        """Return a transfer function, m and radians of a radian of the crank, shape (n,)."""
        return self.si.number(quantity.name)

    def read_off(self, quantity: Quantity) -> Reals:
        """Return a transfer function as found by hand, shape (n,)."""
        return self.ruler_reading.number(quantity.name)

    def some(self, *kinds: QuantityKind) -> list[Quantity]:
        """Return the transfer functions of some kinds."""
        return [q for q in self.quantities if q.kind in (kinds or TRANSFERS)]


def _planned(construction: Construction) -> tuple[Draft, list[Quantity]]:
    """Return a construction that continues with the steps of the transfer functions, and these."""
    draft = construction.draft.copy()
    return draft, list(transfer_quantities(construction.kinematics, draft))


def transfers_of(solution: Solution) -> Transfers | None:
    """Return the transfer functions of a solution, once; None without a crank that turns."""
    drive = solution.problem.drive
    if not drive.revolves or drive.rate == 0.0 or np.isnan(drive.rate):
        return None
    return solution.compute_once(Transfers)
