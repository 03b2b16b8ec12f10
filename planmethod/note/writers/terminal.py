"""A document as plain text for a terminal: the only place that wraps lines (простой текст)."""

from __future__ import annotations

import re
import textwrap
import unicodedata
from collections.abc import Iterator, Sequence
from typing import assert_never

from planmethod.note.document import (
    NO_BREAK,
    Document,
    Equation,
    PageBreak,
    Table,
    Term,
    plain_text,
)
from planmethod.note.wording import Language
from planmethod.note.writers import lowering
from planmethod.note.writers.lowering import LoweredNode, TextKind, lower

WIDTH = 100
"""Columns of the terminal that every table and paragraph keeps to."""

GAP = "  "

INDENT = " " * 5
"""Indent of the lines of a step, under its number."""

HANGING = " " * 2
"""Indent of the further lines of an item."""

LABEL = 5
"""Columns of the label of an item."""

_LINES = (" ", "─", "═")

_ANY = ("title", "cover", "page break", "heading", "contents", "table", "figure", "formula",
        "equations", *(kind.value for kind in TextKind))  # fmt: skip
_UNLIKE_STEPS = ("table", "item", "equations")
_BLANK_AFTER = {
    "heading": _ANY,
    "contents": _ANY,
    "caption": _ANY,
    "table": ("heading", "table", "paragraph", "formula"),
    "equations": ("heading", "caption", "equations"),
    "item": ("heading", "table", "step", "equations"),
    "paragraph": ("heading", "step", "note", *_UNLIKE_STEPS),
    "step": ("heading", "formula", *_UNLIKE_STEPS),
    "formula": ("heading", *_UNLIKE_STEPS),
}
"""By the kind of a node: the kinds before it that a blank line parts it from."""


def plain_document(written: Document, language: Language) -> str:
    """Return a document as lines of at most `WIDTH` columns."""
    return "\n".join(TerminalWriter(language).lines(written)).replace(NO_BREAK, " ")


class TerminalWriter:
    """Writes nodes one after another."""

    def __init__(self, language: Language) -> None:
        units = {
            name for unit in language.note["units"].values() for name in re.findall(_WORD, unit)
        }
        self._language = language
        self._unit = rf"(?<=\d) (?=(?:{'|'.join(sorted(units))})(?![^\W\d_]))"
        self._dot = "."  # after the number of a heading; the headings of a note have none
        self._below = ""  # indent of the items of a caption

    def lines(self, written: Document) -> list[str]:
        """Return the lines of a document."""
        lines: list[str] = []
        before = ""
        lowered = lower(written, self._language)
        self._dot = "" if lowered.is_note else "."
        for node in lowered.nodes:
            kind = _kind_of(node)
            if lines and lines[-1] and before in _BLANK_AFTER.get(kind, ()):
                lines.append("")
            lines += self._node(node)
            before = kind
            if kind != "item":
                self._below = HANGING if kind == "caption" else ""
        return lines

    def _node(self, node: LoweredNode) -> list[str]:
        match node:
            case lowering.Cover(lines=lines):
                return [line for text in lines for line in wrap(self._plain_text(text))]
            case lowering.Heading(text, 0):
                return heading(plain_text(text), "═")
            case lowering.Heading(text, level, number):
                line = (f"{number}{self._dot} " if number else "") + plain_text(text)
                return heading(line) if level == 1 else [line]
            case lowering.ContentsList(title, headings):
                return heading(title) + [line for one in headings for line in self._listed(one)]
            case PageBreak():
                return []
            case lowering.Text():
                return self._text(node)
            case lowering.DisplayedFormula(text, number):
                last = f"{NO_BREAK * 4}({number})" if number else ""
                return wrap(self._plain_text(text) + last, first=INDENT, rest=INDENT)
            case lowering.DisplayedEquations(equations, number):
                first, *rest = self._equations(equations)
                beside = f"{first}   ({number})"
                if number and len(equations) == 1 and width(beside) <= WIDTH:
                    return [beside, *rest]
                return [first, *rest] + [f"{INDENT}({number})"] * bool(number)
            case lowering.NamedTable(table, name):
                return (wrap(self._plain_text(name)) if name else []) + _tabulated(table)
            case lowering.NamedFigure(name=name):
                return wrap(self._plain_text(name))
            case _:
                assert_never(node)

    def _text(self, node: lowering.Text) -> list[str]:
        match node.kind:
            case TextKind.STEP:
                first, rest = f"{node.mark:>3}) " if node.mark else INDENT, INDENT
            case TextKind.SOURCE:
                first, rest = f"{node.mark:>3}. ", INDENT
            case TextKind.ITEM if node.mark:
                first = f"{HANGING}{pad(plain_text(node.mark), LABEL, right=True)}  "
                rest = " " * width(first)
            case TextKind.ITEM:
                first, rest = self._below, self._below + HANGING
            case TextKind.PARAGRAPH | TextKind.CAPTION | TextKind.NOTE:
                first = rest = ""
            case _:
                assert_never(node.kind)
        lines: list[str] = []
        for text in node.lines:
            lines += wrap(self._plain_text(text), first=rest if lines else first, rest=rest)
        return lines

    def _listed(self, one: lowering.Heading) -> list[str]:
        lead = INDENT[: 2 * (one.level - 1)] + (f"{one.number} " if one.number else "")
        return wrap(self._plain_text(one.text), first=lead, rest=" " * len(lead))

    def _plain_text(self, rich: str) -> str:
        """Return rich text as plain, its numbers tied to their units."""
        return re.sub(self._unit, NO_BREAK, plain_text(rich))

    def _equations(self, equations: Sequence[Equation]) -> list[str]:
        lines: list[str] = []
        for equation in equations:
            own = [f"{INDENT}{line}" for line in equation_lines(equation)]
            lines += [*([""] if lines else []), *own]
        return lines


