"""Drawings of a moving point: constructions against exact numbers, sheets, protocols."""

from __future__ import annotations

import math
import re
from collections import Counter
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from cases import each, thinned
from click.testing import CliRunner
from doors import (
    DRAFTING_PROFILES as PROFILES,
    PLANVIEW_POLE as POLE,
    SCALE_SERIES as SERIES,
    Arc,
    Disc,
    ExitCode,
    PlanRequest,
    Scale,
    Stroke,
    Text,
    Undefined,
    cli,
    drawn_interval,
    inspect,
    kind_of,
    move,
    moving_construction_construct as construct,
    moving_reader_load as load,
    moving_sheet_drawings as drawings,
    read_hodograph,
    reader_loads as loads,
    textbook,
)
from ezdxf.filemanagement import readfile
from worked import PROBLEMS

FILES = sorted((PROBLEMS / "point").glob("*.toml"))
K11 = PROBLEMS / "point" / "k11-01.toml"
BOARD = PROFILES["board"]
SCALES = {
    "l": Scale("mu_l", 0.01, "m"),
    "v": Scale("mu_v", 0.02, "m/s"),
    "a": Scale("mu_a", 0.05, "m/s²"),
}

LAWS = {
    "plane": 'x = "3*t*exp(t/2)"\ny = "4*t/(t^2 + 1)"',
    "polar": 'r = "1 + t^2"\nphi = "t^2 - 2*t"',
    "circle": 's = "t^3 - 2*t"\nradius = 2',
    "line": 's = "t^3 - 2*t"',
    "rolling": 'wheel = { radius = 0.5, r = 0.3, angle = 20 }\nphi = "t - 2*t^2"',
    "on": 'wheel = { radius = 0.5, r = 0.7, angle = 20, on = 1 }\nphi = "-2*t^2"',
    "within": 'wheel = { radius = 0.5, angle = 20, within = 2 }\nphi = "2*t^2"',
    "satellite": 'wheel = { radius = 0.2, r = 0.3, arm = 0.5 }\ntheta = "t^2"\nphi = "5*t"',
}


def of(point: str, t: str = "t = [0.3, 0.9, 1.7]") -> Any:
    return loads(f"[point]\n{point}\n{t}\n", name="p")


# Wheels ------------------------------------------------------------------------------------------


def test_a_wheel_rolls_as_in_the_textbook() -> None:
    row = move(of('wheel = { radius = 0.5, angle = -90 }\nphi = "-2*t"')).columns
    t = row["t"]
    assert row["x"] == pytest.approx(0.5 * (2 * t - np.sin(2 * t)), abs=1e-14)  # the cycloid
    assert row["y"] == pytest.approx(0.5 * (1 - np.cos(2 * t)), abs=1e-14)
    assert row["rho"] == pytest.approx(4 * 0.5 * np.abs(np.sin(t)), rel=1e-12)


@pytest.mark.parametrize("name", ["rolling", "on", "within", "satellite"])
def test_velocity_is_omega_times_the_distance_from_p(name: str) -> None:
    row = move(of(LAWS[name])).columns
    reach = (row["x"] - row["xP"]) + 1j * (row["y"] - row["yP"])
    assert row["vx"] + 1j * row["vy"] == pytest.approx(1j * row["omega"] * reach, abs=1e-12)
    if name in ("on", "within"):  # P lies on the track, the centre a radius from it
        assert np.hypot(row["xP"], row["yP"]) == pytest.approx({"on": 1, "within": 2}[name])
        assert np.hypot(row["xC"] - row["xP"], row["yC"] - row["yP"]) == pytest.approx(0.5)


def test_a_point_of_a_planet_gear_agrees_with_derivatives_of_mpmath() -> None:
    row = move(of(LAWS["satellite"], "t = 0.9")).columns
    with mpmath.workdps(40):
        place = lambda t: 0.5 * mpmath.expj(t**2) + 0.3 * mpmath.expj(5 * t)  # noqa: E731
        v, a = (complex(mpmath.diff(place, mpmath.mpf("0.9"), n)) for n in (1, 2))
    assert complex(row["vx"][0], row["vy"][0]) == pytest.approx(v, rel=1e-12)
    assert complex(row["ax"][0], row["ay"][0]) == pytest.approx(a, rel=1e-12)


def test_the_planet_gear_of_k10_has_the_printed_speed_of_its_centre() -> None:
    row = move(load(PROBLEMS / "point" / "k10-satellite.toml")).columns
    assert abs(row["xC"][0] - row["xP"][0]) * row["omega"][0] == pytest.approx(0.2, rel=1e-14)


