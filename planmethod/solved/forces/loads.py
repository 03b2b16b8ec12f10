"""Given and inertia forces on the links in every position, and their single resultants."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Mapping
from enum import Enum
from typing import Protocol

import numpy as np
import numpy.typing as npt
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.arithmetic import Number
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.plans.build import Construction
from planmethod.plans.forces.polygons import Applied, LoadKind
from planmethod.problem.model import Problem
from planmethod.problem.placement import rotation
from planmethod.problem.records import (
    Against,
    Couple,
    Dynamics,
    Fixed,
    Interpolation,
    Load,
    Mass,
    MovingSense,
    Over,
    Phase,
    SizeTable,
    TurningSense,
)
from planmethod.solved.curves import roots
from planmethod.solved.cycle_motion import CycleMotion, MotionState
from planmethod.solved.reading import Complexes, Memoizing, Reals
from planmethod.solved.solution import LinkMotion, PointMotion, Solution

ZERO_SPEED_FRACTION = 1e-10
"""Fraction of a position's largest speed below which a point or a link is at rest."""

ABSCISSA_TOLERANCE = 1e-9
"""Rounding of an abscissa, degrees, or as a share of a table's span."""

TURN = 360.0

MOTION_DIRECTIONS = {
    MovingSense.UP: 1j,
    MovingSense.DOWN: -1j,
    MovingSense.LEFT: -1 + 0j,
    MovingSense.RIGHT: 1 + 0j,
}
"""Unit vector of each sense of a point's motion."""

_LOOKS = 720  # positions between which a load may begin and end

Span = tuple[float, float]

Mask = npt.NDArray[np.bool_]


class MotionValues(Protocol):
    """Motion data that loads need; a `Solution` has them.

    ``positions`` is of shape (n,), as are the arrays of ``points`` and ``links``.
    """

    @property
    def problem(self) -> Problem:
        """The problem."""

    @property
    def positions(self) -> Reals:
        """Positions of the driver, degrees or m."""

    @property
    def construction(self) -> Construction:
        """Construction of the mechanism, which shows the links that can move."""

    @property
    def points(self) -> Mapping[str, PointMotion]:
        """Motion of every named point."""

    @property
    def links(self) -> Mapping[str, LinkMotion]:
        """Motion of every moving link."""


def applied(solution: MotionValues) -> tuple[Applied, ...]:
    """Return the loads on the links, without the reactions, link by link.

    A link has its weight, the main vector of its inertia forces Φ = -m·a_S (главный вектор сил
    инерции), their main moment M_Φ = -J·ε (главный момент), then its external loads in file order.
    Loads that are zero by nature are left out: inertia of what cannot accelerate, loads of size
    zero.

    Raises
    ------
    ProblemError
        A load is known only in the file's positions, and others are requested.
    """
    dynamics = solution.problem.dynamics
    if dynamics is None:
        return ()
    found: list[Applied] = []
    for link in solution.problem.mechanism.links:
        mass = dynamics.masses.get(link)
        if mass is not None:
            found += _of_mass(solution, dynamics.gravity, link, mass)
        found += external(solution, dynamics, link)
    return tuple(found)


def changing(solution: MotionValues) -> dict[str, Applied]:
    """Return the external loads that differ from position to position, by name.

    Raises
    ------
    ProblemError
        As of `applied`.
    """
    dynamics = solution.problem.dynamics
    assert dynamics is not None, "changing loads need [dynamics]"
    links = solution.problem.mechanism.links
    found = (one for link in links for one in external(solution, dynamics, link))
    return {one.name: one for one in found if one.steady is None}


def only_in_positions(dynamics: Dynamics) -> bool:
    """Return whether a load is known only in the file's positions."""
    tables = (load.size for load in dynamics.loads if isinstance(load.size, SizeTable))
    return any(table.over is Over.POSITION for table in tables)


