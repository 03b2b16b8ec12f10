"""Verdicts on answers, by exact and by the student's own values; numbers of another variant."""

# Cyrillic letters: the unit mm, as works of students write it

from __future__ import annotations

import math
import re
from cmath import phase
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial
from itertools import pairwise

import numpy as np
from msgspec import Struct, field

from planmethod.check.explain import Fact
from planmethod.check.marks import Settings
from planmethod.check.model import PencilTrace, Verdict, WrittenAnswer
from planmethod.check.sheet import Local, Sheet, StudentValues, is_right, single_float
from planmethod.check.task import Task, TaskItem
from planmethod.check.tolerance import Tolerance, limit_of
from planmethod.construct.evaluate import Trace
from planmethod.construct.steps import Name, NumberName
from planmethod.plans.model import FACTS, MOTION, PlanKind
from planmethod.problem.quantities import TURNINGS, QuantityKind, Sign
from planmethod.solved.quantity_steps import NoValueError

USABLE = 3.0
"""An earlier number may be off by this factor for others to follow from it (Numbas)."""

MIN_SENSITIVITY = 1e-6
"""Share of an answer that a change of an earlier one by as much of itself must move it by."""

MIN_DRAWN_SIGMA = 0.004
"""Share of a number that is drawn which its sigma is at least."""

MIN_ARM_SIGMA = 0.015
"""The same of ω and ε, for which only the arm is measured."""

MAX_DIRECTION_ERROR_DEG = 45.0
"""Angle in degrees from which a vector counts as differently directed."""

MAX_OWN_SPREAD = 0.5
"""Share of a number, drawn on a student's own plan, that its tolerance may be: above it the answer
follows from a number that is surely wrong, not from one that the drawing cannot show."""

LAID_OFF_KINDS = (QuantityKind.NORMAL, QuantityKind.CORIOLIS)
"""Vectors that are computed and laid off."""

MILLIMETRES = ("mm", "мм")


class ExaminedAnswer(Struct):
    """One answer under examination (рассматриваемый ответ).

    Attributes
    ----------
    item : TaskItem
    written : WrittenAnswer
    limit : Tolerance
    value : float
        SI, signed if the student gives a sign.
    signed : bool
        Whether the sign is the student's.
    step : float
        Unit of its last digit, SI.
    mm : float or None
        Length of its segment on the student's plan.
    foreign : str
        Letters of another segment of the plan than the answer's, if the student's mm belong to it.
    value_from_mm : float or None
        Value of the student's millimetres at the student's scale, if both are given.
    slot : NumberName or None
        First number of the program that the student's own number replaces.
    per_slot : float
        Value of that number's unit in the unit of the answer.
    """

    item: TaskItem
    written: WrittenAnswer
    limit: Tolerance
    value: float
    signed: bool
    step: float
    mm: float | None = None
    foreign: str = ""
    value_from_mm: float | None = None
    slot: NumberName | None = None
    per_slot: float = 1.0
    right: bool = False
    near: bool = False
    sense_right: bool | None = None
    local: float | None = None
    local_tolerance: float | None = None
    follows: bool | None = None
    contradicts: bool = False
    slip: bool = False
    parents: dict[str, float] = field(default_factory=dict)
    verdict: Verdict = Verdict.WRONG
    source: str = ""
    computed: bool = False
    stroke: PencilTrace | None = None
    routed: bool = False
    closely: bool = False

    @property
    def off(self) -> float:
        """Distance from the exact value."""
        return distance(self.item, self.value, self.limit.exact)

    def matches(self, value: float, tolerance: float) -> bool:
        """Return whether a value is the student's number, and has its sign if that is given."""
        is_opposite = self.signed and self.value * value < 0
        return not is_opposite and distance(self.item, self.value, value) <= tolerance

    @property
    def miscomputed(self) -> bool:
        """True if the value differs from its computation from the student's own numbers."""
        if self.local is None or self.local_tolerance is None or not self.computed:
            return False
        return self.contradicts and abs(abs(self.value) - abs(self.local)) > self.local_tolerance


