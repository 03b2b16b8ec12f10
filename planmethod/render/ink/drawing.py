"""Display list: items on the paper in mm, y up; widths, dashes and heights by meaning."""

from __future__ import annotations

from bisect import bisect_right
from cmath import phase, rect
from collections.abc import Iterable, Iterator, Sequence
from enum import Enum
from itertools import accumulate, pairwise
from math import radians, tau
from typing import TypeAlias

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.render.ink.lettering import OutlineLettering, in_use
from planmethod.render.ink.pens import PENS, Dashes, Pen as Pen, PenSet, pens_in_use


class Ink(Enum):
    """Colour of a filled area."""

    BLACK = "black"
    WHITE = "white"


class Stroke(Struct, frozen=True):
    """Open or closed polyline.

    ``smooth`` marks points of a curve without corners, which a format with splines draws as one.
    """

    points: tuple[complex, ...]
    pen: Pen = Pen.MAIN
    closed: bool = False
    tag: str = ""
    smooth: bool = False


class Arc(Struct, frozen=True):
    """Circular arc, counter-clockwise from ``start`` to ``end`` (radians); by default a circle."""

    centre: complex
    radius: float
    start: float = 0.0
    end: float = 6.283185307179586
    pen: Pen = Pen.MAIN
    tag: str = ""


class Fill(Struct, frozen=True):
    """Filled polygon: an arrowhead, a rigid corner, the white inside of a joint.

    ``pen`` is that of the lines it belongs to, whose colour a black area has.
    """

    points: tuple[complex, ...]
    ink: Ink = Ink.BLACK
    tag: str = ""
    pen: Pen = Pen.MAIN


class Disc(Struct, frozen=True):
    """Filled circle."""

    centre: complex
    radius: float
    ink: Ink = Ink.WHITE
    tag: str = ""


class Text(Struct, frozen=True):
    """One run of letters; ``at`` is the left end of its base line (always left anchored).

    ``height`` is the cap height h of GOST 2.304 in mm, ``angle`` turns the run about ``at``,
    degrees. ``label`` groups the runs of one inscription (a letter and its index): the lint treats
    runs with one non-empty label as one. ``box`` is the cell that the text must stay in, or None;
    ``names`` is the point that a letter names, or None. ``lettering`` is a name of it; empty for
    that of the sheet.
    """

    at: complex
    text: str
    height: float
    angle: float = 0.0
    label: str = ""
    box: tuple[float, float, float, float] | None = None  # xmin, ymin, xmax, ymax
    tag: str = ""
    names: complex | None = None
    lettering: str = ""


Item: TypeAlias = Stroke | Arc | Fill | Disc | Text
Bounds: TypeAlias = tuple[float, float, float, float]
"""xmin, ymin, xmax, ymax in mm."""


class Span(Struct, frozen=True):
    """One segment of a plan as it lies on the sheet (отрезок плана).

    ``name`` is its letters, ``position`` the number of the position on the sheet (None if there is
    only one), ``start`` and ``end`` are mm; ``magnification`` is its enlargement relative to the
    scale of its view: a plan may have a scale of its own. ``label`` is the name of the inscription
    that names its vector; empty if it needs none.
    """

    name: str
    position: int | None
    start: complex
    end: complex
    magnification: float = 1.0
    label: str = ""

    @property
    def length(self) -> float:
        """Length, mm."""
        return abs(self.end - self.start)


VIEW_KINDS = (
    "position", "velocity", "acceleration", "forces", "balance", "reactions", "hodograph",
    "structure", "flywheel", "diagram", "meshing", "trajectory", "cam",
)  # fmt: skip
"""Kinds of views; every language has a word for each."""


class View(Struct, frozen=True):
    """One view of a sheet, for its checks (вид).

    Attributes
    ----------
    kind : str
        One of `VIEW_KINDS`.
    box : Bounds, mm
        The picture with its title and inscriptions.
    scale : str
        Beginning of its scale inscription, ``μ_{v}``; empty where a view has no scale.
    per_mm : float
        The scale, SI units per mm.
    spans : tuple of Span
        The segments that are measured on it.
    """

    kind: str
    box: Bounds
    scale: str = ""
    per_mm: float = 0.0
    spans: tuple[Span, ...] = ()


