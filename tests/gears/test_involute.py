"""Involute meshing: sizes in 40 digits, profiles against the rack and each other, the sheet."""

from __future__ import annotations

import json
import re
from functools import cache
from itertools import pairwise
from math import pi, radians
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from cases import each, some, thinned
from click.testing import CliRunner
from doors import (
    MESHPICTURE_CURVE as CURVE,
    MESHPICTURE_SCALES as SCALES,
    Contour,
    Drawing,
    LabelsLabel as Label,
    LimitKind,
    LineOfAction,
    Pair,
    PlanRequest,
    Points,
    Rack,
    SolvedMeshing,
    Stroke,
    Text,
    Tooth,
    angle_of_involute,
    blocking_choose as choose,
    cli,
    contour_picture,
    diagrams,
    get_language,
    inspect,
    involute_reader_load as load,
    involute_sheet_drawings as drawings,
    limits,
    meets_limits,
    render,
    view_for,
)
from shapely import Polygon
from worked import PROBLEMS

FILE = PROBLEMS / "meshing" / "z12-30.toml"
EXACT = 1e-6
"""A nanometre of profile, mm."""

CASES: tuple[tuple[tuple[int, int], float, tuple[float, float], float], ...] = (
    ((12, 30), 5.0, (0.59, 0.53), 20.0),
    ((12, 30), 5.0, (0.0, 0.0), 20.0),
    ((40, 60), 3.0, (-0.2, 0.35), 20.0),
    ((9, 14), 2.0, (0.5, 0.3), 20.0),
    ((17, 18), 8.0, (0.95, 0.1), 25.0),
    ((30, 100), 1.0, (0.0, -0.4), 15.0),
)


def pair_of(case: tuple[Any, ...]) -> Pair:
    z, m, x, alpha = case
    return Pair(z, m, Rack(radians(alpha)), np.array(x))


def written(tmp_path: Path, body: str) -> Path:
    path = tmp_path / "pair.toml"
    path.write_text(f"[meshing]\n{body}\n", encoding="utf-8")
    return path


def solved_json(*args: str) -> dict[str, Any]:
    run = CliRunner().invoke(cli, ["solve", *args, "--json"])
    assert run.exit_code == 0, run.output
    told: dict[str, Any] = json.loads(run.output)["meshing"]
    return told


# Sizes --------------------------------------------------------------------------------------------


def test_the_angle_of_an_involute_function_is_found_to_the_last_digits() -> None:
    angles = np.linspace(0.05, 1.55, some(400, few=40))
    with mp.workdps(40):
        values = [mp.tan(mp.mpf(a)) - mp.mpf(a) for a in angles]
    found = angle_of_involute(np.array([float(v) for v in values]))
    assert np.max(np.abs(found - angles)) < 1e-13
    assert np.isnan(angle_of_involute(-1e-3))
    assert angle_of_involute(0.0) == 0.0


@each("case", CASES)
def test_sizes_are_those_of_the_standard_in_forty_digits(case: tuple[Any, ...]) -> None:
    (z, m, shifts, degrees), pair = case, pair_of(case)
    with mp.workdps(40):
        alpha, module = mp.mpf(radians(degrees)), mp.mpf(m)
        x = [mp.mpf(one) for one in shifts]

        def inv(angle: Any) -> Any:
            return mp.tan(angle) - angle

        whole = inv(alpha) + 2 * sum(x) * mp.tan(alpha) / sum(z)
        alpha_w = mp.findroot(lambda t: inv(t) - whole, mp.mpf("0.4"))
        a = module * sum(z) / 2
        a_w = a * mp.cos(alpha) / mp.cos(alpha_w)
        delta = sum(x) - (a_w - a) / module
        told: list[tuple[str, Any, Any]] = [("alpha_w", pair.alpha_w, alpha_w)]
        told += [("a_w", pair.a_w, a_w), ("delta_y", pair.delta_y + 1, delta + 1)]
        rho_a, d_b = [], []
        for k in (0, 1):
            d = module * z[k]
            base, tip = d * mp.cos(alpha), d + 2 * module * (1 + x[k] - delta)
            angle = mp.acos(base / tip)
            s = module * (mp.pi / 2 + 2 * x[k] * mp.tan(alpha))
            s_a = tip * (s / d + inv(alpha) - inv(angle))
            span = (
                module
                * mp.cos(alpha)
                * (
                    mp.pi * (float(pair.k[k]) - mp.mpf("0.5"))
                    + 2 * x[k] * mp.tan(alpha)
                    + z[k] * inv(alpha)
                )
            )
            rho_a.append(base * mp.tan(angle) / 2)
            d_b.append(base)
            told += [("d_a", pair.d_a[k], tip), ("s", pair.s[k], s), ("s_a", pair.s_a[k], s_a)]
            told += [("W", pair.base_tangent[k], span)]
            told += [("d_f", pair.d_f[k], d - 2 * module * (mp.mpf("1.25") - x[k]))]
            told += [("d_w", pair.d_w[k], base / mp.cos(alpha_w))]
        line = (d_b[0] + d_b[1]) / 2 * mp.tan(alpha_w)
        told += [("line", pair.line, line)]
        overlap = (sum(rho_a) - line) / (mp.pi * module * mp.cos(alpha))
        told += [("epsilon", pair.epsilon, overlap)]
        for k in (0, 1):
            low = line - rho_a[1 - k]
            told += [("rho_p", pair.rho_p[k] + 10 * m, low + 10 * module)]
            if low > 0:
                slides = 1 - rho_a[1 - k] * z[k] / (low * z[1 - k])
                told += [("theta_p", pair.theta_p[k], slides)]
        for name, found, exact in told:
            assert abs(float(found) - exact) < 1e-12 * abs(exact) + 1e-13, name


