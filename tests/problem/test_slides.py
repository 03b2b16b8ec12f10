"""Prismatic pairs: lines of hosts, translating hosts, joints that follow."""

from __future__ import annotations

import pytest
from doors import Prismatic, ProblemProblem as Problem, Revolute, Slide, problem_loads as loads
from msgspec.structs import replace

YOKE = """
[frame]
O = [0, 0]
K = [0, 0.3]
guides.g = { through = [0.1, 0.2], angle = 30 }
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A"]
slides = { on = "3", SLIDES }
[links.3]
points = ["B", "D"]
BD = 0.2
slides = { on = "g", offset = -0.01 }
[driver]
link = "1"
phi = 60
omega = 10
"""


def yoke(slides: str) -> Slide:
    return loads(YOKE.replace("SLIDES", slides), name="yoke").slides["2"]


@pytest.mark.parametrize(
    ("angle", "own"), [(30, 0), (120, 90), (0, -30), (90, 60), (-150, 180), (210, 180), (390, 0)]
)
def test_on_a_translating_host_the_angle_is_from_the_x_axis(angle: float, own: float) -> None:
    slide = yoke(f'through = "B", angle = {angle}')
    assert slide.angle == pytest.approx(own, abs=1e-12)
    assert (slide.host, slide.pin, slide.base, slide.through) == ("3", "A", 0j, "B")
    assert (slide.label, slide.towards) == ("B", None)


def test_along_is_geometry_of_the_host_in_any_motion() -> None:
    slide = yoke('along = "DB", offset = 0.05')
    assert (slide.angle, slide.base, slide.offset) == (180, 0.2, 0.05)
    assert (slide.label, slide.through, slide.towards) == ("DB", "D", "B")


def test_a_slider_may_have_a_length_of_contact() -> None:
    assert yoke('along = "DB"').length is None
    slide = yoke('along = "DB", length = 0.06')
    assert slide.length == 0.06
    assert slide == replace(yoke('along = "DB"'), length=0.06)


def test_a_slider_on_a_slider_translates_too() -> None:
    text = YOKE.replace("SLIDES", 'through = "M", angle = 90').replace('on = "3"', 'on = "4"')
    text += """
[links.4]
points = ["M"]
slides = { on = "3", through = "B", angle = 100 }
"""
    slides = loads(text, name="stack").slides
    assert slides["4"].angle == pytest.approx(70)
    assert slides["2"].angle == pytest.approx(-10)


def test_a_guide_gives_its_own_line() -> None:
    problem = loads(YOKE.replace("SLIDES", 'through = "B", angle = 0'), name="yoke")
    assert problem.slides["3"] == Slide("3", "0", "B", 0.1 + 0.2j, 30, -0.01, "g")
    assert problem.guides == {"g": (None, 0.1 + 0.2j, 30)}
    assert problem.bodies["0"].points == {"O": 0, "K": 0.3j}
    assert problem.mechanism.prismatics == (Prismatic("2", "3", "A"), Prismatic("3", "0", "B"))
    assert problem.mechanism.revolutes == (Revolute("O", ("0", "1")), Revolute("A", ("1", "2")))


def test_the_frame_itself_may_carry_a_line() -> None:
    text = YOKE.replace("SLIDES", 'through = "B", angle = 0')
    along = text.replace('on = "g"', 'on = "0", along = "OK"')
    assert loads(along, name="f").slides["3"] == Slide("3", "0", "B", 0j, 90, -0.01, "OK", "O", "K")
    angled = text.replace('on = "g"', 'on = "0", through = "K", angle = 15')
    assert loads(angled, name="f").slides["3"] == Slide("3", "0", "B", 0.3j, 15, -0.01, "K", "K")


ROCKER = """
[frame]
O = [0, 0]
C = [0.4, 0]
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A", "D"]
AD = 0.6
slides = { on = "3", through = "C" }
[links.3]
points = POINTS
[driver]
link = "1"
phi = 60
omega = 10
"""


def rocker(points: str = '["C"]') -> Problem:
    return loads(ROCKER.replace("POINTS", points), name="rocker")


def test_a_swinging_block_has_the_line_it_carries_as_its_own_axis() -> None:
    problem = rocker()
    assert problem.slides["2"] == Slide("2", "3", "A", 0j, 0, 0, "C", "C")
    assert problem.bodies["3"].points == {"C": 0}
    assert problem.bodies["3"].axis is None
    assert problem.bodies["2"].points == {"A": 0, "D": 0.6}
    assert problem.bodies["2"].axis is None


def test_a_swinging_block_may_have_points_along_its_line() -> None:
    body = rocker('["C", "S"]\nS = { from = "C", at = -0.05, across = 0.01 }').bodies["3"]
    assert body.points == {"C": 0, "S": -0.05 + 0.01j}
    assert body.axis is None


def test_a_point_straight_along_the_line_gives_the_axis_letters() -> None:
    text = ROCKER.replace("POINTS", '["C", "S"]\nS = { from = "C", at = -0.05 }')
    text = text.replace('through = "C"', 'through = "C", angle = 0')
    assert loads(text, name="rocker").bodies["3"].axis == ("S", "C")


def test_a_mark_on_a_swinging_block_leaves_the_line_its_own_axis() -> None:
    mark = '["C", "S"]\nS = { from = "C", at = 0.05 }'
    text = ROCKER.replace("POINTS", mark)
    said = text.replace('through = "C"', 'through = "C", angle = 0')
    assert rocker(mark) == loads(said, name="rocker")
    turned = loads(text.replace('through = "C"', 'through = "C", angle = 30'), name="rocker")
    assert turned.slides["2"].angle == 30


def test_a_second_slider_on_a_swinging_block_is_turned_from_the_first() -> None:
    text = (
        ROCKER.replace("POINTS", '["C"]')
        + """
[links.4]
points = ["E"]
slides = { on = "3", through = "C", angle = 90 }
[links.5]
points = ["E", "K"]
KE = 0.5
[frame.guides]
"""
    )
    text = text.replace("C = [0.4, 0]", "C = [0.4, 0]\nK = [0.4, 0.3]").replace(
        "[frame.guides]", ""
    )
    slides = loads(text, name="two").slides
    assert (slides["2"].angle, slides["4"].angle) == (0, 90)


def test_a_point_of_three_links_is_one_joint() -> None:
    text = (
        ROCKER.replace("POINTS", '["C"]')
        + """
[links.4]
points = ["A", "E"]
AE = 0.3
[links.5]
points = ["F", "E"]
FE = 0.3
"""
    )
    problem = loads(text.replace("C = [0.4, 0]", "C = [0.4, 0]\nF = [0.2, 0.3]"), name="three")
    joint = next(j for j in problem.mechanism.revolutes if j.point == "A")
    assert joint == Revolute("A", ("1", "2", "4"))
    assert joint.pairs == 2
    assert problem.mechanism.lower_pairs == 7