# Constructions -----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", LAWS)
def test_a_construction_gives_the_exact_numbers(name: str) -> None:
    problem = of(LAWS[name])
    motion = move(problem)
    for k in range(3):
        built = construct(problem, motion, k, SCALES)
        assert built is not None
        trace = built.read()
        for column, result in built.results.items():
            exact = motion.columns[column][k]
            if not math.isnan(exact):
                assert trace.value[result] == pytest.approx(exact, rel=1e-9, abs=1e-9), column
        for vector in built.vectors:
            if vector.is_resultant:
                tip = complex(trace.value[vector.head])
                parts = (motion.columns[f"{vector.plan}{c}"][k] for c in "xy")
                assert tip * SCALES[vector.plan].per_mm == pytest.approx(complex(*parts), abs=1e-9)
        ruled, sigma = built.ruled(0.5), built.sigma(BOARD)
        for column in ("v", "a"):
            assert sigma[column] > 0
            assert abs(ruled[column] - motion.columns[column][k]) < 4 * sigma[column]


def test_at_rest_there_is_no_tangent_and_without_velocity_no_plan() -> None:
    problem = of('x = "t^2"\ny = "t^3"', "t = 0")
    built = construct(problem, move(problem), 0, SCALES)
    assert built is not None
    assert sorted(built.results) == ["a", "v"]
    problem = of('x = "sqrt(t)"\ny = "t"', "t = 0")
    assert construct(problem, move(problem), 0, SCALES) is None


def test_sigma_of_a_hodograph_s_chord_is_that_of_random_drawings() -> None:
    course = drawn_interval(of('x = "5*cos(t)"\ny = "5*sin(t)"', "t = 0"))
    read = read_hodograph(course, Scale("mu_v", 0.1, "m/s"), BOARD).series
    step = course.marks.columns["t"][1] - course.marks.columns["t"][0]
    # The chord of an arc of the circle v = 5: the error of the method, exactly.
    assert read.read == pytest.approx(5 * math.sin(step) / step, abs=0.05 / step)
    one = BOARD.lay_off**2 + BOARD.point**2
    assert np.all(read.sigma > 0.1 / (2 * step) * math.sqrt(one))
    assert np.all(read.sigma < 0.1 / (2 * step) * 4 * math.sqrt(one))


# Drawings ----------------------------------------------------------------------------------------


def test_poles_are_not_drawn_through() -> None:
    course = drawn_interval(of('x = "tg(t)"\ny = "t"', "t = { from = 0, to = 6, step = 0.5 }"))
    parts = list(course.curves("x", "y"))
    assert len(parts) == 3
    assert all(np.all(np.diff(part.real) > 0) for part in parts)
    assert not course.unbroken("x", "y", 3, 4)
    assert 3 not in read_hodograph(course, SCALES["v"], BOARD).at


def test_a_cusp_ends_a_smooth_part() -> None:
    course = drawn_interval(of('x = "t^2"\ny = "t^3"', "t = 0"))
    assert [abs(part[-1]) < 1e-12 for part in course.curves("x", "y")] == [True, False]


def test_an_interval_of_our_own_is_one_where_everything_exists() -> None:
    for path in FILES:
        course = drawn_interval(load(path))
        assert Undefined.POSITION not in course.path.reasons, path.stem
        assert np.nanmax(course.path.columns["a"]) < 12 * np.nanmean(course.path.columns["a"])


@each("path", thinned(FILES, 12))
def test_the_norm_control_marks_no_sheet(path: Path) -> None:
    problem = load(path)
    (drawing,) = drawings(problem, PlanRequest())
    assert inspect(drawing) == []
    assert [view.kind for view in drawing.views] == ["trajectory", "hodograph", "hodograph"]
    for view in drawing.views:
        assert any(math.isclose(float(f"{view.per_mm:e}".split("e")[0]), m) for m in SERIES)
    motion = drawn_interval(problem).marks
    k = drawn_interval(problem).shown[0]
    poles = [item.centre for item in drawing.items if isinstance(item, Disc) and item.tag == POLE]
    for view, plan, pole in zip(drawing.views[1:], "va", poles, strict=True):
        for span in view.spans:
            assert (span.name, span.start) == (plan, pole)
            assert span.length * view.per_mm == pytest.approx(motion.columns[plan][k], rel=1e-9)


def test_axes_that_do_not_cross_at_the_origin_have_both_numbers_of_the_crossing() -> None:
    (drawing,) = drawings(load(PROBLEMS / "point" / "k11-07.toml"), PlanRequest())
    whole, every = drawing.views[0], drawing.items
    of_axes = [one for one in every if isinstance(one, Stroke) and one.tag == "axis of coordinates"]
    lines = [one.points for one in of_axes if abs(one.points[1] - one.points[0]) > 20.0]
    level = next(points[0].imag for points in lines if points[0].imag == points[1].imag)
    (upright,) = {points[0].real for points in lines[:2] if points[0].real == points[1].real}
    path = next(one for one in every if isinstance(one, Stroke) and one.tag == "path M")
    assert level < min(point.imag for point in path.points)
    start = path.points[0]  # at t = -0.5
    there = -20.0 * math.cos(0.5) / 0.75
    crossed = there + (level - start.imag) * whole.per_mm
    assert crossed == pytest.approx(-28.0, abs=1e-6)
    numbers = {
        text.text for text in every
        if isinstance(text, Text) and abs(text.at - complex(upright, level)) < 10.0
    }  # fmt: skip
    assert {"0", "−28"} <= numbers


