"""Blocks of the superposition: velocity plans of each driver alone, and of all (наложение)."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from planmethod.errors import LayoutError
from planmethod.note.document import Table
from planmethod.note.tables.superposition import superposition_table
from planmethod.plans.model import PlanKind
from planmethod.render.layout.block import Block, Column, heading, paragraph
from planmethod.render.layout.text_blocks import TableColumn, TableForm, table_block
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.results import table_width
from planmethod.render.sheets.views import plan_view, shown_position
from planmethod.solved.solution import Solution
from planmethod.solved.superposition import parts_by_driver


def plans_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the velocity plans of one position in which one driver moves, all at one scale."""
    _require_drivers(solution)
    index, said = shown_position(solution, position_indices, style), style.language.sheets
    called, plans = solution.problem.mechanism.called, list[Block]()
    for link, part in parts_by_driver(solution).items():
        title = said["superposition"]["alone"].format(link=called(link))
        own = replace(style, entry=replace(style.entry, of=PlanKind.VELOCITY, title=title))
        plans.append(plan_view(part.drawn_at(solution.scales), (index,), own))
    return Column(plans, gap=6.0)


def table_blocks(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return how velocities add up, and the table of their parts and sums, of one position."""
    _require_drivers(solution)
    index, height = shown_position(solution, position_indices, style), style.text(3.5)
    width, said = style.width(style.sizes.column), style.language.sheets["superposition"]
    table: Table = superposition_table(solution, style.language.note, index)
    columns = [TableColumn(head, cells) for head, cells in table.columns()]
    return Column(
        [
            heading(style.entry.title or said["title"].format(), height, width=width),
            paragraph(said["method"].format(), height, width),
            table_block(columns, TableForm(height, leading=1), max_width=table_width(style)),
        ],
        gap=3.0,
    )


def _require_drivers(solution: Solution) -> None:
    if not solution.problem.drive.other_drives:
        raise LayoutError(
            "{}: velocities are superposed of mechanisms with several drivers. Give [[drivers]], "
            "or choose another layout.",
            solution.problem.name,
        )
