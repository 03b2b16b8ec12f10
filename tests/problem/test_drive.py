"""Driver, assembly rules and scales."""

from __future__ import annotations

import math

import pytest
from doors import (
    AssemblyRelation,
    Convention,
    Drive,
    ProblemError,
    Rule,
    Scales,
    problem_loads as loads,
    unlikely,
)

CRANK = """
[frame]
O = [0, 0]
C = [0.3, 0]
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A", "B"]
AB = 0.25
[links.3]
points = ["C", "B"]
CB = 0.2
[driver]
link = "1"
"""
SLIDER = """
[frame]
O = [0, 0]
guides.x-x = { through = "O", angle = 0 }
[links.1]
points = ["A"]
slides = { on = "x-x" }
[links.2]
points = ["A", "B"]
AB = 0.22
[links.3]
points = ["O", "B"]
OB = 0.1
[driver]
link = "1"
"""


def crank(text: str) -> Drive:
    return loads(CRANK + text, name="crank").drive


def slider(text: str) -> Drive:
    return loads(SLIDER + text, name="slider").drive


@pytest.mark.parametrize(
    ("phi", "positions"),
    [
        ("20", (20,)),
        ("[0, 30.5, -60]", (0, 30.5, -60)),
        ("{ from = 10, count = 4 }", (10, 100, 190, 280)),
        ("{ from = 0, to = 90, step = 30 }", (0, 30, 60, 90)),
        ("{ from = 0, to = 100, step = 30 }", (0, 30, 60, 90)),
        ("{ from = 30, to = 0, step = -15 }", (30, 15, 0)),
        ("{ from = 0, to = 1, count = 5 }", (0, 0.25, 0.5, 0.75, 1)),
        ("{ from = 7, count = 1 }", (7,)),
        ("{ from = 5, to = 5, step = 1 }", (5,)),
    ],
)
def test_positions(phi: str, positions: tuple[float, ...]) -> None:
    assert crank(f"phi = {phi}\nomega = 1").positions == pytest.approx(positions)


def test_a_step_that_rounding_would_miss_reaches_its_end() -> None:
    positions = crank("phi = { from = 0, to = 0.3, step = 0.1 }\nomega = 1").positions
    assert len(positions) == 4


def test_the_most_positions_allowed() -> None:
    assert len(crank("phi = { from = 0, count = 10000 }\nomega = 1").positions) == 10_000


def test_crank() -> None:
    assert crank("phi = 30\nomega = -5\nepsilon = 7") == Drive("1", "O", (30,), -5, 7)
    assert crank("phi = 30\nomega = 5").is_crank


def test_revolutions_per_minute() -> None:
    assert crank("phi = 30\nn = 130").rate == pytest.approx(130 * math.pi / 30, rel=1e-15)


def test_driving_slider() -> None:
    drive = slider("s = { from = 0.25, to = 0.75, count = 3 }\nv = 0.5\na = -1")
    assert drive == Drive("1", None, (0.25, 0.5, 0.75), 0.5, -1)
    assert not drive.is_crank


def test_a_slider_has_no_full_turn() -> None:
    with pytest.raises(ProblemError, match=r"expected \{ from, to, step \} or"):
        slider("s = { from = 0.2, count = 3 }\nv = 0.5")


@pytest.mark.parametrize(
    ("phrase", "rule"),
    [
        ('"right of A"', Rule("B", AssemblyRelation.RIGHT, ("A",))),
        ('"left of A"', Rule("B", AssemblyRelation.LEFT, ("A",))),
        ('"above A"', Rule("B", AssemblyRelation.ABOVE, ("A",))),
        ('"above of A"', Rule("B", AssemblyRelation.ABOVE, ("A",))),
        ('"below C"', Rule("B", AssemblyRelation.BELOW, ("C",))),
        ('"left of AC"', Rule("B", AssemblyRelation.LEFT_OF, ("A", "C"))),
        ('"right of CA"', Rule("B", AssemblyRelation.RIGHT_OF, ("C", "A"))),
        ('"  right   of  A "', Rule("B", AssemblyRelation.RIGHT, ("A",))),
        ("{ near = [0.1, -0.2] }", Rule("B", AssemblyRelation.NEAR, at=0.1 - 0.2j)),
    ],
)
def test_rules(phrase: str, rule: Rule) -> None:
    text = f"{CRANK}phi = 1\nomega = 1\n[assembly]\nB = {phrase}"
    assert loads(text, name="rule").assembly == (rule,)


def test_scales_as_written() -> None:
    text = f"{CRANK}phi = 1\nomega = 1\n[scales]\nmu_l = 0.002\nmu_a = 5"
    assert loads(text, name="scales").scales == Scales(mu_l=0.002, mu_a=5)


def test_scales_in_millimetres_per_unit_are_stored_inverted() -> None:
    text = f'{CRANK}phi = 1\nomega = 1\n[scales]\nconvention = "mm/unit"\nmu_l = 250\nmu_v = 30'
    scales = loads(text, name="scales").scales
    assert scales.convention is Convention.MM_PER_UNIT
    assert (scales.mu_l, scales.mu_v, scales.mu_a) == (1 / 250, 1 / 30, None)


def test_the_rest_of_a_problem() -> None:
    text = 'title = "Пример"\nsource = "кн. 1"\n' + CRANK + "phi = 1\nomega = 1\n"
    text += '[stamp]\nauthor = "Иванов"\n[gears]\nz1 = 20\n[point]\nx = "t"\n'
    problem = loads(text, name="rest")
    assert (problem.name, problem.title, problem.source) == ("rest", "Пример", "кн. 1")
    assert problem.stamp == {"author": "Иванов"}
    assert problem.tables == {"gears": {"z1": 20}, "point": {"x": "t"}}
    assert problem.dynamics is None
    assert (problem.variants, problem.variant, problem.published) == ((), None, ())


def test_the_rounding_of_a_zero_is_zero() -> None:
    text = f"{CRANK}phi = -6e-32\nomega = 1\n"
    problem = loads(text.replace("0.3, 0]", "0.3, -6.1e-32]", 1), name="rounded")
    assert problem.drive.positions == (0.0,)
    assert all(place.imag == 0.0 for place in problem.bodies["0"].points.values())
    assert not problem.vanished and not list(unlikely(problem))
    problem = loads(f"{CRANK}phi = 1\nomega = 1e-308\n", name="slow")
    assert problem.drive.rate == 0.0
    (told,) = unlikely(problem)
    assert "driver.omega = 1e-308 is read as zero" in str(told)
