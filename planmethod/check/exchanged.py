"""Two right answers, each written in the place of the other (ответы, переставленные местами)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import combinations
from typing import TypeAlias

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.grading import (
    ExaminedAnswer,
    UnusableError,
    detect_copied_variant,
    distance,
    examine,
)
from planmethod.check.key import SEGMENT_CODES
from planmethod.check.model import Diagnosis, Verdict, WrittenAnswer
from planmethod.check.sheet import Sheet
from planmethod.check.task import Task
from planmethod.problem.quantities import TURNINGS

CODE = "swap"

VALUE, MM, SENSE = ("value", "step", "raw"), ("mm", "mm_step", "segment"), ("sense",)

CELLS = (VALUE + MM + SENSE, VALUE + MM, VALUE + SENSE, VALUE)
"""What of two answers is exchanged: their rows, or only some of their cells."""

Pair: TypeAlias = tuple[ExaminedAnswer, ExaminedAnswer]

ACCUSED = (Verdict.WRONG, Verdict.INCONSISTENT, Verdict.NEAR)


class Exchange(Struct, frozen=True):
    """Two answers that are right when they are exchanged (перестановка).

    Attributes
    ----------
    pair : tuple of ExaminedAnswer
        As they were written, in order of the form.
    answers : list of ExaminedAnswer
        All answers, these two in their places: what is wrong there has another cause.
    code : str
    went_on : bool
        Whether the student went on with them as they are: then what is left may be a consequence.
    """

    pair: Pair
    answers: list[ExaminedAnswer]
    code: str
    went_on: bool

    def as_written(self) -> list[ExaminedAnswer]:
        """Return all answers, the mistake counted at the first of the two."""
        first, second = self.pair
        first.verdict, first.source = Verdict.WRONG, ""
        second.verdict, second.source = Verdict.INHERITED, first.item.id
        for one in self.pair:
            one.slip = one.contradicts = False
        own = {id(one.item): one for one in self.pair}
        return [own.get(id(one.item), one) for one in self.answers]

    def diagnoses(self, others: Iterable[Diagnosis]) -> Iterator[Diagnosis]:
        """Yield the mistake, with both quantities, and the mistakes in the answers beside it."""
        first, second = self.pair
        place = f"{second.item.question.symbol} ≠ {first.item.question.symbol}"
        yield Diagnosis((self.code,), sure=True, roots=(first.item.id,), mistake_at=place)
        yield from (replace(one, sure=one.sure and not self.went_on) for one in others)


def find_exchange(
    task: Task,
    sheet: Sheet,
    examined: Sequence[ExaminedAnswer],
    judge: Callable[[list[ExaminedAnswer]], None],
) -> Exchange | None:
    """Return two answers that are each other's, to the tolerance of the drawing; None without.

    Parameters
    ----------
    judge : callable
        Gives answers their verdicts.
    """
    off = [one for one in examined if _is_far(one, task.settings.near)]
    for pair in combinations(off, 2):
        one, two = pair
        if one.item.question.unit != two.item.question.unit or not _begin(one, two):
            continue
        if not (_fits(one, two) and _fits(two, one)):
            continue
        for cells in CELLS:
            try:
                restored = _restored(task, sheet, examined, pair, cells)
            except UnusableError:
                continue
            judge(restored)
            both = [*zip(examined, restored, strict=True)]
            if any(_is_accused(again) for own, again in both if own is one or own is two):
                continue
            if detect_copied_variant(task, sheet, [*examined]) is not None:
                return None
            # Some answers may follow from the numbers as written, others from the right ones.
            went_on = any(
                own.verdict is Verdict.INHERITED and _is_accused(again) for own, again in both
            )
            answers = [again if _is_accused(own) else own for own, again in both]
            return Exchange(pair, answers, _code(task, sheet, pair, went_on=went_on), went_on)
    return None


def _is_accused(one: ExaminedAnswer) -> bool:
    return one.verdict in ACCUSED or one.sense_right is False


def _is_far(one: ExaminedAnswer, near: float) -> bool:
    """Return whether a number is surely not the right one."""
    wrong = one.verdict in (Verdict.WRONG, Verdict.INHERITED)
    return wrong and one.off > near * max(one.limit.tolerance(one.step), one.limit.spread)


def _begin(one: ExaminedAnswer, two: ExaminedAnswer) -> bool:
    """Return whether two numbers are wrong for no earlier one, or one because of the other."""
    return all(
        own.verdict is Verdict.WRONG or own.source == other.item.id
        for own, other in ((one, two), (two, one))
    )


def _fits(one: ExaminedAnswer, place: ExaminedAnswer) -> bool:
    """Return whether a number is right in the place of another one."""
    tolerance = max(place.limit.tolerance(one.step), place.limit.spread)
    rights = [(place.limit.exact, tolerance)]
    if place.local is not None and place.local_tolerance is not None and not place.follows:
        rights.append((place.local, place.local_tolerance))
    return any(
        distance(place.item, one.value, right, signed=one.signed) <= tolerance
        for right, tolerance in rights
    )


def _restored(
    task: Task,
    sheet: Sheet,
    examined: Sequence[ExaminedAnswer],
    pair: Pair,
    cells: Sequence[str],
) -> list[ExaminedAnswer]:
    """Return all answers, not yet judged, with some cells of two exchanged."""
    one, two = pair
    written = {
        id(own): _with_cells(own.written, other.written, cells)
        for own, other in ((one, two), (two, one))
    }
    return [
        examine(task, sheet, other.item, written.get(id(other), other.written))
        for other in examined
    ]


def _with_cells(own: WrittenAnswer, other: WrittenAnswer, cells: Sequence[str]) -> WrittenAnswer:
    return replace(own, **{cell: getattr(other, cell) for cell in cells})


def _code(task: Task, sheet: Sheet, pair: Pair, *, went_on: bool) -> str:
    """Return the mistake: a known one that gives just this, another segment read, or a slip."""
    one, two = (answer.item.question for answer in pair)
    read = one.plan if one.plan is two.plan else None
    if went_on and read in SEGMENT_CODES and not {one.key.kind, two.key.kind} & {*TURNINGS}:
        return SEGMENT_CODES[read]
    right = sheet.exact_answers
    given = {**right, one.id: right[two.id], two.id: right[one.id]}
    known = (
        explanation.code
        for explanation in task.named(sheet)
        if all(math.isclose(abs(explanation.values[id]), abs(given[id])) for id in given)
    )
    return next(known, CODE)
