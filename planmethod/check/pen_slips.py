"""Right answers written down wrongly: exchanged, digits swapped, decimal point moved (описки).

Each is undone, and the answers are judged again: the student went on with the right number.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import combinations
from typing import TypeAlias

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.explain import Explanation
from planmethod.check.following import PLACES
from planmethod.check.grading import (
    ExaminedAnswer,
    UnusableError,
    distance,
    examine,
    swap_digits,
)
from planmethod.check.key import SEGMENT_CODES
from planmethod.check.model import Diagnosis, Verdict, WrittenAnswer
from planmethod.check.sheet import Sheet
from planmethod.check.task import Task
from planmethod.check.variants import detect_copied_variant
from planmethod.problem.quantities import TURNINGS

VALUE, MM, SENSE = ("value", "step", "raw"), ("mm", "mm_step", "segment"), ("sense",)

CELLS = (VALUE + MM + SENSE, VALUE + MM, VALUE + SENSE, VALUE)
"""Cells of two answers that are exchanged: whole rows, or parts of them."""

_SAME = 0.005
"""Relative difference up to which a wrong number is that of a known mistake: three digits."""

ACCUSED = (Verdict.WRONG, Verdict.INCONSISTENT, Verdict.NEAR)

Undone: TypeAlias = tuple[tuple[ExaminedAnswer, ...], Mapping[str, WrittenAnswer]]
"""Answers written down wrongly, in order of the form, and the right cells by their ids."""


class PenSlip(Struct, frozen=True):
    """Answers that are right when a slip of the pen is undone (описка).

    Attributes
    ----------
    written : tuple of ExaminedAnswer
        Answers with the slip, in order of the form.
    answers : list of ExaminedAnswer
        All answers, the slip undone: an error there has another cause.
    code : str
    went_on : bool
        Whether the student went on with the numbers as they are: then other errors may be
        consequences.
    """

    written: tuple[ExaminedAnswer, ...]
    answers: list[ExaminedAnswer]
    code: str
    went_on: bool

    def as_written(self) -> list[ExaminedAnswer]:
        """Return all answers, the slip counted at its first one."""
        first, *others = self.written
        first.verdict, first.source = Verdict.WRONG, ""
        for one in others:
            one.verdict, one.source = Verdict.INHERITED, first.item.id
        for one in self.written:
            one.slip = one.contradicts = False
        own = {id(one.item): one for one in self.written}
        return [own.get(id(one.item), one) for one in self.answers]

    def diagnoses(self, remaining: Iterable[Diagnosis]) -> Iterator[Diagnosis]:
        """Yield the slip, and the mistakes in the answers beside it."""
        symbols = [one.item.question.symbol for one in self.written]
        place = " ≠ ".join(reversed(symbols)) if len(symbols) > 1 else ""
        yield Diagnosis((self.code,), sure=True, roots=(self.written[0].item.id,), mistake_at=place)
        yield from (replace(one, sure=one.sure and not self.went_on) for one in remaining)


def find_pen_slip(
    task: Task,
    sheet: Sheet,
    examined: Sequence[ExaminedAnswer],
    assign_verdicts: Callable[[list[ExaminedAnswer]], None],
) -> PenSlip | None:
    """Return the slip of the pen that the other answers show; None without.

    Parameters
    ----------
    assign_verdicts : callable
        Gives answers their verdicts.
    """
    for written, cells_by_id in _undo_slips(examined, task.settings.near):
        items = {one.item.id for one in written}
        try:
            undone = [
                examine(task, sheet, one.item, cells_by_id.get(one.item.id, one.written))
                for one in examined
            ]
        except UnusableError:
            continue
        assign_verdicts(undone)
        both = [*zip(examined, undone, strict=True)]
        if any(_is_accused(again) for _, again in both if again.item.id in items):
            continue
        # Some answers may follow from the numbers as written, others from the right ones.
        went_on = any(
            own.verdict is Verdict.INHERITED and _is_accused(again) for own, again in both
        )
        freed = any(
            _contradicts_parent(own, written[0]) and not again.contradicts for own, again in both
        )
        if len(written) == 1 and (
            went_on or not freed or _is_of_a_mistake(task, sheet, written[0], examined)
        ):
            continue  # it may as well be something else
        if detect_copied_variant(task, sheet, [*examined]) is not None:
            return None
        answers = [again if _is_accused(own) else own for own, again in both]
        code = "S4" if len(written) == 1 else _find_code(task, sheet, written, went_on=went_on)
        return PenSlip(written, answers, code, went_on)
    return None


def _undo_slips(examined: Sequence[ExaminedAnswer], near: float) -> Iterator[Undone]:
    """Yield the slips that give a right number where they are undone."""
    off = [one for one in examined if _is_surely_wrong(one, near)]
    for one, two in combinations(off, 2):
        alike = one.item.question.unit == two.item.question.unit and _are_first_mistakes(one, two)
        if alike and _is_right_value(one, two.value) and _is_right_value(two, one.value):
            for cells in CELLS:
                yield (
                    (one, two),
                    {
                        own.item.id: _with_cells(own.written, other.written, cells)
                        for own, other in ((one, two), (two, one))
                    },
                )
    for one in (one for one in examined if one.verdict is Verdict.WRONG):
        value = one.written.value
        if not value or not any(_contradicts_parent(other, one) for other in examined):
            continue
        for right in (*swap_digits(one), *(abs(one.value) * place for place in PLACES)):
            if _is_right_value(one, math.copysign(right, one.value)):
                times = abs(right / one.value)
                row = replace(one.written, value=value * times, step=one.written.step * times)
                yield (one,), {one.item.id: row}


def _contradicts_parent(one: ExaminedAnswer, parent: ExaminedAnswer) -> bool:
    """Return whether an answer is right, but not from the number written for an earlier one."""
    return one.right and one.contradicts and parent.item.id in one.parents


def _is_of_a_mistake(
    task: Task, sheet: Sheet, one: ExaminedAnswer, examined: Iterable[ExaminedAnswer]
) -> bool:
    """Return whether a known mistake gives a wrong number and another one: v² in place of v."""
    wrong = [other for other in examined if other is not one and other.verdict is Verdict.WRONG]

    def predicts(explanation: Explanation, answer: ExaminedAnswer) -> bool:
        value = explanation.values[answer.item.question.id]
        return math.isclose(abs(answer.value), abs(value), rel_tol=_SAME)

    return any(
        predicts(known, one) and any(predicts(known, other) for other in wrong)
        for known in (task.named(sheet) if wrong else ())
    )


def _is_accused(one: ExaminedAnswer) -> bool:
    return one.verdict in ACCUSED or one.sense_right is False


def _is_surely_wrong(one: ExaminedAnswer, near: float) -> bool:
    """Return whether a number is surely not the right one."""
    wrong = one.verdict in (Verdict.WRONG, Verdict.INHERITED)
    return wrong and one.off > near * max(one.limit.tolerance(one.step), one.limit.spread)


def _are_first_mistakes(one: ExaminedAnswer, two: ExaminedAnswer) -> bool:
    """Return whether two numbers are wrong for no earlier one, or one because of the other."""
    return all(
        own.verdict is Verdict.WRONG or own.source == other.item.id
        for own, other in ((one, two), (two, one))
    )


def _is_right_value(one: ExaminedAnswer, value: float) -> bool:
    """Return whether another number is right in the place of an answer."""
    return distance(one.item, value, one.limit.exact) <= one.limit.tolerance(one.step)


def _with_cells(row: WrittenAnswer, source: WrittenAnswer, cells: Sequence[str]) -> WrittenAnswer:
    return replace(row, **{cell: getattr(source, cell) for cell in cells})


def _find_code(task: Task, sheet: Sheet, pair: Sequence[ExaminedAnswer], *, went_on: bool) -> str:
    """Return the name of an exchange: a known mistake that gives just this, or another segment."""
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
    return next(known, "swap")
