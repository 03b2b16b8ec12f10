"""The least cam: against brute force, its angles, its roller, undercut, the record of it."""

from __future__ import annotations

import json
from math import atan, degrees, hypot, radians, sqrt, tan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cams import LAWS, broken, designed, least_translating, random_cam, written
from cases import some
from click.testing import CliRunner
from doors import CamDesign, CamPhase, ProblemError, cams_reader_load as load, cli

WANTED: dict[str, Any] = {
    "follower": "translating",
    "contact": "roller",
    "stroke": 0.04,
    "rise": 120,
    "upper_dwell": 10,
    "return": 120,
    "law": {"rise": "3-4-5", "return": "cosine"},
    "pressure": {"rise": 30, "return": 45},
    "offset": "choose",
    "roller": 0.01,
    "count": 24,
    "n": 180,
}


def told(path: Path) -> dict[str, Any]:
    done = CliRunner().invoke(cli, ["solve", str(path), "--json"])
    assert done.exit_code == 0, done.output
    found: dict[str, Any] = json.loads(done.stdout)
    return found


@pytest.mark.parametrize("seed", range(some(300, 24)))
def test_the_least_cam_is_that_of_brute_force(seed: int, tmp_path: Path) -> None:
    keys = random_cam(seed)
    design = designed(tmp_path, keys)
    found = design.pitch_geometry.r_min
    if keys["follower"] == "translating":
        assert found == pytest.approx(least_translating(keys), rel=1e-9)
        return
    axis = design.axis
    assert broken(keys, axis) <= 1e-12
    assert abs(axis) == found
    # Nowhere about it is there a nearer one: the places are convex, so near ones are enough.
    for turn in np.linspace(-0.02, 0.02, 41):
        nearer = axis * complex(np.exp(1j * turn)) * (1 - 1e-9)
        assert broken(keys, nearer) > 0


def test_the_record_of_a_cam_has_the_agreed_keys(tmp_path: Path) -> None:
    found = told(written(tmp_path, WANTED))
    assert found["kind"] == "cam"
    assert found["centre_distance"] is None and found["undercut"] is None
    assert found["roller"] == 0.01
    e, r_min = found["e"], found["r_min"]
    s0 = sqrt(r_min**2 - e**2)
    rows = found["positions"]
    assert [row["phi_deg"] for row in rows] == [15.0 * k for k in range(24)]
    for row in rows:
        angle = degrees(atan((row["v_q"] - e) / (s0 + row["s"])))
        assert row["pressure_deg"] == pytest.approx(angle, abs=1e-9)
        turn = np.exp(-1j * radians(row["phi_deg"]))
        place = complex(e, s0 + row["s"]) * turn
        assert complex(row["x_theoretical"], row["y_theoretical"]) == pytest.approx(place)
        actual = complex(row["x"], row["y"])
        assert abs(actual - place) == pytest.approx(0.01)
        assert abs(actual) < abs(place)
    assert max(row["pressure_deg"] for row in rows) <= 30 + 1e-9
    assert found["pressure_deg"]["rise"] == pytest.approx(30)
    assert found["pressure_deg"]["return"] == pytest.approx(45)
    assert 0 < found["pressure_deg"]["at_deg"]["rise"] < 120
    # Both limits at once: the axis is where the two lines meet.
    value, slope = LAWS["3-4-5"]
    u = found["pressure_deg"]["at_deg"]["rise"] / 120
    v = 0.04 * float(slope(np.array(u))) / radians(120)
    assert v - e == pytest.approx(tan(radians(30)) * (s0 + 0.04 * float(value(np.array(u)))))


def test_a_clockwise_cam_is_the_mirror_image(tmp_path: Path) -> None:
    one = told(written(tmp_path, WANTED))
    other = told(written(tmp_path, WANTED | {"n": -180}))
    assert one["e"] == other["e"] and one["r_min"] == other["r_min"]
    for row, seen in zip(one["positions"], other["positions"], strict=True):
        assert seen == row | {"x": -row["x"], "x_theoretical": -row["x_theoretical"]}


def test_an_offset_that_is_given_is_kept_and_the_depth_is_the_least(tmp_path: Path) -> None:
    free = designed(tmp_path, WANTED).pitch_geometry
    for e in (0.0, free.e, 0.02, -0.01):
        bare = designed(tmp_path, WANTED | {"offset": e}).pitch_geometry
        assert bare.e == e
        assert bare.r_min >= free.r_min * (1 - 1e-12)
        assert bare.r_min == pytest.approx(least_translating(WANTED | {"offset": e}), rel=1e-9)


