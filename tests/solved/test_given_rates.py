"""The driver's rates that an output or a load determines: against Newton and energies."""

from __future__ import annotations

import cmath
import math
import random
import re
from itertools import pairwise

import pytest
from cases import each, sampled, some
from doors import (
    AssemblyError,
    ModelProblem as Problem,
    OutputRate,
    PointName,
    ProblemError,
    Solution,
    Statics,
    find_rates,
    kept_rates,
    page_live_page as live_page,
    pose,
    problem_loads as loads,
)
from loaded import loaded_problem
from msgspec.structs import replace
from newton import Motion, solve as newton
from texts import protocol
from worked import problem_of

SEEDS = range(61000, 61000 + some(200, few=40))
SLIDER = """units = "mm"
[frame]
O = [0, 0]
guides.x-x = { through = "O", angle = 0 }
[links.1]
points = ["O", "A"]
OA = 50
[links.2]
points = ["A", "B", "S"]
AB = 200
S = { on = "AB", at = 80 }
[links.3]
points = ["B"]
slides = { on = "x-x" }
[driver]
link = "1"
phi = 50
v_B = 2
[assembly]
B = "right of A"
"""
MASSES = """
[dynamics]
gravity = 0
[dynamics.links.1]
inertia = 0.02
[dynamics.links.2]
mass = 3
centre = "S"
inertia = 0.01
[dynamics.links.3]
mass = 4
[[loads]]
link = "3"
at = "B"
force = 150
angle = 0
"""


def outputs(problem: Problem, motion: Motion) -> list[tuple[str, float, float]]:
    """Return rates of outputs in a motion with their accelerations."""
    found = []
    names: dict[str, str] = {}
    for link, point in motion.position:
        if link in problem.mechanism.links and point in problem.bodies[link].points:
            names.setdefault(point, link)
    for point, link in names.items():
        v, a = motion.velocity[link, point], motion.acceleration[link, point]
        found += [(f"vx_{point}", v.real, a.real), (f"vy_{point}", v.imag, a.imag)]
    links = [link for link in problem.mechanism.links if link != problem.drive.link]
    found += [(f"omega_{k}", motion.omega[k], motion.epsilon[k]) for k in links]
    w, e = motion.omega, motion.epsilon
    for one, two in pairwise(links):
        found.append((f"omega_{one}_{two}", w[two] - w[one], e[two] - e[one]))
    return found


@each("seed", sampled(SEEDS, 5))
def test_the_driver_has_the_rates_that_give_the_output_its_own(seed: int) -> None:
    problem, start = loaded_problem(seed, triad=seed % 5 == 0)
    motion = newton(problem, problem.drive.positions[0], start)
    rates = outputs(problem, motion)
    largest = max(abs(rate) for _, rate, _ in rates)
    lively = [one for one in rates if abs(one[1]) > 0.05 * largest]
    key, rate, gain = random.Random(seed).choice(lively)
    drive = replace(problem.drive, output_rate=OutputRate(key, rate, gain), rate=rate)
    found = find_rates(replace(problem, drive=drive)).drive
    assert found.rate == pytest.approx(problem.drive.rate, rel=1e-9)
    size = max(map(abs, motion.epsilon.values()))
    assert found.acceleration == pytest.approx(problem.drive.acceleration, abs=1e-8 * (1 + size))


@each("seed", sampled(SEEDS, 5))
def test_a_load_gives_the_driver_the_acceleration_that_it_balances(seed: int) -> None:
    problem, _ = loaded_problem(seed, triad=seed % 5 == 0)
    statics = Statics(Solution(problem))
    effort = float((statics.balance if statics.moment is None else statics.moment)[0])
    drive = replace(problem.drive, effort=effort, acceleration=0.0)
    found = find_rates(replace(problem, drive=drive))
    assert found.drive.acceleration == pytest.approx(problem.drive.acceleration, rel=1e-8, abs=1e-8)


def crank_slider(phi: float) -> tuple[complex, complex]:
    """Return the places of S and B of the slider-crank, m; analytic in the angle."""
    z = 0.05 * complex(math.cos(phi), math.sin(phi))
    b = z.real + math.sqrt(0.2**2 - z.imag**2)
    return z + (b - z) * 0.4, complex(b)


