"""The error bound reported near change points holds, for nearly zero results as well."""

from __future__ import annotations

import cmath
import math

import pytest
from doors import (
    BOUNDED_KINDS,
    Solution,
    accuracy_examine as examine,
    error_bound,
    motion_doubts,
    natural_size,
    problem_loads as loads,
)

TEXT = """
title = "x"
[frame]
A = [0, 0]
K = [{base}, 0]
[links.1]
points = ["A", "B"]
AB = {crank}
[links.2]
points = ["B", "C", "S"]
BC = {rod}
S = {{ on = "BC", at = 0.075, across = 0.0375 }}
[links.3]
points = ["K", "C"]
KC = {rocker}
[driver]
link = "1"
phi = {phi}
omega = 10
epsilon = 5
[assembly]
C = {{ near = [{x!r}, {y!r}] }}
"""
SHAPES = {  # frame, crank, coupler, rocker; which of two assemblies
    "parallelogram": (0.3, 0.1, 0.3, 0.1, 1),
    "antiparallelogram": (0.3, 0.1, 0.3, 0.1, -1),
    "kite": (0.3, 0.3, 0.1, 0.1, 1),
}


def four_bar(shape: str, phi: float) -> str:
    base, crank, rod, rocker, side = SHAPES[shape]
    b = cmath.rect(crank, math.radians(phi))
    way = base - b
    along = (rod**2 - rocker**2 + abs(way) ** 2) / (2 * abs(way))
    across = math.sqrt(max(0.0, rod**2 - along**2))
    both = [b + way / abs(way) * complex(along, s * across) for s in (1, -1)]
    if shape != "kite":
        both.sort(key=lambda c: abs(c - b - base), reverse=side < 0)
    sizes = {"base": base, "crank": crank, "rod": rod, "rocker": rocker}
    return TEXT.format(phi=phi, x=both[0].real, y=both[0].imag, **sizes)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("phi", [0.01, 0.2, 1.0, 35.0])
def test_no_error_of_a_result_exceeds_the_reported_bound(shape: str, phi: float) -> None:
    problem = loads(four_bar(shape, phi), name="x")
    (bound,) = error_bound(Solution(problem))
    (found,) = examine(problem, [phi], closely=False)
    largest = dict.fromkeys(BOUNDED_KINDS, 0.0)
    for one in found.verdicts:
        if one.kind in largest:
            largest[one.kind] = max(largest[one.kind], one.size)
    errors = [
        one.error / float(natural_size(one.kind, largest))
        for one in found.verdicts
        if largest.get(one.kind)
    ]
    assert len(errors) > 10
    assert max(errors) <= bound


def test_the_reported_bound_is_relative_to_the_largest_of_a_kind() -> None:
    """The coupler of a parallelogram does not turn: its computed acceleration is all noise."""
    solution = Solution(loads(four_bar("parallelogram", 0.01), name="x"))
    (doubt,) = motion_doubts(solution)
    turned = abs(float(solution.links["2"].epsilon[0]))
    assert turned <= doubt.bound * 5.0
    assert f"accurate to about {doubt.bound:.0e} of the largest of their kind" in str(doubt)
