"""All files of a checked group, each whole or not at all (файлы проверки)."""

from __future__ import annotations

import hashlib
import re
import unicodedata
from collections.abc import Callable, Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeAlias

from msgspec import Struct
from msgspec.structs import asdict, replace

from planmethod.check.checking import failure_of
from planmethod.check.key import Key
from planmethod.check.marks import Settings
from planmethod.check.model import CheckFailure, GradedAnswer, GradedSubmission, WrittenAnswer
from planmethod.check.pages.folder import OVERRIDES, PAGES, RECORD, RunFolder, digest_of
from planmethod.check.pages.group import group_html, results_xlsx, statistics_of
from planmethod.check.pages.listing import csv_bytes, overrides_file
from planmethod.check.pages.student import student_html, student_page, student_pdf
from planmethod.errors import OutputError
from planmethod.note.wording import Language, MessageTable, get_language
from planmethod.problem.model import Problem
from planmethod.problem.records import KindProblem
from planmethod.render.backends.output import write
from planmethod.solved.solution import Solution

PACKAGES = ("planmethod", "numpy")


class GradingRun(Struct, frozen=True):
    """What the marks of a group came from (прогон проверки).

    Attributes
    ----------
    settings : Settings
    inputs : sequence of Path
        Files: the problem, then the submissions.
    lang : str
        Language of the pages and tables.
    hidden : bool
        The names of submission files are names of students, so these files are numbered.
    unread : mapping of Path to CheckFailure
        Those of the files that cannot be read, and why.
    """

    settings: Settings
    inputs: Sequence[Path]
    lang: str
    hidden: bool = False
    unread: Mapping[Path, CheckFailure] = {}


def run_record(run: GradingRun, count: int) -> dict[str, Any]:
    """Return the record of a run with a count of works: versions, settings, digests of files.

    Raises
    ------
    OutputError
        When an input is gone.
    """
    told, missed = [], []
    for number, path in enumerate(run.inputs):
        name = f"works-{number}{path.suffix}" if run.hidden and number else path.name
        if path not in run.unread:
            told.append({"name": name, "sha256": _digest(path)})
            continue
        why, trace = (
            text.replace(str(path), name).replace(path.name, name)
            for text in (run.unread[path].message, run.unread[path].trace)
        )
        missed.append({"name": name, "why": why, "trace": trace})
    return {
        "schema": 1,
        "versions": {name: _version(name) for name in PACKAGES},
        "language": run.lang,
        "settings": asdict(run.settings),
        "inputs": told,
        "unread": missed,
        "works": count,
    }


def settings_rows(record: Mapping[str, Any]) -> dict[str, str | float]:
    """Return the record of a run as lines of a table."""
    rows: dict[str, str | float] = {}
    for name, value in record["settings"].items():
        if isinstance(value, list | tuple):
            rows[name] = "; ".join(f"{mark}: {least:g}" for least, mark in value)
        elif value is not None:
            rows[name] = value
    rows |= {name: told for name, told in record["versions"].items() if told}
    for file in record["inputs"]:
        rows[file["name"]] = f"SHA-256 {file['sha256']}"
    return rows


def _version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def _digest(path: Path) -> str:
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise OutputError("Cannot read {} again: {}.", path, error.strerror) from error


def hidden_name(student: str, salt: str) -> str:
    """Return what a student is called where names are hidden: the same in every run of a salt."""
    return "s-" + hashlib.sha256(f"{salt}\n{student}".encode()).hexdigest()[:8]


def anonymous(works: Sequence[GradedSubmission], salt: str) -> list[GradedSubmission]:
    """Return the submissions without the names of students and of their files."""
    return [_anonymous(checked, salt) for checked in works]


