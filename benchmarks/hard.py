"""Hard cases of the plan method: at and near impossible positions, and with extreme data.

Every row is solved in float64, checked in high precision (`planmethod.solved.accuracy`), and
requested from the package as a user would. A row may be good, have a warning, or be rejected with a
reason; a wrong number without a warning is a fault, wherever it comes from.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from enum import Enum

import numpy as np

from planmethod.construct.dual import DIGITS, UNIT_ROUNDOFF
from planmethod.errors import PlanMethodError
from planmethod.problem import loads
from planmethod.problem.model import Problem
from planmethod.problem.quantities import QuantityKind
from planmethod.solved.accuracy import AccuracyVerdict, Refereed, examine
from planmethod.solved.quantities import natural_size
from planmethod.solved.selfcheck import SelfCheckError, verify, warnings
from planmethod.solved.solution import Solution

WRONG = 1e-6
"""Relative error above which a result without a warning is a wrong one."""

CROWD = 65
"""Number of positions in a batch: too many for each to be examined closely."""


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
        Meaning of the labels of the rows, with its unit; empty if they include it.
    rows : tuple of HardInput
    """

    name: str
    title: str
    parameter: str
    rows: tuple[HardInput, ...]


class Outcome(Enum):
    """Outcome of a row, the best first."""

    GOOD = "good"  # every result defined, no warning
    WARNED = "warned"  # every result defined, with a warning on its accuracy
    REFUSED = "refused"  # no result, with a reason
    BROKEN = "broken"  # the package contradicts itself: always a fault


@dataclass(frozen=True, slots=True)
class HardRow:
    """Outcome of a row; the worst one if it has several positions.

    Attributes
    ----------
    told : str
        Warning or reason, as the user reads it; empty for a good row.
    warned : float
        Bound of the relative error reported to the user; 0 without a warning, inf without a
        result.
    margin : float
        Least margin of all steps; NaN if there was no result to evaluate.
    kappa : float
        Largest reach of a result over the natural size of its kind in the position (see `sizes`),
        at least 1; NaN if there was no result to evaluate.
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
        """Return whether a result is wrong or cannot exist, without a warning.

        It cannot exist if the high-precision check finds none, or if a margin is negative.
        """
        sound = self.error <= WRONG and self.agreed and not self.margin < 0
        return self.outcome is Outcome.GOOD and not sound

    @property
    def underrated(self) -> bool:
        """Return whether the user is warned of less than the error."""
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
        # Another test checks NumPy's warnings about results that do not exist.
        with np.errstate(all="ignore"):
            judged = _judge_positions(blank, row, problem, positions, digits)
    except PlanMethodError as error:
        return replace(blank, told=_say(error))
    return max(judged, key=lambda found: (list(Outcome).index(found.outcome), found.multiple))


def _judge_positions(
    blank: HardRow,
    row: HardInput,
    problem: Problem,
    positions: Sequence[float],
    digits: int,
) -> list[HardRow]:
    asked = [_ask(blank, problem, position, many=row.many) for position in positions]
    examined = examine(problem, positions, digits=digits)
    judged = [_add(one, found) for one, found in zip(asked, examined, strict=True)]
    if row.like:
        like = loads(row.like, name=problem.name)
        judged = [
            _compare(one, problem, like, at) for one, at in zip(judged, positions, strict=True)
        ]
    return judged


def _say(error: PlanMethodError) -> str:
    return " ".join(str(error).split())


def _ask(blank: HardRow, problem: Problem, position: float, *, many: bool) -> HardRow:
    """Solve a position as the commands do, and return a row with the warning or error shown."""
    try:
        solution = Solution(problem, positions=[position] * (CROWD if many else 1))
        verify(solution)
        said = warnings(solution)
    except SelfCheckError as error:
        return replace(blank, outcome=Outcome.BROKEN, told=_say(error))
    except PlanMethodError as error:
        return replace(blank, told=_say(error))
    if said:
        return replace(blank, outcome=Outcome.WARNED, told=" ".join(map(str, said)))
    return replace(blank, outcome=Outcome.GOOD, warned=0.0)


def _add(row: HardRow, found: Refereed) -> HardRow:
    """Return a row with the results of the high-precision check."""
    size = sizes(found.verdicts)
    kappa, error, error_of = 1.0, 0.0, ""
    for verdict in found.verdicts:
        natural = size[verdict.kind]
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


def sizes(verdicts: Iterable[AccuracyVerdict]) -> dict[QuantityKind, float]:
    """Return the size beside which a result of each kind is small in a position, by the referee.

    It is the natural size of the kind, a sliding speed being a velocity.
    """
    size = dict.fromkeys(QuantityKind, 0.0)
    for verdict in verdicts:
        size[verdict.kind] = max(size[verdict.kind], verdict.size)
    fast = max(size[QuantityKind.VELOCITY], size[QuantityKind.SLIDING])
    size[QuantityKind.VELOCITY] = size[QuantityKind.SLIDING] = fast
    return {kind: float(natural_size(kind, size)) for kind in size}


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
