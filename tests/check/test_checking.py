"""Verdicts and diagnoses, on worked examples and on random mechanisms."""

from __future__ import annotations

import cmath
import io
import math

import openpyxl
import pytest
from cases import some
from doors import (
    NO_BREAK,
    DirectionMode,
    FormHead,
    MistakeContext,
    PlanKind,
    ProblemError,
    QuestionSpec,
    Sense,
    Settings,
    Solution,
    Submission,
    Task,
    Verdict,
    WrittenAnswer,
    check,
    form_of,
    get_language,
    key_of,
    key_of_task,
    scale_by,
)
from msgspec.structs import replace
from planted import checked, exact, explanations, task_of, verdicts, work_of
from texts import compared_text, key_text
from worked import SIX, problem_of

RANDOM = tuple(f"random-{seed}" for seed in range(some(60, 2)))


@pytest.mark.parametrize("name", [*SIX, *RANDOM])
def test_exact_values_are_right_answers(name: str) -> None:
    task = task_of(name)
    found = check(task, work_of(task, exact(task)))
    assert set(verdicts(found).values()) <= {Verdict.OK, Verdict.UNSEEN}
    assert found.points == found.of == len(found.answers)
    assert not found.diagnosis


@pytest.mark.parametrize("name", ["linkages/ex3", "levers/task12", *RANDOM])
def test_a_planted_mistake_is_named_or_owned_to_be_doubtful(name: str) -> None:
    task = task_of(name)
    seen, named, misnamed = 0, 0, []
    for explanation in explanations(task)[:: some(1, 8)]:
        found = check(task, work_of(task, explanation.values))
        if Verdict.WRONG not in verdicts(found).values():
            continue  # the answers do not show the mistake, or barely
        seen += 1
        codes = [diagnosis.codes for diagnosis in found.diagnosis if diagnosis.sure]
        if any(explanation.code in diagnosis.codes for diagnosis in found.diagnosis):
            named += 1
        elif codes:
            misnamed.append((explanation.code, explanation.mistake_at, codes))
        for diagnosis in found.diagnosis:
            assert diagnosis.sure is False or len(diagnosis.codes) == 1
            for root in diagnosis.roots:
                assert verdicts(found)[root] is Verdict.WRONG
    assert named >= seen - max(1, 0.1 * seen)
    assert len(misnamed) <= 0.02 * seen + 1, misnamed


def test_coriolis_forgotten_on_the_plan_begins_with_the_acceleration() -> None:
    """It is computed and not laid off: a_B3 = 118.9 m/s² in place of 55.6."""
    found = checked(
        "linkages/ex3",
        v_B3=2.25,
        omega_3=15.5,
        ak_B3_B=70.5,
        a_B3=118.5,
        epsilon_3=788.0,
        a_D=180.0,
        a_E=211.0,
    )
    told = verdicts(found)
    assert [told[key] for key in ("v_B3", "omega_3", "ak_B3_B")] == [Verdict.OK] * 3
    assert told["a_B3"] is Verdict.WRONG
    follows = {answer.id: answer.follows for answer in found.answers if answer.follows}
    assert follows == dict.fromkeys(("epsilon_3", "a_D", "a_E"), "a_B3")
    (diagnosis,) = found.diagnosis
    assert (diagnosis.codes, diagnosis.sure, diagnosis.roots) == (("A1",), True, ("a_B3",))


def test_results_of_a_slip_are_inherited_and_the_slip_counts_once() -> None:
    """ω₃ = 12.5 in place of 15.5, and a result computed from the student's own ω₃."""
    found = checked("linkages/ex3", v_B3=2.25, omega_3=12.5, an_B3_C=12.5**2 * 0.14495)
    told = verdicts(found)
    assert told["omega_3"] is Verdict.WRONG
    assert told["an_B3_C"] is Verdict.INHERITED
    assert found.answers[2].follows == "omega_3"
    assert found.points == 2.0


