"""Forces and couples by the short grammar of ``[published]``: exact, and as read by hand.

A force is read off its plan with the ruler, unless it was computed and laid off there; arms are
those of the position plan, from the line on which a force acts.
"""

from __future__ import annotations

import math
from functools import cached_property

from msgspec import Struct

from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import Trace
from planmethod.construct.steps import Name, NumberName
from planmethod.plans.forces.board import SCALE, Force, GivenLoad
from planmethod.plans.forces.loads import LoadKind
from planmethod.plans.forces.polygons import Component, Edge, reaction_symbol
from planmethod.plans.legend import ZERO
from planmethod.plans.model import PlanKind
from planmethod.plans.segments import Ends
from planmethod.problem.selector import Selector
from planmethod.solved.forces.contact import VANISHING
from planmethod.solved.forces.statics import Statics, statics_of
from planmethod.solved.reading import Reading
from planmethod.solved.selectors.steps import NoValue, NoValueError, SelectorSteps
from planmethod.solved.solution import Solution

LOADS = {
    "weight": LoadKind.WEIGHT,
    "inertia": LoadKind.INERTIA,
    "inertia couple": LoadKind.INERTIA_COUPLE,
}


class ForceLine(Struct, frozen=True):
    """Force with its line of action: its segment and place, and its moment about the place.

    ``sense`` is -1 where the plan has the force that acts back.
    """

    force: Force
    couple: NumberName | None = None
    sense: float = 1.0


