"""Forces and friction in the record and on the terminal: reactions, moment, lever."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from planmethod.note.columnar import Column, ColumnarRecords, list_of, record_of
from planmethod.note.columns import bounds, named, numbers_or_none, pairs, sizes
from planmethod.note.compared import DASH
from planmethod.note.document import (
    NO_BREAK,
    Caption,
    Node,
    Note,
    computed_text,
    fixed,
    input_text,
    localized,
)
from planmethod.note.formula import Rich
from planmethod.note.narrate.forces.loads import (
    ForceContext,
    FrictionNarrator,
    bearing_text,
    redundant,
    shift_lines,
    unshifted_lines,
)
from planmethod.note.narrate.naming import Formulas, Names, point_name
from planmethod.note.numbers import record_float
from planmethod.note.series import (
    angle_series,
    balance_series,
    lever_beside_plans,
    lever_series,
    moment_series,
    size_series,
    vanishing,
)
from planmethod.note.tables.errors import ErrorColumns
from planmethod.note.tables.springs import spring_records, spring_tables
from planmethod.note.wording import Language, MessageTable
from planmethod.plans.forces.polygons import ForcePlan
from planmethod.problem.model import Drive, Problem
from planmethod.solved.cycle_forces import CycleEfficiency
from planmethod.solved.errors.forces import angle_label, drawn_forces
from planmethod.solved.forces.friction import (
    Friction,
    FrictionPair,
    RubbedForces,
    friction_of,
)
from planmethod.solved.forces.reading import force_reading
from planmethod.solved.forces.statics import (
    VANISHING,
    JointForce,
    SlideReaction,
    Statics,
    bearings_of,
    statics_of,
)
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution


def _acts(contact: SlideReaction | None) -> dict[str, Column]:
    """Return where the reaction of a guide acts, m."""
    if contact is None:
        return {}
    b = contact.b()
    acts, places = np.isfinite(b).tolist(), pairs(contact.place(b)).to_list()
    point = [place if is_there else None for place, is_there in zip(places, acts, strict=True)]
    return {"b": numbers_or_none(b), "point": point}


def _at_edges(contact: SlideReaction | None) -> dict[int, dict[str, Any]]:
    """Return what acts at the edges of a slider, N, by the positions where it does."""
    if contact is None:
        return {}
    return {
        index: {
            "edges": [
                {
                    "at": [record_float(edge.at.real), record_float(edge.at.imag)],
                    "fx": record_float(edge.force.real),
                    "fy": record_float(edge.force.imag),
                }
                for edge in contact.edges(index)
            ]
        }
        for index in np.flatnonzero(contact.at_edges).tolist()
    }


def _in_bearings(statics: Statics, joint: JointForce) -> dict[str, ColumnarRecords]:
    """Return what each of two bearings takes of the reaction of a shaft, N."""
    shared = bearings_of(statics, joint)
    if shared is None:
        return {}
    count = len(statics.solution.positions)
    parts = [
        record_of(
            {
                "at": [place] * count,
                "fx": numbers_or_none(share * joint.force.real),
                "fy": numbers_or_none(share * joint.force.imag),
                "f": sizes(share * joint.force),
            }
        )
        for place, share in zip(shared.at, shared.load_fractions, strict=True)
    ]
    return {"bearings": list_of(parts, count)}


def _drawn(statics: Statics, joint: JointForce) -> dict[str, Column]:
    """Return the readings of a reaction, and the drafting errors of its reported values.

    Where it is negligible, it has no direction.
    """
    size, angle, moment = (
        make(statics, joint) for make in (size_series, angle_series, moment_series)
    )
    assert size is not None and angle is not None
    known, none = np.isfinite(angle.exact), [0.0] * len(angle.exact)
    turned = np.full(len(known), np.nan)
    if known.any():
        turned[known] = np.asarray(angle.sigma)[known]
    return {
        "read": numbers_or_none(size.read),
        "sigma": numbers_or_none(size.sigma),
        "sigma_angle_deg": numbers_or_none(turned),
        "read_moment": none if moment is None else numbers_or_none(moment.read),
        "sigma_moment": none if moment is None else numbers_or_none(moment.sigma),
    }


def _reaction_records(statics: Statics, number: int) -> ColumnarRecords:
    """Return a reaction in every position; the data of its guide come last."""
    joint = statics.reactions[number]
    angle = angle_series(statics, joint).exact
    names = {"joint": joint.joint, "on": joint.on, "from": joint.by}
    contact = statics.contacts.get(number)
    return record_of(
        {
            **{key: [name] * len(angle) for key, name in names.items()},
            "fx": numbers_or_none(joint.force.real),
            "fy": numbers_or_none(joint.force.imag),
            "f": sizes(joint.force),
            "angle_deg": numbers_or_none(angle),
            "at": pairs(joint.at),
            "moment": numbers_or_none(joint.moment),
            **_drawn(statics, joint),
            **_acts(contact),
            **_in_bearings(statics, joint),
        },
        some=_at_edges(contact),
    )


def forces_records(solution: Solution) -> ColumnarRecords:
    """Return reactions, driving and lever of every position as plain data, N and N·m.

    ``bound`` is that of the relative error of forces and moments
    (`planmethod.solved.forces.statics.Statics.bound`). A reaction is what the link ``from`` does to
    the link ``on``; ``moment`` is about ``at``. A guide's acts in ``point``, ``b`` from ``at``
    along the guide, or at the ``edges``. The lever's ``difference`` from the force plans is that of
    the exact values; ``sigma`` is what a drawing of the profile lets expect, ``hand`` what the
    ruler gives.
    """
    statics = statics_of(solution)
    drawn, balance = drawn_forces(statics), balance_series(statics)
    quantity, count = solution.problem.balancer.quantity, len(solution.positions)
    pushed = solution.problem.drive.pushed
    reactions = [_reaction_records(statics, k) for k in range(len(statics.reactions))]
    still = {angle_label(joint): vanishing(statics, joint) for joint in statics.reactions}
    random = {
        label: drawn.spreads[label].drawn & ~nothing
        for label in drawn.items
        if not (nothing := still.get(label, np.zeros(count, dtype=bool))).all()
    }
    columns: dict[str, Column | ColumnarRecords] = {
        "bound": bounds(statics.bound),
        "reactions": list_of(reactions, count),
        "driving": record_of(
            {
                quantity: numbers_or_none(balance.exact),
                **(
                    {"moment": numbers_or_none(statics.moment)}
                    if pushed and statics.moment is not None
                    else {}
                ),
                **(
                    {"between": [[*ends]] * count, "moment": [None] * count}
                    if (ends := solution.problem.drive.actuator) is not None
                    else {}
                ),
                **(
                    {"between": [[*links]] * count}
                    if (links := solution.problem.drive.motor) is not None
                    else {}
                ),
                "read": numbers_or_none(balance.read),
                "sigma": numbers_or_none(balance.sigma),
            }
        ),
        **_other_balances(statics),
        "mu": numbers_or_none(np.broadcast_to(statics.mu, count)),
        "plans": list_of(
            [
                record_of(
                    {
                        "links": [[*plan.links]] * count,
                        "mu": numbers_or_none(own),
                        "q": [_q(plan)] * count,
                    }
                )
                for plan, own in zip(statics.board.plans, statics.plan_scales, strict=True)
            ],
            count,
        ),
        "monte_carlo": named(random, count),
    }
    if solution.problem.dynamics is not None and solution.problem.dynamics.springs:
        columns["springs"] = spring_records(solution)
    if rubbed(solution.problem):
        columns["friction"] = friction_records(solution)
    lever, both = lever_series(statics), lever_beside_plans(statics)
    if lever is not None and both is not None:
        columns["lever"] = record_of(
            {
                quantity: numbers_or_none(lever.exact),
                "difference": numbers_or_none(lever.exact - balance.exact),
                "sigma": numbers_or_none(both.sigma),
                "hand": record_of(
                    {
                        "plans": numbers_or_none(both.exact),
                        "lever": numbers_or_none(both.read),
                        "sigma_lever": numbers_or_none(lever.sigma),
                        "difference": numbers_or_none(both.off),
                    }
                ),
            }
        )
    return record_of(columns)


def _other_balances(statics: Statics) -> dict[str, ColumnarRecords]:
    """Return what balances the other driving links, by link; nothing of a single driver."""
    return _balance_records(statics.solution.problem.drive, statics.other_balances)


def _balance_records(drive: Drive, balances: Mapping[str, Reals]) -> dict[str, ColumnarRecords]:
    """Return balances of the other driving links by link; nothing of a single driver."""
    if not drive.other_drives:
        return {}
    rows = {}
    for other in drive.other_drives:
        quantity = "force" if other.pivot is None else "moment"
        rows[other.link] = record_of({quantity: numbers_or_none(balances[other.link])})
    return {"other_drivers": record_of(rows)}


def _q(plan: ForcePlan) -> int:
    """Return the number of redundant constraints of a plan's links with pairs of one freedom."""
    return redundant(len(plan.links))


