"""What is taken off a drawing: quantities, the steps that they need, how they are read."""

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
"""What the sigma of a direction is to be compared with, degrees: the length it is the turn of."""


class DrawnKind(Enum):
    """What a quantity is: near zero no error of a length is normal, nor that of its direction."""

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
    take : callable
        The quantity from a trace.
    kind : DrawnKind
    absent : callable or None
        The positions in which nobody draws what it is taken from: there it has no error.
    direction : str
        Label of the direction of a length, if the drawing gives it: where that is not believed, the
        length is not either, for what is off across a segment then makes it longer.
    """

    label: str
    needs: tuple[Name, ...]
    take: Callable[[Trace], Number]
    kind: DrawnKind = DrawnKind.NUMBER
    absent: Callable[[], Flags] | None = None
    direction: str = ""


class Drafted(Struct, frozen=True):
    """What is drawn, and what is taken off it (чертёж).

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
        Points that may stand anywhere: they cannot be off.
    items : sequence of DrawnQuantity
    points : tuple of PointName
        Those whose ellipses may be asked for.
    enlarged : mapping of str to Number
        How many times larger than by its scale a step is drawn, by its name: in all positions, or
        in each, shape (count,).
    """

    program: Program
    data: Callable[[npt.NDArray[np.intp]], dict[str, Number]]
    count: int
    profile: Profile
    free: frozenset[str]
    items: tuple[DrawnQuantity, ...]
    points: tuple[PointName, ...] = ()
    enlarged: Mapping[str, Number] = AS_SCALED

    def times(self, chosen: npt.NDArray[np.intp]) -> dict[str, Number]:
        """Return how many times larger steps are drawn in some positions."""
        return {
            out: times[chosen] if np.ndim(times) else times for out, times in self.enlarged.items()
        }


# Takers --------------------------------------------------------------------------------------


def number(name: Name, *, size: bool = False) -> Callable[[Trace], Number]:
    """Return what takes a number, or its size."""
    if size:
        return lambda trace: abs(trace.value[name])
    return lambda trace: trace.value[name]
