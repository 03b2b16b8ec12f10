"""Roots and greatest values of functions of the angle, and polynomials in their place."""

from __future__ import annotations

import numpy as np
import pytest
from cases import each
from doors import crossings, curve_root, resolved, roots, roots_between, top

GRID = np.linspace(0.05, 6.33, 90)
NAN = np.nan


@each(
    "values, found",
    [
        ([1.0, 2.0, -1.0], [1]),
        ([1.0, 0.0, -1.0], [1]),  # a zero counts with the value before it
        ([1.0, 0.0, 1.0], []),
        ([0.0, 0.0, -1.0, 1.0], [2]),
        ([1.0, NAN, -1.0, 1.0], [2]),  # a gap is not a change
        ([NAN, NAN], []),
    ],
)
def test_a_change_of_sign_is_between_two_values(values: list[float], found: list[int]) -> None:
    assert crossings(np.array(values)).tolist() == found


def test_roots_have_all_digits_and_stand_in_order() -> None:
    found = roots(lambda at: np.sin(3.0 * at), GRID)
    assert found == pytest.approx(np.pi / 3.0 * np.arange(1, 7), rel=4e-16)
    assert roots(lambda at: 2.0 + np.sin(at), GRID).size == 0


def test_each_pair_has_its_own_function() -> None:
    levels = np.array([0.25, 0.5, 0.75])
    found = roots_between(lambda at: at**2 - levels[:, np.newaxis], np.zeros(3), np.ones(3))
    assert found == pytest.approx(np.sqrt(levels), rel=1e-15)


def test_a_root_may_be_the_edge_of_the_domain_or_an_end() -> None:
    with np.errstate(invalid="ignore"):
        edge = curve_root(lambda at: np.sqrt(2.0 - at), 3.0, 1.0)
    assert edge == pytest.approx(2.0, rel=1e-15)
    assert curve_root(lambda at: at - 1.0, 0.0, 1.0) == 1.0


def test_the_greatest_value_is_found_from_its_surroundings() -> None:
    at, size = top(np.cos, -0.4, 0.5)
    assert at == pytest.approx(0.0, abs=1e-9)
    assert size == pytest.approx(1.0, abs=1e-15)


def test_polynomials_have_the_roots_peaks_and_integrals_of_their_function() -> None:
    edges = np.linspace(0.0, 2.0 * np.pi, 4)
    made = resolved(lambda at: np.stack([np.exp(np.sin(at))], axis=1), edges)
    level = 1.3
    assert made.roots(level) == pytest.approx(
        roots(lambda at: np.exp(np.sin(at)) - level, GRID), rel=1e-12
    )
    assert made.peak() == pytest.approx((np.pi / 2.0, np.e), rel=1e-11)
    assert made.slope.value(GRID[:-3]) == pytest.approx(
        np.cos(GRID[:-3]) * np.exp(np.sin(GRID[:-3])), abs=1e-10
    )
    assert made.integral.value([2.0 * np.pi])[0] == pytest.approx(7.954926521012845, rel=1e-12)
