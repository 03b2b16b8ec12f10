"""Forces in the record and on the terminal: reactions, balancing moment, Zhukovsky lever."""

from __future__ import annotations

from typing import Any

import numpy as np

from planmethod.note.narrate.forces.resultants import kept_lines, shift_lines
from planmethod.note.numbers import finite_or_none, plain
from planmethod.note.plaintext import NO_BREAK, fixed, found, given, plain_text, wrap
from planmethod.note.tables.sigmas import Sigmas
from planmethod.note.wording import Wording
from planmethod.solved.errors.forces import (
    BALANCE,
    LEVER,
    DrawnForces,
    angle_label,
    drawn_forces,
    moment_label,
    size_label,
)
from planmethod.solved.forces.contact import VANISHING, Contact, JointForce
from planmethod.solved.forces.statics import Statics, statics_of
from planmethod.solved.solution import Solution


def _angle(force: complex, largest: float) -> float | None:
    if abs(force) <= VANISHING * largest:
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


def _sigma(drawn: DrawnForces, label: str, index: int) -> float | None:
    return finite_or_none(drawn.spreads[label].sigma[index])


def _drawn(
    drawn: DrawnForces, joint: JointForce, index: int, *, still: bool
) -> dict[str, float | None]:
    """Return what the ruler gives of a reaction, and the drafting errors of what is told of it.

    Of one that is ``still``, being nothing, there is no direction.
    """
    size, moment = size_label(joint), moment_label(joint)
    prismatic = moment in drawn.items
    return {
        "read": finite_or_none(drawn.read(size)[index]),
        "sigma": _sigma(drawn, size, index),
        "sigma_angle_deg": None if still else _sigma(drawn, angle_label(joint), index),
        "read_moment": finite_or_none(drawn.read(moment)[index]) if prismatic else 0.0,
        "sigma_moment": _sigma(drawn, moment, index) if prismatic else 0.0,
    }


def _told_labels(statics: Statics, index: int) -> list[str]:
    """Return the labels of all drafting errors that are told of a position."""
    largest = statics.largest(index)
    nothing = {
        angle_label(joint)
        for joint in statics.reactions
        if _angle(complex(joint.force[index]), largest) is None
    }
    return [label for label in drawn_forces(statics).items if label not in nothing]


def forces_record(solution: Solution, index: int) -> dict[str, Any]:
    """Return reactions, driving and lever of one position as plain data, N and N·m.

    A reaction is what the link ``from`` does to the link ``on``; ``moment`` is about ``at``. A
    guide's acts in ``point``, ``b`` from ``at`` along the guide, or at the ``edges``. The lever's
    ``difference`` from the force plans is that of the exact values; ``sigma`` is what a drawing of
    the profile lets expect, ``hand`` what the ruler gives.
    """
    statics = statics_of(solution)
    drawn, largest = drawn_forces(statics), statics.largest(index)

    def told(number: int, joint: JointForce) -> dict[str, Any]:
        force, at = complex(joint.force[index]), complex(joint.at[index])
        angle = _angle(force, largest)
        contact = statics.contacts.get(number)
        return {
            "joint": joint.joint,
            "on": joint.on,
            "from": joint.by,
            "fx": plain(force.real),
            "fy": plain(force.imag),
            "f": abs(force),
            "angle_deg": angle,
            "at": [plain(at.real), plain(at.imag)],
            "moment": plain(joint.moment[index]),
            **_drawn(drawn, joint, index, still=angle is None),
            **(_contact_record(contact, index) if contact is not None else {}),
        }

    quantity = solution.problem.drive.balancing.quantity
    balance = float(statics.balance[index])
    record: dict[str, Any] = {
        "reactions": [told(k, joint) for k, joint in enumerate(statics.reactions)],
        "driving": {
            quantity: plain(balance),
            "read": finite_or_none(drawn.read(BALANCE)[index]),
            "sigma": _sigma(drawn, BALANCE, index),
        },
        "mu": statics.scale.per_mm,
        "monte_carlo": [
            label for label in _told_labels(statics, index) if drawn.spreads[label].drawn[index]
        ],
    }
    if statics.lever is not None:
        assert drawn.discrepancy_sigma is not None and drawn.balances is not None
        lever = float(statics.lever[index])
        plans, hung = float(drawn.balances.plans[index]), float(drawn.balances.lever[index])
        record["lever"] = {
            quantity: plain(lever),
            "difference": lever - balance,
            "sigma": finite_or_none(drawn.discrepancy_sigma[index]),
            "hand": {
                "plans": finite_or_none(plans),
                "lever": finite_or_none(hung),
                "sigma_lever": _sigma(drawn, LEVER, index),
                "difference": finite_or_none(hung - plans),
            },
        }
    return record


