"""Contract of every output format: the items of the display list are on the paper, in place.

Coordinates are read back from the files and compared to 0.01 mm. Some tests need Chromium, librsvg
or poppler; without the program they are skipped, with the reason.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET
from cmath import exp
from collections.abc import Callable
from io import BytesIO
from math import inf, nan, pi, tau
from pathlib import Path as FilePath
from typing import Any

import numpy as np
import pytest
from browser import browsing
from cases import each
from doors import (
    BACKENDS,
    PENS,
    Arc,
    Disc,
    Drawing,
    DrawingItem as Item,
    Fill,
    Ink,
    Options,
    OutputError,
    Pen,
    PenSet,
    PlanMethodError,
    Stroke,
    Text,
    arc_curves,
    arc_spans,
    in_use,
    ink_bounds,
    kinematics_sheets,
    lettering_of,
    render,
    stroke_lines,
    sweep,
)
from PIL import Image
from reading import SVG, Page, Path, Run, read_dxf, read_pdf, read_svg, turned_box
from worked import drawn_sheets, problem_of

NEAR = 0.01  # mm
TEXT = Options(dxf_text="text")
FORMATS = tuple(BACKENDS)
VECTOR: dict[str, Callable[[bytes], Page]] = {
    "svg": read_svg,
    "pdf": read_pdf,
    "dxf": read_dxf,
}
SHEETS = {
    "A4": (210.0, 297.0),
    "A3": (420.0, 297.0),
    "A2": (594.0, 420.0),
    "A1": (841.0, 594.0),
    "A0": (1189.0, 841.0),
}
STROKES = [Stroke((3 + 4j, 15.123456 + 7.654321j), pen) for pen in Pen] + [
    Stroke((3 + 4j, 16 + 4j, 9.5 + 12.25j), Pen.MAIN, closed=True),
    Stroke((3 + 4j, 16 + 4j, 9.5 + 12.25j), Pen.HIDDEN, closed=True),
    Stroke((2 + 13j, 17 + 13j, 17 + 2j), Pen.AXIS),
    Stroke((5.0005 + 5.0005j, 5.0005 + 9.0004j), Pen.THIN),
]
ARCS = [
    Arc(10 + 7j, 5.5),
    Arc(10 + 7j, 5.5, pen=Pen.AXIS),
    Arc(10 + 7j, 5.5, pen=Pen.HIDDEN),
    Arc(10 + 7j, 5.5, 0.2, 1.3),
    Arc(10 + 7j, 5.5, 5.5, 7.5, Pen.THIN),
    Arc(10 + 7j, 5.5, 1.0, 1.0 - 0.5),
    Arc(10 + 7j, 5.5, -pi / 2, pi / 2),
    Arc(10 + 7j, 5.5, -2.0, 2.5, Pen.HIDDEN),
    Arc(-250 + 7j, 260.0, -0.02, 0.02),
]
FILLS: list[Fill | Disc] = [
    Fill((4 + 4j, 16 + 6j, 13 + 7j, 12 + 12j)),
    Fill((4 + 4j, 16 + 6j, 12 + 12j), Ink.WHITE),
    Disc(9 + 8j, 4.5, Ink.BLACK),
    Disc(9 + 8j, 1.5),
]
TEXTS = [
    Text(3 + 5j, "Жук", 3.5),
    Text(16 + 3j, "b₂", 2.5, angle=90),
    Text(14 + 12j, "πэ", 3.5, angle=180),
    Text(6 + 5j, "ω₂", 5.0, angle=33.3),
    Text(14 + 5j, "Ёж", 3.5, angle=-215),
    Text(3 + 5j, "Изм.", 3.5, lettering="A"),
    Text(16 + 3j, "ТММ", 2.5, angle=90, lettering="A-upright"),
]
ITEMS: list[Item] = [*STROKES, *ARCS, *FILLS, *TEXTS]


def needs(program: str) -> pytest.MarkDecorator:
    return pytest.mark.skipif(shutil.which(program) is None, reason=f"{program} is not installed")


def run(*command: object) -> str:
    done = subprocess.run(
        [str(word) for word in command], capture_output=True, check=False, timeout=120
    )
    assert done.returncode == 0, done.stderr.decode(errors="replace")
    return done.stdout.decode()


def sheet_of(*items: Item, width: float = 20.0, height: float = 15.0) -> Drawing:
    return Drawing(width, height, title="Проба «А» & <б>", items=list(items))


def sample(width: float = 297.0, height: float = 210.0) -> Drawing:
    """Every primitive with every pen, and letters of every kind, on an A4 sheet."""
    drawing = sheet_of(width=width, height=height)
    drawing.add(Stroke((20 + 5j, 292 + 5j, 292 + 205j, 20 + 205j), Pen.FRAME, closed=True))
    for k, pen in enumerate(Pen):
        y = 190 - 8 * k
        drawing.add(Stroke((30 + y * 1j, 110 + y * 1j, 120 + (y + 5) * 1j), pen))
        drawing.add(Text(124 + y * 1j, f"{pen.value}: линия {k}", 3.5))
        drawing.add(Arc(210 + 60j, 8 + 6 * k, 0.3, 5.0, pen))
    drawing.add(Arc(60 + 60j, 30, pen=Pen.AXIS), Arc(60 + 60j, 20))
    drawing.add(Fill((60 + 60j, 85 + 70j, 80 + 75j, 70 + 90j)), Disc(60 + 60j, 6), Arc(60 + 60j, 6))
    drawing.add(Stroke((110 + 20j, 160 + 20j, 140 + 50j), Pen.HIDDEN, closed=True))
    for angle in range(0, 360, 45):
        at = 250 + 160j + 9 * exp(1j * angle * pi / 180)
        drawing.add(Text(at, "Поворот ω₂", 3.5, angle=angle))
    drawing.add(
        Text(25 + 10j, "Съешь ещё этих мягких французских булок, да выпей чаю. ⊥BC №5", 3.5)
    )
    return drawing


def crowded() -> Drawing:
    """Every letter that the lettering has, more than one 8-bit subset of a font can hold."""
    letters = [chr(code) for code in range(0x21, 0x2300) if not in_use().missing(chr(code))]
    drawing = sheet_of(width=420.0, height=297.0)
    for k in range(0, len(letters), 40):
        drawing.add(Text(complex(10, 280 - 6 * k / 40), "".join(letters[k : k + 40]), 3.5))
    return drawing


# --- coordinates ------------------------------------------------------------------------------


@pytest.mark.parametrize("fmt", VECTOR)
@each("item", STROKES)
def test_stroke_is_where_it_was_put(fmt: str, item: Stroke) -> None:
    (path,) = VECTOR[fmt](render(sheet_of(item), fmt)).items
    assert isinstance(path, Path)
    # In a DXF a line is whole: the program that shows it makes the dashes.
    lines = [item.points] if fmt == "dxf" else stroke_lines(item)
    expected = [point for line in lines for point in line]
    assert len(path.corners) == len(expected)
    assert all(abs(a - b) < NEAR for a, b in zip(path.corners, expected, strict=True))
    assert path.starts == len(lines)
    assert path.closed == (item.closed and len(lines) == 1)
    assert path.width == pytest.approx(PenSet().width(item.pen), abs=0.031)
    assert path.grey == pytest.approx(PENS[item.pen].grey, abs=0.01)


@pytest.mark.parametrize("fmt", VECTOR)
@each("item", ARCS)
def test_arc_is_where_it_was_put(fmt: str, item: Arc) -> None:
    (path,) = VECTOR[fmt](render(sheet_of(item), fmt)).items
    assert isinstance(path, Path)
    spans = [(item.start, sweep(item))] if fmt == "dxf" else arc_spans(item)
    assert path.width == pytest.approx(PenSet().width(item.pen), abs=0.031)
    assert path.closed == (sweep(item) == tau and len(spans) == 1)
    assert path.starts == len(spans)
    assert all(abs(abs(z - item.centre) - item.radius) < NEAR for z in path.along)
    for start, turn in spans:
        # The ends, and the middle: so the arc goes round the right way.
        for angle in (start, start + turn / 2, start + turn):
            place = item.centre + item.radius * exp(1j * angle)
            gap = min(abs(z - place) for z in path.along)
            spacing = item.radius * turn / 16 if angle == start + turn / 2 else 0.0
            assert gap < NEAR + spacing / 2
    ends = [s + t for s, t in spans]
    for z in path.along:
        turned = [(np.angle((z - item.centre) / exp(1j * s))) % tau for s, _ in spans]
        inside = [
            t <= turn + 1e-2 or t >= tau - 1e-2 for t, (_, turn) in zip(turned, spans, strict=True)
        ]
        assert any(inside), (z, ends)


@pytest.mark.parametrize("fmt", VECTOR)
@each("item", FILLS)
def test_filled_area_is_where_it_was_put(fmt: str, item: Fill | Disc) -> None:
    (path,) = VECTOR[fmt](render(sheet_of(item), fmt)).items
    assert isinstance(path, Path)
    assert path.filled
    assert path.closed
    assert path.grey == (1.0 if item.ink is Ink.WHITE else 0.0)
    if isinstance(item, Disc):
        assert len(path.along) > 16
        assert all(abs(abs(z - item.centre) - item.radius) < NEAR for z in path.along)
    else:
        pairs = zip(path.corners, item.points, strict=True)
        assert all(abs(a - b) < NEAR for a, b in pairs)


@pytest.mark.parametrize("fmt", VECTOR)
@each("item", TEXTS)
def test_text_is_where_it_was_put(fmt: str, item: Text) -> None:
    (found,) = VECTOR[fmt](render(sheet_of(item), fmt, options=TEXT)).items
    assert isinstance(found, Run)
    assert abs(found.at - item.at) < NEAR
    assert found.em == pytest.approx(in_use().em(item.height), abs=1e-4)
    assert (found.angle - item.angle + 180) % 360 - 180 == pytest.approx(0.0, abs=1e-3)
    if fmt != "pdf":
        assert found.text == item.text


def expected_bounds(item: Item) -> tuple[float, float, float, float]:
    half = 0.0
    match item:
        case Stroke():
            points = [point for line in stroke_lines(item) for point in line]
            half = PenSet().width(item.pen) / 2
        case Fill():
            points = list(item.points)
        case Disc():
            points = [item.centre + item.radius * 1j**k for k in range(4)]
        case Arc():
            points = [
                item.centre + item.radius * exp(1j * (s + t * k / 4000))
                for s, t in arc_spans(item)
                for k in range(4001)
            ]
            half = PenSet().width(item.pen) / 2
        case Text():
            own = lettering_of(item.lettering, in_use())
            return turned_box(item.at, item.angle, own.ink(item.text, item.height))
    xs, ys = [z.real for z in points], [z.imag for z in points]
    return (min(xs) - half, min(ys) - half, max(xs) + half, max(ys) + half)


# Square-cut ends do not reach half a width beyond the line: those pens are left out. A run's ink
# has the bounds of a box only if the run is turned by quarters.
ROUND = [
    item
    for item in ITEMS
    if not (isinstance(item, Stroke | Arc) and PENS[item.pen].cap == "butt")
    and not (isinstance(item, Text) and item.angle % 90)
    and not (isinstance(item, Fill | Disc) and item.ink is Ink.WHITE)
]


@each("item", ROUND)
def test_pixels_are_where_they_were_put(item: Item) -> None:
    per_mm = 100
    data = render(sheet_of(item), "png", options=Options(dpi=25.4 * per_mm))
    pixels = read_png(data)
    # A grey pen at half its own darkness, a black one at half of black: the true edge.
    grey = PENS[item.pen].grey if isinstance(item, Stroke | Arc) else 0.0
    rows, columns = np.nonzero(pixels < (1 + grey) / 2)
    height = pixels.shape[0]
    found = (
        columns.min() / per_mm,
        (height - 1 - rows.max()) / per_mm,
        (columns.max() + 1) / per_mm,
        (height - rows.min()) / per_mm,
    )
    # A pixel for the raster beside the 0.01 mm.
    assert found == pytest.approx(expected_bounds(item), abs=NEAR + 1 / per_mm)


def read_png(data: bytes | FilePath) -> Any:
    """Return the grey levels of a picture, 0 black to 1 white, ndarray of shape (rows, columns)."""
    with Image.open(BytesIO(data) if isinstance(data, bytes) else data) as picture:
        pixels = np.asarray(picture if picture.mode == "L" else picture.convert("RGB"))
    # Bytes as long as it can be: of a sheet at ten pixels to the millimetre all is 37 MB.
    return np.divide(pixels if pixels.ndim == 2 else pixels.mean(axis=2, dtype=np.float32),
                     255, dtype=np.float32)  # fmt: skip


@pytest.mark.parametrize("fmt", ["svg", "pdf"])
def test_a_run_of_another_lettering_is_narrower(fmt: str) -> None:
    usual, other = (Text(3 + 5j, "Изменение", 2.5, lettering=name) for name in ("", "A"))
    files = [render(sheet_of(item), fmt, options=TEXT) for item in (usual, other)]
    assert files[0] != files[1]
    width = [lettering_of(one.lettering, in_use()).width(one.text, 2.5) for one in (usual, other)]
    assert width[1] < 0.85 * width[0]
    left, _, right, _ = ink_bounds([other])
    assert right - left < width[1] + 0.5


@pytest.mark.parametrize("radius", [0.5, 5.0, 150.0, 2000.0])
@pytest.mark.parametrize("turn", [0.01, 1.0, tau])
def test_curves_stay_on_the_circle(radius: float, turn: float) -> None:
    curves = arc_curves(3 - 4j, radius, 0.7, turn)
    for p, a, b, q in curves:
        for t in (0.0, 0.2, 0.5, 0.8, 1.0):
            z = p * (1 - t) ** 3 + 3 * a * t * (1 - t) ** 2 + 3 * b * t**2 * (1 - t) + q * t**3
            assert abs(abs(z - (3 - 4j)) - radius) < 1.2e-3
    assert abs(curves[-1][3] - (3 - 4j + radius * exp(1j * (0.7 + turn)))) < 1e-9


# --- the whole file ---------------------------------------------------------------------------


@pytest.mark.parametrize("name", SHEETS)
@pytest.mark.parametrize("turned", [False, True])
def test_page_size_is_exact(name: str, turned: bool) -> None:
    width, height = SHEETS[name][::-1] if turned else SHEETS[name]
    drawing = sheet_of(width=width, height=height)
    for fmt, read in VECTOR.items():
        page = read(render(drawing, fmt))
        assert (page.width, page.height) == pytest.approx((width, height), abs=1e-3), fmt
    data = render(drawing, "svg")
    assert f'width="{width:g}mm"'.encode() in data
    assert f'viewBox="0 0 {width:g} {height:g}"'.encode() in data


@pytest.mark.parametrize("dpi", [50.0, 100.0, 150.0])
def test_raster_has_the_pixels_of_its_resolution(dpi: float) -> None:
    pixels = read_png(render(sample(), "png", options=Options(dpi=dpi)))
    assert pixels.shape == (round(210 / 25.4 * dpi), round(297 / 25.4 * dpi))


@pytest.mark.parametrize("fmt", FORMATS)
def test_order_of_drawing_is_kept(fmt: str) -> None:
    black, white = Disc(10 + 7j, 5.0, Ink.BLACK), Disc(10 + 7j, 2.0)
    line = Stroke((1 + 7j, 19 + 7j), Pen.MAIN)
    text = Text(8 + 5j, "Ж", 3.5)
    for items in ((line, black, white, text), (text, white, line, black)):
        data = render(sheet_of(*items), fmt, options=TEXT)
        if fmt == "png":
            pixels = read_png(render(sheet_of(*items), fmt, options=Options(dpi=254)))
            assert (pixels[62, 100] > 0.9) == (items[0] is line)
            continue
        painted = VECTOR[fmt](data).items
        kinds = ["run" if isinstance(one, Run) else (one.filled, one.grey) for one in painted]
        expected = {line: (False, 0.0), black: (True, 0.0), white: (True, 1.0), text: "run"}
        assert kinds == [expected[one] for one in items]


@pytest.mark.parametrize("fmt", FORMATS)
def test_items_without_extent_do_no_harm(fmt: str) -> None:
    items: list[Item] = [
        Stroke(()),
        Stroke((), closed=True),
        Fill(()),
        Stroke((1 + 1j,)),
        Stroke((1 + 1j, 1 + 1j), Pen.AXIS),
        Fill((1 + 1j,)),
        Arc(1 + 1j, 0.0),
        Arc(1 + 1j, 2.0, 1.0, 1.0),
        Disc(1 + 1j, 0.0),
        Text(1 + 1j, "", 3.5),
        Text(1 + 1j, "   ", 3.5),
    ]
    data = render(sheet_of(*items), fmt)
    assert fmt == "png" or not VECTOR[fmt](data).items


@pytest.mark.parametrize("fmt", FORMATS)
@pytest.mark.parametrize(
    "text", ["漢 \U0001f600", "a\x00b\x07\n\t\x1b", "<&>\"']]>", "\\(x) (", "\ufffe"]
)
def test_any_text_can_be_drawn(fmt: str, text: str) -> None:
    drawing = Drawing(50.0, 20.0, title=text, items=[Text(2 + 2j, text, 3.5, tag=text)])
    data = render(drawing, fmt, options=TEXT)
    if fmt in VECTOR:
        assert len(VECTOR[fmt](data).items) == 1


@pytest.mark.parametrize("fmt", FORMATS)
@pytest.mark.parametrize(
    "item",
    [
        Stroke((1 + 1j, complex(nan, 1))),
        Fill((1 + 1j, complex(1, inf), 2 + 2j)),
        Arc(1 + 1j, nan),
        Arc(1 + 1j, 1.0, 0.0, nan),
        Disc(complex(nan, nan), 1.0),
        Text(1 + 1j, "x", 3.5, angle=nan),
    ],
    ids=repr,
)
def test_a_point_that_does_not_exist_is_rejected(fmt: str, item: Item) -> None:
    with pytest.raises(PlanMethodError, match=r"Item 1 of the drawing .* not finite"):
        render(sheet_of(Stroke((1 + 1j, 2 + 2j)), item), fmt)


def test_unknown_format_is_named() -> None:
    with pytest.raises(OutputError, match=r"Unknown format 'bmp'\. Use one of: svg, pdf, png"):
        render(sheet_of(), "bmp")


@pytest.mark.parametrize("dpi", [0.0, 100_000.0])
def test_impossible_resolution_is_named(dpi: float) -> None:
    with pytest.raises(OutputError, match="pixels; 1 to 16384 a side"):
        render(sample(), "png", options=Options(dpi=dpi))


PROGRAM = """
import hashlib, pickle, sys
from planmethod.render.backends import BACKENDS, render
drawing = pickle.loads(sys.stdin.buffer.read())
for fmt in BACKENDS:
    print(hashlib.sha256(render(drawing, fmt)).hexdigest())
