"""Which mistake gives a student's numbers: explanations and how well each fits (диагностика).

An explanation predicts every answer of a sheet: by the program with a mistake in it, or by the
right one with one wrong number substituted. Explanations are compared by the likelihood of the
written answers, with drafting and reading errors, so a vague explanation does not win by luck.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property

import numpy as np
import numpy.typing as npt
from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.mistakes import changes
from planmethod.check.mistakes.plans import Change, MistakeContext
from planmethod.check.sheet import Local, Sheet, StudentValues
from planmethod.construct.evaluate import Trace
from planmethod.construct.program import Program
from planmethod.construct.steps import Name, NumberName

WIDE = math.log(1e4)
"""Range of the factors that a slip can multiply a number by, as the logarithm of a ratio."""

MIN_ERROR_FRACTION = 0.3
"""An answer that a mistake makes small is drawn no better than a third of the right one."""

ANSWERS_PER_STROKE = 2.0
"""Average number of answers affected by one stroke: its error is counted in each of them."""

MAX_SQUARED_SIGMAS = 30.0
"""Cap of squared sigmas: larger deviations of an answer do not count more."""

MAX_CACHED_SLIPS = 500
"""Maximum number of slips whose plans are cached."""

OFF = 9.0
"""Sigmas squared from which an answer is surely not what a mistake gives."""

ONE_MISTAKE = 2 * math.log(20.0)

MISREAD_SENSE = 14.0
"""Cost of a reversed sense: one in a thousand is a slip of the pen."""


class Fact(Struct, frozen=True):
    """One answer as the explanations have to give it.

    Attributes
    ----------
    id : str
    value : float
        Size, or signed value if the student gives a sign.
    signed : bool
    step : float
        Unit of the last digit.
    min_sigma : float
        Lower bound of sigma for any value written by hand.
    slot : NumberName or None
        Number of the program that the answer determines; None if no value follows from it.
    per_slot : float
        Value of that number's unit in the unit of the answer.
    name : NumberName or None
        Number that is the answer itself.
    rotation_sign : float
        1 counter-clockwise, -1 clockwise, if the student states a sense of rotation; else 0.
    sense : callable or None
        Returns whether the stated sense is right on a sheet; None if undecidable.
    """

    id: str
    value: float
    signed: bool
    step: float
    min_sigma: float
    slot: NumberName | None = None
    per_slot: float = 1.0
    name: NumberName | None = None
    rotation_sign: float = 0.0
    sense: Callable[[Trace], bool | None] | None = None

    def of(self, value: float) -> float:
        """Return a value in the form in which it is compared with the student's."""
        return value if self.signed else abs(value)


class StudentNumbers(Struct, frozen=True):
    """A student's own numbers (собственные числа студента).

    Attributes
    ----------
    all : Own
    values : Own
        Only answers, without lengths at the student's scale.
    error_fraction : float
        Error of the right answers, as a fraction of the expected drafting error: for students who
        draw with a program, or compute, each number is stronger evidence.
    """

    all: StudentValues
    values: StudentValues
    error_fraction: float = 1.0


class Explanation(Struct, frozen=True, eq=False):
    """A possible cause of the answers, with its predictions (объяснение).

    Attributes
    ----------
    code : str
        Empty for a wrong number of unknown cause.
    mistake_at : str
    values : mapping of str to float
        Every answer.
    trace : Trace
    sheet : Sheet
        The plans that it is made on.
    first_answers : tuple of str
        Answers that it begins with, where that is known.
    free : str
        Question whose answer is accepted as written.
    slip : str
        Question whose number alone differs: the reading it comes from is unchanged.
    fixed : str
        Question whose predicted answer does not depend on earlier answers.
    sigma : float or None
        Error of that answer, where it is not that of the right one in proportion.
    prior : float
    change, program : Change, Program or None
        The mistake, and the program with it.
    """

    code: str
    mistake_at: str
    values: Mapping[str, float]
    trace: Trace
    sheet: Sheet
    first_answers: tuple[str, ...] = ()
    free: str = ""
    slip: str = ""
    fixed: str = ""
    sigma: float | None = None
    prior: float = 1.0
    change: Change | None = None
    program: Program | None = None


class ExplanationFit(Struct, frozen=True):
    """Goodness of fit of an explanation.

    Attributes
    ----------
    score : float
        Twice the negative logarithm of the likelihood, with the prior; the smaller the better.
    chi2 : float
    count : int
        Answers that it predicts.
    predicted : frozenset of str
        Questions whose answers are as predicted from the student's own numbers.
    """

    explanation: Explanation
    score: float
    chi2: float
    count: int
    predicted: frozenset[str] = frozenset()

    @property
    def likely(self) -> bool:
        """True if a fit this bad occurs by chance more than once in a hundred times."""
        return exceeds(self.chi2 / ANSWERS_PER_STROKE, self.count) > 0.01


