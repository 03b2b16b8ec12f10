"""Simulated drawn submissions, faultless or with a planted mistake (начерченные работы).

Every stroke errs as the profile of the settings says, lengths are read off a ruler, and whatever is
written is rounded before further use, as by a student. The same seed draws the same submissions.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
import numpy.typing as npt
from msgspec.structs import replace

from planmethod.check.following import read_in_place
from planmethod.check.key import SEGMENT_CODES
from planmethod.check.mistakes import changes
from planmethod.check.mistakes.plans import Change, MistakeContext, times
from planmethod.check.mistakes.scales import scale_by
from planmethod.check.model import Sense, Submission, WrittenAnswer
from planmethod.check.sheet import DIRECTIONS, Sheet
from planmethod.check.task import Task, TaskItem
from planmethod.construct.arithmetic import Number
from planmethod.construct.drafting import Sampled
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.steps import Name, NumberName
from planmethod.plans.model import MOTION
from planmethod.problem.quantities import Sign

DIGITS = 3
"""Significant digits of a written value; one more after a leading 1, as on a slide rule."""

WRONG_SCALE = 1.25
"""A plan drawn to another scale than it is read by: 1:4 for 1:5."""

Row = npt.NDArray[np.float64]


def simulate_submissions(
    task: Task,
    change: Change | None = None,
    count: int = 1,
    seed: int = 0,
    *,
    scales: Mapping[str, float] | None = None,
    mm: bool = False,
) -> list[Submission]:
    """Draw submissions with the requested items of the first position.

    Parameters
    ----------
    task : Task
    change : Change, optional
        Mistake that all of them have. Default: none.
    count, seed : int
    scales : mapping of str to float, optional
        The student's own.
    mm : bool
        Whether lengths on the plan are written next to the values.

    Returns
    -------
    list of Work
        Without those that cannot be drawn to the end.
    """
    chosen = [item for item in task.usual() if item.position == task.usual()[0].position]
    sheet = task.sheet(chosen[0].position, scales)
    rounded = {item.question.name for item in chosen if not item.question.is_mm}

    def round_written(name: Name, value: Number) -> Number:
        return as_written(value)[0] if name in rounded else value

    program = sheet.program if change is None else change.program(sheet.program)
    data = {**sheet.data, **(change.data if change is not None else {})}
    trace = evaluate(program, data, Sampled(sheet.profile, sheet.free, count, seed), round_written)
    columns = [_column(sheet, item, trace, count, mm=mm) for item in chosen]
    works = zip(*columns, strict=True)
    return [
        Submission(f"{number:02d}", answers, task.variant, dict(scales or {}))
        for number, answers in enumerate(works, 1)
        if all(math.isfinite(answer.value or 0.0) for answer in answers)
    ]


def as_written(values: Number) -> tuple[Row, Row]:
    """Return values as they are written down, and the units of their last digits."""
    exact = np.asarray(values, dtype=float)
    size = np.where((exact == 0) | ~np.isfinite(exact), 1.0, np.abs(exact))
    step = 10.0 ** (np.floor(np.log10(size / 2)) + 1 - DIGITS)
    return np.round(exact / step) * step, step


def _column(
    sheet: Sheet, item: TaskItem, trace: Trace, count: int, *, mm: bool
) -> list[WrittenAnswer]:
    """Return the answers of all submissions to one question."""
    question = item.question

    def row(number: Number) -> list[float]:
        return np.broadcast_to(np.asarray(number, dtype=float), (count,)).tolist()  # type: ignore[no-any-return]

    taken, steps = (row(number) for number in as_written(question.evaluate(trace)))
    read = None
    if question.length is not None and (mm or question.is_mm):
        read = row(abs(trace.value[question.length]))
    ways = _stated_senses(item, trace, count)
    places = max(1, math.ceil(-math.log10(sheet.profile.ruler)))
    answers = []
    for number, (value, step) in enumerate(zip(taken, steps, strict=True)):
        told = WrittenAnswer(id=item.id, location=item.id, sense=ways[number])
        if read is not None:
            told = replace(told, mm=round(read[number], places), mm_step=10.0**-places)
        if not question.is_mm:
            size = abs(value) if question.sign is Sign.SIZE or ways[number] else value
            text = f"{size + 0.0:.{max(0, -round(math.log10(step)))}f}"
            told = replace(told, value=float(text), step=step, raw=text)
        answers.append(told)
    return answers


def _stated_senses(item: TaskItem, trace: Trace, count: int) -> list[Sense | None]:
    """Return the stated senses; None where none is requested."""
    question = item.question
    if not item.asks_sense:
        return [None] * count
    if question.sign is Sign.TURN and question.unit != "N":
        turns = np.broadcast_to(np.asarray(question.evaluate(trace), dtype=float), (count,))
        return [(Sense.CCW if turn > 0 else Sense.CW) if turn else None for turn in turns]
    if question.ends is None:
        return [None] * count
    tail, head = (trace.value[end] for end in question.ends)
    vectors = np.broadcast_to(np.asarray(head - tail) * question.direction_sign, (count,))
    return [
        max(DIRECTIONS, key=lambda way: (v * DIRECTIONS[way].conjugate()).real) for v in vectors
    ]


# Mistakes to plant ---------------------------------------------------------------------------


def planted(sheet: Sheet, items: Sequence[TaskItem]) -> Iterator[Change]:
    """Yield every mistake that a sheet's submission can have: of the plans, and in one number."""
    scene = MistakeContext(sheet)
    yield from changes(scene)
    for plan in MOTION[1:]:
        made = scale_by(scene, plan, WRONG_SCALE)
        if made.steps:
            yield made
    for item in items:
        yield from _in_one_number(scene, item)


def _in_one_number(scene: MistakeContext, item: TaskItem) -> Iterator[Change]:
    """Yield a decimal place lost, millimetres for metres, another segment of the plan read."""
    question, sheet = item.question, scene.sheet
    step = scene.compute(question.name)
    if step is None or not scene.exact_value(step.out):
        return
    yield Change("S4", item.id, {step.out: times(step, 10.0)})
    yield Change("S2", item.id, {step.out: times(step, 1000.0)})
    length, plan = question.length, question.plan
    if plan not in SEGMENT_CODES or (length, 1) not in step.powers:
        return
    for segment in sheet.questions.construction.segments:
        other = NumberName(segment.length)
        if segment.kind is not plan or other == length or other not in sheet.order:
            continue
        if sheet.order[other] < sheet.order[step.out] and scene.exact_value(other):
            made = read_in_place(sheet, step, length, other)
            yield Change(SEGMENT_CODES[plan], item.id, {step.out: (made,)})
