"""Divisions of a cam's turn and scales of its diagrams (деления и масштабы построения)."""

from __future__ import annotations

from math import radians

import numpy as np
from msgspec import Struct

from planmethod.cams.design import CamDesign
from planmethod.cams.geometry import Complexes
from planmethod.cams.laws import Reals
from planmethod.cams.model import TURN, CamPhase, CamProblem, Contact, Stretch
from planmethod.construct.scale import Scale, angle_scale, series_near

BOX_S, BOX_V, BOX_A = 50.0, 45.0, 60.0
"""Greatest ordinates of the diagrams, mm."""

MIN_S_HEIGHT = 25.0
"""Least height of the diagram of s, mm: from it the profile is laid off."""


class CamNode(Struct, frozen=True):
    """A division of the axis of angles (точка деления): its number, phase and angle, rad."""

    number: int
    phase: CamPhase
    phi: float
    starts: bool


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

    def scale(self, name: str) -> Scale:
        """Return the scale of s, v or a."""
        return Scale(f"mu_{name}", float(getattr(self, name)), "m")


def scales_of(
    design: CamDesign, fraction: float = 1.0, region: float = 150.0, profile: float = 220.0
) -> CamScales:
    """Return scales from the series: diagrams by a factor, region and profile by size in mm."""
    sizes = np.abs(
        np.concatenate([ends(design.problem, one) for one in design.problem.stretches], 1)
    )
    s, v, a = sizes.max(axis=1)
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


def ends(problem: CamProblem, stretch: Stretch) -> Reals:
    """Return s, v_q, a_q along a smooth part, its ends from within, shape (3, 33)."""
    return problem.on(stretch, np.linspace(stretch.start, stretch.end, 33))


def outline(design: CamDesign) -> Complexes:
    """Return the theoretical profile and the outer side of a groove, in the frame of the cam, m."""
    at = design.geometry.at(np.linspace(0.0, TURN, 721))
    return np.concatenate([at.theoretical, at.outer])


def is_plate(design: CamDesign) -> bool:
    """Return whether the follower is flat-faced."""
    return design.problem.contact is Contact.FLAT


def nodes_of(problem: CamProblem) -> tuple[CamNode, ...]:
    """Return the divisions of rise and return, numbered; a dwell has none of its own."""
    found: list[CamNode] = []
    for phase in (CamPhase.RISE, CamPhase.RETURN):
        start, length = problem.starts[phase], problem.length(phase)
        shared = bool(found) and problem.length(CamPhase.UPPER) == 0
        for k in range(shared, problem.parts + 1):
            phi = start + length * k / problem.parts
            found.append(CamNode(len(found), phase, phi, starts=k == 0))
    if problem.length(CamPhase.LOWER) == 0:
        found.pop()  # the next turn begins
    return tuple(found)


def stretch_of(problem: CamProblem, node: CamNode) -> Stretch:
    """Return the smooth part that a division ends, of the first one of a phase that it begins."""
    own = [one for one in problem.stretches if one.phase is node.phase]
    return next(one for one in own if node.starts or node.phi <= one.end + 1e-9)


def motion_in_division(problem: CamProblem, node: CamNode) -> Reals:
    """Return s, v_q, a_q in a division, m, from within its phase."""
    return problem.on(stretch_of(problem, node), np.array(node.phi))


def step_between(problem: CamProblem, start: float, end: float) -> float:
    """Return the height of the step that replaces a_q between two divisions, m.

    The ordinate in the middle; where a_q jumps between them, that of the same area.
    """
    slack = 1e-9
    inside = [one.start for one in problem.stretches if start + slack < one.start < end - slack]
    places = np.array([start, *inside, end])
    heights = problem.at((places[1:] + places[:-1]) / 2)[2]
    return float((heights * np.diff(places)).sum() / (end - start))
