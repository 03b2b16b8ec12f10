"""Quantities of a solved problem by the short grammar of ``[published]``: exact, and by hand."""

from __future__ import annotations

import math
from functools import cached_property

from msgspec import Struct

from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import Trace
from planmethod.construct.steps import Name, NumberName, PointName
from planmethod.plans.build import PLAN_OF, ZERO
from planmethod.plans.forces.board import SCALE, Force, GivenLoad
from planmethod.plans.forces.polygons import Component, Edge, LoadKind, reaction_symbol
from planmethod.plans.model import Ends, PlanKind
from planmethod.problem.answers import ANALOGUES, FORCES, Selector
from planmethod.solved.forces.statics import VANISHING, Statics, statics_of
from planmethod.solved.quantities import analogues
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
        return None if shift is None else GivenLoad(shift.moment, None, shift.couple, shift.letters)


def _both(motion: Reading, forces: Reading) -> Reading:
    """Return a reading that has the plans of the motion and those of the forces."""
    margins = {**motion.trace.margin, **forces.trace.margin}
    return Reading(Trace({**motion.value, **forces.value}, margins), motion.count)


def is_angle(selector: Selector) -> bool:
    """Return whether a quantity is measured with a protractor."""
    return selector.kind == "phi" or selector.kind.startswith("angle ")


class SelectorValues:
    """Values of selectors in one position of a solution.

    Parameters
    ----------
    solution : Solution
    position : int
        From 0.
    mu_f : float or None, N/mm
        Scale of the source's force plans; the program's own if the source gives none.
    """

    def __init__(self, solution: Solution, position: int = 0, mu_f: float | None = None) -> None:
        self.solution, self.position, self.mu_f = solution, position, mu_f
        self.kinematics = solution.construction.kinematics

    @cached_property
    def forces(self) -> ForceValues:
        """Quantities of the force analysis.

        Raises
        ------
        NoValueError
            When the file has neither masses nor loads.
        """
        return ForceValues(self.solution, self.position, self.mu_f)

    def exact(self, selector: Selector) -> float:
        """Return the exact value in SI units (degrees, millimetres of a plan).

        Raises
        ------
        NoValueError
            When the solution has no such quantity.
        """
        return self._quotient(selector, by_ruler=False)

    def read(self, selector: Selector) -> float | None:
        """Return the value that follows from the segments read with the ruler.

        None for an angle, which is taken with a protractor and not with the ruler, and for
        analogues, which no plan has.
        """
        for part in filter(None, (selector, selector.over)):
            if is_angle(part) or part.kind in ANALOGUES:
                return None
        return self._quotient(selector, by_ruler=True)

    def _quotient(self, selector: Selector, *, by_ruler: bool) -> float:
        value = self._value(selector, by_ruler=by_ruler)
        if selector.over is None:
            return value
        divisor = self._value(selector.over, by_ruler=by_ruler)
        if divisor == 0:
            raise NoValueError(NoValue.ZERO_DIVISOR)
        return value / divisor

    def _value(self, selector: Selector, *, by_ruler: bool) -> float:
        if selector.kind in FORCES:
            return self.forces.value(selector, by_ruler=by_ruler)
        solution = self.solution
        if selector.kind == "phi":
            if selector.names[0] not in solution.links:
                raise NoValueError(NoValue.NO_LINK)
            return float(solution.links[selector.names[0]].phi_deg[self.position])
        if selector.kind in ANALOGUES:
            return self._analogue(selector.kind[:-1], selector.kind[-1] == "2", *selector.names)
        selecting = SelectorSteps(solution, solution.construction.draft.copy())
        answer = selecting.select(selector)
        reading, hand = solution.si, Float64()
        if by_ruler:
            reading, hand = solution.ruler_reading, solution.ruler_arithmetic
        found = reading.extend(selecting.steps, selecting.draft.numbers, hand)
        value = float(found.number(answer.name)[self.position])
        if answer.plan is not None and not by_ruler:
            value /= solution.plan_scale(answer.plan, self.position).per_mm
        return value if answer.signed else abs(value)

    def _analogue(self, quantity: str, second: bool, name: str) -> float:
        points, links = analogues(self.solution)
        if quantity == "phi":
            if name not in links:
                raise NoValueError(NoValue.NO_LINK)
            return float(links[name][second][self.position])
        if name not in points:
            raise NoValueError(NoValue.NO_POINT)
        rate = points[name].acceleration if second else points[name].velocity
        return float((rate.real if quantity == "x" else rate.imag)[self.position])

    def lever(self, selector: Selector) -> tuple[PlanKind, float] | None:
        """Return the plan on which an angle or a rate is read, and the value of a metre of it.

        An omega or epsilon is a segment over the arm on which it was read; an angle shows best
        at the far end of its link. None for other quantities, and for a rate that is not read off.
        """
        if selector.over is not None or selector.kind in FORCES:
            return None
        kind, name = selector.kind, selector.names[0]
        if kind == "phi":
            reach = self._reach(name)
            return (PlanKind.POSITION, math.degrees(1.0 / reach)) if reach else None
        rates = {"omega": self.kinematics.omega, "epsilon": self.kinematics.epsilon}.get(kind, {})
        for (of, link), turning in self.kinematics.turnings.items():
            # Links of a prismatic pair rotate together: the rate was read on one of them.
            if of is PLAN_OF.get(kind) and name in rates and rates[link] == rates[name]:
                return of, 1.0 / abs(self._place(turning.place) - self._place(turning.joint))
        return None

    def _place(self, point: str) -> complex:
        at = self.solution.si.point(PointName(point))
        return complex(at[self.position])

    def _reach(self, link: str) -> float:
        """Return the greatest distance between the places of a link, m."""
        places = [self._place(place) for place in self.kinematics.velocity.moving.get(link, ())]
        return max((abs(p - q) for p in places for q in places), default=0.0)