def _kind_of(node: LoweredNode) -> str:
    """Return the kind of a node by which blank lines are put."""
    match node:
        case lowering.Text(kind=kind):
            return kind.value
        case lowering.Heading(level=level):
            return "heading" if level else "title"
        case lowering.DisplayedFormula():
            return "formula"
        case lowering.DisplayedEquations():
            return "equations"
        case lowering.Cover():
            return "cover"
        case lowering.ContentsList():
            return "contents"
        case PageBreak():
            return "page break"
        case lowering.NamedTable():
            return "table"
        case lowering.NamedFigure():
            return "figure"
        case _:
            assert_never(node)


_WORD = r"^[^\W\d_]+"
"""Letters that a unit begins with: between a number and them no line is cut."""


def _tabulated(node: Table) -> list[str]:
    """Return the lines of a table, cut where it may be and is too wide."""
    head = [plain_text(cell) for cell in node.head]
    rows = [[plain_text(cell) for cell in row] for row in node.rows]
    if node.repeated:
        return columns_text(list(zip(head, *rows, strict=True)), node.repeated)
    return table(head, rows, left=node.names)


# Lines and tables --------------------------------------------------------------------------------


def width(text: str) -> int:
    """Return the width of a text in columns of a terminal."""
    columns = 0
    for char in text:
        if not unicodedata.combining(char):
            columns += 2 if unicodedata.east_asian_width(char) in "WF" else 1
    return columns


def pad(text: str, columns: int, *, right: bool = False) -> str:
    """Return a text padded with spaces to a number of columns."""
    space = " " * max(0, columns - width(text))
    return space + text if right else text + space


def wrap(text: str, *, first: str = "", rest: str = "") -> list[str]:
    """Return a paragraph cut into lines, never within a word or at a no-break space."""
    lines = textwrap.wrap(
        text,
        WIDTH,
        initial_indent=first,
        subsequent_indent=rest,
        break_long_words=False,
        break_on_hyphens=False,
    )
    return [line.replace(NO_BREAK, " ") for line in lines]


def table(header: Sequence[str], rows: Sequence[Sequence[str]], *, left: int = 1) -> list[str]:
    """Return an aligned table: the first ``left`` columns to the left, the others to the right."""
    columns = list(zip(header, *rows, strict=True))
    widths = [max(width(cell) for cell in column) for column in columns]

    def line(cells: Sequence[str]) -> str:
        padded = (
            pad(cell, size, right=i >= left)
            for i, (cell, size) in enumerate(zip(cells, widths, strict=True))
        )
        return GAP.join(padded).rstrip()

    rule = "─" * (sum(widths) + len(GAP) * (len(widths) - 1))
    return [line(header), rule, *(line(row) for row in rows)]


def cut(columns: Sequence[Sequence[str]], lead: int) -> Iterator[list[Sequence[str]]]:
    """Cut columns (header and cells each) into tables that fit, each with the leading columns."""
    sizes = [max(width(cell) for cell in column) + len(GAP) for column in columns]
    start = sum(sizes[:lead])
    part, total = list(columns[:lead]), start
    for column, size in zip(columns[lead:], sizes[lead:], strict=True):
        if total + size > WIDTH + len(GAP) and len(part) > lead:
            yield part
            part, total = list(columns[:lead]), start
        part.append(column)
        total += size
    if len(part) > lead:
        yield part


def columns_text(columns: Sequence[Sequence[str]], lead: int) -> list[str]:
    """Return columns as tables one under another, a blank line between."""
    lines: list[str] = []
    for part in cut(columns, lead):
        header = [column[0] for column in part]
        rows = list(zip(*(column[1:] for column in part), strict=True))
        lines += [*([""] if lines else []), *table(header, rows, left=0)]
    return lines


def heading(text: str, rule: str = "─") -> list[str]:
    """Return a heading and the line under it."""
    return [text, rule * width(text)]


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
            lines += _nonempty(rows)
            rows, sign = ["", "", ""], sign.lstrip()
        for k, (lead, cell) in enumerate(zip((sign, "", ""), cells, strict=True)):
            rows[k] += pad(lead, width(sign)) + pad(cell, max(map(width, cells)))
    if not equation.right:
        rows[0] += " = 0"
    return [*lines, *_nonempty(rows)]


def _nonempty(rows: Sequence[str]) -> Iterator[str]:
    """Yield the rows that have something."""
    yield from (text for row in rows if (text := row.rstrip()))


def _cells(term: Term) -> tuple[str, str, str]:
    """Return symbol, underline and direction of a term."""
    symbol = plain_text(term.symbol)
    return symbol, _LINES[term.underlines] * width(symbol), plain_text(term.direction)
