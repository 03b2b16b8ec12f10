"""A document as a note in PDF: pages of GOST 7.32, contents, formulas built up (записка в PDF)."""

from __future__ import annotations

import html
from collections.abc import Callable, Iterator, Sequence
from functools import cache, partial
from io import BytesIO
from math import inf
from pathlib import Path
from typing import Any, Protocol, assert_never

import matplotlib
from msgspec import Struct
from reportlab.lib import colors
from reportlab.lib.enums import TA_CENTER, TA_JUSTIFY, TA_LEFT, TA_RIGHT
from reportlab.lib.pagesizes import A4
from reportlab.lib.styles import ParagraphStyle
from reportlab.lib.units import mm
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.pdfmetrics import stringWidth
from reportlab.pdfbase.ttfonts import TTFont
from reportlab.platypus import (
    CondPageBreak,
    Flowable,
    FrameBreak,
    LongTable,
    PageBreak,
    PageTemplate,
    Paragraph,
    Spacer,
    TableStyle,
)
from reportlab.platypus.tableofcontents import TableOfContents

from planmethod.note import document
from planmethod.note.document import Document, DrawableView, Table, plain_text
from planmethod.note.formula import Rich, inline, parse
from planmethod.note.wording import Language
from planmethod.note.writers import lowering
from planmethod.note.writers.formulas import (
    JOINER,
    lines_of,
    tied,
    width_em,
    with_levels,
    without_control_characters,
)
from planmethod.note.writers.lowering import LoweredDocument, LoweredNode, TextKind, lower
from planmethod.note.writers.pdf import marked, parts_of
from planmethod.note.writers.pdfformula import (
    Floating,
    FloatingPages,
    Fonts,
    FormulaLines,
    FormulaSetter,
    LaidFrame,
    LaidParagraph,
    Section,
)

LEFT, RIGHT, TOP, BOTTOM = 30 * mm, 15 * mm, 20 * mm, 20 * mm
SIZE, TABLE_SIZE = 14.0, 11.0
ABOVE = 10 * mm
"""White between the text and a title block."""
LEADING = 1.5 * 1.15
INDENT = 12.5 * mm
PAD = 3.0
LONG = 8.0
"""Width, in heights of the font, from which on a formula in a sentence may be cut."""

TITLE_MARGIN = 15 * mm
"""Space of page numbers beside the titles in the contents, and of some dots before them."""

LOW = 0.45
"""Share of a page up to which a table is not cut."""

MIN_COLUMN = 22 * mm
"""Least width of a column of a table that may be cut into several."""


NEARLY_EMPTY = 0.2
"""Share of the last page of a chapter from which on it is worth a page."""

TIGHT = 0.85
"""Share of their size that the pictures of a chapter get where that saves its nearly empty page."""

AFTER = {"title": "first", "first": "later"}
"""Templates of the following pages by the current one; other pages repeat theirs."""

CLOSE = [(f"{side}PADDING", (0, 0), (-1, -1), 0) for side in ("LEFT", "RIGHT", "TOP", "BOTTOM")]
"""Style of cells without padding."""


class PageForms(Protocol):
    """Frames and title blocks of the pages; who knows the forms draws them (рамки страниц)."""

    @property
    def heights(self) -> tuple[float, float]:
        """From the edge of the paper to above the title block, mm: of the first page, of others."""
        ...

    def view(self, page: int, pages: int, *, first: bool) -> DrawableView:
        """Return the frame of a page out of a total; ``first``: it follows the title page."""
        ...


@cache
def note_fonts() -> Fonts:
    """Return letters like Times that have Russian, Greek and signs; matplotlib brings them."""
    folder = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
    for name in ("STIXGeneral", "STIXGeneralBol", "STIXGeneralItalic"):
        pdfmetrics.registerFont(TTFont(name, str(folder / f"{name}.ttf")))
    return Fonts("STIXGeneral", "STIXGeneralBol", "STIXGeneralItalic")


def pdf_note(
    written: Document | LoweredDocument,
    language: Language,
    *,
    author: str = "",
    forms: PageForms | None = None,
) -> bytes:
    """Return a document as the pages of a note; the same document gives the same bytes.

    Parameters
    ----------
    written : Document or LoweredDocument
    language : Language
    author : str
        For the properties of the file.
    forms : PageForms, optional
        Frames for all pages but the title page; they hold the number of the page.

    Raises
    ------
    LayoutError
        A formula is malformed, or a text refers to a missing key.
    """
    written = lower(written, language)
    file = BytesIO()
    foot = BOTTOM if forms is None else forms.heights[1] * mm + ABOVE
    setter = _Setter(written, language, foot)
    flowables = list(setter.flowables())
    pages = _Pages(file, author or "planmethod", written, forms, Tightening(setter.sections))
    pages.multiBuild(flowables, maxPasses=MAX_RUNS)
    return file.getvalue()