def forces_columns(solution: Solution, texts: MessageTable) -> list[list[str]]:
    """Return columns of many positions: the size of every reaction, then what balances."""
    statics, called = statics_of(solution), solution.problem.mechanism.called
    columns = [
        [
            f"{joint.joint} {joint.on}←{called(joint.by)}",
            *(computed_text(float(f), texts) for f in size),
        ]
        for joint in statics.reactions
        for size in [np.abs(joint.force)]
    ]
    drive = solution.problem.drive
    of = drive.link if drive.actuator is None else " " + "".join(map(point_name, drive.actuator))
    of = of if drive.motor is None else " " + "-".join(drive.motor)
    head = f"{drive.balancing.letter}{of}, {texts['units'][drive.balancing.unit]}"
    columns.append([head, *(computed_text(float(value), texts) for value in statics.balance)])
    if rubbed(solution.problem):
        friction = friction_of(solution)
        more: list[tuple[str, Reals]] = [
            (
                texts.rubbed.format(head=f"{pair.joint} {pair.on}←{called(pair.by)}"),
                np.abs(friction.total(pair, friction.converged)),
            )
            for pair in friction.every
        ]
        more += [
            (texts.rubbed.format(head=head), friction.converged.balance),
            ("η", friction.efficiency),
        ]
        for name, values in more:
            told = (computed_text(float(v), texts) if np.isfinite(v) else "—" for v in values)
            columns.append([name, *told])
    return columns


