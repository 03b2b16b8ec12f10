"""Zhukovsky lever (жёсткий рычаг Жуковского), and the force of an actuator by it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.steps import NumberName, PointName
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME
from planmethod.plans.forces.board import Force, ForceBoard, GivenLoad
from planmethod.plans.forces.dyads import Driving, group_forces, resting_driver_forces, unbalanced
from planmethod.plans.forces.polygons import Shift
from planmethod.plans.motion.legs import arm
from planmethod.problem.model import Problem


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


def plan_lever(
    board: ForceBoard, driving: Driving, other_drivings: Sequence[Driving] = ()
) -> Lever | None:
    """Find the balance of the driving link on the lever; None if the driver is at rest.

    ``other_drivings`` are the balances of other driving links, which the force plans give.
    """
    hung, b, drive = hang_loads(board), board.draft.b, board.draft.problem.drive
    if hung is None:
        return None
    hung = add_other_balances(board, hung, other_drivings)
    pole, whole, rate = hung.pole, hung.power, NumberName(drive.coordinate.rates[0])
    balance = moment = b.compute(board.name("M"), (whole, 1), (rate, -1), factor=-1.0)
    measured: NumberName | None = None
    if drive.pivot is not None and driving.force is not None:
        balance, measured = _of_force(board, driving, drive.pivot, pole, whole, moment)
    off = b.total(board.name("d"), balance, board.negative(driving.balance))
    return Lever(pole, balance, off, hung.loads, moment if drive.is_crank else None, measured)


def add_other_balances(board: ForceBoard, hung: Hung, other_drivings: Sequence[Driving]) -> Hung:
    """Return the loads on the lever with the balances of other driving links among them."""
    b, whole = board.draft.b, hung.power
    others = board.draft.problem.drive.other_drives if other_drivings else ()
    for other, one in zip(others, other_drivings, strict=True):
        factors = ((one.balance, 1), (NumberName(other.program_inputs[1]), 1))
        whole = b.total(board.name("P"), whole, b.compute(board.name("P"), *factors))
    return replace(hung, power=whole)


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


_TRIED_MM = 100.0
"""Length of the trial force on the plans."""


class Trial(Struct, frozen=True):
    """Effect of a trial force on the driving link, where there is no lever.

    ``without`` is the load left there without it, N·m or N; the ``tried`` force, N, alone gives
    ``effect``.
    """

    without: NumberName
    tried: NumberName
    effect: NumberName


class Thrust(Struct, frozen=True):
    """Force of an actuator (сила гидроцилиндра).

    Attributes
    ----------
    value : NumberName
        N, positive where it pushes its ends apart.
    ends : (str, str)
        Its points.
    links : (str, str)
        Links that it acts on in the first and in the second of them.
    pushes : tuple of (str, Force)
        Its force on each moving link, applied at that end of the actuator.
    force : Force
        Its force at the second end.
    lever : Lever or None
        The lever that determines it.
    trial : Trial or None
        The trial that determines it if the driver is at rest.
    """

    value: NumberName
    ends: tuple[str, str]
    links: tuple[str, str]
    pushes: tuple[tuple[str, Force], ...]
    force: Force
    lever: Lever | None = None
    trial: Trial | None = None


def pushed_links(problem: Problem) -> tuple[str, str]:
    """Return the bodies on which an actuator acts in its two ends.

    They are its own cylinder and rod where the file has them: of two moving links one slides on the
    other, and each has one of the ends. Otherwise it is the frame at a fixed point, and at any
    other point the first link of the file that has it: the choice among the links joined by a pin
    affects only the reaction of that pin.
    """
    ends = problem.drive.actuator
    assert ends is not None
    bodies = problem.bodies
    for slide in problem.slides.values():
        if slide.host == FRAME:
            continue
        for one, two in ((slide.slider, slide.host), (slide.host, slide.slider)):
            if ends[0] in bodies[one].points and ends[1] in bodies[two].points:
                return one, two
    one, two = (
        FRAME
        if end in bodies[FRAME].points
        else next(link for link in problem.mechanism.links if end in bodies[link].points)
        for end in ends
    )
    return one, two


def find_thrust(board: ForceBoard, groups: Iterable[AssurGroup], *, hung: bool) -> Thrust:
    """Find the force of the actuator, and lay it off on both bodies that it acts on.

    ``hung``: all loads are on the lever.
    """
    problem, groups = board.draft.problem, tuple(groups)
    ends, links = problem.drive.actuator, pushed_links(problem)
    assert ends is not None
    on_lever = hang_loads(board) if hung else None
    if on_lever is not None:
        board.starts.remove(on_lever.pole)  # it comes after those of the plans
        lever = weigh_actuator(board, on_lever, ends)
        pushes = _push(board, ends, links, lever.balance)
        return Thrust(lever.balance, ends, links, *pushes, lever)
    alone, without = board.trial(), unbalanced_after(board.trial(), groups)
    alone.forces, alone.couples = {}, {}
    tried = board.draft.b.compute(board.name("F"), (board.scale, 1), factor=_TRIED_MM)
    _push(alone, ends, links, tried)
    trial = Trial(without, tried, unbalanced_after(alone, groups))
    share = ((trial.without, 1), (trial.effect, -1), (tried, 1))
    value = board.segments.compute("F_dr", *share, factor=-1.0)
    return Thrust(value, ends, links, *_push(board, ends, links, value), trial=trial)


def close_thrust(board: ForceBoard, thrust: Thrust) -> tuple[Driving, Lever | None]:
    """Find the reaction on the driving link and the residual of its equilibrium.

    The actuator makes up for the power of the residual.
    """
    b, drive, value = board.draft.b, board.draft.problem.drive, thrust.value
    left, lever = resting_driver_forces(board), thrust.lever
    if lever is not None:
        assert lever.arm is not None
        rate, per_mm = (
            NumberName(drive.coordinate.rates[0]),
            board.kinematics.velocity.segments.scale,
        )
        missing = b.compute(board.name("F"), (left, 1), (rate, 1), (lever.arm, -1), (per_mm, -1))
        value = b.total(board.name("F"), thrust.value, missing)
        board.starts.append(lever.pole)
        lever = replace(lever, difference=board.negative(missing))
    return Driving(value, thrust.force, between=thrust.ends), lever


def unbalanced_after(board: ForceBoard, groups: tuple[AssurGroup, ...]) -> NumberName:
    """Return the unbalanced load on the driving link, N·m or N."""
    for group in reversed(groups):
        group_forces(board, group)
    return unbalanced(board)


def _push(
    board: ForceBoard, ends: tuple[str, str], links: tuple[str, str], value: NumberName
) -> tuple[tuple[tuple[str, Force], ...], Force]:
    """Push two bodies apart by an actuator; return the forces on moving ones and the second one."""
    b, (one, two) = board.draft.b, map(PointName, ends)
    line = b.parallel(board.pole, b.join(one, two))
    head = board.segments.lay_off_vector(board.name("F"), board.pole, line, value)
    # It may lie against the line: the moment needs its size.
    for table in (board.segments.values, board.segments.lengths):
        table[board.pole, head] = b.compute(
            board.name("|F|"), (table[board.pole, head], 1), size=True
        )
    symbol = board.draft.problem.balancer.symbol
    force = Force(two, board.pole, head, symbol)
    both = zip(links, (replace(force.reversed(symbol), at=one), force), strict=True)
    pushes = tuple((link, acting) for link, acting in both if link != FRAME)
    for link, acting in pushes:
        board.forces.setdefault(link, []).append(acting)
    return pushes, force
