"""Sections of a report on the speed and the errors of one's own problems, in Markdown."""

# no messages: a document for developers

from __future__ import annotations

import math
import os
from collections import Counter
from collections.abc import Callable, Iterable, Sequence

from planmethod.bench import fairness, measurements
from planmethod.bench.measurements import DRAWS, Compared, compare_all
from planmethod.check.calculation import Calculation
from planmethod.check.key import Key
from planmethod.problem.model import Problem
from planmethod.solved.machine.flywheel import Flywheel

Table = list[str]

COUNTS = (1, 12, 10_000)
"""Numbers of positions that are timed."""

WORKS = 20
"""Number of faultless submissions checked for a problem."""


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> Table:
    """Return a Markdown table; columns after the first are set right."""
    head = f"| {' | '.join(header)} |"
    rule = "| --- | " + " | ".join("---:" for _ in header[1:]) + " |"
    return [head, rule, *(f"| {' | '.join(row)} |" for row in rows)]


def span(seconds: float) -> str:
    """Return a time with three digits and its unit; a dash for NaN."""
    if math.isnan(seconds):
        return "—"
    for factor, unit in ((1.0, "s"), (1e3, "ms"), (1e6, "µs")):
        if seconds * factor >= 1.0:
            return f"{seconds * factor:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def number(value: float) -> str:
    """Return an error with two digits; a dash for NaN."""
    return "—" if math.isnan(value) else "0" if value == 0 else f"{value:.1e}"


def load() -> str:
    """Return how busy the machine was, as a clause."""
    if not hasattr(os, "getloadavg"):
        return "the load of the machine is unknown"
    return f"{os.getloadavg()[0]:.1f} processes were busy on {os.cpu_count()} cores"


def timed(readings: Sequence[measurements.ReadSpeed]) -> Table:
    """Return the table of times and errors."""
    rows = [
        (
            one.name,
            one.problem,
            f"{one.positions:,}".replace(",", " "),
            span(one.seconds),
            span(one.per_position),
            number(one.error),
        )
        for one in readings
    ]
    return table(
        ("reading", "problem", "positions", "time", "for a position", "largest error"), rows
    )


def speed_section(readings: Sequence[measurements.ReadSpeed]) -> Table:
    """Return times and errors of the motion."""
    return [
        "## Time against error",
        "",
        "Position, velocity and acceleration of every point and link. The error is the largest one "
        f"against a referee of {measurements.RIGHT} digits: of a sweep, each row in units of its "
        f"own largest value (at most {measurements.CHECKED_MOTIONS} positions, evenly spread); of "
        "one position and of the hand, in units of the largest result of its kind. The hand "
        "reads the plans at the "
        "scales that planmethod chooses; its error is that of reading alone. Sweeps take turns, "
        f"nine rounds; {load()}.",
        "",
        *timed(readings),
    ]


def forces_section(
    readings: Sequence[measurements.ReadSpeed],
    lever: Sequence[measurements.Discrepancy],
    *,
    more: str = "",
) -> Table:
    """Return times and errors of the force plans, and the comparison with the lever.

    Parameters
    ----------
    more : str
        Addition to the sentence on the readings.
    """
    rows = [
        (
            one.problem,
            str(one.positions),
            f"{one.minimum:.2f}–{one.maximum:.2f}",
            f"{100 * one.usual[0]:.1f}–{100 * one.usual[1]:.1f} %",
        )
        for one in lever
    ]
    lines = [
        "## Forces",
        "",
        "All reactions and the balancing moment. The error is the largest one against a referee of "
        f"{measurements.RIGHT} digits, in units of the largest reaction of its position; that of "
        "the hand is the error of the sizes it reads. The force plans continue the program of the "
        f"motion and are timed together with it{more}.",
        "",
        *timed(readings),
    ]
    if rows:
        lines += [
            "",
            "Lever minus force plans of a board draughtsman: the expected size, to first order "
            f"through every stroke, over that of {measurements.DRAWS} random sheets (half of the "
            "middle 68 %), position by position; and the expected size as a part of the "
            "largest balancing moment.",
            "",
            *table(
                ("problem", "positions", "expected over drawn", "expected, of the largest"), rows
            ),
        ]
    return lines


def drafting_section(rows: Sequence[Compared]) -> Table:
    """Return first-order drafting errors compared with random sheets."""
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
                    f"{row.minimum:.3f}",
                    f"{row.maximum:.3f}",
                    str(row.nonlinear),
                    str(row.short),
                )
                for row in rows
            ],
        ),
    ]


