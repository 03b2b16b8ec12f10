"""Springs and dampers in the record, the spreadsheet and on the terminal (пружины)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from planmethod.note.columnar import Column, ColumnarRecords, list_of, record_of
from planmethod.note.columns import numbers_or_none
from planmethod.note.document import Caption, Node, Table, computed_text
from planmethod.note.wording import Language
from planmethod.solved.forces.springs import SpringState, spring_states
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution


def spring_records(solution: Solution) -> ColumnarRecords:
    """Return the springs of every position as plain data.

    ``length`` (m), ``rate`` (m/s) and ``force`` (N, positive where it pushes the ends apart); of a
    torsion spring ``angle_deg``, ``rate`` (1/s) and ``moment`` (N·m, positive where it turns the
    second link counter-clockwise).
    """
    count = len(solution.positions)
    return list_of([_record(state, count) for state in spring_states(solution)], count)


def _record(state: SpringState, count: int) -> ColumnarRecords:
    spring = state.spring
    columns: dict[str, Column | ColumnarRecords] = {
        "name": [spring.name] * count,
        "links": [[*spring.links]] * count,
    }
    size, force = ("angle_deg", "moment") if spring.is_torsion else ("length", "force")
    for name, value in ((size, state.size), ("rate", state.rate), (force, state.force)):
        columns[name] = numbers_or_none(_column(value, count))
    return record_of(columns)


def _column(value: object, count: int) -> Reals:
    return np.array(np.broadcast_to(np.asarray(value, dtype=float), (count,)))


def spring_columns(solution: Solution) -> Iterator[tuple[str, Reals]]:
    """Yield the columns of the springs: ``spring.F_{c}.length`` (m), ``spring.F_{c}.force`` (N).

    Of a torsion spring ``.angle_deg`` and ``.moment`` (N·m).
    """
    count = len(solution.positions)
    for state in spring_states(solution):
        size, force = ("angle_deg", "moment") if state.spring.is_torsion else ("length", "force")
        yield f"spring.{state.spring.name}.{size}", _column(state.size, count)
        yield f"spring.{state.spring.name}.{force}", _column(state.force, count)


def spring_tables(solution: Solution, language: Language, index: int) -> Iterator[Node]:
    """Yield the tables of straight and torsion springs in one position, if there are any."""
    texts, count = language.springs, len(solution.positions)
    states = spring_states(solution)
    for torsion, heads in ((False, texts["columns"]), (True, texts["columns_torsion"])):
        rows = [
            (
                state.spring.symbol,
                *(
                    computed_text(float(_column(value, count)[index]), language.note)
                    for value in (state.size, state.rate, state.force)
                ),
            )
            for state in states
            if state.spring.is_torsion is torsion
        ]
        if rows:
            yield Caption(texts.table)
            yield Table(tuple(heads), tuple(rows), 1)
