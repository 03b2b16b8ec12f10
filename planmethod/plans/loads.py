"""Given and inertia forces on the links in every position (заданные силы и силы инерции)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt

from planmethod.errors import Fault, ProblemError
from planmethod.plans.solution import Complexes, Reals, Solution
from planmethod.problem.bodies import rotation
from planmethod.problem.load_records import (
    Against,
    Couple,
    Dynamics,
    Fixed,
    Interpolation,
    Load,
    Mass,
    Moving,
    Over,
    Phase,
    Table,
    Turning,
)

STILL = 1e-10
"""Share of the largest speed of a position below which a point or a link stands."""

SLACK = 1e-9
"""Rounding of an abscissa, degrees, or as a share of a table's span."""

TURN = 360.0

_AHEAD = {Moving.UP: 1j, Moving.DOWN: -1j, Moving.LEFT: -1 + 0j, Moving.RIGHT: 1 + 0j}

Mask = npt.NDArray[np.bool_]


class LoadKind(Enum):
    """Kind of a load (вид нагрузки)."""

    WEIGHT = "weight"
    INERTIA = "inertia"
    INERTIA_COUPLE = "inertia couple"
    EXTERNAL = "external"


@dataclass(frozen=True, slots=True)
class Applied:
    """One force or couple on a link in every position (приложенная нагрузка).

    Attributes
    ----------
    name : str
        Letter in rich text: ``G_{2}``, ``Φ_{2}``, ``M_{Φ2}``, or that of the external load.
    link : str
    point : str or None
        Name of the point where the force acts; None for a couple.
    force : ndarray of shape (n,), N
        Complex; zero for a couple.
    couple : ndarray of shape (n,), N·m
        Counter-clockwise positive; zero for a force.
    kind : LoadKind
    """

    name: str
    link: str
    point: str | None
    force: Complexes
    couple: Reals
    kind: LoadKind


def applied(solution: Solution) -> tuple[Applied, ...]:
    """Return all that acts on the links beside the reactions, link by link.

    A link has its weight, the main vector of its inertia forces Φ = -m·a_S (главный вектор сил
    инерции), their main moment M_Φ = -J·ε (главный момент), then its external loads in file order.
    What is zero by nature is left out: inertia of what cannot accelerate, loads of size zero.

    Raises
    ------
    ProblemError
        A load is known in the positions of the file only, and others are asked.
    """
    dynamics = solution.problem.dynamics
    if dynamics is None:
        return ()
    found: list[Applied] = []
    for link in solution.problem.mechanism.links:
        mass = dynamics.masses.get(link)
        if mass is not None:
            found += _of_mass(solution, dynamics.gravity, link, mass)
        found += _external(solution, dynamics, link)
    return tuple(found)


def _force(
    solution: Solution, name: str, link: str, point: str, force: Complexes | complex, kind: LoadKind
) -> Applied:
    shape = solution.positions.shape
    whole = np.array(np.broadcast_to(force, shape), dtype=complex)
    return Applied(name, link, point, whole, np.zeros(shape), kind)


def _couple(solution: Solution, name: str, link: str, couple: Reals, kind: LoadKind) -> Applied:
    zero = np.zeros(solution.positions.shape, dtype=complex)
    return Applied(name, link, None, zero, couple, kind)


# Weight and inertia ------------------------------------------------------------------------------


def _of_mass(solution: Solution, gravity: float, link: str, mass: Mass) -> Iterator[Applied]:
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


def _stands(solution: Solution) -> bool:
    """Whether the driver stands, and all links with it."""
    drive = solution.problem.drive
    return drive.rate == 0 and drive.acceleration == 0


def _may_accelerate(solution: Solution, link: str, point: str) -> bool:
    drive, plan = solution.problem.drive, solution.construction.kinematics.acceleration
    even = link == drive.link and not drive.is_crank and drive.acceleration == 0
    return not even and not _stands(solution) and plan.point[link, point] != plan.pole


def _may_turn_unevenly(solution: Solution, link: str) -> bool:
    return not _stands(solution) and link in solution.construction.kinematics.epsilon


# External loads ----------------------------------------------------------------------------------


def _external(solution: Solution, dynamics: Dynamics, link: str) -> Iterator[Applied]:
    for index, load in enumerate(dynamics.loads):
        if load.link != link or _is_nothing(solution, load):
            continue
        size = _size(solution, load, index)
        if load.phase is not None:
            size = np.where(_acts(solution, load, load.phase), size, 0.0)
        if isinstance(load, Load):
            force = np.asarray(size * _direction(solution, load), dtype=complex)
            yield _force(solution, load.name, link, load.at, force, LoadKind.EXTERNAL)
        else:
            if load.sense is not None:
                size = -size * _turning(solution, link)
            yield _couple(solution, load.name, link, size, LoadKind.EXTERNAL)


def _is_nothing(solution: Solution, load: Load | Couple) -> bool:
    """Whether a load is zero by nature: of size zero, or against what never moves."""
    if load.size == 0:
        return True
    if not isinstance(load.sense, Against):
        return False
    turns = isinstance(load, Load) or load.link in solution.construction.kinematics.omega
    return _stands(solution) or not turns


