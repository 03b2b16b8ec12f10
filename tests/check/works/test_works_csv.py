from __future__ import annotations

from pathlib import Path

import pytest
from doors import (
    Sense,
    Submission,
    SubmissionsSubmissionError as SubmissionError,
    Unread,
    read_works,
)

LONG = """student;variant;what;value;unit;mm;sense
s01;;mu_v;0,05;;;
s01;;mu_l;1:2;;;
s01;;ruler_mm;0,5;;;
s01;;v B3;2,275;m/s;45,5;left
s01;;omega 3;15,2;1/s;;ccw
s02;Б;v B3;;;;
s02;Б;v D;0;;;
"""

WIDE = """Студент;Вариант;μ_v;v_B3, м/с;v_B3 (мм);ω3, 1/с;ω3 направление;Примечание
Иванов;1;0,05;2,275;45,5;15,2;↺;зачёт
Петров;2;;;-;0;;
"""


def read(folder: Path, text: str | bytes, name: str = "group.csv") -> list[Submission]:
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_works(path)


def said(works: list[Submission]) -> list[tuple[object, ...]]:
    return [
        (
            work.student,
            work.variant,
            *((a.what, a.id, a.value, a.mm, a.sense) for a in work.answers),
        )
        for work in works
    ]


def test_the_long_form_is_read(tmp_path: Path) -> None:
    first, second = read(tmp_path, LONG)
    assert (first.student, first.variant, first.ruler_mm) == ("s01", None, 0.5)
    assert first.scales == {"mu_v": 0.05, "mu_l": 0.002}
    v, omega = first.answers
    assert (v.what, v.value, v.step, v.mm, v.mm_step) == ("v B3", 2.275, 0.001, 45.5, 0.1)
    assert (v.unit, v.sense, v.location) == ("m/s", Sense.LEFT, "group.csv:5, value")
    assert (omega.value, omega.sense) == (15.2, Sense.CCW)
    assert (second.student, second.variant) == ("s02", "Б")
    blank, nought = second.answers
    assert blank.is_blank and not nought.is_blank
    assert not first.remarks and not second.remarks


def test_the_wide_form_is_read(tmp_path: Path) -> None:
    first, second = read(tmp_path, WIDE)
    assert (first.student, first.variant, first.scales) == ("Иванов", "1", {"mu_v": 0.05})
    v, omega = first.answers
    assert (v.id, v.value, v.mm, v.unit) == ("v_B3", 2.275, 45.5, "м/с")
    assert v.location == "group.csv:2, v_B3, м/с"
    assert (omega.id, omega.value, omega.sense) == ("ω3", 15.2, Sense.CCW)
    assert [answer.is_blank for answer in second.answers] == [True, False]
    assert not first.remarks


@pytest.mark.parametrize("text", [LONG, WIDE], ids=["long", "wide"])
@pytest.mark.parametrize("separator", [";", "\t", ","])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1251"])
def test_encodings_and_separators_make_no_difference(
    tmp_path: Path, text: str, separator: str, encoding: str
) -> None:
    text = text.replace("μ", "mu").replace("ω", "w").replace("↺", "ccw")  # cp1251 has none of them
    lines = [line.split(";") for line in text.splitlines()]
    other = "\r\n".join(
        separator.join(f'"{field}"' if "," in field else field for field in line) for line in lines
    )
    assert said(read(tmp_path, other.encode(encoding))) == said(read(tmp_path, text))


def test_excel_names_its_separator_in_a_line_of_its_own(tmp_path: Path) -> None:
    works = read(tmp_path, "sep=;\n" + LONG)
    assert said(works) == said(read(tmp_path, LONG))
    assert works[0].answers[0].location == "group.csv:6, value"


def test_columns_may_be_in_any_order_with_russian_heads(tmp_path: Path) -> None:
    text = (
        "Группа 321;;;;;;\n;;;;;;\n"
        "НАПРАВЛЕНИЕ;Ед. изм.;Значение;мм на плане;Величина;Положение;ФИО;Подпись\n"
        "против ч.с.;1/с;15,2;;omega 3;1;Иванов И. И.;\n"
        ";;2,275 м/с;45,5;v В3;2;Иванов И. И.;\n"
    )
    (work,) = read(tmp_path, text)
    assert work.student == "Иванов И. И."
    omega, v = work.answers
    assert (omega.what, omega.sense, omega.position) == ("omega 3", Sense.CCW, 1)
    assert (v.what, v.value, v.mm, v.position) == ("v B3", 2.275, 45.5, 2)
    (remark,) = work.remarks
    assert (remark.reason, remark.fault) == (Unread.COLUMN, "Подпись")


def test_a_row_without_a_student_is_reported(tmp_path: Path) -> None:
    first, _ = read(tmp_path, LONG + ";;v B3;2,2;m/s;44;\n\n;;;;;;\n")
    (remark,) = first.remarks
    assert (remark.reason, remark.location) == (Unread.STUDENT, "group.csv:9")


