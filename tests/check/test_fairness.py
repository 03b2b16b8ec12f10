"""Copied numbers earn no points, results of a right route do, and other submissions cost none."""

from __future__ import annotations

import itertools
import json
import math
from functools import cache
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from doors import (
    AnswerFormatter,
    ExaminedAnswer,
    Explanation,
    ExplanationFit,
    GradedSubmission,
    KeyEntry,
    KeyPage,
    ModelProblem as Problem,
    QuestionSpec,
    Remarks,
    Sense,
    Sign,
    Solution,
    Submission,
    Task,
    Tolerance,
    Trace,
    Variants,
    Verdict,
    WrittenAnswer,
    assign_verdicts,
    check,
    check_works,
    detect_copied_variant,
    get_language,
    grading_examine as examine,
    key_of_task,
    list_readings,
    mark_similar_submissions,
    match_chance,
    parse_quantity,
    propagate_mistake,
    read_csv,
    read_json,
    replay,
    simulate_submissions,
    try_powers,
)
from msgspec.structs import replace
from planted import exact, task_of, verdicts, work_of
from worked import ROOT

TASK13 = ROOT / "problems/levers/task-13.toml"


@cache
def variants(path: Path = TASK13) -> Variants:
    return Variants(path)


def answered(name: str, **values: float | str | tuple[float | str, str]) -> GradedSubmission:
    """Return the check of numbers as they are written, each with an optional sense."""
    told = []
    for key, value in values.items():
        number, sense = value if isinstance(value, tuple) else (value, "")
        told.append({"id": key, "value": str(number).replace(".", ","), "sense": sense})
    (work,) = read_json(json.dumps({"student": "s", "answers": told}).encode(), Path("s.json"))
    return check(task_of(name), work)


# Copied --------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["levers/task-13", "levers/task12-variants"])
def test_a_copied_variant_is_named_and_earns_only_answers_right_for_ones_own(name: str) -> None:
    """All pairs, drawn with the pencil's noise; before, 24 of 30 were "another position"."""
    group = variants(ROOT / f"problems/{name}.toml")
    over = 0
    for mine, theirs in itertools.permutations(group.names, 2):
        task = group.task(mine)
        (work,) = simulate_submissions(group.task(theirs), None, 1, 7)
        found = check(task, replace(work, variant=mine))
        assert [(d.codes, d.sure, d.mistake_at) for d in found.diagnosis] == [
            (("P2",), True, theirs)
        ]
        over += found.points > found.of / 2
        for answer in found.answers:
            assert answer.verdict is not Verdict.INHERITED
            if answer.points == answer.of and answer.key is not None and answer.value is not None:
                off = abs(abs(answer.value) - abs(answer.key.exact))
                size = max(abs(answer.value), abs(answer.key.exact))
                assert off <= (answer.tolerance or 0.0) or answer.key.zero or off < 0.1 * size
    assert over <= 2  # В and Г of task 13 share fifteen of their answers


@pytest.mark.parametrize(
    ("share", "answers", "others", "named"),
    [
        (0.05, 2, 1, True),  # 2·0.05/ln 9 = 0.046 each: once in 480
        (0.05, 2, 4, False),  # of four variants one does so four times as often
        (0.10, 2, 1, False),  # 0.091 each: once in 120
        (0.10, 3, 1, True),
        (0.10, 3, 9, False),
    ],
)
def test_a_likeness_with_a_chance_above_1_in_200_is_not_called_copied(
    share: float, answers: int, others: int, named: bool
) -> None:
    found = [
        ExaminedAnswer(
            cast("Any", SimpleNamespace(id=n, question=SimpleNamespace(id=n, sign=Sign.SIZE))),
            WrittenAnswer(id=n),
            Tolerance(
                1.0, share / 2.5, share, 0.01, share, is_visible=True, zero=False, per_mm=0.01
            ),
            2.0,
            signed=False,
            step=0.0,
        )
        for n in "012"[:answers]
    ]
    theirs = [
        (
            str(n),
            SimpleNamespace(
                exact_answers=dict.fromkeys("012", 2.0 if not n else 7.0), exact_trace=None
            ),
        )
        for n in range(others)
    ]
    task: Any = SimpleNamespace(named=lambda _: [], theirs=lambda _: theirs)
    told = detect_copied_variant(task, cast("Any", None), found)
    wide = share * 2  # at twice the size it is drawn twice as wide
    chance = (2 * wide / 2 / math.log(9)) ** answers * others
    assert (told is not None) is (chance < 0.005) is named


