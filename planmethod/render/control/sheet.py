"""Norm control of a whole sheet (нормоконтроль листа): texts, lines, views, unused paper."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from math import ceil, floor, tau

from msgspec.structs import replace

from planmethod.render.control.order import find_disorder
from planmethod.render.control.remarks import Facts, Finding
from planmethod.render.control.texts import (
    box_contains,
    find_crowded_schemes,
    find_unnamed_vectors,
    lint,
    measure_overhang,
    misleading,
    writings_of,
)
from planmethod.render.frame import (
    FRAME_LEFT,
    FRAME_OTHER,
    MARGIN_NOTE,
    STAMP,
    STAMP_HEIGHT,
    STAMP_WIDTH,
)
from planmethod.render.ink.drawing import (
    Arc,
    Bounds,
    Disc,
    Drawing,
    Fill,
    Ink,
    Item,
    Stroke,
    Text,
    View,
    arc_spans,
    stroke_lines,
    sweep,
)
from planmethod.render.ink.lettering import using
from planmethod.render.ink.pens import PENS
from planmethod.render.ink.typeset import arc_points, ink_bounds, text_corners
from planmethod.solved.legibility import FEW

CELL = 5.0
"""Side of the squares that the paper is divided into, mm."""

FRAME = ("edge", "frame")
"""Tags of the lines around the field, which do not count as ink on it."""


def largest_empty(items: Iterable[Item], inner: Bounds, pictures: Iterable[Bounds] = ()) -> Bounds:
    """Return the largest rectangle within the frame that no ink touches, mm.

    The paper is divided into squares of `CELL`; a square with ink is taken as a whole, so the
    rectangle is exact to one square at each side. White inside of a picture is the picture's.
    """
    x0, y0, x1, y1 = inner
    taken = _find_inked_squares(items, inner)
    for box in pictures:
        first, end = max(0, floor((box[0] - x0) / CELL)), max(0, ceil((box[2] - x0) / CELL))
        for row in taken[max(0, floor((box[1] - y0) / CELL)) : max(0, ceil((box[3] - y0) / CELL))]:
            row[first:end] = [True] * len(row[first:end])
    left, low, right, high = _largest(taken, len(taken[0]))
    return (
        x0 + left * CELL,
        y0 + low * CELL,
        min(x0 + right * CELL, x1),
        min(y0 + high * CELL, y1),
    )


def inked_percentage(items: Iterable[Item], inner: Bounds) -> float:
    """Return the share of the squares of `CELL` within the frame that ink touches, %."""
    taken = _find_inked_squares(items, inner)
    return 100.0 * sum(map(sum, taken)) / (len(taken) * len(taken[0]))


def _find_inked_squares(items: Iterable[Item], inner: Bounds) -> list[list[bool]]:
    """Return the squares that ink touches as rows of flags from below."""
    x0, y0, x1, y1 = inner
    columns, rows = ceil((x1 - x0) / CELL), ceil((y1 - y0) / CELL)
    taken = [[False] * columns for _ in range(rows)]
    for item in items:
        for point in ink_points(item) if item.tag not in FRAME else ():
            k, j = floor((point.real - x0) / CELL), floor((point.imag - y0) / CELL)
            if 0 <= k < columns and 0 <= j < rows:
                taken[j][k] = True
    return taken


def area_percentage(box: Bounds, inner: Bounds) -> float:
    """Return the share of the field within the frame that a rectangle takes, %."""
    left, low, right, high = box
    return 100.0 * (right - left) * (high - low) / ((inner[2] - inner[0]) * (inner[3] - inner[1]))


def ink_points(item: Item) -> list[complex]:
    """Return points of an item's ink, close enough that no square of `CELL` is missed."""
    match item:
        case Stroke(points=path, closed=closed):
            return _sample_path([*path, path[0]] if closed and path else path)
        case Arc():
            return _sample_path(arc_points(item))
        case Fill(points=path):
            return _sample_path([*path, *path[:1]])
        case Disc(centre=centre, radius=radius):
            return [centre, *(centre + radius * way for way in (1, 1j, -1, -1j))]
        case Text():
            first, second, third, fourth = text_corners(item)
            return _sample_path([first, second, third, fourth, first])


