"""Documents of paragraphs and tables as PDF, in the project's own lettering (документы PDF).

A group has a page for each student, and a layout engine takes longer for them than all the rest:
words are measured once here, and lines broken where they are full.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from io import BytesIO
from typing import Any, TypeAlias

from reportlab.lib import colors
from reportlab.lib.pagesizes import A4, landscape
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfgen.canvas import Canvas

from planmethod.check.pages.speech import clean
from planmethod.render.backends.pdf import registered
from planmethod.render.ink.lettering import STYLES, OutlineLettering

Word: TypeAlias = tuple[tuple[str, str], ...]
"""Pieces of text without a space, each with its level: "", "_" or "^"."""

MM = 72.0 / 25.4
MARGIN = 12.0 * MM
LETTERING = OutlineLettering(STYLES["B-upright"])
TEXT, CELL, NOTE, HEADING = 9.5, 8.5, 8.0, 12.0
"""Sizes of letters, points."""

LEADING = 1.32
SMALL = 0.72
RISE = {"": 0.0, "_": -0.16, "^": 0.34}
PAD = 3.0
GREY = colors.HexColor("#8a8a8a")
RULE = colors.HexColor("#bbbbbb")
HEAD = colors.HexColor("#f4f4f4")
_INDEX = r"([_^])\{([^{}]*)\}"


@lru_cache(maxsize=10_000)
def _width(text: str) -> float:
    return float(pdfmetrics.stringWidth(text, registered(LETTERING), 1.0))


def _measured(word: Word, size: float) -> float:
    return sum(_width(text) * (size * SMALL if level else size) for text, level in word)


def _words(rich: str) -> Iterator[Word]:
    """Yield the words of rich text."""
    word: list[tuple[str, str]] = []
    start = 0
    text = clean(rich)
    for match in [*re.finditer(_INDEX, text), None]:
        plain = text[start : match.start() if match else len(text)]
        first, *others = plain.split(" ")
        word.append((first, ""))
        for other in others:
            yield tuple(piece for piece in word if piece[0])
            word = [(other, "")]
        if match:
            word.append((match[2], match[1]))
            start = match.end()
    yield tuple(piece for piece in word if piece[0])


@lru_cache(maxsize=10_000)
def broken(rich: str, size: float, width: float) -> tuple[tuple[Word, ...], ...]:
    """Return rich text as lines of words; a word that is too long for a line is cut."""
    lines: list[list[Word]] = [[]]
    left, space = width, _width(" ") * size
    for whole in _words(rich):
        for word in _fitting(whole, size, width):
            need = _measured(word, size)
            if lines[-1] and need + space > left:
                lines.append([])
                left = width
            left -= need + (space if lines[-1] else 0.0)
            lines[-1].append(word)
    return tuple(tuple(line) for line in lines)


def _fitting(word: Word, size: float, width: float) -> Iterator[Word]:
    if _measured(word, size) <= width:
        yield word
        return
    part: list[tuple[str, str]] = []
    for text, level in word:
        for letter in text:
            if part and _measured((*part, (letter, level)), size) > width:
                yield tuple(part)
                part = []
            part.append((letter, level))
    yield tuple(part)


class Document:
    """A PDF that is written from above to below; the same calls give the same bytes.

    Parameters
    ----------
    title : str
    wide : bool
        Whether the pages lie.
    foot : callable, optional
        Takes the number of a page and returns the line at its foot.
    """

    def __init__(
        self, title: str, *, wide: bool = False, foot: Callable[[int], str] | None = None
    ) -> None:
        self._file = BytesIO()
        size = landscape(A4) if wide else A4
        self.width, self._top = size[0] - 2 * MARGIN, size[1] - MARGIN
        # Without a font of its own a Helvetica that nobody uses stays in the file, not embedded.
        self.sheet: Any = Canvas(
            self._file,
            pagesize=size,
            invariant=1,
            pageCompression=1,
            initialFontName=registered(LETTERING),
        )
        self.sheet.setTitle(title)
        self.sheet.setAuthor("planmethod")
        self.sheet.setCreator("planmethod")
        self.sheet.setSubject("")
        self._foot = foot
        self._page = 1
        self._rules: list[float] = []
        self._text: Any = None
        self._size = self._rise = 0.0
        self.y = self._top

    def close(self) -> bytes:
        """Return the file."""
        self._end_page()
        self.sheet.save()
        return self._file.getvalue()

    def _end_page(self) -> None:
        self._put_text(colors.black)
        if self._foot is not None:
            line = broken(self._foot(self._page), 7.5, self.width)[0]
            self._draw(line, MARGIN, MARGIN * 0.5, 7.5)
            self._put_text(GREY)
        self.sheet.showPage()
        self._page += 1
        self.y = self._top

    def need(self, height: float) -> None:
        """Begin a new page where there is less room than so many points."""
        if self.y - height < MARGIN and self.y < self._top:
            self._end_page()

    def gap(self, height: float) -> None:
        """Leave room, points."""
        self.y -= height

    def paragraph(self, rich: str, size: float = TEXT, *, indent: float = 0.0) -> None:
        """Write a paragraph of rich text."""
        for line in broken(rich, size, self.width - indent):
            self.need(size * LEADING)
            self.y -= size * LEADING
            self._draw(line, MARGIN + indent, self.y + size * 0.3, size)

    def heading(self, rich: str, room: float = 60.0) -> None:
        """Write the heading of a part that needs so much room, points."""
        self.gap(5.0)
        self.need(HEADING * LEADING + room)
        self.paragraph(rich, HEADING)

    def listed(self, sentences: Sequence[str], size: float = TEXT) -> None:
        """Write sentences as a list with dots."""
        for sentence in sentences:
            self.need(size * LEADING)
            self.sheet.setFillGray(0.0)
            self.sheet.circle(MARGIN + 3.0, self.y - size * (LEADING - 0.55), 1.1, stroke=0, fill=1)
            self.paragraph(sentence, size, indent=10.0)
            self.gap(1.5)

    def table(
        self,
        header: Sequence[str],
        rows: Sequence[Sequence[str]],
        widths: Sequence[float],
        *,
        right: Sequence[int] = (),
        grounds: Sequence[Any] = (),
        ground_column: int = 0,
        size: float = CELL,
    ) -> None:
        """Write a table whose head stands on each of its pages.

        Parameters
        ----------
        widths : sequence of float
            Of the columns, mm.
        right : sequence of int
            Columns that are set to the right.
        grounds : sequence of colours
            Of one cell in each row; none where all are white.
        """
        points = [width * MM for width in widths]
        heads: list[Any] = [HEAD] * len(points)
        self.need(size * 3 * LEADING)
        top = self.y
        self._row(header, points, size, (), heads)
        for number, cells in enumerate(rows):
            colours: list[Any] = [None] * len(points)
            if grounds:
                colours[ground_column] = grounds[number]
            if not self._row(cells, points, size, right, colours):
                self._rule(top, points)
                self._end_page()
                top = self.y
                self._row(header, points, size, (), heads)
                self._row(cells, points, size, right, colours)
        self._rule(top, points)

    def _row(
        self,
        cells: Sequence[str],
        widths: Sequence[float],
        size: float,
        right: Sequence[int],
        colours: Sequence[Any],
    ) -> bool:
        """Draw a row; not where the page has no room for it, unless it is the first on it."""
        texts = [broken(c, size, w - 2 * PAD) for c, w in zip(cells, widths, strict=True)]
        height = max(map(len, texts)) * size * LEADING + PAD
        if self.y - height < MARGIN and self.y < self._top - 6 * size:
            return False
        sheet, x = self.sheet, MARGIN
        self.y -= height
        for column, (lines, width) in enumerate(zip(texts, widths, strict=True)):
            if colours[column] is not None:
                sheet.setFillColor(colours[column])
                sheet.rect(x, self.y, width, height, stroke=0, fill=1)
            for number, line in enumerate(lines):
                at = x + PAD
                if column in right:
                    at = x + width - PAD - self._long(line, size)
                self._draw(
                    line, at, self.y + height - PAD / 2 - size * (LEADING * number + 1), size
                )
            x += width
        self._rules.append(self.y)
        return True

    def _rule(self, top: float, widths: Sequence[float]) -> None:
        """Draw the rules of the rows since ``top``."""
        ends = [MARGIN + sum(widths[:column]) for column in range(len(widths) + 1)]
        self.sheet.setLineWidth(0.4)
        self.sheet.setStrokeColor(RULE)
        self.sheet.grid(ends, [top, *self._rules])
        self._rules.clear()

    @staticmethod
    def _long(line: Sequence[Word], size: float) -> float:
        spaces = max(0, len(line) - 1) * _width(" ") * size
        return sum(_measured(word, size) for word in line) + spaces

    def _draw(self, line: Sequence[Word], x: float, y: float, size: float) -> None:
        """Draw a line of words with its base line at ``y``."""
        pieces: list[list[str]] = []
        for number, word in enumerate(line):
            for text, level in [*((" ", "") for _ in range(number > 0)), *word]:
                if pieces and pieces[-1][1] == level:
                    pieces[-1][0] += text
                else:
                    pieces.append([text, level])
        self._text = self._text or self.sheet.beginText()
        self._text.setTextOrigin(x, y)
        for text, level in pieces:
            self._take(size * SMALL if level else size, RISE[level] * size)
            self._text.textOut(text)

    def _take(self, size: float, rise: float) -> None:
        """Go on with letters of another size, and raised: only where they differ."""
        if size != self._size:
            self._text.setFont(registered(LETTERING), size)
        if rise != self._rise:
            self._text.setRise(rise)
        self._size, self._rise = size, rise

    def _put_text(self, colour: Any) -> None:
        """Put the text of the page on it, above all the rest."""
        if self._text is not None:
            self._take(self._size, 0.0)
            self.sheet.setFillColor(colour)
            self.sheet.drawText(self._text)
        self._text, self._size = None, 0.0

    def caption(self, rich: str, x: float, y: float, width: float) -> None:
        """Write one line of small letters in the middle of a width."""
        line = broken(rich, NOTE, max(width, 1e4))[0]
        self._draw(line, x + max(0.0, (width - self._long(line, NOTE)) / 2), y, NOTE)
