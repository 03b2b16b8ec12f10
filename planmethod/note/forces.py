"""Forces in the record and on the terminal: reactions, balancing moment, Zhukovsky lever."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from planmethod.note.numbers import finite_or_none, plain
from planmethod.note.plaintext import (
    NO_BREAK,
    fixed,
    found,
    given,
    plain_text,
    spoken,
    table,
    wrap,
)
from planmethod.note.resultants import kept_lines, shift_lines
from planmethod.note.sigmas import sigma_text
from planmethod.note.wording import Wording
from planmethod.plans.contact import NOTHING, Contact
from planmethod.plans.solution import Solution
from planmethod.plans.statics import JointForce


def _angle(force: complex, largest: float) -> float | None:
    if abs(force) <= NOTHING * largest:
        return None
    return plain(np.degrees(np.angle(force)) % 360.0)


def _contact_record(contact: Contact, index: int) -> dict[str, Any]:
    """Return where the reaction of a guide acts, m, and what acts at the edges of the slider, N."""
    b = finite_or_none(contact.b()[index])
    place = complex(contact.place(contact.b())[index])
    record: dict[str, Any] = {
        "b": None if b is None else plain(b),
        "point": None if b is None else [plain(place.real), plain(place.imag)],
    }
    edges = contact.edges(index)
    if edges:
        record["edges"] = [
            {
                "at": [plain(edge.at.real), plain(edge.at.imag)],
                "fx": plain(edge.force.real),
                "fy": plain(edge.force.imag),
            }
            for edge in edges
        ]
    return record


def forces_record(solution: Solution, index: int) -> dict[str, Any]:
    """Return reactions, driving and lever of one position as plain data, N and N·m.

    A reaction is what the link ``from`` does to the link ``on``; ``moment`` is about ``at``. A
    guide's acts in ``point``, ``b`` from ``at`` along the guide, or at the ``edges``. The lever's
    ``difference`` from the force plans is that of the exact values; ``sigma`` is what a drawing of
    the profile lets expect, ``hand`` what the ruler gives.
    """
    statics = solution.statics
    drawn, largest = statics.drawn, statics.largest(index)

    def told(number: int, joint: JointForce) -> dict[str, Any]:
        force, at = complex(joint.force[index]), complex(joint.at[index])
        contact = statics.contacts.get(number)
        return {
            "joint": joint.joint,
            "on": joint.on,
            "from": joint.by,
            "fx": plain(force.real),
            "fy": plain(force.imag),
            "f": abs(force),
            "angle_deg": _angle(force, largest),
            "at": [plain(at.real), plain(at.imag)],
            "moment": plain(joint.moment[index]),
            "read": plain(drawn.read(number)[index]),
            "sigma": finite_or_none(drawn.sigma(number)[index]),
            **(_contact_record(contact, index) if contact is not None else {}),
        }

    quantity = "moment" if solution.problem.drive.is_crank else "force"
    balance = float(statics.balance[index])
    record: dict[str, Any] = {
        "reactions": [told(k, joint) for k, joint in enumerate(statics.reactions)],
        "driving": {quantity: plain(balance)},
        "mu": statics.scale.per_mm,
    }
    if statics.lever is not None:
        assert drawn.discrepancy_sigma is not None and drawn.balances is not None
        lever = float(statics.lever[index])
        plans, hung = float(drawn.balances.plans[index]), float(drawn.balances.lever[index])
        record["lever"] = {
            quantity: plain(lever),
            "difference": lever - balance,
            "sigma": finite_or_none(drawn.discrepancy_sigma[index]),
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


def _distance(solution: Solution, number: int, index: int, words: Wording) -> str:
    """Return how far along its guide a reaction acts, m."""
    contact = solution.statics.contacts.get(number)
    b = np.nan if contact is None else float(contact.b()[index])
    if contact is None or not np.isfinite(b):
        return "—"
    largest = solution.statics.largest(index)
    return found(0.0 if abs(contact.joint.moment[index]) <= NOTHING * largest else b, words)


def _edge_notes(solution: Solution, words: Wording, index: int) -> list[str]:
    """Return what is told of the guides whose sliders bear at their edges."""
    lines = []
    for contact in solution.statics.contacts.values():
        edges = contact.edges(index)
        if not edges:
            continue
        assert contact.length is not None
        told = [
            f"{letter} = {found(abs(edge.force), words)} {words.units['N']} "
            f"(φ = {fixed(np.degrees(np.angle(edge.force)) % 360.0, words)}°)".replace(
                " ", NO_BREAK
            )
            for letter, edge in zip(("F′", "F″"), edges, strict=True)
        ]
        note = words.edges_note if np.isfinite(contact.b()[index]) else words.edges_couple
        joint = contact.joint
        lines += wrap(
            note.format(
                joint=joint.joint,
                links=f"{joint.on}←{joint.by}",
                length=given(contact.length, words),
                first=told[0],
                second=told[1],
            )
        )
    return lines


def forces_tables(
    solution: Solution, words: Wording, index: int, *, sigma: Sequence[str] | None = None
) -> list[str]:
    """Return the table of reactions of one position, and how the lever compares.

    ``sigma`` is the header with the column of the drafting errors, where they are asked for.
    """
    statics = solution.statics
    largest = statics.largest(index)
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
                _distance(solution, number, index, words),
            ]
        )
    lines = [words.table_forces, *table(sigma or words.columns_forces, rows, left=2)]
    lines += _edge_notes(solution, words, index)
    for line in (*shift_lines(statics, words, index), *kept_lines(statics, words)):
        lines += wrap(plain_text(line))
    crank = solution.problem.drive.is_crank
    unit = words.units["N·m"] if crank else words.units["N"]
    balance = words.balance_moment if crank else words.balance_force
    lines += wrap(balance.format(value=found(float(statics.balance[index]), words), unit=unit))
    if statics.lever is not None:
        drawn = statics.drawn
        assert drawn.discrepancy_sigma is not None and drawn.balances is not None
        plans, hung = float(drawn.balances.plans[index]), float(drawn.balances.lever[index])
        share, expected = drawn.balances.share(index), float(drawn.discrepancy_sigma[index])
        lines += wrap(
            words.lever_note.format(
                lever=found(hung, words),
                plans=found(plans, words),
                difference=found(hung - plans, words),
                share="—" if share is None else fixed(share, words),
                sigma=found(expected, words),
                unit=unit,
            )
        )
    return lines