class Drawing(Struct):
    """Display list of one sheet, drawn in order (чертёж), and its views.

    ``lettering`` is the one that its texts were measured in: the output formats draw them in it,
    and its lines with ``pens``.
    ``has_omissions`` means that optional blocks were left out to make room for the others;
    ``is_continuation``, that the sheet continues the one before.
    """

    width: float
    height: float
    title: str = ""
    items: list[Item] = field(default_factory=list)
    views: list[View] = field(default_factory=list)
    lettering: OutlineLettering = field(default_factory=in_use)
    pens: PenSet = field(default_factory=pens_in_use)
    has_omissions: bool = False
    is_continuation: bool = False

    def _repr_svg_(self) -> str:
        """Return the SVG that a notebook shows."""
        from pkgutil import resolve_name

        # Formats are in a higher layer: this one is found by name, as public names are.
        data: bytes = resolve_name("planmethod.render.backends:render")(self, "svg")
        return data.decode()

    def add(self, *items: Item) -> None:
        """Append items."""
        self.items.extend(items)

    def extend(self, items: Iterable[Item]) -> None:
        """Append many items."""
        self.items.extend(items)


def shifted(items: Iterable[Item], by: complex) -> Iterator[Item]:
    """Yield the items moved by ``by`` mm."""
    for item in items:
        match item:
            case Stroke(points=points):
                yield replace(item, points=tuple(point + by for point in points))
            case Fill(points=points):
                yield replace(item, points=tuple(point + by for point in points))
            case Arc(centre=centre) | Disc(centre=centre):
                yield replace(item, centre=centre + by)
            case Text(at=at, box=box, names=point):
                if box is not None:
                    dx, dy = by.real, by.imag
                    box = (box[0] + dx, box[1] + dy, box[2] + dx, box[3] + dy)
                point = None if point is None else point + by
                yield replace(item, at=at + by, box=box, names=point)


def placed(items: Iterable[Item], at: complex, angle: float) -> Iterator[Item]:
    """Yield the items turned about the origin by ``angle`` degrees, and moved by ``at`` mm."""
    turn = rect(1.0, radians(angle))
    for item in items:
        match item:
            case Stroke(points=points):
                yield replace(item, points=tuple(at + point * turn for point in points))
            case Fill(points=points):
                yield replace(item, points=tuple(at + point * turn for point in points))
            case Arc(centre=centre, start=start, end=end):
                by = radians(angle)
                yield replace(item, centre=at + centre * turn, start=start + by, end=end + by)
            case Disc(centre=centre):
                yield replace(item, centre=at + centre * turn)
            case Text(names=point):
                point = None if point is None else at + point * turn
                yield replace(item, at=at + item.at * turn, angle=item.angle + angle, names=point)


# GOST 2.304-81, clause 2.1: heights of capitals; 1.8 only for type B.
HEIGHTS = (1.8, 2.5, 3.5, 5.0, 7.0, 10.0, 14.0, 20.0, 28.0, 40.0)


# A bend sharper than this is a corner, where GOST 2.303 wants strokes to meet.
_CORNER = radians(20.0)


def dash_spans(
    length: float, dashes: Dashes, *, closed: bool = False
) -> tuple[tuple[float, float], ...]:
    """Divide a line of ``length`` mm into strokes.

    Parameters
    ----------
    length
        Length of the line, mm.
    dashes
        The pattern aimed at.
    closed
        The line returns to its start: the last gap then meets the first stroke.

    Returns
    -------
    tuple of (float, float)
        Start and end of each stroke along the line, mm. An open line starts and ends with a whole
        stroke; a line too short for two strokes is solid (so are centre lines of small circles).
    """
    if length <= 0.0:
        return ()
    open_end = 0 if closed else 1
    gaps = round((length - open_end * dashes.stroke) / (dashes.stroke + dashes.gap))
    most = int((length - open_end * dashes.min_stroke) / (dashes.gap + dashes.min_stroke) + 1e-9)
    # A line that has room for two strokes shows what it is.
    gaps = min(max(gaps, open_end), most)
    if gaps < 1:
        return ((0.0, length),)
    stroke = (length - gaps * dashes.gap) / (gaps + open_end)
    spans: list[tuple[float, float]] = []
    for index in range(gaps + open_end):
        start = index * (stroke + dashes.gap)
        spans.append((start, start + stroke))
        if index < gaps:
            reached = start + stroke
            spans += [(reached + a, reached + b) for a, b in dashes.inside]
    if not closed:
        spans[-1] = (spans[-1][0], length)
    return tuple(spans)


