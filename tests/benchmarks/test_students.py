"""The simulator of students: its geometry, honest hands, and habits that do what they say."""

from __future__ import annotations

import ast
import cmath
import math
import sys
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest
from cases import each
from click.testing import CliRunner
from doors import cli

from benchmarks import checking
from benchmarks.checking import students
from benchmarks.checking.calculated import coordinate
from benchmarks.checking.drawing import Drawing
from benchmarks.checking.habits import NAMES, codes_of
from benchmarks.checking.hand import Answer, Hand, ImpossibleError, Student
from benchmarks.checking.report import students_section
from benchmarks.checking.tasks import FOLDER, PROBLEMS, Problem
from benchmarks.checking.works import EXACT, hand_of, make_group, table

BY_NAME = {problem.name: problem for problem in PROBLEMS}
DRAWN = [problem for problem in PROBLEMS if problem.drawn]
SAME = {
    "crank turned the other way", "aⁿ away from the centre", "Coriolis turned the other way",
    "inertia force along the acceleration", "R^τ of the other sense",
}  # fmt: skip
"""Habits that change no size of their own answer, but senses or later answers."""


def exact(problem: Problem, data: Any, **hand: Any) -> Student:
    return problem.work(data, Hand("x", 0.0, 0.0, 0.0, 0.0, digits=14, **hand))


def points(problem: Problem, data: Any, turn: float) -> dict[str, complex]:
    moved = deepcopy(data)
    moved["driver"]["phi"] += math.degrees(turn)
    student = problem.work(moved, EXACT)
    assert isinstance(student, Drawing)
    return student.true


def omega_of(data: Any) -> float:
    driver = data["driver"]
    return float(driver["omega"] if "omega" in driver else math.pi * driver["n"] / 30)


@each("problem", DRAWN)
def test_plans_are_derivatives_of_the_positions(problem: Problem) -> None:
    for data in problem.variants().values():
        omega, step = omega_of(data), 2e-4
        before, here, after = (points(problem, data, turn) for turn in (-step, 0.0, step))
        student = exact(problem, data)
        for key, answer in student.said.items():
            kind, *names = key.split()
            if kind not in ("v", "a") or any(
                name not in data["frame"] and name[-1] in "35" and name[:-1] in here
                for name in names
            ):
                continue  # points of links under a slider have no place of their own here
            path = [place[names[0]] for place in (before, here, after)]
            if len(names) == 2:
                path = [
                    a - place[names[1]]
                    for a, place in zip(path, (before, here, after), strict=True)
                ]
            first = (path[2] - path[0]) / (2 * step) * omega
            second = (path[2] - 2 * path[1] + path[0]) / step**2 * omega**2
            expected = abs(first if kind == "v" else second)
            assert answer.value == pytest.approx(expected, rel=2e-5, abs=2e-6), key


def test_turning_of_links_is_the_derivative_of_their_angles() -> None:
    problem, ends = BY_NAME["b-123"], {"3": ("B", "C"), "4": ("C", "D")}
    for data in problem.variants().values():
        step, omega = 2e-4, omega_of(data)
        places = [points(problem, data, turn) for turn in (-step, 0.0, step)]
        said = exact(problem, data).said
        for link, (tail, head) in ends.items():
            angles = [
                cmath.phase((p[head] - p[tail]) / (places[1][head] - places[1][tail]))
                for p in places
            ]
            first, second = (angles[2] - angles[0]) / (2 * step), (angles[2] + angles[0]) / step**2
            assert said[f"omega {link}"].value == pytest.approx(first * omega, rel=1e-5)
            assert said[f"epsilon {link}"].value == pytest.approx(second * omega**2, rel=1e-4)