"""


def test_bytes_are_the_same_in_every_process() -> None:
    digests = [hashlib.sha256(render(sample(), fmt)).hexdigest() for fmt in FORMATS]
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        input=pickle.dumps(sample()),
        env={**os.environ, "PYTHONHASHSEED": "1", "TZ": "UTC1"},
        capture_output=True,
        check=True,
        timeout=120,
    )
    assert done.stdout.decode().split() == digests


@pytest.mark.parametrize(
    ("fmt", "absent"),
    [
        ("svg", {"matplotlib", "reportlab", "numpy", "PIL"}),
        ("pdf", {"matplotlib", "svgwrite", "numpy"}),
        ("png", {"reportlab", "svgwrite", "matplotlib.pyplot"}),
        ("dxf", {"reportlab", "svgwrite", "matplotlib"}),
    ],
)
def test_a_format_imports_only_modules_that_it_uses(fmt: str, absent: set[str]) -> None:
    code = (
        "import sys\n"
        "from planmethod.render.backends import render\n"
        "from planmethod.render.ink.drawing import Arc, Drawing, Text\n"
        f"render(Drawing(210, 297, items=[Text(9 + 9j, 'Ж', 5), Arc(0j, 9)]), {fmt!r})\n"
        "print(*sys.modules)"
    )
    loaded = set(run(sys.executable, "-c", code).split())
    never = {"mpmath", "shapely"} | ({"fontTools"} if fmt in {"svg", "pdf"} else set())
    never |= {"ezdxf"} if fmt != "dxf" else set()
    assert not loaded & (absent | never)


# --- SVG --------------------------------------------------------------------------------------


def test_svg_needs_no_font_and_no_style_sheet() -> None:
    data = render(sample(), "svg").decode("utf-8")
    root = ET.fromstring(data)
    tags = {element.tag.partition("}")[2] for element in root.iter()}
    seen = {"svg", "title", "defs", "rect", "g", "path", "circle", "use"}
    assert tags == seen | {"text"}
    # Text is white, and comes before all items drawn on the white paper.
    (_, _, paper, words, _) = root
    assert paper.attrib["fill"] == words.attrib["fill"] == "#ffffff"
    assert len([*words.iter(f"{SVG}text")]) == len([*root.iter(f"{SVG}text")])
    data = re.sub(r'(id|xlink:href)="[^"]*"', "", data)
    assert not re.search(r"\bstyle=|\shref=|dasharray|[0-9]e-?[0-9]|\d\.\d{10}|nan|inf\b", data)


def test_svg_holds_each_letter_once_and_each_run_that_recurs() -> None:
    twice = [Text(1 + k * 1j, "аба 漢字", 3.5, tag="имя") for k in (1, 4)]
    root = ET.fromstring(render(sheet_of(*twice, Text(1 + 8j, "ба", 3.5)), "svg"))
    defs = root.find(f"{SVG}defs")
    assert defs is not None
    assert [part.attrib["id"] for part in defs[:3]] == ["none", "u430", "u431"]
    assert [len(run) for run in defs[3:]] == [5]
    drawn = root.findall(f"{SVG}g")[1]
    assert [part.tag.removeprefix(SVG) for part in drawn[0]] == ["use", "use", "g"]
    assert [len(part) for part in drawn[0]] == [0, 0, 2]
    assert [word.text for word in root.iter(f"{SVG}text")] == ["аба 漢字"] * 2 + ["ба"]
    assert "Проба «А» & <б>" in "".join(root.itertext())
    assert [g.attrib["data-tag"] for g in root.iter() if "data-tag" in g.attrib] == ["имя"] * 2


def test_svg_knows_a_run_again_however_its_height_and_turn_were_computed() -> None:
    ways = [(5.0, 0.0), (5, 0), (5.000000000000001, -0.0), (4.999999999999999, 0.0)]
    plain, odd = (
        [Text(complex(2, 3 * k), "vB", height, angle) for k, (height, angle) in enumerate(asked)]
        for asked in (ways[:1] * 4, ways)
    )
    assert render(sheet_of(*odd), "svg") == render(sheet_of(*plain), "svg")


def test_svg_letters_have_the_advance_of_the_lettering() -> None:
    text = Text(1 + 1j, "План ab", 3.5)
    root = ET.fromstring(render(sheet_of(text), "svg"))
    unit = text.height / in_use().cap_height
    letters = root.findall(f"{SVG}g/{SVG}g/{SVG}g/{SVG}use")
    places = [float(use.attrib.get("x", 0)) * unit for use in letters]
    starts = [k for k, char in enumerate(text.text) if char != " "]
    assert places == pytest.approx([in_use().width(text.text[:k], 3.5) for k in starts])


@needs("chromium")
def test_svg_text_is_found_and_copied_where_it_is_seen(tmp_path: FilePath) -> None:
    """Inscriptions of several runs are one text; under the mouse is text, not a letter's stroke."""
    (drawing,) = drawn_sheets("linkages/ex3")
    data = render(drawing, "svg")
    assert len(data) <= 155_000
    file = tmp_path / "ex3.svg"
    file.write_bytes(data)
    item = next(item for item in drawing.items if isinstance(item, Text) and item.text == "Дата")
    _, low, right, high = in_use().ink(item.text, item.height)
    middle = item.at + complex(right, high + low) / 2
    x, y = middle.real / drawing.width, 1.0 - middle.imag / drawing.height
    with browsing(tmp_path / "profile") as page:
        page.open(file, width=2300, height=1700)
        found = "ω3 = ω2", "(pb1) = 64,0 мм", "Кафедра ТММ", "vE = vEE0 = μv·(pe)"
        for words in found:
            assert page.ask(f"find({words!r}, true, false, true)"), words
            assert page.ask("getSelection().toString()") == words
        assert not page.ask("find('План сил', true, false, true)")
        seen = (
            "(() => { const r = document.documentElement.getBoundingClientRect();"
            f"return document.elementFromPoint(r.width * {x}, r.height * {y}).textContent; }})()"
        )
        assert page.ask(seen) == "Дата"


