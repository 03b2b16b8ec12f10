"""Tolerances of answers that are short or cannot be seen on the drawing, and their verdicts."""

from __future__ import annotations

from statistics import NormalDist
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from cases import each
from doors import (
    FOLDED,
    ExaminedAnswer,
    Settings,
    Sign,
    Tolerance,
    Verdict,
    WrittenAnswer,
    assign_verdicts,
    parse_quantity,
    tolerance_limit_of as limit_of,
)


def test_folded_is_the_ratio_of_the_folded_spread_to_the_middle_68_per_cent() -> None:
    """|x| of a normal x: one sigma of x over half the range of the middle 68 % of |x|."""
    normal = NormalDist()

    def size(share: float) -> float:
        return normal.inv_cdf((1 + share) / 2)

    one = normal.cdf(1) - normal.cdf(-1)
    half = (size((1 + one) / 2) - size((1 - one) / 2)) / 2
    assert pytest.approx(1 / half, rel=0.05) == FOLDED
    drawn = np.abs(np.random.default_rng(1).normal(size=100_000))
    low, high = np.quantile(drawn, [(1 - one) / 2, (1 + one) / 2])
    assert pytest.approx(2 / (high - low), rel=0.05) == FOLDED


def limit(exact: float, sigma: float, *, sign: Sign = Sign.SIZE, **settings: Any) -> Tolerance:
    """Return the limit of an answer that is laid off at 0.01 a millimetre."""
    question: Any = SimpleNamespace(
        id="v_B", is_mm=False, scale="mu_v", sign=sign, key=parse_quantity("v B")
    )
    sheet: Any = SimpleNamespace(
        exact_answers={"v_B": exact},
        scales={"mu_v": 0.01},
        sigma=lambda _: sigma,
        length=lambda _: 1.0,
    )
    return limit_of(sheet, question, Settings(**settings), None)


def test_a_zero_size_may_be_read_as_long_as_folded_errors_make_it() -> None:
    k = Settings().k
    found = limit(0.0, 0.1)
    assert found.zero
    assert found.spread == pytest.approx(1.7 * k * 0.1)
    assert found.allows(1.6 * k * 0.1, 1.6 * k * 0.1)
    assert not found.allows(1.8 * k * 0.1, 1.8 * k * 0.1)
    # If the exact size is not zero, it is part of the drawn size, and less is added.
    assert limit(0.1, 0.1).spread == pytest.approx(max(k * 0.1, 1.7 * k * 0.1 - 0.1))
    # If the exact size is small, this is less than a millimetre; if large, the errors decide.
    assert limit(0.05, 0.1).spread == pytest.approx(1.7 * k * 0.1 - 0.05)
    strict = limit(0.0, 0.1, sign=Sign.STRICT)
    assert strict.spread == pytest.approx(k * 0.1)  # a number with a sign is not folded


@each("exact, zero", [(0.0, True), (0.37, True), (0.375, False), (0.38, False)])
def test_a_value_below_three_sigmas_is_too_short_to_be_measured(exact: float, zero: bool) -> None:
    assert limit(exact, 0.125).zero == zero


def test_the_drawing_shows_values_whose_errors_are_below_the_cap() -> None:
    settings = Settings()
    at_cap = settings.cap / settings.k
    assert limit(1.0, 0.99 * at_cap).is_visible
    assert not limit(1.0, 1.01 * at_cap).is_visible


def test_a_policy_takes_the_wider_or_the_stricter_tolerance() -> None:
    own = limit(1.0, 0.01)
    for department in (0.5 * own.tolerance(), 3.0 * own.tolerance()):
        wider, stricter, flat = (
            limit(1.0, 0.01, department=department, policy=policy).tolerance()
            for policy in ("wider", "stricter", "department")
        )
        assert wider == pytest.approx(max(own.tolerance(), department))
        assert stricter == pytest.approx(min(own.tolerance(), department))
        assert flat == pytest.approx(department)


# Verdicts on values that the drawing cannot show --------------------------------------------------

UNSEEN = Tolerance(1.0, 0.2, 0.4, 0.02, 0.1, is_visible=False, zero=False, per_mm=0.01)
"""Tolerance of a value drawn to 0.4 at best, where a tolerance may be 0.1 at most."""


def verdict(value: float, limit: Tolerance = UNSEEN, near: float = 1.5, **more: Any) -> Verdict:
    item: Any = SimpleNamespace(id="v_B", question=SimpleNamespace(sign=Sign.SIZE))
    one = ExaminedAnswer(
        item, WrittenAnswer(id="v_B"), limit, value, signed=False, step=0.0, **more
    )
    one.right = limit.allows(one.off, abs(value))
    sheet: Any = SimpleNamespace(order={})
    assign_verdicts(sheet, [one], near)
    return one.verdict


