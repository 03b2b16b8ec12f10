"""Texts of a crank mechanism, of one with a driving slider and of a triad, for tests to add to."""

from __future__ import annotations

import pytest
from doors import ProblemError, ProblemProblem as Problem, problem_loads as loads

CRANK = """
[frame]
A = [0, 0]
guides.x-x = { through = "A", angle = 0 }
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "C", "S2"]
BC = 0.3
S2 = { on = "BC", at = 0.1 }
[links.3]
points = ["C"]
slides = { on = "x-x" }
[driver]
link = "1"
phi = { from = 0, count = 4 }
omega = 10
[assembly]
C = "right of B"
"""

SLIDER = """
[frame]
A = [0, 0]
guides.x-x = { through = "A", angle = 0 }
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "C"]
BC = 0.3
[links.3]
points = ["C"]
slides = { on = "x-x" }
[driver]
link = "3"
s = [0.3, 0.35]
v = 1
[assembly]
B = "above C"
"""

TRIAD = """
title = "III"
[frame]
O = [0.0, 0.0]
E = [0.30, 0.02]
F = [0.16, 0.30]
[links.1]
points = ["O", "A"]
OA = 0.06
[links.2]
points = ["A", "B"]
AB = 0.20
[links.3]
points = ["B", "C", "D"]
BC = 0.16
BD = 0.14
CD = 0.13
D.side = "left of BC"
[links.4]
points = ["E", "C"]
EC = 0.15
[links.5]
points = ["F", "D"]
FD = 0.14
[driver]
link = "1"
phi = 50
omega = 10
"""
"""A base link on three legs, which can be assembled in four ways."""


LOADED = """
[dynamics.links.2]
mass = 40
centre = "S2"
[[loads]]
name = "P"
link = "3"
at = "C"
force = { over = "phi", values = [[0, 0], [90, 730]], interpolation = "linear" }
angle = 180
[[loads]]
name = "F_{2}"
link = "2"
at = "S2"
force = 10
angle = 0
[variants]
"""


def read(text: str, base: str = CRANK, variant: str | None = None) -> Problem:
    return loads(base + text, name="v", variant=variant)


def messages(text: str, base: str = CRANK) -> list[str]:
    with pytest.raises(ProblemError) as caught:
        read(text, base)
    return [str(fault) for fault in caught.value.faults]


REVERSED = """
frame = { O = [0, 0], C = [0.11, -0.03] }
links.1 = { points = ["O", "A"], OA = 0.04 }
links.2 = { points = ["A", "B", "M"], AB = 0.12, AM = 0.09, BM = 0.06, M.side = "left of AB" }
links.3 = { points = ["C", "B"], CB = 0.09 }
driver = { link = "1", phi = 125, omega = -15, epsilon = 40 }
assembly.B = "left of AC"
"""  # a crank-rocker with a coupler point; ε_q3 is negative
