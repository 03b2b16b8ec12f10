"""Slips with one number, and consequences of an answer: a mistake is counted once."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msgspec.structs import replace

from planmethod.check.explain import Explanation, ExplanationFit
from planmethod.check.grading import (
    ExaminedAnswer,
    distance,
    swap_digits,
    usable,
)
from planmethod.check.key import SEGMENT_CODES
from planmethod.check.mistakes.plans import Change, times
from planmethod.check.model import Diagnosis, Verdict
from planmethod.check.questions import Question
from planmethod.check.routes import (
    LENGTHS,
    OPERATIONS,
    describe_inversion,
    find_load_slips,
    find_route_slips,
)
from planmethod.check.sheet import Sheet, single_float, single_point
from planmethod.check.task import Task
from planmethod.check.variants import detect_copied_variant
from planmethod.construct.steps import (
    Compute,
    Name,
    NumberName,
    PointName,
    Step,
    operands,
    result_kind,
)
from planmethod.plans.model import FACTS, MOTION, PlanKind
from planmethod.problem.quantities import TURNINGS, QuantityKind, Sign

METRES = (1e3, 1e-3)
DEGREES = (180.0 / math.pi, math.pi / 180.0)
TURNS = (30.0 / math.pi, math.pi / 30.0, 1.0 / math.pi, math.pi)
UNITS = {
    **dict.fromkeys(("1/s", "1/min"), METRES + DEGREES + TURNS),
    **dict.fromkeys(("1/s²", "deg"), METRES + DEGREES),
}
"""Factors between units that are mixed up: mm and m, rev/min and 1/s, degrees and radians."""

PLACES = (10.0, 0.1, 100.0, 0.01, 1e4, 1e-4)

CLOSE = 0.03

READ = 0.15
"""Maximum relative error of misreading another segment; its likelihood follows from its errors."""


SAME = 2.5
"""Sigmas of reading that two readings of one segment differ by at most."""

ROUTE_SLIP = 2.0
"""Prior of a formula with one wrong factor that gives just the number written."""

BY_VALUE = 1.0
"""Prior of another scale of one segment whose millimetres are not given."""

ONE_END = 4.0
"""Prior of reading a whole segment for its last part, relative to any other segment."""


class Slip(NamedTuple):
    """A possible slip in one number (описка).

    Attributes
    ----------
    code, mistake_at : str
    value : float
        The number then, SI.
    prior : float
    of : float
        The base value: the right one, or that from the student's own earlier numbers; 0 if the slip
        has no base value.
    segment : NumberName or None
        Segment that is read in place of the right one.
    sigma : float
        Error of the number then; 0 for that of the right one in proportion.
    exact : bool
        Whether it gives the written number to its digits, from the student's own numbers.
    """

    code: str
    mistake_at: str
    value: float
    prior: float
    of: float = 0.0
    segment: NumberName | None = None
    sigma: float = 0.0
    exact: bool = False

    def change(self, sheet: Sheet, one: ExaminedAnswer) -> Change | None:
        """Return it as a mistake of the program; None if no step there computes the number."""
        question = one.item.question
        step = None if question.name is None else sheet.steps_by_name.get(question.name)
        if not isinstance(step, Compute) or not self.of:
            return None
        steps: tuple[Step, ...] = times(step, float(f"{self.value / self.of:.9g}"))
        read, last = self.segment, sheet.order[step.out]
        earlier = read is not None and sheet.order.get(read, last) < last  # so it can be read
        if read is not None and earlier and (question.length, 1) in step.powers:
            steps = (read_in_place(sheet, step, question.length, read),)
        return Change(self.code, self.mistake_at, {step.out: steps}, prior=self.prior)


def read_in_place(
    sheet: Sheet, step: Compute, right: NumberName | None, misread: NumberName
) -> Compute:
    """Return what a number is computed by when another segment is read; its sign stays."""
    powers = tuple((misread if name == right else name, power) for name, power in step.powers)
    turn = 1.0
    for name in (right, misread):
        if name is not None and single_float(sheet.exact_trace.value[name]) < 0:
            turn = -turn
    return replace(step, factor=step.factor * turn, powers=powers)


def find_slips(
    sheet: Sheet, one: ExaminedAnswer, examined: Sequence[ExaminedAnswer] = ()
) -> Iterator[Slip]:
    """Yield what may have been done with one number, also with those that it is computed from."""
    for made in (*find_route_slips(sheet, one, examined), *find_load_slips(sheet, one, examined)):
        value = math.copysign(made.value, one.limit.exact)
        yield Slip(made.code, made.mistake_at, value, ROUTE_SLIP, exact=True)
    base = one.limit.exact if one.local is None else one.local
    by_mm = one.value_from_mm if one.slip else None
    if by_mm:  # their own millimetres are the best evidence
        base = math.copysign(by_mm, base)
    if not base or not one.value:
        return
    ratio = abs(one.value / base)
    slack = max(CLOSE, 1.5 * one.limit.tolerance() / abs(one.limit.exact or base))
    slack = 0.5 * CLOSE if by_mm else slack

    def matches(factor: float) -> bool:
        return abs(ratio / factor - 1.0) <= min(slack, 0.3)

    for code, factor in list_miswritings(one.item.question.unit):
        if matches(factor):
            turns = one.item.question.key.kind in TURNINGS
            where = LENGTHS if code == "S2" and factor in METRES and turns else ""
            yield Slip(code, where, base * factor, 6.0, base)
    for swapped in swap_digits(one):
        if abs(abs(swapped / base) - 1.0) <= min(slack, 0.05) and abs(ratio - 1.0) > slack:
            yield Slip("S4", "", base * abs(one.value) / swapped, 0.2, base)
    for where, factor in _operations(sheet, one):
        if matches(factor):
            yield Slip("slip", where, base * factor, 0.5, base)
    yield from _scales(sheet, one, base, min(slack, 0.05))
    if not one.slip:
        yield from _read_twice(sheet, one, examined)
        yield from _segments(sheet, one, base, min(slack, 0.05))
    question = one.item.question
    if question.is_mm and question.plan is PlanKind.POSITION:
        true = sheet.scales[FACTS[PlanKind.POSITION].scale] * 1000.0
        if matches(true):
            yield Slip("true_mm", "", base * true, 1.0, base)


def list_miswritings(unit: str) -> Iterator[tuple[str, float]]:
    """Yield the factors of a number in another unit, or with its point moved, with their codes."""
    yield from (("S2", factor) for factor in UNITS.get(unit, METRES))
    yield from (("S4", factor) for factor in PLACES)


def _operations(sheet: Sheet, one: ExaminedAnswer) -> Iterator[tuple[str, float]]:
    """Yield what one wrong operation with the arm makes of a number: ``v·l ≠ v/l``, factor."""
    kind = one.item.question.key.kind
    name = one.item.question.name
    step = None if name is None else sheet.steps_by_name.get(name)
    if kind not in OPERATIONS or not isinstance(step, Compute) or len(step.powers) < 2:
        return
    letter, operation = OPERATIONS[kind]
    (first, power), *arm = step.powers
    right = math.prod(abs(single_float(sheet.exact_trace.value[n])) ** p for n, p in arm)
    if power != 1 or not right or (kind is QuantityKind.VELOCITY and not first.startswith("omega")):
        return
    length = right if operation == "·" else 1.0 / right
    value = abs(one.local or one.limit.exact) / right
    yield describe_inversion(kind), right**-2
    if value:
        yield f"l/{letter} ≠ {letter}{operation}l", length / value / (value * right)


def _scales(sheet: Sheet, one: ExaminedAnswer, base: float, tolerance: float) -> Iterator[Slip]:
    """Yield the value of a segment at another scale: by its millimetres, else by the right one."""
    question = one.item.question
    plan = question.plan
    if (
        plan is None
        or question.is_mm
        or question.length is None
        or question.unit != FACTS[plan].unit
    ):
        return
    own, sign = sheet.scales[question.scale], math.copysign(1.0, base)
    mm, slack, prior = abs(base) / own, tolerance, BY_VALUE
    if one.mm and one.value_from_mm is not None:
        mm, slack, prior = one.mm, 0.01, 20.0
    others = {sheet.scales[FACTS[other].scale] for other in MOTION} - {own}
    for code, scale in (("scale", 1.0), ("S1", 1.0 / own), *(("S3", other) for other in others)):
        if scale != own and abs(abs(one.value) / (mm * scale) - 1.0) <= slack:
            yield Slip(code, question.scale, sign * mm * scale, prior, base)


def _segments(sheet: Sheet, one: ExaminedAnswer, base: float, tolerance: float) -> Iterator[Slip]:
    """Yield the values of the other segments of the plan, read in place of the right one."""
    question = one.item.question
    length = sheet.length(question)
    if not length or question.plan not in SEGMENT_CODES or question.sign is Sign.STRICT:
        return
    if one.foreign and one.value_from_mm is not None and not one.slip:
        yield Slip(SEGMENT_CODES[question.plan], one.foreign, one.value, 200.0)
        return
    for name, other, read in [*_listed(sheet, question), *_wholes(sheet, question)]:
        share = other / length
        off = abs(abs(one.value / base) - share)
        if abs(share - 1.0) > tolerance and off <= READ * share > 0:
            prior = ONE_END if read is None else 0.5
            yield Slip(SEGMENT_CODES[question.plan], name, base * share, prior, base, read)


def _read_twice(
    sheet: Sheet, one: ExaminedAnswer, examined: Sequence[ExaminedAnswer]
) -> Iterator[Slip]:
    """Yield the student's other segments of the plan: two readings of one differ little."""
    question, profile = one.item.question, sheet.profile
    if (
        question.plan not in SEGMENT_CODES
        or question.sign is Sign.STRICT
        or question.length is None
    ):
        return
    sigma = (
        sheet.scales[question.scale]
        * math.sqrt(2)
        * math.hypot(profile.measure, profile.ruler / math.sqrt(12))
    )
    for other in examined:
        asked = other.item.question
        twice = other is not one and asked.plan is question.plan and asked.unit == question.unit
        if not (twice and asked.length and other.value) or other.verdict is Verdict.WRONG:
            continue
        if abs(abs(one.value) - abs(other.value)) <= SAME * sigma:
            shared = (
                question.ends is not None
                and asked.ends is not None
                and question.ends[1] == asked.ends[1]
            )
            code, prior = SEGMENT_CODES[question.plan], ONE_END if shared else 1.0
            value = math.copysign(other.value, one.limit.exact)
            yield Slip(code, asked.symbol, value, prior, sigma=sigma)


