"""Referee of the force plans: all links at once, three equations each; no plans and no dyads.

The reactions in all joints and the balancing moment are the unknowns of one linear system: two
forces in a revolute pair, a force across the guide and a moment about the pin in a prismatic one.
It is written in numbers of any type: float64, or those of mpmath.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from doors import (
    FRAME,
    Against,
    Drive,
    Fixed,
    Load,
    ModelProblem as Problem,
    OtherDrive,
    Slide,
    Spring,
    Statics,
)
from newton import Motion

Number = Any
Joint = tuple[str, str, str]
"""Point or pin, the link that the force acts on, the link that exerts it."""


@dataclass(frozen=True)
class Acting:
    """Force at a place of a link, and a couple on it: N, m, N·m."""

    link: str
    force: Number
    at: Number
    couple: Number


@dataclass(frozen=True)
class Pose:
    """Places of the points of links, by (link, point), and unit vectors along the guides."""

    place: Callable[[str, str], Number]
    along: Callable[[Slide], Number]


@dataclass(frozen=True)
class Answer:
    """Force and moment about the joint's point or pin, by joint; the balancing moment or force."""

    joints: dict[Joint, tuple[Number, Number]]
    balance: Number

    @property
    def largest(self) -> float:
        """Largest reaction, N."""
        return max(float(abs(force)) for force, _ in self.joints.values())


@dataclass(frozen=True)
class _Unknown:
    """Effect of an unknown of size one: a force at a place and a couple, and back on ``by``."""

    joint: Joint
    at: Number
    force: Number
    couple: float


def cross(a: Number, b: Number) -> Number:
    """Return the moment of ``b`` on the arm ``a``."""
    return (a.conjugate() * b).imag


def slide_between(problem: Problem, joint: Joint) -> Slide | None:
    """Return the guide if the joint is a prismatic pair."""
    point, on, by = joint
    for slider, host in ((on, by), (by, on)):
        slide = problem.slides.get(slider)
        if slide is not None and slide.host == host and slide.pin == point:
            return slide
    return None


Ends = tuple[tuple[str, str], tuple[str, str]]
"""Point and body of the first end of an actuator, and of the second."""


def _unknowns(
    problem: Problem, joints: Iterable[Joint], pose: Pose, ends: Ends | None
) -> list[_Unknown]:
    found = []
    for joint in joints:
        slide = slide_between(problem, joint)
        if slide is None:
            at = pose.place(joint[1], joint[0])
            found += [_Unknown(joint, at, 1.0 + 0j, 0.0), _Unknown(joint, at, 1j, 0.0)]
        else:
            at = pose.place(slide.slider, slide.pin)
            found += [
                _Unknown(joint, at, pose.along(slide) * 1j, 0.0),
                _Unknown(joint, at, 0j, 1.0),
            ]
    found += [_driving(problem, pose, other) for other in problem.drive.other_drives]
    return [
        *found,
        _driving(problem, pose, problem.drive) if ends is None else _pushing(problem, pose, ends),
    ]


def _pushing(problem: Problem, pose: Pose, ends: Ends) -> _Unknown:
    """Return the force of an actuator: on its second end, and back on the first, in one line."""
    (one, body), (two, other) = ends

    def place(point: str) -> Number:
        for link in problem.mechanism.links:
            if point in problem.bodies[link].points:
                return pose.place(link, point)
        return problem.bodies[FRAME].points[point]

    apart = place(two) - place(one)
    return _Unknown(("", other, body), place(two), apart / abs(apart), 0.0)


def _driving(problem: Problem, pose: Pose, drive: Drive | OtherDrive) -> _Unknown:
    joint = (f"driver {drive.link}" if drive is not problem.drive else "", drive.link, FRAME)
    if drive.pivot is not None:
        return _Unknown(joint, pose.place(drive.link, str(drive.pivot)), 0j, 1.0)
    slide = problem.slides[drive.link]
    return _Unknown(joint, pose.place(drive.link, slide.pin), pose.along(slide), 0.0)


def solve_all(
    problem: Problem,
    joints: Sequence[Joint],
    pose: Pose,
    loads: Iterable[Acting],
    context: Any = None,
    ends: Ends | None = None,
    motor: tuple[str, str] | None = None,
) -> Answer:
    """Solve the equilibrium of all moving links at once.

    Parameters
    ----------
    joints : sequence of (point, on, by)
        Every pair once.
    context : mpmath context, optional
        Arithmetic of the solver. Default: numpy.
    ends : Ends, optional
        An actuator that drives between two bodies, in place of the driving link's couple or force.
    motor : (str, str), optional
        Links of a motor in place of it: its moment acts on the second, and back on the first.
    """
    row = {link: 3 * i for i, link in enumerate(problem.mechanism.links)}
    unknowns = _unknowns(problem, joints, pose, ends)
    if motor is not None:
        unknowns[-1] = _Unknown(("", motor[1], motor[0]), unknowns[-1].at, 0j, 1.0)
    count = 3 * len(row)
    assert len(unknowns) == count, "N_y = 3n equations, N_F = 2p + W unknowns"
    about = unknowns[-1].at
    zero = 0.0 if context is None else context.zero
    matrix = [[zero] * count for _ in range(count)]
    right = [zero] * count
    for column, unknown in enumerate(unknowns):
        moment = cross(unknown.at - about, unknown.force) + unknown.couple
        for link, sign in ((unknown.joint[1], 1), (unknown.joint[2], -1)):
            if link != FRAME:
                parts = (unknown.force.real, unknown.force.imag, moment)
                for k, part in enumerate(parts):
                    matrix[row[link] + k][column] += sign * part
    for load in loads:
        moment = cross(load.at - about, load.force) + load.couple
        for k, part in enumerate((load.force.real, load.force.imag, moment)):
            right[row[load.link] + k] -= part
    if context is None:
        values: Any = np.linalg.solve(np.array(matrix), np.array(right))
    else:
        values = context.lu_solve(context.matrix(matrix), context.matrix(right))
    sums: dict[Joint, tuple[Number, Number]] = {}
    for unknown, value in zip(unknowns[:-1], values, strict=False):
        force, moment = sums.get(unknown.joint, (0j, 0.0))
        sums[unknown.joint] = (force + unknown.force * value, moment + unknown.couple * value)
    return Answer(sums, values[count - 1])


