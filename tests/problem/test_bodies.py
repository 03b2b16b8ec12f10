"""Points of links in the links' own axes, for every way of giving a point."""

from __future__ import annotations

import cmath
import math

import pytest
from doors import (
    ProblemError,
    ProblemProblem as Problem,
    placement_heading as heading,
    problem_loads as loads,
    rotation,
)
from hypothesis import given, strategies as st

CRANK = '[links.1]\npoints = ["A", "B"]\nAB = 0.1\n'
REST = """
[links.3]
points = ["K", "C"]
KC = 0.2
[frame]
A = [0, 0]
K = [0.3, 0]
[driver]
link = "1"
phi = 60
omega = 10
"""


def solve(link: str) -> Problem:
    """A four-bar whose coupler is the link in question: it is joined at B and C."""
    return loads(f"{CRANK}[links.2]\n{link}\n{REST}", name="body")


def points(link: str) -> dict[str, complex]:
    return dict(solve(link).bodies["2"].points)


def test_the_first_length_is_the_own_axis() -> None:
    body = solve('points = ["B", "C"]\nCB = 0.25').bodies["2"]
    assert body.axis == ("C", "B")
    assert body.points == {"B": 0.25, "C": 0}
    assert list(body.points) == ["B", "C"]


@pytest.mark.parametrize(("side", "sign"), [("left", 1), ("right", -1)])
def test_two_distances_and_a_side(side: str, sign: int) -> None:
    link = f'points = ["B", "C", "D"]\nBC = 0.5\nBD = 0.3\nCD = 0.4\nD.side = "{side} of BC"'
    assert points(link)["D"] == pytest.approx(complex(0.18, sign * 0.24), abs=1e-15)


def test_the_side_may_be_given_from_the_other_end() -> None:
    link = 'points = ["B", "C", "D"]\nBC = 0.5\nBD = 0.3\nCD = 0.4\nD.side = "left of CB"'
    assert points(link)["D"] == pytest.approx(0.18 - 0.24j, abs=1e-15)


def test_two_distances_on_the_line_need_no_side_and_are_snapped() -> None:
    link = 'points = ["B", "C", "D", "E", "F"]\nBC = 0.3\n'
    link += "BD = 0.1\nCD = 0.2\nBE = 0.03\nCE = 0.33\nBF = 0.4\nCF = 0.1"
    got = points(link)
    assert got["D"] == 0.1
    assert got["E"] == -0.03
    assert got["F"] == 0.4


def test_nearly_collinear_is_collinear_only_within_the_slack() -> None:
    link = 'points = ["B", "C", "D"]\nBC = 0.3\nBD = 0.1\nCD = {}'
    assert points(link.format(0.2 + 1e-12))["D"] == 0.1
    with pytest.raises(ProblemError, match="two places satisfy"):
        points(link.format(0.2001))


@pytest.mark.parametrize(
    ("form", "place"),
    [
        ('{ on = "BC", at = -0.03 }', -0.03),
        ('{ on = "CB", at = 0.1 }', 0.2),
        ('{ on = "BC", at = 0.4, across = 0.05 }', 0.4 + 0.05j),
        ('{ on = "CB", at = 0.1, across = 0.05 }', 0.2 - 0.05j),
        ('{ from = "B", at = 0.2 }', 0.2),
        ('{ from = "C", at = -0.1, across = -0.02 }', 0.2 - 0.02j),
        ('{ vertex = "B", ray = "BC", angle = 90, distance = 0.1 }', 0.1j),
        ('{ vertex = "C", ray = "CB", angle = 90, distance = 0.1 }', 0.3 - 0.1j),
        ('{ vertex = "B", ray = "BC", angle = -180, distance = 0.1 }', -0.1),
    ],
)
def test_exact_forms(form: str, place: complex) -> None:
    got = points(f'points = ["B", "C", "D"]\nBC = 0.3\nD = {form}')["D"]
    assert got == pytest.approx(place, abs=1e-16)


def test_an_angle_at_a_vertex_with_the_distance_as_a_length() -> None:
    link = (
        'points = ["B", "C", "D"]\nBC = 0.3\nBD = 0.1\nD = { vertex = "B", ray = "BC", angle = 30 }'
    )
    assert points(link)["D"] == pytest.approx(cmath.rect(0.1, math.radians(30)), abs=1e-16)


