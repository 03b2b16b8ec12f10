"""Results by the plans beside the exact ones: of the calculated position, of all (результаты)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from planmethod.note.compared import ComparedNumber, Series, percent_text
from planmethod.note.document import Node, Part, Table, table_of_columns
from planmethod.note.formula import Rich
from planmethod.note.numbers import format_column, significant
from planmethod.note.tables.results import lead_columns
from planmethod.note.tables.series import motion_series
from planmethod.note.wording import MessageTable
from planmethod.plans.legend import MOTION_KINDS, QuantityKind, kinds_on
from planmethod.plans.model import PlanKind
from planmethod.project.report.context import Report, sentences
from planmethod.solved.solution import Solution

MANY_SIGMAS = 3.0
"""Sigmas beyond which a difference is named."""

FAINT = 1e-6
"""Fraction of the largest of its kind below which a quantity is negligible."""


def compared(
    solution: Solution, index: int, *kinds: QuantityKind
) -> list[tuple[Series, ComparedNumber]]:
    """Return the quantities of some kinds in a position; those that are something."""
    every = ((series, series[index]) for series in motion_series(solution, *kinds))
    return [
        (series, one)
        for series, one in every
        if np.isfinite(one.read) and abs(one.exact) > FAINT * series.peak
    ]


def worst(
    comparisons: Sequence[tuple[Series, ComparedNumber]],
) -> tuple[Series, ComparedNumber] | None:
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
    for series in motion_series(every, *kinds):
        values = [float(value) + 0.0 for value in series.read]
        columns.append([series.symbol, *map(report.notation.number, format_column(values))])
    table = table_of_columns([*lead, *columns], repeated=len(lead))
    return Table(table.head, table.rows, 0, len(lead), name=name, key=key)


def _compared(report: Report, texts: MessageTable) -> Iterator[Node]:
    notation = report.notation
    found = compared(report.one, 0, *MOTION_KINDS)
    yield sentences(texts.intro_compared.format(position=report.of_position))
    rows = [
        (
            series.head(notation),
            *notation.numbers(
                one.read_text, one.exact_text, one.off_text, one.percent_text(2), one.sigma_text
            ),
        )
        for series, one in found
        if one.sigma  # given values have no error
    ]
    yield Table(
        tuple(text.format() for text in texts["columns_compared"]),
        tuple(rows),
        name=texts.compared_table.format(position=report.in_position),
        key="compared",
    )
    yield from report.mark_note(rows)
    beyond = [series.symbol for series, one in found if one.sigmas > MANY_SIGMAS]
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
        peak = float(np.nanmax(np.abs(series.exact)))
        k = series.furthest
        if k is None or peak == 0.0 or not series[k].sigma:
            continue  # nothing can be read, or it is given
        one, off = series[k], format_column([abs(series[k].off)], 2)
        percent = percent_text(one.percent_of(peak), 2)
        rows.append(
            (
                series.head(notation),
                *notation.numbers(significant(peak), *off, percent, str(k), one.sigma_text),
            )
        )
    yield sentences(texts.all_intro.format())
    yield Table(
        tuple(text.format() for text in texts["columns_all"]),
        tuple(rows),
        name=texts.all_table.format(),
        key="largest",
    )
    yield from report.mark_note(rows)
