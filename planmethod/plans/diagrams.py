"""Diagrams as constructions: calculus with a pole, energy-mass, mass moments (диаграммы)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from enum import Enum

import numpy as np
from msgspec import Struct, field

from planmethod.construct.program import Builder, Program
from planmethod.construct.steps import LineName, NumberName, PointName


class DiagramAxes(Struct, frozen=True):
    """Axes of a diagram: origin, axis of abscissae to the right, axis of ordinates up."""

    name: str
    origin: PointName
    x_axis: LineName
    y_axis: LineName


class DrawnDiagram(Struct, frozen=True):
    """Points of a diagram over its axes."""

    axes: DiagramAxes
    points: Sequence[PointName]


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


class Integration(Enum):
    """Ordinate that represents an interval (способ графического интегрирования)."""

    MIDDLE = "middle ordinates"
    TRAPEZOIDS = "trapezoids"


def differentiate(
    board: DiagramBoard,
    pairs: Sequence[tuple[PointName, PointName]],
    axes: DiagramAxes,
    at: Sequence[float],
    *,
    pole: PointName,
) -> list[PointName]:
    """Draw the derivative of a diagram, one ordinate for every chord.

    Parameters
    ----------
    pairs : sequence of (PointName, PointName)
        Ends of the chords: neighbours for the method of chords, and for the method of tangents the
        neighbours on both sides, whose chord the tangent between them is drawn parallel to.
    axes : DiagramAxes
        Of the derivative.
    at : sequence of float, mm
        Abscissa of every ordinate.
    pole : PointName
        Pole of the derivative's axes: `DiagramBoard.pole`.
    """
    b, made = board.b, []
    for k, ((tail, head), x) in enumerate(zip(pairs, at, strict=True)):
        ray = b.parallel(pole, b.join(tail, head))
        cut = b.intersect_lines(f"{axes.name} cut {k}", ray, axes.y_axis)
        line = b.parallel(cut, axes.x_axis)
        made.append(b.intersect_lines(f"{axes.name} {k}", line, board.upright(axes, x)))
    return made


def repeated(
    board: DiagramBoard, name: str, diagram_point: PointName, end: PointName, start: PointName
) -> PointName:
    """Return a point of a periodic diagram a period earlier: moved as ``end`` is to ``start``."""
    return board.b.carry(name, start, end, diagram_point)


def integrate(
    board: DiagramBoard,
    diagram: DrawnDiagram,
    axes: DiagramAxes,
    at: Sequence[float],
    *,
    pole: PointName,
    method: Integration = Integration.MIDDLE,
) -> list[PointName]:
    """Draw the integral of a diagram from its first abscissa on.

    Parameters
    ----------
    diagram : DrawnDiagram
        Its points are over the middles of the n intervals for middle ordinates, over all their
        n + 1 ends for trapezoids.
    axes : DiagramAxes
        Of the integral, which starts on its axis of abscissae.
    at : sequence of float, mm
        Abscissae of the n + 1 ends, in order.
    pole : PointName
        Pole of the diagram's axes: `DiagramBoard.pole`.

    Returns
    -------
    list of PointName
        n + 1 points of the integral; their ordinates are areas over the pole distance, mm.
    """
    b, over, curve = board.b, diagram.axes, diagram.points
    points = [board.abscissa(axes, at[0])]
    for k in range(len(at) - 1):
        if method is Integration.MIDDLE:
            mean = curve[k]
        else:
            middle = board.upright(over, (at[k] + at[k + 1]) / 2)
            mean = b.intersect_lines(
                f"{axes.name} mean {k}", b.join(curve[k], curve[k + 1]), middle
            )
        cut = b.intersect_lines(f"{axes.name} cut {k}", b.parallel(mean, over.x_axis), over.y_axis)
        chord = b.parallel(points[-1], b.join(pole, cut))
        points.append(
            b.intersect_lines(f"{axes.name} {k + 1}", chord, board.upright(axes, at[k + 1]))
        )
    return points


class EnergyMassData(Struct, frozen=True):
    """Numbers that the diagrams are drawn of.

    Attributes
    ----------
    moments, inertias : sequence of float, N·m and kg·m²
        In n + 1 even positions, the last of which is the first again. The moments of the side that
        changes, as it does its work: of resistance, or driving ones.
    middles : sequence of float, N·m
        Moments between them.
    drives : bool
        The constant moment drives, and the others resist; False: the other way round.
    integration : Integration
    pole, length : float, mm
        Pole distance, and the length of the cycle.
    mu_M, mu_T, mu_J : float
        N·m, J and kg·m² per mm.
    psi : (float, float), degrees
        Angles of the tangents, of the upper and of the lower one; not drawn by Mertsalov.
    contacts : (int, int)
        Positions in which they touch; the highest and the lowest of dT_I by Mertsalov.
    speed, delta : float, 1/s
        Mean speed and irregularity.
    second : sequence of float, J
        By Mertsalov, T_II in the same positions, above the origin of its axis; else empty.
    """

    moments: Sequence[float]
    middles: Sequence[float]
    inertias: Sequence[float]
    drives: bool
    integration: Integration
    pole: float
    length: float
    mu_M: float  # noqa: N815 - the letters of the textbook
    mu_T: float  # noqa: N815
    mu_J: float  # noqa: N815
    psi: tuple[float, float]
    contacts: tuple[int, int]
    speed: float
    delta: float
    second: Sequence[float] = ()


class Places(Struct, frozen=True):
    """Origins of the diagrams on the paper, mm."""

    moment: complex = 0j
    work: complex = 0j
    energy: complex = 0j
    inertia: complex = 0j
    mass: complex = 0j  # below the origin of the energy-mass diagram, on the level of the inertia
    second: complex = 0j  # of T_II
    first: complex = 0j  # of dT_I


class EnergyMass(Struct, frozen=True):
    """The diagrams as steps (диаграмма энергомасс).

    Attributes
    ----------
    program : Program
    data : mapping
        Of the program: points in mm, numbers in their units.
    axes : mapping of str to DiagramAxes
        ``M``, ``A``, ``T``, ``J``; ``E`` of the energy-mass diagram, or ``T_II`` and ``T_I``.
    moments, middles, work, energies, inertias, diagonal, second, curve : tuple of PointName
        Points of the diagrams; ``diagonal`` those on the line at 45 degrees, ``second`` those of
        T_II, ``curve`` the points of the energy-mass diagram or of dT_I.
    pole, upper, lower : PointName
        Pole, K and L or A and B.
    segment, J_f : NumberName
        KL or AB, mm, and kg·m².
    """

    program: Program
    data: Mapping[str, complex | float]
    axes: Mapping[str, DiagramAxes]
    moments: tuple[PointName, ...]
    middles: tuple[PointName, ...]
    work: tuple[PointName, ...]
    energies: tuple[PointName, ...]
    inertias: tuple[PointName, ...]
    diagonal: tuple[PointName, ...]
    second: tuple[PointName, ...]
    curve: tuple[PointName, ...]
    pole: PointName
    upper: PointName
    lower: PointName
    segment: NumberName
    J_f: NumberName

    @property
    def letters(self) -> tuple[str, str]:
        """Letters of the ends of the segment, the upper one first."""
        return self.segment[0], self.segment[1]


class _MethodDrawing(Struct, frozen=True):
    """Parts of the diagrams that depend on the method: the attributes of `EnergyMass`."""

    axes: Mapping[str, DiagramAxes]
    diagonal: Sequence[PointName]
    second: Sequence[PointName]
    curve: Sequence[PointName]
    upper: PointName
    lower: PointName
    segment: NumberName


def build_energy_mass(of: EnergyMassData, places: Places) -> EnergyMass:
    """Draw all diagrams of a flywheel as steps (построить диаграммы)."""
    board = DiagramBoard()
    b, count = board.b, len(of.moments) - 1
    step = of.length / count
    at = [step * k for k in range(count + 1)]
    mu_M, mu_J, mu_T = (
        board.known(name, value)
        for name, value in (("mu_M", of.mu_M), ("mu_J", of.mu_J), ("mu_T", of.mu_T))
    )

    over_M = board.axes("M", places.moment)
    moments = _plotted(board, "M", over_M, at, of.moments, mu_M)
    middles: list[PointName] = []
    curve = moments
    if of.integration is Integration.MIDDLE:
        half = [x + step / 2.0 for x in at[:-1]]
        curve = middles = _plotted(board, "M'", over_M, half, of.middles, mu_M)
    pole = board.pole(over_M, of.pole)
    over_A = board.axes("A", places.work)
    moment = DrawnDiagram(over_M, curve)
    work = integrate(board, moment, over_A, at, pole=pole, method=of.integration)
    straight = b.join(work[0], work[-1])

    over_T = board.axes("T", places.energy)
    energies = [over_T.origin]
    for k in range(1, count + 1):
        foot = board.abscissa(over_T, at[k])
        if k == count:
            energies.append(foot)
            continue
        level = b.intersect_lines(f"D {k}", straight, board.upright(over_A, at[k]))
        tail, head = (work[k], level) if of.drives else (level, work[k])
        energies.append(b.carry(f"T {k}", foot, tail, head))

    over_J = board.axes("J", places.inertia)
    inertias = _plotted(board, "J", over_J, at, of.inertias, mu_J)
    if of.second:
        found = _by_differences(board, of, places, DrawnDiagram(over_T, energies), at, mu_T)
    else:
        energy, inertia = DrawnDiagram(over_T, energies), DrawnDiagram(over_J, inertias)
        found = _by_tangents(board, of, places, energy, inertia)
    omega, delta = board.known("omega", of.speed), board.known("delta", of.delta)
    wheel = b.compute("J_f", (found.segment, 1), (mu_T, 1), (omega, -2), (delta, -1))
    return EnergyMass(
        b.program(),
        board.data,
        {"M": over_M, "A": over_A, "T": over_T, "J": over_J, **found.axes},
        tuple(moments),
        tuple(middles),
        tuple(work),
        tuple(energies),
        tuple(inertias),
        tuple(found.diagonal),
        tuple(found.second),
        tuple(found.curve),
        pole,
        found.upper,
        found.lower,
        found.segment,
        wheel,
    )


def _plotted(
    board: DiagramBoard,
    letter: str,
    axes: DiagramAxes,
    xs: Sequence[float],
    values: Sequence[float],
    mu: NumberName,
) -> list[PointName]:
    points = []
    for k, (x, value) in enumerate(zip(xs, values, strict=True)):
        size = board.b.compute(f"y {letter}{k}", (board.known(f"{letter}{k}", value), 1), (mu, -1))
        points.append(board.plot(f"{letter} {k}", axes, x, size))
    return points


def _by_tangents(
    board: DiagramBoard,
    of: EnergyMassData,
    places: Places,
    energy: DrawnDiagram,
    inertia: DrawnDiagram,
) -> _MethodDrawing:
    """Draw the energy-mass diagram and its tangents (Wittenbauer)."""
    b = board.b
    axes_E = board.axes("E", complex(places.mass.real, places.energy.imag))
    corner = board.take_point("45", places.mass)
    diagonal = b.at_angle(corner, None, board.known("45 deg", 45.0))
    turned, mass = [], []
    for k in range(len(energy.points) - 1):
        across = b.parallel(inertia.points[k], inertia.axes.x_axis)
        spot = b.intersect_lines(f"45 {k}", across, diagonal)
        turned.append(spot)
        upright = b.parallel(spot, axes_E.y_axis)
        level_line = b.parallel(energy.points[k], energy.axes.x_axis)
        mass.append(b.intersect_lines(f"E {k}", level_line, upright))

    ends = []
    for letter, name, psi, k in zip("KL", ("max", "min"), of.psi, of.contacts, strict=True):
        tangent = b.at_angle(mass[k], axes_E.x_axis, board.known(f"psi_{name}", psi))
        ends.append(b.intersect_lines(letter, tangent, axes_E.y_axis))
    kl = b.measure_along("KL", ends[1], ends[0], axes_E.y_axis)
    return _MethodDrawing({"E": axes_E}, turned, (), mass, ends[0], ends[1], kl)


def _by_differences(
    board: DiagramBoard,
    of: EnergyMassData,
    places: Places,
    energy: DrawnDiagram,
    at: Sequence[float],
    mu_T: NumberName,
) -> _MethodDrawing:
    """Draw T_II and the rest of dT (Mertsalov)."""
    b = board.b
    over_II, over_I = board.axes("T_II", places.second), board.axes("T_I", places.first)
    second = _plotted(board, "T_II", over_II, at, of.second, mu_T)
    rest = []
    for k, x in enumerate(at):
        spot = board.abscissa(over_I, x)
        if 0 < k < len(at) - 1:  # at its ends dT is zero
            spot = b.carry(
                f"T_I + T_II {k}", spot, board.abscissa(energy.axes, x), energy.points[k]
            )
        rest.append(b.carry(f"T_I {k}", spot, second[k], board.abscissa(over_II, x)))
    highest, lowest = (rest[k] for k in of.contacts)
    ab = b.measure_along("AB", lowest, highest, over_I.y_axis)
    return _MethodDrawing({"T_II": over_II, "T_I": over_I}, (), second, rest, highest, lowest, ab)


class MassMoments(Struct, frozen=True):
    """The polygon as steps.

    Attributes
    ----------
    program, data : Program and mapping
    corners : tuple of PointName
        From the first corner on; the counterweight's vector goes from the last to the first.
    moment, mass : NumberName
        m·r of the counterweight, kg·m, and its mass, kg.
    """

    program: Program
    data: Mapping[str, complex | float]
    corners: tuple[PointName, ...]
    moment: NumberName
    mass: NumberName


def build_mass_moments(vectors: Sequence[complex], per_mm: float, radius: float) -> MassMoments:
    """Draw the polygon (построить многоугольник).

    Parameters
    ----------
    vectors : sequence of complex, kg·m
        From the line of the link, which is horizontal on the paper.
    per_mm : float, kg·m/mm
    radius : float, m
        Position of the counterweight.
    """
    board = DiagramBoard()
    b, mu = board.b, board.known("mu", per_mm)
    corners = [board.take_point("P", 0j)]
    for k, vector in enumerate(vectors, 1):
        size = b.compute(f"y {k}", (board.known(f"mr {k}", abs(vector)), 1), (mu, -1))
        angle = board.known(f"angle {k}", float(np.degrees(np.angle(vector))))
        corners.append(
            b.lay_off_length(f"P{k}", corners[-1], b.at_angle(corners[-1], None, angle), size)
        )
    closing = b.measure("closing", corners[-1], corners[0])
    moment = b.compute("mr", (closing, 1), (mu, 1))
    mass = b.compute("m", (moment, 1), (board.known("r", radius), -1))
    return MassMoments(b.program(), board.data, tuple(corners), moment, mass)
