"""Questions for the defence: places are true, numbers are right, packs differ by their seed."""

from __future__ import annotations

import re
from functools import cache
from math import cos, pi, radians, tan
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from cases import each
from doors import (
    LINKAGES,
    ArgumentError,
    ChoiceAnswer,
    DefenceCase as Case,
    DefenceQuestion as Question,
    Homework,
    NumberAnswer,
    PartName,
    Project,
    Solution,
    Subject,
    Text,
    answers_document,
    defence_accepted as accepted,
    defence_subjects,
    draw_pack,
    get_language,
    kind_of,
    kinds_load as load_any,
    moodle_bank,
    plain_document,
    questions_document,
    settle,
    zone_of,
)
from worked import PROBLEMS, ROOT, project_of

from benchmarks.generator import random_problem

WORKS = {
    "press": PROBLEMS / "press/press.toml",
    "balanced": PROBLEMS / "machines/balanced-crank.toml",
    "fourbar": PROBLEMS / "machines/balanced-fourbar.toml",
    "shaper": ROOT / "tests/data/projects/shaper.toml",
    "train": PROBLEMS / "gears/gears-ex1.toml",
    "meshing": PROBLEMS / "meshing/z12-30.toml",
    "point": PROBLEMS / "point/k10-satellite.toml",
}

PROJECTS = ("press", "balanced", "fourbar", "shaper")


@cache
def case_of(name: str) -> Case:
    path = WORKS[name]
    kind = kind_of(path)
    work: Project | Homework = (
        project_of(path) if kind is LINKAGES else Homework(kind.load(path, None), kind, "ru")
    )
    return Case(work)


@cache
def pack_of(name: str, seed: int = 0) -> list[Question]:
    return draw_pack(case_of(name), seed=seed)


def every_number(name: str, subject: Subject, key: str) -> dict[str, NumberAnswer]:
    """Return the numbers of all questions of a template, by their objects."""
    template = defence_subjects[subject][key]
    answers = {one.about: one.answer for one in template(case_of(name))}
    assert answers
    return {about: one for about, one in answers.items() if isinstance(one, NumberAnswer)}


def test_a_whole_project_has_fifty_questions_and_none_twice() -> None:
    for name in PROJECTS:
        texts = [one.text for one in pack_of(name)]
        assert len(texts) >= 50, name
        assert len(set(texts)) == len(texts), name


@each("name", ["gears/gears-ex1", "gears/gears-ex4", "meshing/z20-60-internal", "cams/flat"])
def test_a_part_alone_has_twenty_questions_and_none_twice(name: str) -> None:
    path = PROBLEMS / f"{name}.toml"
    kind = kind_of(path)
    for lang in ("ru", "en"):
        case = Case(Homework(kind.load(path, None), kind, lang))
        texts = [one.text for one in draw_pack(case)]
        assert len({*texts}) == len(texts) >= 20


def test_counterweights_alone_have_twenty_questions() -> None:
    for name in ("balanced", "fourbar"):
        texts = [one for one in pack_of(name) if one.subject is Subject.BALANCING]
        assert len(texts) >= 20, name


def test_a_pack_has_every_subject_of_its_work() -> None:
    shaper = {one.subject for one in pack_of("shaper")}
    assert shaper == {
        Subject.STRUCTURE, Subject.KINEMATICS, Subject.FORCES, Subject.FLYWHEEL, Subject.GEARS,
    }  # fmt: skip
    assert Subject.BALANCING in {one.subject for one in pack_of("balanced")}
    for name, subject in (("train", Subject.GEARS), ("meshing", Subject.MESHING)):
        assert {one.subject for one in pack_of(name)} == {subject}


