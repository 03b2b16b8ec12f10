from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from doors import (
    ExitCode,
    Sense,
    Submission,
    SubmissionsSubmissionError as SubmissionError,
    Unread,
    read_works,
)

GOOD: dict[str, Any] = {
    "schema": 1,
    "student": "s02",
    "problem": "ex3",
    "variant": None,
    "scales": {"mu_l": 0.002, "mu_v": 0.05, "mu_a": 1.0},
    "ruler_mm": 0.5,
    "answers": [
        {"id": "v_B3", "what": "v B3", "value": 2.275, "unit": "m/s", "mm": 45.5}
        | {"segment": "p b3", "sense": "left"},
        {"what": "omega 3", "value": 15, "sense": "ccw", "position": 2},
        {"id": "a_E"},
    ],
}


def read(folder: Path, whole: Any, name: str = "s.json") -> list[Submission]:
    path = folder / name
    path.write_text(whole if isinstance(whole, str) else json.dumps(whole), "utf-8")
    return read_works(path)


def read_one(folder: Path, **changes: Any) -> Submission:
    (work,) = read(folder, GOOD | changes)
    return work


def test_one_student_is_read(tmp_path: Path) -> None:
    work = read_one(tmp_path)
    assert (work.student, work.problem, work.variant, work.ruler_mm) == ("s02", "ex3", None, 0.5)
    assert work.scales == {"mu_l": 0.002, "mu_v": 0.05, "mu_a": 1.0}
    assert not work.remarks
    first, second, third = work.answers
    assert (first.what, first.id, first.unit, first.segment) == ("v B3", "v_B3", "m/s", "p b3")
    assert (first.value, first.step, first.mm, first.mm_step) == (2.275, 0.001, 45.5, 0.1)
    assert (first.sense, first.location, first.raw) == (Sense.LEFT, "answers[0]", "2.275")
    assert (second.value, second.step, second.position) == (15.0, 1.0, 2)
    assert third.is_blank


def test_digits_count_as_they_are_written(tmp_path: Path) -> None:
    text = '{"student": "a", "answers": [{"id": "x", "value": 2.30}, {"id": "y", "value": 1.2e3}]}'
    first, second = read(tmp_path, text)[0].answers
    assert (first.value, first.step) == (2.3, 0.01)
    assert (second.value, second.step) == (1200.0, 100.0)


def test_a_zero_is_an_answer_and_null_is_not(tmp_path: Path) -> None:
    answers = [{"id": "x", "value": 0}, {"id": "y", "value": None}, {"id": "z", "value": "—"}]
    nought, null, dash = read_one(tmp_path, answers=answers).answers
    assert not nought.is_blank
    assert null.is_blank and dash.is_blank


@pytest.mark.parametrize(
    ("answer", "why", "where"),
    [
        ({"value": "abc"}, Unread.NUMBER, "answers[0].value"),
        ({"value": [1]}, Unread.NUMBER, "answers[0].value"),
        ({"value": True}, Unread.NUMBER, "answers[0].value"),
        ({"value": 3, "unit": "кв"}, Unread.UNIT, "answers[0].unit"),
        ({"value": "3 попугая"}, Unread.UNIT, "answers[0].value"),
        ({"mm": "x"}, Unread.NUMBER, "answers[0].mm"),
        ({"mm": "3 кН"}, Unread.UNIT, "answers[0].mm"),
        ({"value": 3, "sense": "+"}, Unread.SENSE, "answers[0].sense"),
        ({"value": 3, "position": -1}, Unread.POSITION, "answers[0].position"),
        ({"value": 3, "position": 1.5}, Unread.POSITION, "answers[0].position"),
    ],
)
def test_a_fault_of_one_answer_is_reported_with_its_place(
    tmp_path: Path, answer: dict[str, Any], why: Unread, where: str
) -> None:
    answers = [{"id": "v_C"} | answer, {"id": "v_D", "value": 1}]
    first, second = read_one(tmp_path, answers=answers).answers
    assert (first.id, first.reason, first.location) == ("v_C", why, where)
    assert first.unreadable and first.fault
    assert not first.is_blank
    assert second.value == 1.0 and not second.unreadable


