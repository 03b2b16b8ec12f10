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

MARGIN = 0.1
"""Least margin of a step: of two lines the sine of their angle, of arcs its square."""

LEAST_MM = 5.0
"""Minimum length of a requested segment on the sheet, mm."""

WORST = 0.1
"""Maximum relative σ of a requested answer: beyond, a ruler is not accurate enough."""

LOOSELY = 1.25
"""Factor of the σ permitted here: where first order does not hold, the true one is smaller."""

Asked = tuple[Selector, int, str]
"""A quantity, its position, and what it is called."""


class Refusal(Enum):
    """Reason for rejecting a candidate (причина отказа)."""

    FAULTY = "faulty"
    COAXIAL = "coaxial"
    ASSEMBLY = "assembly"
    DOUBTFUL = "doubtful"
    MARGIN = "margin"
    SHORT = "short"
    UNSEEN = "unseen"
    NOTHING = "nothing"
    CONDITION = "condition"
    HIDDEN = "hidden"
    ALIKE = "alike"
    SPARE = "spare"


class Refused(Struct, frozen=True):
    """A rejected candidate: the reason, and the item at fault."""

    why: Refusal
    what: str = ""


class Sifted(Struct, frozen=True, eq=False):
    """Linkages after the sieve, by their numbers.

    Attributes
    ----------
    refused : dict of int to Refused
    together : list of (Batch, list of int)
        Those that may be variants and are drawn by the same steps.
    alone : dict of int to Solution
        Others that may be.
    """

    refused: dict[int, Refused] = field(default_factory=dict)
    together: list[tuple[Batch, list[int]]] = field(default_factory=list)
    alone: dict[int, Solution] = field(default_factory=dict)


def sifted(problems: Sequence[Problem], wanted: Sequence[Asked], settings: Settings) -> Sifted:
    """Return which linkages may be variants; most are read together.

    Loads and requests of a cycle do not move a linkage: it is screened without them.

    Parameters
    ----------
    wanted : sequence of (Selector, int, str)
        Requested quantities that move.
    """
    profile, found = PROFILES[settings.profile], Sifted()
    bare = [_bare(problem) for problem in problems]
    loaded: list[int] = []
    seen: set[int] = set()
    for batch, members in in_batches(bare, profile):
        refused = _refused(batch, wanted)
        found.refused.update((members[number], why) for number, why in refused.items())
        kept = [number for number in range(len(members)) if number not in refused]
        whole = [number for number in kept if problems[members[number]] is bare[members[number]]]
        if whole:
            found.together.append((batch.some(whole), [members[number] for number in whole]))
        loaded += [members[number] for number in kept if number not in whole]
        seen.update(members)
    for batch, members in in_batches([problems[k] for k in loaded], profile):
        found.together.append((batch, [loaded[number] for number in members]))
    batched = {k for _, members in found.together for k in members}
    for k in loaded:
        if k not in batched:
            found.alone[k] = Solution(problems[k], profile=profile)
    for k in range(len(problems)):
        if k not in seen:
            one = _alone(problems[k], bare[k], profile)
            if isinstance(one, Refused):
                found.refused[k] = one
            else:
                found.alone[k] = one
    return found


def _bare(problem: Problem) -> Problem:
    more = dict.fromkeys(("dynamics", "cycle", "machine", "balancing", "project"))
    return replace(problem, **more) if any(getattr(problem, key) for key in more) else problem


def _whole(problem: Problem, bare: Solution) -> Solution:
    return bare if problem is bare.problem else Solution(problem, profile=bare.profile)


def _alone(problem: Problem, bare: Problem, profile: Profile) -> Solution | Refused:
    try:
        solution = Solution(bare, profile=profile)
        verify(solution)
        if warnings(solution) or changed_branches(solution):
            return Refused(Refusal.DOUBTFUL)
        if not float(np.min(solution.margin)) >= MARGIN:
            return Refused(Refusal.MARGIN)
        return _whole(problem, solution)
    except AssemblyError:
        return Refused(Refusal.ASSEMBLY)
    except PlanMethodError:
        return Refused(Refusal.FAULTY)


def _refused(batch: Batch, wanted: Sequence[Asked]) -> dict[int, Refused]:
    """Return the variants of a batch that a joint check rejects, by their numbers."""
    margins = [float(np.min(batch.margin[rows])) for rows in batch.rows]
    found = {k: Refused(Refusal.MARGIN) for k, least in enumerate(margins) if not least >= MARGIN}
    starts = np.array([rows.start for rows in batch.rows])
    seen = list(_seen(batch, wanted))
    for why in (Refusal.SHORT, Refusal.UNSEEN):
        for cause, position, name, bad in seen:
            for k in np.flatnonzero(bad[starts + position]) if cause is why else ():
                found.setdefault(int(k), Refused(why, name))
    return found


def _seen(
    batch: Batch, wanted: Sequence[Asked]
) -> Iterator[tuple[Refusal, int, str, np.ndarray[tuple[int, ...], np.dtype[np.bool_]]]]:
    """Yield in which rows a quantity is too short, or errs too much to be read: to first order."""
    questions = Questions(batch)
    asked: list[tuple[Question, int, str]] = []
    for selector, position, name in wanted:
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
            yield Refusal.SHORT, position, name, mm < LEAST_MM
        if question.name is not None:
            value = as_dual(drawn.value[question.name])
            slope = 0.0 if value.slope is None else np.sqrt((value.slope**2).sum(axis=0))
            bad = slope > LOOSELY * WORST * np.abs(exact.value[question.name])
            yield Refusal.UNSEEN, position, name, np.broadcast_to(bad, batch.positions.shape)
