"""Works of students as departments have them: JSON, TOML, CSV, XLSX (работы студентов)."""

from __future__ import annotations

from pathlib import Path

from planmethod.arguments import of_type
from planmethod.check.model import Submission
from planmethod.check.submissions.cells import SubmissionError, ratio, read_bytes
from planmethod.check.submissions.gather import read_json, read_toml
from planmethod.check.submissions.table import read_csv
from planmethod.check.submissions.xlsx_file import read_xlsx

_READERS = {
    ".json": read_json,
    ".toml": read_toml,
    ".csv": read_csv,
    ".tsv": read_csv,
    ".txt": read_csv,
    ".xlsx": read_xlsx,
    ".xlsm": read_xlsx,
}

_ZIP = b"PK\x03\x04"
_OLD_EXCEL = b"\xd0\xcf\x11\xe0"


def read_works(path: Path) -> list[Submission]:
    """Read the submissions of a file: one student or a group.

    The formats are described in docs/reference/works-formats.md.
    Files are never executed, and sizes are bounded. An unreadable part of an answer is reported in
    the answer, with its cell.

    Raises
    ------
    WorksError
        The file as a whole cannot be read.
    """
    path = Path(of_type("path", path, str | Path))
    data = read_bytes(path)
    if data.startswith(_OLD_EXCEL):
        raise SubmissionError("{}: this is an old or encrypted workbook. Save it as XLSX.", path)
    reader = read_xlsx if data.startswith(_ZIP) else _READERS.get(path.suffix.lower())
    if reader is None:
        known = ", ".join(_READERS)
        raise SubmissionError(
            "{}: not one of {}. Save the submissions as one of these.", path, known
        )
    works = reader(data, path)
    if not works:
        raise SubmissionError("{}: it contains no submission. Is this the right file?", path)
    return works


__all__ = ["SubmissionError", "ratio", "read_works"]
