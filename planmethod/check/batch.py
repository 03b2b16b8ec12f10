"""Keys of many variants worked out together (ключи многих вариантов сразу).

The requested items, their steps and the possible mistakes are those of one variant; the numbers
of all are columns of one reading. Each variant then builds its key from its own rows.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import partial

import numpy as np

from planmethod.check.key import Key, MistakeEffect, key_of_task
from planmethod.check.marks import Settings
from planmethod.check.mistakes import changes
from planmethod.check.mistakes.model import Change, MistakeContext
from planmethod.check.sheet import DRAWS, Sheet, drafted_of
from planmethod.check.task import Task
from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.drafting import PROFILES
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.problem.model import Problem
from planmethod.solved.errors.spread import Errors
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.many.variants import Batch, in_batches
from planmethod.solved.solution import at_positions

Columns = dict[str, Number]


def batch_tasks(
    batch: Batch, settings: Settings, other_variants: Callable[[], Iterable[Task]] | None = None
) -> list[Task]:
    """Return the tasks of variants with all requested numbers; none if the variants differ.

    They differ in their requests, or if a request needs numbers of its own.
    """
    if len({_request_signature(problem) for problem in batch.problems}) > 1:
        return []
    first = Task(batch.solutions[0], settings, other_variants)
    positions = dict.fromkeys(item.position for item in first.list_items())
    known = set(batch.construction.draft.numbers)
    if any(set(first.questions(p).selecting.draft.numbers) != known for p in positions):
        return []
    tasks = [first, *(first.for_variant(one) for one in batch.solutions[1:])]
    for position in positions:
        _Rows(batch, [task.sheet(position) for task in tasks]).assign_readings()
    return tasks


def batch_keys(batch: Batch, settings: Settings) -> list[Key]:
    """Return the keys of variants with the same requests; none if they differ."""
    tasks = batch_tasks(batch, settings)
    if not tasks:
        return []
    named: dict[int, list[MistakeEffect]] = {}
    for position in dict.fromkeys(item.position for item in tasks[0].list_items()):
        sheets = [task.sheet(position) for task in tasks]
        shown = _Rows(batch, sheets).named()
        named.update((id(sheet), own) for sheet, own in zip(sheets, shown, strict=True))
    return [key_of_task(task, named=lambda sheet: named[id(sheet)]) for task in tasks]


def batch_named(
    batch: Batch, tasks: Sequence[Task], position: int, of: Collection[int]
) -> dict[int, list[MistakeEffect]]:
    """Return what the mistakes with a name give in a position of some of the variants."""
    rows = _Rows(batch, [task.sheet(position) for task in tasks])
    shown = rows.named(of)
    return {number: shown[number] for number in of}


def compute_keys(problems: Sequence[Problem], settings: Settings) -> dict[int, Key]:
    """Return the keys of linkages with the same steps and requests, by their numbers."""
    found: dict[int, Key] = {}
    for batch, members in in_batches(problems, PROFILES["board"]):
        found.update(zip(members, batch_keys(batch, settings), strict=False))  # all, or none
    return found


def _request_signature(problem: Problem) -> tuple[object, ...]:
    """Return the requests of a problem, and its number of positions."""
    return problem.answers, len(problem.drive.positions), problem.calculated


class _Rows:
    """Sheets of one position of many variants as rows of one reading."""

    def __init__(self, batch: Batch, sheets: Sequence[Sheet]) -> None:
        self.sheets, self.first = sheets, sheets[0]
        places = np.array([own.start for own in batch.rows]) + self.first.questions.position
        scales = {name: np.array([s.scales[name] for s in sheets]) for name in self.first.scales}
        spread = {}
        for name, own in scales.items():
            spread[name] = np.zeros(len(batch.positions))
            spread[name][places] = own
        loaded = self.first.questions.statics is not None
        of = statics_of(batch) if loaded else batch
        self.data: Columns = dict(of.data(spread, places))

    def assign_readings(self) -> None:
        """Give every sheet its exact reading and its errors."""
        trace = evaluate(self.first.program, self.data, Float64())
        count, errors = len(self.sheets), _BatchErrors(self.sheets, self.data)
        for number, own in enumerate(_scalars(trace, count)):
            sheet = self.sheets[number]
            sheet.row = errors, number
            sheet.answer_key_sheet = sheet.read_as(own)

    def named(self, of: Collection[int] | None = None) -> list[list[MistakeEffect]]:
        """Return what every mistake with a name gives on every sheet, in order.

        A mistake is drawn once on all sheets with the same steps of it. If only some of
        them are requested, the others have none.
        """
        alike: dict[tuple[object, ...], list[tuple[int, int, Change]]] = {}
        told: list[list[MistakeEffect | None]] = []
        for number, sheet in enumerate(self.sheets):
            wanted = of is None or number in of
            found = list(changes(MistakeContext(sheet.answer_key_sheet))) if wanted else []
            told.append([None] * len(found))
            for place, change in enumerate(found):
                key = (change.code, change.mistake_at, *change.steps.items(), *change.data)
                alike.setdefault(key, []).append((number, place, change))
        for members in alike.values():
            shown = self._effects([(number, change) for number, _, change in members])
            for (number, place, _), one in zip(members, shown, strict=True):
                told[number][place] = one
        return [[shown for shown in own if shown is not None] for own in told]

    def _effects(self, members: Sequence[tuple[int, Change]]) -> Iterator[MistakeEffect | None]:
        """Yield the predictions of a mistake on some sheets; None if it cannot be drawn."""
        rows = np.array([number for number, _ in members])
        first = members[0][1]
        data = at_positions(self.data, rows)
        for name in first.data:
            data[name] = np.array([change.data[name] for _, change in members])
        trace = evaluate(first.program(self.first.program), data, Float64())
        asked = self.first.requested
        with np.errstate(all="ignore"):
            columns = [np.broadcast_to(q.evaluate(trace), rows.shape) for q in asked]
        table = np.array(columns, dtype=float).T
        sound = np.isfinite(table).all(axis=1)
        ids = [question.id for question in asked]
        for there, row in zip(sound.tolist(), table.tolist(), strict=True):
            values = dict(zip(ids, row, strict=True))
            yield (first.code, first.mistake_at, values) if there else None


class _BatchErrors(Errors):
    """Drafting errors of the answers of many variants; of random sheets each has its own."""

    def __init__(self, sheets: Sequence[Sheet], data: Mapping[str, Number]) -> None:
        first, self.sheets = sheets[0], sheets
        drawn = drafted_of(first, first.program, partial(at_positions, data), len(sheets))
        super().__init__(drawn, draws=DRAWS)

    def _of_sheets(self, index: int) -> dict[str, float]:
        sheet = self.sheets[index]
        return sheet.errors_of(sheet.program, sheet.data)._of_sheets(0)


def _scalars(trace: Trace, count: int) -> Iterator[Trace]:
    """Yield a reading row by row, its numbers as those of Python."""
    values = {name: _listed(value, count) for name, value in trace.value.items()}
    margins = {name: _listed(value, count) for name, value in trace.margin.items()}
    for row in range(count):
        yield Trace(
            {name: own[row] for name, own in values.items()},
            {name: own[row] for name, own in margins.items()},
        )


def _listed(value: Number, count: int) -> list[Number]:
    if isinstance(value, tuple):
        return list(zip(*(_listed(one, count) for one in value), strict=True))
    listed: list[Number] = np.broadcast_to(np.asarray(value), (count,)).tolist()
    return listed
