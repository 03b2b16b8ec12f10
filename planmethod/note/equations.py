"""Vector equations in plain text, with the textbook's underlines (векторные уравнения)."""

from __future__ import annotations

import re

from planmethod.note.naming import Names
from planmethod.note.plaintext import pad, plain_text, width
from planmethod.plans.model import Known, Vector, VectorEquation

_MARKUP = re.compile(r"_\{|\}")
_LINE = {Known.NOTHING: " ", Known.ONE: "─", Known.BOTH: "═"}


def note_text(names: Names, note: str) -> str:
    """Return a direction note with links called as their lengths are: ``⊥ CB`` gives ``⊥ BC``."""
    plain = _MARKUP.sub("", note)  # in words a point is called O1, not O₁
    sign, space, base = plain.partition(" ")
    return f"{sign} {names.axis(base)}" if space and sign in "⊥∥" else plain


def equation_lines(equation: VectorEquation, names: Names) -> list[str]:
    """Return an equation, its underlines and the directions under the terms: three lines."""
    rows = ["", "", ""]

    def term(vector: Vector) -> None:
        symbol, note = plain_text(vector.symbol), note_text(names, vector.note)
        columns = max(width(symbol), width(note))
        rule = _LINE[vector.known] * width(symbol)
        for i, text in enumerate((symbol, rule, note)):
            rows[i] += pad(text, columns)

    term(equation.left)
    for number, vector in enumerate(equation.right):
        for i, text in enumerate((" + " if number else " = ", "   ", "   ")):
            rows[i] += text
        term(vector)
    return [text for row in rows if (text := row.rstrip())]
