"""Wheels, racks and rolling wheels in linkages against a full system of their own."""

from __future__ import annotations

import math
import random
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from doors import cli, page_live_page as live_page
from geared import KINDS, Model, Wheels, masses

import planmethod
from planmethod.errors import PlanMethodError
from planmethod.solved.forces.friction import friction_of
from planmethod.solved.forces.statics import statics_of

SEEDS = range(40)
EXACT = 1e-9


@pytest.mark.parametrize("seed", SEEDS)
def test_a_random_geared_linkage_moves_and_bears_as_its_full_system_does(seed: int) -> None:
    rng = random.Random(seed)
    make, kind = KINDS[seed % len(KINDS)]
    ways = (0.0, 4.0, 11.0)
    for _ in range(50):
        model = make(rng, kind)
        masses(rng, model)
        try:
            full = [model.solve(way) for way in ways]
        except (ArithmeticError, np.linalg.LinAlgError):
            continue
        if all(np.linalg.cond(model.jacobian(q)) < 200 for q, _, _ in full):
            break
    else:
        pytest.fail("no mechanism was found")
    solution = planmethod.solve(planmethod.loads(model.toml(ways), name="random"))
    statics = statics_of(solution)
    for n, (q, rates, accelerations) in enumerate(full):
        for k, link in enumerate(model.moving):
            origin = next(iter(model.links[link]))
            motion = solution.points[origin]
            for own, numbers in ((motion.place, q), (motion.velocity, rates),
                                 (motion.acceleration, accelerations)):  # fmt: skip
                told = complex(numbers[3 * k], numbers[3 * k + 1])
                assert own[n] == pytest.approx(told, rel=EXACT, abs=EXACT * 10)
            turned = solution.links[link]
            gap = math.radians(turned.phi_deg[n]) - q[3 * k + 2]
            assert math.remainder(gap, 2 * math.pi) == pytest.approx(0, abs=EXACT)
            assert turned.omega[n] == pytest.approx(rates[3 * k + 2], rel=EXACT, abs=EXACT * 10)
            told_epsilon = accelerations[3 * k + 2]
            assert turned.epsilon[n] == pytest.approx(told_epsilon, rel=EXACT, abs=EXACT * 100)
        known = model.forces(q, accelerations)
        largest = max(abs(x) for x in known.values())
        for found in statics.reactions:
            key = (found.joint, found.on, found.by)
            told_force = known.get(key, -known.get((found.joint, found.by, found.on), np.nan))
            assert found.force[n] == pytest.approx(told_force, abs=EXACT * largest), key
        assert statics.balance[n] == pytest.approx(known["M", "1", ""].real, abs=EXACT * largest)
        assert statics.lever is not None
        assert statics.lever[n] == pytest.approx(statics.balance[n], abs=EXACT * largest)


ROLLING = """
title = "Wheel"
[frame]
O = [0, 0]
{frame}
[links.1]
points = ["O", "A"]
OA = 0.06
[links.2]
points = ["A", "C"]
AC = 0.3
[links.3]
points = ["C", "E"]
CE = 0.03
rolls = {{ {rolls} }}
[driver]
link = "1"
omega = 6
epsilon = -2
phi = [40, 41, 130, 250, 400]
[assembly]
C = "right of A"
[dynamics]
gravity = 9.81
[dynamics.links.3]
mass = 2
centre = "C"
inertia = 0.01
[[loads]]
link = "3"
couple = 1.5
"""


@pytest.mark.parametrize(("side", "above"), [("", 1), (', side = "right"', -1)])
def test_a_wheel_rolls_on_a_line_without_sliding(side: str, above: int) -> None:
    rolls = f'on = "rail", radius = 0.04, centre = "C", phi = 30, at = 0.2{side}'
    text = ROLLING.format(frame="guides.rail = {through = [0, -0.1], angle = 0}", rolls=rolls)
    solution = planmethod.solve(planmethod.loads(text, name="line"))
    c, wheel = solution.points["C"], solution.links["3"]
    assert c.place.imag == pytest.approx(-0.1 + above * 0.04)
    turned = np.radians(30.0) - above * (c.place.real - 0.2) / 0.04
    assert np.cos(np.radians(wheel.phi_deg) - turned) == pytest.approx(1.0)
    assert wheel.omega == pytest.approx(-above * c.velocity.real / 0.04)
    assert wheel.epsilon == pytest.approx(-above * c.acceleration.real / 0.04)
    # The contact holds the wheel: normal force in its guide, friction in the pole.
    statics = statics_of(solution)
    found = {(one.joint, one.on, one.by): one for one in statics.reactions}
    friction = found["W", "3", "0"].force.real
    couple = 1.5 - 0.01 * wheel.epsilon
    assert friction * above * 0.04 == pytest.approx(-couple, rel=EXACT)
    structure = solution.structure
    assert (structure.moving_links, structure.lower_pairs, structure.higher_pairs) == (3, 4, 0)
    assert structure.mobility == 1


