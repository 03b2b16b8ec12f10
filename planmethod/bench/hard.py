"""Hard cases of the plan method: at and near what is impossible, and at extreme data.

Every row is solved in float64 and judged by the referee (`planmethod.bench.accuracy`), and asked
of the package as a user asks it. A row may be good, warned of, or refused with a reason; a number
that is wrong and not warned of is a fault, wherever it comes from.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import groupby

import numpy as np

from planmethod.bench import hard_problems as p
from planmethod.bench.accuracy import Examined, Verdict, examine
from planmethod.construct.referee import DIGITS
from planmethod.errors import PlanMethodError
from planmethod.plans.results import ResultKind, results_of
from planmethod.plans.selfcheck import SelfCheckError, verify, warnings
from planmethod.plans.solution import Solution
from planmethod.problem import loads
from planmethod.problem.model import Problem

WRONG = 1e-6
"""Relative error above which a result that nobody warned of is a wrong one."""


@dataclass(frozen=True, slots=True)
class HardInput:
    """One row to be examined: what is varied, a problem's text, and positions of its driver.

    No positions mean those of the file.
    """

    label: str
    text: str
    positions: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class HardCase:
    """One kind of difficulty (трудный случай).

    Attributes
    ----------
    name : str
        Short, with hyphens.
    title : str
        What is hard.
    parameter : str
        What the labels of the rows say, with its unit.
    rows : tuple of HardInput
    """

    name: str
    title: str
    parameter: str
    rows: tuple[HardInput, ...]


class Outcome(Enum):
    """What became of a row, the best first."""

    GOOD = "good"  # every result defined, nothing said
    WARNED = "warned"  # every result defined, the user is told how far to trust it
    REFUSED = "refused"  # no result, with a reason
    BROKEN = "broken"  # the package contradicts itself: always a fault


@dataclass(frozen=True, slots=True)
class HardRow:
    """What became of a row; of several positions the worst.

    Attributes
    ----------
    told : str
        Warning or reason, as the user reads it; empty for a good row.
    warned : float
        Bound of the relative error that the user is told; 0 where nothing is said, inf where no
        result is given.
    margin : float
        Least margin of all steps; NaN where the problem was refused before any step.
    kappa : float
        Largest reach of a result over the natural size of its kind in the position (see `sizes`).
    multiple : float
        Largest error in units of u times the reach.
    multiple_of, error_of : str
        Labels of the results that have the largest multiple and relative error.
    error : float
        Largest error of a result over the natural size of its kind.
    agreed : bool
        The referee finds the same results to exist.
    """

    case: str
    label: str
    outcome: Outcome
    told: str
    warned: float
    margin: float
    kappa: float
    multiple: float
    multiple_of: str
    error: float
    error_of: str
    agreed: bool

    @property
    def silently_wrong(self) -> bool:
        """A result is wrong, or exists for float64 alone, and nobody is told."""
        return self.outcome is Outcome.GOOD and not (self.error <= WRONG and self.agreed)


def run(case: HardCase, *, digits: int = DIGITS) -> list[HardRow]:
    """Examine every row of a case."""
    return [_examine_row(case.name, row, digits) for row in case.rows]


def _examine_row(case: str, row: HardInput, digits: int) -> HardRow:
    try:
        problem = loads(row.text, name=case)
        positions = row.positions or problem.drive.positions
        kinds = _kinds(problem)
        with np.errstate(all="ignore"):
            found = examine(problem, positions, digits=digits)
    except PlanMethodError as error:
        return _refuse(case, row.label, error)
    except ZeroDivisionError:
        found = []
    if not found:
        outcome, told = _ask(problem, positions[0])
        return HardRow(
            case, row.label, outcome, told, math.inf, math.nan, math.nan, 0.0, "", 0.0, "", True
        )
    judged = [_judge_position(case, row.label, problem, kinds, one) for one in found]
    return max(judged, key=lambda r: (list(Outcome).index(r.outcome), r.multiple))


def _kinds(problem: Problem) -> dict[str, ResultKind]:
    return {result.label: result.kind for result in results_of(Solution(problem).construction).all}


def _refuse(case: str, label: str, error: PlanMethodError) -> HardRow:
    """Return the row of a problem that was refused before any step was made."""
    nan = math.nan
    return HardRow(
        case, label, Outcome.REFUSED, _say(error), math.inf, nan, nan, 0.0, "", 0.0, "", True
    )


def _say(error: PlanMethodError) -> str:
    return " ".join(str(error).split())


def _judge_position(
    case: str, label: str, problem: Problem, kinds: dict[str, ResultKind], found: Examined
) -> HardRow:
    outcome, told = _ask(problem, found.position)
    size = sizes(found.verdicts, kinds)
    kappa, error, error_of = 1.0, 0.0, ""
    for verdict in found.verdicts:
        natural = size[kinds[verdict.label]]
        if natural > 0:
            kappa = max(kappa, verdict.reach / natural)
        share = verdict.error / natural if natural > 0 else math.inf if verdict.error else 0.0
        if not share <= error:
            error, error_of = share, verdict.label
    worst = found.worst
    return HardRow(
        case=case,
        label=label,
        outcome=outcome,
        told=told,
        warned=found.warned if outcome is not Outcome.GOOD else 0.0,
        margin=found.margin,
        kappa=kappa,
        multiple=worst.multiple if worst else 0.0,
        multiple_of=worst.label if worst else "",
        error=error,
        error_of=error_of,
        agreed=found.agreed,
    )


def _ask(problem: Problem, position: float) -> tuple[Outcome, str]:
    """Ask a position as the commands do, and return what the user is told."""
    try:
        with np.errstate(all="ignore"):
            solution = Solution(problem, positions=[position])
            verify(solution)
            said = warnings(solution)
    except SelfCheckError as error:
        return Outcome.BROKEN, _say(error)
    except PlanMethodError as error:
        return Outcome.REFUSED, _say(error)
    return (Outcome.WARNED, " ".join(said)) if said else (Outcome.GOOD, "")


def sizes(verdicts: Iterable[Verdict], kinds: dict[str, ResultKind]) -> dict[ResultKind, float]:
    """Return what a result of each kind is small against in a position, by the referee.

    It is the largest value of the kind. A sliding speed is a velocity; accelerations may all be
    zero while links turn, so that omega squared and omega times the largest velocity count too.
    """
    size = dict.fromkeys(ResultKind, 0.0)
    for verdict in verdicts:
        kind = kinds[verdict.label]
        size[kind] = max(size[kind], verdict.size)
    fast = max(size[ResultKind.VELOCITY], size[ResultKind.SLIDING])
    turning = size[ResultKind.OMEGA]
    size[ResultKind.VELOCITY] = size[ResultKind.SLIDING] = fast
    size[ResultKind.ACCELERATION] = max(size[ResultKind.ACCELERATION], turning * fast)
    size[ResultKind.EPSILON] = max(size[ResultKind.EPSILON], turning**2)
    return size


# Tables --------------------------------------------------------------------------------------

HEAD = (
    "case",
    "parameter",
    "outcome",
    "margin",
    "κ",
    "worst multiple of κ·u",
    "relative error",
    "what the user is told",
)
SUMMARY = (
    "case",
    "what is hard",
    "rows",
    "good",
    "warned",
    "refused",
    "worst multiple of κ·u",
    "silently wrong",
)
TOLD = 70
"""Characters of a message that a table shows."""


def table(*results: Sequence[HardRow], folded: bool = True) -> str:
    """Return a table in Markdown: a line for each row, or for neighbours with one outcome.

    Parameters
    ----------
    *results : sequences of HardRow
        What `run` returned for some cases.
    folded : bool
        Show neighbouring rows of one case and one outcome as one line with the worst of each.
    """
    lines = [_line(HEAD), _line(["---"] * len(HEAD))]
    for rows in results:
        for _, group in groupby(rows, key=(_sort if folded else id)):
            lines.append(_line(_fold(list(group))))
    return "\n".join(lines) + "\n"


def _sort(row: HardRow) -> tuple[str, Outcome, str]:
    # Refusals of different nature stay apart: the words before the first figure tell them.
    return row.case, row.outcome, _opening(row.told) if row.outcome is Outcome.REFUSED else ""


def _opening(told: str) -> str:
    return " ".join(told.split(": ", 1)[-1].split()[:2])


def _fold(rows: list[HardRow]) -> list[str]:
    first, last = rows[0], rows[-1]
    worst = max(rows, key=lambda r: r.multiple)
    wrong = max(rows, key=lambda r: r.error)
    margins = [r.margin for r in rows if not math.isnan(r.margin)]
    kappas = [r.kappa for r in rows if not math.isnan(r.kappa)]
    return [
        first.case,
        first.label if len(rows) == 1 else f"{first.label} … {last.label}",
        first.outcome.value,
        f"{min(margins):.1e}" if margins else "",
        f"{max(kappas):.1e}" if kappas else "",
        f"{worst.multiple:.2g} ({worst.multiple_of})" if worst.multiple else "0",
        f"{wrong.error:.1e} ({wrong.error_of})" if wrong.error else "0",
        shorten(last.told),
    ]


def shorten(told: str) -> str:
    """Return the beginning of a message, without the name of the case."""
    said = told.split(" in the problem file ")[-1]
    return said if len(said) <= TOLD else said[: TOLD - 1].rstrip() + "…"


def summary(*results: Sequence[HardRow], cases: Sequence[HardCase] = ()) -> str:
    """Return a table in Markdown with a line for each case."""
    titles = {case.name: case.title for case in cases or HARD}
    lines = [_line(SUMMARY), _line(["---", "---", *["---:"] * 6])]
    for rows in results:
        worst = max(rows, key=lambda r: r.multiple)
        count = [sum(r.outcome is outcome for r in rows) for outcome in list(Outcome)[:3]]
        name = rows[0].case
        lines.append(
            _line(
                [
                    name,
                    titles[name],
                    str(len(rows)),
                    *map(str, count),
                    f"{worst.multiple:.2g} ({worst.multiple_of} at {worst.label})",
                    str(sum(r.silently_wrong for r in rows)),
                ]
            )
        )
    return "\n".join(lines) + "\n"


def _line(cells: Iterable[str]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


# The cases -----------------------------------------------------------------------------------

NEARER = tuple(10.0**-k for k in range(1, 13))
GAPS = (*NEARER, 1e-13, 1e-14, 1e-15)
TURNED = 37.0


def _sweep(text: str, at: Callable[[float], float], *, alone: str = "") -> tuple[HardInput, ...]:
    """Return rows that come nearer to a position and reach it; alone: asked in the file itself."""
    rows = [HardInput(_label(d), text, (at(d),)) for d in NEARER]
    rows.append(HardInput("exactly", text, (at(0.0),)))
    if alone:
        rows.append(HardInput("exactly, alone in the file", alone))
    return tuple(rows)


def _label(value: float) -> str:
    return f"{value:.0e}" if value else "exactly"


def _vary(text: Callable[[float], str], values: Iterable[float]) -> tuple[HardInput, ...]:
    return tuple(HardInput(_label(value), text(value)) for value in values)


def _variants(
    make: Callable[[str, str, float], HardCase], name: str, title: str
) -> tuple[HardCase, HardCase]:
    """Return a case along the axes and the same turned."""
    return (
        make(name, title, 0.0),
        make(f"{name}-turned", f"{title}, turned by 37 degrees", TURNED),
    )


FOUR_BAR = (0.125, 0.5, 0.375, 0.5)  # crank, rod, arm, frame


def _slider_crank_by_crank(name: str, title: str, turn: float) -> HardCase:
    text = p.slider_crank(turn=turn)
    rows = [
        *_sweep(text, lambda d: turn + 180.0 + math.degrees(d)),
        HardInput("outer, 1e-8", text, (turn + math.degrees(1e-8),)),
        HardInput("outer, exactly", text, (turn,)),
    ]
    return HardCase(name, title, "rad from the dead position", tuple(rows))


def _slider_crank_by_slider(name: str, title: str, turn: float) -> HardCase:
    text = p.driven_by_slider(turn=turn)
    return HardCase(
        name,
        title,
        "rad of the crank from the dead position",
        (
            *_sweep(
                text,
                lambda d: 0.5 - p.depart(0.125, 0.375, d),
                alone=p.driven_by_slider(turn=turn, s=0.5),
            ),
            HardInput("inner, 1e-3", text, (0.25 + 1.5e-6,)),
            HardInput("inner, exactly", text, (0.25,)),
            HardInput("beyond by 1e-9 m", text, (0.5 + 1e-9,)),
        ),
    )


def _slider_from_dead(name: str, title: str, turn: float) -> HardCase:
    text = p.driven_by_slider(turn=turn, start=0.5, s=-0.0625)
    return HardCase(
        name,
        title,
        "rad of the crank from the dead position",
        _sweep(text, lambda d: -p.depart(0.125, 0.375, d)),
    )


def _rocker_by_crank(name: str, title: str, turn: float) -> HardCase:
    text = p.rocker(turn=turn)
    dead, other = p.stretched(*FOUR_BAR), p.folded(*FOUR_BAR)
    return HardCase(
        name,
        title,
        "rad from the dead position",
        (
            *_sweep(text, lambda d: turn + dead + math.degrees(d)),
            HardInput("folded, 1e-8", text, (turn + other + math.degrees(1e-8),)),
            HardInput("folded, exactly", text, (turn + other,)),
        ),
    )


def _rocker_by_rocker(name: str, title: str, turn: float) -> HardCase:
    text = p.rocker(turn=turn, phi=110.0, by_rocker=True)
    return HardCase(
        name,
        title,
        "rad from the dead position",
        (
            *_sweep(
                text,
                lambda d: turn + 90.0 + math.degrees(d),
                alone=p.rocker(turn=turn, phi=90.0, by_rocker=True),
            ),
            HardInput("beyond, 1e-12", text, (turn + 90.0 - math.degrees(1e-12),)),
            HardInput("beyond, 1e-3", text, (turn + 90.0 - math.degrees(1e-3),)),
        ),
    )


def _change_point(**lengths: float) -> Callable[[str, str, float], HardCase]:
    def make(name: str, title: str, turn: float) -> HardCase:
        text = p.rocker(turn=turn, phi=50.0, **lengths)
        alone = p.rocker(turn=turn, phi=0.0, **lengths)
        rows = _sweep(text, lambda d: turn + math.degrees(d), alone=alone)
        return HardCase(name, title, "rad from the change point", rows)

    return make


def _isosceles(name: str, title: str, turn: float) -> HardCase:
    text = p.isosceles(turn=turn)
    rows = _sweep(text, lambda d: turn + 90.0 - math.degrees(d))
    return HardCase(name, title, "rad from the change point", rows)


def _touching(*, inside: bool) -> Callable[[str, str, float], HardCase]:
    def make(name: str, title: str, turn: float) -> HardCase:
        text = lambda gap: p.abreast(gap=gap, turn=turn, inside=inside)  # noqa: E731
        return HardCase(
            name,
            title,
            "gap, as a share",
            (
                *_vary(text, GAPS),
                HardInput("exactly", text(0.0)),
                *_vary(text, (-1e-15, -1e-13, -1e-11, -1e-6, -1e-1)),
            ),
        )

    return make


def _touching_line(name: str, title: str, turn: float) -> HardCase:
    text = lambda gap: p.touching_line(gap=gap, turn=turn)  # noqa: E731
    return HardCase(
        name,
        title,
        "gap, as a share",
        (
            *_vary(text, GAPS),
            HardInput("exactly", text(0.0)),
            *_vary(text, (-1e-15, -1e-13, -1e-11, -1e-6, -1e-1)),
        ),
    )


def _slotted(share: float) -> Callable[[str, str, float], HardCase]:
    def make(name: str, title: str, turn: float) -> HardCase:
        text = lambda d: p.pin_from_pivot(distance=d, turn=turn, offset=share * d)  # noqa: E731
        return HardCase(name, title, "m from the pivot", _vary(text, (*NEARER, 0.0)))

    return make


def _slotted_touching(name: str, title: str, turn: float) -> HardCase:
    text = lambda gap: p.pin_from_pivot(  # noqa: E731
        distance=0.0625 * (1 + gap), turn=turn, offset=0.0625
    )
    return HardCase(
        name,
        title,
        "gap, as a share",
        (*_vary(text, GAPS), HardInput("exactly", text(0.0)), *_vary(text, (-1e-9, -1e-1, -1.0))),
    )


def _parallel_guides(name: str, title: str, turn: float) -> HardCase:
    text = p.tangent_slide(turn=turn)
    return HardCase(name, title, "deg between the guides", _sweep(text, lambda d: turn + d))


def _leaning_guide(name: str, title: str, turn: float) -> HardCase:
    text = lambda d: p.leaning_guide(angle=d, turn=turn)  # noqa: E731
    return HardCase(name, title, "deg between the rays", _vary(text, (10.0, 1.0, *NEARER, 0.0)))


def _narrow_slot(name: str, title: str, turn: float) -> HardCase:
    text = lambda d: p.cross_slide(angle=d, turn=turn)  # noqa: E731
    return HardCase(name, title, "deg between the slides", _vary(text, (10.0, 1.0, *NEARER, 0.0)))


def _zeros() -> HardCase:
    still: dict[str, float] = {"omega": 0.0}
    starting: dict[str, float] = {"omega": 0.0, "epsilon": 7.0}
    rows = (
        HardInput("slider-crank, omega = 0", p.slider_crank(**still), (50.0, 180.0)),
        HardInput("slider-crank, epsilon alone", p.slider_crank(**starting), (50.0, 180.0)),
        HardInput("rocker, omega = 0", p.rocker(**still), (70.0, 200.0)),
        HardInput("rocker, epsilon alone", p.rocker(**starting), (70.0, 200.0)),
        HardInput("rocker, epsilon = 0", p.rocker(), (70.0, 200.0)),
        HardInput("slotted link, omega = 0", p.slotted(**still), (30.0, 200.0)),
        HardInput("slotted link, epsilon alone", p.slotted(**starting), (30.0, 200.0)),
        HardInput("slotted link, epsilon = 0", p.slotted(), (30.0, 200.0)),
        HardInput("stone at rest on the crank", p.tangent_slide(omega=0.0), (40.0, 90.0)),
        HardInput("cross slide, omega = 0", p.cross_slide(omega=0.0), (50.0, 90.0)),
        HardInput("slider v = 0, a = 0", p.driven_by_slider(v=0.0), (0.4375, 0.375)),
        HardInput("slider v = 0, a = 2", p.driven_by_slider(v=0.0, a=2.0), (0.4375, 0.375)),
        HardInput("slider v = 0 in the dead place", p.driven_by_slider(v=0.0), (0.5,)),
        HardInput("v_B = 0 at the dead places", p.slider_crank(), (0.0, 180.0)),
        HardInput("v_B = 0, turned", p.slider_crank(turn=TURNED), (TURNED, 180.0 + TURNED)),
        HardInput("omega of the slotted link 0", p.slotted(pivot=0.25 + 0j), (60.0, 300.0)),
        HardInput("sliding of the stone 0", p.slotted(), (0.0, 180.0)),
        HardInput("omega of the rod 0", p.slider_crank(), (90.0, 270.0)),
    )
    return HardCase("zeros", "zero segments, whose direction is not defined", "", rows)


def _third_point() -> HardCase:
    at = (20.0, 70.0, 200.0)
    rows = [HardInput("on the line", p.rocker(third=p.beside(0.0)), at)]
    rows += [
        HardInput(f"{d:.0e} m off the line", p.rocker(third=p.beside(d)), at)
        for d in (1e-3, 1e-6, 1e-9, 1e-12, 1e-15)
    ]
    rows += [
        HardInput("at a joint", p.rocker(third=p.beside(0.0, at=0.0)), at),
        HardInput("1e-12 m from a joint, along", p.rocker(third=p.beside(0.0, at=1e-12)), at),
        HardInput("1e-12 m from a joint, across", p.rocker(third=p.beside(1e-12, at=0.0)), at),
        HardInput("at the other joint", p.rocker(third=p.beside(0.0, at=0.5)), at),
        HardInput("1e-12 m from the other", p.rocker(third=p.beside(1e-12, at=0.5)), at),
    ]
    rows += [
        HardInput(f"sides longer by {d:.0e}", p.rocker(third=p.needle(d)), at)
        for d in (1e-3, 1e-5, 1e-7, 1e-8, 2e-9, 1e-10)
    ]
    return HardCase("similar", "similarity triangles that degenerate", "third point", tuple(rows))


def _short_base() -> HardCase:
    """Return rods much shorter than the arm of their third point: similarity blows errors up."""

    def text(rod: float) -> str:
        return p.rocker(phi=180.0, rod=rod, frame=0.25, third=p.beside(0.0625, at=0.375))

    values = (1e-1, 1e-3, 1e-5, 1e-7, 1e-9)
    return HardCase(
        "short-base", "a far point by similarity to a short rod", "rod, m", _vary(text, values)
    )


def _ratios() -> HardCase:
    round_ = (20.0, 100.0, 250.0)
    rows = [
        HardInput(f"crank {r:.0e} of the rod", p.slider_crank(rod=0.125 / r), round_)
        for r in (1e-6, 1e-4, 1e-2)
    ]
    rows += [
        HardInput(f"crank {r:.0e} of the other links", p.rocker(crank=0.5 * r), round_)
        for r in (1e-6, 1e-4, 1e-2)
    ]
    rows += [
        HardInput(
            f"crank {r:.0e} of the frame",
            p.rocker(crank=0.25, rod=0.3125, arm=0.25, frame=0.25 / r),
            round_,
        )
        for r in (1e2, 1e4, 1e6)
    ]
    rows += [
        HardInput(
            f"rod and frame {r:.0e} of the arm",
            p.rocker(rod=0.375 * r, frame=0.375 * r),
            round_,
        )
        for r in (1e2, 1e4, 1e6)
    ]
    rows += [
        HardInput(
            f"rod and arm {r:.0e} of the frame",
            p.rocker(rod=0.5 * r, arm=0.5 * r),
            round_,
        )
        for r in (1e2, 1e4, 1e6)
    ]
    return HardCase("ratios", "lengths of very different size", "", tuple(rows))


def _scales() -> HardCase:
    def text(size: float) -> str:
        return p.rocker(crank=size, rod=4 * size, arm=3 * size, frame=4 * size)

    at = (20.0, 100.0, 250.0)
    values = (1e-10, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e5, 1e6, 1e9)
    rows = tuple(HardInput(_label(value), text(value), at) for value in values)
    return HardCase("sizes", "very small and very large mechanisms", "crank, m", rows)


def _far() -> HardCase:
    rows = [
        HardInput(
            f"{name}, {far:.0e}",
            make(origin=complex(far, -0.7 * far)),
            (20.0, 100.0, 250.0),
        )
        for name, make in (("slider-crank", p.slider_crank), ("rocker", p.rocker))
        for far in (1.0, 1e2, 1e4, 1e6)
    ]
    return HardCase("far", "a mechanism far from the origin", "m from the origin", tuple(rows))


def _turns() -> HardCase:
    rows = [
        HardInput(
            f"{turns:+.0e} turns",
            p.rocker(),
            tuple(360.0 * turns + rest for rest in (0.0, 90.0, 180.0, 37.3, -101.7)),
        )
        for turns in (1, -1, 1e3, -1e3, 1e6, -1e6)
    ]
    rows.append(HardInput("+1e+06 turns, in the file", p.rocker(phi=3.6e8)))
    return HardCase("turns", "a crank that has turned many times", "", tuple(rows))


def _quadrants() -> HardCase:
    quadrants = (0.0, 90.0, 180.0, 270.0, 360.0, -90.0, -180.0)
    rows = []
    for name, text in (
        ("slider-crank", p.slider_crank()),
        ("rocker", p.rocker()),
        ("slotted link", p.slotted()),
    ):
        rows.append(HardInput(f"{name}, quadrants", text, quadrants))
        beside = tuple(q + d for q in quadrants for d in (1e-10, -1e-10))
        rows.append(HardInput(f"{name}, 1e-10 deg beside", text, beside))
    return HardCase("quadrants", "the crank at and beside the axes", "", tuple(rows))


def _rates() -> HardCase:
    rows = []
    for omega in SPAN:
        for name, make in (
            ("slider-crank", p.slider_crank),
            ("rocker", p.rocker),
            ("slotted link", p.slotted),
        ):
            rows.append(HardInput(f"{name}, {omega:.0e}", make(omega=omega), (20.0, 100.0, 250.0)))
    rows += [
        HardInput(f"rocker, 12 with epsilon {e:.0e}", p.rocker(epsilon=e), (20.0, 100.0, 250.0))
        for e in (1e-6, 1e6, -1e9)
    ]
    rows.append(HardInput("rocker, 1e+10", p.rocker(omega=1e10)))
    return HardCase("rates", "very slow and very fast drivers", "omega, 1/s", tuple(rows))


def _coincident() -> HardCase:
    at = (0.0, 20.0, 110.0)
    twin = p.rocker(third='S = { on = "AB", at = 0.0 }')
    rows = (
        HardInput("two fixed points", p.two_pivots(), at),
        HardInput("a fixed point on no link", p.with_fixed(p.rocker(), 0j), at),
        HardInput("two points of a link", twin, at),
        HardInput("two points of a link give a line", p.line_of_one_place()),
        HardInput("a crank of two points at one place", p.crank_of_one_place()),
        HardInput("a length of 0", p.rocker(crank=0.0)),
        HardInput("pin on a fixed pivot", p.stone_on_pivot(phi=30.0), (0.0,)),
        HardInput("pin on a fixed pivot, alone in the file", p.stone_on_pivot(phi=0.0)),
        HardInput("slider on the crank's pivot", p.isosceles(), (90.0,)),
        HardInput("slider on a free fixed point", p.with_fixed(p.slider_crank(), 0.5 + 0j), (0.0,)),
        HardInput("joint on a free fixed point", p.with_fixed(p.rocker(), 0.125j), (90.0,)),
    )
    return HardCase("coincident", "points at one place", "", rows)


SPAN = tuple(10.0**k for k in range(-6, 7, 2))

HARD: tuple[HardCase, ...] = (
    *_variants(
        _slider_crank_by_crank,
        "slider-crank-by-crank",
        "dead position of the slider, driven by the crank",
    ),
    *_variants(
        _slider_crank_by_slider,
        "slider-crank-by-slider",
        "dead position of the crank, driven by the slider",
    ),
    *_variants(_slider_from_dead, "slider-from-dead", "the same, s counted from the dead place"),
    *_variants(
        _rocker_by_crank, "rocker-by-crank", "dead position of the rocker, driven by the crank"
    ),
    *_variants(
        _rocker_by_rocker, "rocker-by-rocker", "dead position of the crank, driven by the rocker"
    ),
    *_variants(
        _change_point(crank=0.125, rod=0.5, arm=0.125, frame=0.5),
        "parallelogram",
        "change point of a parallelogram",
    ),
    *_variants(
        _change_point(crank=0.125, rod=0.375, arm=0.375, frame=0.125),
        "kite",
        "change point of a kite",
    ),
    *_variants(_isosceles, "isosceles", "change point of a slider-crank with rod = crank"),
    *_variants(_touching(inside=False), "touching-outside", "two arcs touch from outside"),
    *_variants(_touching(inside=True), "touching-inside", "two arcs touch from inside"),
    *_variants(_touching_line, "touching-line", "an arc touches a guide"),
    *_variants(_slotted(0.0), "slotted", "pin of a slotted link next to its pivot"),
    *_variants(_slotted(0.6), "slotted-offset", "the same, the slot line offset"),
    *_variants(
        _slotted_touching,
        "slotted-touching",
        "pin of a slotted link as near its pivot as the offset of its slot",
    ),
    HardCase(
        "swinging-block",
        "pin of a rod next to the pivot of its block",
        "m from the pivot",
        _vary(lambda d: p.swinging_block(distance=d), (*NEARER, 0.0)),
    ),
    *_variants(_parallel_guides, "parallel-prp", "nearly parallel guides of a stone"),
    *_variants(_leaning_guide, "parallel-rrp", "rod nearly square to its guide"),
    *_variants(_narrow_slot, "parallel-rpp", "slot of a cross slide nearly along its guide"),
    _zeros(),
    _third_point(),
    _short_base(),
    _ratios(),
    _scales(),
    _far(),
    _turns(),
    _quadrants(),
    _rates(),
    _coincident(),
)
"""All hard cases."""
