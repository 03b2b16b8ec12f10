"""Drawing board of a synthesis: constructions that textbooks draw as one (чертёжная доска).

The verbs are those of `Builder`; what they mean to a reader and what of them is shown is kept
beside the steps. Lengths are given in metres and laid off at the scale ``mu_l``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from typing import TypeAlias

from planmethod.construct.program import Builder
from planmethod.construct.steps import LineName, Name, NumberName, PointName, Side, Way
from planmethod.record import dataclass

Said: TypeAlias = tuple[str, Mapping[str, str | float]]
"""Name of a sentence in `SynthesisWording.steps`, and its places: points by name, and numbers."""

MU = NumberName("mu_l")
"""The scale, m per mm."""


@dataclass(slots=True)
class Board(Builder):
    """Steps of a synthesis with their data (построение).

    Attributes
    ----------
    data : dict
        Given points (m) and numbers (m, degrees) by their names; without the scale.
    said : dict
        What is told instead of a step's own sentence; None of what another sentence tells.
    circles : list of tuple of PointName
        Centres of circles that are shown, and points on each: of several the arc over them.
    """

    data: dict[str, complex | float] = field(default_factory=dict)
    said: dict[Name, Said | None] = field(default_factory=dict)
    circles: list[tuple[PointName, ...]] = field(default_factory=list)

    def fixed(self, name: str, place: complex) -> PointName:
        """Mark a given point, m."""
        self.data[name] = place
        return self.given(name)

    def _scale(self) -> NumberName:
        if not any(step.out == MU for step in self.steps):
            self.known(MU)
        return MU

    def length(self, name: str, metres: float) -> NumberName:
        """Take a length as given, m, and return it as it is laid off, mm."""
        self._scale()
        self.data[f"l {name}"] = metres
        return self.compute(name, (self.known(f"l {name}"), 1), (MU, -1))

    def angle(self, name: str, degrees: float) -> NumberName:
        """Take an angle as given, degrees."""
        if name not in self.data:
            self.data[name] = degrees
            self.known(name)
        return NumberName(name)

    def ray(self, through: PointName, to: LineName | None, degrees: float) -> LineName:
        """Draw a line at an angle, degrees from ``to`` or +x."""
        return self.at_angle(through, to, self.angle(f"{degrees!r} deg", degrees))

    def found(
        self, name: str, *read: NumberName, factor: float = 1.0, size: bool = True
    ) -> NumberName:
        """Compute a length of the mechanism from what was read: the sum of it times a factor, m."""
        whole = read[0] if len(read) == 1 else self.total(f"sum {name}", *read)
        return self.compute(f"l {name}", (whole, 1), (self._scale(), 1), factor=factor, size=size)

    def half_sum(self, one: NumberName, other: NumberName, names: tuple[str, str]) -> NumberName:
        """Compute half the sum and half the difference of two readings; return the latter, mm.

        ``names`` are those of the lengths of the mechanism that they are.
        """
        minus = self.compute(f"minus {other}", (other, 1), factor=-1.0)
        self.found(names[0], one, other, factor=0.5)
        less = self.total(f"less {names[1]}", one, minus)
        half = self.compute(f"half {names[1]}", (less, 1), factor=0.5)
        self.found(names[1], half)
        return half

    def bisector(self, tail: PointName, head: PointName) -> LineName:
        """Draw the perpendicular bisector of a segment with two pairs of arcs."""
        span = self.measure(f"{tail} {head}", tail, head)
        marks = [
            self.meet_circles(f"mark {tail} {head} {side.value}", tail, span, head, span, side)
            for side in (Side.RIGHT, Side.LEFT)
        ]
        line = self.join(*marks)
        self.said |= dict.fromkeys((span, *marks))
        self.said[line] = ("bisector", {"tail": tail, "head": head})
        return line

    def inscribed(self, centre: str, chord: tuple[PointName, PointName], angle: float,
                  side: Side) -> tuple[PointName, NumberName]:  # fmt: skip
        """Draw the circle on which a chord is seen at an angle from one side of it.

        Parameters
        ----------
        chord : (PointName, PointName)
        angle : float, degrees
            Between 0 and 180.
        side : Side
            Of the directed chord, on which the points lie from which it is seen so.

        Returns
        -------
        PointName, NumberName
            Its centre and radius, mm.
        """
        tail, head = chord
        ray = self.ray(tail, self.join(tail, head), side.value * (90.0 - angle))
        at = self.meet_lines(centre, ray, self.bisector(tail, head))
        radius = self.measure(f"{centre} {tail}", at, tail)
        self.circles.append((at, tail, head, PointName("O")))
        self.said |= {radius: None, ray: None}
        ends = {"tail": tail, "head": head, "centre": centre}
        self.said[at] = ("inscribed", {**ends, "angle": angle, "rest": abs(90.0 - angle)})
        return at, radius

    def second_meeting(
        self, out: str, point: PointName, line: LineName, centre: PointName
    ) -> PointName:
        """Find where a line through a point of a circle meets it again: nothing is read for it."""
        foot = self.meet_lines(f"mark {out}", line, self.perpendicular(centre, line))
        self.said[foot] = None
        return self.carry(out, foot, point, foot)

    def circle_through(
        self, centre: str, points: tuple[PointName, PointName, PointName]
    ) -> PointName:
        """Find the centre of the circle through three points."""
        one, two, three = points
        at = self.meet_lines(centre, self.bisector(one, two), self.bisector(two, three))
        self.circles.append((at, *points))
        self.said[at] = ("centre", {"centre": centre, "points": ", ".join(points)})
        return at

    def opposite(
        self, out: str, pivot: PointName, pin: PointName, arm: NumberName, way: Way
    ) -> PointName:
        """Mark the end of a crank that is in one line with a coupler: towards its pin, or away."""
        return self.meet_line_circle(out, self.join(pivot, pin), pivot, arm, way)