@pytest.mark.parametrize("name", WORKS)
def test_a_place_is_where_the_drawing_has_it(name: str) -> None:
    sheets = {one.number: one.drawing for one in case_of(name).sheets.sheets}
    for question in pack_of(name):
        place, drawing = question.place, sheets[question.place.sheet]
        assert 0 < place.at.real < drawing.width and 0 < place.at.imag < drawing.height
        assert place.zone == zone_of(drawing.width, place.at)
        assert place.title == drawing.title
        texts = [item for item in drawing.items if isinstance(item, Text)]
        if place.mark:
            assert any(t.label == place.mark and t.at == place.at for t in texts), question
        if place.view:
            lines = " ".join(t.label.rpartition("@")[0] for t in texts)
            assert all(word in lines for word in place.view.split()), question


def test_the_inscription_of_a_force_is_that_of_the_question() -> None:
    for question in pack_of("press"):
        if question.key in ("weight", "inertia", "couple", "reaction"):
            symbol = question.place.mark.rpartition(": ")[2]
            assert re.sub(r"[{}]", "", symbol) in re.sub(r"[{}]", "", question.text), question


def test_zones_count_from_the_right_and_from_below() -> None:
    assert zone_of(841.0, 830 + 10j) == "1A"
    assert zone_of(841.0, 25 + 580j) == "4B"
    assert zone_of(420.0, 30 + 20j) == "2A"


# Draws -------------------------------------------------------------------------------------------


def test_the_same_seed_gives_the_same_pack_and_another_one_another() -> None:
    case = case_of("press")
    assert draw_pack(case, seed=5, count=30) == draw_pack(case, seed=5, count=30)
    drawn = {tuple(q.text for q in draw_pack(case, seed=k, count=30)) for k in range(6)}
    assert len(drawn) == 6


def test_a_small_pack_has_all_subjects_and_a_large_one_is_refused() -> None:
    case = case_of("shaper")
    assert len({one.subject for one in draw_pack(case, count=10)}) == 5
    with pytest.raises(ArgumentError, match="900 questions are requested"):
        draw_pack(case, count=900)


def test_a_work_without_questions_is_refused() -> None:
    path = PROBLEMS / "camshafts/automatic.toml"
    kind = kind_of(path)
    case = Case(Homework(kind.load(path, None), kind, "ru"))
    with pytest.raises(ArgumentError, match=r"automatic.toml gives no questions"):
        draw_pack(case)


@each("name,seed", [(name, seed) for name in (*PROJECTS, "meshing") for seed in (0, 1, 2)])
def test_no_question_tells_the_number_that_another_one_asks_for(name: str, seed: int) -> None:
    questions, case = pack_of(name, seed), case_of(name)
    for one in questions:
        if not isinstance(one.answer, NumberAnswer) or not one.answer.tolerance:
            continue
        number = case.number(one.answer.value)
        told = re.compile(rf"(?<![\d,]){re.escape(number)} {re.escape(str(one.answer.unit))}\b")
        for other in questions:
            assert not told.search(other.text), (one.text, other.text)


def test_a_choice_has_one_right_option_among_different_ones() -> None:
    for name in WORKS:
        for question in pack_of(name):
            if isinstance(question.answer, ChoiceAnswer):
                options = question.answer.options
                assert question.answer.right in options
                assert len({*options.values()}) == len(options) >= 3, question


# Numbers, calculated in another way --------------------------------------------------------------


def differences(solution: Solution, point: str, index: int) -> tuple[complex, complex]:
    """Return velocity and acceleration of a point by differences of its places."""
    step, phi = 1e-3, float(solution.positions[index])
    near = solution.with_positions([phi - step, phi, phi + step])
    before, here, after = near.points[point].place
    rate = solution.problem.drive.rate
    h = radians(step)
    return (after - before) / (2 * h) * rate, (after - 2 * here + before) / h**2 * rate**2


