"""Works as XLSX: the cells of every sheet; formulas are not computed (книга XLSX)."""

from __future__ import annotations

import datetime
import io
import re
import warnings
import zipfile
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import iterparse

from msgspec import Struct, field

from planmethod.check.model import Unread, Work
from planmethod.check.works.cells import Cell, cut
from planmethod.check.works.faults import WorksError
from planmethod.check.works.gather import Gathering
from planmethod.check.works.table import HEAD_ROWS, Row, read_table

ROW_LIMIT = 20_000
COLUMN_LIMIT = 400
SHEET_LIMIT = 400
UNPACKED_LIMIT = 16 * 1024 * 1024
"""Bytes of XML in a workbook; a group's answers are a hundredth of it."""
MEMBER_LIMIT = 2000
MERGED_LIMIT = 20_000

META = "_meta"
"""Hidden sheet of the form."""

_DECIMALS = r"0\.(0+)"
_PLACE = r"([A-Z]{1,3})([0-9]{1,7})\Z"
_SPAN = r"([A-Z]{1,3})([0-9]{1,7}):([A-Z]{1,3})([0-9]{1,7})\Z"
_MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"


def read_xlsx(data: bytes, path: Path) -> list[Work]:
    """Return the works of a workbook: of a group, or of a form of `planmethod.check.form`.

    Raises
    ------
    WorksError
        It is no workbook, none of its sheets has a head, or it is too large.
    """
    _check_size(data, path)
    gathering = Gathering(str(path))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what openpyxl leaves out
        try:
            sheets, meta = _sheets(data, path)
        except WorksError:
            raise
        except Exception as error:  # whatever a broken workbook makes of its reader
            raise WorksError(
                "{}: this workbook cannot be opened ({}). Save it anew as XLSX in the "
                "spreadsheet program.",
                path,
                type(error).__name__,
            ) from None
    known = [
        read_table(rows, gathering, title if len(sheets) > 1 else path.stem, closed=False)
        for title, rows in sheets.items()
    ]
    if not any(known):
        raise WorksError(
            "{}: no sheet has a head among its first {} rows. Name the columns: student, "
            "what, value, unit, mm, sense; or student and the quantities.",
            path,
            HEAD_ROWS,
        )
    if meta:
        _compare(gathering, meta)
    return gathering.works()


