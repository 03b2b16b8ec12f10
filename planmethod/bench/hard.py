"""Hard cases of the plan method: at and near what is impossible, and at extreme data.

Every row is solved in float64 and judged by the referee (`planmethod.bench.accuracy`), and asked
of the package as a user asks it. A row may be good, warned of, or refused with a reason; a number
that is wrong and not warned of is a fault, wherever it comes from.

``python -m planmethod.bench.hard`` prints the tables.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from itertools import groupby

import numpy as np

from planmethod.bench import hard_problems as texts
from planmethod.bench.accuracy import Examined, Verdict, examine
from planmethod.construct.condition import UNIT_ROUNDOFF
from planmethod.construct.referee import DIGITS
from planmethod.errors import PlanMethodError
from planmethod.plans.results import ResultKind, results_of
from planmethod.plans.selfcheck import SelfCheckError, verify, warnings
from planmethod.plans.solution import Solution
from planmethod.problem import loads
from planmethod.problem.model import Problem

WRONG = 1e-6
"""Relative error above which a result that nobody warned of is a wrong one."""

CROWD = 65
"""Positions asked at once where many are meant: more than are all looked at closely."""


@dataclass(frozen=True, slots=True)
class HardInput:
    """One row to be examined.

    Attributes
    ----------
    label : str
        What is varied.
    text : str
        The problem.
    positions : tuple of float
        Positions of its driver; none for those of the file.
    like : str
        Text of a similar mechanism of ordinary size. Its links must turn alike: so errors are
        found that the referee cannot see, because it reads the same program.
    many : bool
        Ask each position as one of many.
    """

    label: str
    text: str
    positions: tuple[float, ...] = ()
    like: str = ""
    many: bool = False


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
        What the labels of the rows say, with its unit; empty where they say it themselves.
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
        Least margin of all steps; NaN where there was nothing to judge.
    kappa : float
        Largest reach of a result over the natural size of its kind in the position (see `sizes`),
        at least 1; NaN where there was nothing to judge.
    multiple : float
        Largest error of a result in units of u times its own reach.
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
    told: str = ""
    warned: float = 0.0
    margin: float = math.nan
    kappa: float = math.nan
    multiple: float = 0.0
    multiple_of: str = ""
    error: float = 0.0
    error_of: str = ""
    agreed: bool = True

    @property
    def silently_wrong(self) -> bool:
        """Tell whether a result is wrong or cannot exist, and nothing is said.

        It cannot exist where the referee finds none, or where a margin is negative.
        """
        sound = self.error <= WRONG and self.agreed and not self.margin < 0
        return self.outcome is Outcome.GOOD and not sound

    @property
    def underrated(self) -> bool:
        """Tell whether the user is warned of less than the error."""
        return self.outcome is Outcome.WARNED and not self.error <= self.warned

    @property
    def share(self) -> float:
        """Relative error in units of u times kappa: what `doubt` allows 16 of."""
        return 0.0 if self.error == 0 else self.error / (UNIT_ROUNDOFF * self.kappa)


def run(case: HardCase, *, digits: int = DIGITS) -> list[HardRow]:
    """Examine every row of a case."""
    return [_examine_row(case.name, row, digits) for row in case.rows]


def _examine_row(case: str, row: HardInput, digits: int) -> HardRow:
    blank = HardRow(case, row.label, Outcome.REFUSED, warned=math.inf)
    try:
        problem = loads(row.text, name=case)
        positions = row.positions or problem.drive.positions
        kinds = _kinds(problem)
        # Whether numpy grumbles about what does not exist is another test's matter.
        with np.errstate(all="ignore"):
            judged = _judge_positions(blank, row, problem, positions, kinds, digits)
    except PlanMethodError as error:
        return replace(blank, told=_say(error))
    return max(judged, key=lambda found: (list(Outcome).index(found.outcome), found.multiple))


def _kinds(problem: Problem) -> dict[str, ResultKind]:
    return {result.label: result.kind for result in results_of(Solution(problem).construction).all}


def _judge_positions(
    blank: HardRow,
    row: HardInput,
    problem: Problem,
    positions: Sequence[float],
    kinds: dict[str, ResultKind],
    digits: int,
) -> list[HardRow]:
    asked = [_ask(blank, problem, position, many=row.many) for position in positions]
    try:
        examined = examine(problem, positions, digits=digits)
    except ZeroDivisionError:
        # The referee cannot tell the direction of a line through two points at one place.
        return asked
    judged = [_add(one, found, kinds) for one, found in zip(asked, examined, strict=True)]
    if row.like:
        like = loads(row.like, name=problem.name)
        judged = [
            _compare(one, problem, like, at) for one, at in zip(judged, positions, strict=True)
        ]
    return judged


def _say(error: PlanMethodError) -> str:
    return " ".join(str(error).split())


def _ask(blank: HardRow, problem: Problem, position: float, *, many: bool) -> HardRow:
    """Ask a position as the commands do, and return a row of what the user is told."""
    try:
        solution = Solution(problem, positions=[position] * (CROWD if many else 1))
        verify(solution)
        said = warnings(solution)
    except SelfCheckError as error:
        return replace(blank, outcome=Outcome.BROKEN, told=_say(error))
    except PlanMethodError as error:
        return replace(blank, told=_say(error))
    if said:
        return replace(blank, outcome=Outcome.WARNED, told=" ".join(said))
    return replace(blank, outcome=Outcome.GOOD, warned=0.0)


def _add(row: HardRow, found: Examined, kinds: dict[str, ResultKind]) -> HardRow:
    """Return a row with what the referee found."""
    size = sizes(found.verdicts, kinds)
    kappa, error, error_of = 1.0, 0.0, ""
    for verdict in found.verdicts:
        natural = size[kinds[verdict.label]]
        if natural > 0:
            kappa = max(kappa, verdict.reach / natural)
            share = verdict.error / natural
        else:
            share = math.inf if verdict.error else 0.0
        if share > error:
            error, error_of = share, verdict.label
    worst = found.worst
    return replace(
        row,
        warned=found.warned if row.outcome is Outcome.WARNED else row.warned,
        margin=found.margin,
        kappa=kappa,
        multiple=worst.multiple if worst else 0.0,
        multiple_of=worst.label if worst else "",
        error=error,
        error_of=error_of,
        agreed=found.agreed,
    )


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


def _compare(row: HardRow, problem: Problem, like: Problem, position: float) -> HardRow:
    """Return a row with the largest difference of how the links turn from a like mechanism's."""
    try:
        one, two = (Solution(each, positions=[position]).links for each in (problem, like))
    except PlanMethodError:
        return row
    fastest = max(abs(float(motion.omega[0])) for motion in two.values()) or 1.0
    for link in one:
        apart = math.radians(float(one[link].phi_deg[0] - two[link].phi_deg[0]))
        leaning = abs(2 * math.sin(apart / 2))
        slower = abs(float(one[link].omega[0] - two[link].omega[0])) / fastest
        for error, label in ((leaning, f"phi_{link}"), (slower, f"omega_{link}")):
            if error > row.error:
                row = replace(row, error=error, error_of=label)
    return row


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
    "broken",
    "worst multiple of κ·u",
    "of the largest κ",
    "silently wrong",
)
TOLD = 70
"""Characters of a message that a table shows."""


