"""A document as PDF pages, set by reportlab (документ в PDF)."""

# no messages: markup of ReportLab

from __future__ import annotations

import html
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from io import BytesIO
from itertools import groupby
from typing import Any, assert_never

from reportlab.lib import colors
from reportlab.lib.pagesizes import A4, landscape
from reportlab.lib.styles import ParagraphStyle
from reportlab.pdfbase.pdfmetrics import stringWidth
from reportlab.platypus import (
    Flowable,
    KeepTogether,
    ListFlowable,
    ListItem,
    LongTable,
    Paragraph,
    SimpleDocTemplate,
    Spacer,
)

from planmethod.note.document import Document, PageBreak, Table, plain_text
from planmethod.note.formula import (
    Fraction,
    Index,
    Letters,
    Node as Sign,
    Overline,
    Root,
    inline,
    parse,
)
from planmethod.note.wording import Language
from planmethod.note.writers import lowering
from planmethod.note.writers.formulas import Token, tokens_of, without_control_characters
from planmethod.note.writers.lowering import LoweredDocument, LoweredNode, TextKind, lower

MM = 72.0 / 25.4
MARGIN = 12.0 * MM
PAD = 3.0
"""White at the sides of a cell, points."""

SMALL, RISE, DROP = 0.72, 0.34, 0.16
"""Size of index letters, and shifts of their base line, in parts of the letters beside them."""

MIN_COLUMN = 34.0 * MM
"""Least width of a column of a table that may be cut into several."""

TONES = {
    "ok": "#e5f2e7",
    "inherited": "#e5f2e7",
    "near": "#fdf3d3",
    "inconsistent": "#fdf3d3",
    "unseen": "#fdf3d3",
    "wrong": "#fbe3e0",
    "blank": "#ececec",
    "unreadable": "#ececec",
}
"""Grounds of cells that name a verdict: they only repeat what the word says."""


_HEADINGS = ((15.0, 0.0), (12.0, 6.0), (10.5, 5.0), (10.5, 5.0))
"""Size of headings by their level, and white above them, points."""

_TEXTS: Mapping[TextKind, tuple[float, float]] = {
    TextKind.PARAGRAPH: (9.5, 0.0),
    TextKind.ITEM: (9.5, 0.0),
    TextKind.STEP: (9.5, 0.0),
    TextKind.SOURCE: (9.5, 0.0),
    TextKind.CAPTION: (11.0, 3.0),
    TextKind.NOTE: (8.0, 2.0),
}
"""The same of texts."""


def pdf_document(
    written: Document,
    language: Language,
    *,
    title: str,
    font: str,
    wide: bool = False,
    footer: Callable[[int], str] | None = None,
) -> bytes:
    """Return a document as PDF; the same document gives the same bytes.

    Parameters
    ----------
    written : Document
    language : Language
    title : str
        Plain text, of the file.
    font : str
        Name of a font that reportlab knows.
    wide : bool
        Whether the pages are landscape.
    footer : callable, optional
        Takes the number of a page and returns the line at its foot.
    """
    file = BytesIO()
    pages = SimpleDocTemplate(
        file,
        pagesize=landscape(A4) if wide else A4,
        leftMargin=MARGIN,
        rightMargin=MARGIN,
        topMargin=MARGIN,
        bottomMargin=MARGIN,
        title=title,
        author="planmethod",
        creator="planmethod",
        subject="",
        invariant=1,
        initialFontName=font,  # without it the file keeps an unused Helvetica
    )

    def close_page(canvas: Any, _: Any) -> None:
        if footer is not None:
            canvas.setFont(font, 7.5)
            canvas.setFillColor(colors.HexColor("#8a8a8a"))
            canvas.drawString(MARGIN, MARGIN / 2, footer(canvas.getPageNumber()))

    pages.build(
        list(_Setter(font, pages.width - 12.0).flowables_of_document(lower(written, language))),
        onFirstPage=close_page,
        onLaterPages=close_page,
    )
    return file.getvalue()


