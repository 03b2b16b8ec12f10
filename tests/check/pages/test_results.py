"""Records and tables of judged works."""

from __future__ import annotations

import csv
import io
import json
from zipfile import ZipFile

import ex3_work
import openpyxl
import pytest
from doors import (
    LISTING_COLUMNS as COLUMNS,
    WORDING_LANGUAGES as LANGUAGES,
    Diagnosis,
    GradedAnswer,
    Verdict,
    WrittenAnswer,
    add_sheet,
    csv_bytes,
    get_language,
    listing_record as record,
    new_workbook,
    results_xlsx,
    safe,
    saved,
)
from msgspec.structs import replace

ANSWER = ("id", "verdict", "from", "value", "exact", "tolerance", "mm", "exact_mm", "points")


def test_a_record_has_the_keys_of_the_contract_and_no_nan() -> None:
    work = ex3_work.work()
    odd = replace(work.answers[0], value=float("nan"), tolerance=float("inf"))
    told = record(replace(work, answers=(odd, *work.answers[1:])))
    json.dumps(told, allow_nan=False)
    assert list(told)[:6] == ["student", "variant", "answers", "diagnosis", "points", "of"]
    first = told["answers"][0]
    assert first.keys() > {*ANSWER, "where"} and first["value"] is None
    inherited = next(a for a in told["answers"] if a["id"] == "a_E")
    assert (inherited["verdict"], inherited["from"]) == ("inherited", "a_B3")
    assert told["diagnosis"] == [
        {"codes": ["A1"], "sure": True, "roots": ["a_B3"], "where": "B3/2"}
    ]


def test_a_size_is_recorded_without_its_sign() -> None:
    key = replace(ex3_work.entries()[0], exact=-2.0, signed=False)
    judged = GradedAnswer("v", Verdict.OK, key, WrittenAnswer(id="v"), value=-2.01, local=-2.02)
    told = record(replace(ex3_work.work(), answers=(judged,)))["answers"][0]
    assert (told["exact"], told["value"], told["local"]) == (2.0, 2.01, 2.02)


def test_an_unknown_answer_is_recorded_too() -> None:
    odd = GradedAnswer(
        "q_7", Verdict.UNREADABLE, written=WrittenAnswer(what="q 7", location="g.csv:3")
    )
    work = replace(ex3_work.work(), answers=(odd,))
    told = record(work)["answers"][0]
    assert (told["exact"], told["where"]) == (None, "g.csv:3")
    for lang in LANGUAGES:
        assert results_xlsx([work], get_language(lang))
    assert csv_bytes([work]).decode("utf-8-sig").count("q_7") == 1


def test_the_csv_has_full_numbers_and_its_columns() -> None:
    work = ex3_work.work()
    rows = list(csv.DictReader(io.StringIO(csv_bytes([work]).decode("utf-8-sig")), delimiter=";"))
    assert tuple(rows[0]) == COLUMNS and len(rows) == len(work.answers)
    assert float(rows[0]["exact"]) == work.answers[0].key.exact  # type: ignore[union-attr]
    assert next(row["codes"] for row in rows if row["id"] == "a_B3") == "A1"


@pytest.mark.parametrize("name", ["=1+1", "+1", "-2", "@cmd", "\tx"])
def test_a_text_that_looks_like_a_formula_is_a_text(name: str) -> None:
    work = ex3_work.work(name)
    assert safe(name) == f"'{name}"
    first = csv_bytes([work]).decode("utf-8-sig").splitlines()[1]
    assert first.lstrip('"').startswith(f"'{name}")
    book = openpyxl.load_workbook(io.BytesIO(results_xlsx([work], get_language("ru"))))
    cell = book.worksheets[0]["A2"]
    assert cell.data_type == "s" and cell.value.strip() == name.strip()


def test_the_workbook_agrees_with_the_graded_works() -> None:
    works = [ex3_work.work("s01"), ex3_work.work("s02")]
    unsure = Diagnosis(("A1", "A3"), False, ("a_B3",))
    works[1] = replace(works[1], diagnosis=(unsure,), suspicious=True)
    words = get_language("ru")
    first, *others = works[0].answers
    assert first.key is not None
    first = replace(first, key=replace(first.key, what="v B3"))
    works[0] = replace(works[0], answers=(first, *others))
    data = results_xlsx(works, words, marks=["4", "5"], settings={"k": 2.5})
    book = openpyxl.load_workbook(io.BytesIO(data))
    assert tuple(book.sheetnames) == words.check["results"]["sheets"]
    summary, answers, mistakes, settings = book.worksheets
    told = [[cell.value for cell in row] for row in summary.iter_rows()]
    head = told[0].index(words.check["verdicts"]["inherited"])
    assert (told[1][2], told[1][5], told[1][head]) == (8, "4", 3)
    assert told[1][-2].startswith("A1 ") and words.check["results"].perhaps in told[2][-2]
    assert words.check["results"].suspicious in told[2][-1]
    assert answers.max_row == 1 + 2 * len(ex3_work.entries())
    assert answers["D2"].value == "скорость точки B3, v_B3"
    assert summary.freeze_panes == "B2" and answers.freeze_panes == "D2"
    counted = [[cell.value for cell in row] for row in mistakes.iter_rows()]
    assert counted[1][:4] == ["A1", words.check["mistakes"]["A1"].name, 1, 1]
    assert counted[1][4] == "s01, s02?"
    shares = {row[0]: row[3] for row in counted[5:]}
    assert shares["v_B3"] == 1 and shares["a_B3"] == 0
    assert [cell.value for cell in settings[2]] == ["k", 2.5]


def test_verdicts_are_written_in_words_beside_the_colour() -> None:
    book = openpyxl.load_workbook(io.BytesIO(results_xlsx([ex3_work.work()], get_language("ru"))))
    said = {
        row[4].value: row[4].fill.fgColor.rgb for row in book.worksheets[1].iter_rows(min_row=2)
    }
    assert len(said) == 4 and len(set(said.values())) == 4


def test_a_workbook_has_no_clock_in_it() -> None:
    def made() -> bytes:
        book = new_workbook()
        add_sheet(book, "A", ["x"], [[1.5], ["text"]])
        return saved(book)

    data = made()
    assert data == made()
    with ZipFile(io.BytesIO(data)) as file:
        assert {entry.date_time[0] for entry in file.infolist()} == {1980}
        assert b"1980-01-01" in file.read("docProps/core.xml")


def test_a_missing_number_is_an_empty_cell() -> None:
    book = new_workbook()
    add_sheet(book, "A", ["x"], [[float("nan")], [float("inf")], [1.0]])
    told = [row[0].value for row in openpyxl.load_workbook(io.BytesIO(saved(book)))["A"].rows]
    assert told == ["x", None, None, 1]


def test_signs_that_no_workbook_holds_are_left_out() -> None:
    book = new_workbook()
    add_sheet(book, "A", ["x"], [["a\x00b\ud800"], ["y" * 5000]])
    told = [row[0].value for row in openpyxl.load_workbook(io.BytesIO(saved(book)))["A"].rows]
    assert told[1] == "a b " and len(told[2]) == 1000