def test_a_vector_at_the_trajectory_can_be_seen() -> None:
    (drawing,) = drawings(load(PROBLEMS / "point" / "k11-07.toml"), PlanRequest())
    joints = [item.centre for item in drawing.items if isinstance(item, Arc) and item.radius > 1.0]
    lengths = [
        abs(item.points[1] - item.points[0])
        for item in drawing.items
        if isinstance(item, Stroke) and item.tag == "absolute"
        and any(abs(item.points[0] - joint) < 1e-6 for joint in joints)
    ]  # fmt: skip
    assert len(lengths) == 2 and min(lengths) > 12.0


def test_curves_are_splines_in_dxf(tmp_path: Path) -> None:
    words = ["--lang", "ru", "--format", "dxf", "-o", str(tmp_path)]
    run = CliRunner().invoke(cli, ["sheet", str(K11), *words])
    assert run.exit_code == ExitCode.DONE, run.output
    (drawing,) = drawings(load(K11), PlanRequest())
    curves = [item for item in drawing.items if isinstance(item, Stroke) and item.smooth]
    splines = readfile(next(tmp_path.iterdir())).modelspace().query("SPLINE")
    assert len(splines) == len(curves) == 3
    for spline, curve in zip(splines, curves, strict=True):
        (start,) = spline.construction_tool().points([0.0])
        assert complex(start.x, start.y) == pytest.approx(curve.points[0], abs=1e-6)


def test_formulas_are_written_as_in_a_textbook() -> None:
    assert textbook("0.5*sqrt(t)^(1/2) - pi", ",") == "0,5*√(t)^{1/2} − π"
    assert textbook("e^(-t/2)*2^t^2 + (1+t)^-3", ".") == "e^{−t/2}*2^{t^{2}} + (1+t)^{−3}"
    assert textbook("t^((1 + t)/2)*3", ".") == "t^{((1 + t)/2)}*3"


def test_the_protocol_has_the_readings_of_the_sheet() -> None:
    path = PROBLEMS / "point" / "k10-satellite.toml"
    run = CliRunner().invoke(cli, ["protocol", str(path), "--lang", "en"])
    assert run.exit_code == ExitCode.DONE, run.output
    assert max(map(len, run.output.splitlines())) <= 100
    (drawing,) = drawings(load(path), PlanRequest())
    (span,) = drawing.views[1].spans
    measured = re.search(r"pv = ([0-9.]+)", run.output)
    assert measured is not None
    assert float(measured[1]) == pytest.approx(span.length, abs=0.5)
    steps = [int(n) for n in re.findall(r"^(\d+)\. ", run.output, re.M)]
    assert steps == list(range(1, len(steps) + 1))
    assert "lay off aⁿ_MC along it, backwards" in run.output


def test_options_that_a_point_does_not_have_are_rejected(tmp_path: Path) -> None:
    for args in (
        ["sheet", "--phi", "20"],
        ["lint", "--structure"],
        ["protocol", "--position", "2"],
    ):
        run = CliRunner().invoke(cli, [*args, str(K11)])
        assert run.exit_code == ExitCode.USAGE
        assert args[1] in run.output
    nowhere = tmp_path / "n.toml"
    nowhere.write_text('[point]\nx = "ln(-1 - t^2)"\ny = "t"\nt = 1\n', encoding="utf-8")
    run = CliRunner().invoke(cli, ["sheet", str(nowhere), "-o", str(tmp_path)])
    assert run.exit_code == ExitCode.PROBLEM
    assert "point.show" in run.output


def test_printed_values_are_audited(tmp_path: Path) -> None:
    path = tmp_path / "printed.toml"
    text = K11.read_text("utf-8") + '\n[published]\nv = { value = 5, what = "v" }\n'
    path.write_text(text + 'rho = { value = 3, what = "rho" }\n', encoding="utf-8")
    run = CliRunner().invoke(cli, ["audit", str(path), "--lang", "en"])
    assert run.exit_code == ExitCode.DONE, run.output
    assert "| v |  | 5 | 5.0000 | 5.0000 |" in run.output
    assert "| rho |  | 3 | 10.417 |" in run.output


def test_sheets_of_a_set_are_numbered_after_those_before_them() -> None:
    kind = kind_of(K11)
    (sheet,) = kind.drawings(load(K11), PlanRequest(before=2, total=5))
    (alone,) = kind.drawings(load(K11), PlanRequest())
    texts = Counter(item.text for item in sheet.items if isinstance(item, Text))
    texts.subtract(Counter(item.text for item in alone.items if isinstance(item, Text)))
    assert texts["3"] == 1, +texts


def test_what_the_drawing_does_not_give_is_not_in_its_table() -> None:
    """The normal acceleration is 0.2 mm at this scale: a ruler reads 0, which is no radius."""
    problem = of(LAWS["rolling"], "t = 0\n[scales]\nmu_a = 1")
    (sheet,) = drawings(problem, PlanRequest())
    texts = [item.text for item in sheet.items if isinstance(item, Text)]
    assert texts.count("2,084") == 1  # in the table of the moment alone