@pytest.mark.parametrize("inside", [False, True])
def test_a_wheel_rolls_on_a_circle_without_sliding(inside: bool) -> None:
    side = ', side = "inside"' if inside else ""
    rolls = f'on = "K", circle = 0.2, radius = 0.05, centre = "C", phi = 30, at = 70{side}'
    text = ROLLING.format(frame="K = [0.3, -0.2]", rolls=rolls).replace("right of A", "above K")
    solution = planmethod.solve(planmethod.loads(text, name="circle"))
    c, wheel = solution.points["C"], solution.links["3"]
    k = 0.3 - 0.2j
    reach = 0.15 if inside else 0.25
    assert np.abs(c.place - k) == pytest.approx(reach)
    ray = (c.place - k) / reach
    swing = (c.velocity / (1j * ray)).real
    sign = -1 if inside else 1
    assert wheel.omega == pytest.approx(sign * swing / 0.05)
    arm = np.unwrap(np.angle(ray)) - np.radians(70.0)
    turned = np.radians(30.0) + sign * arm * reach / 0.05
    assert np.cos(np.radians(wheel.phi_deg) - turned) == pytest.approx(1.0)
    contact = c.velocity + 1j * wheel.omega * (-sign * ray * 0.05)
    assert np.abs(contact).max() < 1e-12


def test_a_wheel_of_a_rod_that_goes_round_is_counted_over_whole_turns() -> None:
    text = """
title = "Drag link"
[frame]
O = [0, 0]
D = [0.1, 0]
[links.1]
points = ["O", "A"]
OA = 0.3
[links.2]
points = ["A", "B"]
AB = 0.35
[links.3]
points = ["D", "B"]
DB = 0.4
[links.4]
points = ["A", "E"]
AE = 0.1
[[meshes]]
links = ["3", "5"]
centres = ["D", "O"]
r = [0.07, 0.03]
phi = [80, 10]
[links.5]
points = ["O", "F"]
OF = 0.1
[driver]
link = "1"
omega = 6
phi = [40, 90, 170, 250, 400, 760, 1120]
[assembly]
B = "left of AD"
""".replace('[links.4]\npoints = ["A", "E"]\nAE = 0.1\n', "")
    problem = planmethod.loads(text, name="drag")
    solution = planmethod.solve(problem)
    dense = planmethod.solve(problem, positions=np.arange(40.0, 1121.0, 2.0))
    rocker = np.unwrap(np.radians(dense.links["3"].phi_deg))
    start = np.radians(80.0)
    assert abs(rocker[0] - start) < np.pi
    turned = np.radians(10.0) - 7.0 / 3.0 * (rocker - start)
    assert rocker[-1] - rocker[0] > 6 * np.pi - 1e-6  # the rocker goes round with the crank
    off = np.radians(dense.links["5"].phi_deg) - turned
    assert np.abs(np.exp(1j * off) - 1.0).max() < EXACT
    places = [list(dense.positions).index(x) for x in solution.positions]
    assert solution.points["F"].place == pytest.approx(dense.points["F"].place[places])


