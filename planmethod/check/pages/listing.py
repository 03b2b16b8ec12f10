"""Graded submissions as records and as rows of a data table (записи и строки результатов)."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Iterator
from typing import Any

from planmethod.check.model import Diagnosis, GradedAnswer, GradedSubmission, KeyEntry
from planmethod.check.pages.answer_format import displayed_value
from planmethod.note.numbers import finite_or_none

COLUMNS = (
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
    writer.writerow(COLUMNS)
    for checked in works:
        writer.writerows(_rows(checked))
    return text.getvalue().encode("utf-8-sig")


def _rows(checked: GradedSubmission) -> Iterator[list[str]]:
    for judged in checked.answers:
        cells = _answer(judged) | {
            "student": checked.work.student,
            "variant": checked.variant,
            "what": "" if judged.key is None else judged.key.label,
            "codes": " ".join(codes_of(checked, judged)),
        }
        yield [_cell(cells[column]) for column in COLUMNS]


def _cell(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(int(value))
    return repr(value) if isinstance(value, float) else safe(str(value))