def _sample_path(path: Sequence[complex]) -> list[complex]:
    points = list(path[:1])
    for start, end in pairwise(path):
        count = max(1, ceil(abs(end - start) / (0.4 * CELL)))
        points += [start + (end - start) * k / count for k in range(1, count + 1)]
    return points


def _largest(occupied: Sequence[Sequence[bool]], columns: int) -> tuple[int, int, int, int]:
    """Return the largest free rectangle in squares: under a skyline that grows row by row."""
    best, most = (0, 0, 0, 0), 0
    free = [0] * (columns + 1)  # how many free squares end in this row; the last is a wall
    for row, line in enumerate(occupied):
        starts: list[tuple[int, int]] = []  # column and height, rising
        for k in range(columns + 1):
            free[k] = 0 if k == columns or line[k] else free[k] + 1
            start = k
            while starts and starts[-1][1] >= free[k]:
                start, height = starts.pop()
                if height * (k - start) > most:
                    most = height * (k - start)
                    best = (start, row + 1 - height, k, row + 1)
            starts.append((start, free[k]))
    return best


SHORTEST = 5.0
"""Shortest segment of a plan, mm: half a division of the ruler is then a tenth of it."""

LARGEST = 20.0
"""Enlargement of a plan beyond which its short segments count as zero."""

MANY_SHORT = 25.0
"""Share of short segments in the plan of one of many positions, per cent."""

UNUSED = 12.0
"""Largest empty rectangle, per cent of the field within the frame."""

INKED = 18.0
"""Least share of the field that has ink, per cent of its squares of 5 mm."""

_TOUCH = 0.05  # mm: smaller overhangs do not count as outside
_FRAME_TAGS = frozenset({"edge", "frame", STAMP})


def inspect(drawing: Drawing) -> list[Finding]:
    """Check a whole sheet (нормоконтроль).

    Returns
    -------
    list of Finding
        In the order of the codes, then of the drawing; each has the view that it is found on.
    """
    with using(drawing.lettering):
        return _inspected(drawing)


def _inspected(drawing: Drawing) -> list[Finding]:
    inner = (
        FRAME_LEFT,
        FRAME_OTHER,
        drawing.width - FRAME_OTHER,
        drawing.height - FRAME_OTHER,
    )
    writings = writings_of(drawing.items)
    findings = [
        *(_attributed(finding, drawing.views, inner) for finding in lint(drawing.items, inner)),
        *lines_outside(drawing.items, drawing.views, inner),
        *run_into_graphs(drawing.items, drawing.views),
        *short_segments(drawing.views),
        *scales_missing(drawing.items, drawing.views),
        *(() if drawing.is_continuation else unused_paper(drawing, inner)),
        *(_attributed(finding, drawing.views, inner) for finding in dashes_unseen(drawing.items)),
        *(
            _attributed(finding, drawing.views, inner)
            for finding in misleading(drawing.items, writings, drawing.views)
        ),
        *find_crowded_schemes(writings, drawing.views),
        *find_unnamed_vectors(writings, drawing.views),
        *(
            _attributed(finding, drawing.views, inner) if not finding.view else finding
            for finding in find_disorder(drawing, writings)
        ),
    ]
    return sorted(findings, key=lambda finding: finding.code)


def _attributed(finding: Finding, views: Iterable[View], inner: Bounds) -> Finding:
    """Return a finding with the view, or the title block, that contains its place."""
    for view in views:
        if box_contains(view.box, finding.place):
            return replace(finding, view=view.kind)
    right, low = inner[2], inner[1]
    if box_contains((right - STAMP_WIDTH, low, right, low + STAMP_HEIGHT), finding.place):
        return replace(finding, view=STAMP)
    return finding


