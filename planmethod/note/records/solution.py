"""Machine-readable record of a solution: the object that ``solve --json`` prints."""

from __future__ import annotations

from typing import Any

import numpy as np

from planmethod.mechanism.structure import Structure
from planmethod.note.numbers import finite_or_none, plain
from planmethod.note.records.cycle import analogue_records, cycle_record
from planmethod.plans.legend import TURNING, Quantity, QuantityKind
from planmethod.plans.model import MOTION, PlanKind
from planmethod.plans.motion.board import pole_letter
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.solution import Segment, Solution

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


def _segments(
    solution: Solution, kind: PlanKind, segments: list[Segment], index: int
) -> dict[str, dict[str, float | None]]:
    spreads = drafting_of(solution).spreads
    return {
        segment.name: {
            "exact": plain(segment.exact[index]),
            "read": finite_or_none(segment.read[index]),
            "sigma": finite_or_none(spreads[f"{kind.value}.{segment.name}"].sigma[index]),
        }
        for segment in segments
    }


def _hand(solution: Solution, index: int) -> dict[str, Any]:
    """Return what follows from the read segments, and one sigma of each quantity."""
    spreads = drafting_of(solution).spreads

    def told(quantities: list[Quantity]) -> dict[str, float | None]:
        """Return quantities and their sigmas."""
        record: dict[str, float | None] = {}
        for quantity in quantities:
            name, spread = (
                LONG.get(quantity.kind, quantity.kind.letter),
                spreads.get(quantity.label),
            )
            record[name] = finite_or_none(solution.read_off(quantity.label)[index])
            sigma = 0.0 if spread is None else finite_or_none(spread.sigma[index])
            record[f"sigma_{name}"] = sigma
        return record

    def place(name: str) -> dict[str, float | None]:
        return {
            f"sigma_{axis}": finite_or_none(spreads[f"{axis}_{name}"].sigma[index])
            for axis in ("x", "y")
        }

    points = solution.quantities(QuantityKind.VELOCITY, QuantityKind.ACCELERATION)
    links = solution.quantities(QuantityKind.OMEGA, QuantityKind.EPSILON)
    sliding = solution.quantities(
        QuantityKind.SLIDING, QuantityKind.CORIOLIS, QuantityKind.RELATIVE
    )
    return {
        "ruler": solution.hand.ruler,
        "profile": solution.profile.name,
        "points": {
            name: {**told(quantities), **place(name)} for name, quantities in points.items()
        },
        "links": {name: told(quantities) for name, quantities in links.items()},
        "relative": [
            {"point": r.point, "of": r.of, "to": r.to, **told(sliding[r.name])}
            for r in solution.construction.kinematics.relatives.values()
        ],
        "monte_carlo": [label for label, spread in spreads.items() if spread.drawn[index]],
    }


def record(solution: Solution) -> dict[str, Any]:
    """Return everything that a solution says as plain data, SI, full precision.

    ``segments`` are in millimetres of the plan: ``exact``, ``read`` with the ruler along the hand's
    own chain, and ``sigma``, one standard deviation of the drafting error. ``hand`` holds the
    quantities that follow from the read segments with theirs, and the labels of those whose sigma
    was found by random draws because first order does not hold. ``cycle`` is there for a problem
    with ``[cycle]``, ``forces`` for one with ``[dynamics]``: see `planmethod.note.tables.forces`.
    """
    segments = {kind: solution.segments(kind) for kind in MOTION}
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
                **({"pole": pole} if (pole := pole_letter(solution.problem, kind)) else {}),
                "segments": _segments(solution, kind, segments[kind], i),
            }
            for kind in MOTION
        }
        entry["hand"] = _hand(solution, i)
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
