"""Formulas read in jets: values with first and second derivative in time, exact but for rounding.

The parts of a jet are `Bounded` numbers over all moments at once: zero is distinguished from
rounding residue. Otherwise a point at rest would have a velocity of 1e-16, and a straight line a
curvature.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planmethod.construct.jet import Jet
from planmethod.moving.model import TimeFunction
from planmethod.problem.formula import FormulaKind

Reals = NDArray[np.float64]

ROUNDOFF = 2.0**-53
FUNCTION_ROUNDOFF = 8 * ROUNDOFF
"""Bound of the relative error of NumPy's functions."""


class Bounded:
    """Values and how far each may be off, to first order (число с границей погрешности).

    Attributes
    ----------
    value, radius : array of float
        Shapes broadcast against each other.
    """

    __slots__ = ("radius", "value")
    __array_ufunc__ = None

    def __init__(self, value: Any, radius: Any = 0.0) -> None:
        self.value: Any = np.asarray(value, dtype=np.float64)
        self.radius: Any = np.asarray(radius, dtype=np.float64)

    def __neg__(self) -> Bounded:
        return Bounded(-self.value, self.radius)

    def __add__(self, other: Any) -> Bounded:
        other = bounded(other)
        value = self.value + other.value
        return Bounded(value, self.radius + other.radius + ROUNDOFF * np.abs(value))

    __radd__ = __add__

    def __sub__(self, other: Any) -> Bounded:
        return self + -bounded(other)

    def __rsub__(self, other: Any) -> Bounded:
        return bounded(other) + -self

    def __mul__(self, other: Any) -> Bounded:
        other = bounded(other)
        value = self.value * other.value
        spread = np.abs(self.value) * other.radius + np.abs(other.value) * self.radius
        return Bounded(value, spread + ROUNDOFF * np.abs(value))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Bounded:
        """Divide; NaN where the divisor may be zero."""
        other = bounded(other)
        by = np.where(np.abs(other.value) <= other.radius, np.nan, other.value)
        value = self.value / by
        spread = (self.radius + np.abs(value) * other.radius) / np.abs(by)
        return Bounded(value, spread + ROUNDOFF * np.abs(value))

    def __rtruediv__(self, other: Any) -> Bounded:
        quotient: Bounded = bounded(other) / self
        return quotient

    def __abs__(self) -> Bounded:
        return Bounded(np.abs(self.value), self.radius)

    def rounded_to_zero(self) -> Bounded:
        """Return the values with exact zeros where they are zero within the bound of rounding.

        A value that is infinite, or has an infinite bound, is NaN.
        """
        value = np.where(np.isfinite(self.value + self.radius), self.value, np.nan)
        nothing = np.abs(value) <= self.radius
        return Bounded(np.where(nothing, 0.0, value), np.where(nothing, 0.0, self.radius))


def bounded(value: Any) -> Bounded:
    """Return a number as it is, or given data as exact."""
    return value if isinstance(value, Bounded) else Bounded(value)


def length(x: Bounded, y: Bounded) -> Bounded:
    """Return the length of a vector; zero exactly where both components are."""
    value = np.hypot(x.value, y.value)
    size = np.where(value == 0.0, 1.0, value)
    spread = (np.abs(x.value) * x.radius + np.abs(y.value) * y.radius) / size
    return Bounded(value, spread + FUNCTION_ROUNDOFF * value)


Derivatives = tuple[Any, Any, Any, Any]
"""A function and its first three derivatives, at given values."""


def evaluate(formula: TimeFunction, times: Reals, *, blur: Reals | float = 0.0) -> Jet:
    """Return the values of a formula, its rates and the rates of those.

    Parameters
    ----------
    times : array of float, shape (n,)
    blur : array of float, shape (n,), or float
        Relative errors of the times; 0 where they are exact.

    Returns
    -------
    Jet
        Of `Bounded` parts; NaN or infinite where the formula has no value.
    """
    stack: list[tuple[Jet, bool]] = []
    with np.errstate(all="ignore"):
        for operation in formula.operations:
            match operation.kind:
                case FormulaKind.NUMBER | FormulaKind.CONSTANT:
                    is_exact = operation.kind is FormulaKind.NUMBER and operation.is_exact
                    radius = 0.0 if is_exact else ROUNDOFF * operation.value
                    stack.append((Jet(Bounded(operation.value, radius)), True))
                case FormulaKind.TIME:
                    now = Bounded(times, blur * np.abs(times))
                    stack.append((Jet(now, Bounded(1.0), Bounded(0.0)), False))
                case FormulaKind.MINUS:
                    jet, is_constant = stack.pop()
                    stack.append((-jet, is_constant))
                case FormulaKind.CALL:
                    jet, is_constant = stack.pop()
                    stack.append(({**CALLS, **DEGREES}[operation.name](jet), is_constant))
                case _:
                    (right, of_right), (left, of_left) = stack.pop(), stack.pop()
                    made = _joined(operation.kind, left, right, steady=of_right)
                    stack.append((made, of_left and of_right))
    ((jet, _),) = stack
    return Jet(*(_spread(part, times) for part in jet.parts()))


def _spread(part: Any, times: Reals) -> Bounded:
    one = bounded(part)
    shape = times.shape
    return Bounded(np.broadcast_to(one.value, shape), np.broadcast_to(one.radius, shape))


def _joined(kind: FormulaKind, left: Jet, right: Jet, *, steady: bool) -> Jet:
    if kind is FormulaKind.ADD:
        return left + right
    if kind is FormulaKind.SUBTRACT:
        return left - right
    if kind is FormulaKind.MULTIPLY:
        return left * right
    if kind is FormulaKind.DIVIDE:
        return left / right
    return _raised(left, right.value) if steady else CALLS["exp"](right * CALLS["ln"](left))


