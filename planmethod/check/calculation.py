"""Answers that are computed, not drawn: trains and moving points (проверка расчётных задач).

They are graded, propagated and formatted like those of plans. A value is exact up to rounding;
a quantity requested, or given, in millimetres of a picture has drafting errors.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache, cached_property
from typing import Any

from msgspec.structs import replace

from planmethod.check.explain import Explanation, ExplanationFit
from planmethod.check.following import diagnose_copied, list_miswritings, propagate_mistake
from planmethod.check.grading import (
    ExaminedAnswer,
    distance,
    swap_digits,
)
from planmethod.check.marks import Settings
from planmethod.check.model import Diagnosis, Unread, Verdict, WrittenAnswer
from planmethod.check.questions import Question, normalize
from planmethod.check.relations import (
    MIN_ROUNDING,
    derive,
    find_names,
    find_slips,
    keep_exact_relations,
    parse_formula,
)
from planmethod.check.routes import would_circle
from planmethod.check.sheet import Sheet
from planmethod.check.submissions.cells import mark_unreadable, ratio
from planmethod.check.task import Task, TaskItem
from planmethod.construct.drafting import Profile
from planmethod.construct.evaluate import Trace
from planmethod.errors import Fault, ProblemError
from planmethod.kind import ProblemKind
from planmethod.languages import translate
from planmethod.note.numbers import MINUS
from planmethod.plans.model import Plan
from planmethod.problem.quantities import QuantityKey, QuantityKind, Sign
from planmethod.problem.records import (
    AnswerForm,
    AnswerValue,
    KindProblem,
    Mistaken,
    QuestionQuantities,
    QuestionSpec,
    Relation,
    Relations,
)
from planmethod.solved.quantity_steps import NoValue, NoValueError
from planmethod.solved.selfcheck import verify
from planmethod.solved.solution import Solution

COUNTED = 0.3
"""Permitted error of a count: students do not write a half."""

COARSE = 0.01
"""Relative weight of the last digit from which a number cannot indicate another variant."""

EXACT_PRIOR, LOOSE, USUAL, RARE = 2.0, 0.75, 0.5, 0.25
"""Priors of a usual mistake to the digits written, a sign, another change of a formula."""

OWN_ROUNDING = 0.002
"""Share of a right number by which a student's may differ from it, rounded on the way."""

THREE_DIGITS = 1e-3
"""Maximum ratio of the unit of a number's third digit to the number."""

_EMPTY_TRACE = Trace({}, {})


class CalculationSheet(Sheet):
    """Requested quantities of one position of a computed problem."""

    def __init__(
        self,
        quantities: QuestionQuantities,
        position: int,
        requested: Iterable[Question],
        by: Profile,
    ) -> None:
        self.quantities, self.position = quantities, position
        self.requested, self.profile = tuple(requested), by
        self.scales, self.order, self.steps_by_name = {}, {}, {}
        self._readings: dict[str, tuple[float, float]] = {}

    @cached_property
    def exact_trace(self) -> Trace:
        """Nothing is constructed."""
        return _EMPTY_TRACE

    @cached_property
    def answer_key_sheet(self) -> Sheet:
        """The sheet itself: it is computed."""
        return self

    @cached_property
    def exact_answers(self) -> dict[str, float]:
        """Exact answers by the id of the question."""
        return {question.id: float(question.evaluate(_EMPTY_TRACE)) for question in self.requested}

    def _drawn(self, question: Question) -> tuple[float, float]:
        if question.key.kind is not QuantityKind.PICTURED:
            return math.nan, 0.0
        name = question.key.names[0]
        if name not in self._readings:
            read = self.quantities.read_off(name, self.position, self.profile)
            self._readings[name] = read or (math.nan, 0.0)
        return self._readings[name]

    def length(self, question: Question) -> float | None:
        """Return the length of its segment on the picture, mm."""
        mm, _ = self._drawn(question)
        return mm if math.isfinite(mm) else None

    def sigma(self, question: Question) -> float:
        """Return one sigma of a reading; 0 for a computed value."""
        return self._drawn(question)[1]

    def vector(self, question: Question, trace: Trace | None = None) -> complex | None:
        """Return None: no answer is a vector."""
        return None

    @property
    def plans(self) -> tuple[Plan, ...]:
        """Plans that it has: none."""
        return ()


