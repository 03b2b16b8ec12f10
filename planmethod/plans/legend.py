"""Legend of a construction: every quantity once, and the step that makes it (перечень величин).

This is the only place with a quantity's name, label, unit and columns; all writers of quantities
read it.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum, unique

from msgspec import Struct

from planmethod.construct.steps import Compute, LayOffLength, Name, NumberName, PointName
from planmethod.plans.draft import Draft
from planmethod.plans.model import RATES, PlanKind
from planmethod.plans.motion.board import MotionBoard, plan_letter
from planmethod.plans.motion.legs import Kinematics

ZERO = "0"
"""Name of the number zero, which no object of a problem can have."""


class KindFacts(Struct, frozen=True):
    """Properties of a kind of quantity.

    Attributes
    ----------
    letter : str
        Beginning of its label: ``omega``.
    unit : str
        In SI; degrees of a direction.
    plan : PlanKind
        Plan on which it is found.
    columns : tuple of str
        Endings of the names of table columns; none if the label is the name.
    sign : str
        Letter of the symbol, ``ω``; empty where it is ``letter``.
    is_number : bool
        True if it is one number and not a vector.
    is_size : bool
        True if the drawing gives only its size, without a sign.
    """

    letter: str
    unit: str
    plan: PlanKind
    columns: tuple[str, ...] = ()
    sign: str = ""
    is_number: bool = False
    is_size: bool = False


_P, _V, _A, _F = PlanKind.POSITION, PlanKind.VELOCITY, PlanKind.ACCELERATION, PlanKind.FORCE


@unique
class QuantityKind(Enum):
    """Kind of a quantity (вид величины): its letters, unit, plan, columns."""

    PLACE = KindFacts("", "m", _P, (".x", ".y"))
    VELOCITY = KindFacts("v", "m/s", _V, (".vx", ".vy"), is_size=True)
    ACCELERATION = KindFacts("a", "m/s²", _A, (".ax", ".ay"), is_size=True)
    DIRECTION = KindFacts("phi", "deg", _P, (".phi_deg",), "φ")
    UNIT = KindFacts("u", "1", _P, (".cos", ".sin"))  # the direction as a unit vector
    OMEGA = KindFacts("omega", "1/s", _V, (".omega",), "ω", is_number=True)
    EPSILON = KindFacts("epsilon", "1/s²", _A, (".epsilon",), "ε", is_number=True)
    # Of sliding in a pair: the relative velocity and acceleration are signed along the slide line.
    SLIDING = KindFacts("v", "m/s", _V, is_number=True, is_size=True)
    CORIOLIS = KindFacts("ak", "m/s²", _A, is_number=True, is_size=True)
    RELATIVE = KindFacts("ar", "m/s²", _A, is_number=True, is_size=True)
    # Derivatives by the angle of the crank: of places, and of angles of links.
    TRANSFER = KindFacts("v_q", "m", _V, is_number=True, is_size=True)
    RATIO = KindFacts("u", "1", _V, is_number=True)
    TRANSFER_2 = KindFacts("a_q", "m", _A, is_number=True, is_size=True)
    RATIO_2 = KindFacts("epsilon_q", "1", _A, sign="ε", is_number=True)
    REACTION = KindFacts("F", "N", _F, (".x", ".y", ""), is_size=True)
    # Of a reaction or on the crank; on the driving slider, along its guide.
    MOMENT = KindFacts("M", "N·m", _F, ("",), is_number=True)
    THRUST = KindFacts("F", "N", _F, ("",), is_number=True)

    def __init__(self, facts: KindFacts) -> None:
        self.letter, self.sign = facts.letter, facts.sign or facts.letter
        self.unit, self.plan, self.columns = facts.unit, facts.plan, facts.columns
        self.is_number, self.is_size = facts.is_number, facts.is_size
        self.is_force = facts.plan is PlanKind.FORCE


PLAN_OF = {kind.letter: kind.plan for kind in QuantityKind}
"""Plans by the letters at the beginning of labels."""


TURNING = (QuantityKind.DIRECTION, QuantityKind.OMEGA, QuantityKind.EPSILON)
"""Kinds of quantities of links."""

TRANSFERS = (
    QuantityKind.TRANSFER,
    QuantityKind.RATIO,
    QuantityKind.TRANSFER_2,
    QuantityKind.RATIO_2,
)
"""Kinds of transfer functions, in the order in which tables have them."""

TURNINGS = tuple(kind for kind in TURNING if kind.is_number)
"""The kinds among them that the plans give."""

MOTION_KINDS = tuple(
    kind
    for plan in RATES
    for kind in (QuantityKind.VELOCITY, QuantityKind.ACCELERATION, *TURNINGS)
    if kind.plan is plan
)
"""Kinds of quantities of points and links that the plans give, in the order in which tables have
them."""


def kinds_on(plan: PlanKind) -> tuple[QuantityKind, ...]:
    """Return the quantities among them that a plan gives."""
    return tuple(kind for kind in MOTION_KINDS if kind.plan is plan)


class Quantity(Struct, frozen=True):
    """One quantity of a solved problem (величина).

    Attributes
    ----------
    kind : QuantityKind
    name : Name
        Step that makes it: a point of a plan (its vector is from the pole), a number, or for a
        direction the line of the link's own axis; `ZERO` if it is zero by nature.
    of : str
        Point, link, or pair; of a reaction its joint and links, ``B_2/1`` (on link 2 from 1).
    size : NumberName or None
        Number that the drawing gives for it; None for places and directions.
    row : str
        Beginning of the names of its columns, if not ``of``: ``F.B.2-1``.
    shown : str
        Symbol as rich text, if not the letter of its kind with ``of`` as an index.
    opposite : str
        Symbol of the opposite reaction.
    """

    kind: QuantityKind
    name: Name
    of: str
    size: NumberName | None = None
    row: str = ""
    shown: str = ""
    opposite: str = ""

    @property
    def label(self) -> str:
        """Label by which it is requested.

        ``B`` (a place), ``v_B``, ``a_B``, ``phi_2``, ``omega_2``, ``epsilon_2``, ``v_B3/2``,
        ``ak_B3/2``, ``ar_B3/2``; ``u_2``, the direction ``phi_2`` as a unit vector. Transfer
        functions are ``v_q_B``, ``u_21``, ``a_q_B``, ``epsilon_q_2``. Of forces
        ``F_B_2/1``, ``M_B_2/1`` (its moment), ``M_dr`` or ``F_dr``, ``M_lever`` or ``F_lever``.
        """
        return f"{self.kind.letter}_{self.of}" if self.kind.letter else self.of

    @property
    def symbol(self) -> str:
        """Symbol as rich text: ``ω_{2}``."""
        sign = self.kind.sign
        return self.shown or (f"{sign}_{{{self.of}}}" if sign else self.of)

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of its columns in a table of numbers: ``B.vx``, ``B.vy``; ``v_B3/2``."""
        stem = self.row or self.of
        return tuple(stem + end for end in self.kind.columns) or (self.label,)


