"""Speeds of a train by velocities of its points and instant centres (мгновенные центры, К10).

Two known points of a body give its speed, which gives its other points; where its velocity is zero
is its instant centre.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations, permutations
from math import pi

from msgspec import Struct

from planmethod.errors import PlanMethodError
from planmethod.gears.derivation import DerivationLine
from planmethod.gears.motion import ContactKind, TrainMotion, carrier_of, draw
from planmethod.note.formula import Rich, fraction
from planmethod.note.numbers import MINUS, raised
from planmethod.note.wording import Language, MessageTable

POINTS = "ABCDEFGKLMNPQRSTUVW"
"""Letters of the pitch points, in the order of the meshes, as the scheme has them."""


class _Point(Struct, frozen=True):
    """A point of contact or of an axis: its letter, height in m, and links with its velocity."""

    letter: Rich
    height: Fraction
    links: tuple[str, ...]


def by_velocities(motion: TrainMotion, language: Language) -> list[DerivationLine]:
    """Return the method step by step; none without radii or a module, or without a diagram.

    Speeds in rev/min become angular velocities first.

    Raises
    ------
    PlanMethodError
        A speed differs from the one that the mesh equations give: an internal error.
    """
    train, picture = motion.train, draw(motion)
    has_sizes = not train.toothed or train.module is not None
    if not has_sizes or picture is None:
        return []
    points, letters = [], iter(POINTS)
    ends = {mesh.name: train.ends(mesh) for mesh in train.meshes}
    for contact in picture.contacts:
        height = contact.height_mm * picture.mu_l
        if contact.at.kind is ContactKind.PITCH:
            points.append(_Point(next(letters), height, ends[contact.at.of]))
        elif (carrier := carrier_of(motion, contact.at.of)) is not None:
            name = f"O_{{{contact.at.of}}}"
            points.append(_Point(name, height, (contact.at.of, carrier)))
    velocities = _Velocities(motion, points, language)
    lines = list(velocities.steps())
    if lines:
        lines = [*velocities.given_lines(), *lines]
    return (
        [DerivationLine(language.gears["derived"]["by_velocities"], False), *lines] if lines else []
    )


class _Velocities:
    """Goes from body to body: two known points give its speed, which gives its other points."""

    def __init__(self, motion: TrainMotion, points: list[_Point], language: Language) -> None:
        self.motion, self.points, self.language = motion, points, language
        self.texts: MessageTable = language.gears["derived"]
        self.speeds = dict(motion.train.inputs) | dict.fromkeys(motion.train.fixed, Fraction(0))
        self.given = frozenset(self.speeds)
        self.velocities: dict[Rich, Fraction] = {}
        # Exact numbers are of speeds as given; those that are printed are of 1/s.
        self.per_s = 1.0 if motion.train.unit == "omega" else pi / 30
        around = {b for some in motion.roles.planets.values() for b in some}
        heights = motion.axes.heights
        self.axes = {
            body: heights[body] * motion.train.unit_m
            for body in motion.train.bodies
            if body in heights and body not in around
        }

    def steps(self) -> Iterator[DerivationLine]:
        """Yield the steps, until none follows."""
        while lines := next(filter(None, map(list, self._possible())), None):
            yield from lines

    def given_lines(self) -> Iterator[DerivationLine]:
        """Yield the radii by the module, and the given speeds in 1/s."""
        train = self.motion.train
        if train.toothed and train.module is not None:
            half = fraction("m·z_{i}", "2")
            yield DerivationLine(f"r_{{i}} = {half}, m = {self._sized(train.module)}")
        if train.unit == "omega":
            return
        unit = raised(self.language.gears["units"]["1/s"])
        for body, speed in train.inputs.items():
            size = self.language.notation.short(float(abs(speed)), 6)
            turns = f"n_{{{body}}}" if speed >= 0 else f"|n_{{{body}}}|"
            sides = [fraction(f"π·{turns}", "30"), fraction(f"π·{size}", "30")]
            yield DerivationLine(f"ω_{{{body}}} = {' = '.join(sides)} = {self._rate(speed)} {unit}")

    def _possible(self) -> Iterator[Iterator[DerivationLine]]:
        """Yield the next step in every way; a way that is not there has no lines."""
        for point in self.points:
            for body in point.links if point.letter not in self.velocities else ():
                if body in self.speeds:
                    yield self._velocity(point, body)
        for body in self.motion.train.bodies:
            if body not in self.speeds:
                yield self._speed(body)

    def _velocity(self, point: _Point, body: str) -> Iterator[DerivationLine]:
        """Derive the velocity of a point of a body whose speed is known."""
        speed, symbol = self.speeds[body], f"v_{{{point.letter}}}"
        omega, size = f"ω_{{{body}}}", self._rate(speed)
        if body in self.axes:
            arm = point.height - self.axes[body]
            value = -speed * arm
            sides = [f"{omega}·{self._arm(point, body)}", f"{size}·{self._length(arm)}"]
        else:
            known = next((p for p in self._of(body) if p.letter in self.velocities), None)
            if known is None:
                return
            arm, first = point.height - known.height, self.velocities[known.letter]
            turn = -speed * arm
            value = first + turn
            parts = (f"v_{{{known.letter}}}", f"{omega}·{known.letter}{point.letter}")
            numbers = (self._velocity_size(first), f"{size}·{self._length(arm)}")
            is_less = first * turn < 0
            order = -1 if is_less and abs(turn) > abs(first) else 1
            sign = MINUS if is_less else "+"
            sides = [f" {sign} ".join(both[::order]) for both in (parts, numbers)]
        yield DerivationLine(f"{symbol} = {' = '.join(sides)} = {self._metres(value)}")
        yield from self._midway(point, body, value)
        self.velocities[point.letter] = value

    def _midway(self, point: _Point, body: str, value: Fraction) -> Iterator[DerivationLine]:
        """Yield the velocity of a point halfway between two known ones, from theirs."""
        known = [p for p in self._of(body) if p.letter in self.velocities]
        known.sort(key=lambda p: -abs(self.velocities[p.letter]))
        for one, two in combinations(known, 2):
            if one.height + two.height == 2 * point.height:
                v, w = self.velocities[one.letter], self.velocities[two.letter]
                sign = "+" if v * w > 0 else MINUS
                halves = [
                    fraction(f"v_{{{one.letter}}} {sign} v_{{{two.letter}}}", "2"),
                    fraction(f"{self._velocity_size(v)} {sign} {self._velocity_size(w)}", "2"),
                ]
                line = f"v_{{{point.letter}}} = {' = '.join(halves)} = {self._metres(value)}"
                ends = {"point": point.letter, "ends": f"{one.letter}{two.letter}"}
                yield DerivationLine(self.texts.midway.format(formula=line, **ends))
                return

    def _speed(self, body: str) -> Iterator[DerivationLine]:
        """Derive the speed of a body from two known points, one of them its fixed axis."""
        known = [p for p in self._of(body) if p.letter in self.velocities]
        if body in self.axes and known:
            point = known[0]
            arm, value = point.height - self.axes[body], self.velocities[point.letter]
            sides = [fraction(f"v_{{{point.letter}}}", self._arm(point, body)),
                     fraction(self._velocity_size(value), self._length(arm))]  # fmt: skip
            speed = -value / arm
        elif body not in self.axes and len(known) > 1:
            one, two = next(
                ((a, b) for a, b in permutations(known, 2)
                 if abs(self.velocities[a.letter]) >= abs(self.velocities[b.letter])),
            )  # fmt: skip
            v, w = self.velocities[one.letter], self.velocities[two.letter]
            sign, apart = "+" if v * w < 0 else MINUS, one.height - two.height
            above = f"v_{{{one.letter}}} {sign} v_{{{two.letter}}}"
            numbers = f"{self._velocity_size(v)} {sign} {self._velocity_size(w)}"
            sides = [fraction(above, one.letter + two.letter),
                     fraction(numbers, self._length(apart))]  # fmt: skip
            speed = (w - v) / apart
        else:
            return
        if speed != self.motion.speeds[body]:
            raise PlanMethodError(
                "the velocities give {} the speed {}, the mesh equations {}; please report the "
                "problem file",
                body,
                speed,
                self.motion.speeds[body],
            )
        self.speeds[body] = speed
        unit = raised(self.language.gears["units"]["1/s"])
        sense = self.language.note.ccw if speed > 0 else self.language.note.cw
        text = f", {sense}" if speed else ""
        yield DerivationLine(
            f"ω_{{{body}}} = {' = '.join(sides)} = {self._rate(speed)} {unit}{text}"
        )
        if body not in self.axes and speed:
            place = f"{one.letter}P_{{{body}}}"
            ratio = fraction(f"v_{{{one.letter}}}", f"ω_{{{body}}}")
            formula = f"{place} = {ratio} = {self._sized(v / speed)}"
            at = {"body": body, "line": one.letter + two.letter, "formula": formula}
            yield DerivationLine(self.texts.instant_centre.format(**at))

    def _of(self, body: str) -> list[_Point]:
        return [point for point in self.points if body in point.links]

    def _arm(self, point: _Point, body: str) -> Rich:
        """Return the letters of an arm: the radius of the wheel in mesh there, or the points."""
        train, arm = self.motion.train, abs(point.height - self.axes[body])
        for label, size in self.motion.axes.radii.items():
            if train.body_of[label] == body and size * train.unit_m == arm:
                return f"r_{{{label}}}"
        for label, radius in train.arms.items():
            if train.body_of[label] == body and radius == arm:
                return f"r_{{{label}}}"
        return (
            f"OO_{{{point.letter[3:-1]}}}" if point.letter.startswith("O") else f"O{point.letter}"
        )

    def _number(self, value: Fraction | float) -> Rich:
        shown: Rich = self.language.notation.short(float(value), 6)
        return shown

    def _rate(self, speed: Fraction) -> Rich:
        """Return the size of an angular velocity, 1/s."""
        return self._number(abs(speed) if self.per_s == 1.0 else abs(speed) * self.per_s)

    def _velocity_size(self, value: Fraction) -> Rich:
        """Return the size of a velocity, in the unit of length of the file per second."""
        size = abs(value) * self.motion.train.per_m
        return self._number(size if self.per_s == 1.0 else size * self.per_s)

    def _length(self, value: Fraction) -> Rich:
        """Return the size of a length, in the unit of length of the file."""
        return self._number(abs(value) * self.motion.train.per_m)

    def _sized(self, value: Fraction) -> Rich:
        """Return the size of a length with its unit."""
        unit = self.language.gears["units"][self.motion.train.length_unit]
        return f"{self._length(value)} {unit}"

    def _metres(self, value: Fraction) -> Rich:
        """Return a velocity with its unit and direction; of metres also in centimetres."""
        units, unit = self.language.gears["units"], self.motion.train.length_unit
        text = f"{self._velocity_size(value)} {units[f'{unit}/s']}"
        if unit == "m":
            text += f" ({self._number(float(abs(value)) * 100 * self.per_s)} {units['cm/s']})"
        return text + (f", {self.texts.right if value > 0 else self.texts.left}" if value else "")