def needs_motion(load: Load | Couple) -> bool:
    """Return whether a load depends on the motion, not on the driver's position alone."""
    phase = load.phase
    if isinstance(load.sense, Against):
        return True
    if phase is not None and (phase.moving is not None or phase.turning is not None):
        return True
    of_point = (Over.X, Over.Y, Over.PATH, Over.STROKES)
    return isinstance(load.size, SizeTable) and load.size.over in of_point


def _force(
    solution: MotionValues, name: str, link: str, point: str, force: Number, kind: LoadKind
) -> Applied:
    shape = solution.positions.shape
    whole = np.array(np.broadcast_to(force, shape), dtype=complex)
    return Applied(name, link, point, whole, np.zeros(shape), kind, _steady(force))


def _couple(
    solution: MotionValues, name: str, link: str, couple: Number, kind: LoadKind
) -> Applied:
    shape = solution.positions.shape
    whole = np.array(np.broadcast_to(couple, shape), dtype=float)
    return Applied(name, link, None, np.zeros(shape, dtype=complex), whole, kind, _steady(couple))


def _steady(value: Number) -> complex | None:
    return complex(value) if np.ndim(value) == 0 else None


# Weight and inertia ------------------------------------------------------------------------------


def _of_mass(solution: MotionValues, gravity: float, link: str, mass: Mass) -> Iterator[Applied]:
    centre = mass.centre
    if mass.mass and gravity and centre is not None:
        weight = complex(0.0, -mass.mass * gravity)
        yield _force(solution, f"G_{{{link}}}", link, centre, weight, LoadKind.WEIGHT)
    if mass.mass and centre is not None and _may_accelerate(solution, link, centre):
        inertia = -mass.mass * solution.points[centre].acceleration
        yield _force(solution, f"Φ_{{{link}}}", link, centre, inertia, LoadKind.INERTIA)
    if mass.inertia and _may_turn_unevenly(solution, link):
        couple = -mass.inertia * solution.links[link].epsilon
        yield _couple(solution, f"M_{{Φ{link}}}", link, couple, LoadKind.INERTIA_COUPLE)


def _is_at_rest(solution: MotionValues) -> bool:
    """Return whether the driver, and all links with it, are at rest."""
    drive = solution.problem.drive
    return drive.rate == 0 and not drive.accelerates


def _may_accelerate(solution: MotionValues, link: str, point: str) -> bool:
    drive, plan = solution.problem.drive, solution.construction.kinematics.acceleration
    even = link == drive.link and not drive.is_crank and not drive.accelerates
    return not even and not _is_at_rest(solution) and plan.point[link, point] != plan.pole


def _may_turn_unevenly(solution: MotionValues, link: str) -> bool:
    return not _is_at_rest(solution) and link in solution.construction.kinematics.epsilon


# External loads ----------------------------------------------------------------------------------


def external(solution: MotionValues, dynamics: Dynamics, link: str) -> Iterator[Applied]:
    """Yield the external loads of a link, in file order; none that is zero by nature."""
    for index, load in enumerate(dynamics.loads):
        if load.link != link or _is_zero(solution, load):
            continue
        size = _size(solution, load, index)
        if load.phase is not None:
            size = np.where(_acts(solution, load, load.phase), size, 0.0)
        if isinstance(load, Load):
            force = size * _direction(solution, load)
            yield _force(solution, load.name, link, load.at, force, LoadKind.EXTERNAL)
        else:
            if load.sense is not None:
                size = -size * _turning(solution, link)
            yield _couple(solution, load.name, link, size, LoadKind.EXTERNAL)


def _is_zero(solution: MotionValues, load: Load | Couple) -> bool:
    """Return whether a load is zero by nature: of size zero, or against an immovable point."""
    if load.size == 0:
        return True
    if not isinstance(load.sense, Against):
        return False
    turns = isinstance(load, Load) or load.link in solution.construction.kinematics.omega
    return _is_at_rest(solution) or not turns


