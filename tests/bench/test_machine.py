"""The section on flywheels: a construction's error falls with its positions to that of slopes."""

from __future__ import annotations

import pytest
from doors import Flywheel, constructed, machine_section, problem_load as load
from worked import path_of


def test_constructions_come_to_the_whole_curves_with_more_positions() -> None:
    found = {one.count: one.off for one in constructed(Flywheel(load(path_of("press/flywheel"))))}
    assert found[12][:2] == pytest.approx((-6.706, -14.766), abs=1e-3)
    for k, whole in enumerate(found[None]):
        assert abs(found[144][k] - whole) < 0.2 < abs(found[12][k] - whole)
    assert machine_section([load(path_of("levers/six-link"))]) == []
