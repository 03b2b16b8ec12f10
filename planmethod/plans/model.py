"""What a plan is made of besides its steps: vectors, vector equations, letters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from planmethod.construct.steps import PointName

FORCE_PREFIX = "f:"
"""What the names of the points and numbers of the force plans begin with."""


class VectorKind(Enum):
    """What a vector of a plan stands for (вид составляющей)."""

    ABSOLUTE = "absolute"  # from the pole: v_B, a_B (абсолютная)
    RELATIVE = "relative"  # v_CB, or the whole a_CB (относительная)
    NORMAL = "normal"  # a^n_CB (нормальное)
    TANGENTIAL = "tangential"  # a^tau_CB (касательное)
    CORIOLIS = "coriolis"  # a^k_B3B (кориолисово)
    SLIDING = "sliding"  # along a guide: v_B3B, a^r_B3B (относительная по направляющей)


class Known(Enum):
    """How many underlines the term has: what of it is known before the plan is drawn."""

    NOTHING = 0
    ONE = 1  # direction only: one line
    BOTH = 2  # magnitude and direction: two lines


@dataclass(frozen=True, slots=True)
class Vector:
    """One term of a vector equation and the segment of the plan that shows it.

    Attributes
    ----------
    symbol : str
        Letter and indices in the markup of rich text: ``v_{CB}``, ``a^{n}_{CB}``.
    tail, head : PointName
        Plan points of the segment (equal letters where the vector is zero by nature).
    note : str
        Direction written under the term: ``⊥ BC``, ``∥ x-x``, ``C → B``, ``= 0``.
    """

    symbol: str
    kind: VectorKind
    tail: PointName
    head: PointName
    known: Known
    note: str = ""


@dataclass(frozen=True, slots=True)
class VectorEquation:
    """``left = right[0] + right[1] + ...`` (векторное уравнение)."""

    left: Vector
    right: tuple[Vector, ...]


class PlanKind(Enum):
    """Which plan (вид плана)."""

    POSITION = "position"
    VELOCITY = "velocity"
    ACCELERATION = "acceleration"


@dataclass(frozen=True, slots=True)
class Plan:
    """One plan for all positions (план); its steps are in the program of the solution.

    Attributes
    ----------
    pole : PointName or None
        None for the position plan.
    letters : mapping of PointName to str
        Rich-text letter of every plan point that is drawn: ``b``, ``b_{3}``, ``n_{CB}``, ``k``.
    vectors : tuple of Vector
        Every segment drawn and measured, each once.
    equations : tuple of VectorEquation
        In the order of solving.
    """

    kind: PlanKind
    pole: PointName | None
    letters: Mapping[PointName, str]
    vectors: tuple[Vector, ...]
    equations: tuple[VectorEquation, ...] = ()
