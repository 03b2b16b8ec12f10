"""Plain text for a terminal or a note: rich text made plain, wrapping, tables, numbered steps."""

from __future__ import annotations

import re
import textwrap
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from planmethod.note.numbers import Notation, rich_number, significant, trimmed
from planmethod.pattern import pattern

if TYPE_CHECKING:
    from planmethod.note.wording.model import Wording


WIDTH = 100
"""Columns of the terminal that every table and paragraph keeps to."""

GAP = "  "

NO_BREAK = "\N{NO-BREAK SPACE}"
"""Space at which a line is not cut; the finished text has plain spaces."""

_SUPER = dict(zip("0123456789-−ntτkr", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁻ⁿᵗᵗᵏʳ", strict=True))
_SUB = dict(zip("0123456789", "₀₁₂₃₄₅₆₇₈₉", strict=True))
_UP = pattern(r"\^\{([^}]*)\}")
_DOWN = pattern(r"_\{([^}]*)\}")
_LITERAL = pattern(r"\\([_^{}\\])")


def plain_text(rich: str) -> str:
    """Return rich text as plain: ``ω_{2}`` gives ``ω₂``, ``a^{n}_{CB}`` gives ``aⁿ_CB``."""

    def up(match: re.Match[str]) -> str:
        return "".join(_SUPER.get(c, c) for c in match[1])

    def down(match: re.Match[str]) -> str:
        text = match[1]
        if not text:
            return ""
        return "".join(_SUB[c] for c in text) if all(c in _SUB for c in text) else f"_{text}"

    return _LITERAL.sub(r"\1", _DOWN.sub(down, _UP.sub(up, rich)))


def spoken(text: str, words: Wording) -> str:
    """Return a number with a decimal point as the language writes it."""
    return plain_text(rich_number(text, words.decimal))


def found(value: float, words: Wording) -> str:
    """Return a result, four significant digits."""
    return spoken(significant(value), words)


def given(value: float, words: Wording, digits: int | None = None) -> str:
    """Return a given number, no more digits than it has."""
    return spoken(trimmed(value, digits), words)


def fixed(value: float, words: Wording, places: int = 2) -> str:
    """Return a number with so many digits after the decimal sign."""
    return spoken(f"{value + 0.0:.{places}f}", words)


def width(text: str) -> int:
    """Return how many columns a terminal needs for a text."""
    columns = 0
    for char in text:
        if not unicodedata.combining(char):
            columns += 2 if unicodedata.east_asian_width(char) in "WF" else 1
    return columns


def pad(text: str, columns: int, *, right: bool = False) -> str:
    """Return a text filled with spaces up to so many columns."""
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


def plain_columns(
    columns: Iterable[tuple[str, str, Sequence[str]]], say: Notation
) -> Iterator[list[str]]:
    """Yield columns of head, unit of SI or none, and cells: the unit stands in the head."""
    for head, unit, cells in columns:
        told = f"{head}, {say.in_head(unit)}" if unit else head
        yield [plain_text(told), *map(plain_text, cells)]


INDENT = " " * 5
"""What stands before the lines of a step, under its number."""

_WORD = pattern(r"^[^\W\d_]+")
"""Letters that a unit begins with: between a number and them no line is cut."""


class Steps:
    """Plain text while it is being written: headings, and steps numbered through all of them."""

    def __init__(self, words: Wording) -> None:
        self.lines: list[str] = []
        units = "|".join(name for unit in words.units.values() for name in _WORD.findall(unit))
        self._unit = pattern(rf"(?<=\d) (?=(?:{units})(?![^\W\d_]))")
        self._step = self._chapter = self._part = 0

    def chapter(self, title: str) -> None:
        """Begin a chapter."""
        self._chapter, self._part = self._chapter + 1, 0
        self.lines += ["", *heading(f"{self._chapter}. {title}"), ""]

    def part(self, title: str) -> None:
        """Begin a part of the chapter."""
        self._part += 1
        blank = [] if self.lines[-1] == "" else [""]
        self.lines += [*blank, f"{self._chapter}.{self._part}. {title}", ""]

    def item(self, lines: Sequence[str], *, more: bool = False) -> None:
        """Write a numbered step of rich text; ``more`` goes on with the last one."""
        if not lines:
            return
        if not more:
            self._step += 1
        for i, line in enumerate(lines):
            first = f"{self._step:>3}) " if i == 0 and not more else INDENT
            text = self._unit.sub(NO_BREAK, plain_text(line))
            self.lines += wrap(text, first=first, rest=INDENT)

    def formulas(self, lines: Sequence[str]) -> None:
        """Write lines that must not be wrapped, such as an equation over its underlines."""
        self.lines += [*(f"{INDENT}{line}" for line in lines), ""]
