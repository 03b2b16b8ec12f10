"""Error of the float64 results against the multiprecision check, in units of κ·u."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from msgspec import Struct

from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.dual import (
    DIGITS,
    UNIT_ROUNDOFF,
    Precise,
    as_scalar,
    measured_reach,
    reach,
)
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.steps import Name
from planmethod.errors import PlanMethodError
from planmethod.languages import translate
from planmethod.plans.build import Quantity
from planmethod.plans.forces.board import SCALE
from planmethod.plans.forces.polygons import DOWN, numbers_of
from planmethod.problem.model import Problem
from planmethod.problem.quantities import QuantityKind
from planmethod.solved.failures import failing
from planmethod.solved.quantities import (
    SCALES,
    Quantities,
    error_bound,
    natural_sizes,
    quantities_of,
)
from planmethod.solved.solution import Solution

ZERO_FRACTION = 1e-14
"""Share of the largest result of its kind below which one is zero by nature, and not measured in
units of its own reach."""

VANISHED, NOISE = 1e-25, 1e-9
"""Fractions of the largest of its kind: size below which a result is a zero, and reach below
which slopes in float64 are rounding."""


class AccuracyVerdict(Struct, frozen=True):
    """Error of one result in one position, found by the multiprecision check (приговор арбитра).

    Attributes
    ----------
    quantity : Quantity
    error : float
        |float64 - multiprecision|, SI.
    size, reach : float
        |multiprecision value| and its reach (see `planmethod.construct.dual`), SI.
    multiple : float
        Error in units of u times the reach. A result that is zero by nature has no reach: its
        error is counted in units of u times the largest result of its kind.
    kappa : float
        Condition number: reach over size, inf for a zero.
    value : complex or real number of mpmath
        The multiprecision value, to all its digits; for a direction its unit vector.
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
        """Label by which the result is requested."""
        return self.quantity.label

    @property
    def kind(self) -> QuantityKind:
        """Kind of the result."""
        return self.quantity.kind


class Refereed(Struct, frozen=True):
    """One position checked in multiprecision.

    Attributes
    ----------
    reason : str
        Reason why the position is impossible or rejected; empty if it is solved. Results of
        existing steps are checked in any case.
    warned : float
        Bound of the relative error as reported to the user:
        `planmethod.solved.conditioning.error_bound`.
    warned_forces : float or None
        The same of the forces: `planmethod.solved.forces.statics.Statics.bound`. None of a problem
        without loads.
    agreed : bool
        In multiprecision the same results exist.
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
    warned_forces: float | None = None

    @property
    def worst(self) -> AccuracyVerdict | None:
        """Verdict with the largest multiple."""
        return max(self.verdicts, key=lambda v: v.multiple, default=None)


def examine(
    problem: Problem, positions: Sequence[float], *, digits: int = DIGITS, closely: bool = True
) -> list[Refereed]:
    """Check every result of a problem in some positions.

    Parameters
    ----------
    closely : bool
        Measure the reach of every result in multiprecision, and report the user's warnings; else
        take the reach to first order in float64, which costs a tenth, and omit the warnings.
    """
    solution = Solution(problem, positions=positions)
    results, data = _with_data(solution)
    program = results.program.needed_for([result.name for result in results.all])
    trace = evaluate(program, data, Float64())
    fails = failing(program, trace, len(positions))
    straight = {name for name in results.numbers if np.all(np.asarray(data[name]) == DOWN)}
    exact = SCALES | {SCALE} | straight | solution.construction.draft.branches.keys()
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
                name: (as_scalar(value), _entry(spans[name], i))
                for name, value in read.value.items()
            }
        verdicts, agreed = _evaluate_results(results.all, trace, right, i)
        reason, warned, forces = "", 0.0, None
        if closely:
            reason, warned, forces = _reported_bounds(problem, position)
        elif fails[i] >= 0:
            reason = translate("step {} is impossible", program.steps[int(fails[i])].out)
        margin = min(float(_entry(value, i)) for value in trace.margin.values())
        lost = 0 if fails[i] >= 0 else len(results.all) - len(verdicts)
        found.append(Refereed(position, margin, reason, warned, agreed, verdicts, lost, forces))
    return found


def _with_data(solution: Solution) -> tuple[Quantities, dict[str, Any]]:
    """Return the results of a solution and the data of their program; forces where they exist."""
    results = quantities_of(solution.construction)
    loaded = solution.problem.dynamics is not None
    if not loaded or not _moves(solution):
        return results, {**solution.data(), **results.numbers}
    from planmethod.solved.forces.reading import with_forces

    results = with_forces(solution, results)
    data: dict[str, Any] = {**solution.data(), **results.numbers}
    if results.changing:
        from planmethod.solved.forces.loads import changing

        loads = changing(solution)
        for name, known in results.changing:
            data.update(zip(known, numbers_of(loads[name]), strict=True))
    return results, data


def _moves(solution: Solution) -> bool:
    """Return whether the motion exists in every position."""
    try:
        solution.si  # noqa: B018
    except PlanMethodError:
        return False
    return True


def _reported_bounds(problem: Problem, position: float) -> tuple[str, float, float | None]:
    """Return why a position is impossible, or the reported bounds of its errors."""
    solution = Solution(problem, positions=[position])
    try:
        bound = float(error_bound(solution)[0])
        if problem.dynamics is None:
            return "", bound, None
        from planmethod.solved.forces.statics import statics_of

        return "", bound, float(statics_of(solution).bound[0])
    except PlanMethodError as error:
        return str(error), math.inf, None


def _entry(value: Number, i: int) -> Number:
    flat = np.ravel(value)
    return flat[i if flat.size > 1 else 0]


def _evaluate_results(
    results: Sequence[Quantity], trace: Trace, right: Mapping[Name, tuple[Number, Number]], i: int
) -> tuple[tuple[AccuracyVerdict, ...], bool]:
    """Return verdicts on the results that exist, and whether both checks agree on which exist."""
    rows: list[tuple[Quantity, Number, float, float]] = []
    agreed = True
    for result in results:
        value, span = right[result.name]
        found = complex(_entry(as_scalar(trace.value[result.name]), i))
        if cmath.isnan(found) or value != value or cmath.isnan(complex(value)):
            agreed = agreed and cmath.isnan(found) == cmath.isnan(complex(value))
            continue
        rows.append((result, value, float(abs(value - found)), float(span)))
    largest: dict[QuantityKind, float] = {}
    for result, value, _, _ in rows:
        largest[result.kind] = max(float(abs(value)), largest.get(result.kind, 0.0))
    natural = natural_sizes(largest)
    return tuple(_verdict(*row, natural[row[0].kind]) for row in rows), agreed


def _verdict(
    result: Quantity, value: Number, error: float, span: float, largest: float
) -> AccuracyVerdict:
    size = float(abs(value))
    # Zero by nature: neither it nor its slopes are anything, but for rounding of the slopes.
    nothing = span <= ZERO_FRACTION * largest or (
        size <= VANISHED * largest and span <= NOISE * largest
    )
    unit = largest if nothing else span
    multiple = 0.0 if error == 0 else error / (UNIT_ROUNDOFF * unit) if unit else math.inf
    kappa = span / size if size else math.inf
    return AccuracyVerdict(result, error, size, span, multiple, kappa, value)
