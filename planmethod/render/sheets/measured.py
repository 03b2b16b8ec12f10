"""Table of values measured on the plans of all positions, and exact values (измеренное и точное).

Every quantity has the exact value, the measured one, and the deviation in per cent. Quantities
equal by nature appear once: ω₂ = ω₃ of a sliding pair. Values that were computed and laid off are
not compared: points given by a proportion have only exact values, and values that are the same in
all positions, such as the velocity of the crank's pin, are listed under the table.
"""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from planmethod.construct.steps import Measure, MeasureAlong, Name, operands
from planmethod.note.compared import MAX_PERCENT, Series
from planmethod.note.tables.series import motion_series
from planmethod.note.wording import Language
from planmethod.plans.legend import MOTION_KINDS, Quantity
from planmethod.render.frame.frame import STAMP_WIDTH
from planmethod.render.layout.block import Alternatives, Block, Column, paragraph
from planmethod.render.layout.tables import TableCell, TableColumn, table_block
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.results import (
    position_columns,
    results_block,
    table_width,
    value_column,
)
from planmethod.solved.reading import memoized
from planmethod.solved.sheet_estimate import FEW
from planmethod.solved.solution import Solution

WIDE = 0.72
"""Part of the paper's width for the table when rows of many positions are high."""

HALF = 0.6
"""Part of a table's width that suffices for half of its columns and the repeated ones."""

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
    for series, symbols in _once(solution):
        column = value_column(
            series, position_indices, language.notation, sigma=False, is_single=False
        )
        column = replace(column, head=" = ".join(symbols))
        if _is_measured(solution, solution.legend[series.label]):
            columns += [column, *_measured(series, column, position_indices, language)]
        elif len(set(column.cells)) > 1:
            columns.append(column)
        else:
            known.append(f"{column.head} = {_signed(column.cells[0])} {column.unit}")
    height = style.text(min(style.sizes.text, 3.5))
    title = style.entry.title or language.sheets.measured
    phrase = title.format(ruler=language.notation.as_input(solution.profile.ruler))
    below = [language.sheets.known.format(values="; ".join(known))] if known else []

    def table(width: float) -> Column:
        made = table_block(columns, height, max_width=width, leading=2, row_height=2.0 * height,
                           title=phrase)  # fmt: skip
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
    series: Series, exact: TableColumn, position_indices: Sequence[int], language: Language
) -> list[TableColumn]:
    """Return the measured values and their deviations, %; "—" where a deviation is undefined."""
    notation, values = language.notation, series.displayed(series.read, position_indices)
    read = tuple(
        TableCell(notation.number(text), series.sense(value))
        for text, value in zip(series.measured_texts(position_indices), values, strict=True)
    )
    off = notation.numbers(
        *(series.measured(i).percent_text(limit=MAX_PERCENT) for i in position_indices)
    )
    head = language.sheets.read_symbol.format(symbol=series.symbol)
    return [
        TableColumn(head, read, unit=exact.unit, joined=True),
        TableColumn("Δ", tuple(off), unit="%", min_width=9.0, joined=True),
    ]
