"""Works drawn by the pencil: the same from the same seed, honest ones right, planted ones seen."""

from __future__ import annotations

from collections import Counter
from functools import cache

import numpy as np
import pytest
from doors import (
    GradedSubmission,
    Sense,
    Solution,
    Task,
    Variants,
    Verdict,
    as_written,
    check,
    check_works,
    checking,
    key_of_task,
    planted,
    read_works,
    simulate_submissions,
)
from worked import ROOT, problem_of

from benchmarks import group

FILE = ROOT / group.TARGET


@cache
def ex3() -> Task:
    return Task(Solution(problem_of("linkages/ex3")))


def test_the_same_seed_draws_the_same_works() -> None:
    assert simulate_submissions(ex3(), count=3, seed=5) == simulate_submissions(
        ex3(), count=3, seed=5
    )
    assert simulate_submissions(ex3(), count=3, seed=5) != simulate_submissions(
        ex3(), count=3, seed=6
    )


def test_numbers_have_three_figures_and_four_behind_a_one() -> None:
    values, steps = as_written(np.array([3.91584, 0.0123456, -1274.4, 0.0]))
    assert values == pytest.approx([3.92, 0.01235, -1274.0, 0.0])
    assert steps[:3] == pytest.approx([0.01, 1e-5, 1.0])


def test_drawn_values_err_as_much_as_the_tolerance_assumes() -> None:
    works = simulate_submissions(ex3(), count=400, seed=1)
    compared = 0
    for entry in key_of_task(ex3()).entries:
        if entry.sigma > 0.01 * abs(entry.exact):  # more than the rounding of written values
            values = [next(a.value for a in w.answers if a.id == entry.id) for w in works]
            spread = np.std(np.abs(np.array(values, dtype=float)))
            assert spread == pytest.approx(entry.sigma, rel=0.25), entry
            compared += 1
    assert compared > 12


def test_lengths_are_on_the_ruler_and_give_the_values_at_the_students_scale() -> None:
    (work,) = simulate_submissions(ex3(), scales={"mu_v": 0.04}, mm=True)
    answer = next(a for a in work.answers if a.id == "v_B3")
    assert answer.mm is not None and answer.value is not None
    assert answer.mm * 2 == round(answer.mm * 2)
    assert answer.value == pytest.approx(answer.mm * 0.04, rel=0.003)
    assert check(ex3(), work).points == check(ex3(), work).of


def test_senses_are_given_where_they_are_required() -> None:
    (work,) = simulate_submissions(ex3())
    told = {answer.id: answer.sense for answer in work.answers if answer.sense}
    assert set(told.values()) == {Sense.CCW, Sense.CW}
    assert len(told) == sum(item.asks_sense for item in ex3().declared)


def test_honest_works_are_rarely_faulted_or_called_mistaken() -> None:
    found = checking.check_faultless(ex3(), 60)
    assert found.works == 60
    assert found.answers == 60 * len(ex3().declared)
    assert found.faulted / found.answers <= 0.015
    assert found.named <= 0.03 * found.works
    assert found.flat[0.05] > 10 * found.faulted


@pytest.mark.parametrize("name", ["linkages/ex1", "linkages/ex3"])
def test_planted_mistakes_are_found_and_rarely_named_wrongly(name: str) -> None:
    rows = checking.detection(Task(Solution(problem_of(name))), 1)
    whole = {"V1", "V2", "A1", "A2", "A3", "N1", "N4", "P1", "true_mm"}
    works = sum(row.works for row in rows if row.code in whole)
    assert works >= 9
    assert sum(row.noticed for row in rows if row.code in whole) == works
    assert sum(row.named for row in rows if row.code in whole) >= 0.85 * works
    assert sum(row.misnamed for row in rows if row.code in whole) == 0
    assert sum(row.misnamed for row in rows) <= 0.05 * sum(row.works for row in rows)


def test_the_key_lists_mistakes_that_the_bench_does_not_plant() -> None:
    key = key_of_task(ex3())
    sheet = ex3().sheet(0)
    for change in planted(sheet, ex3().declared):
        explanation = ex3().explanations(sheet).of_change(change)
        if explanation is None or change.code in ("S2", "S4", "V6", "N5", "scale"):
            continue  # of one number: the key speaks of the plans
        values = [explanation.values[item.question.id] for item in ex3().declared]
        shown = any(map(checking.shows, key.entries, values))
        assert shown or change.mistake_at in key.hidden[change.code], change


# The group of thirty -------------------------------------------------------------------------


@cache
def checked_group() -> tuple[GradedSubmission, ...]:
    return tuple(check_works(Variants(ROOT / group.PROBLEM), read_works(FILE)))


def test_the_file_is_one_that_a_spreadsheet_program_saves() -> None:
    data = FILE.read_bytes()
    assert data.startswith(b"\xef\xbb\xbf")
    assert data.count(b"\r\n") == data.count(b"\n") > 570
    lines = data.decode("utf-8-sig").splitlines()
    assert lines[0] == ";".join(group.HEAD)
    assert not any("." in field for line in lines[1:] for field in [line.split(";")[3]])


def test_the_file_has_the_group_that_it_is_made_of() -> None:
    assert [one.work.student for one in checked_group()] == [one.name for one in group.GROUP]
    assert [one.variant for one in checked_group()] == [one.variant for one in group.GROUP]
    assert len({one.code for one in group.GROUP if one.code}) >= 12


def test_honest_students_lose_points_only_for_blanks() -> None:
    for student, checked in zip(group.GROUP, checked_group(), strict=True):
        if student.code:
            continue
        assert not checked.diagnosis, student
        lost = [a for a in checked.answers if a.points < a.of and a.verdict is not Verdict.NEAR]
        assert all(a.verdict is Verdict.BLANK or a.is_open for a in lost), student
        assert len(lost) == len(student.skips) + len(checked.open)


def test_most_planted_mistakes_of_the_group_are_named_and_few_wrongly() -> None:
    counted: Counter[str] = Counter()
    for student, checked in zip(group.GROUP, checked_group(), strict=True):
        sure = {d.codes[0] for d in checked.diagnosis if d.sure}
        counted["planted"] += student.code != ""
        counted["named"] += student.code in sure
        counted["among"] += any(student.code in d.codes for d in checked.diagnosis)
        counted["wrongly"] += bool(sure - {student.code})
    assert counted["named"] >= 0.7 * counted["planted"]
    assert counted["among"] >= 0.9 * counted["planted"]
    assert counted["wrongly"] <= 1


def test_the_one_cell_that_cannot_be_read_is_named_and_is_open() -> None:
    found = [
        (one.work.student, a) for one in checked_group() for a in one.answers
        if a.verdict is Verdict.UNREADABLE
    ]  # fmt: skip
    ((student, answer),) = found
    assert (student, answer.points, answer.of) == ("Чернов Тимур", 0.0, 1.0)
    assert [one.work.student for one in checked_group() if one.is_provisional] == [student]
    assert answer.location.startswith("ex3.csv:")
