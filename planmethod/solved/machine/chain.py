"""The machine as one chain: motor, train, crank, and the shaft of the flywheel (привод машины).

The mean power of the cycle divided by the efficiencies determines the motor. The rotor is part of
the flywheel: reduced to the crank its inertia is J·i². What is missing can be added on the crank,
or on the shaft of the motor, where i² times less is enough. The train then carries the moment that
accelerates the masses beyond it: M_train = M_d - J_motor·epsilon, with all inertia of its own side.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from fractions import Fraction
from math import pi

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.curves import by_rows, tops
from planmethod.problem.model import GearStage
from planmethod.problem.motor_records import CatalogueMotor
from planmethod.solved.machine.flywheel import (
    Flywheel,
    FlywheelSizes,
    MachinePower,
    adopted,
    machine_power,
    size_of,
    too_wide,
)
from planmethod.solved.reading import Reals

SPEED_SHARE = 0.05
"""Share by which the crank may turn quicker or slower than the file has it."""

_MM = Fraction(1, 1000)

FIRST_ROW = (
    "0.05 0.06 0.08 0.1 0.12 0.15 0.2 0.25 0.3 0.4 0.5 0.6 0.8 1 1.25 1.5 2 2.5 3 4 5 6 8 10 12 16 "
    "20 25 32 40 50 60 80 100"
)
SECOND_ROW = (
    "0.055 0.07 0.09 0.11 0.14 0.18 0.22 0.28 0.35 0.45 0.55 0.7 0.9 1.125 1.375 1.75 2.25 2.75 "
    "3.5 4.5 5.5 7 9 11 14 18 22 28 36 45 55 70 90"
)
"""Modules of GOST 9563, mm: the first row is preferred."""

MODULES = {
    row: tuple(Fraction(text) * _MM for text in texts.split())
    for row, texts in ((1, FIRST_ROW), (2, SECOND_ROW))
}


class ModuleCheck(Struct, frozen=True):
    """A module beside the rows of the standard (модуль по ГОСТ 9563).

    Attributes
    ----------
    row : int
        1 or 2; 0 of one that neither row has.
    nearest : Fraction, m
        Next greater module of the first row, which replaces one that is not standard.
    """

    row: int
    nearest: Fraction


def check_module(module: Fraction) -> ModuleCheck:
    """Return the row of a module, m, and the next one of the first row."""
    first = MODULES[1]
    row = next((row for row, modules in MODULES.items() if module in modules), 0)
    return ModuleCheck(row, first[min(bisect_left(first, module), len(first) - 1)])


class MotorOffer(Struct, frozen=True):
    """A motor of the table beside what the machine needs (двигатель из таблицы).

    Attributes
    ----------
    motor : CatalogueMotor
    ratio : float
        Ratio of its speed to the required one of the crank.
    speed : float or None, rev/min
        Of the crank that it turns through the train; None without a train.
    is_strong, is_suitable : bool
        Its power is enough; its speed suits the train, too.
    """

    motor: CatalogueMotor
    ratio: float
    speed: float | None
    is_strong: bool
    is_suitable: bool


class ShaftWheel(Struct, frozen=True):
    """A flywheel on one of both shafts (маховик на валу).

    Attributes
    ----------
    ratio : float
        Of the speed of its shaft to that of the crank.
    inertia : float, kg·m²
        Its own.
    sizes : FlywheelSizes
        With a round diameter.
    moment : float, N·m
        Greatest moment that the train transmits to the crank.
    """

    ratio: float
    inertia: float
    sizes: FlywheelSizes
    moment: float


class MachineChain(Struct, frozen=True):
    """A machine from its motor to its crank (привод машины).

    Attributes
    ----------
    power : MachinePower
    offers : tuple of MotorOffer
        In the order of the file.
    chosen : MotorOffer or None
        None where none has the power and the speed.
    crank_speed : float, rev/min
    ratio : float or None
        From the motor to the crank: that of the train, else that of the chosen motor.
    stages : tuple of GearStage
    inertia : float, kg·m²
        Flywheel reduced to the crank, with the rotor.
    rotor : float, kg·m²
        Inertia of the rotor of the chosen motor, reduced to the crank.
    slow, fast : ShaftWheel or None
        On the crank and on the motor; None where the rotor is enough, or no motor is chosen.
    """

    power: MachinePower
    offers: tuple[MotorOffer, ...]
    chosen: MotorOffer | None
    crank_speed: float
    ratio: float | None
    stages: tuple[GearStage, ...]
    inertia: float
    rotor: float
    slow: ShaftWheel | None
    fast: ShaftWheel | None

    @property
    def lighter(self) -> ShaftWheel | None:
        """The lighter flywheel of both shafts, which is chosen; of equal ones that on the crank."""
        if self.slow is None or self.fast is None:
            return None
        return self.fast if self.fast.sizes.mass < self.slow.sizes.mass else self.slow


def machine_chain(flywheel: Flywheel, inertia: float) -> MachineChain | None:
    """Return the chain of a machine; None without motors to choose from.

    Parameters
    ----------
    flywheel : Flywheel
    inertia : float, kg·m²
        Flywheel reduced to the crank, by its construction or exact.
    """
    motors, geared = flywheel.machine.motors, flywheel.problem.drive.gear_drive
    if not motors:
        return None
    power, speed = machine_power(flywheel), flywheel.middle_speed * 30.0 / pi
    offers, chosen, ratio = _choose(flywheel)
    stages = () if geared is None else geared.stages
    rotor = _reduced_rotor(chosen, ratio)
    slow = fast = None
    missing = max(inertia, 0.0) - rotor
    if chosen is not None and ratio is not None and missing > 0.0:
        slow = _on_shaft(flywheel, missing, 1.0, _train_moment(flywheel, inertia, rotor))
        fast = _on_shaft(flywheel, missing, ratio, _train_moment(flywheel, inertia, inertia))
    return MachineChain(
        power, offers, chosen, speed, ratio, stages, max(inertia, 0.0), rotor,
        slow, fast,
    )  # fmt: skip


def _choose(flywheel: Flywheel) -> tuple[tuple[MotorOffer, ...], MotorOffer | None, float | None]:
    """Return the offers of the table, the chosen one, and its ratio to the crank."""
    power, geared = machine_power(flywheel), flywheel.problem.drive.gear_drive
    needed = power.at_crank if power.at_motor is None else power.at_motor
    speed = flywheel.middle_speed * 30.0 / pi
    train = None
    if geared is not None and geared.ratio is not None:
        train = abs(float(geared.ratio))
    offers = tuple(_offer(motor, needed, speed, train) for motor in flywheel.machine.motors)
    suitable = [offer for offer in offers if offer.is_suitable]
    chosen = min(suitable, key=lambda offer: offer.motor.power) if suitable else None
    return offers, chosen, train or (None if chosen is None else chosen.ratio)


def _reduced_rotor(chosen: MotorOffer | None, ratio: float | None) -> float:
    return 0.0 if chosen is None or ratio is None else chosen.motor.inertia * ratio**2


def rotor_inertia(flywheel: Flywheel) -> float:
    """Return the inertia of the rotor of the chosen motor, reduced to the crank, kg·m².

    It is a part of J_f: the flywheel that is made has the rest. Zero without ``[[motors]]``.
    """
    _, chosen, ratio = _choose(flywheel)
    return _reduced_rotor(chosen, ratio)


def flywheel_warnings(wheel: Flywheel) -> Iterator[str]:
    """Yield the warning that a flywheel is wide for its diameter."""
    made = wheel.exact.inertia - rotor_inertia(wheel)
    said = too_wide(wheel.machine.wheel, made, wheel.middle_speed)
    if said is not None:
        yield said


def _offer(motor: CatalogueMotor, needed: float, crank: float, train: float | None) -> MotorOffer:
    speed = None if train is None else motor.speed / train
    is_strong = motor.power >= needed
    suits = speed is None or abs(speed - crank) <= SPEED_SHARE * crank
    return MotorOffer(motor, motor.speed / crank, speed, is_strong, is_strong and suits)


def _on_shaft(flywheel: Flywheel, inertia: float, ratio: float, moment: float) -> ShaftWheel:
    """Return a flywheel, whose inertia is reduced to the crank, on a shaft."""
    wheel = replace(flywheel.machine.wheel, ratio=ratio)
    sizes = size_of(wheel, inertia, flywheel.middle_speed)
    assert sizes is not None, "it is needed"
    return ShaftWheel(ratio, inertia / ratio**2, adopted(wheel, sizes), moment)


def _train_moment(flywheel: Flywheel, inertia: float, near_motor: float) -> float:
    """Return the greatest moment at the crank that the train transmits, N·m.

    Parameters
    ----------
    inertia : float, kg·m²
        The whole flywheel, reduced to the crank.
    near_motor : float, kg·m²
        The part on the side of the motor, reduced to the crank.
    """
    energy = flywheel.energy_with(inertia, flywheel.middle_speed)

    def transmitted(at: Reals) -> Reals:
        mass = inertia + flywheel.inertia.value(at)
        squares = 2.0 * (energy + flywheel.gain.value(at)) / mass
        pushed = flywheel.surplus.value(at) - squares * flywheel.slope.value(at) / 2.0
        return np.asarray(np.abs(flywheel.constant - near_motor * pushed / mass))

    edges = flywheel.moment.edges
    ends = edges[1:] - 1e-12 * np.diff(edges)  # where a moment jumps, this piece's
    _, sizes = tops(by_rows(transmitted), edges[:-1], ends)
    return float(np.max(sizes))
