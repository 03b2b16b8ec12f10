"""Every reading of the ruler: read once, and never of a laid-off segment."""

from __future__ import annotations

from collections import Counter
from functools import cache

import pytest
from doors import (
    Compute,
    GivenNumber,
    LayOffLength,
    Measure,
    MeasureAlong,
    MeasureArm,
    NumberName,
    Program,
    Solution,
    StepsStep as Step,
    Total,
    operands,
    problem_load as load,
    statics_of,
)
from loaded import loaded_problem, with_resultant
from worked import PROBLEMS, every_file

FILES = [path.relative_to(PROBLEMS).as_posix() for path in every_file()]
SEEDS = range(60)
EVERY = [*FILES, *SEEDS]
"""Problem files; random mechanisms with loads, every other one with the single resultant."""


@cache
def solved(what: str | int) -> Solution:
    if isinstance(what, str):
        return Solution(load(PROBLEMS / what))
    problem, _ = loaded_problem(what)
    return Solution(with_resultant(problem) if what % 2 else problem)


def program(solution: Solution) -> Program:
    """Return the program of all plans, of forces too where there are any."""
    if solution.problem.dynamics is None:
        return solution.construction.program
    return statics_of(solution).board.draft.b.program()


def used(steps: tuple[Step, ...]) -> set[str]:
    """Return the names that some step depends on."""
    return {name for step in steps for name, _ in operands(step)}


def readings(steps: tuple[Step, ...]) -> dict[NumberName, frozenset[str]]:
    """Return the lengths that the ruler gives, and between which points."""
    return {
        step.out: frozenset((step.tail, step.head))
        for step in steps
        if isinstance(step, Measure | MeasureAlong)
    }


def idle(solution: Solution) -> set[NumberName]:
    """Return readings on finished drawings of segments that were laid off."""
    return {s.drawn for s in solution.construction.segments if s.drawn != s.length}


@pytest.mark.parametrize("what", EVERY)
def test_no_segment_is_read_twice(what: str | int) -> None:
    solution = solved(what)
    steps = program(solution).steps
    extra = idle(solution)
    # An arm of a force about a special point is across the segment to its point, not the segment.
    arms_across = {s.out for s in steps if isinstance(s, MeasureAlong) and s.out.startswith("f:h")}
    extra |= arms_across
    pairs = Counter(ends for name, ends in readings(steps).items() if name not in extra)
    assert [set(pair) for pair, times in pairs.items() if times > 1] == []
    arms = Counter(
        (step.about, step.at, frozenset((step.tail, step.head)))
        for step in steps
        if isinstance(step, MeasureArm)
    )
    assert [arm for arm, times in arms.items() if times > 1] == []


@pytest.mark.parametrize("what", EVERY)
def test_no_result_follows_from_a_reading_of_a_laid_off_segment(what: str | int) -> None:
    solution = solved(what)
    steps = program(solution).steps
    extra = idle(solution)
    results = {quantity.size for quantity in solution.construction.legend}
    assert not extra & (used(steps) | results)
    laid = {frozenset((step.origin, step.out)) for step in steps if isinstance(step, LayOffLength)}
    assert [
        name for name, ends in readings(steps).items() if ends in laid and name not in extra
    ] == []


@pytest.mark.parametrize("what", EVERY)
def test_every_result_is_a_computed_number(what: str | int) -> None:
    """The program can then compute results that follow from a student's own reading."""
    solution = solved(what)
    construction = solution.construction
    sizes = [quantity.size for quantity in construction.legend if quantity.size is not None]
    assert sizes
    assert {type(construction.step(name)) for name in sizes} <= {Compute, Total, GivenNumber}
    if solution.problem.dynamics is None:
        return
    statics = statics_of(solution)
    forces = [statics.board.segments.known(r.force.ends) for r in statics.board.reactions]
    forces += [r.couple for r in statics.board.reactions if r.couple is not None]
    forces.append(statics.driving.balance)
    if statics.lever_plan is not None:
        forces += [statics.lever_plan.balance, statics.lever_plan.difference]
    made = {step.out: step for step in statics.program.steps}
    assert {type(made[name]) for name in forces} <= {Compute, Total}
