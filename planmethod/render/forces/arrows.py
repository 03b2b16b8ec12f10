"""Forces and couples drawn on links, and the arms of forces as they are measured (плечи сил)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import inf

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from planmethod.note.narrate.forces.loads import arm_symbol
from planmethod.note.numbers import Notation
from planmethod.plans.draft import cis
from planmethod.plans.forces.polygons import Component, Moments
from planmethod.render.ink.drawing import Arc, Disc, Fill, Item, Pen, Stroke
from planmethod.render.ink.pens import pens_in_use
from planmethod.render.ink.typeset import arc_points, typeset, vector_markup
from planmethod.render.labels import BUSY, MIN_LEADER, Label, Segment, segment_label
from planmethod.render.pictures.schemeview import small
from planmethod.render.symbols import FORCE, turn_arrow, unit, vector_arrow
from planmethod.solved.forces.reading import ForceReading

LENGTH = 22.0
"""Length of the arrow of a force on a link, mm: the same for all, whatever the force."""

COUPLE = "couple"
"""First word of the tags of circular arrows; the second is the letter."""

FORCE_LABEL_STYLE = replace(
    BUSY, leader_from=MIN_LEADER, stranger=25.0, other_segment=50.0, slanted=True
)
"""Label style of a force's letter: nearest to its own arrow, or with a leader."""

_NEAR = 3.0  # mm: closer arrows would read as one
_ON = 1.0  # mm: a closer arrow lies on a link
_DISTANCES = (0.0, 4.0, -4.0, 6.0, -6.0)  # mm from its line of action; arrows on one line are apart
_COST_OF_DISTANCE = 8.0  # cost of an arrow beside its line of action
_STRANGER = 10.0  # cost of another joint on the way to an arrow, or under it


class Acting(Struct, frozen=True):
    """Force to be drawn: its letter, where it acts, mm, and in which direction.

    ``gap`` is the white between its arrow and its point, mm, if different from the others'.
    """

    symbol: str
    at: complex
    direction: complex
    pen: Pen = Pen.RESULTANT
    gap: float | None = None


class CoupleArc(Struct, frozen=True):
    """Couple to be drawn: its letter, a place on its link, mm, and its sense.

    ``segment`` is the lever segment that it acts on: its arrow may be placed anywhere on it.
    """

    symbol: str
    at: complex
    sense: int
    segment: Segment | None = None


def distance(place: complex, segment: Segment) -> float:
    """Return how far a place is from a segment, mm."""
    start, along = segment[0], segment[1] - segment[0]
    if abs(along) < 1e-9:
        return abs(place - start)
    part = ((place - start) * along.conjugate()).real / abs(along) ** 2
    return abs(place - start - along * min(1.0, max(0.0, part)))


def place_force_arrows(
    forces: Sequence[Acting],
    bars: Sequence[Segment],
    joints: Sequence[complex] = (),
    *,
    gap: float = 2.0,
) -> list[tuple[Acting, Segment]]:
    """Return where the arrow of each force is drawn, its tail and its head.

    It begins or ends at the point of its force. If another arrow is there on the same line, it is
    beside that one, a few millimetres from its line of action. ``bars`` are the lines of the links,
    which arrows avoid; beyond another of the ``joints`` an arrow would read as that joint's.
    ``gap`` is the white between an arrow and its point, mm.
    """
    placed: list[tuple[Acting, Segment]] = []
    for force in forces:
        along, white = unit(force.direction), gap if force.gap is None else force.gap
        there = [segment for _, segment in placed]
        others = [joint for joint in joints if abs(joint - force.at) > _NEAR]
        tries: list[tuple[float, int, Segment]] = []
        for aside in _DISTANCES:
            foot = force.at + 1j * along * aside
            near, far = along * white, along * (white + LENGTH)
            for k, segment in enumerate(((foot + near, foot + far), (foot - far, foot - near))):
                cost = (
                    (_COST_OF_DISTANCE + abs(aside)) * bool(aside)
                    + k
                    + _arrow_cost(segment, there, bars)
                )
                reach = foot, segment[1 - k]
                cost += _STRANGER * sum(distance(joint, reach) < _NEAR for joint in others)
                tries.append((cost, len(tries), segment))
        placed.append((force, min(tries)[2]))
    return placed


