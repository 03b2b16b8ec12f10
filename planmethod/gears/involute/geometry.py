"""Two involute wheels as a file states them: sizes, tooth profile, cutting by a rack."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from functools import cached_property
from math import asin, atan, atan2, cos, pi, sin, sqrt, tan
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from planmethod.gears.angles import angle_of_involute, involute, tips_apart
from planmethod.problem.records import KindProblem

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


Points = NDArray[np.complex128]

_HALVINGS = 100
_SMALL = 0.05  # below it x − arctan x is a sum of powers, its difference would lose digits


class Tooth(Struct, frozen=True, dict=True):
    """Tooth of a wheel of a pair (зуб колеса); ``wheel`` is 0 or 1."""

    pair: Pair
    wheel: int

    @property
    def z(self) -> int:
        """Number of teeth of the wheel."""
        return abs(self.pair.z[self.wheel])

    @property
    def side(self) -> int:
        """-1 of an internal wheel, whose tooth points to its centre; else 1."""
        return -1 if self.pair.z[self.wheel] < 0 else 1

    def size(self, name: str) -> float:
        """Return a size of the wheel by its name in `Pair`."""
        return float(getattr(self.pair, name)[self.wheel])

    def half(self, rho: Reals | float) -> Reals:
        """Return half of the angle of the tooth where its profile has a radius of curvature."""
        roll = np.asarray(rho) / (self.size("d_b") / 2)
        whole = self.size("s") / self.size("d") + involute(self.pair.alpha_t)
        return np.asarray(self.side * (whole - (roll - np.arctan(roll))))

    def flank(self, rho: Reals | float) -> Points:
        """Return points of the involute by the radius of curvature, mm (эвольвента)."""
        radius = np.hypot(self.size("d_b") / 2, rho)
        return np.asarray(radius * np.exp(-1j * self.half(rho)))

    def fillet(self, theta: Reals | float) -> Points:
        """Return points of the fillet (переходная кривая), the envelope of the rack's tip.

        Parameters
        ----------
        theta : array of float, rad
            Between the normal of the rack's rounded tip and the axis of the rack's tooth, in the
            normal section: 0 where the root circle begins, π/2 − α where the involute does.

        Notes
        -----
        The normal at the point of contact goes through the pitch point, the rolling of the rack's
        line on the pitch circle turning about it. A point of the rounded tip at the depth D below
        that line is then D·tan θ·cos β beside the pitch point: in the transverse section the
        rack is wider by 1/cos β.
        """
        if self.side < 0:
            return self._fillet_of_cutter(np.asarray(theta))
        m, radius = self.pair.m, self.size("d") / 2
        corner, rho = self.pair.rack.corner * m, self.pair.rack.rho * m
        depth = -corner.imag - float(self.pair.x[self.wheel]) * m
        narrow = cos(self.pair.beta)
        low = depth + rho * np.cos(theta)
        beside = low * np.tan(theta) * narrow
        place = radius - low + 1j * beside
        turned = (beside - (corner.real + rho * np.sin(theta)) / narrow) / radius
        return np.asarray(place * np.exp(-1j * (turned + pi / self.z)))

    def _fillet_of_cutter(self, chi: Reals) -> Points:
        """Return the path of the corner of the cutter's tip in the ring.

        ``chi`` is the angle between the line of centres and the corner, seen from the cutter's
        axis: 0 at the root circle. The cutter's tooth is in the space at −π/z where the corner
        has half of the angle of its tip.
        """
        pair, z = self.pair, self.pair.cutter
        half = pi / (2 * z) + float(involute(pair.rack.alpha) - involute(pair.alpha_a0))
        turned = (half - chi) * z / self.z
        place = float(pair.a_w0) + pair.d_a0 / 2 * np.exp(1j * chi)
        return np.asarray(place * np.exp(1j * (turned - pi / self.z)))

    @cached_property
    def _crossing(self) -> tuple[float, float]:
        """Point where the fillet of an undercut tooth meets its involute: θ, and its radius, mm.

        As θ grows, the fillet moves away from the centre. Where it passes the base circle it is
        inside the tooth; at its end, on the other branch of the involute beyond N, it is outside.
        In between it crosses the involute. Everything is measured from that end, from which a
        trace of undercut is no farther than the square of its ρ_l.
        """
        last, radius, base = self._last, self.size("d") / 2, self.size("d_b") / 2
        m, narrow = self.pair.m, cos(self.pair.beta)
        corner, rho = self.pair.rack.corner * m, self.pair.rack.rho * m
        depth = -corner.imag - float(self.pair.x[self.wheel]) * m
        low = depth + rho * cos(last)
        end = complex(radius - low, low * tan(last) * narrow)
        beyond = self.size("rho_l") / base

        def at(back: float) -> tuple[float, float]:
            """Square of ρ/r_b, and how far the fillet lies within the involute, rad."""
            half = 2 * sin(back / 2)
            d_sine, d_low = -cos(last - back / 2) * half, rho * sin(last - back / 2) * half
            d_tangent = -sin(back) / (cos(last) * cos(last - back))
            d_beside = narrow * (depth * d_tangent + rho * d_sine)
            turned = (d_beside - rho * d_sine / narrow) / radius
            moved = complex(-d_low, d_beside)
            across = end.conjugate() * moved
            squared = beyond**2 + (2 * across.real + abs(moved) ** 2) / base**2
            angle = atan2(across.imag, abs(end) ** 2 + across.real) - turned
            return squared, angle - _lag(-beyond) - _lag(sqrt(max(squared, 0.0)))

        lowest = bisect_condition(lambda back: at(back)[0] > 0, 0.0, last)
        back = bisect_condition(lambda back: at(back)[1] < 0, 0.0, lowest)
        return last - back, base * sqrt(max(at(back)[0], 0.0))

    @property
    def _last(self) -> float:
        """Angle at which the rounded tip of the rack ends at its straight flank, rad."""
        return pi / 2 - self.pair.rack.alpha

    @cached_property
    def theta(self) -> float:
        """Angle at which the fillet ends at the involute, rad: below π/2 − α with undercut."""
        if self.side < 0:
            return self.pair.alpha_a0 - float(self.pair.alpha_w0)
        return self._crossing[0] if self.is_cut else self._last

    @cached_property
    def rho_low(self) -> float:
        """Radius of curvature at the lowest point that the involute has, mm."""
        return self._crossing[1] if self.is_cut else self.size("rho_l")

    @cached_property
    def rho_high(self) -> float:
        """Radius of curvature at the tip, or where a pointed tooth ends below it, mm."""
        top = self.size("rho_a")
        if self.half(top) >= 0:
            return top
        return bisect_condition(lambda rho: bool(self.half(rho) > 0), self.rho_low, top)

    @property
    def is_cut(self) -> bool:
        """True if the fillet cuts off a part of the involute (подрезание)."""
        return self.side > 0 and self.size("rho_l") < 0

    @property
    def exists(self) -> bool:
        """True if a tooth remains: its two fillets do not meet."""
        angles = np.angle(self.fillet(np.linspace(0.0, self.theta, 200)))
        return bool(np.all(angles < 0) and self.rho_low < self.rho_high)

    def flank_points(self, count: int) -> Points:
        """Return points from the fillet to the tip, evenly spaced in the radius of curvature."""
        return self.flank(np.linspace(self.rho_low, self.rho_high, count))

    def fillet_points(self, count: int) -> Points:
        """Return points from the root circle to the involute, evenly spaced along the curve."""
        fine = np.linspace(0.0, self.theta, 40 * count)
        way = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(self.fillet(fine))))])
        return self.fillet(np.interp(np.linspace(0.0, way[-1], count), way, fine))

    def outline(self, count: int) -> Points:
        """Return the tooth from the middle of one space to that of the next one, mm."""
        root = abs(self.size("d_f")) / 2 * np.exp(-1j * pi / self.z)
        lower = np.concatenate([[root], self.fillet_points(count), self.flank_points(count)[1:]])
        return np.concatenate([lower, lower[::-1].conj()])


def _lag(roll: float) -> float:
    """Return x − arctan x, by which the involute has turned at ρ = x·r_b."""
    if abs(roll) >= _SMALL:
        return roll - atan(roll)
    square = roll * roll
    return roll * sum(-((-square) ** k) / (2 * k + 1) for k in range(1, 9))


def bisect_condition(condition: Callable[[float], bool], low: float, high: float) -> float:
    """Return the point between two bounds at which a condition ceases to hold."""
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if condition(middle) else (low, middle)
    return (low + high) / 2


class LineOfAction(Struct, frozen=True):
    """The line of action, by the radius of curvature of wheel 1, mm (линия зацепления).

    Attributes
    ----------
    start, end : float
        Begin and end of contact: limited by the tips, and by undercut.
    """

    start: float
    end: float

    @classmethod
    def of(cls, one: Tooth, two: Tooth) -> LineOfAction:
        """Return the line of action of two wheels."""
        whole = float(one.pair.line)
        return cls(
            max(whole - two.rho_high, one.rho_low, 0.0),
            min(one.rho_high, whole - two.rho_low, whole if two.side > 0 else np.inf),
        )

    def overlap(self, pair: Pair) -> float:
        """Return the contact ratio that the drawn teeth have."""
        return (self.end - self.start) / pair.p_b


class RackCutting(Struct, frozen=True):
    """A wheel and the rack that generates it (станочное зацепление); no ring has one."""

    tooth: Tooth

    @property
    def m(self) -> float:
        """Module."""
        return self.tooth.pair.m

    @property
    def radius(self) -> float:
        """Radius of the pitch circle, which rolls on the rack's machine pitch line."""
        return self.tooth.size("d") / 2

    @property
    def pitch(self) -> float:
        """Pitch of the rack in the transverse section."""
        return self.tooth.pair.p

    @property
    def displacement(self) -> float:
        """Distance x·m of the rack's reference line from the pitch circle, outwards positive."""
        return float(self.tooth.pair.x[self.tooth.wheel]) * self.m

    @property
    def clearance(self) -> float:
        """Radial clearance c*·m: distance of the rack's tip below its boundary line."""
        return self.tooth.pair.rack.c * self.m

    @property
    def boundary(self) -> float:
        """Distance of the boundary point B_l from N on the line of action; negative beyond N."""
        return self.tooth.size("rho_l")

    @property
    def min_displacement(self) -> float:
        """Displacement below which undercut begins: the boundary line passes through N."""
        return self.tooth.size("x_min") * self.m

    @property
    def cut_diameter(self) -> float | None:
        """Diameter below which undercut has taken the involute away; None without undercut."""
        if not self.tooth.is_cut:
            return None
        return 2 * abs(complex(self.tooth.flank(self.tooth.rho_low)))

    def rack_half(self, count: int) -> Points:
        """Return the rack from the middle of a tooth to that of the next space.

        The real part is from the machine pitch line outwards, the imaginary one from the axis of
        the rack's tooth. The space is the tooth turned about the middle of the flank.
        """
        rack = self.tooth.pair.rack
        theta = np.linspace(0.0, pi / 2 - rack.alpha, count)
        corner = complex(rack.corner.imag, rack.corner.real)
        round_tip = corner + rack.rho * (1j * np.sin(theta) - np.cos(theta))
        lower = np.concatenate([[-(rack.ha + rack.c) + 0j], round_tip])
        middle = 0.25j * pi
        whole = np.concatenate([lower, (2 * middle - lower)[::-1]])
        whole = whole.real + 1j * whole.imag / cos(self.tooth.pair.beta)  # the transverse section
        return np.asarray(whole * self.m + self.displacement)

    def rack_tooth(self, count: int) -> Points:
        """Return a tooth of the rack between the middles of its spaces."""
        half = self.rack_half(count)
        return np.concatenate([half[::-1].conj(), half[1:]])

    def to_wheel(self, points: Points, shift: float) -> Points:
        """Carry points of the rack, shifted along it, into the wheel, whose tooth has axis 0."""
        placed = self.radius + points + 1j * shift
        return np.asarray(placed * np.exp(-1j * (shift / self.radius + pi / self.tooth.z)))

    @property
    def at_pole(self) -> float:
        """Shift of the rack at which its flank passes through P₀."""
        return self.displacement * tan(self.tooth.pair.alpha_t) - self.pitch / 4

    def shifts(self, count: int) -> Reals:
        """Return shifts that cut a space from its fillets to the tips, evenly spaced."""
        alpha, tooth = self.tooth.pair.alpha_t, self.tooth
        ends = np.array([tooth.rho_low, tooth.rho_high])
        first, last = self.at_pole + (self.radius * sin(alpha) - ends) / cos(alpha)
        far = max(abs(last), abs(first))
        return np.linspace(-far, far, count)

    def on_line(self, rho: float) -> complex:
        """Return a point of the line of action from P₀, by its distance from N."""
        alpha = self.tooth.pair.alpha_t
        return (self.radius * sin(alpha) - rho) * complex(-sin(alpha), cos(alpha))