def _listed(sheet: Sheet, question: Question) -> Iterator[tuple[str, float, NumberName | None]]:
    """Yield the segments of a plan that are measured: letters, length, what it is called."""
    for segment in sheet.questions.construction.segments:
        if segment.kind is question.plan and segment.length in sheet.exact_trace.value:
            read = NumberName(segment.length)
            yield segment.name, abs(single_float(sheet.exact_trace.value[read])), read


def _wholes(sheet: Sheet, question: Question) -> Iterator[tuple[str, float, NumberName | None]]:
    """Yield what the right segment is the end of: of (nc), which is a^τ, (bc)."""
    if question.ends is None:
        return
    part, head = question.ends
    for plan in sheet.plans:
        for vector in plan.vectors if plan.kind is question.plan else ():
            if vector.head == part and vector.tail in sheet.exact_trace.value:
                ends = (sheet.exact_trace.value[end] for end in (vector.tail, head))
                yield (
                    f"{vector.tail}-{head}",
                    abs(single_point(next(ends)) - single_point(next(ends))),
                    None,
                )


def explain_by_value(sheet: Sheet, one: ExaminedAnswer, slip: Slip, *, free: bool) -> Explanation:
    """Return an explanation by one changed number; its consequences are found by `completed`."""
    question = one.item.question
    return Explanation(
        slip.code,
        slip.mistake_at,
        {**sheet.exact_answers, question.id: slip.value},
        sheet.exact_trace,
        sheet,
        first_answers=(one.item.id,),
        free=question.id if free else "",
        fixed="" if free else question.id,
        sigma=slip.sigma
        or (_misread_sigma(one, slip.value) if slip.code in SEGMENT_CODES.values() else None),
        prior=slip.prior,
    )


