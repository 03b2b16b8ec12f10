"""Rates of the driver that follow from an output or from a load (аналоги скоростей, приведение).

The mechanism is solved with its driver at one radian (or metre) a second: its velocities are the
derivatives by the driver's coordinate. The balance of the loads is linear in the acceleration of
the driver, and its slope is the reduced inertia.
"""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace

from planmethod.errors import AssemblyError, Fault, ProblemError
from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.plans.draft import cis
from planmethod.problem.model import Drive, FoundRates, Problem
from planmethod.solved.solution import Solution

_DEAD = 1e-6
"""Share of the largest derivative below which an output does not move."""

_ENOUGH = 1e-14
_CORRECTIONS = 60
_NO_INERTIA = 1e-13
"""Share of the balance by which it must change with the acceleration."""


def find_rates(problem: Problem) -> Problem:
    """Return a problem with the rates of its driver that an output or a load determines.

    Raises
    ------
    AssemblyError
        The output is in a dead position.
    ProblemError
        The load moves no inertia.
    """
    drive = problem.drive
    if drive.output_rate is None and drive.actuator is None:
        return problem if drive.effort is None else _accelerated(problem, FoundRates())
    single = replace(drive, positions=drive.positions[:1], rate=1.0, acceleration=0.0)
    of = Solution(replace(problem, drive=single, dynamics=None))
    first, second, size = output_motion(of, drive)
    if not abs(first) > _DEAD * size:
        raise AssemblyError(_dead(problem, drive))
    speed, gain = rates_of_output(drive)
    rate, acceleration = speed / first, drive.acceleration
    if gain is not None:
        acceleration = (gain - second * rate**2) / first
    rates = FoundRates(first, second)
    problem = replace(
        problem, drive=replace(drive, rate=rate, acceleration=acceleration, found_rates=rates)
    )
    return problem if drive.effort is None else _accelerated(problem, rates)


def rates_of_output(drive: Drive) -> tuple[float, float | None]:
    """Return the rate and the acceleration of the output that determines those of a driver."""
    if drive.output_rate is not None:
        return drive.output_rate.rate, drive.output_rate.gain
    assert drive.posed is not None
    return drive.posed.rates


def output_motion(solution: Solution, drive: Drive) -> tuple[float, float, float]:
    """Return rate and acceleration of the output of a driver, and the size of such rates.

    At one radian (or metre) a second of the driver they are its derivatives by the coordinate.

    Parameters
    ----------
    solution : Solution
        In one position.
    drive : Drive
        Driver with an output rate, or an actuator.
    """
    points, links = solution.points, solution.links
    fastest = max(float(abs(one.velocity[0])) for one in points.values())
    given = drive.output_rate
    if given is None:
        one, two = drive.actuator or ("", "")
        place, velocity, acceleration = (
            complex(getattr(points[two], part)[0] - getattr(points[one], part)[0])
            for part in ("place", "velocity", "acceleration")
        )
        length = abs(place)
        along = (velocity * place.conjugate()).real / length
        curve = (acceleration * place.conjugate()).real / length
        curve += (abs(velocity) ** 2 - along**2) / length
        return along, curve, abs(velocity)
    if given.kind == "omega":
        turns = [
            (float(links[k].omega[0]), float(links[k].epsilon[0])) for k in given.of.split("_")
        ]
        (w, e), (before, gain) = turns[-1], turns[0] if len(turns) > 1 else (0.0, 0.0)
        return w - before, e - gain, max(float(abs(one.omega[0])) for one in links.values())
    velocity, acceleration = (
        complex(getattr(points[given.of], part)[0]) for part in ("velocity", "acceleration")
    )
    way = {"vx": 1.0 + 0j, "vy": 1j}.get(given.kind) or guide_of_point(solution.problem, given.of)
    if way is None:
        return abs(velocity), 0.0, fastest
    along, curve = ((one * way.conjugate()).real for one in (velocity, acceleration))
    return along, curve, fastest


def guide_of_point(problem: Problem, point: str) -> complex | None:
    """Return the direction of the guide of the frame that a slider has in a point."""
    for slide in problem.slides.values():
        if slide.host == FRAME and slide.pin == point:
            return complex(cis(slide.angle))
    return None


def _dead(problem: Problem, drive: Drive) -> str:
    """Return why no rate of the driver gives the output its rate."""
    if drive.output_rate is None:
        posed = drive.posed
        assert posed is not None
        return translate(
            "{}: at {} = {:.5g} m the actuator is in a dead position: "
            "{} does not change while link {} moves. Give another length.",
            problem.name,
            posed.of,
            posed.values[0],
            posed.of,
            drive.link,
        )
    place = drive.coordinate.format_value(drive.positions[0], problem.unit, 5)
    return translate(
        "{}: at {} the output is in a dead position: {} is 0 at any speed of link {}. "
        "Give another position, or the speed of the link.",
        problem.name,
        place,
        drive.output_rate.key,
        drive.link,
    )


def _accelerated(problem: Problem, rates: FoundRates) -> Problem:
    """Return a problem whose driver accelerates as its load makes it."""
    from planmethod.solved.forces.friction import Friction  # motion needs no forces
    from planmethod.solved.forces.statics import Statics

    drive = problem.drive
    assert drive.effort is not None
    single = replace(drive, positions=drive.positions[:1])

    def balance(acceleration: float) -> float:
        at = Solution(replace(problem, drive=replace(single, acceleration=acceleration)))
        dynamics = problem.dynamics
        if dynamics is not None and dynamics.friction is not None:
            return float(Friction(at).converged.balance[0])
        statics = Statics(at)
        return float((statics.balance if statics.moment is None else statics.moment)[0])

    load = balance(0.0)
    inertia = balance(1.0) - load
    if not abs(inertia) > _NO_INERTIA * abs(load):
        hint = "Give masses that move, or the acceleration in place of the load."
        message = translate("no inertia is reduced to link {}", drive.link)
        raise ProblemError(problem.name, [Fault("dynamics", message, translate(hint))])
    acceleration, slope = (drive.effort - load) / inertia, inertia
    # With friction it is not linear; without, this removes the rounding of a small difference.
    for _ in range(_CORRECTIONS):
        missing = balance(acceleration) - drive.effort
        size = abs(drive.effort) + abs(load) + abs(slope * acceleration)
        if not np.isfinite(missing) or abs(missing) <= _ENOUGH * size:
            break
        step = missing / slope
        if abs(step) <= _ENOUGH * abs(acceleration):
            break
        acceleration -= step
    rates = replace(rates, load=load, inertia=inertia)
    return replace(problem, drive=replace(drive, acceleration=acceleration, found_rates=rates))
