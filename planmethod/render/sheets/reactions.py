"""Table of reactions of a sheet, and of the driver's balance (таблица реакций).

With drafting errors it has the read sizes and one sigma of every size, direction and moment.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from planmethod.note.compared import DASH, Series
from planmethod.note.force_series import (
    angle_series,
    balance_series,
    lever_beside_plans,
    lever_series,
    moment_series,
    size_series,
)
from planmethod.note.narrate.statement import point_name
from planmethod.note.numbers import Notation, format_column
from planmethod.note.rounding import as_long, sigma_text
from planmethod.note.wording import Language
from planmethod.plans.forces.polygons import reaction_symbol
from planmethod.render.frame.frame import STAMP_WIDTH
from planmethod.render.layout.block import Block, Column
from planmethod.render.layout.tables import TableCell, TableColumn, table_block
from planmethod.render.sheets.guides import (
    angle_text,
    edges_table,
    guided_at,
    is_couple,
    place_columns,
)
from planmethod.render.sheets.model import BlockStyle
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
    sigma, language = bool(style.options.sigma), style.language
    columns = reaction_columns(reading, language, sigma=sigma)
    texts = language.sheets
    title = style.entry.title or (texts.reactions if sigma else texts.reactions_exact)
    table = table_block(columns, height, width=width, units="none", title=title)
    edges = edges_table(reading, height, width, language)
    further = [] if edges is None else [edges]
    balances = balance_columns(reading, language, sigma=sigma)
    below = table_block(balances, height, width=width, units="none")
    tables = Column([table, *further, below], gap=4.0)
    if not sigma:
        return tables
    return with_note(tables, [*columns, *balances], height, solution.profile.name, language)


def reaction_columns(
    reading: ForceReading, language: Language, *, sigma: bool
) -> list[TableColumn]:
    """Return the columns of the reactions; sizes have no fewer decimals than their errors."""
    statics, index, notation = reading.statics, reading.index, language.notation
    reactions, called = statics.reactions, reading.solution.problem.mechanism.called
    every = [size_series(statics, one) for one in reactions]
    forces = [complex(one.force[index]) for one in reactions]
    none = [abs(force) <= NEGLIGIBLE_FRACTION * reading.peak for force in forces]
    shown = format_column(
        [0.0 if nil else abs(force) for force, nil in zip(forces, none, strict=True)]
    )
    errors = partial(sigma_column, index=index, notation=notation)
    places, more = place_columns(reading, notation), list[TableColumn]()
    if sigma:
        shown = [
            as_long(text, abs(force), one.error(index)[0])
            for text, force, one in zip(shown, forces, every, strict=True)
        ]
        read = tuple(notation.number(one[index].rounded_text) for one in every)
        more = [
            TableColumn(f"{language.sheets.read}, {notation.units['N']}", read),
            errors(every, "N"),
        ]
    pairs = list(zip(reactions, forces, none, strict=True))
    columns = [
        TableColumn(
            language.sheets.joint,
            tuple(f"{point_name(one.joint)} ({one.on}–{called(one.by)})" for one in reactions),
        ),
        TableColumn("F_{ij}", tuple(reaction_symbol(one.on, called(one.by)) for one in reactions)),
        TableColumn(f"F_{{ij}}, {notation.units['N']}", tuple(map(notation.number, shown))),
        *more,
        TableColumn(
            f"φ_{{ij}}, {notation.in_head('deg')}",
            tuple(DASH if nil else angle_text(force, notation) for _, force, nil in pairs),
        ),
    ]
    if not sigma:
        return [*columns, *places]
    angles = [None if nil else angle_series(statics, one) for one, _, nil in pairs]
    columns += [errors(angles, "deg"), *places]
    if any(column.head.startswith("M_") for column in places):
        columns.append(errors([_couple(reading, k) for k in range(len(reactions))], "N·m"))
    return columns


def _couple(reading: ForceReading, number: int) -> Series | None:
    """Return the moment of a reaction that has no force; None of others, which have no cell."""
    if not is_couple(guided_at(reading, number)):
        return None
    return moment_series(reading.statics, reading.statics.reactions[number])


def sigma_column(
    every: Sequence[Series | None], unit: str, *, index: int, notation: Notation
) -> TableColumn:
    """Return the column of one sigma of each quantity in a position; a dash for none."""
    cells = tuple(DASH if one is None else one[index].sigma_text for one in every)
    return TableColumn(f"±σ, {notation.in_head(unit)}", tuple(map(notation.number, cells)))


def balance_columns(reading: ForceReading, language: Language, *, sigma: bool) -> list[TableColumn]:
    """Return the driver's balancing force or moment: exact, by both methods, their difference.

    With ``sigma`` they have a row of errors; that of the difference is in per cent of the force
    plans, too, and numbers that were read end with the place of their error.
    """
    texts, notation, index = language.sheets, language.notation, reading.index
    plans, lever, both = (
        make(reading.statics) for make in (balance_series, lever_series, lever_beside_plans)
    )
    assert plans is not None
    exact, difference = float(plans.exact[index]), None if both is None else both[index]

    def column(head: str, value: float | None, series: Series | None = None) -> TableColumn:
        """Return a number without its sign, which a sense beside it has, and its error."""
        text, error, sense = DASH, DASH, None
        if value is not None:
            text = notation.computed(abs(value))
            sense = plans.sense(value) if value else None
        if sigma and series is not None:
            text, error = notation.numbers(series[index].size_text, series[index].sigma_text)
        cells = TableCell(text, sense), TableCell(error, None if sense is None else 0)
        return TableColumn(head, cells if sigma else cells[:1])

    read = None if lever is None else float(lever.read[index])
    share = error = DASH
    if difference is not None:
        share = notation.number(difference.percent_text())
        if difference.percent is not None and difference.expected is not None:
            error = notation.number(sigma_text(difference.expected)) + difference.mark
    columns = [
        column(plans.head(notation), exact),
        column(texts.by_plans, float(plans.read[index]), plans),
        column(texts.by_lever, read, lever),
        TableColumn(texts.difference, (share, error) if sigma else (share,)),
    ]
    return [TableColumn("", (texts.value, "±σ")), *columns] if sigma else columns