def _raised(base: Jet, power: Bounded) -> Jet:
    """Return a jet to a constant power; a negative base has whole powers only."""
    exponent = float(power.value)
    if exponent == np.rint(exponent) or not power.radius:
        power = Bounded(exponent)

    def derivatives(x: Any) -> Derivatives:
        found, factor = [], 1.0
        for k in range(4):
            found.append(factor * x ** (exponent - k) if factor else 0.0 * x)
            factor *= exponent - k
        return found[0], found[1], found[2], found[3]

    made = _composed(base, derivatives, edge=True)
    if power.radius:
        size = np.abs(bounded(base.value).value)
        slope = float(power.radius) * (np.abs(np.log(np.where(size == 0.0, 1.0, size))) + 1.0)
        for part in made.parts():
            part.radius = part.radius + slope * np.abs(part.value)
    return made


def _composed(inner: Jet, derivatives: Callable[[Any], Derivatives], *, edge: bool = False) -> Jet:
    """Return a function of a jet, by the rule of the chain; ``edge``: its domain ends at zero."""
    f, f1, f2 = (bounded(part) for part in inner.parts())
    f = f.rounded_to_zero() if edge else f
    d = derivatives(f.value)

    def part(k: int) -> Bounded:
        moved = np.where(f.radius == 0.0, 0.0, np.abs(d[k + 1]) * f.radius)
        return Bounded(d[k], moved + FUNCTION_ROUNDOFF * np.abs(d[k]))

    return Jet(part(0), part(1) * f1, part(2) * f1 * f1 + part(1) * f2)


# Functions: x are values, what comes back the function and three derivatives -------------------


def _sin(x: Any) -> Derivatives:
    s, c = np.sin(x), np.cos(x)
    return s, c, -s, -c


def _cos(x: Any) -> Derivatives:
    s, c = np.sin(x), np.cos(x)
    return c, -s, -c, s


def _sin_deg(x: Any) -> Derivatives:
    return _sin(np.radians(x))


def _cos_deg(x: Any) -> Derivatives:
    return _cos(np.radians(x))


def _exp(x: Any) -> Derivatives:
    y = np.exp(x)
    return y, y, y, y


def _ln(x: Any) -> Derivatives:
    x = np.where(x > 0.0, x, np.nan)
    return np.log(x), 1.0 / x, -1.0 / x**2, 2.0 / x**3


def _sqrt(x: Any) -> Derivatives:
    y = np.sqrt(x)
    return y, 0.5 / y, -0.25 / y**3, 0.375 / y**5


def _sh(x: Any) -> Derivatives:
    s, c = np.sinh(x), np.cosh(x)
    return s, c, s, c


def _ch(x: Any) -> Derivatives:
    s, c = np.sinh(x), np.cosh(x)
    return c, s, c, s


def _th(x: Any) -> Derivatives:
    y, w = np.tanh(x), 1.0 / np.cosh(x) ** 2
    return y, w, -2.0 * y * w, w * (6.0 * y**2 - 2.0)


def _arcsin(x: Any) -> Derivatives:
    w = 1.0 / np.sqrt((1.0 - x) * (1.0 + x))
    return np.arcsin(x), w, x * w**3, w**3 + 3.0 * x**2 * w**5


def _arccos(x: Any) -> Derivatives:
    _, one, two, three = _arcsin(x)
    return np.arccos(x), -one, -two, -three


def _arctg(x: Any) -> Derivatives:
    w = 1.0 / (1.0 + x**2)
    return np.arctan(x), w, -2.0 * x * w**2, (6.0 * x**2 - 2.0) * w**3


def _abs(jet: Jet) -> Jet:
    """Return the absolute value; where that has a corner, no rates."""
    f = bounded(jet.value)
    sign = np.where(np.abs(f.value) <= f.radius, np.nan, np.sign(f.value))
    return Jet(abs(f), jet.rate * Bounded(sign), jet.acceleration * Bounded(sign))


def _call(derivatives: Callable[[Any], Derivatives], *, edge: bool = False) -> Callable[[Jet], Jet]:
    return lambda jet: _composed(jet, derivatives, edge=edge)


CALLS: Mapping[str, Callable[[Jet], Jet]] = MappingProxyType(
    {
        "sin": _call(_sin),
        "cos": _call(_cos),
        "tg": lambda jet: _composed(jet, _sin) / _composed(jet, _cos),
        "ctg": lambda jet: _composed(jet, _cos) / _composed(jet, _sin),
        "arcsin": _call(_arcsin),
        "arccos": _call(_arccos),
        "arctg": _call(_arctg),
        "exp": _call(_exp),
        "ln": _call(_ln, edge=True),
        "lg": lambda jet: _composed(jet, _ln, edge=True) / Bounded(np.log(10.0), ROUNDOFF * 4),
        "sqrt": _call(_sqrt, edge=True),
        "sh": _call(_sh),
        "ch": _call(_ch),
        "th": _call(_th),
        "abs": _abs,
    }
)
"""Functions of jets by the names of `planmethod.problem.formula.FUNCTIONS`."""

DEGREES: Mapping[str, Callable[[Jet], Jet]] = MappingProxyType(
    {
        "sin deg": lambda jet: _composed(jet, _sin_deg),
        "cos deg": lambda jet: _composed(jet, _cos_deg),
        "tg deg": lambda jet: _composed(jet, _sin_deg) / _composed(jet, _cos_deg),
        "ctg deg": lambda jet: _composed(jet, _cos_deg) / _composed(jet, _sin_deg),
    }
)
"""Functions of a calculator set to degrees, differentiated as if of radians."""
