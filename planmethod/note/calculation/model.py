"""A calculation as data: chapters of quantities with formulas and values (расчёт по формулам).

A `CalculationBuilder` reads each formula as it is printed, calculates it, and compares the result
with the program's value. A formula that does not give this value is not kept: the quantity is then
a value. So whatever is written of a calculation agrees with the note.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain
from typing import Any

import numpy as np
from msgspec import Struct

from planmethod.note.calculation.expression import (
    Accumulated,
    Expression,
    UnreadableFormulaError,
    Values,
    evaluate,
    names_of,
    read_expression,
)
from planmethod.note.calculation.names import NameRegistry
from planmethod.note.formula import Rich

AGREE = 1e-9
"""Difference of a formula and its value that is a rounding, relative to the row's largest one."""

ROUNDING = 1e-12
"""Relative difference of a given number and of the formula that it was calculated by."""


class Quantity(Struct, frozen=True):
    """A quantity of a calculation: a number, or a row of them by positions (величина).

    Attributes
    ----------
    name : str
        By which formulas refer to it.
    symbol : Rich
    unit : Rich
    values : tuple of float
        One of a number; NaN where a row has none.
    formulas : tuple of Expression or None
        As many: None of a value that is given or computed by the program.
    is_row : bool
    is_input : bool
        It is an input: other quantities are calculated from it again if it changes.
    remark : str
        What it is, or why it has no formula.
    """

    name: str
    symbol: Rich
    unit: Rich
    values: tuple[float, ...]
    formulas: tuple[Expression | None, ...]
    is_row: bool = False
    is_input: bool = False
    remark: str = ""

    @property
    def formula(self) -> Expression | None:
        """Formula of all its values, if they have the same one."""
        first = self.formulas[0]
        return first if all(one == first for one in self.formulas) else None


class Heading(Struct, frozen=True):
    """A heading among the quantities, or a sentence (подзаголовок)."""

    text: str
    is_sentence: bool = False


class Equations(Struct, frozen=True):
    """Linear equations for some quantities (линейные уравнения).

    Attributes
    ----------
    names : tuple of str
        What each equation says: the mesh.
    coefficients : tuple of tuple of Expression
    right : tuple of Expression
    unknowns : tuple of Quantity
    """

    names: tuple[str, ...]
    coefficients: tuple[tuple[Expression, ...], ...]
    right: tuple[Expression, ...]
    unknowns: tuple[Quantity, ...]


class CalculationChapter(Struct, frozen=True):
    """A chapter, a sheet of the workbook (глава расчёта).

    Attributes
    ----------
    heads : tuple of str
        Of the positions; empty where all quantities are numbers.
    """

    title: str
    items: tuple[Quantity | Heading | Equations, ...]
    heads: tuple[str, ...] = ()

    def quantities(self) -> Iterator[Quantity]:
        """Yield its quantities in order."""
        for item in self.items:
            if isinstance(item, Quantity):
                yield item
            elif isinstance(item, Equations):
                yield from item.unknowns


class LivingCalculation(Struct, frozen=True):
    """A whole calculation: its given data are the first chapter (расчёт)."""

    title: str
    chapters: tuple[CalculationChapter, ...]


