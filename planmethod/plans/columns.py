"""Problems of one kind planned at once: what differs is a column of numbers (варианты столбцами).

A plan depends on the numbers of a problem by comparisons alone: whether a point lies on a line,
which of two points is farther. `in_columns` puts the problems of many variants together as one
whose numbers are columns, and the plans are made of that one as of any operand. Where a comparison
has the same answer in all variants it is a truth value; where it has not, `DisagreementError` says
what each variant answers, and they are planned in as many parts as there are answers.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Hashable, Mapping, Sequence
from math import copysign
from typing import Any, TypeVar, cast

from msgspec.structs import replace

from planmethod.problem.model import Body, Problem

Value = TypeVar("Value", float, complex)


class DisagreementError(Exception):
    """Variants answer a comparison differently: they are not drawn by the same steps.

    Attributes
    ----------
    answers : tuple
        Of each variant, in order.
    """

    def __init__(self, answers: Sequence[Hashable]) -> None:
        super().__init__(answers)
        self.answers = tuple(answers)


def agreed(answers: Sequence[Hashable]) -> Any:
    """Return the answer that all variants give.

    Raises
    ------
    DisagreementError
    """
    if any(answer != answers[0] for answer in answers):
        raise DisagreementError(answers)
    return answers[0]


class Column:
    """A number of every variant; to the last bit as each has it alone.

    Parameters
    ----------
    values : sequence of complex
        Of the variants, in order.
    """

    __slots__ = ("values",)
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, values: Sequence[Any]) -> None:
        self.values = values

    def _with(self, operand: object, act: Callable[[Any, Any], Any]) -> list[Any]:
        if isinstance(operand, Column):
            return [act(one, two) for one, two in zip(self.values, operand.values, strict=True)]
        return [act(one, operand) for one in self.values]

    def __add__(self, operand: object) -> Column:
        return Column(self._with(operand, operator.add))

    def __sub__(self, operand: object) -> Column:
        return Column(self._with(operand, operator.sub))

    def __mul__(self, operand: object) -> Column:
        return Column(self._with(operand, operator.mul))

    def __truediv__(self, operand: object) -> Column:
        return Column(self._with(operand, operator.truediv))

    def __mod__(self, operand: object) -> Column:
        return Column(self._with(operand, operator.mod))

    def __radd__(self, operand: object) -> Column:
        return Column([cast("Any", operand) + one for one in self.values])

    def __rsub__(self, operand: object) -> Column:
        return Column([cast("Any", operand) - one for one in self.values])

    def __rmul__(self, operand: object) -> Column:
        return Column([cast("Any", operand) * one for one in self.values])

    def __rtruediv__(self, operand: object) -> Column:
        return Column([cast("Any", operand) / one for one in self.values])

    def __neg__(self) -> Column:
        return Column([-one for one in self.values])

    def __abs__(self) -> Column:
        return Column([abs(one) for one in self.values])

    def __round__(self, digits: int | None = None) -> Column:
        return Column([round(one, digits) for one in self.values])

    def conjugate(self) -> Column:
        """Return the conjugate of each."""
        return Column([one.conjugate() for one in self.values])

    @property
    def real(self) -> Column:
        """Real part of each."""
        return Column([one.real for one in self.values])

    @property
    def imag(self) -> Column:
        """Imaginary part of each."""
        return Column([one.imag for one in self.values])

    def __bool__(self) -> bool:
        return bool(agreed([bool(one) for one in self.values]))

    def __eq__(self, operand: object) -> bool:
        return self is operand or bool(agreed(self._with(operand, operator.eq)))

    def __ne__(self, operand: object) -> bool:
        return self is not operand and bool(agreed(self._with(operand, operator.ne)))

    def __lt__(self, operand: object) -> bool:
        return bool(agreed(self._with(operand, operator.lt)))

    def __le__(self, operand: object) -> bool:
        return bool(agreed(self._with(operand, operator.le)))

    def __gt__(self, operand: object) -> bool:
        return bool(agreed(self._with(operand, operator.gt)))

    def __ge__(self, operand: object) -> bool:
        return bool(agreed(self._with(operand, operator.ge)))


def each(function: Callable[[Any], Value], value: complex) -> Value:
    """Return a function of a number: of a column that of each."""
    if isinstance(value, Column):
        return cast("Value", Column([function(one) for one in value.values]))
    return function(value)


def largest(values: Sequence[Any]) -> float:
    """Return the largest of numbers, of columns that of each variant; 0 of none."""
    columns = [one.values for one in values if isinstance(one, Column)]
    if not columns:
        return max(values, default=0.0)
    rows = [one.values if isinstance(one, Column) else [one] * len(columns[0]) for one in values]
    return cast("float", Column([max(own) for own in zip(*rows, strict=True)]))


def entry(value: Value, number: int) -> Value:
    """Return the number that a variant has in a column; of all the same that one."""
    return cast("Value", value.values[number]) if isinstance(value, Column) else value


def _column(values: Sequence[Value]) -> Value:
    """Return a column; of numbers that are all the same, with the signs of their zeros, that."""
    first = values[0]
    if all(one is first or (one == first and _signs(one) == _signs(first)) for one in values):
        return first
    return cast("Value", Column(values))


def _signs(value: complex) -> tuple[float, float]:
    return copysign(1.0, value.real), copysign(1.0, value.imag)


def kind_of_plan(problem: Problem) -> Hashable:
    """Return the key that problems which differ only in sizes have in common."""
    bodies = tuple(
        (
            *(link, body.axis, body.arc, tuple(body.points), tuple(body.angles)),
            tuple((point, form.kind, form.line, form.point) for point, form in body.forms.items()),
        )
        for link, body in problem.bodies.items()
    )
    slides = tuple(
        (link, replace(slide, base=0j, offset=float(slide.offset != 0), length=None))
        for link, slide in problem.slides.items()
    )
    drive = problem.drive
    cam = drive.cam_drive
    follower = cam and (cam.turns, cam.n, cam.pieces, cam.lowest)
    driven = drive.link, drive.pivot, drive.rate == 0, drive.acceleration == 0, follower
    others = tuple(
        (one.link, one.pivot, one.rate == 0, one.acceleration == 0) for one in drive.other_drives
    )
    named = tuple((link, key) for link, key, _ in problem.lengths)
    whole = problem.mechanism, tuple(problem.guides.items()), problem.rules
    kind = problem.scales.convention, driven, others
    return *whole, problem.meshes, *kind, bodies, slides, named


def in_columns(problems: Sequence[Problem]) -> Problem:
    """Return problems of one kind as one whose sizes are columns; a single one as it is."""
    first = problems[0]
    if len(problems) == 1:
        return first
    bodies: dict[str, Body] = {}
    for link, body in first.bodies.items():
        own = [problem.bodies[link].points for problem in problems]
        bodies[link] = replace(
            body,
            points={point: _column([points[point] for points in own]) for point in body.points},
        )
    slides = {
        link: replace(
            slide,
            base=_column([problem.slides[link].base for problem in problems]),
            offset=_column([problem.slides[link].offset for problem in problems]),
        )
        for link, slide in first.slides.items()
    }
    lengths = tuple(
        (link, key, _column([problem.lengths[k][2] for problem in problems]))
        for k, (link, key, _) in enumerate(first.lengths)
    )
    return replace(first, bodies=bodies, slides=slides, lengths=lengths)


def entries(values: Mapping[str, Value], number: int) -> dict[str, Value]:
    """Return the numbers of a variant, by their names."""
    return {name: entry(value, number) for name, value in values.items()}
