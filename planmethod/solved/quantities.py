"""Every quantity of a construction by its label (величины), and its transfer functions.

Their conditioning, position by position, gives how exact results are. The reach of a result y that
depends on data d is abs(y) + sum of abs(dy/dd * d). The unit roundoff u times the reach is the
effect of one rounding of every datum and of the result, whatever the formula. Divided by abs(y) the
reach is the condition number. Dual numbers give it in float64 (`planmethod.construct.dual`); the
high-precision check measures it by moving each datum.

A user is warned of, or refused, what ``MULTIPLE * u * reach`` says of the worst result, relative to
the largest value of its kind. A result that exceeds that multiple comes from a poor formula. The
angle at which lines or arcs meet does not suffice as a measure: a slotted link whose pin passes
near its pivot loses digits by a difference of nearly equal places.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.dual import UNIT_ROUNDOFF, reach
from planmethod.construct.program import Program
from planmethod.construct.steps import Join, Name, NumberName, Step
from planmethod.errors import PlanMethodError
from planmethod.languages import translate
from planmethod.plans.build import ZERO, Construction, Quantity, TransferSteps, transfer_quantities
from planmethod.plans.draft import Draft
from planmethod.plans.model import DimensionKind
from planmethod.problem.quantities import (
    TRANSFERS,
    QuantityKey,
    QuantityKind,
    QuantityNameError,
    parse_quantity,
)
from planmethod.solved.reading import Reading, Reals, driven, memoized
from planmethod.solved.solution import FEW_ROWS, UNIT_SCALES, PointMotion, Solution

BY_NAME = (QuantityKind.UNIT, QuantityKind.CORIOLIS, QuantityKind.RELATIVE, *TRANSFERS)
"""Kinds of quantities that are given only when requested by name."""

ACCELERATIONS = (QuantityKind.ACCELERATION, QuantityKind.CORIOLIS, QuantityKind.RELATIVE)
"""Kinds of accelerations, m/s²."""


class UnknownQuantityError(PlanMethodError, ValueError):
    """The problem does not have a requested quantity."""


class Quantities(Struct, frozen=True):
    """All quantities of a construction, and the program that makes them.

    Attributes
    ----------
    program : Program
        The construction's, and the own axes of links that it has no line for.
    numbers : mapping
        Known numbers of the program; for forces also the starts of their plans.
    all : tuple of Quantity
        Points in the order of the plans: place, velocity, acceleration; then links; then forces.
    draft : Draft
        Draft of the program.
    changing : tuple of (str, tuple of NumberName)
        Loads that differ from position to position, by name, and the known numbers of each.
    """

    program: Program
    numbers: Mapping[str, complex | float]
    all: tuple[Quantity, ...]
    draft: Draft
    changing: tuple[tuple[str, tuple[NumberName, ...]], ...] = ()

    def choose(self, labels: Iterable[str] | None) -> tuple[Quantity, ...]:
        """Return the results of some labels, in their order; for None all that have columns.

        ``positions``, ``velocities``, ``accelerations``, ``forces``, ``transfers`` and ``units``
        select the whole group.

        Raises
        ------
        UnknownQuantityError
        """
        if labels is None:
            return tuple(result for result in self.all if result.kind not in BY_NAME)
        chosen: dict[str, Quantity] = {}
        for label in labels:
            chosen.update((result.label, result) for result in self._named(label))
        return tuple(chosen.values())

    def find(self, label: str) -> Sequence[Quantity]:
        """Return the results of a label, of a column, or of any other spelling; none if unknown."""
        names = self.draft.problem.names_of_letters
        label = names.get(label, label)
        if label in QUANTITY_GROUPS:
            return [result for result in self.all if result.kind in QUANTITY_GROUPS[label]]
        found = [result for result in self.all if result.label == label]
        found = found or [result for result in self.all if label in result.columns]
        key = None if found else key_of(label, names)
        return [result for result in self.all if key and key.is_same(result.key)] or found

    def _named(self, label: str) -> Sequence[Quantity]:
        found = self.find(label)
        if not found:
            known = [result.label for result in self.all]
            known += [word for word in QUANTITY_GROUPS if self.find(word)]
            # For a reaction, the opposite one is meant before any other with the same spelling.
            near = [result.label for result in self.all if result.opposite == label]
            from difflib import get_close_matches

            near = near or get_close_matches(label, known, 1)
            hint = translate("; did you mean {!r}?", near[0]) if near else "."
            raise UnknownQuantityError("no result {!r}{} Known: {}.", label, hint, ", ".join(known))
        return found


def key_of(label: str, names: Mapping[str, str]) -> QuantityKey | None:
    """Return the quantity that a text names, the whole of a component; None if it names none.

    Components of transfer functions have no whole: the plans give its size alone.

    Parameters
    ----------
    names : mapping of str to str
        Of the points that have letters of the source.
    """
    try:
        key = parse_quantity(label).renamed(names)
    except QuantityNameError:
        return None
    if key.over is not None:
        return None
    return key if key.is_analogue else QuantityKey(key.kind, key.names)


def natural_size(kind: QuantityKind, largest: Mapping[QuantityKind, Any]) -> Any:
    """Return the size with which a result of a kind is compared, given the largest of each kind.

    Accelerations may all be zero while links turn: omega squared, and omega times the largest
    velocity, are what they are made of. Coriolis' and the relative one are terms of accelerations,
    and small against those. Numbers or arrays alike.
    """
    turning = largest[QuantityKind.OMEGA]
    if kind is QuantityKind.EPSILON:
        return np.maximum(largest[kind], turning**2)
    if kind in ACCELERATIONS:
        whole = np.maximum(largest[kind], largest[QuantityKind.ACCELERATION])
        return np.maximum(whole, turning * largest[QuantityKind.VELOCITY])
    return largest[kind]


def natural_sizes(largest: Mapping[QuantityKind, float]) -> dict[QuantityKind, float]:
    """Return the largest of each kind, or what it would be if all did not move evenly.

    Where links do not turn, or turn evenly, angular velocities or accelerations are zero by
    nature: they are small against what speeds and sizes would make of them.
    """
    full = {kind: largest.get(kind, 0.0) for kind in QuantityKind}
    speed, size = full[QuantityKind.VELOCITY], full[QuantityKind.PLACE]
    full[QuantityKind.OMEGA] = max(full[QuantityKind.OMEGA], speed / size if size else 0.0)
    full[QuantityKind.SLIDING] = max(full[QuantityKind.SLIDING], speed)
    return {kind: float(natural_size(kind, full)) for kind in full}


NOISE = 1e-9
"""Share of the natural size of a kind up to which a result is the rounding of a zero."""


def solution_peak(solution: Solution, kind: QuantityKind) -> float:
    """Return the natural size of a kind of the motion: its noise is beside it.

    It is that of the positions that are in proportion (`planmethod.solved.extents.Extents`): next
    to a dead one quantities may be so large that all others would be noise beside them.
    """
    return _solution_peaks(solution)[kind]


@memoized
def _solution_peaks(solution: Solution) -> dict[QuantityKind, float]:
    drawable = solution.extents.drawable if len(solution.positions) > 1 else slice(None)
    largest: dict[QuantityKind, float] = {}
    for quantity in solution.construction.legend:
        values = np.abs(solution.exact(quantity)[drawable])
        size = float(np.nanmax(values, initial=0.0))
        largest[quantity.kind] = max(size, largest.get(quantity.kind, 0.0))
    return natural_sizes(largest)


QUANTITY_GROUPS = {
    "positions": (QuantityKind.PLACE, QuantityKind.DIRECTION),
    "velocities": (QuantityKind.VELOCITY, QuantityKind.OMEGA, QuantityKind.SLIDING),
    "accelerations": (QuantityKind.ACCELERATION, QuantityKind.EPSILON),
    "forces": tuple(kind for kind in QuantityKind if kind.is_force),
    "units": (QuantityKind.UNIT,),
    "transfers": TRANSFERS,
}
"""Groups of results that can be requested at once."""


def quantities_of(construction: Construction, *, transfers: bool = False) -> Quantities:
    """Return every quantity of a construction, with transfer functions if requested."""
    draft, found = construction.draft.copy(), construction.legend
    if transfers:
        found = (*found, *transfer_quantities(construction.kinematics, draft))
    return Quantities(draft.b.program(), draft.numbers, found, draft)


class Transfers:
    """Transfer functions through segments of the plans (передаточные функции по планам).

    Their drafting errors are listed with those of the plans, by label.

    Parameters
    ----------
    solution : Solution
        With a crank that turns; others have no such plans.

    Attributes
    ----------
    quantities : tuple of Quantity
        Quantities of points and links, velocities before accelerations; those that are zero by
        nature are left out.
    program : Program
        Program of the construction with their steps.
    added : tuple of Step
        These.
    numbers : mapping of str to Number
        Data of the construction and of these steps.
    """

    def __init__(self, solution: Solution) -> None:
        self.solution, construction = solution, solution.construction
        kinematics = construction.kinematics
        self.draft, found = _planned(construction)
        self.numbers = solution.numbers_of(lambda made: _planned(made)[0].numbers)
        turning = {
            QuantityKind.RATIO: {f"u_{link}" for link in kinematics.omega},
            QuantityKind.RATIO_2: {
                f"epsilon_q_{link}" for link in (*kinematics.omega, *kinematics.epsilon)
            },
        }
        self.quantities = tuple(q for q in found if str(q.name) in turning.get(q.kind, {q.name}))
        self.program = self.draft.b.program()
        self.added: tuple[Step, ...] = self.program.steps[len(construction.program.steps) :]

    @cached_property
    def steps(self) -> TransferSteps:
        """Steps of the formulas, on a separate draft."""
        return TransferSteps(self.solution.construction.kinematics, self.draft.copy())

    @cached_property
    def si(self) -> Reading:
        """Exact reading, SI."""
        return self.solution.si.extend(self.added, self.numbers, Float64())

    @cached_property
    def paper(self) -> Reading:
        """Exact reading in millimetres of the plans."""
        return self.solution.paper.extend(self.added, self.numbers, Float64())

    @cached_property
    def ruler_reading(self) -> Reading:
        """Reading with the draughtsman's ruler."""
        return self.solution.ruler_reading.extend(
            self.added, self.numbers, self.solution.ruler_arithmetic
        )

    def exact(self, quantity: Quantity) -> Reals:
        """Return a transfer function, m and radians of a radian of the crank, shape (n,)."""
        return self.si.number(quantity.name)

    def read_off(self, quantity: Quantity) -> Reals:
        """Return a transfer function as found by hand, shape (n,)."""
        return self.ruler_reading.number(quantity.name)

    def some(self, *kinds: QuantityKind) -> list[Quantity]:
        """Return the transfer functions of some kinds."""
        return [q for q in self.quantities if q.kind in (kinds or TRANSFERS)]


def _planned(construction: Construction) -> tuple[Draft, list[Quantity]]:
    """Return a construction that continues with the steps of the transfer functions, and these."""
    draft = construction.draft.copy()
    return draft, list(transfer_quantities(construction.kinematics, draft))


def transfers_of(solution: Solution) -> Transfers | None:
    """Return the transfer functions of a solution, once; None without a crank that turns."""
    drive = solution.problem.drive
    if not drive.revolves or drive.rate == 0.0 or np.isnan(drive.rate):
        return None
    return solution.compute_once(Transfers)


@memoized
def analogues(solution: Solution) -> tuple[dict[str, PointMotion], dict[str, tuple[Reals, Reals]]]:
    """Return first and second transfer functions in the positions of a solution (аналоги).

    Returns
    -------
    points : dict
        Motions at one radian (or metre) a second: velocity dx/dφ, acceleration d²x/dφ².
    links : dict
        dφ_i/dφ and d²φ_i/dφ², ndarrays of shape (n,).
    """
    unit = solution.at_unit_rate()
    return unit.points, {name: (one.omega, one.epsilon) for name, one in unit.links.items()}


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

    It is ``16 u`` times the reach of a result (see `planmethod.construct.dual`) over the
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
