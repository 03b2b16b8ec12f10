"""The diagrams of a flywheel read: exactly, with a ruler, with their errors (маховик на листе)."""

from __future__ import annotations

from functools import cached_property
from math import atan, degrees

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.arithmetic import Float64
from planmethod.construct.drafting import Profile, RulerArithmetic
from planmethod.construct.evaluate import evaluate
from planmethod.construct.scale import angle_scale, choose_scale, next_scale, series_near
from planmethod.plans.diagrams import (
    EnergyMass,
    EnergyMassData,
    Integration,
    Places,
    build_energy_mass,
)
from planmethod.problem.machine_records import FlywheelMethod, Quadrature
from planmethod.solved.errors.spread import Drafted, DrawnKind, DrawnQuantity, Errors, number
from planmethod.solved.machine.flywheel import Flywheel, Points
from planmethod.solved.reading import Reading, Reals, memoized

MOST_M, MOST_J = 85.0, 70.0
"""Longest ordinates of the moment and of the inertia where the program chooses a scale, mm."""

LOOP, TALLEST_J, TALLEST = 60.0, (165.0, 130.0, 105.0), 511.0
"""Width and height of an energy-mass curve that needs no more, the longest ordinates of the inertia
that a narrower one is tried with, and the height of all diagrams that it may take then, mm: with
their titles they are one under another on an A1 sheet."""

MAX_HEIGHT = 436.0
"""Height of all diagrams above one another up to which the program enlarges their scales, mm."""

POLE = 30.0
"""Usual pole distance, mm: that of a round scale of the work is near to it."""

NEAREST_POLE = 14.0
"""Least pole distance by which a flat energy-mass curve becomes higher, mm."""

LONG = 50.0
"""Length that all ordinates of T_II may have; longer ones begin at a round energy, mm."""

_GAP = 18.0  # between two diagrams above each other, mm
_ENERGY_OFFSET = (
    52.0  # from the last position to the axis of the energies of the energy-mass diagram, mm
)
_BETWEEN = 30.0  # from the last position to the axis of a diagram of the same abscissae, mm


class MachineScales(Struct, frozen=True):
    """Scales of the diagrams (масштабы диаграмм), units per mm: rad, N·m, J, kg·m²."""

    phi: float
    moment: float
    work: float
    inertia: float


