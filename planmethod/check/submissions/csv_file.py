"""Works as CSV: what encoding, what separator, and the rows (файл CSV)."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

from planmethod.check.model import Submission
from planmethod.check.submissions.cells import TEXT_LIMIT, Cell, cut
from planmethod.check.submissions.faults import SubmissionError
from planmethod.check.submissions.gather import Gathering
from planmethod.check.submissions.table import (
    CELL_LIMIT,
    COLUMN_LIMIT,
    HEAD_ROWS,
    ROW_LIMIT,
    Row,
    head_row,
    read_table,
)
from planmethod.problem.source import table_text

_SEPARATORS = (";", "\t", ",")


def read_csv(data: bytes, path: Path) -> list[Submission]:
    """Return the submissions of a CSV file: ``;``, ``,`` or tab; UTF-8, UTF-16 with BOM, cp1251.

    Raises
    ------
    WorksError
        It is not a text, has no head, or is too long.
    """
    rows = csv_rows(data, path)
    gathering = Gathering(str(path))
    if not read_table(rows, gathering, path.stem, closed=True):
        raise SubmissionError(
            "{}: none of the first {} rows is a header. Name the columns: student, what, "
            "value, unit, mm, sense; or student and the quantities.",
            path,
            HEAD_ROWS,
        )
    return gathering.submissions()


def csv_rows(data: bytes, path: Path, limit: int = TEXT_LIMIT) -> list[Row]:
    """Return the rows of a CSV file, each cell with its location and limited in length.

    Raises
    ------
    WorksError
        It is not a text, or too long.
    """
    text = decoded(data, path)
    first, _, rest = text.partition("\n")
    separator = ""
    if first.lower().startswith("sep=") and len(first.strip()) == 5:  # a line of Excel's own
        separator, text = first.strip()[4], "\n" + rest
    try:
        return list(_rows(text, separator or _separator(text, path), path, limit))
    except csv.Error as error:
        raise SubmissionError(
            "{}: this is not CSV: {}. Is a quote left open?", path, error
        ) from None


def decoded(data: bytes, path: Path) -> str:
    """Return the text of a file in UTF-8, UTF-16 with its mark, or cp1251.

    Raises
    ------
    WorksError
    """
    text = table_text(data)
    if "\0" in text:
        raise SubmissionError(
            "{}: this is not a text. Save the table as CSV in UTF-8, or as XLSX.", path
        )
    return text


def _separator(text: str, path: Path) -> str:
    """Return the separator with which a head is found, and the most columns of it."""
    counts = {}
    for separator in _SEPARATORS:
        try:
            rows = list(islice(_rows(text, separator, path), HEAD_ROWS))
        except csv.Error:
            continue
        at = head_row(rows)
        counts[separator] = 0 if at is None else len(rows[at])
    return max(counts, key=lambda one: counts[one], default=";")


def _rows(text: str, separator: str, path: Path, limit: int = TEXT_LIMIT) -> Iterator[Row]:
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    cells = 0
    for count, row in enumerate(reader, 1):
        cells += len(row)
        if count > ROW_LIMIT or len(row) > COLUMN_LIMIT or cells > CELL_LIMIT:
            raise SubmissionError(
                "{}: over {} rows, over {} columns in row {}, or over {} cells.",
                path,
                ROW_LIMIT,
                COLUMN_LIMIT,
                count,
                CELL_LIMIT,
            )
        where = f"{path.name}:{reader.line_num}"
        yield [Cell(cut(field, limit), where) for field in row]
