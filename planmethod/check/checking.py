"""Checking of a submission and of a group: from answers to verdicts, diagnosis, points."""

from __future__ import annotations

import math
import os
import traceback
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from planmethod.arguments import of_type
from planmethod.check.calculation import Calculation, CalculationSheet, task_of_problem
from planmethod.check.diagnosis import diagnose
from planmethod.check.explain import Explanation, ExplanationFit
from planmethod.check.following import propagate_mistake
from planmethod.check.grading import ExaminedAnswer, UnusableError, assign_verdicts, examine, replay
from planmethod.check.key import Key, batch_tasks, entry_of, key_of_task
from planmethod.check.marks import DEFAULT, Settings
from planmethod.check.measured.drawing_questions import find_enlargements, list_drawing_items
from planmethod.check.model import (
    CheckFailure,
    Diagnosis,
    GradedAnswer,
    GradedSubmission,
    Submission,
    Verdict,
    WrittenAnswer,
)
from planmethod.check.pen_slips import find_pen_slip
from planmethod.check.questions import normalize
from planmethod.check.redrawing import redraw
from planmethod.check.routes import follow_lever, follow_routes
from planmethod.check.sheet import Sheet
from planmethod.check.task import Task, TaskItem
from planmethod.check.tolerance import limit_of
from planmethod.construct.drafting import PROFILES
from planmethod.errors import PlanMethodError
from planmethod.kind import ProblemKind
from planmethod.kinds import kind_of
from planmethod.languages import translate, visible
from planmethod.plans.model import FACTS
from planmethod.problem import variant_names
from planmethod.problem.quantities import Sign
from planmethod.problem.records import KindProblem
from planmethod.solved.quantity_steps import NoValueError

SCALED = {facts.scale for facts in FACTS.values() if facts.scale}

MANY_WRONG, FEW_WRONG = 3, 2
"""Answers wrong in themselves of a work that is another variant's, at least, and there, at most."""

SUSPICIOUS_ACCURACY_CHANCE = 1e-4
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
        scales = _scales(task, submission, here)
        sheet = task.sheet(position, scales, submission.ruler_mm, drawn=submission.drawn)
        stated, enlarged = sheet, find_enlargements(sheet, here) if submission.drawn else {}
        if enlarged:  # examined to the scale that it is drawn to
            scales |= {scale: sheet.scales[scale] / factor for scale, factor in enlarged.items()}
            sheet = task.sheet(position, scales, submission.ruler_mm, drawn=submission.drawn)
        ready: list[ExaminedAnswer] = []
        for written, item in here:
            try:
                ready.append(examine(task, sheet, item, written))
            except UnusableError:
                judged[numbers[id(written)]] = _leave_ungraded(
                    task, item, Verdict.UNREADABLE, written
                )
        judge_answers(task, sheet, ready)
        slip = find_pen_slip(task, sheet, ready, partial(judge_answers, task, sheet))
        ready = ready if slip is None else slip.answers
        if isinstance(sheet, CalculationSheet) and isinstance(task, Calculation):
            causes = task.diagnose(sheet, ready)
        else:
            causes = redraw(sheet, ready, diagnose(task, sheet, ready), task.settings)
            if (copied := _find_copied_work(task, sheet, ready)) is not None:
                causes = [propagate_mistake(task, sheet, ready, [copied])]
            causes = [*_state_scales(ready, enlarged), *causes]
        if slip is not None:
            causes, ready = [*slip.diagnoses(causes)], slip.as_written()
        diagnosis += causes
        for one in ready:
            number = numbers[id(one.written)]
            told = _grade_answer(task, stated, one)
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


