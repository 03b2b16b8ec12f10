"""Common base of the narrators of the force analysis (общее для глав о силах)."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from msgspec.structs import replace

from planmethod.construct.steps import Name, Step
from planmethod.note.document import Equation
from planmethod.note.formula import fraction
from planmethod.note.narrate.equations import Directed, term_of
from planmethod.note.narrate.formulas import Formulas
from planmethod.note.narrate.naming import Names
from planmethod.note.numbers import MINUS
from planmethod.note.wording import Language
from planmethod.plans.forces.polygons import Balance, Edge
from planmethod.plans.model import KnownParts, PlanKind
from planmethod.solved.forces.reading import ForceReading

QUARTERS = {0.0: "way_right", 90.0: "way_up", 180.0: "way_left", 270.0: "way_down"}
STRAIGHT = 1e-6
"""Degrees by which a direction may differ from the vertical or horizontal that it is called."""


class ForceContext:
    """Context shared by the narrators of the force analysis: a reading, names, a language.

    Given values and those of tables are exact; all others are read by hand: arms measured with the
    ruler, forces read on one plan and carried over into the next.
    """

    def __init__(self, reading: ForceReading, formulas: Formulas) -> None:
        self.reading, self.solution, self.formulas = reading, reading.solution, formulas
        self.names: Names = formulas.names
        self.note_texts, self.language, self.notation = (
            formulas.texts,
            formulas.language,
            formulas.notation,
        )
        self.texts, self.units = self.language.forces, self.notation.units
        self.computed, self.short, self.measured = (
            self.notation.computed,
            self.notation.short,
            self.notation.measured,
        )
        self.symbol = self.notation.symbol
        self.step: dict[Name, Step] = {s.out: s for s in reading.statics.program.steps}

    def sense(self, value: float) -> str:
        """Return the sense of a moment."""
        return self.note_texts.ccw if value > 0 else self.note_texts.cw

    def exactly(self, value: float) -> str:
        """Return the exact value in brackets."""
        return self.formulas.exactly(abs(value))

    def scaled(self, text: str, per_mm: float, *, back: bool = False) -> str:
        """Return millimetres times the scale of their drawing, or over it: ``70,0·250``.

        ``back``: convert to millimetres there.
        """
        is_inverse = self.names.is_inverse_scale()
        scale = self.short(1.0 / per_mm if is_inverse else per_mm)
        return f"{text}·{scale}" if is_inverse is back else fraction(text, scale)

    def on_drawing(self, text: str) -> str:
        """Return millimetres of the position plan as metres."""
        return self.scaled(text, self.formulas.per_mm(PlanKind.POSITION))

    def direction_phrase(self, vector: complex) -> str:
        """Return the phrase for the direction of a vector."""
        angle = float(np.degrees(np.angle(vector))) % 360.0
        for quarter, phrase in QUARTERS.items():
            if abs((angle - quarter + 180.0) % 360.0 - 180.0) < STRAIGHT:
                return str(getattr(self.texts, phrase))
        return self.texts.way_angle.format(angle=self.short(angle, 4))

    def base(self, edge: Edge) -> str:
        """Return the line that defines the direction of a force: ``BC`` of ``∥ BC``."""
        assert edge.direction is not None
        return self.names.base(edge.direction)


def balance_equation(balance: Balance, context: ForceContext, directed: Directed) -> Equation:
    """Return the sum of the forces on a link or a group, without known ones that are zero."""
    terms = (
        term_of(replace(edge, symbol=context.symbol(edge.symbol)), directed)
        for edge in balance.edges
        if edge.known is not KnownParts.BOTH or not context.reading.is_negligible(edge)
    )
    return Equation(tuple(terms), name=f"Σ_{{{','.join(balance.links)}}}\\bar{{F}}")


def lettered(reading: ForceReading, language: Language) -> ForceContext:
    """Return the shared context of the narrators for a sheet."""
    names = Names(reading.solution, language.note, on_sheet=True)
    return ForceContext(reading, Formulas(reading.solution, names, reading.index))


def closed(lines: Sequence[str]) -> list[str]:
    """Return the parts of a list with semicolons between them and a full stop at the end."""
    return [*(f"{line};" for line in lines[:-1]), *(f"{line}." for line in lines[-1:])]


def arm_symbol(symbol: str) -> str:
    """Return the letter of a force's arm: ``h_{G2}`` of ``G_{2}``."""
    return f"h_{{{re.sub(r'[_^{},]', '', symbol)}}}"


def signed_sum(terms: Sequence[tuple[float, str]]) -> str:
    """Return terms with their signs; a positive one first, if there is any."""
    ordered = sorted(terms, key=lambda term: term[0] < 0)
    text = ""
    for value, term in ordered:
        sign = MINUS if value < 0 else "+"
        text += f" {sign} {term}" if text else (f"{MINUS}{term}" if value < 0 else term)
    return text
