"""The measurements of one's own problem, each taken once: that they run, and their errors."""

from __future__ import annotations

import math
import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from doors import ModelProblem as Problem, Timing, problem_loads as loads, report, speed
from worked import problem_of

from benchmarks import hard_problems
from benchmarks.scenes import FOURBAR_ROWS, fourbar, slotted


def once(act: Callable[[], object], **_: float) -> Timing:
    act()
    return Timing(1e-3, 1e-3, 1e-3, 1)


@pytest.fixture(autouse=True)
def quickly(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(speed, "clock", once)


def test_readings_are_as_good_as_their_digits() -> None:
    for problem in (fourbar(), slotted()):
        errors = {r.name: r.error for r in speed.single_readings(problem)}
        assert errors["step by step, float64"] < 2e-15
        assert errors["referee, 30 digits"] < 1e-28
        assert errors["referee, 50 digits"] < 1e-48
        assert 1e-6 < errors["the hand, ruler 0.1 mm"] < errors["the hand, ruler 1 mm"] < 0.1


@pytest.mark.parametrize(("problem", "asked"), [(fourbar(), FOURBAR_ROWS), (slotted(), None)])
def test_sweeps_are_good_to_four_units(
    problem: Problem, asked: list[str] | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if asked:  # else without machine code, and the row has the reason
        monkeypatch.setenv("PLANMETHOD_NATIVE", "1")
        monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    readings = speed.sweeps(problem, (12, 5000), asked)
    for reading in readings:
        limit = 5e-6 if reading.name.endswith("32") else 4e-15
        assert math.isnan(reading.error) or reading.error < limit, reading
    judged = {r.name for r in readings if not math.isnan(r.error)}
    code = {"sweep, machine code", "sweep, bound call"}
    assert judged >= (code if asked and shutil.which("cc") else {"sweep, float64"})
    told = report.timed(readings)
    assert asked or any("machine code: PLANMETHOD_NATIVE=0" in line for line in told)


def test_positions_are_those_of_the_file_where_the_driver_cannot_turn_round() -> None:
    crank = problem_of("linkages/ex3")
    rocker = loads(hard_problems.rocker(phi=110.0, by_rocker=True), name="rocker")
    assert np.ptp(speed.places(crank, 12)) == pytest.approx(330)
    assert list(speed.places(rocker, 3)) == [110.0] * 3


def test_times_are_printed_in_their_unit() -> None:
    assert [report.span(s) for s in (2.5, 0.0123, 4.2e-6, 3e-9)] == [
        "2.5 s", "12.3 ms", "4.2 µs", "3 ns",
    ]  # fmt: skip
