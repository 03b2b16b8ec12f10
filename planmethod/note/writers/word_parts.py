"""Parts of a document of Word: styles, paragraphs, tables, pictures, estimate of pages."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import cached_property
from io import BytesIO
from itertools import zip_longest
from math import ceil
from typing import Any

from docx.enum.style import WD_STYLE_TYPE
from docx.enum.table import WD_TABLE_ALIGNMENT
from docx.enum.text import WD_ALIGN_PARAGRAPH, WD_LINE_SPACING, WD_TAB_ALIGNMENT, WD_TAB_LEADER
from docx.opc.constants import RELATIONSHIP_TYPE
from docx.opc.packuri import PackURI
from docx.opc.part import Part
from docx.oxml import OxmlElement, parse_xml
from docx.oxml.ns import nsdecls, qn
from docx.oxml.shape import CT_Inline
from docx.oxml.table import CT_Tbl
from docx.shared import Mm, Pt, RGBColor
from docx.table import Table as WordTable, _Cell
from docx.text.paragraph import Paragraph
from lxml import etree
from msgspec import Struct

from planmethod.note.document import Table, plain_text
from planmethod.note.formula import Rich
from planmethod.note.writers import lowering, omml
from planmethod.note.writers.formulas import (
    SentencePart,
    chain_of,
    tied,
    width_em,
    with_stops,
    without_control_characters,
)
from planmethod.note.writers.lowering import LoweredNode, TextKind

FONT = "Times New Roman"
SIZE, TABLE_SIZE, LEAST_SIZE = 14.0, 12.0, 10.0
LEFT, RIGHT, TOP, BOTTOM = 30.0, 15.0, 20.0, 20.0
INDENT = 12.5
PAGE = 210.0, 297.0
MM_PER_POINT = 25.4 / 72.0

HEADINGS = ("Heading 1", "Heading 2", "Heading 3")


class StyleForm(Struct, frozen=True):
    """Form of a style of paragraphs.

    ``spacing`` is that of the lines, ``indent`` that of the first line, mm, ``size`` that of the
    letters, and ``around`` the white before and after, points.
    """

    spacing: float
    indent: float
    alignment: WD_ALIGN_PARAGRAPH
    bold: bool = False
    size: float = SIZE
    around: float = 0.0
    keep_with_next: bool = False


_LEFT, _MIDDLE = WD_ALIGN_PARAGRAPH.LEFT, WD_ALIGN_PARAGRAPH.CENTER
_BOTH = WD_ALIGN_PARAGRAPH.JUSTIFY

NORMAL = StyleForm(1.5, INDENT, _BOTH)

STYLES = {
    **dict.fromkeys(
        HEADINGS, StyleForm(1.5, INDENT, _LEFT, bold=True, around=8.0, keep_with_next=True)
    ),
    "Title": StyleForm(1.5, 0.0, _MIDDLE, bold=True, size=16.0, around=6.0),
    "Title Page": StyleForm(1.25, 0.0, _MIDDLE),
    "Contents Heading": StyleForm(1.5, 0.0, _MIDDLE, bold=True, around=8.0),
    "Subheading": StyleForm(1.5, INDENT, _LEFT, keep_with_next=True),
    "Remark": StyleForm(1.0, INDENT, _BOTH, size=TABLE_SIZE),
    "Formula": StyleForm(1.15, 0.0, _MIDDLE, around=3.0),
    "Figure": StyleForm(1.0, 0.0, _MIDDLE, keep_with_next=True, around=6.0),
    "Caption": StyleForm(1.0, 0.0, _MIDDLE, around=6.0),
    "Table Name": StyleForm(1.0, 0.0, _LEFT, keep_with_next=True, around=3.0),
    "Table Text": StyleForm(1.0, 0.0, _LEFT, size=TABLE_SIZE),
    "Small Table": StyleForm(1.0, 0.0, _LEFT, size=LEAST_SIZE),
    "Title Block": StyleForm(1.0, 0.0, _MIDDLE, size=8.0),
    "Page Number Line": StyleForm(1.0, 0.0, _MIDDLE, size=TABLE_SIZE),
}
"""Styles that a file has, in their order."""


_PARAGRAPH_FORM, _PARAGRAPH_STYLE, _VALUE = qn("w:pPr"), qn("w:pStyle"), qn("w:val")


class WordStyles:
    """Styles of a file by name; those that a template has not are added."""

    def __init__(self, file: Any, *, new: bool, lang: str) -> None:
        self._file, self._new = file, new
        self._known, self._ids = dict[str, Any](), dict[str, str]()
        self._there = {style.name for style in file.styles}
        normal = self["Normal"]
        if new:
            _format(normal, NORMAL)
            _letters(normal, SIZE)
            language = OxmlElement("w:lang")
            language.set(qn("w:val"), lang)
            normal.element.get_or_add_rPr().append(language)
        for name, named_form in STYLES.items():
            self._add_style(name, named_form)
        for level in (1, 2, 3):
            style = self._add_style(f"toc {level}", StyleForm(1.25, 0.0, _LEFT))
            if style is not None:
                form = style.paragraph_format
                form.left_indent, form.right_indent = Mm(7.0 * (level - 1)), Mm(10.0)
                width = PAGE[0] - LEFT - RIGHT
                form.tab_stops.add_tab_stop(Mm(width), WD_TAB_ALIGNMENT.RIGHT, WD_TAB_LEADER.DOTS)

    def __getitem__(self, name: str) -> Any:
        if name not in self._known:
            self._known[name] = self._file.styles[name]
        return self._known[name]

    def apply(self, paragraph: Any, name: str) -> None:
        """Give a paragraph a style, without the library's search by name."""
        if name not in self._ids:
            self._ids[name] = self[name].style_id
        if len(paragraph._p):
            paragraph._p.style = self._ids[name]
        else:
            form = etree.SubElement(paragraph._p, _PARAGRAPH_FORM)
            etree.SubElement(form, _PARAGRAPH_STYLE).set(_VALUE, self._ids[name])

    @cached_property
    def table(self) -> Any:
        """The style of tables with lines."""
        names = [style.name for style in self._file.styles if style.type == WD_STYLE_TYPE.TABLE]
        return self["Table Grid"] if "Table Grid" in names else None

    def _add_style(self, name: str, form: StyleForm) -> Any:
        """Return a style that is set here; None where the template has it."""
        if name in self._there and not self._new:
            return None
        if name in self._there:
            style = self[name]
        else:
            is_own = not name.startswith("toc ")
            style = self._file.styles.add_style(name, WD_STYLE_TYPE.PARAGRAPH, builtin=not is_own)
            style.base_style = self["Normal"]
        _format(style, form)
        style.paragraph_format.keep_with_next = form.keep_with_next
        for border in style.element.findall(f".//{qn('w:pBdr')}"):
            border.getparent().remove(border)
        _letters(style, form.size, bold=form.bold)
        return style


