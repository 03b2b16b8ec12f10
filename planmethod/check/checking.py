"""Checking of a submission: from answers to verdicts, diagnosis, points (проверка работы)."""

from __future__ import annotations

import math
import os
import traceback
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from msgspec.structs import replace

from planmethod.check.calculation import Calculation, CalculationSheet
from planmethod.check.diagnosis import diagnose
from planmethod.check.grading import ExaminedAnswer, UnusableError, assign_verdicts, examine, replay
from planmethod.check.key import entry_of
from planmethod.check.marks import Settings
from planmethod.check.measured.drawing_questions import list_drawing_items
from planmethod.check.model import (
    CheckFailure,
    Diagnosis,
    GradedAnswer,
    GradedSubmission,
    Submission,
    Verdict,
    WrittenAnswer,
)
from planmethod.check.questions import Sign
from planmethod.check.routes import follow_routes
from planmethod.check.sheet import Sheet
from planmethod.check.task import Task, TaskItem
from planmethod.check.tolerance import limit_of
from planmethod.languages import translate, visible
from planmethod.plans.model import FACTS
from planmethod.solved.selectors.steps import NoValueError

SCALED = {facts.scale for facts in FACTS.values() if facts.scale}

MAX_ACCURACY_CHANCE = 1e-4
"""Chance of such accurate answers by hand, below which they are suspicious."""


def check(task: Task, submission: Submission) -> GradedSubmission:
    """Grade a submission: a pure function of the task and the written answers.

    Answers that were not requested are graded, but do not affect the points.
    """
    task = task.copy_for_submission()
    asked = list_drawing_items(task) if submission.drawn else task.usual()
    measured = {item.name: item for item in asked} if submission.drawn else {}
    names = {(item.name, item.position) for item in asked}
    found: dict[int, list[tuple[WrittenAnswer, TaskItem]]] = {}
    numbers: dict[int, int] = {}
    judged: dict[int, GradedAnswer] = {}
    for number, written in enumerate(submission.answers):
        name = written.id or written.what
        try:
            item = measured.get(written.id) or task.find(written)
        except NoValueError:
            judged[number] = GradedAnswer(name, Verdict.UNREADABLE, written=written)
            continue
        if (item.name, item.position) not in names:
            item = replace(item, points=0.0)
        read = task.written(item, written)
        if read.unreadable:
            judged[number] = _leave_ungraded(task, item, Verdict.UNREADABLE, read)
        elif written.is_blank:
            judged[number] = _leave_ungraded(task, item, Verdict.BLANK, written)
        else:
            found.setdefault(item.position, []).append((read, item))
            numbers[id(read)] = number
    diagnosis: list[Diagnosis] = []
    examined: list[ExaminedAnswer] = []
    for position, here in sorted(found.items()):
        scales = _scales(task, submission, here, position)
        sheet = task.sheet(position, scales, submission.ruler_mm, drawn=submission.drawn)
        ready: list[ExaminedAnswer] = []
        for written, item in here:
            try:
                ready.append(examine(task, sheet, item, written))
            except UnusableError:
                judged[numbers[id(written)]] = _leave_ungraded(
                    task, item, Verdict.UNREADABLE, written
                )
        if isinstance(sheet, CalculationSheet) and isinstance(task, Calculation):
            diagnosis += task.grade(sheet, ready)
        else:
            replay(task, sheet, ready)
            follow_routes(sheet, ready, task.settings.floor_share)
            assign_verdicts(sheet, ready, task.settings.near)
            diagnosis += diagnose(task, sheet, ready)
        for one in ready:
            number = numbers[id(one.written)]
            told = _grade_answer(task, sheet, one)
            # A drawing has no computed values: a segment that does not follow must be redrawn.
            again = told.miscomputed and not submission.drawn
            judged[number] = replace(told, written=submission.answers[number], miscomputed=again)
        examined += ready
    answers = [*_each_once(judged[number] for number in sorted(judged))]
    given = {(answer.key.id, answer.key.position) for answer in answers if answer.key}
    for item in asked:
        if (item.name, item.position) not in given:
            answers.append(_leave_ungraded(task, item, Verdict.BLANK, None))
            given.add((item.name, item.position))
    points = math.fsum(answer.points for answer in answers)
    whole = math.fsum(answer.of for answer in answers)
    return GradedSubmission(
        submission,
        task.variant,
        tuple(answers),
        tuple(diagnosis),
        round(points, 6),
        round(whole, 6),
        not submission.drawn and _is_suspicious(examined),
        strokes={
            (one.item.name, one.item.position): one.stroke
            for one in examined
            if one.stroke is not None and not submission.drawn
        },
    )


