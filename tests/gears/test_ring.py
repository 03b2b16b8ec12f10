"""Internal pairs: sizes by GOST 19274 in 40 digits, the ring against its cutter and its pinion."""

from __future__ import annotations

import json
from math import pi, radians
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from cases import some
from click.testing import CliRunner
from doors import (
    LineOfAction,
    Pair,
    Points,
    Rack,
    SolvedMeshing,
    Tooth,
    cli,
    involute_reader_load as load,
)
from shapely import Point, Polygon
from worked import PROBLEMS

FILE = PROBLEMS / "meshing" / "z20-60-internal.toml"


def ring_of(z: tuple[int, int], m: float, x: tuple[float, float], cutter: int) -> Pair:
    return Pair((z[0], -z[1]), m, Rack(radians(20)), np.zeros(2), cutter).shifted(x)


def written(folder: Path, body: str) -> Path:
    path = folder / "ring.toml"
    path.write_text(f"[meshing]\n{body}\n", encoding="utf-8")
    return path


def solved_json(*args: str) -> dict[str, Any]:
    run = CliRunner().invoke(cli, ["solve", *args, "--json"])
    assert run.exit_code == 0, run.output
    told: dict[str, Any] = json.loads(run.output)["meshing"]
    return told


def test_sizes_of_an_internal_pair_are_those_of_the_standard(tmp_path: Path) -> None:
    body = "z = [18, 57]\nm = 4\ninternal = true\ncutter = 25\nx = [0.3, 0.7]"
    told = solved_json(str(written(tmp_path, body)))
    with mp.workdps(40):
        alpha, m, z1, z2, z0 = mp.radians(20), mp.mpf(4), 18, 57, 25
        x1, x2 = mp.mpf("0.3"), mp.mpf("0.7")

        def inv(angle: Any) -> Any:
            return mp.tan(angle) - angle

        def angle_of(value: Any) -> Any:
            return mp.findroot(lambda t: inv(t) - value, mp.mpf("0.4"))

        alpha_w = angle_of(inv(alpha) + 2 * (x2 - x1) * mp.tan(alpha) / (z2 - z1))
        a = m * (z2 - z1) / 2
        a_w = a * mp.cos(alpha) / mp.cos(alpha_w)
        y = (a_w - a) / m
        delta = x2 - x1 - y
        d = [m * z1, m * z2]
        d_b = [one * mp.cos(alpha) for one in d]
        d_a = [d[0] + 2 * m * (1 + x1 + delta), d[1] - 2 * m * (1 - x2 + delta)]
        s = [m * (mp.pi / 2 + 2 * x1 * mp.tan(alpha)), m * (mp.pi / 2 - 2 * x2 * mp.tan(alpha))]
        alpha_a = [mp.acos(base / tip) for base, tip in zip(d_b, d_a, strict=True)]
        rho_a = [base * mp.tan(angle) / 2 for base, angle in zip(d_b, alpha_a, strict=True)]
        line = a_w * mp.sin(alpha_w)
        alpha_0 = angle_of(inv(alpha) + 2 * x2 * mp.tan(alpha) / (z2 - z0))
        a_0 = m * (z2 - z0) / 2 * mp.cos(alpha) / mp.cos(alpha_0)
        d_a0 = m * (z0 + mp.mpf("2.5"))
        rho_a0 = mp.sqrt(d_a0**2 - (m * z0 * mp.cos(alpha)) ** 2) / 2
        by_angle = (z1 * mp.tan(alpha_a[0]) - z2 * mp.tan(alpha_a[1])) / (2 * mp.pi)
        by_angle += (z2 - z1) * mp.tan(alpha_w) / (2 * mp.pi)
        tip_2 = d_a[1] * (s[1] / d[1] - inv(alpha) + inv(alpha_a[1]))
        tip_1 = d_a[0] * (s[0] / d[0] + inv(alpha) - inv(alpha_a[0]))
        due = {
            "alpha_w": mp.degrees(alpha_w),
            "a": a,
            "a_w": a_w,
            "y": y,
            "delta_y": delta,
            "x_sum": x2 - x1,
            "d_b": d_b,
            "d_w": [2 * a_w * z1 / (z2 - z1), 2 * a_w * z2 / (z2 - z1)],
            "d_a": d_a,
            "d_f": [d[0] - 2 * m * (mp.mpf("1.25") - x1), 2 * a_0 + d_a0],
            "s": s,
            "s_a": [tip_1, tip_2],
            "rho_a": rho_a,
            "rho_p": [rho_a[1] - line, rho_a[0] + line],
            "epsilon_alpha": by_angle,
            "a_w0": a_0,
            "d_a0": d_a0,
        }
        for name, exact in due.items():
            found = np.atleast_1d(told[name])
            for one, other in zip(found, np.atleast_1d(exact), strict=True):
                assert abs(one - other) < 1e-12 * abs(other) + 1e-13, name
        assert abs(told["rho_l"][1] - (a_0 * mp.sin(alpha_0) + rho_a0)) < 1e-11
    assert (told["internal"], told["z"], told["x"]) == (True, [18, 57], [0.3, 0.7])
    assert told["x_min"][1] is None
    back = solved_json(
        str(written(tmp_path, body.replace("x = [0.3, 0.7]", f"x2 = 0.7\na_w = {told['a_w']!r}")))
    )
    assert back["x"][0] == pytest.approx(0.3, abs=1e-12)


