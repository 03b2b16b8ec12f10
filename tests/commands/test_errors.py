"""Commands that tell how good the numbers are: --sigma, --covariance, --referee, bench."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result
from worked import path_of, problem_of

from planmethod.cli import cli
from planmethod.construct.drafting import PROFILES
from planmethod.plans.solution import Solution

EX3 = str(path_of("linkages/ex3"))


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
            wanted = solution.drafting.spreads[f"{kind}.{name}"].sigma[0]
            assert segment["sigma"] == pytest.approx(wanted) and wanted > 0
    assert position["hand"]["profile"] == "board" and position["hand"]["ruler"] == 0.5
    hand = position["hand"]["links"]["3"]
    assert hand["sigma_omega"] == pytest.approx(solution.drafting.spreads["omega_3"].sigma[0])
    assert position["hand"]["monte_carlo"] == []


@pytest.mark.parametrize("profile", PROFILES)
def test_a_profile_brings_its_ruler(profile: str) -> None:
    (position,) = record(EX3, "--profile", profile)["positions"]
    assert position["hand"]["profile"] == profile
    assert position["hand"]["ruler"] == PROFILES[profile].ruler
    (other,) = record(EX3, "--profile", profile, "--ruler", "2")["positions"]
    assert other["hand"]["ruler"] == 2.0


def test_what_was_found_by_random_sheets_is_told() -> None:
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
    wanted = Solution(problem_of("linkages/ex3")).drafting.spreads["omega_3"].sigma[0]
    assert sigma[k] == pytest.approx(wanted)


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (("--sigma", "--csv"), "--sigma and --referee go with"),
        (("--referee", "--ask", "v_E"), "--sigma and --referee go with"),
        (("--covariance", "x.csv", "--json"), "--covariance is a table of its own"),
        (("--covariance", "x.toml"), "would write over x.toml"),
        (("--referee", "5"), "16<=x<=1000"),
        (("--profile", "pen"), "'pen' is not one of 'cad', 'board', 'coarse'"),
        (("--ruler", "0"), "0.0<x<=50.0"),
        (("--ruler", "nan"), "nan is not a step of a ruler"),
    ],
)
def test_what_does_not_go_together(args: tuple[str, ...], said: str) -> None:
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


def test_sections_of_the_benchmark_by_themselves() -> None:
    told = run("bench", EX3, "--only", "drafting", "--only", "random", "--random", "4")
    assert told.exit_code == 0, told.output
    assert "## Random mechanisms" in told.stdout and "4 mechanisms" in told.stdout
    assert "exceptions: 0; results that are NaN without a reason: 0" in told.stdout
    assert "on a wrong branch: 0 of 48 positions" in told.stdout
    assert "| ex3 | board |" in told.stdout


def test_a_missing_problem_of_the_benchmark(tmp_path: Path) -> None:
    told = run("bench", str(tmp_path / "none.toml"), "--only", "drafting")
    assert told.exit_code == 3
