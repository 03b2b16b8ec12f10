"""Profile of a tooth cut by a rack: involute and fillet (профиль зуба).

Points are complex, in millimetres from the centre of the wheel; the axis of the tooth is the real
axis. What is computed is the flank below it, from the space at the angle −π/z up to the tooth; the
other flank is its mirror image.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from math import cos, pi

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from planmethod.gears.angles import involute
from planmethod.gears.involute.sizes import Pair, Reals

Points = NDArray[np.complex128]

_HALVINGS = 80
_SCANNED = 2000  # places of the fillet among which its crossing with the involute is looked for


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
        that line stands there D·tan θ·cos β beside the pitch point: in the transverse section the
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
        """Return the way of the corner of the cutter's tip in the ring.

        ``chi`` is the angle between the line of centres and the corner, seen from the cutter's
        axis: 0 at the root circle. The cutter's tooth stands in the space at −π/z where the corner
        has half of the angle of its tip.
        """
        pair, z = self.pair, self.pair.cutter
        half = pi / (2 * z) + float(involute(pair.rack.alpha) - involute(pair.alpha_a0))
        turned = (half - chi) * z / self.z
        place = float(pair.a_w0) + pair.d_a0 / 2 * np.exp(1j * chi)
        return np.asarray(place * np.exp(1j * (turned - pi / self.z)))

    def _inside(self, theta: Reals) -> Reals:
        """Return how far the fillet lies within the involute, rad; NaN below the base circle."""
        points = self.fillet(theta)
        base = self.size("d_b") / 2
        rho = np.sqrt(np.where(np.abs(points) >= base, np.abs(points) ** 2 - base**2, np.nan))
        return np.asarray(np.angle(points) + self.half(rho))

    @cached_property
    def theta(self) -> float:
        """Where the fillet ends at the involute, rad: before π/2 − α where it cuts it off."""
        if self.side < 0:
            return self.pair.alpha_a0 - float(self.pair.alpha_w0)
        last = pi / 2 - self.pair.rack.alpha
        if self.size("rho_l") >= 0:
            return last
        tried = np.linspace(0.0, last, _SCANNED)
        cut = np.flatnonzero(self._inside(tried) > 0)
        # A trace of undercut may be between the last place and the end.
        k = min(int(cut[-1]), _SCANNED - 2) if len(cut) else _SCANNED - 2
        return halved(lambda at: float(self._inside(np.array(at))) > 0, tried[k], tried[k + 1])

    @cached_property
    def rho_low(self) -> float:
        """Radius of curvature at the lowest point that the involute has, mm."""
        if self.size("rho_l") >= 0 or self.side < 0:
            return self.size("rho_l")
        reach = abs(complex(self.fillet(self.theta)))
        return float(np.sqrt(max(reach**2 - self.size("d_b") ** 2 / 4, 0.0)))

    @cached_property
    def rho_high(self) -> float:
        """Radius of curvature at the tip, or where a pointed tooth ends below it, mm."""
        top = self.size("rho_a")
        if self.half(top) >= 0:
            return top
        return halved(lambda rho: bool(self.half(rho) > 0), self.rho_low, top)

    @property
    def is_cut(self) -> bool:
        """Whether the fillet cuts off a part of the involute (подрезание)."""
        return self.side > 0 and self.size("rho_l") < 0

    @property
    def stands(self) -> bool:
        """Whether anything is left of the tooth: both fillets do not meet in it."""
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


def halved(holds: Callable[[float], bool], low: float, high: float) -> float:
    """Return where something ceases to hold between two bounds."""
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if holds(middle) else (low, middle)
    return (low + high) / 2


class LineOfAction(Struct, frozen=True):
    """The line of action, by the radius of curvature of wheel 1, mm (линия зацепления).

    Attributes
    ----------
    start, end : float
        Where contact begins and ends: the tips reach as far, and undercut has left an involute.
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
