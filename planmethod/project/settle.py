"""Decisions of a project (решения проекта), all made once, and their record."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property, partial
from math import pi
from pathlib import Path
from typing import Any, assert_never

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.arguments import of_type
from planmethod.cams.model import CamProblem
from planmethod.construct.scale import choose_scale, series_near
from planmethod.errors import Fault, LayoutError, ProblemError
from planmethod.gears.involute.geometry import MeshingProblem
from planmethod.gears.model import HALF_MODULES, DiagramSettings, GearProblem, MeshKind, Train
from planmethod.gears.motion import TrainMotion, solve_motion
from planmethod.kind import ProblemKind
from planmethod.languages import LANGUAGES, translate
from planmethod.mechanism.model import FRAME
from planmethod.note.document import plain_text
from planmethod.paper import Format
from planmethod.problem.machine_records import CycleTask, ProjectTask
from planmethod.problem.model import MOTOR_DRIVES, SAME_DEG, Problem, Scales
from planmethod.problem.records import KindProblem, TurningSense, largest_size
from planmethod.problem.source import parse, read_source
from planmethod.project.parts import PART_KINDS, PartName
from planmethod.render.frame import merged
from planmethod.render.ink.drawing import Drawing
from planmethod.render.sheets.composition import composition
from planmethod.render.sheets.kinematics import kinematics_sheets, sheet_scales
from planmethod.render.sheets.model import Composition
from planmethod.render.sheets.views import clearest_position, is_clear
from planmethod.solved.forces.laws import only_in_positions
from planmethod.solved.forces.loads import external
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.legibility import Box
from planmethod.solved.reading import Flags
from planmethod.solved.scaling import MAX_DRAWN
from planmethod.solved.selfcheck import verify
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import TURN
from planmethod.solved.turn.extremes import number_positions, strokes_of
from planmethod.solved.turn.output import Strokes


class ProjectPart(Struct, frozen=True):
    """A part of a project that the file has (часть проекта).

    Attributes
    ----------
    name : PartName
    problem : KindProblem
        Its subject: the linkage with its decisions, the train, the meshing, the cam.
    scales : str
        Where the file has its scales.
    """

    name: PartName
    problem: KindProblem
    scales: str = ProblemKind.scales


class SheetEntry(Struct, frozen=True):
    """A sheet in the list of the note (запись перечня листов).

    Attributes
    ----------
    part : PartName
    number : int
        In the set of all sheets.
    title : str
        As in the title block.
    paper : Format
    """

    part: PartName
    number: int
    title: str
    paper: Format


class Homework(Struct, frozen=True):
    """A problem without a linkage, of which a note is written (домашнее задание).

    Attributes
    ----------
    problem : KindProblem
    kind : ProblemKind
    language : str
    """

    problem: KindProblem
    kind: ProblemKind[Any]
    language: str

    @property
    def parts(self) -> tuple[ProjectPart, ...]:
        """The part of a project that it would be; none of a moving point."""
        return tuple(
            ProjectPart(name, self.problem, kind.scales)
            for name, kind in PART_KINDS.items()
            if kind.table == self.kind.table
        )


class Project(Struct, frozen=True, dict=True):
    """Decisions of a project (решения курсового проекта): every output uses them.

    Attributes
    ----------
    problem : Problem
        The linkage with the decisions written in: positions in `drive`, scales in `scales`, the
        cycle that they are positions of, language and paper in `sheet`.
    positions : tuple of float
        Driver positions by their numbers, from 0: degrees, or m of a slider.
    calculated : int
        Number of the calculated position (расчётное положение): bold, loaded, described in full.
    strokes : Strokes or None
        Phases of the strokes; None where the output has none.
    scales : Scales
        One scale for each kind of plan, unit per mm; ``mu_F`` is None without forces.
    frame : str
        Number of the frame (номер стойки).
    language : str
    paper : str or None
        Requested format.
    parts : tuple of ProjectPart
        Those that the file has, in the order of `PartName`; the note is none of them.
    """

    problem: Problem
    positions: tuple[float, ...]
    calculated: int
    strokes: Strokes | None
    scales: Scales
    frame: str
    language: str
    paper: str | None
    parts: tuple[ProjectPart, ...]

    def part(self, name: PartName) -> ProjectPart | None:
        """Return a part; None if the file does not have it."""
        return next((part for part in self.parts if part.name is name), None)

    @property
    def places(self) -> tuple[float, ...]:
        """Driver positions as sheets write them: an angle of a full crank within its turn."""
        if not self.problem.goes_round:
            return self.positions
        return tuple(round(position % 360.0, 9) % 360.0 for position in self.positions)

    @cached_property
    def solution(self) -> Solution:
        """The linkage in all positions, at the scales of the project."""
        return Solution(self.problem)

    @cached_property
    def loaded(self) -> Solution:
        """The linkage in the calculated position alone, at the same scales."""
        return self.solution.in_position(self.calculated)


SPEED_TOLERANCE = 5e-3
"""Relative difference from the crank's speed within which a link of the train turns with it."""

