"""Forces in the record and on the terminal: reactions, balancing moment, Zhukovsky lever."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from planmethod.note.plaintext import fixed, found, spoken, table, wrap
from planmethod.note.sigmas import sigma_text
from planmethod.note.wording import Wording
from planmethod.plans.solution import Solution
from planmethod.plans.statics import JointForce, Statics

NOTHING = 1e-12
"""Share of the largest force of a position below which a reaction is nothing, and has no angle."""


def _angle(force: complex, largest: float) -> float | None:
    if abs(force) <= NOTHING * largest:
        return None
    angle = float(np.degrees(np.angle(force))) % 360.0
    return angle + 0.0


def _finite(value: float) -> float | None:
    """Return a plain float, None (null) for what a drawing cannot tell."""
    return float(value) if np.isfinite(value) else None


def _largest(statics: Statics, index: int) -> float:
    """Return the size of the largest force of a position, N."""
    forces = [abs(joint.force[index]) for joint in statics.reactions]
    forces += [abs(given.applied.force[index]) for given in statics.board.given]
    return float(max(forces, default=0.0))


def forces_record(solution: Solution, index: int) -> dict[str, Any]:
    """Return reactions, driving and lever of one position as plain data, N and N·m.

    A reaction is what the link ``from`` does to the link ``on``; ``moment`` is about ``at``. The
    lever's ``difference`` from the force plans is that of the exact values; ``sigma`` is what a
    drawing of the profile lets expect, ``hand`` what the ruler gives.
    """
    statics = solution.statics
    drawn, largest = statics.drawn, _largest(statics, index)

    def told(number: int, joint: JointForce) -> dict[str, Any]:
        force, at = complex(joint.force[index]), complex(joint.at[index])
        return {
            "joint": joint.joint,
            "on": joint.on,
            "from": joint.by,
            "fx": force.real + 0.0,
            "fy": force.imag + 0.0,
            "f": abs(force),
            "angle_deg": _angle(force, largest),
            "at": [at.real + 0.0, at.imag + 0.0],
            "moment": float(joint.moment[index]) + 0.0,
            "read": float(drawn.read(number)[index]) + 0.0,
            "sigma": _finite(drawn.sigma(number)[index]),
        }

    quantity = "moment" if solution.problem.drive.is_crank else "force"
    balance = float(statics.balance[index])
    record: dict[str, Any] = {
        "reactions": [told(k, joint) for k, joint in enumerate(statics.reactions)],
        "driving": {quantity: balance + 0.0},
        "mu": statics.scale.per_mm,
    }
    if statics.lever is not None:
        assert drawn.discrepancy_sigma is not None and drawn.balances is not None
        lever = float(statics.lever[index])
        plans, hung = float(drawn.balances.plans[index]), float(drawn.balances.lever[index])
        record["lever"] = {
            quantity: lever + 0.0,
            "difference": lever - balance,
            "sigma": _finite(drawn.discrepancy_sigma[index]),
            "hand": {"plans": plans, "lever": hung, "difference": hung - plans},
        }
    return record


def forces_columns(solution: Solution, words: Wording) -> list[list[str]]:
    """Return columns of many positions: the size of every reaction, then what balances."""
    statics = solution.statics
    columns = [
        [f"{joint.joint} {joint.on}←{joint.by}", *(found(float(f), words) for f in size)]
        for joint in statics.reactions
        for size in [np.abs(joint.force)]
    ]
    crank = solution.problem.drive.is_crank
    unit = words.units["N·m"] if crank else words.units["N"]
    sign = "M" if crank else "F"
    link = solution.problem.drive.link
    balance = [f"{sign}{link}, {unit}", *(found(float(value), words) for value in statics.balance)]
    return [*columns, balance]


def forces_tables(
    solution: Solution, words: Wording, index: int, *, sigma: Sequence[str] | None = None
) -> list[str]:
    """Return the table of reactions of one position, and how the lever compares.

    ``sigma`` is the header with the column of the drafting errors, where they are asked for.
    """
    statics = solution.statics
    largest = _largest(statics, index)
    rows = []
    for number, joint in enumerate(statics.reactions):
        force = complex(joint.force[index])
        angle = _angle(force, largest)
        size = 0.0 if angle is None else abs(force)
        moment = float(joint.moment[index])
        off = float(statics.drawn.sigma(number)[index]) if sigma is not None else 0.0
        rows.append(
            [
                joint.joint,
                f"{joint.on}←{joint.by}",
                found(size, words),
                found(float(statics.drawn.read(number)[index]), words),
                *([spoken(sigma_text(off), words)] if sigma is not None else []),
                "—" if angle is None else fixed(angle, words),
                "—" if abs(moment) <= NOTHING * largest else found(moment, words),
            ]
        )
    lines = [words.table_forces, *table(sigma or words.columns_forces, rows, left=2)]
    crank = solution.problem.drive.is_crank
    unit = words.units["N·m"] if crank else words.units["N"]
    balance = words.balance_moment if crank else words.balance_force
    lines += wrap(balance.format(value=found(float(statics.balance[index]), words), unit=unit))
    if statics.lever is not None:
        drawn = statics.drawn
        assert drawn.discrepancy_sigma is not None and drawn.balances is not None
        plans, hung = float(drawn.balances.plans[index]), float(drawn.balances.lever[index])
        expected = float(drawn.discrepancy_sigma[index])
        lines += wrap(
            words.lever_note.format(
                lever=found(hung, words),
                plans=found(plans, words),
                difference=found(hung - plans, words),
                share=fixed(100.0 * abs(hung - plans) / abs(plans), words) if plans else "—",
                sigma=found(expected, words),
                unit=unit,
            )
        )
    return lines
