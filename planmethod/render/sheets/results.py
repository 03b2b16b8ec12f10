"""Table of results of a sheet (таблица результатов): values, senses and drafting errors."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from math import inf

import numpy as np

from planmethod.note.compared import DRAWN, MAX_PERCENT, Series
from planmethod.note.numbers import Notation
from planmethod.note.rounding import as_long, sigma_text
from planmethod.note.tables.series import motion_series
from planmethod.note.wording import Language
from planmethod.plans.legend import MOTION_KINDS
from planmethod.render.frame.frame import STAMP_WIDTH
from planmethod.render.layout.block import Block, Column, paragraph
from planmethod.render.layout.pack import EDGE
from planmethod.render.layout.tables import TableCell, TableColumn, table_block
from planmethod.render.sheets.model import BlockStyle
from planmethod.solved.solution import Solution


def position_text(solution: Solution, index: int, notation: Notation) -> str:
    """Return the text of a driver position: an angle within one turn, two decimals.

    If all are within a turn, negative angles stay negative.
    """
    value = float(solution.positions[index])
    if not solution.problem.drive.goes_round:
        return notation.as_input(value)
    if value in solution.problem.numbered:
        return notation.as_input(solution.problem.display_position(value))
    if value < 0.0 and (np.abs(solution.positions) < 360.0).all():
        return notation.as_input(round(value, 2))
    return notation.crank_angle(value)


def value_column(
    series: Series,
    position_indices: Sequence[int],
    notation: Notation,
    *,
    sigma: bool,
    is_single: bool,
) -> TableColumn:
    """Return the exact values of a quantity, their senses beside them, by positions.

    With ``sigma`` they have their errors beside them, and a single position (``is_single``) has
    rows for the read value, for its deviation, and for its error.
    """
    values, cells = series.displayed(series.exact, position_indices), list[TableCell]()
    texts = series.texts(values)
    for i, text, value in zip(position_indices, texts, values, strict=True):
        error, mark = series.error(i) if sigma else (0.0, "")
        written = notation.number(as_long(text, abs(value), error))
        if error and not is_single:
            written += f" ± {notation.number(sigma_text(error))}{mark}"
        cells.append(TableCell(written, series.sense(value)))
    if sigma and is_single:
        cells += _read_cells(series, position_indices[0], texts[0], notation)
    return TableColumn(series.symbol, tuple(cells), unit=unit_text(series, notation))


def unit_text(series: Series, notation: Notation) -> str:
    """Return the unit of a quantity below its symbol; empty for a ratio."""
    return notation.units[series.unit] if series.unit else ""


def _read_cells(series: Series, index: int, like: str, notation: Notation) -> list[TableCell]:
    """Return the value read on the plans, its deviation, and the error.

    ``like``: the exact value's text, whose decimals the read one has.
    """
    room = 0 if series.turns else None  # for the sign of other values of the column
    one = series[index].unless_lost()
    text, *others = notation.numbers(
        one.text_beside(like, signed=not series.turns),
        one.percent_text(limit=MAX_PERCENT),
        one.sigma_text,
    )
    return [TableCell(text, series.sense(one.read)), *(TableCell(other, room) for other in others)]


def result_columns(
    solution: Solution,
    position_indices: Sequence[int],
    language: Language,
    *,
    sigma: bool = False,
    kinds: Collection[str] = (),
) -> list[TableColumn]:
    """Return the columns of the result table: v, ω, a, ε with values and senses.

    ``kinds`` are the shown quantities. Default: all. With ``sigma`` a single position has rows for
    the read value and its error, and the values of many positions have their errors beside them.
    """
    shown = [kind for kind in MOTION_KINDS if not kinds or kind.sign in kinds]
    return columns_of(
        motion_series(solution, *shown), solution, position_indices, language, sigma=sigma
    )


def columns_of(
    every: Sequence[Series],
    solution: Solution,
    position_indices: Sequence[int],
    language: Language,
    *,
    sigma: bool,
) -> list[TableColumn]:
    """Return the columns of quantities, those of the positions before them."""
    alone, texts = len(solution.positions) == 1, language.sheets
    columns = [
        value_column(one, position_indices, language.notation, sigma=sigma, is_single=alone)
        for one in every
    ]
    if not alone:
        return [*position_columns(solution, position_indices, language), *columns]
    rows = (texts.exact, texts.read, "Δ, %", "±σ")
    return [TableColumn("", rows), *columns] if sigma else columns


def position_columns(
    solution: Solution, position_indices: Sequence[int], language: Language
) -> list[TableColumn]:
    """Return the columns of the numbers of positions, and of the driver's positions."""
    coordinate = solution.problem.drive.coordinate
    asked = tuple(position_text(solution, i, language.notation) for i in position_indices)
    return [
        TableColumn(language.note.number, tuple(str(i) for i in position_indices), min_width=8.0),
        TableColumn(coordinate.symbol, asked, unit=language.notation.in_head(coordinate.unit)),
    ]


def table_width(style: BlockStyle, usual: float = inf) -> float:
    """Return the width of a table, mm: requested or usual, at least the title block's."""
    room = style.inside - 2 * EDGE
    return min(max(STAMP_WIDTH, style.width(min(usual, room))), room)


def results_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the table of results and, with sigmas, a note on its errors."""
    alone, sigma = len(solution.positions) == 1, style.options.sigma
    sigma = alone if sigma is None else sigma
    size = style.sizes.text
    height = style.text(size if len(position_indices) == 1 else min(size, 3.5))
    width = table_width(style)
    language, texts = style.language, style.language.sheets
    title = texts.results_exact
    if sigma:
        title = texts.results if alone else texts.results_sigma
    columns = result_columns(
        solution, position_indices, language, sigma=sigma, kinds=style.entry.columns
    )
    table = table_block(
        columns,
        height,
        max_width=width,
        leading=(1 if sigma else 0) if alone else 2,
        title=style.entry.title or title,
    )
    marks = any(cell.text.endswith(DRAWN) for column in columns for cell in column.cells)
    if not sigma or (style.options.sigma is None and not marks):
        return table
    return with_note(table, columns, height, solution.profile.name, language)


def with_note(
    tables: Column,
    columns: Sequence[TableColumn],
    height: float,
    profile: str,
    language: Language,
) -> Column:
    """Return tables with a note on the errors in their columns, also on marked ones."""
    note = language.note
    text = language.sheets.sigma_note.format(profile=note["profiles"].get(profile, profile))
    if any(cell.text.endswith(DRAWN) for column in columns for cell in column.cells):
        text = f"{text} {note.drawn_note}"
    return Column([tables, paragraph(text, min(height, 3.5), tables.width)], gap=3.0)