def _direction(solution: MotionValues, load: Load) -> Complexes | complex:
    """Return the unit vector of a force; zero if it resists a point at rest."""
    if isinstance(load.sense, Fixed):
        return rotation(load.sense.angle)
    velocity = solution.points[load.at].velocity
    speed = np.abs(velocity)
    moves = speed > ZERO_SPEED_FRACTION * _largest_speed(solution)
    return np.where(moves, -velocity / np.where(moves, speed, 1.0), 0.0)


def _turning(solution: MotionValues, link: str) -> Reals:
    """Return the sense of a link's rotation: 1, -1, or 0 where it does not turn."""
    omega = solution.links[link].omega
    bodies = [solution.problem.bodies[name] for name in solution.problem.mechanism.links]
    reach = max(abs(z) for body in bodies for z in body.points.values())
    speeds = [np.abs(motion.omega) for motion in solution.links.values()]
    largest = np.max([*speeds, _largest_speed(solution) / (reach or 1.0)], axis=0)
    return np.where(np.abs(omega) > ZERO_SPEED_FRACTION * largest, np.sign(omega), 0.0)


def _largest_speed(solution: MotionValues) -> Reals:
    """Return the largest speed of a named point in each position, m/s."""
    speeds = [np.abs(motion.velocity) for motion in solution.points.values()]
    return np.asarray(np.max(speeds, axis=0), dtype=float)


def acting(solution: Solution, load: Load | Couple, start: float, turn: float) -> list[Span]:
    """Return the spans of a driving crank in which a load acts, degrees, in order.

    Parameters
    ----------
    start, turn : float, degrees
        Start and length of the examined range.
    """
    phase = load.phase
    if phase is None:
        return [(start, start + turn)]

    def acts(positions: Reals) -> Reals:
        moved = solution.with_positions(positions.tolist())
        return np.where(_acts(moved, load, phase), 1.0, -1.0)

    grid = start + turn * np.arange(_LOOKS + 1) / _LOOKS
    marks = roots(acts, grid).tolist()
    first, last = acts(grid[[0, -1]]) > 0.0
    ends = [*([start] if first else []), *marks, *([start + turn] if last else [])]
    return list(zip(ends[::2], ends[1::2], strict=True))


def _acts(solution: MotionValues, load: Load | Couple, phase: Phase) -> Mask:
    """Return whether a load acts, position by position."""
    acts = np.ones(solution.positions.shape, dtype=bool)
    if phase.phi:
        spans = [_in_span(solution.positions, *span) for span in phase.phi]
        acts &= np.any(spans, axis=0)
    if phase.moving is not None and isinstance(load, Load):
        ahead = (
            solution.points[load.at].velocity * MOTION_DIRECTIONS[phase.moving].conjugate()
        ).real
        acts &= ahead > ZERO_SPEED_FRACTION * _largest_speed(solution)
    if phase.turning is not None:
        sign = 1.0 if phase.turning is TurningSense.CCW else -1.0
        acts &= _turning(solution, load.link) == sign
    return acts


def _in_span(phi: Reals, start: float, end: float) -> Mask:
    """Return whether angles lie in a span, its ends included, degrees."""
    width = (end - start) % TURN or TURN
    return _from(phi, start) <= width + ABSCISSA_TOLERANCE


def _from(phi: Reals, start: float, turn: float = TURN) -> Reals:
    """Return angles counted from a start, degrees in [0, turn); rounding leaves the start 0."""
    turned = np.mod(phi - start, turn)
    return np.where(turned > turn - ABSCISSA_TOLERANCE, 0.0, turned)


# Tables ------------------------------------------------------------------------------------------


def _size(solution: MotionValues, load: Load | Couple, index: int) -> Reals | float:
    """Return the size of a load in every position, N or N·m."""
    size = load.size
    if not isinstance(size, SizeTable):
        return size
    if size.over is Over.POSITION:
        what = "force" if isinstance(load, Load) else "couple"
        return np.asarray(size.values)[_numbers(solution, f"loads[{index}].{what}")]
    return read(closed(in_time(solution, size, index)), abscissae(solution, load, index))


