"""Series of a linkage's motion: what its plans give beside the exact values (ряды движения)."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from planmethod.note.compared import Series
from planmethod.note.narrate.statement import reported_quantities, solution_peak
from planmethod.plans.legend import TURNINGS, Quantity, QuantityKind
from planmethod.plans.model import PlanKind

if TYPE_CHECKING:
    from planmethod.solved.errors.spread import Spread
    from planmethod.solved.reading import Reals
    from planmethod.solved.solution import SegmentReading, Solution
    from planmethod.solved.transfers import Transfers


def quantity_series(solution: Solution, quantity: Quantity, peak: float = 0.0) -> Series:
    """Return a quantity of the motion; ``peak`` is the largest value of those shown with it."""
    return Series(
        quantity.symbol, quantity.kind.unit, solution.exact(quantity),
        partial(solution.read_off, quantity.label), partial(spread_of, solution, quantity.label),
        quantity.kind in TURNINGS, peak, quantity.label,
    )  # fmt: skip


def motion_series(solution: Solution, *kinds: QuantityKind) -> list[Series]:
    """Return the reported quantities of the motion, kind by kind."""
    peaks = {kind: solution_peak(solution, kind) for kind in kinds if solution.quantities(kind)}
    return [
        quantity_series(solution, one, peaks[one.kind])
        for one in reported_quantities(solution, *kinds)
    ]


def segment_series(solution: Solution, kind: PlanKind) -> list[Series]:
    """Return the segments of a plan, mm."""
    return [
        Series(
            one.name,
            "mm",
            one.exact,
            partial(_read, one),
            partial(spread_of, solution, f"{kind.value}.{one.name}"),
        )
        for one in solution.segments(kind)
    ]


def _read(segment: SegmentReading) -> Reals:
    return segment.read


def transfer_series(transfers: Transfers) -> list[Series]:
    """Return the transfer functions, ratios with their sign."""
    return [
        Series(
            one.symbol, one.kind.unit.replace("1", ""), exact, partial(transfers.read_off, one),
            partial(spread_of, transfers.solution, one.label),
            peak=float(np.max(np.abs(exact), initial=0.0)), label=one.label,
        )
        for one in transfers.quantities
        for exact in [transfers.exact(one)]
    ]  # fmt: skip


def spread_of(solution: Solution, label: str) -> Spread | None:
    """Return the drafting error of a quantity of the plans; None for one that is given."""
    from planmethod.solved.errors.motion import drafting_of

    return drafting_of(solution).spreads.get(label)
