"""DXF: the entities that a CAD program finds in the file, in the sheet's millimetres."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from cmath import rect
from collections import Counter
from functools import cache
from io import BytesIO, StringIO
from itertools import product
from math import pi, radians, tau
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
from cases import thinned
from click.testing import CliRunner, Result
from doors import (
    DIMENSION,
    DRAFTING_PROFILES as PROFILES,
    ENLARGED,
    LAYERS,
    LINE_TYPES,
    PENS,
    TEXT_STYLE,
    Arc,
    Bounds,
    Disc,
    Drawing,
    Fill,
    Ink,
    Options,
    Pen,
    PenSet,
    PlanKind,
    Solution,
    Stroke,
    Text,
    VectorKind,
    analyse,
    angle_dimension,
    arrowhead,
    cli,
    composition,
    dimension,
    drawn_edges,
    force_reading,
    in_use,
    kinematics_sheets,
    layer_of,
    render,
    revolute,
    structure_sheet,
    sweep,
    turn_arrow,
    typeset,
    using_pens,
    vector_arrow,
)
from msgspec.structs import replace
from PIL import Image
from reading import Path as Painted, Run, read_dxf
from worked import PROBLEMS, ROOT, SIX, drawn_sheets, every_file, path_of, problem_of, solved_while

NEAR = 0.01  # mm
FILES = {str(path.relative_to(PROBLEMS).with_suffix("")): path for path in every_file()}
TEXT = Options(dxf_text="text")
STROKES = Options(dxf_text="strokes")


def read(data: bytes) -> Any:
    library: Any = ezdxf
    return library.read(StringIO(data.decode("utf-8")))


@cache
def read_sheet(name: str) -> Any:
    """Return the file of a sheet, read once; its letters are strokes."""
    (drawing,) = drawn_sheets(name)
    return read(render(drawing, "dxf"))


def space_of(*items: Any) -> Any:
    return read(render(Drawing(210.0, 297.0, items=list(items)), "dxf")).modelspace()


def kinds(space: Any) -> list[str]:
    return [entity.dxftype() for entity in space]


def point(place: Any) -> complex:
    return complex(place[0], place[1])


def near(a: complex, b: complex) -> bool:
    return abs(a - b) < NEAR


def program(*args: object) -> Result:
    return CliRunner().invoke(cli, [str(word) for word in args])


# Whole sheets -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "options"),
    [*((name, TEXT) for name in FILES), *((name, STROKES) for name in thinned([*FILES], 4))],
)
def test_the_audit_of_every_sheet_finds_no_faults(name: str, options: Options) -> None:
    for drawing in drawn_sheets(name):
        document = read(render(drawing, "dxf", options=options))
        found = document.audit()
        assert (found.errors, found.fixes) == ([], [])
        assert document.dxfversion == "AC1024"  # R2010
        assert document.header["$INSUNITS"] == 4
        assert document.header["$EXTMAX"] == (drawing.width, drawing.height, 0.0)
        layers = {entity.dxf.layer for entity in document.modelspace()}
        assert layers <= set(LAYERS)


def test_the_audit_of_sheets_with_a_dozen_positions_finds_no_faults() -> None:
    asked = [30.0 * k for k in range(12)]
    for drawing in drawn_sheets("linkages/ex1", asked):
        found = read(render(drawing, "dxf")).audit()
        assert (found.errors, found.fixes) == ([], [])


def test_the_structure_sheet_and_error_ellipses_are_drawn() -> None:
    problem = problem_of("linkages/ex3")
    sheets = [structure_sheet(problem, analyse(problem.mechanism))]
    sheets += kinematics_sheets(problem, errors=True)
    for drawing in sheets:
        document = read(render(drawing, "dxf"))
        assert not document.audit().errors
    assert document.modelspace().query('*[layer=="ERRORS"]')


@pytest.mark.parametrize("name", SIX)
def test_lines_and_letters_of_a_sheet_are_where_they_were_put(name: str) -> None:
    (drawing,) = drawn_sheets(name)
    page = read_dxf(render(drawing, "dxf", options=TEXT))
    assert (page.width, page.height) == (drawing.width, drawing.height)
    runs = [item for item in page.items if isinstance(item, Run)]
    wanted = [item for item in drawing.items if isinstance(item, Text) and item.text.strip()]
    # The texts of the title block are in its block and in the reference to it.
    runs.sort(key=lambda run: (run.text, run.at.real, run.at.imag))
    wanted.sort(key=lambda item: (item.text.strip(), item.at.real, item.at.imag))
    assert [run.text for run in runs] == [item.text.strip() for item in wanted]
    for run, text in zip(runs, wanted, strict=True):
        assert near(run.at, text.at) or text.text.startswith(" ")
        assert run.em == pytest.approx(in_use().em(text.height), abs=1e-6)

    lines = [item.corners for item in page.items if isinstance(item, Painted) and item.corners]
    starts = {(round(c[0].real, 1), round(c[0].imag, 1)) for c in lines}
    for item in drawing.items:
        if not isinstance(item, Stroke) or len(set(item.points)) < 2:
            continue
        a = item.points[0]
        # The line of a vector is extended to the tip of its arrow: its start is unchanged.
        assert (round(a.real, 1), round(a.imag, 1)) in starts, item
        if item.tag in {kind.value for kind in VectorKind}:
            continue
        same = [
            c
            for c in lines
            if len(c) == len(item.points)
            and all(near(p, q) for p, q in zip(c, item.points, strict=True))
        ]
        assert same, item


@pytest.mark.dear
@pytest.mark.parametrize("name", SIX)
def test_circles_and_arcs_of_a_sheet_are_where_they_were_put(name: str) -> None:
    (drawing,) = drawn_sheets(name)
    found = []
    for entity in read_sheet(name).modelspace():
        parts = entity.virtual_entities() if entity.dxftype() == "INSERT" else [entity]
        found += [part for part in parts if part.dxftype() in {"CIRCLE", "ARC"}]
    for item in drawing.items:
        if not isinstance(item, Arc):
            continue
        whole = sweep(item) >= tau
        assert any(
            part.dxftype() == ("CIRCLE" if whole else "ARC")
            and near(point(part.dxf.center), item.centre)
            and abs(part.dxf.radius - item.radius) < NEAR
            and (
                whole
                or (
                    near(point(part.start_point), item.centre + item.radius * turn(item.start))
                    and near(point(part.end_point), item.centre + item.radius * turn(item.end))
                )
            )
            for part in found
        ), item


def turn(angle: float) -> complex:
    return rect(1.0, angle)


# Measured lengths ---------------------------------------------------------------------------------


@pytest.mark.dear
@pytest.mark.parametrize("name", SIX)
def test_a_segment_of_a_plan_is_one_line_as_long_as_in_the_table(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # As the command draws for DXF: by a hand that lays off to 0.01 mm.
    cad = PROFILES["cad"]
    sheets, solution = solved_while(
        lambda: kinematics_sheets(problem_of(name), profile=cad), monkeypatch
    )
    spaces = [read(render(drawing, "dxf")).modelspace() for drawing in sheets]
    lines = [
        (point(line.dxf.start), point(line.dxf.end))
        for space in spaces
        for line in space.query('LINE[layer=="PLAN_VECTORS"]')
    ]
    exact = [
        segment.exact[0]
        for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION)
        for segment in solution.segments(kind)
    ]
    drawn = sorted(length for length in exact if length >= 0.3)
    # Enlarged views come after the plans, with parts of the segments that are in their circles.
    views = [
        abs(b - a)
        for drawing, space in zip(sheets, spaces, strict=True)
        for a, b in ((point(line.dxf.start), point(line.dxf.end)) for line in space.query("LINE"))
        for arc in drawing.items
        if isinstance(arc, Arc) and arc.tag.startswith(ENLARGED) and arc.tag[-1].isdigit()
        if max(abs(p - arc.centre) for p in (a, b)) < arc.radius + 0.1
    ]
    found = sorted(abs(b - a) for a, b in lines)
    for length in views:
        found = [one for one in found if one != length]
    assert found == pytest.approx(drawn, abs=0.05)


def _inside(place: complex, box: Bounds) -> bool:
    return box[0] <= place.real <= box[2] and box[1] <= place.imag <= box[3]


@pytest.mark.dear
@pytest.mark.parametrize("name", ["levers/six-link", "levers/task12", "press/press"])
def test_a_force_of_a_plan_is_one_line_as_long_as_the_force_over_its_scale(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    forces = composition("forces", "ru")  # without the plans of the motion, whose lines are similar
    alone = replace(forces, blocks=tuple(one for one in forces.blocks if one.kind != "plan"))

    def draw() -> list[Drawing]:
        return kinematics_sheets(problem_of(name), layout=alone)

    (sheet,), solution = solved_while(draw, monkeypatch)
    lines = read(render(sheet, "dxf")).modelspace().query('LINE[layer=="PLAN_VECTORS"]')
    motion = [view.box for view in sheet.views if view.kind in ("velocity", "acceleration")]
    assert len(motion) == 1  # that of the lever
    ends = [(point(line.dxf.start), point(line.dxf.end)) for line in lines]
    drawn = [pair for pair in ends if not any(_inside(pair[0], box) for box in motion)]
    found = sorted(abs(end - start) for start, end in drawn)
    reading = force_reading(solution, 0)
    wanted = sorted(
        abs(reading.drawn(number, edge))
        for number in range(len(reading.plans))
        for edge in drawn_edges(reading, number)
    )
    assert found == pytest.approx(wanted, abs=1e-6)


def test_pb_of_the_third_example_is_64_mm() -> None:
    space = read_sheet("linkages/ex3").modelspace()
    line = space.query('LINE[layer=="PLAN_VECTORS"]')[0]
    assert abs(point(line.dxf.end) - point(line.dxf.start)) == pytest.approx(64.0, abs=1e-9)


def test_a_thick_vector_keeps_its_thickness_beside_its_line() -> None:
    space = space_of(*vector_arrow(10 + 10j, 50 + 40j, tag="absolute"))
    assert kinds(space) == ["SOLID", "LINE", "INSERT"]
    body, line, head = space
    assert (point(line.dxf.start), point(line.dxf.end)) == (10 + 10j, 50 + 40j)
    assert point(head.dxf.insert) == 50 + 40j
    a, b, _, _ = (point(corner) for corner in body.vertices())
    assert abs(a - b) == pytest.approx(PenSet().width(Pen.RESULTANT))
    assert {body.dxf.layer, head.dxf.layer} == {"PLAN_ARROWS"}


def test_vectors_of_each_colour_have_layers_of_their_own_on_a_sheet_in_colour() -> None:
    (plain,) = drawn_sheets("linkages/ex3")
    coloured = replace(plain, pens=PenSet(is_coloured=True))
    documents = [read(render(one, "dxf")) for one in (plain, coloured)]
    usual, own = ({layer.dxf.name for layer in document.layers} for document in documents)
    kinds = {"PLAN_RELATIVE", "PLAN_COMPONENTS"}
    assert own - usual == kinds | {f"{kind}_ARROWS" for kind in kinds}
    lines = [
        [one for one in document.modelspace().query("LINE") if one.dxf.layer.startswith("PLAN_")]
        for document in documents
    ]
    assert [(point(a.dxf.start), point(a.dxf.end)) for a in lines[0]] == [
        (point(b.dxf.start), point(b.dxf.end)) for b in lines[1]
    ]
    assert {line.dxf.layer for line in lines[0]} <= {"PLAN_VECTORS", "PLAN_FIGURES"}
    assert kinds < {line.dxf.layer for line in lines[1]}
    assert not any(line.dxf.hasattr("true_color") for line in lines[1])


@pytest.mark.parametrize(("tag", "pen"), [("absolute", Pen.RESULTANT), ("relative", Pen.RELATIVE)])
def test_a_vector_in_colour_has_it_from_end_to_tip(tag: str, pen: Pen) -> None:
    pens = PenSet(is_coloured=True)
    with using_pens(pens):
        items = vector_arrow(10 + 10j, 50 + 40j, pen=pen, tag=tag)
    document = read(render(Drawing(100.0, 100.0, items=items, pens=pens), "dxf"))
    wanted = int.from_bytes(bytes(pens.colour(pen)), "big")
    for one in document.modelspace():
        assert not one.dxf.hasattr("true_color"), "by layer"
        assert document.layers.get(one.dxf.layer).dxf.true_color == wanted
    (inside,) = document.blocks.get("ARROWHEAD")
    assert inside.dxf.color == 0  # that of the reference


def test_a_thin_vector_is_a_line_and_a_head() -> None:
    space = space_of(*vector_arrow(10 + 10j, 50 + 40j, pen=Pen.THIN, tag="normal"))
    assert kinds(space) == ["LINE", "INSERT"]
    assert point(space[0].dxf.end) == 50 + 40j


# Entities -----------------------------------------------------------------------------------------


def test_layers_have_the_pens_and_line_types_the_dashes() -> None:
    document = read(render(Drawing(10.0, 10.0), "dxf"))
    for name, pen in LAYERS.items():
        layer = document.layers.get(name)
        assert layer.dxf.lineweight == pytest.approx(100 * PenSet().width(pen), abs=3.0)
        assert layer.dxf.linetype == LINE_TYPES.get(pen, "Continuous")
        assert (layer.rgb or (0, 0, 0))[0] == pytest.approx(255 * PENS[pen].grey, abs=0.5)
    for pen, name in LINE_TYPES.items():
        dashes = PENS[pen].dashes
        assert dashes
        pattern = document.linetypes.get(name).simplified_line_pattern()
        assert sum(pattern) == pytest.approx(dashes.stroke + dashes.gap)
        assert pattern[0] == dashes.stroke
        assert (pattern[2:3] == (dashes.dot,)) == bool(dashes.dot)


def test_a_line_looks_as_its_pen_on_every_layer() -> None:
    tags = ("", "table", "stamp", "link 3", "guide", "similar")
    strokes = [
        Stroke((complex(1, k), complex(40, k)), pen, tag=tag)
        for k, (pen, tag) in enumerate(product(Pen, tags), 1)
    ]
    data = render(Drawing(50.0, 100.0, items=[*strokes]), "dxf", options=STROKES)
    document = read(data)
    for stroke, line, path in zip(
        strokes, document.modelspace(), read_dxf(data).items, strict=True
    ):
        case = (stroke.pen, stroke.tag)
        assert near(point(line.dxf.start), stroke.points[0]), case
        layer = document.layers.get(layer_of(stroke.tag, stroke.pen))
        assert line.dxf.layer == layer.dxf.name, case
        linetype = line.dxf.get("linetype", layer.dxf.linetype)
        assert linetype == LINE_TYPES.get(stroke.pen, "Continuous"), case
        assert isinstance(path, Painted), case
        assert path.width == pytest.approx(PenSet().width(stroke.pen), abs=0.031), case
        assert path.grey == pytest.approx(PENS[stroke.pen].grey, abs=0.01), case


def test_joints_and_arrowheads_are_blocks() -> None:
    joints = [item for k in range(4) for item in revolute(complex(10 * k, 5))]
    document = read(render(Drawing(90.0, 90.0, items=joints), "dxf"))
    space = document.modelspace()
    assert kinds(space) == ["INSERT"] * 4
    assert len({entity.dxf.name for entity in space}) == 1
    block = document.blocks.get(space[0].dxf.name)
    assert [entity.dxftype() for entity in block] == ["WIPEOUT", "CIRCLE"]

    angles = (0.0, 1.0, 2.5, -pi / 2)
    heads = [head for a in angles for head in arrowhead(20 + 20j, turn(a), length=3.0 + a)]
    page = read_dxf(render(Drawing(90.0, 90.0, items=heads), "dxf"))
    for path, head in zip(page.items, heads, strict=True):
        assert isinstance(path, Painted)
        assert isinstance(head, Fill)
        assert all(near(p, q) for p, q in zip(path.corners, head.points, strict=True))
        assert path.filled
    assert kinds(space_of(*turn_arrow(20 + 20j, 9.0, 1))) == ["ARC", "INSERT"]


def test_white_hides_and_black_fills() -> None:
    space = space_of(
        Stroke((0j, 50 + 50j)),
        Disc(20 + 20j, 4.0),
        Fill((1 + 1j, 9 + 1j, 5 + 8j), Ink.WHITE),
        Disc(30 + 30j, 1.0, Ink.BLACK),
        Fill((1 + 1j, 9 + 1j, 5 + 8j)),
    )
    assert kinds(space) == ["LINE", "WIPEOUT", "WIPEOUT", "HATCH", "CIRCLE", "HATCH"]
    assert {entity.dxf.layer for entity in space.query("WIPEOUT")} == {"MASKS"}
    corners = [point(corner) for corner in space[1].boundary_path_wcs()]
    assert all(near(abs(corner - (20 + 20j)), 4.0) for corner in corners)


def test_a_dashed_curve_is_one_polyline() -> None:
    curve = tuple(30 + 30j + 20 * turn(k / 20) for k in range(60))
    space = space_of(Stroke(curve, Pen.HIDDEN), Stroke((1j, 30 + 1j, 30 + 30j), Pen.HIDDEN))
    assert kinds(space) == ["LWPOLYLINE"] * 2
    assert [entity.dxf.flags & 128 for entity in space] == [128, 0]


# Letters ------------------------------------------------------------------------------------------


def test_text_is_text_of_the_width_of_the_sheet() -> None:
    texts = [
        Text(10 + 20j, "План скоростей", 5.0),
        Text(50 + 50j, "ω₂ = 15,48 ⊥BC", 3.5, angle=90.0),
        Text(70 + 50j, "ёЁ ", 2.5, angle=-30.0, tag="stamp"),
        Text(70 + 90j, " ^x %%d 50%", 2.5),
    ]
    document = read(render(Drawing(210.0, 297.0, items=[*texts]), "dxf", options=TEXT))
    style = document.styles.get(TEXT_STYLE).dxf
    assert (style.font, style.oblique) == ("isocpeur.ttf", pytest.approx(15.0, abs=0.1))
    form = document.blocks.get("TITLE_BLOCK")
    space = list(document.modelspace().query("TEXT"))
    for entity, item in zip([*space[:2], *form.query("TEXT"), *space[2:]], texts, strict=True):
        assert entity.dxftype() == "TEXT"
        assert entity.plain_text() == item.text.strip()
        assert entity.dxf.height == item.height
        assert entity.dxf.style == TEXT_STYLE
        start, way = point(entity.dxf.insert), turn(item.angle * pi / 180)
        lead = in_use().width(" ", item.height) if item.text[0] == " " else 0.0
        assert near(start, item.at + lead * way)
        assert entity.dxf.rotation == pytest.approx(item.angle % 360.0)
        assert entity.dxf.lineweight == min(
            (20, 25, 35, 50), key=lambda w: abs(w - 10 * item.height)
        )
        if len(item.text.strip()) < 4:  # LibreCAD would distort so few
            assert entity.dxf.halign == 0
            continue
        end = point(entity.dxf.align_point)
        assert abs(end - start) == pytest.approx(in_use().width(item.text.strip(), item.height))
        assert near((end - start) / abs(end - start), way)
    layers = [entity.dxf.layer for entity in (*document.modelspace(), *form)]
    assert layers == ["TEXT", "TEXT", "TITLE_BLOCK", "TEXT", "TITLE_BLOCK"]


@pytest.mark.parametrize("angle", [90.0, -30.0, 0.0])
def test_a_turned_inscription_is_one_text_with_its_rotation(angle: float) -> None:
    """``a_w = 109,861`` along a dimension line: not three texts; a level one is fitted in runs."""
    made = typeset("a_{w} = 109,861 a^{n}_{\\{x\\}}", 3.5).at(60 + 50j, angle=angle)
    space = read(render(Drawing(210.0, 297.0, items=made), "dxf", options=TEXT)).modelspace()
    runs = [item.text.strip() for item in made if isinstance(item, Text)]
    assert runs == ["a", "w", "= 109,861 a", "{x}", "n"]
    if not angle:
        assert [entity.plain_text() for entity in space] == runs
        return
    (entity,) = space
    assert entity.dxftype() == "MTEXT"
    assert entity.dxf.rotation % 360.0 == angle % 360.0
    assert entity.plain_text().startswith("a^w = 109,861 a")
    assert entity.dxf.char_height == 3.5
    first = made[0]
    assert isinstance(first, Text)
    corner = first.at + 3.5 * turn((90.0 + angle) * pi / 180)
    assert near(point(entity.dxf.insert), corner)
    # the stacks show which index is above: empty/below, above/empty
    assert re.findall(r"\\S([^;]*);", entity.text) == ["^ w", r"^ \{x\}", "n^ "]


def test_a_turned_text_ends_where_the_next_one_begins() -> None:
    items = [*typeset("a_{w}", 3.5).at(60 + 50j, angle=90.0), Stroke((0j, 9j), Pen.THIN),
             *typeset("b_{w}", 3.5).at(60 + 50j, angle=90.0)]  # fmt: skip
    space = read(render(Drawing(210.0, 297.0, items=items), "dxf", options=TEXT)).modelspace()
    assert kinds(space) == ["MTEXT", "LINE", "MTEXT"]


def test_the_words_of_a_sheet_are_found() -> None:
    (drawing,) = drawn_sheets("linkages/ex3")
    space = read(render(drawing, "dxf", options=TEXT)).modelspace()
    words = {entity.plain_text() for entity in space.query("TEXT")}
    words |= {entity.plain_text() for entity in space.doc.blocks.get("TITLE_BLOCK").query("TEXT")}
    (form,) = space.query('INSERT[name=="TITLE_BLOCK"]')
    fields = {entity.dxf.tag: entity.dxf.text for entity in form.attribs}
    assert fields["DESIGNATION"] == "ТММ.01.03.00.000"
    # LibreCAD shows no attributes, but hidden texts: each has its copy.
    texts = space.doc.blocks.get("TITLE_BLOCK").query("TEXT")
    copies = [entity for entity in texts if entity.dxf.get("invisible")]
    assert sorted(e.dxf.text for e in copies) == sorted(fields.values())
    words |= set(fields.values())
    assert {"План скоростей", "План ускорений", "Кафедра ТММ", "Разраб."} <= words


def test_strokes_are_lines_with_the_extents_and_the_weight_of_the_letters() -> None:
    for angle in (0.0, 90.0):
        item = Text(30 + 40j, "Жук b8", 5.0, angle=angle)
        data = render(Drawing(210.0, 297.0, items=[item]), "dxf", options=STROKES)
        assert set(kinds(read(data).modelspace())) == {"INSERT"}
        paths = [path for path in read_dxf(data).items if isinstance(path, Painted)]
        assert {path.width for path in paths} == {0.5}
        assert not any(path.filled for path in paths)
        assert len(paths) == sum(len(in_use().strokes(char)) for char in item.text)
        flat = [(z - item.at) / turn(angle * pi / 180) for path in paths for z in path.corners]
        xs, ys = [z.real for z in flat], [z.imag for z in flat]
        ink = in_use().ink(item.text, item.height)
        edge = (min(xs) - 0.25, min(ys) - 0.25, max(xs) + 0.25, max(ys) + 0.25)
        assert edge == pytest.approx(ink, abs=NEAR)


@pytest.mark.skipif(shutil.which("librecad") is None, reason="LibreCAD is not installed")
def test_librecad_prints_the_sheet_as_it_is(tmp_path: Path) -> None:
    """Without any option: paper of the sheet's size, ink to the frame, letters as drawn."""
    (drawing,) = drawn_sheets("linkages/ex3")
    (tmp_path / "a.dxf").write_bytes(render(drawing, "dxf", options=STROKES))
    own = {"QT_QPA_PLATFORM": "offscreen", "HOME": str(tmp_path), "XDG_RUNTIME_DIR": str(tmp_path)}
    asked: dict[str, Any] = {"cwd": tmp_path, "check": True, "capture_output": True, "timeout": 60}
    subprocess.run(["librecad", "dxf2pdf", "a.dxf"], env={**os.environ, **own}, **asked)
    subprocess.run(["pdftoppm", "-r", "101.6", "-png", "-singlefile", "a.pdf", "a"], **asked)
    printed = np.asarray(Image.open(tmp_path / "a.png").convert("L"))
    drawn = np.asarray(Image.open(BytesIO(render(drawing, "png", options=Options(dpi=101.6)))))
    assert np.abs(np.subtract(printed.shape, drawn.shape)).max() <= 4
    # The ink of squares of 6 mm; LibreCAD knows no wipeouts, and poppler draws a line thinner
    # than a pixel as wide as one: at 50.8 dpi that made half of the difference.
    alike = np.corrcoef(squares(printed), squares(drawn))[0, 1]
    print(alike)
    assert alike > 0.985


