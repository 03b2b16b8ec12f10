"""Scheme of a train along its axes: pitch circles to scale, senses of rotation (вид вдоль оси)."""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping
from math import asin, cos, radians, sin

from planmethod.gears.model import MeshKind
from planmethod.gears.scheme import Rim, Scheme
from planmethod.render.ink.drawing import Arc, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import SIZES, link, revolute, turn_arrow
from planmethod.render.symbols.axes import axis_line, centre_lines, pitch_circle
from planmethod.render.symbols.gears import rack_front

ARROW_INSIDE = 3.0
"""From a pitch circle to the arrow of its sense, mm."""

SWEEP = 14.0
"""Length of such an arrow, mm."""

RACK_BEYOND = 8.0
"""How far a rack goes beyond its wheel, mm."""

_ANGLES = (205.0, 330.0, 155.0, 25.0, 240.0, 300.0, 180.0, 0.0)
"""Where the arrows stand, degrees, one wheel after another: off the line of centres."""


def front(scheme: Scheme, height: float) -> Picture:
    """Return the view along the axes; letters are ``height`` mm high."""
    items: list[Item] = []
    labels: list[Label] = []
    rims = {rim.label: rim for column in scheme.columns for rim in column}
    for number, rim in enumerate(sorted(rims.values(), key=lambda rim: -rim.radius)):
        items += _wheel(rim)
        angle = _ANGLES[number % len(_ANGLES)]
        items += _sense(scheme, rim, angle)
        rim_at = 1j * rim.centre + cmath.rect(rim.radius, radians(angle + 22.0))
        way = cmath.rect(1.0, radians(angle + 22.0)) * (1 if rim.ring else -1)
        name = f"front {rim.label}"
        labels.append(
            Label(typeset(rim.label, height), rim_at, prefer=way, gap=1.2, name=name, manner=BUSY)
        )
    for body, carrier in scheme.over.items():
        ends = (1j * scheme.heights[carrier], 1j * scheme.heights[body])
        items += link(*ends, tag=f"link {carrier}")
        labels.append(
            Label(typeset(carrier, height), (ends[0] + ends[1]) / 2, prefer=1, gap=1.2,
                  name=f"front {carrier} {body}", manner=BUSY)
        )  # fmt: skip
    items += _straight(scheme, rims)
    levels = {round(rim.centre, 6) for rim in rims.values()}
    beyond = [rim.centre + way * (_rim(rim) + 4.0) for rim in rims.values() for way in (1, -1)]
    items += axis_line(1j * min(beyond), 1j * max(beyond), *(1j * level for level in levels))
    for level in sorted(levels):
        items += revolute(1j * level)
    unique = {label.inscription.markup: label for label in labels}
    return lettered(items, list(unique.values()))


def _straight(scheme: Scheme, rims: Mapping[str, Rim]) -> Iterator[Item]:
    """Yield belts and chains from circle to circle, and racks."""
    for mesh in scheme.motion.train.meshes:
        one, other = rims.get(mesh.first), rims.get(mesh.second)
        if mesh.kind is MeshKind.RACK and one is not None:
            at, half = 1j * (one.centre - one.radius), one.radius + RACK_BEYOND
            yield from rack_front(at - half, at + half)
        if mesh.kind not in (MeshKind.BELT, MeshKind.CROSSED, MeshKind.CHAIN):
            continue
        if one is None or other is None:
            continue
        apart = other.centre - one.centre
        crossed = -1 if mesh.kind is MeshKind.CROSSED else 1
        lean = asin((one.radius - crossed * other.radius) / apart)
        for side in (1, -1):
            out = complex(side * cos(lean), sin(lean))
            ends = (
                1j * one.centre + out * one.radius,
                1j * other.centre + out * crossed * other.radius,
            )
            yield Stroke(ends, Pen.THIN, tag="belt")


def _wheel(rim: Rim) -> Iterator[Item]:
    centre = 1j * rim.centre
    touch = centre + 1j * rim.ways[0] * rim.radius
    yield from pitch_circle(centre, rim.radius, touch=touch)
    if rim.ring:
        yield Arc(centre, _rim(rim))
    yield from centre_lines(centre, _rim(rim), directions=(1 + 0j,))


def _rim(rim: Rim) -> float:
    """Return the radius of the rim of a wheel: outside the pitch circle of one with inner teeth."""
    return rim.radius + (SIZES.slider_width / 2 if rim.ring else 0.0)


def _sense(scheme: Scheme, rim: Rim, angle: float) -> list[Item]:
    """Return the arrow of a wheel's sense, none of one that stands."""
    speed = scheme.motion.speeds[rim.body]
    radius = rim.radius - ARROW_INSIDE
    if not speed or radius < 4.0:
        return []
    sweep = min(150.0, 180.0 / cmath.pi * SWEEP / radius)
    sense = 1 if speed > 0 else -1
    return turn_arrow(
        1j * rim.centre, radius, sense, middle=angle, sweep=sweep, pen=Pen.THIN, tag="sense"
    )
