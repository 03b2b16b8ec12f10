"""Frames and title blocks of text documents on the pages of Word, GOST 2.104 (рамка листа).

The frame is a shape of the header, the title block a table of the footer, so that its page numbers
are fields.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from docx.enum.table import WD_CELL_VERTICAL_ALIGNMENT, WD_ROW_HEIGHT_RULE
from docx.enum.text import WD_ALIGN_PARAGRAPH, WD_LINE_SPACING
from docx.oxml import OxmlElement, parse_xml
from docx.oxml.ns import qn
from docx.shared import Mm, Pt

from planmethod.note import document
from planmethod.note.document import Document
from planmethod.note.wording import MessageTable
from planmethod.note.writers.wordpages import clean_text
from planmethod.note.writers.wordtable import rows_of
from planmethod.note.writers.wordtext import add_field, small_paragraph

EDGE, BINDING = 5.0, 20.0
"""From the edge of the paper to the frame, mm; on the left with space for the binding."""

ABOVE = 10.0
"""White between the text and a title block, mm."""

_SIGNATURE_COLUMNS = (7.0, 10.0, 23.0, 15.0, 10.0)
_FORM_2 = (*_SIGNATURE_COLUMNS, 70.0, 5.0, 5.0, 5.0, 15.0, 20.0)
_FORM_2A = (*_SIGNATURE_COLUMNS, 110.0, 10.0)
_ROLES = ("author", "checker", "extra", "norm_control", "approver")
_THICK, _THIN = 12, 4  # eighths of a point

_SHAPE = """<w:r xmlns:w="http://schemas.openxmlformats.org/wordprocessingml/2006/main"
 xmlns:mc="http://schemas.openxmlformats.org/markup-compatibility/2006"
 xmlns:wp="http://schemas.openxmlformats.org/drawingml/2006/wordprocessingDrawing"
 xmlns:a="http://schemas.openxmlformats.org/drawingml/2006/main"
 xmlns:wps="http://schemas.microsoft.com/office/word/2010/wordprocessingShape">
<mc:AlternateContent><mc:Choice Requires="wps"><w:drawing>
<wp:anchor distT="0" distB="0" distL="0" distR="0" simplePos="0" relativeHeight="1" behindDoc="1"
 locked="0" layoutInCell="1" allowOverlap="1"><wp:simplePos x="0" y="0"/>
