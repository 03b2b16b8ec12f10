"""A document as a note in PDF: pages of GOST 7.32, contents, formulas built up (записка в PDF)."""

from __future__ import annotations

import html
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, partial
from io import BytesIO
from itertools import zip_longest
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
from planmethod.note.document import Document, Node, Table, plain_text
from planmethod.note.formula import Rich, inline, parse
from planmethod.note.wording import Language
from planmethod.note.writers.formulas import (
    JOINER,
    introduces_next_node,
    lines_of,
    pieces,
    sole_formula,
    tied,
    units_of,
    width_em,
    with_levels,
)
from planmethod.note.writers.html import without_control_characters
from planmethod.note.writers.pdf import marked, parts_of
from planmethod.note.writers.pdfformula import (
    Floating,
    FloatingPages,
    Fonts,
    FormulaLines,
    FormulaSetter,
    LaidFrame,
    LaidParagraph,
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

    def view(self, page: int, pages: int, *, first: bool) -> document.DrawableView:
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
    written: Document, language: Language, *, author: str = "", forms: PageForms | None = None
) -> bytes:
    """Return a document as the pages of a note; the same document gives the same bytes.

    Parameters
    ----------
    written : Document
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
    written = document.resolve_references(written)
    built = partial(_built, written, language, author, forms)
    made, ends = built({}, lambda ends: not any(end.is_nearly_empty for end in ends))
    if made:
        return made
    low = [k for k, end in enumerate(ends) if end.is_nearly_empty]

    def saved(tighter: Sequence[End]) -> list[int]:
        return [k for k in low if tighter[k].count < ends[k].count]

    closer, found = built(dict.fromkeys(low, TIGHT), lambda tighter: saved(tighter) == low)
    return closer or built(dict.fromkeys(saved(found), TIGHT), lambda _: True)[0]


def _built(
    written: Document,
    language: Language,
    author: str,
    forms: PageForms | None,
    tight: Mapping[int, float],
    is_final: Callable[[Sequence[End]], bool],
) -> tuple[bytes, list[End]]:
    """Return a file, and how each section between page breaks ends.

    ``tight``: of which sections pictures are smaller, to which share of their size; formulas and
    lines of the contents are closer there. The file is empty unless the ends are final: drawing
    takes longer than laying out.
    """
    file = BytesIO()
    pages = _Pages(file, _title(written), author or "planmethod", written, forms, is_final)
    foot = BOTTOM if forms is None else forms.heights[1] * mm + ABOVE
    pages.multiBuild(list(_Setter(language, tight, foot).flowables_of_document(written)))
    return file.getvalue() if pages.is_drawn else b"", pages.ends


def _title(written: Document) -> str:
    for node in written.nodes:
        match node:
            case document.TitlePage(title=title, work=work):
                return plain_text(without_control_characters(title or work))
            case document.Title(text):
                return plain_text(without_control_characters(text))
    return ""


class _Pages(FloatingPages):
    """Pages with their numbers, in frames where there are any; headings report their pages."""

    def __init__(
        self,
        file: BytesIO,
        title: str,
        author: str,
        written: Document,
        forms: PageForms | None,
        is_final: Callable[[Sequence[End]], bool],
    ) -> None:
        fonts = note_fonts()
        super().__init__(
            file,
            pagesize=A4,
            title=title,
            author=author,
            creator="planmethod",
            subject="",
            invariant=1,
            initialFontName=fonts.upright,
        )
        first = next((n for n in written.nodes if isinstance(n, document.TitlePage)), None)
        foot = "" if first is None else plain_text(f"{first.place} {first.year}").strip()
        middle = LEFT + (A4[0] - LEFT - RIGHT) / 2
        self._forms, self._pages, self._is_final = forms, 0, is_final

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

        The run after the first in which they are draws the pages, if those are final.
        """
        told, self._pages = self._pages, self.page
        right = bool(super()._allSatisfied()) and (self._forms is None or told == self.page)
        if not right or self.is_drawn or not self._is_final(self.ends):
            return right
        self.is_drawn = True
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


class End(Struct, frozen=True):
    """End of a section: its number of pages, and the filled fraction of the last one."""

    count: int
    filled: float

    @property
    def is_nearly_empty(self) -> bool:
        """True if its last page has only a few lines."""
        return self.count > 1 and self.filled < NEARLY_EMPTY