def shape(points: Points) -> Polygon:
    return Polygon(np.stack([points.real, points.imag], axis=1))


@pytest.mark.parametrize(
    ("z", "x", "cutter"), [((20, 60), (0.72, 1.4), 25), ((24, 70), (0.0, -0.2), 20)]
)
def test_no_position_of_the_cutter_cuts_the_ring_and_one_touches_every_point(
    z: tuple[int, int], x: tuple[float, float], cutter: int
) -> None:
    """The cutter as an outline of involutes with sharp tips, rolled in the ring."""
    pair = ring_of(z, 5.0, x, cutter)
    tooth = Tooth(pair, 1)
    alpha, r_b, r_a = radians(20), 2.5 * cutter * np.cos(radians(20)), pair.d_a0 / 2
    radius = np.linspace(r_b, r_a, 400)
    turn = np.arccos(r_b / radius)
    half = pi / (2 * cutter) + np.tan(alpha) - alpha - (np.tan(turn) - turn)
    upper = radius * np.exp(1j * half)
    outline = np.concatenate([upper, upper[::-1].conj()])

    def cut(psi: float) -> Polygon:
        own = outline * np.exp(1j * psi * (1 - z[1] / cutter))
        return shape((float(pair.a_w0) * np.exp(1j * psi) + own) * np.exp(-1j * pi / z[1]))

    metal = shape(np.concatenate([tooth.outline(150), [float(-pair.d_f[1]) * 0.6 + 0j]]))
    psis = np.linspace(-0.35, 0.35, some(401, few=81))
    assert max(cut(psi).intersection(metal).area for psi in psis) < 2e-3
    points = [*tooth.fillet_points(5)[1:], *tooth.flank_points(5)[1:-1]]
    for point in points:
        low, high = -0.35, 0.35
        for _ in range(5):
            tried = np.linspace(low, high, 41)
            gaps = [cut(psi).distance(Point(point.real, point.imag)) for psi in tried]
            best = int(np.argmin(gaps))
            low, high = tried[max(best - 1, 0)], tried[min(best + 1, 40)]
        assert gaps[best] < 2e-4


def overlap(pair: Pair) -> float:
    """Largest area that a whole pinion has outside the spaces of a whole ring."""
    one, two = Tooth(pair, 0), Tooth(pair, 1)
    angles = []
    for tooth in (one, two):
        rho = tooth.size("d_b") / 2 * np.tan(float(pair.alpha_w))
        angles.append(pi / 2 + tooth.side * float(tooth.half(rho)))
    whole = [
        np.concatenate([t.outline(40) * np.exp(2j * pi * k / t.z) for k in range(t.z)])
        for t in (one, two)
    ]
    worst = 0.0
    for turn in np.linspace(0.0, 2 * pi / one.z, some(17, few=5)):
        pinion = whole[0] * np.exp(1j * (angles[0] - turn)) - 0.5j * float(pair.d_w[0])
        ring = whole[1] * np.exp(1j * (angles[1] - turn * one.z / two.z))
        ring = ring + 0.5j * float(pair.d_w[1])
        worst = max(worst, float(shape(pinion).difference(shape(ring).buffer(1e-9)).area))
    return worst


def test_a_pinion_turns_freely_in_its_ring_and_interference_is_reported() -> None:
    good = load(FILE)
    solved = SolvedMeshing(good)
    assert all(value >= bound for _, value, bound in solved.evaluated_limits())
    assert overlap(solved.pair) < 1e-3
    touching = solved.contact.overlap(solved.pair)
    assert touching == pytest.approx(float(solved.pair.epsilon), rel=1e-12)
    assert LineOfAction.of(*solved.teeth).start == pytest.approx(float(solved.pair.rho_p[0]))
    near = ring_of((40, 44), 5.0, (0.0, 0.0), 20)  # too few teeth less: the tips meet outside
    assert float(near.tips) < 0
    assert overlap(near) > 1.0
    for wide in (ring_of((20, 60), 5.0, (0.3, 0.9), 25), ring_of((30, 50), 3.0, (0.4, 0.6), 20)):
        assert float(wide.tips) > 0


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("z = [30, 25]\nm = 2\ninternal = true\nx = [0, 0]", "The second wheel is the ring"),
        ("z = [20, 60]\nm = 2\ncutter = 20\nx = [0, 0]", "valid only with internal = true"),
        ("z = [20, 60]\nm = 2\ninternal = 1\nx = [0, 0]", "expected true or false"),
        ("z = [20, 30]\nm = 5\ninternal = true\nx = [0, 0]", "wheel 2 has no involute teeth"),
        ("z = [20, 60]\nm = 5\ninternal = true\nx = [1, -1]", "cannot come that close"),
    ],
)
def test_a_faulty_ring_is_reported_with_a_remedy(tmp_path: Path, body: str, said: str) -> None:
    run = CliRunner().invoke(cli, ["solve", str(written(tmp_path, body))])
    assert (run.exit_code, said in run.output) == (3, True), run.output
