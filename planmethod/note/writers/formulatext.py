"""Expressions as text: for a workbook, for Python, for a reader (запись выражений)."""

from __future__ import annotations

from typing import Protocol, assert_never

from planmethod.note.calculation.expression import (
    Accumulated,
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Operation,
)

# no messages: source of programs

_LEVEL = {"+": 1, "-": 1, "*": 2, "/": 2, "^": 4}
_ATOM = 5


class Dialect(Protocol):
    """How a program writes what differs between programs."""

    power: str

    def name(self, name: str) -> str:
        """Return a quantity."""

    def call(self, function: str, arguments: list[str]) -> str:
        """Return a function of written arguments."""

    def accumulated(self, of: str, step: str) -> str:
        """Return the integral of a row by trapezoids."""


def number_text(value: float) -> str:
    """Return a number as programs read it, a whole one without a point."""
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(float(value))


def written(expression: Expression, dialect: Dialect) -> str:
    """Return an expression in a dialect, with the brackets that it needs."""
    return _written(expression, dialect)[0]


def _written(expression: Expression, dialect: Dialect) -> tuple[str, int]:
    """Return the text of an expression, and how tightly its last operation binds."""
    match expression:
        case Number(value):
            return number_text(value), _ATOM if value >= 0 else 1
        case Name(name):
            return dialect.name(name), _ATOM
        case Negative(of):
            text, level = _written(of, dialect)
            # A workbook takes the sign before a power first, Python last: brackets for both.
            return f"-({text})" if level < 2 or level == _LEVEL["^"] else f"-{text}", 1
        case Operation(sign, left, right):
            own = _LEVEL[sign]
            one, first = _written(left, dialect)
            two, second = _written(right, dialect)
            is_power = sign == "^"
            one = f"({one})" if first < own or (is_power and first < _ATOM) else one
            closed = (
                second < own or (second == own and sign in "-/") or (second < _ATOM and is_power)
            )
            two = f"({two})" if closed or two.startswith("-") else two
            return (f"{one}{dialect.power}{two}" if is_power else f"{one}{sign}{two}"), own
        case Call(function, operands):
            told = [written(one, dialect) for one in operands]
            return dialect.call(function, told), _ATOM
        case Accumulated(of, step):
            return dialect.accumulated(of.name, step.name), _ATOM
        case _:
            assert_never(expression)


class ReaderText:
    """Expressions for a reader: names of the workbook, functions of angles in degrees."""

    power = "^"

    def name(self, name: str) -> str:
        """Return a quantity."""
        return "π" if name == "pi" else name

    def call(self, function: str, arguments: list[str]) -> str:
        """Return a function."""
        return f"{function}({'; '.join(arguments)})"

    def accumulated(self, of: str, step: str) -> str:
        """Return the integral of a row."""
        return f"Σ ({of}[k-1]+{of}[k])/2*{step}"


class PythonText:
    """Expressions of Python with the functions of `PRELUDE`; one element of rows, or all of them.

    Parameters
    ----------
    rows : frozenset of str
    index : int or None
        Element of the rows that is meant; None for all.
    """

    power = "**"

    def __init__(self, rows: frozenset[str], index: int | None = None) -> None:
        self.rows, self.index = rows, index

    def name(self, name: str) -> str:
        """Return a quantity."""
        return name if self.index is None or name not in self.rows else f"{name}[{self.index}]"

    def call(self, function: str, arguments: list[str]) -> str:
        """Return a function."""
        told = ", ".join(arguments)
        match function:
            case "cos" | "sin" | "tan":
                return f"{function}d({told})"
            case "arccos" | "arcsin" | "arctan":
                return f"np.degrees(np.{function}({told}))"
            case "atan2":
                return f"np.degrees(np.arctan2({told}))"
            case "inv":
                return f"involute({told})"
            case "last" | "first":
                return f"{told}[{-1 if function == 'last' else 0}]"
            case "count":
                return f"len({told})"
            case _:
                return f"np.{function}({told})"

    def accumulated(self, of: str, step: str) -> str:
        """Return the integral of a row."""
        return f"np.append(0, np.cumsum(({of}[1:] + {of}[:-1])/2*{step}))"


PRELUDE = """import numpy as np
from numpy import pi

def cosd(x): return np.cos(np.radians(x))
def sind(x): return np.sin(np.radians(x))
def tand(x): return np.tan(np.radians(x))
def involute(x): return tand(x) - np.radians(x)
"""
"""Functions of angles in degrees that programs define."""


class CellText:
    """Expressions of a workbook: names of cells; a row is taken in the cell's own column.

    Parameters
    ----------
    before, here : dict of str to str
        Address of each row in the column on the left and in the cell's own; ``before[""]`` is that
        of the cell on the left. The first column has nothing before.
    """

    power = "^"

    def __init__(self, before: dict[str, str], here: dict[str, str]) -> None:
        self.before, self.here = before, here

    def name(self, name: str) -> str:
        """Return a quantity."""
        return "PI()" if name == "pi" else name

    def call(self, function: str, arguments: list[str]) -> str:
        """Return a function."""
        told = ",".join(arguments)
        match function:
            case "cos" | "sin" | "tan":
                return f"{function.upper()}(RADIANS({told}))"
            case "arccos" | "arcsin" | "arctan":
                return f"DEGREES(A{function[3:].upper()}({told}))"
            case "atan2":
                return f"DEGREES(ATAN2({arguments[1]},{arguments[0]}))"  # x comes first
            case "inv":
                return f"(TAN(RADIANS({told}))-RADIANS({told}))"
            case "last":
                return f"INDEX({told},1,COLUMNS({told}))"
            case "first":
                return f"INDEX({told},1,1)"
            case "count":
                return f"COLUMNS({told})"
            case _:
                return f"{function.upper()}({told})"

    def accumulated(self, of: str, step: str) -> str:
        """Return the integral of a row: what the cell on the left has, and one trapezoid."""
        if not self.before:
            return "0"
        return f"{self.before['']}+({self.before[of]}+{self.here[of]})/2*{step}"