<wp:positionH relativeFrom="page"><wp:posOffset>{x}</wp:posOffset></wp:positionH>
<wp:positionV relativeFrom="page"><wp:posOffset>{y}</wp:posOffset></wp:positionV>
<wp:extent cx="{width}" cy="{height}"/><wp:effectExtent l="0" t="0" r="0" b="0"/><wp:wrapNone/>
<wp:docPr id="{id}" name="Frame {id}"/><wp:cNvGraphicFramePr/>
<a:graphic><a:graphicData uri="http://schemas.microsoft.com/office/word/2010/wordprocessingShape">
<wps:wsp><wps:cNvSpPr/><wps:spPr><a:xfrm><a:off x="0" y="0"/><a:ext cx="{width}" cy="{height}"/>
</a:xfrm><a:prstGeom prst="rect"><a:avLst/></a:prstGeom><a:noFill/>
<a:ln w="19050"><a:solidFill><a:srgbClr val="000000"/></a:solidFill></a:ln></wps:spPr>
<wps:bodyPr/></wps:wsp></a:graphicData></a:graphic></wp:anchor></w:drawing></mc:Choice>
</mc:AlternateContent></w:r>"""


def fields_of_note(fields: Mapping[str, str], written: Document) -> dict[str, str]:
    """Return the fields of the title block of a note: its designation, its name below."""
    page = next((n for n in written.nodes if isinstance(n, document.TitlePage)), None)
    if page is None:
        return dict(fields)
    title = fields.get("title", "") or clean_text(page.title)
    name = "\n".join(filter(None, (title, clean_text(page.work))))
    designation = clean_text(page.designation) or fields.get("designation", "")
    return {**fields, "title": name, "designation": designation}


class PageFrame:
    """Puts frames and title blocks on the pages of sections."""

    def __init__(self, fields: Mapping[str, str], texts: MessageTable) -> None:
        self._fields, self._captions = fields, texts["captions"]
        self._count = 0

    def add_first_form(self, section: Any) -> None:
        """Put form 2 on the first page of a section and form 2a on the others."""
        section.different_first_page_header_footer = True
        self._set_margins(section)
        for header, footer, fill in (
            (section.first_page_header, section.first_page_footer, self._form_2),
            (section.header, section.footer, self._form_2a),
        ):
            header.is_linked_to_previous = footer.is_linked_to_previous = False
            self._draw(section, header.paragraphs[0])
            fill(footer)

    def add_later_form(self, section: Any) -> None:
        """Put form 2a on the pages of a continued section."""
        section.different_first_page_header_footer = False
        self._set_margins(section)
        section.header.is_linked_to_previous = section.footer.is_linked_to_previous = False
        self._draw(section, section.header.paragraphs[0])
        wide = section.page_width > section.page_height
        self._form_2a(
            section.footer, section.page_width / Mm(1) - EDGE - BINDING if wide else 185.0
        )

    def _set_margins(self, section: Any) -> None:
        section.bottom_margin = Mm(EDGE + 15.0 + ABOVE)
        section.footer_distance = Mm(EDGE)
        section.header_distance = Mm(EDGE)

    def _draw(self, section: Any, place: Any) -> None:
        """Put the frame into a paragraph of the header."""
        self._count += 1
        small_paragraph(place)
        width = section.page_width - Mm(BINDING + EDGE)
        height = section.page_height - Mm(2 * EDGE)
        box = {"x": Mm(BINDING), "y": Mm(EDGE), "width": width, "height": height}
        place._p.append(parse_xml(_SHAPE.format(id=1000 + self._count, **box)))

    def _form_2(self, footer: Any) -> None:
        table = _table(footer, _FORM_2, (5.0,) * 8)
        texts = self._captions
        for row in range(3, 8):
            _merged(table, row, 0, row, 1)
        _merged(table, 0, 5, 2, 10)
        _merged(table, 3, 5, 7, 5)
        _merged(table, 3, 6, 3, 8)
        _merged(table, 5, 6, 7, 10)
        self._header(table, 2)
        for row, role in enumerate(_ROLES, 3):
            name = self._fields.get("extra_role", "") if role == "extra" else texts[role]
            _write(table, row, 0, name, 8.0, left=True)
            _write(table, row, 2, self._fields.get(role, ""), 8.0, left=True)
            _write(table, row, 4, self._fields.get(f"{role}_date", ""), 7.0)
        _write(table, 0, 5, self._fields.get("designation", ""), 16.0)
        _write(table, 3, 5, self._fields.get("title", ""), 12.0)
        for column, key in ((6, "letter"), (9, "sheet"), (10, "sheets")):
            _write(table, 3, column, texts[key], 8.0)
        letters = self._fields.get("letter", "")[:3]
        for column, letter in enumerate(letters, 6):
            _write(table, 4, column, letter, 8.0)
        _write(table, 4, 9, "", 8.0, field="PAGE")
        _write(table, 4, 10, "", 8.0, field="NUMPAGES")
        whose = (self._fields.get(key, "") for key in ("organisation", "department", "group"))
        _write(table, 5, 6, ", ".join(filter(None, whose)), 9.0)

    def _form_2a(self, footer: Any, width: float = 185.0) -> None:
        widths = (*_SIGNATURE_COLUMNS, width - 75.0, 10.0)
        table = _table(footer, widths, (5.0, 2.0, 3.0, 5.0))
        for column in range(5):
            _merged(table, 1, column, 2, column)
        _merged(table, 0, 5, 3, 5)
        _merged(table, 0, 6, 1, 6)
        _merged(table, 2, 6, 3, 6)
        self._header(table, 3)
        _write(table, 0, 5, self._fields.get("designation", ""), 16.0)
        _write(table, 0, 6, self._captions["sheet"], 8.0)
        _write(table, 2, 6, "", 10.0, field="PAGE")

    def _header(self, table: Any, row: int) -> None:
        for column, key in enumerate(("change", "sheet", "document", "signature", "date")):
            _write(table, row, column, self._captions[key], 7.0)


def _table(footer: Any, widths: tuple[float, ...], heights: tuple[float, ...]) -> Any:
    """Return an empty table at the foot of a page, from the left side of the frame on."""
    gap = footer.paragraphs[0]
    small_paragraph(gap)
    gap.paragraph_format.space_after = Mm(ABOVE)
    table = footer.add_table(len(heights), len(widths), Mm(sum(widths)))
    table.autofit = False
    properties = table._tbl.tblPr
    indent = OxmlElement("w:tblInd")
    indent.set(qn("w:w"), str(int(Mm(BINDING - 30.0).twips)))
    indent.set(qn("w:type"), "dxa")
    margins = OxmlElement("w:tblCellMar")
    for side in ("left", "right"):
        margin = OxmlElement(f"w:{side}")
        margin.set(qn("w:w"), "0")
        margin.set(qn("w:type"), "dxa")
        margins.append(margin)
    layout = properties.find(qn("w:tblLayout"))  # Word minds the order
    layout.addprevious(indent)
    layout.addprevious(_borders())
    layout.addnext(margins)
    for column, width in zip(table.columns, widths, strict=True):
        column.width = Mm(width)
    first = footer.tables[0].cell(0, 0).paragraphs[0]
    first.style = "Title Block"
    style = first._p.style
    for row, height in zip(table.rows, heights, strict=True):
        row.height, row.height_rule = Mm(height), WD_ROW_HEIGHT_RULE.EXACTLY
    for cells in rows_of(table):
        for cell, width in zip(cells, widths, strict=True):
            cell.width = Mm(width)
            cell.paragraphs[0]._p.style = style
            small_paragraph(cell.paragraphs[0])
    small_paragraph(footer.add_paragraph())
    return table


def _borders() -> Any:
    """Return the lines of a title block: thin between its rows, thick elsewhere."""
    borders = OxmlElement("w:tblBorders")
    for side in ("top", "left", "bottom", "right", "insideH", "insideV"):
        line = OxmlElement(f"w:{side}")
        size = _THIN if side == "insideH" else _THICK
        for key, value in (("val", "single"), ("sz", str(size)), ("color", "000000")):
            line.set(qn(f"w:{key}"), value)
        borders.append(line)
    return borders


def _merged(table: Any, top: int, left: int, bottom: int, right: int) -> None:
    table.cell(top, left).merge(table.cell(bottom, right))


def _write(
    table: Any,
    row: int,
    column: int,
    text: str,
    size: float,
    *,
    left: bool = False,
    field: str = "",
) -> None:
    """Write into a cell, in the middle or at its left side."""
    cell = table.cell(row, column)
    cell.vertical_alignment = WD_CELL_VERTICAL_ALIGNMENT.CENTER
    for extra in cell.paragraphs[1:]:
        extra._p.getparent().remove(extra._p)
    place = cell.paragraphs[0]
    form = place.paragraph_format
    form.line_spacing_rule, form.line_spacing = WD_LINE_SPACING.SINGLE, 1.0
    form.first_line_indent = Mm(0.7) if left else 0
    place.alignment = WD_ALIGN_PARAGRAPH.LEFT if left else WD_ALIGN_PARAGRAPH.CENTER
    if field:
        add_field(place, field, "1")
    else:
        place.add_run(text)
    for run in place.runs:
        run.font.size = Pt(size)
