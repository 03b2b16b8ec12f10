"""Consequences of a recognised mistake: it is counted once, where it begins (что следует)."""

from __future__ import annotations

import math
from collections.abc import Sequence

from msgspec.structs import replace

from planmethod.check.explain import Explanation, ExplanationFit
from planmethod.check.grading import ExaminedAnswer, distance, usable
from planmethod.check.model import Diagnosis, Verdict
from planmethod.check.questions import RATES, Sign
from planmethod.check.sheet import Sheet, single_point
from planmethod.check.slips import completed
from planmethod.check.task import Task
from planmethod.construct.steps import Name, PointName, operands, result_kind
from planmethod.plans.model import FACTS

CLOSING = ("at", "epsilon", "vs")
"""Closing vectors of a plan: their error is that of the longer vectors, however short they are."""


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
    changed = [one for one in wrong if not idle(sheet, one, best)]
    root = begins[0] if begins else min(changed or wrong, key=lambda one: rank(sheet, one))
    given = [best]
    if begins:
        best = completed(best, root)
        given = [best, completed(_with_student_value(best, root), root)]
    for one in examined:
        if one is root or one.verdict is not Verdict.WRONG or best.code == "P2":
            continue
        if best.free and not usable(root):  # the plans cannot be continued with that value
            continue
        for made in given:
            moved = not idle(sheet, one, made) or _is_vector_reversed(one)
            if moved and follows(one, made, task.settings.near):
                one.verdict, one.source = Verdict.INHERITED, root.item.id
    repoint(examined)
    if "" in codes:  # the best explanation is an unknown cause
        codes = () if ranked[0].explanation.code == "" else tuple(c for c in codes if c)
        sure = False
    roots = [root.item.id, *(one.item.id for one in wrong if one.verdict is Verdict.WRONG)]
    told, places = values_of(examined, best), _places(best)
    return Diagnosis(codes, sure, tuple(dict.fromkeys(roots)), best.mistake_at, told, places)


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
    least = 1.0 if one.item.question.selector.kind in CLOSING else 0.3
    share = max(abs(given) / exact, least) if exact else 1.0
    tolerance = max(one.limit.tolerance(one.step), one.limit.spread) * near * share
    turned = one.sense_right is False and one.item.question.sign is Sign.TURN
    if turned and given * one.limit.exact > 0:
        return False
    return distance(one.item, one.value, given, signed=one.signed) <= tolerance


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
    return (_last_point(sheet, name), one.item.question.selector.kind in RATES, sheet.order[name])


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
