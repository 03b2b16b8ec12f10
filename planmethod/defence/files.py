"""Files of a pack: questions and answers as documents, the bank of Moodle (файлы вопросов)."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.defence.case import Case
from planmethod.defence.document import answers_document, questions_document
from planmethod.defence.model import Question
from planmethod.defence.moodle import moodle_bank
from planmethod.note.document import Document
from planmethod.note.wording import Language
from planmethod.note.writers.lowering import lower
from planmethod.note.writers.markdown import markdown_document
from planmethod.note.writers.pdfnote import pdf_note
from planmethod.note.writers.word import word_document


def defence_files(
    questions: Sequence[Question],
    case: Case,
    basename: str,
    formats: Sequence[str],
    *,
    moodle: bool = False,
) -> dict[str, bytes]:
    """Return the files of a pack by their names: questions, answers, the bank.

    Parameters
    ----------
    formats : sequence of str
        Of ``docx``, ``pdf``, ``md``.
    """
    problem, language = case.work.problem, case.language
    title = problem.title or problem.name
    author = problem.title_block.get("author", "")
    documents = {
        basename: questions_document(questions, case),
        f"{basename}-answers": answers_document(questions, case),
    }
    files: dict[str, bytes] = {}
    for name, document in documents.items():
        for fmt in formats:
            files[f"{name}.{fmt}"] = _written(document, fmt, author, language)
    if moodle:
        files[f"{basename}.xml"] = moodle_bank(questions, title, language)
    return files


def _written(document: Document, fmt: str, author: str, language: Language) -> bytes:
    """Return a document in a format."""
    if fmt == "md":
        return (markdown_document(document, language) + "\n").encode()
    write = word_document if fmt == "docx" else pdf_note
    return write(lower(document, language), language, author=author)
