"""Letters of guides on moving links, rods that are one piece with a slider on the page."""

from __future__ import annotations

import re

import pytest
from doors import (
    LINES,
    NAMING,
    SLIDER,
    Fill,
    Ink,
    ModelLabel as Label,
    ModelProblem as Problem,
    Pen,
    Scheme,
    Solution,
    Stroke,
    Text,
    cis,
    far_candidates,
    get_language,
    kinematics_sheets,
    off_segment,
    parts_of,
    problem_loads as loads,
    scheme_picture,
    series_picture,
    statement_given_facts as given_facts,
    typeset,
)
from worked import problem_of

from benchmarks.generator import random_problem


def slotted() -> Problem:
    """Return a mechanism whose equations name guides n₂–n₂, n₅–n₅, n₆–n₆."""
    return loads(random_problem(9001)[0], name="slotted")


def test_guides_that_the_equations_name_are_lettered_on_the_scheme() -> None:
    picture = scheme_picture(Solution(slotted()), 0)
    runs = [item.text for item in picture.place(0j) if isinstance(item, Text)]
    assert runs.count("n") >= 3


@pytest.mark.parametrize("seed", [9001, 97_001, 97_003])
def test_every_guide_that_the_statement_names_is_lettered_on_the_scheme(seed: int) -> None:
    """Also one at an angle to the axis of its link; the equations name it, too."""
    solution = Solution(loads(random_problem(seed)[0], name="random"))
    facts = " ".join(fact.text for fact in given_facts(solution.problem, get_language("ru")))
    named = set(re.findall(r"n_\{\d+\}–n_\{\d+\}", facts))
    scheme = Scheme(solution, 0, 5.0)
    scheme.draw()
    assert named and {name for name, _, _ in scheme.slot_ends} == named
    assert "повёрнутой" not in facts and "направляющей звена" not in facts


def rod_in_block() -> Problem:
    """Return a mechanism whose link 3 passes through the block 2, with points beside its rod."""
    return loads(random_problem(97_002)[0], name="rod")


@pytest.mark.parametrize("shift", range(0, 360, 60))
def test_the_rod_of_a_link_with_points_beside_it_passes_through_its_block(shift: int) -> None:
    problem = rod_in_block()
    solution = Solution(problem, positions=[problem.drive.positions[0] + shift])
    scheme = Scheme(solution, 0, 5.0)
    scheme.draw()
    (block,) = scheme.blocks
    inside = (block.middle - block.direction, block.middle + block.direction)
    assert all(
        min(off_segment(place, *part) for part in scheme.segments["3"]) < 1e-6 for place in inside
    )
    ((_, *ends),) = scheme.slot_ends  # n₃ stands beyond the block
    reach = [((end - block.middle) / (ends[1] - ends[0])).real for end in ends]
    assert reach[0] < 0 < reach[1]


def test_the_rods_of_other_positions_end_at_stones() -> None:
    problem = rod_in_block()
    first = problem.drive.positions[0]
    solution = Solution(problem, positions=[first, first + 120.0, first + 240.0])
    picture = series_picture(solution, 0, (0, 1, 2)).place(0j)
    strokes = [item for item in picture if isinstance(item, Stroke) and item.pen is Pen.PALE]
    stones = [item for item in strokes if item.tag == SLIDER]
    rods = [item for item in strokes if item.tag == "link 3"]
    assert len(stones) == 2
    for stone in stones:
        middle = sum(stone.points) / len(stone.points)
        assert min(off_segment(middle, *rod.points) for rod in rods) < 1e-6


@pytest.mark.parametrize("shift", [-4.0, 4.0])
def test_positions_around_that_of_the_file_are_written_in_its_range(shift: float) -> None:
    problem = slotted()
    first = problem.drive.positions[0] - 360.0
    sheet, *_ = kinematics_sheets(problem, positions=[first, first + shift])
    shown = "".join(item.text for item in sheet.items if isinstance(item, Text))
    assert f"−{abs(first + shift):.2f}".replace(".", ",") in shown
    assert f"{first + shift + 360.0:.2f}".replace(".", ",") not in shown


def test_a_leader_of_a_name_is_never_level() -> None:
    for degrees in range(0, 90, 2):
        way = cis(float(degrees))
        places = far_candidates(Label(typeset("a_{B}", 2.5), 0j, prefer=way, style=NAMING))
        rises = abs((places.ends - places.starts).imag[places.led])
        assert len(rises)
        assert rises.min() > 0.5


def test_a_rod_ends_at_the_edge_of_its_slider_on_the_page() -> None:
    parts, _ = parts_of(Solution(problem_of("levers/task-66")), 5.0)
    rods = [part for part in parts if part.link == "3" and part.layer == LINES]
    wedges = [item for part in rods for item in part.items if isinstance(item, Fill)]
    assert any(item.ink is Ink.BLACK for item in wedges)