def _percent(part: float, total: float) -> str:
    return f"{100 * part / total:.1f} %" if total else "—"


def faultless_table(results: Sequence[fairness.FaultlessStats]) -> Table:
    """Return the rates of false alarms, next to flat tolerances on the same submissions."""
    rows = [
        (
            f"{one.problem}, {one.profile}",
            str(one.works),
            _percent(one.unseen, one.answers),
            _percent(one.faulted, one.answers),
            _percent(one.hurt, one.works),
            _percent(one.named, one.works),
            *(_percent(one.flat[share], one.answers) for share in fairness.FLAT),
            *(_percent(one.flat_hurt[share], one.works) for share in fairness.FLAT),
        )
        for one in results
    ]
    flat = [f"{share:.0%}".replace("%", " %") for share in fairness.FLAT]
    header = (
        "problem, hand", "works", "not shown", "answers faulted", "works faulted", "named",
        *(f"answers, flat {share}" for share in flat), *(f"works, flat {share}" for share in flat),
    )  # fmt: skip
    return table(header, rows)


def _codes(results: Sequence[fairness.Detected]) -> list[str]:
    """Return the codes of mistakes: of plans, of scales and numbers, of forces."""
    families = "VANESPFZ"
    return sorted({o.code for o in results}, key=lambda c: (f"{families}{c[0]}".index(c[0]), c))


def mistakes_table(results: Sequence[fairness.Detected]) -> Table:
    """Return the detection of planted mistakes, over all problems together."""
    rows = []
    for code in [*_codes(results), ""]:
        of = [one for one in results if code in ("", one.code)]
        works = sum(one.works for one in of)
        shares = [
            _percent(sum(counts), works)
            for counts in zip(
                *((o.noticed, o.named, o.among, o.unknown, o.misnamed) for o in of), strict=True
            )
        ]
        taken = sum((one.named_as for one in of), Counter[str]())
        names = ", ".join(f"{name} {n}" for name, n in taken.most_common(4)) if code else ""
        rows.append((code or "all", str(works), *shares, names))
    return table(
        ("mistake", "works", "seen", "named", "among several", "not named", "wrongly", "as"), rows
    )


def power_table(results: Sequence[fairness.Detected]) -> Table:
    """Return the percentages of planted mistakes noticed and named, by mistake and problem."""
    problems = list(dict.fromkeys(one.problem for one in results))
    rows = []
    for code in _codes(results):
        cells = {
            one.problem: f"{100 * one.noticed / one.works:.0f}/{100 * one.named / one.works:.0f}"
            for one in results
            if one.code == code and one.works
        }
        rows.append((code, *(cells.get(problem, "") for problem in problems)))
    return table(("mistake", *problems), rows)


def hidden_table(keys: Sequence[tuple[str, Key]]) -> Table:
    """Return the mistakes that the answers of problems cannot show, with their places."""
    codes = sorted({code for _, key in keys for code in key.hidden})
    rows = [
        (code, *(", ".join(filter(None, key.hidden.get(code, ()))) or
                 ("all" if code in key.hidden else "") for _, key in keys))
        for code in codes
    ]  # fmt: skip
    return table(("mistake", *(name for name, _ in keys)), rows)


FAMILIES = {"levers": "levers", "forces": "with forces", "gears": "trains", "point": "points"}
"""Families of problems as the tables call them; others by their own table."""


