"""Machine-readable record of a solution: the object that ``solve --json`` prints."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from planmethod.mechanism.structure import Structure
from planmethod.note.numbers import finite_or_none, plain
from planmethod.note.records.cycle import analogue_records, cycle_record
from planmethod.plans.legend import TURNING, Quantity, QuantityKind
from planmethod.plans.model import MOTION, PlanKind
from planmethod.plans.motion.board import pole_letter
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.solution import Solution

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


def _vector(prefix: str, value: complex) -> dict[str, float]:
    return {
        f"{prefix}x": plain(value.real),
        f"{prefix}y": plain(value.imag),
        prefix: plain(abs(value)),
    }


Columns = dict[str, list[float | None]]
"""Numbers of a record, each in all positions: what is asked of a solution is asked once."""


def _column(values: Iterable[float]) -> list[float | None]:
    return [finite_or_none(value) for value in values]


def _row(columns: Columns, index: int) -> dict[str, float | None]:
    return {name: values[index] for name, values in columns.items()}


def _segments(solution: Solution, kind: PlanKind) -> dict[str, Columns]:
    """Return what is told of the segments of a plan."""
    spreads = drafting_of(solution).spreads
    return {
        segment.name: {
            "exact": [plain(value) for value in segment.exact.tolist()],
            "read": _column(segment.read.tolist()),
            "sigma": _column(spreads[f"{kind.value}.{segment.name}"].sigma.tolist()),
        }
        for segment in solution.segments(kind)
    }


def _hand(solution: Solution) -> Callable[[int], dict[str, Any]]:
    """Return what follows from the read segments and the sigmas, for the number of a position."""
    spreads = drafting_of(solution).spreads
    nothing = [0.0] * len(solution.positions)

    def told(quantities: list[Quantity]) -> Columns:
        """Return quantities and their sigmas."""
        columns: Columns = {}
        for quantity in quantities:
            name = LONG.get(quantity.kind, quantity.kind.letter)
            spread = spreads.get(quantity.label)
            columns[name] = _column(solution.read_off(quantity.label).tolist())
            sigma = nothing if spread is None else spread.sigma.tolist()
            columns[f"sigma_{name}"] = _column(sigma)
        return columns

    def place(name: str) -> Columns:
        return {
            f"sigma_{axis}": _column(spreads[f"{axis}_{name}"].sigma.tolist())
            for axis in ("x", "y")
        }

    points = {
        name: {**told(quantities), **place(name)}
        for name, quantities in solution.quantities(
            QuantityKind.VELOCITY, QuantityKind.ACCELERATION
        ).items()
    }
    turning = solution.quantities(QuantityKind.OMEGA, QuantityKind.EPSILON)
    links = {name: told(quantities) for name, quantities in turning.items()}
    sliding = solution.quantities(
        QuantityKind.SLIDING, QuantityKind.CORIOLIS, QuantityKind.RELATIVE
    )
    relatives = [
        ({"point": r.point, "of": r.of, "to": r.to}, told(sliding[r.name]))
        for r in solution.construction.kinematics.relatives.values()
    ]
    drawn = {label: spread.drawn.tolist() for label, spread in spreads.items()}

    def at(index: int) -> dict[str, Any]:
        return {
            "ruler": solution.hand.ruler,
            "profile": solution.profile.name,
            "points": {name: _row(columns, index) for name, columns in points.items()},
            "links": {name: _row(columns, index) for name, columns in links.items()},
            "relative": [{**names, **_row(columns, index)} for names, columns in relatives],
            "monte_carlo": [label for label, flags in drawn.items() if flags[index]],
        }

    return at


def record(solution: Solution) -> dict[str, Any]:
    """Return everything that a solution says as plain data, SI, full precision.

    ``segments`` are in millimetres of the plan: ``exact``, ``read`` with the ruler along the hand's
    own chain, and ``sigma``, one standard deviation of the drafting error. ``hand`` holds the
    quantities that follow from the read segments with theirs, and the labels of those whose sigma
    was found by random draws because first order does not hold. ``cycle`` is there for a problem
    with ``[cycle]``, ``forces`` for one with ``[dynamics]``: see `planmethod.note.tables.forces`.
    """
    segments = {kind: _segments(solution, kind) for kind in MOTION}
    hand = _hand(solution)
    poles = {kind: pole_letter(solution.problem, kind) for kind in MOTION}
    told = analogue_records(solution)
    links = {
        name: {q.kind.columns[0].removeprefix("."): solution.exact(q) for q in quantities}
        for name, quantities in solution.quantities(*TURNING).items()
    }
    positions = []
    for i, asked in enumerate(solution.positions):
        entry: dict[str, Any] = {solution.problem.drive.coordinate.column: plain(asked)}
        entry["margin"] = plain(solution.margin[i])
        entry["points"] = {
            name: {
                "x": plain(point.place[i].real),
                "y": plain(point.place[i].imag),
                **_vector("v", complex(point.velocity[i])),
                **_vector("a", complex(point.acceleration[i])),
            }
            for name, point in solution.points.items()
        }
        entry["links"] = {
            name: {key: plain(values[i]) for key, values in columns.items()}
            for name, columns in links.items()
        }
        entry["analogues"] = told[i]
        entry["relative"] = [
            {
                "point": r.point,
                "of": r.of,
                "to": r.to,
                "v": plain(abs(r.velocity[i])),
                "a_coriolis": plain(abs(r.coriolis[i])),
                "a_rel": plain(abs(r.acceleration[i])),
                "vx": plain(r.velocity[i].real),
                "vy": plain(r.velocity[i].imag),
                "a_coriolis_x": plain(r.coriolis[i].real),
                "a_coriolis_y": plain(r.coriolis[i].imag),
                "a_rel_x": plain(r.acceleration[i].real),
                "a_rel_y": plain(r.acceleration[i].imag),
            }
            for r in solution.relatives
        ]
        entry["plans"] = {
            kind.value: {
                "mu": solution.scales[kind].per_mm,
                **({"pole": poles[kind]} if poles[kind] else {}),
                "segments": {name: _row(columns, i) for name, columns in segments[kind].items()},
            }
            for kind in MOTION
        }
        entry["hand"] = hand(i)
        if solution.problem.dynamics is not None:
            from planmethod.note.tables.forces import forces_record

            entry["forces"] = forces_record(solution, i)
        positions.append(entry)
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
        "positions": positions,
        **machine,
    }


def finite(value: Any) -> bool:
    """Tell whether every number of a record is finite."""
    if isinstance(value, dict):
        return all(finite(v) for v in value.values())
    if isinstance(value, list):
        return all(finite(v) for v in value)
    return not isinstance(value, float) or bool(np.isfinite(value))