@pytest.mark.dear
@needs("rsvg-convert")
@needs("chromium")
def test_svg_is_the_same_picture_in_two_viewers(tmp_path: FilePath) -> None:
    """Chromium against librsvg at 192 dpi: only the smoothing of edges may differ.

    Measured: 0.30 % of the pixels differ by more than a tenth of the way from black to white,
    0.005 % by more than a quarter, none by half; after a move of the whole picture by one pixel
    it is 2.8, 2.1 and 1.4 %.
    The sheet is a whole number of pixels; else Chromium shrinks the picture to the pixel grid.
    """
    file = tmp_path / "sample.svg"
    file.write_bytes(render(sample(317.5, 222.25), "svg"))
    run("rsvg-convert", "-d", 192, "-p", 192, file, "-o", tmp_path / "rsvg.png")
    run(
        "chromium",
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--hide-scrollbars",
        "--force-device-scale-factor=2",
        "--window-size=1200,840",
        f"--user-data-dir={tmp_path / 'profile'}",
        f"--screenshot={tmp_path / 'chromium.png'}",
        file.as_uri(),
    )
    one, two = read_png(tmp_path / "rsvg.png"), read_png(tmp_path / "chromium.png")
    assert one.shape == two.shape == (1680, 2400)
    difference = np.abs(one - two)
    moved = np.abs(one[1:, 1:] - one[:-1, :-1])
    for level in (0.1, 0.25, 0.5):
        print(f"> {level}: {(difference > level).mean():.4%}, moved {(moved > level).mean():.4%}")
    assert (difference > 0.25).mean() < 0.0005
    assert (difference > 0.5).mean() < 0.00002


