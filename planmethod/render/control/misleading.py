"""Inscriptions and arrows that mislead (обозначения, вводящие в заблуждение).

``PM-D14``  a letter is far from its point or arrow, or nearer to another one than to its own
``PM-D15``  an arrow of a turn touches another one or runs through a slider
``PM-D16``  two inscriptions read as one: side by side as a word, over a short line as a fraction
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations, product
from math import inf

import numpy as np
from shapely import LineString, Polygon
from shapely.geometry.base import BaseGeometry

from planmethod.plans.model import PlanKind, VectorKind
from planmethod.render.control.remarks import Finding
from planmethod.render.control.texts import Writing, called
from planmethod.render.ink.drawing import Arc, Bounds, Item, Pen, Stroke, View
from planmethod.render.ink.extent import arc_points
from planmethod.render.ink.typeset import PART_OF
from planmethod.render.labels.model import LED
from planmethod.render.labels.paper import distances
from planmethod.render.symbols import FORCE, PLAN_FORCE, SLIDER

LEADER = 40.0
"""Longest leader line of a letter, mm: the eye does not follow it further."""

AMONG, AT_OTHER = 24.0, 4.0
"""Longest leader line of a letter that is placed at another point, and the distance from that
point, mm: it is read as that point's."""

NEARER = 0.5
"""Difference of distances from which a letter without a leader line is taken for the nearer
point's, mm."""

MIN_ARROW_SPACING = 1.0
"""Least white between two arrows of turns, mm."""

MIN_WORD_SPACING = 1.0
"""Least white between two inscriptions on one level, mm: a word gap of letters of 2.5 mm."""

_BAR = 25.0  # mm: a longer line is not the bar of a fraction
_OVER = 3.5  # mm: a letter further from a line than this is not on it
_TOUCH = 0.05  # mm: smaller differences do not count as nearer

_VECTORS = {*(kind.value for kind in VectorKind), "similar"}
"""Tags of vectors and of the sides of similar figures, which the letters at their ends name."""

_POINTS = ("point ", *(f"{kind.value} " for kind in PlanKind))
_FORCES = (f"{FORCE} ", f"{PLAN_FORCE} ")
_SAME = 1.0  # mm: points nearer to each other look like one

Arrows = dict[str, BaseGeometry]
"""Arcs of the arrows of ω and ε by their tags."""


def misleading(
    items: Sequence[Item], writings: Sequence[Writing], views: Sequence[View]
) -> Iterator[Finding]:
    """Find letters and arrows that may be misread.

    ``writings`` are the inscriptions of the items; only those of views read as a word or fraction,
    for equations and calculations are set as such.
    """
    arrows: Arrows = {}
    for item in items:
        if isinstance(item, Arc) and item.tag[:2] in ("ω ", "ε "):
            arc = LineString([(p.real, p.imag) for p in arc_points(item, step=0.1)])
            arrows[item.tag] = arrows[item.tag].union(arc) if item.tag in arrows else arc
    yield from _long_leaders(items, writings)
    yield from _find_letters_at_other_points(items, writings, views)
    yield from _find_letters_near_other_arrows(writings, arrows)
    yield from _find_letters_at_other_forces(items, writings, views)
    yield from _run_into(items, arrows)
    inside = [one for one in writings if any(box_contains(view.box, one.place) for view in views)]
    yield from _words(inside)
    yield from _fractions(items, inside)


def box_contains(box: Bounds, place: complex) -> bool:
    """Return whether a place is in a box."""
    return box[0] <= place.real <= box[2] and box[1] <= place.imag <= box[3]


def _long_leaders(items: Sequence[Item], writings: Sequence[Writing]) -> Iterator[Finding]:
    shown = {writing.name: writing.shown for writing in writings}
    for item in items:
        if isinstance(item, Stroke) and item.tag.startswith(LED):
            far = abs(item.points[-1] - item.points[0])
            if far > LEADER:
                name = item.tag[len(LED) :]
                facts = {"name": shown.get(name, name)}
                yield Finding("PM-D14", item.points[-1], far, LEADER, facts)


def is_of_point(name: str) -> bool:
    """Return whether an inscription, by its name, labels a point of a scheme or plan."""
    return name.startswith(_POINTS)


def measure_letter_distances(
    writings: Sequence[Writing], views: Sequence[View]
) -> Iterator[tuple[Writing, float, float]]:
    """Yield the letters of points with their distances from their own and another point, mm."""
    for view in views:
        inside = [w for w in writings if is_of_point(w.name) and box_contains(view.box, w.place)]
        there = [(w, at) for w in inside if (at := w.runs[0].names) is not None]
        points = np.asarray([at for _, at in there])
        boxes = np.asarray([w.ink.bounds for w, _ in there]).reshape(-1, 4)
        for k, (writing, at) in enumerate(there):
            strange = points[np.abs(points - at) > _SAME]
            own = float(distances(boxes[k : k + 1], points[k : k + 1])[0, 0])
            other = distances(boxes[k : k + 1], strange)
            yield writing, own, float(other.min()) if other.size else inf