class FlywheelDrawing:
    """The diagrams of a flywheel on the paper.

    Parameters
    ----------
    flywheel : Flywheel
    profile : Profile
        The hand that draws them.
    count : int, optional
        Number of positions. Default: those of the file.
    """

    def __init__(self, flywheel: Flywheel, profile: Profile, count: int | None = None) -> None:
        self.flywheel, self.profile = flywheel, profile
        machine = flywheel.machine
        self.count = machine.count if count is None else count
        slopes = flywheel.usual_slopes
        self.points: Points = flywheel.by_points(self.count, machine.ordinates, slopes)
        shown = np.append(self.points.ordinates, self.points.middles)
        self.length = machine.turn_mm or degrees(flywheel.cycle) / angle_scale(
            degrees(flywheel.cycle)
        )
        phi = flywheel.cycle / self.length
        inertia = machine.mu_J or _fitting(self.points.inertia, MOST_J)
        moment = machine.mu_M or _fitting(shown, MOST_M)
        self.scales = self._scales(phi, moment, inertia)
        while machine.mu_M is None and self.height > MAX_HEIGHT:
            moment = series_near(1.1 * moment, up=True)
            self.scales = self._scales(phi, moment, inertia)
        if machine.mu_J is None and not self.by_mertsalov:
            self._widen()
        if machine.pole_mm is None:
            self._heighten()
        self.pole = machine.pole_mm or self.scales.work / (moment * phi)
        half = self.scales.inertia * flywheel.middle_speed**2 / (2.0 * self.scales.work)
        self.psi = degrees(atan(half * slopes[0])), degrees(atan(half * slopes[1]))

    @property
    def by_mertsalov(self) -> bool:
        """True if dT without T_II is drawn instead of tangents to an energy-mass diagram."""
        return self.flywheel.machine.method is FlywheelMethod.MERTSALOV

    @property
    def second_start(self) -> float:
        """Energy that the axis of T_II begins with, J: none unless all its ordinates are long."""
        work = self.scales.work
        least = float(np.min(self.flywheel.links_energy(self.points.inertia))) / work
        return 10.0 * work * (least // 10.0 - 1.0) if least > LONG else 0.0

    @property
    def second(self) -> Reals:
        """T_II in the positions above the origin of its axis, J, ndarray of shape (n + 1,)."""
        return self.flywheel.links_energy(self.points.inertia) - self.second_start

    def _widen(self) -> None:
        """Enlarge the inertia if its curve is narrow, as far as there is space."""
        first, inertia = self.scales, self.points.inertia
        for most in TALLEST_J:
            if float(np.ptp(inertia)) / first.inertia >= LOOP:
                return
            self.scales = replace(first, inertia=_fitting(inertia, most))
            if self.height <= TALLEST:
                return
        self.scales = first

    def _heighten(self) -> None:
        """Enlarge the work if the curve of the method is flat, as far as there is space."""
        first, energy = self.scales, self.points.gain
        if self.by_mertsalov:
            energy = energy - self.second
        work = next_scale(first.work, finer=True)
        if float(np.ptp(energy)) / first.work >= LOOP:
            return
        self.scales = replace(first, work=work)
        if self.height > TALLEST or work / (first.moment * first.phi) < NEAREST_POLE:
            self.scales = first

    def _scales(self, phi: float, moment: float, inertia: float) -> MachineScales:
        """Return the scales: a round one for the work, the pole distance as usual as possible."""
        given = self.flywheel.machine.pole_mm
        work = moment * phi * (given or POLE)
        if given is None:
            both = [series_near(work, up=up) for up in (True, False)]
            work = min(both, key=lambda one: max(one / work, work / one))
        return MachineScales(phi, moment, work, inertia)

    @cached_property
    def construction(self) -> EnergyMass:
        """The construction."""
        machine, points, step = self.flywheel.machine, self.points, self.flywheel.cycle / self.count
        touched = (round(at / step) for at in (points.tangents.at_max, points.tangents.at_min))
        top, bottom = touched
        middle = machine.ordinates is Quadrature.MIDDLE
        given = EnergyMassData(
            (self.flywheel.sign * points.ordinates).tolist(),
            (self.flywheel.sign * points.middles).tolist(),
            points.inertia.tolist(),
            self.flywheel.sign > 0.0,
            Integration.MIDDLE if middle else Integration.TRAPEZOIDS,
            self.pole,
            self.length,
            self.scales.moment,
            self.scales.work,
            self.scales.inertia,
            self.psi,
            (top, bottom),
            self.flywheel.middle_speed,
            machine.delta,
            self.second.tolist() if self.by_mertsalov else (),
        )
        return build_energy_mass(given, self.places)

    def _reaches(self) -> list[tuple[float, float]]:
        """Return the lowest and the highest ordinates of the rows of diagrams, mm, from below.

        Of inertia, energy, work and moment; by Mertsalov of energy and dT_I, of work and T_II, of
        moment and inertia.
        """
        points, scales = self.points, self.scales
        inertia, energy = points.inertia / scales.inertia, points.gain / scales.work
        work = points.work / scales.work
        moment = self.flywheel.sign * np.append(points.ordinates, points.middles) / scales.moment
        if self.by_mertsalov:
            second = self.second / scales.work
            beside = ((energy, energy - second), (work, second), (moment, inertia))
            several = [np.concatenate(row) for row in beside]
        else:
            cut = np.array([points.tangents.upper, points.tangents.lower]) / scales.work
            several = [inertia, np.append(energy, cut), work, moment]
        return [(min(float(np.min(y)), 0.0), max(float(np.max(y)), 0.0)) for y in several]

    @property
    def height(self) -> float:
        """Height of all diagrams above one another, mm."""
        return sum(high - low + _GAP for low, high in self._reaches())

    @cached_property
    def places(self) -> Places:
        """Origins of the diagrams: one above the other, the energy-mass one to the right.

        By Mertsalov inertia, T_II and dT_I stand to the right of moment, work and energy.
        """
        origins, at = [], 0.0
        for low, high in self._reaches():
            origins.append(complex(0.0, at - low))
            at += high - low + _GAP
        if self.by_mertsalov:
            energy, work, moment = origins
            first, second, inertia = (origin + self.length + _BETWEEN for origin in origins)
            return Places(moment, work, energy, inertia, second=second, first=first)
        inertia, energy, work, moment = origins
        right = self.length + _ENERGY_OFFSET
        return Places(moment, work, energy, inertia, complex(right, inertia.imag))

    @cached_property
    def exact(self) -> Reading:
        """Read without error, mm."""
        return Reading(evaluate(self.construction.program, self.construction.data, Float64()), 1)

    @cached_property
    def ruler_reading(self) -> Reading:
        """Read with the ruler."""
        hand = RulerArithmetic(ruler=self.profile.ruler)
        return Reading(evaluate(self.construction.program, self.construction.data, hand), 1)

    @cached_property
    def errors(self) -> Errors:
        """Errors of KL or AB, mm, and J_f, kg·m²: labels ``KL`` or ``AB``, ``J_f``."""
        made = self.construction
        items = tuple(
            DrawnQuantity(name, (name,), number(name), DrawnKind.NUMBER)
            for name in (made.segment, made.J_f)
        )
        free = frozenset(str(axes.origin) for axes in made.axes.values())
        drawn = Drafted(made.program, lambda _: dict(made.data), 1, self.profile, free, items, ())
        return Errors(drawn)

    @property
    def inertia(self) -> float:
        """J_f as the construction has it without a pencil, kg·m²."""
        return float(self.exact.number(self.construction.J_f)[0])

    @property
    def read_inertia(self) -> float:
        """J_f as found by hand, kg·m²."""
        return float(self.ruler_reading.number(self.construction.J_f)[0])

    @property
    def adopted(self) -> float:
        """J_f of the flywheel to be made, kg·m²: as found by hand; None if none is needed.

        The exact one where the construction, too coarse, finds none.
        """
        exact = self.flywheel.exact.inertia
        return 0.0 if exact <= 0.0 else max(self.read_inertia, 0.0) or exact

    @property
    def sigma(self) -> float:
        """Drafting error of J_f, kg·m²."""
        return float(self.errors.spreads[self.construction.J_f].sigma[0])


@memoized
def drawing_of(flywheel: Flywheel, profile: Profile) -> FlywheelDrawing:
    """Return the diagrams of a flywheel as drawn by hand, made at the first call."""
    return FlywheelDrawing(flywheel, profile)


def _fitting(values: np.ndarray[tuple[int, ...], np.dtype[np.float64]], maximum: float) -> float:
    return choose_scale((float(np.max(np.abs(values))), 0.0), (maximum, 1.0))


class Split(Struct, frozen=True):
    """Error of a construction, kg·m², in parts that add up (разложение расхождения).

    Attributes
    ----------
    slopes : float
        From slopes 1 ± delta instead of (1 ± delta/2)²; 0 for Mertsalov's method.
    method : float
        From the mean speed in T_II instead of the greatest and the least (Mertsalov); 0 for
        Wittenbauer's method.
    positions : float
        From the finite number of positions.
    pencil : float
        From lengths read with the ruler; ``sigma`` is the standard deviation due to all strokes.
    """

    slopes: float
    method: float
    positions: float
    pencil: float
    sigma: float


def split(drawing: FlywheelDrawing) -> Split:
    """Return the error of the construction and its parts (разложить расхождение)."""
    wheel = drawing.flywheel
    whole = wheel.tangents(*wheel.usual_slopes, wheel.middle_speed).inertia
    off = whole - wheel.exact.inertia
    return Split(
        0.0 if drawing.by_mertsalov else off,
        off if drawing.by_mertsalov else 0.0,
        drawing.inertia - whole,
        drawing.read_inertia - drawing.inertia,
        drawing.sigma,
    )
