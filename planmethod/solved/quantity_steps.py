"""Steps that answer a named quantity: they continue the program of the plans."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from enum import Enum
from functools import cached_property

from msgspec import Struct

from planmethod.construct.evaluate import Trace
from planmethod.construct.steps import LayOffLength, LineName, Name, NumberName, PointName, Step
from planmethod.mechanism.model import FRAME
from planmethod.plans.build import ZERO, Quantity, TransferSteps, plan_of
from planmethod.plans.draft import Draft
from planmethod.plans.forces.board import Force, GivenLoad
from planmethod.plans.forces.polygons import Component, Edge, LoadKind, reaction_symbol
from planmethod.plans.model import MOTION, RATES, Ends, PlanKind, Segments, VectorKind
from planmethod.problem.quantities import (
    CENTRES,
    OF_PLANS,
    POLE,
    SLIDINGS,
    QuantityKey,
    QuantityKind,
)
from planmethod.solved.centre_steps import CentreSteps, NoCentreError
from planmethod.solved.forces.statics import VANISHING, Statics
from planmethod.solved.reading import Reading
from planmethod.solved.solution import Solution

LINES = {
    QuantityKind.REACTION_ANGLE: QuantityKind.REACTION,
    QuantityKind.INERTIA_ANGLE: QuantityKind.INERTIA,
    QuantityKind.LOAD_ANGLE: QuantityKind.LOAD,
    QuantityKind.REACTION_ARM: QuantityKind.REACTION,
    QuantityKind.WEIGHT_ARM: QuantityKind.WEIGHT,
    QuantityKind.INERTIA_ARM: QuantityKind.INERTIA,
    QuantityKind.LOAD_ARM: QuantityKind.LOAD,
}
"""Forces whose angle or arm is named."""

LOADS = {
    QuantityKind.WEIGHT: LoadKind.WEIGHT,
    QuantityKind.INERTIA: LoadKind.INERTIA,
    QuantityKind.INERTIA_COUPLE: LoadKind.INERTIA_COUPLE,
}

VECTORS = {
    (PlanKind.VELOCITY, VectorKind.RELATIVE): QuantityKind.VELOCITY,
    (PlanKind.ACCELERATION, VectorKind.NORMAL): QuantityKind.NORMAL,
    (PlanKind.ACCELERATION, VectorKind.TANGENTIAL): QuantityKind.TANGENTIAL,
}
"""Vectors of the plans between two points of a link."""


class NoValue(Enum):
    """Reason why a quantity has no value."""

    NO_QUANTITY = "no what"  # the file does not specify the quantity
    NO_POSITION = "no position"  # the driver is never there
    NO_SCALE = "no scale"  # millimetres of a plan whose scale the source does not give
    NO_POINT = "no point"  # a name that the plans do not have
    NO_LINK = "no link"  # turning of a point about one that no link joins it to
    NO_ARM = "no arm"  # a force in the axis of the crank cannot balance it
    NO_CRANK = "no crank"  # transfer functions are by the angle of a crank that turns
    NO_SLIDING = "no sliding"  # the points are not a prismatic pair's
    NO_CENTRE = "no centre"  # it is at infinity, or no lines of the drawing give it
    ZERO_DIVISOR = "zero divisor"
    NO_FORCES = "no forces"  # the file has neither masses nor loads
    NO_JOINT = "no joint"  # the links do not touch each other
    NO_DIRECTION = "no direction"  # a zero force has no angle and no arm
    NO_MACHINE = "no machine"  # the file has no [machine]
    NO_SYNTHESIS = "no synthesis"  # no [synthesis] with the angle of the extreme positions
    NO_RATE = "no rate"  # scales of velocities need a driver that moves
    AT_REST = "stands"  # the lever of a driving link that does not move


class NoValueError(Exception):
    """A value is requested that the solution does not have."""

    def __init__(self, reason: NoValue) -> None:
        super().__init__(reason.value)
        self.reason = reason


class ForceLine(Struct, frozen=True):
    """Force with its line of action: its segment and place, and its moment about the place.

    ``sense`` is -1 where the plan has the force that acts back.
    """

    force: Force
    couple: NumberName | None = None
    sense: float = 1.0


class QuantitySteps:
    """Steps that a quantity needs beyond those of the program (что спрашивается).

    Parameters
    ----------
    solution : Solution
    position : int
        From 0.
    statics : Statics, optional
        Whose plans are continued, so that quantities of the forces have steps as well.
    draft : Draft, optional
        Draft that is continued; default: that of the plans.
    """

    def __init__(
        self,
        solution: Solution,
        position: int = 0,
        statics: Statics | None = None,
        draft: Draft | None = None,
    ) -> None:
        self.solution, self.position, self._statics = solution, position, statics
        self.kinematics = solution.construction.kinematics
        own = solution.construction.draft if statics is None else statics.board.draft
        self.draft = (draft or own).copy()
        self.b = self.draft.b
        self._done = len(self.b.steps)
        self._segments = {
            motion.kind: motion.segments.on(self.b)
            for motion in (self.kinematics.velocity, self.kinematics.acceleration)
        }

    def for_variant(self, solution: Solution, statics: Statics | None) -> QuantitySteps:
        """Return the same steps of another solution, which is drawn by the same steps."""
        other = copy.copy(self)
        other.solution, other._statics = solution, statics
        other.__dict__.pop("exact", None)
        other.__dict__.pop("centres", None)
        return other

    @property
    def statics(self) -> Statics:
        """The force plans.

        Raises
        ------
        NoValueError
            There are none.
        """
        if self._statics is None:
            raise NoValueError(NoValue.NO_FORCES)
        return self._statics

    @property
    def steps(self) -> list[Step]:
        """The further steps."""
        return self.b.steps[self._done :]

    def segments(self, plan: PlanKind) -> Segments:
        """Return the segments of a plan with a pole, or of the force plans."""
        return self.statics.board.segments if plan is PlanKind.FORCE else self._segments[plan]

    @property
    def free_name(self) -> str:
        """A name that no step has."""
        return f"asked{len(self.b.steps)}"

    def compute(self, *powers: tuple[NumberName, int]) -> NumberName:
        """Return a further product of powers."""
        return self.b.compute(self.free_name, *powers)

    def number(self, key: QuantityKey) -> NumberName:
        """Return the number of a quantity that is measured on the drawing: its dividend.

        Raises
        ------
        NoValueError
            When the solution has no such quantity.
        """
        kind, names, plan = key.kind, key.names, plan_of(key.kind)
        if (ends := self.vector(key)) is not None:  # as on the plan, not computed again
            return self._segments[plan].values[ends]
        match kind:
            case _ if key.is_analogue:
                raise NoValueError(NoValue.NO_QUANTITY)  # no plan has them
            case _ if kind in CENTRES:
                return self._of_centre(key)
            case QuantityKind.PLACE | QuantityKind.VELOCITY | QuantityKind.ACCELERATION if key.axis:
                return self._component(plan, names[0], key.axis)
            case QuantityKind.VELOCITY | QuantityKind.ACCELERATION:
                about = names[1] if len(names) > 1 else POLE
                return self._value(plan, about, names[0])
            case QuantityKind.NORMAL | QuantityKind.TANGENTIAL:
                return self._part(kind, names)
            case _ if kind in SLIDINGS:
                return self._relative(kind, *names)
            case _ if kind in OF_PLANS:
                return self._of_link(kind, names[0])
            case (
                QuantityKind.LENGTH
                | QuantityKind.VELOCITY_SEGMENT
                | QuantityKind.ACCELERATION_SEGMENT
            ):
                return self._length(plan, *names)
            case (
                QuantityKind.TRANSFER
                | QuantityKind.TRANSFER_2
                | QuantityKind.RATIO
                | QuantityKind.RATIO_2
            ):
                return self._transfer(key)
            case QuantityKind.REACTION if key.axis:
                return self._along_axis(self._joint(*names), key.axis)
            case QuantityKind.REACTION:
                return self._size(self._joint(*names).force)
            case QuantityKind.MOMENT:
                return self._couple(self._joint(*names).couple)
            case QuantityKind.TANGENTIAL_REACTION | QuantityKind.NORMAL_REACTION:
                return self._reaction_component(kind, names)
            case QuantityKind.BALANCE | QuantityKind.LEVER:
                return self._balance(kind, names)
            case QuantityKind.SHIFT:
                return self._shift(names[0])
            case (
                QuantityKind.WEIGHT
                | QuantityKind.INERTIA
                | QuantityKind.INERTIA_COUPLE
                | QuantityKind.LOAD
            ):
                return self._load(self._find_load(kind, names[0]))
            case QuantityKind.DIRECTION:
                return self.b.measure_angle(self.free_name, self.line(key))
            case QuantityKind.REACTION_ANGLE | QuantityKind.INERTIA_ANGLE | QuantityKind.LOAD_ANGLE:
                line = self.b.join(*self.directed(key))
                return self.b.measure_angle(self.free_name, line)
            case _ if kind.about:
                return self._arm(self._line(LINES[kind], names[:-1]), names[-1])
            case _:
                raise NoValueError(NoValue.NO_QUANTITY)

    def _of_centre(self, key: QuantityKey) -> NumberName:
        """Return a number of an instant centre, or by it."""
        try:
            if key.axis:
                pole = self.point(PlanKind.POSITION, POLE)
                read = self._projection(key.axis, pole, self.centres.point(*key.names))
                return self.compute((self.draft.mu_l, 1), (read, 1))
            return self.centres.number(key)
        except NoCentreError:
            raise NoValueError(NoValue.NO_CENTRE) from None

    @cached_property
    def centres(self) -> CentreSteps:
        """Steps of the instant centres."""
        return CentreSteps(self)

    def relative_motion(self, key: QuantityKey) -> Quantity:
        """Return a quantity of two points, or a component by the coordinate of the driver.

        The relative velocity and acceleration of two points are vectors; aⁿ and a^τ of two points
        of a link are numbers, a^τ with the sign of ε.

        Raises
        ------
        NoValueError
            When the solution has no such quantity.
        """
        kind, names = key.kind, key.names
        of = "_".join(names)
        if key.is_analogue:
            number = self._by_driver(key)
            return Quantity(kind, number, of, number, named=key)
        if kind in (QuantityKind.NORMAL, QuantityKind.TANGENTIAL):
            number = self._part(kind, names)
            return Quantity(
                kind, number, of, number, shown=self.solution.problem.key_symbol(key), named=key
            )
        if len(names) != 2 or kind not in (QuantityKind.VELOCITY, QuantityKind.ACCELERATION):
            raise NoValueError(NoValue.NO_QUANTITY)
        plan = plan_of(kind)
        head, tail = (self.point(plan, name) for name in names)
        made = self.b.carry(self.free_name, self.point(plan, POLE), tail, head)
        return Quantity(kind, made, of, shown=self.solution.problem.key_symbol(key), named=key)

    def _part(self, kind: QuantityKind, names: tuple[str, ...]) -> NumberName:
        """Return aⁿ = ω²·l or a^τ = ε·l of two points of a link, m/s²."""
        link, arm = self.arm(*names)
        power = 2 if kind is QuantityKind.NORMAL else 1
        rates = self.kinematics.rates(MOTION[3 - power])
        return self.compute((rates[link], power), *arm) if link in rates else self.zero

    def _by_driver(self, key: QuantityKey) -> NumberName:
        """Return dx/dφ = v/ω or d²x/dφ² = (a - v·ε/ω)/ω² of a point or a link."""
        drive = self.solution.problem.drive
        rate = self.kinematics.omega.get(drive.link) if drive.revolves else None
        if rate is None or drive.rate == 0.0:
            raise NoValueError(NoValue.NO_CRANK)
        (name,) = key.names
        if key.axis:
            first, second = (self._component(plan, name, key.axis) for plan in RATES)
        elif name not in self.solution.links:
            raise NoValueError(NoValue.NO_LINK)
        else:
            first, second = (self.kinematics.rates(plan).get(name, self.zero) for plan in RATES)
        if key.kind.order == 1:
            return self.compute((first, 1), (rate, -1))
        whole = self.compute((second, 1), (rate, -2))
        change = self.kinematics.epsilon.get(drive.link)
        if change is None or drive.acceleration == 0.0:
            return whole
        part = self.b.compute(self.free_name, (first, 1), (change, 1), (rate, -3), factor=-1.0)
        return self.b.total(self.free_name, whole, part)

    def _of_link(self, kind: QuantityKind, link: str) -> NumberName:
        if link not in self.solution.links:
            raise NoValueError(NoValue.NO_LINK)
        for one in self.solution.construction.legend:
            if one.kind is kind and one.of == link and one.size is not None:
                return one.size
        raise NoValueError(NoValue.NO_QUANTITY)

    def vectors(self) -> Iterator[tuple[QuantityKey, Ends]]:
        """Yield the vectors of the plans between two points of a link: v_ED, aⁿ_ED, a^τ_ED."""
        for plan in self.solution.construction.plans:
            for vector in plan.vectors:
                kind = VECTORS.get((plan.kind, vector.kind))
                if kind is not None and vector.points:
                    yield QuantityKey(kind, vector.points), (vector.tail, vector.head)

    def vector(self, key: QuantityKey) -> Ends | None:
        """Return the ends of the vector that the plans have of two points; None of others."""
        if key.kind not in VECTORS.values() or len(key.names) != 2:
            return None
        values = self._segments[plan_of(key.kind)].values
        return next((e for known, e in self.vectors() if known == key and e in values), None)

    def ends(self, key: QuantityKey, number: NumberName) -> Ends | None:
        """Return the segment of a plan that a number of a quantity is the value of."""
        if (vector := self.vector(key)) is not None:
            return vector
        values = self.segments(plan_of(key.kind)).values
        return next((ends for ends, value in values.items() if value == number), None)

    @cached_property
    def _transfers(self) -> TransferSteps:
        drive = self.solution.problem.drive
        if not drive.revolves or drive.rate == 0.0:
            raise NoValueError(NoValue.NO_CRANK)
        return TransferSteps(self.kinematics, self.draft, by_values=True)

    def _transfer(self, key: QuantityKey) -> NumberName:
        """Return a transfer function; u of other links than the crank is ω over ω."""
        steps, plan, names = self._transfers, plan_of(key.kind), key.names
        if key.kind in (QuantityKind.TRANSFER, QuantityKind.TRANSFER_2):
            if names[0] not in self.kinematics.velocity.named:
                raise NoValueError(NoValue.NO_POINT)
            return steps.of_point(names[0], plan)
        if not set(names) <= set(self.solution.links):
            raise NoValueError(NoValue.NO_LINK)
        first, *others = names
        found = steps.of_link(first, plan)
        if others in ([], [self.solution.problem.drive.link]):
            return found
        if others[0] not in self.kinematics.omega:
            raise NoValueError(NoValue.ZERO_DIVISOR)
        return self.compute((found, 1), (steps.of_link(others[0], plan), -1))

    @property
    def zero(self) -> NumberName:
        """The number zero."""
        return self.draft.known(ZERO, 0.0)

    def _component(self, plan: PlanKind, name: str, axis: str) -> NumberName:
        length = self._projection(axis, self.point(plan, POLE), self.point(plan, name))
        scale = self.draft.mu_l if plan is PlanKind.POSITION else self._segments[plan].scale
        return self.compute((scale, 1), (length, 1))

    def _projection(self, axis: str, tail: PointName, head: PointName) -> NumberName:
        """Measure a segment along an axis, mm."""
        angle = self.draft.known(f"angle_{axis}", 0.0 if axis == "x" else 90.0)
        line = self.b.at_angle(tail, None, angle)
        return self.b.measure_along(self.free_name, tail, head, line)

    def _value(self, plan: PlanKind, tail: str, head: str) -> NumberName:
        one, two = self.point(plan, tail), self.point(plan, head)
        if one == two:
            return self.zero
        return self._segments[plan].value(one, two, self.free_name)

    def _length(self, plan: PlanKind, tail: str, head: str) -> NumberName:
        one, two = self.point(plan, tail), self.point(plan, head)
        if one == two:
            return self.zero
        if plan is not PlanKind.POSITION:
            return self._segments[plan].length(one, two)
        return self.drawn(one, two)

    def drawn(self, one: PointName, two: PointName) -> NumberName:
        """Return a distance on the position plan as it was laid off, or is read; mm."""
        for step in self.b.steps:
            if isinstance(step, LayOffLength) and (step.origin, step.out) == (one, two):
                return step.length
        return self.draft.measured(one, two)

    def arm(self, point: str, about: str) -> tuple[str, tuple[tuple[NumberName, int], ...]]:
        """Return the link that joins two points, and the factors of their distance, m.

        As on paper: a given length is taken as given, another one is read off the drawing.
        """
        heads, tails = self._places(point), self._places(about)
        link = next((k for k in heads if k in tails and k != FRAME), None)
        if link is None:
            raise NoValueError(NoValue.NO_LINK)
        head, tail = heads[link], tails[link]
        if {head, tail} <= set(self.solution.problem.bodies[link].points):
            return link, ((self.draft.length(link, head, tail), 1),)
        drawn = self.drawn(PointName(tail), PointName(head))
        return link, ((drawn, 1), (self.draft.mu_l, 1))

    def point(self, plan: PlanKind, name: str) -> PointName:
        """Return the plan point of a point's name; the pole of the position plan is the origin."""
        motion = self.kinematics.motion(plan)
        if name == POLE:
            return motion.pole  # the velocity plan's lies at 0 on the paper, as the origin does
        if name not in self.kinematics.velocity.named:
            raise NoValueError(NoValue.NO_POINT)
        link, place = self.kinematics.velocity.named[name]
        return PointName(place) if plan is PlanKind.POSITION else motion.point[link, place]

    def _places(self, name: str) -> dict[str, str]:
        """Return where a name is on each link that has it: link to place of the drawing."""
        motion = self.kinematics.velocity
        return {link: place for link, place in motion.point if motion.label(link, place) == name}

    def _relative(self, kind: QuantityKind, one: str, two: str) -> NumberName:
        """Return a number of the sliding of two coincident points."""
        for name, pair in self.pairs():
            if {one, two} == {*pair}:
                size = self.solution.legend[kind.label(name)].size
                assert size is not None
                return size
        raise NoValueError(NoValue.NO_SLIDING)

    def pairs(self) -> Iterator[tuple[str, tuple[str, str]]]:
        """Yield the sliding pairs by name, ``B3/2``, and their coincident points, ``B3``, ``B``."""
        label = self.kinematics.velocity.label
        for relative in self.kinematics.relatives.values():
            place = relative.point
            yield relative.name, (label(relative.of, place), label(relative.to, place))

    def line(self, key: QuantityKey) -> LineName:
        """Return the line of the position plan whose angle is named.

        Raises
        ------
        NoValueError
            There is no such link.
        """
        axis = self.draft.axes.get(key.names[0])
        if axis is None:
            raise NoValueError(NoValue.NO_LINK)
        return axis

    # Forces ----------------------------------------------------------------------------------

    def sense(self, key: QuantityKey) -> float:
        """Return -1 where the plan has the reaction that acts back, else 1."""
        return self._joint(*key.names).sense

    def directed(self, key: QuantityKey) -> Ends:
        """Return the ends of the segment whose direction an angle of a force is.

        Raises
        ------
        NoValueError
            The force is zero.
        """
        line = self._line(LINES[key.kind], key.names)
        self._directed(line)
        return line.force.ends if line.sense > 0 else line.force.ends[::-1]

    def force(self, key: QuantityKey) -> complex:
        """Return the force whose direction an angle is, N.

        Raises
        ------
        NoValueError
            It is zero.
        """
        return self._directed(self._line(LINES[key.kind], key.names))

    # Sizes -----------------------------------------------------------------------------------

    @cached_property
    def exact(self) -> Reading:
        """Exact reading of the plans that are continued."""
        motion = self.solution.si
        return motion if self._statics is None else combined(motion, self._statics.si)

    def _at(self, name: Name) -> complex:
        return complex(self.exact.point(name)[self.position])

    def _vector(self, force: Force | Edge) -> complex:
        """Return a force, N."""
        return self._at(force.head) - self._at(force.tail)

    def _is_negligible(self, size: float) -> bool:
        """Return whether a force is rounding beside the largest of the position."""
        return abs(size) <= VANISHING * self.statics.largest(self.position)

    def _size(self, force: Force) -> NumberName:
        if self._is_negligible(abs(self._vector(force))):
            return self.zero
        return self.statics.board.segments.known(force.ends)

    def _along_axis(self, line: ForceLine, axis: str) -> NumberName:
        tail, head = line.force.ends if line.sense > 0 else line.force.ends[::-1]
        length = self._projection(axis, tail, head)
        return self.compute((self.statics.board.scale, 1), (length, 1))

    def _couple(self, couple: NumberName | None) -> NumberName:
        if couple is None or self._is_negligible(self._at(couple).real):
            return self.zero
        return couple

    def _load(self, load: GivenLoad | None) -> NumberName:
        """Return the size of a load; None is zero by nature."""
        if load is None:
            return self.zero
        if load.force is not None:
            return self.statics.board.segments.known(load.force.ends)
        assert load.couple is not None
        return load.couple

    def _reaction_component(self, kind: QuantityKind, names: tuple[str, ...]) -> NumberName:
        """Return the part of a reaction across a line, or along it."""
        on, by, *line = names
        across = kind is QuantityKind.TANGENTIAL_REACTION
        tail, head = (self.point(PlanKind.POSITION, name) for name in line)
        along = (self._at(head) - self._at(tail)) * (1j if across else 1.0)
        along /= abs(along)
        force = self._joint(on, by).force
        share = Component.TANGENTIAL if across else Component.NORMAL
        if self._is_negligible((self._vector(force) * along.conjugate()).real):
            return self.zero
        one, two = (self.statics.board.called(link) for link in (on, by))
        symbols = {reaction_symbol(one, two, share), reaction_symbol(two, one, share)}
        for edge in (edge for plan in self.statics.board.plans for edge in plan.polygon):
            vector = self._vector(edge)
            if edge.symbol in symbols and abs((vector * along.conjugate()).imag) <= 1e-9 * abs(
                vector
            ):
                return self.statics.board.segments.known(edge.ends)
        ray = self.b.join(tail, head)
        if across:
            ray = self.b.perpendicular(tail, ray)
        length = self.b.measure_along(self.free_name, *force.ends, ray)
        return self.compute((self.statics.board.scale, 1), (length, 1))

    def _balance(self, kind: QuantityKind, names: tuple[str, ...]) -> NumberName:
        """Return the balancing moment (force, of a slider), or the force at a point that does."""
        statics, drive = self.statics, self.solution.problem.drive
        value = statics.driving.balance
        if kind is QuantityKind.LEVER:
            if statics.lever_plan is None:
                raise NoValueError(NoValue.AT_REST)
            value = statics.lever_plan.balance
        if not names:
            return value
        plan = statics.driving if kind is QuantityKind.BALANCE else statics.lever_plan
        assert plan is not None
        if drive.pivot is None or plan.moment is None:
            raise NoValueError(NoValue.NO_LINK)
        link, arm = self.arm(names[0], drive.pivot)
        if link != drive.link:
            raise NoValueError(NoValue.NO_LINK)
        points = self.solution.problem.bodies[link].points
        if points.get(names[0]) == points[drive.pivot]:
            raise NoValueError(NoValue.NO_ARM)
        return self.compute((plan.moment, 1), *((name, -power) for name, power in arm))

    def _shift(self, link: str) -> NumberName:
        force = self._find_load(QuantityKind.INERTIA, link)
        if (
            force is None
            or force.force is None
            or self._is_negligible(abs(self._vector(force.force)))
        ):
            raise NoValueError(NoValue.ZERO_DIVISOR)
        couple = self._load(self._find_load(QuantityKind.INERTIA_COUPLE, link))
        return self.compute((couple, 1), (self._load(force), -1), (self.draft.mu_l, -1))

    # Lines of action -------------------------------------------------------------------------

    def _directed(self, line: ForceLine) -> complex:
        """Return a force that has a direction, N."""
        vector = self._vector(line.force)
        if self._is_negligible(abs(vector)):
            raise NoValueError(NoValue.NO_DIRECTION)
        return vector * line.sense

    def _arm(self, line: ForceLine, about: str) -> NumberName:
        """Return the arm of a force; that of a guide acts where its moment requires."""
        self._directed(line)
        pole, force = self.point(PlanKind.POSITION, about), line.force
        arm = self.b.measure_arm(self.free_name, pole, force.at, *force.ends)
        if line.couple is None:
            return arm
        size, mu_l = self.statics.board.segments.known(force.ends), self.draft.mu_l
        shift = self.compute((line.couple, 1), (size, -1), (mu_l, -1))
        return self.b.total(self.free_name, arm, shift)

    # Names -----------------------------------------------------------------------------------

    def _joint(self, on: str, by: str) -> ForceLine:
        """Return the reaction of one link on another; two links have one joint."""
        for reaction in self.statics.board.reactions:
            if {reaction.on, reaction.by} == {on, by}:
                sense = 1.0 if reaction.on == on else -1.0
                return ForceLine(reaction.force, reaction.couple, sense)
        raise NoValueError(NoValue.NO_JOINT)

    def _line(self, kind: QuantityKind, names: tuple[str, ...]) -> ForceLine:
        """Return the line of a force that must act somewhere."""
        if kind is QuantityKind.REACTION:
            return self._joint(*names)
        given = self._find_load(kind, names[0])
        if given is None or given.force is None:
            raise NoValueError(NoValue.NO_DIRECTION)
        return ForceLine(given.force)

    def _find_load(self, kind: QuantityKind, name: str) -> GivenLoad | None:
        """Return a load: of a link, or by its letter; None if it is zero by nature."""
        for given in self.statics.board.given:
            of = given.applied
            if kind is QuantityKind.LOAD:
                if of.kind is LoadKind.EXTERNAL and of.name == name:
                    return given
            elif of.kind is LOADS[kind] and of.link == name:
                return given
        shift = self.statics.board.shifts.get(name) if kind is QuantityKind.INERTIA_COUPLE else None
        return None if shift is None else GivenLoad(shift.moment, None, shift.couple, shift.letters)


def combined(motion: Reading, forces: Reading) -> Reading:
    """Return a reading that has the plans of the motion and those of the forces."""
    margins = {**motion.trace.margin, **forces.trace.margin}
    return Reading(Trace({**motion.value, **forces.value}, margins), motion.count)