def test_given_sizes_are_kept_and_the_limits_that_they_break_are_reported(tmp_path: Path) -> None:
    design = designed(tmp_path, WANTED | {"r_min": 0.02, "offset": 0.005})
    assert (design.pitch_geometry.r_min, design.pitch_geometry.e) == (0.02, 0.005)
    text = CliRunner().invoke(cli, ["solve", str(tmp_path / "cam.toml"), "--lang", "en"]).output
    assert "MORE than the allowed 30°" in text
    mild = designed(tmp_path, WANTED | {"r_min": 0.05})
    assert mild.pitch_geometry.r_min == pytest.approx(0.05)
    assert mild.pressure(CamPhase.RISE).value < radians(30)


def test_the_centre_of_an_arm_that_is_given_is_kept(tmp_path: Path) -> None:
    keys = {
        "follower": "oscillating", "swing": 20, "arm": 0.12, "rise": 100, "upper_dwell": 20,
        "return": 90, "law": {"rise": "4-5-6-7", "return": "sine"}, "sense": "opposite",
        "pressure": {"rise": 40, "return": 50},
    }  # fmt: skip
    free = designed(tmp_path, keys).pitch_geometry
    own = designed(tmp_path, keys | {"centre": 0.15})
    assert own.pitch_geometry.centre == pytest.approx(0.15)
    assert own.pitch_geometry.r_min >= free.r_min
    assert abs(broken(keys, own.axis)) < 1e-12  # it touches a limit
    at = designed(tmp_path, keys | {"centre": free.centre}).pitch_geometry
    assert at.r_min == pytest.approx(free.r_min, rel=1e-6)


@pytest.mark.parametrize("sharp", [False, True])
def test_the_roller_is_chosen_by_both_limits(sharp: bool, tmp_path: Path) -> None:
    keys = {name: value for name, value in WANTED.items() if name != "roller"}
    if sharp:
        # With an offset no place of the axis is searched for: that is not meant here.
        keys |= {"law": {"law": "linear", "blend": 0.02}, "r_min": 0.06, "offset": 0.0}
    design = designed(tmp_path, keys)
    by_size, by_bend = 0.4 * design.pitch_geometry.r_min, 0.8 * design.rho_min.value
    assert (by_bend < by_size) is sharp
    assert min(by_size, by_bend) - 0.0005 < design.geometry.roller <= min(by_size, by_bend)
    assert design.undercut is None


def test_the_roller_of_a_groove_keeps_its_outer_side_too(tmp_path: Path) -> None:
    keys = {name: value for name, value in WANTED.items() if name != "roller"}
    keys |= {"closure": "form", "law": {"law": "linear", "blend": 0.05}, "pressure": 45}
    keys |= {"offset": 0.0}  # no place of the axis is searched for: that is not meant here
    design = designed(tmp_path, keys)
    assert 0.8 * design.hollow.value - 0.0005 < design.geometry.roller <= 0.8 * design.hollow.value
    found = told(written(tmp_path, keys | {"roller": 1.2 * design.hollow.value}))
    assert found["undercut"] is not None


def test_undercut_is_named_with_its_place(tmp_path: Path) -> None:
    keys = WANTED | {"offset": 0, "law": "3-4-5", "pressure": 30, "stroke": 0.025, "rise": 90}
    keys |= {"return": 80, "upper_dwell": 30, "roller": 0.033}
    path = written(tmp_path, keys)
    found = told(path)["undercut"]
    design = CamDesign(load(path))
    phi = np.linspace(0, 2 * np.pi, 36_001)
    rho = 1 / design.geometry.at(phi).curvature
    convex = np.where(rho > 0, rho, np.inf)
    assert found["rho"] == pytest.approx(convex.min(), rel=1e-6)
    assert found["phi_deg"] == pytest.approx(degrees(phi[np.argmin(convex)]), abs=0.02)
    cut = np.degrees(phi[convex < 0.033])
    assert found["from_deg"] == pytest.approx(cut.min(), abs=0.02)
    assert found["to_deg"] == pytest.approx(cut.max(), abs=0.02)
    assert hypot(found["x"], found["y"]) < design.geometry.r_min
    assert told(written(tmp_path, keys | {"roller": 0.03}))["undercut"] is None