class _Setter:
    """Makes flowables of nodes."""

    def __init__(self, font: str, width: float) -> None:
        self._font, self._width = font, width

    def _style(self, size: float, *, before: float = 0.0, after: float = 1.5) -> ParagraphStyle:
        return ParagraphStyle(
            f"{size} {before}",
            fontName=self._font,
            bulletFontName=self._font,
            fontSize=size,
            leading=1.32 * size,
            spaceBefore=before,
            spaceAfter=after,
            keepWithNext=before > 4.0,
        )

    def _text(self, rich: str, size: float = 9.5, before: float = 0.0) -> Paragraph:
        return Paragraph(pdf_markup(rich, size), self._style(size, before=before))

    def flowables_of_document(self, written: LoweredDocument) -> Iterator[Flowable]:
        """Yield the flowables of a document."""
        for (kind, text_kind), run in groupby(written.nodes, lowering.kind_of):
            nodes = list(run)
            if text_kind in (TextKind.ITEM, TextKind.STEP):
                yield self._listed(nodes, numbered=text_kind is TextKind.STEP)
            elif kind is lowering.NamedFigure:
                yield from self._figures(
                    [node for node in nodes if isinstance(node, lowering.NamedFigure)]
                )
            else:
                for node in nodes:
                    yield from self._flowables(node)

    def _flowables(self, node: LoweredNode) -> Iterator[Flowable]:
        match node:
            case lowering.Cover() | lowering.ContentsList() | PageBreak():
                pass
            case lowering.Heading(text, level):
                yield self._text(text, *_HEADINGS[level])
            case lowering.Text(kind=kind):
                yield self._text(node.text, *_TEXTS[kind])
            case lowering.DisplayedFormula(text):
                yield self._text(text)
            case lowering.DisplayedEquations(equations):
                for one in equations:
                    sides = (" + ".join(t.symbol for t in s) for s in (one.left, one.right))
                    yield self._text(" = ".join(side or "0" for side in sides))
            case lowering.NamedTable(table):
                yield from self._tables(table)
            case lowering.NamedFigure():
                yield from self._figures([node])
            case _:
                assert_never(node)

    def _listed(self, nodes: Sequence[LoweredNode], *, numbered: bool) -> Flowable:
        items = [ListItem(list(self._flowables(node))) for node in nodes]
        return ListFlowable(
            items,
            bulletType="1" if numbered else "bullet",
            start=None if numbered else "•",
            bulletFontName=self._font,
            bulletFontSize=9.5,
            leftIndent=18.0 if numbered else 10.0,
        )

    # Tables --------------------------------------------------------------------------------------

    def _tables(self, table: Table) -> Iterator[Flowable]:
        """Yield a table, in several parts where its columns are too many for the width."""
        for part in parts_of(table, int(self._width // MIN_COLUMN)):
            yield self._table(part)
            yield Spacer(0.0, 4.0)

    def _table(self, table: Table) -> Flowable:
        size = 8.0 if table.repeated else 8.5
        style = self._style(size, after=0.0)
        rights = ParagraphStyle("right", parent=style, alignment=2)
        lines = [[Paragraph(pdf_markup(cell, size), style) for cell in table.head]]
        lines += [
            [
                Paragraph(pdf_markup(cell, size), rights if k in table.numbers else style)
                for k, cell in enumerate(row)
            ]
            for row in table.rows
        ]
        look: list[tuple[Any, ...]] = [
            ("GRID", (0, 0), (-1, -1), 0.4, colors.HexColor("#bbbbbb")),
            ("BACKGROUND", (0, 0), (-1, 0), colors.HexColor("#f4f4f4")),
            ("FONTNAME", (0, 0), (-1, -1), self._font),
            ("VALIGN", (0, 0), (-1, -1), "TOP"),
            ("LEFTPADDING", (0, 0), (-1, -1), PAD),
            ("RIGHTPADDING", (0, 0), (-1, -1), PAD),
            ("TOPPADDING", (0, 0), (-1, -1), 0.5),
            ("BOTTOMPADDING", (0, 0), (-1, -1), 2.0),
        ]
        for number, tone in enumerate(table.tones, 1):
            place = (table.toned, number)
            look.append(("BACKGROUND", place, place, colors.HexColor(TONES[tone])))
        widths = self._widths([table.head, *table.rows], size)
        return LongTable(lines, colWidths=widths, repeatRows=1, style=look, hAlign="LEFT")

    def _widths(self, rows: Sequence[Sequence[str]], size: float) -> list[float]:
        """Return the widths of columns: what their cells need; the widest give way."""
        needed = [
            max(stringWidth(plain_text(cell), self._font, size) for cell in column) + 2 * PAD + 1.0
            for column in zip(*rows, strict=True)
        ]
        left, narrow = self._width, dict[int, float]()
        for k in sorted(range(len(needed)), key=needed.__getitem__):
            narrow[k] = min(needed[k], left / (len(needed) - len(narrow)))
            left -= narrow[k]
        return [narrow[k] for k in range(len(needed))]

    # Figures -------------------------------------------------------------------------------------

    def _figures(self, figures: Sequence[lowering.NamedFigure]) -> Iterator[Flowable]:
        """Yield figures in rows that are as full as can be."""
        row: list[lowering.NamedFigure] = []
        for figure in figures:
            if row and sum(f.view.size[0] * MM for f in (*row, figure)) > self._width:
                yield _Row(row, self._font)
                row = []
            row.append(figure)
        yield KeepTogether([_Row(row, self._font)])


class _Row(Flowable):  # type: ignore[misc]
    """Figures side by side, each with its caption."""

    CAPTION = 16.0

    def __init__(self, figures: Sequence[lowering.NamedFigure], font: str) -> None:
        super().__init__()
        self._figures, self._font = figures, font

    def wrap(self, width: float, height: float) -> tuple[float, float]:
        """Return the space that the row takes, points."""
        return width, max(f.view.size[1] for f in self._figures) * MM + self.CAPTION

    def draw(self) -> None:
        """Draw the figures on the canvas."""
        x, gap = 0.0, 4.0 * MM
        for figure in self._figures:
            self.canv.saveState()
            self.canv.translate(x, self.CAPTION)
            self.canv.scale(MM, MM)
            figure.view.draw(self.canv)
            self.canv.restoreState()
            width = figure.view.size[0] * MM
            style = ParagraphStyle("caption", fontName=self._font, fontSize=8.0, alignment=1)
            caption = Paragraph(pdf_markup(figure.name, 8.0), style)
            caption.wrap(max(width, 80.0 * MM), self.CAPTION)
            caption.drawOn(self.canv, x + min(0.0, width - 80.0 * MM) / 2, 2.0)
            x += width + gap


def pdf_markup(rich: str, size: float) -> str:
    """Return rich text as markup of reportlab's paragraphs, in letters of a size in points."""
    return marked(inline(parse(without_control_characters(rich))), size)


def marked(nodes: Iterable[Sign], size: float, italic: str = "") -> str:
    """Return a formula in one line as reportlab's paragraphs take it.

    ``italic``: font of its Latin and Greek letters, if they have one of their own.
    """

    def shown(token: Token) -> str:
        text = html.escape(token.text).replace("\n", "<br/>")
        return f'<font name="{italic}">{text}</font>' if token.kind == "letters" else text

    def one(node: Sign) -> str:
        match node:
            case Letters():
                return "".join(map(shown, tokens_of([node]) if italic else [Token("", node.text)]))
            case Index(low, high, is_power):
                parts = [_level("super", RISE, high), _level("sub", DROP, low)]
                return "".join(reversed(parts) if is_power else parts)
            case Overline(body):
                return marked(body, size, italic)
            case Fraction() | Root():
                raise AssertionError  # the formula is in one line
            case _:
                assert_never(node)

    def _level(tag: str, rise: float, nodes: tuple[Sign, ...]) -> str:
        if not nodes:
            return ""
        look = f'size="{SMALL * size:.2f}" rise="{rise * size:.2f}"'
        return f"<{tag} {look}>{marked(nodes, size, italic)}</{tag}>"

    return "".join(map(one, nodes))


def parts_of(table: Table, max_columns: int) -> Iterator[Table]:
    """Yield a table cut into tables of at most ``max_columns`` columns, about equally wide."""
    lead = table.repeated
    free = len(table.head) - lead
    if not lead or free + lead <= max_columns:
        yield table
        return
    count = -(-free // (max_columns - lead))
    size = -(-free // count)
    for start in range(lead, len(table.head), size):
        rows = (row[:lead] + row[start : start + size] for row in (table.head, *table.rows))
        head, *others = rows
        yield Table(head, tuple(others), table.names, lead)
