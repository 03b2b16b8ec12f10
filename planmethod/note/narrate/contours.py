"""Closed contours of a linkage: places, and derivatives by the driver (метод замкнутых контуров).

Links are directions, and lengths along them vectors. A group closes a contour from one of its outer
joints to the other. Its projections give two unknowns in closed form; differentiated twice, they
are linear in the derivatives of the unknowns, with the same coefficients.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from msgspec import Struct

from planmethod.note.formula import Rich
from planmethod.note.numbers import Notation
from planmethod.note.spelled import (
    ONE,
    ZERO,
    Spelled,
    cosine,
    degree,
    named_angle,
    number,
    over,
    sine,
    squared,
    times,
    total,
)
from planmethod.plans.draft import cis

Define: TypeAlias = Callable[[Rich, Spelled, str], Spelled]
"""Writes the formula of a new letter with a unit; returns the letter with its value."""

AXES = ("x", "y")

DECIMALS = 9
"""Decimals to which constant angles are rounded, degrees: right angles are exact."""


class Turn(Struct):
    """Angle of a link, degrees, with its derivatives by the driver's coordinate (угол звена)."""

    angle: Spelled
    rates: tuple[Spelled, Spelled]
    symbols: tuple[Rich, Rich] = ("", "")


class Direction(Struct, frozen=True):
    """Direction at a constant angle to a link that turns, or to the axis x (направление).

    Attributes
    ----------
    turn : Turn or None
    right : float
        Multiple of a right angle, degrees: formulas are reduced by it.
    angle : float
        Rest of the angle, degrees, which has the letter ``symbol``.
    """

    turn: Turn | None
    right: float = 0.0
    angle: float = 0.0
    symbol: Rich = ""

    def rotated(self, angle: float, symbol: Rich = "") -> Direction:
        """Return a direction at an angle to it; unless that is right, the sum has the symbol."""
        if angle % 90.0 == 0.0:
            return Direction(self.turn, _reduced(self.right + angle), self.angle, self.symbol)
        whole = round(_reduced(self.right + self.angle + angle), DECIMALS)
        if whole % 90.0 == 0.0:
            return Direction(self.turn, whole)
        return Direction(self.turn, 0.0, whole, symbol)

    def offset(self, notation: Notation) -> Spelled:
        """Return its angle to the link, degrees."""
        letter = named_angle(self.symbol, self.angle, notation) if self.angle else ZERO
        return total(letter, degree(self.right, notation))

    def value(self, notation: Notation) -> Spelled:
        """Return its angle from the axis x, degrees."""
        own = self.offset(notation)
        return own if self.turn is None else total(self.turn.angle, own)

    def projections(self, notation: Notation) -> tuple[Spelled, Spelled]:
        """Return the projections of a unit vector."""
        parts = [ZERO if self.turn is None else self.turn.angle]
        if self.angle:
            parts.append(named_angle(self.symbol, self.angle, notation))
        angle = total(*parts)
        c, s = (ONE, ZERO) if angle.is_zero else (cosine(angle), sine(angle))
        return {1: (c, s), 1j: (-s, c), -1: (-c, -s), -1j: (s, -c)}[cis(self.right)]

    @property
    def rates(self) -> tuple[Spelled, Spelled]:
        """Derivatives of its angle."""
        return (ZERO, ZERO) if self.turn is None else self.turn.rates


def _reduced(angle: float) -> float:
    return 180.0 - (180.0 - angle) % 360.0


class Arm(Struct):
    """Vector of a contour: a length in a direction (вектор контура).

    ``rates`` are the derivatives of a length that changes; ``symbols`` their letters.
    """

    vector: Rich
    length: Spelled
    direction: Direction
    rates: tuple[Spelled, Spelled] = (ZERO, ZERO)
    symbols: tuple[Rich, Rich] = ("", "")

    def place(self, notation: Notation) -> tuple[Spelled, Spelled]:
        """Return its projections."""
        c, s = self.direction.projections(notation)
        return times(self.length, c), times(self.length, s)

    def velocity(self, notation: Notation) -> tuple[Spelled, Spelled]:
        """Return the first derivatives of its projections."""
        (c, s), turn = self.direction.projections(notation), self.direction.rates[0]
        return (
            total(times(self.rates[0], c), -times(self.length, turn, s)),
            total(times(self.rates[0], s), times(self.length, turn, c)),
        )

    def acceleration(self, notation: Notation) -> tuple[Spelled, Spelled]:
        """Return the second derivatives of its projections."""
        (c, s), (turn, again) = self.direction.projections(notation), self.direction.rates
        inward = times(self.length, squared(turn))
        aside = times(number(2.0, notation), self.rates[0], turn)
        return (
            total(times(self.rates[1], c), -times(aside, s), -times(self.length, again, s),
                  -times(inward, c)),
            total(times(self.rates[1], s), times(aside, c), times(self.length, again, c),
                  -times(inward, s)),
        )  # fmt: skip


