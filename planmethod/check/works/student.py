"""Submissions as JSON or TOML: the object of docs/works.md, or a list of them (объект работы)."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from planmethod.check.model import Unread, Work
from planmethod.check.works.answer import read_answer
from planmethod.check.works.cells import Cell, cut
from planmethod.check.works.faults import WorksError
from planmethod.check.works.gather import ANSWER_LIMIT, STUDENT_LIMIT, WorkDraft, scale_name
from planmethod.errors import ProblemError
from planmethod.problem.source import parse

SCHEMA = 1

_WORK = ("schema", "student", "problem", "variant", "scales", "ruler_mm", "answers", "names")
_ANSWER = ("what", "id", "value", "unit", "mm", "segment", "sense", "position")
_IGNORED = ("note", "name", "group", "date")


class _Digits(str):
    """A number of JSON, with the digits as they were written."""

    __slots__ = ()


def read_json(data: bytes, path: Path) -> list[Work]:
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
        raise WorksError("{}: byte {} is not UTF-8. Save it as UTF-8.", path, error.start) from None
    except json.JSONDecodeError as error:
        raise WorksError(
            "{}: this is not JSON: {}, line {}, column {}.",
            path,
            error.msg,
            error.lineno,
            error.colno,
        ) from None
    except RecursionError:
        raise WorksError("{}: nested too deeply; a submission needs three levels.", path) from None
    if not isinstance(whole, list):
        return [_work(whole, path, "")]
    if len(whole) > STUDENT_LIMIT:
        raise WorksError("{}: over {} students. Split the file.", path, STUDENT_LIMIT)
    works = []
    for number, one in enumerate(whole):
        try:
            works.append(_work(one, path, f"[{number}]."))
        except WorksError as error:
            if len(whole) == 1:
                raise
            told = _cell(one.get("student") if isinstance(one, Mapping) else None)
            own = f"{path.stem} [{number}]" if told.why else told.text or f"{path.stem} [{number}]"
            works.append(Work(own, (), where=str(path), failure=str(error)))
    return works


def read_toml(data: bytes, path: Path) -> list[Work]:
    """Return the submission of a TOML file.

    Raises
    ------
    WorksError
        It is not TOML, or not of a submission.
    """
    try:
        whole = parse(data.decode("utf-8-sig"), name=str(path))
    except UnicodeDecodeError as error:
        raise WorksError("{}: byte {} is not UTF-8. Save it as UTF-8.", path, error.start) from None
    except ProblemError as error:
        raise WorksError(f"{path}: {'; '.join(map(str, error.faults))}") from None
    return [_work(whole, path, "")]


def _work(whole: Any, path: Path, before: str) -> Work:
    """Return the submission of an object; ``before`` is its location."""
    where = f"{path}: {before.rstrip('.')}".rstrip(": ")
    if not isinstance(whole, Mapping) or "answers" not in whole:
        raise WorksError('{}: expected an object with "student" and "answers".', where)
    schema = whole.get("schema", SCHEMA)
    if isinstance(schema, bool) or str(schema) != str(SCHEMA):
        raise WorksError("{}: schema {}; this program reads {}.", where, cut(str(schema)), SCHEMA)
    answers = whole.get("answers")
    if not isinstance(answers, list) or len(answers) > ANSWER_LIMIT:
        raise WorksError("{}: 'answers' must be a list of at most {} objects.", where, ANSWER_LIMIT)
    student = _cell(whole.get("student"), f"{before}student")
    own = f"{path.stem} {before.rstrip('.')}".rstrip()
    draft = WorkDraft(own if student.why is Unread.TEXT else student.text or path.stem, str(path))
    if student.why is Unread.TEXT:
        draft.remark(student.why, student.text, student.where)
    _note_unknown(draft, whole, _WORK, before)
    for field in ("variant", "problem", "ruler_mm"):
        draft.put_field(field, _cell(whole.get(field), f"{before}{field}"))
    scales = whole.get("scales") or {}
    if not isinstance(scales, Mapping):
        draft.remark(Unread.SCALE, str(scales), f"{before}scales")
        scales = {}
    for key, value in scales.items():
        at = f"{before}scales.{cut(key)}"
        if name := scale_name(key):
            draft.put_scale(name, _cell(value, at), "")
        else:
            draft.remark(Unread.SCALE, key, at)
    names = whole.get("names")
    if isinstance(names, Mapping):
        draft.points = {cut(key): _cell(value).text for key, value in names.items()}
    for number, answer in enumerate(answers):
        at = f"{before}answers[{number}]"
        if not isinstance(answer, Mapping):
            draft.remark(Unread.QUANTITY, str(answer), at)
            continue
        _note_unknown(draft, answer, _ANSWER, f"{at}.")
        cells = {key: _cell(answer.get(key), f"{at}.{key}") for key in _ANSWER}
        draft.put(read_answer(cells, where=at))
    return draft.work()


def _note_unknown(
    draft: WorkDraft, table: Mapping[str, Any], known: tuple[str, ...], before: str
) -> None:
    for key in table:
        if key not in known and key not in _IGNORED:
            draft.remark(Unread.KEY, key, f"{before}{cut(key)}")


def _cell(value: Any, where: str = "") -> Cell:
    """Return the text of a value; a number in full digits, empty for null."""
    if value is None:
        return Cell("", where)
    plain = isinstance(value, str | int | float) and not isinstance(value, bool)
    whole = str(value) if plain else json.dumps(value, default=str)
    text, why = cut(whole), None if plain else Unread.NUMBER
    return Cell(text, where, why=Unread.TEXT if re.search("[\ud800-\udfff]", whole) else why)
