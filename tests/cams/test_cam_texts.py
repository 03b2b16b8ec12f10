"""Outputs of a cam for a reader: texts in both languages, the sheet, DXF, the key, a project."""

from __future__ import annotations

import json
import re
from importlib import import_module
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import PROGRAM as CHROMIUM, browsing
from cams import SHIPPED, written
from cases import sampled
from click.testing import CliRunner
from doors import (
    DEFAULT,
    DRAFTING_PROFILES as PROFILES,
    PROFILE,
    CamDesign,
    CamPhase,
    CamProblem,
    CamQuantities,
    Drawing,
    GradedSubmission,
    PlanRequest,
    Report,
    Severity,
    Stroke,
    Submission,
    Variants,
    WrittenAnswer,
    cam_chapter,
    cams_live_live_page as live_page,
    cams_reader_load as load,
    cams_sheet_drawings as drawings,
    check,
    cli,
    division_rows,
    document,
    families_template as template,
    get_language,
    inspect,
    kinds_load,
    nodes_of,
    positions_title,
    render,
    settle,
    sheet_scales,
    text_positions as positions,
)

BY_NAME = {path.stem: path for path in SHIPPED}


def ran(*arguments: str | Path) -> str:
    done = CliRunner().invoke(cli, [*map(str, arguments)])
    assert done.exit_code == 0, done.output
    return done.output


def drawn(path: Path) -> Drawing:
    (found,) = drawings(load(path), PlanRequest())
    return found


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_a_number_of_the_table_is_that_of_the_diagrams(path: Path) -> None:
    design = CamDesign(load(path))
    table = positions(design, get_language("ru"))
    nodes = {node.number: node for node in nodes_of(design.problem)}
    assert [int(row[0]) for row in table.rows] == list(nodes)
    for number, phi, s, *_ in table.rows:
        node = nodes[int(number)]
        assert float(phi.replace(",", ".")) == pytest.approx(np.degrees(node.phi), abs=0.006)
        exact = 1000.0 * float(design.problem.at(np.array([node.phi]))[0, 0])
        assert float(s.replace(",", ".")) == pytest.approx(exact, abs=0.006)


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_the_table_names_its_profiles_where_a_roller_parts_them(path: Path) -> None:
    design = CamDesign(load(path))
    title = positions_title(design, get_language("ru"))
    for _, row in division_rows(design):
        x, y = row["x_theoretical"] - row["x"], row["y_theoretical"] - row["y"]
        assert np.hypot(x, y) == pytest.approx(design.geometry.roller, abs=1e-9)
    assert ("x, y — рабочий профиль, ρ — теоретический" in title) == bool(design.geometry.roller)
    assert ("вогнут" in title) == any(row[-1][0] == "−" for row in positions(
        design, get_language("ru")).rows)  # fmt: skip


def test_solve_prints_sizes_checks_and_forces_in_both_languages() -> None:
    english = ran("solve", BY_NAME["offset"], "--lang", "en")
    assert (
        "The pressure angle of the rise reaches 30.00° (at φ = 51.13°); 30° is allowed." in english
    )
    assert "Soft impacts, a_q jumps: at φ = 130° from 0 to −45.00 mm" in english
    assert "The spring that keeps contact has the force F_s = 23.02 N" in english
    russian = ran("solve", BY_NAME["groove"], "--lang", "ru")
    assert "замыкание геометрическое (паз)" in russian
    assert "Ударов нет: ускорение непрерывно." in russian
    cut = ran("solve", BY_NAME["central"], "--variant", "undercut", "--lang", "ru")
    assert re.search(r"ПОДРЕЗ от φ = 130,24° до 145,55°: ρ = 30,46 мм, ролик 33,00 мм", cut)


