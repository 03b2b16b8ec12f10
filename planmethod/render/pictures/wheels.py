"""Wheels, racks and rolling wheels of a linkage drawn on its scheme (колёса на схеме, ГОСТ 2.770).

Pitch circles are dash-dot, a ring has its rim outside, a rack its back; a wheel that rolls has its
outline, and the line or circle of the frame on which it rolls. A dot marks each pole.
"""

# no messages: tags of items

from __future__ import annotations

from collections.abc import Collection
from typing import Protocol

import numpy as np

from planmethod.construct.steps import PointName
from planmethod.problem.mesh_records import GearMesh
from planmethod.problem.model import Problem, Slide
from planmethod.render.ink.drawing import Arc, Disc, Ink, Item, Pen
from planmethod.render.symbols import SIZES, ground_line
from planmethod.render.symbols.elements import rack_front
from planmethod.render.symbols.marks import pitch_circle
from planmethod.solved.solution import Solution

POLE = 0.8
"""Radius of the dot of a pole before ``factor``, mm."""

OVERHANG = 1.3
"""Half length of a rack, or of a rail beyond the wheel, in radii of the wheel."""


class Placed(Protocol):
    """A scheme in one position: what wheels are drawn on."""

    solution: Solution
    index: int
    pen: Pen

    @property
    def factor(self) -> float:
        """Size of the symbols."""

    def at(self, point: str) -> complex:
        """Return the place of a point on the paper, mm."""

    def line_direction(self, slide: Slide) -> complex:
        """Return the direction of a slide line, a unit vector."""


def contacts(problem: Problem) -> frozenset[str]:
    """Return the links that replace the contacts of rolling wheels: they are not drawn."""
    return frozenset(mesh.carrier for mesh in problem.mechanism.rolling)


def wheel_items(scheme: Placed, links: Collection[str] | None = None) -> list[Item]:
    """Return the wheels of all links, or of some, and the poles of their meshes."""
    found: list[Item] = []
    for mesh in scheme.solution.problem.meshes:
        for link in mesh.mesh.links:
            if links is None or link in links:
                found += _wheel(scheme, mesh, link)
    return found


def pole_items(scheme: Placed, links: Collection[str] | None = None) -> dict[str, list[Item]]:
    """Return the dots of the poles by their letters."""
    return {
        mesh.pole: [Disc(scheme.at(mesh.pole), POLE * scheme.factor, Ink.BLACK)]
        for mesh in scheme.solution.problem.meshes
        if links is None or set(links) & set(mesh.mesh.links)
    }


def _wheel(scheme: Placed, mesh: GearMesh, link: str) -> list[Item]:
    pole, tag = scheme.at(mesh.pole), f"wheel {link}"
    rolls = mesh.mesh.rolls
    if mesh.is_rack and link == mesh.mesh.links[1]:
        return _rail(scheme, mesh, pole) if rolls else _rack(scheme, mesh, pole)
    centre = scheme.at(mesh.centre(link))
    radius = abs(pole - centre)
    if rolls:
        return [Arc(centre, radius, pen=scheme.pen, tag=tag)]
    circle = pitch_circle(centre, radius, touch=pole, tag=tag)
    if mesh.kind == "internal" and mesh.radius(link) == max(mesh.radii):
        rim = radius + SIZES.slider_width / 2 * scheme.factor
        circle.append(Arc(centre, rim, pen=scheme.pen, tag=tag))
    return circle


def _rack(scheme: Placed, mesh: GearMesh, pole: complex) -> list[Item]:
    """Return a rack about its pole; its body is on the other side of the wheel."""
    slide = scheme.solution.problem.slides[mesh.slider]
    out = pole - scheme.at(mesh.centres[0])
    along = scheme.line_direction(slide)
    if (along * -1j * out.conjugate()).real < 0:
        along = -along
    half = along * OVERHANG * abs(out)
    return rack_front(pole - half, pole + half)


def _rail(scheme: Placed, mesh: GearMesh, pole: complex) -> list[Item]:
    """Return the line on which a wheel rolls in all positions, hatched away from it."""
    slide = scheme.solution.problem.slides[mesh.slider]
    along, out = scheme.line_direction(slide), pole - scheme.at(mesh.centres[0])
    places = scheme.solution.paper.point(PointName(mesh.pole))
    way = ((np.asarray(places) - pole) * along.conjugate()).real
    beyond = OVERHANG * abs(out)
    side = 1 if (out * (1j * along).conjugate()).real > 0 else -1
    ends = pole + along * (float(way.min()) - beyond), pole + along * (float(way.max()) + beyond)
    return list(ground_line(*ends, side=side, factor=scheme.factor, pen=scheme.pen))
