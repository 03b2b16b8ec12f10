"""Machine-readable record of a solution: the object that ``solve --json`` prints."""

from __future__ import annotations

from typing import Any

import numpy as np

from planmethod.mechanism.structure import Structure
from planmethod.note.columns import Column, listed, named, rows, sizes, together
from planmethod.note.records.cycle import analogue_records, cycle_record
from planmethod.plans.legend import TURNING, Quantity, QuantityKind
from planmethod.plans.model import MOTION, PlanKind
from planmethod.plans.motion.board import pole_letter
from planmethod.plans.motion.leads import Relative
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.reading import Complexes
from planmethod.solved.solution import RelativeMotion, Solution

SCHEMA = 1
"""Version of the record's shape."""

LONG = {QuantityKind.CORIOLIS: "a_coriolis", QuantityKind.RELATIVE: "a_rel"}
"""Names in the record of what is asked for by a shorter one."""


def structure_record(structure: Structure) -> dict[str, Any]:
    """Return the structural analysis as plain data."""
    return {
        "mobility": structure.mobility,
        "moving_links": structure.moving_links,
        "lower_pairs": structure.lower_pairs,
        "higher_pairs": structure.higher_pairs,
        "redundant": structure.redundant,
        "class": structure.class_number,
        "groups": [
            {
                "signature": group.signature,
                "class": group.class_number,
                "order": group.order,
                "kind": group.kind,
                "links": list(group.links),
            }
            for group in structure.groups
        ],
        "formula": structure.formula,
    }


def _vector(prefix: str, values: Complexes) -> dict[str, Column]:
    return {
        f"{prefix}x": listed(values.real),
        f"{prefix}y": listed(values.imag),
        prefix: sizes(values),
    }


def _segments(solution: Solution, kind: PlanKind) -> list[dict[str, Any]]:
    """Return what is told of the segments of a plan."""
    spreads = drafting_of(solution).spreads
    return rows(
        {
            segment.name: rows(
                {
                    "exact": listed(segment.exact),
                    "read": listed(segment.read),
                    "sigma": listed(spreads[f"{kind.value}.{segment.name}"].sigma),
                }
            )
            for segment in solution.segments(kind)
        },
        len(solution.positions),
    )


def _hand(solution: Solution) -> list[dict[str, Any]]:
    """Return what follows from the read segments and the sigmas."""
    spreads, count = drafting_of(solution).spreads, len(solution.positions)

    def told(quantities: list[Quantity]) -> dict[str, Column]:
        """Return quantities and their sigmas."""
        columns: dict[str, Column] = {}
        for quantity in quantities:
            name = LONG.get(quantity.kind, quantity.kind.letter)
            spread = spreads.get(quantity.label)
            columns[name] = listed(solution.read_off(quantity.label))
            columns[f"sigma_{name}"] = [0.0] * count if spread is None else listed(spread.sigma)
        return columns

    def place(name: str) -> dict[str, Column]:
        return {f"sigma_{axis}": listed(spreads[f"{axis}_{name}"].sigma) for axis in ("x", "y")}

    points = {
        name: rows({**told(quantities), **place(name)})
        for name, quantities in solution.quantities(
            QuantityKind.VELOCITY, QuantityKind.ACCELERATION
        ).items()
    }
    turning = solution.quantities(QuantityKind.OMEGA, QuantityKind.EPSILON)
    links = {name: rows(told(quantities), count) for name, quantities in turning.items()}
    sliding = solution.quantities(
        QuantityKind.SLIDING, QuantityKind.CORIOLIS, QuantityKind.RELATIVE
    )
    relatives = solution.construction.kinematics.relatives.values()
    return rows(
        {
            "ruler": [solution.hand.ruler] * count,
            "profile": [solution.profile.name] * count,
            "points": rows(points, count),
            "links": rows(links, count),
            "relative": together(
                [rows({**_names(r, count), **told(sliding[r.name])}) for r in relatives], count
            ),
            "monte_carlo": named({k: s.drawn for k, s in spreads.items()}, count),
        }
    )


