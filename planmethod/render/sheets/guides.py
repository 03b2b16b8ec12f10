"""Reactions of the guides in the table of a sheet: their places, and those at the edges."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.note.narrate.statement import point_name
from planmethod.note.numbers import Notation, format_column
from planmethod.note.wording import Language
from planmethod.plans.forces.polygons import reaction_symbol
from planmethod.render.layout.block import Block
from planmethod.render.layout.tables import TableCell, TableColumn, table_block
from planmethod.render.symbols import angle_of
from planmethod.solved.forces.guides import Guided, guides
from planmethod.solved.forces.reading import ForceReading

_DASH = "—"


def angle_text(force: complex, notation: Notation) -> str:
    """Return the angle of a force from +x, degrees in [0, 360)."""
    return notation.number(f"{round(angle_of(force), 1) % 360.0 + 0.0:.1f}")


def place_columns(reading: ForceReading, notation: Notation) -> list[TableColumn]:
    """Return the distance l of each reaction from its joint, m, and moments without a force.

    There are cells for all reactions in their order; empty columns are left out.
    """
    numbers = range(len(reading.statics.reactions))
    found = [guided_at(reading, number) for number in numbers]
    columns = []
    if any(one is not None and one.b is not None for one in found):
        columns.append(
            TableColumn(
                f"l_{{ij}}, {notation.units['m']}", tuple(_distance(one, notation) for one in found)
            )
        )
    if any(is_couple(one) for one in found):
        columns.append(
            TableColumn(
                f"M_{{ij}}, {notation.units['N·m']}", tuple(_moment(one, notation) for one in found)
            )
        )
    return columns


def guided_at(reading: ForceReading, number: int) -> Guided | None:
    """Return the reaction of a guide; None of a hinge."""
    joint = reading.statics.reactions[number]
    called = reading.solution.problem.mechanism.called
    one = guides(reading).get(reaction_symbol(joint.on, called(joint.by)))
    return one if one is not None and one.number == number else None


def _distance(one: Guided | None, notation: Notation) -> str:
    if one is None or one.b is None:
        return _DASH
    return notation.computed(abs(one.b)) if one.b else "0"


def is_couple(one: Guided | None) -> bool:
    """Return whether a guide has a moment and no force."""
    return one is not None and one.is_negligible and not one.is_no_couple


def _moment(one: Guided | None, notation: Notation) -> TableCell:
    if one is None or not is_couple(one):
        return TableCell(_DASH)
    moment = float(one.contact.joint.moment[one.reading.index])
    return TableCell(notation.computed(abs(moment)), 1 if moment > 0 else -1)


def edges_table(
    reading: ForceReading, height: float, width: float, language: Language
) -> Block | None:
    """Return the table of the reactions at the edges of sliders; None where there are none."""
    found = [guided_at(reading, number) for number in reading.statics.contacts]
    bearing = [one for one in found if one is not None and one.edges]
    if not bearing:
        return None
    called = reading.solution.problem.mechanism.called
    pairs = tuple(
        f"{point_name(one.contact.joint.joint)} ({one.on}–{called(one.by)})" for one in bearing
    )
    texts, notation = language.sheets, language.notation
    lengths = tuple(notation.short(one.contact.length or 0.0) for one in bearing)
    columns = [
        TableColumn(texts.joint, pairs),
        TableColumn(f"a_{{ij}}, {notation.units['m']}", lengths),
    ]
    for number, primes in enumerate(("'", "''")):
        columns += _edge_columns(primes, [one.edges[number].force for one in bearing], notation)
    return table_block(columns, height, width=width, units="none", title=texts.reactions_edges)


def _edge_columns(primes: str, forces: Sequence[complex], notation: Notation) -> list[TableColumn]:
    sizes = tuple(map(notation.number, format_column([abs(force) for force in forces])))
    return [
        TableColumn(f"F^{{{primes}}}_{{ij}}, {notation.units['N']}", sizes),
        TableColumn(
            f"φ^{{{primes}}}_{{ij}}, {notation.in_head('deg')}",
            tuple(angle_text(force, notation) for force in forces),
        ),
    ]
