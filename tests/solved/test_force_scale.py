"""Scales of the force plans: of the series for each, or the file's for all."""

from __future__ import annotations

import numpy as np
import pytest
from doors import (
    COMMON_BOX,
    ForceReading,
    Solution,
    problem_loads as loads,
    solution_record as record,
    statics_of,
)
from msgspec.structs import replace
from worked import path_of, problem_of

LOADED = ("levers/six-link", "levers/task12", "press/press", "press/press-stone")


@pytest.mark.parametrize("name", LOADED)
def test_the_largest_plan_fills_the_common_box(name: str) -> None:
    problem = problem_of(name)
    free = replace(problem, scales=replace(problem.scales, mu_F=None))
    solution = Solution(free)
    reading, scale = ForceReading(solution, 0), statics_of(solution).scale
    assert reading.scale == scale
    assert record(solution)["positions"][0]["forces"]["mu"] == scale.per_mm
    sizes = []
    for plan in reading.plans:
        ends = [reading.end(end) for edge in plan.polygon for end in (edge.tail, edge.head)]
        sizes += [np.ptp(np.real(ends)), np.ptp(np.imag(ends))]
    assert 0.35 * min(COMMON_BOX) < max(sizes) <= max(COMMON_BOX) + 1e-9


def test_a_position_has_the_scales_that_it_has_alone() -> None:
    problem = problem_of("press/press")
    free = replace(problem, scales=replace(problem.scales, mu_F=None))
    together, alone = (
        statics_of(Solution(free, positions=at)) for at in ([30.0 * k for k in range(12)], [150.0])
    )
    assert together.scale.per_mm >= alone.scale.per_mm
    told = record(together.solution)["positions"][5]["forces"]["plans"]
    assert [plan["mu"] for plan in told] == [own[0] for own in alone.plan_scales]
    assert [plan["links"] for plan in told] == [["4", "5"], ["2", "3"], ["1"]]


def test_a_small_plan_has_a_scale_of_its_own_and_is_read_at_that() -> None:
    problem = problem_of("levers/task-33")
    reading = ForceReading(Solution(problem), 0)
    own = [reading.plan_scale(number).per_mm for number in range(len(reading.plans))]
    assert own[0] < 0.5 * own[1] < reading.scale.per_mm
    (slight,) = (edge for edge in reading.plans[0].wholes if edge.symbol == "F_{42}")
    ruler, exact = reading.solution.ruler_arithmetic.ruler, abs(reading.force(slight))
    assert abs(reading.read(slight) - exact) < 0.05 * exact
    assert reading.length(slight, 0) / ruler == pytest.approx(
        round(reading.length(slight, 0) / ruler)
    )
    coarse = (
        reading.solution.ruler_arithmetic.ruled(exact / reading.scale.per_mm) * reading.scale.per_mm
    )
    assert abs(coarse - exact) > 0.3 * exact
    asked = replace(problem, scales=replace(problem.scales, mu_F=20.0))
    assert ForceReading(Solution(asked), 0).plan_scale(0).per_mm == 20.0


def test_the_scale_of_the_file() -> None:
    problem = problem_of("press/press")
    asked = replace(problem, scales=replace(problem.scales, mu_F=7.5))
    assert statics_of(Solution(asked)).scale.per_mm == 7.5


def test_the_scale_is_read_in_the_convention_of_the_file() -> None:
    text = path_of("levers/six-link").read_text(encoding="utf-8")
    told = text.replace("mu_a = 2\n", "mu_a = 2\nmu_F = 0.005\n")
    assert told != text
    assert loads(told, name="six-link").scales.mu_F == pytest.approx(200.0)
