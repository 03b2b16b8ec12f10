"""Answers collected by student: scales, duplicates, remarks; JSON and TOML objects."""

# Cyrillic letters: scales that they are written with

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.check.model import Submission, Unread, WrittenAnswer
from planmethod.check.submissions.cells import (
    Cell,
    NotReadError,
    SubmissionError,
    cut,
    key,
    mark_unreadable,
    read_answer,
    read_number,
    read_scaled,
)
from planmethod.errors import ProblemError
from planmethod.problem.formula import Dimension, read_unit
from planmethod.problem.names import fold
from planmethod.problem.source import parse

STUDENT_LIMIT = 2000
ANSWER_LIMIT = 2000

_SCALE = r"(?:mu|μ|µ|мю)[\s_{]*([lvafs])[\s}]*\Z"
_RATIO = r"(?:[MМ]\s*)?1\s*:\s*(\S+)\Z"
_WORD = r"([\s_\-{}(),]+)"
_POINT = r"([^\W\d_])([0-9]*'*)"
_MM = 1e-3
_OF_SCALES: dict[str, Dimension] = {
    "mu_l": (1, 0, 0, 0),
    "mu_v": (1, -1, 0, 0),
    "mu_a": (1, -2, 0, 0),
    "mu_F": (0, 0, 1, 0),
}
_OF_LETTERS = {"v": "mu_v", "a": "mu_a", "f": "mu_F", "r": "mu_F", "l": "mu_l"}
_RETAINED_FIELDS = ("what", "id", "position", "location")


def is_of(unit: str, scale: str) -> bool:
    """Return whether quantities measured on a plan of this scale have this unit."""
    found = read_unit(unit)
    return found is not None and found.dimension == _OF_SCALES.get(scale)


def scale_name(text: str) -> str:
    """Return the scale that a text names, ``mu_v``, or empty: ``μᵥ``, ``mu v``, ``μ_v``."""
    match = re.match(_SCALE, fold(text.strip().casefold().replace("ᵥ", "v").replace("ₐ", "a")))
    return "" if match is None else f"mu_{'l' if match[1] == 's' else match[1]}".replace("f", "F")


class SubmissionDraft(Struct):
    """Work of a student while it is read."""

    student: str
    location: str
    variant: str | None = None
    problem: str = ""
    ruler: float | None = None
    fingerprint: str = ""
    scales: dict[str, float] = field(default_factory=dict)
    answers: dict[tuple[str, str, int | None], WrittenAnswer] = field(default_factory=dict)
    twice: list[WrittenAnswer] = field(default_factory=list)
    remarks: list[WrittenAnswer] = field(default_factory=list)
    points: dict[str, str] = field(default_factory=dict)
    """Points of the problem by their names in this submission."""

    def remark(self, reason: Unread, text: str, location: str) -> None:
        """Record an unreadable entry."""
        self.remarks.append(mark_unreadable(reason, text, location))

    def add_answer(self, answer: WrittenAnswer) -> None:
        """Add an answer; a contradictory duplicate is not read."""
        name = (answer.what, key(answer.id), answer.position)
        if not answer.what and not answer.id:
            if answer.unreadable:
                self.remarks.append(answer)
            return
        if name not in self.answers:
            if len(self.answers) >= ANSWER_LIMIT:
                raise SubmissionError(
                    "{}: over {} answers of one student.", self.location, ANSWER_LIMIT
                )
            self.answers[name] = answer
            return
        joined = _joined(self.answers[name], answer)
        if joined is not None:
            self.answers[name] = joined
        elif len(self.twice) < ANSWER_LIMIT:
            text = answer.raw or answer.id or answer.what
            self.twice.append(mark_unreadable(Unread.TWICE, text, answer.location, base=answer))

    def set_scale(self, name: str, cell: Cell, unit: str) -> None:
        """Set one of the student's scales, in SI per millimetre; also ``1:2`` for lengths."""
        if cell.is_blank:
            return
        ratio = re.match(_RATIO, cell.text) if name == "mu_l" and cell.reason is None else None
        value = 0.0
        if ratio is not None:
            number = read_number(ratio[1])
            value = number.value * _MM if number and not number.rest else 0.0
        else:
            try:
                value, _, own, _ = read_scaled(cell, Cell(unit, cell.location))
                value *= _per_mm(name, own)
            except NotReadError as fault:
                if fault.reason is not Unread.NUMBER:
                    self.remark(fault.reason, fault.text, cell.location)
                    return
        if not 0.0 < value < 1e12:
            self.remark(Unread.SCALE, cell.text, cell.location)
        elif self.scales.setdefault(name, value) != value:
            self.remark(Unread.TWICE, f"{name} = {cell.text}", cell.location)

    def set_row_scale(self, quantity: str, cell: Cell) -> None:
        """Set the scale written next to an answer: that of the quantity's plan."""
        name = _OF_LETTERS.get(fold(quantity)[:1].casefold(), "")
        if cell.reason is Unread.FORMULA:
            return  # the form's formula repeats the scale above the head
        if name:
            self.set_scale(name, cell, "")
        else:
            self.remark(Unread.SCALE, cell.text, cell.location)

    def set_field(self, name: str, cell: Cell) -> None:
        """Set the student's variant, the problem, or the step of the ruler."""
        if cell.is_blank:
            return
        if cell.reason:
            self.remark(cell.reason, cell.text, cell.location)
        elif name == "ruler_mm":
            try:
                value, _, unit, _ = read_scaled(cell, Cell())
            except NotReadError as fault:
                self.remark(fault.reason, fault.text, cell.location)
                return
            value *= 1e3 if unit else 1.0
            if 0.0 < value <= 50.0:
                self.ruler = value
            else:
                self.remark(Unread.NUMBER, cell.text, cell.location)
        elif (getattr(self, name) or cell.text) == cell.text:
            setattr(self, name, cell.text)
        else:
            self.remark(Unread.TWICE, cell.text, cell.location)

    def _renamed(self, answer: WrittenAnswer) -> WrittenAnswer:
        """Return an answer with the points called as the problem calls them."""
        if not self.points:
            return answer
        small = {his.lower(): ours.lower() for his, ours in self.points.items()}
        what, own = (_called(name, self.points, skip=1) for name in (answer.what, answer.id))
        return replace(answer, what=what, id=own, segment=_called(answer.segment, small))

    def build(self) -> Submission:
        """Return what has been put together."""
        return Submission(
            student=self.student,
            answers=tuple(map(self._renamed, (*self.answers.values(), *self.twice))),
            variant=self.variant,
            scales=dict(self.scales),
            ruler_mm=self.ruler,
            problem=self.problem,
            location=self.location,
            remarks=tuple(self.remarks),
            fingerprint=self.fingerprint,
        )