def test_the_base_tangents_of_the_tables() -> None:
    """Lengths for m = 1, α = 20°, x = 0, as handbooks print them."""
    for z, k, length in (
        (12, 2, 4.5963),
        (20, 3, 7.6604),
        (30, 4, 10.7526),
        (18, 2, 4.6802),
        (45, 5, 13.9148),
    ):
        pair = Pair((z, z), 1.0, Rack(radians(20)), np.zeros(2))
        assert int(pair.k[0]) == k
        assert float(pair.base_tangent[0]) == pytest.approx(length, abs=1e-4)


# Profiles -----------------------------------------------------------------------------------------


@each("case", CASES)
def test_no_position_of_the_rack_cuts_the_profile_and_one_touches_every_point(
    case: tuple[Any, ...],
) -> None:
    """The rack as the brute outline of a half plane and a circle, rolled over the wheel."""
    pair = pair_of(case)
    for k in (0, 1):
        tooth, rack, m = Tooth(pair, k), pair.rack, pair.m
        radius, shift = tooth.size("d") / 2, float(pair.x[k])
        corner = (rack.corner + 1j * shift) * m  # from the rolling line
        points = np.concatenate([tooth.fillet_points(9)[1:], tooth.flank_points(7)[1:-1]])
        upright = -((points * np.exp(1j * pi / tooth.z) * 1j).conj())  # its space on the y axis

        def gap(roll: Any, point: complex, tooth: Tooth = tooth, corner: complex = corner) -> Any:
            """Distance from the right side of the rack's tooth, negative inside it."""
            radius = tooth.size("d") / 2
            seen = point * np.exp(-1j * roll) - radius * roll - 1j * radius - corner
            rack, rho = tooth.pair.rack, tooth.pair.rack.rho * tooth.pair.m
            normal = complex(np.cos(rack.alpha), -np.sin(rack.alpha))
            flank = (seen * normal.conjugate()).real - rho
            bottom = -seen.imag - rho
            round_off = np.abs(seen) - rho
            angle = np.angle(seen * 1j)  # 0 straight down, the flank's normal at 90° − α
            return np.where(
                angle < 0, bottom, np.where(angle < pi / 2 - rack.alpha, round_off, flank)
            )

        for point in upright:
            low, high = -2.2, 2.2
            for _ in range(6):
                rolls = np.linspace(low, high, 801)
                gaps = gap(rolls, complex(point))
                best = int(np.argmin(gaps))
                low, high = rolls[max(best - 1, 0)], rolls[min(best + 1, 800)]
            assert abs(gaps[best]) < EXACT, (k, point, gaps[best])
        assert radius > 0


def rolled(tooth: Tooth, points: Points, turn: float) -> Points:
    """Points of a wheel with its centre where the meshing has it, turned from contact in P."""
    pair, lower = tooth.pair, tooth.wheel == 0
    rho = tooth.size("d_b") / 2 * np.tan(float(pair.alpha_w))
    start = pi / 2 if lower else -pi / 2
    centre = 1j * tooth.size("d_w") / 2 * (-1 if lower else 1)
    spin = -turn if lower else turn * pair.z[0] / pair.z[1]
    return np.asarray(centre + points * np.exp(1j * (start + float(tooth.half(rho)) + spin)))


