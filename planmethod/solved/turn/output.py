"""The output of a mechanism: its path or angle, working stroke, pressure angle; roots."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.steps import PointName
from planmethod.errors import Fault, ProblemError
from planmethod.mechanism.groups import AssurGroup, OuterLeg
from planmethod.mechanism.model import FRAME, Revolute
from planmethod.plans.draft import cis
from planmethod.problem.machine_records import StrokeSense
from planmethod.problem.model import Problem, Slide
from planmethod.problem.records import Over, SizeTable
from planmethod.solved.forces.laws import only_in_positions
from planmethod.solved.forces.loads import external, power
from planmethod.solved.reading import Complexes, Flags, Reading, Reals
from planmethod.solved.solution import Solution

SAMPLES = 720
"""Number of positions of a turn over which the work of a stroke is summed."""

EQUAL_WORK_FRACTION = 1e-3
"""Fraction of the larger work below which the difference of the strokes is ignored."""

COUNTS = 0.05
"""Fraction of the working stroke's work from which a load is named as deciding."""

LONGER, TOLD = "longer stroke", "[cycle] working"
"""Criteria of the working stroke if no load decides."""

SENSES = {
    StrokeSense.UP: 1j,
    StrokeSense.DOWN: -1j,
    StrokeSense.LEFT: -1 + 0j,
    StrokeSense.RIGHT: 1 + 0j,
}
"""Unit vector of each sense of a point's motion."""


class Strokes(Struct, frozen=True):
    """Both strokes of an output (рабочий и холостой ход).

    Attributes
    ----------
    working_deg, idle_deg : float, degrees
        Of the crank.
    K_v : float or None
        Ratio of the longer stroke to the shorter, 1 or more; None where the output comes to an end
        of its stroke more than once.
    by : str
        Criterion of the working stroke: ``load P``, ``longer stroke`` or ``[cycle] working``.
    start_deg : float, degrees
        Driver position where the working stroke starts.
    """

    working_deg: float
    idle_deg: float
    K_v: float | None
    by: str
    start_deg: float


def powers(solution: Solution, start: float, positions: Reals) -> dict[str, Reals]:
    """Return the power of the loads on driven links, W, shape (n,), by name.

    Parameters
    ----------
    start : float, degrees
        Position 0 of the cycle, before it is determined.
    positions : ndarray of shape (n,)
    """
    problem = solution.problem
    dynamics = problem.dynamics
    if dynamics is None or not problem.drive.rate:
        return {}
    counted = replace(problem, numbered=problem.numbered or (start,))
    moved = Solution(counted, positions=positions.tolist(), construction=solution.construction)
    found: dict[str, Reals] = {}
    for link in problem.mechanism.links:
        if link == problem.drive.link:
            continue
        for one in external(moved, dynamics, link):
            found[one.name] = np.nan_to_num(power(moved, one))
    return found


def sample_positions(problem: Problem, start: float, turns: int) -> Reals:
    """Return the equally spaced positions of the sum of work; none where it is not known.

    Loads that are known in the positions of the file only are summed over the numbered ones.
    """
    dynamics = problem.dynamics
    if dynamics is None or not dynamics.loads:
        return np.zeros(0)
    if only_in_positions(dynamics):
        own = problem.numbered if problem.numbered == problem.drive.positions else ()
        return np.asarray(own, dtype=float)
    return start + 360.0 * turns * (np.arange(SAMPLES * turns) + 0.5) / (SAMPLES * turns)


def over_strokes(problem: Problem) -> bool:
    """Return whether a load is given over the strokes of the cycle, as an indicator diagram."""
    loads = () if problem.dynamics is None else problem.dynamics.loads
    sizes = (load.size for load in loads)
    return any(isinstance(size, SizeTable) and size.over is Over.STROKES for size in sizes)


def by_loads(load_powers: dict[str, Reals], first: Flags) -> tuple[bool, str] | None:
    """Return whether the first stroke works, and the deciding loads; None if none decides.

    Parameters
    ----------
    load_powers : dict of str to ndarray of shape (n,)
        Power of every load in even positions.
    first : ndarray of bool, shape (n,)
        Which of them are of the first stroke.
    """
    works = {name: np.array([power[first].sum(), power[~first].sum()])
             for name, power in load_powers.items()}  # fmt: skip
    both = sum(works.values(), np.zeros(2))
    if abs(both[0] - both[1]) <= EQUAL_WORK_FRACTION * float(np.max(np.abs(both))):
        return None
    sign = -1.0 if both.sum() < 0.0 else 1.0
    stroke = int(np.argmax(sign * both))
    least = COUNTS * abs(both[stroke])
    names = [name for name, work in works.items() if sign * work[stroke] > least]
    return stroke == 0, f"load{'s' if len(names) > 1 else ''} {', '.join(names)}"


Pressure = Callable[[Reading], Reals]
"""From a reading to the pressure angle, degrees from 0 to 90, ndarray of shape (n,)."""


