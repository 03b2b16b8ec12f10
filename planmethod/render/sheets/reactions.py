"""Table of reactions of a sheet, and of the driver's balance (таблица реакций)."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.note.compared import DASH, sense_of
from planmethod.note.narrate.forces.lever import both_balances, compared_balances
from planmethod.note.narrate.statement import point_name
from planmethod.note.numbers import format_column
from planmethod.note.wording import Language
from planmethod.plans.forces.polygons import reaction_symbol
from planmethod.render.frame.frame import STAMP_WIDTH
from planmethod.render.layout.block import Block, Column
from planmethod.render.layout.tables import TableCell, TableColumn, table_block
from planmethod.render.sheets.guides import angle_text, edges_table, place_columns
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.reactionerrors import (
    angle_column,
    balance_columns,
    moment_column,
    size_columns,
    sizes_as_long,
)
from planmethod.render.sheets.results import table_width, with_note
from planmethod.render.sheets.views import shown_position
from planmethod.solved.forces.reading import NEGLIGIBLE_FRACTION, ForceReading, force_reading
from planmethod.solved.solution import Solution


def reactions_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the table of reactions, and the balancing moment by both methods."""
    reading = force_reading(solution, shown_position(solution, position_indices, style))
    height = style.text(style.sizes.text)
    width = table_width(style, STAMP_WIDTH)
    reactions, index = reading.statics.reactions, reading.index
    called = solution.problem.mechanism.called
    sizes = [abs(complex(one.force[index])) for one in reactions]
    none = [size <= NEGLIGIBLE_FRACTION * reading.peak for size in sizes]
    shown = format_column([0.0 if nil else size for size, nil in zip(sizes, none, strict=True)])
    sigma, language = style.options.sigma, style.language
    texts, notation = language.sheets, language.notation
    shown = sizes_as_long(reading, shown) if sigma else shown
    angles = [angle_text(complex(one.force[index]), notation) for one in reactions]
    columns = [
        TableColumn(
            texts.joint,
            tuple(f"{point_name(one.joint)} ({one.on}–{called(one.by)})" for one in reactions),
        ),
        TableColumn("F_{ij}", tuple(reaction_symbol(one.on, called(one.by)) for one in reactions)),
        TableColumn(f"F_{{ij}}, {notation.units['N']}", tuple(map(notation.number, shown))),
        *(size_columns(reading, language) if sigma else []),
        TableColumn(
            f"φ_{{ij}}, {notation.in_head('deg')}",
            tuple("—" if nil else a for a, nil in zip(angles, none, strict=True)),
        ),
        *([angle_column(reading, none, notation)] if sigma else []),
    ]
    places = place_columns(reading, notation)
    if sigma and any(column.head.startswith("M_") for column in places):
        places.append(moment_column(reading, notation))
    columns += places
    title = style.entry.title or (texts.reactions if sigma else texts.reactions_exact)
    table = table_block(columns, height, width=width, units="none", title=title)
    edges = edges_table(reading, height, width, language)
    further = [] if edges is None else [edges]
    balances = exact_balance_columns(reading, language)
    if sigma:
        balances = balance_columns(reading, balances, language)
    below = table_block(balances, height, width=width, units="none")
    tables = Column([table, *further, below], gap=4.0)
    if not sigma:
        return tables
    return with_note(tables, [*columns, *balances], height, solution.profile.name, language)


def exact_balance_columns(reading: ForceReading, language: Language) -> list[TableColumn]:
    """Return the columns of the driver's balancing force or moment, by both methods."""
    texts, notation = language.sheets, language.notation
    symbol = notation.symbol(reading.balancing_symbol)
    unit = notation.units[reading.balancing.unit]
    exact = float(reading.statics.balance[reading.index])
    plans, lever = both_balances(reading)
    both = compared_balances(reading.statics, reading.index)
    share = DASH if both is None else notation.number(both.percent_text())
    turns = reading.balancing.turns

    def cell(value: float | None) -> TableCell:
        if value is None:
            return TableCell(DASH)
        return TableCell(
            notation.computed(abs(value)), sense_of(value) if turns and value else None
        )

    return [
        TableColumn(f"{symbol}, {unit}", (cell(exact),)),
        TableColumn(texts.by_plans, (cell(plans),)),
        TableColumn(texts.by_lever, (cell(lever),)),
        TableColumn(texts.difference, (TableCell(share),)),
    ]
