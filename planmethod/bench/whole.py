"""The whole benchmark: which sections, in which order."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from planmethod.bench import report
from planmethod.bench.report import Table
from planmethod.problem.model import Problem

SECTIONS = ("speed", "forces", "hard", "random", "drafting")


def make(
    problems: Sequence[Problem],
    wanted: Sequence[str],
    say: Callable[[str], None],
    *,
    quick: bool,
    count: int,
) -> tuple[str, bytes]:
    """Return the document, or the sections wanted of it, and the figure (empty without speed).

    Parameters
    ----------
    problems : sequence of Problem
        Whose drafting errors are compared; those with loads over a turn, too.
    wanted : sequence of str
        Of `SECTIONS`.
    say : callable
        Told what is being measured.
    quick : bool
        A look, not a measurement.
    count : int
        Random mechanisms.
    """
    sections: list[Table] = []
    figure = b""
    if "speed" in wanted:
        measured, figure = report.measure(say, quick=quick)
        sections += measured
    if "forces" in wanted:
        from planmethod.bench.forces_report import forces_section

        say("forces")
        sections.append(forces_section(problems, quick=quick))
    if "hard" in wanted:
        from planmethod.bench.hard_report import hard_section

        say("hard cases")
        sections.append(hard_section())
    if "random" in wanted and count:
        sections.append(_random(count, say))
    if "drafting" in wanted and problems:
        from planmethod.bench.drawn import compare_all
        from planmethod.bench.random_report import drafting_section

        say("drafting errors")
        sections.append(drafting_section(compare_all(list(problems))))
    if figure:
        command = "planmethod bench" + (" --quick" if quick else "")
        if problems:
            names = sorted({problem.name for problem in problems})
            command += " " + (" ".join(names) if len(names) < 4 else "problems/*/*.toml")
        return report.document(sections, figure=f"{report.NAME}.png", command=command), figure
    return "\n".join(line for section in sections for line in [*section, ""]), figure


def _random(count: int, say: Callable[[str], None]) -> Table:
    from planmethod.bench.random_report import random_section
    from planmethod.bench.random_run import Tally, run, wrong_branches

    tally = Tally()
    for tally in run(count):
        if tally.mechanisms % 1000 == 0:
            say(f"random mechanisms, {tally.mechanisms} of {count}")
    say("branches of crank-rockers")
    return random_section(tally, wrong_branches(min(count, 3000)))
