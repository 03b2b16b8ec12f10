"""One scale for all plans of a kind; their own on request, or if there is no common one."""

from __future__ import annotations

import numpy as np
import pytest
from doors import (
    DEAD,
    OUTLIER,
    RATES,
    PlanKind,
    Scales,
    Solution,
    Text,
    drafting_of,
    kinematics_sheets,
    median,
    sizes,
    typical,
)
from msgspec.structs import replace
from worked import problem_of

from benchmarks.generator import random_problem
from planmethod import loads


@pytest.mark.parametrize("name", ["levers/task-16", "levers/task-49", "linkages/ex3"])
def test_plans_of_several_positions_have_one_scale_but_those_out_of_proportion(name: str) -> None:
    problem = problem_of(name)
    first = problem.drive.positions[0]
    solution = Solution(problem, positions=[first + 120.0 * k for k in range(3)])
    for kind in RATES:
        assert solution.has_common(kind)
        size = np.maximum(*sizes(solution.construction, solution.si, kind))
        own = [solution.plan_scale(kind, i) != solution.scales[kind] for i in range(3)]
        assert own == (np.abs(np.log(size / median(size))) > np.log(OUTLIER)).tolist()
        drawn = [side / solution.plan_scale(kind, i).per_mm for i, side in enumerate(size)]
        assert min(drawn) > 15.0 and max(drawn) < 3.0 * OUTLIER * min(drawn)


def test_a_scale_of_the_file_is_that_of_every_plan() -> None:
    """Even where one is several times larger than the others."""
    problem = problem_of("linkages/ex3")
    given = replace(problem, scales=Scales(mu_v=0.25, mu_a=20.0))
    solution = Solution(given, positions=[20.0, 140.0, 260.0])
    for kind in RATES:
        size = np.maximum(*sizes(solution.construction, solution.si, kind))
        assert size.max() > OUTLIER * median(size)
        assert {solution.plan_scale(kind, i) for i in range(3)} == {solution.scales[kind]}


def test_the_vectors_of_few_plans_are_long_enough_to_be_read() -> None:
    """The acceleration plan has many short vectors and one that is long."""
    solution = Solution(problem_of("levers/task-49"), positions=[30.0, 150.0, 270.0])
    for kind in RATES:
        vectors = solution.construction.plan(kind).vectors
        for i in range(3):
            lengths = [abs(solution.paper.vector(v.tail, v.head)[i]) for v in vectors]
            assert median(np.array([one for one in lengths if one > 0.01 * max(lengths)])) > 12.0


def test_plans_have_their_own_scales_if_the_file_requires_it() -> None:
    """Each fills its area, and is read and has errors at its scale."""
    problem = problem_of("levers/task-49")
    positions, kind = [30.0, 150.0, 270.0], PlanKind.ACCELERATION
    asked = replace(problem, scales=replace(problem.scales, own=True))
    together = Solution(asked, positions=positions)
    own = [together.plan_scale(kind, i).per_mm for i in range(3)]
    assert not together.has_common(kind) and len(set(own)) > 1
    scales = {k: together.plan_scale(k, 0) for k in PlanKind if k in together.scales}
    alone = Solution(problem, positions=[30.0, 30.0], scales=scales)
    for one, other in zip(together.segments(kind), alone.segments(kind), strict=True):
        assert one.exact[0] == pytest.approx(other.exact[0], rel=1e-12)
    found = drafting_of(together).spreads["a_D"].sigma[0]
    assert found == pytest.approx(drafting_of(alone).spreads["a_D"].sigma[0], rel=1e-9)
    assert kinematics_sheets(asked, positions=positions)


def test_a_scale_of_the_file_is_left_for_other_positions_where_it_is_too_fine() -> None:
    """By the numbers as by the sheet; decided ones never are."""
    problem = problem_of("levers/task-13")
    given = replace(problem, scales=Scales(mu_a=0.05))
    positions = [30.0 * k for k in range(12)]
    told = Solution(given, positions=positions)
    assert told.scales[PlanKind.ACCELERATION].per_mm > 0.05
    assert Solution(given).scales[PlanKind.ACCELERATION].per_mm == 0.05
    decided = replace(problem, scales=Scales(mu_a=0.05, decided=True))
    kept = Solution(decided, positions=positions)
    assert kept.scales[PlanKind.ACCELERATION].per_mm == 0.05


