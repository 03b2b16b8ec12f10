"""Questions that a drawing answers: the segments of plans, each by its length and direction."""

from __future__ import annotations

import statistics
from collections.abc import Iterable, Sequence

from msgspec.structs import replace

from planmethod.check.model import WrittenAnswer
from planmethod.check.questions import Question
from planmethod.check.sheet import Sheet
from planmethod.check.task import Task, TaskItem
from planmethod.plans.model import FACTS, RATES, PlanKind
from planmethod.problem.quantities import Sign

SAME_FACTOR = 0.01
"""Maximum relative difference of the enlargements of segments that agree."""

MIN_FACTOR = 0.02
"""Relative difference of scales from which a plan is enlarged, and not drawn inexactly."""

MIN_SEGMENTS, MAJORITY = 3, 0.6
"""Minimum number and share of the segments that are enlarged alike: the others may be wrong."""

LONG_MM = 5.0
"""Minimum length of a segment that shows the enlargement of its plan."""

SHORT_MM = 1.0
"""A vector not longer than this has no visible direction."""


def list_drawing_items(task: Task) -> tuple[TaskItem, ...]:
    """Return the items of a task that the plans of one position show.

    The direction of a vector is a separate answer; computed ω and ε are not on a drawing.
    """
    found: dict[str, TaskItem] = {}
    share, questions = task.settings.sense_share, task.questions(task.first)
    shown = [
        item
        for item in task.usual()
        if item.position == task.first
        and item.question.plan in RATES
        and item.question.ends is not None
    ]
    sheet = task.sheet(task.first, drawn="cad")
    for item in shown:
        question = item.question
        if abs(sheet.vector(question) or 0j) < SHORT_MM:
            found.setdefault(item.name, replace(item, asks_sense=False))
            continue
        length = replace(item, points=item.points * (1.0 - share), asks_sense=False)
        found.setdefault(item.name, length)
        found[f"angle_{item.name}"] = TaskItem(
            f"angle_{item.id}",
            task.request(questions.direction(question), item.position),
            item.position,
            item.points * share,
            label=f"α({item.label})" if item.label else "",
            name=f"angle_{item.name}",
        )
    return tuple(found.values())


def vector_of(sheet: Sheet, question: Question) -> Question:
    """Return the vector that an answer is the length or the direction of."""
    return sheet.questions.question(question.key) if question.sign is Sign.ANGLE else question


def find_enlargements(
    sheet: Sheet, answers: Iterable[tuple[WrittenAnswer, TaskItem]]
) -> dict[str, float]:
    """Return by which factor plans are drawn larger than to their stated scales.

    Accelerations enlarged by the square of the velocities are not meant: the speed is wrong then.
    """
    segments: dict[str, list[float]] = {}
    for written, item in answers:
        exact = sheet.length(item.question)
        if written.mm is not None and exact is not None and min(written.mm, exact) > LONG_MM:
            segments.setdefault(item.question.scale, []).append(written.mm / exact)
    whole = _common([factor for own in segments.values() for factor in own])
    if all(abs(statistics.median(own) / whole - 1.0) < SAME_FACTOR for own in segments.values()):
        return {} if whole == 1.0 else dict.fromkeys(segments, whole)
    found = {scale: factor for scale, own in segments.items() if (factor := _common(own)) != 1.0}
    v, a = (found.get(FACTS[kind].scale) for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION))
    return {} if v and a and abs(a / v**2 - 1.0) < MIN_FACTOR else found


def _common(factors: Sequence[float]) -> float:
    """Return the factor that most segments have; 1 if they do not agree, or are right."""
    middle = statistics.median(factors) if factors else 1.0
    same = sum(abs(one / middle - 1.0) < SAME_FACTOR for one in factors)
    agreed = same >= max(MIN_SEGMENTS, MAJORITY * len(factors))
    return middle if agreed and abs(middle - 1.0) > MIN_FACTOR else 1.0