def derivatives(phi: float) -> tuple[float, float, complex, float]:
    """Return dx_B/dphi, d²x_B/dphi², dS/dphi and dtheta/dphi by the closed formulas."""
    s, c = math.sin(phi), math.cos(phi)
    r, length = 0.05, 0.2
    root = math.sqrt(length**2 - (r * s) ** 2)
    first = -r * s - r * r * s * c / root
    second = -r * c - r * r * ((c * c - s * s) / root + (r * s * c) ** 2 / root**3)
    turn = -r * c / root
    z = r * cmath.exp(1j * phi)
    return first, second, 0.6 * 1j * z + 0.4 * first, turn


@pytest.mark.parametrize("speed", [2.0, -0.5])
def test_the_slider_moves_along_its_guide_as_given(speed: float) -> None:
    problem = pose(loads(SLIDER.replace("v_B = 2", f"v_B = {speed}"), name="slider"))
    first, _, _, _ = derivatives(math.radians(50))
    assert problem.drive.rate == pytest.approx(speed / first, rel=1e-12)
    assert problem.drive.acceleration == 0.0
    assert Solution(problem).points["B"].velocity[0] == pytest.approx(speed, rel=1e-12)


def test_an_even_slider_makes_the_crank_accelerate() -> None:
    problem = pose(loads(SLIDER.replace("v_B = 2", "v_B = 2\na_B = 0"), name="slider"))
    first, second, _, _ = derivatives(math.radians(50))
    omega = 2 / first
    assert problem.drive.acceleration == pytest.approx(-second * omega**2 / first, rel=1e-11)
    assert abs(Solution(problem).points["B"].acceleration[0]) < 1e-10


def test_of_a_point_on_no_guide_the_speed_is_given() -> None:
    for sign in (1.0, -1.0):
        problem = pose(loads(SLIDER.replace("v_B = 2", f"v_S = {3 * sign}"), name="slider"))
        assert problem.drive.rate * sign > 0.0
        assert abs(Solution(problem).points["S"].velocity[0]) == pytest.approx(3.0, rel=1e-12)


def energy(phi: float, omega: float) -> float:
    first, _, centre, turn = derivatives(phi)
    inertia = 0.02 + 3 * abs(centre) ** 2 + 0.01 * turn**2 + 4 * first**2
    return inertia * omega**2 / 2


@pytest.mark.parametrize("omega", [0.0, 12.0, -7.0])
def test_the_torque_is_the_rate_of_energy(omega: float) -> None:
    """dT/dt = (M + F·dx_B/dphi)·omega, so that J·epsilon + J'·omega²/2 = M + F·dx_B/dphi."""
    text = SLIDER.replace("v_B = 2", f"torque = 20\nomega = {omega}") + MASSES
    problem = pose(loads(text, name="slider"))
    phi, step = math.radians(50), 1e-4
    first, _, _, _ = derivatives(phi)
    inertia = 2 * energy(phi, 1.0)
    # Five points: the derivative of the reduced inertia to twelve digits.
    near = [2 * energy(phi + k * step, 1.0) for k in (-2, -1, 1, 2)]
    slope = (near[0] - 8 * near[1] + 8 * near[2] - near[3]) / (12 * step)
    expected = (20 + 150 * first - slope * omega**2 / 2) / inertia
    assert problem.drive.acceleration == pytest.approx(expected, rel=1e-9)
    assert problem.drive.found_rates is not None
    assert problem.drive.found_rates.inertia == pytest.approx(inertia, rel=1e-9)


def test_friction_takes_its_part_of_the_torque() -> None:
    rubs = "[friction]\nf = 0.1\nf_pin = 0.1\nradius = 0.01\n"
    text = SLIDER.replace("v_B = 2", "torque = 20\nomega = 12") + MASSES
    free, rubbed = (pose(loads(text + more, name="slider")) for more in ("", rubs))
    assert rubbed.drive.acceleration < free.drive.acceleration


