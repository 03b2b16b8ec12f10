"""Legend of a record: letters and units of its names (обозначения записи)."""

from __future__ import annotations

from collections.abc import Iterable

from planmethod.note.document import plain_text
from planmethod.note.formula import Rich


def legend_record(
    named: Iterable[tuple[str, Rich | list[Rich], str]],
) -> dict[str, dict[str, str | list[str]]]:
    """Return symbols as plain text, and units, by the names of a record.

    Parameters
    ----------
    named : iterable of (str, Rich or list of Rich, str)
        Name in the record, the symbol that tables have, and the unit, of SI or as the record has
        it; empty for a number without one, which is ``1``. Several symbols where the record has a
        list of values.
    """
    return {
        name: {
            "symbol": plain_text(of) if isinstance(of, str) else [*map(plain_text, of)],
            "unit": unit or "1",
        }
        for name, of, unit in named
    }