@pytest.mark.dear
@pytest.mark.parametrize("name", ["offset", "oscillating", "flat"])
def test_the_protocol_describes_the_construction_step_by_step(name: str) -> None:
    told = [("ru", ("параллельно ему", "обращённое")), ("en", ("chord", "inverted"))]
    for lang, words in sampled(told, 2):  # the scales of the sheet are searched for in each
        text = ran("protocol", BY_NAME[name], "--lang", lang)
        steps = [int(n) for n in re.findall(r"(?m)^ *(\d+)\) ", text)]
        assert steps == list(range(1, len(steps) + 1))
        assert len(steps) > 20
        assert all(word in text for word in words)


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_the_sheet_has_its_views_and_no_error(path: Path) -> None:
    sheet = drawn(path)
    kinds = [view.kind for view in sheet.views]
    # A given radius needs no region of places of the axis.
    assert kinds == ["diagram", "cam", *(["cam"] if load(path).r_min is None else [])]
    outlines = [x for x in sheet.items if isinstance(x, Stroke) and x.tag == PROFILE]
    assert len(outlines) == (2 if path.stem == "groove" else 1)
    assert all(one.closed and len(one.points) == 720 for one in outlines)
    assert not [one for one in inspect(sheet) if one.severity is Severity.ERROR]


@pytest.mark.dear
@pytest.mark.parametrize("sense, n", [("opposite", 120), ("same", 120), ("same", -120)])
def test_the_least_distance_of_a_plate_on_an_arm_is_printed_and_drawn(
    sense: str, n: int, tmp_path: Path
) -> None:
    keys = {
        "follower": "oscillating", "contact": "flat", "swing": 15, "arm": 0.1, "centre": 0.12,
        "rise": 120, "return": 120, "law": "sine", "curvature": 0.01, "sense": sense, "n": n,
    }  # fmt: skip
    path = written(tmp_path, keys)
    lines = [("en", "From O₂ we draw the line through D"), ("ru", "Из O₂ через точку D")]
    for lang, line in sampled(lines, 2):
        told = " ".join(ran("protocol", path, "--lang", lang).split())
        assert line in told and re.search(r" r₀ 50[.,]37 ", told)
    sheet = drawn(path)
    assert [view.kind for view in sheet.views] == ["diagram", "cam", "cam"]
    r_0 = next(x for x in sheet.items if isinstance(x, Stroke) and x.tag == "r_min")
    size = abs(r_0.points[1] - r_0.points[0]) * sheet.views[1].per_mm
    assert size == pytest.approx(0.05037, rel=0.01)
    limits = [x for x in sheet.items if isinstance(x, Stroke) and x.tag == "limit"]
    ways = [(x.points[1] - x.points[0]) / abs(x.points[1] - x.points[0]) for x in limits]
    assert len(ways) == 2 and abs(ways[0] - ways[1]) < 1e-9  # shifted for the curvature


@pytest.mark.parametrize("stroke, pressure", [(0.044, 27), (0.03, 35), (0.06, 20)])
def test_the_curve_from_which_the_least_radius_is_read_is_not_a_spot(
    tmp_path: Path, stroke: float, pressure: float
) -> None:
    keys = {"follower": "translating", "stroke": stroke, "rise": 85, "upper_dwell": 35}
    keys |= {"return": 105, "law": {"rise": "sine", "return": "cosine"}, "pressure": pressure}
    problem = load(written(tmp_path, keys | {"offset": 0.002}))
    assert stroke / sheet_scales(problem).region > 20.0  # mm


def test_the_profile_in_dxf_is_a_closed_polyline_in_the_scale_of_the_sheet(tmp_path: Path) -> None:
    ran("sheet", BY_NAME["flat"], "--format", "dxf", "-o", tmp_path)
    (file,) = tmp_path.glob("*.dxf")
    found: Any = import_module("ezdxf").readfile(file).modelspace()
    lines = [one for one in found.query("LWPOLYLINE") if one.closed]
    (profile,) = (one for one in lines if len(one) == 720)
    xs, ys = zip(*((x, y) for x, y, *_ in profile.get_points()), strict=True)
    rows = json.loads(ran("solve", BY_NAME["flat"], "--json"))["positions"]
    wide = max(row["x"] for row in rows) - min(row["x"] for row in rows)
    tall = max(row["y"] for row in rows) - min(row["y"] for row in rows)
    assert (max(xs) - min(xs)) / (max(ys) - min(ys)) == pytest.approx(wide / tall, rel=0.02)


