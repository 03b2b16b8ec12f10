"""Given loads: what a force or a couple of the file is, where it acts and where it breaks (законы).

A law is written once, over an arithmetic: arrays for plans and diagrams, a tape for the program
of the live page.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Mapping
from functools import cached_property, reduce
from typing import Protocol, assert_never

import numpy as np
from msgspec.structs import replace

from planmethod.construct.arithmetic import ARRAYS, Number, PiecewiseArithmetic
from planmethod.construct.curves import roots
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.plans.build import Construction
from planmethod.problem.model import Problem
from planmethod.problem.placement import rotation
from planmethod.problem.records import (
    Against,
    Couple,
    Dynamics,
    Fixed,
    Interpolation,
    Load,
    MovingSense,
    Over,
    Phase,
    SizeTable,
    Spring,
    SpringEnd,
    TurningSense,
)
from planmethod.solved.cycle_motion import CycleMotion, MotionState
from planmethod.solved.forces.springs import springs_of
from planmethod.solved.reading import Memoizing, Reals
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

SEARCHED_POSITIONS = 720  # positions between which a load may begin and end

Span = tuple[float, float]


class MotionValues(Protocol):
    """Motion data that loads need; a `Solution` has them.

    ``positions`` is of shape (n,), as are the arrays of ``points`` and ``links``; on a tape they
    are its numbers.
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


def only_in_positions(dynamics: Dynamics) -> bool:
    """Return whether a load is known only in the file's positions."""
    return any(_is_listed(load) for load in dynamics.loads)


def _is_listed(load: Load | Couple) -> bool:
    return isinstance(load.size, SizeTable) and load.size.over is Over.POSITION


def needs_motion(load: Load | Couple) -> bool:
    """Return whether a load depends on the motion, not on the driver's position alone."""
    phase = load.phase
    if isinstance(load.sense, Against | SpringEnd):
        return True
    if phase is not None and (phase.moving is not None or phase.turning is not None):
        return True
    of_point = (Over.X, Over.Y, Over.PATH, Over.STROKES)
    return isinstance(load.size, SizeTable) and load.size.over in of_point


def is_at_rest(motion: MotionValues) -> bool:
    """Return whether the driver, and all links with it, are at rest."""
    drive = motion.problem.drive
    return drive.rate == 0 and not drive.accelerates


def is_zero(motion: MotionValues, load: Load | Couple) -> bool:
    """Return whether a load is zero by nature: of size zero, or against an immovable point."""
    if load.size == 0:
        return True
    if isinstance(load.size, Spring):
        spring = load.size
        return not spring.stiffness and not spring.preload and is_at_rest(motion)
    if not isinstance(load.sense, Against):
        return False
    turns = isinstance(load, Load) or load.link in motion.construction.kinematics.omega
    return is_at_rest(motion) or not turns


