"""The motion that a cam's follower gives to the driving link of a linkage (привод от кулачка)."""

from __future__ import annotations

from math import degrees, pi, radians

import numpy as np

from planmethod.cams.model import ArmSense, CamProblem
from planmethod.cams.reader import read_cam
from planmethod.problem import fields
from planmethod.problem.fields import Faults
from planmethod.problem.model import Lifted


def followed(faults: Faults, table: object, cam: object) -> Lifted | None:
    """Return how the follower moves the driving link in an angle of the cam.

    Parameters
    ----------
    table : object
        ``[cam]``.
    cam : object
        ``cam`` of ``[driver]``: degrees from the start of the rise in the sense of the cam.

    Returns
    -------
    Lifted or None
        None where the cam or the angle is faulty; ``faults`` say why.
    """
    before = len(faults)
    angle = fields.read_angle(faults, "driver.cam", cam)
    told = read_cam(faults, table)
    if told is None or angle is None or len(faults) != before:
        return None
    problem = CamProblem(name="", **told)
    if not problem.n:
        faults.add("cam.n", "missing", "Give the speed of the cam that drives, rev/min: n = 120.")
        return None
    return motion_at(problem, angle)


def motion_at(problem: CamProblem, angle: float) -> Lifted:
    """Return place, rate and acceleration of the follower from its lowest place.

    ``s``, ``v``, ``a`` of a translating follower grow with the rise; an oscillating one turns in
    the rise by the sense of the cam, or against it.
    """
    omega = abs(problem.n or 0.0) * pi / 30
    s, v, a = (float(value) for value in problem.at(np.array([radians(angle)]))[:, 0])
    motion = (s, v * omega, a * omega**2)
    if problem.oscillates:
        way = problem.mirror * (1 if problem.sense is ArmSense.SAME else -1)
        turn, rate, gain = (way * value / problem.arm for value in motion)
        motion = (degrees(turn), rate, gain)
    return Lifted(angle, problem.oscillates, problem.n or 0.0, *motion)
