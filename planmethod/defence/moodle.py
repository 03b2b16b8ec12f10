"""Questions as a question bank of Moodle: numbers, choices, short answers (банк вопросов)."""

# no messages: XML

from __future__ import annotations

import html
from collections.abc import Iterator, Sequence
from itertools import permutations
from typing import assert_never

from planmethod.check.exchange.quiz import category_lines, cdata, numbers
from planmethod.defence.document import form_text, place_text
from planmethod.defence.model import (
    Answer,
    ChoiceAnswer,
    NumberAnswer,
    Question,
    TextAnswer,
)
from planmethod.defence.places import letters_of
from planmethod.note.document import plain_text
from planmethod.note.formula import Rich
from planmethod.note.wording import Language
from planmethod.note.writers.formulas import without_control_characters
from planmethod.note.writers.html import markup

MOST_PARTS = 4
"""Most parts of a short answer that are accepted in any order."""

SMALLEST = 1e-9
"""Tolerance of a whole number, which Moodle needs."""

Lines = Iterator[str]


def moodle_bank(questions: Sequence[Question], title: str, language: Language) -> bytes:
    """Return a file for Moodle: the questions in one category, named by their work.

    A number has its tolerance, a choice its options with one right of them; a short answer is
    accepted with its parts in any order.
    """
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', "<quiz>", *category_lines(title)]
    for number, one in enumerate(questions, 1):
        lines += _question(number, one, language)
    return "\n".join([*lines, "</quiz>", ""]).encode()


def _question(number: int, question: Question, language: Language) -> Lines:
    texts = language.defence
    kinds = {NumberAnswer: "numerical", ChoiceAnswer: "multichoice", TextAnswer: "shortanswer"}
    subject = texts["subjects"][question.subject.value]
    name = html.escape(without_control_characters(f"{number:03} {plain_text(subject)}"))
    place = texts.place_label.format(place=place_text(question.place, language))
    lines = [question.text, place]
    answer = question.answer
    if form := form_text(answer, texts):
        lines.insert(1, form)
    yield f'<question type="{kinds[type(answer)]}">'
    yield f"<name><text>{name}</text></name>"
    yield from _rich("questiontext", *lines)
    yield from _rich("generalfeedback", question.reason)
    yield "<defaultgrade>1</defaultgrade>"
    yield "<penalty>0.3333333</penalty>"
    yield "<hidden>0</hidden>"
    yield from _answers(answer)
    yield "</question>"


def _answers(answer: Answer) -> Lines:
    match answer:
        case NumberAnswer(value, tolerance):
            text, _, margin = numbers(value, tolerance or SMALLEST).partition(":")
            yield '<answer fraction="100" format="moodle_auto_format">'
            yield f"<text>{text}</text>"
            yield f"<tolerance>{margin}</tolerance>"
            yield "</answer>"
        case ChoiceAnswer(right, options):
            yield "<single>true</single>"
            yield "<shuffleanswers>true</shuffleanswers>"
            yield "<answernumbering>abc</answernumbering>"
            for key, option in options.items():
                yield f'<answer fraction="{100 if key == right else 0}" format="html">'
                yield f"<text>{cdata(markup(option))}</text>"
                yield "</answer>"
        case TextAnswer(text):
            yield "<usecase>0</usecase>"
            for one in accepted(text):
                yield '<answer fraction="100" format="moodle_auto_format">'
                yield f"<text>{html.escape(one)}</text>"
                yield "</answer>"
        case _:
            assert_never(answer)


def accepted(text: Rich) -> list[str]:
    """Return the spellings of a short answer: its parts in any order, indices on the line."""
    parts = letters_of(text).split(", ")
    orders = permutations(parts) if len(parts) <= MOST_PARTS else [tuple(parts)]
    found = [", ".join(order) for order in orders]
    return list(dict.fromkeys([*found, *(one.replace("–", "-") for one in found)]))


def _rich(tag: str, *texts: Rich) -> Lines:
    yield f'<{tag} format="html">'
    inside = "\n".join(f"<p>{markup(text)}</p>" for text in texts)
    yield f"<text>{cdata(inside)}</text>"
    yield f"</{tag}>"