@each("case", CASES)
def test_both_flanks_touch_on_the_line_of_action_and_their_normals_pass_through_the_pole(
    case: tuple[Any, ...],
) -> None:
    pair = pair_of(case)
    one, two = Tooth(pair, 0), Tooth(pair, 1)
    contact = LineOfAction.of(one, two)
    pole = one.size("d_b") / 2 * float(np.tan(pair.alpha_w))
    along = np.exp(1j * float(pair.alpha_w))
    for rho in np.linspace(contact.start, contact.end, 9)[1:-1]:
        turn = (rho - pole) / (one.size("d_b") / 2)
        touch = (rho - pole) * along
        for tooth, own in ((one, rho), (two, float(pair.line) - rho)):
            near = own + np.array([-1e-4, 0.0, 1e-4])
            before, here, after = rolled(tooth, tooth.flank(near), turn)
            assert abs(here - touch) < EXACT
            tangent = (after - before) / abs(after - before)
            if abs(touch) > 0.1:
                assert abs((touch / tangent).real) < 1e-5 * abs(touch)


@each("case", CASES)
def test_teeth_in_mesh_do_not_overlap(case: tuple[Any, ...]) -> None:
    """Nor those whose undercut lets the other tip pass beyond the end of the line of action."""
    pair = pair_of(case)
    teeth = Tooth(pair, 0), Tooth(pair, 1)

    def area(tooth: Tooth, turn: float) -> Polygon:
        whole = tooth.outline(300)
        three = [whole * np.exp(2j * pi * k / tooth.z) for k in (-1, 0, 1)]
        points = rolled(tooth, np.concatenate([*three, np.zeros(1)]), turn)
        return Polygon(np.stack([points.real, points.imag], axis=1))

    for turn in np.linspace(-0.5, 0.5, some(41, few=5)) * 2 * pi / pair.z[0]:
        common = area(teeth[0], turn).intersection(area(teeth[1], turn))
        # A common area could only be a sliver along a contact, as thick as the allowed error.
        assert common.area < EXACT * pair.m, (turn, common.area)


@pytest.mark.usefixtures("russian")
def test_undercut_is_drawn_and_reported() -> None:
    problem = load(FILE, variant="without-shift")
    first, second = SolvedMeshing(problem).teeth
    assert first.is_cut
    assert not second.is_cut
    assert abs(first.fillet(first.theta) - first.flank(first.rho_low)) < EXACT
    angles = np.angle(first.fillet_points(200))
    assert np.max(angles) > float(np.angle(first.flank(first.rho_low))) + 1e-3  # a neck
    for command in ("solve", "protocol"):
        run = CliRunner().invoke(cli, [command, str(FILE), "--variant", "without-shift"])
        assert run.exit_code == 0, run.output
        assert "x₁ = 0,000 < x_min1 = 0,298" in run.output
        assert "Зуб колеса 1 подрезан" in run.output
    told = solved_json(str(FILE), "--variant", "without-shift")
    assert told["undercut"] == [True, False]
    assert told["theta_p"][0] is None
    assert "N_1" in told["theta_reason"]
    assert told["epsilon_active"] < told["epsilon_alpha"] == pytest.approx(1.53693, abs=1e-5)


# Limits -------------------------------------------------------------------------------------------


def test_the_chosen_shifts_keep_all_limits_and_have_the_least_sliding_nearby() -> None:
    told = solved_json(str(FILE))
    assert told["shifts_chosen"]
    assert all(one["holds"] for one in told["conditions"])
    pair, asked = Pair.of(load(FILE)), limits(0.25, 1.2)
    assert told["x"] == list(choose(pair, asked) or ())
    worst = float(np.max(np.abs(pair.theta_p)))
    for dx in np.arange(-20, 21) / 100:
        for dy in np.arange(-20, 21, some(1, few=5)) / 100:
            other = pair.shifted(pair.x + np.array([dx, dy]))
            if meets_limits(other, asked):
                assert float(np.max(np.abs(other.theta_p))) >= worst - 1e-12


def test_curves_of_the_contour_are_where_their_limits_are_reached() -> None:
    solved = SolvedMeshing(load(FILE))
    found = contour().parts
    shown = {(limit.kind, limit.wheel, limit.min_value) for limit, parts in found if parts}
    assert {
        (LimitKind.INTERFERENCE, 0, 0.0),
        (LimitKind.INTERFERENCE, 1, 0.0),
        (LimitKind.TIP, 0, 0.0),
        (LimitKind.TIP, 0, 0.25),
        (LimitKind.OVERLAP, None, 1.0),
        (LimitKind.OVERLAP, None, 1.2),
        (LimitKind.UNDERCUT, 0, 0.0),
        (LimitKind.UNDERCUT, 1, 0.0),
    } <= shown
    for limit, parts in found:
        for part in parts:
            margin = limit.margin(solved.pair.shifted(part))
            assert np.max(np.abs(margin)) < 1e-9


