"""Commands on the accuracy of the numbers: --sigma, --covariance, --referee, bench."""

from __future__ import annotations

import csv
import io
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result
from doors import (
    DRAFTING_PROFILES as PROFILES,
    PointName,
    Solution,
    Sweep,
    SweepError,
    Timing,
    UnknownItemError,
    cli,
    drafting_of,
    drawn_forces,
    forces,
    problem_load as load,
    problem_loads as loads,
    report,
    speed,
    statics_of,
)
from texts import result_tables
from worked import ROOT, path_of, problem_of

EX3 = str(path_of("linkages/ex3"))
SIX_LINK = str(path_of("levers/six-link"))


def run(*args: str) -> Result:
    return CliRunner().invoke(cli, args)


def record(*args: str) -> dict[str, Any]:
    result = run("solve", *args, "--json")
    assert result.exit_code == 0, result.output
    found: dict[str, Any] = json.loads(result.stdout)
    return found


def test_the_record_has_a_sigma_for_every_segment() -> None:
    solution = Solution(problem_of("linkages/ex3"))
    (position,) = record(EX3)["positions"]
    for kind, plan in position["plans"].items():
        for name, segment in plan["segments"].items():
            wanted = drafting_of(solution).spreads[f"{kind}.{name}"].sigma[0]
            assert segment["sigma"] == pytest.approx(wanted) and wanted > 0
    assert position["hand"]["profile"] == "board" and position["hand"]["ruler"] == 0.5
    hand = position["hand"]["links"]["3"]
    assert hand["sigma_omega"] == pytest.approx(drafting_of(solution).spreads["omega_3"].sigma[0])
    assert position["hand"]["monte_carlo"] == []


@pytest.mark.parametrize("profile", PROFILES)
def test_a_profile_brings_its_ruler(profile: str) -> None:
    (position,) = record(EX3, "--profile", profile)["positions"]
    assert position["hand"]["profile"] == profile
    assert position["hand"]["ruler"] == PROFILES[profile].ruler
    (other,) = record(EX3, "--profile", profile, "--ruler", "2")["positions"]
    assert other["hand"]["ruler"] == 2.0


def test_errors_found_by_random_sheets_are_marked() -> None:
    found = record(EX3, "--phi", "0:360:30", "--profile", "coarse")["positions"]
    labels = [position["hand"]["monte_carlo"] for position in found]
    assert any(labels) and not all("v_B" in told for told in labels)


def test_tables_with_sigma() -> None:
    plain, told = run("solve", EX3), run("solve", EX3, "--sigma")
    assert told.exit_code == 0, told.output
    assert "±σ" in told.stdout and "±σ" not in plain.stdout
    assert run("solve", EX3, "--sigma", "--lang", "en").exit_code == 0


def test_the_referee_judges_on_the_terminal_and_in_the_record() -> None:
    told = run("solve", EX3, "--referee", "30", "--lang", "en")
    assert told.exit_code == 0, told.output
    assert "Float64 beside the referee of 30 digits" in told.stdout
    (position,) = record(EX3, "--referee")["positions"]
    results = position["referee"]["results"]
    assert position["referee"]["digits"] == 50
    assert max(result["multiple"] for result in results.values()) < 16
    exact = float(results["v_E"]["x"])
    assert exact == pytest.approx(position["points"]["E"]["vx"], rel=1e-14)


def test_the_covariance_as_a_spreadsheet(tmp_path: Path) -> None:
    file = tmp_path / "c.csv"
    told = run("solve", EX3, "--covariance", str(file))
    assert told.exit_code == 0 and told.stdout.strip() == str(file)
    rows = list(csv.DictReader(io.StringIO(file.read_text("utf-8"))))
    labels = [row["quantity"] for row in rows]
    matrix = np.array([[float(row[label]) for label in labels] for row in rows])
    assert np.allclose(matrix, matrix.T, rtol=1e-9, atol=1e-18)
    sigma = np.array([float(row["sigma"]) for row in rows])
    assert np.allclose(np.sqrt(np.diag(matrix)), sigma)
    k = labels.index("omega_3")
    wanted = drafting_of(Solution(problem_of("linkages/ex3"))).spreads["omega_3"].sigma[0]
    assert sigma[k] == pytest.approx(wanted)


