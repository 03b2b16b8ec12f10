"""A moving point as its file states it: its formulas of time (формулы времени), its wheel."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from msgspec import Struct
from msgspec.structs import replace

from planmethod.problem.common import KindProblem
from planmethod.problem.file_node import FileNode, is_number
from planmethod.problem.formula import LENGTH_LIMIT, FormulaError, FormulaKind, Operation, Parser
from planmethod.problem.model import Scales
from planmethod.problem.names import describe_lookalikes, fold, lookalikes, short

ANGULAR = ("sin", "cos", "tg", "ctg")
"""Names of the functions of angles."""


class TimeFunction(Struct, frozen=True):
    """A function of time (формула).

    Attributes
    ----------
    text : str
        As the file has it.
    operations : tuple of Operation
        In the order in which they are carried out, operands before what joins them.
    """

    text: str
    operations: tuple[Operation, ...]

    @property
    def is_constant(self) -> bool:
        """True if it does not contain time."""
        return all(operation.kind is not FormulaKind.TIME for operation in self.operations)

    @property
    def in_degrees(self) -> TimeFunction:
        """The function on a calculator that is set to degrees."""
        told = (
            replace(one, name=f"{one.name} deg") if one.name in ANGULAR else one
            for one in self.operations
        )
        return replace(self, operations=tuple(told))


def read_formula(node: FileNode, *, constant: bool = False) -> TimeFunction:
    """Read a formula, or a number in its place.

    Parameters
    ----------
    constant : bool
        It may not contain time.
    """
    text = node.value
    if is_number(text):
        text = repr(text)
        if len(text) > LENGTH_LIMIT or text.strip("-") in ("inf", "nan"):
            node.reject("expected a finite number, got {}", short(text))
    if not isinstance(text, str):
        node.reject_value("a formula", 'For example: "3*t*exp(t/2)".')
    if len(text) > LENGTH_LIMIT:
        message = "the formula has {} characters, the limit is {}"
        node.reject(message, len(text), LENGTH_LIMIT)
    if lookalikes(text):
        node.note(describe_lookalikes(text), hint="Type formulas in the Latin layout.")
    try:
        formula = TimeFunction(text, tuple(Parser(fold(text)).parse()))
    except FormulaError as error:
        node.reject(str(error), hint=error.hint)
    if constant and not formula.is_constant:
        hint = 'For example: "pi/2".'
        node.reject("expected a number or a formula without t", hint=hint)
    return formula


class Law(Enum):
    """Form in which the motion of a point is stated (способ задания движения)."""

    COORDINATES = "coordinates"
    POLAR = "polar"
    NATURAL = "natural"
    ROLLING = "rolling"


FORMULAS: Mapping[Law, tuple[str, ...]] = {
    Law.COORDINATES: ("x", "y"),
    Law.POLAR: ("r", "phi"),
    Law.NATURAL: ("s",),
    Law.ROLLING: ("phi",),
}
"""Keys of the formulas that state a motion."""


class Wheel(Struct, frozen=True):
    """Wheel that rolls without slipping and carries the point (катящееся колесо).

    Attributes
    ----------
    radius : float, m
    r : float, m
        Distance of the point from the centre.
    angle : float, degrees
        From the x axis to the point, seen from the centre, where phi is 0.
    track : float, m
        Radius of the fixed circle about the origin that it rolls on from outside; negative: within;
        0: it rolls on the x axis. At phi = 0 the wheel is above the origin, or below it when inside
        a circle.
    arm : float, m
        Of the carrier about the origin with the wheel's centre at its end, for a planet that
        a train rotates by a law of its own (``theta``); 0: the wheel rolls.
    """

    radius: float
    r: float
    angle: float
    track: float
    arm: float = 0.0


class PointProblem(KindProblem, frozen=True, kw_only=True):
    """A moving point (движущаяся точка).

    Attributes
    ----------
    law : Law
    formulas : mapping of str to TimeFunction
        By the keys of `FORMULAS`; metres, radians, seconds.
    radius : float or None, m
        Of the circle along which a natural motion runs, counter-clockwise from (radius, 0) about
        the origin; None along the x axis.
    wheel : Wheel or None
        What carries the point; phi is then how far it has turned, counter-clockwise.
    times : tuple of float, s
    blur : tuple of float
        Relative errors of the times in float64; 0 where it represents them exactly.
    show : (float, float) or None, s
        The interval that is drawn.
    """

    law: Law
    formulas: Mapping[str, TimeFunction]
    radius: float | None
    wheel: Wheel | None
    times: tuple[float, ...]
    blur: tuple[float, ...]
    show: tuple[float, float] | None
    scales: Scales