def test_an_honest_or_mistaken_work_is_not_called_copied() -> None:
    group = variants()
    for name in group.names[:3]:
        task = group.task(name)
        sheet = task.sheet(0)
        for work in simulate_submissions(task, None, 4, 11):
            assert not check(task, work).diagnosis
        for made in task.named(sheet)[::7]:
            if made.code != "P1":
                found = check(task, work_of(task, made.values))
                assert ("P2",) not in [d.codes for d in found.diagnosis], made.code


def test_two_works_by_one_pencil_are_a_finding_and_lose_no_points() -> None:
    task = task_of("linkages/ex3")
    works = [
        replace(work, student=f"{n}")
        for n, work in enumerate(simulate_submissions(task, None, 20, 5))
    ]
    honest = [check(task, work) for work in works]
    assert not any(work.similar_students for work in mark_similar_submissions(honest))
    again = check(task, replace(works[3], student="copy"))
    found = mark_similar_submissions([*honest, again])
    assert [work.work.student for work in found if work.similar_students] == ["3", "copy"]
    assert found[-1].similar_students == ("3",)
    assert [work.points for work in found] == [work.points for work in [*honest, again]]


def test_the_chance_of_a_likeness_is_that_of_honest_works() -> None:
    """Honest pairs are no more often alike than the computed chance; measured, not fitted."""
    task = task_of("levers/task12")
    works = simulate_submissions(task, None, 30, 9)
    readings = [list_readings(check(task, work)) for work in works]
    chances = np.array([match_chance(*pair) for pair in itertools.combinations(readings, 2)])
    for level in (0.5, 0.1, 0.02):
        assert (chances < level).mean() <= 1.5 * level


# Neighbours ----------------------------------------------------------------------------------


def test_a_mark_does_not_depend_on_a_neighbour() -> None:
    """Before: 100 % alone, and 58 % beside a student who answered forces."""
    path = ROOT / "problems/levers/six-link.toml"
    task = Variants(path).task(None)
    assert not task.declared
    values = exact(task_of("levers/six-link"))
    one = Submission("one", work_of(task, values).answers[:6], location="g")
    two = Submission("two", work_of(task, values).answers, location="g")
    (alone,) = check_works(Variants(path), [one])
    beside, _ = check_works(Variants(path), [one, two])
    assert (alone.points, alone.of) == (beside.points, beside.of) == (6.0, len(task.usual()))
    assert alone.answers == beside.answers


UNASKED = [
    ("s24", "1", {"y D": -0.1163, "a D": 22.43, "a E": 36.9}),
    ("s27", "2", {"x D": 0.3987, "angle v D": 12.0}),
    ("s29", "1", {"x D": 0.3, "v D": 9.0, "omega 3": 7.0, "y D": -0.2}),
]
"""Coordinates that the task does not require, in another order in each submission."""


def unasked(told: list[tuple[str, str, dict[str, float]]]) -> list[Submission]:
    return [
        Submission(
            student,
            tuple(WrittenAnswer(what=what, value=v, step=0.01) for what, v in values.items()),
            variant=variant,
            location="g",
        )
        for student, variant, values in told
    ]


def told_of(checked: GradedSubmission) -> tuple[object, ...]:
    """Return the reported parts of a check, without its strokes, whose last bit may differ."""
    return checked.answers, checked.diagnosis, checked.points, checked.of, checked.failure


def test_answers_that_are_not_required_stop_no_work() -> None:
    """Before: KeyError 'asked124', as another variant calls the same coordinate otherwise."""
    rows = (
        "student;variant;what;mm;value",
        "s24;В;y_D;-46,5;-0,1163",
        "s24;В;a_S3;112,2;22,43",
        "s27;Б;x_D;159,5;0,3987",
        "s28;Е;a_E;33,5;13",
    )
    works = read_csv("\n".join(rows).encode(), Path("g.csv"))
    path = ROOT / "problems/levers/task12-variants.toml"
    found = list(check_works(Variants(path), works))
    (alone,) = check_works(Variants(path), works[1:2])
    assert not any(one.failure for one in found)
    assert found[1].diagnosis == alone.diagnosis and alone.diagnosis[0].codes == ("P2",)


