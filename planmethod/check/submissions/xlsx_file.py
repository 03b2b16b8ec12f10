"""Works as XLSX: the cells of every sheet; formulas are not computed (книга XLSX)."""

from __future__ import annotations

import contextlib
import datetime
import io
import re
import warnings
import zipfile
import zlib
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import IO, Any
from xml.parsers.expat import ExpatError, ParserCreate

from msgspec import Struct, field

from planmethod.check.model import Submission, Unread
from planmethod.check.submissions.cells import Cell, SubmissionError, cut
from planmethod.check.submissions.gather import Gathering
from planmethod.check.submissions.table import (
    CELL_LIMIT,
    COLUMN_LIMIT,
    HEAD_ROWS,
    ROW_LIMIT,
    Row,
    read_table,
)

SHEET_LIMIT = 400
UNPACKED_LIMIT = 16 * 1024 * 1024
"""Bytes of all parts of a workbook; a group's answers are a hundredth of it."""
MEMBER_LIMIT = 2000
MERGED_LIMIT = 20_000
SPAN_LIMIT = 2000
DEPTH_LIMIT = 64
OTHER_ELEMENTS_LIMIT = 60_000
"""Elements of XML that are not of cells: styles, notes, rules."""
TAG_LIMIT = 64 * 1024
"""Maximum length of a tag or comment; a parser fed by pieces reads a long one again with each."""
UNKNOWN = (18, 19)
"""Error codes of expat for an unknown encoding, which another parser may know."""

META = "_meta"
"""Hidden sheet of the form."""

_OF_CELLS = frozenset(("row", "c", "v", "f", "si", "t"))
_DECIMALS = r"0\.(0+)"
_PLACE = r"([A-Z]{1,3})([0-9]{1,7})\Z"
_SPAN = r"([A-Z]{1,3})([0-9]{1,7}):([A-Z]{1,3})([0-9]{1,7})\Z"


def read_xlsx(data: bytes, path: Path) -> list[Submission]:
    """Return the submissions of a workbook: of a group, or of a form of `planmethod.check.form`.

    Raises
    ------
    WorksError
        It is not a workbook, none of its sheets has a head, or it is too large.
    """
    _check_size(data, path)
    gathering = Gathering(str(path))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what openpyxl leaves out
        try:
            sheets, meta = _sheets(data, path)
        except SubmissionError:
            raise
        except Exception as error:  # whatever a broken workbook makes of its reader
            raise SubmissionError(
                "{}: this workbook cannot be opened ({}). Save it again as XLSX in the "
                "spreadsheet program.",
                path,
                type(error).__name__,
            ) from None
    known = [
        read_table(rows, gathering, title if len(sheets) > 1 else path.stem, closed=False)
        for title, rows in sheets.items()
    ]
    if not any(known):
        raise SubmissionError(
            "{}: no sheet has a header among its first {} rows. Name the columns: student, "
            "what, value, unit, mm, sense; or student and the quantities.",
            path,
            HEAD_ROWS,
        )
    if meta:
        _compare(gathering, meta)
    return gathering.submissions()


