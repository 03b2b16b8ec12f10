"""A document as a file of Word, its formulas native equations (документ Word).

Page, letters and headings are those of GOST 7.32: margins of 30, 15, 20 and 20 mm, letters of 14
points, one and a half line; a template of a department brings its own. The file does not depend on
the clock: the same document gives the same bytes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from datetime import datetime
from io import BytesIO
from math import ceil
from pathlib import Path
from typing import Any, assert_never
from zipfile import ZIP_DEFLATED, BadZipFile, ZipFile, ZipInfo

import docx
from docx.enum.section import WD_ORIENT, WD_SECTION
from docx.enum.style import WD_STYLE_TYPE
from docx.enum.table import WD_CELL_VERTICAL_ALIGNMENT, WD_TABLE_ALIGNMENT
from docx.enum.text import WD_ALIGN_PARAGRAPH, WD_TAB_ALIGNMENT, WD_TAB_LEADER
from docx.opc.constants import RELATIONSHIP_TYPE
from docx.opc.exceptions import PackageNotFoundError
from docx.opc.packuri import PackURI
from docx.opc.part import Part
from docx.oxml import OxmlElement
from docx.oxml.ns import qn
from docx.shared import Mm, Pt, RGBColor
from lxml import etree

from planmethod.errors import OutputError
from planmethod.note import document
from planmethod.note.document import Document, Figure, Node, Table
from planmethod.note.formula import Node as Sign
from planmethod.note.formula import Rich, parse
from planmethod.note.plaintext import plain_text
from planmethod.note.wording import Language
from planmethod.note.writers import omml
from planmethod.note.writers.broken import chain_of, ems, lines_of
from planmethod.note.writers.html import clean
from planmethod.note.writers.sentences import (
    formula_alone,
    pieces,
    units_of,
    with_levels,
    with_stops,
)
from planmethod.note.writers.wordframe import PageFrame, field_part, put_field, small_paragraph

FONT = "Times New Roman"
SIZE, TABLE_SIZE, LEAST_SIZE = 14.0, 12.0, 10.0
LEFT, RIGHT, TOP, BOTTOM = 30.0, 15.0, 20.0, 20.0
INDENT = 12.5
PAGE = 210.0, 297.0
LONG = 18.0
"""Width, in heights of the font, from which on a formula in a sentence may be cut at its signs."""

DPI = 300
_WHEN = datetime(2000, 1, 1)
_MM_PER_POINT = 25.4 / 72.0
_PAD = 4.0
_AFTER_FIELDS = ("w:hdrShapeDefaults", "w:footnotePr", "w:endnotePr", "w:compat", "w:docVars",
                 "w:rsids", "m:mathPr", "w:themeFontLang", "w:clrSchemeMapping", "w:shapeDefaults",
                 "w:decimalSymbol", "w:listSeparator")  # fmt: skip
"""What of the settings stands after the wish that fields be computed: Word minds the order."""

_HEADINGS = ("Heading 1", "Heading 2", "Heading 3")
_LANGUAGES = {"ru": "ru-RU", "en": "en-US"}
_SVG = "http://schemas.microsoft.com/office/drawing/2016/SVG/main"
_SVG_EXTENSION = "{96DAC541-7B7A-43D3-8B79-37D633B846F1}"


def word_document(
    written: Document,
    words: Language,
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
    words : Language
    author : str
        For the properties of the file; that of ``stamp`` where it is empty.
    template : Path, optional
        A file of Word whose page and styles are taken; what it holds is left out.
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
        A formula is not written properly, or a text refers to what is not there.
    """
    fields = dict(stamp or {})
    writer = _Writer(words, template, PageFrame(fields, words.frame) if frame else None)
    writer.write(document.referred(written))
    return writer.file(author or fields.get("author", ""))


