"""Results by the plans beside the exact ones: of the calculated position, of all (результаты)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from planmethod.note.compared import ComparedNumber, percent_text
from planmethod.note.document import Node, Part, Table, table_of_columns
from planmethod.note.formula import Rich
from planmethod.note.narrate.statement import reported_quantities
from planmethod.note.numbers import format_column
from planmethod.note.rounding import sigma_text
from planmethod.note.tables.results import lead_columns
from planmethod.note.tables.series import motion_series
from planmethod.note.wording import MessageTable
from planmethod.plans.legend import MOTION_KINDS, Quantity, QuantityKind, kinds_on
from planmethod.plans.model import PlanKind
from planmethod.project.report.context import Report, sentences
from planmethod.solved.solution import Solution

MANY_SIGMAS = 3.0
"""Sigmas beyond which a difference is named."""

FAINT = 1e-6
"""Fraction of the largest of its kind below which a quantity is negligible."""


def compared(
    solution: Solution, index: int, *kinds: QuantityKind
) -> list[tuple[Quantity, ComparedNumber]]:
    """Return the quantities of some kinds in a position; those that are something."""
    every = [(one.quantity, one.compared(index)) for one in motion_series(solution, *kinds)]
    peaks = {kind: [abs(one.exact) for of, one in every if of.kind is kind] for kind in kinds}
    return [
        (of, one)
        for of, one in every
        if np.isfinite(one.read) and abs(one.exact) > FAINT * max(peaks[of.kind])
    ]


def worst(
    comparisons: Sequence[tuple[Quantity, ComparedNumber]],
) -> tuple[Quantity, ComparedNumber] | None:
    """Return the quantity with the largest relative difference."""
    return max(comparisons, key=lambda pair: pair[1].percent_size, default=None)


def results_parts(report: Report) -> Iterator[Node]:
    """Yield the tables of all positions, and the comparison."""
    texts: MessageTable = report.texts["results"]
    if report.is_series:
        yield Part(texts.part.format())
        yield sentences(texts.intro.format())
        for kinds, key in (
            (kinds_on(PlanKind.VELOCITY), "velocities"),
            (kinds_on(PlanKind.ACCELERATION), "accelerations"),
        ):
            yield _table_by_positions(report, kinds, str(texts[key]).format(), key)
    yield Part(texts.compared.format())
    yield from _compared(report, texts)
    if report.is_series:
        yield from _largest(report, texts)


def _table_by_positions(
    report: Report, kinds: Sequence[QuantityKind], name: Rich, key: str
) -> Table:
    every = report.every
    lead = lead_columns(every.problem, report.project.positions, report.language.note)
    columns = []
    for quantity in reported_quantities(every, *kinds):
        values = [float(v) + 0.0 for v in every.read_off(quantity.label)]
        columns.append([quantity.symbol, *map(report.notation.number, format_column(values))])
    table = table_of_columns([*lead, *columns], repeated=len(lead))
    return Table(table.head, table.rows, 0, len(lead), name=name, key=key)


def _compared(report: Report, texts: MessageTable) -> Iterator[Node]:
    notation = report.notation
    found = compared(report.one, 0, *MOTION_KINDS)
    yield sentences(texts.intro_compared.format(position=report.of_position))
    rows = [
        (
            f"{of.symbol}, {report.unit(of.kind.unit)}",
            notation.computed(one.read),
            notation.computed(one.exact),
            notation.number(one.off_text),
            notation.number(one.percent_text(2)),
            notation.number(sigma_text(one.sigma)),
        )
        for of, one in found
        if one.sigma  # given values have no error
    ]
    yield Table(
        tuple(text.format() for text in texts["columns_compared"]),
        tuple(rows),
        name=texts.compared_table.format(position=report.in_position),
        key="compared",
    )
    beyond = [of.symbol for of, one in found if one.sigmas > MANY_SIGMAS]
    most = worst(found)
    yield sentences(
        texts.beyond.format(symbols=", ".join(beyond))
        if beyond
        else texts.within.format(
            most=notation.number(f"{max(one.sigmas for _, one in found) + 0.05:.1f}")
        ),
        ""
        if most is None
        else texts.largest.format(
            symbol=most[0].symbol, percent=notation.number(percent_text(most[1].percent_size))
        ),
    )


def _largest(report: Report, texts: MessageTable) -> Iterator[Node]:
    """Yield the largest difference of each quantity in all positions."""
    every, notation, rows = report.every, report.notation, []
    for series in motion_series(every, *MOTION_KINDS):
        quantity, off = series.quantity, np.abs(series.reads() - series.exact)
        peak = float(np.nanmax(np.abs(series.exact)))
        if not np.isfinite(off).any() or peak == 0.0:
            continue
        k = int(np.nanargmax(off))
        one = series.compared(k)
        if not one.sigma:
            continue  # given, not read
        rows.append(
            (
                f"{quantity.symbol}, {report.unit(quantity.kind.unit)}",
                notation.computed(peak),
                notation.number(format_column([abs(one.off)], 2)[0]),
                notation.number(percent_text(100.0 * abs(one.off) / peak, 2)),
                str(k),
                notation.number(sigma_text(one.sigma)),
            )
        )
    yield sentences(texts.all_intro.format())
    yield Table(
        tuple(text.format() for text in texts["columns_all"]),
        tuple(rows),
        name=texts.all_table.format(),
        key="largest",
    )
