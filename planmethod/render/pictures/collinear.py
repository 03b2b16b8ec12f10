"""Vectors of a plan that lie on one line, drawn beside one another (условно разнесённые векторы).

Overlapping vectors would hide each other's heads. The displaced ones keep their length and
direction, and the letters of points keep their places.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

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

_STEPS = (0, 1, -1)

_MOST, _SHORT, _PART = 3, 15.0, 0.2
"""Most vectors on one line, least length of a vector, mm, and largest offset as a part of it, for
which vectors are drawn apart: more of them, or shorter ones, would become a brush."""


def shifts_apart(
    segments: Sequence[Segment], *, always: bool = False, turning: bool = False
) -> list[complex]:
    """Return the offsets at which vectors are drawn so that none hides another, mm.

    Parameters
    ----------
    segments : sequence of (complex, complex), mm
        Tails and heads; the first of those on one line keeps its place.
    always : bool
        Also where many or short ones lie on one line: the sides of a polygon are followed by it.
    turning : bool
        The side is that of the vector, which turns from frame to frame, not of the paper.
    """
    return list(_shifts_apart(tuple(segments), always=always, turning=turning))


@lru_cache(maxsize=256)  # a plan's arrows, names and readings ask one after another
def _shifts_apart(
    segments: tuple[Segment, ...], *, always: bool, turning: bool
) -> tuple[complex, ...]:
    placed: list[Segment] = []
    shifts: list[complex] = []
    for tail, head in segments:
        along, length = unit(head - tail), abs(head - tail)
        across = 1j * (along if turning or (along.imag, along.real) > (0.0, 0.0) else -along)
        apart = always or (
            length >= _SHORT and _hides((tail, head), segments).sum() <= _MOST  # with itself
        )
        shift = 0j
        for step in (*_STEPS, 2, -2, 3, -3) if always else _STEPS:
            tried = step * _SPACING * across
            if not apart or not (always or abs(tried) <= _PART * length):
                break
            if not placed or not _hides((tail + tried, head + tried), placed).any():
                shift = tried
                break
        placed.append((tail + shift, head + shift))
        shifts.append(shift)
    return tuple(shifts)


def _hides(vector: Segment, placed: Sequence[Segment]) -> NDArray[np.bool_]:
    """Return which placed vectors a vector overlaps along more than a point."""
    ends = np.asarray(placed)
    start, way = ends[:, 0], ends[:, 1] - ends[:, 0]
    size = np.abs(way)
    turned = np.conj(way) / np.maximum(size, 1e-12)
    zero = np.zeros_like(size)
    boxes = np.stack([zero, zero - _HIDES, size, zero + _HIDES], axis=1)
    common = inside(as_segments((vector[0] - start) * turned, (vector[1] - start) * turned), boxes)
    short = np.minimum(size, abs(vector[1] - vector[0]))
    return np.asarray(common >= np.maximum(_SHARE * short, _LEAST))


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
