"""What is taken off a drawing: quantities, the steps that they need, how they are read."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt

from planmethod.construct.arithmetic import Arithmetic, Number
from planmethod.construct.drafting import Profile
from planmethod.construct.evaluate import Trace
from planmethod.construct.program import Program
from planmethod.construct.steps import LayOff, Measure, MeasureAlong, Name, PointName

Flags = npt.NDArray[np.bool_]

RADIAN = float(np.degrees(1.0))
"""What the sigma of a direction is to be compared with, degrees: the length it is the turn of."""


class ItemKind(Enum):
    """What a quantity is: near zero no error of a length is normal, nor that of its direction."""

    NUMBER = "number"
    LENGTH = "length"
    DIRECTION = "direction"  # degrees


@dataclass(frozen=True, slots=True)
class Item:
    """A quantity that a drawing gives (величина чертежа).

    Attributes
    ----------
    label : str
        ``velocity.p-b`` (mm of the plan), ``x_B``, ``v_B``, ``F_2_1`` (SI), ``angle_F_2_1``
        (degrees).
    needs : tuple of Name
        Steps that it is taken from.
    take : callable
        The quantity from the readings of a trace; the same segment is read once.
    kind : ItemKind
    absent : callable or None
        The positions in which nobody draws what it is taken from: there it has no error.
    direction : str
        Label of the direction of a length, if the drawing gives it: where that is not believed, the
        length is not either, for what is off across a segment then makes it longer.
    """

    label: str
    needs: tuple[Name, ...]
    take: Callable[[Reading], Number]
    kind: ItemKind = ItemKind.NUMBER
    absent: Callable[[], Flags] | None = None
    direction: str = ""


class Reading:
    """A trace and what is read off it: every segment once, as a person does."""

    def __init__(self, program: Program, trace: Trace, pencil: Arithmetic) -> None:
        self.trace, self.pencil = trace, pencil
        self._read: dict[tuple[PointName, PointName], Number] = {}
        self._computed: dict[tuple[PointName, PointName], Number] = {}
        self._once: dict[str, Number] = {}
        for step in program.steps:
            if isinstance(step, Measure | MeasureAlong):
                self._read[step.tail, step.head] = abs(trace.value[step.out])
            elif isinstance(step, LayOff):
                self._computed[step.origin, step.out] = abs(trace.value[step.length])

    def length(self, tail: PointName, head: PointName) -> Number:
        """Return a segment as it is read on the drawing, mm."""
        if (tail, head) not in self._read:
            drawn = abs(self.trace.value[head] - self.trace.value[tail])
            self._read[tail, head] = self.pencil.read(f"{tail}-{head}", drawn)
        return self._read[tail, head]

    def once(self, label: str, take: Callable[[], Number]) -> Number:
        """Return what is taken when it is first asked for, and the same from then on."""
        if label not in self._once:
            self._once[label] = take()
        return self._once[label]

    def known(self, tail: PointName, head: PointName) -> Number:
        """Return a segment as a person knows it: computed if it was laid off, else read, mm."""
        computed = self._computed.get((tail, head))
        return self.length(tail, head) if computed is None else computed


@dataclass(frozen=True, slots=True)
class Drafted:
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
    items : sequence of Item
    points : tuple of PointName
        Those whose ellipses may be asked for.
    """

    program: Program
    data: Callable[[npt.NDArray[np.intp]], dict[str, Number]]
    count: int
    profile: Profile
    free: frozenset[str]
    items: tuple[Item, ...]
    points: tuple[PointName, ...] = ()


# Takers --------------------------------------------------------------------------------------


def segment(tail: PointName, head: PointName) -> Callable[[Reading], Number]:
    """Return what reads a segment, mm."""
    return lambda reading: reading.length(tail, head)


def number(name: Name) -> Callable[[Reading], Number]:
    """Return what takes a computed number."""
    return lambda reading: reading.trace.value[name]
