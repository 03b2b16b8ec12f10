"""Files of the explanatory note (файлы записки)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from msgspec import Struct
from msgspec.structs import replace

from planmethod.note.wording import get_language
from planmethod.note.writers.lowering import lower
from planmethod.note.writers.pdfnote import pdf_note
from planmethod.note.writers.word import word_document
from planmethod.note.writers.wordframe import fields_of_note
from planmethod.paper import FRAME_OTHER, paper_format
from planmethod.project.report import note_document
from planmethod.project.settle import Homework, Project, SheetEntry
from planmethod.render.backends.view import DrawingView
from planmethod.render.frame import FORM_2, FORM_2A, merged, rectangle, title_block
from planmethod.render.ink.drawing import Drawing, Pen, shifted
from planmethod.render.ink.pens import PenSet, using_pens

FORMATS = ("docx", "pdf")
"""Formats of a note."""


class NoteOptions(Struct, frozen=True):
    """Options of the note (оформление записки).

    Attributes
    ----------
    fields : mapping
        Texts of the title block that outrank the file's.
    template : Path or None
        Word file whose page and styles are used.
    frame : bool
        Frames and title blocks of forms 2 and 2a on the pages after the title page.
    """

    fields: Mapping[str, str] = {}
    template: Path | None = None
    frame: bool = False


def note_files(
    project: Project | Homework,
    basename: str,
    options: NoteOptions,
    formats: Sequence[str] = FORMATS,
    sheets: Sequence[SheetEntry] = (),
) -> dict[str, bytes]:
    """Return the files of the note by their names.

    Parameters
    ----------
    sheets : sequence of SheetEntry
        The sheets that it lists. Default: it lists the parts.

    Raises
    ------
    OutputError
        The template cannot be read.
    """
    language = get_language(project.language)
    problem = project.problem
    stamp = merged(problem.title_block, options.fields)
    title = problem.stamp_in.get(project.language, {}).get("title", problem.title)
    stamped = replace(project, problem=replace(problem, title=title, stamp=stamp, stamp_in={}))
    # Both files take the same sentences: they are divided into words and formulas once.
    with using_pens(PenSet.of(paper_format("A4"), is_coloured=bool(problem.sheet.colour))):
        written = lower(note_document(stamped, language, sheets), language)
    author = stamp.get("author", "")
    files: dict[str, bytes] = {}
    for fmt in formats:
        if fmt == "docx":
            files[f"{basename}.{fmt}"] = word_document(
                written,
                language,
                author=author,
                template=options.template,
                frame=options.frame,
                stamp=stamp,
            )
        else:
            fields = fields_of_note(stamp, written)
            forms = _FormsOfText(fields, project.language) if options.frame else None
            files[f"{basename}.{fmt}"] = pdf_note(written, language, author=author, forms=forms)
    return files


class _FormsOfText(Struct, frozen=True):
    """Frames of a text document: form 2 on its first page, form 2a on the others (GOST 2.104)."""

    fields: Mapping[str, str]
    lang: str

    @property
    def heights(self) -> tuple[float, float]:
        """Heights from the edge of the paper to above the title block, mm: first page, others."""
        return FRAME_OTHER + FORM_2.height, FRAME_OTHER + FORM_2A.height

    def view(self, page: int, pages: int, *, first: bool) -> DrawingView:
        """Return the frame of a page with its number; the first has the number of pages."""
        paper, form = paper_format("A4"), FORM_2 if first else FORM_2A
        left, low, *_ = paper.inner
        fields = {**self.fields, "sheet": str(page), "sheets": str(pages)}
        block = shifted(title_block(fields, form, lang=self.lang), complex(left, low))
        items = [rectangle(paper.inner, Pen.FRAME, "frame"), *block]
        pens = PenSet.of(paper)
        return DrawingView(Drawing(paper.width, paper.height, items=items, pens=pens))