def test_a_point_laid_off_at_half_its_vector_moves_the_rest_of_the_plan() -> None:
    """v_E and v_ED are found from the wrong d, by the lines of the right plan."""
    task = task_of("linkages/ex3")
    items = {item.id: item for item in task.usual()}
    sheet = task.sheet(0)
    d, e, ed = (sheet.vector(items[name].question) for name in ("v_D", "v_E", "v_E_D"))
    assert d is not None and e is not None and ed is not None
    along, across = e / abs(e), ed / abs(ed)
    speed = (d / 2 * across.conjugate()).imag / (along * across.conjugate()).imag
    apart = abs(speed * along - d / 2)
    mu = sheet.scales["mu_v"]
    right = exact(task)
    given = {"v_B3": abs(right["v_B3"]), "omega_3": right["omega_3"] / 2, "v_D": abs(d) / 2 * mu}
    found = checked("linkages/ex3", **given, v_E=abs(speed) * mu, v_E_D=apart * mu)
    told = verdicts(found)
    assert told["omega_3"] is Verdict.WRONG
    assert {told["v_D"], told["v_E"], told["v_E_D"]} == {Verdict.INHERITED}
    wrong = checked("linkages/ex3", **given, v_E=abs(speed) * mu * 1.3)
    assert verdicts(wrong)["v_E"] is Verdict.WRONG


def test_a_number_of_next_to_nothing_is_followed() -> None:
    """ω₃ a million times too small leaves a^k out of the plan: the rest is found without this."""
    task = task_of("linkages/ex3")
    right = exact(task)
    none = next(e for e in explanations(task) if e.code == "A1")
    tau = abs(none.values["at_B3_C"])
    assert tau > 1.5 * abs(right["at_B3_C"])
    given = {"omega_3": 1.548e-5, "ak_B3_B": 7.063e-5, "an_B3_C": abs(right["an_B3_C"])}
    found = verdicts(checked("linkages/ex3", **given, at_B3_C=tau))
    assert found["omega_3"] is Verdict.WRONG
    assert found["ak_B3_B"] is found["at_B3_C"] is Verdict.INHERITED


def test_a_right_value_that_does_not_follow_is_inconsistent() -> None:
    found = checked("linkages/ex3", v_B3=1.9, omega_3=13.1, ak_B3_B=70.63)
    told = verdicts(found)
    assert told["omega_3"] is Verdict.INHERITED
    assert told["ak_B3_B"] is Verdict.INCONSISTENT


def test_a_slip_of_the_pen_makes_no_right_answer_inconsistent() -> None:
    """ω₃ = 51.48 for 15.48: two digits exchanged, and the plans went on with the right one."""
    found = checked("linkages/ex3", v_B3=2.24, omega_3=51.48, ak_B3_B=70.63, an_B3_C=34.72)
    told = verdicts(found)
    assert told["omega_3"] is Verdict.WRONG
    assert told["ak_B3_B"] is Verdict.OK


def test_a_value_that_the_drawing_cannot_show_is_not_judged_by_the_exact_one() -> None:
    """ε₄ of the third example: 2.5 σ are more than a half of it."""
    for value in (84.5, 60.0, 110.0):
        assert verdicts(checked("linkages/ex3", epsilon_4=value))["epsilon_4"] is Verdict.UNSEEN
    assert verdicts(checked("linkages/ex3", epsilon_4=400.0))["epsilon_4"] is Verdict.WRONG
    assert verdicts(checked("linkages/ex3", v_ED=1.6))["v_ED"] is Verdict.UNSEEN


