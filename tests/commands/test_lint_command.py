"""Command lint: exit codes, the two languages, the record."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result
from doors import REMARKS, ExitCode, cli
from worked import path_of

EX1, EX2, EX3 = (str(path_of(f"linkages/ex{n}")) for n in (1, 2, 3))
VARIANTS = str(path_of("levers/task12-variants"))
LONG = "author=Константинопольский-Преображенский-Вознесенский-Архангельский"


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def run(*args: str, lang: str = "ru") -> Result:
    return CliRunner(env={"PLANMETHOD_LANG": lang}).invoke(cli, ["lint", *args])


def record(*args: str) -> Any:
    return json.loads(run(*args, "--json").stdout)


THREE = ("--phi", "30,60,90")
"""Positions, one of which has a short segment; for a single position it would be enlarged."""


def test_a_clean_sheet_is_done(tmp_path: Path) -> None:
    done = run(EX2, EX3)
    assert done.exit_code == ExitCode.DONE
    assert done.stdout.splitlines() == [
        "ex2: лист 1 из 1, А3: замечаний нет",
        "ex3: лист 1 из 1, А2: замечаний нет",
    ]
    assert list(tmp_path.iterdir()) == []


def test_warnings_are_findings_only_when_strict() -> None:
    done = run(EX1, *THREE)
    assert done.exit_code == ExitCode.DONE
    assert "PM-D08 предупреждение: план ускорений, положение" in done.stdout
    assert "4,80 мм, предел 5 мм" in done.stdout
    assert "Что делать: Впишите в [scales] mu_a = 4" in done.stdout
    assert run(EX1, *THREE, "--strict").exit_code == ExitCode.FINDINGS
    assert run(EX2, "--strict").exit_code == ExitCode.DONE


def test_errors_are_findings() -> None:
    done = run(EX2, "--stamp", LONG)
    assert done.exit_code == ExitCode.FINDINGS
    assert "PM-D06 ошибка: основная надпись\n" in done.stdout
    # Every problem is checked, and one with errors is enough.
    both = run(EX2, EX1, "--stamp", LONG)
    assert both.exit_code == ExitCode.FINDINGS
    assert {"ex1", "ex2"} <= set(re.findall(r"(?m)^(\w+):", both.stdout))


def test_english() -> None:
    done = run(EX1, *THREE, "--lang", "en", "--stamp", LONG)
    assert done.exit_code == ExitCode.FINDINGS
    assert re.search("ex1: sheet 1 of 1, A[23]: errors 2, warnings [12]", done.stdout)
    assert "PM-D08 warning: acceleration plan, position" in done.stdout
    assert "mm, limit 5 mm" in done.stdout
    assert "Next: Write mu_a = 4 into [scales]" in done.stdout


def test_the_record() -> None:
    found = record(EX1, *THREE)
    assert {key: found[key] for key in ("schema", "problem", "variant", "kind")} == {
        "schema": 1,
        "problem": "ex1",
        "variant": None,
        "kind": "kinematics",
    }
    (sheet,) = found["sheets"]
    assert (found["errors"], found["warnings"]) == (0, len(sheet["findings"]))
    assert (sheet["number"], sheet["paper"]) == (1, "A2")
    (finding,) = (one for one in sheet["findings"] if one["code"] == "PM-D08")
    assert set(finding) == {
        "code",
        "severity",
        "title",
        "what",
        "where",
        "value",
        "limit",
        "unit",
        "action",
        "facts",
    }
    assert finding["code"] in REMARKS
    assert finding["severity"] == "warning"
    assert set(finding["where"]) == {"view", "position", "x", "y"}
    assert finding["where"]["view"] == "acceleration"
    assert 20 < finding["where"]["x"] < 589
    assert 5 < finding["where"]["y"] < 415
    assert finding["value"] < finding["limit"] == 5.0
    assert finding["facts"]["segments"] == [["bn_CB", pytest.approx(4.805, abs=0.01)]]


def test_records_of_several_and_their_exit_code() -> None:
    done = run(VARIANTS, "--all-variants", "--json")
    assert done.exit_code == ExitCode.DONE
    assert [found["variant"] for found in json.loads(done.stdout)] == list("АБВГДЕ")
    strict = run(VARIANTS, "--variant", "Д", "--phi", "30,60", "--json", "--strict")
    assert strict.exit_code == ExitCode.FINDINGS
    assert record(VARIANTS, "--variant", "Б")["variant"] == "Б"


def test_positions_are_named_by_the_numbers_of_the_sheet() -> None:
    found = record(EX2, "--phi", "0,150,240")
    numbers = {f["where"]["position"] for sheet in found["sheets"] for f in sheet["findings"]}
    assert numbers
    assert numbers <= {0, 1, 2, None}
    assert ", положение 1; " in run(EX2, "--phi", "0,150,240").stdout


def test_the_options_of_the_sheet_are_taken() -> None:
    found = record(EX1, "--paper", "A1")
    assert found["sheets"][0]["paper"] == "A1"
    codes = [finding["code"] for finding in found["sheets"][0]["findings"]]
    assert "PM-D10" in codes
    done = run(EX3, "--errors", "--sigma", "--profile", "coarse", "--ruler", "1")
    assert done.exit_code == ExitCode.DONE, done.output


def test_the_structural_sheet() -> None:
    done = run(EX3, "--structure", "--lang", "en")
    assert done.exit_code == ExitCode.DONE
    assert done.stdout == "ex3: sheet 1 of 1, A3: no findings\n"
    assert record(EX3, "--structure")["kind"] == "structure"
    for option in (("--phi", "0"), ("--errors",), ("--sigma",)):
        refused = run(EX3, "--structure", *option)
        assert refused.exit_code == ExitCode.USAGE
        assert "--structure" in refused.output


def test_faults_outrank_findings(tmp_path: Path) -> None:
    (tmp_path / "faulty.toml").write_text("title = 1\n", "utf-8")
    done = run("faulty.toml", EX2, "--stamp", LONG)
    assert done.exit_code == ExitCode.PROBLEM
    assert "PM-D06" in done.stdout  # the others are checked all the same
    assert run(EX3, "--paper", "A9").exit_code == ExitCode.USAGE


def test_the_help_describes_the_argument() -> None:
    told = re.sub(r"\s+", " ", run("--help", lang="en").output)
    assert "The sheets of PROBLEM are drawn" in told
    assert "docs/reference/lint-codes.md" in told
