"""Machine-readable record of a moving point: the object that ``solve --json`` prints."""

from __future__ import annotations

from typing import Any

from planmethod.moving.model import PointProblem
from planmethod.moving.motion import LEGEND, move
from planmethod.note.numbers import finite_or_none
from planmethod.note.records.legend import legend_record

SCHEMA = 1
"""Version of the record's shape."""


def record(problem: PointProblem, lang: str = "ru") -> dict[str, Any]:
    """Return the motion of a point as plain data; a missing value is null, with a reason."""
    motion = move(problem)
    rows: list[dict[str, Any]] = []
    for k, why in enumerate(motion.reasons):
        row: dict[str, Any] = {
            name: finite_or_none(column[k]) for name, column in motion.columns.items()
        }
        if why is not None:
            row["reason"] = why.value
        rows.append(row)
    found: dict[str, Any] = {"schema": SCHEMA, "problem": problem.name}
    if problem.variant is not None:
        found["variant"] = problem.variant
    legend = ((name, LEGEND[name].symbol, LEGEND[name].unit) for name in motion.columns)
    return {**found, "point": rows, "legend": legend_record(legend)}