def squares(picture: Any) -> Any:
    rows, columns = (size // 24 for size in (1640, 2360))
    cut = picture[: rows * 24, : columns * 24].reshape(rows, 24, columns, 24)
    return cut.mean(axis=(1, 3)).ravel()


# Files and the command line -----------------------------------------------------------------------


@pytest.mark.parametrize("options", [TEXT, STROKES], ids=["text", "strokes"])
def test_the_same_bytes_twice(options: Options) -> None:
    (drawing,) = drawn_sheets("linkages/ex3")
    assert render(drawing, "dxf", options=options) == render(drawing, "dxf", options=options)


def test_the_option_chooses_the_letters(tmp_path: Path) -> None:
    ex3 = path_of("linkages/ex3")
    found = {}
    for how in ("text", "strokes"):
        asked = ("--format", "dxf", "--dxf-text", how, "-o", tmp_path / how)
        assert program("sheet", ex3, *asked).exit_code == 0
        assert program("structure", ex3, *asked).exit_code == 0
        for name in ("ex3", "ex3-structure"):
            data = (tmp_path / how / f"{name}.dxf").read_bytes()
            found[how, name] = Counter(kinds(read(data).modelspace()))["TEXT"]
    assert found["text", "ex3"] > 100
    assert found["text", "ex3-structure"] > 50
    assert found["strokes", "ex3"] == found["strokes", "ex3-structure"] == 0
    assert program("sheet", ex3, "--dxf-text", "shx").exit_code == 2


def test_without_its_library_the_install_command_is_named(tmp_path: Path) -> None:
    code = (
        "import importlib.util as u, sys\n"
        "found = u.find_spec\n"
        "u.find_spec = lambda name, *rest: None if name == 'ezdxf' else found(name, *rest)\n"
        "from planmethod.__main__ import main\n"
        "sys.argv = ['planmethod', *sys.argv[1:]]\n"
        "main()"
    )
    for command in ("sheet", "structure"):
        done = subprocess.run(
            [sys.executable, "-c", code, command, path_of("linkages/ex3"), "--format", "svg,dxf"],
            capture_output=True,
            encoding="utf-8",
            cwd=tmp_path,
            timeout=120,
        )
        assert done.returncode == 2
        assert "DXF needs ezdxf: pip install ezdxf" in done.stderr
        assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("folder", ["docs", "docs/ru"])
def test_the_document_lists_the_layers_as_they_are(folder: str) -> None:
    """By width, in order."""
    text = (ROOT / folder / "how-to" / "export-to-cad.md").read_text(encoding="utf-8")
    rows = re.findall(r"(?m)^\| ([\d.]+) \| (`.*`) \|$", text)
    by_width = {width: re.findall(r"`(\w+)`", names) for width, names in rows}
    assert sum(map(len, by_width.values())) == len(LAYERS)
    for width, names in by_width.items():
        assert names == [
            name for name, pen in LAYERS.items() if f"{PenSet().width(pen):g}" == width
        ]


def test_a_dxf_is_laid_off_as_by_cad_unless_another_profile_is_requested(tmp_path: Path) -> None:
    command = ["sheet", str(path_of("linkages/ex3")), "-o", str(tmp_path)]

    def lengths(*more: str, formats: str = "dxf") -> list[float]:
        assert CliRunner().invoke(cli, [*command, "--format", formats, *more]).exit_code == 0
        lines = read((tmp_path / "ex3.dxf").read_bytes()).modelspace()
        found = lines.query('LINE[layer=="PLAN_VECTORS"]')
        return sorted(abs(point(line.dxf.end) - point(line.dxf.start)) for line in found)

    solution = Solution(problem_of("linkages/ex3"))
    exact = sorted(
        float(segment.exact[0])
        for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION)
        for segment in solution.segments(kind)
    )
    assert lengths() == pytest.approx(exact, abs=0.02)
    on_board = lengths("--profile", "board")
    assert on_board != pytest.approx(exact, abs=0.1)
    # Beside another file it is the same sheet, with its numbers.
    assert lengths(formats="svg,dxf") == on_board