class Output(Struct, frozen=True):
    """Output of a mechanism (выход механизма).

    Attributes
    ----------
    name : str
        The point, or the link.
    link : str
    point : str
        Observed point: of a slider the one that moves along the guide; of a link that turns one
        that is off its pivot.
    slide : Slide or None
        The guide; None for a link whose angle is the output.
    """

    name: str
    link: str
    point: str
    slide: Slide | None

    @property
    def unit(self) -> str:
        """Unit of the value: m along the guide from its base point, or degrees from +x."""
        return "m" if self.slide is not None else "deg"

    @property
    def per_radian(self) -> float:
        """Units of the value per unit of its rates: the value of a turning link is in degrees.

        The rates are m and m, or radians, per radian of the crank.
        """
        return 1.0 if self.slide is not None else float(np.degrees(1.0))

    def value(self, solution: Solution, reading: Reading) -> Reals:
        """Return the value in every position; an angle within a turn."""
        if self.slide is None:
            return np.degrees(
                np.angle(reading.line_vector(solution.construction.draft.axes[self.link]))
            )
        along = cis(self.slide.angle)
        place = reading.point(PointName(self.point)) + solution.construction.draft.origin
        return np.asarray(((place - self.slide.base) * np.conj(along)).real)

    def rates(self, solution: Solution, reading: Reading) -> tuple[Reals, Reals]:
        """Return the first and second rate: m/s and m/s², or 1/s and 1/s²."""
        kinematics = solution.construction.kinematics
        if self.slide is None:
            names = (kinematics.omega.get(self.link), kinematics.epsilon.get(self.link))
            zero = np.zeros(reading.count)
            one, two = (zero if name is None else reading.number(name) for name in names)
            return one, two
        back = np.conj(cis(self.slide.angle))
        plans = (kinematics.velocity, kinematics.acceleration)
        ends = [reading.point(motion.point[motion.named[self.point]]) for motion in plans]
        return np.asarray((ends[0] * back).real), np.asarray((ends[1] * back).real)


def find_output(solution: Solution) -> Output:
    """Return the output that ``[cycle]`` names, else the last link that is joined with the frame.

    Raises
    ------
    ProblemError
        No link but the driver is joined with the frame, and the file names no output.
    """
    problem = solution.problem
    asked = problem.cycle.output if problem.cycle is not None else None
    guided = {slide.slider: slide for slide in problem.slides.values() if slide.host == FRAME}
    fixed = problem.bodies[FRAME].points
    if asked is not None and asked in problem.mechanism.links:
        return _of_link(solution, asked, guided.get(asked))
    if asked is not None:
        link = next(link for link in guided if asked in problem.bodies[link].points)
        return Output(asked, link, asked, guided[link])
    for group in reversed(solution.structure.groups):
        for link in reversed(group.links):
            points = problem.bodies[link].points
            if link in guided or (any(p in fixed for p in points) and len(points) > 1):
                return _of_link(solution, link, guided.get(link))
    raise ProblemError(
        problem.name,
        [Fault("cycle.output", "no driven link is joined with the frame", "Name a link.")],
    )


def _of_link(solution: Solution, link: str, slide: Slide | None) -> Output:
    fixed, points = solution.problem.bodies[FRAME].points, solution.problem.bodies[link].points
    if slide is not None:
        return Output(link, link, slide.pin, slide)
    free = [point for point in points if point not in fixed]
    return Output(link, link, (free or list(points))[0], None)


# Pressure angle ----------------------------------------------------------------------------------


def pressure_on(solution: Solution, output: Output) -> Pressure | None:
    """Return a function that gives the pressure angle (угол давления) on the output link.

    It is the angle between the force of the other link of its group, taken as weightless, and the
    velocity of the point of the output link on which it acts. None if the output link does not
    close a dyad on the frame, as a wheel that a mesh turns does not.
    """
    group = next(group for group in solution.structure.groups if output.link in group.links)
    if not group.is_dyad:
        return None
    own = next(lead for lead in group.legs if lead.link == output.link)
    other = next(lead for lead in group.legs if lead.link != output.link)
    force = _force(solution, group, other)
    if own.to != FRAME or force is None:
        return None
    acting, line = force
    axes = solution.construction.draft.axes

    def pressure(reading: Reading) -> Reals:
        if isinstance(own.joint, Revolute):
            arm = reading.vector(PointName(own.joint.point), acting)
            moving = arm * 1j
        else:
            moving = reading.line_vector(axes[own.joint.slider])
        turn = np.conj(line(reading)) * moving
        with np.errstate(invalid="ignore"):
            angle = np.degrees(np.arctan2(np.abs(turn.imag), np.abs(turn.real)))
        return np.asarray(np.where(turn == 0, np.nan, angle))

    return pressure


def _force(
    solution: Solution, group: AssurGroup, outer_leg: OuterLeg
) -> tuple[PointName, Callable[[Reading], Complexes]] | None:
    """Return the point on which a weightless link acts, and a function giving its line of force."""
    axes, inner, outer = solution.construction.draft.axes, group.inner[0], outer_leg.joint
    if isinstance(inner, Revolute):
        acting = PointName(inner.point)
        if isinstance(outer, Revolute):
            tail = PointName(outer.point)
            return acting, lambda reading: reading.vector(tail, acting)
        across = axes[outer.slider]
    elif isinstance(outer, Revolute):
        acting, across = PointName(outer.point), axes[inner.slider]
    else:
        return None
    return acting, lambda reading: reading.line_vector(across) * 1j