def test_an_unquoted_decimal_comma_between_commas_is_reported(tmp_path: Path) -> None:
    text = "student,what,value,unit\ns01,v B3,2,275,m/s\ns01,v D,3.4,m/s\n"
    (work,) = read(tmp_path, text)
    first, second = work.answers
    assert (first.what, first.value, first.reason) == ("v B3", None, Unread.FIELDS)
    assert first.location == "group.csv:2, value"
    assert second.value == 3.4
    (wide,) = read(tmp_path, "student,v_B3,v_D\ns01,2,275,3.4\n")
    assert [answer.reason for answer in wide.answers] == [Unread.FIELDS] * 2


def test_an_unreadable_cell_is_reported_by_row_and_column(tmp_path: Path) -> None:
    (work,) = read(tmp_path, "student;what;value;sense\ns01;v B3;2,2,7;left\ns01;v D;3;-->\n")
    v, other = work.answers
    assert (v.reason, v.fault, v.location) == (Unread.NUMBER, "2,2,7", "group.csv:2, value")
    assert (other.reason, other.value, other.location) == (Unread.SENSE, 3.0, "group.csv:3, sense")


def test_changing_variants_and_scales_are_reported(tmp_path: Path) -> None:
    text = "student;variant;what;value\ns01;1;mu_v;0,05\ns01;2;mu_v;0,04\n"
    (work,) = read(tmp_path, text)
    assert (work.variant, work.scales) == ("1", {"mu_v": 0.05})
    assert [remark.reason for remark in work.remarks] == [Unread.TWICE] * 2


def test_a_name_may_be_in_two_columns_and_a_value_in_one(tmp_path: Path) -> None:
    (work,) = read(tmp_path, "Фамилия;Имя;что;значение;ответ\nИванов;Пётр;v B;2;3\n")
    assert work.student == "Иванов Пётр"
    assert [answer.value for answer in work.answers] == [2.0]
    assert [(r.reason, r.fault) for r in work.remarks] == [(Unread.COLUMN, "ответ")]


@pytest.mark.parametrize("columns", ["значение, мм/с;единица", "единица;значение, мм/с"])
def test_the_unit_of_a_row_counts_before_that_of_the_head(tmp_path: Path, columns: str) -> None:
    rows = ("s;v B;2;м/с", "s;v C;2;", "s;v D;2 см/с;м/с")
    if columns.startswith("единица"):
        rows = ("s;v B;м/с;2", "s;v C;;2", "s;v D;м/с;2 см/с")
    (work,) = read(tmp_path, "\n".join((f"student;what;{columns}", *rows)))
    assert [answer.value for answer in work.answers] == [2.0, 0.002, 0.02]


def test_points_are_named_in_a_row(tmp_path: Path) -> None:
    (work,) = read(tmp_path, "student;what;value\ns01;v K;2\ns01;точка K;B3\n")
    assert [answer.what for answer in work.answers] == ["v B3"]


def test_a_scale_beside_an_answer_is_that_of_its_plan(tmp_path: Path) -> None:
    text = "student;what;mm;масштаб\ns01;v B3;45,5;0,05\ns01;a B3;54;1\ns01;omega 3;45,5;0,05\n"
    (work,) = read(tmp_path, text)
    assert work.scales == {"mu_v": 0.05, "mu_a": 1.0}
    assert [remark.reason for remark in work.remarks] == [Unread.SCALE]


def test_a_student_without_a_name_is_called_by_number_or_variant(tmp_path: Path) -> None:
    one, two = read(tmp_path, "№;v_B3\n1;2,2\n2;2,3\n")
    assert (one.student, two.student) == ("1", "2")
    (work,) = read(tmp_path, "Вариант;v_B3\n5;2,2\n")
    assert (work.student, work.variant) == ("5", "5")


def test_one_student_may_be_named_above_the_table(tmp_path: Path) -> None:
    text = "Студент: Иванов;;\nВариант;Б;\nμ_v, (мм/с)/мм;50;\nвеличина;значение;мм\nv B3;2,2;44\n"
    (work,) = read(tmp_path, text)
    assert (work.student, work.variant, work.scales) == ("Иванов", "Б", {"mu_v": 0.05})
    assert work.answers[0].value == 2.2
    (nameless,) = read(tmp_path, "what;value\nv B3;2,2\n", "Сидоров.csv")
    assert nameless.student == "Сидоров"


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"", "is a head"),
        (b"a;b\n1;2\n", "is a head"),
        (b'student;what;value\n"s01;v B3;2\n', "quote"),
        (b"student;what;value\ns\0;v B3;2\n", "not a text"),
        (b"student;what;value\n" + b"s;v B;1\n" * 20_001, "over 20000 rows"),
        (b"student;what;value" + b";" * 500, "columns"),
        (
            b"student;what;value\n" + b"".join(b"%d;v B;1\n" % n for n in range(2001)),
            "2000 students",
        ),
    ],
)
def test_a_fault_of_the_whole_file_is_an_error(tmp_path: Path, data: bytes, said: str) -> None:
    with pytest.raises(SubmissionError, match=said):
        read(tmp_path, data)