def test_the_sense_is_an_answer_of_its_own() -> None:
    task = task_of("linkages/ex3")

    def judged(sense: Sense | None, value: float = 15.5) -> tuple[Verdict, float, tuple[str, ...]]:
        written = WrittenAnswer(id="omega_3", value=value, step=0.1, sense=sense)
        found = check(task, Submission("s", (written,)))
        codes = tuple(code for diagnosis in found.diagnosis for code in diagnosis.codes)
        return found.answers[0].verdict, found.answers[0].points, codes

    assert judged(Sense.CCW) == (Verdict.OK, 1.0, ())
    assert judged(Sense.CW) == (Verdict.WRONG, 0.7, ("sign", "V2"))
    assert judged(None, -15.5) == (Verdict.WRONG, 0.7, ("sign", "V2"))
    assert judged(None) == (Verdict.OK, 0.7, ())  # the sense is required, and is not given


def test_millimetres_times_scale_that_are_not_the_value_are_a_slip() -> None:
    task = task_of("linkages/ex3")
    scales = {"mu_l": 0.002, "mu_v": 0.05, "mu_a": 1.0}

    def codes(value: float, mm: float, mu_a: float = 1.0) -> list[tuple[str, ...]]:
        written = WrittenAnswer(id="v_E", value=value, step=0.01, mm=mm, mm_step=0.5)
        given = scales | {"mu_a": mu_a}
        found = check(task, Submission("s", (written,), scales=given)).diagnosis
        return [d.codes if d.sure else () for d in found]

    assert codes(3.92, 78.5) == []
    assert codes(3.29, 78.5) == [("slip",)]
    assert codes(1570.0, 78.5) == [("S1",)]
    assert codes(62.8, 78.5, mu_a=0.8) == [("S3",)]
    assert codes(78.5, 78.5, mu_a=0.8) == [("scale",)]
    assert codes(78.5, 78.5, mu_a=1.0) == [()]  # forgotten, or that of the other plan
    assert codes(39.2, 78.5) == [("S4",)]
    assert codes(1.85, 37.0) == [()]  # drawn wrong, and computed right


def test_a_computed_value_laid_off_by_a_ruler_is_not_a_slip() -> None:
    task = task_of("linkages/ex3")
    [entry] = [one for one in key_of_task(task).entries if one.id == "an_B3_C"]
    assert entry.mm is not None
    for off, slip in ((0.3, False), (-0.3, False), (1.5, True)):
        written = WrittenAnswer(
            id=entry.id, value=entry.exact, step=0.01, mm=entry.mm + off, mm_step=0.1
        )
        [answer] = check(task, Submission("s", (written,), scales={"mu_a": 1.0})).answers[:1]
        assert answer.slip is slip, off


def test_the_students_scale_counts_and_millimetres_alone_are_an_answer() -> None:
    task = task_of("linkages/ex3")
    exact_mm = 3.9156681586643276 / 0.04
    written = WrittenAnswer(what="v E", mm=round(exact_mm * 2) / 2, mm_step=0.5)
    answer = check(task, Submission("s", (written,), scales={"mu_v": 0.04})).answers[0]
    assert answer.verdict is Verdict.OK
    assert answer.value == pytest.approx(3.92, rel=0.01)
    assert check(task, Submission("s", (written,))).answers[0].verdict is Verdict.WRONG


def test_a_segment_of_other_letters_is_recognised() -> None:
    """The student reads pd in place of pe, and writes this segment."""
    task = task_of("linkages/ex3")
    scales = {"mu_v": 0.05}
    written = WrittenAnswer(what="v E", value=3.4, mm=68.0, segment="p d", step=0.01, mm_step=0.5)
    (diagnosis,) = check(task, Submission("s", (written,), scales=scales)).diagnosis
    assert diagnosis.codes == ("V6",)
    right = WrittenAnswer(what="v E", value=3.92, mm=78.5, segment="p e", step=0.01, mm_step=0.5)
    assert check(task, Submission("s", (right,), scales=scales)).answers[0].verdict is Verdict.OK


