"""Blocks of the transfer functions: formulas through segments, table (передаточные функции)."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.note.document import Caption, Formula
from planmethod.note.narrate.formulas import Formulas
from planmethod.note.narrate.naming import Names
from planmethod.note.narrate.transfers import TransferNarrator
from planmethod.note.tables.series import transfer_series
from planmethod.plans.model import PlanKind
from planmethod.render.layout.block import Alternatives, Block, Column, Row, paragraph
from planmethod.render.layout.nodes import blocks_of
from planmethod.render.layout.tables import table_block
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.results import columns_of, table_width, with_note
from planmethod.render.sheets.views import shown_position
from planmethod.solved.solution import Solution
from planmethod.solved.transfers import transfers_of


def formulas_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the transfer functions' formulas from a plan, of one position only."""
    kind, transfers, texts = style.entry.of, transfers_of(solution), style.language.sheets
    assert kind is not None
    if transfers is None:
        return Column([])
    index = shown_position(solution, position_indices, style)
    names = Names(solution, style.language.note, on_sheet=True)
    told = TransferNarrator(Formulas(solution, names, index), transfers)
    height, width = style.text(min(3.5, style.sizes.text)), style.width(style.sizes.column)
    title = style.entry.title or texts["transfers"][kind.value]
    if len(solution.positions) > 1:
        title = texts.of_position.format(title=title, number=index)
    blocks = list(blocks_of([Caption(title)], height))
    formula, *sentence = (
        told.crank_acceleration_lines() if kind is PlanKind.ACCELERATION else []
    ) or [""]
    if formula:
        blocks += blocks_of([Formula(formula)], height)
        blocks += [paragraph(text, height, width) for text in sentence]
    blocks += blocks_of(map(Formula, told.formulas(kind)), height)
    whole, half = Column(blocks, gap=2.2), -(-len(blocks) // 2)
    parts = [Column(some, gap=2.2) for some in (blocks[:half], blocks[half:])]
    return Alternatives((whole, Row(parts, gap=2.0 * height)))


def transfer_table(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the table by positions; of a single one exact and read values with errors."""
    transfers, language = transfers_of(solution), style.language
    if transfers is None:
        return Column([])
    alone, texts = len(solution.positions) == 1, language.sheets
    columns = columns_of(
        transfer_series(transfers), solution, position_indices, language, sigma=alone
    )
    height = style.text(min(style.sizes.text, 3.5))
    table = table_block(
        columns,
        height,
        max_width=table_width(style),
        leading=1 if alone else 2,
        title=style.entry.title or texts.transfer_table,
    )
    if not alone:
        return table
    return with_note(table, columns, height, solution.profile.name, language)
