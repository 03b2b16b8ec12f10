"""Items and labels already on the paper, and their costs for the places of labels."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import acos
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray
from shapely import STRtree, box, buffer, linearrings, linestrings, points, polygons

from planmethod.render.ink.drawing import Arc, Bounds, Disc, Fill, Item, Stroke, Text
from planmethod.render.ink.typeset import arc_points, text_corners
from planmethod.render.labels.model import (
    BREAKABLE,
    CLEAR,
    SPARSE,
    VERTICAL_GAP,
    Candidates,
    Complexes,
    Floats,
    Label,
    Segment,
    as_segments,
    crossing,
    inside,
    starts_at_end,
)

FORBIDDEN = 1e6
CROSSED = 4000.0  # a label on a line, and its share per mm of line under it
_PER_MM = 20.0
_THROUGH = 60.0  # per filled area, an arrowhead mostly, that the leader runs through
_ROUND_LINES = CLEAR * np.array([-1, -1, 1, 1])
ROUND_AREAS = 0.54  # white between a label and a filled area, mm
_TEXT_SIDE_GAP = 0.6  # more of it at the sides of letters, mm: closer they would read as one word
_PARALLEL_COST = 25.0  # a leader line along a line
_PARALLEL_ANGLE = 0.2  # radians: lines at a smaller angle run along each other
_AT = 0.3  # mm: a nearer line goes through the point
_SAGITTA = 0.05  # how far the chords of a large arc may be off, mm
_PIECE = 12.0  # longest piece of a line in the tree, mm
_CELL = 0.5  # side of the cells of the raster of lines, mm
_PAIRS = 1 << 19  # of places and lines checked at once: each hit takes a hundred bytes


LED_STRANGER = 0.5
"""Fraction of the cost of a place nearer to another label's point, for a label with a leader line
to its own."""


class Paper:
    """Lines and areas that labels keep clear of, within bounds.

    Attributes
    ----------
    segments : ndarray of shape (n, 2, 2), mm
    breakable : ndarray of shape (n,)
        Flags of the thin ones, which a label may break as the last resort.
    bounds : Bounds, mm
    """

    def __init__(self, obstacles: Iterable[Item], bounds: Bounds) -> None:
        self.segments, self.breakable, areas = _split(obstacles)
        self.bounds = bounds
        self._directions: dict[complex, Complexes] = {}
        if len(self.segments):
            self.segments, self.breakable = _chopped(self.segments, self.breakable)
        self._lines = STRtree(linestrings(self.segments)) if len(self.segments) else None
        self._raster = _Raster(self.segments) if len(self.segments) else None
        self._areas = STRtree(areas) if areas else None

    def free(self, many: Sequence[Candidates]) -> list[NDArray[np.intp]]:
        """Return which places of each label are within the bounds, on no line and on no area."""
        boxes = np.concatenate([c.boxes for c in many])
        # Places with the same box, which differ by their leader lines, are neighbours.
        first = np.ones(len(boxes), dtype=bool)
        first[1:] = (boxes[1:] != boxes[:-1]).any(axis=1)
        ask = np.flatnonzero(first & self._are_inside(boxes))
        if self._lines is not None and self._raster is not None:
            ask = ask[~self._raster.meets(boxes[ask] + _ROUND_LINES)]
            grown = boxes[ask] + _ROUND_LINES
            which, line = self._lines.query(box(*grown.T))
            on_line = np.zeros(len(ask), dtype=bool)
            # Nearly every line whose box is hit is hit: after one line per place few are left to
            # check.
            pair = np.flatnonzero(np.diff(which, prepend=-1))
            for _ in range(2):
                at = which[pair]
                on_line[at[inside(self.segments[line[pair]], grown[at]) >= 0]] = True
                pair = np.flatnonzero(~on_line[which])
            ask = ask[~on_line]
        firsts = np.flatnonzero(first)
        found = np.isin(firsts, ask[self._area_costs(boxes[ask]) == 0.0], assume_unique=True)
        ask = np.flatnonzero(found[np.cumsum(first) - 1])
        counts = np.cumsum([len(c.boxes) for c in many])
        parts = np.split(ask, np.searchsorted(ask, counts[:-1]))
        return [part - first for part, first in zip(parts, [0, *counts], strict=False)]

    def costs(
        self,
        many: Sequence[Candidates],
        strangers: Sequence[complex] = (),
        lines: Sequence[Segment] = (),
        *,
        free: bool = False,
        may_interrupt_lines: bool = False,
    ) -> list[Floats]:
        """Return the costs of all places without other labels, one array for each label.

        ``strangers`` are the points that labels name, ``lines`` the segments. ``free`` places are
        not checked again for items under them. With ``may_interrupt_lines`` a label on thin lines
        costs little: it will break them.
        """
        led = np.concatenate([c.led for c in many])
        manners = [c.label.style for c in many]
        counts = [len(c.boxes) for c in many]
        costs = np.concatenate([c.dislike for c in many])
        if not free:
            boxes = np.concatenate([c.boxes for c in many])
            costs += self._line_costs(boxes, may_interrupt_lines=may_interrupt_lines)
            costs += np.where(self._are_inside(boxes), 0.0, FORBIDDEN)
            costs += self._area_costs(boxes)
        costs += np.where(led, np.repeat([m.leader for m in manners], counts), 0.0)
        ends = np.cumsum(counts)[:-1]
        # Few leader lines begin where no other segment is: the others need no further check.
        off = [
            _start_distances(c, cost, lines)
            for c, cost in zip(many, np.split(costs, ends), strict=True)
        ]
        near = np.repeat([AT_DOT if m.dotted else SHARED for m in manners], counts)
        never = np.repeat([m.other_segment for m in manners], counts)
        costs += np.where(np.concatenate(off) < near, never, 0.0)
        costs += self._between(many, led, costs)
        return [
            cost
            + np.maximum(
                _stranger_costs(c, cost, strangers), _other_segment_costs(c, cost, lines, starts)
            )
            + self._parallel_costs(c, cost)
            for c, cost, starts in zip(many, np.split(costs, ends), off, strict=True)
        ]

    def _are_inside(self, boxes: Floats) -> NDArray[np.bool_]:
        """Return flags of the boxes that are within the bounds."""
        x0, y0, x1, y1 = self.bounds
        return np.asarray(
            (boxes[:, 0] >= x0) & (boxes[:, 1] >= y0) & (boxes[:, 2] <= x1) & (boxes[:, 3] <= y1)
        )

    def _line_costs(self, boxes: Floats, *, may_interrupt_lines: bool) -> Floats:
        """Return the cost of the lines that run through the boxes grown by the white about them."""
        costs = np.zeros(len(boxes))
        if self._lines is None:
            return costs
        grown = boxes + _ROUND_LINES
        which, line = self._lines.query(box(*grown.T))
        lengths = inside(self.segments[line], grown[which])
        crossed = np.where(lengths >= 0, CROSSED + _PER_MM * np.maximum(lengths, 0), 0.0)
        if may_interrupt_lines:
            crossed *= np.where(self.breakable[line], 0.1, 1e3)
        np.add.at(costs, which, crossed)
        return costs

    def _area_costs(self, boxes: Floats) -> Floats:
        costs = np.zeros(len(boxes))
        if self._areas is not None:
            grown = boxes + np.array([-1, -1, 1, 1]) * ROUND_AREAS
            which, _ = self._areas.query(box(*grown.T), predicate="intersects")
            costs[which] += FORBIDDEN
        return costs

    def _between(
        self, many: Sequence[Candidates], led: NDArray[np.bool_], base_costs: Floats
    ) -> Floats:
        """Return the cost of items between the places and their named points or segments.

        With a line between, the label is read as another item's, with a leader line or without.
        """
        costs = np.zeros(len(base_costs))
        starts, ends = [c.starts for c in many], [c.ends for c in many]
        paths = as_segments(np.concatenate(starts), np.concatenate(ends))
        ask = np.flatnonzero(base_costs < CROSSED)
        lines = linestrings(paths[ask])
        if self._lines is not None and len(ask):
            counts = [len(c.boxes) for c in many]
            heavy = np.repeat([c.label.style.thick_line_cost for c in many], counts)
            thin = np.repeat([c.label.style.thin_line_cost for c in many], counts)
            # A vector's name beside it has no line between, a leader line may cross a thin one.
            named = np.repeat([c.label.style.other_segment >= CROSSED for c in many], counts)
            thin = np.where(named & ~led, heavy, thin)
            step = max(1, _PAIRS // len(self.segments))
            for first in range(0, len(ask), step):
                some = ask[first : first + step]
                which, line = self._lines.query(lines[first : first + step])
                met = crossing(paths[some], self.segments, which, line)
                found = some[which[met]]
                np.add.at(
                    costs, found, np.where(self.breakable[line[met]], thin[found], heavy[found])
                )
        lines, ask = lines[led[ask]], ask[led[ask]]
        if self._areas is not None and len(ask):
            which, area = self._areas.query(lines, predicate="intersects")
            # A leader may start inside what it names: a joint, a slider.
            owner = np.repeat(np.arange(len(many)), [len(c.boxes) for c in many])[ask[which]]
            anchors = np.asarray([c.label.anchor for c in many])
            at = points(anchors.real, anchors.imag)
            own, inner = self._areas.query(at, predicate="intersects")
            count = len(self._areas.geometries)
            met = ~np.isin(owner * count + area, own * count + inner)
            # An arrowhead is part of its vector: a leader through it crosses that vector.
            through = np.asarray([max(_THROUGH, c.label.style.thick_line_cost) for c in many])
            np.add.at(costs, ask[which[met]], through[owner[met]])
        return costs

    def _parallel_costs(self, candidates: Candidates, base_costs: Floats) -> Floats:
        """Return the cost of leader lines of a crowd that run along a line from the same point."""
        costs = np.zeros(len(base_costs))
        label = candidates.label
        ask = np.flatnonzero(candidates.led & (base_costs < CROSSED))
        if self._lines is None or label.style == SPARSE or not len(ask):
            return costs
        ways = self._line_directions(label.anchor)
        lines = candidates.ends[ask] - candidates.starts[ask]
        if len(ways):
            turn = np.abs(np.angle(lines[:, None] / ways[None, :])).min(axis=1)
            costs[ask] = np.where(turn < _PARALLEL_ANGLE, _PARALLEL_COST, 0.0)
        return costs

    def _line_directions(self, place: complex) -> Complexes:
        """Return the directions of the lines that go through a place."""
        if self._lines is None:
            return np.empty(0, dtype=complex)
        if place not in self._directions:
            near = self._lines.query(box(*_square(place, _AT)))
            ends = self.segments[near][:, :, 0] + 1j * self.segments[near][:, :, 1]
            meets = inside(self.segments[near], np.asarray([_square(place, _AT)])) >= 0
            ways = (ends[meets] - place).ravel()
            self._directions[place] = ways[np.abs(ways) > 2 * _AT]
        return self._directions[place]


class _Raster:
    """Points of segments counted in square cells: most boxes on a line are found by it at once."""

    def __init__(self, segments: Floats) -> None:
        way = segments[:, 1] - segments[:, 0]
        counts = np.ceil(np.hypot(way[:, 0], way[:, 1]) / _CELL).astype(int)
        whole = np.repeat(np.arange(len(segments)), counts)
        first = np.arange(len(whole)) - np.repeat(np.cumsum(counts) - counts, counts)
        places = segments[whole, 0] + way[whole] * (first / counts[whole])[:, None]
        self.corner = segments.min(axis=(0, 1)) // _CELL * _CELL
        cells = ((places - self.corner) / _CELL).astype(int)
        self.size = cells.max(axis=0, initial=0) + 1
        found = np.bincount(cells[:, 0] * self.size[1] + cells[:, 1], minlength=self.size.prod())
        self.sums = np.zeros(self.size + 1, dtype=np.intp)
        self.sums[1:, 1:] = found.reshape(self.size).cumsum(axis=0).cumsum(axis=1)

    def meets(self, boxes: Floats) -> NDArray[np.bool_]:
        """Return flags of boxes (n, 4) with a point in a cell wholly inside: surely on a line."""
        low = np.clip(np.ceil((boxes[:, :2] - self.corner) / _CELL).astype(int), 0, self.size)
        high = np.clip(((boxes[:, 2:] - self.corner) // _CELL).astype(int), low, self.size)
        (x0, y0), (x1, y1), sums = low.T, high.T, self.sums
        return np.asarray(sums[x1, y1] - sums[x0, y1] - sums[x1, y0] + sums[x0, y0] > 0)


_ONE_HEAD = 1.0  # distance within which the heads of two segments look like one, mm

AT_LINE = 2.0
"""Distance within which a name is read as another segment's, in spite of its leader line, mm."""

