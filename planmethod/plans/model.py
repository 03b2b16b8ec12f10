"""Parts of a plan besides its steps: vectors, vector equations, letters."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from msgspec import Struct

from planmethod.construct.steps import PointName
from planmethod.problem.model import Convention, Problem


class PlanKind(Enum):
    """Kind of plan (вид плана)."""

    POSITION = "position"
    VELOCITY = "velocity"
    ACCELERATION = "acceleration"
    FORCE = "force"
    LEVER = "lever"


class PlanFacts(Struct, frozen=True):
    """Properties of a kind of plan (масштаб, полюс и единица плана).

    Attributes
    ----------
    pole : str
        Letter of the pole; empty where a plan has none.
    letter : str
        Of the vectors: ``v``; the length of a link on the position plan.
    scale : str
        Name of the scale: ``mu_v``, in letters ``μ_{v}``.
    unit : str
        Unit of the value that a segment represents.
    prefix : str
        Beginning of the names of the plan's points in a program.
    """

    pole: str
    letter: str
    scale: str
    unit: str
    prefix: str = ""


FACTS: dict[PlanKind, PlanFacts] = {
    PlanKind.POSITION: PlanFacts("", "l", "mu_l", "m"),
    PlanKind.VELOCITY: PlanFacts("p", "v", "mu_v", "m/s", "v:"),
    PlanKind.ACCELERATION: PlanFacts("π", "a", "mu_a", "m/s²", "a:"),
    PlanKind.FORCE: PlanFacts("", "F", "mu_F", "N", "f:"),
    PlanKind.LEVER: PlanFacts("p", "v", "mu_v", "m/s", "f:"),
}
"""The one table of the kinds of plans."""

MOTION = (PlanKind.POSITION, PlanKind.VELOCITY, PlanKind.ACCELERATION)
"""Plans that every problem has, in the order in which they are drawn."""

RATES = MOTION[1:]
"""The plans among them whose vectors start from a pole."""


def is_primed(problem: Problem, kind: PlanKind) -> bool:
    """Return whether a plan's letters carry a prime: the acceleration plan of the mm/unit books."""
    return kind is PlanKind.ACCELERATION and problem.scales.convention is Convention.MM_PER_UNIT


def pole_letter(problem: Problem, kind: PlanKind) -> str:
    """Return the letter of a plan's pole: p, π; p′ for the latter in the mm/unit books."""
    return "p′" if is_primed(problem, kind) else FACTS[kind].pole


class VectorKind(Enum):
    """Kind of component that a vector of a plan represents (вид составляющей)."""

    ABSOLUTE = "absolute"  # from the pole: v_B, a_B (абсолютная)
    RELATIVE = "relative"  # v_CB, or the whole a_CB (относительная)
    NORMAL = "normal"  # a^n_CB (нормальное)
    TANGENTIAL = "tangential"  # a^tau_CB (касательное)
    CORIOLIS = "coriolis"  # a^k_B3B (кориолисово)
    SLIDING = "sliding"  # along a guide: v_B3B, a^r_B3B (относительная по направляющей)


class KnownParts(Enum):
    """Number of underlines of a term: which parts of it are known before the plan is drawn."""

    NONE = 0
    ONE = 1  # direction only: one line
    BOTH = 2  # magnitude and direction: two lines


class Relation(Enum):
    """Relation of a vector to a line that is already on the drawing."""

    PARALLEL = "along"  # ∥ (параллельно)
    PERPENDICULAR = "across"  # ⊥ (перпендикулярно)
    ANGLED = "angled"  # at an angle to it
    TOWARDS = "towards"  # along it, from the first point to the second
    ZERO = "still"  # no vector at all: = 0


class Direction(Struct, frozen=True):
    """Direction of a vector as it is known before the plan is drawn (направление вектора).

    Attributes
    ----------
    relation : Relation
    points : tuple of str
        Two points of the mechanism on the line; none where it is a guide.
    guide : str
        Name of the guide, or letters of a line of a link.
    angle : float
        From the line, degrees; zero but for ``ANGLED``.
    """

    relation: Relation
    points: tuple[str, ...] = ()
    guide: str = ""
    angle: float = 0.0


ZERO_VECTOR = Direction(Relation.ZERO)


def perpendicular_to(p: str, q: str) -> Direction:
    """Return the direction across the line of two points: ``⊥ BC``."""
    return Direction(Relation.PERPENDICULAR, (p, q))


def towards(p: str, q: str) -> Direction:
    """Return the direction from a point to another: ``C → B``."""
    return Direction(Relation.TOWARDS, (p, q))


class Vector(Struct, frozen=True):
    """One term of a vector equation and the segment of the plan that shows it.

    Attributes
    ----------
    symbol : str
        Letter and indices in the markup of rich text: ``v_{CB}``, ``a^{n}_{CB}``.
    tail, head : PointName
        Plan points of the segment (equal letters where the vector is zero by nature).
    direction : Direction or None
        Parts of it known before the plan is drawn, written under the term.
    """

    symbol: str
    kind: VectorKind
    tail: PointName
    head: PointName
    known: KnownParts
    direction: Direction | None = None


class VectorEquation(Struct, frozen=True):
    """``left = right[0] + right[1] + ...`` (векторное уравнение)."""

    left: Vector
    right: tuple[Vector, ...]


class Plan(Struct, frozen=True):
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
