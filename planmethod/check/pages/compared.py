"""A student's numbers next to the exact ones, and unreadable entries (сравнение ответов)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from planmethod.check.model import CheckedWork, Judged, Unread, Verdict
from planmethod.check.pages.speech import Speech, quoted, told
from planmethod.languages import say
from planmethod.note.compared import NONE, ComparedNumber
from planmethod.note.document import Caption, Document, Node, Paragraph, table_of
from planmethod.note.numbers import trimmed
from planmethod.note.wording import Language, Words

_FAINT = 1e-6
"""Fraction of a difference below which an exact value is zero: no percentage is shown."""


def compared_document(checked: Sequence[CheckedWork], words: Language) -> Document:
    """Return tables, one for each submission: student's value, exact value, difference."""
    return Document.of(_nodes(checked, words))


def _nodes(checked: Sequence[CheckedWork], words: Language) -> Iterator[Node]:
    speech = Speech(words)
    say: Words = words.check["compared"]
    for one in checked:
        name = " ".join(filter(None, (quoted(one.work.student), one.variant)))
        if name:
            yield Caption(name)
        written = (judged for judged in one.answers if judged.written is not None)
        yield table_of(say["columns"], (list(_cells(judged, speech)) for judged in written))
    yield Paragraph(say.note)


def _cells(judged: Judged, speech: Speech) -> Iterator[str]:
    key, value = judged.key, judged.value
    yield speech.symbol(judged)
    yield speech.own(judged) or NONE
    if key is None:
        yield from (NONE, NONE, NONE)
        return
    yield speech.si(told(key.exact, key), key)
    if value is None:
        yield from (NONE, NONE)
        return
    one = ComparedNumber(told(key.exact, key), told(value, key))
    percent = replace(one, nothing=_FAINT * abs(one.off)).percent
    number = speech.words.say.number
    yield speech.with_unit(number(trimmed(one.off / key.per, 2)), key)
    yield NONE if percent is None else number(trimmed(percent, 2))


ASIDE = (Unread.COLUMN, Unread.KEY, Unread.VERTEX, Unread.OPEN, Unread.TURNED)
"""Reported faults that do not cost an answer: an unknown column, a vertex without a letter."""


def unread_lines(checked: Sequence[CheckedWork], words: Language) -> Iterator[tuple[str, bool]]:
    """Yield what could not be read, and whether an answer is lost by it."""
    speech = Speech(words)
    for one in checked:
        if one.failure is not None:
            more = say(" Its trace is in run.json.") if one.failure.trace else ""
            yield say("Not marked: {}: {}.{}", one.work.student, one.failure.said, more), True
        for judged in one.answers:
            if judged.verdict is not Verdict.UNREADABLE:
                continue
            reason = say("the problem has no quantity {!r}", judged.id)
            if judged.written is not None and judged.written.unreadable:
                reason = speech.unread(judged.written)
            yield say("Unreadable: {}: {}", judged.where or judged.id, reason), True
    for one in checked:
        for remark in one.work.remarks:
            aside = remark.why in ASIDE
            told = "Not read: {}: {}" if aside else "Unreadable: {}: {}"
            yield say(told, remark.where, speech.unread(remark)), not aside
