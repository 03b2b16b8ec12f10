"""The whole benchmark: which sections, in which order."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from benchmarks import at_once, report
from benchmarks.hard_report import hard_section
from benchmarks.random_report import random_section
from benchmarks.random_run import Tally, run, wrong_branches
from benchmarks.scenes import loaded
from planmethod.bench import measurements
from planmethod.bench.measurements import compare_all
from planmethod.bench.report import Table, drafting_section, forces_section, machine_section
from planmethod.problem.model import Problem

MEASURED = ("speed", "peers", "size", "commands", "many")
"""Sections on speed, by the names of the methods of `report.Measured`."""

SECTIONS = (*MEASURED, "forces", "hard", "random", "machine", "drafting")


def make(
    problems: Sequence[Problem],
    wanted: Sequence[str],
    say: Callable[[str], None],
    *,
    quick: bool,
    count: int,
) -> tuple[str, bytes]:
    """Return the document, or its requested sections, and the figure (empty unless all are).

    Parameters
    ----------
    problems : sequence of Problem
        Problems whose drafting errors are compared, over a turn too for those with loads.
    wanted : sequence of str
        Names from `SECTIONS`.
    say : callable
        Called with the name of the section being measured.
    quick : bool
        A look, not a measurement.
    count : int
        Number of random mechanisms.
    """
    sections: list[Table] = []
    measured = report.Measured(quick=quick)
    for name in MEASURED:
        if name in wanted:
            say(name)
            sections.append(getattr(measured, name)())
    figure = measured.figure() if set(wanted) >= set(SECTIONS) else b""
    if "forces" in wanted:
        say("forces")
        sections.append(_forces(problems, (1, 12) if quick else (1, 12, 10_000)))
    if "hard" in wanted:
        say("hard cases")
        sections.append(hard_section())
    if "random" in wanted and count:
        sections.append(_random(count, say))
    if "machine" in wanted and (found := machine_section(problems)):
        say("flywheels")
        sections.append(found)
    if "drafting" in wanted and problems:
        say("drafting errors")
        sections.append(drafting_section(compare_all(problems)))
    if figure:
        command = "python -m benchmarks" + (" --quick" if quick else "")
        if problems:
            names = sorted({problem.name for problem in problems})
            command += " " + (" ".join(names) if len(names) < 4 else "problems/*/*.toml")
        return report.document(sections, figure=f"{report.NAME}.png", command=command), figure
    return "\n".join(line for section in sections for line in [*section, ""]), figure


def _forces(problems: Sequence[Problem], counts: Sequence[int]) -> Table:
    scene = loaded()
    readings = [*measurements.readings(scene, counts), *at_once.readings(scene, counts)]
    lever = [measurements.discrepancy(one) for one in problems if one.dynamics is not None]
    more = "; the linear system starts from a motion that is known"
    return forces_section(readings, lever, more=more)


def _random(count: int, say: Callable[[str], None]) -> Table:
    tally = Tally()
    for tally in run(count):
        if tally.mechanisms % 1000 == 0:
            say(f"random mechanisms, {tally.mechanisms} of {count}")
    say("branches of crank-rockers")
    return random_section(tally, wrong_branches(min(count, 3000)))
