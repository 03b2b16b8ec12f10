"""Graded submissions as rows of tables, and points set by hand in ``overrides.csv``."""

from __future__ import annotations

import csv
import io
import stat
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, TypeVar

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.model import Diagnosis, GradedAnswer, GradedSubmission, KeyEntry
from planmethod.check.pages.remarks import displayed_value
from planmethod.errors import ExitCode, PlanMethodError
from planmethod.note.numbers import finite_or_none
from planmethod.problem.formula import read_decimal
from planmethod.problem.source import table_text

RESULT_COLUMNS = (
    "student", "variant", "id", "what", "verdict", "from", "value", "exact", "tolerance", "unit",
    "mm", "exact_mm", "sense", "sense_right", "local", "points", "of", "codes", "where", "remark",
)  # fmt: skip
"""Columns of ``results.csv``."""

_FORMULA = "=+-@\t\r"


def record(checked: GradedSubmission) -> dict[str, Any]:
    """Return a graded submission as plain data: SI, full precision, None for missing values."""
    return {
        "student": checked.work.student,
        "variant": checked.variant,
        "answers": [_answer(judged) for judged in checked.answers],
        "diagnosis": [_diagnosis(diagnosis) for diagnosis in checked.diagnosis],
        "points": finite_or_none(checked.points),
        "of": finite_or_none(checked.of),
        "suspicious": checked.suspicious,
        "alike": list(checked.similar_students),
        "remark": checked.remark or None,
        "by_hand": checked.is_manual,
        "provisional": checked.is_provisional,
        "failure": None
        if checked.failure is None
        else {"why": checked.failure.message, "trace": checked.failure.trace or None},
        "unreadable": [
            {"where": written.location, "what": written.unreadable}
            for written in checked.work.remarks
        ],
    }


def _answer(answer: GradedAnswer) -> dict[str, Any]:
    key, written = answer.key, answer.written
    sense = None if written is None or written.sense is None else written.sense.value
    return {
        "id": answer.id,
        "verdict": answer.verdict.value,
        "from": answer.follows or None,
        "value": _displayed_or_none(answer.value, key),
        "exact": None if key is None else _displayed_or_none(key.exact, key),
        "tolerance": _number(answer.tolerance),
        "mm": None if written is None else _number(written.mm),
        "exact_mm": None if key is None else _number(key.mm),
        "points": _number(answer.points),
        "where": answer.location or None,
        "unit": None if key is None else key.unit,
        "of": _number(answer.of),
        "position": None if key is None else key.position,
        "local": _displayed_or_none(answer.local, key),
        "sense": sense,
        "exact_sense": None if key is None or key.sense is None else key.sense.value,
        "sense_right": answer.sense_right,
        "slip": answer.slip,
        "unreadable": None if written is None else written.unreadable or None,
        "remark": answer.remark or None,
        "by_hand": answer.is_manual,
    }


def _diagnosis(diagnosis: Diagnosis) -> dict[str, Any]:
    return {
        "codes": list(diagnosis.codes),
        "sure": diagnosis.sure,
        "roots": list(diagnosis.roots),
        "where": diagnosis.mistake_at or None,
    }


def _displayed_or_none(value: float | None, key: KeyEntry | None) -> float | None:
    return _number(value if value is None or key is None else displayed_value(value, key))


def _number(value: float | None) -> float | None:
    return None if value is None else finite_or_none(value)


def codes_of(checked: GradedSubmission, answer: GradedAnswer) -> tuple[str, ...]:
    """Return the codes of the mistakes that begin at an answer."""
    found = [code for d in checked.diagnosis if answer.id in d.roots for code in d.codes]
    return tuple(dict.fromkeys(found))


def safe(text: str) -> str:
    """Return a text that no table program takes for a formula."""
    return f"'{text}" if text[:1] and text[0] in _FORMULA else text


def csv_bytes(works: Iterable[GradedSubmission]) -> bytes:
    """Return ``results.csv``: an answer a row, semicolons, decimal points, UTF-8 with a mark."""
    text = io.StringIO(newline="")
    writer = csv.writer(text, delimiter=";", lineterminator="\r\n")
    writer.writerow(RESULT_COLUMNS)
    for checked in works:
        writer.writerows(_result_rows(checked))
    return text.getvalue().encode("utf-8-sig")