AT_LEADER = 0.8
"""Distance of the end of a leader line within which another segment seems to have it, too, mm."""

SHARED = 0.5
"""Distance within which it is at another segment as much as at its own, mm: it is not led there."""

AT_DOT = 1.0
"""The same of a leader line that begins with a dot, mm: the dot touches no other line."""


_STRAYS = 12.0  # cost of a leader line from another segment, or of a name nearer to one, mm


def _square(place: complex, half: float) -> Bounds:
    return place.real - half, place.imag - half, place.real + half, place.imag + half


def _stranger_costs(
    candidates: Candidates, base_costs: Floats, strangers: Sequence[complex]
) -> Floats:
    """Return the cost of places nearer to another label's point, reduced with a leader line."""
    costs = np.zeros(len(base_costs))
    dislike = candidates.label.style.stranger
    ask = np.flatnonzero(base_costs < CROSSED)
    if not dislike or not len(ask):
        return costs
    anchor = candidates.label.anchor
    others = np.asarray([z for z in strangers if abs(z - anchor) > 1e-6])
    if not len(others):
        return costs
    boxes = candidates.boxes[ask]
    own = distances(boxes, np.asarray([anchor]))[:, 0]
    dislikes = np.where(candidates.led[ask], LED_STRANGER * dislike, dislike)
    costs[ask] = np.where(distances(boxes, others).min(axis=1) < own + 0.4, dislikes, 0.0)
    return costs


