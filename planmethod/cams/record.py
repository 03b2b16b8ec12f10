"""JSON record of a cam (запись для JSON), and the table of its profile."""

from __future__ import annotations

from functools import partial
from math import gcd
from typing import Any

import numpy as np

from planmethod.cams.design import CamDesign
from planmethod.cams.divisions import motion_in_division, nodes_of
from planmethod.cams.laws import Reals
from planmethod.cams.model import TURN, CamPhase, CamProblem
from planmethod.note.numbers import finite_or_none
from planmethod.note.records.legend import legend_record
from planmethod.note.records.spreadsheet import SpreadsheetRows

KEYS = (
    "phi_deg", "s", "v_q", "a_q", "pressure_deg", "x", "y", "x_theoretical", "y_theoretical", "rho",
)  # fmt: skip
LEGEND = (
    ("phi_deg", "φ", "deg"), ("s", "s", "m"), ("v_q", "v_{q}", "m"), ("a_q", "a_{q}", "m"),
    ("pressure_deg", "ϑ", "deg"), ("x", "x", "m"), ("y", "y", "m"), ("x_theoretical", "x_{0}", "m"),
    ("y_theoretical", "y_{0}", "m"), ("rho", "ρ", "m"), ("r_min", "r_{min}", "m"), ("e", "e", "m"),
    ("centre_distance", "a", "m"), ("roller", "r_{p}", "m"), ("curvature_min", "ρ_{min}", "m"),
)  # fmt: skip


def rows(design: CamDesign, count: int = 0) -> list[dict[str, float]]:
    """Return all or ``count`` positions; m, degrees; ``rho`` is of the pitch curve."""
    count = count or design.problem.count
    phi = TURN * np.arange(count) / count
    return _rows(design, 360.0 * np.arange(count) / count, phi, design.problem.at(phi))


def division_rows(design: CamDesign) -> list[tuple[int, dict[str, float]]]:
    """Return the same in the divisions of the diagrams, with their numbers."""
    nodes = nodes_of(design.problem)
    phi = np.array([node.phi for node in nodes])
    moved = np.array([motion_in_division(design.problem, node) for node in nodes]).T
    found = _rows(design, np.degrees(phi), phi, moved)
    return [(node.number, row) for node, row in zip(nodes, found, strict=True)]


def _rows(design: CamDesign, degrees: Reals, phi: Reals, motion: Reals) -> list[dict[str, float]]:
    at = design.geometry.points(phi, motion)
    mirror = design.problem.mirror
    with np.errstate(divide="ignore"):
        rho = 1 / at.curvature
    columns = (
        degrees, *motion, np.degrees(at.pressure),
        mirror * at.actual.real, at.actual.imag,
        mirror * at.theoretical.real, at.theoretical.imag, rho,
    )  # fmt: skip
    return [dict(zip(KEYS, map(float, row), strict=True)) for row in np.array(columns).T]


PROFILE_ROWS = 720
"""Rows of the table of a profile: every half degree."""


def spreadsheet(problem: CamProblem) -> SpreadsheetRows:
    """Return the profile as a table: every half degree, m and degrees; positions among them."""
    design = CamDesign(problem)
    count = PROFILE_ROWS * problem.count // gcd(PROFILE_ROWS, problem.count)
    told = rows(design, count)
    values = [[row[key] + 0.0 for key in KEYS] for row in told]
    return SpreadsheetRows(problem, KEYS, len(values), partial(iter, [values]))


def record(problem: CamProblem, lang: str = "ru") -> dict[str, Any]:
    """Return one object for a problem: metres and degrees, full precision.

    Raises
    ------
    ProblemError
        No cam satisfies the requirements.
    """
    design = CamDesign(problem)
    geometry, cut = design.geometry, design.undercut
    rise, back = (design.pressure(phase) for phase in (CamPhase.RISE, CamPhase.RETURN))
    told: dict[str, Any] = {"schema": 1, "problem": problem.name, "kind": "cam"}
    if problem.variant is not None:
        told["variant"] = problem.variant
    place = {} if cut is None else {"x": problem.mirror * cut.point.real, "y": cut.point.imag}
    degrees = np.degrees
    return {
        **told,
        "r_min": geometry.r_min,
        "e": None if problem.oscillates else geometry.e,
        "centre_distance": geometry.centre if problem.oscillates else None,
        "roller": geometry.roller,
        "pressure_deg": {
            "rise": float(degrees(rise.value)),
            "return": float(degrees(back.value)),
            "at_deg": {"rise": float(degrees(rise.phi)), "return": float(degrees(back.phi))},
        },
        "curvature_min": finite_or_none(design.rho_min.value),
        "undercut": cut
        and {
            "phi_deg": float(degrees(cut.phi)),
            "from_deg": float(degrees(cut.start)),
            "to_deg": float(degrees(cut.end)),
            "rho": cut.rho,
            **place,
            "outer": cut.outer,
        },
        "jumps": [
            {
                "phi_deg": float(degrees(jump.phi)),
                "of": "v_q" if jump.order == 1 else "a_q",
                "before": float(jump.before[jump.order]),
                "after": float(jump.after[jump.order]),
            }
            for jump in problem.jumps
        ],
        "positions": [
            {key: finite_or_none(value) for key, value in row.items()} for row in rows(design)
        ],
        "legend": legend_record(LEGEND),
    }
