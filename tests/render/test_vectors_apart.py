"""Vectors on one line of a plan are drawn beside one another, true in length and direction."""

from __future__ import annotations

from itertools import combinations

import pytest
from cases import each
from doors import (
    Drawing,
    PlanKind,
    Solution,
    Span,
    Stroke,
    Text,
    get_language,
    kinematics_sheets,
    plan_places,
    shifts_apart,
)
from worked import problem_of

NOTE = get_language("ru").sheets.apart
ON_ONE_LINE = ("linkages/2.1.48", "linkages/2.1.65", "linkages/2.1.134")


def drawn(name: str) -> Drawing:
    (sheet,) = kinematics_sheets(problem_of(name))
    return sheet


def written(sheet: Drawing) -> str:
    return " ".join(item.text for item in sheet.items if isinstance(item, Text))


def hidden(one: Span, two: Span) -> float:
    """Return the length of the part of the shorter segment that lies on the other one, mm."""
    short, long = sorted((one, two), key=lambda span: abs(span.end - span.start))
    way = (long.end - long.start) / abs(long.end - long.start)
    places = [short.start + (short.end - short.start) * k / 100 for k in range(101)]
    seen = [(place - long.start) / way for place in places]
    inside = [0 <= at.real <= abs(long.end - long.start) and abs(at.imag) < 0.3 for at in seen]
    return sum(inside) / 101 * abs(short.end - short.start)


@each("name", ON_ONE_LINE)
def test_no_vector_of_a_plan_hides_another_one(name: str) -> None:
    sheet = drawn(name)
    for view in sheet.views:
        for one, two in combinations([s for s in view.spans if abs(s.end - s.start) > 1.0], 2):
            assert hidden(one, two) < 1.0, (one.name, two.name)
    assert NOTE.partition(" ")[0] in written(sheet)


@each("name", ON_ONE_LINE)
def test_a_displaced_vector_is_true_and_the_pole_is_in_its_place(name: str) -> None:
    solution, sheet = Solution(problem_of(name)), drawn(name)
    for view in sheet.views[1:]:
        kind = PlanKind(view.kind)
        plan = solution.construction.plan(kind)
        at = plan_places(solution, kind, 0, use_ruler=True)
        sizes = [at[v.head] - at[v.tail] for v in plan.vectors]
        assert len(view.spans) >= 2
        for span in view.spans:
            assert min(abs(span.end - span.start - size) for size in sizes) < 1e-6, span.name
            assert any(
                isinstance(item, Stroke) and abs(item.points[0] - span.start) < 1e-6
                for item in sheet.items
            )


def test_a_plan_without_vectors_on_one_line_says_nothing_of_them() -> None:
    assert NOTE.partition(",")[0] not in written(drawn("linkages/ex1"))


def test_the_first_of_vectors_on_one_line_keeps_its_place() -> None:
    line = [(0j, 40 + 0j), (0j, 20 + 0j), (30 + 0j, 5 + 0j), (0j, 20j)]
    first, second, third, across = shifts_apart(line)
    assert first == across == 0j
    assert {second, third} == {1.8j, -1.8j}


@pytest.mark.parametrize("end", [1.0, 40j, 40 + 40j, -40 + 0j])
def test_vectors_that_only_meet_stay(end: complex) -> None:
    """A short one that starts across another is not hidden by it."""
    assert shifts_apart([(0j, 40 + 0j), (0j, end * 1j if end == 1.0 else end)]) == [0j, 0j]