def test_blank_is_not_zero_and_unknown_is_not_wrong() -> None:
    task = task_of("linkages/ex3")
    work = Submission(
        "s",
        (
            WrittenAnswer(id="v_E"),
            WrittenAnswer(id="v_D", value=0.0),
            WrittenAnswer(id="v_Q", value=1.0),
            WrittenAnswer(id="v_B", unreadable="what is '3,,2'?", location="A1"),
        ),
    )
    told = verdicts(check(task, work))
    assert told["v_E"] is Verdict.BLANK
    assert told["v_D"] is Verdict.WRONG
    assert told["v_Q"] is told["v_B"] is Verdict.UNREADABLE


def test_letters_of_the_department_find_the_quantity() -> None:
    """Task 12 declares no answers: the quantity is found by its written name."""
    task = task_of("levers/task12")
    for text in ("v_B3", "VB₃", "v B3", "В3"):
        written = WrittenAnswer(id=text, value=0.4536)
        verdict = check(task, Submission("s", (written,))).answers[0].verdict
        assert (verdict is Verdict.UNREADABLE) == (text == "В3"), text
    for text, value in (
        ("ω3", 2.36),
        ("F21", 2484.0),
        ("R_{21}", 2484.0),
        ("Mур", 95.3),
        ("ε_3", 40.7),
    ):
        written = WrittenAnswer(id=text, value=value, step=abs(value) * 1e-3)
        verdict = check(task, Submission("s", (written,))).answers[0].verdict
        assert verdict in (Verdict.OK, Verdict.UNSEEN), text


def test_a_work_is_judged_independently_of_the_others() -> None:
    task = Task(Solution(task_of("levers/task12").solution.problem))
    written = (
        WrittenAnswer(id="v_D", value=0.59, step=0.01),
        WrittenAnswer(id="a_D", value=17.0, step=0.1),
    )
    alone = check(task, Submission("s", written))
    task.usual()
    again = check(task, Submission("s", written))
    assert again.answers == alone.answers
    assert [replace(d, places={}) for d in again.diagnosis] == [
        replace(d, places={}) for d in alone.diagnosis
    ]
    turned = check(task, Submission("s", written[::-1])).answers
    assert turned == (*alone.answers[1::-1], *alone.answers[2:])
    assert {answer.verdict for answer in alone.answers[2:]} == {Verdict.BLANK}


@pytest.mark.parametrize(
    ("policy", "verdict"),
    [
        ("construction", Verdict.UNSEEN),
        ("department", Verdict.WRONG),
        ("wider", Verdict.UNSEEN),
        ("stricter", Verdict.WRONG),
    ],
)
def test_the_policy_of_the_department(policy: str, verdict: Verdict) -> None:
    """a_E of the third example 9 % off: 2.5 σ are 12 %, the cap 10 %, the flat tolerance 5 %."""
    settings = Settings(policy=policy)
    task = Task(task_of("linkages/ex3").solution, settings)
    found = check(task, Submission("s", (WrittenAnswer(id="a_E", value=94.9, step=0.1),)))
    assert found.answers[0].verdict is verdict


def test_positions_of_a_cycle_are_judged_separately() -> None:
    problem = task_of("linkages/ex3").solution.problem
    solution = Solution(replace(problem, answers=()), positions=[20.0, 110.0])
    task = Task(solution)
    values = [abs(float(solution.points["D"].velocity[i].real)) for i in (0, 1)]
    speeds = [abs(complex(solution.points["D"].velocity[i])) for i in (0, 1)]
    assert abs(speeds[0] - speeds[1]) > 0.5
    assert all(math.isfinite(value) for value in values)
    written = tuple(
        WrittenAnswer(id="v_D", value=speed, step=0.001, position=position)
        for position, speed in ((0, speeds[0]), (1, speeds[1]), (1, speeds[0]), (2, speeds[0]))
    )
    found = [
        answer.verdict for answer in check(task, Submission("s", written)).answers if answer.written
    ]
    assert found == [Verdict.OK, Verdict.OK, Verdict.WRONG, Verdict.UNREADABLE]


