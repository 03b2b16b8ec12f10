"""Evaluation of candidates: lengths, readability, distinguished mistakes (годность варианта)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, cast

import numpy as np
import numpy.typing as npt
from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.batch import batch_named, batch_tasks
from planmethod.check.calculation import Calculation
from planmethod.check.key import MistakeEffect
from planmethod.check.marks import Settings
from planmethod.check.questions import Sign
from planmethod.check.sheet import Sheet
from planmethod.check.task import Task, TaskItem
from planmethod.check.tolerance import Tolerance, limit_of
from planmethod.errors import PlanMethodError
from planmethod.gears.conditions import conditions
from planmethod.gears.model import GearProblem
from planmethod.gears.motion import solve_motion
from planmethod.kind import ProblemKind
from planmethod.plans.model import FACTS, MOTION
from planmethod.problem.common import KindProblem
from planmethod.problem.model import Convention, Problem
from planmethod.problem.selector import Selector
from planmethod.solved.many.variants import Batch
from planmethod.solved.solution import Solution
from planmethod.varying.screening import (
    MAX_RELATIVE_SIGMA,
    MIN_LENGTH_MM,
    Rejection,
    RejectionReason,
    screen_linkages,
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

    def off(self, variant: EvaluatedVariant, among: Sequence[str]) -> float:
        """Return the share of the points that another variant's answers lose here."""
        lost = sum(self.points[i] for i in among if self._is_off(i, variant.exact.get(i, math.nan)))
        whole = sum(self.points[i] for i in among)
        return lost / whole if whole else 0.0

    def _is_off(self, item: str, value: float) -> bool:
        own = self.exact[item]
        turned = item in self.signed and value * own < 0
        return turned or not abs(abs(value) - abs(own)) <= self.allowed[item]


class CandidateEvaluator:
    """Judges candidates of one file (отбор).

    Parameters
    ----------
    kind : ProblemKind or None
        None of a linkage.
    main : KindProblem
        The file itself: what does not move there need not move in a variant, and a condition of
        teeth that fails there may fail in a variant.
    settings : Settings

    Attributes
    ----------
    main : EvaluatedVariant or None
        The file itself, however good; None where it cannot be solved.
    """

    def __init__(
        self, kind: ProblemKind[Any] | None, main: KindProblem, settings: Settings
    ) -> None:
        self.kind, self.settings = kind, settings
        self.waived = frozenset(_failing(main))
        self.zero_answers: frozenset[str] = frozenset()
        self.main: EvaluatedVariant | None = None
        self._moving: tuple[tuple[Selector, int, str], ...] = ()
        self._learn_from(main)

    def evaluate(self, problems: Sequence[KindProblem]) -> Iterator[EvaluatedVariant | Rejection]:
        """Yield what each candidate is, in order."""
        if self.kind is not None:
            yield from map(self._evaluate_computed, problems)
            return
        linkages = [free_scales(cast("Problem", problem)) for problem in problems]
        sieve = screen_linkages(linkages, self._moving, self.settings)
        found: dict[int, EvaluatedVariant | Rejection] = {**sieve.rejections}
        for k, solution in sieve.solutions.items():
            found[k] = self._evaluate_linkage(solution)
        for batch, members in sieve.batches:
            found.update(zip(members, self._evaluate_batch(batch), strict=True))
        yield from (found[k] for k in range(len(linkages)))

    def _evaluate_computed(self, problem: KindProblem) -> EvaluatedVariant | Rejection:
        assert self.kind is not None
        try:
            failing = next((one for one in _failing(problem) if one not in self.waived), None)
            if failing is not None:
                return Rejection(RejectionReason.CONDITION, failing[0])
            return self._evaluate_task(Calculation(self.kind, problem, self.settings))
        except PlanMethodError:
            return Rejection(RejectionReason.FAULTY)

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
        for item in items:
            length = _sheet(task, item).length(item.question)
            short = length is not None and length < MIN_LENGTH_MM
            if strictly and short and name_of(item) not in self.zero_answers:
                return Rejection(RejectionReason.SHORT, item.name)
        for item in items:
            sheet, name = _sheet(task, item), name_of(item)
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
            _scales_of(task) if self.kind is None else {},
        )

    def _learn_from(self, main: KindProblem) -> None:
        """Learn from the file itself the requested items, and which of its answers are zero."""
        try:
            if self.kind is not None:
                task: Task = Calculation(self.kind, main, self.settings)
            else:
                task = Task(Solution(cast("Problem", main)), self.settings)
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
        self._moving = tuple((item.question.selector, item.position, item.name) for item in moving)


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


def _sheet(task: Task, item: TaskItem) -> Sheet:
    """Return the sheet of an answer: among other variants as it was read with them."""
    sheet = task.sheet(item.position)
    return sheet if sheet.row is None else sheet.answer_key_sheet


def _scales_of(task: Task) -> dict[str, float]:
    """Return the scales of a task as its file would have them."""
    convention = task.solution.problem.scales.convention
    whole = dict(task.scales({}, task.first))
    found = {FACTS[kind].scale: whole[FACTS[kind].scale] for kind in MOTION}
    found |= {name: value for name, value in whole.items() if name == "mu_F"}
    if convention is not Convention.UNIT_PER_MM:
        found = {name: 1.0 / value for name, value in found.items()}
    return {name: float(f"{value:.9g}") for name, value in found.items()}


def _failing(problem: KindProblem) -> Iterator[Place]:
    """Yield the conditions of teeth that a train does not meet, with the wheel of each."""
    if isinstance(problem, GearProblem):
        for one in conditions(solve_motion(problem)):
            if not one.is_satisfied:
                yield one.name, one.facts.get("wheel") or one.facts.get("carrier", "")


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
    codes = ["", *(code for code, *_ in named)]
    found = np.ones(len(codes), dtype=bool)
    for k in range(len(codes)):
        off = np.abs(np.abs(table) - np.abs(table[k]))
        turned = signed & (table * table[k] < 0)
        apart = ((off > slack * np.maximum(share, share[k])) | turned) & measured
        alike = ~apart.any(axis=1)
        found[k] = not any(alike[m] and codes[m] != codes[k] for m in range(len(codes)))
    return found[1:]