class GivenLoads:
    """Sizes and directions of given loads in some positions.

    Parameters
    ----------
    motion : MotionValues
    arithmetic : PiecewiseArithmetic
        That of the numbers of the motion.
    """

    def __init__(self, motion: MotionValues, arithmetic: PiecewiseArithmetic = ARRAYS) -> None:
        self.motion, self.arithmetic = motion, arithmetic

    def value(self, load: Load | Couple) -> Number:
        """Return a force, N, as a vector, or a couple, N·m, counter-clockwise positive."""
        if isinstance(load.size, Spring):
            assert isinstance(load.sense, SpringEnd)
            return springs_of(self.motion, self.arithmetic).state(load.size).on(load.sense)
        size = self._size(load)
        if load.phase is not None:
            size = self.arithmetic.select(self.acts(load, load.phase), size, 0.0)
        if isinstance(load, Load):
            return size * self._direction(load)
        return size if load.sense is None else -size * self._turning(load.link)

    # Direction and phase ---------------------------------------------------------------------

    def _direction(self, load: Load) -> Number:
        """Return the unit vector of a force; zero if it resists a point at rest."""
        assert not isinstance(load.sense, SpringEnd), "the size of a spring has its direction"
        if isinstance(load.sense, Fixed):
            return rotation(load.sense.angle)
        velocity, select = self.motion.points[load.at].velocity, self.arithmetic.select
        speed = abs(velocity)
        moves = self.arithmetic.above(speed, ZERO_SPEED_FRACTION * self._largest_speed)
        return select(moves, -velocity / select(moves, speed, 1.0), 0.0)

    def _turning(self, link: str) -> Number:
        """Return the sense of a link's rotation: 1, -1, or 0 where it does not turn."""
        ar, omega = self.arithmetic, self.motion.links[link].omega
        turns = ar.above(abs(omega), ZERO_SPEED_FRACTION * self._largest_rotation)
        return ar.select(turns, ar.select(ar.above(omega, 0.0), 1.0, -1.0), 0.0)

    @cached_property
    def _largest_speed(self) -> Number:
        """The largest speed of a named point in each position, m/s."""
        speeds = (abs(point.velocity) for point in self.motion.points.values())
        return reduce(self.arithmetic.larger, speeds)

    @cached_property
    def _largest_rotation(self) -> Number:
        """The largest angular velocity in each position, 1/s."""
        problem = self.motion.problem
        bodies = [problem.bodies[name] for name in problem.mechanism.links]
        reach = max(abs(z) for body in bodies for z in body.points.values())
        speeds = (abs(link.omega) for link in self.motion.links.values())
        return reduce(self.arithmetic.larger, speeds, self._largest_speed / (reach or 1.0))

    def acts(self, load: Load | Couple, phase: Phase) -> Number:
        """Return whether a load acts, position by position."""
        ar, met = self.arithmetic, []
        if phase.phi:
            spans = (self._is_in_span(*span) for span in phase.phi)
            met.append(reduce(ar.either, spans))
        if phase.moving is not None and isinstance(load, Load):
            way = MOTION_DIRECTIONS[phase.moving].conjugate()
            ahead = (self.motion.points[load.at].velocity * way).real
            met.append(ar.above(ahead, ZERO_SPEED_FRACTION * self._largest_speed))
        if phase.turning is not None:
            sign = 1.0 if phase.turning is TurningSense.CCW else -1.0
            met.append(ar.above(sign * self._turning(load.link), 0.0))
        return reduce(ar.both, met)

    def _is_in_span(self, start: float, end: float) -> Number:
        """Return whether the driver is in a span of angles, its ends included, degrees."""
        width = (end - start) % TURN or TURN
        return self.arithmetic.reaches(width + ABSCISSA_TOLERANCE, self._since(start))

    def _since(self, start: float, turn: float = TURN) -> Number:
        """Return the driver's angle counted from a start, degrees in [0, turn).

        Rounding leaves the start 0.
        """
        ar = self.arithmetic
        turned = ar.modulo(self.motion.positions - start, turn)
        return ar.select(ar.above(turned, turn - ABSCISSA_TOLERANCE), 0.0, turned)

    # Tables ----------------------------------------------------------------------------------

    def _size(self, load: Load | Couple) -> Number:
        """Return the size of a load in every position, N or N·m."""
        match load.size:
            case int() | float():
                return load.size
            case SizeTable(over=Over.POSITION):
                return self._listed(load, load.size)
            case SizeTable():
                table = closed(in_time(self.motion, load, load.size))
                return read(table, self.abscissae(load, load.size), self.arithmetic)
            case Spring():
                raise AssertionError  # a spring has a direction of its own
            case _:
                assert_never(load.size)

    def _listed(self, load: Load | Couple, table: SizeTable) -> Number:
        """Return the values of the file's own positions.

        Raises
        ------
        ProblemError
            For the first requested position that is not in the file.
        """
        problem = self.motion.problem

        def reject(strange: float) -> ProblemError:
            first = problem.drive.coordinate.format_value(strange, problem.unit)
            fault = Fault(
                f"{load.path}.{load.key}.values",
                translate("given for the positions of the file, and {} is not one of them", first),
                "Give the table over phi, s, x or y, or request the file's own positions.",
            )
            return ProblemError(problem.name, [fault])

        own = problem.drive.positions
        return self.arithmetic.listed(
            own, table.values, self.motion.positions, ABSCISSA_TOLERANCE, reject
        )

    def abscissae(self, load: Load | Couple, size: SizeTable) -> Number:
        """Return where the table of a load is read in every position, in its own unit."""
        match size.over:
            case Over.POSITION | Over.S:
                return self.motion.positions
            case Over.PHI:
                return size.at[0] + self._since(size.at[0], size.turn)
            case Over.X | Over.Y:
                assert isinstance(load, Load), "a couple has no point"
                place = self.motion.points[load.at].place
                return place.real if size.over is Over.X else place.imag
            case Over.PATH | Over.STROKES:
                assert isinstance(load, Load), "a couple has no point"
                cycle, place = _cycle_motion(self.motion), self.motion.points[load.at].place
                stroke = cycle.stroke_of(load)
                if size.over is Over.PATH:
                    return stroke.fraction(place, self.arithmetic)
                turned = cycle.rotation_at(self.motion.positions, self.arithmetic)
                return stroke.progress(turned, place, cycle.cycle, self.arithmetic)
            case _:
                assert_never(size.over)


