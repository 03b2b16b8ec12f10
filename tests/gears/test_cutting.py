"""Cutting of teeth by the rack: the drawn profile, the rack swept independently, undercut."""

from __future__ import annotations

import json
from functools import cache
from math import acos, atan2, cos, hypot, pi, radians, sin, tan
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from cases import each, some
from click.testing import CliRunner
from doors import (
    ENVELOPE,
    MESHPICTURE_CURVE as CURVE,
    POSITIONS,
    CuttingView,
    Disc,
    LineOfAction,
    Pair,
    Rack,
    RackCutting,
    Stroke,
    Text,
    Tooth,
    cli,
    cutting_picture,
    cutting_view,
    get_language,
)
from shapely import MultiPolygon, Point, Polygon, union_all
from shapely.affinity import rotate, scale, translate
from worked import PROBLEMS

FILE = PROBLEMS / "meshing" / "z12-30.toml"
NANOMETRE = 1e-6
"""1e-9 m in mm."""

SHIFTS = (0.0, 0.59)


def cutting_of(x: float, z: int = 12, alpha: float = 20.0) -> RackCutting:
    return RackCutting(Tooth(Pair((z, 30), 5.0, Rack(radians(alpha)), np.array([x, 0.53 * x])), 0))


@cache
def view_of(x: float) -> CuttingView:
    return cutting_view(cutting_of(x), 300.0, 220.0)


def back(view: CuttingView, stroke: Stroke, number: int) -> np.ndarray:
    """Points of a stroke of the paper in the frame of the tooth of a number, mm."""
    placed = (np.array(stroke.points) - view.centre) / view.scale
    return np.asarray(placed * np.exp(-1j * view.angle(number)))


# The profile --------------------------------------------------------------------------------------


@each("x", SHIFTS)
def test_drawn_flanks_are_the_involute_to_a_nanometre(x: float) -> None:
    view = view_of(x)
    drawn = [
        i for i in cutting_picture(view, get_language("ru"), 5.0).items if isinstance(i, Stroke)
    ]
    curves = [one for one in drawn if one.tag.startswith(CURVE)]
    assert len(curves) == 3 * 4
    base, d, s = 30 * cos(radians(20)), 60.0, 5 * (pi / 2 + 2 * x * tan(radians(20)))

    def inv(angle: float) -> float:
        return tan(angle) - angle

    flanks = 0
    for k, number in enumerate((-1, 0, 1)):
        for stroke in curves[4 * k : 4 * k + 4]:
            points = back(view, stroke, number)
            off = []
            for one in points:
                radius = abs(one)
                if radius < base:
                    break
                half = s / d + inv(radians(20)) - inv(acos(base / radius))
                off.append(radius * abs(abs(atan2(one.imag, one.real)) - half))
            else:
                if max(off) < 0.01:
                    flanks += 1
                    assert max(off) < NANOMETRE, max(off)
    assert flanks == 6


def swept(
    x: float, count: int, *, m: float = 5.0, z: int = 12, beta: float = 0.0
) -> Polygon | MultiPolygon:
    """Return the space of a wheel: the rack's tooth, rounded by shapely, in many positions.

    The wheel's centre is the origin, the axis of the space points to +y. The rack of a helical
    wheel is that of the normal section, stretched along itself.
    """
    alpha, radius = radians(20), m * z / 2 / cos(beta)
    low, high = -1.25 * m, 2.0 * m

    def half(y: float) -> float:
        return pi * m / 4 + y * tan(alpha)

    sharp = Polygon([(-half(low), low), (half(low), low), (half(high), high), (-half(high), high)])
    rho = 0.25 * m / (1 - sin(alpha))
    tooth = sharp.buffer(-rho, quad_segs=400).buffer(rho, quad_segs=400)
    tooth = tooth.union(sharp.intersection(Polygon([(-9, 0), (9, 0), (99, high), (-99, high)])))
    tooth = scale(tooth, xfact=1 / cos(beta), origin=(0, 0))
    tooth = translate(tooth, 0.0, x * m + radius)
    rolls = np.linspace(-1.0, 1.0, count)
    return union_all([
        rotate(translate(tooth, -radius * roll, 0.0), -roll, origin=(0, 0), use_radians=True)
        for roll in rolls
    ])  # fmt: skip


