"""The profile: against swept rollers and plates, its angle and curvature by differences."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cams import SHIPPED, designed
from click.testing import CliRunner
from doors import (
    PENS,
    TURN,
    Arc,
    CamDesign,
    CamGeometry,
    Contact,
    Pen,
    PlanRequest,
    Stroke,
    Text,
    cams_reader_load as load,
    cams_sheet_drawings,
    cli,
)
from shapely import LinearRing, Point, distance

PLATES: dict[str, dict[str, Any]] = {
    "level": {"follower": "translating", "stroke": 0.02},
    "opposite": {"follower": "oscillating", "swing": 12, "arm": 0.2, "centre": 0.1},
    "same": {"follower": "oscillating", "swing": 12, "arm": 0.2, "centre": 0.1, "sense": "same"},
}
PHASES = {
    "curvature": 0.004,
    "rise": 120,
    "upper_dwell": 20,
    "return": 100,
    "law": "4-5-6-7",
    "contact": "flat",
}


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_all_lines_of_a_sheet_are_black_and_rollers_in_motion_are_thin(path: Path) -> None:
    (sheet,) = cams_sheet_drawings(load(path), PlanRequest())
    pens = {item.pen for item in sheet.items if isinstance(item, (Arc, Stroke))}
    assert {PENS[pen].grey for pen in pens} == {0.0}
    rollers = [one for one in sheet.items if isinstance(one, Arc) and one.tag == "roller"]
    pens_of_rollers = sorted(one.pen.value for one in rollers)  # the one at rest is thick
    assert pens_of_rollers[:1] == ["main"] * bool(rollers)
    assert set(pens_of_rollers[1:]) <= {Pen.THIN.value}
    assert bool(rollers) == (load(path).contact is Contact.ROLLER)
    # The statement has the letters of the views: all shipped cams have room for that on A1.
    said = {one.height for one in sheet.items if isinstance(one, Text) and "Дано" in one.text}
    assert said == {5.0}


def differences(geometry: CamGeometry, phi: Any, step: float) -> tuple[Any, Any]:
    before, here, after = (geometry.at(phi + k * step).theoretical for k in (-1, 0, 1))
    return (after - before) / (2 * step), (after - 2 * here + before) / step**2


def inside(problem: Any) -> Any:
    """Return angles that keep away from the ends of smooth parts."""
    parts = [
        np.linspace(one.start + 2e-3, one.end - 2e-3, 60)
        for one in problem.stretches
        if one.end - one.start > 5e-3
    ]
    return np.concatenate(parts)


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_curvature_and_pressure_are_those_of_differences(path: Path) -> None:
    design = CamDesign(load(path))
    geometry, problem = design.geometry, design.problem
    phi = inside(problem)
    at = geometry.at(phi)
    first, second = differences(geometry, phi, 2e-4)
    bend = -np.imag(np.conj(first) * second) / np.abs(first) ** 3
    assert np.allclose(bend, at.curvature, rtol=1e-5, atol=2e-3)
    if problem.contact is Contact.FLAT:
        return
    normal = 1j * first / np.abs(first) * np.exp(1j * phi)
    arm = at.roller - geometry.pivot
    way = -1j * geometry.side * arm / np.abs(arm) if problem.oscillates else 1j
    assert np.allclose(np.abs(np.angle(normal / way)), np.abs(at.pressure), atol=1e-7)


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_the_profile_is_the_envelope_of_a_swept_roller(path: Path) -> None:
    design = CamDesign(load(path))
    geometry = design.geometry
    if not geometry.roller:
        pytest.skip("no roller")
    dense = geometry.at(np.linspace(0, TURN, 20_001)[:-1]).theoretical
    swept = LinearRing(np.column_stack([dense.real, dense.imag])).buffer(
        geometry.roller, quad_segs=256
    )
    (inner,) = swept.interiors
    at = geometry.at(np.linspace(0, TURN, 721))
    for side, edge in ((at.actual, inner), (at.outer, swept.exterior)):
        off = [distance(edge, Point(z.real, z.imag)) for z in side]
        assert max(off) < 1e-6


@pytest.mark.parametrize("name", PLATES)
def test_a_plate_touches_the_profile_from_outside(name: str, tmp_path: Path) -> None:
    design = designed(tmp_path, PLATES[name] | PHASES)
    geometry = design.geometry
    phi = np.linspace(0, TURN, 4001)
    at = geometry.at(phi)
    turn = np.exp(-1j * phi)
    normal = at.normal * turn
    plate = np.real(at.roller * np.conj(at.normal))
    reach = np.array([np.max(np.real(at.actual * np.conj(n))) for n in normal[::20]])
    assert np.allclose(reach, plate[::20], atol=1e-9)
    assert plate.min() == pytest.approx(geometry.r_min)
    first, second = differences(geometry, inside(design.problem), 2e-4)
    bend = -np.imag(np.conj(first) * second) / np.abs(first) ** 3
    assert np.allclose(bend, geometry.at(inside(design.problem)).curvature, rtol=1e-4)


def test_the_table_of_the_profile_has_every_half_degree() -> None:
    path = next(one for one in SHIPPED if one.stem == "groove")
    done = CliRunner().invoke(cli, ["solve", str(path), "--csv"])
    assert done.exit_code == 0
    rows = list(csv.DictReader(io.StringIO(done.stdout)))
    assert len(rows) == 720
    assert [float(row["phi_deg"]) for row in rows[:3]] == [0.0, 0.5, 1.0]
    design = CamDesign(load(path))
    at = design.geometry.at(np.radians([float(row["phi_deg"]) for row in rows]))
    assert np.allclose([float(row["x"]) for row in rows], -at.actual.real)  # it turns clockwise
    assert np.allclose([float(row["y"]) for row in rows], at.actual.imag)
