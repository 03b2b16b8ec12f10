"""Values that are calculated as they are written: with letters, then with numbers (выкладка).

A `Spelled` is a value together with its formula. Functions combine them as a student does: the
value, the letters and the numbers are made at once, so a printed sign is the one that was
calculated with. Terms that are always zero and factors of one are left out. Nothing is transformed.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from math import acos, atan2, cos, degrees, radians, sin, sqrt, tan
from typing import NamedTuple

from msgspec import Struct

from planmethod.note import formula
from planmethod.note.formula import Rich
from planmethod.note.numbers import MINUS, Notation, with_unit

ROUNDED = 1e-9
"""Size below which a value is written as zero, SI; of an angle in degrees, a thousand times it."""


_ZERO_RE = r"(?:\\frac\{)?0(?:\}|·|$)"
"""A product of numbers that begins with a zero: its sign is not written at the head of a sum."""


def shown(value: float, notation: Notation) -> Rich:
    """Return a value with five digits."""
    return "0" if abs(value) < ROUNDED else notation.short(value)


def shown_angle(value: float, notation: Notation) -> Rich:
    """Return an angle in degrees with five digits."""
    return f"{shown(value if abs(value) > 1e3 * ROUNDED else 0.0, notation)}°"


class Factor(NamedTuple):
    """A factor in letters and in numbers; a sum needs brackets beside other factors."""

    sides: tuple[Rich, Rich]
    is_sum: bool = False


class Spelled(Struct, frozen=True):
    """A value with its formula: a product with a sign (величина с записью).

    Attributes
    ----------
    value : float
    factors : tuple of Factor
        Without factors the value is one.
    sign : int
        Sign before the product; 0 if the value is always zero.
    terms : tuple of Spelled
        Those of a sum, which has no sign of its own.
    """

    value: float
    factors: tuple[Factor, ...] = ()
    sign: int = 1
    terms: tuple[Spelled, ...] = ()

    def __neg__(self) -> Spelled:
        """Return the opposite."""
        if self.terms:
            return total(*(-term for term in self.terms))
        return Spelled(-self.value, self.factors, -self.sign)

    @property
    def is_zero(self) -> bool:
        """Whether it is always zero."""
        return not self.sign

    @property
    def is_constant(self) -> bool:
        """Whether it is always 0, 1 or −1."""
        return not self.factors

    def sides(self) -> tuple[Rich, Rich]:
        """Return the formula in letters and in numbers."""
        return _joined([self], 0), _joined([self], 1)


ZERO, ONE = Spelled(0.0, (), 0), Spelled(1.0)


def named(symbol: Rich, value: float, notation: Notation) -> Spelled:
    """Return a value that has a letter."""
    return Spelled(value, (Factor((symbol, shown(value, notation))),))


def named_angle(symbol: Rich, value: float, notation: Notation) -> Spelled:
    """Return an angle that has a letter, degrees."""
    return Spelled(value, (Factor((symbol, shown_angle(value, notation))),))


def equation(symbol: Rich, value: Spelled, unit: str, notation: Notation) -> Rich:
    """Return the formula of a letter: letters, numbers, and the result with its unit.

    Parameters
    ----------
    unit : str
        Key of the unit, or the unit itself; ``°`` for an angle.
    """
    is_angle, letter = unit == "°", notation.units.get(unit, unit)
    result = (shown_angle if is_angle else shown)(value.value, notation)
    same = (result, f"{MINUS}{result}")  # the opposite of a zero is not written
    sides = (one for one in dict.fromkeys((symbol, *value.sides())) if one not in same)
    whole = with_unit(result, letter) if letter and not is_angle else result
    return " = ".join([*sides, whole])


def magnitude(value: Spelled) -> Spelled:
    """Return a letter's value without its sign."""
    if value.value >= 0.0:
        return value
    letters, numbers = (text.replace(MINUS, "") for text in value.sides())
    return Spelled(-value.value, (Factor((f"|{letters}|", numbers)),))


def number(value: float, notation: Notation) -> Spelled:
    """Return a given number, which has no letter."""
    if value in (0.0, 1.0, -1.0):
        return Spelled(value, (), int(value))
    text = notation.short(abs(value))
    return Spelled(value, (Factor((text, text)),), 1 if value > 0 else -1)


def degree(value: float, notation: Notation) -> Spelled:
    """Return a given angle, degrees."""
    if not value:
        return ZERO
    text = f"{notation.short(abs(value))}°"
    return Spelled(value, (Factor((text, text)),), 1 if value > 0 else -1)


def times(*values: Spelled) -> Spelled:
    """Return a product."""
    value, factors, sign = 1.0, tuple[Factor, ...](), 1
    several = [one for one in values if not one.is_constant]
    if len(several) == 1 and several[0].terms and all(one.sign for one in values):
        alone = [one.sign for one in values if one.is_constant].count(-1) % 2
        return -several[0] if alone else several[0]
    for one in values:
        value, factors, sign = value * one.value, factors + one.factors, sign * one.sign
    return Spelled(value, factors, sign) if sign else ZERO