def distance(item: TaskItem, value: float, reference: float) -> float:
    """Return the distance of two values of an answer: of sizes, of numbers, of angles."""
    match item.question.sign:
        case Sign.ANGLE:
            return abs((value - reference + 180.0) % 360.0 - 180.0)
        case Sign.STRICT:
            return abs(value - reference)
    return abs(abs(value) - abs(reference))  # a sense is graded separately


class UnusableError(Exception):
    """An answer cannot be graded; the message is for the student."""


def examine(task: Task, sheet: Sheet, item: TaskItem, written: WrittenAnswer) -> ExaminedAnswer:
    """Take an answer as the sheet has it.

    Raises
    ------
    UnusableError
        When its millimetres have no scale.
    """
    question = item.question
    limit = limit_of(sheet, question, task.settings, item.fixed)
    value, mm, step = written.value, written.mm, written.step
    if question.is_mm:
        value, step = _in_mm(sheet, item, written)
        mm = None
    told = None
    if mm is not None and not question.is_mm:
        told = _value_from_mm(sheet, item, mm)
        if value is None:
            if told is None:
                raise UnusableError("mm")
            value, step = told, written.mm_step * abs(told / mm) if mm else 0.0
            told = None
    assert value is not None
    signed = question.sign in (Sign.STRICT, Sign.ANGLE)
    if question.sign is Sign.TURN:
        sense = written.sense
        if sense is not None and sense.turns:
            value, signed = abs(value) * (1.0 if sense.value == "ccw" else -1.0), True
        elif value < 0:
            signed = True
    elif question.sign is Sign.SIZE:
        value = abs(value)
    foreign = _foreign(sheet, item, written) if mm is not None else ""
    found = ExaminedAnswer(item, written, limit, value, signed, step, mm, foreign, told)
    found.sense_right = _sense(sheet, found)
    found.right = limit.allows(found.off, abs(value), step)
    found.near = limit.allows(found.off, abs(value), step, task.settings.near)
    return found


def _foreign(sheet: Sheet, item: TaskItem, written: WrittenAnswer) -> str:
    """Return the letters of the segment that the student read, if it is not the answer's."""
    question = item.question
    if not written.segment or question.plan is None or question.length is None:
        return ""
    try:
        _, length = sheet.questions.segment(question.plan, written.segment)
    except NoValueError:
        return ""
    return "" if length == question.length else written.segment


def _in_mm(sheet: Sheet, item: TaskItem, written: WrittenAnswer) -> tuple[float, float]:
    """Return a length on a plan and the unit of its last digit, mm: of a true length in m too."""
    if written.mm is not None:
        return written.mm, written.mm_step
    assert written.value is not None
    unit = written.unit.strip().lower()
    factor = 1.0 if not unit else 1000.0
    if unit and unit not in MILLIMETRES and item.question.plan is PlanKind.POSITION:
        factor = 1.0 / sheet.scales[item.question.scale]
    return written.value * factor, written.step * factor


def _value_from_mm(sheet: Sheet, item: TaskItem, mm: float) -> float | None:
    """Return the answer's value from a length on the student's plan; None if it is undetermined."""
    question = item.question
    plan = question.plan
    if plan is None or question.key.kind in TURNINGS or question.unit != FACTS[plan].unit:
        length = sheet.length(question)
        return abs(sheet.exact_answers[question.id]) * mm / length if length else None
    return mm * sheet.scales[question.scale]


def _sense(sheet: Sheet, answer: ExaminedAnswer) -> bool | None:
    """Return whether the stated sense is right; None if none is stated."""
    question, sense = answer.item.question, answer.written.sense
    if answer.limit.zero or question.sign in (Sign.STRICT, Sign.ANGLE):
        return None
    if sense is not None:
        return is_right(sheet, question, sense)
    if answer.signed:
        return answer.value * answer.limit.exact > 0
    return None


# His own numbers -----------------------------------------------------------------------------


