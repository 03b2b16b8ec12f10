"""Sheets of gear trains: norm control, segments in the files, layout of the scheme."""

from __future__ import annotations

import io
import random
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import ezdxf
import pytest
from cases import each, some, thinned
from click.testing import CliRunner
from doors import (
    DASH,
    DRAFTING_PROFILES as PROFILES,
    ENLARGED,
    Arc,
    Arrangement,
    AxisPart,
    Disc,
    Drawing,
    ExitCode,
    Fill,
    LayoutError,
    Pen,
    PlanRequest,
    SchemeData,
    Severity,
    Stroke,
    Text,
    arrange,
    as_drawn,
    check_drawings,
    cli,
    draw,
    front,
    gears_construction_construct as construct,
    gears_reader_load as load,
    gears_sheet_drawings as drawings,
    get_language,
    inspect,
    paper_of,
    read,
    render,
    results,
    solve_motion,
)
from trains import MAKERS, bevel, mesh, solved, told
from worked import PROBLEMS

FILES = sorted((PROBLEMS / "gears").glob("*.toml"))
TASKS = sorted((PROBLEMS / "gears").glob("*/*.toml"))
PLANAR = [maker for maker in MAKERS if maker is not bevel]

OTHERS = {
    "bevel differential": told(
        {"1": 30, "2": 20, "3": 30},
        [mesh("1", "2", "bevel", "H"), mesh("2", "3", "bevel", "H")],
        "n = { 1 = 100, H = 40 }",
    ),
    "bevel pair behind wheels": told(
        {"1": 20, "2": 36, "2'": 17, "3": 39},
        [mesh("1", "2"), mesh("2'", "3", "bevel")],
        "n = { 1 = 2400 }",
    ),
    "belt, chain, rack": told(
        {"1": 20, "2": 36, "2'": 17, "3": 39, "3'": 20},
        [mesh("1", "2", "crossed belt"), mesh("2'", "3", "chain"), mesh("3'", "4", "rack")],
        'module = 2\nask = ["v_4", "U_1_4"]\nn = { 1 = 100 }',
    ),
    "worm drives": told(
        {"1": 1, "2": 36, "2'": 20, "3": 40},
        [mesh("1", "2", "worm"), mesh("2'", "3")],
        "n = { 1 = 100 }",
    ),
    "worm is driven": told(
        {"1": 20, "2": 36, "2'": 2, "3": 40},
        [mesh("1", "2"), mesh("2'", "3", "worm")],
        "n = { 1 = 100 }",
    ),
    "worm between": told(
        {"1": 20, "2": 36, "2'": 2, "3": 40, "3'": 20, "4": 40},
        [mesh("1", "2"), mesh("2'", "3", "worm"), mesh("3'", "4")],
        "n = { 1 = 100 }",
    ),
}


def sheet(path: Path) -> Drawing:
    (drawing,) = drawings(load(path), PlanRequest())
    return drawing


def written(folder: Path, text: str) -> Path:
    path = folder / "train.toml"
    path.write_text(f'title = "Передача"\n[gears]\n{text}', encoding="utf-8")
    return path


def faults(drawing: Drawing) -> list[str]:
    (looked,) = check_drawings([drawing])
    return [f"{f.code} {f.message}" for f in looked.findings if f.severity is Severity.ERROR]


def texts(drawing: Drawing) -> str:
    return " ".join(item.text for item in drawing.items if isinstance(item, Text))


@pytest.mark.parametrize("path", [*FILES, *thinned(TASKS, 23)], ids=lambda p: p.stem)
def test_the_norm_control_marks_no_sheet_of_a_problem(path: Path) -> None:
    drawing = sheet(path)
    assert not faults(drawing)
    assert paper_of(drawing) in ("A3", "A2")


def test_the_norm_control_marks_no_sheet_of_random_trains(tmp_path: Path) -> None:
    for seed in range(some(30, 1)):
        for maker in PLANAR:
            text = maker(random.Random(100 + seed)).text
            assert not faults(sheet(written(tmp_path, text))), text


