"""Norm control of the texts of a drawing: faults by the standards, misleading inscriptions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations, product
from math import inf

import numpy as np
from msgspec import Struct
from shapely import LineString, Point, Polygon, STRtree, union_all
from shapely.geometry.base import BaseGeometry

from planmethod.plans.model import PlanKind, VectorKind
from planmethod.render.control.remarks import Facts, Finding
from planmethod.render.frame import MARGIN_NOTE, STAMP
from planmethod.render.ink.drawing import (
    Arc,
    Bounds,
    Disc,
    Fill,
    Ink,
    Item,
    Pen,
    Span,
    Stroke,
    Text,
    View,
)
from planmethod.render.ink.typeset import PART_OF, SMALLEST, arc_points, text_bounds, text_corners
from planmethod.render.labels.model import BREAKABLE, LED, MIN_LEADER, UNDER_LABEL
from planmethod.render.labels.paper import arc_step, distances
from planmethod.render.layout.block import CUT
from planmethod.render.pictures.lettered import ENLARGED
from planmethod.render.symbols import FORCE, PLAN_FORCE, SLIDER
from planmethod.solved.legibility import MAX_LABELS, MERGE_DISTANCE, SIDE, densest

SMALLEST_OF_ALL = 1.8
"""Smallest height of an index and in the title block, mm (the smallest of GOST 2.304)."""

GRID = "grid"
"""Tag of the lines of the grid under sample letters, which may run through the letters."""

_TOUCH = 0.05  # mm: smaller depths do not count as an overlap


class Writing(Struct, frozen=True):
    """One inscription (надпись): its runs, the ink boxes, its place in the drawing order."""

    name: str
    runs: tuple[Text, ...]
    ink: BaseGeometry
    first: int
    last: int

    @property
    def shown(self) -> str:
        """All its letters, with the indices."""
        return "".join(run.text for run in self.runs)

    @property
    def place(self) -> complex:
        """Place of its first run, mm."""
        return self.runs[0].at


def lint(
    items: Sequence[Item],
    inner: Bounds | None = None,
    *,
    ignore: Iterable[Pen] = (),
) -> list[Finding]:
    """Check a display list and return the faults of its texts (нормоконтроль).

    Parameters
    ----------
    items : sequence of Item
        In drawing order: a line drawn before a white area is hidden by it.
    inner : Bounds, mm, optional
        Inside of the frame; texts tagged as margin notes may be outside.
    ignore : iterable of Pen
        Lines that may run under letters.

    Returns
    -------
    list of Finding
        In the order of the codes, then of the drawing.
    """
    writings = writings_of(items)
    findings = [
        *_overlaps(writings),
        *_crossed(writings, items, frozenset(ignore)),
        *_outside(items, inner),
        *_small(writings),
        *_shortened(writings),
    ]
    return sorted(findings, key=lambda finding: finding.code)


def writings_of(items: Sequence[Item]) -> list[Writing]:
    """Join the runs of one label."""
    groups: dict[str, list[tuple[int, Text]]] = {}
    for k, item in enumerate(items):
        if isinstance(item, Text) and item.text.strip():
            groups.setdefault(item.label or f"\0{k}", []).append((k, item))
    return [
        Writing(
            name,
            tuple(run for _, run in members),
            union_all([_ink(run) for _, run in members]),
            members[0][0],
            members[-1][0],
        )
        for name, members in groups.items()
    ]


def _ink(run: Text) -> BaseGeometry:
    return Polygon([(p.real, p.imag) for p in text_corners(run)])


def _overlaps(writings: Sequence[Writing]) -> Iterator[Finding]:
    inks = [writing.ink for writing in writings]
    if not inks:
        return
    tree = STRtree(inks)
    for one, two in sorted(zip(*tree.query(inks, predicate="intersects").tolist(), strict=True)):
        if one >= two:
            continue
        common = inks[one].intersection(inks[two])
        if common.area > _TOUCH**2 and _depth(common) > _TOUCH:
            facts = {"one": writings[one].shown, "two": writings[two].shown}
            yield Finding("PM-D01", writings[one].place, common.area, 0.0, facts)


def _depth(area: BaseGeometry) -> float:
    x0, y0, x1, y1 = area.bounds
    return float(min(x1 - x0, y1 - y0))


def _crossed(
    writings: Sequence[Writing], items: Sequence[Item], ignore: frozenset[Pen]
) -> Iterator[Finding]:
    """Find lines and areas that run through letters and are not hidden by white.

    The white ground of a label of a crowd hides thin lines only; any other covered item counts as
    covered by letters.
    """
    seen = ((k, item) for k, item in enumerate(items) if item.tag != GRID)
    things = [(k, shape) for k, item in seen if (shape := _shape(item, ignore))]
    whites = [(k, s) for k, s in things if _is_white(items[k])]
    tree = STRtree([shape for _, shape in things])
    for writing in writings:
        under: dict[str, BaseGeometry] = {}  # the pieces of a line are one line
        for hit in sorted(tree.query(writing.ink, predicate="intersects").tolist()):
            order, shape = things[hit]
            item = items[order]
            if item.tag == PART_OF + writing.name:
                continue
            if _is_white(item) and order < writing.last:
                continue  # White before the letters is a clean ground; after, it hides them.
            common = shape.intersection(writing.ink)
            if not _is_white(item):
                for k, white in whites:
                    if items[k].tag == UNDER_LABEL and not _breaks(item):
                        continue
                    if order < k < writing.first and white.intersects(common):
                        common = common.difference(white)
            name = called(item)
            under[name] = common.union(under[name]) if name in under else common
        for name, common in under.items():
            if common.length > 2 * _TOUCH:
                facts = {"shown": writing.shown, "thing": name}
                yield Finding("PM-D02", writing.place, common.length, 0.0, facts)


def _is_white(item: Item) -> bool:
    return isinstance(item, (Fill, Disc)) and item.ink is Ink.WHITE


def _breaks(item: Item) -> bool:
    """Return whether the white ground of a label may break an item: only thin lines."""
    return isinstance(item, (Stroke, Arc)) and item.pen in BREAKABLE


def _shape(item: Item, ignore: frozenset[Pen]) -> BaseGeometry | None:
    """Return the geometry of an item: a line, or an area when it is filled."""
    match item:
        case Stroke(points=path, pen=pen, closed=closed) if len(path) > 1 and pen not in ignore:
            ends = (*path, path[0]) if closed else path
            return LineString([(p.real, p.imag) for p in ends])
        case Arc(pen=pen) if pen not in ignore:
            return LineString([(p.real, p.imag) for p in arc_points(item, step=arc_step(item))])
        case Fill(points=path) if len(path) > 2:
            return Polygon([(p.real, p.imag) for p in path]).buffer(0)
        case Disc(centre=centre, radius=radius):
            return Point(centre.real, centre.imag).buffer(radius)
    return None


def called(item: Item) -> str:
    """Return the name of an item in the facts of a finding: kind, pen, tag."""
    pen = item.pen.value if isinstance(item, (Stroke, Arc)) else ""
    return f"{type(item).__name__.lower()} {pen} {item.tag}".rstrip()


def _outside(items: Sequence[Item], inner: Bounds | None) -> Iterator[Finding]:
    for run in items:
        if not isinstance(run, Text) or not run.text.strip():
            continue
        ink = text_bounds(run)
        if run.box is not None and (out := measure_overhang(ink, run.box)) > _TOUCH:
            yield Finding("PM-D03", run.at, out, 0.0, {"shown": run.text})
        if inner is None or MARGIN_NOTE in run.tag.split():
            continue
        if (out := measure_overhang(ink, inner)) > _TOUCH:
            yield Finding("PM-D04", run.at, out, 0.0, {"shown": run.text})


def measure_overhang(ink: Bounds, limits: Bounds) -> float:
    """Return how far a box sticks out of another, mm."""
    return max(limits[0] - ink[0], limits[1] - ink[1], ink[2] - limits[2], ink[3] - limits[3])


def _small(writings: Sequence[Writing]) -> Iterator[Finding]:
    for writing in writings:
        main = max(run.height for run in writing.runs)
        for run in writing.runs:
            small = run.height < main or STAMP in run.tag.split()
            limit = SMALLEST_OF_ALL if small else SMALLEST
            if run.height < limit - 1e-6:
                facts = {"shown": run.text, "whole": writing.shown}
                yield Finding("PM-D05", run.at, run.height, limit, facts)


def _shortened(writings: Sequence[Writing]) -> Iterator[Finding]:
    for writing in writings:
        if any(CUT in run.tag.split() for run in writing.runs):
            yield Finding("PM-D06", writing.place, 1.0, 0.0, {"shown": writing.shown})


LEADER = 40.0
"""Longest leader line of a letter, mm: the eye does not follow it further."""

AMONG, AT_OTHER = 24.0, 4.0
"""Longest leader line of a letter that is placed at another point, and the distance from that
point, mm: it is read as that point's."""

