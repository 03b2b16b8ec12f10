"""The file of a document of Word: opened, and written without a trace of the clock (файл Word)."""

from __future__ import annotations

from datetime import datetime
from io import BytesIO
from pathlib import Path
from typing import Any
from zipfile import ZIP_DEFLATED, BadZipFile, ZipFile, ZipInfo

import docx
from docx.opc.exceptions import PackageNotFoundError
from docx.oxml import OxmlElement
from docx.oxml.ns import qn

from planmethod.errors import OutputError

_WHEN = datetime(2000, 1, 1)
_AFTER_FIELDS = ("w:hdrShapeDefaults", "w:footnotePr", "w:endnotePr", "w:compat", "w:docVars",
                 "w:rsids", "m:mathPr", "w:themeFontLang", "w:clrSchemeMapping", "w:shapeDefaults",
                 "w:decimalSymbol", "w:listSeparator")  # fmt: skip
"""What of the settings stands after the wish that fields be computed: Word minds the order."""


def opened(template: Path | None) -> Any:
    """Return a new file, or the template without what it holds.

    Raises
    ------
    OutputError
        The template is not there, or is no file of Word.
    """
    if template is None:
        return docx.Document()
    if not template.is_file():
        raise OutputError("There is no template {}. Give the path of a .docx file.", template)
    try:
        file = docx.Document(str(template))
    except OSError as fault:
        raise OutputError("{} cannot be read: {}", template, fault.strerror or fault) from fault
    except (PackageNotFoundError, BadZipFile, KeyError, ValueError, SyntaxError) as fault:
        raise OutputError(
            "The template {} is no file of Word, or is damaged. Open it in Word and save it anew "
            "as .docx.",
            template,
        ) from fault
    body = file.element.body
    for child in list(body):
        if child.tag != qn("w:sectPr"):
            body.remove(child)
    return file


def wish_for_fields(file: Any) -> None:
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


def timeless(file: Any, *, title: str, author: str) -> bytes:
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
