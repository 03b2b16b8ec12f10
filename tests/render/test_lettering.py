"""The lettering: the proportions of GOST 2.304, no letter lost, data and font of one mould."""

from __future__ import annotations

import json
from functools import cache
from itertools import pairwise
from math import radians, tan
from pathlib import Path
from typing import Any

import pytest
from cases import thinned
from doors import (
    FONTS,
    PROPORTIONS_TYPES as TYPES,
    STYLES,
    LayoutError,
    in_use,
    lettering,
    line_step,
    typeset,
    using,
)
from shapely import LineString, MultiPolygon, Polygon, union_all

from scripts.skeleton import letters, parsed, skeleton

RUSSIAN = "".join(map(chr, range(0x410, 0x450))) + "Ёё"
NEEDED = (
    RUSSIAN
    + "".join(map(chr, range(0x20, 0x7F)))
    + "αβγδεζηθικλμνξοπρστυφχψωΑΒΓΔΕΖΗΘΙΚΛΜΝΞΟΠΡΣΤΥΦΧΨΩ"
    + "«»„“”–—…№°±×·÷²³′″‴⁰¹⁴⁵⁶⁷⁸⁹ⁿ⁺⁻₀₁₂₃₄₅₆₇₈₉₊₋"
    + "←↑→↓↔↺↻⇒⊥∥∠∞√∑∫≈≠≤≥−∓∈∅△○●□■ⅠⅡⅢⅣⅤ½⅓\u0304\u0305"
)
UPRIGHT_CAPITALS = "БВГЕЖИКЛМНПРТХШЫЬЯDEFHIKLNRTXZ147"

each_style = pytest.mark.parametrize("style", STYLES)
each_kind = pytest.mark.parametrize("kind", TYPES)


def test_is_a_lettering() -> None:
    used = in_use()
    assert used.name == "PlanmethodGOST-B-Slanted"


def test_another_lettering_is_used_for_a_while() -> None:
    before = typeset("План", 5.0)
    with using(lettering("A-upright")) as other:
        assert in_use() is other
        assert typeset("План", 5.0).width < before.width
        assert line_step(7.0) == pytest.approx(11.0)
    assert typeset("План", 5.0) is before
    assert line_step(5.0) == pytest.approx(8.5)


@pytest.mark.parametrize(
    ("name", "found"), [("B", "B"), ("Б", "B"), (" А ", "A"), ("Б-upright", "B-upright")]
)
def test_letterings_by_name(name: str, found: str) -> None:
    assert lettering(name).style == STYLES[found]


def test_unknown_lettering() -> None:
    with pytest.raises(LayoutError, match=r"Unknown lettering 'C'.*B, B-upright, A, A-upright"):
        lettering("C")


@each_style
def test_needed_letters_are_there(style: str) -> None:
    assert lettering(style).missing(NEEDED) == set()


def test_missing_letters_are_named_and_drawn_as_a_box() -> None:
    assert in_use().missing("Жёлтый 漢字 \U0001f600 v") == {"漢", "字", "\U0001f600"}
    box = in_use().glyph("漢")
    assert box == in_use().glyph("字")
    assert box.advance > 0
    assert box.strokes
    assert in_use().width("漢", 5.0) > 0.0


# Proportions of GOST 2.304, measured on the ink ---------------------------------------------------


@each_style
@pytest.mark.parametrize("h", [1.8, 2.5, 3.5, 5.0, 7.0, 10.0, 14.0, 40.0])
def test_height_is_the_height_of_capitals(style: str, h: float) -> None:
    for capital in UPRIGHT_CAPITALS:
        _, low, _, high = lettering(style).ink(capital, h)
        assert (low, high) == pytest.approx((0.0, h), abs=2e-3 * h), capital


@each_style
def test_height_of_small_letters(style: str) -> None:
    c = {"A": 10 / 14, "B": 7 / 10}[style[0]]
    for small in "агежзиклмнопстхчшыьэюяacemnorsuvwxzαινοω":
        _, low, _, high = lettering(style).ink(small, 1.0)
        assert (low, high) == pytest.approx((0.0, c), abs=2e-3), small


@pytest.mark.parametrize(("kind", "d"), [("A", 1 / 14), ("B", 1 / 10)])
def test_line_thickness(kind: str, d: float) -> None:
    """Measured on vertical strokes and on horizontal ones."""
    upright = lettering(f"{kind}-upright")
    left, _, right, _ = upright.ink("I", 1.0)
    assert right - left == pytest.approx(d, abs=1e-3)
    _, low, _, high = upright.ink("−", 1.0)
    assert high - low == pytest.approx(d, abs=1e-3)
    assert upright.line == pytest.approx(d)


