"""A document as a file of Word, its formulas native equations (документ Word).

Page, letters and headings are those of GOST 7.32: margins of 30, 15, 20 and 20 mm, letters of 14
points, one and a half line; a template of a department brings its own. The file does not depend on
the clock: the same document gives the same bytes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import ceil
from pathlib import Path
from typing import Any, assert_never

from docx.enum.section import WD_ORIENT, WD_SECTION
from docx.enum.table import WD_CELL_VERTICAL_ALIGNMENT
from docx.enum.text import WD_ALIGN_PARAGRAPH
from docx.oxml.ns import qn
from docx.shared import Mm, Pt

from planmethod.errors import PlanMethodError
from planmethod.note.document import Document, PageBreak, Table
from planmethod.note.formula import Node as Sign, Rich, parse
from planmethod.note.wording import Language
from planmethod.note.writers import lowering, omml
from planmethod.note.writers.formulas import lines_of, with_levels, without_control_characters
from planmethod.note.writers.lowering import LoweredDocument, LoweredNode, TextKind, lower
from planmethod.note.writers.word_parts import (
    BOTTOM,
    HEADINGS,
    LEAST_SIZE,
    LEFT,
    MAX_UNCUT_ROWS,
    MM_PER_POINT,
    PAD,
    PAGE,
    RIGHT,
    SIZE,
    STRIP,
    TABLE_SIZE,
    TOP,
    PageFlow,
    WordStyles,
    add_field,
    add_link,
    add_paragraph,
    add_picture,
    add_sentence,
    clean_text,
    cover,
    field_part,
    fill_width,
    flowing,
    grid,
    head_repeats,
    line_width,
    marked,
    needed_widths,
    parts_of_width,
    row_keeps_with_next,
    rows_of,
    small_paragraph,
    strip_above,
)
from planmethod.note.writers.wordframe import (
    PageFrame,
    damaged,
    fields_of_note,
    opened,
    strip_timestamps,
    update_fields_on_open,
)

SIDE = 16.0
"""Room beside a formula for its number, and as much on the other side, mm."""

BELOW = 12.0
"""Room of the name of a figure, mm."""

_LANGUAGES = {"ru": "ru-RU", "en": "en-US"}


def word_document(
    written: Document | LoweredDocument,
    language: Language,
    *,
    author: str = "",
    template: Path | None = None,
    frame: bool = False,
    stamp: Mapping[str, str] | None = None,
) -> bytes:
    """Return a document as a file of Word.

    Parameters
    ----------
    written : Document or LoweredDocument
    language : Language
    author : str
        For the properties of the file; that of ``stamp`` where it is empty.
    template : Path, optional
        A file of Word whose page and styles are used, without its content.
    frame : bool
        Whether the pages have the frames of GOST 2.104: form 2 on the first one after the title
        page, form 2a on the others.
    stamp : mapping, optional
        The fields of ``[stamp]``.

    Raises
    ------
    OutputError
        The template cannot be read.
    LayoutError
        A formula is malformed, or a text refers to a missing key.
    """
    fields = dict(stamp or {})
    lowered = lower(written, language)

    def build(template: Path | None) -> bytes:
        shown = PageFrame(fields_of_note(fields, lowered), language.frame) if frame else None
        writer = _Writer(language, template, shown)
        writer.write(lowered)
        return writer.file(author or fields.get("author", ""))

    try:
        return build(template)
    except (PlanMethodError, MemoryError, OSError):
        raise
    except Exception as fault:
        if template is None:
            raise
        build(None)  # a failure only with a template is the fault of the template
        raise damaged(template) from fault


class _Writer:
    """Puts nodes into a file one after another."""

    def __init__(self, language: Language, template: Path | None, frame: PageFrame | None) -> None:
        self._frame = frame
        self._file: Any = opened(template)
        self._styles = WordStyles(self._file, new=template is None, lang=_LANGUAGES[language.lang])
        self._breaks = False
        self._mark = self._pictures = 0
        self._pages = dict[int, int]()
        self._shown = dict[int, Any]()
        section = self._section = self._file.sections[-1]
        if template is None:
            section.page_width, section.page_height = Mm(PAGE[0]), Mm(PAGE[1])
            section.left_margin, section.right_margin = Mm(LEFT), Mm(RIGHT)
            section.top_margin, section.bottom_margin = Mm(TOP), Mm(BOTTOM)
        self._has_pages = False
        self._width = _width_of(section)
        self._flow = PageFlow(
            (section.page_height - section.top_margin - section.bottom_margin) / Mm(1)
        )

    # The whole ------------------------------------------------------------------------------------

    def write(self, written: LoweredDocument) -> None:
        """Put all nodes into the file."""
        self._written = written
        for node in flowing(written.nodes, self._flow, self._height):
            if not isinstance(node, lowering.Cover):
                self._with_pages()
            self._node(node)
        self._with_pages()
        for mark, run in self._shown.items():
            run.text = str(self._pages[mark])
        last = self._file.element.body[-2] if len(self._file.element.body) > 1 else None
        if last is not None and last.tag == qn("w:tbl"):
            small_paragraph(add_paragraph(self._file))  # Word wants one after a table

    def _height(self, figure: lowering.NamedFigure) -> float:
        """Return the height of a figure with its name, mm."""
        return figure.view.size[1] * self._figure_scale(figure) + BELOW

    def _figure_scale(self, figure: lowering.NamedFigure) -> float:
        """Return the scale of a figure that fits it to a page, at most 1."""
        width, height = figure.view.size
        section = self._section
        tall = (section.page_height - section.top_margin - section.bottom_margin) / Mm(1) - 25.0
        return float(min(1.0, self._width / width, tall / height))

    def _with_pages(self) -> None:
        """Begin to number the pages, in a frame if that is wished."""
        if self._has_pages:
            return
        self._has_pages = True
        section = self._section
        if self._frame is not None:
            self._frame.add_first_form(section)
            return
        section.footer.is_linked_to_previous = False
        foot = section.footer.paragraphs[0]
        self._styles.apply(foot, "Page Number Line")
        add_field(foot, "PAGE", "1")

    def file(self, author: str) -> bytes:
        """Return the file, without a trace of when it was made."""
        if self._written.is_note:
            update_fields_on_open(self._file)
        return strip_timestamps(
            self._file, title=clean_text(self._written.title), author=author or "planmethod"
        )

    # Nodes ----------------------------------------------------------------------------------------

    def _node(self, node: LoweredNode) -> None:
        match node:
            case lowering.Cover():
                self._cover(node)
            case lowering.Heading(text, 0):
                self._text(text, "Title")
            case lowering.Heading():
                self._breaks |= node.is_structural
                self._heading(node)
            case lowering.ContentsList():
                self._contents(node)
            case PageBreak():
                self._breaks = True
            case lowering.Text():
                self._lines_of_text(node)
            case lowering.DisplayedFormula(text, number):
                nodes = tuple(with_levels(parse(without_control_characters(text))))
                self._displayed([omml.equation(line) for line in self._lines(nodes)], number)
            case lowering.DisplayedEquations(equations, number):
                room = self._width_em * (1.0 - 2.0 * SIDE / self._width * bool(number))
                self._displayed([omml.vector_equations(equations, room)], number)
            case lowering.NamedTable():
                self._table(node)
            case lowering.NamedFigure():
                self._figure(node)
            case _:
                assert_never(node)

    def _lines_of_text(self, node: lowering.Text) -> None:
        match node.kind:
            case TextKind.STEP:
                self._stepped(node)
            case TextKind.CAPTION:
                self._text(node.text, "Subheading")
            case TextKind.NOTE:
                self._text(node.text, "Remark")
            case TextKind.PARAGRAPH | TextKind.ITEM | TextKind.SOURCE:
                self._add_sentences(lowering.marked_text(node), keep_with_next=node.introduces_next)
            case _:
                assert_never(node.kind)

    def _paragraph(self, style: str, holder: Any = None) -> Any:
        made = holder.add_paragraph() if holder else add_paragraph(self._file)
        self._styles.apply(made, style)
        if self._breaks and holder is None:
            made.paragraph_format.page_break_before = True
            self._breaks = False
            self._flow.begin_page()
        return made

    def _text(self, rich: Rich, style: str, holder: Any = None) -> Any:
        made = self._paragraph(style, holder)
        self._fill(made, rich)
        self._flow.text(rich, self._width)
        return made

    def _add_sentences(self, rich: Rich, *, keep_with_next: bool) -> None:
        """Add a paragraph of sentences; one that introduces a formula stays with it."""
        made = self._text(rich, "Normal")
        if keep_with_next:
            made.paragraph_format.keep_with_next = True

    def _fill(self, paragraph: Any, rich: Rich, *, joined: bool = True) -> None:
        sentence = self._written.divide(rich, symbols=True)
        add_sentence(paragraph, sentence, self._width_em, joined=joined)

    @property
    def _width_em(self) -> float:
        """Width of the text in heights of its font."""
        return self._width / (SIZE * MM_PER_POINT)

    def _lines(self, nodes: Sequence[Sign]) -> list[tuple[Sign, ...]]:
        return lines_of(nodes, 0.9 * self._width_em)

    def _heading(self, node: lowering.Heading) -> None:
        made = self._paragraph(HEADINGS[node.level - 1])
        if node.is_structural:
            made.alignment = WD_ALIGN_PARAGRAPH.CENTER
            made.paragraph_format.first_line_indent = 0
        self._flow.heading()
        self._mark += 1
        self._pages[self._mark] = self._flow.page
        with marked(made, self._mark):
            self._fill(made, node.numbered_text, joined=False)

    def _stepped(self, node: lowering.Text) -> None:
        """Add the lines of a step; a line that is a formula alone is centred."""
        for part in lowering.step_parts(node, self._written):
            if part.formula:
                self._displayed([omml.equation(row) for row in self._lines(part.formula)], "")
            else:
                self._add_sentences(part.text, keep_with_next=part.introduces_next)

    # Formulas -------------------------------------------------------------------------------------

    def _displayed(self, formulas: Sequence[Any], number: str) -> None:
        """Put formulas one under another in the middle, the number beside the last."""
        for formula in formulas:
            tall = formula.find(f".//{{{omml.MATH}}}f") is not None
            rows = formula.findall(f".//{{{omml.MATH}}}eqArr/{{{omml.MATH}}}e")
            self._flow.reserve(11.0 * max(1, len(rows)) if tall or rows else 7.5)
        if not number:
            for formula in formulas:
                self._paragraph("Formula")._p.append(omml.paragraph(formula))
            return
        widths = (SIDE, self._width - 2 * SIDE, SIDE)
        _, middle, right = rows_of(self._grid(1, widths))[0]
        for k, formula in enumerate(formulas):
            place = middle.paragraphs[0] if not k else middle.add_paragraph()
            self._styles.apply(place, "Formula")
            place._p.append(omml.paragraph(formula))
        right.vertical_alignment = WD_CELL_VERTICAL_ALIGNMENT.CENTER
        beside = right.paragraphs[0]
        self._styles.apply(beside, "Formula")
        beside.alignment = WD_ALIGN_PARAGRAPH.RIGHT
        beside.add_run(f"({number})")
        small_paragraph(add_paragraph(self._file))  # tables one after another would be one

    def _grid(self, rows: int, widths: Sequence[float], style: Any = None) -> Any:
        """Return an empty table with columns of given widths, mm."""
        if self._breaks:
            small_paragraph(self._paragraph("Normal"))
        return grid(self._file, rows, widths, style)

    # Tables ---------------------------------------------------------------------------------------

    def _table(self, node: lowering.NamedTable) -> None:
        """Add a table; one that is too wide is cut, or put on a landscape page."""
        table, room, again = node.table, self._width, node.continuation
        size = next(
            (s for s in (TABLE_SIZE, LEAST_SIZE) if sum(needed_widths(table, s)) <= room), None
        )
        if size is not None:
            self._one_table(table, node.name, size, again)
        elif table.repeated:
            for k, part in enumerate(parts_of_width(table, LEAST_SIZE, room)):
                self._one_table(part, "" if k else node.name, LEAST_SIZE, again)
        else:
            self._begin_page(lying=True)
            self._one_table(table, node.name, LEAST_SIZE, again)
            self._begin_page(lying=False)

    def _begin_page(self, *, lying: bool) -> None:
        """Begin a landscape page, or a portrait one again."""
        self._flow.begin_page()
        section = self._section = self._file.add_section(WD_SECTION.NEW_PAGE)
        wide = max(section.page_width, section.page_height)
        high = min(section.page_width, section.page_height)
        section.orientation = WD_ORIENT.LANDSCAPE if lying else WD_ORIENT.PORTRAIT
        section.page_width, section.page_height = (wide, high) if lying else (high, wide)
        self._width = _width_of(section)
        if self._frame is not None:
            self._frame.add_later_form(section)

    def _one_table(self, table: Table, name: Rich, size: float, again: Rich) -> None:
        """Add a table; ``again`` is repeated above it on each page but the one with its name."""
        rows = (table.head, *table.rows)
        may_break = bool(again) and (len(rows) > MAX_UNCUT_ROWS or not name)
        if name:
            named = self._text(name, "Table Name")
            if may_break:
                named.paragraph_format.space_after = Pt(0)
                above = self._paragraph("Table Name")
                small_paragraph(above)
                cover(above, self._width)
        widths = fill_width(needed_widths(table, size), self._width)
        made = self._grid(len(rows), widths, self._styles.table)
        head_repeats(made)
        em = size * MM_PER_POINT
        for k, (cells, texts) in enumerate(zip(rows_of(made), rows, strict=True)):
            high = (line_width(t, em) / (w - PAD) for t, w in zip(texts, widths, strict=True))
            self._flow.reserve(1.2 * em * max(1, *map(ceil, high)))
            for column, (cell, text) in enumerate(zip(cells, texts, strict=True)):
                place = cell.paragraphs[0]
                self._styles.apply(place, "Table Text" if size == TABLE_SIZE else "Small Table")
                if row_keeps_with_next(k, len(rows)):
                    place.paragraph_format.keep_with_next = True
                if not k:
                    place.alignment = WD_ALIGN_PARAGRAPH.CENTER
                elif column in table.numbers:
                    place.alignment = WD_ALIGN_PARAGRAPH.RIGHT
                self._fill(place, text)
        if may_break:
            told = strip_above(made).paragraphs[0]
            self._styles.apply(told, "Table Name")
            told.paragraph_format.space_before = told.paragraph_format.space_after = Pt(0)
            told.paragraph_format.keep_with_next = True
            told.add_run(again)
            self._flow.reserve(STRIP * MM_PER_POINT)
        small_paragraph(add_paragraph(self._file), space=6.0)

    # Figures --------------------------------------------------------------------------------------

    def _figure(self, node: lowering.NamedFigure) -> None:
        """Add a centred picture with its name below, in its own size if it fits."""
        share = self._figure_scale(node)
        place = self._paragraph("Figure")
        self._pictures += 1
        width = node.view.size[0] * share
        add_picture(place.add_run(), node, self._pictures, width, share, self._file.part)
        self._flow.reserve(self._height(node))
        if node.name:
            self._text(node.name, "Caption")
        else:
            place.paragraph_format.keep_with_next = False

    # Title page and contents ----------------------------------------------------------------------

    def _cover(self, page: lowering.Cover) -> None:
        for text in page.organisation:
            self._text(text, "Title Page")
        gap: float = 110.0
        lines = ((page.work, "Title"), *((text, "Title Page") for text in page.subject))
        for text, style in (*lines, (page.designation, "Title Page")):
            if text:
                self._text(text, style).paragraph_format.space_before = Pt(gap)
                gap = 6.0
        gap = 110.0
        for text in page.signatures:
            made = self._text(text, "Title Page")
            made.alignment = WD_ALIGN_PARAGRAPH.LEFT
            made.paragraph_format.left_indent = Mm(85)
            made.paragraph_format.space_before = Pt(gap)
            gap = 6.0
        foot = self._section.footer
        foot.is_linked_to_previous = False
        self._styles.apply(foot.paragraphs[0], "Page Number Line")
        foot.paragraphs[0].add_run(clean_text(page.footer))
        self._flow.begin_page()
        self._section = self._file.add_section(WD_SECTION.NEW_PAGE)
        self._section.footer.is_linked_to_previous = False

    def _contents(self, node: lowering.ContentsList) -> None:
        """Add the field of the contents, with the text it shows until it is updated."""
        self._text(node.title, "Contents Heading")
        fields = self._paragraph("toc 1")
        for kind in ("begin", 'TOC \\o "1-3" \\h \\z \\u', "separate"):
            field_part(fields, kind)
        place = fields
        for mark, heading in enumerate(node.headings, 1):
            place = place if mark == 1 else self._paragraph(f"toc {heading.level}")
            self._styles.apply(place, f"toc {heading.level}")
            self._flow.reserve(7.1)
            self._fill(place, heading.numbered_text, joined=False)
            self._shown[mark] = add_link(place, mark)
        field_part(place, "end")
        self._breaks = True


def _width_of(section: Any) -> float:
    """Return the width of the text, mm."""
    return float((section.page_width - section.left_margin - section.right_margin) / Mm(1))