def _format(style: Any, form: StyleForm) -> None:
    """Give the paragraphs of a style their form."""
    own = style.paragraph_format
    own.line_spacing, own.first_line_indent = form.spacing, Mm(form.indent)
    own.alignment = form.alignment
    own.space_before = own.space_after = Pt(form.around)


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


MAX_PASSED = 12
"""Largest number of paragraphs and formulas moved before a figure that does not fit."""

_FLOWS = (TextKind.PARAGRAPH, TextKind.ITEM, TextKind.STEP, TextKind.NOTE)


def _flows(node: LoweredNode | None) -> bool:
    """Return whether a node is text that may go before a figure."""
    match node:
        case lowering.Text(kind=kind):
            return kind in _FLOWS
        case lowering.DisplayedFormula() | lowering.DisplayedEquations():
            return True
        case _:
            return False


def flowing(
    nodes: Sequence[LoweredNode], flow: PageFlow, height: Callable[[lowering.NamedFigure], float]
) -> Iterator[LoweredNode]:
    """Yield nodes; a figure that does not fit on the page lets the text after it go before.

    It waits until the text has filled the page, or until a node that is not text. ``height`` gives
    the height of a figure with its name, mm.
    """
    waiting: lowering.NamedFigure | None = None
    page = passed = 0
    led = False
    for node, after in zip_longest(nodes, nodes[1:]):
        is_full = flow.page > page or passed >= MAX_PASSED
        if waiting and (not _flows(node) or (is_full and not led)):
            yield waiting
            waiting = None
        if isinstance(node, lowering.NamedFigure) and _flows(after) and not flow.has(height(node)):
            waiting, page, passed = node, flow.page, 0
            continue
        passed, led = passed + 1, isinstance(node, lowering.Text) and node.introduces_next
        yield node
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


