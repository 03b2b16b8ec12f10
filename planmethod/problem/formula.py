"""Formulas and arithmetic of problem files: a grammar without code execution (формулы).

.. code-block:: text

    sum     = product { ("+" | "-") product }
    product = signed { ("*" | "/") signed }
    signed  = { "+" | "-" } power
    power   = atom [ ("^" | "**") signed ]
    atom    = number | "t" | constant | function "(" sum ")" | "(" sum ")"

Arithmetic, the number of a statement, has of the names ``pi`` and ``sqrt`` only. It is written as
a textbook prints it, too: ``0,25/3``, ``2·0,11``, ``√2/2``, ``√(0,2² + 0,1²)``.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from enum import Enum
from types import MappingProxyType
from typing import TYPE_CHECKING

from msgspec import Struct

from planmethod.languages import translate
from planmethod.problem.names import listed, nearest_name_hint, short

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
        "=": "Only the right side stands here.",
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


def evaluate_arithmetic(text: str) -> float:
    """Return the value of arithmetic (вычислить).

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
    for operation in Parser(re.sub(_COMMA, ".", text.translate(_AS_TYPED)), printed=True).parse():
        try:
            stack.append(_apply_operation(operation, stack))
        except ZeroDivisionError:
            raise FormulaError("a division by zero has no value", "Correct the divisor.") from None
        except OverflowError:
            raise FormulaError("a power in it is too large", "Correct the exponent.") from None
        except ValueError:
            raise FormulaError("the root of a negative number has no value") from None
    return stack[-1]


def _apply_operation(operation: Operation, stack: list[float]) -> float:
    """Return the result of an operation; pop its operands off the stack."""
    match operation.kind:
        case FormulaKind.NUMBER | FormulaKind.CONSTANT:
            return operation.value
        case FormulaKind.MINUS:
            return -stack.pop()
        case FormulaKind.CALL:
            return math.sqrt(stack.pop())
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


class Parser:
    """Recursive descent with bounded depth; the text becomes a row of operations.

    ``printed``: arithmetic as a textbook prints it, without time.
    """

    def __init__(self, text: str, *, printed: bool = False) -> None:
        self.tokens = _tokens(text, _PRINTED if printed else _TOKEN)
        self.names = ("pi", "sqrt") if printed else (TIME, *CONSTANTS, *FUNCTIONS)
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
        hint = "Nothing is multiplied without a sign: write {}*{}."
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
            hint = 'A bracket holds something: "(1 + t)".' if text == ")" else ""
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
        if text == TIME:
            self.made.append(Operation(FormulaKind.TIME))
        elif text in CONSTANTS:
            self.made.append(Operation(FormulaKind.CONSTANT, text, CONSTANTS[text]))
        else:
            if self._text != "(":
                hint = f"Write {text}({TIME if TIME in self.names else 2})."
                raise FormulaError(
                    translate("character {}: expected '(' after {}", position, text), hint
                )
            self._bracket()
            self.made.append(Operation(FormulaKind.CALL, FUNCTIONS[text]))

    def _bracket(self) -> None:
        where = self.tokens[self.at][2]
        self._deeper()
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
            raise FormulaError(message, _INSTEAD.get(char, ""))
        found.append((str(match.lastgroup), match[0], at + 1))
        at = match.end()
    return [*found, ("end", "", len(text) + 1)]
