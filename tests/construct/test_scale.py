from __future__ import annotations

import math
from fractions import Fraction

import pytest
from doors import SCALE_SERIES as SERIES, choose_scale, series_near
from hypothesis import example, given, strategies as st

MEMBERS = (Fraction(1), Fraction(2), Fraction(5, 2), Fraction(4), Fraction(5))
values = st.floats(1e-12, 1e12)


def members(value: float) -> list[Fraction]:
    power = math.floor(math.log10(value))
    return [m * Fraction(10) ** p for p in range(power - 2, power + 3) for m in MEMBERS]


@given(values)
@example(1.0)
@example(2.5)
@example(9.999999999999)
@example(0.1)
@example(1000.0)
def test_next_above_and_below(value: float) -> None:
    up, down = series_near(value, up=True), series_near(value, up=False)
    exact, slack = Fraction(value), Fraction(value) / 10**9
    assert up == float(min(m for m in members(value) if m >= exact - slack))
    assert down == float(max(m for m in members(value) if m <= exact + slack))
    assert down <= value * (1 + 1e-8)
    assert up >= value * (1 - 1e-8)


@pytest.mark.parametrize("power", range(-9, 10))
def test_members_are_their_own_neighbours(power: int) -> None:
    for mantissa in SERIES:
        member = float(f"{mantissa}e{power}")
        assert series_near(member, up=True) == member
        assert series_near(member, up=False) == member
        assert series_near(member * (1 + 1e-15), up=True) == member  # rounding of the data


def test_the_series_is_1_2_2_5_4_5() -> None:
    assert [series_near(x, up=True) for x in (1.1, 2.1, 2.6, 4.1, 5.1)] == [2, 2.5, 4, 5, 10]
    assert [series_near(x, up=False) for x in (0.99, 1.9, 2.4, 3.9, 4.9, 9.9)] == [
        0.5, 1, 2, 2.5, 4, 5,
    ]  # fmt: skip


def test_another_series() -> None:
    assert series_near(3.0, up=True, series=(1.0, 2.0, 5.0)) == 5.0


extents = st.tuples(st.floats(0, 1e4), st.floats(1e-6, 1e4))
boxes = st.tuples(st.floats(20, 400), st.floats(20, 400))


@given(extents, boxes)
def test_the_drawing_fits_its_box_and_fills_it(
    extent: tuple[float, float], box: tuple[float, float]
) -> None:
    mu = choose_scale(extent, box)
    share = max(extent[0] / mu / box[0], extent[1] / mu / box[1])
    assert share <= 1 + 1e-8
    assert share > 0.5 - 1e-8  # the widest step of the series is from 1 to 2 and from 5 to 10


@given(extents, boxes)
def test_the_round_number_of_mm_per_unit_is_returned_on_request(
    extent: tuple[float, float], box: tuple[float, float]
) -> None:
    mu = choose_scale(extent, box, mm_per_unit=True)
    per_unit = 1 / mu
    near = series_near(per_unit, up=True)
    assert per_unit == pytest.approx(near, rel=1e-12)
    share = max(extent[0] * per_unit / box[0], extent[1] * per_unit / box[1])
    assert 0.5 - 1e-8 < share <= 1 + 1e-8


def test_the_tighter_side_decides() -> None:
    assert choose_scale((0.2, 0.1), (100, 100)) == 0.002
    assert choose_scale((0.2, 0.1), (200, 10)) == 0.01
    assert choose_scale((0.3, 0.1), (100, 100)) == 0.004
    assert choose_scale((0.3, 0.1), (100, 100), mm_per_unit=True) == 1 / 250


@pytest.mark.parametrize("extent", [(0.0, 0.0), (math.nan, 0.0), (math.inf, 1.0)])
def test_an_empty_drawing_has_scale_1(extent: tuple[float, float]) -> None:
    assert choose_scale(extent, (100, 100)) == 1.0
    assert choose_scale(extent, (100, 100), mm_per_unit=True) == 1.0