def test_a_slip_in_one_number_does_not_affect_values_measured_beside_it() -> None:
    """a_N is measured on the line of a_S3; ten times a_S3 does not affect that line."""
    task = task_of("press/press")
    values = dict(exact(task))
    values["a_S3"] *= 10.0
    found = check(task, work_of(task, values))
    assert [(d.codes, d.roots) for d in found.diagnosis] == [(("S4",), ("a_S3",))]
    told = {name for name, verdict in verdicts(found).items() if verdict is Verdict.WRONG}
    assert told == {"a_S3"}


def test_mistakes_that_give_the_same_sheet_are_named_together() -> None:
    """Link 4 of the press barely turns: the other assembly and a misread sense look the same."""
    task = task_of("press/press")
    (other,) = (e for e in explanations(task) if e.code == "P1" and e.mistake_at == "B")
    (diagnosis,) = check(task, work_of(task, other.values)).diagnosis
    assert set(diagnosis.codes) == {"P1", "sign"}
    assert not diagnosis.sure


def test_another_assembly_of_a_triad_is_named_each_of_three() -> None:
    task = task_of("linkages/triad")
    others = [e for e in explanations(task) if e.code == "P1" and e.mistake_at == "3"]
    # Found elsewhere: v_B, omega_3, a_B, epsilon_3 of one of the others.
    known = {"v_B": 0.211776, "omega_3": -0.559066, "a_B": 8.30696, "epsilon_3": 23.33842}
    assert [e for e in others if all(
        e.values[name] == pytest.approx(value, rel=1e-5) for name, value in known.items()
    )]  # fmt: skip
    assert len(others) == 3
    for other in others:
        found = check(task, work_of(task, other.values))
        assert [(d.codes, d.sure) for d in found.diagnosis] == [(("P1",), True)]
    right = check(task, work_of(task, exact(task)))
    assert not right.diagnosis and right.points == right.of == 12


def test_another_scale_is_found_by_the_sharpest_answers() -> None:
    """v_S1 is exact, v_A3 read 2 % too long: the factor is 1.25 of the one, not between them."""
    task = task_of("press/press")
    change = scale_by(MistakeContext(task.sheet(0)), PlanKind.VELOCITY, 1.25)
    found = task.explanations(task.sheet(0)).of_change(change)
    assert found is not None
    values = {**found.values, "v_A3": found.values["v_A3"] * 1.02}
    assert [d.codes for d in check(task, work_of(task, values, digits=3)).diagnosis] == [("scale",)]


def test_the_direction_of_a_vector_is_an_answer_of_its_own() -> None:
    problem = task_of("linkages/ex3").solution.problem
    asked = QuestionSpec("v_B3", "v B3", ("VB₃",), points=2.0, sense=DirectionMode.ANGLE)
    task = Task(Solution(replace(problem, answers=(asked,))))
    size, turned = task.declared
    assert (size.points, turned.points, turned.question.unit) == (1.4, 0.6, "deg")
    velocity = complex(task.solution.points["B3"].velocity[0])
    right = math.degrees(cmath.phase(velocity))
    entry = key_of_task(task).entries[1]
    assert entry.exact == pytest.approx(right)
    assert 0.5 < entry.tolerance < 5.0
    for text, off, verdict in (
        ("angle v B3", entry.tolerance * 0.9, Verdict.OK),
        ("α(VB₃)", 360.0, Verdict.OK),
        ("angle_v_B3", 180.0, Verdict.WRONG),
    ):
        found = check(task, Submission("s", (WrittenAnswer(text, value=right + off, step=0.1),)))
        assert found.answers[0].verdict is verdict, text