def _direction(solution: Solution, load: Load) -> Complexes | complex:
    """Return the unit vector of a force; zero where it resists a point that stands."""
    if isinstance(load.sense, Fixed):
        return rotation(load.sense.angle)
    velocity = solution.points[load.at].velocity
    speed = np.abs(velocity)
    moves = speed > STILL * _largest_speed(solution)
    return np.where(moves, -velocity / np.where(moves, speed, 1.0), 0.0)


def _turning(solution: Solution, link: str) -> Reals:
    """Return the sense of a link's rotation: 1, -1, or 0 where it does not turn."""
    omega = solution.links[link].omega
    bodies = [solution.problem.bodies[name] for name in solution.problem.mechanism.links]
    reach = max(abs(z) for body in bodies for z in body.points.values())
    speeds = [np.abs(motion.omega) for motion in solution.links.values()]
    largest = np.max([*speeds, _largest_speed(solution) / (reach or 1.0)], axis=0)
    return np.where(np.abs(omega) > STILL * largest, np.sign(omega), 0.0)


def _largest_speed(solution: Solution) -> Reals:
    """Return the largest speed of a named point in each position, m/s."""
    speeds = [np.abs(motion.velocity) for motion in solution.points.values()]
    return np.asarray(np.max(speeds, axis=0), dtype=float)


def _acts(solution: Solution, load: Load | Couple, phase: Phase) -> Mask:
    """Whether a load acts, position by position."""
    acts = np.ones(solution.positions.shape, dtype=bool)
    if phase.phi:
        spans = [_within(solution.positions, *span) for span in phase.phi]
        acts &= np.any(spans, axis=0)
    if phase.moving is not None and isinstance(load, Load):
        ahead = (solution.points[load.at].velocity * _AHEAD[phase.moving].conjugate()).real
        acts &= ahead > STILL * _largest_speed(solution)
    if phase.turning is not None:
        sign = 1.0 if phase.turning is Turning.CCW else -1.0
        acts &= _turning(solution, load.link) == sign
    return acts


def _within(phi: Reals, start: float, end: float) -> Mask:
    """Whether angles lie in a span, its ends included, degrees."""
    width = (end - start) % TURN or TURN
    return _from(phi, start) <= width + SLACK


def _from(phi: Reals, start: float) -> Reals:
    """Return angles counted from a start, degrees in [0, 360); rounding leaves the start 0."""
    turned = np.mod(phi - start, TURN)
    return np.where(turned > TURN - SLACK, 0.0, turned)


# Tables ------------------------------------------------------------------------------------------


def _size(solution: Solution, load: Load | Couple, index: int) -> Reals:
    """Return the size of a load in every position, N or N·m."""
    size = load.size
    if not isinstance(size, Table):
        return np.full(solution.positions.shape, size)
    match size.over:
        case Over.POSITION:
            what = "force" if isinstance(load, Load) else "couple"
            return np.asarray(size.values)[_numbers(solution, f"loads[{index}].{what}")]
        case Over.PHI:
            return _periodic(size, solution.positions)
        case Over.S:
            return _read(size, solution.positions)
        case Over.X | Over.Y:
            assert isinstance(load, Load), "a couple has no point"
            place = solution.points[load.at].place
            return _read(size, place.real if size.over is Over.X else place.imag)


def _periodic(table: Table, phi: Reals) -> Reals:
    """Read a table that repeats with every turn."""
    start = table.at[0]
    at = tuple(node - start for node in table.at)
    values = table.values
    if at[-1] < TURN:
        at, values = (*at, TURN), (*values, values[0])
    return _read(Table(table.over, at, values, table.interpolation), _from(phi, start))


def _read(table: Table, at: Reals) -> Reals:
    """Read a table; beyond its ends it keeps their values."""
    nodes, values = np.asarray(table.at), np.asarray(table.values)
    if table.interpolation is Interpolation.LINEAR:
        return np.asarray(np.interp(at, nodes, values), dtype=float)
    slack = SLACK * (nodes[-1] - nodes[0])
    row = np.searchsorted(nodes, at + slack, side="right") - 1
    return np.asarray(values[np.maximum(row, 0)], dtype=float)


def _numbers(solution: Solution, path: str) -> npt.NDArray[np.intp]:
    """Tell which positions of the file the asked ones are.

    Raises
    ------
    ProblemError
        With the first one that is none of them.
    """
    own, asked = np.asarray(solution.problem.drive.positions), solution.positions
    if np.array_equal(own, asked):
        return np.arange(len(own))
    order = np.argsort(own, kind="stable")
    number = order[np.minimum(np.searchsorted(own[order], asked - SLACK), len(own) - 1)]
    strange = np.flatnonzero(~(np.abs(own[number] - asked) <= SLACK))
    if strange.size:
        what = "phi = {:g} deg" if solution.problem.drive.is_crank else "s = {:g} m"
        first = what.format(float(asked[strange[0]]))
        fault = Fault(
            f"{path}.values",
            f"given for the positions of the file, and {first} is none of them",
            "Give the table over phi, s, x or y, or ask the file's own positions.",
        )
        raise ProblemError(solution.problem.name, [fault])
    return number
