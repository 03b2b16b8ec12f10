"""Diagrams being planned: axes on the paper, points over abscissae (оси диаграмм)."""

from __future__ import annotations

from msgspec import Struct, field

from planmethod.construct.program import Builder
from planmethod.construct.steps import LineName, NumberName, PointName


class DiagramAxes(Struct, frozen=True):
    """Axes of a diagram: origin, axis of abscissae to the right, axis of ordinates up."""

    name: str
    origin: PointName
    x_axis: LineName
    y_axis: LineName


class DiagramBoard(Struct):
    """Steps of diagrams with their data (планшет диаграмм).

    Attributes
    ----------
    data : dict
        Values of the given points (complex, mm) and known numbers.
    """

    b: Builder = field(default_factory=Builder)
    data: dict[str, complex | float] = field(default_factory=dict)
    _feet: dict[tuple[str, float], PointName] = field(default_factory=dict)

    def known(self, name: str, value: float) -> NumberName:
        """Take a number of the data as known, once."""
        if name not in self.data:
            self.data[name] = value
            self.b.known(name)
        return NumberName(name)

    def take_point(self, name: str, place: complex) -> PointName:
        """Take a point of the paper as given, mm."""
        self.data[name] = place
        return self.b.take_point(name)

    def axes(self, name: str, origin: complex = 0j) -> DiagramAxes:
        """Draw the axes of a diagram; the names of all its steps begin with ``name``."""
        start = self.take_point(f"{name} O", origin)
        across = self.b.at_angle(start, None, self.known("0", 0.0))
        return DiagramAxes(name, start, across, self.b.perpendicular(start, across))

    def abscissa(self, axes: DiagramAxes, x: float) -> PointName:
        """Lay an abscissa off, mm; return the origin for zero."""
        if x == 0:
            return axes.origin
        if (axes.name, x) not in self._feet:
            length = self.known(f"x = {x:.12g}", x)
            foot = self.b.lay_off_length(
                f"{axes.name} x = {x:.12g}", axes.origin, axes.x_axis, length
            )
            self._feet[axes.name, x] = foot
        return self._feet[axes.name, x]

    def upright(self, axes: DiagramAxes, x: float) -> LineName:
        """Draw the upright over an abscissa, mm."""
        return self.b.perpendicular(self.abscissa(axes, x), axes.x_axis)

    def plot(self, name: str, axes: DiagramAxes, x: float, y: NumberName) -> PointName:
        """Lay an ordinate off, mm."""
        return self.b.lay_off_length(name, self.abscissa(axes, x), self.upright(axes, x), y)

    def pole(self, axes: DiagramAxes, distance: float) -> PointName:
        """Lay the pole off to the left of the origin (полюсное расстояние), mm."""
        length = self.known(f"-K = {-distance:.12g}", -distance)
        return self.b.lay_off_length(f"{axes.name} P", axes.origin, axes.x_axis, length)