def test_answers_that_are_not_required_do_not_change_other_works() -> None:
    path = ROOT / "problems/linkages/ex3-variants.toml"
    works = unasked(UNASKED)
    first = [told_of(one) for one in check_works(Variants(path), works)]
    last = [told_of(one) for one in check_works(Variants(path), works[::-1])]
    assert first == last[::-1]


def test_another_variant_is_named_despite_other_answers() -> None:
    """Six coordinates that are not required have other names in the program of each variant."""
    path = ROOT / "problems/levers/task12-variants.toml"
    theirs = Variants(path).task("Е")
    first = ("y D", "ax E", "vx D", "x D", "ay D", "angle v D")
    group = Variants(path)
    (one,) = unasked([("one", "А", dict.fromkeys(first, 1.0))])
    copied = replace(work_of(theirs, exact(theirs)), variant="А")
    copied = replace(copied, answers=(*copied.answers, *one.answers))
    told = list(check_works(group, [one, copied]))
    assert not any(one.failure for one in told)
    assert [d.codes for d in told[1].diagnosis] == [("P2",)]


@pytest.mark.parametrize("code", ["N1", "A2", "V1"])
def test_another_variants_work_with_a_mistake_of_its_own_is_named(code: str) -> None:
    path = ROOT / "problems/linkages/ex3-variants.toml"
    theirs = Variants(path).task("2")
    theirs.usual()
    mistake = next(e for e in theirs.named(theirs.sheet(0)) if e.code == code)
    work = replace(work_of(theirs, mistake.values), variant="1")
    (found,) = check_works(Variants(path), [work])
    assert [d.codes for d in found.diagnosis] == [("P2",)]
    assert found.points <= found.of / 2
    (own,) = check_works(Variants(path), [replace(work, variant="2")])
    assert ("P2",) not in [d.codes for d in own.diagnosis]


@pytest.mark.parametrize("name", ["gears/gears-ex2", "point/k11-01"])
def test_a_computed_answer_that_is_not_required_does_not_change_other_works(name: str) -> None:
    task = Variants(ROOT / f"problems/{name}.toml").task(None)
    wrong = [
        WrittenAnswer(id=item.id, value=1.17 * item.question.evaluate(Trace({}, {})), step=0.001)
        for item in task.usual()
    ]
    alone = check(task, Submission("s", tuple(wrong)))
    more = [WrittenAnswer(what=what, mm=9.0) for what in ("v", "n 4", "omega 5", "n 2", "a")]
    check(task, Submission("other", tuple(more)))
    assert check(task, Submission("s", tuple(wrong))) == alone


def test_answers_that_are_not_required_lose_no_points() -> None:
    task = task_of("linkages/ex3")
    right = work_of(task, exact(task))
    more = (WrittenAnswer(what="vx B3", value=9.9, step=0.1), *right.answers)
    asked = task.sheet(0).requested
    found, usual = check(task, Submission("s", more)), check(task, right)
    assert task.sheet(0).requested == asked
    assert found.answers[0].verdict is Verdict.WRONG
    assert (found.points, found.of) == (usual.points, usual.of)


# Names and units -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "value"),
    [("l_CB3", 72.477), ("an_B", 160.0), ("at_B", 0.0), ("an_B3", 34.72), ("at_D", 65.96)],
)
def test_names_that_pages_print_are_understood(name: str, value: float) -> None:
    found = answered("linkages/ex3", **{name: value}).answers[0]
    assert found.verdict in (Verdict.OK, Verdict.UNSEEN)
    assert found.key is not None and abs(found.key.exact - value) < 0.01


def test_a_unit_of_another_quantity_is_reported_and_left_undecided() -> None:
    written = WrittenAnswer(id="v_B", value=3.2, unit="м/с²", step=0.1)
    found = check(task_of("linkages/ex3"), Submission("s", (written,))).answers[0]
    assert (found.verdict, found.points, found.of) == (Verdict.UNREADABLE, 0.0, 1.0)
    assert found.is_open
    assert found.written is not None and found.written.unit == "м/с²"