class Gathering:
    """Submissions of a file by student, in the order of the file (работы группы)."""

    def __init__(self, location: str) -> None:
        self.location = location
        self.drafts: dict[str, SubmissionDraft] = {}
        self.remarks: list[WrittenAnswer] = []

    def note(self, reason: Unread, text: str, location: str) -> None:
        """Record an unreadable entry without a student."""
        if len(self.remarks) < ANSWER_LIMIT:
            self.remarks.append(mark_unreadable(reason, text, location))

    def of(self, student: str) -> SubmissionDraft:
        """Return the draft of a student."""
        if student not in self.drafts:
            if len(self.drafts) >= STUDENT_LIMIT:
                raise SubmissionError(
                    "{}: over {} students. Is the column of the students the right one?",
                    self.location,
                    STUDENT_LIMIT,
                )
            self.drafts[student] = SubmissionDraft(student, self.location)
        return self.drafts[student]

    def submissions(self) -> list[Submission]:
        """Return the submissions; remarks without a student go to the first one."""
        works = [draft.build() for draft in self.drafts.values()]
        if self.remarks:
            first, *others = works or [Submission("", (), location=self.location)]
            works = [replace(first, remarks=(*self.remarks, *first.remarks)), *others]
        return works


def _per_mm(scale: str, unit: str) -> float:
    """Return the factor that converts a scale in its unit to per millimetre; 0 for a wrong unit.

    Written are (м/с)/мм, м/с alone, and м/с·мм, which means the first.
    """
    found = read_unit(unit) if unit else None
    if found is None:
        return 1.0
    length, *others = found.dimension
    base, *wanted = _OF_SCALES[scale]
    return _MM ** (base - length) if others == wanted and abs(length - base) < 2 else 0.0


def _called(text: str, names: Mapping[str, str], *, skip: int = 0) -> str:
    """Return a text with the names of points replaced, after skipping some of its words."""
    words = re.split(_WORD, text)
    for number in range(2 * skip, len(words), 2):
        if match := re.fullmatch(_POINT, words[number]):
            name = names.get(match[0]) or names.get(match[1], match[1]) + match[2]
            words[number] = name
    return "".join(words)


def _joined(one: WrittenAnswer, second: WrittenAnswer) -> WrittenAnswer | None:
    """Return two notes of the same answer as one; None if they do not say the same."""
    if one.unreadable or second.unreadable:
        return None
    blank = WrittenAnswer()
    said: dict[str, object] = {}
    for name in WrittenAnswer.__struct_fields__:
        mine, theirs, nothing = getattr(one, name), getattr(second, name), getattr(blank, name)
        if name in _RETAINED_FIELDS or theirs == nothing:
            continue
        if mine not in (nothing, theirs) and name not in ("raw", "unit", "step", "mm_step"):
            return None
        said[name] = theirs if mine == nothing else mine
    return replace(one, **said)


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
