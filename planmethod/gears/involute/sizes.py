"""Two involute wheels as a file states them, and their sizes (эвольвентное зацепление).

The sizes are by the formulas of GOST 16532 and GOST 19274 (геометрический расчёт), of spur and of
helical wheels.

An internal wheel has a negative number of teeth, as ISO 21771 has it: its shift, its diameters and
radii of curvature and the centre distance are negative too, and the same formulas hold. Its
root and fillet are those of the pinion cutter (долбяк), which has no shift.

Everything is computed for many pairs of shifts at once: arrays of one quantity of both wheels have
the shape (2, ...), those of the pair the shape (...). Lengths are millimetres, angles radians.
"""

from __future__ import annotations

from enum import Enum
from functools import cached_property
from math import asin, atan, cos, pi, sin, tan
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from planmethod.gears.angles import angle_of_involute, involute, tips_apart
from planmethod.problem.common import KindProblem

Reals: TypeAlias = NDArray[np.float64]


class Rack(Struct, frozen=True):
    """The basic rack, in modules (исходный контур, ГОСТ 13755).

    Attributes
    ----------
    alpha : float, rad
        Profile angle.
    ha, c : float
        Factors of the addendum and of the clearance.
    """

    alpha: float
    ha: float = 1.0
    c: float = 0.25

    @property
    def half_tip(self) -> float:
        """Half of the flat tip of the rack's tooth if it had sharp corners; none below 0."""
        return pi / 4 - (self.ha + self.c) * tan(self.alpha)

    @property
    def rho(self) -> float:
        """Radius of the rounded tip ρ_f: the largest that leaves the flank straight down to ha.

        The standard rounds 0.37995 to 0.38. A narrow rack only allows a smaller one.
        """
        room = self.half_tip * cos(self.alpha) / (1 - sin(self.alpha))
        return min(self.c / (1 - sin(self.alpha)), room)

    @property
    def straight(self) -> float:
        """Depth h_l from the reference line at which the straight flank ends (граничная точка)."""
        return self.ha + self.c - self.rho * (1 - sin(self.alpha))

    @property
    def corner(self) -> complex:
        """Centre of the rounded tip from the reference line in the middle of the rack's tooth."""
        depth = self.ha + self.c - self.rho
        return complex(pi / 4 - depth * tan(self.alpha) - self.rho / cos(self.alpha), -depth)


class ShiftAim(Enum):
    """Criterion for choosing shifts among those that meet the limits (критерий выбора смещений)."""

    BLOCKING = "blocking"  # the least of the greater specific sliding
    SLIDING = "equal-sliding"  # the same for both wheels, and the least such
    OVERLAP = "contact-ratio"  # the greatest contact ratio


class MeshingProblem(KindProblem, frozen=True, kw_only=True):
    """A pair of wheels to be drawn in mesh (лист «Синтез эвольвентного зацепления»).

    Attributes
    ----------
    z : (int, int)
        Teeth of the driving wheel 1 and of wheel 2.
    m : float, mm
        Module.
    x : (float, float)
        Shifts of the rack, in modules.
    aim : ShiftAim or None
        By what they were chosen within the blocking limits; None where they were given.
    cutter : int
        Teeth of the pinion cutter (долбяк) of an internal wheel 2; 0 where both are external.
    beta : float, rad
        Helix angle at the pitch cylinder (угол наклона линии зуба); 0 of spur wheels.
    width : float or None, mm
        Working width of the rims, which the overlap ratio ε_β needs.
    a_w : float or None, mm
        Distance of the axes where the file gives it.
    tip : float
        Least tooth thickness at the tip, in modules.
    overlap : float
        Least contact ratio.
    shift_wheel : int or None
        Wheel whose shift the file gives beside the centre distance: 0 or 1.
    """

    z: tuple[int, int]
    m: float
    rack: Rack
    x: tuple[float, float]
    aim: ShiftAim | None
    a_w: float | None
    tip: float
    overlap: float
    cutter: int = 0
    beta: float = 0.0
    width: float | None = None
    shift_wheel: int | None = None

    @property
    def chosen(self) -> bool:
        """True if the shifts were chosen, not given."""
        return self.aim is not None