LONG = 18.0
"""Width, in heights of the font, from which on a formula in a sentence may be cut at its signs."""


def add_sentence(
    paragraph: Any, sentence: Sequence[SentencePart], max_width: float, *, joined: bool = True
) -> None:
    """Put a divided sentence into a paragraph, its formulas as equations.

    ``joined``: no line ends within a range of numbers; a sign without width sees to that.
    """
    for piece in with_stops(sentence):
        if not piece.is_formula:
            add_text(paragraph, tied(piece.text) if joined else piece.text)
            continue
        parts = [("", piece.nodes)]
        if width_em(piece.nodes) > LONG:
            parts = list(chain_of(piece.nodes, max_width))
        for sign, nodes in parts:
            if sign:
                add_text(paragraph, f" {sign} ")
            if nodes:
                paragraph._p.append(omml.equation(nodes))


# The library searches the whole file for the place of each new paragraph, run, table and picture,
# so that a file takes time with the square of its length: they are put at its end here.


def add_text(paragraph: Any, text: str) -> None:
    """Put a run of letters at the end of a paragraph."""
    if any(sign in text for sign in "\t\r\n"):
        paragraph.add_run(text)
        return
    run = etree.SubElement(paragraph._p, _RUN)
    if text:
        letters = etree.SubElement(run, _LETTERS)
        letters.text = text
        if text.strip() != text:
            letters.set(_SPACE, "preserve")


_RUN, _LETTERS, _SECTION = qn("w:r"), qn("w:t"), qn("w:sectPr")
_SPACE = "{http://www.w3.org/XML/1998/namespace}space"


def add_paragraph(file: Any) -> Paragraph:
    """Put an empty paragraph at the end of a file."""
    made = OxmlElement("w:p")
    _append_element(file, made)
    return Paragraph(made, file._body)


def _append_element(file: Any, element: Any) -> None:
    """Put an element behind all content; the properties of the last section stay behind it."""
    body = file.element.body
    if len(body) and body[-1].tag == _SECTION:
        body[-1].addprevious(element)
    else:
        body.append(element)


@contextmanager
def marked(paragraph: Any, number: int) -> Iterator[None]:
    """Put a bookmark of the contents around text added to a paragraph meanwhile."""
    start, end = OxmlElement("w:bookmarkStart"), OxmlElement("w:bookmarkEnd")
    for mark in (start, end):
        mark.set(qn("w:id"), str(number))
    start.set(qn("w:name"), _mark_name(number))
    paragraph._p.append(start)
    yield
    paragraph._p.append(end)


def add_link(paragraph: Any, number: int) -> Any:
    """Make the content of a paragraph a link to a bookmark; return the run of its page."""
    link = OxmlElement("w:hyperlink")
    link.set(qn("w:anchor"), _mark_name(number))
    for child in list(paragraph._p):
        if child.tag in (qn("w:r"), f"{{{omml.MATH}}}oMath") and not len(
            child.findall(qn("w:fldChar")) + child.findall(qn("w:instrText"))
        ):
            link.append(child)
    paragraph._p.append(link)
    before = len(paragraph._p)
    paragraph.add_run("\t")
    shown = add_field(paragraph, f"PAGEREF {_mark_name(number)} \\h", "")
    for child in list(paragraph._p)[before:]:
        link.append(child)
    return shown


def _mark_name(number: int) -> str:
    return f"_Toc{number:06}"


