"""How plans are placed on a drawing: rotated, mirrored, in which unit (положение плана)."""

from __future__ import annotations

import math
import statistics
from cmath import phase
from collections.abc import Iterable, Iterator, Mapping, Sequence

from msgspec import Struct

from planmethod.check.measured.drawing import MeasuredDrawing
from planmethod.plans.model import PlanKind

Vectors = Sequence[tuple[complex, complex]]
"""Vectors of a plan as drawn and as they are exactly, mm."""

MIN_VECTORS = 3
"""Minimum number of vectors of sufficient length that agree."""

MAJORITY = 0.6
"""Minimum share of the vectors that agree: the others may be wrong."""

SAME_DEG = 2.0
"""Maximum difference of the rotations of vectors for the plan to be rotated as a whole."""

MAX_TURN_SPREAD = 0.4
"""The same, as a share of the rotation: a mistake rotates different vectors differently."""

MIN_ROTATION_DEG = 0.5
LIKE_DEG = 10.0
"""Half a turn of one plan is a mistake: the crank turned the other way. So near to it no plan
counts as rotated."""


class Placement(Struct, frozen=True):
    """How a plan is placed on the paper (положение плана на листе).

    Attributes
    ----------
    turn_deg : float
        Rotation of the whole plan; 0 if it has none.
    mirrored : bool
        Whether the plan is reflected in the horizontal before it is rotated.
    """

    turn_deg: float = 0.0
    mirrored: bool = False

    def direction(self, vector: complex) -> float:
        """Return the direction that a vector has without this placement, degrees."""
        turn = math.degrees(phase(vector)) - self.turn_deg
        return _within_half_turn(-turn if self.mirrored else turn)


def find_placements(plans: Mapping[PlanKind, Vectors]) -> dict[PlanKind, Placement]:
    """Return how plans are placed: all together, else each of them by itself.

    Only a drawing that is mirrored with all of its plans counts as mirrored.
    """
    whole = [pair for vectors in plans.values() for pair in vectors]
    turn = _common_turn(drawn / exact for drawn, exact in whole)
    if turn is None:
        mirror = _common_turn(drawn / exact.conjugate() for drawn, exact in whole)
        if mirror is not None:
            return dict.fromkeys(plans, Placement(mirror, mirrored=True))
    elif len(plans) > 1 or abs(turn) < 180.0 - LIKE_DEG:
        return dict.fromkeys(plans, Placement(turn))
    return {kind: Placement(_own_turn(vectors)) for kind, vectors in plans.items()}


def _own_turn(vectors: Vectors) -> float:
    turn = _common_turn(drawn / exact for drawn, exact in vectors) or 0.0
    return turn if abs(turn) < 180.0 - LIKE_DEG else 0.0


def _common_turn(ratios: Iterable[complex]) -> float | None:
    """Return by how many degrees most vectors are rotated; None where they do not agree."""
    turns = [math.degrees(phase(one)) for one in ratios]
    least = max(MIN_VECTORS, MAJORITY * len(turns))
    best = [0.0]
    for first in turns:
        off = [_within_half_turn(turn - first) for turn in turns]
        best = max(best, [first + one for one in off if abs(one) < SAME_DEG / 2], key=len)
    if len(best) < least:
        return None
    mean = _within_half_turn(math.fsum(best) / len(best))
    spread = max(best) - min(best)
    return mean if spread < MAX_TURN_SPREAD * abs(mean) and abs(mean) > MIN_ROTATION_DEG else 0.0


def _within_half_turn(degrees: float) -> float:
    return (degrees + 180.0) % 360.0 - 180.0


# Units of the drawing -------------------------------------------------------------------------

UNITS_MM = (1.0, 10.0, 1000.0, 25.4)
LETTERS_MM = 1.0, 20.0
"""Heights of letters on a sheet, mm."""


def list_other_units(drawing: MeasuredDrawing) -> Iterator[tuple[float, MeasuredDrawing]]:
    """Yield units, mm, and the drawing in each, if its letters then have a usual height."""
    for mm in UNITS_MM if drawing.inscriptions else ():
        factor = mm / drawing.unit_mm
        if has_usual_letters(drawing, factor) and abs(factor - 1.0) > 1e-6:
            yield mm, drawing.enlarged(factor)


def has_usual_letters(drawing: MeasuredDrawing, factor: float = 1.0) -> bool:
    """Return whether the letters of a drawing, enlarged by a factor, have a usual height."""
    low, top = LETTERS_MM
    high = [text.high for text in drawing.inscriptions]
    return not high or low <= statistics.median(high) * factor <= top