def collect_student_values(
    sheet: Sheet, examined: list[ExaminedAnswer], *, values: bool = False
) -> StudentValues:
    """Return a student's own numbers by the program's numbers that they replace.

    Parameters
    ----------
    values : bool
        Only the stated values of segments, without their lengths at the student's scale.
    """
    own: dict[NumberName, tuple[float, bool]] = {}

    def add(name: NumberName | None, value: float, signed: bool) -> None:
        if name is not None and name in sheet.order:
            own.setdefault(name, (value, signed))

    for one in examined:
        question = one.item.question
        name, length = question.name, question.length
        if name is None or (one.limit.zero and one.right):  # too short to be read: no information
            continue
        one.slot, one.per_slot = slot_of(sheet, one)
        if one.slot != name and not values:
            read = one.mm is not None and not one.foreign
            mm = one.mm if one.mm is not None and read else one.value / one.per_slot
            add(one.slot, mm, False)
        if one.slot == name or values or one.value_from_mm is not None:
            add(name, one.value, one.signed)
        if one.mm is not None and not one.foreign:
            add(length, one.mm, False)
    return own


def slot_of(sheet: Sheet, one: ExaminedAnswer) -> tuple[NumberName | None, float]:
    """Return the first number of the program that an answer determines, and its value per unit."""
    question = one.item.question
    name, length = question.name, question.length
    direct = name != length and question.key.kind not in TURNINGS
    if name is None or length is None or not direct:
        return name, 1.0
    if sheet.order[length] < sheet.order[name]:
        return length, sheet.scales[question.scale]
    return name, 1.0


class Derived(Struct):
    """What a student's own numbers give for an answer (следствие своих чисел).

    Attributes
    ----------
    local, tolerance : float
    sigma, reading : float
        Error of drawing that is left; that of an answer which may be read from the plan.
    rounding : float
        By the digits written of the earlier answers.
    parents : dict of str to float
        How much each earlier answer has a part in it.
    """

    local: float
    tolerance: float
    sigma: float
    reading: float
    rounding: float
    parents: dict[str, float]

    def is_reversed(self, one: ExaminedAnswer) -> bool:
        """Return whether an answer turns the other way."""
        return one.signed and one.value * self.local < 0 and one.item.question.sign is Sign.TURN

    def matches(self, one: ExaminedAnswer) -> bool:
        """Return whether an answer is as the student's own numbers give it."""
        apart = distance(one.item, one.value, self.local)
        return apart <= self.tolerance and not self.is_reversed(one)


def derive(
    sheet: Sheet,
    values: StudentValues,
    examined: Sequence[ExaminedAnswer],
    settings: Settings,
    lengths: Mapping[Name, float],
    left: Local,
) -> Iterator[tuple[ExaminedAnswer, Derived]]:
    """Yield answers, and what plans that are drawn with the student's own numbers give for each.

    Parameters
    ----------
    lengths, left : mapping, Local
        Values that the numbers replace on these plans, and the errors that are left.
    """
    by_slot: dict[Name, ExaminedAnswer] = {}
    for one in examined:
        if one.slot is not None:
            by_slot.setdefault(one.slot, one)
            if one.item.question.name is not None:
                by_slot.setdefault(one.item.question.name, one)
            if one.mm is not None and one.item.question.length is not None:
                by_slot.setdefault(one.item.question.length, one)
    for one in examined:
        slot, parents, rounding = one.slot, dict[str, float](), 0.0
        if slot is None or not math.isfinite(lengths.get(slot, math.nan)):
            continue
        local = lengths[slot] * one.per_slot
        for (name, earlier), slope in left.slopes.items():
            if name != slot:
                continue
            parent = by_slot.get(earlier)
            if parent is None or parent is one:
                continue
            # One that is next to nothing, as a forgotten 1000 makes it, matters as the right one.
            right = abs(single_float(sheet.exact_trace.value[earlier]))
            share = abs(slope) * max(abs(values[NumberName(earlier)][0]), right) * one.per_slot
            if share > MIN_SENSITIVITY * abs(local):
                parents[parent.item.id] = max(parents.get(parent.item.id, 0.0), share)
                rounding += abs(slope) * one.per_slot * _step_of(parent, earlier) / 2
        sigma = left.sigma[slot] * one.per_slot
        reading = max(sigma, _reading_error(sheet, one))
        least = max(settings.floor_share * abs(local), one.limit.per_mm * settings.floor_mm / 2)
        tolerance = max(math.hypot(settings.k * reading, one.step / 2) + rounding, least)
        yield one, Derived(local, tolerance, sigma, reading, rounding, parents)