def _start_distances(
    candidates: Candidates, base_costs: Floats, lines: Sequence[Segment]
) -> Floats:
    """Return how far leader lines of a segment's name begin from other segments, shape (n,).

    Infinite for a place without a leader line, or of no use.
    """
    off = np.full(len(base_costs), np.inf)
    label = candidates.label
    others = [line for line in lines if line != label.segment]
    if label.segment is None or not label.style.touching or not others:
        return off
    ask = np.flatnonzero(candidates.led & (base_costs < CROSSED))
    off[ask] = point_distances(candidates.starts[ask], np.asarray(others)).min(axis=1)
    return off


def _other_segment_costs(
    candidates: Candidates, base_costs: Floats, lines: Sequence[Segment], starts: Floats
) -> Floats:
    """Return the cost of places of a segment's name at or behind another label's segment.

    A name without a leader line is nearer to its own; one with it is not at another one, either,
    and not led from a head that other segments have, too. From a place beside another segment it is
    led only where the name would be left out: ``starts`` are the distances of `_start_distances`.
    """
    costs = np.zeros(len(base_costs))
    label = candidates.label
    others = [line for line in lines if line != label.segment]
    ask = np.flatnonzero(base_costs < CROSSED)
    if label.segment is None or not label.style.other_segment or not others or not len(ask):
        return costs
    ends, led = np.asarray(others), candidates.led[ask]
    nearer = np.zeros(len(ask), dtype=bool)
    strays = starts[ask] < AT_LEADER
    if label.style.other_segment >= CROSSED:  # of others a leader line may cross one
        if np.abs(ends[:, 1] - label.segment[1]).min() < _ONE_HEAD:
            nearer |= led & starts_at_end(label, candidates.starts[ask], 1)
        left = np.flatnonzero(~nearer & (not label.style.dotted))
        paths = as_segments(candidates.starts[ask[left]], candidates.ends[ask[left]])
        place, line = np.indices((len(left), len(others))).reshape(2, -1)
        nearer[left[place[crossing(paths, as_segments(*ends.T), place, line)]]] = True
    left = np.flatnonzero(~nearer)
    boxes = candidates.boxes[ask[left]]
    own = segment_distances(boxes, np.asarray([label.segment]))
    limits = np.where(led[left], AT_LINE, 1.3 * own + 0.4)
    x, y = ends.real, ends.imag
    grown = boxes + np.maximum(limits, own)[:, None] * np.array([-1, -1, 1, 1])
    near = (x.min(axis=1) < grown[:, 2:3]) & (x.max(axis=1) > grown[:, :1])
    near &= (y.min(axis=1) < grown[:, 3:]) & (y.max(axis=1) > grown[:, 1:2])
    place, line = np.nonzero(near)  # few pairs
    off = segment_distances(boxes[place], ends[line])
    nearer[left[place[off < limits[place]]]] = True
    strays[left[place[off < own[place]]]] = True
    costs[ask] = np.where(nearer, label.style.other_segment, np.where(strays, _STRAYS, 0.0))
    return costs


