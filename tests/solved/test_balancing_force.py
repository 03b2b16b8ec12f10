"""The balancing force at a point of the crank: against the couple, equilibrium, the source."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from cases import each
from doors import (
    BalancingForceTask,
    LeverReading,
    ModelProblem as Problem,
    PositionError,
    ProblemError,
    QuantityKey,
    QuantityKind,
    QuantityValues,
    Questions,
    Solution,
    Statics,
    force_reading,
    problem_loads as loads,
    solution_record as record,
    statics_of,
)
from mechanisms import SLIDER
from msgspec.structs import replace
from worked import path_of

STONE = path_of("press/press-stone").read_text("utf-8")


def pushed(problem: Problem, at: str = "A", angle: float | None = None) -> Problem:
    task = BalancingForceTask(at, angle)
    return replace(problem, drive=replace(problem.drive, pushed=task))


def stone(extra: str = "") -> Problem:
    return loads(STONE + extra, name="press-stone")


def test_the_force_and_the_reaction_of_the_press() -> None:
    """The source's axis has 184.40 N with F_y in A, without the inertia of the crank."""
    light = (
        path_of("press/press")
        .read_text("utf-8")
        .replace("mass = 3 ", "mass = 0 ")
        .replace("inertia = 0.0089", "inertia = 0 # ")
    )
    weight = '\n[[loads]]\nname = "G"\nlink = "1"\nat = "S1"\nforce = 29.43\nangle = -90\n'
    statics = statics_of(Solution(pushed(loads(light + weight, name="light"))))
    assert abs(statics.balance[0]) == pytest.approx(175.63, abs=0.01)
    axis = next(joint for joint in statics.reactions if joint.joint == "O1")
    assert abs(axis.force[0]) == pytest.approx(184.404, abs=0.001)


@each("angle", [None, 0.0, 60.0, 123.4, -90.0])
@each("away", [0.0, 47.0, 200.0])
def test_the_force_has_the_moment_of_the_couple(angle: float | None, away: float) -> None:
    problem = stone()
    positions = [problem.drive.positions[0] + away]
    couple = Statics(Solution(problem, positions=positions))
    force = Statics(Solution(pushed(problem, angle=angle), positions=positions))
    pivot, at = (complex(force.solution.points[name].place[0]) for name in ("O1", "A"))
    arm = at - pivot
    way = 1j * arm / abs(arm) if angle is None else cmath.rect(1.0, math.radians(angle))
    moment = (arm.conjugate() * way).imag * force.balance[0]
    assert moment == pytest.approx(couple.balance[0], rel=1e-12)
    assert force.moment is not None and force.moment[0] == pytest.approx(couple.balance[0])
    assert force.lever is not None and force.lever[0] == pytest.approx(force.balance[0], rel=1e-11)
    for one, other in zip(couple.reactions, force.reactions, strict=True):
        if one.joint != "O1":
            assert np.abs(one.force - other.force).max() < 1e-9
    change = next(
        other.force[0] - one.force[0]
        for one, other in zip(couple.reactions, force.reactions, strict=True)
        if one.joint == "O1"
    )
    assert change == pytest.approx(-way * force.balance[0], abs=1e-9)


def test_along_the_crank_it_has_no_arm() -> None:
    problem = stone()
    along = pushed(problem, angle=problem.drive.positions[0])
    with pytest.raises(PositionError, match="no arm"):
        statics_of(Solution(along)).si  # noqa: B018


def test_the_balancing_force_is_read_and_acts_on_the_lever() -> None:
    reading = force_reading(Solution(pushed(stone(), angle=60.0)), 0)
    lever = LeverReading(reading)
    force = next(one for one in lever.forces if one.symbol == "balancing force")
    assert force.arm % 0.5 == pytest.approx(0.0, abs=1e-9)  # by the ruler
    assert all(couple.symbol != "balancing moment" for couple in lever.couples)
    assert sum(one.arm * one.size for one in lever.forces) + sum(
        one.lever_moment for one in lever.couples
    ) == pytest.approx(0.0, abs=1e-6 * force.arm * force.size)


def test_selectors_and_questions() -> None:
    solution = Solution(pushed(stone()))
    values = QuantityValues(solution)
    alone = values.exact(QuantityKey(QuantityKind.BALANCE, ()))
    at_a = values.exact(QuantityKey(QuantityKind.BALANCE, ("A",)))
    assert abs(alone) == pytest.approx(at_a, rel=1e-12)
    assert values.exact(QuantityKey(QuantityKind.LEVER, ("A",))) == pytest.approx(at_a)
    question = Questions(solution).question(QuantityKey(QuantityKind.BALANCE, ()))
    assert question.unit == "N"


@each(
    "table, told",
    [
        ('at = "O1"', "the axis"),
        ('at = "B"', "has no point"),
        ("", "missing"),
        ('at = "A"\nangle = "x"', "expected an angle"),
    ],
)
def test_faulty_tables_are_rejected(table: str, told: str) -> None:
    with pytest.raises(ProblemError, match=told):
        stone(f"\n[balancing_force]\n{table}\n")


MASS = '[dynamics.links.3]\nmass = 1\ncentre = "C"\n'


def test_a_driving_slider_has_no_balancing_force() -> None:
    with pytest.raises(ProblemError, match="slides and has no turn"):
        loads(SLIDER + MASS + '\n[balancing_force]\nat = "B"\n', name="slider")


# Bearings ----------------------------------------------------------------------------------------


@each("places", [(-0.04, 0.06), (0.02, 0.06), (0.1, -0.1)])
def test_two_bearings_carry_the_reaction(places: tuple[float, float]) -> None:
    problem = stone(f"\n[bearings.O1]\nat = [{places[0]}, {places[1]}]\nplane = 0.01\n")
    forces = record(Solution(problem))["positions"][0]["forces"]
    axis = next(one for one in forces["reactions"] if one["joint"] == "O1")
    one, two = axis["bearings"]
    for letter in ("fx", "fy"):
        assert one[letter] + two[letter] == pytest.approx(axis[letter], rel=1e-12)
        moment = one[letter] * (one["at"] - 0.01) + two[letter] * (two["at"] - 0.01)
        assert moment == pytest.approx(0.0, abs=1e-9)
    assert all("bearings" not in other for other in forces["reactions"] if other is not axis)
    assert [plan["q"] for plan in forces["plans"]] == [3, 3, 0]


@each(
    "table, told",
    [("[bearings.A]\nat = [0, 1]", "no link turns"), ("[bearings.O1]\nat = [1, 1]", "same place"),
     ("[bearings.O1]\nat = 1", "two distances"), ("[bearings.O1]\nplane = 1", "missing")],
)  # fmt: skip
def test_bearings_that_cannot_be(table: str, told: str) -> None:
    with pytest.raises(ProblemError, match=told):
        stone(f"\n{table}\n")
