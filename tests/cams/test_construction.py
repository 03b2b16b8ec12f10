"""The construction: against the exact cam, by 50 digits, its errors against random sheets."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cams import SHIPPED

from planmethod.cams.construction import FREE, CamConstruction, construct
from planmethod.cams.design import CamDesign
from planmethod.cams.reader import load
from planmethod.construct.drafting import PROFILES, Sampled
from planmethod.construct.evaluate import evaluate
from planmethod.construct.referee import Precise
from planmethod.construct.steps import NumberName

BUILT = {path.stem: construct(CamDesign(load(path))) for path in SHIPPED}


def number(built: CamConstruction, name: str) -> complex:
    return complex(np.ravel(built.exact.value[NumberName(name)])[0])


@pytest.mark.parametrize("built", BUILT.values(), ids=BUILT)
def test_what_is_drawn_is_near_what_is_exact(built: CamConstruction) -> None:
    """By chords of 12 parts: s and profile within 3 % of the stroke, sizes 10 % of r_min."""
    near = 0.03 * built.design.problem.stroke
    problem, geometry = built.design.problem, built.design.geometry
    assert len(built.nodes) >= 24
    for node in built.nodes:
        s = number(built, f"s_{{{node.number}}}").real * built.scales.s
        exact = float(problem.at(np.array([min(node.phi, 2 * np.pi - 1e-9)]))[0, 0])
        assert s == pytest.approx(exact, abs=near)
    sizes = {"r_min": geometry.r_min, "e": geometry.e, "centre_distance": geometry.centre}
    for name, of in built.results.items():
        read = number(built, of).real
        assert read == pytest.approx(sizes[name], abs=0.1 * geometry.r_min)
    points = [number(built, f"B_{{{node.number}}}") for node in built.nodes]
    off = np.abs(np.array(points) - built.exact_points()) * built.scales.profile
    assert off.max() < near
    assert number(built, "R_{0}").real * built.scales.profile == pytest.approx(geometry.r_min)


def test_constant_acceleration_is_integrated_without_an_error_of_the_method(tmp_path: Path) -> None:
    text = (
        '[cam]\nfollower = "translating"\nstroke = 0.04\nrise = 120\nreturn = 120\n'
        'law = "constant-acceleration"\npressure = { rise = 30, return = 45 }\n'
    )
    (tmp_path / "even.toml").write_text(text, "utf-8")
    design = CamDesign(load(tmp_path / "even.toml"))
    built = construct(design)
    for node in built.nodes:
        s = number(built, f"s_{{{node.number}}}").real * built.scales.s
        assert s == pytest.approx(float(design.problem.at(np.array([node.phi]))[0, 0]), abs=1e-12)
    # The greatest v_q is drawn, and there the limit of the rise binds: the axis is the exact one.
    of = built.results
    assert number(built, of["r_min"]).real == pytest.approx(design.geometry.r_min, rel=2e-3)


@pytest.mark.parametrize("name", ["offset", "oscillating"])
def test_fifty_digits_read_the_same(name: str) -> None:
    built = BUILT[name]
    precise = evaluate(built.program, built.data, Precise()).value
    for key, of in built.results.items():
        assert float(precise[of]) == pytest.approx(number(built, of).real, rel=1e-12), key
    for node in built.nodes:
        of = NumberName(f"R_{{{node.number}}}")
        assert float(precise[of]) == pytest.approx(number(built, of).real, rel=1e-12)


@pytest.mark.parametrize("name", ["offset", "oscillating", "flat"])
def test_sigma_is_that_of_random_sheets(name: str) -> None:
    built = BUILT[name]
    profile = PROFILES["board"]
    sigma = built.sigma(profile)
    drawn = evaluate(built.program, built.data, Sampled(profile, FREE, 3000, 7)).value
    asked = [*built.results.values(), *(f"R_{{{node.number}}}" for node in built.nodes)]
    for of in asked:
        spread = float(np.nanstd(drawn[NumberName(of)]))
        assert sigma[of] == pytest.approx(spread, rel=0.1), of