class CalculationBuilder:
    """Makes the chapters of a calculation, whose quantities refer to each other (составитель).

    Parameters
    ----------
    not_reproduced : str
        Remark on a value that no formula gives.
    """

    def __init__(self, not_reproduced: str) -> None:
        self.not_reproduced = not_reproduced
        self.registry = NameRegistry()
        self.values: dict[str, Values] = {"pi": np.asarray(np.pi)}
        self.symbols: dict[Rich, str] = {}
        self.owner = ""
        self._letters_of = {"": self.symbols}
        self.input_items: list[Quantity | Heading | Equations] = []
        self.items: list[Quantity | Heading | Equations] = []
        self.chapters: list[CalculationChapter] = []
        self.in_radians = frozenset[str]()

    # Chapters ----------------------------------------------------------------------------------

    def close(self, title: str, heads: Sequence[str] = ()) -> None:
        """End a chapter."""
        if self.items:
            self.chapters.append(CalculationChapter(title, tuple(self.items), tuple(heads)))
        self.items = []

    def finished(self, title: str, inputs_title: str) -> LivingCalculation:
        """Return the calculation; ``inputs_title`` is that of the given data."""
        first = CalculationChapter(inputs_title, tuple(self.input_items))
        return LivingCalculation(title, (first, *self.chapters))

    def add_heading(self, text: str, *, is_sentence: bool = False) -> None:
        """Write a heading or a sentence."""
        if text:
            self.items.append(Heading(text, is_sentence))

    def enter(self, owner: str, title: str = "") -> None:
        """Go to the letters of one of several equal parts, as cams; ``""`` are the common letters.

        Parameters
        ----------
        owner : str
            Names of its quantities end with it.
        title : str, optional
            Heading of its given data.
        """
        self.owner = owner
        self.symbols = self._letters_of.setdefault(owner, {})
        if title:
            self.input_items.append(Heading(title))

    def new_name(self, symbol: Rich) -> str:
        """Return a name for a letter that no other quantity has."""
        return self.registry.new(symbol, self.owner)

    # Quantities --------------------------------------------------------------------------------

    def _added(self, quantity: Quantity, *, among_given: bool = False) -> Quantity:
        (self.input_items if among_given else self.items).append(quantity)
        whole = np.array(quantity.values)
        self.values[quantity.name] = whole if quantity.is_row else whole[0]
        self.symbols[quantity.symbol] = quantity.name
        return quantity

    def add_input(self, symbol: Rich, value: float, unit: Rich = "", remark: str = "") -> Quantity:
        """Add a given number; one that is known by its letter already is that quantity."""
        known = self.symbols.get(symbol)
        if known is not None and self._is_value_of(known, value):
            chapters = (chapter.items for chapter in self.chapters)
            return next(
                one
                for one in chain(self.input_items, self.items, *chapters)
                if isinstance(one, Quantity) and one.name == known
            )
        one = Quantity(self.new_name(symbol), symbol, unit, (float(value),), (None,),
                       is_input=True, remark=remark)  # fmt: skip
        return self._added(one, among_given=True)

    def _is_value_of(self, name: str, value: float) -> bool:
        """Return whether a number is that of a name, but for the rounding of a formula."""
        known = self.values[name]
        return known.shape == () and bool(abs(known - value) <= ROUNDING * abs(value))

    def value(
        self, symbol: Rich, value: float | Sequence[float], unit: Rich = "", remark: str = "",
        *, is_input: bool = False,
    ) -> Quantity:  # fmt: skip
        """Add a value of this chapter: an input, or a number that only the program computes."""
        is_row = not isinstance(value, float | int)
        values = tuple(map(float, value)) if not isinstance(value, float | int) else (float(value),)
        name = self.new_name(symbol)
        one = Quantity(name, symbol, unit, values, (None,) * len(values), is_row, is_input, remark)
        return self._added(one)

    def formula(
        self, symbol: Rich, letters: Rich | Expression, value: float, unit: Rich = "",
        remark: str = "",
    ) -> Quantity:  # fmt: skip
        """Add a number by a formula in letters."""
        return self._checked(symbol, [letters], (value,), unit, remark, is_row=False)

    def row(
        self, symbol: Rich, letters: Rich | Expression | Sequence[Rich | Expression | None],
        values: Sequence[float] | Values, unit: Rich = "", remark: str = "",
        *, by_position: bool = False,
    ) -> Quantity:  # fmt: skip
        """Add a row by one formula, or by one for each of its positions.

        Parameters
        ----------
        by_position : bool, optional
            A position has its own formula, also where that of another one has the same value.
        """
        is_one = isinstance(letters, str | Struct)
        several: list[Any] = [letters] * len(values) if is_one else [*letters]  # type: ignore[misc]
        told = tuple(map(float, values))
        return self._checked(
            symbol, several, told, unit, remark, is_row=True, by_position=by_position
        )

    def derived(self, symbol: Rich, letters: Rich, count: int, unit: Rich = "") -> Quantity:
        """Add a row that is only a step of a calculation: its values are those of the formula."""
        expression = read_expression(letters, self.symbols, in_radians=self.in_radians)
        return self.row(symbol, expression, self._calculated(expression, count).tolist(), unit)

    def add_equations(self, equations: Equations) -> None:
        """Add linear equations, whose unknowns are known from then on."""
        self.items.append(equations)
        for one in equations.unknowns:
            self.values[one.name] = np.array(one.values[0])
            self.symbols[one.symbol] = one.name

    def read(self, letters: Rich) -> Expression | None:
        """Return the expression of a formula in known letters; None of another text."""
        try:
            return read_expression(letters, self.symbols, in_radians=self.in_radians)
        except UnreadableFormulaError:
            return None

    def _checked(
        self, symbol: Rich, letters: Sequence[Rich | Expression | None],
        values: tuple[float, ...], unit: Rich, remark: str,
        *, is_row: bool, by_position: bool = False,
    ) -> Quantity:  # fmt: skip
        read = {one: self.read(one) for one in {*letters} if isinstance(one, str)}
        found: list[Expression | None] = [
            read[one] if isinstance(one, str) else one for one in letters
        ]
        # Where a term is zero a position leaves it out: the longest formula has all terms.
        several = sorted({one for one in found if one is not None}, key=_size, reverse=True)
        calculated = {one: self._calculated(one, len(values)) for one in several}
        largest = max([abs(v) for v in values if np.isfinite(v)], default=0.0)
        limit = AGREE * max(largest, 1e-9)
        formulas: list[Expression | None] = [None] * len(values)
        kept = [*values]
        for k, value in enumerate(values):
            tried: Sequence[Expression | None] = found[k : k + 1] if by_position else several
            for one in tried:
                if one is None:
                    continue
                own = calculated[one][k]
                if np.isnan(value) and np.isfinite(own):
                    kept[k], formulas[k] = float(own), one
                elif _near(own, value, limit, unit):
                    formulas[k] = one
                if formulas[k] is not None:
                    break
        if None in formulas and any(isinstance(one, Accumulated) for one in formulas):
            formulas = [None] * len(values)  # a sum needs all that is before it
        missing = any(
            one is None and np.isfinite(v) for one, v in zip(formulas, values, strict=True)
        )
        note = " ".join(filter(None, (remark, self.not_reproduced if missing else "")))
        first = formulas[0]
        if is_row and first is not None and all(one == first for one in formulas):
            is_row = any(self.values[name].shape for name in names_of(first))
            kept, formulas = (kept, formulas) if is_row else (kept[:1], formulas[:1])
        name = self.new_name(symbol)
        made = Quantity(name, symbol, unit, tuple(kept), tuple(formulas), is_row, remark=note)
        return self._added(made)

    def _calculated(self, expression: Expression, count: int) -> Values:
        with np.errstate(all="ignore"):
            found = evaluate(expression, self.values)
        return np.broadcast_to(found, (count,))


def _size(expression: Expression) -> tuple[int, str]:
    """Return how many quantities a formula has, and what distinguishes equal numbers of them."""
    return len([*names_of(expression)]), repr(expression)


def _near(calculated: float, value: float, limit: float, unit: Rich) -> bool:
    """Return whether a formula gives a value; an angle counts without whole turns."""
    off = abs(calculated - value)
    return bool(off <= limit or (unit == "°" and abs((off + 180.0) % 360.0 - 180.0) <= limit))