def dashed(
    points: Sequence[complex], pattern: Dashes, *, closed: bool = False
) -> list[tuple[complex, ...]]:
    """Cut a polyline into strokes.

    Every sharp corner is drawn by strokes that meet in it, so each side between two corners is
    divided by itself; the bends of a smooth curve are passed over.

    Parameters
    ----------
    points
        The polyline, mm.
    pattern
        The pattern aimed at.
    closed
        The last point is joined to the first.

    Returns
    -------
    list of tuple of complex
        The strokes as open polylines, in order; none for a line without length.
    """
    line = [point for k, point in enumerate(points) if k == 0 or point != points[k - 1]]
    if closed and len(line) > 1 and line[-1] == line[0]:
        line.pop()
    if len(line) < 2:
        return []
    if closed:
        first = next((k for k in range(len(line)) if _is_corner(line, k)), None)
        if first is None:
            return _cut([*line, line[0]], pattern, closed=True)
        line = [*line[first:], *line[: first + 1]]
    corners = [k for k in range(1, len(line) - 1) if _is_corner(line, k)]
    strokes: list[tuple[complex, ...]] = []
    for start, end in pairwise([0, *corners, len(line) - 1]):
        pieces = _cut(line[start : end + 1], pattern, closed=False)
        if strokes:
            # One stroke round the corner, so that the corner itself is joined and not notched.
            pieces[0] = strokes.pop() + pieces[0][1:]
        strokes += pieces
    return strokes


def _is_corner(line: Sequence[complex], k: int) -> bool:
    before, after = line[k] - line[k - 1], line[(k + 1) % len(line)] - line[k]
    return abs(phase(after / before)) > _CORNER


def _cut(line: Sequence[complex], pattern: Dashes, *, closed: bool) -> list[tuple[complex, ...]]:
    """Divide a polyline by its length alone; ``closed``: its last point is its first."""
    marks = [0.0, *accumulate(abs(b - a) for a, b in pairwise(line))]

    def at(distance: float) -> complex:
        k = min(bisect_right(marks, distance), len(marks) - 1)
        part = (distance - marks[k - 1]) / (marks[k] - marks[k - 1])
        return line[k] if part > 1.0 - 1e-12 else line[k - 1] + (line[k] - line[k - 1]) * part

    def piece(start: float, end: float) -> tuple[complex, ...]:
        bends = line[bisect_right(marks, start + 1e-9) : bisect_right(marks, end - 1e-9)]
        return (at(start), *bends, at(end))

    return [piece(start, end) for start, end in dash_spans(marks[-1], pattern, closed=closed)]


def area_colour(item: Fill | Disc, pens: PenSet) -> tuple[int, int, int]:
    """Return the colour of an area: red, green, blue from 0 to 255."""
    if item.ink is Ink.WHITE:
        return 255, 255, 255
    return pens.colour(item.pen if isinstance(item, Fill) else Pen.MAIN)


def sweep(arc: Arc) -> float:
    """Return the angle that the arc covers counter-clockwise, radians, at most a full turn."""
    turn = arc.end - arc.start
    if abs(turn) >= tau - 1e-9:
        return tau
    return turn % tau


def stroke_lines(stroke: Stroke) -> list[tuple[complex, ...]]:
    """Return the lines that the pen of ``stroke`` leaves on the paper, in order.

    The pieces of a dashed line are open. A solid line is returned unchanged, still to be closed if
    ``stroke.closed``, so that its last corner is joined like the others: see `closes`.
    """
    dashes = PENS[stroke.pen].dashes
    if dashes is None:
        return [stroke.points]
    return dashed(stroke.points, dashes, closed=stroke.closed)


def closes(stroke: Stroke) -> bool:
    """Return whether the one piece of `stroke_lines` is to be closed."""
    return stroke.closed and PENS[stroke.pen].dashes is None


def arc_spans(arc: Arc) -> list[tuple[float, float]]:
    """Return start and sweep (radians) of every piece that the pen of ``arc`` leaves."""
    turn = sweep(arc)
    dashes = PENS[arc.pen].dashes
    if dashes is None or arc.radius <= 0.0:
        return [(arc.start, turn)] if turn > 0.0 and arc.radius > 0.0 else []
    spans = dash_spans(turn * arc.radius, dashes, closed=turn >= tau)
    return [(arc.start + a / arc.radius, (b - a) / arc.radius) for a, b in spans]
