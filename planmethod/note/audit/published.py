"""Quantities of a solved problem, motion and forces, by the names of ``[published]``."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from planmethod.note.audit.quantities import MotionQuantities, Reading
from planmethod.problem.selector import FORCES, Selector
from planmethod.solved.solution import Solution

if TYPE_CHECKING:
    from planmethod.note.audit.forces import ForceQuantities


class Quantities(MotionQuantities):
    """Values of selectors in one position of a solution.

    Parameters
    ----------
    solution : Solution
    position : int
        From 0.
    mu_f : float or None, N/mm
        Scale of the source's force plans; the program's own where the source tells none.
    """

    def __init__(self, solution: Solution, position: int = 0, mu_f: float | None = None) -> None:
        super().__init__(solution, position)
        self.mu_f = mu_f

    @cached_property
    def forces(self) -> ForceQuantities:
        """Quantities of the force analysis.

        Raises
        ------
        UnansweredError
            When the file has neither masses nor loads.
        """
        from planmethod.note.audit.forces import ForceQuantities

        return ForceQuantities(self, self.mu_f)

    def _value(self, selector: Selector, reading: Reading) -> float:
        if selector.kind in FORCES:
            return self.forces.value(selector, reading)
        return super()._value(selector, reading)
