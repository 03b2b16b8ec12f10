"""Machine-readable record of a solution: the object that ``solve --json`` prints."""

from __future__ import annotations

from typing import Any

import numpy as np

from planmethod.mechanism.structure import Structure
from planmethod.note.numbers import finite_or_none, plain
from planmethod.plans.model import MOTION, PlanKind
from planmethod.plans.motion.board import pole_letter
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.solution import Segment, Solution

SCHEMA = 1
"""Version of the record's shape."""

LONG = {"ak": "a_coriolis", "ar": "a_rel"}
"""Names in the record of what is called shorter in the labels of drafting errors."""


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

    def told(label: str) -> dict[str, float | None]:
        """Return a quantity and its sigma; the name is the first part of the label."""
        name = LONG.get(label.split("_")[0], label.split("_")[0])
        spread = spreads.get(label)
        sigma = 0.0 if spread is None else finite_or_none(spread.sigma[index])
        value = finite_or_none(solution.read_off(label)[index])
        return {name: value, f"sigma_{name}": sigma}

    def place(name: str) -> dict[str, float | None]:
        return {
            f"sigma_{axis}": finite_or_none(spreads[f"{axis}_{name}"].sigma[index])
            for axis in ("x", "y")
        }

    sliding = solution.construction.kinematics.relatives.values()
    return {
        "ruler": solution.hand.ruler,
        "profile": solution.profile.name,
        "points": {
            name: {**told(f"v_{name}"), **told(f"a_{name}"), **place(name)}
            for name in solution.points
        },
        "links": {
            name: {**told(f"omega_{name}"), **told(f"epsilon_{name}")} for name in solution.links
        },
        "relative": [
            {
                "point": r.point,
                "of": r.of,
                "to": r.to,
                **told(r.label("v")),
                **told(r.label("ak")),
                **told(r.label("ar")),
            }
            for r in sliding
        ],
        "monte_carlo": [label for label, spread in spreads.items() if spread.drawn[index]],
    }


def record(solution: Solution) -> dict[str, Any]:
    """Return everything that a solution says as plain data, SI, full precision.

    ``segments`` are in millimetres of the plan: ``exact``, ``read`` with the ruler along the hand's
    own chain, and ``sigma``, one standard deviation of the drafting error. ``hand`` holds the
    quantities that follow from the read segments with theirs, and the labels of those whose sigma
    was found by random draws because first order does not hold. ``forces`` is there for a problem
    with ``[dynamics]``: see `planmethod.note.tables.forces`.
    """
    segments = {kind: solution.segments(kind) for kind in MOTION}
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
            name: {
                "phi_deg": plain(link.phi_deg[i]),
                "omega": plain(link.omega[i]),
                "epsilon": plain(link.epsilon[i]),
            }
            for name, link in solution.links.items()
        }
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
    return {
        "schema": SCHEMA,
        "problem": solution.problem.name,
        **({"variant": v} if (v := solution.problem.variant) is not None else {}),
        "structure": structure_record(solution.structure),
        "positions": positions,
    }


def finite(value: Any) -> bool:
    """Tell whether every number of a record is finite."""
    if isinstance(value, dict):
        return all(finite(v) for v in value.values())
    if isinstance(value, list):
        return all(finite(v) for v in value)
    return not isinstance(value, float) or bool(np.isfinite(value))