@pytest.mark.parametrize(
    ("kind", "gap", "word", "step"),
    [("A", 2 / 14, 6 / 14, 22 / 14), ("B", 2 / 10, 6 / 10, 17 / 10)],
)
def test_gaps(kind: str, gap: float, word: float, step: float) -> None:
    """Between the ink of letters, of words, and between base lines."""
    upright = lettering(f"{kind}-upright")
    alone = upright.ink("Н", 1.0)
    wide = alone[2] - alone[0]
    pair, words = upright.ink("НН", 1.0), upright.ink("Н Н", 1.0)
    assert pair[2] - pair[0] - 2 * wide == pytest.approx(gap, abs=1e-3)
    assert words[2] - words[0] - 2 * wide == pytest.approx(word, abs=1e-3)
    with using(upright):
        assert line_step(1.0) == pytest.approx(step)


@each_kind
def test_gap_is_halved_where_strokes_are_not_parallel(kind: str) -> None:
    upright = lettering(f"{kind}-upright")
    gap = 2 * upright.line
    for pair in ("ГА", "АТ", "РА", "ТА"):
        one, two, both = (upright.ink(text, 1.0) for text in (pair[0], pair[1], pair))
        white = both[2] - both[0] - (one[2] - one[0]) - (two[2] - two[0])
        assert white == pytest.approx(gap / 2, abs=1e-3), pair
    for pair in ("НН", "ПИ", "ОН", "11", "14", "71", "НА"):
        apart = sum(upright.width(char, 1.0) for char in pair)
        assert upright.width(pair, 1.0) == pytest.approx(apart), pair


@each_kind
def test_slant_is_75_degrees(kind: str) -> None:
    (line,) = lettering(kind).strokes("I")
    way = line[-1] - line[0]
    # To the whole font unit.
    off = abs(way.real) - abs(way.imag) * tan(radians(15.0))
    assert abs(off) * lettering(kind).cap_height < 1.0
    assert lettering(kind).width("Жук", 5.0) == lettering(f"{kind}-upright").width("Жук", 5.0)


@pytest.mark.parametrize(
    ("chars", "b"),
    [
        ("ГЕЗСCEFL0235679", 5),
        ("БВИКНОПРТУЧЬЭЯDHNPRTUZ", 6),
        ("АДМХAMXYV", 7),
        ("ЖФШЪ", 8),
        ("еонпхвдклчянhknoxz", 5),
        ("I|", 1),
    ],
)
def test_widths_of_letters(chars: str, b: int) -> None:
    """Widths g in line thicknesses; a letter of type A is one thickness wider."""
    for char in chars:
        upright = lettering("B-upright")
        left, _, right, _ = upright.ink(char, 1.0)
        assert (right - left) / upright.line == pytest.approx(b, abs=0.25), char
        if b > 4:
            upright = lettering("A-upright")
            left, _, right, _ = upright.ink(char, 1.0)
            assert (right - left) / upright.line == pytest.approx(b + 1, abs=0.3), char


# Outlines, skeletons, runs ------------------------------------------------------------------------


def test_measures_of_a_run() -> None:
    used = in_use()
    assert used.width("", 5.0) == used.ascent("", 5.0) == used.descent(" ", 5.0) == 0
    assert used.width(" ", 5.0) > 0.0
    parts = used.width("План ", 5.0) + used.width("скоростей", 5.0)
    assert used.width("План скоростей", 5.0) == pytest.approx(parts)
    assert used.width("План", 7.0) == pytest.approx(1.4 * used.width("План", 5.0))
    assert used.ascent("асе", 5.0) < used.ascent("Ас", 5.0) < used.ascent("Й", 5.0)
    assert used.descent("ру", 5.0) > used.descent("щ", 5.0) > 0.5
    assert used.ascent("_", 5.0) == 0.0
    assert used.descent("″", 5.0) == 0.0
    assert used.width("v\u0305", 5.0) == used.width("v", 5.0)
    assert used.ascent("v\u0305", 5.0) > used.ascent("v", 5.0) + 0.5


def test_pieces_of_a_run_have_no_closer_pairs_inside() -> None:
    used = in_use()
    pieces = used.pieces("ГАТТ 11")
    assert "".join(piece for _, piece in pieces) == "ГАТТ 11"
    assert [piece for _, piece in pieces] == ["Г", "А", "ТТ 11"]
    placed = dict(enumerate(pen for _, pen in used.places("ГАТТ 11")))
    assert [start for start, _ in pieces] == [placed[0], placed[1], placed[2]]
    assert not used.pieces("")


@cache
def font(style: str) -> Any:
    return pytest.importorskip("fontTools.ttLib").TTFont(lettering(style).font_file)


