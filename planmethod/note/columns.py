"""Records of many positions put together column by column: what is asked is asked once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import Any, TypeAlias

import numpy as np

from planmethod.solved.reading import Complexes, Flags, Reals

Column: TypeAlias = list[Any]
"""What a record says in every position."""


def listed(values: Reals | Sequence[float]) -> list[float | None]:
    """Return numbers for a record, without a negative zero; None for what is none."""
    return [value if isfinite(value) else None for value in (np.asarray(values) + 0.0).tolist()]


def pairs(places: Complexes) -> list[list[float | None]]:
    """Return places as pairs of coordinates."""
    return [list(pair) for pair in zip(listed(places.real), listed(places.imag), strict=True)]


def sizes(vectors: Complexes) -> Column:
    """Return the sizes of vectors: those of one by one, whose last bit is that of a position."""
    return listed([abs(vector) for vector in vectors.tolist()])


def rows(columns: Mapping[str, Column], count: int = 0) -> list[dict[str, Any]]:
    """Return columns as a record for each position; ``count`` of them where there is no column."""
    if not columns:
        return [{} for _ in range(count)]
    return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]


def named(flags: Mapping[str, Flags], count: int) -> list[list[str]]:
    """Return the names of what is flagged in each position."""
    found: list[list[str]] = [[] for _ in range(count)]
    for name, flag in flags.items():
        for index in flag.nonzero()[0].tolist():
            found[index].append(name)
    return found


def together(records: list[list[dict[str, Any]]], count: int) -> list[list[dict[str, Any]]]:
    """Return several records of each position as one list."""
    return [list(one) for one in zip(*records, strict=True)] or [[] for _ in range(count)]
