"""A link that three legs hold: its pose by Newton's method (группа III класса, сборка).

The same steps are made in every arithmetic. The start, which is near one of several assemblies,
determines which one is meant.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from planmethod.construct.arithmetic import Arithmetic, Number
from planmethod.construct.steps import Leg, Name, Place, TriadPose

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
