"""Groups of works of one problem: honest, mistaken, copied; their table (работы)."""

from __future__ import annotations

import csv
import io
import math
import random
import statistics
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal

from benchmarks.checking.hand import Answer, Data, Hand, ImpossibleError
from benchmarks.checking.tasks import Problem

EXACT = Hand("exact", ruler=0.0, point=0.0, eye=0.0, angle=0.0, digits=13)
"""A hand without errors."""

SPREAD = 24
"""Works that the honest spread of an answer is found from."""

VISIBLE = 3.0
"""Standard deviations of honest works that a visible mistake changes an answer by."""

TRIES = 60
HEAD = ("Студент", "Вариант", "Величина", "Значение", "Единица", "мм", "Направление")
SENSES = {True: ("против ч.с.", "↺", "ccw"), False: ("по ч.с.", "↻", "cw")}

Answers = Mapping[str, Answer]
Habits = frozenset[tuple[str, str]]


@dataclass(frozen=True, slots=True)
class Work:
    """A work and the truth about it (работа).

    Attributes
    ----------
    kind : str
        ``honest``, ``one``, ``two``, ``copy``, ``spoilt`` or ``other variant``.
    habits : tuple of str
        Names of the bad habits.
    struck : tuple of str
        Answers in which a habit was followed, in order of the form.
    changed : frozenset of str
        Answers that differ from those of the same hand without the habits.
    source : str
        Student whose work is copied.
    digits : int
        Significant digits of the student's numbers.
    """

    student: str
    variant: str
    kind: str
    said: Answers
    habits: tuple[str, ...] = ()
    struck: tuple[str, ...] = ()
    changed: frozenset[str] = frozenset()
    source: str = ""
    digits: int = 4

    @property
    def roots(self) -> tuple[str, ...]:
        """First wrong answer; of two mistakes, every answer with one of them."""
        wrong = [key for key in self.struck if key in self.changed]
        if len(self.habits) > 1 and wrong:
            return tuple(wrong)
        first = wrong or [key for key in self.said if key in self.changed]
        return tuple(first[:1])

    @property
    def repeats(self) -> frozenset[str]:
        """Answers in which the habit is followed again."""
        return (frozenset(self.struck) & self.changed) - frozenset(self.roots)

    @property
    def following(self) -> frozenset[str]:
        """Answers that are wrong because of earlier ones only."""
        return self.changed - frozenset(self.roots) - self.repeats


@dataclass(slots=True)
class Group:
    """Works of one problem.

    Attributes
    ----------
    hidden : list of str
        Habits tried whose result is within the spread of honest works.
    """

    problem: Problem
    works: list[Work] = field(default_factory=list)
    hidden: list[str] = field(default_factory=list)


def hand_of(seed: str) -> Hand:
    """Return some student's hand."""
    chance = random.Random(f"{seed}|hand")
    return Hand(
        seed,
        ruler=chance.choice((0.5, 1.0)),
        point=chance.uniform(0.08, 0.2),
        eye=chance.uniform(0.05, 0.15),
        angle=chance.uniform(0.08, 0.2),
        digits=chance.choice((3, 4)),
        pi=chance.choice((math.pi, 3.14)),
        writes_mm=chance.random() < 0.5,
        from_omega=chance.random() < 0.5,
        writes_zero=chance.random() < 0.5,
    )