def test_a_length_in_metres_is_reported_in_metres() -> None:
    """l_CB of example 3 is 0.145 m, 72.5 mm of the plan; the key said 0.0725 m."""
    problem = task_of("linkages/ex3").solution.problem
    asked = QuestionSpec(id="l", what="length C B", unit="м")
    task = Task(Solution(replace(problem, answers=(asked,))))
    (entry,) = key_of_task(task).entries
    assert entry.exact / entry.per == pytest.approx(0.14495, abs=1e-5)
    for scales in ({}, {"mu_l": 0.001}):
        work = Submission("s", (WrittenAnswer(id="l", value=0.145, step=0.001),), scales=scales)
        found = check(task, work).answers[0]
        assert found.verdict is Verdict.OK and found.key is not None
        assert (found.value or 0.0) / found.key.per == pytest.approx(0.145)


def test_senses_have_one_form_in_a_key() -> None:
    """ω, ε and moments that turn clockwise had a minus and an arrow, or an arrow alone."""
    words = get_language("ru")
    for name in ("levers/task12", "linkages/ex3"):
        for line in map(KeyPage((key_of_task(task_of(name)),), words).line, entries(name)):
            assert not (line[5] in "↺↻" and line[5] and line[1].startswith("−")), line


def entries(name: str) -> tuple[KeyEntry, ...]:
    return key_of_task(task_of(name)).entries


def test_letters_of_an_inertia_couple_have_no_underscore_of_their_own() -> None:
    assert parse_quantity("inertia couple 2").symbol == "M_{Φ2}"


# Routes --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("written", "follows"),
    [
        ({"v_B": 2.3, "a_B": 82.66}, {"a_B": "v_B"}),  # 2.3²/0.064
        ({"v_B": 2.3, "a_B": 95.0}, {}),
        ({"v_B3": 2.65, "omega_3": (20.0, "ccw"), "an_B3_C": 48.43}, {"an_B3_C": "v_B3"}),
        ({"omega_3": (20.0, "ccw"), "v_B3": 2.24, "an_B3_C": 44.8}, {"an_B3_C": "omega_3"}),  # v·ω
        ({"v_B3": 2.24, "omega_3": (20.0, "ccw"), "v_D": 4.4}, {"v_D": "omega_3"}),  # ω·l
        ({"v_B3": 3.0, "v_D": 4.553}, {"v_D": "v_B3"}),
        ({"at_B3_C": 60.0, "epsilon_3": (413.9, "ccw")}, {"epsilon_3": "at_B3_C"}),
        ({"epsilon_3": (413.9, "ccw"), "at_B3_C": 60.0}, {"epsilon_3": "at_B3_C"}),
        ({"v_B3": "9,0", "omega_3": (62.1, "ccw")}, {"omega_3": "v_B3"}),
        ({"v_B3": "9,0", "omega_3": (55.0, "ccw")}, {}),
        ({"ak_B3_B": 93.1, "omega_3": (20.4, "ccw")}, {"ak_B3_B": "omega_3"}),
    ],
)
def test_a_result_by_a_right_route_is_inherited(
    written: dict[str, float], follows: dict[str, str]
) -> None:
    found = answered("linkages/ex3", **written)
    told = {a.id: a.follows for a in found.answers if a.verdict is Verdict.INHERITED}
    assert told == follows


def test_the_routes_of_example_3_are_those_of_an_independent_computation() -> None:
    """ω₃ = v/l, aⁿ = v²/l, v_D = ω·CD, aᵏ = 2ω·v_r with lengths in metres, from other numbers."""
    values = exact(task_of("linkages/ex3"))
    problem = task_of("linkages/ex3").solution.problem
    points, frame = task_of("linkages/ex3").solution.points, problem.bodies["0"].points
    arm = abs(complex(points["B"].place[0]) - frame["C"])
    for factor in (0.6, 1.4):
        omega = factor * values["omega_3"]
        found = answered(
            "linkages/ex3",
            omega_3=(round(omega, 2), "ccw"),
            v_B3=round(values["v_B3"], 3),
            vs_B3_B=round(abs(values["vs_B3_B"]), 3),
            an_B3_C=round(omega**2 * arm, 2),
            v_D=round(omega * 0.22, 3),
            ak_B3_B=round(2 * omega * abs(values["vs_B3_B"]), 2),
        )
        told = {a.id: a.follows for a in found.answers if a.verdict is Verdict.INHERITED}
        assert told == dict.fromkeys(("an_B3_C", "v_D", "ak_B3_B"), "omega_3")


