"""The page of a moving point: its vectors are those of the formulas, its hodographs their ends."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import PROGRAM, Page, browsing
from cases import each
from doors import (
    move,
    moving_live_live_page as live_page,
    moving_reader_load as load,
)
from worked import PROBLEMS

FILES = sorted((PROBLEMS / "point").glob("*.toml"))


def scene_of(page: str) -> dict[str, Any]:
    (text,) = re.findall(r'(?s)id="scene">(.*?)</script>', page)
    told: dict[str, Any] = json.loads(text)
    return told


@each("path", FILES)
def test_every_shipped_point_has_a_page_with_its_own_numbers(path: Path) -> None:
    problem = load(path)
    scene = scene_of(live_page(problem, "en"))
    table = np.array(scene["rows"], dtype=float).T
    rows = dict(zip(scene["columns"], table, strict=True))
    t, (low, high) = rows["t"], scene["ends"]
    assert (t[0], t[-1]) == pytest.approx((low, high))
    motion = move(problem)
    for name in ("x", "vx", "vy", "ax", "ay"):
        exact = motion.columns[name]
        values = rows[name]
        inside = (motion.columns["t"] >= low) & (motion.columns["t"] <= high)
        found = np.interp(motion.columns["t"][inside], t, values)
        size = np.nanmax(np.abs(values))
        both = np.isfinite(found) & np.isfinite(exact[inside])
        assert found[both] == pytest.approx(exact[inside][both], abs=2e-5 * size), name


@each("path", FILES)
def test_the_velocity_is_the_slope_of_the_trajectory_and_a_of_the_hodograph(path: Path) -> None:
    """By differences of the page's rows, wherever these are smooth."""
    scene = scene_of(live_page(load(path), "en"))
    rows = np.array(scene["rows"], dtype=float)
    column = {name: rows[:, k] for k, name in enumerate(scene["columns"])}
    step = column["t"][1] - column["t"][0]
    for of, rate in (("x", "vx"), ("y", "vy"), ("vx", "ax"), ("vy", "ay")):
        slope = (column[of][2:] - column[of][:-2]) / (2 * step)
        exact = column[rate][1:-1]
        size = np.nanpercentile(np.abs(exact), 75) or 1.0
        off = np.abs(slope - exact) / size
        assert np.nanpercentile(off, 90) < 1e-3, (of, rate)


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    if PROGRAM is None:
        pytest.skip("Chromium is absent")
    with browsing(tmp_path_factory.mktemp("browser")) as browser:
        yield browser


def test_vectors_are_drawn_to_scale_and_the_parts_add_to_the_acceleration(
    page: Page, tmp_path: Path
) -> None:
    problem = load(PROBLEMS / "point/k11-01.toml")
    file = tmp_path / "point.html"
    file.write_text(live_page(problem, "ru"), "utf-8")
    page.said.clear()
    page.open(file, width=390, height=800)
    assert page.ask("document.documentElement.scrollWidth") == 390
    for share in (0.1, 0.45, 0.8):
        page.ask(f"planmethod.show(D.ends[0] + {share} * (D.ends[1] - D.ends[0]))")
        drawn = page.ask(
            "D.views.map(view => view.arrows.map(one => [view.id, one.of, one.per_mm, one.ends]))"
        )
        told = page.ask("planmethod.at(bar.at())")
        for view, of, per_mm, ends in (one for own in drawn for one in own):
            if ends is None:
                continue
            (x0, y0), (x1, y1) = ends
            vector = complex(x1 - x0, -(y1 - y0)) * per_mm
            v, a = complex(told["vx"], told["vy"]), complex(told["ax"], told["ay"])
            along = v / abs(v) * told["a_tangential"]
            wanted = {"v": v, "a": a, "at": along, "an": a - along}[of]
            assert vector == pytest.approx(wanted, abs=1e-9 * abs(a)), (view, of)
            if of == "an":  # across the velocity
                assert (vector * v.conjugate()).real == pytest.approx(0, abs=1e-5 * abs(a * v))
                assert abs(vector) == pytest.approx(told["a_normal"], rel=1e-4)
    # The mark of a moment leads to it.
    page.ask("byId('marks').children[3].click()")
    assert page.ask("bar.at() === +byId('marks').children[3].dataset.at")
    assert not page.said