def test_the_first_length_stays_the_axis_when_it_leads_to_a_third_point() -> None:
    link = 'points = ["B", "C", "D"]\nBD = 0.3\nCD = 0.4\nBC = 0.5\nD.side = "left of BC"'
    body = solve(link).bodies["2"]
    assert body.axis == ("B", "D")
    assert body.points["D"] == 0.3
    # D to the left of BC means C to the right of BD; the angle at D is right
    assert body.points["C"] == pytest.approx(0.3 - 0.4j, abs=1e-15)


def test_points_may_be_given_in_any_order() -> None:
    link = 'points = ["E", "D", "C", "B"]\nE = { on = "BD", at = 0.05 }\n'
    link += 'D = { on = "BC", at = 0.1, across = 0.1 }\nBC = 0.3'
    got = points(link)
    assert got["E"] == pytest.approx(cmath.rect(0.05, math.pi / 4), abs=1e-16)


def test_an_agreeing_spare_length_is_accepted() -> None:
    link = 'points = ["B", "C", "D"]\nBC = 0.5\nBD = 0.3\nCD = 0.4\n'
    link += 'D = { on = "BC", at = 0.18, across = 0.24 }'
    assert points(link)["D"] == 0.18 + 0.24j


def test_lengths_are_kept_in_file_order_for_the_statement() -> None:
    problem = solve('points = ["B", "C"]\nCB = 0.25')
    assert problem.lengths == (("1", "AB", 0.1), ("2", "CB", 0.25), ("3", "KC", 0.2))


def test_points_defined_in_a_circle_are_rejected() -> None:
    link = 'points = ["B", "C", "D", "E"]\nBC = 0.3\n'
    link += 'D = { on = "BE", at = 0.1 }\nE = { on = "CD", at = 0.1 }'
    with pytest.raises(ProblemError, match="measured from points that are not placed"):
        points(link)


SLIDER = """
[frame]
A = [0, 0]
guides.x-x = {{ through = "A", angle = 30 }}
{crank}
[links.2]
points = ["B", "C"]
BC = 0.4
[links.3]
{slider}
slides = {{ on = "x-x" }}
[driver]
link = "1"
phi = 60
omega = 10
"""


def slider(text: str) -> dict[str, complex]:
    return dict(loads(SLIDER.format(crank=CRANK, slider=text), name="s").bodies["3"].points)


def test_a_length_of_a_slider_lays_its_point_along_the_slide() -> None:
    assert slider('points = ["C", "D"]\nCD = 0.3') == {"C": 0, "D": 0.3}
    assert slider('points = ["C", "D"]\nDC = 0.3') == {"C": 0, "D": 0.3}
    got = slider('points = ["C", "D", "E"]\nDE = 0.1\nCD = 0.3')
    assert got == pytest.approx({"C": 0, "D": 0.3, "E": 0.4})


def test_a_triangle_on_a_slider() -> None:
    got = slider('points = ["C", "D", "E"]\nCD = 0.5\nCE = 0.3\nDE = 0.4\nE.side = "right of CD"')
    assert got["E"] == pytest.approx(0.18 - 0.24j, abs=1e-15)


def test_points_of_a_slider_from_its_pin() -> None:
    got = slider('points = ["C", "S"]\nS = { from = "C", at = -0.2, across = 0.1 }')
    assert got == {"C": 0, "S": -0.2 + 0.1j}


@given(st.floats(-1000, 1000))
def test_rotation_is_a_unit_vector_of_its_angle(angle: float) -> None:
    assert abs(rotation(angle)) == pytest.approx(1, abs=1e-15)
    assert rotation(angle) == pytest.approx(cmath.rect(1, math.radians(angle)), abs=1e-12)


@pytest.mark.parametrize(("angle", "unit"), [(0, 1), (90, 1j), (180, -1), (-90, -1j), (450, 1j)])
def test_rotation_is_exact_on_the_axes(angle: float, unit: complex) -> None:
    assert rotation(angle) == unit
    assert heading(unit) == (angle + 179) % 360 - 179


@given(
    st.floats(0.05, 1),
    st.floats(-1, 1),
    st.floats(0.01, 1),
    st.booleans(),
)
def test_a_triangle_measured_is_the_triangle_placed(
    base: float, x: float, y: float, left: bool
) -> None:
    place = complex(x, y if left else -y)
    link = f'points = ["B", "C", "D"]\nBC = {base!r}\nBD = {abs(place)!r}\n'
    link += f'CD = {abs(place - base)!r}\nD.side = "{"left" if left else "right"} of BC"'
    assert points(link)["D"] == pytest.approx(place, abs=1e-9)
