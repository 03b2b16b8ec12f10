"""Loads at positions: by hand, over positions, and against the worked examples."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from typing import Any

import mechanisms
import numpy as np
import numpy.typing as npt
import pytest
from doors import (
    Applied,
    LoadKind,
    ModelProblem as Problem,
    ProblemError,
    Solution,
    applied,
    problem_loads as loads,
)
from worked import problem_of

CRANK = """
[frame]
A = [0, 0]
guides.x-x = { through = "A", angle = 0 }
[links.1]
points = ["A", "B", "S1"]
AB = 0.1
S1 = { on = "AB", at = 0.04 }
[links.2]
points = ["B", "C", "S2"]
BC = 0.3
S2 = { on = "BC", at = 0.1, across = 0.02 }
[links.3]
points = ["C"]
slides = { on = "x-x" }
[driver]
link = "1"
phi = { from = 0, count = 12 }
omega = 10
[assembly]
C = "right of B"
"""
"""A slider-crank mechanism at constant speed; it can turn fully."""

SLIDER = mechanisms.SLIDER.replace("s = [0.3, 0.35]", "s = [0.3, 0.33, 0.36]")

Numbers = npt.NDArray[Any]


def read(text: str, base: str = CRANK) -> Problem:
    return loads(base + text, name="v")


def by_name(problem: Problem, positions: Sequence[float] | None = None) -> dict[str, Applied]:
    found = applied(Solution(problem, positions=positions))
    assert len({load.name for load in found}) == len(found)
    return {load.name: load for load in found}


def one(text: str, positions: Sequence[float] | None = None, base: str = CRANK) -> Applied:
    (load,) = applied(Solution(read("[[loads]]\n" + text, base), positions=positions))
    assert load.kind is LoadKind.EXTERNAL
    return load


def sizes(size: str, positions: Sequence[float] | None = None, base: str = CRANK) -> list[float]:
    """Values of a couple on the crank."""
    return list(one(f'link = "1"\ncouple = {size}\n', positions, base).couple)


def up(rest: str, positions: Sequence[float] | None = None, at: str = "C") -> list[complex]:
    """Return values of a force on the connecting rod, upwards by default."""
    direction = "" if "against" in rest else "angle = 90\n"
    return list(one(f'link = "2"\nat = "{at}"\n{direction}{rest}', positions).force)


def same(
    got: Sequence[complex] | Numbers, wanted: Sequence[complex] | Numbers, size: float = 1.0
) -> bool:
    return np.allclose(got, wanted, rtol=0, atol=1e-12 * size)


# Weight and inertia ------------------------------------------------------------------------------

MASSES = """
[dynamics.links.1]
mass = 2
centre = "S1"
inertia = 0.5
[dynamics.links.2]
mass = 3
centre = "S2"
inertia = 0.1
[dynamics.links.3]
mass = 4
inertia = 7
"""


def test_no_load_acts_in_a_file_without_masses_and_loads() -> None:
    assert applied(Solution(read(""))) == ()
    assert applied(Solution(read("[dynamics]\n"))) == ()


def test_the_crank_at_constant_speed_by_hand() -> None:
    found = by_name(read(MASSES))
    phi = np.radians(np.arange(12) * 30.0)
    outwards = 2 * 10**2 * 0.04 * np.exp(1j * phi)
    inertia = found["Φ_{1}"]
    assert same(inertia.force, outwards, 10)
    assert (inertia.link, inertia.point, inertia.kind) == ("1", "S1", LoadKind.INERTIA)
    assert not inertia.couple.any()
    weight = found["G_{1}"]
    assert list(weight.force) == [-2 * 9.81j] * 12
    assert (weight.point, weight.kind) == ("S1", LoadKind.WEIGHT)


def test_the_slider_by_hand() -> None:
    found = by_name(read(MASSES))
    phi = np.radians(np.arange(12) * 30.0)
    # x = r cos phi + sqrt(rod² - r² sin² phi), differentiated twice
    r, rod, w = 0.1, 0.3, 10.0
    root = np.sqrt(rod**2 - (r * np.sin(phi)) ** 2)
    bend = np.cos(2 * phi) / root + (r * np.sin(2 * phi) / 2) ** 2 / root**3
    a = -r * w**2 * np.cos(phi) - (r * w) ** 2 * bend
    assert same(found["Φ_{3}"].force, -4 * a, 40)
    assert found["Φ_{3}"].point == "C"


def test_the_couple_of_the_connecting_rod_by_hand() -> None:
    found = by_name(read(MASSES))
    phi = np.radians(np.arange(12) * 30.0)
    r, rod, w = 0.1, 0.3, 10.0
    # sin psi = -r/rod sin phi, differentiated twice
    cos = np.sqrt(1 - (r / rod * np.sin(phi)) ** 2)
    turn = -r / rod * np.cos(phi) * w / cos
    epsilon = (r / rod * np.sin(phi) * w**2 - r / rod * np.sin(phi) * turn**2) / cos
    couple = found["M_{Φ2}"]
    assert same(couple.couple, -0.1 * epsilon, 4)
    assert (couple.point, couple.kind) == (None, LoadKind.INERTIA_COUPLE)
    assert not couple.force.any()


def test_loads_that_are_zero_by_nature_are_left_out() -> None:
    # the crank turns evenly, the slider does not turn
    names = ["G_{1}", "Φ_{1}", "G_{2}", "Φ_{2}", "M_{Φ2}", "G_{3}", "Φ_{3}"]
    assert list(by_name(read(MASSES))) == names
    faster = CRANK.replace("omega = 10", "omega = 10\nepsilon = 5")
    more = by_name(read(MASSES, faster))
    assert list(more) == [*names[:2], "M_{Φ1}", *names[2:]]
    assert list(more["M_{Φ1}"].couple) == [-2.5] * 12
    still = CRANK.replace("omega = 10", "omega = 0")
    assert list(by_name(read(MASSES, still))) == ["G_{1}", "G_{2}", "G_{3}"]


def test_a_centre_of_mass_on_the_axis_has_weight_and_no_inertia() -> None:
    text = '[dynamics.links.1]\nmass = 60\ncentre = "A"\n'
    assert list(by_name(read(text))) == ["G_{1}"]


@pytest.mark.parametrize("off", ["0", "false"])
def test_no_weights_without_gravity(off: str) -> None:
    found = by_name(read(f"[dynamics]\ngravity = {off}\n" + MASSES))
    assert list(found) == ["Φ_{1}", "Φ_{2}", "M_{Φ2}", "Φ_{3}"]


def test_a_moment_of_inertia_alone() -> None:
    text = "[dynamics.links.2]\ninertia = 5\n"
    assert list(by_name(read(text))) == ["M_{Φ2}"]


def test_a_driving_slider_at_constant_speed_has_no_inertia() -> None:
    text = "[dynamics.links.3]\nmass = 4\n"
    assert list(by_name(read(text, SLIDER))) == ["G_{3}"]
    faster = SLIDER.replace("v = 1", "v = 1\na = 2")
    assert list(by_name(read(text, faster))["Φ_{3}"].force) == [-8] * 3


# External loads ----------------------------------------------------------------------------------


def test_a_force_of_fixed_direction() -> None:
    load = one('link = "2"\nat = "S2"\nforce = 100\nangle = 150\n')
    assert (load.name, load.link, load.point) == ("F_{2}", "2", "S2")
    assert same(load.force, [cmath.rect(100, math.radians(150))] * 12, 100)
    assert load.force.dtype == complex
    assert load.couple.shape == (12,)
    assert up("force = -5") == [-5j] * 12


def test_a_couple() -> None:
    load = one('name = "M_{c}"\nlink = "2"\ncouple = -20\n')
    assert (load.name, load.point) == ("M_{c}", None)
    assert list(load.couple) == [-20] * 12
    assert not load.force.any()


def test_a_resistance_is_zero_where_its_point_is_at_rest() -> None:
    # C is at rest at 0 and 180 degrees; it moves left between them and right after
    assert up('force = 100\nagainst = "velocity"') == [0, *[100] * 5, 0, *[-100] * 5]
    assert up('force = -100\nagainst = "velocity"') == [0, *[-100] * 5, 0, *[100] * 5]


def test_rounding_does_not_set_a_resistance_going() -> None:
    # dead positions on a slanting guide, where the velocity is a small number and not zero
    slanting = CRANK.replace("angle = 0 }", "angle = 37 }").replace('"right of B"', '"above B"')
    problem = read('[[loads]]\nlink = "3"\nat = "C"\nforce = 1\nagainst = "velocity"\n', slanting)
    solution = Solution(problem, positions=[37.0, 217.0, 37.001])
    noise = np.abs(solution.points["C"].velocity)
    assert 0 < noise[:2].max() < 1e-14
    (load,) = applied(solution)
    assert same(np.abs(load.force), [0, 0, 1])


def test_a_resistance_is_opposite_to_any_velocity() -> None:
    forces = up('force = 100\nagainst = "velocity"', at="S2")
    velocity = Solution(read("")).points["S2"].velocity
    assert same(np.array(forces) / -100, velocity / np.abs(velocity))


def test_a_couple_against_the_rotation() -> None:
    # the connecting rod turns clockwise while the pin moves right
    text = 'link = "2"\ncouple = 7\nagainst = "rotation"\n'
    signs = [1, 1, 1, 0, -1, -1, -1, -1, -1, 0, 1, 1]
    assert list(one(text).couple) == [7 * sign for sign in signs]
    backwards = CRANK.replace("omega = 10", "omega = -10")
    assert list(one(text, base=backwards).couple) == [-7 * sign for sign in signs]


def test_loads_that_can_never_act_are_left_out() -> None:
    text = '[[loads]]\nlink = "3"\ncouple = 7\nagainst = "rotation"\n'
    text += '[[loads]]\nlink = "3"\nat = "C"\nforce = 0\nangle = 7\n'
    assert applied(Solution(read(text))) == ()
    still = '[[loads]]\nlink = "3"\nat = "C"\nforce = 9\nagainst = "velocity"\n'
    assert applied(Solution(read(still, CRANK.replace("omega = 10", "omega = 0")))) == ()


def test_loads_come_link_by_link() -> None:
    text = '[[loads]]\nname = "P"\nlink = "3"\nat = "C"\nforce = 1\nangle = 0\n'
    text += '[[loads]]\nname = "M"\nlink = "1"\ncouple = 1\n'
    names = [load.name for load in applied(Solution(read(MASSES + text)))]
    assert names == ["G_{1}", "Φ_{1}", "M", "G_{2}", "Φ_{2}", "M_{Φ2}", "G_{3}", "Φ_{3}", "P"]


# Tables ------------------------------------------------------------------------------------------


def table(over: str, values: str, interpolation: str = "linear") -> str:
    return f'{{ over = "{over}", values = {values}, interpolation = "{interpolation}" }}'


TURNS = [-360.0, -30.0, 0.0, 45.0, 90.0, 180.0, 315.0, 360.0, 405.0, 765.0]


def test_a_table_over_a_whole_turn() -> None:
    size = table("phi", "[[0, 0], [90, 90], [360, 0]]")
    assert same(sizes(size, TURNS), [0, 10, 0, 45, 90, 60, 15, 0, 45, 45], 100)


def test_a_table_is_read_through_the_end_of_a_turn() -> None:
    size = table("phi", "[[90, 10], [270, 100]]")
    # between 270 and 450 degrees it goes from 100 to 10
    assert same(sizes(size, TURNS), [55, 70, 55, 32.5, 10, 55, 77.5, 55, 32.5, 32.5], 100)


def test_a_table_may_begin_anywhere() -> None:
    one_way = table("phi", "[[90, 10], [270, 100]]")
    other = table("phi", "[[-90, 100], [90, 10]]")
    assert same(sizes(one_way, TURNS), sizes(other, TURNS), 100)


def test_a_step_holds_until_the_next_row() -> None:
    size = table("phi", "[[90, 1], [180, 2], [300, 3]]", "step")
    asked = [0.0, 89.0, 90.0, 179.0, 180.0, 299.0, 300.0, 359.0, 360.0, 450.0, -60.0, -61.0]
    assert sizes(size, asked) == [3, 3, 1, 1, 2, 2, 3, 3, 3, 1, 3, 2]
    closed = table("phi", "[[0, 1], [180, 2], [360, 1]]", "step")
    assert sizes(closed, [0.0, 179.0, 180.0, 359.9, 360.0]) == [1, 1, 2, 2, 1]


def test_rounding_does_not_miss_a_step() -> None:
    size = table("phi", "[[98.918918918919, 1], [128.918918918919, 2]]", "step")
    asked = [98.918918918919 + 30 * k / 3 for k in range(0, 40, 3)]
    assert asked[12] % 360 != 98.918918918919
    assert sizes(size, [98.918918918919 - 1e-13, 128.918918918919 - 1e-13]) == [1, 2]
    assert sizes(size, asked) == [1, *[2] * 11, 1, 2]


def test_a_table_over_the_way_of_a_driving_slider() -> None:
    size = table("s", "[[0.31, 10], [0.35, 50]]")
    assert same(sizes(size, base=SLIDER), [10, 30, 50], 100)
    stepped = table("s", "[[0.3, 1], [0.33, 2], [0.4, 3]]", "step")
    assert sizes(stepped, [0.2, 0.3, 0.32, 0.33, 0.36], SLIDER) == [1, 1, 1, 2, 2]


def test_a_table_over_a_coordinate_of_the_point() -> None:
    # S1 goes round a circle of 0.04 m
    text = 'link = "1"\nat = "S1"\nangle = 0\nforce = '
    x = one(text + table("x", "[[-0.04, 0], [0.04, 80]]"))
    y = one(text + table("y", "[[-0.02, 1], [0.02, 5]]"))
    phi = np.radians(np.arange(12) * 30.0)
    assert same(x.force, 40 + 40 * np.cos(phi), 100)
    assert same(y.force, np.clip(3 + 4 * np.sin(phi), 1, 5), 10)


def test_values_for_the_positions_of_the_file() -> None:
    values = list(range(100, 112))
    size = f'{{ over = "position", values = {values} }}'
    assert sizes(size) == values
    assert sizes(size, [90.0, 0.0, 330.0, 90.0]) == [103, 100, 111, 103]
    assert sizes(size, [30 + 1e-12]) == [101]


def test_positions_in_any_order_and_more_than_once() -> None:
    mixed = CRANK.replace("{ from = 0, count = 12 }", "[90, 0, 30, 0]")
    size = '{ over = "position", values = [1, 2, 3, 4] }'
    assert sizes(size, base=mixed) == [1, 2, 3, 4]
    assert sizes(size, [0.0, 30.0, 90.0], mixed) == [2, 3, 1]


def test_values_for_positions_are_not_known_elsewhere() -> None:
    size = f'{{ over = "position", values = {list(range(12))} }}'
    with pytest.raises(ProblemError) as caught:
        sizes(size, [30.0, 45.0])
    assert str(caught.value) == (
        "v: 1 fault in the problem file\n  "
        "loads[0].couple.values: given for the positions of the file, and phi = 45 deg is "
        "not one of them. Give the table over phi, s, x or y, or request the file's own "
        "positions."
    )


# Phases ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("phase", "wanted"),
    [
        ("phi = [90, 270]", range(3, 10)),
        ("phi = [270, 90]", [0, 1, 2, 3, 9, 10, 11]),
        ("phi = [-90, 90]", [0, 1, 2, 3, 9, 10, 11]),
        ("phi = [300, 30]", [0, 1, 10, 11]),
        ("phi = [91, 89]", [0, 1, 2, *range(4, 12)]),
        ("phi = [0, 360]", range(12)),
        ("phi = [[30, 60], [350, 10], [119, 121]]", [0, 1, 2, 4]),
        ('moving = "left"', range(1, 6)),
        ('moving = "right"', range(7, 12)),
        ('moving = "up"', []),
        ('turning = "ccw"', range(4, 9)),
        ('turning = "cw"', [0, 1, 2, 10, 11]),
        ('moving = "left", phi = [60, 300]', range(2, 6)),
    ],
)
def test_a_load_acts_in_its_phases_only(phase: str, wanted: Sequence[int]) -> None:
    acts = np.array(up(f"force = 1\nphases = {{ {phase} }}")) == 1j
    assert list(np.flatnonzero(acts)) == list(wanted)


def test_phases_do_not_depend_on_the_turn() -> None:
    text = 'link = "1"\ncouple = 1\nphases = { phi = [300, 30] }\n'
    asked = [-60.0, -61.0, 30.0, 31.0, 300.0, 390.0, 391.0, 660.0]
    assert list(one(text, asked).couple) == [1, 0, 1, 0, 1, 1, 0, 1]


def test_up_and_down() -> None:
    acts = up('force = 1\nphases = { moving = "up" }', at="B")
    assert [z == 1j for z in acts] == [True] * 3 + [False] * 7 + [True] * 2


def test_a_table_and_a_phase() -> None:
    size = table("phi", "[[0, 0], [180, 180], [360, 0]]")
    found = up(f"force = {size}\nphases = {{ phi = [90, 180] }}")
    assert same(found, [0, 0, 0, 90j, 120j, 150j, 180j, 0, 0, 0, 0, 0], 100)


# Many positions ----------------------------------------------------------------------------------

EVERYTHING = (
    MASSES
    + f"""
