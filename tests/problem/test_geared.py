"""A crank that a gear train drives: one file with links and wheels."""

from __future__ import annotations

import json
import math
import tomllib
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from cases import each
from click.testing import CliRunner
from doors import ExitCode, ProblemError, cli, problem_load as load_bare
from worked import ROOT, path_of

from planmethod import load, loads

TRAIN = """
[gears]
wheels = { 1 = 24, 2 = 36, 3 = 96 }
meshes = [
  { of = [1, 2], carrier = "H" },
  { of = [2, 3], kind = "internal", carrier = "H" },
]
fixed = ["3"]
n = { 1 = -1440 }
"""
LINKAGE = path_of("linkages/ex3").read_text("utf-8").partition("[stamp]")[0]
TEXT = LINKAGE.replace("omega = 50", 'train = "H"') + TRAIN
VARIANTS = (
    '[variants.A]\n"gears.n" = { 1 = 720 }\n[variants.B]\n"driver.omega" = 7\n'
    '[variants.C]\n"driver.train" = 2\n'
)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    file = tmp_path / "geared.toml"
    file.write_text(TEXT + VARIANTS, encoding="utf-8")
    return file


def run(*args: str) -> Any:
    return CliRunner().invoke(cli, args)


def test_the_crank_turns_at_the_speed_of_the_train(path: Path) -> None:
    """U_1H = 1 + 96/24 = 5."""
    drive = load(path).drive
    assert drive.rate == pytest.approx(-1440 / 5 * math.pi / 30)
    assert drive.gear_drive is not None and drive.gear_drive.ratio == 5
    rates = [load(path, variant=name).drive.rate for name in "ABC"]
    assert rates == pytest.approx([720 / 5 * math.pi / 30, 7, 288 * 5 / 3 * math.pi / 30])
    assert load(path, variant="B").drive.gear_drive is None


def test_plans_sheets_and_keys_have_that_speed(path: Path, tmp_path: Path) -> None:
    jsonschema.validate(
        tomllib.loads(path.read_text("utf-8")),
        json.loads((ROOT / "planmethod/problem/schema.json").read_text("utf-8")),
    )
    plain = tmp_path / "plain.toml"
    plain.write_text(LINKAGE.replace("omega = 50", "n = -288"), encoding="utf-8")
    asked = [run("solve", str(file), "--ask", "omega_3").stdout for file in (path, plain)]
    assert asked[0] == asked[1]
    said = run("protocol", str(path), "--lang", "en").stdout
    said = " ".join(said.split())
    assert "n of wheel 1 = −1440 rev/min; held fixed in the gear train: 3; U_1-H = 5;" in said
    assert "ω₁ = ω_H = −30.16 s⁻¹" in said
    done = run("sheet", str(path), "--format", "svg", "-o", str(tmp_path))
    assert done.exit_code == ExitCode.DONE, done.output


@each(
    "old, new, said",
    [
        ('train = "H"', 'train = "9"', "driver.train: unknown wheel '9'"),
        ('train = "H"', 'train = "H"\nn = 3', "driver.train: n and train are both given"),
        ("3 = 96", "3 = 97", "the train is not coaxial"),
        ("3 = 96", "3 = 9.5", "gears.wheels.3: expected a whole number"),
        ("n = { 1 = -1440 }", "", "undetermined: W = 1, and 0 speeds"),
        (TRAIN, "", "driver.train: the file has no train"),
        ("phi = 20", "s = 0.1", "driver.s: not valid with a crank"),
    ],
)
def test_a_train_that_cannot_drive_is_rejected_with_a_reason(
    old: str, new: str, said: str, path: Path
) -> None:
    path.write_text(TEXT.replace(old, new), encoding="utf-8")
    done = run("solve", str(path))
    assert done.exit_code == ExitCode.PROBLEM, done.output
    assert said in done.stderr, done.stderr


def test_a_train_that_no_driver_names_stays_as_it_is(path: Path) -> None:
    text = LINKAGE + TRAIN.replace("3 = 96", "3 = 97")
    assert loads(text, name="kept").drive.rate == 50
    with pytest.raises(ProblemError, match=r"planmethod\.load"):
        load_bare(path)