def segment_distances(boxes: Floats, lines: Complexes) -> Floats:
    """Return the distance of each box (n, 4) from its own or the only segment; none runs through.

    The segments have the shape (n, 2) or (1, 2).
    """
    start, end = lines[:, 0], lines[:, 1]
    way = end - start
    nearest = np.minimum(distances(boxes, start[:, None]), distances(boxes, end[:, None]))[:, 0]
    for x, y in ((0, 1), (0, 3), (2, 1), (2, 3)):
        reach = boxes[:, x] + 1j * boxes[:, y] - start
        part = (reach * way.conj()).real / np.maximum(np.abs(way) ** 2, 1e-12)
        off = np.abs(reach - way * np.clip(part, 0.0, 1.0))
        nearest = np.minimum(nearest, off)
    return np.asarray(nearest)


def point_distances(places: Complexes, lines: Complexes) -> Floats:
    """Return the distances of places (n,) from segments (k, 2), shape (n, k)."""
    start, way = lines[:, 0], lines[:, 1] - lines[:, 0]
    reach = places[:, None] - start
    part = (reach * way.conj()).real / np.maximum(np.abs(way) ** 2, 1e-12)
    return np.asarray(np.abs(reach - way * np.clip(part, 0.0, 1.0)))


def distances(boxes: Floats, places: NDArray[np.complex128]) -> Floats:
    """Return the distances of boxes (n, 4) from points (k,), shape (n, k)."""
    x, y = places.real, places.imag
    aside = np.maximum(np.maximum(boxes[:, :1] - x, x - boxes[:, 2:3]), 0.0)
    above = np.maximum(np.maximum(boxes[:, 1:2] - y, y - boxes[:, 3:]), 0.0)
    return np.hypot(aside, above)


