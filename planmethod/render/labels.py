"""Placing of labels (размещение надписей): nothing overlaps, nothing lies on a line.

Every label has about eighty candidate places: on rings about its point, or along its segment on
both sides. Labels are placed one after another, the hard ones first, each at its cheapest place.
Another label or a box is never overlapped; a line is crossed only where there is no free place at
all. The same input gives the same places.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import tau
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from shapely import STRtree, box, linestrings, points, polygons

from planmethod.render.drawing import Arc, Bounds, Disc, Fill, Item, Pen, Stroke, Text
from planmethod.render.symbols import arc_points, unit
from planmethod.render.typeset import Inscription, text_corners, typeset

Floats: TypeAlias = NDArray[np.float64]
Complexes: TypeAlias = NDArray[np.complex128]

LEADER_FROM = 8.0
"""A label further than this from its point gets a leader line (линия-выноска), mm."""

_CLEAR = 0.7  # white between a label and a line, mm
_APART = 0.9  # white between two labels one above the other, mm
_BESIDES = 2.0  # white between two labels side by side: nearer they would read as one
_RINGS = (0.0, 1.2, 3.0, 5.5, 9.0)  # beyond the gap, mm
_ANGLES = 16
_FAR_RINGS = (13.0, 18.0, 25.0, 34.0, 46.0, 62.0, 84.0, 112.0, 150.0)
_FAR_ANGLES = 32
_ALONG = (0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74, 0.18, 0.82)
_BESIDE = (0.0, 0.8, 2.0, 4.0)  # beyond the gap, mm

_FORBIDDEN = 1e6
_CROSSING = 400.0  # a label on a line, and its share per mm of line under it
_PER_MM = 20.0
_LEADER = 25.0  # having a leader line at all
_BETWEEN = 7.0  # per line between a label and what it names
_THROUGH = 60.0  # per filled area, an arrowhead mostly, that the leader runs through
_TURNED = 3.0  # looking quite away from the preferred direction, mm of distance


@dataclass(frozen=True, slots=True)
class Label:
    """Inscription that wants a place near a point or along a segment (надпись).

    Attributes
    ----------
    inscription : Inscription
    anchor : complex, mm
        The point it names; the middle of a segment.
    along : (complex, complex) or None, mm
        The segment it names: it is then placed beside it, near its middle.
    prefer : complex
        Direction from the anchor in which it would like to be; 0 when it does not care. For a
        segment only the side that this points to matters.
    gap : float, mm
        White between the anchor point and the label: the radius of a joint and a little more.
    priority : int
        Greater is placed earlier.
    name : str
        Name of the inscription for the lint; made of markup and place when empty.
    """

    inscription: Inscription
    anchor: complex
    along: tuple[complex, complex] | None = None
    prefer: complex = 0j
    gap: float = 1.5
    priority: int = 0
    name: str = ""


@dataclass(frozen=True, slots=True)
class Placed:
    """Label with its place: ``at`` is the left end of its base line, mm.

    ``leader`` is the leader line or None; ``free`` tells that nothing is crossed or overlapped.
    """

    label: Label
    at: complex
    leader: tuple[complex, complex] | None = None
    free: bool = True

    @property
    def bounds(self) -> Bounds:
        """Ink box, mm."""
        return self.label.inscription.ink(self.at)

    def items(self) -> list[Item]:
        """Return the letters and the leader line."""
        items = self.label.inscription.at(self.at, label=self.label.name)
        return items if self.leader is None else [Stroke(self.leader, Pen.THIN), *items]


def segment_label(
    markup: str,
    start: complex,
    end: complex,
    height: float = 3.5,
    *,
    prefer: complex = 0j,
    gap: float = 1.2,
    priority: int = 0,
) -> Label:
    """Return a label along a segment: the number of a link, the length of a vector."""
    inscription = typeset(markup, height)
    middle = (start + end) / 2
    return Label(inscription, middle, (start, end), prefer, gap, priority)


def place_labels(
    labels: Sequence[Label],
    obstacles: Iterable[Item],
    bounds: Bounds,
    *,
    leader_from: float = LEADER_FROM,
) -> list[Placed]:
    """Find a place for every label (размещение надписей).

    Parameters
    ----------
    labels : sequence of Label
    obstacles : iterable of Item
        What is on the sheet already. Lines, arcs and outlines should not be crossed, texts and
        filled areas (the white ones too: a joint, a slider) must not be. White hides nothing
        here: draw order is not looked at.
    bounds : Bounds, mm
        All labels stay inside.
    leader_from : float, mm
        Distance from which a label gets a leader line.

    Returns
    -------
    list of Placed
        In the order of ``labels``. Where there is no room at all a label overlaps or leaves the
        bounds, and is not ``free``.
    """
    if not labels:
        return []
    field_ = _Field(obstacles, bounds, leader_from)
    near = [_near(label) for label in labels]
    costs = field_.static_costs(near)
    order = sorted(
        range(len(labels)),
        # Labels with few free places go first, or the others would take these places.
        key=lambda k: (-labels[k].priority, int(np.sum(costs[k] < _CROSSING)), k),
    )
    placed: dict[int, Placed] = {k: field_.choose(near[k], costs[k]) for k in order}
    return [placed[k] for k in range(len(labels))]


@dataclass(frozen=True, slots=True)
class _Candidates:
    """Places of one label: ink boxes (n, 4), cost of the place itself (n,), mm."""

    label: Label
    boxes: Floats
    dislike: Floats


def _boxes(centres: Complexes, label: Label) -> Floats:
    half_w = label.inscription.width / 2
    half_h = (label.inscription.ascent + label.inscription.descent) / 2
    x, y = centres.real, centres.imag
    return np.column_stack([x - half_w, y - half_h, x + half_w, y + half_h])


def _rings(label: Label, rings: Sequence[float], angles: int) -> _Candidates:
    """Places about a point: the box touches the ring with the side or corner that looks inwards."""
    half_w = label.inscription.width / 2
    half_h = (label.inscription.ascent + label.inscription.descent) / 2
    start = np.angle(label.prefer) if label.prefer else tau / 8
    turns = np.exp(1j * (start + tau * np.arange(angles) / angles))
    # A box beside the point is centred on the ring's direction; one at a slant stands by its
    # corner: the clipped cosine and sine pass from one to the other.
    support = half_w * np.clip(1.5 * turns.real, -1, 1) + 1j * half_h * np.clip(
        1.5 * turns.imag, -1, 1
    )
    radii = label.gap + np.asarray(rings)
    centres = (label.anchor + radii[:, None] * turns + support).ravel()
    away = (1 - np.cos(tau * np.arange(angles) / angles)) / 2 if label.prefer else np.zeros(angles)
    dislike = (np.asarray(rings)[:, None] + _TURNED * away).ravel()
    return _Candidates(label, _boxes(centres, label), dislike)


def _beside(label: Label, start: complex, end: complex) -> _Candidates:
    """Places beside a segment, near its middle, on both sides."""
    half_w = label.inscription.width / 2
    half_h = (label.inscription.ascent + label.inscription.descent) / 2
    normal = unit(end - start) * 1j
    first = -1.0 if (label.prefer * normal.conjugate()).real < 0 else 1.0
    centres: list[complex] = []
    dislike: list[float] = []
    reach = abs(normal.real) * half_w + abs(normal.imag) * half_h
    for beyond in _BESIDE:
        for side in (first, -first):
            for part in _ALONG:
                away = normal * side * (label.gap + beyond + reach)
                centres.append(start + (end - start) * part + away)
                slid = min(abs(end - start), 40.0) * abs(part - 0.5) * 0.3
                turned = _TURNED if side != first and label.prefer else 0.0
                dislike.append(beyond * 2 + slid + turned)
    return _Candidates(label, _boxes(np.asarray(centres), label), np.asarray(dislike))


def _near(label: Label) -> _Candidates:
    if label.along is not None:
        return _beside(label, *label.along)
    return _rings(label, _RINGS, _ANGLES)


@dataclass
class _Field:
    """What is on the paper: obstacles that stay and labels placed so far."""

    obstacles: Iterable[Item]
    bounds: Bounds
    leader_from: float
    placed: list[Bounds] = field(default_factory=list)
    leaders: list[tuple[complex, complex]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.segments, areas = _obstacles(self.obstacles)
        self.lines = STRtree(linestrings(self.segments)) if len(self.segments) else None
        self.areas = STRtree(areas) if areas else None

    def static_costs(self, many: Sequence[_Candidates]) -> list[Floats]:
        """Return the costs of all candidates but for the other labels, one array per label."""
        boxes = np.concatenate([c.boxes for c in many])
        costs = np.concatenate([c.dislike for c in many]) + self._line_costs(boxes)
        x0, y0, x1, y1 = self.bounds
        inside = (
            (boxes[:, 0] >= x0) & (boxes[:, 1] >= y0) & (boxes[:, 2] <= x1) & (boxes[:, 3] <= y1)
        )
        costs += np.where(inside, 0.0, _FORBIDDEN)
        costs += self._area_costs(boxes)
        cuts = np.cumsum([len(c.boxes) for c in many])[:-1]
        split = np.split(costs, cuts)
        return [cost + self._leader_costs(c, cost) for c, cost in zip(many, split, strict=True)]

    def _line_costs(self, boxes: Floats) -> Floats:
        """Return the cost of the lines that run through the boxes grown by the white about them."""
        costs = np.zeros(len(boxes))
        if self.lines is None:
            return costs
        grown = boxes + np.array([-_CLEAR, -_CLEAR, _CLEAR, _CLEAR])
        which, line = self.lines.query(box(*grown.T))
        lengths = _inside(self.segments[line], grown[which])
        crossing = np.where(lengths >= 0, _CROSSING + _PER_MM * np.maximum(lengths, 0), 0.0)
        np.add.at(costs, which, crossing)
        return costs

    def _area_costs(self, boxes: Floats) -> Floats:
        costs = np.zeros(len(boxes))
        if self.areas is not None:
            grown = boxes + np.array([-_APART, -_APART, _APART, _APART]) * 0.6
            which, _ = self.areas.query(box(*grown.T), predicate="intersects")
            costs[which] += _FORBIDDEN
        return costs

    def _leader_costs(self, candidates: _Candidates, so_far: Floats) -> Floats:
        """Return the cost of what is between the candidates and the thing they name.

        A line between them makes a reader take the label for another's, leader line or not.
        """
        costs = np.zeros(len(so_far))
        starts, ends = _leader_ends(candidates)
        long = np.abs(ends - starts) > self.leader_from
        costs[long] += _LEADER
        ask = np.flatnonzero(so_far < _CROSSING)
        if self.lines is not None and len(ask):
            paths = linestrings(_as_segments(starts[ask], ends[ask]))
            which, _ = self.lines.query(paths, predicate="intersects")
            np.add.at(costs, ask[which], _BETWEEN)
        ask = np.flatnonzero(long & (so_far < _FORBIDDEN))
        if len(ask):
            lines = _as_segments(starts[ask], ends[ask])
            if self.areas is not None:
                which, area = self.areas.query(linestrings(lines), predicate="intersects")
                # A leader may start inside what it names: a joint, a slider.
                anchor = candidates.label.anchor
                named = self.areas.query(points(anchor.real, anchor.imag), predicate="intersects")
                np.add.at(costs, ask[which[~np.isin(area, named)]], _THROUGH)
        return costs

    def choose(self, candidates: _Candidates, static: Floats) -> Placed:
        """Place one label at its cheapest candidate; look further away when all are taken."""
        best, cost = self._cheapest(candidates, static)
        if cost >= _CROSSING:
            for places in (self._far, self._everywhere):
                further = places(candidates.label)
                found, its_cost = self._cheapest(further, self.static_costs([further])[0])
                if its_cost < cost:
                    candidates, best, cost = further, found, its_cost
                if cost < _CROSSING:
                    break
        bounds = candidates.boxes[best]
        self.placed.append((bounds[0], bounds[1], bounds[2], bounds[3]))
        label = candidates.label
        at = complex(bounds[0], bounds[1] + label.inscription.descent)
        leader = None
        starts, ends = _leader_ends(candidates)
        if abs(ends[best] - starts[best]) > self.leader_from:
            leader = (complex(starts[best]), complex(ends[best]))
            self.leaders.append(leader)
        return Placed(label, at, leader, bool(cost < _CROSSING))

    def _cheapest(self, candidates: _Candidates, static: Floats) -> tuple[int, float]:
        costs = static + self._label_costs(candidates)
        best = int(np.argmin(np.round(costs, 9)))
        return best, float(costs[best])

    def _label_costs(self, candidates: _Candidates) -> Floats:
        """Return the cost of overlapping labels and leaders that are placed already."""
        boxes = candidates.boxes
        costs = np.zeros(len(boxes))
        if not self.placed:
            return costs
        others = np.asarray(self.placed)
        a, b = boxes[:, None, :], others[None, :, :]
        wide = np.minimum(a[..., 2], b[..., 2]) - np.maximum(a[..., 0], b[..., 0]) + _BESIDES
        tall = np.minimum(a[..., 3], b[..., 3]) - np.maximum(a[..., 1], b[..., 1]) + _APART
        over = (wide > 0) & (tall > 0)
        costs += np.where(over, _FORBIDDEN + wide * tall, 0.0).sum(axis=1)
        grown = boxes + np.array([-_CLEAR, -_CLEAR, _CLEAR, _CLEAR])
        for leader in self.leaders:
            segment = np.broadcast_to(_as_segments(*map(np.atleast_1d, leader)), (len(boxes), 2, 2))
            costs += np.where(_inside(segment, grown) >= 0, _FORBIDDEN, 0.0)
        starts, ends = _leader_ends(candidates)
        long = np.flatnonzero(np.abs(ends - starts) > self.leader_from)
        if len(long):
            segments = _as_segments(starts[long], ends[long])
            spaced = others + np.array([-_CLEAR, -_CLEAR, _CLEAR, _CLEAR]) / 2
            met = _inside(np.repeat(segments, len(spaced), axis=0), np.tile(spaced, (len(long), 1)))
            through = np.any(met.reshape(len(long), len(spaced)) >= 0, axis=1)
            # A leader through a label is bad, a label on a label worse.
            costs[long] += _FORBIDDEN / 2 * through
        return costs

    def _far(self, label: Label) -> _Candidates:
        """Places further away, with a leader line."""
        return _rings(label, _FAR_RINGS, _FAR_ANGLES)

    def _everywhere(self, label: Label) -> _Candidates:
        """Places all over the bounds: the last resort of a crowded drawing."""
        x0, y0, x1, y1 = self.bounds
        ink = label.inscription
        tall = ink.ascent + ink.descent
        xs = np.arange(x0 + ink.width / 2, x1 - ink.width / 2 + 1e-9, max(2.0, ink.width / 2))
        ys = np.arange(y0 + tall / 2, y1 - tall / 2 + 1e-9, max(2.0, tall / 2))
        if not len(xs) or not len(ys):
            return _rings(label, _RINGS, _ANGLES)
        centres = (xs[None, :] + 1j * ys[:, None]).ravel()
        return _Candidates(label, _boxes(centres, label), np.abs(centres - label.anchor))


def _leader_ends(candidates: _Candidates) -> tuple[Complexes, Complexes]:
    """Return the ends of leader lines: near the point or segment, and at the edge of each box."""
    label, boxes = candidates.label, candidates.boxes
    anchor = np.full(len(boxes), label.anchor)
    if label.along is not None:
        start, way = label.along[0], label.along[1] - label.along[0]
        middles = (boxes[:, 0] + boxes[:, 2] + 1j * (boxes[:, 1] + boxes[:, 3])) / 2
        part = ((middles - start) * np.conj(way)).real / max(abs(way) ** 2, 1e-12)
        anchor = start + way * np.clip(part, 0.0, 1.0)
    ends = np.clip(anchor.real, boxes[:, 0], boxes[:, 2]) + 1j * np.clip(
        anchor.imag, boxes[:, 1], boxes[:, 3]
    )
    reach = ends - anchor
    length = np.abs(reach)
    along = np.divide(reach, length, out=np.zeros_like(reach), where=length > 0)
    starts = anchor + along * np.minimum(length, 0.6 * label.gap)
    return starts, ends - along * np.minimum(length, 0.6 * _CLEAR)


def _as_segments(starts: Complexes, ends: Complexes) -> Floats:
    """Return an array of shape (n, 2, 2) of the segments' ends."""
    pairs = np.stack([starts, ends], axis=1)
    return np.stack([pairs.real, pairs.imag], axis=2)


