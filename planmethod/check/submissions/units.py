"""Units and numbers as people write them (единицы, числа)."""

# Cyrillic letters: multiplication signs and e that numbers are written with

from __future__ import annotations

import re

from msgspec import Struct

from planmethod.check.model import WrittenAnswer
from planmethod.problem.units import ratio_of, read_unit


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
