"""Printed values of trains compared with the exact values and the velocity diagrams (сверка)."""

from __future__ import annotations

from msgspec.structs import replace

from planmethod.construct.drafting import PROFILES
from planmethod.gears.answers import answer
from planmethod.gears.construction import construct, read
from planmethod.gears.model import GearProblem
from planmethod.gears.motion import solve_motion
from planmethod.gears.velocity_diagrams import draw
from planmethod.note.audit.audit import Audited
from planmethod.solved.selectors.steps import NoValue


def audited(problem: GearProblem, ruler: float) -> list[Audited]:
    """Compare every printed value with the exact one, and with that read from the diagrams.

    Parameters
    ----------
    problem : GearProblem
    ruler : float, mm

    Raises
    ------
    ProblemError
        The train cannot be, or its inputs do not fit.
    """
    asked = (*problem.train.ask, *(one.what for one in problem.published))
    motion = solve_motion(replace(problem, train=replace(problem.train, ask=asked)))
    picture, found = draw(motion), {}
    if picture is not None:
        drawn = construct(motion, picture)
        seen = read(drawn, replace(PROFILES["board"], ruler=ruler))
        found = {one.name: float(seen.read.value[one.read]) for one in drawn.quantities}
    told = []
    for one in problem.published:
        exact = answer(motion, one.what)
        why = NoValue.ZERO_DIVISOR if exact.reason == "zero" else None
        if exact.value is None and why is None:
            why = NoValue.NO_LINK
        told.append(Audited(one, exact.value, found.get(one.what), reason=why))
    return told
