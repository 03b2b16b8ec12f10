"""Plain text written step by step, for the kinds of problems that give no document yet."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.note.plaintext import NO_BREAK, plain_text
from planmethod.note.wording.model import Wording
from planmethod.note.writers.plain import INDENT, heading, wrap
from planmethod.pattern import pattern

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
