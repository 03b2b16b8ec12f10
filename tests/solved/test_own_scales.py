"""Plans of many positions that have scales of their own."""

from __future__ import annotations

import numpy as np
from worked import problem_of

from planmethod.plans.model import RATES
from planmethod.solved.scaling import sizes
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
