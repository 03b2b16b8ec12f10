"""Numbers of all positions as a workbook (таблицы проекта): ``numbers.xlsx``."""

from __future__ import annotations

from typing import Any

import numpy as np

from planmethod.note.calculation.model import LivingCalculation
from planmethod.note.document import plain_text
from planmethod.note.records.spreadsheet import csv_columns, driver_of
from planmethod.note.tables.errors import motion_series, relative_series
from planmethod.note.wording import MessageTable, get_language
from planmethod.note.writers.calculationbook import add_calculation
from planmethod.note.writers.workbook import add_sheet, new_workbook, saved
from planmethod.plans.build import MOTION_KINDS
from planmethod.plans.model import MOTION, RATES
from planmethod.problem.quantities import BALANCES, QuantityNameError, parse_quantity
from planmethod.project.settle import Project
from planmethod.solved.quantities import NOISE, solution_peak
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution

GENERAL_HEADS = {
    "position": "position",
    "margin": "margin",
    "phi_deg": "driver turned",
    "s": "driver",
    "efficiency": "efficiency",
}
"""Heads of the columns that are of no point or link."""

ENDINGS = {"exact": "", "read": " read", "rubbed": " rubbed", "once": " once"}
"""Endings of names of columns that say how the value was found, and of the keys of their heads."""

PLANS = tuple(plan.value for plan in MOTION)


def numbers_workbook(project: Project, calculation: LivingCalculation | None = None) -> bytes:
    """Return the workbook: exact and measured values in every position, and the calculation.

    Its first sheet has the quantities of the motion by their letters, SI, the second one every
    column of ``solve --csv``, those of the forces among them, by names of the language. The others
    are the chapters of the calculation, if it is given, with formulas.
    """
    solution, language = project.solution, get_language(project.language)
    texts, coordinate = language.project, project.problem.drive.coordinate
    book = new_workbook()
    units = language.notation.units
    header = [texts.number, _headed(coordinate.symbol, units[coordinate.unit])]
    columns: list[list[Any]] = [
        list(range(len(project.positions))),
        list(project.places),
    ]
    relative = (one for plan in RATES for one in relative_series(solution, plan))
    for series in (*motion_series(solution, *MOTION_KINDS), *relative):
        header.append(_headed(series.symbol, units[series.unit]))
        header.append(texts.measured.format(what=header[-1]))
        for values in (series.exact, series.read):
            columns.append(_without_noise(values, series.peak).tolist())
    add_sheet(book, texts.positions, header, list(zip(*columns, strict=True)), frozen=2)
    every = csv_columns(solution)
    every[driver_of(project.problem)] = np.array(columns[1])
    kinds = {name: _kind(name)[0] for name in every}
    peaks: dict[str, float] = {}
    for name, values in every.items():
        largest = float(np.nanmax(np.abs(values), initial=0.0))
        natural = _natural(name, solution) or largest
        peaks[kinds[name]] = max(natural, peaks.get(kinds[name], 0.0))
    cleaned = [_without_noise(each, peaks[kinds[name]]).tolist() for name, each in every.items()]
    rows = list(zip(range(len(project.positions)), *cleaned, strict=True))
    add_sheet(book, texts.columns, [_head(name, texts) for name in ("position", *every)], rows,
              frozen=2)  # fmt: skip
    if calculation is None:
        return saved(book)
    return saved(book, add_calculation(book, calculation, language.calculation))


def _without_noise(values: Reals, peak: float) -> Reals:
    """Return values, with zero for rounding residue beside the largest of their kind."""
    return np.where(np.abs(values) <= NOISE * peak, 0.0, values)


def _natural(name: str, solution: Solution) -> float:
    """Return the natural size of the quantity of a column; 0 of none of the motion."""
    try:
        return solution_peak(solution, parse_quantity(name).kind)
    except QuantityNameError:
        return 0.0


def _kind(name: str) -> tuple[str, tuple[str, ...]]:
    """Return the key of the head of a column, and the names in it; no key of an unknown column."""
    if name in GENERAL_HEADS:
        return GENERAL_HEADS[name], ()
    stem, _, end = name.rpartition(".")
    column, read = (stem, ENDINGS[end]) if end in ENDINGS else (name, "")
    first, _, rest = column.partition(".")
    if end in ENDINGS and first in PLANS:
        return f"{first} plan{read}", (rest,)
    if first == "friction":
        return first, (rest,)
    try:
        quantity_key = parse_quantity(column)
    except QuantityNameError:
        return "", (name,)
    kind, axis = quantity_key.kind, quantity_key.axis
    head = kind.name.lower()
    if kind in BALANCES:
        return head + ("" if end in ("rubbed", "once") else f" {rest}") + read, ()
    of = rest.removesuffix(f".{axis}") if kind.is_force else first
    return head + (" along" if axis else "") + read, (of, axis)


def _head(name: str, texts: MessageTable) -> str:
    """Return the name of a column of ``solve --csv`` in the language of the project."""
    kind, names = _kind(name)
    return str(texts["heads"][kind]).format(*names) if kind else name


def _headed(symbol: str, unit: str) -> str:
    return f"{plain_text(symbol)}, {plain_text(unit)}"