class Pair(Struct, frozen=True, dict=True):
    """Two wheels in mesh without backlash (зубчатая пара).

    Attributes
    ----------
    z : (int, int)
    m : float, mm
    rack : Rack
    x : array of float, shape (2, ...)
        Shifts of the rack, in modules. What does not exist for them is NaN.
    cutter : int
        Teeth of the pinion cutter of an internal wheel 2; 0 where both are external.
    beta : float, rad
        Helix angle. Module, rack and shifts are those of the normal section, diameters, angles
        and thicknesses without a further word of the transverse one (торцовое сечение).
    """

    z: tuple[int, int]
    m: float
    rack: Rack
    x: Reals
    cutter: int = 0
    beta: float = 0.0

    @classmethod
    def of(cls, problem: MeshingProblem) -> Pair:
        """Return the pair of a problem."""
        z = (problem.z[0], -problem.z[1] if problem.cutter else problem.z[1])
        pair = cls(z, problem.m, problem.rack, np.zeros(2), problem.cutter, problem.beta)
        return pair.shifted(problem.x)

    def shifted(self, x: Reals | tuple[float, float]) -> Pair:
        """Return the same wheels cut with other shifts, with the signs of the standard."""
        one, two = np.asarray(x)
        x = np.stack([one, -two if self.cutter else two])
        return Pair(self.z, self.m, self.rack, x, self.cutter, self.beta)

    @property
    def side(self) -> int:
        """-1 for an internal pair, else 1: sign of the centre distance and of wheel 2."""
        return -1 if self.cutter else 1

    def _both(self, values: Reals) -> Reals:
        """Return one number of each wheel in a shape that broadcasts with the shifts."""
        return values.reshape(2, *[1] * (self.x.ndim - 1))

    def _of_ring(self, both: Reals, ring: Reals) -> Reals:
        """Return sizes of both wheels, where wheel 2 is internal with its own."""
        return (
            np.stack([both[0], np.broadcast_to(ring, np.shape(both[0]))]) if self.cutter else both
        )

    # The cutter -------------------------------------------------------------------------------

    @cached_property
    def alpha_w0(self) -> Reals:
        """Angle at which the cutter meshes with the ring, rad (угол станочного зацепления)."""
        shift = 2 * self.x[1] * np.tan(self.rack.alpha) / (self.cutter + self.z[1])
        return angle_of_involute(involute(self.rack.alpha) + shift)

    @cached_property
    def a_w0(self) -> Reals:
        """Distance of the cutter's axis from that of the ring, mm."""
        a = self.m * abs(self.cutter + self.z[1]) / 2
        return np.asarray(a * np.cos(self.rack.alpha) / np.cos(self.alpha_w0))

    @property
    def d_a0(self) -> float:
        """Tip diameter of the cutter, mm."""
        return self.m * (self.cutter + 2 * (self.rack.ha + self.rack.c))

    @property
    def alpha_a0(self) -> float:
        """Profile angle at the tip of the cutter, rad."""
        share = self.m * self.cutter * np.cos(self.rack.alpha) / self.d_a0
        return float(np.arccos(share))

    # The pair ---------------------------------------------------------------------------------

    @property
    def m_t(self) -> float:
        """Transverse module, mm (торцовый модуль)."""
        return self.m / cos(self.beta)

    @property
    def alpha_t(self) -> float:
        """Transverse profile angle, rad (угол профиля в торцовом сечении)."""
        return atan(tan(self.rack.alpha) / cos(self.beta)) if self.beta else self.rack.alpha

    @property
    def beta_b(self) -> float:
        """Helix angle at the base cylinder, rad (основной угол наклона)."""
        return asin(sin(self.beta) * cos(self.rack.alpha))

    @property
    def a(self) -> float:
        """Distance of the axes without shifts, mm (делительное межосевое расстояние)."""
        return self.m_t * sum(self.z) / 2

    @property
    def p(self) -> float:
        """Pitch on the pitch circles, mm (шаг)."""
        return pi * self.m_t

    @property
    def p_b(self) -> float:
        """Pitch on the base circles, mm (основной шаг)."""
        return self.p * float(np.cos(self.alpha_t))

    @cached_property
    def x_sum(self) -> Reals:
        """Sum of the shifts x_Σ."""
        return np.asarray(self.x[0] + self.x[1])

    @cached_property
    def inv_alpha_w(self) -> Reals:
        """Involute of the working pressure angle."""
        by_shift = 2 * self.x_sum * np.tan(self.rack.alpha) / sum(self.z)
        return np.asarray(involute(self.alpha_t) + by_shift)

    @cached_property
    def alpha_w(self) -> Reals:
        """Working pressure angle, rad (угол зацепления)."""
        return angle_of_involute(self.inv_alpha_w)

    @cached_property
    def a_w(self) -> Reals:
        """Distance of the axes, mm (межосевое расстояние)."""
        return np.asarray(self.a * np.cos(self.alpha_t) / np.cos(self.alpha_w))

    @cached_property
    def y(self) -> Reals:
        """Factor of the extension of the axes (коэффициент воспринимаемого смещения)."""
        return np.asarray((self.a_w - self.a) / self.m)

    @cached_property
    def delta_y(self) -> Reals:
        """Factor of the tip shortening (коэффициент уравнительного смещения)."""
        return np.asarray(self.x_sum - self.y)

    @cached_property
    def epsilon(self) -> Reals:
        """Contact ratio ε_α (коэффициент торцового перекрытия)."""
        return np.asarray((self.rho_a[0] + self.rho_a[1] - self.line) / self.p_b)

    @cached_property
    def line(self) -> Reals:
        """Length of the line of action N₁N₂, mm (линия зацепления)."""
        return np.asarray(self.a_w * np.sin(self.alpha_w))

    # Both wheels ------------------------------------------------------------------------------

    @cached_property
    def d(self) -> Reals:
        """Pitch diameters, mm (делительные)."""
        return self._both(self.m_t * np.array(self.z, dtype=float))

    @property
    def z_v(self) -> Reals:
        """Teeth of the equivalent spur wheels (эквивалентные числа зубьев)."""
        return np.array(self.z) / cos(self.beta) ** 3

    @cached_property
    def d_b(self) -> Reals:
        """Base diameters, mm (основные)."""
        return np.asarray(self.d * np.cos(self.alpha_t))

    @cached_property
    def d_w(self) -> Reals:
        """Working diameters, mm (начальные)."""
        return np.asarray(self.d_b / np.cos(self.alpha_w))

    @cached_property
    def d_a(self) -> Reals:
        """Tip diameters, mm (вершин)."""
        return np.asarray(self.d + 2 * self.m * (self.rack.ha + self.x - self.delta_y))

    @cached_property
    def d_f(self) -> Reals:
        """Root diameters, mm (впадин)."""
        depth = self.d - 2 * self.m * (self.rack.ha + self.rack.c - self.x)
        return self._of_ring(depth, -(2 * self.a_w0 + self.d_a0) if self.cutter else depth)

    @cached_property
    def s(self) -> Reals:
        """Tooth thickness on the pitch circle, mm."""
        return np.asarray(self.m_t * (pi / 2 + 2 * self.x * np.tan(self.rack.alpha)))

    @cached_property
    def e(self) -> Reals:
        """Width of the space on the pitch circle, mm (ширина впадины)."""
        return np.asarray(self.p - self.s)

    @cached_property
    def h(self) -> Reals:
        """Height of the tooth, mm."""
        return np.asarray(np.abs(self.d_a - self.d_f) / 2)

    @cached_property
    def alpha_a(self) -> Reals:
        """Profile angle at the tip, rad; NaN where the tip is within the base circle."""
        share = self.d_b / self.d_a
        return np.arccos(np.where((share > 0) & (share <= 1), share, np.nan))

    @cached_property
    def s_a(self) -> Reals:
        """Tooth thickness at the tip, mm; negative where the tooth is pointed below it."""
        half = self.s / self.d + involute(self.alpha_t) - involute(self.alpha_a)
        return np.asarray(self.d_a * half)

    @cached_property
    def s_na(self) -> Reals:
        """Thickness at the tip in the section across the tooth, mm (нормальная)."""
        lean = np.arctan(self.d_a / self.d * tan(self.beta))
        return np.asarray(self.s_a * np.cos(lean))

    @cached_property
    def rho_a(self) -> Reals:
        """Radius of curvature of the profile at the tip, mm."""
        return np.asarray(self.d_b / 2 * np.tan(self.alpha_a))

    @cached_property
    def rho_p(self) -> Reals:
        """Radius of curvature at the lower active point, mm (нижняя точка активного профиля)."""
        return np.asarray(self.line - self.rho_a[::-1])

    @cached_property
    def rho_l(self) -> Reals:
        """Radius of curvature where the fillet begins, mm (граничная точка); negative: undercut."""
        sine = np.sin(self.alpha_t)
        by_rack = self.d / 2 * sine - self.m * (self.rack.straight - self.x) / sine
        if not self.cutter:
            return np.asarray(by_rack)
        of_tip = self.d_a0 / 2 * np.sin(self.alpha_a0)
        return self._of_ring(by_rack, -(self.a_w0 * np.sin(self.alpha_w0) + of_tip))

    @cached_property
    def x_min(self) -> Reals:
        """Least shift without undercut."""
        sine = np.sin(self.alpha_t)
        least = self.rack.straight - self._both(np.array(self.z) * sine**2 / 2 / cos(self.beta))
        return self._of_ring(least, np.asarray(np.nan)) if self.cutter else least

    @property
    def z_min(self) -> float:
        """Least number of teeth without undercut and without shift."""
        return float(2 * self.rack.straight * cos(self.beta) / np.sin(self.alpha_t) ** 2)

    @cached_property
    def k(self) -> Reals:
        """Number of teeth spanned by the base tangent (число зубьев в длине общей нормали)."""
        z = self._both(np.array(self.z))
        share = z * np.cos(self.alpha_t) / (z + 2 * self.x * cos(self.beta))
        near = np.where(share < 1, np.tan(np.arccos(np.minimum(share, 1.0))), 0.0)
        near = near / cos(self.beta_b) ** 2
        shift = 2 * self.x * np.tan(self.rack.alpha) / z
        count = np.abs(z) / pi * (near - shift - involute(self.alpha_t)) + 0.5
        # The tables take the smaller of two equally near ones: 2 of 18 teeth, not 3.
        return np.asarray(np.maximum(2.0, np.ceil(count - 0.5 - 1e-9)))

    @cached_property
    def base_tangent(self) -> Reals:
        """Length W of the base tangent, mm (длина общей нормали)."""
        z = self._both(np.array(self.z))
        by_shift = 2 * self.x * np.tan(self.rack.alpha) + z * involute(self.alpha_t)
        by_shift = by_shift * np.sign(z)
        return np.asarray(self.m * np.cos(self.rack.alpha) * (pi * (self.k - 0.5) + by_shift))

    @cached_property
    def tips(self) -> Reals:
        """Angle that is left between the tips of an internal pair outside the mesh, rad."""
        one, two = np.abs(self.z)
        tip, lag = np.abs(self.d_a) / 2, involute(self.alpha_a)
        a_w = np.abs(self.a_w)
        return tips_apart((one, two), (tip[0], tip[1]), (lag[0], lag[1]), a_w, self.inv_alpha_w)

    def sliding(self, rho: Reals) -> Reals:
        """Return the specific sliding ϑ of both profiles (удельное скольжение).

        Parameters
        ----------
        rho : array of float, mm
            Radius of curvature of the profile of wheel 1 at the contact.

        Returns
        -------
        array of float, shape (2, ...)
            ϑ₁ = 1 − ρ₂·z₁/(ρ₁·z₂) and ϑ₂ the other way round; NaN where the flank has no contact.
        """
        one, two = self.z
        other = self.line - rho
        ratio = np.where((rho > 0) & (other * two > 0), other, np.nan) / rho * one / two
        return np.stack([1 - ratio, 1 - 1 / ratio])

    @cached_property
    def theta_p(self) -> Reals:
        """Specific sliding of each wheel at its own lower active point."""
        start, end = self.sliding(self.rho_p[0]), self.sliding(self.rho_a[0])
        return np.stack([start[0], end[1]])

    @cached_property
    def theta_a(self) -> Reals:
        """Specific sliding of each wheel at its own tip."""
        start, end = self.sliding(self.rho_p[0]), self.sliding(self.rho_a[0])
        return np.stack([end[0], start[1]])