def _find_letters_at_other_points(
    items: Sequence[Item], writings: Sequence[Writing], views: Sequence[View]
) -> Iterator[Finding]:
    led = {
        item.tag[len(LED) :]: abs(item.points[-1] - item.points[0])
        for item in items
        if isinstance(item, Stroke) and item.tag.startswith(LED)
    }
    for writing, own, other in measure_letter_distances(writings, views):
        far = led.get(writing.name)
        facts = {"name": writing.shown}
        if far is None and own > other + NEARER:
            yield Finding("PM-D14", writing.place, own, other, facts)
        elif far is not None and AMONG < far <= LEADER and other < AT_OTHER:
            yield Finding("PM-D14", writing.place, far, AMONG, facts)


def _find_letters_at_other_forces(
    items: Sequence[Item], writings: Sequence[Writing], views: Sequence[View]
) -> Iterator[Finding]:
    """Find letters of forces without a leader line that are placed at another force's arrow."""
    led = {item.tag for item in items if isinstance(item, Stroke) and item.tag.startswith(LED)}
    for view in views:
        arrows: Arrows = {}
        for item in items:
            if not (isinstance(item, Stroke) and item.tag.startswith(_FORCES)):
                continue
            if box_contains(view.box, sum(item.points) / len(item.points)):
                symbol = item.tag.partition(" ")[2]
                line = LineString([(p.real, p.imag) for p in item.points])
                arrows[symbol] = arrows[symbol].union(line) if symbol in arrows else line
        for writing in writings:
            symbol = writing.name.rpartition(": ")[2]
            if symbol not in arrows or LED + writing.name in led:
                continue
            if not box_contains(view.box, writing.place):
                continue
            own = writing.ink.distance(arrows[symbol])
            others = (arrow for name, arrow in arrows.items() if name != symbol)
            other = min(map(writing.ink.distance, others), default=inf)
            if own > other + NEARER:
                yield Finding("PM-D14", writing.place, own, other, {"name": writing.shown})


def _find_letters_near_other_arrows(
    writings: Sequence[Writing], arrows: Arrows
) -> Iterator[Finding]:
    for writing in writings:
        if writing.name not in arrows:
            continue
        middle = writing.ink.centroid
        near = {tag: middle.distance(arc) for tag, arc in arrows.items()}
        own = near.pop(writing.name)
        other = min(near.values(), default=inf)
        if own > other + _TOUCH:
            place = complex(middle.x, middle.y)
            yield Finding("PM-D14", place, own, other, {"name": writing.name})


def _run_into(items: Sequence[Item], arrows: Arrows) -> Iterator[Finding]:
    """Find arrows that touch one another, or lie on a slider."""
    things = [
        (arc, f"arc {Pen.THIN.value} {tag}", MIN_ARROW_SPACING) for tag, arc in arrows.items()
    ]
    things += [
        (Polygon([(p.real, p.imag) for p in item.points]), called(item), _TOUCH)
        for item in items
        if isinstance(item, Stroke) and item.tag == SLIDER
    ]
    for k, (tag, arc) in enumerate(arrows.items()):
        for other, called_so, apart in things[k + 1 :]:
            if (room := arc.distance(other)) < apart:
                middle = complex(arc.centroid.x, arc.centroid.y)
                facts = {"name": tag, "thing": called_so}
                yield Finding("PM-D15", middle, room, MIN_ARROW_SPACING, facts)


def _words(writings: Sequence[Writing]) -> Iterator[Finding]:
    """Find inscriptions side by side on one level that read as one word."""
    boxes = [writing.ink.bounds for writing in writings]
    for (one, a), (two, b) in combinations(zip(writings, boxes, strict=True), 2):
        if max(b[0] - a[2], a[0] - b[2]) >= MIN_WORD_SPACING:
            continue
        level = min(a[3], b[3]) - max(a[1], b[1])
        gap = one.ink.distance(two.ink)
        if 0.0 < gap < MIN_WORD_SPACING and level > 0.6 * min(a[3] - a[1], b[3] - b[1]):
            facts = {"one": one.shown, "two": two.shown}
            yield Finding("PM-D16", one.place, gap, MIN_WORD_SPACING, facts)


def _fractions(items: Sequence[Item], writings: Sequence[Writing]) -> Iterator[Finding]:
    """Find short level lines with one letter above and another one below them."""
    for item in items:
        if not (isinstance(item, Stroke) and item.pen is Pen.THIN and len(item.points) == 2):
            continue
        if item.tag.startswith(PART_OF) or item.tag in _VECTORS:
            continue  # an overbar
        (left, right) = sorted(item.points, key=lambda p: p.real)
        if not 2.0 < right.real - left.real < _BAR or abs(right.imag - left.imag) > 0.5:
            continue
        level = (left.imag + right.imag) / 2
        over, under = [], []
        for writing in writings:
            x0, y0, x1, y1 = writing.ink.bounds
            if min(x1, right.real) - max(x0, left.real) < 0.5 * (x1 - x0):
                continue
            if 0.0 <= y0 - level < _OVER:
                over.append(writing)
            elif 0.0 <= level - y1 < _OVER:
                under.append(writing)
        for one, two in product(over, under):
            (a0, _, a1, _), (b0, _, b1, _) = one.ink.bounds, two.ink.bounds
            if min(a1, b1) - max(a0, b0) < 0.5 * min(a1 - a0, b1 - b0):
                continue  # side by side
            facts = {"one": one.shown, "two": two.shown, "advice": "bar"}
            yield Finding("PM-D16", left, 0.0, MIN_WORD_SPACING, facts)
