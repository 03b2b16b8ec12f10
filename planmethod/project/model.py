"""Decisions of a project, as plain records (решения проекта)."""

from __future__ import annotations

from enum import Enum
from functools import cached_property
from typing import Any

from msgspec import Struct

from planmethod.kind import ProblemKind
from planmethod.paper import Format
from planmethod.problem.common import KindProblem
from planmethod.problem.model import Problem, Scales
from planmethod.solved.solution import Solution
from planmethod.solved.turn.strokes import Strokes


class PartName(Enum):
    """Parts of a project in the order of their sheets, as options and records name them."""

    KINEMATICS = "kinematics"
    FORCES = "forces"
    FLYWHEEL = "flywheel"
    BALANCING = "balancing"
    GEARS = "gears"
    MESHING = "meshing"
    CAM = "cam"
    NOTE = "note"


class ProjectPart(Struct, frozen=True):
    """A part of a project that the file has (часть проекта).

    Attributes
    ----------
    name : PartName
    problem : KindProblem
        Its subject: the linkage with its decisions, the train, the meshing, the cam.
    kind : ProblemKind or None
        Kind of the problem; None for the linkage.
    """

    name: PartName
    problem: KindProblem
    kind: ProblemKind[Any] | None = None


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
        return self.solution.with_positions([self.positions[self.calculated]])
