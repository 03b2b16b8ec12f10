"""Cutting of a wheel by a rack: its outline, its positions, the resulting tooth (нарезание рейкой).

Places of the rack are seen from the centre of the wheel, the real axis through the machine pitch
point P₀ outwards: the real part is the distance, the imaginary one along the rack. Millimetres.
"""

from __future__ import annotations

from math import cos, pi, sin, tan

import numpy as np
from msgspec import Struct

from planmethod.gears.involute.profile import Points, Tooth
from planmethod.gears.involute.sizes import Reals


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
