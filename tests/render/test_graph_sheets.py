"""Graphs of requested quantities and transfer functions on sheets: drawn values against exact."""

from __future__ import annotations

import numpy as np
import pytest
from cases import each
from doors import (
    DIAGRAM_CURVE as CURVE,
    CycleTask,
    DrawingItem as Item,
    Solution,
    Stroke,
    diagrams_of,
    get_language,
    graph_groups,
    graph_picture,
    kinematics_sheets,
    lint,
    quantities_over,
    values_over,
)
from msgspec.structs import replace
from reading import texts
from worked import drawn_sheets, problem_of

ASKED = ("x_E", "y_E", "v_qx_D", "v_qy_D", "u_31", "u_41", "phi_3", "omega_3", "a_D")


def said(items: list[Item] | tuple[Item, ...]) -> str:
    return " ".join(text.text for text in texts(items))


def test_curves_are_the_exact_quantities_in_their_scale() -> None:
    solution = Solution(problem_of("linkages/ex3"))
    diagrams = diagrams_of(solution)
    groups = graph_groups(diagrams.cycle, ASKED)
    assert [[one.label for one in group] for group in groups] == [
        ["x_E", "y_E"],
        ["v_qx_D", "v_qy_D"],
        ["u_31", "u_41"],
        ["phi_3"],
        ["omega_3"],
        ["a_D"],
    ]
    for group in groups:
        picture, scale = graph_picture(diagrams, group, 5.0, get_language("ru"))
        drawn = [
            item.points
            for item in picture.items
            if isinstance(item, Stroke) and item.tag.startswith(CURVE)
        ]
        at = diagrams.cycle.at(diagrams.fine)
        rows = [values_over(diagrams.cycle, one, at) / scale.per_mm for one in group]
        rows = [row for row in rows if np.abs(row).max() > 1e-9]
        assert len(drawn) == len(rows)  # y_E is zero: the axis itself
        for points, row in zip(drawn, rows, strict=True):
            assert [p.imag for p in points] == pytest.approx(row, abs=1e-9)
            assert points[-1].real == pytest.approx(diagrams.length)
            assert 10.0 < np.ptp([0.0, *row]) <= 55.0 + 1e-9


def test_a_point_past_another_has_a_graph_of_its_size() -> None:
    solution = Solution(problem_of("linkages/ex3"), positions=[20.0, 140.0, 260.0])
    turn, (d, e) = diagrams_of(solution).cycle, (solution.points[name] for name in "DE")
    speed, gain = ([one.label for one in group] for group in graph_groups(turn, ["v_D_E", "a_D_E"]))
    assert (speed, gain) == (["v_D_E"], ["a_D_E"])
    past = {"v_D_E": d.velocity - e.velocity, "a_D_E": d.acceleration - e.acceleration}
    for one in quantities_over(turn, past):
        found = values_over(turn, one, solution.positions)
        assert found == pytest.approx(np.abs(past[one.label]), rel=1e-9)
        assert one.symbol == f"{one.label[0]}_{{DE}}"


@each("name", ["linkages/ex3", "levers/six-link", "levers/task-22"])
def test_a_sheet_of_graphs_is_drawn_and_clean(name: str) -> None:
    (drawing,) = drawn_sheets(name, layout="graphs")
    assert not lint(drawing.items)


def test_the_file_or_the_caller_selects_graphs() -> None:
    problem = problem_of("linkages/ex3")
    asked = replace(problem, cycle=CycleTask("E", graphs=("omega_3",)))
    curves = {
        "output": (problem, ()),
        "file": (asked, ()),
        "caller": (asked, ("u_31", "phi_3")),
    }
    counts = {}
    for name, (one, labels) in curves.items():
        (drawing,) = kinematics_sheets(one, layout="graphs", asked=labels)
        strokes = [i for i in drawing.items if isinstance(i, Stroke) and i.tag.startswith(CURVE)]
        counts[name] = len(strokes)
    assert counts == {"output": 3, "file": 1, "caller": 2}


def test_homework_has_the_formulas_of_transfer_functions() -> None:
    (drawing,) = drawn_sheets("levers/six-link", layout="homework")
    text = said(drawing.items)
    assert "Передаточные функции скоростей" in text
    assert "0,1·72 60 = 0,12" in " ".join(text.split())  # a line between 72 and 60


def test_graphs_grow_into_the_paper() -> None:
    (drawing,) = drawn_sheets("linkages/ex3", layout="graphs")
    (box,) = (view.box for view in drawing.views)
    assert (drawing.width, drawing.height) == (297.0, 420.0)
    assert box[3] - box[1] > 250.0  # of 350 mm above the title block; 180 at the least heights


def test_one_graph_takes_the_smallest_paper() -> None:
    (drawing,) = drawn_sheets("levers/task-33", layout="graphs", asked=("omega_3",))
    assert (drawing.width, drawing.height) == (210.0, 297.0)
