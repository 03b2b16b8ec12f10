"""Pictures beside the side view: the view along the axes, velocity diagrams."""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import asin, cos, radians, sin

from msgspec import Struct

from planmethod.construct.steps import PointName
from planmethod.gears.construction import AXIS_FOOT, POLE, RAY_ORIGIN, GearDrawing, GearReading
from planmethod.gears.model import MeshKind
from planmethod.gears.motion import ContactKind, ContactPoint
from planmethod.gears.scheme import Rim, SchemeData
from planmethod.note.document import plain_text
from planmethod.plans.model import VectorKind
from planmethod.render.ink.drawing import Arc, Disc, Ink, Item, Pen, Span, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, NEAREST, Label
from planmethod.render.labels.label_column import label_merged_letters, merge_letters
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import (
    ENLARGED,
    clip_to_circle,
    detail_mark,
    lettered,
    placed_in,
    radius_of,
)
from planmethod.render.symbols import (
    SIZES,
    link,
    revolute,
    straight_arrow,
    turn_arrow,
    vector_arrow,
)
from planmethod.render.symbols.elements import rack_front
from planmethod.render.symbols.marks import axis_line, centre_lines, pitch_circle
from planmethod.solved.legibility import DetailView

ARROW_INSIDE = 3.0
"""From a pitch circle to the arrow of its sense, mm."""

SWEEP = 14.0
"""Length of such an arrow, mm."""

RACK_BEYOND = 8.0
"""Overhang of a rack beyond its wheel, mm."""

RACK_ARROW = 9j
"""From a pitch line down to the arrow of the rack's velocity, mm."""

_ANGLES = (205.0, 330.0, 155.0, 25.0, 240.0, 300.0, 180.0, 0.0)
"""Angles of the arrows, degrees, one wheel after another: off the line of centres."""

_LETTER_ANGLES = (30.0, -30.0, 60.0, -60.0, 90.0, -90.0, 120.0, -120.0, 150.0)
"""Angles by which the letter of a circle may move from its first place, degrees."""


VELOCITY = "velocity"
"""Tag of the velocities in the view along the axes."""


class PointVelocity(Struct, frozen=True):
    """A velocity in the view along the axes: its point, ``height`` and ``length``, mm.

    The height is from the main axis, the length to the right.
    """

    letter: str
    height: float
    length: float


def front(
    scheme: SchemeData,
    height: float,
    planets: Mapping[str, int],
    velocities: Iterable[PointVelocity] = (),
) -> Picture:
    """Return the view along the axes; letters are ``height`` mm high.

    ``planets`` is the number of evenly spaced sets on each carrier. Default: one. ``velocities``
    are drawn as vectors.
    """
    labels: list[Label] = []
    rims = {rim.label: rim for column in scheme.columns for rim in column}
    items = [
        item
        for level, radius in _outermost(rims.values())
        for item in centre_lines(1j * level, radius, directions=(1 + 0j,))
    ]
    for number, rim in enumerate(sorted(rims.values(), key=lambda rim: -rim.radius)):
        items += _wheel(rim)
        angle = _ANGLES[number % len(_ANGLES)]
        items += _sense(scheme, rim, angle)
        out = _lettered_at(rim, angle + 22.0, rims.values(), 1.2 * height)
        rim_at = 1j * rim.centre + rim.radius * out
        way = out * (1 if rim.ring else -1)
        name = f"front {rim.label}"
        labels.append(
            Label(typeset(rim.label, height), rim_at, prefer=way, gap=1.2, name=name, style=BUSY)
        )
    levels = {round(rim.centre, 6) for rim in rims.values()}
    for body, carrier in scheme.over.items():
        ends = (1j * scheme.heights[carrier], 1j * scheme.heights[body])
        items += link(*ends, tag=f"link {carrier}")
        places = [ends[0] + share * (ends[1] - ends[0]) for share in (0.5, 0.75, 0.25)]
        free = (p for p in places if min(abs(p.imag - y) for y in levels) > 2.0 * height)
        at = next(free, places[0])  # keep the letter of an arm off the axis of a wheel
        labels.append(
            Label(typeset(carrier, height), at, prefer=1, gap=1.2,
                  name=f"front {carrier} {body}", style=BUSY)
        )  # fmt: skip
    items += _straight(scheme, rims)
    labels += _rack_labels(scheme, rims, height)
    items += _around(scheme, rims, planets)
    beyond = [rim.centre + way * (_rim(rim) + 4.0) for rim in rims.values() for way in (1, -1)]
    items += axis_line(1j * min(beyond), 1j * max(beyond), *(1j * level for level in levels))
    for level in sorted(levels):
        items += revolute(1j * level)
    for one in velocities:
        at, head = 1j * one.height, 1j * one.height + one.length
        items += vector_arrow(at, head, tag=VELOCITY)
        if not one.letter.startswith("O"):
            items.append(Disc(at, 0.7, Ink.BLACK))
        side = 1 if one.length > 0 else -1
        for text, anchor, way in (
            (one.letter, at, -side + 0.6j),
            (f"v_{{{one.letter}}}", head, side + 0.4j),
        ):
            labels.append(Label(typeset(text, height), anchor, prefer=way, gap=1.4,
                                name=f"front {text}", style=BUSY))  # fmt: skip
    unique = {label.inscription.markup: label for label in labels}
    return lettered(items, list(unique.values()))


