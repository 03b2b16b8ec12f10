"""The file of a document of Word: opened, and written without a trace of the clock (файл Word)."""

from __future__ import annotations

import contextlib
import zlib
from datetime import datetime
from io import BytesIO
from pathlib import Path
from typing import Any
from xml.parsers.expat import ExpatError, ParserCreate
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

import docx
from docx.oxml import OxmlElement
from docx.oxml.ns import qn
from docx.shared import Mm

from planmethod.errors import OutputError

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
