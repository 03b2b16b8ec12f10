"""Works with springs, wheels in mesh and wheels that roll: right ones, and each usual mistake."""

from __future__ import annotations

import json
import random
from functools import cache
from math import hypot
from pathlib import Path

import numpy as np
import pytest
from cases import each, sampled
from doors import (
    QuantityValues,
    Solution,
    Submission,
    Task,
    Variants,
    Verdict,
    WrittenAnswer,
    check,
    find_centres,
    parse_quantity,
    read_json,
    simulate_submissions as simulated,
    spring_states,
)
from geared import KINDS, masses
from planted import exact, explanations, task_of, work_of
from sprung import sprung_problem

import planmethod

HATCH, GEARED, ROLLER = "machines/hatch", "machines/geared-five-bar", "machines/rolling-wheel"
CODES = {HATCH: "F7 F8 F9", GEARED: "G1 G2 G4 G6 G7", ROLLER: "G1 G4 G5 G6 G8"}
PLACES = [(name, code) for name, codes in CODES.items() for code in codes.split() if code != "F9"]


@each("name", CODES)
def test_usual_mistakes_with_springs_and_wheels_are_tried(name: str) -> None:
    codes = {one.code for one in explanations(task_of(name))}
    new = {code for code in codes if code[0] == "G" or code in ("F7", "F8", "F9")}
    assert new == set(CODES[name].split())


@pytest.mark.parametrize(("name", "code"), PLACES)
def test_a_mistake_with_springs_and_wheels_is_named_by_its_numbers(name: str, code: str) -> None:
    task = task_of(name)
    for one in explanations(task):
        if one.code == code:
            found = check(task, work_of(task, one.values))
            (told,) = found.diagnosis
            assert (told.codes, told.sure, told.mistake_at) == ((code,), True, one.mistake_at)


@each("name", CODES)
def test_drawn_works_with_springs_and_wheels_pass(name: str) -> None:
    task = task_of(name)
    for work in (work_of(task, exact(task)), *simulated(task, count=6, seed=3)):
        assert verdicts(task, work) == []


def verdicts(task: Task, work: Submission) -> list[str]:
    """Return the wrong answers of a work, and the mistakes that are named."""
    found = check(task, work)
    wrong = [one.id for one in found.answers if one.verdict is Verdict.WRONG]
    return wrong + [code for told in found.diagnosis for code in told.codes]


def test_the_strut_of_the_hatch_by_hand() -> None:
    """F = c·(l₀ - l) - k·dl/dt; without l₀, with the motion, and of the wrong sense."""
    solution, answers = task_of(HATCH).solution, exact(task_of(HATCH))
    p = solution.points["P"]
    ray = (0.1 - 0.15j) - complex(p.place[0])
    rate = (-complex(p.velocity[0]) * ray.conjugate()).real / abs(ray)
    elastic, damped = 300 * (0.7 - abs(ray)), -80 * rate
    assert answers["load_F_п"] == pytest.approx(elastic + damped, rel=1e-9)
    given = {
        (one.code, round(abs(one.values["load_F_п"]), 6))
        for one in explanations(task_of(HATCH))
        if one.mistake_at == "F_п"
    }
    assert ("F8", round(abs(-300 * abs(ray) + damped), 6)) in given
    assert ("F9", round(elastic - damped, 6)) in given
    assert ("F9", round(elastic, 6)) in given


@cache
def dashpot() -> Task:
    """Return the hatch with a damper that is seen: its rod is moved ten times as fast."""
    table = planmethod.Mechanism.from_file("problems/machines/hatch.toml").to_dict()
    table["springs"][0]["damping"] = 2000
    table.pop("scales")
    return Task(Solution(planmethod.Mechanism.from_dict(table, name="dashpot").problem))


def test_a_damper_left_out_or_with_the_motion_is_named() -> None:
    task = dashpot()
    found = [one for one in explanations(task) if one.code == "F9"]
    assert len(found) == 2
    for one in found:
        (told,) = check(task, work_of(task, one.values)).diagnosis
        assert (told.codes, told.sure) == (("F9",), True)


def test_the_force_of_a_stiff_spring_has_the_error_of_its_length() -> None:
    """Half a millimetre of the drawing is 2.5 mm: 25 N of a spring of 10 N per mm."""
    table = planmethod.Mechanism.from_file("problems/machines/hatch.toml").to_dict()
    strut = table["springs"][0]
    strut |= {"stiffness": 10_000.0, "length": 0.27}
    task = Task(Solution(planmethod.Mechanism.from_dict(table, name="stiff").problem))
    (item,) = (one for one in task.usual() if one.id == "load_F_п")
    sigma = task.sheet(0).sigma(item.question)
    assert 0.2 * 5e-3 * 10_000 < sigma < 0.8 * 5e-3 * 10_000


def test_a_torsion_spring_is_named_by_its_letter_though_it_acts_on_two_links() -> None:
    task = task_of(HATCH)
    for written in ("M_п", "Mп", "load M_п"):
        assert task.find(WrittenAnswer(id=written, location="s")).question.id == "load_M_п"