def replay(task: Task, sheet: Sheet, examined: list[ExaminedAnswer]) -> None:
    """Find the values that follow from a student's own earlier numbers, for every answer."""
    own = collect_student_values(sheet, examined)
    if not own:
        return
    settings = task.settings
    came, _ = sheet.replayed(own)
    left = _left_on_own_plans(sheet, own, examined, settings.near)
    for one in examined:
        slot = one.slot
        if one.value_from_mm is not None:
            slack = abs(one.value_from_mm) * (
                settings.floor_share + one.written.mm_step / 2 / max(one.mm or 1.0, 1e-9)
            )
            # A number that was computed is laid off by a ruler.
            slack = max(slack, settings.floor_mm * one.limit.per_mm)
            if one.item.question.key.kind in TURNINGS:
                slack += settings.k * left.sigma.get(slot, 0.0) if slot else 0.0
            one.slip = abs(abs(one.value) - abs(one.value_from_mm)) > slack + one.step / 2 + 1e-12
    for one, found in derive(sheet, own, examined, settings, came, left):
        one.stroke = _stroke(one, found.local, found.sigma)
        one.parents = found.parents
        unseen = settings.k * found.reading > settings.cap * abs(found.local)
        if not one.parents or (unseen and not one.limit.zero and one.right):
            continue  # the student's plan cannot show it
        one.local, one.local_tolerance = found.local, found.tolerance
        one.follows = found.matches(one)
        apart = distance(one.item, one.value, found.local)
        turned = found.is_reversed(one)
        written = settings.floor_share * abs(found.local) + found.rounding + one.step / 2
        one.closely = one.follows and apart <= written
        one.contradicts = apart > found.tolerance * settings.near or turned
        least = MIN_ARM_SIGMA if one.item.question.key.kind in TURNINGS else MIN_DRAWN_SIGMA
        one.computed = found.sigma < least * abs(found.local)
    _try_without_rates(sheet, own, examined)


def _step_of(parent: ExaminedAnswer, name: Name) -> float:
    """Return the unit of the last digit of an earlier number, in its own unit."""
    if name == parent.item.question.length and parent.mm is not None:
        return parent.written.mm_step
    return parent.step / parent.per_slot if name == parent.slot else 0.0


def _reading_error(sheet: Sheet, one: ExaminedAnswer) -> float:
    """Return the sigma of an answer that may be read from a plan, though it can be computed."""
    if not _is_readable(one):
        return 0.0
    return math.hypot(sheet.profile.point, sheet.profile.measure) * one.limit.per_mm


def _is_readable(one: ExaminedAnswer) -> bool:
    """Return whether an answer is a vector of a plan that need not be computed."""
    question = one.item.question
    return question.plan in MOTION and question.key.kind not in (*LAID_OFF_KINDS, *TURNINGS)


def _try_without_rates(
    sheet: Sheet, student_values: StudentValues, examined: list[ExaminedAnswer]
) -> None:
    """Accuse no answer that follows where a wrong ω was not used: aⁿ may be v²/l."""
    accused = [one for one in examined if one.right and one.contradicts]
    wrong = {
        one.slot
        for one in examined
        if one.item.question.key.kind is QuantityKind.OMEGA and not one.right
    }
    if not accused or not wrong:
        return
    came, _ = sheet.replayed(
        {name: put for name, put in student_values.items() if name not in wrong}
    )
    for one in accused:
        if one.slot not in came or one.slot is None:
            continue
        local = came[one.slot] * one.per_slot
        tolerance = max(one.local_tolerance or 0.0, one.limit.tolerance(one.step))
        if distance(one.item, one.value, local) <= tolerance:
            one.local, one.contradicts = local, False