def test_a_result_follows_from_the_numbers_that_give_it_right_or_wrong() -> None:
    """No other formula may then accuse it of not being from them."""

    def examined(name: str, value: float, *, right: bool) -> ExaminedAnswer:
        item: Any = SimpleNamespace(id=name, question=SimpleNamespace(id=name, sign=Sign.SIZE))
        limit = Tolerance(1.0, 0.02, 0.05, 0.01, 0.1, is_visible=True, zero=False, per_mm=0.01)
        one = ExaminedAnswer(item, WrittenAnswer(id=name), limit, value, signed=False, step=0.0)
        one.right = right
        return one

    right, wrong = examined("v", 1.04, right=True), examined("omega", 1.5, right=False)
    for parents, value, routed in (
        ([(right, 2)], 1.04**2, True),
        ([(right, 1), (wrong, 1)], 1.04 * 1.5, True),
        ([(wrong, 2)], 2.25, True),
        ([(wrong, 2)], 2.0, False),
    ):
        one = examined("an", value, right=False)
        one.contradicts = True
        try_powers(one, parents, 0.005)
        assert (one.routed, one.contradicts) == (routed, not routed)
        assert set(one.parents) == ({p.item.id for p, _ in parents} if routed else set())


def test_velocities_never_follow_accelerations_and_no_answer_follows_itself() -> None:
    found = answered("linkages/ex3", an_B3_C=60.0, omega_3=(20.34, "ccw"), v_B3=2.95)
    told = {a.id: (a.verdict, a.follows) for a in found.answers if a.written}
    assert told["v_B3"][0] is Verdict.WRONG
    assert "an_B3_C" not in {source for _, source in told.values()}
    assert all(source != name for name, (_, source) in told.items())


def test_an_answer_that_a_mistake_leaves_alone_does_not_follow_from_it() -> None:
    """ω₃ with its other sense, which no aᵏ changes, is wrong beside a wrong aᵏ."""
    task = task_of("linkages/ex3")
    task.usual()
    made = next(e for e in task.named(task.sheet(0)) if e.code == "A3")
    work = work_of(task, made.values)
    turned = tuple(replace(a, sense=Sense.CW) if a.id == "omega_3" else a for a in work.answers)
    found = check(task, replace(work, answers=turned))
    assert verdicts(found)["omega_3"] is not Verdict.INHERITED
    # v_B3 a little beyond its tolerance, and wrong for a reason of its own: no aᵏ does that.
    sheet = task.sheet(0)
    examined = [
        examine(task, sheet, task.find(answer), answer)
        for answer in (replace(a, value=2.40) if a.id == "v_B3" else a for a in work.answers)
    ]
    replay(task, sheet, examined)
    assign_verdicts(sheet, examined, task.settings.near)
    by_id = {one.item.id: one for one in examined}
    by_id["v_B3"].verdict = Verdict.WRONG
    told = propagate_mistake(task, sheet, examined, [ExplanationFit(made, 0.0, 0.0, len(examined))])
    assert told.codes == ("A3",) and by_id["v_B3"].verdict is Verdict.WRONG
    inherited = {one.item.id for one in examined if one.verdict is Verdict.INHERITED}
    assert inherited and "v_B3" not in inherited and "v_B3" in told.roots


# Pages ---------------------------------------------------------------------------------------


def sentences(found: GradedSubmission) -> tuple[str, list[str]]:
    told = Remarks(AnswerFormatter(get_language("ru")), found, {"mu_v": 0.05, "mu_a": 1.0})
    return " ".join(told.sentences()), told.redraw()


@pytest.mark.parametrize(
    ("written", "codes", "said"),
    [
        ((17.9, "ccw"), (), "Из ваших же чисел выходит 15,5"),
        ((0.325, "ccw"), ("slip",), "v·l вместо v/l"),
        ((0.0647, "ccw"), ("slip",), "l/v вместо v/l"),
        ((154.5, "ccw"), ("S4",), "сдвинуть запятую"),
    ],
)
def test_a_slip_is_named_if_it_is_certain_and_needs_no_redrawing(
    written: tuple[float, str], codes: tuple[str, ...], said: str
) -> None:
    found = answered("linkages/ex3", v_B3=2.24, omega_3=written)
    told, again = sentences(found)
    assert [d.codes for d in found.diagnosis] == [codes]
    assert said in told and again == []
    assert "проверьте построение" not in told


