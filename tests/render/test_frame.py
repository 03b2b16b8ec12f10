from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planmethod.errors import LayoutError
from planmethod.problem.keys import STAMP as READER_KEYS
from planmethod.render.block import CUT, fit, texts
from planmethod.render.drawing import Item, Pen, Stroke, Text
from planmethod.render.frame import (
    FORMATS,
    MARGIN_NOTE,
    STAMP_FIELDS,
    graph_26_bounds,
    paper_format,
    sheet_frame,
    title_block,
)
from planmethod.render.lettering import OutlineLettering, using
from planmethod.render.lint import lint

FIELDS = {
    "designation": "ТММ.КП.12.03.00.000",
    "title": "Кинематический анализ рычажного механизма",
    "material": "Теория механизмов и машин",
    "organisation": "МГТУ им. Н.Э. Баумана",
    "department": "Кафедра ТММ",
    "group": "РК2-41",
    "author": "Иванов",
    "checker": "Петров",
    "t_control": "Сидоров",
    "norm_control": "Котов",
    "approver": "Орлов",
    "letter": "У",
    "mass": "—",
    "scale": "1:2",
    "sheet": "1",
    "sheets": "4",
}

Lines = set[tuple[complex, complex]]


def lines(items: list[Item], pen: Pen) -> Lines:
    return {
        (s.points[0], s.points[1])
        for s in items
        if isinstance(s, Stroke) and s.pen is pen and not s.closed
    }


def shown(items: list[Item], box: tuple[float, float, float, float]) -> list[Text]:
    return [run for run in texts(items) if run.box == box]


def test_form_1_has_the_lines_of_the_standard() -> None:
    items = title_block()
    thick = lines(items, Pen.FRAME)
    for x in (17, 40, 55, 65):
        assert (complex(x, 0), complex(x, 55)) in thick
    assert (7 + 30j, 7 + 55j) in thick
    assert (135 + 0j, 135 + 40j) in thick
    assert {(30j, 65 + 30j), (35j, 65 + 35j), (65 + 40j, 185 + 40j), (65 + 15j, 185 + 15j)} < thick
    assert {(135 + 35j, 185 + 35j), (135 + 20j, 185 + 20j), (155 + 15j, 155 + 20j)} < thick
    assert {(150 + 20j, 150 + 40j), (167 + 20j, 167 + 40j)} < thick
    assert lines(items, Pen.THIN) == {
        *((complex(0, y), complex(65, y)) for y in (5, 10, 15, 20, 25, 40, 45, 50)),
        (140 + 20j, 140 + 35j),
        (145 + 20j, 145 + 35j),
    }


def test_columns_and_rows_have_the_widths_of_the_standard() -> None:
    thick = lines(title_block(), Pen.FRAME)
    header = sorted({a.real for a, b in thick if a.real == b.real and a.imag <= 32 <= b.imag})
    widths = [b - a for a, b in pairwise(header)]
    assert widths == [7, 10, 23, 15, 10, 70, 15, 17, 18]


@pytest.mark.parametrize(
    ("caption", "box"),
    [
        ("Изм.", (0, 30, 7, 35)),
        ("№ докум.", (17, 30, 40, 35)),
        ("Подп.", (40, 30, 55, 35)),
        ("Дата", (55, 30, 65, 35)),
        ("Разраб.", (0, 25, 17, 30)),
        ("Пров.", (0, 20, 17, 25)),
        ("Т.контр.", (0, 15, 17, 20)),
        ("Н.контр.", (0, 5, 17, 10)),
        ("Утв.", (0, 0, 17, 5)),
        ("Лит.", (135, 35, 150, 40)),
        ("Масса", (150, 35, 167, 40)),
        ("Масштаб", (167, 35, 185, 40)),
    ],
)
def test_captions(caption: str, box: tuple[float, float, float, float]) -> None:
    (run,) = shown(title_block(), box)
    assert run.text == caption
    assert run.height in (2.5, 1.8)