class Place(Struct, frozen=True):
    """Coordinates of a point with their first and second derivatives (координаты точки)."""

    name: Rich
    at: tuple[Spelled, Spelled]
    rates: tuple[tuple[Spelled, Spelled], tuple[Spelled, Spelled]] = ((ZERO, ZERO), (ZERO, ZERO))

    @property
    def is_origin(self) -> bool:
        """Whether it is the origin."""
        return all(one.is_zero for one in self.at)


class Side(Struct, frozen=True):
    """One way round a contour: from a known point by vectors (ветвь контура)."""

    start: Place
    arms: tuple[Arm, ...]

    @property
    def vectors(self) -> Rich:
        """Its vectors as a sum."""
        found = [] if self.start.is_origin else [f"\\bar{{r}}_{{{self.start.name}}}"]
        found += [arm.vector for arm in self.arms if not arm.length.is_zero]
        return " + ".join(found).replace("+ −", "− ") or "0"

    @property
    def is_fixed(self) -> bool:
        """Whether its start and its directions stay: a guide of the frame."""
        moves = any(not one.is_zero for pair in self.start.rates for one in pair)
        return not moves and all(arm.direction.turn is None for arm in self.arms)

    def sums(self, order: int, notation: Notation) -> tuple[Spelled, Spelled]:
        """Return the projections of its end, or their derivatives of an order."""
        start = self.start.rates[order - 1] if order else self.start.at
        ways = (Arm.place, Arm.velocity, Arm.acceleration)
        parts = [ways[order](arm, notation) for arm in self.arms]
        x, y = (total(start[k], *(part[k] for part in parts)) for k in (0, 1))
        return x, y


class Unknown(Struct, frozen=True):
    """Unknown of a contour: an angle, or a length along a guide."""

    of: Turn | Arm

    def coefficients(self, sides: Sequence[Side], notation: Notation) -> tuple[Spelled, Spelled]:
        """Return the derivatives of the contour's projections by it, the second side negative."""
        found: list[tuple[Spelled, Spelled]] = []
        for sign, side in zip((1, -1), sides, strict=True):
            for arm in side.arms:
                c, s = arm.direction.projections(notation)
                if arm is self.of:
                    pair = (c, s)
                elif arm.direction.turn is self.of:
                    pair = (-times(arm.length, s), times(arm.length, c))
                else:
                    continue
                found.append(pair if sign > 0 else (-pair[0], -pair[1]))
        x, y = (total(*(pair[k] for pair in found)) for k in (0, 1))
        return x, y


class LinearSystem:
    """Two linear equations for derivatives of the unknowns of a contour (линейная система)."""

    def __init__(
        self, rows: Sequence[tuple[Spelled, Spelled]], notation: Notation, define: Define
    ) -> None:
        self.rows = rows
        self.a = [
            [_short(f"a_{{{i}{j}}}", one, define) for j, one in enumerate(row, 1)]
            for i, row in enumerate(rows, 1)
        ]
        (a, b), (c, d) = self.a
        self.determinant = _short("Δ", total(times(a, d), -times(b, c)), define)

    def solve(
        self, right: Sequence[Spelled], letter: str, define: Define
    ) -> tuple[Spelled, Spelled]:
        """Return both unknowns by determinants; ``letter`` names the right sides."""
        (a, b), (c, d) = self.a
        e, f = (_short(f"{letter}_{{{i}}}", one, define) for i, one in enumerate(right, 1))
        return (
            over(total(times(e, d), -times(b, f)), self.determinant),
            over(total(times(a, f), -times(c, e)), self.determinant),
        )


def _short(symbol: Rich, value: Spelled, define: Define) -> Spelled:
    """Return a letter for a sum or a product; a constant is used as it is."""
    if value.is_constant:
        return value
    return define(symbol, value, "")
