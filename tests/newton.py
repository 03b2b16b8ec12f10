"""Referee of the plans: all links at once by Newton's method, no plans and no Assur groups.

Every moving link has three unknowns, the place of its origin and the direction of its own axis.
A revolute joint makes points of links coincide; a prismatic pair keeps the slider's axis along
the line and its pin at the given offset from it; the driver follows its law. Velocities and
accelerations come from the same Jacobian. Everything is in SI, angles in radians.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from doors import FRAME, Drive, ModelProblem as Problem, OtherDrive

Pose = Mapping[str, tuple[float, float, float]]
"""Origin x, y in m and direction of the own axis in radians, by moving link."""

Vector = npt.NDArray[np.float64]
Place = tuple[str, str]
"""Link and point of it."""

STEPS = 50
"""Newton steps after which a pose counts as one that cannot be closed."""


class NotClosedError(ValueError):
    """Newton's method found no pose near the given one."""


@dataclass(frozen=True)
class Motion:
    """Places, velocities and accelerations of a mechanism in one position.

    ``position``, ``velocity`` and ``acceleration`` are by (link, point); the point of a host that
    lies under a slider's pin is there as (host, pin). ``closing`` is the largest residual, m or
    radians.
    """

    pose: dict[str, tuple[float, float, float]]
    position: dict[Place, complex]
    velocity: dict[Place, complex]
    acceleration: dict[Place, complex]
    omega: dict[str, float]
    epsilon: dict[str, float]
    closing: float


@dataclass(frozen=True)
class _State:
    """Coordinates of the links with their first derivatives."""

    index: dict[str, int]
    q: Vector
    qt: Vector

    def axis(self, link: str) -> complex:
        return 1 + 0j if link == FRAME else cmath.rect(1.0, self.q[self.index[link] + 2])

    def angle(self, link: str) -> float:
        return 0.0 if link == FRAME else float(self.q[self.index[link] + 2])

    def omega(self, link: str) -> float:
        return 0.0 if link == FRAME else float(self.qt[self.index[link] + 2])

    def at(self, link: str, local: complex) -> complex:
        if link == FRAME:
            return local
        i = self.index[link]
        return complex(self.q[i], self.q[i + 1]) + self.axis(link) * local

    def slope(self, link: str, local: complex) -> npt.NDArray[np.complex128]:
        """Derivatives of a point's place by all coordinates."""
        row = np.zeros(len(self.q), dtype=complex)
        if link != FRAME:
            i = self.index[link]
            row[i], row[i + 1], row[i + 2] = 1.0, 1j, 1j * self.axis(link) * local
        return row

    def turn(self, link: str) -> Vector:
        """Derivatives of the direction of a link by all coordinates."""
        row = np.zeros(len(self.q))
        if link != FRAME:
            row[self.index[link] + 2] = 1.0
        return row

    def velocity(self, link: str, local: complex) -> complex:
        return complex(self.slope(link, local) @ self.qt)

    def bend(self, link: str, local: complex) -> complex:
        """Acceleration of a point when all second derivatives are zero: the centripetal one."""
        return -(self.omega(link) ** 2) * self.axis(link) * local


@dataclass(frozen=True)
class _Constraint:
    """Scalar constraint: residual, Jacobian row, and other terms of its second derivative."""

    value: float
    row: Vector
    rest: float


def _index(problem: Problem) -> dict[str, int]:
    return {link: 3 * i for i, link in enumerate(problem.mechanism.links)}


