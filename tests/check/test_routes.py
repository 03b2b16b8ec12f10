"""A student's own formulas are followed and their slips named, whichever formula it is."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import pytest
from doors import GradedSubmission, Task, Verdict, check
from planted import exact, task_of, work_of

MECHANISMS = ("linkages/ex2", "linkages/ex3", "levers/six-link", "levers/task12")


def rounded(value: float) -> float:
    return float(f"{value:.4g}")


def graded(task: Task, change: Callable[[dict[str, float]], None]) -> GradedSubmission:
    """Return the check of exact answers to four digits, some of them changed."""
    values = {name: rounded(value) for name, value in exact(task).items()}
    change(values)
    return check(task, work_of(task, values))


def losing(checked: GradedSubmission) -> set[str]:
    return {one.id for one in checked.answers if one.points < one.of}


def accused(checked: GradedSubmission) -> set[str]:
    return {one.id for one in checked.answers if one.verdict is Verdict.INCONSISTENT}


def turnings(values: Mapping[str, float], letter: str = "omega") -> list[str]:
    return [name for name in values if name.startswith(letter) and abs(values[name]) > 1e-9]


@pytest.mark.parametrize("name", MECHANISMS)
def test_lengths_in_mm_in_every_omega_are_one_mistake_beside_normals_by_velocities(
    name: str,
) -> None:
    task = task_of(name)

    def change(values: dict[str, float]) -> None:
        for one in turnings(values):
            values[one] = rounded(values[one] / 1000.0)

    checked = graded(task, change)
    assert {code for one in checked.diagnosis for code in one.codes} == {"S2"}
    assert len(losing(checked)) == 1
    assert not accused(checked)


@pytest.mark.parametrize("name", MECHANISMS)
def test_one_omega_by_a_diameter_loses_its_points_alone(name: str) -> None:
    task = task_of(name)
    for one in turnings(exact(task)):

        def change(values: dict[str, float], one: str = one) -> None:
            values[one] = rounded(values[one] / 2.0)

        checked = graded(task, change)
        assert losing(checked) <= {one}, (one, losing(checked))
        assert {code for found in checked.diagnosis for code in found.codes} <= {"V5", "V6", "sign"}
        assert not accused(checked)
