from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from itertools import pairwise

import pytest
from cases import each, thinned
from doors import (
    ALIASES,
    CUT,
    FORM_1,
    FORM_2,
    FORM_2A,
    FORMS,
    FRAME_FORMATS as FORMATS,
    LANGUAGES_LANGUAGES as LANGUAGES,
    MARGIN_NOTE,
    SHARED,
    TITLE_BLOCK,
    DrawingItem as Item,
    Form,
    Furniture,
    LayoutError,
    OutlineLettering,
    Pen,
    Stroke,
    Text,
    declared,
    fit_text,
    ink_bounds,
    keys,
    lettering,
    lint,
    merged,
    overlap,
    sheet_frame,
    title_block,
    using,
)
from hypothesis import given, settings, strategies as st
from msgspec.structs import replace
from reading import texts
from worked import ROOT

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
    assert lines(items, Pen.LETTER) == {
        *((complex(0, y), complex(65, y)) for y in (5, 10, 15, 20, 25, 40, 45, 50)),
        (140 + 20j, 140 + 35j),
        (145 + 20j, 145 + 35j),
    }


def test_columns_and_rows_have_the_widths_of_the_standard() -> None:
    thick = lines(title_block(), Pen.FRAME)
    inside = {a.real for a, b in thick if a.real == b.real and a.imag <= 32 <= b.imag}
    widths = [b - a for a, b in pairwise(sorted({0.0, 185.0, *inside}))]
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
    assert (140 + 20j, 140 + 35j) not in lines(items, Pen.LETTER)


OF_NOTE = {"city", "year"}
"""Fields of the title page alone."""

PLACED = set(keys.known("stamp")) - set(LANGUAGES)
"""Keys of ``[stamp]``, without its tables of replacements for a language."""


def test_every_key_of_the_problem_file_has_its_place() -> None:
    columns = Furniture(side_columns=True, graph_26=False)
    bare = len(texts(sheet_frame("A3", {"sheets": ""}, columns).items))
    for key in PLACED - OF_NOTE:
        assert len(texts(sheet_frame("A3", {"sheets": "", key: "8"}, columns).items)) == bare + 1, (
            key
        )


def shown_by(key: str) -> list[str]:
    """Return the names of the forms that show a field."""
    place = ALIASES.get(key, key)
    return [
        form.name
        for form in (FORM_1, FORM_2, FORM_2A)
        if place in form.cells
        or (place in SHARED and form.organisation)
        or (place == "letter" and form.letters)
    ]


RUSSIAN = tomllib.loads(next((ROOT / "scripts").rglob("keys.ru.toml")).read_text("utf-8"))
SENTENCES = {
    "en": (TITLE_BLOCK, r"graphs? ([\d, ]+) \((?:forms? ([\w, ]+)|side columns.*)\)"),
    "ru": (RUSSIAN["stamp"], r"граф[аы] ([\d, ]+) \((?:форм[аы] ([\w, ]+)|боковые графы.*)\)"),
}
"""Sentences of the reference of keys, and how they name graphs and forms."""


@pytest.mark.parametrize("lang", SENTENCES)
def test_the_reference_names_the_graphs_and_forms_of_every_field(lang: str) -> None:
    sentences, place = SENTENCES[lang]
    assert set(sentences) - set(LANGUAGES) == PLACED
    for key in PLACED:
        found = re.search(place, sentences[key])
        assert (found is None) == (key in OF_NOTE), key
        if found is not None:
            english = re.search(SENTENCES["en"][1], TITLE_BLOCK[key])
            assert english is not None
            assert (found[1], found[2]) == (english[1], ", ".join(shown_by(key)) or None), key


def test_the_reference_has_every_setting_of_sheets_and_the_longest_formats() -> None:
    record = keys.FLAT["sheet"]
    assert (
        set(RUSSIAN["sheet"]) == set(keys.known("sheet")) == {one.name for one in declared(record)}
    )
    longest: dict[str, str] = {}
    for name, _ in sorted(FORMATS.items(), key=lambda item: item[1].width):
        if "x" in name and ":" not in name:
            longest[name[:2]] = name
    (paper,) = (one.key.sentence for one in declared(record) if one.name == "paper")
    for sentence in (paper, RUSSIAN["sheet"]["paper"]):
        assert set(re.findall(r"`\"(A\dx\d)\"`", sentence)) == set(longest.values())


def test_an_unknown_field_is_reported_with_the_nearest() -> None:
    with pytest.raises(LayoutError, match="Did you mean 'designation'"):
        title_block({"desigantion": "x"})


# The sheet around it -----------------------------------------------------------------------------

