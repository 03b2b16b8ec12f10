"""Helical pairs against the formulas of the standard in 40 digits and a spur pair across them."""

from __future__ import annotations

import json
from math import acos, cos, pi, radians, sin, tan
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from cases import each, sampled
from click.testing import CliRunner
from doors import (
    Pair,
    PlanRequest,
    Rack,
    cli,
    inspect,
    involute,
    involute_reader_load as load,
    involute_sheet_drawings as drawings,
)

CASES: tuple[tuple[tuple[int, int], float, tuple[float, float], float], ...] = (
    ((17, 40), 4.0, (0.3, 0.2), 15.0),
    ((12, 30), 5.0, (0.59, 0.53), 8.1),
    ((25, 80), 2.5, (0.0, 0.0), 30.0),
    ((40, 41), 3.0, (-0.2, 0.35), 45.0),
)


def pair_of(case: tuple[Any, ...]) -> Pair:
    z, m, x, degrees = case
    return Pair(z, m, Rack(radians(20)), np.array(x), 0, radians(degrees))


def told(tmp_path: Path, body: str) -> dict[str, Any]:
    run = CliRunner().invoke(cli, ["solve", str(written(tmp_path, body)), "--json"])
    assert run.exit_code == 0, run.output
    found: dict[str, Any] = json.loads(run.output)["meshing"]
    return found


def written(tmp_path: Path, body: str) -> Path:
    path = tmp_path / "pair.toml"
    path.write_text(f"[meshing]\n{body}\n", encoding="utf-8")
    return path


@each("case", CASES)
def test_sizes_are_those_of_the_standard_in_forty_digits(case: tuple[Any, ...]) -> None:
    (z, m, shifts, degrees), pair = case, pair_of(case)
    with mp.workdps(40):
        alpha, beta, module = mp.mpf(radians(20)), mp.mpf(radians(degrees)), mp.mpf(m)
        x = [mp.mpf(one) for one in shifts]

        def inv(angle: Any) -> Any:
            return mp.tan(angle) - angle

        alpha_t = mp.atan(mp.tan(alpha) / mp.cos(beta))
        whole = inv(alpha_t) + 2 * sum(x) * mp.tan(alpha) / sum(z)
        alpha_w = mp.findroot(lambda t: inv(t) - whole, mp.mpf("0.4"))
        a = module * sum(z) / (2 * mp.cos(beta))
        a_w = a * mp.cos(alpha_t) / mp.cos(alpha_w)
        delta = sum(x) - (a_w - a) / module
        facts: list[tuple[str, Any, Any]] = [
            ("alpha_t", pair.alpha_t, alpha_t),
            ("alpha_w", pair.alpha_w, alpha_w),
            ("a_w", pair.a_w, a_w),
            ("delta_y", pair.delta_y + 1, delta + 1),
            ("beta_b", pair.beta_b, mp.asin(mp.sin(beta) * mp.cos(alpha))),
            ("z_min", pair.z_min, 2 * mp.cos(beta) / mp.sin(alpha_t) ** 2),
        ]
        rho_a = []
        for k in (0, 1):
            d = module * z[k] / mp.cos(beta)
            base, tip = d * mp.cos(alpha_t), d + 2 * module * (1 + x[k] - delta)
            angle = mp.acos(base / tip)
            s = module * (mp.pi / 2 + 2 * x[k] * mp.tan(alpha)) / mp.cos(beta)
            s_a = tip * (s / d + inv(alpha_t) - inv(angle))
            lean = mp.atan(tip / d * mp.tan(beta))
            rho_a.append(base * mp.tan(angle) / 2)
            facts += [
                ("d", pair.d[k], d),
                ("d_b", pair.d_b[k], base),
                ("d_a", pair.d_a[k], tip),
                ("d_f", pair.d_f[k], d - 2 * module * (mp.mpf("1.25") - x[k])),
                ("s", pair.s[k], s),
                ("s_na", pair.s_na[k], s_a * mp.cos(lean)),
                ("z_v", pair.z_v[k], z[k] / mp.cos(beta) ** 3),
                ("x_min", pair.x_min[k] + 9, 10 - z[k] * mp.sin(alpha_t) ** 2 / 2 / mp.cos(beta)),
                (
                    "rho_l",
                    pair.rho_l[k] + 99,
                    99 + d / 2 * mp.sin(alpha_t) - module * (1 - x[k]) / mp.sin(alpha_t),
                ),
            ]
        pitch = mp.pi * module / mp.cos(beta) * mp.cos(alpha_t)
        overlap = (sum(rho_a) - a_w * mp.sin(alpha_w)) / pitch
        facts.append(("epsilon", pair.epsilon, overlap))
        for name, found, exact in facts:
            assert abs(float(found) - exact) < 1e-12 * abs(exact) + 1e-13, name


