"""Records of many positions, kept column by column and put together as plain data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from msgspec import Struct

Column: TypeAlias = list[Any]
"""Values of a record in every position."""


class ColumnarRecords(Struct, frozen=True):
    """Records of many positions, kept column by column and materialized when read.

    Attributes
    ----------
    names : tuple of str or None
        Names of the columns; None if the record is a list.
    columns : sequence of Column or ColumnarRecords
    count : int
        Positions.
    some : mapping of int to dict
        Additional data of the records of some positions, by their numbers.
    """

    names: tuple[str, ...] | None
    columns: Sequence[Column | ColumnarRecords]
    count: int
    some: Mapping[int, dict[str, Any]]

    def __len__(self) -> int:
        """Return the number of positions."""
        return self.count

    def to_list(self) -> list[Any]:
        """Return the record of each position as plain data."""
        columns = [to_builtins(column) for column in self.columns]
        every = zip(*columns, strict=True) if columns else [()] * self.count
        if self.names is None:
            return [list(one) for one in every]
        found = [dict(zip(self.names, one, strict=True)) for one in every]
        for index, more in self.some.items():
            found[index].update(more)
        return found


def record_of(
    columns: Mapping[str, Column | ColumnarRecords],
    count: int = 0,
    some: Mapping[int, dict[str, Any]] | None = None,
) -> ColumnarRecords:
    """Return columns as a record for each position; ``count`` records without any column."""
    count = max(count, *map(len, columns.values())) if columns else count
    return ColumnarRecords(tuple(columns), tuple(columns.values()), count, some or {})


def list_of(columns: Sequence[Column | ColumnarRecords], count: int) -> ColumnarRecords:
    """Return several columns as one list for each position."""
    return ColumnarRecords(None, columns, count, {})


def to_builtins(value: Any) -> Any:
    """Return a value with its records as plain data."""
    if isinstance(value, dict):
        return {key: to_builtins(one) for key, one in value.items()}
    return value.to_list() if isinstance(value, ColumnarRecords) else value
