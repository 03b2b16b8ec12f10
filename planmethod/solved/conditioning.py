"""Accuracy of a solution's results: their conditioning, position by position.

The reach of a result y that depends on data d is abs(y) + sum of abs(dy/dd * d). The unit roundoff
u times the reach is the effect of one rounding of every datum and of the result, whatever the
formula. Divided by abs(y) the reach is the condition number. Dual numbers give it in float64
(`planmethod.construct.condition`); the high-precision check measures it by moving each datum.

A user is warned of, or refused, what ``MULTIPLE * u * reach`` says of the worst result, relative to
the largest value of its kind. A result that exceeds that multiple comes from a poor formula. The
angle at which lines or arcs meet does not suffice as a measure: a slotted link whose pin passes
near its pivot loses digits by a difference of nearly equal places.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
import numpy.typing as npt

from planmethod.construct.arithmetic import Number
from planmethod.construct.condition import UNIT_ROUNDOFF, reach
from planmethod.construct.program import Program
from planmethod.construct.steps import Join, Name
from planmethod.plans.build import ZERO, Quantity
from planmethod.plans.model import DimensionKind
from planmethod.problem.quantities import QuantityKind
from planmethod.solved.quantities import natural_size, quantities_of
from planmethod.solved.reading import Reals, driven
from planmethod.solved.solution import FEW_ROWS, UNIT_SCALES, Solution

MULTIPLE = 16
"""Forward error of a result in units of u times its reach that is allowed for."""

WARN_RELATIVE_ERROR = 1e-6
"""Bound of the relative error of the results from which a warning is given."""

SPOILT = 1e-2
"""Bound of the relative error from which a position is refused."""

SCALES = frozenset(UNIT_SCALES)
"""Data that carry no rounding."""

SAFE = 2e-3
"""Margin, and relative difference of terms, above which a position needs no closer check."""

CLEARED = MULTIPLE * UNIT_ROUNDOFF / SAFE**3
"""Bound if no closer check is needed."""

BLOCK = 256
"""Number of positions checked in one go."""

PLACING = (DimensionKind.LENGTH, DimensionKind.ALONG, DimensionKind.ACROSS)
"""Kinds of dimensions that determine the size of a mechanism."""

BOUNDED_KINDS = (
    QuantityKind.PLACE,
    QuantityKind.VELOCITY,
    QuantityKind.OMEGA,
    QuantityKind.ACCELERATION,
    QuantityKind.EPSILON,
)


def error_bound(solution: Solution) -> Reals:
    """Return a bound of the relative error of the worst results, ndarray of shape (n,).

    It is ``16 u`` times the reach of a result (see `planmethod.construct.condition`) over the
    largest value of its kind in the position. Positions far from any cancellation are not
    computed: their bound is given as ``16 u / SAFE**3``, which none of them reaches.
    """
    return solution.compute_once(_bound)


def _bound(solution: Solution) -> Reals:
    solution.si  # noqa: B018 - what does not exist is reported first
    bound = np.full(solution.positions.shape, CLEARED)
    results = [r for r in quantities_of(solution.construction).all if r.name != ZERO]
    for chosen in blocks(_suspects(solution)):
        bound[chosen] = MULTIPLE * UNIT_ROUNDOFF * _relative_reach(solution, results, chosen)
    return bound


def blocks(suspects: npt.NDArray[np.intp]) -> Iterator[npt.NDArray[np.intp]]:
    """Yield positions in blocks that are checked in one go."""
    for start in range(0, len(suspects), BLOCK):
        yield suspects[start : start + BLOCK]


def _suspects(solution: Solution) -> npt.NDArray[np.intp]:
    """Return the positions that a quick check does not clear."""
    if solution.max_positions <= FEW_ROWS:
        return np.arange(len(solution.positions))
    program = solution.construction.program
    least = np.minimum(solution.margin, min_gap(solution, program, solution.si.value))
    return np.flatnonzero(~(least > SAFE))


def min_gap(solution: Solution, program: Program, value: Mapping[Name, Number]) -> Reals:
    """Return each position's shortest line, relative to the size of the subtracted coordinates."""
    ends, least = extent(solution) or 1.0, np.full(solution.positions.shape, np.inf)
    for step in program.steps:
        if isinstance(step, Join):
            least = np.minimum(least, np.abs(value[step.head] - value[step.tail]) / ends)
    return least


def extent(solution: Solution) -> float:
    """Return the size of subtracted coordinates: the longest given length or distance."""
    draft = solution.construction.draft
    lengths = [
        abs(draft.numbers[name])
        for name, dimension in draft.dimensions.items()
        if dimension.kind in PLACING and name in draft.numbers
    ]
    lengths += [abs(place) for place in draft.places.values()]
    if not solution.problem.drive.is_crank:
        places, _, _ = driven(solution.problem.drive, solution.positions)
        lengths.append(float(np.max(np.abs(places))))
    return max(lengths)


def _relative_reach(
    solution: Solution, results: Sequence[Quantity], chosen: npt.NDArray[np.intp]
) -> Reals:
    exact = SCALES | solution.construction.draft.branches.keys()
    found = reach(solution.construction.program, solution.data(chosen=chosen), exact)
    worst = np.ones(len(chosen))
    largest = dict.fromkeys(BOUNDED_KINDS, np.zeros(len(chosen)))
    for kind in BOUNDED_KINDS:
        names = [r.name for r in results if r.kind is kind]
        for name in names:
            whole = np.broadcast_to(np.abs(solution.si.value[name]), solution.positions.shape)
            largest[kind] = np.maximum(largest[kind], whole[chosen])
        size = natural_size(kind, largest)
        spans = np.array([np.broadcast_to(found[name], size.shape) for name in names])
        some = size > 0
        if names and some.any():
            spans = np.where(np.isnan(spans), np.inf, spans)
            worst[some] = np.fmax(worst[some], spans.max(axis=0)[some] / size[some])
    return worst