def in_time(solution: MotionValues, table: SizeTable, index: int) -> SizeTable:
    """Return the table of a load with the rows of each stroke in the order in which they come.

    Those of an indicator count from the top dead centre; a first stroke that leads back to it goes
    through them from the last one.

    Parameters
    ----------
    index : int
        The number of the load in the file.
    """
    if table.over is not Over.STROKES or not _cycle_motion(solution).stroke_of(index).back:
        return table
    rows: list[tuple[float, float]] = []
    for number in range(round(table.at[-1])):
        # its ends are in two rows: the last of the stroke before, and its own
        first, last = bisect_right(table.at, number) - 1, bisect_left(table.at, number + 1)
        own = zip(table.at[first : last + 1], table.values[first : last + 1], strict=True)
        rows += [(2 * number + 1 - at, value) for at, value in [*own][::-1]]
    at, values = zip(*rows, strict=True)
    return replace(table, at=at, values=values)


def abscissae(solution: MotionValues, load: Load | Couple, index: int) -> Reals:
    """Return where the table of a load is read in every position, shape (n,), in its own unit.

    Parameters
    ----------
    index : int
        The number of the load in the file.
    """
    size = load.size
    assert isinstance(size, SizeTable)
    match size.over:
        case Over.POSITION | Over.S:
            return solution.positions
        case Over.PHI:
            return size.at[0] + _from(solution.positions, size.at[0], size.turn)
        case Over.X | Over.Y:
            assert isinstance(load, Load), "a couple has no point"
            place = solution.points[load.at].place
            return place.real if size.over is Over.X else place.imag
        case Over.PATH | Over.STROKES:
            assert isinstance(load, Load), "a couple has no point"
            turn, place = _cycle_motion(solution), solution.points[load.at].place
            stroke = turn.stroke_of(index)
            if size.over is Over.PATH:
                return stroke.fraction(place)
            turned = turn.rotation_at(solution.positions)
            return stroke.progress(turned, place, turn.cycle)


def _cycle_motion(solution: MotionValues) -> CycleMotion:
    """Return the motion of the whole cycle, which is needed to define a path or a stroke."""
    if isinstance(solution, MotionState):
        return solution.cycle
    if isinstance(solution, Memoizing):
        return solution.compute_once(_cycle_motion_of)
    return _cycle_motion_of(solution)


def _cycle_motion_of(solution: MotionValues) -> CycleMotion:
    return CycleMotion(solution.problem)


def closed(table: SizeTable) -> SizeTable:
    """Return a table with the row at which it repeats, if it does."""
    end = table.at[0] + table.turn
    if table.over is not Over.PHI or table.at[-1] >= end:
        return table
    return replace(table, at=(*table.at, end), values=(*table.values, table.values[0]))


def read(table: SizeTable, at: Reals) -> Reals:
    """Read a table; beyond its ends it keeps their values."""
    nodes, values = np.asarray(table.at), np.asarray(table.values)
    if table.interpolation is Interpolation.LINEAR:
        return np.asarray(np.interp(at, nodes, values), dtype=float)
    slack = ABSCISSA_TOLERANCE * (nodes[-1] - nodes[0])
    row = np.searchsorted(nodes, at + slack, side="right") - 1
    return np.asarray(values[np.maximum(row, 0)], dtype=float)


