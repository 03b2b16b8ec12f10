"""Several rises and falls in a turn, measured lifts, and the new names of laws."""

from __future__ import annotations

from collections.abc import Callable
from math import radians
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cams import designed, written
from click.testing import CliRunner
from doors import (
    CamDesign,
    CamLawName,
    LawsReals as Reals,
    NumberName,
    ProblemError,
    cams_construction_construct as construct,
    cams_reader_load as load,
    cli,
    follower_drive,
    get_language,
    law_of,
    text_given_facts as given_facts,
)

from benchmarks.rebuilt import file_of, table_of

LIFTS = [0, 0.00011, 0.00079, 0.00226, 0.00441, 0.00682, 0.00867, 0.00959, 0.00992, 0.00999, 0.010]

STEPS: dict[str, Any] = {
    "follower": "translating",
    "n": 60,
    "law": "cycloid",
    "motions": [
        {"dwell": 20},
        {"rise": 60, "stroke": 0.02, "law": "modified-sine"},
        {"dwell": 10},
        {"rise": 50, "stroke": 0.015, "law": "harmonic"},
        {"return": 40, "stroke": 0.01},
        {"dwell": 10},
        {"return": 50, "stroke": 0.01, "law": "3-4-5"},
        {"return": 60},
    ],
}


def said(value: Any) -> str:
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {said(one)}" for key, one in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(said, value)) + "]"
    return f'"{value}"' if isinstance(value, str) else repr(value)


def file_with(folder: Path, keys: dict[str, Any]) -> Path:
    path = folder / "cam.toml"
    path.write_text("[cam]\n" + "".join(f"{k} = {said(v)}\n" for k, v in keys.items()), "utf-8")
    return path


# An independent spline: unknown slopes instead of second derivatives, cubics in Hermite's form.


def hermite(values: list[float], u: Reals) -> tuple[Reals, Reals, Reals]:
    """Return a clamped cubic spline over [0, 1] and two derivatives, by its slopes."""
    y, n = np.array(values), len(values) - 1
    table, right = np.eye(n + 1), np.zeros(n + 1)
    for k in range(1, n):
        table[k, k - 1 : k + 2] = 1, 4, 1
        right[k] = 3 * n * (y[k + 1] - y[k - 1])
    slopes = np.linalg.solve(table, right)
    k = np.minimum((u * n).astype(int), n - 1)
    t, h = u * n - k, 1 / n
    p0, p1, m0, m1 = y[k], y[k + 1], h * slopes[k], h * slopes[k + 1]
    s = (
        (2 * t**3 - 3 * t**2 + 1) * p0
        + (t**3 - 2 * t**2 + t) * m0
        + (3 * t**2 - 2 * t**3) * p1
        + (t**3 - t**2) * m1
    )
    v = (6 * t**2 - 6 * t) * (p0 - p1) + (3 * t**2 - 4 * t + 1) * m0 + (3 * t**2 - 2 * t) * m1
    a = (12 * t - 6) * (p0 - p1) + (6 * t - 4) * m0 + (6 * t - 2) * m1
    return s, v * n, a * n**2


def test_measured_lifts_are_on_the_spline_of_an_independent_solver(tmp_path: Path) -> None:
    law = {"rise": {"law": "lift", "values": LIFTS}, "return": "sine"}
    design = designed(
        tmp_path,
        {"follower": "translating", "stroke": 0.010, "rise": 100, "return": 100, "law": law},
    )
    u = np.linspace(0, 1, 401)[:-1]
    s, v, a = design.problem.at(radians(100) * u)
    exact = hermite(LIFTS, u)
    for found, expected, power in zip((s, v, a), exact, (0, 1, 2), strict=True):
        assert found == pytest.approx(expected / radians(100) ** power, abs=1e-12)
    at = design.problem.at(radians(100) * np.arange(11) / 10 - 1e-15)[0]
    assert at[1:] == pytest.approx(LIFTS[1:], abs=1e-14)


def test_lifts_of_a_return_fall_as_measured_or_are_counted_downwards(tmp_path: Path) -> None:
    keys = {"follower": "translating", "stroke": 0.010, "rise": 100, "return": 100}
    falling, counted = (
        load(file_with(tmp_path, {**keys, "law": {"return": {"law": "lift", "values": values}}}))
        for values in (LIFTS[::-1], [0.010 - value for value in LIFTS[::-1]])
    )
    phi = np.radians(np.linspace(100, 200, 50))
    assert falling.at(phi) == pytest.approx(counted.at(phi), abs=1e-12)
    s = falling.at(np.radians(100 + 10.0 * np.arange(11)))[0]
    assert s == pytest.approx(LIFTS[::-1], abs=1e-14)


