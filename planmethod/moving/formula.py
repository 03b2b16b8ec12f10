"""Formulas of problem files: read by a grammar of their own, nothing is executed (формулы).

.. code-block:: text

    sum     = product { ("+" | "-") product }
    product = signed { ("*" | "/") signed }
    signed  = { "+" | "-" } power
    power   = atom [ ("^" | "**") signed ]
    atom    = number | "t" | constant | function "(" sum ")" | "(" sum ")"
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from decimal import Decimal
from enum import Enum
from types import MappingProxyType

from planmethod.problem.fields import Faults, is_number, show
from planmethod.problem.names import describe_lookalikes, fold, listed, lookalikes, near, short

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

ANGULAR = ("sin", "cos", "tg", "ctg")
"""Those of angles."""

CONSTANTS: Mapping[str, float] = MappingProxyType({"pi": math.pi, "e": math.e})
TIME = "t"

_TOKEN = re.compile(
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


class Kind(Enum):
    """What one operation of a formula does (вид действия)."""

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


@dataclass(frozen=True, slots=True)
class Operation:
    """One operation, which takes its operands from the results before it (действие).

    ``is_exact`` tells of a number whether float64 has it as it is written: 0.5, not 0.1.
    """

    kind: Kind
    name: str = ""
    value: float = 0.0
    is_exact: bool = True


@dataclass(frozen=True, slots=True)
class Formula:
    """A function of time (формула).

    Attributes
    ----------
    text : str
        As the file has it.
    operations : tuple of Operation
        In the order in which they are carried out, operands before what joins them.
    """

    text: str
    operations: tuple[Operation, ...]

    @property
    def is_constant(self) -> bool:
        """Whether time does not stand in it."""
        return all(operation.kind is not Kind.TIME for operation in self.operations)

    @property
    def in_degrees(self) -> Formula:
        """The same as it is read off a calculator that takes its arguments for degrees."""
        told = (
            replace(one, name=f"{one.name} deg") if one.name in ANGULAR else one
            for one in self.operations
        )
        return replace(self, operations=tuple(told))


class _FormulaError(Exception):
    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.hint = hint


def is_exact(text: str) -> bool:
    """Tell whether float64 has a number as it is written in decimal."""
    return Decimal(text) == Decimal(float(text))


def read_formula(
    faults: Faults, path: str, value: object, *, constant: bool = False
) -> Formula | None:
    """Read a formula, or a number in its place; None after noting a fault.

    Parameters
    ----------
    constant : bool
        Time may not stand in it.
    """
    if is_number(value):
        value = repr(value)
        if len(value) > LENGTH_LIMIT or value.strip("-") in ("inf", "nan"):
            faults.add(path, f"expected a finite number, got {short(value)}")
            return None
    if not isinstance(value, str):
        faults.add(path, f"expected a formula, got {show(value)}", 'For example: "3*t*exp(t/2)".')
        return None
    if len(value) > LENGTH_LIMIT:
        faults.add(path, f"the formula has {len(value)} characters, the limit is {LENGTH_LIMIT}")
        return None
    if lookalikes(value):
        faults.add(path, describe_lookalikes(value), "Type formulas in the Latin layout.")
    try:
        formula = Formula(value, tuple(_Parser(fold(value)).parse()))
    except _FormulaError as error:
        faults.add(path, str(error), error.hint)
        return None
    if constant and not formula.is_constant:
        faults.add(path, "expected a number or a formula without t", 'For example: "pi/2".')
        return None
    return formula


class _Parser:
    """Recursive descent with bounded depth; what is read becomes a row of operations."""

    def __init__(self, text: str) -> None:
        self.tokens = _tokens(text)
        self.at, self.depth = 0, 0
        self.made: list[Operation] = []

    def parse(self) -> list[Operation]:
        if len(self.tokens) == 1:
            raise _FormulaError("the formula is empty", 'For example: "4*t*(1 + t/2)".')
        self._sum()
        kind, text, where = self.tokens[self.at]
        if text == ")":
            raise _FormulaError(f"character {where}: ')' closes no '('")
        if kind != "end":
            before = self.tokens[self.at - 1][1]
            hint = f"Nothing is multiplied without a sign: write {before}*{short(text, 12)}."
            raise _FormulaError(f"character {where}: expected an operator before '{text}'", hint)
        return self.made

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
            self.made.append(Operation(Kind(sign)))

    def _signed(self) -> None:
        negative = False
        while self._text in ("+", "-"):
            negative ^= self._text == "-"
            self.at += 1
        self._power()
        if negative:
            self.made.append(Operation(Kind.MINUS))

    def _power(self) -> None:
        self._atom()
        if self._text in ("^", "**"):
            self._deeper()
            self._signed()
            self.depth -= 1
            self.made.append(Operation(Kind.POWER))

    def _atom(self) -> None:
        kind, text, where = self.tokens[self.at]
        if kind == "number":
            number = float(text)
            if not math.isfinite(number):
                raise _FormulaError(f"character {where}: the number {short(text, 12)} is too large")
            self.at += 1
            self.made.append(Operation(Kind.NUMBER, value=number, is_exact=is_exact(text)))
        elif kind == "name":
            self._name(text, where)
        elif text == "(":
            self._bracket()
        elif kind == "end":
            raise _FormulaError("the formula ends where a number or a name is expected")
        else:
            hint = 'A bracket holds something: "(1 + t)".' if text == ")" else ""
            raise _FormulaError(f"character {where}: expected a number, got '{text}'", hint)

    def _name(self, text: str, where: int) -> None:
        self.at += 1
        if text == TIME:
            self.made.append(Operation(Kind.TIME))
        elif text in CONSTANTS:
            self.made.append(Operation(Kind.CONSTANT, text, CONSTANTS[text]))
        elif text in FUNCTIONS:
            if self._text != "(":
                hint = f"Write {text}(t)."
                raise _FormulaError(f"character {where}: expected '(' after {text}", hint)
            self._bracket()
            self.made.append(Operation(Kind.CALL, FUNCTIONS[text]))
        else:
            known = (TIME, *CONSTANTS, *FUNCTIONS)
            guess = near(text, known)
            hint = f"Did you mean '{guess}'?" if guess else f"Known: {listed(known, limit=30)}."
            raise _FormulaError(f"character {where}: unknown name '{short(text)}'", hint)

    def _bracket(self) -> None:
        where = self.tokens[self.at][2]
        self._deeper()
        self._sum()
        if self._text != ")":
            _, text, place = self.tokens[self.at]
            if text:
                before = self.tokens[self.at - 1][1]
                hint = f"Nothing is multiplied without a sign: write {before}*{short(text, 12)}."
                raise _FormulaError(
                    f"character {place}: expected an operator before '{text}'", hint
                )
            raise _FormulaError(f"character {where}: '(' is not closed", "Add ')'.")
        self.at += 1
        self.depth -= 1

    def _deeper(self) -> None:
        self.at += 1
        self.depth += 1
        if self.depth > DEPTH_LIMIT:
            raise _FormulaError(f"the formula is nested deeper than {DEPTH_LIMIT} levels")

    @property
    def _text(self) -> str:
        return self.tokens[self.at][1]


def _tokens(text: str) -> list[tuple[str, str, int]]:
    """Return kind, text and place (from 1) of every token, and an end."""
    found: list[tuple[str, str, int]] = []
    at = 0
    while at < len(text):
        if text[at] == " ":
            at += 1
            continue
        match = _TOKEN.match(text, at)
        if match is None:
            char = text[at]
            shown = f"'{char}'" if char.isprintable() else f"U+{ord(char):04X}"
            message = f"character {at + 1}: {shown} has no meaning in a formula"
            raise _FormulaError(message, _INSTEAD.get(char, ""))
        found.append((str(match.lastgroup), match[0], at + 1))
        at = match.end()
    return [*found, ("end", "", len(text) + 1)]
