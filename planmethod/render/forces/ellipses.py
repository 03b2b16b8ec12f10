"""Ellipses of the drafting error at the vertices of a force plan (эллипсы погрешности)."""

from __future__ import annotations

from planmethod.construct.steps import PointName
from planmethod.render.forces.polygon import drawn_edges, find_overlap_shifts
from planmethod.render.pictures.ellipses import Ellipses, shown_ellipses
from planmethod.solved.errors.forces import drawn_forces
from planmethod.solved.forces.reading import ForceReading
from planmethod.solved.reading import memoized


@memoized
def vertex_ellipses(reading: ForceReading, number: int) -> Ellipses:
    """Return the ellipses around the vertices of a force plan.

    They are relative to the point where the construction of the plan begins, which is arbitrary. A
    vertex from which segments are drawn apart has its ellipse at the end of the first of them.
    """
    edges, shifts = drawn_edges(reading, number), find_overlap_shifts(reading, number)
    places: dict[PointName, complex] = {}
    for ends in ([edge.head for edge in edges], [edge.tail for edge in edges]):
        for end, shift in zip(ends, shifts, strict=True):
            places.setdefault(end, reading.corner(number, end) + shift)
    across = [place.real for place in places.values()]
    up = [place.imag for place in places.values()]
    size = max(max(across) - min(across), max(up) - min(up)) if places else 0.0
    share = reading.enlargement(number)
    return shown_ellipses(
        drawn_forces(reading.statics), reading.index, places, size, magnification=share
    )