def _check_size(data: bytes, path: Path) -> None:
    """Refuse what would unpack to more than a workbook of answers has."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            members = archive.infolist()
    except (zipfile.BadZipFile, ValueError, NotImplementedError, EOFError, OSError):
        raise WorksError(
            "{}: this is not an XLSX workbook. Save it as XLSX in the spreadsheet program.", path
        ) from None
    unpacked = sum(m.file_size for m in members if m.filename.endswith((".xml", ".rels")))
    if len(members) > MEMBER_LIMIT or unpacked > UNPACKED_LIMIT:
        raise WorksError(
            "{}: {} parts with {} MiB of tables; the limits are {} and {} MiB. Save the "
            "answers alone.",
            path,
            len(members),
            unpacked // 2**20,
            MEMBER_LIMIT,
            UNPACKED_LIMIT // 2**20,
        )


def _sheets(data: bytes, path: Path) -> tuple[dict[str, list[Row]], dict[str, list[str]]]:
    """Return the rows of the sheets that are shown, and what the form says of itself."""
    import openpyxl

    book = openpyxl.load_workbook(
        io.BytesIO(data), read_only=True, data_only=True, keep_links=False, keep_vba=False
    )
    sheets: dict[str, list[Row]] = {}
    meta: dict[str, list[str]] = {}
    try:
        if len(book.worksheets) > SHEET_LIMIT:
            raise WorksError("{}: over {} sheets. Part the file.", path, SHEET_LIMIT)
        for sheet in book.worksheets:
            if sheet.title == META:
                for name, value in sheet.iter_rows(max_row=5000, max_col=2, values_only=True):
                    if value is not None:
                        meta.setdefault(str(name), []).append(cut(str(value)))
            elif sheet.sheet_state == "visible":
                sheets[cut(sheet.title)] = list(_rows(book, sheet, path))
    finally:
        book.close()
    return sheets, meta


def _rows(book: Any, sheet: Any, path: Path) -> Iterator[Row]:
    """Yield the rows of a sheet down to the last that says something."""
    from openpyxl.utils import get_column_letter

    # A reader of single rows knows neither merged cells nor which of them are formulas.
    with book._archive.open(sheet._worksheet_path) as stream:
        there = _structure(stream)
    title = cut(sheet.title)
    if there.rows > ROW_LIMIT or there.columns > COLUMN_LIMIT:
        raise WorksError(
            "{}: sheet {!r} has {} rows and {} columns; the limits are {} and {}. Save "
            "the answers alone.",
            path,
            title,
            there.rows,
            there.columns,
            ROW_LIMIT,
            COLUMN_LIMIT,
        )
    texts: dict[tuple[int, int], str] = {}
    rows = sheet.iter_rows(max_row=max(there.rows, 1), max_col=max(there.columns, 1))
    for number, row in enumerate(rows, 1):
        cells = []
        for column, found in enumerate(row, 1):
            place = f"{get_column_letter(column)}{number}"
            text, why = _text(found)
            if not text and place in there.formulas:
                why = Unread.FORMULA
            corner = there.merged.get((number, column))
            if corner == (number, column):
                texts[corner] = text
            shared = "" if text or corner is None else texts.get(corner, "")
            cells.append(Cell(text, f"{title}!{place}", shared, why))
        yield cells


class _Structure(Struct):
    """What a sheet has beside the values of its cells (строение листа).

    Attributes
    ----------
    merged : dict
        The upper left cell of every merged one, by row and column.
    formulas : set of str
        Cells whose formula has no value.
    rows, columns : int
        How far there are values.
    """

    merged: dict[tuple[int, int], tuple[int, int]] = field(default_factory=dict)
    formulas: set[str] = field(default_factory=set)
    rows: int = 0
    columns: int = 0


def _structure(stream: Any) -> _Structure:
    from openpyxl.utils import column_index_from_string

    there = _Structure()
    for _, element in iterparse(stream):
        if element.tag == f"{_MAIN}row":
            element.clear()
        elif element.tag == f"{_MAIN}c":
            name = element.get("r", "")
            if element.find(f"{_MAIN}f") is not None and not element.findtext(f"{_MAIN}v"):
                there.formulas.add(name)
            if len(element) and (place := re.match(_PLACE, name)):
                there.rows = max(there.rows, int(place[2]))
                there.columns = max(there.columns, column_index_from_string(place[1]))
        elif element.tag == f"{_MAIN}mergeCell" and (
            span := re.match(_SPAN, element.get("ref", ""))
        ):
            top, bottom = int(span[2]), min(int(span[4]), ROW_LIMIT)
            left, right = map(column_index_from_string, (span[1], span[3]))
            columns = range(left, min(right, COLUMN_LIMIT) + 1)
            for row, column in product(range(top, bottom + 1), columns):
                if len(there.merged) >= MERGED_LIMIT:
                    break
                there.merged[row, column] = (top, left)
    return there


def _text(cell: Any) -> tuple[str, Unread | None]:
    """Return what a cell shows; a number in full digits, with the noughts that its format shows."""
    value = cell.value
    if value is None:
        return "", None
    if isinstance(value, bool):
        return str(value), Unread.NUMBER
    if isinstance(value, datetime.date | datetime.time | datetime.timedelta):
        return str(value), Unread.DATE
    if isinstance(value, int | float):
        text = f"{value:.15g}"
        shown = re.search(_DECIMALS, str(cell.number_format)[:40])
        decimals = len(shown[1]) if shown else 0
        if "e" in text or "n" in text or decimals <= len(text.partition(".")[2]):
            return text, None
        return f"{value:.{decimals}f}", None
    return cut(str(value)), None


def _compare(gathering: Gathering, meta: dict[str, list[str]]) -> None:
    """Take what a form says of itself; a row of it that is gone is told."""
    for draft in gathering.drafts.values():
        draft.problem = "".join(meta.get("problem", ()))
        draft.variant = "".join(meta.get("variant", ())) or draft.variant
        draft.fingerprint = "".join(meta.get("fingerprint", ()))
        there = {answer.id for answer in draft.answers.values()}
        for name in meta.get("id", ()):
            if name not in there:
                draft.remark(Unread.ROW, name, META)
