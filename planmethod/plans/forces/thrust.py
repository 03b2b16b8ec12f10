"""The force of an actuator that drives a mechanism (сила в гидроцилиндре).

It acts along the line of its two ends on both bodies that it pushes apart. The lever finds it; the
force plans use it as known, and their residual on the driving link measures its error. If the
driver is at rest there is no lever: the plans are linear in the force, so its size follows from the
load on the driving link without the force and from the effect of a trial force.
"""

from __future__ import annotations

from collections.abc import Iterable

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.steps import NumberName, PointName
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME
from planmethod.plans.forces.board import Force, ForceBoard
from planmethod.plans.forces.dyads import Driving, group_forces, resting_driver_forces, unbalanced
from planmethod.plans.forces.lever import Lever, hang_loads, weigh_actuator
from planmethod.problem.model import Problem

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
        The trial that determines it where there is no lever.
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
    alone, without = board.trial(), _left(board.trial(), groups)
    alone.forces, alone.couples = {}, {}
    tried = board.draft.b.compute(board.name("F"), (board.scale, 1), factor=_TRIED_MM)
    _push(alone, ends, links, tried)
    trial = Trial(without, tried, _left(alone, groups))
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


def _left(board: ForceBoard, groups: tuple[AssurGroup, ...]) -> NumberName:
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
    symbol = board.draft.problem.drive.balancing.symbol
    force = Force(two, board.pole, head, symbol)
    both = zip(links, (replace(force.reversed(symbol), at=one), force), strict=True)
    pushes = tuple((link, acting) for link, acting in both if link != FRAME)
    for link, acting in pushes:
        board.forces.setdefault(link, []).append(acting)
    return pushes, force
