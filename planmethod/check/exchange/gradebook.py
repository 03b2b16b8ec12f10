"""Marks for the gradebook of a learning management system, and pages by student (оценки в СДО)."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from planmethod.check.model import GradedSubmission
from planmethod.check.pages.files import file_names
from planmethod.check.pages.group import list_mistakes
from planmethod.check.pages.listing import safe
from planmethod.note.wording import Language, MessageTable


def gradebook_csv(
    works: Sequence[GradedSubmission],
    marks: Sequence[str],
    addresses: Mapping[str, str],
    language: Language,
) -> bytes:
    """Return the marks, a student a row: commas, decimal points, UTF-8.

    Parameters
    ----------
    marks : sequence of str
        Displayed marks of the submissions, one each.
    addresses : mapping of str to str
        E-mail by student: the gradebook's key of a student; empty for none.
    """
    texts: MessageTable = language.check["exchange"]
    heads = dict(texts["gradebook"])
    if not addresses:
        del heads["email"]
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\r\n")
    writer.writerow(heads.values())
    for work, mark in zip(works, marks, strict=True):
        cells = {
            "student": work.work.student,
            "email": addresses.get(work.work.student, ""),
            "variant": work.variant or "",
            "points": f"{work.points:.10g}",
            "of": f"{work.of:.10g}",
            "grade": f"{100.0 * work.points / work.of:.2f}" if work.of else "",
            "mark": mark,
            "feedback": "; ".join(filter(None, _feedback(work, language))),
        }
        writer.writerow(safe(cells[name]) for name in heads)
    return text.getvalue().encode()


def _feedback(submission: GradedSubmission, language: Language) -> Iterator[str]:
    texts: MessageTable = language.check["results"]
    if submission.failure is not None:
        yield texts.failure.format(why=submission.failure.message)
    if submission.is_provisional:
        yield texts.open.format(count=len(submission.open))
    yield list_mistakes(submission, language.check)
    yield submission.remark


def feedback_zip(works: Sequence[GradedSubmission], pages: Sequence[Path]) -> bytes:
    """Return the pages in a folder for each student; the same pages give the same bytes.

    Parameters
    ----------
    pages : sequence of Path
        Files that are called as the student's files are.
    """
    data = io.BytesIO()
    with ZipFile(data, "w", ZIP_DEFLATED) as archive:
        for name in file_names([work.work.student for work in works]):
            for page in pages:
                if page.stem == name:
                    entry = ZipInfo(f"{name}/{page.name}")
                    entry.compress_type = ZIP_DEFLATED
                    archive.writestr(entry, page.read_bytes())
    return data.getvalue()
