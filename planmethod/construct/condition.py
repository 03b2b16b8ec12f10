"""Condition numbers: how much the data's last bit moves a result (числа обусловленности).

The reach of a result y on data d is ``|y| + sum |∂y/∂d_i · d_i|``: u times it is what one rounding
of every datum and of the result costs, whatever formulas are used. The reach over ``|y|`` is the
condition number κ; a result good to a few u·κ·|y| is as good as its data let it be. Zeros and
scales are exact and do not count; of a complex datum both coordinates count.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.construct.arithmetic import Number
from planmethod.construct.dual import Dual, Duals, as_dual
from planmethod.construct.evaluate import evaluate
from planmethod.construct.multiprecision import Precise
from planmethod.construct.program import Program
from planmethod.construct.steps import Name

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
