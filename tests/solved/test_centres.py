"""Instant centres: by Kennedy's lines they are where both links have one velocity (by Newton)."""

from __future__ import annotations

import json
from itertools import combinations
from math import isnan
from pathlib import Path

import numpy as np
import pytest
from cases import sampled
from click.testing import CliRunner
from doors import (
    FRAME,
    Solution,
    Statics,
    cli,
    find_centres,
    kinds_load as load,
    problem_loads as loads,
)
from newton import solve as newton
from worked import PROBLEMS

from benchmarks.generator import random_problem

FILES = sorted(
    path
    for folder in ("linkages", "levers", "press")
    for path in (PROBLEMS / folder).glob("*.toml")
)


def assert_agrees_with_plan(solution: Solution) -> None:
    for index in range(len(solution.positions)):
        centres = find_centres(solution, index)
        most = max(abs(one.omega[index]) for one in solution.links.values()) or 1.0
        fast = max(abs(one.velocity[index]) for one in solution.points.values()) or 1.0
        for link, motion in solution.links.items():
            assert abs(centres.motions[link].omega - motion.omega[index]) < 1e-9 * most
            for point in solution.problem.bodies[link].points:
                if point in solution.points:
                    there = solution.points[point]
                    found = centres.motions[link].velocity(complex(there.place[index]))
                    assert abs(found - there.velocity[index]) < 1e-9 * fast


@pytest.mark.parametrize("path", sampled(FILES, 6), ids=lambda path: path.stem)
def test_velocities_by_the_centres_are_those_of_the_plan(path: Path) -> None:
    assert_agrees_with_plan(Solution(load(path)))


@pytest.mark.parametrize("seed", sampled(range(40), 10))
def test_at_a_centre_both_links_of_a_random_mechanism_have_one_velocity(seed: int) -> None:
    text, pose = random_problem(seed)
    problem = loads(text, name="random")
    position = problem.drive.positions[0]
    exact, centres = newton(problem, position, pose), find_centres(Solution(problem))
    size = max(abs(place) for place in exact.position.values())
    fast = max(abs(one) for one in exact.velocity.values())

    def velocity(link: str, at: complex) -> complex:
        if link == FRAME:
            return 0j
        point = next(point for of, point in exact.velocity if of == link)
        arm = at - exact.position[link, point]
        return exact.velocity[link, point] + 1j * exact.omega[link] * arm

    turning = {FRAME: 0.0, **exact.omega}
    for (one, other), centre in centres.centres.items():
        relative = turning[other] - turning[one]
        if not isnan(centre.at.real):
            reach = max(1.0, abs(centre.at) / size)
            gap = velocity(other, centre.at) - velocity(one, centre.at)
            assert abs(gap) <= 1e-9 * fast * reach
        elif centre.is_infinite:  # they turn alike; their velocities differ across its direction
            assert abs(relative) <= 1e-9 * max(map(abs, turning.values()))
            gap = velocity(other, 0j) - velocity(one, 0j)
            assert abs((gap * centre.towards.conjugate()).real) <= 1e-9 * fast


def test_three_centres_of_three_links_are_on_one_line() -> None:
    centres = find_centres(Solution(load(PROBLEMS / "linkages" / "ex3.toml")))
    for three in combinations(centres.links, 3):
        places = [centres.of(*pair).at for pair in combinations(three, 2)]
        if np.isnan(places).any():
            continue
        first, second = places[1] - places[0], places[2] - places[0]
        assert abs((first.conjugate() * second).imag) < 1e-9 * abs(first) * abs(second) + 1e-15


def test_the_centre_of_a_rod_is_on_the_crank_and_over_the_slider() -> None:
    solution = Solution(load(PROBLEMS / "linkages" / "ex1.toml"))
    rod = find_centres(solution).of(FRAME, "2")
    crank, slider = solution.points["B"].place[0], solution.points["C"].place[0]
    expected = complex(slider.real, crank.imag / crank.real * slider.real)
    assert rod.at == pytest.approx(expected, rel=1e-12)
    assert {*rod.by} == {"1", "3"}


