"""Numbers of all positions as a workbook (таблицы проекта): ``numbers.xlsx``."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from planmethod.note.document import plain_text
from planmethod.note.records.spreadsheet import csv_columns, driver_of
from planmethod.note.tables.errors import motion_series
from planmethod.note.wording import MessageTable, get_language
from planmethod.note.writers.workbook import add_sheet, new_workbook, saved
from planmethod.plans.build import MOTION_KINDS
from planmethod.project.settle import Project
from planmethod.solved.reading import Reals

KINDS = (
    ("position", r"position"),
    ("margin", r"margin"),
    ("driver turned", r"phi_deg"),
    ("driver", r"s"),
    ("force along", r"F\.(.+)\.([xy])"),
    ("force read", r"F\.(.+)\.read"),
    ("force rubbed", r"F\.(.+)\.rubbed"),
    ("force", r"F\.(.+)"),
    ("friction", r"friction\.(.+)"),
    ("balance once", r"driving\.(?:force|moment)\.once"),
    ("balance rubbed", r"driving\.(?:force|moment)\.rubbed"),
    ("efficiency", r"efficiency"),
    ("moment", r"M\.(.+)"),
    ("balancing moment read", r"driving\.moment\.read"),
    ("balancing moment", r"driving\.moment"),
    ("balancing force read", r"driving\.force\.read"),
    ("balancing force", r"driving\.force"),
    ("lever moment read", r"lever\.moment\.read"),
    ("lever moment", r"lever\.moment"),
    ("lever force read", r"lever\.force\.read"),
    ("lever force", r"lever\.force"),
    ("velocity plan", r"velocity\.(.+)\.exact"),
    ("velocity plan read", r"velocity\.(.+)\.read"),
    ("acceleration plan", r"acceleration\.(.+)\.exact"),
    ("acceleration plan read", r"acceleration\.(.+)\.read"),
    ("scheme", r"position\.(.+)\.exact"),
    ("scheme read", r"position\.(.+)\.read"),
    ("place", r"(.+)\.([xy])"),
    ("velocity along", r"(.+)\.v([xy])"),
    ("velocity", r"(.+)\.v"),
    ("acceleration along", r"(.+)\.a([xy])"),
    ("acceleration", r"(.+)\.a"),
    ("turned", r"(.+)\.phi_deg"),
    ("omega", r"(.+)\.omega"),
    ("epsilon", r"(.+)\.epsilon"),
)
"""Kinds of the columns of ``solve --csv``, and patterns of their names, the first that holds."""

NOISE = 1e-9
"""Share of the largest value of a kind below which a value is rounding."""


def numbers_workbook(project: Project) -> bytes:
    """Return the workbook: exact and measured values in every position, SI.

    Its first sheet has the quantities of the motion by their letters, the second one every column
    of ``solve --csv``, those of the forces among them, by names of the language.
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
    for series in motion_series(solution, *MOTION_KINDS):
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
        peaks[kinds[name]] = max(largest, peaks.get(kinds[name], 0.0))
    cleaned = [_without_noise(each, peaks[kinds[name]]).tolist() for name, each in every.items()]
    rows = list(zip(range(len(project.positions)), *cleaned, strict=True))
    add_sheet(book, texts.columns, [_head(name, texts) for name in ("position", *every)], rows,
              frozen=2)  # fmt: skip
    return saved(book)


def _without_noise(values: Reals, peak: float) -> Reals:
    """Return values, with zero for rounding residue beside the largest of their kind."""
    return np.where(np.abs(values) <= NOISE * peak, 0.0, values)


def _kind(name: str) -> tuple[str, tuple[str, ...]]:
    """Return the kind of a column of ``solve --csv`` and the names in it; none of another one."""
    for kind, pattern in KINDS:
        if found := re.fullmatch(pattern, name):
            return kind, found.groups()
    return "", (name,)


def _head(name: str, texts: MessageTable) -> str:
    """Return the name of a column of ``solve --csv`` in the language of the project."""
    kind, names = _kind(name)
    return str(texts["heads"][kind]).format(*names) if kind else name


def _headed(symbol: str, unit: str) -> str:
    return f"{plain_text(symbol)}, {plain_text(unit)}"
