"""A small kulisa whose every component is known by hand."""

from __future__ import annotations

from math import sqrt

from doors import ModelProblem as Problem, problem_loads as loads

# A kulisa at 45 degrees: B = (0.1, 0), C = (0, -0.1), CB = 0.1·√2, and every component by hand.
KULISA = """
title = "Кулиса"
source = "Проверочный пример"
[frame]
A = [0, 0]
C = [0, -0.1]
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B"]
slides = { on = "3", along = "CD" }
[links.3]
points = ["C", "D"]
CD = 0.3
[driver]
link = "1"
phi = 0
omega = 10
epsilon = 20
[assembly]
D = "above C"
"""
SCALES = """
[scales]
mu_l = 0.002
mu_v = 0.02
mu_a = 0.1
"""
R = sqrt(0.5)


def problem_of(*entries: str, scales: str = SCALES, **phi: str) -> Problem:
    text = KULISA.replace("phi = 0", f"phi = {phi.get('phi', '0')}") + scales
    return loads("\n".join([text, "[published]", *entries]), name="kulisa")