class Calculation(Task):
    """One variant of a problem that is computed; see `planmethod.check.task.Task`.

    Raises
    ------
    ProblemError
        It requests a quantity without a value, or has none.
    """

    def __init__(
        self,
        table: str,
        problem: KindProblem,
        quantities: QuestionQuantities,
        settings: Settings,
        other_variants: Callable[[], Iterable[Task]] | None = None,
    ) -> None:
        self.problem, self.settings = problem, replace(settings, floor_mm=0.0)
        self.variant, self._other_variants = problem.variant, other_variants
        self.table, self.quantities = table, quantities
        self._question_cache: dict[tuple[str, int, bool, bool], Question] = {}
        self._forms: dict[str, TaskItem] = {}
        self._numbers: dict[tuple[object, ...], CalculationSheet] = {}
        self._relations: dict[tuple[object, ...], Relations] = {}
        self._orders: dict[int, tuple[str, ...]] = {}
        # Computed once for all works and positions: each may be another cam.
        self._mistaken: Callable[[], tuple[Mistaken, ...]] = cache(
            lambda: tuple(self.quantities.mistaken())
        )
        if not (problem.answers or self.quantities.names):
            fault = Fault(table, "no quantity has a value that could be requested")
            raise ProblemError(problem.name, [fault])
        self.declared = tuple(self._declare_item(at, one) for at, one in enumerate(problem.answers))

    def copy_for_submission(self) -> Calculation:
        """Return a copy of the task for one submission: its extra answers do not affect others."""
        other = copy.copy(self)
        other._question_cache = dict(self._question_cache)
        return other

    def _declare_item(self, at: int, spec: QuestionSpec) -> TaskItem:
        position = spec.position or 0
        drawn = spec.form is not AnswerForm.VALUE
        question = self._question(spec.what, position, drawn=drawn, turns=spec.sense is not None)
        if question is None:
            phrase = translate("{} has no value in this problem", spec.what)
            fault = Fault(
                f"answers[{at}].what",
                phrase,
                "planmethod solve shows the reason; choose another quantity.",
            )
            raise ProblemError(self.problem.name, [fault])
        item = self._item(question, position, spec.what)
        item = replace(
            item,
            id=spec.id,
            name=spec.id,
            points=spec.points,
            asks_sense=spec.sense is not None,
            fixed=spec.tolerance or item.fixed,
            label=spec.letters[0] if spec.letters else "",
            unit=self.unit_of(spec, question),
        )
        for form in (spec.id, *spec.letters, spec.what):
            self._forms.setdefault(form, item)
            self._forms.setdefault(normalize(form), item)
        return item

    def _question(
        self, name: str, position: int, *, drawn: bool = False, turns: bool = False
    ) -> Question | None:
        key = (name, position, drawn, turns)
        quantity = (
            self.quantities.quantity(name, position) if key not in self._question_cache else None
        )
        if quantity is not None:
            self._question_cache[key] = _question_of(name, quantity, drawn=drawn, turns=turns)
        return self._question_cache.get(key)

    def _item(self, question: Question, position: int, name: str) -> TaskItem:
        quantity = self.quantities.quantity(name, position)
        whole = quantity is not None and quantity.is_integer and quantity.value
        fixed = COUNTED / abs(quantity.value) if quantity is not None and whole else None
        return TaskItem(name, question, position, fixed=fixed, label=name, name=name)

    def usual(self, position: int | None = None) -> tuple[TaskItem, ...]:
        """Return the requested items: those of the file, or the usual quantities of a position."""
        if self.declared:
            return self.declared
        position = position or 0
        told = [(name, self._question(name, position)) for name in self.quantities.names]
        return tuple(self._item(q, position, name) for name, q in told if q is not None)

    @property
    def count(self) -> int:
        """Positions, or moments."""
        return self.quantities.count

    @property
    def first(self) -> int:
        """Default position: the first."""
        return 0

    def scales(self, student_scales: Mapping[str, float], position: int) -> dict[str, float]:
        """Return no scales: only drawings have them."""
        return {}

    def find(self, written: WrittenAnswer) -> TaskItem:
        """Return the item of an answer; an answer in millimetres is read from the picture.

        Raises
        ------
        NoValueError
        """
        position = written.position or 0
        if not 0 <= position < self.count:
            raise NoValueError(NoValue.NO_POSITION)
        if (declared := self.stated(written)) is not None:
            return declared
        spelled = {normalize(name): name for name in self.quantities.names}
        for text in filter(None, (written.what, written.id)):
            for name in (text, text.replace(" ", "_"), spelled.get(normalize(text), "")):
                question = self._question(name, position, drawn=written.mm is not None)
                if question is not None:
                    item = self._item(question, position, name)
                    return replace(item, id=written.id or item.id)
        raise NoValueError(NoValue.NO_QUANTITY)

    def written(self, item: TaskItem, written: WrittenAnswer) -> WrittenAnswer:
        """Return an answer in the unit of its key, its sense as the sign of its number."""
        written = super().written(item, written)
        per = ratio(written, item.question.unit)
        if per is None:
            return mark_unreadable(Unread.OTHER, written.unit, written.location, base=written)
        per = 1.0 if item.question.is_mm else per  # grading handles millimetres
        value, sense = written.value, written.sense
        if value is not None and sense is not None and sense.turns:
            value = math.copysign(value, 1.0 if sense.value == "ccw" else -1.0)
        return replace(
            written, value=None if value is None else value * per, step=written.step * per
        )

    def sheet(
        self,
        position: int,
        student_scales: Mapping[str, float] | None = None,
        ruler: float | None = None,
        *,
        drawn: str = "",
    ) -> CalculationSheet:
        """Return the numbers of a position, with all quantities requested so far."""
        profile = self.profile(ruler, drawn=drawn)
        asked = {q.id: q for (_, at, *_), q in self._question_cache.items() if at == position}
        key = (position, profile, tuple(asked))
        if key not in self._numbers:
            self._numbers[key] = CalculationSheet(
                self.quantities, position, asked.values(), profile
            )
        return self._numbers[key]

    def named(self, sheet: Sheet) -> list[Explanation]:
        """Return the usual mistakes, and the numbers of the other variants."""
        assert isinstance(sheet, CalculationSheet)
        found = []
        for code, where, take in self._mistaken():
            values = {}
            for question in sheet.requested:
                value = take(question.key.names[0], sheet.position)
                values[question.id] = sheet.exact_answers[question.id] if value is None else value
            found.append(Explanation(code, where, values, _EMPTY_TRACE, sheet))
        return found

    def find_matching_sheet(self, task: Task, mine: Sheet) -> Sheet | None:
        """Return another variant's numbers for the same quantities; None if one is missing."""
        assert isinstance(task, Calculation) and isinstance(mine, CalculationSheet)
        their = task.copy_for_submission()
        for name, at, drawn, turns in self._question_cache:
            if at == mine.position and their._question(name, at, drawn=drawn, turns=turns) is None:
                return None
        return their.sheet(mine.position)

    def _copied(self, sheet: CalculationSheet) -> Iterator[Explanation]:
        for variant, theirs in self.theirs(sheet):
            yield Explanation("P2", variant, theirs.exact_answers, _EMPTY_TRACE, sheet)

    # Judging ---------------------------------------------------------------------------------

    def diagnose(self, sheet: CalculationSheet, examined: list[ExaminedAnswer]) -> list[Diagnosis]:
        """Name the mistakes, and propagate their consequences."""
        diagnoses = diagnose_copied(self, sheet, examined)
        left = [one for one in examined if one.verdict is Verdict.WRONG]
        if diagnoses or not left:
            return diagnoses
        slipped = [*self._slipped(sheet, left, examined)]
        tried = [*self.named(sheet), *self._copied(sheet), *slipped]
        while left:
            scored = [(_explained(e, left), e) for e in tried if not _is_contradicted(e, examined)]
            most = max((score for score, _ in scored), default=0)
            if not most:
                diagnoses += [Diagnosis((), False, (one.item.id,)) for one in left]
                break
            best = max(e.prior for score, e in scored if score == most)
            chosen = [e for score, e in scored if score == most and e.prior == best]
            taken = [one for one in left if _predicts(chosen[0], one)]
            alike = [e for e in chosen if all(_predicts(e, one) for one in taken)]
            if len({e.mistake_at for e in alike}) > 1:  # the shortest formula
                formulas = [e.mistake_at for e in alike if " ≠ " in e.mistake_at]
                alike = [replace(e, mistake_at=min(formulas, key=len, default="")) for e in alike]
            fits = [ExplanationFit(e, 0.0, 0.0, most) for e in alike]
            diagnoses.append(propagate_mistake(self, sheet, taken, fits))
            left = [one for one in left if one not in taken]
        return diagnoses

    def _slipped(
        self, sheet: CalculationSheet, left: list[ExaminedAnswer], examined: list[ExaminedAnswer]
    ) -> list[Explanation]:
        """Return the slips in the numbers of answers; the same slip in several is one."""
        found: dict[tuple[str, str, str], Explanation] = {}
        for one in left:
            for code, place, value, prior in self._slips_of(sheet, one, examined):
                key = (code, place, "" if place else one.item.id)
                values = {**(found[key].values if key in found else sheet.exact_answers)}
                if _matches_wrong_answer(values[one.item.question.id], one):
                    continue
                values[one.item.question.id] = value
                found[key] = Explanation(code, place, values, _EMPTY_TRACE, sheet, prior=prior)
        return [*found.values()]

    def _slips_of(
        self, sheet: CalculationSheet, one: ExaminedAnswer, examined: list[ExaminedAnswer]
    ) -> Iterator[tuple[str, str, float, float]]:
        """Yield code, place, value and prior of the slips that give one number."""
        if not one.value:
            return

        def matches(value: float, rounding: float = 0.0) -> bool:
            return one.matches(value, rounding + _digit(one) / 2)

        question, name = one.item.question, one.item.question.key.names[0]
        relations, bases = self.relations(sheet.position), [one.limit.exact]
        for relation, own, steps in self._forward_relations(sheet, one, examined):
            bases.append(derive(parse_formula(relation.formula), relations.terms, own, steps)[0])
            for slip in find_slips(relations, relation, own, steps, matches):
                prior = EXACT_PRIOR if slip.code != "slip" else USUAL if slip.is_usual else RARE
                yield slip.code, slip.place, slip.value, prior
        quantity = self.quantities.quantity(name, sheet.position)
        turns = quantity is not None and quantity.turns
        codes = (one.codes for one in relations.relations if one.answer == name)
        sign, symbol = next(codes, {}).get("sign", "slip"), question.symbol
        for base in filter(math.isfinite, bases):
            near = OWN_ROUNDING * abs(base)
            if turns and matches(-base, near):
                yield "sign", "", -base, LOOSE
            changes = (sign, f"{MINUS}{symbol}", -1), ("slip", f"{symbol}/2", 0.5)
            for code, wrong, factor in (*changes, ("slip", f"2·{symbol}", 2)):
                if matches(base * factor, MIN_ROUNDING * abs(base)) and not (turns and factor < 0):
                    yield code, f"{wrong} ≠ {symbol}", base * factor, USUAL
            for code, factor in list_miswritings(question.unit):
                is_possible = bool(question.unit) or code != "S2"
                if is_possible and matches(base * factor, near * abs(factor)):
                    yield code, "", base * factor, 1.0
            turned = one.signed and one.value * base < 0
            room = near + one.step / 2
            if not turned and any(abs(x - abs(base)) <= room for x in swap_digits(one)):
                yield "S4", "", one.value, 1.0

    def _forward_relations(
        self, sheet: CalculationSheet, one: ExaminedAnswer, examined: list[ExaminedAnswer]
    ) -> Iterator[tuple[Relation, dict[str, float], dict[str, float]]]:
        """Yield the relations of an answer by earlier ones of the form, and a student's numbers."""
        relations = self.relations(sheet.position)
        names = {other.item.question.key.names[0]: other for other in examined}
        own, steps = _own_numbers(names)
        ranks = self._ranks(sheet.position, names)
        mine = one.item.question.key.names[0]
        for relation in relations.relations:
            keys = find_names(parse_formula(relation.formula))
            by = {relations.terms[key].answer for key in keys} - {""}
            if relation.answer == mine and all(ranks.get(key, 0) < ranks[mine] for key in by):
                yield relation, own, steps

    def _form_order(self, position: int) -> tuple[str, ...]:
        """Return the names of the requested quantities of a position."""
        if position not in self._orders:
            items = self.usual(position)
            self._orders[position] = tuple(item.question.key.names[0] for item in items)
        return self._orders[position]

    def _ranks(self, position: int, names: Iterable[str]) -> dict[str, int]:
        """Return the places of answers in the form; those that are not in it come last."""
        order = self._form_order(position)
        return {name: order.index(name) if name in order else len(order) for name in names}

    def replay(self, sheet: CalculationSheet, examined: list[ExaminedAnswer]) -> None:
        """Find the values that follow from the student's own answers."""
        for one in examined:
            slack = self.settings.k * one.limit.sigma + one.limit.minimum + one.step / 2
            one.slip = (
                one.value_from_mm is not None
                and abs(abs(one.value) - abs(one.value_from_mm)) > slack
            )
        relations = self.relations(sheet.position)
        names = {one.item.question.key.names[0]: one for one in examined}
        own, steps = _own_numbers(names)
        ranks = self._ranks(sheet.position, names)
        by_rank = sorted(names, key=lambda name: ranks[name])
        found = [
            (relation, *derive(parse_formula(relation.formula), relations.terms, own, steps))
            for relation in relations.relations
        ]
        for backwards in (False, True):  # answers are found in the order of the form, or not
            for name in by_rank:
                one = names[name]
                if backwards and (one.follows or one.right):
                    continue
                for relation, value, rounding, by in found:
                    if relation.answer != name or one.follows:
                        continue
                    later = any(ranks[key] > ranks[name] for key in by)
                    if by and math.isfinite(value) and later is backwards:
                        parents = [names[key] for key in by]
                        is_usual = relation.is_usual and not backwards
                        self._follow(one, value, rounding, parents, names, is_usual=is_usual)

    def _follow(
        self,
        one: ExaminedAnswer,
        value: float,
        rounding: float,
        parents: Sequence[ExaminedAnswer],
        names: Mapping[str, ExaminedAnswer],
        *,
        is_usual: bool,
    ) -> None:
        """Let an answer follow from others that give a value by a formula, or contradict them."""
        slack = max(self.settings.floor_share * abs(value), rounding) + one.step / 2
        apart = distance(one.item, one.value, value)
        if apart > slack and not (is_usual and one.local is None):
            return
        if would_circle(one, parents, [*names.values()]):
            return
        one.local, one.local_tolerance, one.computed = value, slack, True
        one.parents = {parent.item.id: abs(value) for parent in parents}
        one.follows, one.contradicts = apart <= slack, apart > slack * self.settings.near
        one.closely = one.follows

    def relations(self, position: int) -> Relations:
        """Return the relations of the requested quantities of a position."""
        names = [*self._form_order(position)]
        names += [name for name, at, *_ in self._question_cache if at == position]
        key = (position, tuple(dict.fromkeys(names)))
        if key not in self._relations:
            exact = {name: self.quantities.quantity(name, position) for name in key[1]}
            told = self.quantities.relations(key[1], position)
            values = {name: one.value for name, one in exact.items() if one is not None}
            self._relations[key] = keep_exact_relations(told, values)
        return self._relations[key]


