"""One sheet of plans with its requested quantities: exact, with errors, and replayed (лист).

A sheet is one position of a problem at the scales of the student, or of the key. A student's own
numbers are substituted in its program (replay), so their consequences are found as on the plans.
"""

# no messages: names of answers

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property, partial
from types import MappingProxyType
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.check.model import Sense
from planmethod.check.questions import Question, Questions
from planmethod.construct.arithmetic import Float64, Number, Single
from planmethod.construct.drafting import Profile, Propagated, causes_of
from planmethod.construct.dual import angle, as_dual
from planmethod.construct.evaluate import Substitution, Trace, evaluate
from planmethod.construct.program import Program
from planmethod.construct.steps import Name, NumberName, Step
from planmethod.plans.model import Ends, Plan
from planmethod.problem.quantities import Sign
from planmethod.solved.errors.spread import RADIAN, Drafted, DrawnKind, DrawnQuantity, Errors
from planmethod.solved.solution import at_positions

DRAWS = 1000
"""Random sheets where first order does not hold."""

ZERO_LENGTH_MM = 1e-6
"""A segment not longer than this has no direction."""

KINDS = {Sign.SIZE: DrawnKind.LENGTH, Sign.ANGLE: DrawnKind.DIRECTION}


def single_float(value: Number) -> float:
    """Return the one number of an array."""
    return value if type(value) is float else float(np.reshape(value, -1)[0].real)


StudentValues: TypeAlias = Mapping[NumberName, tuple[float, bool]]
"""A student's own numbers, by the program's numbers that they replace; whether each is signed."""


def single_point(value: Number) -> complex:
    """Return the one point of an array."""
    return complex(np.reshape(value, -1)[0])


class Local(Struct, frozen=True):
    """Remaining errors of the quantities derived from a set of given numbers, to first order.

    Attributes
    ----------
    sigma : mapping
        Error of drawing and reading that is left when the earlier numbers are given.
    slopes : mapping of (Name, Name) to float
        How a number changes with an earlier one.
    """

    sigma: Mapping[Name, float]
    slopes: Mapping[tuple[Name, Name], float]


