"""Mistakes in velocity and acceleration plans, as rewritten steps of the program."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import cached_property
from types import MappingProxyType

from msgspec import Struct, field

from planmethod.check.sheet import Sheet, single_float
from planmethod.construct import steps
from planmethod.construct.program import Program, rewritten
from planmethod.construct.steps import (
    Compute,
    GivenNumber,
    LineName,
    Name,
    NumberName,
    PointName,
    Step,
)
from planmethod.mechanism.model import FRAME
from planmethod.plans.forces.board import ForceBoard
from planmethod.plans.model import RATES, DimensionKind, PlanKind, Segments
from planmethod.plans.motion.legs import Relative, Turning
from planmethod.problem.records import Against

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
        self.draft = sheet.questions.steps.draft
        self.steps = sheet.program.steps
        self.steps_by_name = sheet.steps_by_name

    @property
    def board(self) -> ForceBoard | None:
        """The force plans, where the sheet has any."""
        statics = self.sheet.questions.statics
        return None if statics is None else statics.board

    @property
    def read_plans(self) -> tuple[PlanKind, ...]:
        """Plans whose segments are turned into values by a scale."""
        return RATES if self.board is None else (*RATES, PlanKind.FORCE)

    def segments(self, plan: PlanKind) -> Segments:
        """Return the segments of a velocity, acceleration or force plan."""
        if plan is PlanKind.FORCE and self.board is not None:
            return self.board.segments
        return self.sheet.questions.steps.segments(plan)

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

    def crank_products(self, power: int) -> Iterator[Compute]:
        """Yield the products of a power of the driver's angular velocity with a length."""
        rate = NumberName(self.problem.drive.coordinate.rates[0])
        for step in self.steps:
            if isinstance(step, Compute) and step.powers[:1] == ((rate, power),):
                yield from [step] if any(self.lengths(step)) else []

    def lengths(self, step: Compute) -> Iterator[NumberName]:
        """Yield the given lengths that a product has as factors."""
        dimensions = self.draft.dimensions
        for name, power in step.powers:
            if power == 1 and name in dimensions and dimensions[name].kind is DimensionKind.LENGTH:
                yield name

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


LITTLE = 0.05
"""Share of a component below which it is as good as forgotten."""

V, A = PlanKind.VELOCITY, PlanKind.ACCELERATION


# Rays ----------------------------------------------------------------------------------------


def _along_the_link(scene: MistakeContext, plan: PlanKind, code: str) -> Iterator[Change]:
    for link, turning in scene.turnings(plan):
        for step in scene.steps:
            if isinstance(step, steps.Perpendicular) and _is_ray(scene, step, turning):
                swapped = steps.Parallel(step.out, step.through, step.to)
                yield Change(code, link, {step.out: (swapped,)})


def _is_ray(scene: MistakeContext, step: steps.Perpendicular, turning: Turning) -> bool:
    """Return whether a perpendicular is the line across a link that its turning is read along."""
    line = scene.steps_by_name[step.to]
    ends = {turning.joint, turning.place}
    return (
        step.through == turning.start
        and isinstance(line, steps.Join)
        and {line.tail, line.head} == ends
    )


def velocity_along_link(scene: MistakeContext) -> Iterator[Change]:
    """V1: v_BA laid along the link."""
    yield from _along_the_link(scene, V, "V1")


def tangential_along_link(scene: MistakeContext) -> Iterator[Change]:
    """N4: the line of a^τ drawn along the link."""
    yield from _along_the_link(scene, A, "N4")


def driver_reversed(scene: MistakeContext) -> Iterator[Change]:
    """V2: the driver moves the other way."""
    drive = scene.problem.drive
    name = NumberName(drive.coordinate.rates[0])
    if name in scene.steps_by_name and (rate := scene.exact_value(name)):
        # One wrong sense alone does not indicate the driver.
        data: dict[str, float] = {name: -rate, **dict(resistances_reversed(scene))}
        yield Change("V2", drive.link, data=data, prior=0.04)


