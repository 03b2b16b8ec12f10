"""A linkage driven by a cam's follower: place, rate, acceleration from the law; faulty files."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterator
from math import cos, pi, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import PROGRAM, Page, browsing
from cases import each
from click.testing import CliRunner
from doors import (
    LANGUAGES_LANGUAGES as LANGUAGES,
    CamProblem,
    Faults,
    FileNode,
    ModelProblem as Problem,
    PlanKind,
    Solution,
    Sweep,
    cli,
    crank_cycle_of,
    drawn,
    follower_drive,
    follower_motion,
    get_language,
    page_live_page as live_page,
    read_cam,
    statement_given_facts as given_facts,
    statics_of,
)

import planmethod
from benchmarks.rebuilt import rebuilt

SLIDER = """
[frame]
O = [0.0, 0.0]
C = [0.3, 0.0]
guides.y-y = { through = "O", angle = 90 }
[links.1]
points = ["A"]
slides = { on = "y-y" }
[links.2]
points = ["A", "B"]
AB = 0.25
[links.3]
points = ["B", "C"]
CB = 0.2
[driver]
link = "1"
s = 0.1
cam = {cam}
[assembly]
B = "above A"
[cam]
follower = "translating"
stroke = 0.04
rise = 120
upper_dwell = 30
return = 100
law = {{ rise = "3-4-5", return = "cosine" }}
n = {n}
"""

ROCKER = """
[frame]
O = [0.0, 0.0]
C = [0.5, 0.0]
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A", "B"]
AB = 0.45
[links.3]
points = ["B", "C"]
CB = 0.3
[driver]
link = "1"
phi = 100
cam = {cam}
[assembly]
B = "above C"
[cam]
follower = "oscillating"
swing = 25
arm = 0.12
sense = "{sense}"
rise = 90
return = 90
law = "sine"
n = {n}
"""


def filled(body: str, **given: object) -> str:
    for name, value in given.items():
        body = body.replace("{" + name + "}", str(value))
    return body.replace("{{", "{").replace("}}", "}")


def solved(tmp_path: Path, body: str, *args: str) -> dict[str, Any]:
    path = tmp_path / "lift.toml"
    path.write_text(body, encoding="utf-8")
    run = CliRunner().invoke(cli, ["solve", str(path), "--json", *args])
    assert run.exit_code == 0, run.output
    found: dict[str, Any] = json.loads(run.stdout)["positions"][0]
    return found


def polynomial(u: float) -> tuple[float, float, float]:
    """3-4-5 by its textbook coefficients."""
    s = 10 * u**3 - 15 * u**4 + 6 * u**5
    return s, 30 * u**2 - 60 * u**3 + 30 * u**4, 60 * u - 180 * u**2 + 120 * u**3


@each("cam, n", [(0, 120), (20, 120), (60, 120), (100, -90), (135, 120), (200, 120)])
def test_a_slider_moves_by_the_law(tmp_path: Path, cam: float, n: float) -> None:
    at = solved(tmp_path, filled(SLIDER, cam=cam, n=n))
    omega = abs(n) * pi / 30
    if cam < 120:
        length = radians(120)
        s, v, a = (0.04 * one for one in polynomial(cam / 120))
        v, a = v / length, a / length**2
    elif cam < 150:
        s, v, a = 0.04, 0.0, 0.0
    else:
        length, u = radians(100), (cam - 150) / 100
        s = 0.04 * (1 + cos(pi * u)) / 2
        v = -0.04 * pi / 2 * sin(pi * u) / length
        a = -0.04 * pi**2 / 2 * cos(pi * u) / length**2
    point = at["points"]["A"]
    assert point["y"] == pytest.approx(0.1 + s, abs=1e-12)
    assert point["vy"] == pytest.approx(v * omega, abs=1e-12)
    assert point["ay"] == pytest.approx(a * omega**2, abs=1e-9)


@each("sense, n, way", [("same", 60, 1), ("opposite", 60, -1), ("same", -60, -1)])
def test_a_rocker_turns_by_the_law_and_the_sense(
    tmp_path: Path, sense: str, n: float, way: int
) -> None:
    u, length, omega = 30 / 90, radians(90), 2 * pi
    at = solved(tmp_path, filled(ROCKER, cam=30, n=n, sense=sense))
    swing = radians(25)
    link = at["links"]["1"]
    turned = swing * (u - sin(2 * pi * u) / (2 * pi))
    assert link["phi_deg"] == pytest.approx(100 + way * np.degrees(turned), abs=1e-9)
    speed = swing * (1 - cos(2 * pi * u)) / length * omega
    assert link["omega"] == pytest.approx(way * speed, rel=1e-10)
    gain = swing * 2 * pi * sin(2 * pi * u) / length**2 * omega**2
    assert link["epsilon"] == pytest.approx(way * gain, rel=1e-10)


def test_the_linkage_moves_as_finite_differences_over_the_cam_angle(
    tmp_path: Path,
) -> None:
    step, omega = 0.01, 120 * pi / 30
    low, here, high = (
        solved(tmp_path, filled(SLIDER, cam=repr(50 + k * step), n=120))["points"]["B"]
        for k in (-1, 0, 1)
    )
    for axis in "xy":
        rate = (high[axis] - low[axis]) / (2 * radians(step)) * omega
        gain = (high["v" + axis] - low["v" + axis]) / (2 * radians(step)) * omega
        assert here["v" + axis] == pytest.approx(rate, abs=1e-7)
        assert here["a" + axis] == pytest.approx(gain, abs=1e-5)


def test_variants_change_the_angle_and_the_statement_names_the_cam(tmp_path: Path) -> None:
    body = filled(SLIDER, cam=20, n=120) + "\n[variants.90.driver]\ncam = 90\n"
    one = solved(tmp_path, body)
    other = solved(tmp_path, body, "--variant", "90")
    assert one["points"]["A"]["y"] < other["points"]["A"]["y"]
    path = tmp_path / "lift.toml"
    for lang, said in (("ru", "толкатель кулачка"), ("en", "the follower of a cam")):
        run = CliRunner().invoke(cli, ["protocol", str(path), "--lang", lang])
        assert run.exit_code == 0, run.output
        assert said in " ".join(run.output.split())
    run = CliRunner().invoke(cli, ["sheet", str(path), "--format", "svg", "-o", str(tmp_path)])
    assert run.exit_code == 0, run.output
    assert "left out" not in run.output


@each(
    "body, said",
    [
        (filled(SLIDER, cam=20, n=0), "cam.n: missing"),
        (filled(SLIDER, cam=20, n=120).replace("s = 0.1", "s = [0, 0.1]"), "one place is expected"),
        (filled(SLIDER, cam="[]", n=120), "driver.cam: expected at least one position"),
        (filled(SLIDER, cam="{ from = 0, to = 90 }", n=120), "driver.cam"),
        (filled(SLIDER, cam=20, n=120).replace("s = 0.1", ""), "driver.s: missing"),
        (filled(SLIDER, cam=20, n=120).replace("s = 0.1", "s = 0.1\nv = 2"), "not valid with"),
        (filled(SLIDER, cam='"top"', n=120), "driver.cam"),
        (filled(SLIDER, cam=20, n=120).replace("stroke", "strake"), "unknown key"),
        (filled(SLIDER, cam=20, n=120).partition("[cam]")[0], "the file has no cam"),
        (
            filled(ROCKER, cam=20, n=60, sense="same").partition("[cam]")[0]
            + "[cam]"
            + filled(SLIDER, cam=20, n=120).partition("[cam]")[2],
            "an oscillating one a crank",
        ),
        (
            filled(ROCKER, cam=20, n=60, sense="same") + "\n[machine]\ndelta = 0.05\n",
            "a cam's follower moves link 1",
        ),
    ],
)
def test_a_faulty_drive_is_reported(tmp_path: Path, body: str, said: str) -> None:
    path = tmp_path / "faulty.toml"
    path.write_text(body, encoding="utf-8")
    run = CliRunner().invoke(cli, ["solve", str(path), "--lang", "en"])
    assert run.exit_code == 3, run.output
    assert said in run.output
    assert "Traceback" not in run.output


# Many positions -----------------------------------------------------------------------------------

TURN = "{ from = 0, count = 12 }"
LAWS = [
    'law = "constant-acceleration"',
    'law = { rise = "cosine", return = "sine" }',
    'law = { rise = "trapezoidal", return = "modified-trapezoidal" }',
    'law = { rise = "linear", return = "4-5-6-7" }',
    'law = { rise = { law = "table", values = [1, 2, -1, -1] }, return = "3-4-5" }',
]


def problem_of(body: str) -> Problem:
    problem = planmethod.loads(body, name="lift")
    assert isinstance(problem, Problem)
    return problem


def made() -> dict[str, str]:
    """Return linkages driven by a slider and by a rocker, clockwise and counter-clockwise."""
    return {
        "slider": filled(SLIDER, cam=TURN, n=120),
        "clockwise": filled(SLIDER, cam=TURN, n=-90),
        "rocker": filled(ROCKER, cam=TURN, n=60, sense="same"),
        "opposite": filled(ROCKER, cam=TURN, n=-60, sense="opposite"),
    }


@each("law", LAWS)
@each("follower", ["translating", "oscillating"])
def test_the_law_as_data_is_the_law_of_the_cam(follower: str, law: str) -> None:
    size = "stroke = 0.04" if follower == "translating" else "swing = 25\narm = 0.12"
    text = f'follower = "{follower}"\n{size}\nrise = 110\nupper_dwell = 20\nreturn = 95\n{law}'
    node = FileNode(Faults(), tomllib.loads(text) | {"n": 60}, "cam")
    cam = CamProblem(name="", **read_cam(node))
    assert node.is_sound
    degrees = np.concatenate([np.linspace(-400, 800, 1201), [110.0, 130.0, 225.0]])
    exact = cam.at(np.radians(degrees))
    size_of = cam.arm * (-1 if cam.oscillates else 0) or 1.0
    found = follower_motion(follower_drive(cam), degrees) * size_of
    scale = np.max(np.abs(exact), axis=1, keepdims=True)
    assert np.max(np.abs(found - exact) / scale) < 1e-12


@each("name", ["slider", "clockwise", "rocker", "opposite"])
def test_rates_of_a_turn_are_the_derivatives_of_its_places(name: str) -> None:
    problem = problem_of(made()[name])
    sweep, omega = Sweep(problem), problem.drive.rate
    phi = np.array([7.0, 20.0, 41.0, 63.0, 88.0, 125.0, 161.0, 177.0, 301.0])
    step = 0.02
    low, here, high = (sweep.table(phi + k * step) for k in (-1, 0, 1))
    per = omega / (2 * np.radians(step))
    for point in "AB":
        for axis in "xy":
            rate = (high[f"{point}.{axis}"] - low[f"{point}.{axis}"]) * per
            gain = (high[f"{point}.v{axis}"] - low[f"{point}.v{axis}"]) * per
            assert np.max(np.abs(here[f"{point}.v{axis}"] - rate)) < 1e-6
            assert np.max(np.abs(here[f"{point}.a{axis}"] - gain)) < 1e-6 * omega**2


@each("name", ["slider", "clockwise", "rocker", "opposite"])
def test_every_position_of_a_turn_is_that_which_is_solved_alone(name: str) -> None:
    problem = problem_of(made()[name])
    whole, sweep = Solution(problem), Sweep(problem).table(problem.drive.positions)
    for index, phi in enumerate(problem.drive.positions):
        alone = Solution(problem, positions=[phi])
        for point, motion in alone.points.items():
            for key, letter in (("place", ""), ("velocity", "v"), ("acceleration", "a")):
                one, all_of = getattr(motion, key)[0], getattr(whole.points[point], key)[index]
                of_sweep = sweep[f"{point}.{letter}x"][index]
                of_sweep = of_sweep + 1j * sweep[f"{point}.{letter}y"][index]
                assert abs(one - all_of) < 1e-12
                assert abs(one - of_sweep) < 1e-12 * max(1.0, abs(one))
        for link, motion_of in alone.links.items():
            assert abs(motion_of.omega[0] - whole.links[link].omega[index]) < 1e-12
            assert abs(motion_of.epsilon[0] - whole.links[link].epsilon[index]) < 1e-11


def test_a_single_angle_is_one_of_the_turn(tmp_path: Path) -> None:
    one = solved(tmp_path, filled(SLIDER, cam=60, n=120))
    other = solved(tmp_path, filled(SLIDER, cam=TURN, n=120), "--phi", "60")
    assert one["points"] == other["points"] and one["cam_deg"] == other["cam_deg"] == 60.0


def test_a_resting_follower_is_reported_and_its_plans_are_points(tmp_path: Path) -> None:
    path, body = tmp_path / "lift.toml", filled(SLIDER, cam=TURN, n=120)
    path.write_text(body + LOADED, encoding="utf-8")
    for lang, said in (("ru", "толкатель стоит"), ("en", "the follower rests")):
        run = CliRunner().invoke(cli, ["protocol", str(path), "--phi", "135", "--lang", lang])
        assert run.exit_code == 0, run.output
        assert said in " ".join(run.output.split())
        moving = CliRunner().invoke(cli, ["protocol", str(path), "--phi", "60", "--lang", lang])
        assert said not in " ".join(moving.output.split())
    run = CliRunner().invoke(cli, ["solve", str(path), "--phi", "135", "--lang", "en"])
    assert "there is no Zhukovsky lever" in " ".join(run.output.split())
    run = CliRunner().invoke(cli, ["lint", str(path), "--lang", "en"])
    assert run.exit_code in (0, 1), run.output
    assert "position 4" not in run.output  # a plan that is a point has no short segment


LOADED = """
[dynamics.links.2]
mass = 3
centre = "A"
[[loads]]
link = "3"
couple = -20
"""


def test_the_lever_is_right_where_the_follower_moves_and_absent_where_it_rests() -> None:
    body = filled(ROCKER, cam=TURN, n=60, sense="same") + LOADED
    statics = statics_of(Solution(problem_of(body)))
    assert statics.lever is not None
    rests = np.isnan(statics.lever)
    rates = Solution(problem_of(body)).links["1"].omega
    assert (rests == (rates == 0.0)).all() and 0 < rests.sum() < len(rests)
    apart = np.abs(statics.lever - statics.balance)[~rests]
    assert np.max(apart) < 1e-9 * np.max(np.abs(statics.balance))
    assert [statics.lever_at(k) is None for k in range(len(rests))] == rests.tolist()


def test_plans_of_a_mechanism_that_mostly_rests_have_a_scale_that_fills_them() -> None:
    resting = Solution(problem_of(filled(ROCKER, cam=TURN, n=60, sense="same")))
    moving = resting.with_positions([30.0, 60.0, 120.0, 150.0])
    for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION):
        share = resting.scales[kind].per_mm / moving.scales[kind].per_mm
        assert 0.2 < share < 5.0


def test_a_cycle_is_a_turn_of_the_cam(tmp_path: Path) -> None:
    body = filled(SLIDER, cam=0, n=120) + '\n[cycle]\noutput = "3"\ncount = 12\n'
    problem = problem_of(body)
    assert problem.numbered == pytest.approx([30.0 * k for k in range(12)], abs=1e-12)
    turn = crank_cycle_of(Solution(problem))
    # The output turns back where the follower leaves its dwells: 150 and 360 degrees.
    assert sorted(end.phi % 360.0 for end in turn.extremes) == pytest.approx([0.0, 150.0], abs=1e-9)
    first, second = turn.transfers(np.array([60.0]))
    step = 0.01
    rate = turn.rate(np.array([60.0 - step, 60.0 + step]))
    assert (rate[1] - rate[0]) / (2 * np.radians(step)) == pytest.approx(second[0], abs=1e-6)
    path = tmp_path / "lift.toml"
    path.write_text(body, encoding="utf-8")
    for lang in LANGUAGES:
        run = CliRunner().invoke(cli, ["solve", str(path), "--lang", lang])
        assert run.exit_code == 0, run.output
        assert "кривошип" not in run.output and "crank" not in run.output
    assert first[0] != 0.0


@each("command", ["sheet", "live", "animate", "sketch", "form", "structure"])
def test_commands_take_a_turn_of_the_cam(command: str, tmp_path: Path) -> None:
    path = tmp_path / "lift.toml"
    path.write_text(filled(ROCKER, cam=TURN, n=60, sense="same"), encoding="utf-8")
    more = ["--format", "svg"] if command == "sheet" else []
    run = CliRunner().invoke(cli, [command, str(path), "-o", str(tmp_path), *more])
    assert run.exit_code == 0, run.output


def test_sizes_of_a_mechanism_that_a_cam_drives_vary() -> None:
    m = planmethod.Mechanism.from_problem(problem_of(filled(ROCKER, cam=TURN, n=60, sense="same")))
    positions = [30.0, 60.0, 150.0]
    grid = m.grid(positions, AB=[0.44, 0.46])
    for k, length in enumerate(grid.samples["l_AB"]):
        alone = m.with_(AB=float(length)).solve(positions).to_columns(["omega_3"])
        assert grid["omega_3"][k] == pytest.approx(alone["omega_3"], rel=1e-12, abs=1e-12)
    assert np.abs(grid["omega_3"][0] - grid["omega_3"][1]).max() > 1e-6


def test_a_project_of_a_follower_is_rejected(tmp_path: Path) -> None:
    path = tmp_path / "lift.toml"
    path.write_text(filled(ROCKER, cam=TURN, n=60, sense="same"), encoding="utf-8")
    run = CliRunner().invoke(cli, ["project", str(path), "-o", str(tmp_path), "--lang", "en"])
    assert run.exit_code == 3 and "course project is that of a crank" in run.output


@pytest.fixture
def page(tmp_path: Path) -> Iterator[Page]:
    if PROGRAM is None:
        pytest.skip("chromium is not installed")
    with browsing(tmp_path / "browser") as browser:
        yield browser


@each("name", ["slider", "clockwise", "rocker", "opposite"])
def test_the_page_moves_by_the_law(name: str, page: Page, tmp_path: Path) -> None:
    problem = problem_of(made()[name])
    file = tmp_path / f"{name}.html"
    file.write_text(live_page(problem, "ru"), "utf-8")
    angles = [0.0, 11.5, 60.0, 90.0, 119.75, 120.0, 150.0, 171.25, 249.5, 300.0]
    page.open(file, width=900, height=700)
    shown = page.ask(f"{json.dumps(angles)}.map(x => at(x))")
    rows = page.ask("D.rows")
    assert not page.said
    table = Sweep(problem).table(np.array(angles))
    for number, row in enumerate(rows):
        if row in table:
            exact = table[row]
            told = np.array([one[number] for one in shown], dtype=float)
            assert np.max(np.abs(told - exact)) < 1e-9 * max(1.0, float(np.max(np.abs(exact)))), row
    assert sum(row in table for row in rows) > 20


@each("body", (filled(SLIDER, cam="{ from = 0, count = 12 }", n=120),
               filled(ROCKER, cam=30, sense="same", n=-60)))  # fmt: skip
def test_of_the_statement_with_the_law_the_mechanism_is_built_again(body: str) -> None:
    problem = planmethod.loads(body, name="driven")
    for words in map(get_language, LANGUAGES):
        again = rebuilt([drawn(problem, words), *given_facts(problem, words)])
        assert again.drive.cam_drive == problem.drive.cam_drive
        one, two = Solution(problem), Solution(again)
        for name, point in one.points.items():
            assert two.points[name].place == pytest.approx(point.place, abs=1e-12)
            assert two.points[name].velocity == pytest.approx(point.velocity, abs=1e-12)