def _lettered_at(rim: Rim, angle: float, rims: Iterable[Rim], free: float) -> complex:
    """Return the direction in which a pitch circle is lettered: that of an angle, degrees.

    Where another circle is less than ``free`` mm from there, one farther from it is taken.
    """
    others = [one for one in rims if one is not rim]
    ways = [cmath.rect(1.0, radians(angle + turn)) for turn in (0.0, *_LETTER_ANGLES)]

    def clearance(out: complex) -> float:
        at = 1j * rim.centre + rim.radius * out
        gaps = (abs(abs(at - 1j * one.centre) - one.radius) for one in others)
        return min(gaps, default=free)

    return next((out for out in ways if clearance(out) >= free), max(ways, key=clearance))


def _around(
    scheme: SchemeData, rims: Mapping[str, Rim], planets: Mapping[str, int]
) -> Iterator[Item]:
    """Yield the other planets of every carrier with their arms."""
    sets: dict[int, set[str]] = {}
    for body, carrier in scheme.over.items():
        if scheme.heights[body] and not scheme.heights[carrier]:
            sets.setdefault(planets.get(carrier, 1), set()).add(body)
    for count, number in ((k, number) for k in sets for number in range(1, k)):
        carried, turn = sets[count], cmath.exp(2j * cmath.pi * number / count)
        for rim in rims.values():
            if rim.body in carried:
                centre = 1j * rim.centre * turn
                touch = centre + 1j * turn * rim.mesh_sides[0] * rim.radius
                yield from pitch_circle(centre, rim.radius, touch=touch)
        for level, radius in _outermost(rim for rim in rims.values() if rim.body in carried):
            yield from centre_lines(1j * level * turn, radius, directions=(turn, 1j * turn))
        for body in sorted(carried):
            start = 1j * scheme.heights[scheme.over[body]] * turn
            yield from link(start, 1j * scheme.heights[body] * turn, tag=f"link {body} {number}")
            yield from revolute(1j * scheme.heights[body] * turn)


def _straight(scheme: SchemeData, rims: Mapping[str, Rim]) -> Iterator[Item]:
    """Yield belts and chains from circle to circle, and racks."""
    for mesh in scheme.motion.train.meshes:
        one, other = rims.get(mesh.first), rims.get(mesh.second)
        if mesh.kind is MeshKind.RACK and one is not None:
            at, half = _rack_at(one), one.radius + RACK_BEYOND
            yield from rack_front(at - half, at + half)
            speed = scheme.motion.speeds[one.body]  # below its axis a wheel moves right if positive
            start = at - RACK_ARROW - (SWEEP / 2 if speed > 0 else -SWEEP / 2)
            if speed:
                yield from straight_arrow(
                    start, start + (SWEEP if speed > 0 else -SWEEP), tag="sense"
                )
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


def _rack_at(rim: Rim) -> complex:
    return 1j * (rim.centre - rim.radius)


