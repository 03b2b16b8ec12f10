"""Right answers written down wrongly are one mistake: the rest stays right."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import pytest
from cases import some
from doors import (
    DEFAULT,
    GradedAnswer,
    Submission,
    Task,
    Variants,
    Verdict,
    WrittenAnswer,
    check,
)
from msgspec.structs import replace
from planted import checked, exact, task_of, verdicts, work_of
from test_computed_answers import (
    RIGHT,
    TRAIN,
    checked as checked_numbers,
    codes,
    verdicts as verdicts_of_numbers,
)
from worked import SIX

MECHANISMS = [name for name in SIX if name not in ("linkages/ex1", "levers/six-link")]
"""Those with two answers of one unit that differ by a third, and a drawing can show."""


def distinct_pairs(task: Task) -> Iterator[tuple[GradedAnswer, GradedAnswer]]:
    """Yield the answers of one unit whose sizes differ by a third."""
    known = check(task, work_of(task, exact(task)))
    shown = [a for a in known.answers if a.key and a.key.is_visible and not a.key.zero]
    for one, two in combinations(shown, 2):
        assert one.key is not None and two.key is not None
        sizes = sorted((abs(one.key.exact), abs(two.key.exact)))
        if one.key.unit == two.key.unit and sizes[1] > 1.33 * sizes[0]:
            yield one, two


def cells(one: GradedAnswer, two: GradedAnswer, *, sense: bool) -> dict[str, WrittenAnswer]:
    """Return two answers with their values exchanged, with the senses or without."""
    assert one.written is not None and two.written is not None
    return {
        own.id: replace(own, value=put.value, step=put.step, sense=(put if sense else own).sense)
        for own, put in ((one.written, two.written), (two.written, one.written))
    }


@pytest.mark.parametrize("name", MECHANISMS)
def test_two_exchanged_answers_cost_the_first_of_them(name: str) -> None:
    task = task_of(name)
    right = work_of(task, exact(task))
    pairs = [*distinct_pairs(task)]
    assert pairs
    for number, (one, two) in enumerate(pairs[:: some(1, 6)]):
        put = cells(one, two, sense=number % 2 == 0)
        found = check(task, replace(right, answers=tuple(put.get(a.id, a) for a in right.answers)))
        told = [(d.codes, d.sure, d.roots) for d in found.diagnosis]
        assert told == [(("swap",), True, (one.id,))], (one.id, two.id)
        assert found.points == found.of - 1.0, (one.id, two.id)
        assert Verdict.INCONSISTENT not in verdicts(found).values()


def test_a_mistake_beside_an_exchange_is_named_too() -> None:
    """ex3: v_D and v_B3 exchanged, and the decimal point of a_B moved."""
    right = dict(exact(task_of("linkages/ex3")))
    exchanged = {"v_B3": right["v_D"], "v_D": right["v_B3"]}
    found = checked("linkages/ex3", **right | exchanged | {"a_B": 10 * right["a_B"]})
    assert [d.codes for d in found.diagnosis] == [("swap",), ("S4",)]


def test_segments_read_each_for_the_other_are_another_segment_read() -> None:
    """ex3: v_E and v_ED exchanged, and ω₄ found from the wrong one."""
    right = exact(task_of("linkages/ex3"))
    whole, part = right["v_E"], right["v_E_D"]
    omega = abs(right["omega_4"] * whole / part)
    found = checked("linkages/ex3", v_D=right["v_D"], v_E=part, v_E_D=whole, omega_4=omega)
    assert [(d.codes, d.roots) for d in found.diagnosis] == [(("V6",), ("v_E",))]
    assert [id for id, verdict in verdicts(found).items() if verdict is Verdict.WRONG] == ["v_E"]


def test_numbers_that_are_only_near_each_other_are_not_exchanged() -> None:
    right = exact(task_of("linkages/ex3"))
    told = {"v_B3": 1.3 * right["v_D"], "v_D": right["v_B3"]}
    assert all(
        "swap" not in d.codes for d in checked("linkages/ex3", **{**right, **told}).diagnosis
    )


def test_exchanged_speeds_of_a_train_leave_what_follows_from_the_right_ones() -> None:
    told = RIGHT | {"n_H": RIGHT["n_5"], "n_5": RIGHT["n_H"]}
    found = checked_numbers(TRAIN, told)
    assert codes(found) == [("swap",)]
    assert verdicts_of_numbers(found) == dict.fromkeys(RIGHT, "ok") | {
        "n_H": "wrong",
        "n_5": "inherited",
    }


def test_a_slip_of_the_pen_is_certain_where_the_student_went_on_with_the_right_number() -> None:
    """ex3: a^τ_B3C = 43.46 as 34.46 or 434.6, while ε₃ is of 43.46."""
    right = exact(task_of("linkages/ex3"))
    told = {key: abs(right[key]) for key in ("v_B3", "an_B3_C", "at_B3_C", "a_B3", "epsilon_3")}
    for raw in ("34.46", "434.6"):
        written = [
            WrittenAnswer(id=key, value=value, step=value * 1e-3, location=key)
            if key != "at_B3_C"
            else WrittenAnswer(id=key, value=float(raw), step=0.01, raw=raw, location=key)
            for key, value in told.items()
        ]
        found = check(task_of("linkages/ex3"), Submission("s", tuple(written)))
        (slip,) = found.diagnosis
        assert (slip.codes, slip.sure, slip.roots) == (("S4",), True, ("at_B3_C",))
        fine = (Verdict.OK, Verdict.UNSEEN, Verdict.BLANK)
        assert [id for id, v in verdicts(found).items() if v not in fine] == ["at_B3_C"]


def test_swapped_digits_of_a_computed_number_are_named_and_other_wrong_ones_are_not() -> None:
    for raw, named in (("-357", ("S4",)), ("-735", ("S4",)), ("-395", ()), ("-351", ())):
        told = tuple(
            WrittenAnswer(id=key, value=value, raw=f"{value:g}") for key, value in RIGHT.items()
        )
        put = WrittenAnswer(id="n_5", value=float(raw), step=1.0, raw=raw)
        answers = tuple(put if one.id == "n_5" else one for one in told)
        found = check(Variants(TRAIN, DEFAULT).task(None), Submission("s", answers))
        assert codes(found) == [named], raw