def test_nan_is_no_number(tmp_path: Path) -> None:
    text = '{"student": "a", "answers": [{"id": "x", "value": NaN}, {"id": "y", "value": 1e999}]}'
    assert [answer.reason for answer in read(tmp_path, text)[0].answers] == [Unread.NUMBER] * 2


def test_an_answer_given_twice_is_not_read_unless_both_agree(tmp_path: Path) -> None:
    one, other = {"id": "x", "value": 2}, {"id": "x", "value": 3}
    assert len(read_one(tmp_path, answers=[one, one]).answers) == 1
    first, second = read_one(tmp_path, answers=[one, other]).answers
    assert (first.value, first.reason) == (2.0, None)
    assert (second.reason, second.location) == (Unread.TWICE, "answers[1]")
    (joined,) = read_one(tmp_path, answers=[one, {"id": "x", "mm": 40}]).answers
    assert (joined.value, joined.mm) == (2.0, 40.0)
    several = read_one(tmp_path, answers=[one, other | {"position": 1}]).answers
    assert not any(answer.reason for answer in several)


@pytest.mark.parametrize(
    ("changes", "why", "where"),
    [
        ({"scales": {"mu_v": 0}}, Unread.SCALE, "scales.mu_v"),
        ({"scales": {"mu_v": "x"}}, Unread.SCALE, "scales.mu_v"),
        ({"scales": {"mu_x": 1}}, Unread.SCALE, "scales.mu_x"),
        ({"scales": {"mu_v": "0,05 кН"}}, Unread.SCALE, "scales.mu_v"),
        ({"scales": [1]}, Unread.SCALE, "scales"),
        ({"ruler_mm": "x"}, Unread.NUMBER, "ruler_mm"),
        ({"studnet": "x"}, Unread.KEY, "studnet"),
        ({"answers": [{"id": "x", "vlaue": 2}]}, Unread.KEY, "answers[0].vlaue"),
        ({"answers": [7]}, Unread.QUANTITY, "answers[0]"),
        ({"answers": [{"value": 7}]}, Unread.QUANTITY, "answers[0]"),
    ],
)
def test_an_entry_that_is_not_an_answer_goes_to_the_remarks(
    tmp_path: Path, changes: dict[str, Any], why: Unread, where: str
) -> None:
    (remark,) = read_one(tmp_path, **changes).remarks
    assert (remark.reason, remark.location) == (why, where)


@pytest.mark.parametrize(
    ("text", "scale"),
    [
        ("0,05", 0.05),
        ("0,05 (м/с)/мм", 0.05),
        ("0,05 м/(с·мм)", 0.05),
        ("0,05 м/с·мм", 0.05),
        ("0,05 м/с", 0.05),
        ("50 (мм/с)/мм", 0.05),
    ],
)
def test_a_scale_is_per_millimetre_however_it_is_written(
    tmp_path: Path, text: str, scale: float
) -> None:
    work = read_one(tmp_path, scales={"μᵥ": text})
    assert work.scales == {"mu_v": pytest.approx(scale, rel=1e-12)}


def test_the_scale_of_lengths_may_be_a_ratio(tmp_path: Path) -> None:
    assert read_one(tmp_path, scales={"mu_l": "М 1:2"}).scales == {"mu_l": 0.002}
    assert read_one(tmp_path, scales={"mu_v": "1:2"}).remarks[0].reason is Unread.SCALE