def test_motions_follow_one_another_by_the_formulas_of_their_laws(tmp_path: Path) -> None:
    problem = load(file_with(tmp_path, STEPS))
    u = np.linspace(0, 1, 101)[1:-1]
    starts, levels = (20, 90, 140, 190, 240), (0, 0.02, 0.035, 0.025, 0.015)
    lengths, sizes = (60, 50, 40, 50, 60), (0.02, 0.015, -0.01, -0.01, -0.015)

    def modified(u: Reals) -> Reals:
        c = np.pi / (4 + np.pi)
        return np.where(
            u < 1 / 8,
            c * (u - np.sin(4 * np.pi * u) / (4 * np.pi)),
            np.where(
                u > 7 / 8,
                4 / (4 + np.pi) + c * (u - np.sin(4 * np.pi * u) / (4 * np.pi)),
                2 / (4 + np.pi)
                + c * u
                - 9 / (4 * (4 + np.pi)) * np.sin(4 * np.pi * u / 3 + np.pi / 3),
            ),
        )

    shapes: tuple[Callable[[Reals], Reals], ...] = (
        modified,
        lambda u: (1 - np.cos(np.pi * u)) / 2,
        lambda u: u - np.sin(2 * np.pi * u) / (2 * np.pi),
        lambda u: 10 * u**3 - 15 * u**4 + 6 * u**5,
        lambda u: u - np.sin(2 * np.pi * u) / (2 * np.pi),
    )
    for start, length, level, size, shape in zip(
        starts, lengths, levels, sizes, shapes, strict=True
    ):
        s = problem.at(np.radians(start + length * u))[0]
        assert s == pytest.approx(level + size * shape(u), abs=1e-12)
    assert problem.at(np.radians([10, 85, 185, 300, 350]))[0] == pytest.approx(
        [0, 0.02, 0.025, 0, 0], abs=1e-14
    )
    assert problem.stroke == pytest.approx(0.035)


def test_the_modified_sine_has_its_known_extremes() -> None:
    law = law_of(CamLawName.MODIFIED_SINE)
    rows = [law.on(k, np.linspace(b.start, b.end, 501)) for k, b in enumerate(law.bits)]
    assert max(float(r[1].max()) for r in rows) == pytest.approx(1.7596, abs=1e-4)
    assert max(float(r[2].max()) for r in rows) == pytest.approx(5.5280, abs=1e-4)


def least_radius(motions: list[tuple[float, float, float, float]], limit: float) -> float:
    """Return the least r_min of a central cycloidal follower, by brute force over the rises."""
    u = np.linspace(0, 1, 200_001)
    deep = 0.0
    for _, length, level, size in motions:
        s = level + size * (u - np.sin(2 * np.pi * u) / (2 * np.pi))
        v = size * (1 - np.cos(2 * np.pi * u)) / radians(length)
        deep = max(deep, float(np.max(np.abs(v) / np.tan(radians(limit)) - s)))
    return deep


def test_the_smallest_cam_keeps_the_limits_of_every_rise(tmp_path: Path) -> None:
    keys = {
        "follower": "translating",
        "offset": 0,
        "law": "cycloid",
        "pressure": 30,
        "motions": [
            {"rise": 90, "stroke": 0.02},
            {"dwell": 15},
            {"return": 90},
            {"dwell": 15},
            {"rise": 50, "stroke": 0.015},
            {"return": 60},
        ],
    }
    design = designed_from(tmp_path, keys)
    expected = least_radius([(0, 90, 0.0, 0.02), (210, 50, 0.0, 0.015)], 30)
    assert design.geometry.r_min == pytest.approx(expected, rel=1e-9)
    assert design.bounds[0].motion is design.problem.motions[4]


def designed_from(folder: Path, keys: dict[str, Any]) -> CamDesign:
    return CamDesign(load(file_with(folder, keys)))


