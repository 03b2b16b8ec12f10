"""Columns of the forces in a table for a spreadsheet, N and N·m."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from planmethod.solved.errors.forces import drawn_forces, size_label
from planmethod.solved.forces.results import force_row, moment_row
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution


def force_columns(solution: Solution) -> Iterator[tuple[str, Reals]]:
    """Yield the columns of the forces by name, ndarrays of shape (n,).

    For each reaction, on link 2 from link 1, ``F.B.2-1.x, F.B.2-1.y, F.B.2-1`` (its size) and
    ``F.B.2-1.read`` (with the ruler), in a prismatic pair ``M.B.2-1`` (about the pin,
    counter-clockwise positive); what balances the driver, ``driving.moment`` or ``driving.force``;
    the same by the lever, ``lever.moment`` or ``lever.force``, where the driver moves; both with
    ``.read``.

    Raises
    ------
    AssemblyError
        Where a force plan does not close.
    ProblemError
        A load is known in the positions of the file only, and others are asked.
    """
    statics = statics_of(solution)
    drawn = drawn_forces(statics)
    for planned, joint in zip(statics.board.reactions, statics.reactions, strict=True):
        name = force_row(planned)
        yield f"{name}.x", joint.force.real
        yield f"{name}.y", joint.force.imag
        yield name, np.abs(joint.force)
        yield f"{name}.read", drawn.read(size_label(planned))
        if planned.couple is not None:
            yield moment_row(planned), joint.moment
    quantity = solution.problem.drive.balancing.quantity
    yield f"driving.{quantity}", statics.balance
    yield f"driving.{quantity}.read", drawn.balance
    if statics.lever is not None:
        assert drawn.balances is not None
        yield f"lever.{quantity}", statics.lever
        yield f"lever.{quantity}.read", drawn.balances.lever
