"""Series of results, and drafting errors in tables: their cells and marks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

from planmethod.note.compared import DASH, DRAWN, Series
from planmethod.note.document import Node, Paragraph, Table, table_of
from planmethod.note.formula import Rich
from planmethod.note.narrate.statement import reported_quantities
from planmethod.plans.build import Quantity, kinds_on
from planmethod.plans.model import COMPONENTS, FACTS, PlanKind, VectorKind
from planmethod.problem.quantities import TURNINGS, QuantityKind
from planmethod.solved.quantities import solution_peak

if TYPE_CHECKING:
    from planmethod.construct.steps import NumberName
    from planmethod.note.wording import Language
    from planmethod.solved.errors.spread import Spread
    from planmethod.solved.quantities import Transfers
    from planmethod.solved.reading import Reals
    from planmethod.solved.solution import SegmentReading, Solution


def quantity_series(solution: Solution, quantity: Quantity) -> Series:
    """Return a quantity of the motion."""
    return Series(
        quantity.symbol, quantity.kind.written_unit, solution.exact(quantity),
        partial(solution.read_off, quantity.label), partial(spread_of, solution, quantity.label),
        quantity.kind in TURNINGS, solution_peak(solution, quantity.kind), quantity.label,
    )  # fmt: skip


def motion_series(solution: Solution, *kinds: QuantityKind) -> list[Series]:
    """Return the reported quantities of the motion, kind by kind."""
    return [quantity_series(solution, one) for one in reported_quantities(solution, *kinds)]


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


RELATIVE = (VectorKind.RELATIVE, VectorKind.SLIDING, *COMPONENTS)
"""Kinds of vectors of a plan that are of two points."""


def relative_series(solution: Solution, kind: PlanKind) -> list[Series]:
    """Return the relative velocities of a plan, or the components of accelerations: v_BN, aⁿ_BN.

    They are the vectors of two points, in the order of the plan, and have no sign. The error of
    one is that of its segment.
    """
    motion = solution.construction.kinematics.motion(kind)
    pairs = zip(
        solution.construction.plan(kind).vectors, segment_series(solution, kind), strict=True
    )
    per_mm = np.array(
        [solution.plan_scale(kind, index).per_mm for index in range(len(solution.positions))]
    )
    peak = solution_peak(solution, kinds_on(kind)[0])
    found: dict[Rich, Series] = {}
    for vector, segment in pairs:
        if vector.kind not in RELATIVE or vector.symbol in found:
            continue
        number = motion.segments.known((vector.tail, vector.head))
        exact = np.abs(solution.si.number(number))
        if not exact.any():
            continue  # zero by nature, as aᵏ on a fixed guide
        found[vector.symbol] = Series(
            vector.symbol, FACTS[kind].unit, exact, partial(_read_vector, solution, number),
            partial(_spread_at_scale, segment, per_mm), peak=peak, label=vector.symbol,
        )  # fmt: skip
    return list(found.values())


def relative_numbers(solution: Solution, kind: PlanKind) -> dict[Rich, NumberName]:
    """Return the names that the construction has for the values of `relative_series`."""
    segments = solution.construction.kinematics.motion(kind).segments
    found: dict[Rich, NumberName] = {}
    for vector in solution.construction.plan(kind).vectors:
        if vector.kind in RELATIVE:
            found.setdefault(vector.symbol, segments.known((vector.tail, vector.head)))
    return found


def _read_vector(solution: Solution, number: NumberName) -> Reals:
    return np.abs(solution.ruler_reading.number(number))


def _spread_at_scale(segment: Series, per_mm: Reals) -> Spread | None:
    """Return the error of a vector, which is that of its segment at the scale of the plan."""
    spread = segment.spread
    return None if spread is None else replace(spread, sigma=spread.sigma * per_mm)


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


class ErrorColumns:
    """Cells of compared numbers, those of their errors only where they are requested.

    Attributes
    ----------
    drawn : bool
        Whether a cell has the mark of a sigma found by random draws.
    """

    def __init__(self, solution: Solution, language: Language, *, enabled: bool = True) -> None:
        self.solution, self.language, self.enabled = solution, language, enabled
        self.drawn = False

    def cells(self, series: Series | None, index: int) -> list[Rich]:
        """Return a quantity in a position: exact, as read by hand, its error; else dashes."""
        if series is None:
            return [DASH, DASH, *self.cell(None, index)]
        one, number = series.measured(index), self.language.notation.number
        return [number(one.exact_text), number(one.read_text), *self.cell(series, index)]

    def row(self, quantities: Iterable[Quantity], index: int) -> list[Rich]:
        """Return the cells of quantities of the motion, one after another."""
        every = (quantity_series(self.solution, quantity) for quantity in quantities)
        return [cell for series in every for cell in self.cells(series, index)]

    def cell(self, series: Series | None, index: int) -> list[Rich]:
        """Return the error of a quantity as a row of one cell, or of none; a dash for none."""
        if not self.enabled:
            return []
        text = DASH if series is None else series[index].sigma_text
        self.drawn = self.drawn or text.endswith(DRAWN)
        return [self.language.notation.number(text)]

    def table(
        self,
        head: Sequence[Rich],
        after: Sequence[int],
        rows: Sequence[Sequence[Rich]],
        *,
        names: int = 1,
    ) -> Table:
        """Return a table with the errors behind the columns ``after``: their cells are in the rows.

        The digits of the errors are aligned.
        """
        if not self.enabled:
            return table_of(head, rows, names=names)
        columns: list[Sequence[Rich]] = list(zip(*rows, strict=True))
        wide = list(head)
        for made, k in enumerate(after, 1):
            wide.insert(k + made, self.language.note.sigma)
            columns[k + made] = levelled(columns[k + made])
        return table_of(wide, zip(*columns, strict=True), names=names)

    def notes(self) -> Iterator[Node]:
        """Yield what the errors are, and what the mark of some of them means."""
        if not self.enabled:
            return
        note, name = self.language.note, self.solution.profile.name
        yield Paragraph(note.sigma_note.format(profile=note["profiles"].get(name, name)))
        if self.drawn:
            yield Paragraph(note.drawn_note)


def levelled(cells: Sequence[str]) -> list[str]:
    """Return cells with space for a mark where another cell of their column has one."""
    some = any(cell.endswith(DRAWN) for cell in cells)
    return [cell + " " if some and not cell.endswith(DRAWN) else cell for cell in cells]