def total(*values: Spelled) -> Spelled:
    """Return a sum; those among its terms are not put in brackets."""
    terms = [term for one in values for term in one.terms or (one,) if not term.is_zero]
    if len(terms) < 2:
        return terms[0] if terms else ZERO
    factor = Factor((_joined(terms, 0), _joined(terms, 1)), is_sum=True)
    return Spelled(sum(one.value for one in terms), (factor,), terms=tuple(terms))


def over(above: Spelled, below: Spelled) -> Spelled:
    """Return a quotient."""
    if above.is_zero or below.is_constant:
        return times(above, below)
    sign = above.sign * below.sign
    tops, bottoms = (Spelled(abs(one.value), one.factors).sides() for one in (above, below))
    if sign < 0 and tops[1].startswith(MINUS) and not above.terms:
        tops = tops[0], f"({tops[1]})"
    letters, numbers = (formula.fraction(*pair) for pair in zip(tops, bottoms, strict=True))
    factor = Factor((letters, numbers))
    return Spelled(above.value / below.value, (factor,), sign)


def squared(value: Spelled) -> Spelled:
    """Return a square."""
    if value.is_constant:
        return times(value, value)
    letters, numbers = (_bracketed([value], which) for which in (0, 1))
    return Spelled(value.value**2, (Factor((f"{letters}^{{2}}", f"{numbers}^{{2}}")),))


def root(value: Spelled) -> Spelled:
    """Return a square root; of a rounded zero below 0, zero."""
    size = sqrt(max(value.value, 0.0))
    letters, numbers = map(formula.root, value.sides())
    return Spelled(size, (Factor((letters, numbers)),))


def arccos(value: Spelled) -> Spelled:
    """Return an angle by its cosine, degrees."""
    angle = degrees(acos(max(-1.0, min(1.0, value.value))))
    letters, numbers = (f"arccos({side})" for side in value.sides())
    return Spelled(angle, (Factor((letters, numbers)),))


def angle_of(x: Spelled, y: Spelled, notation: Notation) -> Spelled:
    """Return the angle of a vector with projections x and y, degrees in (-180, 180]."""
    comma = "," if notation.decimal == "." else ";"
    pairs = zip(y.sides(), x.sides(), strict=True)
    letters, numbers = (f"atan2({one}{comma} {two})" for one, two in pairs)
    return Spelled(degrees(atan2(y.value, x.value)), (Factor((letters, numbers)),))


def cosine(angle: Spelled) -> Spelled:
    """Return the cosine of an angle in degrees."""
    return Spelled(cos(radians(angle.value)), (_function("cos", angle),))


def sine(angle: Spelled) -> Spelled:
    """Return the sine of an angle in degrees."""
    return Spelled(sin(radians(angle.value)), (_function("sin", angle),))


def tangent(angle: Spelled, name: Rich) -> Spelled:
    """Return the tangent of an angle in degrees; ``name`` is that of the function."""
    return Spelled(tan(radians(angle.value)), (_function(name, angle),))


def _function(name: str, angle: Spelled) -> Factor:
    letters, numbers = (_bracketed([angle], which) for which in (0, 1))
    blanks = ("" if text.startswith("(") else " " for text in (letters, numbers))
    return Factor((f"{name}{next(blanks)}{letters}", f"{name}{next(blanks)}{numbers}"))


def _bracketed(terms: Iterable[Spelled], which: int) -> Rich:
    """Return a sum for a power or a function: in brackets unless it is one sign."""
    text = _joined(terms, which)
    plain = not any(sign in text for sign in (" ", "·", "\\frac")) and not text.startswith(MINUS)
    return text if plain else f"({text})"


def _joined(terms: Iterable[Spelled], which: int) -> Rich:
    text = ""
    for term in terms:
        product = _product(term, which, leads=not text and term.sign > 0)
        sign = MINUS if term.sign < 0 else "+"
        if text:
            text += f" {sign} {product}"
        else:
            plain = term.sign > 0 or re.match(_ZERO_RE, product)
            text = product if plain else f"{sign}{product}"
    return text or "0"


def _product(term: Spelled, which: int, *, leads: bool) -> Rich:
    if term.is_constant:
        return "1" if term.sign else "0"
    found = list[Rich]()
    for factor in term.factors:
        text, alone = factor.sides[which], len(term.factors) == 1
        closed = not factor.is_sum or (alone and leads)
        minus = text.startswith(MINUS) and not factor.is_sum and not (leads and not found)
        found.append(text if closed and not minus else f"({text})")
    return "·".join(found)
