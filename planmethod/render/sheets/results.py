"""Tables of a sheet: results, and values measured on the plans (таблица результатов)."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from math import copysign, inf

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from planmethod.construct.steps import Measure, MeasureAlong, Name, operands
from planmethod.note.compared import DASH, DRAWN, MAX_PERCENT, Series, as_long, sigma_text
from planmethod.note.narrate.digits import PrintedNumber, PrintedNumbers
from planmethod.note.numbers import Notation
from planmethod.note.tables.errors import motion_series, relative_series
from planmethod.note.wording import Language
from planmethod.plans.build import MOTION_KINDS, Quantity
from planmethod.plans.model import PlanKind
from planmethod.problem.quantities import QuantityKind
from planmethod.render.frame import STAMP_WIDTH
from planmethod.render.layout.block import Alternatives, Block, Column, paragraph
from planmethod.render.layout.groups import EDGE
from planmethod.render.layout.text_blocks import TableCell, TableColumn, TableForm, table_block
from planmethod.render.sheets.model import BlockStyle
from planmethod.solved.legibility import FEW
from planmethod.solved.reading import memoized
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
    printed: PrintedNumber | None = None,
) -> TableColumn:
    """Return the exact values of a quantity, their senses beside them, by positions.

    With ``sigma`` they have their errors beside them, and a single position (``is_single``) has
    rows for the read value, for its deviation, and for its error. The read value has the digits
    that the calculation has ``printed``.
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
        cells += _read_cells(series, position_indices[0], texts[0], notation, printed)
    return TableColumn(series.symbol, tuple(cells), unit=unit_text(series, notation))


def unit_text(series: Series, notation: Notation) -> str:
    """Return the unit of a quantity below its symbol; empty for a ratio."""
    return notation.units[series.unit] if series.unit else ""


def _read_cells(
    series: Series, index: int, like: str, notation: Notation, printed: PrintedNumber | None
) -> list[TableCell]:
    """Return the value read on the plans, its deviation, and the error.

    ``like``: the exact value's text, whose decimals the read one has if no calculation has it.
    """
    room = 0 if series.turns else None  # for the sign of other values of the column
    one = series[index].unless_lost()
    read = one.text_beside(like, signed=not series.turns)
    if printed is not None and printed.is_measured and one.read:
        read = f"-{printed.text}" if one.read < 0 and not series.turns else printed.text
        one = replace(one, read=copysign(printed.value, one.read))
    text, *others = notation.numbers(
        read,
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
    shown = [kind for kind in MOTION_KINDS if not kinds or kind.symbol in kinds]
    every = motion_series(solution, *shown)
    if len(solution.positions) > 1 and QuantityKind.VELOCITY in shown:
        every += relative_series(solution, PlanKind.VELOCITY)
    return columns_of(every, solution, position_indices, language, sigma=sigma)


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
    printed = _printed(solution, position_indices[0]) if alone and sigma else {}
    columns = [
        value_column(
            one, position_indices, language.notation,
            sigma=sigma, is_single=alone, printed=printed.get(one.label),
        )
        for one in every
    ]  # fmt: skip
    if not alone:
        return [*position_columns(solution, position_indices, language), *columns]
    rows = (texts.exact, texts.read, "Δ, %", "±σ")
    return [TableColumn("", rows), *columns] if sigma else columns


def _printed(solution: Solution, index: int) -> dict[str, PrintedNumber]:
    """Return the numbers of a calculation as it prints them, by the labels of the quantities."""
    steps = {step.out: step for step in solution.construction.program.steps}
    of = PrintedNumbers(solution, steps, index).of
    legend = solution.legend.items()
    return {label: of(one.size) for label, one in legend if one.size is not None}


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
        TableForm(height, leading=(1 if sigma else 0) if alone else 2),
        max_width=width,
        width=STAMP_WIDTH,
        title=style.entry.title or title,
    )
    if not sigma:
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
    width = tables.width - _FROM_FRAME
    return Column([tables, paragraph(text, min(height, 3.5), width)], gap=3.0)


WIDE = 0.72
"""Part of the paper's width for the table when rows of many positions are high."""

HALF = 0.6
"""Part of a table's width that suffices for half of its columns and the repeated ones."""

_FROM_FRAME = 2.0  # mm of white at the end of a line, where the table is flush with the frame

RULED = (Measure, MeasureAlong)
"""Steps whose values are read with a ruler."""


