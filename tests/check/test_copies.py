"""Copied works among independent ones, drawn by a simulator that shares nothing with the checking.

Every point of a plan is drawn a little off, lengths are read off a ruler and values are rounded.
"""

from __future__ import annotations

import itertools
import random
from decimal import Decimal
from pathlib import Path
from typing import NamedTuple

import pytest
from cases import some
from doors import (
    GradedSubmission,
    QuantityKind,
    Question,
    Submission,
    Task,
    Variants,
    WrittenAnswer,
    check,
    list_readings,
    mark_similar_submissions,
    single_point,
)
from msgspec.structs import replace

PROBLEMS = ("linkages/ex3", "levers/task12", "linkages/2.1.121")
DRAWN = (
    QuantityKind.VELOCITY,
    QuantityKind.SLIDING,
    QuantityKind.ACCELERATION,
    QuantityKind.TANGENTIAL,
)
COUNT = some(40, 18)


class Pencil(NamedTuple):
    """How a student draws and reads, mm, and rounds."""

    point: float
    eye: float
    ruler: float
    digits: int

    @classmethod
    def random(cls, rng: random.Random) -> Pencil:
        return cls(
            rng.uniform(0.3, 0.6),
            rng.uniform(0.05, 0.15),
            rng.choice((0.5, 1.0)),
            rng.choice((3, 4)),
        )


def rounded(value: float, digits: int) -> str:
    return f"{Decimal(f'{value:.{digits - 1}e}'):f}"


def answer(question: Question, text: str) -> WrittenAnswer:
    step = float(Decimal(1).scaleb(int(Decimal(text).as_tuple().exponent)))
    return WrittenAnswer(id=question.id, value=float(text), step=step, raw=text)


def drawn(task: Task, student: str, rng: random.Random) -> Submission:
    """A work: each point of its plans has an error of its own, each length is read once.

    Errors of 0.3 to 0.6 mm are those of points that are constructed from others. Works of
    0.1 to 0.3 mm, read to a whole millimetre, are equal by chance in 1.5 % of all pairs.
    """
    items = task.usual()
    sheet, pencil, answers = task.sheet(task.first), Pencil.random(rng), []
    places = sheet.exact_trace.value
    off: dict[object, complex] = {}
    for item in items:
        question = item.question
        if item.position != task.first or question.key.kind not in DRAWN or question.ends is None:
            continue
        if not {*question.ends} <= places.keys():
            continue
        ends = []
        for end in question.ends:
            off.setdefault(end, complex(rng.gauss(0, pencil.point), rng.gauss(0, pencil.point)))
            ends.append(single_point(places[end]) + off[end])
        mm = abs(ends[1] - ends[0]) + rng.gauss(0, pencil.eye)
        mm = round(mm / pencil.ruler) * pencil.ruler
        value = mm * sheet.scales[question.scale]
        if value > 0:
            answers.append(answer(question, rounded(value, pencil.digits)))
    return Submission(student, tuple(answers), task.variant)


def spoilt(work: Submission, rng: random.Random) -> Submission:
    """A copy in which half of the numbers have another last digit."""
    answers = []
    for one in work.answers:
        step = Decimal(1).scaleb(int(Decimal(one.raw).as_tuple().exponent))
        other = Decimal(one.raw) + step * rng.choice((-2, -1, 1, 2))
        changed = rng.random() < 0.5 and other > 0
        answers.append(replace(one, value=float(other), raw=str(other)) if changed else one)
    return replace(work, student="spoilt", answers=tuple(answers))


def group_of(problem: str, seed: int) -> tuple[Task, list[GradedSubmission]]:
    variants = Variants(Path("problems") / f"{problem}.toml")
    task = variants.task(variants.names[0] if variants.names else None)
    rng = random.Random(f"{problem} {seed}")
    return task, [check(task, drawn(task, f"{n}", rng)) for n in range(COUNT)]


def is_found(group: list[GradedSubmission], source: GradedSubmission, copy: Submission) -> bool:
    """Whether a copy among the works of a group is called alike with its source."""
    judged = replace(source, work=copy)
    found = mark_similar_submissions([*group, judged])
    return source.work.student in found[-1].similar_students


@pytest.mark.dear
def test_verbatim_copies_are_found_and_honest_pairs_are_not() -> None:
    pairs = alike = copies = found = changed = seen = 0
    for problem in PROBLEMS:
        task, group = group_of(problem, 1)
        rng = random.Random(problem)
        pairs += len(list(itertools.combinations(group, 2)))
        alike += sum(len(one.similar_students) for one in mark_similar_submissions(group)) // 2
        for source in group:
            copies += 1
            found += is_found(group, source, replace(source.work, student="copy"))
        for source in group[:: max(1, COUNT // 10)]:
            other = check(task, spoilt(source.work, rng))
            changed += 1
            marked = mark_similar_submissions([*group, other])
            seen += source.work.student in marked[-1].similar_students
    print(f"honest {alike} of {pairs}, verbatim {found} of {copies}, spoilt {seen} of {changed}")
    assert alike <= 0.001 * pairs
    assert found >= 0.99 * copies


def test_few_equal_readings_prove_nothing() -> None:
    _, group = group_of("linkages/2.1.28", 1)
    source = group[0]
    assert len(list_readings(source)) == 5
    assert not is_found(group, source, replace(source.work, student="copy"))


def test_works_calculated_exactly_are_not_copies_of_each_other() -> None:
    """Their numbers are equal because they are right; a mistake that is named may be shared."""
    task = Variants(Path("problems/linkages/ex3.toml")).task(None)
    sheet = task.sheet(task.first)
    made = next(one for one in task.named(sheet) if one.code == "A2")
    for values in (sheet.exact_answers, made.values):
        for digits in (3, 4):
            answers = tuple(
                answer(item.question, rounded(abs(values[item.question.id]), digits))
                for item in task.usual()
                if item.position == task.first
            )
            works = [check(task, Submission(name, answers)) for name in ("one", "two")]
            found = mark_similar_submissions(works)
            assert not any(work.similar_students for work in found), digits


def test_a_copy_of_some_answers_only_is_no_verbatim_copy() -> None:
    task, group = group_of("linkages/ex3", 2)
    source = group[0]
    few = replace(source.work, student="few", answers=source.work.answers[:3])
    assert not mark_similar_submissions([source, check(task, few)])[0].similar_students
    most = replace(source.work, student="most", answers=source.work.answers[1:])
    assert mark_similar_submissions([source, check(task, most)])[0].similar_students == ("most",)
