"""Questions and accepted answers for learning management systems: Cloze, GIFT, the key as JSON."""

from __future__ import annotations

import html
import math
from base64 import b64encode
from collections.abc import Iterable, Iterator, Mapping, Sequence
from statistics import median
from typing import Any
from xml.etree.ElementTree import Element, tostring

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.key import Key, entry_of
from planmethod.check.model import KeyEntry, Sense
from planmethod.check.pages.keypage import format_scales
from planmethod.check.pages.remarks import AnswerFormatter, displayed_value
from planmethod.check.sheet import Sheet, is_right
from planmethod.check.task import Task, TaskItem
from planmethod.check.tolerance import Tolerance, limit_of
from planmethod.kind import ProblemKind
from planmethod.note.document import GivenFact, plain_text
from planmethod.note.formula import escape
from planmethod.note.numbers import finite_or_none, trimmed
from planmethod.note.wording import Language, MessageTable
from planmethod.note.writers.formulas import without_control_characters
from planmethod.note.writers.html import markup
from planmethod.problem.quantities import Sign
from planmethod.render.backends import Options, render

MAX_WRONG_VALUES = 12
"""Wrong values of a part that are named; the usual ones first."""

MIN_SEPARATION = 2.0
"""Tolerances within which a mistake cannot be distinguished from the right answer."""

MAX_HALF_WIDTH = 0.1
"""Share of a wrong value that half of its interval is at most."""

MIN_ERROR_FRACTION = 0.3
"""Minimum error scale of a value that a mistake makes small, relative to the right one."""

TURNS, DIRECTIONS = (Sense.CCW, Sense.CW), (Sense.UP, Sense.DOWN, Sense.LEFT, Sense.RIGHT)


class Alternative(Struct, frozen=True):
    """An interval of numbers and its fraction of the points (вариант числа).

    Attributes
    ----------
    value : float
        Value in the requested unit.
    margin : float
        Half of the interval.
    fraction : float
        Of the points, 0 to 1.
    feedback : str
        Rich text; empty for none.
    """

    value: float
    margin: float
    fraction: float = 1.0
    feedback: str = ""


class Choice(Struct, frozen=True):
    """A sense to choose from: its text, correctness and feedback (выбор)."""

    sense: Sense
    text: str
    right: bool
    feedback: str = ""


class QuizPart(Struct, frozen=True):
    """One gap to fill in: a number, or the sense of a quantity (часть вопроса).

    Attributes
    ----------
    entry : KeyEntry
    points : float
    alternatives : tuple of Alternative
        The first whose interval holds an answer counts; empty for a sense.
    choices : tuple of Choice
        Empty of a number.
    """

    entry: KeyEntry
    points: float
    alternatives: tuple[Alternative, ...] = ()
    choices: tuple[Choice, ...] = ()


def quiz_of(task: Task, language: Language) -> list[QuizPart]:
    """Return the parts of the requested items of a variant, in the requested order."""
    parts: list[QuizPart] = []
    for item in task.list_items():
        sheet = task.sheet(item.position)
        limit = limit_of(sheet, item.question, task.settings, item.fixed)
        parts += _ItemParts(task, item, sheet, limit, language).parts()
    return parts


class GapName(Struct, frozen=True):
    """Name of a gap: an item of the task, its position, and whether it is the sense (пропуск)."""

    id: str
    position: int
    sense: bool


def gaps_of(task: Task) -> list[GapName]:
    """Return what the gaps of a variant are of, in the order of `quiz_of`.

    They are the same for all variants: where a value is zero, any sense is right.
    """
    found: list[GapName] = []
    for item in task.list_items():
        share = task.settings.sense_share
        if not (item.asks_sense and share == 1.0):
            found.append(GapName(item.name, item.position, sense=False))
        if item.asks_sense and share:
            found.append(GapName(item.name, item.position, sense=True))
    return found


def integer_points(parts: Sequence[QuizPart]) -> list[int]:
    """Return the points of parts in the smallest whole numbers of the same proportion."""
    for times in (1, 2, 4, 5, 10, 20, 25, 50, 100):
        scaled = [part.points * times for part in parts]
        if all(abs(one - round(one)) < 1e-6 for one in scaled):
            break
    return [max(1, round(one)) if one > 0 else 0 for one in scaled]