def _cycle_motion(motion: MotionValues) -> CycleMotion:
    """Return the motion of the whole cycle, which is needed to define a path or a stroke."""
    if isinstance(motion, MotionState):
        return motion.cycle
    if isinstance(motion, Memoizing):
        return motion.compute_once(_cycle_motion_of)
    return _cycle_motion_of(motion)


def _cycle_motion_of(motion: MotionValues) -> CycleMotion:
    return CycleMotion(motion.problem)


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
        given = GivenLoads(solution.with_positions(positions.tolist()))
        return np.where(given.acts(load, phase), 1.0, -1.0)

    grid = start + turn * np.arange(SEARCHED_POSITIONS + 1) / SEARCHED_POSITIONS
    marks = roots(acts, grid).tolist()
    first, last = acts(grid[[0, -1]]) > 0.0
    ends = [*([start] if first else []), *marks, *([start + turn] if last else [])]
    return list(zip(ends[::2], ends[1::2], strict=True))


def in_time(motion: MotionValues, load: Load | Couple, table: SizeTable) -> SizeTable:
    """Return the table of a load with the rows of each stroke in the order in which they come.

    Those of an indicator count from the top dead centre; a first stroke that leads back to it goes
    through them from the last one.
    """
    if table.over is not Over.STROKES:
        return table
    assert isinstance(load, Load), "a couple has no point"
    if not _cycle_motion(motion).stroke_of(load).back:
        return table
    rows: list[tuple[float, float]] = []
    for number in range(round(table.at[-1])):
        # its ends are in two rows: the last of the stroke before, and its own
        first, last = bisect_right(table.at, number) - 1, bisect_left(table.at, number + 1)
        own = zip(table.at[first : last + 1], table.values[first : last + 1], strict=True)
        rows += [(2 * number + 1 - at, value) for at, value in [*own][::-1]]
    at, values = zip(*rows, strict=True)
    return replace(table, at=at, values=values)


def closed(table: SizeTable) -> SizeTable:
    """Return a table with the row at which it repeats, if it does."""
    end = table.at[0] + table.turn
    if table.over is not Over.PHI or table.at[-1] >= end:
        return table
    return replace(table, at=(*table.at, end), values=(*table.values, table.values[0]))


def read(table: SizeTable, at: Number, arithmetic: PiecewiseArithmetic = ARRAYS) -> Number:
    """Read a table; beyond its ends it keeps their values."""
    if table.interpolation is Interpolation.LINEAR:
        return arithmetic.interpolated(table.at, table.values, at)
    slack = ABSCISSA_TOLERANCE * (table.at[-1] - table.at[0])
    return arithmetic.stepped(table.at, table.values, at + slack)


