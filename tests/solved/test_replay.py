"""A program replayed with values that somebody else has found, and with a step left out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pytest
from doors import (
    Carry,
    Compute,
    Measure,
    MeasureAlong,
    MeasureArm,
    Name,
    NumberName,
    PointName,
    Program,
    RulerArithmetic,
    Solution,
    StepsStep as Step,
    Trace,
    evaluate_evaluate as evaluate,
    operands,
    problem_loads as loads,
    rewritten,
    statics_of,
    substituted,
)
from worked import PROBLEMS, every_file, problem_of

from benchmarks.generator import random_problem

READINGS = (Measure, MeasureAlong, MeasureArm)
RANDOM = [f"random-{seed}" for seed in range(0, 60, 6)]
EVERY = [*(str(path.relative_to(PROBLEMS).with_suffix("")) for path in every_file()), *RANDOM]


@cache
def solved(name: str) -> Solution:
    if name.startswith("random-"):
        return Solution(loads(random_problem(int(name.partition("-")[2]))[0], name=name))
    return Solution(problem_of(name))


@dataclass(frozen=True)
class Drawn:
    """A program, its data at the scales of the plans, and its values as drawn by hand."""

    program: Program
    data: Mapping[str, Any]
    trace: Trace
    hand: RulerArithmetic

    def replay(self, values: Mapping[NumberName, Any]) -> Trace:
        """Draw with somebody's own values."""
        program = substituted(self.program, values)
        return evaluate(
            program,
            {**self.data, **{str(name): value for name, value in values.items()}},
            self.hand,
        )


@cache
def drawn(name: str) -> Drawn:
    """The whole construction, force plans and lever with it where the problem has loads."""
    solution = solved(name)
    if solution.problem.dynamics is None:
        data = solution.data(solution.per_mm)
        return Drawn(
            solution.construction.program,
            data,
            solution.ruler_reading.trace,
            solution.ruler_arithmetic,
        )
    statics = statics_of(solution)
    data = statics.data(statics.per_mm, slice(None))
    return Drawn(statics.program, data, statics.ruler_reading.trace, statics.ruler_arithmetic)


def flat(value: Any) -> Any:
    return np.ravel(np.stack(np.broadcast_arrays(*value)) if isinstance(value, tuple) else value)


def changed(before: Trace, after: Trace) -> set[Name]:
    return {
        name
        for name, value in before.value.items()
        if not np.array_equal(flat(value), flat(after.value[name]), equal_nan=True)
    }


@pytest.mark.parametrize("name", EVERY)
def test_replacing_a_reading_by_its_own_value_has_no_effect(name: str) -> None:
    sheet = drawn(name)
    for step in sheet.program.steps:
        if isinstance(step, Measure | MeasureAlong | MeasureArm | Compute):
            own = {step.out: sheet.trace.value[step.out]}
            assert changed(sheet.trace, sheet.replay(own)) == set(), step.out


@pytest.mark.parametrize("name", EVERY)
def test_another_reading_changes_only_dependent_steps(name: str) -> None:
    """It changes every dependent step, except zeros and steps that do not depend on its size."""
    sheet = drawn(name)
    program, before = sheet.program, sheet.trace
    measured = [step for step in program.steps if isinstance(step, READINGS)]
    assert measured
    for step in measured:
        after = sheet.replay({step.out: before.value[step.out] * 1.25 + 3.0})
        mine = changed(before, after)
        depend = dependents(program, step.out)
        assert mine <= depend, step.out
        for other in program.steps:
            if other.out in depend - mine:
                used = {name for name, _ in operands(other)}
                assert not used & mine or _stays(other, before, mine), (step.out, other.out)


def dependents(program: Program, made: Name) -> set[Name]:
    """Return a point, line or number and everything that depends on it, directly or not."""
    found = {made}
    for step in program.steps:
        if any(name in found for name, _ in operands(step)):
            found.add(step.out)
    return found


def _stays(step: Step, trace: Trace, moved: set[Name]) -> bool:
    """Return whether a step may keep its value although its operands have changed.

    A ruler gives the same reading for lengths that differ by less than its step, and a force of
    known direction is laid off as it was read; zero times any number is zero.
    """
    if isinstance(step, Carry):
        return step.length is not None and step.length not in moved
    nothing = isinstance(step, Compute) and not np.any(trace.value[step.out])
    return nothing or isinstance(step, READINGS)


def test_a_segment_of_ones_own_goes_on_along_the_chain() -> None:
    """pb₃ = 40 mm in place of 45: v_B3 and ω₃, v_D, v_E and all accelerations follow."""
    solution = solved("linkages/ex3")
    segment = next(s for s in solution.construction.segments if s.label == "velocity.p-b3")
    sheet = drawn("linkages/ex3")
    before = sheet.trace
    assert abs(float(np.ravel(before.value[segment.length])[0])) == 45.0
    sign = np.sign(before.value[segment.length])
    after = sheet.replay({segment.length: sign * 40.0})

    def value(trace: Trace, label: str) -> float:
        size = solution.legend[label].size
        assert size is not None
        return abs(float(np.ravel(trace.value[size])[0]))

    assert value(after, "v_B3") == pytest.approx(40 * 0.05)
    # BC is read 72.5 mm at 0.002 m/mm; CD = 0.22 m is 110 mm.
    assert value(after, "omega_3") == pytest.approx(2.0 / 0.145)
    assert value(after, "v_D") == pytest.approx(0.05 * 40 * 110 / 72.5)
    assert value(after, "v_B") == value(before, "v_B")
    assert value(after, "v_B3/2") == value(before, "v_B3/2")
    assert value(after, "ak_B3/2") == pytest.approx(2 * (2.0 / 0.145) * value(before, "v_B3/2"))
    shown = ("v_E", "omega_4", "a_B3", "epsilon_3", "a_D", "a_E", "epsilon_4", "ar_B3/2")
    for label in shown:
        assert value(after, label) != value(before, label), label
    assert value(after, "a_B") == value(before, "a_B")


def test_without_coriolis() -> None:
    """The mistake of every group: a_E follows from π, n and the guide alone."""
    solution = solved("linkages/ex3")
    number = solution.legend["ak_B3/2"].size
    assert number is not None

    def forget(step: Step) -> Step:
        return Compute(number, 0.0, ()) if step.out == number else step

    program = rewritten(solution.construction.program, forget)
    trace = evaluate(program, solution.data(), type(solution.ruler_arithmetic)(ruler=1e-9))
    exact = solution.si
    along = exact.value[PointName("B")] - exact.value[PointName("C")]
    length = abs(along)
    along = along / length
    # a_B3 has the normal component towards C, and across the link that of a_B alone.
    sought = trace.value[PointName("a:B3")] * along.conjugate()
    inward = -(exact.value[NumberName("omega_3")] ** 2) * length
    assert sought.real == pytest.approx(inward, rel=1e-6)
    assert sought.imag == pytest.approx(
        (exact.value[PointName("a:B")] * along.conjugate()).imag, rel=1e-6
    )
    right = exact.value[PointName("a:E")]
    assert abs(trace.value[PointName("a:E")] - right) > 0.01 * abs(right)
