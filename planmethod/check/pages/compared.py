"""A student's numbers next to the exact ones, and unreadable entries (сравнение ответов)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from planmethod.check.model import GradedAnswer, GradedSubmission, Unread, Verdict
from planmethod.check.pages.answer_format import AnswerFormatter, displayed_value, quoted
from planmethod.languages import translate
from planmethod.note.compared import DASH, ComparedNumber
from planmethod.note.document import Caption, Document, Node, Paragraph, table_of
from planmethod.note.numbers import trimmed
from planmethod.note.wording import Language, MessageTable

_FAINT = 1e-6
"""Fraction of a difference below which an exact value is zero: no percentage is shown."""


def compared_document(checked: Sequence[GradedSubmission], language: Language) -> Document:
    """Return tables, one for each submission: student's value, exact value, difference."""
    return Document.of(_nodes(checked, language))


def _nodes(checked: Sequence[GradedSubmission], language: Language) -> Iterator[Node]:
    speech = AnswerFormatter(language)
    texts: MessageTable = language.check["compared"]
    for one in checked:
        name = " ".join(filter(None, (quoted(one.work.student), one.variant)))
        if name:
            yield Caption(name)
        written = (judged for judged in one.answers if judged.written is not None)
        yield table_of(texts["columns"], (list(_cells(judged, speech)) for judged in written))
    yield Paragraph(texts.note)


def _cells(answer: GradedAnswer, formatter: AnswerFormatter) -> Iterator[str]:
    key, value = answer.key, answer.value
    yield formatter.symbol(answer)
    yield formatter.student_value(answer) or DASH
    if key is None:
        yield from (DASH, DASH, DASH)
        return
    yield formatter.si(displayed_value(key.exact, key), key)
    if value is None:
        yield from (DASH, DASH)
        return
    one = ComparedNumber(displayed_value(key.exact, key), displayed_value(value, key))
    percent = replace(one, zero_limit=_FAINT * abs(one.off)).percent
    number = formatter.language.notation.number
    yield formatter.with_unit(number(trimmed(one.off / key.per, 2)), key)
    yield DASH if percent is None else number(trimmed(percent, 2))


LOSSLESS = (Unread.COLUMN, Unread.KEY, Unread.VERTEX, Unread.OPEN, Unread.TURNED)
"""Reported faults that do not cost an answer: an unknown column, a vertex without a letter."""


def unread_lines(
    checked: Sequence[GradedSubmission], language: Language
) -> Iterator[tuple[str, bool]]:
    """Yield what could not be read, and whether an answer is lost by it."""
    speech = AnswerFormatter(language)
    for one in checked:
        if one.failure is not None:
            more = translate(" Its trace is in run.json.") if one.failure.trace else ""
            yield (
                translate("Not marked: {}: {}.{}", one.work.student, one.failure.message, more),
                True,
            )
        for judged in one.answers:
            if judged.verdict is not Verdict.UNREADABLE:
                continue
            reason = translate("the problem has no quantity {!r}", judged.id)
            if judged.written is not None and judged.written.unreadable:
                reason = speech.unread(judged.written)
            yield translate("Unreadable: {}: {}", judged.location or judged.id, reason), True
    for one in checked:
        for remark in one.work.remarks:
            aside = remark.reason in LOSSLESS
            text = "Not read: {}: {}" if aside else "Unreadable: {}: {}"
            yield translate(text, remark.location, speech.unread(remark)), not aside
