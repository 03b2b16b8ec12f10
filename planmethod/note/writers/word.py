"""A document as a file of Word, its formulas native equations (документ Word).

Page, letters and headings are those of GOST 7.32: margins of 30, 15, 20 and 20 mm, letters of 14
points, one and a half line; a template of a department brings its own. The file does not depend on
the clock: the same document gives the same bytes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import zip_longest
from math import ceil
from pathlib import Path
from typing import Any, assert_never

from docx.enum.section import WD_ORIENT, WD_SECTION
from docx.enum.table import WD_CELL_VERTICAL_ALIGNMENT
from docx.enum.text import WD_ALIGN_PARAGRAPH
from docx.oxml.ns import qn
from docx.shared import Mm, Pt

from planmethod.errors import PlanMethodError
from planmethod.note import document
from planmethod.note.document import Document, Figure, Node, Table
from planmethod.note.formula import Node as Sign, Rich, parse
from planmethod.note.wording import Language
from planmethod.note.writers import omml
from planmethod.note.writers.formulas import (
    introduces_next_node,
    lines_of,
    pieces,
    sole_formula,
    units_of,
    with_levels,
)
from planmethod.note.writers.html import without_control_characters
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
    written: Document,
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
    written : Document
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
    told = document.resolve_references(written)

    def build(template: Path | None) -> bytes:
        shown = PageFrame(fields_of_note(fields, written), language.frame) if frame else None
        writer = _Writer(language, template, shown)
        writer.write(told)
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
        self._words, self._say, self._frame = language, language.document, frame
        self._units = units_of(language.note["units"])
        self._file: Any = opened(template)
        self._styles = WordStyles(self._file, new=template is None, lang=_LANGUAGES[language.lang])
        self._breaks = self._leads = False
        self._step = self._mark = 0
        self._pages = dict[int, int]()
        self._shown = dict[int, Any]()
        self._is_note = False
        section = self._file.sections[0]
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

    def write(self, written: Document) -> None:
        """Put all nodes into the file."""
        kinds = {type(node) for node in written.nodes}
        self._is_note = bool(kinds & {document.TitlePage, document.Contents})
        self._headings = list(document.headings_of(written))
        self._title = ""
        numbered = list(document.numbers_of(written))
        told = zip_longest(numbered, written.nodes[1:])
        for (node, number), after in flowing(told, self._flow, self._height):
            self._leads = introduces_next_node(node, after)
            if not isinstance(node, document.TitlePage):
                self._with_pages()
            self._node(node, number)
        self._with_pages()
        for mark, run in self._shown.items():
            run.text = str(self._pages[mark])
        last = self._file.element.body[-2] if len(self._file.element.body) > 1 else None
        if last is not None and last.tag == qn("w:tbl"):
            small_paragraph(self._file.add_paragraph())  # Word wants one after a table

    def _height(self, figure: Figure) -> float:
        """Return the height of a figure with its name, mm."""
        return figure.view.size[1] * self._figure_scale(figure) + BELOW

    def _figure_scale(self, figure: Figure) -> float:
        """Return the scale of a figure that fits it to a page, at most 1."""
        width, height = figure.view.size
        section = self._file.sections[-1]
        tall = (section.page_height - section.top_margin - section.bottom_margin) / Mm(1) - 25.0
        return float(min(1.0, self._width / width, tall / height))

    def _with_pages(self) -> None:
        """Begin to number the pages, in a frame if that is wished."""
        if self._has_pages:
            return
        self._has_pages = True
        section = self._file.sections[-1]
        if self._frame is not None:
            self._frame.add_first_form(section)
            return
        section.footer.is_linked_to_previous = False
        foot = section.footer.paragraphs[0]
        self._styles.apply(foot, "Page Number Line")
        add_field(foot, "PAGE", "1")

    def file(self, author: str) -> bytes:
        """Return the file, without a trace of when it was made."""
        if self._is_note:
            update_fields_on_open(self._file)
        return strip_timestamps(self._file, title=self._title, author=author or "planmethod")

    # Nodes ----------------------------------------------------------------------------------------

    def _node(self, node: Node, number: str) -> None:
        match node:
            case document.Title(text):
                self._title = self._title or clean_text(text)
                self._text(text, "Title")
            case document.TitlePage():
                self._title_page(node)
            case document.Contents():
                self._contents()
            case document.PageBreak():
                self._breaks = True
            case document.StructuralHeading(title):
                self._breaks, self._step = True, 0
                self._heading(title, 1, "", middle=True)
            case document.Chapter(title):
                self._step = 0 if self._is_note else self._step
                self._heading(title, 1, number)
            case document.Part(title):
                self._step = 0 if self._is_note else self._step
                self._heading(title, 2, number)
            case document.Subpart(title):
                self._heading(title, 3, number)
            case document.Caption(text):
                self._text(text, "Subheading")
            case document.Paragraph(text):
                self._add_sentences(text)
            case document.Item(text, label):
                self._add_sentences(f"{label}\u2002{text}" if label else f"–\u00a0{text}")
            case document.Step(lines, continues):
                self._stepped(lines, continues=continues)
            case document.Formula(text):
                nodes = tuple(with_levels(parse(without_control_characters(text))))
                self._displayed([omml.equation(line) for line in self._lines(nodes)], number)
            case document.Equations(equations):
                room = self._width_em * (1.0 - 2.0 * SIDE / self._width * bool(number))
                self._displayed([omml.vector_equations(equations, room)], number)
            case document.Table():
                self._table(node, number)
            case document.Figure():
                self._figure(node, number)
            case document.References(entries):
                for k, entry in enumerate(entries, 1):
                    self._text(f"{k}.\u00a0{entry}", "Normal")
            case document.Note(text):
                self._text(text, "Remark")
            case _:
                assert_never(node)

    def _paragraph(self, style: str, holder: Any = None) -> Any:
        made = (holder or self._file).add_paragraph()
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

    def _add_sentences(self, rich: Rich, *, keep_with_next: bool | None = None) -> None:
        """Add a paragraph of sentences; one that introduces a formula stays with it."""
        made = self._text(rich, "Normal")
        if self._leads if keep_with_next is None else keep_with_next:
            made.paragraph_format.keep_with_next = True

    def _fill(self, paragraph: Any, rich: Rich, *, joined: bool = True) -> None:
        add_sentence(paragraph, rich, self._units, self._width_em, joined=joined)

    @property
    def _width_em(self) -> float:
        """Width of the text in heights of its font."""
        return self._width / (SIZE * MM_PER_POINT)

    def _lines(self, nodes: Sequence[Sign]) -> list[tuple[Sign, ...]]:
        return lines_of(nodes, 0.9 * self._width_em)

    def _heading(self, title: Rich, level: int, number: str, *, middle: bool = False) -> None:
        made = self._paragraph(HEADINGS[level - 1])
        if middle:
            made.alignment = WD_ALIGN_PARAGRAPH.CENTER
            made.paragraph_format.first_line_indent = 0
        self._flow.heading()
        self._mark += 1
        self._pages[self._mark] = self._flow.page
        with marked(made, self._mark):
            self._fill(made, f"{number} {title}" if number else title, joined=False)

    def _stepped(self, lines: Sequence[Rich], *, continues: bool) -> None:
        """Add the lines of a step; a line that is a formula alone is centred."""
        self._step += not continues
        alone = [
            sole_formula(pieces(parse(without_control_characters(line)), self._units))
            for line in lines
        ]
        for k, line in enumerate(lines):
            is_last = k + 1 == len(lines)
            if k and alone[k]:
                self._displayed([omml.equation(row) for row in self._lines(alone[k])], "")
                continue
            lead = "" if k or continues else f"{self._step})\u00a0"
            keep = self._leads if is_last else bool(alone[k + 1]) or line.endswith(":")
            self._add_sentences(f"{lead}{line}", keep_with_next=keep)

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
        small_paragraph(self._file.add_paragraph())  # tables one after another would be one

    def _grid(self, rows: int, widths: Sequence[float], style: Any = None) -> Any:
        """Return an empty table with columns of given widths, mm."""
        if self._breaks:
            small_paragraph(self._paragraph("Normal"))
        return grid(self._file, rows, widths, style)

    # Tables ---------------------------------------------------------------------------------------

    def _table(self, table: Table, number: str) -> None:
        """Add a table; one that is too wide is cut, or put on a landscape page."""
        room, again = self._width, self._say.continued.format(number=number) if number else ""
        size = next(
            (s for s in (TABLE_SIZE, LEAST_SIZE) if sum(needed_widths(table, s)) <= room), None
        )
        if size is not None:
            self._one_table(table, self._name(number, table.name), size, again)
        elif table.repeated:
            for k, part in enumerate(parts_of_width(table, LEAST_SIZE, room)):
                name = "" if k else self._name(number, table.name)
                self._one_table(part, name, LEAST_SIZE, again)
        else:
            self._begin_page(lying=True)
            self._one_table(table, self._name(number, table.name), LEAST_SIZE, again)
            self._begin_page(lying=False)

    def _name(self, number: str, name: Rich) -> Rich:
        return str(self._say.table.format(number=number, text=name)) if number else ""

    def _begin_page(self, *, lying: bool) -> None:
        """Begin a landscape page, or a portrait one again."""
        self._flow.begin_page()
        section = self._file.add_section(WD_SECTION.NEW_PAGE)
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
        small_paragraph(self._file.add_paragraph(), space=6.0)

    # Figures --------------------------------------------------------------------------------------

    def _figure(self, figure: Figure, number: str) -> None:
        """Add a centred picture with its name below, in its own size if it fits."""
        share = self._figure_scale(figure)
        place = self._paragraph("Figure")
        add_picture(place.add_run(), figure, figure.view.size[0] * share, share, self._file.part)
        self._flow.reserve(self._height(figure))
        caption = figure.caption
        if number:
            caption = self._say.figure.format(number=number, text=caption)
        if caption:
            self._text(caption, "Caption")
        else:
            place.paragraph_format.keep_with_next = False

    # Title page and contents ----------------------------------------------------------------------

    def _title_page(self, page: document.TitlePage) -> None:
        self._title = clean_text(page.title) or clean_text(page.work)
        texts = self._say
        for text in page.organisation:
            self._text(text, "Title Page")
        gap: float = 110.0
        for text, style in (
            (page.work, "Title"),
            (page.subject, "Title Page"),
            (texts.theme.format(title=page.title) if page.title else "", "Title Page"),
            (page.designation, "Title Page"),
        ):
            if text:
                self._text(text, style).paragraph_format.space_before = Pt(gap)
                gap = 6.0
        gap = 110.0
        for key in ("author", "group", "checker"):
            if text := getattr(page, key):
                made = self._text(texts[key].format(**{key: text}), "Title Page")
                made.alignment = WD_ALIGN_PARAGRAPH.LEFT
                made.paragraph_format.left_indent = Mm(85)
                made.paragraph_format.space_before = Pt(gap)
                gap = 6.0
        foot = self._file.sections[-1].footer
        foot.is_linked_to_previous = False
        self._styles.apply(foot.paragraphs[0], "Page Number Line")
        foot.paragraphs[0].add_run(
            " ".join(filter(None, (clean_text(page.place), clean_text(page.year))))
        )
        self._flow.begin_page()
        self._file.add_section(WD_SECTION.NEW_PAGE)
        self._file.sections[-1].footer.is_linked_to_previous = False

    def _contents(self) -> None:
        """Add the field of the contents, with the text it shows until it is updated."""
        self._text(self._say.contents, "Contents Heading")
        fields = self._paragraph("toc 1")
        for kind in ("begin", 'TOC \\o "1-3" \\h \\z \\u', "separate"):
            field_part(fields, kind)
        place = fields
        for mark, (level, number, title) in enumerate(self._headings, 1):
            place = place if mark == 1 else self._paragraph(f"toc {level}")
            self._styles.apply(place, f"toc {level}")
            self._flow.reserve(7.1)
            self._fill(place, f"{number} {title}" if number else title, joined=False)
            self._shown[mark] = add_link(place, mark)
        field_part(place, "end")
        self._breaks = True


def _width_of(section: Any) -> float:
    """Return the width of the text, mm."""
    return float((section.page_width - section.left_margin - section.right_margin) / Mm(1))
