"""Places, velocities, accelerations over a whole cycle, as piecewise polynomials of the angle."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from math import pi

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.arithmetic import ARRAYS, Number, PiecewiseArithmetic
from planmethod.construct.curves import Piecewise, resolved
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.plans.build import Construction
from planmethod.problem.model import Problem
from planmethod.problem.names import format_length
from planmethod.problem.records import Load, Over, SizeTable
from planmethod.solved.reading import Reals
from planmethod.solved.solution import LinkMotion, PointMotion, Solution

PANELS = 24
"""Pieces of a turn to begin with."""

STRAIGHT = 1e-7
"""Share of its stroke that a point on a straight path may be off it."""

LEANING = np.radians(30.0)
"""Distance by which a bottom dead centre must be nearer to position 0 than a top one, rad, for the
strokes of an indicator to be counted from it."""

ASTRAY = np.radians(45.0)
"""Greatest distance from its dead position of a piston that repeats another, rad."""

_SAME = 1e-9  # share of the largest size by which the ends of a cycle may differ
_OFFSET = 1.6e-3  # rad off round angles, at which singular places are common
_NEAR = 1e-6  # rad within which a dead position at the very start is found at either end, or not

_COLUMNS = 6  # of a point: x and y of its place, velocity and acceleration


class MotionState(Struct, frozen=True):
    """Motion in some positions, as loads need it: see `planmethod.solved.forces.loads`.

    Attributes
    ----------
    positions : ndarray of shape (n,), degrees
        Angles of the driving crank as in the file.
    cycle : CycleMotion
        The cycle that they are of.
    """

    cycle: CycleMotion
    problem: Problem
    construction: Construction
    positions: Reals
    points: Mapping[str, PointMotion]
    links: Mapping[str, LinkMotion]


class PointStroke(Struct, frozen=True):
    """Course of a point between its dead positions (ход точки): along a line or an arc.

    Attributes
    ----------
    start, towards : complex, m
        The end of the path that shares are counted from, and the vector to its other end.
    dead : ndarray of shape (m,), rad
        Where the point stands, angles turned from position 0, rising within a cycle. From the first
        one strokes are counted; it may be before position 0.
    centre : complex or None, m
        Of the arc; None of a straight path.
    back : bool
        The first stroke of the cycle leads back to the start; else away from it.
    """

    start: complex
    towards: complex
    dead: Reals
    centre: complex | None = None
    back: bool = False

    @property
    def swing(self) -> float:
        """Angle of the arc, rad, counter-clockwise positive; a swing is less than half a turn."""
        assert self.centre is not None
        ray = self.start - self.centre
        return float(np.angle((ray + self.towards) / ray))

    def fraction(self, place: Number, arithmetic: PiecewiseArithmetic = ARRAYS) -> Number:
        """Return how far a place is along the path, from 0 at the start to 1, shape (n,)."""
        if self.centre is None:
            way = (place - self.start) * self.towards.conjugate()
            along = way.real / abs(self.towards) ** 2
        else:
            turned = (place - self.centre) / (self.start - self.centre)
            along = arithmetic.angle(turned) / self.swing
        return arithmetic.clipped(along, 0.0, 1.0)

    def direction(self, fraction: float) -> complex:
        """Return the unit vector across which the path is cut after a share of it."""
        if self.centre is None:
            return self.towards / abs(self.towards)
        turned = self.swing * fraction + np.sign(self.swing) * np.pi / 2
        ray = self.start - self.centre
        return complex(ray / abs(ray) * np.exp(1j * turned))

    def place(self, fraction: float) -> complex:
        """Return the place after a share of the path, m."""
        if self.centre is None:
            return self.start + self.towards * fraction
        return complex(
            self.centre + (self.start - self.centre) * np.exp(1j * self.swing * fraction)
        )

    def progress(
        self,
        rotation: Number,
        place: Number,
        cycle: float,
        arithmetic: PiecewiseArithmetic = ARRAYS,
    ) -> Number:
        """Return how many strokes of the cycle are done since the first began, shape (n,)."""
        ar, count = arithmetic, len(self.dead)
        since = ar.modulo(rotation - float(self.dead[0]), cycle)
        slack = 1e-9  # rounding of a dead position, as of one that the file asks
        marks = np.append(self.dead - self.dead[0], cycle).tolist()
        number = ar.passed(marks, since + slack) - 1.0
        share = self.fraction(place, ar)
        returns = ar.above(ar.modulo(number + float(self.back), 2.0), 0.5)
        done = ar.select(returns, 1.0 - share, share)
        return ar.modulo(number, float(count)) + ar.select(ar.above(number, count - 0.5), 0.0, done)


class CycleMotion:
    """Motion of a mechanism over the cycle of its machine (движение за цикл).

    Angles turned, rad, count from position 0 in the sense in which the crank turns. The crank turns
    evenly, as in analogues of velocities.

    Parameters
    ----------
    problem : Problem
        With a driving crank that turns.

    Attributes
    ----------
    sense : float
        1 where the crank turns counter-clockwise, else -1.
    start_deg : float, degrees
        Driver position 0.
    turns : int
        Turns of a cycle: of the machine, else as many as the links need to come again.
    cycle : float, rad
        Angle of a cycle.

    Raises
    ------
    ProblemError
        The driver slides or is at rest, or the cycle does not end where it begins.
    AssemblyError
        When the mechanism cannot be assembled all round.
    """

    def __init__(self, problem: Problem) -> None:
        drive = problem.drive
        if not drive.revolves:
            raise _fault(
                problem,
                "driver",
                translate("link {} slides: the driver is not a crank", drive.link),
                "The cycle of a machine is that of a driving crank: give phi and n.",
            )
        if not drive.rate:
            raise _fault(
                problem, "driver.omega", "the crank does not move", "Give its speed, omega or n."
            )
        self.problem = replace(problem, drive=replace(drive, acceleration=0.0))
        self.sense = 1.0 if drive.rate > 0.0 else -1.0
        machine = problem.machine
        start = machine.start_deg if machine is not None else None
        first = (*problem.numbered, *drive.positions)[0]
        self.start_deg = first if start is None else start
        self._solution = Solution(self.problem, positions=[self.start_deg])
        self.turns = self._solution.closing_turns if machine is None else machine.turns
        self.cycle = float(np.radians(360.0 * self.turns))
        self.construction = self._solution.construction

    def numbers(self, count: int) -> list[int]:
        """Return the numbers of n positions in the order of the crank's motion, and 0 again.

        ``[cycle] direction`` may be against the crank's rotation.
        """
        task = self.problem.cycle
        if task is None or not task.is_against(self.sense):
            return [*range(count), 0]
        return [0, *range(count - 1, -1, -1)]

    def phi(self, rotation: Reals) -> Reals:
        """Return driver positions of the file, degrees, of angles turned."""
        return self.start_deg + self.sense * np.degrees(rotation)

    def rotation_at(self, phi: Number, arithmetic: PiecewiseArithmetic = ARRAYS) -> Number:
        """Return the angles turned from position 0, rad in [0, cycle), of driver positions."""
        turned = self.sense * (phi - self.start_deg) * (pi / 180.0)
        found = arithmetic.modulo(turned, self.cycle)
        return arithmetic.select(arithmetic.above(found, self.cycle - 1e-9), 0.0, found)

    def solved(self, rotation: Reals) -> Solution:
        """Return the mechanism solved at angles turned, rad, ndarray of shape (n,)."""
        return self._solution.with_positions(self.phi(rotation).tolist())

    # Polynomials -----------------------------------------------------------------------------

    @cached_property
    def _names(self) -> tuple[list[str], list[str]]:
        named = self.construction.kinematics.velocity.named
        return list(named), list(self.problem.mechanism.links)

    def _columns(self, rotation: Reals) -> Reals:
        solution = self.solved(rotation)
        columns: list[Reals] = []
        for name in self._names[0]:
            motion = solution.points[name]
            for vector in (motion.place, motion.velocity, motion.acceleration):
                columns += [vector.real, vector.imag]
        for link in self._names[1]:
            columns += [solution.links[link].omega, solution.links[link].epsilon]
        return np.stack(columns, axis=1)

    @cached_property
    def curve(self) -> Piecewise:
        """All of it as polynomials: six columns for each point, then two for each link."""
        count = self.turns * PANELS
        edges = np.linspace(0.0, self.cycle, count + 1)
        points, links = self._names
        rough = self._columns(np.linspace(0.0, self.cycle, 2 * count + 1) + _OFFSET)
        largest = np.max(np.abs(rough), axis=0)
        of_points = largest[: _COLUMNS * len(points)].reshape(-1, 3, 2).max(axis=(0, 2))
        of_links = largest[_COLUMNS * len(points) :].reshape(-1, 2).max(axis=0)
        sizes = np.concatenate(
            (np.tile(np.repeat(of_points, 2), len(points)), np.tile(of_links, len(links)))
        )
        sizes = np.where(sizes > 0.0, sizes, 1.0)
        if np.max(np.abs(rough[-1] - rough[0]) / sizes) > _SAME:
            raise _fault(
                self.problem,
                "machine.cycle_deg",
                translate(
                    "after {:g} degrees the links are not where they were", np.degrees(self.cycle)
                ),
                self._remedy,
            )
        return resolved(self._columns, edges, sizes)

    @property
    def _remedy(self) -> str:
        """Hint for links that are not where they were after a cycle."""
        if self._solution.closes_after == 2.0:
            return "The motion closes after 720 degrees: give [machine] cycle_deg = 720."
        return "Check [assembly]: the assembly must repeat with the cycle."

    def at(self, rotation: Reals) -> MotionState:
        """Return the motion at angles turned, rad, ndarray of shape (n,)."""
        rows = self.curve(np.mod(rotation, self.cycle)).T
        points: dict[str, PointMotion] = {}
        for number, name in enumerate(self._names[0]):
            x, y, vx, vy, ax, ay = rows[_COLUMNS * number : _COLUMNS * (number + 1)]
            points[name] = PointMotion(x + 1j * y, vx + 1j * vy, ax + 1j * ay)
        first = _COLUMNS * len(points)
        nothing = np.full(len(rotation), np.nan)  # the directions of links are not needed here
        links = {
            link: LinkMotion(nothing, rows[first + 2 * k], rows[first + 2 * k + 1])
            for k, link in enumerate(self._names[1])
        }
        return MotionState(self, self.problem, self.construction, self.phi(rotation), points, links)

    @cached_property
    def first(self) -> MotionState:
        """The motion in position 0."""
        return self.at(np.zeros(1))

    @cached_property
    def sampled(self) -> MotionState:
        """The motion at angles that come near to everything that happens."""
        return self.at(self.curve.samples)

    def column(self, point: str, direction: complex, *, velocity: bool = False) -> Piecewise:
        """Return the place or the velocity of a point along a direction, m or m/s."""
        weights = np.zeros(self.curve.terms.shape[2])
        first = _COLUMNS * self._names[0].index(point) + (2 if velocity else 0)
        weights[first : first + 2] = direction.real, direction.imag
        return self.curve.mixed(weights)

    def omega(self, link: str) -> Piecewise:
        """Return the angular velocity of a link, 1/s."""
        weights = np.zeros(self.curve.terms.shape[2])
        points, links = self._names
        weights[_COLUMNS * len(points) + 2 * links.index(link)] = 1.0
        return self.curve.mixed(weights)

    def main_direction(self, point: str) -> complex:
        """Return the direction of a point's motion where it is fastest; 1 for a fixed point."""
        velocity = self.sampled.points[point].velocity
        fastest = complex(velocity[int(np.argmax(np.abs(velocity)))])
        return fastest / abs(fastest) if fastest else 1.0 + 0j

    # Strokes ---------------------------------------------------------------------------------

    @cached_property
    def _strokes(self) -> dict[str, PointStroke]:
        return {}

    @cached_property
    def _courses(self) -> dict[str, PointStroke]:
        return {}

    def stroke_of(self, load: Load) -> PointStroke:
        """Return the stroke over which the table of a load is read (ход, по которому нагрузка).

        A path counts from its end that position 0 is nearer to, an indicator diagram from the top
        dead centre of its own piston.

        Raises
        ------
        ProblemError
            As of `stroke`; or the cycle has other strokes than the diagram, or the piston of a
            diagram that is like another one is not at a dead position after the shift.
        """
        assert isinstance(load.size, SizeTable)
        if load.size.over is not Over.STROKES:
            return self.stroke(load.at)
        if load.name not in self._courses:
            self._courses[load.name] = self._indicated(load, load.size)
        return self._courses[load.name]

    def _indicated(self, load: Load, size: SizeTable) -> PointStroke:
        """Return the stroke of a piston from its top dead centre, and with which it begins."""
        own = self._from_top(self.stroke(load.at))
        given, there = round(size.at[-1]), len(own.dead)
        if given != there:
            raise _fault(
                self.problem,
                f"{load.path}.{load.key}.strokes",
                translate(
                    "{} strokes, point {} makes {} in a cycle of {:g} degrees",
                    given,
                    load.at,
                    there,
                    np.degrees(self.cycle),
                ),
                "A four-stroke engine has [machine] cycle_deg = 720.",
            )
        dead = np.mod(own.dead, self.cycle)
        below = own.fraction(self.at(dead).points[load.at].place) > 0.5
        if size.like is None:
            off = self._angular_distance(dead, 0.0)
            back = bool(off[below].min() < off[~below].min() - LEANING)
        else:
            first = self.stroke_of(self._named(size.like))
            back, began = first.back, first.dead[0] + np.radians(size.shift)
            off = self._angular_distance(dead, began)
            self._check_shift(load, size, dead[below == back] - first.dead[0], off[below == back])
        start = dead[int(np.argmin(np.where(below == back, off, np.inf)))]
        since = np.sort(np.mod(dead - start + _NEAR, self.cycle)) - _NEAR
        start -= self.cycle if start > self.cycle / 2.0 else 0.0
        return replace(own, dead=np.asarray(start + since), back=back)

    def _named(self, name: str) -> Load:
        dynamics = self.problem.dynamics
        assert dynamics is not None
        load = next(load for load in dynamics.loads if load.name == name)
        assert isinstance(load, Load), "a couple has no point"
        return load

    def _angular_distance(self, dead: Reals, angle: float) -> Reals:
        """Return the distance of dead positions from an angle turned, rad, in either direction."""
        ahead = np.mod(dead - angle, self.cycle)
        return np.minimum(ahead, self.cycle - ahead)

    def _check_shift(self, load: Load, size: SizeTable, after: Reals, off: Reals) -> None:
        """Reject a shift after which a piston is not near its dead position."""
        if off.min() <= ASTRAY:
            return
        turned = np.sort(np.mod(np.degrees(after) + 1e-6, np.degrees(self.cycle)))
        known = ", ".join(f"{angle:.4g}" for angle in turned)
        raise _fault(
            self.problem,
            f"{load.path}.{load.key}.shift",
            translate(
                "{0:g} degrees after the first stroke of {1} point {2} does not begin such "
                "a stroke: it begins one {3} degrees after it",
                size.shift,
                size.like,
                load.at,
                known,
            ),
            "Give one of these angles.",
        )

    def _from_top(self, stroke: PointStroke) -> PointStroke:
        """Return a stroke from its end that is farthest from the axis of the crank.

        Where both are as far from it, from the end that position 0 is nearer to.
        """
        pivot = self.problem.drive.pivot
        assert pivot is not None, "a crank drives"
        axis, end = self.problem.bodies[FRAME].points[pivot], stroke.start + stroke.towards
        if abs(end - axis) - abs(stroke.start - axis) <= STRAIGHT * abs(stroke.towards):
            return stroke
        return replace(stroke, start=end, towards=-stroke.towards)

    def stroke(self, point: str) -> PointStroke:
        """Return the stroke of a point that moves to and fro on a straight line or an arc.

        It starts at the end of the path that position 0 is nearer to; strokes are counted from the
        last dead position before position 0 or the next one, whichever is nearer along the path.

        Raises
        ------
        ProblemError
            The point is at rest, or its path is neither.
        """
        if point not in self._strokes:
            self._strokes[point] = self._stroke(point)
        return self._strokes[point]

    def _stroke(self, point: str) -> PointStroke:
        way, rocker = self.main_direction(point), self._rocker(point)
        if rocker is None:
            dead = self.column(point, way, velocity=True).roots()
        else:
            dead = self.omega(rocker[0]).roots()
        first = self.first.points[point]
        speeds = np.abs(self.sampled.points[point].velocity)
        at_start = abs(first.velocity[0]) <= 1e-9 * float(np.max(speeds))
        if at_start:
            dead = np.append(0.0, dead[(dead > _NEAR) & (dead < self.cycle - _NEAR)])
        places = self.at(dead).points[point].place
        if len(dead) < 2 or float(np.ptp((places * way.conjugate()).real)) == 0.0:
            raise _fault(
                self.problem,
                "loads",
                translate("point {} does not reciprocate", point),
                "Check `at`.",
            )
        last, following = np.abs(first.place[0] - places[[-1, 0]])
        if not at_start and last <= following:
            dead = np.append(dead[-1] - self.cycle, dead[:-1])
            places = np.roll(places, 1)
        along = (places * way.conjugate()).real
        if rocker is not None:
            along = np.unwrap(np.angle(places - rocker[1]))
        low, high = complex(places[np.argmin(along)]), complex(places[np.argmax(along)])
        start, end = (low, high) if abs(places[0] - low) <= abs(places[0] - high) else (high, low)
        everywhere = self.sampled.points[point].place
        towards = end - start
        off = float(np.max(np.abs(((everywhere - start) * towards.conjugate()).imag)))
        if off <= STRAIGHT * abs(towards) ** 2:
            return PointStroke(start, towards, dead)
        if rocker is not None:
            return PointStroke(start, towards, dead, rocker[1])
        raise _fault(
            self.problem,
            "loads",
            translate(
                "point {} moves neither on a straight line nor about a fixed point: it is {} off "
                "the line, the stroke is {}",
                point,
                format_length(off / abs(towards), self.problem.unit, 3),
                format_length(abs(towards), self.problem.unit, 4),
            ),
            'Give the load over the path of a slider or of a rocker, or over "phi".',
        )

    def _rocker(self, point: str) -> tuple[str, complex] | None:
        """Return the link that swings a point about a fixed one, m, less than half a turn."""
        bodies = self.problem.bodies
        fixed = bodies[FRAME].points
        for link, body in bodies.items():
            pivots = [one for one in body.points if one in fixed]
            if link == FRAME or point not in body.points or not pivots:
                continue
            rays = self.sampled.points[point].place - fixed[pivots[0]]
            if float(np.ptp(np.unwrap(np.angle(rays)))) < np.pi:
                return link, fixed[pivots[0]]
        return None


def _fault(problem: Problem, path: str, message: str, hint: str) -> ProblemError:
    return ProblemError(problem.name, [Fault(path, message, hint)])