@each("off, due", [
    (0.05, Verdict.UNSEEN),
    (0.3, Verdict.UNSEEN),  # further off than the cap, no further than the drawing
    (0.39, Verdict.UNSEEN),
    (0.55, Verdict.UNSEEN),  # near enough not to be sure
    (0.65, Verdict.WRONG),
    (5.0, Verdict.WRONG),
])  # fmt: skip
def test_the_error_of_a_drawing_is_not_held_against_an_answer(off: float, due: Verdict) -> None:
    assert verdict(1.0 + off) is due
    if off < 1:
        assert verdict(1.0 - off) is due


def test_a_value_within_the_errors_of_a_drawing_is_not_called_inherited() -> None:
    """The value follows from a wrong number, but the drawing cannot show that it is wrong."""
    item: Any = SimpleNamespace(id="omega_2", question=SimpleNamespace(sign=Sign.SIZE))
    shown = Tolerance(1.0, 0.02, 0.04, 0.02, 0.1, is_visible=True, zero=False, per_mm=0.01)
    for off, due in ((0.3, Verdict.UNSEEN), (0.45, Verdict.INHERITED)):
        parent = ExaminedAnswer(
            item, WrittenAnswer(id="omega_2"), shown, 1.3, signed=False, step=0.0
        )
        own: Any = SimpleNamespace(id="v_B", question=SimpleNamespace(sign=Sign.SIZE))
        child = ExaminedAnswer(
            own, WrittenAnswer(id="v_B"), UNSEEN, 1.0 + off, signed=False, step=0.0
        )
        child.parents, child.follows = {"omega_2": 1.0}, True
        sheet: Any = SimpleNamespace(order={})
        assign_verdicts(sheet, [parent, child], 1.5)
        assert (parent.verdict, child.verdict) == (Verdict.WRONG, due)


def test_a_result_of_a_value_that_the_drawing_cannot_show_is_inherited() -> None:
    """The parent is off by no more than the drafting error, so neither value counts as wrong."""
    item: Any = SimpleNamespace(id="a_B", question=SimpleNamespace(sign=Sign.SIZE))
    shown = Tolerance(1.0, 0.02, 0.04, 0.02, 0.1, is_visible=True, zero=False, per_mm=0.01)
    own: Any = SimpleNamespace(id="epsilon_2", question=SimpleNamespace(sign=Sign.SIZE))
    for value, follows, due in (
        (1.3, True, Verdict.INHERITED),
        (1.3, False, Verdict.WRONG),
        (1.0, True, Verdict.WRONG),  # a right parent gives no inherited mistake
    ):
        parent = ExaminedAnswer(
            item, WrittenAnswer(id="a_B"), UNSEEN, value, signed=False, step=0.0
        )
        parent.right = value == 1.0
        child = ExaminedAnswer(
            own, WrittenAnswer(id="epsilon_2"), shown, 1.3, signed=False, step=0.0
        )
        child.parents, child.follows = {"a_B": 1.0}, follows
        assign_verdicts(SimpleNamespace(order={}), [child, parent], 1.5)  # type: ignore[arg-type]
        assert (parent.verdict, child.verdict) == (Verdict.UNSEEN, due)


def test_a_tolerance_is_at_most_the_cap_except_for_zero() -> None:
    assert limit(0.04, 0.001).minimum == pytest.approx(0.1 * 0.04)  # not the half millimetre, 0.005
    assert limit(0.06, 0.001).minimum == pytest.approx(0.005)
    assert UNSEEN.tolerance() == pytest.approx(0.1) and UNSEEN.tolerance(1.0) == pytest.approx(0.1)
    nothing = Tolerance(0.0, 0.2, 0.4, 0.02, 0.1, is_visible=True, zero=True, per_mm=0.01)
    assert nothing.tolerance() == pytest.approx(0.4)


def test_a_contradiction_of_ones_own_numbers_is_wrong_within_the_errors_too() -> None:
    assert verdict(1.3, contradicts=True) is Verdict.WRONG
    assert verdict(1.3, sense_right=False) is Verdict.WRONG
    assert verdict(1.9, follows=True) is Verdict.UNSEEN  # as in the student's own plan


def test_a_value_shown_by_the_drawing_is_judged_by_its_tolerance() -> None:
    seen = Tolerance(1.0, 0.02, 0.04, 0.02, 0.1, is_visible=True, zero=False, per_mm=0.01)
    assert verdict(1.03, seen) is Verdict.OK
    assert verdict(1.05, seen) is Verdict.WRONG