RPM = 30.0 / pi
"""Revolutions per minute of 1 rad/s."""


def meshed(train: Train, pair: MeshingProblem) -> tuple[str, str] | None:
    """Return the wheels of a train that a meshing is of, its wheel 1 first (колёса зацепления).

    They are the only ones that mesh so and have its numbers of teeth; else None.
    """
    kind = MeshKind.INTERNAL if pair.cutter else MeshKind.EXTERNAL
    ends = [(mesh.first, mesh.second) for mesh in train.meshes if mesh.kind is kind]
    ways = [[e for e in (end, end[::-1]) if [train.wheels[x].size for x in e] == [*pair.z]]
            for end in ends]  # fmt: skip
    found = [way[0] for way in ways if way]
    return found[0] if len(found) == 1 else None


def in_mesh(parts: Sequence[ProjectPart]) -> tuple[ProjectPart, ...]:
    """Return the parts of a project, its train with the decisions of the meshing.

    Wheels that mesh there are cut with its shifts and have its module, which is that of the train
    where the train has none; the scale of the scheme grows with it then.

    Raises
    ------
    ProblemError
        The train gives the row of these wheels, or one of them, another module.
    """
    pair = next((x.problem for x in parts if isinstance(x.problem, MeshingProblem)), None)
    return tuple(
        replace(part, problem=_cut(part.problem, pair))
        if isinstance(part.problem, GearProblem) and pair is not None
        else part
        for part in parts
    )


def _cut(problem: GearProblem, pair: MeshingProblem) -> GearProblem:
    train = problem.train
    ends = meshed(train, pair)
    if ends is None:
        return problem
    shifts = dict(zip(ends, pair.x, strict=True))
    wheels = {
        label: wheel if wheel.shift or label not in shifts
        else replace(wheel, shift=Fraction(repr(shifts[label])))
        for label, wheel in train.wheels.items()
    }  # fmt: skip
    module = Fraction(repr(pair.m)) / 1000
    for label in ends:
        told = wheels[label].module
        if told is not None and told != module:
            what = translate(
                "wheels {} and {} have the module {:g} mm, and {:g} mm in [meshing]",
                *ends, float(told * 1000), pair.m,
            )  # fmt: skip
            fault = Fault("gears.module", what, "Keep one of them.")
            raise ProblemError(problem.source_file, [fault])
        if train.module is not None:
            wheels[label] = replace(wheels[label], module=module)
    train = replace(train, wheels=wheels)
    if train.module is None and not any(wheel.is_pulley for wheel in wheels.values()):
        picture = train.picture
        if picture.mu_l == DiagramSettings().mu_l:
            wanted = float(picture.mu_l * module * HALF_MODULES / 2)
            mu_l = series_near(wanted, up=False)
            picture = replace(picture, mu_l=Fraction(repr(mu_l)))
        train = replace(train, module=module, picture=picture)
    return replace(problem, train=train)


def output_of(motion: TrainMotion) -> str | None:
    """Return the output of a train with one input: the last moving body except planets."""
    train = motion.train
    others = {*train.inputs, *(x for some in motion.roles.planets.values() for x in some)}
    moving = [body for body in train.bodies if motion.speeds.get(body) and body not in others]
    return train.output or (moving[-1] if moving else None)


def _driving_speeds(project: Project) -> tuple[TrainMotion, Mapping[str, float], bool] | None:
    """Return the train of a project, the speeds of its bodies, 1/s, whether one is the crank's.

    None where the project has no train, or no crank that turns.
    """
    part, drive = project.part(PartName.GEARS), project.problem.drive
    if part is None or not isinstance(part.problem, GearProblem):
        return None
    if not drive.is_crank or not drive.rate:
        return None
    motion = solve_motion(part.problem)
    train, crank = motion.train, abs(drive.rate)
    turning = [body for body in train.bodies if body not in train.racks]
    speeds = {body: abs(float(motion.speeds.get(body, 0)) * train.rate) for body in turning}
    return motion, speeds, any(abs(x - crank) <= SPEED_TOLERANCE * crank for x in speeds.values())


def quick_shaft(project: Project) -> tuple[str, float] | None:
    """Return the input of the train that turns the crank, and its speed ratio to it; else None.

    The crank turns with a link of the train; of several inputs the quickest one is meant.
    """
    found = _driving_speeds(project)
    if found is None:
        return None
    motion, speeds, turns_crank = found
    inputs = [body for body in motion.train.inputs if body in speeds]
    if not inputs or not turns_crank:
        return None
    quickest = max(inputs, key=speeds.__getitem__)
    ratio = speeds[quickest] / abs(project.problem.drive.rate)
    return (quickest, ratio) if ratio > 1.0 + SPEED_TOLERANCE else None