class PlanSegment(Struct, frozen=True):
    """Segment of a plan that is measured on paper (отрезок плана).

    Attributes
    ----------
    kind : PlanKind
    name : str
        ``p-b3``.
    length : NumberName
        What the draughtsman knows of it, mm: laid off, or read.
    drawn : NumberName
        What the ruler gives on the finished drawing, mm; the same where it was read.
    """

    kind: PlanKind
    name: str
    length: NumberName
    drawn: NumberName

    @property
    def label(self) -> str:
        """Label of its drafting error: ``velocity.p-b3``."""
        return f"{self.kind.value}.{self.name}"


def motion_quantities(kinematics: Kinematics, draft: Draft) -> Iterator[Quantity]:
    """Yield the quantities of the motion: of points, links and sliding.

    Parameters
    ----------
    draft : Draft
        Receives the own axes of links that have no line yet.
    """
    velocity, acceleration = kinematics.velocity, kinematics.acceleration
    zero = draft.known(ZERO, 0.0)
    for name, at in velocity.named.items():
        yield Quantity(QuantityKind.PLACE, PointName(at[1]), name)
        for motion, kind in (
            (velocity, QuantityKind.VELOCITY),
            (acceleration, QuantityKind.ACCELERATION),
        ):
            yield Quantity(kind, motion.point[at], name, motion.size(at) or zero)
    for link in draft.problem.mechanism.links:
        axis = draft.axis(link)
        yield Quantity(QuantityKind.DIRECTION, axis, link)
        yield Quantity(QuantityKind.UNIT, axis, link)
        omega, epsilon = kinematics.omega.get(link, zero), kinematics.epsilon.get(link, zero)
        yield Quantity(QuantityKind.OMEGA, omega, link, omega)
        yield Quantity(QuantityKind.EPSILON, epsilon, link, epsilon)
    values = acceleration.segments.values
    for r in kinematics.relatives.values():
        assert r.a_start is not None and r.a_coriolis is not None and r.a_head is not None
        yield Quantity(QuantityKind.SLIDING, r.speed, r.name, r.speed)
        # A guide that does not turn makes no Coriolis acceleration.
        turned = values.get((r.a_start, r.a_coriolis), zero)
        yield Quantity(QuantityKind.CORIOLIS, turned, r.name, turned)
        along = values[r.a_coriolis, r.a_head]
        yield Quantity(QuantityKind.RELATIVE, along, r.name, along)


def plan_segments(draft: Draft, motions: tuple[MotionBoard, MotionBoard]) -> Iterator[PlanSegment]:
    """Yield the segments that are measured on the plans; adds the readings of those laid off."""
    b = draft.b
    computed = {step.out for step in b.steps if isinstance(step, Compute)}
    steps = [step for step in b.steps if isinstance(step, LayOffLength)]
    laid = {frozenset((step.origin, step.out)): step.length for step in steps}
    for p, q in draft.segments():
        drawn = draft.measured(p, q)
        length = laid.get(frozenset((PointName(p), PointName(q))), drawn)
        yield PlanSegment(PlanKind.POSITION, f"{p}-{q}", length, drawn)
    for motion in motions:
        for vector in motion.vectors:
            ends = (vector.tail, vector.head)
            length = motion.segments.drawn(ends)
            drawn = b.measure(f"{length} drawn", *ends) if length in computed else length
            tail, head = (plan_letter(motion, end) for end in ends)
            yield PlanSegment(motion.kind, f"{tail}-{head}", length, drawn)