def _constraints(problem: Problem, s: _State) -> Iterator[_Constraint]:
    """All constraints but the driver's, which `_drive` gives."""
    for joint in problem.mechanism.revolutes:
        first, *others = joint.links
        u = problem.bodies[first].points[joint.point]
        for other in others:
            w = problem.bodies[other].points[joint.point]
            gap = s.at(first, u) - s.at(other, w)
            row = s.slope(first, u) - s.slope(other, w)
            rest = s.bend(first, u) - s.bend(other, w)
            yield _Constraint(gap.real, row.real, rest.real)
            yield _Constraint(gap.imag, row.imag, rest.imag)
    for slide in problem.slides.values():
        alpha = math.radians(slide.angle)
        gap_angle = s.angle(slide.slider) - s.angle(slide.host) - alpha
        yield _Constraint(
            math.remainder(gap_angle, math.tau), s.turn(slide.slider) - s.turn(slide.host), 0.0
        )
        pin = problem.bodies[slide.slider].points[slide.pin]
        along = s.axis(slide.host) * cmath.rect(1.0, alpha)
        back = along.conjugate()
        d = s.at(slide.slider, pin) - s.at(slide.host, slide.base)
        d_row = s.slope(slide.slider, pin) - s.slope(slide.host, slide.base)
        d_rest = s.bend(slide.slider, pin) - s.bend(slide.host, slide.base)
        v = s.velocity(slide.slider, pin) - s.velocity(slide.host, slide.base)
        omega = s.omega(slide.host)
        # Across the line: Im(d·back). As the host turns, `back` has the derivative -iω·back.
        yield _Constraint(
            (d * back).imag - slide.offset,
            (d_row * back).imag - (d * back).real * s.turn(slide.host),
            (d_rest * back).imag - 2 * omega * (v * back).real - omega**2 * (d * back).imag,
        )


def _drives(problem: Problem, s: _State, position: float) -> list[_Constraint]:
    """Residuals of all drivers; the others are in their first positions."""
    found = [_drive(problem, s, position, problem.drive)]
    for other in problem.drive.other_drives:
        place = other.positions[0]
        place = place if other.pivot is None else math.radians(place)
        found.append(_drive(problem, s, place, other))
    return found


def _drive(problem: Problem, s: _State, position: float, drive: Drive | OtherDrive) -> _Constraint:
    """Residual of a driver; position in radians or metres."""
    if drive.pivot is not None:
        gap = math.remainder(s.angle(drive.link) - position, math.tau)
        return _Constraint(gap, s.turn(drive.link), 0.0)
    slide = problem.slides[drive.link]
    back = cmath.rect(1.0, -math.radians(slide.angle))
    pin = problem.bodies[drive.link].points[slide.pin]
    d = (s.at(drive.link, pin) - slide.base) * back
    return _Constraint(d.real - position, (s.slope(drive.link, pin) * back).real, 0.0)


def _si(problem: Problem, position: float) -> float:
    return math.radians(position) if problem.drive.is_crank else position


def _close(problem: Problem, position: float, start: Vector) -> tuple[Vector, float]:
    """Coordinates of the links near a start, and the closing error left."""
    index = _index(problem)
    q = start.copy()
    best = (q, math.inf)
    for _ in range(STEPS):
        s = _State(index, q, np.zeros_like(q))
        found = [*_constraints(problem, s), *_drives(problem, s, position)]
        values = np.array([c.value for c in found])
        error = float(np.abs(values).max())
        if error < best[1]:
            best = (q, error)
        elif best[1] < 1e-9:  # rounding only: no step makes it better any more
            break
        try:
            q = q - np.linalg.solve(np.array([c.row for c in found]), values)
        except np.linalg.LinAlgError as singular:
            raise NotClosedError(f"singular at {position}") from singular
    if not best[1] < 1e-9:
        raise NotClosedError(f"no pose at {position}: closing error {best[1]:g}")
    return best


