"""Steps of the force plans in every reading: segments carried over, arms, moments, sums."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from cases import each
from doors import (
    Arithmetic,
    Blocks,
    Builder,
    Counted,
    Dual,
    Duals,
    Float64,
    Jet,
    Name,
    NumberName,
    PointName,
    Precise,
    Profile,
    Program,
    ProgramError,
    Propagated,
    RulerArithmetic,
    Sampled,
    as_dual,
    evaluate_evaluate as evaluate,
    reach,
    symbolic_write as write,
)
from hypothesis import given, strategies as st
from jets import Jets, adjudicate
from msgspec.structs import replace

coordinate = st.floats(-300.0, 300.0).map(lambda x: round(x, 6))
place = st.builds(complex, coordinate, coordinate)
factor = st.floats(-20.0, 20.0).map(lambda x: round(x, 6))

O, P, Q, A, B = (PointName(name) for name in "OPQAB")  # noqa: E741  letters of a plan
K = NumberName("k")
LETTERS = "OPQAB"
FREE = frozenset(LETTERS)
PROFILE = Profile("test", 0.2, 0.3, 0.15, 0.5, 0.5)

DATA: dict[str, complex | float] = {
    "O": 5 - 2j,
    "P": 10 + 20j,
    "Q": 40 + 60j,
    "A": 3 + 4j,
    "B": -20 + 8j,
    "k": -1.5,
}


def built(build: Callable[[Builder], Name]) -> Program:
    b = Builder()
    for name in LETTERS:
        b.take_point(name)
    b.known("k")
    out = build(b)
    return b.program().needed_for([out])


def moment(b: Builder, out: str, head: PointName = Q, at: PointName = B) -> NumberName:
    """Arm times length of a vector, both read."""
    arm = b.measure_arm(f"h_{out}", A, at, P, head)
    return b.compute(out, (arm, 1), (b.measure(f"l_{out}", P, head), 1))


CARRIED = built(lambda b: b.carry("X", O, P, Q))
TIMES = built(lambda b: b.carry("X", O, P, Q, times=K))
TURNED = built(lambda b: b.carry("X", O, P, Q, times=K, rotated=True))
AGAIN = built(lambda b: b.carry("X", O, P, Q, b.measure("l", P, Q), times=K))
ARM = built(lambda b: b.measure_arm("X", A, B, P, Q))
TOLD = built(lambda b: b.compute("X", (b.measure_arm("h", A, B, P, Q), 1), (K, 1)))
MOMENT = built(lambda b: moment(b, "X"))
SUM = built(lambda b: b.total("X", moment(b, "M"), K, b.measure("l", P, Q), K))
EVERY = {"carried": CARRIED, "times": TIMES, "turned": TURNED, "again": AGAIN}
EVERY |= {"arm": ARM, "told": TOLD, "moment": MOMENT, "sum": SUM}


def read(program: Program, arithmetic: Arithmetic | None = None, /, **data: Any) -> Any:
    return evaluate(program, {**DATA, **data}, arithmetic or Float64()).value[PointName("X")]


def wanted(name: str, **data: Any) -> Any:
    """Return the value of a step, by plain arithmetic."""
    all_data: dict[str, Any] = {**DATA, **data}
    o, p, q, a, b, k = (all_data[letter] for letter in "OPQABk")
    moment = (b - a).real * (q - p).imag - (b - a).imag * (q - p).real
    arm = moment / abs(q - p) if q != p else 0.0
    return {
        "carried": o + (q - p),
        "times": o + k * (q - p),
        "turned": o + 1j * k * (q - p),
        "again": o + k * (q - p),
        "arm": arm,
        "told": k * arm,
        "moment": moment,
        "sum": moment + 2 * k + abs(q - p),
    }[name]


# Exactly ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", EVERY)
@given(place, place, place, place, place, factor)
def test_values(
    name: str, o: complex, p: complex, q: complex, a: complex, b: complex, k: float
) -> None:
    data: dict[str, Any] = dict(zip("OPQABk", (o, p, q, a, b, k), strict=True))
    size = 1 + abs(o) + (1 + abs(k) + abs(a) + abs(b)) * (1 + abs(p) + abs(q)) + abs(k * (b - a))
    assert abs(complex(read(EVERY[name], **data)) - wanted(name, **data)) <= 1e-14 * size


def test_an_arm_and_a_moment_are_positive_counter_clockwise() -> None:
    for program, size in ((ARM, 10.0), (MOMENT, 30.0)):
        assert read(program, A=0j, B=10 + 0j, P=0j, Q=3j) == size
        assert read(program, A=0j, B=10 + 0j, P=3j, Q=0j) == -size
        assert read(program, A=0j, B=10 + 0j, P=7 + 7j, Q=8 + 7j) == 0.0


def test_a_turned_segment_is_turned_to_the_left() -> None:
    program = built(lambda b: b.carry("X", O, P, Q, rotated=True))
    assert read(program, O=1 + 1j, P=5 + 0j, Q=8 + 0j) == 1 + 4j


def test_positions_are_read_one_by_one() -> None:
    ends = np.array([40 + 60j, 10 + 20j, -3 + 0j])
    for name, program in EVERY.items():
        many = read(program, Q=ends)
        assert many.shape == (3,)
        for i, end in enumerate(ends):
            assert many[i] == read(program, Q=end), name


def test_a_zero_vector_is_translated_and_has_no_moment() -> None:
    """A zero vector has no direction; it does not spoil other positions."""
    ends = np.array([10 + 20j, 40 + 60j])
    for name, program in EVERY.items():
        found = read(program, Q=ends)
        assert np.isfinite(found).all()
        assert found[0] == wanted(name, Q=ends[0])
    assert read(TIMES, k=0.0) == DATA["O"]
    assert read(ARM, B=DATA["A"]) == 0.0
    assert read(built(lambda b: b.total("X"))) == 0.0


def test_a_result_of_an_impossible_point_is_not_a_number() -> None:
    def impossible(b: Builder) -> PointName:
        return b.intersect_lines("Z", b.join(P, Q), b.parallel(A, b.join(P, Q)))

    assert np.isnan(read(built(lambda b: b.carry("X", O, P, impossible(b)))))
    assert np.isnan(read(built(lambda b: moment(b, "X", impossible(b)))))
    assert np.isnan(read(built(lambda b: b.measure_arm("X", A, impossible(b), P, Q))))


def test_operands_are_checked() -> None:
    b = Builder()
    for name in LETTERS:
        b.take_point(name)
    b.total("X", NumberName("P"))
    with pytest.raises(ProgramError, match="'P' is not a"):
        b.program()
    with pytest.raises(ProgramError, match="no earlier step makes 'm'"):
        built(lambda b: b.carry("X", O, P, Q, NumberName("m")))


def test_only_needed_steps_are_kept() -> None:
    assert {step.out for step in ARM.steps} == {"A", "B", "P", "Q", "X"}
    assert {step.out for step in CARRIED.steps} == {"O", "P", "Q", "X"}
    assert {step.out for step in SUM.steps} == {*"ABPQklMX", "h_M", "l_M"}


# By hand ------------------------------------------------------------------------------------------


def test_the_hand_reads_the_arm_and_knows_a_force_that_was_given() -> None:
    """The arm of 20.8 mm is read as 21, and multiplied by the given size of the force."""
    assert read(ARM) == pytest.approx(-20.8)
    assert read(ARM, RulerArithmetic(ruler=0.5)) == -21.0
    assert read(TOLD, RulerArithmetic(ruler=0.5)) == -21.0 * DATA["k"]


@pytest.mark.parametrize("name", ["carried", "times", "turned"])
def test_the_hand_carries_exactly(name: str) -> None:
    assert read(EVERY[name], RulerArithmetic(ruler=1.0)) == read(EVERY[name])


def test_the_hand_lays_off_its_own_readings() -> None:
    """The vector of 50 mm is read in steps of 15 as 45, its arm of 20.8 as 15: each once."""
    assert read(AGAIN, RulerArithmetic(ruler=15.0)) == pytest.approx(
        5 - 2j - 1.5 * 0.9 * (30 + 40j)
    )
    assert read(MOMENT, RulerArithmetic(ruler=15.0)) == pytest.approx(-15.0 * 45.0)
    assert read(AGAIN, RulerArithmetic(ruler=200.0)) == DATA["O"]
    assert read(MOMENT, RulerArithmetic(ruler=200.0)) == 0.0


@given(place, place, place, place, st.sampled_from([0.5, 1.0, 15.0]))
def test_a_moment_by_hand_is_the_read_arm_times_the_read_length(
    p: complex, q: complex, a: complex, b: complex, ruler: float
) -> None:
    hand, data = RulerArithmetic(ruler=ruler), {"P": p, "Q": q, "A": a, "B": b}
    assert read(MOMENT, hand, **data) == hand.ruled(read(ARM, **data)) * hand.ruled(abs(q - p))


def test_the_sign_of_a_length_that_is_laid_off_again_does_not_matter() -> None:
    """It may have been read along a line that runs against the vector."""

    def laid(sign: float) -> Program:
        return built(
            lambda b: b.carry("X", O, P, Q, b.compute("l", (b.measure("m", P, Q), 1), factor=sign))
        )

    assert read(laid(-1.0)) == read(laid(1.0)) == pytest.approx(wanted("carried"))


def spread(program: Program, profile: Profile = PROFILE, **data: Any) -> tuple[float, float]:
    """Sigmas of the two coordinates of a result, the given points being sharp."""
    counted = Counted(profile, FREE)
    evaluate(program, {**DATA, **data}, counted)
    value = as_dual(read(program, Propagated(profile, FREE, counted.causes), **data))
    if value.slope is None:
        return 0.0, 0.0
    slope = value.slope[:, 0]
    return math.sqrt(float((slope.real**2).sum())), math.sqrt(float((slope.imag**2).sum()))


def test_a_carried_point_is_pricked() -> None:
    assert spread(TURNED) == pytest.approx((PROFILE.point, PROFILE.point))
    assert spread(TURNED, Q=DATA["P"]) == (0.0, 0.0)


def test_the_error_of_a_value_is_that_of_its_readings() -> None:
    reading = math.hypot(PROFILE.measure, PROFILE.ruler / math.sqrt(12.0))
    assert spread(ARM)[0] == pytest.approx(reading)
    assert spread(TOLD)[0] == pytest.approx(1.5 * reading)
    assert spread(MOMENT)[0] == pytest.approx(math.hypot(50.0 * reading, 20.8 * reading))
    across, up = spread(AGAIN)
    assert across == pytest.approx(math.hypot(PROFILE.point, 1.5 * 0.6 * reading))
    assert up == pytest.approx(math.hypot(PROFILE.point, 1.5 * 0.8 * reading))
    assert spread(MOMENT, Q=DATA["P"])[0] == 0.0


@pytest.mark.parametrize("name", EVERY)
def test_sheets_drawn_at_random_spread_as_far(name: str) -> None:
    fine = replace(PROFILE, ruler=0.1)  # a coarse one rounds one length always the same way
    values = read(EVERY[name], Sampled(fine, FREE, 4000, 7))
    across, up = spread(EVERY[name], fine)
    assert float(np.std(np.real(values))) == pytest.approx(across, rel=0.06)
    if up:
        assert float(np.std(np.imag(values))) == pytest.approx(up, rel=0.06)


def test_zero_is_zero_on_every_sheet() -> None:
    nothing = {"Q": DATA["P"]}
    assert np.all(read(TURNED, Sampled(PROFILE, FREE, 50, 7), **nothing) == DATA["O"])
    for program in (ARM, MOMENT):
        assert np.all(read(program, Sampled(PROFILE, FREE, 50, 7), **nothing) == 0.0)
        assert read(program, RulerArithmetic(ruler=0.5), **nothing) == 0.0


# Slopes -------------------------------------------------------------------------------------------

STEP = 1e-6


VECTOR = [(name, DATA["Q"]) for name in EVERY]
NOTHING = [(name, DATA["P"]) for name in ("carried", "times", "turned", "again")]
"""Zero vectors: moving the end moves the translated vector too, but the arm is not defined."""


@each("name, end", VECTOR + NOTHING)
@each("cause", [*LETTERS, "k"])
def test_slopes_are_finite_differences(name: str, end: complex, cause: str) -> None:
    program = EVERY[name]
    data: dict[str, Any] = {**DATA, "Q": end}
    for way in (1.0,) if cause == "k" else (1.0, 1j):
        dual = Dual(np.atleast_1d(data[cause]), np.array([[way]]))
        found = as_dual(read(program, Duals(), **{**data, cause: dual}))
        slope = 0.0 if found.slope is None else complex(np.ravel(found.slope)[0])
        ahead, back = (
            complex(read(program, **{**data, cause: data[cause] + sign * STEP * way}))
            for sign in (1, -1)
        )
        assert slope == pytest.approx((ahead - back) / (2 * STEP), rel=1e-6, abs=1e-6)


def test_rates_are_those_of_moving_points() -> None:
    for name, program in EVERY.items():
        moving = {"Q": Jet(DATA["Q"], 3 - 2j, 1 + 5j), "B": Jet(DATA["B"], 1j, -4 + 0j)}
        found = read(program, Jets(Float64()), **moving)
        values = [
            wanted(
                name,
                **{p: j.value + j.rate * t + j.acceleration * t * t / 2 for p, j in moving.items()},
            )
            for t in (-1e-4, 0.0, 1e-4)
        ]
        assert complex(found.value) == pytest.approx(values[1], rel=1e-14)
        assert complex(found.rate) == pytest.approx((values[2] - values[0]) / 2e-4, rel=1e-6)
        second = (values[2] - 2 * values[1] + values[0]) / 1e-8
        assert complex(found.acceleration) == pytest.approx(second, rel=1e-4)


def test_reach_of_a_moment() -> None:
    """|M| and its change by the last bits of eight coordinates."""
    found = float(reach(MOMENT, DATA)[PointName("X")][0])
    arm, force = -23 + 4j, 30 + 40j
    moved = [20 * force.imag, 3 * force.imag, 8 * force.real, 4 * force.real]
    moved += [abs(arm.real) * y for y in (60, 20)] + [abs(arm.imag) * x for x in (40, 10)]
    assert found == pytest.approx(abs(wanted("moment")) + sum(moved))


# Other numbers ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", EVERY)
def test_the_referee_agrees(name: str) -> None:
    few, many = (
        adjudicate(EVERY[name], DATA, digits=digits).value[PointName("X")] for digits in (30, 60)
    )
    assert abs(few - many) <= 1e-27 * abs(many)
    assert complex(many) == pytest.approx(complex(read(EVERY[name])), rel=1e-15)
    nothing = {**DATA, "Q": DATA["P"]}
    found = evaluate(EVERY[name], nothing, Precise()).value[PointName("X")]
    assert complex(found) == wanted(name, Q=DATA["P"])


@pytest.mark.parametrize("name", EVERY)
@pytest.mark.parametrize("inputs", [("Q.x", "Q.y"), ("B.x", "B.y", "k"), ("k",)])
def test_compiled(name: str, inputs: tuple[str, ...]) -> None:
    """The end of the vector, or the place it acts at, goes from position to position."""
    program = EVERY[name]
    used = {step.out for step in program.steps}
    mine = tuple(one for one in inputs if one.partition(".")[0] in used)
    rng = np.random.default_rng(3)
    columns = [rng.uniform(-50.0, 50.0, 6) for _ in mine]
    if "Q.x" in mine:
        columns[0][2], columns[1][2] = 10.0, 20.0  # nothing
    varying: dict[str, Any] = {}
    for column, one in zip(columns, mine, strict=True):
        letter, dot, axis = one.partition(".")
        varying[letter] = varying.get(letter, 0.0) + column * (1j if axis == "y" else 1.0)
        assert dot or letter == "k"
    constants = {key: value for key, value in DATA.items() if key in used and key not in varying}
    written = write(program, constants, mine)
    assert written.guards == ()
    symbol = written.value[PointName("X")]
    refs = [symbol.re] if symbol.im is None else [symbol.re, symbol.im]
    out = np.empty((len(refs), 6))
    Blocks(written.tape, refs, written.guards, [frozenset()] * len(refs)).run(columns, out)
    found = out[0] if len(refs) == 1 else out[0] + 1j * out[1]
    assert found == pytest.approx(np.broadcast_to(read(program, **varying), (6,)), rel=1e-13)


def test_a_carried_point_is_compiled_without_its_length() -> None:
    written = write(CARRIED, {"O": 0j, "P": 1j}, ("Q.x", "Q.y"))
    x, y = written.value[PointName("X")]._parts()
    kinds = {written.tape.nodes[ref].kind for ref in (x, y) if type(ref) is int}
    assert kinds <= {"input", "add", "sub"}
