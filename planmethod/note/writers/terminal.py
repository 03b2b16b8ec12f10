"""A document as plain text for a terminal: the only place that wraps lines (простой текст)."""

from __future__ import annotations

import re
import textwrap
import unicodedata
from collections.abc import Iterator, Sequence
from typing import assert_never

from planmethod.note import document
from planmethod.note.document import NO_BREAK, Document, Equation, Table, Term, plain_text
from planmethod.note.wording import Language

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

_HEADINGS = (document.Chapter, document.Part, document.Subpart, document.StructuralHeading)
_UNLIKE_STEPS = (document.Table, document.Item, document.Equations)
_BODY = (document.Table, document.Step, document.Equations, document.Item, document.Note)


def plain_document(written: Document, language: Language) -> str:
    """Return a document as lines of at most `WIDTH` columns."""
    return "\n".join(TerminalWriter(language).lines(written)).replace(NO_BREAK, " ")


class TerminalWriter:
    """Writes nodes one after another, and numbers chapters, parts and steps."""

    def __init__(self, language: Language) -> None:
        units = {
            name for unit in language.note["units"].values() for name in re.findall(_WORD, unit)
        }
        self._language = language
        self._unit = rf"(?<=\d) (?=(?:{'|'.join(sorted(units))})(?![^\W\d_]))"
        self._step = 0
        self._dot = "."  # after the number of a heading; the headings of a note have none
        self._below = ""  # indent of the items of a caption

    def lines(self, written: Document) -> list[str]:
        """Return the lines of a document."""
        lines: list[str] = []
        before: document.Node | None = None
        written = document.resolve_references(written)
        if any(isinstance(n, document.TitlePage | document.Contents) for n in written.nodes):
            self._dot = ""
        for node, number in document.numbers_of(written):
            if lines and lines[-1] and self._has_blank_before(node, before):
                lines.append("")
            if isinstance(node, document.Contents):
                lines += self._contents(written)
            else:
                lines += self._node(node, number)
            before = node
            if not isinstance(node, document.Item):
                self._below = HANGING if isinstance(node, document.Caption) else ""
        return lines

    def _contents(self, written: Document) -> list[str]:
        lines = heading(self._language.document.contents)
        for level, number, title in document.headings_of(written):
            lead = INDENT[: 2 * (level - 1)] + (f"{number} " if number else "")
            lines += wrap(self._plain_text(title), first=lead, rest=" " * len(lead))
        return lines

    def _has_blank_before(self, node: document.Node, before: document.Node | None) -> bool:
        """Return whether a blank line precedes a node."""
        after: tuple[type, ...]
        match node:
            case (
                document.Chapter()
                | document.Part()
                | document.Subpart()
                | document.Caption()
                | document.StructuralHeading()
                | document.Contents()
            ):
                return True
            case document.Table():
                after = (*_HEADINGS, document.Table, document.Paragraph, document.Formula)
            case document.Equations():
                after = (*_HEADINGS, document.Caption)
            case document.Item():
                after = (*_HEADINGS, document.Table, document.Step, document.Equations)
            case document.Paragraph():
                after = (*_HEADINGS, *_BODY)
            case document.Step():
                after = (*_HEADINGS, *_UNLIKE_STEPS, document.Formula)
            case document.Formula():
                after = (*_HEADINGS, *_UNLIKE_STEPS)
            case _:
                return False
        return isinstance(before, after)

    def _node(self, node: document.Node, number: str) -> list[str]:
        match node:
            case document.Title(text):
                return heading(plain_text(text), "═")
            case document.TitlePage():
                texts = document.lines_of(node, self._language.document)
                return [line for text in texts for line in wrap(self._plain_text(text))]
            case document.Contents() | document.PageBreak():
                return []
            case document.Chapter(title) | document.StructuralHeading(title):
                return heading((f"{number}{self._dot} " if number else "") + plain_text(title))
            case document.Part(title) | document.Subpart(title):
                return [f"{number}{self._dot} {plain_text(title)}"]
            case document.Caption(text):
                return wrap(self._plain_text(text))
            case document.Paragraph(text) | document.Note(text):
                return wrap(self._plain_text(text))
            case document.Item(text, label):
                lead = f"{HANGING}{pad(plain_text(label), LABEL, right=True)}  " if label else ""
                lead = lead or self._below
                rest = " " * width(lead) if label else lead + HANGING
                return wrap(self._plain_text(text), first=lead, rest=rest)
            case document.Step(lines, continues):
                return self._stepped(lines, continues=continues)
            case document.Formula(text):
                last = f"{NO_BREAK * 4}({number})" if number else ""
                return wrap(self._plain_text(text) + last, first=INDENT, rest=INDENT)
            case document.Equations(equations):
                return self._equations(equations) + [f"{INDENT}({number})"] * bool(number)
            case document.Table(name=name):
                return (self._caption("table", number, name) if name else []) + _tabulated(node)
            case document.Figure(caption=caption):
                return self._caption("figure", number, caption)
            case document.References(entries):
                return [
                    line
                    for k, entry in enumerate(entries, 1)
                    for line in wrap(self._plain_text(entry), first=f"{k:>3}. ", rest=INDENT)
                ]
            case _:
                assert_never(node)

    def _plain_text(self, rich: str) -> str:
        """Return rich text as plain, its numbers tied to their units."""
        return re.sub(self._unit, NO_BREAK, plain_text(rich))

    def _caption(self, kind: str, number: str, text: str) -> list[str]:
        # Only a numbered caption needs words before its number.
        text = self._language.document[kind].format(number=number, text=text) if number else text
        return wrap(self._plain_text(text))

    def _stepped(self, lines: Sequence[str], *, continues: bool) -> list[str]:
        self._step += not continues
        found = []
        for number, line in enumerate(lines):
            first = INDENT if number or continues else f"{self._step:>3}) "
            found += wrap(self._plain_text(line), first=first, rest=INDENT)
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
