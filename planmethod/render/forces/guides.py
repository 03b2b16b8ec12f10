"""Reactions of the guides drawn where they act: at their distance, or at the edges (направляющие).

A force across a guide and a moment are drawn as their resultant, with its distance from the joint;
where a slider does not reach so far, as two forces at its edges.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence

from msgspec import Struct

from planmethod.plans.model import PlanKind
from planmethod.problem.model import Slide
from planmethod.render.forces.arrows import Acting, Segment, distance
from planmethod.render.ink.drawing import Disc, Ink, Item
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import Label
from planmethod.render.symbols import SIZES, dimension, unit
from planmethod.solved.forces.guides import Guided, guides
from planmethod.solved.forces.reading import ForceReading
from planmethod.solved.solution import Solution

MAX_DISTANCE = 45.0
"""Distance from its joint up to which a reaction is drawn where it acts, mm."""

POINT = "point of a reaction"
"""Tag of the disc at such a place."""

DIMENSION = "dimension"
"""First word of the tags of dimensions; the second is the letter."""

_SHORTEST = 8.0  # of a slider that is drawn to scale, mm
_MIN_DIMENSION = 1.5  # mm: a distance below it is not dimensioned
_LEVELS = (9.0, 14.0, 19.0, 25.0, 31.0)  # from the guide to a dimension line, mm
_CLEAR = 2.5  # mm: a closer dimension line crowds a line of the drawing


def drawn_length(solution: Solution, slide: Slide, factor: float) -> float:
    """Return the drawn length of a slider, mm: to scale if it looks like one, else the symbol's."""
    if slide.length is not None:
        true = slide.length / solution.scales[PlanKind.POSITION].per_mm
        if _SHORTEST <= true <= 2 * MAX_DISTANCE:
            return true
    return SIZES.slider_length * factor


class DimensionSpan(Struct, frozen=True):
    """Distance to be dimensioned: its letter, and its ends on the guide, mm."""

    symbol: str
    start: complex
    end: complex


class Pressed(Struct, frozen=True):
    """Reaction of a guide as it is drawn, in place of a force at the joint and a couple.

    Attributes
    ----------
    replaced : frozenset of str
        Letters of the force and of the couple.
    forces : tuple of Acting
    points : tuple of complex, mm
        Where they act.
    span : DimensionSpan or None
    """

    replaced: frozenset[str]
    forces: tuple[Acting, ...]
    points: tuple[complex, ...]
    span: DimensionSpan | None


def pressed(
    reading: ForceReading, links: Collection[str], bars: Sequence[Segment], factor: float
) -> list[Pressed]:
    """Return the reactions of the guides, on links cut free, that do not act in their joints.

    A reaction that acts too far away to be drawn there is left out, and so is a couple whose slider
    has no known edges: both stay a force and a couple.
    """
    found = []
    for guided in guides(reading).values():
        if guided.on in links and guided.by not in links and not guided.is_no_couple:
            one = _at_edges(guided, factor) or _at_point(guided, bars, factor)
            found += [] if one is None else [one]
    return found


def _origin(guided: Guided) -> complex:
    """Return the place from which distances along the guide count, mm.

    A slider is drawn at its pin; on the link that carries the line, at the foot of the pin.
    """
    reading, contact = guided.reading, guided.contact
    place = reading.place(guided.reaction.force.at)
    if guided.on == contact.slide.slider:
        return place
    line = complex(contact.direction[reading.index])
    arm = complex(contact.joint.at[reading.index] - contact.base[reading.index])
    off = (arm * line.conjugate()).imag / _per_mm(guided)
    return place - 1j * line * off


def _per_mm(guided: Guided) -> float:
    return guided.reading.solution.scales[PlanKind.POSITION].per_mm


def _replaced(guided: Guided) -> frozenset[str]:
    return frozenset(guided.symbol(letter) for letter in "FM")


def _face(factor: float) -> float:
    """Return the white between a place on the guide and an arrow at the face of the slider, mm."""
    return SIZES.slider_width / 2 * factor + 0.5


def _at_edges(guided: Guided, factor: float) -> Pressed | None:
    edges = guided.edges
    if not edges:
        return None
    reading, contact = guided.reading, guided.contact
    along = complex(contact.direction[reading.index])
    middle = float(contact.middle[reading.index]) / _per_mm(guided)
    half = drawn_length(reading.solution, contact.slide, factor) / 2
    places = tuple(_origin(guided) + along * (middle + side * half) for side in (1, -1))
    forces = tuple(
        Acting(guided.symbol("F", primes), place, edge.force, gap=_face(factor))
        for primes, place, edge in zip(("'", "''"), places, edges, strict=True)
    )
    span = DimensionSpan(guided.as_planned.symbol("a"), places[1], places[0])
    return Pressed(_replaced(guided), forces, places, span)


def _at_point(guided: Guided, bars: Sequence[Segment], factor: float) -> Pressed | None:
    if guided.b is None:
        return None
    reading, contact = guided.reading, guided.contact
    origin = _origin(guided)
    shift = guided.b / _per_mm(guided)
    place = origin + complex(contact.direction[reading.index]) * shift
    if abs(shift) > MAX_DISTANCE and all(distance(place, bar) > 1.0 for bar in bars):
        return None
    force = guided.sense * complex(contact.joint.force[reading.index])
    acting = Acting(guided.symbol("F"), place, force, gap=_face(factor))
    span = (
        DimensionSpan(guided.as_planned.symbol("l"), origin, place)
        if abs(shift) >= _MIN_DIMENSION
        else None
    )
    return Pressed(_replaced(guided), (acting,), (place,), span)


# Dimensions --------------------------------------------------------------------------------------


def point_items(ones: Iterable[Pressed], factor: float) -> list[Item]:
    """Return the marks where reactions act."""
    return [Disc(place, 0.7 * factor, Ink.BLACK, tag=POINT) for one in ones for place in one.points]


def span_dimension(
    span: DimensionSpan, lines: Sequence[Segment], height: float, prefix: str
) -> tuple[list[Item], Label]:
    """Return a dimension along a guide on its freer side, and its letter (размер).

    Parameters
    ----------
    lines : sequence of Segment
        Lines already drawn, which the dimension keeps clear of.
    """
    along = unit(span.end - span.start)
    out = min(
        (side * 1j * along * level for level in _LEVELS for side in (1, -1)),
        key=lambda out: _dimension_cost(span, out, lines),
    )
    start, end = span.start + out, span.end + out
    tag = f"{DIMENSION} {span.symbol}"
    items = dimension(span.start, span.end, out, gap=_face(1.0), tag=tag)
    label = Label(
        typeset(span.symbol, height),
        (start + end) / 2,
        (start, end),
        prefer=out,
        gap=0.8,
        priority=2,
        name=f"{prefix} dimension: {span.symbol}",
    )
    return items, label


def _dimension_cost(span: DimensionSpan, out: complex, lines: Iterable[Segment]) -> float:
    """Return the cost of a dimension line among other lines; a nearer one costs less."""
    start, end = span.start + out, span.end + out
    places = [start + (end - start) * k / 6 for k in range(-2, 9)]
    places += [foot + out * k / 4 for foot in (span.start, span.end) for k in (2, 3, 4)]
    near = sum(min(distance(p, line) for line in lines) < _CLEAR for p in places) if lines else 0
    return near + 0.1 * abs(out)