def add_field(paragraph: Any, code: str, shown: str) -> Any:
    """Put a field at the end of a paragraph; return the run it shows until computed."""
    for kind in ("begin", code, "separate"):
        field_part(paragraph, kind)
    run = paragraph.add_run(shown)
    field_part(paragraph, "end")
    return run


def field_part(paragraph: Any, kind: str) -> None:
    """Put a part of a field: ``begin``, ``separate``, ``end``, or its code."""
    run = paragraph.add_run()._r
    if kind in ("begin", "separate", "end"):
        part = OxmlElement("w:fldChar")
        part.set(qn("w:fldCharType"), kind)
    else:
        part = OxmlElement("w:instrText")
        part.set(qn("xml:space"), "preserve")
        part.text = f" {kind} "
    run.append(part)


def small_paragraph(paragraph: Any, *, space: float = 0.0) -> None:
    """Make a paragraph that has to be there as low as can be; ``space``: points after it."""
    form = paragraph.paragraph_format
    form.line_spacing_rule, form.line_spacing = WD_LINE_SPACING.EXACTLY, Pt(1)
    form.first_line_indent, form.space_before, form.space_after = 0, Pt(0), Pt(space)


PAD = 4.0
"""White at the sides of a cell, mm."""

STRIP = 17.0
"""Height of the row that names the continued table, points."""

MAX_UNCUT_ROWS = 5
"""Rows, with the head, up to which a table is not cut between pages."""


def grid(file: Any, rows: int, widths: Sequence[float], style: Any = None) -> Any:
    """Return an empty table with columns of given widths, mm."""
    made = CT_Tbl.new_tbl(rows, len(widths), Mm(sum(widths)))
    _append_element(file, made)
    table = WordTable(made, file._body)
    if style is not None:
        table.style = style
    table.autofit = False
    table.alignment = WD_TABLE_ALIGNMENT.CENTER
    for column, width in zip(table._tbl.tblGrid.gridCol_lst, widths, strict=True):
        column.w = Mm(width)
    for row in table._tbl.tr_lst:
        for cell, width in zip(row.tc_lst, widths, strict=True):
            cell.width = Mm(width)
    return table


def rows_of(table: Any) -> list[list[Any]]:
    """Return the cells of a table, row by row, none of them merged."""
    return [[_Cell(cell, table) for cell in row.tc_lst] for row in table._tbl.tr_lst]


def head_repeats(table: Any) -> None:
    """Repeat the head of a table on each page, and forbid cutting a row."""
    for k, row in enumerate(table._tbl.tr_lst):
        properties = row.get_or_add_trPr()
        properties.append(OxmlElement("w:cantSplit"))
        if not k:
            properties.append(OxmlElement("w:tblHeader"))


def strip_above(table: Any) -> _Cell:
    """Put a low row without lines above the head of a table, which repeats as the head does.

    Its text appears at the top of each page of the table, wherever Word cuts it; return its cell.
    """
    columns = len(table._tbl.tblGrid.gridCol_lst)
    row = OxmlElement("w:tr")
    properties = row.get_or_add_trPr()
    properties.append(OxmlElement("w:cantSplit"))
    height = OxmlElement("w:trHeight")
    height.set(qn("w:val"), str(round(20 * STRIP)))
    height.set(qn("w:hRule"), "exact")
    properties.append(height)
    properties.append(OxmlElement("w:tblHeader"))
    cell = row.add_tc()
    cell.width = sum(column.w for column in table._tbl.tblGrid.gridCol_lst)
    cell.grid_span = columns
    borders = OxmlElement("w:tcBorders")
    for side in ("top", "left", "right"):
        line = OxmlElement(f"w:{side}")
        line.set(qn("w:val"), "nil")
        borders.append(line)
    cell.get_or_add_tcPr().append(borders)
    table._tbl.tr_lst[0].addprevious(row)
    return _Cell(cell, table)