@each("case", CASES)
def test_across_the_axis_it_is_a_spur_pair_of_the_transverse_rack(case: tuple[Any, ...]) -> None:
    z, m, x, degrees = case
    pair, narrow = pair_of(case), cos(radians(degrees))
    rack = Rack(pair.alpha_t, narrow, 0.25 * narrow)
    spur = Pair(z, m / narrow, rack, np.array(x) * narrow)
    for name in ("d", "d_b", "d_a", "d_f", "d_w", "s", "s_a", "rho_a", "rho_p", "theta_p"):
        assert getattr(pair, name) == pytest.approx(getattr(spur, name), rel=1e-12), name
    assert float(pair.epsilon) == pytest.approx(float(spur.epsilon), rel=1e-12)


@each("case", CASES)
def test_the_base_tangent_is_a_number_of_base_pitches_and_a_thickness_across_the_helix(
    case: tuple[Any, ...],
) -> None:
    pair = pair_of(case)
    thick = pair.d_b * (pair.s / pair.d + involute(pair.alpha_t))
    across = ((pair.k - 1) * pair.p_b + thick) * cos(pair.beta_b)
    assert pair.base_tangent == pytest.approx(across, rel=1e-12)
    # It touches between the fillets and the tips.
    reach = across * cos(pair.beta_b) / 2
    assert np.all(reach < pair.rho_a)
    assert np.all(reach > pair.rho_l)


def test_overlap_and_equivalent_teeth_are_printed(tmp_path: Path) -> None:
    found = told(tmp_path, "z = [17, 40]\nm = 4\nbeta = 15\nb = 40\nx = [0.3, 0.2]")
    assert found["beta"] == pytest.approx(15)
    assert found["epsilon_beta"] == pytest.approx(40 * sin(radians(15)) / (4 * pi))
    whole = found["epsilon_alpha"] + found["epsilon_beta"]
    assert found["epsilon_gamma"] == pytest.approx(whole)
    assert found["z_v"] == pytest.approx([z / cos(radians(15)) ** 3 for z in (17, 40)])
    tips = [one["value"] for one in found["conditions"] if one["name"] == "tip"]
    assert tips == pytest.approx([one / 4 for one in found["s_na"]])
    bare = told(tmp_path, "z = [17, 40]\nm = 4\nbeta = 15\nx = [0.3, 0.2]")
    assert "epsilon_beta" not in bare
    spur = told(tmp_path, "z = [17, 40]\nm = 4\nx = [0.3, 0.2]")
    assert "z_v" not in spur
    assert acos(4 * 57 / 2 / (found["a"])) == pytest.approx(radians(15))
    assert found["alpha_t"] == pytest.approx(
        np.degrees(np.arctan(tan(radians(20)) / cos(radians(15))))
    )


@pytest.mark.parametrize("lang", ["ru", "en"])
def test_the_sheet_and_the_protocol(lang: str, tmp_path: Path) -> None:
    body = f'z = [17, 40]\nm = 4\nbeta = 15\nb = 40\nx = "blocking"\n[sheet]\nlang = "{lang}"'
    path = written(tmp_path, body)
    (sheet,) = drawings(load(path), PlanRequest())
    assert [f"{one.code} {one.message}" for one in inspect(sheet)] == []
    run = CliRunner().invoke(cli, ["protocol", str(path), "--lang", lang])
    assert run.exit_code == 0, run.output
    text = run.output.replace(",", ".")
    assert "m_t = m/cos β = 4/0.965926 = 4.141" in text
    assert "ε_β" in text
    assert ("arctg(tg α" if lang == "ru" else "arctan(tan α") in text
    assert "α_tw = " in text


@each(
    "body, said",
    [
        ("z = [20, 60]\nm = 4\nbeta = 15\ninternal = true\nx = [0, 0]", "internal pairs"),
        ("z = [20, 60]\nm = 4\nbeta = 60\nx = [0, 0]", "meshing.beta"),
        ("z = [20, 60]\nm = 4\nb = -3\nx = [0, 0]", "meshing.b"),
    ],
)
def test_a_faulty_helix_is_reported(tmp_path: Path, body: str, said: str) -> None:
    path = written(tmp_path, body)
    run = CliRunner().invoke(cli, ["solve", str(path), "--lang", "en"])
    assert run.exit_code == 3, run.output
    assert said in run.output


