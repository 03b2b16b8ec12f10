"""Every number of a cam's texts and records, by differences and rotations of the law alone."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from math import pi, radians
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
from cams import LAWS, written
from cases import each
from click.testing import CliRunner
from doors import CamQuantities, cams_reader_load as load, cli

PHASES = {"rise": 100, "upper_dwell": 20, "return": 110}
LINE = {**PHASES, "follower": "translating", "stroke": 0.03, "count": 24}
ARM = {**PHASES, "follower": "oscillating", "swing": 20, "arm": 0.12, "centre": 0.15, "count": 24}
SMOOTH = {"rise": "3-4-5", "return": "4-5-6-7"}
PUSHED = {"n": 240, "mass": 2.5, "load": 40, "margin": 1.3, "roller": 0.008}

CAMS: dict[str, dict[str, Any]] = {
    "offset": {**LINE, **PUSHED, "law": SMOOTH, "pressure": {"rise": 30, "return": 45}},
    "steep, clockwise": {
        **LINE, **PUSHED, "law": {"rise": "cosine", "return": "sine"}, "r_min": 0.02,
        "pressure": {"rise": 30, "return": 35}, "offset": -0.005, "n": -240,
    },
    "undercut, clockwise": {
        **LINE, "law": SMOOTH, "r_min": 0.02, "offset": 0.004, "pressure": 30, "roller": 0.012,
        "n": -60,
    },
    "groove": {
        **LINE, **PUSHED, "closure": "form", "law": {"rise": "sine", "return": "3-4-5"},
        "r_min": 0.05, "offset": 0.01, "pressure": 40,
    },
    "pointed": {
        **LINE, "contact": "pointed", "law": {"rise": "linear", "return": "constant-acceleration"},
        "r_min": 0.06, "offset": 0, "pressure": 40,
    },
    "against": {
        **ARM, **PUSHED, "law": SMOOTH, "sense": "opposite", "r_min": 0.06,
        "pressure": {"rise": 40, "return": 50},
    },
    "along, clockwise": {
        **ARM, **PUSHED, "law": {"rise": "cosine", "return": "sine"}, "sense": "same",
        "r_min": 0.06, "pressure": {"rise": 40, "return": 50}, "n": -240,
    },
    "plate": {**LINE, "contact": "flat", "law": SMOOTH, "offset": 0.004, "curvature": 0.005},
    "hollow plate": {**LINE, "contact": "flat", "law": "cosine", "r_min": 0.012},
    "plate on an arm": {
        **ARM, "contact": "flat", "law": SMOOTH, "sense": "same", "r_min": 0.06, "n": -60,
    },
}  # fmt: skip
SIZES = ("r_min", "e", "centre_distance", "roller")
STEP = 1e-4
Asked = dict[tuple[str, int], float]


class OwnCam:
    """A cam of a file's keys and the sizes found, by the positions of its follower alone."""

    def __init__(self, keys: dict[str, Any], sizes: dict[str, Any]) -> None:
        self.keys = keys
        self.r_min, self.e, self.a, self.roller = (float(sizes[name] or 0.0) for name in SIZES)
        ends = np.radians(np.cumsum([0, keys["rise"], keys["upper_dwell"], keys["return"]]))
        self.ends = [*map(float, ends), 2 * pi]
        law = keys["law"]
        self.laws = law if isinstance(law, dict) else {"rise": law, "return": law}
        self.is_flat, self.turns = keys.get("contact") == "flat", "swing" in keys
        self.arm = keys.get("arm", 1.0)
        self.size = radians(keys["swing"]) if self.turns else keys["stroke"]
        self.mirror = -1 if keys.get("n", 1) < 0 else 1

    def lift(self, part: int, phi: Any) -> Any:
        """Return s, of an arm its angle, by the law of a part of the turn."""
        u = (phi - self.ends[part]) / (self.ends[part + 1] - self.ends[part])
        if part % 2:
            return np.full(np.shape(phi), self.size if part == 1 else 0.0)
        value, _ = LAWS[self.laws["return" if part else "rise"]]
        return self.size * (1 - value(u) if part else value(u))

    def motion(self, part: int, phi: Any) -> tuple[Any, Any, Any]:
        """Return s, v_q and a_q by differences, along the path of an arm's end."""
        low, here, high = (self.arm * self.lift(part, phi + k * STEP) for k in (-1, 0, 1))
        return here, (high - low) / (2 * STEP), (high - 2 * here + low) / STEP**2

    def place(self, part: int, phi: Any) -> tuple[Any, Any]:
        """Return the follower's centre and the way it moves, turned back with the cam."""
        turn, s = np.exp(-1j * phi), self.lift(part, phi)
        if not self.turns:
            return (self.e + 1j * (np.sqrt(self.r_min**2 - self.e**2) + s)) * turn, 1j * turn
        side = 1 if self.keys["sense"] == "opposite" else -1
        arm, a = self.arm, self.a
        delta = np.arccos((a * a + arm * arm - self.r_min**2) / (2 * a * arm)) + s
        out = -side * np.exp(-1j * side * delta)
        return (side * a + arm * out) * turn, -1j * side * out * turn

    def face(self, part: int, phi: Any) -> tuple[Any, Any]:
        """Return a plate's distance from the axis and the angle of its normal, with the cam."""
        s = self.lift(part, phi)
        if not self.turns:
            return self.r_min + s, pi / 2 - phi
        side = 1 if self.keys["sense"] == "opposite" else -1
        delta = np.arcsin(self.r_min / self.a) + s
        return self.a * np.sin(delta), pi / 2 - side * delta - phi

    def profile(self, part: int, phi: Any) -> tuple[Any, Any, Any, Any]:
        """Return the profile, the pitch curve, ρ of it and the pressure angle, rad."""

        def touched(x: Any) -> Any:
            (p0, t0), (p, t), (p1, t1) = (self.face(part, x + k * STEP) for k in (-1, 0, 1))
            return (p + 1j * (p1 - p0) / (t1 - t0)) * np.exp(1j * t)

        step = 1e-3
        curve = touched if self.is_flat else lambda x: self.place(part, x)[0]
        low, here, high = (curve(phi + k * step) for k in (-1, 0, 1))
        first, second = (high - low) / (2 * step), (high - 2 * here + low) / step**2
        if self.is_flat:
            turned = self.face(part, phi + step)[1] - self.face(part, phi - step)[1]
            along = 1j * np.exp(1j * self.face(part, phi)[1])
            rho = np.real((high - low) * np.conj(along)) / turned
            return here, here, rho, np.zeros(np.shape(phi))
        with np.errstate(divide="ignore"):
            rho = -(np.abs(first) ** 3) / np.imag(np.conj(first) * second)
        normal = 1j * first / np.abs(first)
        return here - self.roller * normal, here, rho, np.angle(normal / self.place(part, phi)[1])

    def part(self, phi: float) -> int:
        return next(k for k in range(4) if phi < self.ends[k + 1] - 1e-9)

    def grid(self, part: int, count: int = 4001) -> Any:
        start, end = self.ends[part : part + 2]
        return np.linspace(start + 2e-3, end - 2e-3, count)