class ForceValues:
    """Values of the selectors of forces in one position of a solution.

    Parameters
    ----------
    solution : Solution
    position : int
        From 0.
    mu_f : float or None, N/mm
        Scale of the source's force plans; the program's own if the source gives none.
    """

    def __init__(self, solution: Solution, position: int, mu_f: float | None = None) -> None:
        if solution.problem.dynamics is None:
            raise NoValueError(NoValue.NO_FORCES)
        self.solution, self.position = solution, position
        self.statics: Statics = statics_of(solution)
        self.mu_f = self.statics.scale.per_mm if mu_f is None else mu_f

    @cached_property
    def _exact(self) -> Reading:
        return _both(self.solution.si, self.statics.si)

    @cached_property
    def _drawn(self) -> Reading:
        """Plans read by hand, with the forces at the source's scale."""
        drawn = self.statics.ruler_reading
        if self.mu_f != self.statics.scale.per_mm:
            scales = {**self.statics.per_mm, SCALE: self.mu_f}
            drawn = self.statics.read(
                self.solution.ruler_arithmetic, scales
            )  # all plans at that one
        return _both(self.solution.ruler_reading, drawn)

    def value(self, selector: Selector, *, by_ruler: bool) -> float:
        """Return a value: N and N·m; degrees from 0 to 360; millimetres of the position plan.

        Sizes, but for the balancing moment or force, which has its sign.
        """
        kind, names = selector.kind, selector.names
        first, _, rest = kind.partition(" ")
        if first == "angle":
            return self._angle(self._line(rest, names))
        selecting = SelectorSteps(self.solution, self.statics.board.draft.copy())
        asked = self.select(selecting, selector)
        reading, hand = (
            (self._drawn, self.solution.ruler_arithmetic) if by_ruler else (self._exact, Float64())
        )
        found = reading.extend(selecting.steps, selecting.draft.numbers, hand)
        value = float(found.number(asked)[self.position])
        if first in ("arm", "shift") and not by_ruler:
            value /= self.solution.scales[PlanKind.POSITION].per_mm
        return value if first in ("balance", "lever") and not names else abs(value)

    def select(self, selecting: SelectorSteps, selector: Selector) -> NumberName:
        """Return the number that answers a selector, other than that of an angle.

        Parameters
        ----------
        selecting : SelectorSteps
            On a draft that has the force plans; gets the further steps.

        Raises
        ------
        NoValueError
        """
        kind, names = selector.kind, selector.names
        first, _, rest = kind.partition(" ")
        match first:
            case "arm":
                return self._arm(selecting, self._line(rest, names[:-1]), names[-1])
            case "F":
                return self._size(self._joint(*names).force)
            case "Ft" | "Fn":
                return self._component(selecting, kind, names)
            case "M":
                return self._couple(self._joint(*names).couple)
            case "balance" | "lever":
                return self._balance(selecting, kind, names)
            case "shift":
                return self._shift(selecting, names[0])
        return self._load(self._find_load(kind, names[0]))

    def sense(self, selector: Selector) -> float:
        """Return -1 where the plan has the reaction that acts back, else 1."""
        return self._joint(*selector.names).sense

    def directed(self, selector: Selector) -> Ends:
        """Return the ends of the segment whose direction an ``angle`` selects.

        Raises
        ------
        NoValueError
            The force is zero.
        """
        line = self._line(selector.kind.partition(" ")[2], selector.names)
        self._directed(line)
        return line.force.ends if line.sense > 0 else line.force.ends[::-1]

    def rotation_per_mm(self, selector: Selector) -> float:
        """Return how far a force turns when its end on the plan moves by one mm, degrees."""
        line = self._line(selector.kind.partition(" ")[2], selector.names)
        return math.degrees(self.mu_f / abs(self._directed(line)))

    # Sizes -----------------------------------------------------------------------------------

    def _at(self, name: Name) -> complex:
        return complex(self._exact.point(name)[self.position])

    def _vector(self, force: Force | Edge) -> complex:
        """Return a force, N."""
        return self._at(force.head) - self._at(force.tail)

    def _is_negligible(self, size: float) -> bool:
        """Return whether a force is rounding beside the largest of the position."""
        return abs(size) <= VANISHING * self.statics.largest(self.position)

    @property
    def _zero(self) -> NumberName:
        return NumberName(ZERO)

    def _size(self, force: Force) -> NumberName:
        if self._is_negligible(abs(self._vector(force))):
            return self._zero
        return self.statics.board.segments.known(force.ends)

    def _couple(self, couple: NumberName | None) -> NumberName:
        if couple is None or self._is_negligible(self._at(couple).real):
            return self._zero
        return couple

    def _load(self, load: GivenLoad | None) -> NumberName:
        """Return the size of a load; None is zero by nature."""
        if load is None:
            return self._zero
        if load.force is not None:
            return self.statics.board.segments.known(load.force.ends)
        assert load.couple is not None
        return load.couple

    def _component(self, selecting: SelectorSteps, kind: str, names: tuple[str, ...]) -> NumberName:
        """Return the part of a reaction across a line, or along it."""
        on, by, *line = names
        tail, head = (selecting.point(PlanKind.POSITION, name) for name in line)
        along = (self._at(head) - self._at(tail)) * (1j if kind == "Ft" else 1.0)
        along /= abs(along)
        force, share = (
            self._joint(on, by).force,
            Component.TANGENTIAL if kind == "Ft" else Component.NORMAL,
        )
        if self._is_negligible((self._vector(force) * along.conjugate()).real):
            return self._zero
        one, two = (self.statics.board.called(link) for link in (on, by))
        symbols = {reaction_symbol(one, two, share), reaction_symbol(two, one, share)}
        for edge in (edge for plan in self.statics.board.plans for edge in plan.polygon):
            vector = self._vector(edge)
            if edge.symbol in symbols and abs((vector * along.conjugate()).imag) <= 1e-9 * abs(
                vector
            ):
                return self.statics.board.segments.known(edge.ends)
        ray = selecting.b.join(tail, head)
        if kind == "Ft":
            ray = selecting.b.perpendicular(tail, ray)
        length = selecting.b.measure_along(selecting.free_name, *force.ends, ray)
        return selecting.compute((self.statics.board.scale, 1), (length, 1))

    def _balance(self, selecting: SelectorSteps, kind: str, names: tuple[str, ...]) -> NumberName:
        """Return the balancing moment (force, of a slider), or the force at a point that does."""
        statics, drive = self.statics, self.solution.problem.drive
        value = statics.driving.balance
        if kind == "lever":
            if statics.lever_plan is None:
                raise NoValueError(NoValue.AT_REST)
            value = statics.lever_plan.balance
        if not names:
            return value
        plan = statics.driving if kind == "balance" else statics.lever_plan
        assert plan is not None
        if drive.pivot is None or plan.moment is None:
            raise NoValueError(NoValue.NO_LINK)
        link, arm = selecting.arm(names[0], drive.pivot)
        if link != drive.link:
            raise NoValueError(NoValue.NO_LINK)
        points = self.solution.problem.bodies[link].points
        if points.get(names[0]) == points[drive.pivot]:
            raise NoValueError(NoValue.NO_ARM)
        return selecting.compute((plan.moment, 1), *((name, -power) for name, power in arm))

    def _shift(self, selecting: SelectorSteps, link: str) -> NumberName:
        force = self._find_load("inertia", link)
        if (
            force is None
            or force.force is None
            or self._is_negligible(abs(self._vector(force.force)))
        ):
            raise NoValueError(NoValue.ZERO_DIVISOR)
        powers = ((self._load(self._find_load("inertia couple", link)), 1), (self._load(force), -1))
        return selecting.compute(*powers, (selecting.draft.mu_l, -1))

    # Lines of action -------------------------------------------------------------------------

    def _directed(self, line: ForceLine) -> complex:
        """Return a force that has a direction, N."""
        vector = self._vector(line.force)
        if self._is_negligible(abs(vector)):
            raise NoValueError(NoValue.NO_DIRECTION)
        return vector * line.sense

    def _angle(self, line: ForceLine) -> float:
        vector = self._directed(line)
        return math.degrees(math.atan2(vector.imag, vector.real)) % 360.0

    def _arm(self, selecting: SelectorSteps, line: ForceLine, about: str) -> NumberName:
        """Return the arm of a force; that of a guide acts where its moment requires."""
        self._directed(line)
        pole, force = selecting.point(PlanKind.POSITION, about), line.force
        arm = selecting.b.measure_arm(selecting.free_name, pole, force.at, *force.ends)
        if line.couple is None:
            return arm
        size, mu_l = self.statics.board.segments.known(force.ends), selecting.draft.mu_l
        shift = selecting.compute((line.couple, 1), (size, -1), (mu_l, -1))
        return selecting.b.total(selecting.free_name, arm, shift)

    # Names -----------------------------------------------------------------------------------

    def _joint(self, on: str, by: str) -> ForceLine:
        """Return the reaction of one link on another; two links have one joint."""
        for reaction in self.statics.board.reactions:
            if {reaction.on, reaction.by} == {on, by}:
                sense = 1.0 if reaction.on == on else -1.0
                return ForceLine(reaction.force, reaction.couple, sense)
        raise NoValueError(NoValue.NO_JOINT)

    def _line(self, kind: str, names: tuple[str, ...]) -> ForceLine:
        """Return the line of a force that must act somewhere."""
        if kind == "F":
            return self._joint(*names)
        given = self._find_load(kind, names[0])
        if given is None or given.force is None:
            raise NoValueError(NoValue.NO_DIRECTION)
        return ForceLine(given.force)

    def _find_load(self, kind: str, name: str) -> GivenLoad | None:
        """Return a load: of a link, or by its letter; None if it is zero by nature."""
        for given in self.statics.board.given:
            of = given.applied
            if kind == "load":
                if of.kind is LoadKind.EXTERNAL and of.name == name:
                    return given
            elif of.kind is LOADS[kind] and of.link == name:
                return given
        shift = self.statics.board.shifts.get(name) if kind == "inertia couple" else None
        return None if shift is None else GivenLoad(shift.moment, None, shift.couple)


def _both(motion: Reading, forces: Reading) -> Reading:
    """Return a reading that has the plans of the motion and those of the forces."""
    margins = {**motion.trace.margin, **forces.trace.margin}
    return Reading(Trace({**motion.value, **forces.value}, margins), motion.count)