def test_a_third_crank_of_a_parallelogram_is_passive() -> None:
    text = """
title = "Three cranks"
[frame]
O = [0, 0]
K = [0.5, 0]
L = [1.0, 0]
[links.1]
points = ["O", "A"]
OA = 0.2
[links.2]
points = ["A", "B", "C"]
AB = 0.5
AC = 1.0
BC = 0.5
[links.3]
points = ["K", "B"]
KB = 0.2
[links.4]
points = ["L", "C"]
LC = {length}
[driver]
link = "1"
phi = [40, 179, 181]
omega = 5
[assembly]
B = {{ keep = "parallel" }}
"""
    solution = planmethod.solve(planmethod.loads(text.format(length=0.2), name="three"))
    assert solution.structure.mobility == 1
    assert solution.structure.moving_links == 3
    assert solution.links["4"].phi_deg == pytest.approx(solution.links["1"].phi_deg)
    assert "a passive link" in live_page(solution.problem, "en")  # has no sliders of sizes
    assert solution.links["4"].omega == pytest.approx(solution.links["1"].omega)
    with pytest.raises(PlanMethodError, match="passive"):
        planmethod.solve(planmethod.loads(text.format(length=0.21), name="three"))
    heavy = text.format(length=0.2) + "[dynamics.links.4]\nmass = 2\ncentre = 'C'\n"
    with pytest.raises(PlanMethodError, match="link 4 is passive: statics"):
        planmethod.loads(heavy, name="three")


def test_a_geared_five_bar_of_the_bank_is_that_of_newton() -> None:
    """Cranks of 0.4 m, 1.2 m apart, the second three times as fast; rods of 1 m."""
    a, b = 0.4 + 0j, 1.6 + 0j
    c = 1.0 + 0.8j
    model = Model(
        {"0": {"O": 0j, "D": 1.2 + 0j}, "1": {"O": 0j, "A": a}, "2": {"A": a, "C": c},
         "3": {"C": c, "B": b}, "4": {"D": 1.2 + 0j, "B": b}},
        [("O", "1", "0"), ("D", "4", "0"), ("A", "2", "1"), ("B", "3", "4"), ("C", "2", "3")],
        wheels=[Wheels(("1", "4"), ("O", "D"), "0", "external", (0.9, 0.3))],
        rules={"C": "left of AB"}, masses={"2": (1.0, 0.1)}, omega=np.pi, epsilon=0.0,
    )  # fmt: skip
    model.lines = ["[[meshes]]", 'links = ["1", "4"]', 'centres = ["O", "D"]', "z = [60, 20]"]
    (q, rates, again) = model.solve(20.0)
    solution = planmethod.solve(planmethod.loads(model.toml([20.0]), name="bank"))
    k = 3 * model.moving.index("3")
    found = solution.points["C"]
    for own, numbers in ((found.place, q), (found.velocity, rates), (found.acceleration, again)):
        assert own[0] == pytest.approx(complex(numbers[k], numbers[k + 1]), rel=EXACT)
    assert solution.links["4"].omega == pytest.approx(-3 * np.pi)


def test_a_planet_of_half_the_ring_moves_its_rim_along_a_straight_line() -> None:
    """Cardan's wheels: B is x = 2·OA·cos φ on a diameter, exactly."""
    text = """
title = "Cardan"
[frame]
O = [0, 0]
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A", "B"]
AB = 0.1
[[meshes]]
links = ["0", "2"]
centres = ["O", "A"]
kind = "internal"
z = [80, 40]
phi = [0, 0, 0]
[driver]
link = "1"
phi = [0, 20, 75, 200, 400]
omega = 7
"""
    solution = planmethod.solve(planmethod.loads(text, name="cardan"))
    phi = np.radians(solution.positions)
    b = solution.points["B"]
    assert b.place == pytest.approx(0.2 * np.cos(phi), abs=1e-12)
    assert b.velocity == pytest.approx(-0.2 * 7 * np.sin(phi), abs=1e-10)
    assert b.acceleration == pytest.approx(-0.2 * 49 * np.cos(phi), abs=1e-9)


def test_a_mesh_between_both_cranks_of_a_four_bar_is_one_pair_too_many() -> None:
    text = """
    [frame]
    A = [0, 0]
    D = [0.3, 0]
    [links.1]
    points = ["A", "B"]
    AB = 0.1
    [links.2]
    points = ["B", "C"]
    BC = 0.25
    [links.3]
    points = ["D", "C"]
    CD = 0.2
    [driver]
    link = "1"
    phi = 60
    omega = 10
    [assembly]
    C = "above A"
    [[meshes]]
    links = ["1", "3"]
    centres = ["A", "D"]
    kind = "external"
    z = [20, 40]
    module = 10
    phi = [60, 100]
    """
    with pytest.raises(PlanMethodError, match=r"W = 3n - 2p1 - p2 = 3·3 - 2·4 - 1 = 0"):
        planmethod.solve(planmethod.loads(text, name="four-bar"))


