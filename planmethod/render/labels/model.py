"""Labels, their candidate places, and the geometry of boxes and leader lines."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from math import tau
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from planmethod.render.ink.drawing import Bounds, Disc, Fill, Ink, Item, Pen, Stroke, Text
from planmethod.render.ink.typeset import Inscription, typeset
from planmethod.render.symbols import unit

Segment: TypeAlias = tuple[complex, complex]
"""Its ends, mm."""

CLEAR = 0.7  # white between a label and a line, mm
MIN_LEADER = 4.0  # a shorter leader line reads as a sign of the inscription, mm
VERTICAL_GAP = 0.9  # white between two labels one above the other, mm

DOT = 0.6  # radius of the dot from which a leader line crosses other lines (GOST 2.316), mm

UNDER_LABEL = "under a label"
"""Tag of the white under a label that breaks the thin lines behind it."""

LED = "leader of "
"""Prefix of the tag of a leader line, before the name of its label."""

BREAKABLE = frozenset({Pen.COMPONENT, Pen.THIN, Pen.LETTER, Pen.PALE, Pen.PHANTOM})
"""Pens of the lines that the white of a label may break."""


class LabelStyle(Struct, frozen=True):
    """Placement style of a label; all lengths mm.

    Attributes
    ----------
    rings, far_rings : tuple of float
        Distances beyond the gap to try first, and those to try when the first are occupied.
    angles, far_angles : int
        Places on each ring.
    leader_from : float
        Distance from its point or segment beyond which it gets a leader line (линия-выноска).
    leader : float
        Cost of a leader line, in mm of distance.
    turn_cost : float
        Cost of the direction opposite to the preferred one, in mm of distance.
    stranger : float
        Cost of a place nearer to another label's point than to its own, in mm of distance.
    other_segment : float
        The same for another segment, of a label that names a segment.
    side_gap : float
        White between it and another label side by side: closer they would read as one.
    thick_line_cost, thin_line_cost : float
        Cost of a thick and of a thin line between it and its point or segment, in mm of distance.
    segment_step : float
        Distance of its places along a segment; 0 for nine places.
    slanted : bool
        Its leader line is never horizontal: between letters it would read as a fraction bar.
    touching : bool
        Its leader line begins on its segment, where no other segment is.
    crossing_cost : float
        Cost of every other segment that its leader line may cross if it has no other place, in mm
        of distance; 0 for a label that is rather left out. A dot then marks its own segment.
    dotted : bool
        Its leader line crosses others, and begins with that dot.
    """

    rings: tuple[float, ...] = (0.0, 1.2, 3.0, 5.5, 9.0)
    angles: int = 16
    far_rings: tuple[float, ...] = (13.0, 18.0, 25.0, 34.0, 46.0)
    far_angles: int = 32
    leader_from: float = 8.0
    leader: float = 25.0
    turn_cost: float = 3.0
    stranger: float = 0.0
    other_segment: float = 0.0
    side_gap: float = 2.0
    thick_line_cost: float = 7.0
    thin_line_cost: float = 7.0
    segment_step: float = 0.0
    slanted: bool = False
    touching: bool = False
    crossing_cost: float = 0.0
    dotted: bool = False


SPARSE = LabelStyle()
"""A letter among few: eighty places around its point."""

BUSY = LabelStyle(
    rings=(0.0, 0.8, 1.8, 3.0, 4.5, 6.5, 9.0, 12.0, 16.0),
    angles=24,
    leader_from=5.0,
    leader=10.0,
    side_gap=3.2,
    thick_line_cost=20.0,
)
"""A letter among few, on a drawing with many lines."""

SERIES = LabelStyle(
    rings=(0.0, 0.5, 1.1, 2.0, 3.0, 4.5, 6.5, 9.0, 12.0, 15.5),
    angles=20,
    far_rings=(18.5, 22.0, 26.0, 31.0, 37.0, 44.0),
    leader_from=MIN_LEADER,
    leader=8.0,
    turn_cost=7.0,
    stranger=30.0,
    side_gap=3.2,
    thick_line_cost=12.0,
)
"""One of a series of labels: many places, a strict direction, an early leader line."""


NEAREST = LabelStyle(
    rings=(0.0, 1.2, 3.0, 6.0),
    far_rings=(9.5, 14.0, 19.0),
    far_angles=16,
    leader_from=MIN_LEADER,
    leader=12.0,
    stranger=60.0,
    thick_line_cost=25.0,
    slanted=True,
)
"""The letter of a point among other points: close to its own, an early leader line."""

_NEVER = 1e4

NAMING = LabelStyle(
    rings=(0.0,),
    far_rings=(4.5, 7.0, 9.0, 11.0, 14.0, 18.0, 24.0),
    far_angles=24,
    leader_from=MIN_LEADER,
    leader=10.0,
    other_segment=_NEVER,
    thick_line_cost=_NEVER,
    thin_line_cost=12.0,
    segment_step=3.0,
    slanted=True,
    touching=True,
    crossing_cost=20.0,
)
"""The name of a vector: at one distance beside it, or at the end of a leader line; no other vector
is between, nearer or at the end of the line, and no thin line if there is another place. In a
bundle the leader line crosses other vectors, from a dot on its own."""

NAMING_OF_MANY = replace(NAMING, far_rings=(), crossing_cost=0.0)
"""The same on one of many plans, without leader lines: the letters of its ends name it too."""


class Label(Struct, frozen=True):
    """Inscription to be placed near a point or along a segment (надпись).

    Attributes
    ----------
    inscription : Inscription
    anchor : complex, mm
        The point it names; the middle of a segment.
    segment : (complex, complex) or None, mm
        The segment it names: it is then placed beside it, near its middle.
    prefer : complex
        Preferred direction from the anchor; 0 for none. For a segment only its side matters.
    gap : float, mm
        White between the anchor point and the label: the radius of a joint and a little more.
    priority : int
        Labels of higher priority are placed earlier.
    name : str
        Name of the inscription for the lint. Default: made of markup and place.
    style : LabelStyle
        Its placement style.
    series : str
        Name of its series: labels of a series whose points are close together form a column.
    optional : bool
        It is left out if every place is occupied, and displaces no other label.
    """

    inscription: Inscription
    anchor: complex
    segment: tuple[complex, complex] | None = None
    prefer: complex = 0j
    gap: float = 1.5
    priority: int = 0
    name: str = ""
    style: LabelStyle = SPARSE
    series: str = ""
    optional: bool = False


class Placed(Struct, frozen=True):
    """Label with its place: ``at`` is the left end of its base line, mm.

    ``leader`` is the leader line or None; ``free`` means that the label crosses and overlaps no
    item; ``ground``, that white breaks the thin lines under the label, because it is not free;
    ``dotted``, that the leader line crosses other segments and begins with a dot.
    """

    label: Label
    at: complex
    leader: tuple[complex, complex] | None = None
    free: bool = True
    ground: bool = False
    dotted: bool = False

    @property
    def bounds(self) -> Bounds:
        """Ink box, mm."""
        return self.label.inscription.ink(self.at)

    def items(self) -> list[Item]:
        """Return the letters, the leader line and the white under the letters."""
        items = self.label.inscription.at(self.at, label=self.label.name)
        if self.label.segment is None:
            named = self.label.anchor
            items = [replace(i, names=named) if isinstance(i, Text) else i for i in items]
        if self.ground:
            x0, y0, x1, y1 = self.bounds
            low, high = (
                complex(x0, y0) - CLEAR / 2 * (1 + 1j),
                complex(x1, y1) + CLEAR / 2 * (1 + 1j),
            )
            corners = (low, complex(high.real, low.imag), high, complex(low.real, high.imag))
            items = [Fill(corners, Ink.WHITE, tag=UNDER_LABEL), *items]
        if self.leader is None:
            return items
        tag = LED + self.label.name
        dots = [Disc(self.leader[0], DOT, Ink.BLACK, tag=tag)] if self.dotted else []
        return [Stroke(self.leader, Pen.THIN, tag=tag), *dots, *items]


def segment_label(
    markup: str, start: complex, end: complex, height: float = 3.5, *, prefer: complex = 0j
) -> Label:
    """Return a label along a segment: the number of a link, the length of a vector."""
    return Label(typeset(markup, height), (start + end) / 2, (start, end), prefer, gap=1.2)


Floats: TypeAlias = NDArray[np.float64]
Complexes: TypeAlias = NDArray[np.complex128]

_SEGMENT_FRACTIONS = (0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74, 0.18, 0.82)
_LED_FROM = (
    0.5,
    0.42,
    0.58,
    0.35,
    0.65,
    0.27,
    0.73,
    0.2,
    0.8,
    0.86,
    0.92,
)  # parts of a vector from which leaders are tried
_FROM_END = 4.5  # distance of a leader line from the ends of a vector, mm
_ON_SEGMENT = 0.1  # distance of a leader line from the middle of the line that it touches, mm
_AT_HEAD = 50.0  # cost of a leader line from the head of a vector, mm of distance
_TICK = 1.0  # length of a steep leader line beside its letters that reads as their sign, mm
_TICK_COST = 40.0  # cost of such a line, mm of distance
_SEGMENT_DISTANCES = (0.0, 0.8, 2.0, 4.0)  # beyond the gap, mm
_OTHER_SIDE_COST = 3.0  # cost of the side of its segment that is not preferred, mm of distance
_MIN_LEADER_RISE = 0.6  # a leader line that rises no more reads as the bar of a fraction, mm


class Candidates(Struct, frozen=True, dict=True):
    """Places of one label.

    Attributes
    ----------
    label : Label
    boxes : ndarray of shape (n, 4), mm
        Ink boxes.
    dislike : ndarray of shape (n,), mm
        Cost of the place itself.
    starts, ends : ndarray of shape (n,), mm
        Ends of the leader lines: at the named point or segment, and at the edge of the box.
    """

    label: Label
    boxes: Floats
    dislike: Floats
    starts: Complexes
    ends: Complexes

    def chosen(self, rows: NDArray[np.intp]) -> Candidates:
        """Return some of the places."""
        return Candidates(
            self.label, self.boxes[rows], self.dislike[rows], self.starts[rows], self.ends[rows]
        )

    @classmethod
    def joined(cls, parts: Sequence[Candidates]) -> Candidates:
        """Return several places of the same label as one."""
        lists = zip(*((c.boxes, c.dislike, c.starts, c.ends) for c in parts), strict=True)
        return cls(parts[0].label, *map(np.concatenate, lists))

    @cached_property
    def led(self) -> NDArray[np.bool_]:
        """Flags of the places that are far enough to need a leader line."""
        return np.abs(self.ends - self.starts) > self.label.style.leader_from

    @cached_property
    def leaders(self) -> Floats:
        """Leader lines as segments, shape (n, 2, 2), NaN where there is none."""
        segments = as_segments(self.starts, self.ends)
        segments[~self.led] = np.nan
        return segments

    @cached_property
    def corners(self) -> tuple[Floats, Floats]:
        """Lower left and upper right corner of the box around all places, mm."""
        around = self.around
        return around[:, :2].min(axis=0), around[:, 2:].max(axis=0)

    @cached_property
    def around(self) -> Floats:
        """Boxes around the places and their leader lines, shape (n, 4), mm."""
        around = self.boxes.copy()
        rows = np.flatnonzero(self.led)
        if len(rows):
            one, two = self.leaders[rows, 0], self.leaders[rows, 1]
            around[rows, :2] = np.minimum(around[rows, :2], np.minimum(one, two))
            around[rows, 2:] = np.maximum(around[rows, 2:], np.maximum(one, two))
        return around


def near_candidates(label: Label) -> Candidates:
    """Return the places beside the segment, or on rings about the point."""
    if label.segment is not None:
        return _segment_candidates(label, *label.segment)
    return _ring_candidates(label, label.style.rings, label.style.angles)


def far_candidates(label: Label) -> Candidates:
    """Return places further away, with a leader line: the name of a vector has it at any part."""
    rings, angles = label.style.far_rings, label.style.far_angles
    if label.segment is None or not label.style.segment_step or not rings:
        return _ring_candidates(label, rings, angles)
    start, way = label.segment[0], label.segment[1] - label.segment[0]
    round_it, dislike = _ring_places(label, rings, angles)
    points = (start + way * np.asarray(_LED_FROM))[:, None] + np.zeros(len(round_it))
    boxes = _boxes_at(label, (points + round_it).ravel())
    dislike = np.tile(dislike, len(_LED_FROM))
    leaders = [_leader_ends(label, boxes, at) for at in (_nearest(label, boxes), points.ravel())]
    starts, ends = (np.column_stack(two).ravel() for two in zip(*leaders, strict=True))
    # Not from its tail, where several vectors meet; from its head, which has the letter of a point,
    # as the last resort.
    dislike = dislike.repeat(2) + np.where(starts_at_end(label, starts, 1), _AT_HEAD, 0.0)
    every = _with_ticks(label, boxes.repeat(2, axis=0), dislike, starts, ends)
    return every.chosen(np.flatnonzero(~starts_at_end(label, starts, 0)))


def led_across(places: Candidates) -> Candidates:
    """Return far places of a name in a bundle whose leader lines may cross other segments."""
    label, style = places.label, places.label.style
    style = replace(style, thick_line_cost=style.crossing_cost, dotted=True)
    return replace(places, label=replace(label, style=style))


def starts_at_end(label: Label, starts: Complexes, end: int) -> NDArray[np.bool_]:
    """Return which leader lines begin at the tail (0) or the head (1) of a label's segment."""
    assert label.segment is not None
    tail, head = label.segment
    return np.abs(starts - label.segment[end]) < min(_FROM_END, 0.25 * abs(head - tail))


