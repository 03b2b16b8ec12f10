"""Records of many positions, put together column by column, as plain data and as JSON."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import NoneType
from typing import Any, TypeAlias

from planmethod.record import dataclass

Column: TypeAlias = list[Any]
"""What a record says in every position."""


@dataclass(frozen=True)
class Records:
    """Records of many positions, kept column by column: who reads them puts them together.

    Attributes
    ----------
    names : tuple of str or None
        Of the columns; None if the record is a list.
    columns : sequence of Column or Records
    count : int
        Positions.
    some : mapping of int to dict
        What only the records of some positions have besides, by their numbers.
    """

    names: tuple[str, ...] | None
    columns: Sequence[Column | Records]
    count: int
    some: Mapping[int, dict[str, Any]]

    def __len__(self) -> int:
        """Return how many positions there are."""
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
    """Return columns as a record for each position; ``count`` of them where there is no column."""
    count = max(count, *map(len, columns.values())) if columns else count
    return Records(tuple(columns), tuple(columns.values()), count, some or {})


def together(columns: Sequence[Column | Records], count: int) -> Records:
    """Return several columns as one list for each position."""
    return Records(None, columns, count, {})


def plain_of(value: Any) -> Any:
    """Return what holds records as plain data."""
    if isinstance(value, dict):
        return {key: plain_of(one) for key, one in value.items()}
    return value.plain() if isinstance(value, Records) else value


class Written:
    """Records as JSON, the same text as of their plain data, but columns are written at once.

    Parameters
    ----------
    write : callable
        Writes plain data as JSON, in one line.
    """

    def __init__(self, write: Callable[[Any], str]) -> None:
        self._write = write
        self._known: dict[tuple[Any, ...], list[str]] = {}

    def text(self, value: Any) -> str:
        """Return what holds records as JSON."""
        if isinstance(value, dict):
            told = (f"{self._write(key)}: {self.text(one)}" for key, one in value.items())
            return "{" + ", ".join(told) + "}"
        if not isinstance(value, Records):
            return self._write(value)
        texts: list[list[str]] = []
        form = self._form(value, texts)
        every = zip(*texts, strict=True) if texts else [()] * value.count
        return f"[{', '.join([form % one for one in every])}]"

    def _form(self, value: Column | Records, texts: list[list[str]]) -> str:
        """Return a record with ``%s`` for what each position has, which goes to ``texts``."""
        if not isinstance(value, Records):
            texts.append(self._column(value))
            return "%s"
        forms = [self._form(column, texts) for column in value.columns]
        if value.names is None:
            return f"[{', '.join(forms)}]"
        names = [self._write(name).replace("%", "%%") for name in value.names]
        forms = [f"{name}: {form}" for name, form in zip(names, forms, strict=True)]
        whole = ", ".join(forms)
        if value.some:
            more = {index: f", {self._write(one)[1:-1]}" for index, one in value.some.items()}
            texts.append([more.get(index, "") for index in range(len(texts[-1]))])
            whole += "%s"
        return "{" + whole + "}"

    def _column(self, column: Column) -> list[str]:
        if not column or not set(map(type, column)) <= {float, NoneType}:
            texts = {mark: self._write(one) for mark, one in {id(v): v for v in column}.items()}
            return [texts[id(value)] for value in column]
        known = tuple(column)  # what one link does to another is what that does to the one
        if known not in self._known:
            self._known[known] = self._write(column)[1:-1].split(", ")
        return self._known[known]
