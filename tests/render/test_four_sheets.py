"""The layout of four sheets: structure, velocities, accelerations and forces, as one set."""

from __future__ import annotations

import re

import pytest
from doors import (
    FRAME_FORMATS as FORMATS,
    STAMP,
    Drawing,
    PlanRequest,
    Scales,
    Text,
    get_language,
    kinematics_sheets,
    lint,
    read_composition,
    sheet_warnings,
)
from msgspec.structs import replace
from worked import drawn_sheets, problem_of

RU = get_language("ru").layouts
TITLES = ("four_structure", "four_velocities", "four_accelerations", "forces_title")
NAMES = [RU[key] for key in TITLES]
ASKED = PlanRequest(layout="four-sheets")
KINDS = [
    {"structure"},
    {"position", "velocity", "senses"},
    {"position", "acceleration", "senses"},
]


def remarks(sheet: Drawing) -> list[str]:
    (fmt,) = (f for f in FORMATS.values() if (f.width, f.height) == (sheet.width, sheet.height))
    return [f"{finding.code} {finding.message}" for finding in lint(sheet.items, fmt.inner)]


def texts(sheet: Drawing, *, stamp: bool = False) -> list[str]:
    return [i.text for i in sheet.items if isinstance(i, Text) and (STAMP in i.tag) == stamp]


@pytest.mark.parametrize("positions", [None, (150.0, 170.0, 190.0)])
def test_the_six_link_has_four_sheets_of_one_set(positions: tuple[float, ...] | None) -> None:
    sheets = drawn_sheets("levers/six-link", positions, layout="four-sheets")
    assert [sheet.title for sheet in sheets] == NAMES
    assert all(remarks(sheet) == [] for sheet in sheets)
    assert [{view.kind for view in sheet.views} for sheet in sheets[:3]] == KINDS
    assert {"forces", "position", "velocity"} == {view.kind for view in sheets[3].views}
    numbers = [{one for one in texts(sheet, stamp=True) if one.isdigit()} for sheet in sheets]
    assert numbers == [{"1", "4"}, {"2"}, {"3"}, {"4"}]  # only the first one has the total
    scales = {
        view.kind: {v.per_mm for s in sheets for v in s.views if v.kind == view.kind}
        for sheet in sheets
        for view in sheet.views
        if view.kind in ("position", "velocity", "acceleration")
    }
    assert len(scales) == 3
    assert all(len(every) == 1 for every in scales.values())


def test_the_first_sheet_has_the_groups_and_the_formulas() -> None:
    told = re.sub(
        r"\s+", " ", " ".join(texts(drawn_sheets("levers/six-link", layout="four-sheets")[0]))
    )
    for text in (
        "Группы самоустанавливающегося механизма",
        "W пр = 6·2 − 5·1 − 4·1 − 3·1 = 0",
        "q = 0 + 0 − 0 = 0",
        "Кинематические пары",
        "Структурная формула: I(6,1) → II(2,3) → II(4,5)",
    ):
        assert text in told


def test_a_file_without_forces_has_three_sheets_and_a_warning() -> None:
    problem = problem_of("linkages/ex3")
    assert [sheet.title for sheet in drawn_sheets("linkages/ex3", layout="four-sheets")] == NAMES[
        :3
    ]
    (warning,) = map(str, sheet_warnings(problem, ASKED))
    assert "so the sheets of forces are omitted: 4." in warning
    assert not list(sheet_warnings(problem_of("levers/six-link"), ASKED))


def test_a_required_paper_is_that_of_every_sheet() -> None:
    sheets = drawn_sheets("levers/six-link", layout="four-sheets")
    assert len({sheet.width for sheet in sheets}) == 3  # A3, A2, A1
    problem = problem_of("levers/six-link")
    wide = replace(problem, sheet=replace(problem.sheet, paper="A1"))
    assert {s.width for s in kinematics_sheets(wide, layout="four-sheets")} == {841}


OWN = """
formats = ["A3"]
grow = true
[sheets.2]
formats = ["A2", "A1"]
[[blocks]]
kind = "scheme"
[[blocks]]
kind = "plan"
of = "velocity"
sheet = 2
"""


def test_a_sheet_has_its_own_formats_and_the_others_the_common_one() -> None:
    problem = replace(problem_of("linkages/ex3"), scales=Scales())
    one, two = kinematics_sheets(problem, layout=read_composition(OWN, name="own.toml"))
    assert (one.width, two.width) == (420, 594)