def _misread_sigma(one: ExaminedAnswer, value: float) -> float:
    """Return the sigma of a segment read in place of the right one."""
    exact = abs(one.limit.exact)
    return one.limit.sigma * (abs(value) / exact if exact else 1.0)


def completed(explanation: Explanation, one: ExaminedAnswer) -> Explanation:
    """Return an explanation of one number with all that follows from it on the right plans."""
    if one.slot is None or explanation.change is not None:
        return explanation
    sheet, name = explanation.sheet, one.item.question.id
    _, trace = sheet.replayed({one.slot: (abs(explanation.values[name]) / one.per_slot, False)})
    values = {**sheet.evaluate_answers(trace), name: explanation.values[name]}
    if not all(math.isfinite(number) for number in values.values()):
        return explanation
    return replace(explanation, values=values, trace=trace)


ALONG_LINK = ("V1", "N4")
"""Mistakes by which a vector lies along the link that it should turn."""

CLOSING = (QuantityKind.TANGENTIAL, QuantityKind.EPSILON, QuantityKind.SLIDING)
"""Closing vectors of a plan: their error is that of the longer vectors, however short they are."""


def diagnose_copied(task: Task, sheet: Sheet, examined: list[ExaminedAnswer]) -> list[Diagnosis]:
    """Return the diagnosis of another variant's numbers; empty if the student has their own."""
    other = detect_copied_variant(task, sheet, examined)
    fits = [] if other is None else [ExplanationFit(other, 0.0, 0.0, len(examined))]
    return [propagate_mistake(task, sheet, examined, fits)] if fits else []