def test_v_over_l_for_v_squared_over_l_is_a_mistake_not_a_slip() -> None:
    found = answered("linkages/ex3", v_B3=2.24, omega_3=(15.5, "ccw"), an_B3_C=15.5)
    assert [(d.codes, d.sure) for d in found.diagnosis] == [(("N3",), True)]


def test_mistakes_that_no_answer_shows_are_the_keys_matter_not_the_students() -> None:
    """Lengths alone do not show the crank turned the other way: V2 in task 12 В."""
    group = variants(ROOT / "problems/levers/task12-variants.toml")
    task = group.task("В")
    assert isinstance(task.problem, Problem)
    lengths = tuple(QuestionSpec(id=w.replace(" ", "_"), what=w) for w in ("v B", "v D", "a B"))
    task = Task(Solution(replace(task.problem, answers=lengths)))
    key = key_of_task(task)
    assert "V2" in key.hidden
    told, again = sentences(check(task, work_of(task, exact(task))))
    assert told == get_language("ru").check["student"].all_right and again == []


# Two at once ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "codes"),
    [("linkages/ex3", "A1 V5"), ("linkages/ex3", "A2 V3"), ("levers/task12", "A3 N2")],
)
def test_two_mistakes_at_once_are_both_named(name: str, codes: str) -> None:
    """Each explains a part; alone neither does the whole. Of 60 works 35 are named, before 0."""
    task = task_of(name)
    task.usual()
    sheet = task.sheet(0)
    tried = 0
    for one, two in itertools.product(task.named(sheet), repeat=2):
        if f"{one.code} {two.code}" != codes:
            continue
        both = task.explanations(sheet).of_both(one, two)
        if both is None or not _differ(task, both, one, 3) or not _differ(task, both, two, 3):
            continue
        tried += 1
        (work,) = simulate_submissions(task, both.change, 1, 4)
        found = check(task, work)
        assert {d.codes for d in found.diagnosis if d.sure} == {(c,) for c in codes.split()}
        assert len({d.roots[0] for d in found.diagnosis}) == 2
        given = {made.code: made.values for made in (one, two)}
        right = {e.id: e.exact for e in key_of_task(task).entries}
        for diagnosis in found.diagnosis:  # neither begins at an answer that it does not change
            root, values = diagnosis.roots[0], given[diagnosis.codes[0]]
            for id in (root, *(a.id for a in found.answers if a.follows == root)):
                assert values[id] != pytest.approx(right[id], rel=1e-9), (root, id)
        break
    assert tried


def test_two_plans_of_a_wrong_scale_are_two_mistakes() -> None:
    """Millimetres for m/s, and the quotient by the scale for m/s²; all else follows."""
    path = ROOT / "benchmarks/checking/problems/h-13.toml"
    told = {
        "v_B": 2.16,
        "v_B3": 76,
        "vs_B3_B": 41,
        "omega_3": -594,
        "v_D": 142,
        "v_E": 150,
        "v_E_D": 35,
        "omega_4": -159,
        "a_B": 38.9,
        "ak_B3_B": 48700,
        "an_B3_C": 45100,
        "at_B3_C": 196000,
        "ar_B3_B": 180000,
        "a_B3": 266000,
        "epsilon_3": 1530000,
        "a_D": 498000,
        "an_E_D": 5570,
        "at_E_D": 258000,
        "a_E": 337000,
        "epsilon_4": -1170000,
    }
    task = variants(path).task("3")
    found = check(task, work_of(task, told))
    assert [(d.codes, d.mistake_at) for d in found.diagnosis if d.codes] == [
        (("scale",), "mu_v"),
        (("S1",), "mu_a"),
    ]


def _differ(task: Task, one: Explanation, two: Explanation, least: int) -> bool:
    """Return whether some answers are surely different."""
    limits = {e.id: max(3 * e.sigma, e.tolerance) for e in key_of_task(task).entries}
    pairs = [(limits[i.id], *(e.values[i.question.id] for e in (one, two))) for i in task.usual()]
    return sum(abs(abs(a) - abs(b)) > limit for limit, a, b in pairs) >= least
