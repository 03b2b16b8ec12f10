"""At and near dead positions: a result, a warning, or a refusal, never a silent wrong number."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from cases import each
from doors import (
    AssemblyError,
    GappedSweep,
    ProblemError,
    Solution,
    Sweep,
    error_bound,
    problem_loads as loads,
    verify,
    warnings,
)

PARALLELOGRAM = """
[frame]
A = [0, 0]
D = [0.4, 0]
[links.1]
points = ["A", "B"]
AB = 0.12
[links.2]
points = ["B", "C", "E"]
BC = 0.4
E = {{ on = "BC", at = 0.2, across = -0.1 }}
[links.3]
points = ["D", "C"]
DC = 0.12
[driver]
link = "1"
phi = {phi}
omega = 12
[assembly]
C = "left of BD"
{more}
"""


def parallelogram(phi: str, more: str = "") -> Solution:
    return Solution(loads(PARALLELOGRAM.format(phi=phi, more=more), name="par"))


def test_far_from_the_change_point_there_is_no_warning() -> None:
    solution = parallelogram("50")
    verify(solution)
    assert warnings(solution) == []
    assert solution.links["3"].omega[0] == pytest.approx(12, rel=1e-12)
    assert abs(solution.links["3"].epsilon[0]) < 1e-9


@pytest.mark.parametrize("phi", ["0.1", "0.03"])
def test_near_the_change_point_the_estimate_covers_the_error(phi: str) -> None:
    solution = parallelogram(phi)
    verify(solution)
    # The rocker of a parallelogram has no angular acceleration: the computed one is the error.
    error = abs(solution.links["3"].epsilon[0]) / 12**2
    assert error <= 20 * error_bound(solution)[0]


def test_a_doubtful_position_is_reported_with_its_margin() -> None:
    (said,) = map(str, warnings(parallelogram("[50, 0.02]")))
    assert said.startswith("position 1 (phi = 0.02 deg) is next to a dead position (margin ")


@pytest.mark.parametrize("phi", ["0.001", "1e-5"])
def test_a_spoilt_position_is_rejected(phi: str) -> None:
    solution = parallelogram(f"[50, {phi}]")
    with pytest.raises(AssemblyError, match=r"position 1 .* so near a dead position"):
        verify(solution)


def test_the_change_point_itself_cannot_choose_an_assembly() -> None:
    solution = parallelogram("0")
    for act in (lambda: solution.si, lambda: solution.with_positions([50.0])):
        with pytest.raises(AssemblyError, match=r"dead position"):
            act()
    with pytest.raises(AssemblyError, match="both assemblies place C at one point"):
        Sweep(solution.problem, ["C"]).run([0.0, 50.0])


TANGENT = """
[frame]
O = [{0}, {1}]
D = [{2}, {3}]
[links.1]
points = ["O", "A"]
OA = 1.0
[links.2]
points = ["A", "C"]
AC = {4}
[links.3]
points = ["D", "C"]
DC = {5}
[driver]
link = "1"
phi = {6}
omega = 1.0
[assembly]
C = {{ near = [{7}, {8}] }}
"""


@each("turn", [0.0, 90.0, 37.0, 211.3])
@each("rod, arm", [(3.0, 2.0), (3.0, 9.0), (0.7, 5.7)])  # touching from outside, from inside
def test_where_arcs_touch_the_place_is_given_without_motion(
    turn: float, rod: float, arm: float
) -> None:
    way = cmath.rect(1.0, math.radians(turn))
    pivot = (rod + arm if arm == 2.0 else rod - arm) * way
    origin, right = -way, rod * way
    text = TANGENT.format(
        origin.real, origin.imag, pivot.real, pivot.imag, rod, arm, turn, right.real, right.imag
    )
    problem = loads(text, name="touching")
    found = Sweep(problem, ["C"]).table([turn])
    assert complex(found["C.x"][0], found["C.y"][0]) == pytest.approx(right, abs=2e-6)
    assert not GappedSweep(problem, np.array([turn]), ["C"]).gaps.count
    for act in (lambda: Sweep(problem, ["v_C"]), lambda: verify(Solution(problem))):
        with pytest.raises(AssemblyError, match="dead position"):
            act()


def test_the_assembly_is_determined_by_the_first_position_that_can() -> None:
    solution = parallelogram("[0, 50]")
    with pytest.raises(AssemblyError, match=r"at position 0 .* is in a dead position"):
        _ = solution.si


def test_rules_of_one_group_must_agree() -> None:
    with pytest.raises(ProblemError) as caught:
        parallelogram("50", "E = { near = [0.19, -0.1] }")
    (fault,) = caught.value.faults
    assert str(fault) == (
        "assembly.E: 'E near [0.19, -0.1]' and 'C left of BD' require different assemblies of "
        "links 2, 3. Keep the correct one"
    )
