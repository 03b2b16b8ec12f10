"""A tape as plain data, for an interpreter where no source may be run (регистры)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from planmethod.compiled.source import used_by
from planmethod.compiled.tape import Guard, Ref, Tape

KINDS = (
    "add", "sub", "mul", "div", "neg", "abs", "sqrt", "min", "max", "atan2", "degrees", "at_zero",
    "above", "floor", "cosd", "sind",
)  # fmt: skip
"""Operations by their number in the data."""


def registers(
    tape: Tape,
    results: Sequence[Ref],
    guards: Sequence[Guard],
    depends: Sequence[frozenset[int]],
    inputs: int,
) -> dict[str, Any]:
    """Return a tape as the contents of a bank of registers and the operations on them.

    The registers are the inputs, the constants, and a value for each operation, in this order.

    Parameters
    ----------
    results : sequence of Ref
    guards : sequence of Guard
        Margins to be watched.
    depends : sequence of frozenset of int
        Guards that each result depends on, by their place in ``guards``.
    inputs : int
        How many inputs the tape has.

    Returns
    -------
    dict
        ``inputs`` is their number, ``constants`` are numbers (None where there is none), ``kinds``
        are places in `KINDS`, ``operands`` three registers for each operation, ``results``
        registers, ``guards`` pairs of a register and its limit, ``needs`` the guards of each
        result.
    """
    margins = [guard.margin for guard in guards]
    needed = [n for n in used_by(tape, [*results, *margins]) if tape.nodes[n].kind != "input"]
    read = [ref for n in needed for ref in tape.nodes[n].operands]
    floats = [ref for ref in (*read, *results, *margins) if type(ref) is float]
    constants = {repr(value): value for value in floats}  # NaN equals nothing
    place = {text: inputs + k for k, text in enumerate(constants)}
    node = {number: inputs + len(constants) + k for k, number in enumerate(needed)}
    for number, one in enumerate(tape.nodes):
        if one.kind == "input":
            node[number] = int(one.operands[0])

    def register(ref: Ref) -> int:
        return place[repr(ref)] if type(ref) is float else node[int(ref)]

    operands: list[int] = []
    for number in needed:
        own = [register(ref) for ref in tape.nodes[number].operands]
        operands += [*own, 0, 0][:3]
    return {
        "inputs": inputs,
        "constants": [v if math.isfinite(v) else None for v in constants.values()],
        "kinds": [KINDS.index(tape.nodes[number].kind) for number in needed],
        "operands": operands,
        "results": [register(ref) for ref in results],
        "guards": [
            [register(guard.margin), guard.limit if math.isfinite(guard.limit) else -1e300]
            for guard in guards
        ],
        "needs": [sorted(one) for one in depends],
    }
