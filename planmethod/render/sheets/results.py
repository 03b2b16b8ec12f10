"""Table of results of a sheet (таблица результатов): values, senses and drafting errors."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from math import inf

import numpy as np

from planmethod.note.narrate.given import solution_peak, told
from planmethod.note.numbers import Notation, alike, is_noise, to_decimals
from planmethod.note.rounding import as_long, rounded_to, sigma_text
from planmethod.note.tables.sigmas import DRAWN, marked
from planmethod.note.wording import Language
from planmethod.plans.legend import MOTION_KINDS, Quantity
from planmethod.render.frame.frame import STAMP_WIDTH
from planmethod.render.layout.block import Block, Column, paragraph
from planmethod.render.layout.pack import EDGE
from planmethod.render.layout.tables import TableCell, TableColumn, table_block
from planmethod.render.sheets.model import Manner
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.solution import Solution

MOST_OFF = 100.0
"""A reading that is further off than so many per cent is none: the segment is too short."""


def position_text(solution: Solution, index: int, say: Notation) -> str:
    """Return a driver position as the sheet writes it: an angle within one turn, two decimals.

    Where none is a whole turn away, angles are as they were given, negative ones, too.
    """
    value = float(solution.positions[index])
    if not solution.problem.drive.goes_round:
        return say.given(value)
    if value in solution.problem.numbered:
        return say.given(solution.problem.shown(value))
    if value < 0.0 and (np.abs(solution.positions) < 360.0).all():
        return say.given(round(value, 2))
    return say.turned(value)


def _sense(value: float) -> int:
    return (value > 0) - (value < 0)


def _sigma_rows(
    solution: Solution, quantity: Quantity, index: int, say: Notation, like: str
) -> tuple[TableCell, ...]:
    """Return what was read on the plans, how far off, and the error.

    What was read has as many decimals as the exact value, ``like``, but where that is nothing; no
    zeros at its end are finer than the error.
    """
    read = float(solution.read_off(quantity.label)[index])
    sigma, mark = marked(drafting_of(solution), quantity.label, index)
    turns = quantity.kind.is_number
    exact = float(solution.exact(quantity)[index])
    off = 100.0 * (read - exact) / exact if abs(exact) > sigma else inf
    decimals = len(like.partition(".")[2])
    text = (
        to_decimals(abs(read), decimals)
        if like != "0" and "e" not in like
        else rounded_to(abs(read), sigma)
    )
    fine = len(sigma_text(sigma).partition(".")[2])
    while text.endswith("0") and len(text.partition(".")[2]) > fine:
        text = text[:-1].removesuffix(".")
    return (
        TableCell(say.number(text), _sense(read) if turns else None),
        TableCell(
            say.number(f"{round(off, 1) + 0.0:.1f}") if abs(off) < MOST_OFF else "—",
            0 if turns else None,
        ),
        TableCell(say.number(sigma_text(sigma)) + mark, 0 if turns else None),
    )


def result_columns(
    solution: Solution,
    indices: Sequence[int],
    words: Language,
    *,
    sigma: bool = False,
    kinds: Collection[str] = (),
) -> list[TableColumn]:
    """Return the columns of the result table: v, ω, a, ε with values and senses.

    ``kinds`` are the quantities that are shown, all when there are none.
    With ``sigma`` a single position has rows for what was read and for its error, and the values
    of many have their errors beside them.
    """
    alone, said, say = len(solution.positions) == 1, words.sheets, words.say

    def column(quantity: Quantity) -> TableColumn:
        numbers, peak = solution.exact(quantity), solution_peak(solution, quantity.kind)
        shown = [float(numbers[i]) for i in indices]
        shown = [0.0 if is_noise(value, peak) else value for value in shown]
        texts = alike([abs(value) for value in shown])
        turns = quantity.kind.is_number
        errors = [(0.0, "") for _ in shown]
        if sigma:
            errors = [marked(drafting_of(solution), quantity.label, i) for i in indices]
        cells = []
        for text, value, (error, mark) in zip(texts, shown, errors, strict=True):
            written = say.number(as_long(text, abs(value), error))
            if error and not alone:
                written += f" ± {say.number(sigma_text(error))}{mark}"
            cells.append(TableCell(written, _sense(value) if turns else None))
        if sigma and alone:
            cells += _sigma_rows(solution, quantity, indices[0], say, texts[0])
        return TableColumn(quantity.symbol, tuple(cells), unit=say.units[quantity.kind.unit])

    shown = [kind for kind in MOTION_KINDS if not kinds or kind.sign in kinds]
    columns = [column(quantity) for quantity in told(solution, *shown)]
    if sigma and alone:
        columns.insert(0, TableColumn("", (said.exact, said.read, "Δ, %", "±σ")))
    return columns if alone else [*position_columns(solution, indices, words), *columns]


def position_columns(
    solution: Solution, indices: Sequence[int], words: Language
) -> list[TableColumn]:
    """Return the columns of the numbers of positions, and of the driver's positions."""
    coordinate = solution.problem.drive.coordinate
    asked = tuple(position_text(solution, i, words.say) for i in indices)
    return [
        TableColumn(words.note.number, tuple(str(i) for i in indices), least=8.0),
        TableColumn(coordinate.symbol, asked, unit=words.say.in_head(coordinate.unit)),
    ]


def table_width(manner: Manner, usual: float = inf) -> float:
    """Return the width of a table, mm: asked or usual, no less than the title block's."""
    room = manner.inside - 2 * EDGE
    return min(max(STAMP_WIDTH, manner.width(min(usual, room))), room)


def results_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the table of results and, with sigmas, what its errors are."""
    alone, sigma = len(solution.positions) == 1, manner.extras.sigma
    sigma = alone if sigma is None else sigma
    size = manner.sizes.text
    height = manner.text(size if len(indices) == 1 else min(size, 3.5))
    width = table_width(manner)
    words, said = manner.words, manner.words.sheets
    title = said.results_exact
    if sigma:
        title = said.results if alone else said.results_sigma
    columns = result_columns(solution, indices, words, sigma=sigma, kinds=manner.entry.columns)
    table = table_block(
        columns,
        height,
        max_width=width,
        leading=(1 if sigma else 0) if alone else 2,
        title=manner.entry.title or title,
    )
    marks = any(cell.text.endswith(DRAWN) for column in columns for cell in column.cells)
    if not sigma or (manner.extras.sigma is None and not marks):
        return table
    return with_note(table, columns, height, solution.profile.name, words)


def with_note(
    tables: Column,
    columns: Sequence[TableColumn],
    height: float,
    profile: str,
    words: Language,
) -> Column:
    """Return tables and what the errors in their columns are, those that have the mark too."""
    note = words.note
    told = words.sheets.sigma_note.format(profile=note["profiles"].get(profile, profile))
    if any(cell.text.endswith(DRAWN) for column in columns for cell in column.cells):
        told = f"{told} {note.drawn_note}"
    return Column([tables, paragraph(told, min(height, 3.5), tables.width)], gap=3.0)
