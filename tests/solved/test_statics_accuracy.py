"""Digits of the force plans: against 50 digits, far from dead positions and next to them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pytest
from cases import each, some
from doors import (
    CONDITIONING_SCALES as KINEMATIC_SCALES,
    DOWN,
    MULTIPLE,
    SCALE,
    UNIT_ROUNDOFF,
    UNIT_SCALES,
    Arithmetic,
    ArithmeticNumber as Number,
    AssemblyError,
    Float64,
    Name,
    PointName,
    Precise,
    Program,
    Slide,
    Solution,
    Statics,
    evaluate_evaluate as evaluate,
    measured_reach,
    problem_loads as loads,
)
from full_system import Acting, Answer, Pose, cross, slide_between, solve_all
from loaded import loaded_problem, with_resultant
from worked import problem_of

from benchmarks import hard_problems as texts

WORKED = ("levers/six-link", "levers/task12", "press/press")
SEEDS = range(0, some(200, few=80), 10)

Values = Mapping[Name, Number]


def data_of(statics: Statics) -> dict[str, Any]:
    """Data of the only position, as float64 has them."""
    data = {**statics.solution.data({**UNIT_SCALES}), SCALE: 1.0, **statics.board.data}
    return {name: np.ravel(value)[0].item() for name, value in data.items()}


def read(statics: Statics, arithmetic: Arithmetic) -> Values:
    """Read everything that the plans have, in metres and newtons."""
    return evaluate(statics.board.draft.b.program(), data_of(statics), arithmetic).value


def lifted(values: Values, referee: Precise) -> Values:
    """Return float64 values as numbers of the referee, binary fractions as they are."""
    return {
        name: tuple(map(referee.lift, value)) if isinstance(value, tuple) else referee.lift(value)
        for name, value in values.items()
    }


def all_at_once(statics: Statics, values: Values, referee: Precise) -> Answer:
    """Solve all links at once with many digits, on the places and loads of a reading."""
    board = statics.board

    def along(slide: Slide) -> Number:
        u = values[board.draft.direction(slide)][1]
        return u / abs(u)

    pose = Pose(lambda _, point: referee.context.mpc(values[PointName(point)]), along)
    zero = referee.context.mpc(0)
    given = []
    for load in board.given:
        if load.force is not None:
            force = referee.context.mpc(values[load.force.head] - values[load.force.tail])
            at = referee.context.mpc(values[load.force.at])
            given.append(Acting(load.applied.link, force, at, 0))
        else:
            assert load.couple is not None
            given.append(Acting(load.applied.link, zero, zero, values[load.couple]))
    joints = [(r.joint, r.on, r.by) for r in board.reactions]
    return solve_all(statics.solution.problem, joints, pose, given, referee.context)


def largest_error(statics: Statics, values: Values, answer: Answer) -> float:
    """Largest difference of the plans' reactions from those of all links at once, as a share."""
    errors = [0.0]
    for r in statics.board.reactions:
        joint = (r.joint, r.on, r.by)
        force, moment = answer.joints[joint]
        found = values[r.force.head] - values[r.force.tail]
        errors.append(float(abs(found - force)))
        if r.couple is not None:
            slide = slide_between(statics.solution.problem, joint)
            assert slide is not None
            arm = values[r.force.at] - values[PointName(slide.pin)]
            errors.append(float(abs(values[r.couple] + cross(arm, found) - moment)))
    errors.append(float(abs(values[statics.driving.balance] - answer.balance)))
    return max(errors) / answer.largest


@cache
def statics_of(which: int | str) -> Statics:
    problem = loaded_problem(which)[0] if isinstance(which, int) else problem_of(which)
    return Statics(Solution(problem))


@each("which", [*WORKED, *SEEDS])
def test_the_plans_are_the_solution_of_all_links_to_fifty_digits(which: int | str) -> None:
    statics, referee = statics_of(which), Precise(50)
    values = read(statics, referee)
    assert largest_error(statics, values, all_at_once(statics, values, referee)) <= 1e-40


@each("which", [*WORKED, *SEEDS])
def test_float64_is_the_solution_of_all_links_at_its_own_pose(which: int | str) -> None:
    statics, referee = statics_of(which), Precise(50)
    values = lifted(read(statics, Float64()), referee)
    assert largest_error(statics, values, all_at_once(statics, values, referee)) <= 1e-9


@each("which", ["levers/six-link", "press/press", *SEEDS])
def test_one_force_of_inertia_has_as_many_digits(which: int | str) -> None:
    problem = with_resultant(statics_of(which).solution.problem)
    statics, referee = Statics(Solution(problem)), Precise(50)
    values = read(statics, referee)
    assert largest_error(statics, values, all_at_once(statics, values, referee)) <= 1e-40
    if which in WORKED:
        assert statics.board.shifts
        for verdict in judge(statics):
            assert verdict.multiple <= MULTIPLE, verdict


# In units of the accuracy that the data allow ---------------------------------------------------


def asked(statics: Statics) -> tuple[Program, dict[str, Name]]:
    """Return a program that ends with every force as a point, and the names of these by label."""
    board = statics.board
    b = board.draft.b.copy()
    names: dict[str, Name] = {}
    for k, r in enumerate(board.reactions):
        label = f"{r.joint} {r.on}{r.by}"
        names[f"F {label}"] = b.carry(f"force {k}", board.pole, r.force.tail, r.force.head)
        if r.couple is not None:
            names[f"M {label}"] = r.couple
    if statics.driving.balance is not None:
        names["balance"] = statics.driving.balance
    if statics.driving.force is not None:
        force = statics.driving.force
        names["balance"] = b.carry("balance", board.pole, force.tail, force.head)
    if statics.lever_plan is not None:
        names["lever"] = statics.lever_plan.balance
    return b.program().needed_for(names.values()), names