def grid_candidates(label: Label, bounds: Bounds) -> Candidates:
    """Return places all over the bounds: the last resort of a crowded drawing."""
    x0, y0, x1, y1 = bounds
    ink = label.inscription
    tall = ink.ascent + ink.descent
    xs = np.arange(x0 + ink.width / 2, x1 - ink.width / 2 + 1e-9, max(2.0, ink.width / 2))
    ys = np.arange(y0 + tall / 2, y1 - tall / 2 + 1e-9, max(2.0, tall / 2))
    if not len(xs) or not len(ys):
        return near_candidates(label)
    centres = (xs[None, :] + 1j * ys[:, None]).ravel()
    return _build_candidates(label, centres, np.abs(centres - label.anchor))


def _build_candidates(label: Label, centres: Complexes, dislike: Floats) -> Candidates:
    boxes = _boxes_at(label, centres)
    starts, ends = _leader_ends(label, boxes, _nearest(label, boxes))
    return _with_ticks(label, boxes, dislike, starts, ends)


def _with_ticks(
    label: Label, boxes: Floats, dislike: Floats, starts: Complexes, ends: Complexes
) -> Candidates:
    """Return places, those disliked whose steep leader line beside the letters reads as a sign."""
    low, high = np.minimum(starts.imag, ends.imag), np.maximum(starts.imag, ends.imag)
    level = np.minimum(high, boxes[:, 3]) - np.maximum(low, boxes[:, 1])
    across, up = np.abs((ends - starts).real), high - low
    places = Candidates(label, boxes, dislike, starts, ends)
    ticks = places.led & (level > _TICK) & (across < up)
    return Candidates(label, boxes, dislike + np.where(ticks, _TICK_COST, 0.0), starts, ends)


