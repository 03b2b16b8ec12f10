"""Numbers of all positions as a workbook (таблицы проекта): ``numbers.xlsx``."""

from __future__ import annotations

from typing import Any

from planmethod.note.narrate.given import told
from planmethod.note.plaintext import plain_text
from planmethod.note.records.spreadsheet import csv_rows
from planmethod.note.wording import language
from planmethod.note.writers.workbook import add_sheet, new_workbook, saved
from planmethod.plans.legend import MOTION_KINDS
from planmethod.project.model import Project


def numbers_workbook(project: Project) -> bytes:
    """Return the workbook: what is exact and what is measured in every position, SI.

    Its first sheet has the quantities of the motion by their letters, the second one every column
    of ``solve --csv``, those of the forces among them.
    """
    solution, words = project.solution, language(project.language)
    said, coordinate = words.project, project.problem.drive.coordinate
    book = new_workbook()
    units = words.say.units
    header = [said.number, _headed(coordinate.symbol, units[coordinate.unit])]
    columns: list[list[Any]] = [
        list(range(len(project.positions))),
        [float(position) for position in solution.positions],
    ]
    for quantity in told(solution, *MOTION_KINDS):
        unit = units[quantity.kind.unit]
        header.append(_headed(quantity.symbol, unit))
        header.append(said.measured.format(what=header[-1]))
        columns.append(solution.exact(quantity).tolist())
        columns.append(solution.read_off(quantity.label).tolist())
    add_sheet(book, said.positions, header, list(zip(*columns, strict=True)), frozen=2)
    names, rows = csv_rows(solution)
    add_sheet(book, said.columns, names, rows, frozen=2)
    return saved(book)


def _headed(symbol: str, unit: str) -> str:
    return f"{plain_text(symbol)}, {plain_text(unit)}"
