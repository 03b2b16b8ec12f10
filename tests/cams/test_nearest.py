"""The point nearest to the origin that keeps to half-planes, against all their corners."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from doors import nearest_to_origin
from numpy.typing import NDArray


def brute(normals: NDArray[np.float64], bounds: NDArray[np.float64]) -> float | None:
    """Return the distance of the nearest of all feet and corners that keep to all half-planes."""
    points = [np.zeros(2), *(n * b / (n @ n) for n, b in zip(normals, bounds, strict=True))]
    for i, j in combinations(range(len(normals)), 2):
        pair = normals[[i, j]]
        if abs(np.linalg.det(pair)) > 1e-9:
            points.append(np.linalg.solve(pair, bounds[[i, j]]))
    kept = [p for p in points if np.all(normals @ p <= bounds + 1e-10)]
    return min((float(np.hypot(*p)) for p in kept), default=None)


@pytest.mark.parametrize("seed", range(40))
def test_the_nearest_point_is_that_of_all_feet_and_corners(seed: int) -> None:
    luck = np.random.default_rng(seed)
    angles = luck.uniform(0.0, luck.choice([2.0, 4.0, 6.3]), 30)
    normals = np.exp(1j * angles).view(float).reshape(-1, 2) * luck.uniform(0.5, 2.0, (30, 1))
    bounds = luck.normal(luck.choice([-1.0, 0.0, 0.5]), 0.5, 30)
    found, expected = nearest_to_origin(normals, bounds), brute(normals, bounds)
    assert (found is None) == (expected is None)
    if found is not None and expected is not None:
        assert np.all(normals @ found <= bounds + 1e-10)
        assert np.hypot(*found) == pytest.approx(expected, abs=1e-9)


def test_many_half_planes_take_no_memory_of_their_pairs() -> None:
    angles = np.linspace(0.5, 2.5, 4000)  # 8 million corners
    normals = np.array([np.cos(angles), np.sin(angles)]).T
    found = nearest_to_origin(normals, np.full(len(angles), -1.0))
    assert found is not None
    assert np.max(normals @ found) == pytest.approx(-1.0, abs=1e-9)