def _boxes_at(label: Label, centres: Complexes) -> Floats:
    half_w = label.inscription.width / 2
    half_h = (label.inscription.ascent + label.inscription.descent) / 2
    x, y = centres.real, centres.imag
    return np.column_stack([x - half_w, y - half_h, x + half_w, y + half_h])


def _ring_candidates(label: Label, rings: Sequence[float], angles: int) -> Candidates:
    """Return places about a point: the box touches the ring with its inner side or corner."""
    centres, dislike = _ring_places(label, rings, angles)
    return _build_candidates(label, label.anchor + centres, dislike)


def _ring_places(label: Label, rings: Sequence[float], angles: int) -> tuple[Complexes, Floats]:
    """Return the centres of the boxes of places about the origin, and their dislike."""
    half_w = label.inscription.width / 2
    half_h = (label.inscription.ascent + label.inscription.descent) / 2
    start = np.angle(label.prefer) if label.prefer else tau / 8
    turns = np.exp(1j * (start + tau * np.arange(angles) / angles))
    # A box beside the point is centred on the ring's direction; one in an oblique direction touches
    # it with a corner: the clipped cosine and sine blend the two.
    support = half_w * np.clip(1.5 * turns.real, -1, 1) + 1j * half_h * np.clip(
        1.5 * turns.imag, -1, 1
    )
    radii = label.gap + np.asarray(rings)
    centres = (radii[:, None] * turns + support).ravel()
    away = (1 - np.cos(tau * np.arange(angles) / angles)) / 2 if label.prefer else np.zeros(angles)
    dislike = (np.asarray(rings)[:, None] + label.style.turn_cost * away).ravel()
    return centres, dislike


