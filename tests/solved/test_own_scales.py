"""Plans of many positions that have scales of their own."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from worked import problem_of

from planmethod.plans.model import RATES, PlanKind
from planmethod.problem.model import Scales
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.scaling import Views, sizes
from planmethod.solved.solution import Solution


def test_a_scale_is_found_where_all_plans_have_scales_of_their_own() -> None:
    """They are of so different sizes that none of three has room beside the others."""
    problem = problem_of("levers/task-16")
    first = problem.drive.positions[0]
    solution = Solution(problem, positions=[first + 120.0 * k for k in range(3)])
    for kind in RATES:
        own = [solution.own_scale(kind, i).per_mm for i in range(3)]
        drawn = np.maximum(*sizes(solution.construction, solution.si, kind)) / own
        assert (drawn[drawn > 0.0] > 20.0).all()


def test_a_plan_is_read_at_the_scale_at_which_it_is_drawn() -> None:
    """Its segments and their errors are those of the position alone at that scale."""
    problem = problem_of("levers/task-49")
    together = Solution(problem, positions=[30.0, 150.0, 270.0])
    kind = PlanKind.ACCELERATION
    own = [together.own_scale(kind, i).per_mm for i in range(3)]
    assert own == [5.0, 1.0, 1.0]
    scales = {k: together.own_scale(k, 0) for k in PlanKind if k in together.scales}
    alone = Solution(problem, positions=[30.0, 30.0], scales=scales)
    for one, other in zip(together.segments(kind), alone.segments(kind), strict=True):
        assert one.exact[0] == pytest.approx(other.exact[0], rel=1e-12)
        assert one.read[0] == pytest.approx(other.read[0], rel=1e-12)
    found = drafting_of(together).spreads["a_D"].sigma[0]
    assert found == pytest.approx(drafting_of(alone).spreads["a_D"].sigma[0], rel=1e-9)


def test_a_scale_of_the_file_is_left_by_sheets_alone() -> None:
    problem = problem_of("levers/task-13")
    given = replace(problem, scales=Scales(mu_a=0.25))
    positions = [30.0, 150.0, 270.0]
    told = Solution(given, positions=positions)
    drawn = Solution(given, positions=positions, views=Views.for_paper("A2", 3))
    assert told.per_mm["mu_a"] == 0.25
    assert (drawn.per_mm["mu_a"] >= 0.25).all()
    assert drawn.own_scale(PlanKind.ACCELERATION, 2).per_mm > 0.25
