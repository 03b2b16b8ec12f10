"""Scales of sheets: from the series, one for all plans of a kind, the same as in solve."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from cases import each, sampled, thinned
from doors import (
    AROUND_PLAN,
    FACTS,
    FULL,
    MOTION,
    RATES,
    PlanRequest,
    Solution,
    Text,
    clear_position,
    kind_of,
    kinematics_sheet_scales as sheet_scales,
    kinematics_sheets,
    problem_loads as loads,
)
from msgspec.structs import replace
from scales import uneven_scales
from worked import PROBLEMS, problem_of

from benchmarks.generator import random_problem

TURN = [30.0 * k for k in range(12)]

SHEETS = [
    ("linkages/ex3", None, None), ("linkages/ex3", None, TURN), ("press/press", "coursework", None),
    ("press/press", "forces", None), ("press/press", "forces-cycle", TURN),
    ("machines/engine", "flywheel", None), ("machines/compressor", "flywheel", None),
    ("machines/engine", "coursework", None), ("levers/task-12", "coursework", None),
    ("machines/balanced-crank", "balancing", None), ("linkages/2.1.7", "homework", None),
    ("linkages/2.1.7", "compact", None), ("levers/task-49", None, TURN),
]  # fmt: skip


@pytest.mark.parametrize(("name", "layout", "positions"), thinned(SHEETS, 2))
def test_scales_are_of_the_series(
    name: str, layout: str | None, positions: Sequence[float] | None
) -> None:
    for sheet in kinematics_sheets(problem_of(name), layout=layout, positions=positions):
        assert list(uneven_scales(sheet)) == []


@pytest.mark.parametrize(
    "path", thinned(sorted((PROBLEMS / "gears").rglob("*.toml")), 12), ids=lambda path: path.stem
)
def test_scales_of_trains_are_of_the_series(path: object) -> None:
    kind = kind_of(path)  # type: ignore[arg-type]
    made = kind.drawings(kind.load(path, None), PlanRequest())  # type: ignore[arg-type]
    for sheet in made:
        assert list(uneven_scales(sheet)) == []


LENGTHS = 'zero = "extreme"\nlength = 288\npole = { v = 36, a = 36 }\n'


def test_lengths_given_in_millimetres_are_kept_and_their_scale_is_inscribed() -> None:
    text = (PROBLEMS / "press/press.toml").read_text("utf-8")
    problem = loads(f"{text}\n[cycle]\n{LENGTHS}", name="press")
    (sheet,) = kinematics_sheets(problem, layout="coursework")
    assert any("1,25 град/мм" in text for text in uneven_scales(sheet))


SAME = [
    "linkages/ex1", "linkages/ex3", "linkages/2.1.25", "linkages/2.1.33", "linkages/2.1.35",
    "levers/task-13", "levers/task-33", "levers/task-49", "levers/task12", "press/press",
    "machines/engine", "levers/task-61",
]  # fmt: skip


@each("name, positions", sampled([(name, n) for name in SAME for n in (None, 3, 12)], 7))
def test_sheets_and_numbers_have_the_same_scales(name: str, positions: int | None) -> None:
    """On default sheets, for any positions: one scale for all plans of a kind on all sheets."""
    problem = problem_of(name)
    first = problem.drive.positions[0]
    asked = None if positions is None else [first + 360 / positions * k for k in range(positions)]
    solution = Solution(problem, positions=asked)
    expected = {kind.value: solution.scales[kind].per_mm for kind in MOTION}
    for sheet in kinematics_sheets(problem, positions=asked):
        found = {view.kind: view.per_mm for view in sheet.views if view.kind in expected}
        assert found.items() <= expected.items()


@pytest.mark.dear
@pytest.mark.parametrize("layout", ["homework", "coursework"])
def test_scales_that_a_layout_has_taken_are_kept_when_they_are_decided(layout: str) -> None:
    problem = problem_of("press/press" if layout == "coursework" else "linkages/2.1.7")
    decided = sheet_scales(problem, layout)
    assert decided.decided
    sheets = kinematics_sheets(problem, layout=layout)
    again = kinematics_sheets(replace(problem, scales=decided), layout=layout)
    for some in (sheets, again):
        views = {view.kind: view.per_mm for sheet in some for view in sheet.views}
        for kind in MOTION:
            assert views[kind.value] == getattr(decided, FACTS[kind].scale)
    # Other layouts, and positions for which they are too fine on usual paper, keep to them too.
    other = replace(problem, scales=decided)
    for sheet in kinematics_sheets(other, positions=TURN):
        for view in sheet.views:
            if view.kind in ("velocity", "acceleration"):
                assert view.per_mm in (decided.mu_v, decided.mu_a)


def test_the_bold_position_has_its_joints_apart_and_no_zero_vector_on_a_plan() -> None:
    """D comes to O in one position of twelve, and the output turns back in others."""
    problem = loads(OVER, name="over")
    solution = Solution(problem)
    bold = clear_position(solution)
    places = [solution.paper.point(name)[bold] for name in "OABCDE"]  # type: ignore[arg-type]
    gaps = [abs(p - q) for k, p in enumerate(places) for q in places[:k]]
    assert min(gaps) >= 3.0
    for kind in (kind for kind in MOTION if kind is not MOTION[0]):
        for vector in solution.construction.plan(kind).vectors:
            size = abs(solution.paper.vector(vector.tail, vector.head)).tolist()
            assert size[bold] >= 1.0 or sorted(size)[6] < 7.0


OVER = """
[frame]
O = [0, 0]
C = [1, 0]
[links.1]
points = ["O", "A"]
OA = 0.5
[links.2]
points = ["A", "B", "D"]
AB = 1
AD = 0.5
angle.DAB = 90
[links.3]
points = ["C", "B"]
CB = 1
[links.4]
points = ["D", "E"]
DE = 1.2
[links.5]
points = ["E"]
slides = { on = "3", along = "CB" }
[driver]
link = "1"
phi = { from = 0, count = 12 }
omega = 10
epsilon = 50
[assembly]
B = "above C"
E = "above B"
"""


def test_a_plan_of_many_short_vectors_takes_a_larger_paper() -> None:
    """On A2 22 vectors of its acceleration plan lie within 36 × 48 mm."""
    solution = Solution(loads(random_problem(91304)[0], name="crowded"))
    assert solution.views.paper == "A1"
    for kind in RATES:
        (wide,), (high,) = (
            side / solution.scales[kind].per_mm for side in solution.extents.plans[kind]
        )
        count = len({frozenset((v.tail, v.head)) for v in solution.construction.plan(kind).vectors})
        assert count <= FULL * (wide + 2 * AROUND_PLAN) * (high + 2 * AROUND_PLAN) / 1e4
    (sheet,) = kinematics_sheets(solution.problem)
    assert sheet.width == 841


RANDOM = [random_problem(seed)[0] for seed in range(62_100, 62_112)]

CAPTIONS = {"скоростей": "velocity", "ускорений": "acceleration"}


@pytest.mark.parametrize("text", thinned(RANDOM, 3))
def test_texts_of_a_plan_stand_with_it_at_the_scales_of_solve(text: str) -> None:
    problem = loads(text, name="random")
    scales = {kind.value: scale.per_mm for kind, scale in Solution(problem).scales.items()}
    (sheet,) = kinematics_sheets(problem)
    plans = {view.kind: view for view in sheet.views if view.kind in CAPTIONS.values()}
    assert all(view.per_mm == scales[kind] for kind, view in plans.items())
    for caption in (item for item in sheet.items if isinstance(item, Text)):
        first, _, of = caption.text.partition(" ")
        if first in ("Уравнения", "Расчёт") and of in CAPTIONS:
            left, low, right, high = plans[CAPTIONS[of]].box
            x, y = caption.at.real, caption.at.imag
            assert abs(complex(max(left - x, 0, x - right), max(low - y, 0, y - high))) < 100.0