def _meet(one: Bounds, two: Bounds) -> bool:
    across = one[0] <= two[2] and two[0] <= one[2]
    return across and one[1] <= two[3] and two[1] <= one[3]


def _middle(box: Bounds) -> complex:
    return complex(box[0] + box[2], box[1] + box[3]) / 2


# Views --------------------------------------------------------------------------------------------


def lines_outside(items: Sequence[Item], views: Sequence[View], inner: Bounds) -> Iterator[Finding]:
    """Find views whose lines leave the frame: one finding for each view, at the furthest line."""
    worst: dict[str, tuple[float, complex]] = {}
    for item in items:
        if not isinstance(item, (Stroke, Arc, Fill, Disc)) or item.tag in _FRAME_TAGS:
            continue
        if isinstance(item, (Fill, Disc)) and item.ink is Ink.WHITE:
            continue
        box = ink_bounds([item])
        out = measure_overhang(box, inner)
        if out <= _TOUCH:
            continue
        kind = next((view.kind for view in views if _meet(view.box, box)), "")
        if out > worst.get(kind, (0.0, 0j))[0]:
            worst[kind] = (out, _furthest(box, inner))
    for kind, (out, where) in worst.items():
        yield Finding("PM-D07", where, out, 0.0, {}, view=kind)


def run_into_graphs(items: Sequence[Item], views: Sequence[View]) -> Iterator[Finding]:
    """Find items that run into the title block and the other graphs: one finding for each graph."""
    graphs = [
        ink_bounds([item])
        for item in items
        if isinstance(item, Stroke) and item.closed and item.tag == STAMP
    ]
    others = [(item, ink_bounds([item])) for item in items if not _is_furniture(item)]
    for box in graphs:
        found = [_inside(item, box) for item, ink in others if _meet(box, ink)]
        depth, where = max(found, key=lambda one: one[0], default=(0.0, 0j))
        if depth > _TOUCH:
            kind = next((view.kind for view in views if box_contains(view.box, where)), "")
            yield Finding("PM-D13", where, depth, 0.0, {}, view=kind)


def _is_furniture(item: Item) -> bool:
    words = item.tag.split()
    white = isinstance(item, (Fill, Disc)) and item.ink is Ink.WHITE
    return white or not _FRAME_TAGS.isdisjoint(words) or MARGIN_NOTE in words


def _inside(item: Item, box: Bounds) -> tuple[float, complex]:
    """Return the depth of an item's ink in a box, mm, and its deepest place."""
    found = (
        (min(p.real - box[0], box[2] - p.real, p.imag - box[1], box[3] - p.imag), p)
        for p in ink_points(item)
        if box_contains(box, p)
    )
    return max(found, key=lambda one: one[0], default=(0.0, 0j))


def _furthest(box: Bounds, inner: Bounds) -> complex:
    """Return the middle of the side of a box that is furthest outside."""
    middle = _middle(box)
    sides = (
        (inner[0] - box[0], complex(box[0], middle.imag)),
        (inner[1] - box[1], complex(middle.real, box[1])),
        (box[2] - inner[2], complex(box[2], middle.imag)),
        (box[3] - inner[3], complex(middle.real, box[3])),
    )
    return max(sides, key=lambda side: side[0])[1]


def short_segments(views: Iterable[View]) -> Iterator[Finding]:
    """Find plans with segments that are too short: one finding for a plan in one position.

    Over a turn some vectors pass through zero, whatever the scale: of many positions a plan is
    found where it has many short ones, not counting those that are zero on the paper.
    """
    for view in views:
        positions = dict.fromkeys(span.position for span in view.spans)
        are_many = len(positions) > FEW
        for position in positions:
            own = [span for span in view.spans if span.position == position]
            if are_many:
                own = [span for span in own if span.length * LARGEST >= SHORTEST]
            short = [span for span in own if span.length < SHORTEST - 1e-6]
            if not short or (are_many and 100.0 * len(short) < MANY_SHORT * len(own)):
                continue
            where, least = (short[0].start + short[0].end) / 2, min(span.length for span in short)
            facts: Facts = {
                "segments": tuple((span.name, round(span.length, 3)) for span in short),
                "times": float(f"{SHORTEST / max(least, 1e-3):.2g}"),
            }
            yield Finding("PM-D08", where, least, SHORTEST, facts, view.kind, position)


