"""Traces of the construction: at the places of the steps, and only on request."""

from __future__ import annotations

from cmath import phase

import pytest
from doors import (
    CORNER,
    TRACE,
    Arc,
    DrawingItem as Item,
    IntersectCircles,
    IntersectLineCircle,
    PlanKind,
    PointName,
    Solution,
    Stroke,
    plan_places,
    plan_traces,
    scheme_traces,
    shown_traces,
)
from msgspec.structs import replace
from worked import SIX, drawn_sheets, problem_of

PLANS = (PlanKind.VELOCITY, PlanKind.ACCELERATION)


def arcs(items: list[Item]) -> list[Arc]:
    return [item for item in items if isinstance(item, Arc) and item.tag == TRACE]


def middle(arc: Arc) -> complex:
    return arc.centre + arc.radius * 1j ** ((arc.start + arc.end) / 2 / phase(1j))


@pytest.mark.parametrize("name", SIX)
def test_each_arc_of_the_scheme_leaves_one_short_notch_at_its_point(name: str) -> None:
    solution = Solution(problem_of(name))
    kinds = [type(step) for step in solution.construction.program.steps]
    compass = 2 * kinds.count(IntersectCircles) + kinds.count(IntersectLineCircle)
    found = arcs(scheme_traces(solution, 0, 1.0, True))
    places = [
        complex(solution.paper.point(PointName(p))[0]) for p in solution.construction.draft.points()
    ]
    assert len(found) == compass
    for arc in found:
        assert arc.radius * (arc.end - arc.start) < 17.0
        assert min(abs(place - middle(arc)) for place in places) < 1e-9
    (sheet,) = drawn_sheets(name)[:1]
    assert len([a for a in arcs(sheet.items) if a.radius * (a.end - a.start) > 8.5]) == compass


@pytest.mark.parametrize("name", SIX)
def test_directions_go_on_through_a_point_and_right_angles_are_right(name: str) -> None:
    solution, corners = Solution(problem_of(name)), 0
    for kind in PLANS:
        at = plan_places(solution, kind, 0)
        lines, _ = plan_traces(solution, kind, 0, at, True)
        for item in lines:
            if isinstance(item, Arc):
                assert min(abs(place - middle(item)) for place in at.values()) < 1e-9
                continue
            assert isinstance(item, Stroke)
            if len(item.points) == 2:
                start, end = item.points
                off = (
                    abs(((p - start) / (end - start)).imag * abs(end - start)) for p in at.values()
                )
                assert min(off) < 1e-9
                continue
            one, corner, two = item.points
            assert abs(((one - corner) / (two - corner)).real) < 1e-9
            assert abs(one - corner) == pytest.approx(CORNER)
            corners += 1
    assert corners or name == "linkages/ex1"


@pytest.mark.parametrize("name", SIX)
def test_every_trace_goes_on_beyond_the_head_of_its_vector_and_not_back_over_it(name: str) -> None:
    """One of no vector goes as far to both sides of the point."""
    solution, beyond = Solution(problem_of(name)), 0
    for kind in PLANS:
        at = plan_places(solution, kind, 0)
        (plan,) = (one for one in solution.construction.plans if one.kind is kind)
        for item in plan_traces(solution, kind, 0, at, True)[0]:
            if not isinstance(item, Stroke) or len(item.points) != 2:
                continue
            start, end = item.points
            spans = [
                (at[v.tail], at[v.head]) for v in plan.vectors if v.head in at and v.tail in at
            ]
            rests = [head for tail, head in spans if abs(head - tail) < 1e-6]
            if any(abs((start + end) / 2 - head) < 1e-6 for head in rests):
                continue
            ahead = [
                ((end - head) / (head - tail)).real > 0.0
                for tail, head in spans
                if abs(head - start) < 1e-6 < abs(head - tail)
                and abs(((end - head) / (head - tail)).imag) < 1e-6
            ]
            assert ahead and all(ahead), (start, end)
            beyond += 1
    assert beyond or name == "linkages/ex1"


def test_traces_are_those_of_one_position_unless_requested_or_forbidden() -> None:
    problem = problem_of("levers/six-link")
    one, many = Solution(problem), Solution(problem, positions=[150.0, 170.0])
    assert [shown_traces(s, None, has_space=True) for s in (one, many)] == [True, False]
    assert shown_traces(one, None, has_space=False) is False
    told = [
        Solution(replace(problem, sheet=replace(problem.sheet, traces=t))) for t in (True, False)
    ]
    assert [shown_traces(s, None, has_space=False) for s in told] == [True, False]
    assert shown_traces(told[1], ("C",), has_space=False) == ("C",)
    assert len(scheme_traces(one, 0, 1.0, ("C",))) == 2
    assert scheme_traces(one, 0, 1.0, ("H",)) == []
    for kind, letters in zip(PLANS, ("c", "c′"), strict=True):
        at = plan_places(one, kind, 0)
        some = plan_traces(one, kind, 0, at, (letters,))[0]
        assert 0 < len(some) < len(plan_traces(one, kind, 0, at, True)[0])
