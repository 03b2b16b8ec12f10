"""Specimen sheets: complete, neat, and true to their texts."""

from __future__ import annotations

import re
from itertools import pairwise

import pytest
from doors import (
    LINES_SAMPLE as SAMPLE,
    LINES_TYPES as TYPES,
    PENS,
    SIZES,
    SPECIMENS,
    SYMBOLS_GROUND as GROUND,
    SYMBOLS_HEIGHT as HEIGHT,
    SYMBOLS_WIDTH as WIDTH,
    WORDING_LANGUAGES as LANGUAGES,
    Arc,
    Drawing,
    Fill,
    LayoutError,
    LineType,
    Pen,
    PenSet,
    Stroke,
    SymbolCell,
    Text,
    drawn_cell,
    get_language,
    ink_bounds,
    inspect,
    lines_measured as measured,
    lines_sheet,
    rule_cells,
    sample,
    stroke_lines,
    symbol_cells,
)

RU = get_language("ru")


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", SPECIMENS)
def test_the_norm_control_finds_no_faults(name: str, lang: str) -> None:
    assert inspect(SPECIMENS[name]({}, get_language(lang))) == []


def letters(drawing: Drawing) -> str:
    return " ".join(item.text for item in drawing.items if isinstance(item, Text))


@pytest.mark.parametrize("name", SPECIMENS)
def test_fields_of_the_title_block(name: str) -> None:
    told = letters(SPECIMENS[name]({"author": "Иванов", "title": "Образцы"}, RU))
    assert "Иванов" in told
    assert "Образцы" in told
    with pytest.raises(LayoutError):
        SPECIMENS[name]({"autor": "Иванов"}, RU)


# Symbols -----------------------------------------------------------------------------------------


def test_every_symbol_has_a_name_and_a_clause_of_its_own() -> None:
    cells = symbol_cells()
    names = [cell.name for cell in cells]
    assert len(set(names)) == len(names) >= 28
    for cell in cells:
        assert cell.clause is None or re.fullmatch(
            r"ГОСТ 2\.770(, п\. (1|2|5, а|6, [абв]|7, а|38))?", cell.clause.describe(RU.specimens)
        )


def test_the_requested_symbols_are_there() -> None:
    told = " ".join(RU.specimens["cells"][cell.name].lower() for cell in symbol_cells())
    for name in (
        "неподвижная опора",
        "двусторонней",
        "вращательная пара",
        "двойной шарнир",
        "на середине звена",
        "ползун",
        "внеосным",
        "камень на кулисе",
        "трёхпарное",
        "соединение",
        "кривошип",
        "коромысло",
        "внешнее зацепление",
        "внутреннее зацепление",
        "планетарный",
        "реечная",
        "кулачок",
        "ведущее звено",
    ):
        assert name in told


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("cell", symbol_cells(), ids=lambda cell: cell.name)
def test_a_symbol_stays_in_its_cell(cell: SymbolCell, lang: str) -> None:
    box, words = (0.0, 0.0, WIDTH, HEIGHT), get_language(lang).specimens
    left, low, right, high = ink_bounds(drawn_cell(cell, 1, box, words))
    assert left > 1
    assert low > 1
    assert right < WIDTH - 1
    assert high < HEIGHT - 1


def test_the_symbols_are_at_working_size() -> None:
    items = [item for cell in symbol_cells() for item in cell.items]
    joints = [i for i in items if isinstance(i, Arc) and i.pen is Pen.MAIN]
    assert sum(abs(i.radius - SIZES.joint / 2) < 1e-9 for i in joints) > 20
    assert any(isinstance(i, Stroke) and i.tag == GROUND for i in items)
    told = letters(SPECIMENS["symbols"]({}, RU))
    for size in (SIZES.joint, SIZES.support_height, SIZES.base, SIZES.hatch_step, 1.7):
        assert f"{size:g}".replace(".", ",") in told


# Lines -------------------------------------------------------------------------------------------


def test_every_pen_but_the_doubles_has_its_line() -> None:
    """The frame is a main line, pale lines are thin ones in grey, bars over letters thin ones.

    Vectors of one of many plans are as wide as components.
    """
    assert {kind.pen for kind in TYPES} == set(Pen) - {
        Pen.FRAME, Pen.PALE, Pen.RELATIVE, Pen.LETTER, Pen.FINE_RESULTANT, Pen.FINE_RELATIVE,
    }  # fmt: skip


@pytest.mark.parametrize("kind", TYPES, ids=lambda kind: kind.name)
def test_strokes_are_drawn_as_described(kind: LineType) -> None:
    (line,) = sample(kind, 10 + 10j)
    assert isinstance(line, Stroke)
    assert line.pen is kind.pen
    assert abs(line.points[-1] - line.points[0]) == pytest.approx(SAMPLE)
    pieces = stroke_lines(line)
    if PENS[kind.pen].dashes is None:
        assert measured([line], RU.notation) == "–"
        return
    stroke, gap = (
        float(part.replace(",", ".")) for part in measured([line], RU.notation).split("; ")
    )
    lengths = [abs(piece[-1] - piece[0]) for piece in pieces]
    assert stroke == pytest.approx(max(lengths), abs=0.051)
    long = [piece for piece in pieces if abs(piece[-1] - piece[0]) > 2]
    assert all(abs(b[0] - a[-1]) == pytest.approx(gap, abs=0.051) for a, b in pairwise(long))


def test_the_table_has_the_widths_of_the_pens() -> None:
    told = letters(lines_sheet({}, RU))
    for kind in TYPES:
        assert f"{PenSet().width(kind.pen):g}".replace(".", ",") in told
        assert RU.specimens["line_names"][kind.name].split("\n")[0] in told


def test_the_rules_are_kept_in_their_own_pictures() -> None:
    drawn = {cell.name: cell for cell in rule_cells(RU.notation)}
    small = drawn["small_circle"].items
    assert drawn["small_circle"].size == "12"
    (circle,) = (i for i in small if isinstance(i, Arc))
    assert 2 * circle.radius < 12
    assert {i.pen for i in small if isinstance(i, Stroke)} == {Pen.THIN}
    heads = drawn["arrow"].items
    assert sum(isinstance(i, Fill) for i in heads) == 4
