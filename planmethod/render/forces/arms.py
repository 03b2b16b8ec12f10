"""Arms of forces as they are measured: thin perpendiculars to their lines of action (плечи сил)."""

# no messages: tags of items

from __future__ import annotations

from collections.abc import Iterable, Sequence

from msgspec import Struct
from msgspec.structs import replace

from planmethod.note.narrate.forces.common import arm_symbol
from planmethod.note.numbers import Notation
from planmethod.plans.forces.polygons import Component, Moments
from planmethod.render.forces.arrows import FORCE_LABEL_STYLE, Acting, Segment
from planmethod.render.ink.drawing import Item, Pen, Stroke
from planmethod.render.labels import Label, segment_label
from planmethod.render.pictures.senses import small
from planmethod.render.symbols import unit
from planmethod.solved.forces.reading import ForceReading

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
    about, foot : complex
        The point and the foot of its perpendicular on the line of action.
    read : float
        The arm as the hand has measured it, without a sign.
    """

    symbol: str
    about: complex
    foot: complex
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
        about, foot = first.about, first.foot
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
    apart = max(abs(one.about - second.about), abs(one.foot - second.foot))
    return apart < _SAME and one.read == second.read


def _action(arm: ForceArm, placed: Sequence[tuple[Acting, Segment]]) -> list[Item]:
    """Return the line of action from an arrow to the foot of its arm, with the right angle."""
    arrow = next((ends for force, ends in placed if force.symbol == arm.symbol), None)
    if arrow is None:
        return []
    tail, head = arrow
    along, near = unit(head - tail), min(arrow, key=lambda end: abs(end - arm.foot))
    part = ((arm.foot - tail) * along.conjugate()).real
    items: list[Item] = []
    way = along if part > 0.0 else -along
    if not 0.0 <= part <= abs(head - tail):
        items.append(Stroke((near, arm.foot + way * _EXTENSION), Pen.THIN, tag=ACTION))
    a, b = -way * _CORNER, unit(arm.about - arm.foot) * _CORNER
    corner = (arm.foot + a, arm.foot + a + b, arm.foot + b)
    return [*items, Stroke(corner, Pen.THIN, tag=f"{ACTION}: right angle")]
