"""Forces among the results of a problem, and the steps that give them (искомые силы)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from msgspec.structs import replace

from planmethod.construct.arithmetic import Number
from planmethod.construct.steps import Name
from planmethod.plans.forces.board import SCALE, ForceBoard, Reaction
from planmethod.plans.forces.polygons import reaction_symbol
from planmethod.plans.legend import Quantity, QuantityKind
from planmethod.solved.forces.loads import applied
from planmethod.solved.forces.statics import Planned, plan_forces
from planmethod.solved.quantities import Quantities
from planmethod.solved.solution import Solution


def force_row(reaction: Reaction) -> str:
    """Return the column name of a reaction: ``F.B.2-1``, on link 2 from link 1."""
    return f"F.{reaction.joint}.{reaction.on}-{reaction.by}"


def moment_row(reaction: Reaction) -> str:
    """Return the column name of a reaction's moment: ``M.B.2-1``."""
    return f"M.{reaction.joint}.{reaction.on}-{reaction.by}"


def with_forces(solution: Solution, results: Quantities) -> Quantities:
    """Return the results of a solution and those of its force plans, in N and N·m.

    The positions of the solution do not matter: values that vary with them are left open.

    Raises
    ------
    ProblemError
        As of `loads.applied`.
    """
    planned = plan_forces(solution, results.draft.copy(), applied(solution))
    board = planned.board
    found = (*_reactions(board), *_balances(planned))
    changing = tuple(board.changing)
    open_names = {name for _, names in changing for name in names}
    known = {
        name: _to_builtin(value) for name, value in board.data.items() if name not in open_names
    }
    return replace(
        results,
        program=board.draft.b.program(),
        numbers={**board.draft.numbers, **known, SCALE: 1.0},
        all=(*results.all, *found),
        draft=board.draft,
        changing=changing,
    )


def _to_builtin(value: Number) -> complex | float:
    return complex(value) if np.iscomplexobj(value) else float(value)


def _reactions(board: ForceBoard) -> Iterator[Quantity]:
    b = board.draft.b
    for reaction in board.reactions:
        force, on, by = reaction.force, reaction.on, reaction.by
        vector = b.carry(board.name("R"), board.pole, force.tail, force.head)
        told: list[tuple[QuantityKind, Name, str]] = [
            (QuantityKind.REACTION, vector, force_row(reaction))
        ]
        if reaction.couple is not None:
            told.append((QuantityKind.MOMENT, reaction.couple, moment_row(reaction)))
        for kind, name, row in told:
            shown = reaction_symbol(on, board.called(by), letter=kind.letter)
            back = f"{kind.letter}_{reaction.joint}_{by}/{on}"
            yield Quantity(
                kind, name, f"{reaction.joint}_{on}/{by}", row=row, shown=shown, opposite=back
            )


def _balances(planned: Planned) -> Iterator[Quantity]:
    """Yield the balance of the driver, by the force plans and by the lever."""
    balancing = planned.board.draft.problem.drive.balancing
    kind = QuantityKind.MOMENT if balancing.turns else QuantityKind.THRUST
    row = balancing.quantity
    yield Quantity(kind, planned.driving.balance, "dr", row=f"driving.{row}")
    if planned.lever is not None:
        yield Quantity(kind, planned.lever.balance, "lever", row=f"lever.{row}")
