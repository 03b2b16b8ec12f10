"""Section of the document that is about forces: time beside error, lever beside force plans."""

from __future__ import annotations

import math
from collections.abc import Sequence

from planmethod.bench.forces import DRAWS, Discrepancy, discrepancy, readings
from planmethod.bench.report import Table, number, span, table
from planmethod.bench.speed import RIGHT, Reading
from planmethod.problem.model import Problem


def forces_section(problems: Sequence[Problem], *, quick: bool) -> Table:
    """Measure, and return the section; ``problems`` without loads are left out."""
    found = readings((1, 12) if quick else (1, 12, 10_000))
    loaded = [problem for problem in problems if problem.dynamics is not None]
    lines = _readings(found)
    if loaded:
        lines += ["", *_discrepancies([discrepancy(problem) for problem in loaded])]
    return lines


def _readings(found: Sequence[Reading]) -> Table:
    rows = [
        (
            one.name,
            f"{one.positions:,}".replace(",", " "),
            span(one.seconds),
            span(one.per_position),
            "—" if math.isnan(one.error) else number(one.error),
        )
        for one in found
    ]
    return [
        "## Forces",
        "",
        f"{found[0].scene}: all reactions and the balancing moment. The error is the largest one "
        f"against a referee of {RIGHT} digits, in units of the largest reaction of its position; "
        "that of the hand is of what it reads of the sizes. The force plans go on from the program "
        "of the motion and are timed with it; the linear system begins with a motion that is "
        "known.",
        "",
        *table(("reading", "positions", "time", "for a position", "largest error"), rows),
    ]


def _discrepancies(found: Sequence[Discrepancy]) -> Table:
    rows = [
        (
            one.problem,
            str(one.positions),
            f"{one.least:.2f}–{one.most:.2f}",
            f"{100 * one.usual[0]:.1f}–{100 * one.usual[1]:.1f} %",
        )
        for one in found
    ]
    return [
        "Lever minus force plans of a board draughtsman: the expected size, to first order through "
        f"every stroke, over that of {DRAWS} random sheets (half of the middle 68 %), position by "
        "position; and the expected size as a part of the largest balancing moment.",
        "",
        *table(("problem", "positions", "expected over drawn", "expected, of the largest"), rows),
    ]