@pytest.mark.parametrize("name", OTHERS)
def test_trains_without_pictures_have_a_scheme_and_a_reason(name: str, tmp_path: Path) -> None:
    drawing = sheet(written(tmp_path, OTHERS[name]))
    assert not faults(drawing)
    said = texts(drawing)
    why = "рейка движется" if name == "belt, chain, rack" else "оси колёс не параллельны"
    assert f"Картины скоростей нет: {why}" in said
    assert "Схема не начерчена" not in said
    assert ("Зацепления 3'-4" in said) == (name == "worm between")
    assert any(isinstance(i, Stroke) and i.tag == "link 1" for i in drawing.items) != (
        name == "worm drives"
    )
    if name == "worm drives":
        assert any(isinstance(i, Arc) and i.tag == "link 1" for i in drawing.items)


@pytest.mark.parametrize(
    ("kind", "speed", "why"),
    [
        ("bevel", 60, "crossing"),
        ("belt", 60, "distances"),
        ("external", 0, "rest"),
    ],
)
def test_the_reason_without_pictures_is_that_of_the_train(
    kind: str, speed: int, why: str, tmp_path: Path
) -> None:
    text = told({"1": 20, "2": 60}, [mesh("1", "2", kind)], f"n = {{ 1 = {speed} }}")
    said = texts(sheet(written(tmp_path, text)))
    words = get_language("ru").gears["no_picture"]
    assert [key for key, sentence in words.items() if str(sentence).rstrip(".") in said] == [why]


@pytest.mark.parametrize("name", ["gears-ex3", "gears-ex6", "planetary-k10"])
def test_segments_in_the_file_are_as_long_as_in_the_table(name: str) -> None:
    """Each segment is one line of the layer of vectors; its length is a number of the table."""
    drawing = sheet(PROBLEMS / f"gears/{name}.toml")
    spans = sorted(span.length for view in drawing.views for span in view.spans)
    library: Any = ezdxf
    document = library.read(io.StringIO(render(drawing, "dxf").decode("utf-8")))
    lines = document.modelspace().query('LINE[layer=="PLAN_VECTORS"]')
    ends = [(complex(*e.dxf.start.xyz[:2]), complex(*e.dxf.end.xyz[:2])) for e in lines]
    assert sorted(abs(b - a) for a, b in ends) == pytest.approx(spans, abs=1e-6)
    shown = {item.text.lstrip("−") for item in drawing.items if isinstance(item, Text)}
    lengths = [span.length / span.magnification for view in drawing.views for span in view.spans]
    assert {f"{length:.2f}".replace(".", ",") for length in lengths} <= shown


SMALL = told(
    {"1": 20, "2": 40, "2'": 25, "3": 85, "4": 13, "5": 20},
    [mesh("1", "2", carrier="H"), mesh("2'", "3", "internal", "H"), mesh("4", "5")],
    'bodies = [["H", "4"]]\nfixed = ["3"]\nmodule = 4\nn = { 1 = -960 }\nask = ["U_1_5"]',
)
"""Train whose scheme is too low at the scale of the file, so that the sheet has another one."""


def test_a_picture_is_read_once_for_sheet_protocol_and_note(tmp_path: Path) -> None:
    """U₁₅ read -12.00 on the sheet was -12.83 in the note, at the scale of the file."""
    paths = [written(tmp_path, SMALL), *FILES[: some(len(FILES), 1)]]
    for path in paths:
        motion = as_drawn(load(path), PROFILES["board"])
        picture = draw(motion)
        if picture is None:
            continue
        drawn = construct(motion, picture)
        seen = read(drawn, PROFILES["board"])
        rows = results(motion, drawn, seen, get_language("ru"))
        said = texts(sheet(path))
        assert {row[3] for row in rows} - {DASH} <= {*said.split()}
    assert as_drawn(load(paths[0]), PROFILES["board"]).train.picture.mu_l > Fraction(1, 1000)
    assert "12,00" in texts(sheet(paths[0]))


def test_short_rays_are_on_a_view_where_the_ruler_reads_them() -> None:
    """Example 3 of the source: a ray of 1.25 mm read as 1.0 mm gave U₁₇ = 48 for 38.54."""
    drawing = sheet(PROBLEMS / "gears/gears-ex3.toml")
    (rays,) = (view for view in drawing.views if any(s.name == "o7" for s in view.spans))
    enlarged = {span.name: span for span in rays.spans if span.magnification > 1.0}
    assert {name: span.magnification for name, span in enlarged.items()} == {"o7": 10.0}
    (circle,) = (i for i in drawing.items if isinstance(i, Arc) and i.tag == f"{ENLARGED} 0")
    for span in enlarged.values():
        assert span.length > 10.0
        assert max(abs(end - circle.centre) for end in (span.start, span.end)) < circle.radius
    said = texts(drawing)
    assert "Б (10:1)" in said and "38,71" in said and "31,00" in said