def resistances_reversed(scene: MistakeContext) -> Iterator[tuple[NumberName, float]]:
    """Yield the data of loads against the motion, where it goes the other way."""
    dynamics = scene.problem.dynamics
    against = {one.name for one in dynamics.loads if one.sense == Against()} if dynamics else set()
    for given in scene.board.given if scene.board is not None else ():
        if given.applied.name not in against:
            continue
        if given.couple in scene.steps_by_name and given.couple is not None:
            yield given.couple, -scene.exact_value(given.couple)
        laid = None if given.force is None else scene.steps_by_name.get(given.force.head)
        line = scene.steps_by_name.get(laid.line) if isinstance(laid, steps.LayOffLength) else None
        if isinstance(line, steps.AtAngle):
            yield line.angle, scene.exact_value(line.angle) + 180.0


def similarity_wrong(scene: MistakeContext) -> Iterator[Change]:
    """V3: the ratio from the other end; the triangle mirrored: on one plan, or on both."""
    for make in (_reversed, _mirrored):
        plans: dict[PointName, dict[Name, tuple[Step, ...]]] = {}
        for step in scene.steps:
            if isinstance(step, steps.Similar):
                where = scene.draft.letters.get(step.out, str(step.out)).upper()
                changed: dict[Name, tuple[Step, ...]] = {step.out: make(step)}
                yield Change("V3", where, changed)
                plans.setdefault(step.link_s, {}).update(changed)
                if len(plans[step.link_s]) > 1:
                    yield Change("V3", where, plans[step.link_s])


def _reversed(step: steps.Similar) -> tuple[Step, ...]:
    ends = (step.plan_c, step.plan_b, step.link_s, step.link_b, step.link_c)
    return (steps.Similar(step.out, *ends, step.side, step.span, step.arm),)


def _mirrored(step: steps.Similar) -> tuple[Step, ...]:
    line, across = LineName(f"{step.out} base"), LineName(f"{step.out} across")
    foot, image = fresh(step.out, "foot"), fresh(step.out, "image")
    ends = (step.plan_b, step.plan_c, image, step.link_b, step.link_c)
    return (
        steps.Join(line, step.link_b, step.link_c),
        steps.Perpendicular(across, step.link_s, line),
        steps.IntersectLines(foot, line, across),
        steps.Carry(image, foot, step.link_s, foot),
        steps.Similar(step.out, *ends, step.side, step.span, step.arm),
    )


def sliding_forgotten(scene: MistakeContext) -> Iterator[Change]:
    """V4: v_A3 taken as v_A1, the relative velocity forgotten."""
    for relative in _swinging(scene):
        head, start = relative.head, relative.start
        if head not in scene.steps_by_name:
            continue
        changed: dict[Name, tuple[Step, ...]] = {head: (steps.Carry(head, start, start, start),)}
        for step in scene.steps:
            if isinstance(step, steps.MeasureAlong) and step.head == head and step.tail != start:
                read = NumberName(f"{step.out} whole")
                turn = -1.0 if scene.exact_value(step.out) < 0 else 1.0
                whole = (
                    steps.Measure(read, step.tail, step.head),
                    steps.Compute(step.out, turn, ((read, 1),)),
                )
                changed[step.out] = whole
        yield Change("V4", relative.name, changed)


def _swinging(scene: MistakeContext) -> Iterator[Relative]:
    """Yield the slidings along guides that turn."""
    for relative in scene.kinematics.relatives.values():
        if relative.to != FRAME and relative.to in scene.kinematics.omega:
            yield relative


def arm_wrong(scene: MistakeContext) -> Iterator[Change]:
    """V5: ω by another arm: a given length of the link, or the distance of the pivots."""
    for link, turning in scene.turnings(V):
        step = scene.compute(scene.kinematics.omega[link])
        if step is None or not scene.exact_value(step.out):
            continue
        value = step.powers[0]
        right = abs(scene.exact_value(value[0]) / scene.exact_value(step.out))
        for length in sorted(_arms(scene, link, turning)):
            if abs(length - right) > 1e-6 * right:
                number, made = known(f"{step.out} arm")
                swapped = steps.Compute(step.out, step.factor, (value, (number, -1)), step.size)
                yield Change("V5", link, {step.out: (made, swapped)}, {number: length})


