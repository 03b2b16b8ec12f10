"""Contents of a file before interpretation: texts and their locations (клетки)."""

# Cyrillic letters: heads and words that works of students are written with

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.model import Sense, Unread, WrittenAnswer
from planmethod.check.submissions.units import DASHES
from planmethod.languages import visible
from planmethod.note.wording import get_language
from planmethod.problem.names import fold, short
from planmethod.problem.selector import SelectorError, parse_selector


def key(text: str) -> str:
    """Return the letters and digits of a text, small."""
    return "".join(filter(str.isalnum, text.casefold()))


_HEADS = {
    "student": "student, студент, фио, ф.и.о. студента, фамилия, имя, фамилия имя, name, "
    "отчество, фамилия и. о., first name, last name, full name, surname, student id",
    "number": "№, n, no, номер, № студента, номер студента, зачётка, зачетка, зачётная книжка, "
    "зачетная книжка, номер зачётной книжки, номер зачетной книжки, шифр, number, student number",
    "variant": "variant, вариант, вар., № варианта, номер варианта",
    "problem": "problem, задача, файл задачи",
    "what": "what, величина, что, параметр, quantity",
    "id": "id, item, обозначение, answer",
    "value": "value, значение, ответ, численное значение, значение величины",
    "unit": "unit, единица, ед., единица измерения, ед. изм., единицы, units, размерность",
    "mm": "mm, мм, мм на плане, длина отрезка, мм плана, на плане, mm on the plan, on the plan",
    "segment": "segment, отрезок, отрезок плана",
    "sense": "sense, направление, direction, знак направления, куда",
    "position": "position, положение, № положения, номер положения",
    "scale": "scale, масштаб, μ, mu, масштаб μ, scale μ, масштаб плана, масштабный коэффициент",
    "ruler_mm": "ruler, ruler_mm, линейка, цена деления, цена деления линейки",
    "note": "note, notes, remark, comment, примечание, примечания, заметка, комментарий, группа, "
    "group, проверка, check, дата, date, email, почта",
}

HEADS: Mapping[str, str] = {
    key(word) or word: field for field, words in _HEADS.items() for word in words.split(", ")
}
"""Which field a head is, by `key`; a ``note`` is not read."""

NUMBERED: Mapping[str, str] = {
    "ответ": "answer", "response": "answer", "вопрос": "question", "question": "question",
}  # fmt: skip
"""Meaning of a numbered head in an export of a learning management system: ``Ответ 1``."""

MAILS = frozenset(
    ("адресэлектроннойпочты", "электроннаяпочта", "почта", "emailaddress", "email", "mail")
)
"""Heads of e-mails in such an export, by `key`."""

MM = frozenset(("мм", "mm"))
"""Endings of a head of millimetres of the plan."""

_SENSES = {
    Sense.CCW: "ccw, ↺, ⟲, counterclockwise, anticlockwise, против часовой стрелки, против, "
    "против часовой, против ч.с., против час. стр., против час. стрелки, "
    "против хода часовой стрелки",
    Sense.CW: "cw, ↻, ⟳, clockwise, по часовой стрелке, по часовой, по ч.с., по час. стр., "
    "по час. стрелке, по ходу часовой стрелки",
    Sense.UP: "up, ↑, вверх, upwards",
    Sense.DOWN: "down, ↓, вниз, downwards",
    Sense.LEFT: "left, ←, влево, налево",
    Sense.RIGHT: "right, →, вправо, направо",
}

SENSES: Mapping[str, Sense] = {
    key(word) or word: sense for sense, words in _SENSES.items() for word in words.split(", ")
}
"""Senses by `key`, or by the arrow."""

_BLANKS = (
    "нет, нет ответа, без ответа, ответа нет, нет данных, нет решения, н/д, не знаю, не решал, "
    "не решала, не решал(а), не решено, не решил, не решила, не делал, не делала, не сделал, "
    "не сделала, не сделано, не нашёл, не нашел, не нашла, не найдено, не считал, не считала, "
    "пусто, прочерк, пропуск, "
    "no, none, n/a, null, no answer, not answered, unanswered, not solved, not done, not found, "
    "don't know, i don't know, do not know, i do not know, unknown, skipped, blank"
)

BLANKS = frozenset(map(key, _BLANKS.split(", ")))
"""Texts that mean no answer, by `key`."""

BLANK_SIGNS = f"{DASHES}-_?.…/ \t\u00a0"
"""Signs that mean no answer if alone."""

POINT = frozenset(("точка", "point"))
"""First word of a row that renames a point of the problem in this submission."""


def read_sense(text: str) -> Sense | None:
    """Return the sense that a text names, or None."""
    return SENSES.get(key(text) or text.strip(" ().,;"))


TEXT_LIMIT = 200
"""Maximum number of characters read from a cell."""


class Cell(Struct, frozen=True):
    """A text and its location (клетка).

    Attributes
    ----------
    merged : str
        Text of the cell that this empty one is merged with.
    reason : Unread or None
        Why the text cannot be read.
    """

    text: str = ""
    location: str = ""
    merged: str = ""
    reason: Unread | None = None

    @property
    def is_blank(self) -> bool:
        """True if it has no content; a zero is content."""
        return self.reason is None and (
            not self.text.strip(BLANK_SIGNS) or key(self.text) in BLANKS
        )


BLANK = Cell()


def cut(text: str, limit: int = TEXT_LIMIT) -> str:
    """Return the part of a foreign text that is read, in one line."""
    return visible(" ".join(text[:limit].split()))


@lru_cache(maxsize=4096)
def read_name(text: str) -> tuple[str, str]:
    """Return ``what`` and ``id`` of a quantity; one of them is empty."""
    folded = " ".join(fold(text).split())
    try:
        parse_selector(folded)
    except SelectorError:
        return "", text
    return folded, ""


def mark_unreadable(
    reason: Unread, text: str, location: str, *, base: WrittenAnswer | None = None
) -> WrittenAnswer:
    """Return an answer that cannot be read, or a remark."""
    texts = get_language("en").form
    text = short(cut(text))
    said = texts["unread"][reason.value].format(text=text, known=", ".join(texts["units"]))
    base = base or WrittenAnswer(raw=text)
    return replace(base, unreadable=said, location=location, reason=reason, fault=text)


def first_filled(cells: Mapping[str, Cell], *names: str) -> Cell:
    """Return the first of these cells that says something."""
    said = (cells[name] for name in names if name in cells)
    return next((cell for cell in said if not cell.is_blank), BLANK)
