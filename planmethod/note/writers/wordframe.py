"""The file of a document of Word, and the frames on its pages (ГОСТ 2.104)."""

from __future__ import annotations

import contextlib
import zlib
from collections.abc import Mapping
from datetime import datetime
from io import BytesIO
from pathlib import Path
from typing import Any
from xml.parsers.expat import ExpatError, ParserCreate
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

import docx
from docx.enum.table import WD_CELL_VERTICAL_ALIGNMENT, WD_ROW_HEIGHT_RULE
from docx.enum.text import WD_ALIGN_PARAGRAPH, WD_LINE_SPACING
from docx.oxml import OxmlElement, parse_xml
from docx.oxml.ns import qn
from docx.shared import Mm, Pt

from planmethod.errors import OutputError
from planmethod.note.wording import MessageTable
from planmethod.note.writers.lowering import Cover, LoweredDocument
from planmethod.note.writers.word_parts import add_field, clean_text, rows_of, small_paragraph

_WHEN = datetime(2000, 1, 1)
PART_LIMIT = 1000
UNPACKED_LIMIT = 32 * 1024 * 1024
"""Bytes of all parts of a template: pictures of a form, at most."""
XML_LIMIT = 200_000
"""Elements and attributes of all parts; the styles that Word makes are five thousand."""
DEPTH_LIMIT = 200
UNKNOWN = (18, 19)
"""Codes of expat for encodings that it does not know, and another parser may."""
MIN_TEXT_AREA = 40.0
"""Least width and height of the text on a page, mm."""
LARGEST_PAGE = 2000.0
"""Longest side of a page, mm."""

_AFTER_FIELDS = ("w:hdrShapeDefaults", "w:footnotePr", "w:endnotePr", "w:compat", "w:docVars",
                 "w:rsids", "m:mathPr", "w:themeFontLang", "w:clrSchemeMapping", "w:shapeDefaults",
                 "w:decimalSymbol", "w:listSeparator")  # fmt: skip
"""Settings that must follow ``w:updateFields``: Word requires the order."""


def opened(template: Path | None) -> Any:
    """Return a new file, or the template without its content.

    Raises
    ------
    OutputError
        The template is missing, is not a file of Word, or is too large.
    """
    if template is None:
        return docx.Document()
    if not template.is_file():
        raise OutputError(
            "The template {} does not exist. Give the path of a .docx file.", template
        )
    try:
        with template.open("rb") as stream:
            data = stream.read(UNPACKED_LIMIT + 1)
    except OSError as fault:
        raise OutputError("{} cannot be read: {}", template, fault.strerror or fault) from fault
    try:
        _check_archive(data, template)
        file = docx.Document(BytesIO(data))
        body = file.element.body
        for child in list(body):
            if child.tag != qn("w:sectPr"):
                body.remove(child)
        if not _fits_text(file.sections[0]):
            raise ValueError(file.sections[0])
    except (OutputError, MemoryError):
        raise
    except Exception as fault:  # whatever a broken template makes of its reader
        raise damaged(template) from fault
    return file


def damaged(template: Path) -> OutputError:
    """Return the error for a template that cannot be used."""
    return OutputError(
        "The template {} is not a Word file, or is damaged. Open it in Word and save it "
        "again as .docx.",
        template,
    )


def _check_archive(data: bytes, template: Path) -> None:
    """Reject an archive that would unpack to more than a template needs, before it is used.

    Raises
    ------
    OutputError
    """
    with ZipFile(BytesIO(data)) as archive:
        parts = archive.infolist()
        unpacked = max(sum(part.file_size for part in parts), len(data))
        if len(parts) > PART_LIMIT or unpacked > UNPACKED_LIMIT:
            raise OutputError(
                "The template {} has {} parts with {} MiB; the limits are {} and {} MiB. Leave "
                "only its page and its styles.",
                template,
                len(parts),
                unpacked // 2**20,
                PART_LIMIT,
                UNPACKED_LIMIT // 2**20,
            )
        count = depth = 0

        def start(_tag: str, attributes: dict[str, str]) -> None:
            nonlocal count, depth
            count, depth = count + 1 + len(attributes), depth + 1
            if count > XML_LIMIT or depth > DEPTH_LIMIT:
                reject()

        def end(_tag: str) -> None:
            nonlocal depth
            depth -= 1

        def reject(*_: object) -> None:
            raise OutputError(
                "The template {} is too large: over {} elements, or some nested over {} "
                "deep. Leave only its page and its styles.",
                template,
                XML_LIMIT,
                DEPTH_LIMIT,
            )

        for part in parts:
            parser, depth = ParserCreate(), 0
            parser.StartElementHandler, parser.EndElementHandler = start, end
            parser.EntityDeclHandler = reject
            try:
                with contextlib.suppress(zlib.error):
                    parser.Parse(archive.read(part), True)  # in pieces, a long tag is read again
            except ExpatError as error:  # other parsers reject non-XML too
                if error.code in UNKNOWN:
                    raise damaged(template) from error