@pytest.mark.parametrize("name", ["offset", "groove", "oscillating"])
def test_radii_and_phase_angles_in_dxf_measure_what_the_cam_has(name: str) -> None:
    """To 0.01 mm: with the scale of the profile the radii are those of the design."""
    problem = load(BY_NAME[name])
    sheet, geometry = drawn(BY_NAME[name]), CamDesign(problem).geometry
    per_mm = sheet.views[2].per_mm
    stream = StringIO(render(sheet, "dxf").decode())
    sizes = import_module("ezdxf").read(stream).modelspace().query("DIMENSION")
    named = [(re.sub(r"\{.*\^ (\w+);\}", r"\1", one.dxf.text), one) for one in sizes]
    along = {text: one.get_measurement() for text, one in named if not one.dimtype}
    rise, _, back, _ = phases = [problem.length(phase) for phase in CamPhase]
    assert along["φу"] / along["φв"] == pytest.approx(rise / back)
    told = dict(named)
    for text, size in (("rmin", geometry.r_min), ("rp", geometry.roller)):
        assert told[text].dimtype == 4
        assert told[text].get_measurement() == pytest.approx(size / per_mm, abs=0.01)
    for text, angle in zip(("φу", "φдс", "φв", "φбс"), phases, strict=True):
        assert told[text].dimtype == 5
        assert told[text].get_measurement() == pytest.approx(np.degrees(angle), abs=0.01)
    e = told.get("e")
    assert (e is None) == (name != "offset")
    assert e is None or e.get_measurement() == pytest.approx(geometry.e / per_mm, abs=0.01)


@pytest.mark.parametrize("name", ["central", "oscillating", "flat"])
def test_a_long_lower_dwell_is_broken_and_no_position_is_lost(name: str) -> None:
    sheet = drawn(BY_NAME[name])
    diagrams = next(view.box for view in sheet.views if view.kind == "diagram")
    breaks = [x for x in sheet.items if isinstance(x, Stroke) and x.tag == "break"]
    count = 3 if name == "flat" else 4
    assert len(breaks) == 2 * count
    assert len({round(x.points[0].real, 6) for x in breaks}) == 2  # one axis for all diagrams
    axes = [x for x in sheet.items if isinstance(x, Stroke) and x.tag == "diagram axis"]
    ticks = [x for x in axes if x.points[0].real == x.points[1].real and abs(
        x.points[0].imag - x.points[1].imag) < 3.0]  # fmt: skip
    inside = [x for x in ticks if diagrams[0] <= x.points[0].real <= diagrams[2]]
    assert len(inside) == count * (len(nodes_of(load(BY_NAME[name]))) + 1)


# Checking ----------------------------------------------------------------------------------------


def judged(told: dict[str, float], position: int = 0) -> GradedSubmission:
    answers = tuple(WrittenAnswer(id=n, value=v, position=position) for n, v in told.items())
    return check(Variants(BY_NAME["offset"], DEFAULT).task(None), Submission("s", answers))


@pytest.mark.parametrize(
    ("code", "names", "position"),
    [
        ("Q1", ("r_min", "e"), 0),
        ("Q2", ("s", "v_q"), 11),
        ("Q3", ("s", "v_q"), 11),
        ("Q4", ("e", "theta_max"), 0),
        ("Q5", ("v_q",), 11),
    ],
)
def test_a_mistake_is_known_by_its_numbers(
    code: str, names: tuple[str, ...], position: int
) -> None:
    figures = CamQuantities(load(BY_NAME["offset"]))
    (mistake,) = (one for one in figures.mistaken() if one.code == code)
    told = {name: mistake.read(name, position) or 0.0 for name in names}
    ids = {name: f"{name}@{position}" if position else name for name in names}
    one = judged({ids[name]: value for name, value in told.items()}, position)
    assert [diagnosis.codes for diagnosis in one.diagnosis] == [(code,)]
    exact = {name: figures.quantity(name, position) for name in names}
    right = {ids[name]: one.value for name, one in exact.items() if one is not None}
    assert not judged(right, position).diagnosis


