"""The flywheel of a machine, exactly and by the textbook's ways, its sizes, and its motor.

A disc of width 0.165·D has J = m·D²/8, so D = 0.38·J^(1/5) of steel: the formulas of the press
coursework; with another density D = (32·J/(0.165·pi·rho))^(1/5). A rim D_1 = 0.8·D, b = 0.2·D has
J = pi·rho·b·(D⁴ - D_1⁴)/32, spokes and hub left out. Where the rim would run quicker than it may, D
is what its greatest speed allows, and the width grows; one that is wide for its diameter is warned
of. What is made has a round diameter, and the mass and the width with which its J is the same.
"""

from __future__ import annotations

from functools import cached_property
from math import ceil, inf, pi, prod

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.arithmetic import Float64
from planmethod.construct.curves import Piecewise, hermite, joined, root, turning_points
from planmethod.construct.evaluate import evaluate
from planmethod.errors import AssemblyError, Fault, ProblemError
from planmethod.languages import translate
from planmethod.plans.forces.board import SCALE
from planmethod.problem.machine_records import (
    ConstantMoment,
    FlywheelMethod,
    FlywheelTask,
    MeanSpeed,
    Quadrature,
    WeightSigns,
    WheelShape,
)
from planmethod.problem.model import Problem
from planmethod.problem.records import Dynamics, Fixed, Load
from planmethod.solved.cycle_motion import CycleMotion
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.machine.reduced import Reduced, reduce, reduced_curves
from planmethod.solved.reading import Memoizing, Reading, Reals, memoized
from planmethod.solved.solution import EVERY, UNIT_SCALES, Solution

BALANCE = 1e-9
"""Work of the cycle, relative to the largest moment times the cycle, that counts as zero."""

_STEPS = 2400  # of the equation of motion, in a turn


class Tangents(Struct, frozen=True):
    """A flywheel between two tangents of the energy-mass curve (касательные).

    Attributes
    ----------
    inertia : float, kg·m²
        J_f beyond what turns with the crank.
    upper, lower : float, J
        Where the tangents meet the axis of energies.
    at_max, at_min : float, rad
        Where they touch: angles turned.
    """

    inertia: float
    upper: float
    lower: float
    at_max: float
    at_min: float


class MachineRows(Struct, frozen=True):
    """A machine in even positions, ndarrays of shape (n,), as its tables have it (таблица).

    ``rotation`` is in rad, ``moment`` in N·m, ``work`` and ``gain`` (dT) in J, ``inertia`` and its
    ``slope`` in kg·m², ``omega`` in 1/s and ``epsilon`` in 1/s² along the turning of the crank.
    """

    rotation: Reals
    phi_deg: Reals
    moment: Reals
    work: Reals
    gain: Reals
    inertia: Reals
    slope: Reals
    omega: Reals
    epsilon: Reals
    parts: Reduced


class Points(Struct, frozen=True):
    """Exact ordinates of a construction by a number of positions (построение по точкам).

    Attributes
    ----------
    ordinates : ndarray of shape (n + 1,) and ``middles`` of shape (n,), N·m
        M in the positions, and between them.
    work, gain, inertia : ndarray of shape (n + 1,)
        J and kg·m²; the last position is the first again.
    tangents : Tangents
    """

    ordinates: Reals
    middles: Reals
    work: Reals
    gain: Reals
    inertia: Reals
    tangents: Tangents


class SpeedExtreme(Struct, frozen=True):
    """A largest or least speed: 1/s, and the angle turned where it is, rad."""

    value: float
    rotation: float


