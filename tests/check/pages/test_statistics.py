"""Statistics of a group."""

from __future__ import annotations

import io
import random
import re

import ex3_work
import numpy as np
import openpyxl
import pytest
from doors import (
    WORDING_LANGUAGES as LANGUAGES,
    Fill,
    GradedAnswer,
    GradedSubmission,
    Submission,
    Verdict,
    bars,
    get_language,
    group_html,
    results_xlsx,
    statistics_of,
)
from msgspec.structs import replace

SCALE = ("5", "4", "3", "2")


def group(table: list[list[float]]) -> list[GradedSubmission]:
    """Works with these points, each answer out of 1."""
    entries = ex3_work.entries()
    works = []
    for number, row in enumerate(table):
        answers = tuple(
            GradedAnswer(key.id, Verdict.OK if p else Verdict.WRONG, key, points=p, of=1.0)
            for key, p in zip(entries, row, strict=False)
        )
        works.append(
            GradedSubmission(
                Submission(f"s{number:02}", ()), None, answers, points=sum(row), of=len(row)
            )
        )
    return works


def test_difficulty_and_discrimination_are_those_of_numpy() -> None:
    rng = random.Random(3)
    able = [rng.random() for _ in range(30)]
    table = [[float(rng.random() < skill) for _ in range(8)] for skill in able]
    found = statistics_of(group(table), ["4"] * 30, SCALE)
    assert found is not None
    whole = np.array(table)
    assert found.mean == pytest.approx(whole.mean()) and found.deviation == pytest.approx(
        whole.mean(1).std()
    )
    assert found.median == pytest.approx(np.median(whole.mean(1)))
    for number, one in enumerate(found.questions):
        rest = np.delete(whole, number, axis=1).sum(1)
        assert one.mean_fraction == pytest.approx(whole[:, number].mean())
        assert one.discrimination == pytest.approx(np.corrcoef(whole[:, number], rest)[0, 1])
    assert [one.label for one in found.questions] == [e.label for e in ex3_work.entries()[:8]]


def test_marks_that_no_student_has_are_counted_as_zero() -> None:
    works = group([[1.0, 1.0], [1.0, 0.0], [0.0, 0.0]])
    found = statistics_of(works, ["5", "3", "2"], SCALE)
    assert found is not None and found.marks == (("5", 1), ("4", 0), ("3", 1), ("2", 1))
    assert statistics_of(works[:1], ["5"], SCALE) is None
    nothing = replace(works[0], of=0.0, answers=())
    assert statistics_of([works[0], nothing], ["5", ""], SCALE) is None


def test_unread_answers_and_unanimous_answers_have_no_discrimination() -> None:
    works = group([[1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 1.0]])
    unread = replace(works[0].answers[1], verdict=Verdict.UNREADABLE, points=0.0, of=0.0)
    works[0] = replace(
        works[0], answers=(works[0].answers[0], unread, works[0].answers[2]), points=1.0, of=2.0
    )
    found = statistics_of(works, ["3", "3", "5"], SCALE)
    assert found is not None
    alike, partly, third = found.questions
    assert (
        alike.discrimination,
        alike.mean_fraction,
        partly.submissions,
        partly.discrimination,
    ) == (
        None,
        1.0,
        2,
        None,
    )
    assert third.discrimination == pytest.approx(np.corrcoef([0, 0, 1], [1.0, 0.5, 1.0])[0, 1])


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_sheet_and_the_page_show_the_same(lang: str) -> None:
    works = [
        ex3_work.work("s01"),
        ex3_work.work("<b>s02</b>"),
        *group([[1.0] * 9, [0.0] * 9, [1.0, 0.0] * 4 + [1.0]]),
    ]
    words = get_language(lang)
    marks = ["4", "4", "5", "2", "3"]
    found = statistics_of(works, marks, SCALE)
    assert found is not None
    say = words.check["statistics"]
    data = results_xlsx(works, words, marks=marks, group=found)
    book = openpyxl.load_workbook(io.BytesIO(data))
    assert book.sheetnames[-2] == say.sheet and len(book.sheetnames) == 5
    sheet = book[say.sheet]
    rows = [[cell.value for cell in row[:4]] for row in sheet.iter_rows()]
    assert rows[1:5] == [
        ["5", 1, None, None],
        ["4", 2, None, None],
        ["3", 1, None, None],
        ["2", 1, None, None],
    ]
    head = rows.index(list(say["columns"]))
    shares = [row[2] for row in rows[head + 1 :]]
    assert shares == pytest.approx([one.mean_fraction for one in found.questions])
    assert len(sheet._charts) == 2
    assert data == results_xlsx(works, words, marks=marks, group=found)
    page = group_html(found, works, "{a} & <i>", words)
    assert page.count("<svg") == 2 and "&lt;b&gt;s02" in page and "<b>s02" not in page
    assert "&lt;i&gt;" in page and words.check["mistakes"]["A1"].name in page
    assert re.search(r"v<sub>B3</sub>", page)


def test_bars_are_as_long_as_their_values() -> None:
    drawing = bars([("a", 0.5, "50 %"), ("b", 1.0, "100 %"), ("c", 0.0, "0 %")], maximum=1.0)
    widths = [
        max(p.real for p in item.points) - min(p.real for p in item.points)
        for item in drawing.items
        if isinstance(item, Fill)
    ]
    assert widths == pytest.approx([45.0, 90.0])