FULL = Furniture(graph_26=True, graphs_27_30=True, side_columns=True)
ALL_FIELDS = {**FIELDS, "first_use": "ТММ.КП.12.00.00.000", "inventory": "1234", "reference": "5"}


@each("form", FORMS)
@each("name", thinned(list(FORMATS), 3))
def test_frame_is_20_mm_from_the_left_and_5_from_the_other_edges(name: str, form: str) -> None:
    fmt = FORMATS[name]
    for sheet in (1, 2):
        made = sheet_frame(name, ALL_FIELDS, replace(FULL, form=form), sheet=sheet)
        assert made.inner == (20, 5, fmt.width - 5, fmt.height - 5)
        assert made.stamp[:3] == (fmt.width - 190, 5, fmt.width - 5)
        edge, frame = (
            i for i in made.items if isinstance(i, Stroke) and i.tag in ("edge", "frame")
        )
        assert (edge.pen, frame.pen) == (Pen.LETTER, Pen.FRAME)
        assert edge.points[2] == complex(fmt.width, fmt.height)
        assert frame.points[0] == 20 + 5j
        assert [f.message for f in lint(made.items, made.inner)] == []
        ink = ink_bounds(made.items)
        assert (ink[0], ink[1]) == pytest.approx((0, 0), abs=0.5)


@each("name", FORMATS)
def test_notes_under_the_frame(name: str) -> None:
    fmt = FORMATS[name]
    below = [run for run in texts(sheet_frame(name).items) if run.tag == MARGIN_NOTE]
    assert [run.text for run in below] == ["Копировал", "Формат " + fmt.written("\u0410")]
    assert all(0 < run.at.imag < run.at.imag + run.height < 5 for run in below)
    assert all(fmt.width - 190 < run.at.real < fmt.width - 5 for run in below)


def test_the_name_of_an_elongated_format_has_a_sign_of_times() -> None:
    assert FORMATS["A4x3:portrait"].written("\u0410") == "\u04104\u00d73"


@pytest.mark.parametrize(
    ("name", "box", "angle"),
    [
        ("A4", (20, 278, 90, 292), 180),
        ("A3", (20, 278, 90, 292), 180),
        ("A4x3", (20, 278, 90, 292), 180),
        ("A3:portrait", (278, 345, 292, 415), 90),
        ("A4x3:portrait", (278, 555, 292, 625), 90),
    ],
)
def test_graph_26_is_the_designation_turned(
    name: str, box: tuple[float, float, float, float], angle: float
) -> None:
    """Turned with the sheet it reads level in the lower right corner, where a hand looks for it."""
    made = sheet_frame(name, FIELDS)
    (run,) = shown(made.items, box)
    assert run.angle == angle
    assert run.text == FIELDS["designation"]
    assert made.reserved == (box,)


@pytest.mark.parametrize(("usual", "narrow"), [("B", "A"), ("B-upright", "A-upright"), ("A", "")])
def test_a_text_that_would_be_lowered_is_set_in_the_narrow_lettering(
    usual: str, narrow: str
) -> None:
    designation = f"{FIELDS['designation']}-СБ"
    with using(lettering(usual)):
        made = sheet_frame("A3", {**FIELDS, "designation": designation})
        runs = texts(made.items)
        (graph,) = shown(made.items, made.reserved[0])
        (change,) = [run for run in runs if run.text == "Изм."]
        for run in (graph, change) if usual == "B" else (graph,):  # upright, the other fits
            left, low, right, high = ink_bounds([run])
            assert run.lettering == narrow
            assert run.box is not None and run.box[0] < left < right < run.box[2]
            assert run.box[1] < low < high < run.box[3]
        assert change.height == 2.5
        assert graph.height == 5.0
        whole = [run for run in runs if run.text == designation]
        assert {run.height for run in whole} == {5.0, 7.0}
        assert all(run.lettering in ("", narrow) for run in runs)
        assert all(run.lettering == "" for run in runs if run.height < 2.5)


def test_graph_26_goes_with_form_1_unless_requested() -> None:
    paper = FORMATS["A3"]
    assert list(Furniture().graphs(paper)) == ["26"]
    assert list(Furniture(form="2").graphs(paper)) == []
    assert list(Furniture(form="2", graph_26=True).graphs(paper)) == ["26"]
    assert Furniture(graph_26=False).drawing_area(paper).reserved == ()


def test_a_long_designation_stays_in_graph_26() -> None:
    for name in ("A3", "A3:portrait"):
        made = sheet_frame(name, {"designation": "ТММ.КП.12.03.00.000-" * 12})
        runs = [run for run in texts(made.items) if run.box == made.reserved[0]]
        assert runs
        assert {f.code for f in lint(made.items, made.inner)} <= {"PM-D06"}


