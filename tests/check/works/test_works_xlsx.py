from __future__ import annotations

import datetime
import io
import re
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import openpyxl
import pytest
from doors import (
    Sense,
    Submission,
    SubmissionsSubmissionError as SubmissionError,
    Unread,
    read_works,
)

ROWS: list[list[Any]] = [
    ["Группа 321", None, None, None, None],
    [],
    ["Студент", "Величина", "Значение", "Единица", "Направление"],
    ["Иванов", "v B3", 2.275, "м/с", "влево"],
    [None, "v D", "3,41", "м/с", None],
    [None, "omega 3", 0, None, "↺"],
    ["Петров", "v B3", None, "м/с", None],
]


def saved(rows: list[list[Any]], change: Callable[[Any], None] | None = None) -> bytes:
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = "Лист"
    for row in rows:
        sheet.append(row)
    if change is not None:
        change(sheet)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def read(folder: Path, data: bytes, name: str = "group.xlsx") -> list[Submission]:
    path = folder / name
    path.write_bytes(data)
    return read_works(path)


def patched(data: bytes, member: str, change: Callable[[bytes], bytes]) -> bytes:
    """Return a workbook with one of its parts changed as no program would write it."""
    stream = io.BytesIO()
    with (
        zipfile.ZipFile(io.BytesIO(data)) as old,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as new,
    ):
        for name in old.namelist():
            part = old.read(name)
            new.writestr(name, change(part) if name == member else part)
    return stream.getvalue()


SHEET = "xl/worksheets/sheet1.xml"


def test_a_name_merged_over_its_rows_counts_for_all(tmp_path: Path) -> None:
    ivanov, petrov = read(tmp_path, saved(ROWS, lambda sheet: sheet.merge_cells("A4:A6")))
    assert (ivanov.student, petrov.student) == ("Иванов", "Петров")
    v, d, omega = ivanov.answers
    assert (v.value, v.step, v.sense, v.location) == (2.275, 0.001, Sense.LEFT, "Лист!C4")
    assert (d.value, d.step, d.location) == (3.41, 0.01, "Лист!C5")
    assert (omega.value, omega.is_blank, omega.sense) == (0.0, False, Sense.CCW)
    assert petrov.answers[0].is_blank
    assert not ivanov.remarks


def test_a_name_that_is_not_merged_counts_for_its_row_alone(tmp_path: Path) -> None:
    ivanov, _ = read(tmp_path, saved(ROWS))
    assert len(ivanov.answers) == 1
    assert [(r.reason, r.location) for r in ivanov.remarks] == [
        (Unread.STUDENT, "Лист!B5"),
        (Unread.STUDENT, "Лист!B6"),
    ]


def test_merged_answers_are_not_copied(tmp_path: Path) -> None:
    def merge(sheet: Any) -> None:
        sheet.merge_cells("A4:A6")
        sheet.merge_cells("C4:C6")

    ivanov, _ = read(tmp_path, saved(ROWS, merge))
    assert [answer.value for answer in ivanov.answers] == [2.275, None, None]


def test_a_wide_table_may_have_a_head_of_two_rows(tmp_path: Path) -> None:
    rows: list[list[Any]] = [
        ["№", "ФИО", "v_B3", None, None, "ω3, 1/с"],
        [None, None, "мм", "значение", "направление", None],
        [1, "Иванов", 45.5, 2.275, "←", 15.2],
        [2, "Петров", None, "2,3", None, 0],
    ]

    def merge(sheet: Any) -> None:
        for span in ("A1:A2", "B1:B2", "C1:E1", "F1:F2"):
            sheet.merge_cells(span)

    ivanov, petrov = read(tmp_path, saved(rows, merge))
    v, omega = ivanov.answers
    assert (ivanov.student, v.id, v.mm, v.value, v.sense) == (
        *("Иванов", "v_B3", 45.5, 2.275, Sense.LEFT),
    )
    assert (omega.id, omega.value, omega.unit) == ("ω3", 15.2, "1/с")
    assert petrov.answers[0].location == "Лист!D4"
    assert not ivanov.remarks


