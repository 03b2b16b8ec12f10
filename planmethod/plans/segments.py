"""Segments of a plan: the length and value of each, and the steps that give them (отрезки плана).

A segment has one length for all users: the laid-off length, else the ruler's reading. So a laid-off
segment is never read, and no segment is read twice.
"""

from __future__ import annotations

from typing import TypeAlias

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.construct.program import Builder
from planmethod.construct.steps import LineName, NumberName, PointName

Ends: TypeAlias = tuple[PointName, PointName]


class Segments(Struct):
    """Segments of one plan, or of plans with one scale.

    Attributes
    ----------
    b : Builder
    scale : NumberName
        Scale of the plan.
    prefix : str
        Beginning of the names of its values.
    lengths : dict of (PointName, PointName) to NumberName
        Length of a segment, mm.
    values : dict of (PointName, PointName) to NumberName
        Value of a segment, in the unit of the plan: computed before it was laid off, or from its
        length. Lengths and values are signed if a segment lies on a line along which the sign is
        needed.
    """

    b: Builder
    scale: NumberName
    prefix: str = ""
    lengths: dict[Ends, NumberName] = field(default_factory=dict)
    values: dict[Ends, NumberName] = field(default_factory=dict)
    _measured: set[NumberName] = field(default_factory=set)

    def on(self, b: Builder) -> Segments:
        """Return the same segments for a construction that continues from here."""
        return replace(
            self,
            b=b,
            lengths=dict(self.lengths),
            values=dict(self.values),
            _measured=set(self._measured),
        )

    def compute(
        self, name: str, *powers: tuple[NumberName, int], factor: float = 1.0, size: bool = False
    ) -> NumberName:
        """Compute a number under an unused name."""
        name = self.prefix + name
        while self.b.has(name):
            name += "*"
        return self.b.compute(name, *powers, factor=factor, size=size)

    def length(self, tail: PointName, head: PointName) -> NumberName:
        """Return the length of a segment, mm; it is measured if it is not known yet."""
        if (tail, head) in self.lengths or (head, tail) in self.lengths:
            return self.drawn((tail, head))
        name = self.b.measure(f"|{tail}–{head}|", tail, head)
        self.lengths[tail, head] = name
        self._measured.add(name)
        return name

    def value(self, tail: PointName, head: PointName, name: str) -> NumberName:
        """Return the value of a segment; ``name`` is used if the value is new."""
        if (tail, head) in self.values or (head, tail) in self.values:
            return self.known((tail, head))
        length = self.length(tail, head)
        self.values[tail, head] = self.compute(name, (self.scale, 1), (length, 1))
        return self.values[tail, head]

    def read(self, ends: Ends) -> NumberName | None:
        """Return the ruler's reading of a segment, mm; None if it was laid off."""
        length = self.length(*ends)
        return length if length in self._measured else None

    def drawn(self, ends: Ends) -> NumberName:
        """Return the length of a segment that has been drawn and read, mm."""
        return self.lengths[ends] if ends in self.lengths else self.lengths[ends[::-1]]

    def known(self, ends: Ends) -> NumberName:
        """Return the value of a segment that has been drawn and read."""
        return self.values[ends] if ends in self.values else self.values[ends[::-1]]

    def read_signed(
        self, tail: PointName, head: PointName, line: LineName, name: str
    ) -> NumberName:
        """Read a segment along its line, with a sign, and return its value."""
        length = self.b.measure_along(f"|{tail}–{head}|{line}", tail, head, line)
        value = self.compute(name, (self.scale, 1), (length, 1))
        self.lengths[tail, head], self.values[tail, head] = length, value
        self._measured.add(length)
        return value

    def lay_off_vector(
        self, out: str, start: PointName, line: LineName, value: NumberName
    ) -> PointName:
        """Lay off a vector of a computed size along a line."""
        length = self.b.compute(f"|{out}|", (value, 1), (self.scale, -1))
        end = self.b.lay_off_length(out, start, line, length)
        self.lengths[start, end], self.values[start, end] = length, value
        return end

    def same(self, tail: PointName, head: PointName, of: Ends) -> None:
        """Note that a segment is another one, carried to its place."""
        self.lengths[tail, head] = self.drawn(of)
        self.values[tail, head] = self.known(of)