def _own_numbers(
    names: Mapping[str, ExaminedAnswer],
) -> tuple[dict[str, float], dict[str, float]]:
    """Return the numbers of a student by their names, and the units of their last digits."""
    return {k: one.value for k, one in names.items()}, {k: _digit(x) for k, x in names.items()}


def _digit(one: ExaminedAnswer) -> float:
    """Return the unit of the last digit that counts: zeros at the end of 1130 may be rounded."""
    step, size = one.step, abs(one.value)
    while step and step < THREE_DIGITS * size and (size / step / 10).is_integer():
        step *= 10
    return step


def task_of_problem(
    kind: ProblemKind[Any],
    problem: KindProblem,
    settings: Settings,
    other_variants: Callable[[], Iterable[Task]] | None = None,
    *,
    verified: bool = True,
) -> Task:
    """Return a problem with its requested items, its answers drawn or computed.

    Where plans are drawn their motion is verified first: a key is made from it.
    """
    source = kind.answer_source(problem)
    if isinstance(source, Solution):
        if verified:
            verify(source)
        return Task(source, settings, other_variants)
    return Calculation(kind.table, problem, source, settings, other_variants)


def _question_of(name: str, quantity: AnswerValue, *, drawn: bool, turns: bool) -> Question:
    sign = (
        Sign.SIZE if not quantity.signed else Sign.TURN if turns and quantity.turns else Sign.STRICT
    )
    kind = QuantityKind.PICTURED if drawn else QuantityKind.COMPUTED
    value, own = quantity.value, f"{name} read" if drawn else name
    return Question(
        QuantityKey(kind, (name,)), own, quantity.symbol, quantity.unit, sign, lambda _: value, ()
    )


