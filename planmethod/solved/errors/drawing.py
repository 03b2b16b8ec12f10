"""Quantities taken from a drawing: the steps that they need and how they are read."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import Enum

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.construct.arithmetic import Number
from planmethod.construct.drafting import AS_SCALED, Profile
from planmethod.construct.evaluate import Trace
from planmethod.construct.program import Program
from planmethod.construct.steps import Name, PointName
from planmethod.solved.reading import Flags

RADIAN = float(np.degrees(1.0))
"""Size with which the sigma of a direction is compared, degrees: one radian."""


class DrawnKind(Enum):
    """Kind of a quantity: near zero the errors of a length and its direction are not normal."""

    NUMBER = "number"
    LENGTH = "length"
    DIRECTION = "direction"  # degrees


class DrawnQuantity(Struct, frozen=True):
    """A quantity that a drawing gives (величина чертежа).

    Attributes
    ----------
    label : str
        ``velocity.p-b`` (mm of the plan), ``x_B``, ``v_B``, ``F_2_1`` (SI), ``angle_F_2_1``
        (degrees).
    needs : tuple of Name
        Steps that it is taken from.
    read : callable
        The quantity from a trace.
    kind : DrawnKind
    absent : callable or None
        Returns the positions in which its segment is not drawn: there it has no error.
    direction : str
        Label of the direction of a length, if the drawing gives it: if that is unreliable, so is
        the length, because an error across a segment then lengthens it.
    """

    label: str
    needs: tuple[Name, ...]
    read: Callable[[Trace], Number]
    kind: DrawnKind = DrawnKind.NUMBER
    absent: Callable[[], Flags] | None = None
    direction: str = ""


class Drafted(Struct, frozen=True):
    """A construction and the quantities read from it (чертёж).

    Attributes
    ----------
    program : Program
    data : callable
        Data of the program for some positions, by their indices.
    count : int
        Positions.
    profile : Profile
        The hand.
    free : frozenset of str
        Points that may be placed anywhere: they have no error.
    items : sequence of DrawnQuantity
    points : tuple of PointName
        Points whose ellipses can be requested.
    enlargements : mapping of str to Number
        Enlargement of a step relative to its scale, by its name: in all positions, or in each,
        shape (count,).
    """

    program: Program
    data: Callable[[npt.NDArray[np.intp]], dict[str, Number]]
    count: int
    profile: Profile
    free: frozenset[str]
    items: tuple[DrawnQuantity, ...]
    points: tuple[PointName, ...] = ()
    enlargements: Mapping[str, Number] = AS_SCALED

    def times(self, chosen: npt.NDArray[np.intp]) -> dict[str, Number]:
        """Return how many times larger steps are drawn in some positions."""
        return {
            out: times[chosen] if np.ndim(times) else times
            for out, times in self.enlargements.items()
        }


# Takers --------------------------------------------------------------------------------------


def number(name: Name, *, size: bool = False) -> Callable[[Trace], Number]:
    """Return a function that reads a number, or its size."""
    if size:
        return lambda trace: abs(trace.value[name])
    return lambda trace: trace.value[name]
