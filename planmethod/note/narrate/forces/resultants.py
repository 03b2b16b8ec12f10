"""Inertia forces where one resultant replaces force and couple (равнодействующая)."""

from __future__ import annotations

from planmethod.note.plaintext import input_text
from planmethod.note.wording import MessageTable
from planmethod.solved.forces.resultants import Hindrance, UnshiftedInertia, farthest
from planmethod.solved.forces.statics import Statics


def shift_symbol(link: str) -> str:
    """Return the letter of a shift in rich text: ``h_{2}``."""
    return f"h_{{{link}}}"


def force_symbol(link: str) -> str:
    """Return the letter of a link's force of inertia in rich text: ``Φ_{2}``."""
    return f"Φ_{{{link}}}"


def shift_lines(statics: Statics, texts: MessageTable, index: int | None = None) -> list[str]:
    """Return where the shifted forces act, as rich text; in one position with its exact h."""
    lines = []
    for shift in statics.board.shifts.values():
        phrase = texts.resultant_shift.format(
            force=force_symbol(shift.link), point=shift.letter, couple=shift.moment.name
        )
        if index is not None:
            length = abs(float(statics.si.number(shift.length)[index]))
            unit = texts["units"]["m"]
            phrase += f": {shift_symbol(shift.link)} = {input_text(length, texts, 4)} {unit}"
        lines.append(f"{phrase}.")
    return lines


def unshifted_lines(statics: Statics, texts: MessageTable) -> list[str]:
    """Return which links keep the couple, and why, as rich text; the same for all positions."""
    return [_unshifted_line(statics, one, texts) for one in statics.unshifted]


def _unshifted_line(statics: Statics, one: UnshiftedInertia, texts: MessageTable) -> str:
    text = {
        Hindrance.NO_FORCE: texts.resultant_no_force,
        Hindrance.FAINT: texts.resultant_faint,
        Hindrance.TOO_LONG: texts.resultant_far,
    }[one.hindrance]
    return text.format(
        link=one.link,
        force=force_symbol(one.link),
        couple=one.moment.name,
        shift=shift_symbol(one.link),
        value=input_text(one.reach, texts, 4),
        limit=input_text(farthest(statics.solution.problem), texts, 4),
    )
