"""Random mechanisms with loads that an actuator drives, between any two of their bodies."""

from __future__ import annotations

import cmath
import random
import re
from itertools import count

from doors import (
    FRAME,
    Drive,
    ModelProblem as Problem,
    OutputPositionKind,
    OutputPositions,
    problem_loads as loads,
)
from full_system import Ends
from loaded import loaded_text
from msgspec.structs import replace
from newton import Motion, solve as newton

from benchmarks.generator import Pose, random_problem

_LEAST = 0.15
"""Share of the speed of its ends that its rate has at least: else it is nearly dead."""


def actuated_problem(
    seed: int, *, triad: bool = False, stands: bool = False
) -> tuple[Problem, Pose, Ends]:
    """Return a random mechanism with loads and an actuator, its pose, and the actuator's ends.

    Half of them have the cylinder and the rod as links of their own, with masses.
    """
    rng = random.Random(f"actuator {seed}")
    for more in count(step=10**6):
        text, pose = random_problem(seed + more, triad=triad)
        plain = loads(text, name="plain")
        motion = newton(plain, plain.drive.positions[0], pose)
        if (ends := ends_of(plain, motion, rng)) is not None:
            one, two = ends
            break
    names = one[0], two[0]
    # A new point of the rod needs a rule, and a point with a rule gets no other.
    if rng.random() < 0.5 and not {*names} & {rule.point for rule in plain.assembly}:
        text, pose = _with_cylinder(text, pose, names, motion, rng)
        one, two = (one[0], "101"), (two[0], "102")
    text = loaded_text(text, pose, random.Random(f"loads {seed}"))
    return _driven(loads(text, name=f"actuated-{seed}"), names, stands=stands), pose, (one, two)


def ends_of(problem: Problem, motion: Motion, rng: random.Random) -> Ends | None:
    """Return two points whose distance the mechanism changes, each with the first body it is of."""
    first: dict[str, str] = {}
    for body in (FRAME, *problem.mechanism.links):
        for point in problem.bodies[body].points:
            first.setdefault(point, body)
    points = [*first]
    fastest = max(map(abs, motion.velocity.values()))
    rng.shuffle(points)
    for one in points:
        for two in points:
            bodies = first[one], first[two]
            if one == two or bodies[0] == bodies[1] or _in_a_guide(problem, one, two):
                continue
            apart = _of(motion, problem, two)[0] - _of(motion, problem, one)[0]
            speeds = [_of(motion, problem, end)[1] for end in (one, two)]
            rate = ((speeds[1] - speeds[0]) * apart.conjugate()).real / abs(apart)
            if abs(apart) > 0.05 and abs(rate) > _LEAST * max(*map(abs, speeds), 0.1 * fastest):
                return (one, bodies[0]), (two, bodies[1])
    return None


def _in_a_guide(problem: Problem, one: str, two: str) -> bool:
    """Return whether a slide of the mechanism already joins the links of the two points."""
    for slide in problem.slides.values():
        pair = [problem.bodies[link].points for link in (slide.slider, slide.host)]
        if any(one in a and two in b for a, b in (pair, pair[::-1])):
            return True
    return False


def _of(motion: Motion, problem: Problem, point: str) -> tuple[complex, complex]:
    """Return place and velocity of a point; the velocity of a fixed one is zero."""
    for link in problem.mechanism.links:
        if point in problem.bodies[link].points:
            return complex(motion.position[link, point]), complex(motion.velocity[link, point])
    return problem.bodies[FRAME].points[point], 0j


def _with_cylinder(
    text: str, pose: Pose, names: tuple[str, str], motion: Motion, rng: random.Random
) -> tuple[str, Pose]:
    """Add the cylinder and its rod as two links: on the line of the ends, or beside it."""
    one, two = names
    places = {point: z for (_, point), z in motion.position.items()}
    at, to = complex(places[one]), complex(places[two])
    turned = cmath.phase(to - at)
    text = re.sub(
        r"\[driver\]",
        f'[links.101]\npoints = ["{one}"]\n[links.102]\npoints = ["{two}"]\n'
        f'slides = {{ on = "101", through = "{one}" }}\n\n[driver]',
        text,
        count=1,
    )
    added = {"101": (at.real, at.imag, turned), "102": (to.real, to.imag, turned)}
    return text, {**pose, **added}


def _driven(problem: Problem, names: tuple[str, str], *, stands: bool) -> Problem:
    """Return a problem that the actuator drives, with the motion that it has."""
    drive: Drive = problem.drive
    if stands:
        drive = replace(drive, rate=0.0, acceleration=0.0)
    posed = OutputPositions(OutputPositionKind.LENGTH, "".join(names), (1.0,))
    return replace(problem, drive=replace(drive, posed=posed))
