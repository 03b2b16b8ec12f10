"""Formulas of ``[point]``: functions of time (формулы времени)."""

from __future__ import annotations

from planmethod.languages import say
from planmethod.problem.fields import Faults, is_number
from planmethod.problem.formula import LENGTH_LIMIT, FormulaError, Kind, Operation, Parser
from planmethod.problem.names import describe_lookalikes, fold, lookalikes, short
from planmethod.record import dataclass, replace

ANGULAR = ("sin", "cos", "tg", "ctg")
"""Those of angles."""


@dataclass(frozen=True, slots=True)
class Formula:
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
        """Whether time does not stand in it."""
        return all(operation.kind is not Kind.TIME for operation in self.operations)

    @property
    def in_degrees(self) -> Formula:
        """The same as it is read off a calculator that takes its arguments for degrees."""
        told = (
            replace(one, name=f"{one.name} deg") if one.name in ANGULAR else one
            for one in self.operations
        )
        return replace(self, operations=tuple(told))


def read_formula(
    faults: Faults, path: str, value: object, *, constant: bool = False
) -> Formula | None:
    """Read a formula, or a number in its place; None after noting a fault.

    Parameters
    ----------
    constant : bool
        Time may not stand in it.
    """
    if is_number(value):
        value = repr(value)
        if len(value) > LENGTH_LIMIT or value.strip("-") in ("inf", "nan"):
            faults.add(path, say("expected a finite number, got {}", short(value)))
            return None
    if not isinstance(value, str):
        faults.expected(path, "a formula", value, 'For example: "3*t*exp(t/2)".')
        return None
    if len(value) > LENGTH_LIMIT:
        faults.add(
            path, say("the formula has {} characters, the limit is {}", len(value), LENGTH_LIMIT)
        )
        return None
    if lookalikes(value):
        faults.add(path, describe_lookalikes(value), "Type formulas in the Latin layout.")
    try:
        formula = Formula(value, tuple(Parser(fold(value)).parse()))
    except FormulaError as error:
        faults.add(path, str(error), error.hint)
        return None
    if constant and not formula.is_constant:
        faults.add(path, "expected a number or a formula without t", 'For example: "pi/2".')
        return None
    return formula