@each("x", SHIFTS)
def test_flank_and_fillet_bound_the_space_of_a_swept_rack(x: float) -> None:
    """Between two positions a cusp of the order of the square of the step is left."""
    count = some(2001, few=501)
    cut = swept(x, count)
    tooth, tolerance = cutting_of(x).tooth, 6.0 * (2.0 / (count - 1)) ** 2 * 30
    turn = np.exp(1j * (pi / 2 + pi / tooth.z))
    for points in (tooth.fillet_points(60), tooth.flank_points(60)):
        for one in points[1:-1] * turn:
            assert cut.boundary.distance(Point(one.real, one.imag)) < tolerance, (x, one)


@each("x, degrees", [(0.3, 15.0), (-0.1, 30.0), (0.0, 35.0)])
def test_a_helical_rack_leaves_its_own_fillet(x: float, degrees: float) -> None:
    """The rounded tip is an ellipse in the transverse section; without shift it undercuts."""
    count, beta = some(2001, few=501), radians(degrees)
    cut = swept(x, count, beta=beta)
    tooth = Tooth(Pair((12, 30), 5.0, Rack(radians(20)), np.array([x, 0.0]), 0, beta), 0)
    tolerance, turn = 6.0 * (2.0 / (count - 1)) ** 2 * 40, np.exp(1j * (pi / 2 + pi / tooth.z))
    for points in (tooth.fillet_points(60), tooth.flank_points(60)):
        for one in points[1:-1] * turn:
            assert cut.boundary.distance(Point(one.real, one.imag)) < tolerance, (x, one)


@each("x", SHIFTS)
def test_positions_of_the_rack_touch_the_profile_and_do_not_cut_it(x: float) -> None:
    view = view_of(x)
    items = cutting_picture(view, get_language("en"), 5.0).items
    shown = [one for one in items if isinstance(one, Stroke) and one.tag == ENVELOPE]
    assert len(shown) == POSITIONS
    outline = view.cutting.tooth.outline(400)
    tooth = Polygon(np.stack([outline.real, outline.imag], axis=1))
    nearest = []
    for one in shown:
        points = back(view, one, 1)
        for place in points[np.abs(points) < view.cutting.tooth.size("d_a") / 2]:
            point = Point(place.real, place.imag)
            inside = tooth.contains(point)
            assert not inside or tooth.exterior.distance(point) < 2e-3
            nearest.append(tooth.exterior.distance(point))
    assert min(nearest) < 1e-3


# Undercut -----------------------------------------------------------------------------------------


def test_undercut_is_seen_where_a_swept_rack_leaves_the_involute() -> None:
    cutting = cutting_of(0.0)
    diameter = cutting.cut_diameter
    assert diameter is not None
    assert cutting_of(0.59).cut_diameter is None
    cut, base = swept(0.0, 2001), 30 * cos(radians(20))

    def is_left(radius: float) -> bool:
        """Return whether a point just within the involute at a radius is still in the tooth."""
        angle = acos(base / radius)
        half = 5 * pi / 2 / 60 + tan(radians(20)) - radians(20) - tan(angle) + angle
        place = (radius * np.exp(-1j * (half - 2e-6))) * np.exp(1j * (pi / 2 + pi / 12))
        return not cut.contains(Point(place.real, place.imag))

    low, high = base + 1e-6, 30.0
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (low, middle) if is_left(middle) else (middle, high)
    assert 2 * high == pytest.approx(diameter, abs=1e-3)
    drawn = cutting_picture(view_of(0.0), get_language("ru"), 5.0).items
    letters = {one.text for one in drawn if isinstance(one, Text)}
    assert "U" in letters
    u = [
        abs(one.centre - view_of(0.0).centre) * 2 / view_of(0.0).scale
        for one in drawn
        if isinstance(one, Disc)
    ]
    assert any(abs(one - diameter) < NANOMETRE for one in u)
    without = cutting_picture(view_of(0.59), get_language("ru"), 5.0).items
    assert "U" not in {one.text for one in without if isinstance(one, Text)}


