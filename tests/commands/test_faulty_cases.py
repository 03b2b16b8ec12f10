"""Files on which a command once failed: the present output of every command."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result
from doors import cli
from worked import path_of

ROOT = Path(__file__).parents[2]
CASES = ROOT / "tests" / "data" / "cases"
NOTHING = str(CASES / "arm-nothing.toml")
CYCLE = str(CASES / "arm-nothing-cycle.toml")
FORCES = str(CASES / "arm-nothing-forces.toml")
TASK12 = (str(path_of("levers/task12")), "--phi", "326.3", "--ruler", "50")


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def run(*args: str) -> Result:
    return CliRunner().invoke(cli, list(args), catch_exceptions=False)


def done(*args: str) -> str:
    result = run(*args)
    assert result.exit_code == 0, result.output
    assert "nan" not in result.stdout.split()
    return result.stdout


def record(*args: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(done("solve", *args, "--json"))
    return found


def numbers(value: Any, path: str = "") -> dict[str, Any]:
    """Return the leaves of a record by their paths."""
    if isinstance(value, dict):
        return {k: v for key in value for k, v in numbers(value[key], f"{path}/{key}").items()}
    if isinstance(value, list):
        return {k: v for i, one in enumerate(value) for k, v in numbers(one, f"{path}/{i}").items()}
    return {path: value}


# An arm that is read as zero ----------------------------------------------------------------------


@pytest.mark.usefixtures("russian")
@pytest.mark.dear
@pytest.mark.parametrize(
    "asked",
    [(FORCES, "--phi", "0.3"), (NOTHING,), TASK12],
    ids=["forces", "arm-nothing", "task12"],
)
def test_a_division_by_zero_is_unreadable_and_the_rest_is_checked(
    asked: tuple[str, ...],
) -> None:
    found = record(*asked)
    fine = record(*asked[:1], *(asked[1:3] if len(asked) > 1 else ()), "--ruler", "0.001")
    assert found["positions"][0]["hand"]["links"]["3"]["omega"] is None
    told, right = numbers(found["positions"]), numbers(fine["positions"])
    assert told.keys() >= {key for key in right if "monte_carlo" not in key}
    blank = {key for key, value in told.items() if value is None and right.get(key) is not None}
    read = ("/hand/", "/read", "/read_moment")
    assert blank and all(any(part in key for part in read) for key in blank)
    exact = [key for key in right if not any(word in key for word in ("/hand/", "read", "sigma"))]
    same = [key for key in exact if "monte_carlo" not in key]
    assert [told[key] for key in same] == [right[key] for key in same]
    assert "—" in done("solve", *asked)
    assert "—" in done("solve", *asked, "--sigma")
    for command in ("protocol", "sheet"):
        assert done(command, *asked, "-o", "out")
    text = done("protocol", *asked)
    arm = "FC" if asked == TASK12 else "BC"  # in the letters of its source
    assert f"ω₃ на этом плане не читается: линейка снимает {arm} = 0." in text
    assert "v_D на этом плане не читается (точно " in text
    if len(asked) > 1:
        assert "По снятому не построить: сюда входит то, что на этом плане не читается." in text
        assert done("sheet", *asked, "--layout", "forces", "-o", "out")
        assert "расхождение — Н·м (—%)" in done("solve", *asked)
    english = done("protocol", *asked, "--lang", "en")
    assert f"ω₃ is not readable on this plan: the ruler reads {arm} = 0." in english
    done("solve", *asked, "--csv", "-")
    done("solve", *asked, "--covariance", "-")


@pytest.mark.usefixtures("russian")
def test_one_position_that_cannot_be_read_leaves_the_others_as_they_are() -> None:
    found = record(CYCLE)["positions"]
    assert len(found) == 12
    for number, entry in enumerate(found):
        hand = entry["hand"]["links"]["3"]["omega"]
        assert (hand is None) == (number == 0)
        if number:
            assert hand == pytest.approx(entry["links"]["3"]["omega"], rel=0.05)
    text = done("protocol", CYCLE, "--position", "0")
    assert "ω₃ на этом плане не читается" in text
    assert "не читается" not in done("protocol", CYCLE, "--position", "2")
    assert done("sheet", CYCLE, "-o", "out")


def test_arrays_of_the_cycle_are_exact_everywhere() -> None:
    done("solve", CYCLE, "--npz", "cycle.npz")
    with np.load("cycle.npz") as arrays:
        assert np.isfinite(arrays["3.omega"]).all()


# No warning of Python -----------------------------------------------------------------------------


@pytest.mark.parametrize("command", [("solve", "--sigma"), ("protocol",), ("sheet", "-o", "out")])
def test_no_python_traceback_reaches_a_terminal(command: tuple[str, ...]) -> None:
    assert os.environ["PYTHONWARNINGS"] == "error"  # as in every process that a test starts
    found = subprocess.run(
        [sys.executable, str(ROOT / "cli.py"), *command, str(CASES / "point-at-pivot.toml")],
        capture_output=True,
        encoding="utf-8",
        env={**os.environ, "PYTHONIOENCODING": "utf-8"},
        timeout=120,
    )
    assert (found.returncode, found.stderr) == (0, "")
    if "--sigma" in command:
        assert "σ = —" not in found.stdout and "—*" not in found.stdout


# Assemblies ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "command", [("solve",), ("solve", "--csv", "-"), ("protocol",), ("sheet", "-o", "out")]
)
def test_a_change_point_between_the_positions_is_reported_once(command: tuple[str, ...]) -> None:
    case = str(CASES / "parallelogram.toml")
    result = run(*command, case, "--phi", "170,190")
    assert result.exit_code == 0
    assert result.stderr == (
        f"Warning: {case}: links 2, 3 pass a change point at phi = 180 deg, from which the "
        "mechanism may continue either way: the side that was chosen in the first position is "
        "kept, so that one branch of the motion passes into another there. In [assembly] give "
        'C = { keep = "parallel" } for the parallelogram, C = { near = [x, y], keep = '
        '"continuous" } for the motion that continues smoothly.\n'
    )
    assert run(*command, case, "--phi", "80,170").stderr == ""


def test_a_rule_that_both_assemblies_satisfy_is_rejected() -> None:
    result = run("solve", str(CASES / "ambiguous-rule.toml"))
    assert result.exit_code == 3
    assert result.stderr == (
        f"Error: {CASES / 'ambiguous-rule.toml'}: 1 fault in the problem file\n"
        "  assembly.C: 'C right of B' holds for both assemblies at phi = 60 deg: with C at "
        "(0.3251, 0.2063) and at (0.1838, -0.1819) m. Give 'above A' for the first or 'below A' "
        "for the second\n"
    )