def table(*results: Sequence[HardRow], folded: bool = True) -> str:
    """Return a table in Markdown: a line for each row, or for neighbours that ended alike.

    Parameters
    ----------
    *results : sequences of HardRow
        What `run` returned for some cases.
    folded : bool
        Show neighbouring rows of one case that ended alike as one line with the worst of each.
    """
    lines = [_line(HEAD), _line(["---"] * len(HEAD))]
    for rows in results:
        for _, group in groupby(rows, key=_end if folded else id):
            lines.append(_line(_fold(list(group))))
    return "\n".join(lines) + "\n"


def _end(row: HardRow) -> tuple[Outcome, bool, str]:
    """Return what rows of one line have in common: refusals by their nature."""
    if row.outcome is not Outcome.REFUSED:
        return row.outcome, row.silently_wrong, ""
    nature = "dead position"
    if nature not in row.told:
        nature = " ".join(row.told.split(": ", 1)[-1].split()[:2])
    return row.outcome, False, nature


def _fold(rows: list[HardRow]) -> list[str]:
    first, last = rows[0], rows[-1]
    worst = max(rows, key=lambda row: row.multiple)
    wrong = max(rows, key=lambda row: row.error)
    margins = [row.margin for row in rows if not math.isnan(row.margin)]
    kappas = [row.kappa for row in rows if not math.isnan(row.kappa)]
    return [
        first.case,
        first.label if len(rows) == 1 else f"{first.label} … {last.label}",
        first.outcome.value if not first.silently_wrong else "silently wrong",
        f"{min(margins):.1e}" if margins else "",
        f"{max(kappas):.1e}" if kappas else "",
        f"{worst.multiple:.2g} ({worst.multiple_of})" if worst.multiple else "0",
        f"{wrong.error:.1e} ({wrong.error_of})" if wrong.error else "0",
        _shorten(last),
    ]


