"""Columns of rich text as those of plain tables (столбцы таблиц)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from planmethod.note.numbers import Notation
from planmethod.note.plaintext import plain_text


def plain_columns(
    columns: Iterable[tuple[str, str, Sequence[str]]], say: Notation
) -> Iterator[list[str]]:
    """Yield columns of head, unit of SI or none, and cells: the unit stands in the head."""
    for head, unit, cells in columns:
        told = f"{head}, {say.in_head(unit)}" if unit else head
        yield [plain_text(told), *map(plain_text, cells)]
