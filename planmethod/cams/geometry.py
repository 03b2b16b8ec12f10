"""Geometry of a cam in place: roller, profile, pressure angle, curvature (геометрия кулачка).

The cam turns counter-clockwise about the origin; a clockwise one is its mirror image. The
resting frame has the line of a translating follower at ``x = e``, the pivot of an oscillating one
on the x axis: on the right where it rises against the cam's turning, on the left else. Points are
complex, metres; curvatures positive where the profile is convex.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from planmethod.cams.laws import Reals
from planmethod.cams.model import CamProblem, Contact

Complexes: TypeAlias = NDArray[np.complexfloating[Any, Any]]


class CamPoints(NamedTuple):
    """Points and angles for angles of the cam; all arrays have their shape.

    ``roller``: its centre (the pointed edge, the point of the flat face) in the resting frame;
    ``theoretical``, ``actual``, ``outer``: profiles in the frame of the cam, the last is the other
    side of a groove; ``pressure`` rad; ``curvature`` of the pitch curve, 1/m; ``normal``
    the outward unit normal in the resting frame.
    """

    roller: Complexes
    theoretical: Complexes
    actual: Complexes
    outer: Complexes
    pressure: Reals
    curvature: Reals
    normal: Complexes


class CamGeometry(Struct, frozen=True):
    """A cam with known sizes.

    Attributes
    ----------
    r_min, e, centre, roller : float, m
        Minimum radius of the pitch curve (for a flat face: its minimum distance from the axis),
        offset, distance of the pivot (0: none), radius of the roller (0: none).
    """

    problem: CamProblem
    r_min: float
    e: float = 0.0
    centre: float = 0.0
    roller: float = 0.0

    @property
    def s0(self) -> float:
        """Height of the roller above the axis at rest, m."""
        return float(np.sqrt(self.r_min**2 - self.e**2))

    @property
    def delta0(self) -> float:
        """Angle between the arm at rest, or the flat face, and the line of centres, rad."""
        if self.problem.contact is Contact.FLAT:
            return float(np.arcsin(self.r_min / self.centre))
        arm, a = self.problem.arm, self.centre
        return float(np.arccos((a * a + arm * arm - self.r_min**2) / (2 * a * arm)))

    @property
    def side(self) -> int:
        """1 where the arm rises against the cam's turning, its pivot on the right; else -1."""
        return 1 if self.problem.sense.value == "opposite" else -1

    @property
    def pivot(self) -> complex:
        """Pivot of an oscillating follower in the resting frame, m."""
        return complex(self.side * self.centre)

    def points(self, phi: Reals, motion: Reals) -> CamPoints:
        """Return the points for angles of the cam.

        Parameters
        ----------
        phi : array of float, rad
        motion : array of float, shape (3, ...)
            s, v_q, a_q there, m.
        """
        flat = self.problem.contact is Contact.FLAT
        if self.problem.oscillates:
            made = self._plate if flat else self._arm
        else:
            made = self._level if flat else self._line
        roller, normal, pressure, curvature = made(motion)
        turn = np.exp(-1j * phi)
        shift = 0.0 if flat else self.roller * normal
        actual, outer = (roller - shift) * turn, (roller + shift) * turn
        return CamPoints(roller, roller * turn, actual, outer, pressure, curvature, normal)

    def _traced(
        self, b: Complexes, b1: Complexes, b2: Complexes, direction: Complexes
    ) -> tuple[Complexes, Complexes, Reals, Reals]:
        """Return centre, normal, pressure angle and curvature of a centre and its derivatives."""
        w = b1 - 1j * b  # seen from the cam
        w1 = b2 - 1j * b1
        size = np.abs(w)
        q = w / direction
        pressure = np.arctan2(q.real, -q.imag)
        curvature = (size**2 - np.imag(np.conj(w) * w1)) / size**3
        return b, 1j * w / size, pressure, curvature

    def _line(self, motion: Reals) -> tuple[Complexes, Complexes, Reals, Reals]:
        s, v, a = motion
        return self._traced(self.e + 1j * (self.s0 + s), 1j * v, 1j * a, 1j * np.ones_like(s))

    def _arm(self, motion: Reals) -> tuple[Complexes, Complexes, Reals, Reals]:
        arm, side = self.problem.arm, self.side
        s, v, a = motion / arm
        out = -side * np.exp(-1j * side * (self.delta0 + s))  # from the pivot to the roller
        b1 = -1j * side * v * arm * out
        b2 = (-1j * side * a - v * v) * arm * out
        return self._traced(self.pivot + arm * out, b1, b2, -1j * side * out)

    def _level(self, motion: Reals) -> tuple[Complexes, Complexes, Reals, Reals]:
        s, v, a = motion
        with np.errstate(divide="ignore"):
            curvature = 1 / (self.r_min + s + a)
        return v + 1j * (self.r_min + s), np.full(np.shape(s), 1j), 0 * s, curvature

    def _plate(self, motion: Reals) -> tuple[Complexes, Complexes, Reals, Reals]:
        side, centre = self.side, self.centre
        s, v, a = motion / self.problem.arm
        delta, ahead = self.delta0 + s, 1 + side * v
        out = -side * np.exp(-1j * side * delta)
        reach = centre * np.cos(delta) / ahead
        bend = np.sin(delta) * (1 + 2 * side * v) / ahead**2 + np.cos(delta) * a / ahead**3
        with np.errstate(divide="ignore"):
            curvature = 1 / (centre * bend)
        return self.pivot + reach * out, -1j * side * out, 0 * s, curvature

    def at(self, phi: Reals) -> CamPoints:
        """Return the same at angles of a turn; after a jump."""
        return self.points(phi, self.problem.at(phi))