@pytest.mark.parametrize("name", ["press", "shaper", "balanced"])
def test_velocities_and_accelerations_are_derivatives_of_the_places(name: str) -> None:
    solution = case_of(name).solution
    for key, order, times in (
        ("point_velocity", 0, 1.0), ("point_acceleration", 1, 1.0),
        ("doubled_velocity", 0, 2.0), ("doubled_acceleration", 1, 4.0),
    ):  # fmt: skip
        for about, answer in every_number(name, Subject.KINEMATICS, key).items():
            label, _, index = about.partition(" ")
            point = label.partition("_")[2]
            if any(point in body.points for body in solution.problem.bodies.values()):
                found = abs(differences(solution, point, int(index))[order])
                assert answer.value == pytest.approx(times * found, rel=2e-4), about
                assert answer.tolerance <= 0.1001 * answer.value


def test_inertia_and_weight_follow_from_the_masses() -> None:
    case = case_of("press")
    dynamics, loaded = case.solution.problem.dynamics, case.loaded
    assert dynamics is not None
    masses = dynamics.masses
    for link, answer in every_number("press", Subject.FORCES, "weight").items():
        assert answer.value == pytest.approx(9.81 * masses[link].mass)
    for link, answer in every_number("press", Subject.FORCES, "inertia").items():
        _, acceleration = differences(loaded, str(masses[link].centre), 0)
        assert answer.value == pytest.approx(masses[link].mass * abs(acceleration), rel=2e-4)


@pytest.mark.parametrize("name", ["press", "shaper"])
def test_the_balancing_moment_is_that_of_virtual_work(name: str) -> None:
    case = case_of(name)
    loaded, rate = case.loaded, case.solution.problem.drive.rate
    dynamics = loaded.problem.dynamics
    assert dynamics is not None
    power = 0.0
    for link, mass in dynamics.masses.items():
        if mass.centre is None:
            continue
        velocity, acceleration = differences(loaded, mass.centre, 0)
        force = mass.mass * (-1j * dynamics.gravity - acceleration)
        power += (force * velocity.conjugate()).real
        motion = loaded.links[link]
        power -= mass.inertia * float(motion.epsilon[0]) * float(motion.omega[0])
    for load in case.statics.board.given:
        one = load.applied
        if one.kind.value == "external":
            velocity, _ = differences(loaded, str(one.point), 0)
            power += (complex(one.force[0]) * velocity.conjugate()).real
    (answer,) = every_number(name, Subject.FORCES, "balance").values()
    assert answer.value == pytest.approx(abs(power / rate), rel=1e-3)


def test_the_ratio_of_the_shaper_is_that_of_willis() -> None:
    (answer,) = every_number("shaper", Subject.GEARS, "ratio").values()
    assert answer.value == pytest.approx(1 + 40 / 20 * 80 / 20)
    (inverted,) = every_number("shaper", Subject.GEARS, "inverted").values()
    assert inverted.value == pytest.approx(-40 / 20 * 80 / 20)


def test_sizes_of_a_pair_are_those_of_the_involute() -> None:
    problem = kind_of(WORKS["meshing"]).load(WORKS["meshing"], None)
    alpha, (z1, z2), x = problem.rack.alpha, problem.z, sum(problem.x)
    low, high = 0.01, 1.2
    wanted = tan(alpha) - alpha + 2 * x * tan(alpha) / (z1 + z2)
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (low, middle) if tan(middle) - middle > wanted else (middle, high)
    (angle,) = every_number("meshing", Subject.MESHING, "working_angle").values()
    assert radians(angle.value) == pytest.approx(low)
    (distance,) = every_number("meshing", Subject.MESHING, "centre_distance").values()
    assert distance.value == pytest.approx(problem.m * (z1 + z2) / 2 * cos(alpha) / cos(low))
    (pitch,) = every_number("meshing", Subject.MESHING, "pitch").values()
    assert pitch.value == pytest.approx(pi * problem.m)


