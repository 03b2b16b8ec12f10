"""Evaluation of candidates: lengths, readability, distinguished mistakes; many sifted at once."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from enum import Enum
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt
from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.check.calculation import task_of_problem
from planmethod.check.key import MistakeEffect, batch_named, batch_tasks
from planmethod.check.marks import Settings
from planmethod.check.questions import Question, Questions
from planmethod.check.sheet import Sheet
from planmethod.check.task import Task, TaskItem
from planmethod.check.tolerance import Tolerance, limit_of
from planmethod.construct.arithmetic import Float64
from planmethod.construct.drafting import PROFILES, Profile, Propagated, causes_of
from planmethod.construct.dual import as_dual
from planmethod.construct.evaluate import evaluate
from planmethod.errors import AssemblyError, PlanMethodError
from planmethod.kind import ProblemKind
from planmethod.plans.model import FACTS, MOTION
from planmethod.problem.model import Convention, Problem
from planmethod.problem.quantities import QuantityKey, Sign
from planmethod.problem.records import KindProblem
from planmethod.solved.many.variants import Batch, in_batches
from planmethod.solved.quantity_steps import NoValueError
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

RequestedQuantity = tuple[QuantityKey, int, str]
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
    requested : sequence of (QuantityKey, int, str)
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
    for quantity_key, position, name in requested:
        try:
            asked.append((questions.question(quantity_key), position, name))
        except NoValueError:
            continue  # of forces
    draft, known = questions.steps.draft, batch.construction.draft
    if set(draft.numbers) != set(known.numbers):
        return  # numbers of one variant
    program = questions.steps.b.program()
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


ZERO_TOLERANCE = 1e-9

MIN_ERROR_FRACTION = 0.3
"""Answers that a mistake makes small are drawn no better than a third of the right one."""

Place = tuple[str, str]
"""Code of a mistake and its place; a condition and its wheel."""


class EvaluatedVariant(Struct, frozen=True, eq=False):
    """A candidate that may be a variant (годный вариант).

    Attributes
    ----------
    exact, allowed : mapping of str to float
        Answers and their tolerances, by id.
    signed : frozenset of str
        Answers whose sense is also requested.
    points : mapping of str to float
    distinguished : frozenset of (str, str)
        Mistakes that its answers distinguish from all others.
    possible : frozenset of (str, str)
        Mistakes that can be made.
    scales : mapping of str to float
        Scales of the plans in the convention of the file; empty for a computed task.
    """

    exact: Mapping[str, float]
    allowed: Mapping[str, float]
    signed: frozenset[str]
    points: Mapping[str, float]
    distinguished: frozenset[Place]
    possible: frozenset[Place]
    scales: Mapping[str, float]


class AnswerColumns:
    """Answers of accepted candidates as columns, to see who may have copied from whom.

    Parameters
    ----------
    main : EvaluatedVariant or None
        The file itself: its answers are in the first row.

    Attributes
    ----------
    items : tuple of str
        Ids of the answers of the first candidate, in order.
    """

    def __init__(self, main: EvaluatedVariant | None) -> None:
        self.main = main
        self.items: tuple[str, ...] = ()
        self._new: list[EvaluatedVariant] = []
        # Shape (kinds of number, items, rows): exact value, tolerance, points, whether signed.
        self._columns: npt.NDArray[np.float64] = np.zeros((4, 0, 0))
        self._differ: npt.NDArray[np.bool_] = np.zeros(0, dtype=bool)

    def add(self, one: EvaluatedVariant) -> None:
        """Add a candidate."""
        self._new.append(one)

    def _rows(self) -> npt.NDArray[np.float64]:
        if self._new:
            if not self.items:
                self.items = tuple(self._new[0].exact)
                self._columns = self._of([] if self.main is None else [self.main])
                self._differ = np.zeros(len(self.items), dtype=bool)
            own = self._of(self._new)
            self._new = []
            self._columns = np.concatenate([self._columns, own], axis=2)
            first = self._columns[0, :, 0 if self.main is None else 1][:, None]
            value = np.where(np.isnan(own[0]) & (own[2] == 0), 0.0, own[0])
            self._differ |= (np.abs(value - first) > 1e-9 * np.abs(first)).any(axis=1)
        return self._columns

    def _of(self, those: Sequence[EvaluatedVariant]) -> npt.NDArray[np.float64]:
        found = np.zeros((4, len(self.items), len(those)))
        for row, one in enumerate(those):
            for k, item in enumerate(self.items):
                found[:, k, row] = (
                    one.exact.get(item, math.nan),
                    one.allowed.get(item, 0.0),
                    one.points.get(item, 0.0),
                    item in one.signed,
                )
        return found

    @property
    def among(self) -> tuple[str, ...]:
        """Answers that are not the same in all candidates."""
        self._rows()
        return tuple(x for x, own in zip(self.items, self._differ, strict=True) if own)

    def distinct(
        self, number: int, candidates: npt.NDArray[np.intp], least: float
    ) -> npt.NDArray[np.bool_]:
        """Return which candidates lose enough with the answers of one, and it with theirs.

        Parameters
        ----------
        number : int
            Of the candidate, in the order of adding.
        candidates : ndarray of shape (n,)
            Numbers of the candidates it is compared with.
        least : float
            Share of the points of answers that are not the same in all.

        Returns
        -------
        ndarray of bool, shape (n,)
        """
        before = 0 if self.main is None else 1
        return self._distinct(number + before, candidates + before, least)

    def distinct_from_main(
        self, candidates: npt.NDArray[np.intp], least: float
    ) -> npt.NDArray[np.bool_]:
        """Return the same of candidates and the file itself."""
        if self.main is None:
            return np.ones(len(candidates), dtype=bool)
        return self._distinct(0, candidates + 1, least)

    def _distinct(
        self, row: int, candidates: npt.NDArray[np.intp], least: float
    ) -> npt.NDArray[np.bool_]:
        if not len(candidates):
            return np.zeros(0, dtype=bool)
        columns = self._rows()[:, self._differ]
        one, those = columns[:, :, [row]], columns[:, :, candidates]
        return (_lost_fraction(one, those) >= least) & (_lost_fraction(those, one) >= least)

    def min_lost_fraction(self, numbers: Sequence[int]) -> float:
        """Return the least share that one of some candidates loses with another one's answers."""
        before = 0 if self.main is None else 1
        rows = np.array(numbers, dtype=int) + before
        columns = self._rows()[:, self._differ]
        found = [
            _lost_fraction(columns[:, :, [row]], columns[:, :, rows[rows != row]]).tolist()
            for row in rows
        ]
        return min((share for own in found for share in own), default=1.0)


