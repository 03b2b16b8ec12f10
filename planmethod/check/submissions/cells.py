"""Cells of a submission: their texts, numbers and units, and the answer that they mean."""

# Cyrillic letters: multiplication signs and e that numbers are written with
# Cyrillic letters: heads and words that works of students are written with

from __future__ import annotations

import re
import stat
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.model import Sense, Unread, WrittenAnswer
from planmethod.errors import ExitCode, PlanMethodError
from planmethod.languages import visible
from planmethod.note.wording import get_language
from planmethod.problem.formula import ratio_of, read_unit
from planmethod.problem.names import fold, short
from planmethod.problem.quantities import QuantityNameError, parse_words

SIZE_LIMIT = 4 * 1024 * 1024


class SubmissionError(PlanMethodError):
    """A submission file cannot be read (файл работ)."""

    exit_code = ExitCode.USAGE


def read_bytes(path: Path, limit: int = SIZE_LIMIT) -> bytes:
    """Return the contents of a file.

    Raises
    ------
    WorksError
        It does not exist, cannot be read, or is too large.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise SubmissionError(
                "{}: this is not a file. Name one: JSON, TOML, CSV or XLSX.", path
            )
        with path.open("rb") as stream:
            data = stream.read(limit + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise SubmissionError("{}: cannot be read: {}. Check the path.", path, reason) from None
    if len(data) > limit:
        raise SubmissionError(
            "{}: larger than {} MiB. Submissions of a group take a few hundred kilobytes; "
            "is this the right file?",
            path,
            limit // 2**20,
        )
    return data


def ratio(answer: WrittenAnswer, unit: str) -> float | None:
    """Return what ``value`` and ``step`` of an answer are multiplied by to be in a key's unit.

    An answer without a unit is in that of the key.

    Returns
    -------
    float or None
        None if the unit belongs to another quantity: m/s for an acceleration.
    """
    wanted = read_unit(unit)
    if not answer.unit or wanted is None:
        return 1.0
    return None if ratio_of(answer.unit, unit) is None else 1.0 / wanted.factor


NUMBER_LIMIT = 80
LARGEST = 1e30
POWER_LIMIT = 40


class Number(Struct, frozen=True):
    """A number and the text after it (число).

    Attributes
    ----------
    step : float
        Unit of its last digit.
    rest : str
        A unit, for instance.
    """

    value: float
    step: float
    rest: str = ""


DASHES = "−–—‒―﹣－‐‑"
_DASHES = str.maketrans(dict.fromkeys(DASHES, "-"))
_RAISED = str.maketrans("⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "+-0123456789")
_NUMBER = (
    r"(?P<sign>[+-]?) ?"
    r"(?P<digits>(?:[0-9]{1,3}(?:[ '][0-9]{3})+(?![0-9])|[0-9]+)?(?:[.,][0-9]+)*)[.,]?"
    r"(?: ?[·*×xх⋅∙•] ?10 ?(?:(?:\^|\*\*) ?[({]? ?(?P<power>[+-]? ?[0-9]+) ?[)}]?"
    r"|(?P<raised>[⁺⁻]?[⁰¹²³⁴-⁹]+)|(?P<lowered>[+-][0-9]+))"
    r"|[eEеЕ](?P<e>[+-]?[0-9]+))?"
)


def read_number(text: str) -> Number | None:
    """Return the number at the beginning of a text; None if there is none or it is ambiguous.

    A single comma or point is the decimal sign: ``1,234`` is 1.234. Among several, the last one is,
    if it occurs once; else all of them separate thousands.

    Examples
    --------
    >>> read_number("1 234,5·10^-1 мм")
    Number(value=123.45, step=0.01, rest='мм')
    """
    text = " ".join(text.translate(_DASHES).split()).lstrip("≈~≃≅= ")
    match = re.match(_NUMBER, text) if len(text) <= NUMBER_LIMIT else None
    digits = _decimal(re.sub("[ ']", "", match["digits"])) if match else None
    if match is None or digits is None:
        return None
    raised = match["raised"] and match["raised"].translate(_RAISED)
    power = match["power"] or raised or match["lowered"] or match["e"] or "0"
    power = int(power.replace(" ", "")) if len(power) < 6 else POWER_LIMIT + 1
    fraction = digits.partition(".")[2]
    if abs(power) > POWER_LIMIT or len(digits) > POWER_LIMIT:
        return None
    value = float(f"{match['sign']}{digits}e{power}")
    rest = text[match.end() :].strip()
    if abs(value) > LARGEST or re.match(r"(?!1/)[0-9]", rest):
        return None
    return Number(value, float(f"1e{power - len(fraction)}"), rest)


def _decimal(digits: str) -> str | None:
    """Return digits with at most one point, the decimal one; None if they do not go together."""
    marks = re.findall("[.,]", digits)
    if not digits.strip(".,"):
        return None
    if len(marks) < 2:
        return digits.replace(",", ".")
    groups = re.split("[.,]", digits)
    last = groups.pop() if marks[-1] not in marks[:-1] else None
    thousands = marks[:-1] if last is not None else marks
    if len(set(thousands)) > 1 or not 0 < len(groups[0]) <= 3:
        return None
    if any(len(group) != 3 for group in groups[1:]):
        return None
    return "".join(groups) + ("" if last is None else f".{last}")


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
        parse_words(folded)
    except QuantityNameError:
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


POSITION_LIMIT = 100_000

_MM = read_unit("mm")
_BREAK = r"[\s(,;]+"

Scaled = tuple[float, float, str, Sense | None]
"""Value and step, SI; unit as written; sense."""


class NotReadError(Exception):
    """A cell cannot be read."""

    def __init__(self, reason: Unread, text: str, cell: Cell) -> None:
        super().__init__(text)
        self.reason, self.text, self.cell = reason, text, cell


def read_answer(cells: Mapping[str, Cell], *, location: str = "") -> WrittenAnswer:
    """Return an answer; if it is unreadable, the first faulty cell is reported.

    Parameters
    ----------
    cells : mapping of str to Cell
        By the names of fields: what, id, value, unit, mm, segment, sense, position.
    location : str
        Its location, if its cells have none.
    """
    what, name = "", first_filled(cells, "id").text
    if named := first_filled(cells, "what").text:
        what, other = read_name(named)
        name = name or other
    shown = first_filled(cells, "value", "mm", "sense")
    # The unit is kept even without a value: the answer is blank.
    answer = WrittenAnswer(
        what=what,
        id=name,
        unit=first_filled(cells, "unit").text,
        segment=first_filled(cells, "segment").text,
        location=location or shown.location or first_filled(cells, "what", "id").location,
        raw=first_filled(cells, "value").text,
    )
    try:
        # The most important is read first: a fault keeps what is already read.
        answer = replace(answer, position=_position(first_filled(cells, "position")))
        value, mm = first_filled(cells, "value"), first_filled(cells, "mm")
        said = None
        if not value.is_blank:
            number, step, unit, said = read_scaled(value, first_filled(cells, "unit"))
            answer = replace(answer, value=number, step=step, unit=unit)
        if not mm.is_blank:
            number, step, unit, other_said = read_scaled(mm, Cell())
            if unit:
                if read_unit(unit) != _MM:
                    raise NotReadError(Unread.UNIT, unit, mm)
                number, step = number * 1e3, step * 1e3
            answer = replace(answer, mm=number, mm_step=step)
            said = said or other_said
        answer = replace(answer, sense=_sense(first_filled(cells, "sense")) or said)
    except NotReadError as fault:
        return mark_unreadable(
            fault.reason, fault.text, fault.cell.location or answer.location, base=answer
        )
    if not what and not name and (not answer.is_blank or answer.sense):
        return mark_unreadable(Unread.QUANTITY, shown.text, answer.location, base=answer)
    return answer


def read_scaled(cell: Cell, unit: Cell) -> Scaled:
    """Return a number with its unit, which follows it or has a separate cell.

    Raises
    ------
    NotReadError
    """
    if cell.reason:
        raise NotReadError(cell.reason, cell.text, cell)
    if unit.reason:
        raise NotReadError(unit.reason, unit.text, unit)
    number = read_number(cell.text)
    if number is None:
        raise NotReadError(Unread.NUMBER, cell.text, cell)
    for split in (len(number.rest), *(m.start() for m in re.finditer(_BREAK, number.rest))):
        own, tail = number.rest[:split].strip(), number.rest[split:].strip()
        sense = read_sense(tail or own)
        if tail and not sense:
            continue
        if not tail and sense:
            own = ""
        scale = read_unit(own or unit.text)
        if scale is not None:
            return number.value * scale.factor, number.step * scale.factor, own or unit.text, sense
        if not own and not unit.text:
            return number.value, number.step, "", sense
    if number.rest and not number.rest[0].isalpha():
        raise NotReadError(Unread.NUMBER, cell.text, cell)
    raise NotReadError(Unread.UNIT, number.rest or unit.text, cell if number.rest else unit)


def _sense(cell: Cell) -> Sense | None:
    if cell.is_blank:
        return None
    sense = None if cell.reason else read_sense(cell.text)
    if sense is None:
        raise NotReadError(cell.reason or Unread.SENSE, cell.text, cell)
    return sense


def _position(cell: Cell) -> int | None:
    if cell.is_blank:
        return None
    number = None if cell.reason else read_number(cell.text)
    if number is None or number.rest or number.value % 1:
        raise NotReadError(cell.reason or Unread.POSITION, cell.text, cell)
    position = int(number.value)
    if not 0 <= position < POSITION_LIMIT:
        raise NotReadError(Unread.POSITION, cell.text, cell)
    return position