@each("name", ["003", "017", "020", "025"])
def test_diagrams_grow_into_the_free_paper(name: str) -> None:
    """Rectangles without ink of 13 to 17 % of the field were empty corners (PM-D10)."""
    problem = load(PROBLEMS / f"gears/tasks/gears-2-2-{name}.toml")
    (drawing,) = drawings(problem, PlanRequest())
    assert not [one for one in inspect(drawing) if one.code == "PM-D10"]
    drawn = as_drawn(problem, PROFILES["board"]).train.picture
    assert drawn.longest_mm > 60 or drawn.near_mm > 90


def test_diagrams_keep_the_sizes_of_the_file(tmp_path: Path) -> None:
    text = (PROBLEMS / "gears/tasks/gears-2-2-017.toml").read_text(encoding="utf-8")
    path = tmp_path / "train.toml"
    path.write_text(f"{text}\n[gears.picture]\nlongest_mm = 60\npole_mm = 50\n", "utf-8")
    drawn = as_drawn(load(path), PROFILES["board"]).train.picture
    assert (drawn.longest_mm, drawn.pole_mm) == (Fraction(60), Fraction(50))


@each("name, least", [("gears-ex1", 38.0), ("gears-ex2", 55.0), ("tasks/gears-2-2-011", 55.0)])
def test_the_slopes_of_the_rays_can_be_read(name: str, least: float) -> None:
    """The pole is at least 55 mm above the ends of the rays where A2 has space for that."""
    drawing = sheet(PROBLEMS / f"gears/{name}.toml")
    (pole,) = (i.centre for i in drawing.items if isinstance(i, Disc) and i.tag == "pole of rays")
    (ray,) = (span for view in drawing.views for span in view.spans if span.name == "o1")
    assert (pole - ray.start).imag >= least


def test_level_centre_lines_of_wheels_on_one_axis_do_not_overlap() -> None:
    motion = solve_motion(load(PROBLEMS / "gears/tasks/gears-2-2-011.toml"))
    items = front(SchemeData(motion, 1.0), 5.0, {}).items
    lines = [item.points for item in items if isinstance(item, Stroke) and item.pen is Pen.AXIS]
    level = sorted(
        (round(start.imag, 3), start.real, end.real)
        for start, end in lines
        if abs((end - start).imag) < 1e-9
    )
    assert len({height for height, _, _ in level}) == 4
    for (height, _, reached), (other, start, _) in pairwise(level):
        assert other != height or start >= reached - 1e-9


def test_the_picture_is_beside_the_scheme_at_its_heights() -> None:
    drawing = sheet(PROBLEMS / "gears/gears-ex1.toml")
    strokes = [item for item in drawing.items if isinstance(item, Stroke)]
    levels = {round(s.points[0].imag, 6) for s in strokes if s.tag == "projection"}
    scheme, picture = drawing.views[:2]
    assert scheme.box[2] == pytest.approx(picture.box[0])
    assert {round(span.start.imag, 6) for span in picture.spans} <= levels


def test_letters_along_the_axes_are_clear_of_meshes_and_axes(tmp_path: Path) -> None:
    """Wheel 5 lies on the arm of H: its letter is not where it meets 4 and 1, H not at its axis."""
    text = told(
        {"1": 20, "2": 40, "2'": 25, "3": 85, "4": 13, "5": 20},
        [mesh("1", "2", carrier="H"), mesh("2'", "3", "internal", "H"), mesh("4", "5")],
        'bodies = [["H", "4"]]\nfixed = ["3"]\nn = { 1 = -960 }',
    )
    scheme = SchemeData(solved(tmp_path, text), 1.0)
    rims = {rim.label: rim for column in scheme.columns for rim in column}
    items = front(scheme, 5.0, {}).items
    letters = {item.text: item.at + 1 + 2.5j for item in items if isinstance(item, Text)}
    assert {"5", "H"} <= letters.keys()
    gaps = [abs(abs(letters["5"] - 1j * rims[k].centre) - rims[k].radius) for k in ("1", "2'", "4")]
    assert min(gaps) > 2.0
    assert min(abs(letters["H"].imag - rim.centre) for rim in rims.values()) > 5.0


