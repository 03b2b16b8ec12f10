"""The measurements of the forces, each taken once: that they run, and their errors."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from doors import Solution, Timing, crank_angles, forces, statics_of
from worked import problem_of

from benchmarks import at_once
from benchmarks.scenes import loaded


def once(act: Callable[[], object], **_: float) -> Timing:
    act()
    return Timing(1e-3, 1e-3, 1e-3, 1)


@pytest.fixture(autouse=True)
def quickly(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(forces, "clock", once)
    monkeypatch.setattr(at_once, "clock", once)


def test_readings_are_as_good_as_their_digits() -> None:
    readings = forces.readings(loaded(), (1, 24))
    for reading in [*readings, *at_once.readings(loaded(), (1, 24))]:
        if reading.positions == 24 and not reading.name.startswith("motion alone"):
            assert reading.error < 2e-14, reading
    errors = {reading.name: reading.error for reading in readings}
    assert errors["referee, 50 digits"] < 1e-48
    assert 1e-5 < errors["the hand, ruler 0.1 mm"] < errors["the hand, ruler 1 mm"] < 0.1


@pytest.mark.parametrize("name", ["press/press", "press/press-stone", "levers/task12"])
def test_all_links_at_once_agree_with_the_force_plans(name: str) -> None:
    statics = statics_of(Solution(problem_of(name), positions=(crank_angles(12) + 5.0).tolist()))
    wanted = [*(joint.force for joint in statics.reactions), statics.balance]
    largest = max(np.abs(row).max() for row in wanted)
    for row, right in zip(at_once.all_at_once(statics), wanted, strict=True):
        assert np.abs(row - right).max() < 1e-12 * largest
