"""All files of a checked group, each whole or not at all (файлы проверки)."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from planmethod.check.key import Key
from planmethod.check.marks import Settings
from planmethod.check.model import Checked
from planmethod.check.pages.htmlpage import html_page
from planmethod.check.pages.listing import csv_bytes
from planmethod.check.pages.overrides import HEAD
from planmethod.check.pages.pdfpage import pdf_page
from planmethod.check.pages.results import results_xlsx
from planmethod.check.pages.run import run_json, run_record, settings_rows
from planmethod.check.pages.student import student_page
from planmethod.note.wording import language
from planmethod.pattern import pattern
from planmethod.problem.head import KindProblem
from planmethod.problem.model import Problem
from planmethod.render.backends.output import write
from planmethod.solved.solution import Solution

LONGEST = 40
"""Letters of a file's name: with four bytes each and its ending it is short enough anywhere."""

_RESERVED = pattern(r"(con|prn|aux|nul|com\d|lpt\d)(\.|$)", re.IGNORECASE)


def file_names(students: Sequence[str]) -> list[str]:
    """Return a name for the files of each student: safe on every system, no two alike."""
    taken: set[str] = set()
    names = []
    for student in students:
        plain = re.sub(r"[^\w.-]+", "-", unicodedata.normalize("NFC", student))[:LONGEST]
        plain = plain.strip("-. ") or "student"
        plain = f"_{plain}" if _RESERVED.match(plain) else plain
        name, copy = plain, 2
        while name.casefold() in taken:
            name, copy = f"{plain}-{copy}", copy + 1
        taken.add(name.casefold())
        names.append(name)
    return names


def write_all(
    out: Path,
    checked: Sequence[Checked],
    keys: Mapping[str | None, Key],
    settings: Settings,
    inputs: Sequence[Path],
    lang: str,
    *,
    done: Callable[[int], None] = lambda works: None,
) -> list[Path]:
    """Write the tables of a group and a page for each student.

    Parameters
    ----------
    out : Path
        Folder of the files; the pages go to ``pages`` in it.
    checked : sequence of Checked
        With the overrides, and with the names hidden if they shall be.
    keys : mapping
        By the variant of a work; a work without a key has no page.
    inputs : sequence of Path
        Files that the marks came from.
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
    run = run_record(settings, inputs, lang, len(checked))
    marks = [settings.mark(work.points / work.of) if work.of else "" for work in checked]
    words = language(lang)
    files = {
        "results.xlsx": results_xlsx(checked, words, marks=marks, settings=settings_rows(run)),
        "results.csv": csv_bytes(checked),
        "run.json": run_json(run),
    }
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
    checked: Sequence[Checked], keys: Mapping[str | None, Key], marks: Sequence[str], lang: str
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
        page = student_page(work, solved, words, scales=key.scales, mark=mark)
        yield {
            "html": html_page(page, solved, words).encode(),
            "pdf": pdf_page(page, words),
        }
