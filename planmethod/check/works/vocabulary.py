"""Words that works are written with: heads of columns, senses, what means nothing (слова работ).

They are looked up by `key`: small letters and digits alone, so that case, spaces, points and
brackets are free.
"""

from __future__ import annotations

from collections.abc import Mapping

from planmethod.check.model import Sense


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

MM = frozenset(("мм", "mm"))
"""What a head ends with when millimetres of the plan stand below it."""

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

BLANKS = frozenset(("", "-", "нет", "no", "none", "нд", "na", "null"))
"""What stands where nothing is answered: by `key`, or of dashes alone."""

POINT = frozenset(("точка", "point"))
"""First word of a row that says what a point of the problem is called in this work."""


def read_sense(text: str) -> Sense | None:
    """Return the sense that a text names, or None."""
    return SENSES.get(key(text) or text.strip(" ().,;"))