# Random mechanisms --------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", sampled(range(40), 5))
def test_works_of_random_mechanisms_with_springs_raise_no_false_alarm(seed: int) -> None:
    solution = Solution(sprung_problem(seed)[0])
    task = Task(solution)
    answers = exact(task)
    for state in spring_states(solution):
        force = float(np.broadcast_to(state.force, solution.positions.shape)[0])
        assert abs(answers[f"load_{state.spring.symbol}"]) == pytest.approx(
            abs(force), rel=1e-9, abs=1e-9
        )
    assert verdicts(task, work_of(task, answers)) == []


@pytest.mark.parametrize("seed", sampled(range(40), 3))
def test_works_of_random_geared_linkages_raise_no_false_alarm(seed: int) -> None:
    rng = random.Random(seed)
    make, kind = KINDS[seed % len(KINDS)]
    for _ in range(50):
        model = make(rng, kind)
        masses(rng, model)
        try:
            place, *_ = model.solve(0.0)
        except (ArithmeticError, np.linalg.LinAlgError):
            continue
        if np.linalg.cond(model.jacobian(place)) < 200:
            break
    task = Task(Solution(planmethod.loads(model.toml([0.0]), name="geared")))
    for work in (work_of(task, exact(task)), *simulated(task, count=1, seed=seed)):
        assert verdicts(task, work) == []


# Instant centres ----------------------------------------------------------------------------------

ASKED = ("centre x 0 4", "centre y 0 4", "centre distance 0 4 E", "centre v E", "v E")


@cache
def centres_task() -> Task:
    table = planmethod.Mechanism.from_file("problems/linkages/ex3.toml").to_dict()
    table["answers"] = [{"what": quantity} for quantity in ASKED]
    return Task(Solution(planmethod.Mechanism.from_dict(table, name="centres").problem))


def test_a_centre_is_graded_by_its_drawing() -> None:
    task = centres_task()
    answers, centre = exact(task), find_centres(task.solution, 0).of("0", "4").at
    assert answers["centre_x_0_4"] == pytest.approx(centre.real, rel=1e-9)
    assert answers["centre_y_0_4"] == pytest.approx(centre.imag, rel=1e-9)
    away = centre - complex(task.solution.points["E"].place[0])
    assert answers["centre_distance_0_4_E"] == pytest.approx(hypot(away.real, away.imag), rel=1e-9)
    assert answers["centre_v_E"] == pytest.approx(abs(answers["v_E"]), rel=1e-9)
    for work in (work_of(task, answers), *simulated(task, count=5, seed=1)):
        assert verdicts(task, work) == []
    off = dict(answers) | {"centre_distance_0_4_E": 1.5 * answers["centre_distance_0_4_E"]}
    assert "centre_distance_0_4_E" in [
        one.id for one in check(task, work_of(task, off)).answers if one.verdict is Verdict.WRONG
    ]


def test_a_student_writes_a_centre_in_his_letters_or_in_millimetres() -> None:
    """P_04 of ex3 by its coordinates, by EP₀₄ in mm of the drawing, and as a column of numbers."""
    variants = Variants(Path("problems/linkages/ex3.toml"))
    task = variants.task(None)
    centre = find_centres(task.solution, 0).of("0", "4").at
    away = abs(centre - complex(task.solution.points["E"].place[0]))
    per = task.solution.scales[next(iter(task.solution.scales))].per_mm
    answers = [
        {"id": "x_P04", "value": round(centre.real, 3)},
        {"id": "P_04.y", "value": round(centre.imag, 3)},
        {"id": "EP40", "mm": round(away / per, 1)},
        {"id": "centre omega 4", "value": 9.07, "sense": "cw"},
    ]
    text = json.dumps({"student": "s", "answers": answers})
    (work,) = read_json(text.encode(), Path("s.json"))
    found = {one.id: one.verdict for one in check(task, work).answers}
    verdict = [found[str(one["id"])] for one in answers]
    assert verdict == [Verdict.OK, Verdict.OK, Verdict.OK, Verdict.UNSEEN]


def test_every_centre_of_shipped_linkages_is_drawn_where_it_is() -> None:
    for name in ("linkages/ex1", "linkages/triad", HATCH, GEARED, ROLLER):
        solution = task_of(name).solution
        values, found = QuantityValues(solution), find_centres(solution, 0)
        for (one, other), centre in found.centres.items():
            if not centre.is_infinite:
                x, y = (
                    values.exact(parse_quantity(f"centre {axis} {one} {other}")) for axis in "xy"
                )
                assert complex(x, y) == pytest.approx(centre.at, rel=1e-9, abs=1e-9)
        for point, motion in solution.points.items():
            speed = values.exact(parse_quantity(f"centre v {point}"))
            assert speed == pytest.approx(abs(motion.velocity[0]), rel=1e-9, abs=1e-9)