class _Writer:
    """Puts nodes into a file one after another."""

    def __init__(self, words: Language, template: Path | None, frame: PageFrame | None) -> None:
        self._words, self._say, self._frame = words, words.document, frame
        self._units = units_of(words.note["units"])
        self._file: Any = _opened(template)
        self._styles = _Styles(self._file, new=template is None, lang=_LANGUAGES[words.lang])
        self._breaks = False
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
        self._flow = _Flow(
            (section.page_height - section.top_margin - section.bottom_margin) / Mm(1)
        )

    # The whole ------------------------------------------------------------------------------------

    def write(self, written: Document) -> None:
        """Put all nodes into the file."""
        kinds = {type(node) for node in written.nodes}
        self._is_note = bool(kinds & {document.TitlePage, document.Contents})
        self._headings = list(document.headings_of(written))
        self._title = ""
        for node, number in document.numbers_of(written):
            if not isinstance(node, document.TitlePage):
                self._with_pages()
            self._node(node, number)
        self._with_pages()
        for mark, run in self._shown.items():
            run.text = str(self._pages[mark])
        last = self._file.element.body[-2] if len(self._file.element.body) > 1 else None
        if last is not None and last.tag == qn("w:tbl"):
            small_paragraph(self._file.add_paragraph())  # Word wants one after a table

    def _with_pages(self) -> None:
        """Begin to number the pages, in a frame if that is wished."""
        if self._has_pages:
            return
        self._has_pages = True
        section = self._file.sections[-1]
        if self._frame is not None:
            self._frame.put(section)
            return
        section.footer.is_linked_to_previous = False
        foot = section.footer.paragraphs[0]
        self._styles.put(foot, "Page Number Line")
        put_field(foot, "PAGE", "1")

    def file(self, author: str) -> bytes:
        """Return the file, without a trace of when it was made."""
        properties = self._file.core_properties
        properties.author = properties.last_modified_by = author or "planmethod"
        properties.title, properties.comments = self._title, ""
        properties.created = properties.modified = _WHEN
        properties.revision = 1
        settings = self._file.settings.element
        if self._is_note and settings.find(qn("w:updateFields")) is None:
            update = OxmlElement("w:updateFields")
            update.set(qn("w:val"), "true")
            after = (child for child in settings if child.tag in map(qn, _AFTER_FIELDS))
            place = next(after, None)
            if place is None:
                settings.append(update)
            else:
                place.addprevious(update)
        made, found = BytesIO(), BytesIO()
        self._file.save(made)
        with ZipFile(made) as parts, ZipFile(found, "w", ZIP_DEFLATED) as timeless:
            for name in parts.namelist():
                entry = ZipInfo(name, (1980, 1, 1, 0, 0, 0))
                entry.compress_type = ZIP_DEFLATED
                timeless.writestr(entry, parts.read(name))
        return found.getvalue()

    # Nodes ----------------------------------------------------------------------------------------

    def _node(self, node: Node, number: str) -> None:
        match node:
            case document.Title(text):
                self._title = self._title or plain(text)
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
                self._heading(title, 2, number)
            case document.Subpart(title):
                self._heading(title, 3, number)
            case document.Caption(text):
                self._text(text, "Subheading")
            case document.Paragraph(text):
                self._text(text, "Normal")
            case document.Item(text, label):
                self._text(f"{label}\u2002{text}" if label else f"–\u00a0{text}", "Normal")
            case document.Step(lines, continues):
                self._stepped(lines, continues=continues)
            case document.Formula(text):
                nodes = tuple(with_levels(parse(clean(text))))
                self._displayed([omml.equation(line) for line in self._lines(nodes)], number)
            case document.Equations(equations):
                self._displayed([omml.vector_equations(equations)], number)
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
        self._styles.put(made, style)
        if self._breaks and holder is None:
            made.paragraph_format.page_break_before = True
            self._breaks = False
            self._flow.turn()
        return made

    def _text(self, rich: Rich, style: str, holder: Any = None) -> Any:
        made = self._paragraph(style, holder)
        self._fill(made, rich)
        self._flow.text(rich, self._width)
        return made

    def _fill(self, paragraph: Any, rich: Rich) -> None:
        """Put a sentence into a paragraph, its formulas as equations."""
        for piece in with_stops(pieces(parse(clean(rich)), self._units)):
            if not piece.is_formula:
                paragraph.add_run(piece.text)
                continue
            parts = [("", piece.nodes)]
            if ems(piece.nodes) > LONG:
                parts = list(chain_of(piece.nodes, self._room))
            for sign, nodes in parts:
                if sign:
                    paragraph.add_run(f" {sign} ")
                if nodes:
                    paragraph._p.append(omml.equation(nodes))

    @property
    def _width(self) -> float:
        """Width of the text, mm."""
        section = self._file.sections[-1]
        return float((section.page_width - section.left_margin - section.right_margin) / Mm(1))

    @property
    def _room(self) -> float:
        """Width of the text in heights of its font."""
        return self._width / (SIZE * _MM_PER_POINT)

    def _lines(self, nodes: Sequence[Sign]) -> list[tuple[Sign, ...]]:
        return lines_of(nodes, 0.9 * self._room)

    def _heading(self, title: Rich, level: int, number: str, *, middle: bool = False) -> None:
        made = self._paragraph(_HEADINGS[level - 1])
        if middle:
            made.alignment = WD_ALIGN_PARAGRAPH.CENTER
            made.paragraph_format.first_line_indent = 0
        self._flow.heading()
        self._mark += 1
        self._pages[self._mark] = self._flow.page
        start, end = OxmlElement("w:bookmarkStart"), OxmlElement("w:bookmarkEnd")
        for mark in (start, end):
            mark.set(qn("w:id"), str(self._mark))
        start.set(qn("w:name"), _mark_name(self._mark))
        made._p.append(start)
        self._fill(made, f"{number} {title}" if number else title)
        made._p.append(end)

    def _stepped(self, lines: Sequence[Rich], *, continues: bool) -> None:
        """Put the lines of a step; a line that is a formula alone stands in the middle."""
        self._step += not continues
        for k, line in enumerate(lines):
            found = pieces(parse(clean(line)), self._units)
            if k and (formula := formula_alone(found)):
                self._displayed([omml.equation(row) for row in self._lines(formula)], "")
            elif k or continues:
                self._text(line, "Normal")
            else:
                self._text(f"{self._step})\u00a0{line}", "Normal")

    # Formulas -------------------------------------------------------------------------------------

    def _displayed(self, formulas: Sequence[Any], number: str) -> None:
        """Put formulas one under another in the middle, the number beside the last."""
        for formula in formulas:
            tall = formula.find(f".//{{{omml.MATH}}}f") is not None
            rows = formula.findall(f".//{{{omml.MATH}}}eqArr/{{{omml.MATH}}}e")
            self._flow.put(11.0 * max(1, len(rows)) if tall or rows else 7.5)
        if not number:
            for formula in formulas:
                self._paragraph("Formula")._p.append(omml.paragraph(formula))
            return
        side = 16.0
        widths = (side, self._width - 2 * side, side)
        table = self._grid(1, widths, lines=False)
        _, middle, right = table.rows[0].cells
        for k, formula in enumerate(formulas):
            place = middle.paragraphs[0] if not k else middle.add_paragraph()
            self._styles.put(place, "Formula")
            place._p.append(omml.paragraph(formula))
        right.vertical_alignment = WD_CELL_VERTICAL_ALIGNMENT.CENTER
        beside = right.paragraphs[0]
        self._styles.put(beside, "Formula")
        beside.alignment = WD_ALIGN_PARAGRAPH.RIGHT
        beside.add_run(f"({number})")
        small_paragraph(self._file.add_paragraph())  # tables one after another would be one

    def _grid(self, rows: int, widths: Sequence[float], *, lines: bool = True) -> Any:
        """Return an empty table whose columns are so many mm wide."""
        if self._breaks:
            small_paragraph(self._paragraph("Normal"))
        table = self._file.add_table(rows, len(widths))
        if lines:
            table.style = self._styles.table
        table.autofit = False
        table.alignment = WD_TABLE_ALIGNMENT.CENTER
        for column, width in zip(table.columns, widths, strict=True):
            column.width = Mm(width)
        for row in table.rows:
            for cell, width in zip(row.cells, widths, strict=True):
                cell.width = Mm(width)
        return table

    # Tables ---------------------------------------------------------------------------------------

    def _table(self, table: Table, number: str) -> None:
        """Put a table; one that is too wide is cut, or stands on a page that lies."""
        room = self._width
        size = next((s for s in (TABLE_SIZE, LEAST_SIZE) if sum(_needed(table, s)) <= room), None)
        if size is not None:
            self._one_table(table, self._name(number, table.name), size)
        elif table.repeated:
            for k, part in enumerate(_parts(table, LEAST_SIZE, room)):
                again = self._say.continued.format(number=number) if number else ""
                self._one_table(part, again if k else self._name(number, table.name), LEAST_SIZE)
        else:
            self._turn(lying=True)
            self._one_table(table, self._name(number, table.name), LEAST_SIZE)
            self._turn(lying=False)

    def _name(self, number: str, name: Rich) -> Rich:
        return str(self._say.table.format(number=number, text=name)) if number else ""

    def _turn(self, *, lying: bool) -> None:
        """Begin a page that lies, or one that stands again."""
        self._flow.turn()
        section = self._file.add_section(WD_SECTION.NEW_PAGE)
        wide = max(section.page_width, section.page_height)
        high = min(section.page_width, section.page_height)
        section.orientation = WD_ORIENT.LANDSCAPE if lying else WD_ORIENT.PORTRAIT
        section.page_width, section.page_height = (wide, high) if lying else (high, wide)
        if self._frame is not None:
            self._frame.put_later(section)

    def _one_table(self, table: Table, name: Rich, size: float) -> None:
        if name:
            self._text(name, "Table Name")
        widths = _shares(_needed(table, size), self._width)
        made = self._grid(1 + len(table.rows), widths)
        em = size * _MM_PER_POINT
        for k, (row, texts) in enumerate(zip(made.rows, (table.head, *table.rows), strict=True)):
            high = (_whole(t, em) / (w - _PAD) for t, w in zip(texts, widths, strict=True))
            self._flow.put(1.2 * em * max(1, *map(ceil, high)))
            properties = row._tr.get_or_add_trPr()
            properties.append(OxmlElement("w:cantSplit"))
            if not k:
                properties.append(OxmlElement("w:tblHeader"))
            for column, (cell, text) in enumerate(zip(row.cells, texts, strict=True)):
                place = cell.paragraphs[0]
                self._styles.put(place, "Table Text" if size == TABLE_SIZE else "Small Table")
                if not k:
                    place.alignment = WD_ALIGN_PARAGRAPH.CENTER
                    place.paragraph_format.keep_with_next = True
                elif column in table.numbers:
                    place.alignment = WD_ALIGN_PARAGRAPH.RIGHT
                self._fill(place, text)
        small_paragraph(self._file.add_paragraph(), space=6.0)

    # Figures --------------------------------------------------------------------------------------

    def _figure(self, figure: Figure, number: str) -> None:
        """Put a picture in the middle, as large as it is if there is room, its name below."""
        width, height = figure.view.size
        section = self._file.sections[-1]
        tall = (section.page_height - section.top_margin - section.bottom_margin) / Mm(1) - 25.0
        share = min(1.0, self._width / width, tall / height)
        place = self._paragraph("Figure")
        pixels = BytesIO(figure.view.png(DPI * share))
        picture = place.add_run().add_picture(pixels, Mm(width * share))
        self._flow.put(height * share + 12.0)
        picture._inline.docPr.set("descr", plain(figure.caption))
        self._with_svg(picture, figure.view.svg())
        caption = figure.caption
        if number:
            caption = self._say.figure.format(number=number, text=caption)
        if caption:
            self._text(caption, "Caption")
        else:
            place.paragraph_format.keep_with_next = False

    def _with_svg(self, picture: Any, svg: str) -> None:
        """Put the same picture as SVG beside: programs that know how to take it for the pixels."""
        package = self._file.part.package
        count = sum(part.partname.endswith(".svg") for part in package.iter_parts()) + 1
        part = Part(
            PackURI(f"/word/media/vector{count}.svg"), "image/svg+xml", svg.encode(), package
        )
        name = self._file.part.relate_to(part, RELATIONSHIP_TYPE.IMAGE)
        blip = picture._inline.find(f".//{qn('a:blip')}")
        extensions = etree.SubElement(blip, qn("a:extLst"))
        extension = etree.SubElement(extensions, qn("a:ext"), uri=_SVG_EXTENSION)
        beside = etree.SubElement(extension, f"{{{_SVG}}}svgBlip", nsmap={"asvg": _SVG})
        beside.set(qn("r:embed"), name)

    # Title page and contents ----------------------------------------------------------------------

    def _title_page(self, page: document.TitlePage) -> None:
        self._title = plain(page.title) or plain(page.work)
        say = self._say
        for text in page.organisation:
            self._text(text, "Title Page")
        gap: float = 110.0
        for text, style in (
            (page.work, "Title"),
            (page.subject, "Title Page"),
            (say.theme.format(title=page.title) if page.title else "", "Title Page"),
            (page.designation, "Title Page"),
        ):
            if text:
                self._text(text, style).paragraph_format.space_before = Pt(gap)
                gap = 6.0
        gap = 110.0
        for key in ("author", "group", "checker"):
            if text := getattr(page, key):
                made = self._text(say[key].format(**{key: text}), "Title Page")
                made.alignment = WD_ALIGN_PARAGRAPH.LEFT
                made.paragraph_format.left_indent = Mm(85)
                made.paragraph_format.space_before = Pt(gap)
                gap = 6.0
        foot = self._file.sections[-1].footer
        foot.is_linked_to_previous = False
        self._styles.put(foot.paragraphs[0], "Page Number Line")
        foot.paragraphs[0].add_run(" ".join(filter(None, (plain(page.place), plain(page.year)))))
        self._flow.turn()
        self._file.add_section(WD_SECTION.NEW_PAGE)
        self._file.sections[-1].footer.is_linked_to_previous = False

    def _contents(self) -> None:
        """Put the field of the contents, with what it will show until it is brought up to date."""
        self._text(self._say.contents, "Contents Heading")
        fields = self._paragraph("toc 1")
        for kind in ("begin", 'TOC \\o "1-3" \\h \\z \\u', "separate"):
            field_part(fields, kind)
        place = fields
        for mark, (level, number, title) in enumerate(self._headings, 1):
            place = place if mark == 1 else self._paragraph(f"toc {level}")
            self._styles.put(place, f"toc {level}")
            self._flow.put(7.1)
            link = OxmlElement("w:hyperlink")
            link.set(qn("w:anchor"), _mark_name(mark))
            self._fill(place, f"{number} {title}" if number else title)
            for child in list(place._p):
                if child.tag in (qn("w:r"), f"{{{omml.MATH}}}oMath") and not len(
                    child.findall(qn("w:fldChar")) + child.findall(qn("w:instrText"))
                ):
                    link.append(child)
            place._p.append(link)
            held = place.add_run("\t")
            link.append(held._r)
            before = len(place._p)
            self._shown[mark] = put_field(place, f"PAGEREF {_mark_name(mark)} \\h", "")
            for child in list(place._p)[before:]:
                link.append(child)
        field_part(place, "end")
        self._breaks = True


