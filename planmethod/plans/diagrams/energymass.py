"""The flywheel by diagrams: moment, work, energy, reduced inertia, energy-mass (энергомасса).

The work is integrated graphically from the moments; the difference between it and the straight line
of the constant moment's work is carried to the diagram of energies. Ordinates of the inertia are
projected on a line at 45 degrees and so turned by 90: uprights from there meet the lines of the
energies in the points of the energy-mass diagram. Two tangents to it, at psi_max and psi_min, cut
off KL on the axis of energies: J_f = mu_T·KL/(omega²·delta).

Mertsalov's method draws no energy-mass diagram. The energy T_II = omega²·J/2 of all links at the
mean speed is plotted at the scale of the energies and taken from dT, position by position: the
rest, dT_I, is the flywheel's. AB, from its lowest point to its highest, replaces KL.

Source: курсовое проектирование по ТММ, section 3 of the press coursework; Wittenbauer's method.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from msgspec import Struct

from planmethod.construct.program import Program
from planmethod.construct.steps import NumberName, PointName
from planmethod.plans.diagrams.board import DiagramAxes, DiagramBoard
from planmethod.plans.diagrams.calculus import Integration, integrate


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


def build(of: EnergyMassData, places: Places) -> EnergyMass:
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
    work = integrate(board, curve, over_M, over_A, at, pole=pole, method=of.integration)
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
        found = _by_differences(board, of, places, over_T, at, energies, mu_T)
    else:
        found = _by_tangents(board, of, places, over_T, over_J, energies, inertias)
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
    over_T: DiagramAxes,
    over_J: DiagramAxes,
    energies: Sequence[PointName],
    inertias: Sequence[PointName],
) -> _MethodDrawing:
    """Draw the energy-mass diagram and its tangents (Wittenbauer)."""
    b = board.b
    axes_E = board.axes("E", complex(places.mass.real, places.energy.imag))
    corner = board.take_point("45", places.mass)
    diagonal = b.at_angle(corner, None, board.known("45 deg", 45.0))
    turned, mass = [], []
    for k in range(len(energies) - 1):
        spot = b.intersect_lines(f"45 {k}", b.parallel(inertias[k], over_J.x_axis), diagonal)
        turned.append(spot)
        upright = b.parallel(spot, axes_E.y_axis)
        level_line = b.parallel(energies[k], over_T.x_axis)
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
    over_T: DiagramAxes,
    at: Sequence[float],
    energies: Sequence[PointName],
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
            spot = b.carry(f"T_I + T_II {k}", spot, board.abscissa(over_T, x), energies[k])
        rest.append(b.carry(f"T_I {k}", spot, second[k], board.abscissa(over_II, x)))
    highest, lowest = (rest[k] for k in of.contacts)
    ab = b.measure_along("AB", lowest, highest, over_I.y_axis)
    return _MethodDrawing({"T_II": over_II, "T_I": over_I}, (), second, rest, highest, lowest, ab)
