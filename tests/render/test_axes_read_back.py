"""Axes of all diagrams read back: the k-th number is k steps from their crossing."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from math import degrees
from typing import NamedTuple

import numpy as np
import pytest
from cases import each
from doors import (
    AXIS,
    DIAGRAM_CURVE as CURVE,
    BlockOptions,
    BlockSpec,
    BlockStyle,
    DrawingItem as Item,
    Sizes,
    SizeTable,
    Solution,
    Stroke,
    Text,
    flywheel_of,
    get_language,
    ink_bounds,
    maker_of,
    run_up_of,
)
from worked import problem_of

EN = get_language("en")
TURN = tuple(98.918918918919 + 30.0 * k for k in range(12))

BLOCKS = (
    ("run-up-diagrams", "machines/compressor", None),
    ("speed-diagram", "press/flywheel", None),
    ("flywheel-diagrams", "press/flywheel", None),
    ("load-diagram", "press/flywheel", None),
    ("load-curves", "press/press", None),
    ("kinematic-diagrams", "press/flywheel", None),
    ("graphs", "press/flywheel", None),
    ("balance-diagram", "press/press", TURN),
    ("reaction-diagram", "press/press", TURN),
)


class Axes(NamedTuple):
    """The axes of one diagram, mm from their crossing: ticks, numbers and the curves."""

    name: str
    ticks: list[float]
    across: list[tuple[float, str]]
    up: list[tuple[float, float]]
    curves: list[complex]


@cache
def solution_of(name: str, positions: tuple[float, ...] | None) -> Solution:
    return Solution(problem_of(name), positions=positions)


@cache
def axes_of(kind: str, name: str, positions: tuple[float, ...] | None) -> list[Axes]:
    """Return the axes of the diagrams of a block."""
    solution = solution_of(name, positions)
    extras = BlockOptions(EN, quantities=("v_B", "a_B"))
    manner = BlockStyle(BlockSpec(kind), Sizes(5.0, 5.0, 5.0, 240.0), 800.0, extras)
    block = maker_of(kind)(solution, tuple(range(len(solution.positions))), manner)
    return list(read_axes(getattr(block, "shapes", [block])[0].place(0j)))


def number_of(text: str) -> float:
    return float(text.replace("−", "-").replace(",", "."))


def read_axes(items: Sequence[Item]) -> Iterator[Axes]:
    """Yield the axes among items, with their inscriptions."""
    lines = [one.points for one in items if isinstance(one, Stroke) and one.tag == AXIS]
    level = [pair for pair in lines if pair[0].imag == pytest.approx(pair[-1].imag, abs=1e-9)]
    upright = [pair for pair in lines if pair[0].real == pytest.approx(pair[-1].real, abs=1e-9)]
    texts = [one for one in items if isinstance(one, Text)]
    middles = [complex(*_middle(one)) for one in texts]
    for start, end in level:
        if abs(end - start) < 5.0:
            continue  # a tick of the other axis
        ticks = sorted(
            (one.real - start.real)
            for one, two in upright
            if abs((one + two).imag / 2.0 - start.imag) < 1e-6
            and start.real - 1.0 < one.real < end.real
        )
        if not ticks:
            continue
        low, high = next(
            (one.imag, two.imag)
            for one, two in upright
            if abs(one.real - start.real) < 1e-6
            and abs(two - one) > 5.0
            and one.imag - 0.1 < start.imag < two.imag
        )
        heights = [
            one.imag
            for one, two in level
            if abs(two - one) < 5.0
            and abs((one + two).real / 2.0 - start.real) < 1e-6
            and low - 1.0 < one.imag < high
        ]
        across = [
            (at.real - start.real, text)
            for text, at in zip(texts, middles, strict=True)
            if ": position " in text.label
            and abs(at.imag - start.imag) < 9.0
            and start.real - 3.0 < at.real < end.real
        ]
        up = [
            (height - start.imag, number_of(text.text))
            for height in heights
            for text in texts
            if abs(text.at.imag + text.height / 2.0 - height) < 1e-3
            and start.real - 25.0 < text.at.real < start.real
        ]
        curves = [
            point - start
            for one in items
            if isinstance(one, Stroke) and one.tag.startswith(CURVE)
            for point in one.points
            if start.real - 1.0 < point.real < end.real and low - 1.0 < point.imag < high
        ]
        name = across[0][1].label.partition(":")[0] if across else ""
        yield Axes(name, ticks, [(x, text.text) for x, text in across], up, curves)


def _middle(text: Text) -> tuple[float, float]:
    left, low, right, high = ink_bounds([text])
    return (left + right) / 2.0, (low + high) / 2.0


@each("kind, name, positions", BLOCKS)
def test_numbers_are_at_their_ticks_and_ordinates_in_proportion_to_height(
    kind: str, name: str, positions: tuple[float, ...] | None
) -> None:
    found = axes_of(kind, name, positions)
    assert found
    for axes in found:
        nearest = [int(np.argmin(np.abs(np.array(axes.ticks) - x))) for x, _ in axes.across]
        assert len({*nearest}) == len(nearest)
        assert all(
            abs(axes.ticks[k] - x) < 6.5 for k, (x, _) in zip(nearest, axes.across, strict=True)
        )
        if axes.up:
            height, value = max(axes.up, key=lambda pair: abs(pair[0]))
            for y, told in axes.up:
                assert told == pytest.approx(value * y / height, rel=2e-3), (axes.name, axes.up)
    assert sum(len(axes.across) for axes in found) > 1


@each("kind, name, positions", [block for block in BLOCKS if block[0] not in
                                ("run-up-diagrams", "load-diagram", "load-curves")])  # fmt: skip
def test_the_number_of_a_position_is_at_the_rotation_of_the_crank(
    kind: str, name: str, positions: tuple[float, ...] | None
) -> None:
    for axes in axes_of(kind, name, positions):
        first, last = axes.ticks[0], axes.ticks[-1]
        for x, text in axes.across:
            tick = min(axes.ticks, key=lambda at: abs(at - x))
            share = (tick - first) / (last - first)
            assert round(12.0 * share) % 12 == int(text), (axes.name, axes.across)
            assert 12.0 * share == pytest.approx(round(12.0 * share), abs=1e-6)
        assert len(axes.across) >= 11


def test_numbers_of_time_angle_and_speed_are_those_of_the_run_up_and_the_stop() -> None:
    run = run_up_of(flywheel_of(solution_of("machines/compressor", None)))
    stop = run.stop
    assert stop is not None and run.machine.motor is not None
    motor, *courses = axes_of("run-up-diagrams", "machines/compressor", None)
    ends = (
        (float(run.run_up.time[-1]), float(run.run_up.omega.max())),
        (degrees(float(run.run_up.rotation[-1])), float(run.run_up.omega.max())),
        (float(stop.time[-1]), float(stop.omega.max())),
    )
    assert len(courses) == 3
    for axes, (end, speed) in zip(courses, ends, strict=True):
        width = max(point.real for point in axes.curves)
        for x, text in axes.across:
            tick = min(axes.ticks, key=lambda at: abs(at - x))
            assert number_of(text) == pytest.approx(end * tick / width, rel=2e-3), axes.name
        y, value = axes.up[-1]
        assert max(p.imag for p in axes.curves) * value / y == pytest.approx(speed, rel=0.01)
        assert len(axes.across) > 4
    width = max(point.real for point in motor.curves)
    for x, text in motor.across:
        tick = min(motor.ticks, key=lambda at: abs(at - x))
        assert number_of(text) == pytest.approx(run.machine.motor.idle * tick / width, rel=2e-3)


def test_numbers_of_a_load_are_those_of_its_table() -> None:
    (axes,) = axes_of("load-curves", "press/press", None)
    dynamics = problem_of("press/press").dynamics
    assert dynamics is not None
    table = dynamics.loads[0].size
    assert isinstance(table, SizeTable)
    width = max(point.real for point in axes.curves)
    for x, text in axes.across:
        tick = min(axes.ticks, key=lambda at: abs(at - x))
        assert number_of(text) == pytest.approx(360.0 * tick / width, rel=2e-3)
    y, value = axes.up[-1]
    highest = max(point.imag for point in axes.curves) * value / y
    assert highest == pytest.approx(max(table.values), rel=2e-3)
