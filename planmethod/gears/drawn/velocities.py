"""The pictures of velocities as they are drawn (картины линейных и угловых скоростей)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.gears.construction import FEET, POLE, Construction, Reading
from planmethod.note.plaintext import plain_text
from planmethod.plans.model import VectorKind
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Span, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.labels.spots import shared_spots, spot_labels
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import vector_arrow
from planmethod.render.symbols.axes import axis_line

BEYOND = 8.0
"""How far the axis of contact points goes beyond them, mm."""

SEGMENT = VectorKind.ABSOLUTE.value
"""Tag of the measured segments on the sheet: the vectors of a plan."""

NOTHING = 0.05
"""Segments below this are nothing, mm."""


def linear(drawn: Construction, seen: Reading, height: float) -> tuple[list[Item], list[Label]]:
    """Return the picture of linear velocities, the foot of the main axis at the origin."""
    feet = {spot.foot: seen.point(spot.foot) for spot in drawn.spots} | {FEET: 0j}
    levels = [at.imag for at in feet.values()]
    low, high = min(levels) - BEYOND, max(levels) + BEYOND
    items: list[Item] = [*axis_line(complex(0, low), complex(0, high), *feet.values())]
    for spot in drawn.spots:
        foot, end = feet[spot.foot], seen.point(spot.end)
        items += vector_arrow(foot, end, pen=Pen.THIN, length=4.0, tag=SEGMENT)
    labels = []
    for body, (start, end) in lines(drawn, seen).items():
        items.append(Stroke((start, end), tag=f"line {body}"))
        if abs(end.real) + abs(start.real) > NOTHING:
            near = start + (end - start) * (0.62 if abs(end.real) > abs(start.real) else 0.38)
            ends = (near - (end - start) / 50, near + (end - start) / 50)
            labels.append(
                Label(typeset(drawn.label(body), height), near, ends, gap=1.2, priority=1,
                      name=f"line {body}", manner=BUSY)
            )  # fmt: skip
    items += [Disc(at, 0.7, Ink.BLACK) for at in feet.values()]
    letters = [(at, [str(name)]) for name, at in feet.items()]
    ends_of = (
        (seen.point(spot.end), [spot.letter]) for spot in drawn.spots if spot.end != spot.foot
    )
    spots = shared_spots([*letters, *ends_of])
    named = spot_labels(spots, height, "picture", manner=BUSY)
    return items, [*labels, *named]


def lines(drawn: Construction, seen: Reading) -> dict[str, tuple[complex, complex]]:
    """Return the lines of bodies that move, from their lowest point to their highest."""
    scale = float(drawn.motion.train.unit_m / drawn.picture.mu_l)
    found = {}
    for body in drawn.lines:
        if body in drawn.motion.train.fixed:
            continue
        points = [seen.point(spot.end) for spot in drawn.spots if body in spot.bodies]
        if not any(spot.contact == f"axis {body}" for spot in drawn.spots):
            points.append(complex(0.0, float(drawn.motion.axes.heights[body]) * scale))
        points.sort(key=lambda point: point.imag)
        found[body] = points[0], points[-1]
    return found


def linear_spans(drawn: Construction, seen: Reading, origin: complex) -> Iterator[Span]:
    """Yield the measured segments of a picture whose main axis lies at ``origin`` on the sheet."""
    for spot in drawn.spots:
        foot, end = seen.point(spot.foot), seen.point(spot.end)
        if abs(end - foot) > NOTHING:
            yield Span(plain_text(f"{spot.foot}{spot.letter}"), None, origin + foot, origin + end)


def angular(drawn: Construction, seen: Reading, height: float) -> Picture:
    """Return the picture of angular velocities, its pole at the origin."""
    foot = -1j * float(drawn.picture.pole_mm)
    ends = {body: seen.point(end) for body, end in drawn.rays.items()}
    left = min([0.0, *(end.real for end in ends.values())]) - BEYOND
    right = max([0.0, *(end.real for end in ends.values())]) + BEYOND
    items: list[Item] = [
        Stroke((foot + left, foot + right), Pen.THIN),
        *axis_line(0j, foot),
        *(Stroke((foot, end), Pen.THIN, tag=SEGMENT) for end in ends.values() if abs(end - foot)),
        *(Stroke((0j, end), tag=f"ray {body}") for body, end in ends.items()),
        *(Disc(at, 0.7, Ink.BLACK) for at in (0j, foot, *ends.values())),
    ]
    letters = [(foot, ["o"]), (0j, [str(POLE)])]
    letters += [(end, [drawn.label(body)]) for body, end in ends.items()]
    labels = spot_labels(shared_spots(letters), height, "rays", manner=BUSY)
    below = [
        Label(one.inscription, one.anchor, prefer=-1j if one.anchor != 0 else 1j, gap=1.4,
              name=one.name, manner=BUSY)
        for one in labels
    ]  # fmt: skip
    return lettered(items, below)


def angular_spans(drawn: Construction, seen: Reading, pole: complex) -> Iterator[Span]:
    """Yield the measured segments of a picture whose pole lies at ``pole`` on the sheet."""
    foot = pole - 1j * float(drawn.picture.pole_mm)
    for body, end in drawn.rays.items():
        if abs(pole + seen.point(end) - foot) > NOTHING:
            yield Span(f"o{drawn.label(body)}", None, foot, pole + seen.point(end))
