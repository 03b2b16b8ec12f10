r"""Formulas of a text read as expressions, which programs calculate (формула как выражение).

A formula in letters is read as it is printed: ``\frac{l_{AB}^{2} + d^{2}}{2·l_{AB}}``. Its letters
become names of a calculation. Angles are in degrees, as in texts. The same expression is evaluated,
and written for a workbook and for a Python program by the writers.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeAlias, assert_never

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.note.formula import Rich

Values: TypeAlias = npt.NDArray[Any]


class Number(Struct, frozen=True):
    """A number (число)."""

    value: float


class Name(Struct, frozen=True):
    """A quantity of the calculation by its name (величина)."""

    name: str


class Negative(Struct, frozen=True):
    """The opposite of an expression (противоположное)."""

    of: Expression


class Operation(Struct, frozen=True):
    """Two expressions with a sign between them: ``+ - * / ^`` (действие)."""

    sign: str
    left: Expression
    right: Expression


class Call(Struct, frozen=True):
    """A function of `FUNCTIONS` with its arguments (функция)."""

    function: str
    operands: tuple[Expression, ...]


class Accumulated(Struct, frozen=True):
    """The integral of a row from its first position, by trapezoids (нарастающий интеграл)."""

    of: Name
    step: Name


Expression: TypeAlias = Number | Name | Negative | Operation | Call | Accumulated


class UnreadableFormulaError(ValueError):
    """A text that is not a formula in known letters."""


def _involute(angle: Values) -> Values:
    return np.asarray(np.tan(np.radians(angle)) - np.radians(angle))


FUNCTIONS: dict[str, Callable[..., Any]] = {
    "cos": lambda x: np.cos(np.radians(x)),
    "sin": lambda x: np.sin(np.radians(x)),
    "tan": lambda x: np.tan(np.radians(x)),
    "arccos": lambda x: np.degrees(np.arccos(x)),
    "arcsin": lambda x: np.degrees(np.arcsin(x)),
    "arctan": lambda x: np.degrees(np.arctan(x)),
    "atan2": lambda y, x: np.degrees(np.arctan2(y, x)),
    "inv": _involute,
    "sqrt": np.sqrt,
    "abs": np.abs,
    "radians": np.radians,
    "degrees": np.degrees,
    "mod": np.mod,
    "max": np.max,
    "min": np.min,
    "last": lambda x: x[-1],
    "first": lambda x: x[0],
    "count": np.size,
}
"""Functions by name: trigonometry in degrees; ``max`` to ``count`` are of a whole row."""

OF_ROW = ("max", "min", "last", "first", "count")
"""Functions that make one number of a row."""

_CALLED = {"tg": "tan", "arctg": "arctan"}
_FUNCTION_RE = re.compile(r"(arccos|arcsin|arctan|arctg|atan2|cos|sin|tan|tg|inv)(?![a-z_])")
_NUMBER_RE = re.compile(r"\d+(?:[.,]\d+)?")
_OPERATORS = {"+": "+", "−": "-", "-": "-", "·": "*", "×": "*", "/": "/"}


def evaluate(expression: Expression, values: Mapping[str, Values]) -> Values:
    """Return the value of an expression; a row where a name in it has one.

    Parameters
    ----------
    values : mapping of str to ndarray
        Of names: shape () of a number, (n,) of a row.
    """
    match expression:
        case Number(value):
            return np.asarray(value)
        case Name(name):
            return values[name]
        case Negative(of):
            return -evaluate(of, values)
        case Operation(sign, left, right):
            one, two = evaluate(left, values), evaluate(right, values)
            return np.asarray(_OPERATIONS[sign](one, two))
        case Call(function, operands):
            told = (evaluate(one, values) for one in operands)
            return np.asarray(FUNCTIONS[function](*told))
        case Accumulated(of, step):
            row = evaluate(of, values)
            parts = (row[1:] + row[:-1]) / 2.0 * evaluate(step, values)
            return np.concatenate([[0.0], np.cumsum(parts)])
        case _:
            assert_never(expression)


_OPERATIONS: dict[str, Callable[..., Any]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.divide,
    "^": np.power,
}


def names_of(expression: Expression) -> Iterator[str]:
    """Yield the names in an expression."""
    match expression:
        case Number():
            return
        case Name(name):
            yield name
        case Negative(of):
            yield from names_of(of)
        case Operation(_, left, right):
            yield from names_of(left)
            yield from names_of(right)
        case Call(_, operands):
            for one in operands:
                yield from names_of(one)
        case Accumulated(of, step):
            yield from (of.name, step.name)
        case _:
            assert_never(expression)


def read_expression(
    letters: Rich, symbols: Mapping[Rich, str], *, in_radians: frozenset[str] = frozenset()
) -> Expression:
    """Return the expression of a formula in letters.

    Parameters
    ----------
    letters : Rich
    symbols : mapping of Rich to str
        Names of the known letters.
    in_radians : frozenset of str, optional
        Names of angles in degrees that a formula has in radians outside of trigonometry.

    Raises
    ------
    UnreadableFormulaError
        A letter is unknown, or the text is not a formula.
    """
    return _Reader(letters, symbols, in_radians).read()


class _Reader:
    """Reads one formula from left to right."""

    def __init__(self, text: Rich, symbols: Mapping[Rich, str], in_radians: frozenset[str]) -> None:
        self.text, self.at, self.in_radians = text.replace("\u00a0", " "), 0, in_radians
        self.symbols = symbols
        self.longest = sorted(symbols, key=len, reverse=True)

    def read(self) -> Expression:
        found = self._sum()
        self._skip()
        if self.at < len(self.text):
            raise self._fault()
        return found

    def _fault(self) -> UnreadableFormulaError:
        return UnreadableFormulaError(f"{self.text!r} at {self.at}")

    def _skip(self) -> None:
        while self.text.startswith(" ", self.at):
            self.at += 1

    def _accept(self, sign: str) -> bool:
        self._skip()
        found = self.text.startswith(sign, self.at)
        self.at += len(sign) * found
        return found

    def _expect(self, sign: str) -> None:
        if not self._accept(sign):
            raise self._fault()

    def _sum(self) -> Expression:
        found = self._term()
        while True:
            self._skip()
            sign = _OPERATORS.get(self.text[self.at : self.at + 1], "")
            if sign not in ("+", "-"):
                return found
            self.at += 1
            found = Operation(sign, found, self._term())

    def _term(self) -> Expression:
        if self._accept("−") or self._accept("-"):
            return Negative(self._term())
        found = self._power()
        while True:
            self._skip()
            following = self.text[self.at : self.at + 1]
            sign = _OPERATORS.get(following, "")
            if sign in ("*", "/"):
                self.at += 1
                if self._accept("−"):
                    found = Operation(sign, found, Negative(self._power()))
                else:
                    found = Operation(sign, found, self._power())
            elif isinstance(found, Number) and self._starts_symbol():
                found = Operation("*", found, self._power())
            else:
                return found

    def _power(self) -> Expression:
        found = self._atom()
        while self.text.startswith("^{", self.at):
            self.at += 2
            found = Operation("^", found, self._sum())
            self._expect("}")
        return found

    def _starts_symbol(self) -> bool:
        return self._symbol() is not None

    def _symbol(self) -> Rich | None:
        """Return the longest known letter that the text goes on with."""
        for symbol in self.longest:
            if not self.text.startswith(symbol, self.at):
                continue
            after = self.text[self.at + len(symbol) :]
            if after[:1] == "_" or (symbol[-1:].isalpha() and after[:1].isalnum()):
                continue
            return symbol
        return None

    def _atom(self) -> Expression:
        self._skip()
        for opening, closing in (("(", ")"), ("[", "]")):
            if self._accept(opening):
                found = self._sum()
                self._expect(closing)
                return found
        if self._accept("|"):
            found = self._sum()
            self._expect("|")
            return Call("abs", (found,))
        if self._accept("\\frac{"):
            above = self._sum()
            self._expect("}{")
            below = self._sum()
            self._expect("}")
            return Operation("/", above, below)
        if self._accept("\\sqrt{"):
            found = self._sum()
            self._expect("}")
            return Call("sqrt", (found,))
        if number := _NUMBER_RE.match(self.text, self.at):
            self.at = number.end()
            value = Number(float(number[0].replace(",", ".")))
            self._accept("°")
            return value
        symbol = self._symbol()
        if symbol is not None:
            self.at += len(symbol)
            name = Name(self.symbols[symbol])
            return Call("radians", (name,)) if name.name in self.in_radians else name
        if called := _FUNCTION_RE.match(self.text, self.at):
            self.at = called.end()
            return self._called(_CALLED.get(called[1], called[1]))
        if self._accept("π"):
            return Name("pi")
        raise self._fault()

    def _called(self, function: str) -> Expression:
        """Read the power and the argument of a function: in brackets, or one letter."""
        power: Expression | None = None
        if self.text.startswith("^{", self.at):
            self.at += 2
            power = self._sum()
            self._expect("}")
        radians, self.in_radians = self.in_radians, frozenset()
        self._skip()
        if function == "atan2":
            self._expect("(")
            first = self._sum()
            if not (self._accept(";") or self._accept(",")):
                raise self._fault()
            found = Call(function, (first, self._sum()))
            self._expect(")")
        else:
            found = Call(function, (self._atom(),))
        self.in_radians = radians
        return found if power is None else Operation("^", found, power)