def _arms(scene: MistakeContext, link: str, turning: Turning) -> set[float]:
    """Return lengths that are taken for an arm by mistake, m."""
    bodies = scene.problem.bodies
    points = bodies[link].points
    found = {
        round(abs(points[p] - points[q]), 12)
        for p in points
        for q in points
        if points[p] != points[q]
    }
    frame, pivot = bodies[FRAME].points, scene.problem.drive.pivot
    if turning.joint in frame and pivot is not None and pivot in frame and pivot != turning.joint:
        found.add(round(abs(frame[turning.joint] - frame[pivot]), 12))
    return {length for length in found if length > 0}


# Coriolis ------------------------------------------------------------------------------------


def _coriolis_terms(scene: MistakeContext) -> Iterator[tuple[Relative, steps.Compute]]:
    values = scene.segments(A).values
    for relative in scene.kinematics.relatives.values():
        start, end = relative.a_start, relative.a_coriolis
        if start is None or end is None or start == end:
            continue
        step = scene.compute(values.get((start, end)))
        if step is not None:
            yield relative, step


def coriolis_by_factor(scene: MistakeContext) -> Iterator[Change]:
    """A1, A2, A3: no Coriolis acceleration, turned the other way, the factor 2 missing."""
    for code, factor, prior in (("A1", 0.0, 3.0), ("A2", -1.0, 2.0), ("A3", 0.5, 1.5)):
        for relative, step in _coriolis_terms(scene):
            yield Change(code, relative.name, {step.out: times(step, factor)}, prior=prior)
            if not factor:
                yield from _unlaid(scene, relative.a_coriolis, code, relative.name)


def _unlaid(
    scene: MistakeContext, end: Name | None, code: str, mistake_at: str
) -> Iterator[Change]:
    """Yield a component that is computed and then not laid off."""
    laid = None if end is None else scene.steps_by_name.get(end)
    length = scene.compute(laid.length) if isinstance(laid, steps.LayOffLength) else None
    if length is not None:
        yield Change(code, mistake_at, {length.out: times(length, 0.0)})


def coriolis_of_absolute(scene: MistakeContext) -> Iterator[Change]:
    """A4: an absolute velocity of the coincident points in place of the relative one."""
    velocities = scene.segments(V)
    for relative, step in _coriolis_terms(scene):
        for head in (relative.head, relative.start):
            speed = velocities.values.get((scene.kinematics.velocity.pole, head))
            if speed in scene.steps_by_name and speed is not None:
                powers = (step.powers[0], (speed, 1))
                made = scene.signed(step, powers, abs(step.factor))
                yield Change("A4", relative.name, {step.out: (made,)})


def coriolis_of_crank(scene: MistakeContext) -> Iterator[Change]:
    """A5: ω of the crank in place of the slotted link's, with its sense or without it."""
    drive = scene.problem.drive
    rate = scene.kinematics.omega.get(drive.link)
    for relative, step in _coriolis_terms(scene):
        if rate is not None and rate in scene.steps_by_name and step.powers[0][0] != rate:
            made = scene.signed(step, ((rate, 1), step.powers[1]), abs(step.factor))
            for turn in dict.fromkeys((1.0, step.factor / made.factor)):
                yield Change("A5", relative.name, {step.out: times(made, turn)})


def spurious_coriolis(scene: MistakeContext) -> Iterator[Change]:
    """A6: a Coriolis acceleration where the guide does not turn."""
    scale = scene.segments(A).scale
    for relative in scene.kinematics.relatives.values():
        start, head = relative.a_start, relative.a_head
        if start is None or start != relative.a_coriolis or relative.to in scene.kinematics.omega:
            continue
        if relative.speed not in scene.steps_by_name:  # not needed for any requested item
            continue
        for line in scene.steps:
            if not isinstance(line, steps.Parallel) or line.through != start:
                continue
            if not _meets(scene, line, head):
                continue
            for rate, link in scene.rates.items():
                if (
                    rate not in scene.steps_by_name
                    or relative.point not in scene.problem.bodies[link].points
                ):
                    continue
                across = LineName(f"{line.out} across")
                value, length = NumberName(f"{line.out} ak"), NumberName(f"{line.out} |k|")
                end = fresh(line.out, "k")
                changed: tuple[Step, ...] = (
                    steps.Perpendicular(across, start, line.to),
                    steps.Compute(value, 2.0, ((rate, 1), (relative.speed, 1))),
                    steps.Compute(length, 1.0, ((value, 1), (scale, -1))),
                    steps.LayOffLength(end, start, across, length),
                    steps.Parallel(line.out, end, line.to),
                )
                yield Change("A6", relative.name, {line.out: changed})


