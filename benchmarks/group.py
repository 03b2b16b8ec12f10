"""A realistic group of thirty submissions with planted mistakes: problems/groups/ex3.csv.

Run ``python -m benchmarks.group`` (``make group``) to write it. The names are invented.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from msgspec.structs import replace

from planmethod.bench.fairness import places_of
from planmethod.check.checking import Variants
from planmethod.check.key import key_of_task
from planmethod.check.mistakes.plans import Change
from planmethod.check.model import Sense, Submission, WrittenAnswer
from planmethod.check.simulation import simulate_submissions
from planmethod.check.task import Task

PROBLEM = Path("problems/linkages/ex3-variants.toml")
TARGET = Path("problems/groups/ex3.csv")

HEAD = ("Студент", "Вариант", "Величина", "Значение", "Единица", "мм", "Направление")
UNITS = {"m/s": "м/с", "m/s²": "м/с²", "1/s": "1/с", "1/s²": "1/с²"}
ARROWS = {Sense.CCW: "↺", Sense.CW: "↻"}
WORDS = {Sense.CCW: "против ч.с.", Sense.CW: "по часовой"}
BLANKS = ("", "—", "нет")


@dataclass(frozen=True, slots=True)
class Student:
    """A student and the planted mistakes of the submission (студент).

    Attributes
    ----------
    code : str
        Mistake that the student makes; empty for an honest one; ``P2`` for another variant,
        ``slip`` for a wrong multiplication.
    place : int
        Index of the place where the mistake shows.
    scales : mapping of str to float
        The student's own scales.
    mm : bool
        Whether the student writes the lengths of segments of the plan.
    skips : tuple of str
        Answers left blank.
    says : mapping of str to str
        Values written in the student's own form.
    """

    name: str
    variant: str
    code: str = ""
    place: int = 0
    scales: Mapping[str, float] = field(default_factory=dict)
    mm: bool = False
    skips: tuple[str, ...] = ()
    says: Mapping[str, str] = field(default_factory=dict)


FINE = {"mu_v": 0.04, "mu_a": 0.8}
GROUP = (
    Student("Абрамова Дарья", "1", mm=True),
    Student("Белов Никита", "2", "A1", mm=True),
    Student("Васильев Олег", "3"),
    Student("Галкина Вера", "4", "A2"),
    Student("Дроздов Илья", "1", "A3", mm=True),
    Student("Егорова Анна", "2", scales=FINE, mm=True),
    Student("Жуков Пётр", "3", "V2"),
    Student("Зайцева Ольга", "4", mm=True),
    Student("Ильин Максим", "1", "N1"),
    Student("Козлова Мария", "2", skips=("a_E", "epsilon_4")),
    Student("Лебедев Артём", "3", "N2", mm=True),
    Student("Морозова Юлия", "4", "A5", scales=FINE, mm=True),
    Student("Никитин Глеб", "1", "sign"),
    Student("Орлова Софья", "2", mm=True),
    Student("Павлов Егор", "3", "E2"),
    Student("Романова Алина", "4", "V4", mm=True),
    Student("Соколов Денис", "1", "S4"),
    Student("Тихонова Ева", "2", says={"a_B": "1,3·10^2"}),
    Student("Уваров Степан", "3", "P2"),
    Student("Фёдорова Лидия", "4", "V5"),
    Student("Харитонов Марк", "1", "P1", mm=True),
    Student("Цветкова Нина", "2", "slip", mm=True),
    Student("Чернов Тимур", "3", says={"omega_3": "13–14"}),
    Student("Шубина Кира", "4", "N5"),
    Student("Щукин Роман", "1", "V1"),
    Student("Юдин Павел", "2", "true_mm"),
    Student("Яковлева Инна", "3", mm=True, skips=("at_E_D",)),
    Student("Анисимов Лев", "4", "S2"),
    Student("Борисова Зоя", "1", scales=FINE, mm=True),
    Student("Воронин Яков", "2", "scale"),
)


def works(problem: Path = PROBLEM) -> Iterator[tuple[Student, Submission]]:
    """Yield the students with their works."""
    variants = Variants(problem)
    for number, student in enumerate(GROUP):
        task = variants.task(student.variant)
        if student.code == "P2":
            task = next(task.other_variants())
        change = _change(task, student)
        (work,) = simulate_submissions(
            task, change, 1, number, scales=student.scales, mm=student.mm
        )
        answers = tuple(_slipped(a) if student.code == "slip" else a for a in work.answers)
        yield student, replace(work, student=student.name, answers=answers)


def _change(task: Task, student: Student) -> Change | None:
    if student.code in ("", "P2", "slip"):
        return None
    made = [c for c in places_of(task, key_of_task(task)) if c.code == student.code]
    return made[student.place]


def _slipped(answer: WrittenAnswer) -> WrittenAnswer:
    """Return an answer; of one, the value with two digits swapped."""
    if answer.id != "v_E" or answer.value is None:
        return answer
    whole, _, part = answer.raw.partition(".")
    raw = f"{part[0]}.{whole}{part[1:]}"
    return replace(answer, value=float(raw), raw=raw)


def rows(problem: Path = PROBLEM) -> Iterator[tuple[str, ...]]:
    """Yield the rows of the table."""
    variants = Variants(problem)
    for number, (student, work) in enumerate(works(problem)):
        who = (student.name, student.variant)
        items = {item.id: item for item in variants.task(student.variant).declared}
        for name, scale in student.scales.items():
            yield (*who, name, _comma(f"{scale:g}"), "", "", "")
        for answer in work.answers:
            item = items[answer.id]
            mm = "" if answer.mm is None else _comma(f"{answer.mm:g}")
            told = (_comma(answer.raw), UNITS[item.question.unit], mm, _sense(number, answer))
            if answer.id in student.skips:
                told = (BLANKS[number % len(BLANKS)], "", "", "")
            value = student.says.get(answer.id, told[0])
            yield (*who, item.label or item.id, value, *told[1:])


def _comma(number: str) -> str:
    return number.replace(".", ",")


def _sense(number: int, answer: WrittenAnswer) -> str:
    words = ARROWS if number % 2 else WORDS
    return "" if answer.sense is None else words[answer.sense]


def table(problem: Path = PROBLEM) -> bytes:
    """Return the file as a spreadsheet program saves CSV in UTF-8."""
    text = io.StringIO()
    csv.writer(text, delimiter=";", lineterminator="\r\n").writerows([HEAD, *rows(problem)])
    return text.getvalue().encode("utf-8-sig")


if __name__ == "__main__":
    TARGET.parent.mkdir(exist_ok=True)
    TARGET.write_bytes(table())