@cache
def contour() -> Contour:
    return Contour.of(SolvedMeshing(load(FILE)))


@pytest.mark.parametrize("size", [70.0, 90.0, 120.0, 300.0])
@pytest.mark.parametrize("letter", [2.5, 3.5, 5.0])
def test_between_the_numbers_of_an_axis_of_the_contour_there_is_white(
    size: float, letter: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The gap is at least the height of a letter, in a picture of any size."""
    placed: list[Label] = []
    monkeypatch.setattr(diagrams, "lettered", lambda _, labels: placed.extend(labels))
    contour_picture(contour(), get_language("ru"), size, size, letter)
    for axis in (1 + 0j, 1j):
        own = [one for one in placed if one.name.startswith(f"axis {axis} ")]
        assert len(own) >= 2
        for one, other in pairwise(own):
            taken = (one.inscription.width + other.inscription.width) / 2 if axis == 1 else letter
            assert abs(other.anchor - one.anchor) >= taken + letter


def test_the_centre_distance_determines_the_shifts(tmp_path: Path) -> None:
    told = solved_json(str(written(tmp_path, "z = [20, 41]\nm = 2\na_w = 62.5\nx1 = 0.4")))
    assert told["x"][0] == 0.4
    assert told["a_w"] == pytest.approx(62.5, rel=1e-13)
    again = solved_json(str(written(tmp_path, f"z = [20, 41]\nm = 2\nx = {told['x']}")))
    for name in ("alpha_w", "d_a", "W", "theta_p", "epsilon_alpha"):
        assert again[name] == pytest.approx(told[name], rel=1e-12)
    assert not again["shifts_chosen"]
    shared = solved_json(str(FILE), "--variant", "axes")
    assert shared["a_w"] == pytest.approx(108.0, rel=1e-13)
    assert shared["shifts_chosen"]


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("m = 5\nx = [0, 0]", "meshing.z: missing"),
        ("z = [12, 30]\nx = [0, 0]", "meshing.m: missing"),
        ("z = [12, 30]\nm = 5", "meshing.x: missing"),
        ("z = [12, -40]\nm = 5\nx = [0, 0]", "internal pair"),
        ("z = [12, 3]\nm = 5\nx = [0, 0]", "meshing.z[1]: expected a whole number from 5"),
        ("z = [12, 30]\nm = 5\nx = [0, 0]\na_w = 110", "both shifts are given in x"),
        ('z = [12, 30]\nm = 5\nx = "best"', "'blocking', 'equal-sliding' or 'contact-ratio'"),
        ("z = [12, 30]\nm = 5\na_w = 90", "base circles meet at a·cos α = 98.668"),
        ("z = [12, 30]\nm = 5\nx = [-1, -1]", "must be at least -0.8599"),
        ("z = [5, 30]\nm = 5\nx = [-0.9, 0.9]", "cuts the tooth of wheel 1 off"),
        ("z = [5, 30]\nm = 5\nx = [3, 1]", "pointed below its involute: x1 = 3"),
        ("z = [8, 25]\nm = 5\nx = 'blocking'", "ε_α is at most 1.1"),
        ("z = [12, 30]\nm = 5\nx = [0, 0]\nalpha = 30\nha = 1.3", "ends before its tip"),
        ("z = [12, 30]\nm = nan\nx = [0, 0]\ngamma = 3", "unknown key"),
    ],
)
def test_a_faulty_file_is_reported_with_a_remedy(tmp_path: Path, body: str, said: str) -> None:
    for command in ("solve", "sheet"):
        run = CliRunner().invoke(cli, [command, str(written(tmp_path, body)), "-o", "x"][:2])
        assert run.exit_code == 3, run.output
        assert said in run.output
        assert "Traceback" not in run.output


# The sheet ----------------------------------------------------------------------------------------


@cache
def drawn(path: Path, variant: str | None = None) -> Drawing:
    (sheet,) = drawings(load(path, variant=variant), PlanRequest())
    return sheet


SHEETS: dict[str, tuple[Path | str, str | None, str]] = {
    "chosen": (FILE, None, ""),
    "undercut": (FILE, "without-shift", ""),
    "broken": ("z = [25, 80]\nm = 4\nx = [0.9, 1.1]", None, 'lang = "en"'),
    "small": ("z = [17, 45]\nm = 12\nx = [0.3, 0.2]", None, 'paper = "A2"'),
    "huge": ("z = [1000, 1000]\nm = 100\nx = [0, 0]", None, ""),
    "pointed": ("z = [12, 30]\nm = 5\nx = [1.3, 0]", None, ""),
    "few": ("z = [7, 9]\nm = 20\nx = [0.6, 0.5]", None, ""),
}


@pytest.mark.parametrize("name", thinned([*SHEETS], 7))
def test_the_norm_control_marks_no_sheet(name: str, tmp_path: Path) -> None:
    told, variant, sheet = SHEETS[name]
    path = told if isinstance(told, Path) else written(tmp_path, f"{told}\n[sheet]\n{sheet}")
    drawing = drawn(path, variant)
    assert [f"{one.code} {one.message}" for one in inspect(drawing)] == []
    curved = [item for item in drawing.items if isinstance(item, Stroke) and CURVE in item.tag]
    # Flanks and fillets of three teeth of both wheels, and of wheel 1 as it is cut.
    assert len(curved) == 3 * 3 * 4
    assert all(item.smooth for item in curved)


@pytest.mark.parametrize("variant", [None, "without-shift", "axes"])
def test_an_internal_pair_has_the_letters_of_its_paper(variant: str | None) -> None:
    """Its picture, higher than its room, took letters of 3.5 and names of 5 mm on a white A1."""
    sheet = drawn(PROBLEMS / "meshing/z20-60-internal.toml", variant)
    texts = [item for item in sheet.items if isinstance(item, Text)]
    assert max(one.height for one in texts) == 7.0
    assert {one.text for one in texts if one.height == 5.0} >= {*"hpPAB"}
    # The line to the centre of the pinion is not broken: it has its radii.
    tags = {getattr(item, "tag", "") for item in sheet.items}
    assert {"dimension r_{a1}", "dimension r_{f1}", "base radius"} <= tags


def test_checks_have_the_letters_of_the_views_where_they_fit() -> None:
    """They are 5 mm beside the usual pair, with no inequality broken at a sign not repeated."""
    texts = [item for item in drawn(FILE).items if isinstance(item, Text)]
    checks = [one for one in texts if one.text.endswith("выполнено")]
    assert len(checks) == 7
    assert {one.height for one in checks} == {5.0}


def test_splines_of_the_dxf_are_the_exact_profile_between_their_points(tmp_path: Path) -> None:
    """To a nanometre of the wheels, not of the paper."""
    ezdxf = pytest.importorskip("ezdxf")
    path = tmp_path / "sheet.dxf"
    sheet = drawn(FILE)
    curved = [item for item in sheet.items if isinstance(item, Stroke) and item.smooth]
    path.write_bytes(render(Drawing(sheet.width, sheet.height, items=[*curved]), "dxf"))
    splines = ezdxf.readfile(path).modelspace().query("SPLINE")
    solved = SolvedMeshing(load(FILE))
    view = view_for(solved, 1000.0, 500.0)
    assert view.scale in SCALES
    flanks = 0
    for spline in splines:
        curve = spline.construction_tool()
        near = [complex(v.x, v.y) for v in curve.approximate(400)]
        if len(near) < 400 or spline.dxf.layer != "MAIN":
            continue
        size = sum(abs(b - a) for a, b in pairwise(near)) / view.scale
        for tooth in solved.teeth:
            exact = tooth.flank_points(4001)
            if abs(size - float(np.sum(np.abs(np.diff(exact))))) > 1e-3:
                continue
            flanks += 1
            points = np.array(near)
            # Carried to the exact flank by its ends; a mirrored one is turned over first.
            for shown in (points, points.conj()):
                turn = (exact[-1] - exact[0]) / (shown[-1] - shown[0])
                placed = (shown - shown[0]) * turn + exact[0]
                rho = np.sqrt(np.abs(placed) ** 2 - (tooth.size("d_b") / 2) ** 2)
                off = float(np.max(np.abs(placed - tooth.flank(rho))))
                if off < 0.01:
                    assert off < EXACT
                    break
            else:
                pytest.fail("a spline that is no flank")
    assert flanks == 12 + 6  # of both wheels in mesh, and of wheel 1 as it is cut


def test_both_languages_have_the_same_formulas() -> None:
    texts = {}
    for lang in ("ru", "en"):
        run = CliRunner().invoke(cli, ["protocol", str(FILE), "--lang", lang])
        assert run.exit_code == 0, run.output
        numbers = re.findall(r"\d+[.,]\d+", run.output.replace(",", "."))
        texts[lang] = [one for one in numbers if len(one) > 4]
    assert texts["ru"] == texts["en"]
    assert len(texts["ru"]) > 100
