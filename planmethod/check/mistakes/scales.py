"""Mistakes with scales and units, and another position of the mechanism (масштабы, единицы)."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from msgspec.structs import replace

from planmethod.check.mistakes.forces import lever_by_segments
from planmethod.check.mistakes.plans import Change, MistakeContext, resistances_reversed, times
from planmethod.construct import steps
from planmethod.construct.steps import Name, NumberName, Side, Step
from planmethod.plans.model import FACTS, MOTION, DimensionKind, PlanKind
from planmethod.plans.motion.position import link_of_axis
from planmethod.solved.assemblies import assemblies, env_of

READ = (steps.Measure, steps.MeasureAlong)


def _readings(scene: MistakeContext, plan: PlanKind) -> Iterator[steps.Compute]:
    """Yield the steps that convert a length on a plan into a value."""
    for name in dict.fromkeys(scene.segments(plan).values.values()):
        step = scene.compute(name)
        if step is not None and (NumberName(FACTS[plan].scale), 1) in step.powers:
            yield step


def _swapped(
    step: steps.Compute, scale: NumberName, replacement: tuple[tuple[NumberName, int], ...]
) -> steps.Compute:
    powers = tuple(
        p for pair in step.powers for p in (replacement if pair == (scale, 1) else (pair,))
    )
    return steps.Compute(step.out, step.factor, powers, step.size)


def both_levers(scene: MistakeContext, change: Change) -> Iterator[Change]:
    """Yield a mistake in velocities, and the same where the lever uses the segments as drawn."""
    yield change
    lever = lever_by_segments(scene)
    if lever and change.mistake_at != FACTS[PlanKind.ACCELERATION].scale:
        yield replace(change, steps={**change.steps, **lever})


def scale_inverted(scene: MistakeContext) -> Iterator[Change]:
    """S1: mm divided by μ where they are multiplied."""
    for plan in scene.read_plans:
        scale = NumberName(FACTS[plan].scale)
        changed: dict[Name, tuple[Step, ...]] = {
            step.out: (_swapped(step, scale, ((scale, -1),)),) for step in _readings(scene, plan)
        }
        yield from both_levers(scene, Change("S1", FACTS[plan].scale, changed, of_scale=True))


def scale_of_another_plan(scene: MistakeContext) -> Iterator[Change]:
    """S3: the μ of another plan."""
    for plan in scene.read_plans:
        scale = NumberName(FACTS[plan].scale)
        readings = list(_readings(scene, plan))
        for other in MOTION:
            name = NumberName(FACTS[other].scale)
            if other is plan or name not in scene.steps_by_name or not readings:
                continue
            changed: dict[Name, tuple[Step, ...]] = {
                step.out: (_swapped(step, scale, ((name, 1),)),) for step in readings
            }
            yield from both_levers(scene, Change("S3", FACTS[plan].scale, changed, of_scale=True))


def scale_by(scene: MistakeContext, plan: PlanKind, factor: float) -> Change:
    """Return the mistake of a plan whose μ is wrong by a factor."""
    changed: dict[Name, tuple[Step, ...]] = {
        step.out: (replace(step, factor=step.factor * factor),) for step in _readings(scene, plan)
    }
    return Change("scale", FACTS[plan].scale, changed, prior=0.02, of_scale=True)


RPM = 30.0 / math.pi

SPEEDS = (RPM, 1 / math.pi, 180.0 / math.pi, 1 / RPM, RPM / 60.0, RPM**2)
"""What ω is multiplied by when it is n, n/30, degrees, or n is ω; when it is n/60, 9.55·n."""


def units_of_speed(scene: MistakeContext) -> Iterator[Change]:
    """S2: rev/min for 1/s, n/30 without π, degrees for radians."""
    drive = scene.problem.drive
    name = NumberName(drive.coordinate.rates[0])
    if (
        drive.pivot is None
        or name not in scene.steps_by_name
        or not (rate := scene.exact_value(name))
    ):
        return
    for factor in SPEEDS:
        yield Change("S2", drive.link, data={name: rate * factor})


DIAMETER = 0.1
"""Prior of the diameter for the radius: a single number is half the right one by chance."""


def crank_length_wrong(scene: MistakeContext) -> Iterator[Change]:
    """Diameter for radius of the crank, or the reverse: in its velocity, in all, and as drawn."""
    speeds, normals = (tuple(scene.crank_products(power)) for power in (1, 2))
    lengths = dict.fromkeys(name for step in speeds for name in scene.lengths(step))
    letters = "".join(str(name).replace("l_", "l_{", 1) + "}" for name in lengths)
    for factor, wrong in ((2.0, f"2{letters}"), (0.5, f"{letters}/2")) if len(lengths) == 1 else ():
        where = f"{wrong} ≠ {letters}"
        changed: dict[Name, tuple[Step, ...]] = {s.out: times(s, factor) for s in speeds}
        yield from both_levers(scene, Change("slip", where, changed, prior=DIAMETER))
        every = changed | {step.out: times(step, factor) for step in normals}
        yield from both_levers(scene, Change("slip", where, every, prior=DIAMETER))
        data = {str(name): factor * scene.exact_value(name) for name in lengths}
        yield Change("slip", where, data=data, prior=DIAMETER)


def units_of_length(scene: MistakeContext) -> Iterator[Change]:
    """S2: lengths in mm in formulas that want metres."""
    lengths = {
        name
        for name, dimension in scene.draft.dimensions.items()
        if dimension.kind is DimensionKind.LENGTH
    }
    changed: dict[Name, tuple[Step, ...]] = {}
    for step in scene.steps:
        if not isinstance(step, steps.Compute) or step.out in scene.draft.dimensions:
            continue
        power = sum(power for name, power in step.powers if name in lengths)
        if power:
            changed[step.out] = (replace(step, factor=step.factor * 1000.0**power),)
    of_kind: list[dict[Name, tuple[Step, ...]]] = [
        {name: changed[name] for name in rates.values() if name in changed}
        for rates in (scene.kinematics.omega, scene.kinematics.epsilon)
    ]
    for some in (changed, *(one for one in of_kind if len(one) > 1)):
        if some:
            yield Change("S2", "l", some)


def true_for_drawn(scene: MistakeContext) -> Iterator[Change]:
    """Length of a link read from the drawing and used as its true one; V5: in mm, for an arm."""
    scale = NumberName(FACTS[PlanKind.POSITION].scale)
    changed: dict[Name, tuple[Step, ...]] = {}
    for step in scene.steps:
        if not isinstance(step, steps.Compute):
            continue
        powers = dict(step.powers)
        read = any(isinstance(scene.steps_by_name[name], READ) for name in powers)
        if scale in powers and read:
            power = powers.pop(scale)
            made = steps.Compute(step.out, step.factor, tuple(powers.items()), step.size)
            changed[step.out] = times(made, 0.001**power)
            for link, rate in scene.kinematics.omega.items():
                if rate == step.out:
                    yield Change("V5", link, {step.out: (made,)})
    if changed:
        yield Change("true_mm", "l", changed)


def other_assembly(scene: MistakeContext) -> Iterator[Change]:
    """P1: a group closed the other way."""
    for step in scene.steps:
        swapped: Step
        match step:
            case steps.IntersectCircles():
                other = Side.LEFT if step.side is Side.RIGHT else Side.RIGHT
                swapped = replace(step, side=other)
            case steps.IntersectLineCircle():
                way = (
                    steps.LineSense.BACKWARD
                    if step.sense is steps.LineSense.FORWARD
                    else steps.LineSense.FORWARD
                )
                swapped = replace(step, sense=way)
            case steps.TriadPose():
                yield from _other_poses(scene, step)
                continue
            case _:
                continue
        yield Change("P1", str(step.out), {step.out: (swapped,)})
    for step in scene.steps:  # an arm laid off on the other side of the pivot
        if isinstance(step, steps.LayOffLength) and _is_arm(scene, step):
            back = NumberName(f"{step.out} back")
            made = (
                steps.Compute(back, -1.0, ((step.length, 1),)),
                replace(step, length=back),
            )
            yield Change("P1", str(step.out), {step.out: made})


def _is_arm(scene: MistakeContext, step: steps.LayOffLength) -> bool:
    """Return whether a joint of a link is laid off from its pivot by the line of its guide."""
    line = scene.steps_by_name.get(step.line)
    guided = isinstance(line, steps.Parallel | steps.AtAngle) and line.to is not None
    bodies = scene.problem.bodies.values()
    return guided and sum(str(step.out) in body.points for body in bodies) > 1


def _other_poses(scene: MistakeContext, step: steps.TriadPose) -> Iterator[Change]:
    """P1: each of the other assemblies of a triad (сборки группы III класса)."""
    mu_l = scene.exact_value(NumberName(FACTS[PlanKind.POSITION].scale))
    here = complex(np.reshape(scene.sheet.exact_trace.value[step.out][0], -1)[0])
    poses = assemblies(step, env_of(step, scene.sheet.exact_trace, 0))
    for pose in sorted(poses, key=lambda pose: abs(pose.origin - here))[1:]:
        told = (pose.origin.real * mu_l, pose.origin.imag * mu_l, pose.turn)
        names = (f"start_{what}_{link_of_axis(step)}" for what in ("x", "y", "turn"))
        yield Change("P1", link_of_axis(step), data=dict(zip(names, told, strict=True)))


def other_angle(scene: MistakeContext) -> Iterator[Change]:
    """P1: the angle of the crank counted the other way, or from another axis."""
    drive = scene.problem.drive
    name = drive.program_inputs[0]
    if drive.pivot is None or name not in scene.steps_by_name:
        return
    phi = scene.exact_value(NumberName(name))
    told: set[float] = {phi % 360.0}
    for other in (-phi, 180.0 - phi, phi + 180.0, 90.0 - phi, phi + 90.0, phi - 90.0):
        if other % 360.0 not in told:
            told.add(other % 360.0)
            yield Change("P1", drive.link, data={name: other})
            if back := {str(key): value for key, value in resistances_reversed(scene)}:
                yield Change("P1", drive.link, data={name: other, **back})


MISTAKES = (
    scale_inverted,
    scale_of_another_plan,
    units_of_speed,
    crank_length_wrong,
    units_of_length,
    true_for_drawn,
    other_assembly,
    other_angle,
)