def _balances_of_drivers(solution: Solution, texts: MessageTable, index: int) -> Iterator[Node]:
    """Yield what balances each of several driving links that has its own balance."""
    statics, drive = statics_of(solution), solution.problem.drive
    balances = {drive.link: statics.balance, **statics.other_balances}
    own = drive.other_drives if drive.motor or drive.actuator else drive.every
    rows = [(one.link, one.is_crank, balances[one.link]) for one in own]
    for link, turns, values in rows:
        value = computed_text(float(values[index]), texts)
        unit = texts["units"]["N·m" if turns else "N"]
        template = texts["balance_of"]["moment" if turns else "force"]
        yield Note(template.format(link=link, value=value, unit=unit))


def _distance(solution: Solution, number: int, index: int, texts: MessageTable) -> str:
    """Return the distance along its guide at which a reaction acts, m."""
    contact = statics_of(solution).contacts.get(number)
    b = np.nan if contact is None else float(contact.b()[index])
    if contact is None or not np.isfinite(b):
        return "—"
    largest = statics_of(solution).largest(index)
    return computed_text(
        0.0 if abs(contact.joint.moment[index]) <= VANISHING * largest else b, texts
    )


def rubbed(problem: Problem) -> bool:
    """Return whether the pairs have friction."""
    return problem.dynamics is not None and problem.dynamics.friction is not None


def push_direction(problem: Problem, texts: MessageTable) -> str:
    """Return the direction of the balancing force at a point of the crank."""
    pushed, pivot = problem.drive.pushed, problem.drive.pivot
    assert pushed is not None and pivot is not None
    if pushed.angle is None:
        return texts.push_across.format(line=f"{point_name(pivot)}{point_name(pushed.at)}")
    return texts.push_angle.format(angle=input_text(pushed.angle, texts))


def driven_by(problem: Problem, texts: MessageTable) -> Iterator[Rich]:
    """Yield which load drives the mechanism where something else determines its position."""
    drive = problem.drive
    pushed, link = drive.pushed, problem.mechanism.called(drive.link)
    if drive.cam_drive is not None:
        if pushed is not None:
            yield texts.drives_cam_push.format(link=link, point=point_name(pushed.at))
        elif drive.pivot is not None:
            yield texts.drives_cam.format(link=link, pivot=point_name(drive.pivot))
        else:
            yield texts.drives_cam_slide.format(link=link)
    elif drive.posed is not None and drive.actuator is None and drive.motor is None:
        what = texts["drives_by"][drive.balancing.phrase_key]
        yield texts.drives_posed.format(key=drive.posed.key, link=link, what=what)


def resultant_notes(
    solution: Solution, texts: MessageTable, index: int | None = None
) -> Iterator[Rich]:
    """Yield where inertia forces act that also replace couples, and which ones do not."""
    statics = statics_of(solution)
    yield from shift_lines(statics, texts, index)
    yield from unshifted_lines(statics, texts)


def _edge_notes(solution: Solution, texts: MessageTable, index: int) -> Iterator[Rich]:
    """Yield notes on the guides whose sliders bear at their edges."""
    for contact in statics_of(solution).contacts.values():
        edges = contact.edges(index)
        if not edges:
            continue
        assert contact.length is not None
        told = [
            f"{letter} = {computed_text(abs(edge.force), texts)} {texts['units']['N']} "
            f"(φ = {fixed(np.degrees(np.angle(edge.force)) % 360.0, texts)}°)".replace(
                " ", NO_BREAK
            )
            for letter, edge in zip(("F′", "F″"), edges, strict=True)
        ]
        note = texts.edges_note if np.isfinite(contact.b()[index]) else texts.edges_couple
        joint = contact.joint
        yield note.format(
            joint=joint.joint,
            links=f"{joint.on}←{solution.problem.mechanism.called(joint.by)}",
            length=input_text(contact.length, texts),
            first=told[0],
            second=told[1],
        )


