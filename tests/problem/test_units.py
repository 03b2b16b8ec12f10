"""Numbers with units, and the unit of a file, in all tables."""

from __future__ import annotations

import math
import re
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from cases import each
from doors import (
    ProblemError,
    cams_reader_load as load_cam,
    gears_reader_load as load_train,
    involute_reader_load as load_mesh,
    problem_loads as loads,
    units_measured as measured,
)
from worked import path_of

CRANK = """
[frame]
O = [0, {y}]
guides.x-x = {{ through = "O", angle = {angle} }}
[links.1]
points = ["O", "A"]
OA = {oa}
[links.2]
points = ["A", "B", "S2"]
AB = {ab}
S2 = {{ on = "AB", at = {at} }}
[links.3]
points = ["B"]
slides = {{ on = "x-x", offset = {offset} }}
[driver]
link = "1"
phi = {phi}
{rate}
[assembly]
B = "right of O"
[dynamics.links.2]
mass = {mass}
centre = "S2"
inertia = {inertia}
[[loads]]
link = "3"
at = "B"
force = {force}
angle = {angle}
[[loads]]
link = "1"
couple = {couple}
"""
PLAIN: dict[str, Any] = {
    "y": 0, "angle": 0, "oa": 0.1016, "ab": 0.3, "at": 0.1, "offset": 0.02, "phi": 60,
    "rate": "n = 1500", "mass": 2.5, "inertia": 0.01, "force": 4000, "couple": 25,
}  # fmt: skip


@each(
    "key, text",
    [
        ("oa", "4 in"), ("oa", "101,6 мм"), ("oa", "10.16cm"), ("oa", "0.1016/2*2 м"),
        ("ab", "300 мм"), ("ab", "30 см"), ("ab", "0,6/2 m"), ("at", "100 mm"),
        ("offset", "2 см"), ("phi", "60°"), ("phi", "pi/3 rad"), ("phi", "π/3 рад"),
        ("phi", "60 град"), ("angle", "0 рад"), ("mass", "2500 г"), ("mass", "2,5 кг"),
        ("inertia", "0,01 кг·м²"), ("inertia", "0.01 kg*m^2"), ("force", "4 кН"), ("force", "4 kN"),
        ("couple", "25 Н·м"), ("couple", "0.025 kN·m"), ("couple", "25000 Н·мм"),
    ],
)  # fmt: skip
def test_a_number_with_its_unit_is_that_number(key: str, text: str) -> None:
    plain = loads(CRANK.format(**PLAIN), name="crank")
    told = loads(CRANK.format(**{**PLAIN, key: f'"{text}"'}), name="crank")
    for part in ("bodies", "slides", "drive", "dynamics"):
        assert getattr(told, part) == getattr(plain, part), (key, text, part)


@each(
    "text, rate",
    [
        ('omega = "1500 rpm"', 50 * math.pi), ('omega = "1500 об/мин"', 50 * math.pi),
        ('omega = "1500 мин⁻¹"', 50 * math.pi), ('omega = "25 об/с"', 50 * math.pi),
        ('omega = "40 1/с"', 40.0), ('omega = "40 rad/s"', 40.0), ('omega = "90 °/s"', math.pi / 2),
        ('n = "40 рад/с"', 40.0), ('n = "1500 1/min"', 50 * math.pi),
        ('n = "25 rev/s"', 50 * math.pi),
        ('omega = "40/s"\nepsilon = "3 с⁻²"', 40.0),
    ],
)  # fmt: skip
def test_speeds_are_given_in_either_unit(text: str, rate: float) -> None:
    drive = loads(CRANK.format(**{**PLAIN, "rate": text}), name="crank").drive
    assert drive.rate == pytest.approx(rate, rel=1e-15)
    assert drive.acceleration == (3.0 if "epsilon" in text else 0.0)


@each(
    "key, text, said",
    [
        (
            "oa",
            "4 kg",
            "expected a length in metres, got the string '4 kg'. kg is a unit of a mass",
        ),
        ("mass", "3 м", "expected a mass in kg, got the string '3 м'. м is a unit of a length"),
        (
            "phi",
            "3 Н",
            "expected an angle in degrees, got the string '3 Н'. Н is a unit of a force",
        ),
        ("force", "3 rpm", "rpm is a unit of an angular velocity"),
        ("couple", "3 kN", "kN is a unit of a force"),
        ("oa", "4 foot", "foot is not one of them"),
    ],
)
def test_a_unit_of_another_quantity_is_reported(key: str, text: str, said: str) -> None:
    with pytest.raises(ProblemError, match=re.escape(said)):
        loads(CRANK.format(**{**PLAIN, key: f'"{text}"'}), name="crank")


def test_a_second_alone_is_no_number_of_turns() -> None:
    with pytest.raises(ProblemError, match="Write rpm for turns, or rad/s for an angle a second"):
        loads(CRANK.format(**{**PLAIN, "rate": 'n = "25 1/s"'}), name="crank")