def _find_copied_work(
    task: Task, sheet: Sheet, examined: list[ExaminedAnswer]
) -> ExplanationFit | None:
    """Return the variant as whose work the answers have few mistakes, where they have many here.

    So a copied work is found that has a mistake of its own.
    """
    left = _count_wrong(examined)
    if left < MANY_WRONG:
        return None
    best: tuple[int, str, Sheet] | None = None
    for variant, theirs in task.theirs(sheet):
        asked = {question.id: question for question in theirs.requested}
        items = (replace(one.item, question=asked[one.item.question.id]) for one in examined)
        there = [
            examine(task, theirs, item, one.written)
            for item, one in zip(items, examined, strict=True)
        ]
        judge_answers(task, theirs, there)
        if _count_wrong(there):
            redraw(theirs, there, diagnose(task, theirs, there), task.settings)
        wrong = _count_wrong(there)
        if wrong <= min(FEW_WRONG, left // 2) and (best is None or wrong < best[0]):
            best = wrong, variant, theirs
    if best is None:
        return None
    _, variant, theirs = best
    made = Explanation("P2", variant, theirs.exact_answers, theirs.exact_trace, theirs)
    return ExplanationFit(made, 0.0, 0.0, len(examined))


def _count_wrong(examined: Sequence[ExaminedAnswer]) -> int:
    return sum(one.verdict is Verdict.WRONG for one in examined)


def judge_answers(task: Task, sheet: Sheet, examined: list[ExaminedAnswer]) -> None:
    """Give the answers of a position their verdicts, also by the student's own numbers."""
    if isinstance(sheet, CalculationSheet) and isinstance(task, Calculation):
        task.replay(sheet, examined)
    else:
        replay(task, sheet, examined)
        follow_routes(sheet, examined, task.settings.floor_share)
        follow_lever(sheet, examined)
    assign_verdicts(sheet, examined, task.settings.near)


def _state_scales(
    examined: Sequence[ExaminedAnswer], enlarged: Mapping[str, float]
) -> Iterator[Diagnosis]:
    """Yield a mistake for each scale that is not the stated one; right answers follow from it.

    Plans that are enlarged alike have one mistake.
    """
    alike = len({round(math.log(factor), 2) for factor in enlarged.values()}) == 1
    groups = [[*enlarged]] if alike else [[scale] for scale in enlarged]
    for scales in groups:
        drawn = [one for one in examined if one.item.question.scale in scales and one.mm]
        right = [one for one in drawn if one.verdict is Verdict.OK and not one.limit.zero]
        for one in drawn:
            one.value *= enlarged[one.item.question.scale]
            if one.verdict in (Verdict.OK, Verdict.NEAR) and not one.limit.zero:
                one.verdict = Verdict.INHERITED
                one.source = right[0].item.id if right else ""
        if right:
            right[0].verdict, right[0].source = Verdict.WRONG, ""
            right[0].right, right[0].follows = False, None
            yield Diagnosis(("scale",), sure=True, roots=(right[0].item.id,), mistake_at=scales[0])


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
    return bool(chance < SUSPICIOUS_ACCURACY_CHANCE ** (len(seen) / 2))


FEW = 2
"""Number of variants up to which each is solved with its first submission."""

_UNKNOWN = "\n"
"""Stands for a variant that the file has not: no name has it."""


def key_of_problem(kind: ProblemKind[Any], problem: KindProblem, settings: Settings) -> Key:
    """Return the key of a problem."""
    return key_of_task(task_of_problem(kind, problem, settings))


class Variants:
    """Variants of a problem file, each solved when it is first needed.

    Parameters
    ----------
    path : Path
    settings : Settings
    default : str, optional
        Variant of the submissions that name none.
    """

    def __init__(
        self, path: Path, settings: Settings = DEFAULT, default: str | None = None
    ) -> None:
        path = Path(of_type("path", path, str | Path))
        self.path, self.settings, self.default = path, settings, default
        self.names: tuple[str, ...] = tuple(variant_names(path))
        self._tasks: dict[str | None, Task] = {}
        self._forms = {normalize(name): name for name in self.names}

    def task(self, name: str | None) -> Task:
        """Return the task of a variant, or of the file itself.

        Raises
        ------
        PlanMethodError
            When the problem cannot be solved.
        """
        if name not in self._tasks:
            kind = kind_of(self.path)
            problem = kind.decided(kind.load(self.path, name))
            self._tasks[name] = task_of_problem(kind, problem, self.settings, self._all)
        return self._tasks[name]

    def solve_in_batch(self, names: Iterable[str | None]) -> None:
        """Solve several variants in one batch, if their plans and requested items are the same."""
        kind, problems = kind_of(self.path), []
        for name in dict.fromkeys(names):
            if name not in self._tasks:
                with suppress(PlanMethodError):  # it says why when it is needed
                    problems.append(kind.load(self.path, name))
        with suppress(Exception):  # then each is solved alone; faults go to its submissions
            for batch, _ in kind.batches(problems, PROFILES["board"]):
                for task in batch_tasks(batch, self.settings, self._all):
                    self._tasks[task.variant] = task

    def _all(self) -> Iterator[Task]:
        for name in self.names or (None,):
            yield self.task(name)

    def name_of(self, submission: Submission) -> str | None:
        """Return the variant of a submission; None for the file itself.

        Raises
        ------
        KeyError
            When the file has no such variant.
        """
        if not submission.variant:
            return self.default
        if submission.variant in self.names:
            return submission.variant
        if not self.names:
            return None
        return self._forms[normalize(submission.variant)]


def check_works(variants: Variants, works: Sequence[Submission]) -> Iterator[GradedSubmission]:
    """Yield the submissions, each checked by its own variant, independently of the others.

    One that fails, or whose variant cannot be solved, is not marked; `failure` gives the reason.

    Examples
    --------
    >>> from pathlib import Path
    >>> from planmethod.check.submissions import read_works
    >>> variants = Variants(Path("problems/linkages/ex3-variants.toml"))
    >>> works = read_works(Path("problems/groups/ex3.csv"))
    >>> for one in check_works(variants, works[:3]):
    ...     print(f"{one.work.student}: {one.points:g} of {one.of:g}")
    Абрамова Дарья: 19 of 19
    Белов Никита: 17.7 of 19
    Васильев Олег: 19 of 19
    """
    of_type("variants", variants, Variants)
    for work in of_type("works", works, Sequence, "read_works()"):
        of_type("works", work, Submission, "read_works()")
    named = [_named(variants, work) for work in works]
    if len(set(named)) > FEW:
        variants.solve_in_batch(name for name in named if name is not _UNKNOWN)
    for work, name in zip(works, named, strict=True):
        yield unknown_variant(work) if name is _UNKNOWN else _grade(variants, work, name)


def _grade(variants: Variants, submission: Submission, name: str | None) -> GradedSubmission:
    """Check a submission; a fault in it, or in its variant, does not affect others."""
    if submission.failure:
        return unmarked(submission, name, CheckFailure(submission.failure.rstrip(".")))
    try:
        return check(variants.task(name), submission)
    except PlanMethodError as error:
        return unmarked(submission, name, CheckFailure(str(error).rstrip(".")))
    except MemoryError:
        raise
    except Exception as error:  # an internal error: the others are still graded
        return unmarked(submission, name, failure_of(error))


def _named(variants: Variants, submission: Submission) -> str | None:
    try:
        return variants.name_of(submission)
    except KeyError:
        return _UNKNOWN


def keys_of(variants: Variants, checked: Sequence[GradedSubmission]) -> dict[str | None, Key]:
    """Return the keys of the submissions' variants, for all quantities that they answer."""
    found: dict[str | None, Key] = {}
    names = dict.fromkeys(work.variant for work in checked)
    for name in (name for name in names if name is None or name in variants.names):
        try:
            task = variants.task(name).copy_for_submission()
        except PlanMethodError:
            continue  # said of its works
        items = {(item.id, item.position): item for item in task.usual()}
        for one in checked:
            if one.variant != name:
                continue
            for judged in one.answers:
                if judged.key is not None and judged.written is not None:
                    item = task.find(judged.written)
                    items.setdefault(
                        (item.name, item.position), replace(item, id=item.name, points=0.0)
                    )
        for asked in (tuple(items.values()), task.usual()):
            with suppress(Exception):  # extra answers must not block any page
                found[name] = key_of_task(task, asked)
                break
    return found