NEARER = 0.5
"""Difference of distances from which a letter without a leader line is taken for the nearer
point's, mm."""

AT_END = 0.3
"""Difference of the distances of another vector and of its own from the end of a leader line up to
which the name may be that of both, mm."""

MIN_ARROW_SPACING = 1.0
"""Least white between two arrows of turns, mm."""

MIN_WORD_SPACING = 1.0
"""Least white between two inscriptions on one level, mm: a word gap of letters of 2.5 mm."""

_BAR = 25.0  # mm: a longer line is not the bar of a fraction
_OVER = 3.5  # mm: a letter further from a line than this is not on it

_VECTORS = {*(kind.value for kind in VectorKind), "similar"}
"""Tags of vectors and of the sides of similar figures, which the letters at their ends name."""

_POINTS = ("point ", *(f"{kind.value} " for kind in PlanKind))
_FORCES = (f"{FORCE} ", f"{PLAN_FORCE} ")
_COMPONENT = re.compile(r"\^\{[nτ]\}")  # superscript of a component
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
    yield from _find_names_at_other_vectors(items, writings, views)
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
            if not MIN_LEADER - _TOUCH <= far <= LEADER:
                name = item.tag[len(LED) :]
                facts = {"name": shown.get(name, name)}
                limit = LEADER if far > LEADER else MIN_LEADER
                yield Finding("PM-D14", item.points[-1], far, limit, facts)


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
    """Find letters of forces without a leader line that are placed at another force's arrow.

    The letter of a force may be in the triangle of its components, which have superscripts.
    """
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
            symbol = symbol_of(writing.name)
            if symbol not in arrows or LED + writing.name in led:
                continue
            if not box_contains(view.box, writing.place):
                continue
            own = writing.ink.distance(arrows[symbol])
            others = (
                arrow
                for name, arrow in arrows.items()
                if symbol not in (name, _COMPONENT.sub("", name))
            )
            other = min(map(writing.ink.distance, others), default=inf)
            if own > other + NEARER:
                yield Finding("PM-D14", writing.place, own, other, {"name": writing.shown})