MAX_RUNS = 30
"""Largest number of runs over the pages: each of the three trials takes two or three."""


class End(Struct, frozen=True):
    """End of a section: its number of pages, and the filled fraction of the last one."""

    count: int
    filled: float

    @property
    def is_nearly_empty(self) -> bool:
        """True if its last page has only a few lines."""
        return self.count > 1 and self.filled < NEARLY_EMPTY


class Tightening:
    """Saves pages of sections that have only a few lines: a trial for all of them, one for some."""

    def __init__(self, sections: Sequence[Section]) -> None:
        self._sections = sections
        self._low: list[int] = []
        self._first: Sequence[End] = ()
        self._trials = 0

    def is_final(self, ends: Sequence[End]) -> bool:
        """Return whether the ends are final; otherwise set sections closer for the next run."""
        self._trials += 1
        if self._trials == 1:
            self._first = ends
            tried = self._low = [k for k, end in enumerate(ends) if end.is_nearly_empty]
            is_final = not tried
        else:
            tried = [k for k in self._low if ends[k].count < self._first[k].count]
            is_final = tried == self._low or self._trials > 2
        if is_final:
            return True
        for k, section in enumerate(self._sections):
            section.scale = TIGHT if k in tried else 1.0
        return False


class _Pages(FloatingPages):
    """Pages with their numbers, in frames where there are any; headings report their pages."""

    def __init__(
        self,
        file: BytesIO,
        author: str,
        written: LoweredDocument,
        forms: PageForms | None,
        tightening: Tightening,
    ) -> None:
        fonts = note_fonts()
        super().__init__(
            file,
            pagesize=A4,
            title=plain_text(without_control_characters(written.title)),
            author=author,
            creator="planmethod",
            subject="",
            invariant=1,
            initialFontName=fonts.upright,
        )
        first = next((n for n in written.nodes if isinstance(n, lowering.Cover)), None)
        foot = "" if first is None else plain_text(first.footer)
        middle = LEFT + (A4[0] - LEFT - RIGHT) / 2
        self._forms, self._pages, self._tightening = forms, 0, tightening

        def close_page(canvas: Any, _: Any) -> None:
            number = canvas.getPageNumber()
            canvas.setFont(fonts.upright, 12.0)
            text = foot if first is not None and number == 1 else str(number)
            canvas.drawCentredString(middle, BOTTOM / 2, text)

        def put_frame(canvas: Any, at: Any) -> None:
            if not self.is_drawn:
                return
            canvas.saveState()
            canvas.scale(mm, mm)
            is_first = at.pageTemplate.id == "first"
            forms.view(self.page, self._pages, first=is_first).draw(canvas)  # type: ignore[union-attr]
            canvas.restoreState()

        if forms is None:
            self.addPageTemplates([_template("text", BOTTOM, close_page)])
            return
        templates = [_template("title", BOTTOM, close_page)] if first is not None else []
        of_first, of_others = (height * mm + ABOVE for height in forms.heights)
        templates.append(_template("first", of_first, put_frame))
        templates.append(_template("later", of_others, put_frame))
        self.addPageTemplates(templates)

    def _allSatisfied(self) -> bool:  # noqa: N802
        """Return whether the contents, and the number of pages in a frame, are right.

        The run after one in which they are draws the pages, if those are final.
        """
        told, self._pages = self._pages, self.page
        right = bool(super()._allSatisfied()) and (self._forms is None or told == self.page)
        if not right or self.is_drawn:
            return right
        self.is_drawn = self._tightening.is_final(self.ends)
        return False

    def beforeDocument(self) -> None:  # noqa: N802
        """Forget how the sections of the last run ended."""
        self.ends: list[End] = []

    def beforePage(self) -> None:  # noqa: N802
        """Let pages with another title block follow; reportlab's own way lets one come twice."""
        after = AFTER.get(self.pageTemplate.id)
        if after is not None:
            self.handle_nextPageTemplate(after)

    def handle_pageBreak(self, slow: Any = None) -> None:  # noqa: N802
        """Note how a section ends."""
        begun = sum(end.count for end in self.ends)
        left = (self.frame._y - self.frame._y1p) / self.frame._height
        self.ends.append(End(self.page - begun, 1.0 - left))
        super().handle_pageBreak(slow)

    def afterFlowable(self, flowable: Flowable) -> None:  # noqa: N802
        """Note where a heading stands."""
        level = getattr(flowable, "level", None)
        if level is not None:
            key = f"heading{flowable.number}"
            self.canv.bookmarkPage(key)
            self.canv.addOutlineEntry(flowable.plain, key, level, closed=False)
            self.notify("TOCEntry", (level, flowable.shown, self.page, key))


