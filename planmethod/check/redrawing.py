"""A student's own plans, drawn on with a wrong vector (свои планы с неверным вектором).

A number that is read from a plan moves no point of it. A vector that was laid off wrong does: so
the head of each vector with a wrong number is moved, and the results of these plans are compared.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress

import numpy as np
from msgspec.structs import replace

from planmethod.check.following import order_asked, repoint
from planmethod.check.grading import Derived, ExaminedAnswer, collect_student_values, derive
from planmethod.check.marks import Settings
from planmethod.check.mistakes.plans import fresh, known
from planmethod.check.model import Diagnosis, Verdict
from planmethod.check.routes import would_circle
from planmethod.check.sheet import Sheet, StudentValues
from planmethod.construct.program import Program, rewritten
from planmethod.construct.steps import Carry, Step

NEAR = 2.0
"""Tolerances of the right plan beyond which a redrawn plan does not give an answer."""

Follower = tuple[ExaminedAnswer, Derived]
"""A wrong answer, and what gives it."""

Redrawn = tuple[Program, Mapping[str, float]]
"""Program of plans that are drawn otherwise, and its data in place of the right ones."""


def redraw(
    sheet: Sheet,
    examined: Sequence[ExaminedAnswer],
    diagnoses: Sequence[Diagnosis],
    settings: Settings,
) -> list[Diagnosis]:
    """Let wrong answers follow from plans on which a vector has the student's wrong length.

    Returns
    -------
    list of Diagnosis
        Those given, without the answers that follow.
    """
    named = {root for told in diagnoses if told.codes for root in told.roots[:1]}
    rest = [
        one
        for one in examined
        if one.verdict in (Verdict.WRONG, Verdict.NEAR) and one.item.id not in named
    ]
    if not rest or any("P2" in told.codes for told in diagnoses):
        return [*diagnoses]
    plans: Redrawn = sheet.program, {}
    bases = [one for one in examined if one.slot and one.value and _is_off(one)]
    values, gone = collect_student_values(sheet, [*examined]), set[str]()
    for base in sorted(bases, key=lambda one: order_asked(sheet, one)):
        rest = [one for one in rest if one is not base and one.item.id not in gone]
        rest = [one for one in rest if not would_circle(one, [base], examined)]
        tried = [
            (way, [*follow_on(sheet, values, examined, rest, settings, way)])
            for way in (_move_head(sheet, values, base, plans) if rest else ())
        ]
        way, found = max(tried, key=lambda pair: len(pair[1]), default=(plans, []))
        plans = way if found else plans
        for one, derived in found:
            one.local, one.local_tolerance = derived.local, derived.tolerance
            one.parents, one.contradicts = {base.item.id: abs(derived.local)}, False
            one.verdict, one.source = Verdict.INHERITED, base.source or base.item.id
            gone.add(one.item.id)
    repoint([*examined])
    left = (
        replace(told, roots=tuple(root for root in told.roots if root not in gone))
        for told in diagnoses
    )
    return [told for told in left if told.roots]


def follow_on(
    sheet: Sheet,
    values: StudentValues,
    examined: Sequence[ExaminedAnswer],
    rest: Sequence[ExaminedAnswer],
    settings: Settings,
    plans: Redrawn,
) -> Iterator[Follower]:
    """Yield the answers of some that follow from a student's own numbers on other plans."""
    program, data = plans
    with suppress(ZeroDivisionError, OverflowError, FloatingPointError), np.errstate(all="ignore"):
        came, _ = sheet.replayed(values, program, data)
        if not any(_is_near(one, came.get(one.slot, math.nan)) for one in rest if one.slot):
            return
        left = sheet.localised(values, program, {**sheet.data, **data}, values)
        for one, derived in derive(sheet, values, examined, settings, came, left):
            if one in rest and math.isfinite(derived.tolerance) and derived.matches(one):
                yield one, derived


def _is_off(one: ExaminedAnswer) -> bool:
    """Return whether an answer is wrong by more than a drawing can be."""
    limit = one.limit
    return not one.right and (limit.is_visible or one.off > max(limit.spread, limit.maximum))


def _is_near(one: ExaminedAnswer, length: float) -> bool:
    """Return whether a plan may give an answer: its errors are found only then."""
    local, exact = abs(length * one.per_slot), abs(one.limit.exact)
    grown = max(1.0, local / exact) if exact else 1.0
    most = max(one.limit.tolerance(one.step), one.limit.spread) * grown
    return abs(abs(one.value) - local) <= NEAR * most


def _move_head(
    sheet: Sheet, values: StudentValues, base: ExaminedAnswer, plans: Redrawn
) -> Iterator[Redrawn]:
    """Yield the plans on which a vector is as long as a student has it, and reversed, too."""
    ends = base.item.question.ends
    if ends is None or base.slot is None or any(end not in sheet.order for end in ends):
        return
    program, data = plans
    there = sheet.replayed(values, program, data)[0].get(base.slot, 0.0) * base.per_slot
    if not there or not math.isfinite(there):
        return
    tail, head = sorted(ends, key=sheet.order.__getitem__)
    drawn = fresh(head, f"of {base.item.id}")
    name, given = known(f"{drawn} times")
    carry = Carry(head, tail, tail, drawn, times=name)

    def move(step: Step) -> Step | tuple[Step, ...]:
        return (replace(step, out=drawn), given, carry) if step.out == head else step

    changed, share = rewritten(program, move), abs(base.value / there)
    yield from ((changed, {**data, name: size}) for size in (share, -share))
