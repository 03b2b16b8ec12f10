"""What is asked of the cycle of a crank, put into plain records."""

from __future__ import annotations

from enum import Enum
from typing import Annotated

from msgspec import Struct

from planmethod.problem.declared import NumberKey, OwnKey, WholeKey, WordKey

DIAGRAM_HINT = "Millimetres of the diagrams."


class Zero(Enum):
    """Position zero by name: where the quicker stroke of the output starts, or the slower one."""

    EXTREME = "extreme"
    OTHER = "other extreme"


class Differentiation(Enum):
    """How a diagram is differentiated on paper (графическое дифференцирование)."""

    CHORDS = "chords"
    TANGENTS = "tangents"
    CURVE = "curve"


class PoleDistances(Struct, frozen=True):
    """Pole distances of both differentiations (полюсные расстояния)."""

    v: Annotated[
        float,
        NumberKey(
            "of the first differentiation", "a length", "mm", 1.0, 500.0, positive=True,
            hint=DIAGRAM_HINT,
        ),
    ] = 36.0  # fmt: skip
    a: Annotated[
        float,
        NumberKey(
            "of the second differentiation", "a length", "mm", 1.0, 500.0, positive=True,
            hint=DIAGRAM_HINT,
        ),
    ] = 36.0  # fmt: skip


class CycleTask(Struct, frozen=True):
    """What is asked of the cycle of a crank (цикл движения): ``[cycle]``."""

    output: Annotated[
        str | None,
        OwnKey(
            "a point on a guide of the frame, or a link; the last driven link that is joined with "
            "the frame when absent"
        ),
    ] = None
    zero: Annotated[
        Zero | float,
        OwnKey(
            'position zero: `"extreme"` (the default), `"other extreme"`, or the angle of the '
            "crank, degrees; numbered in the sense of the driver"
        ),
    ] = Zero.EXTREME
    count: Annotated[int, WholeKey("positions of a turn", 3, 360)] = 12
    length: Annotated[
        float,
        NumberKey(
            "of the axis of φ for a turn", "a length", "mm", 20.0, 2000.0, positive=True,
            hint=DIAGRAM_HINT,
        ),
    ] = 288.0  # fmt: skip
    pole: Annotated[
        PoleDistances,
        OwnKey("pole distances of both differentiations: `{ v = 36, a = 36 }`, mm"),
    ] = PoleDistances()
    differentiation: Annotated[
        Differentiation,
        WordKey(
            '`"chords"` (хорды), `"tangents"` (касательные) or `"curve"` (by chords of the drawn '
            "curve)"
        ),
    ] = Differentiation.CHORDS