def test_the_balancing_moment_gives_the_power_of_all_forces() -> None:
    problem = BY_NAME["own-forces"]
    for data in problem.variants().values():
        said, omega, step = exact(problem, data).said, omega_of(data), 2e-4
        places = [points(problem, data, turn) for turn in (-step, 0.0, step)]
        power = 0.0
        for point, mass in (("S2", 9.0), ("B", 13.0)):
            velocity = (places[2][point] - places[0][point]) / (2 * step) * omega
            second = (places[2][point] - 2 * places[1][point] + places[0][point]) / step**2
            force = -mass * (second * omega**2 + 9.81j)
            power += (force.conjugate() * velocity).real
            if point == "B":
                power -= data["loads"][0]["force"] * abs(velocity)
        power -= 0.15 * said["epsilon 2"].value * said["omega 2"].value
        assert said["balance"].value == pytest.approx(-power / omega, rel=1e-4)
        assert said["lever"].value == pytest.approx(said["balance"].value, rel=1e-9)


def test_trains_and_points_are_those_of_the_bank() -> None:
    train = exact(BY_NAME["g-28"], BY_NAME["g-28"].variants()["1"]).said
    found = {key: answer.value for key, answer in train.items()}
    assert found == pytest.approx({"W": 1, "U_1_4": 116, "n_H": 100, "n_4": 5.1724138, "n_2": -150})
    k10 = deepcopy(BY_NAME["k10"].variants()["1"])
    for name, radius in zip("123456", (7, 2, 3, 5, 6, 4), strict=True):
        k10["gears"]["wheels"][name]["r"] = radius
    k10["gears"]["omega"] = {"1": 10, "3": -10}
    assert exact(BY_NAME["k10"], k10).said["omega_6"].value == pytest.approx(6)
    k11 = deepcopy(BY_NAME["k11-02"].variants()["1"])
    k11["point"]["t"] = 0
    told = {"vx": 6, "vy": 8, "v": 10, "ax": 0, "ay": 8, "a": 8, "a_tau": 6.4, "a_n": 4.8}
    for from_omega in (False, True):
        said = exact(BY_NAME["k11-02"], k11, from_omega=from_omega).said
        assert {key: said[key].value for key in told} == pytest.approx(told, abs=1e-9)


@each(
    "text", ["16*tan(t)", "3*t*exp(t/2)", "24*sinh(t)*sqrt(t+1)", "9*log(1+t)", "12*cos(t)/(t^2-3)"]
)
def test_coordinates_are_differentiated(text: str) -> None:
    t, step = 0.37, 1e-4
    before, here, after = (coordinate(text, one).value for one in (t - step, t, t + step))
    jet = coordinate(text, t)
    assert jet.first == pytest.approx((after - before) / (2 * step), rel=1e-6)
    assert jet.second == pytest.approx((after - 2 * here + before) / step**2, rel=1e-4)


def test_a_coordinate_is_a_formula_only() -> None:
    with pytest.raises(ValueError, match="open"):
        coordinate("open(t)", 0.0)


@each("problem", DRAWN)
def test_an_honest_hand_errs_by_a_ruler_and_a_pencil(problem: Problem) -> None:
    """Velocities are read from plans of few strokes: a millimetre off, on both sides."""
    found = []
    for number in range(12):
        data = problem.variants()["1"]
        hand = hand_of(str(number))
        right = exact(problem, data).said
        for key, answer in problem.work(data, hand).said.items():
            if key.startswith("v "):
                off = (answer.value - right[key].value) / data["scales"]["mu_v"]
                found.append(off)
            if answer.mm is not None and key.startswith("v "):
                assert answer.mm % hand.ruler == pytest.approx(0.0, abs=1e-9)
                assert answer.mm * data["scales"]["mu_v"] == pytest.approx(answer.value, rel=0.06)
    assert math.sqrt(sum(off**2 for off in found) / len(found)) < 1.2
    assert min(found) < 0.0 < max(found) and max(map(abs, found)) < 6.0


def met(problem: Problem) -> dict[str, tuple[Any, bool, tuple[str, str]]]:
    """Return habits with a place of each, in an exact work of a variant."""
    found: dict[str, tuple[Any, bool, tuple[str, str]]] = {}
    for data in problem.variants().values():
        for from_omega in (False, True):
            for place in exact(problem, data, from_omega=from_omega).met:
                found.setdefault(place[0], (data, from_omega, place))
    return found