def _numbers(solution: MotionValues, path: str) -> npt.NDArray[np.intp]:
    """Return the indices of the requested positions in the file.

    Raises
    ------
    ProblemError
        For the first one that is not in the file.
    """
    own, asked = np.asarray(solution.problem.drive.positions), solution.positions
    if np.array_equal(own, asked):
        return np.arange(len(own))
    order = np.argsort(own, kind="stable")
    number = order[
        np.minimum(np.searchsorted(own[order], asked - ABSCISSA_TOLERANCE), len(own) - 1)
    ]
    strange = np.flatnonzero(~(np.abs(own[number] - asked) <= ABSCISSA_TOLERANCE))
    if strange.size:
        problem = solution.problem
        first = problem.drive.coordinate.format_value(float(asked[strange[0]]), problem.unit)
        fault = Fault(
            f"{path}.values",
            translate("given for the positions of the file, and {} is not one of them", first),
            "Give the table over phi, s, x or y, or request the file's own positions.",
        )
        raise ProblemError(problem.name, [fault])
    return number


FAINT = 0.02
"""Fraction of the largest acceleration below which a length is too short to divide by."""

_ZERO_SHIFT_FRACTION = 1e-9
"""Share of the longest shift below which a shift is rounding: the link turns evenly."""


class Hindrance(Enum):
    """Reason why a link keeps the force and the couple."""

    NO_FORCE = "no force"  # no mass, or the centre of mass is fixed
    FAINT = "faint"  # in some position its acceleration is too small on the plan
    TOO_LONG = "far"


class UnshiftedInertia(Struct, frozen=True):
    """Link whose inertia stays a force and a couple, or a couple alone.

    ``moment`` is the couple; ``reach`` is the longest shift M_Φ/Φ of all positions, m; zero where
    there is no force.
    """

    moment: Applied
    hindrance: Hindrance
    reach: float = 0.0

    @property
    def link(self) -> str:
        """The link that the couple acts on."""
        return self.moment.link


def shifted_inertia(
    solution: Solution, loads: Iterable[Applied]
) -> tuple[dict[str, Applied], tuple[UnshiftedInertia, ...]]:
    """Return the links whose inertia force is shifted, the same in all positions.

    Returns
    -------
    dict of str to Applied
        The couples that vanish, by link.
    tuple of UnshiftedInertia
        The other links that have such a couple.
    """
    found = list(loads)
    forces = {one.link: one for one in found if one.kind is LoadKind.INERTIA}
    shifted: dict[str, Applied] = {}
    kept: list[UnshiftedInertia] = []
    for one in found:
        if one.kind is not LoadKind.INERTIA_COUPLE:
            continue
        if one.link not in forces:
            kept.append(UnshiftedInertia(one, Hindrance.NO_FORCE))
            continue
        reach = _reach(forces[one.link], one)
        why = _hindrance(solution, forces[one.link], reach)
        if why is not None:
            kept.append(UnshiftedInertia(one, why, reach))
        elif reach > _ZERO_SHIFT_FRACTION * farthest(solution.problem):
            shifted[one.link] = one
    return shifted, tuple(kept)


def _reach(force: Applied, couple: Applied) -> float:
    """Return the longest shift, m; infinite where there is a couple and no force."""
    size, moment = np.abs(force.force), np.abs(couple.couple)
    with np.errstate(divide="ignore", invalid="ignore"):
        return float(np.max(np.where(moment == 0, 0.0, moment / size), initial=0.0))


def _hindrance(solution: Solution, force: Applied, reach: float) -> Hindrance | None:
    assert force.point is not None
    accelerations = np.abs(solution.points[force.point].acceleration)
    largest = np.max([np.abs(point.acceleration) for point in solution.points.values()], axis=0)
    unread = solution.ruler_arithmetic.ruled(accelerations / solution.per_mm["mu_a"]) == 0
    if np.any((accelerations <= FAINT * largest) | unread):
        return Hindrance.FAINT
    return Hindrance.TOO_LONG if reach > farthest(solution.problem) else None


def farthest(problem: Problem) -> float:
    """Return the longest shift that is drawn, m: farther the line would leave the drawing.

    It is the largest distance of two points of a link or of the frame.
    """
    spans = [
        abs(one - other)
        for body in problem.bodies.values()
        for one in body.points.values()
        for other in body.points.values()
    ]
    return max(spans, default=0.0)
