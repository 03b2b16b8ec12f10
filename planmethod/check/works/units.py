"""Units and numbers as people write them (единицы, числа)."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterator, Mapping
from functools import lru_cache

from msgspec import Struct

from planmethod.check.model import WrittenAnswer

TEXT_LIMIT = 32

Dimension = tuple[int, int, int, int]
"""Powers of length, time, force and angle."""


class MeasurementUnit(Struct, frozen=True):
    """A unit (единица).

    Attributes
    ----------
    factor : float
        What one of it is in SI; in degrees if it is of an angle.
    dimension : Dimension
        The angle is counted in angles alone: ``рад/с`` is ``1/с``.
    """

    factor: float
    dimension: Dimension


_ANGLE = (0, 0, 0, 1)
_TURN = 2.0 * math.pi

_SYMBOLS: Mapping[str, tuple[float, Dimension]] = {
    **dict.fromkeys(("m", "м"), (1.0, (1, 0, 0, 0))),
    **dict.fromkeys(("cm", "см"), (1e-2, (1, 0, 0, 0))),
    **dict.fromkeys(("mm", "мм"), (1e-3, (1, 0, 0, 0))),
    **dict.fromkeys(("s", "с", "sec", "сек"), (1.0, (0, 1, 0, 0))),
    **dict.fromkeys(("min", "мин"), (60.0, (0, 1, 0, 0))),
    **dict.fromkeys(("N", "Н"), (1.0, (0, 0, 1, 0))),
    **dict.fromkeys(("kN", "кН"), (1e3, (0, 0, 1, 0))),
    **dict.fromkeys(("kgf", "кгс"), (9.80665, (0, 0, 1, 0))),
    **dict.fromkeys(("Nm", "Нм"), (1.0, (1, 0, 1, 0))),
    **dict.fromkeys(("Nmm", "Нмм"), (1e-3, (1, 0, 1, 0))),
    **dict.fromkeys(("kNm", "кНм"), (1e3, (1, 0, 1, 0))),
    **dict.fromkeys(("rad", "рад"), (1.0, _ANGLE)),
    **dict.fromkeys(("deg", "°", "град", "градус", "градусов"), (math.pi / 180.0, _ANGLE)),
    **dict.fromkeys(("rev", "об"), (_TURN, _ANGLE)),
    **dict.fromkeys(("rpm", "1/min", "1/мин", "min-1", "мин-1"), (_TURN / 60.0, (0, -1, 0, 1))),
}
"""All that units are put together of, and those that are not what they are put together of."""

_LOOKALIKES = str.maketrans("авекмнорстухº", "abekmhopctyx°")
_SIGNS = str.maketrans({"⋅": "*", "·": "*", "∙": "*", "•": "*", "×": "*", "−": "-", "–": "-"})


def _plain(text: str) -> str:
    """Return a unit without what may be written in several ways."""
    text = unicodedata.normalize("NFKC", text.casefold().replace("º", "°")).replace("**", "")
    text = re.sub(r"[\s^{}]", "", text.translate(_SIGNS))
    return re.sub(r"\.(?=\W|$)", "", text).replace(".", "*").translate(_LOOKALIKES)


_KNOWN = {_plain(name): unit for name, unit in _SYMBOLS.items()}
_TOKEN = r"([^\W\d_]+|°)(-?\d)?|([*/()])|(1)(?=/)"


class _NoUnitError(Exception):
    """A text is no unit."""


@lru_cache(maxsize=1024)
def read_unit(text: str) -> MeasurementUnit | None:
    """Return the unit that a text names, or None: ``м/с²``, ``m/s^2``, ``(м/с)/мм``, ``об/мин``.

    Examples
    --------
    >>> read_unit("мм/с")
    MeasurementUnit(factor=0.001, dimension=(1, -1, 0, 0))
    """
    plain = _plain(text) if len(text) <= TEXT_LIMIT else ""
    try:
        factor, dimension = _KNOWN.get(plain) or _product(_tokens(plain), inside=False)
    except _NoUnitError:
        return None
    if dimension == _ANGLE:
        factor = math.degrees(factor)
    else:
        dimension = (*dimension[:3], 0)
    return MeasurementUnit(factor, dimension)


def _tokens(plain: str) -> Iterator[tuple[str, int]]:
    """Yield the names of a unit with their powers, and what stands between them."""
    pattern = re.compile(_TOKEN)
    at = 0
    while at < len(plain):
        match = pattern.match(plain, at)
        if match is None:
            raise _NoUnitError
        at = match.end()
        yield match[1] or match[3] or "1", int(match[2] or 1)


def _product(tokens: Iterator[tuple[str, int]], *, inside: bool) -> tuple[float, Dimension]:
    """Return the product up to the closing bracket, or to the end; a quotient is of one name."""
    factor, dimension, sign, wanted = 1.0, (0, 0, 0, 0), 1, True
    for name, power in tokens:
        if wanted:
            if name == "(":
                one = _product(tokens, inside=True)
            elif name == "1":
                one = (1.0, (0, 0, 0, 0))
            elif name in _KNOWN:
                one = _KNOWN[name]
            else:
                raise _NoUnitError
            factor *= one[0] ** (sign * power)
            a, b, c, d = (x + sign * power * y for x, y in zip(dimension, one[1], strict=True))
            dimension, wanted = (a, b, c, d), False
        elif name == ")" and inside:
            return factor, dimension
        elif name in "*/":
            sign, wanted = (1 if name == "*" else -1), True
        else:
            raise _NoUnitError
    if inside or wanted:
        raise _NoUnitError
    return factor, dimension


def ratio(answer: WrittenAnswer, unit: str) -> float | None:
    """Return what ``value`` and ``step`` of an answer are multiplied by to be in a key's unit.

    An answer without a unit is in that of the key.

    Returns
    -------
    float or None
        None where his unit is of another quantity: m/s of an acceleration.
    """
    wanted = read_unit(unit)
    if not answer.unit or wanted is None:
        return 1.0
    return None if ratio_of(answer.unit, unit) is None else 1.0 / wanted.factor


def ratio_of(unit: str, other: str) -> float | None:
    """Return how many of another unit a unit is; None if they are not of one quantity."""
    one, two = read_unit(unit), read_unit(other)
    if one is None or two is None or one.dimension != two.dimension:
        return None
    return one.factor / two.factor


NUMBER_LIMIT = 80
LARGEST = 1e30
POWER_LIMIT = 40


class Number(Struct, frozen=True):
    """A number, and what stands behind it (число).

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
    """Return the number that a text begins with; None if it is none, or not surely one.

    One comma or point is the decimal sign: ``1,234`` is 1.234. Of several the last is, if it
    stands once; else all part thousands.

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
