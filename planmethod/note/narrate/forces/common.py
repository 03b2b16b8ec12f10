"""What the voices of the force analysis share (общее для глав о силах)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from planmethod.note import wording
from planmethod.note.narrate.formulas import Formulas
from planmethod.note.narrate.naming import Names
from planmethod.note.plaintext import given, plain_text
from planmethod.plans.forces.polygons import Edge
from planmethod.solved.forces.reading import ForceReading

QUARTERS = {0.0: "way_right", 90.0: "way_up", 180.0: "way_left", 270.0: "way_down"}
STRAIGHT = 1e-6
"""Degrees by which a way is off the vertical or the horizontal that is told as such."""


class Telling:
    """What the voices of the force analysis share: a reading, names, a language."""

    def __init__(self, reading: ForceReading, say: Formulas) -> None:
        self.reading, self.solution, self.say = reading, reading.solution, say
        self.names: Names = say.names
        self.words = say.words
        language = wording.language(say.words.lang)
        self.said, self.notation = language.forces, language.say

    def sense(self, value: float) -> str:
        """Return the sense of a moment."""
        return self.words.ccw if value > 0 else self.words.cw

    def exactly(self, value: float) -> str:
        """Return the exact value in brackets."""
        return self.say.exactly(abs(value))

    def plain(self, rich: str) -> str:
        """Return rich text of the force analysis, or a symbol, as plain."""
        return plain_text(self.notation.symbol(rich))

    def found(self, value: float) -> str:
        """Return a computed number."""
        return plain_text(self.notation.found(value))

    def way(self, vector: complex) -> str:
        """Return the way that a vector points."""
        angle = float(np.degrees(np.angle(vector))) % 360.0
        for quarter, phrase in QUARTERS.items():
            if abs((angle - quarter + 180.0) % 360.0 - 180.0) < STRAIGHT:
                return str(getattr(self.said, phrase))
        return self.said.way_angle.format(angle=given(angle, self.words, 4))

    def base(self, edge: Edge) -> str:
        """Return what the direction of a force is told by: ``BC`` of ``∥ BC``."""
        assert edge.direction is not None
        return self.names.base(edge.direction)


def closed(lines: Sequence[str]) -> list[str]:
    """Return the parts of a list with semicolons between them and a full stop at the end."""
    return [*(f"{line};" for line in lines[:-1]), *(f"{line}." for line in lines[-1:])]
