"""The table of mistakes that checking names and forgives: its counts of verdicts, by families."""

from __future__ import annotations

import pytest
from click.testing import CliRunner
from doors import (
    Calculation,
    Detected,
    GradedSubmission,
    Submission,
    Task,
    check,
    cli,
    confusion,
    detection,
    first_items,
    kind_of,
    tasks_of,
)
from msgspec.structs import replace
from worked import path_of, problem_of


def computed(name: str) -> Calculation:
    kind = kind_of(path_of(name))
    (task,) = confusion.tasks_of_kinds([(kind, kind.load(path_of(name), None))])
    assert isinstance(task, Calculation)
    return task


@pytest.mark.parametrize("name", ["gears/gears-ex3", "point/k11-02"])
def test_mistakes_in_trains_and_points_are_seen_and_named_among_few(name: str) -> None:
    """Before, a written zero was also "a decimal place" and "another unit": one of four."""
    task = computed(name)
    rows = confusion.computed_detection(task, 2)
    assert len(rows) > 3
    for row in rows:
        assert row.works == row.noticed == row.named + row.among, row
    honest = confusion.check_computed(task, 10)
    assert (honest.works, honest.faulted, honest.named) == (10, 0, 0)
    inherited = confusion.computed_inherited(task, 2)
    assert inherited.answers > 0 == inherited.faulted


def test_two_mistakes_are_counted_once(monkeypatch: pytest.MonkeyPatch) -> None:
    (task,) = tasks_of([problem_of("linkages/ex1")])
    row = confusion.two_at_once(task, 1)
    assert row.works == row.named + row.among + row.unknown + row.misnamed > 5
    assert row.named + row.among > row.works * 2 / 3 and not row.misnamed

    def dumb(task: Task, work: Submission) -> GradedSubmission:
        return replace(check(task, work), diagnosis=())

    monkeypatch.setattr(confusion, "check", dumb)
    row = confusion.two_at_once(task, 1)
    assert row.unknown == row.works > 5


@pytest.mark.dear
def test_results_of_a_students_own_number_lose_no_points(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """In example 3; by other routes none, of drawn plans few, after an unexplained a_B.

    Of drawn works 8 of 399 answers lose points, of twice as many works 14 of 798.
    """
    (task,) = tasks_of([problem_of("linkages/ex3")])
    found = confusion.by_routes(task, 1)
    assert found.answers > 30 and not found.faulted, found
    found = confusion.by_plans(task, 3)
    assert found.answers > 300 and found.faulted <= 0.025 * found.answers, found

    def unfair(task: Task, work: Submission) -> GradedSubmission:
        found = check(task, work)
        return replace(found, answers=tuple(replace(a, points=0.0) for a in found.answers))

    monkeypatch.setattr(confusion, "check", unfair)
    (least,) = tasks_of([problem_of("linkages/ex1")])
    found = confusion.by_routes(least, 1)
    assert found.faulted == found.answers > 0


def test_the_angle_of_another_variant_is_rightly_called_that_variant() -> None:
    names = ("А", "Б")
    first, _ = tasks_of([problem_of("levers/task12-variants", name) for name in names])
    (row,) = [row for row in detection(first, 1) if row.code == "P1"]
    assert row.works and not row.misnamed, row


def test_the_section_takes_problems_that_are_computed() -> None:
    files = [str(path_of(name)) for name in ("gears/gears-ex1", "point/k11-01")]
    run = CliRunner().invoke(cli, ["bench", "--only", "checking", "--works", "1", *files])
    assert run.exit_code == 0, run.output
    for words in ("## By families", "| trains, one mistake |", "| points, one mistake |"):
        assert words in run.output
    assert "## Submissions without a mistake" not in run.output  # nothing of these is drawn
    run = CliRunner().invoke(cli, ["bench", *files])
    assert run.exit_code != 0  # the other sections measure linkages


def test_families_are_counted_apart() -> None:
    task = computed("gears/gears-ex1")
    rows = confusion.computed_detection(task, 1)
    assert all(isinstance(row, Detected) and row.family == "gears" for row in rows)


def test_a_computed_answer_is_known_to_its_last_digit() -> None:
    task = computed("point/k11-02")
    values = task.sheet(first_items(task)[0].position).exact_answers
    digits = [
        len(f"{round(abs(answer.value) / answer.step)}")
        for work in confusion.compute_submissions(task, values, 20, 1)
        for answer in work.answers
        if answer.step and answer.value
    ]
    assert {*digits} == {3, 4}
