"""Springs as a student has them: length and velocity off the plans, the force by them (пружины).

The force plans take a spring for a given load: its force follows from the exact motion. A student
reads its length with a ruler, so here the given numbers are replaced by the steps that give them.
Then the tolerance of the force is that of the drawing, and mistakes in the law are rewritten steps.
"""

# no messages: names of steps

from __future__ import annotations

from collections.abc import Iterator
from math import degrees, pi, radians
from typing import TypeAlias

import numpy as np
from msgspec import Struct, field

from planmethod.construct import steps
from planmethod.construct.program import Program, rewritten
from planmethod.construct.steps import GivenNumber, LineName, Name, NumberName, PointName, Step
from planmethod.mechanism.model import FRAME
from planmethod.plans.forces.board import GivenLoad
from planmethod.plans.model import RATES
from planmethod.problem.records import Couple, Load, Spring, SpringEnd
from planmethod.solved.forces.springs import SpringState, springs_of
from planmethod.solved.forces.statics import Statics
from planmethod.solved.quantity_steps import QuantitySteps
from planmethod.solved.solution import Solution

LoadOnPlan: TypeAlias = tuple[Load | Couple, GivenLoad]
"""A load of the file, and how the force plans have it."""

SMALL = 1e-9
"""Length of a spring, mm, below which it has no direction."""


class DrawnSpring(Struct, frozen=True):
    """A spring by steps (пружина на чертеже).

    Attributes
    ----------
    spring : Spring
    deflection : Total
        Elongation over the rest, m, or angle over the rest, degrees.
    elastic, damped : NumberName or None
        Its parts, N or N·m.
    force : Total
        Their sum.
    loads : tuple of NumberName
        What it exerts on the moving links: size of a force, couple.
    rest : float
        Length, m, or angle, degrees, at rest.
    """

    spring: Spring
    deflection: steps.Total
    elastic: NumberName | None
    damped: NumberName | None
    force: steps.Total
    loads: tuple[NumberName, ...]
    rest: float

    @property
    def symbol(self) -> str:
        """Letter of its force or moment."""
        return self.spring.symbol


class DrawnSprings(Struct):
    """The springs of a sheet by steps.

    Attributes
    ----------
    springs : list of DrawnSpring
    data : dict of str to float
        Numbers that their steps need.
    replaced : dict of Name to tuple of Step
        Steps in place of the given numbers.
    """

    springs: list[DrawnSpring] = field(default_factory=list)
    data: dict[str, float] = field(default_factory=dict)
    replaced: dict[Name, tuple[Step, ...]] = field(default_factory=dict)

    def program(self, program: Program) -> Program:
        """Return a program with the springs by steps."""
        if not self.replaced:
            return program
        return rewritten(program, lambda step: self.replaced.get(step.out, step))


def draw_springs(plans: QuantitySteps, statics: Statics | None) -> DrawnSprings:
    """Return the springs of a position by steps; none that has no length there."""
    found, dynamics = DrawnSprings(), plans.solution.problem.dynamics
    if statics is None or dynamics is None or not dynamics.springs:
        return found
    law = springs_of(plans.solution)
    for spring in dynamics.springs:
        loads = [one for one in dynamics.loads if one.size is spring]
        given = [
            (one, applied)
            for one in loads
            for applied in statics.board.given
            if applied.applied.name == one.name
        ]
        if given:
            _SpringSteps(plans, spring, law.state(spring), found).draw(given)
    return found


