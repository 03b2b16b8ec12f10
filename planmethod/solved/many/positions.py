"""Positions by the thousand: all examined before any is reported, solved block by block."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import numpy.typing as npt
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.arithmetic import Float64
from planmethod.construct.drafting import Profile
from planmethod.construct.scale import Scale
from planmethod.errors import AssemblyError
from planmethod.languages import translate
from planmethod.plans.model import FACTS, MOTION, PlanKind
from planmethod.problem.model import Problem
from planmethod.solved.failures import (
    Cause,
    Doubt,
    Failure,
    OmittedWarnings,
    Place,
    PositionError,
    failing,
    other_failures,
    same_at,
)
from planmethod.solved.quantities import SPOILT, WARN_RELATIVE_ERROR, error_bound
from planmethod.solved.reading import Reals
from planmethod.solved.selfcheck import (
    MAX_NAMED,
    SelfCheckError,
    force_doubts,
    motion_doubts,
    verify,
)
from planmethod.solved.solution import Solution

Codes = npt.NDArray[np.int16]
Places = npt.NDArray[np.intp]

BLOCK = 2048
"""Positions that are solved in one go, with all their steps."""

SAMPLE = 1000
"""Positions that choose the scales of a large table, and that check a sweep."""

_SPOILT = np.iinfo(np.int16).max
"""Code of a position whose steps exist and whose results rounding spoils."""


_AMBIGUOUS = np.int16(_SPOILT - 1)
"""Code of a position whose places exist, but whose motion has no known side."""


class Gaps(Struct, frozen=True):
    """Positions without results, and why.

    Attributes
    ----------
    reason : ndarray of int16 of shape (n,)
        -1 where there are results, else an index of a failure.
    failures : tuple of Failure
        Failure of the first position of each kind; in the order of these positions.
    unforced : int
        Number of kinds at the end whose motion exists: only their forces do not.
    """

    reason: Codes
    failures: tuple[Failure, ...]
    unforced: int = 0

    @classmethod
    def of(cls, codes: Codes, explain: Callable[[int], Failure]) -> Gaps:
        """Return the gaps of positions with codes (-1 where there is none).

        Parameters
        ----------
        explain : callable
            Returns the failure of the position with an index; called once for each code.
        """
        bad = np.flatnonzero(codes >= 0)
        _, first, which = np.unique(codes[bad], return_index=True, return_inverse=True)
        order = np.argsort(first)
        rank = np.empty_like(order)
        rank[order] = np.arange(len(order))
        reason = np.full(codes.shape, -1, np.int16)
        reason[bad] = rank[which]
        return cls(reason, tuple(explain(int(bad[first[k]])) for k in order))

    @property
    def count(self) -> int:
        """Positions without results."""
        return int(np.count_nonzero(self.reason >= 0))

    @property
    def moving(self) -> npt.NDArray[np.bool_]:
        """Positions where the motion exists, ndarray of shape (n,)."""
        return (self.reason < 0) | (self.reason >= len(self.failures) - self.unforced)

    @property
    def of_forces(self) -> Gaps:
        """The gaps among them where the motion exists."""
        first = len(self.failures) - self.unforced
        reason = np.where(self.reason >= first, self.reason - first, -1).astype(np.int16)
        return Gaps(reason, self.failures[first:], self.unforced)

    @property
    def sentences(self) -> tuple[str, ...]:
        """Reasons, each with the number of positions that it holds for."""
        counts = np.bincount(self.reason[self.reason >= 0], minlength=len(self.failures))
        return tuple(
            f"{told}{same_at(int(count) - 1, len(self.reason))}"
            for told, count in zip(self.failures, counts, strict=True)
        )

    @property
    def kinds(self) -> tuple[str, ...]:
        """Reasons without the numbers of one position: they hold for every position of a kind."""
        return tuple(told.general for told in self.failures)

    def refusal(self) -> str:
        """Return the message of a request that is refused for its first impossible position."""
        others = int(np.count_nonzero(self.reason > 0))
        return self.sentences[0] + other_failures(others)

    def warning(self) -> str:
        """Return the sentences about a request whose impossible positions stay empty."""
        left = (
            "{0} of {1} positions {0:|is impossible and left empty|are impossible, left empty}. {2}"
        )
        return translate(left, self.count, len(self.reason), self.failures[0])

    def joined(self, at: Places, more: Gaps) -> Gaps:
        """Return these gaps and those found among the positions ``at``."""
        reason = self.reason.copy()
        inside = more.reason >= 0
        reason[at[inside]] = more.reason[inside] + len(self.failures)
        return Gaps(reason, (*self.failures, *more.failures), more.unforced)


class CheckedPositions(Struct, frozen=True):
    """Results of the check of positions.

    Attributes
    ----------
    gaps : Gaps
        Positions without results.
    warnings : tuple of Doubt or OmittedWarnings
        Warnings about the others.
    spoilt : tuple of str
        Which gap is there only because rounding spoils the worst results of the motion; at most
        one sentence.
    """

    gaps: Gaps
    warnings: tuple[Doubt | OmittedWarnings, ...]
    spoilt: tuple[str, ...]


def blocks(count: int, size: int | None = None) -> Iterator[slice]:
    """Yield consecutive slices of at most ``size`` positions, by default `BLOCK`."""
    size = size or BLOCK
    for start in range(0, count, size):
        yield slice(start, min(start + size, count))


def evenly(places: Places, maximum: int = SAMPLE) -> Places:
    """Return at most a given number of places, evenly spread, with the first and the last."""
    if len(places) <= maximum:
        return places
    return places[np.linspace(0, len(places) - 1, maximum).round().astype(np.intp)]


def examine(
    problem: Problem, positions: Reals, *, numbers: Places | None = None, forces: bool = False
) -> CheckedPositions:
    """Check every position as `verify` does and estimate its error, block by block.

    Parameters
    ----------
    positions : ndarray of shape (n,)
    numbers : ndarray of shape (n,), optional
        Numbers of the positions, from 0, where they are a part of others.
    forces : bool
        Check the force plans, too.

    Raises
    ------
    SelfCheckError
    StructureError, ProblemError, AssemblyError
        When the mechanism itself cannot be assembled.
    """
    count = len(positions)
    numbers = np.arange(count) if numbers is None else numbers
    codes, estimate = np.full(count, -1, np.int16), np.zeros(count)
    unforced, pushed = np.full(count, -1, np.int16), np.zeros(count)
    for part in blocks(count):
        left = np.arange(part.start, part.stop)
        solution = Solution(problem, positions=_listed(positions[left]))
        codes[left] = impossible_steps(solution)
        if (codes[left] >= 0).any():
            left = left[codes[left] < 0]
            solution = Solution(problem, positions=_listed(positions[left]))
        if not left.size:
            continue
        estimate[left] = error_bound(solution)
        spoilt = ~(estimate[left] <= SPOILT)
        if spoilt.any():
            codes[left[spoilt]] = _SPOILT
            left = left[~spoilt]
            if not left.size:
                continue
            solution = Solution(problem, positions=_listed(positions[left]))
        try:
            verify(solution)
        except SelfCheckError as error:
            found = error.contradiction
            number = int(numbers[left][found.place.number])
            raise SelfCheckError(found.numbered(number, count)) from error
        if forces:
            from planmethod.solved.forces.statics import statics_of

            unforced[left] = statics_of(solution).failing
            pushed[left] = statics_of(solution).bound
            unforced[left[(unforced[left] < 0) & ~(pushed[left] <= SPOILT)]] = _SPOILT

    def explain(index: int) -> Failure:
        found = failure_at(problem, float(positions[index]), forces=forces)
        return found.numbered(int(numbers[index]), count)

    estimate[codes >= 0] = 0.0
    gaps = Gaps.of(codes, explain)
    kinds = sorted(set(gaps.reason[codes == _SPOILT].tolist()))
    doubtful = [*_block_warnings(problem, positions, numbers, estimate, motion_doubts)]
    if forces:
        other = Gaps.of(unforced, explain)
        pushed[unforced >= 0] = 0.0
        doubtful += _block_warnings(problem, positions, numbers, pushed, force_doubts)
        gaps = gaps.joined(np.arange(count), replace(other, unforced=len(other.failures)))
    return CheckedPositions(gaps, tuple(doubtful), tuple(gaps.sentences[k] for k in kinds))


def _listed(positions: Reals) -> list[float]:
    listed: list[float] = positions.tolist()
    return listed


def impossible_steps(solution: Solution) -> Codes:
    """Return for each position the number of the first step that fails, or -1."""
    try:
        _ = solution.si
    except AssemblyError as error:
        if isinstance(error, PositionError) and error.failure.cause is Cause.COINCIDENT:
            return np.full(solution.positions.shape, _AMBIGUOUS)
        trace = solution.read(Float64()).trace
        program = solution.construction.program
        return failing(program, trace, len(solution.positions)).astype(np.int16)
    return np.full(solution.positions.shape, -1, np.int16)


def failure_at(problem: Problem, position: float, *, forces: bool = False) -> Failure:
    """Return the reason why one position has no results.

    Parameters
    ----------
    forces : bool
        The forces are among the results.
    """
    alone = Solution(problem, positions=[position])
    try:
        verify(alone, forces=forces)
    except PositionError as error:
        return error.failure
    # Alone it can just be assembled: arrays round otherwise than single numbers do.
    return Failure(Cause.AT_LIMIT, Place.of(problem, alone.positions, 0))


def _block_warnings(
    problem: Problem,
    positions: Reals,
    numbers: Places,
    estimate: Reals,
    find_warnings: Callable[[Solution], list[Doubt]],
) -> Iterator[Doubt | OmittedWarnings]:
    """Yield the warnings of `selfcheck.warnings` for all blocks together."""
    doubtful = np.flatnonzero(estimate > WARN_RELATIVE_ERROR)
    if not doubtful.size:
        return
    named = np.sort(doubtful[np.argsort(estimate[doubtful])[-MAX_NAMED:]])
    for doubt in find_warnings(Solution(problem, positions=_listed(positions[named]))):
        number = int(numbers[named][doubt.place.number])
        yield replace(doubt, place=doubt.place.numbered(number, len(positions)))
    if len(named) < len(doubtful):
        yield OmittedWarnings(len(doubtful) - len(named), len(positions))


def solver_in(
    problem: Problem, positions: Reals, gaps: Gaps, profile: Profile
) -> Callable[[Problem, Places], Solution]:
    """Return a function that solves a problem in some of the positions, at the scales of all.

    The scales are chosen by a thousand of the positions at most. A plan out of proportion has its
    own one there, as where all positions are solved at once.
    """
    some = evenly(np.flatnonzero(gaps.moving))
    own_scales: dict[PlanKind, Reals] = {}
    if some.size:
        whole = Solution(problem, positions=_listed(positions[some]))
        scales = whole.scales
        for kind, own in whole.own_scales.items():
            own_scales[kind] = np.full(len(positions), np.nan)
            own_scales[kind][some] = own
    else:
        scales = {kind: Scale(FACTS[kind].scale, 1.0, FACTS[kind].unit) for kind in MOTION}
    scales = scales | _force_scale(problem, positions, gaps)

    def solve_at(problem: Problem, places: Places) -> Solution:
        solution = Solution(problem, positions=_listed(positions[places]), profile=profile)
        return solution.drawn_at(scales, {kind: own[places] for kind, own in own_scales.items()})

    return solve_at


def _force_scale(problem: Problem, positions: Reals, gaps: Gaps) -> dict[PlanKind, Scale]:
    """Return the scale of forces in all positions, chosen like those of motion; or None.

    None for a problem without forces, or with a given scale of forces.
    """
    if problem.dynamics is None or problem.scales.mu_F is not None:
        return {}
    some = evenly(np.flatnonzero(gaps.reason < 0))
    if not some.size:
        facts = FACTS[PlanKind.FORCE]
        return {PlanKind.FORCE: Scale(facts.scale, 1.0, facts.unit)}
    from planmethod.solved.forces.statics import statics_of

    solution = Solution(problem, positions=_listed(positions[some]))
    return {PlanKind.FORCE: statics_of(solution).scale}