def _names(relative: Relative | RelativeMotion, count: int) -> dict[str, Column]:
    names = {"point": relative.point, "of": relative.of, "to": relative.to}
    return {key: [name] * count for key, name in names.items()}


def record(solution: Solution) -> dict[str, Any]:
    """Return everything that a solution says as plain data, SI, full precision.

    ``segments`` are in millimetres of the plan: ``exact``, ``read`` with the ruler along the hand's
    own chain, and ``sigma``, one standard deviation of the drafting error. ``hand`` holds the
    quantities that follow from the read segments with theirs, and the labels of those whose sigma
    was found by random draws because first order does not hold. ``cycle`` is there for a problem
    with ``[cycle]``, ``forces`` for one with ``[dynamics]``: see `planmethod.note.tables.forces`.
    """
    count = len(solution.positions)
    poles = {kind: pole_letter(solution.problem, kind) for kind in MOTION}
    points = {
        name: rows(
            {
                "x": listed(point.place.real),
                "y": listed(point.place.imag),
                **_vector("v", point.velocity),
                **_vector("a", point.acceleration),
            }
        )
        for name, point in solution.points.items()
    }
    links = {
        name: rows({q.kind.columns[0].removeprefix("."): listed(solution.exact(q)) for q in known})
        for name, known in solution.quantities(*TURNING).items()
    }
    relatives = [
        rows(
            {
                **_names(r, count),
                "v": sizes(r.velocity),
                "a_coriolis": sizes(r.coriolis),
                "a_rel": sizes(r.acceleration),
                "vx": listed(r.velocity.real),
                "vy": listed(r.velocity.imag),
                "a_coriolis_x": listed(r.coriolis.real),
                "a_coriolis_y": listed(r.coriolis.imag),
                "a_rel_x": listed(r.acceleration.real),
                "a_rel_y": listed(r.acceleration.imag),
            }
        )
        for r in solution.relatives
    ]
    plans = {
        kind.value: rows(
            {
                "mu": [solution.own_scale(kind, k).per_mm for k in range(count)],
                **({"pole": [poles[kind]] * count} if poles[kind] else {}),
                "segments": _segments(solution, kind),
            }
        )
        for kind in MOTION
    }
    columns: dict[str, Column] = {
        solution.problem.drive.coordinate.column: listed(solution.positions),
        "margin": listed(solution.margin),
        "points": rows(points, count),
        "links": rows(links, count),
        "analogues": analogue_records(solution),
        "relative": together(relatives, count),
        "plans": rows(plans),
        "hand": _hand(solution),
    }
    if solution.problem.dynamics is not None:
        from planmethod.note.tables.forces import forces_records

        columns["forces"] = forces_records(solution)
    machine = {}
    if solution.problem.machine is not None:
        from planmethod.note.records.machine import machine_record
        from planmethod.solved.machine.flywheel import flywheel_of

        machine["machine"] = machine_record(flywheel_of(solution), solution.profile)
    if solution.problem.balancing is not None:
        from planmethod.note.records.balancing import balancing_record

        machine["balancing"] = balancing_record(solution)
    return {
        "schema": SCHEMA,
        "problem": solution.problem.name,
        **({"variant": v} if (v := solution.problem.variant) is not None else {}),
        "structure": structure_record(solution.structure),
        **({"cycle": cycle_record(solution)} if solution.problem.cycle is not None else {}),
        "positions": rows(columns),
        **machine,
    }


def finite(value: Any) -> bool:
    """Tell whether every number of a record is finite."""
    if isinstance(value, dict):
        return all(finite(v) for v in value.values())
    if isinstance(value, list):
        return all(finite(v) for v in value)
    return not isinstance(value, float) or bool(np.isfinite(value))
