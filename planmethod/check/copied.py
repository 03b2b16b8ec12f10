"""Copied submissions: another variant's numbers, another student's drawing (списанные работы)."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from itertools import combinations

from msgspec.structs import replace

from planmethod.check.explain import Explanation, exceeds
from planmethod.check.grading import ExaminedAnswer, distance
from planmethod.check.model import GradedSubmission
from planmethod.check.questions import Sign
from planmethod.check.sheet import Sheet
from planmethod.check.task import Task

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

MAX_MATCH_CHANCE = 0.01
"""Maximum chance, over a whole group, that two submissions are this close by coincidence."""

MIN_READINGS = 4
"""Minimum number of readings for comparing two submissions."""

BOUND = 4.0
"""Sigmas beyond which a reading is a mistake, not a drafting error: two students may share one."""

MIN_HAND_ERROR = 0.15
"""Minimum drafting error of any student, as a fraction of the profile's."""


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
    return distance(one.item, value, one.limit.exact, signed=one.signed) > own + _tolerance(
        one, value
    )


def _matches(one: ExaminedAnswer, values: Mapping[str, float]) -> bool:
    value = values[one.item.question.id]
    turned = one.signed and one.item.question.sign is Sign.TURN and one.value * value < 0
    return not turned and _off(one, values) <= 1.0


def _off(one: ExaminedAnswer, values: Mapping[str, float]) -> float:
    value = values[one.item.question.id]
    return distance(one.item, one.value, value, signed=one.signed) / _tolerance(one, value)


def _chance(one: ExaminedAnswer, values: Mapping[str, float]) -> float:
    value = values[one.item.question.id]
    return 2.0 * _tolerance(one, value) / (abs(value) or one.step or 1.0) / USUAL


# In a group ----------------------------------------------------------------------------------


def mark_similar_submissions(works: Iterable[GradedSubmission]) -> list[GradedSubmission]:
    """Return submissions, marking those whose readings agree better than two drawings can.

    Every stroke errs by itself. What is left of a reading when the earlier numbers are given is
    a fingerprint of the drawing: for two independent submissions it differs by √2 of a sigma.
    """
    whole = list(works)
    alike: dict[int, list[str]] = defaultdict(list)
    same: dict[str | None, list[int]] = defaultdict(list)
    for number, checked in enumerate(whole):
        same[checked.variant].append(number)
    pairs = [pair for numbers in same.values() for pair in combinations(numbers, 2)]
    for one, two in pairs:
        chance = match_chance(whole[one], whole[two])
        if chance * len(pairs) < MAX_MATCH_CHANCE:
            alike[one].append(whole[two].work.student)
            alike[two].append(whole[one].work.student)
    return [
        replace(w, similar_students=tuple(alike[n])) if n in alike else w
        for n, w in enumerate(whole)
    ]


def match_chance(one: GradedSubmission, two: GradedSubmission) -> float:
    """Return the chance that two independent submissions agree as well in all readings (Fisher).

    Each reading gives the chance that two drawings agree so well; twice the negative logarithms add
    up to chi-squared with two degrees of freedom each.
    """
    hands = _hand_error(one), _hand_error(two)
    logs = list(_agreements(one, two, math.hypot(*hands)))
    if len(logs) < MIN_READINGS:
        return 1.0
    return exceeds(-2.0 * math.fsum(logs), 2 * len(logs))


def _agreements(one: GradedSubmission, two: GradedSubmission, spread: float) -> Iterator[float]:
    for key in one.strokes.keys() & two.strokes.keys():
        a, b = one.strokes[key], two.strokes[key]
        if max(abs(a.off), abs(b.off)) <= BOUND:
            step = max(a.step, b.step) / 2
            yield math.log(
                min(1.0, math.erf((abs(a.off - b.off) + step) / spread / math.sqrt(2.0)))
            )


def _hand_error(checked: GradedSubmission) -> float:
    """Return a student's drafting error as a fraction of the profile's."""
    found = [stroke.off for stroke in checked.strokes.values() if abs(stroke.off) <= BOUND]
    rms = math.sqrt(math.fsum(off**2 for off in found) / len(found)) if found else 1.0
    return min(1.0, max(MIN_HAND_ERROR, rms))