def _left_on_own_plans(
    sheet: Sheet, student_values: StudentValues, examined: list[ExaminedAnswer], near: float
) -> Local:
    """Return the errors left by the student's numbers: on plans with them, if any is far off."""
    if any(not one.limit.allows(one.off, abs(one.value), one.step, near) for one in examined):
        with suppress(ZeroDivisionError, OverflowError, FloatingPointError):
            with np.errstate(all="ignore"):
                left = sheet.localised(student_values, sheet.program, sheet.data, student_values)
            if all(map(math.isfinite, left.sigma.values())):
                return left
    return sheet.local(student_values)


def _stroke(one: ExaminedAnswer, local: float, sigma: float) -> PencilTrace | None:
    """Return the drafting error left in a reading; None for a computed or zero value."""
    if sigma < MIN_DRAWN_SIGMA * abs(local) or not sigma or one.limit.zero:
        return None
    apart = abs(one.value) - abs(local) if not one.signed else one.value - local
    return PencilTrace(apart / sigma, one.step / sigma)


# Verdicts ------------------------------------------------------------------------------------


def usable(one: ExaminedAnswer) -> bool:
    """Return whether other answers can follow from a wrong one."""
    exact, value = abs(one.limit.exact), abs(one.value)
    return exact > 0 and exact / USABLE <= value <= exact * USABLE


def assign_verdicts(sheet: Sheet, examined: list[ExaminedAnswer], near: float) -> None:
    """Give every answer its verdict, in the order in which the plans find them."""
    by_id = {one.item.id: one for one in examined}

    def order(one: ExaminedAnswer) -> int:
        return sheet.order.get(one.slot, len(sheet.order)) if one.slot else len(sheet.order)

    for one in _parents_first(sorted(examined, key=order), by_id):
        earlier = sorted(one.parents.items(), key=lambda pair: -pair[1])
        parents = [by_id[name] for name, _ in earlier]
        wrong = [
            parent
            for parent in parents
            if parent.verdict in (Verdict.WRONG, Verdict.INHERITED, Verdict.NEAR)
        ]
        unseen = [p for p in parents if p.verdict is Verdict.UNSEEN and not p.right]
        if one.local and (one.local_tolerance or 0.0) > MAX_OWN_SPREAD * abs(one.local):
            wrong, unseen = [p for p in wrong if p.verdict is not Verdict.NEAR], []
        is_incompatible = one.contradicts and any(
            _is_incompatible(one, parent, examined) for parent in wrong
        )
        one.verdict = _verdict(one, [*wrong, *unseen], is_incompatible, near)
        if one.verdict is Verdict.INHERITED:
            worst = [*sorted(wrong, key=lambda parent: parent.verdict is Verdict.NEAR), *unseen]
            parent = next((p for p in worst if usable(p)), worst[0])
            one.source = parent.source or parent.item.id


def _is_incompatible(
    one: ExaminedAnswer, parent: ExaminedAnswer, examined: list[ExaminedAnswer]
) -> bool:
    """Return whether a right answer cannot come from the work in which an earlier one is wrong.

    Other answers follow from the wrong one, or a formula needs it. A plan may be right where a
    length is misread on it.
    """
    read = _is_readable(one)
    if read and parent.item.question.ends and parent.slot == parent.item.question.length:
        return False
    went_on = parent.verdict is Verdict.INHERITED or any(
        other.follows and not other.right and parent.item.id in other.parents
        for other in examined
        if other is not one
    )
    return went_on or not read


def swap_digits(one: ExaminedAnswer) -> Iterator[float]:
    """Yield the student's number with two neighbouring digits swapped back, SI, without a sign."""
    written, value = one.written.raw, one.written.value
    digits = [m.start() for m in re.finditer(r"\d", written)]
    if not value or not written or len(digits) > 8:
        return
    try:
        shown = float(written.replace(",", "."))
    except ValueError:
        return
    if not shown:
        return
    for first, second in pairwise(digits):
        letters = list(written)
        letters[first], letters[second] = letters[second], letters[first]
        if letters != list(written):
            yield abs(float("".join(letters).replace(",", ".")) * value / shown)


