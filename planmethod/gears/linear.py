"""Linear equations in fractions: reduced rows, rank, determined unknowns (система уравнений)."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from fractions import Fraction
from typing import Generic, TypeVar

from msgspec import Struct

N = TypeVar("N", bound=Hashable)

Row = tuple[Mapping[N, Fraction], Fraction]
"""Coefficients by unknown, and the right side."""


class LinearSolution(Struct, Generic[N], frozen=True):
    """Solution of a system of linear equations.

    Attributes
    ----------
    values : mapping
        The unknowns that are determined.
    free : tuple
        The unknowns that are not.
    rank : int
    consistent : bool
        The equations do not contradict each other.
    """

    values: Mapping[N, Fraction]
    free: tuple[N, ...]
    rank: int
    consistent: bool


def solve(unknowns: Sequence[N], rows: Sequence[Row[N]]) -> LinearSolution[N]:
    """Solve equations exactly by elimination."""
    left: list[tuple[dict[N, Fraction], Fraction]] = [
        ({name: value for name, value in row.items() if value}, right) for row, right in rows
    ]
    done: dict[N, tuple[dict[N, Fraction], Fraction]] = {}
    for pivot in unknowns:
        at = next((i for i, (row, _) in enumerate(left) if pivot in row), None)
        if at is None:
            continue
        row, right = left.pop(at)
        scale = row[pivot]
        row, right = {name: value / scale for name, value in row.items()}, right / scale
        left = [_without(other, pivot, row, right) for other in left]
        done = {name: _without(other, pivot, row, right) for name, other in done.items()}
        done[pivot] = (row, right)
    values = {name: right for name, (row, right) in done.items() if len(row) == 1}
    return LinearSolution(
        values,
        tuple(name for name in unknowns if name not in values),
        len(done),
        not any(right for row, right in left if not row),
    )


def _without(
    equation: tuple[dict[N, Fraction], Fraction],
    pivot: N,
    row: dict[N, Fraction],
    right: Fraction,
) -> tuple[dict[N, Fraction], Fraction]:
    """Return an equation without one unknown."""
    mine, value = equation
    factor = mine.get(pivot)
    if factor is None:
        return equation
    merged = {name: mine.get(name, 0) - factor * row.get(name, 0) for name in {**mine, **row}}
    return {name: Fraction(v) for name, v in merged.items() if v}, value - factor * right