@pytest.mark.dear
@needs("rsvg-convert")
@needs("chromium")
@needs("pdftocairo")
def test_a_worked_sheet_is_the_same_picture_in_svg_and_in_pdf(tmp_path: FilePath) -> None:
    """Ten pixels to the millimetre, so that the sheet is whole pixels in all of them.

    Pixels that differ by more than a quarter of the range from black to white, as a share of the
    pixels with ink in either picture: 8.8 to 9.2 % between the PDF and a viewer of the SVG on four
    worked sheets (edges of letters, which the PDF has as a font), none between the two viewers.
    The share is of the ink, not of the sheet, so that it does not depend on how full the sheet is.
    """
    (drawing,) = kinematics_sheets(problem_of("linkages/ex1"), sigma=False)
    dpi, width, height = 254, 4200, 2970
    svg, pdf = tmp_path / "a.svg", tmp_path / "a.pdf"
    svg.write_bytes(render(drawing, "svg"))
    pdf.write_bytes(render(drawing, "pdf"))
    run("rsvg-convert", "-d", dpi, "-p", dpi, svg, "-o", tmp_path / "rsvg.png")
    run("pdftocairo", "-r", dpi, "-png", "-singlefile", pdf, tmp_path / "pdf")
    run(
        "chromium",
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--hide-scrollbars",
        f"--force-device-scale-factor={dpi / 96}",
        f"--window-size={96 * (width + 10) // dpi},{96 * (height + 10) // dpi}",
        f"--user-data-dir={tmp_path / 'profile'}",
        f"--screenshot={tmp_path / 'chromium.png'}",
        svg.as_uri(),
    )
    pictures = {}  # in bytes: as numbers all three are a quarter of a gigabyte
    for name in ("rsvg", "chromium", "pdf"):
        with Image.open(tmp_path / f"{name}.png") as picture:
            pictures[name] = np.asarray(picture.convert("L"))[:height, :width]
    for one, two, limit in (
        ("rsvg", "pdf", 0.095),
        ("chromium", "pdf", 0.095),
        ("rsvg", "chromium", 0.0095),
    ):
        ink = (np.minimum(pictures[one], pictures[two]) < 0.75 * 255).sum()
        apart = np.abs(np.subtract(pictures[one], pictures[two], dtype=np.int16))
        share = (apart > 0.25 * 255).sum() / ink
        print(f"{one}, {two}: {share:.4%}")
        assert share < limit