class NameDistances(Struct, frozen=True):
    """Distances of a vector's name from its own and the nearest other vector of the plan, mm.

    Those of a name with a leader line are of the end of the line: 0 from vectors that it crosses
    without a dot on its own.
    """

    writing: Writing
    own_distance: float
    other_distance: float
    has_leader: bool
    view: View
    position: int | None

    def is_misleading(self, nearer: float) -> bool:
        """Return whether the other vector is nearer than its own by more than ``nearer``, mm.

        At the end of a leader line the other one must be farther by `AT_END`.
        """
        return self.own_distance > self.other_distance + (-AT_END if self.has_leader else nearer)


def measure_name_distances(
    items: Sequence[Item], writings: Sequence[Writing], views: Sequence[View]
) -> Iterator[NameDistances]:
    """Yield the distances of the names of vectors."""
    leaders = {
        item.tag[len(LED) :]: item.points
        for item in items
        if isinstance(item, Stroke) and item.tag.startswith(LED)
    }
    dotted = {item.tag for item in items if isinstance(item, Disc) and item.tag.startswith(LED)}
    written = {writing.name: writing for writing in writings}
    for view in views:
        for position in dict.fromkeys(span.position for span in view.spans):
            spans = [span for span in view.spans if span.position == position]
            lines = [_segment(span.start, span.end) for span in spans]
            for span, line in zip(spans, lines, strict=True):
                writing = written.get(span.label) if span.label else None
                if writing is None:
                    continue
                ends = [Point(p.real, p.imag) for p in leaders.get(writing.name, ())]
                near = min(ends, key=line.distance, default=writing.ink)
                others = [other for other in lines if other is not line]
                other = min(map(near.distance, others), default=inf)
                is_plain = ends and LED + writing.name not in dotted
                if is_plain and any(map(LineString(ends).crosses, others)):
                    other = 0.0
                own = line.distance(near)
                yield NameDistances(writing, own, other, bool(ends), view, position)