def test_the_covariance_has_the_forces_of_a_loaded_problem() -> None:
    told = run("solve", str(path_of("press/press")), "--covariance", "-")
    assert told.exit_code == 0, told.output
    rows = {row["quantity"]: row for row in csv.DictReader(io.StringIO(told.stdout))}
    statics = statics_of(Solution(problem_of("press/press")))
    for label in ("F_1_0", "balance", "difference"):
        wanted = float(drawn_forces(statics).spreads[label].sigma[0])
        assert float(rows[label]["sigma"]) == pytest.approx(wanted)
        # Forces follow from the accelerations, so that they err with them.
        assert float(rows[label]["a_S3"]) == pytest.approx(float(rows["a_S3"][label])) != 0.0


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (("--sigma", "--csv"), "--sigma and --referee require"),
        (("--referee", "--ask", "v_E"), "--sigma and --referee require"),
        (("--covariance", "x.csv", "--json"), "--covariance writes a separate table"),
        (("--covariance", "x.toml"), "would overwrite x.toml"),
        (("--referee", "5"), "16<=x<=1000"),
        (("--profile", "pen"), "'pen' is not one of 'cad', 'board', 'coarse'"),
        (("--ruler", "0"), "0.0<x<=50.0"),
        (("--ruler", "nan"), "'nan' is not a number"),
    ],
)
def test_incompatible_options_are_rejected(args: tuple[str, ...], said: str) -> None:
    result = run("solve", EX3, *args)
    assert result.exit_code == 2
    assert said in result.output


def test_a_sheet_with_errors(tmp_path: Path) -> None:
    out = ("-o", str(tmp_path), "--format", "svg")
    assert run("sheet", EX3, *out).exit_code == 0
    plain = (tmp_path / "ex3.svg").read_bytes()
    told = run("sheet", EX3, *out, "--errors", "--sigma", "--profile", "cad")
    assert told.exit_code == 0, told.output
    assert len((tmp_path / "ex3.svg").read_bytes()) > len(plain)


def test_a_section_of_bench_by_itself() -> None:
    told = run("bench", EX3, "--only", "drafting", "--only", "forces")
    assert told.exit_code == 0, told.output
    assert "| ex3 | board |" in told.stdout
    assert "## Forces" not in told.stdout, "ex3 has no loads"


def test_bench_measures_forces_of_a_problem_with_loads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(report, "COUNTS", (1, 12))
    monkeypatch.setattr(forces, "DRAWS", 400)
    for module in (forces, speed):
        monkeypatch.setattr(module, "clock", lambda act, **_: Timing(1e-3, 1e-3, 1e-3, 1))
    told = run("bench", SIX_LINK, "--only", "forces", "--only", "speed")
    assert told.exit_code == 0, told.output
    for row in ("| sweep, float64 | six-link | 12 |", "| the hand, ruler 0.1 mm | six-link | 1 |"):
        assert row in told.stdout
    assert "| motion and force plans, step by step | six-link | 12 |" in told.stdout
    assert "| six-link | 1 |" in told.stdout, "lever and force plans in the position of the file"


def test_bench_of_a_missing_problem(tmp_path: Path) -> None:
    told = run("bench", str(tmp_path / "none.toml"), "--only", "drafting")
    assert told.exit_code == 3


