"""Condition numbers: how much the data's last bit moves a result; the multiprecision reading."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.construct.arithmetic import Exact, Number
from planmethod.construct.dual import Dual, Duals, as_dual
from planmethod.construct.evaluate import evaluate
from planmethod.construct.program import Program
from planmethod.construct.steps import Name

DIGITS = 50
"""Default number of decimal digits of the high-precision check."""


class Precise(Exact):
    """Numbers of mpmath, one position at a time.

    It has its own context, so that a precision set elsewhere does not change its results.

    Parameters
    ----------
    digits : int
        Decimal digits carried.
    """

    __slots__ = ("_right", "context", "digits")

    def __init__(self, digits: int = DIGITS) -> None:
        from mpmath import MPContext

        self.digits = digits
        self.context: Any = MPContext()
        self.context.dps = digits
        self._right = self.context.pi / 180

    def lift(self, value: Number) -> Number:
        """Turn given data, binary fractions taken as they are, into a number of the context."""
        return self.context.convert(value.item() if hasattr(value, "item") else value)

    def root(self, value: Number) -> Number:
        """Return the square root, 0 of a negative number."""
        return self.context.sqrt(value) if value > 0 else self.context.zero

    def guard(self, margin: Number, limit: float, value: Number) -> Number:
        """Return the value if ``margin > limit``, else NaN."""
        return value if margin > limit else value * self.context.nan

    def nonzero(self, value: Number) -> Number:
        """Return the value, NaN in place of zero."""
        return self.context.nan if value == 0 else value

    def direction_margin(self, length: Number) -> Number:
        """Return 1 if a length is not zero, else 0."""
        return self.context.one if length != 0 else self.context.zero

    def unless_zero(self, size: Number, value: Number, fallback: Number) -> Number:
        """Return ``fallback`` if ``size`` is zero, else ``value``."""
        return fallback if size == 0 else value

    def ordered(self, one: Number, two: Number) -> tuple[Number, Number]:
        """Return the smaller and the larger of two real numbers."""
        return (one, two) if one < two else (two, one)

    def direction(self, degrees: Number) -> Number:
        """Return the unit complex number at an angle; exact at quadrants."""
        quadrant = int(self.context.nint(degrees / 90))
        cosine, sine = self.context.cos_sin((degrees - 90 * quadrant) * self._right)
        return self.context.mpc(cosine, sine) * (1, 1j, -1, -1j)[quadrant % 4]

    def angle(self, vector: Number) -> Number:
        """Return the angle of a vector, degrees in (-180, 180]."""
        return self.context.atan2(vector.imag, vector.real) / self._right


UNIT_ROUNDOFF = 2.0**-53
"""u: half the distance of 1 to the next float64."""

Reals = npt.NDArray[np.float64]


def as_scalar(value: Number) -> Number:
    """Return a point or a number unchanged, and for a line its direction as a unit vector."""
    if not isinstance(value, tuple):
        return value
    along = value[1]
    span = abs(along)
    if isinstance(span, Dual | np.ndarray | np.generic) or span != 0:
        return along / span
    return along * float("nan")  # mpmath divides by no zero


def _causes(data: Mapping[str, Number], exact: Collection[str]) -> list[tuple[str, complex]]:
    """Return (datum, direction) of every coordinate that rounding may move."""
    causes: list[tuple[str, complex]] = []
    for name, value in data.items():
        if name in exact:
            continue
        array = np.asarray(value)
        if np.any(np.real(array) != 0):
            causes.append((name, 1.0))
        if np.iscomplexobj(array) and np.any(np.imag(array) != 0):
            causes.append((name, 1j))
    return causes


def _part(value: Number, direction: complex) -> Number:
    """Return the coordinate of a datum along a direction, as a vector along it."""
    return np.real(value) if direction == 1.0 else 1j * np.imag(value)


def reach(
    program: Program, data: Mapping[str, Number], exact: Collection[str] = ()
) -> dict[Name, Reals]:
    """Return the reach of every result of a program, to first order in float64.

    Of a line it is the reach of its unit direction.

    Parameters
    ----------
    program : Program
    data : mapping
        Scalars or ndarrays of shape (n,).
    exact : collection of str
        Data that carry no rounding: the scales.

    Returns
    -------
    dict of name to ndarray of shape (n,) or (1,)
        In the result's own unit.
    """
    causes = _causes(data, exact)
    lifted: dict[str, Number] = {}
    for name, value in data.items():
        mine = [(i, way) for i, (cause, way) in enumerate(causes) if cause == name]
        if not mine:
            lifted[name] = value
            continue
        row = np.atleast_1d(np.asarray(value))
        slope = np.zeros((len(causes), len(row)), dtype=row.dtype)
        for i, way in mine:
            slope[i] = _part(row, way)
        lifted[name] = Dual(row, slope)
    trace = evaluate(program, lifted, Duals())
    with np.errstate(all="ignore"):  # a line of zero length, which no result depends on
        return {name: _reach(as_dual(as_scalar(value))) for name, value in trace.value.items()}


def _reach(value: Dual) -> Reals:
    size = np.abs(np.atleast_1d(value.value))
    if value.slope is not None:
        size = size + np.abs(value.slope).sum(axis=0)
    return np.asarray(size, dtype=float)


def measured_reach(
    program: Program, data: Mapping[str, Any], precise: Precise, exact: Collection[str] = ()
) -> dict[Name, tuple[Number, Number]]:
    """Return value and reach of every result of one position, both in multiprecision.

    Each datum is moved by a relative step of ten to the minus third of the number of digits, which
    leaves two thirds of them true in the quotient.

    Parameters
    ----------
    data : mapping
        Scalars.
    """
    step = precise.context.mpf(10) ** -(precise.digits // 3)
    lifted = {name: precise.lift(value) for name, value in data.items()}
    names = {name: as_scalar(v) for name, v in evaluate(program, lifted, precise).value.items()}
    total = {name: abs(value) for name, value in names.items()}
    for name, way in _causes(data, exact):
        part = lifted[name].real if way == 1.0 else 1j * lifted[name].imag
        moved = evaluate(program, {**lifted, name: lifted[name] + part * step}, precise)
        for result, value in names.items():
            total[result] += abs(as_scalar(moved.value[result]) - value) / step
    return {name: (value, total[name]) for name, value in names.items()}