def test_every_habit_is_met_and_has_names() -> None:
    assert {habit for problem in PROBLEMS for habit in met(problem)} == set(NAMES)
    assert all(codes_of(habit) is not None for habit in NAMES)


def differ(one: dict[str, Answer], other: dict[str, Answer]) -> set[str]:
    return {
        key for key in one.keys() | other.keys()
        if key not in one or key not in other
        or abs(one[key].value - other[key].value) > 1e-9 * abs(one[key].value)
    }  # fmt: skip


@each("problem", PROBLEMS)
def test_each_habit_changes_its_answer_and_nothing_before_it(problem: Problem) -> None:
    for habit, (data, from_omega, place) in met(problem).items():
        hand = Hand("x", 0.0, 0.0, 0.0, 0.0, digits=14, from_omega=from_omega, writes_zero=True)
        right = problem.work(data, hand).said
        try:
            wrong = problem.work(data, hand, frozenset([place]))
        except ImpossibleError:
            continue
        changed = differ(right, wrong.said)
        assert wrong.struck and changed, habit
        if habit not in SAME and place[1] in right:
            assert place[1] in changed, (habit, place)
        order = list(right)
        known = [key for key in wrong.struck if key in order]
        if known and "swapped" not in habit:
            assert order.index(min(changed, key=order.index)) >= order.index(known[0]), habit


def test_a_mistake_does_not_shake_the_hand() -> None:
    problem = BY_NAME["b-25"]
    data, hand = problem.variants()["1"], hand_of("3")
    right = problem.work(data, hand).said
    wrong = problem.work(data, hand, frozenset([("ε in the other sense", "epsilon 2")])).said
    assert differ(right, wrong) == {"epsilon 2"}
    assert wrong["epsilon 2"].value == -right["epsilon 2"].value


def test_a_scale_is_one_mistake_with_its_repeats_and_what_follows() -> None:
    group = make_group(BY_NAME["b-25"], 1, 60)
    work = next(one for one in group.works if one.habits == ("μ_v forgotten",))
    assert work.roots == ("v B",) and {"v B A", "v S"} <= work.repeats
    assert {"omega 2", "a B"} <= work.following and "v A" not in work.changed


def test_works_depend_on_the_seed_only() -> None:
    one, same, other = (table(make_group(BY_NAME["k10"], seed, 4).works) for seed in (5, 5, 6))
    assert one == same != other


def test_the_simulator_imports_nothing_of_the_product() -> None:
    for path in FOLDER.parent.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            names = [a.name for a in node.names] if isinstance(node, ast.Import) else []
            names += [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            assert not any(name.startswith("planmethod") for name in names), path


@pytest.mark.dear
def test_the_product_judges_the_works(tmp_path: Path) -> None:
    judged = students(3, 4, ["b-29", "own-train"], tmp_path)
    kinds = [one.work.kind for one in judged]
    assert kinds.count("honest") == 8 and kinds.count("one") == 8
    for one in judged:
        assert set(one.answers) == set(one.work.said), "every answer has a record"
        assert 0.0 <= one.share <= 1.0
        if one.work.kind == "one":
            assert not (one.named and one.among)
    text = "\n".join(students_section(judged, 3))
    assert "| **one mistake** | 8 |" in text and "| drawn | 4 |" in text


def test_bench_prints_the_students_beside_its_own_works(monkeypatch: pytest.MonkeyPatch) -> None:
    words = ["bench", "--only", "checking", "--works", "1", "--seed", "7"]
    problem = str(FOLDER.parents[2] / "problems/point/k11-01.toml")
    monkeypatch.setattr(checking, "section", lambda seed, works: [f"students {seed} {works}"])
    run = CliRunner().invoke(cli, [*words, problem])
    assert run.exit_code == 0 and "students 7 1" in run.output and "## By families" in run.output
    monkeypatch.setitem(sys.modules, "benchmarks.checking", None)
    run = CliRunner().invoke(cli, [*words, problem])
    assert run.exit_code == 2 and "checkout" in run.output
