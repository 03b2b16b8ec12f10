"""Mechanisms with two driving links: a five-bar, and random ones with their motion by Newton."""

from __future__ import annotations

import cmath
import math
import random
import re
import tomllib
from functools import cache
from itertools import count

from doors import ModelProblem as Problem, problem_loads as loads
from loaded import loaded_text
from newton import Motion, NotClosedError, solve as newton

from benchmarks.generator import Pose, random_problem

FIVE_BAR = """
[frame]
O = [0, 0]
D = [0.4, 0]
[links.1]
points = ["O", "A"]
OA = 0.12
[links.2]
points = ["A", "C"]
AC = 0.3
[links.3]
points = ["C", "B"]
CB = 0.32
[links.4]
points = ["D", "B"]
DB = 0.15
[[drivers]]
link = "1"
phi = 70
omega = 10
[[drivers]]
link = "4"
phi = 40
omega = -15
epsilon = 5
[assembly]
C = "left of AB"
"""
COUPLER_LOADS = """
[dynamics]
[dynamics.links.2]
mass = 2
centre = "C"
inertia = 0.01
[[loads]]
link = "3"
at = "C"
force = 50
angle = -30
"""


@cache
def two_driven(seed: int) -> tuple[Problem, Motion]:
    """Return a random mechanism whose fixed pivot a second crank or slider carries, with loads."""
    rng = random.Random(f"two drivers {seed}")
    for more in count(step=10**6):
        text, pose = random_problem(seed + more, triad=seed % 5 == 0)
        found = _with_second(text, pose, rng)
        if found is None:
            continue
        text, pose = found
        text = loaded_text(text, pose, random.Random(f"loads {seed}"))
        problem = loads(text, name=f"two-{seed}")
        try:
            return problem, newton(problem, problem.drive.positions[0], pose)
        except NotClosedError:
            continue
    raise AssertionError


def _with_second(text: str, pose: Pose, rng: random.Random) -> tuple[str, Pose] | None:
    """Return the file with a link on the frame in place of a fixed pivot, and its pose."""
    read = tomllib.loads(text)
    driver = read["driver"]
    frame = {point: at for point, at in read["frame"].items() if point != "guides"}
    pivots = [
        point
        for point in frame
        if sum(point in link["points"] for link in read["links"].values()) == 1
        and point not in read["links"][driver["link"]]["points"]
        and f'through = "{point}"' not in text
        and point not in str(read.get("assembly", {}))
    ]
    if not pivots:
        return None
    point = rng.choice(pivots)
    place = complex(*frame[point])
    text = re.sub(rf"^{point} = \[.*\]\n", "", text, count=1, flags=re.M)
    turn = rng.uniform(-180.0, 180.0)
    rates = f"{rng.uniform(-20, 20)!r}", f"{rng.choice((0.0, rng.uniform(-50, 50)))!r}"
    way = cmath.rect(1.0, math.radians(turn))
    if rng.random() < 0.6:
        length = rng.uniform(0.05, 0.3)
        base = place - length * way
        fixed = f"Z = [{base.real!r}, {base.imag!r}]\n"
        link = f'[links.200]\npoints = ["Z", "{point}"]\nZ{point} = {length!r}\n'
        second = f"phi = {turn!r}\nomega = {rates[0]}\nepsilon = {rates[1]}\n"
        own = (base.real, base.imag, math.radians(turn))
    else:
        s = rng.uniform(-0.3, 0.3)
        base = place - s * way
        fixed = f"guides.z-z = {{ through = [{base.real!r}, {base.imag!r}], angle = {turn!r} }}\n"
        link = f'[links.200]\npoints = ["{point}"]\nslides = {{ on = "z-z" }}\n'
        second = f"s = {s!r}\nv = {float(rates[0]) / 10!r}\na = {rates[1]}\n"
        own = (place.real, place.imag, math.radians(turn))
    text = text.replace("[frame]\n", f"[frame]\n{fixed}", 1)
    text = text.replace("[driver]\n", f"{link}\n[[drivers]]\n", 1)
    parts = text.split("[assembly]")
    parts[0] += f'[[drivers]]\nlink = "200"\n{second}\n'
    return "[assembly]".join(parts), {**pose, "200": own}
