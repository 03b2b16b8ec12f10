"""Numbers alone as GIFT, which many learning management systems read (вопросы в GIFT)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from planmethod.check.exchange.cloze import QuizQuestion, numbers
from planmethod.check.exchange.quiz import QuizPart
from planmethod.check.pages.answer_format import AnswerFormatter
from planmethod.note.plaintext import plain_text
from planmethod.note.wording import Language
from planmethod.note.writers.html import without_control_characters


def gift(questions: Iterable[QuizQuestion], language: Language) -> bytes:
    """Return numbers alone as GIFT, which many systems read: a question for each of them."""
    lines = []
    category = None
    for question in questions:
        if question.title != category:
            category = question.title
            lines += [f"$CATEGORY: $course$/top/{category.replace('/', '//')}", ""]
        for part in question.parts:
            if part.alternatives:
                lines += [*_gift_question(question, part, language), ""]
    return "\n".join(lines).encode()


def _gift_question(question: QuizQuestion, part: QuizPart, language: Language) -> Iterator[str]:
    speech = AnswerFormatter(language)
    entry = part.entry
    letters = plain_text(speech.letters(entry))
    unit = plain_text(speech.unit(entry))
    asked = f"{letters}, {unit}" if unit else letters
    given = plain_text("; ".join(fact.text for fact in question.given_facts if fact.text))
    position = language.check["key"].position.format(position=entry.position)
    name = ", ".join(
        filter(None, (question.name(language), position if entry.position else "", letters))
    )
    text = " ".join(
        filter(None, (question.name(language) + ".", given and f"{given}.", f"{asked} = ?"))
    )
    yield f"::{_gift(name)}::[plain]{_gift(text)} {{#"
    for one in part.alternatives:
        share = "=" if one.fraction == 1.0 else f"=%{100.0 * one.fraction:.5g}%"
        phrase = f"#{_gift(plain_text(one.feedback))}" if one.feedback else ""
        yield f"\t{share}{numbers(one.value, one.margin)}{phrase}"
    yield "}"


def _gift(text: str) -> str:
    """Return a text of GIFT in one line."""
    flat = " ".join(without_control_characters(text).split())
    return "".join(f"\\{c}" if c in "\\~=#{}:" else c for c in flat)