def solve(problem: Problem, position: float, pose: Pose) -> Motion:
    """Solve one position of a mechanism near an approximate pose.

    Parameters
    ----------
    problem : Problem
    position : float
        As in `Drive.positions`: degrees for a crank, metres for a driving slider.
    pose : mapping
        Approximate place and direction of every moving link.

    Raises
    ------
    NotClosedError
        If no pose near the given one closes the mechanism.
    """
    index = _index(problem)
    links = problem.mechanism.links
    q, closing = _close(problem, _si(problem, position), _start(problem, pose))
    still = _State(index, q, np.zeros_like(q))
    rows = [c.row for c in _constraints(problem, still)]
    jacobian = np.array([*rows, *(one.row for one in _drives(problem, still, 0.0))])
    drivers: tuple[Drive | OtherDrive, ...] = (problem.drive, *problem.drive.other_drives)
    rates = np.zeros(len(q))
    rates[-len(drivers) :] = [one.rate for one in drivers]
    qt = np.linalg.solve(jacobian, rates)
    s = _State(index, q, qt)
    gains = [one.acceleration for one in drivers]
    right = np.array([-c.rest for c in _constraints(problem, s)] + gains)
    qtt = np.linalg.solve(jacobian, right)
    position_of: dict[Place, complex] = {}
    velocity_of: dict[Place, complex] = {}
    acceleration_of: dict[Place, complex] = {}
    for (link, point), local in _places(problem, s):
        position_of[link, point] = s.at(link, local)
        velocity_of[link, point] = s.velocity(link, local)
        acceleration_of[link, point] = complex(s.slope(link, local) @ qtt) + s.bend(link, local)
    return Motion(
        pose={k: (float(q[i]), float(q[i + 1]), float(q[i + 2])) for k, i in index.items()},
        position=position_of,
        velocity=velocity_of,
        acceleration=acceleration_of,
        omega={link: float(qt[index[link] + 2]) for link in links},
        epsilon={link: float(qtt[index[link] + 2]) for link in links},
        closing=closing,
    )


def residual(problem: Problem, position: float, pose: Pose) -> float:
    """Return the largest closing error of a pose, m or radians."""
    q = _start(problem, pose)
    s = _State(_index(problem), q, np.zeros_like(q))
    found = [*_constraints(problem, s), *_drives(problem, s, _si(problem, position))]
    return max(abs(c.value) for c in found)


def _start(problem: Problem, pose: Pose) -> Vector:
    return np.array([value for link in problem.mechanism.links for value in pose[link]])


def _places(problem: Problem, s: _State) -> Iterator[tuple[Place, complex]]:
    """Points of the moving links and, under the pins, the coincident points of the hosts."""
    for link in problem.mechanism.links:
        for point, local in problem.bodies[link].points.items():
            yield (link, point), local
    for slide in problem.slides.values():
        if slide.host != FRAME:
            pin = s.at(slide.slider, problem.bodies[slide.slider].points[slide.pin])
            yield (slide.host, slide.pin), (pin - s.at(slide.host, 0j)) / s.axis(slide.host)


def differentiate(
    problem: Problem, position: float, pose: Pose, *, step: float = 2e-4
) -> tuple[dict[Place, complex], dict[Place, complex]]:
    """Velocities and accelerations from positions alone, by central differences in time.

    Five positions at ``-2h .. 2h`` give the fourth order (Richardson's extrapolation of the
    ordinary central differences). Points that are fixed in a link only.

    Parameters
    ----------
    step : float
        Motion of the driver within h, as a share of a radian or of a metre.

    Returns
    -------
    velocity, acceleration : dict by (link, point)
    """
    drive = problem.drive
    index = _index(problem)
    scale = max(abs(drive.rate), math.sqrt(abs(drive.acceleration)), 1e-9)
    h = step / scale
    q0, _ = _close(problem, _si(problem, position), _start(problem, pose))
    points = [(link, name) for link in index for name in problem.bodies[link].points]
    rows = []
    for k in (-2, -1, 0, 1, 2):
        t = k * h
        asked = _si(problem, position) + drive.rate * t + drive.acceleration * t * t / 2
        s = _State(index, _close(problem, asked, q0)[0], np.zeros_like(q0))
        rows.append([s.at(link, problem.bodies[link].points[name]) for link, name in points])
    a, b, c, d, e = np.array(rows)
    velocity = (8 * (d - b) - (e - a)) / (12 * h)
    acceleration = (16 * (d + b) - (e + a) - 30 * c) / (12 * h * h)
    return (
        {place: complex(z) for place, z in zip(points, velocity, strict=True)},
        {place: complex(z) for place, z in zip(points, acceleration, strict=True)},
    )
