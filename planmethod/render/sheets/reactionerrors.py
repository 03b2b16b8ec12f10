"""Drafting errors in the table of reactions: read values, and sigmas (погрешности построения)."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.note.compared import DASH, marked
from planmethod.note.narrate.forces.lever import compared_balances
from planmethod.note.numbers import Notation
from planmethod.note.rounding import as_long, rounded_to, sigma_text
from planmethod.note.wording import Language
from planmethod.render.layout.tables import TableCell, TableColumn
from planmethod.render.sheets.guides import guided_at, is_couple
from planmethod.solved.errors.forces import (
    BALANCE,
    LEVER,
    angle_label,
    drawn_forces,
    moment_label,
    size_label,
)
from planmethod.solved.forces.reading import ForceReading


def sigma_cell(reading: ForceReading, label: str | None, notation: Notation) -> str:
    """Return the error of a quantity in the position, with its mark; a dash without one."""
    if label is None or label not in drawn_forces(reading.statics).items:
        return DASH
    sigma, mark = marked(drawn_forces(reading.statics), label, reading.index)
    return notation.number(sigma_text(sigma)) + mark


def read_text(reading: ForceReading, label: str, notation: Notation) -> str:
    """Return the value read on the drawing, to the place of its error, without its sign."""
    sigma, _ = marked(drawn_forces(reading.statics), label, reading.index)
    return notation.number(rounded_to(abs(read_value(reading, label)), sigma))


def read_value(reading: ForceReading, label: str) -> float:
    """Return the value read on the drawing, N or N·m."""
    return float(drawn_forces(reading.statics).read(label)[reading.index])


def sizes_as_long(reading: ForceReading, texts: Sequence[str]) -> list[str]:
    """Return the sizes of the reactions, each with no fewer decimals than its error has."""
    errors, index = drawn_forces(reading.statics), reading.index
    return [
        as_long(text, abs(complex(one.force[index])), marked(errors, size_label(one), index)[0])
        for one, text in zip(reading.statics.reactions, texts, strict=True)
    ]


def size_columns(reading: ForceReading, language: Language) -> list[TableColumn]:
    """Return the columns of the read sizes of the reactions, and of their errors."""
    labels = [size_label(one) for one in reading.statics.reactions]
    notation, unit = language.notation, language.notation.units["N"]
    return [
        TableColumn(
            f"{language.sheets.read}, {unit}",
            tuple(read_text(reading, one, notation) for one in labels),
        ),
        TableColumn(f"±σ, {unit}", tuple(sigma_cell(reading, one, notation) for one in labels)),
    ]


def angle_column(
    reading: ForceReading, undirected: Sequence[bool], notation: Notation
) -> TableColumn:
    """Return the column of the directions' errors; ``undirected`` reactions have no direction."""
    pairs = zip(reading.statics.reactions, undirected, strict=True)
    labels = [None if nil else angle_label(one) for one, nil in pairs]
    return TableColumn(
        f"±σ, {notation.in_head('deg')}",
        tuple(sigma_cell(reading, label, notation) for label in labels),
    )


def moment_column(reading: ForceReading, notation: Notation) -> TableColumn:
    """Return the column of the errors of the moments in the table: those without a force."""
    found = [guided_at(reading, k) for k in range(len(reading.statics.reactions))]
    pairs = zip(reading.statics.reactions, found, strict=True)
    labels = [moment_label(one) if is_couple(guided) else None for one, guided in pairs]
    unit = notation.units["N·m"]
    return TableColumn(
        f"±σ, {unit}", tuple(sigma_cell(reading, label, notation) for label in labels)
    )


def balance_columns(
    reading: ForceReading, columns: Sequence[TableColumn], language: Language
) -> list[TableColumn]:
    """Return the table of the balances with a row of errors.

    ``columns``: exact, by the force plans, by the lever, and the discrepancy in per cent of the
    force plans, in which its error is, too.
    """
    notation = language.notation
    exact, plans, lever, share = columns
    found = [_with_error(reading, *pair, notation) for pair in ((plans, BALANCE), (lever, LEVER))]
    both = compared_balances(reading.statics, reading.index)
    off = DASH
    if both is not None and both.percent is not None and both.expected is not None:
        off = notation.number(sigma_text(both.expected)) + both.mark
    return [
        TableColumn("", (language.sheets.value, "±σ")),
        TableColumn(exact.head, (exact.cells[0], _matching_cell(exact, DASH))),
        *found,
        TableColumn(share.head, (share.cells[0], off)),
    ]


def _with_error(
    reading: ForceReading, column: TableColumn, label: str, notation: Notation
) -> TableColumn:
    """Return the column of a balance to the place of its error, and the error."""
    value = column.cells[0]
    if label in drawn_forces(reading.statics).items:
        value = TableCell(read_text(reading, label, notation), value.sense)
    return TableColumn(
        column.head, (value, _matching_cell(column, sigma_cell(reading, label, notation)))
    )


def _matching_cell(column: TableColumn, text: str) -> TableCell:
    """Return a cell that keeps space for the sign of a sense if the column has one."""
    return TableCell(text, None if column.cells[0].sense is None else 0)
