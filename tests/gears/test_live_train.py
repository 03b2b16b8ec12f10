"""The page of a gear train: teeth mesh in every position, and no text of the file is code."""

from __future__ import annotations

import cmath
import json
import re
from math import radians
from pathlib import Path
from typing import Any

import pytest
from browser import PROGRAM, browsing
from cases import each
from click.testing import CliRunner
from doors import (
    GearProblem,
    MeshKind,
    ProblemError,
    TrainMotion,
    cli,
    families_template as template,
    gears_live_live_page as live_page,
    gears_reader_load as load,
    solve_motion,
)
from worked import PROBLEMS

FILES = sorted((PROBLEMS / "gears").glob("*.toml"))

SET = """
title = "</script><script>alert(1)</script>"
[gears]
wheels = { 1 = 20, 2 = 40, 3 = 100 }
meshes = [{ of = [1, 2], carrier = "H" }, { of = [2, 3], kind = "internal", carrier = "H" }]
fixed = ["3"]
n = { 1 = -600 }
satellites = %d
"""


def made(text: str, folder: Path) -> tuple[GearProblem, dict[str, Any]]:
    path = folder / "train.toml"
    path.write_text(text, encoding="utf-8")
    problem = load(path)
    return problem, scene_of(live_page(problem, "ru"))


def scene_of(page: str) -> dict[str, Any]:
    (text,) = re.findall(r'(?s)id="scene">(.*?)</script>', page)
    told: dict[str, Any] = json.loads(text)
    return told


def places(scene: dict[str, Any], x: float) -> list[tuple[complex, float]]:
    """Return centre, y up, and angle in degrees of every wheel that is drawn."""
    found = []
    for one in scene["wheels"]:
        way = cmath.rect(one["far"], radians(one["start"] + one["carried"] * x))
        found.append((way - 1j * one["base"], one["angle"] + one["ratio"] * x))
    return found


def clash(one: tuple[complex, float], other: tuple[complex, float], teeth: tuple[int, int],
          inner: bool) -> float:  # fmt: skip
    """Return how far a tooth is from the middle of the gap that it is to be in, in pitches."""
    way = other[0] - one[0]
    at = cmath.phase(way) * 180 / cmath.pi
    at = at + 180.0 if inner and teeth[0] < teeth[1] else at
    back = at if inner else at + 180.0
    first = (at - one[1]) * teeth[0] / 360.0
    second = (back - other[1]) * teeth[1] / 360.0
    off = (second - first if inner else second + first) - 0.5
    return abs(off - round(off))


def worst(motion: TrainMotion, scene: dict[str, Any]) -> float:
    """Return the largest clash of all pairs of drawn wheels that touch, in several positions."""
    radii = {label: float(size) for label, size in motion.axes.sizes.items()}
    copies = [one["of"] for one in scene["wheels"]]
    most, pairs, scales = 0.0, 0, list[float]()
    for x in (0.0, 17.3, -211.0):
        at = places(scene, x)
        for mesh in motion.train.meshes:
            inner = mesh.kind is MeshKind.INTERNAL
            teeth = (int(radii[mesh.first]), int(radii[mesh.second]))
            apart = abs(teeth[0] - teeth[1]) if inner else sum(teeth)
            for i, one in enumerate(copies):
                for j, other in enumerate(copies):
                    if (one, other) != (mesh.first, mesh.second):
                        continue
                    scales.append(abs(at[i][0] - at[j][0]) / apart)
                    most, pairs = max(most, clash(at[i], at[j], teeth, inner)), pairs + 1
    assert pairs
    assert max(scales) == pytest.approx(min(scales))
    return most


@each("path", FILES)
def test_teeth_of_the_worked_trains_mesh_as_they_turn(path: Path) -> None:
    problem = load(path)
    motion = solve_motion(problem)
    if any(size.denominator != 1 for size in motion.axes.sizes.values()):
        pytest.skip("sizes that are no teeth")
    assert worst(motion, scene_of(live_page(problem, "en"))) < 1e-6


@pytest.mark.parametrize(("count", "fits"), [(1, True), (3, True), (4, True), (7, False)])
def test_planet_gears_mesh_if_they_can_be_assembled(count: int, fits: bool, tmp_path: Path) -> None:
    """(z_1 + z_3)/k is an integer, or the teeth of the ring run into those of a planet gear."""
    problem, scene = made(SET % count, tmp_path)
    assert (worst(solve_motion(problem), scene) < 1e-6) is fits
    assert ((20 + 100) % count == 0) is fits


def test_a_page_of_the_template_is_written_and_turns_at_the_given_speeds(tmp_path: Path) -> None:
    path = tmp_path / "train.toml"
    path.write_text(template("planetary-train"), encoding="utf-8")
    done = CliRunner().invoke(cli, ["live", str(path), "-o", str(tmp_path)])
    assert done.exit_code == 0, done.output
    page = (tmp_path / "train-live.html").read_text("utf-8")
    motion = solve_motion(load(path))
    ratios = [one["ratio"] for one in scene_of(page)["angles"]]
    speeds = [float(motion.speed(label)) for label in motion.train.numbers]
    assert ratios == pytest.approx([speed / 1500 for speed in speeds])
    assert "alert" not in page


def test_text_of_a_file_is_no_source(tmp_path: Path) -> None:
    made(SET % 3, tmp_path)
    page = live_page(load(tmp_path / "train.toml"), "ru")
    assert "<script>alert" not in page
    assert "default-src 'none'" in page


def test_a_train_that_does_not_mesh_in_a_plane_is_rejected_with_advice(tmp_path: Path) -> None:
    rack = 'wheels = { 1 = 20, 2 = { r = 0.1 } }\nmeshes = [{ of = [1, 2], kind = "belt" }]\n'
    path = tmp_path / "belt.toml"
    path.write_text(f"[gears]\nmodule = 2\n{rack}n = {{ 1 = 1 }}\n", encoding="utf-8")
    with pytest.raises(ProblemError, match="planmethod sheet"):
        live_page(load(path), "en")


@pytest.mark.skipif(PROGRAM is None, reason="chromium is absent")
def test_the_browser_turns_the_wheels_by_the_data(tmp_path: Path) -> None:
    _, scene = made(SET % 3, tmp_path)
    page = tmp_path / "train.html"
    page.write_text(live_page(load(tmp_path / "train.toml"), "ru"), encoding="utf-8")
    with browsing(tmp_path) as browser:
        browser.open(page)
        browser.ask("planmethod.show(123.5)")
        for k, (centre, _) in enumerate(places(scene, 123.5)):
            x, y = browser.ask(f"planmethod.centre({k}, 123.5)")
            assert complex(x, -y) == pytest.approx(centre, abs=1e-9)
        shown = float(browser.ask('document.getElementById("angle-0").dataset.value'))
        assert shown == pytest.approx(scene["angles"][0]["ratio"] * 123.5)
        assert not browser.said