def measured_table(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return measured and exact values of every quantity, by positions.

    If errors are requested, the exact values with their errors.
    """
    if style.options.sigma:
        return results_block(solution, position_indices, style)
    language = style.language
    columns, known = position_columns(solution, position_indices, language), list[str]()
    drawable = solution.origin.extents.drawable
    relative = [(one, [one.symbol]) for one in relative_series(solution, PlanKind.VELOCITY)]
    for series, symbols in (*_once(solution), *relative):
        column = value_column(
            series, position_indices, language.notation, sigma=False, is_single=False
        )
        column = replace(column, head=" = ".join(symbols))
        quantity = solution.legend.get(series.label)
        if quantity is None or _is_measured(solution, quantity):
            columns += [column, *_measured(series, column, position_indices, drawable, language)]
        elif len(set(column.cells)) > 1:
            columns.append(column)
        else:
            known.append(f"{column.head} = {_signed(column.cells[0])} {column.unit}")
    height = style.text(min(style.sizes.text, 3.5))
    title = style.entry.title or language.sheets.measured
    phrase = title.format(ruler=language.notation.as_input(solution.profile.ruler))
    below = [language.sheets.known.format(values="; ".join(known))] if known else []

    def table(width: float) -> Column:
        made = table_block(
            columns,
            TableForm(height, leading=2, row_height=2.0 * height),
            max_width=width,
            width=STAMP_WIDTH,
            title=phrase,
        )
        return Column([made, *(paragraph(note, height, made.width) for note in below)], 3.0)

    usual = table(table_width(style))
    if len(position_indices) <= FEW:
        return usual
    # Rows of many positions are high: one wide table, or half of it under the other.
    other = table(WIDE * style.inside)
    if (other.width, other.height) == (usual.width, usual.height):
        other = table(max(STAMP_WIDTH, HALF * usual.width))
    return usual if other.width == usual.width else Alternatives((usual, other))


def _is_measured(solution: Solution, quantity: Quantity) -> bool:
    """Return whether a quantity is read with the ruler: a vector's segment, or a number from it."""
    if quantity.size is None:
        return False
    if quantity.kind.is_number:
        return quantity.size in read_names(solution)
    step = solution.construction.step
    return any(isinstance(step(name), RULED) for name, _ in operands(step(quantity.size)))


@memoized
def read_names(solution: Solution) -> frozenset[Name]:
    """Return the names of a construction that depend on ruler readings."""
    found: set[Name] = set()
    for step in solution.construction.program.steps:
        if isinstance(step, RULED) or not found.isdisjoint(name for name, _ in operands(step)):
            found.add(step.out)
    return frozenset(found)


def _signed(cell: TableCell) -> str:
    """Return a value with its sign, which a table shows by an arrow."""
    return f"−{cell.text}" if (cell.sense or 0) < 0 else cell.text


def _once(solution: Solution) -> list[tuple[Series, list[str]]]:
    """Return the reported quantities with their symbols, joining those with the same number."""
    found: dict[tuple[object, ...], tuple[Series, list[str]]] = {}
    for one in motion_series(solution, *MOTION_KINDS):
        of = solution.legend[one.label]
        found.setdefault((of.kind, of.size), (one, []))[1].append(one.symbol)
    return list(found.values())


def _measured(
    series: Series,
    exact: TableColumn,
    position_indices: Sequence[int],
    drawable: NDArray[np.bool_],
    language: Language,
) -> list[TableColumn]:
    """Return the measured values and their deviations, %.

    A cell is "—" if the position is not drawn, or its deviation is undefined.
    """
    notation = language.notation
    drawn = [i for i in position_indices if drawable[i]]
    values, texts = series.displayed(series.read, drawn), series.measured_texts(drawn)
    cells = {
        i: TableCell(notation.number(text), series.sense(value))
        for i, text, value in zip(drawn, texts, values, strict=True)
    }
    read = tuple(cells.get(i, TableCell(DASH)) for i in position_indices)
    off = notation.numbers(
        *(
            series.measured(i).percent_text(limit=MAX_PERCENT) if i in cells else DASH
            for i in position_indices
        )
    )
    head = language.sheets.read_symbol.format(symbol=series.symbol)
    return [
        TableColumn(head, read, unit=exact.unit, joined=True),
        TableColumn("Δ", tuple(off), unit="%", min_width=9.0, joined=True),
    ]
