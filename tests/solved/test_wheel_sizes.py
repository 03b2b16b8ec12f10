"""Sizes of a flywheel, and the note on one that is wide for its diameter."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner
from doors import WIDEST, FlywheelTask, WheelShape, cli, size_of, too_wide
from msgspec.structs import replace
from worked import path_of

INERTIA, OMEGA = 0.273, 314.0
SLOW = FlywheelTask(speed=30.0)


def test_steel_runs_quicker_than_cast_iron() -> None:
    assert FlywheelTask().greatest_speed == 50.0
    assert FlywheelTask(density=7850.0).greatest_speed == 50.0
    assert FlywheelTask(density=7200.0).greatest_speed == 30.0
    assert FlywheelTask(density=7200.0, speed=12.0).greatest_speed == 12.0
    usual = size_of(FlywheelTask(), INERTIA, OMEGA)
    assert usual is not None
    assert not usual.is_speed_limited
    assert too_wide(FlywheelTask(), INERTIA, OMEGA) is None


@pytest.mark.parametrize("shape", WheelShape)
def test_a_flywheel_wider_than_usual_is_reported_with_a_remedy(shape: WheelShape) -> None:
    task = replace(SLOW, shape=shape)
    said = too_wide(task, INERTIA, OMEGA)
    assert said is not None
    for key, pattern in (("speed", r"speed = (\d+)"), ("ratio", r"ratio = ([\d.]+\d)")):
        found = re.search(pattern, said)
        assert found is not None
        other = size_of(replace(task, **{key: float(found[1])}), INERTIA, OMEGA)
        assert other is not None
        assert other.width < 0.21 * other.diameter, key


def test_a_slight_limit_by_the_speed_of_the_rim_is_not_reported() -> None:
    free = size_of(FlywheelTask(), INERTIA, OMEGA)
    assert free is not None
    task = FlywheelTask(speed=0.9 * free.speed)
    sizes = size_of(task, INERTIA, OMEGA)
    assert sizes is not None
    assert sizes.is_speed_limited
    assert sizes.width < WIDEST * sizes.diameter
    assert too_wide(task, INERTIA, OMEGA) is None
    assert too_wide(SLOW, 0.0, OMEGA) is None


def test_solve_and_the_sheet_of_the_flywheel_report_it(tmp_path: Path) -> None:
    text = path_of("machines/engine").read_text("utf-8")
    path = tmp_path / "engine.toml"
    path.write_text(text.replace("[machine]", "[machine]\nflywheel.speed = 20"), "utf-8")
    out = ["-o", str(tmp_path), "--format", "svg"]
    for args in (["solve", "--json"], ["sheet", "--layout", "flywheel", *out]):
        done = CliRunner().invoke(cli, [*args, str(path), "--lang", "en"])
        assert done.exit_code == 0, done.output
        assert "the flywheel is" in done.stderr
    done = CliRunner().invoke(cli, ["solve", str(path_of("machines/engine")), "--json"])
    assert not done.stderr