@dataclass(frozen=True)
class Verdict:
    """Error of a result in units of u times its reach, its condition number, and both sizes."""

    label: str
    multiple: float
    kappa: float
    error: float
    size: float


def judge(statics: Statics) -> list[Verdict]:
    """Compare every force of a position with the referee's.

    A force that is zero by nature has no reach; its error is in units of the largest of its kind.
    """
    program, names = asked(statics)
    data = data_of(statics)
    found = evaluate(program, data, Float64()).value
    exact = {*KINEMATIC_SCALES, SCALE}
    exact |= {name for name, value in data.items() if name in statics.board.data and value == DOWN}
    right = measured_reach(program, data, Precise(50), exact)
    largest: dict[str, float] = {}
    for label, name in names.items():
        largest[label[0]] = max(largest.get(label[0], 0.0), float(abs(right[name][0])))
    verdicts = []
    for label, name in names.items():
        value, span = right[name]
        error = float(abs(value - complex(np.ravel(found[name])[0])))
        unit = max(float(span), 1e-14 * largest[label[0]])
        kappa = float(span / abs(value)) if value != 0 else math.inf
        multiple = error / (UNIT_ROUNDOFF * unit) if error else 0.0
        assert math.isfinite(error)
        verdicts.append(Verdict(label, multiple, kappa, error, float(abs(value))))
    return verdicts


@pytest.mark.parametrize("which", [*WORKED, *SEEDS[::4]])
def test_errors_are_a_few_units_of_the_accuracy_that_the_data_allow(which: int | str) -> None:
    for verdict in judge(statics_of(which)):
        assert verdict.multiple <= MULTIPLE, verdict


LOADS = """
[dynamics.links.1]
mass = 2.0
centre = "A"
inertia = 0.02
[dynamics.links.2]
mass = 3.0
centre = "{two}"
inertia = 0.05
[dynamics.links.3]
mass = 4.0
centre = "{three}"
inertia = 0.03
[[loads]]
link = "2"
at = "{two}"
force = 120
angle = 25
[[loads]]
link = "3"
at = "{three}"
force = 300
angle = 160
[[loads]]
link = "2"
couple = 7
"""


def near(text: str, position: float, two: str = "S", three: str = "B") -> Statics:
    whole = f'title = "Мёртвое положение"\n{text}{LOADS.format(two=two, three=three)}'
    return Statics(Solution(loads(whole, name="near"), positions=[position]))


STRETCHED = texts.stretched(0.125, 0.5, 0.375, 0.5)


def approach(name: str, turn: float, d: float) -> Statics:
    """Return a mechanism a distance ``d`` (rad or m) from its dead position."""
    away = math.degrees(d)
    match name:
        case "slider-crank by its crank":
            return near(texts.slider_crank(turn=turn), turn + 180.0 + away)
        case "slider-crank by its slider":
            s = 0.5 - texts.depart(0.125, 0.375, d)
            return near(texts.driven_by_slider(turn=turn), s)
        case "rocker by its crank":
            return near(texts.rocker(turn=turn), turn + STRETCHED + away)
        case "rocker by itself":
            text = texts.rocker(turn=turn, phi=110.0, by_rocker=True)
            return near(text, turn + 90.0 + away)
        case "parallel cranks":
            text = texts.rocker(turn=turn, phi=50.0, rod=0.5, arm=0.125, frame=0.5)
            return near(text, turn + away)
        case _:
            text = texts.pin_from_pivot(distance=d, turn=turn)
            return near(text, turn, two="A", three="D")


BOUNDED = ("slider-crank by its crank", "rocker by its crank")
"""Dead positions of the driven link: no force grows, even in the position itself."""

CASES = (*BOUNDED, "slider-crank by its slider", "rocker by itself", "parallel cranks", "slot")


@pytest.mark.parametrize("d", [1e-2, 1e-4])
@pytest.mark.parametrize("turn", [0.0, 37.0])
@pytest.mark.parametrize("name", CASES)
def test_errors_next_to_a_dead_position(name: str, turn: float, d: float) -> None:
    verdicts = judge(approach(name, turn, d))
    for verdict in verdicts:
        assert verdict.multiple <= MULTIPLE, verdict
    worst = max(v.kappa for v in verdicts if math.isfinite(v.kappa))
    assert (worst < 1e3) if name in BOUNDED else (worst > 0.3 / d)


@pytest.mark.parametrize("d", [1e-6, 1e-9])
@pytest.mark.parametrize("name", [*BOUNDED, "rocker by itself"])
def test_errors_very_near_a_dead_position(name: str, d: float) -> None:
    for verdict in judge(approach(name, 37.0, d)):
        assert verdict.multiple <= MULTIPLE, verdict


@pytest.mark.parametrize("name", BOUNDED)
def test_errors_in_the_dead_position_of_the_driven_link(name: str) -> None:
    for verdict in judge(approach(name, 37.0, 0.0)):
        assert verdict.multiple <= MULTIPLE, verdict


def test_a_force_grows_as_the_driver_loses_its_hold() -> None:
    """In the dead position itself there is no force, and this is an error."""
    sizes = [
        max(float(abs(r.force[0])) for r in approach("rocker by itself", 0.0, d).reactions)
        for d in (1e-2, 1e-4, 1e-6)
    ]
    assert sizes[1] > 1e3 * sizes[0]
    assert sizes[2] > 1e3 * sizes[1]
    with pytest.raises(AssemblyError, match="dead position"):
        _ = approach("rocker by itself", 0.0, 0.0).reactions
