"""Linkages sifted many at once: assembly, margins, segments, errors (отсев многих сразу)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from enum import Enum

import numpy as np
from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.check.marks import Settings
from planmethod.check.questions import Question, Questions
from planmethod.construct.arithmetic import Float64
from planmethod.construct.drafting import PROFILES, Profile, Propagated, causes_of
from planmethod.construct.dual import as_dual
from planmethod.construct.evaluate import evaluate
from planmethod.errors import AssemblyError, PlanMethodError
from planmethod.problem.model import Problem
from planmethod.problem.selector import Selector
from planmethod.solved.many.variants import Batch, in_batches
from planmethod.solved.selectors.steps import NoValueError
from planmethod.solved.selfcheck import changed_branches, verify, warnings
from planmethod.solved.solution import Solution

MIN_MARGIN = 0.1
"""Least margin of a step: of two lines the sine of their angle, of arcs its square."""

MIN_LENGTH_MM = 5.0
"""Minimum length of a requested segment on the sheet, mm."""

MAX_RELATIVE_SIGMA = 0.1
"""Maximum relative σ of a requested answer: beyond, a ruler is not accurate enough."""

SIGMA_ALLOWANCE = 1.25
"""Factor of the σ permitted here: where first order does not hold, the true one is smaller."""

RequestedQuantity = tuple[Selector, int, str]
"""A quantity, its position, and what it is called."""


class RejectionReason(Enum):
    """Reason for rejecting a candidate (причина отказа)."""

    FAULTY = "faulty"
    COAXIAL = "coaxial"
    ASSEMBLY = "assembly"
    WARNED = "doubtful"
    MARGIN = "margin"
    SHORT = "short"
    UNSEEN = "unseen"
    ZERO = "nothing"
    CONDITION = "condition"
    HIDDEN = "hidden"
    DUPLICATE = "alike"
    SPARE = "spare"


class Rejection(Struct, frozen=True):
    """A rejected candidate: the reason, and the item at fault."""

    reason: RejectionReason
    item: str = ""


class ScreenedLinkages(Struct, frozen=True, eq=False):
    """Linkages after the sieve, by their numbers.

    Attributes
    ----------
    rejections : dict of int to Rejection
    batches : list of (Batch, list of int)
        Those that may be variants and are drawn by the same steps.
    solutions : dict of int to Solution
        Others that may be.
    """

    rejections: dict[int, Rejection] = field(default_factory=dict)
    batches: list[tuple[Batch, list[int]]] = field(default_factory=list)
    solutions: dict[int, Solution] = field(default_factory=dict)


def screen_linkages(
    problems: Sequence[Problem], requested: Sequence[RequestedQuantity], settings: Settings
) -> ScreenedLinkages:
    """Return which linkages may be variants; most are read together.

    Loads and requests of a cycle do not move a linkage: it is screened without them.

    Parameters
    ----------
    requested : sequence of (Selector, int, str)
        Requested quantities that move.
    """
    profile, found = PROFILES[settings.profile], ScreenedLinkages()
    bare = [_without_loads(problem) for problem in problems]
    loaded: list[int] = []
    seen: set[int] = set()
    for batch, members in in_batches(bare, profile):
        refused = _find_rejections(batch, requested)
        found.rejections.update((members[number], why) for number, why in refused.items())
        kept = [number for number in range(len(members)) if number not in refused]
        whole = [number for number in kept if problems[members[number]] is bare[members[number]]]
        if whole:
            found.batches.append((batch.some(whole), [members[number] for number in whole]))
        loaded += [members[number] for number in kept if number not in whole]
        seen.update(members)
    for batch, members in in_batches([problems[k] for k in loaded], profile):
        found.batches.append((batch, [loaded[number] for number in members]))
    batched = {k for _, members in found.batches for k in members}
    for k in loaded:
        if k not in batched:
            found.solutions[k] = Solution(problems[k], profile=profile)
    for k in range(len(problems)):
        if k not in seen:
            one = _screen_one(problems[k], bare[k], profile)
            if isinstance(one, Rejection):
                found.rejections[k] = one
            else:
                found.solutions[k] = one
    return found


def _without_loads(problem: Problem) -> Problem:
    more = dict.fromkeys(("dynamics", "cycle", "machine", "balancing", "project"))
    return replace(problem, **more) if any(getattr(problem, key) for key in more) else problem


def _with_loads(problem: Problem, unloaded: Solution) -> Solution:
    return unloaded if problem is unloaded.problem else Solution(problem, profile=unloaded.profile)


def _screen_one(problem: Problem, unloaded: Problem, profile: Profile) -> Solution | Rejection:
    try:
        solution = Solution(unloaded, profile=profile)
        verify(solution)
        if warnings(solution) or changed_branches(solution):
            return Rejection(RejectionReason.WARNED)
        if not float(np.min(solution.margin)) >= MIN_MARGIN:
            return Rejection(RejectionReason.MARGIN)
        return _with_loads(problem, solution)
    except AssemblyError:
        return Rejection(RejectionReason.ASSEMBLY)
    except PlanMethodError:
        return Rejection(RejectionReason.FAULTY)


def _find_rejections(batch: Batch, requested: Sequence[RequestedQuantity]) -> dict[int, Rejection]:
    """Return the variants of a batch that a joint check rejects, by their numbers."""
    margins = [float(np.min(batch.margin[rows])) for rows in batch.rows]
    found = {
        k: Rejection(RejectionReason.MARGIN)
        for k, least in enumerate(margins)
        if not least >= MIN_MARGIN
    }
    starts = np.array([rows.start for rows in batch.rows])
    seen = list(_find_failing_rows(batch, requested))
    for why in (RejectionReason.SHORT, RejectionReason.UNSEEN):
        for cause, position, name, bad in seen:
            for k in np.flatnonzero(bad[starts + position]) if cause is why else ():
                found.setdefault(int(k), Rejection(why, name))
    return found


def _find_failing_rows(
    batch: Batch, requested: Sequence[RequestedQuantity]
) -> Iterator[tuple[RejectionReason, int, str, np.ndarray[tuple[int, ...], np.dtype[np.bool_]]]]:
    """Yield in which rows a quantity is too short, or errs too much to be read: to first order."""
    questions = Questions(batch)
    asked: list[tuple[Question, int, str]] = []
    for selector, position, name in requested:
        try:
            asked.append((questions.question(selector), position, name))
        except NoValueError:
            continue  # of forces
    draft, known = questions.selecting.draft, batch.construction.draft
    if set(draft.numbers) != set(known.numbers):
        return  # numbers of one variant
    program = questions.selecting.b.program()
    program = program.needed_for({name for question, *_ in asked for name in question.needs})
    data = batch.data(batch.per_mm)
    free = frozenset(str(plan.pole) for plan in batch.construction.plans)
    causes = causes_of(program, lambda: data, free)
    exact = evaluate(program, data, Float64())
    drawn = evaluate(program, data, Propagated(batch.profile, free, causes))
    for question, position, name in asked:
        if question.length is not None:
            mm = np.broadcast_to(np.abs(exact.value[question.length]), batch.positions.shape)
            yield RejectionReason.SHORT, position, name, mm < MIN_LENGTH_MM
        if question.name is not None:
            value = as_dual(drawn.value[question.name])
            slope = 0.0 if value.slope is None else np.sqrt((value.slope**2).sum(axis=0))
            bad = slope > SIGMA_ALLOWANCE * MAX_RELATIVE_SIGMA * np.abs(exact.value[question.name])
            yield (
                RejectionReason.UNSEEN,
                position,
                name,
                np.broadcast_to(bad, batch.positions.shape),
            )