def _find_names_at_other_vectors(
    items: Sequence[Item], writings: Sequence[Writing], views: Sequence[View]
) -> Iterator[Finding]:
    """Find names of vectors nearer to another vector of the plan, or led across or to another."""
    for one in measure_name_distances(items, writings, views):
        if one.is_misleading(NEARER):
            facts = {"name": one.writing.shown}
            place, view = one.writing.place, one.view
            yield Finding(
                "PM-D14",
                place,
                one.own_distance,
                one.other_distance,
                facts,
                view.kind,
                one.position,
            )


def _segment(start: complex, end: complex) -> LineString:
    return LineString([(start.real, start.imag), (end.real, end.imag)])


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


NAMED = 5.0
"""Length from which a vector has its name, mm."""

UNNAMED = 20.0
"""Largest share of the vectors of the plan of one position that may be without a name, per cent.
On one of many plans, and in a bundle, the letters of both ends name a vector, too."""

BUNDLE = 1.5
"""Distance of other vectors all along a vector of a bundle: no leader line can lead to it, mm."""

_ALLOWANCE = 4  # a square may have more letters than points, for letters lie beside the points


def find_crowded_schemes(writings: Sequence[Writing], views: Sequence[View]) -> Iterator[Finding]:
    """Find schemes with too many letters in one place: one finding for each, at the densest."""
    for view in views:
        if view.kind != PlanKind.POSITION.value:
            continue
        own = [w for w in writings if is_of_point(w.name) and box_contains(view.box, w.place)]
        count, where = densest([complex(w.ink.centroid.x, w.ink.centroid.y) for w in own])
        if count > MAX_LABELS + _ALLOWANCE:
            facts: Facts = {"side": SIDE}
            yield Finding(
                "PM-D17", where, float(count), float(MAX_LABELS + _ALLOWANCE), facts, view.kind
            )


def find_unnamed_vectors(writings: Sequence[Writing], views: Sequence[View]) -> Iterator[Finding]:
    """Find plans with too many vectors without a name: one finding for each plan."""
    there = {writing.name for writing in writings}
    enlarged = {symbol_of(name) for name in there if name.startswith(f"{ENLARGED} ")}
    lettered = [w.runs[0].names for w in writings if is_of_point(w.name)]
    places = np.asarray([place for place in lettered if place is not None])
    for view in views:
        for position in dict.fromkeys(span.position for span in view.spans):
            spans = [span for span in view.spans if span.position == position]
            long = [span for span in spans if span.label and span.length >= NAMED]
            bare = [span for span in long if span.label not in there]
            if position is None:  # the names of enlarged views are of its vectors
                bare = [span for span in bare if symbol_of(span.label) not in enlarged]
            bare = [
                span
                for span in bare
                if (position is None and not _is_in_bundle(span, spans))
                or not _has_lettered_ends(span, places)
            ]
            share = 100.0 * len(bare) / max(len(long), 1)
            if share > UNNAMED:
                facts = {"segments": tuple((span.name, round(span.length, 3)) for span in bare)}
                where = (bare[0].start + bare[0].end) / 2
                yield Finding("PM-D18", where, share, UNNAMED, facts, view.kind, position)


def symbol_of(name: str) -> str:
    """Return the symbol in the name of an inscription: ``v_{B}`` of ``velocity 0: v_{B}``."""
    return name.rpartition(": ")[2]


def _is_in_bundle(span: Span, spans: Sequence[Span]) -> bool:
    """Return whether other vectors are beside a vector along its whole length."""
    others = [_segment(one.start, one.end) for one in spans if one is not span]
    alone = _segment(span.start, span.end).difference(union_all(others).buffer(BUNDLE))
    return bool(alone.length < _TOUCH)


def _has_lettered_ends(span: Span, places: np.ndarray) -> bool:
    """Return whether the points at both ends of a vector, or points drawn as one, have letters."""
    ends = (span.start, span.end)
    return bool(len(places)) and all(np.abs(places - end).min() <= MERGE_DISTANCE for end in ends)
