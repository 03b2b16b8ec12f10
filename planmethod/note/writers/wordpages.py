"""Estimate of the pages of a document before Word sets them (номера страниц до Word)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from math import ceil
from typing import TypeAlias

from planmethod.note import document
from planmethod.note.document import Figure, Node
from planmethod.note.formula import Rich
from planmethod.note.plaintext import plain_text
from planmethod.note.writers.html import without_control_characters
from planmethod.note.writers.sentences import introduces_next_node
from planmethod.note.writers.wordstyles import INDENT, MM_PER_POINT, SIZE

NumberedNode: TypeAlias = tuple[tuple[Node, str], Node | None]
"""A node with its number, and the next node."""

MAX_PASSED = 12
"""Largest number of paragraphs and formulas moved before a figure that does not fit."""

_FLOWS = (
    document.Paragraph,
    document.Item,
    document.Step,
    document.Formula,
    document.Equations,
    document.Note,
)  # text that may go before a figure


def flowing(
    numbered: Iterable[NumberedNode], flow: PageFlow, height: Callable[[Figure], float]
) -> Iterator[NumberedNode]:
    """Yield nodes; a figure that does not fit on the page lets the text after it go before.

    It waits until the text has filled the page, or until a node that is not text. ``height`` gives
    the height of a figure with its name, mm.
    """
    waiting: NumberedNode | None = None
    page = passed = 0
    led = False
    for one in numbered:
        (node, _), after = one
        is_full = flow.page > page or passed >= MAX_PASSED
        if waiting and (not isinstance(node, _FLOWS) or (is_full and not led)):
            yield waiting
            waiting = None
        if isinstance(node, Figure) and isinstance(after, _FLOWS) and not flow.has(height(node)):
            waiting, page, passed = one, flow.page, 0
            continue
        passed, led = passed + 1, introduces_next_node(node, after)
        yield one
    if waiting:
        yield waiting


def clean_text(rich: Rich) -> str:
    """Return rich text as plain, without control signs."""
    return plain_text(without_control_characters(rich))


class PageFlow:
    """Estimates on which page something will be, until Word has set the pages itself."""

    LINE = SIZE * 1.15 * 1.5 * MM_PER_POINT
    """Height of a line, mm."""

    def __init__(self, height: float) -> None:
        self.page, self._room, self._used = 1, height, 0.0

    def begin_page(self) -> None:
        """Begin a page."""
        self.page, self._used = self.page + bool(self._used), 0.0

    def has(self, height: float) -> bool:
        """Return whether a height in mm is left on the page, or the page is empty."""
        return not self._used or self._used + height <= self._room

    def reserve(self, height: float) -> None:
        """Reserve a height in mm on one page."""
        if self._used + height > self._room:
            self.begin_page()
        self._used += height

    def text(self, rich: Rich, width: float) -> None:
        """Reserve space for a paragraph."""
        letters = 0.49 * SIZE * MM_PER_POINT * len(clean_text(rich)) + INDENT
        for line in range(ceil(letters / width)):
            self.reserve(self.LINE + (4.0 if not line and "\\frac{" in rich else 0.0))

    def heading(self) -> None:
        """Reserve space for a heading, which stays with the next node."""
        if self._used + 3 * self.LINE > self._room:
            self.begin_page()
        self.reserve(self.LINE + 5.6)
