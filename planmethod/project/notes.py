"""Files of the explanatory note (файлы записки)."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.note.plaintext import plain_text
from planmethod.note.wording import language
from planmethod.note.writers.pdf import pdf_document
from planmethod.project.model import Project
from planmethod.project.report import note_document
from planmethod.render.backends.pdf import registered
from planmethod.render.ink.lettering import lettering

FORMATS = ("docx", "pdf")
"""Formats of a note."""

LETTERING = "A-upright"
"""Type of the letters of a note in PDF."""


def note_files(project: Project, stem: str, formats: Sequence[str] = FORMATS) -> dict[str, bytes]:
    """Return the files of the note by their names."""
    words = language(project.language)
    written = note_document(project, words)
    title = plain_text(project.problem.title or project.problem.name)
    files: dict[str, bytes] = {}
    for fmt in formats:
        if fmt == "pdf":
            font = registered(lettering(LETTERING))
            files[f"{stem}.{fmt}"] = pdf_document(written, title=title, font=font)
    return files