def _rack_labels(scheme: SchemeData, rims: Mapping[str, Rim], height: float) -> Iterator[Label]:
    """Yield the numbers of racks, beside their right ends."""
    for mesh in scheme.motion.train.meshes:
        if mesh.kind is MeshKind.RACK and mesh.first in rims:
            rim = rims[mesh.first]
            at = _rack_at(rim) + rim.radius + RACK_BEYOND - 2j
            name = f"front {mesh.second}"
            yield Label(typeset(mesh.second, height), at, prefer=1, gap=1.2, name=name, style=BUSY)


def _wheel(rim: Rim) -> Iterator[Item]:
    centre = 1j * rim.centre
    touch = centre + 1j * rim.mesh_sides[0] * rim.radius
    yield from pitch_circle(centre, rim.radius, touch=touch)
    if rim.ring:
        yield Arc(centre, _rim(rim))


def _outermost(rims: Iterable[Rim]) -> Iterable[tuple[float, float]]:
    """Return the heights of the axes, each with its largest radius: it has one centre line."""
    reach: dict[float, float] = {}
    for rim in rims:
        level = round(rim.centre, 6)
        reach[level] = max(reach.get(level, 0.0), _rim(rim))
    return reach.items()


def _rim(rim: Rim) -> float:
    """Return the radius of the rim of a wheel: outside the pitch circle of one with inner teeth."""
    return rim.radius + (SIZES.slider_width / 2 if rim.ring else 0.0)


def _sense(scheme: SchemeData, rim: Rim, angle: float) -> list[Item]:
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


AXIS_OVERHANG = 8.0
"""Overhang of the axis of contact points beyond them, mm."""

SEGMENT = VectorKind.ABSOLUTE.value
"""Tag of the measured segments on the sheet: the vectors of a plan."""

RAYS_POLE = "pole of rays"
"""Tag of the pole of the angular velocity diagram."""

ZERO_TOLERANCE_MM = 0.05
"""Length below which a segment is taken as zero, mm."""


def linear(
    drawn: GearDrawing, reading: GearReading, height: float, view_letters: Sequence[str] = ()
) -> tuple[list[Item], list[Label]]:
    """Return the linear velocity diagram, the foot of the main axis at the origin.

    ``view_letters`` are the letters of its detail views.
    """
    feet = {spot.base: reading.point(spot.base) for spot in drawn.spots} | {AXIS_FOOT: 0j}
    levels = [at.imag for at in feet.values()]
    low, high = min(levels) - AXIS_OVERHANG, max(levels) + AXIS_OVERHANG
    items: list[Item] = [*axis_line(complex(0, low), complex(0, high), *feet.values())]
    enlarged = drawn.spots_on(reading.detail_views)
    for spot in drawn.spots:
        foot, end = feet[spot.base], reading.point(spot.end)
        tag = "" if spot.end in enlarged else SEGMENT  # there it is measured
        items += vector_arrow(foot, end, pen=Pen.COMPONENT, tag=tag)
    labels = []
    for detail_view, letter in zip(linear_views(reading), view_letters, strict=False):
        circle, label = detail_mark(detail_view, _linear_places(drawn, reading), letter, height)
        items.append(circle)
        labels.append(label)
    for body, (start, end) in lines(drawn, reading).items():
        items.append(Stroke((start, end), tag=f"line {body}"))
        if abs(end.real) + abs(start.real) > ZERO_TOLERANCE_MM:
            near = start + (end - start) * (0.62 if abs(end.real) > abs(start.real) else 0.38)
            ends = (near - (end - start) / 50, near + (end - start) / 50)
            labels.append(
                Label(typeset(drawn.label(body), height), near, ends, gap=1.2, priority=1,
                      name=f"line {body}", style=BUSY)
            )  # fmt: skip
    items += [Disc(at, 0.7, Ink.BLACK) for at in feet.values()]
    letters = [(at, [str(name)]) for name, at in feet.items()]
    ends_of = (
        (reading.point(spot.end), [spot.letter]) for spot in drawn.spots if spot.end != spot.base
    )
    spots = merge_letters([*letters, *ends_of])
    named = label_merged_letters(spots, height, "picture", style=NEAREST)
    return items, [*labels, *named]