def _meets(scene: MistakeContext, line: steps.Parallel, head: PointName | None) -> bool:
    step = None if head is None else scene.steps_by_name.get(head)
    return isinstance(step, steps.IntersectLines) and line.out in (step.first, step.second)


# Normal and tangential components ------------------------------------------------------------


def _normals(scene: MistakeContext) -> Iterator[tuple[str, steps.Compute, PointName]]:
    """Yield the normal components ω²·l: letters, step, where each ends."""
    for (_, end), name in scene.segments(A).values.items():
        step = scene.compute(name)
        if step is not None and step.powers[0][0] in scene.rates and step.powers[0][1] == 2:
            yield str(name).removeprefix("an_"), step, end


def normal_by_factor(scene: MistakeContext) -> Iterator[Change]:
    """N1, N2: aⁿ directed away from the pivot, no aⁿ."""
    for code, factor, prior in (("N1", -1.0, 1.0), ("N2", 0.0, 1.5)):
        for where, step, end in _normals(scene):
            yield Change(code, where, {step.out: times(step, factor)}, prior=prior)
            if not factor:
                yield from _unlaid(scene, end, code, where)


def normal_by_wrong_formula(scene: MistakeContext) -> Iterator[Change]:
    """N3: aⁿ = ω²/l, ω·l, v·l, v²·l, v/l, or with another ω; negligible ones only if requested."""
    asked = {question.name for question in scene.sheet.requested}
    for where, step, _ in _normals(scene):
        rate, length = step.powers[0][0], step.powers[1:]
        inverse = tuple((name, -power) for name, power in length)
        wrong: list[Powers] = [
            ((rate, 2), *inverse),
            ((rate, 1), *length),
            ((rate, 1),),
            ((rate, 1), *length, *length),
            ((rate, 2), *length, *length, *length),
        ]
        wrong += [
            ((other, 2), *length)
            for other in scene.rates
            if other != rate and other in scene.steps_by_name
        ]
        for powers in wrong:
            made = steps.Compute(step.out, step.factor, powers, size=True)
            least = 0.0 if step.out in asked else LITTLE * abs(scene.exact_value(step.out))
            if abs(scene.value(made)) > least:
                yield Change("N3", where, {step.out: (made,)})


def epsilon_of_total(scene: MistakeContext) -> Iterator[Change]:
    """E2: ε by the whole acceleration in place of a^τ."""
    motion = scene.kinematics.acceleration
    for link, turning in scene.turnings(A):
        step = scene.compute(scene.kinematics.epsilon[link])
        if step is None:
            continue
        joint = motion.point.get((link, turning.joint), motion.pole)
        for tail in dict.fromkeys((motion.pole, joint)):
            read = NumberName(f"{step.out} whole")
            value = NumberName(f"{step.out} a")
            turn = -1.0 if scene.exact_value(step.powers[0][0]) < 0 else 1.0
            whole = (
                steps.Measure(read, tail, turning.head),
                steps.Compute(value, turn, ((read, 1), (scene.segments(A).scale, 1))),
                steps.Compute(step.out, step.factor, ((value, 1), *step.powers[1:]), step.size),
            )
            yield Change("E2", link, {step.out: whole})


def turning_reversed(scene: MistakeContext) -> Iterator[Change]:
    """Sense of one ω or ε, and all that follows from it."""
    for plan in (V, A):
        for link, _ in scene.turnings(plan):
            step = scene.compute(scene.kinematics.rates(plan)[link])
            if step is not None:
                yield Change("sign", link, {step.out: times(step, -1.0)})


MOTION_MISTAKES = (
    velocity_along_link,
    driver_reversed,
    similarity_wrong,
    sliding_forgotten,
    arm_wrong,
    coriolis_by_factor,
    coriolis_of_absolute,
    coriolis_of_crank,
    spurious_coriolis,
    normal_by_factor,
    normal_by_wrong_formula,
    tangential_along_link,
    epsilon_of_total,
    turning_reversed,
)
