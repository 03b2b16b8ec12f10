"""Shapes that a DXF has as one entity: arrowheads with shafts, smooth lines, dimensions."""

from __future__ import annotations

from cmath import exp, phase, rect
from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import acos, ceil, degrees, pi, radians, tau
from typing import Any

from msgspec import Struct, field

from planmethod.render.backends.dxf_texts import phrase_of
from planmethod.render.ink.drawing import Arc, Fill, Stroke, Text
from planmethod.render.ink.pens import ARROW
from planmethod.render.ink.typeset import text_corners

_TOLERANCE = 2e-3  # mm: how far a polygon may leave the curve that it replaces
_SMOOTH = radians(20.0)


def pairs(points: Iterable[complex]) -> list[tuple[float, float]]:
    """Return points as pairs of coordinates."""
    return [(point.real, point.imag) for point in points]


def add_arc(space: Any, item: Arc, turn: float, attributes: dict[str, Any]) -> None:
    """Add an arc of ``turn`` radians, or a circle, to a space."""
    centre = (item.centre.real, item.centre.imag)
    if turn >= tau:
        space.add_circle(centre, item.radius, dxfattribs=attributes)
    else:
        ends = degrees(item.start) % 360.0, degrees(item.start + turn) % 360.0
        space.add_arc(centre, item.radius, *ends, dxfattribs=attributes)


def circle(centre: complex, radius: float) -> list[complex]:
    """Return a polygon that stays within 2 µm of a circle."""
    count = max(24, ceil(pi / acos(max(0.0, 1.0 - _TOLERANCE / radius))))
    return [centre + radius * exp(1j * tau * k / count) for k in range(count)]


def is_smooth(points: Sequence[complex]) -> bool:
    """Return whether a polyline has no corners."""
    steps = [b - a for a, b in pairwise(points) if a != b]
    return all(abs(phase(after / before)) < _SMOOTH for before, after in pairwise(steps))


def arrowhead_of(points: Sequence[complex]) -> tuple[complex, complex, float, float] | None:
    """Return tip, direction, length and width if the polygon is an arrowhead, else None."""
    if len(points) != 4:
        return None
    tip, left, notch, right = points
    middle = (left + right) / 2.0
    length, width = abs(tip - middle), abs(left - right)
    if length < 1e-6 or width < 1e-6:
        return None
    along = (tip - middle) / length
    straight = abs(left - middle - along * 1j * width / 2.0)
    cut = abs(tip - along * length * (1.0 - ARROW.notch) - notch)
    return (tip, along, length, width) if max(straight, cut) < 1e-6 else None


def leads(shaft: Stroke, tip: complex, direction: complex, length: float) -> bool:
    """Return whether a line runs into the arrowhead that ends at ``tip``."""
    start, stop = shaft.points
    ahead = [(tip - point) / direction for point in (start, stop)]
    return all(abs(direction.imag) < 1e-6 for direction in ahead) and (
        ahead[0].real > ahead[1].real and 0.0 <= ahead[1].real <= length
    )


class Dimension(Struct):
    """Lines, heads and letters of one dimension, in the order of the drawing (размер)."""

    tag: str
    lines: list[Stroke | Arc | Fill] = field(default_factory=list)
    letters: list[Text] = field(default_factory=list)

    def measured(self) -> dict[str, Any] | None:
        """Return the attributes of its DIMENSION: what it measures, by its shape, and its text.

        An arc is that of an angle; one head, that of a radius. Two heads are those of a diameter
        where no extension lines lead to them and the letter is that of one; otherwise they are
        those of a linear dimension. None without any.
        """
        tips = [item.points[0] for item in self.lines if isinstance(item, Fill)]
        arcs = [item for item in self.lines if isinstance(item, Arc)]
        strokes = [item for item in self.lines if isinstance(item, Stroke)]
        more: dict[str, Any] = {}
        if arcs:
            (arc, *_) = arcs
            at = [arc.centre + rect(arc.radius, turn) for turn in (arc.start, arc.end)]
            middle = arc.centre + rect(arc.radius, (arc.start + arc.end) / 2)
            kind, places = _ANGULAR, (middle, *(tips if len(tips) == 2 else at), arc.centre)
        elif len(tips) == 1 and strokes:
            centre = max((end for s in strokes for end in s.points), key=lambda z: abs(z - tips[0]))
            kind, places = _RADIAL, (centre, 0j, 0j, tips[0])
        elif len(tips) == 2 and abs(tips[1] - tips[0]) > 1e-6:
            direction = (tips[1] - tips[0]) / abs(tips[1] - tips[0])
            sides = [
                s for s in strokes if abs(((s.points[-1] - s.points[0]) / direction).imag) > 1e-3
            ]
            feet = [_start_of_extension(tip, direction, sides) for tip in tips]
            is_diameter = not sides and self.letters and self.letters[0].text[:1] in "dDØ⌀"
            kind = _DIAMETRAL if is_diameter else _LINEAR
            places = (tips[0], 0j, 0j, tips[1]) if is_diameter else (tips[1], *feet, 0j)
            more = {} if is_diameter else {"angle": degrees(phase(direction)) % 180.0}
        else:
            return None
        names = {
            _LINEAR: ("", "2", "3"), _ANGULAR: ("", "2", "3", "4"),
            _RADIAL: ("", None, None, "4"), _DIAMETRAL: ("", None, None, "4"),
        }  # fmt: skip
        said = {
            f"defpoint{name}": (at.real, at.imag)
            for name, at in zip(names[kind], places, strict=False)
            if name is not None
        }
        if self.letters:
            corners = [corner for run in self.letters for corner in text_corners(run)]
            middle = sum(corners) / len(corners)
            said["text_midpoint"] = (middle.real, middle.imag)
            more["text"] = phrase_of(self.letters)
        return {**said, **more, "dimtype": kind | _OWN_BLOCK | _PLACED}


_LINEAR, _DIAMETRAL, _RADIAL, _ANGULAR = 0, 3, 4, 5
_OWN_BLOCK, _PLACED = 32, 128  # flags of a dimension: a block of its own, a text placed by hand


def _start_of_extension(tip: complex, direction: complex, sides: Sequence[Stroke]) -> complex:
    """Return the start of the extension line that leads to a head; its tip without a line."""
    ends = [
        max(side.points, key=lambda end: abs(end - tip))
        for side in sides
        if abs(((side.points[0] - tip) / direction).real) < 1e-3
    ]
    return ends[0] if ends else tip
