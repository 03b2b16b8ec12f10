"""Letters of guides on moving links, rods that are one piece with a slider on the page."""

from __future__ import annotations

import pytest
from doors import (
    LINES,
    NAMING,
    Fill,
    Ink,
    ModelLabel as Label,
    ModelProblem as Problem,
    Solution,
    Text,
    cis,
    far_candidates,
    kinematics_sheets,
    parts_of,
    problem_loads as loads,
    scheme_picture,
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