@cache
def solved(name: str) -> tuple[dict[str, Any], str, OwnCam, Asked]:
    """Return the record of a cam, its text, its own computation and its questions."""
    keys = CAMS[name]
    with TemporaryDirectory() as folder:
        path = written(Path(folder), keys)
        record, text = (
            CliRunner().invoke(cli, ["solve", str(path), *words]).stdout
            for words in (["--json"], ["--lang", "en"])
        )
        figures = CamQuantities(load(path))
        asked = {
            (one, k): figures.quantity(one, k).value  # type: ignore[union-attr]
            for one in figures.names
            for k in ((3, 11, 17) if one in ("s", "v_q", "a_q", "theta") else (0,))
        }
    found = json.loads(record)
    text = re.sub(r"\n {4}(?=\S)", " ", text.replace("−", "-").replace("\u00a0", " "))
    return found, text, OwnCam(keys, found), asked


def numbers(line: str) -> list[float]:
    return [float(one) for one in re.findall(r"-?\d+(?:\.\d+)?", line)]


def close(value: float, rel: float = 2e-3, tolerance: float = 6e-3) -> Any:
    return pytest.approx(value, rel=rel, abs=tolerance)


@each("name", CAMS)
def test_positions_of_the_record_are_those_of_the_turned_follower(name: str) -> None:
    record, _, own, asked = solved(name)
    assert len(record["positions"]) == 24
    for k, row in enumerate(record["positions"]):
        phi = np.array([2 * pi * k / 24])
        part = own.part(float(phi[0]))
        at_end = min(abs(float(phi[0]) - end) for end in own.ends) < 2e-3
        assert row["phi_deg"] == pytest.approx(15.0 * k)
        s, v, a = own.motion(part, phi)
        assert row["s"] == pytest.approx(s[0], abs=1e-9)
        if at_end:
            continue
        actual, pitch, rho, pressure = own.profile(part, phi)
        assert (row["v_q"], row["a_q"]) == (close(v[0], 1e-4, 1e-6), close(a[0], 1e-4, 1e-5))
        for x, y, due in (("x", "y", actual), ("x_theoretical", "y_theoretical", pitch)):
            assert complex(own.mirror * row[x], row[y]) == pytest.approx(due[0], abs=1e-6), x
        assert row["pressure_deg"] == close(np.degrees(pressure[0]), 1e-4, 1e-3)
        if row["rho"] is not None and abs(rho[0]) < 1.0:
            assert row["rho"] == close(rho[0], 1e-3, 1e-5)
        for column, value in (("s", s), ("v_q", v), ("a_q", a), ("theta", np.degrees(pressure))):
            if (column, k) in asked:
                assert asked[column, k] == close(value[0], 1e-3, 1e-4), column


