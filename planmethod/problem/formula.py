"""Formulas, and numbers with units: a grammar without code execution (формулы, единицы)."""

# Cyrillic letters: units as they are written

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterator, Mapping
from enum import Enum
from functools import lru_cache
from types import MappingProxyType
from typing import TYPE_CHECKING

from msgspec import Struct

from planmethod.languages import translate
from planmethod.problem.names import (
    describe_lookalikes,
    listed,
    lookalikes,
    nearest_name_hint,
    short,
)

if TYPE_CHECKING:
    from decimal import Decimal


LENGTH_LIMIT = 500
DEPTH_LIMIT = 40

FUNCTIONS: Mapping[str, str] = MappingProxyType(
    {
        **{name: name for name in ("sin", "cos", "tg", "ctg", "exp", "ln", "lg", "sqrt", "abs")},
        **dict.fromkeys(("sh", "sinh"), "sh"),
        **dict.fromkeys(("ch", "cosh"), "ch"),
        **dict.fromkeys(("th", "tanh"), "th"),
        **dict.fromkeys(("asin", "arcsin"), "arcsin"),
        **dict.fromkeys(("acos", "arccos"), "arccos"),
        **dict.fromkeys(("atan", "arctan", "arctg"), "arctg"),
        "tan": "tg",
        "cot": "ctg",
        "log": "ln",
    }
)
"""Names that a function may be written with, and the one it is known by."""

ATAN2 = "atan2"
OF_DEGREES = (
    "sqrt", "sin", "cos", "tg", "tan", "ctg", "arcsin", "asin", "arccos", "acos", "arctg", "atan",
    ATAN2,
)  # fmt: skip
"""Functions of the arithmetic of files, whose angles are in degrees."""

_NO_VALUES: Mapping[str, float] = MappingProxyType({})
CONSTANTS: Mapping[str, float] = MappingProxyType({"pi": math.pi, "e": math.e})
TIME = "t"

_TOKEN = (
    r"(?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    r"|(?P<name>[A-Za-z_][A-Za-z_0-9]*)|(?P<sign>\*\*|[-+*/^()])"
)
_INSTEAD: Mapping[str, str] = MappingProxyType(
    {
        ",": "The decimal sign is a point: 7.5.",
        **dict.fromkeys("−–—", "Write -."),
        **dict.fromkeys("·×∙", "Write *."),
        **dict.fromkeys("÷:", "Write /."),
        "π": "Write pi.",
        "√": "Write sqrt(...).",
        "²": "Write ^2.",
        "³": "Write ^3.",
        **dict.fromkeys("[]{}", "Use round brackets."),
        "=": "Write only the right side here.",
    }
)


class FormulaKind(Enum):
    """Kind of an operation of a formula (вид действия)."""

    NUMBER = "number"
    TIME = "t"
    CONSTANT = "constant"
    CALL = "call"
    MINUS = "minus"
    ADD = "+"
    SUBTRACT = "-"
    MULTIPLY = "*"
    DIVIDE = "/"
    POWER = "^"


class Operation(Struct, frozen=True):
    """One operation, whose operands are the results before it (действие).

    ``is_exact``: whether float64 represents the number exactly: 0.5, not 0.1.
    """

    kind: FormulaKind
    name: str = ""
    value: float = 0.0
    is_exact: bool = True


