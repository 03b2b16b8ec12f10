"""Schemes of many positions that have more letters than their area bears, before they are drawn."""

from __future__ import annotations

import pytest
from doors import (
    MAX_LABELS,
    SIDE,
    PlanKind,
    Solution,
    densest,
    is_too_dense,
    problem_load as load,
)
from worked import path_of

ALL_ROUND = [30.0 * k for k in range(12)]


def test_letters_are_counted_in_a_square_about_one_of_them() -> None:
    row = [complex(0.45 * SIDE * k, 0.0) for k in range(5)]
    assert densest(row) == (3, row[1])
    assert densest([]) == (0, 0j)


@pytest.mark.parametrize("name", ["press/press", "linkages/ex2", "levers/task-55"])
def test_a_scheme_is_crowded_at_a_coarse_scale_only(name: str) -> None:
    solution = Solution(load(path_of(name)), positions=ALL_ROUND)
    crowded = [
        is_too_dense(solution.construction, solution.si, per_mm)
        for per_mm in (1e-6, 0.0005, 0.005, 0.02)
    ]
    assert crowded == sorted(crowded)
    assert not crowded[0]
    assert any(crowded)


def test_points_close_together_have_one_letter() -> None:
    solution = Solution(load(path_of("press/press")), positions=ALL_ROUND)
    points = solution.construction.draft.points()
    assert len(points) < MAX_LABELS
    assert not is_too_dense(solution.construction, solution.si, 1e3)


def test_a_crowded_scheme_takes_the_spare_space() -> None:
    """At 0.005 m/mm most letters of the press had to be left out, with space on its sheet."""
    solution = Solution(load(path_of("press/press")), positions=ALL_ROUND)
    assert is_too_dense(solution.construction, solution.si, 0.005)
    assert solution.scales[PlanKind.POSITION].per_mm == pytest.approx(0.004)
