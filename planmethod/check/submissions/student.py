"""Submissions as JSON or TOML: the object of docs/works.md, or a list of them (объект работы)."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from planmethod.check.model import Submission, Unread
from planmethod.check.submissions.answer import read_answer
from planmethod.check.submissions.cells import Cell, cut
from planmethod.check.submissions.faults import SubmissionError
from planmethod.check.submissions.gather import (
    ANSWER_LIMIT,
    STUDENT_LIMIT,
    SubmissionDraft,
    scale_name,
)
from planmethod.errors import ProblemError
from planmethod.problem.source import parse

SCHEMA = 1

_SUBMISSION_KEYS = (
    "schema",
    "student",
    "problem",
    "variant",
    "scales",
    "ruler_mm",
    "answers",
    "names",
)
_ANSWER = ("what", "id", "value", "unit", "mm", "segment", "sense", "position")
_IGNORED = ("note", "name", "group", "date")


class _Digits(str):
    """A number of JSON, with the digits as they were written."""

    __slots__ = ()


def read_json(data: bytes, path: Path) -> list[Submission]:
    """Return the submissions of a JSON file.

    Raises
    ------
    WorksError
        It is not JSON, or not of submissions.
    """
    try:
        text = data.decode("utf-8-sig")
        whole = json.loads(text, parse_float=_Digits, parse_int=_Digits, parse_constant=_Digits)
    except UnicodeDecodeError as error:
        raise SubmissionError(
            "{}: byte {} is not UTF-8. Save it as UTF-8.", path, error.start
        ) from None
    except json.JSONDecodeError as error:
        raise SubmissionError(
            "{}: this is not JSON: {}, line {}, column {}.",
            path,
            error.msg,
            error.lineno,
            error.colno,
        ) from None
    except RecursionError:
        raise SubmissionError(
            "{}: nested too deeply; a submission needs three levels.", path
        ) from None
    if not isinstance(whole, list):
        return [_read_submission(whole, path, "")]
    if len(whole) > STUDENT_LIMIT:
        raise SubmissionError("{}: over {} students. Split the file.", path, STUDENT_LIMIT)
    works = []
    for number, one in enumerate(whole):
        try:
            works.append(_read_submission(one, path, f"[{number}]."))
        except SubmissionError as error:
            if len(whole) == 1:
                raise
            told = _cell(one.get("student") if isinstance(one, Mapping) else None)
            own = (
                f"{path.stem} [{number}]" if told.reason else told.text or f"{path.stem} [{number}]"
            )
            works.append(Submission(own, (), location=str(path), failure=str(error)))
    return works


def read_toml(data: bytes, path: Path) -> list[Submission]:
    """Return the submission of a TOML file.

    Raises
    ------
    WorksError
        It is not TOML, or not of a submission.
    """
    try:
        whole = parse(data.decode("utf-8-sig"), name=str(path))
    except UnicodeDecodeError as error:
        raise SubmissionError(
            "{}: byte {} is not UTF-8. Save it as UTF-8.", path, error.start
        ) from None
    except ProblemError as error:
        raise SubmissionError(f"{path}: {'; '.join(map(str, error.faults))}") from None
    return [_read_submission(whole, path, "")]


def _read_submission(data: Any, path: Path, before: str) -> Submission:
    """Return the submission of an object; ``before`` is its location."""
    where = f"{path}: {before.rstrip('.')}".rstrip(": ")
    if not isinstance(data, Mapping) or "answers" not in data:
        raise SubmissionError('{}: expected an object with "student" and "answers".', where)
    schema = data.get("schema", SCHEMA)
    if isinstance(schema, bool) or str(schema) != str(SCHEMA):
        raise SubmissionError(
            "{}: schema {}; this program reads {}.", where, cut(str(schema)), SCHEMA
        )
    answers = data.get("answers")
    if not isinstance(answers, list) or len(answers) > ANSWER_LIMIT:
        raise SubmissionError(
            "{}: 'answers' must be a list of at most {} objects.", where, ANSWER_LIMIT
        )
    student = _cell(data.get("student"), f"{before}student")
    own = f"{path.stem} {before.rstrip('.')}".rstrip()
    draft = SubmissionDraft(
        own if student.reason is Unread.TEXT else student.text or path.stem, str(path)
    )
    if student.reason is Unread.TEXT:
        draft.remark(student.reason, student.text, student.location)
    _note_unknown(draft, data, _SUBMISSION_KEYS, before)
    for entry in ("variant", "problem", "ruler_mm"):
        draft.set_field(entry, _cell(data.get(entry), f"{before}{entry}"))
    scales = data.get("scales") or {}
    if not isinstance(scales, Mapping):
        draft.remark(Unread.SCALE, str(scales), f"{before}scales")
        scales = {}
    for symbol, value in scales.items():
        at = f"{before}scales.{cut(symbol)}"
        if name := scale_name(symbol):
            draft.set_scale(name, _cell(value, at), "")
        else:
            draft.remark(Unread.SCALE, symbol, at)
    names = data.get("names")
    if isinstance(names, Mapping):
        draft.points = {cut(key): _cell(value).text for key, value in names.items()}
    for number, answer in enumerate(answers):
        at = f"{before}answers[{number}]"
        if not isinstance(answer, Mapping):
            draft.remark(Unread.QUANTITY, str(answer), at)
            continue
        _note_unknown(draft, answer, _ANSWER, f"{at}.")
        cells = {key: _cell(answer.get(key), f"{at}.{key}") for key in _ANSWER}
        draft.add_answer(read_answer(cells, location=at))
    return draft.build()


def _note_unknown(
    draft: SubmissionDraft, table: Mapping[str, Any], known: tuple[str, ...], before: str
) -> None:
    for entry in table:
        if entry not in known and entry not in _IGNORED:
            draft.remark(Unread.KEY, entry, f"{before}{cut(entry)}")


def _cell(value: Any, location: str = "") -> Cell:
    """Return the text of a value; a number in full digits, empty for null."""
    if value is None:
        return Cell("", location)
    plain = isinstance(value, str | int | float) and not isinstance(value, bool)
    whole = str(value) if plain else json.dumps(value, default=str)
    text, why = cut(whole), None if plain else Unread.NUMBER
    return Cell(text, location, reason=Unread.TEXT if re.search("[\ud800-\udfff]", whole) else why)
