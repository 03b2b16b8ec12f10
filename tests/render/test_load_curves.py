"""Diagrams of tabulated loads: their rows, and their values in a position."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from doors import (
    AXIS,
    DIAGRAM_CURVE as CURVE,
    Arc,
    BlockOptions,
    BlockStyle,
    DrawingItem as Item,
    Interpolation,
    ModelProblem as Problem,
    Over,
    SizeTable,
    Solution,
    Stroke,
    composition,
    get_language,
    kinds_load as load,
    load_curves,
)
from msgspec.structs import replace
from worked import ROOT, problem_of

LAYOUT = composition("forces")
(ENTRY,) = (entry for entry in LAYOUT.blocks if entry.kind == "load-curves")
MANNER = BlockStyle(ENTRY, LAYOUT.sizes_for("A1"), 800.0, BlockOptions(get_language("en")))


def with_table(table: SizeTable, phi: float) -> list[Item]:
    problem = problem_of("press/press")
    assert problem.dynamics is not None
    (load,) = problem.dynamics.loads
    dynamics = replace(problem.dynamics, loads=(replace(load, size=table),))
    changed: Problem = replace(problem, dynamics=dynamics)
    return load_curves(Solution(changed, positions=[phi]), [0], MANNER).place(0j)


def corner(items: list[Item]) -> complex:
    across = max((i for i in items if isinstance(i, Stroke) and i.tag == AXIS),
                 key=lambda axis: axis.points[1].real - axis.points[0].real)  # fmt: skip
    return across.points[0]


@pytest.mark.parametrize("turned", [0.0, 40.0, 130.0, 300.0])
@pytest.mark.parametrize("interpolation", Interpolation)
def test_a_ring_marks_the_load_on_the_curve(turned: float, interpolation: Interpolation) -> None:
    """Wherever the rows of a turn begin, the axis is from 0 to 360 degrees."""
    at = (turned, turned + 90.0, turned + 200.0)
    items = with_table(SizeTable(Over.PHI, at, (100.0, 500.0, 300.0), interpolation), 250.0)
    (ring,) = (item.centre for item in items if isinstance(item, Arc))
    parts = [i.points for i in items if isinstance(i, Stroke) and i.tag.startswith(CURVE)]
    start = corner(items)
    places = np.array([place - start for points in parts for place in points])
    assert np.ptp(places.real) == pytest.approx(360.0 / 4.0)
    assert (ring - start).real == pytest.approx(250.0 / 4.0)
    on = [
        abs(abs(ring - a) + abs(b - ring) - abs(b - a))
        for points in parts
        for a, b in itertools.pairwise(points)
    ]
    assert min(on) < 1e-9


def test_where_a_load_does_not_act_its_diagram_shows_no_size() -> None:
    assert not [
        i
        for i in with_table(SizeTable(Over.PHI, (0.0, 90.0), (0.0, 0.0)), 50.0)
        if isinstance(i, Arc)
    ]


def test_a_load_of_one_stroke_has_no_diagram_over_the_other() -> None:
    """A crusher's resistance rises to 40 kN while K goes left, and is zero on the way back."""
    problem = load(ROOT / "tests/data/turn/crusher.toml")
    items = load_curves(Solution(problem, positions=[180.0]), [0], MANNER).place(0j)
    start = corner(items)
    parts = [i.points for i in items if isinstance(i, Stroke) and i.tag.startswith(CURVE)]
    places = [((p - start).real * 4.0, (p - start).imag) for points in parts for p in points]
    high = [x for x, y in places if y > 0.1]
    assert high and min(high) > 89.0 and max(high) == pytest.approx(264.80, abs=0.01)
    assert min(x for x, _ in places) == pytest.approx(0.0)
    assert max(x for x, _ in places) == pytest.approx(360.0)
    (ring,) = (item.centre for item in items if isinstance(item, Arc))
    assert (ring - start).real * 4.0 == pytest.approx(180.0)
    back = load_curves(Solution(problem, positions=[300.0]), [0], MANNER).place(0j)
    assert not [item for item in back if isinstance(item, Arc)]


def test_loads_that_do_not_change_have_no_diagram() -> None:
    assert load_curves(Solution(problem_of("levers/six-link")), [0], MANNER).height == 0.0
