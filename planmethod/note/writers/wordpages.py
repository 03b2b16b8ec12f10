"""About on which page of a document of Word something will stand (номера страниц до Word)."""

from __future__ import annotations

from math import ceil

from planmethod.note.formula import Rich
from planmethod.note.plaintext import plain_text
from planmethod.note.writers.html import clean
from planmethod.note.writers.wordstyles import INDENT, MM_PER_POINT, SIZE


def plain(rich: Rich) -> str:
    """Return rich text as plain, without control signs."""
    return plain_text(clean(rich))


class PageFlow:
    """Tells about on which page something will stand, until Word has set the pages itself."""

    LINE = SIZE * 1.15 * 1.5 * MM_PER_POINT
    """Height of a line, mm."""

    def __init__(self, room: float) -> None:
        self.page, self._room, self._used = 1, room, 0.0

    def turn(self) -> None:
        """Begin a page."""
        self.page, self._used = self.page + bool(self._used), 0.0

    def put(self, height: float) -> None:
        """Take so many mm for what stands on one page."""
        if self._used + height > self._room:
            self.turn()
        self._used += height

    def text(self, rich: Rich, width: float) -> None:
        """Take room for a paragraph."""
        letters = 0.49 * SIZE * MM_PER_POINT * len(plain(rich)) + INDENT
        for line in range(ceil(letters / width)):
            self.put(self.LINE + (4.0 if not line and "\\frac{" in rich else 0.0))

    def heading(self) -> None:
        """Take room for a heading, which stands with what follows."""
        if self._used + 3 * self.LINE > self._room:
            self.turn()
        self.put(self.LINE + 5.6)
