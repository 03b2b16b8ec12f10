"""Submissions of a group that agree better than two independent drawings can (списанные работы)."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.explain import exceeds
from planmethod.check.model import GradedAnswer, GradedSubmission, PencilTrace, Verdict

AnswerName = tuple[str, int]
"""Name of an answer, and its position."""

MAX_MATCH_CHANCE = 0.01
"""Maximum chance, over a whole group, that two submissions are this close by coincidence."""

MIN_READINGS = 4
"""Minimum number of readings for comparing two submissions."""

BOUND = 4.0
"""Sigmas beyond which a reading is a mistake, not a drafting error: two students may share one."""

MIN_HAND_ERROR = 0.15
"""Minimum drafting error of any student, as a fraction of the profile's."""

MIN_EQUAL = 6
"""Minimum number of equal drawn answers: five lengths, read to a whole millimetre, are equal in
0.4 % of all pairs of independent works."""

MIN_COMMON = 0.8
"""Minimum share of the drawn answers of two submissions that both have."""

MAX_ROUNDING = 0.002
"""Maximum relative deviation of a calculated number: π = 3.14, numbers rounded in between."""

RULERS_MM = 1.0, 0.5
"""Steps to which lengths are read."""

MAX_OFF_RULER = 1e-3
"""Part of a step of the ruler by which a length may be off its marks, beyond its rounding."""

MIN_ON_RULER = 0.5
"""Minimum share of the answers that are whole steps of a ruler, if the student has read by it."""

MIN_MISTAKES = 3
"""Minimum number of equal mistakes of unknown cause in place of an equal drafting error."""


class Reading(Struct, frozen=True):
    """A drawn answer as it is written (записанный отсчёт).

    Attributes
    ----------
    digits : tuple
        Value, millimetres and sense.
    stroke : PencilTrace or None
        Drafting error when the earlier numbers are given, and the step of reading.
    error : float
        Sigmas from the nearest value that can be calculated; 0 if it is one, or has no stroke.
    """

    digits: tuple[object, ...]
    stroke: PencilTrace | None = None
    error: float = 0.0


Readings = Mapping[AnswerName, Reading]


def mark_similar_submissions(works: Iterable[GradedSubmission]) -> list[GradedSubmission]:
    """Return submissions, marking those whose readings agree better than two drawings can.

    All drawn answers are equal to the last digit, or the drafting errors of the readings agree:
    given the earlier numbers, those of independent drawings differ by √2 of a sigma.
    """
    whole = list(works)
    alike: dict[int, list[str]] = defaultdict(list)
    same: dict[str | None, list[int]] = defaultdict(list)
    for number, checked in enumerate(whole):
        same[checked.variant].append(number)
    pairs = [pair for numbers in same.values() for pair in combinations(numbers, 2)]
    readings = [list_readings(checked) for checked in whole]
    for one, two in pairs:
        pair = readings[one], readings[two]
        if is_verbatim(*pair) or match_chance(*pair) * len(pairs) < MAX_MATCH_CHANCE:
            alike[one].append(whole[two].work.student)
            alike[two].append(whole[one].work.student)
    return [
        replace(w, similar_students=tuple(alike[n])) if n in alike else w
        for n, w in enumerate(whole)
    ]


# Readings ------------------------------------------------------------------------------------


def list_readings(checked: GradedSubmission) -> Readings:
    """Return the drawn answers of a submission, by their names."""
    drawn = {
        (one.key.id, one.key.position): one
        for one in checked.answers
        if one.key is not None and one.key.sigma and not one.key.zero
        if one.value is not None and one.written is not None
        if one.verdict is not Verdict.UNREADABLE
    }
    ruler = _ruler_of([_in_mm(one) for one in drawn.values()])
    found: dict[AnswerName, Reading] = {}
    for name, one in drawn.items():
        assert one.value is not None and one.written is not None
        digits = abs(one.value), one.written.mm, one.written.sense
        found[name] = Reading(digits)
        if (stroke := checked.strokes.get(name)) is not None:
            wider = _read_by(ruler, one, stroke)
            found[name] = Reading(digits, wider, _drafting_error(checked, one))
    return found


def _in_mm(one: GradedAnswer) -> tuple[float, float]:
    """Return the segment of an answer and the unit of its last digit, mm; 0 if it has none."""
    assert one.key is not None and one.written is not None and one.value is not None
    if one.written.mm is not None:
        return one.written.mm, one.written.mm_step
    per_mm = _per_mm(one)
    return (abs(one.value) / per_mm, one.written.step / per_mm) if per_mm else (0.0, 0.0)


