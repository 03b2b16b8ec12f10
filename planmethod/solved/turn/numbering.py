"""Numbered positions of the cycle (нумерация положений): one decision for all outputs.

``[cycle]`` tells which positions there are and which one is 0. They stand for what the driver
leaves out, and outrank several that it lists; a single one stays what it is.
"""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace

from planmethod.errors import PlanMethodError, ProblemError
from planmethod.problem.cycle import report_start
from planmethod.problem.cycle_records import Zero
from planmethod.problem.fields import Faults
from planmethod.problem.model import Problem
from planmethod.solved.forces.loads import only_in_positions
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution
from planmethod.solved.turn.strokes import Strokes
from planmethod.solved.turn.turn import Turn, turn_of


def number(problem: Problem) -> Problem:
    """Return a problem with the positions that its ``[cycle]`` numbers.

    Raises
    ------
    PlanMethodError
        The driver tells no position, and the mechanism cannot be assembled or has no output; or
        the machine starts in another position than the cycle.
    """
    drive = problem.drive
    if problem.cycle is None or not drive.goes_round:
        return problem
    given = bool(np.isfinite(drive.positions).all())
    try:
        turn = Turn(Solution(problem))
        positions = tuple(turn.positions.tolist())
        _ = turn.strokes if problem.cycle.working is not None else None  # may be a fault
    except ProblemError:
        raise
    except PlanMethodError:  # said where the positions of the file are solved
        if not given:
            raise
        return problem
    machine = problem.machine
    if machine is not None:
        faults = Faults()
        if machine.start_deg is not None and isinstance(problem.cycle.zero, Zero):
            report_start(faults, positions[0] % 360.0, machine.start_deg)
        if faults:
            raise ProblemError(problem.name, faults.found)
        machine = replace(machine, start_deg=positions[0])
    if not given or len(drive.positions) > 1:
        judged = drive.judged or drive.positions
        drive = replace(drive, positions=positions, judged=judged)
    return replace(problem, drive=drive, machine=machine, numbered=positions)


def numbered_positions(solution: Solution) -> Reals:
    """Return the positions of the cycle in the order of their numbers, ndarray of shape (n,).

    Degrees of the crank, over both turns of a cycle of 720 degrees. Without ``[cycle]`` those of
    ``[machine]``, else a dozen from the extreme position on. Loads that the file gives for its
    positions only keep to these.

    Raises
    ------
    ProblemError
        The driver slides, or nothing can be the output.
    """
    problem = solution.problem
    if problem.numbered:
        return np.array(problem.numbered)
    if problem.dynamics is not None and only_in_positions(problem.dynamics):
        return np.array(problem.drive.positions)
    return turn_of(solution).positions


def strokes_of(solution: Solution) -> Strokes | None:
    """Return the working and the idle stroke; None where the output has no two strokes."""
    return turn_of(solution).strokes
