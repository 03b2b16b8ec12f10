"""Table of what the plans of all positions give, beside the exact values (измеренное и точное).

Of every quantity: what is exact, what is measured, and how far off that is in per cent.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from msgspec.structs import replace

from planmethod.note.narrate.given import told
from planmethod.note.numbers import alike, is_noise
from planmethod.plans.legend import MOTION_KINDS, Quantity
from planmethod.render.layout.block import Block, shaped
from planmethod.render.layout.tables import TableCell, TableColumn, table_block
from planmethod.render.sheets.model import Manner
from planmethod.render.sheets.results import MOST_OFF, position_columns, results_block, table_width
from planmethod.solved.reading import Reals
from planmethod.solved.room import FEW
from planmethod.solved.solution import Solution

WIDE = 0.72
"""Part of the paper's width that the table may take where rows of many positions are high."""


def measured_table(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return of every quantity what is measured on the plans and what is exact, by positions.

    Where errors are asked for, the exact values with them.
    """
    if manner.extras.sigma:
        return results_block(solution, indices, manner)
    words = manner.words
    columns = position_columns(solution, indices, words)
    for quantity in told(solution, *MOTION_KINDS):
        exact, read = solution.exact(quantity), solution.read_off(quantity.label)
        columns.append(_column(quantity, quantity.symbol, exact, exact, indices, manner))
        symbol = words.sheets.read_symbol.format(symbol=quantity.symbol)
        measured = _column(quantity, symbol, read, exact, indices, manner)
        columns.append(replace(measured, joined=True))
        columns.append(_off(read, exact, indices, manner))
    height = manner.text(min(manner.sizes.text, 3.5))
    title = manner.entry.title or words.sheets.measured
    said, usual = title.format(ruler=words.say.given(solution.profile.ruler)), table_width(manner)
    wide = max(usual, WIDE * manner.inside) if len(indices) > FEW else usual
    return shaped(
        table_block(columns, height, max_width=width, leading=2, row_height=2.0 * height,
                    title=said)
        for width in dict.fromkeys((usual, wide))
    )  # fmt: skip


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
    """Return the values of a quantity with as many decimals as its exact ones have."""
    say, peak = manner.words.say, max(abs(float(value)) for value in exact)
    shown = [float(values[i]) for i in indices]
    shown = [0.0 if is_noise(value, peak) else value for value in shown]
    turns = quantity.kind.is_number
    cells = tuple(
        TableCell(say.number(text), ((value > 0) - (value < 0)) if turns else None)
        for text, value in zip(alike([abs(value) for value in shown]), shown, strict=True)
    )
    return TableColumn(symbol, cells, unit=say.units[quantity.kind.unit])