def test_half_characters_are_reported_by_place_and_stop_no_other_work(tmp_path: Path) -> None:
    answers = [{"what": "v B", "value": 1}, {"what": "v C", "value": "2 \ud800"}]
    whole = [{"student": "\ud800Ив", "answers": answers}, {"student": "B", "answers": []}]
    first, second = read(tmp_path, whole)
    assert (first.student, second.student) == ("s [0]", "B")
    assert [(one.reason, one.location) for one in first.remarks] == [(Unread.TEXT, "[0].student")]
    assert [one.value for one in first.answers] == [1, None]
    assert first.answers[1].location == "[0].answers[1].value"
    for text in (first.student, *(one.fault + one.unreadable for one in first.answers)):
        text.encode()


def test_no_terminal_sequence_is_in_the_texts_read(tmp_path: Path) -> None:
    work = read_one(tmp_path, student="\x1b[2J\u202eИв", answers=[{"what": "\x1b]0;v", "value": 1}])
    said = " ".join((work.student, *(a.what + a.id + a.raw + a.fault for a in work.answers)))
    assert "\x1b" not in said
    assert "\u202e" not in said
    assert "Ив" in said


def test_points_may_have_other_names(tmp_path: Path) -> None:
    answers = [{"what": "v K"}, {"id": "a_K3", "segment": "p k3"}, {"what": "v D K"}]
    work = read_one(tmp_path, answers=answers, names={"K": "B", "D": "E"})
    assert [answer.what for answer in work.answers] == ["v B", "", "v E B"]
    assert (work.answers[1].id, work.answers[1].segment) == ("a_B3", "p b3")
    kinds = read_one(
        tmp_path, answers=[{"what": "M 5 0"}, {"id": "v_M"}], names={"M": "B", "v": "C"}
    )
    assert [answer.what or answer.id for answer in kinds.answers] == ["M 5 0", "v_B"]


def test_look_alike_letters_become_latin_in_the_name_of_an_answer(tmp_path: Path) -> None:
    (answer,) = read_one(tmp_path, answers=[{"what": "v В3"}]).answers
    assert answer.what == "v B3"
    (answer,) = read_one(tmp_path, answers=[{"what": "VB₃"}]).answers
    assert (answer.what, answer.id) == ("", "VB₃")


def test_toml_and_lists_of_students_are_read(tmp_path: Path) -> None:
    text = 'student = 7\nscales.mu_v = 0.05\n[[answers]]\nwhat = "v B3"\nvalue = 2.275\n'
    (work,) = read(tmp_path, text, "s.toml")
    assert (work.student, work.scales, work.answers[0].step) == ("7", {"mu_v": 0.05}, 0.001)
    one, two = read(tmp_path, [GOOD, GOOD | {"student": "s03"}])
    assert (one.student, two.student) == ("s02", "s03")
    assert two.answers[0].location == "[1].answers[0]"


def test_a_work_without_a_student_is_named_after_its_file(tmp_path: Path) -> None:
    (work,) = read(tmp_path, {"answers": []}, "Петров.json")
    assert work.student == "Петров"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "not JSON"),
        ("[" * 100_000, "nested too deeply"),
        ("3", "expected an object"),
        ('{"student": "a"}', 'expected an object with "student" and "answers"'),
        ('{"answers": 3}', "'answers' must be a list"),
        ('{"schema": 2, "answers": []}', "schema 2"),
        ('{"schema": true, "answers": []}', "schema True"),
    ],
)
def test_a_fault_of_the_whole_file_is_an_error(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(SubmissionError, match=said) as error:
        read(tmp_path, text)
    assert error.value.exit_code is ExitCode.USAGE


def test_a_file_without_works_is_an_error(tmp_path: Path) -> None:
    large = tmp_path / "large.json"
    large.write_bytes(b" " * (4 * 2**20 + 1))
    for path in (tmp_path, tmp_path / "none.json", large, tmp_path / "a\0b.json"):
        with pytest.raises(SubmissionError):
            read_works(path)
    with pytest.raises(SubmissionError, match="not one of"):
        read(tmp_path, "", "work.docx")