def on_action(force: Acting, arrow: Segment) -> Segment:
    """Return the ends of a force's arrow, moved from beside its line of action onto it."""
    along = unit(force.direction)
    tail, head = (force.at + along * ((end - force.at) * along.conjugate()).real for end in arrow)
    return tail, head


def _arrow_cost(segment: Segment, arrows: Sequence[Segment], bars: Sequence[Segment]) -> float:
    """Return the cost of an arrow's place among other arrows and on links."""
    near, on = _count_close_points(segment, arrows, _NEAR), _count_close_points(segment, bars, _ON)
    return float(
        np.where(near > 2, 8.0 * near, near).sum() + np.where(on > 2, 1.5 * on, 0.5 * on).sum()
    )


def _count_close_points(
    segment: Segment, segments: Sequence[Segment], white: float
) -> NDArray[np.intp]:
    """Return for each other segment how many of ten points of this one are near (``white``)."""
    if not segments:
        return np.zeros(0, dtype=np.intp)
    tail, head = segment
    places = tail + (head - tail) * np.arange(1, 11)[:, None] / 10
    ends = np.asarray(segments)
    ways = ends[:, 1] - ends[:, 0]
    reach = places - ends[:, 0]
    part = (reach * ways.conj()).real / np.maximum(np.abs(ways) ** 2, 1e-18)
    off = np.abs(reach - ways * np.clip(part, 0.0, 1.0))
    return np.asarray((off < white).sum(axis=0))


def force_items(
    placed: Iterable[tuple[Acting, Segment]], height: float, prefix: str
) -> tuple[list[Item], list[Label]]:
    """Return the arrows of forces and their letters."""
    items: list[Item] = []
    labels: list[Label] = []
    for k, (force, (tail, head)) in enumerate(placed):
        tag = f"{FORCE} {force.symbol}"
        items += vector_arrow(tail, head, pen=force.pen, tag=tag)
        labels.append(
            Label(
                typeset(vector_markup(force.symbol), height),
                (tail + head) / 2,
                (tail + 0.35 * (head - tail), head),
                gap=1.0,
                priority=1,
                name=f"{prefix} force {k}: {force.symbol}",
                style=FORCE_LABEL_STYLE,
            )
        )
    return items, labels


def couple_items(
    couples: Sequence[CoupleArc], around: Sequence[Item], height: float, prefix: str
) -> tuple[list[Item], list[Label]]:
    """Return circular arrows in the freest places, and their letters."""
    items: list[Item] = []
    labels: list[Label] = []
    for k, couple in enumerate(couples):
        lines = list(lines_of([*around, *items]))
        centre, radius, middle = max(
            (_find_arc_place(place, lines) for place in _places(couple)), key=lambda room: room[0]
        )[1:]
        tag = f"{COUPLE} {couple.symbol}"
        items += turn_arrow(
            centre, radius, couple.sense, middle=middle, sweep=_SWEEP, pen=Pen.RESULTANT,
            length=pens_in_use().head(Pen.RESULTANT), tag=tag,
        )  # fmt: skip
        out = cis(middle)
        labels.append(
            Label(
                typeset(couple.symbol, height),
                centre + radius * out,
                prefer=out,
                gap=1.5,
                priority=1,
                name=f"{prefix} couple {k}: {couple.symbol}",
                style=FORCE_LABEL_STYLE,
            )
        )
    return items, labels


_SWEEP = 100.0  # of a circular arrow, degrees
_RADII = (9.0, 12.0, 15.0, 18.0, 22.0)
_MATTERS = 4.0  # lines farther from the arrow do not matter, mm