def _lost_fraction(
    answers: npt.NDArray[np.float64], copied: npt.NDArray[np.float64]
) -> npt.NDArray[np.float64]:
    """Return the share of the points that copied answers lose, shape (rows,).

    Both have shape (kinds of number, items, rows).
    """
    exact, allowed, points, signed = answers
    value = copied[0]
    turned = (signed > 0) & (value * exact < 0)
    off = turned | ~(np.abs(np.abs(value) - np.abs(exact)) <= allowed)
    # Added up in the order of the answers, as by hand: so a column of one gives the same.
    lost, whole = (
        np.add.accumulate(part, axis=0)[-1] if len(part) else np.zeros(1)
        for part in (np.where(off, points, 0.0), points)
    )
    return np.where(whole > 0, lost / np.where(whole > 0, whole, 1.0), 0.0)


class CandidateEvaluator:
    """Judges candidates of one file (отбор), whose answers are computed.

    Parameters
    ----------
    kind : ProblemKind
    main : KindProblem
        The file itself: what does not move there need not move in a variant, and a condition of
        teeth that fails there may fail in a variant.
    settings : Settings

    Attributes
    ----------
    main : EvaluatedVariant or None
        The file itself, however good; None where it cannot be solved.
    draws : bool
        Whether plans are drawn.
    """

    draws: ClassVar[bool] = False

    def __init__(self, kind: ProblemKind[Any], main: KindProblem, settings: Settings) -> None:
        self.kind, self.settings = kind, settings
        self.waived = frozenset(kind.failing_conditions(main))
        self.zero_answers: frozenset[str] = frozenset()
        self.main: EvaluatedVariant | None = None
        self._moving: tuple[tuple[QuantityKey, int, str], ...] = ()
        self._learn_from(main)

    def evaluate(self, problems: Sequence[Any]) -> Iterator[EvaluatedVariant | Rejection]:
        """Yield what each candidate is, in order."""
        return map(self._evaluate_alone, problems)

    def _evaluate_alone(self, problem: KindProblem) -> EvaluatedVariant | Rejection:
        try:
            failing = self.kind.failing_conditions(problem)
            first = next((one for one in failing if one not in self.waived), None)
            if first is not None:
                return Rejection(RejectionReason.CONDITION, first[0])
            return self._evaluate_task(self._task(problem))
        except PlanMethodError:
            return Rejection(RejectionReason.FAULTY)

    def _task(self, problem: KindProblem) -> Task:
        return task_of_problem(self.kind, problem, self.settings, verified=False)

    def _evaluate_task(self, task: Task, *, strictly: bool = True) -> EvaluatedVariant | Rejection:
        limits = self._limits(task, strictly=strictly)
        if isinstance(limits, Rejection):
            return limits
        named = {}
        for position in dict.fromkeys(item.position for item in task.list_items()):
            explained = task.named(task.sheet(position))
            named[position] = [(one.code, one.mistake_at, one.values) for one in explained]
        return self._accept(task, limits, named)

    def _limits(self, task: Task, *, strictly: bool = True) -> dict[str, Tolerance] | Rejection:
        """Return the tolerance of each answer, or why a candidate is rejected."""
        items = task.list_items()
        limits: dict[str, Tolerance] = {}
        sheets = {position: _sheet(task, position) for position in {one.position for one in items}}
        for item in items:
            length = sheets[item.position].length(item.question)
            short = length is not None and length < MIN_LENGTH_MM
            if strictly and short and name_of(item) not in self.zero_answers:
                return Rejection(RejectionReason.SHORT, item.name)
        for item in items:
            sheet, name = sheets[item.position], name_of(item)
            limits[name] = limit = limit_of(sheet, item.question, task.settings, item.fixed)
            if not math.isfinite(limit.exact):
                return Rejection(RejectionReason.ZERO, item.name)
            if name in self.zero_answers or not strictly:
                continue
            if abs(limit.exact) <= ZERO_TOLERANCE:
                return Rejection(RejectionReason.ZERO, item.name)
            whole = 57.3 if item.question.unit == "deg" else abs(limit.exact)
            if limit.sigma > MAX_RELATIVE_SIGMA * whole:
                return Rejection(RejectionReason.UNSEEN, item.name)
        return limits

    def _accept(
        self,
        task: Task,
        limits: Mapping[str, Tolerance],
        named: Mapping[int, Sequence[MistakeEffect]],
    ) -> EvaluatedVariant:
        """Return an accepted candidate, with the predictions of its mistakes by position."""
        items = task.list_items()
        told, made = distinct(items, limits, named)
        return EvaluatedVariant(
            {name: limit.exact for name, limit in limits.items()},
            {name: limit.tolerance() for name, limit in limits.items()},
            frozenset(name_of(item) for item in items if has_sign(item)),
            {name_of(item): item.points for item in items},
            told,
            made,
            self._scales(task),
        )

    def _scales(self, task: Task) -> dict[str, float]:
        """Return the scales of a task as its file would have them."""
        return {}

    def _learn_from(self, main: KindProblem) -> None:
        """Learn from the file itself the requested items, and which of its answers are zero."""
        try:
            task = self._task(main)
            items = task.list_items()
            exact = [task.sheet(item.position).exact_answers[item.question.id] for item in items]
            made = self._evaluate_task(task, strictly=False)
        except PlanMethodError:
            return
        self.main = made if isinstance(made, EvaluatedVariant) else None
        pairs = zip(items, exact, strict=True)
        self.zero_answers = frozenset(
            name_of(item) for item, value in pairs if abs(value) <= ZERO_TOLERANCE
        )
        moving = [item for item in items if name_of(item) not in self.zero_answers]
        self._moving = tuple((item.question.key, item.position, item.name) for item in moving)