def start_of(solution: Solution) -> dict[str, tuple[float, float, float]]:
    """Return the pose of a solution, from which Newton's method starts."""
    found = {}
    for link in solution.problem.mechanism.links:
        turn = math.radians(float(solution.links[link].phi_deg[0]))
        point, own = next(iter(solution.problem.bodies[link].points.items()))
        place = complex(solution.place(PointName(point))[0]) - own * cmath.exp(1j * turn)
        found[link] = (place.real, place.imag, turn)
    return found


@pytest.mark.parametrize("name", ["linkages/ex3", "linkages/2.1.15", "linkages/2.1.100"])
def test_textbook_mechanisms_move_as_their_outputs(name: str) -> None:
    """Mechanisms of the textbook and the bank: Newton's velocities give the crank its own."""
    problem = problem_of(name)
    one = replace(problem.drive, positions=problem.drive.positions[:1])
    problem = replace(problem, drive=one, cycle=None, published=(), dynamics=None)
    motion = newton(problem, one.positions[0], start_of(Solution(problem)))
    for key, rate, _ in outputs(problem, motion):
        if abs(rate) > 1e-3 * abs(one.rate):
            drive = replace(one, output_rate=OutputRate(key, 3 * rate), rate=rate)
            found = find_rates(replace(problem, drive=drive)).drive
            assert found.rate == pytest.approx(3.0 * one.rate, rel=1e-9), key


def test_in_a_dead_position_no_speed_of_the_driver_is_found() -> None:
    with pytest.raises(AssemblyError, match="v_B is 0 at any speed of link 1"):
        pose(loads(SLIDER.replace("phi = 50", "phi = 0"), name="slider"))


@pytest.mark.parametrize(
    ("old", "new", "path"),
    [
        ("v_B = 2", "v_B = 2\nomega = 3", "driver.omega"),
        ("v_B = 2", "a_B = 2", "driver.a_B"),
        ("v_B = 2", "v_Q = 2", "driver.v_Q"),
        ("v_B = 2", "omega_1 = 2", "driver.omega_1"),
        ("v_B = 2", "omega_2_2 = 2", "driver.omega_2_2"),
        ("v_B = 2", "v_S = 2\na_S = 1", "driver.a_S"),
        ("v_B = 2", "v_B = 2\na_B = 1\nepsilon = 1", "driver.epsilon"),
        ("phi = 50", "phi = [50, 60]", "driver.v_B"),
        ("v_B = 2", "torque = 2", "driver.torque"),
        ("v_B = 2", "omega = 1\nforce = 2", "driver.force"),
        ("v_B = 2", "torque = 2\nepsilon = 2", "driver.epsilon"),
    ],
)
def test_a_fault_names_its_key(old: str, new: str, path: str) -> None:
    with pytest.raises(ProblemError) as caught:
        loads(SLIDER.replace(old, new), name="slider")
    assert path in [fault.path for fault in caught.value.faults]


def test_a_torque_needs_inertia() -> None:
    text = SLIDER.replace("v_B = 2", "torque = 2") + "[dynamics.links.3]\nmass = 0\n"
    with pytest.raises(ProblemError, match="no inertia is reduced to link 1"):
        pose(loads(text, name="slider"))


@pytest.mark.parametrize("lang", ["en", "ru"])
def test_the_statement_shows_how_the_rates_follow(lang: str) -> None:
    by_output = protocol(Solution(pose(loads(SLIDER, name="slider"))), lang=lang)
    assert "44" in by_output
    assert "0.04457" in by_output.replace(",", ".")
    text = SLIDER.replace("v_B = 2", "torque = 20") + MASSES
    assert "20" in protocol(Solution(pose(loads(text, name="slider"))), lang=lang)


FIVE_BAR = """
frame = { A = [0, 0], E = [0.2, 0] }
assembly = { C = "above A" }
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "C"]
BC = 0.2
[links.3]
points = ["C", "D"]
CD = 0.2
[links.4]
points = ["E", "D"]
ED = 0.1
[[drivers]]
link = "1"
phi = 80
omega = 2
[[drivers]]
link = "4"
phi = 60
vx_C = 0.1
"""


