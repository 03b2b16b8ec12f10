"""The turn of a crank: extremes, range, phases and diagrams against closed forms."""

from __future__ import annotations

import re
from math import acos, asin, cos, degrees, hypot, pi, radians, tan
from typing import Any

import numpy as np
import pytest
from cases import each
from doors import (
    CONSTRUCTION_PRIMES as PRIMES,
    DRAFTING_PROFILES as PROFILES,
    CrankCycle,
    Differentiation,
    Flywheel,
    LayoutError,
    PointName,
    PositionError,
    ProblemError,
    Sampled,
    Solution,
    analogue_records,
    counting,
    crank_cycle_of,
    cycle_record,
    diagrams_of,
    evaluate_evaluate as evaluate,
    extreme_construction,
    number,
    numbered_positions,
    problem_load as load,
    problem_loads as loads,
    sigmas,
    smooth,
    verify,
)
from msgspec.structs import replace
from worked import ROOT

PRESS = (ROOT / "problems/press/press-stone.toml").read_text("utf-8")
FOUR_BAR = """title = "Шарнирный четырёхзвенник"
[frame]
A = [0, 0]
D = [{d}, 0]
[links.1]
points = ["A", "B"]
AB = {a}
[links.2]
points = ["B", "C"]
BC = {b}
[links.3]
points = ["C", "D"]
CD = {c}
[driver]
link = "1"
phi = 40
omega = {omega}
[assembly]
C = "{rule}"
[cycle]
{asked}
"""


def four_bar(
    *sides: float, omega: float = 10, rule: str = "above D", asked: str = ""
) -> dict[str, Any]:
    a, b, c, d = sides
    text = FOUR_BAR.format(a=a, b=b, c=c, d=d, omega=omega, rule=rule, asked=asked)
    return cycle_record(Solution(loads(text, name="four-bar")))


def test_the_press_has_the_extremes_of_its_slotted_link() -> None:
    told = cycle_record(Solution(loads(PRESS + "\n[cycle]\noutput = 'B'\n", name="press")))
    theta = 180.0 * 0.22 / 2.22
    assert told["zero_deg"] == pytest.approx(90 + theta / 2, abs=1e-11)
    assert told["K_v"] == pytest.approx(1.22, abs=1e-12)
    assert told["working_deg"] == pytest.approx(180 - theta, abs=1e-11)
    assert told["stroke"] == pytest.approx(0.96 * tan(radians(theta / 2)), abs=1e-14)
    assert told["pressure_angle"]["max_deg"] == pytest.approx(theta / 2, abs=1e-11)
    assert told["range_deg"] is None and "reasons" not in told


def test_the_scale_of_the_crank_angle_is_inscribed_in_degrees() -> None:
    text = PRESS + "\n[cycle]\nzero = 'extreme'\n"
    diagrams = diagrams_of(Solution(loads(text, name="press")))
    (scale,) = (one for one in diagrams.scales if one.symbol == "mu_φ")
    assert scale.unit == "deg"
    assert scale.per_mm == pytest.approx(degrees(diagrams.mu_phi), rel=1e-3)


def test_the_diagrams_of_the_press_are_those_of_their_definitions() -> None:
    told = cycle_record(Solution(loads(PRESS + "\n[cycle]\nzero = 'extreme'\n", name="press")))
    diagrams = told["diagrams"]
    r, base = 0.1674395276373337, 1.08

    def height(phi: Any) -> Any:
        place = base + r * np.exp(1j * phi)
        return 0.48 * place.imag / place.real

    phi = np.radians(told["zero_deg"]) + np.arange(13) * pi / 6
    mu = diagrams["mu_s"]
    s = (height(phi[0]) - height(phi)) / mu
    assert diagrams["s_mm"] == pytest.approx(s.tolist(), abs=1e-9)
    assert diagrams["length_mm"] == 180.0  # two degrees a millimetre
    one, two = diagrams["poles_mm"]
    chords = one / 15.0 * np.diff(s)
    assert diagrams["v_chord_mm"] == pytest.approx(chords.tolist(), abs=1e-9)
    second = two / 15.0 * (chords - np.roll(chords, 1))
    assert diagrams["a_chord_mm"] == pytest.approx(second.tolist(), abs=1e-9)
    h, fine = 1e-4, (height(phi + 1e-4) - height(phi - 1e-4)) / 2e-4
    v = -fine * (2 * pi / 180) * one / mu
    assert diagrams["v_exact_mm"] == pytest.approx(v.tolist(), abs=1e-5)
    bend = -(height(phi + h) - 2 * height(phi) + height(phi - h)) / h**2
    assert diagrams["a_exact_mm"] == pytest.approx(
        (bend * (2 * pi / 180) ** 2 * one * two / mu).tolist(), abs=1e-4
    )
    assert diagrams["v_curve_mm"] == pytest.approx(
        smooth(chords, np.arange(-0.5, 11.0)).tolist(), abs=1e-9
    )
    assert diagrams["mu_v"] == pytest.approx(mu * 13.6135681655558 / (2 * pi / 180 * one))
    assert (mu, diagrams["mu_v"], diagrams["mu_a"]) == (0.002, 0.04, 0.4)


