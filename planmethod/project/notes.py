"""Files of the explanatory note (файлы записки)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from msgspec import Struct
from msgspec.structs import replace

from planmethod.note.wording import language
from planmethod.note.writers.pdfnote import pdf_note
from planmethod.note.writers.word import word_document
from planmethod.project.model import Project, SheetEntry
from planmethod.project.report import note_document
from planmethod.render.frame.titleblock import merged

FORMATS = ("docx", "pdf")
"""Formats of a note."""


class NoteOptions(Struct, frozen=True):
    """What is asked of the note (оформление записки).

    Attributes
    ----------
    fields : mapping
        Texts of the title block that outrank the file's.
    template : Path or None
        File of Word whose page and styles are taken.
    frame : bool
        Frames and title blocks of forms 2 and 2a on the pages of Word.
    """

    fields: Mapping[str, str] = {}
    template: Path | None = None
    frame: bool = False


def note_files(
    project: Project,
    stem: str,
    options: NoteOptions,
    formats: Sequence[str] = FORMATS,
    sheets: Sequence[SheetEntry] = (),
) -> dict[str, bytes]:
    """Return the files of the note by their names.

    Parameters
    ----------
    sheets : sequence of SheetEntry
        The sheets that it lists; without them it lists the parts.

    Raises
    ------
    OutputError
        The template cannot be read.
    """
    words = language(project.language)
    problem = project.problem
    stamp = merged(problem.title_block, options.fields)
    title = problem.stamp_in.get(project.language, {}).get("title", problem.title)
    stamped = replace(project, problem=replace(problem, title=title, stamp=stamp, stamp_in={}))
    written, author = note_document(stamped, words, sheets), stamp.get("author", "")
    files: dict[str, bytes] = {}
    for fmt in formats:
        if fmt == "docx":
            files[f"{stem}.{fmt}"] = word_document(
                written,
                words,
                author=author,
                template=options.template,
                frame=options.frame,
                stamp=stamp,
            )
        else:
            files[f"{stem}.{fmt}"] = pdf_note(written, words, author=author)
    return files