def _split(
    items: Iterable[Item],
) -> tuple[Floats, NDArray[np.bool_], list[object]]:
    """Split items into segments (n, 2, 2) that should and areas that must not be covered."""
    lines: list[tuple[complex, complex]] = []
    thin: list[bool] = []
    outlines: list[Sequence[complex]] = []
    discs: list[Disc] = []
    for item in items:
        match item:
            case Stroke(points=path, closed=closed):
                lines += pairwise((*path, path[0]) if closed and path else path)
            case Arc():
                lines += pairwise(arc_points(item, step=arc_step(item)))
            case Fill(points=path) if len(path) > 2:
                outlines.append(path)
            case Disc():
                discs.append(item)
            case Text():
                sides = (-_TEXT_SIDE_GAP, _TEXT_SIDE_GAP, _TEXT_SIDE_GAP, -_TEXT_SIDE_GAP)
                outlines.append([p + s for p, s in zip(text_corners(item), sides, strict=True)])
            case Fill():
                pass  # no area
        if isinstance(item, (Stroke, Arc)):
            thin += [item.pen in BREAKABLE] * (len(lines) - len(thin))
    areas = [*_polygons(outlines), *_round(discs)]
    if not lines:
        return np.empty((0, 2, 2)), np.empty(0, dtype=bool), areas
    ends = np.asarray(lines)
    return as_segments(ends[:, 0], ends[:, 1]), np.asarray(thin), areas