def test_the_errors_of_the_diagrams_are_found_once_for_all_trial_scales() -> None:
    solution = Solution(loads(PRESS, name="press"))
    coarser = {kind: replace(mu, per_mm=2 * mu.per_mm) for kind, mu in solution.scales.items()}
    found = [
        sigmas(diagrams_of(one), Differentiation.CHORDS)
        for one in (solution, solution.drawn_at(coarser))
    ]
    assert found[0] is found[1]


def test_a_smooth_curve_goes_through_its_values_and_has_no_corner() -> None:
    values = np.array([3.0, -1.0, 4.0, 1.0, -5.0, 9.0, 2.0])
    at = np.arange(7.0)
    assert smooth(values, at) == pytest.approx(values)
    h = 1e-4
    before, after = smooth(values, at - h), smooth(values, at + h)
    further = smooth(values, at - 2 * h) - smooth(values, at + 2 * h) - 2 * (before - after)
    assert after - values == pytest.approx(values - before, abs=1e-5)
    assert np.abs(further).max() < 1e-9  # neither does its second derivative jump
    assert smooth(values, at - 14.3) == pytest.approx(smooth(values, at - 0.3))
    open_end = smooth(np.append(at**2, np.nan), np.array([-0.5, 0.5, 3.0, 6.0, 6.5, 7.0]))
    assert np.isnan(open_end).tolist() == [True, False, False, False, True, True]
    # Through three values, the natural curve's bend in the middle is 3/2 of the second difference.
    assert smooth(np.array([0, 0, 1, np.nan]), np.array([0.5]))[0] == pytest.approx(-1.5 / 16)


@pytest.mark.parametrize("omega", [10, -10])
def test_a_crank_rocker_turns_back_where_crank_and_coupler_are_in_line(omega: float) -> None:
    a, b, c, d = 0.1, 0.3, 0.25, 0.35
    told = four_bar(a, b, c, d, omega=omega)
    far = degrees(acos(((b + a) ** 2 + d**2 - c**2) / (2 * (b + a) * d)))
    near = degrees(acos(((b - a) ** 2 + d**2 - c**2) / (2 * (b - a) * d))) + 180
    found = sorted(one["phi_deg"] % 360 for one in told["extremes"])
    assert found == pytest.approx([far, near], abs=1e-10)
    swing = acos((c**2 + d**2 - (b + a) ** 2) / (2 * c * d)) - acos(
        (c**2 + d**2 - (b - a) ** 2) / (2 * c * d)
    )
    assert told["stroke"] == pytest.approx(degrees(swing), abs=1e-10)
    working = (near - far) % 360
    assert told["K_v"] == pytest.approx(max(working, 360 - working) / min(working, 360 - working))
    assert told["idle_deg"] < 180 and told["diagrams"]["s_mm"][1] > 0
    assert told["by"] == "longer stroke"
    sense = 1 if omega > 0 else -1
    assert told["extremes"][1]["phi_deg"] == pytest.approx(
        told["zero_deg"] + sense * told["idle_deg"], abs=1e-9
    )
    transmission = degrees(acos((b**2 + c**2 - (d - a) ** 2) / (2 * b * c)))
    assert told["pressure_angle"]["max_deg"] == pytest.approx(90 - transmission, abs=1e-9)
    assert told["pressure_angle"]["phi_deg"] % 360 == pytest.approx(0, abs=1e-6)


