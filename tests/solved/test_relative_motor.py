"""A motor between two moving links: its motion and its moment, against all links at once."""

from __future__ import annotations

import math
import random
import re
from collections.abc import Callable
from itertools import combinations

import pytest
from cases import each, sampled, some
from doors import (
    ModelProblem as Problem,
    OutputPositionKind,
    OutputPositions,
    OutputRate,
    ProblemError,
    Solution,
    Statics,
    cut_picture,
    cycle_forces_of,
    force_reading,
    get_language,
    lever_picture,
    pose,
    problem_loads as loads,
    settle,
)
from full_system import check_reactions, loads_of, pose_of, power_of, solve_all
from loaded import loaded_problem
from msgspec.structs import replace
from newton import Motion, solve as newton
from texts import protocol

SEEDS = range(62000, 62000 + some(200, few=40))
FOUR_BAR = """
[frame]
O = [0, 0]
D = [0.3, 0]
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A", "C", "T"]
AC = 0.25
T = { on = "AC", at = 0.35 }
[links.3]
points = ["D", "C"]
DC = 0.2
[driver]
link = "1"
phi_2_3 = 70
omega_2_3 = 4
root = 1
[assembly]
C = "left of AD"
"""
LOADS = """
[dynamics]
[dynamics.links.2]
mass = 2
centre = "T"
inertia = 0.01
[[loads]]
link = "3"
couple = 5
"""


def motored(seed: int) -> tuple[Problem, Motion, tuple[str, str]]:
    """Return a random mechanism with loads and a motor between two of its moving links."""
    for more in range(50):
        problem, start = loaded_problem(seed + 1000 * more, triad=seed % 5 == 0)
        motion = newton(problem, problem.drive.positions[0], start)
        rates = motion.omega
        fastest = max(abs(rate) for rate in rates.values())
        pairs = [
            pair
            for pair in combinations(problem.mechanism.links, 2)
            if fastest and abs(rates[pair[1]] - rates[pair[0]]) > 0.1 * fastest
        ]
        if pairs:
            break
    links = random.Random(seed).choice(pairs)
    name = "_".join(links)
    posed = OutputPositions(OutputPositionKind.BETWEEN, name, (math.nan,))
    rate = OutputRate(f"omega_{name}", rates[links[1]] - rates[links[0]], 0.0)
    drive = replace(problem.drive, posed=posed, output_rate=rate)
    if seed % 4 == 3:  # it stands
        drive = replace(drive, rate=0.0, acceleration=1.0)
        motion = newton(replace(problem, drive=drive), drive.positions[0], start)
    return replace(problem, drive=drive), motion, links


@each("seed", sampled(SEEDS, 5))
def test_all_forces_are_those_of_all_links_at_once(seed: int) -> None:
    problem, motion, links = motored(seed)
    statics = Statics(Solution(problem))
    joints = [(r.joint, r.on, r.by) for r in statics.reactions]
    acting = loads_of(problem, motion)
    answer = solve_all(problem, joints, pose_of(motion), acting, motor=links)
    limit = 1e-9 * max(answer.largest, *(abs(load.force) for load in acting))
    size = max(1.0, *(abs(place) for place in motion.position.values()))
    assert abs(statics.balance[0] - answer.balance) <= limit * size
    check_reactions(problem, statics, motion, answer, limit)
    if statics.lever is not None:
        powers = power_of(problem, motion, acting)
        rate = motion.omega[links[1]] - motion.omega[links[0]]
        assert abs(sum(powers) + statics.lever[0] * rate) <= 1e-9 * sum(map(abs, powers))


def four_bar() -> Problem:
    return pose(loads(FOUR_BAR + LOADS, name="four-bar"))


def test_the_relative_angle_and_rates_are_as_given() -> None:
    solution = Solution(four_bar())
    two, three = (solution.links[link] for link in ("2", "3"))
    turned = math.radians(float(three.phi_deg[0] - two.phi_deg[0]))
    assert abs(math.remainder(turned, 2 * math.pi)) == pytest.approx(math.radians(70), abs=1e-9)
    assert float(three.omega[0] - two.omega[0]) == pytest.approx(4.0, rel=1e-12)
    assert abs(float(three.epsilon[0] - two.epsilon[0])) < 1e-9