def _each_once(answers: Iterable[GradedAnswer]) -> Iterator[GradedAnswer]:
    """Yield the answers; an unreadable one does not count if there is a readable one."""
    told = list(answers)
    read = {
        (one.key.id, one.key.position)
        for one in told
        if one.key is not None and one.verdict is not Verdict.UNREADABLE
    }
    for one in told:
        if one.key is not None and one.verdict is Verdict.UNREADABLE:
            name = (one.key.id, one.key.position)
            one = replace(one, of=0.0) if name in read else one
            read.add(name)
        yield one


def unknown_variant(submission: Submission) -> GradedSubmission:
    """Return a submission of an unknown variant: none of its answers can be graded."""
    answers = tuple(
        GradedAnswer(written.id or written.what, Verdict.UNREADABLE, written=written)
        for written in submission.answers
    )
    return GradedSubmission(submission, submission.variant, answers)


def unmarked(
    submission: Submission, variant: str | None, failure: CheckFailure
) -> GradedSubmission:
    """Return a submission that is not marked, with the reason."""
    return GradedSubmission(submission, variant, (), failure=failure)


def failure_of(error: Exception) -> CheckFailure:
    """Return an internal error as the reason why a submission is not marked."""
    phrase = translate(
        "an internal error ({}: {})", type(error).__name__, visible(str(error))[:200]
    )
    trace = "".join(traceback.format_exception(error))
    return CheckFailure(str(phrase), trace.replace(f"{Path(__file__).parents[2]}{os.sep}", ""))


def _scales(
    task: Task,
    submission: Submission,
    here: Sequence[tuple[WrittenAnswer, TaskItem]],
    position: int,
) -> dict[str, float]:
    """Return the student's scales; a missing one is derived from a value and its millimetres."""
    scales = {name: mu for name, mu in submission.scales.items() if name in SCALED}
    if isinstance(task, Calculation):
        return scales
    given = task.solution.problem.scales
    for written, item in here:
        question = item.question
        if question.scale in scales or not question.scale or question.is_mm:
            continue
        if getattr(given, question.scale, None) is not None:
            continue
        plan = question.plan
        if plan and question.unit == FACTS[plan].unit and written.mm and written.value:
            scales[question.scale] = abs(written.value / written.mm)
    return scales


def _leave_ungraded(
    task: Task, item: TaskItem, verdict: Verdict, written: WrittenAnswer | None
) -> GradedAnswer:
    sheet = task.sheet(item.position)
    limit = limit_of(sheet, item.question, task.settings, item.fixed)
    return GradedAnswer(item.id, verdict, entry_of(task, item, limit), written, of=item.points)


def _grade_answer(task: Task, sheet: Sheet, one: ExaminedAnswer) -> GradedAnswer:
    item, settings = one.item, task.settings
    entry = replace(
        entry_of(task, item, one.limit),
        mm=sheet.length(item.question),  # on the student's plan
        per=item.per(sheet.scales),
    )
    share = earned_fraction(one, settings)
    return GradedAnswer(
        item.id,
        one.verdict,
        entry,
        one.written,
        one.value,
        one.limit.tolerance(one.step),
        one.source,
        one.local,
        one.local_tolerance,
        one.sense_right,
        one.slip,
        round(item.points * share, 6),
        item.points,
        miscomputed=one.miscomputed and one.verdict is Verdict.WRONG,
    )


def earned_fraction(one: ExaminedAnswer, settings: Settings) -> float:
    """Return the share of its points that an answer gets."""
    shares = {
        Verdict.OK: 1.0,
        Verdict.NEAR: settings.near_share,
        Verdict.INHERITED: settings.inherited_share,
        Verdict.INCONSISTENT: settings.inconsistent_share,
        Verdict.UNSEEN: settings.unseen_share,
    }
    asked = one.item.asks_sense and not one.limit.zero and one.value  # zero has no sense
    if one.verdict is Verdict.WRONG:
        # The sense is an answer of its own: wrong, it leaves the number its points.
        if one.sense_right is False and (one.right or one.follows):
            return 1.0 - settings.sense_share
        return 0.0
    share = shares[one.verdict]
    if asked and one.sense_right is None and one.written.sense is None and not one.signed:
        share -= settings.sense_share * share
    return share


def _is_suspicious(examined: Sequence[ExaminedAnswer]) -> bool:
    """Return whether answers are more accurate than any drawing by hand."""
    seen = [
        one
        for one in examined
        if one.limit.sigma > 0 and one.item.question.sign is not Sign.ANGLE and not one.limit.zero
    ]
    if len(seen) < 5:
        return False
    chance = 1.0
    for one in seen:
        off = max(one.off, one.step / 2)
        chance *= min(1.0, math.erf(off / one.limit.sigma / math.sqrt(2.0)))
    return bool(chance < MAX_ACCURACY_CHANCE ** (len(seen) / 2))