def _segment_candidates(label: Label, start: complex, end: complex) -> Candidates:
    """Return places beside a segment, near its middle, on both sides."""
    half_w = label.inscription.width / 2
    half_h = (label.inscription.ascent + label.inscription.descent) / 2
    normal = unit(end - start) * 1j
    first = -1.0 if (label.prefer * normal.conjugate()).real < 0 else 1.0
    centres: list[complex] = []
    dislike: list[float] = []
    reach = abs(normal.real) * half_w + abs(normal.imag) * half_h
    alone = label.style == SPARSE
    parts = _segment_fractions(abs(end - start), label.style.segment_step)
    for beyond in _SEGMENT_DISTANCES if alone else label.style.rings:
        for side in (first, -first):
            for part in parts:
                away = normal * side * (label.gap + beyond + reach)
                centres.append(start + (end - start) * part + away)
                slid = min(abs(end - start), 40.0) * abs(part - 0.5) * 0.3
                turned = _OTHER_SIDE_COST if side != first and label.prefer else 0.0
                dislike.append(beyond * (2 if alone else 1) + slid + turned)
    return _build_candidates(label, np.asarray(centres), np.asarray(dislike))


def _segment_fractions(length: float, step: float) -> tuple[float, ...]:
    """Return the parts of a segment beside which a label may be, from the middle outwards."""
    if not step:
        return _SEGMENT_FRACTIONS
    most = _SEGMENT_FRACTIONS[-1] - 0.5
    count = max(4, int(most * length / step))
    return (0.5, *(0.5 + sign * most * k / count for k in range(1, count + 1) for sign in (-1, 1)))


