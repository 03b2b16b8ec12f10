"""Scales of the pictures of a cam, by the room that they have (масштабы)."""

from __future__ import annotations

from itertools import product
from math import degrees, radians
from operator import itemgetter
from typing import NamedTuple

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.cams.design import CamDesign, ends, is_plate, nodes_of, outline
from planmethod.cams.laws import Reals
from planmethod.cams.model import CamProblem
from planmethod.construct.scale import Scale, angle_scale, series_near

BOX_S, BOX_V, BOX_A = 50.0, 45.0, 60.0
"""Greatest ordinates of the diagrams, mm."""

DWELL_LENGTH = 30.0
"""Length of the axis of angles that shows a long lower dwell, mm: nothing happens in it."""

MIN_S_HEIGHT = 25.0
"""Least height of the diagram of s, mm: from it the profile is laid off."""

HEIGHTS = ((20.0, 100.0), (20.0, 130.0), (24.0, 160.0))
"""Least and greatest heights of the diagrams of s, v_q and a_q, mm."""

MIN_REGION_HEIGHT = 20.0
"""Least height of the curve s(v_q) on a paper that is not the largest, mm: r_min is read there."""

PRESSURE_HEIGHT = 40.0
"""Greatest ordinate of the diagram of the pressure angle at a degree per mm, mm."""

# mm: of an axis of angles, and of a pole from its axis of ordinates.
SHORTEST_AXIS, NEAREST_POLE, FARTHEST_POLE = 60.0, 7.0, 45.0


class CamScales(Struct, frozen=True):
    """Scales of the diagrams (масштабы): degrees per mm; m per mm of s, v_q, a_q.

    ``region``: m per mm of s over v_q; ``profile``: of the profile. ``pole_v`` and ``pole_a`` are
    the pole distances that follow, mm.
    """

    degree: float
    s: float
    v: float
    a: float
    region: float
    profile: float

    @property
    def phi(self) -> float:
        """Radians per mm."""
        return radians(self.degree)

    @property
    def pole_a(self) -> float:
        """Pole distance of the first integration, mm."""
        return self.v / (self.a * self.phi)

    @property
    def pole_v(self) -> float:
        """Pole distance of the second one, mm."""
        return self.s / (self.v * self.phi)

    def cut(self, problem: CamProblem) -> float:
        """Return how much of a long lower dwell is left out of the axis of angles, mm."""
        last = problem.last_dwell
        dwell = 0.0 if last is None else degrees(last.length) / self.degree
        return dwell - DWELL_LENGTH if dwell > 1.5 * DWELL_LENGTH else 0.0

    def scale(self, name: str) -> Scale:
        """Return the scale of s, v or a."""
        return Scale(f"mu_{name}", float(getattr(self, name)), "m")


def _motion(problem: CamProblem) -> Reals:
    """Return s, v_q and a_q over the turn, m, shape (3, n)."""
    return np.concatenate([ends(problem, one) for one in problem.stretches], 1)


def scales_of(
    design: CamDesign, fraction: float = 1.0, region: float = 150.0, profile: float = 220.0
) -> CamScales:
    """Return scales from the series: diagrams by a factor, region and profile by size in mm."""
    s, v, a = np.abs(_motion(design.problem)).max(axis=1)
    boxes = ((s, fraction * BOX_S), (v, fraction * BOX_V), (a or s, fraction * BOX_A))
    mu_s, mu_v, mu_a = (series_near(float(x) / mm, up=True) for x, mm in boxes)
    mu_s = min(mu_s, series_near(float(s) / MIN_S_HEIGHT, up=False))
    geometry = design.geometry
    room = max(geometry.r_min + s, 2 * (a if is_plate(design) else v))
    if design.problem.oscillates:
        room = max(room, design.problem.arm + v, geometry.centre * is_plate(design))
    wide = 2 * geometry.centre + geometry.roller if design.problem.oscillates else 0.0
    line = outline(design)
    wide = max(
        wide, *(float(np.ptp(part)) + 2 * geometry.roller for part in (line.real, line.imag))
    )
    return CamScales(
        angle_scale(180.0 / fraction), mu_s, mu_v, mu_a,
        region=series_near(float(room) / region, up=True),
        profile=series_near(wide / profile, up=True),
    )  # fmt: skip


def region_height(design: CamDesign, scales: CamScales) -> float:
    """Return the height of the curve s(v_q), mm."""
    return float(_motion(design.problem)[0].max()) / scales.region


class DiagramBox(NamedTuple):
    """Space of the diagrams, one below the other, mm: sizes, margin at the side, gap between."""

    width: float
    height: float
    margin: float
    between: float


def diagram_scales(design: CamDesign, box: DiagramBox, of: CamScales) -> CamScales | None:
    """Return scales with the longest axis of angles, and diagrams on it as high as fit.

    None is high at the cost of the others. Poles are neither far from the axes of ordinates nor
    near. None: no scales fit.
    """
    problem = design.problem
    motion = _motion(problem)
    sizes = np.maximum(motion.max(axis=1), 0.0) - np.minimum(motion.min(axis=1), 0.0)
    tries = [
        _scales_between(float(x) or float(sizes[0]), *y)
        for x, y in zip(sizes, HEIGHTS, strict=True)
    ]
    degree = series_near(360.0 / box.width, up=False)
    while degree <= 360.0 / SHORTEST_AXIS:
        found: list[tuple[float, CamScales]] = []
        for s, v, a in product(*tries):
            one = replace(of, degree=degree, s=s, v=v, a=a)
            heights = sizes / (s, v, a)
            high = float(np.sum(heights))
            if not is_plate(design):
                high += min(2 * PRESSURE_HEIGHT, 2 * PRESSURE_HEIGHT / degree) + box.between
            poles = (one.pole_a, one.pole_v)
            wide = 360.0 / degree - one.cut(problem) + max(poles) + box.margin
            is_seen = min(poles) >= NEAREST_POLE and max(poles) <= FARTHEST_POLE
            if is_seen and wide <= box.width and high + 3 * box.between <= box.height:
                found.append((float(np.sum(np.log(heights))), one))
        if found:
            return max(found, key=itemgetter(0))[1]
        degree = series_near(degree * 1.01, up=True)
    return None


def _scales_between(size: float, low: float, high: float) -> list[float]:
    """Return the scales of the series at which a size is drawn between two heights, mm."""
    found, scale = list[float](), series_near(size / high, up=True)
    while size / scale >= low:
        found.append(scale)
        scale = series_near(scale * 1.01, up=True)
    return found


def extent(design: CamDesign) -> tuple[float, float]:
    """Return the width and height of a profile with rollers and the circle of the pivot, m."""
    drawn, over = outline(design), design.geometry.roller
    if design.problem.oscillates:
        phi = np.linspace(0.0, nodes_of(design.problem)[-1].phi, 91)
        drawn = np.concatenate([drawn, design.geometry.pivot * np.exp(-1j * phi)])
        over = 0.0
    return float(np.ptp(drawn.real)) + 2 * over, float(np.ptp(drawn.imag)) + 2 * over
