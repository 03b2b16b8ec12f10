"""Questions and answers as documents (листы вопросов и ответов)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import assert_never

from planmethod.defence.case import Case
from planmethod.defence.model import (
    Answer,
    ChoiceAnswer,
    NumberAnswer,
    Place,
    Question,
    Subject,
    TextAnswer,
)
from planmethod.note.document import Chapter, Document, Item, Node, Paragraph, Title
from planmethod.note.formula import Rich, escape
from planmethod.note.numbers import significant
from planmethod.note.wording import Language, MessageTable


def questions_document(questions: Sequence[Question], case: Case) -> Document:
    """Return the questions without their answers."""
    return Document.of(_nodes(questions, case, answered=False))


def answers_document(questions: Sequence[Question], case: Case) -> Document:
    """Return the answers with the questions, their reasons and places."""
    return Document.of(_nodes(questions, case, answered=True))


def _nodes(questions: Sequence[Question], case: Case, *, answered: bool) -> Iterator[Node]:
    language, texts, problem = case.language, case.texts, case.work.problem
    yield Title(texts.answers_title if answered else texts.title)
    yield Paragraph(_of_work(len(questions), problem.title or problem.name, texts))
    sheets = (
        texts.sheet.format(number=one.number, title=escape(one.drawing.title))
        for one in case.sheets.sheets
    )
    yield Paragraph(texts.sheets.format(sheets="; ".join(sheets)))
    yield Paragraph(texts.zones)
    if answered:
        yield Paragraph(texts.tolerances)
    subject: Subject | None = None
    for number, one in enumerate(questions, 1):
        if one.subject is not subject:
            subject = one.subject
            yield Chapter(texts["subjects"][subject.value], numbered=False)
        yield Item(one.text, f"{number}.")
        place = texts.place_label.format(place=place_text(one.place, language))
        if answered:
            right = texts.right.format(answer=answer_text(one.answer, language))
            yield Paragraph(f"{right} {one.reason} {place}")
            continue
        yield from _options(one.answer, texts)
        form = form_text(one.answer, texts)
        yield Paragraph(f"{form} {place}" if form else place)


def _of_work(count: int, title: str, texts: MessageTable) -> Rich:
    one, few, many = texts["questions"]
    last, teens = count % 10, 10 < count % 100 < 20
    form = many if teens or last == 0 or last > 4 else one if last == 1 else few
    return texts.of_work.format(title=escape(title), count=count, questions=form)


def _options(answer: Answer, texts: MessageTable) -> Iterator[Node]:
    """Yield the options of a choice."""
    if isinstance(answer, ChoiceAnswer):
        for letter, text in zip(texts["answer_letters"], answer.options.values(), strict=False):
            yield Item(text, f"{letter})")


def form_text(answer: Answer, texts: MessageTable) -> Rich:
    """Return the sentence on the kind of answer that is expected; empty of a choice."""
    match answer:
        case NumberAnswer(unit=unit):
            told = texts.in_unit.format(unit=unit) if unit else ""
            return texts.number_label.format(unit=told)
        case TextAnswer():
            return texts.text_label
        case ChoiceAnswer():
            return ""
        case _:
            assert_never(answer)


def answer_text(answer: Answer, language: Language) -> Rich:
    """Return an answer as rich text: a number with its tolerance, an option with its letter."""
    texts, notation = language.defence, language.notation
    match answer:
        case NumberAnswer(value, tolerance, unit):
            told = "" if not unit else unit if unit == "°" else f" {unit}"
            if not tolerance:
                return texts.exact.format(value=notation.as_input(value), unit=told)
            return texts.within.format(
                value=notation.computed(value),
                tolerance=notation.number(significant(tolerance, 2)),
                unit=told,
            )
        case TextAnswer(text):
            return text
        case ChoiceAnswer(right, options):
            letter = texts["answer_letters"][list(options).index(right)]
            return texts.lettered.format(letter=letter, text=options[right])
        case _:
            assert_never(answer)


def place_text(place: Place, language: Language) -> Rich:
    """Return a place in words: the sheet, the view, the zone, millimetres of an inscription."""
    texts = language.defence
    view = texts.place_view.format(view=place.view) if place.view else ""
    told = texts.place.format(sheet=place.sheet, view=view, zone=place.zone)
    if place.mark:
        told += texts.place_at.format(x=round(place.at.real), y=round(place.at.imag))
    return told