def test_graphs_27_to_30_of_form_1() -> None:
    room = FULL.drawing_area(FORMATS["A3"])
    assert room.stamp == (230, 5, 415, 68)  # graph 30 is 8 mm high, above the title block
    assert set(room.reserved) == {
        (20, 278, 90, 292),
        (90, 278, 104, 292),
        (104, 285, 157, 292),
        (104, 278, 157, 285),
    }


def test_graphs_27_to_30_of_form_2_are_above_it() -> None:
    graphs = Furniture(form="2", graphs_27_30=True).graphs(FORMATS["A4"])
    widths = {number: (box[2] - box[0], box[3] - box[1]) for number, box in graphs.items()}
    assert widths == {"30": (120, 8), "27": (14, 14), "28": (53, 14), "29": (53, 14)}
    assert min(box[1] for box in graphs.values()) == 45


def test_side_columns() -> None:
    items = sheet_frame("A4", ALL_FIELDS, Furniture(side_columns=True)).items
    told = {
        run.text: run.box
        for run in texts(items)
        if run.angle == 90 and run.box and run.at.real < 20
    }
    assert told == {
        "Инв. № подл.": (8, 5, 13, 30),
        "1234": (13, 5, 20, 30),
        "Подп. и дата": (8, 115, 13, 150),
        "Взам. инв. №": (8, 65, 13, 90),
        "Инв. № дубл.": (8, 90, 13, 115),
        "Перв. примен.": (8, 232, 13, 292),
        "ТММ.КП.12.00.00.000": (13, 232, 20, 292),
        "Справ. №": (8, 172, 13, 232),
        "5": (13, 172, 20, 232),
    }
    later = texts(sheet_frame("A4", ALL_FIELDS, Furniture(side_columns=True), sheet=2).items)
    assert "Перв. примен." not in {run.text for run in later}
    assert not any(run.angle == 90 for run in texts(sheet_frame("A4", ALL_FIELDS).items))


# Forms 2 and 2a ----------------------------------------------------------------------------------


def test_form_2_has_the_lines_of_the_standard() -> None:
    items = title_block(form=FORM_2)
    thick = lines(items, Pen.FRAME)
    assert {(complex(x, 0), complex(x, 40)) for x in (17, 40, 55, 65)} < thick
    assert {(7 + 25j, 7 + 40j), (135 + 0j, 135 + 25j), (25j, 185 + 25j), (30j, 65 + 30j)} < thick
    assert {(135 + 15j, 185 + 15j), (135 + 20j, 185 + 20j), (150 + 15j, 150 + 25j)} < thick
    assert lines(items, Pen.LETTER) == {
        *((complex(0, y), complex(65, y)) for y in (5, 10, 15, 20, 35)),
        (140 + 15j, 140 + 20j),
        (145 + 15j, 145 + 20j),
    }


def test_form_2a_has_the_lines_of_the_standard() -> None:
    items = title_block(form=FORM_2A)
    thick = lines(items, Pen.FRAME)
    assert {(complex(x, 0), complex(x, 15)) for x in (7, 17, 40, 55, 65, 175)} < thick
    assert {(5j, 65 + 5j), (175 + 8j, 185 + 8j)} < thick
    assert lines(items, Pen.LETTER) == {(10j, 65 + 10j)}


@pytest.mark.parametrize("form", [FORM_1, FORM_2, FORM_2A], ids=lambda form: form.name)
def test_a_form_is_closed_and_its_cells_do_not_overlap(form: Form) -> None:
    (outline,) = (i for i in title_block(form=form) if isinstance(i, Stroke) and i.closed)
    assert outline.points[2] == complex(form.width, form.height)
    boxes = [box for _, box, _ in form.captions] + [cell.box for cell in form.cells.values()]
    boxes += form.letters + ((form.organisation.box,) if form.organisation else ())
    for number, one in enumerate(boxes):
        assert 0 <= one[0] < one[2] <= form.width
        assert 0 <= one[1] < one[3] <= form.height
        for two in boxes[:number]:
            assert not overlap(one, two), (one, two)


@pytest.mark.parametrize(
    ("form", "field", "box"),
    [
        (FORM_2, "designation", (65, 25, 185, 40)),
        (FORM_2, "title", (65, 0, 135, 25)),
        (FORM_2, "author", (17, 20, 40, 25)),
        (FORM_2, "checker", (17, 15, 40, 20)),
        (FORM_2, "approver", (17, 0, 40, 5)),
        (FORM_2, "sheets", (165, 15, 185, 20)),
        (FORM_2A, "designation", (65, 0, 175, 15)),
        (FORM_2A, "sheet", (175, 0, 185, 8)),
    ],
    ids=lambda value: value.name if isinstance(value, Form) else str(value),
)
def test_fields_of_forms_2_and_2a(
    form: Form, field: str, box: tuple[float, float, float, float]
) -> None:
    joined = " ".join(run.text for run in shown(title_block(FIELDS, form), box))
    assert joined == FIELDS[field]