def test_a_pipe_closed_between_two_tables_is_no_finding() -> None:
    words = ("solve", str(path_of("levers/six-link")), "--phi", "150,150.1,150.2", "--referee")
    with subprocess.Popen(
        [sys.executable, str(ROOT / "cli.py"), *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env={**os.environ, "PYTHONIOENCODING": "utf-8"},
    ) as running:
        assert running.stdout is not None and running.stderr is not None
        running.stdout.read(10)
        running.stdout.close()
        said = running.stderr.read().decode()
        assert running.wait(timeout=60) == 0
    assert said == ""


def test_a_mechanism_at_rest_has_no_drafting_errors_in_its_plans() -> None:
    text = path_of("linkages/ex3").read_text("utf-8").replace("omega = 50", "omega = 0", 1)
    solution = Solution(loads(text, name="still"))
    for label, spread in drafting_of(solution).spreads.items():
        if not label.startswith(("position", "x_", "y_")):
            assert spread.sigma[0] == 0 and not spread.drawn[0], label


def test_sigma_does_not_jump_where_a_vector_vanishes() -> None:
    problem = load(path_of("levers/task12-variants"))
    at, beside = (drafting_of(Solution(problem, positions=[phi])) for phi in (270.0, 270.0 + 1e-7))
    for label, spread in at.spreads.items():
        other = beside.spreads[label]
        if not (spread.drawn[0] or other.drawn[0]) and spread.sigma[0] > 0:
            assert spread.sigma[0] == pytest.approx(other.sigma[0], rel=0.05, abs=1e-9), label


def test_far_from_the_origin_everything_comes_out_the_same() -> None:
    text = path_of("linkages/ex3").read_text("utf-8")
    text = text.replace("A = [0.0, 0.0]", "A = [131072.0, -65536.0]", 1)
    text = text.replace("C = [0.0, -0.11]", "C = [131072.0, -65536.11]", 1)
    near, far = Solution(problem_of("linkages/ex3")), Solution(loads(text, name="far"))
    shift = 131072 - 65536j
    for name, motion in near.points.items():
        assert abs(far.points[name].place[0] - shift - motion.place[0]) < 1e-10
        assert abs(far.points[name].velocity[0] - motion.velocity[0]) < 1e-9
        assert abs(far.points[name].acceleration[0] - motion.acceleration[0]) < 1e-6
    assert "131072,09128" in result_tables(far)


def test_threads_may_share_a_sweep() -> None:
    sweep = Sweep(problem_of("linkages/ex3"), ["v_E"])
    turns = [np.linspace(a, a + 360, 50_001) for a in (0, 13)]
    turns += [np.random.default_rng(k).uniform(0, 360, 50_001) for k in range(3)]
    alone = [sweep.run(turn) for turn in turns]
    for _ in range(4):
        with ThreadPoolExecutor(4) as pool:
            together = list(pool.map(sweep.run, turns))
        assert all(np.array_equal(a, b) for a, b in zip(alone, together, strict=True))


def test_an_angle_of_a_guide_can_be_varied() -> None:
    problem = problem_of("linkages/ex3")
    sweep = Sweep(problem, ["v_E"], varied=["angle_x-x"])
    phi = np.linspace(0, 90, 100)
    plain = Sweep(problem, ["v_E"]).run(phi)
    for angle in (0.0, np.zeros(100), np.zeros(1)):
        assert np.allclose(sweep.run(phi, {"angle_x-x": angle}), plain, rtol=1e-12, atol=1e-12)
    both = sweep.run(phi, {"angle_x-x": np.array([[0.0], [5.0]])})
    assert np.allclose(both[:, 0], plain) and not np.allclose(both[:, 1], plain)


def test_invalid_arguments_of_a_sweep_are_rejected() -> None:
    sweep = Sweep(problem_of("linkages/ex3"), "v_E")
    phi = np.linspace(0, 90, 50)
    for out in (np.zeros((1, 50)), np.zeros((2, 1)), [0.0]):
        with pytest.raises(SweepError, match=r"out must be an array of shape \(2, 50\)"):
            sweep.run(phi, out=out)  # type: ignore[arg-type]
    with pytest.raises(SweepError, match="failed must be an array"):
        sweep.run(phi, failed=np.zeros(3, np.int16))
    with pytest.raises(SweepError, match="failed must be of a signed integer type"):
        sweep.run(phi, failed=np.zeros(50))  # type: ignore[arg-type]
    with pytest.raises(SweepError, match="float64 or float32, not int64"):
        Sweep(problem_of("linkages/ex3"), dtype=np.int64)
    with pytest.raises(SweepError, match="positions are of shape"):
        sweep.run(20.0)
    assert "is not a number" in sweep.explain(float("nan"))
    assert sweep.reason(-1) == ""


def test_items_that_a_drawing_does_not_have_are_rejected() -> None:
    drafting = drafting_of(Solution(problem_of("linkages/ex3")))
    with pytest.raises(UnknownItemError, match="no plan has a point Q"):
        drafting.ellipse(PointName("Q"), 0)
    with pytest.raises(UnknownItemError, match="does not give Q"):
        drafting.causes("Q")