@pytest.mark.parametrize("points", ['["C"]', '["C", "E"]\nCE = 0.03'])
def test_a_wheel_that_rolls_needs_no_second_point(points: str) -> None:
    text = f"""
    [frame]
    A = [0, 0]
    guides.rail = {{ through = [0, -0.05], angle = 0 }}
    [links.1]
    points = ["A", "B"]
    AB = 0.05
    [links.2]
    points = ["B", "C"]
    BC = 0.2
    [links.3]
    points = {points}
    rolls = {{ on = "rail", radius = 0.04, centre = "C" }}
    [driver]
    link = "1"
    phi = 50
    omega = 10
    [assembly]
    C = "right of B"
    """
    solution = planmethod.solve(planmethod.loads(text, name="wheel"))
    place, velocity = (getattr(solution.points["C"], key)[0] for key in ("place", "velocity"))
    assert place.imag == pytest.approx(-0.01)
    assert solution.links["3"].omega[0] == pytest.approx(-velocity.real / 0.04, rel=1e-12)


# Through the program ------------------------------------------------------------------------------

FIVE_BAR = """
title = "Geared five-bar"
[frame]
O = [0, 0]
D = [1.2, 0]
[links.1]
points = ["O", "A"]
OA = 0.4
[links.2]
points = ["A", "C"]
AC = 1.0
[links.3]
points = ["C", "B"]
CB = 1.0
[links.4]
points = ["D", "B"]
DB = 0.4
[[meshes]]
links = ["1", "4"]
centres = ["O", "D"]
z = [60, 20]
[driver]
link = "1"
phi = { from = 0, count = 12 }
n = 30
[assembly]
C = "left of AB"
[dynamics]
gravity = 9.81
[dynamics.links.2]
mass = 3
inertia = 0.02
centre = "A"
[[loads]]
name = "M"
link = "3"
couple = 8
against = "rotation"
"""
WHEEL = ROLLING.format(
    frame="guides.rail = {through = [0, -0.1], angle = 0}",
    rolls='on = "rail", radius = 0.04, centre = "C"',
)
WHEEL = WHEEL.replace("epsilon = -2", "").replace("[40, 41, 130, 250, 400]", "[20, 80, 200, 300]")
WHEEL += 'against = "rotation"\n'
RUBBED = "[friction]\nf = 0.1\nf_pin = 0.12\nradius = 0.01\n"


@pytest.mark.parametrize("text", [FIVE_BAR, WHEEL, FIVE_BAR + RUBBED, WHEEL + RUBBED])
def test_every_command_describes_a_machine_with_wheels(text: str, tmp_path: Path) -> None:
    path = tmp_path / "wheels.toml"
    path.write_text(text + '[machine]\ndelta = "1/20"\n', encoding="utf-8")
    for command in ("protocol", "note", "structure", "live"):
        out = ["-o", str(tmp_path)] if command != "protocol" else []
        done = CliRunner().invoke(cli, [command, str(path), "--lang", "en", *out])
        assert done.exit_code == 0, (command, done.output)


@pytest.mark.parametrize("text", [FIVE_BAR, WHEEL])
def test_with_friction_the_driver_also_gives_the_power_of_pins_and_guides(text: str) -> None:
    """Friction takes power only in pairs that slide: none where wheels roll on each other."""
    solution = planmethod.solve(planmethod.loads(text + RUBBED, name="rubbed"))
    friction = friction_of(solution)
    found, more = friction.converged, np.zeros(len(solution.positions))
    contacts = {mesh.carrier for mesh in solution.problem.mechanism.rolling}
    for pair in friction.every:
        size = friction.rub(pair, found)
        stands = {pair.on, pair.by} & contacts and {pair.on, pair.by} & {"0", "3"}
        assert bool(size.any()) == (pair.joint != "W" and not stands), pair.name
        more += size * np.abs(pair.rate)
    assert found.power - friction.without.power == pytest.approx(more, rel=1e-9)