def _nearest(label: Label, boxes: Floats) -> Complexes:
    """Return what each box names: the point, or the part of the segment that is nearest."""
    if label.segment is None:
        return np.full(len(boxes), label.anchor)
    start, way = label.segment[0], label.segment[1] - label.segment[0]
    middles = (boxes[:, 0] + boxes[:, 2] + 1j * (boxes[:, 1] + boxes[:, 3])) / 2
    part = ((middles - start) * np.conj(way)).real / max(abs(way) ** 2, 1e-12)
    return np.asarray(start + way * np.clip(part, 0.0, 1.0))


def _leader_ends(label: Label, boxes: Floats, anchor: Complexes) -> tuple[Complexes, Complexes]:
    """Return the ends of leader lines: near the named point, and at the edge of each box."""
    up = np.clip(anchor.imag, boxes[:, 1], boxes[:, 3])
    across = np.clip(anchor.real, boxes[:, 0], boxes[:, 2])
    if label.style.slanted:  # to the further edge of a distant box that lies level with its point
        far = np.where(2 * up > boxes[:, 1] + boxes[:, 3], boxes[:, 1], boxes[:, 3])
        level = np.abs(up - anchor.imag) <= _MIN_LEADER_RISE
        level &= np.abs(across - anchor.real) > label.style.leader_from
        up = np.where(level, far, up)
    ends = across + 1j * up
    reach = ends - anchor
    length = np.abs(reach)
    along = np.divide(reach, length, out=np.zeros_like(reach), where=length > 0)
    off = _ON_SEGMENT if label.style.touching else 0.6 * label.gap
    starts = anchor + along * np.minimum(length, off)
    return starts, ends - along * np.minimum(length, 0.6 * CLEAR)