@pytest.mark.parametrize("text", ["30", "1/18", "2*pi", "0:360:30", "60, 90", "sqrt(2)/2", "1e3"])
def test_a_key_without_a_unit_is_read_as_before(text: str) -> None:
    assert measured(text) is None


# The unit of a file -------------------------------------------------------------------------------

PER = {"mm": 1000.0, "cm": 100.0, "in": 1 / 0.0254}
CAM = """{units}
[cam]
follower = "{kind}"
rise = 120
return = 120
{sizes}
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "one.toml"
    path.write_text(text, encoding="utf-8")
    return path


@each("unit", ["mm", "cm", "in"])
def test_the_unit_of_a_file_is_that_of_cams(tmp_path: Path, unit: str) -> None:
    own = {"translating": {"stroke": 0.04, "offset": -0.01, "r_min": 0.05, "roller": 0.012}}
    own["oscillating"] = {"arm": 0.12, "centre": 0.15, "r_min": 0.05, "roller": 0.012}
    for kind, sizes in own.items():
        more = "swing = 20\n" if kind == "oscillating" else ""
        found = []
        for per, units in ((1.0, ""), (PER[unit], f'units = "{unit}"')):
            lines = "".join(f"{key} = {value * per!r}\n" for key, value in sizes.items())
            text = CAM.format(units=units, kind=kind, sizes=more + lines)
            found.append(load_cam(written(tmp_path, text)))
        one, two = found
        for key in sizes:
            assert getattr(two, key) == pytest.approx(getattr(one, key), rel=1e-14), (unit, key)


def test_numbers_of_cams_trains_and_meshes_have_units(tmp_path: Path) -> None:
    sizes = 'stroke = "40 mm"\noffset = "1 cm"\nn = "10 рад/с"\nmass = "500 г"\nload = "0,2 кН"'
    cam = load_cam(written(tmp_path, CAM.format(units="", kind="translating", sizes=sizes)))
    assert (cam.stroke, cam.offset, cam.mass, cam.load) == (0.04, 0.01, 0.5, 200.0)
    assert cam.n == pytest.approx(300 / math.pi, rel=1e-15)
    text = (
        "{units}[gears]\nwheels = {{ 1 = {{ r = {r} }}, 2 = {{ r = {r} }} }}\n"
        "meshes = [{{ of = [1, 2] }}]\nn = {{ 1 = {n} }}\n"
    )
    for units, r in (("", '"50 mm"'), ('units = "mm"\n', 50), ('units = "cm"\n', 5)):
        train = load_train(written(tmp_path, text.format(units=units, r=r, n='"10 об/с"'))).train
        assert {wheel.size for wheel in train.wheels.values()} == {Fraction(1, 20)}
        assert set(train.inputs.values()) == {600}
    mesh = "{units}[meshing]\nz = [20, 40]\nm = {m}\na_w = {a}\n"
    wanted = load_mesh(written(tmp_path, mesh.format(units="", m=4, a=121)))
    for units, m, a in (("", '"4 мм"', '"12.1 cm"'), ('units = "cm"\n', 4, 12.1)):
        found = load_mesh(written(tmp_path, mesh.format(units=units, m=m, a=a)))
        assert found.m == wanted.m
        assert found.a_w == pytest.approx(wanted.a_w, rel=1e-14)


def test_the_unit_of_a_file_applies_to_the_lengths_that_loads_depend_on() -> None:
    """Radii of pins, places of bearings; moments stay N·m, inertia kg·m²."""
    more = "[friction]\nf = 0.1\nradius = {r}\n[bearings.O]\nat = [{a}, {b}]\nplane = {c}\n"
    found = []
    for per, units in ((1.0, ""), (PER["mm"], 'units = "mm"\n'), (PER["in"], 'units = "in"\n')):
        lengths = {key: PLAIN[key] * per for key in ("oa", "ab", "at", "offset")}
        text = CRANK.format(**{**PLAIN, **lengths})
        numbers = {"r": 0.01 * per, "a": -0.1 * per, "b": 0.12 * per, "c": 0.02 * per}
        found.append(loads(units + text + more.format(**numbers), name="crank").dynamics)
    for one in found[1:]:
        assert one is not None and found[0] is not None
        assert one.masses == found[0].masses and one.loads == found[0].loads
        assert one.friction is not None and found[0].friction is not None
        told, bearing = one.friction.radius, one.bearings["O"]
        assert told == pytest.approx(found[0].friction.radius, rel=1e-14)
        assert bearing.at == pytest.approx(found[0].bearings["O"].at, rel=1e-14)
        assert bearing.plane == pytest.approx(found[0].bearings["O"].plane, rel=1e-14)


def test_a_file_in_inches_is_printed_in_inches() -> None:
    text = path_of("linkages/ex2").read_text("utf-8")
    bad = loads('units = "in"\n' + text.replace("OA = 0.05", "OA = 2"), name="x")
    assert bad.unit == "in"
    assert bad.lengths[0][2] == pytest.approx(0.0508, rel=1e-15)
