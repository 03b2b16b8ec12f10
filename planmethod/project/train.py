"""The train of a project: whether it turns the crank, which of its wheels mesh (привод)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import pi

from msgspec.structs import replace

from planmethod.construct.scale import series_near
from planmethod.errors import Fault, ProblemError
from planmethod.gears.involute.sizes import MeshingProblem
from planmethod.gears.model import HALF_MODULES, DiagramSettings, GearProblem, MeshKind, Train
from planmethod.gears.motion import TrainMotion, solve_motion
from planmethod.languages import translate
from planmethod.project.model import PartName, Project, ProjectPart

SPEED_TOLERANCE = 5e-3
"""Relative difference from the crank's speed within which a link of the train turns with it."""

RPM = 30.0 / pi
"""Revolutions per minute of 1 rad/s."""


def meshed(train: Train, pair: MeshingProblem) -> tuple[str, str] | None:
    """Return the wheels of a train that a meshing is of, its wheel 1 first (колёса зацепления).

    They are the only ones that mesh so and have its numbers of teeth; else None.
    """
    kind = MeshKind.INTERNAL if pair.cutter else MeshKind.EXTERNAL
    ends = [(mesh.first, mesh.second) for mesh in train.meshes if mesh.kind is kind]
    ways = [[e for e in (end, end[::-1]) if [train.wheels[x].size for x in e] == [*pair.z]]
            for end in ends]  # fmt: skip
    found = [way[0] for way in ways if way]
    return found[0] if len(found) == 1 else None


def in_mesh(parts: Sequence[ProjectPart]) -> tuple[ProjectPart, ...]:
    """Return the parts of a project, its train with the decisions of the meshing.

    Wheels that mesh there are cut with its shifts and have its module, which is that of the train
    where the train has none; the scale of the scheme grows with it then.

    Raises
    ------
    ProblemError
        The train gives the row of these wheels, or one of them, another module.
    """
    pair = next((x.problem for x in parts if isinstance(x.problem, MeshingProblem)), None)
    return tuple(
        replace(part, problem=_cut(part.problem, pair))
        if isinstance(part.problem, GearProblem) and pair is not None
        else part
        for part in parts
    )


def _cut(problem: GearProblem, pair: MeshingProblem) -> GearProblem:
    train = problem.train
    ends = meshed(train, pair)
    if ends is None:
        return problem
    shifts = dict(zip(ends, pair.x, strict=True))
    wheels = {
        label: wheel if wheel.shift or label not in shifts
        else replace(wheel, shift=Fraction(repr(shifts[label])))
        for label, wheel in train.wheels.items()
    }  # fmt: skip
    module = Fraction(repr(pair.m)) / 1000
    for label in ends:
        told = wheels[label].module
        if told is not None and told != module:
            what = translate(
                "wheels {} and {} have the module {:g} mm, and {:g} mm in [meshing]",
                *ends, float(told * 1000), pair.m,
            )  # fmt: skip
            fault = Fault("gears.module", what, "Keep one of them.")
            raise ProblemError(problem.source_file, [fault])
        if train.module is not None:
            wheels[label] = replace(wheels[label], module=module)
    train = replace(train, wheels=wheels)
    if train.module is None and not any(wheel.is_pulley for wheel in wheels.values()):
        picture = train.picture
        if picture.mu_l == DiagramSettings().mu_l:
            wanted = float(picture.mu_l * module * HALF_MODULES / 2)
            mu_l = series_near(wanted, up=False)
            picture = replace(picture, mu_l=Fraction(repr(mu_l)))
        train = replace(train, module=module, picture=picture)
    return replace(problem, train=train)


def output_of(motion: TrainMotion) -> str | None:
    """Return the output of a train with one input: the last moving body except planets."""
    train = motion.train
    others = {*train.inputs, *(x for some in motion.roles.planets.values() for x in some)}
    moving = [body for body in train.bodies if motion.speeds.get(body) and body not in others]
    return train.output or (moving[-1] if moving else None)


def _driving_speeds(project: Project) -> tuple[TrainMotion, Mapping[str, float], bool] | None:
    """Return the train of a project, the speeds of its bodies, 1/s, whether one is the crank's.

    None where the project has no train, or no crank that turns.
    """
    part, drive = project.part(PartName.GEARS), project.problem.drive
    if part is None or not isinstance(part.problem, GearProblem):
        return None
    if not drive.is_crank or not drive.rate:
        return None
    motion = solve_motion(part.problem)
    train, crank = motion.train, abs(drive.rate)
    turning = [body for body in train.bodies if body not in train.racks]
    speeds = {body: abs(float(motion.speeds.get(body, 0)) * train.rate) for body in turning}
    return motion, speeds, any(abs(x - crank) <= SPEED_TOLERANCE * crank for x in speeds.values())


def quick_shaft(project: Project) -> tuple[str, float] | None:
    """Return the input of the train that turns the crank, and its speed ratio to it; else None.

    The crank turns with a link of the train; of several inputs the quickest one is meant.
    """
    found = _driving_speeds(project)
    if found is None:
        return None
    motion, speeds, turns_crank = found
    inputs = [body for body in motion.train.inputs if body in speeds]
    if not inputs or not turns_crank:
        return None
    quickest = max(inputs, key=speeds.__getitem__)
    ratio = speeds[quickest] / abs(project.problem.drive.rate)
    return (quickest, ratio) if ratio > 1.0 + SPEED_TOLERANCE else None


def warn_of_separate_train(project: Project) -> str | None:
    """Return a warning of a train without a link as fast as the crank; else None."""
    found = _driving_speeds(project)
    if found is None:
        return None
    motion, speeds, turns_crank = found
    output = output_of(motion)
    if output is None or output not in speeds or turns_crank:
        return None
    return translate(
        "the crank makes {:.4g} rev/min, link {} of the train {:.4g} rev/min, and no other link of "
        'it turns with the crank. Change n or the train, or write train = "{}" in [driver].',
        RPM * abs(project.problem.drive.rate),
        output,
        RPM * speeds[output],
        output,
    )