def _parents_first(
    examined: list[ExaminedAnswer], by_id: dict[str, ExaminedAnswer]
) -> Iterator[ExaminedAnswer]:
    """Yield answers, each after those that it follows from."""
    done: set[str] = set()

    def reached(one: ExaminedAnswer) -> Iterator[ExaminedAnswer]:
        if one.item.id not in done:
            done.add(one.item.id)
            for name in one.parents:
                yield from reached(by_id[name])
            yield one

    for one in examined:
        yield from reached(one)


def _verdict(
    one: ExaminedAnswer, off: list[ExaminedAnswer], is_incompatible: bool, near: float
) -> Verdict:
    inherits = bool(one.follows) and bool(off)
    sense = one.sense_right is not False
    if not one.limit.is_visible:
        within = one.off <= max(one.limit.spread, one.limit.maximum)
        if within and sense:
            if is_incompatible and one.right:
                return Verdict.INCONSISTENT
            miscomputed = one.contradicts and not (one.right or off)
            return Verdict.WRONG if miscomputed else Verdict.UNSEEN
        if inherits:
            return Verdict.INHERITED
        if one.follows and sense:
            return Verdict.UNSEEN
        far = one.off > near * max(one.limit.spread, one.limit.maximum)
        return Verdict.WRONG if far or one.contradicts or not sense else Verdict.UNSEEN
    if one.right and sense:
        return Verdict.INCONSISTENT if is_incompatible else Verdict.OK
    if inherits:
        return Verdict.INHERITED
    if one.limit.zero and one.follows and sense:  # as on their own plan; the right one hides it
        return Verdict.UNSEEN
    if one.computed and one.closely and sense:  # from right numbers, rounded as they are
        return Verdict.OK
    if one.near and sense and not one.slip:
        return Verdict.NEAR
    return Verdict.WRONG


# Facts for the diagnosis ---------------------------------------------------------------------


def facts_of(sheet: Sheet, examined: list[ExaminedAnswer], k: float) -> list[Fact]:
    """Return what an explanation has to give: every answer of a sheet, each quantity once."""
    facts: dict[str, Fact] = {}
    ways = {
        one.item.question.key: one.value
        for one in examined
        if one.item.question.sign is Sign.ANGLE and not one.routed
    }
    for one in examined:
        question = one.item.question
        if question.sign is Sign.ANGLE or one.routed or (one.limit.zero and one.right):
            continue
        strict = question.sign is Sign.STRICT
        sense: Callable[[Trace], bool | None] | None = None
        if not strict and not one.limit.zero and one.sense_right is not None:
            sense = partial(_is_sense_right, sheet, one)
        elif question.ends is not None and not one.limit.zero and question.key in ways:
            sense = partial(_directed, sheet, one, ways[question.key])
        least = max(0.4 * min(one.limit.minimum, 0.02 * abs(one.limit.exact)), 1e-9) / k
        # Computed: a small one is as exact as a large one.
        if question.key.kind in TURNINGS and one.value:
            least = min(least, 0.003 * abs(one.value))
        least = max(least, 0.002 * abs(one.value)) if one.value else min(least, 1e-9)
        value = one.value if strict else abs(one.value)
        turned = one.signed and question.sign is Sign.TURN
        turn = math.copysign(1.0, one.value) if turned else 0.0
        facts.setdefault(
            question.id,
            Fact(
                question.id,
                value,
                strict,
                one.step,
                least,
                one.slot,
                one.per_slot,
                question.name,
                turn,
                sense,
            ),
        )
    return list(facts.values())


def _directed(sheet: Sheet, one: ExaminedAnswer, degrees: float, trace: Trace) -> bool | None:
    """Return whether a vector of a sheet agrees with the direction angle of the student."""
    vector = sheet.vector(one.item.question, trace)
    if vector is None or not abs(vector) > 0:
        return None
    off = math.degrees(phase(vector)) - degrees
    return abs((off + 180.0) % 360.0 - 180.0) < MAX_DIRECTION_ERROR_DEG


def _is_sense_right(sheet: Sheet, one: ExaminedAnswer, trace: Trace) -> bool | None:
    if one.written.sense is not None:
        return is_right(sheet, one.item.question, one.written.sense, trace)
    return single_float(one.item.question.evaluate(trace)) * one.value > 0
