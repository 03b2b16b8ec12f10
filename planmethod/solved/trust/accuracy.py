"""Error of the float64 results against the referee, in units of what the data allow (κ·u)."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence

import numpy as np
from msgspec import Struct

from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.condition import UNIT_ROUNDOFF, measured_reach, plain, reach
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.referee import DIGITS, Precise
from planmethod.construct.steps import Name
from planmethod.errors import PlanMethodError
from planmethod.languages import say
from planmethod.plans.legend import Quantity, QuantityKind
from planmethod.problem.model import Problem
from planmethod.solved.impossible import failing
from planmethod.solved.quantities import natural_size, quantities_of
from planmethod.solved.solution import Solution
from planmethod.solved.trust.conditioning import SCALES, error_bound

ZERO_SHARE = 1e-14
"""Share of the largest result of its kind below which one is zero by nature, and not measured in
units of its own reach."""

VANISHED, NOISE = 1e-25, 1e-9
"""Shares of the largest of its kind: size below which the referee sees a zero, and reach below
which slopes in float64 are rounding."""


class AccuracyVerdict(Struct, frozen=True):
    """Error of one result in one position, found by the referee (приговор арбитра).

    Attributes
    ----------
    quantity : Quantity
    error : float
        |float64 - referee|, SI.
    size, reach : float
        |referee| and its reach (see `planmethod.construct.condition`), SI.
    multiple : float
        Error in units of u times the reach. A result that is zero by nature has no reach: its
        error is counted in units of u times the largest result of its kind.
    kappa : float
        Condition number: reach over size, inf for a zero.
    value : complex or real number of mpmath
        What the referee finds, to all his digits; of a direction its unit vector.
    """

    quantity: Quantity
    error: float
    size: float
    reach: float
    multiple: float
    kappa: float
    value: Number

    @property
    def label(self) -> str:
        """How the result is asked for."""
        return self.quantity.label

    @property
    def kind(self) -> QuantityKind:
        """Kind of the result."""
        return self.quantity.kind


class Refereed(Struct, frozen=True):
    """One position before the referee.

    Attributes
    ----------
    reason : str
        Why the position is impossible or refused; empty where it is solved. Results of steps that
        do exist are judged all the same.
    warned : float
        Bound of the relative error as reported to the user:
        `planmethod.solved.trust.conditioning.doubt`.
    agreed : bool
        The referee, too, finds the same results to exist.
    unexplained : int
        Results that are NaN although no step is impossible: there must be none.
    """

    position: float
    margin: float
    reason: str
    warned: float
    agreed: bool
    verdicts: tuple[AccuracyVerdict, ...]
    unexplained: int = 0

    @property
    def worst(self) -> AccuracyVerdict | None:
        """Verdict with the largest multiple."""
        return max(self.verdicts, key=lambda v: v.multiple, default=None)


def examine(
    problem: Problem, positions: Sequence[float], *, digits: int = DIGITS, closely: bool = True
) -> list[Refereed]:
    """Judge every result of a problem in some positions.

    Parameters
    ----------
    closely : bool
        Let the referee measure the reach of every result, and tell what the user is warned of;
        else take the reach to first order in float64, which costs a tenth, and warn of nothing.
    """
    solution = Solution(problem, positions=positions)
    results = quantities_of(solution.construction)
    program = results.program.needed_for([result.name for result in results.all])
    data = {**solution.data(), **results.numbers}
    trace = evaluate(program, data, Float64())
    fails = failing(program, trace, len(positions))
    exact = SCALES | solution.construction.draft.branches.keys()
    spans = {} if closely else reach(program, data, exact)
    referee = Precise(digits)
    found = []
    for i, position in enumerate(positions):
        here = {name: _entry(value, i) for name, value in data.items()}
        if closely:
            right = measured_reach(program, here, referee, exact)
        else:
            read = evaluate(program, {n: referee.lift(v) for n, v in here.items()}, referee)
            right = {
                name: (plain(value), _entry(spans[name], i)) for name, value in read.value.items()
            }
        verdicts, agreed = _judge(results.all, trace, right, i)
        reason, warned = "", 0.0
        if closely:
            reason, warned = _told(problem, position)
        elif fails[i] >= 0:
            reason = say("step {} is impossible", program.steps[int(fails[i])].out)
        margin = min(float(_entry(value, i)) for value in trace.margin.values())
        lost = 0 if fails[i] >= 0 else len(results.all) - len(verdicts)
        found.append(Refereed(position, margin, reason, warned, agreed, verdicts, lost))
    return found


def _told(problem: Problem, position: float) -> tuple[str, float]:
    """Return why a position is impossible, or what bound of its error is reported."""
    try:
        return "", float(error_bound(Solution(problem, positions=[position]))[0])
    except PlanMethodError as error:
        return str(error), math.inf


def _entry(value: Number, i: int) -> Number:
    flat = np.ravel(value)
    return flat[i if flat.size > 1 else 0]


def _judge(
    results: Sequence[Quantity], trace: Trace, right: Mapping[Name, tuple[Number, Number]], i: int
) -> tuple[tuple[AccuracyVerdict, ...], bool]:
    """Return verdicts on the results that exist, and whether the referee finds the same to."""
    rows: list[tuple[Quantity, Number, float, float]] = []
    agreed = True
    for result in results:
        value, span = right[result.name]
        found = complex(_entry(plain(trace.value[result.name]), i))
        if cmath.isnan(found) or value != value or cmath.isnan(complex(value)):
            agreed = agreed and cmath.isnan(found) == cmath.isnan(complex(value))
            continue
        rows.append((result, value, float(abs(value - found)), float(span)))
    largest: dict[QuantityKind, float] = {}
    for result, value, _, _ in rows:
        largest[result.kind] = max(float(abs(value)), largest.get(result.kind, 0.0))
    natural = _natural(largest)
    return tuple(_verdict(*row, natural[row[0].kind]) for row in rows), agreed


def _natural(largest: Mapping[QuantityKind, float]) -> dict[QuantityKind, float]:
    """Return the largest of each kind, or what it would be if all did not move evenly.

    Where links do not turn, or turn evenly, angular velocities or accelerations are zero by
    nature: they are small against what speeds and sizes would make of them.
    """
    full = {kind: largest.get(kind, 0.0) for kind in QuantityKind}
    speed, size = full[QuantityKind.VELOCITY], full[QuantityKind.PLACE]
    full[QuantityKind.OMEGA] = max(full[QuantityKind.OMEGA], speed / size if size else 0.0)
    full[QuantityKind.SLIDING] = max(full[QuantityKind.SLIDING], speed)
    return {kind: float(natural_size(kind, full)) for kind in full}


def _verdict(
    result: Quantity, value: Number, error: float, span: float, largest: float
) -> AccuracyVerdict:
    size = float(abs(value))
    # Zero by nature: neither it nor its slopes are anything, but for rounding of the slopes.
    nothing = span <= ZERO_SHARE * largest or (
        size <= VANISHED * largest and span <= NOISE * largest
    )
    unit = largest if nothing else span
    multiple = 0.0 if error == 0 else error / (UNIT_ROUNDOFF * unit) if unit else math.inf
    kappa = span / size if size else math.inf
    return AccuracyVerdict(result, error, size, span, multiple, kappa, value)