def test_a_plan_in_a_dead_position_has_a_scale_of_its_own() -> None:
    """At a common scale all other plans would be negligibly small.

    The crank is a millionth of a degree before the position where no plan closes.
    """
    problem = problem_of("linkages/2.1.4")
    first = problem.drive.positions[0] - 1e-6
    solution = Solution(problem, positions=[first + 120.0 * k for k in range(3)])
    kind = PlanKind.ACCELERATION
    size = np.maximum(*sizes(solution.construction, solution.si, kind))
    dead = size > DEAD * median(size)
    assert dead.sum() == 1
    own = [solution.plan_scale(kind, i) != solution.scales[kind] for i in range(3)]
    assert own == dead.tolist()
    assert solution.has_common(kind)


def test_plans_that_are_points_do_not_count_in_the_typical_size() -> None:
    assert typical(np.array([0.0, 3.0, 0.0, 1.0, 0.0])) == 2.0
    assert typical(np.zeros(3)) == 0.0


def test_a_position_out_of_proportion_is_not_drawn_but_named_and_has_dashes_in_the_table() -> None:
    """In position 1 a point of this mechanism is 17 times further away than in the others."""
    problem = loads(random_problem(96_001)[0], name="random")
    positions = [problem.drive.positions[0] + 120.0 * k for k in range(3)]
    solution = Solution(problem, positions=positions)
    assert solution.extents.drawable.tolist() == [True, False, True]
    (sheet,) = kinematics_sheets(problem, positions=positions)
    texts = [item.text for item in sheet.items if isinstance(item, Text)]
    notes = [text for text in texts if text.startswith("Положение 1 не вычерчено")]
    assert len(notes) == 1 + len(RATES)  # above the scheme and the plans
    for view in sheet.views:
        assert {span.position for span in view.spans} <= {0, 2}
        assert max(view.box[2] - view.box[0], view.box[3] - view.box[1]) > 120.0
    assert "30290" not in texts and not [text for text in texts if text.lstrip("−-") == "99,0"]
    assert texts.count("—") > 20


def test_a_position_that_would_make_a_knot_of_the_others_is_told_and_not_on_the_scheme() -> None:
    """Its plans are drawn."""
    problem = loads(random_problem(97_003)[0], name="random")
    first = problem.drive.positions[0]
    angles = (0, 20, 45, 65, 90, 110, 135, 155, 180, 200, 225, 245)
    solution = Solution(problem, positions=[first + angle for angle in angles])
    assert solution.extents.drawable.all()
    assert np.flatnonzero(~solution.extents.on_scheme).tolist() == [9, 10, 11]
    *_, sheet = kinematics_sheets(problem, positions=solution.positions.tolist())
    texts = [item.text for item in sheet.items if isinstance(item, Text)]
    told = [text for text in texts if text.startswith("Положений 9, 10, 11 на схеме нет")]
    assert len(told) == 1
    spans = {view.kind: {span.position for span in view.spans} for view in sheet.views}
    assert {9, 10, 11} <= spans["velocity"] & spans["acceleration"]


def test_positions_in_proportion_are_all_drawn() -> None:
    """Also those of a mechanism one of whose plans is much larger than the others."""
    for name in ("levers/task-16", "levers/task-49", "linkages/ex3"):
        problem = problem_of(name)
        first = problem.drive.positions[0]
        for count in (3, 12):
            positions = [first + 360.0 / count * k for k in range(count)]
            extents = Solution(problem, positions=positions).extents
            assert extents.drawable.all() and extents.on_scheme.all()


def test_a_scheme_on_two_sheets_is_as_large_as_each_of_them_permits() -> None:
    """Each sheet has its own rows of plans, and none has the plan of a position left out."""
    problem = loads(random_problem(99_005)[0], name="random")
    first = problem.drive.positions[0]
    turned = (0, 25, 55, 80, 110, 135, 165, 195, 220, 250, 300, 330)
    solution = Solution(problem, positions=[first + angle for angle in turned])
    assert np.flatnonzero(~solution.extents.drawable).tolist() == [2]
    (width,), (height,) = solution.extents.sizes[PlanKind.POSITION]
    per_mm = solution.scales[PlanKind.POSITION].per_mm
    assert max(width, height) / per_mm > 250.0
    velocity = PlanKind.VELOCITY
    vectors = typical(solution.extents.vectors[velocity])
    assert vectors / solution.scales[velocity].per_mm > 20.0
    half = [solution.extents.scheme_in(range(k, k + 6)) for k in (0, 6)]
    assert all(one[0] <= width and one[1] <= height for one in half)
    assert min(max(one) for one in half) < max(width, height)
