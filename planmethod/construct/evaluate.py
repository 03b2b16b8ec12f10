"""The one interpreter: reads a program in any arithmetic."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import assert_never

import numpy as np

from planmethod.construct.arithmetic import Arithmetic, Number
from planmethod.construct.program import Program
from planmethod.construct.steps import (
    AtAngle,
    Compute,
    Given,
    Join,
    Known,
    LayOff,
    Measure,
    MeasureAlong,
    MeetCircles,
    MeetLineCircle,
    MeetLines,
    Name,
    Parallel,
    Perpendicular,
    Similar,
    Step,
    Touch,
)

PARALLEL = 1e-12
"""Sine of the angle between two lines below which their meeting is not defined."""

TANGENT = -1e-12
"""Margin of two arcs down to which they touch: rounding of the data, not a gap."""


@dataclass(frozen=True, slots=True)
class Trace:
    """Values of every step and how far each stood from being impossible.

    Attributes
    ----------
    value : mapping
        Points: complex ndarray of shape (n,) or (), mm; numbers: real ndarray in their unit;
        lines: pair of complex (a point of the line, its direction, any length but zero).
    margin : mapping
        For every step that may not exist: sine of the angle between two lines, or the half chord
        squared over the radius squared of two arcs; negative where they do not meet.
    """

    value: Mapping[Name, Number]
    margin: Mapping[Name, Number]


def _cross(a: Number, b: Number) -> Number:
    return (a.conjugate() * b).imag


def _along(vector: Number, direction: Number) -> Number:
    return (vector * direction.conjugate()).real / abs(direction)


def _half_chord(leg: Number, radius: Number) -> Number:
    """Return radius² - leg² as a product: it keeps its digits where the arcs nearly touch."""
    return (radius - leg) * (radius + leg)


def _apply(
    step: Step, env: Mapping[Name, Number], data: Mapping[str, Number], ar: Arithmetic
) -> tuple[Number, Number]:
    """Return the value of one step and its margin (None when the step always exists)."""
    match step:
        case Given(out) | Known(out):
            return data[out], None
        case Join(_, a, b):
            return (env[a], env[b] - env[a]), None
        case Parallel(_, t, line):
            return (env[t], env[line][1]), None
        case Perpendicular(_, t, line):
            return (env[t], env[line][1] * 1j), None
        case AtAngle(_, t, line, angle):
            turn = ar.direction(env[angle])
            return (env[t], turn if line is None else env[line][1] * turn), None
        case LayOff(_, o, line, length):
            u, size = env[line][1], env[length]
            laid = env[o] + u * (size / ar.nonzero(abs(u)))
            return ar.pick(size == 0, env[o], laid), None  # a zero length needs no direction
        case MeetLines(_, f, g):
            (p, u), (q, v) = env[f], env[g]
            across = _cross(u, v)
            sine = abs(across) / ar.nonzero(abs(u) * abs(v))
            return p + u * (_cross(q - p, v) / ar.nonzero(across)), sine
        case MeetLineCircle(_, line, c, r, way):
            (p, u), radius = env[line], env[r]
            u = u / ar.nonzero(abs(u))
            to_centre = env[c] - p
            room = _half_chord(abs(_cross(u, to_centre)), radius)
            # Counted along the line from its own point: what lies on a guide stays on it exactly.
            reach = (u.conjugate() * to_centre).real + way.value * ar.root(room)
            return p + u * reach, room / (radius * radius)
        case MeetCircles(_, c1, r1, c2, r2, side):
            d = env[c2] - env[c1]
            span, one, two = abs(d), env[r1], env[r2]
            leg = (span + (one - two) * ((one + two) / ar.nonzero(span))) / 2
            room = _half_chord(leg, one)
            unit = d / ar.nonzero(span)
            return env[c1] + unit * (leg + 1j * side.value * ar.root(room)), room / (one * one)
        case Touch(_, c, r, s, side):
            d, radius = env[s] - env[c], env[r]
            span = abs(d)
            room = _half_chord(radius, span)
            unit = d / ar.nonzero(span)
            turn = (radius + 1j * side.value * ar.root(room)) / ar.nonzero(span)
            return env[c] + unit * (radius * turn), room / ar.nonzero(span * span)
        case Similar(_, b, c, s, B, C, read_span, read_arm):
            side, span, arm = env[c] - env[b], env[C] - env[B], env[s] - env[B]
            scale = ar.reread(abs(side))
            if read_span:
                scale = scale / ar.reread(abs(span))
            if read_arm:
                scale = scale * ar.reread(abs(arm))
            return env[b] + side * (arm / span) * scale, None
        case Measure(_, a, b):
            return ar.ruled(abs(env[b] - env[a])), None
        case MeasureAlong(_, a, b, line):
            return ar.ruled(_along(env[b] - env[a], env[line][1])), None
        case Compute(_, factor, powers):
            value: Number = factor
            for name, power in powers:
                value = value * env[name] ** power
            return value, None
        case _:
            assert_never(step)


def evaluate(program: Program, data: Mapping[str, Number], ar: Arithmetic) -> Trace:
    """Evaluate every step once, in order.

    Parameters
    ----------
    program : Program
    data : mapping
        Values of the Given points (complex, mm) and Known numbers, scalars or shape (n,).
    ar : Arithmetic
    """
    lifted = {name: ar.lift(value) for name, value in data.items()}
    env: dict[Name, Number] = {}
    margin: dict[Name, Number] = {}
    with np.errstate(all="ignore"):
        for step in program.steps:
            value, room = _apply(step, env, lifted, ar)
            if room is not None:
                margin[step.out] = room
                value = ar.where(
                    room > (PARALLEL if isinstance(step, MeetLines) else TANGENT), value
                )
            env[step.out] = value
    return Trace(env, margin)