def _anonymous(checked: GradedSubmission, salt: str) -> GradedSubmission:
    work = checked.work
    hidden = hidden_name(work.student, salt)
    file = Path(work.location).name

    def strip_names(text: str) -> str:
        for name in (work.location, file, work.student):
            text = text.replace(name, hidden) if name else text
        return text

    def rewritten(written: WrittenAnswer) -> WrittenAnswer:
        return replace(
            written,
            location=strip_names(written.location),
            unreadable=strip_names(written.unreadable),
            raw=strip_names(written.raw),
            fault=strip_names(written.fault),
        )

    def strip_answer(answer: GradedAnswer) -> GradedAnswer:
        written = None if answer.written is None else rewritten(answer.written)
        return replace(answer, written=written, remark=strip_names(answer.remark))

    answers = tuple(map(strip_answer, checked.answers))
    told = replace(
        work,
        student=hidden,
        location="",
        answers=tuple(map(rewritten, work.answers)),
        remarks=tuple(map(rewritten, work.remarks)),
        failure=strip_names(work.failure),
    )
    alike = tuple(hidden_name(name, salt) for name in checked.similar_students)
    failure = checked.failure
    if failure is not None:
        failure = CheckFailure(strip_names(failure.message), strip_names(failure.trace))
    return replace(
        checked,
        work=told,
        answers=answers,
        remark=strip_names(checked.remark),
        similar_students=alike,
        failure=failure,
    )


LONGEST = 40
"""Letters of a file's name: with four bytes each and its ending it is short enough anywhere."""

_RESERVED = r"(?i)(con|prn|aux|nul|com\d|lpt\d)(\.|$)"


def file_names(students: Sequence[str]) -> list[str]:
    """Return a unique name for the files of each student, safe on every system."""
    taken: set[str] = set()
    names = []
    for student in students:
        plain = re.sub(r"[^\w.-]+", "-", unicodedata.normalize("NFC", student))[:LONGEST]
        plain = plain.strip("-. ") or "student"
        plain = f"_{plain}" if re.match(_RESERVED, plain) else plain
        name, copy = plain, 2
        while name.casefold() in taken:
            name, copy = f"{plain}-{copy}", copy + 1
        taken.add(name.casefold())
        names.append(name)
    return names


def marks_of(works: Sequence[GradedSubmission], settings: Settings) -> list[str]:
    """Return the marks of submissions; empty for one that is not marked."""
    return [settings.mark(work.points / work.of) if work.of else "" for work in works]


def format_marks(
    works: Sequence[GradedSubmission], marks: Sequence[str], language: Language
) -> list[str]:
    """Return the displayed marks, with notes for provisional and missing ones."""
    texts: MessageTable = language.check["results"]
    return [
        texts.provisional.format(mark=mark)
        if work.is_provisional
        else texts.unmarked
        if work.failure is not None
        else mark
        for work, mark in zip(works, marks, strict=True)
    ]


class GroupFiles(Struct, frozen=True):
    """Results of writing a group (файлы группы).

    Attributes
    ----------
    paths : tuple of Path
        In the order in which they were written.
    pages : dict of str to Path
        HTML page of each student with one.
    failures : tuple of (str, CheckFailure)
        Students whose page could not be made, with the reason.
    changed_files : tuple of Path
        Files of an earlier run that were edited since: they are kept.
    """

    paths: tuple[Path, ...]
    pages: dict[str, Path]
    failures: tuple[tuple[str, CheckFailure], ...]
    changed_files: tuple[Path, ...]


Table: TypeAlias = Callable[[Sequence[str], Sequence[Path]], bytes]
"""Function that builds a further file from the displayed marks and the pages."""