def area(style: str, char: str) -> MultiPolygon | Polygon:
    """Return the filled outline of a letter of the font, in parts of h."""
    glyf = font(style)["glyf"]
    points, ends, _ = glyf[font(style).getBestCmap()[ord(char)]].getCoordinates(glyf)
    unit = lettering(style).cap_height
    # Contours lie inside one another or apart, so that every second one is white.
    whole: MultiPolygon | Polygon = Polygon()
    for start, end in pairwise([-1, *ends]):
        ring = Polygon([(x / unit, y / unit) for x, y in points[start + 1 : end + 1]])
        whole = whole.symmetric_difference(ring)
    return whole


@each_style
def test_outlines_are_the_envelopes_of_the_pen(style: str) -> None:
    used = lettering(style)
    for char in NEEDED:
        strokes = used.strokes(char)
        if not strokes:
            assert char in " \u00a0"
            continue
        pen = union_all([LineString([(p.real, p.imag) for p in s]) for s in strokes]).buffer(
            used.line / 2
        )
        wrong = pen.symmetric_difference(area(style, char)).area
        assert wrong < 0.02 * pen.area, char


@each_style
def test_letters_keep_inside_their_boxes(style: str) -> None:
    """A letter leaves its box only by its slope, so that no letter runs into the next one."""
    used = lettering(style)
    for char in letters():
        glyph = used.glyph(char)
        if glyph.advance:
            over = used.cap_height * (used.style.lean * 0.75 + 0.01)
            assert glyph.xmin >= -over, char
            assert glyph.xmax <= glyph.advance + over, char


def test_letters_of_one_shape_and_indices() -> None:
    for one, two in ("AА", "pр", "uи", "ΡР", "µμ"):
        assert skeleton(one, "B") == skeleton(two, "B")
    raised, whole = skeleton("²", "B").strokes, skeleton("2", "B").strokes
    tall = [
        max(p.imag for s in x for p in s) - min(p.imag for s in x for p in s)
        for x in (raised, whole)
    ]
    assert tall[0] == pytest.approx(0.6 * tall[1])


def test_a_corner_is_rounded_by_an_arc() -> None:
    (line,) = parsed("0,0 4,0~2 4,6")
    bend = [point for point in line if point.real > 2.0 and point.imag < 2.0]
    assert len(bend) > 8
    assert all(abs(abs(point - (2 + 2j)) - 2.0) < 1e-9 for point in bend)


def test_a_shape_that_cannot_be_read() -> None:
    with pytest.raises(ValueError, match=r"'4;0' in the shape '0,0 4;0' is no point"):
        parsed("0,0 4;0")


# Files --------------------------------------------------------------------------------------------


@each_style
def test_font_and_data_agree(style: str) -> None:
    used, made = lettering(style), font(style)
    cmap = made.getBestCmap()
    data = json.loads((FONTS / f"{used.name}.json").read_text(encoding="ascii"))
    assert {int(code, 16) for code in data["glyphs"] if code} == set(cmap)
    assert set(map(chr, cmap)) == set(letters())
    assert made["head"].unitsPerEm == used.units_per_em
    assert made["OS/2"].sCapHeight == used.cap_height
    head = made["hhea"]
    step = head.ascent - head.descent + head.lineGap
    assert step / used.cap_height == pytest.approx(used.line_step)
    assert made["post"].italicAngle == (-15.0 if used.style.slanted else 0.0)
    for code, name in cmap.items():
        glyph = used.glyph(chr(code))
        assert made["hmtx"][name][0] == glyph.advance, name
        if glyph.strokes:
            box = made["glyf"][name]
            assert (box.xMin, box.yMin, box.xMax, box.yMax) == glyph[1:5], name


def test_fonts_have_the_names_of_the_package() -> None:
    ttlib = pytest.importorskip("fontTools.ttLib")
    families = set()
    for style in STYLES.values():
        names = ttlib.TTFont(FONTS / f"{style.name}.ttf")["name"]
        assert names.getDebugName(6) == style.name
        assert "planmethod" in names.getDebugName(0)
        families.add((names.getDebugName(1), names.getDebugName(2)))
    assert families == {
        (f"Planmethod GOST {kind}", slope) for kind in "AB" for slope in ("Regular", "Italic")
    }


def test_script_makes_the_same_files_again(tmp_path: Path) -> None:
    pytest.importorskip("fontTools.fontBuilder")
    from scripts import make_font

    styles = thinned(list(STYLES.values()), 6)
    for folder in (tmp_path / "one", tmp_path / "two"):
        folder.mkdir()
        for style in styles[: None if folder.name == "one" else 1]:
            make_font.make(style, folder)
    made = sorted((tmp_path / "one").glob("*.json"))
    assert len(made) == len(styles)
    for path in made:
        # The bytes of the font may change with fontTools; the drawn shapes may not.
        assert path.read_bytes() == (FONTS / path.name).read_bytes(), path.name
    again = sorted((tmp_path / "two").iterdir())
    assert len(again) >= 2
    for path in again:
        assert path.read_bytes() == (tmp_path / "one" / path.name).read_bytes(), path.name