def test_json_and_the_tables_list_every_centre() -> None:
    path = str(PROBLEMS / "linkages" / "ex3.toml")
    done = CliRunner().invoke(cli, ["solve", path, "--centres", "--json", "--position", "0"])
    record = json.loads(done.output)["positions"][0]["instant_centres"]
    assert len(record["centres"]) == 15
    by_links = {tuple(one["links"]): one for one in record["centres"]}
    assert by_links["0", "5"]["towards_deg"] == pytest.approx(90.0)
    assert by_links["1", "2"]["joint"] == "B"
    assert len(by_links["0", "2"]["lines"]) == 2
    shown = CliRunner().invoke(cli, ["solve", path, "--centres", "--lang", "en"])
    assert "P₀₂     P₀₁P₁₂" in shown.output
    refused = CliRunner().invoke(cli, ["solve", path, "--centres", "--ask", "v_E"])
    assert refused.exit_code == 2 and "--centres" in refused.output
    head, row = CliRunner().invoke(cli, ["solve", path, "--centres", "--csv"]).output.split()
    cells = dict(zip(head.split(","), row.split(","), strict=True))
    assert float(cells["P_02.x"]) == pytest.approx(by_links["0", "2"]["x"])
    assert cells["P_05.x"] == ""
    assert float(cells["P_05.towards_deg"]) == pytest.approx(90.0)
    told = CliRunner().invoke(cli, ["protocol", path, "--centres", "--lang", "en"])
    assert "Instant centres" in told.output and "P₀₁P₁₂ × P₀₃P₂₃" in told.output


@pytest.mark.parametrize("name", ["linkages/ex3", "linkages/triad"])
def test_the_sheet_of_centres_is_drawn(name: str, tmp_path: Path) -> None:
    done = CliRunner().invoke(
        cli,
        ["sheet", str(PROBLEMS / f"{name}.toml"), "--layout", "centres", "-o", str(tmp_path)],
    )
    assert done.exit_code == 0, done.output


FOUR_BAR = """
[frame]
A = [0, 0]
D = [{frame}, 0]
[links.2]
points = ["A", "B"]
AB = {crank}
[links.3]
points = ["B", "C"]
BC = {rod}
[links.4]
points = ["C", "D"]
CD = {rocker}
[driver]
link = "2"
phi = 60
n = {n}
[assembly]
C = "left of BD"
"""


def four_bar(**sizes: float) -> tuple[Solution, complex, complex]:
    """Return a four-bar, and its B and C by the law of cosines."""
    solution = Solution(loads(FOUR_BAR.format(**sizes), name="four-bar"))
    b = sizes["crank"] * np.exp(1j * np.pi / 3)
    diagonal = sizes["frame"] - b
    span = abs(diagonal)
    at_b = np.arccos(
        (sizes["rod"] ** 2 + span**2 - sizes["rocker"] ** 2) / (2 * sizes["rod"] * span)
    )
    return solution, b, b + sizes["rod"] * diagonal / span * np.exp(1j * at_b)


def test_the_rod_of_khurmi_s_four_bar_turns_about_the_meeting_point_of_its_cranks() -> None:
    """Khurmi and Gupta, Theory of Machines, example 6.1: drawn I₁₃B = 500 mm, ω_BC = 6.282 1/s."""
    solution, b, c = four_bar(frame=0.6, crank=0.3, rod=0.36, rocker=0.36, n=-100)
    centres = find_centres(solution)
    assert solution.points["C"].place[0] == pytest.approx(c, rel=1e-12)
    # b + s·b and c + t·(c - 0.6) are one place
    table = np.array([[b.real, -(c - 0.6).real], [b.imag, -(c - 0.6).imag]])
    along, _ = np.linalg.solve(table, [(c - b).real, (c - b).imag])
    rod = centres.of(FRAME, "3")
    assert rod.at == pytest.approx(b + along * b, rel=1e-9)
    omega = 100 * np.pi / 30 * 0.3 / abs(rod.at - b)
    assert abs(centres.motions["3"].omega) == pytest.approx(omega, rel=1e-9)
    assert abs(rod.at - b) == pytest.approx(0.5, rel=0.005)
    assert omega == pytest.approx(6.282, rel=0.005)


def test_the_torques_of_two_cranks_are_as_their_distances_from_their_common_centre() -> None:
    """mazurekgravity.in, Kennedy's theorem: 15, 5, 11, 8 cm, 120 rpm, 10 N·m on the crank."""
    solution, b, c = four_bar(frame=0.15, crank=0.05, rod=0.11, rocker=0.08, n=-120)
    centres = find_centres(solution)
    common = centres.of("2", "4").at
    assert common.imag == pytest.approx(0.0, abs=1e-12)
    # Velocities of B and C along the rod are equal.
    rod, arm = c - b, c - 0.15
    ratio = (rod.conjugate() * 1j * b).real / (rod.conjugate() * 1j * arm).real
    assert common.real / (common.real - 0.15) == pytest.approx(ratio, rel=1e-9)
    assert centres.motions["4"].omega == pytest.approx(-4 * np.pi * ratio, rel=1e-9)
    turned = FOUR_BAR.format(frame=0.15, crank=0.05, rod=0.11, rocker=0.08, n=-120)
    turned += '[[loads]]\nlink = "4"\ncouple = 1\n'
    balance = Statics(Solution(loads(turned, name="torque"))).balance[0]
    assert balance == pytest.approx(-ratio, rel=1e-9)
