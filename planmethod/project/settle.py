"""Decisions of a project (решения проекта), all made once.

Positions are those of the cycle, scales those of sheet 1 at these positions; both are written into
the problem, so that every output has them without knowing of projects.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import pi
from pathlib import Path
from typing import assert_never

import numpy as np
from msgspec.structs import replace

from planmethod.arguments import of_type
from planmethod.cams.model import CamProblem
from planmethod.errors import Fault, ProblemError
from planmethod.kinds import KINDS
from planmethod.languages import LANGUAGES, translate
from planmethod.problem.cycle_records import CycleTask, ProjectTask
from planmethod.problem.load_records import TurningSense
from planmethod.problem.model import SAME_DEG, Problem
from planmethod.problem.source import parse, read_source
from planmethod.project.decided import (
    calculated_position,
    force_scale,
)
from planmethod.project.first import first_scales
from planmethod.project.model import PartName, Project, ProjectPart
from planmethod.project.train import in_mesh
from planmethod.render.frame.titleblock import merged
from planmethod.solved.forces.loads import only_in_positions
from planmethod.solved.scaling import MAX_DRAWN
from planmethod.solved.selfcheck import verify
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import TURN
from planmethod.solved.turn.numbering import number, strokes_of

MAX_COUNT = 72
"""Most positions of the construction of a flywheel."""


def settle(problem: Problem, path: Path | None = None) -> Project:
    """Return all decisions of a project.

    Parameters
    ----------
    problem : Problem
        As read, with the sheet options of the command line.
    path : Path, optional
        Its file, from which `[gears]` and the other parts are read. Default: no such parts.

    Raises
    ------
    ProblemError
        ``[project]`` names a missing position, or a part is faulty.
    StructureError, AssemblyError, LayoutError
        As of a sheet.

    Examples
    --------
    >>> import planmethod
    >>> decided = settle(planmethod.load("problems/press/press.toml"))
    >>> decided.scales.mu_l, decided.scales.mu_v
    (0.004, 0.02)
    >>> [part.name.value for part in decided.parts]
    ['kinematics', 'forces']
    """
    of_type("problem", problem, Problem, "planmethod.load()")
    path = None if path is None else Path(of_type("path", path, str | Path))
    if problem.drive.cam_drive is not None:
        text = "the driving link is moved by a cam's follower, a course project is that of a crank"
        hint = "Draw it with planmethod sheet; its cam is a project's with a crank in [driver]."
        raise ProblemError(problem.name, [Fault("driver.cam", text, hint)])
    if problem.drive.actuator is not None:
        key = "".join(problem.drive.actuator)
        text = "an actuator moves the driving link, a course project is that of a crank"
        hint = "Draw it with planmethod sheet, and write it up with planmethod note."
        raise ProblemError(problem.name, [Fault(f"driver.{key}", text, hint)])
    asked = problem.drive.positions
    problem = in_positions(problem)
    verify(Solution(problem))
    scales = replace(problem.scales, decided=True)
    if None in (scales.mu_l, scales.mu_v, scales.mu_a):
        scales = first_scales(problem)
    problem = replace(problem, scales=scales)
    # What is clear is a matter of millimetres on the paper.
    calculated = _calculated(problem, Solution(problem), asked)
    task = replace(problem.project or ProjectTask(), calculated=calculated)
    problem = replace(problem, calculated=calculated, project=task)
    if problem.dynamics is not None:
        loaded = Solution(problem, positions=[problem.drive.positions[calculated]])
        scales = replace(scales, mu_F=force_scale(loaded))
        problem = replace(problem, scales=scales)
    return Project(
        problem=problem,
        positions=problem.drive.positions,
        calculated=calculated,
        strokes=None if problem.cycle is None else strokes_of(Solution(problem)),
        scales=scales,
        frame=problem.mechanism.frame,
        language=problem.sheet.lang or LANGUAGES[0],
        paper=problem.sheet.paper,
        parts=in_mesh(tuple(_parts(problem, path))),
    )


def with_decisions(problem: Problem) -> Problem:
    """Return a problem with the decisions of its project, or unchanged without ``[project]``."""
    if problem.project is None or problem.calculated is not None:
        return problem
    return settle(problem).problem


# Positions ---------------------------------------------------------------------------------------


def in_positions(problem: Problem) -> Problem:
    """Return a problem whose positions, cycle and flywheel have the same numbering."""
    if problem.drive.is_crank and problem.cycle is None:
        cycle = _default_cycle(problem)
        problem = problem if cycle is None else number(replace(problem, cycle=cycle))
    positions, drive, machine = problem.numbered, problem.drive, problem.machine
    if not positions:
        return problem
    if len(positions) > MAX_DRAWN:
        text = translate(
            "{} positions, a project is drawn of at most {}", len(positions), MAX_DRAWN
        )
        raise ProblemError(problem.name, [Fault("cycle.count", text, "Request fewer: count = 12.")])
    if machine is not None and len(positions) <= MAX_COUNT:
        machine = replace(machine, start_deg=positions[0], count=len(positions))
    judged = drive.assembly_positions or drive.positions  # the way in which it is assembled stays
    drive = replace(drive, positions=positions, assembly_positions=judged, posed=None)
    return replace(problem, drive=drive, machine=machine)


def _default_cycle(problem: Problem) -> CycleTask | None:
    """Return the cycle of a file without one; None where its positions suffice.

    It has the positions of the file where these go round; else a machine has a cycle, from where
    it begins.
    """
    positions, machine = problem.drive.positions, problem.machine
    if problem.dynamics is not None and only_in_positions(problem.dynamics):
        return None
    if len(positions) > 2:
        for way, sense in ((TURN, TurningSense.CCW), (-TURN, TurningSense.CW)):
            if np.ptp(np.diff([*positions, positions[0] + way])) < SAME_DEG:
                return CycleTask(zero=positions[0], count=len(positions), direction=sense)
        return None
    if machine is None:
        return None
    count = round(machine.count * TURN / machine.cycle_deg)
    return (
        CycleTask(count=count)
        if machine.start_deg is None
        else CycleTask(zero=machine.start_deg, count=count)
    )


def _calculated(problem: Problem, solution: Solution, requested: tuple[float, ...]) -> int:
    """Return the number of the calculated position: requested, by phi, or the clearest."""
    count, task = len(solution.positions), problem.project or ProjectTask()
    if task.calculated is not None:
        if task.calculated >= count:
            raise ProblemError(
                problem.name,
                [
                    Fault(
                        "project.calculated",
                        translate("position {} does not exist", task.calculated),
                        translate("Of {} positions the last is {}.", count, count - 1),
                    )
                ],
            )
        return task.calculated
    if len(requested) == 1:
        apart = problem.drive.coordinate.distance
        off = [apart(p, requested[0]) for p in problem.drive.positions]
        if count == 1 or min(off) < SAME_DEG:
            return int(np.argmin(off))
    return calculated_position(solution)


# Parts -------------------------------------------------------------------------------------------


def _parts(problem: Problem, path: Path | None) -> Iterator[ProjectPart]:
    """Yield the requested parts that the file has.

    Raises
    ------
    ProblemError
        A requested part is missing; without a path parts in other files are unknown.
    """
    task = problem.project or ProjectTask()
    there = {name: _has(problem, task, name) for name in PartName}
    asked = [PartName(name) for name in task.parts] or [*PartName]
    missing = [name.value for name in asked if not there[name]] if task.parts else []
    if missing and path is not None:
        text = translate("the file has no part {!r}", missing[0])
        hint = translate("It has {}.", ", ".join(name.value for name in PartName if there[name]))
        raise ProblemError(problem.name, [Fault("project.parts", text, hint)])
    for name in PartName:
        if name is PartName.NOTE or name not in asked or not there[name]:
            continue
        if name not in (PartName.GEARS, PartName.MESHING, PartName.CAM):
            yield ProjectPart(name, problem)
        elif path is not None:
            yield _of_kind(problem, name, path, str(getattr(task, name.value)))


def _has(problem: Problem, task: ProjectTask, name: PartName) -> bool:
    """Return whether the file has a part, or names the file of one."""
    match name:
        case PartName.KINEMATICS | PartName.NOTE:
            return True
        case PartName.FORCES:
            return problem.dynamics is not None
        case PartName.FLYWHEEL:
            return problem.dynamics is not None and problem.machine is not None
        case PartName.BALANCING:
            return problem.balancing is not None
        case PartName.GEARS | PartName.MESHING | PartName.CAM:
            return bool(getattr(task, name.value)) or name.value in problem.tables
        case _:
            assert_never(name)


def _of_kind(problem: Problem, name: PartName, path: Path, file_name: str) -> ProjectPart:
    """Return the part of another kind of problem, of this file or of the file that it names."""
    kind = next(kind for kind in KINDS if kind.table == name.value)
    file, variant = (path.with_name(file_name), None) if file_name else (path, problem.variant)
    if file_name:
        _check_other_file(problem, kind.table, file)
    found = kind.load(file, variant)
    turns = problem.drive.pivot is not None and problem.drive.rate
    if isinstance(found, CamProblem) and found.n is None and turns:
        found = replace(found, n=turns * 30 / pi)  # on the shaft of the crank
    found = replace(found, sheet=problem.sheet.over(found.sheet))
    stamp = dict(problem.title_block)
    if file_name:
        stamp = merged(stamp, found.title_block)
    stamp.pop("title", None)
    title = found.title if file_name else ""
    return ProjectPart(name, replace(found, stamp=stamp, stamp_in={}, title=title), kind)


def _check_other_file(problem: Problem, table: str, file: Path) -> None:
    """Reject a file that is missing or has a problem of another kind."""
    if not file.is_file():
        text = translate("{} is not in the folder of this file", file.name)
        hint = translate("Write its name, or put the table [{}] into this file.", table)
    elif table not in parse(read_source(file), name=str(file)):
        text = translate("{} has no table [{}]", file.name, table)
        hint = "Name a file that has it."
    else:
        return
    raise ProblemError(problem.name, [Fault(f"project.{table}", text, hint)])
