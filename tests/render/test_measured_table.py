"""The table of values measured on the plans of several positions, beside exact values."""

from __future__ import annotations

import pytest
from doors import (
    MOTION_KINDS,
    Alternatives,
    Block,
    BlockOptions,
    BlockSpec,
    BlockStyle,
    Drawing,
    Sizes,
    Solution,
    Text,
    Texts,
    get_language,
    kinematics_sheets,
    maker_of,
    paper_paper_format as paper_format,
    read_names,
    reported_quantities,
)
from worked import drawn_sheets, problem_of

from benchmarks.generator import random_problem
from benchmarks.sheets import positions_of
from planmethod import loads

THREE = [20.0, 140.0, 260.0]


def table_of(sheet: Drawing) -> list[str]:
    """Return the texts of the table and around it, to the right of its left edge."""
    texts = [item for item in sheet.items if isinstance(item, Text)]
    (title,) = (one for one in texts if one.text.startswith("Измеренные на планах"))
    low = min(one.at.imag for one in texts if one.text.startswith("Известно до построения"))
    return [
        one.text
        for one in texts
        if one.at.real >= title.at.real - 1.0 and low - 1.0 <= one.at.imag <= title.at.imag + 1.0
    ]


def test_laid_off_values_are_under_the_table_and_not_in_it() -> None:
    (sheet,) = drawn_sheets("linkages/ex3", THREE)
    table = table_of(sheet)
    known = "".join(table[next(k for k, t in enumerate(table) if t.startswith("Известно")) :])
    assert known.startswith("Известно до построения планов: v") and "3,200" in known
    assert sum(text == "3,200" for text in table) == 0  # the pin of the crank has no column


def test_equal_rotations_share_one_column() -> None:
    (sheet,) = drawn_sheets("linkages/ex3", THREE)
    heads = table_of(sheet)
    for letter in "ωε":  # of links 2 and 3 together, measured of them, of link 4, measured of it
        assert sum(text.count(letter) for text in heads) == 2 + 1 + 1 + 1
        assert sum(f"= {letter}" in text for text in heads) == 1


def test_a_value_by_proportion_depends_on_a_reading_but_is_not_one() -> None:
    solution = Solution(problem_of("linkages/ex3"), positions=THREE)
    read = read_names(solution)
    quantities = {one.label: one for one in reported_quantities(solution, *MOTION_KINDS)}
    assert quantities["v_B"].size not in read and quantities["a_B"].size not in read
    assert {quantities[label].size for label in ("v_B3", "v_D", "v_E", "omega_3")} <= read
    (sheet,) = drawn_sheets("linkages/ex3", THREE)
    primed = sum(text == "Δ" for text in table_of(sheet))
    # v_B3, v_E, ω₂ = ω₃, ω₄; a_B3, a_E, ε₂ = ε₃, ε₄; of two points v_B3B, v_ED: not v_D, a_D,
    # which are laid off by proportion
    assert primed == 10


@pytest.mark.parametrize(("name", "count"), [("levers/task-11", 12), ("linkages/ex3", 3)])
def test_the_table_leaves_the_sheet_one(name: str, count: int) -> None:
    problem = problem_of(name)
    first = problem.drive.positions[0]
    sheets = kinematics_sheets(problem, positions=[first + 360 * k / count for k in range(count)])
    assert len(sheets) == 1


def test_measured_values_have_no_zeros_of_a_finer_ruler() -> None:
    """At 0.002 (m/s)/mm half a millimetre is 0.001 m/s."""
    problem = loads(random_problem(91303)[0], name="random")
    (sheet,) = kinematics_sheets(problem, positions=[26.8464 + 30.0 * k for k in range(12)])
    texts = table_of(sheet)
    assert {"0,057", "0,062"} <= {*texts} and not {"0,05700", "0,06200"} & {*texts}


def test_values_laid_off_exactly_have_no_trailing_zeros() -> None:
    (sheet,) = drawn_sheets("linkages/ex3")
    texts = [item.text for item in sheet.items if isinstance(item, Text)]
    assert "3,200" in texts  # an exact value has four digits
    assert "3,2" in texts


def table_ways(solution: Solution, width: float) -> list[Block]:
    """Return the layouts of the table of a dozen positions on A1."""
    entry = BlockSpec("measured-results", width=width, heights=(3.5, 2.5))
    style = BlockStyle(entry, Sizes(5.0, 7.0, 5.0, 178.0), 816.0, BlockOptions(get_language("ru")))
    made = maker_of("measured-results")(solution, tuple(range(12)), style)
    assert isinstance(made, Alternatives)
    return list(made.blocks)


@pytest.mark.parametrize("name", ["linkages/ex3", "linkages/2.1.134"])
def test_a_table_of_many_positions_has_parts_of_full_height_beside_white(name: str) -> None:
    """From one wide part to several that are nearly as narrow as the title block."""
    solution = Solution(problem_of(name), positions=positions_of(problem_of(name), 12))
    widths = [way.width for way in table_ways(solution, 0.58)]
    assert len(widths) > 2 and min(widths) < 240.0
    narrow = table_ways(solution, 0.95 * max(widths))  # a little too narrow for one part
    for way in (*table_ways(solution, 0.58), *narrow):
        heights = [item.height for item in way.place(0j) if isinstance(item, Text)]
        assert max(heights) == 3.5
        assert sum(height == 3.5 for height in heights) > 0.5 * len(heights)


@pytest.mark.parametrize("name", ["linkages/ex3", "levers/task12"])
def test_the_scales_leave_space_for_the_parts_of_a_table(name: str) -> None:
    """Its letters are estimated between 3.5 and 2.5 mm, and so are the rows."""
    solution = Solution(problem_of(name), positions=positions_of(problem_of(name), 12))
    *_, estimated = Texts.of(solution.construction).blocks(paper_format("A1"), 12)
    assert isinstance(estimated, frozenset)
    for way in table_ways(solution, 0.58):
        nearest = min((high for _, high in estimated), key=lambda high: abs(high - way.height))
        assert nearest == pytest.approx(way.height, rel=0.2)