def _template(name: str, bottom: float, on_page: Callable[[Any, Any], None]) -> PageTemplate:
    """Return pages whose text ends at ``bottom`` points from the lower edge."""
    width, height = A4
    text = LaidFrame(
        LEFT, bottom, width - LEFT - RIGHT, height - TOP - bottom, 0, 0, 0, 0, id="text"
    )
    return PageTemplate(name, [text], onPage=on_page)


class _Heading(LaidParagraph):
    """A heading that the contents list."""

    def __init__(self, shown: str, outline: str, style: ParagraphStyle, level: int, number: int):
        super().__init__(shown, style)
        self.shown, self.plain, self.level, self.number = shown, outline, level, number


class _Picture(Flowable):  # type: ignore[misc]
    """A centred picture, scaled down where space is short."""

    def __init__(self, view: DrawableView, tallest: float, section: Section) -> None:
        super().__init__()
        self._view, self._tallest, self._section, self.at_most = view, tallest, section, 1.0
        self._share, self._width = 1.0, 0.0

    def wrap(self, width: float, height: float) -> tuple[float, float]:
        """Return the space that the picture takes, points."""
        wide, high = (side * mm for side in self._view.size)
        self._share = self.at_most * min(self._section.scale, width / wide, self._tallest / high)
        self._width = width
        return width, high * self._share

    def draw(self) -> None:
        """Draw the picture on the canvas."""
        wide = self._view.size[0] * mm * self._share
        self.canv.saveState()
        self.canv.translate((self._width - wide) / 2, 0.0)
        self.canv.scale(mm * self._share, mm * self._share)
        self._view.draw(self.canv)
        self.canv.restoreState()


class _CutTable(LongTable):  # type: ignore[misc]
    """A table with a line above each further part that names its continuation."""

    again: Callable[[], Paragraph] | None = None

    def measure(self, width: float) -> float:
        """Return the height, points; rows keep theirs, so that no run over the pages measures."""
        self.wrap(width, inf)
        self._argH = self._rowHeights
        return float(sum(self._rowHeights))

    def split(self, width: float, height: float) -> list[Flowable]:
        """Return the part that fits, and the rest for the next page."""
        parts = super().split(width, height)
        if len(parts) < 2 or self.again is None:
            return list(parts)
        first, rest = parts
        rest.again = self.again
        return [first, FrameBreak(), self.again(), rest]


class _Contents(TableOfContents):  # type: ignore[misc]
    """Contents whose lines are as close as their section is set."""

    section: Section

    def wrap(self, width: float, height: float) -> tuple[float, float]:
        """Return the space that the contents take, points."""
        for style in self.levelStyles:
            style.leading = 1.4 * self.section.scale * style.fontSize
        wide, high = super().wrap(width, height)
        return wide, high


