"""Every answer of a task at its limits: the mistakes that it shows, the values that are right."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

from doors import (
    DEFAULT,
    GradedSubmission,
    Key,
    KeyEntry,
    Sense,
    Solution,
    Submission,
    Task,
    Variants,
    Verdict,
    WrittenAnswer,
    check,
    key_of_task,
)
from worked import problem_of

Effect = tuple[str, str, Mapping[str, float]]


@cache
def ex3() -> Task:
    return Task(Solution(problem_of("linkages/ex3")))


@cache
def key() -> Key:
    return key_of_task(ex3())


def shown(entry: KeyEntry, question: str, factor: float, away: float = 0.0) -> bool:
    """Return whether an answer shows a mistake that turns it into a multiple, or moves it away."""
    task = ex3()
    right = dict(key_exact())
    value = right[question] * factor + away * (1 if right[question] > 0 else -1)

    def named(_: object) -> Iterator[Effect]:
        yield "X1", "here", right | {question: value}

    found = key_of_task(task, named=named)
    (own,) = (one for one in found.entries if one.id == entry.id)
    others = [one for one in found.entries if one.id != entry.id]
    assert all(one.hidden == ("X1",) for one in others)
    assert ("X1" in found.hidden) == (own.hidden == ("X1",))
    return not own.hidden


@cache
def key_exact() -> dict[str, float]:
    """Return the exact values of the questions, with their signs."""
    sheet = ex3().sheet(ex3().list_items()[0].position).answer_key_sheet
    return {item.question.id: sheet.exact_answers[item.question.id] for item in ex3().list_items()}


def test_an_answer_shows_a_mistake_from_its_tolerance_on_and_by_its_sense() -> None:
    """A turned sense where it is requested; the size by more than k σ and the tolerance."""
    senses = []
    items = {item.name: item for item in ex3().list_items()}
    for entry in key().entries:
        question = items[entry.id].question.id
        if [items[one].question.id for one in items].count(question) > 1 or entry.zero:
            continue
        assert not shown(entry, question, 1.0)
        assert shown(entry, question, -1.0) == entry.asks_sense, entry.id
        assert shown(entry, question, 30.0)
        senses.append(entry.asks_sense)
        bound = entry.tolerance if entry.is_visible else 0.0
        if bound:
            assert not shown(entry, question, 1.0, 0.999 * bound), entry.id
            assert not shown(entry, question, 1.0, -0.999 * bound), entry.id
            assert shown(entry, question, 1.0, max(1.001 * bound, 2.02 * entry.sigma)), entry.id
    assert {True, False} == {*senses}


def graded(changed: str, factor: float, sense: Sense | None = None) -> GradedSubmission:
    """Grade a work that is right but for one answer."""
    written = []
    for entry in key().entries:
        own = entry.id == changed
        value = abs(entry.exact) if entry.asks_sense else entry.exact
        written.append(
            WrittenAnswer(
                id=entry.id,
                value=value * factor if own else value,
                sense=sense if own and sense else entry.sense if entry.asks_sense else None,
            )
        )
    return check(ex3(), Submission("s", tuple(written)))


def verdict(changed: str, factor: float, sense: Sense | None = None) -> Verdict:
    (found,) = (one for one in graded(changed, factor, sense).answers if one.id == changed)
    return found.verdict


TURNED = {Sense.CCW: Sense.CW, Sense.CW: Sense.CCW}


def test_a_right_work_has_all_points_and_the_answers_in_the_order_of_the_key() -> None:
    found = graded("", 1.0)
    assert [one.id for one in found.answers] == [entry.id for entry in key().entries]
    assert {one.verdict for one in found.answers} <= {Verdict.OK, Verdict.UNSEEN}
    assert found.points == found.of == sum(entry.points for entry in key().entries)


def test_an_answer_is_right_up_to_its_tolerance_and_with_its_sense_only() -> None:
    visible = [one for one in key().entries if one.is_visible and not one.zero]
    for entry in visible[:: max(1, len(visible) // 4)]:
        share = entry.tolerance / abs(entry.exact)
        for sign in (1.0, -1.0):
            assert verdict(entry.id, 1.0 + 0.999 * sign * share) is Verdict.OK, entry.id
            assert verdict(entry.id, 1.0 + 1.01 * sign * share) is not Verdict.OK, entry.id
    turned = [one for one in visible if one.asks_sense and one.sense in TURNED]
    assert turned
    for entry in turned:
        assert entry.sense is not None
        assert (entry.exact > 0) == (entry.sense is Sense.CCW)
        work = graded(entry.id, 1.0, TURNED[entry.sense])
        (one,) = (one for one in work.answers if one.id == entry.id)
        assert one.sense_right is False and one.verdict is not Verdict.OK, entry.id
        assert 0.0 < work.points < work.of
        assert one.points < entry.points


POINT = """
[point]
x = "3*t"
y = "2*t^2"
t = 1
[[answers]]
what = "vx"
[[answers]]
what = "vy"
[[answers]]
what = "v"
"""


def test_a_result_of_a_wrong_number_is_inherited_to_half_a_unit_of_its_last_digit(
    tmp_path: Path,
) -> None:
    """With v_x = 3.3 for 3, v is 5.1856 within half of 0.1 and the floor of 0.5 %, either way."""
    path = tmp_path / "p.toml"
    path.write_text(POINT, "utf-8")
    task = Variants(path, DEFAULT).task(None)
    own = (3.3**2 + 4.0**2) ** 0.5
    slack = DEFAULT.floor_share * own + 0.05
    for off, due in (
        (0.98, Verdict.INHERITED),
        (-0.98, Verdict.INHERITED),
        (1.02, Verdict.WRONG),
        (-1.02, Verdict.WRONG),
    ):
        answers = (
            WrittenAnswer(id="vx", value=3.3, step=0.001),
            WrittenAnswer(id="vy", value=4.0, step=0.001),
            WrittenAnswer(id="v", value=own + off * slack, step=0.1),
        )
        found = {one.id: one.verdict for one in check(task, Submission("s", answers)).answers}
        assert found == {"vx": Verdict.WRONG, "vy": Verdict.OK, "v": due}, off