@pytest.mark.parametrize(
    ("field", "box"),
    [
        ("designation", (65, 40, 185, 55)),
        ("title", (65, 15, 135, 40)),
        ("material", (65, 0, 135, 15)),
        ("author", (17, 25, 40, 30)),
        ("checker", (17, 20, 40, 25)),
        ("t_control", (17, 15, 40, 20)),
        ("norm_control", (17, 5, 40, 10)),
        ("approver", (17, 0, 40, 5)),
        ("letter", (135, 20, 140, 35)),
        ("mass", (150, 20, 167, 35)),
        ("scale", (167, 20, 185, 35)),
    ],
)
def test_fields_go_into_their_cells(field: str, box: tuple[float, float, float, float]) -> None:
    joined = " ".join(run.text for run in shown(title_block(FIELDS), box))
    assert joined == FIELDS[field]


def test_organisation_department_and_group_share_graph_9() -> None:
    shown_lines = [run.text for run in shown(title_block(FIELDS), (135, 0, 185, 15))]
    assert shown_lines == ["МГТУ им. Н.Э. Баумана", "Кафедра ТММ", "РК2-41"]


def test_letters_fill_their_cells_from_the_left() -> None:
    items = title_block({"letter": "ОУ"})
    assert [shown(items, (x, 20, x + 5, 35))[0].text for x in (135, 140)] == ["О", "У"]


def test_more_than_three_letters_take_the_place_of_the_three_cells() -> None:
    items = title_block({"letter": "ОУАБ"})
    assert shown(items, (135, 20, 150, 35))[0].text == "ОУАБ"
    assert (140 + 20j, 140 + 35j) not in lines(items, Pen.THIN)


def test_every_key_of_the_problem_file_has_its_place() -> None:
    assert set(READER_KEYS) <= set(STAMP_FIELDS)
    for key in STAMP_FIELDS:
        assert len(texts(title_block({key: "8"}))) == len(texts(title_block())) + 1, key


def test_unknown_field_is_told_with_the_nearest() -> None:
    with pytest.raises(LayoutError, match="Did you mean designation"):
        title_block({"desigantion": "x"})


@pytest.mark.parametrize("name", FORMATS)
def test_frame_is_20_mm_from_the_left_and_5_from_the_other_edges(name: str) -> None:
    fmt = FORMATS[name]
    items, inner, stamp = sheet_frame(name, FIELDS, graph_26=True)
    assert inner == (20, 5, fmt.width - 5, fmt.height - 5)
    assert stamp == (fmt.width - 190, 5, fmt.width - 5, 60)
    edge, frame = (i for i in items if isinstance(i, Stroke) and i.tag in ("edge", "frame"))
    assert (edge.pen, frame.pen) == (Pen.THIN, Pen.FRAME)
    assert edge.points[2] == complex(fmt.width, fmt.height)
    assert frame.points[0] == 20 + 5j
    assert [f.message for f in lint(items, inner)] == []


def test_a4_stands_and_the_others_lie() -> None:
    for fmt in FORMATS.values():
        assert (fmt.width < fmt.height) == (fmt.name == "A4")


def test_notes_under_the_frame() -> None:
    items, inner, _ = sheet_frame("A3", {})
    below = [run for run in texts(items) if run.tag == MARGIN_NOTE]
    assert [run.text for run in below] == ["Копировал", "Формат А3"]
    assert all(0 < run.at.imag < run.at.imag + run.height < inner[1] for run in below)


def test_graph_26_holds_the_designation_upside_down() -> None:
    items, _, _ = sheet_frame("A3", FIELDS, graph_26=True)
    box = graph_26_bounds(FORMATS["A3"])
    assert (box[2] - box[0], box[3] - box[1]) == (70, 14)
    (run,) = shown(items, box)
    assert run.angle == 180
    assert run.text == FIELDS["designation"]


@pytest.mark.parametrize("name", ["A3", "a3", " А3 ", "а3"])
def test_format_names_are_forgiving(name: str) -> None:
    assert paper_format(name).name == "A3"