def test_form_2a_shows_no_other_field() -> None:
    bare = len(texts(title_block(form=FORM_2A)))
    assert len(texts(title_block({"author": "Иванов", "mass": "1"}, FORM_2A))) == bare


@pytest.mark.parametrize(
    ("form", "made"),
    [("1", ["1", "1"]), ("1+2a", ["1", "2a"]), ("2", ["2", "2a"]), ("2a", ["2a", "2a"])],
)
def test_forms_of_the_first_and_the_later_sheets(form: str, made: list[str]) -> None:
    furniture = Furniture(form=form)
    assert [furniture.form_of(sheet).name for sheet in (1, 2)] == made
    assert furniture.form_of(2) is Furniture(form=form, before=3).form_of(1)


def test_an_unknown_form() -> None:
    with pytest.raises(LayoutError, match=r"Unknown form '3'.*1, 1\+2a, 2, 2a"):
        Furniture(form="3")


def test_only_the_first_sheet_has_the_number_of_sheets() -> None:
    assert Furniture().numbers(1, 1) == {}
    for fields, told in (({}, "1"), ({"sheet": "2", "sheets": "4"}, "4")):
        (run,) = shown(sheet_frame("A4", fields).items, (191, 20, 205, 25))
        assert run.text == told
    assert Furniture().numbers(1, 3) == {"sheet": "1", "sheets": "3"}
    assert Furniture().numbers(2, 3) == {"sheet": "2", "sheets": ""}
    assert Furniture(before=4).numbers(1, 1) == {"sheet": "5", "sheets": ""}
    assert Furniture(total=9).numbers(1, 1) == {"sheet": "1", "sheets": "9"}


def test_names_of_sheets_have_one_height_wrapped_or_not() -> None:
    for name in ("Силовой расчёт механизма", "Структурный и кинематический анализ механизма"):
        runs = shown(title_block({"title": name}), (65, 15, 135, 40))
        assert {run.height for run in runs} == {5.0}, name


# Fields ------------------------------------------------------------------------------------------


def test_a_field_has_one_place_under_any_of_its_names() -> None:
    assert merged({"material": "Сталь"}, {"subject": "ТММ"}) == {"material": "ТММ"}
    assert merged({"date": "01.02"}, {"author_date": ""}) == {}
    assert merged({"author": "А"}, {"author": "Б", "group": "В"}) == {"author": "Б", "group": "В"}


class EvenLettering(OutlineLettering):
    """Letters of one width, so that the numbers below hold for any lettering in use."""

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
        ("Кинематический анализ", 5.0, 2),
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


def test_a_text_that_does_not_fit_is_cut_and_reported() -> None:
    items = title_block({"author": "Преображенский-Вознесенский"})
    findings = lint(items)
    assert [f.code for f in findings] == ["PM-D06"]
    assert shown(items, (17, 25, 40, 30))[0].text.endswith("…")


texts_of_fields = st.text(alphabet="Жащфу. -№WI1_{^\\", min_size=1, max_size=90)


@settings(deadline=None)
@given(
    st.dictionaries(st.sampled_from(sorted(TITLE_BLOCK)), texts_of_fields),
    st.sampled_from(sorted(FORMS)),
    st.sampled_from(["A4", "A3", "A3:portrait"]),
)
def test_no_text_ever_leaves_its_cell(fields: Mapping[str, str], form: str, name: str) -> None:
    made = sheet_frame(name, fields, replace(FULL, form=form))
    findings = lint(made.items, made.inner)
    assert [f.message for f in findings if f.code != "PM-D06"] == []


@settings(deadline=None)
@given(texts_of_fields, st.floats(6, 90), st.floats(6, 40), st.sampled_from([3.5, 5.0, 7.0]))
def test_fit_keeps_every_character_unless_it_marks_a_cut(
    text: str, width: float, height: float, size: float
) -> None:
    items = fit_text(text, (0, 0, width, height), (size, 2.5))
    findings = [f for f in lint(items) if f.code in ("PM-D03", "PM-D01")]
    assert findings == []
    runs = texts(items)
    if not any(CUT in run.tag.split() for run in runs):
        kept = "".join(run.text for run in runs).replace(" ", "").replace("-", "")
        assert kept == text.replace(" ", "").replace("-", "")
