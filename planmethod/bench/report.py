"""Sections of a report on the speed and the errors of one's own problems, in Markdown."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

from planmethod.bench import forces, speed
from planmethod.bench.drawn import DRAWS, Compared, compare_all
from planmethod.problem.model import Problem

Table = list[str]

COUNTS = (1, 12, 10_000)
"""Numbers of positions that are timed."""


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> Table:
    """Return a Markdown table; columns after the first are set right."""
    head = f"| {' | '.join(header)} |"
    rule = "| --- | " + " | ".join("---:" for _ in header[1:]) + " |"
    return [head, rule, *(f"| {' | '.join(row)} |" for row in rows)]


def span(seconds: float) -> str:
    """Return a time with three digits and its unit."""
    for factor, unit in ((1.0, "s"), (1e3, "ms"), (1e6, "µs")):
        if seconds * factor >= 1.0:
            return f"{seconds * factor:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def number(value: float) -> str:
    """Return an error with two digits; a dash where there is none."""
    return "—" if math.isnan(value) else "0" if value == 0 else f"{value:.1e}"


def timed(found: Sequence[speed.Reading]) -> Table:
    """Return the table of time beside error."""
    rows = [
        (
            one.name,
            one.problem,
            f"{one.positions:,}".replace(",", " "),
            span(one.seconds),
            span(one.per_position),
            number(one.error),
        )
        for one in found
    ]
    return table(
        ("reading", "problem", "positions", "time", "for a position", "largest error"), rows
    )


def speed_section(readings: Sequence[speed.Reading]) -> Table:
    """Return time beside error of the motion."""
    return [
        "## Time against error",
        "",
        "Position, velocity and acceleration of every point and link. The error is the largest one "
        f"against a referee of {speed.RIGHT} digits: of a sweep, each row in units of its own "
        f"largest value (at most {speed.JUDGED} positions, evenly spread); of one position and of "
        "the hand, in units of the largest result of its kind. The hand reads the plans at the "
        "scales that planmethod chooses; its error is that of reading alone.",
        "",
        *timed(readings),
    ]


def forces_section(
    readings: Sequence[speed.Reading], lever: Sequence[forces.Discrepancy], *, more: str = ""
) -> Table:
    """Return time beside error of the force plans, and the lever beside them.

    Parameters
    ----------
    more : str
        What else is to be said of the readings.
    """
    rows = [
        (
            one.problem,
            str(one.positions),
            f"{one.least:.2f}–{one.most:.2f}",
            f"{100 * one.usual[0]:.1f}–{100 * one.usual[1]:.1f} %",
        )
        for one in lever
    ]
    lines = [
        "## Forces",
        "",
        "All reactions and the balancing moment. The error is the largest one against a referee of "
        f"{speed.RIGHT} digits, in units of the largest reaction of its position; that of the hand "
        "is the error of the sizes it reads. The force plans continue the program of the motion "
        f"and are timed together with it{more}.",
        "",
        *timed(readings),
    ]
    if rows:
        lines += [
            "",
            "Lever minus force plans of a board draughtsman: the expected size, to first order "
            f"through every stroke, over that of {forces.DRAWS} random sheets (half of the middle "
            "68 %), position by position; and the expected size as a part of the largest balancing "
            "moment.",
            "",
            *table(
                ("problem", "positions", "expected over drawn", "expected, of the largest"), rows
            ),
        ]
    return lines


def drafting_section(rows: Sequence[Compared]) -> Table:
    """Return first-order drafting errors beside random sheets."""
    return [
        "## Drafting errors: first order against random sheets",
        "",
        f"Sigma by first order over the standard deviation of {DRAWS} random sheets, least and "
        "most over all quantities of a problem that are longer than three sigmas. *Given up*: "
        "quantities whose first order is not believed, because a step is not ten of its own sigmas "
        "away from being impossible; *short*: quantities below three sigmas. Both have the sigma "
        "of the random sheets.",
        "",
        *table(
            ("problem", "hand", "compared", "least", "most", "given up", "short"),
            [
                (
                    row.problem,
                    row.profile,
                    str(row.compared),
                    f"{row.least:.3f}",
                    f"{row.most:.3f}",
                    str(row.given_up),
                    str(row.short),
                )
                for row in rows
            ],
        ),
    ]


def _speed(problems: Sequence[Problem]) -> Table:
    found: list[speed.Reading] = []
    for problem in problems:
        found += [*speed.sweeps(problem, COUNTS), *speed.single_readings(problem)]
    return speed_section(found)


def _forces(problems: Sequence[Problem]) -> Table:
    """Return the section on problems with loads; there is none without them."""
    loaded = [problem for problem in problems if problem.dynamics is not None]
    found = [one for problem in loaded for one in forces.readings(problem, COUNTS)]
    lever = [forces.discrepancy(problem) for problem in loaded]
    return forces_section(found, lever) if loaded else []


def _drafting(problems: Sequence[Problem]) -> Table:
    return drafting_section(compare_all(problems))


SECTIONS: dict[str, Callable[[Sequence[Problem]], Table]] = {
    "speed": _speed,
    "forces": _forces,
    "drafting": _drafting,
}
"""What is measured of problems, by the name of the section."""
