"""Vectors of a plan that lie on one line, drawn beside one another (условно разнесённые векторы).

Overlapping vectors would hide each other's heads. The displaced ones keep their length and
direction, and the letters of points keep their places.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from planmethod.construct.steps import PointName
from planmethod.plans.model import Plan, Vector, is_component
from planmethod.render.labels.model import Segment, as_segments, inside
from planmethod.render.symbols import unit

_SPACING = 1.8
"""Between vectors drawn beside one another, mm."""

_HIDES = 0.3
"""Distance within which one vector hides another, mm."""

_SHARE, _LEAST = 0.6, 1.0
"""Part of the shorter vector, and its length in mm, that is hidden if the two cannot be read."""

_STEPS = (0, 1, -1, 2, -2, 3, -3)


def shifts_apart(segments: Sequence[Segment]) -> list[complex]:
    """Return the offsets at which vectors are drawn so that none hides another, mm.

    Parameters
    ----------
    segments : sequence of (complex, complex), mm
        Tails and heads; the first of those on one line keeps its place.
    """
    placed: list[Segment] = []
    shifts: list[complex] = []
    for tail, head in segments:
        along = unit(head - tail)
        across = 1j * (along if (along.imag, along.real) > (0.0, 0.0) else -along)
        for step in _STEPS:
            shift = step * _SPACING * across
            if not _hides((tail + shift, head + shift), placed):
                break
        placed.append((tail + shift, head + shift))
        shifts.append(shift)
    return shifts


def _hides(vector: Segment, placed: Sequence[Segment]) -> bool:
    """Return whether a vector and a placed one overlap along more than a point."""
    if not placed:
        return False
    ends = np.asarray(placed)
    start, way = ends[:, 0], ends[:, 1] - ends[:, 0]
    size = np.abs(way)
    turned = np.conj(way) / np.maximum(size, 1e-12)
    zero = np.zeros_like(size)
    boxes = np.stack([zero, zero - _HIDES, size, zero + _HIDES], axis=1)
    common = inside(as_segments((vector[0] - start) * turned, (vector[1] - start) * turned), boxes)
    short = np.minimum(size, abs(vector[1] - vector[0]))
    return bool((common >= np.maximum(_SHARE * short, _LEAST)).any())


def drawn_vectors(plan: Plan, at: Mapping[PointName, complex]) -> list[tuple[Vector, Segment]]:
    """Return the vectors of a plan with the ends between which they are drawn, mm.

    Of vectors on one line the longest is in its place, a resultant before a component; the others
    are beside it. ``at`` are the places of the points of the plan.
    """
    vectors = [vector for vector in plan.vectors if vector.tail != vector.head]
    segments = [(at[vector.tail], at[vector.head]) for vector in vectors]

    def rank(k: int) -> tuple[float, bool]:
        tail, head = segments[k]
        return -round(abs(head - tail), 1), is_component(vectors[k], plan.kind)

    order = sorted(range(len(vectors)), key=rank)
    shifts = dict(zip(order, shifts_apart([segments[k] for k in order]), strict=True))
    return [
        (vector, (tail + shifts[k], head + shifts[k]))
        for k, (vector, (tail, head)) in enumerate(zip(vectors, segments, strict=True))
    ]