class _ItemParts(Struct, frozen=True):
    """One item of a task, as its parts."""

    task: Task
    item: TaskItem
    sheet: Sheet
    limit: Tolerance
    language: Language

    def parts(self) -> Iterator[QuizPart]:
        """Yield the part of the number, and that of the sense if it is requested."""
        entry = entry_of(self.task, self.item, self.limit)
        numbers = QuizPart(entry, entry.points, tuple(self._alternatives(entry)))
        share, choices = self.task.settings.sense_share, tuple(self._choices(entry))
        if not choices or not share:
            yield numbers
            return
        if share < 1.0:
            yield replace(numbers, points=entry.points * (1.0 - share))
        yield QuizPart(entry, entry.points * share, choices=choices)

    # Numbers -----------------------------------------------------------------------------------

    def _alternatives(self, entry: KeyEntry) -> Iterator[Alternative]:
        settings, limit, per = self.task.settings, self.limit, entry.per
        right = self._right()
        margin = outer = limit.tolerance()
        yield from (Alternative(value / per, margin / per) for value in right)
        wider: tuple[float, float, str] | None = None
        if not limit.is_visible:
            wider = (limit.spread, settings.unseen_share, self.language.check["key"].unseen)
        elif not limit.zero and settings.near > 1.0 and settings.near_share:
            wider = (margin * settings.near, settings.near_share, self._near_feedback)
        if wider is not None and wider[0] > margin:
            outer, share, phrase = wider
            yield from (Alternative(value / per, outer / per, share, phrase) for value in right)
        least = max(outer, MIN_SEPARATION * margin)
        for value, room, codes in _separate_intervals(
            self._mistaken(), right, outer, least, margin, limit
        ):
            yield Alternative(value / per, room / per, 0.0, self._describe_mistakes(codes))

    @property
    def _near_feedback(self) -> str:
        texts: MessageTable = self.language.check["exchange"]
        near: str = texts.near if self.limit.sigma else texts.near_computed
        return near

    def _right(self) -> list[float]:
        """Return the right values, each with the tolerance round it, as it may be written."""
        exact, sign = self.limit.exact, self.item.question.sign
        if sign is Sign.ANGLE:
            return [exact, exact - 360.0, exact + 360.0]
        found = [exact if sign is Sign.STRICT else abs(exact)]
        if sign is Sign.TURN and (self.item.asks_sense or exact < 0):
            found.append(-abs(exact))
        if self.limit.zero and exact:
            found.insert(0, 0.0)
        return found

    def _mistaken(self) -> Iterator[tuple[str, float]]:
        """Yield codes of mistakes and what each gives, the usual ones first."""
        strict = self.item.question.sign in (Sign.STRICT, Sign.ANGLE)
        named = sorted(self.task.named(self.sheet), key=lambda one: -one.prior)
        for one in named:
            value = one.values[self.item.question.id]
            if math.isfinite(value):
                yield one.code, value if strict else abs(value)

    def _describe_mistakes(self, codes: Sequence[str]) -> str:
        """Return the feedback for a value that mistakes give."""
        say, mistakes = self.language.check["student"], self.language.check["mistakes"]
        known = [mistakes[code] for code in codes if code in mistakes]
        if not known:
            return ""
        if len(known) > 1:
            names = "; ".join(one.name for one in known)
            phrase: str = say.one_of.format(names=names)
            return phrase
        text: str = say.mistake.format(value="", so=known[0].so, where="", advice=known[0].advice)
        return text

    # Senses ------------------------------------------------------------------------------------

    def _choices(self, entry: KeyEntry) -> Iterator[Choice]:
        question, exact = self.item.question, self.limit.exact
        if not self.item.asks_sense:
            return
        turns, none = question.sign is Sign.TURN, self.limit.zero or not exact
        for sense in TURNS if turns else DIRECTIONS:
            if none:
                right = True
            elif turns:
                right = (exact > 0) is (sense is Sense.CCW)
            elif (told := is_right(self.sheet, question, sense)) is not None:
                right = told
            else:
                right = entry.sense is not None  # it cannot be proved wrong
            sign, name = self.language.check["senses"][sense.value]
            turned = "" if right or not turns else self._describe_mistakes(self._reversing())
            yield Choice(sense, f"{sign} {name}", right, turned)

    def _reversing(self) -> list[str]:
        """Return the mistakes that turn the sense alone."""
        exact, slack = self.limit.exact, self.limit.tolerance()
        named = (
            (one.code, one.values[self.item.question.id]) for one in self.task.named(self.sheet)
        )
        codes = [code for code, value in named if abs(value + exact) <= slack]
        return list(dict.fromkeys(codes)) or ["sign"]


