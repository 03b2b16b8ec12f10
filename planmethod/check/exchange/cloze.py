"""Questions with embedded answers as Moodle reads them (вопросы со встроенными ответами, Cloze).

The grammar is that of Moodle's ``qtype_multianswer``: ``{7:NUMERICAL:=2.24:0.11~%70%2.24:0.18#…}``.
Margins are absolute, the first alternative whose interval holds the answer counts.
"""

from __future__ import annotations

import html
import math
from base64 import b64encode
from collections.abc import Iterable, Iterator, Mapping
from xml.etree.ElementTree import Element, tostring

from msgspec import Struct

from planmethod.check.exchange.quiz import QuizPart, integer_points
from planmethod.check.model import KeyEntry
from planmethod.check.pages.answer_format import AnswerFormatter
from planmethod.check.pages.keypage import format_scales
from planmethod.note.document import GivenFact
from planmethod.note.formula import escape
from planmethod.note.wording import Language, MessageTable
from planmethod.note.writers.html import markup, without_control_characters

PICTURE = "scheme.png"


class QuizQuestion(Struct, frozen=True):
    """One variant as a question of a learning management system (вопрос варианта).

    Attributes
    ----------
    title : str
        Of the problem, plain text: also the category.
    variant : str or None
    given_facts : tuple of GivenFact
        What is given.
    scales : mapping of str to float
        Scales of the plans, unit per mm; empty if no plans are drawn.
    parts : tuple of QuizPart
    picture : bytes
        The scheme as PNG; empty if there is none.
    """

    title: str
    variant: str | None
    given_facts: tuple[GivenFact, ...]
    scales: Mapping[str, float]
    parts: tuple[QuizPart, ...]
    picture: bytes = b""

    def name(self, language: Language) -> str:
        """Return how the question is called in the bank."""
        texts: MessageTable = language.check["key"]
        return (
            f"{self.title}. {texts.variant.format(variant=self.variant)}"
            if self.variant
            else self.title
        )


def moodle_xml(questions: Iterable[QuizQuestion], language: Language) -> bytes:
    """Return a file for Moodle: a question for each variant, a category for each problem."""
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', "<quiz>"]
    category = None
    for question in questions:
        if question.title != category:
            category = question.title
            path = html.escape(
                without_control_characters(f"$course$/top/{category.replace('/', '//')}")
            )
            lines += [
                '<question type="category">',
                f"<category><text>{path}</text></category>",
                "</question>",
            ]
        lines += _question(question, language)
    return "\n".join([*lines, "</quiz>", ""]).encode()


def _question(question: QuizQuestion, language: Language) -> Iterator[str]:
    text = "\n".join(_text(question, language))
    yield '<question type="cloze">'
    name = html.escape(without_control_characters(question.name(language)))
    yield f"<name><text>{name}</text></name>"
    yield '<questiontext format="html">'
    yield f"<text>{_cdata(text)}</text>"
    if question.picture:
        data = b64encode(question.picture).decode()
        yield _element("file", data, name=PICTURE, path="/", encoding="base64")
    yield "</questiontext>"
    yield '<generalfeedback format="html"><text></text></generalfeedback>'
    yield "<penalty>0.3333333</penalty>"
    yield "<hidden>0</hidden>"
    yield "</question>"


def _element(tag: str, text: str | None = None, **attributes: str) -> str:
    made = Element(tag, attributes)
    made.text = text
    return tostring(made, encoding="unicode")


def _cdata(text: str) -> str:
    return f"<![CDATA[{text.replace(']]>', ']]]]><![CDATA[>')}]]>"


def _text(question: QuizQuestion, language: Language) -> Iterator[str]:
    """Yield the question as HTML with its gaps."""
    texts: MessageTable = language.check["exchange"]
    yield _paragraph(f"<strong>{_safe(markup(escape(question.name(language))))}</strong>")
    if question.given_facts:
        text = "; ".join(fact.text for fact in question.given_facts if fact.text)
        given = language.note.given.format(given=text)
        yield _paragraph(_safe(markup(given)))
    if question.picture:
        yield _paragraph(_element("img", src=f"@@PLUGINFILE@@/{PICTURE}", alt=texts.scheme))
    if question.scales:
        text = language.check["key"].scales.format(scales=format_scales(question.scales, language))
        yield _paragraph(_safe(markup(text)))
    several = len({part.entry.position for part in question.parts}) > 1
    asked: KeyEntry | None = None
    line = ""
    for part, points in zip(question.parts, integer_points(question.parts), strict=True):
        if part.entry is not asked and line:
            yield _paragraph(line)
        if several and (asked is None or part.entry.position != asked.position):
            position = language.check["key"].position.format(position=part.entry.position)
            yield _paragraph(f"<em>{_safe(markup(position))}</em>")
        if part.entry is not asked:
            line = _safe(markup(AnswerFormatter(language).letters(part.entry)))
            line += "" if part.choices else " ="
        asked = part.entry
        line += f" {gap(part, points)}"
        unit = AnswerFormatter(language).unit(part.entry)
        if part.alternatives and unit:
            line += f" {_safe(markup(unit))}"
    if line:
        yield _paragraph(line)
    yield _paragraph(_safe(markup(texts.how)))


def gap(part: QuizPart, points: int) -> str:
    """Return the gap of a part in the grammar of embedded answers."""
    if part.choices:
        told = (
            ("=" if one.right else "") + escaped(one.text) + _feedback(one.feedback)
            for one in part.choices
        )
        return f"{{{points}:MULTICHOICE:{'~'.join(told)}}}"
    told = (
        f"{_format_fraction(one.fraction)}{numbers(one.value, one.margin)}{_feedback(one.feedback)}"
        for one in part.alternatives
    )
    return f"{{{points}:NUMERICAL:{'~'.join(told)}}}"


def _format_fraction(fraction: float) -> str:
    return "=" if fraction == 1.0 else f"%{100.0 * fraction:.5g}%"


def numbers(value: float, margin: float) -> str:
    """Return a number and its margin; rounding changes the margin by at most a thousandth."""
    places = max(0, 3 - math.floor(math.log10(margin))) if margin > 0 else 12
    return f"{_decimal(value, places)}:{_decimal(margin, places + 1)}"


def _decimal(value: float, places: int) -> str:
    text = f"{value:.{places}f}"
    text = text.rstrip("0").rstrip(".") if "." in text else text
    return "0" if text in ("-0", "") else text


def _feedback(rich: str) -> str:
    return f"#{escaped(markup(rich))}" if rich else ""


def escaped(text: str) -> str:
    r"""Return HTML inside a gap: Moodle takes away entities once, then ``\}`` and ``\#``.

    It leaves ``\~`` as it is, so a tilde is replaced by a similar sign.
    """
    text = html.escape(text, quote=False).replace("\\", "&#92;").replace("~", "\N{TILDE OPERATOR}")
    return text.replace("}", "\\}").replace("#", "\\#").replace("&\\#92;", "&#92;")


def _safe(text: str) -> str:
    """Return HTML outside the gaps: escaped so that foreign text cannot open a gap."""
    return text.replace("{", "&#123;").replace("}", "&#125;")


def _paragraph(text: str) -> str:
    return f"<p>{text}</p>"
