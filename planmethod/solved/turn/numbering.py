"""Numbered positions of the cycle (нумерация положений): one decision for all outputs.

``[cycle]`` determines the positions and which one is 0. They are used if the driver lists none, and
override a list of several; a single one stays as it is.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from msgspec.structs import replace

from planmethod.errors import LayoutError, PlanMethodError, ProblemError
from planmethod.languages import translate
from planmethod.problem.cycle import check_start
from planmethod.problem.cycle_records import CycleTask, Zero
from planmethod.problem.file_node import Faults, FileNode
from planmethod.problem.load_records import TurningSense
from planmethod.problem.model import SAME_DEG, Problem
from planmethod.solved.forces.loads import only_in_positions
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import TURN, CrankCycle, crank_cycle_of
from planmethod.solved.turn.strokes import Strokes

MIN_POSITIONS = 6
"""Fewest positions of a turn that its diagrams can be drawn through."""


def number(problem: Problem) -> Problem:
    """Return a problem with the positions that its ``[cycle]`` numbers.

    Raises
    ------
    PlanMethodError
        The driver gives no position, and the mechanism cannot be assembled or has no output; or the
        machine starts in another position than the cycle.
    """
    drive = problem.drive
    if problem.cycle is None or not drive.goes_round:
        return problem
    given = bool(np.isfinite(drive.positions).all())
    try:
        turn = CrankCycle(Solution(problem))
        positions = tuple(turn.positions.tolist())
        _ = turn.strokes if problem.cycle.working is not None else None  # may be a fault
    except ProblemError:
        raise
    except PlanMethodError:  # reported where the positions of the file are solved
        if not given:
            raise
        return problem
    machine = problem.machine
    if machine is not None:
        file = FileNode(Faults(), problem.source_table)
        if machine.start_deg is not None and isinstance(problem.cycle.zero, Zero):
            check_start(file["machine"], positions[0] % 360.0, machine.start_deg)
        if file.faults:
            raise ProblemError(problem.name, file.faults.listed)
        machine = replace(machine, start_deg=positions[0])
    if not given or len(drive.positions) > 1:
        judged = drive.assembly_positions or drive.positions
        drive = replace(drive, positions=positions, assembly_positions=judged)
    return replace(problem, drive=drive, machine=machine, numbered=positions)


def counting(problem: Problem, positions: Sequence[float]) -> Problem:
    """Return a problem whose cycle numbers these positions, so that a number names one of them.

    Numbers that the file gives, by ``[cycle]`` or ``[machine]``, are kept; if it gives none,
    equally spaced positions over a turn, or over the turns after which the motion repeats, are
    those of the cycle, in their order and starting from the first.

    Parameters
    ----------
    positions : sequence of float
        Degrees of the crank, two or more.

    Raises
    ------
    LayoutError
        The cycle has other positions.
    """
    count = len(positions)
    free = problem.cycle is None and problem.machine is None
    turns = Solution(problem).turns
    step = TURN * turns / count if positions[1] > positions[0] else -TURN * turns / count
    even = [positions[0] + step * k for k in range(count)]
    least = MIN_POSITIONS * turns
    if free and count >= least and not count % turns and _is_same(positions, even, turns):
        sense = TurningSense.CCW if step > 0 else TurningSense.CW
        own = CycleTask(zero=float(positions[0]), direction=sense, count=count // turns)
        counted = number(replace(problem, cycle=own))
    else:
        counted = problem
    told = numbered_positions(Solution(counted)).tolist()
    if _is_same(positions, told, turns):
        return counted
    hint = (
        translate(
            "Name one position, or {0:|an even turn|even turns} of {1} and more: "
            "--phi {2:g}:{3:g}:30.",
            turns,
            MIN_POSITIONS,
            positions[0],
            positions[0] + TURN * turns,
        )
        if free
        else translate("Name one position, leave --phi out, or give zero and count of [cycle].")
    )
    raise LayoutError(
        "{}: tables and diagrams of the cycle number {} positions from {:.5g}° on, but {} "
        "others from {:.5g}° on are requested: a number would refer to two positions. {}",
        problem.name,
        len(told),
        told[0] % (TURN * turns),
        count,
        positions[0],
        hint,
    )


def _is_same(some: Sequence[float], reference: Sequence[float], turns: int) -> bool:
    """Return whether positions over a number of turns are the same, in the same order."""
    if len(some) != len(reference):
        return False
    whole, apart = TURN * turns, np.subtract(some, reference)
    return bool((np.abs((apart + whole / 2) % whole - whole / 2) <= SAME_DEG).all())


def numbered_positions(solution: Solution) -> Reals:
    """Return the positions of the cycle in the order of their numbers, ndarray of shape (n,).

    Degrees of the crank, over both turns of a cycle of 720 degrees. Without ``[cycle]`` those of
    ``[machine]``, else a dozen from the extreme position on. Loads that the file gives for its
    positions only keep to these.

    Raises
    ------
    ProblemError
        The driver slides, or the mechanism has no output.
    """
    problem = solution.problem
    if problem.numbered:
        return np.array(problem.numbered)
    if problem.dynamics is not None and only_in_positions(problem.dynamics):
        return np.array(problem.drive.positions)
    return crank_cycle_of(solution).positions


def strokes_of(solution: Solution) -> Strokes | None:
    """Return the working and the idle stroke; None where the output has no two strokes."""
    return crank_cycle_of(solution).strokes