def _check_size(data: bytes, path: Path) -> None:
    """Reject a workbook that would unpack to too much, or has too much besides answers.

    Raises
    ------
    WorksError
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            members = archive.infolist()
            unpacked = sum(m.file_size for m in members)  # whatever they are called
            if len(members) > MEMBER_LIMIT or unpacked > UNPACKED_LIMIT:
                raise SubmissionError(
                    "{}: {} parts with {} MiB; the limits are {} and {} MiB. Save only the "
                    "answers.",
                    path,
                    len(members),
                    unpacked // 2**20,
                    MEMBER_LIMIT,
                    UNPACKED_LIMIT // 2**20,
                )
            counts = _Counts(path)
            for member in members:
                with archive.open(member) as part:
                    counts.count(part)
    except (zipfile.BadZipFile, ValueError, NotImplementedError, EOFError, OSError, RuntimeError):
        raise SubmissionError(
            "{}: this is not an XLSX workbook. Save it as XLSX in the spreadsheet program.", path
        ) from None


class _Counts:
    """Count the elements of all parts before they are parsed further."""

    def __init__(self, path: Path) -> None:
        self.path, self.depth, self.cells, self.other_elements = path, 0, 0, 0

    def count(self, part: IO[bytes]) -> None:
        """Count a part; parts that are not XML are not read."""
        parser, self.depth = ParserCreate(), 0
        parser.StartElementHandler, parser.EndElementHandler = self._start, self._end
        parser.EntityDeclHandler = self._reject
        parser.CommentHandler = self._weigh
        parser.ProcessingInstructionHandler = self._weigh
        try:
            with contextlib.suppress(zlib.error):
                parser.Parse(part.read(), True)  # by pieces a long tag is read again
        except ExpatError as error:
            if error.code in UNKNOWN:
                self._reject()

    def _weigh(self, *texts: str) -> None:
        if sum(map(len, texts)) > TAG_LIMIT:
            self._reject()

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        self._weigh(tag, *attributes, *attributes.values())
        self.depth += 1
        if tag.rpartition(":")[2] in _OF_CELLS:
            self.cells += 1
        else:
            self.other_elements += 1
        if (
            self.depth > DEPTH_LIMIT
            or self.cells > 3 * CELL_LIMIT
            or self.other_elements > OTHER_ELEMENTS_LIMIT
        ):
            self._reject()

    def _end(self, _tag: str) -> None:
        self.depth -= 1

    def _reject(self, *_: object) -> None:
        raise SubmissionError(
            "{}: this workbook has too much content besides cells. Copy the answers into a "
            "new one, and save that as XLSX.",
            self.path,
        )


def _sheets(data: bytes, path: Path) -> tuple[dict[str, list[Row]], dict[str, list[str]]]:
    """Return the rows of the sheets that are shown, and what the form says of itself."""
    book = _opened(data, path)
    sheets: dict[str, list[Row]] = {}
    meta: dict[str, list[str]] = {}
    whole = _WorkbookTotals()
    try:
        for sheet in book.worksheets:
            if sheet.title == META:
                with book._archive.open(sheet._worksheet_path) as stream:
                    _Reader(path, META, whole).read(stream)
                for name, value in sheet.iter_rows(max_row=5000, max_col=2, values_only=True):
                    if value is not None:
                        meta.setdefault(str(name), []).append(cut(str(value)))
            elif sheet.sheet_state == "visible":
                sheets[cut(sheet.title)] = list(_rows(book, sheet, path, whole))
    finally:
        book.close()
    return sheets, meta


def _opened(data: bytes, path: Path) -> Any:
    """Return the workbook, its sheets not yet read; a part that many sheets name is refused."""
    from openpyxl.reader.excel import ExcelReader

    class Reader(ExcelReader):  # type: ignore[misc]
        def read_worksheets(self) -> None:
            # Before: where a sheet does not say how large it is, all of it is looked at here.
            named: dict[str, str] = {}
            for number, (sheet, part) in enumerate(self.parser.find_sheets(), 1):
                if number > SHEET_LIMIT:
                    raise SubmissionError("{}: over {} sheets. Split the file.", path, SHEET_LIMIT)
                if part.target in named:
                    raise SubmissionError(
                        "{}: sheets {!r} and {!r} are the same part of the file. Save it "
                        "again as XLSX in the spreadsheet program.",
                        path,
                        cut(named[part.target]),
                        cut(sheet.name),
                    )
                named[part.target] = sheet.name
            super().read_worksheets()

    stream = io.BytesIO(data)
    reader = Reader(stream, read_only=True, keep_vba=False, data_only=True, keep_links=False)
    reader.read()
    return reader.wb


class _WorkbookTotals(Struct):
    """Totals over all sheets of a workbook (квоты книги).

    Attributes
    ----------
    elements : int
        Rows and cells that the file has.
    cells : int
        Cells built from them, with the empty ones in between.
    spans, merged : int
        Merged ranges, and the cells in them.
    """

    elements: int = 0
    cells: int = 0
    spans: int = 0
    merged: int = 0


def _rows(book: Any, sheet: Any, path: Path, totals: _WorkbookTotals) -> Iterator[Row]:
    """Yield the rows of a sheet down to the last that says something."""
    from openpyxl.utils import get_column_letter

    # A reader of single rows knows neither merged cells nor which of them are formulas.
    title = cut(sheet.title)
    with book._archive.open(sheet._worksheet_path) as stream:
        there = _Reader(path, title, totals).read(stream)
    if there.rows > ROW_LIMIT or there.columns > COLUMN_LIMIT:
        raise SubmissionError(
            "{}: sheet {!r} has {} rows and {} columns; the limits are {} and {}. Save only "
            "the answers.",
            path,
            title,
            there.rows,
            there.columns,
            ROW_LIMIT,
            COLUMN_LIMIT,
        )
    totals.cells += there.rows * there.columns
    if totals.cells > CELL_LIMIT:
        raise SubmissionError(
            "{}: sheet {!r} extends to {}: with it there are {} cells, the limit is {}. "
            "Delete the cells far from the table.",
            path,
            title,
            there.last,
            totals.cells,
            CELL_LIMIT,
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
    """Properties of a sheet other than the values of its cells (строение листа).

    Attributes
    ----------
    merged : dict
        The upper left cell of every merged one, by row and column.
    formulas : set of str
        Cells whose formula has no value.
    rows, columns : int
        Extent of the values.
    last : str
        The cell furthest down that has one.
    """

    merged: dict[tuple[int, int], tuple[int, int]] = field(default_factory=dict)
    formulas: set[str] = field(default_factory=set)
    rows: int = 0
    columns: int = 0
    last: str = ""


class _Reader:
    """Read the XML of a sheet without storing it: the extent of values, merged cells."""

    def __init__(self, path: Path, title: str, totals: _WorkbookTotals) -> None:
        self.there = _Structure()
        self.path, self.title, self.totals = path, title, totals
        self.cell, self.filled, self.formula, self.value = "", False, False, ""
        self.inside = ""

    def read(self, stream: Any) -> _Structure:
        parser = ParserCreate(namespace_separator=" ")
        parser.StartElementHandler = self.start
        parser.EndElementHandler = self.end
        parser.CharacterDataHandler = self.text
        parser.Parse(stream.read(), True)
        return self.there

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        kind = tag.rpartition(" ")[2]
        if kind in ("c", "row"):
            self.totals.elements += 1
            if self.totals.elements > CELL_LIMIT:
                raise SubmissionError(
                    "{}: with sheet {!r} there are over {} cells. Save only the answers.",
                    self.path,
                    self.title,
                    CELL_LIMIT,
                )
        if kind == "c":
            self.cell, self.filled, self.formula = attributes.get("r", ""), False, False
            self.value = self.inside = ""
        elif self.cell and kind in ("v", "f", "is"):
            self.filled, self.inside = True, kind
            self.formula |= kind == "f"
        elif kind == "mergeCell":
            self.merge(attributes.get("ref", ""))

    def text(self, data: str) -> None:
        if self.inside == "v" and not self.value:
            self.value = data

    def end(self, tag: str) -> None:
        from openpyxl.utils import column_index_from_string

        kind = tag.rpartition(" ")[2]
        if kind in ("v", "f"):
            self.inside = ""
        if kind != "c":
            return
        if self.formula and not self.value:
            self.there.formulas.add(self.cell)
        if self.filled and (place := re.match(_PLACE, self.cell)):
            self.there.rows = max(self.there.rows, int(place[2]))
            self.there.columns = max(self.there.columns, column_index_from_string(place[1]))
            if self.there.rows == int(place[2]) or not self.there.last:
                self.there.last = self.cell
        self.cell = ""

    def merge(self, reference: str) -> None:
        from openpyxl.utils import column_index_from_string

        self.totals.spans += 1
        if self.totals.spans > SPAN_LIMIT:
            raise SubmissionError(
                "{}: with sheet {!r} there are over {} merged ranges. Save only the answers.",
                self.path,
                self.title,
                SPAN_LIMIT,
            )
        span = re.match(_SPAN, reference)
        if span is None:
            return
        top, bottom = int(span[2]), min(int(span[4]), ROW_LIMIT)
        left, right = map(column_index_from_string, (span[1], span[3]))
        columns = range(left, min(right, COLUMN_LIMIT) + 1)
        for row, column in product(range(top, bottom + 1), columns):
            self.totals.merged += 1
            if self.totals.merged > MERGED_LIMIT:
                break
            self.there.merged[row, column] = (top, left)


def _text(cell: Any) -> tuple[str, Unread | None]:
    """Return the displayed text of a cell; a number in full digits, with its format's zeros."""
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
    """Read the metadata of a form; missing rows are reported."""
    for draft in gathering.drafts.values():
        draft.problem = "".join(meta.get("problem", ()))
        draft.variant = "".join(meta.get("variant", ())) or draft.variant
        draft.fingerprint = "".join(meta.get("fingerprint", ()))
        there = {answer.id for answer in draft.answers.values()}
        for name in meta.get("id", ()):
            if name not in there:
                draft.remark(Unread.ROW, name, META)
