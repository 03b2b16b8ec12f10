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
from planmethod.check.judge import Examined, UnusableError, decide, examine, replay
from planmethod.check.key import entry_of
from planmethod.check.marks import Settings
from planmethod.check.measured.asked import asked_of_drawing
from planmethod.check.model import (
    CheckedWork,
    CheckFailure,
    Diagnosis,
    Judged,
    Verdict,
    Work,
    WrittenAnswer,
)
from planmethod.check.questions import Sign
from planmethod.check.routes import follow_routes
from planmethod.check.sheet import Sheet
from planmethod.check.task import Task, TaskItem
from planmethod.check.tolerance import limit_of
from planmethod.languages import say, visible
from planmethod.plans.model import FACTS
from planmethod.solved.selectors.steps import NoValueError

SCALED = {facts.scale for facts in FACTS.values() if facts.scale}

TOO_NEAR = 1e-4
"""Chance of such accurate answers by hand, below which they are suspicious."""


def check(task: Task, work: Work) -> CheckedWork:
    """Grade a submission: a pure function of the task and the written answers.

    Answers that were not requested are graded, but do not affect the points.
    """
    task = task.for_one_work()
    asked = asked_of_drawing(task) if work.drawn else task.usual()
    measured = {item.name: item for item in asked} if work.drawn else {}
    names = {(item.name, item.position) for item in asked}
    found: dict[int, list[tuple[WrittenAnswer, TaskItem]]] = {}
    numbers: dict[int, int] = {}
    judged: dict[int, Judged] = {}
    for number, written in enumerate(work.answers):
        name = written.id or written.what
        try:
            item = measured.get(written.id) or task.find(written)
        except NoValueError:
            judged[number] = Judged(name, Verdict.UNREADABLE, written=written)
            continue
        if (item.name, item.position) not in names:
            item = replace(item, points=0.0)
        read = task.written(item, written)
        if read.unreadable:
            judged[number] = _unjudged(task, item, Verdict.UNREADABLE, read)
        elif written.is_blank:
            judged[number] = _unjudged(task, item, Verdict.BLANK, written)
        else:
            found.setdefault(item.position, []).append((read, item))
            numbers[id(read)] = number
    diagnosis: list[Diagnosis] = []
    examined: list[Examined] = []
    for position, here in sorted(found.items()):
        scales = _scales(task, work, here, position)
        sheet = task.sheet(position, scales, work.ruler_mm, drawn=work.drawn)
        ready: list[Examined] = []
        for written, item in here:
            try:
                ready.append(examine(task, sheet, item, written))
            except UnusableError:
                judged[numbers[id(written)]] = _unjudged(task, item, Verdict.UNREADABLE, written)
        if isinstance(sheet, CalculationSheet) and isinstance(task, Calculation):
            diagnosis += task.judge(sheet, ready)
        else:
            replay(task, sheet, ready)
            follow_routes(sheet, ready, task.settings.floor_share)
            decide(sheet, ready, task.settings.near)
            diagnosis += diagnose(task, sheet, ready)
        for one in ready:
            number = numbers[id(one.written)]
            told = _judged(task, sheet, one)
            # A drawing has no computed values: a segment that does not follow must be redrawn.
            again = told.miscomputed and not work.drawn
            judged[number] = replace(told, written=work.answers[number], miscomputed=again)
        examined += ready
    answers = [*_each_once(judged[number] for number in sorted(judged))]
    given = {(answer.key.id, answer.key.position) for answer in answers if answer.key}
    for item in asked:
        if (item.name, item.position) not in given:
            answers.append(_unjudged(task, item, Verdict.BLANK, None))
            given.add((item.name, item.position))
    points = math.fsum(answer.points for answer in answers)
    whole = math.fsum(answer.of for answer in answers)
    return CheckedWork(
        work,
        task.variant,
        tuple(answers),
        tuple(diagnosis),
        round(points, 6),
        round(whole, 6),
        not work.drawn and _suspicious(examined),
        strokes={
            (one.item.name, one.item.position): one.stroke
            for one in examined
            if one.stroke is not None and not work.drawn
        },
    )


def _each_once(answers: Iterable[Judged]) -> Iterator[Judged]:
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


def unknown_variant(work: Work) -> CheckedWork:
    """Return a submission of an unknown variant: none of its answers can be graded."""
    answers = tuple(
        Judged(written.id or written.what, Verdict.UNREADABLE, written=written)
        for written in work.answers
    )
    return CheckedWork(work, work.variant, answers)


def unmarked(work: Work, variant: str | None, failure: CheckFailure) -> CheckedWork:
    """Return a submission that is not marked, with the reason."""
    return CheckedWork(work, variant, (), failure=failure)


def failure_of(error: Exception) -> CheckFailure:
    """Return an internal error as the reason why a submission is not marked."""
    said = say("an internal error ({}: {})", type(error).__name__, visible(str(error))[:200])
    trace = "".join(traceback.format_exception(error))
    return CheckFailure(str(said), trace.replace(f"{Path(__file__).parents[2]}{os.sep}", ""))


def _scales(
    task: Task, work: Work, here: Sequence[tuple[WrittenAnswer, TaskItem]], position: int
) -> dict[str, float]:
    """Return the student's scales; a missing one is derived from a value and its millimetres."""
    scales = {name: mu for name, mu in work.scales.items() if name in SCALED}
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


def _unjudged(
    task: Task, item: TaskItem, verdict: Verdict, written: WrittenAnswer | None
) -> Judged:
    sheet = task.sheet(item.position)
    limit = limit_of(sheet, item.question, task.settings, item.fixed)
    return Judged(item.id, verdict, entry_of(task, item, limit), written, of=item.points)


def _judged(task: Task, sheet: Sheet, one: Examined) -> Judged:
    item, settings = one.item, task.settings
    entry = replace(
        entry_of(task, item, one.limit),
        mm=sheet.length(item.question),  # on the student's plan
        per=item.per(sheet.scales),
    )
    share = share_of(one, settings)
    return Judged(
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


def share_of(one: Examined, settings: Settings) -> float:
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


def _suspicious(found: Sequence[Examined]) -> bool:
    """Return whether answers are more accurate than any drawing by hand."""
    seen = [
        one
        for one in found
        if one.limit.sigma > 0 and one.item.question.sign is not Sign.ANGLE and not one.limit.zero
    ]
    if len(seen) < 5:
        return False
    chance = 1.0
    for one in seen:
        off = max(one.off, one.step / 2)
        chance *= min(1.0, math.erf(off / one.limit.sigma / math.sqrt(2.0)))
    return bool(chance < TOO_NEAR ** (len(seen) / 2))