def test_a_corner_of_the_profile_is_an_undercut_of_any_roller(tmp_path: Path) -> None:
    found = told(written(tmp_path, WANTED | {"law": "linear"}))
    assert found["curvature_min"] == 0.0
    assert found["undercut"]["phi_deg"] == pytest.approx(120.0)
    assert [jump["of"] for jump in found["jumps"]] == ["v_q"] * 4
    assert [round(jump["phi_deg"]) for jump in found["jumps"]] == [0, 120, 130, 250]


def test_a_plate_takes_the_least_distance_that_keeps_the_profile_convex(tmp_path: Path) -> None:
    keys = {"follower": "translating", "contact": "flat", "stroke": 0.02, "rise": 120}
    keys |= {"upper_dwell": 30, "return": 110, "law": "cosine", "curvature": 0.004}
    found = told(written(tmp_path, keys))
    problem = load(tmp_path / "cam.toml")
    lowest = min(
        float((moved[0] + moved[2]).min())
        for one in problem.stretches
        for moved in [problem.on(one, np.linspace(one.start, one.end, 200_001))]
    )
    assert found["r_min"] == pytest.approx(0.004 - lowest, rel=1e-9)
    assert found["curvature_min"] == pytest.approx(0.004)
    assert all(row["pressure_deg"] == 0 for row in found["positions"])
    assert told(written(tmp_path, keys | {"r_min": found["r_min"] - 0.005}))["undercut"]["rho"] < 0


def test_a_cam_of_a_linkage_turns_as_its_crank(tmp_path: Path) -> None:
    crank = '[links.1]\npoints = ["O"]\n[driver]\nlink = "1"\nn = -90\n'
    path = written(
        tmp_path, {name: WANTED[name] for name in ("follower", "stroke", "rise", "return")}
    )
    path.write_text(path.read_text("utf-8") + crank, "utf-8")
    assert load(path).n == -90


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"stroke": 40}, "expected a length in m from 0.0001 to 10"),
        ({"rise": 200, "return": 170}, "the phases are 380° in all"),
        ({"follower": "oscillating"}, "swing = 20"),
        ({"law": "sinus"}, "Did you mean 'sine'"),
        ({"law": {"law": "table", "values": [1, 1, 1]}}, "does not come to rest"),
        ({"law": {"law": "sine", "ratio": 2}}, "law 'sine' has none"),
        ({"contact": "flat", "roller": 0.01}, "valid only with contact = 'roller'"),
        ({"r_min": 0.01, "offset": 0.02}, "the least radius is 0.01 m"),
        ({"swing": 20}, "a translating follower has none"),
        ({"closure": "form", "contact": "pointed"}, "only a roller runs in a groove"),
    ],
)  # fmt: skip
def test_a_fault_is_one_clear_message(change: dict[str, Any], said: str, tmp_path: Path) -> None:
    path = written(tmp_path, {k: v for k, v in WANTED.items() if k != "roller"} | change)
    done = CliRunner().invoke(cli, ["solve", str(path), "--lang", "en"])
    assert done.exit_code == 3
    assert said in done.output
    assert "Traceback" not in done.output


def test_pressure_angles_that_no_cam_keeps_are_reported(tmp_path: Path) -> None:
    keys = {"follower": "oscillating", "swing": 60, "arm": 0.1, "rise": 40, "return": 40}
    path = written(tmp_path, keys | {"pressure": {"rise": 10, "return": 10}})
    done = CliRunner().invoke(cli, ["solve", str(path), "--lang", "en"])
    assert done.exit_code == 3
    assert "no place of the axis keeps the allowed pressure angles" in done.output


@pytest.mark.parametrize("sense", [1, -1])
def test_the_line_of_the_follower_passes_within_the_least_radius(
    sense: int, tmp_path: Path
) -> None:
    sizes = WANTED | {"r_min": 0.03}
    load(written(tmp_path, sizes | {"offset": 0.029 * sense}))
    with pytest.raises(ProblemError) as error:
        load(written(tmp_path, sizes | {"offset": 0.03 * sense}))
    assert [fault.path for fault in error.value.faults] == ["cam.offset"]
