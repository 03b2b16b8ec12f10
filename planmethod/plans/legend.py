"""Legend of a construction: every quantity once, and the step that makes it (перечень величин).

What a quantity is called, how it is asked for, its unit and which columns it has stand here;
whoever writes quantities down reads it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

from planmethod.construct.steps import Compute, LayOff, Name, NumberName, PointName
from planmethod.plans.draft import Draft
from planmethod.plans.model import PlanKind
from planmethod.plans.motion.board import Motion, plain_letter
from planmethod.plans.motion.leads import Kinematics

ZERO = "0"
"""Name of the number zero, which nothing in a problem can be called."""


class QuantityKind(Enum):
    """Kind of a quantity (вид величины): its unit, its columns, what of it the hand finds."""

    PLACE = "place"
    VELOCITY = "velocity"
    ACCELERATION = "acceleration"
    DIRECTION = "direction"
    UNIT = "unit"  # the direction as a unit vector
    OMEGA = "omega"
    EPSILON = "epsilon"
    SLIDING = "sliding"  # relative velocity, signed along the slide line
    CORIOLIS = "coriolis"
    RELATIVE = "relative"  # relative acceleration, signed along the slide line
    REACTION = "reaction"
    MOMENT = "moment"  # of a reaction, or on the crank
    THRUST = "thrust"  # on the driving slider, along its guide

    @property
    def unit(self) -> str:
        """Unit in SI; degrees of a direction."""
        return _FACTS[self][0]

    @property
    def columns(self) -> tuple[str, ...]:
        """What the names of the columns of a table end with; none where the label is the name."""
        return _FACTS[self][1]

    @property
    def is_number(self) -> bool:
        """Whether it is one number and not a vector."""
        return self in _NUMBERS

    @property
    def is_size(self) -> bool:
        """Whether the hand finds its size alone, without a sign."""
        return self in _SIZES

    @property
    def is_force(self) -> bool:
        """Whether it belongs to the force analysis."""
        return self in (QuantityKind.REACTION, QuantityKind.MOMENT, QuantityKind.THRUST)


_FACTS: dict[QuantityKind, tuple[str, tuple[str, ...]]] = {
    QuantityKind.PLACE: ("m", (".x", ".y")),
    QuantityKind.VELOCITY: ("m/s", (".vx", ".vy")),
    QuantityKind.ACCELERATION: ("m/s²", (".ax", ".ay")),
    QuantityKind.DIRECTION: ("deg", (".phi_deg",)),
    QuantityKind.UNIT: ("1", (".cos", ".sin")),
    QuantityKind.OMEGA: ("1/s", (".omega",)),
    QuantityKind.EPSILON: ("1/s²", (".epsilon",)),
    QuantityKind.SLIDING: ("m/s", ()),
    QuantityKind.CORIOLIS: ("m/s²", ()),
    QuantityKind.RELATIVE: ("m/s²", ()),
    QuantityKind.REACTION: ("N", (".x", ".y", "")),
    QuantityKind.MOMENT: ("N·m", ("",)),
    QuantityKind.THRUST: ("N", ("",)),
}
_NUMBERS = frozenset(
    {
        QuantityKind.OMEGA,
        QuantityKind.EPSILON,
        QuantityKind.SLIDING,
        QuantityKind.CORIOLIS,
        QuantityKind.RELATIVE,
        QuantityKind.MOMENT,
        QuantityKind.THRUST,
    }
)
_SIZES = frozenset(
    {
        QuantityKind.VELOCITY,
        QuantityKind.ACCELERATION,
        QuantityKind.SLIDING,
        QuantityKind.CORIOLIS,
        QuantityKind.RELATIVE,
        QuantityKind.REACTION,
    }
)


@dataclass(frozen=True, slots=True)
class Quantity:
    """One quantity of a solved problem (величина).

    Attributes
    ----------
    label : str
        How it is asked for: ``B`` (a place), ``v_B``, ``a_B``, ``phi_2``, ``omega_2``,
        ``epsilon_2``, ``v_B3/2``, ``ak_B3/2``, ``ar_B3/2``; ``u_2``, the direction ``phi_2`` as a
        unit vector. Of forces ``F_B_2/1`` (on link 2 from link 1), ``M_B_2/1`` (its moment),
        ``M_dr`` or ``F_dr``, ``M_lever`` or ``F_lever``.
    kind : QuantityKind
    name : Name
        Step that makes it: a point of a plan (its vector is from the pole), a number, or for a
        direction the line of the link's own axis; `ZERO` for what is zero by nature.
    of : str
        Point or link; of a force the beginning of its columns: ``F.B.2-1``.
    size : NumberName or None
        Number that the hand finds for it; None of places and directions.
    """

    label: str
    kind: QuantityKind
    name: Name
    of: str
    size: NumberName | None = None


@dataclass(frozen=True, slots=True)
class PlanSegment:
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
        """How its drafting error is asked for: ``velocity.p-b3``."""
        return f"{self.kind.value}.{self.name}"


def motion_quantities(kin: Kinematics, draft: Draft) -> Iterator[Quantity]:
    """Yield what is known of the motion: of points, of links, of sliding.

    Parameters
    ----------
    draft : Draft
        Gets the own axes of links that have no line yet.
    """
    velocity, acceleration = kin.velocity, kin.acceleration
    zero = draft.known(ZERO, 0.0)
    for name, at in velocity.named.items():
        yield Quantity(name, QuantityKind.PLACE, PointName(at[1]), name)
        for motion, letter, kind in (
            (velocity, "v", QuantityKind.VELOCITY),
            (acceleration, "a", QuantityKind.ACCELERATION),
        ):
            yield Quantity(
                f"{letter}_{name}", kind, motion.point[at], name, motion.size(at) or zero
            )
    for link in draft.problem.mechanism.links:
        axis = draft.axis(link)
        yield Quantity(f"phi_{link}", QuantityKind.DIRECTION, axis, link)
        yield Quantity(f"u_{link}", QuantityKind.UNIT, axis, link)
        omega, epsilon = kin.omega.get(link, zero), kin.epsilon.get(link, zero)
        yield Quantity(f"omega_{link}", QuantityKind.OMEGA, omega, link, omega)
        yield Quantity(f"epsilon_{link}", QuantityKind.EPSILON, epsilon, link, epsilon)
    values = acceleration.segments.values
    for r in kin.relatives.values():
        assert r.a_start is not None and r.a_turned is not None and r.a_head is not None
        yield Quantity(r.label("v"), QuantityKind.SLIDING, r.speed, r.point, r.speed)
        # A guide that does not turn makes no Coriolis acceleration.
        turned = values.get((r.a_start, r.a_turned), zero)
        yield Quantity(r.label("ak"), QuantityKind.CORIOLIS, turned, r.point, turned)
        along = values[r.a_turned, r.a_head]
        yield Quantity(r.label("ar"), QuantityKind.RELATIVE, along, r.point, along)


def plan_segments(draft: Draft, motions: tuple[Motion, Motion]) -> Iterator[PlanSegment]:
    """Yield the segments that are measured on the plans; adds the readings of those laid off."""
    b = draft.b
    computed = {step.out for step in b.steps if isinstance(step, Compute)}
    steps = [step for step in b.steps if isinstance(step, LayOff)]
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
            tail, head = (plain_letter(motion, end) for end in ends)
            yield PlanSegment(motion.kind, f"{tail}-{head}", length, drawn)
