"""Random mechanisms with loads, springs, dampers and torsion springs between their links."""

from __future__ import annotations

import random
import tomllib
from collections.abc import Iterator

from doors import FRAME, ModelProblem as Problem, problem_loads as loads
from loaded import loaded_text
from newton import Motion, solve as newton

from benchmarks.generator import Pose, random_problem

STRAIGHT = 3
"""Straight springs of a mechanism; the first one is held by the frame at coordinates."""


def sprung_problem(seed: int) -> tuple[Problem, Motion]:
    """Return a random mechanism with springs, and its motion by Newton's method."""
    text, pose = random_problem(seed)
    rng = random.Random(f"springs {seed}")
    bare = loaded_text(text, pose, rng)
    problem = loads(bare, name=f"bare-{seed}")
    motion = newton(problem, problem.drive.positions[0], pose)
    sprung = "\n".join([bare, *_straight(problem, motion, pose, rng), *_torsion(problem, rng)])
    assert tomllib.loads(sprung)
    return loads(sprung, name=f"sprung-{seed}"), motion


def _straight(problem: Problem, motion: Motion, pose: Pose, rng: random.Random) -> Iterator[str]:
    size = max(0.1, *(max(abs(x), abs(y)) for x, y, _ in pose.values()))
    links = list(problem.mechanism.links)
    ends = [(link, point) for link in links for point in problem.bodies[link].points]
    for number in range(STRAIGHT):
        link, point = rng.choice(ends)
        here = motion.position[link, point]
        if number == 0:
            away = complex(rng.uniform(-1, 1), rng.uniform(-1, 1)) * size
            other, there = FRAME, here + away + 0.2 * size
            told = f"[{there.real!r}, {there.imag!r}]"
        else:
            far = [
                (one, name) for one, name in ends
                if one != link and abs(motion.position[one, name] - here) > 0.05 * size
            ]  # fmt: skip
            if not far:
                continue
            other, name = rng.choice(far)
            told = f'"{name}"'
        both = [(f'"{link}"', f'"{point}"'), (f'"{other}"', told)]
        if rng.random() < 0.5:
            both.reverse()
        (one, first), (two, second) = both
        yield f"[[springs]]\nlinks = [{one}, {two}]\npoints = [{first}, {second}]"
        if number != 1:
            yield f"stiffness = {rng.uniform(50.0, 3000.0)!r}"
            yield f"length = {size * rng.uniform(0.0, 1.5)!r}"
        if number != 0:
            yield f"damping = {rng.uniform(1.0, 200.0)!r}"


def _torsion(problem: Problem, rng: random.Random) -> Iterator[str]:
    bare = {link for link in problem.mechanism.links if len(problem.bodies[link].points) < 2}
    slides = problem.slides
    axes = {link for link in bare if link in slides and slides[link].host not in bare}
    for joint in problem.mechanism.revolutes:
        links = [link for link in joint.links if link not in bare - axes]
        if len(links) < 2:
            continue
        one, two = rng.sample(links, 2)
        yield f'[[springs]]\nlinks = ["{one}", "{two}"]\njoint = "{joint.point}"'
        yield f"stiffness = {rng.uniform(1.0, 50.0)!r}\nangle = {rng.uniform(-180.0, 180.0)!r}"
        yield f"damping = {rng.uniform(0.0, 2.0)!r}"