@each("name", CAMS)
def test_sizes_and_checks_of_the_text_are_the_extremes_over_the_turn(name: str) -> None:
    record, text, own, asked = solved(name)
    curves = [(own.grid(k), own.profile(k, own.grid(k))) for k in range(4)]
    rho = np.concatenate([one[2] for _, one in curves])
    phi = np.degrees(np.concatenate([one for one, _ in curves]))
    convex = np.where(rho > 0, rho, np.inf)
    least = float(rho.min() if own.is_flat else convex.min())
    due = {"r_0" if own.is_flat else "r_min": own.r_min, "r_p": own.roller, "a": own.a}
    if not own.turns and not own.is_flat:
        due |= {"e": own.e, "s_0": np.sqrt(own.r_min**2 - own.e**2)}
    sizes = text[text.index("\nSizes") : text.index("\nChecks")]
    rows = re.findall(r"(?m) (\S+) +(-?[\d.]+)$", sizes)
    shown = {key.replace("₀", "_0"): float(value) for key, value in rows}
    for symbol, value in due.items():
        if value or symbol == "e":
            assert shown[symbol] == close(1000 * value), (symbol, sizes)
    if name != "pointed":  # its profile has corners
        assert shown["ρ_min"] == close(1000 * least)
        assert asked["rho_min", 0] == pytest.approx(least, rel=1e-3)
    lines = text[text.index("\nChecks") : text.index("\nPositions")]
    _check_pressure(lines, record, own, curves, asked)
    cut = next((line for line in lines.splitlines() if "UNDERCUT" in line), None)
    below = phi[convex < own.roller] if not own.is_flat else phi[rho < 0]
    if name == "pointed":
        return
    assert (cut is not None) == bool(len(below)), lines
    if cut is not None:
        start, end, radius, *more = numbers(cut.replace("UNDERCUT", ""))
        assert (start, end) == (
            close(below.min(), tolerance=0.1),
            close(below.max(), tolerance=0.1),
        )
        worst, x, y = more[-3:]
        k = int(np.argmin(rho if own.is_flat else convex))
        assert (radius, worst) == (close(1000 * least), close(phi[k], tolerance=0.2))
        pitch = np.concatenate([one[0 if own.is_flat else 1] for _, one in curves])[k]
        actual = np.concatenate([one[0] for _, one in curves])[k]
        where = complex(own.mirror * x, y)
        assert min(abs(where - 1000 * one) for one in (pitch, actual)) < 0.2
    else:
        at = re.search(r"ρ_min = (\S+) mm at φ = (\S+)°", lines)
        assert at is not None
        near = int(np.argmin(np.abs(phi - float(at[2]))))
        assert (float(at[1]), rho[near]) == (close(1000 * least), close(least, tolerance=2e-5))
    if own.roller:
        line = next(line for line in lines.splitlines() if "0.8·ρ_min" in line)
        assert numbers(line)[-1] == close(800 * least)
        assert float(line.split("0.4·r_min = ")[1].split(" ")[0]) == close(400 * own.r_min)


