"""Spread of results over tolerances: against formulas, and against mechanisms with other sizes."""

from __future__ import annotations

import numpy as np
import pytest
from doors import ArgumentError, UnknownNameError, UnknownQuantityError
from pressed import press

import planmethod as pm

POSITIONS = [20.0, 75.0, 140.0, 250.0]


def slider_crank() -> pm.Mechanism:
    m = pm.Mechanism("slider-crank").frame(A=(0, 0), guides={"x-x": ("A", 0)}).drive("1", omega=3)
    m.link("1", A="B", length=0.1).link("2", B="C", length=0.4).slider("3", on="x-x", at="C")
    return m.assemble(C="right of B")


def test_derivatives_are_those_of_the_formula() -> None:
    """For x = r·cos φ + q, q² = l² - r²·sin² φ: ∂x/∂l = l/q, ∂x/∂r = cos φ - r·sin² φ/q."""
    found = slider_crank().tolerance({"AB": 1e-4, "BC": 2e-4}, ["x_C"], POSITIONS)
    phi = np.radians(POSITIONS)
    q = np.sqrt(0.16 - 0.01 * np.sin(phi) ** 2)
    by_rod, by_crank = 0.4 / q, np.cos(phi) - 0.1 * np.sin(phi) ** 2 / q
    assert found.sensitivity["x_C"]["l_BC"] == pytest.approx(by_rod, rel=1e-9)
    assert found.sensitivity["x_C"]["l_AB"] == pytest.approx(by_crank, rel=1e-9)
    worst = np.abs(by_crank) * 1e-4 + np.abs(by_rod) * 2e-4
    assert found.worst["x_C"] == pytest.approx(worst, rel=1e-9)
    sigma = np.hypot(by_crank * 1e-4, by_rod * 2e-4) / np.sqrt(3)
    assert found.sigma["x_C"] == pytest.approx(sigma, rel=1e-9)
    assert found.sampled["x_C"] == pytest.approx(sigma, rel=0.06)
    assert (found.highest["x_C"] - found.nominal["x_C"] <= worst * (1 + 1e-3)).all()


def test_samples_are_mechanisms_with_these_sizes() -> None:
    m = press()
    found = m.tolerance({"AB": 0.002}, ["omega_3"], [60.0], samples=50, seed=7)
    lengths = 0.064 + 0.002 * np.random.default_rng(7).uniform(-1.0, 1.0, 50)
    values = [m.with_(AB=one).solve([60.0]).links["3"].omega[0] for one in lengths.tolist()]
    assert found.highest["omega_3"][0] == pytest.approx(max(values), rel=1e-9)
    assert found.lowest["omega_3"][0] == pytest.approx(min(values), rel=1e-9)
    again = m.tolerance({"AB": 0.002}, ["omega_3"], [60.0], samples=50, seed=7)
    assert again.sampled["omega_3"] == found.sampled["omega_3"]


def test_a_direction_does_not_jump_by_a_turn() -> None:
    m = slider_crank()
    found = m.tolerance({"AB": 1e-3}, ["phi_2"], [0.0])
    assert found.worst["phi_2"][0] < 1.0
    assert found.highest["phi_2"][0] - found.lowest["phi_2"][0] < 1.0


def test_columns_and_repr_name_results_and_sizes() -> None:
    found = slider_crank().tolerance({"AB": 1e-4}, ["x_C"], [30.0])
    names = ["phi_deg", "x_C", *(f"x_C.{one}" for one in ("worst", "sigma", "sampled", "lowest",
             "highest")), "x_C/l_AB"]  # fmt: skip
    assert list(found.to_columns()) == names
    assert repr(found).startswith("Tolerance(slider-crank: l_AB ± 0.0001; x_C ± ")


def test_a_bad_argument_is_named() -> None:
    m = slider_crank()
    with pytest.raises(ArgumentError, match="l_AB"):
        m.tolerance({"AB": 0.0}, ["x_C"], [30.0])
    with pytest.raises(UnknownNameError):
        m.tolerance({"QQ": 0.1}, ["x_C"], [30.0])
    with pytest.raises(UnknownQuantityError):
        m.tolerance({"AB": 0.1}, ["x_Q"], [30.0])
    with pytest.raises(ArgumentError):
        m.tolerance({"AB": 0.01}, ["x_C"], [30.0], samples=0)