def forces_tables(
    solution: Solution, language: Language, index: int, sigmas: ErrorColumns
) -> Iterator[Node]:
    """Yield the table of reactions of one position, and how the lever compares."""
    statics, texts = statics_of(solution), language.note
    rows, largest = [], statics.largest(index)
    for number, joint in enumerate(statics.reactions):
        size, angle = size_series(statics, joint), angle_series(statics, joint)
        is_directed, moment = np.isfinite(angle.exact[index]), float(joint.moment[index])
        still = abs(moment) <= VANISHING * largest
        rows.append(
            [
                joint.joint,
                f"{joint.on}←{solution.problem.mechanism.called(joint.by)}",
                *sigmas.cells(size, index),
                fixed(float(angle.exact[index]), texts) if is_directed else DASH,
                *sigmas.cell(angle if is_directed else None, index),
                DASH if still else computed_text(moment, texts),
                *sigmas.cell(None if still else moment_series(statics, joint), index),
                _distance(solution, number, index, texts),
            ]
        )
    yield Caption(texts.table_forces)
    yield sigmas.table(texts["columns_forces"], (3, 4, 5), rows, names=2)
    yield from spring_tables(solution, language, index)
    yield from map(Note, _edge_notes(solution, texts, index))
    for joint in statics.reactions:
        if (shared := bearings_of(statics, joint)) is not None:
            force = abs(complex(joint.force[index]))
            yield Note(bearing_text(solution, joint, shared, force, texts))
    yield from map(Note, resultant_notes(solution, texts, index))
    balancing = solution.problem.balancer
    balance, unit = texts["balance"][balancing.phrase_key], texts["units"][balancing.unit]
    facts = {"value": computed_text(float(statics.balance[index]), texts), "unit": unit}
    if (pushed := solution.problem.drive.pushed) is not None:
        assert statics.moment is not None
        facts["moment"] = (
            f"{computed_text(float(statics.moment[index]), texts)} {texts['units']['N·m']}"
        )
        facts["point"] = point_name(pushed.at)
        facts["way"] = push_direction(solution.problem, texts)
    if statics.thrust is not None:
        facts["line"] = "".join(map(point_name, statics.thrust.ends))
        facts["one"], facts["two"] = map(solution.problem.mechanism.called, statics.thrust.links)
        apart = statics.balance[index] >= 0
        facts["way"] = texts.push_apart if apart else texts.pull_together
    if statics.motor is not None:
        facts["one"], facts["two"] = map(solution.problem.mechanism.called, statics.motor.links)
    drive = solution.problem.drive
    if not drive.other_drives or drive.motor or drive.actuator:
        yield Note(balance.format(**facts))
    if drive.other_drives:
        yield from _balances_of_drivers(solution, texts, index)
    yield from map(Note, driven_by(solution.problem, texts))
    if statics.lever_at(index) is None:
        yield Note(texts.lever_stands)
        return
    series = lever_beside_plans(statics)
    assert series is not None
    both = series[index]
    yield Note(
        texts.lever_note.format(
            lever=localized(both.read_text, texts),
            plans=localized(both.exact_text, texts),
            difference=computed_text(both.off, texts),
            share=DASH if both.percent is None else fixed(both.percent, texts),
            sigma=computed_text(both.sigma, texts),
            unit=unit,
        )
    )


def friction_records(solution: Solution) -> ColumnarRecords:
    """Return the friction of every position as plain data, N, N·m and W.

    ``pairs`` are all of them, with the whole reaction, that along a guide with it, and its
    friction, ``once`` corrected and ``converged``: friction in one pair changes the reactions of
    the others, which may have none of their own (``f`` 0).
    ``change`` is the relative difference of the first from the second.
    """
    friction, count = friction_of(solution), len(solution.positions)
    quantity = solution.problem.balancer.quantity
    columns: dict[str, Column | ColumnarRecords] = {
        "pairs": list_of([_pair(friction, pair, count) for pair in friction.every], count),
        "driving": record_of(
            {
                key: record_of(
                    {
                        quantity: numbers_or_none(forces.balance),
                        "power": numbers_or_none(forces.power),
                        **_balance_records(solution.problem.drive, forces.other_balances),
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
    quantity = solution.problem.balancer.quantity
    yield f"driving.{quantity}.once", friction.corrected.balance
    yield f"driving.{quantity}.rubbed", friction.converged.balance
    for other in solution.problem.drive.other_drives:
        own = f"driving.{other.link}.{other.balancing.quantity}"
        yield f"{own}.once", friction.corrected.other_balances[other.link]
        yield f"{own}.rubbed", friction.converged.other_balances[other.link]
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
