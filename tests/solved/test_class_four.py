"""A group of class IV is refused; driven from inside, it has plans (замена начального звена)."""

from __future__ import annotations

import cmath
import math

import pytest
from doors import AssemblyError, Solution, Statics, pose, problem_loads as loads

CLASS_FOUR = """
[frame]
O = [0, 0]
F = [0.4, 0]
[links.1]
points = ["O", "A"]
OA = 0.08
[links.2]
points = ["A", "B", "C"]
AB = 0.2
AC = 0.15
BC = 0.12
B.side = "left of AC"
[links.3]
points = ["B", "D"]
BD = 0.2
[links.4]
points = ["F", "D", "E"]
FD = 0.18
FE = 0.15
DE = 0.1
E.side = "left of FD"
[links.5]
points = ["C", "E"]
CE = 0.2
[driver]
link = "1"
phi = 40
omega = 10
[assembly]
B = { near = [0.2583, 0.1076] }
"""
INSIDE = CLASS_FOUR.replace(
    'link = "1"\nphi = 40\nomega = 10',
    'link = "4"\nphi_1 = 40\nomega_1 = 10\nepsilon_1 = 3\nroot = 1',
)
BARS = {"OA": 0.08, "AB": 0.2, "AC": 0.15, "BC": 0.12, "BD": 0.2, "FD": 0.18, "FE": 0.15,
        "DE": 0.1, "CE": 0.2}  # fmt: skip
LOADS = """
[[loads]]
link = "2"
at = "B"
force = 50
angle = -90
"""


def test_the_message_names_the_link_that_lowers_the_class_and_the_keys_that_remain() -> None:
    with pytest.raises(AssemblyError, match=r"if link 4 drives.*phi_1 and omega_1"):
        Solution(loads(CLASS_FOUR, name="class-four"))


def test_driven_from_inside_all_bars_keep_their_lengths() -> None:
    """Lengths and both their derivatives, from the definition of a rigid body."""
    solution = Solution(pose(loads(INSIDE, name="class-four")))
    assert solution.structure.formula == "I(0,4) → III(1,2,3,5)"
    ends = {"O": (0j, 0j, 0j), "F": (0.4 + 0j, 0j, 0j)}
    for point in "ABCDE":
        motion = solution.points[point]
        ends[point] = motion.place[0], motion.velocity[0], motion.acceleration[0]
    for bar, length in BARS.items():
        place, velocity, gain = (
            two - one for one, two in zip(*(ends[p] for p in bar), strict=True)
        )
        assert abs(place) == pytest.approx(length, rel=1e-9)
        assert abs((velocity * place.conjugate()).real) < 1e-9 * length
        balance = (gain * place.conjugate()).real + abs(velocity) ** 2
        assert abs(balance) < 1e-9 * (abs(gain) * length + abs(velocity) ** 2)
    place, velocity, gain = ends["A"]
    assert place == pytest.approx(cmath.rect(0.08, math.radians(40)), rel=1e-9)
    assert velocity == pytest.approx(10j * place, rel=1e-9)
    assert gain == pytest.approx((3j - 100) * place, rel=1e-9)


def test_its_balance_does_the_work_of_the_load() -> None:
    """By virtual work: M₄·ω₄ + F·v_B = 0."""
    solution = Solution(pose(loads(INSIDE + LOADS, name="class-four")))
    statics = Statics(solution)
    power = -50.0 * solution.points["B"].velocity[0].imag
    found = statics.balance[0] * solution.links["4"].omega[0]
    assert found == pytest.approx(-power, rel=1e-9)
