"""Table of what the plans of all positions give, beside the exact values (измеренное и точное).

Of every quantity: what is exact, what is measured, and how far off that is in per cent. What is the
same by nature stands once: ω₂ = ω₃ of a sliding pair. What was computed and laid off has nothing to
be compared: points that a proportion gives have their exact values alone, and what is the same in
all positions, as the velocity of the crank's pin, stands under the table.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from msgspec.structs import replace

from planmethod.construct.steps import Measure, MeasureAlong, Name, operands
from planmethod.note.narrate.given import told
from planmethod.note.numbers import alike, is_noise
from planmethod.plans.legend import MOTION_KINDS, Quantity
from planmethod.render.frame.frame import STAMP_WIDTH
from planmethod.render.layout.block import Block, Column, Shapes, paragraph
from planmethod.render.layout.tables import TableCell, TableColumn, table_block
from planmethod.render.sheets.model import Manner
from planmethod.render.sheets.results import MOST_OFF, position_columns, results_block, table_width
from planmethod.solved.reading import Reals, remembered
from planmethod.solved.room import FEW
from planmethod.solved.solution import Solution

WIDE = 0.72
"""Part of the paper's width that the table may take where rows of many positions are high."""

HALF = 0.6
"""Part of a table's width that is enough for half of its columns and those that are repeated."""

RULED = (Measure, MeasureAlong)
"""Steps that give what a ruler gives."""


def measured_table(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return of every quantity what is measured on the plans and what is exact, by positions.

    Where errors are asked for, the exact values with them.
    """
    if manner.extras.sigma:
        return results_block(solution, indices, manner)
    words = manner.words
    columns, known = position_columns(solution, indices, words), list[str]()
    for quantity, symbols in _once(told(solution, *MOTION_KINDS)):
        exact, symbol = solution.exact(quantity), " = ".join(symbols)
        column = _column(quantity, symbol, exact, exact, indices, manner)
        if _is_measured(solution, quantity):
            read = solution.read_off(quantity.label)
            symbol = words.sheets.read_symbol.format(symbol=symbols[0])
            measured = _column(quantity, symbol, read, exact, indices, manner)
            columns += [column, replace(measured, joined=True), _off(read, exact, indices, manner)]
        elif len(set(column.cells)) > 1:
            columns.append(column)
        else:
            known.append(f"{symbol} = {_signed(column.cells[0])} {column.unit}")
    height = manner.text(min(manner.sizes.text, 3.5))
    title = manner.entry.title or words.sheets.measured
    said = title.format(ruler=words.say.given(solution.profile.ruler))
    below = [words.sheets.known.format(values="; ".join(known))] if known else []

    def table(width: float) -> Column:
        made = table_block(columns, height, max_width=width, leading=2, row_height=2.0 * height,
                           title=said)  # fmt: skip
        return Column([made, *(paragraph(note, height, made.width) for note in below)], 3.0)

    usual = table(table_width(manner))
    if len(indices) <= FEW:
        return usual
    # Rows of many positions are high: one wide table, or half of it under the other.
    other = table(WIDE * manner.inside)
    if (other.width, other.height) == (usual.width, usual.height):
        other = table(max(STAMP_WIDTH, HALF * usual.width))
    return usual if other.width == usual.width else Shapes((usual, other))


def _is_measured(solution: Solution, quantity: Quantity) -> bool:
    """Tell whether the ruler gives a quantity: the segment of a vector, something of a number."""
    if quantity.size is None:
        return False
    if quantity.kind.is_number:
        return quantity.size in read_names(solution)
    step = solution.construction.step
    return any(isinstance(step(name), RULED) for name, _ in operands(step(quantity.size)))


@remembered
def read_names(solution: Solution) -> frozenset[Name]:
    """Return the names of a construction that hang on what the ruler gives."""
    found: set[Name] = set()
    for step in solution.construction.program.steps:
        if isinstance(step, RULED) or not found.isdisjoint(name for name, _ in operands(step)):
            found.add(step.out)
    return frozenset(found)


def _signed(cell: TableCell) -> str:
    """Return a value with its sign, which a table shows by an arrow."""
    return f"−{cell.text}" if (cell.sense or 0) < 0 else cell.text


def _once(quantities: Sequence[Quantity]) -> list[tuple[Quantity, list[str]]]:
    """Return quantities with their symbols, those that one number stands for together."""
    found: dict[tuple[object, ...], tuple[Quantity, list[str]]] = {}
    for quantity in quantities:
        found.setdefault((quantity.kind, quantity.size), (quantity, []))[1].append(quantity.symbol)
    return list(found.values())


def _off(read: Reals, exact: Reals, indices: Sequence[int], manner: Manner) -> TableColumn:
    """Return how far off what is measured is, %; "—" where there is nothing to be off from."""
    peak, cells = max(abs(float(value)) for value in exact), []
    for i in indices:
        nothing = is_noise(float(exact[i]), peak)
        off = inf if nothing else 100.0 * float(read[i] - exact[i]) / abs(float(exact[i]))
        shown = f"{round(off, 1) + 0.0:.1f}" if abs(off) < MOST_OFF else "—"
        cells.append(manner.words.say.number(shown))
    return TableColumn("Δ", tuple(cells), unit="%", least=9.0, joined=True)


def _column(
    quantity: Quantity,
    symbol: str,
    values: Reals,
    exact: Reals,
    indices: Sequence[int],
    manner: Manner,
) -> TableColumn:
    """Return the values of a quantity with as many decimals as its exact ones have.

    Of what is measured no zeros stand that all of them end with: the ruler has no such digits.
    """
    say, peak = manner.words.say, max(abs(float(value)) for value in exact)
    shown = [float(values[i]) for i in indices]
    shown = [0.0 if is_noise(value, peak) else value for value in shown]
    turns, texts = quantity.kind.is_number, alike([abs(value) for value in shown])
    texts = texts if values is exact else _without_zeros(texts)
    cells = tuple(
        TableCell(say.number(text), ((value > 0) - (value < 0)) if turns else None)
        for text, value in zip(texts, shown, strict=True)
    )
    return TableColumn(symbol, cells, unit=say.units[quantity.kind.unit])


def _without_zeros(texts: Sequence[str]) -> list[str]:
    """Return decimal numbers without the zeros that all of them end with; a plain 0 has none.

    >>> _without_zeros(["0.05700", "0.06200", "0"])
    ['0.057', '0.062', '0']
    """
    some = [text for text in texts if "." in text and "e" not in text]
    if len(some) < sum(text != "0" for text in texts):
        return list(texts)
    spare = min((len(text) - len(text.rstrip("0")) for text in some), default=0)
    return [text[: len(text) - spare].removesuffix(".") if text in some else text for text in texts]
