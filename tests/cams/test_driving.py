"""A linkage driven by a cam's follower: place, rate, acceleration from the law; faulty files."""

from __future__ import annotations

import json
from math import cos, pi, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cases import each
from click.testing import CliRunner

from planmethod.cli import cli

SLIDER = """
[frame]
O = [0.0, 0.0]
C = [0.3, 0.0]
guides.y-y = { through = "O", angle = 90 }
[links.1]
points = ["A"]
slides = { on = "y-y" }
[links.2]
points = ["A", "B"]
AB = 0.25
[links.3]
points = ["B", "C"]
CB = 0.2
[driver]
link = "1"
s = 0.1
cam = {cam}
[assembly]
B = "above A"
[cam]
follower = "translating"
stroke = 0.04
rise = 120
upper_dwell = 30
return = 100
law = {{ rise = "3-4-5", return = "cosine" }}
n = {n}
"""

ROCKER = """
[frame]
O = [0.0, 0.0]
C = [0.5, 0.0]
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A", "B"]
AB = 0.45
[links.3]
points = ["B", "C"]
CB = 0.3
[driver]
link = "1"
phi = 100
cam = {cam}
[assembly]
B = "above C"
[cam]
follower = "oscillating"
swing = 25
arm = 0.12
sense = "{sense}"
rise = 90
return = 90
law = "sine"
n = {n}
"""


def filled(body: str, **given: object) -> str:
    for name, value in given.items():
        body = body.replace("{" + name + "}", str(value))
    return body.replace("{{", "{").replace("}}", "}")


def solved(tmp_path: Path, body: str, *args: str) -> dict[str, Any]:
    path = tmp_path / "lift.toml"
    path.write_text(body, encoding="utf-8")
    run = CliRunner().invoke(cli, ["solve", str(path), "--json", *args])
    assert run.exit_code == 0, run.output
    found: dict[str, Any] = json.loads(run.stdout)["positions"][0]
    return found


def polynomial(u: float) -> tuple[float, float, float]:
    """3-4-5 by its textbook coefficients."""
    s = 10 * u**3 - 15 * u**4 + 6 * u**5
    return s, 30 * u**2 - 60 * u**3 + 30 * u**4, 60 * u - 180 * u**2 + 120 * u**3


@each("cam, n", [(0, 120), (20, 120), (60, 120), (100, -90), (135, 120), (200, 120)])
def test_a_slider_moves_by_the_law(tmp_path: Path, cam: float, n: float) -> None:
    at = solved(tmp_path, filled(SLIDER, cam=cam, n=n))
    omega = abs(n) * pi / 30
    if cam < 120:
        length = radians(120)
        s, v, a = (0.04 * one for one in polynomial(cam / 120))
        v, a = v / length, a / length**2
    elif cam < 150:
        s, v, a = 0.04, 0.0, 0.0
    else:
        length, u = radians(100), (cam - 150) / 100
        s = 0.04 * (1 + cos(pi * u)) / 2
        v = -0.04 * pi / 2 * sin(pi * u) / length
        a = -0.04 * pi**2 / 2 * cos(pi * u) / length**2
    point = at["points"]["A"]
    assert point["y"] == pytest.approx(0.1 + s, abs=1e-12)
    assert point["vy"] == pytest.approx(v * omega, abs=1e-12)
    assert point["ay"] == pytest.approx(a * omega**2, abs=1e-9)


@each("sense, n, way", [("same", 60, 1), ("opposite", 60, -1), ("same", -60, -1)])
def test_a_rocker_turns_by_the_law_and_the_sense(
    tmp_path: Path, sense: str, n: float, way: int
) -> None:
    u, length, omega = 30 / 90, radians(90), 2 * pi
    at = solved(tmp_path, filled(ROCKER, cam=30, n=n, sense=sense))
    swing = radians(25)
    link = at["links"]["1"]
    turned = swing * (u - sin(2 * pi * u) / (2 * pi))
    assert link["phi_deg"] == pytest.approx(100 + way * np.degrees(turned), abs=1e-9)
    speed = swing * (1 - cos(2 * pi * u)) / length * omega
    assert link["omega"] == pytest.approx(way * speed, rel=1e-10)
    gain = swing * 2 * pi * sin(2 * pi * u) / length**2 * omega**2
    assert link["epsilon"] == pytest.approx(way * gain, rel=1e-10)


def test_the_whole_linkage_moves_as_differences_over_the_angle_of_the_cam_say(
    tmp_path: Path,
) -> None:
    step, omega = 0.01, 120 * pi / 30
    low, here, high = (
        solved(tmp_path, filled(SLIDER, cam=repr(50 + k * step), n=120))["points"]["B"]
        for k in (-1, 0, 1)
    )
    for axis in "xy":
        rate = (high[axis] - low[axis]) / (2 * radians(step)) * omega
        gain = (high["v" + axis] - low["v" + axis]) / (2 * radians(step)) * omega
        assert here["v" + axis] == pytest.approx(rate, abs=1e-7)
        assert here["a" + axis] == pytest.approx(gain, abs=1e-5)


def test_variants_are_other_angles_and_the_given_says_the_cam(tmp_path: Path) -> None:
    body = filled(SLIDER, cam=20, n=120) + "\n[variants.90.driver]\ncam = 90\n"
    one = solved(tmp_path, body)
    other = solved(tmp_path, body, "--variant", "90")
    assert one["points"]["A"]["y"] < other["points"]["A"]["y"]
    path = tmp_path / "lift.toml"
    for lang, said in (("ru", "толкатель кулачка"), ("en", "the follower of a cam")):
        run = CliRunner().invoke(cli, ["protocol", str(path), "--lang", lang])
        assert run.exit_code == 0, run.output
        assert said in " ".join(run.output.split())
    run = CliRunner().invoke(cli, ["sheet", str(path), "--format", "svg", "-o", str(tmp_path)])
    assert run.exit_code == 0, run.output
    assert "left out" not in run.output


@each(
    "body, said",
    [
        (filled(SLIDER, cam=20, n=0), "cam.n: missing"),
        (filled(SLIDER, cam=20, n=120).replace("s = 0.1", "s = [0, 0.1]"), "one place is expected"),
        (filled(SLIDER, cam=20, n=120).replace("s = 0.1", ""), "driver.s: missing"),
        (filled(SLIDER, cam=20, n=120).replace("s = 0.1", "s = 0.1\nv = 2"), "does not go with"),
        (filled(SLIDER, cam='"top"', n=120), "driver.cam"),
        (filled(SLIDER, cam=20, n=120).replace("stroke", "strake"), "unknown key"),
        (filled(SLIDER, cam=20, n=120).partition("[cam]")[0], "the file has no cam"),
        (
            filled(ROCKER, cam=20, n=60, sense="same").partition("[cam]")[0]
            + "[cam]"
            + filled(SLIDER, cam=20, n=120).partition("[cam]")[2],
            "an oscillating one a crank",
        ),
        (
            filled(ROCKER, cam=20, n=60, sense="same") + '\n[cycle]\noutput = "B"\n',
            "not of a cam's follower",
        ),
    ],
)
def test_a_faulty_drive_is_said(tmp_path: Path, body: str, said: str) -> None:
    path = tmp_path / "faulty.toml"
    path.write_text(body, encoding="utf-8")
    run = CliRunner().invoke(cli, ["solve", str(path), "--lang", "en"])
    assert run.exit_code == 3, run.output
    assert said in run.output
    assert "Traceback" not in run.output