def lines(drawn: GearDrawing, reading: GearReading) -> dict[str, tuple[complex, complex]]:
    """Return the lines of bodies that move, from their lowest point to their highest."""
    scale = float(drawn.motion.train.unit_m / drawn.diagrams.mu_l)
    found = {}
    for body in drawn.lines:
        if body in drawn.motion.train.fixed:
            continue
        points = [reading.point(spot.end) for spot in drawn.spots if body in spot.bodies]
        if not any(spot.contact == ContactPoint(ContactKind.AXIS, body) for spot in drawn.spots):
            points.append(complex(0.0, float(drawn.motion.axes.heights[body]) * scale))
        points.sort(key=lambda point: point.imag)
        found[body] = points[0], points[-1]
    return found


def linear_spans(
    drawn: GearDrawing, reading: GearReading, origin: complex, views: Mapping[int, complex]
) -> Iterator[Span]:
    """Yield the measured segments of a diagram whose main axis is at ``origin`` on the sheet.

    ``views`` are the centres of its detail views by their numbers.
    """
    enlarged = drawn.spots_on(reading.detail_views)
    for spot in drawn.spots:
        ends, name = (reading.point(spot.base), reading.point(spot.end)), spot.letter
        if abs(ends[1] - ends[0]) <= ZERO_TOLERANCE_MM:
            continue
        name = plain_text(f"{spot.base}{spot.letter}")
        if (knot := enlarged.get(spot.end)) is None:
            yield Span(name, None, origin + ends[0], origin + ends[1])
            continue
        start, stop = (views[knot.number] + (one - knot.centre) * knot.times for one in ends)
        yield Span(name, None, start, stop, knot.times)


def linear_views(reading: GearReading) -> list[DetailView]:
    """Return the detail views of the linear velocity diagram."""
    return [one for one in reading.detail_views if one.ends[0][0] != RAY_ORIGIN]


def ray_views(reading: GearReading) -> list[DetailView]:
    """Return the detail views of the angular velocity diagram."""
    return [one for one in reading.detail_views if one.ends[0][0] == RAY_ORIGIN]


def _linear_places(drawn: GearDrawing, reading: GearReading) -> dict[PointName, complex]:
    """Return the places of the points of the linear velocity diagram, mm from its foot."""
    return {name: reading.point(name) for spot in drawn.spots for name in (spot.base, spot.end)}


def enlarged_velocity(
    drawn: GearDrawing, reading: GearReading, detail_view: DetailView, height: float
) -> Picture:
    """Return a detail view of a short linear velocity, its centre at the origin."""
    at, tag = _linear_places(drawn, reading), f"{ENLARGED} {detail_view.number}"
    radius, places = radius_of(detail_view, at), placed_in(detail_view, at)
    items: list[Item] = [Arc(0j, radius, pen=Pen.THIN, tag=tag)]
    for body, ends in lines(drawn, reading).items():
        one, two = ((end - detail_view.centre) * detail_view.times for end in ends)
        if (inside := clip_to_circle(one, two, radius)) is not None:
            items.append(Stroke(inside, tag=f"line {body}"))
    foot, end = detail_view.ends[0]
    axis = places[foot].real
    if (inside := clip_to_circle(axis - 1j * radius, axis + 1j * radius, radius)) is not None:
        items += axis_line(*inside, places[foot], tag=tag)
    items += vector_arrow(places[foot], places[end], pen=Pen.COMPONENT, tag=SEGMENT)
    items += [Disc(places[foot], 0.7, Ink.BLACK)]
    letter = next(spot.letter for spot in drawn.spots if spot.end == end)
    spots = merge_letters([(places[foot], [str(foot)]), (places[end], [letter])])
    return lettered(items, label_merged_letters(spots, height, f"{tag}:", style=NEAREST))