def test_a_size_of_the_frame_is_a_dimension_as_it_is_drawn() -> None:
    """Its measurement is the distance between the arrow tips; its block has the sheet's lines."""
    (drawing,) = drawn_sheets("levers/six-link")[:1]
    tags = {item.tag for item in drawing.items if getattr(item, "tag", "").startswith("dimension ")}
    space = read(render(drawing, "dxf", options=TEXT)).modelspace()
    found = space.query("DIMENSION")
    assert len(found) == len(tags) > 0
    for entity in found:
        parts = list(entity.virtual_entities())
        tips = [point(part.dxf.insert) for part in parts if part.dxftype() == "INSERT"]
        assert len(tips) == 2
        assert entity.get_measurement() == pytest.approx(abs(tips[1] - tips[0]), abs=NEAR)
        assert entity.dxf.text


def _dimensioned(items: list[Any], letter: str, at: complex) -> Any:
    """Return the one DIMENSION of items with their letter, and check its picture."""
    letters = typeset(letter, 3.5).at(at, label=f"{DIMENSION} {letter}")
    space = space_of(*items, *letters)
    (entity,) = space.query("DIMENSION")
    assert len(space) == 1
    drawn = Counter(part.dxftype() for part in entity.virtual_entities())
    assert drawn["LINE"] + drawn["ARC"] == sum(isinstance(i, (Stroke, Arc)) for i in items)
    assert drawn["INSERT"] == sum(isinstance(i, Fill) for i in items)
    assert drawn["TEXT"] == len(letters)
    return entity