# Breaks ------------------------------------------------------------------------------------------


def breaks(motion: CycleMotion, load: Load | Couple) -> Reals:
    """Return the places where a load may jump or have a kink, angles turned, rad, in no order.

    Raises
    ------
    ProblemError
        The load is known in the positions of the file only.
    """
    if _is_listed(load):
        hint = "A cycle needs it at every angle: give the table over phi, x, y or path."
        text = translate("{} is given only for the positions of the file", load.name)
        raise ProblemError(motion.problem.name, [Fault(load.path, text, hint)])
    return np.concatenate([np.zeros(0), *_breaks_of_sense(motion, load), *_of_size(motion, load)])


def _breaks_of_sense(motion: CycleMotion, load: Load | Couple) -> Iterator[Reals]:
    """Yield where a load turns round, begins or ends to act."""
    phase = load.phase
    if phase is not None and phase.phi:
        yield _all_turns(motion, np.array(phase.phi).ravel(), 360.0)
    if isinstance(load, Couple):
        if isinstance(load.sense, Against) or (phase is not None and phase.turning is not None):
            yield motion.omega(load.link).roots()
    elif isinstance(load.sense, Against) or phase is not None:
        ways = [motion.main_direction(load.at)]
        if phase is not None and phase.moving is not None:
            ways += [1.0 + 0j, 1j]
        for way in ways:
            yield motion.column(load.at, way, velocity=True).roots()
        if phase is not None and phase.turning is not None:
            yield motion.omega(load.link).roots()


def _of_size(motion: CycleMotion, load: Load | Couple) -> Iterator[Reals]:
    """Yield where the rows of a table are read."""
    match load.size:
        case int() | float():
            return
        case Spring() as spring:
            if spring.is_torsion:
                yield _half_turns(motion, spring)
            return
        case SizeTable() as size:
            nodes = np.unique(size.at)
        case _:
            assert_never(load.size)
    if size.over is Over.PHI:
        yield _all_turns(motion, nodes, size.turn)
    elif size.over in (Over.X, Over.Y):
        assert isinstance(load, Load)
        way = 1.0 + 0j if size.over is Over.X else 1j
        place = motion.column(load.at, way)
        slack = 1e-9 * float(np.ptp(nodes)) if size.interpolation is Interpolation.STEP else 0.0
        yield from (place.roots(node - slack) for node in nodes)
    else:
        assert isinstance(load, Load)
        stroke = motion.stroke_of(load)
        yield np.mod(stroke.dead, motion.cycle)
        shares = np.unique(np.append(np.mod(nodes, 1.0), np.mod(-nodes, 1.0)))
        for share in shares:
            if 1e-9 < share < 1.0 - 1e-9:
                along, there = stroke.direction(share), stroke.place(share)
                yield motion.column(load.at, along).roots((there * along.conjugate()).real)


def _half_turns(motion: CycleMotion, spring: Spring) -> Reals:
    """Return where a torsion spring passes its rest or is half a turn away from it: a jump."""

    def sine(rotation: Reals) -> Reals:
        deflection = springs_of(motion.at(rotation)).state(spring).deflection
        return np.asarray(np.sin(deflection), dtype=float)

    return roots(sine, np.linspace(0.0, motion.cycle, SEARCHED_POSITIONS * motion.turns + 1))


def _all_turns(motion: CycleMotion, phi: Reals, period: float) -> Reals:
    """Return where the driver is at some angles, degrees, in every turn of the cycle."""
    first = motion.rotation_at(phi)
    turns = max(round(motion.cycle / np.radians(period)), 1)
    every = np.concatenate([first + np.radians(period) * k for k in range(turns)])
    return np.asarray(np.mod(every, motion.cycle), dtype=float)
