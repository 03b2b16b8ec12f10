"""Enlarged views: which segments are short, where they are read, and how well."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import numpy as np
import pytest
from doors import (
    DETAIL_VIEWS_SHORT as SHORT,
    DETAIL_VIEWS_SMALL as SMALL,
    ENLARGED,
    NEGLIGIBLE_LENGTH,
    RATIOS,
    SHOWN,
    Arc,
    Disc,
    PictureStyle,
    PlanKind,
    Scales,
    Solution,
    Text,
    calculation,
    circle_radius,
    detail_pictures,
    detail_view_letter,
    fold,
    get_language,
    kinematics_sheets,
    min_enlarged,
    plan_picture,
    plan_places,
    sizes,
    vector_label,
)
from msgspec.structs import replace
from worked import problem_of

from benchmarks.sheets import positions_of

NAMES = (
    "linkages/ex1", "linkages/2.1.7", "levers/task-33", "levers/task-37", "levers/task-43",
    "levers/task-20", "levers/task-49", "levers/task-57", "levers/task-65", "press/press",
)  # fmt: skip

NEAR = ("levers/task-35", "levers/task-51")  # with two short components at one point


def solutions() -> Iterator[Solution]:
    for name in NAMES:
        yield Solution(problem_of(name))


def test_no_view_has_the_letter_of_a_point() -> None:
    """А, В and С of a sheet in Russian look like the points A, B and C."""
    knots = [
        knot for solution in solutions() for each in solution.detail_views.values() for knot in each
    ]
    assert any("A" in knot.initials for knot in knots)
    for knot in knots:
        assert {"O", "A"} & knot.initials
        for lang in ("ru", "en"):
            assert fold(detail_view_letter(knot, get_language(lang))) not in knot.initials
    assert {detail_view_letter(knot, get_language("ru")) for knot in knots} >= {"Б"}


def test_every_short_segment_is_in_one_knot_and_long_enough_there() -> None:
    count = 0
    for solution in solutions():
        for kind, knots in solution.detail_views.items():
            plan = solution.construction.plan(kind)
            found = [frozenset(ends) for knot in knots for ends in knot.ends]
            assert len(found) == len(set(found))
            for vector in plan.vectors:
                length = abs(complex(solution.paper.vector(vector.tail, vector.head)[0]))
                is_short = NEGLIGIBLE_LENGTH <= length < SHORT
                assert (frozenset((vector.tail, vector.head)) in found) == is_short
            for knot in knots:
                assert knot.times in RATIOS
                for tail, head in knot.ends:
                    length = abs(complex(solution.paper.vector(tail, head)[0])) * knot.times
                    assert SHORT <= length < 60.0
                    count += 1
    assert count >= 6


def test_segments_on_a_view_are_read_to_five_per_cent_and_the_calculation_names_the_view() -> None:
    """Half a division of the ruler is less than 5 % of the enlarged segment."""
    seen = 0
    for solution in solutions():
        for name, knot in solution.read_on(0).items():
            read, drawn = (
                float(r.number(name)[0]) for r in (solution.ruler_reading, solution.paper)
            )
            step = solution.ruler_arithmetic.ruler / knot.times
            assert read / step == pytest.approx(round(read / step), abs=1e-6)
            assert step / 2 <= 0.0501 * abs(drawn) + 1e-9
            seen += 1
        told = [
            line
            for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION)
            for line in calculation(solution, kind, 0, get_language("ru"))
            if "по виду" in line
        ]
        assert bool(told) == bool(solution.read_on(0))
    assert seen >= 3


def test_a_segment_below_half_a_division_is_called_zero() -> None:
    solution = Solution(problem_of("levers/task-33"))
    lines = calculation(solution, PlanKind.ACCELERATION, 0, get_language("ru"))
    (nothing,) = (line for line in lines if "≈ 0" in line)
    assert nothing == "a^{r}_{D5D} = μ_{a}·(k_{D5D}d_{5}) ≈ 0"
    assert min_enlarged(0.5) == NEGLIGIBLE_LENGTH > min_enlarged(0.01) == SHORT / RATIOS[-1]


def test_short_segments_of_many_positions_are_not_enlarged() -> None:
    solution = Solution(problem_of("levers/task-49"), positions=[30.0, 60.0])
    assert not any(solution.detail_views.values())
    assert not solution.ruler_arithmetic.enlargements


def test_a_small_plan_of_many_is_shown_enlarged_beside_itself_and_read_there() -> None:
    """At a scale that the file gives, where one plan is much larger than the others."""
    positions = [30.0 * k for k in range(12)]
    problem = problem_of("levers/task-61")
    problem = replace(problem, scales=Scales(mu_v=0.4, mu_a=20.0))
    solution = Solution(problem, positions=positions)
    assert solution.has_common(PlanKind.ACCELERATION)
    small = solution.small_plans[PlanKind.ACCELERATION]
    assert small
    width, height = sizes(solution.construction, solution.si, PlanKind.ACCELERATION)
    drawn = np.maximum(width, height) / solution.scales[PlanKind.ACCELERATION].per_mm
    assert {k for k in range(12) if drawn[k] < SMALL} == set(small)
    assert all(knot.times * drawn[k] >= SHOWN for k, knot in small.items())
    for k in small:
        for name, knot in solution.read_on(k).items():  # those of the velocity plan have their own
            read = float(solution.ruler_reading.number(name)[k]) * knot.times
            assert read / 0.5 == pytest.approx(round(read / 0.5), abs=1e-6)
    words = get_language("ru")
    every = [k for found in solution.small_plans.values() for k in found.values()]
    assert (
        len({detail_view_letter(knot, words) for knot in every}) == len(every) > 12
    )  # of nine letters
    shown: list[int] = []
    for sheet in kinematics_sheets(problem, positions=positions):
        (view,) = (v for v in sheet.views if v.kind == "acceleration")
        own = {span.position for span in view.spans if span.position is not None}
        enlarged = {span.position for span in view.spans if span.magnification > 1.0}
        assert enlarged == own & set(small)
        tags = {i.tag for i in sheet.items if isinstance(i, Arc) and i.tag.startswith(ENLARGED)}
        assert {f"{ENLARGED} {small[k].number}" for k in own & set(small)} <= tags
        shown += sorted(own)
    assert shown == list(range(12))


def test_a_crowd_of_short_segments_of_few_positions_is_read_and_lettered_on_its_view() -> None:
    problem = problem_of("levers/task-19")
    at = positions_of(problem, 3)
    solution = Solution(problem, positions=at)
    plan = solution.construction.plan(PlanKind.ACCELERATION)
    ((index, crowd),) = solution.small_plans[PlanKind.ACCELERATION].items()
    assert 4 <= len(crowd.ends) < len(plan.vectors)
    read = {name: v for name, v in solution.read_on(index).items() if v.number == crowd.number}
    assert read
    for name, view in read.items():
        length = float(solution.ruler_reading.number(name)[index]) * view.times
        assert length / 0.5 == pytest.approx(round(length / 0.5), abs=1e-6)
    (sheet,) = kinematics_sheets(problem, positions=at)
    tag = f"{ENLARGED} {crowd.number} place"
    (circle,) = [item for item in sheet.items if isinstance(item, Arc) and item.tag == tag]
    texts = [item for item in sheet.items if isinstance(item, Text)]
    pole = min(
        (i for i in sheet.items if isinstance(i, Disc) and i.tag == "pole"),
        key=lambda disc: abs(disc.centre - circle.centre),
    )
    for text in texts:
        if text.label.startswith(f"acceleration {index}: ") and text.names is not None:
            is_outside = abs(text.names - circle.centre) > circle.radius - 0.1
            assert is_outside or abs(text.names - pole.centre) < 0.3, text.label
    shown = {t.label for t in texts if t.label.startswith(f"{ENLARGED} {crowd.number}: ")}
    assert len(shown) >= len(crowd.ends)


def test_a_sheet_has_a_circle_at_each_knot_and_its_view_with_measured_segments() -> None:
    problem = problem_of("levers/task-57")
    (sheet,) = kinematics_sheets(problem)[:1]
    knots = [knot for each in Solution(problem).detail_views.values() for knot in each]
    tags = [i.tag for i in sheet.items if isinstance(i, Arc) and i.tag.startswith(ENLARGED)]
    assert knots
    assert sorted(tags) == sorted(
        f"{ENLARGED} {knot.number}{part}" for knot in knots for part in ("", " place")
    )
    spans = [span for view in sheet.views for span in view.spans]
    assert sum(span.magnification > 1.0 for span in spans) == sum(len(knot.ends) for knot in knots)
    assert min(span.length for span in spans) >= SHORT


def test_a_vector_without_a_name_on_the_plan_has_it_on_its_view() -> None:
    """Shorter than 5 mm it is too short for a name there; on the view it is long enough."""
    wanted = named = 0
    for solution in solutions():
        for kind, knots in solution.detail_views.items():
            plan = solution.construction.plan(kind)
            views = detail_pictures(solution, kind, 0, letter_height=5.0, use_ruler=False)
            for knot, view in zip(knots, views, strict=True):
                there = {item.label for item in view.items if isinstance(item, Text)}
                symbols = {frozenset((v.tail, v.head)): v for v in reversed(plan.vectors)}
                for vector in (symbols[frozenset(ends)] for ends in knot.ends):
                    length = abs(complex(solution.paper.vector(vector.tail, vector.head)[0]))
                    if length < SHORT <= length * knot.times:
                        wanted += 1
                        named += vector_label(f"{ENLARGED} {knot.number}", vector) in there
    assert wanted >= 6
    assert named >= 0.8 * wanted


def test_circles_of_one_plan_do_not_overlap_and_near_segments_share_a_view() -> None:
    seen = 0
    for solution in map(Solution, map(problem_of, [*NAMES, *NEAR])):
        for kind, knots in solution.detail_views.items():
            places = plan_places(solution, kind, 0)
            for one, two in combinations(knots, 2):
                reach = circle_radius(one, places) + circle_radius(two, places)
                assert abs(one.centre - two.centre) >= reach
            seen += sum(len(knot.ends) > 1 for knot in knots)
    assert seen >= len(NEAR)


def test_the_letter_of_a_view_is_larger_than_those_of_points() -> None:
    (sheet,) = kinematics_sheets(problem_of("levers/task-57"))[:1]
    texts = [item for item in sheet.items if isinstance(item, Text)]
    views = [item.height for item in texts if item.label.startswith(f"{ENLARGED} ")]
    assert max(views) > max(item.height for item in texts if "acceleration 0:" in item.label)


@pytest.mark.parametrize("height", [3.5, 5.0])
def test_nearly_all_vectors_of_a_single_plan_have_names(height: float) -> None:
    """Beside the vector, on a leader line or on a view: at least 88 of 100."""
    wanted = named = 0
    for solution in map(Solution, map(problem_of, (*NAMES, *NEAR))):
        for kind, knots in solution.detail_views.items():
            plan, places = solution.construction.plan(kind), plan_places(solution, kind, 0)
            letters = tuple("БГДЖИКЛМ"[: len(knots)])
            whole = plan_picture(solution, kind, 0, PictureStyle(height), detail_letters=letters)
            views = detail_pictures(
                solution, kind, 0, letter_height=height, use_ruler=False, whole=whole
            )
            there = {
                item.label.rpartition(": ")[2]
                for picture in (whole, *views)
                for item in picture.items
                if isinstance(item, Text)
            }
            long = [v for v in plan.vectors if abs(places[v.head] - places[v.tail]) >= SHORT]
            wanted += len(long)
            named += sum(vector.symbol in there for vector in long)
    assert wanted >= 100
    assert named >= 0.88 * wanted, (named, wanted)
