"""A force plan as a draughtsman draws it: the polygon with arrows and letters (план сил)."""

from __future__ import annotations

from planmethod.note.numbers import Notation
from planmethod.plans.forces.polygons import Component, Edge
from planmethod.render.forces.arrows import FORCE_LABEL_STYLE, Segment, distance
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen
from planmethod.render.ink.typeset import typeset, vector_markup
from planmethod.render.labels import Label
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.ellipses import Ellipses
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import PLAN_FORCE, unit, vector_arrow
from planmethod.solved.forces.reading import ForceReading
from planmethod.solved.reading import memoized

START = "start of a force plan"
"""Tag of the disc where the construction of a plan begins: one for each plan."""

NO_ELLIPSES = Ellipses()

_MIN_LENGTH = 0.3
"""Shortest segment that is drawn, mm."""


def start_place(reading: ForceReading, number: int) -> complex:
    """Return where the construction of a plan begins, mm: the first forces are laid off there."""
    starts = reading.statics.board.starts
    ends = (end for edge in reading.plans[number].polygon for end in (edge.tail, edge.head))
    return reading.corner(number, next(end for end in ends if end in starts))


def drawn_edges(reading: ForceReading, number: int) -> list[Edge]:
    """Return the segments of a force plan that are drawn: polygon, resultants, inner reaction.

    Resultants and the inner reaction are drawn only if no side of the polygon shows them.
    """
    plan = reading.plans[number]
    result: list[Edge] = []
    ends: set[frozenset[complex]] = set()
    others = [*reading.wholes(plan), *reading.inner(plan)]
    for edge, is_side in (*((e, True) for e in reading.shown(plan)), *((e, False) for e in others)):
        places = frozenset(_rounded(reading.corner(number, end)) for end in (edge.tail, edge.head))
        if abs(reading.drawn(number, edge)) >= _MIN_LENGTH and (is_side or places not in ends):
            ends.add(places)
            result.append(edge)
    return result


def _rounded(place: complex) -> complex:
    return complex(round(place.real, 3), round(place.imag, 3))


def _written(reading: ForceReading, number: int, edge: Edge, notation: Notation) -> str:
    """Return the inscription of a segment: all reactions that it shows.

    A component may be the whole reaction; the inner reaction may be the same line.
    """
    plan = reading.plans[number]
    others = [*plan.wholes, *plan.inner]
    written = [vector_markup(notation.symbol(edge.symbol))]
    tail, head = reading.corner(number, edge.tail), reading.corner(number, edge.head)
    for other in others:
        ends = reading.corner(number, other.tail), reading.corner(number, other.head)
        if other.symbol == edge.symbol:
            continue
        if max(abs(ends[0] - tail), abs(ends[1] - head)) < 1e-3:
            written.append(vector_markup(other.symbol))
        elif max(abs(ends[0] - head), abs(ends[1] - tail)) < 1e-3:
            written.append(f"−{vector_markup(other.symbol)}")
    return " = ".join(written)


def find_overlap_shifts(reading: ForceReading, number: int) -> list[complex]:
    """Return the offsets at which the segments of a plan are drawn beside their places, mm.

    Overlapping segments would hide each other's heads.
    """
    placed: list[Segment] = []
    shifts: list[complex] = []
    for edge in drawn_edges(reading, number):
        tail, head = reading.corner(number, edge.tail), reading.corner(number, edge.head)
        along = unit(head - tail)
        across = 1j * (along if (along.imag, along.real) > (0.0, 0.0) else -along)
        for step in (0, 1, -1, 2, -2, 3, -3):
            shift = step * _SPACING * across
            if not any(_hides((tail + shift, head + shift), other) for other in placed):
                break
        placed.append((tail + shift, head + shift))
        shifts.append(shift)
    return shifts


_SPACING = 1.8
_HIDES = 0.3
"""Between segments drawn beside one another; between those that hide one another, mm."""


def _hides(one: Segment, second: Segment) -> bool:
    """Return whether two segments overlap along more than a point."""
    short, long = sorted((one, second), key=lambda part: abs(part[1] - part[0]))
    places = [short[0] + (short[1] - short[0]) * k / 8 for k in range(9)]
    return sum(distance(place, long) < _HIDES for place in places) > 2


@memoized
def polygon_picture(
    reading: ForceReading,
    number: int,
    letter_height: float,
    notation: Notation,
    ellipses: Ellipses = NO_ELLIPSES,
) -> Picture:
    """Return the force plan of a group or of the driver, its first point at the origin, mm."""
    edges, shifts = drawn_edges(reading, number), find_overlap_shifts(reading, number)
    items: list[Item] = list(ellipses.strokes)
    labels: list[Label] = []
    ends = [reading.corner(number, end) for edge in edges for end in (edge.tail, edge.head)] or [0j]
    centre = sum(ends) / len(ends)
    for k, (edge, shift) in enumerate(zip(edges, shifts, strict=True)):
        tail, head = (
            reading.corner(number, edge.tail) + shift,
            reading.corner(number, edge.head) + shift,
        )
        thin = edge.component is not Component.TOTAL
        pen = Pen.THIN if thin else Pen.MAIN
        symbol = notation.symbol(edge.symbol)
        items += vector_arrow(tail, head, pen=pen, length=4.0, tag=f"{PLAN_FORCE} {symbol}")
        labels.append(
            Label(
                typeset(_written(reading, number, edge, notation), letter_height),
                (tail + head) / 2,
                (tail, head),
                prefer=(tail + head) / 2 - centre,
                gap=1.0,
                name=f"plan {reading.index} {number} {k}: {symbol}",
                style=FORCE_LABEL_STYLE,
            )
        )
    items.append(Disc(start_place(reading, number), 0.7, Ink.BLACK, tag=START))
    return lettered(items, labels, clear=ellipses.grounds)
