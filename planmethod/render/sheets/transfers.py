"""Blocks of the transfer functions: formulas through segments, table (передаточные функции)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from planmethod.note.document import Caption, Formula
from planmethod.note.narrate.formulas import Formulas
from planmethod.note.narrate.naming import Names
from planmethod.note.narrate.transfers import TransferNarrator
from planmethod.note.numbers import alike, is_noise, to_decimals
from planmethod.note.rounding import sigma_text
from planmethod.note.tables.sigmas import marked
from planmethod.plans.legend import Quantity
from planmethod.plans.model import PlanKind
from planmethod.render.layout.block import Block, Column, Row, Shapes, paragraph
from planmethod.render.layout.nodes import blocks_of
from planmethod.render.layout.tables import TableColumn, table_block
from planmethod.render.sheets.model import Manner
from planmethod.render.sheets.results import MOST_OFF, position_columns, table_width, with_note
from planmethod.render.sheets.views import shown_position
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.solution import Solution
from planmethod.solved.transfers import Transfers, transfers_of


def formulas_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the formulas of what a plan gives; of many positions those of one."""
    kind, transfers, said = manner.entry.of, transfers_of(solution), manner.words.sheets
    assert kind is not None
    if transfers is None:
        return Column([])
    index = shown_position(solution, indices, manner)
    names = Names(solution, manner.words.note, on_sheet=True)
    told = TransferNarrator(Formulas(solution, names, index), transfers)
    height, width = manner.text(min(3.5, manner.sizes.text)), manner.width(manner.sizes.column)
    title = manner.entry.title or said["transfers"][kind.value]
    if len(solution.positions) > 1:
        title = said.of_position.format(title=title, number=index)
    blocks = list(blocks_of([Caption(title)], height))
    formula, *sentence = (told.carried() if kind is PlanKind.ACCELERATION else []) or [""]
    if formula:
        blocks += blocks_of([Formula(formula)], height)
        blocks += [paragraph(text, height, width) for text in sentence]
    blocks += blocks_of(map(Formula, told.formulas(kind)), height)
    whole, half = Column(blocks, gap=2.2), -(-len(blocks) // 2)
    parts = [Column(some, gap=2.2) for some in (blocks[:half], blocks[half:])]
    return Shapes((whole, Row(parts, gap=2.0 * height)))


def transfer_table(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the table by positions; of one alone what is exact, what is read, and its error."""
    transfers, words = transfers_of(solution), manner.words
    if transfers is None:
        return Column([])
    alone = len(solution.positions) == 1
    columns = [
        _column(transfers, one, indices, manner, alone=alone) for one in transfers.quantities
    ]
    said, height = words.sheets, manner.text(min(manner.sizes.text, 3.5))
    lead = position_columns(solution, indices, words)
    if alone:
        lead = [TableColumn("", (said.exact, said.read, "Δ, %", "±σ"))]
    table = table_block(
        [*lead, *columns],
        height,
        max_width=table_width(manner),
        leading=len(lead),
        title=manner.entry.title or said.transfer_table,
    )
    if not alone:
        return table
    return with_note(table, columns, height, solution.profile.name, words)


def _column(
    transfers: Transfers, quantity: Quantity, indices: Sequence[int], manner: Manner, *, alone: bool
) -> TableColumn:
    """Return the values of a transfer function, ratios with their sign."""
    say, every = manner.words.say, transfers.exact(quantity)
    peak = float(np.max(np.abs(every), initial=0.0))
    exact = [0.0 if is_noise(float(every[i]), peak) else float(every[i]) for i in indices]
    cells = texts = alike(exact)
    if alone:
        index, value = indices[0], exact[0]
        read = float(transfers.read_off(quantity)[index])
        sigma, mark = marked(drafting_of(transfers.solution), quantity.label, index)
        off = 100.0 * (read - value) / value if abs(value) > sigma else np.inf
        decimals = len(texts[0].partition(".")[2])
        cells = [
            texts[0],
            to_decimals(read, decimals),
            f"{round(off, 1) + 0.0:.1f}" if abs(off) < MOST_OFF else "—",
            sigma_text(sigma) + mark,
        ]
    unit = "" if quantity.kind.unit == "1" else say.units[quantity.kind.unit]
    return TableColumn(quantity.symbol, tuple(map(say.number, cells)), unit=unit)
