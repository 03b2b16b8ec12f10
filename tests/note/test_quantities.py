"""Every kind of selector against numbers worked out by hand."""

from __future__ import annotations

from functools import cache
from math import sqrt

import pytest
from cases import each
from doors import (
    Analysis,
    NoValue,
    NoValueError,
    QuantityKind,
    QuantityValues,
    Solution,
    parse_quantity,
)
from slotted import R, problem_of


@cache
def kulisa() -> QuantityValues:
    return QuantityValues(Solution(problem_of(), ruler=0.5))


EXACT = {
    "x D": 0.3 * R,
    "y D": 0.3 * R - 0.1,
    "x B3": 0.1,
    "v B": 1.0,
    "v B3": R,
    "v D B3": 5 * (0.3 - 0.2 * R),
    "vx D": -1.5 * R,
    "vy D": 1.5 * R,
    "vs B3 B": R,
    "omega 1": 10.0,
    "omega 2": 5.0,
    "omega 3": 5.0,
    "phi 3": 45.0,
    "a B": sqrt(104),
    "ax B": -10.0,
    "ay B": 2.0,
    "an B A": 10.0,
    "at B A": 2.0,
    "ak B3 B": 10 * R,
    "ak B B3": 10 * R,
    "an B3 C": 5 * R,
    "at B3 C": 2 * R,
    "ar B3 B": 3 * R,
    "epsilon 3": 10.0,
    "an D C": 7.5,
    "at D C": 3.0,
    "a D": sqrt(7.5**2 + 3**2),
    "a D B3": (0.3 - 0.2 * R) * sqrt(25**2 + 10**2),
    "length A B": 50.0,
    "length C B3": 100 * R,
    "segment velocity p B3": 50 * R,
    "segment velocity B B3": 50 * R,
    "segment acceleration p B": 10 * sqrt(104),
    "vx D / omega 1": -0.15 * R,
    "omega 3 / omega 1": 0.5,
    # P13 is above A: on AC, and on the line across the guide through B.
    "centre x 1 3": 0.0,
    "centre y 1 3": 0.1,
    "centre distance 1 3 A": 0.1,
    "centre distance 3 1 C": 0.2,
    "centre v D": 1.5,
    "centre omega 3": 5.0,
    "x1 D": -0.15 * R,
    "y1 D": 0.15 * R,
    "x2 D": -0.075 * R,  # it goes on a circle of 0.3 m at half a radian per radian
    "y2 D": -0.075 * R,
    "phi1 3": 0.5,
    "phi2 3": 0.0,
    "v_q D": 0.15,
    "a_q D": 0.075,
    "u 3 1": 0.5,
    "u 1 3": 2.0,
    "epsilon_q 3": 0.0,
}


@each("what, value", EXACT.items())
def test_exact_values_of_selectors(what: str, value: float) -> None:
    assert kulisa().exact(parse_quantity(what)) == pytest.approx(value, rel=1e-12, abs=1e-12)


def test_every_quantity_is_tested() -> None:
    named = {kind for kind in QuantityKind if kind.word or kind.part}
    wanted = {kind for kind in named if kind.analysis is Analysis.MOTION}
    assert {parse_quantity(name).kind for name in EXACT} == wanted


def test_the_hand_reads_along_its_own_chain() -> None:
    """pb3 = 35.36 mm is read 35.5, CB = 70.71 mm is read 70.5; the rest follows from these."""
    omega = 35.5 * 0.02 / (70.5 * 0.002)
    expected = {
        "v B3": 0.71,
        "length C B3": 70.5,
        "segment velocity p B3": 35.5,
        "omega 3": omega,
        "omega 3 / omega 1": omega / 10,
        "an B3 C": omega**2 * 0.141,
        "an D C": omega**2 * 0.3,
        "vs B3 B": 0.71,
        "x D": 0.212,
        "an B A": 10.0,
        "v_q B3": 0.1 * 35.5 / 50,
        "u 3 1": 0.1 * 35.5 / 50 / 0.141,
        "v_q B": 0.1,
    }
    for what, value in expected.items():
        assert kulisa().read(parse_quantity(what)) == pytest.approx(value, rel=1e-12), what


def test_the_hand_reads_its_stated_results() -> None:
    hand = kulisa().solution.read_off
    expected = {
        "a D": hand("a_D")[0],
        "epsilon 3": hand("epsilon_3")[0],
        "at B3 C": abs(hand("epsilon_3")[0]) * 0.141,
        "ak B3 B": hand("ak_B3/2")[0],
        "ar B3 B": hand("ar_B3/2")[0],
    }
    for what, value in expected.items():
        assert kulisa().read(parse_quantity(what)) == pytest.approx(value, rel=1e-12), what


def test_an_angle_is_read_with_a_protractor_and_what_no_plan_has_is_not_read() -> None:
    values, key = kulisa(), parse_quantity("phi 3")
    assert values.read(key) == pytest.approx(values.exact(key), abs=0.5)
    assert values.read(key) == round(2.0 * (values.read(key) or 0.0)) / 2.0
    assert kulisa().read(parse_quantity("x2 D")) is None


@pytest.mark.parametrize(
    ("what", "why"),
    [
        ("ak D C", NoValue.NO_SLIDING),
        ("centre x 2 3", NoValue.NO_CENTRE),
        ("centre distance 0 9 A", NoValue.NO_CENTRE),
        ("an B D", NoValue.NO_LINK),
        ("v Q", NoValue.NO_POINT),
        ("omega 9", NoValue.NO_LINK),
        ("v D / v A", NoValue.ZERO_DIVISOR),
    ],
)
def test_quantities_that_the_solution_does_not_have_are_rejected(what: str, why: NoValue) -> None:
    with pytest.raises(NoValueError) as caught:
        kulisa().exact(parse_quantity(what))
    assert caught.value.reason is why