def propagate_mistake(
    task: Task, sheet: Sheet, examined: list[ExaminedAnswer], ranked: Sequence[ExplanationFit]
) -> Diagnosis:
    """Return the diagnosis of a whole sheet; consequences of its mistake become inherited."""
    best = ranked[0].explanation
    codes = tuple(dict.fromkeys(fit.explanation.code for fit in ranked))
    sure = len(codes) == 1 and bool(codes[0])
    if sure and best.code == "P2":
        _disinherit(examined)
    wrong = [one for one in examined if one.verdict is Verdict.WRONG]
    begins = [one for one in wrong if one.item.id in best.first_answers]
    near = [one for one in examined if one.verdict is Verdict.NEAR and follows(one, best, 1.0)]
    changed = [one for one in (*wrong, *near) if not idle(sheet, one, best)]
    root = begins[0] if begins else _beginning(sheet, best, changed or wrong)
    root.verdict = Verdict.WRONG
    given = [best]
    if begins:
        best = completed(best, root)
        given = [best, completed(_with_student_value(best, root), root)]
    for one in examined:
        off = one.verdict in (Verdict.WRONG, Verdict.NEAR)
        if one is root or not off or best.code == "P2":
            continue
        if best.free and not usable(root):  # the plans cannot be continued with that value
            continue
        for made in given:
            moved = not idle(sheet, one, made) or _is_vector_reversed(one)
            own = one.item.question.id in ranked[0].predicted  # from the student's own numbers
            if moved and (own or follows(one, made, task.settings.near)):
                one.verdict, one.source = Verdict.INHERITED, root.item.id
    repoint(examined)
    if "" in codes:  # the best explanation is an unknown cause
        codes = () if ranked[0].explanation.code == "" else tuple(c for c in codes if c)
        sure = False
    roots = [root.item.id, *(one.item.id for one in wrong if one.verdict is Verdict.WRONG)]
    told, places = values_of(examined, best), _places(best)
    return Diagnosis(codes, sure, tuple(dict.fromkeys(roots)), best.mistake_at, told, places)


def _beginning(
    sheet: Sheet, explanation: Explanation, wrong: Sequence[ExaminedAnswer]
) -> ExaminedAnswer:
    """Return where a mistake begins; one made at several places at once, at the first asked."""
    steps = {} if explanation.change is None else explanation.change.steps
    made = [one for one in wrong if one.item.question.name in steps]
    if len(steps) > 1 and made:
        return made[0]
    return min(wrong, key=lambda one: (*rank(sheet, one)[:2], order_asked(sheet, one)))