class PlanEvaluator(CandidateEvaluator):
    """Judges candidates whose answers are drawn: most are read together."""

    draws = True

    def evaluate(self, problems: Sequence[Problem]) -> Iterator[EvaluatedVariant | Rejection]:
        """Yield what each candidate is, in order."""
        linkages = [free_scales(problem) for problem in problems]
        sieve = screen_linkages(linkages, self._moving, self.settings)
        found: dict[int, EvaluatedVariant | Rejection] = {**sieve.rejections}
        for k, solution in sieve.solutions.items():
            found[k] = self._evaluate_linkage(solution)
        for batch, members in sieve.batches:
            found.update(zip(members, self._evaluate_batch(batch), strict=True))
        yield from (found[k] for k in range(len(linkages)))

    def _evaluate_linkage(self, solution: Solution) -> EvaluatedVariant | Rejection:
        try:
            return self._evaluate_task(Task(solution, self.settings))
        except PlanMethodError:
            return Rejection(RejectionReason.FAULTY)

    def _evaluate_batch(self, batch: Batch) -> Sequence[EvaluatedVariant | Rejection]:
        """Return what each variant of a batch is: errors and mistakes are rows of one reading."""
        try:
            tasks = batch_tasks(batch, self.settings)
            limits = dict(enumerate(map(self._limits, tasks)))
            kept = [k for k, own in limits.items() if not isinstance(own, Rejection)]
            positions = dict.fromkeys(
                item.position for task in tasks[:1] for item in task.list_items()
            )
            named = {p: batch_named(batch, tasks, p, kept) for p in positions}
        except PlanMethodError:
            tasks = []
        if not tasks:
            return [self._evaluate_linkage(one) for one in batch.solutions]
        found: list[EvaluatedVariant | Rejection] = []
        for k, task in enumerate(tasks):
            own = limits[k]
            shown = {position: every.get(k, []) for position, every in named.items()}
            found.append(own if isinstance(own, Rejection) else self._accept(task, own, shown))
        return found

    def _scales(self, task: Task) -> dict[str, float]:
        """Return the scales of a task as its file would have them."""
        convention = task.solution.problem.scales.convention
        whole = dict(task.scales({}, task.first))
        found = {FACTS[kind].scale: whole[FACTS[kind].scale] for kind in MOTION}
        found |= {name: value for name, value in whole.items() if name == "mu_F"}
        if convention is not Convention.UNIT_PER_MM:
            found = {name: 1.0 / value for name, value in found.items()}
        return {name: float(f"{value:.9g}") for name, value in found.items()}


