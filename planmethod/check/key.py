"""The key: right answers, their tolerances, mistakes it cannot show; keys of many variants."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property, partial
from math import isfinite
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.check.marks import DEFAULT, Settings
from planmethod.check.mistakes import changes
from planmethod.check.mistakes.plans import Change, MistakeContext
from planmethod.check.model import KeyEntry
from planmethod.check.questions import Question
from planmethod.check.sheet import DRAWS, Sheet, drafted_of, sense_of, single_float
from planmethod.check.task import Task, TaskItem
from planmethod.check.tolerance import Tolerance, limit_of
from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.evaluate import Trace, evaluate, extend_trace
from planmethod.construct.steps import Name, Step, operands
from planmethod.plans.model import FACTS, RATES, PlanKind
from planmethod.problem.model import Problem
from planmethod.problem.quantities import QuantityKind, Sign
from planmethod.problem.records import KindProblem
from planmethod.solved.errors.spread import Errors
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.many.variants import Batch
from planmethod.solved.solution import Solution, at_positions


class Key(Struct, frozen=True):
    """Key of one variant (ключ варианта).

    Attributes
    ----------
    problem : Problem or KindProblem
    variant : str or None
    entries : tuple of KeyEntry
    scales : mapping of str to float
        Of the plans, unit per mm.
    hidden : mapping of str to tuple of str
        Mistakes that none of the answers can show, and the places where they can be made.
    """

    problem: KindProblem
    variant: str | None
    entries: tuple[KeyEntry, ...]
    scales: Mapping[str, float]
    hidden: Mapping[str, tuple[str, ...]]


def key_of(solution: Solution, settings: Settings = DEFAULT) -> Key:
    """Return the key of a solution: for the requested or the usual quantities."""
    return key_of_task(Task(solution, settings))


MistakeEffect: TypeAlias = tuple[str, str, Mapping[str, float]]
"""A mistake: its code, its place, and its prediction for every question."""


def key_of_task(
    task: Task,
    items: Iterable[TaskItem] | None = None,
    *,
    named: Callable[[Sheet], Iterable[MistakeEffect]] | None = None,
) -> Key:
    """Return the key of some items of a variant. Default: all items.

    ``named`` returns the mistakes of a sheet, where they are known already.
    """
    named = partial(_named, task) if named is None else named
    chosen = tuple(task.list_items() if items is None else items)
    entries: dict[tuple[int, str], KeyEntry] = {}
    unseen: set[tuple[str, str]] | None = None  # mistakes and places that no answer shows
    every: dict[tuple[str, str], None] = {}
    alike: dict[tuple[str, str], None] = {}
    scales: dict[str, float] = {}
    for position in dict.fromkeys(item.position for item in chosen):
        here = [item for item in chosen if item.position == position]
        drawn = task.sheet(position)
        sheet = drawn.answer_key_sheet
        scales = {**sheet.scales, **scales}
        limits = {
            item.id: limit_of(sheet, item.question, task.settings, item.fixed) for item in here
        }
        shown: dict[str, set[str]] = {item.id: set() for item in here}
        codes: dict[str, None] = {}
        dark: set[tuple[str, str]] = set()
        seen_by = [_Detector.of(item, limits[item.id]) for item in here]
        for code, where, values in named(drawn):
            codes[code] = None
            visible = False
            for one in seen_by:
                if one.shows(values[one.question]):
                    shown[one.item].add(code)
                    visible = True
            if not visible:
                every[code, where] = None
                dark.add((code, where))
        unseen = dark if unseen is None else unseen & dark
        for item in here:
            alike.update(dict.fromkeys(_confusable_segments(task, sheet, item, limits[item.id])))
            hides = tuple(code for code in codes if code not in shown[item.id])
            limit = limits[item.id]
            entries[position, item.id] = entry_of(task, item, limit, sheet=sheet, hidden=hides)
    hidden: dict[str, tuple[str, ...]] = {}
    for code, where in (*(place for place in every if place in (unseen or ())), *alike):
        hidden[code] = (*hidden.get(code, ()), where)
    return Key(
        task.problem,
        task.variant,
        tuple(entries[item.position, item.id] for item in chosen),
        scales,
        hidden,
    )


def _named(task: Task, sheet: Sheet) -> Iterator[MistakeEffect]:
    return ((one.code, one.mistake_at, one.values) for one in task.named(sheet))


SEGMENT_CODES = {PlanKind.VELOCITY: "V6", PlanKind.ACCELERATION: "N5"}
"""Codes of a segment read for another one of its plan."""


def _confusable_segments(
    task: Task, sheet: Sheet, item: TaskItem, limit: Tolerance
) -> Iterator[tuple[str, str]]:
    """Yield the segments of the same plan that are as long, and may be read by mistake: V6, N5."""
    question, length = item.question, sheet.length(item.question)
    code = None if question.plan is None else SEGMENT_CODES.get(question.plan)
    if not length or code is None or question.is_mm or limit.zero:
        return
    slack = max(limit.spread, limit.tolerance()) / abs(limit.exact) * length
    own = segment_of(task, item)
    for segment in task.solution.construction.segments:
        if segment.kind is question.plan and segment.name != own and own:
            drawn = sheet.exact_trace.value.get(segment.length)
            if drawn is not None and abs(abs(single_float(drawn)) - length) <= slack:
                yield code, f"{item.label or item.name}: {segment.name}"


class _Detector(NamedTuple):
    """An answer, and the deviation from which a mistake is visible in it."""

    item: str
    question: str
    exact: float
    bound: float
    zero: bool
    asks_sense: bool

    @classmethod
    def of(cls, item: TaskItem, limit: Tolerance) -> _Detector:
        bound = max(limit.spread, limit.tolerance())
        return cls(item.id, item.question.id, limit.exact, bound, limit.zero, item.asks_sense)

    def shows(self, value: float) -> bool:
        """Return whether the answer with a mistake is surely off."""
        beyond = abs(abs(value) - abs(self.exact)) > self.bound
        return not self.zero and (beyond or (self.asks_sense and value * self.exact < 0))


def entry_of(
    task: Task,
    item: TaskItem,
    limit: Tolerance,
    *,
    sheet: Sheet | None = None,
    hidden: tuple[str, ...] = (),
) -> KeyEntry:
    """Return the line of the key of one item, at the scales of the problem."""
    question, sheet = item.question, sheet or task.sheet(item.position)
    length = sheet.length(question)
    plan = question.plan
    letters = item.label not in ("", question.id)
    return KeyEntry(
        id=item.name,
        label=item.label or item.name,
        symbol=drawn_symbol(task, question) or (rich(item.label) if letters else question.symbol),
        unit=question.unit,
        exact=abs(limit.exact) if question.sign is Sign.SIZE else limit.exact,
        sigma=limit.sigma,
        tolerance=limit.tolerance(),
        is_visible=limit.is_visible,
        zero=limit.zero,
        signed=question.sign is not Sign.SIZE,
        mm=length,
        scale="" if plan is None or question.is_mm else FACTS[plan].scale,
        segment=segment_of(task, item),
        sense=None if limit.zero else sense_of(sheet, question),
        asks_sense=item.asks_sense,
        points=item.points,
        position=item.position,
        hidden=hidden,
        requested_unit=item.unit,
        per=item.per(sheet.scales),
        what=describe_quantity(question),
        computed=_is_computed_first(sheet, question),
    )


def _is_computed_first(sheet: Sheet, question: Question) -> bool:
    """Return whether a value is computed, and its segment laid off by it."""
    order, name, length = sheet.order, question.name, question.length
    return name in order and length in order and order[name] < order[length]


def drawn_symbol(task: Task, question: Question) -> str:
    """Return the vector symbol of a quantity, as on the sheet; empty if it is not a vector.

    The letters of a department, ``v_B3B2``, may differ: both are read in submissions.
    """
    if question.ends is None or question.plan not in RATES or question.sign is not Sign.SIZE:
        return ""
    if question.is_mm or not isinstance(task.problem, Problem):
        return ""
    vectors = task.solution.construction.plan(question.plan).vectors
    return next((v.symbol for v in vectors if (v.tail, v.head) == question.ends), "")


def describe_quantity(question: Question) -> str:
    """Return a quantity as a submission may name it: ``v B3``, ``angle v B3``, ``n 5``."""
    kind = question.key.kind
    if kind in (QuantityKind.COMPUTED, QuantityKind.PICTURED):
        return question.key.names[0]
    turned = question.ends is None and question.id.startswith("angle_")
    turned = turned and question.sign is Sign.ANGLE and not question.key.is_angle
    return f"angle {question.key.words}" if turned else question.key.words


def rich(letters: str) -> str:
    """Return letters of the department as rich text: ``v_B1`` has B1 as its index."""
    return re.sub(r"_([^{}\s]+)", r"_{\1}", letters)


def segment_of(task: Task, item: TaskItem) -> str:
    """Return the letters of the segment of an item: ``p-b3``; empty where it has none."""
    length = item.question.length
    if length is None:
        return ""
    for segment in task.solution.construction.segments:
        if length in (segment.length, segment.drawn):
            return segment.name
    return ""


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
    if any(set(first.questions(p).steps.draft.numbers) != known for p in positions):
        return []
    if any(first.questions(p).springs.springs for p in positions):
        return []  # their steps have numbers of one variant
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


def compute_keys(
    batches: Iterable[tuple[Batch, Sequence[int]]], settings: Settings
) -> dict[int, Key]:
    """Return the keys of problems in batches, of those with the same requests, by their numbers."""
    found: dict[int, Key] = {}
    for batch, members in batches:
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

    @cached_property
    def _right(self) -> Trace:
        """Exact reading of all sheets."""
        return evaluate(self.first.program, self.data, Float64())

    @cached_property
    def _after(self) -> dict[Name, set[int]]:
        """Numbers of the steps of a sheet that depend on a name, by names."""
        found: dict[Name, set[int]] = {}
        for number, step in reversed([*enumerate(self.first.program.steps)]):
            own = found.setdefault(step.out, set())
            for name, _ in operands(step):
                found.setdefault(name, set()).update(own, (number,))
        return found

    def _redrawn(self, change: Change) -> Iterator[Step]:
        """Yield the steps that are drawn otherwise with a mistake; the others stay as they are."""
        order, steps = self.first.order, self.first.program.steps
        changed = [
            step.out for step in steps if step.out in change.steps or step.out in change.data
        ]
        numbers = {order[name] for name in changed}
        numbers.update(*(self._after[name] for name in changed))
        for number in sorted(numbers):
            yield from change.steps.get(steps[number].out, (steps[number],))

    def assign_readings(self) -> None:
        """Give every sheet its exact reading and its errors."""
        count, errors = len(self.sheets), _BatchErrors(self.sheets, self.data)
        for number, own in enumerate(_scalars(self._right, count)):
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
        right: dict[tuple[int, ...], dict[Name, Number]] = {}
        for members in alike.values():
            rows = tuple(number for number, *_ in members)
            if rows not in right:
                right[rows] = _of_rows(self._right.value, np.array(rows))
            shown = self._effects(right[rows], [change for *_, change in members])
            for (number, place, _), one in zip(members, shown, strict=True):
                told[number][place] = one
        return [[shown for shown in own if shown is not None] for own in told]

    def _effects(
        self, right: Mapping[Name, Number], members: Sequence[Change]
    ) -> Iterator[MistakeEffect | None]:
        """Yield the predictions of a mistake on some sheets; None if it cannot be drawn.

        ``right`` are the values of these sheets without the mistake.
        """
        first = members[0]
        data = {name: np.array([change.data[name] for change in members]) for name in first.data}
        trace = extend_trace(Trace(right, {}), self._redrawn(first), data, Float64())
        asked = self.first.requested
        with np.errstate(all="ignore"):
            columns: npt.NDArray[np.float64] = np.empty((len(asked), len(members)))
            for number, question in enumerate(asked):
                columns[number] = question.evaluate(trace)
        ids = [question.id for question in asked]
        for row in columns.T.tolist():
            sound = all(map(isfinite, row))
            yield (
                (first.code, first.mistake_at, dict(zip(ids, row, strict=True))) if sound else None
            )


class _BatchErrors(Errors):
    """Drafting errors of the answers of many variants; of random sheets each has its own."""

    def __init__(self, sheets: Sequence[Sheet], data: Mapping[str, Number]) -> None:
        first, self.sheets = sheets[0], sheets
        drawn = drafted_of(first, first.program, partial(at_positions, data), len(sheets))
        super().__init__(drawn, draws=DRAWS)

    def _of_sheets(self, index: int) -> dict[str, float]:
        sheet = self.sheets[index]
        return sheet.errors_of(sheet.program, sheet.data)._of_sheets(0)


def _of_rows(values: Mapping[Name, Number], rows: npt.NDArray[np.intp]) -> dict[Name, Number]:
    """Return the values of some sheets."""

    def some(value: Number) -> Number:
        if isinstance(value, tuple):
            return tuple(map(some, value))
        return value[rows] if np.ndim(value) else value

    return {name: some(value) for name, value in values.items()}


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
