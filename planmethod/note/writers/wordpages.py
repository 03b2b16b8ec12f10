"""About on which page of a document of Word something will stand (номера страниц до Word)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from math import ceil
from typing import TypeAlias

from planmethod.note import document
from planmethod.note.document import Figure, Node
from planmethod.note.formula import Rich
from planmethod.note.plaintext import plain_text
from planmethod.note.writers.html import clean
from planmethod.note.writers.sentences import leads
from planmethod.note.writers.wordstyles import INDENT, MM_PER_POINT, SIZE

Told: TypeAlias = tuple[tuple[Node, str], Node | None]
"""A node with its number, and what follows it."""

MOST = 12
"""Paragraphs and formulas that may go before a figure that has no room, at the most."""

_FLOWS = (
    document.Paragraph,
    document.Item,
    document.Step,
    document.Formula,
    document.Equations,
    document.Note,
)  # text that may go before a figure


def flowing(
    told: Iterable[Told], flow: PageFlow, height: Callable[[Figure], float]
) -> Iterator[Told]:
    """Yield nodes; a figure that has no room on the page lets the text after it go before.

    It waits until the text has filled the page, and no longer than to what is no text. ``height``
    tells what a figure takes with its name, mm.
    """
    waiting: Told | None = None
    page = passed = 0
    led = False
    for one in told:
        (node, _), after = one
        is_full = flow.page > page or passed >= MOST
        if waiting and (not isinstance(node, _FLOWS) or (is_full and not led)):
            yield waiting
            waiting = None
        if isinstance(node, Figure) and isinstance(after, _FLOWS) and not flow.has(height(node)):
            waiting, page, passed = one, flow.page, 0
            continue
        passed, led = passed + 1, leads(node, after)
        yield one
    if waiting:
        yield waiting


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

    def has(self, height: float) -> bool:
        """Tell whether so many mm are left of the page, or the page is empty."""
        return not self._used or self._used + height <= self._room

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
