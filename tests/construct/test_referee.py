"""The referee, the jets and the dual numbers: each checked by something else."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from doors import (
    UNIT_ROUNDOFF,
    Builder,
    Dual,
    Duals,
    Float64,
    Jet,
    Precise,
    QuantityKind,
    Solution,
    as_dual,
    drive_data,
    evaluate_evaluate as evaluate,
    measured_reach,
    quantities_of,
    reach,
)
from hypothesis import given, strategies as st
from jets import Jets, adjudicate
from worked import SIX, problem_of

SCALES = ("mu_l", "mu_v", "mu_a")


def data_of(solution: Solution) -> dict[str, Any]:
    found: dict[str, Any] = drive_data(
        solution.problem, solution.construction.draft, solution.positions
    )
    return {name: np.ravel(value)[0] for name, value in found.items()}


# The referee --------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", SIX)
def test_more_digits_of_the_referee_confirm_those_of_fewer(name: str) -> None:
    solution = Solution(problem_of(name))
    program, data = solution.construction.program, data_of(solution)
    few, many = adjudicate(program, data, digits=30), adjudicate(program, data, digits=60)
    for out, value in few.value.items():
        if not isinstance(value, tuple):
            assert abs(value - many.value[out]) <= 1e-25 * (abs(many.value[out]) + 1)


def test_the_referee_has_a_precision_of_its_own() -> None:
    import mpmath

    before = mpmath.mp.dps
    assert Precise(77).context.dps == 77
    assert mpmath.mp.dps == before


def test_the_referee_takes_binary_fractions_as_they_are() -> None:
    assert Precise(50).lift(np.float64(0.1)) != Precise(50).context.mpf("0.1")
    assert float(Precise(50).lift(np.float64(0.1))) == 0.1


@pytest.mark.parametrize("turns", [0, 1, -3, 1_000_000])
def test_the_referee_knows_quadrants_exactly(turns: int) -> None:
    referee = Precise(40)
    for k, unit in enumerate((1, 1j, -1, -1j)):
        assert referee.direction(referee.lift(90.0 * k + 360.0 * turns)) == unit


def test_an_impossible_result_is_nan_for_the_referee_too() -> None:
    b = Builder()
    p, q = b.take_point("P"), b.take_point("Q")
    r = b.known("r")
    from doors import Side

    x = b.intersect_circles("X", p, r, q, r, Side.LEFT)
    trace = adjudicate(b.program(), {"P": 0j, "Q": 5 + 0j, "r": 2.0})
    assert trace.margin[x] < 0
    assert math.isnan(complex(trace.value[x]).real)


# Jets: velocities and accelerations from the positions alone --------------------------------------


@pytest.mark.parametrize("name", SIX)
@pytest.mark.parametrize("arithmetic", ["float64", "referee"])
def test_plans_agree_with_the_derivatives_of_the_position_program(
    name: str, arithmetic: str
) -> None:
    """An independent check without velocity and acceleration plans."""
    solution = Solution(problem_of(name))
    results = quantities_of(solution.construction)
    places = [r for r in results.all if r.kind is QuantityKind.PLACE]
    places = [r for r in places if r.name == r.of]  # coincident points are not of one link
    kin = solution.construction.kinematics
    program = results.program.needed_for([r.name for r in places])
    data = data_of(solution)
    drive = solution.problem.drive
    base: Any = Float64() if arithmetic == "float64" else Precise(30)
    right = math.degrees(1.0) if arithmetic == "float64" else 180 / base.context.pi
    rate, acceleration = drive.rate * right, drive.acceleration * right
    data["phi"] = Jet(data["phi"], rate, acceleration)
    trace = evaluate(program, data, Jets(base))
    v = max(abs(complex(m.velocity[0])) for m in solution.points.values())
    a = max(abs(complex(m.acceleration[0])) for m in solution.points.values())
    for r in places:
        if r.of not in {place for _, place in kin.velocity.named.values()}:
            continue
        jet, motion = trace.value[r.name], solution.points[r.of]
        if not isinstance(jet, Jet) or kin.velocity.named[r.of][0] == "0":
            continue
        assert abs(complex(jet.rate) - complex(motion.velocity[0])) <= 1e-12 * v
        assert abs(complex(jet.acceleration) - complex(motion.acceleration[0])) <= 1e-11 * a


@given(st.floats(0.5, 2), st.floats(-2, 2), st.floats(-2, 2))
def test_jets_differentiate(x: float, v: float, a: float) -> None:
    jet = Jet(x, v, a)
    product = (jet * jet * 3.0 - jet / (jet + 1.0)) * 1.0
    assert product.value == pytest.approx(3 * x * x - x / (x + 1))
    first = 6 * x - 1 / (x + 1) ** 2
    assert product.rate == pytest.approx(first * v)
    assert product.acceleration == pytest.approx((6 + 2 / (x + 1) ** 3) * v * v + first * a)
    size = abs(Jet(complex(x, 1), complex(v, 0), complex(a, 0)))
    r = math.hypot(x, 1)
    assert size.rate == pytest.approx(x * v / r)
    assert size.acceleration == pytest.approx((v * v + x * a - (x * v / r) ** 2) / r, abs=1e-12)


# Dual numbers -------------------------------------------------------------------------------------


def slopes(value: Any) -> Any:
    slope = as_dual(value).slope
    assert slope is not None
    return slope[:, 0]


@given(st.floats(0.5, 2), st.floats(-2, 2))
def test_dual_numbers_carry_slopes(x: float, y: float) -> None:
    p = Dual(np.array([x]), np.array([[1.0], [0.0]]))
    q = Dual(np.array([y]), np.array([[0.0], [1.0]]))
    assert slopes(p * q + p / 2.0) == pytest.approx([y + 0.5, x])
    assert slopes(q / p) == pytest.approx([-y / x**2, 1 / x])
    assert slopes(abs(p + 1j * q)) == pytest.approx([x / math.hypot(x, y), y / math.hypot(x, y)])
    assert slopes(Duals().root(p)) == pytest.approx([0.5 / math.sqrt(x), 0.0])
    assert slopes((p * (2 + 1j)).conjugate().imag) == pytest.approx([-1.0, 0.0])
    assert slopes(3.0 - p) == pytest.approx([-1.0, 0.0])
    assert slopes(1.0 / p) == pytest.approx([-1 / x**2, 0.0])


@pytest.mark.parametrize("name", SIX)
def test_slopes_are_those_of_finite_differences(name: str) -> None:
    """The reach found with dual numbers against central differences of the float64 program."""
    solution = Solution(problem_of(name))
    program, data = solution.construction.program, data_of(solution)
    found = reach(program, data, SCALES)
    h = 1e-6
    moved: dict[str, float] = {}
    for key, value in data.items():
        if key in SCALES or value == 0:
            continue
        parts = [value] if not np.iscomplexobj(value) else [value.real, 1j * value.imag]
        for part in parts:
            if part == 0:
                continue
            ends = [
                evaluate(program, {**data, key: value + sign * h * part}, Float64()).value
                for sign in (1, -1)
            ]
            for out, one in ends[0].items():
                if not isinstance(one, tuple):
                    change = abs(complex(np.ravel(one - ends[1][out])[0])) / (2 * h)
                    moved[out] = moved.get(out, 0.0) + change
    exact = evaluate(program, data, Float64()).value
    for out, total in moved.items():  # type: ignore[assignment]
        size = abs(complex(np.ravel(exact[out])[0]))
        mine = float(found[out][0]) if np.size(found[out]) else 0.0
        assert mine - size == pytest.approx(total, rel=1e-5, abs=1e-6 * (size + 1e-9)), out


@pytest.mark.parametrize("name", SIX)
def test_the_reach_in_float64_is_the_one_the_referee_measures(name: str) -> None:
    solution = Solution(problem_of(name))
    program, data = solution.construction.program, data_of(solution)
    fast = reach(program, data, SCALES)
    for out, (_, slow) in measured_reach(program, data, Precise(50), SCALES).items():
        assert float(fast[out][0]) == pytest.approx(float(slow), rel=1e-9, abs=1e-18), out


def test_a_zero_or_a_scale_has_no_reach() -> None:
    b = Builder()
    a, mu = b.known("a"), b.known("mu_l")
    product = b.compute("a/mu", (a, 1), (mu, -1))
    found = reach(b.program(), {"a": 3.0, "mu_l": 0.5}, ("mu_l",))
    assert found[product][0] == 12.0  # |y| and the change of a: the scale is exact
    assert reach(b.program(), {"a": 0.0, "mu_l": 0.5}, ("mu_l",))[product][0] == 0.0
    assert np.finfo(float).eps / 2 == UNIT_ROUNDOFF