def in_several(text: str, lists: dict[str, str]) -> tuple[str, str]:
    """Return a file with lists of positions, and the file that the message tells to write."""
    asked = text
    for old, new in lists.items():
        asked = asked.replace(old, new)
    with pytest.raises(ProblemError) as caught:
        loads(asked, name="several")
    (fault,) = caught.value.faults
    assert "in each position" in fault.message
    written = re.search(r"Write (.+), and before .+ the line (variants = {.+}). Req", fault.hint)
    assert written is not None
    first = written[1].split(", ")
    for place, new in zip(first, lists.values(), strict=True):
        asked = asked.replace(new.splitlines()[0], place)
    return fault.path, f"{written[2]}\n{asked}"


@pytest.mark.parametrize(
    ("place", "numbers"),
    [
        ("phi = [20, 50, 80]", ["2", "3"]),
        ("phi = { from = 10, to = 70, step = 20 }", ["2", "3", "4"]),
        ('x_B = [230, 220]\nroot = "going left"', ["2"]),
        ('stroke = [0.3, 0.5]\nroot = "going forth"', ["2"]),
        ('at = ["extreme right + 30", "extreme right + 50"]', ["2"]),
    ],
)
def test_positions_in_a_list_are_refused_and_hold_as_the_told_variants(
    place: str, numbers: list[str]
) -> None:
    path, text = in_several(SLIDER, {"phi = 50": place})
    assert path == "driver.v_B"
    places = []
    for variant in (None, *numbers):
        problem = pose(loads(text, name="several", variant=variant))
        places.append(problem.drive.positions[0])
        assert Solution(problem).points["B"].velocity[0] == pytest.approx(2.0, rel=1e-9)
    assert len({round(one, 6) for one in places}) == len(numbers) + 1


def test_a_torque_in_several_positions_is_refused_with_the_variants_to_write() -> None:
    text = SLIDER.replace("v_B = 2", "torque = 20") + MASSES
    path, told = in_several(text, {"phi = 50": "phi = [50, 60]"})
    assert path == "driver.torque"
    gains = [pose(loads(told, name="x", variant=one)).drive.acceleration for one in (None, "2")]
    assert gains[0] != pytest.approx(gains[1], rel=1e-3)


@pytest.mark.parametrize(
    "lists",
    [
        {"phi = 80": "phi = [80, 70]"},
        {"phi = 80": "phi = [80, 70]", "phi = 60": "phi = [60, 65]"},
    ],
)
def test_positions_of_another_driver_are_refused_too(lists: dict[str, str]) -> None:
    path, text = in_several(FIVE_BAR, lists)
    assert path == "drivers[1].vx_C"
    for variant in (None, "2"):
        at = Solution(pose(loads(text, name="five", variant=variant))).points["C"]
        assert at.velocity[0].real == pytest.approx(0.1, rel=1e-9)


def test_a_cycle_of_positions_is_refused() -> None:
    with pytest.raises(ProblemError, match="Delete \\[cycle\\]"):
        loads(SLIDER + "[cycle]\ncount = 12\n", name="cycle")


@pytest.mark.parametrize("rate", ["v_B = 2", "torque = 20"])
def test_in_other_positions_the_rates_stay_and_a_warning_says_so(rate: str) -> None:
    problem = pose(loads(SLIDER.replace("v_B = 2", rate) + MASSES, name="slider"))
    assert not [*kept_rates(Solution(problem))]
    assert not [*kept_rates(Solution(problem, positions=[50.0]))]
    (said,) = kept_rates(Solution(problem, positions=[50.0, 60.0]))
    assert said.startswith(rate.split()[0])
    assert "phi = 50 deg only" in said


@pytest.mark.parametrize("rate", ["v_B = 2", "vx_S = 2", "omega_2 = 3", "torque = 20"])
def test_the_live_page_offers_no_lengths_with_which_the_rates_would_change(rate: str) -> None:
    problem = pose(loads(SLIDER.replace("v_B = 2", rate) + MASSES, name="slider"))
    assert "rates that follow from an output or a load" in live_page(problem, "en")