def test_the_flywheel_has_the_work_of_the_moment() -> None:
    from doors import Flywheel

    wheel = Flywheel(case_of("shaper").solution.problem)
    turned = np.linspace(0.0, wheel.cycle, 200001)
    moments = wheel.moment.value((turned[:-1] + turned[1:]) / 2)
    work = float(np.sum(moments)) * wheel.cycle / 200000
    (answer,) = every_number("shaper", Subject.FLYWHEEL, "work").values()
    assert answer.value == pytest.approx(work, rel=1e-3)


@pytest.mark.dear
@pytest.mark.parametrize("seed", [3, 11])
def test_questions_of_random_mechanisms_are_sound(seed: int, tmp_path: Path) -> None:
    text, _ = random_problem(seed)
    path = tmp_path / "random.toml"
    path.write_text(text, "utf-8")
    case = Case(settle(load_any(path), path))
    questions = draw_pack(case, seed=seed)
    assert len(questions) >= 30
    for one in questions:
        if isinstance(one.answer, NumberAnswer):
            assert np.isfinite(one.answer.value)
            assert 0.0 <= one.answer.tolerance <= 0.25 * abs(one.answer.value) + 1e-9


# Documents and Moodle ----------------------------------------------------------------------------


def test_only_the_second_document_has_answers() -> None:
    case, questions = case_of("press"), pack_of("press")
    documents = (questions_document(questions, case), answers_document(questions, case))
    asked, told = (" ".join(plain_document(d, case.language).split()) for d in documents)
    assert asked.count("Место: лист") == told.count("Место: лист") == len(questions)
    assert "Ответ: " not in asked and told.count("Ответ: ") == len(questions)


def test_an_english_case_has_no_russian_text() -> None:
    case = Case(case_of("train").work, get_language("en"))
    for one in draw_pack(case):
        assert not re.search("[а-яё]", f"{one.text} {one.reason}"), one


@each("name", ("press", "meshing", "point"))
def test_moodle_reads_a_number_with_its_tolerance_and_a_choice_with_one_right_answer(
    name: str,
) -> None:
    case, questions = case_of(name), pack_of(name)
    nodes = [*ET.fromstring(moodle_bank(questions, "A/B", case.language))]
    assert nodes[0].findtext("category/text") == "$course$/top/A//B"
    assert len(nodes) == len(questions) + 1
    kinds = {"numerical", "multichoice", "shortanswer"}
    for node, question in zip(nodes[1:], questions, strict=True):
        assert node.get("type") in kinds
        assert 0 < len(node.findtext("name/text") or "") <= 255
        assert "<p>" in (node.findtext("questiontext/text") or "")
        answers = node.findall("answer")
        right = [one for one in answers if one.get("fraction") == "100"]
        match question.answer:
            case NumberAnswer(value, tolerance):
                (one,) = answers
                assert float(one.findtext("text") or "") == pytest.approx(value, rel=1e-3)
                margin = float(one.findtext("tolerance") or "")
                assert margin == pytest.approx(tolerance, rel=2e-3, abs=1e-8)
            case ChoiceAnswer(options=options):
                assert len(right) == 1 and len(answers) == len(options)
            case _:
                assert len(right) == len(answers) >= 1


def test_a_list_is_accepted_in_any_order_and_with_plain_dashes() -> None:
    assert "3-2, 0-5" not in accepted("2–3, 0–5")
    assert {"2–3, 0–5", "0–5, 2–3", "0-5, 2-3"} <= {*accepted("2–3, 0–5")}
    assert accepted("O_{1}") == ["O1"]


def test_parts_of_a_project_are_found_on_their_own_sheets() -> None:
    case = case_of("shaper")
    parts = {one.number: one.part for one in case.sheets.sheets}
    own = {Subject.FORCES: PartName.FORCES, Subject.FLYWHEEL: PartName.FLYWHEEL,
           Subject.GEARS: PartName.GEARS}  # fmt: skip
    for question in pack_of("shaper"):
        if question.subject in own:
            assert parts[question.place.sheet] is own[question.subject], question