def test_the_range_of_a_crank_that_does_not_turn_fully_ends_where_the_dyad_is_straight() -> None:
    a, b, c, d = 0.1, 0.2, 0.15, 0.31
    told = four_bar(a, b, c, d)
    end = degrees(acos((a**2 + d**2 - (b + c) ** 2) / (2 * a * d)))
    assert told["range_deg"] == pytest.approx([-end, end], abs=1e-10)
    assert told["K_v"] is None and told["reasons"]["K_v"] == "the crank does not turn fully"

    def angle(phi: Any) -> Any:  # of CD, from the triangle BCD
        span = np.exp(1j * np.radians(phi)) * a - d
        inner = np.arccos((c**2 + np.abs(span) ** 2 - b**2) / (2 * c * np.abs(span)))
        return np.angle(span) - inner

    phi = np.array(told["positions_deg"])
    assert phi == pytest.approx(-end + 2 * end * (np.arange(12) + 0.5) / 12, abs=1e-9)
    made, zero = told["diagrams"], told["zero_deg"]
    way = (angle(phi) - angle(zero)) * np.sign(angle(zero + 1) - angle(zero))
    way = np.angle(np.exp(1j * way)) / made["mu_s"]
    assert made["s_mm"][:-1] == pytest.approx(way.tolist(), abs=1e-9)
    (one, two), step = made["poles_mm"], made["length_mm"] / 12
    chords = one / step * np.diff(way)
    assert made["v_chord_mm"][:-1] == pytest.approx(chords.tolist(), abs=1e-9)
    assert made["a_chord_mm"][1:-1] == pytest.approx(
        (two / step * np.diff(chords)).tolist(), abs=1e-9
    )
    beyond = [made["s_mm"][-1], made["v_chord_mm"][-1], made["a_chord_mm"][0]]
    assert beyond == [made["a_chord_mm"][-1], made["v_curve_mm"][0], None]
    assert made["mu_phi"] * made["length_mm"] == pytest.approx(np.radians(2 * end))
    assert told["zero_deg"] == told["extremes"][0]["phi_deg"] and len(told["hodograph"]["C"]) == 12
    # A position out of the range cannot be the start of counting.
    other = four_bar(a, b, c, d, asked="zero = 180")
    assert other["zero_deg"] == phi[0] and "zero_deg" in other["reasons"]
    assert four_bar(a, b, c, d, asked="zero = 380")["zero_deg"] == 20


def test_a_link_that_turns_all_round_goes_on_beyond_a_turn() -> None:
    told = four_bar(0.3, 0.25, 0.28, 0.1, rule="left of BD", asked='output = "3"\nzero = 40')
    assert told["extremes"] == [] and told["stroke"] is None and told["zero_deg"] == 40
    diagrams = told["diagrams"]
    assert diagrams["s_mm"][-1] * diagrams["mu_s"] == pytest.approx(2 * pi)
    assert np.diff(diagrams["s_mm"]).min() > 0
    assert sum(diagrams["a_chord_mm"]) == pytest.approx(0, abs=1e-9)


def test_a_slider_above_its_crank_reaches_an_end_twice() -> None:
    text = PRESS.split("[dynamics]")[0].replace(
        "guides.y-y = { through = [0.48, 0.0], angle = 90 }",
        'guides.y-y = { through = "O3", angle = 0 }',
    )
    text = text.replace(
        'points = ["O3", "S3"]', 'points = ["O3", "S3", "N"]\nN = { on = "O3S3", at = 0.5 }'
    )
    head, tail = text.split("[links.4]")[0], text[text.index("[driver]") :]
    text = (
        head + '[links.4]\npoints = ["N", "B"]\nNB = 0.2\n[links.5]\npoints = ["B"]\n'
        'slides = { on = "y-y" }\n'
        + tail.split("[assembly]")[0]
        + '[assembly]\nB = "right of N"\n[cycle]\nzero = 0\n'
    )
    told = cycle_record(Solution(loads(text, name="press")))
    assert len(told["extremes"]) == 4 and told["K_v"] is None
    half = asin(0.1674395276373337 / 1.08)
    least = 0.5 * cos(half) + np.sqrt(0.04 - (0.5 * np.sin(half)) ** 2)
    assert told["stroke"] == pytest.approx(0.7 - least, abs=1e-12)


