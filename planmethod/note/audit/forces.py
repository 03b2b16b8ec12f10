"""Forces and couples by the short grammar of ``[published]``: exact, and as the hand reads them.

A force is read off its plan with the ruler, unless it was computed and laid off there; arms are
those of the position plan, from the line on which a force acts.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import Trace
from planmethod.construct.steps import LayOff, NumberName, PointName
from planmethod.note.audit.quantities import MotionQuantities, Reading, UnansweredError, Why
from planmethod.plans.forces.board import SCALE, Force, Given
from planmethod.plans.forces.loads import LoadKind
from planmethod.plans.model import PlanKind
from planmethod.problem.selector import Selector
from planmethod.solved.forces.contact import NOTHING
from planmethod.solved.forces.statics import Statics

LOADS = {
    "weight": LoadKind.WEIGHT,
    "inertia": LoadKind.INERTIA,
    "inertia couple": LoadKind.INERTIA_COUPLE,
}


@dataclass(frozen=True, slots=True)
class Sheet:
    """Force plans in one position as a trace has them, and how a length on them becomes newtons.

    Attributes
    ----------
    motion : Reading
        The plans of the motion, drawn by the same hand.
    trace : Trace
        The force plans.
    per_mm : float
        N per unit of the trace.
    """

    motion: Reading
    trace: Trace
    per_mm: float

    def vector(self, tail: PointName, head: PointName) -> complex:
        """Return a segment of a force plan, in units of the trace."""
        solution, index = self.motion.solution, self.motion.index
        ends = solution.complexes(self.trace, head) - solution.complexes(self.trace, tail)
        return complex(ends[index])

    def number(self, name: NumberName | None) -> float:
        """Return a couple, N·m; one that is zero by nature has no name."""
        if name is None:
            return 0.0
        return float(self.motion.solution.reals(self.trace, name)[self.motion.index])

    def place(self, name: PointName) -> complex:
        """Return where a force acts on the position plan, in units of the motion's trace."""
        if name in self.motion.trace.value:
            return self.motion.point(name)
        return complex(self.motion.solution.complexes(self.trace, name)[self.motion.index])

    def newtons(self, length: float, *, laid_off: bool = False) -> float:
        """Return the force that a length stands for; nobody reads again what was laid off."""
        return (length if laid_off else float(self.motion.ruled(length))) * self.per_mm


@dataclass(frozen=True, slots=True)
class Line:
    """Force with its line of action: its segment and place, and its moment about the place.

    ``sense`` is -1 where the plan has the force that acts back.
    """

    force: Force
    couple: NumberName | None = None
    sense: float = 1.0


