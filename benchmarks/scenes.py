"""Mechanisms that the benchmark runs: a four-bar, a slotted-link six-bar, chains of dyads."""

from __future__ import annotations

from planmethod.problem import loads, template
from planmethod.problem.model import Problem

FOURBAR = """
title = "Four-bar"
[frame]
A = [0, 0]
D = [0.4, 0]
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "C"]
BC = 0.35
[links.3]
points = ["D", "C"]
DC = 0.3
[driver]
link = "1"
phi = 20
omega = 10
[assembly]
C = "left of BD"
"""
"""The four-bar of the peers (see `benchmarks.peers`)."""

FOURBAR_ROWS = (
    "B", "v_B", "a_B", "C", "v_C", "a_C",
    "u_2", "omega_2", "epsilon_2", "u_3", "omega_3", "epsilon_3",
)  # fmt: skip
"""Results that make the same 20 rows as the peers': all moving points and links."""


def fourbar() -> Problem:
    """Return the four-bar that the peers solve."""
    return loads(FOURBAR, name="four-bar")


def slotted() -> Problem:
    """Return a mechanism with a slotted link and a Coriolis acceleration, six members."""
    return loads(template("slotted-link"), name="slotted-link")


def chain(dyads: int) -> Problem:
    """Return a crank and a chain of RRR dyads: 1 + 2·dyads moving links.

    Each rocker drives the next through a coupler of the length of the frame between them, so all
    of them swing equally and the chain assembles at every angle of the crank.
    """
    lines = ['title = "Chain"', "[frame]", "A = [0, 0]"]
    lines += [f"D{k} = [{0.4 * k:.1f}, 0]" for k in range(1, dyads + 1)]
    lines += ["[links.1]", 'points = ["A", "B"]', "AB = 0.06"]
    rules = []
    for k in range(1, dyads + 1):
        before = "B" if k == 1 else f"C{k - 1}"
        length = 0.47 if k == 1 else 0.4
        lines += [f"[links.{2 * k}]", f'points = ["{before}", "C{k}"]']
        lines += [f"{before}C{k} = {length}"]
        lines += [f"[links.{2 * k + 1}]", f'points = ["D{k}", "C{k}"]', f"D{k}C{k} = 0.3"]
        rules.append(f'C{k} = "above D{k}"')
    lines += ["[driver]", 'link = "1"', "phi = 40", "omega = 10", "[assembly]", *rules]
    return loads("\n".join(lines) + "\n", name=f"chain-{dyads}")


LOADS = """
[dynamics.links.1]
mass = 2
centre = "A"
inertia = 0.01
[dynamics.links.3]
mass = 5
centre = "S3"
inertia = 0.1
[dynamics.links.5]
mass = 3
[[loads]]
link = "5"
at = "E"
force = 200
angle = 0
[[loads]]
link = "3"
couple = 15
"""
"""Masses and loads of the six-link mechanism whose forces are timed."""


def _many_loads(count: int) -> str:
    return template("six-link") + "".join(
        f'[[loads]]\nlink = "5"\nat = "E"\nforce = {50 + k}\nangle = {6 * k}\n'
        for k in range(count)
    )


MANY_LOADS = _many_loads(60)
"""A six-link mechanism with sixty loads on a point."""


def with_loads(count: int) -> Problem:
    """Return a six-link mechanism with ``count`` loads on a point."""
    return loads(_many_loads(count), name=f"six-link, {count} loads")


def train(wheels: int) -> str:
    """Return the file of a train of wheels in a row, each in mesh with the next."""
    teeth = ", ".join(f"{k} = {20 + k}" for k in range(1, wheels + 1))
    meshes = ", ".join(f'{{ of = [{k}, {k + 1}], kind = "external" }}' for k in range(1, wheels))
    return (
        f'title = "Train"\n[gears]\nwheels = {{ {teeth} }}\nmeshes = [{meshes}]\n'
        f'n = {{ 1 = 330 }}\nask = ["U_1_{wheels}", "n_{wheels}"]\n'
    )


def loaded() -> Problem:
    """Return a six-link mechanism with masses and loads: slotted link, rod and slider."""
    return loads(template("six-link") + LOADS, name="six-link with loads")