class Flywheel(Memoizing):
    """A machine and the flywheel that evens out its motion (машина с маховиком).

    Parameters
    ----------
    problem : Problem
        With ``[machine]``.

    Raises
    ------
    ProblemError
        The work of the cycle has the wrong sign, a load never works, or the crank does not turn.
    AssemblyError
        When the mechanism cannot be assembled all round.
    """

    def __init__(self, problem: Problem) -> None:
        super().__init__()
        assert problem.machine is not None, "there is no [machine]"
        self.problem, self.machine = problem, problem.machine
        self.turn = CycleMotion(problem)
        self.cycle = self.turn.cycle
        try:
            found = reduced_curves(self.turn, self.machine)
        except AssemblyError as error:
            text = "a flywheel needs a crank that turns fully: {}"
            raise AssemblyError(text, error) from error
        self.moment, self.inertia, self.slope = (
            Piecewise(found.edges, found.terms[:, :, k : k + 1]) for k in range(3)
        )
        self.sign = 1.0 if self.machine.constant is ConstantMoment.DRIVING else -1.0
        self.work = self.moment.mixed([self.sign]).integral
        self.work_per_cycle = float(self.work.value([self.cycle])[0])
        self._check_work()
        self.constant = self.work_per_cycle / self.cycle
        gain = self.moment.mixed([-1.0]).plus(self.sign * self.constant)
        self.surplus, self.gain = gain, gain.integral

    def _check_work(self) -> None:
        moments = self.moment.value(self.moment.samples)
        least = BALANCE * float(np.max(np.abs(moments))) * self.cycle
        if self.work_per_cycle > least:
            return
        driving = self.machine.constant is ConstantMoment.DRIVING
        text = (
            "a constant driving moment cannot balance the work of the loads over the cycle: they "
            "do {:.6g} J and must resist"
            if driving
            else "a constant resisting moment cannot balance the work of the loads over the cycle: "
            "they do {:.6g} J and must drive"
        )
        done = -self.sign * self.work_per_cycle  # by the loads; positive where they drive
        nothing = abs(done) <= least
        message = translate(text, 0.0 if nothing else done)
        hint = 'Check their directions and phases, or set constant = "{}".'
        hint = translate(hint, "resisting" if driving else "driving")
        if nothing:
            hint = "Check their directions and phases."
        raise ProblemError(self.problem.name, [Fault("machine.constant", message, hint)])

    # Exactly ---------------------------------------------------------------------------------

    def tangents(self, upper: float, lower: float, speed: float) -> Tangents:
        """Return the flywheel between tangents of slopes omega²/2 times ``upper`` and ``lower``."""
        curves = joined([self.gain, self.inertia])
        at_max, high = curves.mixed([1.0, -upper * speed**2 / 2.0]).peak()
        at_min, low = curves.mixed([-1.0, lower * speed**2 / 2.0]).peak()
        inertia = (high + low) / (speed**2 * self.machine.delta)
        return Tangents(inertia, high, -low, at_max, at_min)

    @property
    def exact_slopes(self) -> tuple[float, float]:
        """Slopes of the tangents that are exact, over omega²/2."""
        half = self.machine.delta / 2.0
        return (1.0 + half) ** 2, (1.0 - half) ** 2

    @property
    def usual_slopes(self) -> tuple[float, float]:
        """Slopes that the method of the file draws, over omega²/2.

        Both are 1 by Mertsalov, whose T_II has the mean speed in all positions.
        """
        if self.machine.method is FlywheelMethod.MERTSALOV:
            return 1.0, 1.0
        return 1.0 + self.machine.delta, 1.0 - self.machine.delta

    def links_energy(self, inertia: Reals) -> Reals:
        """Return T_II, the energy of the links at the mean speed, of their reduced inertia, J."""
        return self.middle_speed**2 / 2.0 * inertia

    @cached_property
    def middle_speed(self) -> float:
        """Half-sum of the greatest and the least speed of the steady motion, 1/s."""
        asked = abs(self.problem.drive.rate)
        if self.machine.mean is MeanSpeed.HALF_SUM:
            return asked
        found = asked
        for _ in range(40):
            ratio = asked / self._mean_in_time(found)
            found *= ratio
            if abs(ratio - 1.0) < 1e-14:
                break
        return found

    def _mean_in_time(self, middle: float) -> float:
        energy = self._energy(middle)
        nodes, weights = np.polynomial.legendre.leggauss(12)
        low, high = self.gain.edges[:-1, np.newaxis], self.gain.edges[1:, np.newaxis]
        at = (low + high) / 2.0 + (high - low) / 2.0 * nodes
        speeds = np.sqrt(
            2.0
            * (energy[0] + self.gain.value(at.ravel()))
            / (energy[1] + self.inertia.value(at.ravel()))
        )
        inverse = float(np.sum((weights * (high - low) / 2.0).ravel() / speeds))
        return float(self.cycle / inverse)

    def _energy(self, middle: float) -> tuple[float, float]:
        """Return the kinetic energy of position 0, J, and the flywheel, for a middle speed."""
        upper, lower = self.exact_slopes
        found = self.tangents(upper, lower, middle)
        if found.inertia >= 0.0:
            return upper * middle**2 / 2.0 * found.inertia - found.upper, found.inertia
        return self.energy_with(0.0, middle), 0.0

    def energy_with(self, flywheel: float, middle: float) -> float:
        """Return the energy of position 0 of a machine with a flywheel, J, for a middle speed."""
        at = self.gain.samples
        gain, inertia = self.gain.value(at), flywheel + self.inertia.value(at)
        least = float(np.max(-gain))

        def excess_speed(energies: Reals) -> Reals:
            squares = 2.0 * (energies[:, np.newaxis] + gain) / inertia
            speeds = np.sqrt(np.maximum(squares, 0.0))
            return np.asarray(speeds.max(axis=1) + speeds.min(axis=1) - 2.0 * middle)

        return root(excess_speed, least, least + 4.0 * middle**2 * float(inertia.max()))

    @cached_property
    def exact(self) -> Tangents:
        """The flywheel for which the coefficient of speed fluctuation is exactly the required one.

        Its inertia is not positive where the machine is even enough without a flywheel.
        """
        return self.tangents(*self.exact_slopes, self.middle_speed)

    @property
    def steady_inertia(self) -> float:
        """J_f of the steady motion, kg·m²: zero if no flywheel is needed."""
        return max(self.exact.inertia, 0.0)

    def speeds(self, rotation: Reals) -> tuple[Reals, Reals]:
        """Return omega, 1/s, and epsilon, 1/s², of the steady motion, ndarrays of shape (n,)."""
        energy, flywheel = self._energy(self.middle_speed)
        mass = flywheel + self.inertia.value(rotation)
        omega = np.sqrt(2.0 * (energy + self.gain.value(rotation)) / mass)
        pushed = self.surplus.value(rotation) - omega**2 * self.slope.value(rotation) / 2.0
        return omega, pushed / mass

    @cached_property
    def integrated(self) -> tuple[SpeedExtreme, SpeedExtreme]:
        """Greatest and least speed by integrating the equation of motion (проверка).

        Runge and Kutta's fourth order over each smooth piece, with the moments, the inertia and
        its slope as they are, without any work or energy; the steps begin at the speed of
        position 0: J·omega·domega/dphi = M - omega²·J'/2.
        """
        edges, fly = self.moment.edges, self.steady_inertia
        most = 2.0 * pi / _STEPS
        parts = np.maximum(np.ceil(np.diff(edges) / most).astype(int), 2)
        omega = float(self.speeds(np.zeros(1))[0][0])
        highest = lowest = SpeedExtreme(omega, 0.0)
        for low, high, count in zip(edges[:-1], edges[1:], parts.tolist(), strict=True):
            # nodes and middles; a hair inside the piece, where a moment that jumps is this piece's
            at = np.linspace(low, high, 2 * count + 1)
            inside = np.clip(at, low, high - (high - low) * 1e-12)
            pushed = self.surplus.value(inside).tolist()
            mass = (fly + self.inertia.value(inside)).tolist()
            slope = (self.slope.value(inside) / 2.0).tolist()
            step = (high - low) / count

            def rate(k: int, speed: float) -> float:
                pull: float = pushed[k] / speed - slope[k] * speed  # noqa: B023 - called at once
                return pull / mass[k]  # type: ignore[no-any-return] # noqa: B023

            for k in range(0, 2 * count, 2):
                one = rate(k, omega)
                two = rate(k + 1, omega + step / 2.0 * one)
                three = rate(k + 1, omega + step / 2.0 * two)
                four = rate(k + 2, omega + step * three)
                after = omega + step / 6.0 * (one + 2.0 * two + 2.0 * three + four)
                for share in turning_points(omega, after, step * one, step * rate(k + 2, after)):
                    value = hermite(omega, after, step * one, step * rate(k + 2, after), share)
                    found = SpeedExtreme(value, float(at[k]) + share * step)
                    highest = max(highest, found, key=lambda extreme: extreme.value)
                    lowest = min(lowest, found, key=lambda extreme: extreme.value)
                omega = after
        return highest, lowest

    @property
    def delta_reached(self) -> float:
        """Irregularity of the integrated motion."""
        high, low = self.integrated
        return 2.0 * (high.value - low.value) / (high.value + low.value)

    # By positions ----------------------------------------------------------------------------

    def even_rotations(self, count: int) -> Reals:
        """Return the angles turned of ``count`` equally spaced positions, rad."""
        return np.asarray(self.cycle * np.arange(count) / count, dtype=float)

    @memoized
    def solved(self, count: int) -> Solution:
        """Return the motion in ``count`` equally spaced positions, by their own plans."""
        return self.turn.solved(self.even_rotations(count))

    @memoized
    def reduced(self, count: int) -> Reduced:
        """Return the reduced quantities in ``count`` equally spaced positions, by their plans."""
        return reduce(self.solved(count), self.machine)

    @memoized
    def lever(self, count: int) -> Reals:
        """Return the reduced moment in ``count`` positions by the Zhukovsky lever, N·m, shape (n,).

        Loads and weights act on the turned velocity plan of each position; inertia does not.
        """
        problem, dynamics = self.turn.problem, self.problem.dynamics
        assert dynamics is not None
        down = Fixed(-90.0 if self.machine.signs is WeightSigns.TRUE else 90.0)
        weights = [
            Load(f"G_{{{link}}}", link, mass.centre, mass.mass * dynamics.gravity, down)
            for link, mass in dynamics.masses.items()
            if mass.centre is not None and mass.mass and dynamics.gravity
        ]
        hung = Dynamics(0.0, {}, (*dynamics.loads, *weights))
        positions = self.turn.phi(self.even_rotations(count)).tolist()
        statics = statics_of(Solution(replace(problem, dynamics=hung), positions=positions))
        assert statics.lever_plan is not None, "the crank turns"
        balance = statics.lever_plan.balance
        program = statics.program.needed_for([balance])
        data = statics.data({**UNIT_SCALES, SCALE: 1.0}, EVERY)
        found = Reading(evaluate(program, data, Float64()), count).number(balance)
        return np.asarray(self.turn.sense * found, dtype=float)

    @cached_property
    def rows(self) -> MachineRows:
        """The positions of the file's count."""
        turned = self.even_rotations(self.machine.count)
        parts = self.reduced(self.machine.count)
        omega, _ = self.speeds(turned)
        moment, mass = parts.moment, self.steady_inertia + parts.inertia
        pushed = self.sign * self.constant - moment - omega**2 * parts.slope / 2.0
        return MachineRows(
            turned,
            self.turn.phi(turned),
            moment,
            self.work.value(turned),
            self.gain.value(turned),
            parts.inertia,
            parts.slope,
            omega,
            pushed / mass,
            parts,
        )

    def by_points(
        self,
        count: int,
        ordinates: Quadrature,
        slopes: tuple[float, float],
    ) -> Points:
        """Return the results of a construction that knows only ``count`` positions.

        Parameters
        ----------
        slopes : (float, float)
            Of the tangents, over omega²/2.
        """
        both = self.reduced(2 * count)
        moments = np.append(both.moment[::2], both.moment[0])
        middles = both.moment[1::2]
        step = self.cycle / count
        taken = middles if ordinates is Quadrature.MIDDLE else (moments[:-1] + moments[1:]) / 2.0
        work = self.sign * np.append(0.0, np.cumsum(taken)) * step
        turned = np.asarray(step * np.arange(count + 1), dtype=float)
        gain = self.sign * (work[-1] / self.cycle * turned - work)
        inertia = np.append(both.inertia[::2], both.inertia[0])
        tangents = touching(turned, gain, inertia, slopes, self.middle_speed, self.machine.delta)
        return Points(moments, middles, work, gain, inertia, tangents)