def _places(couple: CoupleArc) -> list[complex]:
    """Return the centres that the arrow of a couple may have, the best first, mm."""
    if couple.segment is None:
        return [couple.at]
    start, end = couple.segment
    return [couple.at, *(start + part * (end - start) for part in (0.25, 0.75))]


def _find_arc_place(
    centre: complex, lines: Sequence[Segment]
) -> tuple[float, complex, float, float]:
    """Return the place of a circular arrow about a centre with the fewest crossings.

    The result is the value of the place, the centre, the radius and the middle: mm, degrees.
    """
    best = (-1e9, 0.0, 0.0)
    for radius in _RADII:
        if _MATTERS + 1.5 - 0.1 * radius <= best[0]:  # with white all around
            break
        near = [
            line
            for line in lines
            if distance(centre, line) < radius + _MATTERS
            and max(abs(end - centre) for end in line) > radius - _MATTERS
        ]
        middles = range(0, 360, 15)
        turns = [middle + _SWEEP * (k / 8 - 0.5) for middle in middles for k in range(9)]
        gaps = _gaps([centre + radius * cis(turn) for turn in turns], near)
        for k, middle in enumerate(middles):
            own = gaps[9 * k : 9 * (k + 1)]
            white = sum(min(gap, _MATTERS) for gap in own)
            worth = white / 9 + 0.5 * min(*own, 3.0) - 0.1 * radius
            if worth > best[0] + 1e-9:
                best = (worth, radius, float(middle))
    return best[0], centre, best[1], best[2]


def _gaps(places: Sequence[complex], lines: Sequence[Segment]) -> list[float]:
    """Return how far each place is from the nearest of the lines, mm: as `distance`, at once."""
    if not lines:
        return [5.0] * len(places)
    ends: NDArray[np.complex128] = np.array(lines)
    start, along = ends[:, 0], ends[:, 1] - ends[:, 0]
    length = np.hypot(along.real, along.imag)
    off = np.array(places)[:, None] - start
    inner = off.real * along.real + off.imag * along.imag
    part = np.clip(inner / np.where(length < 1e-9, inf, length) ** 2, 0.0, 1.0)
    nearest: list[float] = (
        np.hypot(off.real - along.real * part, off.imag - along.imag * part).min(axis=1).tolist()
    )
    return nearest


def lines_of(items: Iterable[Item]) -> Iterable[Segment]:
    """Return the straight lines of items; of a disc its centre."""
    for item in items:
        match item:
            case Stroke(points=points):
                yield from pairwise(points)
            case Fill(points=points):
                yield from pairwise([*points, points[0]])
            case Arc():
                yield from pairwise(arc_points(item))
            case Disc(centre=centre):
                yield centre, centre
            case _:
                continue


ARM, ACTION = "arm", "action beyond an arrow"
"""Tags of the perpendicular, before the force's letter, and of the line of action that it meets."""

_MIN_LENGTH = 3.0  # mm: a shorter arm is too short to be seen
_SAME = 0.3  # mm: closer arms are drawn as one line
_CORNER = 2.0  # mm: sides of the sign of a right angle
_EXTENSION = 3.0  # mm that a line of action goes on beyond its foot
_MAX_ARMS = 24  # arms on a picture: more would be unreadable, and the equations list them


class ForceArm(Struct, frozen=True):
    """Arm of a force about a point, mm.

    Attributes
    ----------
    symbol : str
        Letter of the force.
    about, base : complex
        The point and the foot of its perpendicular on the line of action.
    read : float
        The arm as the hand has measured it, without a sign.
    """

    symbol: str
    about: complex
    base: complex
    read: float


def arm_of(force: Acting, about: complex, read: float) -> ForceArm:
    """Return the arm of a force that acts along a line."""
    along = unit(force.direction)
    foot = force.at + along * ((about - force.at) * along.conjugate()).real
    return ForceArm(force.symbol, about, foot, abs(read))


