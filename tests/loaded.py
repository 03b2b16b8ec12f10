"""Random mechanisms with random loads on every link: weights, inertia, two forces, a couple."""

from __future__ import annotations

import random
import re
import tomllib

from doors import ModelProblem as Problem, problem_loads as loads
from msgspec.structs import replace

from benchmarks.generator import Pose, random_problem


def with_resultant(problem: Problem) -> Problem:
    """Return a problem that selects the single resultant of the inertia forces."""
    assert problem.dynamics is not None
    return replace(problem, dynamics=replace(problem.dynamics, resultant=True))


def loaded_problem(seed: int, *, triad: bool = False) -> tuple[Problem, Pose]:
    """Return a random mechanism with loads, and its pose."""
    text, pose = random_problem(seed, triad=triad)
    return loads(
        loaded_text(text, pose, random.Random(f"loads {seed}")), name=f"loaded-{seed}"
    ), pose


def loaded_text(text: str, pose: Pose, rng: random.Random) -> str:
    """Return a problem file with loads on every link, at old points and at new ones."""
    size = max(0.1, *(max(abs(x), abs(y)) for x, y, _ in pose.values()))
    read = tomllib.loads(text)
    tables, fixed = read["links"], set(read["frame"])
    gravity = rng.choice(("9.81", "9.81", "false", repr(rng.uniform(0.5, 20.0))))
    parts = [f"[dynamics]\ngravity = {gravity}\n"]
    forces = []
    for link, table in tables.items():
        points: list[str] = list(table["points"])
        host = tables.get(table.get("slides", {}).get("on"), {"slides": ()})
        # A new point of a block on a bare block would need a rule for its side of the line.
        untold = _is_bare(host) and not {*points} & {*read.get("assembly", {})}
        new = [] if _is_bare(table) or untold else rng.sample(("S", "P", "Q"), rng.randint(0, 3))
        for letter in new:
            name = f"{letter}{link}"
            text = _with_point(text, link, name, points[0], size, rng)
            points.append(name)
        centre = f"S{link}" if "S" in new else rng.choice(points)
        mass = rng.uniform(0.1, 5.0)
        parts.append(f'[dynamics.links.{link}]\nmass = {mass!r}\ncentre = "{centre}"')
        parts.append(f"inertia = {mass * size**2 * rng.uniform(0.1, 1.0)!r}\n")
        for _ in range(2):
            at = rng.choice(points)
            way = f"angle = {rng.choice((0.0, -90.0, rng.uniform(-180.0, 180.0)))!r}"
            if at not in fixed and rng.random() < 0.3:
                way = 'against = "velocity"'
            force = f"force = {rng.uniform(-200.0, 200.0)!r}"
            forces.append(f'[[loads]]\nlink = "{link}"\nat = "{at}"\n{force}\n{way}\n')
        way = '\nagainst = "rotation"' if rng.random() < 0.3 else ""
        couple = f"couple = {size * rng.uniform(-50.0, 50.0)!r}"
        forces.append(f'[[loads]]\nlink = "{link}"\n{couple}{way}\n')
    return "\n".join([text, *parts, *forces])


def _is_bare(table: dict[str, object]) -> bool:
    """Return whether a link's only axis is the line that it carries: it can have no other point."""
    lengths = [key for key, value in table.items() if isinstance(value, float)]
    return "slides" not in table and not lengths


def _with_point(
    text: str, link: str, name: str, start: str, size: float, rng: random.Random
) -> str:
    at, across = (size * rng.uniform(-0.7, 0.7) for _ in range(2))
    place = f'{name} = {{ from = "{start}", at = {at!r}, across = {across!r} }}'
    listed = re.compile(rf"(\[links\.{link}\]\npoints = \[[^\]]*)\]\n(slides = .*\n)?")
    return listed.sub(rf'\1, "{name}"]\n\2{place}\n', text, count=1)