def exceeds(chi2: float, count: int) -> float:
    """Return how often chi-squared of a number of answers is larger (Wilson and Hilferty)."""
    if count < 1:
        return 1.0
    spread = 2.0 / (9.0 * count)
    z = ((chi2 / count) ** (1 / 3) - (1 - spread)) / math.sqrt(spread)
    return 0.5 * math.erfc(z / math.sqrt(2.0))


class Explanations:
    """All named explanations of one sheet, computed once for all students."""

    def __init__(self, sheet: Sheet) -> None:
        self.sheet = sheet
        self.scene = MistakeContext(sheet)
        self._named: list[Explanation] | None = None
        self._last: StudentNumbers | None = None
        self._replays: dict[Sheet | Explanation, dict[Name, float]] = {}
        self._slips: dict[tuple[object, ...], Explanation | None] = {}
        self._locals: dict[tuple[Explanation, frozenset[Name]], Local] = {}

    @property
    def named(self) -> list[Explanation]:
        """Mistakes of the program, each with its predictions."""
        if self._named is None:
            self._named = [*self._evaluated(changes(self.scene))]
        return self._named

    def _evaluated(self, mistakes: Iterator[Change]) -> Iterator[Explanation]:
        for change in mistakes:
            made = self.of_change(change)
            if made is not None:
                yield made

    def of_change(self, change: Change) -> Explanation | None:
        """Return the predictions of a mistake; None if it cannot be drawn."""
        sheet = self.sheet
        program = change.program(sheet.program)
        trace = sheet.read(program, change.data)
        values = sheet.evaluate_answers(trace)
        if not all(math.isfinite(value) for value in values.values()):
            return None
        return Explanation(
            change.code,
            change.mistake_at,
            values,
            trace,
            sheet,
            prior=change.prior,
            change=change,
            program=program,
        )

    def of_both(self, one: Explanation, two: Explanation) -> Explanation | None:
        """Return what two mistakes give together; None where they change the same."""
        first, second = one.change, two.change
        if first is None or second is None:
            return None
        if first.steps.keys() & second.steps.keys() or first.data.keys() & second.data.keys():
            return None
        both = replace(
            first,
            steps={**first.steps, **second.steps},
            data={**first.data, **second.data},
            prior=first.prior * second.prior / math.exp(ONE_MISTAKE / 2),
        )
        return self.of_change(both)

    def of_slip(self, change: Change, question: str, item: str) -> Explanation | None:
        """Return the predictions of a mistake in one number; they are cached."""
        key = (change.code, change.mistake_at, item, *change.steps.values(), change.prior)
        if key not in self._slips:
            if len(self._slips) >= MAX_CACHED_SLIPS:
                self._slips.clear()
                self._locals.clear()
            made = self.of_change(change)
            made = made and replace(made, slip=question, first_answers=(item,))
            self._slips[key] = made
        return self._slips[key]

    @cached_property
    def _table(self) -> npt.NDArray[np.float64]:
        """Return what every named explanation gives for every question, shape (e, q)."""
        ids = [question.id for question in self.sheet.requested]
        return np.array([[e.values[i] for i in ids] for e in self.named]).reshape(-1, len(ids))

    @cached_property
    def _sigmas(self) -> npt.NDArray[np.float64]:
        found = np.array([self.sheet.sigma(question) for question in self.sheet.requested])
        return np.where(np.isfinite(found), found, 0.0)

    def nearest(self, facts: Sequence[Fact], count: int) -> list[Explanation]:
        """Return the named explanations closest to the answers; large deviations are capped."""
        rows = {question.id: row for row, question in enumerate(self.sheet.requested)}
        chosen = [rows[fact.id] for fact in facts]
        if not self.named or not chosen:
            return []
        given = self._table[:, chosen]
        signed = np.array([fact.signed for fact in facts])
        values = np.array([fact.value for fact in facts])
        right = np.abs(np.array([self.sheet.exact_answers[fact.id] for fact in facts]))
        own = np.array([fact.min_sigma**2 + fact.step**2 / 12 for fact in facts])
        share = np.where(right == 0, 1.0, np.abs(given) / np.where(right == 0, 1.0, right))
        variance = self._sigmas[chosen] ** 2 * np.maximum(share, MIN_ERROR_FRACTION) ** 2
        off = values - np.where(signed, given, np.abs(given))
        bad = np.minimum(off**2 / (variance + own), MAX_SQUARED_SIGMAS).sum(axis=1)
        turns = np.array([fact.rotation_sign for fact in facts])
        bad = bad + MISREAD_SENSE * ((turns != 0) & (np.sign(given) == -turns)).sum(axis=1)
        order = np.argsort(bad, kind="stable")[:count]
        return [self.named[number] for number in order]

    # Fits ------------------------------------------------------------------------------------

    def evaluate(
        self,
        explanation: Explanation,
        facts: Sequence[Fact],
        numbers: StudentNumbers,
        *,
        closely: bool = False,
    ) -> ExplanationFit:
        """Return how well an explanation fits what was written.

        Every answer is compared with the value derived from the earlier ones, with the mistake in
        the plans: so their likelihoods multiply, and values computed from them are exact.

        Parameters
        ----------
        numbers : StudentNumbers
        closely : bool
            Use the errors of the plans with the mistake; else those of the right ones,
            in proportion.
        """
        sheet, change = explanation.sheet, explanation.change
        of_scale = change is not None and change.of_scale
        own = whole = numbers.values if of_scale else numbers.all
        slip = next((fact for fact in facts if fact.id == explanation.slip), None)
        if slip is not None and slip.name is not None and slip.name not in own:
            own = {name: put for name, put in own.items() if name != slip.slot}
            own = {**own, slip.name: numbers.values[slip.name]}
        came = self._replayed(explanation, own, numbers)
        left = self._left(explanation, own) if closely else sheet.local(whole)
        chi2, score, count = 0.0, 0.0, 0
        predicted: set[str] = set()
        for fact in facts:
            slot, per_slot = fact.slot, fact.per_slot
            sigma = 0.0 if slot is None else left.sigma.get(slot, 0.0) * per_slot
            if of_scale or fact is slip:
                slot, per_slot = fact.name, 1.0
                sigma = sigma if slot is None else left.sigma.get(slot, sigma)
            if fact.id == explanation.free or slot is None or slot not in came:
                continue
            given = came[slot] * per_slot
            if fact.id == explanation.fixed:
                sigma *= abs(explanation.values[fact.id] / given) if given else 1.0
                given = explanation.values[fact.id]
                sigma = sigma if explanation.sigma is None else explanation.sigma
            elif not closely:
                right = abs(sheet.exact_answers[fact.id])
                sigma *= max(abs(given) / right, MIN_ERROR_FRACTION) if right else 1.0
            count += 1
            if not math.isfinite(given):
                chi2 = score = math.inf
                continue
            off, own_error = fact.value - fact.of(given), fact.min_sigma**2 + fact.step**2 / 12
            chi2 += off**2 / (sigma**2 + own_error)
            if off**2 <= OFF * (sigma**2 + own_error):
                predicted.add(fact.id)
            variance = (sigma * numbers.error_fraction) ** 2 + own_error
            score += min(off**2 / variance, MAX_SQUARED_SIGMAS) + math.log(2 * math.pi * variance)
        score += ONE_MISTAKE - 2 * math.log(explanation.prior)
        if explanation.free:
            free = next(fact for fact in facts if fact.id == explanation.free)
            usual = abs(sheet.exact_answers[free.id])
            score += 2 * math.log(max(abs(free.value), usual, free.min_sigma) * WIDE)
        for fact in facts:
            right_way = None if fact.sense is None else fact.sense(explanation.trace)
            if right_way is False:
                score += MISREAD_SENSE
                predicted.discard(fact.id)
        return ExplanationFit(explanation, score, chi2, count, frozenset(predicted))

    def _replayed(
        self, explanation: Explanation, values: StudentValues, numbers: StudentNumbers
    ) -> dict[Name, float]:
        change, sheet = explanation.change, explanation.sheet
        if self._last is not numbers:
            self._last, self._replays = numbers, {}
        key: Sheet | Explanation = sheet if change is None else explanation  # of slips the same
        if key not in self._replays:
            data = {} if change is None else change.data
            self._replays[key] = sheet.replayed(values, explanation.program, data)[0]
        return self._replays[key]

    def _left(self, explanation: Explanation, values: StudentValues) -> Local:
        """Return the errors left by the student's numbers, on the plans with the mistake."""
        change, sheet = explanation.change, explanation.sheet
        if change is None:
            return sheet.local(values)
        key = (explanation, frozenset[Name](values))
        if key not in self._locals:
            program = explanation.program or sheet.program
            self._locals[key] = sheet.localised(values, program, {**sheet.data, **change.data})
        return self._locals[key]