def _predicts(explanation: Explanation, one: ExaminedAnswer) -> bool:
    """Return whether an explanation gives a wrong answer."""
    given = explanation.values[one.item.question.id]
    if explanation.code == "P2" and one.step > COARSE * abs(one.value):
        return False
    return _matches_wrong_answer(given, one)


def _explained(explanation: Explanation, wrong: Sequence[ExaminedAnswer]) -> int:
    """Return how many wrong answers an explanation gives; one alone it must give closely."""
    given = [one for one in wrong if _predicts(explanation, one)]
    if len(given) == 1:
        value = explanation.values[given[0].item.question.id]
        off = distance(given[0].item, given[0].value, value)
        return int(off <= OWN_ROUNDING * abs(value) + _digit(given[0]) / 2)
    return len(given)


def _matches_wrong_answer(value: float, one: ExaminedAnswer) -> bool:
    """Return whether a value is a wrong answer, within its tolerance."""
    if not math.isfinite(value) or abs(value - one.limit.exact) <= one.limit.tolerance():
        return False
    share = max(abs(value / one.limit.exact), 0.3) if one.limit.exact else 1.0
    slack = math.hypot(one.limit.tolerance() * share, one.step / 2)
    return distance(one.item, one.value, value) <= slack


def _is_contradicted(explanation: Explanation, examined: list[ExaminedAnswer]) -> bool:
    """Return whether a student with this mistake could not have all these right answers."""
    for one in examined:
        given = explanation.values[one.item.question.id]
        off = distance(one.item, given, one.limit.exact)
        if one.right and one.sense_right is not False and not off <= one.limit.tolerance(one.step):
            return True
    return False