def test_the_transfer_functions_of_the_analytic_example_are_those_printed() -> None:
    path = ROOT / "problems/levers/task12.toml"
    problem = load(path)
    (found,) = analogue_records(Solution(problem)).to_list()
    d, s3, third = found["D"], found["S3"], found["3"]
    published = {one.name: one.value for one in problem.published}
    numbers = {"ω_q3": third["1"], "ε_q3": third["2"]}
    for letter, key in (("v", "1"), ("a", "2")):
        for name, point in (("D", d), ("S3", s3)):
            for axis in "xy":
                numbers[f"{letter}_q{name}{axis}"] = point[axis + key]
    assert len(numbers) == 10
    for name, value in numbers.items():
        assert value == pytest.approx(published[f"ЭВМ: {name}"], abs=5.1e-6)
    told = cycle_record(Solution(loads(path.read_text("utf-8") + "\n[cycle]\n", name="task12")))
    assert told["zero_deg"] == pytest.approx(270, abs=1e-10)
    assert told["extremes"][1]["phi_deg"] == pytest.approx(
        360 + degrees(2 * asin(1 / hypot(5, 1))), abs=1e-10
    )
    assert told["K_v"] == pytest.approx((180 + 67.3801350519596) / (180 - 67.3801350519596))


CONSTRUCTED = {
    "guide": """frame = { O = [0, 0], guides.g = { through = [0.01, 0.02], angle = 30 } }
driver = { link = "1", phi = 40, omega = -10 }
links.1 = { points = ["O", "A"], OA = 0.1 }
links.2 = { points = ["A", "B"], AB = 0.35 }
links.3 = { points = ["B"], slides = { on = "g", offset = 0.03 } }
assembly = { B = "right of A" }
""",
    "circle": FOUR_BAR.format(
        a=0.1, b=0.3, c=0.25, d=0.35, omega=-10, rule="above D", asked='zero = "other extreme"'
    ),
    "tangents": PRESS,
}


@pytest.mark.parametrize("locus", CONSTRUCTED)
def test_extremes_are_constructed_where_the_roots_are(locus: str) -> None:
    solution = Solution(loads(CONSTRUCTED[locus], name=locus))
    made, turn = extreme_construction(solution), crank_cycle_of(solution)
    assert made is not None and made.locus.value == locus
    for k, phi in enumerate(made.phi):
        name = f"{made.pivot}{made.pin}{PRIMES[k]}"
        assert (made.angle(made.exact, name) - phi + 180) % 360 == pytest.approx(180, abs=1e-9)
        assert 0 < abs(made.off(k)) < 1.5  # of a millimetre at the end of the crank
    if locus != "tangents":  # of the press the slotted link swings, the output slides
        assert made.stroke(made.exact) == pytest.approx(turn.stroke, rel=1e-12)
    # One sigma, found from many drawings.
    pencil = Sampled(PROFILES["board"], frozenset(), 2000, 5)
    trace = evaluate(made.program, made.data, pencil)
    for k, sigma in enumerate(made.sigma[:2]):
        ends = (PointName(f"{made.pin}{PRIMES[k]}"), PointName(made.pivot))
        pin, pivot = (trace.value[end] for end in ends)
        turned = np.degrees(np.angle((pin - pivot) * np.exp(-1j * np.radians(made.phi[k]))))
        assert sigma == pytest.approx(np.std(turned), rel=0.1)
    told = cycle_record(solution)["extremes"]
    assert all({"read_deg", "sigma_deg"} <= one.keys() for one in told)


def test_where_no_arcs_find_the_extremes_there_is_no_construction() -> None:
    solution = Solution(load(ROOT / "problems/levers/six-link.toml"))
    assert extreme_construction(solution) is None
    assert all(one.keys() == {"phi_deg", "value"} for one in cycle_record(solution)["extremes"])


# A cycle of two turns ----------------------------------------------------------------------------

