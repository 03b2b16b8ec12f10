"""Machine-readable record of static balancing: ``balancing`` of ``solve --json``."""

from __future__ import annotations

from typing import Any

import numpy as np

from planmethod.note.compared_machine import compared_moment
from planmethod.note.narrate.balancing import COUNT
from planmethod.note.numbers import record_float
from planmethod.solved.machine.balancing import SAMPLES, balancing_of
from planmethod.solved.reading import Complexes
from planmethod.solved.solution import Solution


def balancing_record(solution: Solution) -> dict[str, Any]:
    """Return masses, counterweights, forces and centres, SI and degrees.

    Masses in the pins of a rod whose centre of mass is off their line are null.
    """
    made = balancing_of(solution)
    before, after = made.forces(COUNT)
    off_line = abs(made.share.imag) > 1e-9 * max(abs(made.share), 1.0)
    weights = []
    for number, one in enumerate(made.counterweights):
        both = compared_moment(made, number, solution.profile)
        weights.append(
            {
                "link": one.link,
                "about": one.pivot,
                "line": one.pivot + one.pin,
                "terms": {name: _vector(value) for name, value in one.terms},
                "mr": record_float(both.exact),
                "mr_read": record_float(both.read),
                "r": record_float(one.radius),
                "m": record_float(one.mass),
                "angle_deg": record_float(one.angle_deg),
            }
        )
    return {
        "structure": made.structure,
        "method": made.task.method.value,
        "share": made.task.share,
        "rod": {
            "link": made.rod,
            **{
                pin: None if off_line else record_float(mass.real)
                for pin, mass in zip((made.crank_pin, made.rod_pin), made.rod_masses, strict=True)
            },
            **({"reason": "its centre of mass is off the line of its pins"} if off_line else {}),
        },
        "counterweights": weights,
        "mass": {"before": record_float(made.mass_before), "after": record_float(made.mass_after)},
        "force": {
            name: _largest(column, made.phi(SAMPLES))
            for name, column in zip(("before", "after"), made.forces(SAMPLES), strict=True)
        },
        "centre": {
            name: {
                "x": [record_float(np.min(column.real)), record_float(np.max(column.real))],
                "y": [record_float(np.min(column.imag)), record_float(np.max(column.imag))],
            }
            for name, column in zip(("before", "after"), made.centres(SAMPLES), strict=True)
        },
        "positions": [
            {"phi_deg": record_float(phi), "before": _vector(one), "after": _vector(two)}
            for phi, one, two in zip(made.phi(COUNT), before, after, strict=True)
        ],
    }


def _vector(value: complex) -> dict[str, float]:
    return {"x": record_float(value.real), "y": record_float(value.imag)}


def _largest(column: Complexes, phi: Any) -> dict[str, float]:
    at = int(np.argmax(np.abs(column)))
    return {"max": record_float(abs(column[at])), "phi_deg": record_float(phi[at])}
