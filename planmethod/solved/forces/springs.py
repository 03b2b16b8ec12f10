"""Law of springs, gas struts and dampers: length, force and moment of each (закон упругости).

The law is written once, over an arithmetic, as the other laws of loads: arrays for plans and
diagrams, a tape for the program of the live page.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import nan, pi
from typing import Any

import numpy as np
import numpy.typing as npt
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.arithmetic import ARRAYS, Number, PiecewiseArithmetic
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.plans.build import Construction
from planmethod.problem.model import Problem
from planmethod.problem.names import format_length
from planmethod.problem.placement import rotation
from planmethod.problem.records import Spring, SpringEnd
from planmethod.solved.cycle_motion import MotionState
from planmethod.solved.reading import Reals
from planmethod.solved.solution import LinkMotion, PointMotion, Solution

_SHORT = 1e-12
"""Length below which a spring has no direction, m."""

_AT_STOP = 1e-9
"""Part of its range by which a spring may pass a stop: rounding."""


class SpringState(Struct, frozen=True):
    """A spring in some positions; on a tape its numbers.

    Attributes
    ----------
    spring : Spring
    size : ndarray of shape (n,)
        Length, m, or angle from the first link to the second, degrees in (-180, 180].
    rate : ndarray of shape (n,)
        Its derivative, m/s, or 1/s.
    deflection : ndarray of shape (n,)
        Elongation over the rest, m, or angle over the rest, rad in (-π, π].
    force : ndarray of shape (n,)
        N, positive where it pushes the ends apart; or the moment, N·m, positive where it turns the
        second link counter-clockwise.
    direction : ndarray of shape (n,)
        Unit vector from the first end to the second; zero where they meet; 1 of a torsion spring.
    """

    spring: Spring
    size: Number
    rate: Number
    deflection: Number
    force: Number
    direction: Number

    def on(self, end: SpringEnd) -> Number:
        """Return the force on an end, N, as a vector, or the moment, N·m."""
        return end.sign * self.force * self.direction


class Springs:
    """Springs of a mechanism in some positions.

    Parameters
    ----------
    problem : Problem
    construction : Construction
        That of the motion.
    positions : ndarray of shape (n,)
        Positions of the driver, degrees or m.
    points, links : mapping
        Motion of the named points and of the links.
    arithmetic : PiecewiseArithmetic
        That of the numbers of the motion.
    is_strict : bool
        A position beyond the stops of a spring is a fault.
    """

    def __init__(
        self,
        problem: Problem,
        construction: Construction,
        positions: Reals,
        points: Mapping[str, PointMotion],
        links: Mapping[str, LinkMotion],
        arithmetic: PiecewiseArithmetic = ARRAYS,
        *,
        is_strict: bool = True,
    ) -> None:
        self.is_strict = is_strict
        self.problem, self.construction, self.positions = problem, construction, positions
        self.points, self.links, self.arithmetic = points, links, arithmetic

    def state(self, spring: Spring) -> SpringState:
        """Return a spring in the positions.

        Raises
        ------
        ProblemError
            Its length or angle is beyond its stops in some position.
        """
        found = self._torsion(spring) if spring.is_torsion else self._straight(spring)
        return found if spring.stops is None else self._between_stops(found, *spring.stops)

    def _straight(self, spring: Spring) -> SpringState:
        ar, (one, two) = self.arithmetic, (self._end(spring, number) for number in range(2))
        ray, velocity = two[0] - one[0], two[1] - one[1]
        length = abs(ray)
        is_long = ar.above(length, _SHORT)
        direction = ar.select(is_long, ray / ar.select(is_long, length, 1.0), 0.0)
        rate = (velocity * direction.conjugate()).real
        return self._stressed(spring, length, rate, length - self._rest_length(spring), direction)

    def _torsion(self, spring: Spring) -> SpringState:
        ar = self.arithmetic
        turned = self._relative_axis(spring)
        if spring.preload is not None:
            rest = complex(self._first()._relative_axis(spring)[0])
        else:
            rest = rotation(spring.angle or 0.0)
        first, second = (self._omega(link) for link in spring.links)
        angle, rate = ar.angle(turned) * (180.0 / pi), second - first + 0.0 * turned.real
        return self._stressed(spring, angle, rate, ar.angle(turned * rest.conjugate()), 1.0)

    def _stressed(
        self, spring: Spring, size: Number, rate: Number, deflection: Number, direction: Number
    ) -> SpringState:
        force = (spring.preload or 0.0) - spring.stiffness * deflection - spring.damping * rate
        return SpringState(spring, size, rate, deflection, force, direction)

    def _rest_length(self, spring: Spring) -> float:
        """Return the length at which the spring has its preload, or none, m."""
        if spring.preload is None:
            return spring.length or 0.0
        first = self._first()
        one, two = (first._end(spring, number)[0] for number in range(2))
        return float(np.ravel(abs(two - one))[0])

    def _first(self) -> Springs:
        """Return the springs in the first position of the file."""
        drive = self.problem.drive
        start = (drive.assembly_positions or drive.positions)[:1]
        solution = Solution(self.problem, positions=start, construction=self.construction)
        return springs_of(solution)

    # Ends ------------------------------------------------------------------------------------

    def _end(self, spring: Spring, number: int) -> tuple[Number, Number]:
        """Return the place of an end, m, and its velocity, m/s."""
        link, point = spring.links[number], spring.points[number]
        if link == FRAME:
            fixed = (
                point if isinstance(point, complex) else self.problem.bodies[FRAME].points[point]
            )
            return fixed, 0j
        motion = self.points[str(point)]
        return motion.place, motion.velocity

    def _relative_axis(self, spring: Spring) -> Number:
        """Return the unit vector of the second link's axis, in the axes of the first link."""
        first, second = (self._axis(link) for link in spring.links)
        turned = second * first.conjugate()
        return turned if self.arithmetic is not ARRAYS else turned + np.zeros(self.positions.shape)

    def _axis(self, link: str) -> Number:
        """Return the unit vector of a link's own axis, from the places of its points."""
        if link == FRAME:
            return 1.0 + 0j
        points = self.problem.bodies[link].points
        if len(points) < 2:
            return self._axis_by_slide(link)
        (start, here), *others = points.items()
        end, there = max(others, key=lambda one: abs(one[1] - here))
        way = (self.points[end].place - self.points[start].place) / (there - here)
        return way / abs(way)

    def _axis_by_slide(self, link: str) -> Number:
        """Return the unit vector of the axis of a link with one point, from that of its guide."""
        slides = self.problem.slides
        if link in slides:
            return self._axis(slides[link].host) * rotation(slides[link].angle)
        own = next(slide for slide in slides.values() if slide.host == link)
        return self._axis(own.slider) * rotation(-own.angle)

    def _omega(self, link: str) -> Number:
        return 0.0 if link == FRAME else self.links[link].omega

    # Stops -----------------------------------------------------------------------------------

    def _between_stops(self, state: SpringState, low: float, high: float) -> SpringState:
        """Return a spring whose force is NaN beyond its stops; reject a requested position there.

        Positions of a sweep are not requested: it has NaN where anything does not exist.
        """
        ar, slack = self.arithmetic, _AT_STOP * (high - low)
        inside = ar.both(ar.reaches(state.size, low - slack), ar.reaches(high + slack, state.size))
        if self.is_strict:
            size = np.broadcast_to(state.size, self.positions.shape)
            self._reject(state.spring, size, np.flatnonzero(~inside & np.isfinite(size)))
        return replace(state, force=ar.select(inside, state.force, nan))

    def _reject(self, spring: Spring, size: Reals, positions: npt.NDArray[np.intp]) -> None:
        """Reject the first of some positions beyond the stops of a spring."""
        if not positions.size:
            return
        assert spring.stops is not None
        problem, number = self.problem, positions[0]
        at = problem.drive.coordinate.format_value(float(self.positions[number]), problem.unit)

        def written(value: float) -> str:
            return f"{value:.4g}°" if spring.is_torsion else format_length(value, problem.unit)

        text = translate(
            "{} is at {} in the position {}, beyond its stops {} and {}",
            spring.name, written(float(size[number])), at, *map(written, spring.stops),
        )  # fmt: skip
        hint = "Request positions between the stops, or change stops."
        raise ProblemError(problem.name, [Fault(f"{spring.path}.stops", text, hint)])


def springs_of(motion: Any, arithmetic: PiecewiseArithmetic = ARRAYS) -> Springs:
    """Return the springs of a motion, a `planmethod.solved.forces.laws.MotionValues`."""
    return Springs(
        motion.problem, motion.construction, motion.positions, motion.points, motion.links,
        arithmetic, is_strict=isinstance(motion, Solution | MotionState),
    )  # fmt: skip


def spring_states(solution: Solution) -> tuple[SpringState, ...]:
    """Return the springs of a solution in its positions, in file order.

    Raises
    ------
    ProblemError
        As of `Springs.state`.
    """
    dynamics, found = solution.problem.dynamics, springs_of(solution)
    return tuple(map(found.state, () if dynamics is None else dynamics.springs))