def test_a_value_read_on_the_drawing_has_its_sigma() -> None:
    figures = CamQuantities(load(BY_NAME["oscillating"]))
    for name in ("r_min", "centre_distance", "s", "v_q"):
        read = figures.read_off(name, 3, PROFILES["board"])
        assert read is not None
        assert read[0] > 1 and 0 < read[1] < 0.02
    assert figures.read_off("roller", 0, PROFILES["board"]) is None


# Project -----------------------------------------------------------------------------------------


def test_a_project_has_the_cam_as_a_part_of_its_own(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    text = template("project").replace("[project] ", '[project]\nparts = ["cam"] ')
    text += "\n[scales]\nmu_l = 0.002\nmu_v = 0.04\nmu_a = 0.2\n"  # given, they are not searched
    path.write_text(text, "utf-8")
    project = settle(kinds_load(path), path)
    (part,) = project.parts
    assert isinstance(part.problem, CamProblem)
    assert part.problem.oscillates
    assert part.problem.n == pytest.approx(80.0)  # as the train turns the crank
    for lang in ("ru", "en"):
        nodes = list(cam_chapter(Report(project, get_language(lang)), part.problem))
        numbered = [one.key for one in nodes if isinstance(one, document.Figure | document.Table)]
        assert len(set(numbered)) == len(numbered) == 8
        texts = " ".join(one.text for one in nodes if isinstance(one, document.Paragraph))
        assert sorted(re.findall(r"\\ref{(\w+)}", texts)) == sorted(numbered)
    beside = tmp_path / "cam.toml"
    beside.write_text(template("cam"), "utf-8")
    path.write_text(text.replace('["cam"]', '["cam"]\ncam = "cam.toml"'), "utf-8")
    (part,) = settle(kinds_load(path), path).parts
    assert isinstance(part.problem, CamProblem)
    assert not part.problem.oscillates


# The page that moves -----------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["offset", "oscillating", "flat"])
def test_the_live_page_has_the_exact_numbers(name: str) -> None:
    problem = load(BY_NAME[name])
    page = live_page(problem, "ru")
    scene = json.loads(re.findall(r'id="scene">(.*?)</script>', page)[0])
    geometry = CamDesign(problem).geometry
    for k in (0, 121, 300, 719):
        phi = np.radians([k / 2])
        at, row = geometry.at(phi), scene["cams"][0]["rows"][k]
        assert row[:3] == pytest.approx(1000 * problem.at(phi)[:, 0], abs=1e-6)
        assert row[3] == pytest.approx(np.degrees(at.pressure[0]), abs=1e-6)
        touch = complex(row[6], row[7]) * np.exp(-1j * phi[0]) / 1000
        assert touch == pytest.approx(complex(at.actual[0]), abs=1e-8)
    assert "<script>alert" not in page and "default-src 'none'" in page


@pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed")
def test_on_the_live_page_of_an_offset_cam_the_roller_stays_on_the_line_of_the_follower(
    tmp_path: Path,
) -> None:
    """And on the roller's path: at the offset e to the right of the axis, or left in a mirror."""
    with browsing(tmp_path) as page:
        for n in (180, -180):
            path, file = tmp_path / f"offset{n}.toml", tmp_path / f"live{n}.html"
            source = BY_NAME["offset"].read_text("utf-8").replace("n = 180", f"n = {n}", 1)
            path.write_text(source, "utf-8")
            problem = load(path)
            geometry = CamDesign(problem).geometry
            assert abs(geometry.e) > 1e-3
            file.write_text(live_page(problem, "en"), "utf-8")
            page.open(file, width=900, height=700)
            for phi in (0.0, 40.0, 200.0):
                page.ask(f"show({phi})")
                told = page.ask("document.querySelector('#follower').getAttribute('transform')")
                contact = page.ask("+document.querySelector('#contact').getAttribute('cx')")
                across, down = (float(one) for one in re.findall(r"[-\d.]+", told))
                roller = complex(geometry.at(np.radians([phi])).roller[0]) * 1000.0
                assert across == pytest.approx(problem.mirror * roller.real, abs=1e-3)
                assert across == pytest.approx(problem.mirror * 1000.0 * geometry.e, abs=1e-3)
                assert down == pytest.approx(-roller.imag, abs=1e-3)
                assert abs(contact - across) <= 1000.0 * geometry.roller
        assert not page.said