@each("z, alpha", [(12, 20.0), (9, 20.0), (25, 15.0), (17, 25.0)])
def test_undercut_begins_where_the_boundary_point_reaches_the_base_circle(
    z: int, alpha: float
) -> None:
    least = cutting_of(0.0, z, alpha).min_displacement / 5.0
    for off, is_cut in ((-1e-6, True), (1e-6, False)):
        assert (cutting_of(least + off, z, alpha).cut_diameter is not None) is is_cut
    there = cutting_of(least, z, alpha)
    assert there.boundary == pytest.approx(0.0, abs=1e-9)
    foot = there.on_line(0.0)
    assert abs(there.radius + foot) == pytest.approx(there.radius * cos(radians(alpha)), abs=1e-12)
    # B_l is where the boundary line of the rack, h_a* below its reference line, crosses the line.
    point = there.on_line(there.boundary)
    assert point.real == pytest.approx(there.displacement - there.tooth.pair.rack.straight * 5)


def left_by_the_rack(z: int, m: float, x: float, beta: float) -> tuple[float, float]:
    """Return ρ at the lowest point of an undercut involute, mm, and how far beyond it B_l lies.

    In 50 digits: the rounded tip of the rack rolls, and its envelope is compared with the
    involute at the same radius.
    """
    with mpmath.workdps(50):
        alpha, size, lean = mpmath.radians(20), mpmath.mpf(m), mpmath.cos(mpmath.mpf(beta))
        transverse = mpmath.atan(mpmath.tan(alpha) / lean)
        radius, shift = size * z / 2 / lean, mpmath.mpf(x) * size
        base, rho = radius * mpmath.cos(transverse), size / 4 / (1 - mpmath.sin(alpha))
        depth = 5 * size / 4 - rho - shift
        wide = (size * mpmath.pi / 4 - (depth + shift) * mpmath.tan(alpha)
                - rho / mpmath.cos(alpha)) / lean  # fmt: skip
        half = (mpmath.pi / 2 * size + 2 * shift * mpmath.tan(alpha)) / lean / (2 * radius)

        def tip(theta: Any) -> Any:
            beside = (depth + rho * mpmath.cos(theta)) * mpmath.tan(theta) * lean
            rolled = (beside - rho * mpmath.sin(theta) / lean - wide) / radius
            point = mpmath.mpc(radius - depth - rho * mpmath.cos(theta), beside)
            return point * mpmath.expj(-rolled - mpmath.pi / z)

        def is_cut(theta: Any) -> bool:
            point = tip(theta)
            if abs(point) < base:
                return True
            angle = mpmath.acos(base / abs(point))
            lag = mpmath.tan(angle) - angle - mpmath.tan(transverse) + transverse
            return bool(mpmath.arg(point) > lag - half)

        low, high = mpmath.mpf(0), mpmath.pi / 2 - alpha
        beyond = mpmath.sqrt(abs(tip(high)) ** 2 - base**2)
        for _ in range(160):
            middle = (low + high) / 2
            low, high = (middle, high) if is_cut(middle) else (low, middle)
        return float(mpmath.sqrt(abs(tip(low)) ** 2 - base**2)), float(beyond)


