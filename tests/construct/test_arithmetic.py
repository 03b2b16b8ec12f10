from __future__ import annotations

import cmath
import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from doors import (
    Builder,
    Float64,
    PointName,
    RulerArithmetic,
    evaluate_evaluate as evaluate,
    unit_vectors,
)
from hypothesis import example, given, strategies as st


def scalar(value: Any) -> complex:
    return complex(np.asarray(value))


# Directions ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("turns", [0, 1, -1, 7, 1_000_000, -1_000_000])
def test_quadrants_are_exact_after_any_number_of_turns(turns: int) -> None:
    for k, wanted in enumerate((1, 1j, -1, -1j)):
        assert scalar(unit_vectors(90.0 * k + 360.0 * turns)) == wanted
        assert scalar(unit_vectors(90.0 * k - 360.0 * turns)) == wanted


@given(st.integers(-360_000, 360_000), st.integers(-1_000_000, 1_000_000))
def test_a_million_turns_cost_no_accuracy(thousandths: int, turns: int) -> None:
    """Angles with a binary fraction are exact numbers after any number of turns."""
    angle = thousandths / 1024
    assert scalar(unit_vectors(angle + 360.0 * turns)) == scalar(unit_vectors(angle))


@given(st.floats(-720, 720))
def test_directions_are_unit_vectors(angle: float) -> None:
    u = scalar(unit_vectors(angle))
    assert abs(abs(u) - 1) < 4e-16
    assert abs(u - cmath.rect(1.0, math.radians(math.remainder(angle, 360.0)))) < 4e-15
    assert abs(scalar(unit_vectors(angle + 180.0)) + u) < 4e-15


def test_directions_come_in_batches() -> None:
    assert unit_vectors(np.array([0.0, 90.0, 180.0, 270.0, 359.9999999])).tolist()[:4] == [
        1, 1j, -1, -1j,
    ]  # fmt: skip
    assert unit_vectors(np.array([360.0 - 1e-12]))[0] == pytest.approx(1)


@pytest.mark.parametrize("angle", [45.0, -45.0, 135.0, 225.0])
def test_halves_of_a_quadrant(angle: float) -> None:
    u = scalar(unit_vectors(angle))
    assert abs(u.real) == pytest.approx(math.sqrt(0.5), rel=1e-15)
    assert abs(u.imag) == pytest.approx(math.sqrt(0.5), rel=1e-15)


# The exact arithmetic -----------------------------------------------------------------------------


def test_float64() -> None:
    ar = Float64()
    assert ar.root(np.array([4.0, 0.0, -1.0])).tolist() == [2.0, 0.0, 0.0]
    value = ar.guard(np.array([1.0, 0.5]), 0.5, np.array([1 + 1j, 2 + 2j]))
    assert value[0] == 1 + 1j
    assert np.isnan(value[1].real) and np.isnan(value[1].imag)
    assert np.isnan(ar.nonzero(np.array([0.0, 2.0]))).tolist() == [True, False]
    assert ar.unless_zero(np.array([0.0, 3.0]), 1.0, 2.0).tolist() == [2.0, 1.0]
    assert [float(x) for x in ar.ordered(0.3, 0.2)] == [0.2, 0.3]
    assert ar.direction_margin(np.array([0.0, 1e-300, -2.0])).tolist() == [0.0, 1.0, 1.0]
    assert ar.read("l", 1.2345) == 1.2345
    shares = ar.length_ratio(np.array([-30.0, 50.0, 2.0]), np.array([30 + 40j, 30 + 40j, 0j]))
    assert shares.tolist() == [0.6, 1.0, 1.0]
    assert isinstance(ar.lift(3.0), np.ndarray)


# The ruler ----------------------------------------------------------------------------------------


def marks(length: float, ruler: str) -> Fraction:
    """Nearest mark in exact fractions, ties away from zero."""
    step = Fraction(ruler)
    count = math.floor(abs(Fraction(length)) / step + Fraction(1, 2))
    return (-1 if length < 0 else 1) * count * step