def write_all(
    out: Path,
    checked: Sequence[GradedSubmission],
    keys: Mapping[str | None, Key],
    run: GradingRun,
    *,
    tables: Mapping[str, Table] = MappingProxyType({}),
    done: Callable[[int], None] = lambda works: None,
) -> GroupFiles:
    """Write the tables of a group and a page for each student.

    What an earlier run wrote into the folder, and this one does not, is taken away. A page that
    cannot be made stops no other.

    Parameters
    ----------
    out : Path
        Folder of the files; the pages go to ``pages`` in it.
    checked : sequence of GradedSubmission
        Submissions with the overrides, and with the names hidden if requested.
    keys : mapping
        By the variant of a submission; without a key there is no page.
    run : GradingRun
        What the marks came from.
    tables : mapping of str to Table
        Further files by their names.
    done : callable
        Called after the pages of each submission are written.

    Raises
    ------
    OutputError
    """
    record, settings = run_record(run, len(checked)), run.settings
    language, marks = get_language(run.lang), marks_of(checked, settings)
    shown = format_marks(checked, marks, language)
    group = statistics_of(checked, marks, [mark for _, mark in settings.marks])
    told = settings_rows(record)
    files = {
        "results.xlsx": results_xlsx(checked, language, marks=shown, settings=told, group=group),
        "results.csv": csv_bytes(checked),
    }
    if group is not None:
        title = next((key.problem.title for key in keys.values()), "")
        files["group.html"] = group_html(group, checked, title, language).encode()
    folder, pages = RunFolder(out), StudentPages(keys, settings, language)
    by_hand = overrides_file(out / OVERRIDES, checked, is_ours=folder.owns(OVERRIDES))
    names = file_names([work.work.student for work in checked])
    endings = [f"{PAGES}/{name}.{ending}" for name in names for ending in ("html", "pdf")]
    folder.record_names([*files, *endings, *tables])
    paths = [folder.write(name, data) for name, data in files.items()]
    if by_hand is not None:
        data, is_own = by_hand
        write(out / OVERRIDES, data, output_root=out)
        if is_own:
            folder.files[OVERRIDES] = digest_of(data)
        paths.append(out / OVERRIDES)
    made: dict[str, Path] = {}
    failures: list[tuple[str, CheckFailure]] = []
    for name, work, mark in zip(names, checked, shown, strict=True):
        try:
            written = pages.of(work, mark)
        except MemoryError:
            raise
        except Exception as error:  # an internal error: the others get their pages
            failures.append((work.work.student, failure_of(error)))
            written = {}
        for ending, data in written.items():
            paths.append(folder.write(f"{PAGES}/{name}.{ending}", data))
            if ending == "html":
                made.setdefault(work.work.student, paths[-1])
        done(1)
    told_pages = [path for path in paths if path.parent.name == PAGES]
    paths += [folder.write(name, table(shown, told_pages)) for name, table in tables.items()]
    failed = [(one.work.student, one.failure) for one in checked if one.failure is not None]
    record["failures"] = [
        {"student": student, "why": failure.message, "trace": failure.trace}
        for student, failure in (*failed, *failures)
    ]
    record["pages"] = {student: path.relative_to(out).as_posix() for student, path in made.items()}
    kept = folder.finish(record)
    return GroupFiles((*paths, out / RECORD), made, tuple(failures), tuple(kept))


class StudentPages:
    """Pages of students, each by the key of its variant (листы студентов)."""

    def __init__(
        self, keys: Mapping[str | None, Key], settings: Settings, language: Language
    ) -> None:
        self.keys, self.values, self.language = keys, settings.values, language
        self._solved: dict[str | None, Solution | KindProblem] = {}

    def of(self, submission: GradedSubmission, mark: str) -> dict[str, bytes]:
        """Return the page of a submission by file extension; none if it is not marked."""
        key = self.keys.get(submission.variant)
        if key is None or submission.failure is not None:  # reported in the tables
            return {}
        if submission.variant not in self._solved:
            problem = key.problem
            found = Solution(problem) if isinstance(problem, Problem) else problem
            self._solved[submission.variant] = found
        solved = self._solved[submission.variant]
        page = student_page(
            submission,
            solved,
            self.language,
            scales=key.scales,
            mark=mark,
            values=self.values == "always" or (self.values == "decided" and not submission.open),
        )
        return {
            "html": student_html(page, solved, self.language).encode(),
            "pdf": student_pdf(page, solved, self.language),
        }