def test_undercut_leaves_the_same_tooth_as_the_rolled_rack() -> None:
    """For 72 wheels, from a trace of undercut to a deep one, straight and helical."""
    draw = np.random.default_rng(46)
    for number in range(some(72, few=18)):
        z, m = int(draw.integers(8, 41)), float(draw.choice([1, 2, 2.5, 4, 6, 10]))
        beta = radians(float(draw.choice([10, 25]))) if number % 3 == 2 else 0.0
        pair = Pair((z, 60), m, Rack(radians(20)), np.zeros(2), 0, beta)
        less = 10 ** draw.uniform(-6, -2) if number % 6 == 1 else draw.uniform(0.1, 0.5)
        x = float(pair.x_min[0]) - float(less)
        pair = pair.shifted((x, 0.4))
        one, two = Tooth(pair, 0), Tooth(pair, 1)
        due, beyond = left_by_the_rack(z, m, x, beta)
        assert one.rho_low == pytest.approx(due, rel=1e-8), (z, m, x, beta)
        assert -one.size("rho_l") == pytest.approx(beyond, rel=1e-8)
        # The drawn flank ends there, and the contact ratio is that of the remaining flank.
        assert abs(one.fillet(one.theta) - one.flank(one.rho_low)) < 1e-9 * m
        start = max(float(pair.line) - two.rho_high, due)
        end = min(one.rho_high, float(pair.line) - two.rho_low)
        assert LineOfAction.of(one, two).overlap(pair) == pytest.approx((end - start) / pair.p_b)


# Reports ------------------------------------------------------------------------------------------


def told(*args: str) -> dict[str, Any]:
    run = CliRunner().invoke(cli, ["solve", *args, "--json"])
    assert run.exit_code == 0, run.output
    found: dict[str, Any] = json.loads(run.output)["meshing"]
    return found


def test_the_record_has_the_dimensions_and_the_cutting_of_both_wheels() -> None:
    found = told(str(FILE), "--variant", "without-shift")
    one, two = found["cutting"]
    sine = sin(radians(20))
    assert one["displacement"] == 0
    assert one["clearance"] == 1.25
    assert one["boundary_rho"] == pytest.approx(30 * sine - 5 / sine)
    assert one["undercut_displacement"] == pytest.approx(5 - 30 * sine**2)
    assert one["undercut_diameter"] == pytest.approx(
        2 * hypot(30 * cos(radians(20)), found["rho_low"][0])
    )
    assert two["undercut_diameter"] is None
    assert found["e"] == pytest.approx([5 * pi / 2] * 2)
    assert found["h"] == pytest.approx([11.25] * 2)
    ring = told(str(PROBLEMS / "meshing" / "z20-60-internal.toml"))
    assert ring["cutting"][1] is None
    assert ring["h"][1] == pytest.approx((ring["d_f"][1] - ring["d_a"][1]) / 2)


@each("lang, words", [("ru", "за N₁: зуб подрезан"), ("en", "beyond N₁: the tooth is undercut")])
def test_both_languages_state_where_undercut_begins(lang: str, words: str) -> None:
    for command in ("solve", "protocol"):
        run = CliRunner().invoke(
            cli, [command, str(FILE), "--variant", "without-shift", "--lang", lang]
        )
        assert run.exit_code == 0, run.output
        text = " ".join(run.output.split())
        assert words in text
        assert "56.514" in text.replace(",", ".")


@pytest.mark.usefixtures("russian")
def test_the_sheet_names_it(tmp_path: Path) -> None:
    run = CliRunner().invoke(cli, ["sheet", str(FILE), "--format", "svg", "-o", str(tmp_path)])
    assert run.exit_code == 0, run.output
    assert "Станочное зацепление колеса 1" in (tmp_path / "z12-30.svg").read_text("utf-8")


def test_a_trace_of_undercut_is_computed(tmp_path: Path) -> None:
    path = tmp_path / "trace.toml"
    path.write_text("[meshing]\nz = [9, 30]\nm = 5\nx = [0.473599, 0.3]\n", encoding="utf-8")
    found = told(str(path))
    assert found["undercut"] == [True, False]
    assert found["cutting"][0]["undercut_diameter"] == pytest.approx(
        45 * cos(radians(20)), abs=1e-4
    )
