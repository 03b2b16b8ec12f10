"""A document as plain text for a terminal: the only place that wraps lines (простой текст)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import assert_never

from planmethod.note import document
from planmethod.note.document import Document, Equation, Table, Term
from planmethod.note.plaintext import (
    NO_BREAK,
    WIDTH,
    columns_text,
    heading,
    pad,
    plain_text,
    table,
    width,
    wrap,
)
from planmethod.note.wording import Language

INDENT = " " * 5
"""What stands before the lines of a step, under its number."""

HANGING = " " * 2
"""What stands before the further lines of an item."""

_LINES = (" ", "─", "═")


def plain_document(written: Document, words: Language) -> str:
    """Return a document as lines of at most `WIDTH` columns."""
    return "\n".join(PlainWriter(words).lines(written))


class PlainWriter:
    """Writes nodes one after another, and numbers chapters, parts and steps."""

    def __init__(self, words: Language) -> None:
        units = {name for unit in words.note.units.values() for name in re.findall(_WORD, unit)}
        self._unit = rf"(?<=\d) (?=(?:{'|'.join(sorted(units))})(?![^\W\d_]))"
        self._chapter = self._part = self._step = 0

    def lines(self, written: Document) -> list[str]:
        """Return the lines of a document."""
        lines: list[str] = []
        before: document.Node | None = None
        for node in written.nodes:
            if lines and lines[-1] and self._stands_apart(node, before):
                lines.append("")
            lines += self._node(node)
            before = node
        return lines

    def _stands_apart(self, node: document.Node, before: document.Node | None) -> bool:
        """Tell whether a blank line stands before a node."""
        if isinstance(before, document.Chapter) and before.numbered:
            return True
        match node:
            case document.Chapter() | document.Part() | document.Caption():
                return True
            case document.Table():
                return isinstance(before, document.Table | document.Formula)
            case document.Step() if isinstance(before, document.Formula):
                return True
            case document.Equations() | document.Step() | document.Formula():
                return isinstance(before, document.Chapter | document.Part | document.Equations)
            case document.Paragraph():
                return isinstance(before, document.Table | document.Step | document.Equations)
            case _:
                return False

    def _node(self, node: document.Node) -> list[str]:
        match node:
            case document.Title(text):
                return heading(plain_text(text), "═")
            case document.Chapter(title, numbered):
                self._part = 0
                self._chapter += numbered
                number = f"{self._chapter}. " if numbered else ""
                return heading(number + plain_text(title))
            case document.Part(title):
                self._part += 1
                return [f"{self._chapter}.{self._part}. {plain_text(title)}"]
            case document.Caption(text):
                return wrap(self._whole(text))
            case document.Paragraph(text) | document.Note(text):
                return wrap(self._whole(text))
            case document.Item(text):
                return wrap(self._whole(text), rest=HANGING)
            case document.Step(lines, continues):
                return self._stepped(lines, continues=continues)
            case document.Formula(text):
                return wrap(self._whole(text), first=INDENT, rest=INDENT)
            case document.Equations(equations):
                return self._equations(equations)
            case document.Table():
                return _tabulated(node)
            case document.Figure(_, caption):
                return wrap(self._whole(caption)) if caption else []
            case _:
                assert_never(node)

    def _whole(self, rich: str) -> str:
        """Return rich text as plain, its numbers tied to their units."""
        return re.sub(self._unit, NO_BREAK, plain_text(rich))

    def _stepped(self, lines: Sequence[str], *, continues: bool) -> list[str]:
        self._step += not continues
        found = []
        for number, line in enumerate(lines):
            first = INDENT if number or continues else f"{self._step:>3}) "
            found += wrap(self._whole(line), first=first, rest=INDENT)
        return found

    def _equations(self, equations: Sequence[Equation]) -> list[str]:
        lines: list[str] = []
        for equation in equations:
            own = [f"{INDENT}{line}" for line in equation_lines(equation)]
            lines += [*([""] if lines else []), *own]
        return lines


_WORD = r"^[^\W\d_]+"
"""Letters that a unit begins with: between a number and them no line is cut."""


def _tabulated(node: Table) -> list[str]:
    """Return the lines of a table; one that may be cut is so where it is too wide."""
    head = [plain_text(cell) for cell in node.head]
    rows = [[plain_text(cell) for cell in row] for row in node.rows]
    if node.repeated:
        return columns_text(list(zip(head, *rows, strict=True)), node.repeated)
    return table(head, rows, left=node.names)


# Equations ---------------------------------------------------------------------------------------


def equation_lines(equation: Equation, columns: int = WIDTH - len(INDENT)) -> list[str]:
    """Return an equation, its underlines and the directions below the terms: three lines a row.

    Where it is cut, the sign is repeated, as in print.
    """
    terms = [*equation.left, *equation.right]
    lines: list[str] = []
    rows = ["", "", ""]
    for number, term in enumerate(terms):
        sign = " = " if number == len(equation.left) else " + " if number else ""
        cells = _cells(term)
        if rows[0] and width(rows[0] + sign) + max(map(width, cells)) > columns - len(" = "):
            rows[0] += sign.rstrip()
            lines += _shown(rows)
            rows, sign = ["", "", ""], sign.lstrip()
        for k, (lead, cell) in enumerate(zip((sign, "", ""), cells, strict=True)):
            rows[k] += pad(lead, width(sign)) + pad(cell, max(map(width, cells)))
    if not equation.right:
        rows[0] += " = 0"
    return [*lines, *_shown(rows)]


def _shown(rows: Sequence[str]) -> Iterator[str]:
    """Yield the rows that have something."""
    yield from (text for row in rows if (text := row.rstrip()))


def _cells(term: Term) -> tuple[str, str, str]:
    """Return symbol, underline and direction of a term."""
    symbol = plain_text(term.symbol)
    return symbol, _LINES[term.underlines] * width(symbol), plain_text(term.direction)