# Fields and properties ----------------------------------------------------------------------------


def _mark_name(number: int) -> str:
    return f"_Toc{number:06}"


def plain(rich: Rich) -> str:
    """Return rich text as plain, without control signs."""
    return plain_text(clean(rich))


def _opened(template: Path | None) -> Any:
    """Return a new file, or the template without what it holds."""
    if template is None:
        return docx.Document()
    try:
        file = docx.Document(str(template))
    except (OSError, PackageNotFoundError, BadZipFile, KeyError, ValueError) as fault:
        raise OutputError(
            "The template {} cannot be read as a file of Word: {}. Give a .docx file.",
            template,
            fault,
        ) from fault
    body = file.element.body
    for child in list(body):
        if child.tag != qn("w:sectPr"):
            body.remove(child)
    return file


class _Flow:
    """Tells about on which page something will stand, until Word has set the pages itself."""

    LINE = SIZE * 1.15 * 1.5 * _MM_PER_POINT
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
        letters = 0.49 * SIZE * _MM_PER_POINT * len(plain(rich)) + INDENT
        for line in range(ceil(letters / width)):
            self.put(self.LINE + (4.0 if not line and "\\frac{" in rich else 0.0))

    def heading(self) -> None:
        """Take room for a heading, which stands with what follows."""
        if self._used + 3 * self.LINE > self._room:
            self.turn()
        self.put(self.LINE + 5.6)