[[loads]]
link = "2"
at = "S2"
force = {table("phi", "[[20, 5], [200, -7]]")}
against = "velocity"
[[loads]]
link = "3"
at = "C"
force = {table("x", "[[0.2, 5], [0.3, -7]]", "step")}
angle = 33
phases = {{ moving = "left" }}
[[loads]]
link = "2"
couple = {table("phi", "[[20, 5], [200, -7]]", "step")}
against = "rotation"
phases = {{ phi = [200, 100], turning = "cw" }}
[[loads]]
link = "1"
couple = {{ over = "position", values = {list(range(12))} }}
"""
)


def test_all_positions_at_once_are_the_same_as_one_by_one() -> None:
    problem = read(EVERYTHING)
    whole = applied(Solution(problem))
    assert len(whole) == 11
    for i, phi in enumerate(problem.drive.positions):
        alone = applied(Solution(problem, positions=[phi]))
        assert [load.name for load in alone] == [load.name for load in whole]
        for one_load, load in zip(alone, whole, strict=True):
            assert abs(one_load.force[0] - load.force[i]) <= 1e-13 * abs(load.force[i])
            assert abs(one_load.couple[0] - load.couple[i]) <= 1e-13 * abs(load.couple[i])


@pytest.mark.parametrize("name", ["levers/six-link", "levers/task12", "press/press"])
def test_shapes_and_kinds_of_the_worked_files(name: str) -> None:
    problem = problem_of(name)
    phi = problem.drive.positions[0]
    for load in applied(Solution(problem, positions=[phi, phi + 1.0, phi])):
        assert load.force.shape == load.couple.shape == (3,)
        assert (load.point is None) == (load.force == 0).all()
        assert np.isfinite(load.force).all()
        assert load.force[0] == load.force[2]


# The worked examples -----------------------------------------------------------------------------

EXACT: dict[str, dict[str, complex]] = {
    "levers/six-link": {
        "G_{1}": 588.6,
        "M_{Φ1}": 400.0,
        "G_{2}": 392.4,
        "Φ_{2}": 2743.86748968485,
        "M_{Φ2}": 250.264715233731,
        "G_{3}": 686.7,
        "M_{Φ3}": 243.644840483902,
        "G_{5}": 490.5,
        "Φ_{5}": 2503.66634534899,
        "F_{5C}": 6000.0,
    },
    "levers/task12": {
        "G_{1}": 19.6,
        "M_{Φ1}": 1.4,
        "G_{3}": 49.0,
        "Φ_{3}": 20.5298778913405,
        "M_{Φ3}": 12.2047513025186,
        "G_{5}": 294.0,
        "Φ_{5}": 302.729939214117,
        "F_{5}": 2000.0,
    },
    "press/press": {
        "G_{1}": 29.43,
        "G_{3}": 147.15,
        "Φ_{3}": 280.790740377536,
        "M_{Φ3}": 46.5746849180708,
        "G_{5}": 58.86,
        "Φ_{5}": 84.0091631790061,
        "P": 350.4,
    },
}
"""Magnitudes, N and N·m, computed apart from the plans with 50 digits."""


@pytest.mark.parametrize("name", EXACT)
def test_the_worked_examples(name: str) -> None:
    found = by_name(problem_of(name))
    # the source leaves the inertia of the press's crank out: it acts through the pivot
    assert [letter for letter in found if (name, letter) != ("press/press", "Φ_{1}")] == list(
        EXACT[name]
    )
    for letter, exact in EXACT[name].items():
        load = found[letter]
        size = max(abs(load.force[0]), abs(load.couple[0]))
        assert size == pytest.approx(abs(exact), rel=1e-9), letter


def test_senses_in_the_six_link() -> None:
    found = by_name(problem_of("levers/six-link"))
    # the crank slows down: epsilon is counter-clockwise, the couple clockwise
    assert found["M_{Φ1}"].couple[0] == -400
    assert found["M_{Φ2}"].couple[0] < 0 < found["M_{Φ3}"].couple[0]
    assert found["Φ_{5}"].force[0].imag > 0
    assert found["F_{5C}"].force[0] == -6000j


def test_the_resistance_of_the_press_in_twelve_positions() -> None:
    problem = problem_of("press/press")
    phi = [98.918918918919 + 30.0 * k for k in range(12)]
    solution = Solution(problem, positions=phi)
    force = {load.name: load for load in applied(solution)}["P"].force
    assert same(force, [0, 0, 0, 730j, 350.4j, *[0] * 7], 1000)
    down = solution.points["B"].velocity.imag < 0
    assert down[force != 0].all()
