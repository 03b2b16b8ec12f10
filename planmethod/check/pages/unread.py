"""What of works could not be read (не разобрано): a line each, for a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from planmethod.check.model import Checked, Unread, Verdict
from planmethod.check.pages.speech import Speech
from planmethod.languages import say
from planmethod.note.wording.language import Language

ASIDE = (Unread.COLUMN, Unread.KEY)
"""What is told of, but loses no answer: a column or a key that nobody knows."""


def unread_lines(checked: Sequence[Checked], words: Language) -> Iterator[tuple[str, bool]]:
    """Yield what could not be read, and whether an answer is lost by it."""
    speech = Speech(words)
    for one in checked:
        for judged in one.answers:
            if judged.verdict is not Verdict.UNREADABLE:
                continue
            reason = say("no quantity {!r} that the problem has", judged.id)
            if judged.written is not None and judged.written.unreadable:
                reason = speech.unread(judged.written)
            yield say("Unreadable: {}: {}", judged.where or judged.id, reason), True
    for one in checked:
        for remark in one.work.remarks:
            aside = remark.why in ASIDE
            told = "Not read: {}: {}" if aside else "Unreadable: {}: {}"
            yield say(told, remark.where, speech.unread(remark)), not aside