@needs("rsvg-convert")
@needs("pdftoppm")
def test_all_formats_show_the_same_picture(tmp_path: FilePath) -> None:
    dpi = 150
    (tmp_path / "a.svg").write_bytes(render(sample(), "svg"))
    (tmp_path / "a.pdf").write_bytes(render(sample(), "pdf"))
    run("rsvg-convert", "-d", dpi, "-p", dpi, tmp_path / "a.svg", "-o", tmp_path / "svg.png")
    run("pdftoppm", "-r", dpi, "-png", "-singlefile", tmp_path / "a.pdf", tmp_path / "pdf")
    pictures = [
        read_png(tmp_path / "svg.png"),
        read_png(tmp_path / "pdf.png"),
        read_png(render(sample(), "png", options=Options(dpi=dpi))),
    ]
    rows, columns = (min(sizes) - 2 for sizes in zip(*(p.shape for p in pictures), strict=True))
    # Blocks of 1 mm: every picture has the same ink in the same place.
    size = 6
    rows, columns = rows // size * size, columns // size * size
    ink = [
        1 - p[:rows, :columns].reshape(rows // size, size, columns // size, size).mean(axis=(1, 3))
        for p in pictures
    ]
    for other in ink[1:]:
        print(
            f"largest {np.abs(other - ink[0]).max():.3f}, mean {np.abs(other - ink[0]).mean():.5f}"
        )
        assert np.abs(other - ink[0]).mean() < 0.005
        assert np.abs(other - ink[0]).max() < 0.35


# --- PDF --------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def pdf_file(tmp_path_factory: pytest.TempPathFactory) -> FilePath:
    path = tmp_path_factory.mktemp("pdf") / "sample.pdf"
    path.write_bytes(render(sample(), "pdf", options=Options(author="Иванов И. И.")))
    return path


@needs("pdffonts")
@pytest.mark.parametrize("drawing", [sample(), crowded(), sheet_of()], ids=["A4", "all", "blank"])
def test_pdf_fonts_are_embedded_subsets(drawing: Drawing, tmp_path: FilePath) -> None:
    path = tmp_path / "a.pdf"
    path.write_bytes(render(drawing, "pdf"))
    fonts = run("pdffonts", path).splitlines()[2:]
    assert bool(fonts) == bool(drawing.items)
    for line in fonts:
        assert re.match(r"[A-Z]{6}\+PlanmethodGOST-B-Slanted\b", line), line
        assert re.search(r"\byes\s+yes\s+yes\b", line), line


@needs("pdftotext")
def test_pdf_text_is_found(pdf_file: FilePath, tmp_path: FilePath) -> None:
    text = run("pdftotext", "-raw", pdf_file, "-")
    assert "Съешь ещё этих мягких французских булок, да выпей чаю. ⊥BC №5" in text
    assert f"hidden: линия {list(Pen).index(Pen.HIDDEN)}" in text
    assert "Поворот ω₂" in text
    path = tmp_path / "a.pdf"
    path.write_bytes(render(crowded(), "pdf"))
    found = set(run("pdftotext", "-raw", path, "-"))
    wanted = {char for item in crowded().items if isinstance(item, Text) for char in item.text}
    # A soft hyphen and the like is dropped by the program that extracts, not by the file.
    assert {char for char in wanted - found if char.isalpha()} == set()


@needs("pdftotext")
def test_pdf_words_have_the_width_of_the_lettering(tmp_path: FilePath) -> None:
    path = tmp_path / "a.pdf"
    word = "Кинематический-анализ-механизма"
    path.write_bytes(render(sheet_of(Text(20 + 50j, word, 5.0), width=297, height=210), "pdf"))
    box = run("pdftotext", "-bbox", path, "-")
    found = re.search(r'xMin="([\d.]+)" .* xMax="([\d.]+)"', box)
    assert found
    left, right = (float(number) / 72 * 25.4 for number in found.groups())
    assert left == pytest.approx(20.0, abs=NEAR)
    # Advances in a PDF are whole thousandths of the em: half of one a letter may be lost.
    loss = len(word) * in_use().em(5.0) / 2000
    assert right - left == pytest.approx(in_use().width(word, 5.0), abs=loss)


@needs("pdfinfo")
def test_pdf_has_its_metadata(pdf_file: FilePath) -> None:
    info = run("pdfinfo", pdf_file)
    assert re.search(r"Title:\s+Проба «А» & <б>\n", info)
    assert re.search(r"Author:\s+Иванов И\. И\.\n", info)
    assert re.search(r"Pages:\s+1\n", info)
    assert re.search(r"Page size:\s+841\.89 x 595\.276 pts \(A4\)", info)


def test_pdf_is_compressed_and_small(pdf_file: FilePath) -> None:
    assert pdf_file.stat().st_size < 40_000
