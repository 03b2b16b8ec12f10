"""Inertia forces where one resultant replaces force and couple (равнодействующая)."""

from __future__ import annotations

from planmethod.note.plaintext import given
from planmethod.note.wording import Words
from planmethod.solved.forces.resultants import Hindrance, UnshiftedInertia, farthest
from planmethod.solved.forces.statics import Statics


def shift_symbol(link: str) -> str:
    """Return the letter of a shift in rich text: ``h_{2}``."""
    return f"h_{{{link}}}"


def force_symbol(link: str) -> str:
    """Return the letter of a link's force of inertia in rich text: ``Φ_{2}``."""
    return f"Φ_{{{link}}}"


def shift_lines(statics: Statics, words: Words, index: int | None = None) -> list[str]:
    """Return where the shifted forces act, as rich text; in one position with its exact h."""
    lines = []
    for shift in statics.board.shifts.values():
        said = words.resultant_shift.format(
            force=force_symbol(shift.link), point=shift.letter, couple=shift.moment.name
        )
        if index is not None:
            length = abs(float(statics.si.number(shift.length)[index]))
            unit = words["units"]["m"]
            said += f": {shift_symbol(shift.link)} = {given(length, words, 4)} {unit}"
        lines.append(f"{said}.")
    return lines


def kept_lines(statics: Statics, words: Words) -> list[str]:
    """Return which links keep the couple, and why, as rich text; the same for all positions."""
    return [_kept(statics, one, words) for one in statics.unshifted]


def _kept(statics: Statics, one: UnshiftedInertia, words: Words) -> str:
    text = {
        Hindrance.NO_FORCE: words.resultant_no_force,
        Hindrance.FAINT: words.resultant_faint,
        Hindrance.FAR: words.resultant_far,
    }[one.why]
    return text.format(
        link=one.link,
        force=force_symbol(one.link),
        couple=one.moment.name,
        shift=shift_symbol(one.link),
        value=given(one.reach, words, 4),
        limit=given(farthest(statics.solution.problem), words, 4),
    )