SQUARE = """
frame = { O = [0, 0], guides.x-x = { through = "O", angle = 0 } }
driver = { link = "1", phi = PHI, omega = OMEGA }
assembly = { B = { rule = "right of A", keep = "continuous" } }
[links.1]
points = ["O", "A"]
OA = 0.06
[links.2]
points = ["A", "B"]
AB = 0.1
[links.3]
points = ["B"]
slides = { on = "x-x", offset = 0.04 }
"""
"""A slider-crank whose rod is square to the guide at 270 degrees, and passes on."""


def square(phi: float = 0.0, omega: float = 10.0) -> CrankCycle:
    text = SQUARE.replace("PHI", str(phi)).replace("OMEGA", str(omega))
    return crank_cycle_of(Solution(loads(text, name="square")))


@each("omega", [10.0, -10.0])
def test_a_cycle_closes_where_the_motion_does(omega: float) -> None:
    turn = square(omega=omega)
    assert (turn.period, turn.turns, turn.count, turn.solution.repeated) == (720.0, 2, 24, 1)
    # smooth over both turns: x = r·cos(phi) + l·cos(psi), sin(psi) rising and falling through 1
    phi = np.linspace(0.0, 720.0, 1441)[1:-1] + 0.01
    square_of = 0.1**2 - (0.04 - 0.06 * np.sin(np.radians(phi))) ** 2
    sign = np.where((phi > 270.0) & (phi < 630.0), -1.0, 1.0)
    exact = 0.06 * np.cos(np.radians(phi)) + sign * np.sqrt(square_of)
    assert np.abs(turn.values(phi) - exact).max() < 1e-9
    assert turn.stroke == pytest.approx(np.sqrt(0.16**2 - 0.04**2) * 2, abs=1e-12)
    ends = sorted(one.phi % 720.0 for one in turn.extremes)
    assert ends == pytest.approx([14.4775121859, 525.5224878141], abs=1e-9)
    assert turn.strokes is not None and turn.strokes.working_deg == pytest.approx(511.044975628)
    assert np.ptp(turn.values(turn.at(np.array([0.0, 1.0])))) < 1e-9


@each("positions", [
    np.arange(18) * 40.0, 365.0 + np.arange(18) * 40.0, 720.0 - np.arange(18) * 40.0,
])  # fmt: skip
def test_positions_of_two_turns_are_those_of_a_cycle_of_two(positions: Any) -> None:
    problem = loads(SQUARE.replace("PHI", "[0, 90]").replace("OMEGA", "10"), name="square")
    counted = counting(problem, positions.tolist())
    solution = Solution(counted, positions=counted.numbered)
    assert solution.positions == pytest.approx(positions) and crank_cycle_of(solution).turns == 2
    exact = square().values(positions)
    assert np.abs(solution.points["B"].place.real - exact).max() < 1e-12
    with pytest.raises(LayoutError, match="even turns of 6 and more: --phi 0:720:30"):
        counting(problem, (np.arange(9) * 40.0).tolist())


def test_a_motion_of_one_turn_is_not_gone_through_twice() -> None:
    turn = CrankCycle(Solution(loads(SQUARE.replace("PHI", "0").replace("OMEGA", "1")
                               .replace("0.04", "0.03"), name="one")))  # fmt: skip
    assert (turn.period, turn.turns, turn.count) == (360.0, 1, 12)


def test_a_machine_reports_that_its_cycle_has_two_turns() -> None:
    text = (
        SQUARE.replace("PHI", "30").replace("OMEGA", "10")
        + """
[dynamics.links.3]
mass = 1
[[loads]]
link = "3"
at = "B"
against = "velocity"
force = 10
[machine]
delta = 0.1
J_crank = 0.5
"""
    )
    told = r"closes after 720 degrees: give \[machine\] cycle_deg = 720"
    with pytest.raises(ProblemError, match=told):
        Flywheel(loads(text, name="short"))
    made = Flywheel(loads(text.replace("0.1\nJ", "0.1\ncycle_deg = 720\nJ"), name="two"))
    assert made.work_per_cycle == pytest.approx(2 * 10.0 * (square().stroke or 0.0), rel=1e-9)


