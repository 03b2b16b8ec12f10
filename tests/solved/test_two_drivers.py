"""Mechanisms with two driving links: against Newton's method and all links at once."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from cases import each, sampled, some
from doors import (
    FRAME,
    ProblemError,
    Solution,
    Statics,
    StructureError,
    crank_cycle_of,
    cut_picture,
    find_centres,
    force_reading,
    get_language,
    lever_picture,
    parts_by_driver,
    problem_loads as loads,
    self_aligning,
)
from full_system import check_reactions, loads_of, pose_of, power_of, solve_all
from texts import protocol
from two_driven import COUPLER_LOADS as LOADS, FIVE_BAR, two_driven

SEEDS = range(63000, 63000 + some(200, few=40))


def test_second_cranks_and_sliders_occur() -> None:
    cranks = [two_driven(seed)[0].drive.other_drives[0].pivot is not None for seed in SEEDS]
    assert len(cranks) >= 40
    assert 5 < sum(cranks) < len(cranks) - 5


@each("seed", sampled(SEEDS, 5))
def test_the_motion_is_newtons(seed: int) -> None:
    problem, motion = two_driven(seed)
    solution = Solution(problem)
    names = {
        point: link for link in problem.mechanism.links for point in problem.bodies[link].points
    }
    for kind in ("position", "velocity", "acceleration"):
        values: dict[tuple[str, str], complex] = getattr(motion, kind)
        limit = 1e-9 * max(abs(one) for one in values.values())
        part = "place" if kind == "position" else kind
        for point, link in names.items():
            found = getattr(solution.points[point], part)[0]
            assert abs(found - values[link, point]) <= limit, (kind, point)


@each("seed", sampled(SEEDS, 5))
def test_all_forces_are_those_of_all_links_at_once(seed: int) -> None:
    problem, motion = two_driven(seed)
    statics = Statics(Solution(problem))
    joints = [(r.joint, r.on, r.by) for r in statics.reactions]
    acting = loads_of(problem, motion)
    answer = solve_all(problem, joints, pose_of(motion), acting)
    limit = 1e-9 * max(answer.largest, *(abs(load.force) for load in acting))
    size = max(1.0, *(abs(place) for place in motion.position.values()))
    assert abs(statics.balance[0] - answer.balance) <= limit * size
    check_reactions(problem, statics, motion, answer, limit)
    other = problem.drive.other_drives[0]
    force, moment = answer.joints[f"driver {other.link}", other.link, "0"]
    second = statics.other_balances[other.link][0]
    along = pose_of(motion).along(problem.slides["200"]) if other.pivot is None else 1.0 + 0j
    expected = moment if other.pivot is not None else (force * complex(along).conjugate()).real
    assert abs(second - expected) <= limit * size
    powers = power_of(problem, motion, acting)
    given = statics.balance[0] * problem.drive.rate + second * other.rate
    assert abs(sum(powers) + given) <= 1e-8 * (sum(map(abs, powers)) + abs(given))
    assert statics.lever is not None
    assert abs(statics.lever[0] - statics.balance[0]) <= 1e-7 * (abs(answer.balance) + limit)


@each("seed", sampled(SEEDS, 3))
def test_velocities_are_the_sums_of_those_of_each_driver(seed: int) -> None:
    problem, _ = two_driven(seed)
    solution = Solution(problem)
    parts = parts_by_driver(solution)
    assert [*parts] == [*problem.drive.links]
    for point, whole in solution.points.items():
        total = sum(part.points[point].velocity[0] for part in parts.values())
        fastest = max(abs(one.velocity[0]) for one in solution.points.values())
        assert abs(total - whole.velocity[0]) <= 1e-9 * fastest


def five_bar(phi: float, psi: float) -> complex:
    """Return the place of C by the closed formula: two circles about A and B."""
    a = 0.12 * cmath.exp(1j * phi)
    b = 0.4 + 0.15 * cmath.exp(1j * psi)
    way = b - a
    d = abs(way)
    along = (d * d + 0.3**2 - 0.32**2) / (2 * d)
    return a + way / d * complex(along, math.sqrt(0.3**2 - along**2))


def test_a_five_bar_moves_as_its_closed_formula() -> None:
    solution = Solution(loads(FIVE_BAR, name="five-bar"))
    phi, psi, step = math.radians(70), math.radians(40), 1e-4
    assert solution.points["C"].place[0] == pytest.approx(five_bar(phi, psi), rel=1e-12)
    # By five points in time: phi = 70° + 10·t, psi = 40° - 15·t + 5·t²/2.
    at = [five_bar(phi + 10 * t, psi - 15 * t + 2.5 * t * t)
          for t in (k * step for k in (-2, -1, 1, 2))]  # fmt: skip
    velocity = (at[0] - 8 * at[1] + 8 * at[2] - at[3]) / (12 * step)
    assert solution.points["C"].velocity[0] == pytest.approx(velocity, rel=1e-9)
    assert solution.structure.formula == "I(0,1) + I(0,4) → II(2,3)"
    assert solution.structure.mobility == 2


def test_a_parallel_five_bar_with_equal_cranks_moves_its_coupler_in_a_circle() -> None:
    """A differential linkage: with phi_4 = phi_1 and equal cranks, C moves as A does."""
    text = FIVE_BAR.replace("DB = 0.15", "DB = 0.12").replace("phi = 40", "phi = 70")
    text = text.replace("omega = -15\nepsilon = 5", "omega = 10")
    points = Solution(loads(text, name="five-bar")).points
    assert points["C"].velocity[0] == pytest.approx(points["A"].velocity[0], rel=1e-12)
    assert points["C"].acceleration[0] == pytest.approx(points["A"].acceleration[0], rel=1e-12)


def test_positions_of_a_list_belong_together_and_others_follow_in_time() -> None:
    text = FIVE_BAR.replace("phi = 70", "phi = [70, 80]").replace("phi = 40", "phi = [40, 10]")
    solution = Solution(loads(text, name="five-bar"))
    assert [*solution.links["4"].phi_deg] == pytest.approx([40.0, 10.0])
    later = Solution(loads(FIVE_BAR, name="five-bar"), positions=[70.0, 90.0])
    assert [*later.links["4"].phi_deg] == pytest.approx([40.0, 10.0])


def test_positions_of_the_same_first_driver_are_told_apart_by_their_number() -> None:
    text = FIVE_BAR.replace("phi = 70", "phi = [70, 70]").replace("phi = 40", "phi = [40, 10]")
    solution = Solution(loads(text, name="five-bar"))
    for number, psi in enumerate((40.0, 10.0)):
        alone = solution.in_position(number)
        assert alone.links["4"].phi_deg[0] == pytest.approx(psi)
        place = five_bar(math.radians(70), math.radians(psi))
        assert alone.points["C"].place[0] == pytest.approx(place, rel=1e-12)
        assert solution.read_on(number) == alone.read_on(0)


def test_other_places_of_both_drivers_keep_the_assembly() -> None:
    solution = Solution(loads(FIVE_BAR, name="five-bar"))
    moved = solution.in_places([np.array([60.0, 100.0]), np.array([20.0, 55.0])])
    for k, (phi, psi) in enumerate(((60.0, 20.0), (100.0, 55.0))):
        place = five_bar(math.radians(phi), math.radians(psi))
        assert moved.points["C"].place[k] == pytest.approx(place, rel=1e-12)
    assert [drive.rate for drive in moved.problem.drive.every] == [10.0, -15.0]
    assert moved.problem.drive.assembly_positions == (70.0,)


def test_two_drivers_have_no_cycle_and_the_message_says_why() -> None:
    solution = Solution(loads(FIVE_BAR, name="five-bar"))
    with pytest.raises(ProblemError, match=r"a turn of one crank, but links 1, 4 drive"):
        crank_cycle_of(solution)


@each("seed", sampled(SEEDS, 3))
def test_self_aligning_schemes_have_full_rank_and_keep_both_drivers(seed: int) -> None:
    """6n - W rows, as many as the rank: no redundant constraint, and W = 2 motions left."""
    problem, _ = two_driven(seed)
    solution = Solution(problem)
    found = self_aligning(problem, solution.structure)
    assert [pair.links for pair in found.drivers] == [("0", k) for k in problem.drive.links]
    assert not found.random
    if found.schemes:
        assert found.rank == found.rows
        assert 6 * solution.structure.moving_links - found.rank == 2 + found.local[0]


@pytest.mark.parametrize("lang", ["en", "ru"])
def test_protocol_and_pictures_show_both_drivers(lang: str) -> None:
    solution = Solution(loads(FIVE_BAR + LOADS, name="five-bar"))
    shown = " ".join(protocol(solution, lang=lang).split())
    assert "I(0,1) + I(0,4) → II(2,3)" in shown
    assert "φ₄ = 40°" in shown
    reading, say = force_reading(solution, 0), get_language(lang).notation
    for number in range(len(reading.plans)):
        cut_picture(reading, number, 3.5, say)
    lever_picture(reading, 3.5, say)


@pytest.mark.parametrize(
    ("old", "new", "path"),
    [
        ('link = "4"', 'link = "1"', "drivers[1].link"),
        ("phi = 40\n", "", "drivers[1].phi"),
        ("omega = -15\nepsilon = 5", "torque = 4", "drivers[1].torque"),
        ("phi = 40", "phi = [40, 50]", "drivers[1].phi"),
        ("[assembly]", "[machine]\ndelta = 0.1\n[assembly]", "machine"),
        ("[assembly]", "[balancing_force]\nat = 'A'\n[assembly]", "balancing_force"),
        ("[[drivers]]\n", '[driver]\nlink = "1"\n[[drivers]]\n', "driver"),
    ],
)
def test_a_fault_names_its_key(old: str, new: str, path: str) -> None:
    with pytest.raises(ProblemError) as caught:
        loads(FIVE_BAR.replace(old, new, 1), name="five-bar")
    assert path in [fault.path for fault in caught.value.faults]


def test_one_driver_of_a_five_bar_names_the_second() -> None:
    text = FIVE_BAR.split("[[drivers]]")
    one = text[0] + "[driver]" + text[1] + "[assembly]" + text[2].split("[assembly]")[1]
    with pytest.raises(StructureError, match=r"1 driver is given.*link|4.*\[\[drivers\]\]"):
        Solution(loads(one, name="five-bar"))


def test_two_drivers_of_a_four_bar_are_one_too_many() -> None:
    text = FIVE_BAR.replace('[links.4]\npoints = ["D", "B"]\nDB = 0.15', "")
    text = text.replace('points = ["C", "B"]\nCB = 0.32', 'points = ["D", "C"]\nDC = 0.32')
    text = text.replace('link = "4"', 'link = "3"').replace("left of AB", "left of AD")
    with pytest.raises(ProblemError, match="2 drivers are given"):
        loads(text, name="four-bar")


def test_instant_centres_are_those_of_both_rates() -> None:
    """Wheels of both cranks would roll on each other in P₁₄."""
    solution = Solution(loads(FIVE_BAR, name="five-bar"))
    centres = find_centres(solution)
    for link, motion in solution.links.items():
        assert centres.motions[link].omega == pytest.approx(float(motion.omega[0]), rel=1e-9)
    one, four = (float(solution.links[k].omega[0]) for k in ("1", "4"))
    first, second = (centres.of(FRAME, k).at for k in ("1", "4"))
    wanted = (one * first - four * second) / (one - four)
    assert centres.of("1", "4").at == pytest.approx(wanted, rel=1e-9)