# Styles -------------------------------------------------------------------------------------------


class _Styles:
    """Styles of a file by name; those that a template has not are added."""

    def __init__(self, file: Any, *, new: bool, lang: str) -> None:
        self._file, self._new = file, new
        self._known = dict[str, Any]()
        normal = self["Normal"]
        if new:
            self._format(normal, 1.5, INDENT, WD_ALIGN_PARAGRAPH.JUSTIFY)
            _letters(normal, SIZE)
            language = OxmlElement("w:lang")
            language.set(qn("w:val"), lang)
            normal.element.get_or_add_rPr().append(language)
        for name in _HEADINGS:
            self._made(name, 1.5, INDENT, WD_ALIGN_PARAGRAPH.LEFT, bold=True, around=8.0)
        middle, left = WD_ALIGN_PARAGRAPH.CENTER, WD_ALIGN_PARAGRAPH.LEFT
        self._made("Title", 1.5, 0.0, middle, bold=True, size=16.0, around=6.0)
        self._made("Title Page", 1.25, 0.0, middle)
        self._made("Contents Heading", 1.5, 0.0, middle, bold=True, around=8.0)
        self._made("Subheading", 1.5, INDENT, left, keep=True)
        self._made("Remark", 1.0, INDENT, WD_ALIGN_PARAGRAPH.JUSTIFY, size=TABLE_SIZE)
        self._made("Formula", 1.15, 0.0, middle, around=3.0)
        self._made("Figure", 1.0, 0.0, middle, keep=True, around=6.0)
        self._made("Caption", 1.0, 0.0, middle, around=6.0)
        self._made("Table Name", 1.0, 0.0, left, keep=True, around=3.0)
        self._made("Table Text", 1.0, 0.0, left, size=TABLE_SIZE)
        self._made("Small Table", 1.0, 0.0, left, size=LEAST_SIZE)
        self._made("Title Block", 1.0, 0.0, middle, size=8.0)
        self._made("Page Number Line", 1.0, 0.0, middle, size=TABLE_SIZE)
        for level in (1, 2, 3):
            style = self._made(f"toc {level}", 1.25, 0.0, left)
            if style is not None:
                form = style.paragraph_format
                form.left_indent, form.right_indent = Mm(7.0 * (level - 1)), Mm(10.0)
                width = PAGE[0] - LEFT - RIGHT
                form.tab_stops.add_tab_stop(Mm(width), WD_TAB_ALIGNMENT.RIGHT, WD_TAB_LEADER.DOTS)

    def __getitem__(self, name: str) -> Any:
        if name not in self._known:
            self._known[name] = self._file.styles[name]
        return self._known[name]

    def put(self, paragraph: Any, name: str) -> None:
        """Give a paragraph a style, without the search of the library for what it is called."""
        paragraph._p.style = self[name].style_id

    @property
    def table(self) -> Any:
        """The style of tables with lines."""
        names = [style.name for style in self._file.styles if style.type == WD_STYLE_TYPE.TABLE]
        return self["Table Grid"] if "Table Grid" in names else None

    def _made(
        self,
        name: str,
        spacing: float,
        indent: float,
        alignment: Any,
        *,
        bold: bool = False,
        size: float = SIZE,
        around: float = 0.0,
        keep: bool = False,
    ) -> Any:
        """Return a style that is set here; None where the template has it."""
        known = {style.name for style in self._file.styles}
        if name in known and not self._new:
            return None
        styles = self._file.styles
        if name in known:
            style = self[name]
        else:
            is_own = not name.startswith("toc ")
            style = styles.add_style(name, WD_STYLE_TYPE.PARAGRAPH, builtin=not is_own)
        if name not in known:
            style.base_style = self["Normal"]
        self._format(style, spacing, indent, alignment)
        form = style.paragraph_format
        form.space_before = form.space_after = Pt(around)
        form.keep_with_next = keep or name in _HEADINGS
        for border in style.element.findall(f".//{qn('w:pBdr')}"):
            border.getparent().remove(border)
        _letters(style, size, bold=bold)
        return style

    def _format(self, style: Any, spacing: float, indent: float, alignment: Any) -> None:
        form = style.paragraph_format
        form.line_spacing, form.first_line_indent = spacing, Mm(indent)
        form.alignment = alignment
        form.space_before = form.space_after = Pt(0)