def order_asked(sheet: Sheet, one: ExaminedAnswer) -> int:
    """Return the place of an answer among those of the sheet; one that is not asked is last."""
    ids = [question.id for question in sheet.requested]
    return ids.index(one.item.question.id) if one.item.question.id in ids else len(ids)


def _with_student_value(explanation: Explanation, root: ExaminedAnswer) -> Explanation:
    """Return an explanation with the number that the student wrote and continued with."""
    name = root.item.question.id
    own = math.copysign(root.value, explanation.values[name])
    values = {**explanation.values, name: own}
    return replace(explanation, values=values, change=None, program=None)


def _disinherit(examined: list[ExaminedAnswer]) -> None:
    """Keep credit for another variant's numbers only where they are right for the student's own."""
    for one in examined:
        one.follows, one.source = False, ""  # their mutual consistency earns no credit
        lost = (Verdict.INHERITED, Verdict.UNSEEN, Verdict.NEAR)
        if one.verdict in lost and not (one.right and one.sense_right is not False):
            one.verdict = Verdict.WRONG


def values_of(examined: list[ExaminedAnswer], explanation: Explanation) -> dict[str, float]:
    """Return what an explanation gives for the answers, by their ids."""
    return {one.item.id: explanation.values[one.item.question.id] for one in examined}


def _places(explanation: Explanation) -> dict[str, complex]:
    """Return the points of the velocity and acceleration plans of an explanation, m/s and m/s²."""
    sheet = explanation.sheet
    return {
        name: single_point(explanation.trace.value[name]) * sheet.scales[FACTS[plan.kind].scale]
        for plan in sheet.plans
        for name in plan.letters
        if name in explanation.trace.value
    }


def follows(one: ExaminedAnswer, explanation: Explanation, near: float) -> bool:
    """Return whether an answer is what an explanation gives."""
    given = explanation.values[one.item.question.id]
    exact = abs(one.limit.exact)
    least = 1.0 if one.item.question.key.kind in CLOSING else 0.3
    share = max(abs(given) / exact, least) if exact else 1.0
    tolerance = max(one.limit.tolerance(one.step), one.limit.spread) * near * share
    turned = one.sense_right is False and one.item.question.sign is Sign.TURN
    names = one.item.question.key.names
    if explanation.code in ALONG_LINK and names == (explanation.mistake_at,):
        turned = False  # a vector along the link turns it neither way
    if turned and given * one.limit.exact > 0:
        return False
    return distance(one.item, one.value, given) <= tolerance


def repoint(examined: list[ExaminedAnswer]) -> None:
    """Redirect every source to the first answer of its chain."""
    by_id = {one.item.id: one for one in examined}
    for one in examined:
        while one.source and by_id[one.source].source:
            one.source = by_id[one.source].source


def rank(sheet: Sheet, one: ExaminedAnswer) -> tuple[int, bool, int]:
    """Return how early on the plans an answer is found: by the last point that it needs."""
    name = one.slot
    if name is None:
        return (len(sheet.order), bool(one.parents), 0)
    return (
        _last_point(sheet, name),
        one.item.question.key.kind in TURNINGS,
        sheet.order[name],
    )


def _last_point(sheet: Sheet, name: Name) -> int:
    seen, todo, last = {name}, [name], -1
    while todo:
        step = sheet.steps_by_name[todo.pop()]
        if result_kind(step) is PointName:
            last = max(last, sheet.order[step.out])
            continue
        for other, _ in operands(step):
            if other not in seen:
                seen.add(other)
                todo.append(other)
    return last


def idle(sheet: Sheet, one: ExaminedAnswer, explanation: Explanation) -> bool:
    """Return whether an explanation leaves an answer as it is, its size and its sense."""
    given, exact = (
        explanation.values[one.item.question.id],
        sheet.exact_answers[one.item.question.id],
    )
    sign = one.item.question.sign
    told = one.signed if sign is Sign.TURN else sign is Sign.STRICT
    turned = told and given * exact < 0
    return not turned and abs(abs(given) - abs(exact)) <= one.limit.tolerance()


def _is_vector_reversed(one: ExaminedAnswer) -> bool:
    return one.sense_right is False and one.item.question.sign is Sign.SIZE
