"""Works that are written as the plans have them, with a mistake planted or without one."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import cache

from doors import (
    Explanation,
    GradedSubmission,
    Sense,
    Sign,
    Solution,
    Submission,
    Task,
    Verdict,
    WrittenAnswer,
    check,
)
from loaded import loaded_problem
from worked import problem_of


@cache
def task_of(name: str) -> Task:
    """Return the task of a file, or of a random mechanism with loads: ``random-7``."""
    if name.startswith("random-"):
        problem, _ = loaded_problem(int(name.removeprefix("random-")))
        return Task(Solution(problem))
    return Task(Solution(problem_of(name)))


def work_of(task: Task, values: Mapping[str, float], *, digits: int = 4) -> Submission:
    """Return a submission with certain values, rounded to some digits."""
    return Submission("s", tuple(_written(task, values, digits)))


def _written(task: Task, values: Mapping[str, float], digits: int) -> Iterator[WrittenAnswer]:
    for item in task.usual():
        value = float(f"{values[item.question.id]:.{digits}g}")
        sense = None
        if item.question.sign is Sign.TURN and item.question.unit != "N":
            sense = Sense.CCW if value > 0 else Sense.CW
        value = value if item.question.sign is Sign.STRICT else abs(value)
        step = 10.0 ** (math.floor(math.log10(value)) + 1 - digits) if value else 0.01
        yield WrittenAnswer(id=item.id, value=value, step=step, sense=sense, location=item.id)


def explanations(task: Task) -> list[Explanation]:
    """Return every mistake at every place of a task, in its first position."""
    task.usual()
    return task.explanations(task.sheet(0)).named


def exact(task: Task) -> Mapping[str, float]:
    """Return the exact answers of a task."""
    task.usual()
    return task.sheet(0).exact_answers


def verdicts(checked: GradedSubmission) -> dict[str, Verdict]:
    return {answer.id: answer.verdict for answer in checked.answers}


def checked(name: str, **values: float) -> GradedSubmission:
    """Return the check of a work that answers some quantities of a file."""
    task = task_of(name)
    answers = tuple(
        WrittenAnswer(id=key, value=value, step=abs(value) * 1e-3, location=key)
        for key, value in values.items()
    )
    return check(task, Submission("s", answers))
