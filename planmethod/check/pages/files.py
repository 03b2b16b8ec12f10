"""All files of a checked group, each whole or not at all (файлы проверки)."""

from __future__ import annotations

import hashlib
import json
import re
import unicodedata
from collections.abc import Callable, Iterator, Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from msgspec.structs import asdict, replace

from planmethod.check.key import Key
from planmethod.check.marks import Settings
from planmethod.check.model import CheckedWork, Judged, WrittenAnswer
from planmethod.check.pages.grouppage import group_html
from planmethod.check.pages.listing import csv_bytes
from planmethod.check.pages.overrides import HEAD
from planmethod.check.pages.results import results_xlsx
from planmethod.check.pages.statistics import statistics_of
from planmethod.check.pages.student import student_html, student_page, student_pdf
from planmethod.errors import OutputError
from planmethod.note.wording import language
from planmethod.problem.head import KindProblem
from planmethod.problem.model import Problem
from planmethod.render.backends.output import write
from planmethod.solved.solution import Solution

PACKAGES = ("planmethod", "numpy")


def run_record(
    settings: Settings, inputs: Sequence[Path], lang: str, count: int, *, hidden: bool = False
) -> dict[str, Any]:
    """Return what a run was made of: versions, settings, the digests of its files.

    Where names are ``hidden`` the files of works, those after the first, are called by number.

    Raises
    ------
    OutputError
        When an input is gone.
    """
    return {
        "schema": 1,
        "versions": {name: _version(name) for name in PACKAGES},
        "language": lang,
        "settings": asdict(settings),
        "inputs": [
            {
                "name": f"works-{n}{path.suffix}" if hidden and n else path.name,
                "sha256": _digest(path),
            }
            for n, path in enumerate(inputs)
        ],
        "works": count,
    }


def run_json(record: Mapping[str, Any]) -> bytes:
    """Return the record of a run as a file."""
    return (json.dumps(record, ensure_ascii=False, allow_nan=False, indent=1) + "\n").encode()


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


def anonymous(works: Sequence[CheckedWork], salt: str) -> list[CheckedWork]:
    """Return the works without the names of students and of their files."""
    return [_anonymous(checked, salt) for checked in works]


def _anonymous(checked: CheckedWork, salt: str) -> CheckedWork:
    work = checked.work
    hidden = hidden_name(work.student, salt)
    file = Path(work.where).name

    def bare(text: str) -> str:
        for name in (work.where, file, work.student):
            text = text.replace(name, hidden) if name else text
        return text

    def rewritten(written: WrittenAnswer) -> WrittenAnswer:
        return replace(
            written,
            where=bare(written.where),
            unreadable=bare(written.unreadable),
            raw=bare(written.raw),
            fault=bare(written.fault),
        )

    def judged_of(judged: Judged) -> Judged:
        written = None if judged.written is None else rewritten(judged.written)
        return replace(judged, written=written, remark=bare(judged.remark))

    answers = tuple(map(judged_of, checked.answers))
    told = replace(
        work,
        student=hidden,
        where="",
        answers=tuple(map(rewritten, work.answers)),
        remarks=tuple(map(rewritten, work.remarks)),
    )
    alike = tuple(hidden_name(name, salt) for name in checked.alike)
    return replace(checked, work=told, answers=answers, remark=bare(checked.remark), alike=alike)


LONGEST = 40
"""Letters of a file's name: with four bytes each and its ending it is short enough anywhere."""

_RESERVED = r"(?i)(con|prn|aux|nul|com\d|lpt\d)(\.|$)"


def file_names(students: Sequence[str]) -> list[str]:
    """Return a name for the files of each student: safe on every system, no two alike."""
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


def write_all(
    out: Path,
    checked: Sequence[CheckedWork],
    keys: Mapping[str | None, Key],
    settings: Settings,
    inputs: Sequence[Path],
    lang: str,
    *,
    hidden: bool = False,
    done: Callable[[int], None] = lambda works: None,
) -> list[Path]:
    """Write the tables of a group and a page for each student.

    Parameters
    ----------
    out : Path
        Folder of the files; the pages go to ``pages`` in it.
    checked : sequence of CheckedWork
        With the overrides, and with the names hidden if they shall be.
    keys : mapping
        By the variant of a work; a work without a key has no page.
    inputs : sequence of Path
        Files that the marks came from: the problem, then the works.
    hidden : bool
        The names of the files of works are names of students.
    done : callable
        Is told of every work whose pages are written.

    Returns
    -------
    list of Path
        In the order in which they were written.

    Raises
    ------
    OutputError
    """
    run = run_record(settings, inputs, lang, len(checked), hidden=hidden)
    marks = [settings.mark(work.points / work.of) if work.of else "" for work in checked]
    words = language(lang)
    group = statistics_of(checked, marks, [mark for _, mark in settings.marks])
    told = settings_rows(run)
    files = {
        "results.xlsx": results_xlsx(checked, words, marks=marks, settings=told, group=group),
        "results.csv": csv_bytes(checked),
        "run.json": run_json(run),
    }
    if group is not None:
        title = next((key.problem.title for key in keys.values()), "")
        files["group.html"] = group_html(group, checked, title, words).encode()
    if not (out / "overrides.csv").exists():
        files["overrides.csv"] = HEAD
    written = []
    for name, data in files.items():
        write(out / name, data)
        written.append(out / name)
    names = file_names([work.work.student for work in checked])
    for number, data_of in enumerate(_pages(checked, keys, marks, lang)):
        for ending, data in data_of.items():
            path = out / "pages" / f"{names[number]}.{ending}"
            write(path, data)
            written.append(path)
        done(1)
    return written


def _pages(
    checked: Sequence[CheckedWork], keys: Mapping[str | None, Key], marks: Sequence[str], lang: str
) -> Iterator[dict[str, bytes]]:
    words = language(lang)
    solutions: dict[str | None, Solution | KindProblem] = {}
    for work, mark in zip(checked, marks, strict=True):
        key = keys.get(work.variant)
        if key is None:  # of a variant that the problem has not: the tables tell it
            yield {}
            continue
        if work.variant not in solutions:
            problem = key.problem
            found = Solution(problem) if isinstance(problem, Problem) else problem
            solutions[work.variant] = found
        solved = solutions[work.variant]
        page = student_page(
            work, solved, words, scales=key.scales, mark=mark, hidden=tuple(key.hidden)
        )
        yield {
            "html": student_html(page, solved, words).encode(),
            "pdf": student_pdf(page, solved, words),
        }
