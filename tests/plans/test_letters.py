"""Letters of the plans: the names of points there."""

from __future__ import annotations

from doors import (
    PlanKind,
    Solution,
    letter,
    mark,
    problem_loads as loads,
    solution_record as record,
)
from worked import path_of


def test_points_have_small_letters_and_their_indices() -> None:
    assert letter("B") == "b"
    assert letter("S2") == "s_{2}"
    assert mark("O3", "A") == "O_{3}A"


def test_a_point_p_does_not_take_the_letter_of_the_pole() -> None:
    text = path_of("linkages/ex1").read_text("utf-8")
    text = text.partition("[published")[0].replace('"D"', '"P"').replace("\nD =", "\nP =")
    solution = Solution(loads(text, name="p"))
    (position,) = record(solution)["positions"]
    segments = position["plans"]["velocity"]["segments"]
    assert set(segments) == {"p-b", "b-c", "p-c", "p-pP"}


def test_the_pole_has_the_letters_of_fixed_joints_alone() -> None:
    text = path_of("linkages/ex1").read_text("utf-8")
    text = text.partition("[published")[0].replace("\nA = [", "\nK = [0.3, 0.2]\nA = [")
    letters = Solution(loads(text, name="k")).construction.plan(PlanKind.VELOCITY).letters
    assert sorted(letters.values()) == ["a", "b", "c", "d"]