def _polygons(outlines: Sequence[Sequence[complex]]) -> Iterable[object]:
    if not outlines:
        return ()
    corners = np.concatenate([np.asarray(outline) for outline in outlines])
    owner = np.repeat(np.arange(len(outlines)), [len(outline) for outline in outlines])
    rings = linearrings(np.column_stack([corners.real, corners.imag]), indices=owner)
    return np.asarray(polygons(rings))


def _round(discs: Sequence[Disc]) -> Iterable[object]:
    if not discs:
        return ()
    centres = np.asarray([disc.centre for disc in discs])
    at = points(centres.real, centres.imag)
    return np.asarray(buffer(at, [disc.radius for disc in discs], quad_segs=4))


def _chopped(segments: Floats, breakable: NDArray[np.bool_]) -> tuple[Floats, NDArray[np.bool_]]:
    """Return long segments in pieces, whose boxes the tree separates."""
    way = segments[:, 1] - segments[:, 0]
    counts = np.maximum(1, np.ceil(np.hypot(way[:, 0], way[:, 1]) / _PIECE)).astype(int)
    whole = np.repeat(np.arange(len(segments)), counts)
    first = np.arange(len(whole)) - np.repeat(np.cumsum(counts) - counts, counts)
    parts = np.stack([first, first + 1], axis=1) / counts[whole][:, None]
    pieces = segments[whole, :1] + way[whole][:, None, :] * parts[:, :, None]
    return pieces, breakable[whole]


def arc_step(arc: Arc) -> float:
    """Return the angle between points of an arc that keeps its chords near it, radians."""
    return min(0.25, 2 * acos(max(0.0, 1.0 - _SAGITTA / arc.radius))) if arc.radius > 0 else 0.25


LEADERS_CROSS = 300.0
"""Cost of two leader lines that cross."""

Numbers: TypeAlias = NDArray[np.intp]

_OFF_LEADERS = 0.5  # white between a label and another one's leader line, mm


class OverlapCosts(Struct):
    """Costs of one label's places from the others: shape (n, labels), and the others' stamps."""

    candidates: Candidates
    costs: Floats
    stamps: Numbers

    @classmethod
    def of(cls, candidates: Candidates, labels: int) -> OverlapCosts:
        """Return empty costs for a number of labels, none of them computed yet."""
        return cls(candidates, np.zeros((len(candidates.boxes), labels)), np.full(labels, -1))