def _separate_intervals(
    mistaken: Iterable[tuple[str, float]],
    right: Sequence[float],
    outer: float,
    min_distance: float,
    margin: float,
    limit: Tolerance,
) -> Iterator[tuple[float, float, list[str]]]:
    """Yield wrong values with half of their intervals, which do not meet, and their mistakes.

    Values that are nearer to each other than the tolerance are one, with several mistakes.
    """
    found: list[tuple[float, float, list[str]]] = []
    for code, value in mistaken:
        if min(abs(value - one) for one in right) <= min_distance:
            continue
        share = max(abs(value / limit.exact), MIN_ERROR_FRACTION) if limit.exact else 1.0
        room = min(margin * share, MAX_HALF_WIDTH * abs(value) or margin)
        same = next((one for one in found if abs(one[0] - value) <= max(room, one[1])), None)
        if same is None:
            found.append((value, room, [code]))
        elif code not in same[2]:
            same[2].append(code)
    found = found[:MAX_WRONG_VALUES]
    for number, (value, room, codes) in enumerate(found):
        free = min(abs(value - one) for one in right) - outer
        others = [abs(value - one) / 2 for at, (one, *_) in enumerate(found) if at != number]
        yield value, min([room, free, *others]), codes


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
            lines += category_lines(category)
        lines += _question(question, language)
    return "\n".join([*lines, "</quiz>", ""]).encode()


def category_lines(title: str) -> list[str]:
    """Return the element of a category, in which the questions after it are."""
    path = html.escape(without_control_characters(f"$course$/top/{title.replace('/', '//')}"))
    return [
        '<question type="category">',
        f"<category><text>{path}</text></category>",
        "</question>",
    ]


def _question(question: QuizQuestion, language: Language) -> Iterator[str]:
    text = "\n".join(_text(question, language))
    yield '<question type="cloze">'
    name = html.escape(without_control_characters(question.name(language)))
    yield f"<name><text>{name}</text></name>"
    yield '<questiontext format="html">'
    yield f"<text>{cdata(text)}</text>"
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


def cdata(text: str) -> str:
    """Return a text as a section of character data."""
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
            line = _safe(markup(AnswerFormatter(language).in_words(part.entry)))
            line += "" if part.choices else " ="
        asked = part.entry
        line += f" {gap(part, points)}"
        unit = AnswerFormatter(language).unit(part.entry)
        if part.alternatives and unit:
            line += f" {_safe(markup(unit))}"
    if line:
        yield _paragraph(line)
    senses = texts.how_sense if any(part.choices for part in question.parts) else ""
    told = (texts.how, senses, _accepted(question.parts, language))
    yield _paragraph(_safe(markup(" ".join(filter(None, told)))))


def _accepted(parts: Iterable[QuizPart], language: Language) -> str:
    """Return how far an answer may be off, without a hint at its value."""
    texts: MessageTable = language.check["exchange"]
    entries = [part.entry for part in parts]
    if any(entry.sigma for entry in entries):
        return texts.accepted
    # The middle one: whole numbers have a narrower tolerance, small ones a wider one.
    share = median([e.tolerance / abs(e.exact) for e in entries if e.exact] or [0.0])
    return texts.accepted_computed.format(
        percent=language.notation.number(trimmed(100.0 * share, 2))
    )


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
    asked = ", ".join(filter(None, (plain_text(AnswerFormatter(language).in_words(entry)), unit)))
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


DPI = 110.0
"""About 800 dots across a scheme: read on a screen, some ten kilobytes."""


def question_of(task: Task, kind: ProblemKind[Any], language: Language) -> QuizQuestion:
    """Return a variant as a question."""
    problem = task.problem
    facts, drawing = kind.given_facts(problem, language), kind.scheme(problem)
    parts = tuple(quiz_of(task, language))
    used = {"mu_l", *(part.entry.scale for part in parts)}
    return QuizQuestion(
        problem.title or problem.name,
        task.variant,
        tuple(facts),
        {name: per_mm for name, per_mm in task.scales({}, task.first).items() if name in used},
        parts,
        render(drawing, "png", options=Options(dpi=DPI)) if drawing is not None else b"",
    )


def key_record(key: Key) -> dict[str, Any]:
    """Return the key of one variant as plain data: SI, degrees, mm; None for missing values."""
    return {
        "problem": key.problem.name,
        "variant": key.variant,
        "scales": dict(key.scales),
        "answers": [_answer(entry) for entry in key.entries],
        "hidden": {code: list(places) for code, places in key.hidden.items()},
    }


def _answer(entry: KeyEntry) -> dict[str, Any]:
    return {
        "id": entry.id,
        "what": entry.what,
        "letters": entry.label,
        "value": finite_or_none(displayed_value(entry.exact, entry)),
        "unit": entry.unit,
        "tolerance": finite_or_none(entry.tolerance),
        "mm": None if entry.mm is None else finite_or_none(entry.mm),
        "segment": entry.segment or None,
        "sense": None if entry.sense is None else entry.sense.value,
        "position": entry.position,
        "points": entry.points,
        "asks_sense": entry.asks_sense,
        "signed": entry.signed,
        "sigma": finite_or_none(entry.sigma),
        "seen": entry.is_visible,
        "zero": entry.zero,
        "asked": entry.requested_unit or None,
        "per": entry.per,
        "hidden": list(entry.hidden),
    }