def test_digits_are_those_that_the_cell_shows(tmp_path: Path) -> None:
    def write(sheet: Any) -> None:
        for row, form in enumerate(("0.00", "General", "0", '0.000" м/с"'), 2):
            sheet.cell(row, 3, 2.5).number_format = form

    rows: list[list[Any]] = [["student", "what", "value"]]
    rows += (["s", f"v {point}"] for point in "ABCD")
    (work,) = read(tmp_path, saved(rows, write))
    assert [answer.step for answer in work.answers] == [0.01, 0.1, 0.1, 0.001]
    assert {answer.value for answer in work.answers} == {2.5}


@pytest.mark.parametrize(
    ("value", "why"),
    [
        (datetime.date(2026, 2, 1), Unread.DATE),
        (datetime.time(1, 2), Unread.DATE),
        (True, Unread.NUMBER),
        ("#REF!", Unread.NUMBER),
        ("=1+1", Unread.FORMULA),
    ],
)
def test_a_cell_that_is_not_a_number_is_reported(tmp_path: Path, value: Any, why: Unread) -> None:
    (work,) = read(tmp_path, saved([["student", "v_B"], ["s", value]]))
    (answer,) = work.answers
    assert (answer.reason, answer.location) == (why, "Лист!B2")
    assert not answer.is_blank


def test_a_formula_has_the_value_that_was_computed(tmp_path: Path) -> None:
    data = saved([["student", "v_B"], ["s", "=1+1"]])
    computed = patched(data, SHEET, lambda part: re.sub(b"<v ?/>|<v></v>", b"<v>2.25</v>", part))
    assert computed != data
    (work,) = read(tmp_path, computed)
    assert work.answers[0].value == 2.25


def test_every_sheet_that_is_shown_is_read(tmp_path: Path) -> None:
    def add(sheet: Any) -> None:
        for title, state in (("Петров", "visible"), ("Старое", "hidden"), ("Пусто", "visible")):
            other = sheet.parent.create_sheet(title)
            other.sheet_state = state
            if title != "Пусто":
                other.append(["what", "value"])
                other.append(["v B", 2])

    works = read(tmp_path, saved([["what", "value"], ["v B", 3]], add))
    assert [(work.student, work.answers[0].value) for work in works] == [("Лист", 3), ("Петров", 2)]


def test_a_span_over_the_whole_sheet_does_not_stop_the_program(tmp_path: Path) -> None:
    data = saved(ROWS, lambda sheet: sheet.merge_cells("A4:A6"))
    wide = patched(data, SHEET, lambda part: part.replace(b'"A4:A6"', b'"A1:XFD1048576"'))
    assert wide != data
    assert read(tmp_path, wide)


def far_row(part: bytes) -> bytes:
    return part.replace(b"</sheetData>", b'<row r="999999"><c r="A999999"/></row></sheetData>')


def test_an_empty_row_far_below_is_ignored(tmp_path: Path) -> None:
    data = patched(saved(ROWS), SHEET, far_row)
    assert [work.student for work in read(tmp_path, data)] == ["Иванов", "Петров"]


def filled(place: str) -> Callable[[], bytes]:
    cell = f'<row r="{place[-5:]}"><c r="{place}"><v>1</v></c></row></sheetData>'.encode()
    return lambda: patched(saved(ROWS), SHEET, lambda part: part.replace(b"</sheetData>", cell))


def with_many(what: bytes, count: int, where: bytes = b"</worksheet>") -> Callable[[], bytes]:
    return lambda: patched(saved(ROWS), SHEET, lambda p: p.replace(where, what * count + where))


def with_halves(what: bytes, count: int, where: bytes) -> Callable[[], bytes]:
    """Return what makes a workbook whose two sheets are too much together only."""

    def made() -> bytes:
        data = saved(ROWS, lambda sheet: sheet.parent.create_sheet("s1"))
        for sheet in (SHEET, SHEET.replace("1.", "2.")):
            data = patched(data, sheet, lambda part: part.replace(where, what * count + where))
        return data

    return made