def _per_mm(one: GradedAnswer) -> float:
    return abs(one.key.exact) / one.key.mm if one.key is not None and one.key.mm else 0.0


def _ruler_of(lengths: Sequence[tuple[float, float]]) -> float:
    """Return the step to which a student seems to read lengths, mm; 0 if there is none."""
    for ruler in RULERS_MM:
        fine = [pair for pair in lengths if pair[0] and pair[1] < ruler / 2]
        whole = sum(_is_on_ruler_mark(mm, step, ruler) for mm, step in fine)
        if whole >= max(MIN_READINGS, MIN_ON_RULER * len(fine)):
            return ruler
    return 0.0


def _is_on_ruler_mark(mm: float, step: float, ruler: float) -> bool:
    return abs(mm - round(mm / ruler) * ruler) <= step / 2 + MAX_OFF_RULER * ruler


def _read_by(ruler: float, one: GradedAnswer, stroke: PencilTrace) -> PencilTrace:
    """Return a reading with the step of the ruler, if that is coarser than the written digits."""
    assert one.key is not None and one.written is not None
    sigma = one.written.step / stroke.step if stroke.step else one.key.sigma
    coarse = ruler and _is_on_ruler_mark(*_in_mm(one), ruler)
    step = max(stroke.step, ruler * _per_mm(one) / sigma) if coarse and sigma else stroke.step
    return PencilTrace(stroke.off, step)


def _drafting_error(checked: GradedSubmission, one: GradedAnswer) -> float:
    """Return by how many sigmas a value differs from all that can be calculated; 0 if it does not.

    Those are the right value, the one from the student's own numbers, and those of the mistakes.
    """
    assert one.key is not None and one.written is not None and one.value is not None
    known = [one.key.exact, *([] if one.local is None else [one.local])]
    known += [told.values[one.id] for told in checked.diagnosis if one.id in told.values]
    off, nearest = min((abs(abs(one.value) - abs(value)), abs(value)) for value in known)
    three_digits = 10.0 ** (math.floor(math.log10(nearest)) - 2) if nearest else 0.0
    if off <= max(one.written.step / 2, three_digits / 2, MAX_ROUNDING * nearest):
        return 0.0
    grown = max(1.0, abs(one.value / one.key.exact)) if one.key.exact else 1.0
    return off / (one.key.sigma * grown)


# Comparison ----------------------------------------------------------------------------------


def is_verbatim(one: Readings, two: Readings) -> bool:
    """Return whether two submissions are equal in all that their drawings make random.

    Chance must have a part in them: a drafting error, or mistakes of unknown cause.
    """
    common = one.keys() & two.keys()
    if len(common) < max(MIN_EQUAL, MIN_COMMON * len(one.keys() | two.keys())):
        return False
    errors = [one[name].error for name in common if one[name].error]
    drawn = len(errors) >= MIN_MISTAKES or any(error <= BOUND for error in errors)
    return drawn and all(one[name].digits == two[name].digits for name in common)


def match_chance(one: Readings, two: Readings) -> float:
    """Return the chance that two independent submissions agree as well in all readings (Fisher).

    Each reading gives the chance that two drawings agree so well; twice the negative logarithms add
    up to chi-squared with two degrees of freedom each. Readings that both can have calculated are
    left out.
    """
    logs = list(_agreements(one, two, math.hypot(_hand_error(one), _hand_error(two))))
    if len(logs) < MIN_READINGS:
        return 1.0
    return exceeds(-2.0 * math.fsum(logs), 2 * len(logs))


def _agreements(one: Readings, two: Readings, spread: float) -> Iterator[float]:
    for name in one.keys() & two.keys():
        a, b = one[name].stroke, two[name].stroke
        if a is None or b is None or not (one[name].error or two[name].error):
            continue
        if max(abs(a.off), abs(b.off)) <= BOUND:
            step = max(a.step, b.step) / 2
            yield math.log(
                min(1.0, math.erf((abs(a.off - b.off) + step) / spread / math.sqrt(2.0)))
            )


def _hand_error(readings: Readings) -> float:
    """Return a student's drafting error as a fraction of the profile's."""
    strokes = [one.stroke for one in readings.values() if one.stroke is not None]
    found = [stroke.off for stroke in strokes if abs(stroke.off) <= BOUND]
    rms = math.sqrt(math.fsum(off**2 for off in found) / len(found)) if found else 1.0
    return min(1.0, max(MIN_HAND_ERROR, rms))
