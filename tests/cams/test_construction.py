"""The construction: against the exact cam, by 50 digits, its errors against random sheets."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from cams import SHIPPED, designed
from doors import (
    DRAFTING_PROFILES as PROFILES,
    FREE,
    CamConstruction,
    CamDesign,
    NumberName,
    Precise,
    Sampled,
    cams_construction_construct as construct,
    cams_reader_load as load,
    evaluate_evaluate as evaluate,
    get_language,
    motion_in_division,
    text_given_facts as given_facts,
)
from msgspec.structs import replace

BUILT = {path.stem: construct(CamDesign(load(path))) for path in SHIPPED}


def number(built: CamConstruction, name: str) -> complex:
    return complex(np.ravel(built.exact.value[NumberName(name)])[0])


@pytest.mark.parametrize("built", BUILT.values(), ids=BUILT)
def test_drawn_values_are_near_exact_ones(built: CamConstruction) -> None:
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


PLATE = {
    "follower": "oscillating", "contact": "flat", "swing": 15, "arm": 0.1, "centre": 0.12,
    "rise": 100, "upper_dwell": 30, "return": 150, "law": "3-4-5", "n": 120, "parts": 24,
}  # fmt: skip


@pytest.mark.parametrize("n", [120, -120])
@pytest.mark.parametrize("curvature", [0.0, 0.01])
def test_a_plate_on_an_arm_has_its_least_distance_by_drawing(
    n: int, curvature: float, tmp_path: Path
) -> None:
    found = []
    for sense in ("opposite", "same"):
        design = designed(tmp_path, PLATE | {"sense": sense, "n": n, "curvature": curvature})
        built = construct(design)
        of = built.results["r_min"]
        read, exact = number(built, of).real, design.geometry.r_min
        assert read == pytest.approx(exact, rel=0.02)
        precise = evaluate(built.program, built.data, Precise()).value
        assert float(precise[of]) == pytest.approx(read, rel=1e-12)
        # The least radius of curvature of the drawn cam is the requested one.
        drawn = replace(design.geometry, r_min=read)
        rho = 1 / drawn.at(np.linspace(0.0, 2 * np.pi, 2001)).curvature
        assert rho.min() == pytest.approx(curvature, abs=0.003)
        found.append(exact)
    assert abs(found[0] - found[1]) > 1e-3  # rise and return change places


def test_sigma_of_the_least_distance_is_that_of_random_sheets(tmp_path: Path) -> None:
    built = construct(designed(tmp_path, PLATE | {"curvature": 0.01}))
    profile, of = PROFILES["board"], built.results["r_min"]
    drawn = evaluate(built.program, built.data, Sampled(profile, FREE, 3000, 7)).value
    assert built.sigma(profile)[of] == pytest.approx(float(np.nanstd(drawn[of])), rel=0.1)


@pytest.mark.parametrize("follower", ["translating", "oscillating"])
def test_a_given_distance_of_a_plate_is_not_constructed(follower: str, tmp_path: Path) -> None:
    moving = {"follower": "translating", "stroke": 0.03} if follower == "translating" else {}
    left_out = ("swing", "arm", "centre", "sense") if moving else ()
    keys = {key: value for key, value in PLATE.items() if key not in left_out} | moving
    design = designed(tmp_path, keys | {"r_min": 0.05, "curvature": 0.008})
    assert not construct(design).results
    # It is given, with the letter that it has in the table, and so is the allowed radius.
    told = "; ".join(fact.text for fact in given_facts(design.problem, get_language("ru")))
    assert "r_{0} = 50 мм" in told and "[ρ] = 8 мм" in told and "r_{min}" not in told


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


@pytest.mark.parametrize("name", list(BUILT))
def test_sigma_is_that_of_random_sheets(name: str) -> None:
    built = BUILT[name]
    profile = PROFILES["board"]
    sigma = built.sigma(profile)
    drawn = evaluate(built.program, built.data, Sampled(profile, FREE, 3000, 7)).value
    asked = [*built.results.values(), *(f"R_{{{node.number}}}" for node in built.nodes)]
    for of in asked:
        spread = float(np.nanstd(drawn[NumberName(of)]))
        assert sigma[of] == pytest.approx(spread, rel=0.1), of


ROLLERS = {name: built for name, built in BUILT.items() if built.design.geometry.roller}


@pytest.mark.parametrize("built", ROLLERS.values(), ids=ROLLERS)
def test_a_roller_touches_the_profile_on_the_side_of_the_cam(built: CamConstruction) -> None:
    """By the chords the normal is some degrees off; on the other side it were two radii."""
    geometry, per_mm = built.design.geometry, built.scales.profile
    for node in built.nodes:
        moved = motion_in_division(built.design.problem, node)
        (exact,) = geometry.points(np.array([node.phi]), np.array([moved]).T).actual / per_mm
        drawn = number(built, f"A_{{{node.number}}}")
        assert abs(drawn - exact) < 0.3 * geometry.roller / per_mm, node
        centre = number(built, f"B_{{{node.number}}}")
        assert abs(drawn - centre) == pytest.approx(geometry.roller / per_mm)