def test_paper_language_and_stamp_follow_the_request(tmp_path: Path) -> None:
    def lint(*args: str) -> Any:
        return CliRunner().invoke(cli, ["lint", str(FILES[0]), *args])

    done = lint("--paper", "A3", "--lang", "en")
    assert done.exit_code == ExitCode.DONE, done.output
    assert "A3" in done.output
    problem = load(FILES[0])
    (drawing,) = drawings(
        problem,
        PlanRequest(fields={"author": "Иванов"}, before=1, total=3),
    )
    assert "Иванов" in texts(drawing)
    many = told(
        {f"{k}": 40 for k in range(1, 6)},
        [mesh(f"{k}", f"{k + 1}") for k in range(1, 5)],
        "n = { 1 = 1 }",
    )
    path = written(tmp_path, many)
    path.write_text(
        '[sheet]\npaper = "A4"\n' + path.read_text(encoding="utf-8").replace("title", "#")
    )
    with pytest.raises(LayoutError, match="does not fit A4"):
        sheet(path)


# The order along the axes -------------------------------------------------------------------------


def order(found: Arrangement) -> str:
    return " ".join(
        ",".join(rim.label for rim in station.rims)
        if station.part is AxisPart.RIMS
        else f"{station.part.value}-{station.body}"
        for station in found.stations
    )


@pytest.mark.parametrize(
    ("name", "due"),
    [
        ("gears-ex2", "1,2 arm-H 5,4,3"),
        ("gears-ex4", "1,2,3 arm-H 3',4"),
        ("gears-ex6", "web-H 3',4,5 web-3 arm-H 1,2,3"),
    ],
)
def test_the_order_of_the_worked_examples(name: str, due: str) -> None:
    assert (
        order(arrange(SchemeData(solve_motion(load(PROBLEMS / f"gears/{name}.toml")), 1.0))) == due
    )


@each("seed", range(some(40, 5)))
def test_no_body_is_in_the_way_of_another(seed: int, tmp_path: Path) -> None:
    for maker in PLANAR:
        text = maker(random.Random(200 + seed)).text
        found = arrange(SchemeData(solved(tmp_path, text), 1.0))
        assert not [c for v in found.verticals() for c in found.crosses(*v)], text
        for one, (a, b) in found.reach.items():
            for other, (c, d) in found.reach.items():
                level = found.scheme.heights[one] == found.scheme.heights[other]
                if one < other and level and max(a, c) <= min(b, d):
                    assert one in found.inner(other) or other in found.inner(one), text


def test_a_wheel_that_would_cover_another_is_drawn_wide(tmp_path: Path) -> None:
    """Wheel 1 drives 2 and 3 on the same side, of other radii: two columns."""
    text = told({"1": 20, "2": 30, "3": 40}, [mesh("1", "2"), mesh("1", "3")], "n = { 1 = 100 }")
    motion = solved(tmp_path, text)
    assert [[rim.label for rim in column] for column in SchemeData(motion, 1.0).columns] == [
        ["1", "2"],
        ["1", "3"],
    ]
    drawing = sheet(written(tmp_path, text))
    assert not faults(drawing)


def test_the_view_along_the_axes_has_the_velocities_of_the_textbook() -> None:
    """K10: v_A = 70, v_C = 30, v_B = 20, v_D = 24 cm/s; only the second is to the right."""
    (sheet,) = drawings(load(PROBLEMS / "gears/planetary-k10.toml"), PlanRequest())
    arrows = [item for item in sheet.items if getattr(item, "tag", "") == "velocity"]
    found = sorted(
        (head.points[0] - shaft.points[0]).real
        for shaft, head in pairwise(arrows)
        if isinstance(shaft, Stroke) and isinstance(head, Fill)
    )
    due = [-70 / 2, -24 / 2, -20 / 2, 30 / 2]  # 2 cm/s in a millimetre
    assert found == pytest.approx(due, abs=0.01)
    (toothed,) = drawings(load(PROBLEMS / "gears/gears-ex2.toml"), PlanRequest())
    assert not any(getattr(item, "tag", "") == "velocity" for item in toothed.items)