def test_a_number_without_a_unit_has_the_required_one() -> None:
    problem = task_of("linkages/ex3").solution.problem
    speed, turn = (
        QuestionSpec("v", "v B3", unit="мм/с"),
        QuestionSpec("w", "omega 3", unit="об/мин"),
    )
    task = Task(Solution(replace(problem, answers=(speed, turn))))
    key = key_of_task(task)
    mm_s, rpm = (abs(entry.exact) / entry.per for entry in key.entries)
    exact = [entry.exact for entry in key_of(Solution(problem)).entries if entry.id == "omega_3"]
    assert [rpm * math.pi / 30.0] == pytest.approx(exact)
    bare = (
        WrittenAnswer(id="v", value=mm_s, step=1.0),
        WrittenAnswer(id="w", value=rpm, sense=Sense.CCW),
    )
    si = (
        WrittenAnswer(id="v", value=mm_s / 1e3, unit="м/с"),
        WrittenAnswer(id="w", value=exact[0]),
    )
    right, wrong = (check(task, Submission("s", answers)) for answers in (bare, si))
    assert set(verdicts(right).values()) == {Verdict.OK}
    assert list(verdicts(wrong).values()) == [Verdict.OK, Verdict.WRONG]  # 15.5 of 148 rev/min
    words = get_language("ru")
    assert compared_text([right], words).count(f"{mm_s:.0f} мм/с") == 2
    assert f"{mm_s / 10:.0f}0 ± " in key_text([key], words).replace(NO_BREAK, " ")
    book = openpyxl.load_workbook(io.BytesIO(form_of(key.entries, FormHead(problem="ex3"))))
    rows = book.worksheets[0].iter_rows(values_only=True)
    assert [row[6] for row in rows if row[1] in ("v", "w")] == ["мм/с", "об/мин"]
    with pytest.raises(ProblemError, match="'м/с²' is not a unit of 'v'"):
        Task(Solution(replace(problem, answers=(replace(speed, unit="м/с²"),))))


def test_the_key_has_every_position_and_hides_mistakes_that_no_answer_shows() -> None:
    usual = replace(task_of("levers/crosshead").solution.problem, answers=())
    solution = Solution(usual, positions=[90.0, 150.0])
    both = key_of(solution)
    alone = [
        key_of(Solution(solution.problem, positions=[phi], scales=solution.scales))
        for phi in (90.0, 150.0)
    ]
    assert [(e.id, e.position) for e in both.entries] == [
        (entry.id, at) for at, key in enumerate(alone) for entry in key.entries
    ]
    exact_of = [entry.exact for key in alone for entry in key.entries]
    assert [entry.exact for entry in both.entries] == pytest.approx(exact_of)
    for code in set(both.hidden) - {"V6", "N5"}:  # those are of one answer each
        for where in both.hidden[code]:
            assert all(where in key.hidden[code] for key in alone)


def test_a_plan_that_is_too_small_to_be_read_has_a_key() -> None:
    """ex3 at 2 1/s and its own scales: segments of a millimetre, some that only the ruler errs."""
    problem = problem_of("linkages/ex3")
    slow = replace(problem, drive=replace(problem.drive, rate=2.0))
    entries = key_of(Solution(slow, positions=[140.0])).entries
    assert all(math.isfinite(entry.tolerance) for entry in entries)
    assert sum(entry.zero for entry in entries) > 1


def test_the_numbers_of_another_variant_earn_no_points() -> None:
    """P2: numbers of variant Б in place of А; their agreement with one another earns no points."""
    tasks = {
        name: Task(Solution(problem_of("levers/task12-variants", name))) for name in ("А", "Б")
    }
    task = Task(tasks["А"].solution, other_variants=lambda: tasks.values())
    found = check(task, work_of(task, exact(tasks["Б"])))
    assert [d.codes for d in found.diagnosis] == [("P2",)]
    assert found.diagnosis[0].mistake_at == "Б"
    assert {Verdict.INHERITED} & set(verdicts(found).values()) == set()
    assert found.points < 0.3 * found.of