def _shorten(row: HardRow) -> str:
    """Return the beginning of what the user is told, without the name of the case."""
    said = row.told.split("in the problem file ")[-1].removeprefix(f"{row.case}: ")
    return said if len(said) <= TOLD else said[: TOLD - 1].rstrip() + "…"


def summarise(*results: Sequence[HardRow]) -> str:
    """Return a table in Markdown with a line for each case.

    The multiples are the worst of the rows that were not refused: in units of u times the reach
    of the result itself, and times the largest κ of the row.
    """
    titles = {case.name: case.title for case in HARD}
    lines = [_line(SUMMARY), _line(["---", "---", *["---:"] * (len(SUMMARY) - 2)])]
    for rows in results:
        name = rows[0].case
        solved = [row for row in rows if row.outcome is not Outcome.REFUSED]
        worst = max(solved, key=lambda row: row.multiple, default=None)
        cells = [name, titles.get(name, ""), str(len(rows))]
        cells += [str(sum(row.outcome is outcome for row in rows)) for outcome in Outcome]
        cells.append(f"{worst.multiple:.2g} ({worst.multiple_of})" if worst else "")
        cells.append(f"{max(row.share for row in solved):.2g}" if solved else "")
        cells.append(str(sum(row.silently_wrong for row in rows)))
        lines.append(_line(cells))
    return "\n".join(lines) + "\n"


