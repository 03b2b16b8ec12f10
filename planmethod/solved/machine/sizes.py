"""Sizes of a flywheel (размеры маховика).

A disc of width 0.165·D has J = m·D²/8, so D = 0.38·J^(1/5) of steel: the formulas of the press
coursework; with another density D = (32·J/(0.165·pi·rho))^(1/5). A rim D_1 = 0.8·D, b = 0.2·D has
J = pi·rho·b·(D⁴ - D_1⁴)/32, spokes and hub left out. Where the rim would run quicker than it may, D
is what its greatest speed allows, and the width grows.
"""

from __future__ import annotations

from math import pi

from msgspec import Struct

from planmethod.problem.machine_records import FlywheelTask, WheelShape

STEEL_FACTOR, STEEL = 0.38, 7800.0
"""D = 0.38·J^(1/5) of a steel disc, m and kg·m², and the density of a steel rim, kg/m³."""

DISC_WIDTH, RIM_WIDTH, RIM_BORE = 0.165, 0.2, 0.8
"""Width over diameter, and inner diameter of a rim over the outer one."""


class FlywheelSizes(Struct, frozen=True):
    """A flywheel as it is made (маховик).

    Attributes
    ----------
    shape : WheelShape
    inertia : float, kg·m²
        On its own shaft.
    diameter, bore, width : float, m
        ``bore`` is the inner diameter of a rim; 0 of a disc.
    mass : float, kg
    speed : float, m/s
        Of the rim, at the mean speed of the machine.
    held : bool
        The greatest speed of the rim has set the diameter.
    """

    shape: WheelShape
    inertia: float
    diameter: float
    bore: float
    width: float
    mass: float
    speed: float
    held: bool


def size_of(wheel: FlywheelTask, inertia: float, omega: float) -> FlywheelSizes | None:
    """Return the sizes of a flywheel; None where none is needed.

    Parameters
    ----------
    inertia : float, kg·m²
        Reduced to the crank.
    omega : float, 1/s
        Mean speed of the crank.
    """
    if inertia <= 0.0:
        return None
    own, turning = inertia / wheel.ratio**2, omega * wheel.ratio
    disc = wheel.shape is WheelShape.DISC
    width, bore = (DISC_WIDTH, 0.0) if disc else (RIM_WIDTH, RIM_BORE)
    density = STEEL if wheel.density is None else wheel.density
    if disc and wheel.density is None:
        diameter = STEEL_FACTOR * own**0.2
    else:
        diameter = (32.0 * own / (pi * density * width * (1.0 - bore**4))) ** 0.2
    most = 2.0 * wheel.speed / turning
    held = diameter > most
    diameter = min(diameter, most)
    mass = 8.0 * own / (diameter**2 * (1.0 + bore**2))
    breadth = width * diameter
    if held:
        breadth = 4.0 * mass / (pi * density * diameter**2 * (1.0 - bore**2))
    speed = turning * diameter / 2.0
    return FlywheelSizes(wheel.shape, own, diameter, bore * diameter, breadth, mass, speed, held)
