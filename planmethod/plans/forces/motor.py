"""Moment of a motor between two moving links, by the lever or by a trial (момент двигателя)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.steps import NumberName
from planmethod.mechanism.groups import AssurGroup
from planmethod.plans.forces.board import ForceBoard
from planmethod.plans.forces.dyads import Driving, resting_driver_forces
from planmethod.plans.forces.lever import (
    Lever,
    Trial,
    add_other_balances,
    hang_loads,
    unbalanced_after,
    weigh_actuator,
)

_TRIED_MM2 = 1e4
"""Moment of the trial: a force of 100 mm on the plans on an arm of 100 mm of the drawing."""


class MotorMoment(Struct, frozen=True):
    """Moment of a motor that turns one moving link relative to another (момент двигателя).

    Attributes
    ----------
    value : NumberName
        N·m, on the second link; the opposite one acts on the first.
    links : (str, str)
    couples : tuple of NumberName
        The moments on both.
    lever : Lever or None
        The lever that determines it.
    trial : Trial or None
        The trial that determines it if the driver is at rest.
    """

    value: NumberName
    links: tuple[str, str]
    couples: tuple[NumberName, NumberName]
    lever: Lever | None = None
    trial: Trial | None = None


def find_motor(board: ForceBoard, groups: Iterable[AssurGroup], *, hung: bool) -> MotorMoment:
    """Find the moment of the motor, and apply it to both links.

    ``hung``: all loads are on the lever.
    """
    b, groups = board.draft.b, tuple(groups)
    links = board.draft.problem.drive.motor
    assert links is not None
    on_lever = hang_loads(board) if hung else None
    if on_lever is not None:
        board.starts.remove(on_lever.pole)  # it comes after those of the plans
        over = (relative_rate(board, links), -1)
        value = b.compute(board.name("M"), (on_lever.power, 1), over, factor=-1.0)
        both = _turn(board, links, value)
        return MotorMoment(value, links, both, Lever(on_lever.pole, value, value, on_lever.loads))
    alone, without = board.trial(), unbalanced_after(board.trial(), groups)
    alone.forces, alone.couples = {}, {}
    sizes = ((board.scale, 1), (board.draft.mu_l, 1))
    tried = b.compute(board.name("M"), *sizes, factor=_TRIED_MM2)
    _turn(alone, links, tried)
    trial = Trial(without, tried, unbalanced_after(alone, groups))
    share = ((trial.without, 1), (trial.effect, -1), (tried, 1))
    value = b.compute(board.name("M"), *share, factor=-1.0)
    return MotorMoment(value, links, _turn(board, links, value), trial=trial)


def weigh_first_driver(
    board: ForceBoard, driving: Driving, other_drivings: Sequence[Driving]
) -> Lever | None:
    """Find on the lever what a motor or an actuator exerts, the other drivers known from the plans.

    None if it does no work.
    """
    drive, b = board.draft.problem.drive, board.draft.b
    if drive.is_at_rest or (hung := hang_loads(board)) is None:
        return None
    hung = add_other_balances(board, hung, other_drivings)
    if driving.between is not None:
        lever = weigh_actuator(board, hung, driving.between)
    else:
        assert driving.motor is not None
        over = (relative_rate(board, driving.motor), -1)
        value = b.compute(board.name("M"), (hung.power, 1), over, factor=-1.0)
        lever = Lever(hung.pole, value, value, hung.loads)
    off = b.total(board.name("d"), lever.balance, board.negative(driving.balance))
    return replace(lever, difference=off)


def relative_rate(board: ForceBoard, links: tuple[str, str]) -> NumberName:
    """Return the angular velocity of the second link relative to the first, 1/s."""
    turning = board.kinematics.omega
    one, two = (turning.get(link) for link in links)
    terms = [] if two is None else [two]
    terms += [] if one is None else [board.negative(one)]
    return board.draft.b.total(board.name("w"), *terms)


def close_motor(board: ForceBoard, motor: MotorMoment) -> tuple[Driving, Lever | None]:
    """Find the reaction on the driving link and the residual of its equilibrium.

    The motor makes up for the power of the residual.
    """
    b, drive, value = board.draft.b, board.draft.problem.drive, motor.value
    left, lever = resting_driver_forces(board), motor.lever
    if lever is not None:
        rates = (
            (NumberName(drive.coordinate.rates[0]), 1),
            (relative_rate(board, motor.links), -1),
        )
        missing = b.compute(board.name("M"), (left, 1), *rates, factor=-1.0)
        value = b.total(board.name("M"), motor.value, missing)
        board.starts.append(lever.pole)
        lever = replace(lever, difference=board.negative(missing))
    return Driving(value, motor=motor.links), lever


def _turn(
    board: ForceBoard, links: tuple[str, str], value: NumberName
) -> tuple[NumberName, NumberName]:
    """Apply the moment to the second link, and the opposite one to the first; return both."""
    symbol = board.draft.problem.balancer.symbol
    both = board.negative(value), value
    for link, couple in zip(links, both, strict=True):
        board.symbols[couple] = symbol
        board.couples.setdefault(link, []).append(couple)
    return both