def _fits_text(section: Any) -> bool:
    """Return whether a page has enough space for the text."""
    across = section.page_width, section.left_margin, section.right_margin
    along = section.page_height, section.top_margin, section.bottom_margin
    sides = [[float(one) / Mm(1) for one in side] for side in (across, along)]
    return all(
        page <= LARGEST_PAGE and page - one - two >= MIN_TEXT_AREA for page, one, two in sides
    )


def update_fields_on_open(file: Any) -> None:
    """Let Word compute the fields when the file is opened."""
    settings = file.settings.element
    if settings.find(qn("w:updateFields")) is not None:
        return
    update = OxmlElement("w:updateFields")
    update.set(qn("w:val"), "true")
    after = (child for child in settings if child.tag in map(qn, _AFTER_FIELDS))
    place = next(after, None)
    if place is None:
        settings.append(update)
    else:
        place.addprevious(update)


def strip_timestamps(file: Any, *, title: str, author: str) -> bytes:
    """Return the file, without a trace of when it was made."""
    properties = file.core_properties
    properties.author = properties.last_modified_by = author
    properties.title, properties.comments = title, ""
    properties.created = properties.modified = _WHEN
    properties.revision = 1
    made, found = BytesIO(), BytesIO()
    file.save(made)
    with ZipFile(made) as parts, ZipFile(found, "w", ZIP_DEFLATED) as written:
        for name in parts.namelist():
            entry = ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = ZIP_DEFLATED
            written.writestr(entry, parts.read(name))
    return found.getvalue()


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


def fields_of_note(fields: Mapping[str, str], written: LoweredDocument) -> dict[str, str]:
    """Return the fields of the title block of a note: its designation, its name below."""
    page = next((n for n in written.nodes if isinstance(n, Cover)), None)
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
            _write(table.cell(row, 0), name, 8.0, left=True)
            _write(table.cell(row, 2), self._fields.get(role, ""), 8.0, left=True)
            _write(table.cell(row, 4), self._fields.get(f"{role}_date", ""), 7.0)
        _write(table.cell(0, 5), self._fields.get("designation", ""), 16.0)
        _write(table.cell(3, 5), self._fields.get("title", ""), 12.0)
        for column, key in ((6, "letter"), (9, "sheet"), (10, "sheets")):
            _write(table.cell(3, column), texts[key], 8.0)
        letters = self._fields.get("letter", "")[:3]
        for column, letter in enumerate(letters, 6):
            _write(table.cell(4, column), letter, 8.0)
        _write(table.cell(4, 9), "", 8.0, field="PAGE")
        _write(table.cell(4, 10), "", 8.0, field="NUMPAGES")
        whose = (self._fields.get(key, "") for key in ("organisation", "department", "group"))
        _write(table.cell(5, 6), ", ".join(filter(None, whose)), 9.0)

    def _form_2a(self, footer: Any, width: float = 185.0) -> None:
        widths = (*_SIGNATURE_COLUMNS, width - 75.0, 10.0)
        table = _table(footer, widths, (5.0, 2.0, 3.0, 5.0))
        for column in range(5):
            _merged(table, 1, column, 2, column)
        _merged(table, 0, 5, 3, 5)
        _merged(table, 0, 6, 1, 6)
        _merged(table, 2, 6, 3, 6)
        self._header(table, 3)
        _write(table.cell(0, 5), self._fields.get("designation", ""), 16.0)
        _write(table.cell(0, 6), self._captions["sheet"], 8.0)
        _write(table.cell(2, 6), "", 10.0, field="PAGE")

    def _header(self, table: Any, row: int) -> None:
        for column, key in enumerate(("change", "sheet", "document", "signature", "date")):
            _write(table.cell(row, column), self._captions[key], 7.0)


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


def _write(cell: Any, text: str, size: float, *, left: bool = False, field: str = "") -> None:
    """Write into a cell, in the middle or at its left side."""
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
