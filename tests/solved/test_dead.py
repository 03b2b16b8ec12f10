"""At and near dead positions: a result, a warning, or a refusal, never a silent wrong number."""

from __future__ import annotations

import pytest

from planmethod.errors import AssemblyError, ProblemError
from planmethod.problem import loads
from planmethod.solved.selfcheck import verify, warnings
from planmethod.solved.solution import Solution
from planmethod.solved.trust.conditioning import error_bound

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


def test_far_from_the_change_point_nothing_is_said() -> None:
    solution = parallelogram("50")
    verify(solution)
    assert warnings(solution) == []
    assert solution.links["3"].omega[0] == pytest.approx(12, rel=1e-12)
    assert abs(solution.links["3"].epsilon[0]) < 1e-9


@pytest.mark.parametrize("phi", ["0.1", "0.03"])
def test_near_the_change_point_the_estimate_covers_the_error(phi: str) -> None:
    solution = parallelogram(phi)
    verify(solution)
    # The rocker of a parallelogram has no angular acceleration: what is found is the error.
    error = abs(solution.links["3"].epsilon[0]) / 12**2
    assert error <= 20 * error_bound(solution)[0]


def test_a_doubtful_position_is_told_with_its_margin() -> None:
    (said,) = map(str, warnings(parallelogram("[50, 0.02]")))
    assert said.startswith("position 1 (phi = 0.02 deg) is next to a dead position (margin ")


@pytest.mark.parametrize("phi", ["0.001", "1e-5"])
def test_a_spoilt_position_is_refused(phi: str) -> None:
    solution = parallelogram(f"[50, {phi}]")
    with pytest.raises(AssemblyError, match=r"position 1 .* so near a dead position"):
        verify(solution)


def test_the_change_point_itself_cannot_choose_a_closing() -> None:
    with pytest.raises(AssemblyError, match="both closings put C at one place"):
        parallelogram("0")


def test_the_closing_is_told_by_the_first_position_that_can() -> None:
    solution = parallelogram("[0, 50]")
    with pytest.raises(AssemblyError, match=r"at position 0 .* stands in a dead position"):
        _ = solution.si


def test_rules_of_one_group_must_agree() -> None:
    with pytest.raises(ProblemError) as caught:
        parallelogram("50", "E = { near = [0.19, -0.1] }")
    (fault,) = caught.value.faults
    assert str(fault) == (
        "assembly.E: 'E near [0.19, -0.1]' and 'C left of BD' ask for different closings of links "
        "2, 3. Keep the one that is meant"
    )
