"""The power of a machine, and the motor that drives it (мощность двигателя)."""

from __future__ import annotations

from msgspec import Struct

from planmethod.problem.machine_records import ConstantMoment
from planmethod.solved.machine.flywheel import Flywheel

RATED_KW = (
    0.06, 0.09, 0.12, 0.18, 0.25, 0.37, 0.55, 0.75, 1.1, 1.5, 2.2, 3, 4, 5.5, 7.5, 11, 15, 18.5,
    22, 30, 37, 45, 55, 75, 90, 110, 132, 160, 200, 250, 315,
)  # fmt: skip
"""Rated powers of asynchronous motors, kW."""


class MachinePower(Struct, frozen=True):
    """The power of a machine in its steady motion (мощность машины).

    Attributes
    ----------
    at_crank : float, W
        Mean power over the cycle: of the resistance where a motor drives the machine, of the
        engine where it drives itself.
    efficiency : float or None
        Efficiency of the train between the motor and the crank; None if it is not given.
    at_motor : float or None, W
        Power of the motor; None if there is no train with an efficiency, and for an engine.
    rated : float or None, W
        Smallest power of the series that is not less; None if the series ends before.
    """

    at_crank: float
    efficiency: float | None
    at_motor: float | None
    rated: float | None


def machine_power(flywheel: Flywheel) -> MachinePower:
    """Return the mean power of the cycle, P = A·n, and at the motor P/η, with the motor for it."""
    at_crank = flywheel.work_per_cycle * flywheel.middle_speed / flywheel.cycle
    geared = flywheel.problem.drive.gear_drive
    efficiency = None if geared is None else geared.efficiency
    if efficiency is None or flywheel.machine.constant is not ConstantMoment.DRIVING:
        return MachinePower(at_crank, efficiency, None, None)
    at_motor = at_crank / efficiency
    rated = next((1000.0 * power for power in RATED_KW if 1000.0 * power >= at_motor), None)
    return MachinePower(at_crank, efficiency, at_motor, rated)
