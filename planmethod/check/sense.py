"""Sense of a quantity: which way a vector points, which way a link turns (направление)."""

from __future__ import annotations

from planmethod.check.model import Sense
from planmethod.check.questions import Question, Sign
from planmethod.check.sheet import Sheet, scalar
from planmethod.construct.evaluate import Trace

WAYS = {Sense.RIGHT: 1 + 0j, Sense.UP: 1j, Sense.LEFT: -1 + 0j, Sense.DOWN: -1j}

ASLANT = 0.26
"""Share of a vector along a way, sin 15°, below which nobody says that it points there."""


def sense_of(sheet: Sheet, question: Question) -> Sense | None:
    """Return the main sense of a quantity; None where it has none."""
    if question.sign is Sign.TURN and _turns(question):
        value = sheet.exact[question.id]
        return None if not value else Sense.CCW if value > 0 else Sense.CW
    vector = sheet.vector(question)
    if vector is None or not abs(vector) > 0:
        return None
    return max(WAYS, key=lambda sense: (vector * WAYS[sense].conjugate()).real)


def is_right(
    sheet: Sheet, question: Question, told: Sense, trace: Trace | None = None
) -> bool | None:
    """Tell whether a sense is right on a sheet; None where that cannot be said.

    A vector that goes aslant points both ways that its components have.
    """
    if question.sign is Sign.TURN and _turns(question):
        value = scalar(question.take(trace or sheet.trace))
        return None if not told.turns or not value else (value > 0) is (told is Sense.CCW)
    vector = sheet.vector(question, trace)
    if told.turns or vector is None or not abs(vector) > 0:
        return None
    along = (vector * WAYS[told].conjugate()).real / abs(vector)
    return None if abs(along) < ASLANT else along > 0


def _turns(question: Question) -> bool:
    return question.unit in ("1/s", "1/s²", "N·m")
