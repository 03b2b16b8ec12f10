"""Records of many positions, kept column by column and put together as plain data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from msgspec import Struct

Column: TypeAlias = list[Any]
"""Values of a record in every position."""


class Records(Struct, frozen=True):
    """Records of many positions, kept column by column and materialized when read.

    Attributes
    ----------
    names : tuple of str or None
        Names of the columns; None if the record is a list.
    columns : sequence of Column or Records
    count : int
        Positions.
    some : mapping of int to dict
        Additional data of the records of some positions, by their numbers.
    """

    names: tuple[str, ...] | None
    columns: Sequence[Column | Records]
    count: int
    some: Mapping[int, dict[str, Any]]

    def __len__(self) -> int:
        """Return the number of positions."""
        return self.count

    def plain(self) -> list[Any]:
        """Return the record of each position as plain data."""
        columns = [plain_of(column) for column in self.columns]
        every = zip(*columns, strict=True) if columns else [()] * self.count
        if self.names is None:
            return [list(one) for one in every]
        found = [dict(zip(self.names, one, strict=True)) for one in every]
        for index, more in self.some.items():
            found[index].update(more)
        return found


def rows(
    columns: Mapping[str, Column | Records],
    count: int = 0,
    some: Mapping[int, dict[str, Any]] | None = None,
) -> Records:
    """Return columns as a record for each position; ``count`` records without any column."""
    count = max(count, *map(len, columns.values())) if columns else count
    return Records(tuple(columns), tuple(columns.values()), count, some or {})


def together(columns: Sequence[Column | Records], count: int) -> Records:
    """Return several columns as one list for each position."""
    return Records(None, columns, count, {})


def plain_of(value: Any) -> Any:
    """Return a value with its records as plain data."""
    if isinstance(value, dict):
        return {key: plain_of(one) for key, one in value.items()}
    return value.plain() if isinstance(value, Records) else value
