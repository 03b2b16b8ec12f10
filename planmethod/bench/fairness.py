"""Fairness of checking on simulated submissions: false alarms, named mistakes, consequences."""

from __future__ import annotations

import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.bench.measurements import clock
from planmethod.check.calculation import Calculation, task_of_problem
from planmethod.check.checking import check
from planmethod.check.explain import Explanation
from planmethod.check.key import Key, key_of_task
from planmethod.check.marks import DEFAULT, PROFILES
from planmethod.check.mistakes.plans import Change, MistakeContext, times
from planmethod.check.model import (
    GradedAnswer,
    GradedSubmission,
    KeyEntry,
    Sense,
    Submission,
    Verdict,
    WrittenAnswer,
)
from planmethod.check.pages.files import GradingRun, write_all
from planmethod.check.relations import derived_values
from planmethod.check.routes import ArmQuantity, arm_quantities, find_routes
from planmethod.check.simulation import as_written, planted, simulate_submissions
from planmethod.check.task import Task, TaskItem
from planmethod.kind import ProblemKind
from planmethod.problem.model import Problem
from planmethod.problem.quantities import Sign
from planmethod.problem.records import KindProblem
from planmethod.solved.solution import Solution

FLAT = (0.05, 0.10)
"""Tolerances that departments have, shares of the value."""

SEED = 12
PLACES = 4
"""Places at which a mistake is planted, evenly spread over those where it can be made."""

GROUP = 30

SAME_TOLERANCE = 1e-3
"""Answers of two mistakes that differ by no more of themselves are the same when written."""

FEW = 3
"""Maximum number of mistakes offered to a student as "one of"."""

OFF = (Verdict.WRONG, Verdict.NEAR, Verdict.INHERITED, Verdict.INCONSISTENT)


class FaultlessStats(Struct):
    """Works without a mistake, by problem and profile.

    Attributes
    ----------
    answers, works : int
    unseen : int
        Answers that the drawing cannot show.
    faulted, hurt : int
        Answers, and submissions, that lose points.
    named : int
        Works in which a mistake is named.
    flat, flat_hurt : dict of float to int
        The same for a flat tolerance, on nonzero answers.
    """

    problem: str
    profile: str
    answers: int = 0
    works: int = 0
    unseen: int = 0
    faulted: int = 0
    hurt: int = 0
    named: int = 0
    flat: Counter[float] = field(default_factory=Counter)
    flat_hurt: Counter[float] = field(default_factory=Counter)


class Detected(Struct):
    """One mistake in one problem: its submissions, and the results of checking them.

    Attributes
    ----------
    works : int
        Without places where the key says that no answer shows it.
    noticed : int
        Works in which an answer is faulted.
    named, among, unknown, misnamed : int
        Named surely, or one that gives the same answers; among two or three; not recognised, or
        among more; another one named surely.
    over_half : int
        Works that get more than half of their points.
    """

    problem: str
    code: str
    family: str = ""
    works: int = 0
    noticed: int = 0
    named: int = 0
    among: int = 0
    unknown: int = 0
    misnamed: int = 0
    over_half: int = 0
    named_as: Counter[str] = field(default_factory=Counter)


def tasks_of(problems: Sequence[Problem], profile: str = DEFAULT.profile) -> list[Task]:
    """Return the tasks of problems; variants of one file know each other."""
    settings = replace(DEFAULT, profile=profile)
    tasks: list[Task] = []
    for problem in problems:

        def list_variants(name: str = problem.name) -> Iterator[Task]:
            return (task for task in tasks if task.solution.problem.name == name)

        tasks.append(Task(Solution(problem), settings, list_variants))
    return tasks


def called(task: Task) -> str:
    """Return the name of a task in the tables."""
    return task.problem.name + (f" ({task.variant})" if task.variant else "")


def family_of(task: Task) -> str:
    """Return what a task is counted with."""
    if isinstance(task, Calculation):
        return task.table
    return "levers" if task.solution.problem.dynamics is None else "forces"


def first_items(task: Task) -> list[TaskItem]:
    """Return the requested items of the first position that has any."""
    items = task.usual()
    return [item for item in items if item.position == items[0].position]


# Honest works --------------------------------------------------------------------------------


def check_faultless(task: Task, count: int) -> FaultlessStats:
    """Check submissions without a mistake."""
    found = FaultlessStats(called(task), task.settings.profile)
    for work in simulate_submissions(task, count=count, seed=SEED):
        checked = check(task, work)
        off = {share: sum(_is_rejected(a, share) for a in checked.answers) for share in FLAT}
        faulted = sum(answer.points < answer.of for answer in checked.answers)
        found.works += 1
        found.answers += len(checked.answers)
        found.unseen += sum(answer.verdict is Verdict.UNSEEN for answer in checked.answers)
        found.faulted += faulted
        found.hurt += faulted > 0
        found.named += any(diagnosis.codes for diagnosis in checked.diagnosis)
        found.flat.update(off)
        found.flat_hurt.update({share: int(beyond > 0) for share, beyond in off.items()})
    return found