def _inside(segments: Floats, boxes: Floats) -> Floats:
    """Return the length of each segment inside its box, mm; -1 where they do not meet.

    Clipping after Liang and Barsky, for arrays of n segments (n, 2, 2) and n boxes (n, 4).
    """
    start = segments[:, 0]
    way = segments[:, 1] - start
    low, high = boxes[:, :2], boxes[:, 2:]
    with np.errstate(divide="ignore", invalid="ignore"):
        one, two = (low - start) / way, (high - start) / way
    still = way == 0
    between = (start >= low) & (start <= high)
    enter = np.where(still, np.where(between, -np.inf, np.inf), np.minimum(one, two))
    leave = np.where(still, np.where(between, np.inf, -np.inf), np.maximum(one, two))
    first = np.maximum(enter.max(axis=1), 0.0)
    last = np.minimum(leave.min(axis=1), 1.0)
    length = np.hypot(way[:, 0], way[:, 1])
    return np.where(last >= first, np.maximum(last - first, 0.0) * length, -1.0)


def _obstacles(items: Iterable[Item]) -> tuple[Floats, list[object]]:
    """Split items into segments (n, 2, 2) that should and areas that must not be covered."""
    lines: list[tuple[complex, complex]] = []
    areas: list[object] = []
    for item in items:
        match item:
            case Stroke(points=path, closed=closed):
                lines += pairwise((*path, path[0]) if closed and path else path)
            case Arc():
                lines += pairwise(arc_points(item))
            case Fill(points=path) if len(path) > 2:
                areas.append(polygons([(p.real, p.imag) for p in path]))
            case Disc(centre=centre, radius=radius):
                areas.append(points(centre.real, centre.imag).buffer(radius, quad_segs=4))
            case Text():
                areas.append(polygons([(p.real, p.imag) for p in text_corners(item)]))
            case Fill():
                pass  # no area
    if not lines:
        return np.empty((0, 2, 2)), areas
    ends = np.asarray(lines)
    return _as_segments(ends[:, 0], ends[:, 1]), areas