class FormulaError(Exception):
    """A formula cannot be read; ``hint`` is the remedy."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.hint = hint


EXPONENT_LIMIT = 400
"""Maximum power of ten of a number; float64 goes from -324 to 308."""

_DECIMAL = r"[-+]?(?:[0-9]++\.?[0-9]*+|\.[0-9]++)(?:[eE][-+]?(?=[0-9])0*+([0-9]*+))?"


def read_decimal(text: str) -> Decimal | None:
    """Return a number exactly as it is written (число из текста).

    Returns
    -------
    Decimal or None
        None if it is not a number, or its power of ten exceeds `EXPONENT_LIMIT`: Python's exact
        numbers would need that many digits, or reject it.
    """
    from decimal import Decimal

    match = re.fullmatch(_DECIMAL, text.strip())
    if match is None or len(match[1] or "") > 3 or int(match[1] or 0) > EXPONENT_LIMIT:
        return None
    return Decimal(match[0])


def is_exact(text: str) -> bool:
    """Return whether float64 represents a decimal number exactly."""
    from decimal import Decimal

    number = read_decimal(text)
    return number is not None and number == Decimal(float(number))


_PRINTED = _TOKEN.removesuffix(")") + "|[√²³π])"
_AS_TYPED = str.maketrans("−–—·×∙÷:", "---***//")
_COMMA = r"(?<=\d),(?=\d)"


def evaluate_arithmetic(text: str, names: Mapping[str, float] | None = None) -> float:
    """Return the value of arithmetic (вычислить).

    Parameters
    ----------
    names : mapping, optional
        Values of the names that it may have besides functions.

    Raises
    ------
    FormulaError
        It cannot be read, or has no value: a division by zero, the root of a negative number.
    """
    if len(text) > LENGTH_LIMIT:
        raise FormulaError(
            translate("it has {} characters, the limit is {}", len(text), LENGTH_LIMIT)
        )
    stack: list[float] = []
    typed = text.translate(_AS_TYPED)
    if ATAN2 not in typed:  # whose comma separates
        typed = re.sub(_COMMA, ".", typed)
    for operation in Parser(typed, printed=True, values=names or {}).parse():
        try:
            stack.append(_apply_operation(operation, stack))
        except ZeroDivisionError:
            raise FormulaError("a division by zero has no value", "Correct the divisor.") from None
        except OverflowError:
            raise FormulaError("a power in it is too large", "Correct the exponent.") from None
        except ValueError:
            if operation.name.startswith("arc"):
                hint = "A sine or a cosine is from -1 to 1."
                raise FormulaError("an angle in it has no value", hint) from None
            raise FormulaError("the root of a negative number has no value") from None
    return stack[-1]


def _apply_operation(operation: Operation, stack: list[float]) -> float:
    """Return the result of an operation; pop its operands off the stack."""
    match operation.kind:
        case FormulaKind.NUMBER | FormulaKind.CONSTANT:
            return operation.value
        case FormulaKind.MINUS:
            return -stack.pop()
        case FormulaKind.CALL if operation.name == ATAN2:
            x, y = stack.pop(), stack.pop()
            if not x and not y:
                raise ZeroDivisionError
            return math.degrees(math.atan2(y, x))
        case FormulaKind.CALL:
            return _called(operation.name, stack.pop())
    second, first = stack.pop(), stack.pop()
    match operation.kind:
        case FormulaKind.ADD:
            return first + second
        case FormulaKind.SUBTRACT:
            return first - second
        case FormulaKind.MULTIPLY:
            return first * second
        case FormulaKind.DIVIDE:
            return first / second
    return math.pow(first, second)


def _called(name: str, value: float) -> float:
    """Return a function of a number; angles are in degrees, and exact at the quadrants."""
    match name:
        case "sqrt":
            return math.sqrt(value)
        case "arcsin":
            return math.degrees(math.asin(value))
        case "arccos":
            return math.degrees(math.acos(value))
        case "arctg":
            return math.degrees(math.atan(value))
    quadrant = round(value / 90.0)
    rest = math.radians(value - 90.0 * quadrant)
    sine, cosine = round(math.sin(rest), 15), round(math.cos(rest), 15)  # 0.5 of 30 degrees
    for _ in range(quadrant % 4):
        sine, cosine = cosine, -sine
    match name:
        case "sin":
            return sine + 0.0
        case "cos":
            return cosine + 0.0
        case "tg":
            return sine / cosine
    return cosine / sine


class Parser:
    """Recursive descent with bounded depth; the text becomes a row of operations.

    ``printed``: arithmetic as a textbook prints it, without time; it may have names with
    ``values``.
    """

    def __init__(
        self, text: str, *, printed: bool = False, values: Mapping[str, float] = _NO_VALUES
    ) -> None:
        token = _PRINTED if printed else _TOKEN
        if printed and ATAN2 in text:
            token = token.replace("√", ",;√")
        self.tokens = _tokens(text, token)
        self.values = values
        self.names = (*values, "pi", *OF_DEGREES) if printed else (TIME, *CONSTANTS, *FUNCTIONS)
        self.at, self.depth = 0, 0
        self.made: list[Operation] = []

    def parse(self) -> list[Operation]:
        """Return the operations in order of execution."""
        if len(self.tokens) == 1:
            raise FormulaError("the formula is empty", 'For example: "4*t*(1 + t/2)".')
        self._sum()
        kind, text, where = self.tokens[self.at]
        if text == ")":
            raise FormulaError(translate("character {}: ')' closes no '('", where))
        if kind != "end":
            raise self._missing_operator()
        return self.made

    def _missing_operator(self) -> FormulaError:
        """Return the fault of a missing operator."""
        (_, before, _), (_, text, where) = self.tokens[self.at - 1 : self.at + 1]
        phrase = translate("character {}: expected an operator before '{}'", where, text)
        if text.startswith("."):
            return FormulaError(phrase, "A number has one decimal point.")
        hint = "Multiplication needs a sign: write {}*{}."
        return FormulaError(phrase, translate(hint, before, short(text, 12)))

    def _sum(self) -> None:
        self._row(("+", "-"), self._product)

    def _product(self) -> None:
        self._row(("*", "/"), self._signed)

    def _row(self, signs: tuple[str, str], part: object) -> None:
        assert callable(part)
        part()
        while (sign := self._text) in signs:
            self.at += 1
            part()
            self.made.append(Operation(FormulaKind(sign)))

    def _signed(self) -> None:
        negative = False
        while self._text in ("+", "-"):
            negative ^= self._text == "-"
            self.at += 1
        self._power()
        if negative:
            self.made.append(Operation(FormulaKind.MINUS))

    def _power(self) -> None:
        self._atom()
        while (raised := "²³".find(self._text)) >= 0 and self._text:
            self.at += 1
            self.made += [
                Operation(FormulaKind.NUMBER, value=raised + 2.0),
                Operation(FormulaKind.POWER),
            ]
        if self._text in ("^", "**"):
            self._deeper()
            self._signed()
            self.depth -= 1
            self.made.append(Operation(FormulaKind.POWER))

    def _atom(self) -> None:
        kind, text, where = self.tokens[self.at]
        if kind == "number":
            written = read_decimal(text)
            if written is None:
                phrase = "character {}: the power of ten of {} is beyond {}"
                phrase = translate(phrase, where, short(text), EXPONENT_LIMIT)
                raise FormulaError(phrase, "Correct the exponent.")
            number = float(written)
            if not math.isfinite(number):
                raise FormulaError(
                    translate("character {}: the number {} is too large", where, short(text, 12))
                )
            self.at += 1
            self.made.append(Operation(FormulaKind.NUMBER, value=number, is_exact=is_exact(text)))
        elif kind == "name":
            self._name(text, where)
        elif text == "(":
            self._bracket()
        elif text == "√":
            self._deeper()
            self._atom()
            self.depth -= 1
            self.made.append(Operation(FormulaKind.CALL, "sqrt"))
        elif text == "π":
            self.at += 1
            self.made.append(Operation(FormulaKind.CONSTANT, "pi", math.pi))
        elif kind == "end":
            raise FormulaError("the formula ends where a number or a name is expected")
        else:
            hint = 'Brackets must not be empty: "(1 + t)".' if text == ")" else ""
            raise FormulaError(
                translate("character {}: expected a number, got '{}'", where, text), hint
            )

    def _name(self, text: str, position: int) -> None:
        self.at += 1
        if text not in self.names:
            hint = nearest_name_hint(
                text, self.names, translate("Known: {}.", listed(self.names, limit=30))
            )
            raise FormulaError(
                translate("character {}: unknown name '{}'", position, short(text)), hint
            )
        if text in self.values:
            self.made.append(Operation(FormulaKind.CONSTANT, text, self.values[text]))
        elif text == TIME:
            self.made.append(Operation(FormulaKind.TIME))
        elif text in CONSTANTS:
            self.made.append(Operation(FormulaKind.CONSTANT, text, CONSTANTS[text]))
        else:
            if self._text != "(":
                hint = translate("Write {}({}).", text, TIME if TIME in self.names else 2)
                raise FormulaError(
                    translate("character {}: expected '(' after {}", position, text), hint
                )
            self._bracket(pair=text == ATAN2)
            self.made.append(Operation(FormulaKind.CALL, FUNCTIONS.get(text, text)))

    def _bracket(self, *, pair: bool = False) -> None:
        where = self.tokens[self.at][2]
        self._deeper()
        self._sum()
        if pair:
            if self._text not in (",", ";"):
                hint = "It has two numbers: atan2(y, x)."
                raise FormulaError(
                    translate("character {}: expected ','", self.tokens[self.at][2]), hint
                )
            self.at += 1
            self._sum()
        if self._text != ")":
            if self._text:
                raise self._missing_operator()
            raise FormulaError(translate("character {}: '(' is not closed", where), "Add ')'.")
        self.at += 1
        self.depth -= 1

    def _deeper(self) -> None:
        self.at += 1
        self.depth += 1
        if self.depth > DEPTH_LIMIT:
            raise FormulaError(
                translate("the formula is nested deeper than {} levels", DEPTH_LIMIT)
            )

    @property
    def _text(self) -> str:
        return self.tokens[self.at][1]


def _tokens(text: str, token: str) -> list[tuple[str, str, int]]:
    """Return kind, text and place (from 1) of every token, and an end."""
    pattern = re.compile(token)
    found: list[tuple[str, str, int]] = []
    at = 0
    while at < len(text):
        if text[at] == " ":
            at += 1
            continue
        match = pattern.match(text, at)
        if match is None:
            char = text[at]
            shown = f"'{char}'" if char.isprintable() else f"U+{ord(char):04X}"
            message = translate("character {}: {} has no meaning in a formula", at + 1, shown)
            if lookalikes(char):
                message = translate("character {}: {}", at + 1, describe_lookalikes(char))
            raise FormulaError(message, _INSTEAD.get(char, ""))
        found.append((str(match.lastgroup), match[0], at + 1))
        at = match.end()
    return [*found, ("end", "", len(text) + 1)]


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
_UNIT_TOKEN = r"([^\W\d_]+|°)(-?\d)?|([*/()])|(1)(?=/)"


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
        factor, dimension = _KNOWN.get(plain) or _product(_unit_tokens(plain), inside=False)
    except _NoUnitError:
        return None
    if dimension == _ANGLE:
        factor = math.degrees(factor)
    else:
        dimension = (*dimension[:3], 0)
    return MeasurementUnit(factor, dimension)


def _unit_tokens(text: str) -> Iterator[tuple[str, int]]:
    """Yield the names of a unit with their powers, and the signs between them."""
    pattern = re.compile(_UNIT_TOKEN)
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
        return _product(_unit_tokens(_normalized(unit)), inside=False)[:2] == (1.0, (0, -1, 0, 0))
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
