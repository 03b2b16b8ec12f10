"""Submissions as a table, one row per answer or per student; CSV files (таблица ответов)."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import islice
from pathlib import Path

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.model import Submission, Unread
from planmethod.check.submissions.cells import (
    BLANK,
    HEADS,
    MM,
    POINT,
    TEXT_LIMIT,
    Cell,
    SubmissionError,
    cut,
    first_filled,
    key,
    read_answer,
    read_name,
)
from planmethod.check.submissions.gather import Gathering, SubmissionDraft, scale_name
from planmethod.problem.formula import read_unit
from planmethod.problem.source import table_text

ROW_LIMIT, COLUMN_LIMIT = 20_000, 400
CELL_LIMIT = 200_000
"""Limit over all sheets of a file; a group of thirty has a thousand."""

ASPECTS = ("value", "mm", "sense", "unit", "segment")
"""Aspects of an answer that may have a separate column."""

_PLAN_LENGTHS = ("length", "segment", "arm", "shift")
_LAST_WORD = r"(.*\S)\s+(\S+)\Z"
_QUANTITY = "[A-Za-zΑ-ωϕ]"


class Head(Struct, frozen=True):
    """Type of a column (столбец).

    Attributes
    ----------
    field : str
        One of the fields of `HEADS`; empty if unknown.
    name : str
        Quantity, of which ``field`` is an aspect; or scale, where ``field`` is ``scale``.
    unit : str
        Unit of the numbers below without their own.
    """

    field: str = ""
    name: str = ""
    unit: str = ""


@lru_cache(maxsize=4096)
def read_head(text: str) -> Head:
    """Return what a head says by itself: ``мм``, ``Значение, м/с``, ``μ_v, (м/с)/мм``."""
    for base, suffix in ((text, ""), *_parted(text)):
        if suffix and not read_unit(suffix):
            continue
        name = key(base) or base
        if scale := scale_name(base):
            return Head("scale", scale, suffix)
        field = "mm" if HEADS.get(name) == "segment" and suffix in MM else HEADS.get(name, "")
        if field:
            return Head(field, unit="" if field == "mm" else suffix)
    return Head()


@lru_cache(maxsize=4096)
def read_quantity(text: str) -> Head:
    """Return the quantity and aspect of a column: ``v_B3 (мм)``, ``v_B3, м/с``."""
    if read_name(text)[0]:
        return Head("value", text)
    match = re.match(_LAST_WORD, text)
    if match and (aspect := read_aspect(match[2])):
        return _of_aspect(match[1].rstrip(",;: "), aspect)
    for base, suffix in _parted(text):
        if aspect := read_aspect(suffix):
            return _of_aspect(base, aspect)
        if read_unit(suffix):
            return Head("value", base, suffix)
    # Words without a letter of the plans: a mark, a signature.
    return Head("value", text) if re.search(_QUANTITY, text) and len(text) <= 60 else Head()


def read_aspect(text: str) -> str:
    """Return the aspect of an answer that a word names, or an empty string."""
    field = HEADS.get(key(text), "")
    return field if field in ASPECTS else ""


def _of_aspect(name: str, aspect: str) -> Head:
    if aspect == "mm" and read_name(name)[0].split(" ")[0] in _PLAN_LENGTHS:
        return Head("value", name, "mm")  # the requested quantity is itself a length on a plan
    return Head(aspect, name)


def _parted(text: str) -> Iterator[tuple[str, str]]:
    """Yield a head and what may be its unit: from behind each of its commas and brackets."""
    for mark in re.finditer(r"[,;(\[]", text):
        suffix = text[mark.start() :].strip(" ,;[]")
        if suffix.startswith("(") and suffix.find(")") == len(suffix) - 1:
            suffix = suffix[1:-1]
        if base := text[: mark.start()].strip():
            yield base, suffix.strip()


HEAD_ROWS = 20
"""Number of rows from the top in which the head is searched."""

Row = Sequence[Cell]

_IDENTITY_FIELDS = ("student", "number", "variant")
"""Fields that identify the student, in order of priority."""

_ABOVE = ("student", "variant", "problem", "ruler_mm")
_MERGED = (*_IDENTITY_FIELDS, "problem", "position", "what", "id")
"""Fields whose merged cell applies to all rows that it covers."""


def read_table(rows: Sequence[Row], gathering: Gathering, title: str, *, closed: bool) -> bool:
    """Read the submissions of a table.

    Parameters
    ----------
    title : str
        Who the student is if the table does not say.
    closed : bool
        No row may be longer than the head.

    Returns
    -------
    bool
        False if no row among the first is a head.
    """
    at = head_row(rows)
    if at is None:
        return False
    head, below = rows[at], rows[at + 1 :]
    heads = [read_head(cell.text or cell.merged) for cell in head]
    who = next((name for name in _IDENTITY_FIELDS if any(one.field == name for one in heads)), "")
    shared = _above(rows[:at])
    if not _is_long(head):
        heads, below = _wide_heads(head, heads, below)
    elif who != "student" and "student" in shared:
        who = ""  # № counts the answers of the one student
    heads = [_known_once(gathering, heads[:n], heads[n], cell) for n, cell in enumerate(head)]
    only = shared.get("student", (BLANK, ""))[0].text or title
    for row in below:
        if all(not cell.text and cell.reason is None for cell in row):
            continue
        line = cut(" ".join(cell.text for cell in row))
        cells = _placed(row, head, heads, line) if closed else list(zip(heads, row, strict=False))
        student = only
        if who:
            names = (cell.text or cell.merged for one, cell in cells if one.field == who)
            student = " ".join(name for name in names if name)
        if not student:
            place = next(cell.location for cell in row if cell.text or cell.reason)
            gathering.note(Unread.STUDENT, line, place)
            continue
        draft = gathering.of(student)
        if not draft.answers and not draft.remarks:
            _apply_shared(draft, shared)
        _read_row(draft, cells)
    if shared and not gathering.drafts:
        _apply_shared(gathering.of(only), shared)
    return True


def _known_once(gathering: Gathering, before: Sequence[Head], head: Head, cell: Cell) -> Head:
    """Return the head of a column; an unknown or duplicate one is reported."""
    same = any(one.field == head.field and not one.name for one in before)
    twice = same and not head.name and head.field not in (*_IDENTITY_FIELDS, "note", "")
    if cell.text and (twice or not head.field):
        gathering.note(Unread.COLUMN, cell.text, cell.location)
    return Head() if twice else head


def _placed(row: Row, top: Row, heads: Sequence[Head], line: str) -> list[tuple[Head, Cell]]:
    """Return the cells of a row of text: a place is a line and a column, and no line is longer."""
    width = max(number for number, cell in enumerate(top, 1) if cell.text)
    longer = any(cell.text for cell in row[width:])
    cells = []
    for head, above, cell in zip(heads, top, row, strict=False):
        if above.text:
            cell = replace(cell, location=f"{cell.location}, {above.text}")
        if longer and head.field not in _MERGED:
            cell = replace(cell, text=line, reason=Unread.FIELDS)
        cells.append((head, cell))
    return cells


def head_row(rows: Sequence[Row]) -> int | None:
    """Return the number of the row that is the head; a long one before a wide one."""
    for is_head in (_is_long, _is_wide):
        for number, row in enumerate(rows[:HEAD_ROWS]):
            if is_head(row):
                return number
    return None


def _fields(row: Row) -> set[str]:
    return {read_head(cell.text or cell.merged).field for cell in row}


def _is_long(row: Row) -> bool:
    fields = _fields(row)
    return not fields.isdisjoint({"what", "id"}) and not fields.isdisjoint({"value", "mm"})


def _is_wide(row: Row) -> bool:
    said = [cell for cell in row if cell.text]
    return len(said) > 1 and not _fields(row).isdisjoint(_IDENTITY_FIELDS)


def _above(rows: Sequence[Row]) -> dict[str, tuple[Cell, str]]:
    """Return the shared values above the head, by field or scale, with their units."""
    told: dict[str, tuple[Cell, str]] = {}
    for row in rows:
        name, unit = "", ""
        for cell in row:
            label, colon, value = cell.text.partition(":")
            head = read_head(label if colon else cell.text)
            if head.field in _ABOVE or (head.field == "scale" and head.name):
                name, unit = head.name or head.field, head.unit
                told.setdefault(name, (BLANK, unit))
                cell = replace(cell, text=value.strip())
            if name and told[name][0].is_blank:
                told[name] = (cell, unit)
    return told


def _apply_shared(draft: SubmissionDraft, shared: Mapping[str, tuple[Cell, str]]) -> None:
    for name, (cell, unit) in shared.items():
        if name.startswith("mu_"):
            draft.set_scale(name, cell, unit)
        elif name != "student":
            draft.set_field(name, cell)


def _wide_heads(
    row: Row, heads: Sequence[Head], below: Sequence[Row]
) -> tuple[list[Head], Sequence[Row]]:
    """Return the column types of a wide table, whose head may have a second row."""
    under: Sequence[Cell] = below[0] if below else ()
    said = [cell.text for cell in under if cell.text]
    two = bool(said) and all(read_aspect(text) or read_unit(text) for text in said)
    # A name may look like a unit, but a second head row is empty in that column.
    who = [
        cell.text
        for head, cell in zip(heads, under, strict=False)
        if head.field in _IDENTITY_FIELDS
    ]
    two = two and not any(who)
    found_heads: list[Head] = []
    for number, (cell, head) in enumerate(zip(row, heads, strict=True)):
        text = cell.text or cell.merged
        if two and number < len(under) and under[number].text:
            text = f"{text}, {under[number].text}"
        known = head.field and head.field not in ASPECTS
        found_heads.append(head if known or not text else read_quantity(text))
    return found_heads, below[1:] if two else below


def _read_row(draft: SubmissionDraft, cells: Sequence[tuple[Head, Cell]]) -> None:
    """Take what a row says: of the student, and an answer or those of all columns."""
    own: dict[str, Cell] = {}
    asked: list[dict[str, Cell]] = []
    for head, cell in cells:
        if cell.merged and head.field in _MERGED:
            cell = replace(cell, text=cell.merged)
        if head.field == "scale" and head.name:
            draft.set_scale(head.name, cell, head.unit)
        elif head.field in ("variant", "problem", "ruler_mm"):
            draft.set_field(head.field, cell)
        elif head.name:
            answer = next(
                (a for a in asked if a["what"].text == head.name and head.field not in a), None
            )
            if answer is None:
                answer = {"what": Cell(head.name)}
                asked.append(answer)
            answer[head.field] = cell
            if head.unit:
                answer["unit"] = Cell(head.unit, cell.location)
        elif head.field:
            if own.get(head.field, BLANK).is_blank or (head.field == "unit" and cell.text):
                own[head.field] = cell
            if head.unit and head.field == "value" and own.get("unit", BLANK).is_blank:
                own["unit"] = Cell(head.unit, cell.location)
    for answer in asked:
        draft.add_answer(read_answer({**own, **answer}))
    if not asked:
        _read_long_row(draft, own)


def _read_long_row(draft: SubmissionDraft, cells: Mapping[str, Cell]) -> None:
    named, value = first_filled(cells, "what", "id").text, first_filled(cells, "value", "mm")
    word, _, point = named.partition(" ")
    if scale := scale_name(named):
        draft.set_scale(scale, value, first_filled(cells, "unit").text)
    elif HEADS.get(key(named)) in _ABOVE[1:]:
        draft.set_field(HEADS[key(named)], value)
    elif key(word) in POINT and point:
        draft.points[point.strip()] = value.text
    else:
        draft.add_answer(read_answer(cells))
        if not first_filled(cells, "scale").is_blank:
            draft.set_row_scale(named, cells["scale"])


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