def forces_columns(solution: Solution, words: Wording) -> list[list[str]]:
    """Return columns of many positions: the size of every reaction, then what balances."""
    statics = statics_of(solution)
    columns = [
        [f"{joint.joint} {joint.on}←{joint.by}", *(found(float(f), words) for f in size)]
        for joint in statics.reactions
        for size in [np.abs(joint.force)]
    ]
    drive = solution.problem.drive
    head = f"{drive.balancing.letter}{drive.link}, {words.units[drive.balancing.unit]}"
    return [*columns, [head, *(found(float(value), words) for value in statics.balance)]]


def _distance(solution: Solution, number: int, index: int, words: Wording) -> str:
    """Return how far along its guide a reaction acts, m."""
    contact = statics_of(solution).contacts.get(number)
    b = np.nan if contact is None else float(contact.b()[index])
    if contact is None or not np.isfinite(b):
        return "—"
    largest = statics_of(solution).largest(index)
    return found(0.0 if abs(contact.joint.moment[index]) <= VANISHING * largest else b, words)


def _edge_notes(solution: Solution, words: Wording, index: int) -> list[str]:
    """Return what is told of the guides whose sliders bear at their edges."""
    lines = []
    for contact in statics_of(solution).contacts.values():
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
    solution: Solution, words: Wording, index: int, sigmas: Sigmas | None = None
) -> list[str]:
    """Return the table of reactions of one position, and how the lever compares.

    ``sigmas`` are the cells of the drafting errors; without them there are none.
    """
    sigmas = sigmas or Sigmas(solution, words, asked=False)
    statics = statics_of(solution)
    drawn, largest = drawn_forces(statics), statics.largest(index)
    rows = []
    for number, joint in enumerate(statics.reactions):
        force = complex(joint.force[index])
        angle = _angle(force, largest)
        size = 0.0 if angle is None else abs(force)
        moment = float(joint.moment[index])
        still = abs(moment) <= VANISHING * largest
        rows.append(
            [
                joint.joint,
                f"{joint.on}←{joint.by}",
                found(size, words),
                found(float(drawn.read(size_label(joint))[index]), words),
                *sigmas.cell(size_label(joint), index, drawn),
                "—" if angle is None else fixed(angle, words),
                *sigmas.cell(None if angle is None else angle_label(joint), index, drawn),
                "—" if still else found(moment, words),
                *sigmas.cell(None if still else moment_label(joint), index, drawn),
                _distance(solution, number, index, words),
            ]
        )
    header = sigmas.header(words.columns_forces, 3, 4, 5)
    lines = [words.table_forces, *sigmas.table(header, rows, left=2)]
    lines += _edge_notes(solution, words, index)
    for line in (*shift_lines(statics, words, index), *kept_lines(statics, words)):
        lines += wrap(plain_text(line))
    balancing = solution.problem.drive.balancing
    balance, unit = words.balance[balancing.quantity], words.units[balancing.unit]
    lines += wrap(balance.format(value=found(float(statics.balance[index]), words), unit=unit))
    if statics.lever is None:
        lines.append(words.lever_stands)
    else:
        drawn = drawn_forces(statics)
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