def _check_pressure(
    lines: str, record: dict[str, Any], own: OwnCam, curves: list[Any], asked: Asked
) -> None:
    """Compare the sentences on the pressure angles: size, place, limit, verdict."""
    told = [line for line in lines.splitlines() if "pressure angle of the" in line]
    assert len(told) == (0 if own.is_flat else 2)
    for line, part, phase in zip(told, (0, 2), ("rise", "return"), strict=bool(told)):
        assert f"of the {phase} reaches" in line
        phi, (_, _, _, pressure) = curves[part]
        most = float(np.degrees(np.abs(pressure).max()))
        value, at, *limit = numbers(line)
        near = int(np.argmin(np.abs(np.degrees(phi) - at)))
        assert value == close(most)
        assert np.degrees(abs(pressure[near])) == close(most, tolerance=0.02)
        assert record["pressure_deg"][phase] == close(most)
        assert record["pressure_deg"]["at_deg"][phase] == close(at, tolerance=0.01)
        assert asked["theta_max" if phase == "rise" else "theta_max_return", 0] == close(most)
        due = own.keys["pressure"]
        due = due if isinstance(due, dict) else {"rise": due}
        if phase in due:
            assert limit == [due[phase]]
            assert ("MORE than the allowed" in line) == (most > 1.0001 * due[phase]), line
        else:
            assert not limit or limit == [due["rise"]]


@each("name", CAMS)
def test_impacts_are_the_jumps_of_the_derivatives_in_the_order_of_the_turn(name: str) -> None:
    record, text, own, _ = solved(name)
    due = []
    for k in range(4):
        end, then = own.ends[k + 1], (k + 1) % 4
        start = own.ends[then]
        before = own.motion(k, np.array([end - 2e-4]))
        after = own.motion(then, np.array([start + 2e-4]))
        for order, what in ((1, "v_q"), (2, "a_q")):
            one, other = float(before[order][0]), float(after[order][0])
            if abs(one - other) > 0.02 * own.size * own.arm:
                due.append((float(np.degrees(start)), what, one, other))
                break
    if "constant-acceleration" in own.laws.values():
        half = (own.ends[2] + own.ends[3]) / 2
        low, high = (float(own.motion(2, np.array([half + x]))[2][0]) for x in (-2e-4, 2e-4))
        due.append((float(np.degrees(half)), "a_q", low, high))
    due.sort()
    told = [line.split(": ") for line in " ".join(text.split()).split(". ") if " impacts, " in line]
    lines = [f"{head}: {one}" for head, jumps in told for one in jumps.split("; ")]
    lines.sort(key=lambda line: numbers(line)[0])
    assert ("No impacts" in text) == (not due) == (not lines)
    for line, jump, (phi, what, low, high) in zip(lines, record["jumps"], due, strict=True):
        assert what in line and ("Hard" in line) == (what == "v_q")
        assert numbers(line)[0] == close(phi)
        assert numbers(line)[1:] == [close(1000 * low, 5e-3), close(1000 * high, 5e-3)]
        assert jump["of"] == what and jump["phi_deg"] == close(phi)
        assert [jump["before"], jump["after"]] == [close(low, 5e-3), close(high, 5e-3)]


