"""The one interpreter: reads a program in any arithmetic."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TypeAlias, assert_never

import numpy as np
from msgspec import Struct

from planmethod.construct.arithmetic import Arithmetic, Number
from planmethod.construct.program import Program
from planmethod.construct.steps import (
    AtAngle,
    Carry,
    Compute,
    GivenNumber,
    GivenPoint,
    IntersectCircles,
    IntersectLineCircle,
    IntersectLines,
    Join,
    LayOffLength,
    Leg,
    Measure,
    MeasureAlong,
    MeasureAngle,
    MeasureArm,
    Name,
    Parallel,
    Perpendicular,
    Place,
    Similar,
    Spot,
    Step,
    Total,
    Touch,
    TriadPose,
)

ROUNDS = 5
"""Newton iterations from a start with some six correct digits to the fifty of multiprecision."""

MAX_LAST_STEP = 1e-5
"""Limit of the last step, relative to the link and in radians, for convergence."""


def cross(a: Number, b: Number) -> Number:
    """Return the moment of two vectors."""
    return (a.conjugate() * b).imag


def place(at: Place, env: Mapping[Name, Number]) -> Number:
    """Return a place of a link by its coordinates, mm."""
    along, left = (0.0 if name is None else env[name] for name in at)
    return along + 1j * left


def solve_pose(
    step: TriadPose, env: Mapping[Name, Number], ar: Arithmetic, rounds: int = ROUNDS
) -> tuple[tuple[Number, Number], Number, Number]:
    """Return the pose of a link that three legs hold, its margin, and its determinant.

    The pose are the link's origin, mm, and the direction of its axis, a unit vector. The
    determinant, mm, is that of the lines of the three legs: 0 where they meet in one point, a dead
    position; its sign changes there alone. The margin is its size in parts of the link's, negative
    where Newton's method does not settle.
    """
    legs = [_leg_residual(leg, place(leg.at, env), step.out, env, ar) for leg in step.legs]
    size = sum((abs(place(leg.at, env)) for leg in step.legs), 0.0)
    x, y, turn = (env[name] for name in step.start)
    b, w = x + 1j * y, ar.direction(turn)
    det = off = size
    for _ in range(rounds):
        (f, m, s), (g, n, t), (h, o, u) = (ask(b, w) for ask in legs)
        det = s * cross(n, o) + t * cross(o, m) + u * cross(m, n)
        divisor = ar.nonzero(det)
        turned = (f * cross(n, o) + g * cross(o, m) + h * cross(m, n)) / -divisor
        moved = ((h * t - g * u) * m + (f * u - h * s) * n + (g * s - f * t) * o) * 1j / divisor
        b, w = b + moved, w * (1.0 + 1j * turned)
        w = w / abs(w)
        off = abs(moved) / size + abs(turned)
    margin, _ = ar.ordered(abs(det) / size, 1.0 - off / MAX_LAST_STEP)
    return (b, w), margin, det


def _leg_residual(
    leg: Leg, z: Number, out: str, env: Mapping[Name, Number], ar: Arithmetic
) -> Callable[[Number, Number], tuple[Number, Number, Number]]:
    """Return a function of a pose that gives the residual of a leg's condition, and the leg's line.

    The pose consists of the link's origin and its direction; the line is given by a unit vector and
    its moment about the origin.
    """
    if leg.line is not None:
        p, u = env[leg.line]
        across = u * 1j / ar.nonzero(abs(u))
        return lambda b, w: (
            (across.conjugate() * (b + w * z - p)).real,
            across,
            cross(w * z, across),
        )
    assert leg.centre is not None
    if leg.radius is not None:
        centre, radius = ar.arc(out, env[leg.centre], env[leg.radius])

        def reached(b: Number, w: Number) -> tuple[Number, Number, Number]:
            away = b + w * z - centre
            span = abs(away)
            unit = away / ar.nonzero(span)
            return span - radius, unit, cross(w * z, unit)

        return reached
    centre = env[leg.centre]
    turn = 1.0 + 0j if leg.angle is None else ar.direction(env[leg.angle])

    def passed(b: Number, w: Number) -> tuple[Number, Number, Number]:
        across = w * turn * 1j
        away = b - centre
        return (across.conjugate() * (away + w * z)).real, across, -cross(away, across)

    return passed


PARALLEL = 1e-12
"""Sine of the angle between two lines below which their intersection is not defined."""

TANGENT = -1e-12
"""Margin of two arcs down to which they touch: rounding of the data, not a gap."""


class Trace(Struct, frozen=True):
    """Values of every step and the margins by which the steps are possible.

    Attributes
    ----------
    value : mapping
        Points: complex ndarray of shape (n,) or (), mm; numbers: real ndarray in their unit;
        lines: pair of complex (a point of the line, its direction, any length but zero).
    margin : mapping
        For every step that may not exist: sine of the angle between two lines, or the half chord
        squared over the radius squared of two arcs; negative where they do not meet; 1 or 0 of
        what only needs a direction.
    """

    value: Mapping[Name, Number]
    margin: Mapping[Name, Number]


def _cross(a: Number, b: Number) -> Number:
    return (a.conjugate() * b).imag


def _half_chord(leg: Number, radius: Number) -> Number:
    """Return radius² - leg² as a product: it keeps its digits where a line nearly touches."""
    return (radius - leg) * (radius + leg)


def apply(
    step: Step, env: Mapping[Name, Number], data: Mapping[str, Number], ar: Arithmetic
) -> tuple[Number, Number]:
    """Return the value of one step and its margin (None when the step always exists)."""
    match step:
        case GivenPoint(out):
            return ar.given_point(out, data[out]), None
        case GivenNumber(out):
            return data[out], None
        case Join(out, a, b):
            return ar.line_through(out, env[a], env[b] - env[a]), None
        case Parallel(out, t, line):
            return ar.drawn(out, env[t], env[line][1]), None
        case Perpendicular(out, t, line):
            return ar.drawn(out, env[t], env[line][1] * 1j), None
        case AtAngle(out, t, line, angle):
            turn = ar.direction(env[angle])
            return ar.drawn(out, env[t], turn if line is None else env[line][1] * turn), None
        case LayOffLength(out, o, line, length):
            u, size = env[line][1], env[length]
            span = abs(u)
            point = env[o] + u * (ar.laid_off_length(out, size) / ar.nonzero(span))
            # A zero length needs no direction: it is laid off even along a line that has none.
            return ar.unless_zero(span, point, env[o]), ar.unless_zero(
                size, ar.direction_margin(span), 1.0
            )
        case IntersectLines(out, f, g):
            (p, u), (q, v) = env[f], env[g]
            across = _cross(u, v)
            sine = abs(across) / ar.nonzero(abs(u) * abs(v))
            return ar.pricked(out, p + u * (_cross(q - p, v) / ar.nonzero(across))), sine
        case IntersectLineCircle(out, line, c, r, way, branch):
            p, u = env[line]
            centre, radius = ar.arc(out, env[c], env[r])
            u = u / ar.nonzero(abs(u))
            to_centre = centre - p
            room = _half_chord(abs(_cross(u, to_centre)), radius)
            # Measured along the line from its own point: a point on a guide stays on it exactly.
            half = ar.root(room) if branch is None else ar.root(room) * env[branch]
            reach = (u.conjugate() * to_centre).real + way.value * half
            return ar.pricked(out, p + u * reach), room / (radius * radius)
        case IntersectCircles(out, c1, r1, c2, r2, side, branch):
            (p, one), (q, two) = ar.arc(out, env[c1], env[r1]), ar.arc(out, env[c2], env[r2])
            d = q - p
            span = abs(d)
            divisor = ar.nonzero(span)
            leg = (span + (one - two) * ((one + two) / divisor)) / 2
            # Heron's formula with the cancelling difference taken from the data, as Kahan does:
            # half the chord keeps its digits where the arcs touch from outside or from inside.
            small, big = ar.ordered(one, two)
            gap = span - big
            wide = ((span + (big - small)) / divisor) * ((span + (big + small)) / divisor)
            room = _half_chord(gap, small) * wide / 4
            unit = d / divisor
            half = ar.root(room) if branch is None else ar.root(room) * env[branch]
            point = p + unit * (leg + 1j * side.value * half)
            return ar.pricked(out, point), room / (one * one)
        case Touch(out, c, r, s, side):
            (centre, radius), source = ar.arc(out, env[c], env[r]), env[s]
            d = source - centre
            span = abs(d)
            divisor = ar.nonzero(span)
            room = _half_chord(radius, span)
            half = ar.root(room)
            turn = (radius + 1j * side.value * half) / divisor
            # A tangent of no length: the foot is the source itself, and no line joins them.
            point = ar.unless_zero(half, centre + d / divisor * (radius * turn), source)
            return ar.pricked(out, point), room / (divisor * divisor)
        case TriadPose():
            pose, room, _ = solve_pose(step, env, ar)
            return pose, room
        case Spot(out, axis, at):
            b, w = env[axis]
            return ar.pricked(out, b + w * place(at, env)), None
        case Similar(out, b, c, s, B, C, side_read, span_read, arm_read):
            side, span, arm = env[c] - env[b], env[C] - env[B], env[s] - env[B]
            scale = ar.length_ratio(env[side_read], side)
            if span_read is not None:
                scale = scale / ar.nonzero(ar.length_ratio(env[span_read], span))
            if arm_read is not None:
                scale = scale * ar.length_ratio(env[arm_read], arm)
            point = env[b] + side * (arm / ar.nonzero(span)) * scale
            return ar.pricked(out, point), ar.direction_margin(abs(span))
        case Measure(out, a, b):
            return ar.read(out, abs(env[b] - env[a])), None
        case MeasureAlong(out, a, b, line):
            u = env[line][1]
            span = abs(u)
            vector = env[b] - env[a]
            along = (vector * u.conjugate()).real / ar.nonzero(span)
            return ar.read(out, along), ar.direction_margin(span)
        case Compute(_, factor, powers, size):
            value: Number = factor
            for name, power in powers:
                for _ in range(abs(power)):
                    value = value * env[name] if power > 0 else value / ar.nonzero(env[name])
            return abs(value) if size else value, None
        case Total(_, terms):
            total: Number = 0.0
            for name in terms:
                total = total + env[name]
            return total, None
        case Carry(out, o, a, b, length, times, turned):
            vector = env[b] - env[a]
            if length is not None:
                vector = vector * ar.length_ratio(env[length], vector)
            if times is not None:
                vector = vector * env[times]
            point = env[o] + (vector * 1j if turned else vector)
            # No pencil marks the end of a vector of no length; but what moves it moves its end.
            return ar.unless_zero(abs(vector), ar.pricked(out, point), point), None
        case MeasureArm(out, about, at, a, b):
            vector = env[b] - env[a]
            size = abs(vector)
            arm = _cross(env[at] - env[about], vector) / ar.nonzero(size)
            return ar.read(out, ar.unless_zero(size, arm, 0.0)), None
        case MeasureAngle(out, line, base):
            u = env[line][1]
            turned = u if base is None else u * env[base][1].conjugate()
            return ar.read_angle(out, ar.angle(turned)), ar.direction_margin(abs(turned))
        case _:
            assert_never(step)


def limit_of(step: Step) -> float:
    """Return the margin that a step must exceed to exist."""
    match step:
        case IntersectLines():
            return PARALLEL
        case IntersectCircles() | IntersectLineCircle() | Touch():
            return TANGENT
        case _:
            return 0.0


Substitution: TypeAlias = Callable[[Name, Number], Number]


def evaluate(
    program: Program,
    data: Mapping[str, Number],
    ar: Arithmetic,
    substitute: Substitution | None = None,
) -> Trace:
    """Evaluate every step once, in order.

    Parameters
    ----------
    program : Program
    data : mapping
        Values of the Given points (complex, mm) and Known numbers, scalars or shape (n,).
    ar : Arithmetic
    substitute : callable, optional
        Receives the result of a step and returns the value that further steps use instead: for
        example a student's own value (подстановка).
    """
    return extend_trace(Trace({}, {}), program.steps, data, ar, substitute)


def extend_trace(
    trace: Trace,
    steps: Iterable[Step],
    data: Mapping[str, Number],
    ar: Arithmetic,
    substitute: Substitution | None = None,
) -> Trace:
    """Return a trace extended by further steps, which may use all its values.

    Parameters
    ----------
    data : mapping
        Values of the given points and known numbers of the further steps.
    substitute : callable, optional
        As of `evaluate`.
    """
    lifted = {name: ar.lift(value) for name, value in data.items()}
    env, margin = dict(trace.value), dict(trace.margin)
    with np.errstate(all="ignore"):
        for step in steps:
            value, room = apply(step, env, lifted, ar)
            if room is not None:
                margin[step.out] = room
                if isinstance(value, tuple):
                    value = ar.guard(room, limit_of(step), value[0]), value[1]
                else:
                    value = ar.guard(room, limit_of(step), value)
            env[step.out] = value if substitute is None else substitute(step.out, value)
    return Trace(env, margin)