def _result_rows(checked: GradedSubmission) -> Iterator[list[str]]:
    for judged in checked.answers:
        cells = _answer(judged) | {
            "student": checked.work.student,
            "variant": checked.variant,
            "what": "" if judged.key is None else judged.key.label,
            "codes": " ".join(codes_of(checked, judged)),
        }
        yield [_cell(cells[column]) for column in RESULT_COLUMNS]


def _cell(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(int(value))
    return repr(value) if isinstance(value, float) else safe(str(value))


OVERRIDE_COLUMNS = ("student", "id", "points", "remark")
INFORMATION_COLUMNS = ("of", "written", "where")
"""Further columns of a file written by a run: they describe an open answer, and are not read."""

HEAD = (*OVERRIDE_COLUMNS, *INFORMATION_COLUMNS)
MAX_BYTES = 1_000_000
MAX_ROWS = 10_000
T = TypeVar("T", GradedSubmission, GradedAnswer)


class OverridesError(PlanMethodError):
    """The file of overrides cannot be read (правки не читаются)."""

    exit_code = ExitCode.USAGE


class Override(Struct, frozen=True):
    """Points or a remark set by hand for one answer, or for a whole submission (правка).

    Attributes
    ----------
    student : str
    id : str
        Empty for the whole submission.
    points : float or None
        None where only a remark is made.
    remark : str
    location : str
        ``overrides.csv:4``.
    """

    student: str
    id: str
    points: float | None
    remark: str
    location: str


def read_overrides(path: Path) -> tuple[Override, ...]:
    """Read a file of overrides; return none if the file does not exist.

    Raises
    ------
    OverridesError
        Naming the file and the row, and what to do.
    """
    return tuple(_overrides(_override_rows(path)[0], path))


def students_of(path: Path) -> frozenset[str]:
    """Return the students that a file of overrides names.

    Raises
    ------
    OverridesError
    """
    rows, _ = _override_rows(path)
    at = [cell.strip().lower() for cell in rows[0]].index("student") if rows else 0
    cells = (row[at].strip() for row in rows[1:] if at < len(row))
    return frozenset(map(_strip_guard, filter(None, cells)))


def overrides_file(
    path: Path, works: Sequence[GradedSubmission], *, is_ours: bool
) -> tuple[bytes, bool] | None:
    """Return a file of overrides with a row for every open answer, to be filled in.

    Returns
    -------
    (bytes, bool) or None
        The file, and whether the run owns it, without any text of the instructor. None
        if it is unchanged.

    Raises
    ------
    OverridesError
    """
    is_own = is_ours or not path.exists()
    rows, mark = ([list(HEAD)], ";") if is_own else _override_rows(path)
    head = [cell.strip().lower() for cell in rows[0]] if rows else []
    if not {"student", "id", "points"} <= set(head):
        return None  # a file without answers of its own
    number = {name: at for at, name in enumerate(head)}

    def cell(row: Sequence[str], name: str) -> str:
        return _strip_guard(row[number[name]].strip()) if number[name] < len(row) else ""

    there = {(cell(row, "student"), cell(row, "id")) for row in rows[1:]}
    found = _lines(rows, mark)
    size, room = len(found.encode()), MAX_ROWS - len(rows)
    more: list[str] = []
    for student, judged in _open(works):
        if (student, judged.id) in there:
            continue
        written = judged.written
        told = {
            "student": safe(student),
            "id": safe(judged.id),
            "of": f"{judged.of:g}",
            "written": "" if written is None else safe(written.raw or written.fault),
            "where": safe(judged.location),
        }
        line = _lines([[told.get(name, "") for name in head]], mark)
        size += len(line.encode())
        if size > MAX_BYTES or len(more) >= room:
            break  # what a run reads again: the others come when these are decided
        more.append(line)
    if not more and not is_own:
        return None
    return "".join([found, *more]).encode("utf-8-sig"), is_own


def _lines(rows: Sequence[Sequence[str]], mark: str) -> str:
    text = io.StringIO(newline="")
    csv.writer(text, delimiter=mark, lineterminator="\r\n").writerows(rows)
    return text.getvalue()


def _open(works: Sequence[GradedSubmission]) -> Iterator[tuple[str, GradedAnswer]]:
    """Yield the open answers of marked submissions, each once."""
    for work in works:
        if work.is_provisional:
            once: dict[str, GradedAnswer] = {}
            for judged in work.open:
                if judged.of > once.setdefault(judged.id, judged).of:
                    once[judged.id] = judged
            for judged in once.values():
                yield work.work.student, judged


def _override_rows(path: Path) -> tuple[list[list[str]], str]:
    """Return the rows of a file of overrides and what separates its columns.

    Raises
    ------
    OverridesError
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise OverridesError("{}: this is not a file. Name another with --overrides.", path)
        with path.open("rb") as file:
            data = file.read(MAX_BYTES + 1)
    except FileNotFoundError:
        return [], ";"
    except OSError as error:
        raise OverridesError("Cannot read {}: {}.", path, error.strerror) from error
    if len(data) > MAX_BYTES:
        raise OverridesError(
            "{} is larger than {} bytes. Keep only the overrides.", path, MAX_BYTES
        )
    text = table_text(data)
    head = text.partition("\n")[0]
    mark = max(";,\t", key=head.count)
    try:
        rows = list(csv.reader(io.StringIO(text.replace("\0", ""), newline=""), delimiter=mark))
    except csv.Error as error:
        raise OverridesError("{} is not a table: {}. Save it as CSV again.", path, error) from error
    return rows, mark


def _overrides(rows: Sequence[Sequence[str]], path: Path) -> Iterator[Override]:
    if not rows:
        return
    head = [cell.strip().lower() for cell in rows[0]]
    if len(rows) > MAX_ROWS or not {"student", "points"} <= set(head):
        raise OverridesError(
            "{}: expected columns {} and at most {} rows. Delete the file; the next run "
            "writes an empty one.",
            path,
            ", ".join(OVERRIDE_COLUMNS),
            MAX_ROWS,
        )
    for number, row in enumerate(rows[1:], 2):
        told = dict(zip(head, (cell.strip() for cell in row), strict=False))
        where = f"{path.name}:{number}"
        student, remark = told.get("student", ""), told.get("remark", "")
        points = _points(told.get("points", ""), where)
        if not student and (points is not None or remark):
            raise OverridesError("{}: no student is named. Fill in the column student.", where)
        if points is not None or remark:
            yield Override(
                _strip_guard(student), _strip_guard(told.get("id", "")), points, remark, where
            )


def _points(text: str, location: str) -> float | None:
    if not text:
        return None
    points = read_decimal(text.replace(",", "."))
    if points is None or not 0 <= points <= 10**6:
        raise OverridesError("{}: points are a number from 0, got {!r}.", location, text[:40])
    return float(points)


def _strip_guard(text: str) -> str:
    """Return a text without the sign that keeps table programs from taking it for a formula."""
    return text[1:] if text[:1] == "'" and text[1:2] in ("=", "+", "-", "@") else text


def apply_overrides(
    works: Sequence[GradedSubmission], overrides: Sequence[Override]
) -> tuple[list[GradedSubmission], tuple[str, ...]]:
    """Return the submissions with the overrides, and the rows without a submission or answer."""
    used: set[str] = set()
    changed = []
    for checked in works:
        own = [o for o in overrides if o.student == checked.work.student]
        answers = _answers(checked.answers, own, used)
        gained = sum(j.points for j in answers) - sum(j.points for j in checked.answers)
        now = replace(checked, answers=answers, points=checked.points + gained)
        for override in own:
            if not override.id:
                used.add(override.location)
                now = _apply_override(now, override)
        changed.append(now)
    return changed, tuple(o.location for o in overrides if o.location not in used)


def _answers(
    answers: Sequence[GradedAnswer], overrides: Sequence[Override], used: set[str]
) -> tuple[GradedAnswer, ...]:
    """Return answers with the overrides; a duplicate answer is decided once."""
    found = list(answers)
    for override in (override for override in overrides if override.id):
        same = [n for n, judged in enumerate(found) if judged.id == override.id]
        counts = [n for n in same if found[n].of] or same[:1]
        for n in same:
            decided = override if n in counts else replace(override, points=found[n].points)
            found[n] = _apply_override(found[n], decided)
            used.add(override.location)
    return tuple(found)


def _apply_override(target: T, override: Override) -> T:
    """Return a submission, or an answer, with the points and the remark that were set by hand."""
    points = target.points if override.points is None else override.points
    by_hand = target.is_manual or override.points is not None
    return replace(
        target, points=points, is_manual=by_hand, remark=override.remark or target.remark
    )
