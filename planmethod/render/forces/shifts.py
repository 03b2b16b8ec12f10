"""The shift of a force of inertia drawn: across from the centre of mass to its line (плечо h)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from msgspec import Struct

from planmethod.note.narrate.forces.resultants import force_symbol, shift_symbol
from planmethod.note.numbers import Notation, half_up
from planmethod.render.forces.arrows import Acting, Segment
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.symbols import unit
from planmethod.solved.forces.reading import ForceReading

SHIFT = "shift"
"""First word of the tags of the lines; the second is the letter of the point."""

_MIN_SHIFT = 0.3  # mm: a nearer point coincides with the centre of mass
_MIN_WITH_MARK = 6.0  # mm: a shorter shift has no room for the mark of its right angle
_CORNER = 2.0  # side of that mark, mm


class ShiftedForce(Struct, frozen=True):
    """Force moved off the centre of mass: its letter, its point's letter, both places, mm.

    ``text`` is the inscription of the line between them.
    """

    force: str
    letter: str
    centre: complex
    at: complex
    text: str = ""

    @property
    def is_visible(self) -> bool:
        """True if there is a line to be drawn."""
        return abs(self.at - self.centre) >= _MIN_SHIFT

    @property
    def line(self) -> Segment:
        """The line from the centre of mass to the point of the force."""
        return self.centre, self.at


def shifted_forces_on(
    reading: ForceReading, links: Iterable[str], notation: Notation
) -> list[ShiftedForce]:
    """Return the visible shifts on some links."""
    found = []
    for link in links:
        shift = reading.statics.board.shifts.get(link)
        if shift is not None:
            centre, at = reading.place(shift.centre), reading.place(shift.at)
            read = abs(reading.read_number(shift.length))
            length = f"{notation.number(f'{half_up(read, 1):.1f}')} {notation.units['mm']}"
            text = f"{shift_symbol(link)} = {length}"
            found.append(ShiftedForce(force_symbol(link), shift.letter, centre, at, text))
    return [one for one in found if one.is_visible]


def shift_items(
    shifted_forces: Iterable[ShiftedForce],
    placed: Sequence[tuple[Acting, Segment]],
    height: float,
    prefix: str,
) -> tuple[list[Item], list[Label]]:
    """Return the lines of shifts, the lines of action as far as the arrows, points and letters.

    ``placed`` are the arrows of the forces.
    """
    items: list[Item] = []
    labels: list[Label] = []
    for one in shifted_forces:
        tag = f"{SHIFT} {one.letter}"
        items += [Stroke(one.line, Pen.THIN, tag=tag), Disc(one.at, 0.8, Ink.BLACK, tag=tag)]
        for force, arrow in placed:
            if force.symbol == one.force:
                items += _line_of_action(one, min(arrow, key=lambda end: abs(end - one.at)))
        labels += _letters(one, height, prefix)
    return items, labels


def _line_of_action(one: ShiftedForce, end: complex) -> list[Item]:
    """Return the line from the point of a force to its arrow, square to the shift."""
    along, back = end - one.at, one.centre - one.at
    items: list[Item] = [Stroke((one.at, end), Pen.THIN, tag="line of action")]
    if abs(back) >= _MIN_WITH_MARK:
        a, b = _CORNER * unit(along), _CORNER * unit(back)
        corner = (one.at + a, one.at + a + b, one.at + b)
        items.append(Stroke(corner, Pen.THIN, tag="right angle"))
    return items


def _letters(one: ShiftedForce, height: float, prefix: str) -> list[Label]:
    """Return the labels of the point and of the shift."""
    labels = [
        Label(
            typeset(one.letter, height),
            one.at,
            prefer=one.at - one.centre,
            gap=1.5,
            name=f"{prefix}: point {one.letter}",
            priority=2,
            style=BUSY,
        )
    ]
    if one.text:
        labels.append(
            Label(
                typeset(one.text, height),
                (one.centre + one.at) / 2,
                one.line,
                gap=1.0,
                name=f"{prefix}: {one.text}",
                style=BUSY,
            )
        )
    return labels