class _Setter:
    """Makes flowables of nodes."""

    def __init__(self, written: LoweredDocument, language: Language, bottom: float) -> None:
        self._written, self._say, self._fonts = written, language.document, note_fonts()
        self.sections = [Section()]
        self._formulas = FormulaSetter(self._fonts, SIZE)
        self._width = A4[0] - LEFT - RIGHT
        self._tallest = A4[1] - TOP - bottom - 20 * mm
        self._count = 0

    def _style(
        self,
        size: float = SIZE,
        *,
        align: int = TA_JUSTIFY,
        indent: float = INDENT,
        left: float = 0.0,
        right: float = 0.0,
        around: float = 0.0,
        bold: bool = False,
        keep_with_next: bool = False,
        leading: float = LEADING,
    ) -> ParagraphStyle:
        return ParagraphStyle(
            "text",
            fontName=self._fonts.bold if bold else self._fonts.upright,
            fontSize=size,
            leading=leading * size,
            alignment=align,
            firstLineIndent=indent,
            leftIndent=left,
            rightIndent=right,
            spaceBefore=around,
            spaceAfter=around,
            keepWithNext=keep_with_next,
        )

    def _markup(self, rich: Rich, size: float = SIZE) -> str:
        """Return a sentence as reportlab takes it, the letters of its formulas italic."""
        found = ""
        for piece in self._written.divide(rich, symbols=True):
            if not piece.is_formula:
                found += html.escape(tied(piece.text).replace(JOINER, "")).replace("\n", "<br/>")
                continue
            shown = marked(inline(piece.nodes), size, self._fonts.italic)
            # A long formula is cut at its signs, whatever a terminal does.
            found += (
                shown.replace("\u00a0=\u00a0", " = ") if width_em(piece.nodes) > LONG else shown
            )
        return found

    def _text(self, rich: Rich, style: ParagraphStyle) -> Paragraph:
        return LaidParagraph(self._markup(rich, style.fontSize), style)

    def flowables(self) -> Iterator[Flowable]:
        """Yield the flowables of the document."""
        fresh = True  # an empty page needs no break
        for node in self._written.nodes:
            for flowable in self._flowables(node):
                is_break = isinstance(flowable, PageBreak)
                if not (is_break and fresh):
                    self.sections += [Section()] * is_break
                    yield flowable
                fresh = is_break

    def _flowables(self, node: LoweredNode) -> Iterator[Flowable]:
        match node:
            case lowering.Cover():
                yield from self._cover(node)
            case lowering.Heading(text, 0):
                style = self._style(16.0, align=TA_CENTER, indent=0.0, around=6.0, bold=True)
                yield self._text(text, style)
            case lowering.Heading():
                if node.is_structural:
                    yield PageBreak()
                yield self._heading(node)
            case lowering.ContentsList():
                yield from self._contents(node)
            case document.PageBreak():
                yield PageBreak()
            case lowering.Text():
                yield from self._lines_of_text(node)
            case lowering.DisplayedFormula(text, number):
                nodes = tuple(with_levels(parse(without_control_characters(text))))
                yield self._displayed(nodes, number)
            case lowering.DisplayedEquations(equations, number):
                yield self._lines([self._formulas.equations(equations)], number)
            case lowering.NamedTable():
                yield from self._tables(node)
            case lowering.NamedFigure(view=view, name=name):
                style = self._style(align=TA_CENTER, indent=0.0, around=6.0, leading=1.2)
                below = [self._text(name, style)] if name else []
                picture = _Picture(view, self._tallest, self.sections[-1])
                floating = Floating([Spacer(0, 6), picture, *below])
                floating.shrunk = picture
                yield floating
            case _:
                assert_never(node)

    def _lines_of_text(self, node: lowering.Text) -> Iterator[Flowable]:
        match node.kind:
            case TextKind.STEP:
                for part in lowering.step_parts(node, self._written):
                    if part.formula:
                        yield self._displayed(part.formula, "")
                    else:
                        yield self._text(
                            part.text, self._style(keep_with_next=part.introduces_next)
                        )
            case TextKind.CAPTION:
                yield self._text(node.text, self._style(align=TA_LEFT, keep_with_next=True))
            case TextKind.NOTE:
                yield self._text(node.text, self._style(12.0, leading=1.2, around=2.0))
            case TextKind.PARAGRAPH | TextKind.ITEM | TextKind.SOURCE:
                style = self._style(keep_with_next=node.introduces_next)
                yield self._text(lowering.marked_text(node), style)
            case _:
                assert_never(node.kind)

    def _heading(self, node: lowering.Heading) -> _Heading:
        align, indent = (TA_CENTER, 0.0) if node.is_structural else (TA_LEFT, INDENT)
        style = self._style(align=align, indent=indent, around=8.0, bold=True, keep_with_next=True)
        self._count += 1
        text = without_control_characters(node.numbered_text)
        shown = marked(inline(parse(text)), SIZE)
        return _Heading(shown, plain_text(text), style, node.level - 1, self._count)

    def _displayed(self, nodes: Sequence[Any], number: str) -> Flowable:
        whole = self._formulas.set(nodes)
        if whole.width <= self._width - 8.0 * SIZE * bool(number):
            return self._lines([whole], number)
        room = 0.85 * self._width / SIZE
        return self._lines([self._formulas.set(line) for line in lines_of(nodes, room)], number)

    def _lines(self, rows: Sequence[Any], number: str) -> Flowable:
        return FormulaLines(rows, number, self._fonts.upright, SIZE, self.sections[-1])

    # Tables ---------------------------------------------------------------------------------------

    def _tables(self, node: lowering.NamedTable) -> Iterator[Flowable]:
        """Yield a table: a low one with its name on one page, a high one cut between its rows."""
        style = self._style(align=TA_LEFT, indent=0.0, around=3.0, leading=1.2)
        name, again = node.name, node.continuation
        parts = list(parts_of(node.table, int(self._width // MIN_COLUMN)))
        for part in parts:
            above = [self._text(name, style)] if name else []
            made = self._table(part)
            made.again = partial(self._text, again, style) if again else None
            high = made.measure(self._width)
            # No text may come between the parts of a wide table: they are cut instead.
            if high < LOW * self._tallest and len(parts) == 1:
                yield Floating([*above, made, Spacer(0.0, 8.0)])
            else:
                yield CondPageBreak(sum(made._rowHeights[:4]) + 3.0 * SIZE * bool(name))
                yield from above
                yield made
                yield Spacer(0.0, 8.0)
            name = again

    def _table(self, table: Table) -> _CutTable:
        size = TABLE_SIZE
        aligned = {
            align: self._style(size, align=align, indent=0.0, leading=1.2)
            for align in (TA_LEFT, TA_CENTER, TA_RIGHT)
        }
        lines = [[self._text(cell, aligned[TA_CENTER]) for cell in table.head]]
        lines += [
            [
                self._text(cell, aligned[TA_RIGHT if k in table.numbers else TA_LEFT])
                for k, cell in enumerate(row)
            ]
            for row in table.rows
        ]
        look = [
            ("FONTNAME", (0, 0), (-1, -1), self._fonts.upright),
            ("GRID", (0, 0), (-1, -1), 0.5, colors.black),
            ("VALIGN", (0, 0), (-1, -1), "TOP"),
            ("LEFTPADDING", (0, 0), (-1, -1), PAD),
            ("RIGHTPADDING", (0, 0), (-1, -1), PAD),
            ("TOPPADDING", (0, 0), (-1, -1), 0.5),
            ("BOTTOMPADDING", (0, 0), (-1, -1), 3.0),
            ("NOSPLIT", (0, 0), (0, min(2, len(table.rows)))),  # no page has a row alone
            ("NOSPLIT", (0, -min(2, len(table.rows))), (0, -1)),
        ]
        columns = zip(table.head, *table.rows, strict=True)
        needed = [
            max(stringWidth(w, self._fonts.upright, size) for cell in column for w in _words(cell))
            + 2 * PAD
            + 2.0
            for column in columns
        ]
        share = self._width / sum(needed)
        return _CutTable(lines, colWidths=[w * share for w in needed], repeatRows=1, style=look)

    # Title page and contents ----------------------------------------------------------------------

    def _cover(self, page: lowering.Cover) -> Iterator[Flowable]:
        middle = self._style(align=TA_CENTER, indent=0.0, around=2.0, leading=1.3)
        large = self._style(16.0, align=TA_CENTER, indent=0.0, around=4.0, bold=True)
        yield from (self._text(text, middle) for text in page.organisation)
        yield Spacer(0.0, 110.0)
        if page.work:
            yield self._text(page.work, large)
        yield from (self._text(text, middle) for text in (*page.subject, page.designation) if text)
        yield Spacer(0.0, 110.0)
        aside = self._style(align=TA_LEFT, indent=0.0, left=85 * mm, around=3.0)
        yield from (self._text(text, aside) for text in page.signatures)
        yield PageBreak()

    def _contents(self, node: lowering.ContentsList) -> Iterator[Flowable]:
        yield self._text(
            node.title, self._style(align=TA_CENTER, indent=0.0, around=8.0, bold=True)
        )
        contents = _Contents()
        contents.section = self.sections[-1]
        contents.dotsMinLevel = 0
        contents.tableStyle = TableStyle(
            [*CLOSE, ("FONTNAME", (0, 0), (-1, -1), self._fonts.upright)]
        )
        contents.levelStyles = [
            self._style(align=TA_LEFT, indent=0.0, left=7 * mm * level, right=TITLE_MARGIN)
            for level in range(3)
        ]
        yield contents
        yield PageBreak()


def _words(cell: Rich) -> list[str]:
    return plain_text(without_control_characters(cell)).split() or [""]