def make_group(problem: Problem, seed: int, count: int) -> Group:
    """Return works of one problem: so many honest, so many with one mistake, and others."""
    maker = _Maker(problem, seed)
    for number in range(count):
        maker.honest(number)
    maker.one_mistake(count)
    maker.two_mistakes(-(-count // 4))
    if problem.drawn:
        maker.copies(-(-count // 6))
    return maker.group


class _Maker:
    def __init__(self, problem: Problem, seed: int) -> None:
        self.problem, self.seed = problem, seed
        self.group = Group(problem)
        self.variants = problem.variants()
        self.chance = random.Random(f"{seed}|{problem.name}")
        self._spread: dict[tuple[str, bool], dict[str, tuple[float, float]]] = {}

    def _add(self, variant: str, kind: str, said: Answers, **told: object) -> None:
        name = f"w{len(self.group.works):04d}"
        self.group.works.append(Work(name, variant, kind, said, **told))  # type: ignore[arg-type]

    def _turn(self, number: int) -> tuple[str, Data]:
        names = list(self.variants)
        name = names[number % len(names)]
        return name, self.variants[name]

    def honest(self, number: int) -> None:
        """Add a work without a mistake."""
        variant, data = self._turn(number)
        hand = hand_of(f"{self.seed} {self.problem.name} honest {number}")
        self._add(variant, "honest", self.problem.work(data, hand).said, digits=hand.digits)

    def one_mistake(self, count: int) -> None:
        """Add works with one mistake each, all habits in turn, at places by chance."""
        made = tries = 0
        waiting: list[str] = []
        while made < count and tries < TRIES + 4 * count:
            tries += 1
            variant, data = self._turn(tries)
            hand = hand_of(f"{self.seed} {self.problem.name} one {tries}")
            met = self.problem.work(data, hand).met
            if not waiting:
                waiting = sorted({habit for habit, _ in met})
                self.chance.shuffle(waiting)
            habit = waiting.pop()
            places = [one for one in met if one[0] == habit]
            if places:
                chosen = frozenset([self.chance.choice(places)])
                made += self._mistaken("one", variant, data, hand, chosen)

    def two_mistakes(self, count: int) -> None:
        """Add works with two mistakes each, of which each alone is visible."""
        made = tries = 0
        while made < count and tries < TRIES:
            tries += 1
            variant, data = self._turn(tries)
            hand = hand_of(f"{self.seed} {self.problem.name} two {tries}")
            met = self.problem.work(data, hand).met
            habits = self.chance.sample(sorted({habit for habit, _ in met}), 2)
            pair = [self.chance.choice([one for one in met if one[0] == name]) for name in habits]
            if all(self._shows(variant, data, hand, frozenset([one])) for one in pair):
                made += self._mistaken("two", variant, data, hand, frozenset(pair))

    def _shows(self, variant: str, data: Data, hand: Hand, habits: Habits) -> bool:
        try:
            return self.visible(variant, data, hand, habits)
        except ImpossibleError:
            return False

    def _mistaken(self, kind: str, variant: str, data: Data, hand: Hand, habits: Habits) -> bool:
        """Add a mistaken work; return False where it cannot be drawn or does not show."""
        names = tuple(sorted(habit for habit, _ in habits))
        try:
            if not self.visible(variant, data, hand, habits):
                self.group.hidden.append(names[0])
                return False
            student = self.problem.work(data, hand, habits)
        except ImpossibleError:
            return False
        right = self.problem.work(data, hand).said
        changed = frozenset(
            key
            for key in student.said
            if key not in right or _differ(student.said[key], right[key])
        )
        struck = tuple(key for key in student.said if key in student.struck)
        if not changed:
            return False
        self._add(variant, kind, student.said, habits=names, struck=struck, changed=changed)
        return True

    def visible(self, variant: str, data: Data, hand: Hand, habits: Habits) -> bool:
        """Return whether a mistake changes an answer by more than honest hands differ."""
        exact = Hand(
            "exact", ruler=0.0, point=0.0, eye=0.0, angle=0.0, digits=13,
            from_omega=hand.from_omega, writes_zero=hand.writes_zero,
        )  # fmt: skip
        right = self.problem.work(data, exact).said
        wrong = self.problem.work(data, exact, habits).said
        spread = self._spread_of(variant, data, hand.from_omega)
        return any(
            key not in wrong
            or abs(wrong[key].value - answer.value) > VISIBLE * spread[key][0] + spread[key][1]
            for key, answer in right.items()
        )

    def _spread_of(
        self, variant: str, data: Data, from_omega: bool
    ) -> dict[str, tuple[float, float]]:
        """Return the spread of honest answers, and two units of a third digit."""
        known = self._spread.get((variant, from_omega))
        if known is None:
            hands = (
                Hand(f"spread {n}", 1.0, 0.2, 0.15, 0.2, digits=6, from_omega=from_omega)
                for n in range(SPREAD)
            )
            works = [self.problem.work(data, hand).said for hand in hands]
            known = {}
            for key in works[0]:
                values = [work[key].value for work in works if key in work]
                size = statistics.fmean(abs(value) for value in values)
                known[key] = statistics.pstdev(values), 0.01 * size
            self._spread[variant, from_omega] = known
        return known

    def copies(self, count: int) -> None:
        """Add works copied from others: as they are, spoilt, or for another variant."""
        sources = [work for work in self.group.works if work.kind in ("honest", "one")]
        names = list(self.variants)
        for _ in range(count):
            for kind in ("copy", "spoilt", "other variant"):
                source = self.chance.choice(sources)
                variant, said = source.variant, source.said
                if kind == "other variant":
                    variant = self.chance.choice([name for name in names if name != variant])
                if kind == "spoilt":
                    said = {key: self._spoilt(answer) for key, answer in said.items()}
                self._add(variant, kind, said, source=source.student, habits=source.habits)

    def _spoilt(self, answer: Answer) -> Answer:
        """Return an answer, in half of all cases with another last digit."""
        if answer.value == 0.0 or self.chance.random() < 0.5:
            return answer
        last = Decimal(_text(abs(answer.value))).as_tuple().exponent
        step = 10.0 ** int(last) * self.chance.choice((-2, -1, 1, 2))
        value = float(f"{answer.value + step:.10g}")
        return Answer(value if value * answer.value > 0 else answer.value, answer.mm, answer.turns)


def _differ(one: Answer, other: Answer) -> bool:
    return abs(one.value - other.value) > 1e-9 * abs(other.value)


def _text(value: float) -> str:
    return format(Decimal(f"{value:.10g}"), "f")


def rows(works: Sequence[Work]) -> Iterator[tuple[str, ...]]:
    """Yield the rows of the group's table."""
    yield HEAD
    for number, work in enumerate(works):
        for key, answer in work.said.items():
            value, sense = answer.value, ""
            if answer.turns and value:
                sense = SENSES[value > 0][number % 3]
                value = abs(value)
            mm = "" if answer.mm is None else _text(answer.mm)
            told = (_text(value), "", mm, sense)
            yield (
                work.student,
                work.variant,
                key,
                *(cell.replace(".", ",") for cell in told[:3]),
                sense,
            )


def table(works: Sequence[Work]) -> str:
    """Return the group's table as CSV."""
    text = io.StringIO()
    csv.writer(text, delimiter=";", lineterminator="\n").writerows(rows(works))
    return text.getvalue()