def _letters(style: Any, size: float, *, bold: bool = False) -> None:
    """Give a style its letters, whatever the theme of the file has."""
    font = style.font
    font.name, font.size, font.bold, font.italic = FONT, Pt(size), bold, False
    font.color.rgb = RGBColor(0, 0, 0)
    fonts = style.element.get_or_add_rPr().get_or_add_rFonts()
    for key in list(fonts.attrib):
        del fonts.attrib[key]
    for key in ("ascii", "hAnsi", "cs", "eastAsia"):
        fonts.set(qn(f"w:{key}"), FONT)


# Widths of columns --------------------------------------------------------------------------------


def _needed(table: Table, size: float) -> list[float]:
    """Return how wide columns must be at least, mm: words are not cut."""
    em, columns = size * _MM_PER_POINT, zip(table.head, *table.rows, strict=True)
    return [max(_widest(text, em) for text in column) + _PAD for column in columns]


def _widest(rich: Rich, em: float) -> float:
    return max((0.58 * em * len(word) for word in plain(rich).split()), default=0.0)


def _whole(rich: Rich, em: float) -> float:
    return 0.55 * em * len(plain(rich))


def _shares(needed: Sequence[float], room: float) -> list[float]:
    """Return widths that fill the room: what is left over is given in proportion."""
    total = sum(needed)
    return [width * room / total for width in needed]


def _parts(table: Table, size: float, room: float) -> Iterator[Table]:
    """Yield a table cut between its columns, each part with the leading ones."""
    needed, lead = _needed(table, size), table.repeated
    start = lead
    while start < len(needed):
        end, width = start, sum(needed[:lead])
        while end < len(needed) and (end == start or width + needed[end] <= room):
            width += needed[end]
            end += 1
        rows = (row[:lead] + row[start:end] for row in (table.head, *table.rows))
        head, *others = rows
        yield Table(head, tuple(others), table.names, lead)
        start = end
