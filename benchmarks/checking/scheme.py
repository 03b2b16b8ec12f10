"""Geometry of a student: where the joints of a linkage are (положения механизма).

Points are complex numbers, x right and y up, metres; angles are in degrees.
"""

from __future__ import annotations

import cmath
import math
from functools import cache

from benchmarks.checking.hand import ImpossibleError


def at_angle(degrees: float) -> complex:
    """Return a unit vector."""
    return cmath.exp(1j * math.radians(degrees))


def dot(one: complex, other: complex) -> float:
    """Return the scalar product."""
    return (one.conjugate() * other).real


def cross(one: complex, other: complex) -> float:
    """Return the vector product, counter-clockwise positive."""
    return (one.conjugate() * other).imag


def lines(point: complex, along: complex, other: complex, other_along: complex) -> complex:
    """Return where two lines meet."""
    area = cross(along, other_along)
    if abs(area) < 0.05 * abs(along) * abs(other_along):
        raise ImpossibleError("the lines hardly meet")
    return point + along * (cross(other - point, other_along) / area)


def circles(near: complex, radius: float, far: complex, other: float, side: int) -> complex:
    """Return where two circles meet, to the left (side 1) or right (−1) of near–far."""
    apart = abs(far - near)
    along = (apart**2 + radius**2 - other**2) / (2 * apart)
    height = radius**2 - along**2
    if height <= 0.0:
        raise ImpossibleError("the circles do not meet")
    return near + (far - near) / apart * complex(along, side * math.sqrt(height))


def circle_line(
    centre: complex, radius: float, through: complex, along: complex, side: int
) -> complex:
    """Return where a circle meets a line, at its far (side 1) or near (−1) end along it."""
    foot = through + along * dot(along, centre - through)
    height = radius**2 - abs(centre - foot) ** 2
    if height <= 0.0:
        raise ImpossibleError("the circle does not reach the line")
    return foot + side * along * math.sqrt(height)


def triangle(near: complex, far: complex, from_near: float, from_far: float, side: int) -> complex:
    """Return the third corner of a link."""
    return circles(near, from_near, far, from_far, side)


@cache
def on_three_arms(
    grounds: tuple[complex, complex, complex],
    arms: tuple[float, float, float],
    body: tuple[complex, complex, complex],
    guess: complex,
) -> tuple[complex, complex, complex]:
    """Return the corners of a body held by three arms, the assembly next to a guess.

    The body is placed by the first corner's angle on its arm and its own angle, found by Newton's
    method from many of both.
    """
    found: list[tuple[complex, complex, complex]] = []
    sides = [corner - body[0] for corner in body]

    def placed(one: float, two: float) -> list[complex]:
        first = grounds[0] + arms[0] * cmath.exp(1j * one)
        return [first + side * cmath.exp(1j * two) for side in sides]

    def off(one: float, two: float) -> tuple[float, float]:
        corners = placed(one, two)
        return (
            abs(corners[1] - grounds[1]) ** 2 - arms[1] ** 2,
            abs(corners[2] - grounds[2]) ** 2 - arms[2] ** 2,
        )

    for start in range(24):
        for turn in range(24):
            one, two = start * math.pi / 12, turn * math.pi / 12
            for _ in range(30):
                here = off(one, two)
                step = 1e-7
                by_one = [(b - a) / step for a, b in zip(here, off(one + step, two), strict=True)]
                by_two = [(b - a) / step for a, b in zip(here, off(one, two + step), strict=True)]
                area = by_one[0] * by_two[1] - by_one[1] * by_two[0]
                if abs(area) < 1e-15:
                    break
                first = (here[0] * by_two[1] - here[1] * by_two[0]) / area
                second = (by_one[0] * here[1] - by_one[1] * here[0]) / area
                one, two = one - first, two - second
                if abs(first) + abs(second) < 1e-13:
                    corners = placed(one, two)
                    if max(map(abs, off(one, two))) < 1e-12:
                        found.append((corners[0], corners[1], corners[2]))
                    break
    if not found:
        raise ImpossibleError("the arms do not hold the body")
    return min(found, key=lambda corners: abs(corners[0] - guess))
