"""The lettering: heights in millimetres, no letter lost, data and font of one mould."""

from __future__ import annotations

import importlib.util
import json
import re
from pathlib import Path

import pytest

from planmethod.render.lettering import FONTS, Lettering, in_use, missing

RUSSIAN = "".join(map(chr, range(0x410, 0x450))) + "Ёё"
NEEDED = (
    RUSSIAN
    + "".join(map(chr, range(0x20, 0x7F)))
    + "αβγδεζηθικλμνξοπρστυφχψωΑΒΓΔΕΖΗΘΙΚΛΜΝΞΟΠΡΣΤΥΦΧΨΩ"
    + "«»„“”–—…№°±×·÷²³′″‴⁰¹⁴⁵⁶⁷⁸⁹ⁿ⁺⁻₀₁₂₃₄₅₆₇₈₉₊₋"
    + "←↑→↓↔↺↻⇒⊥∥∠∞√∑∫≈≠≤≥−∓∈△○●□■ⅠⅡⅢⅣⅤ½⅓\u0304\u0305"
)


def test_is_a_lettering() -> None:
    lettering: Lettering = in_use()
    assert lettering.name == "PlanmethodSans"


def test_needed_letters_are_there() -> None:
    assert missing(NEEDED) == set()


def test_missing_letters_are_named_and_drawn_as_a_box() -> None:
    assert missing("Жёлтый 漢字 \U0001f600 v") == {"漢", "字", "\U0001f600"}
    box = in_use().outline("漢")
    assert box == in_use().outline("字")
    assert box.advance > 0
    assert box.outline
    assert in_use().width("漢", 5.0) > 0.0


@pytest.mark.parametrize("height", [1.8, 2.5, 3.5, 5.0, 7.0, 40.0])
def test_height_is_the_height_of_capitals(height: float) -> None:
    for capital in "HEXПНШЖ":
        assert in_use().ascent(capital, height) == pytest.approx(height)
        assert in_use().descent(capital, height) == 0.0
    assert in_use().em(height) == pytest.approx(height / 0.729, rel=1e-4)


def test_measures_of_a_run() -> None:
    assert in_use().width("", 5.0) == in_use().ascent("", 5.0) == in_use().descent(" ", 5.0) == 0
    assert in_use().width(" ", 5.0) > 0.0
    parts = in_use().width("План ", 5.0) + in_use().width("скоростей", 5.0)
    assert in_use().width("План скоростей", 5.0) == pytest.approx(parts)
    assert in_use().width("План", 7.0) == pytest.approx(1.4 * in_use().width("План", 5.0))
    assert in_use().ascent("асе", 5.0) < in_use().ascent("Ас", 5.0) < in_use().ascent("Й", 5.0)
    assert in_use().descent("ру", 5.0) > in_use().descent("щ", 5.0) > 0.5
    assert in_use().ascent("_", 5.0) == 0.0
    assert in_use().descent("″", 5.0) == 0.0


def test_ink_lies_within_the_advance_but_for_combining_marks() -> None:
    xmin, ymin, xmax, ymax = in_use().ink("Жук", 10.0)
    assert 0.0 <= xmin < xmax <= in_use().width("Жук", 10.0) + 0.1
    assert ymin == -in_use().descent("Жук", 10.0)
    assert ymax == in_use().ascent("Жук", 10.0)
    assert in_use().width("v\u0305", 5.0) == in_use().width("v", 5.0)
    assert in_use().ascent("v\u0305", 5.0) > in_use().ascent("v", 5.0) + 0.5


def test_bounds_are_those_of_the_outlines() -> None:
    for char in NEEDED:
        glyph = in_use().outline(char)
        numbers = [float(number) for number in re.findall(r"-?[\d.]+", glyph.outline)]
        if not numbers:
            assert char in " \u00a0"
            continue
        # Control points may stand outside the ink, never the other way round.
        assert min(numbers[::2]) <= glyph.xmin <= glyph.xmax <= max(numbers[::2])
        assert min(numbers[1::2]) <= glyph.ymin <= glyph.ymax <= max(numbers[1::2])


def test_font_and_data_agree() -> None:
    ttlib = pytest.importorskip("fontTools.ttLib")
    font = ttlib.TTFont(in_use().font_file)
    letters = font.getBestCmap()
    data = json.loads((FONTS / "PlanmethodSans.json").read_text(encoding="ascii"))
    assert {int(code, 16) for code in data["glyphs"] if code} == set(letters)
    assert font["head"].unitsPerEm == in_use().units_per_em
    for code, name in letters.items():
        glyph = in_use().outline(chr(code))
        assert font["hmtx"][name][0] == glyph.advance, name
        if glyph.outline:
            box = font["glyf"][name]
            assert (box.xMin, box.yMin, box.xMax, box.yMax) == glyph[1:5], name


def test_font_is_renamed_and_its_licence_lies_beside_it() -> None:
    ttlib = pytest.importorskip("fontTools.ttLib")
    names = ttlib.TTFont(in_use().font_file)["name"]
    for number in (1, 4, 6):
        name = names.getDebugName(number)
        assert "Planmethod" in name
        # Words that the licence keeps for the unchanged fonts.
        assert not {"Bitstream", "Vera", "Tavmjong", "Arev"} & set(name.split())
    text = (FONTS / "PlanmethodSans-LICENSE.txt").read_text(encoding="utf-8")
    assert "Bitstream Vera" in text
    assert "Permission is hereby granted" in text


def test_script_makes_the_same_data_again(tmp_path: Path) -> None:
    pytest.importorskip("fontTools.subset")
    script = Path(__file__).parents[2] / "scripts" / "make_font.py"
    spec = importlib.util.spec_from_file_location("make_font", script)
    assert spec
    assert spec.loader
    make_font = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(make_font)
    make_font.main(tmp_path / "one")
    make_font.main(tmp_path / "two")
    for path in sorted((tmp_path / "one").iterdir()):
        assert path.read_bytes() == (tmp_path / "two" / path.name).read_bytes(), path.name
    # The bytes of the font may change with fontTools; what is drawn may not.
    name = "PlanmethodSans.json"
    assert (tmp_path / "one" / name).read_bytes() == (FONTS / name).read_bytes()
