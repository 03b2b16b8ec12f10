"""Model of a mistake: replaced steps, replaced data (ошибка как замена шагов)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import cached_property
from types import MappingProxyType

from msgspec import Struct, field

from planmethod.check.sheet import Sheet, single_float
from planmethod.construct.program import Program
from planmethod.construct.rewrite import rewritten
from planmethod.construct.steps import (
    Compute,
    GivenNumber,
    Name,
    NumberName,
    PointName,
    Step,
)
from planmethod.plans.forces.board import ForceBoard
from planmethod.plans.model import PlanKind
from planmethod.plans.motion.legs import Turning
from planmethod.plans.segments import Segments

Powers = tuple[tuple[NumberName, int], ...]


class Change(Struct, frozen=True):
    """One mistake at one place of a program (ошибка в одном месте).

    Attributes
    ----------
    code : str
    mistake_at : str
        Link, point or pair, as people write it.
    steps : mapping of Name to tuple of Step
        Steps that replace a step.
    data : mapping of str to float
        Data in place of the given ones, or of new steps.
    prior : float
        Frequency relative to other mistakes; 1 for the usual ones.
    of_scale : bool
        Whether the mistake is in a scale: then the student's reading is not value over scale.
    """

    code: str
    mistake_at: str
    steps: Mapping[Name, tuple[Step, ...]] = field(default_factory=lambda: MappingProxyType({}))
    data: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    prior: float = 1.0
    of_scale: bool = False

    def program(self, program: Program) -> Program:
        """Return a program with the mistake in it."""
        if not self.steps:
            return program
        return rewritten(program, lambda step: self.steps.get(step.out, step))


class MistakeContext:
    """A sheet with the steps that mistakes modify (что где построено)."""

    def __init__(self, sheet: Sheet) -> None:
        self.sheet = sheet
        self.solution = sheet.questions.solution
        self.problem = self.solution.problem
        self.kinematics = self.solution.construction.kinematics
        self.draft = sheet.questions.selecting.draft
        self.steps = sheet.program.steps
        self.steps_by_name = sheet.steps_by_name

    @property
    def board(self) -> ForceBoard | None:
        """The force plans, where the sheet has any."""
        statics = self.sheet.questions.statics
        return None if statics is None else statics.board

    def segments(self, plan: PlanKind) -> Segments:
        """Return the segments of the velocity or the acceleration plan."""
        return self.sheet.questions.selecting.segments(plan)

    def exact_value(self, name: Name) -> float:
        """Return the exact value of a number."""
        return single_float(self.sheet.exact_trace.value[name])

    def turnings(self, plan: PlanKind) -> Iterator[tuple[str, Turning]]:
        """Yield the links whose ω (ε) is read from a plan of the sheet."""
        rates = self.kinematics.rates(plan)
        for (of, link), turning in self.kinematics.turnings.items():
            if of is plan and rates.get(link) in self.steps_by_name:
                yield link, turning

    def compute(self, name: Name | None) -> Compute | None:
        """Return the step that computes a number; None where the sheet has no such step."""
        step = None if name is None else self.steps_by_name.get(name)
        return step if isinstance(step, Compute) else None

    @cached_property
    def rates(self) -> dict[NumberName, str]:
        """Angular velocities by their numbers, and a link that turns so."""
        found: dict[NumberName, str] = {}
        for link, name in self.kinematics.omega.items():
            found.setdefault(name, link)
        return found

    def signed(self, step: Compute, powers: Powers, factor: float = 1.0) -> Compute:
        """Return a product with the sign that the right one has."""
        made = Compute(step.out, factor, powers)
        turn = -1.0 if self.value(made) * self.exact_value(step.out) < 0 else 1.0
        return Compute(step.out, factor * turn, powers)

    def value(self, step: Compute) -> float:
        """Return what a product comes to with the exact numbers."""
        powers = (self.exact_value(name) ** power for name, power in step.powers)
        return step.factor * math.prod(powers)


def times(step: Compute, factor: float) -> tuple[Step, ...]:
    """Return a product with another factor: times the right one."""
    return (Compute(step.out, step.factor * factor, step.powers, step.size),)


def known(name: str) -> tuple[NumberName, GivenNumber]:
    """Return a new number of the data and its step."""
    return NumberName(name), GivenNumber(NumberName(name))


def fresh(name: Name, mark: str) -> PointName:
    """Return the name of a further point."""
    return PointName(f"{name} {mark}")
