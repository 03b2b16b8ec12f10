"""Two wheels with involute teeth as a problem file states them (эвольвентное зацепление)."""

from __future__ import annotations

from math import cos, pi, sin, tan
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from planmethod.problem.head import KindProblem
from planmethod.record import dataclass

Reals: TypeAlias = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Rack:
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

        The standard rounds 0.37995 to 0.38. A narrow rack has only room for a smaller one.
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


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshingProblem(KindProblem):
    """A pair of wheels to be drawn in mesh (лист «Синтез эвольвентного зацепления»).

    Attributes
    ----------
    z : (int, int)
        Teeth of the driving wheel 1 and of wheel 2.
    m : float, mm
        Module.
    x : (float, float)
        Shifts of the rack, in modules.
    chosen : bool
        They were chosen by the blocking limits, not given.
    cutter : int
        Teeth of the pinion cutter (долбяк) of an internal wheel 2; 0 where both are external.
    a_w : float or None, mm
        Distance of the axes where the file gives it.
    tip : float
        Least tooth thickness at the tip, in modules.
    overlap : float
        Least contact ratio.
    """

    z: tuple[int, int]
    m: float
    rack: Rack
    x: tuple[float, float]
    chosen: bool
    a_w: float | None
    tip: float
    overlap: float
    cutter: int = 0