def test_every_kind_of_dimension_measures_what_it_is_of() -> None:
    tag, centre = f"{DIMENSION} r_{{0}}", 100 + 100j
    along = _dimensioned(dimension(centre, centre + 40 + 9j, 12j, tag=tag), "r_{0}", 120 + 115j)
    assert along.dimtype == 0
    assert along.get_measurement() == pytest.approx(abs(40 + 9j), abs=NEAR)

    tip = centre + rect(30.0, 0.4)
    line = [Stroke((centre, tip), Pen.THIN, tag=tag), *arrowhead(tip, tip - centre, tag=tag)]
    radius = _dimensioned(line, "r_{0}", 110 + 107j)
    assert radius.dimtype == 4
    assert radius.get_measurement() == pytest.approx(30.0, abs=NEAR)
    assert near(point(radius.dxf.defpoint), centre)

    tag = f"{DIMENSION} d"
    ends = (centre - 30, centre + 30)
    heads = [*arrowhead(ends[0], -1 + 0j, tag=tag), *arrowhead(ends[1], 1 + 0j, tag=tag)]
    across = _dimensioned([Stroke(ends, Pen.THIN, tag=tag), *heads], "d", centre + 1j)
    assert across.dimtype == 3
    assert across.get_measurement() == pytest.approx(60.0, abs=NEAR)

    tag = f"{DIMENSION} ψ"
    angle = _dimensioned(angle_dimension(centre, 25.0, 0.3, 1.6, tag=tag), "ψ", 112 + 122j)
    assert angle.dimtype == 5
    assert radians(angle.get_measurement()) == pytest.approx(1.3, abs=1e-6)


def test_dimensions_of_one_letter_in_two_pictures_are_two() -> None:
    tag = f"{DIMENSION} e"
    pictures = [
        [*dimension(at, at + 20, -9j, tag=tag), *typeset("e", 3.5).at(at + 8 - 8j, label=tag)]
        for at in (50 + 50j, 50 + 150j)
    ]
    found = space_of(*pictures[0], *pictures[1]).query("DIMENSION")
    assert [one.dxf.defpoint2[1] for one in found] == pytest.approx([50.0, 150.0])
    assert [one.dxf.text for one in found] == ["e", "e"]


def test_lines_of_a_dimension_without_heads_are_lines() -> None:
    space = space_of(Stroke((50 + 50j, 90 + 50j), Pen.THIN, tag=f"{DIMENSION} e"))
    assert kinds(space) == ["LINE"]
