"""Zhukovsky lever (жёсткий рычаг Жуковского): the velocity plan turned by 90°, loaded with forces.

A force at a point of the mechanism, carried to the like-named point of the turned velocity plan,
has there a moment about the pole that is its power; together with that of the balancing moment they
sum to zero. A couple M on a link is represented by its pair of forces in the like-named points,
M·(bc)/l_BC each, which gives M times the link's angular velocity. A shifted inertia force acts at a
point of its link, which on the lever lies beside the centre of mass.
"""

from __future__ import annotations

from msgspec import Struct

from planmethod.construct.steps import NumberName, PointName
from planmethod.plans.forces.board import ForceBoard, GivenLoad
from planmethod.plans.forces.dyads import Driving
from planmethod.plans.forces.loads import Shift
from planmethod.plans.motion.legs import arm


class Lever(Struct, frozen=True):
    """The lever of a mechanism (рычаг Жуковского).

    Attributes
    ----------
    pole : PointName
    balance : NumberName
        Balancing moment on the crank, N·m, or force along the guide of a driving slider, or at a
        point of the crank, N.
    difference : NumberName
        Result of the lever minus that of the force plans.
    loads : tuple of LeverLoad
        Loads that do work.
    moment : NumberName or None
        Balancing moment on a crank, N·m, whatever balances it.
    arm : NumberName or None
        Arm about the pole of a force at a point of the crank that the file directs, mm.
    """

    pole: PointName
    balance: NumberName
    difference: NumberName
    loads: tuple[LeverLoad, ...] = ()
    moment: NumberName | None = None
    arm: NumberName | None = None


class LeverLoad(Struct, frozen=True):
    """Load on the lever; for a force its point of application, and its arm about the pole, mm."""

    load: GivenLoad
    at: PointName | None = None
    arm: NumberName | None = None


class Hung(Struct, frozen=True):
    """The given loads on the turned velocity plan.

    ``power`` is their power, W.
    """

    pole: PointName
    power: NumberName
    loads: tuple[LeverLoad, ...]


def hang_loads(board: ForceBoard) -> Hung | None:
    """Apply the given loads to the turned velocity plan; None if the driver is at rest."""
    b, motion, drive = board.draft.b, board.kinematics.velocity, board.draft.problem.drive
    if drive.rate == 0:
        return None
    pole = board.start()
    powers: list[NumberName] = []
    loads: list[LeverLoad] = []
    for given in board.given:
        link = given.applied.link
        if given.couple is not None:
            if link in board.kinematics.omega:
                turning = board.kinematics.omega[link]
                powers.append(b.compute(board.name("P"), (given.couple, 1), (turning, 1)))
                loads.append(LeverLoad(given))
            continue
        assert given.force is not None and given.applied.point is not None
        at = motion.point[motion.named[given.applied.point]]
        if at == motion.pole:
            continue
        turned = b.carry(board.name("z"), pole, motion.pole, at, rotated=True)
        shift = board.shifts.get(link)
        if shift is not None and given.force.at == shift.at:
            turned = _shifted_point(board, shift, turned)
        arm = b.measure_arm(board.name("h"), pole, turned, *given.force.ends)
        loads.append(LeverLoad(given, turned, arm))
        # The plan is turned by +90°: a moment on it is the power with the other sign.
        factors = ((arm, 1), (board.size(given.force), 1), (motion.segments.scale, 1))
        powers.append(b.compute(board.name("P"), *factors, factor=-1.0))
    return Hung(pole, b.total(board.name("P"), *powers), tuple(loads))


def plan_lever(board: ForceBoard, driving: Driving) -> Lever | None:
    """Find the balance of the driving link on the lever; None if the driver is at rest."""
    hung, b, drive = hang_loads(board), board.draft.b, board.draft.problem.drive
    if hung is None:
        return None
    pole, whole, rate = hung.pole, hung.power, NumberName(drive.coordinate.rates[0])
    balance = moment = b.compute(board.name("M"), (whole, 1), (rate, -1), factor=-1.0)
    measured: NumberName | None = None
    if drive.pivot is not None and driving.force is not None:
        balance, measured = _of_force(board, driving, drive.pivot, pole, whole, moment)
    off = b.total(board.name("d"), balance, board.negative(driving.balance))
    return Lever(pole, balance, off, hung.loads, moment if drive.is_crank else None, measured)


def weigh_actuator(board: ForceBoard, hung: Hung, ends: tuple[str, str]) -> Lever:
    """Find on the lever the force of an actuator, a pair of forces in the points of its two ends.

    The force plans have it from here: their difference is not known yet.
    """
    b, motion = board.draft.b, board.kinematics.velocity
    one, two = (
        b.carry(
            board.name("z"), hung.pole, motion.pole, motion.point[motion.named[end]], rotated=True
        )
        for end in ends
    )
    arm = b.measure_arm(board.name("h"), one, two, *map(PointName, ends))
    powers = ((hung.power, 1), (arm, -1), (motion.segments.scale, -1))
    balance = board.segments.compute("F_lever", *powers)
    return Lever(hung.pole, balance, balance, hung.loads, arm=arm)


def _of_force(
    board: ForceBoard,
    driving: Driving,
    pivot: str,
    pole: PointName,
    total_power: NumberName,
    moment: NumberName,
) -> tuple[NumberName, NumberName | None]:
    """Return the force at a point of the crank that balances the lever, and its arm if measured.

    Across the crank that is the velocity of its point, which was laid off.
    """
    b, motion, drive = board.draft.b, board.kinematics.velocity, board.draft.problem.drive
    assert driving.force is not None
    at = driving.force.at
    if driving.direction is None:
        length = arm(board.draft, drive.link, pivot, str(at)).length
        over = ((name, -power) for name, power in length)
        return b.compute(board.name("F"), (moment, 1), *over), None
    hung = b.carry(
        board.name("z"), pole, motion.pole, motion.point[drive.link, str(at)], rotated=True
    )
    measured = b.measure_arm(board.name("h"), pole, hung, *driving.direction)
    powers = ((total_power, 1), (measured, -1), (motion.segments.scale, -1))
    return b.compute(board.name("F"), *powers), measured


def _shifted_point(board: ForceBoard, shift: Shift, centre: PointName) -> PointName:
    """Return the point t of a shifted force: ω·h off the centre of mass, parallel to h.

    On the turned plan the relative velocity lies along the link, against it where that goes
    counter-clockwise.
    """
    b, motion = board.draft.b, board.kinematics.velocity
    turning = board.kinematics.omega[shift.link]
    powers = ((turning, 1), (board.draft.mu_l, 1), (motion.segments.scale, -1))
    times = b.compute(board.name("k"), *powers, factor=-1.0)
    return b.carry(board.name("t"), centre, shift.centre, shift.at, shift.length, times=times)