def one_part_of_many_sheets(part: bytes) -> bytes:
    named = re.search(rb"<sheet [^>]*>", part)
    assert named is not None
    other = named[0].replace("Лист".encode(), b"s1").replace(b'sheetId="1"', b'sheetId="2"')
    return part.replace(named[0], named[0] + other)


def deep(part: bytes) -> bytes:
    return part.replace(b"</worksheet>", b"<x>" * 100 + b"</x>" * 100 + b"</worksheet>")


def bomb_by_another_name() -> bytes:
    stream = io.BytesIO(saved(ROWS))
    with zipfile.ZipFile(stream, "a", zipfile.ZIP_DEFLATED) as book:
        book.writestr("xl/sheet.dat", b" " * (17 * 2**20))
    return stream.getvalue()


def three_far_sheets() -> bytes:
    def add(sheet: Any) -> None:
        for number in range(3):
            sheet.parent.create_sheet(f"s{number}").cell(17_000, 4).value = 1

    return saved(ROWS, add)


def bomb() -> bytes:
    return patched(saved(ROWS), SHEET, lambda part: part + b" " * (17 * 2**20))


def entity() -> bytes:
    inner = "".join(f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 12))
    doctype = f'<!DOCTYPE x [<!ENTITY a0 "aaaaaaaaaa">{inner}]>'.encode()
    return patched(saved(ROWS), SHEET, lambda part: doctype + part.replace(b">2.275<", b">&a11;<"))


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (lambda: b"PK\x03\x04 nothing", "not an XLSX"),
        (lambda: b"\xd0\xcf\x11\xe0" + b"\0" * 600, "old or encrypted"),
        (lambda: saved([["a", "b"], [1, 2]]), "no sheet has a head"),
        (bomb, "17 MiB"),
        (bomb_by_another_name, "17 MiB"),
        (filled("OJ20000"), "extends to OJ20000: with it there are 8000000 cells"),
        (three_far_sheets, "extends to D17000: with it there are 204"),
        (with_many(b'<row r="9"><c r="A9"/></row>', 100_001, b"</sheetData>"), "over 200000 cells"),
        (with_many(b'<mergeCell ref="A1:B2"/>', 2001), "over 2000 merged ranges"),
        (
            with_halves(b'<row r="9"><c r="A9"/></row>', 50_001, b"</sheetData>"),
            "over 200000 cells",
        ),
        (with_halves(b'<mergeCell ref="A1:B2"/>', 1001, b"</worksheet>"), "'s1'.* 2000 merged"),
        (
            lambda: patched(saved(ROWS), "xl/workbook.xml", one_part_of_many_sheets),
            "'Лист' and 's1' are the same part",
        ),
        (with_many(b'<x y="%s"/>' % (b"z" * 70_000), 1), "too much content besides cells"),
        (with_many(b"<!--%s-->" % (b"z" * 70_000), 1), "too much content besides cells"),
        (with_many(b"<x/>", 60_001), "too much content besides cells"),
        (lambda: patched(saved(ROWS), SHEET, deep), "too much content besides cells"),
        (entity, "too much content besides cells|cannot be opened"),
        (lambda: patched(saved(ROWS), SHEET, lambda part: part[:-40]), "cannot be opened"),
        (lambda: saved([["student", "v_B"], *([n, 1] for n in range(2001))]), "2000 students"),
        (lambda: saved([["student", "v_B"], *([] for _ in range(20_000)), ["s", 1]]), "20002 rows"),
        (lambda: saved([["student", *([None] * 400), "v_B"], ["s", 1]]), "402 columns"),
    ],
    ids=[
        "zip",
        "xls",
        "head",
        "bomb",
        "dat",
        "far",
        "three",
        "cells",
        "spans",
        "cells of two",
        "spans of two",
        "part of two",
        "attribute",
        "remark",
        "parts",
        "deep",
        "entity",
        "cut",
        "students",
        "rows",
        "columns",
    ],
)
def test_a_fault_of_the_whole_file_is_an_error(
    tmp_path: Path, data: Callable[[], bytes], said: str
) -> None:
    with pytest.raises(SubmissionError, match=said):
        read(tmp_path, data())