def warn_of_separate_train(project: Project) -> str | None:
    """Return a warning of a train without a link as fast as the crank; else None."""
    found = _driving_speeds(project)
    if found is None:
        return None
    motion, speeds, turns_crank = found
    output = output_of(motion)
    if output is None or output not in speeds or turns_crank:
        return None
    return translate(
        "the crank makes {:.4g} rev/min, link {} of the train {:.4g} rev/min, and no other link of "
        'it turns with the crank. Change n or the train, or write train = "{}" in [driver].',
        RPM * abs(project.problem.drive.rate),
        output,
        RPM * speeds[output],
        output,
    )


FORCES_BOX: Box = (170.0, 130.0)
"""Box of the largest force plan of a project at the common scale, mm."""


CONSIDERABLE, SLIGHT = 1.0 / 3.0, 0.05
"""Shares of its largest size from which a load is considerable, and acts at all, in a position."""


def calculated_position(solution: Solution) -> int:
    """Return the default calculated position (расчётное положение).

    The clearest of those in which a load is considerable; if none of them is clear, a clear one in
    which a load acts.
    """
    chosen = [clearest_position(solution, loaded_positions(solution, share))
              for share in (CONSIDERABLE, SLIGHT)]  # fmt: skip
    return next((number for number in chosen if is_clear(solution)[number]), chosen[0])


def loaded_positions(solution: Solution, fraction: float = CONSIDERABLE) -> tuple[int, ...]:
    """Return the positions in which a varying load is considerable; all where none varies.

    A load is considerable from a ``fraction`` of its largest size on: in other positions weights
    and inertia would hide it.
    """
    count, dynamics = len(solution.positions), solution.problem.dynamics
    acts: Flags = np.zeros(count, dtype=bool)
    if dynamics is not None:
        peaks = {load.name: abs(largest_size(load.size)) for load in dynamics.loads}
        for link in (FRAME, *solution.problem.mechanism.links):
            for one in external(solution, dynamics, link):
                size = np.abs(np.broadcast_to(one.force if one.point else one.couple, acts.shape))
                largest = max(float(size.max()), peaks.get(one.name, 0.0), 1e-300)
                large = size >= fraction * largest
                acts |= large & (not large.all())  # one that is there always says nothing
    return tuple(np.flatnonzero(acts).tolist()) if acts.any() else tuple(range(count))


def force_scale(solution: Solution) -> float:
    """Return one scale for all force plans of a position, N per mm."""
    statics, asked = statics_of(solution), solution.problem.scales
    if asked.mu_F is not None:
        return asked.mu_F
    whole = np.max([statics.extent(plan) for plan in statics.board.plans], axis=0)
    box = float(whole[0]), float(whole[1])
    return choose_scale(box, FORCES_BOX, mm_per_unit=asked.in_mm_per_unit)


SEVERAL = "project-kinematics"
"""Composition where a crank turns through its cycle."""

PAPER = "A1"
"""Default format."""

FEW = 6
"""Maximum number of positions whose plans, diagrams and tables are tried on one sheet."""


def first_sheet(problem: Problem, **more: Any) -> list[Drawing]:
    """Return sheet 1 of a project: plans on one, diagrams and tables on the next.

    With a few positions all are on one, if they fit; small paper needs more sheets.

    Parameters
    ----------
    problem : Problem
        With its decisions: its scales are those of `first_scales`.
    more
        Taken by `kinematics_sheets`.

    Raises
    ------
    LayoutError
        The content does not fit on any number of sheets.
    """
    positions = problem.drive.positions
    if problem.cycle is None:
        return kinematics_sheets(problem, positions=positions, **more)
    made, paper = _composition(problem), problem.sheet.paper or PAPER
    draw = partial(kinematics_sheets, problem, paper=paper, positions=positions, **more)
    if len(positions) <= FEW:
        blocks = tuple(replace(entry, sheet=1) for entry in made.blocks)
        with contextlib.suppress(LayoutError):
            one = draw(layout=replace(made, blocks=blocks))
            if len(one) == 1:
                return one
    return draw(layout=made)


def first_scales(problem: Problem) -> Scales:
    """Return the scales of a project: those of scheme and plans on a sheet of their own.

    Raises
    ------
    LayoutError
    """
    positions = problem.drive.positions
    if problem.cycle is None:
        return sheet_scales(problem, positions=positions)
    made = _composition(problem)
    plans = tuple(entry for entry in made.blocks if entry.sheet == 1)
    paper = replace(problem.sheet, paper=problem.sheet.paper or PAPER)
    one = replace(problem, sheet=paper)
    return sheet_scales(one, replace(made, blocks=plans), positions)