def scales_missing(items: Sequence[Item], views: Iterable[View]) -> Iterator[Finding]:
    """Find views that have a scale but no inscription of it."""
    writings = writings_of(items)
    for view in views:
        letters = view.scale.translate({ord(sign): None for sign in "_{}"})
        if not letters:
            continue
        said = (
            box_contains(view.box, writing.place)
            and writing.shown.replace(" ", "").startswith(f"{letters}=")
            for writing in writings
        )
        if not any(said):
            where = complex(_middle(view.box).real, view.box[1])
            yield Finding("PM-D09", where, 0.0, 1.0, {"scale": letters}, view.kind)


# Paper and lines ----------------------------------------------------------------------------------


def unused_paper(drawing: Drawing, inner: Bounds) -> Iterator[Finding]:
    """Find an empty rectangle that is too large, and a field with little ink."""
    box = largest_empty(drawing.items, inner, [view.box for view in drawing.views])
    width, height, share = box[2] - box[0], box[3] - box[1], area_percentage(box, inner)
    if share > UNUSED:
        facts = {"width": float(round(width)), "height": float(round(height))}
        yield Finding("PM-D10", _middle(box), share, UNUSED, facts)
    inked = inked_percentage(drawing.items, inner)
    if inked < INKED:
        yield Finding("PM-D19", _middle(inner), inked, INKED, {})


def dashes_unseen(items: Iterable[Item]) -> Iterator[Finding]:
    """Find dashed lines that do not begin and end with a stroke, or are too short for a pattern."""
    for item in items:
        if not isinstance(item, (Stroke, Arc)) or PENS[item.pen].dashes is None:
            continue
        pieces, wanting = _dashed(item)
        if not pieces:
            continue
        where = _middle(ink_bounds([item]))
        facts = {"thing": f"line {item.pen.value} {item.tag}".rstrip()}
        if wanting > _TOUCH:
            yield Finding("PM-D11", where, wanting, 0.0, facts)
        elif pieces < 2:
            length = _length(item)
            yield Finding("PM-D12", where, length, length * _enlarged(item), facts)


def _dashed(item: Stroke | Arc) -> tuple[int, float]:
    """Return the number of pieces of a line, and the distance of its ends from the strokes, mm."""
    if isinstance(item, Arc):
        turn, spans = sweep(item), arc_spans(item)
        if not spans or turn >= tau - 1e-9:
            return len(spans), 0.0
        ends = (abs(spans[0][0] - item.start), abs(sum(spans[-1]) - item.start - turn))
        return len(spans), max(ends) * item.radius
    lines = stroke_lines(item)
    if not lines or item.closed:
        return len(lines), 0.0
    ends = (abs(lines[0][0] - item.points[0]), abs(lines[-1][-1] - item.points[-1]))
    return len(lines), max(ends)


def _length(item: Stroke | Arc) -> float:
    if isinstance(item, Arc):
        return sweep(item) * item.radius
    path = [*item.points, *item.points[:1]] if item.closed else item.points
    return sum(abs(end - start) for start, end in pairwise(path))


def _enlarged(item: Stroke | Arc) -> float:
    """Return the enlargement at which a figure shows two strokes, to a thousandth."""

    def shows(times: float) -> bool:
        if isinstance(item, Arc):
            return _dashed(replace(item, radius=item.radius * times))[0] > 1
        return _dashed(replace(item, points=tuple(p * times for p in item.points)))[0] > 1

    low, high = 1.0, 2.0
    while not shows(high) and high < 1e6:
        low, high = high, 2 * high
    while high - low > 1e-3 * low:
        middle = (low + high) / 2
        low, high = (low, middle) if shows(middle) else (middle, high)
    return high
