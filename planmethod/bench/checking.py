"""Checking of simulated drawn submissions: false alarms, named mistakes."""

from __future__ import annotations

import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np
from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.bench.speed import clock
from planmethod.check.calculation import Calculation
from planmethod.check.checking import check
from planmethod.check.key import Key, key_of_task
from planmethod.check.marks import DEFAULT, PROFILES
from planmethod.check.mistakes.model import Change
from planmethod.check.model import GradedAnswer, GradedSubmission, KeyEntry, Verdict
from planmethod.check.pages.files import write_all
from planmethod.check.questions import Sign
from planmethod.check.simulation import planted, simulate_submissions
from planmethod.check.task import Task, TaskItem
from planmethod.problem.model import Problem
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
    assert isinstance(task.problem, Problem)
    return "levers" if task.problem.dynamics is None else "forces"


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
            write_all(Path(folder), checked, keys, DEFAULT, [], "ru")

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