def check_reactions(
    problem: Problem, statics: Statics, motion: Motion, answer: Answer, limit: float
) -> None:
    """Compare the reactions of force plans with those of all links at once.

    ``limit`` is the largest difference of a force, N; of a moment it is that on an arm as long as
    the mechanism reaches.
    """
    size = max(1.0, *(abs(place) for place in motion.position.values()))
    for r in statics.reactions:
        joint = (r.joint, r.on, r.by)
        force, moment = answer.joints[joint]
        assert abs(r.force[0] - force) <= limit, joint
        slide, found = slide_between(problem, joint), r.moment[0]
        if slide is not None:
            found += cross(r.at[0] - motion.position[slide.slider, slide.pin], r.force[0])
        assert abs(found - moment) <= limit * size, joint


# By Newton's method ------------------------------------------------------------------------------


def pose_of(motion: Motion) -> Pose:
    """Return the pose that Newton's method found."""

    def along(slide: Slide) -> complex:
        host = 0.0 if slide.host == FRAME else motion.pose[slide.host][2]
        return cmath.rect(1.0, host + math.radians(slide.angle))

    return Pose(lambda link, point: motion.position[link, point], along)


def loads_of(problem: Problem, motion: Motion) -> list[Acting]:
    """Return weights, inertia, constant forces and couples, from the file and Newton's motion."""
    dynamics = problem.dynamics
    assert dynamics is not None
    found = []
    for link, mass in dynamics.masses.items():
        force, at = 0j, 0j
        if mass.centre is not None:
            at = motion.position[link, mass.centre]
            weight = -1j * mass.mass * dynamics.gravity
            force = weight - mass.mass * motion.acceleration[link, mass.centre]
        found.append(Acting(link, force, at, -mass.inertia * motion.epsilon[link]))
    speed = max(abs(v) for v in motion.velocity.values())
    fastest = max(speed, *(abs(omega) for omega in motion.omega.values()))  # of about a metre
    for load in dynamics.loads:
        if isinstance(load.size, Spring):
            continue
        assert isinstance(load.size, float) and load.phase is None
        if isinstance(load, Load):
            at = motion.position[load.link, load.at]
            if isinstance(load.sense, Fixed):
                along = cmath.rect(1.0, math.radians(load.sense.angle))
            else:
                along = _against(motion.velocity[load.link, load.at], speed)
            found.append(Acting(load.link, load.size * along, at, 0.0))
        else:
            size = load.size
            if isinstance(load.sense, Against):
                size *= _against(motion.omega[load.link], fastest).real
            found.append(Acting(load.link, 0j, 0j, size))
    return [*found, *springs_of(problem, motion)]


def springs_of(problem: Problem, motion: Motion) -> Iterator[Acting]:
    """Yield what springs with a free length or an angle of rest exert on both their links."""
    dynamics = problem.dynamics
    assert dynamics is not None
    for spring in dynamics.springs:
        one, two = spring.links
        if spring.joint is not None:
            turned = _turn(motion, two) - _turn(motion, one) - math.radians(spring.angle or 0.0)
            turned = math.remainder(turned, 2.0 * math.pi)
            rate = motion.omega.get(two, 0.0) - motion.omega.get(one, 0.0)
            moment = -spring.stiffness * turned - spring.damping * rate
            sizes = [(one, 0j, 0j, -moment), (two, 0j, 0j, moment)]
        else:
            (at, v), (to, w) = (
                _end(problem, motion, *end) for end in zip(spring.links, spring.points, strict=True)
            )
            length = math.hypot((to - at).real, (to - at).imag)
            rate = ((to - at).real * (w - v).real + (to - at).imag * (w - v).imag) / length
            pull = spring.stiffness * (length - (spring.length or 0.0)) + spring.damping * rate
            force = pull * (to - at) / length
            sizes = [(one, force, at, 0.0), (two, -force, to, 0.0)]
        yield from (Acting(*size) for size in sizes if size[0] != FRAME)


def _turn(motion: Motion, link: str) -> float:
    return 0.0 if link == FRAME else motion.pose[link][2]


def _end(
    problem: Problem, motion: Motion, link: str, point: str | complex
) -> tuple[complex, complex]:
    """Return place and velocity of an end of a spring."""
    if link != FRAME:
        return motion.position[link, str(point)], motion.velocity[link, str(point)]
    return point if isinstance(point, complex) else problem.bodies[FRAME].points[point], 0j


def _against(motion: complex, largest: float) -> complex:
    """Return the unit vector against a motion; zero where it is only rounding."""
    return -complex(motion) / abs(motion) if abs(motion) > 1e-9 * largest else 0j


def power_of(problem: Problem, motion: Motion, loads: Iterable[Acting]) -> list[float]:
    """Return the power of every load: N times m/s, N·m times 1/s."""
    powers = []
    for load in loads:
        point = next(iter(problem.bodies[load.link].points))
        omega = motion.omega[load.link]
        arm = load.at - motion.position[load.link, point]
        v = motion.velocity[load.link, point] + 1j * omega * arm
        force = (load.force.conjugate() * v).real if load.force else 0.0
        powers.append(force + load.couple * omega)
    return powers
