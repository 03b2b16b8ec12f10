"""Mistakes in force plans and in the Zhukovsky lever (ошибки в силовом расчёте)."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from planmethod.check.mistakes.model import Change, MistakeContext, times
from planmethod.construct import steps
from planmethod.construct.steps import LineName, Name, NumberName, Step
from planmethod.mechanism.model import FRAME
from planmethod.plans.forces.board import GivenLoad
from planmethod.plans.forces.loads import LoadKind
from planmethod.plans.model import FACTS, PlanKind


def _loads(scene: MistakeContext, kind: LoadKind) -> Iterator[GivenLoad]:
    if scene.board is not None:
        yield from (given for given in scene.board.given if given.applied.kind is kind)


def inertia_along(scene: MistakeContext) -> Iterator[Change]:
    """F1: Φ along the acceleration: of one link, of all."""
    every: dict[Name, tuple[Step, ...]] = {}
    for given in _loads(scene, LoadKind.INERTIA):
        assert given.force is not None
        carry = scene.steps_by_name.get(given.force.head)
        step = scene.compute(carry.times) if isinstance(carry, steps.Carry) else None
        if step is not None:
            every[step.out] = times(step, -1.0)
            yield Change("F1", given.applied.link, {step.out: every[step.out]})
    if len(every) > 1:
        yield Change("F1", "", every, prior=2.0)


def inertia_couple_wrong(scene: MistakeContext) -> Iterator[Change]:
    """F2: the couple of inertia with the sense of ε, or forgotten: of one link, of all."""
    for factor in (-1.0, 0.0):
        every: dict[Name, tuple[Step, ...]] = {}
        for given in _loads(scene, LoadKind.INERTIA_COUPLE):
            step = scene.compute(given.couple)
            if step is not None:
                every[step.out] = times(step, factor)
                yield Change("F2", given.applied.link, {step.out: every[step.out]})
        if len(every) > 1:
            yield Change("F2", "", every, prior=2.0)


def weight_wrong(scene: MistakeContext) -> Iterator[Change]:
    """F3: weights forgotten, or mass taken for weight: of one link, of all."""
    found: list[tuple[str, steps.Compute]] = []
    for given in _loads(scene, LoadKind.WEIGHT):
        assert given.force is not None and scene.board is not None
        step = scene.compute(scene.board.segments.values.get(given.force.ends))
        if step is not None:
            found.append((given.applied.link, step))
    for made in (lambda step: times(step, 0.0), _without_g):
        every: dict[Name, tuple[Step, ...]] = {step.out: made(step) for _, step in found}
        for link, step in found:
            yield Change("F3", link, {step.out: made(step)})
        if len(found) > 1:
            yield Change("F3", "", every, prior=2.0)


def _without_g(step: steps.Compute) -> tuple[Step, ...]:
    return (replace(step, powers=step.powers[:1]),)


def arm_along(scene: MistakeContext) -> Iterator[Change]:
    """F4: an arm measured along the force in place of across."""
    for step in scene.steps:
        if isinstance(step, steps.MeasureArm):
            line = LineName(f"{step.out} line")
            along = steps.MeasureAlong(step.out, step.about, step.at, line)
            yield Change("F4", "", {step.out: (steps.Join(line, step.tail, step.head), along)})


def moments_in_mm(scene: MistakeContext) -> Iterator[Change]:
    """F4: arms in mm in place of metres."""
    mu_l = NumberName(FACTS[PlanKind.POSITION].scale)
    changed: dict[Name, tuple[Step, ...]] = {}
    for step in scene.steps:
        if isinstance(step, steps.Compute) and any(
            isinstance(scene.steps_by_name[name], steps.MeasureArm) for name, _ in step.powers
        ):
            changed[step.out] = times(step, 1000.0) if (mu_l, 1) in step.powers else (step,)
    if changed:
        yield Change("F4", "", changed)


def reaction_not_reversed(scene: MistakeContext) -> Iterator[Change]:
    """F5: what acts on the next link with the sense that it has on this one."""
    if scene.board is None:
        return
    for reaction in scene.board.reactions:
        if reaction.by == FRAME:
            continue
        tail, head = reaction.force.ends
        changed: dict[Name, tuple[Step, ...]] = {}
        for step in scene.steps:
            if isinstance(step, steps.Carry | steps.MeasureArm) and (step.tail, step.head) == (
                head,
                tail,
            ):
                changed[step.out] = (replace(step, tail=tail, head=head),)
        if changed:
            yield Change("F5", f"{reaction.by}{reaction.on}", changed)


def lever_not_turned(scene: MistakeContext) -> Iterator[Change]:
    """Z1: forces on the velocity plan that was not turned."""
    changed: dict[Name, tuple[Step, ...]] = {
        step.out: (replace(step, rotated=False),)
        for step in scene.steps
        if isinstance(step, steps.Carry) and step.rotated
    }
    if changed:
        yield Change("Z1", "", changed)


def couple_not_converted(scene: MistakeContext) -> Iterator[Change]:
    """Z2: a couple on the lever as it is, without (bc)/l."""
    mu_v = NumberName(FACTS[PlanKind.VELOCITY].scale)
    couples = {given.couple for given in (scene.board.given if scene.board else ()) if given.couple}
    changed: dict[Name, tuple[Step, ...]] = {}
    for step in scene.steps:
        if not isinstance(step, steps.Compute) or len(step.powers) != 2:
            continue
        (one, _), (two, power) = step.powers
        if one in couples and two in scene.rates and power == 1 and mu_v in scene.steps_by_name:
            changed[step.out] = (replace(step, powers=((one, 1), (mu_v, 1))),)
    if changed:
        yield Change("Z2", "", changed)


MISTAKES = (
    inertia_along,
    inertia_couple_wrong,
    weight_wrong,
    arm_along,
    moments_in_mm,
    reaction_not_reversed,
    lever_not_turned,
    couple_not_converted,
)
