"""Units as people write them, and numbers of a file that have one (единицы)."""

# Cyrillic letters: units as they are written

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterator, Mapping
from functools import lru_cache

from msgspec import Struct

from planmethod.languages import translate
from planmethod.problem.formula import FormulaError, evaluate_arithmetic

TEXT_LIMIT = 32

Dimension = tuple[int, int, int, int]
"""Powers of length, time, force and angle."""


class MeasurementUnit(Struct, frozen=True):
    """A unit (единица).

    Attributes
    ----------
    factor : float
        Its value in SI; in degrees for an angle.
    dimension : Dimension
        The angle is counted in angles alone: ``рад/с`` is ``1/с``.
    """

    factor: float
    dimension: Dimension


_ANGLE = (0, 0, 0, 1)
_MASS = (-1, 2, 1, 0)
_TURN = 2.0 * math.pi

_SYMBOLS: Mapping[str, tuple[float, Dimension]] = {
    **dict.fromkeys(("m", "м"), (1.0, (1, 0, 0, 0))),
    **dict.fromkeys(("cm", "см"), (1e-2, (1, 0, 0, 0))),
    **dict.fromkeys(("mm", "мм"), (1e-3, (1, 0, 0, 0))),
    **dict.fromkeys(("in", "inch", "дюйм", "дюйма", "дюймов"), (0.0254, (1, 0, 0, 0))),
    **dict.fromkeys(("ft", "фут", "фута", "футов"), (0.3048, (1, 0, 0, 0))),
    **dict.fromkeys(("s", "с", "sec", "сек"), (1.0, (0, 1, 0, 0))),
    **dict.fromkeys(("min", "мин"), (60.0, (0, 1, 0, 0))),
    **dict.fromkeys(("N", "Н"), (1.0, (0, 0, 1, 0))),
    **dict.fromkeys(("kN", "кН"), (1e3, (0, 0, 1, 0))),
    **dict.fromkeys(("kgf", "кгс"), (9.80665, (0, 0, 1, 0))),
    **dict.fromkeys(("kg", "кг"), (1.0, _MASS)),
    **dict.fromkeys(("g", "г"), (1e-3, _MASS)),
    **dict.fromkeys(("t", "т"), (1e3, _MASS)),
    **dict.fromkeys(("Pa", "Па"), (1.0, (-2, 0, 1, 0))),
    **dict.fromkeys(("kPa", "кПа"), (1e3, (-2, 0, 1, 0))),
    **dict.fromkeys(("MPa", "МПа"), (1e6, (-2, 0, 1, 0))),
    **dict.fromkeys(("bar", "бар"), (1e5, (-2, 0, 1, 0))),
    **dict.fromkeys(("W", "Вт"), (1.0, (1, -1, 1, 0))),
    **dict.fromkeys(("kW", "кВт"), (1e3, (1, -1, 1, 0))),
    **dict.fromkeys(("Nm", "Нм"), (1.0, (1, 0, 1, 0))),
    **dict.fromkeys(("Nmm", "Нмм"), (1e-3, (1, 0, 1, 0))),
    **dict.fromkeys(("kNm", "кНм"), (1e3, (1, 0, 1, 0))),
    **dict.fromkeys(("rad", "рад"), (1.0, _ANGLE)),
    **dict.fromkeys(("deg", "°", "град", "градус", "градусов"), (math.pi / 180.0, _ANGLE)),
    **dict.fromkeys(("rev", "об"), (_TURN, _ANGLE)),
    **dict.fromkeys(("rpm", "1/min", "1/мин", "min-1", "мин-1"), (_TURN / 60.0, (0, -1, 0, 1))),
}
"""Base names of which units are composed, and units that are not composed of their parts."""

_LOOKALIKES = str.maketrans("авекмнорстухº", "abekmhopctyx°")
_SIGNS = str.maketrans({"⋅": "*", "·": "*", "∙": "*", "•": "*", "×": "*", "−": "-", "–": "-"})


def _normalized(text: str) -> str:
    """Return the normalized spelling of a unit."""
    text = unicodedata.normalize("NFKC", text.casefold().replace("º", "°")).replace("**", "")
    text = re.sub(r"[\s^{}]", "", text.translate(_SIGNS))
    return re.sub(r"\.(?=\W|$)", "", text).replace(".", "*").translate(_LOOKALIKES)


_KNOWN = {_normalized(name): unit for name, unit in _SYMBOLS.items()}
_TOKEN = r"([^\W\d_]+|°)(-?\d)?|([*/()])|(1)(?=/)"


class _NoUnitError(Exception):
    """A text is not a unit."""


@lru_cache(maxsize=1024)
def read_unit(text: str) -> MeasurementUnit | None:
    """Return the unit that a text names, or None: ``м/с²``, ``m/s^2``, ``(м/с)/мм``, ``об/мин``.

    Examples
    --------
    >>> read_unit("мм/с")
    MeasurementUnit(factor=0.001, dimension=(1, -1, 0, 0))
    """
    plain = _normalized(text) if len(text) <= TEXT_LIMIT else ""
    try:
        factor, dimension = _KNOWN.get(plain) or _product(_tokens(plain), inside=False)
    except _NoUnitError:
        return None
    if dimension == _ANGLE:
        factor = math.degrees(factor)
    else:
        dimension = (*dimension[:3], 0)
    return MeasurementUnit(factor, dimension)