class Sheet:
    """Plans of one position at given scales, and the requested quantities.

    Attributes
    ----------
    row : (Errors, int) or None
        Drafting errors of sheets of many variants, and which of them this is.

    Parameters
    ----------
    questions : Questions
        Of a solution and a position.
    requested : sequence of Question
    scales : mapping of str to float
        Unit per mm of every plan.
    profile : Profile
        How well the sheet is drawn.
    """

    row: tuple[Errors, int] | None = None

    def __init__(
        self,
        questions: Questions,
        requested: Sequence[Question],
        scales: Mapping[str, float],
        profile: Profile,
    ) -> None:
        self.questions, self.requested = questions, tuple(requested)
        self.scales, self.profile = dict(scales), profile
        needs = {name for question in requested for name in question.needs}
        whole = questions.springs.program(questions.steps.b.program())
        self.program = whole.needed_for(needs)
        self.order = {step.out: number for number, step in enumerate(self.program.steps)}
        self.steps_by_name: dict[Name, Step] = {step.out: step for step in self.program.steps}
        self._local: dict[frozenset[Name], Local] = {}

    def for_variant(self, questions: Questions, scales: Mapping[str, float]) -> Sheet:
        """Return the sheet of another variant with the same requested quantities and steps."""
        other = copy.copy(self)
        kept = {"requested", "profile", "program", "order", "steps_by_name"}
        vars(other).clear()
        vars(other).update((key, value) for key, value in vars(self).items() if key in kept)
        other.questions, other.scales = questions, dict(scales)
        other._local = {}
        return other

    # Data ------------------------------------------------------------------------------------

    @cached_property
    def data(self) -> dict[str, Number]:
        """Data of the program."""
        solution, statics = self.questions.solution, self.questions.statics
        chosen = np.array([self.questions.position])
        data: dict[str, Number] = {**self.questions.steps.draft.numbers}
        data.update(self.questions.springs.data)
        if statics is None:
            return {**data, **solution.data(self.scales, chosen)}
        return {**data, **statics.data(self.scales, chosen)}

    @cached_property
    def free(self) -> frozenset[str]:
        """Poles and first points of the plans, whose position is arbitrary."""
        questions = self.questions
        free = {str(plan.pole) for plan in questions.construction.plans}
        if questions.statics is not None:
            free |= {str(start) for start in questions.statics.board.starts}
        return frozenset(free)

    @property
    def plans(self) -> tuple[Plan, ...]:
        """Plans that it has."""
        return self.questions.construction.plans

    # Exact -----------------------------------------------------------------------------------

    @cached_property
    def exact_trace(self) -> Trace:
        """Exact reading, mm."""
        return self.read(self.program)

    @cached_property
    def answer_key_sheet(self) -> Sheet:
        """The sheet as the key has it: read by columns, to the last bit as among other variants."""
        found = evaluate(self.program, self.data, Float64())
        return self.read_as(Trace(_numbers(found.value), _numbers(found.margin)))

    def read_as(self, trace: Trace) -> Sheet:
        """Return the sheet with another exact reading."""
        other = copy.copy(self)
        vars(other).pop("exact_answers", None)
        other.exact_trace = trace
        return other

    @cached_property
    def exact_answers(self) -> dict[str, float]:
        """Exact answers with their signs, by the id of the question."""
        return self.evaluate_answers(self.exact_trace)

    def evaluate_answers(self, trace: Trace) -> dict[str, float]:
        """Return the answers that a reading gives."""
        return {question.id: single_float(question.evaluate(trace)) for question in self.requested}

    def length(self, question: Question) -> float | None:
        """Return the length of the segment of a question, mm."""
        return (
            None
            if question.length is None
            else abs(single_float(self.exact_trace.value[question.length]))
        )

    def vector(self, question: Question, trace: Trace | None = None) -> complex | None:
        """Return the segment of a question as drawn on the plan, mm."""
        if question.ends is None:
            return None
        value = (trace or self.exact_trace).value
        tail, head = (single_point(value[end]) for end in question.ends)
        return (head - tail) * question.direction_sign

    # Errors ----------------------------------------------------------------------------------

    @cached_property
    def errors(self) -> Errors:
        """Drafting errors of the answers, by id."""
        return self.errors_of(self.program, self.data)

    def errors_of(self, program: Program, data: Mapping[str, Number]) -> Errors:
        """Return the drafting errors of the answers that another program gives."""
        return Errors(drafted_of(self, program, partial(at_positions, data), 1), draws=DRAWS)

    def sigma(self, question: Question) -> float:
        """Return one sigma of an answer; infinite where it has none."""
        errors, row = (self.errors, 0) if self.row is None else self.row
        sigma = float(errors.spreads[question.id].sigma[row])
        return sigma if math.isfinite(sigma) else math.inf

    # Replay ----------------------------------------------------------------------------------

    def replayed(
        self,
        values: StudentValues,
        program: Program | None = None,
        data: Mapping[str, float] = MappingProxyType({}),
    ) -> tuple[dict[Name, float], Trace]:
        """Substitute a student's own numbers; return the values they replace, and the trace.

        Parameters
        ----------
        values : mapping
            Number and whether its sign is the student's; else it takes the sign of the derived
            value.
        program, data : Program, mapping
            With a mistake; data in place of the right ones.
        """
        local: dict[Name, float] = {}

        def substitute(name: Name, value: Number) -> Number:
            if name not in values:
                return value
            local[name] = single_float(value)
            number, signed = values[NumberName(name)]
            if not signed and local[name] < 0:
                number = -abs(number)
            return number

        return local, self.read(program or self.program, data, substitute)

    def read(
        self,
        program: Program,
        data: Mapping[str, float] = MappingProxyType({}),
        substitute: Substitution | None = None,
    ) -> Trace:
        """Read a program with this sheet's data, or others in their place."""
        whole = {**self._single, **data} if data else self._single
        try:
            return evaluate(program, whole, Single(), substitute)
        except (ZeroDivisionError, OverflowError):  # arrays make it infinite, or NaN
            return evaluate(program, {**self.data, **data}, Float64(), substitute)

    @cached_property
    def _single(self) -> dict[str, Number]:
        return {name: Single().lift(value) for name, value in self.data.items()}

    def local(self, names: Iterable[NumberName]) -> Local:
        """Return the errors left when some numbers are given: sigmas and slopes."""
        given = frozenset[Name](names)
        if given not in self._local:
            self._local[given] = self.localised(given, self.program, self.data)
        return self._local[given]

    def localised(
        self,
        known: Iterable[Name],
        program: Program,
        data: Mapping[str, Number],
        values: StudentValues = MappingProxyType({}),
    ) -> Local:
        """Return the same of another program, or where the plans are drawn with given values."""
        names = sorted(known, key=self.order.__getitem__)
        causes, count = causes_of(program, lambda: data, self.free), len(names)
        pencil = Propagated(self.profile, self.free, causes + count)
        row = {name: causes + number for number, name in enumerate(names)}
        sigma: dict[Name, float] = {}
        slopes: dict[tuple[Name, Name], float] = {}

        def substitute(name: Name, value: Number) -> Number:
            if name not in row:
                return value
            made = as_dual(value)
            slope = np.zeros(causes + count) if made.slope is None else made.slope[:, 0]
            sigma[name] = float(np.sqrt((slope[:causes] ** 2).sum()))
            for other in names:
                if slope[row[other]]:
                    slopes[name, other] = float(slope[row[other]])
            base = made.value
            if name in values:
                number, signed = values[NumberName(name)]
                turned = not signed and np.reshape(base, -1)[0] < 0
                base = np.full_like(base, -abs(number) if turned else number)
            return base + pencil.caused(row[name], 1.0)

        evaluate(program, data, pencil, substitute)
        return Local(sigma, slopes)