@given(st.floats(-500, 500), st.sampled_from(["0.5", "1", "2", "0.25"]))
@example(0.25, "0.5")
@example(-0.25, "0.5")
@example(0.75, "0.5")
@example(2.5, "1")
@example(-2.5, "1")
@example(3.5, "1")
@example(0.0, "1")
def test_a_ruler_rounds_to_the_nearest_mark_and_ties_away_from_zero(
    length: float, ruler: str
) -> None:
    read = float(RulerArithmetic(ruler=float(ruler)).ruled(length))
    wanted = marks(length, ruler)
    if abs(abs(Fraction(length)) % Fraction(ruler) - Fraction(ruler) / 2) > Fraction(1, 10**12):
        assert Fraction(read) == wanted
    else:  # 0.49999999999999994 + 0.5 is 1 in floating point
        assert abs(Fraction(read) - wanted) in (0, Fraction(ruler))


def test_ties_and_signs() -> None:
    hand = RulerArithmetic(ruler=1.0)
    lengths = np.array([0.5, 1.5, 2.5, -0.5, -1.5, -2.5, 0.49, -0.49, 0.0])
    assert hand.ruled(lengths).tolist() == [1.0, 2.0, 3.0, -1.0, -2.0, -3.0, 0.0, 0.0, 0.0]
    assert RulerArithmetic(ruler=0.5).ruled(np.array([72.25, -72.25])).tolist() == [72.5, -72.5]
    assert RulerArithmetic().ruler == 0.5


@pytest.mark.parametrize("ruler", [0.0, -1.0, math.nan, math.inf])
def test_a_ruler_has_a_step(ruler: float) -> None:
    with pytest.raises(ValueError, match="ruler step must be positive"):
        RulerArithmetic(ruler=ruler)


# Chains of the hand -------------------------------------------------------------------------------

PLACES = {"b": 0j, "c": 31.0668 + 0j, "B": 0j, "C": 47.3 + 0j, "S": -14.1 + 0j}


def similar(hand: Float64, *, span: bool = False, arm: bool = False, sign: float = 1.0) -> complex:
    b = Builder()
    for name in PLACES:
        b.take_point(name)
    plan, link = (PointName("b"), PointName("c")), (PointName("B"), PointName("C"), PointName("S"))
    side = b.compute("side", (b.measure("bc", *plan), 1), factor=sign)
    at = b.similar(
        "s",
        plan,
        link,
        side,
        span=b.measure("BC", link[0], link[1]) if span else None,
        arm=b.measure("BS", link[0], link[2]) if arm else None,
    )
    return scalar(evaluate(b.program(), PLACES, hand).value[at])


def test_a_similar_point_is_computed_from_the_read_side() -> None:
    """bs = bc·BS/BC with bc as it was read, BS and BC as they were given."""
    assert similar(Float64()) == pytest.approx(31.0668 * -14.1 / 47.3)
    assert similar(RulerArithmetic(ruler=1.0)) == pytest.approx(31 * -14.1 / 47.3, rel=1e-14)
    assert similar(RulerArithmetic(ruler=1.0), sign=-1.0) == similar(
        RulerArithmetic(ruler=1.0)
    )  # read along a line


def test_lengths_of_the_link_without_a_given_number_are_read_too() -> None:
    hand = RulerArithmetic(ruler=1.0)
    assert similar(hand, span=True) == pytest.approx(31 * -14.1 / 47, rel=1e-14)
    assert similar(hand, arm=True) == pytest.approx(31 * -14 / 47.3, rel=1e-14)
    assert similar(hand, span=True, arm=True) == pytest.approx(31 * -14 / 47, rel=1e-14)


def test_readings_of_exact_arithmetic_have_no_effect() -> None:
    assert similar(Float64(), span=True, arm=True) == similar(Float64())


def test_a_measured_length_is_rounded_and_stays_rounded() -> None:
    b = Builder()
    p, q = b.take_point("P"), b.take_point("Q")
    pq = b.measure("pq", p, q)
    omega = b.compute("omega", (pq, 1), factor=0.5)
    qp = b.measure_along("qp", q, p, b.join(p, q))
    trace = evaluate(b.program(), {"P": 0j, "Q": 31.4 + 0j}, RulerArithmetic(ruler=1.0))
    assert [float(trace.value[name]) for name in (pq, omega, qp)] == [31.0, 15.5, -31.0]
