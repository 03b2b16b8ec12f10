"""Answers as a learning management system exports them (ответы из СДО).

Moodle's report of responses has a row for each attempt and a column for each question, ``Ответ 1``;
a question with embedded answers has all gaps in one cell: ``часть 1: 2,24; часть 2: 15,5``.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from msgspec import Struct

from planmethod.check.exchange.quiz import GapName
from planmethod.check.model import Submission, Unread
from planmethod.check.submissions.cells import (
    HEADS,
    MAILS,
    NUMBERED,
    Cell,
    SubmissionError,
    cut,
    key,
    read_answer,
    read_bytes,
)
from planmethod.check.submissions.gather import Gathering, SubmissionDraft
from planmethod.check.submissions.table import HEAD_ROWS, Head, Row, csv_rows, read_quantity
from planmethod.errors import ProblemError
from planmethod.note.wording import LANGUAGES, get_language
from planmethod.problem.source import parse, read_source

_NUMBERED = re.compile(r"([^\W\d]{1,40})\s{0,4}\d+")
_GAP = re.compile(r"(?:^|;\s*)[^\W\d]+ (\d+):[ ]?(.*?)(?=;\s*[^\W\d]+ \d+:|$)", re.DOTALL)
GAPS = "parts"
"""Type of a column that has all gaps of a question."""

FIELDS = ("student", "email", "variant", "question", GAPS, "-")
"""Types of a column other than a quantity; ``question`` is a text that names the variant."""

CELL_LIMIT = 20_000
"""Maximum number of characters read from a cell: all gaps of a question may be in one."""

Gaps = Callable[[str | None], Sequence[GapName]]
"""The gaps of a variant."""


class Responses(Struct, frozen=True):
    """Works of an export, and how the system knows the students (выгрузка).

    Attributes
    ----------
    submissions : list of Submission
    addresses : dict of str to str
        E-mail by student, where the export has it.
    """

    submissions: list[Submission]
    addresses: dict[str, str]


def is_export(path: Path) -> bool:
    """Return whether a file is an export of responses: a CSV with columns such as ``Ответ 1``."""
    if path.suffix.lower() not in (".csv", ".tsv", ".txt"):
        return False
    try:
        return _head(csv_rows(read_bytes(path), path), {}) is not None
    except SubmissionError:
        return False  # the reader of submissions reports the fault


def read_columns(definitions: Iterable[str]) -> dict[str, str]:
    """Return the column definitions: ``Ответ 1=v_B3``, or a TOML file with such keys.

    Raises
    ------
    WorksError
        It is neither.
    """
    found: dict[str, str] = {}
    for one in definitions:
        head, equal, what = one.partition("=")
        if equal:
            found[head.strip()] = what.strip()
            continue
        try:
            table = parse(read_source(Path(one)), name=one)
        except ProblemError as error:
            raise SubmissionError(f"{one}: {'; '.join(map(str, error.faults))}") from None
        for head, what in table.items():
            if not isinstance(what, str):
                raise SubmissionError(
                    "{}: '{}' must be a text: a quantity, or one of {}.",
                    one,
                    head,
                    ", ".join(FIELDS),
                )
            found[head] = what
    return found


def read_responses(
    path: Path, columns: Mapping[str, str], names: Sequence[str], gaps: Gaps
) -> Responses:
    """Return the submissions of an export; a student's last attempt counts.

    Parameters
    ----------
    columns : mapping of str to str
        Column types by their heads: a quantity as in a wide table ("v_B3, мм"), or one of
        `FIELDS`. Moodle's own columns need no definition.
    names : sequence of str
        Variants of the problem.
    gaps : callable
        The gaps of a variant, in their order.

    Raises
    ------
    WorksError
        A defined column is missing in the file, or the answers of the file are not identified.
    """
    rows = csv_rows(read_bytes(path), path, CELL_LIMIT)
    at = _head(rows, columns)
    if at is None:
        raise SubmissionError(
            "{}: no header row with columns of answers: 'Response 1', 'Response 2'. It has "
            "{}. Specify the columns: --columns 'HEAD=v_B3'.",
            path,
            _list_heads(rows[0] if rows else ()),
        )
    head = rows[at]
    told = {key(one): what for one, what in columns.items()}
    missing = [one for one in columns if key(one) not in {key(cell.text) for cell in head}]
    if missing:
        raise SubmissionError("{}: no column '{}'. It has {}.", path, missing[0], _list_heads(head))
    for one, what in columns.items():
        if _column(one, told) == Head() and what != "-":
            raise SubmissionError(
                "{}: column '{}' is given as '{}', which is neither a quantity nor one of {}.",
                path,
                one,
                what,
                ", ".join(FIELDS),
            )
    export = _Export(path, [_column(cell.text, told) for cell in head], names, gaps)
    for row in rows[at + 1 :]:
        export.read(row)
    return Responses(export.gathering.submissions(), export.addresses)


def _head(rows: Sequence[Row], columns: Mapping[str, str]) -> int | None:
    """Return the number of the row that is the head."""
    told = {key(one) for one in columns}
    for number, row in enumerate(rows[:HEAD_ROWS]):
        if any(_numbered(cell.text) == "answer" or key(cell.text) in told for cell in row):
            return number
    return None


def _list_heads(row: Row) -> str:
    return ", ".join(f"'{cell.text}'" for cell in row if cell.text) or "—"


def _column(text: str, columns: Mapping[str, str]) -> Head:
    """Return the type of a column; an empty head for an ignored one."""
    what = columns.get(key(text))
    if what is not None:
        return Head(what) if what in FIELDS else read_quantity(what)
    name = key(text)
    if name in MAILS:
        return Head("email")
    field = HEADS.get(name, "")
    return Head(field if field in ("student", "variant") else _numbered(text))


def _numbered(text: str) -> str:
    """Return the type of a numbered head; an empty string for any other."""
    match = _NUMBERED.fullmatch(text.strip())
    return NUMBERED.get(match[1].casefold(), "") if match else ""


class _Export:
    """An export while it is read."""

    def __init__(self, path: Path, heads: Sequence[Head], names: Sequence[str], gaps: Gaps) -> None:
        self.path, self.heads, self.names, self.gaps = path, heads, names, gaps
        self.gathering, self.addresses = Gathering(str(path)), dict[str, str]()
        self._mail_by_name: dict[str, str] = {}

    def read(self, row: Row) -> None:
        """Read an attempt; the last row of a student counts."""
        cells = list(zip(self.heads, row, strict=False))
        name = " ".join(cell.text for head, cell in cells if head.field == "student" and cell.text)
        mail = next((c.text for h, c in cells if h.field == "email" and c.text), "")
        given = [cell for head, cell in cells if head.name or head.field in ("answer", GAPS)]
        if not name and not mail:
            if any(not cell.is_blank for cell in given):
                line = cut(" ".join(cell.text for cell in row))
                self.gathering.note(Unread.STUDENT, line, row[0].location)
            return
        if not mail and all(cell.is_blank for cell in given) and self.addresses:
            return  # the line of averages
        student = self._student(name or mail, mail)
        self.gathering.drafts.pop(student, None)
        draft = self.gathering.of(student)
        draft.variant = self._variant(cells)
        for head, cell in cells:
            if head.name:
                unit = {"unit": Cell(head.unit, cell.location)} if head.unit else {}
                draft.add_answer(read_answer({"what": Cell(head.name), head.field: cell, **unit}))
        self._add_gaps(draft, [cell for head, cell in cells if head.field in ("answer", GAPS)])

    def _student(self, name: str, mail: str) -> str:
        student = name
        if mail and self._mail_by_name.setdefault(name, mail) != mail:
            student = f"{name} ({mail})"  # another one of the same name
        if mail:
            self.addresses[student] = mail
        return student

    def _variant(self, cells: Sequence[tuple[Head, Cell]]) -> str | None:
        """Return the variant: from its column, else from the text of a question."""
        for head, cell in cells:
            if head.field == "variant" and cell.text:
                return cell.text
        texts = " ".join(cell.text for head, cell in cells if head.field == "question")
        words = [str(get_language(one).check["key"].variant) for one in LANGUAGES]
        for name in sorted(self.names, key=len, reverse=True):
            for word in words:
                phrase = re.escape(word.format(variant=name))
                if re.search(rf"{phrase}(?!\w)", texts, re.IGNORECASE):
                    return name
        return None

    def _add_gaps(self, draft: SubmissionDraft, cells: Sequence[Cell]) -> None:
        """Read the columns without a definition: gaps in one cell, or a column for each."""
        if not cells:
            return
        known = draft.variant if draft.variant in self.names else None
        names = self.gaps(known)
        parted = [cell for cell in cells if _GAP.match(cell.text)]
        if parted:
            for cell in parted:
                for number, text in _gaps(cell.text):
                    if 1 <= number <= len(names):
                        _add_gap_answer(
                            draft, names[number - 1], Cell(cut(text), f"{cell.location}, {number}")
                        )
        elif len(cells) == len(names):
            for one, cell in zip(names, cells, strict=True):
                _add_gap_answer(draft, one, cell)
        elif any(not cell.is_blank for cell in cells):
            raise SubmissionError(
                "{0}: {1} column{1:||s} of answers, but {2} gaps are expected: {3}. Specify "
                "each column: --columns 'Response 1=v_B3'.",
                self.path,
                len(cells),
                len(names),
                ", ".join(one.id for one in names if not one.sense),
            )


def _gaps(text: str) -> Iterator[tuple[int, str]]:
    """Yield the gaps of a cell by their numbers, from 1."""
    for match in _GAP.finditer(text):
        yield int(match[1]), match[2].strip()


def _add_gap_answer(draft: SubmissionDraft, gap: GapName, cell: Cell) -> None:
    field = "sense" if gap.sense else "value"
    position = Cell(str(gap.position), cell.location)
    draft.add_answer(read_answer({"id": Cell(gap.id), field: cell, "position": position}))
