"""Relative motion of two points, and components by the crank's angle, requested by name."""

from __future__ import annotations

import re

import numpy as np
import pytest
from cases import each, some
from doors import (
    PlanKind,
    Solution,
    Sweep,
    UnknownQuantityError,
    problem_load as load,
    problem_loads as loads,
)
from worked import path_of

from benchmarks.generator import random_problem
from planmethod.note.tables.errors import relative_series


@each("seed", range(some(30, few=10)))
def test_two_points_of_a_link_by_the_motion_of_each(seed: int) -> None:
    """The motion of a point is checked elsewhere; ω, ε and the distance give aⁿ and a^τ."""
    problem = loads(random_problem(seed)[0], name="random")
    positions = problem.drive.positions[0] + (
        np.array([0.0, 2.0, 5.0]) if problem.drive.revolves else np.array([0.0, 1e-4, 2e-4])
    )
    for link, body in problem.bodies.items():
        if link == "0" or len(body.points) < 2:
            continue
        b, a = list(body.points)[:2]
        whole = Sweep(problem).table(positions)
        found = Sweep(problem, [f"v_{b}_{a}", f"a {b} {a}", f"an_{b}_{a}", f"at_{b}_{a}"]).table(
            positions
        )
        for end in ("vx", "vy", "ax", "ay"):
            difference = whole[f"{b}.{end}"] - whole[f"{a}.{end}"]
            size = np.abs(whole[f"{b}.{end}"]) + np.abs(whole[f"{a}.{end}"]) + 1e-9
            assert found[f"{b}_{a}.{end}"] == pytest.approx(
                difference, abs=1e-9 * np.nanmax(size), nan_ok=True
            )
        x, y = (whole[f"{b}.{axis}"] - whole[f"{a}.{axis}"] for axis in "xy")
        there = np.isfinite(x)
        rate, change = whole[f"{link}.omega"], whole[f"{link}.epsilon"]
        for name, part in (("an", rate**2), ("at", change)):
            size = part * np.hypot(x, y)
            assert found[f"{name}_{b}_{a}"][there] == pytest.approx(size[there], rel=1e-9, abs=1e-9)


@each("epsilon", [0.0, 35.0])
def test_components_by_the_angle_of_the_crank(epsilon: float) -> None:
    """Against differences of the place over the angle: whatever the rate and ε are."""
    text = re.sub("epsilon = .*", f"epsilon = {epsilon}", random_problem(4)[0])
    problem, point = loads(text, name="random"), "D"
    positions = problem.drive.positions[0] + np.array([0.0, 2.0, 5.0])
    labels = [f"{letter}_q{axis}_{point}" for letter in "va" for axis in "xy"]
    found = Sweep(problem, labels).table(positions)
    step = 1e-3
    near = [
        Sweep(problem, [point]).table(positions + np.degrees(k * step)) for k in (-2, -1, 0, 1, 2)
    ]
    for axis in "xy":
        p = [table[f"{point}.{axis}"] for table in near]
        first = (p[0] - 8 * p[1] + 8 * p[3] - p[4]) / (12 * step)
        second = (-p[0] + 16 * p[1] - 30 * p[2] + 16 * p[3] - p[4]) / (12 * step**2)
        assert found[f"v_q{axis}_{point}"] == pytest.approx(first, abs=1e-9)
        assert found[f"a_q{axis}_{point}"] == pytest.approx(second, abs=1e-7)


def test_points_that_no_link_joins_have_no_normal_acceleration() -> None:
    problem = loads(random_problem(4)[0], name="random")
    with pytest.raises(UnknownQuantityError):
        Sweep(problem, ["an_A_D"])


@each("file", ["press/press", "linkages/ex1", "levers/six-link"])
def test_tables_of_many_positions_have_the_vectors_between_points(file: str) -> None:
    """Their values are those of the points, their readings within five errors of them."""
    problem = load(path_of(file))
    positions = problem.drive.positions[0] + np.array([0.0, 4.0, 9.0])
    solution = Solution(problem, positions=positions.tolist())
    whole, found = Sweep(problem).table(positions), 0
    for one in relative_series(solution, PlanKind.VELOCITY):
        names = problem.names_of_letters
        head, tail = (names.get(p, p) for p in re.findall(r"[A-Z][0-9]?", one.symbol))
        x, y = (whole[f"{head}.v{axis}"] - whole[f"{tail}.v{axis}"] for axis in "xy")
        assert one.exact == pytest.approx(np.hypot(x, y), rel=1e-9)
        assert np.all(np.abs(one.off) <= 5.0 * np.asarray(one.sigma))
        found += 1
    assert found
    symbols = {one.symbol for one in relative_series(solution, PlanKind.ACCELERATION)}
    assert any(symbol.startswith("a^{n}") for symbol in symbols)