def _composition(problem: Problem) -> Composition:
    return composition(SEVERAL, problem.sheet.lang or LANGUAGES[0])


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
    (0.005, 0.025)
    >>> [part.name.value for part in decided.parts]
    ['synthesis', 'kinematics', 'forces']
    """
    of_type("problem", problem, Problem, "planmethod.load()")
    path = None if path is None else Path(of_type("path", path, str | Path))
    if problem.drive.cam_drive is not None:
        text = "the driving link is moved by a cam's follower, a course project is that of a crank"
        hint = "Draw it with planmethod sheet; its cam is a project's with a crank in [driver]."
        raise ProblemError(problem.name, [Fault("driver.cam", text, hint)])
    if problem.drive.actuator is not None and problem.is_project:
        key = "".join(problem.drive.actuator)
        text = "an actuator moves the driving link, a course project is that of a crank"
        hint = "Draw it with planmethod sheet, and write it up with planmethod note."
        raise ProblemError(problem.name, [Fault(f"driver.{key}", text, hint)])
    if problem.drive.motor is not None and problem.is_project:
        text = translate(MOTOR_DRIVES, *problem.drive.motor, problem.drive.link)
        hint = translate("Draw it with planmethod sheet, and write it up with planmethod note.")
        fault = Fault("driver", text, f"{hint} {problem.drive.motor_hint}")
        raise ProblemError(problem.name, [fault])
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
    if not problem.is_project or problem.calculated is not None:
        return problem
    return settle(problem).problem


# Positions ---------------------------------------------------------------------------------------


def in_positions(problem: Problem) -> Problem:
    """Return a problem whose positions, cycle and flywheel have the same numbering."""
    if problem.drive.is_crank and problem.cycle is None:
        cycle = _default_cycle(problem)
        problem = problem if cycle is None else number_positions(replace(problem, cycle=cycle))
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
    if problem.drive.other_drives:
        return None
    if problem.dynamics is not None and only_in_positions(problem.dynamics):
        return None
    if len(positions) > 2:
        for way, sense in ((TURN, TurningSense.CCW), (-TURN, TurningSense.CW)):
            if np.ptp(np.diff([*positions, positions[0] + way])) < SAME_DEG:
                return CycleTask(zero=positions[0], count=len(positions), direction=sense)
        return None
    if machine is None:
        return None
    count = round(machine.count / machine.turns)
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
        if name not in PART_KINDS:
            yield ProjectPart(name, problem)
        elif path is not None:
            yield _of_kind(problem, name, path, str(getattr(task, name.value)))


def _has(problem: Problem, task: ProjectTask, name: PartName) -> bool:
    """Return whether the file has a part, or names the file of one."""
    match name:
        case PartName.KINEMATICS | PartName.NOTE:
            return True
        case PartName.SYNTHESIS:
            return problem.synthesis is not None
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
    kind = PART_KINDS[name]
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
    return ProjectPart(name, replace(found, stamp=stamp, stamp_in={}, title=title), kind.scales)


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


SCHEMA = 1

STROKES = ("working_deg", "idle_deg", "K_v", "by")


class PartFiles(Struct, frozen=True):
    """Files of a part in the order of its sheets, and how many sheets it has."""

    name: PartName
    files: tuple[str, ...]
    sheets: int


def project_record(
    project: Project, parts: Sequence[PartFiles], basename: str, *, numbers: Sequence[str] = ()
) -> dict[str, Any]:
    """Return the decisions of a project and its files.

    Parameters
    ----------
    parts : sequence of PartFiles
        Those that were made.
    basename : str
        Base name of its files.
    numbers : sequence of str
        Files of the calculation that were made.
    """
    column, scales = project.problem.drive.coordinate.column, project.scales
    strokes = project.strokes
    return {
        "schema": SCHEMA,
        "problem": basename,
        "positions": [{"number": number, column: at} for number, at in enumerate(project.places)],
        "calculated": project.calculated,
        "strokes": None
        if strokes is None
        else {key: _to_json_value(getattr(strokes, key)) for key in STROKES},
        "scales": {
            "mu_l": scales.mu_l,
            "mu_v": scales.mu_v,
            "mu_a": scales.mu_a,
            "mu_F": scales.mu_F,
        },
        "frame": project.frame,
        "parts": [
            {"name": part.name.value, "files": list(part.files), "sheets": part.sheets}
            if part.name is not PartName.NOTE
            else {"name": part.name.value, "files": list(part.files)}
            for part in parts
        ],
        "numbers": list(numbers),
    }


def _to_json_value(value: float | str | None) -> float | str | None:
    """Return a number without its last bits, a text without markup."""
    return plain_text(value) if isinstance(value, str) else value and round(value, 9)