def evaluator_of(
    kind: ProblemKind[Any], main: KindProblem, settings: Settings
) -> CandidateEvaluator:
    """Return the evaluator of candidates of a file, with drawn or computed answers."""
    drawn = isinstance(kind.answer_source(main), Solution)
    return (PlanEvaluator if drawn else CandidateEvaluator)(kind, main, settings)


def name_of(item: TaskItem) -> str:
    """Return what an answer is called among those of all positions."""
    return f"{item.name} #{item.position}" if item.position else item.name


def has_sign(item: TaskItem) -> bool:
    """Return whether the sign of an answer counts."""
    return item.asks_sense or item.question.sign is Sign.STRICT


def free_scales(problem: Problem) -> Problem:
    """Return a problem whose scales are chosen by the program, from the series."""
    own = problem.scales
    return replace(problem, scales=replace(own, mu_l=None, mu_v=None, mu_a=None, mu_F=None))


def _sheet(task: Task, position: int) -> Sheet:
    """Return the sheet of a position: among other variants as it was read with them."""
    sheet = task.sheet(position)
    return sheet if sheet.row is None else sheet.answer_key_sheet


# Mistakes ---------------------------------------------------------------------------------------


def distinct(
    items: Sequence[TaskItem],
    limits: Mapping[str, Tolerance],
    named: Mapping[int, Sequence[MistakeEffect]],
) -> tuple[frozenset[Place], frozenset[Place]]:
    """Return the mistakes that answers distinguish from right ones and all others, and all.

    Two are distinguished if some answer of one differs from the other's by more than its tolerance,
    enlarged if the mistake makes it larger. ``named`` has them by position.
    """
    told: set[Place] = set()
    made: set[Place] = set()
    for position in dict.fromkeys(item.position for item in items):
        here = [item for item in items if item.position == position]
        known = [limits[name_of(item)] for item in here]
        places = [(code, where) for code, where, _ in named[position]]
        made.update(places)
        apart = _find_distinct(here, known, named[position])
        told.update(place for place, own in zip(places, apart, strict=True) if own)
    return frozenset(told), frozenset(made)


def _find_distinct(
    items: Sequence[TaskItem], limits: Sequence[Tolerance], named: Sequence[MistakeEffect]
) -> npt.NDArray[np.bool_]:
    """Return which mistakes are unlike all others, shape (mistakes,)."""
    right = np.array([limit.exact for limit in limits])
    given = np.array([[values[item.question.id] for item in items] for *_, values in named])
    table = np.vstack([right, given.reshape(-1, len(items))])
    signed = np.array([has_sign(item) for item in items])
    measured = np.array([not limit.zero for limit in limits])
    slack = np.array([max(limit.spread, limit.tolerance()) for limit in limits])
    size = np.abs(right)
    share = np.maximum(np.abs(table) / np.where(size > 0, size, 1.0), MIN_ERROR_FRACTION)
    codes = np.array(["", *(code for code, *_ in named)])
    one, other = np.triu_indices(len(codes), 1)
    pairs = codes[one] != codes[other]
    one, other = one[pairs], other[pairs]
    for k in np.flatnonzero(measured):  # fewer pairs are left with every answer
        a, b = table[one, k], table[other, k]
        apart = np.abs(np.abs(a) - np.abs(b)) > slack[k] * np.maximum(
            share[one, k], share[other, k]
        )
        if signed[k]:
            apart |= a * b < 0
        one, other = one[~apart], other[~apart]
    found = np.ones(len(codes), dtype=bool)
    found[one] = found[other] = False
    return found[1:]
