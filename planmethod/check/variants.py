"""Answers that are the numbers of another variant (списанный вариант)."""

from __future__ import annotations

import math
from collections.abc import Mapping

from planmethod.check.explain import Explanation
from planmethod.check.grading import ExaminedAnswer, distance
from planmethod.check.sheet import Sheet
from planmethod.check.task import Task
from planmethod.problem.quantities import Sign

MIN_OFF_ANSWERS = 2
"""Answers that must be off before another variant is thought of."""

MIN_MATCH_FRACTION = 0.75
"""Minimum fraction of the distinguishing answers that must match the other variant."""

USUAL = math.log(9.0)
"""Wrong numbers are between a third and three times of the right one, anywhere."""

BY_CHANCE = 0.005
"""Maximum chance of a coincidental match for calling the answers another variant's."""

MIN_ERROR_FRACTION = 0.3
"""A small number of another variant is drawn no better than a third of the right one."""


def detect_copied_variant(
    task: Task, sheet: Sheet, examined: list[ExaminedAnswer]
) -> Explanation | None:
    """Return that the numbers are those of another variant; None where they are not surely.

    The predicted values are compared as written, without propagation: a copying student has
    all plans of the other variant, wherever their own numbers would lead.
    """
    if sum(not one.right for one in examined) < MIN_OFF_ANSWERS:
        return None
    best: tuple[float, float, str, Sheet] | None = None
    count, named = 0, task.named(sheet)
    for variant, theirs in task.theirs(sheet):
        count += 1
        apart = [one for one in examined if _distinguishes_variants(one, theirs.exact_answers)]
        hits = [one for one in apart if _matches(one, theirs.exact_answers)]
        if len(hits) < max(MIN_OFF_ANSWERS, MIN_MATCH_FRACTION * len(apart)):
            continue
        rivals = (e for e in named if not (e.code == "P1" and e.change and e.change.data))
        if any(all(_matches(one, rival.values) for one in hits) for rival in rivals):
            continue  # a mistake in their own variant fits too; another angle is the other variant
        free = [one for one in hits if not (one.follows and one.parents)]
        chance = math.fsum(math.log(min(1.0, _chance(one, theirs.exact_answers))) for one in free)
        off = math.fsum(_off(one, theirs.exact_answers) for one in hits) / len(hits)
        if best is None or (chance, off) < best[:2]:
            best = chance, off, variant, theirs
    if best is None or best[0] + math.log(count) > math.log(BY_CHANCE):
        return None
    return Explanation("P2", best[2], best[3].exact_answers, best[3].exact_trace, best[3])


def _tolerance(one: ExaminedAnswer, value: float) -> float:
    share = max(abs(value / one.limit.exact), MIN_ERROR_FRACTION) if one.limit.exact else 1.0
    return math.hypot(max(one.limit.tolerance(), one.limit.spread) * share, one.step / 2)


def _distinguishes_variants(one: ExaminedAnswer, values: Mapping[str, float]) -> bool:
    value = values[one.item.question.id]
    if not math.isfinite(value):
        return False
    own = max(one.limit.tolerance(one.step), one.limit.spread)
    if one.signed and one.item.question.sign is Sign.TURN and value * one.limit.exact < 0:
        return not one.limit.zero
    return distance(one.item, value, one.limit.exact) > own + _tolerance(one, value)


def _matches(one: ExaminedAnswer, values: Mapping[str, float]) -> bool:
    value = values[one.item.question.id]
    turned = one.signed and one.item.question.sign is Sign.TURN and one.value * value < 0
    return not turned and _off(one, values) <= 1.0


def _off(one: ExaminedAnswer, values: Mapping[str, float]) -> float:
    value = values[one.item.question.id]
    return distance(one.item, one.value, value) / _tolerance(one, value)


def _chance(one: ExaminedAnswer, values: Mapping[str, float]) -> float:
    value = values[one.item.question.id]
    return 2.0 * _tolerance(one, value) / (abs(value) or one.step or 1.0) / USUAL
