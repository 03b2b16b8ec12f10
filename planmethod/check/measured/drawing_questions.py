"""Questions that a drawing answers: the segments of plans, each by its length and direction."""

from __future__ import annotations

from msgspec.structs import replace

from planmethod.check.questions import Question
from planmethod.check.sheet import Sheet
from planmethod.check.task import Task, TaskItem
from planmethod.plans.model import RATES
from planmethod.problem.quantities import Sign

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
