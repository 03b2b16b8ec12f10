"""Vector equations in plain text, with the textbook's underlines (векторные уравнения)."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.note.narrate.letters import SIGN
from planmethod.note.narrate.naming import Names
from planmethod.note.plaintext import given, pad, plain_text, width
from planmethod.plans.forces.polygons import Edge
from planmethod.plans.model import Direction, Known, Relation, Vector, VectorEquation

_LINE = {Known.NOTHING: " ", Known.ONE: "─", Known.BOTH: "═"}


def direction_note(names: Names, direction: Direction | None) -> str:
    """Return a direction in plain text, links called as their lengths are: ``⊥ BC``."""
    if direction is None:
        return ""
    match direction.relation:
        case Relation.STILL:
            return "= 0"
        case Relation.TOWARDS:
            return " → ".join(direction.points)
        case Relation.ANGLED:
            angle = given(float(f"{direction.angle:.4g}"), names.words)
            return f"∠ {angle}° {''.join(direction.points)}"
        case Relation.ALONG | Relation.ACROSS:
            return f"{SIGN[direction.relation]} {names.base(direction)}"


def equation_lines(equation: VectorEquation, names: Names) -> list[str]:
    """Return an equation, its underlines and the directions under the terms: three lines."""
    rows = _Rows()
    rows.add("", _cells(names, equation.left))
    for number, vector in enumerate(equation.right):
        rows.add(" + " if number else " = ", _cells(names, vector))
    return rows.lines


def balance_lines(edges: Sequence[Edge], names: Names, columns: int) -> list[str]:
    """Return an equation of forces, which add up to nothing, in lines of so many columns.

    Where it is cut, the sign is repeated, as in print.
    """
    rows, lines = _Rows(), []
    for number, edge in enumerate(edges):
        cells = _cells(names, edge)
        if rows.columns + width(" + ") + max(map(width, cells)) > columns - width(" + "):
            lines += rows.ending(" +")
            rows = _Rows()
            rows.add("+ ", cells)
        else:
            rows.add(" + " if number else "", cells)
    return [*lines, *rows.ending(" = 0")]


class _Rows:
    """Symbols, the lines under them and the directions under those, being written."""

    def __init__(self) -> None:
        self._rows = ["", "", ""]

    def add(self, sign: str, cells: tuple[str, str, str]) -> None:
        """Add a term with the sign before it."""
        columns = max(map(width, cells))
        for i, (lead, text) in enumerate(zip((sign, "", ""), cells, strict=True)):
            self._rows[i] += pad(lead, width(sign)) + pad(text, columns)

    @property
    def columns(self) -> int:
        """How wide the rows are."""
        return width(self._rows[0])

    @property
    def lines(self) -> list[str]:
        """The rows that have something."""
        return [text for row in self._rows if (text := row.rstrip())]

    def ending(self, text: str) -> list[str]:
        """Return the rows, and how the first of them ends."""
        self._rows[0] += text
        return self.lines


def _cells(names: Names, term: Vector | Edge) -> tuple[str, str, str]:
    """Return symbol, underline and direction of a term."""
    symbol = plain_text(term.symbol)
    return symbol, _LINE[term.known] * width(symbol), direction_note(names, term.direction)