def _is_rejected(answer: GradedAnswer, tolerance: float) -> bool:
    """Return whether a flat tolerance rejects an answer; False for a zero one."""
    key, value = answer.key, answer.value
    if key is None or value is None or key.zero:
        return False
    return abs(abs(value) - abs(key.exact)) > tolerance * abs(key.exact)


def check_all_faultless(problems: Sequence[Problem], count: int) -> list[FaultlessStats]:
    """Check faultless submissions of every problem, drawn and graded by every profile."""
    return [check_faultless(task, count) for name in PROFILES for task in tasks_of(problems, name)]


# Planted mistakes ----------------------------------------------------------------------------


def places_of(task: Task, key: Key) -> Iterator[Change]:
    """Yield mistakes at a few places each, those that the answers cannot show left out."""
    made: dict[str, list[Change]] = {}
    for change, values in predict_answers(task, first_items(task)):
        if any(map(shows, key.entries, values)):
            made.setdefault(change.code, []).append(change)
    for changes in made.values():
        yield from changes[:: -(-len(changes) // PLACES)]


def predict_answers(task: Task, items: Sequence[TaskItem]) -> Iterator[tuple[Change, list[float]]]:
    """Yield every mistake with its predictions, sizes unsigned."""
    sheet = task.sheet(items[0].position)
    for change in planted(sheet, items):
        explanation = task.explanations(sheet).of_change(change)
        if explanation is not None:
            values = [explanation.values[item.question.id] for item in items]
            yield (
                change,
                [
                    abs(value) if item.question.sign is Sign.SIZE else value
                    for item, value in zip(items, values, strict=True)
                ],
            )


def twins(
    predictions: Sequence[tuple[Change, list[float]]], change: Change, right: Sequence[float]
) -> set[str]:
    """Return the codes of all mistakes that give the same answers."""
    mine = next(values for one, values in predictions if one == change)
    codes = {
        one.code for one, values in predictions if np.allclose(values, mine, rtol=SAME_TOLERANCE)
    }
    turned = sum(a * b < 0 for a, b in zip(mine, right, strict=True))
    if turned == 1 and np.allclose(np.abs(mine), np.abs(right), rtol=SAME_TOLERANCE):
        codes.add("sign")  # only one sense differs
    return codes


def codes_of_variant(
    task: Task,
    items: Sequence[TaskItem],
    predictions: Sequence[tuple[Change, list[float]]],
    change: Change,
) -> set[str]:
    """Return P2 where a mistake gives the answers of another variant: its angle of the crank."""
    mine = next(values for one, values in predictions if one == change)
    for _, sheet in task.theirs(task.sheet(items[0].position)):
        theirs = [sheet.exact_answers[item.question.id] for item in items]
        if np.allclose(np.abs(theirs), np.abs(mine), rtol=SAME_TOLERANCE):
            return {"P2"}
    return set()


def shows(entry: KeyEntry, value: float) -> bool:
    """Return whether an answer deviates by more than drafting errors, according to the key."""
    off = abs(abs(value) - abs(entry.exact))
    turned = entry.asks_sense and value * entry.exact < 0
    return not entry.zero and (off > max(DEFAULT.k * entry.sigma, entry.tolerance) or turned)


def detection(task: Task, count: int) -> list[Detected]:
    """Plant every mistake in some submissions, and count the diagnoses."""
    found: dict[str, Detected] = {}
    items = first_items(task)
    key, given = key_of_task(task, items), [*predict_answers(task, items)]
    right = [entry.exact for entry in key.entries]
    for number, change in enumerate(places_of(task, key)):
        row = found.setdefault(change.code, Detected(called(task), change.code, family_of(task)))
        alike = twins(given, change, right) | codes_of_variant(task, items, given, change)
        for work in simulate_submissions(task, change, count, SEED + number):
            count_submission(row, check(task, work), alike)
    for other in task.other_variants():
        row = found.setdefault("P2", Detected(called(task), "P2", family_of(task)))
        for work in simulate_submissions(other, None, count, SEED):
            count_submission(row, check(task, replace(work, variant=task.variant)), {"P2"})
    return list(found.values())


def count_submission(row: Detected, checked: GradedSubmission, expected: set[str]) -> None:
    """Count a submission in which any of several equivalent mistakes is right to name."""
    sure = sure_codes(checked)
    row.works += 1
    row.over_half += checked.points > checked.of / 2
    row.noticed += any(answer.verdict in OFF for answer in checked.answers)
    if sure - expected:
        row.misnamed += 1
        row.named_as.update(sure - expected)
    elif sure:
        row.named += 1
    elif any(expected & {*d.codes} for d in checked.diagnosis if len(d.codes) <= FEW):
        row.among += 1
    else:
        row.unknown += 1


def sure_codes(checked: GradedSubmission) -> set[str]:
    """Return the mistakes that are named surely."""
    return {diagnosis.codes[0] for diagnosis in checked.diagnosis if diagnosis.sure}


def all_detected(problems: Sequence[Problem], count: int) -> list[Detected]:
    """Plant every mistake in submissions of every problem."""
    return [row for task in tasks_of(problems) for row in detection(task, count)]


def hidden(problems: Sequence[Problem]) -> list[tuple[str, Key]]:
    """Return the keys of problems, which say what their answers cannot show."""
    return [(called(task), key_of_task(task, first_items(task))) for task in tasks_of(problems)]


# Speed ---------------------------------------------------------------------------------------


class Speed(Struct, frozen=True):
    """Seconds that the checking of a problem takes.

    Attributes
    ----------
    first : float
        Problem solved, tolerances found, one submission with a mistake graded and explained.
    faultless, mistaken : float
        A further submission without a mistake, and with one.
    key : float
        The key of a solved problem.
    group : float
        Group graded, every other submission with a mistake, including tables and pages.
    """

    problem: str
    answers: int
    first: float
    faultless: float
    mistaken: float
    key: float
    group: float


def speed(problem: Problem) -> Speed:
    """Time the checking of one problem."""
    (task,) = tasks_of([problem])
    items = first_items(task)
    change = _common(task, items)
    works, wrong = (
        simulate_submissions(task, count=GROUP, seed=SEED),
        simulate_submissions(task, change, GROUP, SEED),
    )
    first = _seconds(lambda: check(Task(Solution(problem)), wrong[0]))
    honestly = clock(lambda: [check(task, work) for work in works]).median / len(works)
    mistaken = clock(lambda: [check(task, work) for work in wrong]).median / len(wrong)
    key = _seconds(lambda: key_of_task(Task(Solution(problem))))
    group = [*works[::2], *wrong[1::2]]
    for number, work in enumerate(group):
        group[number] = replace(work, student=f"{number + 1:02d}")

    def with_pages() -> None:
        again = Task(Solution(problem))
        checked = [check(again, work) for work in group]
        keys = {again.variant: key_of_task(task, items)}  # that knows what the works answer
        with tempfile.TemporaryDirectory() as folder:
            write_all(Path(folder), checked, keys, GradingRun(DEFAULT, [], "ru"))

    return Speed(
        called(task), len(items), first, honestly, mistaken, key, _seconds(with_pages)
    )  # fmt: skip


def _common(task: Task, items: Sequence[TaskItem]) -> Change:
    """Return the first mistake that shows: of the Coriolis acceleration, where there is one."""
    made = list(places_of(task, key_of_task(task, items)))
    return next((change for change in made if change.code == "A1"), made[0])


def _seconds(act: Callable[[], object]) -> float:
    start = time.perf_counter()
    act()
    return time.perf_counter() - start


ProblemOfKind = tuple[ProblemKind[Any], KindProblem]

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


def tasks_of_kinds(problems: Sequence[ProblemOfKind]) -> list[Task]:
    """Return the tasks of problems of any kind; variants of one file know each other."""
    tasks: list[Task] = []
    for kind, problem in problems:

        def list_variants(name: str = problem.name) -> Iterator[Task]:
            return (task for task in tasks if task.problem.name == name)

        tasks.append(task_of_problem(kind, problem, DEFAULT, list_variants, verified=False))
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
    of = {item.id: [*arm_quantities(sheet, item.question.key)] for item in items if exact[item.id]}
    told: dict[ArmQuantity, str] = {role: name for name, roles in of.items() for role in roles}
    works = simulate_submissions(task, None, count, SEED)
    for name, roles in of.items():
        for route, _ in (way for role in roles for way in find_routes(sheet, role, told)):
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
    names = {item.question.key.names[0]: item for item in items}
    for number, (wrong, item) in enumerate(names.items()):
        for factor in FACTORS:
            own = {name: sheet.exact_answers[one.question.id] for name, one in names.items()}
            own[wrong] *= factor
            values = {**sheet.exact_answers, item.question.id: own[wrong]}
            follow, changed = set(), {wrong}
            for name in [*names][number + 1 :]:  # a student goes on in the order of the form
                for value, by in derived_values(task.relations(sheet.position), name, own):
                    if changed & {*by} and np.isfinite(value):
                        own[name] = values[names[name].question.id] = value
                        changed.add(name)
                        follow.add(names[name].id)
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


def confused(tasks: Sequence[Task], works: int) -> Confusion:
    """Check submissions of every kind for every problem.

    Parameters
    ----------
    works : int
        Honest ones of each problem; with each mistake at each place a tenth of them.
    """
    few = max(1, works // 10)
    found = Confusion([], [], [], [])
    for task in tasks:
        if isinstance(task, Calculation):
            found.faultless.append((family_of(task), check_computed(task, works)))
            found.detected.extend(computed_detection(task, few))
            found.inherited.append(computed_inherited(task, few))
        else:
            found.faultless.append((family_of(task), check_faultless(task, works)))
            found.detected.extend(detection(task, few))
            found.two.append(two_at_once(task, few))
            found.inherited.extend((by_plans(task, 1), by_routes(task, 1)))
    return found