def touching(
    rotation: Reals,
    gain: Reals,
    inertia: Reals,
    slopes: tuple[float, float],
    speed: float,
    delta: float,
) -> Tangents:
    """Return the flywheel between tangents that touch one of some points each.

    Parameters
    ----------
    rotation, gain, inertia : ndarray of shape (n + 1,), rad, J and kg·m²
        The last position is the first again.
    slopes : (float, float)
        Of the tangents, over omega²/2.
    speed, delta : float
        Mean speed, 1/s, and irregularity.
    """
    highs = gain - slopes[0] * speed**2 / 2.0 * inertia
    lows = gain - slopes[1] * speed**2 / 2.0 * inertia
    top, bottom = int(np.argmax(highs[:-1])), int(np.argmin(lows[:-1]))
    high, low = float(highs[top]), float(lows[bottom])
    found = (high - low) / (speed**2 * delta)
    return Tangents(found, high, low, float(rotation[top]), float(rotation[bottom]))


@memoized
def flywheel_of(solution: Solution) -> Flywheel:
    """Return the machine of a solution, computed at the first call."""
    return Flywheel(solution.problem)


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
        Efficiency of the train between the motor and the crank, and of the mechanism; None if
        neither is given.
    at_motor : float or None, W
        Power of the motor; None without an efficiency and without motors, and for an engine.
    rated : float or None, W
        Smallest power of the series that is not less; None if the series ends before, or if the
        file has its own motors.
    parts : tuple of float
        The given efficiencies, that of the train first.
    """

    at_crank: float
    efficiency: float | None
    at_motor: float | None
    rated: float | None
    parts: tuple[float, ...] = ()


def machine_power(flywheel: Flywheel) -> MachinePower:
    """Return the mean power of the cycle, P = A·n, and at the motor P/η, with the motor for it."""
    at_crank = flywheel.work_per_cycle * flywheel.middle_speed / flywheel.cycle
    geared, machine = flywheel.problem.drive.gear_drive, flywheel.machine
    given = (None if geared is None else geared.efficiency, machine.efficiency)
    parts = tuple(part for part in given if part is not None)
    efficiency = prod(parts) if parts else None
    is_driven = machine.constant is ConstantMoment.DRIVING
    if not is_driven or (efficiency is None and not machine.motors):
        return MachinePower(at_crank, efficiency, None, None, parts)
    at_motor = at_crank / prod(parts)
    series = () if machine.motors else RATED_KW
    rated = next((1000.0 * power for power in series if 1000.0 * power >= at_motor), None)
    return MachinePower(at_crank, efficiency, at_motor, rated, parts)


# Sizes -------------------------------------------------------------------------------------------

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
