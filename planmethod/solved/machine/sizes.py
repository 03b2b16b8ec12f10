"""Sizes of a flywheel (размеры маховика).

A disc of width 0.165·D has J = m·D²/8, so D = 0.38·J^(1/5) of steel: the formulas of the press
coursework; with another density D = (32·J/(0.165·pi·rho))^(1/5). A rim D_1 = 0.8·D, b = 0.2·D has
J = pi·rho·b·(D⁴ - D_1⁴)/32, spokes and hub left out. Where the rim would run quicker than it may, D
is what its greatest speed allows, and the width grows; one that is wide for its diameter is warned
of. What is made has a round diameter, and the mass and the width with which its J is the same.
"""

from __future__ import annotations

from math import ceil, inf, pi

from msgspec import Struct
from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.problem.machine_records import FlywheelTask, WheelShape

STEEL_FACTOR, STEEL = 0.38, 7800.0
"""D = 0.38·J^(1/5) of a steel disc, m and kg·m², and the density of a steel rim, kg/m³."""

DISC_WIDTH, RIM_WIDTH, RIM_BORE = 0.165, 0.2, 0.8
"""Width over diameter, and inner diameter of a rim over the outer one."""

WIDEST = 0.4
"""Width over diameter beyond which a flywheel is not made."""


STEPS = ((0.5, 0.01), (0.2, 0.005), (0.1, 0.002), (0.0, 0.001))
"""Diameters from which a size is rounded, and the steps, m."""


class FlywheelSizes(Struct, frozen=True):
    """A flywheel as manufactured (маховик).

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
    is_speed_limited : bool
        The greatest speed of the rim has set the diameter.
    """

    shape: WheelShape
    inertia: float
    diameter: float
    bore: float
    width: float
    mass: float
    speed: float
    is_speed_limited: bool


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
    density = density_of(wheel)
    if disc and wheel.density is None:
        diameter = STEEL_FACTOR * own**0.2
    else:
        diameter = (32.0 * own / (pi * density * width * (1.0 - bore**4))) ** 0.2
    most = 2.0 * wheel.greatest_speed / turning
    held = diameter > most
    diameter = min(diameter, most)
    mass = 8.0 * own / (diameter**2 * (1.0 + bore**2))
    breadth = width * diameter
    if held:
        breadth = 4.0 * mass / (pi * density * diameter**2 * (1.0 - bore**2))
    speed = turning * diameter / 2.0
    return FlywheelSizes(wheel.shape, own, diameter, bore * diameter, breadth, mass, speed, held)


def density_of(wheel: FlywheelTask) -> float:
    """Return the density of a flywheel, kg/m³."""
    return STEEL if wheel.density is None else wheel.density


def adopted(wheel: FlywheelTask, sizes: FlywheelSizes) -> FlywheelSizes:
    """Return a flywheel of the same inertia with a round diameter (принятый маховик).

    The nearest one with which the rim does not run quicker than it may.
    """
    exact = sizes.diameter
    step = next(step for least, step in STEPS if exact >= least)
    turning = 2.0 * sizes.speed / exact
    count = round(exact / step)
    while count > 1 and count * step * turning / 2.0 > wheel.greatest_speed * (1.0 + 1e-9):
        count -= 1
    diameter = round(max(count, 1) * step, 6) if exact >= STEPS[-1][1] else exact
    hollow = sizes.bore / exact
    mass = 8.0 * sizes.inertia / (diameter**2 * (1.0 + hollow**2))
    width = 4.0 * mass / (pi * density_of(wheel) * diameter**2 * (1.0 - hollow**2))
    speed = turning * diameter / 2.0
    return replace(sizes, diameter=diameter, bore=hollow * diameter, width=width, mass=mass,
                   speed=speed)  # fmt: skip


def too_wide(wheel: FlywheelTask, inertia: float, omega: float) -> str | None:
    """Return the warning about a flywheel that is wide for its diameter; None for a usual one.

    Parameters
    ----------
    inertia, omega : float
        As of `size_of`.
    """
    sizes = size_of(wheel, inertia, omega)
    if sizes is None or sizes.width <= WIDEST * sizes.diameter:
        return None
    free = size_of(replace(wheel, speed=inf), inertia, omega)
    assert free is not None, "it has the same inertia"
    # of a shaft that turns r times as quickly J is r² times less, D = r^(-2/5), v = r^(3/5)
    slower = wheel.ratio * (wheel.greatest_speed / free.speed) ** (5.0 / 3.0)
    return translate(
        "the flywheel is {0:.3g} m wide and {1:.3g} m in diameter, b/D = {2:.2g} instead of "
        "the usual {3:.3g}: its rim may run at {4:.3g} m/s. In [machine.flywheel] allow "
        "speed = {5} (D = {6:.3g} m, b = {7:.3g} m; cast iron withstands 30 m/s, steel 50), "
        "or set it on a slower shaft, ratio = {8:.2g}.",
        sizes.width, sizes.diameter, sizes.width / sizes.diameter, free.width / free.diameter,
        wheel.greatest_speed, ceil(free.speed), free.diameter, free.width, slower,
    )  # fmt: skip
