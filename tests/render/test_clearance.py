"""Sheets keep clear of the graphs within the frame."""

from __future__ import annotations

import pytest
from doors import (
    LayoutError,
    SheetSettings,
    analyse,
    inspect,
    kinematics_sheets,
    problem_load as load,
    structure_sheet,
)
from msgspec.structs import replace
from worked import path_of


@pytest.mark.parametrize("name", ["linkages/ex1", "linkages/ex3", "levers/six-link"])
@pytest.mark.parametrize("paper", [None, "A3:portrait", "A2:portrait", "A4x3", "A4"])
def test_sheets_keep_out_of_the_graphs(name: str, paper: str | None) -> None:
    settings = SheetSettings(paper, graphs_27_30=True, side_columns=True)
    problem = replace(load(path_of(name)), sheet=settings)
    if paper == "A4" and name != "linkages/ex1":  # their plans beside the columns are wider than A4
        with pytest.raises(LayoutError, match=r"A4\. Use --paper A3"):
            kinematics_sheets(problem)
        return
    for drawing in kinematics_sheets(problem):
        # Requested paper may be too large for three links at the scales of the file.
        allowed = {"PM-D08"} | ({"PM-D10", "PM-D19", "PM-D20", "PM-D21"} if paper else set())
        assert [f.message for f in inspect(drawing) if f.code not in allowed] == []


@pytest.mark.parametrize("name", ["linkages/ex1", "linkages/ex3", "press/press"])
def test_structural_sheets_keep_out_of_the_graphs(name: str) -> None:
    problem = replace(load(path_of(name)), sheet=SheetSettings(graphs_27_30=True))
    drawing = structure_sheet(problem, analyse(problem.mechanism))
    assert [f.message for f in inspect(drawing) if f.code != "PM-D10"] == []


def test_a_dozen_of_positions_keeps_out_of_the_graphs() -> None:
    problem = load(path_of("linkages/ex2"))
    for drawing in kinematics_sheets(problem, positions=[30.0 * k for k in range(12)]):
        assert not [f for f in inspect(drawing) if f.code == "PM-D13"]
