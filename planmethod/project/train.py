"""Whether the train of a project turns its crank (согласование привода с кривошипом)."""

from __future__ import annotations

from math import pi

from planmethod.gears.model import GearProblem
from planmethod.gears.motion import TrainMotion, solve_motion
from planmethod.languages import say
from planmethod.project.model import PartName, Project

ALIKE = 5e-3
"""Share of the crank's speed within which a link of the train turns with it."""

RPM = 30.0 / pi
"""Revolutions per minute of 1 rad/s."""


def output_of(motion: TrainMotion) -> str | None:
    """Return the body that a train with one input drives: a carrier, else the last that moves."""
    inputs = motion.train.inputs
    moving = [body for body in motion.train.bodies if motion.speeds.get(body)]
    ends = [*motion.train.carriers, *reversed(moving)]
    return next((body for body in ends if body in moving and body not in inputs), None)


def train_apart(project: Project) -> str | None:
    """Return a warning of a train no link of which turns as fast as the crank; else None."""
    part, drive = project.part(PartName.GEARS), project.problem.drive
    if part is None or not isinstance(part.problem, GearProblem):
        return None
    if not drive.is_crank or not drive.rate:
        return None
    motion = solve_motion(part.problem)
    train, crank = motion.train, abs(drive.rate)
    turning = [body for body in train.bodies if body not in train.racks]
    speeds = {body: abs(float(motion.speeds.get(body, 0)) * train.rate) for body in turning}
    output = output_of(motion)
    if output not in speeds or any(abs(x - crank) <= ALIKE * crank for x in speeds.values()):
        return None
    return say(
        "the crank makes {:.4g} rev/min, link {} of the train {:.4g} rev/min, and no other link of "
        'it turns with the crank. Change n or the train, or write train = "{}" in [driver].',
        RPM * crank,
        output,
        RPM * speeds[output],
        output,
    )
