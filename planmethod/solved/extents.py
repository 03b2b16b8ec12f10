"""Sizes of a mechanism and of its plans in all positions, at unit scales (размеры планов)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.build import Construction
from planmethod.plans.model import RATES, PlanKind
from planmethod.problem.model import Problem
from planmethod.solved.legibility import FEW, Box, Texts
from planmethod.solved.reading import Complexes, Memoizing, Reading, Reals

OUTLIER = 3.0
"""Ratio of a plan to the median one above which it is ignored in the choice of the paper: it is
near a dead position. It still fits on the paper."""

AWAY, BEYOND = 4.0, 100.0
"""Ratios of the mechanism in a position, and of a plan, to the median ones above which a position
is not drawn: at a common scale all others would be unreadable, at its own the known vectors."""

LARGER, WIDENS = 1.4, 1.55
"""Ratios of the mechanism in one of many positions to the median one, and of the scheme with it to
that of positions below the first ratio: where both are exceeded it is not on the scheme, though its
plans are drawn, or the joints of all others would be a knot."""

VANISHES = 0.01
"""Part of the longest vector of a plan below which one does not count as read."""


def _spread(si: Reading, names: list[PointName]) -> tuple[Reals, Reals]:
    """Return the width and height of points in every position, in their unit, shape (n,)."""
    points = np.stack([si.point(name) for name in names])
    return np.ptp(points.real, axis=0), np.ptp(points.imag, axis=0)


def _plan_ends(construction: Construction, kind: PlanKind) -> list[PointName]:
    plan = construction.plan(kind)
    return sorted({end for vector in plan.vectors for end in (vector.tail, vector.head)})


def plan_extent(construction: Construction, si: Reading, kind: PlanKind, index: int) -> Box:
    """Return the size of a velocity or acceleration plan in one position, in its own unit."""
    ends = _plan_ends(construction, kind)
    if not ends:
        return 0.0, 0.0
    width, height = _spread(si, ends)
    return float(width[index]), float(height[index])


def sizes(construction: Construction, si: Reading, kind: PlanKind) -> tuple[Reals, Reals]:
    """Return width and height of a plan in every position, in its unit, shape (n,).

    For the mechanism it is the size of all positions superposed.
    """
    if kind is PlanKind.POSITION:
        return _superposed(_places(construction, si))
    ends = _plan_ends(construction, kind)
    return _spread(si, ends) if ends else (np.zeros(si.count), np.zeros(si.count))


def _places(construction: Construction, si: Reading) -> Complexes:
    """Return the places of all points of a mechanism and of its wheels, m, shape (points, n)."""
    draft = construction.draft
    names = [PointName(point) for point in draft.points()]
    names += [
        PointName(f"{slide.label}:0")
        for slide in draft.problem.slides.values()
        if slide.host == FRAME and slide.through is None
    ]
    points = np.stack([si.point(name) for name in sorted(names)])
    return np.concatenate([points, *_wheels(draft.problem, si)])


def _superposed(places: Complexes) -> tuple[Reals, Reals]:
    """Return the width and height of a mechanism in all positions together, shape (1,)."""
    return np.array([np.ptp(places.real)]), np.array([np.ptp(places.imag)])


def _wheels(problem: Problem, si: Reading) -> Iterator[Complexes]:
    """Yield the ends of the horizontal and vertical diameters of wheels, shape (4, n)."""
    for mesh in problem.meshes:
        for link, radius, centre in zip(mesh.mesh.links, mesh.radii, mesh.centres, strict=True):
            if radius and centre and not (mesh.mesh.rolls and link == FRAME):
                ways = radius * np.array([1, -1, 1j, -1j])[:, None]
                yield si.point(PointName(centre)) + ways


def _median_vectors(construction: Construction, si: Reading, kind: PlanKind) -> Reals:
    """Return the median length of the vectors of a plan in every position, in its unit."""
    vectors = construction.plan(kind).vectors
    if not vectors:
        return np.zeros(si.count)
    lengths = np.stack([np.abs(si.vector(vector.tail, vector.head)) for vector in vectors])
    least = VANISHES * lengths.max(axis=0)
    return np.array(
        [typical(own[own > limit]) for own, limit in zip(lengths.T, least, strict=True)]
    )


def smallest_plan(construction: Construction, si: Reading, kind: PlanKind) -> float:
    """Return the larger side of the smallest plan of a kind in all positions, in its unit."""
    return float(np.maximum(*sizes(construction, si, kind)).min())


def extent(construction: Construction, si: Reading, kind: PlanKind) -> Box:
    """Return the size of the drawing, in its own unit: for plans the largest, without outliers."""
    return _usual(*sizes(construction, si, kind))


def _usual(width: Reals, height: Reals) -> Box:
    """Return the largest of sizes without outliers."""
    size = np.maximum(width, height)
    usual = size <= OUTLIER * typical(size)
    return float(np.max(width[usual])), float(np.max(height[usual]))


def median(sizes: Reals) -> float:
    """Return the median of (N,) sizes; numpy's own would import its masked arrays."""
    ordered = np.sort(sizes)
    return float(ordered[(len(ordered) - 1) // 2] + ordered[len(ordered) // 2]) / 2


def typical(sizes: Reals) -> float:
    """Return the median of the sizes of plans, (N,); of points alone 0.

    Plans that are points do not count: a mechanism may rest in most of its positions.
    """
    seen = sizes[sizes > 0.0]
    return median(seen) if seen.size else 0.0


class Extents(Memoizing):
    """Sizes of a mechanism and its plans, at unit scales (размеры планов).

    Values needed for one paper after another are computed once.

    Parameters
    ----------
    construction : Construction
    si : Reading
        Exact, at unit scales.
    """

    def __init__(self, construction: Construction, si: Reading) -> None:
        super().__init__()
        self.construction, self.si = construction, si

    def part(self, construction: Construction, si: Reading, rows: slice) -> Extents:
        """Return how large one of many variants is, whose positions are some of these."""
        found = Extents(construction, si)
        whole = self.plans
        found.plans = {kind: (wide[rows], high[rows]) for kind, (wide, high) in whole.items()}
        found.texts = self.texts
        return found

    @cached_property
    def plans(self) -> dict[PlanKind, tuple[Reals, Reals]]:
        """Width and height of the plans in every position, shape (n,)."""
        return {kind: sizes(self.construction, self.si, kind) for kind in RATES}

    @cached_property
    def sizes(self) -> dict[PlanKind, tuple[Reals, Reals]]:
        """Width and height of the drawing in every position, shape (n,): of the drawable ones."""
        scheme = _superposed(_places(self.construction, self.si)[:, self.on_scheme])
        return {PlanKind.POSITION: scheme, **self.plans}

    def scheme_in(self, positions: Sequence[int]) -> Box:
        """Return the width and height of the scheme that shows some positions, m."""
        own = [index for index in positions if self.on_scheme[index]] or list(positions)
        (width,), (height,) = _superposed(_places(self.construction, self.si)[:, own])
        return float(width), float(height)

    @cached_property
    def drawable(self) -> NDArray[np.bool_]:
        """True where the mechanism and its plans are in proportion to the others, shape (n,).

        They are not where a dead position is so near that points go far away from the mechanism.
        """
        found: NDArray[np.bool_] = self._ratios <= AWAY
        for wide, high in self.plans.values():
            size = np.maximum(wide, high)
            found &= size <= BEYOND * typical(size)
        return found if found.any() else np.ones_like(found)

    @cached_property
    def on_scheme(self) -> NDArray[np.bool_]:
        """True in the drawable positions that the scheme shows, shape (n,).

        Of many, not those in which the mechanism is far larger than it usually is.
        """
        if len(self.drawable) <= FEW:
            return self.drawable
        places = _places(self.construction, self.si)
        found = self.drawable & (self._ratios <= LARGER)
        usual = np.flatnonzero(found).tolist()
        widest = WIDENS * float(np.max(_superposed(places[:, usual])))
        for index in np.flatnonzero(self.drawable & ~found).tolist():
            found[index] = float(np.max(_superposed(places[:, [*usual, index]]))) <= widest
        return found

    @cached_property
    def _ratios(self) -> Reals:
        """Sizes of the mechanism in every position, relative to the median one, shape (n,)."""
        places = _places(self.construction, self.si)
        size = np.maximum(np.ptp(places.real, axis=0), np.ptp(places.imag, axis=0))
        usual = typical(size)
        return size / usual if usual else np.zeros_like(size)

    @cached_property
    def vectors(self) -> dict[PlanKind, Reals]:
        """Median length of the vectors of a plan in every position, shape (n,): half are shorter.

        Vectors that vanish do not count.
        """
        return {kind: _median_vectors(self.construction, self.si, kind) for kind in RATES}

    @cached_property
    def largest(self) -> dict[PlanKind, Box]:
        """Width and height of the largest that is not an outlier."""
        return {kind: _usual(*each) for kind, each in self.sizes.items()}

    @cached_property
    def texts(self) -> Texts:
        """Contents of the texts of a sheet."""
        return Texts.of(self.construction)