def angular(
    drawn: GearDrawing, reading: GearReading, height: float, view_letters: Sequence[str] = ()
) -> Picture:
    """Return the angular velocity diagram, its pole at the origin.

    ``view_letters`` are the letters of its detail views.
    """
    foot = -1j * float(drawn.diagrams.pole_mm)
    ends = {body: reading.point(end) for body, end in drawn.rays.items()}
    read_on = drawn.read_on(reading.detail_views)  # their segments are measured there
    left = min([0.0, *(end.real for end in ends.values())]) - AXIS_OVERHANG
    right = max([0.0, *(end.real for end in ends.values())]) + AXIS_OVERHANG
    items: list[Item] = [
        Stroke((foot + left, foot + right), Pen.THIN),
        *axis_line(0j, foot),
        *(
            Stroke((foot, end), Pen.THIN, tag=SEGMENT)
            for body, end in ends.items()
            if abs(end - foot) and body not in read_on
        ),
        *(Stroke((0j, end), tag=f"ray {body}") for body, end in ends.items()),
        Disc(0j, 0.7, Ink.BLACK, tag=RAYS_POLE),
        *(Disc(at, 0.7, Ink.BLACK) for at in (foot, *ends.values())),
    ]
    letters = [(foot, ["o"]), (0j, [str(POLE)])]
    letters += [(end, [drawn.label(body)]) for body, end in ends.items()]
    labels = label_merged_letters(merge_letters(letters), height, "rays", style=NEAREST)
    below = [
        Label(one.inscription, one.anchor, prefer=-1j if one.anchor != 0 else 1j, gap=1.4,
              name=one.name, style=NEAREST)
        for one in labels
    ]  # fmt: skip
    at = _ray_places(drawn, reading)
    for detail_view, letter in zip(ray_views(reading), view_letters, strict=True):
        circle, label = detail_mark(detail_view, at, letter, height)
        items.append(circle)
        below.append(label)
    return lettered(items, below)


def _ray_places(drawn: GearDrawing, reading: GearReading) -> dict[PointName, complex]:
    """Return the places of the points of the angular velocity diagram, mm from its pole."""
    return {name: reading.point(name) for name in (RAY_ORIGIN, *drawn.rays.values())}


def enlarged_rays(
    drawn: GearDrawing, reading: GearReading, detail_view: DetailView, height: float
) -> Picture:
    """Return a detail view of the short segments of rays, its centre at the origin."""
    at, tag = _ray_places(drawn, reading), f"{ENLARGED} {detail_view.number}"
    radius, places = radius_of(detail_view, at), placed_in(detail_view, at)
    pole, foot = -detail_view.centre * detail_view.times, places[RAY_ORIGIN]
    own = [end for _, end in detail_view.ends]
    items: list[Item] = [Arc(0j, radius, pen=Pen.THIN, tag=tag)]
    for ends, pen, of in (
        ((foot - 2 * radius, foot + 2 * radius), Pen.THIN, tag),
        *(((pole, places[end]), Pen.MAIN, f"ray {body}") for body, end in drawn.rays.items()),
    ):
        if (inside := clip_to_circle(*ends, radius)) is not None:
            items.append(Stroke(inside, pen, tag=of))
    if (inside := clip_to_circle(pole, foot, radius)) is not None:
        items += axis_line(*inside, tag=tag)
    items += [Stroke((foot, places[end]), Pen.THIN, tag=SEGMENT) for end in own]
    items += [Disc(places[name], 0.7, Ink.BLACK) for name in (RAY_ORIGIN, *own)]
    letters = [(foot, [str(RAY_ORIGIN)])]
    letters += [(places[e], [drawn.label(b)]) for b, e in drawn.rays.items() if e in own]
    labels = label_merged_letters(merge_letters(letters), height, f"{tag}:", style=NEAREST)
    return lettered(items, labels)


def angular_spans(
    drawn: GearDrawing, reading: GearReading, pole: complex, views: Sequence[complex]
) -> Iterator[Span]:
    """Yield the measured segments of a diagram whose pole is at ``pole`` on the sheet.

    ``views`` are the centres of its detail views: the segments shown there are measured there.
    """
    read_on = drawn.read_on(reading.detail_views)
    for body, end in drawn.rays.items():
        ends, name = (reading.point(RAY_ORIGIN), reading.point(end)), f"o{drawn.label(body)}"
        if abs(ends[1] - ends[0]) <= ZERO_TOLERANCE_MM:
            continue
        if (knot := read_on.get(body)) is None:
            yield Span(name, None, pole + ends[0], pole + ends[1])
            continue
        middle = views[knot.number]
        start, stop = (middle + (one - knot.centre) * knot.times for one in ends)
        yield Span(name, None, start, stop, knot.times)
