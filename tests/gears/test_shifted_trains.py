"""Trains of profile-shifted wheels: centre distances suit the shifts in every output."""

from __future__ import annotations

import json
import math
import random
from fractions import Fraction
from pathlib import Path
from typing import Any

import mpmath
import pytest
from cases import each, some
from click.testing import CliRunner
from doors import (
    DRAFTING_PROFILES as PROFILES,
    ProblemError,
    TrainMotion,
    answer,
    cli,
    conditions,
    draw,
    gears_construction_construct as construct,
    get_language,
    judgement,
    read,
)
from trains import mesh, solved

MODULE = 2.0


def apart(teeth: int, shifts: float) -> float:
    """Distance of the axes in modules by GOST 16532: sums, or differences of an internal mesh."""
    with mpmath.workdps(25):
        alpha = mpmath.radians(20)
        lag = mpmath.tan(alpha) - alpha + 2 * mpmath.mpf(shifts) * mpmath.tan(alpha) / teeth
        working = mpmath.findroot(lambda t: mpmath.tan(t) - t - lag, mpmath.mpf("0.4"))
        return float(mpmath.mpf(teeth) / 2 * mpmath.cos(alpha) / mpmath.cos(working))


def shift_to(teeth: int, distance: float) -> float:
    """Sum of shifts that sets axes so far apart."""
    alpha = math.radians(20)
    working = math.acos(teeth / 2 * math.cos(alpha) / distance)
    grown = math.tan(working) - working - math.tan(alpha) + alpha
    return grown * teeth / (2 * math.tan(alpha))


def told(z: dict[str, int], x: dict[str, float], kind: str, rest: str = "") -> str:
    wheels = ", ".join(f'"{w}" = {{ z = {z[w]}, x = {x[w]!r} }}' for w in z)
    rim = "2'" if "2'" in z else "2"
    meshes = f"{mesh('1', '2', carrier='H')}, {mesh(rim, '3', kind, 'H')}"
    return (
        f"wheels = {{ {wheels} }}\nmeshes = [ {meshes} ]\nmodule = {MODULE}\n"
        f'fixed = ["3"]\nn = {{ 1 = 1000 }}\n{rest}'
    )


def made(rng: random.Random) -> tuple[dict[str, int], dict[str, float], str]:
    """A planetary set off the teeth that meet without shifts, its axes brought together by x_3."""
    kind, z = rng.choice(("internal", "external")), {"1": rng.randint(18, 40)}
    z["2"] = rng.randint(18, 40)
    if kind == "external" or rng.random() < 0.5:
        z["2'"] = rng.randint(18, 40)
    rim = z.get("2'", z["2"])
    whole = z["1"] + z["2"] + (rim if kind == "internal" else -rim)
    z["3"] = whole + rng.choice((-1, 0, 1))
    x = {w: round(rng.uniform(-0.1, 0.5), 3) for w in z}
    distance = apart(z["1"] + z["2"], x["1"] + x["2"])
    own = x.get("2'", x["2"])
    if kind == "internal":
        x["3"] = shift_to(z["3"] - rim, distance) + own
    else:
        x["3"] = shift_to(z["3"] + rim, distance) - own
    return z, x, kind


def height(motion: TrainMotion) -> float:
    return float(abs(motion.axes.heights[motion.train.body_of["2"]])) / 2


def test_the_axes_of_shifted_wheels_are_at_their_centre_distances(tmp_path: Path) -> None:
    """Speeds, a_w, the picture and its construction, of sets that only shifts bring together."""
    rng, done = random.Random(5), 0
    while done < some(40, few=10):
        try:
            z, x, kind = made(rng)
        except ValueError:
            continue
        if z["3"] < 15 or abs(x["3"]) > 2:
            continue
        rim = z.get("2'", z["2"])
        held = Fraction(z["2"] * z["3"], z["1"] * rim) * (-1 if kind == "internal" else 1)
        if held == 1:
            continue
        done += 1
        x["3"] = round(x["3"], 6)
        motion = solved(tmp_path, told(z, x, kind))
        assert motion.speeds["H"] == Fraction(1000) / (1 - held)
        way = -1 if kind == "internal" else 1
        own = "2'" if "2'" in z else "2"
        due = apart(z["1"] + z["2"], x["1"] + x["2"])
        other = apart(z["3"] + way * rim, x["3"] + way * x[own])
        assert due == pytest.approx(other, abs=1e-4)
        for name, value in (("a_w_1_2", due), (f"a_w_{own}_3", other)):
            assert answer(motion, name).value == pytest.approx(MODULE * value, rel=1e-9)
        assert height(motion) == pytest.approx(due, abs=1e-4)
        (one,) = [c for c in conditions(motion) if c.name == "coaxiality"]
        assert one.is_satisfied
        picture = draw(motion)
        assert picture is not None
        per = 1 / float(picture.mu_l) / 1000 * MODULE
        at = {p.at.name: float(p.height_mm) / per for p in picture.contacts}
        up = height(motion)
        assert at["pitch 1-2"] == pytest.approx(up * z["1"] / (z["1"] + z["2"]), rel=1e-6)
        assert at[f"pitch {own}-3"] == pytest.approx(up * z["3"] / (z["3"] + way * rim), rel=1e-6)
        read(construct(motion, picture), PROFILES["board"])  # compares with the equations