def _tokens(text: str) -> Iterator[tuple[str, int]]:
    """Yield the names of a unit with their powers, and the signs between them."""
    pattern = re.compile(_TOKEN)
    at = 0
    while at < len(text):
        match = pattern.match(text, at)
        if match is None:
            raise _NoUnitError
        at = match.end()
        yield match[1] or match[3] or "1", int(match[2] or 1)


def _product(tokens: Iterator[tuple[str, int]], *, inside: bool) -> tuple[float, Dimension]:
    """Return the product up to the closing bracket, or to the end; a quotient has one divisor."""
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


def ratio_of(unit: str, target: str) -> float | None:
    """Return the ratio of a unit to another one; None if their quantities differ."""
    one, two = read_unit(unit), read_unit(target)
    if one is None or two is None or one.dimension != two.dimension:
        return None
    return one.factor / two.factor


# Numbers of a file that have a unit ---------------------------------------------------------------

_EXPECTED: Mapping[str, str] = {
    "metres": "m",
    "centimetres": "cm",
    "millimetres": "mm",
    "inches": "in",
    "degrees": "°",
    "rev/min": "rpm",
}
"""Names of units in sentences; other texts use their symbols."""

DIMENSIONS: Mapping[Dimension, str] = {
    (1, 0, 0, 0): "a length",
    (2, 0, 0, 0): "an area",
    (0, 1, 0, 0): "a time",
    _ANGLE: "an angle",
    (0, -1, 0, 0): "an angular velocity",
    (0, -2, 0, 0): "an angular acceleration",
    (1, -1, 0, 0): "a velocity",
    (1, -2, 0, 0): "an acceleration",
    (0, 0, 1, 0): "a force",
    (1, 0, 1, 0): "a moment of a force",
    (-2, 0, 1, 0): "a pressure",
    (1, -1, 1, 0): "a power",
    _MASS: "a mass",
    (1, 2, 1, 0): "a moment of inertia",
}
"""Names of the quantities of a dimension."""


class MeasuredNumber(Struct, frozen=True):
    """A number with its unit (число с единицей).

    Attributes
    ----------
    number : str
        Arithmetic, as written.
    unit : str
    """

    number: str
    unit: str

    @property
    def of(self) -> MeasurementUnit:
        """Properties of the unit."""
        found = read_unit(self.unit)
        assert found is not None
        return found

    @property
    def quantity(self) -> str:
        """Name of its quantity."""
        return translate(DIMENSIONS.get(self.of.dimension, "another quantity"))

    def in_unit(self, unit: str) -> float | None:
        """Return the number in another unit; None if it is of another quantity.

        ``1/s`` is an angular velocity, and no number of turns.
        """
        wanted = read_unit(unit)
        mine = self.of
        if wanted is None or wanted.dimension != mine.dimension:
            return None
        if unit == "rpm" and _is_per_second(self.unit):
            return None
        value = evaluate_arithmetic(self.number)
        return (
            value if mine.factor == wanted.factor else _rounded(value * mine.factor / wanted.factor)
        )


def _rounded(value: float) -> float:
    """Return a converted number without the rounding residue in its last digit."""
    short = float(f"{value:.12g}")
    return short if abs(short - value) <= 1e-15 * abs(value) else value


def _is_per_second(unit: str) -> bool:
    """Return whether a unit is one per second: ``1/s``, ``с⁻¹``."""
    try:
        return _product(_tokens(_normalized(unit)), inside=False)[:2] == (1.0, (0, -1, 0, 0))
    except _NoUnitError:
        return False


def measured(text: str) -> MeasuredNumber | None:
    """Return a text as a number and its unit, or None: ``4 in``, ``2·0,11 м``.

    Examples
    --------
    >>> measured("1500 об/мин")
    MeasuredNumber(number='1500', unit='об/мин')
    """
    text = text.strip()
    if not 1 < len(text) <= _MEASURED_LIMIT:
        return None
    for at in range(1, len(text)):
        if text[at].isalnum() and text[at - 1].isalpha():
            continue
        unit = text[at:].strip()
        unit = f"1{unit}" if unit.startswith("/") else unit
        if read_unit(unit) is None:
            continue
        try:
            evaluate_arithmetic(text[:at])
        except FormulaError:
            continue
        return MeasuredNumber(text[:at].strip(), unit)
    return None


_MEASURED_LIMIT = 80


def expected_unit(sentence: str) -> str:
    """Return the unit at the end of a sentence on an expected value; empty if none.

    Examples
    --------
    >>> expected_unit("a length in metres"), expected_unit("a share of the stroke")
    ('m', '')
    """
    named = sentence.rpartition(" in ")[2] if " in " in sentence else ""
    named = _EXPECTED.get(named, named)
    return named if named and read_unit(named) is not None else ""