def _line(cells: Iterable[str]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


# The cases -----------------------------------------------------------------------------------

NEARER = tuple(10.0**-k for k in range(1, 13))
GAPS = (*NEARER, 1e-13, 1e-14, 1e-15)
BEYOND = (-1e-15, -1e-13, -1e-11, -1e-6, -1e-1)
TURNED = 37.0
ROUND = (20.0, 100.0, 250.0)
FOUR_BAR = (0.125, 0.5, 0.375, 0.5)  # crank, rod, arm, frame

Make = Callable[[str, str, float], HardCase]


def _both_ways(make: Make, name: str, title: str) -> tuple[HardCase, HardCase]:
    """Return a case along the axes and the same turned."""
    turned = f"{title}, turned by 37 degrees"
    return make(name, title, 0.0), make(f"{name}-turned", turned, TURNED)


def _label(value: float) -> str:
    return f"{value:.0e}" if value else "exactly"


def _vary(text: Callable[[float], str], values: Iterable[float]) -> tuple[HardInput, ...]:
    return tuple(HardInput(_label(value), text(value)) for value in values)


def _approach(text: str, at: Callable[[float], float], alone: str = "") -> tuple[HardInput, ...]:
    """Return rows that come nearer to a position and reach it; ``alone``: asked in the file."""
    rows = [HardInput(_label(d), text, (at(d),)) for d in (*NEARER, 0.0)]
    if alone:
        rows.append(HardInput("exactly, alone in the file", alone))
    return tuple(rows)


def _slider_crank_by_crank(name: str, title: str, turn: float) -> HardCase:
    text = texts.slider_crank(turn=turn)
    rows = (
        *_approach(text, lambda d: turn + 180.0 + math.degrees(d)),
        HardInput("outer, 1e-8", text, (turn + math.degrees(1e-8),)),
        HardInput("outer, exactly", text, (turn,)),
    )
    return HardCase(name, title, "rad from the dead position", rows)


def _slider_crank_by_slider(name: str, title: str, turn: float) -> HardCase:
    text = texts.driven_by_slider(turn=turn)
    alone = texts.driven_by_slider(turn=turn, s=0.5)
    rows = (
        *_approach(text, lambda d: 0.5 - texts.depart(0.125, 0.375, d), alone),
        HardInput("inner, 1.5e-6 m", text, (0.25 + 1.5e-6,)),
        HardInput("inner, exactly", text, (0.25,)),
        HardInput("beyond, 1e-9 m", text, (0.5 + 1e-9,)),
    )
    return HardCase(name, title, "rad of the crank from the dead position", rows)


def _slider_from_dead(name: str, title: str, turn: float) -> HardCase:
    text = texts.driven_by_slider(turn=turn, start=0.5, s=-0.0625)
    rows = _approach(text, lambda d: -texts.depart(0.125, 0.375, d))
    return HardCase(name, title, "rad of the crank from the dead position", rows)


def _rocker_by_crank(name: str, title: str, turn: float) -> HardCase:
    text = texts.rocker(turn=turn)
    dead, other = texts.stretched(*FOUR_BAR), texts.folded(*FOUR_BAR)
    rows = (
        *_approach(text, lambda d: turn + dead + math.degrees(d)),
        HardInput("folded, 1e-8", text, (turn + other + math.degrees(1e-8),)),
        HardInput("folded, exactly", text, (turn + other,)),
    )
    return HardCase(name, title, "rad from the dead position", rows)


def _rocker_by_rocker(name: str, title: str, turn: float) -> HardCase:
    text = texts.rocker(turn=turn, phi=110.0, by_rocker=True)
    alone = texts.rocker(turn=turn, phi=90.0, by_rocker=True)
    rows = (
        *_approach(text, lambda d: turn + 90.0 + math.degrees(d), alone),
        HardInput("beyond, 1e-12", text, (turn + 90.0 - math.degrees(1e-12),)),
        HardInput("beyond, 1e-3", text, (turn + 90.0 - math.degrees(1e-3),)),
    )
    return HardCase(name, title, "rad from the dead position", rows)


def _change_point(rod: float, arm: float, frame: float) -> Make:
    def make(name: str, title: str, turn: float) -> HardCase:
        text, alone = (
            texts.rocker(turn=turn, phi=phi, rod=rod, arm=arm, frame=frame) for phi in (50.0, 0.0)
        )
        rows = _approach(text, lambda d: turn + math.degrees(d), alone)
        return HardCase(name, title, "rad from the change point", rows)

    return make


def _isosceles(name: str, title: str, turn: float) -> HardCase:
    text = texts.slider_crank(turn=turn, crank=0.25, rod=0.25)
    rows = _approach(text, lambda d: turn + 90.0 - math.degrees(d))
    return HardCase(name, title, "rad from the change point", rows)


def _touching(text: Callable[[float, float], str]) -> Make:
    """Return a maker of cases whose ``text(gap, turn)`` closes with a gap, and not beyond it."""

    def make(name: str, title: str, turn: float) -> HardCase:
        rows = _vary(lambda gap: text(gap, turn), (*GAPS, 0.0, *BEYOND))
        return HardCase(name, title, "gap, as a share", rows)

    return make


def _slotted(share: float) -> Make:
    """Return a maker of cases with the slot line offset by a share of the pin's distance."""

    def make(name: str, title: str, turn: float) -> HardCase:
        def text(d: float, size: float = 1.0) -> str:
            return texts.pin_from_pivot(distance=d, turn=turn, offset=share * d, size=size)

        rows = tuple(
            HardInput(_label(d), text(d), like=text(d, 2.0**20) if d else "")
            for d in (*NEARER, 0.0)
        )
        return HardCase(name, title, "m from the pivot", rows)

    return make


def _swinging_block() -> HardCase:
    rows = _vary(lambda d: texts.swinging_block(distance=d), (*NEARER, 0.0))
    title = "pin of a rod next to the pivot of its block"
    return HardCase("swinging-block", title, "m from the pivot", rows)


def _parallel_guides(name: str, title: str, turn: float) -> HardCase:
    rows = _approach(texts.tangent_slide(turn=turn), lambda d: turn + d)
    return HardCase(name, title, "deg between the guides", rows)


def _parallel(text: Callable[[float, float], str]) -> Make:
    def make(name: str, title: str, turn: float) -> HardCase:
        rows = _vary(lambda d: text(d, turn), (10.0, 1.0, *NEARER, 0.0))
        return HardCase(name, title, "deg between the rays", rows)

    return make


def _zeros() -> HardCase:
    t = texts
    rows = (
        HardInput("slider-crank, omega = 0", t.slider_crank(omega=0.0), (50.0, 180.0)),
        HardInput(
            "slider-crank, epsilon alone", t.slider_crank(omega=0.0, epsilon=7.0), (50.0, 180.0)
        ),
        HardInput("rocker, omega = 0", t.rocker(omega=0.0), (70.0, 200.0)),
        HardInput("rocker, epsilon alone", t.rocker(omega=0.0, epsilon=7.0), (70.0, 200.0)),
        HardInput("rocker, epsilon = 0", t.rocker(), (70.0, 200.0)),
        HardInput("slotted link, omega = 0", t.slotted(omega=0.0), (30.0, 200.0)),
        HardInput("slotted link, epsilon alone", t.slotted(omega=0.0, epsilon=7.0), (30.0, 200.0)),
        HardInput("slotted link, epsilon = 0", t.slotted(), (30.0, 200.0)),
        HardInput("stone at rest on the crank", t.tangent_slide(omega=0.0), (40.0, 90.0)),
        HardInput("cross slide, omega = 0", t.cross_slide(omega=0.0), (50.0, 90.0)),
        HardInput("slider v = 0, a = 0", t.driven_by_slider(v=0.0), (0.4375, 0.375)),
        HardInput("slider v = 0, a = 2", t.driven_by_slider(v=0.0, a=2.0), (0.4375, 0.375)),
        HardInput("v_B = 0 at the dead places", t.slider_crank(), (0.0, 180.0)),
        HardInput("v_B = 0, turned", t.slider_crank(turn=TURNED), (TURNED, 180.0 + TURNED)),
        HardInput("omega of the slotted link 0", t.slotted(pivot=0.25 + 0j), (60.0, 300.0)),
        HardInput("sliding of the stone 0", t.slotted(), (0.0, 180.0)),
        HardInput("omega of the rod 0", t.slider_crank(), (90.0, 270.0)),
        HardInput("slider v = 0 in the dead place", t.driven_by_slider(v=0.0), (0.5,)),
    )
    return HardCase("zeros", "zero segments, whose direction is not defined", "", rows)


def _third_point() -> HardCase:
    at = (20.0, 70.0, 200.0)

    def row(label: str, third: str) -> HardInput:
        return HardInput(label, texts.rocker(third=third), at)

    rows = [row("on the line", texts.lay_beside(0.0))]
    rows += [
        row(f"{d:.0e} m off the line", texts.lay_beside(d))
        for d in (1e-3, 1e-6, 1e-9, 1e-12, 1e-15)
    ]
    rows += [
        row(f"sides longer by {d:.0e}", texts.lay_needle(d)) for d in (1e-3, 1e-6, 2e-9, 1e-10)
    ]
    rows += [
        row("at a joint", texts.lay_beside(0.0, at=0.0)),
        row("at the other joint", texts.lay_beside(0.0, at=0.5)),
        row("1e-12 m from the other joint", texts.lay_beside(1e-12, at=0.5)),
        row("1e-12 m from a joint, along", texts.lay_beside(0.0, at=1e-12)),
        row("1e-12 m from a joint, across", texts.lay_beside(1e-12, at=0.0)),
    ]
    rows += [
        row(f"by two lengths, {d:.0e} m from a joint", texts.lay_close(d))
        for d in (1e-2, 1e-4, 1e-6, 1e-8)
    ]
    return HardCase("similar", "similarity triangles that degenerate", "", tuple(rows))


def _short_base() -> HardCase:
    """Return rods much shorter than the arm of their third point: similarity blows errors up."""

    def text(rod: float) -> str:
        return texts.rocker(
            phi=180.0, rod=rod, frame=0.25, third=texts.lay_beside(0.0625, at=0.375)
        )

    rows = _vary(text, (1e-1, 1e-3, 1e-5, 1e-7, 1e-9))
    return HardCase("short-base", "a far point by similarity to a short rod", "rod, m", rows)


def _ratios() -> HardCase:
    small, large = (1e-6, 1e-4, 1e-2), (1e2, 1e4, 1e6)
    rows = [
        HardInput(f"crank {r:.0e} of the rod", texts.slider_crank(rod=0.125 / r), ROUND)
        for r in small
    ]
    rows += [
        HardInput(f"crank {r:.0e} of the other links", texts.rocker(crank=0.5 * r), ROUND)
        for r in small
    ]
    rows += [
        HardInput(
            f"rod and frame {r:.0e} of the arm",
            texts.rocker(rod=0.375 * r, frame=0.375 * r),
            ROUND,
        )
        for r in large
    ]
    rows += [
        HardInput(
            f"rod and arm {r:.0e} of the frame", texts.rocker(rod=0.5 * r, arm=0.5 * r), ROUND
        )
        for r in large
    ]
    rows += [
        HardInput(
            f"crank {r:.0e} of the frame",
            texts.rocker(crank=0.25, rod=0.3125, arm=0.25, frame=0.25 / r),
            ROUND,
        )
        for r in large
    ]
    return HardCase("ratios", "lengths of very different size", "", tuple(rows))


def _sizes() -> HardCase:
    def text(size: float) -> str:
        return texts.rocker(crank=size, rod=4 * size, arm=3 * size, frame=4 * size)

    values = (1e-10, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e5, 1e6, 1e9)
    rows = [HardInput(_label(value), text(value), ROUND) for value in values]
    # An offset of an eighth per mille of the crank; powers of two scale the data exactly.
    for name, make in (("slider-crank", texts.slider_crank), ("slotted link", texts.slotted)):
        rows += [
            HardInput(
                f"{name} with an offset, {0.125 * size:.0e}",
                make(offset=2.0**-16, size=size),
                ROUND,
                like=make(offset=2.0**-16),
            )
            for size in (2.0**-10, 2.0**-20, 2.0**-26)
        ]
    return HardCase("sizes", "very small and very large mechanisms", "crank, m", tuple(rows))


def _far() -> HardCase:
    rows = [
        HardInput(f"{name}, {far:.0e}", make(origin=complex(far, -0.7 * far)), ROUND)
        for name, make in (("slider-crank", texts.slider_crank), ("rocker", texts.rocker))
        for far in (1.0, 1e2, 1e4, 5e5)
    ]
    rows += [
        HardInput(
            f"slider-crank of {0.125 * size:.0e} m, 5e+05",
            texts.slider_crank(size=size, origin=5e5 - 3e5j),
            ROUND,
        )
        for size in (2.0**-7, 2.0**-13)
    ]
    rows += [
        HardInput(
            f"cross slide of {0.125 * size:.0e} m, 5e+05",
            texts.cross_slide(size=size, origin=5e5 - 3e5j),
            ROUND,
        )
        for size in (2.0**-7, 2.0**-13)
    ]
    return HardCase("far", "a mechanism far from the origin", "m from the origin", tuple(rows))


def _turns() -> HardCase:
    rows = [
        HardInput(
            f"{turns:+.0e} turns",
            texts.rocker(),
            tuple(360.0 * turns + rest for rest in (0.0, 90.0, 180.0, 37.3, -101.7)),
        )
        for turns in (1.0, -1.0, 1e3, -1e3, 1e6, -1e6)
    ]
    rows.append(HardInput("+1e+06 turns, in the file", texts.rocker(phi=3.6e8)))
    return HardCase("turns", "a crank that has turned many times", "", tuple(rows))


def _quadrants() -> HardCase:
    quadrants = (0.0, 90.0, 180.0, 270.0, 360.0, -90.0, -180.0)
    mechanisms = (
        ("slider-crank", texts.slider_crank()),
        ("rocker", texts.rocker()),
        ("slotted link", texts.slotted()),
    )
    rows = []
    for name, text in mechanisms:
        rows.append(HardInput(f"{name}, exactly", text, quadrants))
        for d in (1e-10, -1e-10):
            beside = tuple(quadrant + d for quadrant in quadrants)
            rows.append(HardInput(f"{name}, {d:+.0e} deg", text, beside))
    return HardCase("quadrants", "the crank at and beside the axes", "", tuple(rows))


def _rates() -> HardCase:
    makers = (
        ("slider-crank", texts.slider_crank),
        ("rocker", texts.rocker),
        ("slotted link", texts.slotted),
    )
    rows = [
        HardInput(f"{name}, {omega:.0e}", make(omega=omega), ROUND)
        for name, make in makers
        for omega in (1e-6, 1e-3, 1.0, 1e3, 1e6)
    ]
    rows += [
        HardInput(f"rocker, 12 and epsilon {e:.0e}", texts.rocker(epsilon=e), ROUND)
        for e in (1e-6, 1e6, -1e9)
    ]
    rows.append(HardInput("rocker, 1e+10", texts.rocker(omega=1e10)))
    return HardCase("rates", "very slow and very fast drivers", "omega, 1/s", tuple(rows))


def _coincident() -> HardCase:
    at = (0.0, 20.0, 110.0)
    t = texts
    rows = (
        HardInput("two pivots", t.rocker(phi=0.0, frame=0.0, crank=0.25), at),
        HardInput("a fixed point on no link", t.add_fixed(t.rocker(), 0j), at),
        HardInput("slider on a fixed point", t.add_fixed(t.slider_crank(), 0.5 + 0j), (0.0,)),
        HardInput("crank pin on a fixed point", t.add_fixed(t.rocker(), 0.125j), (90.0,)),
        HardInput("two points of a link", t.rocker(third=t.lay_beside(0.0, at=0.0)), at),
        HardInput("a crank with both points at one place", t.crank_of_one_place()),
        HardInput("two points of a link that name a line", t.line_of_one_place()),
        HardInput("a length of 0", t.rocker(crank=0.0)),
        HardInput("slider on the crank's pivot", t.slider_crank(crank=0.25, rod=0.25), (90.0,)),
        HardInput("pin on a fixed pivot", t.slotted(pivot=0.125 + 0j), (0.0,)),
        HardInput("pin on a pivot, in the file", t.slotted(phi=0.0, pivot=0.125 + 0j)),
    )
    return HardCase("coincident", "points at one place", "", rows)


def _many() -> HardCase:
    text = texts.pivot_at_origin()
    rows = tuple(HardInput(_label(d), text, (math.degrees(d),), many=True) for d in NEARER[1::3])
    title = "pin next to its pivot in the origin, as one of many positions"
    return HardCase("many", title, "rad from the pivot", rows)


HARD: tuple[HardCase, ...] = (
    *_both_ways(
        _slider_crank_by_crank,
        "slider-crank-by-crank",
        "dead position of the slider, driven by the crank",
    ),
    *_both_ways(
        _slider_crank_by_slider,
        "slider-crank-by-slider",
        "dead position of the crank, driven by the slider",
    ),
    *_both_ways(
        _slider_from_dead,
        "slider-from-dead",
        "the same, the slider's place counted from the dead one",
    ),
    *_both_ways(
        _rocker_by_crank, "rocker-by-crank", "dead position of the rocker, driven by the crank"
    ),
    *_both_ways(
        _rocker_by_rocker, "rocker-by-rocker", "dead position of the crank, driven by the rocker"
    ),
    *_both_ways(
        _change_point(rod=0.5, arm=0.125, frame=0.5),
        "parallelogram",
        "change point of a parallelogram",
    ),
    *_both_ways(_change_point(rod=0.375, arm=0.375, frame=0.125), "kite", "change point of a kite"),
    *_both_ways(_isosceles, "isosceles", "change point of a slider-crank with rod = crank"),
    *_both_ways(
        _touching(lambda gap, turn: texts.abreast(gap=gap, turn=turn)),
        "touching-outside",
        "two arcs touch from outside",
    ),
    *_both_ways(
        _touching(lambda gap, turn: texts.abreast(gap=gap, turn=turn, inside=True)),
        "touching-inside",
        "two arcs touch from inside",
    ),
    *_both_ways(
        _touching(lambda gap, turn: texts.touching_line(gap=gap, turn=turn)),
        "touching-line",
        "an arc touches a guide",
    ),
    *_both_ways(_slotted(0.0), "slotted", "pin of a slotted link next to its pivot"),
    *_both_ways(_slotted(0.6), "slotted-offset", "the same, the slot line offset"),
    *_both_ways(
        _touching(
            lambda gap, turn: texts.pin_from_pivot(
                distance=0.0625 * (1 + gap), turn=turn, offset=0.0625
            )
        ),
        "slotted-touching",
        "pin of a slotted link as near its pivot as the offset of its slot",
    ),
    _swinging_block(),
    *_both_ways(_parallel_guides, "parallel-prp", "nearly parallel guides of a stone"),
    *_both_ways(
        _parallel(lambda d, turn: texts.leaning_guide(angle=d, turn=turn)),
        "parallel-rrp",
        "rod nearly square to its guide",
    ),
    *_both_ways(
        _parallel(lambda d, turn: texts.cross_slide(angle=d, turn=turn)),
        "parallel-rpp",
        "slot of a cross slide nearly along its guide",
    ),
    _zeros(),
    _third_point(),
    _short_base(),
    _ratios(),
    _sizes(),
    _far(),
    _turns(),
    _quadrants(),
    _rates(),
    _coincident(),
    _many(),
)
"""All hard cases."""


def main() -> None:
    """Print the tables."""
    results = [run(case) for case in HARD]
    print(table(*results))
    print(summarise(*results))


if __name__ == "__main__":
    main()
