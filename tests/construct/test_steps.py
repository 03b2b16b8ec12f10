"""Geometry of every kind of step: the points made are where the step defines them."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from doors import (
    DRAFTING_PROFILES,
    STEP_TYPES,
    Builder,
    Duals,
    Float64,
    Leg,
    LineName,
    LineSense,
    Name,
    NumberName,
    PointName,
    Precise,
    RulerArithmetic,
    Side,
    Trace,
    drawing_sigmas,
    evaluate_evaluate as evaluate,
)
from hypothesis import assume, example, given, strategies as st

REACH = 300.0
TINY = 1e-9  # mm, on a sheet of 300 mm

coordinate = st.floats(-REACH, REACH, allow_nan=False).map(lambda x: round(x, 6))
place = st.builds(complex, coordinate, coordinate)
length = st.floats(0.01, REACH).map(lambda x: round(x, 6))
signed = st.floats(-REACH, REACH).map(lambda x: round(x, 6))
angles = st.floats(-1000, 1000)
sides = st.sampled_from(Side)
ways = st.sampled_from(LineSense)

P, Q, R, S = (PointName(name) for name in "PQRS")
SEEN: set[str] = set()


def run(
    build: Callable[[Builder], Name], hand: RulerArithmetic | None = None, **data: Any
) -> tuple[Any, Any]:
    """Value and margin of the last step of a construction on given points and numbers."""
    b = Builder()
    for name, value in data.items():
        if isinstance(value, complex) or np.iscomplexobj(value):
            b.take_point(name)
        else:
            b.known(name)
    out = build(b)
    program = b.program()
    SEEN.update(type(step).__name__ for step in program.steps)
    trace: Trace = evaluate(program, data, hand or Float64())
    return trace.value[out], trace.margin.get(out)


def scalar(value: Any) -> complex:
    return complex(np.asarray(value))


def real(value: Any) -> float:
    return float(np.asarray(value))


def cross(a: complex, b: complex) -> float:
    return (a.conjugate() * b).imag


def dot(a: complex, b: complex) -> float:
    return (a.conjugate() * b).real


def apart(a: complex, b: complex, least: float = 0.01) -> bool:
    return abs(a - b) >= least


# Lines --------------------------------------------------------------------------------------------


@given(place, place)
def test_join_goes_from_the_first_to_the_second(p: complex, q: complex) -> None:
    (through, u), margin = run(lambda b: b.join(P, Q), P=p, Q=q)
    assert scalar(through) == p
    assert scalar(u) == q - p
    assert margin is None


@given(place, place, place)
def test_parallel_keeps_the_sense_and_perpendicular_turns_to_the_left(
    p: complex, q: complex, r: complex
) -> None:
    (through, u), _ = run(lambda b: b.parallel(R, b.join(P, Q)), P=p, Q=q, R=r)
    assert scalar(through) == r
    assert scalar(u) == q - p
    (through, u), _ = run(lambda b: b.perpendicular(R, b.join(P, Q)), P=p, Q=q, R=r)
    assert scalar(through) == r
    assert scalar(u) == 1j * (q - p)


@given(place, place, place, angles)
def test_an_angle_is_laid_off_counter_clockwise(
    p: complex, q: complex, r: complex, angle: float
) -> None:
    assume(apart(p, q))

    def build(b: Builder) -> LineName:
        return b.at_angle(R, b.join(P, Q), NumberName("turn"))

    (through, u), _ = run(build, P=p, Q=q, R=r, turn=angle)
    assert scalar(through) == r
    wanted = (q - p) * cmath.rect(1.0, math.radians(math.remainder(angle, 360.0)))
    assert abs(scalar(u) - wanted) <= 1e-13 * abs(q - p)
    (_, u), _ = run(lambda b: b.at_angle(R, None, NumberName("turn")), R=r, turn=angle)
    assert abs(scalar(u) - wanted / (q - p)) <= 1e-13


# Points -------------------------------------------------------------------------------------------


@given(place, place, place, signed)
def test_a_length_is_laid_off_along_a_line(p: complex, q: complex, r: complex, x: float) -> None:
    assume(apart(p, q))

    def build(b: Builder) -> PointName:
        return b.lay_off_length("X", R, b.join(P, Q), NumberName("x"))

    at, margin = run(build, P=p, Q=q, R=r, x=x)
    laid = scalar(at) - r
    u = (q - p) / abs(q - p)
    assert margin == 1
    assert abs(cross(u, laid)) < TINY
    assert abs(dot(u, laid) - x) < TINY


def test_a_zero_length_needs_no_direction() -> None:
    def build(b: Builder) -> PointName:
        return b.lay_off_length("X", R, b.join(P, Q), NumberName("x"))

    assert scalar(run(build, P=1 + 1j, Q=1 + 1j, R=2 + 3j, x=0.0)[0]) == 2 + 3j
    assert not np.isfinite(run(build, P=1 + 1j, Q=1 + 1j, R=2 + 3j, x=1.0)[0])
    at, _ = run(build, P=np.array([0j, 0j]), Q=np.array([0j, 1j]), R=0j, x=np.array([0.0, 2.0]))
    assert at.tolist() == [0j, 2j]


@given(place, place, place, place)
@example(0j, 1 + 0j, 1j, 1 + 1j)
@example(0j, 1 + 0j, 1j, -1 + 1j)
@example(0j, 2 + 0j, 5 + 0j, 7 + 0j)
@example(0j, 0j, 5 + 0j, 7 + 0j)
def test_lines_meet_on_both_or_are_parallel(p: complex, q: complex, r: complex, s: complex) -> None:
    def build(b: Builder) -> PointName:
        return b.intersect_lines("X", b.join(P, Q), b.join(R, S))

    value, margin = run(build, P=p, Q=q, R=r, S=s)
    u, v = q - p, s - r
    if u == 0 or v == 0:
        assert not np.isfinite(value)
        assert not margin > 0
        return
    assert 0 <= margin <= 1 + 1e-12
    if margin <= 1e-12:
        assert not np.isfinite(value)
        return
    at = scalar(value)
    assert abs(margin - abs(math.sin(cmath.phase(v / u)))) <= 1e-12
    assume(margin > 1e-3)
    assert abs(cross(u / abs(u), at - p)) < TINY * max(1.0, abs(at - p) / REACH)
    assert abs(cross(v / abs(v), at - r)) < TINY * max(1.0, abs(at - r) / REACH)


def test_parallel_lines_do_not_meet_in_any_sense() -> None:
    def build(b: Builder) -> PointName:
        return b.intersect_lines("X", b.join(P, Q), b.parallel(R, b.join(P, Q)))

    value, margin = run(build, P=1 + 2j, Q=17.3 - 4.4j, R=3 + 3j)
    assert not np.isfinite(value)
    assert margin == 0

    def back(b: Builder) -> PointName:
        return b.intersect_lines("X", b.join(P, Q), b.parallel(R, b.join(Q, P)))

    assert not np.isfinite(run(back, P=1 + 2j, Q=17.3 - 4.4j, R=3 + 3j)[0])


def nan_exactly_where_negative(value: Any, margin: Any) -> bool:
    return bool(np.isfinite(value)) == bool(margin > -1e-12)


@given(place, place, place, length, ways)
@example(0j, 1 + 0j, 3j, 3.0, LineSense.FORWARD)
@example(0j, 1 + 0j, 3j, 2.999999, LineSense.FORWARD)
@example(0j, 1 + 0j, 5 + 3j, 5.0, LineSense.BACKWARD)
def test_a_line_meets_an_arc_in_the_requested_direction(
    p: complex, q: complex, c: complex, r: float, way: LineSense
) -> None:
    assume(apart(p, q))

    def build(b: Builder) -> PointName:
        return b.intersect_line_circle("X", b.join(P, Q), R, NumberName("r"), way)

    value, margin = run(build, P=p, Q=q, R=c, r=r)
    u = (q - p) / abs(q - p)
    leg = abs(cross(u, c - p))
    assert nan_exactly_where_negative(value, margin)
    assert real(margin) == pytest.approx((r * r - leg * leg) / (r * r), rel=1e-9, abs=1e-9)
    if margin < 1e-6:
        return  # near the tangent a root doubles the digits that are lost
    at = scalar(value)
    assert abs(cross(u, at - p)) < TINY
    assert abs(abs(at - c) - r) < TINY
    assert dot(u, at - c) * way.value > 0
    if margin > 0.01:
        assert abs(leg) < r


def test_a_point_on_a_guide_stays_on_it_exactly() -> None:
    def build(b: Builder) -> PointName:
        return b.intersect_line_circle("X", b.join(P, Q), R, NumberName("r"), LineSense.FORWARD)

    at, _ = run(build, P=0j, Q=7 + 0j, R=13.37 + 41.9j, r=100.0)
    assert scalar(at).imag == 0.0


@given(place, length, place, length, sides)
@example(0j, 3.0, 5 + 0j, 4.0, Side.LEFT)
@example(0j, 3.0, 5 + 0j, 2.0, Side.LEFT)  # they touch
@example(0j, 3.0, 1 + 0j, 4.0, Side.LEFT)  # one touches the other from inside
@example(0j, 3.0, 5 + 0j, 1.9, Side.LEFT)
@example(0j, 9.0, 1 + 0j, 2.0, Side.RIGHT)  # one inside the other
@example(0j, 3.0, 0j, 3.0, Side.RIGHT)  # one and the same
def test_arcs_meet_on_the_requested_side(
    c1: complex, r1: float, c2: complex, r2: float, side: Side
) -> None:
    def build(b: Builder) -> PointName:
        return b.intersect_circles("X", P, NumberName("r1"), Q, NumberName("r2"), side)

    value, margin = run(build, P=c1, Q=c2, r1=r1, r2=r2)
    d = abs(c2 - c1)
    if d == 0:
        assert not np.isfinite(value)
        assert not margin > 0
        return
    assert nan_exactly_where_negative(value, margin)
    slack = 1e-9 * (r1 + r2 + d)
    if abs(r1 - r2) + slack < d < r1 + r2 - slack:
        assert margin > 0
    elif d > r1 + r2 + slack or d < abs(r1 - r2) - slack:
        assert margin < 0
    # The half chord loses the digits that a small centre distance or a flat triangle costs.
    assume(margin > 1e-3 and d > 1.0 and r1 > 1.0)
    at = scalar(value)
    assert abs(abs(at - c1) - r1) < TINY
    assert abs(abs(at - c2) - r2) < TINY * max(1.0, REACH / d)
    assert cross(c2 - c1, at - c1) * side.value > 0


def test_arcs_that_touch_meet_on_the_line_of_centres() -> None:
    def build(b: Builder) -> PointName:
        return b.intersect_circles("X", P, NumberName("r1"), Q, NumberName("r2"), Side.LEFT)

    value, margin = run(build, P=0j, Q=5 + 0j, r1=3.0, r2=2.0)
    assert (scalar(value), float(margin)) == (3 + 0j, 0.0)
    value, margin = run(build, P=0j, Q=0.3 + 0j, r1=0.1, r2=0.2)  # 0.1 + 0.2 is not 0.3
    assert abs(scalar(value) - 0.1) < 1e-8
    assert abs(margin) < 1e-12
    value, margin = run(build, P=0j, Q=5 + 0j, r1=3.0, r2=1.999)
    assert not np.isfinite(value)
    assert margin < 0


@given(place, length, place, sides)
@example(0j, 3.0, 5 + 0j, Side.LEFT)
@example(0j, 3.0, 3 + 0j, Side.RIGHT)
@example(0j, 3.0, 2 + 0j, Side.RIGHT)
@example(0j, 3.0, 0j, Side.RIGHT)
def test_a_tangent_touches_on_the_requested_side(
    c: complex, r: float, s: complex, side: Side
) -> None:
    value, margin = run(lambda b: b.touch("X", P, NumberName("r"), Q, side), P=c, Q=s, r=r)
    d = abs(s - c)
    if d == 0:
        assert not np.isfinite(value)
        return
    assert nan_exactly_where_negative(value, margin)
    if d < r * (1 - 1e-9):
        assert margin < 0
    assume(margin > 1e-3 and d > 1.0)
    at = scalar(value)
    assert abs(abs(at - c) - r) < TINY
    assert abs(dot(at - c, at - s)) / max(abs(at - c), abs(at - s)) < TINY
    assert cross(s - c, at - c) * side.value > 0


@given(place, place, place, place, place)
def test_similar_keeps_the_order_of_the_letters(
    b: complex, c: complex, B: complex, C: complex, s: complex
) -> None:
    assume(apart(B, C, 1.0))
    names = (PointName("B"), PointName("C"), PointName("S"))

    def build(builder: Builder) -> PointName:
        plan = (PointName("b"), PointName("c"))
        return builder.similar("s", plan, names, builder.measure("bc", *plan))

    value, margin = run(build, b=b, c=c, B=B, C=C, S=s)
    at = scalar(value)
    assert margin == 1
    limit = TINY * max(1.0, abs(s - B) / abs(C - B)) * 10
    assert abs((at - b) - (c - b) * (s - B) / (C - B)) < limit
    # Side by side: |bs| : |bc| as |BS| : |BC|, turned the same way, not mirrored.
    assert abs(abs(at - b) - abs(c - b) * abs(s - B) / abs(C - B)) < limit
    assert abs(cross(c - b, at - b) * abs(C - B) ** 2 - cross(C - B, s - B) * abs(c - b) ** 2) < (
        limit * abs(C - B) ** 2 * max(1.0, abs(c - b))
    )


def test_similar_of_the_ends_are_the_ends() -> None:
    names = (PointName("B"), PointName("C"))
    for third, wanted in (("B", 2 + 3j), ("C", -1 + 5j)):

        def build(b: Builder, third: str = third) -> PointName:
            plan = (PointName("b"), PointName("c"))
            return b.similar("s", plan, (*names, PointName(third)), b.measure("bc", *plan))

        at = scalar(run(build, b=2 + 3j, c=-1 + 5j, B=10 + 10j, C=40 + 17j)[0])
        assert abs(at - wanted) < 1e-14


# Numbers ------------------------------------------------------------------------------------------


@given(place, place)
def test_a_measured_length_is_the_distance(p: complex, q: complex) -> None:
    value, _ = run(lambda b: b.measure("x", P, Q), P=p, Q=q)
    assert real(value) == abs(q - p)


@given(place, place, place, place)
def test_a_length_along_a_line_has_the_lines_sign(
    p: complex, q: complex, r: complex, s: complex
) -> None:
    assume(apart(p, q))
    value, _ = run(lambda b: b.measure_along("x", R, S, b.join(P, Q)), P=p, Q=q, R=r, S=s)
    assert abs(real(value) - dot((q - p) / abs(q - p), s - r)) < TINY
    back, _ = run(lambda b: b.measure_along("x", R, S, b.join(Q, P)), P=p, Q=q, R=r, S=s)
    assert abs(real(back) + real(value)) < TINY


def test_compute_multiplies_powers() -> None:
    x, y = NumberName("x"), NumberName("y")
    value, _ = run(lambda b: b.compute("z", (x, 2), (y, -1), factor=-0.5), x=3.0, y=4.0)
    assert real(value) == -0.5 * 9 / 4
    assert real(run(lambda b: b.compute("z"))[0]) == 1.0
    value, _ = run(lambda b: b.compute("z", (x, 1), (x, -2)), x=np.array([2.0, -4.0]))
    assert value.tolist() == [0.5, -0.25]
    value, _ = run(lambda b: b.compute("z", (x, -1), size=True), x=np.array([2.0, -4.0, 0.0]))
    assert np.array_equal(value, [0.5, 0.25, np.nan], equal_nan=True)


# Batches and impossible positions -----------------------------------------------------------------


def test_one_impossible_position_does_not_spoil_the_others() -> None:
    def build(b: Builder) -> PointName:
        return b.intersect_circles("X", P, NumberName("r1"), Q, NumberName("r2"), Side.LEFT)

    centres = np.array([5 + 0j, 50 + 0j, 3 + 4j])
    value, margin = run(build, P=0j, Q=centres, r1=3.0, r2=4.0)
    assert np.isfinite(value).tolist() == [True, False, True]
    assert (margin > 0).tolist() == [True, False, True]
    assert abs(value[0] - (1.8 + 2.4j)) < 1e-14
    alone, _ = run(build, P=0j, Q=centres[2:], r1=3.0, r2=4.0)
    assert value[2] == alone[0]


def test_a_result_of_an_impossible_point_is_not_a_number() -> None:
    def build(b: Builder) -> NumberName:
        x = b.intersect_circles("X", P, NumberName("r1"), Q, NumberName("r2"), Side.LEFT)
        y = b.intersect_lines("Y", b.join(P, x), b.perpendicular(Q, b.join(P, Q)))
        return b.measure("d", P, y)

    value, _ = run(build, P=0j, Q=50 + 0j, r1=3.0, r2=4.0)
    assert math.isnan(value)


def test_margins_do_not_depend_on_the_hand() -> None:
    def build(b: Builder) -> PointName:
        return b.intersect_circles("X", P, NumberName("r1"), Q, NumberName("r2"), Side.LEFT)

    exact = run(build, P=0.3j, Q=5 + 0j, r1=3.3, r2=4.0)
    by_hand = run(build, hand=RulerArithmetic(ruler=1.0), P=0.3j, Q=5 + 0j, r1=3.3, r2=4.0)
    assert exact == by_hand


def held(b: Builder, kinds: str) -> LineName:
    """Hold a link by legs: r a radius, l a line, t a line of the link through a point."""
    x, y, c, dx, dy, turn = map(NumberName, ("bx", "by", "c", "dx", "dy", "turn"))
    places: tuple[Any, ...] = ((None, None), (c, None), (dx, dy))
    legs = []
    for i, (kind, at) in enumerate(zip(kinds, places, strict=True)):
        centre = PointName(f"A{i}")
        if kind == "r":
            legs.append(Leg(at, centre=centre, radius=NumberName(f"r{i}")))
        elif kind == "l":
            legs.append(Leg(at, line=b.join(centre, PointName(f"E{i}"))))
        else:
            legs.append(Leg(at, centre=centre, angle=NumberName(f"t{i}")))
    one, two, three = legs
    return b.pose_triad("axis", (one, two, three), (x, y, turn))


@pytest.mark.parametrize("kinds", ["rrr", "rrl", "rrt", "rlt", "rll", "llt", "ttr"])
@pytest.mark.parametrize("scale", [1.0, 50.0])
def test_a_held_link_is_where_all_three_legs_have_it(kinds: str, scale: float) -> None:
    """From a start that is off by a thousandth; the margin is the determinant of three lines."""
    b, turn = scale * (0.4 + 0.1j), 25.0
    w = cmath.rect(1.0, math.radians(turn))
    spots = [0j, scale * (0.9 + 0j), scale * (0.4 + 0.7j)]
    data: dict[str, Any] = {"bx": b.real, "by": b.imag * 1.001, "turn": turn + 0.05}
    data |= {"c": spots[1].real, "dx": spots[2].real, "dy": spots[2].imag}
    lines = []
    centres = [scale * z for z in (-0.5 - 0.2j, 1.6 - 0.5j, 0.9 + 1.7j)]
    for i, (kind, z, centre) in enumerate(zip(kinds, spots, centres, strict=True)):
        place, data[f"A{i}"] = b + w * z, centre
        ray = (place - centre) / abs(place - centre)
        if kind == "r":
            data[f"r{i}"] = abs(place - centre)
        elif kind == "l":
            data[f"A{i}"], data[f"E{i}"] = place - 2 * ray, place + 3 * ray
            ray *= 1j
        else:
            data[f"t{i}"] = math.degrees(cmath.phase(ray / w))
            ray *= 1j
        at = centre if kind == "t" else place
        lines.append((ray.real, ray.imag, ((at - b).conjugate() * ray).imag))
    (p, u), margin = run(lambda builder: held(builder, kinds), **data)
    assert abs(scalar(p) - b) < TINY * scale
    assert abs(scalar(u) - w) < TINY
    size = sum(map(abs, spots))
    assert abs(scalar(margin) - abs(np.linalg.det(np.array(lines))) / size) < TINY

    def spot(builder: Builder) -> Name:
        return builder.spot("D", held(builder, kinds), (NumberName("dx"), NumberName("dy")))

    found, _ = run(spot, **data)
    assert abs(scalar(found) - (b + w * spots[2])) < TINY * scale


@pytest.mark.parametrize("bx", [1.0, math.nan])
def test_a_link_without_a_pose_has_no_positive_margin(bx: float) -> None:
    data: dict[str, Any] = {"A0": 0j, "A1": 10 + 0j, "A2": 5 + 9j}
    data |= {"r0": 1.0, "r1": 1.0, "r2": 1.0}
    data |= {"c": 1.0, "dx": 0.5, "dy": 0.8, "bx": bx, "by": 0.3, "turn": 10.0}
    (p, _), margin = run(lambda builder: held(builder, "rrr"), **data)
    assert not scalar(margin).real > 0
    assert np.isnan(scalar(p))


@given(place, place, place, place)
def test_an_angle_is_read_counter_clockwise_from_a_line(
    p: complex, q: complex, r: complex, s: complex
) -> None:
    assume(apart(p, q) and apart(r, s))
    value, _ = run(lambda b: b.measure_angle("x", b.join(P, Q)), P=p, Q=q)
    assert -180.0 < real(value) <= 180.0
    assert abs(cmath.exp(1j * math.radians(real(value))) - (q - p) / abs(q - p)) < TINY
    between, _ = run(lambda b: b.measure_angle("x", b.join(P, Q), b.join(R, S)), P=p, Q=q, R=r, S=s)
    turned = (q - p) / abs(q - p) / ((s - r) / abs(s - r))
    assert abs(cmath.exp(1j * math.radians(real(between))) - turned) < TINY


def test_a_line_to_the_left_is_at_180_degrees_in_every_arithmetic() -> None:
    b = Builder()
    line = b.join(b.take_point("P"), b.take_point("Q"))
    angle = b.measure_angle("x", line)
    for left in (complex(-1.0, 0.0), complex(-1.0, -0.0)):
        for ar in (Float64(), Duals(), Precise(), RulerArithmetic(0.5)):
            value: Any = evaluate(b.program(), {"P": 0j, "Q": left}, ar).value[angle]
            assert float(getattr(value, "value", value)) == 180.0


def test_an_angle_is_read_with_a_protractor_and_has_an_error() -> None:
    b = Builder()
    angle = b.measure_angle("x", b.join(b.take_point("P"), b.take_point("Q")))
    data = {"P": 0j, "Q": 100.0 * cmath.exp(1j * math.radians(30.2))}
    assert evaluate(b.program(), data, RulerArithmetic(0.5)).value[angle] == 30.0
    profile = DRAFTING_PROFILES["board"]
    found = float(drawing_sigmas(b.program(), data, profile, frozenset())[angle][0])
    # Two pricked points and the ruler put through them; the protractor, and its marks.
    line = math.degrees(2.0 * profile.point / 100.0)
    marks = profile.ruler / math.sqrt(12.0)
    assert found == pytest.approx(math.hypot(line, profile.parallel, marks), rel=1e-6)


def test_every_kind_of_step_is_tested_here() -> None:
    b = Builder()
    b.take_point("P"), b.take_point("Q"), b.take_point("R"), b.take_point("S"), b.known("x")
    pq = b.join(P, Q)
    x = NumberName("x")
    b.intersect_lines("1", pq, b.perpendicular(R, pq))
    b.intersect_lines("2", b.parallel(R, pq), b.at_angle(P, pq, x))
    b.intersect_line_circle("3", pq, R, x, LineSense.FORWARD)
    b.intersect_circles("4", P, x, Q, x, Side.LEFT)
    b.touch("5", P, x, R, Side.LEFT)
    leg = Leg((None, None), centre=P, radius=x)
    b.spot("14", b.pose_triad("axis", (leg, leg, leg), (x, x, x)), (x, None))
    b.similar("6", (P, Q), (P, Q, R), x)
    b.lay_off_length("7", P, pq, x)
    b.measure("8", P, Q)
    b.measure_along("9", P, Q, pq)
    b.measure_angle("15", pq)
    b.compute("10", (x, 1))
    # In test_force_steps.py:
    b.carry("11", P, Q, R)
    b.measure_arm("12", P, Q, R, S)
    b.total("13", x, x)
    kinds = {type(step) for step in b.program().steps}
    assert kinds == set(STEP_TYPES)
