"""A quantity over positions: exact, as a drawing gives it, and the error of that (ряд значений).

Tables that compare the plans with the exact solution are views of these: on sheets, and in the
note of a project.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from planmethod.note.compared import ComparedNumber, marked, sense_of
from planmethod.note.narrate.statement import reported_quantities, solution_peak
from planmethod.note.numbers import format_column, is_noise
from planmethod.plans.legend import Quantity, QuantityKind

if TYPE_CHECKING:
    from planmethod.solved.errors.spread import Errors
    from planmethod.solved.reading import Reals
    from planmethod.solved.solution import Solution
    from planmethod.solved.transfers import Transfers


class Series(Struct, frozen=True):
    """A quantity over positions (ряд значений); readings and errors are computed on demand.

    Attributes
    ----------
    quantity : Quantity
    exact : array of float, shape (n,), SI
    peak : float
        The largest magnitude among those shown with it; rounding noise beside it is zero.
    signed : bool
        Its sign is written before the number; else the sense of turning beside its magnitude.
    """

    quantity: Quantity
    exact: Reals
    peak: float
    reads: Callable[[], Reals]
    errors: Callable[[], Errors]
    signed: bool = False

    @property
    def turns(self) -> bool:
        """True if its sign is a sense, shown beside its magnitude."""
        return self.quantity.kind.is_number and not self.signed

    def error(self, index: int) -> tuple[float, str]:
        """Return sigma and its mark."""
        return marked(self.errors(), self.quantity.label, index)

    def compared(self, index: int, *, skip_insignificant: bool = False) -> ComparedNumber:
        """Return the quantity in a position, compared.

        With ``skip_insignificant``, an exact value that is lost in its error has no error in per
        cent.
        """
        sigma, mark = self.error(index)
        read, nothing = float(self.reads()[index]), sigma if skip_insignificant else 0.0
        return ComparedNumber(float(self.exact[index]), read, sigma, mark, nothing)

    def measured(self, index: int) -> ComparedNumber:
        """Return the quantity in a position, compared without its sigma; rounding counts as 0."""
        exact = float(self.exact[index])
        nothing = abs(exact) if is_noise(exact, self.peak) else 0.0
        return ComparedNumber(exact, float(self.reads()[index]), zero_limit=nothing)

    def displayed(self, values: Reals, indices: Iterable[int]) -> list[float]:
        """Return values as a table has them: rounding noise beside the largest is 0."""
        some = (float(values[i]) for i in indices)
        return [0.0 if is_noise(value, self.peak) else value for value in some]

    def texts(self, values: Sequence[float]) -> list[str]:
        """Return plain numbers with common decimals; sizes where the sign is not before them."""
        return format_column([value if self.signed else abs(value) for value in values])

    def sense(self, value: float) -> int | None:
        """Return the sense to write beside a value; None where there is none."""
        return sense_of(value) if self.turns else None


def motion_series(solution: Solution, *kinds: QuantityKind) -> list[Series]:
    """Return the reported quantities of the motion, kind by kind."""
    from planmethod.solved.errors.motion import drafting_of

    peaks = {kind: solution_peak(solution, kind) for kind in kinds if solution.quantities(kind)}
    return [
        Series(
            one, solution.exact(one), peaks[one.kind],
            partial(solution.read_off, one.label), partial(drafting_of, solution),
        )
        for one in reported_quantities(solution, *kinds)
    ]  # fmt: skip


def transfer_series(transfers: Transfers) -> list[Series]:
    """Return the transfer functions, ratios with their sign."""
    from planmethod.solved.errors.motion import drafting_of

    return [
        Series(
            one, exact, float(np.max(np.abs(exact), initial=0.0)),
            partial(transfers.read_off, one), partial(drafting_of, transfers.solution), signed=True,
        )
        for one in transfers.quantities
        for exact in [transfers.exact(one)]
    ]  # fmt: skip