class _SpringSteps:
    """Steps of one spring in the making."""

    def __init__(
        self, plans: QuantitySteps, spring: Spring, state: SpringState, springs: DrawnSprings
    ) -> None:
        self.plans, self.spring, self.state, self.springs = plans, spring, state, springs
        self.steps: list[Step] = []
        self.kinematics = plans.kinematics
        self.mu_l = plans.draft.mu_l

    def draw(self, loads: list[LoadOnPlan]) -> None:
        """Replace the given numbers of its loads, unless nothing of it is seen on the drawing."""
        line = None if self.spring.is_torsion else self._line()
        if not self.spring.is_torsion and line is None:
            return
        stretched = self._angle() if line is None else self._length(*line)
        if stretched is None:
            return
        deflection, rest = stretched
        terms: list[NumberName] = []
        elastic = self._elastic(deflection) if self.spring.stiffness else None
        damped = self._damped(line) if self.spring.damping else None
        terms += [one for one in (elastic, damped) if one is not None]
        if self.spring.preload is not None:
            terms.append(self._known("preload", self.spring.preload))
        force = steps.Total(self._name("force"), tuple(terms))
        self.steps.append(force)
        sizes: list[NumberName] = []
        for one, applied in sorted(loads, key=self._order):
            assert isinstance(one.sense, SpringEnd)
            size = self._replace(applied, one.sense, force.out, line)
            if size is None:
                return
            sizes.append(size)
        self.springs.springs.append(
            DrawnSpring(self.spring, deflection, elastic, damped, force, tuple(sizes), rest)
        )

    # Names -----------------------------------------------------------------------------------

    def _name(self, quantity: str) -> NumberName:
        return NumberName(f"spring {self.spring.symbol} {quantity}")

    def _known(self, quantity: str, value: float) -> NumberName:
        name = self._name(quantity)
        self.springs.data[name] = float(value)
        self.steps.append(GivenNumber(name))
        return name

    def _at(self, values: object) -> complex:
        shown = np.broadcast_to(np.asarray(values), self.plans.solution.positions.shape)
        return complex(shown[self.plans.position])

    # Lengths ---------------------------------------------------------------------------------

    def _line(self) -> tuple[LineName, PointName, PointName] | None:
        """Draw the line of the spring; None where it has no length."""
        ends = [self._end(number) for number in range(2)]
        if ends[0] is None or ends[1] is None or abs(self._at(self.state.size)) < SMALL:
            return None
        line = LineName(f"{self._name('line')}")
        self.steps.append(steps.Join(line, ends[0], ends[1]))
        return line, ends[0], ends[1]

    def _end(self, number: int) -> PointName | None:
        """Return an end on the position plan; coordinates on the frame are laid off from a point.

        None if the frame has no point from which they could be.
        """
        end = self.spring.points[number]
        if isinstance(end, str):
            named = self.kinematics.velocity.named.get(end)
            return PointName(end if named is None else named[1])
        fixed = self.plans.solution.problem.bodies[FRAME].points
        start = next((point for point in fixed if self._is_drawn(point)), None)
        if start is None:
            return None
        ray = end - fixed[start]
        if not ray:
            return PointName(start)
        angle = self._known(f"at {number} angle", degrees(np.angle(ray)))
        metres = self._known(f"at {number} distance", abs(ray))
        line, length = LineName(f"{angle} line"), NumberName(f"{metres} drawn")
        made = PointName(f"{metres} end")
        self.steps += [
            steps.AtAngle(line, PointName(start), None, angle),
            steps.Compute(length, 1.0, ((metres, 1), (self.mu_l, -1))),
            steps.LayOffLength(made, PointName(start), line, length),
        ]
        return made

    def _is_drawn(self, point: str) -> bool:
        return point in self.plans.draft.marked

    def _length(self, line: LineName, one: PointName, two: PointName) -> tuple[steps.Total, float]:
        """Read the length, and return the elongation over the rest."""
        read, length = self._name("length on the drawing"), self._name("length")
        rest = self._at(self.state.size).real - self._at(self.state.deflection).real
        self.steps += [
            steps.Measure(read, one, two),
            steps.Compute(length, 1.0, ((read, 1), (self.mu_l, 1))),
        ]
        free = self._known("free length", -rest)
        deflection = steps.Total(self._name("deflection"), (length, free))
        self.steps.append(deflection)
        return deflection, rest

    def _angle(self) -> tuple[steps.Total, float] | None:
        """Read the angle between the axes with a protractor, and return it over the rest."""
        axes = [self._axis(link) for link in self.spring.links]
        if None in axes:
            return None
        (first, turn), (second, turn2) = (axis for axis in axes if axis is not None)
        read = self._name("angle")
        if second is None:
            assert first is not None
            opposite = self._name("angle from the frame")
            self.steps += [
                steps.MeasureAngle(opposite, first),
                steps.Compute(read, -1.0, ((opposite, 1),)),
            ]
        else:
            self.steps.append(steps.MeasureAngle(read, second, first))
        own = degrees(np.angle(np.exp(1j * (turn2 - turn))))
        over = degrees(self._at(self.state.deflection).real)
        offset = self._known("angle of rest", over - own)
        deflection = steps.Total(self._name("deflection"), (read, offset))
        self.steps.append(deflection)
        return deflection, self._at(self.state.size).real - over

    def _axis(self, link: str) -> tuple[LineName | None, float] | None:
        """Draw a line of a link, and return it and its exact angle; None of a link without one."""
        if link == FRAME:
            return None, 0.0
        solution = self.plans.solution
        points = [p for p in solution.problem.bodies[link].points if p in solution.points]
        if len(points) < 2:  # a slider, along its guide
            along = self.plans.draft.axes.get(link)
            turned = radians(self._at(solution.links[link].phi_deg).real)
            return None if along is None else (along, turned)
        here, *others = ((p, self._at(solution.points[p].place)) for p in points)
        there = max(others, key=lambda one: abs(one[1] - here[1]))
        line = LineName(f"{self._name('axis')} {link}")
        self.steps.append(steps.Join(line, self._place(here[0]), self._place(there[0])))
        return line, float(np.angle(there[1] - here[1]))

    def _place(self, point: str) -> PointName:
        return PointName(self.kinematics.velocity.named[point][1])

    # Forces ----------------------------------------------------------------------------------

    def _elastic(self, deflection: steps.Total) -> NumberName:
        stiffness, name = self._known("stiffness", self.spring.stiffness), self._name("elastic")
        per = pi / 180.0 if self.spring.is_torsion else 1.0
        powers = ((stiffness, 1), (deflection.out, 1))
        self.steps.append(steps.Compute(name, -per, powers))
        return name

    def _damped(self, line: tuple[LineName, PointName, PointName] | None) -> NumberName | None:
        rate = self._turning() if line is None else self._speed(line[0])
        if rate is None:
            return None
        damping, name = self._known("damping", self.spring.damping), self._name("damped")
        self.steps.append(steps.Compute(name, -1.0, ((damping, 1), (rate, 1))))
        return name

    def _speed(self, line: LineName) -> NumberName | None:
        """Read how fast the spring becomes longer off the velocity plan."""
        if not self.plans.solution.problem.drive.rate:
            return None
        motion = self.kinematics.velocity
        ends = [
            motion.pole if link == FRAME else motion.point[motion.named[str(point)]]
            for link, point in zip(self.spring.links, self.spring.points, strict=True)
        ]
        if ends[0] == ends[1]:
            return None
        read, rate = self._name("segment"), self._name("rate")
        scale = self.plans.segments(RATES[0]).scale
        self.steps += [
            steps.MeasureAlong(read, ends[0], ends[1], line),
            steps.Compute(rate, 1.0, ((read, 1), (scale, 1))),
        ]
        return rate

    def _turning(self) -> NumberName | None:
        omega, terms = self.kinematics.omega, list[NumberName]()
        first, second = self.spring.links
        if second in omega:
            terms.append(omega[second])
        if first in omega:
            back = self._name("turning back")
            self.steps.append(steps.Compute(back, -1.0, ((omega[first], 1),)))
            terms.append(back)
        if not terms:
            return None
        rate = self._name("rate")
        self.steps.append(steps.Total(rate, tuple(terms)))
        return rate

    def _replace(
        self,
        load: GivenLoad,
        end: SpringEnd,
        force: NumberName,
        line: tuple[LineName, PointName, PointName] | None,
    ) -> NumberName | None:
        """Replace the given numbers of one load, and return its size or couple."""
        if load.couple is not None:
            made = steps.Compute(load.couple, end.sign, ((force, 1),))
            self._replace_step(load.couple, made)
            return load.couple
        known = self._direction_and_size(load)
        if known is None or line is None:
            return None
        angle, size = known
        turned = self._at(self.state.on(end))
        along = self._at(self.state.direction)
        sense = 1.0 if (turned * along.conjugate()).real >= 0 else -1.0
        read, offset = NumberName(f"{angle} read"), NumberName(f"{angle} turned")
        self.springs.data[offset] = 0.0 if sense > 0 else 180.0
        self._replace_step(
            angle,
            steps.MeasureAngle(read, line[0]),
            GivenNumber(offset),
            steps.Total(angle, (read, offset)),
        )
        self._replace_step(size, steps.Compute(size, sense * end.sign, ((force, 1),)))
        return size

    def _replace_step(self, out: Name, *made: Step) -> None:
        self.springs.replaced[out] = (*self.steps, *made)
        self.steps = []

    def _order(self, load: LoadOnPlan) -> int:
        """Return where the program has the first given number of a load: what it needs is there."""
        known = self._direction_and_size(load[1])
        first = load[1].couple if known is None else known[0]
        made = self.plans.draft.b.steps
        return next((k for k, step in enumerate(made) if step.out == first), len(made))

    def _direction_and_size(self, load: GivenLoad) -> tuple[NumberName, NumberName] | None:
        """Return the given numbers by which a force is laid off; None of a couple."""
        if load.force is None:
            return None
        names = self.plans.draft.b.steps
        by_name = {step.out: step for step in names}
        laid = by_name.get(load.force.head)
        line = by_name.get(laid.line) if isinstance(laid, steps.LayOffLength) else None
        length = by_name.get(laid.length) if isinstance(laid, steps.LayOffLength) else None
        if not isinstance(line, steps.AtAngle) or not isinstance(length, steps.Compute):
            return None
        size = next((n for n, _ in length.powers if isinstance(by_name.get(n), GivenNumber)), None)
        return None if size is None else (line.angle, size)


def spring_letters(solution: Solution) -> Iterator[str]:
    """Yield the letters of the forces and moments of the springs."""
    dynamics = solution.problem.dynamics
    yield from (spring.symbol for spring in (dynamics.springs if dynamics else ()))