def confusion_tables(results: fairness.Confusion) -> Table:
    """Return by families whom the checking faults, what it names, and what it inherits."""
    families = list(dict.fromkeys(family for family, _ in results.faultless))
    mistaken = {
        "one mistake": [one for one in results.detected if one.code != "P2"],
        "two mistakes": results.two,
        "another variant": [one for one in results.detected if one.code == "P2"],
    }
    rows = []
    for what, planted in mistaken.items():
        for family in [*families, "all"]:
            of = [one for one in planted if family in (one.family, "all")]
            if any(one.works for one in of):
                rows.append((f"{FAMILIES.get(family, family)}, {what}", *_named_row(of)))
    lost = []
    for family in [*families, "all"]:
        honest = [one for of, one in results.faultless if family in (of, "all")]
        own = [one for one in results.inherited if family in (one.family, "all")]
        answers = sum(one.answers for one in honest), sum(one.answers for one in own)
        faulted, inherited = sum(o.faulted for o in honest), sum(o.faulted for o in own)
        cells = _percent(faulted, answers[0]), str(answers[1]), _percent(inherited, answers[1])
        lost.append((FAMILIES.get(family, family), str(answers[0]), *cells))
    taken = Counter[str]()
    for one in (*results.detected, *results.two):
        taken.update({f"{one.code} as {name}": n for name, n in one.named_as.items()})
    phrase = ", ".join(f"{name} {n}" for name, n in taken.most_common(12)) or "none"
    return [
        *table(
            ("family", "honest answers", "faulted", "inherited answers", "losing points"), lost
        ),
        "",
        *table(
            ("works with", "works", "seen", "named", "among two or three", "not named", "wrongly",
             "over half of the points"),
            rows,
        ),
        "",
        f"Wrongly named, the commonest: {phrase}.",
    ]  # fmt: skip


def _named_row(results: Sequence[fairness.Detected]) -> list[str]:
    works = sum(one.works for one in results)
    counts = (
        sum(getattr(one, name) for one in results)
        for name in ("noticed", "named", "among", "unknown", "misnamed", "over_half")
    )
    return [str(works), *(_percent(count, works) for count in counts)]


def checking_speed(timings: Sequence[fairness.Speed]) -> Table:
    """Return how long the checking takes."""
    rows = [
        (
            one.problem,
            str(one.answers),
            *map(span, (one.first, one.faultless, one.mistaken, one.key, one.group)),
        )
        for one in timings
    ]
    return table(
        (
            "problem", "answers", "first submission", "further, without a mistake",
            "further, with a mistake", "key", f"group of {fairness.GROUP} with pages",
        ),
        rows,
    )  # fmt: skip