class _Heading(LaidParagraph):
    """A heading that the contents list."""

    def __init__(self, shown: str, outline: str, style: ParagraphStyle, level: int, number: int):
        super().__init__(shown, style)
        self.shown, self.plain, self.level, self.number = shown, outline, level, number


class _Picture(Flowable):  # type: ignore[misc]
    """A centred picture, scaled down where space is short."""

    def __init__(self, view: document.DrawableView, tallest: float, max_scale: float) -> None:
        super().__init__()
        self._view, self._tallest, self._most, self.at_most = view, tallest, max_scale, 1.0
        self._share, self._width = 1.0, 0.0

    def wrap(self, width: float, height: float) -> tuple[float, float]:
        """Return the space that the picture takes, points."""
        wide, high = (side * mm for side in self._view.size)
        self._share = self.at_most * min(self._most, width / wide, self._tallest / high)
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

    def split(self, width: float, height: float) -> list[Flowable]:
        """Return the part that fits, and the rest for the next page."""
        parts = super().split(width, height)
        if len(parts) < 2 or self.again is None:
            return list(parts)
        first, rest = parts
        rest.again = self.again
        return [first, FrameBreak(), self.again(), rest]


class _Setter:
    """Makes flowables of nodes."""

    def __init__(self, language: Language, tight: Mapping[int, float], bottom: float) -> None:
        self._say, self._fonts, self._tight = language.document, note_fonts(), tight
        self._section = 0
        self._units = units_of(language.note["units"])
        self._formulas = FormulaSetter(self._fonts, SIZE)
        self._width = A4[0] - LEFT - RIGHT
        self._tallest = A4[1] - TOP - bottom - 20 * mm
        self._step = self._count = 0
        self._is_note = self._leads = False

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
        for piece in pieces(parse(without_control_characters(rich)), self._units, symbols=True):
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

    def flowables_of_document(self, written: Document) -> Iterator[Flowable]:
        """Yield the flowables of a document."""
        kinds = {type(node) for node in written.nodes}
        self._is_note = bool(kinds & {document.TitlePage, document.Contents})
        fresh = True  # an empty page needs no break
        numbered = list(document.numbers_of(written))
        for (node, number), after in zip_longest(numbered, written.nodes[1:]):
            self._leads = introduces_next_node(node, after)
            for flowable in self._flowables(node, number):
                is_break = isinstance(flowable, PageBreak)
                if not (is_break and fresh):
                    self._section += is_break
                    yield flowable
                fresh = is_break

    def _flowables(self, node: Node, number: str) -> Iterator[Flowable]:
        match node:
            case document.Title(text):
                style = self._style(16.0, align=TA_CENTER, indent=0.0, around=6.0, bold=True)
                yield self._text(text, style)
            case document.TitlePage():
                yield from self._title_page(node)
            case document.Contents():
                yield from self._contents()
            case document.PageBreak():
                yield PageBreak()
            case document.StructuralHeading(title):
                self._step = 0
                yield PageBreak()
                yield self._heading(title, 0, "", middle=True)
            case document.Chapter(title):
                self._step = 0 if self._is_note else self._step
                yield self._heading(title, 0, number)
            case document.Part(title):
                self._step = 0 if self._is_note else self._step
                yield self._heading(title, 1, number)
            case document.Subpart(title):
                yield self._heading(title, 2, number)
            case document.Caption(text):
                yield self._text(text, self._style(align=TA_LEFT, keep_with_next=True))
            case document.Paragraph(text):
                yield self._text(text, self._style(keep_with_next=self._leads))
            case document.Item(text, label):
                shown = f"{label}\u2002{text}" if label else f"–\u00a0{text}"
                yield self._text(shown, self._style(keep_with_next=self._leads))
            case document.Step(lines, continues):
                yield from self._stepped(lines, continues=continues)
            case document.Formula(text):
                yield self._displayed(
                    tuple(with_levels(parse(without_control_characters(text)))), number
                )
            case document.Equations(equations):
                yield self._lines([self._formulas.equations(equations)], number)
            case document.Table():
                yield from self._tables(node, number)
            case document.Figure(view, caption):
                shown = self._say.figure.format(number=number, text=caption) if number else caption
                style = self._style(align=TA_CENTER, indent=0.0, around=6.0, leading=1.2)
                below = [self._text(shown, style)] if shown else []
                share = self._tight.get(self._section, 1.0)
                picture = _Picture(view, self._tallest, share)
                floating = Floating([Spacer(0, 6), picture, *below])
                floating.shrunk = picture
                yield floating
            case document.References(entries):
                for k, entry in enumerate(entries, 1):
                    yield self._text(f"{k}.\u00a0{entry}", self._style())
            case document.Note(text):
                yield self._text(text, self._style(12.0, leading=1.2, around=2.0))
            case _:
                assert_never(node)

    def _heading(self, title: Rich, level: int, number: str, *, middle: bool = False) -> _Heading:
        align, indent = (TA_CENTER, 0.0) if middle else (TA_LEFT, INDENT)
        style = self._style(align=align, indent=indent, around=8.0, bold=True, keep_with_next=True)
        self._count += 1
        text = f"{number} {title}" if number else title
        shown = marked(inline(parse(without_control_characters(text))), SIZE)
        return _Heading(
            shown, plain_text(without_control_characters(text)), style, level, self._count
        )

    def _stepped(self, lines: Sequence[Rich], *, continues: bool) -> Iterator[Flowable]:
        self._step += not continues
        alone = [
            sole_formula(pieces(parse(without_control_characters(line)), self._units))
            for line in lines
        ]
        for k, line in enumerate(lines):
            if k and alone[k]:
                yield self._displayed(alone[k], "")
                continue
            lead = "" if k or continues else f"{self._step})\u00a0"
            is_last = k + 1 == len(lines)
            keep = self._leads if is_last else bool(alone[k + 1]) or line.endswith(":")
            yield self._text(f"{lead}{line}", self._style(keep_with_next=keep))

    def _displayed(self, nodes: Sequence[Any], number: str) -> Flowable:
        whole = self._formulas.set(nodes)
        if whole.width <= self._width - 8.0 * SIZE * bool(number):
            return self._lines([whole], number)
        room = 0.85 * self._width / SIZE
        return self._lines([self._formulas.set(line) for line in lines_of(nodes, room)], number)

    def _lines(self, rows: Sequence[Any], number: str) -> Flowable:
        air = 2.0 * self._tight.get(self._section, 1.0) - 1.0
        return FormulaLines(rows, number, self._fonts.upright, SIZE, air)

    # Tables ---------------------------------------------------------------------------------------

    def _tables(self, table: Table, number: str) -> Iterator[Flowable]:
        """Yield a table: a low one with its name on one page, a high one cut between its rows."""
        style = self._style(align=TA_LEFT, indent=0.0, around=3.0, leading=1.2)
        name = self._say.table.format(number=number, text=table.name) if number else ""
        again = self._say.continued.format(number=number) if number else ""
        parts = list(parts_of(table, int(self._width // MIN_COLUMN)))
        for part in parts:
            above = [self._text(name, style)] if name else []
            made = self._table(part)
            made.again = partial(self._text, again, style) if again else None
            high = made.wrap(self._width, self._tallest)[1]
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

    def _title_page(self, page: document.TitlePage) -> Iterator[Flowable]:
        middle = self._style(align=TA_CENTER, indent=0.0, around=2.0, leading=1.3)
        large = self._style(16.0, align=TA_CENTER, indent=0.0, around=4.0, bold=True)
        yield from (self._text(text, middle) for text in page.organisation)
        yield Spacer(0.0, 110.0)
        theme = self._say.theme.format(title=page.title) if page.title else ""
        for text, style in (
            (page.work, large),
            (page.subject, middle),
            (theme, middle),
            (page.designation, middle),
        ):
            if text:
                yield self._text(text, style)
        yield Spacer(0.0, 110.0)
        aside = self._style(align=TA_LEFT, indent=0.0, left=85 * mm, around=3.0)
        for key in ("author", "group", "checker"):
            if text := getattr(page, key):
                yield self._text(self._say[key].format(**{key: text}), aside)
        yield PageBreak()

    def _contents(self) -> Iterator[Flowable]:
        yield self._text(
            self._say.contents, self._style(align=TA_CENTER, indent=0.0, around=8.0, bold=True)
        )
        leading = 1.4 * self._tight.get(self._section, 1.0)
        contents = TableOfContents()
        contents.dotsMinLevel = 0
        contents.tableStyle = TableStyle(
            [*CLOSE, ("FONTNAME", (0, 0), (-1, -1), self._fonts.upright)]
        )
        contents.levelStyles = [
            self._style(
                align=TA_LEFT, indent=0.0, left=7 * mm * level, right=TITLE_MARGIN, leading=leading
            )
            for level in range(3)
        ]
        yield contents
        yield PageBreak()


def _words(cell: Rich) -> list[str]:
    return plain_text(without_control_characters(cell)).split() or [""]
