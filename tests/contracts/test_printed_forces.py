"""Printed forces of the textbooks beside values computed apart from the plans, with 50 digits."""

from __future__ import annotations

import json
from functools import cache
from typing import Any

import pytest
from doors import Solution, audit, parse_quantity, statics_of
from worked import ROOT, path_of, problem_of


@cache
def computed() -> dict[str, Any]:
    values: dict[str, Any] = json.loads(
        (ROOT / "tests/data/published-forces.json").read_text("utf-8")
    )
    return values


NAMES = list(computed()["printed"])


@pytest.mark.parametrize("name", NAMES)
def test_exact_values_of_printed_forces(name: str) -> None:
    found = {item.published.name: item.exact for item in audit(problem_of(name))}
    for what, value in computed()["printed"][name].items():
        assert found[what] == pytest.approx(value, rel=1e-9, abs=1e-9), what


@pytest.mark.parametrize("name", NAMES)
def test_no_printed_force_is_left_unchecked(name: str) -> None:
    forces = {
        item.name
        for item in problem_of(name).published
        if item.what and parse_quantity(item.what).is_loaded
    }
    assert forces <= set(computed()["printed"][name]), path_of(name)


def test_every_file_with_loads_is_checked() -> None:
    assert set(NAMES) == {"levers/six-link", "levers/task12", "press/press", "press/press-stone"}


def test_forces_of_the_press_with_a_sliding_block() -> None:
    statics = statics_of(Solution(problem_of("press/press-stone")))
    wanted = computed()["stone"]
    found = {}
    for joint in statics.reactions:
        force = complex(joint.force[0])
        found[f"{joint.on} {joint.by}"] = force
        found[f"{joint.by} {joint.on}"] = -force
        assert abs(joint.moment[0]) <= 1e-9  # all forces on a sliding block go through its pin
    largest = max(abs(complex(*pair)) for pair in wanted["reactions"].values())
    assert len(statics.reactions) == len(wanted["reactions"])
    for joint_, pair in wanted["reactions"].items():
        assert abs(found[joint_] - complex(*pair)) <= 1e-9 * largest, joint_
    assert statics.balance[0] == pytest.approx(wanted["balance"], rel=1e-9)
    assert statics.lever is not None
    assert statics.lever[0] == pytest.approx(wanted["balance"], rel=1e-9)