@each("name", [name for name, keys in CAMS.items() if "mass" in keys])
def test_the_spring_and_the_reaction_are_those_of_the_worst_place(name: str) -> None:
    _, text, own, _ = solved(name)
    keys, omega = own.keys, own.keys["n"] * pi / 30
    places, pushes, normals = [], [], []
    for part in range(4):
        phi = own.grid(part)
        inertia = keys["mass"] * omega**2 * own.motion(part, phi)[2]
        places.append(np.degrees(phi))
        pushes.append(inertia + (keys["load"] if part == 0 else 0.0))
        normals.append(np.cos(own.profile(part, phi)[3]))
    phi, push, cos = map(np.concatenate, (places, pushes, normals))
    spring = 0.0
    line = next((x for x in text.splitlines() if "F_s = " in x), None)
    assert (line is None) == (keys.get("closure") == "form")
    if line is not None:
        shown, needed, at, margin = numbers(line)
        spring = keys["margin"] * max(0.0, -push.min())
        assert (shown, needed, margin) == (close(spring), close(-push.min()), keys["margin"])
        assert at == close(phi[np.argmin(push)], tolerance=0.3)
    force = np.abs((push + spring) / cos)
    shown, at = numbers(next(x for x in text.splitlines() if "reaction N = " in x))
    assert shown == close(force.max())
    assert force[np.argmin(np.abs(phi - at))] == close(force.max(), 5e-3)


def rows_of(text: str) -> Iterator[list[str]]:
    table = text[text.index("\nPositions") :].splitlines()
    yield from (line.split() for line in table if re.match(r" *\d+ ", line))


@each("name", CAMS)
def test_a_row_of_the_table_of_divisions_has_the_numbers_of_its_angle(name: str) -> None:
    _, text, own, _ = solved(name)
    seen = 0
    for number, at, *cells in rows_of(text):
        assert int(number) == seen
        seen += 1
        phi = np.array([radians(float(at))])
        middle = (own.ends[2] + own.ends[3]) / 2  # where a constant acceleration jumps
        if min(abs(float(phi[0]) - end) for end in (*own.ends, middle)) < 2e-3:
            continue
        part = own.part(float(phi[0]))
        s, v, a = own.motion(part, phi)
        actual, _, rho, pressure = own.profile(part, phi)
        due = [1000 * s[0], 1000 * v[0], 1000 * a[0], np.degrees(pressure[0])]
        due += [1000 * own.mirror * actual[0].real, 1000 * actual[0].imag]
        shown = [float(cell) for cell in cells[:6]]
        assert shown == [close(x, 1e-3, 0.02) for x in due]
        if cells[6] != "∞" and abs(rho[0]) < 1:
            assert float(cells[6]) == close(1000 * rho[0], 5e-3, 0.02)
    assert seen > 12


def test_each_usual_mistake_has_the_numbers_of_the_cam_that_it_makes(tmp_path: Path) -> None:
    """The file is changed as the student read it; Q5 has derivatives by degrees."""
    keys = {**CAMS["offset"], "offset": 0.004, "pressure": {"rise": 25, "return": 40}}
    own = CamQuantities(load(written(tmp_path, keys)))
    r_min = own.design.pitch_geometry.r_min
    changed: dict[str, dict[str, Any]] = {
        "Q1": {"pressure": {"rise": 40, "return": 25}},
        "Q2": {"upper_dwell": 0},
        "Q3": {"law": "3-4-5"},
        "Q4": {"offset": -0.004, "r_min": r_min},
    }
    mistakes = {one.code: one for one in own.mistaken()}
    assert [*mistakes] == [*changed, "Q5"]
    places = [(name, 0) for name in ("r_min", "e", "rho_min", "theta_max", "theta_max_return")]
    places += [(name, k) for name in ("s", "v_q", "a_q", "theta") for k in (2, 5, 9, 16)]
    for code, change in changed.items():
        other = CamQuantities(load(written(tmp_path, keys | change)))
        differ = 0
        for name, k in places:
            due, right = other.quantity(name, k), own.quantity(name, k)
            assert due is not None and right is not None
            assert mistakes[code].read(name, k) == pytest.approx(due.value, rel=1e-9, abs=1e-12)
            assert (due.unit == "deg") == name.startswith("theta")
            differ += due.value != pytest.approx(right.value, rel=1e-6, abs=1e-9)
        assert differ, code
    for name, k in places:
        right = own.quantity(name, k)
        assert right is not None
        power = {"v_q": 1, "a_q": 2}.get(name, 0)
        assert mistakes["Q5"].read(name, k) == pytest.approx(right.value * radians(1) ** power)