ALIKE = SQUARE.replace("0.06", "0.1").replace("0.04", "0").replace("OMEGA", "-4")
"""Crank and rod are equal: B passes over O, where the rod may turn with any speed."""


@each("positions", [
    np.arange(12) * 30.0, np.arange(12) * -30.0, np.arange(6) * 60.0 + 30.0,
    np.arange(24) * 15.0, np.arange(24) * 30.0, np.arange(8) * 45.0 + 360.0,
])  # fmt: skip
def test_a_dead_position_of_an_even_turn_is_reported_with_one_without(positions: Any) -> None:
    problem = loads(ALIKE.replace("PHI", "15"), name="alike")
    with pytest.raises(PositionError) as told:
        verify(Solution(problem, positions=positions))
    instead = told.value.failure.instead
    assert instead is not None and instead.turns == round(np.ptp(positions) / 360.0)
    zero, count, end, step = instead.first_angle, instead.count, *(
        float(one) for one in re.findall(r"--phi [\d.]+:([\d.]+):([\d.]+),", str(told.value))[0]
    )  # fmt: skip
    # both ways that it names, as a user takes them
    asked = np.arange(zero, end, step)
    assert len(asked) == len(positions)
    cycle = f"[cycle]\nzero = {zero}\ncount = {count}\n"
    numbered = number(loads(ALIKE.replace("PHI", "15") + cycle, name="alike"))
    of_cycle = Solution(numbered, positions=numbered_positions(Solution(numbered)))
    for solution in (Solution(problem, positions=asked), of_cycle):
        verify(solution)
        phi = np.radians(solution.positions)
        assert np.abs(solution.points["B"].place - 0.2 * np.cos(phi)).max() < 1e-12


@each("positions", [[0.0, 90.0], [90.0], np.arange(12) * 25.0 + 15.0])
def test_no_other_turn_is_advised_for_positions_that_are_not_numbers(positions: Any) -> None:
    problem = loads(ALIKE.replace("PHI", "15"), name="alike")
    with pytest.raises(PositionError) as told:
        verify(Solution(problem, positions=positions))
    assert told.value.failure.instead is None


def test_no_other_turn_is_advised_for_a_driver_that_does_not_go_round() -> None:
    text = SQUARE.replace("PHI", "0").replace("OMEGA", "4").replace("0.04", "0.07")
    with pytest.raises(PositionError) as told:
        verify(Solution(loads(text, name="short"), positions=np.arange(12) * 30.0))
    assert told.value.failure.instead is None


TWO_DYADS = """title = "Six-bar of two dyads on one pin"
[frame]
A = [0, 0]
D = [3, 0]
F = [0, 4]
[links.1]
points = ["A", "B"]
AB = 1
[links.2]
points = ["B", "C"]
BC = 2.5
[links.3]
points = ["C", "D"]
CD = {CD}
[links.4]
points = ["B", "E"]
BE = 2.6
[links.5]
points = ["E", "F"]
EF = {EF}
[driver]
link = "1"
phi = 40
omega = 10
[assembly]
C = "above D"
E = "right of F"
[cycle]
output = "3"
"""


@pytest.mark.parametrize(
    ("sides", "links", "at"),
    [
        # B is 2 to 4 from D, farthest at 180°, and 3 to 5 from F, farthest at 270°.
        ({"CD": 2.5, "EF": 2.42}, ("4", "5"), 270.0),  # 2.6 + 2.42 is just over 5
        ({"CD": 1.52, "EF": 4.0}, ("2", "3"), 180.0),  # 2.5 + 1.52 is just over 4
        ({"CD": 4.48, "EF": 4.0}, ("2", "3"), 0.0),  # 4.48 - 2.5 is just under 2
    ],
)
def test_the_tightest_group_is_the_dyad_that_is_nearest_to_one_line(
    sides: dict[str, float], links: tuple[str, ...], at: float
) -> None:
    problem = loads(TWO_DYADS.format(**sides), name="two-dyads")
    found = crank_cycle_of(Solution(problem)).tightest
    assert found is not None
    assert found[0] == links
    assert (found[1] - at + 180.0) % 360.0 - 180.0 == pytest.approx(0.0, abs=1.5)