class PlacedLabels:
    """Boxes and leader lines of the labels that are placed, by number."""

    def __init__(self, labels: Sequence[Label]) -> None:
        self._beside = np.asarray([label.style.side_gap for label in labels])
        self._widest = float(self._beside.max())
        self._boxes = np.full((len(labels), 4), np.nan)
        self._leaders = np.full((len(labels), 2, 2), np.nan)
        self._around = np.full((len(labels), 4), np.nan)
        self._there: dict[int, None] = {}
        self._stamps = np.full(len(labels), -1)
        self.changes = 0
        """Number of times that a label was placed or removed."""

    def add(self, k: int, candidates: Candidates, row: int, stamp: int) -> None:
        """Record the place of a label; its ``stamp`` is unique."""
        self._boxes[k] = candidates.boxes[row]
        self._leaders[k] = candidates.leaders[row]
        self._around[k] = candidates.around[row]
        self._there[k] = None
        self._stamps[k] = stamp
        self.changes += 1

    def remove(self, k: int) -> None:
        """Forget the place of a label."""
        self._there.pop(k, None)
        self.changes += 1

    def all_except(self, k: int) -> Numbers:
        """Return the numbers of the labels that are there, but for one."""
        return np.array([other for other in self._there if other != k], dtype=np.intp)

    def costs(self, k: int, candidates: Candidates, rows: Numbers) -> Floats:
        """Return the costs of some places from all labels but ``k``, shape (n,)."""
        there = self.all_except(k)
        return np.asarray(self.pair_costs(candidates, rows, there).sum(axis=1))

    def overlap_costs(self, choice: OverlapCosts, rows: Numbers, there: Numbers) -> Floats:
        """Return `pair_costs` of some places, cached for labels that have not moved."""
        old = choice.stamps[there] != self._stamps[there]
        away = np.zeros(0, dtype=np.intp)
        if len(rows) == 1 and old.any():  # for a single place only labels near it are checked
            around, white = choice.candidates.around[rows[0]], self._widest
            theirs = self._around[there]
            meets = (theirs[:, 2:] > around[:2] - white) & (theirs[:, :2] < around[2:] + white)
            near = meets[:, 0] & meets[:, 1]
            away, old = np.flatnonzero(old & ~near), old & near
        moved = there[old]
        if len(moved):
            every = np.arange(len(choice.costs))
            choice.costs[:, moved] = self.pair_costs(choice.candidates, every, moved)
            choice.stamps[moved] = self._stamps[moved]
        found = choice.costs[rows[:, None], there]
        found[:, away] = 0.0
        return np.asarray(found)

    def pair_costs(self, candidates: Candidates, rows: Numbers, numbers: Numbers) -> Floats:
        """Return the cost of each place from each of some labels, shape (n, len(others))."""
        costs = np.zeros((len(rows), len(numbers)))
        if not len(rows) or not len(numbers):
            return costs
        # Only a label near a place can overlap it.
        theirs, white = self._around[numbers], self._widest
        low, high = candidates.corners
        near = (theirs[:, 2:] > low - white) & (theirs[:, :2] < high + white)
        (close,) = np.nonzero(near[:, 0] & near[:, 1])
        if not len(close):
            return costs
        mine, theirs = candidates.around[rows], theirs[close]
        (row, other) = np.nonzero(
            (mine[:, None, 0] - white < theirs[:, 2])
            & (mine[:, None, 2] + white > theirs[:, 0])
            & (mine[:, None, 1] - white < theirs[:, 3])
            & (mine[:, None, 3] + white > theirs[:, 1])
        )
        other = close[other]
        if not len(row):
            return costs
        at, of = rows[row], numbers[other]
        a, b = candidates.boxes[at], self._boxes[of]
        size = np.minimum(a[:, 2:], b[:, 2:]) - np.maximum(a[:, :2], b[:, :2])
        wide = size[:, 0] + np.maximum(self._beside[of], candidates.label.style.side_gap)
        tall = size[:, 1] + VERTICAL_GAP
        found = np.where((wide > 0) & (tall > 0), FORBIDDEN + wide * tall, 0.0)
        own, led = candidates.leaders[at], self._leaders[of]
        has, have = ~np.isnan(own[:, 0, 0]), ~np.isnan(led[:, 0, 0])
        if has.any() or have.any():
            lines, boxes = np.concatenate([led[have], own[has]]), np.concatenate([a[have], b[has]])
            hit = inside(lines, boxes + np.array([-1, -1, 1, 1]) * _OFF_LEADERS) >= 0
            theirs_hit, both = np.count_nonzero(have), has & have
            found[have] += FORBIDDEN * hit[:theirs_hit]
            found[has] += FORBIDDEN * hit[theirs_hit:]
            pairs = np.flatnonzero(both)
            if len(pairs):
                found[pairs] += LEADERS_CROSS * crossing(own, led, pairs, pairs)
        costs[row, other] = found
        return costs