@pytest.mark.parametrize("seed", range(7))
def test_powers_of_a_random_geared_linkage_with_friction_are_balanced(seed: int) -> None:
    """Driver, weights and friction give the rate of the kinetic energy; teeth take nothing."""
    rng = random.Random(f"friction {seed}")
    make, kind = KINDS[seed]
    for _ in range(50):
        model = make(rng, kind)
        masses(rng, model)
        try:
            q, *_ = model.solve(0.0)
        except (ArithmeticError, np.linalg.LinAlgError):
            continue
        if np.linalg.cond(model.jacobian(q)) < 200:
            break
    text = model.toml([0.0]) + "\n[friction]\nf = 0.02\nf_pin = 0.02\nradius = 0.001\n"
    solution = planmethod.solve(planmethod.loads(text, name="rubbed"))
    friction, rate = friction_of(solution), 0.0
    assert not friction.jammed[0]
    taken = sum(
        float(friction.rub(pair, friction.converged)[0] * abs(pair.rate[0]))
        for pair in friction.every
    )
    dynamics = solution.problem.dynamics
    assert dynamics is not None
    for link, mass in dynamics.masses.items():
        motion = solution.links[link]
        rate += mass.inertia * float(motion.omega[0] * motion.epsilon[0])
        if mass.centre is not None:
            point = solution.points[mass.centre]
            v, a = complex(point.velocity[0]), complex(point.acceleration[0])
            rate += mass.mass * ((v.conjugate() * a).real + dynamics.gravity * v.imag)
    assert float(friction.converged.power[0]) == pytest.approx(rate + taken, rel=EXACT)


def test_a_rod_bears_on_a_wheel_that_rolls_as_on_its_axle() -> None:
    """The rod without loads pulls along itself, and the rail bears the wheel's weight."""
    text = WHEEL.replace("[[loads]]", "[[loads]]\nname = 'M3'")
    solution = planmethod.solve(planmethod.loads(text, name="axle"))
    found = {(one.joint, one.on, one.by): one.force for one in statics_of(solution).reactions}
    rod = solution.points["C"].place - solution.points["A"].place
    assert (found["C", "2", "4"] * rod.conjugate()).imag == pytest.approx(0, abs=1e-9)
    pulls = 2 * solution.points["C"].acceleration - found["W", "3", "0"]
    assert (-found["C", "2", "4"]).real == pytest.approx(pulls.real, abs=1e-9)
    weight = found["C", "4", "0"] - found["C", "2", "4"]
    assert weight.imag == pytest.approx(2 * 9.81, rel=1e-9)


def test_a_pair_in_which_wheels_roll_has_no_friction_of_its_own() -> None:
    text = WHEEL + RUBBED + 'pairs."C 4-0" = { f = 0.2 }\n'
    solution = planmethod.solve(planmethod.loads(text, name="rubbed"))
    with pytest.raises(PlanMethodError, match=r"in the pair 'C 4-0' nothing slides\. Pairs with"):
        friction_of(solution)


def test_a_mesh_inside_a_group_is_refused_with_the_links_that_could_drive() -> None:
    text = FIVE_BAR.partition("[dynamics]")[0].replace('link = "1"', 'link = "5"')
    text = text.replace("D = [1.2, 0]", "D = [1.2, 0]\nK = [0.6, 0.9]")
    text += '[links.5]\npoints = ["K", "M"]\nKM = 0.1\n[links.6]\npoints = ["M", "C"]\nMC = 0.5\n'
    with pytest.raises(PlanMethodError, match=r"mesh of links 1 and 4 is inside .* link 1 or 4 dr"):
        planmethod.solve(planmethod.loads(text, name="inside"))


def test_centres_of_wheels_are_their_poles_and_contacts() -> None:
    for text, pair in ((FIVE_BAR, ("1", "4")), (WHEEL, ("0", "3"))):
        solution = planmethod.solve(planmethod.loads(text, name="centres"))
        for index in range(len(solution.positions)):
            centres = solution.instant_centres(index)
            assert centres.of(*pair).pole == "W"
            if solution.positions[index] % 180.0:  # else all joints are on the line of centres
                found = centres.centres.values()
                assert all(one.point or one.pole or one.slide or one.by for one in found)
            for link, motion in centres.motions.items():
                omega = solution.links[link].omega[index]
                assert motion.omega == pytest.approx(omega, rel=EXACT, abs=1e-12)
    assert "4" not in centres.links  # it only replaces the contact
