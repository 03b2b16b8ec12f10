"""Axes and breaks (осевые, центровые линии и линии обрыва): lines whose dashes meet correctly.

GOST 2.303: a dash-dot line begins, ends and is crossed with a stroke, and the centre lines of a
circle below 12 mm are solid thin lines.
"""

from __future__ import annotations

import cmath
from itertools import pairwise
from math import ceil, pi, sin, tau

from planmethod.render.ink.drawing import Arc, Item, Pen, Stroke
from planmethod.render.ink.style import PENS, dash_spans
from planmethod.render.symbols.sizes import unit

SMALL_CIRCLE = 12.0
"""Diameter below which centre lines are solid (GOST 2.303), mm."""

_EXTENSIONS = (3.0, 2.5, 3.5, 2.0, 4.0, 4.5, 5.0)
"""Extensions of centre lines beyond their circle, mm, the best first: 2 to 5 [mem]."""

_SURE = 1.0  # mm: least distance of a crossing from the ends of its stroke


def axis_line(start: complex, end: complex, *through: complex, tag: str = "") -> list[Item]:
    """Return a dash-dot line that others cross at ``through`` in a stroke (осевая линия).

    Where the pattern has a gap in one of these places, the line is drawn in parts that begin and
    end there. A line too short for two strokes is solid and thin.
    """
    length = abs(end - start)
    if not _shows(length):
        return [Stroke((start, end), Pen.THIN, tag=tag)]
    if all(_in_a_stroke(length, abs(place - start)) for place in through):
        return [Stroke((start, end), Pen.AXIS, tag=tag)]
    stops = sorted((start, *through, end), key=lambda place: abs(place - start))
    return [
        Stroke(pair, Pen.AXIS if _shows(abs(pair[1] - pair[0])) else Pen.THIN, tag=tag)
        for pair in pairwise(stops)
        if abs(pair[1] - pair[0]) > 1e-6
    ]


def _shows(length: float) -> bool:
    """Return whether a dash-dot line is long enough to look like one."""
    dashes = PENS[Pen.AXIS].dashes
    assert dashes is not None
    return len(dash_spans(length, dashes)) > 1


def _in_a_stroke(length: float, place: float) -> bool:
    dashes = PENS[Pen.AXIS].dashes
    assert dashes is not None
    return any(
        a + _SURE <= place <= b - _SURE
        for a, b in dash_spans(length, dashes)
        if b - a > dashes.dot + 1e-9
    )


def centre_lines(
    centre: complex, radius: float, *, directions: tuple[complex, ...] = (1 + 0j, 1j), tag: str = ""
) -> list[Item]:
    """Return the lines that cross in the centre of a circle (центровые линии).

    They extend 2 to 5 mm beyond it, so that they cross by strokes; those of a circle below 12 mm
    are solid, and so are those of a circle too small for two dash-dot halves.
    """
    items: list[Item] = []
    over = next((x for x in _EXTENSIONS if _in_a_stroke(2 * (radius + x), radius + x)), None)
    if over is None:
        over = next((x for x in _EXTENSIONS if _shows(radius + x)), None)
    is_small = 2 * radius < SMALL_CIRCLE or over is None
    for direction in directions:
        reach = unit(direction) * (radius + (_EXTENSIONS[0] if over is None else over))
        if is_small:
            items.append(Stroke((centre - reach, centre + reach), Pen.THIN, tag=tag))
        else:
            items += axis_line(centre - reach, centre + reach, centre, tag=tag)
    return items


def pitch_circle(
    centre: complex, radius: float, *, touch: complex | None = None, tag: str = ""
) -> list[Item]:
    """Return a dash-dot circle, with a stroke in its middle where it is touched (окружность).

    ``touch`` is the point where another circle or line meets it, mm.
    """
    if 2 * radius < SMALL_CIRCLE:
        return [Arc(centre, radius, pen=Pen.THIN, tag=tag)]
    dashes = PENS[Pen.AXIS].dashes
    assert dashes is not None
    start = 0.0 if touch is None else cmath.phase(touch - centre)
    stroke = dash_spans(tau * radius, dashes, closed=True)[0]
    start -= (stroke[1] - stroke[0]) / 2 / radius
    return [Arc(centre, radius, start, start + tau, Pen.AXIS, tag)]


def wavy_line(start: complex, end: complex, *, wave: float = 6.0, tag: str = "") -> list[Item]:
    """Return a line of break drawn by hand (волнистая линия); ``wave`` is its length, mm.

    The waves differ to imitate a hand, always in the same way.
    """
    length, along = abs(end - start), unit(end - start)
    count = max(1, round(length / wave))
    steps = 12 * count
    points = []
    for k in range(steps + 1):
        t = k / steps
        height = 0.14 * wave * sin(tau * count * t) * (1.0 + 0.35 * sin(5.1 * count * t + 1.0))
        points.append(
            start + along * (length * t + 1j * height * sin(pi * min(1, 8 * t, 8 - 8 * t) / 2))
        )
    return [Stroke(tuple(points), Pen.BREAK, tag=tag)]


def kinked_line(start: complex, end: complex, *, kink: float = 5.0, tag: str = "") -> list[Item]:
    """Return a long line of break, straight with kinks (сплошная тонкая с изломами).

    ``kink`` is the height of a kink, mm; there is one for each 60 mm.
    """
    length, along = abs(end - start), unit(end - start)
    count = max(1, ceil(length / 60.0 - 1e-9))
    points = [start]
    for k in range(count):
        middle = start + along * length * (k + 0.5) / count
        shape = (-kink * 0.35, -kink * 0.15 + 0.5j * kink, kink * 0.15 - 0.5j * kink, kink * 0.35)
        points += [middle + along * z for z in shape]
    return [Stroke((*points, end), Pen.BREAK, tag=tag)]
