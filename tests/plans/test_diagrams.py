"""Graphical calculus: the result of the construction agrees with its definition."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from doors import (
    DiagramAxes,
    DiagramBoard,
    DrawnDiagram,
    Float64,
    Integration,
    PointName,
    differentiate,
    evaluate_evaluate as evaluate,
    integrate,
    repeated,
)

AT = [0.0, 20.0, 45.0, 60.0, 96.0]
"""Uneven on purpose."""

HEIGHTS = [3.0, -7.0, 12.0, 30.0, 3.0]


def plotted() -> tuple[DiagramBoard, DiagramAxes, list[PointName]]:
    board = DiagramBoard()
    axes = board.axes("s")
    points = [
        board.plot(f"s {k}", axes, x, board.known(f"s{k}", y))
        for k, (x, y) in enumerate(zip(AT, HEIGHTS, strict=True))
    ]
    return board, axes, points


def heights(board: DiagramBoard, points: list[PointName], axis: float) -> list[float]:
    trace = evaluate(board.b.program(), board.data, Float64())
    return [float(trace.value[point].imag) - axis for point in points]


def test_chords_give_the_slope_times_the_pole_distance_and_the_period_goes_on() -> None:
    board, _, points = plotted()
    below = board.axes("v", -100j)
    middles = [(a + b) / 2 for a, b in pairwise(AT)]
    made = differentiate(
        board, list(pairwise(points)), below, middles, pole=board.pole(below, 36.0)
    )
    slopes = 36.0 * np.diff(HEIGHTS) / np.diff(AT)
    assert heights(board, made, -100.0) == pytest.approx(slopes)
    end = board.abscissa(below, AT[-1])
    before = repeated(board, "before", made[-1], end, below.origin)
    trace = evaluate(board.b.program(), board.data, Float64())
    assert trace.value[before] == pytest.approx(trace.value[made[-1]] - AT[-1])


@pytest.mark.parametrize("way", Integration)
def test_integration_adds_the_areas_of_the_intervals(way: Integration) -> None:
    board, over, points = plotted()
    below, pole = board.axes("A", -100j), board.pole(over, 30.0)
    widths = np.diff(AT)
    if way is Integration.MIDDLE:
        points = [
            board.plot(f"m {k}", over, (a + b) / 2, board.known(f"m{k}", HEIGHTS[k]))
            for k, (a, b) in enumerate(pairwise(AT))
        ]
        areas = np.array(HEIGHTS[:-1]) * widths
    else:
        areas = (np.array(HEIGHTS[:-1]) + HEIGHTS[1:]) / 2 * widths
    made = integrate(board, DrawnDiagram(over, points), below, AT, pole=pole, method=way)
    found = heights(board, made, -100.0)
    assert found == pytest.approx([0.0, *np.cumsum(areas) / 30.0])