def test_the_angle_follows_from_the_law_of_cosines() -> None:
    """AD² = AC² + DC² - 2·AC·DC·cos 70°, and A is on its circle: the angle of the crank."""
    distance = 0.25**2 + 0.2**2 - 2 * 0.25 * 0.2 * math.cos(math.radians(70))
    crank = math.degrees(math.acos((0.1**2 + 0.3**2 - distance) / (2 * 0.1 * 0.3)))
    assert four_bar().drive.positions[0] == pytest.approx(crank, abs=1e-9)


@pytest.mark.parametrize("rate", ["4", "0"])
@pytest.mark.parametrize("lang", ["en", "ru"])
def test_protocol_and_pictures_show_the_motor(rate: str, lang: str) -> None:
    text = FOUR_BAR.replace("omega_2_3 = 4", f"omega_2_3 = {rate}") + LOADS
    solution = Solution(pose(loads(text, name="four-bar")))
    shown = " ".join(protocol(solution, lang=lang).split())
    motor = "A motor between links 2 and 3" if lang == "en" else "двигатель между звеньями 2 и 3"
    assert motor in shown
    assert ("a tried moment of" in shown or "пробный момент" in shown) is (rate == "0")
    reading, say = force_reading(solution, 0), get_language(lang).notation
    for number in range(len(reading.plans)):
        cut_picture(reading, number, 3.5, say)
    if rate != "0":
        lever_picture(reading, 3.5, say)


def test_a_crank_with_its_own_rate_still_drives_at_a_relative_angle() -> None:
    problem = pose(loads(FOUR_BAR.replace("omega_2_3 = 4", "omega = 1"), name="four-bar"))
    assert problem.drive.motor is None
    assert problem.drive.rate == 1.0


@pytest.mark.parametrize(
    ("table", "path"),
    [
        ('[machine]\ndelta = "1/18"', "machine"),
        ('[balancing_force]\nat = "A"', "balancing_force"),
        ("[balancing]\n", "balancing"),
    ],
)
def test_tables_for_a_rotating_crank_are_rejected(table: str, path: str) -> None:
    with pytest.raises(ProblemError) as caught:
        loads(FOUR_BAR + LOADS + table, name="four-bar")
    faults = [fault for fault in caught.value.faults if fault.path == path]
    assert faults
    assert "motor between links 2 and 3" in faults[0].message


def forces_of_a_turn(problem: Problem) -> None:
    cycle_forces_of(Solution(problem, positions=[40.0, 50.0]))


@pytest.mark.parametrize(
    ("ask", "table"), [(forces_of_a_turn, ""), (settle, "[project]\n")], ids=["turn", "project"]
)
def test_forces_of_a_turn_are_refused_with_the_variants_to_write(
    ask: Callable[[Problem], object], table: str
) -> None:
    problem = pose(loads(FOUR_BAR + LOADS + table, name="four-bar"))
    with pytest.raises(ProblemError, match="motor between links 2 and 3") as caught:
        ask(problem)
    line = re.search(r"variants = {.+}(?=, then)", caught.value.faults[0].hint)
    assert line is not None
    other = pose(loads(f"{line[0]}\n{FOUR_BAR}{LOADS}", name="four-bar", variant="2"))
    assert other.drive.posed is not None
    assert other.drive.posed.values == (80.0,)
    links = Solution(other).links
    assert links["3"].omega[0] - links["2"].omega[0] == pytest.approx(4.0, rel=1e-9)


def test_several_relative_angles_are_refused() -> None:
    text = FOUR_BAR.replace("phi_2_3 = 70", "phi_2_3 = [60, 70]")
    with pytest.raises(ProblemError) as caught:
        loads(text, name="four-bar")
    (fault,) = caught.value.faults
    assert fault.path == "driver.omega_2_3"
    assert "2.driver.phi_2_3 = 70, 2.driver.root = 1 }" in fault.hint
