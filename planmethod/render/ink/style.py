"""Widths, dashes, letter heights and arrows by meaning: the drafting standards as data.

A number marked [mem] was taken from memory and not from the text of the standard: to correct it,
correct it here. All lengths are millimetres of paper.
"""

from __future__ import annotations

from bisect import bisect_right
from cmath import phase
from collections.abc import Mapping, Sequence
from itertools import accumulate, pairwise
from math import radians, tau
from types import MappingProxyType
from typing import Literal

from msgspec import Struct

from planmethod.render.ink.drawing import Arc, Pen, Stroke


class Dashes(Struct, frozen=True):
    """Dash pattern: stroke, gap, and for a dash-dot line the dots evenly in the gap.

    ``stroke`` is the length aimed at; the strokes of one line are equal, stretched or shrunk (to
    ``min_stroke`` at most) so that the line starts and ends with a stroke. ``gap`` is the whole gap
    between two strokes, ``dot`` the length of the short strokes inside it, ``dots`` their number.
    """

    stroke: float
    min_stroke: float
    gap: float
    dot: float = 0.0
    dots: int = 1

    @property
    def inside(self) -> tuple[tuple[float, float], ...]:
        """Start and end of each dot from the end of the stroke before it, mm."""
        if not self.dot:
            return ()
        white = (self.gap - self.dots * self.dot) / (self.dots + 1)
        starts = [white + k * (white + self.dot) for k in range(self.dots)]
        return tuple((start, start + self.dot) for start in starts)

    @property
    def period(self) -> tuple[float, ...]:
        """Lengths of one period, mm: strokes and dots positive, whites negative."""
        parts, reached = [self.stroke], 0.0
        for start, end in self.inside:
            parts += [reached - start, end - start]
            reached = end
        return (*parts, reached - self.gap)


class PenStyle(Struct, frozen=True):
    """Style of a pen: width in mm, dashes, grey from 0 (black) to 1 (white), line ends."""

    width: float
    dashes: Dashes | None = None
    grey: float = 0.0
    cap: Literal["round", "butt"] = "round"


# GOST 2.303: s is 0.5..1.4, on training drawings 0.8..1.0; thin lines are s/3..s/2, and lines of
# one type have one width on the whole sheet.
S = 0.8
_THIN_WIDTH = 0.3
_MEDIUM_WIDTH = 0.5

PENS: Mapping[Pen, PenStyle] = MappingProxyType(
    {
        Pen.MAIN: PenStyle(S),
        Pen.THIN: PenStyle(_THIN_WIDTH),
        # GOST 2.301, 2.104: frame and outline of the title block are solid main lines.
        Pen.FRAME: PenStyle(S, cap="butt"),
        # GOST 2.303, dash-dot thin: strokes 5..30, 3..5 between them [mem].
        Pen.AXIS: PenStyle(
            _THIN_WIDTH, Dashes(stroke=12.0, min_stroke=5.0, gap=4.0, dot=1.0), cap="butt"
        ),
        # GOST 2.303, dash-dot thick: width s/2..2s/3, strokes 3..8, 3..4 between them [mem].
        Pen.THICK_AXIS: PenStyle(
            _MEDIUM_WIDTH, Dashes(stroke=5.5, min_stroke=3.0, gap=3.5, dot=1.0), cap="butt"
        ),
        # GOST 2.303, dash-dot with two dots: strokes 5..30, 4..6 between them [mem].
        Pen.PHANTOM: PenStyle(
            _THIN_WIDTH, Dashes(stroke=12.0, min_stroke=5.0, gap=5.0, dot=1.0, dots=2), cap="butt"
        ),
        # GOST 2.303, dashed: width s/3..s/2, strokes 2..8, gaps 1..2 [mem].
        Pen.HIDDEN: PenStyle(_THIN_WIDTH, Dashes(stroke=4.0, min_stroke=2.0, gap=1.5), cap="butt"),
        # GOST 2.303: hatching is a solid thin line.
        Pen.HATCH: PenStyle(_THIN_WIDTH, cap="butt"),
        # GOST 2.303: a break is a thin line by hand; its waves are drawn, not dashed.
        Pen.BREAK: PenStyle(_THIN_WIDTH),
        # The standard knows no grey: thin lines set back so that the main position is prominent.
        Pen.PALE: PenStyle(_THIN_WIDTH, grey=0.5),
    }
)

# GOST 2.304-81, clause 2.1: heights of capitals; 1.8 only for type B.
HEIGHTS = (1.8, 2.5, 3.5, 5.0, 7.0, 10.0, 14.0, 20.0, 28.0, 40.0)


# A bend sharper than this is a corner, where GOST 2.303 wants strokes to meet.
_CORNER = radians(20.0)


class ArrowStyle(Struct, frozen=True):
    """Swept arrowhead: ``notch`` is the depth of the cut in its back along the shaft.

    There is one shape: the width of an arrowhead is proportional to its length.
    """

    length: float
    width: float
    notch: float


# GOST 2.307: the arrow follows s; 5..7 mm long on training drawings. Its sides are at about 20°,
# and it is more than twice as wide as the main line that it ends.
ARROW = ArrowStyle(length=5.0, width=1.9, notch=1.0)


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