def drafted_of(
    sheet: Sheet,
    program: Program,
    data: Callable[[npt.NDArray[np.intp]], dict[str, Number]],
    count: int,
) -> Drafted:
    """Return the measured quantities of a sheet, or of sheets with the same steps."""
    items: list[DrawnQuantity] = []
    for q in sheet.requested:
        kind = KINDS.get(q.sign, DrawnKind.NUMBER)
        needs = q.needs[: 1 if q.name is not None else None]
        take = partial(_sized, q) if q.sign is Sign.SIZE else q.evaluate
        way = f"angle of {q.id}" if q.sign is Sign.SIZE and q.ends is not None else ""
        items.append(DrawnQuantity(q.id, needs, take, kind, direction=way))
        if way and q.ends is not None:
            turn = partial(_angle_of, q.ends)
            items.append(DrawnQuantity(way, q.ends, turn, DrawnKind.DIRECTION))
    return Drafted(program, data, count, sheet.profile, sheet.free, tuple(items))


def _numbers(values: Mapping[Name, Number]) -> dict[Name, Number]:
    """Return arrays of one row as numbers of Python; of a line both of its."""

    def one(value: Number) -> Number:
        if isinstance(value, tuple):
            return tuple(map(one, value))
        return np.reshape(value, -1)[0].item()

    return {name: one(value) for name, value in values.items()}


def _sized(question: Question, trace: Trace) -> Number:
    return abs(question.evaluate(trace))


def _angle_of(ends: Ends, trace: Trace) -> Number:
    tail, head = ends
    return angle(trace.value[head] - trace.value[tail], ZERO_LENGTH_MM) * RADIAN


DIRECTIONS = {Sense.RIGHT: 1 + 0j, Sense.UP: 1j, Sense.LEFT: -1 + 0j, Sense.DOWN: -1j}

MIN_COMPONENT = 0.26
"""Fraction of a vector along a direction, sin 15°, below which it does not point that way."""


def sense_of(sheet: Sheet, question: Question) -> Sense | None:
    """Return the main sense of a quantity; None where it has none."""
    if question.sign is Sign.TURN and _turns(question):
        value = sheet.exact_answers[question.id]
        return None if not value else Sense.CCW if value > 0 else Sense.CW
    vector = sheet.vector(question)
    if vector is None or not abs(vector) > 0:
        return None
    return max(DIRECTIONS, key=lambda sense: (vector * DIRECTIONS[sense].conjugate()).real)


def is_right(
    sheet: Sheet, question: Question, sense: Sense, trace: Trace | None = None
) -> bool | None:
    """Return whether a sense is right on a sheet; None if it cannot be decided.

    A vector at an angle points in both directions of its components.
    """
    if question.sign is Sign.TURN and _turns(question):
        value = single_float(question.evaluate(trace or sheet.exact_trace))
        return None if not sense.turns or not value else (value > 0) is (sense is Sense.CCW)
    vector = sheet.vector(question, trace)
    if sense.turns or vector is None or not abs(vector) > 0:
        return None
    along = (vector * DIRECTIONS[sense].conjugate()).real / abs(vector)
    return None if abs(along) < MIN_COMPONENT else along > 0


def _turns(question: Question) -> bool:
    return question.unit in ("1/s", "1/s²", "N·m")
