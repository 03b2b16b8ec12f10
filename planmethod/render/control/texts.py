"""Lint of a display list (нормоконтроль чертежа): faults of texts by the drafting standards.

The lint looks at the paper, not at mechanisms. Lines, views and the sheet as a whole are checked by
`planmethod.render.control.sheet`; the sentences are in `planmethod.render.control.remarks`.

Codes:

``PM-D01``  two inscriptions overlap
``PM-D02``  an inscription lies on a line, arc or filled area
``PM-D03``  a text leaves the cell it belongs to
``PM-D04``  a text leaves the frame of the sheet
``PM-D05``  letters are smaller than the standard allows
``PM-D06``  a text was shortened because its cell cannot hold it
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from msgspec import Struct
from shapely import LineString, Point, Polygon, STRtree, union_all
from shapely.geometry.base import BaseGeometry

from planmethod.render.control.remarks import Finding
from planmethod.render.frame.frame import MARGIN_NOTE, STAMP
from planmethod.render.ink.drawing import Arc, Bounds, Disc, Fill, Ink, Item, Pen, Stroke, Text
from planmethod.render.ink.extent import arc_points
from planmethod.render.ink.typeset import PART_OF, SMALLEST, text_bounds, text_corners
from planmethod.render.labels.model import BREAKABLE, UNDER_LABEL
from planmethod.render.labels.paper import arc_step
from planmethod.render.layout.block import CUT

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
            extent = common.length
            if extent > 2 * _TOUCH:
                facts = {"shown": writing.shown, "thing": called(item)}
                yield Finding("PM-D02", writing.place, extent, 0.0, facts)


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
