"""Fairness of checking: two mistakes at once, a student's own numbers, computed problems."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.bench.checking import (
    SEED,
    Detected,
    FaultlessStats,
    called,
    check_faultless,
    codes_of_variant,
    count_submission,
    detection,
    family_of,
    first_items,
    predict_answers,
    shows,
    sure_codes,
    tasks_of,
    twins,
)
from planmethod.check.calculation import Calculation
from planmethod.check.checking import check
from planmethod.check.explain import Explanation
from planmethod.check.key import Key, key_of_task
from planmethod.check.marks import DEFAULT
from planmethod.check.mistakes.model import Change, MistakeContext, times
from planmethod.check.model import GradedSubmission, Sense, Submission, WrittenAnswer
from planmethod.check.questions import Sign
from planmethod.check.routes import QuantityKey, find_routes, quantity_keys_of
from planmethod.check.simulation import as_written, simulate_submissions
from planmethod.check.task import Task, TaskItem
from planmethod.kind import ProblemKind
from planmethod.problem.common import KindProblem
from planmethod.problem.model import Problem

Computed = tuple[ProblemKind[Any], KindProblem]

PAIRS = 12
"""Pairs of mistakes that are planted in a problem, chosen at random."""

MIN_DIFFERENT_ANSWERS = 3
"""Minimum number of answers that surely differ from the predictions of either mistake alone."""

FACTORS = (0.7, 1.4)
"""Factors of a number that is wrong for no known reason."""

PLACE = 10.0
"""A decimal place lost in a computed number."""


class Inherited(Struct):
    """Answers that follow from a student's own wrong number.

    Attributes
    ----------
    route : str
        "plans": continued on the plans; "routes": by another formula of the textbook.
    answers, faulted : int
        Those that follow, and those of them that lose points.
    """

    family: str
    problem: str
    route: str
    answers: int = 0
    faulted: int = 0


def tasks_of_kinds(problems: Sequence[Computed]) -> list[Calculation]:
    """Return the tasks of problems that are computed; variants of one file know each other."""
    tasks: list[Calculation] = []
    for kind, problem in problems:

        def list_variants(name: str = problem.name) -> Iterator[Task]:
            return (task for task in tasks if task.problem.name == name)

        tasks.append(Calculation(kind, problem, DEFAULT, list_variants))
    return tasks


# Two mistakes at once ------------------------------------------------------------------------


def two_at_once(task: Task, count: int) -> Detected:
    """Plant two mistakes, of which neither alone gives the answers.

    *Named*: both are; *among*: one is, or a right one is among two or three; *wrongly*: any that
    is named surely is neither.
    """
    row = Detected(called(task), "two", family_of(task))
    items = first_items(task)
    key, given = key_of_task(task, items), [*predict_answers(task, items)]
    right = [entry.exact for entry in key.entries]
    for number, (one, two, both) in enumerate(_pairs(task, key, items)):
        first, second = (
            twins(given, change, right) | codes_of_variant(task, items, given, change)
            for change in (one, two)
        )
        for work in simulate_submissions(task, both, count, SEED + number):
            _count_two(row, check(task, work), first, second)
    return row


def _pairs(
    task: Task, key: Key, items: Sequence[TaskItem]
) -> Iterator[tuple[Change, Change, Change]]:
    explained = task.explanations(task.sheet(items[0].position))
    singles = [e for e in explained.named if e.change is not None and not e.change.of_scale]
    pairs = [pair for pair in combinations(singles, 2) if pair[0].code != pair[1].code]
    np.random.default_rng(SEED).shuffle(pairs)
    made = 0
    for one, two in pairs:
        both = explained.of_both(one, two)
        if both is None or not all(_is_distinct(key, items, both, e) for e in (one, two)):
            continue
        assert one.change is not None and two.change is not None and both.change is not None
        yield one.change, two.change, both.change
        made += 1
        if made == PAIRS:
            return


def _is_distinct(key: Key, items: Sequence[TaskItem], one: Explanation, two: Explanation) -> bool:
    """Return whether some answers are surely others."""
    differ = (
        shows(replace(entry, exact=two.values[item.question.id]), one.values[item.question.id])
        for entry, item in zip(key.entries, items, strict=True)
    )
    return sum(differ) >= MIN_DIFFERENT_ANSWERS


def _count_two(row: Detected, checked: GradedSubmission, first: set[str], second: set[str]) -> None:
    count_submission(row, checked, first | second)
    sure = sure_codes(checked)
    if not sure - first - second and sure and not (sure & first and sure & second):
        row.named, row.among = row.named - 1, row.among + 1  # but one of them


# One's own numbers ---------------------------------------------------------------------------


def by_plans(task: Task, count: int) -> Inherited:
    """Make every requested number wrong once, and let the plans continue with it."""
    row = Inherited(family_of(task), called(task), "plans")
    items = first_items(task)
    key, sheet = key_of_task(task, items), task.sheet(items[0].position)
    scene, explained = MistakeContext(sheet), task.explanations(sheet)
    for number, item in enumerate(items):
        step = scene.compute(item.question.name)
        if step is None or key.entries[number].zero:
            continue
        for factor in FACTORS:
            change = Change("", item.id, {step.out: times(step, factor)})
            made = explained.of_change(change)
            if made is None:
                continue
            follow = {
                entry.id
                for entry, one in zip(key.entries, items, strict=True)
                if one is not item and shows(entry, made.values[one.question.id])
            }
            for work in simulate_submissions(task, change, count, SEED + number):
                _count_inherited(row, check(task, work), follow)
    return row


def _count_inherited(row: Inherited, checked: GradedSubmission, follow: set[str]) -> None:
    told = [answer for answer in checked.answers if answer.id in follow]
    row.answers += len(told)
    row.faulted += sum(answer.points < answer.of for answer in told)


def by_routes(task: Task, count: int) -> Inherited:
    """Let a number be wrong, and another one be computed from it by each right formula."""
    row = Inherited(family_of(task), called(task), "routes")
    items = first_items(task)
    key, sheet = key_of_task(task, items), task.sheet(items[0].position)
    exact = {item.id: abs(entry.exact) for item, entry in zip(items, key.entries, strict=True)}
    of = {
        item.id: [*quantity_keys_of(sheet, item.question.selector)]
        for item in items
        if exact[item.id]
    }
    told: dict[QuantityKey, str] = {role: name for name, roles in of.items() for role in roles}
    works = simulate_submissions(task, None, count, SEED)
    for name, roles in of.items():
        for route in (way for role in roles for way in find_routes(sheet, role, told)):
            wrong = next((parent for parent, _ in route if parent != name), None)
            if wrong is None:
                continue
            for work in works:
                for factor in FACTORS:
                    own = {answer.id: answer for answer in work.answers}
                    own[wrong] = _with_value(own[wrong], abs(own[wrong].value or 0.0) * factor)
                    ratios = (
                        (abs(own[parent].value or 0.0) / exact[parent]) ** power
                        for parent, power in route
                    )
                    own[name] = _with_value(own[name], exact[name] * float(np.prod([*ratios])))
                    checked = check(task, replace(work, answers=tuple(own.values())))
                    both = [answer for answer in checked.answers if answer.id in (wrong, name)]
                    row.answers += 1  # one of the two is wrong, and the other follows from it
                    row.faulted += sum(answer.points < answer.of for answer in both) > 1
    return row


def _with_value(answer: WrittenAnswer, value: float) -> WrittenAnswer:
    """Return an answer with another size, its sense as it was."""
    rounded, step = as_written(value)
    sign = -1.0 if answer.sense is None and (answer.value or 0.0) < 0 else 1.0
    return replace(answer, value=sign * float(rounded), step=float(step), raw="")


# What is computed ----------------------------------------------------------------------------


def compute_submissions(
    task: Calculation, values: Mapping[str, float], count: int, seed: int
) -> Iterator[Submission]:
    """Yield submissions with some computed values, rounded to three digits or four."""
    random = np.random.default_rng(seed)
    for number in range(1, count + 1):
        answers = []
        for item in first_items(task):
            digits = int(random.integers(3, 5))
            value = values[item.question.id]
            whole = item.fixed is not None and float(value).is_integer()
            text = f"{value:.10g}" if whole else f"{value:.{digits}g}"
            told = float(text)
            step = 10.0 ** (np.floor(np.log10(abs(told))) + 1 - digits) if told else 0.01
            sense = (Sense.CCW if told > 0 else Sense.CW) if item.asks_sense and told else None
            size = abs(told) if sense or item.question.sign is Sign.SIZE else told
            answers.append(
                WrittenAnswer(id=item.id, value=size, step=0.0 if whole else step, sense=sense)
            )
        yield Submission(f"{number:02d}", tuple(answers), task.variant)


def check_computed(task: Calculation, count: int) -> FaultlessStats:
    """Check computed submissions without a mistake."""
    found = FaultlessStats(called(task), "computed")
    for work in compute_submissions(
        task, task.sheet(first_items(task)[0].position).exact_answers, count, SEED
    ):
        checked = check(task, work)
        faulted = sum(answer.points < answer.of for answer in checked.answers)
        found.works += 1
        found.answers += len(checked.answers)
        found.faulted += faulted
        found.hurt += faulted > 0
        found.named += any(diagnosis.codes for diagnosis in checked.diagnosis)
    return found


def computed_detection(task: Calculation, count: int) -> list[Detected]:
    """Plant every mistake and a slip in each number of a computed problem, and hear of them."""
    found: dict[str, Detected] = {}
    items = first_items(task)
    key, sheet = key_of_task(task, items), task.sheet(items[0].position)
    ids = [item.question.id for item in items]
    made = [(e.code, [e.values[name] for name in ids]) for e in task.named(sheet)]
    for name in ids:
        wrong = {**sheet.exact_answers, name: sheet.exact_answers[name] * PLACE}
        made.append(("S4", [wrong[one] for one in ids]))
    for number, (code, values) in enumerate(made):
        if not np.isfinite(values).all() or not any(map(shows, key.entries, values)):
            continue
        row = found.setdefault(code, Detected(called(task), code, family_of(task)))
        alike = {one for one, others in made if np.allclose(others, values, rtol=1e-3)}
        right = [entry.exact for entry in key.entries]
        if sum(not np.isclose(a, b) for a, b in zip(values, right, strict=True)) == 1 and any(
            np.isclose(a, -b) for a, b in zip(values, right, strict=True) if b
        ):
            alike.add("sign")
        planted = dict(zip(ids, values, strict=True))
        for work in compute_submissions(task, planted, count, SEED + number):
            count_submission(row, check(task, work), alike)
    for other in task.other_variants():
        theirs = task.find_matching_sheet(other, sheet)
        if theirs is None:
            continue
        row = found.setdefault("P2", Detected(called(task), "P2", family_of(task)))
        for work in compute_submissions(task, theirs.exact_answers, count, SEED):
            count_submission(row, check(task, work), {"P2"})
    return list(found.values())


def computed_inherited(task: Calculation, count: int) -> Inherited:
    """Let every number be wrong once, and compute from it whatever follows."""
    row = Inherited(family_of(task), called(task), "formulas")
    items = first_items(task)
    sheet = task.sheet(items[0].position)
    names = {item.question.selector.names[0]: item for item in items}
    for number, (wrong, item) in enumerate(names.items()):
        for factor in FACTORS:
            own = {name: sheet.exact_answers[one.question.id] for name, one in names.items()}
            own[wrong] *= factor
            values = {**sheet.exact_answers, item.question.id: own[wrong]}
            follow = set()
            for name, one in names.items():
                for value, by in task.quantities.derive_values(name, own):
                    if by == wrong and np.isfinite(value) and name != wrong:
                        values[one.question.id] = value
                        follow.add(one.id)
                        break
            for work in compute_submissions(task, values, count, SEED + number) if follow else ():
                _count_inherited(row, check(task, work), follow)
    return row


# All together --------------------------------------------------------------------------------


class Confusion(Struct, frozen=True):
    """Results of checking submissions of all kinds (таблица путаницы).

    Attributes
    ----------
    faultless : list of tuple of str and FaultlessStats
        With the family that each is of.
    detected : list of Detected
        One mistake, also the numbers of another variant: ``P2``.
    two : list of Detected
    inherited : list of Inherited
    """

    faultless: list[tuple[str, FaultlessStats]]
    detected: list[Detected]
    two: list[Detected]
    inherited: list[Inherited]


def confused(problems: Sequence[Problem], computed: Sequence[Computed], works: int) -> Confusion:
    """Check submissions of every kind for every problem.

    Parameters
    ----------
    works : int
        Honest ones of each problem; with each mistake at each place a tenth of them.
    """
    few = max(1, works // 10)
    found = Confusion([], [], [], [])
    for task in tasks_of(problems):
        found.faultless.append((family_of(task), check_faultless(task, works)))
        found.detected.extend(detection(task, few))
        found.two.append(two_at_once(task, few))
        found.inherited.extend((by_plans(task, 1), by_routes(task, 1)))
    for one in tasks_of_kinds(computed):
        found.faultless.append((family_of(one), check_computed(one, works)))
        found.detected.extend(computed_detection(one, few))
        found.inherited.append(computed_inherited(one, few))
    return found
