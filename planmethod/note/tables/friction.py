"""Friction in the record, on the terminal and in spreadsheets (трение в таблицах)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from planmethod.note.columnar import Column, ColumnarRecords, list_of, record_of
from planmethod.note.columns import numbers_or_none, sizes
from planmethod.note.document import Caption, Node, Note
from planmethod.note.narrate.forces.common import ForceContext
from planmethod.note.narrate.forces.friction import FrictionNarrator
from planmethod.note.narrate.formulas import Formulas
from planmethod.note.narrate.naming import Names
from planmethod.note.wording import Language
from planmethod.solved.efficiency import CycleEfficiency
from planmethod.solved.forces.friction import (
    Friction,
    FrictionPair,
    RubbedForces,
    friction_of,
)
from planmethod.solved.forces.reading import force_reading
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution


def friction_records(solution: Solution) -> ColumnarRecords:
    """Return the friction of every position as plain data, N, N·m and W.

    ``pairs`` are all of them, with the whole reaction, that along a guide with it, and its
    friction, ``once`` corrected and ``converged``: friction in one pair changes the reactions of
    the others, which may have none of their own (``f`` 0).
    ``change`` is the relative difference of the first from the second.
    """
    friction, count = friction_of(solution), len(solution.positions)
    quantity = solution.problem.drive.balancing.quantity
    columns: dict[str, Column | ColumnarRecords] = {
        "pairs": list_of([_pair(friction, pair, count) for pair in friction.every], count),
        "driving": record_of(
            {
                key: record_of(
                    {
                        quantity: numbers_or_none(forces.balance),
                        "power": numbers_or_none(forces.power),
                    }
                )
                for key, forces in _kinds(friction).items()
            }
        ),
        "change": record_of(
            {
                quantity: numbers_or_none(friction.change),
                "reactions": numbers_or_none(friction.reaction_change),
            }
        ),
        "efficiency": numbers_or_none(friction.efficiency),
        "self_locking": friction.locks.tolist(),
        "jammed": friction.jammed.tolist(),
    }
    return record_of(columns)


def _kinds(friction: Friction) -> dict[str, RubbedForces]:
    return {
        "without": friction.without,
        "once": friction.corrected,
        "converged": friction.converged,
    }


def _pair(friction: Friction, pair: FrictionPair, count: int) -> ColumnarRecords:
    steady: dict[str, object] = {"pair": pair.name, "joint": pair.joint, "on": pair.on}
    steady |= {"from": pair.by, "f": pair.f}
    steady |= {"rho": pair.rho} if pair.slide is None else {"phi_deg": pair.phi}
    told: dict[str, Column | ColumnarRecords] = {key: [one] * count for key, one in steady.items()}
    told |= {
        "rate": numbers_or_none(pair.rate),
        "f_without": sizes(friction.total(pair, friction.without)),
    }
    for key, forces in list(_kinds(friction).items())[1:]:
        whole = friction.total(pair, forces)
        told[key] = record_of(
            {
                "fx": numbers_or_none(whole.real),
                "fy": numbers_or_none(whole.imag),
                "f": sizes(whole),
                "moment": numbers_or_none(forces.moments[pair.number]),
                "friction": numbers_or_none(friction.rub(pair, forces)),
            }
        )
    return record_of(told)


def friction_cycle_record(efficiency: CycleEfficiency) -> dict[str, object]:
    """Return the efficiency of the cycle as plain data, J."""
    return {
        "efficiency": efficiency.value,
        "work_without": efficiency.ideal,
        "work": efficiency.real if np.isfinite(efficiency.real) else None,
        **({"jammed_between": list(efficiency.locked)} if efficiency.locked else {}),
    }


def friction_columns(solution: Solution) -> Iterator[tuple[str, Reals]]:
    """Yield the columns of a spreadsheet: whole reactions and what drives, both converged."""
    friction = friction_of(solution)
    for pair in friction.every:
        name = f"{pair.joint}.{pair.on}-{pair.by}"
        yield f"F.{name}.rubbed", np.abs(friction.total(pair, friction.converged))
        if pair.coefficient:
            yield f"friction.{name}", friction.rub(pair, friction.converged)
    quantity = solution.problem.drive.balancing.quantity
    yield f"driving.{quantity}.once", friction.corrected.balance
    yield f"driving.{quantity}.rubbed", friction.converged.balance
    yield "efficiency", friction.efficiency


def friction_narrator(solution: Solution, language: Language, index: int) -> FrictionNarrator:
    """Return the narrator of the friction of a position."""
    formulas = Formulas(solution, Names(solution, language.note), index)
    return FrictionNarrator(ForceContext(force_reading(solution, index), formulas))


def friction_tables(solution: Solution, language: Language, index: int) -> Iterator[Node]:
    """Yield the table of the pairs with friction of one position, and its results."""
    narrator = friction_narrator(solution, language, index)
    yield Caption(language.friction.table)
    yield narrator.table()
    yield from map(Note, narrator.results())
    yield from map(Note, narrator.cycle_lines())
