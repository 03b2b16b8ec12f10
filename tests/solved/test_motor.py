"""The power of a machine, and the motor that is chosen for it."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from doors import (
    RATED_KW,
    Flywheel,
    ModelProblem as Problem,
    Solution,
    cli,
    kinds_load as load,
    kinds_loads as loads,
    machine_power,
    statics_of,
)
from worked import ROOT

SHAPER = ROOT / "tests/data/projects/shaper.toml"


def mean_of_lever(problem: Problem, count: int) -> float:
    """Return the mean power of the balancing moment over a turn, W: inertia takes none of it."""
    step = 360.0 / count
    positions = [problem.drive.positions[0] + step * (k + 0.5) for k in range(count)]
    solution = Solution(problem, positions=positions)
    return float(np.mean(statics_of(solution).balance) * problem.drive.rate)


def test_the_mean_power_is_that_of_the_balancing_moments() -> None:
    problem = load(SHAPER)
    power = machine_power(Flywheel(problem))
    # A force that sets in between two positions makes the mean coarse: 1/count of its part.
    assert power.at_crank == pytest.approx(abs(mean_of_lever(problem, 2000)), rel=2e-3)


def with_train(gears: str) -> Problem:
    """Return the shaper, its crank driven by another train."""
    text = SHAPER.read_text("utf-8")
    head, _, rest = text.replace("n = 60\n", 'train = "5"\n', 1).partition("[gears]")
    after = rest[rest.index("\n[") :]
    return loads(f"{head}[gears]\n{gears}\n{after}", name="driven")


PLANETARY = """\
wheels = {{ 1 = 20, 2 = 40, "2'" = 24, 3 = 84, 4 = 14, 5 = 28 }}
meshes = [
  {{ of = [1, 2], kind = "external", carrier = "H"{one} }},
  {{ of = ["2'", 3], kind = "internal", carrier = "H"{two} }},
  {{ of = [4, 5], kind = "external"{three} }},
]
bodies = [["H", "4"]]
fixed = ["3"]
n = {{ 1 = -1440 }}
"""


def test_the_motor_has_the_power_of_the_crank_over_the_efficiency_of_the_train() -> None:
    given = PLANETARY.format(one=", eta = 0.97", two=", eta = 0.98", three=", eta = 0.95")
    power = machine_power(Flywheel(with_train(given)))
    ratio = 1 + 40 / 20 * 84 / 24  # U of the planetary stage from 1 to H
    stage = (1 + (ratio - 1) * 0.97 * 0.98) / ratio
    assert power.efficiency == pytest.approx(stage * 0.95, rel=1e-12)
    assert power.at_motor == pytest.approx(power.at_crank / (stage * 0.95), rel=1e-12)
    assert power.at_motor is not None
    assert power.rated == 1000 * min(p for p in RATED_KW if 1000 * p >= power.at_motor)


def test_a_train_without_all_efficiencies_chooses_no_motor() -> None:
    given = PLANETARY.format(one=", eta = 0.97", two="", three=", eta = 0.95")
    power = machine_power(Flywheel(with_train(given)))
    assert (power.efficiency, power.at_motor, power.rated) == (None, None, None)


TRAIN = """
title = "Train"
[gears]
wheels = { 1 = 20, 2 = 40, 3 = 25, 4 = 50 }
meshes = [{ of = [1, 2], eta = 0.9 }, { of = [3, 4]SECOND }]
bodies = [["2", "3"]]
n = { 1 = 100 }
OUTPUT
"""


@pytest.mark.parametrize(
    ("second", "output", "value"),
    [
        (", eta = 0.8", 'output = "4"', 0.72),
        (", eta = 0.8", 'output = "2"', None),
        ("", 'output = "4"', None),
        (", eta = 0.8", "", None),
    ],
)
def test_given_efficiencies_are_used_or_reported(
    tmp_path: Path, second: str, output: str, value: float | None
) -> None:
    path = tmp_path / "train.toml"
    path.write_text(TRAIN.replace("SECOND", second).replace("OUTPUT", output), "utf-8")
    done = CliRunner().invoke(cli, ["solve", str(path), "--json"])
    asked = json.loads(done.stdout)["gears"]["asked"]
    if output == 'output = "2"':
        assert asked["eta"]["value"] == pytest.approx(0.9, rel=1e-12)
    else:
        assert asked["eta"]["value"] == (value and pytest.approx(value, rel=1e-12))
    if value is None and output != 'output = "2"':
        assert "efficiency of every mesh" in CliRunner().invoke(cli, ["solve", str(path)]).stdout
