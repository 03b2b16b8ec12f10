"""Arms at an angle are laid off by the protractor: the given angle and the given length."""

from __future__ import annotations

import cmath
import json
import math
from pathlib import Path

import pytest
from click.testing import CliRunner
from doors import (
    AtAngle,
    IntersectCircles,
    LayOffLength,
    PlanKind,
    PointName,
    cli,
    draft,
)

from planmethod import Solution, load

LEVER = """
frame = {{ O = [0, 0], C = [0.3, 0.12] }}
driver = {{ link = "1", phi = 106.5, n = 90 }}
assembly = {{ {inner} = "right of AC" }}
[links.1]
points = ["O", "A"]
OA = 0.08
[links.2]
points = ["A", "{inner}"]
A{inner} = 0.3
[links.3]
points = {points}
{sizes}
"""
TOLD = {  # points of the link, its sizes, and by point laid off: its origin and angle
    "three letters": (["C", "B", "D"], "CB = 0.22\nCD = 0.18\nangle.BCD = 100", {"D": ("C", 100)}),
    "the other side of the angle": (
        ["C", "D", "B"], "CB = 0.22\nCD = 0.18\nangle.DCB = -100", {"D": ("C", 100)},
    ),
    "clockwise": (["C", "B", "D"], "CB = 0.22\nCD = 0.18\nangle.BCD = 260", {"D": ("C", -100)}),
    "vertex": (
        ["C", "B", "D"],
        "CB = 0.22\nD = { vertex = \"C\", ray = \"CB\", angle = 100, distance = 0.18 }",
        {"D": ("C", 100)},
    ),
    "four letters": (
        ["C", "B", "D"], "CB = 0.22\nBD = 0.1\nangle.CBBD = -40", {"D": ("B", -40)},
    ),
    "one arm after another": (
        ["C", "E", "D", "B"],
        "CB = 0.22\nCD = 0.18\nDE = 0.05\nangle.CDE = 70\nangle.BCD = 100",
        {"D": ("C", 100), "E": ("D", 70)},
    ),
    "set squares": (["C", "B", "D"], "CB = 0.22\nCD = 0.18\nangle.BCD = 90", {}),
    "straight": (["C", "B", "D"], "CB = 0.22\nCD = 0.18\nangle.BCD = 180", {}),
}  # fmt: skip


@pytest.mark.parametrize("told", TOLD)
def test_an_arm_is_laid_off_by_its_angle_and_length(
    told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Exact places are those of its coordinates in the axes of the link."""
    points, sizes, arms = TOLD[told]
    path = tmp_path / "lever.toml"
    shown = str(points).replace("'", '"')
    path.write_text(LEVER.format(inner="B", points=shown, sizes=sizes), encoding="utf-8")
    solution = Solution(load(path))
    made = {step.out: step for step in solution.construction.program.steps}
    found = {}
    for step in made.values():
        if (
            isinstance(step, LayOffLength)
            and isinstance(line := made[step.line], AtAngle)
            and line.to
        ):
            found[step.out] = step.origin, round(solution.construction.draft.numbers[line.angle], 9)
    assert found == arms
    body = solution.problem.bodies["3"].points
    c, b = (complex(solution.si.point(PointName(p))[0]) for p in "CB")
    turn = cmath.exp(1j * (cmath.phase(b - c) - cmath.phase(body["B"] - body["C"])))
    for point in points:
        place = complex(solution.si.point(PointName(point))[0])
        assert abs(place - c - (body[point] - body["C"]) * turn) < 1e-14, point
    monkeypatch.setattr(draft, "_arms", lambda _: [])
    before = Solution(load(path))
    for point in points:
        one, other = (complex(s.si.point(PointName(point))[0]) for s in (solution, before))
        assert abs(one - other) <= 1e-12 * math.hypot(0.3, 0.12)


def test_the_protocol_describes_an_arm_by_the_given_data(tmp_path: Path) -> None:
    """100 degrees and 45 mm, not 7.8142 mm along and 44.316 mm across."""
    points, sizes, _ = TOLD["three letters"]
    path = tmp_path / "lever.toml"
    shown = str(points).replace("'", '"')
    path.write_text(LEVER.format(inner="B", points=shown, sizes=sizes), encoding="utf-8")
    run = CliRunner().invoke(cli, ["protocol", str(path), "--lang", "en"])
    said = " ".join(run.output.split())
    assert "From point C we lay off the segment CD = l_CD/μ_l = 0.18/0.004 = 45 mm at 100°" in said
    assert "(to the left as one looks along CB) and get point D" in said


SIDES = 'CB = 0.22\nBD = 0.15\nCD = 0.18\nD.side = "{} of CB"'


@pytest.mark.parametrize("points", (["C", "B", "D"], ["D", "C", "B"], ["B", "D", "C"]))
@pytest.mark.parametrize("way", ("left", "right"))
@pytest.mark.parametrize("inner", ("B", "D"))
def test_three_sides_are_two_arcs(points: list[str], way: str, inner: str, tmp_path: Path) -> None:
    """The corner that is not a pin of the group is struck from both others with their sides."""
    path = tmp_path / "lever.toml"
    text = LEVER.format(points=json.dumps(points), sizes=SIDES.format(way), inner=inner)
    path.write_text(text, "utf-8")
    solution = Solution(load(path))
    corner = "D" if inner == "B" else "B"
    arcs = [s for s in solution.construction.program.steps if isinstance(s, IntersectCircles)]
    (step,) = (arc for arc in arcs if arc.out == corner)
    sizes = {"C": {"B": 0.22, "D": 0.18}, inner: {"B": 0.15, "D": 0.15}}
    told = [(step.centre1, step.radius1), (step.centre2, step.radius2)]
    mu = solution.scales[PlanKind.POSITION].per_mm
    for centre, radius in told:
        assert solution.paper.number(radius)[0] * mu == pytest.approx(sizes[centre][step.out])
    place = {name: point.place[0] for name, point in solution.points.items()}
    side = ((place["D"] - place["C"]) / (place["B"] - place["C"])).imag
    assert abs(place["D"] - place["B"]) == pytest.approx(0.15)
    assert (side > 0) == (way == "left")