class ForceQuantities:
    """Values of the selectors of forces in one position of a solution.

    Parameters
    ----------
    at : MotionQuantities
    mu_f : float or None, N/mm
        Scale of the source's force plans; the program's own where the source tells none.
    """

    def __init__(self, at: MotionQuantities, mu_f: float | None = None) -> None:
        if at.solution.problem.dynamics is None:
            raise UnansweredError(Why.NO_FORCES)
        self.at = at
        self.statics: Statics = at.solution.statics
        self.mu_f = self.statics.scale.per_mm if mu_f is None else mu_f

    @cached_property
    def _drawn(self) -> Trace:
        """Force plans of the hand at the source's scale of forces."""
        if self.mu_f == self.statics.scale.per_mm:
            return self.statics.by_hand
        return self.statics.read(self.at.solution.hand, {**self.statics.per_mm, SCALE: self.mu_f})

    def value(self, selector: Selector, reading: Reading) -> float:
        """Return a value: exact or by hand, as the reading is.

        N and N·m; degrees from 0 to 360; arms in millimetres of the position plan. Sizes, but for
        the balancing moment or force, which has its sign.
        """
        exact = reading.trace is self.at.solution.si
        trace, per_mm = (self.statics.si, 1.0) if exact else (self._drawn, self.mu_f)
        return self._value(selector.kind, selector.names, Sheet(reading, trace, per_mm))

    def _value(self, kind: str, names: tuple[str, ...], sheet: Sheet) -> float:
        first, _, rest = kind.partition(" ")
        match first:
            case "arm":
                return self._arm(self._line(rest, names[:-1]), names[-1], sheet)
            case "angle":
                return self._angle(self._line(rest, names), sheet)
            case "F":
                return self._size(self._joint(*names).force, sheet)
            case "Ft" | "Fn":
                return self._component(kind, names, sheet)
            case "M":
                couple = abs(sheet.number(self._joint(*names).couple))
                return 0.0 if couple <= NOTHING * self._largest else couple
            case "balance" | "lever":
                return self._balance(kind, names, sheet)
            case "shift":
                force = self._value("inertia", names, sheet)
                if not force:
                    raise UnansweredError(Why.ZERO_DIVISOR)
                couple = self._value("inertia couple", names, sheet)
                return couple / force / self._mu_l
            case _:
                given = self._given(kind, names[0])
                return 0.0 if given is None else self._load(given, sheet)

    def turn(self, selector: Selector) -> float:
        """Return how far a force turns when its end on the plan moves by one mm, degrees."""
        rest = selector.kind.partition(" ")[2]
        exact = Sheet(self.at.si, self.statics.si, 1.0)
        line = self._line(rest, selector.names)
        return math.degrees(self.mu_f / abs(self._directed(line, exact)))

    # Sizes -----------------------------------------------------------------------------------

    @cached_property
    def _largest(self) -> float:
        """Size of the largest force of the position, N: beside it, rounding is nothing."""
        return self.statics.largest(self.at.position)

    @cached_property
    def _laid_off(self) -> list[LayOff]:
        return [step for step in self.statics.program.steps if isinstance(step, LayOff)]

    def _size(self, force: Force, sheet: Sheet) -> float:
        length = abs(sheet.vector(force.tail, force.head))
        if length * sheet.per_mm <= NOTHING * self._largest:
            return 0.0
        done = any((s.origin, s.out) == (force.tail, force.head) for s in self._laid_off)
        return sheet.newtons(length, laid_off=done)

    def _load(self, given: Given, sheet: Sheet) -> float:
        """Return the size of a load; a force of inertia is computed from the acceleration read."""
        if given.force is None:
            return abs(sheet.number(given.couple))
        if given.applied.kind is not LoadKind.INERTIA:
            return self._size(given.force, sheet)
        dynamics = self.at.solution.problem.dynamics
        assert dynamics is not None and given.applied.point is not None
        head = self.at.plan_point(PlanKind.ACCELERATION, given.applied.point)
        pole = self.at.kin.acceleration.pole
        return dynamics.masses[given.applied.link].mass * sheet.motion.between(
            PlanKind.ACCELERATION, pole, head
        )

    def _component(self, kind: str, names: tuple[str, ...], sheet: Sheet) -> float:
        """Return the part of a reaction across a line, or along it."""
        on, by, *line = names
        force = self._joint(on, by).force
        tail, head = (sheet.motion.point(self._place(name)) for name in line)
        along = (head - tail) / abs(head - tail) * (1j if kind == "Ft" else 1.0)
        done = any(
            (step.out == force.head or step.origin == force.tail)
            and self._is_along(sheet.vector(step.origin, step.out), along)
            for step in self._laid_off
        )
        part = abs((sheet.vector(force.tail, force.head) * along.conjugate()).real)
        if part * sheet.per_mm <= NOTHING * self._largest:
            return 0.0
        return sheet.newtons(part, laid_off=done)

    @staticmethod
    def _is_along(vector: complex, along: complex) -> bool:
        return abs((vector * along.conjugate()).imag) <= 1e-9 * abs(vector)

    def _balance(self, kind: str, names: tuple[str, ...], sheet: Sheet) -> float:
        """Return the balancing moment (force, of a slider), or the force at a point that does."""
        statics, drive = self.statics, self.at.solution.problem.drive
        if kind == "balance":
            exact = sheet.trace is statics.si
            arithmetic = Float64() if exact else self.at.solution.hand
            values = np.asarray(statics.balance_in(sheet.trace, arithmetic), dtype=float)
            value = float(values if values.ndim == 0 else values[sheet.motion.index])
        elif statics.hung is None:
            raise UnansweredError(Why.STANDS)
        else:
            value = sheet.number(statics.hung.balance)
        if not names:
            return value
        if drive.pivot is None:
            raise UnansweredError(Why.NO_LINK)
        link, arm = self.at.arm(sheet.motion, names[0], drive.pivot)
        if link != drive.link:
            raise UnansweredError(Why.NO_LINK)
        if not arm:
            raise UnansweredError(Why.NO_ARM)
        return abs(value) / arm

    # Lines of action -------------------------------------------------------------------------

    def _directed(self, line: Line, sheet: Sheet) -> complex:
        """Return a force that has a direction, N."""
        vector = sheet.vector(line.force.tail, line.force.head) * sheet.per_mm
        if abs(vector) <= NOTHING * self._largest:
            raise UnansweredError(Why.NO_DIRECTION)
        return vector * line.sense

    def _angle(self, line: Line, sheet: Sheet) -> float:
        vector = self._directed(line, sheet)
        return math.degrees(math.atan2(vector.imag, vector.real)) % 360.0

    def _arm(self, line: Line, about: str, sheet: Sheet) -> float:
        vector = self._directed(line, sheet) * line.sense
        motion, size = sheet.motion, abs(vector)
        ends = sheet.place(line.force.at) - motion.point(self._place(about))
        arm = (ends.conjugate() * vector).imag / size
        arm += sheet.number(line.couple) / size / motion.per_mm[PlanKind.POSITION]
        return motion.measure(PlanKind.POSITION, abs(arm)) / self._mu_l

    @property
    def _mu_l(self) -> float:
        return self.at.solution.scales[PlanKind.POSITION].per_mm

    # Names -----------------------------------------------------------------------------------

    def _place(self, point: str) -> PointName:
        return self.at.plan_point(PlanKind.POSITION, point)

    def _joint(self, on: str, by: str) -> Line:
        """Return what one link does to another; two links have one joint."""
        for reaction in self.statics.board.reactions:
            if {reaction.on, reaction.by} == {on, by}:
                sense = 1.0 if reaction.on == on else -1.0
                return Line(reaction.force, reaction.couple, sense)
        raise UnansweredError(Why.NO_JOINT)

    def _line(self, kind: str, names: tuple[str, ...]) -> Line:
        """Return the line of a force that must act somewhere."""
        if kind == "F":
            return self._joint(*names)
        given = self._given(kind, names[0])
        if given is None or given.force is None:
            raise UnansweredError(Why.NO_DIRECTION)
        return Line(given.force)

    def _given(self, kind: str, name: str) -> Given | None:
        """Return a load: of a link, or by its letter; None of what is zero by nature."""
        for given in self.statics.board.given:
            of = given.applied
            if kind == "load":
                if of.kind is LoadKind.EXTERNAL and of.name == name:
                    return given
            elif of.kind is LOADS[kind] and of.link == name:
                return given
        shift = self.statics.board.shifts.get(name) if kind == "inertia couple" else None
        return None if shift is None else Given(shift.moment, None, shift.couple)