def test_unknown_format() -> None:
    with pytest.raises(LayoutError, match=r"Unknown paper format 'B5'.*A4, A3"):
        paper_format("B5")


class EvenLettering(OutlineLettering):
    """Letters of one width, so that the numbers below hold for whatever lettering is in use."""

    def width(self, text: str, height: float) -> float:
        return 0.7 * height * len(text)

    def ascent(self, text: str, height: float) -> float:
        return height

    def descent(self, text: str, height: float) -> float:
        return 0.2 * height if any(map(str.isalpha, text)) else 0.0

    def ink(self, text: str, height: float) -> tuple[float, float, float, float]:
        down = self.descent(text, height)
        return (0.0, -down, self.width(text, height), self.ascent(text, height))


TITLE_BOX = (65.0, 15.0, 135.0, 40.0)


def heights_and_lines(title: str) -> tuple[set[float], int]:
    with using(EvenLettering()):
        runs = shown(title_block({"title": title}), TITLE_BOX)
    assert not any(CUT in run.tag.split() for run in runs)
    assert " ".join(run.text for run in runs) == title
    return {run.height for run in runs}, len({run.at.imag for run in runs})


@pytest.mark.parametrize(
    ("title", "size", "count"),
    [
        ("План скоростей", 5.0, 1),
        ("Кинематический анализ", 3.5, 1),
        ("Динамический анализ рычажного механизма", 5.0, 2),
        ("Структурный и кинематический анализ плоского рычажного механизма", 3.5, 4),
        (
            "Структурный и кинематический анализ плоского рычажного механизма "
            "вытяжного пресса методом планов скоростей и ускорений",
            2.5,
            4,
        ),
    ],
)
def test_a_long_title_shrinks_and_then_wraps(title: str, size: float, count: int) -> None:
    assert heights_and_lines(title) == ({size}, count)


def test_a_word_wider_than_the_cell_is_broken_with_a_hyphen() -> None:
    runs = shown(title_block({"title": "Достопримечательность" * 3}), TITLE_BOX)
    assert len(runs) > 1
    assert runs[0].text.endswith("-")


def test_a_date_too_wide_for_its_cell_goes_on_two_lines() -> None:
    with using(EvenLettering()):
        items = title_block({"date": "12.03.2025"})
        assert [run.text for run in shown(items, (55, 25, 65, 30))] == ["12.03.", "2025"]
        assert lint(items) == []


def test_what_cannot_fit_is_cut_and_told() -> None:
    items = title_block({"author": "Преображенский-Вознесенский"})
    findings = lint(items)
    assert [f.code for f in findings] == ["PM-D06"]
    assert shown(items, (17, 25, 40, 30))[0].text.endswith("…")


texts_of_fields = st.text(alphabet="Жащфу. -№WI1_{^\\", min_size=1, max_size=90)


@settings(deadline=None)
@given(st.dictionaries(st.sampled_from(sorted(STAMP_FIELDS)), texts_of_fields))
def test_no_text_ever_leaves_its_cell(fields: Mapping[str, str]) -> None:
    findings = lint(title_block(fields))
    assert [f.message for f in findings if f.code != "PM-D06"] == []


@settings(deadline=None)
@given(texts_of_fields, st.floats(6, 90), st.floats(6, 40), st.sampled_from([3.5, 5.0, 7.0]))
def test_fit_keeps_every_sign_unless_it_says_so(
    text: str, width: float, height: float, size: float
) -> None:
    items = fit(text, (0, 0, width, height), (size, 2.5))
    findings = [f for f in lint(items) if f.code in ("PM-D03", "PM-D01")]
    assert findings == []
    runs = texts(items)
    if not any(CUT in run.tag.split() for run in runs):
        kept = "".join(run.text for run in runs).replace(" ", "").replace("-", "")
        assert kept == text.replace(" ", "").replace("-", "")