@each("ring, is_near", [("60", True), ("{ z = 60, x = 0.0841 }", True), ("62", False)])
def test_shifts_are_counted_before_a_train_is_called_not_coaxial(
    ring: str, is_near: bool, tmp_path: Path
) -> None:
    """A planet of 17 with x = 0.54 between 24 and 60 teeth, which would be 18 without."""
    text = (
        f"wheels = {{ 1 = 24, 2 = {{ z = 17, x = 0.54 }}, 3 = {ring} }}\nmodule = 2\n"
        f"meshes = [ {mesh('1', '2', carrier='H')}, {mesh('2', '3', 'internal', 'H')} ]\n"
        'fixed = ["3"]\nn = { 1 = 1000 }\n'
    )
    if not is_near:
        with pytest.raises(ProblemError) as error:
            solved(tmp_path, text)
        (fault,) = error.value.faults
        assert "41.99" in fault.message or "41.9956" in fault.message
        return
    motion = solved(tmp_path, text)
    assert float(motion.speeds["H"]) == pytest.approx(285.714, abs=1e-3)
    assert answer(motion, "a_w_1_2").value == pytest.approx(41.995598, abs=1e-5)
    (one,) = [c for c in conditions(motion) if c.name == "coaxiality"]
    said = judgement(one, get_language("en"))
    assert one.is_satisfied == ("x" in ring)
    assert "a_w1-2 = 41.996" in said
    assert one.is_satisfied or "0.224 mm apart; one with x_3 = 0.086" in said


def test_a_sheet_of_shifted_wheels_is_drawn(tmp_path: Path) -> None:
    path = tmp_path / "train.toml"
    path.write_text(
        "[gears]\nwheels = { 1 = 24, 2 = { z = 17, x = 0.54 }, 3 = { z = 60, x = 0.086 } }\n"
        f"meshes = [ {mesh('1', '2', carrier='H')}, {mesh('2', '3', 'internal', 'H')} ]\n"
        'module = 2\nfixed = ["3"]\nn = { 1 = 1000 }\nask = ["n_H", "a_w_1_2"]\n',
        encoding="utf-8",
    )
    out = ["-o", str(tmp_path)]
    for command, *options in (["sheet", "--format", "svg", *out], ["live", *out], ["protocol"]):
        run = CliRunner().invoke(cli, [command, str(path), *options])
        assert run.exit_code == 0, run.output


# Pulleys ------------------------------------------------------------------------------------------


@each("kind, sign", [("belt", 1), ("crossed belt", -1)])
def test_a_pulley_beside_wheels_with_a_module_has_a_radius(
    kind: str, sign: int, tmp_path: Path
) -> None:
    path = tmp_path / "belt.toml"
    path.write_text(
        "[gears]\nwheels = { 1 = { r = 0.05 }, 2 = { r = 0.12 }, 3 = 20, 4 = 50 }\n"
        f'meshes = [ {mesh("1", "2", kind)}, {mesh("3", "4")} ]\nbodies = [["2", "3"]]\n'
        'module = 3\nn = { 1 = -960 }\nask = ["U_1_2", "n_2", "r_1", "z_1"]\n',
        encoding="utf-8",
    )
    run = CliRunner().invoke(cli, ["solve", str(path), "--json"])
    assert run.exit_code == 0, run.output
    found: dict[str, Any] = json.loads(run.output)["gears"]
    assert found["radii_m"] == {"1": 0.05, "2": 0.12}
    assert found["teeth"] == {"3": 20, "4": 50}
    assert found["asked"]["U_1_2"]["value"] == sign * 2.4
    assert found["asked"]["r_1"]["value"] == 50
    assert found["asked"]["z_1"]["value"] is None
    for command in ("solve", "protocol"):
        run = CliRunner().invoke(cli, [command, str(path), "--lang", "en"])
        said = " ".join(run.output.split())
        assert f"U₁₂ = {'−' if sign < 0 else ''}r₂/r₁" in said
        assert "33.33" not in said
