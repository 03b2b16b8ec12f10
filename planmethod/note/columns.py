"""Helpers that build the columns of records of many positions from arrays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from planmethod.note.columnar import Column, ColumnarRecords, list_of
from planmethod.solved.reading import Complexes, Flags, Reals


def numbers_or_none(values: Reals | Sequence[float]) -> list[float | None]:
    """Return numbers for a record, without a negative zero; None for NaN and infinity."""
    numbers = np.asarray(values) + 0.0
    found: Column = numbers.tolist()
    for index in (~np.isfinite(numbers)).nonzero()[0].tolist():
        found[index] = None
    return found


def bounds(values: Reals) -> list[float | None]:
    """Return bounds for a record, rounded up to two significant digits."""
    return numbers_or_none([_rounded_up(float(value)) for value in values])


def _rounded_up(value: float) -> float:
    if not 0.0 < value < np.inf:
        return value
    step = 10.0 ** float(np.floor(np.log10(value)) - 1)
    return float(f"{np.ceil(value / step - 1e-9) * step:.1e}")


def pairs(places: Complexes) -> ColumnarRecords:
    """Return places as pairs of coordinates."""
    return list_of([numbers_or_none(places.real), numbers_or_none(places.imag)], len(places))


def sizes(vectors: Complexes) -> Column:
    """Return the sizes of vectors: those of one by one, whose last bit is that of a position."""
    return numbers_or_none([abs(vector) for vector in vectors.tolist()])


def named(flags: Mapping[str, Flags], count: int) -> list[list[str]]:
    """Return the names that are flagged in each position."""
    found: list[list[str]] = [[] for _ in range(count)]
    for name, flag in flags.items():
        for index in flag.nonzero()[0].tolist():
            found[index].append(name)
    return found