def test_a_rocker_that_begins_above_counts_from_its_lowest_position(tmp_path: Path) -> None:
    keys = {
        "follower": "oscillating",
        "arm": 0.12,
        "n": -60,
        "motions": [
            {"return": 60, "swing": 10},
            {"return": 40, "swing": 5},
            {"dwell": 30},
            {"rise": 100, "swing": 15},
        ],
    }
    problem = load(file_with(tmp_path, keys))
    found = np.degrees(problem.at(np.radians([0, 60, 110, 240]))[0] / 0.12)
    assert found == pytest.approx([15, 5, 0, 15], abs=1e-12)
    drive = follower_drive(problem)
    assert len(drive.pieces) == len(problem.stretches)
    built = construct(designed_from(tmp_path, keys))
    drawn = [built.exact.value[NumberName(f"s_{{{node.number}}}")] for node in built.nodes]
    exact = [problem.at(np.array([node.phi]))[0, 0] / built.scales.s for node in built.nodes]
    assert np.ravel(drawn) == pytest.approx(exact, abs=0.8)  # mm: errors of the chords


def test_the_stated_motions_suffice_to_build_the_cam_again(tmp_path: Path) -> None:
    problem = load(file_with(tmp_path, STEPS))
    for lang in ("ru", "en"):
        facts = given_facts(problem, get_language(lang), numbered=True)
        path = tmp_path / "again.toml"
        path.write_text(file_of(table_of(facts)), "utf-8")
        again = load(path)
        phi = np.linspace(0, 6.28, 200)
        assert again.at(phi) == pytest.approx(problem.at(phi), abs=1e-12)
        assert again.stretches[0].motion.phase is problem.stretches[0].motion.phase


def test_listed_motions_of_a_plain_cam_are_that_cam(tmp_path: Path) -> None:
    plain = {"follower": "translating", "rise": 100, "upper_dwell": 20, "return": 90}
    one = load(written(tmp_path, {**plain, "stroke": 0.03}))
    listed = [{"rise": 100, "stroke": 0.03}, {"dwell": 20}, {"return": 90}]
    two = load(file_with(tmp_path, {"follower": "translating", "motions": listed}))
    assert one.motions == two.motions and two.has_one_lift
    english = get_language("en")
    assert given_facts(one, english) == given_facts(two, english)


FAULTS: list[tuple[list[Any], str]] = [
    ([{"rise": 90, "stroke": 0.01}, {"return": 90, "stroke": 0.005}], "returns by 0.005 m"),
    ([{"rise": 90, "stroke": 0.01}, {"return": 90}, {"dwell": 20}], r"\{ dwell = 180 \}"),
    ([{"rise": 190, "stroke": 0.01}, {"return": 190}], "380"),
    ([{"rise": 90, "stroke": 0.01, "dwell": 3}, {"return": 90}], "one of rise, return and dwell"),
    ([{"rise": 90}, {"return": 90}], "stroke: missing"),
    ([{"rise": 90, "swing": 10}, {"return": 90}], "translating follower has none"),
    ([{"return": 90}, {"rise": 90, "stroke": 0.01}], "not above the place"),
    ([{"dwell": 90}, {"dwell": 270}], "two dwells"),
    ([{"dwell": 90, "law": "sine"}, {"rise": 20, "stroke": 1}, {"return": 20}], "a dwell has none"),
    ([{"rise": 90, "stroke": 0.01, "law": {"law": "lift", "values": [0, 2, 1]}}, {"return": 90}],
     "2 is not between"),
    ([{"rise": 90, "stroke": 0.01, "law": {"law": "lift", "values": [2, 1, 0]}}, {"return": 90}],
     "greater than the first"),
]  # fmt: skip


@pytest.mark.parametrize("motions, message", FAULTS)
def test_a_fault_of_the_motions_is_named_with_its_numbers(
    motions: list[Any], message: str, tmp_path: Path
) -> None:
    with pytest.raises(ProblemError, match=message):
        load(file_with(tmp_path, {"follower": "translating", "motions": motions}))


def test_phases_beside_motions_are_refused(tmp_path: Path) -> None:
    keys = {"follower": "translating", "rise": 90, "stroke": 0.01, "motions": STEPS["motions"]}
    with pytest.raises(ProblemError) as found:
        load(file_with(tmp_path, keys))
    assert "cam.rise" in str(found.value) and "cam.stroke" in str(found.value)


def test_sheet_protocol_and_live_page_show_every_motion(tmp_path: Path) -> None:
    path = file_with(tmp_path, {**STEPS, "parts": 4})
    for command in ("protocol", "live", "sheet"):
        options = [] if command == "protocol" else ["-o", str(tmp_path)]
        done = CliRunner().invoke(cli, [command, str(path), "--lang", "en", *options])
        assert done.exit_code == 0, done.output