def checking_section(items: Sequence[fairness.ProblemOfKind], works: int = WORKS) -> Table:
    """Return the results of checking simulated submissions, first those drawn, then computed.

    Parameters
    ----------
    works : int
        Honest ones of each problem and profile; with each mistake at each place a tenth of them.
    """
    mistaken = max(1, works // 10)
    tasks = fairness.tasks_of_kinds(items)
    drawn = [task for task in tasks if not isinstance(task, Calculation)]
    problems = [task.solution.problem for task in drawn]
    computed = [task for task in tasks if isinstance(task, Calculation)]
    confused = fairness.confused([*drawn, *computed], works)
    together = [
        "## By families",
        "",
        "Works of the board's profile; of trains and points, numbers computed and rounded to three "
        f"digits or four. Two mistakes: at most {fairness.PAIRS} pairs in each linkage, of which "
        f"neither mistake alone gives {fairness.MIN_DIFFERENT_ANSWERS} of the answers; *named*: "
        "both, *among*: one of them, or a right one among two or three. Inherited: one number "
        "is wrong, and the "
        "plans, another formula of the textbook or the formulas of a train go on with it.",
        "",
        *confusion_tables(confused),
        "",
    ]
    if not problems:
        return together
    found = [one for one in confused.detected if one.family in ("levers", "forces")]
    return [
        *together,
        "## Submissions without a mistake",
        "",
        f"{works} works of every problem, drawn stroke by stroke with the errors of a profile, "
        "judged by the tolerance of the same profile with the usual settings. *Not shown*: "
        "answers that the drawing cannot show, judged by the student's own numbers; *faulted*: "
        "what loses points; *named*: works in which a mistake is named, or several that it may "
        "be. Flat tolerances reject answers of the same works, those that are nothing left out.",
        "",
        *faultless_table(fairness.check_all_faultless(problems, works)),
        "",
        "## Submissions with a mistake",
        "",
        f"Works of the board's profile, {mistaken} with each mistake at each of at most "
        f"{fairness.PLACES} places, where it shows. *Seen*: an answer is faulted, or follows from "
        "a faulted one; *named*: the mistake is named, or one that gives the same answers; *among "
        'several*: "one of" two or three; *not named*: "not recognised", or more than three; '
        "*wrongly*: another one is named.",
        "",
        *mistakes_table(found),
        "",
        "Seen and named, percent, by problem; empty if the mistake cannot be made, or not be seen.",
        "",
        *power_table(found),
        "",
        "## Mistakes that the answers cannot show",
        "",
        "Places (link, point, pair) where a mistake can be made without any answer being "
        "off by more than drafting errors: the key states them in advance.",
        "",
        *hidden_table(fairness.hidden(problems)),
        "",
        "## Speed",
        "",
        "The first submission includes solving the problem, finding the tolerances and "
        "explaining a mistake; pages are HTML and PDF, every other submission of the group "
        "has the mistake.",
        "",
        *checking_speed([fairness.speed(problem) for problem in problems]),
    ]


def _speed(problems: Sequence[Problem]) -> Table:
    found: list[measurements.ReadSpeed] = []
    for problem in problems:
        found += [*measurements.sweeps(problem, COUNTS), *measurements.single_readings(problem)]
    return speed_section(found)


def _forces(problems: Sequence[Problem]) -> Table:
    """Return the section on problems with loads; empty if none has loads."""
    loaded = [problem for problem in problems if problem.dynamics is not None]
    found = [one for problem in loaded for one in measurements.readings(problem, COUNTS)]
    lever = [measurements.discrepancy(problem) for problem in loaded]
    return forces_section(found, lever) if loaded else []


def _cycle(problems: Sequence[Problem]) -> Table:
    """Return the section on cycles of a crank; empty if no crank rotates fully."""
    rows, said, cost = [], [], []
    for problem in problems:
        turn = measurements.turn_for(problem)
        if turn is None or turn.is_stationary:
            continue
        found = [measurements.calculus(turn, count) for count in measurements.COUNTS]
        for one in found:
            errors = (part for off in (one.v, one.a, one.s) for part in (off.maximum, off.rms))
            moved = (part for pair in one.ruler_effect for part in pair)
            rows.append((problem.name, str(one.count), *(f"{x:.3g}" for x in (*errors, *moved))))
        for which, ruler in enumerate(measurements.RULERS):
            first = measurements.ruler_limit_count(found, which)
            text = f"from {first} positions on" if first else "at none of these counts"
            said.append(f"- {problem.name}: the ruler of {ruler:g} mm limits v {text}.")
        cost += [
            (what, problem.name, str(count), span(seconds), span(seconds / count))
            for what, count, seconds in measurements.costs(problem)
        ]
    if not rows:
        return []
    head = [f"{letter} {kind}" for letter in ("v", "a", "s") for kind in ("max", "rms")]
    head += [f"{letter} ± {ruler:g}" for ruler in measurements.RULERS for letter in "va"]
    return [
        "## Graphical differentiation and integration",
        "",
        "Errors in millimetres of the diagrams by the number of positions of a cycle: v and "
        "a by chords, s integrated from exact velocities by middle ordinates; they fall as "
        "1/n². Then the effect on v and a of reading s with a ruler of the given step, mm.",
        "",
        *table(("problem", "positions", *head), rows),
        "",
        *said,
        "",
        *table(("cycle", "problem", "positions", "time", "for a position"), cost),
    ]


def machine_section(problems: Sequence[Problem]) -> Table:
    """Return the section on flywheels; empty if no problem has ``[machine]``."""
    rows, cost = [], []
    for problem in problems:
        if problem.machine is None:
            continue
        wheel = Flywheel(problem)
        if wheel.exact.inertia <= 0.0:
            continue
        for one in measurements.constructed(wheel):
            count = "all" if one.count is None else str(one.count)
            rows.append((problem.name, count, *(f"{off:+.3f}" for off in one.off)))
        cost += [
            (what, problem.name, span(seconds))
            for what, seconds in measurements.flywheel_costs(problem)
        ]
    if not rows:
        return []
    head = [f"{method}, {way.value}" for way, method in measurements.METHODS]
    return [
        "## Flywheels by construction",
        "",
        "By how many percent J_f of a construction without a pencil differs from the exact one: by "
        "the number of positions, the tangents (slopes 1 ± delta, or 1) and the way of integration "
        "(middle ordinates, or trapezoids). *all*: on the whole curves, where slopes alone err.",
        "",
        *table(("problem", "positions", *head), rows),
        "",
        *table(("flywheel", "problem", "time"), cost),
    ]


SECTIONS: dict[str, Callable[[Sequence[Problem]], Table]] = {
    "speed": _speed,
    "forces": _forces,
    "drafting": lambda problems: drafting_section(compare_all(problems)),
    "cycle": _cycle,
    "machine": machine_section,
}
"""Sections of measurements of linkages by their names."""
