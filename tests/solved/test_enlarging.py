"""Enlarged views: which segments are short, where they are read, and how well."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from worked import problem_of

from planmethod.note.narrate.steps import calculation
from planmethod.note.wording import language
from planmethod.plans.model import PlanKind
from planmethod.render.ink.drawing import Arc
from planmethod.render.pictures.enlarged import ENLARGED
from planmethod.render.sheets.kinematics import kinematics_sheets
from planmethod.solved.enlarging import NOTHING, RATIOS, SHORT, least_shown
from planmethod.solved.solution import Solution

NAMES = (
    "linkages/ex1", "linkages/2.1.7", "levers/task-33", "levers/task-37", "levers/task-43",
    "levers/task-20", "levers/task-49", "levers/task-57", "levers/task-65", "press/press",
)  # fmt: skip


def solutions() -> Iterator[Solution]:
    for name in NAMES:
        yield Solution(problem_of(name))


def test_every_short_segment_is_in_one_knot_and_long_enough_there() -> None:
    count = 0
    for solution in solutions():
        for kind, knots in solution.knots.items():
            plan = solution.construction.plan(kind)
            found = [frozenset(ends) for knot in knots for ends in knot.ends]
            assert len(found) == len(set(found))
            for vector in plan.vectors:
                length = abs(complex(solution.paper.vector(vector.tail, vector.head)[0]))
                is_short = NOTHING <= length < SHORT
                assert (frozenset((vector.tail, vector.head)) in found) == is_short
            for knot in knots:
                assert knot.times in RATIOS
                for tail, head in knot.ends:
                    length = abs(complex(solution.paper.vector(tail, head)[0])) * knot.times
                    assert SHORT <= length < 60.0
                    count += 1
    assert count >= 6


def test_what_is_read_on_a_view_is_read_to_five_per_cent_and_the_calculation_says_where() -> None:
    """Half a division of the ruler is less than that of the segment as it is enlarged."""
    seen = 0
    for solution in solutions():
        for name, knot in solution.read_on.items():
            read, drawn = (float(r.number(name)[0]) for r in (solution.by_hand, solution.paper))
            step = solution.hand.ruler / knot.times
            assert read / step == pytest.approx(round(read / step), abs=1e-6)
            assert step / 2 <= 0.0501 * abs(drawn) + 1e-9
            seen += 1
        told = [
            line
            for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION)
            for line in calculation(solution, kind, 0, language("ru"))
            if "по виду" in line
        ]
        assert bool(told) == bool(solution.read_on)
    assert seen >= 3


def test_what_is_less_than_half_a_division_is_told_to_be_nothing() -> None:
    solution = Solution(problem_of("levers/task-33"))
    lines = calculation(solution, PlanKind.ACCELERATION, 0, language("ru"))
    (nothing,) = (line for line in lines if "≈ 0" in line)
    assert nothing == "a^{r}_{D5D} = μ_{a}·(k_{D5D}d_{5}) ≈ 0"
    assert least_shown(0.5) == NOTHING > least_shown(0.01) == SHORT / RATIOS[-1]


def test_many_positions_have_no_enlarged_views() -> None:
    solution = Solution(problem_of("levers/task-49"), positions=[30.0, 60.0])
    assert not any(solution.knots.values())
    assert not solution.hand.enlarged


def test_a_sheet_has_a_circle_at_each_knot_and_its_view_with_measured_segments() -> None:
    problem = problem_of("levers/task-57")
    (sheet,) = kinematics_sheets(problem)[:1]
    knots = [knot for each in Solution(problem).knots.values() for knot in each]
    tags = [i.tag for i in sheet.items if isinstance(i, Arc) and i.tag.startswith(ENLARGED)]
    assert knots
    assert sorted(tags) == sorted(
        f"{ENLARGED} {knot.number}{part}" for knot in knots for part in ("", " place")
    )
    spans = [span for view in sheet.views for span in view.spans]
    assert sum(span.share > 1.0 for span in spans) == sum(len(knot.ends) for knot in knots)
    assert min(span.length for span in spans) >= SHORT
