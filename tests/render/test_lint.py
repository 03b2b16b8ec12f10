from __future__ import annotations

import pytest
from doors import (
    CUT,
    MARGIN_NOTE,
    REMARKS,
    STAMP,
    UNDER_LABEL,
    Arc,
    Disc,
    DrawingItem as Item,
    Fill,
    Ink,
    Pen,
    Stroke,
    Text,
    lint,
    typeset,
)

INNER = (20.0, 5.0, 200.0, 150.0)
AT = 50 + 50j
WORD = Text(AT, "слово", 5)
WHITE = (40 + 40j, 90 + 40j, 90 + 70j, 40 + 70j)


def codes(*items: Item) -> list[str]:
    return [finding.code for finding in lint(items, INNER)]


def test_a_clean_sheet() -> None:
    items: list[Item] = [WORD, Stroke((20 + 48j, 90 + 48j)), Arc(100 + 100j, 8)]
    assert codes(*items, *typeset(r"\bar{a}^{n}_{CB}", 5).at(120 + 100j)) == []


def test_inscriptions_that_overlap() -> None:
    (finding,) = lint([WORD, Text(AT + 3 + 2j, "другое", 5)])
    assert finding.code == "PM-D01"
    assert "'слово' and 'другое' overlap at (50.0, 50.0) mm" in finding.message
    assert finding.value > 1
    assert finding.place == AT


def test_runs_of_one_label_are_one_inscription() -> None:
    runs = (Text(AT, "a", 5, label="x"), Text(AT + 1, "b", 5, label="x"))
    assert codes(*runs) == []


@pytest.mark.parametrize(
    "thing",
    [
        Stroke((45 + 52j, 90 + 52j)),
        Stroke((52 + 52j, 53 + 52j), Pen.THIN),  # altogether inside the ink
        Stroke((45 + 45j, 90 + 45j, 90 + 52j, 45 + 52j), closed=True),
        Arc(50 + 45j, 7),
        Fill((52 + 48j, 56 + 48j, 54 + 54j)),
        Disc(54 + 52j, 2, Ink.BLACK),
    ],
)
def test_things_under_letters(thing: Item) -> None:
    for items in ((thing, WORD), (WORD, thing)):
        assert codes(*items) == ["PM-D02"]


def test_pieces_of_one_line_under_letters_are_one_finding() -> None:
    one, two = Stroke((45 + 52j, 55 + 52j), tag="curve"), Stroke((55 + 52j, 90 + 52j), tag="curve")
    whole = Stroke((45 + 52j, 90 + 52j), tag="curve")
    (both,), (single,) = (lint([*items, WORD], INNER) for items in ((one, two), (whole,)))
    assert (both.code, both.place) == ("PM-D02", single.place)
    assert both.value == pytest.approx(single.value)
    other = Stroke((45 + 54j, 90 + 54j), tag="axis")
    assert codes(one, two, other, WORD) == ["PM-D02", "PM-D02"]


def test_the_closing_side_of_an_outline_counts() -> None:
    outline = Stroke((45 + 52j, 45 + 90j, 90 + 90j, 90 + 52j), closed=True)
    assert codes(outline, WORD) == ["PM-D02"]


@pytest.mark.parametrize("pen", Pen)
def test_the_ground_of_a_label_breaks_thin_lines_alone(pen: Pen) -> None:
    line, ground = Stroke((45 + 52j, 90 + 52j), pen), Fill(WHITE, Ink.WHITE, tag=UNDER_LABEL)
    told = codes(line, ground, WORD)
    thin = (Pen.COMPONENT, Pen.THIN, Pen.LETTER, Pen.PALE, Pen.PHANTOM)
    assert told == ([] if pen in thin else ["PM-D02"])


def test_white_hides_lines_drawn_before_it() -> None:
    line = Stroke((30 + 52j, 100 + 52j))
    ground = Fill(WHITE, Ink.WHITE)
    assert codes(line, ground, WORD) == []
    assert codes(ground, line, WORD) == ["PM-D02"]
    assert codes(WORD, ground) == ["PM-D02"]


def test_pens_may_be_ignored() -> None:
    items: list[Item] = [Stroke((45 + 52j, 90 + 52j), Pen.PALE), WORD]
    assert lint(items, ignore=[Pen.PALE]) == []
    assert len(lint(items)) == 1


def test_a_bar_belongs_to_its_own_inscription_only() -> None:
    bar = typeset(r"\bar{v}", 5)
    own = bar.at(AT)
    assert codes(*own) == []
    over = bar.at(AT - 1j * bar.ascent + 2j)
    assert "PM-D02" in codes(WORD, *over)


def test_text_out_of_its_box() -> None:
    inside = Text(AT, "12", 3.5, box=(48, 48, 62, 56))
    out = Text(AT, "12345678", 3.5, box=(48, 48, 62, 56))
    assert codes(inside) == []
    (finding,) = lint([out])
    assert finding.code == "PM-D03"
    assert finding.value > 1


@pytest.mark.parametrize("at", [15 + 50j, 195 + 50j, 50 + 3j, 50 + 148j])
def test_text_out_of_the_frame(at: complex) -> None:
    assert codes(Text(at, "слово", 5)) == ["PM-D04"]
    assert codes(Text(at, "слово", 5, tag=MARGIN_NOTE)) == []
    assert lint([Text(at, "слово", 5)]) == []


def test_rotated_text_is_checked_as_rotated() -> None:
    line = Stroke((30 + 60j, 70 + 60j))
    assert codes(WORD, line) == []
    assert codes(Text(AT, "слово", 5, angle=90), line) == ["PM-D02"]
    assert codes(Text(25 + 50j, "слово", 5, angle=180)) == ["PM-D04"]


def test_small_letters() -> None:
    assert codes(Text(AT, "слово", 1.8)) == ["PM-D05"]
    assert codes(Text(AT, "слово", 1.8, tag=STAMP)) == []
    assert codes(*typeset("v_{B}", 2.5).at(AT)) == []
    low = (Text(AT, "v", 2.5, label="x"), Text(AT + 4, "B", 1.5, label="x"))
    (finding,) = lint(low)
    assert (finding.code, finding.value, finding.limit) == ("PM-D05", 1.5, 1.8)


def test_shortened_text() -> None:
    assert codes(Text(AT, "сло…", 5, tag=CUT)) == ["PM-D06"]


def test_blank_text_has_no_ink() -> None:
    assert codes(Text(AT, " ", 5), Stroke((30 + 50j, 90 + 50j))) == []


def test_codes_are_sorted_and_known() -> None:
    told = codes(Text(15 + 50j, "сло…", 1.8, tag=CUT), WORD, Stroke((45 + 52j, 90 + 52j)))
    assert told == sorted(told)
    assert set(told) <= set(REMARKS)