# no messages: XML of Word
def cover(paragraph: Any, width: float) -> None:
    """Hide the strip below a paragraph of one point under a white area of a width in mm.

    The first page of the table has its name instead.
    """
    run = paragraph.add_run()._r
    run.append(
        parse_xml(
            f'<w:pict {nsdecls("w")} xmlns:v="urn:schemas-microsoft-com:vml">'
            '<v:rect style="position:absolute;margin-left:0;margin-top:0;'
            f"width:{width / MM_PER_POINT:.1f}pt;height:{STRIP:g}pt;z-index:1;"
            "mso-position-horizontal-relative:text;mso-position-vertical-relative:text"
            '" fillcolor="white" stroked="f"/></w:pict>'
        )
    )


def row_keeps_with_next(row: int, rows: int) -> bool:
    """Return whether a row stays with the next: no page has the head or a last row alone."""
    return row + 1 < rows and (rows <= MAX_UNCUT_ROWS or row < 2 or row == rows - 2)


# Widths of columns --------------------------------------------------------------------------------


def needed_widths(table: Table, size: float) -> list[float]:
    """Return the least widths of columns, mm: words are not cut."""
    em, columns = size * MM_PER_POINT, zip(table.head, *table.rows, strict=True)
    return [max(_widest(text, em) for text in column) + PAD for column in columns]


def _widest(rich: Rich, em: float) -> float:
    return max((0.58 * em * len(word) for word in clean_text(rich).split()), default=0.0)


def line_width(rich: Rich, em: float) -> float:
    """Return the approximate width of a text on one line, mm."""
    return 0.55 * em * len(clean_text(rich))


def fill_width(needed: Sequence[float], available: float) -> list[float]:
    """Return widths that fill the available width, in proportion to the needed ones."""
    total = sum(needed)
    return [width * available / total for width in needed]


def parts_of_width(table: Table, size: float, available: float) -> Iterator[Table]:
    """Yield a table cut between its columns, each part with the leading ones."""
    needed, lead = needed_widths(table, size), table.repeated
    start = lead
    while start < len(needed):
        end, width = start, sum(needed[:lead])
        while end < len(needed) and (end == start or width + needed[end] <= available):
            width += needed[end]
            end += 1
        rows = (row[:lead] + row[start:end] for row in (table.head, *table.rows))
        head, *others = rows
        yield Table(head, tuple(others), table.names, lead)
        start = end


DPI = 200
"""Dots to the inch: for programs that cannot show SVG; of lines more are not seen in print."""

_SVG = "http://schemas.microsoft.com/office/drawing/2016/SVG/main"
_SVG_EXTENSION = "{96DAC541-7B7A-43D3-8B79-37D633B846F1}"


def add_picture(
    run: Any, figure: lowering.NamedFigure, number: int, width: float, scale: float, part: Any
) -> None:
    """Put a figure into a run of text.

    Parameters
    ----------
    run : docx.text.run.Run
    figure : lowering.NamedFigure
    number : int
        Of the picture in the file, from 1 on.
    width : float, mm
        As it is shown.
    scale : float
        How many times larger it is shown than its view is.
    part : docx.parts.document.DocumentPart
        Of the file.
    """
    raster, image = part.get_or_add_image(BytesIO(figure.view.png(DPI * scale)))
    sides = image.scaled_dimensions(Mm(width), None)
    inline = CT_Inline.new_pic_inline(number, raster, image.filename, *sides)
    run._r.add_drawing(inline)
    inline.docPr.set("descr", clean_text(figure.caption))
    svg = figure.view.svg().encode()
    uri = PackURI(f"/word/media/vector{number}.svg")
    vector = Part(uri, "image/svg+xml", svg, part.package)
    name = part.relate_to(vector, RELATIONSHIP_TYPE.IMAGE)
    blip = inline.find(f".//{qn('a:blip')}")
    extensions = etree.SubElement(blip, qn("a:extLst"))
    extension = etree.SubElement(extensions, qn("a:ext"), uri=_SVG_EXTENSION)
    beside = etree.SubElement(extension, f"{{{_SVG}}}svgBlip", nsmap={"asvg": _SVG})
    beside.set(qn("r:embed"), name)
