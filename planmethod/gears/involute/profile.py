"""Profile of a tooth cut by a rack: involute and fillet (профиль зуба).

Points are complex, in millimetres from the centre of the wheel; the axis of the tooth is the real
axis. What is computed is the flank below it, from the space at the angle −π/z up to the tooth; the
other flank is its mirror image.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from math import atan, atan2, cos, pi, sin, sqrt, tan

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from planmethod.gears.angles import involute
from planmethod.gears.involute.sizes import Pair, Reals

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