# Shifts by an aim ---------------------------------------------------------------------------------


def kept(pair: Pair, least: float = 1.2, tip: float = 0.25) -> np.ndarray:
    """Return where the limits hold, by inequalities of this test."""
    with np.errstate(all="ignore"):
        whole = (pair.x >= pair.x_min).all(axis=0) & (pair.epsilon >= least)
        whole &= (pair.s_na / pair.m >= tip).all(axis=0) & (pair.rho_p >= pair.rho_l).all(axis=0)
    return np.asarray(whole)


PAIRS = ((17, 40, 15.0), (12, 30, 0.0), (21, 25, 0.0), (14, 90, 0.0))


@each("one, two, degrees", PAIRS)
def test_no_shifts_have_a_greater_contact_ratio(
    one: int, two: int, degrees: float, tmp_path: Path
) -> None:
    found = told(tmp_path, f'z = [{one}, {two}]\nm = 5\nbeta = {degrees}\nx = "contact-ratio"')
    assert found["criterion"] == "contact-ratio"
    assert all(limit["holds"] for limit in found["conditions"])
    pair = Pair((one, two), 5.0, Rack(radians(20)), np.zeros(2), 0, radians(degrees))
    best, axis = 0.0, np.linspace(-1, 1.5, 501)
    for part in np.array_split(axis, 10):  # of all at once there are a hundred megabytes
        every = pair.shifted(np.stack(np.meshgrid(part, axis)))
        best = max(best, float(np.max(np.where(kept(every), every.epsilon, 0.0))))
    here = found["epsilon_alpha"]
    # The grid here is twice as fine: between two multiples the ratio may grow by its slope.
    assert best - 0.01 * 1.0 <= here <= best + 1e-12
    coarse = pair.shifted(np.stack(np.meshgrid(*[np.round(np.arange(-100, 151) / 100, 9)] * 2)))
    assert here == pytest.approx(
        float(np.max(np.where(kept(coarse), coarse.epsilon, 0.0))), abs=1e-12
    )


@each("one, two, degrees", sampled(PAIRS, 4))
def test_no_shifts_of_equal_sliding_slide_less(
    one: int, two: int, degrees: float, tmp_path: Path
) -> None:
    found = told(tmp_path, f'z = [{one}, {two}]\nm = 5\nbeta = {degrees}\nx = "equal-sliding"')
    slides = found["theta_p"]
    assert slides[0] == pytest.approx(slides[1], abs=1e-9)
    assert all(limit["holds"] for limit in found["conditions"])
    pair = Pair((one, two), 5.0, Rack(radians(20)), np.zeros(2), 0, radians(degrees))
    # Brute force over x2 for every multiple x1: the nearest to equal of 25 001 values, of which
    # those are looked at between which one slides less on one side and the other on the other.
    best, coarse, fine = np.inf, np.linspace(-1.0, 1.5, 1001), np.linspace(0.0, 2.5e-3, 26)
    for first in np.round(np.arange(-100, 151) / 100, 9):
        with np.errstate(all="ignore"):
            ends = np.abs(pair.shifted(np.stack([np.full_like(coarse, first), coarse])).theta_p)
            turns = np.flatnonzero(np.diff(np.sign(ends[0] - ends[1])))
            across = np.add.outer(coarse[turns], fine).ravel()
            x = np.stack([np.full_like(across, first), across])
            slid = np.abs(pair.shifted(x).theta_p)
            near = np.abs(slid[0] - slid[1]) < 2e-3
        fits = kept(pair.shifted(x[:, near]))  # the other limits only where the slidings are equal
        if fits.any():
            best = min(best, float(np.min(np.max(slid[:, near], axis=0)[fits])))
    assert abs(slides[0]) <= best + 2e-3
    assert abs(slides[0]) >= best - 4e-3


def test_equal_sliding_with_a_given_distance_of_the_axes(tmp_path: Path) -> None:
    body = 'z = [12, 30]\nm = 5\na_w = 108\nx = "equal-sliding"'
    found = told(tmp_path, body)
    assert found["a_w"] == pytest.approx(108, rel=1e-12)
    assert found["theta_p"][0] == pytest.approx(found["theta_p"][1], abs=1e-9)
    for lang, word in (("ru", "удельные скольжения"), ("en", "specific sliding")):
        run = CliRunner().invoke(cli, ["solve", str(written(tmp_path, body)), "--lang", lang])
        assert word in " ".join(run.output.split())