def as_segments(starts: Complexes, ends: Complexes) -> Floats:
    """Return an array of shape (n, 2, 2) of the segments' ends."""
    segments = np.empty((len(starts), 2, 2))
    segments[:, 0, 0], segments[:, 0, 1] = starts.real, starts.imag
    segments[:, 1, 0], segments[:, 1, 1] = ends.real, ends.imag
    return segments


def inside(segments: Floats, boxes: Floats) -> Floats:
    """Return the length of each segment inside its box, mm; -1 where they do not meet.

    Clipping after Liang and Barsky, for arrays of segments (..., 2, 2) and boxes (..., 4) that
    broadcast together. A segment of NaN meets nothing.
    """
    first, last = np.asarray(0.0), np.asarray(1.0)
    ways = []
    with np.errstate(divide="ignore", invalid="ignore"):
        for axis in (0, 1):  # one after the other: rows of two numbers are slow
            start, low, high = segments[..., 0, axis], boxes[..., axis], boxes[..., axis + 2]
            way = segments[..., 1, axis] - start
            one, two = (low - start) / way, (high - start) / way
            enter, leave = np.minimum(one, two), np.maximum(one, two)
            still = way == 0
            if still.any():
                between = (start >= low) & (start <= high)
                enter = np.where(still, np.where(between, -np.inf, np.inf), enter)
                leave = np.where(still, np.where(between, np.inf, -np.inf), leave)
            first, last = np.maximum(first, enter), np.minimum(last, leave)
            ways.append(way)
        length = np.hypot(*ways)
        return np.where(last >= first, np.maximum(last - first, 0.0) * length, -1.0)


def crossing(
    one: Floats, two: Floats, i: NDArray[np.intp], j: NDArray[np.intp]
) -> NDArray[np.bool_]:
    """Return whether each pair of segments ``one[i]``, ``two[j]`` crosses; NaN never does.

    The segments have the shape (n, 2, 2); a few segments may form many pairs.
    """
    (ax, ay, bx, by), (cx, cy, dx, dy) = (line.reshape(-1, 4).T.copy() for line in (one, two))
    x, y, along, up = (part.take(i) for part in (ax, ay, bx - ax, by - ay))

    def side(qx: Floats, qy: Floats, k: NDArray[np.intp]) -> Floats:
        return np.asarray(along * (qy.take(k) - y) - up * (qx.take(k) - x))

    apart = np.asarray(side(cx, cy, j) * side(dx, dy, j) < 0)
    i, j = i[apart], j[apart]  # few remain
    x, y, along, up = (part.take(j) for part in (cx, cy, dx - cx, dy - cy))
    apart[apart] = side(ax, ay, i) * side(bx, by, i) < 0
    return apart


def crossed(leaders: Sequence[Floats]) -> int:
    """Return how many pairs of leader lines, each of shape (2, 2), cross."""
    if not leaders:
        return 0
    lines = np.asarray(leaders)
    return int(crossing(lines, lines, *np.triu_indices(len(lines), 1)).sum())


# How tidy placed labels are -----------------------------------------------------------------------

# How many leader lines that cross are as bad as
_BROKEN = 2  # a label that breaks thin lines
_OVER = 100  # a label over something


def crossed_leaders(placed: Sequence[Placed]) -> int:
    """Return how many pairs of leader lines cross."""
    leaders = [label.leader for label in placed if label.leader is not None]
    return crossed([np.asarray([(z.real, z.imag) for z in leader]) for leader in leaders])


def untidiness(placed: Sequence[Placed]) -> int:
    """Return a cost to be minimized: crossed leader lines, and labels that are not free."""
    unfree = sum(0 if label.free else _BROKEN if label.ground else _OVER for label in placed)
    return unfree + crossed_leaders(placed)
