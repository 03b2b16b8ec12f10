"""The lever of many loads is drawn larger than the velocity plan, and read at that scale."""

from __future__ import annotations

import numpy as np
import pytest
from doors import (
    PLACE,
    TIMES,
    ForceReading,
    LeverNarrator,
    LeverReading,
    PlanKind,
    Solution,
    Text,
    get_language,
    kinematics_sheets,
    lettered,
    next_scale,
    settle,
    statics_of,
)
from lettered import lever_lines
from worked import path_of, problem_of

from planmethod import loads

RU = get_language("ru")
SHIPPED = ("levers/six-link", "levers/task12", "press/press", "levers/task-66")


def solved(more: int) -> Solution:
    """Return the solution of the six-link mechanism with ``more`` additional loads."""
    text = path_of("levers/six-link").read_text("utf-8")
    for k in range(more):
        text += f'\n[[loads]]\nname = "F_{{a{k}}}"\nlink = "2"\nat = "{("B", "C", "S2")[k % 3]}"\n'
        text += f"force = {300 + 40 * k}\nangle = {29 * k + 11}\n"
    return Solution(loads(text, name="loaded"))


@pytest.fixture(scope="module")
def crowded() -> ForceReading:
    return ForceReading(solved(12), 0)


@pytest.mark.parametrize("name", SHIPPED)
def test_a_lever_of_few_loads_is_the_turned_plan(name: str) -> None:
    solution = Solution(problem_of(name))
    assert (statics_of(solution).lever_times == 1.0).all()
    assert LeverNarrator(lettered(ForceReading(solution, 0), RU)).larger() == []


def test_a_full_lever_has_a_scale_of_its_own(crowded: ForceReading) -> None:
    lever, plan = LeverReading(crowded), crowded.solution.plan_scale(PlanKind.VELOCITY, 0)
    assert lever.times in TIMES
    assert lever.scale.per_mm * lever.times == pytest.approx(plan.per_mm)
    motion = crowded.solution.construction.kinematics.velocity
    on_plan = crowded.solution.ruler_reading.point(motion.point[motion.named["C"]])[0]
    assert lever.place(motion.point[motion.named["C"]]) == pytest.approx(1j * lever.times * on_plan)
    (said,) = LeverNarrator(lettered(crowded, RU)).larger()
    assert RU.notation.as_input(1.0 / lever.scale.per_mm) in said  # the file has mm per unit


def test_its_arms_are_read_with_the_ruler_where_they_are_drawn(crowded: ForceReading) -> None:
    """To half a millimetre of the lever, not of the plan that is smaller; they are in balance."""
    lever, ruler = LeverReading(crowded), crowded.solution.ruler_arithmetic.ruler
    arms = np.array([one.arm for one in lever.forces])
    assert np.allclose(arms / ruler, np.round(arms / ruler), atol=1e-6)
    assert (np.round(arms / ruler) % lever.times > 0).any()
    for one in lever.forces:
        across = (one.at.conjugate() * one.force).imag / abs(one.force)
        assert one.arm == pytest.approx(across, abs=ruler / 2 + 1e-6)
    moments = [one.size * one.arm for one in lever.forces]
    moments += [one.lever_moment for one in lever.couples]
    assert sum(moments) == pytest.approx(0.0, abs=1e-6 * max(map(abs, moments)))


def test_the_sheet_has_the_scale_and_the_lengths_of_the_lever(crowded: ForceReading) -> None:
    sheet, *_ = kinematics_sheets(crowded.solution.problem, layout="forces")
    levers = [view for view in sheet.views if view.kind == "velocity"]
    plan, own = crowded.solution.scales[PlanKind.VELOCITY], LeverReading(crowded).scale
    assert own.per_mm in [pytest.approx(view.per_mm) for view in levers]
    assert own.per_mm != pytest.approx(plan.per_mm)
    written = "".join(item.text for item in sheet.items if isinstance(item, Text))
    arm = max(abs(one.arm) for one in LeverReading(crowded).forces)
    assert RU.notation.measured(arm) in written
    assert any(RU.notation.measured(arm) in line for line in lever_lines(crowded))


def test_the_lever_of_a_project_fills_its_place() -> None:
    """At a scale of the series: the next finer one does not fit; a large plan is the lever."""
    settled = settle(problem_of("machines/compressor")).problem
    solution = Solution(settled)
    statics, motion = statics_of(solution), solution.construction.kinematics.velocity
    at = np.array([solution.paper.point(one) for one in {motion.pole, *motion.point.values()}])
    width, height = np.ptp(at.imag, axis=0), np.ptp(at.real, axis=0)  # it is turned
    own = solution.scales[PlanKind.VELOCITY].per_mm
    assert {round(float(times), 9) for times in statics.lever_times} == {1.25, 2.0}
    for k, times in enumerate(statics.lever_times):
        finer = own / next_scale(own / times, finer=True)
        assert max(finer * width[k] / PLACE[0], finer * height[k] / PLACE[1]) > 1.0
        if times > 1.0:
            assert max(times * width[k] / PLACE[0], times * height[k] / PLACE[1]) <= 1.0
            assert len(LeverNarrator(lettered(ForceReading(solution, k), RU)).larger()) == 1


def test_a_lever_is_as_large_as_a_plan_with_points_that_no_force_plan_has() -> None:
    solution = Solution(settle(problem_of("levers/task-1")).problem)
    statics, motion = statics_of(solution), solution.construction.kinematics.velocity
    assert not {*motion.point.values()} <= {*statics.paper.value}
    assert (statics.lever_times >= 1.0).all()