def arms_of(
    reading: ForceReading, equations: Iterable[Moments], notation: Notation
) -> list[ForceArm]:
    """Return the arms used in the moment equations of a force plan, each once."""
    found: dict[tuple[str, complex], ForceArm] = {}
    for equation in equations:
        about = reading.place(equation.about)
        found_too = (
            equation.force is not None and equation.force.component is not Component.TANGENTIAL
        )
        for edge in (*equation.edges, *([equation.force] if found_too and equation.force else [])):
            read = 0.0 if reading.is_negligible(edge) else reading.arm(edge, equation.about)
            if read:
                force = Acting(
                    notation.symbol(edge.symbol),
                    reading.place(edge.at),
                    reading.drawn_direction(edge),
                )
                found.setdefault((edge.symbol, about), arm_of(force, about, read))
        balancing = equation.force
        if balancing is not None and balancing.is_aslant:
            at, way = reading.place(balancing.at), reading.drawn_direction(balancing)
            force = Acting(notation.symbol(balancing.symbol), at, way)
            read = reading.read_number(equation.arm[0][0])
            found.setdefault((balancing.symbol, about), arm_of(force, about, read))
    return list(found.values())


def arm_items(
    arms: Iterable[ForceArm],
    placed: Sequence[tuple[Acting, Segment]],
    height: float,
    prefix: str,
    notation: Notation,
) -> tuple[list[Item], list[Label]]:
    """Return the perpendiculars with their lengths, and the lines of action extended to them.

    ``placed`` are the arrows of the forces. Arms on one line share an inscription: ``h_{G5} =
    h_{Φ5}``. If there are too many arms to read, none is drawn.
    """
    lines: list[list[ForceArm]] = []
    for arm in arms:
        if arm.read < _MIN_LENGTH:
            continue
        same = next((one for one in lines if _is_same(one[0], arm)), None)
        if same is None:
            lines.append([arm])
        else:
            same.append(arm)
    if len(lines) > _MAX_ARMS:
        return [], []
    items: list[Item] = []
    labels: list[Label] = []
    for line in lines:
        first, names = line[0], [arm_symbol(arm.symbol) for arm in line]
        about, foot = first.about, first.base
        items.append(Stroke((about, foot), Pen.THIN, tag=f"{ARM} {first.symbol}"))
        for arm in line:
            items += _action(arm, placed)
        text = f"{' = '.join(names)} = {notation.measured(first.read)}"
        label = segment_label(text, about, foot, min(height, small(height)))
        labels.append(
            replace(label, name=f"{prefix} arm: {' '.join(names)}", style=FORCE_LABEL_STYLE)
        )
    return items, labels


def _is_same(one: ForceArm, second: ForceArm) -> bool:
    apart = max(abs(one.about - second.about), abs(one.base - second.base))
    return apart < _SAME and one.read == second.read


# no messages: tags of items
def _action(arm: ForceArm, placed: Sequence[tuple[Acting, Segment]]) -> list[Item]:
    """Return the line of action from an arrow to the foot of its arm, with the right angle."""
    arrow = next((on_action(*one) for one in placed if one[0].symbol == arm.symbol), None)
    if arrow is None:
        return []
    tail, head = arrow
    along, near = unit(head - tail), min(arrow, key=lambda end: abs(end - arm.base))
    part = ((arm.base - tail) * along.conjugate()).real
    items: list[Item] = []
    way = along if part > 0.0 else -along
    if not 0.0 <= part <= abs(head - tail):
        items.append(Stroke((near, arm.base + way * _EXTENSION), Pen.THIN, tag=ACTION))
    a, b = -way * _CORNER, unit(arm.about - arm.base) * _CORNER
    corner = (arm.base + a, arm.base + a + b, arm.base + b)
    return [*items, Stroke(corner, Pen.THIN, tag=f"{ACTION}: right angle")]
